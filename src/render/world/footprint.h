// How the footprint of a ray continues from the surface that it hits. Kept out of line, since most renders
// want none.
#pragma once

#include <optional>

#include "render/world/world.h"
#include "shading/optics/differentials.h"

namespace trace {

/// The Differentials of a ray, if it has any.
class Footprint {
 public:
  Footprint() {}  // not "= default", with which GCC fills its memory with zeros for each ray
  Footprint(const Differentials& of) : of_(of) {}  // NOLINT(google-explicit-constructor)
  const Differentials* get() const { return of_ ? &*of_ : nullptr; }

 private:
  std::optional<Differentials> of_;
};

/// The footprint of the ray where it has hit the surface.
Footprint arrivedAt(const Hit& hit, const Differentials& ray, const Vec3& direction);

/// The footprint of the ray that is mirrored where one has arrived, at the unit normal for shading, on either
/// side. None if that has none.
Footprint mirroredAt(const World& world, const Hit& hit, const Differentials* arrived, const Vec3& direction,
                     const Vec3& normal);

/// The footprint of the ray refracted from `direction` to `out`; `ratio` = index before / index behind.
Footprint refractedAt(const World& world, const Hit& hit, const Differentials* arrived, const Vec3& direction,
                      const Vec3& out, const Vec3& normal, Real ratio);

}  // namespace trace
