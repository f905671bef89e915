// Pictures that are not what was meant, and the words that the program has for them.
#include <gtest/gtest.h>

#include <cstdlib>
#include <regex>

#include "image/codecs/codec.h"
#include "image/development/tone.h"
#include "program.h"
#include "support/paths.h"

namespace trace::test {
namespace {

class Silence : public ProgramTest {
 protected:
  /// The mean of the brightest channel's levels.
  double meanLevel(const std::string& name) const {
    const Bytes bytes = toBytes(readPicture(path(name)), Rounding::nearest);
    double sum = 0;
    for (std::size_t i = 0; i < bytes.rgb.size(); i += 3)
      sum += std::max({bytes.rgb[i], bytes.rgb[i + 1], bytes.rgb[i + 2]});
    return 3 * sum / static_cast<double>(bytes.rgb.size());
  }

  static std::string replaced(std::string text, const std::string& what, const std::string& by) {
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return at == std::string::npos ? text : text.replace(at, what.size(), by);
  }

  static constexpr const char* kFirst = R"(SBT-raytracer 1.1
camera { position = (0, 2.4, 7); look_at = (0, 0.8, 0); fov = 35; aspectratio = 1.3333; }
point_light { position = (-6, 9, 6); color = (1, 1, 1); radius = 1; }
rotate(1, 0, 0, -1.5708, scale(10, square { material = { library = oak; } }))
translate(-1, 0.8, 0, scale(0.8, sphere { material = { library = "red plastic"; } }))
)";
  static constexpr const char* kNoisy =
      "SBT-raytracer 1.0\nbackground { color = (0.02, 0.02, 0.02); }\n"
      "camera { position = (0, 1, 5); look_at = (0, 1, 0); updir = (0, 1, 0); }\n"
      "translate(0, 4, 0, rotate(1, 0, 0, 1.5708, square { material = { emissive = (150, 150, "
      "150); } }))\nrotate(1, 0, 0, -1.5708, scale(10, square { material = { diffuse = "
      "(0.7, 0.7, 0.7); } }))\n";
};

TEST_F(Silence, AFirstSceneThatIsBlackIsToldWithAColourThatHelps) {
  write("first.ray", kFirst);
  const Run r = run({"first.ray", "black.png", "-w", "80"});
  EXPECT_EQ(r.code, 0);
  EXPECT_LT(meanLevel("black.png"), 2);
  EXPECT_TRUE(contains(r.err, "first.ray:3:1: warning: "));
  EXPECT_TRUE(contains(r.err, "of the picture is darker than level 20 of 255"));
  EXPECT_TRUE(contains(r.err, "fades with the square of the distance"));
  const Run lint = run({"lint", "first.ray"});
  EXPECT_EQ(lint.code, 6);
  EXPECT_TRUE(contains(lint.out, "[black-picture]"));
  for (const std::string& told : {r.err, lint.out}) {
    std::smatch match;
    ASSERT_TRUE(std::regex_search(told, match, std::regex("hint: (color = \\([^)]*\\);)")));
    write("cured.ray", replaced(kFirst, "color = (1, 1, 1);", match[1]));
    const Run cured = run({"cured.ray", "light.png", "-w", "80"});
    EXPECT_FALSE(contains(cured.err, "darker than"));
    EXPECT_GT(meanLevel("light.png"), 50);
    EXPECT_LT(meanLevel("light.png"), 140);
  }
}

TEST_F(Silence, ASceneWithoutLightIsToldALight) {
  const std::string dark =
      replaced(kFirst, "point_light { position = (-6, 9, 6); color = (1, 1, 1); radius = 1; }", "");
  write("dark.ray", dark);
  const Run r = run({"dark.ray", "dark.png", "-w", "40"});
  std::smatch match;
  ASSERT_TRUE(std::regex_search(r.err, match, std::regex("hint: (point_light \\{[^}]*constant[^}]*\\})")))
      << r.err;
  write("lit.ray", dark + std::string(match[1]) + "\n");
  EXPECT_FALSE(contains(run({"lit.ray", "lit.png", "-w", "40"}).err, "warning"));
  EXPECT_GT(meanLevel("lit.png"), 50);
}

TEST_F(Silence, AnEmitterThatIsNotSampledIsTold) {
  const std::string flame =
      replaced(kFirst, "point_light { position = (-6, 9, 6); color = (1, 1, 1); radius = 1; }",
               "translate(0, 2, 0, scale(0.02, 0.04, 0.02, menger { levels = 2; material = { emissive = (9, "
               "9, 9); } }))");
  write("flame.ray", flame);
  const std::string told = "emissive menger at random alone";
  EXPECT_TRUE(contains(run({"flame.ray", "flame.png", "-w", "40", "--integrator", "path"}).err, told));
  write("ball.ray", replaced(flame, "menger { levels = 2;", "sphere {"));
  EXPECT_FALSE(contains(run({"ball.ray", "ball.png", "-w", "40", "--integrator", "path"}).err, told));
}

TEST_F(Silence, ACameraThatLooksAwayIsToldWhereToLook) {
  const std::string away = replaced(kFirst, "look_at = (0, 0.8, 0)", "look_at = (0, 20, 14)");
  write("away.ray", away);
  const Run r = run({"away.ray", "away.png", "-w", "40"});
  std::smatch match;
  ASSERT_TRUE(std::regex_search(r.err, match, std::regex("hint: (look_at = \\([^)]*\\);)"))) << r.err;
  write("there.ray", replaced(away, "look_at = (0, 20, 14);", match[1]));
  EXPECT_FALSE(contains(run({"there.ray", "there.png", "-w", "40"}).err, "no object is in the picture"));
}

TEST_F(Silence, OneCauseIsToldOnceWithItsCure) {
  const auto warnings = [&](const std::string& text, const std::string& what, const std::string& hint) {
    write("one.ray", "Trace 1\n" + text);
    const std::string told = run({"one.ray", "one.png", "-w", "40", "--quality", "draft"}).err;
    EXPECT_TRUE(contains(told, what)) << told;
    EXPECT_TRUE(contains(told, hint)) << told;
    EXPECT_EQ(told.find("warning: "), told.rfind("warning: ")) << told;
    return told;
  };
  const std::string dark = warnings("background { color = (0, 0, 0) }\nsphere { }", "the scene has no light",
                                    "hint: point_light { position = ");
  EXPECT_FALSE(contains(dark, "ambient"));
  EXPECT_FALSE(contains(dark, "attenuation"));
  warnings(
      "camera { position = (0, 0, 0.2); look_at = (0, 0, -5) }\nsphere { }",
      "one.ray:3:1: warning: 100 % of the picture is darker than level 20 of 255, its mean level is 0; the "
      "camera is inside this sphere",
      "move the camera's position out of it");
  warnings("sphere { material = { diffuse = (255, 0, 0) } }",
           "diffuse of material: expected 0 to 1, found 255", "a colour goes from 0 to 1");
  warnings(
      "translate(1e30, 0, 0) { sphere { } }\nsphere { }\ncamera { position = (0, 2, 9); look_at = (0, 0, 0) "
      "}",
      "one.ray:2:25: warning: the sphere is 1e+30 away, more than 1e12 times its size", "place it nearer");
}

TEST_F(Silence, TheExposureIsToldWithThatOfTheScene) {
  write("bright.ray", "Trace 1\nsettings { exposure = 0.8 }\nsphere { }");
  const std::string told = run({"bright.ray", "bright.png", "-w", "40", "--quality", "draft"}).err;
  std::smatch match;
  ASSERT_TRUE(std::regex_search(told, match,
                                std::regex(R"(exposure (\S+) stops, with --exposure 0\.8 in all (\S+);)")))
      << told;
  EXPECT_NEAR(std::stod(match[1]) + 0.8, std::stod(match[2]), 1e-9);
}

TEST_F(Silence, WhatIsMeantToBeDarkIsNot) {
  write("small.ray", R"(SBT-raytracer 1.0
camera { position = (0, 0, 40); viewdir = (0, 0, -1); updir = (0, 1, 0); }
directional_light { direction = (0, 0, -1); color = (1, 1, 1); }
sphere { material = { diffuse = (1, 1, 1); } }
)");  // on black: less than 1 % of the picture
  const Run r = run({"small.ray", "-w", "100"});
  EXPECT_FALSE(contains(r.err, "darker")) << r.err;
  EXPECT_EQ(run({"lint", "small.ray"}).code, 0);
}

TEST_F(Silence, GlassWithoutACausticIsToldWithAnIntegratorThatFindsIt) {
  write("glass.ray", R"(SBT-raytracer 1.1
camera { position = (0, 1.5, 6); look_at = (0, 0.9, 0); fov = 30; aspectratio = 1.5; }
directional_light { direction = (-3, -5, -4); color = (1,1,1); size = 2; }
background { gradient = ((0.1,0.1,0.1), (0.6,0.6,0.6), (0.3,0.5,0.9)); }
settings { integrator = path; spp = 16; transfer = srgb; width = 60; }
rotate(1,0,0,-1.5708, scale(12, square { material = { library = oak; } }))
translate(0,1,0, sphere { material = { library = glass; } })
)");
  const Run r = run({"glass.ray", "path.png"});
  EXPECT_TRUE(contains(r.err, "glass.ray:3:1: warning: sphere (glass.ray:7) has no caustics"));
  EXPECT_TRUE(contains(r.err, "paths cannot hit a light of this kind"));
  EXPECT_TRUE(contains(r.err, "hint: --integrator bdpt or photon"));
  EXPECT_FALSE(contains(r.err, "visible = true")) << "which this light refuses";
  const Run lint = run({"lint", "glass.ray"});
  EXPECT_TRUE(contains(lint.out, "[caustics-missing]"));
  EXPECT_FALSE(contains(lint.out, "visible = true"));
  // The hint works: beside the ball, away from the light, there is a shadow, and nothing is told.
  const Run found = run({"glass.ray", "bdpt.png", "--integrator", "bdpt"});
  EXPECT_FALSE(contains(found.err, "warning")) << found.err;
  const auto shadowOf = [&](const std::string& name) {
    const Picture picture = readPicture(path(name));
    double sum = 0;
    for (int x = 12; x < 22; ++x) sum += picture.at(x, 29).g;
    return sum / 10;
  };
  EXPECT_LT(shadowOf("bdpt.png"), 0.95 * shadowOf("path.png"));
}

// --- first aid: app/advice/first_aid.h ---------------------------------------------------------------

TEST_F(Silence, APictureThatIsBrighterThanWhiteIsToldWithAnExposureThatHelps) {
  write("white.ray", replaced(kFirst, "color = (1, 1, 1)", "color = (4e4, 4e4, 4e4)"));
  const Run white = run({"white.ray", "white.png", "-w", "80"});
  EXPECT_EQ(white.code, 0);
  EXPECT_GT(meanLevel("white.png"), 120);
  std::smatch cure;
  ASSERT_TRUE(
      std::regex_search(white.err, cure, std::regex(R"(is brighter than white[^]*--exposure (\S+) )")))
      << white.err;
  const Run cured = run({"white.ray", "cured.png", "-w", "80", "--exposure", cure[1]});
  EXPECT_FALSE(contains(cured.err, "warning")) << cured.err;
  EXPECT_LT(meanLevel("cured.png"), 110);
  EXPECT_GT(meanLevel("cured.png"), 30);
}

TEST_F(Silence, ALightBackgroundOfWhiteIsNotTold) {
  write("white.ray", replaced(replaced(kFirst, "color = (1, 1, 1)", "color = (140, 140, 140)"), "point_light",
                              "background { color = (1, 1, 1); }\npoint_light"));
  EXPECT_FALSE(contains(run({"white.ray", "white.png", "-w", "80"}).err, "brighter than white"));
}

TEST_F(Silence, APictureOfOneColourIsToldWithWhereToLook) {
  write("grey.ray",
        "SBT-raytracer 1.0\nbackground { color = (0.5, 0.5, 0.5); }\n"
        "camera { position = (0, 0, 5); viewdir = (0, 0, 1); updir = (0, 1, 0); }\n"
        "ambient_light { color = (1, 1, 1); }\nsphere { material = { ambient = (1, 0, 0); } }\n");
  const Run away = run({"grey.ray", "grey.png", "-w", "40"});
  EXPECT_TRUE(contains(away.err, "no object is in the picture")) << away.err;
  EXPECT_TRUE(contains(away.err, "look_at = (0, 0, 0)")) << away.err;
  write("grey.ray",
        "SBT-raytracer 1.0\nbackground { color = (0.5, 0.5, 0.5); }\n"
        "camera { position = (0, 0, 5); look_at = (0, 0, 0); updir = (0, 1, 0); }\n"
        "ambient_light { color = (1, 1, 1); }\nsphere { material = { ambient = (1, 0, 0); } }\n");
  EXPECT_FALSE(contains(run({"grey.ray", "grey.png", "-w", "40"}).err, "warning"));
}

TEST_F(Silence, ANoisyPictureIsToldWithTheSamplesThatHalveItsError) {
  write("noisy.ray", kNoisy);
  const auto errorWith = [&](const std::string& spp) {
    const Run r = run({"noisy.ray", "noisy.png", "-w", "48", "--integrator", "path", "--spp", spp});
    std::smatch told;
    const bool found = std::regex_search(
        r.err, told, std::regex(R"(estimated error is (\d+) levels of 255, which --spp (\d+) halves)"));
    return found ? std::pair(std::stoi(told[1]), std::stoi(told[2])) : std::pair(0, 0);
  };
  const auto [few, more] = errorWith("4");
  ASSERT_EQ(more, 16);
  const auto [half, most] = errorWith("16");
  EXPECT_GE(2 * half, few - 2);
  EXPECT_LE(2 * half, 1.4 * few);
  EXPECT_EQ(errorWith("1024").first, 0);
  const auto denoisedWith = [&](const char* spp) {
    return run({"noisy.ray", "noisy.png", "-w", "48", "--integrator", "path", "--spp", spp, "--denoise"}).err;
  };
  EXPECT_TRUE(contains(denoisedWith("8"), "noisy: before denoising"));
  EXPECT_FALSE(contains(denoisedWith("256"), "noisy:"));
}

TEST_F(Silence, AMissedNoiseTargetIsToldWithTheSamplesThatReachIt) {
  write("noisy.ray", kNoisy);
  const auto lastLine = [&](const std::string& spp, const char* denoise) {
    return run({"noisy.ray", "noisy.png", "-w", "48", "--integrator", "path", "--noise-target", "0.02",
                "--spp", spp, denoise})
        .err;
  };
  for (const char* denoise : {"--denoise", "--no-denoise"}) {
    const std::string missed = lastLine("32", denoise);
    std::smatch cure;
    ASSERT_TRUE(std::regex_search(
        missed, cure,
        std::regex(R"(% of the pixels miss the noise target of 5\.1 levels; --spp (\d+) brings)")))
        << missed;
    EXPECT_EQ(contains(missed, "before denoising"), denoise == std::string("--denoise"));
    EXPECT_FALSE(contains(lastLine(cure[1], denoise), "miss the noise target"));
  }
}

TEST_F(Silence, ANoiseTargetThatBdptMissesIsTold) {
  write("noisy.ray", kNoisy);
  const std::string told = run({"noisy.ray", "noisy.png", "-w", "48", "--integrator", "bdpt",
                                "--noise-target", "0.001", "--spp", "16"})
                               .err;
  EXPECT_TRUE(contains(told, "of the pixels miss the noise target of 0.26 levels")) << told;
}

TEST_F(Silence, TheFireflyLimitCountsTheLightOfTheRegion) {
  const auto taken = [&](const std::string& region) {
    const Run r =
        run({test::sourceFolder() + "/scenes/glass.ray", "glass.png", "-w", "64", "--height", "48", "--spp",
             "8", "--integrator", "path", "--firefly-limit", "0.3", "--region", region, "--resume=never"});
    std::smatch told;
    return std::regex_search(r.err, told, std::regex(R"(--firefly-limit took away (\S+) %)"))
               ? std::stod(told[1])
               : 0.0;
  };
  const double whole = taken("0,0,64,48");
  const std::vector<double> parts{taken("0,0,64,24"), taken("0,24,64,24")};
  EXPECT_GT(whole, 0);
  EXPECT_LE(*std::min_element(parts.begin(), parts.end()), whole);
  EXPECT_GE(*std::max_element(parts.begin(), parts.end()), whole);
  EXPECT_LT(parts[0] + parts[1], 3 * whole);
}

TEST_F(Silence, FirefliesAreToldWithTheLimitThatRemovesThem) {
  // A small emitter that is not sampled as a light.
  write(
      "specks.ray",
      "Trace 1\nplane { }\ncamera { position = (0, 3, 8); look_at = (0, 0.5, 0) }\n"
      "translate(0, 1, 0) { scale(0.3) { menger { levels = 1; material = { emissive = (90, 90, 90) } } } }");
  const auto errorsOf = [&](const char* limit) {
    return run({"specks.ray", "specks.png", "-w", "64", "--spp", "8", "--integrator", "path", "--quality",
                "none", "--auto-exposure", "--firefly-limit", limit})
        .err;
  };
  EXPECT_TRUE(contains(errorsOf("0"), "which --firefly-limit 8 removes"));
  EXPECT_FALSE(contains(errorsOf("8"), "fireflies"));
}

// The limit would take the caustic away.
TEST_F(Silence, FirefliesOfACausticAreToldAnIntegrator) {
  const std::string told = run({test::sourceFolder() + "/scenes/prism.ray", "prism.png", "-w", "64", "--spp",
                                "8", "--integrator", "path", "--firefly-limit", "0"})
                               .err;
  EXPECT_TRUE(contains(told, "fireflies")) << told;
  EXPECT_TRUE(contains(told, "--integrator bdpt finds it")) << told;
  EXPECT_FALSE(contains(told, "--firefly-limit 8")) << told;
}

}  // namespace
}  // namespace trace::test
