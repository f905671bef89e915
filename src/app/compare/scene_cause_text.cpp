// The causes that variants of a scene show, in words: see scene_cause.h.
#include <cstdio>

#include "app/compare/scene_cause.h"
#include "base/printable.h"

namespace trace {
namespace {

std::string rmseText(double value, const std::string& unit) {
  char text[40];
  std::snprintf(text, sizeof text, "%.3g", value);
  return "RMSE " + std::string(text) + " " + unit;
}

/// "what scene.ray gives without shadows"
std::string givenText(const SceneCauses& causes, const SceneMatch& match) {
  const std::string how = match.text();
  return "what " + printable(causes.file) + " gives" + (how.empty() ? "" : " " + printable(how));
}

std::string atText(const PixelPlace& pixel) {
  return "at " + std::to_string(pixel.x) + "," + std::to_string(pixel.y);
}

std::string testText(const SceneCauses& causes, const std::string& test) {
  if (causes.test) {
    const bool isNearly = causes.test->text().empty() && causes.test->rmse > 0;
    const std::string left = isNearly ? rmseText(causes.test->rmse, causes.unit) + " is left"
                                      : leftText(causes.test->rmse, causes.rmse, causes.unit);
    std::string alike;
    for (const std::string& variant : causes.test->alike)
      alike += (alike.empty() ? "; the same picture comes out " : ", or ") + printable(variant);
    return test + (isNearly ? " is nearly " : " is ") + givenText(causes, *causes.test) + "; " + left +
           " in " + std::to_string(causes.pixels) + " pixels compared" + alike;
  }
  const std::string none = "none of " + std::to_string(causes.tried) + " variants of " +
                           printable(causes.file) + " explains " + test;
  if (!causes.nearest) return none;
  return none + "; the nearest, " + printable(causes.nearest->text()) + ", leaves " +
         rmseText(causes.nearest->rmse, causes.unit) + " of " + rmseText(causes.rmse, causes.unit);
}

std::string pixelText(const PixelCause& cause, const std::string& test) {
  const std::string place = atText(cause.pixel);
  if (!cause.text.empty())
    return place + " " + test + " " + printable(cause.text) +
           (cause.confirmed > 0 ? "; so it is at " + std::to_string(cause.confirmed) + " of " +
                                      std::to_string(cause.others) + " other pixels"
                                : "");
  std::string parts;
  for (const PixelCause::Part& part : cause.parts)
    parts += (parts.empty() ? "" : "; ") + lightText(part.brings) + " " + printable(part.name);
  return place + " no single term explains " + test + "; the scene gives there " +
         (parts.empty() ? "no light" : parts);
}

}  // namespace

std::string SceneMatch::text() const {
  std::vector<std::string> all = variants;
  if (change.parts() > 0) all.push_back(change.text());
  std::string text;
  for (std::size_t i = 0; i < all.size(); ++i)
    text += (i == 0 ? "" : i + 1 == all.size() ? " and " : ", ") + all[i];
  return text;
}

std::vector<std::string> sceneSentences(const SceneCauses& causes, const std::string& reference,
                                        const std::string& test) {
  std::vector<std::string> all;
  if (!causes.isOutdone && (causes.test || causes.nearest || causes.tried > 0))
    all.push_back(testText(causes, test));
  if (causes.reference) {
    if (!causes.reference->text().empty())
      all.push_back(reference + " is " + givenText(causes, *causes.reference));
  } else if (causes.stopped.empty()) {
    all.push_back(reference + " is not what " + printable(causes.file) + " gives: " +
                  (causes.test && causes.test->text().empty()
                       ? "the reference stands first, the picture to explain second"
                       : "are these the options that it was rendered with?"));
  }
  if (!causes.stopped.empty())
    all.push_back((causes.variants > 0 ? "stopped after " + std::to_string(causes.tried) + " of " +
                                             std::to_string(causes.variants) + " variants: "
                                       : "stopped before " + printable(causes.file) + " was rendered: ") +
                  causes.stopped);
  if (causes.pixel) all.push_back(pixelText(*causes.pixel, test));
  return all;
}

}  // namespace trace
