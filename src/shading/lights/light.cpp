#include "shading/lights/light.h"

#include "math/elementary.h"

namespace trace {

const Vec3* Light::position() const { return findValue<Vec3>(*this, "position"); }
const Vec3* Light::direction() const { return findValue<Vec3>(*this, "direction"); }
const Color* Light::color() const { return findValue<Color>(*this, "color"); }

bool Light::visible() const {
  const bool* visible = findValue<bool>(*this, "visible");
  return visible && *visible;
}

LightGeometry geometryOf(const Light& light) {
  LightGeometry geometry;
  geometry.starts = light.type().starts;
  const Vec3* direction = nullptr;
  const Real* angle = nullptr;
  forEachField(light, [&]<class Value>(const LightField& field, const Value& value) {
    const std::string_view keyword = field.keyword;
    if constexpr (std::is_same_v<Value, Vec3>) {
      if (keyword == "position") geometry.position = value;
      if (keyword == "u") geometry.u = value;
      if (keyword == "v") geometry.v = value;
      if (keyword == "direction") direction = &value;
    } else if constexpr (std::is_same_v<Value, Real>) {
      if (keyword == "radius") geometry.radius = value;
      if (keyword == "angle") angle = &value;
    } else if constexpr (std::is_same_v<Value, bool>) {
      if (keyword == "round") geometry.round = value;
      if (keyword == "two_sided") geometry.twoSided = value;
    }
  });
  if (direction && angle)
    geometry.cone = LightCone{normalize(*direction), *angle, math::cos(*angle * kPi / 180)};
  return geometry;
}

}  // namespace trace
