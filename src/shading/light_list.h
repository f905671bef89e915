// THE list of lights. A new light is a header in shading/lights/ and a name here. Only the table
// (light_table.cpp) sees all of them: cmake/check_floors.sh holds that.
//
// Each is a struct with kKeyword, kHelp, fields(), operator== and
//   kStarts;                           the LightOrigin of its rays, which decides on fields that it must have
//   bool hasSize() const;              its light comes from more than one direction
//   illuminate(from, rules, u) const;  the light that arrives at a point from the place of the light that u
//                                      chooses, two numbers from 0 up to 1; its mean over all u is what
//                                      arrives
//   reach(rules) const;                where it shines, for a choice among many
// and, if rays can see it, a field `visible` and seen(ray, rules) const. From an ambient light and from a
// portal nothing arrives.
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

using LightList = std::variant<PointLight, DirectionalLight, SpotLight, AmbientLight, RectangleLight,
                               WarnLight, GoniometricLight, ProjectorLight, Portal>;

}  // namespace trace
