// Wrong renderers, made by breaking our own: what a program did differently with a scene is named, and where
// nothing that was tried explains it, that is said.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "app/compare/causes.h"
#include "app/session/session.h"
#include "base/budget.h"
#include "base/files/file.h"
#include "image/codecs/codec.h"
#include "image/development/development.h"
#include "support/folder.h"
#include "support/paths.h"
#include "support/wrong_room.h"

namespace trace::test {
namespace {

class SceneCause : public testing::Test {
 protected:
  SceneCause() { writeFile(room(), wrongRoom()); }

  std::string room() const { return folder_ / "room.ray"; }

  /// A picture of a scene's text after a replacement, as levels of a file.
  LoadedPicture rendered(const std::vector<Choice>& choices = {}, const std::string& from = "",
                         const std::string& to = "") const {
    std::string text = wrongRoom();
    if (!from.empty()) {
      EXPECT_NE(text.find(from), text.npos) << from;
      for (std::size_t at = 0; (at = text.find(from, at)) != text.npos; at += to.size())
        text.replace(at, from.size(), to);
    }
    writeFile(folder_ / "other.ray", text);
    return renderedFile(folder_ / "other.ray", choices);
  }
  static LoadedPicture renderedFile(const std::string& file, std::vector<Choice> choices) {
    choices.insert(choices.begin(), {"width", "96", {}});
    Session session;
    session.open(file, choices);
    session.build();
    session.renderPicture();
    const Settings& settings = session.settings();
    return {fromBytes(toBytes(developed(session.picture(), developmentOf(settings)), settings.rounding)),
            true};
  }
  SceneCauses causes(const LoadedPicture& reference, const LoadedPicture& test,
                     const std::vector<Choice>& choices = {}) const {
    return causesIn(room(), reference, test, choices);
  }
  static SceneCauses causesIn(const std::string& file, const LoadedPicture& reference,
                              const LoadedPicture& test, const std::vector<Choice>& choices = {}) {
    const Comparison numbers =
        compare(toBytes(reference.picture, Rounding::nearest), toBytes(test.picture, Rounding::nearest));
    const auto found = sceneCauses({.file = file, .choices = choices, .seconds = 0}, reference, test,
                                   {numbers.worstX, numbers.worstY});
    EXPECT_TRUE(found.has_value());
    return found.value_or(SceneCauses{});
  }
  static std::string textOf(const std::optional<SceneMatch>& match) { return match ? match->text() : "none"; }

