// The table of extensions is whole, and docs/features is of it.
#include "app/compare/extensions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "app/session/session.h"
#include "base/error.h"
#include "base/files/file.h"
#include "scene/scene_features.h"
#include "shading/material.h"
#include "support/paths.h"
#include "support/small_renders.h"

namespace trace::test {
namespace {

const std::string kExampleFolder = sourceFolder() + "/scenes", kPage = sourceFolder() + "/docs/features";

bool listed(std::string_view name) {
  return std::any_of(extensions().begin(), extensions().end(),
                     [&](const Extension& e) { return e.name == name; });
}

TEST(Extensions, EveryExtraAndEveryShadingModelHasAnExample) {
  for (const Option& option : options())
    if (option.extra) {
      EXPECT_TRUE(listed(option.name)) << option.name;
    }
  for (const std::string_view model : modelKeywords())
    if (model != Phong::kKeyword) {
      EXPECT_TRUE(listed(model)) << model;
    }
}

TEST(Extensions, EachChangesThePictureOfItsExample) {
  for (const Extension& e : extensions()) {
    SCOPED_TRACE(e.name);
    ASSERT_TRUE(std::filesystem::exists(kExampleFolder + "/" + std::string(e.scene)));
    const bool isPart = e.view.find("--region") != e.view.npos;
    const auto small = [&](bool on) {
      Session said;
      said.open(kExampleFolder + "/" + std::string(e.scene), choicesIn(on ? e.on : e.off));
      std::vector<Choice> choices = smallChoices(said.settings(), 24, 64);
      if (isPart) choices = {{"spp", "1", {}}};
      return pictureOf(e, on, kExampleFolder, choices);
    };
    const Picture off = small(false), on = small(true);
    ASSERT_EQ(off.width, on.width);
    EXPECT_NE(off, on);
    if (isPart) {
      EXPECT_EQ(off.width, 200) << "the region alone";
    }
  }
}

/// The picture of the example with the extension on, small, and with `more` above all.
Picture smallPictureOf(const Extension& e, const std::vector<Choice>& more) {
  Session said;
  said.open(kExampleFolder + "/" + std::string(e.scene), choicesIn(e.on));
  std::vector<Choice> choices = smallChoices(said.settings(), 24, 64);
  if (e.view.find("--region") != e.view.npos) choices = {{"spp", "1", {}}};
  choices.insert(choices.end(), more.begin(), more.end());
  return pictureOf(e, true, kExampleFolder, choices);
}

TEST(Extensions, EachCanBeSwitchedOffWhateverTheSceneSays) {
  for (const Extension& e : extensions()) {
    SCOPED_TRACE(e.name);
    const std::vector<Choice> off = choicesWithout(e.name);
    ASSERT_FALSE(off.empty());
    EXPECT_NE(smallPictureOf(e, {}), smallPictureOf(e, off));
  }
}

TEST(Extensions, EachPartOfScenesCanBeSwitchedOffAlone) {
  for (const SceneFeatureRow& part : sceneFeatures()) {
    SCOPED_TRACE(part.name);
    const std::vector<Choice> off = choicesWithout(part.name);
    EXPECT_EQ(off, (std::vector<Choice>{{"switched-off", std::string(part.name), {}}}));
    if (part.scene.empty()) {
      EXPECT_TRUE(listed(part.name)) << "its example is that of the extension";
      continue;
    }
    const Extension example{part.name, "", part.scene, "", "", ""};
    EXPECT_NE(smallPictureOf(example, {}), smallPictureOf(example, off));
  }
  EXPECT_LE(sceneFeatures().size(), 64u) << "a set holds no more";
}

TEST(Extensions, AreSwitchedOffByNamesAsPeopleTypeThem) {
  EXPECT_EQ(choicesWithout("media"), choicesWithout("medium"));
  EXPECT_EQ(choicesWithout("IES"), choicesWithout("goniometric_light"));
  EXPECT_EQ(choicesWithout("Warn"), choicesWithout("warn-light"));
  EXPECT_EQ(choicesWithout("thin-film"), choicesWithout("thin film"));
  EXPECT_EQ(choicesWithout("aperture"), (std::vector<Choice>{{"aperture", "0", {}}}));
  EXPECT_EQ(choicesWithout("denoise"), (std::vector<Choice>{{"denoise", "off", {}}}));
  for (const std::string& name : namesToSwitchOff()) EXPECT_FALSE(choicesWithout(name).empty()) << name;
  try {
    choicesWithout("apperture");
    ADD_FAILURE() << "an unknown name was taken";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("found \"apperture\""), std::string::npos) << error.what();
    EXPECT_NE(error.messages().front().hint.find("aperture"), std::string::npos);
  }
}

TEST(Extensions, ChoicesAreReadFromWords) {
  EXPECT_TRUE(choicesIn("").empty());
  const std::vector<Choice> two = choicesIn("--spp 9 --filter tent");
  ASSERT_EQ(two.size(), 2u);
  EXPECT_EQ(two[0], (Choice{"spp", "9", {}}));
  EXPECT_EQ(two[1], (Choice{"filter", "tent", {}}));
}

TEST(Extensions, ThePageIsOfTheTableAndHasItsPictures) {
  const std::string page = readFile(kPage + "/README.md");
  EXPECT_EQ(page, extensionsMarkdown()) << "run: ./dev features";
  for (std::size_t at = page.find("]("); at != page.npos; at = page.find("](", at + 1)) {
    const std::string picture = page.substr(at + 2, page.find(')', at) - at - 2);
    EXPECT_TRUE(std::filesystem::exists(kPage + "/" + picture)) << picture << "; run: ./dev features";
  }
}

}  // namespace
}  // namespace trace::test
