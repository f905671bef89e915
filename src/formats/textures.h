// The pictures that a file names for its materials. Trace does not render them yet: a material keeps the
// names of those that give one of its fields (Material::maps), and one warning for each file tells which they
// are.
//
// All readers share this, so that no texture vanishes without a word and a file of a hundred has one warning.
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace trace {

class Textures {
 public:
  /// Notes a texture by its name as the file gives it. The first one gives the warning its place.
  void note(std::string_view name, const Place& place);
  bool empty() const { return names_.empty(); }

  /// Warns if there was one. `instead` says what is seen in their place.
  void report(Messages& messages, std::string_view instead = "the material's own colour") const;

 private:
  std::string warning() const;

  Place place_;
  std::vector<std::string> names_;  ///< each once
  std::set<std::string, std::less<>> known_;
};

}  // namespace trace
