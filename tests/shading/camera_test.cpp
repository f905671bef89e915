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

TEST(Camera, ALensBlursByItsCircleOfConfusion) {
  // f = 0.05 at f/2, focused at 2: a point at 4 covers a disk of 3.205e-4 on the film, 0.0512821 behind the
  // lens.
  const Lens lens{.radius = 0.05 / 2 / 2, .focus = 2};
  const CameraFrame f = frame({}, CameraAxes::orthonormal, lens);
  const Real film = 0.05 * 2 / (2 - 0.05);
  Real least = 0, most = 0;
  for (const Real u : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    // The film's place x, at distance 1, whose ray from this place of the lens meets the point.
    const Real lensX = f.ray({0.5, 0.5}, {u, 0.5}).origin.x, x = lensX * (1 - 2.0 / 4) / 2;
    const Ray ray = f.ray({0.5 + x, 0.5}, {u, 0.5});
    EXPECT_NEAR(ray.at(-4 / ray.direction.z).x, 0, 1e-12);
    least = std::min(least, x), most = std::max(most, x);
  }
  EXPECT_NEAR((most - least) * film, 3.205e-4, 1e-7);
}

TEST(Camera, WhatIsInFocusIsSharp) {
  Camera camera;
  camera.position = {1, 2, 3}, camera.viewdir = {1, 1, -2};
  for (const int blades : {0, 5}) {
    const CameraFrame f =
        frame(camera, CameraAxes::orthonormal, {.radius = 0.3, .focus = 7, .blades = blades});
    const Ray middle = f.ray({0.2, 0.9});
    const Vec3 sharp = middle.at(7 / dot(middle.direction, normalize(f.look)));
    for (const Vec2& u : {Vec2{0, 0}, Vec2{0.9, 0.3}, Vec2{0.5, 0.99}}) {
      const Ray ray = f.ray({0.2, 0.9}, u);
      EXPECT_LE(length(ray.origin - camera.position), 0.3 + 1e-12);
      EXPECT_NEAR(length(cross(sharp - ray.origin, ray.direction)), 0, 1e-12);
    }
  }
  const CameraFrame far = frame(camera, CameraAxes::orthonormal, {.radius = 0.3, .focus = kInfinity});
  EXPECT_EQ(far.ray({0.2, 0.9}, {0, 0.4}).direction, far.ray({0.2, 0.9}).direction);
}

}  // namespace
}  // namespace trace
