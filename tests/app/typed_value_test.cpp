// Numbers that are typed count once, when they are complete.
#include "app/editing/typed_value.h"

#include <gtest/gtest.h>

namespace trace::test {
namespace {

using Typed = TypedValue<double>;
constexpr std::optional<double> kNothing;

TEST(TypedValue, CountsOnceWhenTheFieldIsLeft) {
  Typed typed;
  EXPECT_EQ(typed.update(7, 1, true, false, 2), kNothing);
  EXPECT_EQ(typed.update(7, 2, true, false, 25), kNothing);
  EXPECT_EQ(typed.update(7, 3, true, false, 25), kNothing);
  EXPECT_EQ(typed.update(7, 4, false, false, 25), 25);  // Enter: the text is there once more
  EXPECT_EQ(typed.update(7, 5, false, false, {}), kNothing);
}

TEST(TypedValue, CountsWhenAnotherFieldTakesTheFocus) {
  Typed typed;
  typed.update(7, 1, true, false, 25);
  EXPECT_EQ(typed.update(7, 2, false, false, {}), 25);
  // With Tab the next field begins in the frame in which this one is still there.
  typed.update(7, 3, true, false, 30);
  EXPECT_EQ(typed.update(8, 3, true, false, {}), kNothing);
  EXPECT_EQ(typed.update(7, 4, false, false, {}), 30);
  EXPECT_EQ(typed.update(8, 4, true, false, 31), kNothing);
  EXPECT_EQ(typed.update(8, 5, false, false, {}), 31);
}

TEST(TypedValue, EscapeTakesItBack) {
  Typed typed;
  typed.update(7, 1, true, false, 25);
  EXPECT_EQ(typed.update(7, 2, false, true, {}), kNothing);
  EXPECT_EQ(typed.update(7, 3, false, false, {}), kNothing);
}

TEST(TypedValue, WhatWasTypedAndTakenOutAgainDoesNotCount) {
  Typed typed;
  typed.update(7, 1, true, false, 25);
  typed.update(7, 2, true, false, {});
  EXPECT_EQ(typed.update(7, 3, false, false, {}), kNothing);
}

TEST(TypedValue, AFieldThatWasHiddenBeginsAnew) {
  Typed typed;
  typed.update(7, 1, true, false, 25);
  EXPECT_EQ(typed.update(7, 9, false, false, {}), kNothing);
}

}  // namespace
}  // namespace trace::test
