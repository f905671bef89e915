// THE list of textures. A new texture is a header in shading/textures/ and a name here. Only the table
// (texture_table.cpp) sees all of them: cmake/check_floors.sh holds that.
//
// Each is a struct with kKeyword, kHelp, fields() and
//   Color at(const TexturePlace&) const;
// which gives a finite colour at a finite place. One that has colours a and b says how they are mixed
// instead,
//   Real pattern(const TexturePlace&) const;    0 is a, 1 is b
//   Color shade(Real pattern) const;
// so that a texture in place of one is not asked where only the other is seen.
// One that looks at the footprint, or at u and v without a field `space`, says so; sums of octaves always do:
//   bool wantsFootprint() const;
//   bool wantsUv() const;
#pragma once

#include <variant>

#include "shading/textures/blackbody.h"
#include "shading/textures/brick.h"
#include "shading/textures/cells.h"
#include "shading/textures/checker.h"
#include "shading/textures/clouds.h"
#include "shading/textures/formula.h"
#include "shading/textures/gradient.h"
#include "shading/textures/granite.h"
#include "shading/textures/image_map.h"
#include "shading/textures/marble.h"
#include "shading/textures/mix.h"
#include "shading/textures/noise.h"
#include "shading/textures/ramp.h"
#include "shading/textures/solid.h"
#include "shading/textures/spots.h"
#include "shading/textures/wood.h"

namespace trace {

using TextureList = std::variant<ImageMap, Checker, Brick, Gradient, Spots, Noise, Marble, Wood, Granite,
                                 Clouds, Cells, Solid, Ramp, Mix, Formula, Blackbody>;

}  // namespace trace
