// Each check has a scene that it warns of and one, nearly the same, that it does not.
#include "app/lint/lint.h"

#include <gtest/gtest.h>

#include <ctime>
#include <filesystem>

#include "app/lint/coplanar.h"
#include "app/session/session.h"
#include "base/files/file.h"
#include "base/files/read_scope.h"
#include "geometry/mesh/mesh.h"
#include "geometry/shapes/solids/cone.h"
#include "geometry/shapes/solids/cube.h"
#include "geometry/shapes/solids/disk.h"
#include "geometry/shapes/solids/plane.h"
#include "geometry/shapes/solids/square.h"
#include "support/folder.h"
#include "support/paths.h"
#include "support/random.h"
#include "support/scenes.h"
#include "support/shared.h"

namespace trace::test {
namespace {

const std::string kLintScenes = test::sourceFolder() + "/tests/corpus/lint/";

std::vector<LintFinding> lintFile(const std::string& file) {
  Session session;
  session.open(file, {});
  Messages messages;
  const World world = compile(session.scene(), session.settings(), messages);
  std::vector<Message> warnings = session.messages().all();
  warnings.insert(warnings.end(), messages.all().begin(), messages.all().end());
  return lint(session.scene(), session.settings(), world, warnings);
}

std::string names(const std::vector<LintFinding>& findings) {
  std::string text;
  for (const LintFinding& finding : findings)
    text += std::string(finding.check) + ": " + finding.message.what + "\n";
  return text;
}

TEST(Lint, EachCheckWarnsOfItsSceneAtAPlaceWithACure) {
  for (const LintCheck& check : lintChecks()) {
    const std::string file = kLintScenes + std::string(check.name) + ".bad.ray";
    const std::vector<LintFinding> findings = lintFile(file);
    int found = 0;
    for (const LintFinding& finding : findings) {
      if (finding.check != check.name) continue;
      ++found;
      EXPECT_EQ(finding.message.place.file, file);
      EXPECT_GT(finding.message.place.line, 1);
      EXPECT_FALSE(finding.message.what.empty());
      EXPECT_FALSE(finding.message.hint.empty());
    }
    EXPECT_EQ(found, 1) << check.name << "\n" << names(findings);
  }
}

TEST(Lint, AndNotOfTheSceneBesideIt) {
  for (const LintCheck& check : lintChecks()) {
    const std::vector<LintFinding> findings = lintFile(kLintScenes + std::string(check.name) + ".good.ray");
    EXPECT_TRUE(findings.empty()) << check.name << "\n" << names(findings);
  }
}

TEST(Lint, EverySceneOfItsFolderBelongsToACheck) {
  EXPECT_EQ(filesUnder(kLintScenes, ".ray").size(), 2 * lintChecks().size());
}

TEST(Lint, APortalLiesBetweenTheSkyAndARoom) {
  const Folder folder;
  const std::string text = readFile(kLintScenes + "portal.good.ray"), at = "portal { position = (0, 1.5, 2);";
  const auto toldOf = [&](const std::string& portal, const std::string& sky) {
    std::string changed = text;
    changed.replace(changed.find(at), at.size(), "portal { position = (" + portal + ");");
    if (sky.empty()) changed.replace(changed.find("background {"), 0, "// ");
    writeFile(folder / "room.ray", changed);
    std::string told;
    for (const LintFinding& finding : lintFile(folder / "room.ray"))
      if (finding.check == "portal") told += finding.message.what.substr(0, finding.message.what.find(':'));
    return told;
  };
  for (const char* inTheWindow : {"0, 1.5, 2", "0, 1.5, 2.1", "0.4, 1.3, 2", "0, 1.5, 1.7"})
    EXPECT_EQ(toldOf(inTheWindow, "sky"), "") << inTheWindow;
  for (const char* outside : {"0, 1.5, 4", "0, 5, 0", "0, 1.5, 9000"})
    EXPECT_EQ(toldOf(outside, "sky"), "the portal stands in the open") << outside;
  for (const char* inTheWall : {"0, 0.5, 2.05", "0, 0.5, -2.05"})
    EXPECT_EQ(toldOf(inTheWall, "sky"), "no light comes through the portal") << inTheWall;
  EXPECT_EQ(toldOf("0, 1.5, 2", ""), "the portal changes nothing");
}

TEST(Lint, TheMistakesOfTheLessonsAreFound) {
  for (const auto& [lesson, check] : {std::pair{"black-glass", "depth-too-low"},
                                      {"light-in-a-box", "light-inside"},
                                      {"shadow-acne", "coplanar"}}) {
    const std::string found = names(lintFile(test::sourceFolder() + "/scenes/lessons/" + lesson + ".ray"));
    EXPECT_EQ(found.find(check), 0u) << lesson << ": " << found;
  }
}

TEST(Lint, OurOwnExamplesAreClean) {
  constexpr std::size_t kStride = kSanitized ? 4 : 1;
  const std::vector<std::string> scenes = filesUnder(test::sourceFolder() + "/scenes", ".ray");
  const auto is = [](const std::string& scene, const char* part) {
    return scene.find(part) != std::string::npos;
  };
  for (std::size_t at = 0; at < scenes.size(); at += kStride) {
    if (is(scenes[at], "infinity")) continue;   // as in its program, its glass shows no background
    if (is(scenes[at], "/lessons/")) continue;  // their mistakes are to be found
    EXPECT_EQ(names(lintFile(scenes[at])), "") << scenes[at];
  }
}

/// A scene of boxes, squares, disks and meshes on a floor; the last two objects share a plane if `coplanar`.
Scene stacked(bool coplanar) {
  Scene scene;
  addObject(scene, Square{}, Affine::scaling({20, 20, 1}), {});      // the floor
  addObject(scene, Cube{}, Affine::translation({0, 0, 0.5}), {});    // stands on it
  addObject(scene, Cube{}, Affine::translation({0.2, 0, 1.5}), {});  // on the other
  addObject(scene, Cube{}, Affine::translation({1, 0, 0.5}), {});    // beside it
  addObject(scene, Cylinder{}, Affine::translation({4, 0, 0}), {});  // on the floor
  addObject(scene, Disk{}, Affine::translation({4.5, 0.3, coplanar ? 1 : 1.001}), {});
  scene.camera.position = {0, 0, 9}, scene.camera.viewdir = {0, 0, 1}, scene.camera.updir = {0, 1, 0};
  return scene;
}

bool everywhere(const Vec3&) { return true; }

TEST(Lint, OverlappingFacesAreFoundWhereNobodyLooksAndFacesThatTouchAreNot) {
  EXPECT_TRUE(overlappingFaces(stacked(false), everywhere).empty());
  const auto pairs = overlappingFaces(stacked(true), everywhere);
  EXPECT_TRUE(overlappingFaces(stacked(true), [](const Vec3&) { return false; }).empty());
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_EQ(*pairs.begin(), (std::pair<std::uint32_t, std::uint32_t>{4, 5}));

  for (const Real size : {1e-4, 1.0, 1e5}) {  // a mesh in the plane of a square, turned any way
    Scene scene;
    const Affine turned = Affine::rotation({1, 2, 3}, 0.7) * Affine::scaling({size, size, size});
    MeshData mesh;
    mesh.points = {{-0.1f, -0.1f, 0}, {2, 0, 0}, {0, 2, 0}, {2, 2, 0}, {3, 3, 0}};
    mesh.triangles = {{0, 1, 2}, {1, 3, 2}, {1, 4, 3}};
    addObject(scene, Square{}, turned, {});
    addObject(scene, Mesh{std::make_shared<const MeshData>(mesh)}, turned, {});
    addObject(scene, Plane{}, turned * Affine::translation({0, 0, -0.01}), {});
    scene.camera.position = turned * Vec3{0, 0, 5};
    EXPECT_EQ(overlappingFaces(scene, everywhere).size(), 1u) << size;
    scene.camera.position = turned * Vec3{0, 0, -5};  // the mesh shows its back
    EXPECT_EQ(overlappingFaces(scene, everywhere).size(), 0u) << size;
  }
}

TEST(Lint, FindsUnusedMaterialsOfOtherFormats) {
  const Folder folder;
  writeFile(folder / "m.mtl", "newmtl gold\nKd 1 1 0\nnewmtl red\nKd 1 0 0\n");
  writeFile(folder / "m.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n");
  int found = 0;
  for (const LintFinding& finding : lintFile(folder / "m.obj"))
    if (finding.check == "unused-material") {
      ++found;
      EXPECT_NE(finding.message.what.find("gold"), std::string::npos);
    }
  EXPECT_EQ(found, 1);
}

std::vector<LintFinding> lintText(const std::string& text) {
  const Folder folder;
  writeFile(folder / "s.ray", "SBT-raytracer 1.0\n" + text);
  return lintFile(folder / "s.ray");
}

std::vector<std::string> checksOf(const std::string& text) {
  std::vector<std::string> checks;
  for (const LintFinding& finding : lintText(text)) checks.emplace_back(finding.check);
  return checks;
}

using Checks = std::vector<std::string>;

const std::string kCamera = "camera { position = (0, 1, 6); look_at = (0, 0.5, 0); fov = 40; }\n";
const std::string kSun = "directional_light { direction = (-0.3, -1, -0.6); color = (1, 1, 1); }\n";
const std::string kFloor =
    "translate(0, -1, 0, rotate(1, 0, 0, -1.5708, scale(20, 20, 1, square { material = { diffuse = (1, 1, "
    "1); "
    "} })))\n";
const std::string kBall = "sphere { material = { diffuse = (1, 1, 1); ambient = (1, 1, 1); } }\n";

TEST(Lint, TheSunMayShineThroughGlass) {
  const std::string pane =
      "translate(0, 2, 0, scale(30, 0.1, 30, box { material = { transmissive = (1, 1, 1); index = 1.5; } "
      "}))\n";
  EXPECT_EQ(checksOf(kCamera + kSun + kFloor + pane), Checks{});
  const std::string lamp =
      "point_light { position = (0, 3, 0); color = (1, 1, 1); constant_attenuation_coeff = 1; "
      "quadratic_attenuation_coeff = 0; }\n";
  EXPECT_EQ(checksOf(kCamera + lamp + kFloor + pane), Checks{"light-behind-glass"});
  // A ball of glass and nothing else: light that comes to its far side through it is no light behind glass.
  EXPECT_EQ(checksOf(kCamera + lamp +
                     "sphere { material = { diffuse = (0.6, 0.6, 0.6); transmissive = (0.4, "
                     "0.4, 0.4); index = 1.5; } }"),
            Checks{});
}

TEST(Lint, CausticsAreMissingOfLightsThatNoPathMeets) {
  const auto by = [](const std::string& light, const std::string& material, const std::string& settings) {
    return checksOf("settings { integrator = path; spp = 4; " + settings + " }" + kCamera + kFloor +
                    "point_light { position = (3, 4, 3); color = (9, 9, 9); " + light + " }" +
                    "translate(0, 0.5, 0, sphere { material = { diffuse = (0, 0, 0); " + material +
                    " } })\n");
  };
  const std::string glass = "transmissive = (0.9, 0.9, 0.9); index = 1.5;",
                    mirror = "reflective = (0.9, 0.9, 0.9);";
  const Checks missing{"caustics-missing"};
  for (const std::string& material : {glass, mirror}) {
    EXPECT_EQ(by("", material, ""), missing);
    EXPECT_EQ(by("radius = 0.3;", material, ""), missing) << "no path sees it";
    EXPECT_EQ(by("radius = 0.3; visible = true;", material, "glass-shadows = black;"), Checks{});
  }
  EXPECT_EQ(by("radius = 0.3; visible = true;", mirror, ""), Checks{});
  EXPECT_EQ(by("radius = 0.3; visible = true;", glass, ""), missing) << "shadow rays pass straight";
}

TEST(Lint, OneGlassOnALargeFloorIsToldOf) {
  const auto by = [](const char* depth) {
    return checksOf(
        std::string("settings { depth = ") + depth + "; }" + kCamera + kSun + kFloor +
        "translate(0, 0.3, 0, scale(0.3, sphere { material = { diffuse = (0, 0, 0); transmissive = "
        "(1, 1, 1); index = 1.5; } }))\n");
  };
  EXPECT_EQ(by("1"), Checks{"depth-too-low"});
  EXPECT_EQ(by("5"), Checks{});
}

TEST(Lint, DepthIsTooLowOnlyWhereMoreOfItIsSeen) {
  // Rays that stay in the glass for long, and hold little.
  const std::string glass =
      "translate(0, 0.5, 0, sphere { material = { diffuse = (0.1, 0.1, 0.1); transmissive = (0.7, 0.7, 0.7); "
      "reflective = (0.3, 0.3, 0.3); index = 1.5; } })\n";
  EXPECT_EQ(checksOf("settings { depth = 5; }" + kCamera + kSun + kFloor + glass), Checks{});
  EXPECT_EQ(checksOf("settings { depth = 1; }" + kCamera + kSun + kFloor + glass), Checks{"depth-too-low"});
}

TEST(Lint, SkiesOfEveryShapeBlockTheSunAndLampsInsideAreNotBlocked) {
  const std::string blue = "{ name = sky; material = { emissive = (0.4, 0.6, 0.9); } }";
  for (const std::string& sky : {"sphere " + blue, "box " + blue,
                                 "clip(sphere " + blue + ", translate(0, 1, 0, scale(2, 2.2, 2, box {})))"}) {
    EXPECT_EQ(
        checksOf(kCamera + kSun + "ambient_light { color = (1, 1, 1); }" + kBall + "scale(100, " + sky + ")"),
        Checks{"light-blocked"})
        << sky;
    EXPECT_EQ(checksOf(kCamera + "point_light { position = (0, 3, 3); color = (9, 9, 9); }" + kBall +
                       "scale(100, " + sky + ")"),
              Checks{})
        << sky;
  }
}

TEST(Lint, ALightThatIsWeakHereMayBeStrongElsewhere) {
  const std::string lamp = "point_light { position = (40, 50, 60); color = (1, 1, 1); }\n";
  EXPECT_EQ(checksOf(kCamera + kSun + lamp + kFloor + kBall), Checks{"light-too-weak"});
  EXPECT_EQ(checksOf(kCamera + kSun + lamp + kFloor + kBall + "translate(40, 48, 60, scale(10, 1, 10, " +
                     kBall + "))"),
            Checks{});
  EXPECT_EQ(checksOf(kCamera + kSun + "directional_light { direction = (1, -1, 0); color = (0, 0, 0); }" +
                     kFloor + kBall),
            Checks{})
      << "a light that is switched off";
}

const std::string kLow =
    "point_light { position = (0, -3, 0); color = (1, 1, 1); constant_attenuation_coeff = 1; "
    "quadratic_attenuation_coeff = 0; }\n";

std::ptrdiff_t reachingNothing(const std::string& text) {
  const Checks checks = checksOf(text);
  return std::count(checks.begin(), checks.end(), "light-reaches-nothing");
}

TEST(Lint, ALightMayReachOnlyWhatNobodySees) {
  const std::string behind = "translate(0, 1, 12, " + kBall + ")\n";
  const auto spot = [](const std::string& direction) {
    return "spot_light { position = (0, 4, 12); direction = " + direction +
           "; angle = 10; color = (1, 1, 1); constant_attenuation_coeff = 1; quadratic_attenuation_coeff = "
           "0; }\n";
  };
  EXPECT_EQ(reachingNothing(kCamera + kSun + kFloor + spot("(0, -1, 0)") + behind), 0);
}

TEST(Lint, ALightMayReachOnlyAMirror) {
  const std::string scene =
      kCamera + kSun + kFloor +
      "translate(0, 3, 12, rotate(1, 0, 0, -0.931, scale(2, 0.1, 2, box { material = { reflective = (1, 1, "
      "1); } "
      "})))\n"
      "spot_light { position = (0, 5, 12); direction = (0, -1, 0); angle = 5; color = (1, 1, 1); "
      "constant_attenuation_coeff = 1; quadratic_attenuation_coeff = 0; }\n";
  EXPECT_EQ(reachingNothing(scene), 1);
  for (const char* throws :
       {"caustics = 1000", "integrator = photon", "integrator = bdpt", "integrator = path"})
    EXPECT_EQ(reachingNothing("settings { " + std::string(throws) + "; }" + scene), 0) << throws;
}

TEST(Lint, ALightMayReachOnlyASpeck) {
  // A lamp in a small open box, of which the camera sees what is smaller than a pixel.
  const std::string box =
      "material = { diffuse = (1, 1, 1); }\ntranslate(0.31, -0.9, 0.27, scale(0.06, difference(box { }, "
      "translate(0, 0.2, 0.2, scale(0.9, box { })))))\n";
  const std::string lamp =
      "spot_light { position = (0.31, -0.89, 0.28); direction = (0, -1, 0); angle = 10; color = (1, 1, 1); "
      "constant_attenuation_coeff = 1; quadratic_attenuation_coeff = 0; }\n";
  EXPECT_EQ(reachingNothing(kCamera + kSun + kFloor + box + lamp), 0);
}

TEST(Lint, ALightThatReachesNothingIsTold) {
  EXPECT_EQ(checksOf(kCamera + kSun + kFloor + kLow), Checks{"light-reaches-nothing"});
  EXPECT_EQ(checksOf("settings { integrator = path; depth = 4; }" + kCamera + kSun + kFloor + kLow),
            Checks{"light-reaches-nothing"});
  EXPECT_EQ(checksOf("settings { fog = 0.1; }" + kCamera + kSun + kFloor + kLow), Checks{})
      << "the air may be lit";
  EXPECT_EQ(checksOf(kCamera + kSun + kFloor + kBall +
                     "directional_light { direction = (0, 1, 0); color = (0, 0, 0); }"),
            Checks{})
      << "it is off";
  EXPECT_EQ(checksOf(kCamera + kSun + kFloor + kBall +
                     "directional_light { direction = (0, 1, 0); color = (1, 1, 1); }"),
            Checks{"light-reaches-nothing"})
      << "the floor is in its way";
}

TEST(Lint, ASpotLightMayShineOnNothing) {
  const Folder folder;
  const auto said = [&](const std::string& spot, const std::string& rest = "") {
    writeFile(
        folder / "a.ray",
        "SBT-raytracer 1.0\ncamera { position = (0, 1, 6); look_at = (0, 0.5, 0); fov = 40; }\n"
        "spot_light { position = (0, 5, 5); angle = 20; " +
            spot + " }\n" +
            "sphere { name = \"ball\"; material = { diffuse = (0.8, 0.8, 0.8); ambient = (1, 1, 1); } }\n" +
            rest);
    return names(lintFile(folder / "a.ray"));
  };
  const std::string onNothing = "unlit: the spot light shines on nothing: no object is in its cone\n";
  const std::string ambient = "ambient_light { color = (1, 1, 1); }\n";
  EXPECT_EQ(said("direction = (0, -1, -1); color = (1, 1, 1);"), "");
  EXPECT_EQ(said("direction = (0, 0, 1); color = (1, 1, 1);"), onNothing);
  EXPECT_EQ(said("direction = (0, 0, 1); color = (1, 1, 1);", ambient), onNothing);
  EXPECT_EQ(said("direction = (0, 0, 1); color = (0, 0, 0);", ambient), "");
  EXPECT_EQ(
      said("direction = (0, 0, 1); color = (1, 1, 1);",
           "translate(0, 5, 20, sphere { name = \"other\"; material = { diffuse = (1, 1, 1); } })"),
      "unlit: \"ball\" is visible, but no light reaches its visible side: it is black; it is outside the "
      "cone of the spot light\n");
}

TEST(Lint, APanelMayFaceAwayFromEveryObject) {
  const auto checks = [](const std::string& panel, const std::string& rest = "") {
    return checksOf(kCamera + "rectangle_light { position = (0, 5, 0); u = (1, 0, 0); " + panel +
                    (panel.find("color") < panel.size() ? " }\n" : " color = (12, 12, 12); }\n") + kBall + rest);
  };
  const Checks away{"light-faces-away"};
  EXPECT_EQ(checks("v = (0, 0, 1);"), Checks{}) << "it emits downward";
  EXPECT_EQ(checks("v = (0, 0, -1);"), away) << "and is the only finding: it is the cause of the black ball";
  EXPECT_EQ(checks("v = (0, 0, -1);", kSun), away) << "also where another light makes the picture";
  EXPECT_EQ(checks("v = (0, 0, -1);", "ambient_light { color = (0.3, 0.3, 0.3); }\n"), away);
  EXPECT_EQ(checks("v = (0, 0, -1); two_sided = true;"), Checks{});
  EXPECT_EQ(checks("v = (0, 0, -1); color = (0, 0, 0);", kSun), Checks{}) << "it is off";
  EXPECT_EQ(checks("v = (0, 0, -1);", kSun + "translate(0, 9, 0, sphere { name = \"high\"; material = { "
                                             "diffuse = (1, 1, 1); } })\n"),
            Checks{})
      << "an object is ahead, though not in the picture";
}

TEST(Lint, ObjectsMayNameLightsThatAreNotThere) {
  const Folder folder;
  const auto said = [&](const std::string& links) {
    writeFile(folder / "a.ray",
              "SBT-raytracer 1.0\ncamera { position = (0, 1, 6); look_at = (0, 0.5, 0); fov = 40; }\n"
              "directional_light { name = \"key\"; direction = (0, -1, -1); color = (1, 1, 1); }\n"
              "sphere { material = { diffuse = (0.8, 0.8, 0.8); ambient = (1, 1, 1); } " +
                  links + " }\n");
    return names(lintFile(folder / "a.ray"));
  };
  EXPECT_EQ(said("lit_by = (\"key\");"), "");
  EXPECT_EQ(said("not_lit_by = (\"kye\");"),
            "light-link: not_lit_by names \"kye\", and no light is called so\n");
}

TEST(Lint, ARoomWhoseFacesLookOutwardIsLitByNoLamp) {
  const Folder folder;
  const auto said = [&](const std::string& room) {
    writeFile(folder / "a.ray",
              "SBT-raytracer 1.0\ncamera { position = (0, 0, 3); look_at = (0, 0, 0); fov = 60; }\n"
              "point_light { position = (1, 1, 1); color = (1, 1, 1); }\n"
              "ambient_light { color = (0.1, 0.1, 0.1); }\n"
              "material = { diffuse = (0.8, 0.8, 0.8); ambient = (1, 1, 1); }\n" +
                  room);
    return names(lintFile(folder / "a.ray"));
  };
  EXPECT_NE(said("scale(10, box { name = \"room\"; })")
                .find("unlit: the camera is inside \"room\", whose faces "
                      "look outward"),
            std::string::npos);
  EXPECT_EQ(said("difference { scale(20, sphere { }) scale(10, box { }) }").find("look outward"),
            std::string::npos);
}

TEST(Lint, ACameraThatMaySeeSomethingSmallDoesNotLookAway) {
  const std::string eye = "camera { position = (0, 0, 6); updir = (0, 1, 0.1); viewdir = ";
  const std::string speck = "translate(0.013, 0.017, 0, scale(0.001, " + kBall + "))\n";
  EXPECT_EQ(checksOf(eye + "(0, 0, -1); }" + kSun + speck), Checks{"black-picture"});
  EXPECT_EQ(checksOf(eye + "(0, 0, 1); }" + kSun + speck), Checks{"camera-looks-away"});
  EXPECT_EQ(checksOf(eye + "(0, 1, 0); }" + kSun + kBall), Checks{"camera-looks-away"});
  EXPECT_EQ(checksOf(eye + "(0, 0, -1); far = 2; }" + kSun + kBall), Checks{"camera-looks-away"});
  EXPECT_EQ(checksOf(eye + "(0, 0, -1); near = 2; far = 9; }" + kSun + kBall), Checks{});
}

TEST(Lint, PartsOfSolidsNeedMaterialsAndWhatOnlyCutsNeedsNone) {
  const std::string lit = kCamera + kSun + "ambient_light { color = (1, 1, 1); }";
  const std::string box = "translate(0, 1, 0, scale(2, box {}))";
  EXPECT_EQ(checksOf(lit + "union(" + kBall + "," + box + ")"), Checks{"no-material"});
  EXPECT_EQ(checksOf(lit + "clip(" + kBall + "," + box + ")"), Checks{});
  EXPECT_EQ(checksOf(lit + "material = { diffuse = (1, 1, 1); ambient = (1, 1, 1); } union(sphere {}, " +
                     box + ")"),
            Checks{});
}

TEST(Lint, ALampInACaseHasOneCure) {
  const std::string lamp = "point_light { position = (0, 0, 0); color = (1, 1, 1); }";
  const std::string box = "box { material = { diffuse = (1, 1, 1); } }";
  EXPECT_EQ(checksOf(kCamera + lamp + box + kFloor), Checks{"light-inside"});
}

TEST(Lint, RoundThingsAtOnePlaceAreInNoPlane) {
  const std::string other = "sphere { name = \"other\"; material = { diffuse = (0, 1, 0); } }";
  const auto what = [&](const std::string& things) { return names(lintText(kCamera + kSun + things)); };
  EXPECT_EQ(what("sphere { name = \"one\"; material = { diffuse = (1, 0, 0); } }" + other),
            "coplanar: the surfaces of \"other\" and \"one\" are at the same place: rounding decides which "
            "of them is visible\n");
}

TEST(Lint, GlassAndMirrorsUnderABackgroundAreBlackWhereNothingIs) {
  const std::string sky = "background { color = (0.4, 0.6, 0.9); }";
  const auto ball = [&](const std::string& what) {
    return checksOf(kCamera + kSun + sky + kFloor + "sphere { material = { " + what +
                    " = (1, 1, 1); index = 1.5; } }");
  };
  EXPECT_EQ(ball("reflective"), Checks{"black-reflection"});
  EXPECT_EQ(checksOf(kCamera + kSun + kFloor + "sphere { material = { reflective = (1, 1, 1); } }"), Checks{})
      << "under a black one all is as it should be";
}

TEST(Lint, FindsAnglesInDegreesOnce) {
  const std::string all = "rotate(0, 0, 1, 90, rotate(1, 0, 0, 22.5, " + kBall + "))";
  EXPECT_EQ(checksOf(kCamera + kSun + all), Checks{"degrees"});
  EXPECT_EQ(checksOf(kCamera + kSun + "rotate(0, 0, 1, key((0, 0), (1, 90)), " + kBall + ")"), Checks{});
}

// What lint says of the courses' own scenes is to be true; these two checks once said it of six wrongly.
TEST(Lint, IsSilentAboutTheGlassOfTheCourses) {
  const ReadScope allowed({test::sharedFolder() + "/scenes"});
  TRACE_NEEDS_SHARED("scenes/uw");
  for (const char* folder : {"uw2005/simple", "uw2005", "manitoba-a1", "uw2001-hkust"})
    for (const std::string& scene : filesUnder(test::sharedFolder() + "/scenes/uw/" + folder, ".ray")) {
      if (std::filesystem::file_size(scene) > 200000) continue;  // large meshes are slow to read
      try {
        for (const LintFinding& finding : lintFile(scene)) {
          EXPECT_NE(finding.check, "light-behind-glass") << scene;
          EXPECT_NE(finding.check, "depth-too-low") << scene;
          EXPECT_NE(finding.check, "light-blocked") << scene;
          EXPECT_NE(finding.check, "camera-looks-away") << scene;
          EXPECT_NE(finding.check, "degrees") << scene;
        }
      } catch (const Error&) {  // broken on purpose
      }
    }
}

TEST(Lint, SaysTheSameEveryTime) {
  const std::string file = kLintScenes + "depth-too-low.bad.ray";
  EXPECT_EQ(names(lintFile(file)), names(lintFile(file)));
}

TEST(Lint, TheDepthItProposesIsEnough) {
  Session session;
  session.open(kLintScenes + "depth-too-low.bad.ray", {});
  const std::string hint = lintFile(kLintScenes + "depth-too-low.bad.ray").at(0).message.hint;
  const std::string depth = hint.substr(8, hint.find(',') - 8);
  session.open(kLintScenes + "depth-too-low.bad.ray", std::vector<Choice>{{"depth", depth, {}}});
  Messages messages;
  const auto findings =
      lint(session.scene(), session.settings(), compile(session.scene(), session.settings(), messages), {});
  EXPECT_EQ(names(findings), "") << depth;
}

TEST(Lint, IsQuickOnAMeshOfSeventyThousandTriangles) {
  const ReadScope allowed({test::sharedFolder() + "/scenes"});
  if (kSanitized) GTEST_SKIP() << "SKIPPED: the sanitizers are slow";
  TRACE_NEEDS_SHARED("scenes/uw/uw2005/polymesh");
  const std::clock_t start = std::clock();  // of the processor, which other programs do not use up
  lintFile(test::sharedFolder() + "/scenes/uw/uw2005/polymesh/dragon.ray");
  EXPECT_LT(std::clock() - start, 20 * CLOCKS_PER_SEC);
}

}  // namespace
}  // namespace trace::test
