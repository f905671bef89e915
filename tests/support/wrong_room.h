// The room that wrong tracers render: whatever a term, an option or a value of it changes is seen somewhere.
#pragma once

#include <string>

namespace trace::test {

/// A floor, a mirror, a glass ball, and things with highlights, in the light of two lamps. `settings` is text
/// between the braces of its settings.
inline std::string wrongRoom(const std::string& settings = "") {
  return "SBT-raytracer 1.0\nsettings { " + settings + " }\n" +
         R"(camera { position = (0, 2.4, 7); look_at = (0, 0.7, 0); fov = 36; aspectratio = 1.5; }
point_light { name = "key"; position = (-3, 5, 4); color = (0.7, 0.66, 0.6); constant_attenuation_coeff = 0.4; linear_attenuation_coeff = 0.1; quadratic_attenuation_coeff = 0; }
directional_light { name = "sun"; direction = (-0.6, -1, -0.3); color = (0.3, 0.32, 0.4); }
ambient_light { color = (0.3, 0.3, 0.34); }
material = { ambient = (0.5, 0.45, 0.4); diffuse = (0.6, 0.55, 0.5); }
rotate(1, 0, 0, -1.5708, scale(20, 20, 1, square { name = "floor"; }))
translate(0, 1.5, -3, scale(5, 3, 1, square { name = "mirror"; material = { reflective = (0.8, 0.8, 0.8); diffuse = (0.05, 0.05, 0.05); } }))
translate(-1.4, 0.7, 0, scale(0.7, sphere { name = "ball"; material = { ambient = (0.4, 0.1, 0.1); diffuse = (0.7, 0.2, 0.15); specular = (0.6, 0.6, 0.6); shininess = 20; reflective = (0, 0, 0); } }))
translate(0.3, 0.6, 1.2, scale(0.6, sphere { name = "glass"; material = { transmissive = (0.9, 0.95, 0.9); index = 1.5; specular = (0.5, 0.5, 0.5); shininess = 60; reflective = (0.08, 0.08, 0.08); } }))
translate(1.7, 0.6, 0.2, rotate(0, 1, 0, 0.5, scale(1.2, box { name = "box"; material = { ambient = (0.1, 0.2, 0.4); diffuse = (0.2, 0.4, 0.7); specular = (0.3, 0.3, 0.3); shininess = 8; } })))
)";
}

}  // namespace trace::test
