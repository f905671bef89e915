// The scene that `ray new` and the menu of the studio write.
#pragma once

#include <string>
#include <string_view>

namespace trace {

inline constexpr std::string_view kFirstScene = R"(Trace 1

// A first scene. `ray scene.ray` renders it, `ray gui scene.ray` opens it in the studio.
// Change a number, render again, and see what happens. `ray materials` lists what things can be made of.
// x goes to the right, y up, z toward you. Angles are in degrees.

// Names for what is used more than once.
let red = material { library = "red plastic" }
let high = 0.8

camera { position = (0, 2.6, 8.5); look_at = (0, 0.75, 0); fov = 32; aspectratio = 4 / 3 }

// The ground is the plane y = 0.
plane { material = { library = oak } }

// Objects are made at the origin and moved from there: the innermost step acts first.
translate(-1.6, 1, 0) { sphere { material = red } }
translate(1.9, high, 0.4) { scale(high) { sphere { material = { library = bronze } } } }
translate(0.4, high, -1.4) {
  rotate y 25 { scale(2 * high) { box { material = { library = "green marble" } } } }
}

// A loop: nine pearls on a circle. `i` counts from 0 to 8.
for i in 0..8 {
  rotate y (40 * i) {
    translate(0, 0.18, 2.6) { scale(0.18) { sphere { material = { library = porcelain } } } }
  }
}

// A scene without a light of its own gets a sky and a sun. Take the two strokes away to have a lamp instead.
// point_light { position = (-3, 5, 4); radius = 0.4 }
)";

/// A smaller one for courses.
inline constexpr std::string_view kSmallScene = R"(Trace 1

// A small scene for a course: a floor, a ball and a light, rendered by Whitted's tracer.
// The picture shows the numbers as they are: no exposure and no tone curve are added.
settings {
  integrator = whitted; spp = 1; depth = 5
  tone = clamp; auto-exposure = off
  denoise = off; noise-target = 0  // so that more samples are plain means
}
background { gradient = ((0.3, 0.3, 0.3), (0.55, 0.65, 0.8), (0.3, 0.45, 0.7)) }

camera { position = (0, 2.2, 7); look_at = (0, 0.8, 0); fov = 34; aspectratio = 4 / 3 }

// Its light does not fade with the distance.
point_light {
  name = "lamp"
  position = (-4, 5, 3)
  color = (0.9, 0.9, 0.9)
  constant_attenuation_coeff = 1
  quadratic_attenuation_coeff = 0
}
ambient_light { color = (0.2, 0.2, 0.2) }

plane { name = "floor"; material = { diffuse = (0.6, 0.6, 0.6); ambient = (0.6, 0.6, 0.6) } }
translate(0, 1, 0) { sphere { name = "ball"; material = { diffuse = (0.8, 0.3, 0.2); ambient = (0.8, 0.3, 0.2) } } }
)";

/// Such a text for a file of that name: its comments call it so, not scene.ray.
inline std::string sceneNamed(std::string_view text, std::string_view name) {
  constexpr std::string_view kName = "scene.ray";
  std::string named(text);
  for (std::size_t at = named.find(kName); at != named.npos; at = named.find(kName, at + name.size()))
    named.replace(at, kName.size(), name);
  return named;
}

}  // namespace trace
