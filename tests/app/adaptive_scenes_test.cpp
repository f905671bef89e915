// Adaptive sampling on our own scenes (checks.md, E5): within one level of 255 of the picture of all samples
// on 99.5 % of the pixels, with less than 40 % of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app/session/session.h"
#include "support/paths.h"

namespace trace::test {
namespace {

struct AdaptiveRender {
  Picture picture;
  double samples = 0;  ///< of all pixels
  double pixels = 0;   ///< that have samples
};

AdaptiveRender adaptively(const std::string& scene, std::vector<Choice> choices) {
  Session session;
  session.open(sourceFolder() + "/scenes/" + scene, choices);
  session.build();
  EXPECT_EQ(session.renderPicture().end, End::finished);
  AdaptiveRender all{session.picture()};
  for (const Color& count : session.film().sampleCounts().pixels) {
    all.samples += count.r;
    all.pixels += count.r > 0;
  }
  return all;
}

double pixelsBeyondALevel(const Picture& a, const Picture& b) {
  double beyond = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const auto apart = [&](double x, double y) {
      return std::abs(std::clamp(x, 0.0, 1.0) - std::clamp(y, 0.0, 1.0)) > 1.0 / 255;
    };
    const Color &p = a.pixels[i], &q = b.pixels[i];
    beyond += apart(p.r, q.r) || apart(p.g, q.g) || apart(p.b, q.b);
  }
  return beyond;
}

struct Part {
  std::string scene, region;  ///< of the picture that is 240 pixels wide
};

/// Fewer samples than the `most` that a pixel has where all are taken.
void expectNearlyTheSame(const Part& part, double most, const std::vector<Choice>& few,
                         const std::vector<Choice>& all) {
  const auto rendered = [&](std::vector<Choice> choices) {
    choices.push_back({"width", "240", {}});
    choices.push_back({"region", part.region, {}});
    return adaptively(part.scene, choices);
  };
  const AdaptiveRender a = rendered(few), b = rendered(all);
  EXPECT_LE(pixelsBeyondALevel(a.picture, b.picture), 0.005 * b.pixels) << part.scene;
  EXPECT_LT(a.samples, 0.4 * most * b.pixels) << part.scene;
}

// These use parts of pictures; docs/developers/methods.md has the figures of whole ones.

TEST(AdaptiveScenes, SubdivideByItsDefaultIsWithinALevelForLessThanTwoFifthsOfTheRays) {
  for (const Part& part : {Part{"antialias.ray", "0,70,60,110"},
                           {"corners.ray", "0,40,60,80"},
                           {"glass.ray", "150,30,210,70"},
                           {"mirrors.ray", "80,70,140,110"}})
    expectNearlyTheSame(part, 64, {{"subdivide", "3", {}}},
                        {{"subdivide", "3", {}}, {"subdivide-threshold", "0", {}}});
}

TEST(AdaptiveScenes, NoiseTargetOfAThousandthIsWithinALevelForLessThanTwoFifthsOfTheSamples) {
  for (const Part& part : {Part{"antialias.ray", "60,110,120,150"},
                           {"mirrors.ray", "60,100,120,140"},
                           {"glass.ray", "180,10,240,50"}})
    expectNearlyTheSame(part, 256, {{"spp", "256", {}}, {"noise-target", "0.001", {}}},
                        {{"spp", "256", {}}, {"sampling", "sobol", {}}});
}

}  // namespace
}  // namespace trace::test
