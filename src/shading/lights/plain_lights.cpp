#include "shading/lights/plain_lights.h"

#include "shading/lights/ambient_light.h"
#include "shading/lights/directional_light.h"
#include "shading/lights/point_light.h"
#include "shading/lights/spot_light.h"

namespace trace {

Light pointLight(const Vec3& position, const Color& color, const Fading& fading, Real radius,
                 const Color& extraHighlight) {
  return PointLight{.position = position,
                    .color = color,
                    .constant = fading.constant,
                    .linear = fading.linear,
                    .quadratic = fading.quadratic,
                    .extraHighlight = extraHighlight,
                    .radius = radius};
}

Light spotLight(const Vec3& position, const Vec3& direction, const Color& color, const SpotCone& cone,
                const Fading& fading, Real radius) {
  return SpotLight{.position = position,
                   .direction = direction,
                   .color = color,
                   .angle = cone.angle,
                   .fullAngle = cone.fullAngle,
                   .edge = cone.smooth ? SpotEdge::smooth : SpotEdge::linear,
                   .exponent = cone.exponent,
                   .constant = fading.constant,
                   .linear = fading.linear,
                   .quadratic = fading.quadratic,
                   .radius = radius};
}

Light directionalLight(const Vec3& direction, const Color& color, Real size) {
  return DirectionalLight{.direction = direction, .color = color, .size = size};
}

Light ambientLight(const Color& color) { return AmbientLight{color}; }

bool isSpot(const Light& light) { return light.is<SpotLight>(); }
bool isAmbient(const Light& light) { return light.is<AmbientLight>(); }

}  // namespace trace
