// A document from file to picture, over our own example scenes.
#include "app/session/session.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <map>

#include "base/budget.h"
#include "base/files/file.h"
#include "image/codecs/codec.h"
#include "support/folder.h"
#include "support/opened.h"
#include "support/paths.h"
#include "support/random.h"
#include "support/shared.h"
#include "support/small_renders.h"

namespace trace::test {
namespace {

const std::string kExamples = test::sourceFolder() + "/scenes";

Picture renderFile(const std::string& file, std::vector<Choice> choices) {
  Session session;
  session.open(file, choices);
  session.build();
  session.renderPicture();
  return developed(finished(session.picture(), session.settings()), developmentOf(session.settings()));
}

TEST(Examples, LoadWithoutAWarningAndRenderTheSameForAnyNumberOfThreads) {
  const std::vector<std::string> scenes = filesUnder(kExamples, ".ray");
  ASSERT_FALSE(scenes.empty());
  for (const std::string& scene : scenes) {
    Session asSaid;
    asSaid.open(scene, {});
    EXPECT_TRUE(asSaid.messages().all().empty()) << toString(asSaid.messages().all().front());
    const std::vector<Choice> small = smallChoices(asSaid.settings(), 28, 16);  // waves of all lengths
    std::unique_ptr<Session> before;
    const auto rendered = [&](const char* threads) {
      std::vector<Choice> choices = small;
      choices.push_back({"threads", threads, {}});
      auto session = std::make_unique<Session>();
      openAgain(*session, asSaid, choices);
      session->build(before.get());  // what is not of the threads is built once
      EXPECT_TRUE(session->messages().all().empty()) << toString(session->messages().all().front());
      session->renderPicture();
      before = std::move(session);
      return developed(finished(before->picture(), before->settings()), developmentOf(before->settings()));
    };
    const Picture one = rendered("1");
    double brightest = 0;
    for (const Color& c : one.pixels) brightest = std::max(brightest, maxComponent(c));
    EXPECT_GT(brightest, 0.2) << scene;
    for (const char* threads : {"2", "7"}) EXPECT_EQ(one, rendered(threads)) << scene;
  }
}

TEST(Session, PicturesKeepHowTheyWereMade) {
  const std::string path = testing::TempDir() + "/trace_metadata.png";
  Session session;
  session.open(kExamples + "/shapes.ray", std::vector<Choice>{{"width", "20", {}}, {"like", "ut", {}}});
  session.build();
  session.renderPicture();
  session.save(path);
  std::map<std::string, std::string> metadata;
  for (const auto& [key, value] : readMetadata(path)) metadata[key] = value;
  EXPECT_EQ(metadata["Software"], "Trace " TRACE_VERSION);
  EXPECT_EQ(metadata["Title"], "shapes.ray");
  EXPECT_NE(metadata["Settings"].find("like=ut"), std::string::npos);
  EXPECT_NE(metadata["Settings"].find("width=20"), std::string::npos);
}

TEST(Session, RefusesPicturesBeyondItsMemory) {
  Session session;
  session.open(kExamples + "/shapes.ray",
               std::vector<Choice>{{"width", "2000", {}}, {"max-memory", "1", {}}});
  try {
    session.build();
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::limit);
  }
}

TEST(Session, RefusesPhotonsAndDenoisingBeyondItsMemory) {
  const auto fits = [](std::vector<Choice> choices, const char* mebibytes) {
    Session session;
    choices.insert(choices.end(),
                   {{"width", "200", {}}, {"height", "200", {}}, {"max-memory", mebibytes, {}}});
    session.open(kExamples + "/shapes.ray", choices);
    try {
      session.build();
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::limit);
      return false;
    }
    return true;
  };
  std::vector<Choice> photons{{"integrator", "photon", {}}, {"photons", "2000", {}}, {"spp", "8", {}}};
  EXPECT_TRUE(fits(photons, "30"));
  photons[1].value = "50000";  // of 96 bytes, in each of 8 passes
  EXPECT_FALSE(fits(photons, "30"));
  photons[2].value = "1";
  EXPECT_TRUE(fits(photons, "30")) << "no more passes are made than samples";
  EXPECT_TRUE(fits({{"spp", "8", {}}}, "12"));
  EXPECT_FALSE(fits({{"spp", "8", {}}, {"denoise", "on", {}}}, "12"));  // more than 300 bytes a pixel
}

/// Resident memory in KiB, or 0 where the system does not tell.
long residentMemory() {
  long pages = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> pages >> resident;
  return resident * 4;
}

TEST(Session, MemoryStaysFlatOverTwoHundredRenders) {
  if (kSanitized) GTEST_SKIP() << "SKIPPED: the sanitizers keep freed memory (and look for leaks themselves)";
  const auto renders = [](int n) {
    for (int i = 0; i < n; ++i) renderFile(kExamples + "/mesh.ray", {{"width", "50", {}}});
  };
  renders(30);
  const long before = residentMemory();
  renders(200);
  EXPECT_LT(residentMemory() - before, 2048) << "KiB more after 200 renders";
}

/// A single ray may take long where many objects lie in one place.
TEST(Session, RaysLookAtTheBudgetForEveryObjectTheyMeet) {
  constexpr int kSpheres = 4000, kLeastLooks = kSpheres / 200;
  std::string text = "SBT-raytracer 1.0\ncamera { }\n";
  for (int i = 0; i < kSpheres; ++i) text += "sphere { material = { transmissive = (1, 1, 1); } }\n";
  const Folder folder;
  writeFile(folder / "spheres.ray", text);
  Session session;
  session.open(folder / "spheres.ray", {});
  session.build();
  int looks = 0;
  Budget budget([&] { ++looks; });
  const BudgetScope scope(&budget);
  const Ray ray{{0, 0, 5}, {0, 0, -1}};
  Statistics statistics;
  session.world().closest(ray, Faces::both, statistics);
  EXPECT_GE(looks, kLeastLooks) << "the closest";
  looks = 0;
  session.world().crossings(ray, kInfinity, Faces::both, statistics, [](const Found&) { return false; });
  EXPECT_GE(looks, kLeastLooks) << "all";
}

}  // namespace
}  // namespace trace::test
