// Official pictures of the courses of British Columbia and Montreal, and of one that rendered the composer's
// files: Trace must repeat them as far as what is known of their programs goes.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "app/session/session.h"
#include "base/files/read_scope.h"
#include "image/codecs/codec.h"
#include "image/comparison/compare.h"
#include "render/picture/passes.h"
#include "support/paths.h"
#include "support/shared.h"

namespace trace::test {
namespace {

const std::string kScenes = test::sharedFolder() + "/scenes/";
const std::string kReference = test::sharedFolder() + "/reference/";

struct Agreement {
  double exact = 0, within = 0, rmse = 0;  ///< shares of channel values, the latter within one level; of 255
};

Agreement agreement(const Picture& ours, const std::string& theirs) {
  const Bytes a = toBytes(ours, Rounding::truncate), b = toBytes(readPicture(theirs), Rounding::nearest);
  const Comparison same = compare(a, b, 0), near = compare(a, b, 1);
  return {1 - same.fractionBeyond, 1 - near.fractionBeyond, same.rmse};
}

void print(const std::string& name, const Agreement& a) {
  std::printf("%-32s exact %8.4f %%  within 1 %8.4f %%  RMSE %.3f\n", name.c_str(), 100 * a.exact,
              100 * a.within, a.rmse);
}

struct Pair {
  Agreement color, depth;
};

/// The scene's picture and its depth beside those of the course, which its own settings make.
Pair compareWithCourse(const std::string& scene, const std::string& reference,
                       const std::vector<Choice>& choices = {}) {
  Session session;
  session.open(kScenes + "ubc/scenes/" + scene, choices);
  session.build();
  session.renderPicture();
  const Settings& settings = session.settings();
  const PassRow& depth = *passesOf(settings).at(0);
  Pair pair{
      agreement(toned(session.picture(), settings.tone), kReference + "ubc/" + reference + "_output.bmp"),
      agreement(depth.shown(session.film().layer(0), settings),
                kReference + "ubc/" + reference + "_depth_output.bmp")};
  print(reference, pair.color);
  print(reference + " depth", pair.depth);
  return pair;
}

TEST(CourseReference, MontrealsPicturesAreRepeated) {
  const ReadScope allowed({test::sharedFolder() + "/scenes"});
  TRACE_NEEDS_SHARED("reference/ubc");
  for (const char* name : {"triangle", "cube"}) {
    const Pair pair =
        compareWithCourse(std::string("udem2020/") + name + ".ray", std::string("udem2020/") + name);
    EXPECT_GE(pair.color.within, 0.9999) << name;
    EXPECT_GE(pair.depth.within, 0.9999) << name;
    EXPECT_LT(pair.color.rmse, 0.25) << name;
  }
  // Its mirrored rays reach no farther than 100, which shows as a horizon in the mirrors; ours have no limit.
  const Pair basic = compareWithCourse("udem2022/basic.ray", "udem2022/basic", {{"omit", "conic", {}}});
  EXPECT_GE(basic.color.within, 0.995);
  EXPECT_GE(basic.depth.within, 0.9999);
  EXPECT_LT(basic.color.rmse, 1);
}

/// They took one random sample for each pixel, so that silhouettes differ by a pixel here and there.
TEST(CourseReference, BritishColumbiasPicturesAreRepeatedButForSilhouettes) {
  const ReadScope allowed({test::sharedFolder() + "/scenes"});
  TRACE_NEEDS_SHARED("reference/ubc");
  for (const char* name : {"basic", "cube"}) {
    const Pair pair = compareWithCourse(std::string("ubc2016/") + name + ".ray",
                                        std::string("ubc2016/") + name, {{"omit", "conic", {}}});
    EXPECT_GE(pair.color.within, 0.98) << name;
    EXPECT_GE(pair.depth.within, 0.99) << name;
    EXPECT_LT(pair.color.rmse, 6) << name;
  }
}

TEST(CourseReference, TheSceneOfNoSceneIsTheRedSquare) {
  TRACE_NEEDS_SHARED("reference/ubc");
  Session session;
  session.open(test::sourceFolder() + "/scenes/cpsc314-default.ray", {});
  session.build();
  session.renderPicture();
  const Settings& settings = session.settings();
  const std::string reference = kReference + "ubc/ubc2016/noarg_default";
  EXPECT_EQ(agreement(toned(session.picture(), settings.tone), reference + "_out.bmp").exact, 1);
  EXPECT_EQ(agreement(passesOf(settings).at(0)->shown(session.film().layer(0), settings),
                      reference + "_depth_out.bmp")
                .exact,
            1);
}

TEST(CourseReference, TheDepthBesideThePictureHasTheNameOfTheHandout) {
  Messages messages;
  const Scene scene = readScene("some/place/basic.ray", "Dimensions 4 4", messages);
  const std::vector<Output> files = outputs(scene.picture, resolve({scene.choices}));
  ASSERT_EQ(files.size(), 2u);
  EXPECT_EQ(files[0].path, "some/place/basic_out.bmp");
  EXPECT_EQ(files[1].path, "some/place/basic_out_depth.bmp");
}

/// Their pictures are JPEGs; the RMSE that a fit of their formula reaches, and a little more.
TEST(CourseReference, ComposerPicturesAreRepeated) {
  const ReadScope allowed({test::sharedFolder() + "/scenes"});
  TRACE_NEEDS_SHARED("reference/composer");
  struct Case {
    const char* name;
    const char* ambient;
    double rmse;
  };
  for (const Case& c : {Case{"set1/test1", "0.5", 2.7},
                        {"set1/test2", "0.5", 3.8},
                        {"set2/test1", "1", 6.3},
                        {"set2/test2", "1", 3.2}}) {
    Messages messages;
    const Scene scene = readScene(kScenes + "composer/" + c.name + ".ascii", messages);
    const std::vector<Choice> choices{
        {"width", "256", {}}, {"height", "256", {}}, {"spp", "16", {}}, {"ambient-scale", c.ambient, {}}};
    const Settings settings = resolve({scene.choices, choices});
    const World world = compile(scene, settings, messages);
    Film film = makeFilm(settings, 256, 256);
    Job job;
    render(world, settings, film, job);
    const Agreement result = agreement(film.picture(), kReference + "composer/" + c.name + ".jpg");
    print(c.name, result);
    EXPECT_LT(result.rmse, c.rmse) << c.name;
  }
}

TEST(CourseReference, TextAndBinaryTwinsAreTheSamePicture) {
  const ReadScope allowed({test::sharedFolder() + "/scenes"});
  TRACE_NEEDS_SHARED("scenes/composer");
  for (const char* set : {"set1", "set2"})
    for (const char* name : {"test1", "test2", "test4"}) {
      Picture pictures[2];
      for (int i : {0, 1}) {
        Session session;
        session.open(kScenes + "composer/" + set + "/" + name + (i ? ".scene" : ".ascii"),
                     std::vector<Choice>{{"width", "64", {}}, {"height", "64", {}}});
        session.build();
        session.renderPicture();
        pictures[i] = session.picture();
      }
      // Text has six digits, binary floats have seven.
      const Comparison difference =
          compare(toBytes(pictures[0], Rounding::nearest), toBytes(pictures[1], Rounding::nearest), 1);
      EXPECT_LT(difference.fractionBeyond, 0.005) << set << " " << name;
    }
}

TEST(CourseReference, EverySceneLoadsAndRenders) {
  const ReadScope allowed({test::sharedFolder() + "/scenes"});
  TRACE_NEEDS_SHARED("scenes/ubc");
  int rendered = 0;
  for (const auto& [folder, suffix] : {std::pair{"ubc", ".ray"},
                                       {"composer", ".ascii"},
                                       {"composer", ".scene"},
                                       {"inventor", ".wrl"},
                                       {"inventor", ".iv"}})
    for (const std::string& scene : filesUnder(kScenes + folder, suffix)) {
      Session session;
      session.open(scene, std::vector<Choice>{{"width", "32", {}}, {"height", "24", {}}});
      session.build();
      const RenderResult result = session.renderPicture();
      EXPECT_EQ(result.end, End::finished) << scene;
      EXPECT_EQ(result.statistics.badSamples, 0u) << scene;
      ++rendered;
    }
  EXPECT_GT(rendered, 80);
}

}  // namespace
}  // namespace trace::test
