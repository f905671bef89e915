// Each check has a scene that it warns of and one, nearly the same, that it does not.
#include "app/lint.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>

#include "app/coplanar.h"
#include "app/session.h"
#include "base/file.h"
#include "support/folder.h"
#include "support/paths.h"
#include "support/random.h"
#include "support/scenes.h"
#include "support/shared.h"

namespace trace::test {
namespace {

const std::string kScenes = test::sourceFolder() + "/tests/corpus/lint/";

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
    const std::string file = kScenes + std::string(check.name) + ".bad.ray";
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
    const std::vector<LintFinding> findings = lintFile(kScenes + std::string(check.name) + ".good.ray");
    EXPECT_TRUE(findings.empty()) << check.name << "\n" << names(findings);
  }
}

TEST(Lint, EverySceneOfItsFolderBelongsToACheck) {
  EXPECT_EQ(filesUnder(kScenes, ".ray").size(), 2 * lintChecks().size());
}

TEST(Lint, OurOwnExamplesAreClean) {
  for (const std::string& scene : filesUnder(test::sourceFolder() + "/scenes", ".ray"))
    if (scene.find("infinity") == std::string::npos) {  // its depth of 2 is that of the program it is from
      EXPECT_EQ(names(lintFile(scene)), "") << scene;
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

TEST(Lint, SaysTheSameEveryTime) {
  const std::string file = kScenes + "depth-too-low.bad.ray";
  EXPECT_EQ(names(lintFile(file)), names(lintFile(file)));
}

TEST(Lint, TheDepthItProposesIsEnough) {
  Session session;
  session.open(kScenes + "depth-too-low.bad.ray", {});
  const std::string hint = lintFile(kScenes + "depth-too-low.bad.ray").at(0).message.hint;
  const std::string depth = hint.substr(8, hint.find(',') - 8);
  session.open(kScenes + "depth-too-low.bad.ray", std::vector<Choice>{{"depth", depth, {}}});
  Messages messages;
  const auto findings =
      lint(session.scene(), session.settings(), compile(session.scene(), session.settings(), messages), {});
  EXPECT_EQ(names(findings), "") << depth;
}

TEST(Lint, IsQuickOnAMeshOfSeventyThousandTriangles) {
  if (kSanitized) GTEST_SKIP() << "SKIPPED: the sanitizers are slow";
  TRACE_NEEDS_SHARED("scenes/uw/uw2005/polymesh");
  const auto start = std::chrono::steady_clock::now();
  lintFile(test::sharedFolder() + "/scenes/uw/uw2005/polymesh/dragon.ray");
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 10);
}

}  // namespace
}  // namespace trace::test
