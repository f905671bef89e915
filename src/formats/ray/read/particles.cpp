// Particles of .ray files: each is the objects of the block, at its place, in its size and shade.
#include "scene/particles.h"

#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "base/budget.h"
#include "formats/ray/read/fields.h"
#include "formats/ray/read/objects.h"
#include "geometry/shapes/solids/sphere.h"

namespace trace::rayfile {
namespace {

void tint(Material& material, const Color& color) {
  changeColors(material.model, {kEmissive, kAmbient, kDiffuse, kColor},
               [&](const Color& own) { return own * color; });
}

}  // namespace

void ObjectReader::particles(const Item& call, const Affine& worldFromObject) {
  const NestedSolid nested(*this, call, true);
  if (!nested) return;
  const std::optional<Item> block = blockOf(findings_, call);
  if (!block) return;
  Particles system;
  NotedMaterial material = materials_.current;
  std::vector<Item> shown;
  for (const Item item : *block) {
    if (isObject(item)) {
      shown.push_back(item);
    } else if (!isField(findings_, item, call.key())) {
      continue;
    } else if (item.key() == Material::kKeyword) {
      material = materials_.read(item.value(), materials_.current);
    } else if (assignField(findings_, system, item)) {
      checkRange(findings_, system, item);
    } else {
      findings_.unknownField(Particles::kKeyword, item, keywords<Particles>({"material"}));
    }
  }
  std::vector<Particle> alive;
  try {
    alive = particlesAt(system, time_.now());
  } catch (const Error& error) {
    if (error.fault() == Fault::limit) throw;
    return findings_.error(call, error.messages().front().what, error.messages().front().hint);
  }
  // The objects are read once for each shade, so that they take it as they take the material.
  constexpr int kShades = 32;
  constexpr std::size_t kMostObjects = 2'000'000;
  std::array<std::vector<Object>, kShades + 1> shades;
  const NotedMaterial outside = materials_.current;
  for (const Particle& particle : alive) {
    const auto shade = static_cast<std::size_t>(std::lround(particle.age * kShades));
    std::vector<Object>& objects = shades[shade];
    if (objects.empty()) {
      materials_.current = materials_.completed(material);
      materials_.current.block = NotedMaterial::kNoBlock;
      tint(materials_.current, lerp(static_cast<Real>(shade) / kShades, system.color, system.endColor));
      std::vector<Object> found = std::exchange(scene_.objects, {});
      for (const Item& item : shown) object(item, {});
      if (shown.empty()) add(call, {{}, Sphere{}, {}, materials_.index(materials_.current), {}});
      found.swap(scene_.objects);
      objects = std::move(found);
      if (objects.empty()) break;  // nothing to show, and that is reported
    }
    if (alive.size() > kMostObjects / objects.size())
      throw Error(Fault::limit, syntax_.place(call.offset()),
                  "particles: " + std::to_string(alive.size()) + " particles of " +
                      std::to_string(objects.size()) + " objects are more than " +
                      std::to_string(kMostObjects) + " objects",
                  "give a lower rate, a shorter lifetime or fewer objects");
    checkBudget();
    const Real size = system.size + particle.age * (system.endSize - system.size);
    const Affine place = Affine::translation(particle.place) * Affine::scaling({size, size, size});
    for (Object o : objects) {
      o.worldFromObject = worldFromObject * place * o.worldFromObject;
      add(call, std::move(o));
    }
  }
  materials_.current = outside;
}

}  // namespace trace::rayfile
