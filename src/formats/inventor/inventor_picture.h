// The pictures of Texture2, ImageTexture and PixelTexture, and what they do to a material.
#pragma once

#include <array>
#include <memory>
#include <optional>

#include "formats/inventor/inventor_fields.h"
#include "formats/model_textures.h"
#include "shading/material.h"
#include "shading/textures/image_map.h"

namespace trace::inventor {

/// From texture coordinates to those of the picture, as ImageMap::transform has it.
using TextureTransform = std::array<Real, 6>;
inline constexpr TextureTransform kUnmoved{1, 0, 0, 0, 1, 0};

struct PaintedPicture {
  /// modulate: the lit colour is multiplied by the picture. replace: the picture takes the place of the
  /// diffuse colour and of the transparency (VRML97, section 4.14.3), but a grey one is multiplied. decal: it
  /// is seen as it is, without light. blend: `blend` is, as far as the picture is white.
  enum class Model { modulate, replace, decal, blend };

  ImageMap map;
  PictureKind kind;
  Model model = Model::modulate;
  Color blend;
};

/// The colours of a material whose diffuse colour is `base` before light, of which the share `through`
/// passes.
struct Painted {
  Color base;
  Real through = 0;
};
/// The channels that are used under the picture.
Painted under(const PaintedPicture& picture, const Painted& painted);

/// Puts the picture on the material.
void paint(Material& material, const PaintedPicture& picture, const TextureTransform& transform);

/// The picture in a node's field `image`: width, height, components, pixels from the bottom left. Nothing if
/// there are not so many numbers.
std::optional<Raster> inlineImage(const std::vector<double>& numbers);

/// VRML97's TextureTransform: -C S R C T, the last first (section 6.49).
TextureTransform textureTransform(const Values& node);
/// Texture2Transform of Inventor and VRML 1.0: scaled and turned about `center`, then moved.
TextureTransform texture2Transform(const Values& node);
/// First b, then a.
TextureTransform product(const TextureTransform& a, const TextureTransform& b);

}  // namespace trace::inventor
