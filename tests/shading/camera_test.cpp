#include "shading/cameras/camera.h"

#include <gtest/gtest.h>

namespace trace {
namespace {

TEST(Camera, DefaultLooksAlongMinusZWithAPlaneOfHeightOne) {
  const CameraFrame f = frame({}, CameraAxes::orthonormal);
  EXPECT_EQ(f.ray({0.5, 0.5}).direction, (Vec3{0, 0, -1}));
  EXPECT_NEAR(length(f.up), 1, 1e-15);
  EXPECT_NEAR(length(f.right), 1, 1e-15);
  const Vec3 top = f.ray({0.5, 1}).direction;
  EXPECT_NEAR(std::atan2(top.y, -top.z) * 180 / kPi, 53.13010235415598 / 2, 1e-12);
}

TEST(Camera, FovIsVerticalAndAspectWidens) {
  Camera camera;
  camera.fov = 90, camera.aspectratio = 2;
  const CameraFrame f = frame(camera, CameraAxes::orthonormal);
  EXPECT_NEAR(length(f.up), 2, 1e-15);
  EXPECT_NEAR(length(f.right), 4, 1e-14);
}

TEST(Camera, AxesByConvention) {
  Camera camera;
  camera.viewdir = {0, 0, -2}, camera.updir = {0, 3, 1};
  const CameraFrame exact = frame(camera, CameraAxes::orthonormal);
  EXPECT_NEAR(length(exact.look), 1, 1e-15);
  EXPECT_NEAR(dot(exact.up, exact.look), 0, 1e-15);
  EXPECT_NEAR(length(exact.up), length(exact.right), 1e-15);

  // Raw: a viewdir of length 2 lengthens look and right, not up; the horizontal angle stays.
  camera.updir = {0, 1, 0};
  const CameraFrame raw = frame(camera, CameraAxes::raw);
  EXPECT_NEAR(length(raw.look), 2, 1e-15);
  EXPECT_NEAR(length(raw.right), 2, 1e-15);
  EXPECT_NEAR(length(raw.up), 1, 1e-15);

  camera.updir = {0, 3, 3};  // normalized: up stays slanted
  const CameraFrame slanted = frame(camera, CameraAxes::normalized);
  EXPECT_NEAR(length(slanted.look), 1, 1e-15);
  EXPECT_NEAR(length(slanted.up), 1, 1e-15);
  EXPECT_GT(std::abs(dot(slanted.up, slanted.look)), 0.5);
  EXPECT_NEAR(length(slanted.right), std::sqrt(0.5), 1e-15);

  const CameraFrame skewed = frame(camera, CameraAxes::skewed);  // the same, but right is not shorter
  EXPECT_EQ(skewed.up, slanted.up);
  EXPECT_NEAR(length(skewed.right), 1, 1e-15);
}

}  // namespace
}  // namespace trace
