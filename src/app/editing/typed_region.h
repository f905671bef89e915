// The part of the picture to be rendered, as a person types it.
#pragma once

#include <string>
#include <string_view>

namespace trace {

/// As the option `region` takes it: four numbers with commas or spaces between; nothing means the whole
/// picture. Other text comes back as it is, and the option says what it expects.
std::string typedRegion(std::string_view text);

/// The text shown for a value of the option: "" for the whole picture.
std::string shownRegion(const std::string& value);

}  // namespace trace
