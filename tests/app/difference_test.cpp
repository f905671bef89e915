// What is said of two pictures, and the limits they may be held to.
#include "app/compare/difference.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "base/error.h"
#include "image/codecs/codec.h"
#include "image/comparison/flip.h"

namespace trace::test {
namespace {

const DifferenceOptions kUsual{0, usualPixelsPerDegree()};

LoadedPicture grey(double value, int width = 2, int height = 1) {
  LoadedPicture loaded{Picture(width, height), true};
  for (Color& c : loaded.picture.pixels) c = Color(value);
  return loaded;
}

TEST(PictureDifference, IsInLevelsUnlessAPictureHoldsMore) {
  LoadedPicture a = grey(0), b = grey(2 / 255.0);
  PictureDifference d = difference(a, b, kUsual);
  EXPECT_TRUE(d.levels);
  EXPECT_EQ(d.numbers.maxDifference, 2);
  b.levels = false;
  d = difference(a, b, kUsual);
  EXPECT_EQ(d.unit(), "values");
  EXPECT_EQ(d.numbers.maxDifference, 2 / 255.0);
}

TEST(PictureDifference, OfPicturesOfTwoSizesIsTheWorst) {
  const PictureDifference d = difference(grey(0), grey(0, 1, 2), kUsual);
  EXPECT_FALSE(d.numbers.sameSize);
  EXPECT_FALSE(within(d, {}));
  const std::vector<Limit> generous{parseLimit("max=1e300")};
  EXPECT_FALSE(within(d, generous));
  EXPECT_EQ(d.flip, 1);
}

TEST(PictureDifference, FilesTellWhetherTheyHoldLevels) {
  const std::string path = testing::TempDir() + "/trace_difference";
  for (const char* suffix : {".png", ".bmp", ".exr", ".hdr"}) {
    writePicture(path + suffix, grey(0.5).picture);
    EXPECT_EQ(loadPicture(path + suffix).levels, suffix[1] == 'p' || suffix[1] == 'b') << suffix;
    std::filesystem::remove(path + suffix);
  }
}

TEST(Metrics, HaveNamesOfTheirOwnAndGrowWorse) {
  std::set<std::string_view> names;
  const PictureDifference near = difference(grey(0), grey(1 / 255.0), kUsual),
                          far = difference(grey(0), grey(90 / 255.0), {2, usualPixelsPerDegree()});
  for (const Metric& metric : metrics()) {
    EXPECT_TRUE(names.insert(metric.name).second) << metric.name;
    EXPECT_EQ(&findMetric(metric.name), &metric);
    if (metric.name == "beyond" || metric.name == "pixels") {
      EXPECT_EQ(metric.value(far), 100);
    } else {
      EXPECT_EQ(metric.value(far) < metric.value(near), metric.higherIsBetter) << metric.name;
    }
  }
}

TEST(Limits, AreMetUpToTheirValue) {
  const PictureDifference d = difference(grey(0), grey(3 / 255.0), kUsual);
  const auto holds = [&](const char* limit) { return parseLimit(limit).met(d); };
  EXPECT_TRUE(holds("max=3"));
  EXPECT_FALSE(holds("max=2.9"));
  EXPECT_TRUE(holds("psnr=38"));
  EXPECT_FALSE(holds("psnr=39"));
  EXPECT_FALSE(within(d, {}));
  EXPECT_TRUE(within(d, std::vector<Limit>{parseLimit("max=3"), parseLimit("rmse=3")}));
  EXPECT_FALSE(within(d, std::vector<Limit>{parseLimit("max=3"), parseLimit("rmse=2")}));
  EXPECT_TRUE(within(difference(grey(0), grey(3 / 255.0), {3, usualPixelsPerDegree()}), {}));
}

TEST(Limits, WrongOnesAreRefused) {
  for (const char* wrong : {"", "max", "max=", "max=x", "max=-1", "max=1x", "mux=1", "=1"})
    EXPECT_THROW(parseLimit(wrong), Error) << wrong;
}

}  // namespace
}  // namespace trace::test
