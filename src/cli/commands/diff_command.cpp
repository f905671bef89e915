// ray diff A B: how far two pictures are apart, in numbers and as a picture, and the one change of the whole
// picture that makes B of A, if there is one. With --scene, what a program did differently with the scene.
//
// Keys of the JSON object: reference, test, width, height (of A), unit ("levels" or "values"), tolerance,
// means.{reference, test} (of each channel), sameSize, identical, within (the limits), then each metric by
// name (null when infinite or not known), worst.{x, y}, limits[] of {metric, limit, met}, notes[] (sentences
// about what is plain to see, such as a picture of one colour), cause (null if none was found) of {text,
// turn, channels, curve, inverse, factor, right, down, rmse}, nearest (likewise, of a change that leaves too
// much to be the cause), difference (name of the picture written, or null), stopped (why the cause was not
// sought to the end, or null). Parts of the cause that change nothing are null, 1 or 0. With --scene also
// scene (null if it was not compared) of {file, text (a list of sentences), pixels, tried, variants, stopped
// (or null), rmse, reference, test, nearest, pixel}; reference, test and nearest are null or {text, variants,
// change, rmse}; pixel is null or {x, y, text, confirmed, others, parts[] of {name, brings}}.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <utility>

#include "app/compare/causes.h"
#include "app/compare/difference.h"
#include "app/session/json.h"
#include "app/session/output.h"
#include "base/budget.h"
#include "base/files/file.h"
#include "base/printable.h"
#include "base/text.h"
#include "cli/commands/commands.h"
#include "cli/terminal/stop_key.h"
#include "cli/text/metric_text.h"
#include "image/codecs/codec.h"

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

/// Lines about why the pictures differ.
std::string whyText(const PictureDifference& d, const Causes& causes, const Arguments& arguments) {
  const std::string a = printable(arguments.files[0]), b = printable(arguments.files[1]);
  std::string text;
  for (const std::string& sentence : causes.notes(a, b, d.unit())) text += "  note    " + sentence + "\n";
  if (causes.picture)
    text += (causes.picture->isNearest ? "  nearest " : "  cause   ") +
            causeText(*causes.picture, a, b, d.unit()) + "\n";
  if (causes.scene)
    for (const std::string& sentence : sceneSentences(*causes.scene, a, b))
      text += "  scene   " + sentence + "\n";
  if (!causes.noScene.empty())
    text += "  scene   not compared with " + printable(arguments.scene) + ": " + causes.noScene + "\n";
  return text;
}

