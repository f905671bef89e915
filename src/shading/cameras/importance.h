// Cameras as light sees them: where in the picture a place is seen, and how densely camera rays fall there.
// Evenly chosen places of the picture send rays whose density over directions follows from the projection
// (Pharr, Jakob and Humphreys, Physically Based Rendering, 4th edition, 2023, section 5.4.1); of an
// orthographic camera it is one over places.
#pragma once

#include "shading/cameras/camera.h"

namespace trace {

class CameraImportance {
 public:
  CameraImportance() = default;
  explicit CameraImportance(const CameraFrame& frame);

  /// It is told for all projections, and for the lens of perspective; not for distortion, a tilted lens or
  /// two eyes.
  bool known() const { return known_; }
  /// All rays run in one direction: densities are over places, not over directions.
  bool parallel() const { return frame_.optics.projection == Projection::orthographic; }
  bool hasLens() const { return frame_.optics.lens.radius > 0; }

  /// With which places of the picture, chosen evenly from [0, 1]^2, send the ray from its origin. The origin
  /// is the eye, or a place of the lens.
  Real density(const Ray& ray) const;

  /// The camera ray that hits a point, and the place of the picture from which it is sent.
  struct Seen {
    Ray ray;
    Vec2 place;
    Real distance;  ///< to the point
  };
  /// Through the place of the lens that `u` chooses. Nothing for what is behind the camera.
  std::optional<Seen> sees(const Vec3& point, const Vec2& u) const;

 private:
  /// From the eye to where the ray of the perspective hits the plane in focus; without a lens along the ray.
  Vec3 sharp(const Ray& ray) const;

  CameraFrame frame_{};
  Vec3 right_{}, up_{};  ///< unit, at right angles to where it looks
  bool known_ = false;
};

}  // namespace trace
