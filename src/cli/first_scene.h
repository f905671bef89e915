// The scene that `ray new` writes.
#pragma once

#include <string_view>

namespace trace::cli {

inline constexpr std::string_view kFirstScene = R"(Trace 1

// A first scene. `ray scene.ray` renders it, `ray gui scene.ray` opens it in the studio.
// Change a number, render again, and see what happens. `ray materials` lists what things can be made of.
// x goes to the right, y up, z toward you. Angles are in degrees.

let red = material { library = "red plastic" }
let glass = material { library = crown }

camera { position = (0, 2.4, 7.5); look_at = (0, 0.8, 0); fov = 36 }

// The ground is the plane y = 0.
plane { material = { library = oak } }

// Objects are made at the origin and moved from there.
translate(-1.5, 1, 0) { sphere { material = red } }
translate(1.3, 0.8, 0.9) { scale(0.8) { sphere { material = glass } } }
translate(0.4, 0, -1.6) { rotate y 25 { scale(1.6) { translate(0, 0.5, 0) { box { material = { library = gold } } } } } }

// A loop: nine pearls on a circle. `i` counts from 0 to 8.
for i in 0..8 {
  rotate y (40 * i) {
    translate(0, 0.18, 2.6) { scale(0.18) { sphere { material = { library = porcelain } } } }
  }
}

// Without any light of its own, a scene gets a sky and a sun. Take away the two strokes for a lamp instead:
// point_light { position = (-3, 5, 4); radius = 0.4 }
)";

}  // namespace trace::cli
