// Sharp edges in a level of subdivision, Loop's or Catmull and Clark's (DeRose, Kass and Truong,
// Subdivision Surfaces in Character Animation, 1998, appendix B): along them, as on borders, it is that of a
// cubic B-spline. Sharpness between 0 and 1 mixes with the smooth surface. Part of mesh_smooth.h.
#pragma once

#include <algorithm>

#include "base/unique.h"
#include "geometry/mesh/mesh_smooth.h"

namespace trace {

/// Two points of a mesh, the lesser number first.
struct Edge {
  std::uint32_t a, b;
};
inline Edge edgeOf(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

/// The new point of an edge, from what it is on a smooth surface and in the middle of the edge.
inline Vec3 creased(const Vec3& smooth, const Vec3& middle, Real sharpness) {
  return sharpness >= 1 ? middle : smooth + (middle - smooth) * sharpness;
}

/// The sharp edges at a point, those of borders being infinitely sharp.
struct PointCreases {
  int count = 0;
  Real sharpness = 0;  ///< their sum
  Vec3 along;          ///< the sum of their other ends

  void add(const Vec3& other, Real s) {
    if (s > 0) {
      ++count;
      sharpness += s;
      along += other;
    }
  }
  /// Where the point goes, from where it continues a smooth surface: with two along their curve, with more it
  /// is a corner and stays; one alone ends there.
  Vec3 moved(const Vec3& point, const Vec3& smooth) const {
    if (count < 2) return smooth;
    return creased(smooth, count == 2 ? point * 0.75 + along * 0.125 : point, sharpness / count);
  }
};

/// How sharp the edges of a mesh are.
struct SharpEdges {
  /// `uses` tells of how many faces each edge is: those of two are as sharp as the creases tell, others are
  /// borders. Edge i gets a new point of the number firstMiddle + i.
  SharpEdges(Unique<Edge>& edges, const std::vector<int>& uses, const std::vector<Crease>& creases,
             std::uint32_t firstMiddle)
      : sharpness(uses.size(), 0) {
    for (const Crease& crease : creases)
      if (const auto number = edges.number(edgeOf(crease.a, crease.b)); number < sharpness.size())
        sharpness[number] = max(sharpness[number], crease.sharpness);
    for (std::size_t i = 0; i < uses.size(); ++i) {
      const Edge e = edges.keys()[i];
      const auto middle = firstMiddle + static_cast<std::uint32_t>(i);
      if (uses[i] != 2)
        sharpness[i] = kInfinity;
      else if (const Real left = sharpness[i] - 1; left > 0) {
        finer.push_back({e.a, middle, left});
        finer.push_back({middle, e.b, left});
      }
    }
  }

  std::vector<Real> sharpness;  ///< sharpness of each edge, as they are numbered
  std::vector<Crease> finer;    ///< creases of the mesh one level finer
};

}  // namespace trace
