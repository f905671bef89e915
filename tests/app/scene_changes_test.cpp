// Which thing of a scene came or went, and what uses a material.
#include "app/scene_changes.h"

#include <gtest/gtest.h>

#include "geometry/shapes/csg.h"
#include "geometry/shapes/csg_tree.h"
#include "geometry/shapes/cube.h"
#include "geometry/shapes/sphere.h"

namespace trace::test {
namespace {

TEST(SceneChanges, TheOneThatCameIsFound) {
  const std::vector<int> all{4, 7, 7, 9};
  for (std::size_t i = 0; i < all.size(); ++i) {
    std::vector<int> fewer = all;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
    const auto came = oneMore(fewer, all);
    ASSERT_TRUE(came);
    EXPECT_EQ(all[*came], all[i]);
  }
  EXPECT_EQ(oneMore<int>({}, {5}), 0u);
  EXPECT_FALSE(oneMore(all, all));
  EXPECT_FALSE(oneMore({4, 7}, all));
  EXPECT_FALSE(oneMore({4, 8, 7}, all));  // another changed, too
}

TEST(SceneChanges, AnObjectUsesTheMaterialsOfItsParts) {
  Scene scene;
  scene.materials.resize(5);
  Union inner;
  inner.objects = Operands({{"", Sphere{}, {}, 3}, {"", Cube{}, {}, 2}});
  Difference whole;
  whole.objects = Operands({{"", Cube{}, {}, 1}, {"", inner, {}, 1}, {"", Sphere{}, {}, 2}});
  scene.objects.push_back({"", whole, {}, 0, {}});
  scene.objects.push_back({"", Sphere{}, {}, 1, {}});
  EXPECT_EQ(usersOf(scene, 0), 1u);
  EXPECT_EQ(usersOf(scene, 1), 2u);
  EXPECT_EQ(usersOf(scene, 2), 1u);
  EXPECT_EQ(usersOf(scene, 3), 1u);
  EXPECT_EQ(usersOf(scene, 4), 0u);
}

}  // namespace
}  // namespace trace::test
