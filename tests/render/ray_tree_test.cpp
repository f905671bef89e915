// The record of one sample's rays: it adds up to the picture, and says what happened.
#include "render/rays/ray_tree.h"

#include <gtest/gtest.h>

#include <cstring>

#include "geometry/mesh/mesh.h"
#include "geometry/shapes/solids/cone.h"
#include "geometry/shapes/solids/csg.h"
#include "geometry/shapes/solids/cube.h"
#include "geometry/shapes/solids/square.h"
#include "render/picture/explain.h"
#include "render/rays/visited_boxes.h"
#include "shading/lights/directional_light.h"
#include "support/scenes.h"

namespace trace::test::ray_tree_test {
namespace {

bool sameBits(const Color& a, const Color& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

Explanation explainPixel(const Scene& scene, const Settings& settings, int x, int y, int sample = 0) {
  const World world = build(scene, settings);
  return explain(world, *integratorOf(world, settings), settings, pictureSize(settings, scene.camera), x, y,
                 sample);
}

std::vector<std::string> sentences(const Scene& scene, const Settings& settings) {
  std::vector<std::string> all;
  for (const RayNode& node : explainPixel(scene, settings, 0, 0).tree.nodes)
    all.push_back(sentence(node, scene));
  return all;
}

/// One pixel that looks down from (0, 0, 10).
Scene lookingDown() {
  Scene scene;
  scene.camera.position = {0, 0, 10};
  return scene;
}
const Settings kOnePixel{.width = 1, .airIndex = 1, .pixelPosition = PixelPosition::center};

TEST(RayTree, AddsUpToThePictureInRandomScenes) {
  Random random(5);
  for (int s = 0; s < 6; ++s) {
    const Scene scene = randomScene(random, 15);
    Settings settings{.width = 40, .spp = s % 2 ? 4 : 1, .depth = 4};
    settings.glass = s % 3 ? Glass::perCrossing : Glass::perDistance;
    const World world = build(scene, settings);
    const auto integrator = integratorOf(world, settings);
    const Size size = pictureSize(settings, scene.camera);
    const Picture rendered = picture(scene, settings);
    std::size_t rays = 0;
    for (int y = 0; y < size.height; y += 3)
      for (int x = 0; x < size.width; x += 3)
        for (int k = 0; k < settings.spp; ++k) {
          const Explanation e = explain(world, *integrator, settings, size, x, y, k);
          ASSERT_TRUE(sameBits(e.pixel, rendered.pixels[static_cast<size_t>(y * size.width + x)]));
          ASSERT_TRUE(sameBits(e.tree.nodes[0].radiance, e.samples[static_cast<size_t>(k)]));
          ASSERT_TRUE(sumsUp(e.tree));
          rays += e.tree.nodes.size();
        }
    EXPECT_GT(rays, 200u);
  }
}

TEST(RayTree, ParentsComeFirstAndTermsNameTheirRays) {
  Random random(6);
  const Scene scene = randomScene(random, 25);
  const Settings settings{.width = 30, .depth = 4};
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 30; ++x) {
      const RayTree tree = explainPixel(scene, settings, x, y).tree;
      std::vector<int> named(tree.nodes.size());
      for (int i = 0; i < static_cast<int>(tree.nodes.size()); ++i) {
        const RayNode& node = tree.nodes[static_cast<size_t>(i)];
        ASSERT_LT(node.parent, i);
        ASSERT_EQ(node.depth, i == 0 ? 0 : tree.nodes[static_cast<size_t>(node.parent)].depth + 1);
        ASSERT_FALSE(sentence(node, scene).empty());
        for (const Term& term : node.terms) {
          if (term.ray < 0) continue;
          const RayNode& child = tree.nodes[static_cast<size_t>(term.ray)];
          ASSERT_EQ(child.parent, i);
          ASSERT_TRUE(sameBits(child.radiance, term.value));
          ++named[static_cast<size_t>(term.ray)];
        }
      }
      for (size_t i = 1; i < named.size(); ++i) ASSERT_EQ(named[i], 1);
    }
}

TEST(RayTree, WeightsTimesLightOfTheLeavesIsThePixel) {
  Random random(7);
  const Scene scene = randomScene(random, 15);
  const Settings settings{.width = 20, .depth = 3};
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 20; ++x) {
      const Explanation e = explainPixel(scene, settings, x, y);
      Color sum;
      for (const RayNode& node : e.tree.nodes)
        for (const Term& term : node.terms)
          if (term.ray < 0 || term.kind == Term::Kind::light)
            sum += node.weight * node.through * term.factor * term.value;
      EXPECT_NEAR(sum.r, e.pixel.r, 1e-12 * (1 + e.pixel.r));
    }
}

TEST(RayTree, CountsWhatEachRayCost) {
  Random random(8);
  const Scene scene = randomScene(random, 40);
  const Settings settings{.width = 16, .height = 16, .depth = 3};
  Statistics rendered;
  picture(scene, settings, &rendered);
  std::uint64_t rays = 0, nodes = 0, tests = 0;
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x)
      for (const RayNode& node : explainPixel(scene, settings, x, y).tree.nodes)
        ++rays, nodes += node.nodes, tests += node.tests;
  EXPECT_EQ(rays, rendered.allRays());
  // Camera rays of a render go together, and share the nodes that they visit. They may test in another order.
  EXPECT_LE(rendered.nodes.count, nodes);
  EXPECT_GT(rendered.nodes.count, nodes / 4);
  std::uint64_t all = 0;
  for (std::uint64_t n : rendered.tests) all += n;
  EXPECT_NEAR(static_cast<double>(tests), static_cast<double>(all), 0.1 * static_cast<double>(all));
}

