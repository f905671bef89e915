#include "geometry/shapes/surfaces/traced_heights.h"

#include <algorithm>

#include "base/budget.h"
#include "geometry/shapes/surfaces/height_field.h"
#include "geometry/shapes/surfaces/terrain.h"
#include "geometry/solve/span.h"
#include "geometry/traced.h"
#include "math/expression.h"
#include "math/noise.h"

namespace trace {

// --- where heights come from --------------------------------------------------------------------------

std::shared_ptr<const TracedHeights> HeightField::prepared() const {
  HeightGrid grid;
  if (file.grid) {
    grid = *file.grid;
  } else {
    const int n = std::clamp(points, 2, kMostPoints);
    grid = HeightGrid(n, n);
    const Expression expression(formula);
    const auto place = [&](int i) { return -1 + 2 * (static_cast<Real>(i) / (n - 1)); };
    for (int row = 0; row < n; ++row)
      for (int column = 0; column < n; ++column) {
        checkBudget();
        grid.at(column, row) = static_cast<float>(expression.at({place(column), place(row), 0}));
      }
  }
  for (float& z : grid.heights) z = static_cast<float>(z * height);
  return std::make_shared<const TracedHeights>(std::move(grid), floor, smooth, capped);
}

std::shared_ptr<const TracedHeights> Terrain::prepared() const {
  const int n = std::clamp(points, 2, kMostPoints), layers = std::clamp(octaves, 1, 20);
  HeightGrid grid(n, n);
  const auto key = static_cast<std::uint64_t>(seed);
  const auto place = [&](int i) { return static_cast<Real>(i) / (n - 1); };
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column) {
      checkBudget();
      Real z = 0, share = 1, finer = std::clamp(hills, 0.0, 1000.0);
      for (int octave = 0; octave < layers; ++octave, share *= roughness, finer *= 2) {
        const auto layer = mixBits(key * 64 + static_cast<std::uint64_t>(octave));
        const Real layerNoise = noise(place(column) * finer + 0.5, place(row) * finer + 0.5, layer);
        z += share * ((1 - ridges) * layerNoise + ridges * (0.5 - 2 * std::abs(layerNoise)));
      }
      grid.at(column, row) = static_cast<float>(z * height);
    }
  return std::make_shared<const TracedHeights>(std::move(grid), floor, smooth, capped);
}

ShapeFacts Terrain::checked() const {
  const int n = std::clamp(points, 2, kMostPoints), layers = std::clamp(octaves, 1, 20);
  Real most = 0, share = 1;  // noise is between -1 and 1
  for (int octave = 0; octave < layers; ++octave, share *= std::abs(roughness))
    most += share * (std::abs(1 - ridges) + std::abs(ridges) * 2.5);
  most *= std::abs(height);
  Box3 box{{-1, -1, capped ? floor : -most}, {1, 1, most}};
  if (capped && !(floor < most)) box = {};
  return {capped, box, TracedHeights::partsOf(n, n)};
}

// --- patches ------------------------------------------------------------------------------------------

namespace {

/// The ordinates of the Bezier form, between which the polynomial lies: c holds the coefficients of 1, u,
/// u^2, u^3.
std::array<Real, 4> ordinates(const std::array<Real, 4>& c) {
  return {c[0], c[0] + c[1] / 3, c[0] + (2 * c[1] + c[2]) / 3, c[0] + c[1] + c[2] + c[3]};
}

std::array<Real, 4> catmullRom(Real a, Real b, Real c, Real d) {
  return {b, (c - a) / 2, (2 * a - 5 * b + 4 * c - d) / 2, (d - a + 3 * (b - c)) / 2};
}

}  // namespace

