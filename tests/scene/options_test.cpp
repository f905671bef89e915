// The options table: one test per promise that every row keeps.
#include "scene/options.h"

#include <gtest/gtest.h>

#include <set>

#include "scene/conventions.h"
#include "scene/picture_size.h"

namespace trace {
namespace {

std::vector<std::string> someValues(const Option& option) {
  switch (option.kind) {
    case Option::Kind::boolean: return {"on", "off"};
    case Option::Kind::choice: return {option.choices.begin(), option.choices.end()};
    case Option::Kind::choices: {
      const std::string first(option.choices.front()), last(option.choices.back());
      return {last, first + "," + last, "none"};
    }
    case Option::Kind::color: return {"0.25", "0.5,0.25,1", "0"};
    case Option::Kind::region: return {"1,2,30,40", "0,0,0,0"};
    case Option::Kind::file: return {"pictures/a b.png", "/x.hdr", "none", "../y"};
    case Option::Kind::place: return {"a ball", "1,-2.5,3", "none", "box, the second"};
    default: return {option.get({}), std::to_string(static_cast<int>(option.least) + 1)};
  }
}

TEST(Options, NamesAreUniqueAndTextsComplete) {
  std::set<std::string_view> names;
  for (const Option& option : options()) {
    EXPECT_TRUE(names.insert(option.name).second) << option.name;
    EXPECT_FALSE(option.help.empty() || option.group.empty() || option.integrators.empty()) << option.name;
    EXPECT_NE(option.help.back(), '.') << option.name;
    const bool chooses = option.kind == Option::Kind::choice || option.kind == Option::Kind::choices;
    EXPECT_EQ(chooses, !option.choices.empty()) << option.name;
  }
}

TEST(Options, TextRoundTrips) {
  for (const Option& option : options())
    for (const std::string& value : someValues(option)) {
      Settings settings;
      option.assign(settings, value);
      EXPECT_EQ(option.get(settings), value) << option.name;
    }
}

TEST(Options, BadValuesAreRefusedByNameAndChangeNothing) {
  for (const Option& option : options())
    for (const char* bad : {"", "banana", "nan", "inf", "1e99", "-1e99", "1;2"}) {
      const bool isName = option.kind == Option::Kind::file || option.kind == Option::Kind::place;
      if (isName && *bad) continue;  // files and objects may be called anything
      Settings settings;
      try {
        option.assign(settings, bad);
        ADD_FAILURE() << option.name << " took \"" << bad << '"';
      } catch (const Error& error) {
        EXPECT_EQ(error.fault(), Fault::usage);
        const std::string what = error.what();
        EXPECT_NE(what.find("--" + std::string(option.name) + ": expected "), std::string::npos) << what;
        EXPECT_NE(what.find("found \"" + std::string(bad) + "\""), std::string::npos) << what;
      }
      EXPECT_EQ(settings, Settings{});
    }
}

TEST(Options, APlaceIsThreeNumbersOrAName) {
  const Option& option = findOption("focus-on");
  Settings settings;
  for (const char* wrong : {"1,2", "1,2,3,4", "(1, 2)", "1,,2"}) {
    try {
      option.assign(settings, wrong);
      ADD_FAILURE() << wrong << " is taken";
    } catch (const Error& error) {
      EXPECT_NE(
          std::string(error.what()).find("expected the name of an object, a point x,y,z of three numbers"),
          std::string::npos)
          << error.what();
    }
  }
  for (const char* name : {"7", "ball", "lamp, left", "a,b"}) {
    option.assign(settings, name);
    EXPECT_EQ(settings.focusOn.object, name);
  }
  for (const char* point : {"1,-2,3e0", "(1, -2, 3)"}) {
    option.assign(settings, point);
    ASSERT_TRUE(settings.focusOn.point) << point;
    EXPECT_EQ(*settings.focusOn.point, Vec3(1, -2, 3));
  }
}

TEST(Options, AFileThatASceneNamesLiesBesideIt) {
  const SourcePlace place{.file = "folder/scene.ray"};
  const std::vector<Choice> scene{{"environment", "sky.hdr", place}, {"backdrop", "/tmp/b.png", place}};
  const Settings settings = resolve({scene});
  EXPECT_EQ(settings.environment.path, "folder/sky.hdr");
  EXPECT_EQ(settings.backdrop.path, "/tmp/b.png");
  const std::vector<Choice> commandLine{{"environment", "sky.hdr", {}}, {"backdrop", "none", {}}};
  EXPECT_EQ(resolve({scene, commandLine}).environment.path, "sky.hdr");
  EXPECT_EQ(resolve({scene, commandLine}).backdrop.path, "");
  const std::vector<Choice> none{{"environment", "none", place}};
  EXPECT_EQ(resolve({none}).environment.path, "");
}

TEST(Options, OneFileBySeveralNamesIsOneValue) {
  Settings a, b;
  a.environment.path = "./sky.hdr", b.environment.path = "sky.hdr";
  EXPECT_TRUE(sameValue(findOption("environment"), a, b));
  b.environment.path = "other.hdr";
  EXPECT_FALSE(sameValue(findOption("environment"), a, b));
  b.environment.path = "";
  EXPECT_FALSE(sameValue(findOption("environment"), a, b));
}

TEST(Options, ARowChangesItsOwnFieldOnly) {
  for (const Option& option : options()) {
    Settings settings;
    for (const std::string& value : someValues(option)) option.assign(settings, value);
    for (const Option& other : options())
      EXPECT_TRUE(other.name == option.name || other.get(settings) == other.get({}))
          << option.name << other.name;
  }
}

TEST(Options, ExtrasAreOffByDefault) {
  for (const Option& option : options()) {
    if (!option.extra) continue;
    const std::string value = option.get({});
    const bool first = option.kind == Option::Kind::choice && value == option.choices.front();
    const bool one = option.name == "spp" || option.name == "wavelengths" || option.name == "photon-passes" ||
                     option.name == "working-gamma";
    const bool all = option.name == "light-vertices" || option.name == "camera-vertices";
    EXPECT_TRUE(value == "off" || value == "none" || value == "0" || first || (one && value == "1") ||
                (all && value == "-1"))
        << option.name << " " << value;
  }
}

TEST(Options, UnknownNamesGetAHint) {
  try {
    findOption("widht");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean \"width\""), std::string::npos);
  }
}

