// Profiles of light that spreads in a body, and the colours of what glows, against quadrature and known
// values.
#include "shading/optics/diffusion.h"

#include <gtest/gtest.h>

#include "base/files/file.h"
#include "base/text.h"
#include "shading/library.h"
#include "shading/materials/subsurface.h"
#include "shading/optics/blackbody.h"
#include "shading/optics/substances.h"
#include "shading/textures/blackbody.h"
#include "support/paths.h"

namespace trace {
namespace {

TEST(Diffusion, ProfilesSumUpToTheAlbedo) {
  for (const Real albedo : {0.5, 0.9, 0.999})
    for (const Real index : {1.0, 1.5}) {
      const Dipole dipole(2 * albedo, 2 * (1 - albedo), index);
      Real sum = 0, before = 0;
      for (Real r = 1e-5; r < 1e4; r *= 1.002) {
        sum += dipole.profile((r + before) / 2) * kPi * (r * r - before * before);
        before = r;
      }
      EXPECT_NEAR(sum / dipole.albedo, 1, 4e-3) << albedo << " " << index;
      const NormalizedDiffusion other(2 * albedo, 2 * (1 - albedo), dipole.albedo);
      sum = before = 0;
      for (Real r = 1e-6; r < 1e4; r *= 1.002) {
        sum += other.profile((r + before) / 2) * kPi * (r * r - before * before);
        before = r;
      }
      EXPECT_NEAR(sum / dipole.albedo, 1, 2e-3) << albedo << " " << index;
    }
}

/// Equation 15 of Jensen and others: what comes out of all that goes in.
TEST(Diffusion, TheDipoleHasTheAlbedoOfItsPaper) {
  const Real reduced = 2.19 / 2.1921, inside = diffuseFresnelInside(1.5), a = (1 + inside) / (1 - inside);
  const Real root = std::sqrt(3 * (1 - reduced));
  EXPECT_NEAR(Dipole(2.19, 0.0021, 1.5).albedo,
              reduced / 2 * (1 + std::exp(-4. / 3 * a * root)) * std::exp(-root), 1e-12);
  EXPECT_NEAR(inside, 0.5964, 0.005) << "the mean over the hemisphere, from inside";
  EXPECT_NEAR(Dipole(1, 0, 1.3).albedo, 1, 1e-12);
  // Figure 5 of the paper gives what diffuse light is given back by marble: 0.83, 0.79, 0.75.
  const Color marble = Subsurface{}.albedo();
  EXPECT_NEAR(marble.r, 0.83, 0.01);
  EXPECT_NEAR(marble.g, 0.79, 0.01);
  EXPECT_NEAR(marble.b, 0.75, 0.01);
}

template <class Profile>
void expectDistancesOf(const Profile& profile) {
  constexpr int kDraws = 200000;
  for (const Real radius : {0.1, 0.5, 2.0}) {
    int within = 0;
    for (int i = 0; i < kDraws; ++i) within += profile.distance((i + 0.5) / kDraws) < radius;
    Real expected = 0;
    for (int i = 0; i < 100000; ++i) {
      const Real r = radius * (i + 0.5) / 100000;
      expected += profile.profile(r) * 2 * kPi * r * radius / 100000;
    }
    EXPECT_NEAR(static_cast<Real>(within) / kDraws, expected / profile.albedo, 1e-4) << radius;
  }
}

TEST(Diffusion, DistancesAreChosenAsOftenAsTheProfileSays) {
  expectDistancesOf(Dipole(2, 0.1, 1.4));
  expectDistancesOf(Dipole(1, 0, 1));
  expectDistancesOf(NormalizedDiffusion(2, 0.1, 0.6));
}

TEST(Blackbody, IsAsBrightAsItIsHot) {
  const auto brightness = [](const Color& c) { return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b; };
  EXPECT_NEAR(brightness(blackbodyColor(1900)), 1, 1e-3);
  EXPECT_EQ(blackbodyColor(400), Color(0));
  // White point of 6504 kelvin on Planck's curve: slightly pink beside D65, nearly white.
  const Color white = blackbodyColor(6504) / brightness(blackbodyColor(6504));
  EXPECT_NEAR(white.r, 1, 0.06);
  EXPECT_NEAR(white.g, 1, 0.06);
  EXPECT_NEAR(white.b, 1, 0.06);
  const Color candle = blackbodyColor(1900);
  EXPECT_GT(candle.r, 3 * candle.g / 1.6);
  EXPECT_LT(candle.b, 0.1 * candle.r);
  EXPECT_GT(brightness(blackbodyColor(2200)), 2.5) << "an eighth hotter";
}

TEST(Translucents, AreMaterialsOfTheirCoefficients) {
  for (const Translucent& t : translucents()) {
    const auto material = libraryMaterial(t.name);
    ASSERT_TRUE(material) << t.name;
    const auto* model = material->model.as<Subsurface>();
    ASSERT_TRUE(model) << t.name;
    EXPECT_EQ(model->scatters, t.scatters);
    EXPECT_EQ(model->absorbs, t.absorbs);
    EXPECT_EQ(model->index, t.index);
    EXPECT_FALSE(t.source.empty());
  }
}

TEST(Translucents, ThePageHasEachWithTheNumbersOfTheTable) {
  const std::string page = readFile(test::sourceFolder() + "/docs/subsurface.md");
  const auto text = [](const Color& c) {
    return "(" + toText(c.r) + ", " + toText(c.g) + ", " + toText(c.b) + ")";
  };
  for (const Translucent& t : translucents()) {
    const std::string row = "| " + std::string(t.name) + " | " + text(t.scatters) + " | " + text(t.absorbs) +
                            " | " + toText(t.index) + " | " + std::string(t.source) + " |\n";
    EXPECT_NE(page.find(row), std::string::npos) << row;
  }
}

}  // namespace
}  // namespace trace