TEST(RayTree, VisitedBoxesAreThoseThatWereCountedAndTheRayMeetsThem) {
  Random random(9);
  const Scene scene = randomScene(random, 40);
  const Settings settings{.width = 12, .depth = 3};
  const World world = build(scene, settings);
  const auto integrator = integratorOf(world, settings);
  std::size_t ofObjects = 0, ofMeshes = 0;
  for (int y = 0; y < 12; ++y)
    for (int x = 0; x < 12; ++x)
      for (const RayNode& node : explain(world, *integrator, settings, {12, 12}, x, y, 0).tree.nodes) {
        const std::vector<VisitedBox> boxes = visitedBoxes(world, settings, node);
        ASSERT_EQ(boxes.size(), node.nodes);
        for (size_t i = 0; i < boxes.size(); ++i) {
          const VisitedBox& box = boxes[i];
          const bool top = box.object == NodeWatch::kTop;
          ASSERT_TRUE(top || scene.objects[box.object].shape.is<Mesh>());
          ++(top ? ofObjects : ofMeshes);
          if (i == 0 || boxes[i - 1].object != box.object) continue;  // a root is visited unseen
          // In the box's own space, the ray's line meets the box.
          const Affine toObject = top ? Affine{} : inverse(scene.objects[box.object].worldFromObject);
          const Vec3 o = toObject * node.ray.origin, d = linear(toObject, node.ray.direction);
          const Vec3 low = toObject * box.corners[0], high = toObject * box.corners[7];
          Real enter = 0, leave = kInfinity;
          for (int axis = 0; axis < 3; ++axis) {
            const Real a = (low[axis] - o[axis]) / d[axis], b = (high[axis] - o[axis]) / d[axis];
            enter = std::max(enter, std::min(a, b)), leave = std::min(leave, std::max(a, b));
          }
          ASSERT_LE(enter, leave + 1e-4);
        }
      }
  EXPECT_GT(ofObjects, 100u);
  EXPECT_GT(ofMeshes, 100u);
}

TEST(RayTree, EndsWithAnErrorWhereRaysAreBeyondCounting) {
  // Among half-transparent panes, every bounce doubles the rays.
  Scene scene = lookingDown();
  Phong pane;
  pane.reflective = pane.transmissive = Color(0.5);
  for (int z = -40; z <= 0; ++z) addObject(scene, Square{}, Affine::translation({0, 0, z * 0.1}), pane);
  Settings settings = kOnePixel;
  settings.depth = 20;
  try {
    explainPixel(scene, settings, 0, 0);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::limit);
  }
}

TEST(RayTree, SaysThatARayLeftTheScene) {
  EXPECT_EQ(sentences(lookingDown(), kOnePixel), std::vector<std::string>{"left the scene: background"});
}

TEST(RayTree, SaysThatTheCameraSeesNoNearerOrNoFarther) {
  Scene scene = lookingDown();
  addObject(scene, Square{}, {}, {});
  scene.objects[0].name = "sheet";
  scene.camera.near = 10.5;
  EXPECT_EQ(sentences(scene, kOnePixel).at(0),
            "sheet at distance 10 is nearer than the camera's near 10.5: background");
  scene.camera.near = 1, scene.camera.far = 9;
  EXPECT_EQ(sentences(scene, kOnePixel).at(0),
            "sheet at distance 10 is farther than the camera's far 9: background");
  scene.camera.far = 10;
  EXPECT_EQ(sentences(scene, kOnePixel).at(0), "opaque: neither mirror nor glass");
  scene.camera.near = 0, scene.camera.far = 9, scene.objects.clear();
  EXPECT_EQ(sentences(scene, kOnePixel).at(0), "left the scene: background");
}

