// Light from all around that was computed at some places, and is blended between them: Ward, Rubinstein and
// Clear, A Ray Tracing Solution for Diffuse Interreflection, SIGGRAPH 1988; with the gradients of Ward and
// Heckbert, Irradiance Gradients, Eurographics Workshop on Rendering 1992.
//
// A place counts for those near it, the nearer the more; how far it reaches follows from how far away the
// surfaces are that it sees. It is filled before the picture is made, and never changes then.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "math/box.h"
#include "math/color.h"

namespace trace {

/// How a colour changes along a vector.
struct ColorGradient {
  Vec3 r, g, b;

  void add(const Vec3& direction, const Color& color) {
    r += direction * color.r;
    g += direction * color.g;
    b += direction * color.b;
  }
  Color along(const Vec3& v) const { return {dot(r, v), dot(g, v), dot(b, v)}; }
};

/// The irradiance at a point.
struct IrradianceRecord {
  Vec3 point, normal;
  Color light;            ///< the irradiance over pi: the mean radiance, by the cosine
  ColorGradient turning;  ///< ... as the normal turns about a vector
  ColorGradient moving;   ///< ... as the point moves
  Real distance;          ///< the harmonic mean of those to what it sees
};

/// The half space above a place, cut into cells that count alike: `across` rings of `around` cells each.
class HemisphereCells {
 public:
  explicit HemisphereCells(int rays);
  int count() const { return across_ * around_; }
  /// Where in cell n the two numbers from 0 up to 1 lie: z along the normal.
  Vec3 direction(int n, const Vec2& u) const;
  /// The radiance seen in a cell.
  struct Seen {
    Color light;
    Real distance;
  };
  /// The record of what all cells have seen; `x`, `y` and `normal` are the axes of the directions.
  IrradianceRecord record(const Vec3& point, const Vec3& x, const Vec3& y, const Vec3& normal,
                          const std::vector<Seen>& seen) const;

 private:
  int across_, around_;
};

class IrradianceCache {
 public:
  IrradianceCache() = default;
  /// For a scene in that box; `error` is Ward's a: how far a record may count.
  IrradianceCache(const Box3& box, Real error);

  void add(const IrradianceRecord& record);
  bool empty() const { return records_.empty(); }
  std::size_t size() const { return records_.size(); }

  struct Blend {
    Color light;
    std::size_t records;
  };
  /// At a place of that unit normal; nothing where no record counts.
  std::optional<Blend> at(const Vec3& point, const Vec3& normal) const;

 private:
  struct Node {
    std::array<std::uint32_t, 8> children{};  ///< 0: none
    std::vector<std::uint32_t> records{};
  };
  void insert(std::size_t node, const Vec3& middle, Real half, std::uint32_t record, Real reach);

  Vec3 middle_;  ///< middle of the octree's cube
  Real half_ = 0, error_ = 0;
  Real least_ = 0, most_ = 0;  ///< distances are held between these
  std::vector<IrradianceRecord> records_;
  std::vector<Node> nodes_;
};

}  // namespace trace
