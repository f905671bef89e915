// Chains of mlt that are followed move by move.
#include "app/explain/chain_walk.h"

#include <gtest/gtest.h>

#include "geometry/shapes/solids/sphere.h"
#include "geometry/shapes/solids/square.h"
#include "support/scenes.h"

namespace trace::test {
namespace {

std::shared_ptr<const Session> chainSession(Chains chains) {
  Scene scene;
  Phong shining, grey;
  shining.emissive = Color(4);
  grey.diffuse = Color(0.7);
  addObject(scene, Square{}, Affine::rotation({1, 0, 0}, -kPi / 2) * Affine::scaling({8, 8, 1}), grey);
  addObject(scene, Sphere{}, Affine::translation({0, 2, 0}) * Affine::scaling({0.3, 0.3, 0.3}), shining);
  scene.camera.position = {0, 1, 6};
  Settings settings;
  settings.width = 32;
  settings.integrator = IntegratorKind::mlt;
  settings.chains = chains;
  settings.chainStarts = 2000;
  settings.spp = 4;
  const auto session = std::make_shared<Session>();
  session->open(scene, settings);
  session->build();
  return session;
}

TEST(ChainWalk, TheRaysOfAMoveAreTheSampleThatWasOffered) {
  int elsewhere = 0;
  for (const Chains chains : {Chains::path, Chains::bdpt, Chains::veach}) {
    const ChainWalker walker(chainSession(chains), {});
    const ChainWalk walk = walker.near(16, 16, {});
    ASSERT_GT(walk.moves.size(), 100u);
    EXPECT_EQ(walk.moves[0].number, -1);
    std::vector<int> indices{walk.nearest};
    for (int i = 0; i < 300 && i < static_cast<int>(walk.moves.size()); ++i) indices.push_back(i);
    for (const int index : indices) {
      const ChainMove& move = walk.moves[static_cast<std::size_t>(index)];
      const TracedPixel pixel = walker.offered(walk, index);
      EXPECT_TRUE(sumsUp(pixel.tree()));
      ASSERT_FALSE(pixel.tree().nodes.empty());
      EXPECT_EQ(isBlack(move.brings), move.light == 0);
      const Color traced = pixel.explanation.pixel;
      if (chains == Chains::veach && move.light == 0) continue;  // no path came about: the last one is shown
      if (chains == Chains::bdpt && isBlack(traced)) {           // a path from a light came to another pixel
        elsewhere += move.light > 0;
      } else {
        EXPECT_EQ(pixel.x, move.x);
        EXPECT_EQ(pixel.y, move.y);
        for (const auto channel : {&Color::r, &Color::g, &Color::b})
          EXPECT_NEAR(move.brings.*channel, traced.*channel, 1e-12 * std::abs(traced.*channel));
      }
      EXPECT_NE(sentence(move).find(channels(move.brings) + " there"), std::string::npos);
    }
  }
  EXPECT_GT(elsewhere, 0);
}

TEST(ChainWalk, TellsThatItDidNotComeByThePixel) {
  const ChainWalker walker(chainSession(Chains::path), {});
  const ChainWalk walk = walker.near(16, -5, {});  // a pixel to which none comes
  const ChainMove& nearest = walk.moves[static_cast<std::size_t>(walk.nearest)];
  EXPECT_EQ(walker.near(nearest.x, nearest.y, {}).missed(), "");
  EXPECT_EQ(walk.missed(), "No chain followed here came to 16, -5; this one came to " +
                               std::to_string(nearest.x) + ", " + std::to_string(nearest.y) + ". ");
}

TEST(ChainWalk, EachMoveStartsWhereTheLastOneThatWasMadeLed) {
  const ChainWalker walker(chainSession(Chains::path), {});
  const ChainWalk walk = walker.near(16, 16, {});
  int made[2] = {}, offered[2] = {};  // nearby, and anywhere
  for (int i = 1; i < static_cast<int>(walk.moves.size()); ++i) {
    const ChainMove& move = walk.moves[static_cast<std::size_t>(i)];
    EXPECT_EQ(move.number, i - 1);
    EXPECT_EQ(move.before, walk.moves[static_cast<std::size_t>(walk.before(i))].light);
    EXPECT_EQ(move.chance, move.before > 0 ? std::min(1.0, move.light / move.before) : 1);
    EXPECT_TRUE(move.made || move.chance < 1);
    EXPECT_TRUE(!move.made || move.chance > 0);
    ++offered[move.kind == MoveKind::anywhere];
    made[move.kind == MoveKind::anywhere] += move.made;
  }
  EXPECT_GT(made[0], 10);
  EXPECT_EQ(walk.summary(), std::to_string(made[0]) + " of " + std::to_string(offered[0]) +
                                " moves nearby and " + std::to_string(made[1]) + " of " +
                                std::to_string(offered[1]) + " anywhere were made");
}

TEST(ChainWalk, MutationsAreToldApart) {
  const ChainWalker walker(chainSession(Chains::veach), {});
  const ChainWalk walk = walker.near(16, 16, {});
  int lens = 0;
  for (const ChainMove& move : walk.moves) {
    EXPECT_NE(move.kind, MoveKind::nearby);
    if (move.kind != MoveKind::lens) continue;
    ++lens;
    EXPECT_NE(sentence(move).find("lens, to pixel "), std::string::npos);
  }
  EXPECT_GT(lens, 10);
  EXPECT_NE(walk.summary().find(" bidirectional and "), std::string::npos) << walk.summary();
  EXPECT_NE(walk.summary().find(" of the lens were made"), std::string::npos) << walk.summary();
}

}  // namespace
}  // namespace trace::test
