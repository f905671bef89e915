// A light as a scene keeps it: of whatever type (shading/light_list.h has the list). It gives, for a point,
// where its light comes from and how much arrives there if nothing is in the way. Lights are not affected by
// transforms and are not objects.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <type_traits>

#include "base/find_field.h"
#include "base/listed.h"
#include "geometry/ray.h"
#include "math/color.h"
#include "math/vec.h"
#include "shading/lights/illumination.h"
#include "shading/lights/light_geometry.h"
#include "shading/lights/light_reach.h"
#include "shading/lights/light_seen.h"
#include "shading/lights/photometry.h"
#include "shading/pixels.h"
#include "shading/rules.h"

namespace trace {

/// A field of a light and where its value lies.
struct LightField : FieldValue<bool, Real, Vec3, Color, Pixels, PhotometryFile> {};

/// A row of the table of lights.
struct LightType : ListedRow<LightField> {
  LightOrigin starts;
  bool (*hasSize)(const void* light);
  std::optional<Illumination> (*illuminate)(const void* light, const Vec3& from, const Rules& rules,
                                            const Vec2& u);
  LightReach (*reach)(const void* light, const Rules& rules);
  /// Null where rays never see it; else it has a field `visible`.
  std::optional<LightSeen> (*seen)(const void* light, const Ray& ray, const Rules& rules);
};

std::span<const LightType> lightTypes();
/// Null if no light has that keyword.
const LightType* findLightType(std::string_view keyword);
template <>
const LightType& rowCalled<LightType>(std::string_view keyword);

/// Copies share their data.
class Light : public Listed<LightType, LightField> {
 public:
  using Listed::Listed;
  /// A point light.
  Light() : Listed(lightTypes().front()) {}

  /// Its light comes from more than one direction.
  bool hasSize() const { return type().hasSize(data()); }
  /// The light that arrives at a point, if nothing is in the way: from the place of the light that `u`
  /// chooses, two numbers from 0 up to 1.
  std::optional<Illumination> illuminate(const Vec3& from, const Rules& rules,
                                         const Vec2& u = kCenter) const {
    return type().illuminate(data(), from, rules, u);
  }
  /// Where it shines, for a choice among many.
  LightReach reach(const Rules& rules) const { return type().reach(data(), rules); }
  /// The radiance of a ray that hits it.
  std::optional<LightSeen> seen(const Ray& ray, const Rules& rules) const {
    return type().seen ? type().seen(data(), ray, rules) : std::nullopt;
  }

  // Fields that many lights have; null if it has none.
  const Vec3* position() const;
  const Vec3* direction() const;
  const Color* color() const;
  /// Rays see it.
  bool visible() const;
};

LightGeometry geometryOf(const Light& light);

/// Changes every picture of the light: change(Pixels&).
template <class Change>
void changePixels(Light& light, const Change& change) {
  editEachField(light, [&]<class Value>(const LightField&, Value& value) {
    if constexpr (std::is_same_v<Value, Pixels>) change(value);
  });
}

}  // namespace trace
