// Wrong pictures are made of a right one, and the change is named; unrelated pictures have no cause.
#include "app/compare/diff_cause.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "image/srgb.h"

namespace trace::test {
namespace {

using Curve = PictureChange::Curve;

/// A scene without symmetry: a coloured gradient of all tones and three discs, each of another colour. The
/// picture may be moved by fractions of a pixel.
Color sceneAt(double x, double y, double width, double height) {
  Color c(0.05 + 0.9 * x / width, 0.05 + 0.7 * y / height, 0.1 + 0.3 * std::sin(0.13 * x + 0.07 * y + 1));
  const auto disc = [&](double u, double v, double radius, const Color& color) {
    const double distance = std::hypot(x - u * width, y - v * height);
    c = lerp(std::clamp(radius * height - distance + 0.5, 0.0, 1.0), c, color);
  };
  disc(0.3, 0.3, 0.2, {0.9, 0.2, 0.1});
  disc(0.72, 0.4, 0.15, {0.1, 0.6, 0.3});
  disc(0.45, 0.8, 0.1, {0.02, 0.04, 0.9});
  return clamp01(c);
}

Picture scenePicture(int width, int height, double right = 0, double down = 0) {
  Picture picture(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      picture.at(x, y) = sceneAt(x + 0.5 - right, y + 0.5 - down, width, height);
  return picture;
}

/// As a file of 8 bits a channel holds it.
LoadedPicture levelsOf(const Picture& picture, Rounding rounding = Rounding::nearest) {
  return {fromBytes(toBytes(picture, rounding)), true};
}

LoadedPicture lightOf(Picture picture) { return {std::move(picture), false}; }

Picture mapped(Picture picture, const std::function<double(double)>& curve) {
  for (Color& c : picture.pixels) c = Color(curve(c.r), curve(c.g), curve(c.b));
  return picture;
}

std::string causeBetween(const LoadedPicture& reference, const LoadedPicture& test) {
  const auto cause = causeOfDifference(reference, test);
  return cause ? cause->change.text() : "none";
}

/// Turned by a function of (x, y) that says where the pixel comes from.
Picture turned(const Picture& from, bool swapped, const std::function<Color(int, int)>& source) {
  Picture result(swapped ? from.height : from.width, swapped ? from.width : from.height);
  for (int y = 0; y < result.height; ++y)
    for (int x = 0; x < result.width; ++x) result.at(x, y) = source(x, y);
  return result;
}

TEST(DifferenceCause, TurnsAreNamed) {
  for (const int height : {48, 61, 64}) {
    const int width = 64;
    const Picture p = scenePicture(width, height);
    const int right = width - 1, bottom = height - 1;
    struct {
      const char* text;
      bool swapped;
      std::function<Color(int, int)> source;
    } const cases[] = {
        {"mirrored left to right", false, [&](int x, int y) { return p.at(right - x, y); }},
        {"upside down", false, [&](int x, int y) { return p.at(x, bottom - y); }},
        {"turned by 180 degrees", false, [&](int x, int y) { return p.at(right - x, bottom - y); }},
        {"with rows and columns exchanged", true, [&](int x, int y) { return p.at(y, x); }},
        {"turned by 90 degrees clockwise", true, [&](int x, int y) { return p.at(y, bottom - x); }},
        {"turned by 90 degrees counterclockwise", true, [&](int x, int y) { return p.at(right - y, x); }},
        {"mirrored at its rising diagonal", true, [&](int x, int y) { return p.at(right - y, bottom - x); }},
    };
    for (const auto& [text, swapped, source] : cases) {
      const Picture changed = turned(p, swapped, source);
      const auto cause = causeOfDifference(levelsOf(p), levelsOf(changed));
      ASSERT_TRUE(cause.has_value()) << text << ", height " << height;
      EXPECT_EQ(cause->change.text(), text) << height;
      EXPECT_EQ(cause->rmse, 0) << text;
      EXPECT_EQ(causeBetween(lightOf(p), lightOf(changed)), text);
    }
  }
}

TEST(DifferenceCause, OrdersOfChannelsAreNamed) {
  const Picture p = scenePicture(64, 48);
  struct {
    const char *name, *text;
    Color (*order)(const Color&);
  } const cases[] = {
      {"BGR", "with red and blue exchanged", [](const Color& c) { return Color(c.b, c.g, c.r); }},
      {"GRB", "with red and green exchanged", [](const Color& c) { return Color(c.g, c.r, c.b); }},
      {"RBG", "with green and blue exchanged", [](const Color& c) { return Color(c.r, c.b, c.g); }},
      {"GBR", "with its channels in the order green, blue, red",
       [](const Color& c) { return Color(c.g, c.b, c.r); }},
      {"BRG", "with its channels in the order blue, red, green",
       [](const Color& c) { return Color(c.b, c.r, c.g); }},
  };
  for (const auto& [name, text, order] : cases) {
    Picture changed = p;
    for (Color& c : changed.pixels) c = order(c);
    const auto cause = causeOfDifference(levelsOf(p), levelsOf(changed));
    ASSERT_TRUE(cause.has_value()) << name;
    EXPECT_EQ(cause->change.channels.name, name);
    EXPECT_EQ(cause->change.text(), text);
    EXPECT_EQ(cause->rmse, 0);
  }
}

TEST(DifferenceCause, CurvesAreNamedInBothDirections) {
  const auto power = [](double exponent) { return [exponent](double v) { return std::pow(v, exponent); }; };
  struct {
    const char* text;
    std::function<double(double)> curve;
  } const cases[] = {
      {"encoded as sRGB", srgbOfLinear},
      {"decoded from sRGB to linear values", linearOfSrgb},
      {"with a gamma of 2.2 applied", power(1 / 2.2)},
      {"with a gamma of 2.2 removed", power(2.2)},
      {"with a gamma of 1.8 applied", power(1 / 1.8)},
      {"with a gamma of 1.8 removed", power(1.8)},
  };
  const Picture p = scenePicture(64, 48);
  for (const auto& [text, curve] : cases) {
    const Picture changed = mapped(p, curve);
    for (Rounding rounding : {Rounding::nearest, Rounding::truncate}) {
      const auto cause = causeOfDifference(levelsOf(p, rounding), levelsOf(changed, rounding));
      ASSERT_TRUE(cause.has_value()) << text;
      EXPECT_EQ(cause->change.text(), text);
      EXPECT_LT(cause->rmse, 1e-9) << text << ": a level stands for all values that it may come from";
    }
    EXPECT_EQ(causeBetween(lightOf(p), lightOf(changed)), text);
    EXPECT_EQ(causeBetween(lightOf(p), levelsOf(changed)), text);
    EXPECT_EQ(causeBetween(levelsOf(p), lightOf(changed)), text);
  }
}

TEST(DifferenceCause, BrightnessIsNamedAlsoWhereItIsClipped) {
  const Picture p = scenePicture(64, 48);
  for (const double factor : {0.25, 0.5, 0.9, 1.1, 1.5, 2.0, 3.0}) {
    const Picture changed = mapped(p, [factor](double v) { return v * factor; });
    const auto cause = causeOfDifference(levelsOf(p), levelsOf(changed));
    ASSERT_TRUE(cause.has_value()) << factor;
    EXPECT_EQ(cause->change.curve, Curve::scale) << factor;
    EXPECT_NEAR(cause->change.factor, factor, 0.02 * factor);
    EXPECT_LT(cause->rmse, 1) << factor;
    const auto light = causeOfDifference(lightOf(p), lightOf(changed));
    ASSERT_TRUE(light.has_value());
    EXPECT_NEAR(light->change.factor, factor, 1e-9);
  }
  const Picture encoded = mapped(p, srgbOfLinear),
                half = mapped(p, [](double v) { return srgbOfLinear(v / 2); });
  const auto cause = causeOfDifference(levelsOf(encoded), levelsOf(half));
  ASSERT_TRUE(cause.has_value());
  EXPECT_EQ(cause->change.curve, Curve::lightScale) << cause->change.text();
  EXPECT_NEAR(cause->change.factor, 0.5, 0.01);
}

TEST(DifferenceCause, ShiftsOfHalvesAndWholePixelsAreNamed) {
  const Picture p = scenePicture(96, 72);
  for (const double right : {-1.0, -0.5, 0.0, 0.5, 1.0})
    for (const double down : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
      if (right == 0 && down == 0) continue;
      const auto cause = causeOfDifference(levelsOf(p), levelsOf(scenePicture(96, 72, right, down)));
      ASSERT_TRUE(cause.has_value()) << right << " " << down;
      EXPECT_EQ(cause->change.right, right);
      EXPECT_EQ(cause->change.down, down);
      EXPECT_EQ(cause->change.parts(), 1) << cause->change.text();
    }
  const auto cause = causeOfDifference(levelsOf(p), levelsOf(scenePicture(96, 72, 0.5, -1)));
  EXPECT_EQ(cause->change.text(), "moved half a pixel to the right and one pixel up");
}

TEST(DifferenceCause, SeveralPartsAreNamedTogether) {
  const Picture p = scenePicture(64, 64);
  const Picture upright = scenePicture(64, 64, 0, 1);
  Picture wrong = turned(upright, false, [&](int x, int y) { return upright.at(x, 63 - y); });
  for (Color& c : wrong.pixels) c = Color(c.b, c.g, c.r);
  wrong = mapped(wrong, [](double v) { return v / 2; });
  const auto cause = causeOfDifference(levelsOf(p), levelsOf(wrong));
  ASSERT_TRUE(cause.has_value());
  EXPECT_EQ(cause->change.parts(), 4) << cause->change.text();
  EXPECT_TRUE(
      cause->change.text().starts_with("upside down, with red and blue exchanged, with its values times 0.5"))
      << cause->change.text();
  EXPECT_EQ(cause->change.down, -1);
}

TEST(DifferenceCause, CurvesAreToldApartInShiftedPicturesToo) {
  const Picture p = scenePicture(96, 72), moved = scenePicture(96, 72, 1, 0);
  EXPECT_EQ(causeBetween(levelsOf(p), levelsOf(mapped(moved, srgbOfLinear))),
            "encoded as sRGB and moved one pixel to the right");
  EXPECT_EQ(causeBetween(levelsOf(p), levelsOf(mapped(moved, [](double v) { return std::pow(v, 1 / 2.2); }))),
            "with a gamma of 2.2 applied and moved one pixel to the right");
}

TEST(DifferenceCause, ADifferenceThatIsLeftIsMeasured) {
  const Picture p = scenePicture(64, 64);
  Picture wrong = turned(p, false, [&](int x, int y) { return p.at(x, 63 - y); });
  for (int y = 20; y < 23; ++y)
    for (int x = 20; x < 23; ++x) wrong.at(x, y) = Color(1);
  const LoadedPicture a = levelsOf(p), b = levelsOf(wrong);
  const auto cause = causeOfDifference(a, b);
  ASSERT_TRUE(cause.has_value());
  const std::string text = causeText(*cause, "a.png", "b.png", "levels");
  EXPECT_TRUE(text.starts_with("b.png is a.png upside down; apart from that, RMSE ")) << text;
  EXPECT_TRUE(text.ends_with(" levels")) << text;
  EXPECT_GT(cause->rmse, 2);
  EXPECT_LT(cause->rmse, 15);
}

TEST(DifferenceCause, UnrelatedPicturesHaveNone) {
  const Picture p = scenePicture(64, 64);
  std::vector<std::pair<std::string, Picture>> others;
  others.emplace_back("one colour", mapped(p, [](double) { return 0.5; }));
  others.emplace_back("black", mapped(p, [](double) { return 0.0; }));
  others.emplace_back("inverted", mapped(p, [](double v) { return 1 - v; }));
  for (int seed = 0; seed < 20; ++seed) {
    Picture other(64, 64);
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 64; ++x) {
        const double u = 0.08 * x + seed, v = 0.11 * y + 2.3 * seed;
        other.at(x, y) = clamp01(Color(0.5 + 0.5 * std::sin(u + v), 0.5 + 0.4 * std::cos(u * 1.7 - v),
                                       0.4 + 0.4 * std::sin(v * 1.3 + seed)));
      }
    others.emplace_back("waves " + std::to_string(seed), std::move(other));
  }
  // Half of the picture is another one: no change of the whole explains it.
  Picture half = p;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 32; ++x) half.at(x, y) = p.at(x, 63 - y);
  others.emplace_back("half of it turned", std::move(half));
  for (const auto& [name, other] : others) {
    EXPECT_EQ(causeBetween(levelsOf(p), levelsOf(other)), "none") << name;
    EXPECT_EQ(causeBetween(levelsOf(other), levelsOf(p)), "none") << name;
    EXPECT_EQ(causeBetween(lightOf(p), lightOf(other)), "none") << name;
  }
}

TEST(DifferenceCause, NoiseAndRoundingHaveNone) {
  const Picture p = scenePicture(64, 64);
  std::uint32_t state = 1;
  const auto noisy = [&] {
    return mapped(p, [&](double v) {
      state = state * 1664525u + 1013904223u;
      return v + 0.1 * (static_cast<double>(state >> 8) / (1 << 24) - 0.5);
    });
  };
  EXPECT_EQ(causeBetween(levelsOf(noisy()), levelsOf(noisy())), "none");
  EXPECT_EQ(causeBetween(levelsOf(p, Rounding::nearest), levelsOf(p, Rounding::truncate)), "none");
  const Picture first = noisy(), second = noisy();
  EXPECT_EQ(causeBetween(levelsOf(first),
                         levelsOf(turned(second, false, [&](int x, int y) { return second.at(63 - x, y); }))),
            "mirrored left to right")
      << "noise hides no cause";
}

TEST(DifferenceCause, SmallBrokenAndOtherSizesHaveNone) {
  for (const auto& [width, height] : {std::pair{0, 0}, {1, 1}, {2, 9}, {3, 3}, {6, 4}, {2000, 1}})
    EXPECT_EQ(causeBetween(levelsOf(Picture(width, height)),
                           levelsOf(mapped(Picture(width, height), [](double) { return 1.0; }))),
              "none");
  EXPECT_EQ(causeBetween(levelsOf(scenePicture(64, 48)), levelsOf(scenePicture(64, 40))), "none");
  EXPECT_EQ(causeBetween(levelsOf(scenePicture(64, 48)), levelsOf(scenePicture(48, 64))), "none");
  Picture broken = scenePicture(64, 48);
  for (const double value :
       {std::numeric_limits<double>::quiet_NaN(), 1e300, -1e300, std::numeric_limits<double>::infinity()}) {
    broken.at(3, 7) = Color(value);
    causeBetween(lightOf(scenePicture(64, 48)), lightOf(broken));
    causeBetween(levelsOf(scenePicture(64, 48)), lightOf(broken));
  }
}

TEST(DifferenceCause, ASentenceNamesThePictures) {
  const Picture p = scenePicture(64, 48);
  const LoadedPicture a = levelsOf(p),
                      b = levelsOf(turned(p, false, [&](int x, int y) { return p.at(x, 47 - y); }));
  EXPECT_EQ(causeText(*causeOfDifference(a, b), "a.png", "b.png", "levels"),
            "b.png is a.png upside down; nothing else differs beyond rounding");
}

}  // namespace
}  // namespace trace::test
