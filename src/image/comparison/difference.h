// Pictures of a difference: THE table of ways to show how two pictures differ (`ray diff --show`).
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "image/picture.h"

namespace trace {

/// Two pictures of one size, and what FLIP says of each pixel (flip.h).
struct Pictures {
  const Picture& reference;
  const Picture& test;
  const std::vector<double>& flip;
};

struct Show {
  std::string_view name;
  std::string_view help;  ///< one sentence, no full stop
  /// Values from 0 to 1; differences are multiplied by `magnify` before they are shown.
  Picture (*picture)(const Pictures&, double magnify);
};

std::span<const Show> shows();

}  // namespace trace
