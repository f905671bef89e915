// Parts common to both generations of the scenes of British Columbia: the settings that follow from the
// course, and the materials and lights as Trace has them.
#pragma once

#include <string>
#include <string_view>

#include "formats/warnings.h"
#include "scene/scene.h"

namespace trace::ubc {

/// The numbers of a material, as both grammars give them.
struct Surface {
  Color ambient, diffuse, specular, emission;
  Real shininess = 0;
  Real shadow = 0;   ///< 0 shows no shadow, 1 a black one
  Real reflect = 0;  ///< weight of the mirrored ray, added to the surface's own colour
};
Phong phong(const Surface& surface);

/// The numbers of a light. Its ambient part becomes an ambient light of its own, without shadows.
struct Lamp {
  Vec3 position;
  Color ambient, diffuse, specular;
  Vec3 attenuation;  ///< constant, linear, quadratic; all 0: the light does not fade
  Real radius = 0;   ///< radius of the luminous ball
};
void addLamp(Scene& scene, const Lamp& lamp, const SourcePlace& place);

/// Camera with gluLookAt and gluPerspective; the limits near and far are along the ray.
struct View {
  Vec3 eye, center{0, 0, 1}, up{0, 1, 0};
  Real fovy = 45, aspect = 1, near = 1, far = 10000;
};
/// Throws Error(Fault::scene) at the place if it cannot look.
Camera camera(const View& view, const SourcePlace& place);

/// Warns of a scene that shows nothing: no object, no light, a view that ends before it begins.
void warnOfNothing(const Scene& scene, const View& view, const SourcePlace& viewPlace, Messages& messages);
/// Warns of numbers of a material that no surface has.
void warnOfRanges(const Material& material, const SourcePlace& place, WarningsByKind& warnings);

/// The conventions, 9 bounces, the size of the picture, the depth beside it, from black at `view.near` to
/// white at `view.far`, and where the two go: NAME_out.bmp and NAME_out_depth.bmp beside the scene.
void addChoices(Scene& scene, int width, int height, const View& view);

}  // namespace trace::ubc
