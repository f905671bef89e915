// Materials of an MTL file, as tinyobjloader has read them, as those of Trace.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "shading/material.h"

namespace tinyobj {
struct material_t;
}  // namespace tinyobj

namespace trace {

/// The names of its pictures, and the pictures.
struct MtlPictures {
  std::function<SourcePlace(std::string_view, const std::string&)> placeOf;  ///< where this keyword names it
  std::function<std::string(const std::string&)> nameOf;                     ///< as seen from the mesh's file
  std::function<bool(const std::string&)> isTransparent;             ///< the picture of that name may be
  std::function<void(std::string_view, const std::string&)> unused;  ///< this keyword's is not rendered
};

/// The material with its pictures; nothing if it has numbers that are not finite.
std::optional<Material> materialOf(const tinyobj::material_t& mtl, const MtlPictures& pictures);

/// MTL does not say how high heights stand: `bump` becomes a part of the model's longest side.
void scaleHeights(Material& material, Real longestSide);

/// The fields that colours of points multiply.
Color paintedColor(const MaterialModel& model);

}  // namespace trace