  const Folder folder_;
};

TEST_F(SceneCause, TermsThatAreMissingAreNamed) {
  const LoadedPicture right = rendered();
  struct {
    std::string from, to, cause, pixel;
  } const cases[] = {
      {"material = {", "material = { shadow = 0;", "without shadows", "shadow"},
      {"reflective = (0.8, 0.8, 0.8); diffuse", "reflective = (0, 0, 0); diffuse", "",
       "the reflection in mirror"},
      {"ambient_light { color = (0.3, 0.3, 0.34); }", "", "without ambient light", "ambient light"},
      {"index = 1.5", "index = 1.0003", "with glass that does not bend light", ""},
      {"direction = (-0.6, -1, -0.3)", "direction = (0.6, 1, 0.3)", "without the light sun", "light of sun"},
      {"linear_attenuation_coeff = 0.1", "linear_attenuation_coeff = 0",
       "without the linear attenuation of lights", ""},
  };
  for (const auto& [from, to, cause, pixel] : cases) {
    SCOPED_TRACE(from + " -> " + to);
    const SceneCauses found = causes(right, rendered({}, from, to));
    if (!cause.empty()) {
      EXPECT_EQ(textOf(found.test), cause);
      ASSERT_TRUE(found.test.has_value());
      EXPECT_LT(found.test->rmse, 0.1);
    }
    if (pixel.empty()) continue;
    ASSERT_TRUE(found.pixel.has_value());
    EXPECT_TRUE(found.pixel->text.starts_with("lacks ")) << found.pixel->text;
    EXPECT_NE(found.pixel->text.find(pixel), std::string::npos) << found.pixel->text;
  }
}

TEST_F(SceneCause, OptionsThatDifferAreNamed) {
  const LoadedPicture right = rendered();
  for (const auto& [name, value] :
       std::vector<std::pair<std::string, std::string>>{{"highlight", "phong"},
                                                        {"depth", "1"},
                                                        {"depth", "0"},
                                                        {"projection", "orthographic"},
                                                        {"pixel-position", "center"},
                                                        {"like", "ut"},
                                                        {"tone", "stretch"}}) {
    SCOPED_TRACE(name + " " + value);
    const bool isBase = name == "depth" && value == "1";
    const std::vector<Choice> base = isBase ? std::vector<Choice>{{"depth", "2", {}}} : std::vector<Choice>{};
    const SceneCauses found = causes(isBase ? rendered(base) : right, rendered({{name, value, {}}}), base);
    EXPECT_EQ(textOf(found.test), "with --" + name + " " + value);
    ASSERT_TRUE(found.test.has_value());
    EXPECT_EQ(found.test->rmse, 0);
  }
}

TEST_F(SceneCause, AVariantAndAChangeOfThePictureAreNamedTogether) {
  const LoadedPicture right = rendered();
  LoadedPicture wrong = rendered({}, "material = {", "material = { shadow = 0;");
  std::reverse(wrong.picture.pixels.begin(), wrong.picture.pixels.end());
  const SceneCauses found = causes(right, wrong);
  EXPECT_EQ(textOf(found.test), "without shadows and turned by 180 degrees");
  EXPECT_FALSE(found.pixel.has_value()) << "its pixels lie elsewhere";
}

TEST_F(SceneCause, TwoVariantsAreNamedTogether) {
  const SceneCauses found = causes(
      rendered(), rendered({{"highlight", "phong", {}}}, "ambient_light { color = (0.3, 0.3, 0.34); }", ""));
  const std::string text = textOf(found.test);
  EXPECT_TRUE(text == "without ambient light and with --highlight phong" ||
              text == "with --highlight phong and without ambient light")
      << text;
}

TEST_F(SceneCause, ExchangedPicturesAreTold) {
  const SceneCauses found = causes(rendered({}, "index = 1.5", "index = 1.2"), rendered());
  EXPECT_EQ(
      sceneSentences(found, "mine.png", "ref.png").at(1),
      "mine.png is not what " + room() + " gives: the reference stands first, the picture to explain second");
}

TEST_F(SceneCause, WhatIsMissingIsNamedBeforeOptionsAndSigns) {
  const LoadedPicture right = rendered();
  const SceneCauses sun =
      causes(right, rendered({}, "direction = (-0.6, -1, -0.3)", "direction = (0.6, 1, 0.3)"));
  ASSERT_TRUE(sun.test.has_value());
  EXPECT_EQ(sun.test->text(), "without the light sun");
  EXPECT_EQ(sun.test->alike, std::vector<std::string>{"with directional lights from the opposite side"});
  const SceneCauses box = causes(right, rendered({{"omit", "box", {}}}));
  EXPECT_EQ(textOf(box.test), "without the object box");
  EXPECT_EQ(box.test->alike, std::vector<std::string>{"with --omit box"});
}

TEST_F(SceneCause, AnyDepthIsNamed) {
  const std::vector<Choice> base{{"depth", "6", {}}};
  const LoadedPicture right = rendered(base);
  for (const char* depth : {"1", "3"}) {
    const SceneCauses found = causes(right, rendered({{"depth", depth, {}}}), base);
    EXPECT_EQ(textOf(found.test), "with --depth " + std::string(depth));
  }
}

TEST_F(SceneCause, OtherValuesAreNamed) {
  const LoadedPicture right = rendered();
  struct {
    std::string from, to, cause;
  } const cases[] = {
      {"diffuse = (0.2, 0.4, 0.7)", "diffuse = (0.7, 0.4, 0.2)", "with diffuse (0.7, 0.4, 0.2) in box"},
      {"fov = 36", "fov = 31", "with fov 31 in the camera"},
      {"shininess = 20", "shininess = 3", "with shininess 3 in ball"},
      {"index = 1.5", "index = 1.2", "with index 1.2 in glass"},
      {"transmissive = (0.9, 0.95, 0.9)", "transmissive = (0.3, 0.95, 0.9)",
       "with transmissive (0.3, 0.95, 0.9) in glass"},
  };
  for (const auto& [from, to, cause] : cases) {
    SCOPED_TRACE(from + " -> " + to);
    const SceneCauses found = causes(right, rendered({}, from, to));
    EXPECT_EQ(textOf(found.test), cause);
    EXPECT_LT(found.test.value_or(SceneMatch{}).rmse, 0.05 * found.rmse);
  }
}

TEST_F(SceneCause, WhatNothingExplainsIsSaid) {
  const LoadedPicture right = rendered();
  const std::vector<std::pair<std::string, std::string>> cases{
      {"translate(-1.4, 0.7, 0, scale(0.7,", "translate(-1.1, 0.7, 0.3, scale(0.7,"},
      {"position = (-3, 5, 4)", "position = (-1, 5, 4)"},
      {"rotate(0, 1, 0, 0.5, scale(1.2,", "rotate(0, 1, 0, 1.1, scale(1,"},
      {"translate(0, 1.5, -3,", "translate(0.9, 1.5, -2.2,"},
      {"look_at = (0, 0.7, 0)", "look_at = (0.3, 0.7, 0)"},
  };
  for (const auto& [from, to] : cases) {
    SCOPED_TRACE(from + " -> " + to);
    const SceneCauses found = causes(right, rendered({}, from, to));
    EXPECT_EQ(textOf(found.test), "none");
    const std::string said = sceneSentences(found, "ref.png", "mine.png").front();
    EXPECT_TRUE(said.starts_with("none of ")) << said;
    EXPECT_NE(said.find("explains mine.png"), said.npos) << said;
    EXPECT_LE(found.nearest.value_or(SceneMatch{}).rmse, 0.75 * found.rmse) << said;
  }
}

TEST_F(SceneCause, ASearchThatWasCutSaysNothingFalse) {
  const LoadedPicture right = rendered(), wrong = rendered({{"like", "ut", {}}});
  for (const double seconds : {1e-9, 0.02, 0.05, 0.1, 0.2, 0.5}) {  // where it is cut does not matter
    Budget budget;
    budget.limitTime(seconds);
    const BudgetScope scope(&budget);
    const PictureDifference d = difference(right, wrong, {1, 67, true});
    EXPECT_GT(d.numbers.rmse, 0);
    const SceneQuestion question{.file = room(), .seconds = 0};
    const Causes found = causesOf(d, &question);
    if (!found.scene) {
      EXPECT_NE(found.stopped, "") << seconds;
      continue;
    }
    for (const std::string& sentence : sceneSentences(*found.scene, "ref.png", "mine.png"))
      EXPECT_EQ(sentence.find("is not what"), sentence.npos) << seconds << ": " << sentence;
  }
}

TEST_F(SceneCause, ACauseAndAVariantNeverContradictEachOther) {
  const LoadedPicture right = rendered();
  const auto explained = [&](const LoadedPicture& wrong) {
    const SceneQuestion question{.file = room(), .seconds = 0};
    return causesOf(difference(right, wrong, {1, 67}), &question);
  };
  const auto gamma = [](LoadedPicture picture) {
    for (Color& c : picture.picture.pixels)
      c = Color(std::pow(c.r, 1 / 2.2), std::pow(c.g, 1 / 2.2), std::pow(c.b, 1 / 2.2));
    return LoadedPicture{fromBytes(toBytes(picture.picture, Rounding::nearest)), true};
  };
  const Causes plain = explained(gamma(right));
  EXPECT_FALSE(plain.scene.has_value()) << "the cause leaves nothing";
  ASSERT_TRUE(plain.picture.has_value());
  EXPECT_EQ(plain.picture->change.text(), "with a gamma of 2.2 applied");

  const Causes both = explained(gamma(rendered({}, "ambient_light { color = (0.3, 0.3, 0.34); }", "")));
  EXPECT_FALSE(both.picture.has_value());
  ASSERT_TRUE(both.scene && both.scene->test);
  EXPECT_EQ(both.scene->test->text(), "without ambient light and with a gamma of 2.2 applied");

  const Causes dim = explained(rendered({}, "color = (0.7, 0.66, 0.6)", "color = (0.35, 0.33, 0.3)"));
  EXPECT_FALSE(dim.picture.has_value()) << dim.picture->change.text();
  ASSERT_TRUE(dim.scene && dim.scene->test);
  EXPECT_EQ(dim.scene->test->text(), "with color (0.35, 0.33, 0.3) in key");
}

TEST_F(SceneCause, WhatIsPlainToSeeIsSaidAndNotSearchedFor) {
  const LoadedPicture right = rendered();
  const auto notes = [&](const std::function<Color(const Color&)>& of, bool isSearched) {
    LoadedPicture wrong = right;
    for (Color& c : wrong.picture.pixels) c = of(c);
    const SceneQuestion question{.file = room(), .seconds = 0};
    const Causes found = causesOf(difference(right, wrong, {1, 67}), &question);
    EXPECT_EQ(found.scene.has_value(), isSearched);
    const std::vector<std::string> all = found.notes("ref.png", "mine.png", "levels");
    return all.empty() ? std::string("none") : all.front();
  };
  EXPECT_EQ(notes([](const Color&) { return Color(0); }, false), "mine.png is black: all its pixels are 0");
  EXPECT_EQ(notes([](const Color&) { return Color(1, 0, 0.2); }, false),
            "mine.png is of one colour: all its pixels are (255 0 51)");
  EXPECT_EQ(notes([](const Color& c) { return Color(c.g); }, true),
            "mine.png is grey: its pixels have equal red, green and blue");
  EXPECT_EQ(notes([](const Color& c) { return Color(1) + c * -1; }, false),
            "mine.png is the negative of ref.png");
}

TEST_F(SceneCause, TheReferenceMayBeMadeByOtherOptions) {
  const LoadedPicture reference = rendered({{"highlight", "phong", {}}}), plain = rendered();
  const SceneCauses same = causes(reference, plain);
  EXPECT_EQ(textOf(same.reference), "with --highlight phong");
  EXPECT_EQ(textOf(same.test), "");
  EXPECT_EQ(
      sceneSentences(same, "ref.png", "mine.png").front(),
      "mine.png is what " + room() + " gives; nothing else differs beyond rounding in 6144 pixels compared");
  const SceneCauses both =
      causes(reference, rendered({{"highlight", "phong", {}}}, "material = {", "material = { shadow = 0;"));
  EXPECT_EQ(textOf(both.test), "with --highlight phong and without shadows");
}

TEST_F(SceneCause, ExamplesOfTheRepository) {
  struct {
    std::string scene, option, value;
  } const cases[] = {{"mirrors.ray", "depth", "0"},
                     {"shadows.ray", "glass-shadows", "black"},
                     {"conventions.ray", "glass", "per-distance"}};
  for (const auto& [scene, option, value] : cases) {
    SCOPED_TRACE(scene);
    const std::string file = sourceFolder() + "/scenes/" + scene;
    const std::vector<Choice> base{{"spp", "1", {}}};
    const SceneCauses found =
        causesIn(file, renderedFile(file, base), renderedFile(file, {base[0], {option, value, {}}}), base);
    ASSERT_TRUE(found.test.has_value()) << found.variants;
    EXPECT_EQ(found.test->rmse, 0) << found.test->text();
  }
}

TEST_F(SceneCause, SmallPicturesAndOtherSizesHaveNone) {
  const LoadedPicture small{Picture(4, 4), true}, other{Picture(90, 40), true};
  EXPECT_FALSE(sceneCauses({.file = room()}, small, small, {}).has_value());
  EXPECT_FALSE(sceneCauses({.file = room()}, rendered(), other, {}).has_value());
}

}  // namespace
}  // namespace trace::test
