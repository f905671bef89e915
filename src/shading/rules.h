// Where the courses differ in what a material or a light means. Options of the group Conventions choose.
#pragma once

#include "math/vec.h"

namespace trace {

/// Which angle the highlight measures: normal against half-way vector, or eye against mirrored light.
enum class Highlight { blinn, phong };
/// The reflection of a material that gives no `reflective`.
enum class MirrorDefault { specular, zero };
/// Which sides of a surface are lit.
enum class DiffuseSides { front, bothOnGlass };

struct Rules {
  Highlight highlight = Highlight::blinn;
  Real shininessScale = 1;
  MirrorDefault mirrorDefault = MirrorDefault::specular;
  DiffuseSides diffuseSides = DiffuseSides::front;
  bool limitAttenuation = true;  ///< with distance a light never becomes brighter than it is
  /// Clear layers mirror by Fresnel's formula in place of Schlick's approximation
  /// (shading/optics/layer_fresnel.h).
  bool exactFresnel = false;
};

}  // namespace trace
