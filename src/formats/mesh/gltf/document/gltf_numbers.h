// Numbers of a glTF material and of its extensions.
#pragma once

#include "formats/mesh/gltf/document/gltf_values.h"
#include "formats/mesh/gltf/gltf_material.h"

namespace trace {

/// Names of extensions that have both numbers and pictures.
namespace gltf_extension {
inline constexpr const char *kTransform = "KHR_texture_transform",
                            *kIridescence = "KHR_materials_iridescence",
                            *kClearcoat = "KHR_materials_clearcoat", *kSheen = "KHR_materials_sheen",
                            *kAnisotropy = "KHR_materials_anisotropy", *kSpecular = "KHR_materials_specular",
                            *kTransmission = "KHR_materials_transmission", *kVolume = "KHR_materials_volume",
                            *kGlossiness = "KHR_materials_pbrSpecularGlossiness";
}

/// All that is no picture. Numbers lie in their ranges; colours may be any.
void readNumbers(const tinygltf::Material& from, MetallicRoughness& m);

}  // namespace trace
