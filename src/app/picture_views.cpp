#include "app/picture_views.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace trace {

Bytes exposed(const Picture& picture, double stops, Rounding rounding) {
  if (stops == 0) return toBytes(picture, rounding);
  Picture bright = picture;
  const double factor = std::exp2(stops);
  for (Color& c : bright.pixels) c = c * factor;
  return toBytes(bright, rounding);
}

Color falseColour(double value) {
  static const Color kStops[] = {{0, 0, 0},         {0.1, 0.15, 0.75}, {0, 0.65, 0.35},
                                 {0.95, 0.85, 0.1}, {0.9, 0.1, 0.1},   {1, 1, 1}};
  constexpr int kSteps = static_cast<int>(std::size(kStops)) - 1;
  const double at = (value < 1 ? std::max(value, 0.0) : 1.0) * kSteps;  // NaN counts as 1
  const int step = std::min(static_cast<int>(at), kSteps - 1);
  return lerp(at - step, kStops[step], kStops[step + 1]);
}

std::string pixelText(const Color& linear, const Color& toned, Rounding rounding) {
  char text[120];
  std::snprintf(text, sizeof text, "%.4g  %.4g  %.4g   (%d %d %d)", linear.r, linear.g, linear.b,
                toLevel(toned.r, rounding), toLevel(toned.g, rounding), toLevel(toned.b, rounding));
  return text;
}

Picture clamped(Picture levels) {
  for (Color& c : levels.pixels) c = clamp01(c);
  return levels;
}

Picture differences(const Picture& a, const Picture& b, double magnify) {
  Picture picture(a.width, a.height);
  const auto apart = [&](double x, double y) { return x == y ? 0 : std::abs(x - y) * magnify; };
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    const Color &p = a.pixels[i], &q = b.pixels[i];
    picture.pixels[i] = {apart(p.r, q.r), apart(p.g, q.g), apart(p.b, q.b)};
  }
  return picture;
}

Picture falseColours(const Picture& a, const Picture& b, double magnify) {
  Picture picture = differences(a, b, magnify);
  for (Color& c : picture.pixels) c = falseColour(maxComponent(c));
  return picture;
}

}  // namespace trace
