// The sentence that says why a pixel has its colour, the sum, and the cures.
#include "app/explain/pixel_why.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "app/explain/pixel_inspector.h"
#include "app/explain/ray_words.h"
#include "app/session/session.h"
#include "formats/format.h"
#include "geometry/shapes/solids/cube.h"
#include "geometry/shapes/solids/sphere.h"
#include "shading/lights/ambient_light.h"
#include "support/scenes.h"

namespace trace::test {
namespace {

/// A ball at the origin, seen from the front.
Scene ballOf(const Phong& material) {
  Scene scene;
  addObject(scene, Sphere{}, {}, material);
  scene.objects.back().name = "ball";
  scene.camera.position = {0, 0, 6};
  return scene;
}

PixelWhy whyOf(const Scene& scene, Settings settings, int x = 20, int y = 20) {
  settings.width = settings.height = 40;
  Session session;
  session.open(scene, settings);
  session.build();
  const Explanation explanation = session.explain(x, y, 0);
  return trace::whyOf(explanation.tree, session.scene(), session.settings());
}

/// The pixel of a scene in text, as the studio explains it: cures are tried.
TracedPixel traced(const std::string& text, Settings settings, int x, int y) {
  Messages messages;
  auto session = std::make_shared<Session>();
  session->open(readScene("why.ray", "SBT-raytracer 1.0\n" + text, messages), settings);
  session->build();
  return tracePixel(session, x, y, 0);
}

/// A glass box and a glass ball on a floor, before a background.
const std::string kGlassScene = R"(
camera { position = (0, 2.6, 7); look_at = (0, 0.8, 0); fov = 34; aspectratio = 1.5; }
background { color = (0.5, 0.7, 0.9); }
point_light { name = "lamp"; position = (-4, 5, 3); color = (0.8, 0.8, 0.8); }
rotate(1, 0, 0, -1.5708, scale(30, 30, 1, square { name = "floor";
  material = { diffuse = (0.8, 0.8, 0.8); ambient = (0.8, 0.8, 0.8); } }))
translate(-1.2, 1.01, 0, rotate(0, 1, 0, 0.6, scale(2, box { name = "glass box";
  material = { transmissive = (1, 1, 1); index = 1.5; } })))
translate(1.6, 1, 0.3, sphere { name = "glass ball"; material = { transmissive = (1, 1, 1); index = 1.5; } })
)";

/// Lights above a floor, with a ball between.
std::string litFloor(const std::string& lights, const std::string& material) {
  return "camera { position = (0, 3, 6); look_at = (0, 0, 0); fov = 30; aspectratio = 1; }\n" + lights +
         "rotate(1, 0, 0, -1.5708, scale(30, 30, 1, square { name = \"floor\"; "
         "material = { diffuse = (0.8, 0.8, 0.8); } }))\n"
         "translate(0, 2.2, 0, scale(0.3, sphere { name = \"ball\"; material = { " +
         material + " } }))\n";
}
constexpr std::string_view kSun = "directional_light { direction = (0, -1, 0); color = (0.7, 0.7, 0.7); }\n";

Phong grey() {
  Phong grey;
  grey.diffuse = Color(0.7);
  return grey;
}

TEST(PixelWhy, GlassIsBlackForTheRayThatTheDepthDidNotSend) {
  Phong glass;
  glass.transmissive = Color(0.9), glass.index = 1.5;
  Scene scene = ballOf(glass);
  Phong sky;
  sky.emissive = Color(0.8);
  addObject(scene, Sphere{}, Affine::scaling({50, 50, 50}), sky);
  const PixelWhy why = whyOf(scene, {.depth = 1});
  EXPECT_EQ(why.sentence, "Black: the ray that should leave ball was not sent: depth limit 1.");
  EXPECT_EQ(why.ray, 1);
  ASSERT_EQ(why.cures.size(), 2u);
  EXPECT_EQ(why.cures[0].label, "depth 2");
  EXPECT_EQ(why.cures[1].option, "depth");
  EXPECT_EQ(why.cures[1].value, "5");
  // The cure cures.
  const PixelWhy cured = whyOf(scene, {.depth = 5});
  EXPECT_EQ(cured.ray, -1) << cured.sentence;
  EXPECT_TRUE(cured.cures.empty());
}

TEST(PixelWhy, AMirrorIsBlackForItsReflection) {
  Phong mirror;
  mirror.reflective = Color(0.9);
  const PixelWhy why = whyOf(ballOf(mirror), {.depth = 0});
  EXPECT_EQ(why.sentence, "Black: the ray that ball should reflect was not sent: depth limit 0.");
  EXPECT_EQ(why.cures.front().value, "1");
}

TEST(PixelWhy, TheLastOfManyBouncesIsNotToBlame) {
  Phong white;
  white.diffuse = Color(0.9), white.emissive = Color(0.05);
  Scene room;
  addObject(room, Cube{}, Affine::scaling({8, 8, 8}), white);
  room.objects.back().name = "room";
  room.camera.position = {0, 0, 2};
  const PixelWhy why = whyOf(room, {.integrator = IntegratorKind::path, .depth = 4});
  EXPECT_EQ(why.ray, -1) << why.sentence;
  EXPECT_EQ(why.sentence.find("depth limit"), std::string::npos) << why.sentence;
}

TEST(PixelWhy, AShadowNamesWhatBlocksTheLight) {
  Scene scene = ballOf(grey());
  addObject(scene, Cube{}, Affine::translation({0, 0, 8}), grey());
  scene.objects.back().name = "wall";
  scene.lights.push_back({DirectionalLight{.direction = {0, 0, -1}, .color = Color(1)}, {}});
  scene.lights.back().links.name = "sun";
  const PixelWhy why = whyOf(scene, {});
  EXPECT_EQ(why.sentence, "Black: wall blocks sun from ball.");
  EXPECT_GE(why.ray, 0);
  ASSERT_EQ(why.cures.size(), 1u);
  EXPECT_EQ(why.cures[0].label, "Select wall");
  EXPECT_EQ(why.cures[0].object, 1u);
}

TEST(PixelWhy, ASurfaceThatFacesAwaySaysSo) {
  Scene scene = ballOf(grey());
  scene.lights.push_back({DirectionalLight{.direction = {0, 0, 1}, .color = Color(1)}, {}});
  scene.lights.back().links.name = "sun";
  EXPECT_EQ(whyOf(scene, {}).sentence, "Black: ball faces away from sun.");
}

TEST(PixelWhy, TotalReflectionIsNamedAndNoNormalIsBlamed) {
  for (const auto& [x, y] : {std::pair{60, 110}, std::pair{150, 150}}) {
    const PixelWhy why = traced(kGlassScene, {.width = 360, .depth = 8}, x, y).why;
    EXPECT_EQ(why.sentence, "Black: the ray cannot leave glass box there (total internal reflection).");
    EXPECT_EQ(why.ray, 1);
  }
}

TEST(PixelWhy, FresnelCuresTotalReflectionWhereTheMirroredRayBringsLight) {
  const std::string sky = "background { gradient = ((1, 1, 1), (1, 1, 1)); }\n";
  const std::string own = "background { color = (0.5, 0.7, 0.9); }";
  std::string bright = kGlassScene;
  bright.replace(bright.find(own), own.size(), sky);
  const PixelWhy why = traced(bright, {.width = 360, .depth = 8}, 60, 110).why;
  ASSERT_FALSE(why.cures.empty());
  EXPECT_EQ(why.cures.back().label, "fresnel exact");
}

TEST(PixelWhy, ARefractedRayThatLeavesTheSceneIsNamed) {
  const PixelWhy why = traced(kGlassScene, {.width = 360, .depth = 8}, 273, 150).why;
  EXPECT_EQ(why.sentence,
            "Black: the ray that leaves glass ball left the scene, and only camera rays see the background.");
  EXPECT_EQ(why.ray, 2);
  EXPECT_TRUE(why.cures.empty());
}

TEST(PixelWhy, ADepthThatDoesNotHelpIsNotOffered) {
  const std::string twoBalls =
      "camera { position = (0, 0, 6); look_at = (0, 0, 0); fov = 30; aspectratio = 1; }\n"
      "sphere { name = \"ball\"; material = { transmissive = (0.9, 0.9, 0.9); index = 1.5; } }\n";
  const PixelWhy empty = traced(twoBalls, {.width = 40, .depth = 1}, 20, 20).why;
  EXPECT_EQ(empty.sentence.find("depth"), std::string::npos) << empty.sentence;
  EXPECT_TRUE(std::none_of(empty.cures.begin(), empty.cures.end(),
                           [](const WhyCure& cure) { return cure.option == "depth"; }));
  const PixelWhy sky = traced(twoBalls + "background { gradient = ((1, 1, 1), (1, 1, 1)); }\n",
                              {.width = 40, .depth = 1}, 20, 20)
                           .why;
  EXPECT_EQ(sky.sentence, "Black: the ray that should leave ball was not sent: depth limit 1.");
  EXPECT_EQ(sky.cures.size(), 2u);
}

TEST(PixelWhy, LightThatGlassFiltersSaysSo) {
  const std::string glass = "transmissive = (0.5, 0.5, 0.5); index = 1.5;";
  const TracedPixel pixel = traced(litFloor(std::string(kSun), glass), {.width = 40}, 20, 20);
  EXPECT_EQ(pixel.why.sentence, "In shadow: ball filters directional_light to 25 %.");
  const std::string clear = "transmissive = (0.95, 0.95, 0.95); index = 1.5;";
  EXPECT_EQ(traced(litFloor(std::string(kSun), clear), {.width = 40}, 20, 20).why.sentence,
            "floor shows only the light of directional_light, filtered by ball to 90 %.");
  EXPECT_EQ(filtersOf(rayAt(pixel.tree(), 1), pixel.scene()), "ball");
  EXPECT_EQ(shortEnd(rayAt(pixel.tree(), 1)).find("filtered to "), 0u);
  const Settings black{.width = 40, .glassShadows = GlassShadows::black};
  const PixelWhy why = traced(litFloor(std::string(kSun), glass), black, 20, 20).why;
  EXPECT_EQ(why.sentence,
            "Black: ball blocks directional_light from floor: it is clear, but glass-shadows is black.");
  ASSERT_EQ(why.cures.size(), 2u);
  EXPECT_EQ(why.cures[1].label, "glass-shadows filtered");
}

TEST(PixelWhy, AllBlockedLightsAreNamed) {
  const std::string clay = "diffuse = (0.8, 0.7, 0.6);";
  const std::string slanted =
      "directional_light { name = \"moon\"; direction = (0.02, -1, 0); color = (0.2, 0.2, 0.4); }\n";
  EXPECT_EQ(traced(litFloor(std::string(kSun) + slanted, clay), {.width = 40}, 20, 20).why.sentence,
            "Black: ball blocks directional_light and moon from floor.");
  const TracedPixel three =
      traced(litFloor(std::string(kSun) + std::string(kSun) + slanted, clay), {.width = 40}, 20, 20);
  EXPECT_EQ(three.why.sentence, "Black: ball blocks all three lights from floor.");
  // Lights without a name are numbered.
  EXPECT_EQ(shortLightName(three.scene(), 1), "directional_light 2");
  EXPECT_EQ(stepOf(three.tree(), three.scene(), 1), "shadow ray: ball blocks directional_light 1 from floor");
  EXPECT_EQ(stepOf(three.tree(), three.scene(), 0),
            "camera ray: hits floor, which neither mirrors nor transmits");
}

TEST(PixelWhy, WithoutALightNothingReachesIt) {
  EXPECT_EQ(whyOf(ballOf(grey()), {}).sentence, "Black: no light reaches ball.");
}

TEST(PixelWhy, ABackgroundIsNamed) {
  const PixelWhy why = whyOf(ballOf(grey()), {}, 0, 0);
  EXPECT_EQ(why.sentence.find("Black: left the scene"), 0u) << why.sentence;
  EXPECT_TRUE(why.cures.empty());
}

TEST(PixelWhy, TheSummandsAddUpToTheRadiance) {
  Phong material = grey();
  material.ambient = Color(0.3), material.reflective = Color(0.2);
  Scene scene = ballOf(material);
  scene.lights.push_back({AmbientLight{.color = Color(0.5)}, {}});
  scene.lights.push_back({DirectionalLight{.direction = {0, 0, -1}, .color = Color(1)}, {}});
  scene.lights.back().links.name = "sun";
  Settings settings{.width = 40, .height = 40, .depth = 3};
  Session session;
  session.open(scene, settings);
  session.build();
  const Explanation explanation = session.explain(20, 20, 0);
  const PixelWhy why = trace::whyOf(explanation.tree, session.scene(), session.settings());
  Color sum;
  for (const WhySummand& each : why.sum) sum = sum + each.color;
  const Color whole = explanation.tree.nodes.front().radiance;
  EXPECT_NEAR(sum.r, whole.r, 1e-12);
  // Ray by ray the sum grows to the whole.
  Real before = 0;
  for (int rays = 0; rays <= static_cast<int>(explanation.tree.nodes.size()); ++rays) {
    const Real after = sumAfter(why.sum, rays).r;
    EXPECT_GE(after, before) << rays;
    before = after;
  }
  EXPECT_EQ(sumAfter(why.sum, 0), Color(0));
  EXPECT_NEAR(before, whole.r, 1e-12);
  EXPECT_EQ(why.sentence, "ball shows mostly the light of sun.");
  const bool named = std::any_of(why.sum.begin(), why.sum.end(),
                                 [](const WhySummand& each) { return each.name == "ambient"; });
  EXPECT_TRUE(named);
}

TEST(PixelWhy, EveryRayHasAnEquation) {
  Phong mirror = grey();
  mirror.reflective = Color(0.5);
  Scene scene = ballOf(mirror);
  scene.lights.push_back({AmbientLight{.color = Color(0.2)}, {}});
  Session session;
  session.open(scene, {.width = 40, .height = 40});
  session.build();
  const RayTree tree = session.explain(20, 20, 0).tree;
  const std::string camera = equationOf(tree, session.scene(), 0);
  EXPECT_NE(camera.find(" = "), std::string::npos) << camera;
  EXPECT_NE(camera.find("reflection "), std::string::npos) << camera;
  for (int ray = 0; ray < static_cast<int>(tree.nodes.size()); ++ray) {
    Color sum;
    for (const WhySummand& each : sumOf(tree, session.scene(), ray)) sum = sum + each.color;
    if (rayAt(tree, ray).kind != RayKind::shadow) {
      EXPECT_NEAR(sum.r, rayAt(tree, ray).radiance.r, 1e-12);
    }
  }
}

TEST(PixelWhy, EmissiveObjectsLightNothingForWhitted) {
  const std::string room = R"(
camera { position = (0, 1, 6); viewdir = (0, -0.1, -1); updir = (0, 1, 0); fov = 40; aspectratio = 1; }
translate(0, -1, 0, rotate(1, 0, 0, -1.5708, scale(30, 30, 1, square { name = "floor";
  material = { diffuse = (0.8, 0.8, 0.8) } })))
translate(0, 4, 0, sphere { name = "bulb"; material = { emissive = (20, 20, 20) } })
)";
  Settings settings;
  settings.width = settings.height = 40;
  settings.integrator = IntegratorKind::whitted;
  settings.lampSamples = 0;
  const PixelWhy why = traced(room, settings, 20, 35).why;
  EXPECT_EQ(why.sentence,
            "Black: only emissive objects light the scene, and for integrator whitted they light nothing.");
  ASSERT_EQ(why.cures.size(), 2u);
  EXPECT_EQ(why.cures.back().label, "integrator path");
}

TEST(PixelWhy, TermsThatAreNothingAreNoPartOfTheSum) {
  Phong ball;
  ball.diffuse = Color(0.5), ball.emissive = Color(0.4);
  Scene scene = ballOf(ball);
  scene.lights.push_back({PointLight{.position = {0, 0, 6}, .color = Color(1e-9)}, {}});
  const PixelWhy why = whyOf(scene, {});
  ASSERT_EQ(why.sum.size(), 1u);
  EXPECT_EQ(why.sum.front().name, "emissive");
}

}  // namespace
}  // namespace trace::test
