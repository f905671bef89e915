#include "render/world/world.h"

#include <algorithm>
#include <set>

#include "base/match.h"

namespace trace {

const Bsdf& World::clear() {
  static const Bsdf kClear = [] {
    PhongBsdf phong;
    phong.transmissive = Color(1);
    return phong;
  }();
  return kClear;
}

MaterialMix World::mixOfParts(const Instance& instance, const Found& found) const {
  if (instance.mesh) {
    const MeshData& data = instance.mesh->data();
    const Triangle& t = data.triangles[found.part];
    const Real* b = found.triangle.b;
    return {{data.materials[t[0]], data.materials[t[1]], data.materials[t[2]]}, {b[0], b[1], b[2]}, 3};
  }
  return shapes_[instance.form].material(static_cast<std::int64_t>(found.part), instance.material);
}

Bsdf World::mixedAt(std::uint32_t object, std::uint64_t part, const MaterialMix& m,
                    const SurfacePoint& surface, const Differentials* arrived) const {
  const bool hasTextures = textured(m);
  const TexturePlace at = hasTextures ? place(object, part, surface, arrived) : TexturePlace();
  const auto of = [&](std::uint32_t material) {
    const Material* textured = material == MaterialMix::kClear ? nullptr : surfaces_[material].textured.get();
    return textured ? bsdfOf(*textured, at, rules_) : bsdf(material);
  };
  if (m.count == 1) return of(m.material[0]);
  return mix(of(m.material[0]), of(m.material[1]), of(m.material[2]), m.weight);
}

bool World::sendsOnOf(const Instance& instance, bool varnish, bool follow) const {
  std::vector<std::uint32_t> used{instance.material};
  if (!instance.mesh) {
    shapes_[instance.form].addMaterials(used);
  } else {
    used.insert(used.end(), instance.mesh->data().materials.begin(), instance.mesh->data().materials.end());
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
  }
  return std::any_of(used.begin(), used.end(), [&](std::uint32_t m) {
    if (m == MaterialMix::kClear) return false;
    const Bsdf& bsdf = surfaces_[m].bsdf;
    const WhittedTerms& terms = whitted(bsdf);
    if (varnish && !terms.transmits() && terms.index != 1) return true;
    // A texture may make it smooth in places.
    if (follow && isGlossy(bsdf) && !surfaces_[m].textured) return false;
    return terms.mirrors() || terms.transmits();
  });
}

bool World::shadows(const MaterialMix& materials) const {
  const auto casts = [&](int i) {
    const std::uint32_t material = materials.material[i];
    return material == MaterialMix::kClear || surfaces_[material].castsShadow;
  };
  if (materials.count == 1) return casts(0);
  Real share = 0;
  for (int i = 0; i < materials.count; ++i) share += casts(i) ? materials.weight[i] : 0;
  return share >= 0.5;
}

PlaceBsdf World::bsdfAt(const Ray& ray, const Found& found) const {
  static const SurfacePoint kNotAsked;
  MaterialMix materials = materialMix(found);
  const auto at = [&](const SurfacePoint& point) {
    if (hasHoles_) pierce(found.object, found.part, point, materials);
    return shade(found.object, found.part, materials, point, nullptr);
  };
  return textured(materials) ? at(surface(ray, found)) : at(kNotAsked);
}

Real World::opacityAt(const Ray& ray, const Found& found) const {
  if (!hasHoles_ || opaque(found.object)) return 1;
  MaterialMix materials = materialMix(found);
  return pierce(found.object, found.part, textured(materials) ? surface(ray, found) : SurfacePoint(),
                materials);
}

Real World::pierce(std::uint32_t object, std::uint64_t part, const SurfacePoint& surface,
                   MaterialMix& materials) const {
  const auto of = [&](std::uint32_t material) {
    if (material == MaterialMix::kClear || !surfaces_[material].hasHoles) return 1.0;
    const Surface& s = surfaces_[material];
    const Texture* texture = s.textured ? textureOf(s.textured->textures, kOpacity) : nullptr;
    const Real share = texture ? luminance(texture->at(place(object, part, surface, nullptr))) : 1;
    return std::clamp(s.opacity * share, 0.0, 1.0);
  };
  if (materials.count == 1) return of(materials.material[0]);
  Real there[3], all = 0;
  for (int i = 0; i < 3; ++i) all += there[i] = materials.weight[i] * of(materials.material[i]);
  if (!(all > 0) || !(all < 1)) return all > 0 ? 1 : 0;
  for (int i = 0; i < 3; ++i) materials.weight[i] = there[i] / all;
  return all;
}

// --- what is inside -----------------------------------------------------------------------------------

Filling World::filling(const Hit& hit, const WhittedTerms& terms, const Settings& settings) const {
  const auto filled = [&](const WhittedTerms& t, std::uint32_t material) {
    Filling filling;
    filling.object = hit.object;
    filling.priority = t.priority;
    filling.index = t.index;
    filling.passes = settings.glass == Glass::perDistance ? t.transmissive * t.attenuation : t.attenuation;
    filling.dispersion = t.dispersion;
    filling.kind = material == MaterialMix::kClear ? Filling::kAir : surfaces_[material].kind;
    return filling;
  };
  const Instance& instance = instanceOf(hit.object);
  if (!nestedGlass_ || !instance.mixed || instance.mesh) return filled(terms, hit.materials.material[0]);
  const MaterialMix inside =
      shapes_[instance.form].inside(static_cast<std::int64_t>(hit.part), instance.material);
  return filled(whitted(*shade(hit.object, hit.part, inside, hit.surface, nullptr)), inside.material[0]);
}

Medium World::mediumAt(const MediumBody& body, const Vec3& point) const {
  if (body.model.uniform()) return body.model.most();
  TexturePlace place{};
  const Instance& instance = objects_[body.object];
  place.point = instance.patternsInWorld ? point : instance.placement.inFromOut() * point;
  return body.model.at(place);
}

Interfaces World::interfacesAt(const Vec3& point, const Settings& settings) const {
  Interfaces inside(settings.airIndex, nestedGlass_);
  const auto mayHold = [&](std::uint32_t object) {
    const Box3& bounds = objects_[object].bounds;
    return bounds.empty() || bounds.contains(point);  // an infinite object has no bounds
  };
  if (!placedHold_ && std::none_of(glass_.begin(), glass_.end(), mayHold)) return inside;
  // A line from inside a body leaves it before it enters it.
  const Ray ray{point, normalize(Vec3{0.36, 0.48, 0.8})};
  std::vector<Found> all;
  Statistics uncounted;
  crossings(ray, kInfinity, Faces::both, uncounted, [&](const Found& found) {
    all.push_back(found);
    return false;
  });
  std::sort(all.begin(), all.end(), [](const Found& a, const Found& b) { return a.before(b); });
  std::set<std::uint32_t> met;
  std::vector<Filling> around;
  for (const Found& found : all) {
    if (!instanceOf(found.object).holds) continue;
    if (opaque(found.object) || !solid(found.object) || !met.insert(found.object).second) continue;
    const Hit hit(*this, ray, found);
    const PlaceBsdf bsdf = shade(hit);
    if (hit.leaving && whitted(*bsdf).transmits() && whitted(*bsdf).encloses(true))
      around.push_back(filling(hit, whitted(*bsdf), settings));
  }
  // The one that is left last is the outermost.
  for (auto body = around.rbegin(); body != around.rend(); ++body) inside.startInside(*body);
  return inside;
}

std::size_t World::triangleCount() const {
  std::size_t count = 0;
  for (const Instance& instance : objects_)
    if (instance.mesh) count += instance.mesh->data().triangles.size();
  return count;
}

std::size_t World::placementCount() const {
  std::size_t count = 0;
  for (const Uses& uses : uses_) count += uses.list->size();
  return count;
}

std::size_t World::bytes() const {
  std::size_t sum = bvh_->bytes();
  const auto add = [&](const std::vector<Uses>& uses) {
    for (const Uses& u : uses) sum += u.list->size() * sizeof(GroupUse);
  };
  add(uses_);
  for (const Group& group : groups_) {
    sum += group.bvh->bytes();
    add(group.uses);
  }
  std::set<const MeshTree*> counted;
  for (const Instance& instance : objects_)
    if (instance.mesh && counted.insert(instance.mesh.get()).second) sum += instance.mesh->bytes();
  return sum;
}

}  // namespace trace
