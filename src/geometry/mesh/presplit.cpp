#include "geometry/mesh/presplit.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "accel/bounds.h"
#include "math/elementary.h"

namespace trace {
namespace {

constexpr Real kMostParts = 0.15;  // added, of the number of triangles
constexpr Real kUneven = 8;  // splits pay from this spread of sizes on (measured: scans 1 to 3, buildings 50)

/// The part of a triangle inside a box: a convex polygon of at most nine corners.
struct Piece {
  std::array<Vec3, 10> corners;
  std::size_t count = 0;

  void add(const Vec3& p) {
    if (count < corners.size()) corners[count++] = p;
  }
  Box3 box() const {
    Box3 b;
    for (std::size_t i = 0; i < count; ++i) b.extend(corners[i]);
    return b;
  }
};

/// The part of the piece on one side of the plane (Sutherland and Hodgman 1974).
Piece clip(const Piece& piece, int axis, Real plane, bool below) {
  Piece kept;
  for (std::size_t i = 0; i < piece.count; ++i) {
    const Vec3 &a = piece.corners[i], &b = piece.corners[i + 1 == piece.count ? 0 : i + 1];
    const bool aIn = below ? a[axis] <= plane : a[axis] >= plane,
               bIn = below ? b[axis] <= plane : b[axis] >= plane;
    if (aIn) kept.add(a);
    if (aIn == bIn) continue;
    Vec3 cut = a + (b - a) * ((plane - a[axis]) / (b[axis] - a[axis]));
    cut[axis] = plane;
    kept.add(cut);
  }
  return kept;
}

/// Planes over the mesh, along which all its triangles are cut.
class SplitGrid {
 public:
  explicit SplitGrid(const Box3& box) : low_(box.low), cell_((box.high - box.low) * (1.0 / kCells)) {
    for (int axis = 0; axis < 3; ++axis) perUnit_[axis] = cell_[axis] > 0 ? 1 / cell_[axis] : 0;
  }

  /// The coarsest of them through a box.
  struct Cut {
    int axis = -1, bit = -1;
    Real plane = 0;
  };
  Cut coarsestCut(const Box3& box) const {
    Cut cut;
    for (int axis = 0; axis < 3; ++axis) {
      const auto cell = [&](Real x) {
        return static_cast<std::uint32_t>(max(0, min((x - low_[axis]) * perUnit_[axis], kCells)));
      };
      const std::uint32_t low = cell(box.low[axis]), high = cell(box.high[axis]);
      if (low == high) continue;
      const int bit = 31 - __builtin_clz(low ^ high);
      if (bit <= cut.bit) continue;
      const Real plane = low_[axis] + cell_[axis] * (high >> bit << bit);
      if (plane > box.low[axis] && plane < box.high[axis]) cut = {axis, bit, plane};
    }
    return cut;
  }

 private:
  static constexpr Real kCells = (1 << 20) - 1;
  Vec3 low_, cell_, perUnit_;
};

/// Cuts the piece `times` times; appends the boxes.
void split(const Piece& piece, const Box3& box, int times, const SplitGrid& grid, std::uint32_t triangle,
           std::vector<BoxedItem>& parts) {
  const SplitGrid::Cut cut = times > 0 ? grid.coarsestCut(box) : SplitGrid::Cut{};
  if (cut.axis < 0) {
    parts.push_back(boxedItem(box, triangle));
    return;
  }
  const std::array<Piece, 2> pieces{clip(piece, cut.axis, cut.plane, true),
                                    clip(piece, cut.axis, cut.plane, false)};
  const std::array<Box3, 2> boxes{pieces[0].box(), pieces[1].box()};
  const Real a = maxComponent(boxes[0].size()), b = maxComponent(boxes[1].size());
  const int left = static_cast<int>(std::lround((times - 1) * a / (a + b)));
  split(pieces[0], boxes[0], left, grid, triangle, parts);
  split(pieces[1], boxes[1], times - 1 - left, grid, triangle, parts);
}

}  // namespace

std::vector<BoxedItem> triangleParts(const MeshData& mesh, bool wholeOnly) {
  std::vector<BoxedItem> parts;
  parts.reserve(mesh.triangles.size() * 5 / 4);  // what is not written takes no memory
  Bounds all;
  Real sum = 0, sumOfSquares = 0;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const Triangle& t = mesh.triangles[i];
    const Vec3f &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
    const Vec3 n = cross(Vec3(b) - Vec3(a), Vec3(c) - Vec3(a));
    if (n == Vec3{}) continue;
    BoxedItem& item = parts.emplace_back();
    Bounds box = boxOf(a);
    box.extend(boxOf(b));
    box.extend(boxOf(c));
    all.extend(box);
    box.low.store(item.low);
    box.high.store(item.high);
    item.item = i;
    // The empty part of the box of a triangle, which fills it at best by half, is what cutting can spare. A
    // float holds the side of a square as large for any size of mesh.
    const Real area = halfArea(box3(box));
    item.note =
        static_cast<float>(std::sqrt(max(0, area - 0.5 * (std::abs(n.x) + std::abs(n.y) + std::abs(n.z)))));
    sum += area;
    sumOfSquares += area * area;
  }
  // How uneven the sizes are: 1 if all boxes are alike.
  const std::size_t wholes = parts.size();
  const auto count = static_cast<Real>(wholes);
  if (wholeOnly || !(count * sumOfSquares > kUneven * sum * sum)) return parts;

  // More is gained at the tree's coarse planes.
  const SplitGrid grid(box3(all));
  const Real share = 1 / halfArea(box3(all));
  Real allGains = 0;
  for (std::size_t i = 0; i < wholes; ++i) {
    const SplitGrid::Cut cut = grid.coarsestCut(box3(boxOf(parts[i])));
    const Real empty = Real{parts[i].note} * parts[i].note;
    const float gain = cut.axis < 0 ? 0 : static_cast<float>(math::cbrt(empty * share * (1 << cut.bit)));
    parts[i].note = gain;
    allGains += gain;
  }
  if (!(allGains > 0)) return parts;
  const Real cuts = kMostParts * count * 1.5 / allGains;  // for a gain of 1
  for (std::size_t i = 0; i < wholes; ++i) {
    const int times = static_cast<int>(min(parts[i].note * cuts, 1000));
    if (times == 0) continue;
    const std::uint32_t triangle = parts[i].item;
    const Corners v = corners(mesh, triangle);
    split({{v.a, v.b, v.c}, 3}, box3(boxOf(parts[i])), times, grid, triangle, parts);
    parts[i] = parts.back();
    parts.pop_back();
  }
  return parts;
}

}  // namespace trace
