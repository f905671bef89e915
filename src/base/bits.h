// Functions of <bit> that some standard libraries lack, Emscripten's among them.
#pragma once

#include <cstdint>

namespace trace {

/// The bits of a value as one of another type: std::bit_cast.
template <class To, class From>
constexpr To bitCast(const From& from) noexcept {
  static_assert(sizeof(To) == sizeof(From));
  return __builtin_bit_cast(To, from);
}

/// std::rotl, by 1 to 31.
constexpr std::uint32_t rotateLeft(std::uint32_t bits, int by) { return bits << by | bits >> (32 - by); }

}  // namespace trace
