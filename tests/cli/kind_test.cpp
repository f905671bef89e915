// Scenes that leave things to Trace: files of the kind `Trace 1`, bare meshes, and --quality.
#include <gtest/gtest.h>

#include "app/advice/auto_exposure.h"
#include "app/session/session.h"
#include "formats/format.h"
#include "formats/kind_defaults.h"
#include "image/codecs/codec.h"
#include "image/development/development.h"
#include "image/srgb.h"
#include "program.h"
#include "scene/picture_size.h"
#include "scene/quality.h"
#include "shading/lights/light.h"
#include "shading/lights/point_light.h"
#include "support/paths.h"

namespace trace::test {
namespace {

Scene read(const std::string& text, Messages& messages) { return readScene("kind.ray", text, messages); }
Scene read(const std::string& text) {
  Messages messages;
  Scene scene = read(text, messages);
  EXPECT_TRUE(messages.all().empty()) << text << toString(messages.all().front());
  return scene;
}
std::string errorOf(const std::string& text) {
  Messages messages;
  try {
    readScene("kind.ray", text, messages);
    messages.throwIfFailed();
  } catch (const Error& error) {
    return toString(error.messages().front());
  }
  return "";
}
Affine placeOf(const std::string& text) { return read(text).objects.at(0).worldFromObject; }
double distance(const Affine& a, const Affine& b) {
  double most = 0;
  for (int i = 0; i < 3; ++i) most = std::max(most, maxComponent(abs(a.row[i] - b.row[i])));
  return most;
}
double meanLevel(const Picture& picture) {
  double sum = 0;
  for (const Color& c : picture.pixels) sum += luminanceOf(c);
  return 255 * sum / static_cast<double>(picture.pixels.size());
}

using Kind = ProgramTest;

TEST_F(Kind, RayAloneWithoutADisplayRendersAFirstScene) {
  const Variables noDisplay{{"DISPLAY", ""}, {"WAYLAND_DISPLAY", ""}};
  const auto first = run({}, noDisplay);
  EXPECT_EQ(first.code, 0) << first.err;
  EXPECT_TRUE(contains(first.err, "wrote scene.png (640x480)")) << first.err;
  EXPECT_TRUE(contains(first.err, "glass.png\n")) << "the lines of the help are lines";
  EXPECT_GT(meanLevel(readPicture(path("scene.png"))), 60);
  EXPECT_EQ(readFile(path("scene.ray")).substr(0, 7), "Trace 1");
  const auto again = run({}, noDisplay);
  EXPECT_EQ(again.code, 2) << "nothing is written over";
  EXPECT_TRUE(contains(again.err, "ray SCENE renders without a window")) << again.err;
}

TEST(KindErrors, HintsAreWhatCouldBeMeant) {
  const std::pair<const char*, const char*> rows[]{
      {"rotate (0, 1, 0) 30 { sphere { } }", "rotate y 30 { sphere { } }"},
      {"rotate (0, 1, 0) 30 { sphere { } }", "expected rotate(x, y, z, degrees, object)"},
      {"sphere { material = { texture = \"a.png\" } }", "diffuse = map(\"a.png\")"},
      {"settings { sun_elevation = 35 } sphere { }", "background { turbidity = 3;"},
      {"torus { radius = 0.6 }", "did you mean \"major_radius\" or \"minor_radius\"?"},
  };
  for (const auto& [text, expected] : rows)
    EXPECT_TRUE(contains(errorOf(std::string("Trace 1\n") + text), expected))
        << errorOf(std::string("Trace 1\n") + text);
  Messages messages;
  readScene("kind.ray", "Trace 1\nmaterial { diffuse = (1, 0, 0) }\nsphere { }", messages);
  ASSERT_EQ(messages.all().size(), 1u);
  EXPECT_TRUE(contains(messages.all()[0].hint, "material = { ... }")) << messages.all()[0].hint;
}

TEST(KindSettings, NoQualityUndoesTheQualityByDefault) {
  const Scene scene = read("Trace 1\nsphere { }\n");
  const std::vector<Choice> none{{"quality", "none", {}}};
  const Settings usual, settings = settingsFor(scene, {scene.choices, none});
  for (const char* option :
       {"spp", "noise-target", "denoise", "depth", "firefly-limit", "sampling", "integrator"})
    EXPECT_EQ(findOption(option).get(settings), findOption(option).get(usual)) << option;
  EXPECT_EQ(settings.width, 640);
}

TEST(KindSettings, WhatAQualityBringsInVainIsLeftOut) {
  const Scene scene = read("Trace 1\nsphere { }\n");
  const auto with = [&](const char* integrator) {
    const std::vector<Choice> given{{"integrator", integrator, {}}};
    return settingsFor(scene, {scene.choices, given});
  };
  EXPECT_EQ(with("whitted").fireflyLimit, 0);
  EXPECT_GT(with("path").fireflyLimit, 0);
  EXPECT_TRUE(with("bdpt").denoise);
  EXPECT_FALSE(with("mlt").denoise);
  EXPECT_EQ(with("mlt").noiseTarget, 0);
  Messages messages;
  const Scene empty = readScene("kind.ray", "Trace 1\n", messages);
  EXPECT_EQ(settingsFor(empty, {empty.choices}).spp, 1);
}

TEST_F(Kind, ABareObjectIsAPictureWorthLookingAt) {
  writeFile(path("ball.ray"), "Trace 1\nsphere { }\n");
  const auto result = run({"ball.ray", "ball.png", "-w", "32", "--spp", "16"});
  EXPECT_EQ(result.code, 0) << result.err;
  const Picture picture = readPicture(path("ball.png"));
  EXPECT_EQ(picture.width, 32);
  EXPECT_EQ(picture.height, 24);
  EXPECT_GT(meanLevel(picture), 60);
  EXPECT_LT(meanLevel(picture), 180);
  double darkest = 255, brightest = 0;
  for (const Color& c : picture.pixels) {
    darkest = std::min(darkest, 255 * luminanceOf(c));
    brightest = std::max(brightest, 255 * luminanceOf(c));
  }
  EXPECT_GT(brightest - darkest, 60) << "the ball is told from its background";
  for (const char* said : {"Trace chose", "a camera that shows all objects", "a sky and a sun", "exposure",
                           "quality good: path"})
    EXPECT_NE(result.err.find(said), std::string::npos) << said << " in " << result.err;
  const std::string lint = run({"lint", "ball.ray"}).err, info = run({"info", "ball.ray"}).out;
  EXPECT_NE(lint.find("a sky and a sun"), std::string::npos) << lint;
  EXPECT_NE(info.find("a sky and a sun"), std::string::npos) << info;
}

TEST_F(Kind, ABareMeshIsAPictureWorthLookingAt) {
  for (const char* mesh : {"rabbit.ply", "knot.obj", "ring.off"}) {
    const auto result =
        run({test::sourceFolder() + "/scenes/meshes/" + mesh, "m.png", "-w", "32", "--spp", "16"});
    EXPECT_EQ(result.code, 0) << result.err;
    const Picture picture = readPicture(path("m.png"));
    EXPECT_GT(meanLevel(picture), 60) << mesh;
    EXPECT_LT(meanLevel(picture), 180) << mesh;
    EXPECT_NE(result.err.find("a light and a grey room around"), std::string::npos) << result.err;
  }
}

TEST(AutomaticExposure, MakesUpForFaintAndForStrongLight) {
  const auto stops = [](const std::string& color) {
    Scene scene = read(
        "Trace 1\nsettings { width = 24; spp = 1 }\nsphere { }\n"
        "directional_light { direction = (0.2, -1, -1); color = " +
        color + " }\n");
    const Settings settings = settingsFor(scene, {scene.choices});
    EXPECT_TRUE(settings.autoExposure);
    Session session;
    session.open(std::move(scene), settings);
    session.build();
    EXPECT_FALSE(session.settings().autoExposure);
    EXPECT_EQ(session.settings().exposure, session.measuredExposure());
    return session.measuredExposure();
  };
  const Real one = stops("(1, 1, 1)");
  EXPECT_NEAR(stops("(0.0009765625, 0.0009765625, 0.0009765625)"), one + 10, 0.011);
  EXPECT_NEAR(stops("(1024, 1024, 1024)"), one - 10, 0.011);
}

TEST(AutomaticExposure, IsThatOfTheSceneWhoeverTracesItsIndirectLight) {
  const auto stops = [](const std::string& integrator) {
    Scene scene = read(
        "Trace 1\nsettings { width = 24; spp = 1 }\ncamera { position = (0, 1.6, 6); look_at = (0, 0.9, 0) "
        "}\n"
        "plane { }\ntranslate(0, 2, 0, scale(0.5, box { material = { emissive = (20, 18, 15) } }))\n"
        "translate(0, 1.6, 0, scale(1, 0.1, 1, box { }))\n");
    const std::vector<Choice> chosen{{"integrator", integrator, {}}};
    const Settings settings = settingsFor(scene, {scene.choices, chosen});
    Session session;
    session.open(std::move(scene), settings);
    session.build();
    return session.measuredExposure();
  };
  const Real path = stops("path");
  EXPECT_NE(path, 0);
  for (const char* integrator : {"bdpt", "photon", "mlt"}) EXPECT_EQ(stops(integrator), path) << integrator;
}

TEST(AutomaticExposure, BringsTheMeanToTheMiddleAndKeepsBrightParts) {
  Development development;
  development.transfer = Transfer::srgb;
  development.tone = Tone::filmic;
  const auto shown = [&](const Color& color, Real stops) {
    Development with = development;
    with.exposure = stops;
    return luminanceOf(developed(color, with));
  };
  Picture picture(20, 10);
  for (Color& c : picture.pixels) c = Color(0.01);
  EXPECT_NEAR(shown(Color(0.01), exposureFor(picture, development)), 0.52, 0.01);
  const Color red{0.8, 0.08, 0.08};
  for (int x = 0; x < 20; ++x) picture.at(x, 4) = red;  // a tenth
  const Real stops = exposureFor(picture, development);
  EXPECT_NEAR(shown(red, stops), 0.85, 0.02);
  EXPECT_LT(shown(Color(0.01), stops), 0.5);
  for (int x = 0; x < 20; ++x) picture.at(x, 4) = Color(40);  // a lamp that is seen makes nothing else black
  EXPECT_NEAR(shown(Color(0.3), exposureFor(picture, development)), 0.85, 0.02);
  for (Color& c : picture.pixels) c = Color(0);
  EXPECT_EQ(exposureFor(picture, development), 0);
  picture.at(3, 3) = Color(0.1);  // on black, what is seen counts
  EXPECT_NEAR(shown(Color(0.1), exposureFor(picture, development)), 0.52, 0.01);
}

TEST(KindDefaults, LeaveFilesOfTheCoursesAsTheyAre) {
  Messages messages;
  const Scene scene =
      readScene("old.ray",
                "SBT-raytracer 1.0\npoint_light { position = (0, 3, 4); color = (1, 1, 1); }\n"
                "sphere { }\nplane { }\n",
                messages);
  EXPECT_TRUE(scene.kindDefaults.empty());
  EXPECT_TRUE(scene.choices.empty());
  EXPECT_EQ(scene.camera, Camera{});
  EXPECT_EQ(scene.lights.at(0).light.as<PointLight>()->color, Color(1));
  EXPECT_EQ(scene.materials.at(0), Material{});
  EXPECT_EQ(scene.objects.at(1).worldFromObject, Affine{});
}

TEST_F(Kind, ConvertedToTheCoursesFormatItIsTheSamePicture) {
  writeFile(path("kind.ray"),
            "Trace 1\nplane { material = { library = oak } }\n"
            "translate(0, 1, 0) { rotate x -90 { cylinder { material = { library = gold } } } }\n");
  EXPECT_EQ(run({"convert", "kind.ray", "plain.ray"}).code, 0);
  EXPECT_TRUE(readFile(path("plain.ray")).starts_with("SBT-raytracer"));
  for (const std::string name : {"kind", "plain"})
    EXPECT_EQ(run({name + ".ray", name + ".exr", "-w", "24", "--quality", "draft"}).code, 0);
  EXPECT_EQ(readPicture(path("kind.exr")), readPicture(path("plain.exr")));
}

TEST(KindDefaults, AnglesAreInDegrees) {
  const std::string old = "SBT-raytracer 1.1\n", kind = "Trace 1\n";
  const Affine turned = placeOf(old + "rotate y 30 deg { box { } }");
  EXPECT_EQ(placeOf(kind + "rotate y 30 deg { box { } }"), turned);
  EXPECT_EQ(placeOf(kind + "rotate y 30 { box { } }"), turned);
  EXPECT_EQ(placeOf(kind + "rotate(0, 1, 0, 30, box { })"), turned);
  EXPECT_LT(
      distance(placeOf(kind + "rotate y (0.5 rad) { box { } }"), placeOf(old + "rotate y 0.5 { box { } }")),
      1e-15);
  EXPECT_LT(distance(placeOf(kind + "rotate y atan2(1, 1) { box { } }"),
                     placeOf(old + "rotate y atan2(1, 1) { box { } }")),
            1e-15);
  EXPECT_EQ(placeOf(kind + "scale(sin(30)) { box { } }"), placeOf(old + "scale(sin(30 deg)) { box { } }"));
  EXPECT_EQ(placeOf(kind + "scale(cos(tau)) { box { } }"), Affine{});
  EXPECT_EQ(read(kind + "camera { fov = 40 deg; }\nbox { }").camera.fov, 40);
}

TEST(KindDefaults, AGroundIsLevel) {
  const Affine place = placeOf("Trace 1\nplane { }\nsphere { }");
  EXPECT_EQ(linear(place, {0, 0, 1}), (Vec3{0, 1, 0}));
}

TEST(KindDefaults, WordsOfPovRayAreTranslated) {
  EXPECT_TRUE(contains(errorOf("Trace 1\nlight_source { }"), "point_light {"));
  EXPECT_TRUE(contains(errorOf("Trace 1\ncube { }"), "box { }"));
  EXPECT_TRUE(contains(errorOf("Trace 1\nsphere { center = (0, 1, 0); }"), "translate("));
  EXPECT_TRUE(contains(errorOf("Trace 1\nplane { normal = (0, 1, 0); }"), "rotate x -90 deg"));
  EXPECT_TRUE(contains(errorOf("Trace 1\nsphere { material = gold }"), "library = gold"));
  EXPECT_TRUE(contains(errorOf("Trace 1\nsphere { pigment = red; }"), "diffuse ="));
  EXPECT_TRUE(contains(errorOf("Trace 1\nsphere { material = { diffuse = White; } }"), "(1, 1, 1) is white"));
}

TEST(KindDefaults, UnknownWordsAreErrors) {
  const std::string field = errorOf("Trace 1\nsphere { radios = 3 }");
  EXPECT_NE(field.find("kind.ray:2:10: error: sphere has no field \"radios\""), std::string::npos) << field;
  const std::string word = errorOf("Trace 1\nspheer { }");
  EXPECT_NE(word.find("did you mean \"sphere\""), std::string::npos) << word;
  EXPECT_NE(errorOf("Trace 2\nsphere { }").find("expected 1 after Trace"), std::string::npos);
  EXPECT_NE(errorOf("Trace\r\nsphere { }").find("expected 1 after Trace"), std::string::npos);
  EXPECT_EQ(errorOf("SBT-raytracer 1.0\nsphere { radios = 3; }"), "");
}

TEST(KindDefaults, ALightReachesWhatTheCameraLooksAt) {
  const std::string camera = "Trace 1\ncamera { position = (0, 0, 9); look_at = (0, 1, 0) }\nsphere { }\n";
  const auto light = [&](const std::string& text) {
    return *read(camera + text).lights.at(0).light.as<PointLight>();
  };
  EXPECT_EQ(light("point_light { position = (3, 5, 0) }").color, Color(25)) << "white at the distance 5";
  EXPECT_EQ(light("point_light { position = (3, 5, 0); color = (2, 1, 0) }").color, (Color{50, 25, 0}));
  EXPECT_EQ(light("point_light { position = (3, 5, 0); quadratic_attenuation_coeff = 0; "
                  "constant_attenuation_coeff = 1 }")
                .color,
            Color(1));
  EXPECT_NEAR(light("point_light { position = (3, 5, 0); power = 40 }").color.r, 40 / (4 * kPi * kPi), 1e-12);
  EXPECT_NE(errorOf(camera + "point_light { position = (3, 5, 0); power = -1 }").find("watts"),
            std::string::npos);
  EXPECT_NE(errorOf("SBT-raytracer 1.0\npoint_light { position = (3, 5, 0); }").find("expected a color"),
            std::string::npos);
}

TEST(KindDefaults, TheCameraFollowsWhatIsSaidOfIt) {
  const std::string objects = "translate(10, 0, 0) { sphere { } }\n";
  const Camera whole = read("Trace 1\n" + objects).camera;
  EXPECT_GT(dot(whole.viewdir, Vec3{10, 0, 0} - whole.position), 0);
  const Camera placed = read("Trace 1\ncamera { position = (10, 0, 9) }\n" + objects).camera;
  EXPECT_EQ(placed.viewdir, (Vec3{0, 0, -1})) << "looks at the middle of the objects";
  const Camera told =
      read("Trace 1\ncamera { position = (1, 2, 3); look_at = (1, 2, 0) }\n" + objects).camera;
  EXPECT_EQ(told.position, (Vec3{1, 2, 3}));
  EXPECT_EQ(told.viewdir, (Vec3{0, 0, -1}));
  // A floor that goes on far beyond what stands on it does not count.
  const std::string floor = "scale(100, 0.01, 100) { box { } }\n";
  const Box3 seen = boundsOfInterest(read("Trace 1\n" + objects + floor));
  EXPECT_LT(length(seen.size()), 5);
  const std::string plane = "plane { }\n";
  EXPECT_LT(length(boundsOfInterest(read("Trace 1\n" + objects + plane)).size()), 5);
}

TEST(KindDefaults, ThePictureIsOf4To3UnlessItsSidesAreGiven) {
  const std::string camera = "camera { position = (0, 0, 9); look_at = (0, 0, 0); fov = 40 }\nsphere { }\n";
  const auto aspect = [](const std::string& text) { return read(text).camera.aspectratio; };
  EXPECT_EQ(aspect("Trace 1\n" + camera), kUsualAspect);
  EXPECT_EQ(aspect("Trace 1\nsphere { }"), kUsualAspect);
  EXPECT_EQ(aspect("Trace 1\ncamera { aspectratio = 2 }\nsphere { }"), 2);
  EXPECT_EQ(aspect("SBT-raytracer 1.0\n" + camera), 1) << "files of the courses keep their meaning";
  EXPECT_EQ(aspect("Trace 1\nsettings { width = 300; height = 200 }\n" + camera), 1.5);
  const auto fitted = [](const Scene& scene, int width, int height) {
    Settings settings;
    settings.width = width;
    settings.height = height;
    return cameraFor(scene, settings);
  };
  const Scene free = read("Trace 1\n" + camera);
  EXPECT_EQ(fitted(free, 100, 0), free.camera);
  EXPECT_EQ(fitted(free, 100, 100).aspectratio, 1);
  EXPECT_EQ(fitted(free, 100, 100).fov, 40);
  EXPECT_EQ(fitted(read("Trace 1\ncamera { aspectratio = 2 }\nsphere { }"), 100, 100).aspectratio, 2);
  const Scene all = read("Trace 1\nsphere { }");
  EXPECT_EQ(fitted(all, 200, 100).fov, all.camera.fov);
  EXPECT_GT(fitted(all, 100, 100).fov, all.camera.fov) << "it still shows all objects";
  const Scene across = read(
      "Trace 1\ncamera { position = (0, 0, 9); look_at = (0, 0, 0); horizontal_fov = 60 }\n"
      "sphere { }");
  EXPECT_NEAR(fitted(across, 100, 100).fov, 60, 1e-9) << "the angle across stays";
}

TEST_F(Kind, ABallIsRoundInAPictureOfAnyShape) {
  writeFile(path("ball.ray"),
            "Trace 1\ncamera { position = (0, 0, 5); look_at = (0, 0, 0); fov = 40 }\n"
            "background { color = (0, 0, 0) }\nsphere { material = { emissive = (1, 1, 1) } }\n");
  const auto picture = [&](std::vector<std::string> flags) {
    flags.insert(flags.begin(),
                 {"ball.ray", "ball.png", "--quality", "none", "--integrator", "whitted", "-w", "40"});
    EXPECT_EQ(run(flags).code, 0);
    return readPicture(path("ball.png"));
  };
  EXPECT_EQ(picture({}).height, 30);
  const Picture tall = picture({"--height", "60"});
  int across = 0, down = 0;
  for (int x = 0; x < 40; ++x) across += luminanceOf(tall.at(x, 30)) > 0;
  for (int y = 0; y < 60; ++y) down += luminanceOf(tall.at(20, y)) > 0;
  EXPECT_GT(across, 10);
  EXPECT_NEAR(across, down, 2);
}

TEST_F(Kind, HelpListsItsDefaultsAndLintSaysForWhichQualityItLooks) {
  std::string help;
  for (const char c : run({"help", "render"}).out)
    if (c != '\n' && (c != ' ' || !help.ends_with(' '))) help += c;
  EXPECT_TRUE(contains(help, "default 400; 640 in Trace 1 scenes"));
  EXPECT_TRUE(contains(help, "default 1; 64 in Trace 1 scenes"));
  EXPECT_EQ(kindDefaultOf("quality"), "good");
  EXPECT_EQ(kindDefaultOf("depth"), "8");
  EXPECT_EQ(kindDefaultOf("seed"), "");
  for (const Option& option : options()) {
    const Scene scene = read("Trace 1\nsphere { }\n");
    const std::string value = option.get(settingsFor(scene, {scene.choices}));
    const std::string_view ofKind = kindDefaultOf(option.name);
    EXPECT_EQ(ofKind.empty() ? option.get(Settings{}) : std::string(ofKind), value) << option.name;
  }
  writeFile(path("ball.ray"), "Trace 1\nsphere { }\n");
  const std::string said = "checked for this quality, and with --quality draft for a draft";
  EXPECT_TRUE(contains(run({"lint", "ball.ray"}).err, said));
  EXPECT_FALSE(contains(run({"lint", "ball.ray", "--quality", "draft"}).err, said));
  const auto explained = run({"explain", "ball.ray", "--pixel", "0,0", "--sample", "all"});
  EXPECT_EQ(explained.code, 2);
  EXPECT_TRUE(contains(explained.err, "--sample 0 is the first"));
}

TEST(KindDefaults, MessagesSayWhatANewcomerCanDo) {
  const std::string field = errorOf("Trace 1\nsphere { material = { roughness = 0.2 } }");
  EXPECT_TRUE(contains(field, "material has no field \"roughness\"")) << field;
  EXPECT_TRUE(contains(field, "material = { model = ")) << field;
  EXPECT_FALSE(contains(field, "Phong")) << field;
  EXPECT_TRUE(contains(errorOf("Trace 1\nlet a = 1\nif (a = 1) { sphere { } }"), "== compares two values"));
  EXPECT_TRUE(contains(errorOf("Trace 1\nif (1 = 1) { sphere { } }"), "== compares two values"));
  const auto warning = [](const std::string& text) {
    Messages messages;
    read("Trace 1\nsphere { }\n" + text, messages);
    return messages.all().empty() ? std::string() : toString(messages.all().front());
  };
  for (const char* text :
       {"point_light { position = (0, 5, 0); color = (255, 0, 0) }", "background { color = (255, 0, 0) }",
        "sphere { material = { diffuse = (255, 0, 0) } }"})
    EXPECT_TRUE(contains(warning(text), "#ff0000, or srgb(255/255, 0/255, 0/255)")) << text << warning(text);
  EXPECT_EQ(warning("point_light { position = (0, 5, 0); color = (200, 200, 200) }"), "") << "a strong light";
  EXPECT_EQ(warning("point_light { position = (0, 5, 0); color = (20, 18, 15) }"), "");
  EXPECT_EQ(warning("background { color = (1, 0, 0) }"), "");
}

TEST(KindDefaults, LeaveLightThatIsThereAlone) {
  for (const char* light :
       {"background { color = (0, 0, 0) }", "directional_light { direction = (0, -1, 0) }",
        "sphere { material = { emissive = (1, 1, 1) } }"}) {
    const Scene scene = read(std::string("Trace 1\nbox { }\n") + light);
    EXPECT_TRUE(scene.background.gradient.empty()) << light;
    EXPECT_LE(scene.lights.size(), 1u) << light;
  }
  EXPECT_EQ(read("Trace 1\nbox { }").background.gradient.size(), 8u);
}

TEST(KindDefaults, StandBelowTheFileAndTheCommandLine) {
  const Scene scene = read("Trace 1\nsettings { transfer = linear; quality = draft }\nsphere { }");
  const std::vector<Choice> line{{"tone", "clamp", {}}};
  const Settings settings = settingsFor(scene, {scene.choices, line});
  EXPECT_EQ(settings.transfer, Transfer::linear);
  EXPECT_EQ(settings.quality, Quality::draft);
  EXPECT_EQ(settings.tone, Tone::clamp);
  EXPECT_EQ(settings.fresnel, Fresnel::exact);
  EXPECT_EQ(settings.spp, 16);
}

const std::string kGlass =
    "translate(2, 0, 0) { sphere { material = { transmissive = (1, 1, 1); index = 1.5 } } }\n";

TEST(KindDefaults, TheDefaultSkyIsPalestAtTheHorizon) {
  const Background sky = read("Trace 1\nsphere { }").background;
  const auto light = [&](Real elevation) { return luminanceOf(sky.gradientAt(elevation)); };
  const auto blueness = [&](Real elevation) {
    return sky.gradientAt(elevation).b / sky.gradientAt(elevation).r;
  };
  const std::vector<Real> heights{1, 5, 10, 20, 40, 90};
  for (std::size_t i = 1; i < heights.size(); ++i) {
    EXPECT_LT(light(heights[i]), light(heights[i - 1])) << heights[i];
    EXPECT_GT(blueness(heights[i]), blueness(heights[i - 1])) << heights[i];
  }
  for (const Real below : {-1.0, -20.0, -90.0}) EXPECT_LT(light(below), light(20)) << below;
}

TEST(QualityOption, PicksTheIntegratorThatTheSceneNeeds) {
  const auto integrator = [](const std::string& text, const std::string& quality,
                             std::vector<Choice> line = {}) {
    const Scene scene = read("Trace 1\nsphere { }\n" + text);
    line.insert(line.begin(), {"quality", quality, {}});
    return settingsFor(scene, {scene.choices, line}).integrator;
  };
  const std::string lamp = "point_light { position = (0, 5, 5) }\n";
  EXPECT_EQ(integrator(lamp, "good"), IntegratorKind::path);
  EXPECT_EQ(integrator(kGlass, "final"), IntegratorKind::bdpt) << "the sun shines through the glass";
  EXPECT_EQ(integrator("background { gradient = ((1, 1, 1)) }\n" + kGlass, "final"), IntegratorKind::path)
      << "a sky is met by paths";
  EXPECT_EQ(integrator(lamp + kGlass, "final"), IntegratorKind::bdpt);
  EXPECT_EQ(integrator(lamp + "union { sphere { } " + kGlass + " }", "final"), IntegratorKind::bdpt)
      << "glass within a solid";
  EXPECT_EQ(integrator(lamp + kGlass, "good"), IntegratorKind::path);
  EXPECT_EQ(integrator("square { material = { emissive = (6, 6, 6) } }\n" + kGlass, "final"),
            IntegratorKind::path)
      << "an emitter is hit by paths, also through glass";
  EXPECT_EQ(integrator(lamp + kGlass, "final", {{"integrator", "photon", {}}}), IntegratorKind::photon);
}

TEST(QualityOption, OverridesWhatTheSceneSaysOfSamplesAndIsOverridden) {
  const Scene scene = read("Trace 1\nsettings { spp = 9; denoise = off }\nsphere { }");
  const std::vector<Choice> draft{{"quality", "draft", {}}},
      more{{"spp", "25", {}}, {"quality", "draft", {}}};
  EXPECT_EQ(settingsFor(scene, {scene.choices}).spp, 9);
  EXPECT_EQ(settingsFor(scene, {scene.choices, draft}).spp, 16);
  EXPECT_EQ(settingsFor(scene, {scene.choices, more}).spp, 25);
  EXPECT_EQ(chooserOf(findOption("spp"), {scene.choices, draft}), "command line, by quality");
}

TEST_F(Kind, QualityServesTheScenesOfTheCoursesToo) {
  writeFile(path("old.ray"),
            "SBT-raytracer 1.0\ncamera { position = (0, 0, 5); viewdir = (0, 0, -1); updir = (0, 1, 0); }\n"
            "point_light { position = (2, 2, 5); color = (20, 20, 20); }\n"
            "sphere { material = { diffuse = (1, 0, 0); }; }\n");
  const auto plain = run({"old.ray", "a.png", "-w", "24"}),
             draft = run({"old.ray", "b.png", "-w", "24", "--quality", "draft"});
  EXPECT_EQ(plain.err.find("quality"), std::string::npos) << plain.err;
  EXPECT_NE(draft.err.find("quality draft: path, 16 samples a pixel, denoised"), std::string::npos)
      << draft.err;
  EXPECT_NE(run({"old.ray", "c.png", "--quality", "best"}).err.find("none | draft | good | final"),
            std::string::npos);
}

TEST(KindErrors, WordsOfOtherLanguagesHaveHints) {
  const std::pair<const char*, const char*> rows[]{
      {"rotate 30 { box { } }", "rotate takes an axis and degrees"},
      {"if (1 == 2) { } elif (1 == 1) { }", "else if (condition)"},
      {"let a = foo(3)\ntranslate(a, 0, 0) { sphere { } }", "let foo(a) = 2 * a makes one"},
      {"let a = sine(3)\ntranslate(a, 0, 0) { sphere { } }", "did you mean \"sin\"?"},
      {"box { low = (0, 0, 0) }", "scale(4, 5, 6) { box { } }"}};
  for (const auto& [text, hint] : rows) {
    const std::string error = errorOf("Trace 1\n" + std::string(text));
    EXPECT_TRUE(contains(error, hint)) << text << "\n" << error;
    Messages messages;
    try {
      readScene("kind.ray", "Trace 1\n" + std::string(text), messages);
    } catch (const Error& one) {
      EXPECT_EQ(one.messages().size(), 1u) << text;
    }
  }
}

}  // namespace
}  // namespace trace::test
