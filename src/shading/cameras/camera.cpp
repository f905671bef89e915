#include "shading/cameras/camera.h"

namespace trace {

CameraFrame frame(const Camera& camera, CameraAxes axes, const Lens& lens) {
  Vec3 back = -camera.viewdir, up = camera.updir;
  if (axes == CameraAxes::normalized || axes == CameraAxes::skewed)
    back = normalize(back), up = normalize(up);
  Vec3 right = cross(up, back);
  if (axes == CameraAxes::skewed) right = normalize(right);
  if (axes == CameraAxes::orthonormal) {
    up = normalize(cross(back, right));
    back = normalize(back), right = normalize(right);
  }
  const Real height = 2 * std::tan(camera.fov * kPi / 360);
  return {camera.position, -back, right * (height * camera.aspectratio), up * height, camera.near,
          camera.far,      lens};
}

}  // namespace trace
