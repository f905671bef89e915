// The Background of VRML97: gradients of sky and ground by the angles of the specification, pictures, and
// what becomes of them when the scene is written.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <string>

#include "base/files/file.h"
#include "base/files/read_scope.h"
#include "formats/format.h"
#include "formats/inventor/inventor_sky.h"
#include "support/folder.h"
#include "support/gltf.h"
#include "support/random.h"

namespace trace::inventor_background_test {
namespace {

using inventor::gradientOf;

const Color kRed(1, 0, 0), kGreen(0, 1, 0), kBlue(0, 0, 1), kWhite(1), kBlack(0);

struct Read {
  Messages messages;
  Scene scene;

  explicit Read(const std::string& text, const std::string& file = "a.wrl")
      : scene(readScene(file, "#VRML V2.0 utf8\nShape { geometry Box { } }\n" + text, messages)) {}
  std::string warnings() const {
    std::string all;
    for (const Message& message : messages.all())
      if (!message.what.starts_with("no light")) all += message.what + "\n";
    return all;
  }
};

void expectNear(const Color& is, const Color& wanted) {
  EXPECT_NEAR(is.r, wanted.r, 1e-4);
  EXPECT_NEAR(is.g, wanted.g, 1e-4);
  EXPECT_NEAR(is.b, wanted.b, 1e-4);
}

TEST(VrmlBackground, OneColourIsBehindEverythingAndInNoMirror) {
  const Background is = Read("Background { skyColor 0.2 0.3 0.5 }").scene.background;
  EXPECT_EQ(is.colors, std::vector<Color>{Color(0.2, 0.3, 0.5)});
  EXPECT_TRUE(is.gradient.empty());
  EXPECT_EQ(Read("Background { }").scene.background, Background{}) << "black";
}

/// Angles of the sky are taken from straight up, of the ground from straight down.
TEST(VrmlBackground, ColoursAreMixedByTheirAngles) {
  const Background sky =
      Read("Background { skyColor [ 0 0 1, 0 1 0, 1 0 0 ] skyAngle [ 0.7853982, 1.570796 ] }")
          .scene.background;
  EXPECT_TRUE(sky.colors.empty());
  expectNear(sky.gradientAt(90), kBlue);
  expectNear(sky.gradientAt(67.5), (kBlue + kGreen) / 2);
  expectNear(sky.gradientAt(45), kGreen);
  expectNear(sky.gradientAt(15), lerp(2.0 / 3, kGreen, kRed));
  expectNear(sky.gradientAt(0), kRed);
  expectNear(sky.gradientAt(-90), kRed);  // the last goes on

  const Background both =
      gradientOf({{kBlue, kWhite}, {kPi / 2}}, {{kBlack, kRed, kGreen}, {kPi / 4, kPi / 2}});
  expectNear(both.gradientAt(-90), kBlack);
  expectNear(both.gradientAt(-67.5), kRed / 2);
  expectNear(both.gradientAt(-45), kRed);
  expectNear(both.gradientAt(0), kGreen);
  expectNear(both.gradientAt(0.001), lerp(0.001 / 90, kWhite, kBlue));
  expectNear(both.gradientAt(45), (kBlue + kWhite) / 2);
  EXPECT_EQ(both.elevations, (std::vector<Real>{-90, -45, 0, 0.001, 90}));
}

TEST(VrmlBackground, TheSkyShowsWhereTheGroundEnds) {
  const Background part = gradientOf({{kBlue, kWhite}, {kPi}}, {{kRed, kRed}, {kPi / 3}});
  expectNear(part.gradientAt(-30.0005 - 0.0005), kRed);
  expectNear(part.gradientAt(-29.999), lerp((90 + 29.999) / 180, kBlue, kWhite));
  expectNear(part.gradientAt(0), (kBlue + kWhite) / 2);
  const Background none = gradientOf({{kBlue}, {}}, {{kRed}, {}});
  EXPECT_EQ(none.gradient, std::vector<Color>{kBlue}) << "it ends where it begins";
}

/// Whatever angles are given, a .ray file takes the gradient.
TEST(VrmlBackground, ElevationsAscend) {
  test::Random random(7);
  for (int round = 0; round < 300; ++round) {
    const auto dome = [&] {
      inventor::Dome made;
      const int colors = random.below(6), angles = random.below(6);
      for (int i = 0; i < colors; ++i) made.colors.emplace_back(random.uniform());
      for (int i = 0; i < angles; ++i)
        made.angles.push_back(random.uniform() < 0.3 ? random.below(3) * kPi / 2 : random.uniform(-1, 4));
      return made;
    };
    const Background is = gradientOf(dome(), dome());
    EXPECT_EQ(is.elevations.size(), is.gradient.size());
    EXPECT_EQ(std::adjacent_find(is.elevations.begin(), is.elevations.end(), std::greater_equal<>()),
              is.elevations.end());
    for (const Real elevation : is.elevations) EXPECT_TRUE(elevation >= -90 && elevation <= 90) << elevation;
  }
}

TEST(VrmlBackground, OnlyTheFirstIsSeen) {
  const Background is =
      Read("Background { frontUrl \"no.png\" } Background { skyColor 1 0 0 backUrl \"b.png\" }")
          .scene.background;
  EXPECT_TRUE(is.colors.empty());
  EXPECT_EQ(is.front.file, "no.png");
  EXPECT_EQ(is.back.file, "");
}

TEST(VrmlBackground, PicturesAreReadAndThoseThatAreNotThereAreCheckers) {
  const test::Folder folder;
  writeFile(folder / "b.png", test::smallPng(255, 0, 0));
  const Read read("Background { skyColor 0 0 1 frontUrl [ \"no.png\" \"b.png\" ] topUrl \"none.png\" }",
                  folder / "a.wrl");
  const Background& is = read.scene.background;
  EXPECT_EQ(is.front.file, "b.png") << "the first that is there";
  EXPECT_EQ(is.front.map->texel(0, 0).color, kRed);
  EXPECT_EQ(is.gradient, std::vector<Color>{kBlue}) << "mirrors see it behind the pictures too";
  EXPECT_EQ(is.top.map->texel(0, 0).color, Color(1, 0, 1));
  EXPECT_EQ(is.left.map, nullptr);
  EXPECT_TRUE(read.warnings().starts_with("the texture \"none.png\" cannot be read: ")) << read.warnings();
  const auto& inputs = read.scene.inputs.all();
  for (const char* name : {"b.png", "none.png"})
    EXPECT_TRUE(std::any_of(inputs.begin(), inputs.end(),
                            [&](const InputFile& file) { return file.path == folder / name; }))
        << name << " may not be written over";
}

TEST(VrmlBackground, TurnsAboutTheAxisY) {
  const std::string background = "Background { backUrl \"no.png\" }";
  const auto turned = [&](const std::string& rotation, const std::string& what) {
    const Read read("Transform { scale 2 2 2 translation 1 2 3 rotation " + rotation + " children " + what +
                    " }");
    const Settings settings = resolve({read.scene.choices});
    const bool stands = read.warnings().find("stands upright") != std::string::npos;
    return std::pair(settings.environmentRotation, stands);
  };
  const auto [angle, stands] = turned("0 1 0 0.7853982", background);
  EXPECT_NEAR(angle, 45, 1e-5);
  EXPECT_FALSE(stands);
  EXPECT_TRUE(turned("1 0 0 0.5", background).second);
  EXPECT_FALSE(turned("1 0 0 0.5", "Background { skyColor 1 0 0 }").second);
  EXPECT_EQ(turned("0 1 0 1", "Background { skyColor 1 0 0 }").first, 0);
}

TEST(VrmlBackground, IsWrittenAsItWasRead) {
  const ReadScope allowed({testing::TempDir()});
  const test::Folder folder;
  std::filesystem::create_directory(folder / "other");
  std::string text =
      "Background { skyColor [ 0 0 1, 1 1 1 ] skyAngle 1.4 groundColor [ 0 0 0, 1 0 0 ] groundAngle 1.2";
  for (const char* side : {"front", "back", "left", "right", "top", "bottom"}) {
    writeFile(folder / (std::string(side) + ".png"), test::smallPng(255, 0, 0));
    text += " " + std::string(side) + "Url \"" + side + ".png\"";
  }
  Read read(text + " }", folder / "a.wrl");
  EXPECT_EQ(read.warnings(), "");
  for (const char* name : {"a.ray", "other/a.ray"}) {
    const std::string out = folder / name;
    const auto files = writableFormatFor(out).write(read.scene, out, {}, read.messages);
    ASSERT_EQ(files.size(), 1u);
    const Scene back = readScene(out, files[0].bytes, read.messages);
    EXPECT_EQ(read.warnings(), "");
    EXPECT_EQ(back.background.gradient, read.scene.background.gradient);
    EXPECT_EQ(back.background.elevations, read.scene.background.elevations);
    for (const Pixels* face : back.background.faces()) {
      ASSERT_TRUE(face->map) << face->file;
      EXPECT_EQ(face->map->texel(0, 0).color, kRed) << face->file;
    }
  }
  EXPECT_NE(writableFormatFor("a.obj").write(read.scene, folder / "a.obj", {}, read.messages).size(), 0u);
  EXPECT_NE(read.warnings().find("the background"), std::string::npos) << "no mesh file has one";
}

}  // namespace
}  // namespace trace::inventor_background_test
