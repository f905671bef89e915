// What a render warns of: options and names that change nothing, integrators that do not suit the scene.
#include <gtest/gtest.h>

#include "app/session/session.h"
#include "image/codecs/codec.h"
#include "support/scene_files.h"

namespace trace::test {
namespace {

/// The warnings about the scene with the options, one a line.
std::string warnings(const std::string& text, const std::vector<Choice>& choices) {
  const Folder folder;
  const std::string file = folder / "scene.ray";
  writeFile(file, "SBT-raytracer 1.0\n" + text);
  Session session;
  session.open(file, choices);
  session.build();
  std::string all;
  for (const Message& message : session.messages().all())
    if (message.what.find("changes nothing") != std::string::npos ||
        message.what.find("finds no light") != std::string::npos ||
        message.what.find("no light: everything") != std::string::npos ||
        message.what.find("light nothing") != std::string::npos ||
        message.what.find("infinite fog") != std::string::npos ||
        message.what.find("is not photorealistic") != std::string::npos ||
        message.what.find("more light than it receives") != std::string::npos ||
        message.what.find("counts as 1667 kelvin") != std::string::npos ||
        message.what.find("past the scene") != std::string::npos ||
        message.what.find("nothing is in focus") != std::string::npos)
      all += message.what + "\n";
  return all;
}

constexpr const char* kLit = R"(
ambient_light { color = (0.2, 0.2, 0.2); }
point_light { position = (0, 5, 5); color = (1, 1, 1); }
sphere { material = { diffuse = (0.5, 0.5, 0.5); reflective = (0.5, 0.5, 0.5); } }
)";

TEST(RenderWarnings, DarknessIsToldForTheIntegratorChosen) {
  const std::string dark = "no light: everything will be black\n",
                    ball = "sphere { material = { diffuse = (1, 1, 1); } }";
  const auto by = [](const char* integrator) { return std::vector<Choice>{{"integrator", integrator, {}}}; };
  EXPECT_EQ(warnings(ball, {}), dark);
  EXPECT_EQ(warnings(ball, by("path")), "")
      << "the finished picture is black, and gets a warning with a cure";
  for (const char* unseen : {" ambient_light { color = 1; }", " background { color = (0, 0, 1); }"})
    EXPECT_NE(warnings(ball + unseen, by("path")).find("finds no light"), std::string::npos) << unseen;
  EXPECT_EQ(warnings(ball + " ambient_light { color = 1; }", {}), "");
  EXPECT_EQ(warnings("sphere { material = { emissive = (0, 1, 0); } }", {}), "");
  const Folder folder;
  writePicture(folder / "sky.png", Picture(2, 1));
  const std::string sky = "settings { environment = \"" + folder / "sky.png" + "\"; }";
  for (const char* integrator : {"whitted", "path", "direct", "bdpt", "mlt"})
    EXPECT_EQ(warnings(sky + ball, by(integrator)), "") << integrator;
}

TEST(RenderWarnings, WhatChainsThatChangePathsLeaveOutIsTold) {
  const auto told = [](std::vector<Choice> choices) {
    choices.push_back({"integrator", "mlt", {}});
    return warnings(kLit, choices);
  };
  const Choice veach{"chains", "veach", {}};
  EXPECT_EQ(told({veach}), "");
  EXPECT_EQ(told({veach, {"mutations", "lens", {}}}), "");
  EXPECT_EQ(told({{"mutations", "lens", {}}}),
            "--mutations changes nothing: the chains change random numbers\n");
  EXPECT_EQ(told({veach, {"firefly-limit", "3", {}}}),
            "--firefly-limit changes nothing: chains of --chains veach stay longer at a brighter path\n");
}

TEST(RenderWarnings, FogWithoutEndUnderASunIsTold) {
  const std::string sunny =
      "directional_light { direction = (0, -1, -1); color = 1; } translate(0, 0, -9, sphere { })";
  const auto by = [&](const std::string& text, const char* integrator, const char* depth) {
    return warnings(text, {{"fog", "0.02", {}}, {"integrator", integrator, {}}, {"medium-depth", depth, {}}});
  };
  for (const char* integrator : {"path", "bdpt"})
    EXPECT_NE(by(sunny, integrator, "9").find("the sun lights infinite fog"), std::string::npos)
        << integrator;
  EXPECT_EQ(by(sunny, "whitted", "100"), "");
  EXPECT_EQ(by(sunny, "direct", "100"), "");
  EXPECT_EQ(by(sunny, "path", "1"), "");
  EXPECT_EQ(by("settings { fog-height = 2; } " + sunny, "path", "100"), "");
  EXPECT_EQ(by("scale(50, sphere { }) " + sunny, "path", "100"), "") << "nothing beyond is seen";
  const std::string room =  // whose window the camera does not see
      "polymesh { points = ((-9,-9,9), (9,-9,9), (9,9,9), (-9,9,9), (-9,-9,-12), (9,-9,-12), (9,9,-12), "
      "(-9,9,-12)); faces = ((0,1,5,4), (3,2,6,7), (0,3,7,4), (1,2,6,5), (4,5,6,7)); } ";
  EXPECT_NE(by(room + sunny, "path", "100"), "") << "light comes in behind the camera";
  EXPECT_EQ(by(kLit, "path", "100"), "");
}

TEST(RenderWarnings, DrawnMaterialsAreToldWhereLightBounces) {
  for (const char* model : {"gooch", "hatching", "cel"}) {
    const std::string drawn = std::string(kLit) + "sphere { material = { model = " + model + "; } }";
    EXPECT_EQ(warnings(drawn, {}), "") << model;
    EXPECT_NE(
        warnings(drawn, {{"integrator", "path", {}}}).find(std::string(model) + " is not photorealistic"),
        std::string::npos);
  }
}

TEST(RenderWarnings, MaterialsThatMakeLightAreToldWhereLightBounces) {
  const auto ball = [](const std::string& material) {
    return std::string(kLit) + "sphere { material = { diffuse = 0.6; " + material + " } }";
  };
  const std::vector<Choice> path{{"integrator", "path", {}}};
  EXPECT_NE(warnings(ball("transmissive = 1; index = 1.5;"), path).find("more light than it receives"),
            std::string::npos);
  EXPECT_NE(warnings(ball("reflective = 0.7;"), path).find("more light than it receives"), std::string::npos);
  EXPECT_EQ(warnings(ball("reflective = 0.7;"), {}), "");
  EXPECT_EQ(warnings(ball("reflective = 0.4;"), path), "");
}

TEST(RenderWarnings, OptionsOfASceneAreToldWithItsOwnIntegratorOnly) {
  const std::string caustics = std::string(kLit) + "settings { caustics = 1000; ";
  EXPECT_NE(warnings(caustics + "integrator = path; }", {}).find("it concerns whitted"), std::string::npos);
  EXPECT_EQ(warnings(caustics + "}", {{"integrator", "path", {}}}), "");
}

TEST(RenderWarnings, WhatAQualityChoosesIsNotToldAsAnOption) {
  EXPECT_EQ(warnings(kLit, {{"quality", "good", {}}, {"integrator", "whitted", {}}}), "");
  EXPECT_NE(
      warnings(kLit, {{"quality", "good", {}}, {"integrator", "whitted", {}}, {"firefly-limit", "3", {}}})
          .find("--firefly-limit changes nothing"),
      std::string::npos);
}

TEST(RenderWarnings, AreToldWithTheirReason) {
  const auto about = [](const std::string& text, const std::vector<Choice>& choices, const char* expected) {
    const std::string found = warnings(text, choices);
    EXPECT_NE(found.find(expected), std::string::npos) << expected << "\n" << found;
  };
  about(kLit, {{"caustics", "1000", {}}, {"integrator", "path", {}}},
        "--caustics changes nothing: it concerns whitted");
  about(kLit, {{"noise-target", "0.01", {}}}, "--spp gives 1");
  about("sphere { material = { emissive = (1, 1, 1); reflective = (1, 1, 1); } }", {{"caustics", "1000", {}}},
        "no light that sends photons");
  about(
      "point_light { position = (0, 5, 5); color = (1, 1, 1); }\nsphere { material = { diffuse = (1, 1, 1); "
      "specular = (0, 0, 0); reflective = (0, 0, 0); } }",
      {{"caustics", "1000", {}}}, "nothing in the scene mirrors");
  about("point_light { position = (0, 5, 5); color = (1, 1, 1); }\nsphere { }",
        {{"ambient-occlusion", "4", {}}}, "no ambient light");
  about(kLit, {{"caustic-texels", "256", {}}}, "--caustic-texels changes nothing");
  about("menger { material = { emissive = (1, 1, 1); }; }", {{"lamp-samples", "4", {}}},
        "--lamp-samples changes nothing");
  const std::string lamp = "sphere { material = { emissive = (1, 1, 1); } }";
  about(lamp + "box { material = { diffuse = (1, 1, 1); } }", {}, "they light nothing");
  about("ambient_light { color = (1, 1, 1); }\nsphere { }", {{"integrator", "path", {}}}, "finds no light");
  about(kLit, {{"smooth-terminator", "on", {}}}, "no mesh of the scene has normals");
  EXPECT_EQ(warnings(kLit, {{"integrator", "path", {}}, {"caustic-radius", "0.1", {}}}),
            "--caustic-radius changes nothing: it concerns whitted, photon, and --integrator is path\n")
      << "one reason is enough";
  about(kLit, {{"fog-color", "0.5", {}}}, "--fog-color changes nothing without --fog");
  about(kLit, {{"integrator", "photon", {}}, {"irradiance-rays", "99", {}}},
        "--irradiance-rays changes nothing without --irradiance-cache");
  about(kLit, {{"moments", "4", {}}}, "--moments changes nothing without --shutter");
  about(kLit, {{"subdivide-threshold", "0.2", {}}},
        "--subdivide-threshold changes nothing without --subdivide");
  about(kLit, {{"subdivide", "2", {}}, {"spp", "16", {}}}, "--spp changes nothing with --subdivide");
  about(kLit, {{"denoise", "on", {}}}, "--denoise changes nothing: it compares two halves");
  about(kLit, {{"denoise", "on", {}}, {"spp", "64", {}}, {"integrator", "mlt", {}}},
        "--denoise changes nothing");
  about(kLit, {{"light-choices", "2", {}}}, "fewer than two lights");
  about(kLit, {{"white-balance", "5", {}}}, "--white-balance 5 counts as 1667 kelvin");
  about(kLit, {{"switched-off", "spot_light,ward", {}}},
        "--without spot_light and ward changes nothing: the scene has none");
  about(kLit, {{"subsurface-samples", "3", {}}}, "--subsurface-samples changes nothing");
}

TEST(RenderWarnings, AreToldWhereTheyLeaveNothingToSee) {
  const auto expect = [](const std::vector<Choice>& choices, const char* expected) {
    EXPECT_NE(warnings(kLit, choices).find(expected), std::string::npos) << expected;
  };
  expect({{"stereo", "side-by-side", {}}, {"eye-separation", "1e6", {}}}, "looks past the scene");
  expect({{"aperture", "1e6", {}}}, "nothing is in focus");
}

TEST(RenderWarnings, AreNotToldWhereTheyDoSomething) {
  EXPECT_EQ(warnings(kLit, {}), "");
  const std::string lamp = "sphere { material = { emissive = (1, 1, 1); } }";
  EXPECT_EQ(warnings(lamp, {}), "");
  EXPECT_EQ(warnings(lamp + "box { material = { diffuse = (1, 1, 1); } }", {{"lamp-samples", "4", {}}}), "");
  EXPECT_EQ(warnings(kLit, {{"caustics", "1000", {}}, {"ambient-occlusion", "4", {}}, {"fog", "0.1", {}}}),
            "");
  const std::string mesh =
      "polymesh { points = ((0, 0, 0), (1, 0, 0), (0, 1, 0)); faces = ((0, 1, 2)); gennormals; }";
  EXPECT_EQ(
      warnings(kLit, {{"stereo", "side-by-side", {}}, {"eye-separation", "1", {}}, {"aperture", "1", {}}}),
      "");
  EXPECT_EQ(warnings(kLit + mesh, {{"smooth-terminator", "on", {}}}), "");
  EXPECT_EQ(warnings(kLit, {{"noise-target", "0.01", {}}, {"spp", "64", {}}, {"integrator", "path", {}}}),
            "");
  EXPECT_EQ(warnings(kLit, {{"white-balance", "3200", {}}, {"switched-off", "all", {}}}), "");
  EXPECT_EQ(warnings(std::string(kLit) + "sphere { material = { opacity = 0.5; } }",
                     {{"switched-off", "opacity", {}}}),
            "");
  EXPECT_EQ(warnings(kLit, {{"quality", "good", {}}, {"spp", "16", {}}}), "")
      << "nobody asked for a noise target";
}

TEST(RenderWarnings, LinksToWhatIsNotThereAreToldOncePerName) {
  const Folder folder;
  const std::string file = folder / "scene.ray";
  writeFile(file, R"(SBT-raytracer 1.0
point_light { name = "key"; position = (0, 5, 5); color = (1, 1, 1); lights = ("bal", "ball"); }
point_light { position = (0, 5, 5); color = (1, 1, 1); excludes = ("bal", "floor"); }
sphere { name = "ball"; lit_by = ("kex"); }
sphere { lit_by = ("kex", "key"); not_lit_by = ("rim"); }
)");
  Session session;
  session.open(file, {});
  session.build();
  std::vector<std::string> told;
  for (const Message& message : session.messages().all())
    told.push_back(std::to_string(message.place.line) + " " + message.what + "; " + message.hint);
  EXPECT_EQ(told, (std::vector<std::string>{
                      "2 lights names \"bal\", and no object is called so; did you mean \"ball\"?",
                      "3 excludes names \"floor\", and no object is called so; ",
                      "4 lit_by names \"kex\", and no light is called so; did you mean \"key\"?",
                      "5 not_lit_by names \"rim\", and no light is called so; "}));
}

}  // namespace
}  // namespace trace::test
