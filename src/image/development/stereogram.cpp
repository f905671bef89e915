#include "image/development/stereogram.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/budget.h"
#include "math/elementary.h"
#include "math/noise.h"

namespace trace {
namespace {

/// Distances as z: 0 the farthest, 1 the nearest; all the same is 0.
std::vector<double> depths(const Picture& distances, const StereogramRules& rules) {
  double nearest = rules.nearest, farthest = rules.farthest;
  if (!(farthest > nearest)) {
    nearest = std::numeric_limits<double>::infinity();
    farthest = 0;
    for (const Color& c : distances.pixels) {
      if (!std::isfinite(c.r)) continue;
      nearest = std::min<double>(nearest, c.r);
      farthest = std::max<double>(farthest, c.r);
    }
  }
  std::vector<double> z;
  z.reserve(distances.pixels.size());
  for (const Color& c : distances.pixels)
    z.push_back(farthest > nearest ? std::clamp<double>((farthest - c.r) / (farthest - nearest), 0, 1) : 0);
  return z;
}

/// Nothing nearer stands between the surface at x and one of the eyes (equation 4 of the paper).
bool seenByBoth(const std::vector<double>& row, int x, const StereogramRules& rules) {
  const double z = row[static_cast<std::size_t>(x)];
  const int width = static_cast<int>(row.size());
  for (int t = 1;; ++t) {
    const double above = z + 2 * (2 - rules.depth * z) * t / (rules.depth * rules.eyes);
    if (!(above < 1)) return true;
    for (const int side : {x - t, x + t})
      if (side >= 0 && side < width && row[static_cast<std::size_t>(side)] >= above) return false;
  }
}

Color dot(int x, int y, std::uint64_t seed) {
  const auto bits = [](int i) { return static_cast<std::uint64_t>(static_cast<std::uint32_t>(i)); };
  return Color(static_cast<double>(mixBits(mixBits(bits(x) << 32 | bits(y)) ^ mixBits(seed)) & 1));
}

/// Two disks, half of E apart: what the farthest plane has between its two places.
void drawGuides(Picture& picture, const StereogramRules& rules) {
  const double radius = std::max(2.0, rules.eyes / 30), y = picture.height - 2.5 * radius;
  for (const double side : {-0.25, 0.25}) {
    const double x = picture.width / 2.0 + side * rules.eyes;
    for (int row = 0; row < picture.height; ++row)
      for (int column = 0; column < picture.width; ++column) {
        const double away = math::hypot(column + 0.5 - x, row + 0.5 - y);
        if (away < radius) picture.at(column, row) = Color(0);
        if (away >= radius && away < 1.4 * radius) picture.at(column, row) = Color(1);
      }
  }
}

}  // namespace

int separation(double z, const StereogramRules& rules) {
  return static_cast<int>(std::lround((1 - rules.depth * z) * rules.eyes / (2 - rules.depth * z)));
}

std::vector<int> linkedPlaces(const std::vector<double>& row, const StereogramRules& rules) {
  const int width = static_cast<int>(row.size());
  std::vector<int> same(row.size());
  std::iota(same.begin(), same.end(), 0);
  const auto at = [&](int i) -> int& { return same[static_cast<std::size_t>(i)]; };
  for (int x = 0; x < width; ++x) {
    checkBudget();
    const int apart = separation(row[static_cast<std::size_t>(x)], rules);
    int left = x - apart / 2, right = left + apart;
    if (left < 0 || right >= width || !seenByBoth(row, x, rules)) continue;
    // Links go from left to right: where one is there already, the two chains are made one.
    for (int linked = at(left); linked != left && linked != right; linked = at(left)) {
      if (linked < right) {
        left = linked;
      } else {
        at(left) = right;
        left = right;
        right = linked;
      }
    }
    at(left) = right;
  }
  return same;
}

Picture stereogram(const Picture& distances, const StereogramRules& rules) {
  Picture picture(distances.width, distances.height);
  const std::vector<double> z = depths(distances, rules);
  const Work work("drawing the stereogram", picture.height);
  for (int y = 0; y < picture.height; ++y) {
    const auto begin = z.begin() + static_cast<std::ptrdiff_t>(y) * picture.width;
    const std::vector<int> same = linkedPlaces({begin, begin + picture.width}, rules);
    for (int x = picture.width - 1; x >= 0; --x) {
      const int linked = same[static_cast<std::size_t>(x)];
      if (linked != x)
        picture.at(x, y) = picture.at(linked, y);
      else if (const Picture* pattern = rules.pattern)
        picture.at(x, y) = pattern->at(x % pattern->width, y % pattern->height);
      else
        picture.at(x, y) = dot(x, y, rules.seed);
    }
  }
  if (rules.guides) drawGuides(picture, rules);
  return picture;
}

}  // namespace trace
