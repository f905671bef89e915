// What rays see that meet nothing: which source, where in it, and that mirrors and glass see what the eye
// sees.
#include "render/world/outside.h"

#include <gtest/gtest.h>

#include "geometry/shapes/solids/cube.h"
#include "geometry/shapes/solids/sphere.h"
#include "render/picture/explain.h"
#include "support/scenes.h"

namespace trace::test::outside_test {
namespace {

/// Each direction has a colour of its own.
std::shared_ptr<const EnvironmentMap> rainbow() {
  Picture picture(64, 32);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 64; ++x)
      picture.at(x, y) = {0.5 + 0.5 * std::sin(x * kPi / 32), (y + 0.5) / 32,
                          0.5 + 0.5 * std::cos(x * kPi / 32)};
  return std::make_shared<const EnvironmentMap>(std::move(picture), EnvironmentKind::latLong);
}

Scene around(std::shared_ptr<const EnvironmentMap> environment) {
  Scene scene;
  scene.surroundings.environment = std::move(environment);
  return scene;
}

const Phong& mirror() {
  static const Phong kMirror = [] {
    Phong phong;
    phong.reflective = Color(1), phong.mirrorsSpecular = false;
    return phong;
  }();
  return kMirror;
}

Color seen(const Scene& scene, const Settings& settings, const Ray& ray, RayKind kind = RayKind::camera) {
  return build(scene, settings).outside().view(ray, kind).color;
}

TEST(Outside, IsBlackAsBeforeForMirroredRaysWhereNothingIsAround) {
  Scene scene;
  scene.background.colors = {Color(1), Color(0.5)};
  const World world = build(scene);
  EXPECT_TRUE(world.outside().isSeenBy(RayKind::camera));
  EXPECT_FALSE(world.outside().isSeenBy(RayKind::reflection));
  EXPECT_FALSE(world.outside().isSeenBy(RayKind::refraction));
}

TEST(Outside, CameraRaysSeeTheBackdropOtherRaysTheEnvironment) {
  Scene scene = around(rainbow());
  auto backdrop = std::make_shared<Picture>(1, 1);
  backdrop->at(0, 0) = Color(7);
  scene.surroundings.backdrop = backdrop;
  scene.background.gradient = {Color(2)};
  const Outside all = build(scene).outside();
  EXPECT_EQ(all.view({{}, {0, 0, -1}}, RayKind::camera).source, Outside::Source::backdrop);
  EXPECT_EQ(all.view({{}, {0, 0, -1}}, RayKind::reflection).source, Outside::Source::environment);
  scene.surroundings = {};
  EXPECT_EQ(build(scene).outside().view({{}, {0, 0, -1}}, RayKind::refraction).source,
            Outside::Source::gradient);
  scene.background.turbidity = 3;
  EXPECT_EQ(build(scene).outside().view({{}, {0, 0, -1}}, RayKind::camera).source, Outside::Source::sky);
}

/// A backdrop of the size of the picture is seen pixel for pixel, whatever the camera.
TEST(Outside, ABackdropIsStretchedOverThePicture) {
  Picture shown(12, 8);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 12; ++x) shown.at(x, y) = {x / 12.0, y / 8.0, 0.25};
  Scene scene;
  scene.surroundings.backdrop = std::make_shared<const Picture>(shown);
  scene.camera = {.position = {3, 2, 1}, .viewdir = {1, -0.4, 0.3}, .fov = 70, .aspectratio = 1.5};
  for (const CameraAxes axes : {CameraAxes::orthonormal, CameraAxes::raw, CameraAxes::skewed}) {
    const Settings settings{.width = 12, .cameraAxes = axes, .pixelPosition = PixelPosition::center};
    const Picture rendered = picture(scene, settings);
    for (std::size_t i = 0; i < shown.pixels.size(); ++i) {
      EXPECT_NEAR(rendered.pixels[i].r, shown.pixels[i].r, 1e-12);
      EXPECT_NEAR(rendered.pixels[i].g, shown.pixels[i].g, 1e-12);
    }
  }
  // A larger picture has it enlarged: its corners are the outermost pixels.
  const Settings large{.width = 120, .pixelPosition = PixelPosition::center};
  const Picture rendered = picture(scene, large);
  EXPECT_NEAR(rendered.at(0, 0).r, shown.at(0, 0).r, 1e-12);
  EXPECT_NEAR(rendered.at(119, 79).g, shown.at(11, 7).g, 1e-12);
}

/// What a mirrored ray brings back is what a camera ray of its direction sees.
TEST(Outside, AMirrorShowsWhatTheEyeSeesThere) {
  Scene scene = around(rainbow());
  addObject(scene, Sphere{}, Affine::translation(Vec3{0, 0, -5}), mirror());
  const Settings settings{.width = 32};
  const World world = build(scene, settings);
  const auto integrator = integratorOf(world, settings);
  int mirrored = 0;
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x) {
      const Explanation e = explain(world, *integrator, settings, {32, 32}, x, y, 0);
      ASSERT_TRUE(sumsUp(e.tree));
      const RayNode& last = e.tree.nodes.back();
      ASSERT_TRUE(last.outside.has_value());
      EXPECT_EQ(last.radiance, seen(scene, settings, last.ray));
      EXPECT_EQ(last.outside->color, last.radiance);
      EXPECT_EQ(e.pixel, last.radiance);
      mirrored += last.kind == RayKind::reflection;
    }
  EXPECT_GT(mirrored, 50);
}

