#include "app/scene_model.h"

#include <algorithm>

#include "base/match.h"
#include "geometry/tessellate.h"

namespace trace {
namespace {

constexpr int kLooks = 24;        // rays across and down, to find what a camera sees
constexpr double kAside = 0.2;    // share of the picture on each side that is not asked
constexpr double kFarOut = 0.15;  // share of the points seen that is left out on each side

/// Glass has hardly a colour of its own; what it lets through is shown instead.
Color lookOf(const MaterialModel& model) {
  return match(model, [](const auto& m) {
    const Color own = m.diffuse + m.ambient * 0.3 + m.emissive + (m.reflective + m.specular) * 0.3;
    return clamp01(own + m.transmissive * 0.8 + Color(0.06));
  });
}

}  // namespace

SceneModel modelOf(const Scene& scene) {
  SceneModel model;
  Box3 all;
  for (const Object& object : scene.objects)
    if (invertible(object.worldFromObject)) all.extend(object.worldFromObject * drawnBounds(object.shape));
  if (!all.empty() && isFinite(all.size())) {
    model.origin = all.center();
    model.scale = std::max(length(all.size()) / 2, 1e-30);
  }

  std::vector<std::pair<const Shape*, std::vector<SurfaceCorner>>> made;  // each shape once
  for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
    const Object& object = scene.objects[i];
    if (!invertible(object.worldFromObject) || object.material >= scene.materials.size()) continue;
    auto found =
        std::find_if(made.begin(), made.end(), [&](const auto& m) { return *m.first == object.shape; });
    if (found == made.end()) found = made.insert(made.end(), {&object.shape, tessellate(object.shape)});

    const MaterialModel& material = scene.materials[object.material].model;
    ScenePart part{i,
                   lookOf(material),
                   match(material, [](const auto& m) { return m.transmits(); }),
                   model.corners.size() / 6,
                   found->second.size(),
                   {}};
    const Box3 bounds = drawnBounds(object.shape);
    for (std::size_t corner = 0; corner < 8; ++corner)
      part.box[corner] = object.worldFromObject * Vec3{corner & 1 ? bounds.high.x : bounds.low.x,
                                                       corner & 2 ? bounds.high.y : bounds.low.y,
                                                       corner & 4 ? bounds.high.z : bounds.low.z};
    const Affine objectFromWorld = inverse(object.worldFromObject);
    for (const SurfaceCorner& corner : found->second) {
      const auto p = model.local(object.worldFromObject * corner.point);
      const Vec3 n = normalize(transposed(objectFromWorld, corner.normal));
      for (const float x : p) model.corners.push_back(x);
      for (int axis = 0; axis < 3; ++axis) model.corners.push_back(static_cast<float>(n[axis]));
    }
    model.parts.push_back(part);
  }
  return model;
}

Box3 seenBy(const World& world) {
  std::vector<Real> seen[3];
  Statistics statistics;
  const auto place = [](int i) { return kAside + (1 - 2 * kAside) * (i + 0.5) / kLooks; };
  for (int y = 0; y < kLooks; ++y)
    for (int x = 0; x < kLooks; ++x) {
      const Ray ray = world.camera().ray(place(x), place(y));
      const auto found = world.closest(ray, Faces::both, statistics);
      if (!found) continue;
      const Vec3 p = ray.at(found->t);
      for (int axis = 0; axis < 3; ++axis) seen[axis].push_back(p[axis]);
    }
  Box3 box;
  if (seen[0].empty()) return box;
  const auto last = static_cast<double>(seen[0].size() - 1);
  for (int axis = 0; axis < 3; ++axis) {
    std::sort(seen[axis].begin(), seen[axis].end());
    box.low[axis] = seen[axis][static_cast<std::size_t>(kFarOut * last)];
    box.high[axis] = seen[axis][static_cast<std::size_t>(std::ceil((1 - kFarOut) * last))];
  }
  return box;
}

bool sameSurfaces(const Scene& a, const Scene& b) {
  return std::equal(a.objects.begin(), a.objects.end(), b.objects.begin(), b.objects.end(),
                    [](const Object& x, const Object& y) {
                      return x.shape == y.shape && x.worldFromObject == y.worldFromObject;
                    });
}

}  // namespace trace
