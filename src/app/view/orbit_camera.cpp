#include "app/view/orbit_camera.h"

#include <algorithm>
#include <cmath>

#include "math/elementary.h"
#include "math/transform.h"

namespace trace {
namespace {

constexpr Real kSteepest = 1.55;              // radians: not quite to the pole
constexpr Real kBeside = 0.75, kAbove = 0.3;  // radians from the scene's camera, at first
constexpr Real kRoomAround = 1.15;            // around what should be in sight

}  // namespace

Matrix4 projection(const CameraFrame& frame, Real nearest, Real farthest) {
  Affine worldFromView;  // columns right, up, look
  for (int i = 0; i < 3; ++i) worldFromView.row[i] = {frame.right[i], frame.up[i], frame.look[i]};
  worldFromView.offset = frame.eye;
  const Affine view = inverse(worldFromView);
  const Real depth = (farthest + nearest) / (farthest - nearest);
  const Real shift = -2 * farthest * nearest / (farthest - nearest);
  const auto row = [&](const Vec3& v, Real factor, Real offset, Real add) {
    return std::array<double, 4>{v.x * factor, v.y * factor, v.z * factor, offset * factor + add};
  };
  return {row(view.row[0], 2, view.offset.x, 0), row(view.row[1], 2, view.offset.y, 0),
          row(view.row[2], depth, view.offset.z, shift), row(view.row[2], 1, view.offset.z, 0)};
}

std::array<double, 4> transform(const Matrix4& m, const Vec3& p) {
  std::array<double, 4> r{};
  for (std::size_t i = 0; i < 4; ++i) r[i] = m[i][0] * p.x + m[i][1] * p.y + m[i][2] * p.z + m[i][3];
  return r;
}

CameraFrame fitted(const CameraFrame& camera, Real viewAspect) {
  const Real aspect = length(camera.right) / length(camera.up);
  CameraFrame wide = camera;
  wide.look = camera.ahead * (dot(camera.look, camera.ahead));  // a window, whatever the camera is
  wide.optics = {};
  wide.plain = true;
  if (viewAspect > aspect)
    wide.right = camera.right * (viewAspect / aspect);
  else
    wide.up = camera.up * (aspect / viewAspect);
  return wide;
}

OrbitCamera::OrbitCamera() : height_(2 * math::tan(kFieldOfView * kPi / 360)) {}

void OrbitCamera::lookAt(const Box3& target) {
  target_ = target.center();
  const Real slope = height_ / 2;
  distance_ = std::max(1e-30, kRoomAround * length(target.size()) / 2 * math::hypot(1, slope) / slope);
}

OrbitCamera::OrbitCamera(const Box3& target, const Camera& camera) : OrbitCamera() {
  Box3 all = target;
  all.extend(camera.position);
  target_ = all.center();
  distance_ = std::max(1e-30, kRoomAround * length(all.size()) / 2 / math::sin(kFieldOfView * kPi / 360));
  face(normalize(-camera.viewdir), camera.updir);
  azimuth_ += kBeside;
  elevation_ = std::clamp(elevation_ + kAbove, -kSteepest, kSteepest);
}

OrbitCamera OrbitCamera::from(const CameraFrame& camera, const Vec3& updir, Real distance) {
  OrbitCamera orbit;
  const Vec3 look = normalize(camera.look);
  orbit.face(-look, updir);
  orbit.target_ = camera.eye + look * distance;
  orbit.distance_ = distance;
  orbit.height_ = length(camera.up) / length(camera.look);
  return orbit;
}

void OrbitCamera::face(const Vec3& back, const Vec3& updir) {
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(updir[axis]) > std::abs(updir[up_])) up_ = axis;
  sign_ = updir[up_] < 0 ? -1 : 1;
  azimuth_ = math::atan2(back[(up_ + 2) % 3], back[(up_ + 1) % 3]);
  elevation_ = std::clamp(math::asin(std::clamp(sign_ * back[up_], -1.0, 1.0)), -kSteepest, kSteepest);
}

void OrbitCamera::turn(Real azimuth, Real elevation) {
  azimuth_ += sign_ * azimuth;
  elevation_ = std::clamp(elevation_ + elevation, -kSteepest, kSteepest);
}

void OrbitCamera::move(Real right, Real up) {
  const CameraFrame f = frame(1);
  target_ += (normalize(f.right) * right + normalize(f.up) * up) * (length(f.up) * distance_);
}

void OrbitCamera::approach(Real factor) { distance_ = std::clamp(distance_ * factor, 1e-30, 1e30); }

Vec3 OrbitCamera::toEye() const {
  Vec3 v;
  v[(up_ + 1) % 3] = math::cos(elevation_) * math::cos(azimuth_);
  v[(up_ + 2) % 3] = math::cos(elevation_) * math::sin(azimuth_);
  v[up_] = sign_ * math::sin(elevation_);
  return v;
}

CameraFrame OrbitCamera::frame(Real viewAspect) const {
  const Vec3 back = toEye();
  Vec3 up;
  up[up_] = sign_;
  const Vec3 right = normalize(cross(up, back));
  CameraFrame frame{target_ + back * distance_, -back, right * (height_ * viewAspect),
                    cross(back, right) * height_};
  frame.ahead = -back;
  return frame;
}

}  // namespace trace