// --- what a hit is made of ----------------------------------------------------------------------------

std::string madeOf(const Scene& scene, int ray = 0) {
  const RayTree tree = explainPixel(scene, kOnePixel, 0, 0).tree;
  return materialNames(scene, tree.nodes.at(static_cast<std::size_t>(ray)).materials);
}

Scene withMaterials(std::initializer_list<const char*> names) {
  Scene scene = lookingDown();
  for (const char* name : names) {
    Phong phong;
    phong.emissive = Color(static_cast<double>(scene.materials.size() + 1));
    scene.materials.push_back({name, phong, {}});
  }
  return scene;
}

TEST(RayTree, NamesTheMaterialOfThePartOfASolid) {
  // The camera looks into a hole that a cylinder of another material has cut.
  Scene scene = withMaterials({"whole", "block", "drill", ""});
  const Affine through = Affine::translation({0, 0, 0.25}) * Affine::scaling({0.25, 0.25, 9});
  const auto holed = [&](std::uint32_t drill) {
    return Difference{Operands({{"", Cube{}, {}, 1}, {"", Cylinder{}, through, drill}})};
  };
  scene.objects.push_back({"", holed(2), {}, 0, {}});
  EXPECT_EQ(madeOf(scene), "drill");
  EXPECT_EQ(whitted(*explainPixel(scene, kOnePixel, 0, 0).tree.nodes[0].bsdf).emissive, Color(3));
  scene.camera.position.x = 0.4;
  EXPECT_EQ(madeOf(scene), "block");
  scene.camera.position.x = 0;
  scene.objects[0].shape = Union{Operands({{"", holed(3), {}, 0}})};  // however deep
  EXPECT_EQ(madeOf(scene), "material 4");
}

TEST(RayTree, NamesTheMaterialsOfATrianglesCornersWithTheirWeights) {
  Scene scene = withMaterials({"whole", "red", "green", "blue"});
  auto data = std::make_shared<MeshData>();
  data->points = {{-1, -1, 0}, {3, -1, 0}, {-1, 3, 0}};
  data->triangles = {{0, 1, 2}};
  data->materials = {1, 2, 3};
  scene.objects.push_back({"", Mesh{data}, {}, 0, {}});
  EXPECT_EQ(madeOf(scene), "red 0.5 + green 0.25 + blue 0.25");
  data->materials = {1, 2, 1};
  EXPECT_EQ(madeOf(scene), "red 0.75 + green 0.25");
  data->materials = {3, 3, 3};
  EXPECT_EQ(madeOf(scene), "blue");
  data->materials.clear();
  EXPECT_EQ(madeOf(scene), "whole");
}

TEST(RayTree, NamesTheMaterialsOfWhatFiltersOrBlocksAShadowRay) {
  Scene scene = withMaterials({"floor", "dark", "glass"});
  scene.materials[0].model.edit<Phong>()->diffuse = Color(1);
  scene.materials[2].model.edit<Phong>()->transmissive = Color(0.5);
  scene.objects.push_back({"", Square{}, Affine::scaling({20, 20, 1}), 0, {}});
  const Affine over = Affine::translation({8, 0, 2});
  scene.objects.push_back({"", Union{Operands({{"", Cube{}, {}, 2}})}, over, 1, {}});
  scene.lights.push_back({DirectionalLight{.direction = {-8, 0, -2}, .color = Color(1)}, {}});
  const RayTree lit = explainPixel(scene, kOnePixel, 0, 0).tree;
  ASSERT_EQ(lit.nodes.at(1).filters.size(), 2u);
  EXPECT_EQ(materialNames(scene, lit.nodes[1].filters[0].materials), "glass");
  scene.objects[1].shape = Union{Operands({{"", Cube{}, {}, 1}})};
  const RayTree dark = explainPixel(scene, kOnePixel, 0, 0).tree;
  EXPECT_EQ(materialNames(scene, std::get<Blocked>(dark.nodes.at(1).ends.at(0)).materials), "dark");
}

