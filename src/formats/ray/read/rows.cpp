// Rows of .ray files: copies of the objects of a block, which may be rows themselves, and of its lights.
#include "scene/rows.h"

#include <cmath>
#include <optional>
#include <utility>

#include "base/budget.h"
#include "base/text.h"
#include "formats/ray/read/fields.h"
#include "formats/ray/read/light.h"
#include "formats/ray/read/objects.h"
#include "shading/lights/warn_light.h"

namespace trace::rayfile {
namespace {

/// A copy of a light, which has a place: its flaps go along, and what it lights from grows with its size.
LightSource movedLight(LightSource source, const Rows::Copy& copy) {
  Light& light = source.light;
  if (Vec3* position = editableValue<Vec3>(light, "position")) *position = copy.place + copy.size * *position;
  if (Real* radius = editableValue<Real>(light, "radius")) *radius *= copy.size;
  for (const std::string_view edge : {"u", "v"})
    if (Vec3* vector = editableValue<Vec3>(light, edge)) *vector = *vector * copy.size;
  if (WarnLight* warn = light.edit<WarnLight>()) {
    const auto shift = [&](Real& low, Real& high, Real by) {
      low = low * copy.size + by, high = high * copy.size + by;
    };
    shift(warn->xMin, warn->xMax, copy.place.x);
    shift(warn->yMin, warn->yMax, copy.place.y);
    shift(warn->zMin, warn->zMax, copy.place.z);
  }
  return source;
}

bool hasPlace(const LightSource& source) { return source.light.position() != nullptr; }

}  // namespace

void ObjectReader::rows(const Item& call, const Affine& worldFromObject) {
  const NestedSolid nested(*this, call, true);
  if (!nested) return;
  const std::optional<Item> block = blockOf(findings_, call);
  if (!block) return;
  Rows rows;
  NotedMaterial material = materials_.current;
  std::vector<Item> shown;
  for (const Item item : *block) {
    if (isObject(item) || (item.is(Kind::call) && (item.key() == Rows::kKeyword || isLight(item.key())))) {
      shown.push_back(item);
    } else if (!isField(findings_, item, call.key())) {
      continue;
    } else if (item.key() == Material::kKeyword) {
      material = materials_.read(item.value(), materials_.current);
    } else if (assignField(findings_, rows, item)) {
      checkRange(findings_, rows, item);
    } else {
      findings_.unknownField(Rows::kKeyword, item, keywords<Rows>({"material"}));
    }
  }
  if (shown.empty()) return findings_.warn(call, "rows without objects are empty");
  const NotedMaterial outside = std::exchange(materials_.current, material);
  std::vector<Object> copied = std::exchange(scene_.objects, {});
  std::vector<LightSource> lights = std::exchange(scene_.lights, {});
  for (const Item& item : shown)
    if (!(worldFromObject == Affine{}) || !item.is(Kind::call) || !readLight(findings_, item))
      object(item, {});
  copied.swap(scene_.objects);
  lights.swap(scene_.lights);
  materials_.current = outside;

  if (copied.empty() && lights.empty()) return;  // the block has told why

  const Vec3& n = rows.count;
  for (const Real count : {n.x, n.y, n.z})
    if (!(count >= 1) || count != std::floor(count))
      return findings_.error(call,
                             "rows: expected whole numbers of copies, at least 1, found " + toText(count));
  if (!(n.x * n.y * n.z * static_cast<Real>(copied.size() + lights.size()) <= Rows::kMostObjects))
    throw Error(Fault::limit, syntax_.place(call.offset()),
                "rows: " + toText(n.x) + " x " + toText(n.y) + " x " + toText(n.z) + " copies of " +
                    std::to_string(copied.size() + lights.size()) + " objects are more than " +
                    toText(Rows::kMostObjects) + " objects",
                "give a smaller count");
  for (const LightSource& source : lights)
    if (!hasPlace(source)) scene_.lights.push_back(source);  // once: it comes from everywhere or from afar
  for (int x = 0; x < static_cast<int>(n.x); ++x)
    for (int y = 0; y < static_cast<int>(n.y); ++y)
      for (int z = 0; z < static_cast<int>(n.z); ++z) {
        checkBudget();
        const Rows::Copy copy = rows.copy(x, y, z);
        const Affine placed =
            Affine::translation(copy.place) * Affine::scaling({copy.size, copy.size, copy.size});
        for (const LightSource& source : lights)
          if (hasPlace(source)) scene_.lights.push_back(movedLight(source, copy));
        for (Object o : copied) {
          o.worldFromObject = worldFromObject * placed * o.worldFromObject;
          add(call, std::move(o));
        }
      }
}

}  // namespace trace::rayfile
