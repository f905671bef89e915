// Bump mapping: the normal for shading is that of the surface with the heights of a texture on it (Blinn,
// Simulation of Wrinkled Surfaces, SIGGRAPH 1978), by the gradient of the heights along the surface
// (Mikkelsen, Bump Mapping Unparametrized Surfaces on the GPU, 2010), for textures in space and in u and v
// alike. A picture of normals says them itself (shading/normal_map.h).
#include "math/perpendicular.h"
#include "render/world/world.h"
#include "shading/materials/principled.h"
#include "shading/normal_map.h"
#include "shading/optics/optics.h"
#include "shading/textures/image_map.h"

namespace trace {
namespace {

constexpr std::string_view kBump = "bump";

/// A ray that is mirrored there stays on its side of the true surface, and the eye sees the front.
bool sane(const Vec3& normal, const Vec3& direction, const Vec3& trueNormal) {
  const Real side = dot(direction, trueNormal) > 0 ? -1 : 1;
  return dot(direction, normal) * side < 0 && dot(mirrored(direction, normal), trueNormal) * side > 0;
}

/// The bent normal, or, where a grazing ray would be mirrored into the surface, the most of it that is sane.
Vec3 saneNormal(const Vec3& plain, const Vec3& bent, const Vec3& direction, const Vec3& trueNormal) {
  if (sane(bent, direction, trueNormal)) return bent;
  constexpr int kHalvings = 12;
  Vec3 best = plain;
  Real low = 0, high = 1;
  for (int i = 0; i < kHalvings; ++i) {
    const Real middle = (low + high) / 2;
    const Vec3 between = normalize(plain * (1 - middle) + bent * middle);
    if (sane(between, direction, trueNormal)) {
      low = middle;
      best = between;
    } else
      high = middle;
  }
  return best;
}

/// Null unless the texture is a picture of normals.
const ImageMap* normalMap(const Texture& texture) {
  const auto* map = texture->model.as<ImageMap>();
  return map && map->relief != Relief::heights ? map : nullptr;
}

/// A material's own textures and heights, up to three where a mesh mixes materials.
struct BumpHeights {
  struct Part {
    const Texture* texture;
    Real height;
  };
  Part parts[3];
  int count = 0;
  bool inUv = false, inSecondUv = false;

  void add(const Texture& texture, Real height) {
    parts[count++] = {&texture, height};
    inUv |= wantsUv(texture);
    inSecondUv |= wantsSecondUv(texture);
  }
  Real at(const TexturePlace& place) const {
    Real height = 0;
    for (int i = 0; i < count; ++i) height += parts[i].height * luminance(parts[i].texture->at(place));
    return height;
  }
};

const Principled* apart(const Material* material) {
  const auto* model = material ? material->model.as<Principled>() : nullptr;
  return model && model->clearcoat > 0 && model->clearcoatApart ? model : nullptr;
}

}  // namespace

void World::bend(const Ray& ray, Hit& hit) const {
  bool coatApart = false, bumped = false;
  for (int i = 0; i < hit.materials.count; ++i) {
    const std::uint32_t m = hit.materials.material[i];
    const Material* material = m == MaterialMix::kClear ? nullptr : surfaces_[m].textured.get();
    coatApart |= apart(material) != nullptr;
    bumped |= material && textureOf(material->textures, kBump);
  }
  if (coatApart) hit.coat = bentNormal(ray, hit, Bent::coat);
  if (bumped) hit.surface.shading = bentNormal(ray, hit, Bent::surface);
}

Vec3 World::bentNormal(const Ray& ray, const Hit& hit, Bent what) const {
  BumpHeights heights;
  const SurfacePoint& surface = hit.surface;
  const Vec3 smooth = surface.shading;
  Vec3 turned;  // how far pictures of normals turn it
  for (int i = 0; i < hit.materials.count; ++i) {
    const std::uint32_t m = hit.materials.material[i];
    const Material* material = m == MaterialMix::kClear ? nullptr : surfaces_[m].textured.get();
    const Principled* coat = what == Bent::coat ? apart(material) : nullptr;
    if (!material || (what == Bent::coat && !coat)) continue;
    const Texture* texture = textureOf(material->textures, coat ? "clearcoat_bump" : kBump);
    if (!texture) continue;
    const Real scale = coat ? coat->clearcoatBump : material->bump;
    const Real share = hit.materials.count == 1 ? 1 : hit.materials.weight[i];
    if (const ImageMap* map = normalMap(*texture)) {
      const bool down = map->relief == Relief::normalsDown;
      const Color texel = texture->at(place(hit));
      const std::optional<TangentFrame> given = givenFrame(hit);
      const TangentFrame frame = given           ? *given
                                 : map->secondUv ? secondSlopes(hit).frame()
                                                 : slopes(hit).frame();
      turned += (mappedNormal(texel, frame, smooth, scale, down) - smooth) * share;
    } else
      heights.add(*texture, scale * share);
  }
  Vec3 shading = smooth;
  if (turned != Vec3{} && isFinite(turned))
    shading = saneNormal(smooth, normalize(smooth + turned), ray.direction, surface.normal);
  if (heights.count == 0) return shading;

  // Heights are measured in the space of the object, along steps a thousandth of its size.
  const Instance& instance = instanceOf(hit.object);
  const Affine out = worldFromObject(hit.object), in = objectFromWorld(hit.object);
  Box3 bounds = instance.bounds;
  if (hit.object >= plain_ && !bounds.unbounded() && !bounds.empty())
    bounds = out * instance.placement.inFromOut() * bounds;  // from the group to the world
  const Real size = bounds.unbounded() || bounds.empty()
                        ? maxComponent(abs(out.row[0]) + abs(out.row[1]) + abs(out.row[2]))
                        : maxComponent(bounds.size());
  const Vec3 normal = normalize(transposed(out, shading));
  const Vec3 first = perpendicularTo(normal);
  const SurfaceSlopes along = heights.inUv ? slopes(hit) : SurfaceSlopes{};
  const SurfaceSlopes second = heights.inSecondUv ? secondSlopes(hit) : along;
  const TexturePlace here = place(hit);
  const Real height = heights.at(here);
  Vec3 gradient;
  for (const Vec3& tangent : {first, cross(normal, first)}) {
    const Vec3 across = linear(out, tangent);  // across of unit length in the object
    const Real step = size * 0x1p-10 / length(across);
    const auto moved = [&](const Vec2& uv, const SurfaceSlopes& by) {
      return Vec2{uv.x + dot(by.u, across) * step, uv.y + dot(by.v, across) * step};
    };
    TexturePlace there = here;
    there.point += (instance.patternsInWorld ? across : tangent) * step;
    there.uv = moved(here.uv, along);
    there.secondUv = moved(here.secondUv, second);
    gradient += tangent * ((heights.at(there) - height) / step);
  }
  if (gradient == Vec3{} || !isFinite(gradient)) return shading;
  const Vec3 bent = normalize(transposed(in, normal - gradient));
  return saneNormal(shading, bent, ray.direction, surface.normal);
}

}  // namespace trace
