#include "render/maps/illumination_map.h"

#include <algorithm>
#include <cmath>

#include "geometry/mesh/mesh_tree.h"
#include "render/world/world.h"

namespace trace {

std::optional<IlluminationMap::Place> IlluminationMap::place(const World& world, const Ray& ray,
                                                             const Hit& hit) const {
  const MeshTree* mesh = world.meshTree(hit.object);
  const Vec2 uv = hit.surface.uv;
  const auto within = [](Real x) { return 0 <= x && x <= 1; };
  if (side_ == 0 || (mesh && mesh->data().uvs.empty()) || !within(uv.x) || !within(uv.y)) return {};
  const SurfaceSlopes slopes = world.slopes(hit);
  const Vec3 outward = cross(slopes.u, slopes.v);
  const Real texelsPerArea = length(outward);
  if (!(texelsPerArea > 0) || !std::isfinite(texelsPerArea)) return {};
  return Place{hit.object, mesh ? 0 : hit.part, dot(outward, ray.direction) > 0, uv, 1 / texelsPerArea};
}

IlluminationMap::Near IlluminationMap::near(const Vec2& uv) const {
  const auto axis = [&](Real x) {
    const Real at = std::clamp(x * side_ - 0.5, 0.0, side_ - 1.0);
    const auto first = static_cast<std::size_t>(at);
    const std::size_t second = std::min(first + 1, static_cast<std::size_t>(side_) - 1);
    return std::tuple(first, second, at - static_cast<Real>(first));
  };
  const auto [x0, x1, x] = axis(uv.x);
  const auto [y0, y1, y] = axis(uv.y);
  const auto row = static_cast<std::size_t>(side_);
  return {{y0 * row + x0, y0 * row + x1, y1 * row + x0, y1 * row + x1},
          {(1 - y) * (1 - x), (1 - y) * x, y * (1 - x), y * x}};
}

void IlluminationMap::add(const Place& place, const Color& power) {
  std::vector<Color>& map = maps_[place.surface()];
  if (map.empty()) map.resize(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_));
  const Near texels = near(place.uv);
  for (int i = 0; i < 4; ++i) map[texels.texel[i]] += power * texels.weight[i];
}

Color IlluminationMap::at(const Place& place) const {
  const auto map = maps_.find(place.surface());
  if (map == maps_.end()) return Color(0);
  const Near texels = near(place.uv);
  Color power;
  for (int i = 0; i < 4; ++i) power += map->second[texels.texel[i]] * texels.weight[i];
  return power * (static_cast<Real>(side_) * static_cast<Real>(side_) / place.area);
}

}  // namespace trace
