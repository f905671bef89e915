// The bits of a value as one of another type. As std::bit_cast, which not all our compilers' libraries have.
#pragma once

namespace trace {

template <class To, class From>
constexpr To bitCast(const From& from) noexcept {
  static_assert(sizeof(To) == sizeof(From));
  return __builtin_bit_cast(To, from);
}

}  // namespace trace
