// The pages of man, from the tables of commands, flags and options.
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace trace::cli {

inline constexpr std::array<std::string_view, 2> kManuals{"ray", "ray-studio"};
/// The page of the program, for man. Precondition: one of kManuals.
std::string manualPage(std::string_view program);

}  // namespace trace::cli
