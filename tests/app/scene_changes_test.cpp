// Which thing of a scene came or went, and what uses a material.
#include "app/editing/scene_changes.h"

#include <gtest/gtest.h>

#include <functional>

#include "geometry/shapes/solids/csg.h"
#include "geometry/shapes/solids/csg_tree.h"
#include "geometry/shapes/solids/cube.h"
#include "geometry/shapes/solids/sphere.h"

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

TEST(SceneChanges, ANameThatIsSharedFromNowOnIsTold) {
  Scene before;
  for (const char* name : {"ball", "", "wall", ""})
    before.objects.push_back({name, Shape(Sphere{}), {}, 0, {}});
  before.lights.resize(2);
  before.lights[0].links.name = before.lights[1].links.name = "key";
  const auto shared = [&](const std::function<void(Scene&)>& edit) {
    Scene after = before;
    edit(after);
    return sharedName(before, after);
  };
  EXPECT_EQ(shared([](Scene&) {}), "") << "they shared it before";
  EXPECT_EQ(shared([](Scene& s) { s.objects[1].name = "floor"; }), "");
  EXPECT_EQ(shared([](Scene& s) { s.objects[1].name = "ball"; }), "ball");
  EXPECT_EQ(shared([](Scene& s) { s.objects.push_back(s.objects[2]); }), "wall");
  EXPECT_EQ(shared([](Scene& s) { s.objects.erase(s.objects.begin()); }), "");
  EXPECT_EQ(shared([](Scene& s) { s.lights[0].links.name = "ball"; }), "") << "a light is no object";
  EXPECT_EQ(shared([](Scene& s) { s.lights.push_back(s.lights[0]); }), "key");
}

TEST(SceneChanges, LinksFollowWhatIsRenamed) {
  Scene before;
  for (const char* name : {"ball", "wall", "wall", ""})
    before.objects.push_back({name, Shape(Sphere{}), {}, 0, {}});
  before.lights.resize(1);
  before.lights[0].links = {"key", {"wall", "ball"}, {"ball", "gone"}};
  before.objects[3].links = {{"key"}, {"ball"}};
  const auto followed = [&](const std::function<void(Scene&)>& edit) {
    Scene after = before;
    edit(after);
    followNames(before, after);
    return after;
  };
  using Names = std::vector<std::string>;
  const Scene moon = followed([](Scene& s) { s.objects[0].name = "moon"; });
  EXPECT_EQ(moon.lights[0].links.lights, (Names{"wall", "moon"}));
  EXPECT_EQ(moon.lights[0].links.excludes, (Names{"moon", "gone"}));
  EXPECT_EQ(moon.objects[3].links.notLitBy, Names{"ball"}) << "a light would be meant";
  const Scene lamp = followed([](Scene& s) { s.lights[0].links.name = "lamp"; });
  EXPECT_EQ(lamp.objects[3].links.litBy, Names{"lamp"});
  EXPECT_EQ(followed([](Scene& s) { s.objects[1].name = "roof"; }).lights, before.lights)
      << "another one is called so still";
  EXPECT_EQ(followed([](Scene& s) { s.objects[0].name = ""; }).lights, before.lights);
  EXPECT_EQ(followed([](Scene& s) { s.objects.erase(s.objects.begin()); }).lights, before.lights);
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