std::string diffText(const PictureDifference& d, const Causes& causes, const Arguments& arguments) {
  const std::string a = printable(arguments.files[0]), b = printable(arguments.files[1]);
  const std::string why = whyText(d, causes, arguments);
  if (!d.numbers.sameSize)
    return a + " (" + sizeText(d.reference.picture) + ") and " + b + " (" + sizeText(d.test.picture) +
           ") differ in size\n" + why;
  const std::string size = " (" + sizeText(d.reference.picture) + ")\n";
  if (d.numbers.identical) return a + " and " + b + " are identical" + size;
  std::string text = a + " and " + b + " differ" + size;
  text += "  means   " + channelsText(meanOf(d.reference, d)) + " and " + channelsText(meanOf(d.test, d)) +
          " " + std::string(d.unit()) + "\n";
  for (const Metric& metric : metrics()) {
    if (!d.stopped.empty() && std::isnan(metric.value(d))) continue;
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

Json causeJson(const std::optional<DifferenceCause>& cause, const PictureDifference& d,
               const Arguments& arguments) {
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

Json matchJson(const std::optional<SceneMatch>& match) {
  if (!match) return nullptr;
  Json variants = Json::list();
  for (const std::string& variant : match->variants) variants.add(variant);
  return {{"text", match->text()},
          {"variants", std::move(variants)},
          {"change", match->change.text()},
          {"rmse", match->rmse}};
}

Json pixelJson(const std::optional<PixelCause>& cause) {
  if (!cause) return nullptr;
  Json parts = Json::list();
  for (const PixelCause::Part& part : cause->parts)
    parts.add({{"name", part.name}, {"brings", Json::list({part.brings.r, part.brings.g, part.brings.b})}});
  return {{"x", cause->pixel.x},           {"y", cause->pixel.y},     {"text", cause->text},
          {"confirmed", cause->confirmed}, {"others", cause->others}, {"parts", std::move(parts)}};
}

Json sceneJson(const std::optional<SceneCauses>& causes, const Arguments& arguments) {
  if (!causes) return nullptr;
  Json text = Json::list();
  for (const std::string& sentence : sceneSentences(*causes, arguments.files[0], arguments.files[1]))
    text.add(sentence);
  return {{"file", causes->file},
          {"text", std::move(text)},
          {"pixels", causes->pixels},
          {"tried", causes->tried},
          {"variants", causes->variants},
          {"stopped", causes->stopped.empty() ? Json() : Json(causes->stopped)},
          {"rmse", std::isfinite(causes->rmse) ? Json(causes->rmse) : Json()},
          {"reference", matchJson(causes->reference)},
          {"test", matchJson(causes->test)},
          {"nearest", matchJson(causes->nearest)},
          {"pixel", pixelJson(causes->pixel)}};
}

std::string diffJson(const PictureDifference& d, const Causes& causes, const Arguments& arguments) {
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
  const bool isNearest = causes.picture && causes.picture->isNearest;
  json["cause"] = isNearest ? Json() : causeJson(causes.picture, d, arguments);
  json["nearest"] = isNearest ? causeJson(causes.picture, d, arguments) : Json();
  json["notes"] = Json::list();
  for (const std::string& note : causes.notes(arguments.files[0], arguments.files[1], d.unit()))
    json["notes"].add(note);
  if (!causes.noScene.empty()) json["notes"].add("not compared with the scene: " + causes.noScene);
  if (!arguments.scene.empty()) json["scene"] = sceneJson(causes.scene, arguments);
  json["difference"] = nullptr;
  if (!arguments.output.empty() && d.numbers.sameSize) json["difference"] = arguments.output;
  json["stopped"] = causes.stopped.empty() ? Json() : Json(causes.stopped);
  return json.text(2) + "\n";
}

/// The metrics asked for by --print, on one line.
std::string printed(const PictureDifference& d, const Arguments& arguments) {
  std::string text;
  for (const Metric* metric : arguments.printed) text += (text.empty() ? "" : " ") + toText(metric->value(d));
  return text + "\n";
}

/// Options of renders, other than limits, are those of the scene.
void checkOptions(const Arguments& arguments) {
  if (!arguments.scene.empty()) return;
  for (const Choice& choice : arguments.choices)
    if (findOption(choice.option).group != "Resources")
      throw Error(Fault::usage, "ray diff: expected --scene SCENE with --" + choice.option + ", found none",
                  "options of renders are those that the reference was rendered with");
}

/// Throws Error if there is no such file: where the pictures are identical, nothing else says so.
void checkIsThere(const std::string& scene) {
  std::error_code ignored;
  if (!std::filesystem::exists(scene, ignored) || std::filesystem::is_directory(scene, ignored))
    readFile(scene);
}

/// FLIP is asked for, so that there is no result without it.
bool needsFlip(const Arguments& arguments) {
  const auto isFlip = [](const Metric& metric) { return metric.name == "flip"; };
  return std::any_of(arguments.printed.begin(), arguments.printed.end(),
                     [&](const Metric* metric) { return isFlip(*metric); }) ||
         std::any_of(arguments.limits.begin(), arguments.limits.end(),
                     [&](const Limit& limit) { return isFlip(*limit.metric); }) ||
         (!arguments.output.empty() && arguments.show->name == "flip");
}

/// Finds what explains the difference, until the time is over or Ctrl-C is pressed.
Causes findCauses(const PictureDifference& d, const Arguments& arguments, const Console& console) {
  if (arguments.scene.empty()) {
    const Work work("comparing the pictures");
    return causesOf(d, nullptr);
  }
  const StopKey stop(console);
  SceneQuestion question{arguments.scene, arguments.choices, arguments.strict};
  const bool isLimited = resolve({arguments.choices}).timeLimit > 0;
  if (isLimited) question.seconds = 0;
  Causes causes = causesOf(d, &question);
  if (!causes.scene) return causes;
  if (stop.pressed()) causes.scene->stopped = "by the user";
  console.warnings(causes.scene->warnings);
  if (!arguments.output.empty()) checkIsNoInput(arguments.output, causes.scene->inputs);
  return causes;
}

Finding findDifference(const Arguments& arguments, const Console& console) {
  if (arguments.files.size() != 2)
    throw Error(Fault::usage,
                "ray diff: expected two pictures, found " + std::to_string(arguments.files.size()));
  if (arguments.files[0] == kStandardInput && arguments.files[1] == kStandardInput)
    throw Error(Fault::usage, "ray diff: expected at least one picture in a file, found - twice");
  const bool json = chosenFormat(arguments, "diff", kTextOrJson) == "json";
  if (!arguments.output.empty()) pictureFormatFor(arguments.output);
  checkOptions(arguments);
  for (const std::string& file : arguments.files) checkDistinct(file, arguments.output);
  if (!arguments.scene.empty()) checkDistinct(arguments.scene, arguments.output);
  if (!arguments.output.empty()) checkWritable(arguments.output);
  LoadedPicture reference = loadPicture(arguments.files[0]), test = loadPicture(arguments.files[1]);
  for (const auto& [file, loaded] :
       {std::pair{&arguments.files[0], &reference}, {&arguments.files[1], &test}})
    if (!loaded->remark.empty())
      console.line(LogLevel::warning, "warning: " + printable(*file) + ": " + printable(loaded->remark));
  if (!arguments.scene.empty()) checkIsThere(arguments.scene);
  const PictureDifference d = [&] {
    const Work work("comparing the pictures");
    return difference(std::move(reference), std::move(test),
                      {arguments.tolerance, arguments.pixelsPerDegree, !needsFlip(arguments)});
  }();
  warnOfLevels(d, arguments, console);
  const bool explains = (json || arguments.printed.empty()) && !d.numbers.identical;
  const Causes causes = explains ? findCauses(d, arguments, console) : Causes{};
  if (!causes.stopped.empty())
    console.line(LogLevel::warning, "warning: the cause was not sought to the end: " + causes.stopped);
  const bool isLate = !causes.stopped.empty() || (causes.scene && !causes.scene->stopped.empty());
  const BudgetScope late(isLate ? nullptr : budgetOfThread.budget);  // what was found is reported
  printResult(json                        ? diffJson(d, causes, arguments)
              : arguments.printed.empty() ? diffText(d, causes, arguments)
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
