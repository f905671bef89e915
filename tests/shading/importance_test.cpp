// The camera as light sees it, against the camera that sends rays.
#include "shading/cameras/importance.h"

#include <gtest/gtest.h>

#include "support/random.h"

namespace trace::test {
namespace {

std::vector<Optics> optics() {
  return {{},
          {.shift = {0.2, -0.1}},
          {.lens = {.radius = 0.3, .focus = 4}},
          {.lens = {.radius = 0.3, .focus = kInfinity}},
          {.shift = {0.2, -0.1}, .lens = {.radius = 0.2, .focus = 3, .blades = 5}},
          {.projection = Projection::orthographic, .viewHeight = 3},
          {.projection = Projection::fisheye, .fisheyeAngle = 3},
          {.projection = Projection::panorama},
          {.projection = Projection::cylinder}};
}

TEST(CameraImportance, IsTheDensityOfCameraRaysAndFindsTheirPlaces) {
  Camera camera;
  camera.position = {1, 2, 3}, camera.viewdir = {-1, -0.5, -2}, camera.updir = {0.2, 1, 0};
  camera.fov = 50, camera.aspectratio = 1.4;
  Random random(4);
  for (const CameraAxes axes : {CameraAxes::orthonormal, CameraAxes::raw})
    for (const Optics& o : optics()) {
      const CameraFrame frame = trace::frame(camera, axes, o);
      const CameraImportance importance(frame);
      ASSERT_TRUE(importance.known());
      if (axes == CameraAxes::raw && o.projection != Projection::perspective) continue;
      for (int i = 0; i < 50; ++i) {
        const Vec2 place{random.uniform(0.1, 0.9), random.uniform(0.1, 0.9)};
        const Vec2 u{random.uniform(), random.uniform()};
        const Ray ray = frame.ray(place, u);
        // How much of directions, or of places, a part of the picture covers: by differences.
        constexpr Real kStep = 1e-5;
        const auto change = [&](const Vec2& step) {
          const Ray more = frame.ray({place.x + step.x, place.y + step.y}, u);
          const Ray less = frame.ray({place.x - step.x, place.y - step.y}, u);
          const Vec3 way =
              importance.parallel() ? more.origin - less.origin : more.direction - less.direction;
          return way / (2 * kStep);
        };
        const Real covered = length(cross(change({kStep, 0}), change({0, kStep})));
        EXPECT_NEAR(importance.density(ray) * covered, 1, 1e-6) << static_cast<int>(o.projection);

        const auto seen = importance.sees(ray.at(2.5), u);
        ASSERT_TRUE(seen);
        EXPECT_NEAR(seen->distance, 2.5, 1e-12);
        EXPECT_LT(length(seen->ray.direction - ray.direction), 1e-12);
        EXPECT_NEAR(seen->place.x, place.x, 1e-9);
        EXPECT_NEAR(seen->place.y, place.y, 1e-9);
      }
    }
}

TEST(CameraImportance, SeesNothingBehindAndDoesNotKnowWhatBends) {
  const CameraFrame frame = trace::frame({}, CameraAxes::orthonormal);
  EXPECT_FALSE(CameraImportance(frame).sees({0, 0, 1}, {0.5, 0.5}));
  EXPECT_TRUE(CameraImportance(frame).sees({0, 0, -1}, {0.5, 0.5}));
  for (const Optics& o : {Optics{.distortion = 0.1}, Optics{.stereo = Stereo::sideBySide},
                          Optics{.projection = Projection::fisheye, .lens = {.radius = 0.1, .focus = 1}}})
    EXPECT_FALSE(CameraImportance(trace::frame({}, CameraAxes::orthonormal, o)).known());
}

}  // namespace
}  // namespace trace::test
