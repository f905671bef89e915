// A part of a picture has the bits of the whole one, whatever the integrator and what is added.
#include <gtest/gtest.h>

#include <functional>

#include "geometry/shapes/solids/sphere.h"
#include "render/picture/light_image.h"
#include "support/rooms.h"

namespace trace::test::region_test {
namespace {

/// A room with a ball of glass, whose caustic comes by paths from the lamp, and one that mirrors.
Scene room() {
  Scene scene = openRoom();
  addObject(scene, Square{}, Affine::translation({0, 0.98, 0}) * turned({1, 0, 0}, 0.5) * scaled(0.6),
            diffuse(0.5, 6));
  Phong glass = diffuse(0), mirror = diffuse(0.1);
  glass.transmissive = glass.reflective = Color(1), glass.index = 1.5;
  mirror.reflective = Color(0.8);
  addObject(scene, Sphere{}, Affine::translation({0.3, -0.5, 0.2}) * scaled(0.35), glass);
  addObject(scene, Sphere{}, Affine::translation({-0.5, -0.6, -0.2}) * scaled(0.3), mirror);
  return scene;
}

/// Its border lies within tiles, and beside it there are tiles of which nothing is shown.
constexpr Region kPart{5, 20, 39, 42};
constexpr int kWidth = 72, kHeight = 44;

Settings settingsOf(IntegratorKind integrator) {
  Settings settings;
  settings.integrator = integrator;
  settings.sampling = SampleKind::sobol;
  settings.width = kWidth, settings.height = kHeight;
  settings.depth = 4, settings.spp = 4;
  settings.photons = 5000;
  return settings;
}

bool isInPart(int x, int y) { return x >= kPart.x0 && x < kPart.x1 && y >= kPart.y0 && y < kPart.y1; }

void expectTheWholePicturesBits(const Scene& scene, Settings settings, const std::string& what) {
  const Picture whole = picture(scene, settings);
  settings.region = kPart;
  const Picture part = picture(scene, settings);
  int wrong = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) wrong += part.at(x, y) != (isInPart(x, y) ? whole.at(x, y) : Color(0));
  EXPECT_EQ(wrong, 0) << what;
}

TEST(Region, HasTheBitsOfTheWholePictureByEveryIntegrator) {
  for (const IntegratorRow& row : integrators()) {
    if (row.traits.has(Trait::byChains))
      continue;  // whose light walks about in the region alone: docs/metropolis.md
    expectTheWholePicturesBits(room(), settingsOf(row.kind), std::string(row.name));
  }
}

TEST(Region, HasThemWithWhateverIsAdded) {
  const std::vector<std::pair<const char*, std::function<void(Settings&)>>> additions{
      {"mitchell", [](Settings& s) { s.filter = FilterKind::mitchell, s.filterRadius = 2; }},
      {"the light image alone", [](Settings& s) { s.cameraVertices = 1; }},
      {"one way", [](Settings& s) { s.cameraVertices = 2, s.lightVertices = 2; }},
      {"unweighted", [](Settings& s) { s.cameraVertices = 1, s.unweighted = true; }},
      {"outlines", [](Settings& s) { s.outlines = 2; }},
      {"fog", [](Settings& s) { s.fog = 0.1; }},
      {"many samples", [](Settings& s) { s.spp = 20; }},
      {"another generator", [](Settings& s) { s.sampling = SampleKind::blue; }},
      {"a grid", [](Settings& s) { s.sampling = SampleKind::grid; }},
      {"a lens", [](Settings& s) { s.aperture = 0.1, s.focus = 4; }},
  };
  for (const auto& [name, add] : additions) {
    Settings settings = settingsOf(IntegratorKind::bdpt);
    add(settings);
    expectTheWholePicturesBits(room(), settings, name);
  }
  Settings gathers = settingsOf(IntegratorKind::photon);
  gathers.finalGather = true, gathers.spp = 1;
  expectTheWholePicturesBits(room(), gathers, "final gathering");
}

TEST(Region, OfPathsFromBothEndsIsTheSameForAnyThreadsAndAfterAStop) {
  Settings settings = settingsOf(IntegratorKind::bdpt);
  settings.region = kPart;
  settings.spp = 8;
  EXPECT_EQ(afterAStop(room(), settings, 2), sameForAnyThreads(room(), settings));
}

TEST(Region, KnowsTheLightImageOfTheWholePicture) {
  Settings settings = settingsOf(IntegratorKind::bdpt);
  const Scene scene = room();
  const World world = build(scene, settings);
  const auto integrator = integratorOf(world, settings);
  const std::array moments{Moment{&world, integrator.get()}};
  const Size size{kWidth, kHeight};
  Job job;
  const LightImagePixel whole = lightImageAt(moments, settings, size, 20, 40, job);
  settings.region = kPart;
  Film film = makeFilm(settings, kWidth, kHeight);
  render(moments, settings, film, job);
  const LightImagePixel part = lightImageAt(moments, settings, size, 20, 40, job);
  EXPECT_GT(part.landed, 0);
  EXPECT_EQ(part.value, whole.value);
  EXPECT_EQ(part.paths, std::int64_t{4} * kWidth * kHeight);
  EXPECT_EQ(film.ofSplats(20, 40), whole.value);
  EXPECT_EQ(lightImageAt(moments, settings, size, 60, 10, job).paths, 0) << "the pixel lies elsewhere";
}

}  // namespace
}  // namespace trace::test::region_test
