#include "base/budget.h"

#include <gtest/gtest.h>

#include <thread>

#include "base/error.h"
#include "base/parallel.h"

namespace trace::test {
namespace {

using namespace std::chrono_literals;

constexpr double kNoTime = 1e-9;

/// The text of the error that `use` throws; "" if it throws none.
template <class Use>
std::string errorOf(Use use) {
  try {
    use();
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::limit);
    return error.messages().front().what;
  }
  return "";
}

void checkOften() {
  for (int i = 0; i < 100000; ++i) checkBudget();
}

TEST(Budget, WithoutOneNothingEnds) {
  checkOften();
  const Work work("doing nothing");
  lookAtBudget();
}

TEST(Budget, AnyLoopThatChecksEnds) {
  Budget budget;
  const BudgetScope scope(&budget);
  checkOften();  // no limit
  budget.limitTime(3600);
  checkOften();
  budget.limitTime(kNoTime);
  EXPECT_EQ(errorOf(checkOften), "the time limit of 1e-09 s is over");
}

TEST(Budget, SaysHowFarTheWorkIs) {
  Budget budget;
  const BudgetScope scope(&budget);
  Work objects("building the objects", 10);
  objects.reached(3);
  EXPECT_EQ(budget.outermost().first.share, 0.3);
  {
    Work triangles("smoothing", 4);
    triangles.reached(2);
    EXPECT_EQ(budget.outermost().first.share, 0.35);
  }
  EXPECT_EQ(budget.outermost().first.share, 0.3);
  Work copies("laying out copies");
  EXPECT_EQ(doingNow(), "building the objects (3 of 10 done), laying out copies");
  EXPECT_STREQ(budget.outermost().first.doing, "building the objects");
  EXPECT_EQ(budget.outermost().first.done, 3);
  budget.limitTime(kNoTime);
  EXPECT_EQ(
      errorOf([&] { copies.reached(7); }),
      "the time limit of 1e-09 s is over while building the objects (3 of 10 done), laying out copies (7 "
      "done)");
}

TEST(Budget, RemembersWhatWasBrokenOff) {
  Budget budget;
  const BudgetScope scope(&budget);
  try {
    Work outer("reading the scene", 4);
    outer.reached(1);
    const Work inner("growing a plant");
    throw std::bad_alloc();
  } catch (const std::bad_alloc&) {
  }
  EXPECT_EQ(budget.brokenOff(), "reading the scene (1 of 4 done), growing a plant");
  EXPECT_EQ(doingNow(), "");
  EXPECT_STREQ(budget.outermost().first.doing, "");
  { const Work next("checking"); }
  EXPECT_EQ(budget.brokenOff(), "");
}

TEST(Budget, ReachesTheWorkersOfAJob) {
  Budget budget;
  const BudgetScope scope(&budget);
  const Work work("tracing");
  budget.limitTime(kNoTime);
  for (int threads : {1, 4}) {
    Job job;
    EXPECT_EQ(errorOf([&] { parallelChunks(8, threads, job, [](std::int64_t, int) { checkOften(); }); }),
              "the time limit of 1e-09 s is over while tracing");
  }
}

TEST(Budget, HoldsForTheBudgetsInside) {
  Budget outer;
  outer.limitTime(kNoTime);
  Budget inner(&outer);
  const BudgetScope scope(&inner);
  std::this_thread::sleep_for(1ms);
  EXPECT_TRUE(inner.timeIsOver());
  EXPECT_EQ(errorOf(checkOften), "the time limit of 1e-09 s is over");
}

TEST(Budget, AnInnerLimitDoesNotReplaceTheOuterOne) {
  Budget outer;
  outer.limitTime(kNoTime);
  Budget inner(&outer);
  inner.limitTime(3600);
  const BudgetScope scope(&inner);
  EXPECT_EQ(errorOf(checkOften), "the time limit of 1e-09 s is over");
}

TEST(Budget, FinishesUntilThatIsTakenBack) {
  Budget budget;
  EXPECT_FALSE(budget.finishes());
  budget.letFinish();
  EXPECT_TRUE(budget.finishes());
  budget.letFinish(false);
  EXPECT_FALSE(budget.finishes());
}

TEST(Budget, AScopeGivesBackTheOneBefore) {
  Budget budget;
  budget.limitTime(kNoTime);
  const BudgetScope scope(&budget);
  {
    const BudgetScope none(nullptr);
    checkOften();
  }
  EXPECT_NE(errorOf(checkOften), "");
}

}  // namespace
}  // namespace trace::test
