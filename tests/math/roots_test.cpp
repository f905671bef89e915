// Roots of polynomials that are made of known factors.
#include "math/roots.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "support/random.h"

namespace trace::test {
namespace {

using Coefficients = std::vector<Real>;

Coefficients operator*(const Coefficients& p, const Coefficients& q) {
  Coefficients r(p.size() + q.size() - 1);
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t k = 0; k < q.size(); ++k) r[i + k] += p[i] * q[k];
  return r;
}

/// Apart from each other and from the ends of [0, 1].
std::vector<Real> apart(Random& random, std::size_t count) {
  std::vector<Real> roots;
  while (roots.size() < count) {
    const Real root = random.uniform(0.02, 0.98);
    if (std::none_of(roots.begin(), roots.end(), [&](Real r) { return std::abs(r - root) < 0.02; }))
      roots.push_back(root);
  }
  std::sort(roots.begin(), roots.end());
  return roots;
}

TEST(Roots, ThoseOfKnownFactorsAreFound) {
  Random random(1);
  for (int i = 0; i < 20000; ++i) {
    const auto degree = static_cast<std::size_t>(random.uniform(1, 10.999));
    const std::vector<Real> roots = apart(
        random,
        std::min<std::size_t>(5, static_cast<std::size_t>(random.uniform() * static_cast<Real>(degree + 1))));
    Coefficients p{random.uniform() < 0.5 ? -1.0 : 1.0};
    for (const Real root : roots) p = p * Coefficients{-root, 1};
    while (p.size() + 1 < degree) {  // without a root: (t - a)^2 + b
      const Real a = random.uniform(-1, 2), b = random.uniform(0.01, 1);
      p = p * Coefficients{a * a + b, -2 * a, 1};
    }
    const Nodes found = rootsWithEnds(p, 0, 1);
    ASSERT_EQ(found.count, roots.size() + 2) << "degree " << p.size() - 1;
    for (std::size_t k = 0; k < roots.size(); ++k) ASSERT_NEAR(found.at[k + 1], roots[k], 1e-6);
    ASSERT_EQ(found.at[0], 0);
    ASSERT_EQ(found.at[found.count - 1], 1);
  }
}

TEST(Roots, ThoseThatAreNearlyDoubleAreFoundInPairsOrNotAtAll) {
  Random random(2);
  int pairs = 0;
  for (int i = 0; i < 20000; ++i) {
    const Real a = random.uniform(0.1, 0.9), off = std::pow(10.0, random.uniform(-9, -2)),
               b = random.uniform(1.1, 3);
    const Coefficients p =
        Coefficients{a * a - off * off, -2 * a, 1} * Coefficients{b, 1} * Coefficients{b * b, -b, 1};
    const Nodes found = rootsWithEnds(p, 0, 1);
    ASSERT_TRUE(found.count == 2 || found.count == 4) << off;
    if (off > 1e-6) {
      ASSERT_EQ(found.count, 4u) << off;
      EXPECT_NEAR(found.at[1], a - off, 1e-2 * off);
      EXPECT_NEAR(found.at[2], a + off, 1e-2 * off);
      ++pairs;
    }
  }
  EXPECT_GT(pairs, 5000);
}

TEST(Roots, VariationsBoundTheNumberOfRoots) {
  Random random(3);
  for (int i = 0; i < 20000; ++i) {
    Coefficients p(5 + static_cast<std::size_t>(random.uniform(0, 3)));
    for (Real& c : p) c = random.uniform(-1, 1);
    const Nodes found = rootsWithEnds(p, -0.7, 0.9);
    ASSERT_LE(static_cast<int>(found.count) - 2, signVariations(p, -0.7, 0.9));
  }
}

/// The changes of sign that a walk over the nodes finds, as (place, negative before).
std::vector<std::pair<Real, bool>> changes(const Coefficients& p, const std::vector<Real>& nodes) {
  std::vector<std::pair<Real, bool>> found;
  const auto f = [&](Real t) { return evaluate(p, t); };
  SignWalk walk{nodes.front(), f(nodes.front()).value < 0};
  for (const Real node : nodes)
    if (walk.at < node) walk.to(node, f, [&](Real t, bool negative) { found.emplace_back(t, negative); });
  return found;
}

TEST(SignWalk, FindsTheChangesBetweenExtremaInOrder) {
  const Coefficients p{-6, 11, -6, 1};  // (t - 1) (t - 2) (t - 3)
  const Nodes nodes = extremaWithEnds(p, -1, 5);
  const auto found = changes(p, {nodes.at.begin(), nodes.at.begin() + nodes.count});
  ASSERT_EQ(found.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(found[i].first, static_cast<Real>(i + 1), 1e-12);
    EXPECT_EQ(found[i].second, i != 1);
  }
}

TEST(SignWalk, LooksAt0WhereItLiesBetween) {
  EXPECT_TRUE(changes({1, 0, 1}, {-2, 2}).empty());
  // Both roots lie between the nodes, one on each side of 0.
  EXPECT_EQ(changes({-1, 0, 4}, {-2, 2}).size(), 2u);
  EXPECT_TRUE(changes({-1, 0, 4}, {0.0, 0.0}).empty());
}

TEST(SignWalk, AChangeWithoutAWayIsWhereItStands) {
  SignWalk walk{2, false};
  std::vector<Real> found;
  const auto root = [](Real, Real, bool) { return kInfinity; };
  walk.to(2, true, root, [&](Real t, bool) { found.push_back(t); });
  walk.to(3, true, root, [&](Real t, bool) { found.push_back(t); });
  EXPECT_EQ(found, std::vector<Real>{2});
  EXPECT_EQ(walk.at, 3);
  EXPECT_TRUE(walk.negative);
}

}  // namespace
}  // namespace trace::test