TracedHeights::TracedHeights(HeightGrid grid, Real floor, bool smooth, bool capped)
    : grid_(std::move(grid)), smooth_(smooth), capped_(capped) {
  for (float& z : grid_.heights)
    if (!std::isfinite(z)) z = 0;
  // Blocks of two by two cells, then again and again of four blocks.
  const auto join = [](const Reach& a, const Reach& b) {
    return Reach{std::min(a.least, b.least), std::max(a.most, b.most)};
  };
  const int cellColumns = grid_.columns - 1, cellRows = grid_.rows - 1;
  Level finest{(cellColumns + 1) / 2, (cellRows + 1) / 2, {}};
  for (int j = 0; j < finest.rows; ++j)
    for (int i = 0; i < finest.columns; ++i) {
      Reach reach = reachOf(2 * i, 2 * j);
      for (int k = 1; k < 4; ++k)
        reach = join(
            reach, reachOf(std::min(2 * i + k % 2, cellColumns - 1), std::min(2 * j + k / 2, cellRows - 1)));
      finest.blocks.push_back(reach);
    }
  levels_.push_back(std::move(finest));
  while (levels_.back().blocks.size() > 1) {
    const Level& from = levels_.back();
    Level next{(from.columns + 1) / 2, (from.rows + 1) / 2, {}};
    const auto block = [&](int i, int j) {
      return from.at(std::min(i, from.columns - 1), std::min(j, from.rows - 1));
    };
    for (int j = 0; j < next.rows; ++j)
      for (int i = 0; i < next.columns; ++i)
        next.blocks.push_back(join(join(block(2 * i, 2 * j), block(2 * i + 1, 2 * j)),
                                   join(block(2 * i, 2 * j + 1), block(2 * i + 1, 2 * j + 1))));
    levels_.push_back(std::move(next));
  }
  const Reach all = levels_.back().blocks[0];
  box_ = {{-1, -1, capped_ ? floor : all.least}, {1, 1, all.most}};
  if (capped_ && !(floor < all.most)) box_ = {};
  error_ = max(1, max(std::abs(Real{all.least}), std::abs(Real{all.most}))) * gammaError(80);
}

Real TracedHeights::heightBeyond(int column, int row) const {
  const auto in = [](int i, int count) { return std::clamp(i, 0, count - 1); };
  const int c = in(column, grid_.columns), r = in(row, grid_.rows);
  const int c2 = in(2 * c - column, grid_.columns), r2 = in(2 * r - row, grid_.rows);
  const auto across = [&](int line) {
    return c2 == c ? Real{grid_.at(c, line)} : 2 * Real{grid_.at(c, line)} - grid_.at(c2, line);
  };
  return r2 == r ? across(r) : 2 * across(r) - across(r2);
}

TracedHeights::Patch TracedHeights::patch(int column, int row) const {
  Patch p;
  p.x0 = planeX(column);
  p.y0 = planeY(row);
  p.scaleX = 0.5 * (grid_.columns - 1);
  p.scaleY = 0.5 * (grid_.rows - 1);
  if (!smooth_) {
    const Real a = grid_.at(column, row), b = grid_.at(column + 1, row), c = grid_.at(column, row + 1),
               d = grid_.at(column + 1, row + 1);
    p.terms = 2;
    p.c[0] = {a, b - a, 0, 0};
    p.c[1] = {c - a, d - c - (b - a), 0, 0};
    return p;
  }
  p.terms = 4;
  std::array<std::array<Real, 4>, 4> rows;
  for (int j = 0; j < 4; ++j) {
    const auto z = [&](int i) { return heightBeyond(column + i, row + j - 1); };
    rows[static_cast<std::size_t>(j)] = catmullRom(z(-1), z(0), z(1), z(2));
  }
  for (std::size_t i = 0; i < 4; ++i) {
    const auto across = catmullRom(rows[0][i], rows[1][i], rows[2][i], rows[3][i]);
    for (std::size_t j = 0; j < 4; ++j) p.c[j][i] = across[j];
  }
  return p;
}

TracedHeights::Reach TracedHeights::reachOf(int column, int row) const {
  if (!smooth_) {
    const auto [least, most] = std::minmax({grid_.at(column, row), grid_.at(column + 1, row),
                                            grid_.at(column, row + 1), grid_.at(column + 1, row + 1)});
    return {least, most};
  }
  Patch p = patch(column, row);
  for (auto& powers : p.c) powers = ordinates(powers);
  Real least = kInfinity, most = -kInfinity;
  for (std::size_t i = 0; i < 4; ++i)
    for (const Real z : ordinates({p.c[0][i], p.c[1][i], p.c[2][i], p.c[3][i]})) {
      least = min(least, z);
      most = max(most, z);
    }
  constexpr float kEndless = std::numeric_limits<float>::infinity();
  return {std::nextafter(static_cast<float>(least), -kEndless),
          std::nextafter(static_cast<float>(most), kEndless)};
}

