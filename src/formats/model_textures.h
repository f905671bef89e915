// Textures that readers of models put on the fields of materials: pictures of files and from inside the
// scene's file, products of textures, and holes.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "formats/textures.h"
#include "image/raster.h"
#include "shading/material.h"
#include "shading/textures/image_map.h"

namespace trace {

/// A picture filtered by the part of the surface that a pixel shows, as programs show models.
ImageMap modelPicture(Pixels pixels);
ImageMap modelPicture(std::string file, SourcePlace place = {});

/// The facts in the head of a picture file. A file that cannot be read, or whose head is invalid, is
/// `colored` and not `transparent`.
struct PictureKind {
  bool colored = true;       ///< false: greys only
  bool transparent = false;  ///< some texel may be
};
PictureKind kindOfPicture(std::string_view bytes);
/// The kind of the picture that the scene file `from` names.
PictureKind kindOfPicture(const std::string& from, const std::string& name);

/// Pictures that stand in the scene's own file. One that is broken is a checker, of which is told once.
class InsidePictures {
 public:
  /// `file` tells it from others of the scene: "duck.glb#images[0]". Throws Error(Fault::limit) where memory
  /// lacks.
  Pixels decode(std::string file, InsideFile picture, const SourcePlace& place);
  void report(Messages& messages) const { unread_.reportUnread(messages, reason_); }

 private:
  UnusedTextures unread_;
  std::string reason_;  ///< reason of the first
};

/// One times the other, whose luminance counts.
Texture product(const Texture& color, const Texture& grey);
/// from + (1 - from) times the luminance of the texture.
Texture raised(const Texture& grey, Real from);
/// 1 where the luminance of the texture is at least `least`, otherwise 0.
Texture threshold(const Texture& grey, Real least);

/// `share` times the luminance of `opacity` of the surface is there.
void cutOut(Material& material, const Texture& opacity, Real share = 1);

}  // namespace trace
