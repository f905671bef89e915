// Which model a glTF material becomes, by its numbers.
#pragma once

#include "formats/mesh/gltf/gltf_material.h"

namespace trace {

MaterialModel modelOf(const MetallicRoughness& m);

/// The opacity of all of the surface; 1 where a picture has it.
double evenOpacity(const MetallicRoughness& m);
/// By which Phong's model mirrors less than a smooth surface.
double polishOf(const MetallicRoughness& m);

}  // namespace trace
