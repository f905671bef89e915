// A number for bytes: equal for equal ones, and different, as far as 64 bits can tell, for different ones. No
// protection against someone who constructs two files of the same number.
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string>
#include <string_view>

namespace trace {

/// As FNV-1a (Fowler, Noll, Vo), but of eight bytes at a time, and folded so that all bits count for all.
class Hash {
 public:
  void add(std::string_view bytes) {
    std::uint64_t word = 0;
    std::size_t i = 0;
    for (; i + 8 <= bytes.size(); i += 8) {
      std::memcpy(&word, bytes.data() + i, 8);
      add(word);
    }
    word = 0;
    if (i < bytes.size()) {
      std::memcpy(&word, bytes.data() + i, bytes.size() - i);
      add(word);
    }
    value_ = (value_ ^ bytes.size()) * 0x100000001b3u;
  }
  void add(std::uint64_t word) {
    value_ = (value_ ^ word) * 0x100000001b3u;
    value_ ^= value_ >> 32;
  }

  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

/// Sixteen digits.
inline std::string hexText(std::uint64_t number) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(number));
  return text;
}

}  // namespace trace
