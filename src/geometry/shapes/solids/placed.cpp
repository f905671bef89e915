#include "geometry/shapes/solids/placed.h"

#include <algorithm>
#include <vector>

namespace trace {

namespace {

/// The line of the ray in both directions from its origin. A triangle that the mesh's hierarchy holds in
/// parts is hit once.
void meshCrossings(const MeshTree& mesh, const Ray& ray, const VisitCrossing& visit) {
  NodeCount nodes;
  std::uint64_t triangles = 0;
  for (const Real side : {1.0, -1.0}) {
    std::vector<Crossing> met;
    const auto add = [&](const MeshHit& m) {
      met.push_back({side * m.hit.t, m.triangle});
      return false;
    };
    mesh.crossings({ray.origin, ray.direction * side}, kInfinity, add, MeshCounts{nodes, triangles});
    std::sort(met.begin(), met.end(), [](const Crossing& a, const Crossing& b) {
      return a.part != b.part ? a.part < b.part : a.t < b.t;
    });
    for (std::size_t i = 0; i < met.size(); ++i)
      if (i == 0 || met[i].part != met[i - 1].part) visit(met[i]);
  }
}

SurfacePoint meshSurface(const MeshTree& mesh, const Ray& ray, const Crossing& crossing) {
  const auto triangle = static_cast<std::uint32_t>(crossing.part);
  const Real side = crossing.t < 0 ? -1 : 1;
  TriangleHit hit;
  locate({ray.origin, ray.direction * side}, corners(mesh.data(), triangle), kInfinity, hit);
  return surface(mesh.data(), triangle, hit);
}

std::shared_ptr<const MeshTree> meshTreeOf(std::shared_ptr<const MeshData> data) {
  if (data->generateNormals) data = std::make_shared<const MeshData>(withGeneratedNormals(*data, true));
  return std::make_shared<const MeshTree>(data, false);
}

}  // namespace

Box3 placedBounds(const Box3& bounds, const Affine& outFromIn) {
  constexpr Box3 kEverywhere{{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}};
  return bounds.unbounded() ? kEverywhere : outFromIn * bounds;
}

Placed::Placed(const Shape& shape, const Affine& outFromIn, const MeshTrees& made)
    : shape_(prepare(shape, made)), placement_(outFromIn) {
  if (const auto data = shape_.mesh()) {
    const auto known = made.find(data.get());
    mesh_ = known == made.end() ? meshTreeOf(data) : known->second;
  }
  bounds_ = placedBounds(mesh_ ? trace::bounds(mesh_->data()) : shape_.bounds(), outFromIn);
}

void Placed::crossings(const Ray& ray, VisitCrossing visit) const {
  const Ray in = inner(ray);
  if (mesh_) return meshCrossings(*mesh_, in, visit);
  const Real everywhere = kInfinity;
  shape_.crossings(in, Range{-kInfinity, everywhere}, visit);
}

SurfacePoint Placed::surface(const Ray& ray, const Crossing& crossing) const {
  const Ray in = inner(ray);
  return placement_.outOf(mesh_ ? meshSurface(*mesh_, in, crossing) : shape_.surface(in, crossing));
}

}  // namespace trace
