// The view in space, the tree and the sum as a drawing, and as a film.
#include "app/view/ray_story.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>

#include "app/session/session.h"
#include "base/error.h"
#include "base/files/file.h"
#include "geometry/shapes/solids/plane.h"
#include "geometry/shapes/solids/sphere.h"
#include "image/codecs/codec_parts.h"
#include "image/development/development.h"
#include "image/srgb.h"
#include "math/elementary.h"
#include "support/folder.h"
#include "support/scenes.h"

namespace trace::test {
namespace {

std::shared_ptr<const Session> sessionOf(const Scene& scene, Settings settings) {
  settings.width = settings.height = 40;
  auto session = std::make_shared<Session>();
  session->open(scene, settings);
  session->build();
  return session;
}

Scene mirrorAndBall() {
  Phong mirror, red;
  mirror.reflective = Color(0.8);
  red.diffuse = Color(0.8, 0.1, 0.1), red.emissive = Color(0.1, 0, 0);
  Scene scene;
  addObject(scene, Sphere{}, {}, mirror);
  addObject(scene, Sphere{}, Affine::translation({0, 0, 12}) * Affine::scaling({4, 4, 4}), red);
  scene.objects.front().name = "mirror";
  scene.camera.position = {0, 0, 6};
  return scene;
}

std::size_t wordsIn(const Drawing& drawing, const std::string& part) {
  std::size_t count = 0;
  for (const Drawn& thing : drawing.things)
    if (const auto* words = std::get_if<DrawnWords>(&thing))
      count += words->words.find(part) != std::string::npos;
  return count;
}

TEST(RayStory, HasTheRaysTheTreeAndTheSum) {
  const auto session = sessionOf(mirrorAndBall(), {});
  const TracedPixel pixel = tracePixel(session, 20, 20, 0);
  ASSERT_GT(pixel.tree().nodes.size(), 1u);
  const RayStory story(pixel, session->scene().camera);
  const Drawing none = story.after(0), first = story.after(1), all = story.after(story.rays());
  EXPECT_EQ(wordsIn(none, "camera: mirror"), 0u);
  EXPECT_EQ(wordsIn(first, "camera: mirror"), 1u);
  EXPECT_EQ(wordsIn(first, "reflection: "), 0u) << "it is traced later";
  EXPECT_EQ(wordsIn(all, "reflection: "), 1u);
  EXPECT_EQ(wordsIn(all, pixel.why.sentence), 1u);
  EXPECT_GT(all.things.size(), first.things.size());
  EXPECT_EQ(all.width, none.width);
  EXPECT_EQ(all.height, none.height);
}

TEST(RayStory, AWholeDrawingHasEveryRowOfTheTree) {
  Scene scene = mirrorAndBall();
  for (int i = 0; i < 40; ++i)
    scene.lights.push_back({PointLight{.position = {0.01 * i, 1, 6}, .color = Color(0.1)}, {}});
  const auto session = sessionOf(scene, {});
  const TracedPixel pixel = tracePixel(session, 20, 20, 0);
  const RayStory story(pixel, session->scene().camera);
  ASSERT_GT(story.rays(), 40);
  EXPECT_EQ(wordsIn(story.after(story.rays()), "camera: mirror"), 0u) << "a film shows the latest rows";
  const Drawing whole = story.whole();
  EXPECT_EQ(wordsIn(whole, "camera: mirror"), 1u);
  EXPECT_EQ(wordsIn(whole, "shadow-"), wordsIn(whole, "shadow-lit") + wordsIn(whole, "shadow-blocked"));
  EXPECT_GE(wordsIn(whole, "shadow-"), 40u);
  for (const Drawn& thing : whole.things)
    if (const auto* words = std::get_if<DrawnWords>(&thing)) {
      EXPECT_LT(words->at.y, whole.height) << words->words;
    }
}

TEST(RayStory, ShowsColoursLightsArrowsAndHowRaysEnded) {
  Scene scene = mirrorAndBall();
  Phong blue, glass;
  blue.diffuse = Color(0, 0, 1);
  glass.transmissive = Color(0.9);
  addObject(scene, Sphere{}, Affine::translation({-2.5, 0, 0}), blue);
  addObject(scene, Sphere{}, Affine::translation({-2.5, 0, 1.5}) * Affine::scaling({0.5, 0.5, 0.5}), glass);
  scene.lights.push_back({PointLight{.position = {1, 1.5, 0}, .color = {1, 0, 0}}, {}});
  const auto session = sessionOf(scene, {});
  Camera view = scene.camera;
  view.aspectratio = 1.5;
  const Drawing drawing = RayStory(tracePixel(session, 20, 20, 0), view).after(99);
  EXPECT_GE(wordsIn(drawing, "opaque"), 1u);
  int heads = 0, lamps = 0;
  bool blueSeen = false, blueBehindGlass = false;
  for (const Drawn& thing : drawing.things) {
    heads += std::holds_alternative<DrawnTriangle>(thing);
    if (const auto* disk = std::get_if<DrawnDisk>(&thing))
      lamps += disk->color.r > 0.7 && disk->color.g < 0.1;
    if (const auto* picture = std::get_if<DrawnPicture>(&thing))
      for (const Color& c : picture->picture.pixels) {
        blueSeen = blueSeen || (c.b > 0.9 && c.r < 0.1);
        blueBehindGlass = blueBehindGlass || (c.b > 0.7 && c.r > 0.12 && c.r < 0.4);
      }
  }
  EXPECT_GE(heads, 1);
  EXPECT_EQ(lamps, 1);
  EXPECT_TRUE(blueSeen && blueBehindGlass);
}

/// The words of all lines, one below the other.
std::string wordsOf(const Drawing& drawing) {
  std::string text;
  for (const Drawn& thing : drawing.things)
    if (const auto* words = std::get_if<DrawnWords>(&thing)) text += words->words + "\n";
  return text;
}

TEST(RayStory, SignsStandOnlyBetweenWhatIsThere) {
  Scene scene = mirrorAndBall();
  Phong half;
  half.diffuse = half.reflective = Color(0.5);
  scene.materials.front().model = half;
  scene.lights.push_back({PointLight{.position = {0, 0, 6}, .color = Color(0.5)}, {}});
  const auto session = sessionOf(scene, {});
  const TracedPixel pixel = tracePixel(session, 20, 20, 0);
  const RayStory story(pixel, scene.camera);
  ASSERT_EQ(pixel.why.sum.size(), 2u);
  EXPECT_EQ(wordsIn(story.after(1), "="), 0u) << wordsOf(story.after(1));
  EXPECT_EQ(wordsIn(story.after(1), "+"), 0u);
  EXPECT_EQ(wordsIn(story.after(2), "="), 1u) << wordsOf(story.after(2));
  EXPECT_EQ(wordsIn(story.after(2), "+"), 0u);
  EXPECT_EQ(wordsIn(story.after(story.rays()), "+"), 1u) << wordsOf(story.after(story.rays()));
}

TEST(RayStory, ARowHasItsNumberOnceItsLightIsKnownAndItIsThatOfTheSum) {
  const auto session = sessionOf(mirrorAndBall(), {.spp = 4});
  const TracedPixel pixel = tracePixel(session, 20, 20, 1);
  ASSERT_EQ(pixel.explanation.samples.size(), 4u);
  const RayStory story(pixel, session->scene().camera);
  char number[24];
  std::snprintf(number, sizeof number, "%.4f", luminanceOf(pixel.explanation.samples[1]));
  EXPECT_EQ(wordsIn(story.after(1), number), 0u) << number;
  EXPECT_GE(wordsIn(story.after(story.rays()), number), 1u) << number;
  EXPECT_EQ(wordsIn(story.whole(), "sample 1 of 4"), 1u) << wordsOf(story.whole());
}

TEST(RayStory, ALastRayGrows) {
  const auto session = sessionOf(mirrorAndBall(), {});
  const RayStory story(tracePixel(session, 20, 20, 0), session->scene().camera);
  const auto reach = [](const Drawing& drawing) {
    double most = 0;
    for (const Drawn& thing : drawing.things)
      if (const auto* line = std::get_if<DrawnLine>(&thing))
        most += math::hypot(line->to.x - line->from.x, line->to.y - line->from.y);
    return most;
  };
  EXPECT_LT(reach(story.after(2, 0.25)), reach(story.after(2, 0.5)));
  EXPECT_LE(reach(story.after(2, 0.5)), reach(story.after(2))) << "it ends at the edge of the view";
}

TEST(RayStory, IsWrittenByTheEndingOfTheFile) {
  const Folder folder;
  const auto session = sessionOf(mirrorAndBall(), {});
  const RayStory story(tracePixel(session, 20, 20, 0), session->scene().camera);
  for (const char* name : {"a.svg", "b.PNG", "c.apng"}) writeStory(folder / name, story);
  EXPECT_EQ(readFile(folder / "a.svg").substr(0, 4), "<svg");
  EXPECT_EQ(readFile(folder / "b.PNG").substr(1, 3), "PNG");
  EXPECT_NE(readFile(folder / "c.apng").find("acTL"), std::string::npos);
  for (const char* name : {"d.jpg", "e"}) {
    try {
      writeStory(folder / name, story);
      ADD_FAILURE() << name;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(".svg, .png or .apng"), std::string::npos) << error.what();
    }
    EXPECT_FALSE(std::filesystem::exists(folder / name));
  }
  EXPECT_THROW(writeDrawing(folder / "f.apng", story.whole()), Error);
}

TEST(RayStory, AFilmHasFourPicturesForEachRay) {
  const auto session = sessionOf(mirrorAndBall(), {});
  const RayStory story(tracePixel(session, 20, 20, 0), session->scene().camera);
  int pictures = 0;
  forEachPngChunk(filmOf(story),
                  [&](std::string_view type, std::string_view) { pictures += type == "fcTL"; });
  EXPECT_EQ(pictures, 4 * story.rays());
}

TEST(RayStory, ACameraIsThatOfItsFrame) {
  Camera camera;
  camera.position = {1, 2, 3}, camera.viewdir = {0.2, -0.1, -1}, camera.fov = 33, camera.aspectratio = 1.4;
  const Camera again = cameraOf(frame(camera, CameraAxes::orthonormal), 1.4);
  EXPECT_NEAR(again.fov, 33, 1e-9);
  EXPECT_NEAR(length(again.viewdir - normalize(camera.viewdir)), 0, 1e-12);
  EXPECT_EQ(again.position, camera.position);
}

TEST(RayStory, SwatchesAndSentencesCountAutomaticExposureOnce) {
  Phong lamp;
  lamp.emissive = Color(40, 30, 20);
  lamp.diffuse = Color(0);
  Scene scene;
  addObject(scene, Sphere{}, {}, lamp);
  scene.camera.position = {0, 0, 3};
  const auto session = sessionOf(scene, {.autoExposure = true});
  EXPECT_LT(session->measuredExposure(), -3);
  const TracedPixel pixel = tracePixel(session, 20, 20, 0);
  EXPECT_EQ(pixel.why.sentence.find("Dark"), std::string::npos) << pixel.why.sentence;
  EXPECT_EQ(pixel.why.sentence.find("Black"), std::string::npos) << pixel.why.sentence;
  const Color shown = shownColour(pixel.tree().nodes.front().radiance, session->settings());
  EXPECT_GT(maxComponent(shown), 0.3);
}

std::size_t trianglesOf(const Drawing& drawing, const Color& color) {
  std::size_t count = 0;
  for (const Drawn& thing : drawing.things)
    if (const auto* triangle = std::get_if<DrawnTriangle>(&thing)) count += triangle->color == color;
  return count;
}

TEST(RayStory, ShowsLightsWithoutAPlaceAndThoseBeyondTheView) {
  Scene scene = mirrorAndBall();
  scene.lights.push_back({DirectionalLight{.direction = {1, -1, 0}, .color = {0, 1, 0}}, {}});
  scene.lights.push_back({PointLight{.position = {50, 0, 0}, .color = {1, 0, 0}}, {}});
  scene.lights.push_back({PointLight{.position = {0, 9, 30}, .color = {0, 0, 1}}, {}});
  const auto session = sessionOf(scene, {});
  const Drawing drawing = RayStory(tracePixel(session, 20, 20, 0), scene.camera).after(0);
  EXPECT_EQ(trianglesOf(drawing, {0, 0.8, 0}), 3u) << "arrows of the sun";
  EXPECT_EQ(trianglesOf(drawing, {0.8, 0, 0}), 1u) << "to the right";
  EXPECT_EQ(trianglesOf(drawing, {0, 0, 0.8}), 1u) << "behind the eye";
  for (const Drawn& thing : drawing.things) {
    const auto* disk = std::get_if<DrawnDisk>(&thing);
    if (disk && disk->color == Color(0.8, 0, 0)) {
      EXPECT_GT(disk->center.x, 0.9 * 600 * 0.8) << "at the right edge";
    }
  }
}

TEST(RayStory, CutsAnInfiniteFloorOffAsTheWindowDoes) {
  Scene scene = mirrorAndBall();
  addObject(scene, Plane{}, Affine::translation({0, -1, 0}) * Affine::rotation({1, 0, 0}, kPi / 2), {});
  const auto session = sessionOf(scene, {});
  Camera above = scene.camera;
  above.position = {0, 900, 0}, above.viewdir = {0, -1, 0}, above.updir = {0, 0, -1};
  const Drawing drawing = RayStory(tracePixel(session, 20, 20, 0), above).after(0);
  for (const Drawn& thing : drawing.things) {
    const auto* picture = std::get_if<DrawnPicture>(&thing);
    if (!picture || picture->picture.width < 100) continue;
    const Picture& view = picture->picture;
    EXPECT_GT(view.at(2, 2).b, 0.9) << "nothing";
    EXPECT_LT(view.at(view.width / 2, view.height / 2).b, 0.9);
  }
}

}  // namespace
}  // namespace trace::test
