// The pixels of a picture as textures ask for them.
//
// Texture coordinates: (0, 0) is the bottom left corner of the picture, (1, 1) the top right one.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "image/codec.h"
#include "math/vec.h"

namespace trace {

/// What lies beyond the edges of the picture.
enum class Wrap { repeat, clamp, mirror, black };
constexpr std::array<std::string_view, 4> names(Wrap) { return {"repeat", "clamp", "mirror", "black"}; }

enum class TexelFilter { nearest, bilinear };
constexpr std::array<std::string_view, 2> names(TexelFilter) { return {"nearest", "bilinear"}; }

struct Texel {
  Color color;
  Real alpha = 1;
};

/// How a picture is looked up.
struct Lookup {
  Wrap u = Wrap::repeat, v = Wrap::repeat;
  TexelFilter filter = TexelFilter::bilinear;
  /// The outermost texels have their centres at 0 and 1, rather than their edges.
  bool centersAtEnds = false;
};

class MipMap {
 public:
  explicit MipMap(Picture picture);

  /// Of a picture file. Throws as decodePicture().
  static std::shared_ptr<const MipMap> decode(std::string_view bytes, const std::string& name,
                                              const PictureLimits& limits = {});

  int width() const { return picture_.width; }
  int height() const { return picture_.height; }
  Texel texel(int x, int y) const { return {picture_.at(x, y), 1}; }  ///< row 0 at the top
  /// Precondition: uv is finite.
  Texel at(const Vec2& uv, const Lookup& lookup) const;

 private:
  Picture picture_;
};

}  // namespace trace
