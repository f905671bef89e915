// ray grade DIR --reference DIR: a table of all pairs, worst first, and a page to look at.
//
// Keys of the JSON object: folder, reference, passed, pairs[] of {name, file, verdict, problem, unit, width,
// height, then each metric by name, null where it is infinite or there is none}, extra[], page (or null).
#include <array>
#include <nlohmann/json.hpp>

#include "app/grade.h"
#include "base/file.h"
#include "cli/commands.h"
#include "cli/metric_text.h"

namespace trace::cli {
namespace {

constexpr std::array<std::string_view, 2> kFormats{"text", "json"};

constexpr int kNotAllWithin = 6;

GradeTask taskOf(const Arguments& arguments) {
  if (arguments.files.size() != 1)
    throw Error(Fault::usage,
                "ray grade: expected one folder, found " + std::to_string(arguments.files.size()),
                "ray grade DIR --reference DIR");
  if (arguments.reference.empty())
    throw Error(Fault::usage, "ray grade: expected --reference DIR, the folder of reference pictures");
  return {.folder = arguments.files[0],
          .reference = arguments.reference,
          .renderScenes = arguments.renderScenes,
          .choices = arguments.choices,
          .strict = arguments.strict,
          .difference = {arguments.tolerance, arguments.pixelsPerDegree},
          .limits = arguments.limits,
          .magnify = arguments.magnify,
          .keepsPictures = !arguments.output.empty(),
          .page = arguments.output};
}

std::string padded(std::string text, std::size_t width, bool right = false) {
  if (text.size() < width) text.insert(right ? 0 : text.size(), width - text.size(), ' ');
  return text;
}

std::string gradesText(const Grades& grades) {
  constexpr std::size_t kVerdict = 14, kNumber = 9;
  std::size_t widest = 8;
  for (const GradedPair& pair : grades.pairs) widest = std::max(widest, pair.name.size() + 2);
  std::string text = padded("verdict", kVerdict) + padded("picture", widest);
  for (const Metric& metric : metrics()) text += padded(std::string(metric.name), kNumber, true);
  text += "\n";
  for (const GradedPair& pair : grades.pairs) {
    text += padded(std::string(verdictText(pair.verdict)), kVerdict) + padded(pair.name, widest);
    for (double value : pair.values) text += padded(numberText(value), kNumber, true);
    if (!pair.problem.empty()) text += pair.problem.substr(0, pair.problem.find('\n'));
    text += "\n";
  }
  if (!grades.extra.empty()) text += "without a reference: " + counted(grades.extra.size(), "file") + "\n";
  return text + std::to_string(grades.passed) + " of " + std::to_string(grades.pairs.size()) +
         " within the limits\n";
}

std::string gradesJson(const Arguments& arguments, const Grades& grades) {
  using nlohmann::ordered_json;
  ordered_json json;
  json["folder"] = arguments.files[0];
  json["reference"] = arguments.reference;
  json["passed"] = grades.passed;
  json["pairs"] = ordered_json::array();
  for (const GradedPair& pair : grades.pairs) {
    ordered_json one{{"name", pair.name},       {"file", pair.file}, {"verdict", verdictText(pair.verdict)},
                     {"problem", pair.problem}, {"unit", pair.unit}, {"width", pair.width},
                     {"height", pair.height}};
    for (std::size_t i = 0; i < metrics().size(); ++i) {
      const std::string name(metrics()[i].name);
      one[name] = nullptr;
      if (!pair.values.empty() && std::isfinite(pair.values[i])) one[name] = pair.values[i];
    }
    json["pairs"].push_back(std::move(one));
  }
  json["extra"] = grades.extra;
  json["page"] = nullptr;
  if (!arguments.output.empty()) json["page"] = arguments.output;
  return json.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace

int grade(const Arguments& arguments, const Console& console) {
  const bool asJson = chosenFormat(arguments, "grade", kFormats) == "json";
  const GradeTask task = taskOf(arguments);
  if (!arguments.output.empty()) checkWritable(arguments.output);
  const Grades grades = trace::grade(task);
  if (!arguments.output.empty()) writeFile(arguments.output, gradePage(task, grades));
  printResult(asJson ? gradesJson(arguments, grades) : gradesText(grades));
  if (!arguments.output.empty())  // the last line, below a table that may be long
    console.line(LogLevel::info,
                 "wrote " + arguments.output + " (" + counted(grades.pairs.size(), "pair") + ")");
  return grades.passed == grades.pairs.size() ? kDone : kNotAllWithin;
}

}  // namespace trace::cli
