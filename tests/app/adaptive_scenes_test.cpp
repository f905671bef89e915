// Adaptive sampling on our own scenes (checks.md, E5): within one level of 255 of the picture of all samples
// on 99.5 % of the pixels, with less than 40 % of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app/session.h"
#include "support/paths.h"

namespace trace::test {
namespace {

struct AdaptiveRender {
  Picture picture;
  double samples = 0;  ///< of all pixels
};

AdaptiveRender adaptively(const std::string& scene, std::vector<Choice> choices) {
  Session session;
  session.open(sourceFolder() + "/scenes/" + scene, choices);
  session.build();
  EXPECT_EQ(session.renderPicture().end, End::finished);
  AdaptiveRender all{session.picture()};
  for (const Color& count : session.film().sampleCounts().pixels) all.samples += count.r;
  return all;
}

double shareBeyondALevel(const Picture& a, const Picture& b) {
  double beyond = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const auto apart = [&](double x, double y) {
      return std::abs(std::clamp(x, 0.0, 1.0) - std::clamp(y, 0.0, 1.0)) > 1.0 / 255;
    };
    const Color &p = a.pixels[i], &q = b.pixels[i];
    beyond += apart(p.r, q.r) || apart(p.g, q.g) || apart(p.b, q.b);
  }
  return beyond / static_cast<double>(a.pixels.size());
}

TEST(AdaptiveScenes, SubdivideByItsDefaultIsWithinALevelForLessThanTwoFifthsOfTheRays) {
  for (const std::string scene : {"antialias.ray", "corners.ray", "glass.ray", "mirrors.ray"}) {
    const std::vector<Choice> few{{"width", "240", {}}, {"subdivide", "3", {}}};
    std::vector<Choice> all = few;
    all.push_back({"subdivide-threshold", "0", {}});
    const AdaptiveRender a = adaptively(scene, few), b = adaptively(scene, all);
    EXPECT_LE(shareBeyondALevel(a.picture, b.picture), 0.005) << scene;
    EXPECT_LT(a.samples, 0.4 * 64 * static_cast<double>(a.picture.pixels.size())) << scene;
  }
}

}  // namespace
}  // namespace trace::test
