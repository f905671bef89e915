// Source: VRML97, ISO/IEC 14772-1:1997, section 6.5.
#include "formats/inventor/inventor_sky.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace trace::inventor {
namespace {

/// In thousandths of a degree.
Real rounded(Real degrees) { return std::round(degrees * 1000) / 1000 + 0; }
Real nextAbove(Real degrees) { return rounded(degrees + 0.001); }

/// Where each colour is, in degrees from the pole.
std::vector<std::pair<Real, Color>> circles(const Dome& dome) {
  std::vector<std::pair<Real, Color>> all;
  Real last = 0;
  for (std::size_t i = 0; i < dome.colors.size() && i <= dome.angles.size(); ++i) {
    if (i > 0) last = std::max(last, dome.angles[i - 1] * 180 / kPi);
    all.emplace_back(std::min(last, 180.0), dome.colors[i]);
  }
  return all;
}

/// Elevations ascend.
void add(Background& to, Real elevation, const Color& color) {
  elevation = rounded(elevation);
  if (!to.elevations.empty()) elevation = std::max(elevation, nextAbove(to.elevations.back()));
  if (elevation > 90) return;
  to.elevations.push_back(elevation);
  to.gradient.push_back(color);
}

}  // namespace

Background gradientOf(const Dome& sky, const Dome& ground) {
  auto above = circles(sky);
  const auto below = circles(ground);
  std::reverse(above.begin(), above.end());

  Background alone;
  for (const auto& [angle, color] : above) add(alone, 90 - angle, color);
  if (below.empty() || below.back().first == 0) return alone;

  Background both;
  for (const auto& [angle, color] : below) add(both, std::min(angle, 90.0) - 90, color);
  const Real edge = nextAbove(both.elevations.back());
  add(both, edge, alone.gradient.empty() ? Color(0) : alone.gradientAt(edge));
  for (std::size_t i = 0; i < alone.gradient.size(); ++i)
    if (alone.elevations[i] > edge) add(both, alone.elevations[i], alone.gradient[i]);
  return both;
}

}  // namespace trace::inventor
