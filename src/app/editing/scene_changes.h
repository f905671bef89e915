// The meaning of an edit for a list of the scene's parts that a window shows: which one came, or went.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace trace {

/// The index in `more` of the one thing that `fewer` has not; nothing if the lists differ otherwise.
template <class Thing>
std::optional<std::size_t> oneMore(const std::vector<Thing>& fewer, const std::vector<Thing>& more) {
  if (more.size() != fewer.size() + 1) return {};
  const auto at = std::mismatch(fewer.begin(), fewer.end(), more.begin()).second;
  if (!std::equal(at + 1, more.end(), fewer.begin() + (at - more.begin()))) return {};
  return static_cast<std::size_t>(at - more.begin());
}

/// A name that an object or a light of `after` has come to share with another one since `before`, by which
/// links mean both; "" for none.
std::string sharedName(const Scene& before, const Scene& after);

/// Where objects or lights have other names in `after` than in `before`, links continue naming them, except
/// for an old name that another one still has.
void followNames(const Scene& before, Scene& after);

/// How many objects are of the material, or have a part that is: an object of a solid, a side of a surface.
std::size_t usersOf(const Scene& scene, std::uint32_t material);

}  // namespace trace
