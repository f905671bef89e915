// ray grade DIR --reference DIR: a table of all pairs, worst first, and a page to look at.
//
// Keys of the JSON object: folder, reference, passed, stopped (or null), pairs[] of {name, file, verdict,
// problem, cause (a sentence, or ""), unit, width, height, then each metric by name, null where it is
// infinite or there is none}, extra[], page (or null).
//
// ray grade --class DIR --reference DIR: students by scenes. With -o PAGE.html also PAGE.csv, and
// PAGE.results, from which a run that was interrupted continues. Keys: folder, reference, possible, stopped
// (or null), scenes[] of {name, points}, students[] of {name, points, passed, pairs[] of {file, verdict,
// points, mistakes[], cause, problem, cpu, our_cpu (seconds, or null)}, extra[] (files that have no
// reference), passed_over[] of {file, compared (in its place, or "")}}, page, csv (or null).
#include <algorithm>
#include <array>
#include <filesystem>

#include "app/compare/grade_files.h"
#include "app/grading/class_grade.h"
#include "app/session/json.h"
#include "base/budget.h"
#include "base/files/file.h"
#include "cli/commands/commands.h"
#include "cli/terminal/stop_key.h"
#include "cli/text/metric_text.h"

namespace trace::cli {
namespace {

constexpr int kNotAllWithin = 6;

GradeTask taskOf(const Arguments& arguments) {
  if (arguments.files.size() != 1)
    throw Error(Fault::usage,
                "ray grade: expected one folder, found " + std::to_string(arguments.files.size()),
                "ray grade DIR --reference DIR");
  if (arguments.reference.empty())
    throw Error(Fault::usage, "ray grade: expected --reference DIR, the folder of reference pictures");
  const std::string suffix = lowerCase(std::filesystem::path(arguments.output).extension().generic_string());
  if (!arguments.output.empty() && suffix != ".html" && suffix != ".htm")
    throw Error(Fault::usage, "-o: expected a page, such as grades.html, found \"" + arguments.output + "\"");
  return {.folder = arguments.files[0],
          .reference = arguments.reference,
          .renderScenes = arguments.renderScenes,
          .choices = arguments.choices,
          .strict = arguments.strict,
          .difference = {arguments.tolerance, arguments.pixelsPerDegree},
          .limits = arguments.limits,
          .magnify = arguments.magnify,
          .keepsPictures = !arguments.output.empty(),
          .page = arguments.output,
          .sceneLimit = arguments.sceneLimit,
          .scenes = arguments.scene};
}

/// How the students' programs are run.
ProgramRun runOf(const Arguments& arguments) {
  ProgramRun run{.command = arguments.run, .limits = {}, .isolated = !arguments.unsandboxed};
  if (arguments.sceneLimit > 0) run.limits.seconds = arguments.sceneLimit;
  if (const int megabytes = resolve({arguments.choices}).maxMemory; megabytes > 0)
    run.limits.memory = static_cast<std::uint64_t>(megabytes) << 20;
  return run;
}

/// The columns that UTF-8 text takes, as far as each character is one column wide.
std::size_t columnsOf(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

using Row = std::vector<std::string>;

/// Two spaces between columns; from the third on they are numbers and stand at the right.
std::string tableText(const std::vector<Row>& rows) {
  std::vector<std::size_t> widths;
  for (const Row& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (i == widths.size()) widths.push_back(0);
      widths[i] = std::max(widths[i], columnsOf(row[i]));
    }
  std::string text;
  for (const Row& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string space(widths[i] - columnsOf(row[i]), ' ');
      line += (i == 0 ? "" : "  ") + (i < 2 ? row[i] + space : space + row[i]);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

std::string gradesText(const Grades& grades) {
  std::vector<Row> rows{{"verdict", "picture"}};
  for (const Metric& metric : metrics()) rows[0].emplace_back(metric.name);
  for (const GradedPair& pair : grades.pairs) {
    Row row{std::string(verdictText(pair.verdict)), pair.name};
    for (double value : pair.values) row.push_back(numberText(value));
    rows.push_back(std::move(row));
  }
  std::string text = tableText(rows);
  for (const GradedPair& pair : grades.pairs) {
    if (!pair.problem.empty())
      text += pair.name + ": " + pair.problem.substr(0, pair.problem.find('\n')) + "\n";
    if (!pair.cause.empty()) text += pair.name + ": " + pair.cause + "\n";
  }
  for (const std::string& file : grades.extra) text += file + ": has no reference\n";
  return text + std::to_string(grades.passed) + " of " + std::to_string(grades.pairs.size()) +
         " within the limits\n";
}

std::string gradesJson(const Arguments& arguments, const Grades& grades) {
  Json json;
  json["folder"] = arguments.files[0];
  json["reference"] = arguments.reference;
  json["passed"] = grades.passed;
  json["stopped"] = nullptr;
  if (!grades.stopped.empty()) json["stopped"] = grades.stopped;
  json["pairs"] = Json::list();
  for (const GradedPair& pair : grades.pairs) {
    Json one{{"name", pair.name},       {"file", pair.file},    {"verdict", verdictText(pair.verdict)},
             {"problem", pair.problem}, {"cause", pair.cause},  {"unit", pair.unit},
             {"width", pair.width},     {"height", pair.height}};
    for (std::size_t i = 0; i < metrics().size(); ++i) {
      const std::string name(metrics()[i].name);
      one[name] = nullptr;
      if (!pair.values.empty() && std::isfinite(pair.values[i])) one[name] = pair.values[i];
    }
    json["pairs"].add(std::move(one));
  }
  json["extra"] = Json::list();
  for (const std::string& file : grades.extra) json["extra"].add(file);
  json["page"] = nullptr;
  if (!arguments.output.empty()) json["page"] = arguments.output;
  return json.text(2) + "\n";
}

/// The page's name with another suffix; "" of none.
std::string besidePage(const std::string& page, const char* suffix) {
  return page.empty() ? "" : std::filesystem::path(page).replace_extension(suffix).generic_string();
}

std::string classText(const ClassGrades& grades) {
  std::vector<Row> rows{{"student", "verdicts", "points"}};
  std::string below, extra;
  for (const ClassStudent& student : grades.students) {
    rows.push_back({student.name,
                    std::to_string(student.passed) + " of " + std::to_string(student.pairs.size()) +
                        " within the limits",
                    numberText(student.total)});
    for (const std::string& file : student.extra) extra += student.name + "/" + file + ": has no reference\n";
    for (const PassedOver& file : student.passedOver)
      extra += student.name + "/" + passedOverText(file) + "\n";
    for (const GradedPair& pair : student.pairs) {
      if (passes(pair.verdict)) continue;
      const std::string& why = pair.cause.empty() ? pair.problem : pair.cause;
      below += student.name + "/" + pair.name + ": " +
               (why.empty() ? std::string(verdictText(pair.verdict)) : why.substr(0, why.find('\n'))) + "\n";
    }
  }
  return tableText(rows) + below + extra + counted(grades.students.size(), "student") + ", " +
         counted(grades.scenes.size(), "scene") + ", " + numberText(grades.possible) + " points\n";
}

std::string classJson(const ClassTask& task, const ClassGrades& grades) {
  Json json{{"folder", task.grade.folder},
            {"reference", task.grade.reference},
            {"possible", grades.possible},
            {"stopped", nullptr},
            {"scenes", Json::list()},
            {"students", Json::list()},
            {"page", nullptr},
            {"csv", nullptr}};
  if (!grades.stopped.empty()) json["stopped"] = grades.stopped;
  if (!task.grade.page.empty()) json["page"] = task.grade.page, json["csv"] = task.csv;
  for (const ClassScene& scene : grades.scenes)
    json["scenes"].add(Json{{"name", scene.name}, {"points", scene.points}});
  for (const ClassStudent& student : grades.students) {
    Json one{{"name", student.name},  {"points", student.total}, {"passed", student.passed},
             {"pairs", Json::list()}, {"extra", Json::list()},   {"passed_over", Json::list()}};
    for (const std::string& file : student.extra) one["extra"].add(file);
    for (const PassedOver& file : student.passedOver)
      one["passed_over"].add(Json{{"file", file.file}, {"compared", file.compared}});
    for (std::size_t i = 0; i < student.pairs.size(); ++i) {
      const GradedPair& pair = student.pairs[i];
      Json mistakes = Json::list();
      for (const std::string& mistake : pair.mistakes) mistakes.add(mistake);
      one["pairs"].add(Json{{"file", pair.file},
                            {"verdict", verdictText(pair.verdict)},
                            {"points", student.points[i]},
                            {"mistakes", std::move(mistakes)},
                            {"cause", pair.cause},
                            {"problem", pair.problem},
                            {"cpu", pair.cpu < 0 ? Json() : Json(pair.cpu)},
                            {"our_cpu", pair.ourCpu < 0 ? Json() : Json(pair.ourCpu)}});
    }
    json["students"].add(std::move(one));
  }
  return json.text(2) + "\n";
}

int classCommand(const Arguments& arguments, const Console& console, bool asJson) {
  ClassTask task{.grade = taskOf(arguments),
                 .rubric = arguments.rubric.empty() ? Rubric{} : readRubric(arguments.rubric),
                 .results = besidePage(arguments.output, ".results"),
                 .run = runOf(arguments),
                 .csv = besidePage(arguments.output, ".csv")};
  for (const std::string& file : {arguments.output, task.csv, task.results}) {
    if (!file.empty()) checkWritable(file);
    if (!arguments.rubric.empty()) checkDistinct(arguments.rubric, file);
  }
  StopKey stop(console);
  const ClassGrades grades = gradeClass(task);
  const BudgetScope late(nullptr);  // results are reported, whatever the time
  if (!arguments.output.empty()) {
    writeFile(task.csv, classCsv(grades));
    writeFile(arguments.output, classPage(task, grades));
  }
  printResult(asJson ? classJson(task, grades) : classText(grades));
  const std::size_t all = grades.students.size() * grades.scenes.size();
  if (!arguments.output.empty())
    console.line(LogLevel::info, "wrote " + arguments.output + " and " + task.csv + " (" +
                                     counted(all, "picture") + ", " + std::to_string(grades.computed) +
                                     " compared now)");
  if (!grades.stopped.empty()) {
    console.line(LogLevel::error, "stopped before all was compared: " +
                                      (stop.pressed() ? "stopped by the user" : grades.stopped) +
                                      (task.results.empty() ? "" : "; the next run continues"));
    return stop.pressed() ? kStopped : static_cast<int>(Fault::limit);
  }
  const bool allWithin = std::all_of(grades.students.begin(), grades.students.end(),
                                     [](const auto& s) { return s.passed == s.pairs.size(); });
  return allWithin ? kDone : kNotAllWithin;
}

}  // namespace

int gradeCommand(const Arguments& arguments, const Console& console) {
  const bool asJson = chosenFormat(arguments, "grade", kTextOrJson) == "json";
  if (arguments.ofClass) return classCommand(arguments, console, asJson);
  if (!arguments.rubric.empty()) throw Error(Fault::usage, "--rubric needs --class");
  if (!arguments.run.empty()) throw Error(Fault::usage, "--run needs --class");
  const GradeTask task = taskOf(arguments);
  if (!arguments.output.empty()) checkWritable(arguments.output);
  StopKey stop(console);
  const Grades grades = trace::grade(task);
  const BudgetScope late(nullptr);  // results are reported, whatever the time
  if (!arguments.output.empty()) writeFile(arguments.output, gradePage(task, grades));
  printResult(asJson ? gradesJson(arguments, grades) : gradesText(grades));
  const std::string pairs = counted(grades.pairs.size(), "pair");
  if (!arguments.output.empty())  // the last line, below a table that may be long
    console.line(LogLevel::info, "wrote " + arguments.output + " (" + pairs + ")");
  if (!grades.stopped.empty()) {
    const auto left = std::count_if(grades.pairs.begin(), grades.pairs.end(),
                                    [](const auto& p) { return p.verdict == Verdict::notReached; });
    console.line(LogLevel::error, std::to_string(left) + " of " + pairs + " not reached: " +
                                      (stop.pressed() ? "stopped by the user" : grades.stopped));
    return stop.pressed() ? kStopped : static_cast<int>(Fault::limit);
  }
  return grades.passed == grades.pairs.size() ? kDone : kNotAllWithin;
}

}  // namespace trace::cli
