// First aid that is true: each cause of a dark or bright picture, in each way of exposure, with the cure that
// the program prints. What it says is pasted, and rendered.
#include <gtest/gtest.h>

#include <regex>

#include "image/codecs/codec.h"
#include "image/development/tone.h"
#include "program.h"

namespace trace::test {
namespace {

class FirstAid : public ProgramTest {
 protected:
  /// The mean of the brightest channel's levels.
  double meanLevel() const {
    const Bytes bytes = toBytes(readPicture(path("out.png")), Rounding::nearest);
    double sum = 0;
    for (std::size_t i = 0; i < bytes.rgb.size(); i += 3)
      sum += std::max({bytes.rgb[i], bytes.rgb[i + 1], bytes.rgb[i + 2]});
    return 3 * sum / static_cast<double>(bytes.rgb.size());
  }

  /// What the program says of the scene, with options in its settings and on the command line.
  std::string said(const std::string& light, const std::string& settings = "",
                   std::vector<std::string> more = {}) const {
    write("scene.ray", "Trace 1\nsettings { width = 64; " + settings + " }\n" +
                           "camera { position = (3, 3, 8); look_at = (0, 0.8, 0); fov = 32 }\n" + light +
                           "\nplane { material = { diffuse = (0.5, 0.4, 0.3) } }\n"
                           "translate(0, 1, 0) { sphere { material = { diffuse = (0.8, 0.8, 0.8) } } }\n");
    more.insert(more.begin(), {"scene.ray", "out.png", "--quality", "draft"});
    return run(more).err;
  }

  static std::string cureIn(const std::string& text, const std::string& pattern) {
    std::smatch match;
    EXPECT_TRUE(std::regex_search(text, match, std::regex(pattern))) << text;
    return match.empty() ? "" : std::string(match[1]);
  }

  void expectSound(const std::string& text) const {
    EXPECT_FALSE(contains(text, "warning")) << text;
    EXPECT_GT(meanLevel(), 60);
    EXPECT_LT(meanLevel(), 150);
  }
};

constexpr const char* kPlace = "position = (-4, 5, 3); radius = 0.5; ";
constexpr const char* kFixed = "auto-exposure = off; ";

TEST_F(FirstAid, ADarkPictureIsToldTheFieldThatItsLightUses) {
  const auto light = [](const std::string& strength) {
    return "point_light { " + std::string(kPlace) + strength + " }";
  };
  for (const auto& [strength, field] : {std::pair<std::string, std::string>{"power = 2", "power = "},
                                        {"power = 0.02; color = (1, 0.8, 0.6)", "power = "},
                                        {"color = (0.002, 0.002, 0.001)", "color = "},
                                        {"color = (0.02, 0.02, 0.02); constant_attenuation_coeff = 1; "
                                         "quadratic_attenuation_coeff = 0",
                                         "color = "}}) {
    const std::string dark = said(light(strength), kFixed);
    EXPECT_TRUE(contains(dark, "is darker than level 20 of 255")) << strength << "\n" << dark;
    std::string cured = strength;
    const std::string cure = cureIn(dark, "hint: (" + field + "[^;]*);");
    const std::size_t at = cured.find(field);
    cured.replace(at, cured.find(';', at) - at, cure);
    expectSound(said(light(cured), kFixed));
  }
  const std::string dark = said("let p = 2 point_light { " + std::string(kPlace) + "power = p }", kFixed);
  EXPECT_TRUE(contains(dark, " times its power or color in this light")) << dark;
}

TEST_F(FirstAid, AnExposureThatDarkensIsNamed) {
  const std::string light = "point_light { " + std::string(kPlace) + "power = 2000 }";
  for (const std::string way : {"", kFixed})
    for (const std::string exposure : {"-6", "-7", "-9"}) {
      const std::string dark = said(light, way + "exposure = " + exposure);
      EXPECT_TRUE(contains(dark, "exposure = " + exposure + " darkens it")) << dark;
      const std::string cure = cureIn(dark, "hint: --exposure (\\S+) ");
      expectSound(said(light, way + "exposure = " + exposure, {"--exposure", cure}));
    }
}

TEST_F(FirstAid, APictureThatIsNearlyWhiteIsToldAnExposure) {
  for (const std::string way : {"", kFixed})
    for (const std::string exposure : {"5", "11"}) {
      const std::string light = "point_light { " + std::string(kPlace) + "power = 2000 }";
      const std::string bright = said(light, way + "exposure = " + exposure);
      EXPECT_TRUE(contains(bright, "brighter than white")) << way << exposure << "\n" << bright;
      const std::string cure = cureIn(bright, "hint: --exposure (\\S+) ");
      expectSound(said(light, way + "exposure = " + exposure, {"--exposure", cure}));
    }
  const std::string bright = said("point_light { " + std::string(kPlace) + "power = 6e9 }", kFixed);
  const std::string cure = cureIn(bright, "hint: --exposure (\\S+) ");
  expectSound(said("point_light { " + std::string(kPlace) + "power = 6e9 }", kFixed, {"--exposure", cure}));
}

TEST_F(FirstAid, ALightThatReachesNothingIsNamedWithItsMistake) {
  for (const std::string way : {"", kFixed}) {
    const auto told = [&](const std::string& light, const std::string& cause) {
      const std::string dark = said(light, way);
      EXPECT_TRUE(contains(dark, cause)) << way << light << "\n" << dark;
      EXPECT_TRUE(contains(dark, "scene.ray:4:1: warning")) << dark;
      return dark;
    };
    const std::string sun = told("directional_light { direction = (1, 2, -1); color = (0.5, 0.5, 0.5) }",
                                 "this light shines away from the visible objects");
    const std::string cure = cureIn(sun, "hint: (direction = \\([^)]*\\));");
    expectSound(said("directional_light { color = (0.5, 0.5, 0.5); " + cure + " }", way));
    told("rectangle_light { position = (0, 4, 0); u = (0, 0, 1); v = (1, 0, 0); color = (9, 9, 9) }",
         "faces away");
    told("point_light { position = (0, 1, 0) }", "the light is inside");
  }
}

TEST_F(FirstAid, ACameraThatLooksAwayIsToldInRender) {
  write("away.ray", "Trace 1\ncamera { position = (0,1,6); look_at = (0,1,20) }\nsphere { }\n");
  const std::string away = run({"away.ray", "out.png", "-w", "64", "--quality", "draft"}).err;
  EXPECT_TRUE(contains(away, "no object is in the picture")) << away;
  EXPECT_TRUE(contains(away, "hint: look_at = (0, 0, 0)")) << away;
}

TEST_F(FirstAid, LintCountsTheExposureInForce) {
  said("point_light { " + std::string(kPlace) + "power = 2 }");
  EXPECT_FALSE(contains(run({"lint", "scene.ray"}).out, "light-too-weak"));
  said("point_light { " + std::string(kPlace) + "power = 2 }", "exposure = 5");
  EXPECT_FALSE(contains(run({"lint", "scene.ray"}).out, "light-too-weak"));
  said("point_light { " + std::string(kPlace) + "power = 0.0002 }", kFixed);
  EXPECT_TRUE(contains(run({"lint", "scene.ray"}).out, "light-too-weak"));
}

}  // namespace
}  // namespace trace::test
