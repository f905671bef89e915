#include "image/development/anaglyph.h"

#include "base/budget.h"

namespace trace {
namespace {

constexpr Color kLuminance{0.299, 0.587, 0.114};  // Rec. 601, of the values shown
constexpr Color kRed{1, 0, 0}, kGreen{0, 1, 0}, kBlue{0, 0, 1}, kNone{0, 0, 0};

double along(const Color& row, const Color& c) { return row.r * c.r + row.g * c.g + row.b * c.b; }

}  // namespace

const Anaglyph kRedCyan{{kRed, kNone, kNone}, {kNone, kGreen, kBlue}};
const Anaglyph kHalfColor{{kLuminance, kNone, kNone}, {kNone, kGreen, kBlue}};
const Anaglyph kGrey{{kLuminance, kNone, kNone}, {kNone, kLuminance, kLuminance}};
const Anaglyph kDubois{{Color{0.4561, 0.500484, 0.176381}, Color{-0.0400822, -0.0378246, -0.0157589},
                        Color{-0.0152161, -0.0205971, -0.00546856}},
                       {Color{-0.0434706, -0.0879388, -0.00155529}, Color{0.378476, 0.73364, -0.0184503},
                        Color{-0.0721527, -0.112961, 1.2264}}};

Picture anaglyph(const Picture& both, const Anaglyph& rules) {
  Picture picture(both.width / 2, both.height);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      checkBudget();
      const Color &left = both.at(x, y), &right = both.at(x + picture.width, y);
      const auto channel = [&](std::size_t i) {
        return along(rules.left[i], left) + along(rules.right[i], right);
      };
      picture.at(x, y) = {channel(0), channel(1), channel(2)};
    }
  return picture;
}

}  // namespace trace
