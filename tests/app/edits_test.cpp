// What follows when a field was set by hand.
#include "app/editing/camera_words.h"
#include "app/editing/edits.h"

#include <gtest/gtest.h>

#include "formats/format.h"

namespace trace::test {
namespace {

TEST(CameraWords, FollowLensProjectionAndEyes) {
  Settings settings;
  EXPECT_EQ(cameraSentence(settings), "pinhole camera");
  settings.aperture = 0.25;
  EXPECT_EQ(cameraSentence(settings), "camera with a lens of aperture 0.25");
  settings.projection = Projection::fisheye;
  EXPECT_EQ(cameraSentence(settings), "fisheye camera with a lens of aperture 0.25");
  settings.aperture = 0;
  settings.stereo = Stereo::sideBySide;
  EXPECT_EQ(cameraSentence(settings), "fisheye camera, once for each eye");
}

TEST(Edits, AMirrorSetByHandFollowsTheHighlightNoMore) {
  Phong phong;
  phong.mirrorsSpecular = true;
  followEdit(phong, phong, "specular");
  EXPECT_TRUE(phong.mirrorsSpecular);
  followEdit(phong, phong, "reflective");
  EXPECT_FALSE(phong.mirrorsSpecular);
}

TEST(Edits, AMovedCameraLooksAtThePointThatItsFileNames) {
  Camera camera;
  camera.position = {0, 3, 4};
  followMove(camera, "position", Vec3{0, 3, 0});
  EXPECT_EQ(camera.viewdir, Vec3(0, 0, -1));
  camera.position = {4, 3, 0};
  followMove(camera, "position", Vec3{0, 3, 0});
  EXPECT_EQ(camera.viewdir, Vec3(-1, 0, 0));
  camera.position = {0, 0, 9};
  followMove(camera, "position", {});
  followMove(camera, "fov", Vec3{});
  EXPECT_EQ(camera.viewdir, Vec3(-1, 0, 0));
}

using Limits = std::vector<Real>;

/// The limits after an edit that made `now` of bands with the limits `before`.
Limits after(const Limits& before, std::size_t colors, const Limits& limits) {
  Background now{std::vector<Color>(colors), limits};
  followEdit(now, {{}, before}, "");
  return now.limits;
}

TEST(Edits, ABackgroundHasOneLimitLessThanColoursOrNone) {
  EXPECT_EQ(after({}, 3, {}), Limits{});                    // equal bands, of any number
  EXPECT_EQ(after({}, 4, {0}), (Limits{0.25, 0.5, 0.75}));  // the first limit: where the bands are
  EXPECT_EQ(after({0.25, 0.5}, 4, {0.25, 0.5}), (Limits{0.25, 0.5, 0.75}));  // a band more
  EXPECT_EQ(after({0.25, 0.5}, 2, {0.25, 0.5}), Limits{0.25});               // one less
  EXPECT_EQ(after({0.25, 0.5}, 3, {0.25}), Limits{});  // a limit less: equal bands again
  EXPECT_EQ(after({0.25}, 1, {0.25}), Limits{});
  EXPECT_EQ(after({}, 1, {0}), Limits{});
  EXPECT_EQ(after({0.25, 0.5}, 3, {0.25, 0.25, 0.5}), (Limits{0.25, 0.25}));
}

TEST(Edits, TheLimitsOfABackgroundAscend) {
  EXPECT_EQ(after({0.25, 0.5, 0.75}, 4, {0.6, 0.5, 0.75}), (Limits{0.6, 0.6, 0.75}));
  EXPECT_EQ(after({0.25, 0.5}, 3, {0.25, 0.1}), (Limits{0.25, 0.25}));
}

/// Whatever is done to a background, its scene can be saved and read.
TEST(Edits, AnEditedBackgroundIsReadAsItWasWritten) {
  Scene scene;
  Messages messages;
  const auto edit = [&](auto&& change) {
    const Background before = scene.background;
    change(scene.background);
    followEdit(scene.background, before, "");
    const auto files = writableFormatFor("a.ray").write(scene, "a.ray", {}, messages);
    EXPECT_EQ(readScene("a.ray", files.at(0).bytes, messages, 0).background, scene.background);
  };
  edit([](Background& b) { b.limits.emplace_back(); });
  for (int i = 0; i < 3; ++i) edit([&](Background& b) { b.colors.push_back(Color(i / 2.0)); });
  edit([](Background& b) { b.limits.emplace_back(); });
  edit([](Background& b) { b.limits[0] = 0.9; });
  edit([](Background& b) { b.colors.erase(b.colors.begin()); });
  edit([](Background& b) { b.colors.clear(); });
}

}  // namespace
}  // namespace trace::test
