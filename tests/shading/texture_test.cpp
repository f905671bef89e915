// What all textures share: placement, inputs, the constant that scales them; and pictures, texel by texel.
#include "shading/texture.h"

#include <gtest/gtest.h>

#include "shading/materials/phong.h"
#include "shading/textures/checker.h"
#include "shading/textures/image_map.h"

namespace trace {
namespace {

TexturePlace texturePlace(const Vec3& point, const Vec2& uv = {}) {
  TexturePlace place;
  place.point = point, place.uv = uv;
  return place;
}

/// Red, green / blue, white.
std::shared_ptr<const MipMap> fourTexels() {
  Picture picture(2, 2);
  picture.at(0, 0) = {1, 0, 0}, picture.at(1, 0) = {0, 1, 0};
  picture.at(0, 1) = {0, 0, 1}, picture.at(1, 1) = {1, 1, 1};
  return std::make_shared<const MipMap>(std::move(picture));
}

TEST(Texture, CheckersHaveTheirColorsInTurn) {
  const Checker checker{.a = {1, 0, 0}, .b = {0, 1, 0}};
  EXPECT_EQ(checker.at(texturePlace({0.5, 0.5, 0.5})), checker.a);
  EXPECT_EQ(checker.at(texturePlace({-0.5, 0.5, 0.5})), checker.b);
  EXPECT_EQ(checker.at(texturePlace({1.5, 0.5, -0.5})), checker.a);
  const Checker flat{.a = {1, 0, 0}, .b = {0, 1, 0}, .space = TextureSpace::uv};
  EXPECT_EQ(flat.at(texturePlace({9.5, 0, 0}, {0.5, 1.5})), flat.b);
}

TEST(Texture, PlacementsMoveThePattern) {
  const TextureNode plain{.model = Checker{}};
  TextureNode placed = plain;
  placed.placement = {.scale = {2, 2, 2}, .rotate = {0, 0, 90}, .translate = {10, 0, 0}};
  // (0.5, 0.5, 0.5) of the pattern, twice as large (1, 1, 1), turned (-1, 1, 1), moved (9, 1, 1).
  for (const Vec3& p : {Vec3{0.5, 0.5, 0.5}, Vec3{1.5, 0.5, 0.5}, Vec3{-3.25, 0.5, 2.5}}) {
    const Vec3 there{10 - 2 * p.y, 2 * p.x, 2 * p.z};
    EXPECT_EQ(Texture(placed).at(texturePlace(there)), Texture(plain).at(texturePlace(p)));
  }
  placed.placement = {.scale = {0, 1, 1}};
  EXPECT_EQ(Texture(placed).at(texturePlace({0.5, 0.5, 0.5})), Color(1)) << "a flat placement is none";
}

TEST(Texture, InputsScaleTheConstantsOfATexture) {
  const Texture inner =
      TextureNode{.model = Checker{.a = {1, 0, 0}, .b = {0, 0, 1}}, .placement = {.scale = {0.5, 0.5, 0.5}}};
  const Texture outer =
      TextureNode{.model = Checker{.a = Color(0.5), .b = {0, 1, 0}}, .inputs = {{"a", inner}}};
  EXPECT_EQ(outer.at(texturePlace({0.25, 0.25, 0.25})), (Color{0.5, 0, 0}));
  EXPECT_EQ(outer.at(texturePlace({0.75, 0.25, 0.25})), (Color{0, 0, 0.5}));
  EXPECT_EQ(outer.at(texturePlace({1.25, 0.25, 0.25})), (Color{0, 1, 0}));
}

TEST(Texture, NumbersTakeTheLuminance) {
  Phong phong;
  phong.shininess = 10, phong.diffuse = {1, 0.5, 0};
  const Texture red = TextureNode{.model = Checker{.a = {1, 0, 0}}};
  applyTextures(phong, {{"shininess", red}, {"diffuse", red}}, texturePlace({0.5, 0.5, 0.5}));
  EXPECT_DOUBLE_EQ(phong.shininess, 2.99);
  EXPECT_EQ(phong.diffuse, (Color{1, 0, 0}));
}

TEST(Texture, PicturesHaveTheirBottomLeftAtZero) {
  ImageMap map;
  map.file.map = fourTexels();
  const auto seen = [&](Real u, Real v) { return map.at(texturePlace({}, {u, v})); };
  EXPECT_EQ(seen(0.25, 0.25), (Color{0, 0, 1}));
  EXPECT_EQ(seen(0.75, 0.25), (Color{1, 1, 1}));
  EXPECT_EQ(seen(0.25, 0.75), (Color{1, 0, 0}));
  EXPECT_EQ(seen(0.75, 0.75), (Color{0, 1, 0}));
  EXPECT_EQ(seen(0.5, 0.75), (Color{0.5, 0.5, 0})) << "halfway";
  EXPECT_EQ(seen(0, 0.75), (Color{0.5, 0.5, 0})) << "halfway around";
  EXPECT_EQ(seen(-0.75, 1.75), (Color{1, 0, 0})) << "repeats";
  map.wrapU = map.wrapV = Wrap::clamp;
  EXPECT_EQ(seen(-3, 7), (Color{1, 0, 0}));
  map.wrapU = map.wrapV = Wrap::mirror;
  EXPECT_EQ(seen(-0.25, 0.25), (Color{0, 0, 1}));
  EXPECT_EQ(seen(1.25, 0.25), (Color{1, 1, 1}));
  map.wrapU = map.wrapV = Wrap::black;
  EXPECT_EQ(seen(-0.3, 0.25), Color(0));
  map.wrapU = map.wrapV = Wrap::clamp, map.centersAtEnds = true;
  EXPECT_EQ(seen(0, 0), (Color{0, 0, 1}));
  EXPECT_EQ(seen(0.5, 1), (Color{0.5, 0.5, 0}));
  map.channel = Channel::green;
  EXPECT_EQ(seen(1, 1), Color(1));
  map.channel = Channel::color, map.transform = {0, 1, 0, 1, 0, 0};
  EXPECT_EQ(seen(1, 0), (Color{1, 0, 0})) << "u and v change places";
  EXPECT_EQ(seen(kInfinity, 0), Color(0));
}

TEST(Texture, AreEqualByWhatTheySay) {
  EXPECT_EQ(pictureTexture("a.png"), pictureTexture("a.png"));
  EXPECT_FALSE(pictureTexture("a.png") == pictureTexture("b.png"));
  EXPECT_FALSE(Texture(TextureNode{.model = Checker{}}) == Texture(TextureNode{.model = ImageMap{}}));
}

}  // namespace
}  // namespace trace
