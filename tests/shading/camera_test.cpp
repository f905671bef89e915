#include "shading/cameras/camera.h"

#include <gtest/gtest.h>

#include <string>

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
  const CameraFrame f = frame({}, CameraAxes::orthonormal, {.lens = lens});
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
        frame(camera, CameraAxes::orthonormal, {.lens = {.radius = 0.3, .focus = 7, .blades = blades}});
    const Ray middle = f.ray({0.2, 0.9});
    const Vec3 sharp = middle.at(7 / dot(middle.direction, normalize(f.look)));
    for (const Vec2& u : {Vec2{0, 0}, Vec2{0.9, 0.3}, Vec2{0.5, 0.99}}) {
      const Ray ray = f.ray({0.2, 0.9}, u);
      EXPECT_LE(length(ray.origin - camera.position), 0.3 + 1e-12);
      EXPECT_NEAR(length(cross(sharp - ray.origin, ray.direction)), 0, 1e-12);
    }
  }
  const CameraFrame far =
      frame(camera, CameraAxes::orthonormal, {.lens = {.radius = 0.3, .focus = kInfinity}});
  EXPECT_EQ(far.ray({0.2, 0.9}, {0, 0.4}).direction, far.ray({0.2, 0.9}).direction);
}

// --- projections --------------------------------------------------------------------------------------

const Camera& slantedCamera() {
  static const Camera camera{
      .position = {1, 2, 3}, .viewdir = {1, 1, -2}, .updir = {0, 1, 0}, .fov = 50, .aspectratio = 1.5};
  return camera;
}

void expectNear(const Vec2& a, const Vec2& b, const std::string& name) {
  EXPECT_NEAR(a.x, b.x, 1e-9) << name;
  EXPECT_NEAR(a.y, b.y, 1e-9) << name;
}

TEST(Camera, EveryProjectionFindsTheWayBack) {
  for (const Projection projection : {Projection::perspective, Projection::orthographic, Projection::fisheye,
                                      Projection::panorama, Projection::cylinder})
    for (const Real distortion : {-0.05, 0.0, 0.4})
      for (const Stereo stereo : {Stereo::off, Stereo::sideBySide, Stereo::crossEyed, Stereo::overUnder})
        for (const Real zeroParallax : {4.0, kInfinity}) {
          const CameraFrame f = frame(slantedCamera(), CameraAxes::orthonormal,
                                      {.projection = projection,
                                       .viewHeight = 3,
                                       .fisheyeAngle = 2.5,
                                       .distortion = distortion,
                                       .stereo = stereo,
                                       .eyeSeparation = 0.2,
                                       .zeroParallax = zeroParallax});
          const std::string name = std::to_string(static_cast<int>(projection)) + " " +
                                   std::to_string(static_cast<int>(stereo)) + " " +
                                   std::to_string(distortion);
          for (const Vec2& place : {Vec2{0.3, 0.4}, Vec2{0.45, 0.7}, Vec2{0.2, 0.55}}) {
            Vec2 left = place;  // in the part of the left eye
            if (stereo == Stereo::sideBySide) left.x /= 2;
            if (stereo == Stereo::crossEyed) left.x = 0.5 + left.x / 2;
            if (stereo == Stereo::overUnder) left.y = 0.5 + left.y / 2;
            const Ray ray = f.ray(left);
            EXPECT_NEAR(length(ray.direction), 1, 1e-12) << name;
            const auto seen = f.placeOf(ray.at(7));
            ASSERT_TRUE(seen) << name;
            expectNear(*seen, left, name);
            if (stereo == Stereo::off) expectNear(f.placeOf(ray), place, name);
          }
        }
}

TEST(Camera, OrthographicRaysAreParallel) {
  const CameraFrame f = frame({}, CameraAxes::orthonormal,
                              {.projection = Projection::orthographic, .viewHeight = 3, .shift = {0, 0.5}});
  EXPECT_EQ(f.ray({0.2, 0.9}).direction, Vec3(0, 0, -1));
  EXPECT_NEAR(length(f.ray({1, 1}).origin - Vec3(1.5, 3, 0)), 0, 1e-12);
  EXPECT_FALSE(f.placeOf(Vec3{0, 0, 1})) << "behind the camera";
}

