// The materials that hold at a place of an Inventor scene: lists, of which the i-th of each belong together.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "formats/inventor/inventor_fields.h"
#include "formats/inventor/inventor_picture.h"
#include "shading/material.h"

namespace trace::inventor {

struct Paint {
  std::vector<Color> ambient, diffuse, specular, emissive;
  std::vector<Real> shininess, transparency, mirror;
  bool ambientOfDiffuse = false;  ///< VRML97: the ambient colours are factors on the diffuse ones
  bool unlit = false;             ///< shows its diffuse colour without light
  std::optional<PaintedPicture> picture;
  TextureTransform textureTransform = kUnmoved;

  std::size_t count() const {
    return std::max({ambient.size(), diffuse.size(), specular.size(), emissive.size(), shininess.size(),
                     transparency.size(), std::size_t{1}});
  }
  /// The last of a list that is too short continues.
  Material material(std::size_t i) const;
};

/// Fields of a node Material that are not given have the defaults of Inventor and VRML 1.0, or of VRML97.
Paint paintOf(const Values& material, bool vrml2);

}  // namespace trace::inventor
