// ray diff A B: how far two pictures are apart, in numbers and as a picture, and the one change of the whole
// picture that makes B of A, if there is one.
//
// Keys of the JSON object: reference, test, width, height (of A), unit ("levels" or "values"), tolerance,
// means.{reference, test} (of each channel), sameSize, identical, within (the limits), then each metric by
// name (null when infinite), worst.{x, y}, limits[] of {metric, limit, met}, cause (null if none was found)
// of {text, turn, channels, curve, inverse, factor, right, down, rmse}, difference (name of the picture
// written, or null). Parts of the cause that change nothing are null, 1 or 0.
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "app/compare/diff_cause.h"
#include "app/compare/difference.h"
#include "app/session/json.h"
#include "base/budget.h"
#include "base/file.h"
#include "base/printable.h"
#include "base/text.h"
#include "cli/commands.h"
#include "cli/metric_text.h"
#include "image/codec.h"

namespace trace::cli {
namespace {

/// The verdicts of the command; each has an exit code in two scales.
enum class Finding { identical, within, beyond, sizesDiffer, failed };

int exitCode(Finding finding, bool likeIdiff) {
  if (likeIdiff) return static_cast<int>(finding);
  constexpr int kEqual = 0, kDifferent = 1, kError = 2;  // as ImageMagick's compare
  switch (finding) {
    case Finding::identical:
    case Finding::within: return kEqual;
    case Finding::beyond: return kDifferent;
    case Finding::sizesDiffer:
    case Finding::failed: break;
  }
  return kError;
}

std::string sizeText(const Picture& picture) {
  return std::to_string(picture.width) + "x" + std::to_string(picture.height);
}

std::string channelsText(const Color& c) {
  return "(" + numberText(c.r) + " " + numberText(c.g) + " " + numberText(c.b) + ")";
}

std::string pixelText(const Color& c, bool levels) {
  return channelsText(levels ? Color(std::round(255 * c.r), std::round(255 * c.g), std::round(255 * c.b))
                             : c);
}

/// In the unit of the difference.
Color meanOf(const LoadedPicture& picture, const PictureDifference& d) {
  return meanColor(picture.picture) * (d.levels ? 255 : 1);
}

/// The one picture was made for a screen, and holds no light as the other does.
void warnOfLevels(const PictureDifference& d, const Arguments& arguments, const Console& console) {
  if (d.reference.levels == d.test.levels) return;
  const std::string& shown = arguments.files[d.reference.levels ? 0 : 1];
  const std::string& light = arguments.files[d.reference.levels ? 1 : 0];
  console.line(LogLevel::warning,
               "warning: " + printable(shown) + " has levels of a screen, clipped at 1, and " +
                   printable(light) +
                   " light: they differ by tone and transfer curves too; compare two of one kind");
}

using Cause = std::optional<DifferenceCause>;

std::string diffText(const PictureDifference& d, const Cause& cause, const Arguments& arguments) {
  const std::string a = printable(arguments.files[0]), b = printable(arguments.files[1]);
  const std::string why = cause ? "  cause   " + causeText(*cause, a, b, d.unit()) + "\n" : "";
  if (!d.numbers.sameSize)
    return a + " (" + sizeText(d.reference.picture) + ") and " + b + " (" + sizeText(d.test.picture) +
           ") differ in size\n" + why;
  const std::string size = " (" + sizeText(d.reference.picture) + ")\n";
  if (d.numbers.identical) return a + " and " + b + " are identical" + size;
  std::string text = a + " and " + b + " differ" + size;
  text += "  means   " + channelsText(meanOf(d.reference, d)) + " and " + channelsText(meanOf(d.test, d)) +
          " " + std::string(d.unit()) + "\n";
  for (const Metric& metric : metrics()) {
    text +=
        "  " + std::string(metric.name) + std::string(8 - metric.name.size(), ' ') + metricText(metric, d);
    if (metric.name == "max") {
      const int x = d.numbers.worstX, y = d.numbers.worstY;
      text += " at pixel " + std::to_string(x) + "," + std::to_string(y) + ": " +
              pixelText(d.reference.picture.at(x, y), d.levels) + " and " +
              pixelText(d.test.picture.at(x, y), d.levels);
    }
    if (metric.name == "beyond")
      text += " of the values differ by more than " + toText(d.tolerance) + " " + std::string(d.unit());
    if (metric.name == "pixels") text += " of pixels differ";
    text += "\n";
  }
  text += why;
  for (const Limit& limit : arguments.limits)
    text += "  limit " + limitText(limit) + (limit.met(d) ? ": met\n" : ": exceeded\n");
  return text;
}

Json causeJson(const Cause& cause, const PictureDifference& d, const Arguments& arguments) {
  if (!cause) return nullptr;
  const auto named = [](std::string_view name) { return name.empty() ? Json() : Json(name); };
  const PictureChange& change = cause->change;
  return {{"text", causeText(*cause, arguments.files[0], arguments.files[1], d.unit())},
          {"turn", named(change.turn.text)},
          {"channels", named(change.channels.text.empty() ? "" : change.channels.name)},
          {"curve", named(curveName(change.curve))},
          {"inverse", change.darkens},
          {"factor", change.factor},
          {"right", change.right},
          {"down", change.down},
          {"rmse", cause->rmse}};
}

std::string diffJson(const PictureDifference& d, const Cause& cause, const Arguments& arguments) {
  Json json;
  json["reference"] = arguments.files[0];
  json["test"] = arguments.files[1];
  json["width"] = d.reference.picture.width;
  json["height"] = d.reference.picture.height;
  json["unit"] = d.unit();
  json["tolerance"] = d.tolerance;
  for (const auto& [name, picture] : {std::pair{"reference", &d.reference}, {"test", &d.test}}) {
    const Color color = meanOf(*picture, d);
    json["means"][name] = Json::list({color.r, color.g, color.b});
  }
  json["sameSize"] = d.numbers.sameSize;
  json["identical"] = d.numbers.identical;
  json["within"] = within(d, arguments.limits);
  addMetrics(json, d);
  json["worst"] = {{"x", d.numbers.worstX}, {"y", d.numbers.worstY}};
  json["limits"] = Json::list();
  for (const Limit& limit : arguments.limits)
    json["limits"].add({{"metric", limit.metric->name}, {"limit", limit.value}, {"met", limit.met(d)}});
  json["cause"] = causeJson(cause, d, arguments);
  json["difference"] = nullptr;
  if (!arguments.output.empty() && d.numbers.sameSize) json["difference"] = arguments.output;
  return json.text(2) + "\n";
}

/// The metrics asked for by --print, on one line.
std::string printed(const PictureDifference& d, const Arguments& arguments) {
  std::string text;
  for (const Metric* metric : arguments.printed) text += (text.empty() ? "" : " ") + toText(metric->value(d));
  return text + "\n";
}

Finding findDifference(const Arguments& arguments, const Console& console) {
  if (arguments.files.size() != 2)
    throw Error(Fault::usage,
                "ray diff: expected two pictures, found " + std::to_string(arguments.files.size()));
  const bool json = chosenFormat(arguments, "diff", kTextOrJson) == "json";
  if (!arguments.output.empty()) pictureFormatFor(arguments.output);
  for (const std::string& file : arguments.files) checkDistinct(file, arguments.output);
  if (!arguments.output.empty()) checkWritable(arguments.output);
  LoadedPicture reference = loadPicture(arguments.files[0]), test = loadPicture(arguments.files[1]);
  for (const auto& [file, loaded] :
       {std::pair{&arguments.files[0], &reference}, {&arguments.files[1], &test}})
    if (!loaded->remark.empty())
      console.line(LogLevel::warning, "warning: " + printable(*file) + ": " + printable(loaded->remark));
  const Work work("comparing the pictures");
  const PictureDifference d =
      difference(std::move(reference), std::move(test), {arguments.tolerance, arguments.pixelsPerDegree});
  warnOfLevels(d, arguments, console);
  const bool explains = (json || arguments.printed.empty()) && !d.numbers.identical;
  const Cause cause = explains ? causeOfDifference(d.reference, d.test) : std::nullopt;
  printResult(json                        ? diffJson(d, cause, arguments)
              : arguments.printed.empty() ? diffText(d, cause, arguments)
                                          : printed(d, arguments));
  if (!d.numbers.sameSize) return Finding::sizesDiffer;
  if (!arguments.output.empty()) {
    writePicture(arguments.output, arguments.show->picture(d.pictures(), arguments.magnify),
                 Rounding::nearest);
    console.line(LogLevel::info,
                 "wrote " + arguments.output + " (" + std::string(arguments.show->name) + ")");
  }
  return d.numbers.identical           ? Finding::identical
         : within(d, arguments.limits) ? Finding::within
                                       : Finding::beyond;
}

}  // namespace

int diffCommand(const Arguments& arguments, const Console& console) {
  return exitCode(findDifference(arguments, console), arguments.idiffCodes);
}

int failedDiff(const Arguments& arguments) { return exitCode(Finding::failed, arguments.idiffCodes); }

}  // namespace trace::cli