TEST(Conventions, EachGivesAValueToEveryOptionOfTheGroupAndToNoOther) {
  const auto likes = findOption("like").choices;
  ASSERT_EQ(conventions().size(), likes.size());
  for (size_t i = 0; i < likes.size(); ++i) {
    const Convention& row = conventions()[i];
    EXPECT_EQ(row.name, likes[i]);
    EXPECT_EQ(static_cast<size_t>(row.settings.like), i);
    std::vector<Choice> others;  // other values than its own, for all options
    for (const Option& option : options())
      for (const std::string& value : someValues(option))
        if (value != option.get(row.settings)) others.push_back({std::string(option.name), value, {}});
    const Settings before = resolve({others});
    const Settings after = resolve({others, std::vector<Choice>{{"like", std::string(row.name), {}}}});
    for (const Option& option : options())
      EXPECT_EQ(option.get(after), option.get(option.group == "Conventions" ? row.settings : before))
          << row.name << " " << option.name;
  }
}

TEST(Conventions, TheDefaultsAreThoseOfTheFirstRow) {
  const std::vector<Choice> like{{"like", "uw", {}}};
  EXPECT_EQ(resolve({like}), Settings{});
}

TEST(Resolve, LikeComesFirstInItsLayerAndLaterLayersWin) {
  const std::vector<Choice> file{{"highlight", "blinn", {}}, {"like", "ut", {}}, {"depth", "2", {}}};
  Settings settings = resolve({file});
  EXPECT_EQ(settings.highlight, Highlight::blinn);
  EXPECT_EQ(settings.glass, Glass::perDistance);
  EXPECT_EQ(settings.depth, 2);

  const std::vector<Choice> line{{"like", "uw2001", {}}, {"depth", "7", {}}};
  settings = resolve({file, line});
  EXPECT_EQ(settings.like, Like::uw2001);
  EXPECT_EQ(settings.highlight,
            Highlight::phong);  // the line's convention overrides the file's single choice
  EXPECT_EQ(settings.glass, Glass::perCrossing);
  EXPECT_EQ(settings.depth, 7);
}

TEST(Resolve, ErrorsCarryTheChoicesPlace) {
  const std::vector<Choice> file{{"depth", "many", {"a.ray", 4, 9, "depth = many"}}};
  try {
    resolve({file});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::scene);
    EXPECT_EQ(std::string(error.what()).find("a.ray:4:9: error: --depth: expected"), 0u);
  }
}

TEST(PictureSize, OneSideGivenAboveTheSceneKeepsItsShape) {
  using Layer = std::vector<Choice>;
  Camera wide;
  wide.aspectratio = 2;
  const auto size = [&](const Layer& scene, const Layer& line, const Layer& more = {}) {
    const Settings settings = settingsFor(wide, {scene, line, more});
    return std::pair{settings.width, settings.height};
  };
  const Choice w240{"width", "240", {}}, h240{"height", "240", {}}, none{"height", "0", {}};
  const Layer both{{"width", "800", {}}, {"height", "600", {}}};
  using Size = std::pair<int, int>;
  EXPECT_EQ(size(both, {}), Size(800, 600));
  EXPECT_EQ(size(both, {w240}), Size(240, 180));
  EXPECT_EQ(size(both, {h240}), Size(320, 240));
  EXPECT_EQ(size(both, {w240, h240}), Size(240, 240)) << "both: as given";
  EXPECT_EQ(size(both, {w240, none}), Size(240, 0)) << "height 0 is the camera's";
  EXPECT_EQ(size(both, {none}), Size(800, 0));
  EXPECT_EQ(size({}, {w240}), Size(240, 0));
  EXPECT_EQ(size({}, {h240}), Size(480, 240)) << "the camera's shape";
  EXPECT_EQ(size({h240}, {}), Size(400, 240)) << "the scene's own sizes are as they stand there";
  EXPECT_EQ(size({h240}, {{"width", "100", {}}}), Size(100, 60));
  EXPECT_EQ(size(both, {w240}, {{"height", "90", {}}}), Size(120, 90)) << "layer by layer";
  EXPECT_EQ(size(both, {{"width", "1", {}}}), Size(1, 1));
  EXPECT_EQ(settingsFor(wide, {both, Layer{{"depth", "3", {}}}}).depth, 3);
  wide.aspectratio = 1e9;
  EXPECT_THROW(size({}, {h240}), Error);
}

TEST(ChangedOptions, AreWhatRecreatesTheSettings) {
  const std::vector<Choice> line{{"like", "ut", {}}, {"width", "37", {}}, {"region", "1,2,3,4", {}}};
  const Settings settings = resolve({line});
  const std::vector<Choice> changed = changedOptions(settings);
  EXPECT_EQ(resolve({changed}), settings);
  EXPECT_TRUE(changedOptions({}).empty());
}

}  // namespace
}  // namespace trace
