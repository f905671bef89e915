// Rows of tables for people, as printf lays them out.
#pragma once

#include <cstdio>
#include <string>

namespace trace::cli {

/// At most 199 letters.
template <class... Args>
std::string formatted(const char* format, Args... args) {
  char text[200];
  std::snprintf(text, sizeof text, format, args...);
  return text;
}

}  // namespace trace::cli
