// A set of the values of a small enum; a plain value.
#pragma once

#include <cstdint>
#include <initializer_list>

namespace trace {

/// Precondition: the values of Enum are from 0 to 63.
template <class Enum>
class EnumSet {
 public:
  constexpr EnumSet() = default;
  constexpr EnumSet(std::initializer_list<Enum> values) {
    for (Enum value : values) add(value);
  }
  constexpr bool has(Enum value) const { return (bits_ & bit(value)) != 0; }
  constexpr void add(Enum value) { bits_ |= bit(value); }
  constexpr EnumSet operator|(const EnumSet& other) const {
    EnumSet both(*this);
    both.bits_ |= other.bits_;
    return both;
  }
  constexpr bool empty() const { return bits_ == 0; }
  constexpr bool operator==(const EnumSet&) const = default;

 private:
  static constexpr std::uint64_t bit(Enum value) { return std::uint64_t{1} << static_cast<unsigned>(value); }

  std::uint64_t bits_ = 0;
};

}  // namespace trace