TEST(RayTree, SaysWhatBlockedAShadowRay) {
  Scene scene = lookingDown();
  Phong grey;
  grey.diffuse = Color(0.5);
  addObject(scene, Square{}, Affine::scaling({20, 20, 1}), grey);
  for (Real z : {5.0, 2.0, 4.0}) addObject(scene, Square{}, Affine::translation({8, 0, z}), grey);
  scene.objects[2].name = "lid";
  scene.lights.push_back({DirectionalLight{.direction = {-8, 0, -2}, .color = Color(1)}, {}});
  EXPECT_EQ(sentences(scene, kOnePixel),
            (std::vector<std::string>{"opaque: neither mirror nor glass", "blocked by lid"}));
}

TEST(RayTree, SaysWhatFilteredAShadowRay) {
  Scene scene = lookingDown();
  Phong grey, glass;
  grey.diffuse = Color(0.5);
  glass.transmissive = {0.5, 0.25, 0};
  addObject(scene, Square{}, Affine::scaling({20, 20, 1}), grey);
  addObject(scene, Square{}, Affine::translation({8, 0, 2}), glass);
  scene.objects[1].name = "pane";
  scene.lights.push_back({DirectionalLight{.direction = {-8, 0, -2}, .color = Color(1)}, {}});
  const Explanation e = explainPixel(scene, kOnePixel, 0, 0);
  EXPECT_EQ(sentence(e.tree.nodes[1], scene), "reached the light, filtered by pane");
  ASSERT_EQ(e.tree.nodes[1].filters.size(), 1u);
  EXPECT_EQ(e.tree.nodes[1].filters[0].factor, glass.transmissive);
  EXPECT_EQ(e.tree.nodes[1].radiance, glass.transmissive);
}

TEST(RayTree, SaysWhyNoRayIsSentOn) {
  Scene scene = lookingDown();
  Phong mirror;
  mirror.reflective = Color(0.25);
  addObject(scene, Square{}, {}, mirror);
  Settings settings = kOnePixel;
  settings.depth = 0;
  EXPECT_EQ(sentences(scene, settings).at(0), "depth limit 0 reached: no reflection");
  settings.depth = 1, settings.threshold = 0.5;
  EXPECT_EQ(sentences(scene, settings).at(0), "contribution 0.25 below threshold 0.5: no reflection");
  settings.threshold = 0;
  EXPECT_EQ(sentences(scene, settings).at(0), "continues as reflection");
}

TEST(RayTree, SaysThatLightIsReflectedTotally) {
  // From inside a block of glass, 60 degrees against the upper face.
  Scene scene;
  Phong glass;
  glass.transmissive = Color(0.9), glass.index = 1.5;
  addObject(scene, Cube{}, Affine::scaling({100, 100, 2}), glass);
  scene.camera.viewdir = {std::sin(kPi / 3), 0, std::cos(kPi / 3)};
  const Explanation e = explainPixel(scene, kOnePixel, 0, 0);
  EXPECT_EQ(sentence(e.tree.nodes[0], scene), "total internal reflection: no refraction");
  EXPECT_TRUE(e.tree.nodes[0].hit->leaving);
  EXPECT_EQ(e.tree.nodes[0].indices.before, 1.5);
  EXPECT_EQ(e.tree.nodes[0].indices.behind, 1);
}

TEST(RayTree, RefusesPixelsAndSamplesOutsideThePicture) {
  const Settings settings{.width = 4, .height = 3, .spp = 4};
  for (auto [x, y, k] : {std::tuple{4, 0, 0}, {-1, 0, 0}, {0, 3, 0}, {0, -1, 0}, {0, 0, 4}, {0, 0, -1}})
    EXPECT_THROW(explainPixel(lookingDown(), settings, x, y, k), Error);
  EXPECT_EQ(explainPixel(lookingDown(), settings, 3, 2, 3).samples.size(), 4u);
}

TEST(RayTree, ASampleThatIsNoNumberIsExplainedToo) {
  Scene scene = lookingDown();
  Phong bad;
  bad.emissive = Color(std::numeric_limits<double>::quiet_NaN());
  addObject(scene, Square{}, {}, bad);
  const Explanation e = explainPixel(scene, kOnePixel, 0, 0);
  EXPECT_TRUE(std::isnan(e.samples[0].r));
  EXPECT_EQ(e.pixel, Color(0));
  EXPECT_TRUE(sumsUp(e.tree));
}

}  // namespace
}  // namespace trace::test::ray_tree_test
