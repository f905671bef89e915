// A chosen pixel stays at its place of the picture when the size changes.
#include "app/view/pixel_choice.h"

#include <gtest/gtest.h>

namespace trace::test {
namespace {

TEST(PixelChoice, KeepsItsPlaceInAPictureOfAnotherSize) {
  PixelChoice choice;
  EXPECT_FALSE(choice);
  choice.choose(200, 150, {400, 300});
  EXPECT_TRUE(choice);
  EXPECT_EQ(choice.in({400, 300}), (PixelPlace{200, 150}));
  EXPECT_EQ(choice.in({800, 600}), (PixelPlace{401, 301}));
  EXPECT_EQ(choice.in({100, 75}), (PixelPlace{50, 37}));
}

TEST(PixelChoice, ComesBackToTheSamePixelWithTheSizeAndStaysInside) {
  const Size size{37, 23};
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      PixelChoice choice;
      choice.choose(x, y, size);
      for (const Size other : {Size{1, 1}, Size{2, 3}, Size{1000, 7}, Size{36, 24}}) {
        const PixelPlace place = choice.in(other);
        EXPECT_TRUE(place.x >= 0 && place.x < other.width && place.y >= 0 && place.y < other.height);
      }
      EXPECT_EQ(choice.in(size), (PixelPlace{x, y}));
    }
}

TEST(PixelChoice, IsForgotten) {
  PixelChoice choice;
  choice.choose(1, 2, {10, 10});
  choice.clear();
  EXPECT_FALSE(choice);
}

}  // namespace
}  // namespace trace::test
