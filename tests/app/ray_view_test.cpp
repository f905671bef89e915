// What the studio shows of rays and of a scene in space, without its window.
#include "app/explain/ray_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app/explain/ray_segments.h"
#include "app/session/session.h"
#include "app/view/orbit_camera.h"
#include "app/view/space/scene_model.h"
#include "base/text.h"
#include "formats/format.h"
#include "geometry/shapes/solids/copies.h"
#include "geometry/shapes/solids/csg.h"
#include "geometry/shapes/solids/csg_tree.h"
#include "geometry/shapes/solids/cube.h"
#include "geometry/shapes/solids/plane.h"
#include "geometry/shapes/solids/sphere.h"
#include "geometry/shapes/solids/square.h"
#include "geometry/shapes/solids/torus.h"
#include "geometry/shapes/surfaces/isosurface.h"
#include "shading/lights/directional_light.h"
#include "shading/lights/point_light.h"
#include "support/random.h"
#include "support/scenes.h"

namespace trace::test {
namespace {

/// A mirror ball over a floor, with a light that a small ball hides from one place.
Scene mirrorScene() {
  Scene scene;
  Phong mirror, grey;
  mirror.reflective = Color(0.5), mirror.diffuse = Color(0.3);
  grey.diffuse = Color(0.8);
  addObject(scene, Sphere{}, {}, mirror);
  addObject(
      scene, Square{},
      Affine::translation({0, -1, 0}) * Affine::rotation({1, 0, 0}, -kPi / 2) * Affine::scaling({20, 20, 1}),
      grey);
  addObject(scene, Sphere{}, Affine::translation({0, 5, 0}), grey);
  scene.objects[0].name = "ball", scene.objects[1].name = "floor", scene.objects[2].name = "lid";
  scene.lights.push_back(
      {PointLight{.position = {0, 10, 0}, .color = Color(1), .constant = 1, .quadratic = 0}, {}});
  scene.lights.push_back({DirectionalLight{.direction = {0, -1, -1}, .color = Color(0.5)}, {}});
  scene.camera.position = {0, 0.5, 8};
  return scene;
}

struct Traced {
  Session session;
  RayTree tree;
};
void trace(Traced& traced, const Scene& scene, int x, int y, int depth) {
  Settings settings;
  settings.width = 40, settings.depth = depth;
  traced.session.open(scene, settings);
  traced.session.build();
  traced.tree = traced.session.explain(x, y, 0).tree;
}

TEST(RayView, TellsHowManyPhotonsWereCountedAndHowFarAway) {
  Settings settings;
  settings.width = 20;
  settings.integrator = IntegratorKind::photon;
  settings.photons = 100000;  // few lie too far apart to tell of what is near
  Session session;
  session.open(mirrorScene(), settings);
  session.build();
  const RayTree tree = session.explain(10, 16, 0).tree;
  std::size_t told = 0;
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const auto rows = numbersOf(tree, static_cast<int>(i), session.scene());
    auto row = rows.begin();
    for (const Term& term : tree.nodes[i].terms) {
      if (!term.photons) continue;
      row = std::find_if(row, rows.end(), [](const auto& each) { return each.first == "  photons"; });
      ASSERT_NE(row, rows.end());
      EXPECT_TRUE(row->second.starts_with(counted(term.photons->count, "photon") + " within "))
          << row->second;
      ++row;
      ++told;
    }
  }
  EXPECT_GT(told, 0u);
}

TEST(RayView, EveryRayHasNumbersUnderHeadings) {
  Traced traced;
  trace(traced, mirrorScene(), 20, 18, 5);
  ASSERT_GT(traced.tree.nodes.size(), 4u);
  for (int i = 0; i < static_cast<int>(traced.tree.nodes.size()); ++i) {
    const auto numbers = numbersOf(traced.tree, i, traced.session.scene());
    EXPECT_TRUE(numbers.front().second.empty());  // a heading
    EXPECT_GT(numbers.size(), 8u);
  }
  const auto numbers = numbersOf(traced.tree, 0, traced.session.scene());
  const auto row = [&](const std::string& name) {
    const auto found =
        std::find_if(numbers.begin(), numbers.end(), [&](const auto& n) { return n.first == name; });
    return found == numbers.end() ? "" : found->second;
  };
  EXPECT_EQ(row("kind"), "camera, depth 0");
  EXPECT_EQ(row("object"), "ball");
  EXPECT_EQ(row("index of refraction").substr(0, 6), "1.0003");
}

TEST(RayView, ATreeDoesNotDifferFromItself) {
  Traced traced;
  trace(traced, mirrorScene(), 20, 18, 5);
  const Scene& scene = traced.session.scene();
  const auto pairs = difference(traced.tree, scene, traced.tree, scene);
  EXPECT_EQ(pairs.size(), traced.tree.nodes.size());
  for (const RayPair& pair : pairs) {
    EXPECT_FALSE(pair.differs) << pair.what;
    EXPECT_EQ(pair.a, pair.b);
  }
}

TEST(RayView, ASmallerDepthLosesRaysAndTheDifferenceSaysWhich) {
  Traced deep, flat;
  trace(deep, mirrorScene(), 20, 18, 5);
  trace(flat, mirrorScene(), 20, 18, 0);
  ASSERT_LT(flat.tree.nodes.size(), deep.tree.nodes.size());
  const auto pairs = difference(deep.tree, deep.session.scene(), flat.tree, flat.session.scene());
  EXPECT_EQ(pairs.size(), deep.tree.nodes.size());
  std::size_t lost = 0;
  for (const RayPair& pair : pairs) {
    if (pair.b >= 0) continue;
    ++lost;
    EXPECT_EQ(pair.what, "only in the pinned");
  }
  EXPECT_EQ(lost, deep.tree.nodes.size() - flat.tree.nodes.size());
  EXPECT_TRUE(pairs.front().differs);  // the camera ray brings back less
  EXPECT_NE(pairs.front().what.find(" to "), std::string::npos);
}

TEST(RayView, WhatALightNoLongerReachesIsSaid) {
  Scene open = mirrorScene();
  open.objects[2].worldFromObject = Affine::translation({50, 5, 0});
  Traced before, now;
  trace(before, open, 20, 18, 0);
  trace(now, mirrorScene(), 20, 18, 0);
  const auto pairs = difference(before.tree, open, now.tree, mirrorScene());
  const auto blocked =
      std::find_if(pairs.begin(), pairs.end(), [](const RayPair& p) { return p.what == "now blocked"; });
  ASSERT_NE(blocked, pairs.end());
  EXPECT_EQ(sentence(now.tree.nodes[static_cast<std::size_t>(blocked->b)], mirrorScene()), "blocked by lid");
}

// --- the scene in space -------------------------------------------------------------------------------

TEST(SceneModel, HasEveryObjectInItsPlace) {
  Random random(7);
  const Scene scene = randomScene(random, 25);
  SceneModeler modeler;
  const SceneModel model = modeler.model(scene);
  ASSERT_EQ(model.parts.size(), scene.objects.size());
  std::size_t corners = 0;
  for (const ScenePart& part : model.parts) {
    EXPECT_EQ(part.first, corners);
    EXPECT_GT(part.count, 0u);
    corners += part.count;
    Box3 box;
    for (const Vec3& corner : part.box) box.extend(corner);
    const Real slack = 0.02 * maxComponent(box.size()) + 1e-6 * model.scale;
    SCOPED_TRACE(test::nameOf(scene.objects[static_cast<std::size_t>(&part - model.parts.data())].shape));
    for (std::size_t i = part.first; i < part.first + part.count; ++i) {
      const float* c = &model.corners[i * 6];
      const Vec3 p = Vec3(c[0], c[1], c[2]) * model.scale + model.origin;
      for (int axis = 0; axis < 3; ++axis) {
        ASSERT_GE(p[axis], box.low[axis] - slack);
        ASSERT_LE(p[axis], box.high[axis] + slack);
      }
    }
  }
  EXPECT_EQ(model.corners.size(), corners * 6);
  EXPECT_TRUE(sameModel(scene, scene));
  Scene moved = scene;
  moved.objects[3].worldFromObject.offset.x += 1;
  EXPECT_FALSE(sameModel(scene, moved));
  Scene painted = scene;
  painted.materials.emplace_back();
  painted.objects[3].material = static_cast<std::uint32_t>(painted.materials.size() - 1);
  EXPECT_FALSE(sameModel(scene, painted));
}

TEST(SceneModel, EdgesOfGlassAreSharp) {
  Phong glass, clay;
  glass.transmissive = Color(0.9);
  const auto creases = [&](auto shape, const Phong& material) {
    Scene scene;
    addObject(scene, shape, {}, material);
    return SceneModeler{}.model(scene).creases.size();
  };
  EXPECT_GE(creases(Cube{}, glass), 12u);
  EXPECT_EQ(creases(Cube{}, glass) % 12, 0u) << "each edge in as many pieces";
  EXPECT_EQ(creases(Cube{}, clay), 0u);
  EXPECT_EQ(creases(Sphere{}, glass), 0u);
  EXPECT_GT(creases(Square{}, glass), 3u) << "its border";
}

TEST(SceneModel, PartsOfASolidHaveTheirOwnMaterials) {
  const auto material = [](const Color& diffuse, const Color& transmissive) {
    Phong phong;
    phong.diffuse = diffuse, phong.transmissive = transmissive;
    return Material{"", phong, {}};
  };
  Scene scene;
  scene.materials = {material({0.9, 0, 0}, Color(0)), material({0, 0.9, 0}, Color(0)),
                     material(Color(0), Color(0.95))};
  Difference whole;
  whole.objects =
      Operands({{"", Cube{}, {}, 0},
                {"", Sphere{}, Affine::translation({0, 0, 0.5}) * Affine::scaling({0.25, 0.25, 0.25}), 1},
                {"", Sphere{}, Affine::translation({0.5, 0, 0}) * Affine::scaling({0.25, 0.25, 0.25}), 2}});
  scene.objects.push_back({"", whole, Affine::translation({3, 0, 0}), 0, {}});
  const SceneModel model = SceneModeler{}.model(scene);
  ASSERT_EQ(model.parts.size(), 3u);
  std::size_t corners = 0;
  for (const ScenePart& part : model.parts) {
    EXPECT_EQ(part.object, 0u);
    EXPECT_EQ(part.first, corners);
    corners += part.count;
    EXPECT_GT(part.count, 30u);
  }
  EXPECT_GT(model.parts[0].color.r, 0.8);
  EXPECT_GT(model.parts[1].color.g, 0.8);
  EXPECT_LT(model.parts[1].color.r, 0.2);
  EXPECT_EQ(model.parts[0].opacity, 1);
  EXPECT_LT(model.parts[2].opacity, 0.25);  // of glass
  for (std::size_t i = model.parts[1].first; i < model.parts[1].first + model.parts[1].count; ++i) {
    const Vec3 p =
        Vec3(model.corners[i * 6], model.corners[i * 6 + 1], model.corners[i * 6 + 2]) * model.scale +
        model.origin;
    EXPECT_LT(length(p - Vec3(3, 0, 0.5)), 0.3);  // where the green sphere took its bite
  }
}

TEST(SceneModel, HasTheColoursThatThePictureHasInWhiteLight) {
  Phong plain, mirror, glass, black;
  plain.diffuse = plain.ambient = {0.1, 0.3, 0.6}, plain.specular = Color(0.5);
  mirror.reflective = Color(0.9);
  glass.transmissive = {0.5, 0.9, 0.5};
  Scene scene;
  for (const Phong& phong : {plain, mirror, glass, black}) addObject(scene, Sphere{}, {}, phong);
  const SceneModel model = SceneModeler{}.model(scene);
  ASSERT_EQ(model.parts.size(), 4u);
  const Color& shown = model.parts[0].color;
  EXPECT_NEAR(shown.r, 0.1, 0.04);
  EXPECT_NEAR(shown.g, 0.3, 0.04);
  EXPECT_NEAR(shown.b, 0.6, 0.04);
  EXPECT_GT(model.parts[1].color.g, 0.3);  // what has no colour of its own is seen nevertheless
  EXPECT_GT(model.parts[2].color.g, model.parts[2].color.r);
  EXPECT_GT(model.parts[3].color.g, 0);
}

TEST(SceneModel, CurvedEdgesOfSolidsAreSmooth) {
  Scene scene;
  scene.materials.resize(2);
  const Vec3 centers[] = {{0, 0, 0}, {0.4, 0.4, 0.6}};
  Difference bowl;  // with a thin rim, near which both surfaces pass through the same cells
  bowl.objects = Operands({{"", Sphere{}, {}, 0}, {"", Sphere{}, Affine::translation(centers[1]), 1}});
  scene.objects.push_back({"", bowl, {}, 0, {}});
  const SceneModel model = SceneModeler{}.model(scene);
  ASSERT_EQ(model.parts.size(), 2u);
  Real farthest = 0;
  for (const ScenePart& part : model.parts)
    for (std::size_t i = part.first; i < part.first + part.count; ++i) {
      const float* c = &model.corners[i * 6];
      const Vec3 p = Vec3(c[0], c[1], c[2]) * model.scale + model.origin;
      const Vec3& center = centers[part.first == 0 ? 0 : 1];
      farthest = std::max(farthest, std::abs(length(p - center) - 1));
    }
  EXPECT_LT(farthest, 0.02);
}

TEST(SceneModel, SaysWhatIsDrawnCoarselyOrNotAtAll) {
  Scene scene;
  scene.file = "fine.ray";
  addObject(scene, Sphere{}, Affine{}, {});
  EXPECT_TRUE(SceneModeler{}.model(scene).warnings.empty());
  Isosurface waves;
  waves.formula = "sin(1000000000*x*y*z)";
  addObject(scene, waves, Affine{}, {});
  Ifs cube;  // with thousands of copies inside, each of which every ray has to pass by
  cube.maps = {{0.9, 0, 0, 0, 0, 0.9, 0, 0, 0, 0, 0.9, 0}};
  for (int i = 0; i < 8000; ++i)
    cube.maps.push_back({0.001, 0, 0, i % 20 * 0.04 - 0.4, 0, 0.001, 0, i / 20 % 20 * 0.04 - 0.4, 0, 0, 0.001,
                         i / 400 * 0.04 - 0.4});
  cube.levels = 1;
  addObject(scene, cube, Affine{}, {});
  SceneModeler modeler;
  const std::vector<Message> warnings = modeler.model(scene).warnings;
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_TRUE(warnings[0].what.starts_with("the view in space shows ifs in ")) << warnings[0].what;
  EXPECT_NE(warnings[0].what.find(" steps along it, not 24"), std::string::npos) << warnings[0].what;
  EXPECT_EQ(warnings[1].what,
            "the view in space leaves out 1 isosurface, which is empty or folds too finely for triangles");
  EXPECT_EQ(warnings[0].place.file, "fine.ray");
  EXPECT_EQ(modeler.model(scene).warnings, warnings);  // of shapes that were kept, too
}

TEST(SceneModel, HasFewerTrianglesForFramesThatMustNotBeLate) {
  Scene scene;
  for (int i = 0; i < 40; ++i) addObject(scene, Sphere{}, Affine::translation({3.0 * i, 0, 0}), {});
  const SceneModel model = SceneModeler{}.model(scene);
  const std::size_t known = model.shared.corners.size() / 6;
  ASSERT_GT(model.corners.size() / 18, 2 * SceneModel::kFewTriangles);  // or the test tests nothing
  std::size_t few = 0;
  for (const ScenePart& part : model.parts) {
    EXPECT_GT(part.fewCount, 0u);
    EXPECT_EQ(part.fewCount % 3, 0u);
    ASSERT_LE(part.fewFirst + part.fewCount, model.shared.indices.size());
    few += part.fewCount / 3;
    for (std::size_t i = part.fewFirst; i < part.fewFirst + part.fewCount; ++i) {
      ASSERT_LT(model.shared.indices[i], known);
      const float* c = &model.shared.corners[6 * model.shared.indices[i]];
      const Vec3 p = Vec3(c[0], c[1], c[2]) * model.scale + model.origin;
      EXPECT_NEAR(length(p - Vec3(3.0 * part.object, 0, 0)), 1, 0.01) << part.object;  // its own corner
    }
  }
  EXPECT_LT(few, SceneModel::kFewTriangles * 3 / 2);
  scene.objects.resize(1);
  const SceneModel one = SceneModeler{}.model(scene);  // has few of its own accord
  EXPECT_EQ(one.parts[0].fewFirst, one.parts[0].first);
  EXPECT_EQ(one.parts[0].fewCount, one.parts[0].count);
}

TEST(SceneModel, IsAsFineAsItIsAskedFor) {
  Scene scene;
  addObject(scene, Sphere{}, {}, {});
  SceneModeler modeler;
  const std::size_t usual = modeler.model(scene).corners.size();
  EXPECT_LT(modeler.model(scene, {}, 0.5).corners.size(), usual / 2);
  EXPECT_GT(modeler.model(scene, {}, 2).corners.size(), 2 * usual);
  EXPECT_EQ(modeler.model(scene).corners.size(), usual);
}

TEST(SceneModel, IsFramedOnWhatCanBeShownTogether) {
  for (const Real far : {1e12, 1e30, 1e300, -1e300, 1e308}) {
    Scene scene;
    addObject(scene, Sphere{}, Affine{}, {});
    addObject(scene, Cube{}, Affine::translation({2, 0, 0}), {});
    addObject(scene, Sphere{}, Affine::translation({far, 0, 0}), {});
    addObject(scene, Sphere{}, Affine::scaling({std::abs(far), 1, 1}), {});
    scene.camera.position = {0, 0, 8};
    const SceneModel model = SceneModeler{}.model(scene);
    ASSERT_EQ(model.parts.size(), 2u) << far;
    EXPECT_LT(maxComponent(frameOf(scene).size()), 10);
    for (const float x : model.corners) ASSERT_TRUE(std::isfinite(x));
    const Box3 seen = seenBy(build(scene), frameOf(scene));
    EXPECT_FALSE(seen.empty());
    EXPECT_LT(maxComponent(seen.size()), 20);
  }
  Scene one;  // alone it is framed, wherever it lies
  addObject(one, Sphere{}, Affine::translation({1e9, 0, 0}), {});
  EXPECT_EQ(SceneModeler{}.model(one).parts.size(), 1u);
}

TEST(SceneModel, AfterAnEditItIsThatOfANewModeler) {
  Random random(8);
  Scene scene = randomScene(random, 25);
  SceneModeler kept;
  kept.model(scene);
  scene.objects[2].shape = Torus{};
  scene.objects[4].worldFromObject.offset.x += 1;
  scene.objects.erase(scene.objects.begin() + 7);
  const SceneModel model = kept.model(scene), fresh = SceneModeler{}.model(scene);
  EXPECT_EQ(model.corners, fresh.corners);
  EXPECT_EQ(model.parts.size(), fresh.parts.size());
  EXPECT_TRUE(SceneModeler{}.model(scene, [] { return true; }).parts.empty());  // nobody wants it
}

TEST(SceneModel, APlaneIsCutOffSomeWayAroundTheScene) {
  for (const Real size : {1e-3, 1.0, 1e5}) {
    Scene scene;
    addObject(scene, Sphere{}, Affine::scaling({size, size, size}), {});
    addObject(scene, Plane{}, Affine::translation({0, 0, -size}) * Affine::rotation({1, 0, 0}, 0.3), {});
    scene.camera.position = {0, 0, 5 * size};
    const SceneModel model = SceneModeler{}.model(scene);
    ASSERT_EQ(model.parts.size(), 2u);
    const ScenePart& plane = model.parts[1];
    ASSERT_GT(plane.count, 100u);
    Box3 drawn;
    for (std::size_t i = plane.first; i < plane.first + plane.count; ++i) {
      const float* c = &model.corners[i * 6];
      for (int k = 0; k < 6; ++k) ASSERT_TRUE(std::isfinite(c[k]));
      drawn.extend(Vec3(c[0], c[1], c[2]) * model.scale + model.origin);
    }
    EXPECT_GT(drawn.size().x, 2 * size);
    EXPECT_LT(maxComponent(drawn.size()), 50 * size);
    for (const Vec3& corner : plane.box) EXPECT_TRUE(isFinite(corner));
  }
}

TEST(SceneModel, WhatTheCameraSeesIsWithoutTheFarEndsOfAFloor) {
  const Scene scene = mirrorScene();
  const World world = build(scene);
  const Box3 seen = seenBy(world, frameOf(scene));
  EXPECT_TRUE(seen.low.x < -0.5 && seen.high.x > 0.5 && seen.low.y < 0 && seen.high.y > 0);
  EXPECT_LT(maxComponent(seen.size()), 0.9 * maxComponent(world.bounds().size()));
  EXPECT_TRUE(seenBy(build(Scene{}), {}).empty());
  Scene endless = scene;
  endless.objects[1].shape = Plane{};  // the floor, up to the horizon
  EXPECT_LT(maxComponent(seenBy(build(endless), frameOf(endless)).size()), 40);
}

TEST(OrbitCamera, BeginsWhereASceneCameraIs) {
  Camera camera;
  camera.position = {3, 2, 4}, camera.viewdir = {-3, -2, -4}, camera.fov = 20, camera.aspectratio = 1.5;
  const CameraFrame scene = frame(camera, CameraAxes::orthonormal);
  for (const Vec3& up : {Vec3{0, 1, 0}, Vec3{0, -1, 0}}) {
    camera.updir = up;
    const CameraFrame before = frame(camera, CameraAxes::orthonormal);
    const CameraFrame after = OrbitCamera::from(before, up, 7).frame(1.5);
    EXPECT_LT(length(after.eye - before.eye), 1e-12);
    for (const double x : {0.0, 0.3, 1.0})
      EXPECT_LT(length(after.ray({x, 1 - x}).direction - before.ray({x, 1 - x}).direction), 1e-12);
  }
  OrbitCamera orbit = OrbitCamera::from(scene, {0, 1, 0}, 7);
  orbit.approach(0.5);
  EXPECT_NEAR(length(orbit.frame(1).eye - orbit.target()), 3.5, 1e-12);
}

TEST(OrbitCamera, SeesItsTargetAndTheSceneCameraAndTurnsAboutTheTarget) {
  for (const Vec3& up : {Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{0, -1, 0}}) {
    Camera camera;
    camera.position = {3, 2, 4}, camera.viewdir = {-3, -2, -4}, camera.updir = up;
    const Box3 target{{-1, -1, -1}, {1, 1, 1}};
    OrbitCamera orbit(target, camera);
    for (int turn = 0; turn < 20; ++turn) {
      const Matrix4 matrix = projection(orbit.frame(1.5), 0.01, 100);
      for (const Vec3& p : {target.low, target.high, camera.position}) {
        const auto c = transform(matrix, p);
        ASSERT_GT(c[3], 0);
        for (std::size_t i = 0; i < 3; ++i) EXPECT_LE(std::abs(c[i]), c[3] * 1.01);
      }
      orbit.turn(0.7, 0.9 * (turn % 2 ? 1 : -1));
    }
    const auto middle = transform(projection(orbit.frame(1), 0.01, 100), orbit.target());
    EXPECT_NEAR(middle[0] / middle[3], 0, 1e-9);
    EXPECT_NEAR(middle[1] / middle[3], 0, 1e-9);
  }
}

TEST(OrbitCamera, LooksAtABoxFromTheSameSide) {
  Camera camera;
  camera.position = {3, 2, 4}, camera.viewdir = {-3, -2, -4};
  OrbitCamera orbit({{-1, -1, -1}, {1, 1, 1}}, camera);
  const Vec3 before = orbit.frame(1).ahead;
  const Box3 box{{5, 5, 5}, {6, 7, 8}};
  orbit.lookAt(box);
  EXPECT_LT(length(orbit.frame(1).ahead - before), 1e-12);
  const Matrix4 matrix = projection(orbit.frame(1), 0.01, 100);
  Real widest = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const auto c =
        transform(matrix, {corner & 1 ? box.high.x : box.low.x, corner & 2 ? box.high.y : box.low.y,
                           corner & 4 ? box.high.z : box.low.z});
    ASSERT_GT(c[3], 0);
    for (std::size_t i = 0; i < 2; ++i) widest = std::max(widest, std::abs(c[i]) / c[3]);
  }
  EXPECT_LE(widest, 1);
  EXPECT_GE(widest, 0.4);
}