Real TracedHeights::Patch::at(Real x, Real y, Real& slopeX, Real& slopeY) const {
  const Real u = (x - x0) * scaleX, v = (y - y0) * scaleY;
  if (terms == 2) {
    slopeX = (c[0][1] + v * c[1][1]) * scaleX;
    slopeY = (c[1][0] + u * c[1][1]) * scaleY;
    return c[0][0] + u * c[0][1] + v * (c[1][0] + u * c[1][1]);
  }
  Real z = 0, byU = 0, byV = 0;
  for (std::size_t j = 4; j-- > 0;) {
    const auto& k = c[j];
    byV = byV * v + z;
    z = z * v + (k[0] + u * (k[1] + u * (k[2] + u * k[3])));
    byU = byU * v + (k[1] + u * (2 * k[2] + u * 3 * k[3]));
  }
  slopeX = byU * scaleX;
  slopeY = byV * scaleY;
  return z;
}

Jet TracedHeights::above(const Patch& patch, const Ray& ray, Real t) const {
  const Vec3 p = ray.at(t);
  Real slopeX, slopeY;
  const Real z = patch.at(p.x, p.y, slopeX, slopeY);
  return {p.z - z, ray.direction.z - slopeX * ray.direction.x - slopeY * ray.direction.y};
}

// --- rays ---------------------------------------------------------------------------------------------

int TracedHeights::cellOf(Real place, int cells) const {
  return std::clamp(static_cast<int>(std::floor((place + 1) * 0.5 * cells)), 0, cells - 1);
}

/// The way of a ray through the blocks, in order.
struct TracedHeights::Walk {
  const TracedHeights& field;
  const Ray& ray;
  const Range& range;
  Real room;  ///< more than rounding of z along the ray
  bool inside;

  template <class Visit>
  void become(bool after, Real t, std::int64_t part, Visit& visit) {
    if (after != inside) visit(Crossing{t, part});
    inside = after;
  }

  template <class Visit>
  void cell(int column, int row, Real a, Real b, Visit& visit) {
    const Patch patch = field.patch(column, row);
    const std::int64_t part = kSurface + std::int64_t{row} * (field.grid_.columns - 1) + column;
    const auto f = [&](Real t) { return field.above(patch, ray, t); };
    const auto crossing = [&](Real t, bool) { visit(Crossing{t, part}); };
    SignWalk walk{a, inside};
    const auto node = [&](Real t) {
      if (walk.at < t && t < b) walk.to(t, f, crossing);
    };
    if (patch.terms == 2) {  // the slope changes linearly
      const Real slope = f(a).slope,
                 more = -2 * patch.c[1][1] * patch.scaleX * ray.direction.x * patch.scaleY * ray.direction.y;
      if (more != 0) node(a - slope / more);
    } else {
      const Nodes nodes = turns(patch, a, b);
      for (std::size_t i = 1; i + 1 < nodes.count; ++i) node(a + nodes.at[i]);
    }
    walk.to(b, f, crossing);
    inside = walk.negative;
  }

  /// Where z minus the height may turn, counted from a.
  Nodes turns(const Patch& patch, Real a, Real b) const {
    const Vec3 p = ray.at(a);
    const Real u = (p.x - patch.x0) * patch.scaleX, du = ray.direction.x * patch.scaleX;
    const Real v = (p.y - patch.y0) * patch.scaleY, dv = ray.direction.y * patch.scaleY;
    std::array<Real, 7> sum{};
    for (std::size_t j = 4; j-- > 0;) {
      for (std::size_t k = 7; k-- > 0;) sum[k] = sum[k] * v + (k > 0 ? sum[k - 1] * dv : 0);
      std::array<Real, 4> line{};
      for (std::size_t i = 4; i-- > 0;) {
        for (std::size_t k = 4; k-- > 0;) line[k] = line[k] * u + (k > 0 ? line[k - 1] * du : 0);
        line[0] += patch.c[j][i];
      }
      for (std::size_t k = 0; k < 4; ++k) sum[k] += line[k];
    }
    for (Real& k : sum) k = -k;
    sum[0] += p.z;
    sum[1] += ray.direction.z;
    return extremaWithEnds(sum, 0, b - a);
  }

