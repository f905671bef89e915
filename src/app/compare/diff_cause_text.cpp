// The cause of a difference in words: see diff_cause.h.
#include <cmath>
#include <cstdio>
#include <vector>

#include "app/compare/diff_cause.h"

namespace trace {
namespace {

using Curve = PictureChange::Curve;

std::string pixelsText(double count, const char* before, const char* after) {
  if (count == 0) return "";
  const std::string number = std::abs(count) == 0.5 ? "half a pixel " : "one pixel ";
  return number + (count < 0 ? before : after);
}

std::string roundedText(double value, int digits) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

std::string curveText(const PictureChange& change) {
  switch (change.curve) {
    case Curve::none: return "";
    case Curve::srgb: return change.darkens ? "decoded from sRGB to linear values" : "encoded as sRGB";
    case Curve::gamma22:
      return change.darkens ? "with a gamma of 2.2 removed" : "with a gamma of 2.2 applied";
    case Curve::gamma18:
      return change.darkens ? "with a gamma of 1.8 removed" : "with a gamma of 1.8 applied";
    case Curve::scale: return "with its values times " + roundedText(change.factor, 2);
    case Curve::lightScale:
      return "with its light times " + roundedText(change.factor, 2) + " (its values are sRGB)";
  }
  return "";
}

}  // namespace

std::string_view curveName(PictureChange::Curve curve) {
  constexpr std::string_view kNames[] = {"", "srgb", "gamma 2.2", "gamma 1.8", "scale", "light scale"};
  return kNames[static_cast<std::size_t>(curve)];
}

int PictureChange::parts() const {
  return !turn.text.empty() + !channels.text.empty() + (curve != Curve::none) + (right != 0 || down != 0);
}

std::string PictureChange::text() const {
  std::vector<std::string> all;
  if (!turn.text.empty()) all.emplace_back(turn.text);
  if (!channels.text.empty()) all.emplace_back(channels.text);
  if (curve != Curve::none) all.push_back(curveText(*this));
  if (right != 0 || down != 0) {
    const std::string across = pixelsText(right, "to the left", "to the right"),
                      along = pixelsText(down, "up", "down");
    all.push_back("moved " + across + (across.empty() || along.empty() ? "" : " and ") + along);
  }
  std::string text;
  for (std::size_t i = 0; i < all.size(); ++i)
    text += (i == 0 ? "" : i + 1 == all.size() ? " and " : ", ") + all[i];
  return text;
}

std::string causeText(const DifferenceCause& cause, const std::string& reference, const std::string& test,
                      std::string_view unit) {
  return test + (cause.isNearest ? " is most like " : " is ") + reference + " " + cause.change.text() + "; " +
         leftText(cause.rmse, cause.before, unit);
}

std::string onlyColorText(const Color& color, const std::string& name, std::string_view unit) {
  if (isBlack(color)) return name + " is black: all its pixels are 0";
  const auto one = [&](double value) { return roundedText(unit == "levels" ? 255 * value : value, 4); };
  return name + " is of one colour: all its pixels are (" + one(color.r) + " " + one(color.g) + " " +
         one(color.b) + ")";
}

std::string leftText(double rmse, double before, std::string_view unit) {
  if (rmse == 0) return "nothing else differs beyond rounding";
  return "apart from that, RMSE " + roundedText(rmse, 3) + " " +
         (std::isfinite(before) ? "of " + roundedText(before, 3) + " " : "") + std::string(unit);
}

}  // namespace trace
