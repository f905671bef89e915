#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "shading/texture.h"
#include "shading/texture_list.h"

namespace trace {
namespace {

TexturePlace at(const Vec3& point, const Vec2& uv = {}) {
  TexturePlace place;
  place.point = point, place.uv = uv;
  return place;
}

/// With a pixel that wide along x and y.
TexturePlace wide(const Vec3& point, Real width) {
  return {.point = point,
          .uv = {point.x, point.y},
          .uvX = {width, 0},
          .uvY = {0, width},
          .pointX = {width, 0, 0},
          .pointY = {0, width, 0}};
}

/// Points all over a cube of side 20, the k-th.
Vec3 spread(int k) {
  return {20 * Lattice(k * 0.8191725133961645).rest - 10, 20 * Lattice(k * 0.6710436067037893).rest - 10,
          20 * Lattice(k * 0.5497004779019703).rest - 10};
}

void expectNear(const Color& a, const Color& b, Real tolerance) {
  EXPECT_NEAR(a.r, b.r, tolerance);
  EXPECT_NEAR(a.g, b.g, tolerance);
  EXPECT_NEAR(a.b, b.b, tolerance);
}

// --- all of them ----------------------------------------------------------------------------------------

template <class Visit>
void forEachPattern(const Visit& visit) {
  forEachType<TextureList>([&](auto* type) {
    using Model = std::remove_pointer_t<decltype(type)>;
    SCOPED_TRACE(std::string(Model::kKeyword));
    visit(Model{});
  });
}

TEST(Textures, HaveKeywordsOfTheirOwn) {
  std::vector<std::string_view> words;
  forEachPattern([&](const auto& model) {
    words.push_back(model.kKeyword);
    EXPECT_FALSE(model.kHelp.empty());
    forEachField<std::remove_cvref_t<decltype(model)>>([](const auto& f) {
      EXPECT_FALSE(f.help.empty());
      EXPECT_FALSE(f.help.ends_with('.'));
    });
  });
  std::sort(words.begin(), words.end());
  EXPECT_EQ(std::adjacent_find(words.begin(), words.end()), words.end());
}

TEST(Textures, AreFiniteWhereverThePlaceIs) {
  forEachPattern([](const auto& model) {
    for (const Real far : {0.0, 1.0, 1e9, 1e100, -1e300})
      for (const Real width : {0.0, 1e-9, 1.0, 1e300}) {
        const Color c = model.at(wide({far, -far, far}, width));
        EXPECT_TRUE(isFinite(c)) << far << " " << width;
      }
  });
}

// Sums of noise and filters over a pixel change little from one pixel to the next.
TEST(Textures, AreOneColourSeenFromAfar) {
  forEachPattern([](const auto& model) {
    using Model = std::remove_cvref_t<decltype(model)>;
    if constexpr (std::is_same_v<Model, Checker> || std::is_same_v<Model, Noise> ||
                  std::is_same_v<Model, Granite> || std::is_same_v<Model, Clouds>) {
      const Real high = 0.5;  // along z a pixel is not wide
      const Color c = model.at(wide({0.3, 0.1, high}, 1000));
      expectNear(model.at(wide({7.4, -3.2, high}, 1000)), c, 0.002);
    }
  });
}

TEST(Textures, EqualOnlyThemselves) {
  const Texture one(TextureNode{.model = Checker{}}), same(TextureNode{.model = Checker{}});
  Checker red;
  red.a = {1, 0, 0};
  EXPECT_EQ(one, same);
  EXPECT_NE(one, Texture(TextureNode{.model = red}));
  EXPECT_NE(one, Texture(TextureNode{.model = Brick{}}));
}

// --- checker --------------------------------------------------------------------------------------------

TEST(Checker, ChangesFromCubeToCube) {
  const Checker checker;
  for (int x = -2; x < 3; ++x)
    for (int y = -2; y < 3; ++y)
      for (int z = -2; z < 3; ++z)
        EXPECT_EQ(checker.at(at({x + 0.5, y + 0.5, z + 0.5})), (x + y + z) % 2 == 0 ? checker.a : checker.b);
}

TEST(Checker, SquaresLieInUAndV) {
  Checker checker;
  checker.space = TextureSpace::uv;
  EXPECT_EQ(checker.at(at({9.5, 3.5, 1.5}, {0.5, 0.5})), checker.a);
  EXPECT_EQ(checker.at(at({}, {1.5, 0.5})), checker.b);
  EXPECT_EQ(checker.at(at({}, {-0.5, -0.5})), checker.a);
}

// A square at z = 0 that was turned has points a little above and below.
TEST(Checker, HasOneColourOnTheFaceOfCubes) {
  const Checker checker;
  for (const Real z : {-1e-16, 0.0, 1e-16}) {
    TexturePlace place = wide({0.5, 0.5, z}, 0.01);
    place.pointX.z = 1e-17;  // that of a pixel on a turned square
    EXPECT_EQ(checker.at(place), checker.a);
    EXPECT_EQ(checker.at(at({0.5, 0.5, z})), checker.a);
    place.point = {1e6 + 1.5, 0.5, z};
    EXPECT_EQ(checker.at(place), checker.b);
  }
}

// The mean over the pixel, by a fine grid.
TEST(Checker, IsFilteredByTheBoxOfAPixel) {
  const Checker checker;
  for (const Real width : {0.1, 0.7, 1.0, 1.3, 2.0, 5.25})
    for (int k = 0; k < 20; ++k) {
      const Vec3 p = spread(k);
      Real sum = 0;
      constexpr int kGrid = 200;
      for (int i = 0; i < kGrid; ++i)
        for (int j = 0; j < kGrid; ++j)
          sum += checker.at(at(p + Vec3{(i + 0.5) / kGrid - 0.5, (j + 0.5) / kGrid - 0.5, 0} * width)).r;
      EXPECT_NEAR(checker.at(wide(p, width)).r, sum / (kGrid * kGrid), 0.03) << width << " " << k;
    }
}

// --- brick ----------------------------------------------------------------------------------------------

TEST(Brick, HasJointsBetweenBricksThatCoursesMove) {
  const Brick brick;  // 1 by 0.4 by 0.5, joints 0.06 wide
  const auto isBrick = [&](Real x, Real y) { return brick.at(at({x, y, 0.25})) == brick.a; };
  EXPECT_TRUE(isBrick(0.5, 0.2));
  EXPECT_TRUE(isBrick(0.031, 0.2));
  EXPECT_FALSE(isBrick(0.029, 0.2));
  EXPECT_FALSE(isBrick(0.971, 0.2));
  EXPECT_TRUE(isBrick(0.969, 0.2));
  EXPECT_FALSE(isBrick(0.5, 0.029));
  EXPECT_TRUE(isBrick(0.5, 0.031));
  EXPECT_TRUE(isBrick(0.0, 0.6));  // the next course
  EXPECT_FALSE(isBrick(0.5, 0.6));
  EXPECT_EQ(brick.at(at({0.5, 0.2, 0.01})), brick.b);
}

TEST(Brick, IsItsMeanFromAfar) {
  Brick brick;
  brick.space = TextureSpace::uv;
  const Real share = (1 - 0.06) * (1 - 0.06 / 0.4);
  expectNear(brick.at(wide({0.1, 0.7, 0}, 1e6)), lerp(share, brick.b, brick.a), 1e-4);
}

TEST(Brick, WithoutLengthHasNoJoints) {
  Brick planks;
  planks.size = {0, 0.4, 0};
  EXPECT_EQ(planks.at(at({17, 0.2, 3})), planks.a);
  EXPECT_EQ(planks.at(at({17, 0.4, 3})), planks.b);
}

// --- solid ----------------------------------------------------------------------------------------------

// The mean and the standard deviation over a plane, as POV-Ray 3.7 has them for its own noise.
TEST(SolidPatterns, NoiseIsSpreadAsInPovRay) {
  const auto expectSpread = [](SolidPattern kind, Real mean, Real deviation) {
    Solid solid;
    solid.kind = kind;
    constexpr int kSide = 150;
    Real sum = 0, squares = 0;
    for (int i = 0; i < kSide; ++i)
      for (int j = 0; j < kSide; ++j) {
        const Real value = solid.pattern(at({i * 0.61, j * 0.61, 0.37}));
        sum += value;
        squares += value * value;
      }
    sum /= kSide * kSide;
    EXPECT_NEAR(sum, mean, 0.045);
    EXPECT_NEAR(std::sqrt(squares / (kSide * kSide) - sum * sum), deviation, 0.015);
  };
  expectSpread(SolidPattern::bozo, 0.507, 0.115);
  expectSpread(SolidPattern::granite, 0.381, 0.154);
  expectSpread(SolidPattern::wrinkles, 0.513, 0.132);
  expectSpread(SolidPattern::agate, 0.55, 0.341);
  expectSpread(SolidPattern::crackle, 0.206, 0.162);
  expectSpread(SolidPattern::waves, 0.5, 0.122);
}

TEST(SolidPatterns, NoiseIsNotFlatOnWholeNumbers) {
  const Solid bozo;
  Real least = 1, most = 0;
  for (int i = 0; i < 100; ++i) {
    const Real value = bozo.pattern(at({static_cast<Real>(i % 10), 0, static_cast<Real>(i / 10)}));
    least = std::min(least, value);
    most = std::max(most, value);
  }
  EXPECT_GT(most - least, 0.3);
}

// The numbers are those of POV-Ray 3.7.
TEST(SolidPatterns, SpiralsAreCones) {
  Solid spiral;
  spiral.kind = SolidPattern::spiral;
  const auto value = [&](Real away, Real turn, Real z) {
    return spiral.pattern(at({away * std::cos(2 * kPi * turn), away * std::sin(2 * kPi * turn), z}));
  };
  EXPECT_NEAR(value(0.05, 0.1, 0), 0.8, 1e-9);
  EXPECT_NEAR(value(0.45, 0.1, 0), 0.4, 1e-9);
  EXPECT_NEAR(value(0.2, 0.43, 0), 0.24, 1e-9);
  EXPECT_NEAR(value(0.2, 0.1, 0.3), 0.3, 1e-9);
  spiral.number = 3;
  EXPECT_NEAR(value(0.37, 0.01 / (2 * kPi), 0), 0.24953, 1e-4);
}

TEST(SolidPatterns, AGradientReachesTheEndOfItsMap) {
  Solid gradient;
  gradient.kind = SolidPattern::gradient;
  const auto value = [&](Real x) { return gradient.pattern(at({x, 0, 0})); };
  EXPECT_EQ(value(0), 0);
  EXPECT_EQ(value(1), 1);
  EXPECT_EQ(value(2), 0);
  EXPECT_EQ(value(-0.25), 0.75);
}

TEST(SolidPatterns, BricksEndInMortar) {
  Solid brick;
  brick.kind = SolidPattern::brick;
  brick.axis = {8, 3, 4.5};
  brick.number = 0.5;
  const auto isBrick = [&](Real x, Real y, Real z) { return brick.pattern(at({x, y, z})) == 1; };
  EXPECT_TRUE(isBrick(7.4, 1, 1));
  EXPECT_FALSE(isBrick(7.6, 1, 1));
  EXPECT_FALSE(isBrick(3.6, 4, 1)) << "every other layer is moved by half a brick";
  EXPECT_FALSE(isBrick(1, 2.6, 1));
  EXPECT_FALSE(isBrick(1, 1, 1.9)) << "along z it is the other layers";
  EXPECT_FALSE(isBrick(1, 4, 4.1));
  for (const Real rounding : {-1e-12, 0.0, 1e-12})
    EXPECT_TRUE(isBrick(1, rounding, 1)) << "a plane on the border of two layers";
}

// --- gradient, ramp, mix --------------------------------------------------------------------------------

TEST(Gradient, GrowsAlongItsShape) {
  Gradient g;
  g.a = Color(0), g.b = Color(1);
  EXPECT_EQ(g.at(at({0.25, 9, 9})).r, 0.25);
  EXPECT_EQ(g.at(at({-3, 0, 0})).r, 0);
  EXPECT_EQ(g.at(at({3, 0, 0})).r, 1);
  g.shape = GradientShape::radial;
  EXPECT_DOUBLE_EQ(g.at(at({0.3, 0.4, 9})).r, 0.5);
  g.shape = GradientShape::spherical;
  EXPECT_DOUBLE_EQ(g.at(at({0.2, 0.4, 0.4})).r, 0.6);
  g.shape = GradientShape::angular;
  EXPECT_DOUBLE_EQ(g.at(at({0, 2, 1})).r, 0.25);
  EXPECT_DOUBLE_EQ(g.at(at({0, -2, 1})).r, 0.75);
}

TEST(Gradient, RepeatsAsItIsTold) {
  Gradient g;
  g.a = Color(0), g.b = Color(1);
  const auto value = [&](Repeat repeat, Real x) { return g.repeat = repeat, g.at(at({x, 0, 0})).r; };
  EXPECT_DOUBLE_EQ(value(Repeat::saw, 2.25), 0.25);
  EXPECT_DOUBLE_EQ(value(Repeat::saw, -0.25), 0.75);
  EXPECT_DOUBLE_EQ(value(Repeat::triangle, 1.25), 0.75);
  EXPECT_DOUBLE_EQ(value(Repeat::smooth, 1), 1);
}

TEST(PatternColors, MixesBetweenTheStopsOfARamp) {
  PatternColors shades;
  shades.ramp = {{0.2, 1, 0, 0}, {0.4, 0, 1, 0}, {0.4, 0, 0, 1}, {1, 1, 1, 1}};
  EXPECT_EQ(shades.shade(-5), Color(1, 0, 0));
  EXPECT_EQ(shades.shade(0.2), Color(1, 0, 0));
  expectNear(shades.shade(0.3), {0.5, 0.5, 0}, 1e-12);
  EXPECT_EQ(shades.shade(0.4), Color(0, 0, 1));  // an edge
  expectNear(shades.shade(0.7), {0.5, 0.5, 1}, 1e-12);
  EXPECT_EQ(shades.shade(7), Color(1));
  shades.ramp = {{0.5, 0.1, 0.2, 0.3}};
  EXPECT_EQ(shades.shade(0.1), Color(0.1, 0.2, 0.3));
}

TEST(WaveForm, IsNearlyACosine) {
  for (Real t = -2; t < 2; t += 0.01) {
    EXPECT_NEAR(wave(WaveForm::smooth, t), (1 - std::cos(2 * kPi * t)) / 2, 0.0101) << t;
    EXPECT_NEAR(wave(WaveForm::triangle, t), 1 - std::abs(2 * (t - std::floor(t)) - 1), 1e-12);
    EXPECT_NEAR(wave(WaveForm::saw, t), t - std::floor(t), 1e-12);
  }
}

Texture constant(Real value) {
  Ramp ramp;
  ramp.a = ramp.b = Color(value);
  return TextureNode{.model = ramp};
}

TEST(Textures, NestInFieldsOfOthers) {
  Mix mix;
  mix.a = {1, 0, 0}, mix.b = {0, 0, 1}, mix.amount = 1;
  const Texture mixed = TextureNode{.model = mix, .inputs = {{"amount", constant(0.25)}}};
  expectNear(mixed.at(at({})), {0.75, 0, 0.25}, 1e-12);

  Ramp ramp;
  ramp.value = 1, ramp.ramp = {{0, 0, 0, 0}, {1, 1, 0.5, 0}};
  const Texture ramped = TextureNode{.model = ramp, .inputs = {{"value", constant(0.5)}}};
  expectNear(ramped.at(at({})), {0.5, 0.25, 0}, 1e-12);
}

// A placement moves what is nested as well.
TEST(Textures, ArePlacedWithWhatIsInThem) {
  Gradient x;
  x.a = Color(0), x.b = Color(1);
  Mix mix;
  mix.b = Color(1), mix.amount = 1;
  const Texture half =
      TextureNode{.model = x, .placement = {.scale = {0.5, 1, 1}, .translate = {0.25, 0, 0}}};
  EXPECT_NEAR(half.at(at({0.5, 0, 0})).r, 0.5, 1e-12);
  const Texture whole =
      TextureNode{.model = mix, .placement = {.rotate = {0, 0, 90}}, .inputs = {{"b", half}}};
  EXPECT_NEAR(whole.at(at({0, 0.5, 0})).r, 0.5, 1e-12);
  EXPECT_NEAR(whole.at(at({3, 0.65, 0})).r, 0.8, 1e-12);
}

// --- cells ----------------------------------------------------------------------------------------------

/// From all points of a neighbourhood.
CellDistances byBruteForce(const Vec3& p, int axes, Real jitter, std::uint32_t seed) {
  CellDistances found;
  const int deep = axes == 3 ? 4 : 0;
  for (int k = -deep; k <= deep; ++k)
    for (int j = -4; j <= 4; ++j)
      for (int i = -4; i <= 4; ++i) {
        const std::int64_t cell[3]{Lattice(p.x).whole + i, Lattice(p.y).whole + j, Lattice(p.z).whole + k};
        const Vec3 own = cellPoint(cell, axes, jitter, seed);
        const Vec3 away = Vec3{cell[0] + own.x, cell[1] + own.y, axes == 3 ? cell[2] + own.z : p.z} - p;
        const Real d = length(away);
        if (d < found.first) {
          found.second = found.first;
          found.first = d;
        } else if (d < found.second) {
          found.second = d;
        }
      }
  return found;
}

TEST(Cells, FindTheNearestTwoPoints) {
  for (const int axes : {2, 3})
    for (const Real jitter : {0.0, 0.5, 1.0})
      for (int k = 0; k < 300; ++k) {
        const CellDistances found = cellDistances(spread(k), axes, jitter, 7);
        const CellDistances wanted = byBruteForce(spread(k), axes, jitter, 7);
        EXPECT_NEAR(found.first, wanted.first, 1e-9) << k;
        EXPECT_NEAR(found.second, wanted.second, 1e-9) << k;
      }
}

TEST(Cells, WithoutJitterAreALattice) {
  const CellDistances middle = cellDistances({3.5, -1.5, 0.5}, 3, 0, 0);
  EXPECT_DOUBLE_EQ(middle.first, 0);
  EXPECT_DOUBLE_EQ(middle.second, 1);
  const CellDistances side = cellDistances({3.5, -1, 0.5}, 3, 0, 0);
  EXPECT_DOUBLE_EQ(side.first, 0.5);
  EXPECT_DOUBLE_EQ(side.second, 0.5);
}

TEST(Cells, HaveANumberForEach) {
  Cells cells;
  cells.value = CellValue::cell, cells.jitter = 0, cells.a = Color(0), cells.b = Color(1);
  EXPECT_EQ(cells.at(at({0.2, 0.3, 0.4})), cells.at(at({0.8, 0.7, 0.6})));
  EXPECT_NE(cells.at(at({0.2, 0.3, 0.4})), cells.at(at({1.2, 0.3, 0.4})));
}

// --- spots ----------------------------------------------------------------------------------------------

TEST(Spots, AreBallsInTheMiddleOfCubes) {
  const Spots spots;
  EXPECT_EQ(spots.at(at({0.5, 0.5, 0.5})), spots.a);
  EXPECT_EQ(spots.at(at({-3.5, 7.5, 0.79})), spots.a);
  EXPECT_EQ(spots.at(at({-3.5, 7.5, 0.81})), spots.b);
  EXPECT_EQ(spots.at(at({0.01, 0.01, 0.01})), spots.b);
}

TEST(Spots, KeepTheirSizeWhereverTheyAre) {
  Spots spots;
  spots.jitter = 1, spots.a = Color(1), spots.b = Color(0), spots.space = TextureSpace::uv;
  Real sum = 0;
  constexpr int kCount = 200000;
  for (int k = 0; k < kCount; ++k) sum += spots.at(at({}, {spread(k).x, spread(k).y})).r;
  EXPECT_NEAR(sum / kCount, kPi * 0.3 * 0.3, 0.005);
}

// --- marble, wood, granite, clouds ----------------------------------------------------------------------

TEST(Marble, WithoutTurbulenceIsLayers) {
  Marble marble;
  marble.turbulence = 0, marble.frequency = 2;
  EXPECT_EQ(marble.at(at({0.5, 3, 8})), marble.a);
  expectNear(marble.at(at({0.25, 3, 8})), marble.b, 1e-12);
}

TEST(Wood, WithoutTurbulenceIsRings) {
  Wood wood;
  wood.turbulence = 0, wood.fibres = 0, wood.frequency = 2, wood.wave = WaveForm::triangle;
  EXPECT_EQ(wood.at(at({0.3, 0.4, 8})), wood.a);
  expectNear(wood.at(at({0, -0.25, 1})), wood.b, 1e-12);
}

TEST(Granite, IsGreyOnTheWhole) {
  Granite granite;
  granite.a = Color(0), granite.b = Color(1);
  Real sum = 0;
  constexpr int kCount = 20000;
  for (int k = 0; k < kCount; ++k) sum += granite.at(at(spread(k))).r;
  EXPECT_NEAR(sum / kCount, 0.5, 0.03);
}

TEST(Clouds, HideAsMuchAsTheyAreTold) {
  Clouds clouds;
  clouds.a = Color(0), clouds.b = Color(1);
  const auto cover = [&](Real wanted) {
    clouds.cover = wanted;
    Real sum = 0;
    constexpr int kCount = 20000;
    for (int k = 0; k < kCount; ++k) sum += clouds.at(at(spread(k))).r;
    return sum / kCount;
  };
  EXPECT_LT(cover(0), 0.1);
  EXPECT_NEAR(cover(0.5), 0.5, 0.03);
  EXPECT_GT(cover(1), 0.9);
}

// --- formula --------------------------------------------------------------------------------------------

TEST(Formula, KnowsXYZUV) {
  Formula formula;
  formula.red = FormulaText("x + 2*y"), formula.green = FormulaText("z * u"),
  formula.blue = FormulaText("v - 1");
  EXPECT_EQ(formula.at(at({0.25, 0.125, 4}, {0.5, 1.5})), Color(0.5, 2, 0.5));
  EXPECT_EQ(formula.at(at({0, 0, 0}, {0, 0.5})), Color(0));  // never below 0
  formula.red = FormulaText("1 / x");
  EXPECT_EQ(formula.at(at({})).r, 0);
  formula.value = FormulaText("u"), formula.a = Color(0), formula.b = {1, 0, 0};
  EXPECT_EQ(formula.at(at({}, {0.5, 0})), Color(0.5, 0, 0));
}

TEST(Formula, SaysWhatItExpected) {
  try {
    FormulaText("x + w");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(error.messages().front().what.find("x, y, z, u, v"), std::string::npos);
  }
  EXPECT_THROW(Expression("u"), Error);  // a solid has none
}

}  // namespace
}  // namespace trace
