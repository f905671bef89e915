// Named rows of conventions: what `--like NAME` stands for. The courses and years that share the .ray
// format differ in what its numbers mean; each difference is an option of the group Conventions, and a
// convention is a value for every one of them. The renderer knows the options, never the names.
#pragma once

#include <span>
#include <string_view>

#include "scene/settings.h"

namespace trace {

struct Convention {
  std::string_view name;
  std::string_view help;  ///< whose rules these are
  Settings settings;      ///< the values of the group Conventions; the other options stay as they are
};

std::span<const Convention> conventions();
const Convention& convention(Like like);

}  // namespace trace