TEST(Camera, APanoramaIsAllAround) {
  const CameraFrame f = frame({}, CameraAxes::orthonormal, {.projection = Projection::panorama});
  const auto looks = [&](Real x, Real y, const Vec3& there) {
    EXPECT_NEAR(length(f.ray({x, y}).direction - there), 0, 1e-12) << x << ", " << y;
  };
  looks(0.5, 0.5, {0, 0, -1});
  looks(0.75, 0.5, {1, 0, 0});
  looks(0.25, 0.5, {-1, 0, 0});
  looks(0, 0.5, {0, 0, 1});
  looks(0.3, 1, {0, 1, 0});
  looks(0.5, 0.25, {0, -std::sqrt(0.5), -std::sqrt(0.5)});
}

TEST(Camera, AFisheyeMeasuresAngles) {
  const CameraFrame f =
      frame({}, CameraAxes::orthonormal, {.projection = Projection::fisheye, .fisheyeAngle = kPi});
  EXPECT_NEAR(length(f.ray({1, 0.5}).direction - Vec3(1, 0, 0)), 0, 1e-12);
  EXPECT_NEAR(std::acos(-f.ray({0.5, 0.6}).direction.z), kPi / 10, 1e-12);
}

TEST(Camera, AShiftedFilmKeepsUprightLinesUpright) {
  const CameraFrame f = frame({}, CameraAxes::orthonormal, {.shift = {0, 0.4}});
  EXPECT_NEAR(f.placeOf(Vec3{1, 0, -5})->x, f.placeOf(Vec3{1, 3, -5})->x, 1e-12);
  EXPECT_NEAR(f.placeOf(Vec3{0, 0, -5})->y, 0.5 - 0.4, 1e-12);
}

TEST(Camera, ATiltedPlaneIsInFocus) {
  const Real tilt = 0.6;
  const CameraFrame f =
      frame({}, CameraAxes::orthonormal, {.tilt = tilt, .lens = {.radius = 0.2, .focus = 5}});
  // Places of the plane through (0, 0, -5) whose normal is the view turned upward by the tilt.
  const Vec3 normal{0, std::sin(tilt), -std::cos(tilt)};
  for (const Vec2& place : {Vec2{0.5, 0.5}, Vec2{0.2, 0.9}, Vec2{0.7, 0.1}}) {
    const Vec3 direction = f.ray(place).direction;
    const Vec3 sharp = direction * (dot(normal, Vec3{0, 0, -5}) / dot(normal, direction));
    for (const Vec2& u : {Vec2{0, 0}, Vec2{0.9, 0.3}}) {
      const Ray ray = f.ray(place, u);
      EXPECT_GT(length(ray.origin), 0.01);
      EXPECT_NEAR(length(cross(sharp - ray.origin, ray.direction)), 0, 1e-12);
    }
  }
}

// --- two eyes -----------------------------------------------------------------------------------------

TEST(Camera, ParallaxIsThatOfTwoEyes) {
  // Hodges and McAllister: at distance Z the left eye sees a point s (1/Z - 1/Z0) d / 2 to the right of where
  // both see it at Z0, on a film at distance d; d = 1 and the film is 1 wide. There is none upward.
  const Real separation = 0.3, screen = 4;
  const CameraFrame f =
      frame({}, CameraAxes::orthonormal,
            {.stereo = Stereo::sideBySide, .eyeSeparation = separation, .zeroParallax = screen});
  for (const Real distance : {2.0, 4.0, 9.0}) {
    const Vec2 seen = *f.placeOf(Vec3{0.2 * distance, 0.1 * distance, -distance});
    EXPECT_NEAR(2 * seen.x, 0.7 + separation / 2 * (1 / distance - 1 / screen), 1e-12) << distance;
    EXPECT_NEAR(seen.y, 0.6, 1e-12) << distance;
  }
  const Ray left = f.ray({0.25, 0.5}), right = f.ray({0.75, 0.5});
  EXPECT_NEAR(length(left.origin - Vec3{-separation / 2, 0, 0}), 0, 1e-12);
  EXPECT_NEAR(length(right.origin - Vec3{separation / 2, 0, 0}), 0, 1e-12);
}

TEST(Camera, APixelOfOneEyeNeverShowsTheOther) {
  const CameraFrame f = frame({}, CameraAxes::orthonormal, {.stereo = Stereo::sideBySide});
  EXPECT_LT(f.inEyeOf({0.49, 0.2}, {0.51, 0.2}).x, 0.5);
  EXPECT_EQ(f.inEyeOf({0.51, 0.2}, {0.48, 0.2}).x, 0.5);
  EXPECT_EQ(f.inEyeOf({0.51, 0.2}, {0.6, 0.9}), (Vec2{0.6, 0.9}));
}

}  // namespace
}  // namespace trace
