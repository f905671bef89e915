// The pixels of a picture as textures ask for them: single texels, or means of many, from a pyramid of
// smaller and smaller copies (Williams, Pyramidal Parametrics, SIGGRAPH 1983).
//
// Texture coordinates: (0, 0) is the bottom left corner of the picture, (1, 1) the top right one. The texel
// in column x and row y from the top covers x / width to (x + 1) / width.
//
// Each level of the pyramid is half as wide and high as the one before, rounded down; its texels are exact
// means of what they cover (Guthe and Heckbert, Non-Power-of-Two Mipmap Creation, NVIDIA 2005). With
// Lookup::srgb texels become linear before any mean is taken, otherwise means are taken of the numbers of the
// file. Colours are not weighted by alpha. A picture of one colour gives that colour exactly, by every
// filter.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "image/codecs/codec.h"
#include "image/raster.h"
#include "math/color.h"
#include "math/vec.h"

namespace trace {

/// The picture beyond its edges.
enum class Wrap { repeat, clamp, mirror, black };
constexpr std::array<std::string_view, 4> names(Wrap) { return {"repeat", "clamp", "mirror", "black"}; }

enum class TexelFilter {
  nearest,    ///< the texel at the place
  bilinear,   ///< between the four texels around it
  trilinear,  ///< between two levels of the pyramid, by the longer side of the footprint
  ewa,        ///< by the footprint as an ellipse (Greene and Heckbert, IEEE CG&A 6(6), 1986)
};
constexpr std::array<std::string_view, 4> names(TexelFilter) {
  return {"nearest", "bilinear", "trilinear", "ewa"};
}

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
  bool srgb = false;  ///< the file's colours are sRGB, and are made linear
  /// The footprint: how the place changes to the next pixel on the right and above. Where both are 0, the
  /// filters that ask for it are bilinear.
  Vec2 uvX{}, uvY{};
};

class MipMap {
 public:
  explicit MipMap(Raster raster);
  explicit MipMap(const Picture& picture);

  /// From a picture file, with its transparency. Throws as decodePicture().
  static std::shared_ptr<const MipMap> decode(std::string_view bytes, const std::string& name,
                                              const PictureLimits& limits = {});

  int width() const { return base_.width; }
  int height() const { return base_.height; }
  bool hasAlpha() const { return base_.hasAlpha; }
  /// As the file has it, row 0 at the top.
  Texel texel(int x, int y) const;

  /// The colour at a finite point. The first lookup that needs the pyramid makes it.
  Texel at(const Vec2& uv, const Lookup& lookup) const;
  /// Levels of the pyramid, the picture itself and the last texel counted.
  int levels() const;
  /// The memory it takes now. Not to be called while others look up.
  std::size_t bytes() const;

  struct Level {
    int width = 0, height = 0, channels = 0;
    bool hasAlpha = false;
    double colorMost = 1, alphaMost = 1;  ///< the sample that stands for 1
    Raster::Samples samples{};
  };
  /// The next smaller one. With `linear`, an entry for each sample of the level, the colours become those.
  static Level halved(const Level& level, const std::vector<double>& linear);

 private:
  /// Made by whoever asks first; then known at a glance.
  template <class T>
  struct Lazy {
    std::once_flag once;
    std::atomic<bool> made{false};
    T value;

    template <class Make>
    const T& get(const Make& make) {
      if (!made.load(std::memory_order_acquire)) [[unlikely]]
        std::call_once(once, [&] {
          value = make();
          made.store(true, std::memory_order_release);
        });
      return value;
    }
  };
  using Levels = std::vector<Level>;  ///< without the picture itself
  const std::vector<double>& linear() const {
    return linear_.get([this] { return makeLinear(); });
  }
  const Levels& pyramid(bool srgb) const {
    return pyramids_[srgb ? 1 : 0].get([&] { return makePyramid(srgb); });
  }
  std::vector<double> makeLinear() const;
  Levels makePyramid(bool srgb) const;
  Texel bilinear(const Level& level, const Vec2& place, const Lookup& lookup) const;
  Texel trilinear(const Level& larger, const Level& smaller, Real share, const Vec2& place,
                  const Lookup& lookup) const;
  struct Footprint;
  struct Ellipse;
  Texel weighted(const Level& level, const Vec2& place, const Ellipse& ellipse, const Lookup& lookup) const;

  Level base_;
  // Made when first wanted; what they are follows from the picture.
  mutable Lazy<std::vector<double>> linear_;  ///< linear value of each sample that an integer can be
  mutable std::array<Lazy<Levels>, 2> pyramids_;
};

}  // namespace trace
