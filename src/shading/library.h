// THE library: materials that scenes may take by their names. Those that light passes are the substances of
// shading/optics/substances.h; here are metals, stones, woods, plastics and cloth.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shading/material.h"

namespace trace {

/// One that light does not pass. Patterns are solid and made for objects about as large as a unit sphere;
/// `scale` of a texture, or a transform inside the object, serves others.
struct Finish {
  std::string_view name;   ///< "red granite"
  std::string_view group;  ///< "metal", "stone", "wood", "plastic", "cloth", "matt"
  std::string_view looks;  ///< in a few words
  Material (*make)();      ///< without its name
};

std::span<const Finish> finishes();

/// The material of that name.
std::optional<Material> libraryMaterial(std::string_view name);
/// First those that light passes, then the others.
std::vector<std::string_view> libraryNames();
/// A hint for a name that it does not have: one that is spelt nearly so, else those with a word of it.
std::string nearInLibrary(std::string_view name);

}  // namespace trace
