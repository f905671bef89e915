// The eye of an interactive view of a scene: turns about a target, moves, comes near; or looks as the scene's
// own camera does. Both are frames like that of a camera (shading/cameras/camera.h), from which one matrix
// follows.
#pragma once

#include <array>

#include "math/box.h"
#include "shading/cameras/camera.h"

namespace trace {

/// Rows; clip space of OpenGL = matrix * (x, y, z, 1).
using Matrix4 = std::array<std::array<double, 4>, 4>;

/// The points eye + look + (x - 0.5) right + (y - 0.5) up fill the view for x and y from 0 to 1; what is
/// nearer than `nearest` along `look`, or farther than `farthest`, is cut away. Precondition: the axes are
/// independent.
Matrix4 projection(const CameraFrame& frame, Real nearest, Real farthest);

/// In clip space: x, y, z, w.
std::array<double, 4> transform(const Matrix4& matrix, const Vec3& p);

/// A scene camera's frame, widened so that a view of this width / height shows the whole picture in its
/// middle.
CameraFrame fitted(const CameraFrame& camera, Real viewAspect);

class OrbitCamera {
 public:
  static constexpr Real kFieldOfView = 35;  ///< degrees, vertical, at first

  /// Looks at the box from beside and above the scene's camera, so that both are in sight.
  OrbitCamera(const Box3& target, const Camera& camera);
  OrbitCamera();
  /// Begins where a scene's camera is, with the same view of what lies `distance` ahead, but upright.
  static OrbitCamera from(const CameraFrame& camera, const Vec3& updir, Real distance);

  void turn(Real azimuth, Real elevation);  ///< radians
  /// In shares of the view's height.
  void move(Real right, Real up);
  void approach(Real factor);  ///< below 1 comes nearer

  /// Turns no further, but has the box in sight.
  void lookAt(const Box3& target);

  CameraFrame frame(Real viewAspect) const;
  Real distance() const { return distance_; }
  const Vec3& target() const { return target_; }

 private:
  Vec3 toEye() const;
  void face(const Vec3& back, const Vec3& updir);

  Vec3 target_;
  Real distance_ = 5, azimuth_ = 0.5, elevation_ = 0.3;
  Real height_;  ///< height of the view, at distance 1
  int up_ = 1;   ///< the axis that is up
  Real sign_ = 1;
};

}  // namespace trace
