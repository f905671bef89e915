// What `ray selftest` looks at, each check by itself.
#include "app/compare/selftest.h"

#include <gtest/gtest.h>

#include <cctype>
#include <ostream>

namespace trace {

/// How the checks are called among the tests.
void PrintTo(const SelfCheck& check, std::ostream* out) {
  for (const char c : check.name) *out << (std::isalnum(static_cast<unsigned char>(c)) ? c : '_');
}

}  // namespace trace

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
