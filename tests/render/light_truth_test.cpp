// Every integrator that follows light finds each light once: on planes without an end, behind glass and in
// mirrors, from narrow lamps, and what photons gather on maps.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "geometry/shapes/solids/cube.h"
#include "geometry/shapes/solids/plane.h"
#include "geometry/shapes/solids/sphere.h"
#include "geometry/shapes/solids/square.h"
#include "render/integrators/make_integrator.h"
#include "render/media/media.h"
#include "render/picture/explain.h"
#include "shading/lights/directional_light.h"
#include "shading/lights/point_light.h"
#include "shading/lights/projector_light.h"
#include "shading/lights/rectangle_light.h"
#include "shading/lights/warn_light.h"
#include "shading/materials/principled.h"
#include "shading/materials/thin_glass.h"
#include "support/lights.h"
#include "support/rooms.h"

namespace trace::test::light_truth_test {
namespace {

const Affine kUp = Affine::rotation({1, 0, 0}, -0.5 * kPi), kDown = Affine::rotation({1, 0, 0}, 0.5 * kPi);

Phong matt(Real albedo) {
  Phong phong;
  phong.diffuse = Color(albedo);
  return phong;
}
/// A sheet that bends nothing.
Phong pane() {
  Phong phong;
  phong.transmissive = Color(1), phong.index = 1;
  return phong;
}
Phong mirror() {
  Phong phong;
  phong.reflective = Color(1);
  return phong;
}

/// A matt floor, seen from aslant above.
Scene floorScene() {
  Scene scene;
  addObject(scene, Square{}, kUp * Affine::scaling({8, 8, 1}), matt(0.8));
  scene.camera.position = {0, 0.5, 3};
  scene.camera.viewdir = {0, -0.4, -3};
  scene.camera.fov = 30;
  return scene;
}
/// A panel over it that shines downward.
void addPanel(Scene& scene, Real height, bool visible) {
  RectangleLight panel;
  panel.position = {0, height, 0};
  panel.u = {1, 0, 0}, panel.v = {0, 0, 1};
  panel.color = Color(1.2);
  panel.visible = visible;
  scene.lights.push_back({panel, {}});
}

Settings settingsOf(IntegratorKind kind, int spp) {
  Settings settings;
  settings.integrator = kind;
  settings.sampling = SampleKind::sobol;
  settings.width = settings.height = 12;
  settings.depth = 4, settings.spp = spp;
  settings.airIndex = 1;
  settings.chainStarts = 50000;
  settings.photons = 200000;
  return settings;
}

Real meanOf(const Scene& scene, IntegratorKind kind, int spp = 64) {
  return mean(picture(scene, settingsOf(kind, spp)));
}
Real byChains(const Scene& scene, Chains chains, int spp = 256) {
  Settings settings = settingsOf(IntegratorKind::mlt, spp);
  settings.chains = chains;
  return mean(picture(scene, settings));
}

/// A plane without an end, and a small ball far behind the camera: all that is seen lies beside the ball.
Scene planeScene() {
  Scene scene;
  addObject(scene, Plane{}, kUp, matt(0.8));
  addObject(scene, Sphere{}, Affine::translation({0, 0.5, 40}) * Affine::scaling({0.5, 0.5, 0.5}), matt(0.5));
  scene.camera.position = {0, 3, 12};
  scene.camera.viewdir = {0, -3, -4};
  scene.camera.fov = 20;
  return scene;
}

TEST(LightTruth, ASunLightsAPlaneBesideAllElse) {
  Scene scene = planeScene();
  const Vec3 way = normalize(Vec3{0.2, -1, -0.1});
  scene.lights.push_back({DirectionalLight{.direction = way, .color = Color(0.5)}, {}});
  for (const IntegratorKind kind : {IntegratorKind::path, IntegratorKind::bdpt})
    EXPECT_NEAR(meanOf(scene, kind, 4), 0.8 * 0.5 * -way.y, 1e-3);
}

TEST(LightTruth, TheSkyLightsAPlaneBesideAllElse) {
  Scene scene = planeScene();
  scene.background.gradient = {{Color(0.5), Color(0.5)}};
  for (const IntegratorKind kind : {IntegratorKind::path, IntegratorKind::bdpt})
    EXPECT_NEAR(meanOf(scene, kind), 0.4, 2e-3);
}

TEST(LightTruth, APlaneFarAboveStopsTheSun) {
  Scene scene = floorScene();
  addObject(scene, Plane{}, Affine::translation({0, 60, 0}) * kDown, matt(0.8));
  scene.lights.push_back({DirectionalLight{.direction = {0.2, -1, -0.1}, .color = Color(0.5)}, {}});
  for (const IntegratorKind kind : {IntegratorKind::path, IntegratorKind::bdpt, IntegratorKind::photon})
    EXPECT_EQ(meanOf(scene, kind, 4), 0);
}

TEST(LightTruth, APlaneOfGlassFarAboveLetsTheSunThrough) {
  Scene scene = floorScene();
  addObject(scene, Plane{}, Affine::translation({0, 60, 0}) * kDown, pane());
  scene.lights.push_back({DirectionalLight{.direction = {0.2, -1, -0.1}, .color = Color(0.5)}, {}});
  const Real expected = meanOf(scene, IntegratorKind::path);
  ASSERT_GT(expected, 0.1);
  EXPECT_NEAR(meanOf(scene, IntegratorKind::bdpt, 1024) / expected, 1, 0.03);
}

TEST(LightTruth, AVisiblePanelBehindAPaneCountsOnce) {
  const auto scene = [](bool visible) {
    Scene s = floorScene();
    addPanel(s, 1.5, visible);
    addObject(s, Square{}, Affine::translation({0, 1, 0}) * kUp * Affine::scaling({3, 3, 1}), pane());
    return s;
  };
  const Scene hidden = scene(false), seen = scene(true);
  const Real expected = meanOf(hidden, IntegratorKind::path, 256);
  ASSERT_GT(expected, 0.01);
  EXPECT_NEAR(meanOf(seen, IntegratorKind::path, 256) / expected, 1, 1e-9);
  EXPECT_NEAR(meanOf(seen, IntegratorKind::photon, 256) / expected, 1, 0.03);
  EXPECT_NEAR(byChains(seen, Chains::path) / expected, 1, 0.03);
  EXPECT_NEAR(meanOf(seen, IntegratorKind::bdpt, 512) / expected, 1, 0.03);
}

/// What lets light through and does not turn it.
std::vector<std::pair<std::string, Material>> straightSheets() {
  const auto made = [](const auto& model) {
    Material material;
    material.model = model;
    return material;
  };
  Material half = made(matt(0)), hole = half;
  half.opacity = 0.4, hole.opacity = 0;
  ThinGlass tinted, bubble;
  tinted.color = {0.9, 0.6, 0.3}, bubble.film = 420;
  return {{"thin glass", made(ThinGlass{})},
          {"tinted thin glass", made(tinted)},
          {"a bubble", made(bubble)},
          {"an index of 1", made(pane())},
          {"half opaque", half},
          {"a hole", hole}};
}

/// A shiny floor, so many sheets of that material close above one another over it, and a light above these.
Scene belowSheets(const Material& material, const Light& light, int sheets) {
  Scene scene;
  Phong shiny = matt(0.6);
  shiny.specular = Color(0.2), shiny.shininess = 10;
  addObject(scene, Square{}, kUp * Affine::scaling({8, 8, 1}), shiny);
  scene.materials.push_back(material);
  for (int n = 0; n < sheets; ++n)
    scene.objects.push_back({"",
                             Square{},
                             Affine::translation({0, 1 - 0.1 * n, 0}) * kUp * Affine::scaling({9, 9, 1}),
                             static_cast<std::uint32_t>(scene.materials.size() - 1),
                             {}});
  scene.lights.push_back({light, {}});
  scene.camera.position = {0.3, 0.4, 0.9}, scene.camera.viewdir = {-0.2, -0.4, -0.7};
  scene.camera.fov = 30;
  return scene;
}

/// Means of the integrators are those of path to that part of it; of the chains of mlt, too, if asked. bdpt
/// takes so many more samples.
void expectAllShow(const Scene& scene, Settings settings, Real tolerance, bool chained, int more = 2) {
  constexpr int kSamples = 64;
  settings.photons = 20000, settings.photonPasses = 2;
  const auto meanBy = [&](IntegratorKind kind, Chains chains, int samples) {
    settings.integrator = kind, settings.chains = chains, settings.spp = samples;
    return mean(picture(scene, settings));
  };
  const Real expected = meanBy(IntegratorKind::path, Chains::path, more * kSamples);
  ASSERT_GT(expected, 1e-3);
  EXPECT_NEAR(meanBy(IntegratorKind::bdpt, Chains::path, more * kSamples) / expected, 1, tolerance);
  EXPECT_NEAR(meanBy(IntegratorKind::photon, Chains::path, kSamples) / expected, 1, 1.5 * tolerance);
  if (!chained) return;
  for (const Chains chains : {Chains::bdpt, Chains::path})
    EXPECT_NEAR(meanBy(IntegratorKind::mlt, chains, 4 * kSamples) / expected, 1, 2 * tolerance);
}

TEST(LightTruth, WhatTurnsNoLightLeavesEachLightItsLawOfDistance) {
  Settings settings = settingsOf(IntegratorKind::path, 64);
  settings.fresnel = Fresnel::exact;
  settings.depth = 12;
  for (const auto& [name, material] : straightSheets())
    for (const auto& [kind, light] : lightsOfEveryKind()) {
      SCOPED_TRACE(name + ", " + kind);
      // Shadow rays of bdpt do not pass what might bend light: its paths from lights do.
      const bool passes = name != "an index of 1";
      const bool near =
          std::string_view(kind) == "point" || std::string_view(kind) == "another law of distance";
      if (!passes && !near) continue;
      // Path finds no point in two mirrors.
      const bool mirrors = !passes || material.model.is<ThinGlass>();
      expectAllShow(belowSheets(material, light, mirrors ? 1 : 2), settings, passes ? 0.02 : 0.06,
                    passes && std::string_view(kind) == "point", passes ? 2 : 24);
    }
}

TEST(LightTruth, APaneTakesNoBounceOfTheLightThatCrossesIt) {
  Settings settings = settingsOf(IntegratorKind::path, 64);
  Material glass;
  glass.model = ThinGlass{};
  for (const int depth : {0, 1, 2}) {
    SCOPED_TRACE(depth);
    settings.depth = depth;
    const Light light = PointLight{.position = {0.5, 1.5, 0.8}, .color = Color(1)};
    Scene scene = belowSheets(glass, light, 1);
    expectAllShow(scene, settings, 0.02, depth > 0);
    // A pane that the light does not light lets it pass.
    scene.lights[0].links.name = "lamp", scene.objects[1].links.notLitBy = {"lamp"};
    expectAllShow(scene, settings, 0.02, depth > 0);
    // Pale shadows, and a highlight of its own.
    scene.materials[0].model.edit<Phong>()->shadow = 0.5;
    scene.lights[0].light.edit<PointLight>()->extraHighlight = Color(0.5);
    expectAllShow(scene, settings, 0.02, depth > 0);
  }
}

/// Each kind of emitter that paths hit: what they are named, and how it comes above belowSheets().
std::vector<std::pair<std::string, void (*)(Scene&)>> emitters() {
  static constexpr auto shining = [](Scene& scene, const Shape& shape, Real size) {
    addObject(scene, shape, Affine::translation({0.4, 1.8, 0.3}) * kUp * scaled(size), diffuse(0, 8));
  };
  return {{"a square", [](Scene& s) { shining(s, Square{}, 0.8); }},
          {"a sphere", [](Scene& s) { shining(s, Sphere{}, 0.4); }},
          {"a box", [](Scene& s) { shining(s, Cube{}, 0.5); }},
          {"the sky",
           [](Scene& s) {
             s.background.gradient = {{Color(0.1), Color(2)}};
           }},
          {"an even sky",
           [](Scene& s) {
             s.background.gradient = {{Color(1), Color(1)}};
           }},
          {"a sky and a square", [](Scene& s) {
             shining(s, Square{}, 0.8);
             s.background.gradient = {{Color(0.1), Color(1)}};
           }}};
}

/// belowSheets(), lit by that emitter alone.
Scene belowSheets(const Material& material, void (*addEmitter)(Scene&), int sheets) {
  Scene scene = belowSheets(material, PointLight{}, sheets);
  scene.lights.clear();
  addEmitter(scene);
  return scene;
}

TEST(LightTruth, EveryEmitterShinesThroughPanes) {
  Settings settings = settingsOf(IntegratorKind::path, 64);
  settings.depth = 12;
  for (const auto& [name, material] : straightSheets())
    for (const auto& [kind, add] : emitters()) {
      if (name == "an index of 1") continue;  // photons bring that light, and blur it
      SCOPED_TRACE(name + ", " + kind);
      expectAllShow(belowSheets(material, add, 1), settings, 0.04, kind == "a square", 8);
    }
}

TEST(LightTruth, PathsThroughPanesSumUp) {
  Settings settings = settingsOf(IntegratorKind::path, 4);
  settings.photons = 2000, settings.threads = 1;
  const auto sheets = straightSheets();
  for (const IntegratorKind by : {IntegratorKind::direct, IntegratorKind::path, IntegratorKind::photon,
                                  IntegratorKind::bdpt, IntegratorKind::whitted})
    for (const auto& [kind, add] : emitters()) {
      SCOPED_TRACE(kind);
      settings.integrator = by;
      const Scene scene = belowSheets(sheets[1].second, add, 2);
      const World world = build(scene, settings);
      Job job;
      const auto integrator = makeIntegrator(world, settings, job);
      for (int n = 0; n < 24; ++n)
        EXPECT_TRUE(sumsUp(explain(world, *integrator, settings, {12, 12}, n % 12, 3 + n / 12, n % 4).tree));
    }
}

TEST(LightTruth, HowOftenPathsBounceTakesNoEmitterFromBehindPanes) {
  Settings settings = settingsOf(IntegratorKind::path, 1024);
  Material glass;
  glass.model = ThinGlass{};
  for (const auto& [kind, add] : emitters()) {
    SCOPED_TRACE(kind);
    settings.integrator = IntegratorKind::direct;
    const Scene scene = belowSheets(glass, add, 2);
    const Real direct = mean(picture(scene, settings));
    settings.integrator = IntegratorKind::path;
    for (const int depth : {0, 1, 2}) {
      SCOPED_TRACE(depth);
      settings.depth = depth;
      // What the panes mirror back to the floor is 12 % of the light at most.
      const Real ratio = mean(picture(scene, settings)) / direct;
      EXPECT_GT(ratio, 0.99);
      EXPECT_LT(ratio, depth == 0 ? 1.01 : 1.13);
    }
  }
}

TEST(LightTruth, EmittersShineThroughPanesOnWhatFloatsInTheAir) {
  Settings settings = settingsOf(IntegratorKind::path, 512);
  settings.fog = 0.4, settings.mediumDepth = 8, settings.depth = 12;
  Material glass;
  glass.model = ThinGlass{};
  for (const auto& [kind, add] : emitters())
    if (!kind.ends_with("sky")) {  // fog hides it
      SCOPED_TRACE(kind);
      expectAllShow(belowSheets(glass, add, 1), settings, 0.04, false, 8);
    }
}

TEST(LightTruth, WhatCastsNoShadowMayBeAPane) {
  Settings settings = settingsOf(IntegratorKind::path, 256);
  settings.depth = 12;
  ThinGlass tinted;
  tinted.color = {0.5, 0.5, 0.5};
  Material glass;
  glass.model = tinted;
  for (const auto& [kind, add] : emitters()) {
    SCOPED_TRACE(kind);
    if (kind != "a square") continue;  // what it does not shade, light passes whole
    Material air = glass;
    air.castsShadow = false;
    Material none;
    none.opacity = 0;
    settings.integrator = IntegratorKind::direct;
    EXPECT_NEAR(mean(picture(belowSheets(air, add, 1), settings)) /
                    mean(picture(belowSheets(none, add, 1), settings)),
                1, 0.01);
    settings.integrator = IntegratorKind::path;
    settings.depth = 1;
    EXPECT_NEAR(mean(picture(belowSheets(air, add, 1), settings)) /
                    mean(picture(belowSheets(none, add, 1), settings)),
                1, 0.06);
  }
}

TEST(LightTruth, APaneTakesNoSunlightFromFogBehindIt) {
  Settings settings = settingsOf(IntegratorKind::path, 64);
  settings.fog = 0.4, settings.mediumDepth = 8;
  Material glass;
  glass.model = ThinGlass{};
  for (const auto& [kind, light] : lightsOfEveryKind()) {
    SCOPED_TRACE(kind);
    if (std::string_view(kind) == "far point") continue;  // hardly any of its light gets there straight
    const Scene scene = belowSheets(glass, light, 1);
    const auto meanBy = [&](IntegratorKind by) {
      settings.integrator = by, settings.spp = 256;
      return mean(picture(scene, settings));
    };
    EXPECT_NEAR(meanBy(IntegratorKind::bdpt) / meanBy(IntegratorKind::path), 1, 0.04);
  }
}

TEST(LightTruth, APaneThatBendsNothingPassesLightWhereGlassHasBlackShadows) {
  Principled sheet;
  sheet.transmission = 1;
  for (const MaterialModel& model : {MaterialModel(ThinGlass{}), MaterialModel(sheet)})
    for (const auto& [kind, light] : lightsOfEveryKind())
      for (const IntegratorKind by : {IntegratorKind::whitted, IntegratorKind::path, IntegratorKind::bdpt}) {
        SCOPED_TRACE(kind);
        Material pane;
        pane.model = model;
        const Scene scene = belowSheets(pane, light, 1);
        Settings settings = settingsOf(by, 4);
        const Picture filtered = picture(scene, settings);
        settings.glassShadows = GlassShadows::black;
        EXPECT_EQ(picture(scene, settings), filtered);
        EXPECT_GT(mean(filtered), 0);
      }
}

TEST(LightTruth, AMattPaneSpreadsNoLightToItsOtherSide) {
  Scene scene = floorScene();
  addPanel(scene, 1.5, false);
  Phong matt = pane();
  matt.diffuse = Color(0.6);
  addObject(scene, Square{}, Affine::translation({0, 1, 0}) * kUp * Affine::scaling({3, 3, 1}), matt);
  Settings path = settingsOf(IntegratorKind::path, 256), bdpt = settingsOf(IntegratorKind::bdpt, 512);
  path.depth = bdpt.depth = 12;  // to bdpt the pane is one more surface on the way of the light
  EXPECT_NEAR(mean(picture(scene, bdpt)) / mean(picture(scene, path)), 1, 0.03);
}

TEST(LightTruth, WithBlackShadowsOfGlassAVisiblePanelIsSeenThroughIt) {
  Scene scene = floorScene();
  addPanel(scene, 1.5, true);
  const Real open = meanOf(scene, IntegratorKind::path, 256);
  addObject(scene, Square{}, Affine::translation({0, 1, 0}) * kUp * Affine::scaling({3, 3, 1}), pane());
  Settings settings = settingsOf(IntegratorKind::path, 2048);
  settings.glassShadows = GlassShadows::black;
  EXPECT_NEAR(mean(picture(scene, settings)) / open, 1, 0.03);
}

/// A floor, a panel at that height that shines upward and is seen, and a mirror above it.
Scene panelBelowMirror(Real height) {
  Scene scene = floorScene();
  RectangleLight panel;
  panel.position = {0, height, 0};
  panel.u = {1, 0, 0}, panel.v = {0, 0, -1};  // upward
  panel.color = Color(1.2);
  panel.visible = true;
  scene.lights.push_back({panel, {}});
  addObject(scene, Square{}, Affine::translation({0, 2, 0}) * kDown * Affine::scaling({3, 3, 1}), mirror());
  return scene;
}

TEST(LightTruth, AVisiblePanelInAMirrorCountsOnce) {
  Scene scene = panelBelowMirror(1);
  const Real expected = meanOf(scene, IntegratorKind::path, 4096);
  ASSERT_GT(expected, 0.01);
  // Light that comes back by the mirror passes the panel, behind which a mirrored ray sees nothing: 2 % more.
  const Real bothEnds = meanOf(scene, IntegratorKind::bdpt, 512);
  EXPECT_NEAR(bothEnds / expected, 1, 0.03);
  EXPECT_NEAR(byChains(scene, Chains::bdpt, 1024) / bothEnds, 1, 0.05);
  // Where no path from a light lands, the panel is met.
  Settings bent = settingsOf(IntegratorKind::bdpt, 4096);
  bent.distortion = 1e-9;
  EXPECT_NEAR(mean(picture(scene, bent)) / expected, 1, 0.03);
}

TEST(LightTruth, AVisiblePanelInAMirrorIsFoundByAMirror) {
  // The floor is seen in the mirror that shows it the panel: no path from the panel can be joined with that.
  Scene scene = panelBelowMirror(0.9);
  scene.camera.position = {0, 0.5, 3.8};
  scene.camera.viewdir = {0, 1.6, -3};
  scene.camera.fov = 10;
  const Real expected = meanOf(scene, IntegratorKind::path, 1024);
  ASSERT_GT(expected, 0.01);
  EXPECT_NEAR(meanOf(scene, IntegratorKind::bdpt, 1024) / expected, 1, 0.01);
}

TEST(LightTruth, NarrowLampsShineThroughGlass) {
  const auto behindPane = [](const Light& light) {
    Scene scene;
    addObject(scene, Square{}, kUp * Affine::scaling({20, 20, 1}), matt(0.8));
    addObject(scene, Square{}, Affine::translation({0, 2, 0}) * kUp * Affine::scaling({3, 3, 1}), pane());
    scene.lights.push_back({light, {}});
    scene.camera.position = {0, 1.2, 3};
    scene.camera.viewdir = {0, -1.1, -3};
    scene.camera.fov = 30;
    return scene;
  };
  ProjectorLight projector;
  projector.position = {0, 3, 0}, projector.direction = {0, -1, 0}, projector.up = {0, 0, -1};
  projector.fov = 8;
  projector.constant = 0, projector.quadratic = 1;
  projector.color = Color(4);
  WarnLight warn;
  warn.position = {0, 3, 0}, warn.direction = {0, -1, 0};
  warn.exponent = 2000, warn.angle = 6;
  warn.constant = 0, warn.quadratic = 1;
  warn.color = Color(4);
  PointLight point;  // with a highlight of its own, that a matt floor does not show
  point.position = {0, 3, 0};
  point.color = Color(1), point.extraHighlight = Color(0.1);
  for (const Light& light : {Light(projector), Light(warn), Light(point)}) {
    const Scene scene = behindPane(light);
    const Real expected = meanOf(scene, IntegratorKind::path, 256);
    ASSERT_GT(expected, 1e-4) << light.keyword();
    EXPECT_NEAR(meanOf(scene, IntegratorKind::bdpt, 1024) / expected, 1, 0.03) << light.keyword();
  }
}

TEST(LightTruth, AnExtraHighlightIsAddedOnce) {
  Scene scene;
  Phong shiny;
  shiny.diffuse = Color(0.4), shiny.specular = Color(0.4), shiny.shininess = 20;
  addObject(scene, Square{}, kUp * Affine::scaling({8, 8, 1}), shiny);
  PointLight point;
  point.position = {0, 0.7, -2};
  point.color = Color(0.5), point.extraHighlight = Color(0.5);
  scene.lights.push_back({point, {}});
  scene.camera.position = {0, 0.5, 3};
  scene.camera.viewdir = {0, -0.4, -3};
  scene.camera.fov = 30;
  const Real expected = meanOf(scene, IntegratorKind::path);
  EXPECT_NEAR(meanOf(scene, IntegratorKind::bdpt, 256) / expected, 1, 0.02);
}

TEST(LightTruth, WhatLiesCloseToALampTakesNoLight) {
  Scene scene;
  addObject(scene, Square{}, kUp * Affine::scaling({8, 8, 1}), matt(0.8));
  Phong lamp;
  lamp.emissive = Color(1);
  addObject(scene, Square{}, Affine::translation({0, 2, 0}) * kDown * Affine::scaling({12, 12, 1}), lamp);
  // A pane nearer to the lamp than 1e-4 of its size.
  addObject(scene, Square{}, Affine::translation({0, 1.9995, 0}) * kUp * Affine::scaling({13, 13, 1}),
            pane());
  scene.camera.position = {0, 0.5, 3};
  scene.camera.viewdir = {0, -0.4, -3};
  scene.camera.fov = 30;
  const Real expected = meanOf(scene, IntegratorKind::path, 512);
  EXPECT_NEAR(meanOf(scene, IntegratorKind::bdpt, 512) / expected, 1, 0.02);
}

TEST(LightTruth, CausticTexelsTakeNothingFromPhotons) {
  Scene scene = floorScene();
  addPanel(scene, 2, false);
  Phong glass;
  glass.transmissive = glass.reflective = Color(1), glass.index = 1.5;
  addObject(scene, Sphere{}, Affine::translation({0, 0.6, 0}) * Affine::scaling({0.5, 0.5, 0.5}), glass);
  Settings settings = settingsOf(IntegratorKind::photon, 16);
  const Picture without = picture(scene, settings);
  settings.causticTexels = 100;
  EXPECT_EQ(picture(scene, settings).pixels, without.pixels);
}

/// A body of a medium without a surface, a cube of that size.
void addCloud(Scene& scene, const Vec3& place, Real size, Real density) {
  Material cloud;
  cloud.opacity = 0;
  cloud.mediumDensity = density;
  scene.materials.push_back(cloud);
  const auto material = static_cast<std::uint32_t>(scene.materials.size() - 1);
  scene.objects.push_back(
      {"", Cube{}, Affine::translation(place) * Affine::scaling({size, size, size}), material, {}});
}

TEST(LightTruth, ARayAlongAFaceOfACloudIsDimmedAlikeOnAllOfThem) {
  Scene scene;
  addCloud(scene, {}, 1, 2);
  const Settings settings;
  const World world = build(scene, settings);
  Tracer tracer(world, settings);
  const SampleRules rules(settings, {1, 1});
  const auto passes = [&](const Vec3& origin) {
    return passedByBodies(tracer, {origin, {0, 0, -1}}, 10, Sampler(rules, 0, 0, 0)).g;
  };
  EXPECT_NEAR(passes({0, 0, 5}), std::exp(-2), 1e-12);
  EXPECT_EQ(passes({0.5, 0, 5}), passes({-0.5, 0, 5}));
  EXPECT_EQ(passes({0, 0.5, 5}), passes({0, -0.5, 5}));
  EXPECT_EQ(passes({0.6, 0, 5}), 1);
}

TEST(LightTruth, WhittedsLampsLightFogWhateverElseIsThere) {
  Scene scene;
  addObject(scene, Square{}, kUp * Affine::scaling({4, 4, 1}), matt(0.2));
  Phong lamp;
  lamp.emissive = Color(4);
  addObject(scene, Square{}, Affine::translation({0, 1.5, 0}) * kDown, lamp);
  scene.camera.position = {0, 0.7, 4};
  scene.camera.viewdir = {0, 0, -1};
  scene.camera.fov = 40;
  Settings settings = settingsOf(IntegratorKind::whitted, 64);
  settings.lampSamples = 4;
  settings.fog = 0.2;
  // As a file shows it: air close to the lamp is as bright as can be by chance.
  const auto shown = [&] {
    Picture p = picture(scene, settings);
    for (Color& c : p.pixels) c.g = min(c.g, 1);
    return mean(p);
  };
  const Real alone = shown();
  settings.lampSamples = 0;
  EXPECT_LT(shown(), 0.95 * alone);
  settings.lampSamples = 4;
  addCloud(scene, {0, 0, 40}, 0.1, 1);  // behind the camera
  EXPECT_NEAR(shown() / alone, 1, 0.02);
}

TEST(LightTruth, PathsAreScatteredInACloudTenThousandTimesWithoutAStackForThat) {
  Scene scene;
  addCloud(scene, {}, 1.5, 20000);
  scene.lights.push_back({DirectionalLight{.direction = {0, 0, -1}, .color = Color(1)}, {}});
  scene.camera.position = {0, 0, 3};
  scene.camera.fov = 20;
  Settings settings = settingsOf(IntegratorKind::path, 16);
  settings.width = settings.height = 4;
  settings.mediumDepth = 10000;
  const Real light = mean(picture(scene, settings));
  EXPECT_GT(light, 0.1);
  EXPECT_LT(light, 10);
}

/// Each sample of the left half of the picture throws what is no number.
struct BadThrower : Integrator {
  void prepare(const World&, const Settings&, Job&) override {}
  Color radiance(Tracer&, Sampler, const CameraRay& camera) const override {
    const bool left = camera.ray.direction.x < 0;
    camera.thrown->push_back({{0.5, 0.5}, Color(left ? std::nan("") : 1.0)});
    return Color(1);
  }
};

TEST(LightTruth, ASampleThatThrowsNoNumberIsDroppedCountedAndFound) {
  Scene scene;
  addObject(scene, Sphere{}, Affine::translation({0, 0, -5}), matt(0.5));
  const Settings settings = settingsOf(IntegratorKind::bdpt, 4);
  const World world = build(scene, settings);
  const BadThrower integrator;
  Film film = makeFilm(settings, 12, 12);
  Job job;
  const RenderResult result = render(std::array{Moment{&world, &integrator}}, settings, film, job);
  EXPECT_EQ(result.statistics.badSamples, 4u * 12 * 6);
  ASSERT_FALSE(result.badSamples.empty());
  EXPECT_EQ(result.badSamples[0], (BadSample{0, 0, 0}));
  EXPECT_TRUE(isFinite(film.picture().at(5, 6)));
}

TEST(LightTruth, LightThrownFarBesideThePictureFallsNowhere) {
  const SampleRules rules({}, {10, 5});
  const auto pixels = [&](const Vec2& place) {
    int count = 0;
    rules.spread(place, [&](int, int, Real) { ++count; });
    return count;
  };
  EXPECT_GT(pixels({0.5, 0.5}), 0);
  EXPECT_GT(pixels({0, 1}), 0);
  for (const Real far : {-1e300, -1e16, -1.0, 2.0, 1e16, 1e300, std::nan("")}) {
    EXPECT_EQ(pixels({far, 0.5}), 0) << far;
    EXPECT_EQ(pixels({0.5, far}), 0) << far;
  }
}

}  // namespace
}  // namespace trace::test::light_truth_test
