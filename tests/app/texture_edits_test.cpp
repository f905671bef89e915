#include "app/texture_edits.h"

#include <gtest/gtest.h>

namespace trace {
namespace {

TEST(TextureEdits, AnotherKindKeepsWhatBothHave) {
  Checker checker;
  checker.a = Color(0.3);
  checker.space = TextureSpace::uv;
  TextureNode node{.name = "floor", .model = checker, .placement = {.scale = {2, 2, 2}}};
  setTexture(node.inputs, "a", TextureNode{.model = Noise{}});
  const Texture before(node);
  const Texture brick = textureOfKind("brick", &before);
  EXPECT_EQ(brick->name, "");
  EXPECT_EQ(std::get<Brick>(brick->model).a, Color(0.3));
  EXPECT_EQ(std::get<Brick>(brick->model).b, Brick{}.b) << "a default gives way to the other's";
  EXPECT_EQ(std::get<Brick>(brick->model).space, TextureSpace::uv);
  EXPECT_EQ(brick->placement, node.placement);
  EXPECT_NE(textureOf(brick->inputs, "a"), nullptr);
  const Texture image = textureOfKind("image", &before);
  EXPECT_TRUE(image->inputs.empty()) << "a picture has no field a";
}

TEST(TextureEdits, EveryKindCanBeChosen) {
  for (const TextureKind& kind : textureKindsToChoose()) {
    const Texture texture = textureOfKind(kind.keyword);
    match(texture->model, [&](const auto& model) { EXPECT_EQ(model.kKeyword, kind.keyword); });
  }
}

TEST(TextureEdits, AFileThatWasNamedIsLacking) {
  Scene scene;
  scene.materials.emplace_back();
  EXPECT_FALSE(lacksFiles(scene));
  setTexture(scene.materials[0].textures, "diffuse", pictureTexture("no_such_file.png"));
  EXPECT_TRUE(lacksFiles(scene));
  EXPECT_THROW(readLackingFiles(scene), Error);
}

TEST(TextureEdits, ALampLacksItsPhotometry) {
  Scene scene;
  scene.lights.push_back({ProjectorLight{}, {}});
  std::get<ProjectorLight>(scene.lights[0].light).file.file = "no_such_file.png";
  EXPECT_TRUE(lacksFiles(scene));
}

}  // namespace
}  // namespace trace
