#include "base/parallel.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

namespace trace {
namespace {

TEST(Parallel, EachChunkOnce) {
  for (int threads : {0, 1, 2, 7, 100}) {
    std::vector<int> counts(1000);
    Job job;
    parallelChunks(1000, threads, job, [&](std::int64_t i, int) { ++counts[static_cast<size_t>(i)]; });
    EXPECT_EQ(counts, std::vector<int>(1000, 1));
    EXPECT_EQ(job.done, 1000);
    EXPECT_EQ(job.fraction(), 1);
  }
}

TEST(Parallel, NoChunksIsDone) {
  Job job;
  parallelChunks(0, 4, job, [](std::int64_t, int) { FAIL(); });
  EXPECT_EQ(job.done, 0);
}

TEST(Parallel, CancelStopsAfterTheChunksInWork) {
  Job job;
  parallelChunks(100000, 3, job, [&](std::int64_t i, int) {
    if (i == 10) job.cancel = true;
  });
  EXPECT_LT(job.done, 100000);
  EXPECT_GE(job.done, 11);
}

TEST(Parallel, WhatIsGivenUpIsNotDone) {
  Job job;
  parallelChunks(4, 1, job, [&](std::int64_t i, int) {
    if (i < 3) return;
    job.cancel = true;
    throw GivenUp{};
  });
  EXPECT_EQ(job.done, 3);
}

TEST(Parallel, ExceptionsReachTheCaller) {
  for (int threads : {1, 4}) {
    Job job;
    EXPECT_THROW(parallelChunks(1000, threads, job,
                                [](std::int64_t i, int) {
                                  if (i == 500) throw std::runtime_error("x");
                                }),
                 std::runtime_error);
  }
}

}  // namespace
}  // namespace trace
