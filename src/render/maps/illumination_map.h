// Light that is gathered in texture maps of the surfaces on which it falls (Arvo, Backward Ray Tracing,
// Developments in Ray Tracing, SIGGRAPH course 12, 1986).
//
// Each side of each part of an object has a map of side x side texels over its texture coordinates from 0 to
// 1. What falls on a place is shared by the four texels around it, by their nearness, and read in the same
// way. Where texture coordinates repeat, go beyond 0 and 1, or are missing, no map is made.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "render/world/hit.h"

namespace trace {

class World;

class IlluminationMap {
 public:
  IlluminationMap() = default;
  /// So many texels a side; 0: no place has a map.
  explicit IlluminationMap(int side) : side_(side) {}

  bool empty() const { return side_ == 0; }

  /// A place on a map.
  struct Place {
    std::uint32_t object;
    std::uint64_t part;  ///< part of the object; 0 for a mesh
    bool inward;         ///< the side seen is not where u, v and the normal are right-handed
    Vec2 uv;
    Real area;  ///< area of the surface, where u and v grow by 1
    auto surface() const { return std::tuple(object, part, inward); }
  };
  /// Where on a map the place is that a ray has met, on the side it comes from.
  std::optional<Place> place(const World& world, const Ray& ray, const Hit& hit) const;

  /// `power` falls there.
  void add(const Place& place, const Color& power);
  /// The light that arrives there, per area.
  Color at(const Place& place) const;

 private:
  struct Near {
    std::size_t texel[4];
    Real weight[4];
  };
  /// The four texels around a place, and how near they are.
  Near near(const Vec2& uv) const;

  int side_ = 0;
  std::map<std::tuple<std::uint32_t, std::uint64_t, bool>, std::vector<Color>> maps_;
};

}  // namespace trace
