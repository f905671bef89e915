// THE list of lights. A light tells, for a point, where its light comes from and how much arrives there
// if nothing is in the way. Lights are not affected by transforms and are not objects.
//
// Each is one header: a struct with kKeyword, kHelp, fields(), and
//   bool hasSize() const;                    its light comes from more than one direction
//   illuminate(from, rules, u) const;        what arrives at a point of the place of the light that u
//   chooses,
//                                            two numbers from 0 up to 1; over all u the mean is what arrives
//   reach(rules) const;                      where it shines, for a choice among many
// and, if rays can see it, seen(ray, rules) const. From an ambient light and from a portal nothing arrives.
#pragma once

#include <variant>

#include "shading/lights/ambient_light.h"
#include "shading/lights/directional_light.h"
#include "shading/lights/goniometric_light.h"
#include "shading/lights/point_light.h"
#include "shading/lights/portal.h"
#include "shading/lights/projector_light.h"
#include "shading/lights/rectangle_light.h"
#include "shading/lights/spot_light.h"
#include "shading/lights/warn_light.h"

namespace trace {

using Light = std::variant<PointLight, DirectionalLight, SpotLight, AmbientLight, RectangleLight, WarnLight,
                           GoniometricLight, ProjectorLight, Portal>;

}  // namespace trace
