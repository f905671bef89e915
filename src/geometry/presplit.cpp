#include "geometry/presplit.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace trace {
namespace {

constexpr Real kMostParts = 0.25;  // added, of the number of triangles
constexpr Real kUneven = 8;  // splits pay from this spread of sizes on (measured: scans 1 to 3, buildings 50)
constexpr int kGridBits = 20;  // planes lie on a grid of 2^20 cells over the mesh

/// What a box leaves of a triangle: a convex polygon of at most nine corners.
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

/// The coarsest plane of the grid through a box: all triangles are cut along the same planes.
struct Cut {
  int axis = -1, bit = -1;
  Real plane = 0;
};
Cut coarsestCut(const Box3& box, const Box3& grid) {
  Cut cut;
  for (int axis = 0; axis < 3; ++axis) {
    const Real size = grid.high[axis] - grid.low[axis];
    if (!(size > 0)) continue;
    const auto cell = [&](Real x) {
      return static_cast<std::uint32_t>(std::clamp((x - grid.low[axis]) / size, 0.0, 1.0) *
                                        ((1 << kGridBits) - 1));
    };
    const std::uint32_t low = cell(box.low[axis]), high = cell(box.high[axis]);
    int bit = -1;
    for (std::uint32_t differs = low ^ high; differs != 0; differs >>= 1) ++bit;
    if (bit <= cut.bit) continue;
    const Real plane = grid.low[axis] + size * (high >> bit << bit) / ((1 << kGridBits) - 1);
    if (plane > box.low[axis] && plane < box.high[axis]) cut = {axis, bit, plane};
  }
  return cut;
}

/// Cuts the piece `times` times; appends the boxes.
void split(const Piece& piece, const Box3& box, int times, const Box3& grid, std::uint32_t triangle,
           TriangleParts& parts) {
  const Cut cut = times > 0 ? coarsestCut(box, grid) : Cut{};
  if (cut.axis < 0) {
    parts.add(box, triangle);
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

TriangleParts triangleParts(const MeshData& mesh, bool wholeOnly) {
  TriangleParts whole;
  whole.reserve(mesh.triangles.size());
  Box3 grid;
  Real sum = 0, sumOfSquares = 0;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    if (faceNormal(mesh, i) == Vec3{}) continue;
    const Box3 box = bounds(mesh, i);
    whole.add(box, i);
    grid.extend(box);
    const Real area = halfArea(box);
    sum += area, sumOfSquares += area * area;
  }
  // How uneven the sizes are: 1 if all boxes are alike.
  const std::size_t wholes = whole.boxes.size();
  const auto count = static_cast<Real>(wholes);
  if (wholeOnly || !(count * sumOfSquares > kUneven * sum * sum)) return whole;

  // What cutting a triangle gains: empty space in its box, more at the tree's coarse planes.
  std::vector<Real> gain(wholes);
  Real allGains = 0;
  for (std::size_t i = 0; i < wholes; ++i) {
    const Cut cut = coarsestCut(whole.boxes[i], grid);
    if (cut.axis < 0) continue;
    const Vec3 n = abs(faceNormal(mesh, whole.triangles[i]));
    const Real empty = max(0.0, halfArea(whole.boxes[i]) - 0.5 * (n.x + n.y + n.z));
    gain[i] = std::cbrt(empty * std::ldexp(1.0, cut.bit - kGridBits));
    allGains += gain[i];
  }
  if (!(allGains > 0)) return whole;
  TriangleParts parts;
  parts.reserve(wholes + static_cast<std::size_t>(kMostParts * count) + 1);
  for (std::size_t i = 0; i < wholes; ++i) {
    const Corners v = corners(mesh, whole.triangles[i]);
    const int times = static_cast<int>(min(gain[i] / allGains * kMostParts * count * 1.5, 1000.0));
    if (times == 0)
      parts.add(whole.boxes[i], whole.triangles[i]);
    else
      split({{v.a, v.b, v.c}, 3}, whole.boxes[i], times, grid, whole.triangles[i], parts);
  }
  return parts;
}

}  // namespace trace
