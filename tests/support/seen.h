// A scene with its world, and where a ray meets it.
#pragma once

#include <gtest/gtest.h>

#include <utility>

#include "render/world/hit.h"
#include "render/world/world.h"

namespace trace::test {

struct Seen {
  Scene scene;
  World world;
  explicit Seen(Scene s)
      : scene(std::move(s)), world([&] {
          Messages messages;
          return compile(scene, Settings{}, messages);
        }()) {}

  /// Where the ray meets the one object.
  SurfacePoint at(const Vec3& from, const Vec3& direction) const { return hit(from, direction).surface; }
  Hit hit(const Vec3& from, const Vec3& direction) const {
    const Ray ray{from, normalize(direction)};
    Statistics statistics;
    const auto found = world.closest(ray, Faces::both, statistics);
    EXPECT_TRUE(found.has_value());
    return Hit(world, ray, *found);
  }
};

}  // namespace trace::test
