// The one door for rays. Integrators ask the Tracer, never the World: here every ray is counted, and the
// conventions that decide what a kind of ray sees are applied.
#pragma once

#include <optional>

#include "render/world.h"
#include "scene/settings.h"

namespace trace {

struct Hit {
  Real t = 0;
  std::uint32_t object = 0;  ///< index into Scene::objects
  SurfacePoint surface;
  Phong material;
  bool leaving = false;  ///< the ray comes from inside: it runs along the true normal
};

class Tracer {
 public:
  Tracer(const World& world, const Settings& settings) : world_(world), settings_(settings) {}

  /// The first surface that a ray of this kind meets.
  std::optional<Hit> cast(const Ray& ray, RayKind kind);

  /// How much of each colour passes from the surface point toward a light at `distance` (may be infinite)
  /// in the unit direction `toLight`: 0 behind anything opaque, filtered by what is transmissive.
  Color visible(const SurfacePoint& from, const Vec3& toLight, Real distance);

  const World& world() const { return world_; }
  const Settings& settings() const { return settings_; }
  Statistics& statistics() { return statistics_; }

 private:
  Faces facesSeenBy(RayKind kind) const;

  const World& world_;
  const Settings& settings_;
  Statistics statistics_;
  std::vector<Found> crossed_;  // of one shadow ray; kept to save allocations
};

}  // namespace trace
