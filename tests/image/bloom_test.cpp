// Bloom, and the steps between the film and the file, which hear on pictures of any size that the time is
// over.
#include "image/development/bloom.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "base/budget.h"
#include "image/codecs/codec.h"
#include "image/development/anaglyph.h"
#include "image/development/denoise.h"
#include "image/development/development.h"
#include "math/noise.h"

namespace trace::test {
namespace {

/// The mean of all pixels, by the Gaussian of their distance.
Picture directlyBlurred(const Picture& picture, double sigma) {
  Picture result(picture.width, picture.height);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      Color sum(0);
      double whole = 0;
      for (int v = 0; v < picture.height; ++v)
        for (int u = 0; u < picture.width; ++u) {
          const double dx = u - x, dy = v - y,
                       weight = std::exp(-0.5 * (dx * dx + dy * dy) / (sigma * sigma));
          sum += picture.at(u, v) * weight;
          whole += weight;
        }
      result.at(x, y) = sum / whole;
    }
  return result;
}

Picture noisy(int width, int height) {
  Picture picture(width, height);
  std::uint64_t bits = 1;
  const auto next = [&] { return unitFromBits(bits = mixBits(bits)); };
  for (Color& c : picture.pixels) c = {next(), next(), next() > 0.9 ? 1.0 : 0.0};
  return picture;
}

TEST(Bloom, IsTheGaussianAtEveryWidthAndAtTheBorders) {
  const Picture picture = noisy(37, 23);
  for (const double sigma : {0.1, 0.5, 1.0, 2.5, 7.0, 40.0}) {
    const Picture blurred = gaussianBlurred(picture, sigma), expected = directlyBlurred(picture, sigma);
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
      EXPECT_NEAR(blurred.pixels[i].r, expected.pixels[i].r, 2e-3) << sigma << " " << i;
      EXPECT_NEAR(blurred.pixels[i].b, expected.pixels[i].b, 2e-3) << sigma << " " << i;
    }
  }
}

TEST(Bloom, LeavesAPlainPictureAsItIs) {
  Picture picture(50, 20);
  for (Color& c : picture.pixels) c = {0.25, 1, 7};
  for (const Color& c : bloomed(picture, 1).pixels) {
    EXPECT_NEAR(c.r, 0.25, 1e-12);
    EXPECT_NEAR(c.b, 7, 1e-11);
  }
}

TEST(Bloom, AVeryBrightPixelStaysFinite) {
  Picture picture(40, 40);
  picture.at(20, 20) = Color(1e300);
  for (const Color& c : bloomed(picture, 0.5).pixels) EXPECT_TRUE(isFinite(c));
}

// --- the time ---

struct TimeIsOver {};

/// How often `step` asks for the time.
int looksOf(const std::function<void()>& step) {
  int looks = 0;
  Budget budget([&] { ++looks; });
  const BudgetScope scope(&budget);
  step();
  return looks;
}

/// The step of a large picture ends when it hears that the time is over, as its first and its later parts do.
void expectHears(const char* name, const std::function<void()>& step) {
  for (const int after : {1, 3, 20}) {
    int looks = 0;
    Budget budget([&] {
      if (++looks >= after) throw TimeIsOver{};
    });
    const BudgetScope scope(&budget);
    EXPECT_THROW(step(), TimeIsOver) << name << " after " << after << " looks";
  }
}

TEST(LastSteps, EachHearsThatTheTimeIsOverAt4000Pixels) {
  const Picture large(4000, 500);
  expectHears("bloom", [&] { (void)bloomed(large, 0.5); });
  for (const Tone tone : {Tone::reinhard, Tone::filmic, Tone::agx, Tone::stretch})
    expectHears("tone", [&] { (void)developed(large, {.tone = tone}); });
  expectHears("exposure", [&] { (void)developed(large, {.exposure = 1}); });
  expectHears("white balance", [&] { (void)developed(large, {.whiteBalance = 3200}); });
  expectHears("transfer", [&] { (void)developed(large, {.transfer = Transfer::srgb}); });
  expectHears("dither", [&] { (void)developed(large, {.dither = true}); });
  expectHears("stereo", [&] { (void)anaglyph(large, kDubois); });
  for (const PictureFormat& format : pictureFormats())
    if (format.encode)
      expectHears(std::string(format.name).c_str(), [&] { (void)encodePicture(format, large); });
}

TEST(LastSteps, TakingNoiseOutHearsIt) {
  constexpr int kWidth = 4000, kHeight = 40;
  const Picture plain(kWidth, kHeight);
  Halves halves{plain, plain, std::vector<double>(plain.pixels.size(), 0.1),
                std::vector<double>(plain.pixels.size(), 0.5)};
  Job job;
  expectHears("denoising", [&] { (void)withoutNoise(halves, {plain, plain, plain}, 2, job); });
}

TEST(LastSteps, TheFilmHearsItWhenItIsAsked) {
  Film film(4000, 500);
  for (std::int64_t tile = 0; tile < film.tiles(); ++tile) {
    const Tile area = film.tile(tile);
    const auto pixels = static_cast<std::size_t>((area.x1 - area.x0) * (area.y1 - area.y0));
    film.add(tile, 0, {.area = area, .colors = std::vector<Color>(pixels), .layers = {}});
  }
  expectHears("picture", [&] { (void)film.picture(); });
  EXPECT_TRUE(film.complete());
}

/// No step asks once for a whole picture: the looks grow with the rows.
TEST(LastSteps, EachLooksMoreOftenAtALargerPicture) {
  const Picture small(400, 100), large(400, 800);
  for (const PictureFormat& format : pictureFormats()) {
    if (!format.encode) continue;
    const auto looks = [&](const Picture& p) { return looksOf([&] { (void)encodePicture(format, p); }); };
    EXPECT_GT(looks(large), 4 * looks(small)) << format.name;
  }
  const auto looks = [&](const Picture& p) {
    return looksOf([&] { (void)developed(p, {.bloom = 0.5, .tone = Tone::agx}); });
  };
  EXPECT_GT(looks(large), 4 * looks(small));
}

}  // namespace
}  // namespace trace::test
