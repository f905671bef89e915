#include "shading/optics/sheen.h"

#include <algorithm>

namespace trace {
namespace {

constexpr int kSheenSteps = 24;

struct SheenTable {
  Real at[kSheenSteps + 1][kSheenSteps + 1];  ///< by roughness, cosine

  SheenTable() {
    for (int r = 0; r <= kSheenSteps; ++r)
      for (int c = 0; c <= kSheenSteps; ++c)
        at[r][c] = albedo(Sheen::of(1.0 * r / kSheenSteps), 1.0 * c / kSheenSteps);
  }

  static Real albedo(const Sheen& sheen, Real cosine) {
    constexpr int kHeights = 40, kTurns = 40;
    const Vec3 eye = sphericalDirection(max(1e-4, cosine), 0);
    Real sum = 0;
    for (int i = 0; i < kHeights; ++i)
      for (int j = 0; j < kTurns; ++j)
        sum += sheen.value(eye, sphericalDirection((i + 0.5) / kHeights, (j + 0.5) * kPi / kTurns));
    return min(1, sum * 2 * kPi / (kHeights * kTurns));
  }
};

}  // namespace

Real sheenAlbedo(Real cosine, Real roughness) {
  static const SheenTable kTable;
  const auto place = [](Real x, int& low) {
    const Real p = max(0, min(1, x)) * kSheenSteps;
    low = std::min(kSheenSteps - 1, static_cast<int>(p));
    return p - low;
  };
  int r, c;
  const Real s = place(roughness, r), t = place(cosine, c);
  const auto row = [&](int i) { return kTable.at[i][c] * (1 - t) + kTable.at[i][c + 1] * t; };
  return row(r) * (1 - s) + row(r + 1) * s;
}

}  // namespace trace
