#include "geometry/placed.h"

#include <algorithm>
#include <vector>

#include "geometry/csg_tree.h"

namespace trace {

// Here, where every form is complete.
static_assert([] {
  bool all = true;
  forEachType<TracedShape>([&]<class T>(T*) {
    if constexpr (!std::is_same_v<T, Mesh>)
      all = all && Traceable<std::remove_cvref_t<decltype(formOf(std::declval<T>()))>>;
  });
  return all;
}());

namespace {

/// The line of the ray in both directions from its origin. A triangle that the mesh's hierarchy holds in
/// parts is met once.
void meshCrossings(const MeshTree& mesh, const Ray& ray, const VisitCrossing& visit) {
  NodeCount nodes;
  std::uint64_t triangles = 0;
  for (const Real side : {1.0, -1.0}) {
    std::vector<Crossing> met;
    const auto add = [&](const MeshHit& m) { return met.push_back({side * m.hit.t, m.triangle}), false; };
    mesh.crossings({ray.origin, ray.direction * side}, kInfinity, add, {nodes, triangles});
    std::sort(met.begin(), met.end(), [](const Crossing& a, const Crossing& b) { return a.part < b.part; });
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

std::shared_ptr<const MeshTree> treeOf(std::shared_ptr<const MeshData> data) {
  if (data->generateNormals) data = std::make_shared<const MeshData>(withGeneratedNormals(*data, true));
  return std::make_shared<const MeshTree>(data, false);
}

}  // namespace

Placed::Placed(const Shape& shape, const Affine& outFromIn, const MeshTrees& made)
    : shape_(prepare(shape, made)), placement_(outFromIn) {
  const Box3 box = match(shape_, Overloaded{[&](const Mesh& mesh) {
                                              const auto known = made.find(mesh.data.get());
                                              mesh_ = known == made.end() ? treeOf(mesh.data) : known->second;
                                              return trace::bounds(mesh_->data());
                                            },
                                            [](const auto& form) { return formOf(form).bounds(); }});
  approach_ = Approach(box);
  constexpr Box3 kEverywhere{{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}};
  bounds_ = box.unbounded() ? kEverywhere : outFromIn * box;
}

bool Placed::solid() const {
  return match(shape_, Overloaded{[](const Mesh&) { return true; },
                                  [](const auto& form) { return formOf(form).solid(); }});
}

std::int64_t Placed::partCount() const {
  return match(shape_, Overloaded{[&](const Mesh&) {
                                    return static_cast<std::int64_t>(mesh_->data().triangles.size());
                                  },
                                  [](const auto& form) {
                                    if constexpr (requires { formOf(form).partCount(); })
                                      return formOf(form).partCount();
                                    else
                                      return std::int64_t{1} << 24;
                                  }});
}

void Placed::crossings(const Ray& ray, VisitCrossing visit) const {
  const Ray in = inner(ray);
  match(shape_, Overloaded{[&](const Mesh&) { meshCrossings(*mesh_, in, visit); },
                           [&](const auto& form) {
                             const Real everywhere = kInfinity;
                             visitCrossings(form, approach_, in, Range{-kInfinity, everywhere}, visit);
                           }});
}

SurfacePoint Placed::surface(const Ray& ray, const Crossing& crossing) const {
  const Ray in = inner(ray);
  const SurfacePoint s =
      match(shape_, Overloaded{[&](const Mesh&) { return meshSurface(*mesh_, in, crossing); },
                               [&](const auto& form) { return surfaceOf(form, approach_, in, crossing); }});
  return placement_.outOf(s);
}

}  // namespace trace
