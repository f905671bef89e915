#include "app/view/arrangement.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace trace {
namespace {

constexpr std::array kLook{Arrangement::Place{"Controls", Dock::hidden},
                           Arrangement::Place{"Scene", Dock::hidden}};
constexpr std::array kCompare{Arrangement::Place{"Controls", Dock::hidden},
                              Arrangement::Place{"Scene", Dock::hidden},
                              Arrangement::Place{"Rays", Dock::hidden}};

const std::array kArrangements{
    Arrangement{"Look", "the picture, and the rays of a pixel", {}, kLook},
    Arrangement{"Build", "options and scene, the picture, and the view in space", {.right = 0.36}, {}},
    Arrangement{"Compare", "the picture alone, next to another one", {}, kCompare},
};

}  // namespace

std::span<const Arrangement> arrangements() { return kArrangements; }

const Arrangement& firstArrangement(double charactersAcross) {
  constexpr double kRoom = 140;  // three columns
  return kArrangements[charactersAcross < kRoom ? 0 : 1];
}

bool hasOneColumn(double charactersAcross, double width, double height) {
  constexpr double kTwoColumns = 64;
  return charactersAcross < kTwoColumns && height > width;
}

DockSizes dockSizes(const DockShares& shares, const DocksInUse& used, double width, double height,
                    double letter, double drawer) {
  DockSizes sizes;
  constexpr double kFields = 30, kMostForFields = 0.32;  // characters; share of the window
  if (used.left)
    sizes.left =
        std::round(std::max(width * shares.left, std::min(letter * kFields, width * kMostForFields)));
  const double rest = width - sizes.left;
  sizes.right = used.right ? std::round(width * shares.right) : 0;
  if (!used.centre) sizes.right = rest;
  sizes.right = std::min(sizes.right, rest - (sizes.right < rest ? width * DockShares::kLeast : 0));
  if (used.bottom) sizes.bottom = std::round(drawer > 0 ? drawer : height * shares.bottom);
  return sizes;
}

}  // namespace trace
