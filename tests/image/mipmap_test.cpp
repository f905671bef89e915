// Lookups in pictures. Filters are held against what they must give whatever they do inside: a constant stays
// itself, a straight ramp too, and all of the picture at once is its mean.
#include "image/maps/mipmap.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/parallel.h"
#include "image/srgb.h"
#include "support/random.h"

namespace trace {
namespace {

constexpr TexelFilter kFilters[] = {TexelFilter::nearest, TexelFilter::bilinear, TexelFilter::trilinear,
                                    TexelFilter::ewa};
constexpr Wrap kWraps[] = {Wrap::repeat, Wrap::clamp, Wrap::mirror, Wrap::black};
constexpr int kMipmapSizes[][2] = {{1, 1}, {2, 2}, {8, 8}, {7, 5}, {1, 9}, {33, 4}, {100, 37}};

template <class T, class At>
Raster raster(int width, int height, int channels, double most, const At& at) {
  Raster result(width, height, channels, most);
  std::vector<T> samples;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < channels; ++c) samples.push_back(static_cast<T>(at(x, y, c)));
  result.samples = std::move(samples);
  return result;
}

double apart(const Texel& a, const Texel& b) {
  return std::max({std::abs(a.color.r - b.color.r), std::abs(a.color.g - b.color.g),
                   std::abs(a.color.b - b.color.b), std::abs(a.alpha - b.alpha)});
}

/// Small and large, round and long, and across the edges.
Lookup anyLookup(test::Random& random, TexelFilter filter, Wrap wrap) {
  Lookup lookup{.u = wrap, .v = wrap, .filter = filter};
  const double size = std::pow(10, random.uniform(-4, 1));
  lookup.uvX = {size * random.uniform(-1, 1), size * random.uniform(-1, 1)};
  lookup.uvY = {size * random.uniform(-1, 1), size * random.uniform(-1, 1)};
  return lookup;
}

TEST(MipMap, APictureOfOneColourGivesItExactly) {
  constexpr int kSamples[] = {31, 200, 77, 13};
  const auto ofOneColour = [&](int width, int height, int channels, int bits) {
    const auto at = [&](int, int, int c) { return kSamples[c] / (bits == 32 ? 64.0 : 1.0); };
    if (bits == 8) return raster<std::uint8_t>(width, height, channels, 255, at);
    if (bits == 16) return raster<std::uint16_t>(width, height, channels, 1000, at);
    return raster<float>(width, height, channels, 1, at);
  };
  test::Random random(1);
  for (const auto& [width, height] : kMipmapSizes)
    for (int channels = 1; channels <= 4; ++channels)
      for (int bits : {8, 16, 32}) {
        const MipMap map(ofOneColour(width, height, channels, bits));
        for (TexelFilter filter : kFilters)
          for (Wrap wrap : {Wrap::repeat, Wrap::clamp, Wrap::mirror})
            for (bool srgb : {false, true})
              for (int i = 0; i < 20; ++i) {
                Lookup lookup = anyLookup(random, filter, wrap);
                lookup.srgb = srgb;
                const Texel texel = map.at({random.uniform(-3, 3), random.uniform(-3, 3)}, lookup);
                Texel expected = map.texel(0, 0);
                if (srgb)
                  for (double* v : {&expected.color.r, &expected.color.g, &expected.color.b})
                    *v = linearOfSrgb(*v);
                // What was made linear is stored as floats.
                const bool exact = !srgb;
                ASSERT_LE(apart(texel, expected), exact ? 0 : 4e-7)
                    << width << " x " << height << ", " << channels << " channels of " << bits;
              }
      }
}

TEST(MipMap, EveryLevelHasTheMeanOfThePicture) {
  test::Random random(2);
  for (const auto& size : kMipmapSizes) {
    const int width = size[0], height = size[1];
    const MipMap::Level base{
        width, height, 1, false, 1, 1, raster<float>(width, height, 1, 1, [&](int, int, int) {
                                         return random.uniform(0, 1);
                                       }).samples};
    const auto mean = [](const MipMap::Level& level) {
      double sum = 0;
      const auto& samples = std::get<std::vector<float>>(level.samples);
      for (float sample : samples) sum += sample;
      return sum / static_cast<double>(samples.size());
    };
    MipMap::Level level = base;
    while (level.width > 1 || level.height > 1) {
      const MipMap::Level next = MipMap::halved(level, {});
      EXPECT_EQ(next.width, std::max(1, level.width / 2));
      EXPECT_EQ(next.height, std::max(1, level.height / 2));
      level = next;
      EXPECT_NEAR(mean(level), mean(base), 1e-7) << width << " x " << height;
    }
  }
}

TEST(MipMap, AllOfThePictureAtOnceIsItsMean) {
  test::Random random(3);
  for (int size : {2, 37, 64, 100}) {
    double sum = 0;
    const MipMap map(raster<std::uint8_t>(size, size, 1, 255, [&](int, int, int) {
      const double value = std::floor(random.uniform(0, 256));
      sum += value;
      return value;
    }));
    for (TexelFilter filter : {TexelFilter::trilinear, TexelFilter::ewa})
      for (Wrap wrap : {Wrap::repeat, Wrap::clamp, Wrap::mirror}) {
        Lookup lookup{.u = wrap, .v = wrap, .filter = filter};
        lookup.uvX = {1, 0}, lookup.uvY = {0, 1};
        EXPECT_NEAR(map.at({0.3, 0.8}, lookup).color.g, sum / size / size / 255, 1e-4) << size;
      }
  }
}

TEST(MipMap, MeansOfSrgbAreTakenOfLight) {
  const MipMap map(raster<std::uint8_t>(2, 2, 3, 255, [](int x, int, int) { return 255 * x; }));
  Lookup lookup{.filter = TexelFilter::trilinear, .srgb = true, .uvX = {1, 0}, .uvY = {0, 1}};
  EXPECT_NEAR(map.at({0.5, 0.5}, lookup).color.r, 0.5, 1e-7);
  EXPECT_NEAR(linearOfSrgb(188 / 255.0), 0.5, 0.005);  // the grey that looks half as bright as white
  lookup.filter = TexelFilter::bilinear;
  EXPECT_NEAR(map.at({0.5, 0.5}, lookup).color.r, 0.5, 1e-7);
}

TEST(MipMap, BetweenTexelsAndBeyondTheEdges) {
  //  0  1  2  from the left, 3 4 5 in the row below
  const MipMap map(raster<float>(3, 2, 1, 1, [](int x, int y, int) { return x + 3 * y; }));
  const auto red = [&](double u, double v, Lookup lookup) { return map.at({u, v}, lookup).color.r; };
  for (TexelFilter filter : kFilters) {
    if (filter == TexelFilter::nearest) continue;
    Lookup l{.filter = filter};
    EXPECT_DOUBLE_EQ(red(0.5, 0.75, l), 1);        // the centre of a texel
    EXPECT_DOUBLE_EQ(red(2.0 / 6, 0.25, l), 3.5);  // between two
    EXPECT_DOUBLE_EQ(red(2.0 / 6, 0.5, l), 2);     // between four
  }
  const auto beyond = [&](Wrap wrap, double u) { return red(u, 0.75, {wrap, wrap, TexelFilter::nearest}); };
  const double left = -0.5 / 3, right = 1 + 0.5 / 3, farther = 1 + 1.5 / 3;
  EXPECT_EQ(beyond(Wrap::repeat, left), 2);
  EXPECT_EQ(beyond(Wrap::repeat, right), 0);
  EXPECT_EQ(beyond(Wrap::repeat, farther), 1);
  EXPECT_EQ(beyond(Wrap::clamp, left), 0);
  EXPECT_EQ(beyond(Wrap::clamp, farther), 2);
  EXPECT_EQ(beyond(Wrap::mirror, left), 0);
  EXPECT_EQ(beyond(Wrap::mirror, right), 2);
  EXPECT_EQ(beyond(Wrap::mirror, farther), 1);
  EXPECT_EQ(beyond(Wrap::black, right), 0);
  EXPECT_EQ(map.at({right, 0.5}, {Wrap::black, Wrap::clamp, TexelFilter::nearest}).alpha, 0);
  EXPECT_DOUBLE_EQ(red(1, 0.25, {Wrap::black, Wrap::black}), 2.5);  // half of the last texel
  // As the courses' programs have it: the corners of the picture are centres of texels.
  const Lookup ends{Wrap::clamp, Wrap::clamp, TexelFilter::bilinear, true};
  EXPECT_DOUBLE_EQ(red(0, 1, ends), 0);
  EXPECT_DOUBLE_EQ(red(1, 0, ends), 5);
  EXPECT_DOUBLE_EQ(red(0.25, 1, ends), 0.5);
}

TEST(MipMap, ARampStaysARamp) {
  constexpr int kSide = 256;
  const MipMap map(
      raster<float>(kSide, kSide, 1, 1, [](int x, int y, int) { return (x + 0.5) - 2 * (y + 0.5); }));
  test::Random random(4);
  for (TexelFilter filter : {TexelFilter::bilinear, TexelFilter::trilinear, TexelFilter::ewa})
    for (int i = 0; i < 1000; ++i) {
      const double longest = std::pow(10, random.uniform(-4, -1.7)), angle = random.uniform(0, 2 * kPi);
      Lookup lookup{.u = Wrap::clamp, .v = Wrap::clamp, .filter = filter};
      lookup.uvX = {longest * std::cos(angle), longest * std::sin(angle)};
      lookup.uvY = Vec2{-lookup.uvX.y * random.uniform(0, 1), lookup.uvX.x * random.uniform(0, 1)};
      const Vec2 uv{random.uniform(0.3, 0.7), random.uniform(0.3, 0.7)};
      const double expected = kSide * (uv.x - 2 * (1 - uv.y));
      // The few texels of a small ellipse do not lie evenly around its centre: up to a fifth of one.
      EXPECT_NEAR(map.at(uv, lookup).color.r, expected, filter == TexelFilter::ewa ? 0.5 : 1e-4);
    }
}

TEST(MipMap, AnEllipseKeepsWhatRunsAlongIt) {
  // Stripes of two texels from top to bottom.
  const MipMap map(raster<std::uint8_t>(64, 64, 1, 255, [](int x, int, int) { return x / 2 % 2 * 255; }));
  const auto contrast = [&](TexelFilter filter, const Vec2& uvX, const Vec2& uvY) {
    const Lookup lookup{.filter = filter, .uvX = uvX, .uvY = uvY};
    return map.at({31.0 / 64, 0.5}, lookup).color.r - map.at({29.0 / 64, 0.5}, lookup).color.r;
  };
  const Vec2 upward{0, 8.0 / 64}, sideways{1.0 / 64, 0};
  EXPECT_GT(contrast(TexelFilter::ewa, sideways, upward), 0.5);
  EXPECT_GT(contrast(TexelFilter::ewa, upward, sideways), 0.5);
  EXPECT_LT(contrast(TexelFilter::trilinear, sideways, upward), 0.05);
  EXPECT_LT(contrast(TexelFilter::ewa, {8.0 / 64, 0}, {0, 1.0 / 64}), 0.1);
}

TEST(MipMap, NoPlaceAndNoFootprintIsTooFarOrTooLarge) {
  test::Random random(5);
  const MipMap map(
      raster<std::uint8_t>(5, 3, 4, 255, [&](int, int, int) { return std::floor(random.uniform(0, 256)); }));
  constexpr double kWild[] = {
      0,    -0.0, 1e-320, 0.5,    -1,    3,         1e9,
      -1e9, 1e18, 1e300,  -1e300, 1e308, kInfinity, std::numeric_limits<double>::quiet_NaN()};
  for (TexelFilter filter : kFilters)
    for (Wrap wrap : kWraps)
      for (bool ends : {false, true})
        for (double u : kWild)
          for (double d : kWild) {
            Lookup lookup{wrap, wrap, filter, ends};
            lookup.uvX = {d, 0.1}, lookup.uvY = {0, d};
            if (!std::isfinite(u)) continue;
            const Texel texel = map.at({u, -u}, lookup);
            for (double v : {texel.color.r, texel.color.g, texel.color.b, texel.alpha})
              ASSERT_TRUE(v >= 0 && v <= 1) << u << " " << d << " " << v;
          }
}

TEST(MipMap, ThreadsShareOnePyramid) {
  test::Random random(6);
  const auto at = [&](int, int, int) { return std::floor(random.uniform(0, 256)); };
  const Raster picture = raster<std::uint8_t>(300, 200, 3, 255, at);
  const auto lookups = [&](int threads) {
    const MipMap map(picture);
    std::vector<double> values(64);
    Job job;
    parallelChunks(64, threads, job, [&](std::int64_t i, int) {
      Lookup lookup{.filter = TexelFilter::ewa, .srgb = i % 2 == 0};
      lookup.uvX = {0.01, 0.02}, lookup.uvY = {0.03, 0};
      values[static_cast<std::size_t>(i)] = map.at({double(i) / 64, 0.3}, lookup).color.b;
    });
    return values;
  };
  EXPECT_EQ(lookups(1), lookups(7));
}

TEST(MipMap, EightBitsTakeAByteAndHalfAsMuchMoreForThePyramid) {
  const auto grey = [](int, int, int) { return 7; };
  const MipMap map(raster<std::uint8_t>(256, 256, 3, 255, grey));
  EXPECT_EQ(map.bytes(), 3u * 256 * 256);
  Lookup lookup{.filter = TexelFilter::bilinear, .uvX = {0.1, 0}, .uvY = {0, 0.1}};
  map.at({0.5, 0.5}, lookup);
  EXPECT_EQ(map.bytes(), 3u * 256 * 256);
  lookup.filter = TexelFilter::ewa;
  map.at({0.5, 0.5}, lookup);
  EXPECT_LE(map.bytes(), 5u * 256 * 256);
  EXPECT_EQ(map.levels(), 9);
}

// --- files -----------------------------------------------------------------------------------------------

std::string bytes(std::initializer_list<int> values) {
  std::string text;
  for (int value : values) text += static_cast<char>(value);
  return text;
}

/// A PNG of one row. `kind`: 0 grey, 2 RGB, 4 grey and alpha, 6 RGB and alpha.
std::string png(int width, int bits, int kind, const std::string& row) {
  const auto big = [](unsigned long n) {
    return bytes({int(n >> 24 & 255), int(n >> 16 & 255), int(n >> 8 & 255), int(n & 255)});
  };
  const auto chunk = [&](const std::string& data) {
    const auto* start = reinterpret_cast<const Bytef*>(data.data());
    return big(data.size() - 4) + data + big(crc32(0, start, static_cast<uInt>(data.size())));
  };
  const std::string raw = std::string(1, '\0') + row;
  std::string packed(compressBound(raw.size()), '\0');
  uLongf length = packed.size();
  compress(reinterpret_cast<Bytef*>(packed.data()), &length, reinterpret_cast<const Bytef*>(raw.data()),
           raw.size());
  return "\x89PNG\r\n\x1a\n" +
         chunk("IHDR" + big(static_cast<unsigned long>(width)) + big(1) + bytes({bits, kind, 0, 0, 0})) +
         chunk("IDAT" + packed.substr(0, length)) + chunk("IEND");
}

/// A TGA of one pixel of 32 bits: blue, green, red, alpha.
std::string tga(int alphaBits, int alpha = 51) {
  return bytes({0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 1, 0, 32, alphaBits, 30, 20, 10, alpha});
}

TEST(MipMap, TransparencyOfFilesIsKept) {
  struct File {
    std::string bytes;
    bool hasAlpha;
    Texel texel;  ///< the second, or the only one
  };
  const File files[] = {
      {png(2, 8, 6, bytes({1, 2, 3, 4, 255, 0, 51, 102})), true, {{1, 0, 0.2}, 0.4}},
      {png(2, 8, 4, bytes({1, 2, 51, 102})), true, {Color(0.2), 0.4}},
      {png(2, 8, 2, bytes({1, 2, 3, 255, 0, 51})), false, {{1, 0, 0.2}, 1}},
      {png(2, 8, 0, bytes({1, 51})), false, {Color(0.2), 1}},
      {png(2, 16, 4, bytes({0, 0, 0, 0, 255, 255, 51, 51})), true, {Color(1), 0.2}},
      {tga(8), true, {Color(10, 20, 30) / 255, 0.2}},
      {tga(0), false, {Color(10, 20, 30) / 255, 1}},
      {tga(8, 0), false, {Color(10, 20, 30) / 255, 1}},  // nobody would see it
      {"P2 2 1 4 0 1", false, {Color(0.25), 1}},
      {"P6 1 1 15\n\x0f\x05\x03", false, {{1, 5 / 15.0, 0.2}, 1}},
  };
  for (const File& file : files) {
    const auto map = MipMap::decode(file.bytes, "file");
    EXPECT_EQ(map->hasAlpha(), file.hasAlpha);
    const Texel texel = map->texel(map->width() - 1, 0);
    EXPECT_EQ(texel.color, file.texel.color);
    EXPECT_EQ(texel.alpha, file.texel.alpha);
    // What shows the colours alone shows the same.
    EXPECT_EQ(decodePicture(file.bytes, "file").at(map->width() - 1, 0), file.texel.color);
  }
}

TEST(MipMap, ColoursMultipliedByAlphaAreDividedByIt) {
  Raster picture = raster<float>(2, 1, 4, 1, [](int x, int, int c) { return c == 3 ? x * 0.5 : x * 0.25; });
  picture.premultiplied = true;
  const MipMap map(picture);
  EXPECT_EQ(map.texel(1, 0).color, Color(0.5));
  EXPECT_EQ(map.texel(0, 0).color, Color(0));
  EXPECT_EQ(toPicture(picture).at(1, 0), Color(0.25));
}

TEST(MipMap, WhatIsNoNumberIsBlack) {
  const float values[] = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 2};
  const MipMap map(raster<float>(1, 1, 3, 1, [&](int, int, int c) { return values[c]; }));
  EXPECT_EQ(map.texel(0, 0).color, Color(0, 0, 2));
}

TEST(MipMap, AFileThatIsNoneSaysSo) { EXPECT_THROW(MipMap::decode("words", "file"), Error); }

}  // namespace
}  // namespace trace
