#include "app/scene_model.h"

#include <algorithm>

#include "base/match.h"
#include "geometry/mesh.h"
#include "geometry/tessellate.h"

namespace trace {
namespace {

constexpr int kDivisions = 24;  // of a shape's longest side
constexpr Box3 kEverywhere{{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}};
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

/// Around the objects that have an end, and the camera; with room to spare if some have none.
Box3 frameOf(const Scene& scene) {
  Box3 frame;
  bool endless = false;
  for (const Object& object : scene.objects) {
    if (!invertible(object.worldFromObject)) continue;
    const Box3 box = drawnBounds(object.shape, kEverywhere);
    if (box.unbounded())
      endless = true;
    else
      frame.extend(object.worldFromObject * box);
  }
  if (frame.empty() || !endless) return frame;
  frame.extend(scene.camera.position);
  const Vec3 room = frame.size() / 2;
  return {frame.low - room, frame.high + room};
}

}  // namespace

SceneModeler::Corners SceneModeler::cornersOf(const Shape& shape, const Box3& within,
                                              std::vector<Made>& kept) const {
  const bool lasts = !drawnBounds(shape, kEverywhere).unbounded() && !shape.is<Mesh>();
  if (lasts) {
    const auto in = [&](const std::vector<Made>& list) {
      const auto found =
          std::find_if(list.begin(), list.end(), [&](const Made& made) { return made.shape == shape; });
      return found == list.end() ? nullptr : found->corners;
    };
    if (Corners corners = in(kept)) return corners;
    if (Corners corners = in(made_)) return kept.push_back({shape, corners}), corners;
  }
  Corners corners = std::make_shared<const std::vector<SurfaceCorner>>(tessellate(shape, kDivisions, within));
  if (lasts) kept.push_back({shape, corners});
  return corners;
}

SceneModel SceneModeler::model(const Scene& scene, const Cancelled& cancelled) {
  SceneModel model;
  const Box3 frame = frameOf(scene);
  if (!frame.empty()) {
    model.origin = frame.center();
    model.scale = std::max(length(frame.size()) / 2, 1e-30);
  }

  std::vector<Made> kept;
  for (std::uint32_t i = 0; i < scene.objects.size() && !(cancelled && cancelled()); ++i) {
    const Object& object = scene.objects[i];
    if (!invertible(object.worldFromObject) || object.material >= scene.materials.size()) continue;
    const Affine objectFromWorld = inverse(object.worldFromObject);
    Box3 within = frame.empty() ? kFarthest : objectFromWorld * frame;
    within.extend(Vec3{});  // through which a plane goes
    const Corners corners = cornersOf(object.shape, within, kept);

    const MaterialModel& material = scene.materials[object.material].model;
    ScenePart part{i,
                   lookOf(material),
                   match(material, [](const auto& m) { return m.transmits(); }),
                   model.corners.size() / 6,
                   corners->size(),
                   {}};
    const Box3 bounds = drawnBounds(object.shape, within);
    for (std::size_t corner = 0; corner < 8; ++corner)
      part.box[corner] = object.worldFromObject * Vec3{corner & 1 ? bounds.high.x : bounds.low.x,
                                                       corner & 2 ? bounds.high.y : bounds.low.y,
                                                       corner & 4 ? bounds.high.z : bounds.low.z};
    for (const SurfaceCorner& corner : *corners) {
      const auto p = model.local(object.worldFromObject * corner.point);
      const Vec3 n = normalize(transposed(objectFromWorld, corner.normal));
      for (const float x : p) model.corners.push_back(x);
      for (int axis = 0; axis < 3; ++axis) model.corners.push_back(static_cast<float>(n[axis]));
    }
    model.parts.push_back(part);
  }
  made_ = std::move(kept);
  return model;
}

Box3 seenBy(const World& world) {
  std::vector<Real> seen[3];
  Statistics statistics;
  Box3 near = world.bounds();  // beyond it there is only what has no end, up to the horizon
  const Vec3 room = near.size() / 2;
  near = {near.low - room, near.high + room};
  const auto place = [](int i) { return kAside + (1 - 2 * kAside) * (i + 0.5) / kLooks; };
  for (int y = 0; y < kLooks; ++y)
    for (int x = 0; x < kLooks; ++x) {
      const Ray ray = world.camera().ray({place(x), place(y)});
      const auto found = world.closest(ray, Faces::both, statistics);
      if (!found) continue;
      const Vec3 p = ray.at(found->t);
      if (!near.empty() && !near.contains(p)) continue;
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
