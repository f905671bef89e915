// The term of a pixel's equation that another program lacks, has twice, or shadows otherwise: what `ray diff
// --scene` says about the pixel that differs most.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/compare/difference.h"
#include "render/picture/render.h"
#include "render/samples/integrator.h"
#include "scene/scene.h"

namespace trace {

/// A scene that was built, to trace its pixels. The parts must live longer.
struct TracedScene {
  const Scene& scene;
  const Settings& settings;
  std::span<const Moment> moments;
  Size size;
};

struct PixelCause {
  struct Part {
    std::string name;  ///< "the light of lamp on floor"
    Color brings;      ///< to the pixel: linear light
  };

  PixelPlace pixel;
  /// Follows on the name of the picture: "lacks the reflection in ball, which brings 0.31"; "" if no single
  /// term explains its value.
  std::string text;
  int confirmed = 0,
      others = 0;  ///< number of other pixels that such a term explains, and of all whose value is wrong
  std::vector<Part> parts;  ///< parts of the scene's pixel, the largest first
};

/// The term that makes of the scene's pixel that of `test`, a picture of its size. pixels[0] is the one to
/// explain. The others confirm it: a term is named only if such a term explains at least half of those whose
/// value is wrong. Nothing where the light of a pixel is not the sum of few terms: for integrators with
/// random paths, more than 16 samples a pixel, or a tone that needs the whole picture.
std::optional<PixelCause> pixelCause(const TracedScene& traced, const LoadedPicture& test,
                                     std::span<const PixelPlace> pixels);

/// "0.31", or "(0.31 0.2 0.1)": two digits that count.
std::string lightText(const Color& light);

}  // namespace trace
