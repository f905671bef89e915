#include "base/huge_pages.h"

#include <gtest/gtest.h>

#if defined(__linux__)
#include <unistd.h>
#endif

#include <cstdint>
#include <fstream>

namespace trace {
namespace {

constexpr std::size_t kLeast = 2 * os::kLargePage;

[[maybe_unused]] std::size_t placeInPage(const void* p) {
  return reinterpret_cast<std::uintptr_t>(p) % os::kLargePage;
}

TEST(HugePages, LargeArraysAreWholePages) {
  HugeVector<std::uint64_t> large(kLeast / 8), odd(kLeast / 8 + 1);
#if defined(__linux__)
  EXPECT_EQ(placeInPage(large.data()), 0u);
  EXPECT_EQ(placeInPage(odd.data()), 0u);
#endif
  EXPECT_EQ(large.front(), 0u);
  odd.back() = 7;  // in a page of its own
  EXPECT_EQ(odd.back(), 7u);
}

TEST(HugePages, GrowthAndCopiesKeepWhatIsThere) {
  HugeVector<std::uint64_t> grown;
  for (std::uint64_t i = 0; i < 3 * kLeast / 8; ++i) grown.push_back(i);
  const HugeVector<std::uint64_t> copy = grown;
  grown.clear(), grown.shrink_to_fit();
  std::uint64_t expected = 0;
  for (const std::uint64_t value : copy) ASSERT_EQ(value, expected++);
}

#if defined(__linux__)
/// Bytes of address space that the process has (proc(5), statm).
std::size_t mappedBytes() {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

TEST(HugePages, MemoryIsGivenBack) {
  constexpr std::size_t kBytes = std::size_t{1} << 30;
  const std::size_t before = mappedBytes();
  ASSERT_GT(before, 0u);
  {
    HugeVector<char> held;
    held.reserve(kBytes);
    const std::size_t with = mappedBytes();
    EXPECT_GE(with, before + kBytes);
    EXPECT_LT(with, before + kBytes + os::kLargePage)
        << "what lies before and behind whole pages is given back";
  }
  for (int i = 0; i < 20; ++i) HugeVector<char>().reserve(kBytes + static_cast<std::size_t>(i));
  EXPECT_LT(mappedBytes(), before + os::kLargePage);
}
#endif

TEST(HugePages, MoreThanThereIsThrows) {
  EXPECT_THROW(HugeVector<char>().reserve(std::size_t{1} << 60), std::bad_alloc);
}

}  // namespace
}  // namespace trace
