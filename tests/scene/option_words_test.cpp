// Options are found by what people call them.
#include "scene/option_words.h"

#include <gtest/gtest.h>

#include <set>

namespace trace {
namespace {

std::set<std::string_view> found(std::string_view text) {
  std::set<std::string_view> names;
  for (const Option& option : options())
    if (isAbout(option, text)) names.insert(option.name);
  return names;
}

TEST(OptionWords, FindWhatPeopleLookFor) {
  EXPECT_TRUE(found("antialias").contains("spp"));
  EXPECT_TRUE(found("bounce").contains("depth"));
  EXPECT_TRUE(found("shadow").contains("glass-shadows"));
  EXPECT_TRUE(found("speed").contains("threads"));
  EXPECT_TRUE(found("speed").contains("accel"));
  EXPECT_TRUE(found("size").contains("width"));
  EXPECT_TRUE(found("crop").contains("region"));
  EXPECT_EQ(found("banana"), std::set<std::string_view>{});
}

TEST(OptionWords, CapitalLettersHyphensAndSpacesMakeNoDifference) {
  EXPECT_EQ(found("Antialias"), found("antialias"));
  EXPECT_EQ(found("DEPTH"), found("depth"));
  EXPECT_TRUE(found("glass shadows").contains("glass-shadows"));
  EXPECT_TRUE(found("Shadows glass").contains("glass-shadows"));
  EXPECT_EQ(found("").size(), options().size());
  EXPECT_EQ(found("  ").size(), options().size());
}

TEST(OptionWords, EveryOptionIsFoundByItsNameAndItsChoices) {
  for (const Option& option : options()) {
    EXPECT_TRUE(isAbout(option, option.name)) << option.name;
    for (const std::string_view choice : option.choices) EXPECT_TRUE(isAbout(option, choice)) << choice;
  }
}

TEST(OptionWords, NameLeastValuesThatAreNoQuantity) {
  EXPECT_EQ(leastWordFor(findOption("height")), "auto");
  EXPECT_EQ(leastWordFor(findOption("light-vertices")), "all");
  EXPECT_EQ(leastWordFor(findOption("depth")), "");  // 0 bounces are a number of bounces
  std::size_t named = 0;
  for (const Option& option : options()) {
    if (leastWordFor(option).empty()) continue;
    ++named;
    EXPECT_TRUE(option.kind == Option::Kind::integer || option.kind == Option::Kind::real) << option.name;
    EXPECT_TRUE(option.least == 0 || option.least == -1) << option.name;
  }
  EXPECT_EQ(named, 27u);  // none is spelt otherwise than its option
}

TEST(OptionWords, AreHints) {
  using Names = std::vector<std::string_view>;
  for (const Option& option : options())
    if (isAbout(option, "black"))
      EXPECT_EQ(relevance(option, "black") == 3, option.name == "depth") << option.name;
  EXPECT_EQ(relevance(findOption("medium-depth"), "depth"), 2);
  EXPECT_EQ(relevance(findOption("depth"), "Depth"), 3);
  EXPECT_EQ(optionsMeant("antialias"), (Names{"spp", "subdivide", "subdivide-threshold"}));
  EXPECT_EQ(optionsMeant("Resolution"), (Names{"width", "height"}));
  EXPECT_EQ(optionsMeant("widht"), Names{});
  try {
    findOption("samples");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean \"spp\"?"), std::string::npos);
  }
}

TEST(OptionWords, KnowWhatOfTheCameraIsNoOption) {
  EXPECT_EQ(cameraFieldMeant("fov"), "fov");
  EXPECT_EQ(cameraFieldMeant("Field of View"), "fov");
  EXPECT_EQ(cameraFieldMeant("zoom"), "fov");
  EXPECT_EQ(cameraFieldMeant("depth"), "");
  EXPECT_EQ(cameraFieldMeant(""), "");
  EXPECT_TRUE(isAbout(findOption("aperture"), "depth of field"));
}

}  // namespace
}  // namespace trace
