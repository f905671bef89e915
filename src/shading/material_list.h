// THE list of shading models. A new model is a header in shading/materials/ and a name here. Only the table
// (material_table.cpp) and their Bsdfs (bsdf.cpp) see all of them: cmake/check_floors.sh holds that.
#pragma once

#include <variant>

#include "shading/materials/ashikhmin_shirley.h"
#include "shading/materials/cel.h"
#include "shading/materials/coated.h"
#include "shading/materials/conductor.h"
#include "shading/materials/cook_torrance.h"
#include "shading/materials/gooch.h"
#include "shading/materials/hair.h"
#include "shading/materials/hatching.h"
#include "shading/materials/lambert.h"
#include "shading/materials/marschner.h"
#include "shading/materials/oren_nayar.h"
#include "shading/materials/phong.h"
#include "shading/materials/principled.h"
#include "shading/materials/rough_glass.h"
#include "shading/materials/schlick_brdf.h"
#include "shading/materials/subsurface.h"
#include "shading/materials/thin_glass.h"
#include "shading/materials/velvet.h"
#include "shading/materials/ward.h"

namespace trace {

using ModelList = std::variant<Phong, Lambert, OrenNayar, Conductor, Coated, Principled, CookTorrance, Ward,
                               SchlickModel, AshikhminShirley, Velvet, Hair, Marschner, RoughGlass, ThinGlass,
                               Cel, Gooch, Hatching, Subsurface>;

}  // namespace trace
