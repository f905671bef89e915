#include "app/compare/causes.h"

#include <algorithm>
#include <cmath>

namespace trace {
namespace {

constexpr double kMostLeftOfNegative = 0.1;  // the share of the RMSE

bool hasNoColors(const Picture& picture) {
  return std::all_of(picture.pixels.begin(), picture.pixels.end(),
                     [](const Color& c) { return c.r == c.g && c.g == c.b; });
}

bool isNegativeOf(const LoadedPicture& reference, const LoadedPicture& test) {
  if (!reference.levels || !test.levels || !areComparable(reference, test)) return false;
  LoadedPicture negative = reference;
  for (Color& color : negative.picture.pixels) color = Color(1) + color * -1;
  return rmseAfter({}, negative, test) <= kMostLeftOfNegative * rmseAfter({}, reference, test);
}

/// The share of the difference that a cause leaves.
double shareLeft(double left, double all) { return std::isfinite(all) && all > 0 ? left / all : 0; }

/// Keeps of the change of the picture and the variants of the scene what leaves less, so that they never
/// contradict each other.
void reconcile(Causes& causes) {
  if (!causes.picture || !causes.scene) return;
  SceneCauses& scene = *causes.scene;
  const DifferenceCause& picture = *causes.picture;
  if (scene.test && scene.test->text().empty()) return;  // the reference is not what the scene gives
  const std::optional<SceneMatch>& found = scene.test ? scene.test : scene.nearest;
  const bool isSameKind = scene.test && scene.test->variants.empty() && !picture.isNearest;
  const bool isSceneBetter = found && !isSameKind && (scene.test || picture.isNearest) &&
                             shareLeft(found->rmse, scene.rmse) <= shareLeft(picture.rmse, picture.before);
  if (isSceneBetter) return causes.picture.reset();
  if (picture.isNearest) return scene.nearest.reset();
  scene.isOutdone = true;
  if (scene.pixel && scene.pixel->text.empty()) scene.pixel.reset();
}

/// Why variants of the scene are not tried; "" if they are.
std::string whyNoScene(const Causes& causes, const PictureDifference& d) {
  if (causes.referenceColor || causes.testColor) return "a picture has one colour only";
  if (causes.isNegative) return "a picture is the negative of the other";
  if (!areComparable(d.reference, d.test))
    return d.numbers.sameSize ? "the pictures are too small" : "the sizes differ";
  if (causes.picture && causes.picture->rmse == 0) return "the cause leaves nothing to explain";
  return "";
}

}  // namespace

std::vector<std::string> Causes::notes(const std::string& reference, const std::string& test,
                                       std::string_view unit) const {
  std::vector<std::string> all;
  if (referenceColor) all.push_back(onlyColorText(*referenceColor, reference, unit));
  if (testColor) all.push_back(onlyColorText(*testColor, test, unit));
  if (isGrey) all.push_back(test + " is grey: its pixels have equal red, green and blue");
  if (isNegative) all.push_back(test + " is the negative of " + reference);
  return all;
}

Causes causesOf(const PictureDifference& d, const SceneQuestion* question) {
  Causes causes;
  causes.referenceColor = onlyColor(d.reference.picture);
  causes.testColor = onlyColor(d.test.picture);
  const bool hasOneColor = causes.referenceColor || causes.testColor;
  causes.isGrey = !hasOneColor && hasNoColors(d.test.picture) && !hasNoColors(d.reference.picture);
  causes.stopped = d.stopped;
  if (!causes.stopped.empty()) return causes;
  try {
    causes.isNegative = !hasOneColor && d.numbers.sameSize && isNegativeOf(d.reference, d.test);
    if (!hasOneColor && !causes.isNegative) causes.picture = causeOfDifference(d.reference, d.test);
    if (!question) return causes;
    causes.noScene = whyNoScene(causes, d);
    if (!causes.noScene.empty()) return causes;
    causes.scene = sceneCauses(*question, d.reference, d.test, {d.numbers.worstX, d.numbers.worstY});
    if (!causes.scene) causes.noScene = "the pictures are too small";
  } catch (const Error& error) {
    if (error.fault() != Fault::limit) throw;
    causes.stopped = error.messages().front().what;
  }
  reconcile(causes);
  return causes;
}

}  // namespace trace
