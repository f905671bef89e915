// What `ray selftest` looks at, each check by itself.
#include "app/selftest.h"

#include <gtest/gtest.h>

namespace trace::test {
namespace {

class Selftest : public testing::TestWithParam<SelfCheck> {};

TEST_P(Selftest, Holds) {
  const SelfCheck& check = GetParam();
  const double found = check.find();
  EXPECT_TRUE(check.holds(found)) << check.name << ": found " << found << ", expected " << check.expected
                                  << " within " << check.tolerance;
  EXPECT_FALSE(check.holds(check.expected + 2 * check.tolerance + 1)) << "it could not fail";
}

INSTANTIATE_TEST_SUITE_P(Checks, Selftest, testing::ValuesIn(selfChecks().begin(), selfChecks().end()));

}  // namespace
}  // namespace trace::test
