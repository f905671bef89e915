// Lights of every kind, for tests of what every light has to do.
#pragma once

#include <utility>
#include <vector>

#include "shading/lights/directional_light.h"
#include "shading/lights/light.h"
#include "shading/lights/point_light.h"
#include "shading/lights/rectangle_light.h"
#include "shading/lights/spot_light.h"

namespace trace::test {

/// For a corner of about two units around the origin, open to +y and +z.
inline std::vector<std::pair<const char*, Light>> lightsOfEveryKind() {
  return {
      {"point", PointLight{.position = {0.5, 1.5, 0.8}, .color = Color(1)}},
      {"another law of distance",
       PointLight{
           .position = {0.5, 1.5, 0.8}, .color = Color(1), .constant = 0.5, .linear = 0.3, .quadratic = 0}},
      {"far point", PointLight{.position = {4, 15, 12}, .color = Color(300)}},
      {"ball", PointLight{.position = {0.5, 1.5, 0.8}, .color = Color(1), .radius = 0.3}},
      {"spot", SpotLight{.position = {0.5, 1.8, 0.8},
                         .direction = {-0.4, -1, -0.5},
                         .color = Color(1),
                         .angle = 40,
                         .fullAngle = 20,
                         .exponent = 3}},
      {"sun", DirectionalLight{.direction = {-0.3, -1, -0.6}, .color = Color(1)}},
      {"broad sun", DirectionalLight{.direction = {-0.3, -1, -0.6}, .color = Color(1), .size = 20}},
      {"panel",
       RectangleLight{.position = {0.2, 1.6, 0.3}, .u = {1, 0, 0}, .v = {0, 0, 1}, .color = Color(3)}},
      {"round panel", RectangleLight{.position = {0.2, 1.2, 0.3},
                                     .u = {1, 0, 0},
                                     .v = {0, 0.6, 0.6},
                                     .color = Color(3),
                                     .round = true,
                                     .twoSided = true}}};
}

}  // namespace trace::test
