// Photons where they came to rest, and how much light they are: a k-d tree (Bentley 1975) that is asked for
// the nearest ones (Jensen, Realistic Image Synthesis Using Photon Mapping, 2001, chapter 6).
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "math/box.h"
#include "math/color.h"
#include "math/vec.h"

namespace trace {

struct Photon {
  Vec3 point;
  Vec3 direction;  ///< in which it flew, unit
  Vec3 normal;     ///< normal of the surface, on the side where it arrived; 0 in a medium
  Color power;  ///< what it brings: divided by an area, pi times the colour of a light. In a medium times the
                ///< length for which it stands, which is divided by a volume
  Real flown = kInfinity;  ///< the distance from the surface that sent it here evenly; infinite if none did
};

class PhotonMap {
 public:
  static constexpr std::size_t kNearest = 64;  ///< photons of an estimate, at most

  PhotonMap() = default;
  /// The least cosine between the normals of places that may lie on one surface.
  static constexpr Real kAlike = 0.8;
  /// Photons farther than `reach` away count nowhere. Distances along the normal count `flatness` times more:
  /// what lies above a surface or below it is of another one. That is the mean of the normals of both places,
  /// to which a ball and all that bends as evenly is level: so a bent surface is not taken to end there.
  /// `nearest` photons make an estimate, from 2 to kNearest.
  PhotonMap(std::vector<Photon> photons, Real reach, Real flatness = 1, std::size_t nearest = kNearest);

  bool empty() const { return photons_.empty(); }
  std::span<const Photon> photons() const { return photons_; }

  /// The nearest photons to a place, at most kNearest, that arrived on the side of `normal`.
  struct Near {
    std::array<const Photon*, kNearest> photons;
    std::array<Real, kNearest> distance2;
    std::size_t count = 0;
    Real radius2 = 0;  ///< radius2 of the disk on which they arrived
    /// The share of an area that photon i counts for: less toward the edge of the disk (Epanechnikov's
    /// kernel, which keeps edges of light sharper than a disk does).
    Real perArea(std::size_t i) const {
      return 2 / (kPi * radius2) * std::max(0.0, 1 - distance2[i] / radius2);
    }
    /// The share of a volume, by the same kernel in a ball.
    Real perVolume(std::size_t i) const {
      return 15 / (8 * kPi * radius2 * std::sqrt(radius2)) * std::max(0.0, 1 - distance2[i] / radius2);
    }
  };
  Near near(const Vec3& point, const Vec3& normal) const;
  /// The estimate in a medium: from all directions.
  Near around(const Vec3& point) const;

 private:
  struct Search;
  /// Photons of surfaces that face about the same way, which have a tree of their own: else a search would
  /// have to pass by all photons on the other sides of walls.
  struct Facing {
    std::size_t first, end;
    Box3 normals;
  };
  Near found(Search& search) const;
  void build(std::size_t first, std::size_t end);
  void search(std::size_t first, std::size_t end, Search& search) const;

  std::vector<Photon> photons_;     ///< a subtree's middle one splits it
  std::vector<std::uint8_t> axes_;  ///< across which it does
  std::vector<Facing> facings_;
  Real reach2_ = 0;
  Real steepness_ = 0;  ///< flatness^2 - 1
  std::size_t nearest_ = kNearest;
};

}  // namespace trace
