// Chains among the samples of a picture: they must find what samples taken one by one find.
#include "render/chains/metropolis.h"

#include <gtest/gtest.h>

#include "geometry/shapes/solids/square.h"
#include "image/srgb.h"
#include "support/quarters.h"
#include "support/rooms.h"
#include "support/scenes.h"

namespace trace::test::metropolis_test {
namespace {

TEST(PrimarySample, NumbersFillTheSquareEvenlyHoweverTheyAreMoved) {
  PrimarySample sample(1, 2, 0.03);
  constexpr int kMoves = 200000, kCells = 4;
  std::array<int, kCells * kCells> count{};
  for (int n = 0; n < kMoves; ++n) {
    n % 16 == 0 ? sample.moveAnywhere() : sample.moveNearby();
    const Vec2 u = sample.pair(7);
    ASSERT_TRUE(u.x >= 0 && u.x < 1 && u.y >= 0 && u.y < 1);
    ++count[static_cast<std::size_t>(static_cast<int>(u.x * kCells) * kCells +
                                     static_cast<int>(u.y * kCells))];
    n % 3 == 0 ? sample.undo() : sample.keep();
  }
  // Nearby numbers go together: as if a few thousand were independent.
  for (const int c : count) EXPECT_NEAR(c * 16.0 / kMoves, 1, 0.12);
}

TEST(PrimarySample, GoesBackToTheBitWhereAMoveIsUndone) {
  PrimarySample sample(3, 4, 0.1);
  const auto numbers = [&] { return std::array{sample.pair(1), sample.pair(2)}; };
  auto at = numbers();
  for (int n = 0; n < 100; ++n) {
    n % 4 == 0 ? sample.moveAnywhere() : sample.moveNearby();
    const auto offered = numbers();
    EXPECT_EQ(offered, numbers()) << "asked twice";
    EXPECT_NE(offered, at);
    if (n % 2 == 0) {
      sample.undo();
      EXPECT_EQ(numbers(), at);
    } else {
      sample.keep();
      at = offered;
      EXPECT_EQ(numbers(), at);
    }
  }
}

TEST(PrimarySample, StartsWithTheNumbersOfItsStart) {
  PrimarySample sample(9, 10, 0.1);
  StartSample start(9);
  for (std::uint64_t branch = 0; branch < 1000; ++branch)  // more than the table holds at first
    EXPECT_EQ(sample.pair(branch * 64), start.pair(branch * 64));
  sample.moveNearby();
  for (std::uint64_t branch = 0; branch < 2000; ++branch)
    EXPECT_NE(sample.pair(branch * 64), start.pair(branch * 64));
  sample.undo();
  for (std::uint64_t branch = 0; branch < 2000; ++branch)
    EXPECT_EQ(sample.pair(branch * 64), start.pair(branch * 64));
}

TEST(PrimarySample, ASmallMoveIsOfItsSize) {
  PrimarySample sample(5, 6, 0.01);
  Real squares = 0;
  constexpr int kMoves = 10000;
  for (int n = 0; n < kMoves; ++n) {
    const Vec2 before = sample.pair(1);
    sample.moveNearby();
    Real way = sample.pair(1).x - before.x;
    way -= std::round(way);  // around the circle
    squares += way * way;
    sample.keep();
  }
  EXPECT_NEAR(std::sqrt(squares / kMoves), 0.01, 0.0003);
}

// ------------------------------------------------------------------------------------------------------

/// A lamp behind a wall with a gap, which lights the floor before it; and a ball of glass there.
Scene gap(bool withGlass) {
  Scene scene;
  Phong white;
  white.diffuse = Color(0.7);
  Phong shining;
  shining.emissive = {30, 20, 10};
  Phong glass;
  glass.transmissive = glass.reflective = Color(1), glass.index = 1.5;
  const Affine floor = Affine::rotation({1, 0, 0}, -kPi / 2);
  addObject(scene, Square{}, floor * Affine::scaling({6, 6, 1}), white);
  addObject(scene, Square{}, Affine::translation({-1.1, 1, -1}) * Affine::scaling({1.6, 2, 1}), white);
  addObject(scene, Square{}, Affine::translation({1.1, 1, -1}) * Affine::scaling({1.6, 2, 1}), white);
  if (withGlass)
    addObject(scene, Sphere{}, Affine::translation({0.4, 0.3, 0}) * Affine::scaling({0.3, 0.3, 0.3}), glass);
  addObject(scene, Square{}, Affine::translation({0, 1, -2.5}) * Affine::scaling({0.8, 0.8, 1}), shining);
  scene.camera.position = {0, 2, 2.2}, scene.camera.viewdir = {0, -2, -2.2};
  scene.camera.fov = 40;
  return scene;
}

Settings chains(int spp, int width = 16) {
  Settings settings;
  settings.integrator = IntegratorKind::mlt, settings.chains = Chains::path;
  settings.width = settings.height = width;
  settings.depth = 4, settings.spp = spp, settings.chainStarts = 20000;
  settings.fresnel = Fresnel::exact;
  settings.sampling = SampleKind::sobol;
  return settings;
}

TEST(Metropolis, ShowsWhatPathsShow) {
  // Welch's test for each quarter of the picture: eight pictures of each, by other seeds.
  constexpr int kSeeds = 8;
  std::array<std::array<Real, 4>, 2> mean{}, squares{};
  for (const bool byChains : {false, true})
    for (int seed = 0; seed < kSeeds; ++seed) {
      Settings settings = chains(byChains ? 256 : 512);
      settings.seed = seed;
      settings.sampling = SampleKind::random;
      if (!byChains) settings.integrator = IntegratorKind::path;
      const auto found = quarters(picture(gap(false), settings));
      for (std::size_t q = 0; q < 4; ++q) {
        const Real light = luminanceOf(found[q]);
        mean[byChains][q] += light / kSeeds;
        squares[byChains][q] += light * light / kSeeds;
      }
    }
  for (std::size_t q = 0; q < 4; ++q) {
    const auto variance = [&](std::size_t i) {
      return (squares[i][q] - mean[i][q] * mean[i][q]) / (kSeeds - 1);
    };
    const Real error = std::sqrt(variance(0) + variance(1));
    EXPECT_NEAR(mean[0][q], mean[1][q], 4 * error) << q;
    EXPECT_LT(error, 0.05 * mean[0][q]) << "or nothing is shown";
  }
}

TEST(Metropolis, ColoursAndFiltersAreThoseOfThePicture) {
  // A plain field of light, and a filter with parts below 0: every pixel has its colour.
  Scene scene;
  Phong shining;
  shining.emissive = {0.5, 2, 0.1};
  addObject(scene, Square{}, Affine::translation({0, 0, -1}) * Affine::scaling({9, 9, 1}), shining);
  for (const FilterKind filter : {FilterKind::box, FilterKind::mitchell}) {
    Settings settings = chains(4096, 4);
    settings.filter = filter;
    Real sum = 0;
    for (const Color& c : picture(scene, settings).pixels) {
      sum += c.g / 16;
      EXPECT_NEAR(c.g, 2, 0.6);
      EXPECT_NEAR(c.r / c.g, 0.25, 1e-3);
      EXPECT_NEAR(c.b / c.g, 0.05, 1e-3);
    }
    EXPECT_NEAR(sum, 2, filter == FilterKind::box ? 0.02 : 0.1);
  }
}

TEST(Metropolis, TheSameBitsForAnyNumberOfThreadsAndAfterAStop) {
  Settings settings = chains(3, 40);
  settings.chainStarts = 3000;
  settings.passes = {Pass::depth};
  EXPECT_EQ(afterAStop(gap(true), settings, 1), sameForAnyThreads(gap(true), settings));
}

TEST(Metropolis, LookingForLightIsNoPartOfThePictureThatIsDone) {
  const Settings settings = chains(1, 8);
  const World world = build(gap(true), settings);
  const auto integrator = integratorOf(world, settings);
  const Moment moment{&world, integrator.get()};
  Job job;
  const Metropolis metropolis({&moment, 1}, settings, Size{8, 8}, job, [] {});
  EXPECT_EQ(job.done, 0);
  EXPECT_EQ(job.total, 0) << "or a watch reports the share of the first samples as that of the picture";
}

TEST(Metropolis, LooksAtTheRegionAlone) {
  Settings settings = chains(1024, 16);
  const Picture whole = picture(gap(true), settings);
  settings.region = {4, 8, 12, 16};
  const Picture part = picture(gap(true), settings);
  Color wanted, found;
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) {
      const bool within = x >= 4 && x < 12 && y >= 8;
      if (within)
        wanted += whole.at(x, y), found += part.at(x, y);
      else
        EXPECT_EQ(part.at(x, y), Color(0));
    }
  EXPECT_NEAR(luminanceOf(found) / luminanceOf(wanted), 1, 0.1);
}

TEST(Metropolis, WithoutLightThePictureIsBlack) {
  Scene scene = gap(true);
  scene.objects.pop_back();
  for (const Color& c : picture(scene, chains(4)).pixels) EXPECT_EQ(c, Color(0));
}

/// What a render of so many starts tells of its brightness, where a field of light covers what lies right of
/// x.
Real brightnessError(int starts, Real x) {
  Scene scene;
  Phong shining;
  shining.emissive = Color(2);
  addObject(scene, Square{}, Affine::translation({x + 4.5, 0, -1}) * Affine::scaling({9, 9, 1}), shining);
  Settings settings = chains(1, 8);
  settings.chainStarts = starts;
  const World world = build(scene, settings);
  Film film = makeFilm(settings, 8, 8);
  Job job;
  return render(world, settings, film, job).brightnessError;
}

TEST(Metropolis, TellsHowExactItsBrightnessIs) {
  EXPECT_LT(brightnessError(10000, 0), 0.005) << "samples are spread evenly over half a field of light";
  EXPECT_LT(brightnessError(1000, -4.5), 1e-7) << "light is everywhere";
  EXPECT_EQ(brightnessError(1000, 9), kInfinity) << "and nowhere";
  for (const Chains kind : {Chains::path, Chains::bdpt}) {
    const auto error = [&](int starts) {
      Settings settings = chains(1, 8);
      settings.chains = kind, settings.chainStarts = starts;
      const World world = build(gap(true), settings);
      Film film = makeFilm(settings, 8, 8);
      Job job;
      return render(world, settings, film, job).brightnessError;
    };
    const Real few = error(4000), many = error(64000);
    EXPECT_LT(many, 0.1);
    EXPECT_GT(few / many, 2) << static_cast<int>(kind);
    EXPECT_LT(few / many, 8) << "it falls by the root of their number";
  }
}

}  // namespace
}  // namespace trace::test::metropolis_test
