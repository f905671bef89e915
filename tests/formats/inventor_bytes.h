// Binary files of Open Inventor, byte by byte.
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

namespace trace::test {

/// Of one version. Each function gives a part of the file.
struct InventorBytes {
  bool old = false;  ///< version 2.0

  static std::string number(std::uint64_t value, int bytes = 4) {
    std::string text;
    for (int i = bytes; i-- > 0;) text += static_cast<char>(value >> 8 * i);
    return text;
  }
  static std::string numbers(const std::vector<double>& values) {
    std::string text;
    for (const double v : values) text += number(std::bit_cast<std::uint32_t>(static_cast<float>(v)));
    return text;
  }
  static std::string text(const std::string& text) {
    return number(text.size()) + text + std::string((4 - text.size() % 4) % 4, '\0');
  }
  static std::string field(const std::string& name, const std::string& value, std::uint32_t flags = 0) {
    return text(name) + value + number(flags);
  }
  std::string node(const std::string& type, const std::vector<std::string>& fields) const {
    std::string all = text(type) + (old ? "" : number(0)) + number(fields.size());
    for (const std::string& field : fields) all += field;
    return all;
  }
  std::string group(const std::string& type, const std::vector<std::string>& children) const {
    const bool hasFields = !old || type != "Group";
    std::string all =
        text(type) + (old ? "" : number(2)) + (hasFields ? number(0) : "") + number(children.size());
    for (const std::string& child : children) all += child;
    return all;
  }
  std::string file(const std::string& nodes) const {
    return (old ? "#Inventor V2.0 binary  \n" : "#Inventor V2.1 binary  \n") + nodes;
  }
};

}  // namespace trace::test
