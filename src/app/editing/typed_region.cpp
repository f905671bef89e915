#include "app/editing/typed_region.h"

namespace trace {

constexpr const char* kWhole = "0,0,0,0";

std::string typedRegion(std::string_view text) {
  std::string region;
  bool gap = false;
  for (const char c : text) {
    if (c == ' ' || c == '\t') {
      gap = true;
      continue;
    }
    if (gap && !region.empty() && region.back() != ',' && c != ',') region += ',';
    gap = false;
    region += c;
  }
  return region.empty() ? kWhole : region;
}

std::string shownRegion(const std::string& value) { return value == kWhole ? "" : value; }

}  // namespace trace
