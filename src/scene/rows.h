// Copies in rows, columns and layers: shelves of books, a wall of windows. A reader makes an object of each.
#pragma once

#include <string_view>

#include "base/field.h"
#include "math/noise.h"
#include "math/vec.h"

namespace trace {

struct Rows {
  static constexpr std::string_view kKeyword = "rows";
  static constexpr std::string_view kHelp = "copies of objects, side by side, above and behind each other";
  static constexpr double kMostObjects = 2'000'000;

  Vec3 count{2, 1, 1}, step{1, 1, 1}, spread;
  Real sizeSpread = 0;
  int seed = 1;

  static constexpr auto fields() {
    return Fields{
        Field{"count", &Rows::count, "", 1, kMostObjects, "number of copies along x, y and z"},
        Field{"step", &Rows::step, "", -kNoLimit, kNoLimit, "distance between copies along x, y and z"},
        Field{"spread", &Rows::spread, "", 0, kNoLimit,
              "largest random offset of each copy along x, y and z"},
        Field{"size_spread", &Rows::sizeSpread, "", 0, 1, "largest random change of size, as a fraction"},
        Field{"seed", &Rows::seed, "", 0, kNoLimit, "seed of the random numbers"}};
  }
  bool operator==(const Rows&) const = default;

  /// Where copy (x, y, z) lies, and how large it is.
  struct Copy {
    Vec3 place;
    Real size;
  };
  Copy copy(int x, int y, int z) const {
    std::uint64_t bits = mixBits(static_cast<std::uint64_t>(seed));
    for (const int k : {x, y, z}) bits = mixBits(bits ^ static_cast<std::uint64_t>(k));
    const auto chance = [&] { return 2 * unitFromBits(bits = mixBits(bits)) - 1; };
    const Real dx = chance(), dy = chance(), dz = chance(), larger = chance();
    return {{x * step.x + dx * spread.x, y * step.y + dy * spread.y, z * step.z + dz * spread.z},
            1 + larger * sizeSpread};
  }
};

}  // namespace trace