TEST(OrbitCamera, TheViewFromTheCameraShowsItsPictureWhole) {
  Camera camera;
  camera.position = {1, 2, 3}, camera.aspectratio = 1.6;
  const CameraFrame f = frame(camera, CameraAxes::orthonormal);
  for (const Real aspect : {0.5, 1.6, 4.0}) {
    const Matrix4 matrix = projection(fitted(f, aspect), 0.01, 100);
    Real widest = 0;
    for (const Vec2& corner : {Vec2{0, 0}, Vec2{1, 0}, Vec2{0, 1}, Vec2{1, 1}}) {
      const auto c = transform(matrix, f.ray({corner.x, corner.y}).at(5));
      for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_LE(std::abs(c[i] / c[3]), 1 + 1e-9);
        widest = std::max(widest, std::abs(c[i] / c[3]));
      }
      EXPECT_EQ(c[0] < 0, corner.x < 0.5);
      EXPECT_EQ(c[1] < 0, corner.y < 0.5);
    }
    EXPECT_NEAR(widest, 1, 1e-9);
  }
}

TEST(SceneModel, ATexturedSurfaceHasTheMeanColourOfItsTexture) {
  Messages messages;
  const Scene scene = readScene(
      "a.ray",
      "SBT-raytracer 1.0\nsphere { material = { diffuse = checker { scale = (0.3, 0.3, 0.3); a = (1, 0, 0); "
      "b = (0, 0, 1); }; } }\n",
      messages);
  const SceneModel model = SceneModeler().model(scene);
  ASSERT_EQ(model.parts.size(), 1u);
  const Color& c = model.parts.front().color;
  EXPECT_NEAR(c.r, 0.5, 0.15);
  EXPECT_NEAR(c.b, 0.5, 0.15);
  EXPECT_LT(c.g, 0.1);
}

