// Letters made of strokes.
#include "image/letters.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

namespace trace::test {
namespace {

TEST(Letters, EveryCharacterHasOneOfItsOwnWithinItsLine) {
  constexpr double kHigh = 16;
  std::set<std::string> known;
  for (char c = '!'; c <= '~'; ++c) {
    const std::string letter(1, c);
    std::string strokes;
    for (const LetterStroke& stroke : letterStrokes(letter, kHigh))
      for (const Vec2& p : {stroke.from, stroke.to}) {
        EXPECT_GE(p.y, 0) << letter;
        EXPECT_LE(p.y, kHigh) << letter;
        EXPECT_LE(p.x, lettersWidth(letter, kHigh)) << letter;
        strokes += std::to_string(p.x) + " " + std::to_string(p.y) + " ";
      }
    EXPECT_FALSE(strokes.empty()) << letter;
    if (c != 'I' && c != 'l' && c != '|') {
      EXPECT_TRUE(known.insert(strokes).second) << letter;
    }
  }
}

TEST(Letters, StandSideBySideAndScale) {
  EXPECT_TRUE(letterStrokes(" ", 16).empty());
  EXPECT_GT(lettersWidth("mm", 16), 1.5 * lettersWidth("m", 16));
  EXPECT_DOUBLE_EQ(lettersWidth("ray", 32), 2 * lettersWidth("ray", 16));
  // A character of several bytes is one box.
  EXPECT_EQ(letterStrokes("\xc3\xa9", 16).size(), letterStrokes("\x01", 16).size());
}

}  // namespace
}  // namespace trace::test