/// Glass of the index of the air bends nothing.
TEST(Outside, ThinAirShowsWhatIsBehindIt) {
  Scene scene = around(rainbow());
  Phong air;
  air.transmissive = Color(1), air.index = 1, air.mirrorsSpecular = false;
  addObject(scene, Cube{}, Affine::translation(Vec3{0, 0, -3}), air);
  const Settings settings{.width = 16, .airIndex = 1};
  const Picture through = picture(scene, settings);
  scene.objects.clear();
  const Picture direct = picture(scene, settings);
  for (std::size_t i = 0; i < direct.pixels.size(); ++i) {
    EXPECT_NEAR(through.pixels[i].r, direct.pixels[i].r, 1e-12);
    EXPECT_NEAR(through.pixels[i].g, direct.pixels[i].g, 1e-12);
    EXPECT_NEAR(through.pixels[i].b, direct.pixels[i].b, 1e-12);
  }
}

TEST(Outside, RotationTurnsToTheLeftAndBrightnessScales) {
  const Scene scene = around(rainbow());
  const auto look = [&](const Vec3& d, Real rotation, Real brightness = 1) {
    return seen(scene, {.environmentRotation = rotation, .environmentBrightness = brightness}, {{}, d});
  };
  const Vec3 ahead{0, 0, -1}, left{-1, 0, 0};
  const Color was = look(ahead, 0), is = look(left, 90);
  EXPECT_NEAR(is.r, was.r, 1e-12);
  EXPECT_NEAR(is.g, was.g, 1e-12);
  EXPECT_NEAR(is.b, was.b, 1e-12);
  EXPECT_NE(look(left, 0), was);
  EXPECT_EQ(look(ahead, 0, 2.5), was * 2.5);
  EXPECT_EQ(look(ahead, 0, 0), Color(0));
}

TEST(Outside, GradientsAndSkiesFollowTheHeight) {
  Scene scene;
  scene.background.gradient = {Color(1, 0, 0), Color(0, 0, 1)};
  EXPECT_EQ(seen(scene, {}, {{}, {0, 1, 0}}), Color(0, 0, 1));
  EXPECT_EQ(seen(scene, {}, {{}, {0, 0, -1}}, RayKind::reflection), Color(0.5, 0, 0.5));
  EXPECT_EQ(seen(scene, {}, {{}, {0, -1, 0}}, RayKind::refraction), Color(1, 0, 0));
  scene.background.turbidity = 2, scene.background.sun = {0, 1, 0};
  const Color zenith = seen(scene, {}, {{}, {0, 1, 0}});
  EXPECT_NEAR(0.2126 * zenith.r + 0.7152 * zenith.g + 0.0722 * zenith.b,
              Daylight(2, {0, 1, 0}).zenith().Y * scene.background.skyBrightness, 1e-3);
  EXPECT_EQ(seen(scene, {}, {{}, {0, -1, 0}}), scene.background.ground);
  // Elevations that do not fit the colours, as while somebody edits them, are not used.
  scene.background.turbidity = 0, scene.background.elevations = {10};
  EXPECT_EQ(seen(scene, {}, {{}, {0, 1, 0}}), Color(0, 0, 1));
}

TEST(Outside, SentencesNameThePlace) {
  EXPECT_EQ(sentence(build(around(rainbow())).outside().view({{}, {1, 0, 0}}, RayKind::reflection)),
            "environment at (0.75, 0.5) from its top left");
  std::array<Picture, 6> faces;
  for (Picture& face : faces) face = Picture(2, 2);
  const Scene cube = around(std::make_shared<const EnvironmentMap>(faces));
  EXPECT_EQ(sentence(build(cube).outside().view({{}, {1, 0, 0}}, RayKind::camera)),
            "environment, face right at (0.5, 0.5) from its top left");
  Scene sky;
  sky.background.gradient = {Color(1), Color(0)};
  EXPECT_EQ(sentence(build(sky).outside().view({{}, {0, 0.5, std::sqrt(0.75)}}, RayKind::camera)),
            "gradient at 30 degrees above the horizon");
  EXPECT_EQ(sentence(build(Scene{}).outside().view({{}, {1, 0, 0}}, RayKind::camera)), "background");
}

// --- the panorama -------------------------------------------------------------------------------------

/// Each quarter of each face has a colour of its own, of whole bytes.
Color quarterColor(int face, int column, int row) {
  return {face * 40 / 255.0, column * 200 / 255.0, row * 200 / 255.0};
}

