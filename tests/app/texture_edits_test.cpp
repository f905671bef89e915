#include "app/editing/texture_edits.h"

#include <gtest/gtest.h>

#include "app/editing/edits.h"
#include "base/files/file.h"
#include "shading/lights/projector_light.h"
#include "shading/texture_flaws.h"
#include "shading/textures/brick.h"
#include "shading/textures/checker.h"
#include "shading/textures/formula.h"
#include "shading/textures/image_map.h"
#include "shading/textures/noise.h"
#include "support/exr.h"
#include "support/folder.h"

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
  EXPECT_EQ(brick->model.as<Brick>()->a, Color(0.3));
  EXPECT_EQ(brick->model.as<Brick>()->b, Brick{}.b) << "a default gives way to the other's";
  EXPECT_EQ(brick->model.as<Brick>()->space, TextureSpace::uv);
  EXPECT_EQ(brick->placement, node.placement);
  EXPECT_NE(textureOf(brick->inputs, "a"), nullptr);
  const Texture image = textureOfKind("image", &before);
  EXPECT_TRUE(image->inputs.empty()) << "a picture has no field a";
}

TEST(TextureEdits, EveryKindCanBeChosen) {
  for (const TextureKind& kind : textureKindsToChoose()) {
    const Texture texture = textureOfKind(kind.keyword);
    EXPECT_EQ(texture->model.keyword(), kind.keyword);
  }
}

TEST(TextureEdits, AFieldThatCountsForNothingSaysWhy) {
  const Noise plain;
  Noise ramped;
  ramped.ramp = {{0, 0, 0, 0}};
  EXPECT_EQ(whyIdle(plain, "a"), "");
  EXPECT_EQ(whyIdle(plain, "ramp"), "");
  EXPECT_EQ(whyIdle(ramped, "a"), "ramp counts instead");
  EXPECT_EQ(whyIdle(ramped, "b"), "ramp counts instead");
  EXPECT_EQ(whyIdle(ramped, "octaves"), "");
  EXPECT_EQ(whyIdle(Brick{}, "a"), "");
  Formula formula;
  formula.red = FormulaText("x");
  EXPECT_EQ(whyIdle(formula, "red"), "");
  EXPECT_EQ(whyIdle(formula, "a"), "value is empty");
  formula.value = FormulaText("y");
  EXPECT_EQ(whyIdle(formula, "red"), "value counts instead");
  EXPECT_EQ(whyIdle(formula, "a"), "");
}

TEST(TextureEdits, ARampBeginsWithTheColoursThatItTakesThePlaceOf) {
  Noise colors;
  colors.a = Color(0.1, 0.2, 0.3), colors.b = Color(0.9);
  const TextureModel before = colors;
  TextureModel now = before;
  now.edit<Noise>()->ramp.emplace_back();
  followEdit(now, before, "ramp");
  EXPECT_EQ(now.as<Noise>()->ramp, (ColorRamp{{0, 0.1, 0.2, 0.3}, {1, 0.9, 0.9, 0.9}}));
  for (const Real t : {0.0, 0.3, 1.0}) EXPECT_EQ(now.as<Noise>()->shade(t), colors.shade(t));
  TextureModel less = now;
  less.edit<Noise>()->ramp.pop_back();
  followEdit(less, now, "ramp");
  EXPECT_EQ(less.as<Noise>()->ramp.size(), 1u) << "one that is left over stays alone";
}

TEST(TextureEdits, FlawsAreTold) {
  const auto flaws = [](TextureModel model, Vec3 scale = {1, 1, 1}) {
    return flawsOf({.model = std::move(model), .placement = {.scale = scale}}).size();
  };
  EXPECT_EQ(flaws(Checker{}), 0u);
  EXPECT_EQ(flaws(Checker{}, {1, 0, 1}), 1u);
  EXPECT_EQ(flaws(ImageMap{}), 1u);
  EXPECT_EQ(flaws(Formula{}), 1u);
  Formula formula;
  formula.value = FormulaText("1/0");
  EXPECT_EQ(flaws(formula), 1u);
  formula.value = FormulaText("sqrt(x) / y");
  EXPECT_EQ(flaws(formula), 0u) << "it has a value in places";
  formula.red = FormulaText("log(-1)");
  EXPECT_EQ(flaws(formula), 1u);
}

TEST(TextureEdits, AFileThatWasNamedIsLacking) {
  Scene scene;
  scene.materials.emplace_back();
  EXPECT_FALSE(lacksFiles(scene));
  setTexture(scene.materials[0].textures, "diffuse", pictureTexture("no_such_file.png"));
  EXPECT_TRUE(lacksFiles(scene));
  Messages messages;
  EXPECT_THROW(readLackingFiles(scene, messages), Error);
}

TEST(TextureEdits, AFileThatIsOddIsTakenAndTold) {
  const test::Folder folder;
  writeFile(folder / "layers.exr", test::exrOf({{"", {{"B", 1.f}, {"G", 1.f}, {"R", 1.f}, {"Z", 2.f}}}}));
  Scene scene;
  scene.file = folder / "scene.ray";
  scene.materials.emplace_back();
  setTexture(scene.materials[0].textures, "diffuse", pictureTexture("layers.exr"));
  Messages messages;
  readLackingFiles(scene, messages);
  EXPECT_FALSE(lacksFiles(scene));
  ASSERT_EQ(messages.all().size(), 1u);
  EXPECT_NE(messages.all()[0].what.find("Z"), std::string::npos) << messages.all()[0].what;
}

TEST(TextureEdits, ALampLacksItsPhotometry) {
  Scene scene;
  scene.lights.push_back({ProjectorLight{}, {}});
  scene.lights[0].light.edit<ProjectorLight>()->file.file = "no_such_file.png";
  EXPECT_TRUE(lacksFiles(scene));
}

}  // namespace
}  // namespace trace
