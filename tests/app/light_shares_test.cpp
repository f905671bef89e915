// The sources of a sample's light sum up to the sample.
#include "app/explain/light_shares.h"

#include <gtest/gtest.h>

#include "app/session/session.h"
#include "support/paths.h"
#include "support/shared.h"

namespace trace::test {
namespace {

TEST(LightShares, SumUpToTheSampleInOurScenes) {
  for (const char* name : {"glass", "fog", "holes", "caustics", "jade", "cornell", "cloud", "window",
                           "uplight", "kitchen", "dappled", "underwater", "ink", "nested-glass"}) {
    Session session;
    session.open(test::sourceFolder() + "/scenes/" + name + ".ray",
                 std::vector<Choice>{{"width", "24", {}}, {"spp", "1", {}}});
    session.build();
    const Size size = session.size();
    for (int i = 0; i < 12; ++i) {
      const RayTree tree = session.explain(i * 2 % size.width, i * 5 % size.height, 0).tree;
      const RayNode& camera = tree.nodes.front();
      Color sum;
      double all = 0;
      for (const LightShare& share : lightShares(tree, session.scene())) {
        EXPECT_FALSE(share.from.empty());
        EXPECT_GT(share.share, 0);
        sum += share.brings;
        all += share.share;
      }
      const Color sample = camera.weight * camera.radiance;
      const double near = 1e-9 * (1 + maxComponent(sample));
      EXPECT_NEAR(sum.r, sample.r, near) << name << " " << i;
      EXPECT_NEAR(sum.g, sample.g, near) << name << " " << i;
      EXPECT_NEAR(sum.b, sample.b, near) << name << " " << i;
      if (!isBlack(sample)) {
        EXPECT_NEAR(all, 1, 1e-9);
      }
    }
  }
}

TEST(LightShares, NameLightsPlacesAndWays) {
  Session session;
  session.open(test::sourceFolder() + "/scenes/glass.ray", {});
  session.build();
  const RayTree tree = session.explain(200, 120, 0).tree;
  const std::vector<LightShare> shares = lightShares(tree, session.scene());
  ASSERT_FALSE(shares.empty());
  for (std::size_t i = 1; i < shares.size(); ++i) EXPECT_LE(shares[i].share, shares[i - 1].share);
  EXPECT_NE(shares.front().from.find(" on "), std::string::npos) << shares.front().from;
  EXPECT_NE(shares.front().from.find(", by refraction in "), std::string::npos) << shares.front().from;
}

}  // namespace
}  // namespace trace::test