std::shared_ptr<const MipMap> quarters(int face, std::uint8_t alpha) {
  Raster raster(2, 2, 4, 255);
  std::vector<std::uint8_t> samples;
  for (int row = 0; row < 2; ++row)
    for (int column = 0; column < 2; ++column)
      for (const int sample : {face * 40, column * 200, row * 200, static_cast<int>(alpha)})
        samples.push_back(static_cast<std::uint8_t>(sample));
  raster.samples = std::move(samples);
  return std::make_shared<const MipMap>(std::move(raster));
}

/// How VRML97 (ISO/IEC 14772-1, 6.5) has who looks at a face stand.
struct Face {
  Pixels Background::*picture;
  Vec3 look, up;
};
const Face kFaces[] = {
    {&Background::front, {0, 0, -1}, {0, 1, 0}}, {&Background::back, {0, 0, 1}, {0, 1, 0}},
    {&Background::left, {-1, 0, 0}, {0, 1, 0}},  {&Background::right, {1, 0, 0}, {0, 1, 0}},
    {&Background::top, {0, 1, 0}, {0, 0, 1}},    {&Background::bottom, {0, -1, 0}, {0, 0, -1}},
};

Scene panorama(std::uint8_t alpha = 255) {
  Scene scene;
  for (int i = 0; i < 6; ++i) (scene.background.*kFaces[i].picture).map = quarters(i, alpha);
  return scene;
}

/// Through the middle of a quarter of the face.
Ray through(const Face& face, int column, int row) {
  const Vec3 right = cross(face.look, face.up);
  return {{}, normalize(face.look + right * (column - 0.5) + face.up * (0.5 - row))};
}

void expectNear(const Color& is, const Color& wanted, const std::string& what = {}) {
  EXPECT_NEAR(is.r, wanted.r, 1e-9) << what;
  EXPECT_NEAR(is.g, wanted.g, 1e-9) << what;
  EXPECT_NEAR(is.b, wanted.b, 1e-9) << what;
}

TEST(Panorama, PicturesStandAsTheSpecificationOfVrmlHasThem) {
  const World world = build(panorama());
  for (int i = 0; i < 6; ++i)
    for (int column = 0; column < 2; ++column)
      for (int row = 0; row < 2; ++row)
        for (const RayKind kind : {RayKind::camera, RayKind::reflection}) {
          const auto view = world.outside().view(through(kFaces[i], column, row), kind);
          expectNear(view.color, quarterColor(i, column, row),
                     std::to_string(i) + " " + std::to_string(column) + " " + std::to_string(row));
          EXPECT_EQ(view.source, Outside::Source::panorama);
          expectNear({view.place.x, view.place.y, 0}, {0.25 + 0.5 * column, 0.25 + 0.5 * row, 0});
        }
  EXPECT_EQ(sentence(world.outside().view({{}, {0, 0, -1}}, RayKind::camera)),
            "panorama, face front at (0.5, 0.5) from its top left");
}

/// The colours behind, where there is no picture and as far as one is transparent.
TEST(Panorama, WhatLiesBehindIsSeenThroughIt) {
  const Color sky(0.5, 0.25, 1);
  Scene scene = panorama(51);
  scene.background.gradient = {sky};
  scene.background.top = {};
  Settings settings;
  settings.environmentBrightness = 2;
  const World world = build(scene, settings);
  for (const RayKind kind : {RayKind::camera, RayKind::reflection}) {
    const auto at = [&](int face) { return world.outside().view(through(kFaces[face], 1, 0), kind); };
    expectNear(at(0).color, (quarterColor(0, 1, 0) * 0.2 + sky * 0.8) * 2);
    EXPECT_EQ(at(0).source, Outside::Source::panorama);
    expectNear(at(4).color, sky * 2);
    EXPECT_EQ(at(4).source, Outside::Source::gradient);
  }
  scene.background.gradient.clear();
  scene.background.colors = {sky};
  const World banded = build(scene);
  const Ray up = through(kFaces[4], 0, 0), ahead = through(kFaces[0], 0, 1);
  EXPECT_EQ(banded.outside().view(up, RayKind::camera).color, sky);
  EXPECT_EQ(banded.outside().view(up, RayKind::reflection).color, Color(0)) << "bands are in no mirror";
  expectNear(banded.outside().view(ahead, RayKind::camera).color, quarterColor(0, 0, 1) * 0.2 + sky * 0.8);
  expectNear(banded.outside().view(ahead, RayKind::reflection).color, quarterColor(0, 0, 1) * 0.2);
}

TEST(Panorama, TurnsAndIsHiddenByAnEnvironment) {
  Settings settings;
  settings.environmentRotation = 90;  // what was ahead is then to the left
  const Ray left{{}, normalize(Vec3{-1, -0.5, -0.5})};
  expectNear(seen(panorama(), settings, left), quarterColor(0, 1, 1));
  Scene scene = panorama();
  scene.surroundings.environment = rainbow();
  EXPECT_EQ(build(scene).outside().view(left, RayKind::camera).source, Outside::Source::environment);
}

}  // namespace
}  // namespace trace::test::outside_test
