// Photometric files: what sound ones say, and where broken ones are wrong.
#include "formats/ies.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/files/file.h"
#include "formats/format.h"
#include "shading/lights/goniometric_light.h"
#include "support/paths.h"
#include "support/random.h"

namespace trace::test::ies_test {
namespace {

namespace fs = std::filesystem;

const std::string kFolder = test::sourceFolder() + "/tests/corpus/ies/";

Photometry fromFile(const std::string& name, std::string* warnings = nullptr) {
  Messages messages;
  Photometry read = readIes(name, readFile(kFolder + name), messages);
  if (warnings)
    for (const Message& message : messages.all()) *warnings += message.what + "\n";
  return read;
}

/// "3:7: expected ...".
std::string failure(const std::string& bytes) {
  Messages messages;
  try {
    readIes("lamp.ies", bytes, messages);
  } catch (const Error& error) {
    const Message& first = error.messages().front();
    EXPECT_EQ(first.place.file, "lamp.ies");
    return std::to_string(first.place.line) + ":" + std::to_string(first.place.column) + ": " + first.what;
  }
  return "";
}

TEST(Ies, ReadsItsCandelas) {
  const Photometry downlight = fromFile("downlight.ies");
  EXPECT_EQ(downlight.brightest(), 1000);
  EXPECT_NEAR(downlight.at({0, 0, 1}), 1000, 1e-9);
  EXPECT_NEAR(downlight.at({0, 0.5, std::sqrt(0.75)}), 649.52, 0.01);
  EXPECT_EQ(downlight.at({0, 0, -1}), 0);
  EXPECT_NEAR(downlight.lumens(), 2 * kPi * 1000 / 4, 5) << "of 5 degrees each";
  EXPECT_NEAR(fromFile("even.ies").lumens(), 400 * kPi, 1e-6);
  EXPECT_NEAR(fromFile("commas.ies").lumens(), downlight.lumens(), 1e-9);

  std::string warnings;
  EXPECT_NEAR(fromFile("tilt.ies", &warnings).lumens(), downlight.lumens(), 1e-9);
  EXPECT_EQ(warnings,
            "TILT: the loss of a tilted lamp is not applied: it shines as if it hung "
            "straight\n");
}

/// A lamp of 100 candelas everywhere in these angles, with a multiplier; its warnings, "line: what".
std::string warningsOf(const std::string& vertical, const std::string& horizontal, int rows, int columns,
                       const std::string& multiplier = "1", const std::string& after = "") {
  std::string bytes = "IESNA91\nTILT=NONE\n1 -1 " + multiplier + " " + std::to_string(rows) + " " +
                      std::to_string(columns) + " 1 2 0 0 0\n1 1 60\n" + vertical + "\n" + horizontal + "\n";
  for (int i = 0; i < rows * columns; ++i) bytes += "100 ";
  Messages messages;
  readIes("lamp.ies", bytes + after, messages);
  std::string text;
  for (const Message& m : messages.all()) text += std::to_string(m.place.line) + ": " + m.what + "\n";
  return text;
}

TEST(Ies, WarnsOfAnglesThatTheStandardDoesNotHave) {
  EXPECT_EQ(warningsOf("0 45 90", "0", 3, 1), "");
  EXPECT_EQ(warningsOf("0 90", "0 90", 2, 2), "");
  EXPECT_EQ(warningsOf("90 180", "0 180", 2, 2), "");
  EXPECT_EQ(warningsOf("0 180", "90 180 270", 2, 3), "");
  EXPECT_EQ(warningsOf("0 90", "0 120 240", 2, 3), "") << "360 is left out";
  EXPECT_EQ(warningsOf("20 30", "0", 2, 1),
            "6: expected vertical angles from 0 or 90 to 90 or 180 degrees, found 20 to 30: beyond these it "
            "gives no light\n");
  EXPECT_EQ(
      warningsOf("0 90", "0 70", 2, 2),
      "6: expected horizontal angles from 0 to 90, 180 or 360 degrees, or from 90 to 270, found 0 to 70: "
      "the nearest of these stands for the others\n");
  EXPECT_EQ(warningsOf("0 90", "0", 2, 1, "0"),
            "4: the photometric file has no light: its multiplier or one of its ballast factors is 0\n");
  EXPECT_EQ(warningsOf("0 90", "0", 2, 1, "1", "\n5\n"), "8: what follows the last candelas is ignored\n");
}

TEST(Ies, MultipliesByItsFactorsAndClosesTheRound) {
  const Photometry street = fromFile("street.ies");
  // 60 candelas in the file straight down, times 2, times a ballast factor of 0.95, by 1.2 - 1 over 2.
  EXPECT_NEAR(street.at({0, 0, 1}), 60 * 2 * 0.95 * 0.1, 0.02);
  const Photometry washer = fromFile("washer.ies");
  const auto at = [&](Real around) {
    const Real off = 36 * kPi / 180, turn = around * kPi / 180;
    return washer.at({std::sin(off) * std::cos(turn), std::sin(off) * std::sin(turn), std::cos(off)});
  };
  EXPECT_NEAR(at(352.5), (at(345) + at(0)) / 2, 1e-9) << "between its last angle and 360";
  EXPECT_GT(at(0), 3 * at(180));
}

TEST(Ies, HeadlampsAndFloodlightsHaveSystemsOfTheirOwn) {
  const Photometry headlamp = fromFile("headlamp.ies"), flood = fromFile("flood.ies");
  const auto up = [](Real degrees) {
    return Vec3{std::sin(degrees * kPi / 180), 0, std::cos(degrees * kPi / 180)};
  };
  const auto left = [](Real degrees) {
    return Vec3{0, std::sin(degrees * kPi / 180), std::cos(degrees * kPi / 180)};
  };
  EXPECT_GT(headlamp.at(up(-2)), 20 * headlamp.at(up(2))) << "cut off above the horizon";
  EXPECT_GT(headlamp.at(left(-10)), headlamp.at(left(10))) << "more to the right";
  EXPECT_NEAR(flood.at(left(30)), 5000 * std::exp(-1), 0.01);
  EXPECT_NEAR(flood.at(left(-30)), 5000 * std::exp(-1), 0.01);
  EXPECT_NEAR(flood.at(up(15)), 5000 * std::exp(-15.0 * 15 / 144), 0.01);
  EXPECT_NEAR(flood.at(up(-15)), flood.at(up(15)), 1e-9);
}

TEST(Ies, SaysWhereAFileIsWrong) {
  const auto of = [](const char* name) { return failure(readFile(kFolder + name)); };
  EXPECT_EQ(of("broken_no_tilt.ies"),
            "1:1: expected a line that begins with TILT=, as photometric files (IES LM-63) have it");
  EXPECT_EQ(of("broken_descends.ies"), "8:6: expected a vertical angle above 10, found 5");
  EXPECT_EQ(of("broken_negative.ies"), "11:6: expected candelas, at least 0, found -988.63");
  EXPECT_EQ(of("broken_word.ies"), "7:3: expected the ballast-lamp factor, found \"one\"");
  EXPECT_EQ(of("broken_type.ies"), "6:15: expected the photometric type: 1 (C), 2 (B) or 3 (A), found 7");
  EXPECT_EQ(of("broken_counts.ies").substr(0, 80),
            "6:10: expected the number of vertical angles, found 190000, which is more than t");
  EXPECT_NE(of("broken_short.ies").find("expected candelas, found "), std::string::npos);
}

TEST(Ies, NoPartOfAFileAndNoOtherByteCrashesIt) {
  Random random(5);
  for (const auto& entry : fs::directory_iterator(kFolder)) {
    const std::string bytes = readFile(entry.path().string());
    for (int i = 0; i < (kSanitized ? 10 : 60); ++i) {
      std::string part =
          bytes.substr(0, static_cast<std::size_t>(random.below(static_cast<int>(bytes.size()))));
      if (i % 2) {
        part = bytes;
        for (int k = 0; k < 4; ++k)
          part[static_cast<std::size_t>(random.below(static_cast<int>(part.size())))] =
              "0 -9.e\n,TILT="[random.below(14)];
      }
      Messages messages;
      try {
        const Photometry read = readIes("x.ies", part, messages);
        EXPECT_TRUE(std::isfinite(read.lumens()));
      } catch (const Error& error) {
        EXPECT_EQ(error.fault(), Fault::scene);
      }
    }
  }
}

TEST(Ies, AScenesLightNamesItsFile) {
  Messages messages;
  const auto read = [&](const std::string& light) {
    return readScene(kFolder + "scene.ray", "SBT-raytracer 1.0\n" + light + "\nsphere { }", messages);
  };
  const Scene scene = read(
      "goniometric_light { position = (0, 3, 0); color = (1, 1, 1); file = \"downlight.ies\"; direction = "
      "(0, -1, 0); }");
  const auto& light = *scene.lights.at(0).light.as<GoniometricLight>();
  ASSERT_TRUE(light.file.data);
  EXPECT_EQ(light.file.data->brightest(), 1000);
  EXPECT_TRUE(std::any_of(scene.inputs.all().begin(), scene.inputs.all().end(),
                          [](const InputFile& in) { return in.read && in.path.ends_with("downlight.ies"); }));
  try {
    read(
        "goniometric_light { position = (0, 3, 0); color = (1, 1, 1); direction = (0, -1, 0);\n file = "
        "\"broken_word.ies\"; }");
    FAIL() << "it is broken";
  } catch (const Error& error) {
    const Message& first = error.messages().front();
    EXPECT_EQ(first.place.line, 3);
    EXPECT_NE(first.what.find("broken_word.ies:7:3: expected the ballast-lamp factor"), std::string::npos)
        << first.what;
  }
}

}  // namespace
}  // namespace trace::test::ies_test
