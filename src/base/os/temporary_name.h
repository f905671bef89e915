// The names of files that are being written, before they take their places.
#pragma once

#include <cstdint>
#include <filesystem>
#include <random>
#include <string>
#include <string_view>

#include "base/hash.h"

namespace trace::os {

inline constexpr std::string_view kTemporaryStart = ".trace-", kTemporaryEnd = ".tmp";

/// A name in the folder that nothing has yet, as good as surely: `.trace-` and sixteen random digits.
inline std::string temporaryName(const std::string& folder) {
  std::random_device random;
  const std::uint64_t number = std::uint64_t{random()} << 32 | random();
  const std::string name = std::string(kTemporaryStart) + hexText(number) + std::string(kTemporaryEnd);
  return (std::filesystem::path(folder) / name).generic_string();
}

/// Could temporaryName() have made the name of this file?
inline bool isTemporaryName(std::string_view name) {
  constexpr std::size_t kDigits = 16;
  if (name.size() != kTemporaryStart.size() + kDigits + kTemporaryEnd.size()) return false;
  const std::string_view digits = name.substr(kTemporaryStart.size(), kDigits);
  return name.starts_with(kTemporaryStart) && name.ends_with(kTemporaryEnd) &&
         digits.find_first_not_of("0123456789abcdef") == digits.npos;
}

}  // namespace trace::os
