// Each check has a scene that it warns of and one, nearly the same, that it does not.
#include "app/lint.h"

#include <gtest/gtest.h>

#include <chrono>

#include "app/session.h"
#include "support/random.h"
#include "support/shared.h"

namespace trace::test {
namespace {

const std::string kScenes = std::string(TRACE_SOURCE) + "/tests/corpus/lint/";

std::vector<LintFinding> lintFile(const std::string& file) {
  Session session;
  session.open(file, {});
  Messages messages;
  return lint(session.scene(), session.settings(), compile(session.scene(), session.settings(), messages));
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
  for (const std::string& scene : filesUnder(std::string(TRACE_SOURCE) + "/scenes", ".ray"))
    if (scene.find("infinity") == std::string::npos)  // its depth of 2 is that of the program it is from
      EXPECT_EQ(names(lintFile(scene)), "") << scene;
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
      lint(session.scene(), session.settings(), compile(session.scene(), session.settings(), messages));
  EXPECT_EQ(names(findings), "") << depth;
}

TEST(Lint, IsQuickOnAMeshOfSeventyThousandTriangles) {
  if (kSanitized) GTEST_SKIP() << "SKIPPED: the sanitizers are slow";
  TRACE_NEEDS_SHARED("scenes/uw/uw2005/polymesh");
  const auto start = std::chrono::steady_clock::now();
  lintFile(std::string(TRACE_SHARED) + "/scenes/uw/uw2005/polymesh/dragon.ray");
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 10);
}

}  // namespace
}  // namespace trace::test
