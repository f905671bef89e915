// The contents of a file of the composer, word for word: one camera, lights, spheres and sets of polygons in
// world space. Between the bytes (composer_text.cpp, composer_binary.cpp) and the Scene
// (composer_format.cpp).
//
// Source: the format 2.1 of 1995 that the courses of 1998 rendered (docs/formats.md).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "math/color.h"
#include "math/vec.h"

namespace trace::composer {

inline constexpr Real kGlass = 1.5;           ///< the index of what transmits light
inline constexpr Real kShininessScale = 128;  ///< from shininess to the exponent

struct View {
  Vec3 position{0, 0, 1}, direction{0, 0, -1};
  Real focalDistance = 5;
  Vec3 up{0, 1, 0};
  Real verticalFov = 0.785398;  ///< radians
};

struct Lamp {
  enum class Kind { point, directional, spot };
  Kind kind = Kind::point;
  Vec3 position{}, direction{0, 0, -1};
  Color color{1};
  Real dropOffRate = 0, cutOffAngle = 0.785398;  ///< radians, between axis and side
};

struct Material {
  Color diffuse{0.8}, ambient{0.2}, specular{}, emission{};
  Real shininess = 0.2;  ///< times kShininessScale is the exponent
  Real ktran = 0;        ///< share of light that passes
};

struct Vertex {
  Vec3 position, normal;
  std::uint32_t material = 0;
  Vec2 uv;
};

struct PolySet {
  bool vertexNormals = false, vertexMaterials = false, hasUv = false;
  std::vector<std::uint32_t> counts;  ///< counts of the vertices of each polygon
  std::vector<Vertex> vertices;       ///< vertices of all polygons in turn
};

struct Sphere {
  Vec3 origin;
  Real radius = 1;
  Vec3 axis[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  Real length[3] = {0, 0, 0};  ///< 0 where the file gives none: the radius
};

struct Object {
  std::string name;
  std::vector<Material> materials;
  std::optional<Sphere> sphere;  ///< otherwise
  PolySet polygons;
  SourcePlace place;
};

struct File {
  std::optional<View> view;
  std::vector<Lamp> lamps;
  std::vector<Object> objects;
};

// Each throws Error(Fault::scene). `bytes` is the whole file; `start` the offset after its first line.
File readText(const std::string& file, std::string_view bytes, std::size_t start, Messages& messages);
File readBinary(const std::string& file, std::string_view bytes, std::size_t start, bool beforeVersion21,
                Messages& messages);

/// The file as text, with numbers of that many significant digits; 0: as many as it takes.
std::string writeText(const File& file, int digits = 0);

}  // namespace trace::composer