TEST(RayView, AFarFloorDoesNotKeepTheRestOutOfSight) {
  std::vector<RaySegment> segments;
  segments.push_back({.from = {0, 0, 9}, .to = {0, 0, 1}});
  segments.push_back({.node = 1, .looks = RayLooks::refraction, .from = {0, 0, 1}, .to = {0, 0, -1}});
  segments.push_back({.node = 2, .looks = RayLooks::refraction, .from = {0, 0, -1}, .to = {0, 0, -5000}});
  const Box3 near = boundsOf(segments, 20);
  EXPECT_EQ(near.low, Vec3(0, 0, -1));
  EXPECT_EQ(near.high, Vec3(0, 0, 1));
  EXPECT_EQ(boundsOf(segments).low.z, -5000);
}

TEST(SceneModel, SharesTheCornersOfTriangles) {
  Scene scene;
  addObject(scene, Sphere{}, {}, {});
  addObject(scene, Cube{}, Affine::translation({3, 0, 0}), {});
  const SceneModel model = SceneModeler().model(scene);
  const SharedCorners& shared = model.shared;
  ASSERT_EQ(shared.indices.size(), model.corners.size() / 6);
  EXPECT_LT(shared.corners.size(), model.corners.size() / 3);
  for (std::size_t i = 0; i < model.corners.size(); ++i)
    ASSERT_EQ(model.corners[i], shared.corners[6 * shared.indices[i / 6] + i % 6]);
}

}  // namespace
}  // namespace trace::test
