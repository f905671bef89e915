// A profile carried along a path while it grows, shrinks and turns: rails, frames, horns, twisted bands.
//
// The profile stands across the path and turns no more than the path makes it (double reflection: Wang,
// Juttler, Zheng and Liu, Computation of Rotation Minimizing Frames, 2008). Between stations, so many to an
// arc that the path bends little from one to the next, its two directions are cubics in the path's parameter
// (Hermite). With them, the surface is a bicubic patch for each arc of the profile, and is hit as
// bezier_patches.h hits one: no triangles.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "base/field.h"
#include "geometry/shapes/surfaces/bezier_patches.h"
#include "geometry/shapes/surfaces/prism.h"
#include "geometry/shapes/surfaces/profile.h"

namespace trace {

class TracedProfileSweep;

struct Sweep {
  static constexpr std::string_view kKeyword = "sweep";
  static constexpr std::string_view kHelp = "profile of varying size moved along a curve";

  Prism::Outline profile{{-0.3, -0.1}, {0.3, -0.1}, {0.3, 0.1}, {-0.3, 0.1}};
  Spline profileSpline = Spline::linear;
  std::vector<std::array<Real, 4>> points{
      {-1, 0, 0, 1}, {-0.3, 0.7, 0.3, 0.7}, {0.3, -0.7, 0.3, 1.3}, {1, 0, 0, 0.8}};
  Spline spline = Spline::bezier;
  Real twist = 0;
  bool closed = true, capped = true;

  static constexpr auto fields() {
    return Fields{
        Field{"profile", &Sweep::profile, "", -kNoLimit, kNoLimit,
              "list of (x, y): x to the right of the path, y up"},
        Field{"profile_spline", &Sweep::profileSpline, "", 0, 0, "how the points of the profile are joined"},
        Field{"points", &Sweep::points, "", -kNoLimit, kNoLimit,
              "path: list of (x, y, z, scale of the profile)"},
        Field{"spline", &Sweep::spline, "", 0, 0, "how the points of the path are joined"},
        Field{"twist", &Sweep::twist, "degrees", -kNoLimit, kNoLimit, "rotation of the end around the path"},
        Field{"closed", &Sweep::closed, "", 0, 1, "the profile is closed automatically; else an open sheet"},
        Field{"capped", &Sweep::capped, "", 0, 1, "flat ends close the tube; else an open sheet"}};
  }
  bool operator==(const Sweep&) const = default;

  /// Throws Error for too many patches. Without length of path or profile it is empty.
  std::shared_ptr<const TracedProfileSweep> prepared() const;
};

class TracedProfileSweep {
 public:
  explicit TracedProfileSweep(const Sweep& shape);

  bool solid() const { return solid_; }
  Box3 bounds() const { return bounds_; }
  void crossings(const Ray& ray, VisitCrossing visit) const;
  SurfacePoint surface(const Ray& ray, const Crossing& crossing) const;
  std::int64_t partCount() const { return kCaps + 2 * sides_.partCount(); }

 private:
  static constexpr std::int64_t kCaps = 4;  ///< the first parts: two for each flat end

  /// A flat end: the profile's x and y axis in space, of the size it has there.
  struct Cap {
    Vec3 center, x, y, outward;
    Real error = 0;
  };
  struct Event;

  bool hits(const Cap& cap, const Ray& ray, Crossing& at) const;
  SurfacePoint capSurface(const Cap& cap, const Ray& ray, const Crossing& crossing) const;
  Vec2 onCap(const Cap& cap, const Vec3& p) const;

  TracedPatches sides_{{}};
  std::size_t across_ = 1, along_ = 1;  ///< patches around the profile, and along the path
  Real outward_ = 1;                    ///< the sign that turns the normal of a patch outward
  bool solid_ = false;
  std::vector<Cap> caps_;
  std::shared_ptr<const TracedPrism> section_;  ///< the profile, from z = 0 to 1
  Box3 profileBox_, bounds_;
};

}  // namespace trace