  /// A block of 2^level cells along each side; level 0 is a cell.
  template <class Visit>
  void block(int level, int column, int row, Real a, Real b, Visit& visit) {
    if (!(a < range.to)) return;
    if (level == 0) return cell(column, row, a, b, visit);
    const Level& blocks = field.levels_[static_cast<std::size_t>(level - 1)];
    const Reach& reach = blocks.at(column, row);
    const Real za = ray.at(a).z, zb = ray.at(b).z;
    if (min(za, zb) - room > reach.most) return become(false, a, kSurface, visit);
    if (max(za, zb) + room < reach.least) return become(true, a, kSurface, visit);

    const int cellColumns = field.grid_.columns - 1, cellRows = field.grid_.rows - 1;
    std::array<Real, 4> ends{a};
    std::size_t count = 1;
    const auto split = [&](int number, int cells, Real o, Real d, Real plane) {
      if (number >= cells || d == 0) return;
      const Real t = (plane - o) / d;
      if (!(a < t && t < b)) return;
      std::size_t k = count++;
      for (; k > 1 && ends[k - 1] > t; --k) ends[k] = ends[k - 1];
      ends[k] = t;
    };
    const int middleColumn = (2 * column + 1) << (level - 1), middleRow = (2 * row + 1) << (level - 1);
    split(middleColumn, cellColumns, ray.origin.x, ray.direction.x, field.planeX(middleColumn));
    split(middleRow, cellRows, ray.origin.y, ray.direction.y, field.planeY(middleRow));
    ends[count] = b;
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3 middle = ray.at(0.5 * (ends[i] + ends[i + 1]));
      const bool right = middleColumn < cellColumns && middle.x >= field.planeX(middleColumn);
      const bool far = middleRow < cellRows && middle.y >= field.planeY(middleRow);
      block(level - 1, 2 * column + right, 2 * row + far, ends[i], ends[i + 1], visit);
    }
  }
};

void TracedHeights::crossings(const Ray& ray, const Range& range, VisitCrossing visit) const {
  if (box_.empty()) return;
  const Real size = maxComponent(max(abs(box_.low), abs(box_.high)));
  // The highest and lowest places stay clear of the box's top, and of an open sheet's bottom.
  Box3 box = box_;
  const Real clear = std::ldexp(size, -40);
  box.high.z += clear;
  if (!capped_) box.low.z -= clear;
  const auto [in, out] = crossingsOf(box, ray);
  if (!(in.t < out.t && in.t < range.to)) return;
  const Real first = max(in.t, range.from);
  if (!(first < out.t)) return;
  const auto below = [&](Real t) {
    const Vec3 p = ray.at(t);
    return above(patch(cellOf(p.x, grid_.columns - 1), cellOf(p.y, grid_.rows - 1)), ray, t).value < 0;
  };
  const Real reach = max(std::abs(in.t), std::abs(out.t));
  const Real room = gammaError(16) * (std::abs(ray.origin.z) + reach * std::abs(ray.direction.z) + size);
  Walk walk{*this, ray, range, room, below(first)};
  if (capped_ && walk.inside && in.t >= range.from) visit(in);
  walk.block(static_cast<int>(levels_.size()), 0, 0, first, out.t, visit);
  if (capped_ && walk.inside && out.t <= range.to) visit(out);
}

SurfacePoint TracedHeights::surface(const Ray& ray, const Crossing& crossing) const {
  Vec3 p = ray.at(crossing.t), n;
  const Real side = max(error_, std::abs(box_.low.z) * gammaError(8));
  Vec3 error{side, side, side};
  p.x = std::clamp(p.x, -1.0, 1.0);
  p.y = std::clamp(p.y, -1.0, 1.0);
  if (crossing.part < kSurface) {
    const int axis = static_cast<int>(crossing.part / 2);
    const bool high = crossing.part % 2 != 0;
    p[axis] = high ? box_.high[axis] : box_.low[axis];
    n[axis] = high ? 1 : -1;
  } else {
    Real slopeX, slopeY;
    p.z = patch(cellOf(p.x, grid_.columns - 1), cellOf(p.y, grid_.rows - 1)).at(p.x, p.y, slopeX, slopeY);
    n = normalize({-slopeX, -slopeY, 1});
    if (capped_) p.z = max(p.z, box_.low.z);
  }
  if (!capped_ && dot(n, ray.direction) > 0) n = -n;
  // On the sides v goes up.
  const bool onSide = crossing.part < kSurface && crossing.part / 2 < 2;
  const Real across = crossing.part / 2 == 0 && onSide ? p.y : p.x;
  const Real height = box_.high.z - box_.low.z;
  const Real v = onSide && height > 0 ? (p.z - box_.low.z) / height : 0.5 + 0.5 * p.y;
  return {p, error, n, n, {0.5 + 0.5 * across, v}};
}

}  // namespace trace
