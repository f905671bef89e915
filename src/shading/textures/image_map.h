// A picture on a surface, by its texture coordinates.
#pragma once

#include <array>
#include <string_view>

#include "base/field.h"
#include "image/maps/mipmap.h"
#include "shading/pixels.h"
#include "shading/texture_place.h"

namespace trace {

/// The channel of a texel that is used.
enum class Channel { color, red, green, blue, alpha };
constexpr std::array<std::string_view, 5> names(Channel) {
  return {"color", "red", "green", "blue", "alpha"};
}

/// The meaning of the picture as a material's `bump`.
enum class Relief {
  heights,
  normals,      ///< in the frame of tangents; green counts up, as in OpenGL and glTF
  normalsDown,  ///< the same with green counting down, as in Direct3D
};
constexpr std::array<std::string_view, 3> names(Relief) { return {"heights", "normals", "normals_down"}; }

/// How the picture is laid on a surface.
enum class Mapping {
  uv,        ///< by texture coordinates
  plane,     ///< along z, onto the square from 0 to 1 in x and y
  sphere,    ///< around y, from pole to pole, as seen from the origin
  cylinder,  ///< around y, from y = 0 to 1
};
constexpr std::array<std::string_view, 4> names(Mapping) { return {"uv", "plane", "sphere", "cylinder"}; }

struct ImageMap {
  static constexpr std::string_view kKeyword = "image";
  static constexpr std::string_view kHelp = "a picture, by u and v: (0, 0) is its bottom left corner";

  Pixels file;
  Wrap wrapU = Wrap::repeat, wrapV = Wrap::repeat;
  TexelFilter filter = TexelFilter::bilinear;
  bool centersAtEnds = false;
  bool srgb = false;
  Channel channel = Channel::color;
  Relief relief = Relief::heights;
  bool secondUv = false;
  Mapping mapping = Mapping::uv;
  std::array<Real, 6> transform{1, 0, 0, 0, 1, 0};

  static constexpr auto fields() {
    return Fields{
        Field{"file", &ImageMap::file, "", -kNoLimit, kNoLimit, "the picture"},
        Field{"wrap_u", &ImageMap::wrapU, "", -kNoLimit, kNoLimit, "what lies beyond its sides"},
        Field{"wrap_v", &ImageMap::wrapV, "", -kNoLimit, kNoLimit, "what lies above and below it"},
        Field{"filter", &ImageMap::filter, "", -kNoLimit, kNoLimit, "texture filter"},
        Field{"centers_at_ends", &ImageMap::centersAtEnds, "", -kNoLimit, kNoLimit,
              "the outermost texels have their centres at 0 and 1, not their edges"},
        Field{"srgb", &ImageMap::srgb, "", -kNoLimit, kNoLimit,
              "its numbers are sRGB and are made linear before they are averaged; otherwise they are used "
              "unchanged"},
        Field{"channel", &ImageMap::channel, "", -kNoLimit, kNoLimit, "channel that is used"},
        Field{"relief", &ImageMap::relief, "", -kNoLimit, kNoLimit,
              "its meaning as a bump: heights, or normals whose green counts up or down"},
        Field{"second_uv", &ImageMap::secondUv, "", -kNoLimit, kNoLimit,
              "it uses the second texture coordinates of its mesh, `texture_uv2`, if there are some"},
        Field{"mapping", &ImageMap::mapping, "", -kNoLimit, kNoLimit,
              "by texture coordinates, or by the point: flat, around a ball or around a cylinder"},
        Field{"transform", &ImageMap::transform, "", -kNoLimit, kNoLimit,
              "(a, b, c, d, e, f): at (u, v) the picture is evaluated at (a u + b v + c, d u + e v + f)"}};
  }
  bool operator==(const ImageMap&) const = default;

  bool wantsUv() const { return mapping == Mapping::uv; }
  bool wantsFootprint() const { return filter == TexelFilter::trilinear || filter == TexelFilter::ewa; }
  /// Black where nothing is loaded.
  Texel texelAt(const TexturePlace& place) const;
  Color at(const TexturePlace& place) const;
};

}  // namespace trace
