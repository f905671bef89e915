// EXR files of layers and parts for tests: Trace writes one picture a file. Source: "OpenEXR File Layout".
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace trace::test {

/// A part, and the value of each of its channels, in the order of the alphabet, for all pixels.
struct ExrValues {
  std::string name;
  std::vector<std::pair<std::string, float>> channels;
};

inline std::string exrNumber(std::uint64_t value, int bytes = 4) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> 8 * i);
  return text;
}

/// Floats without compression; several parts are one below the other in the file.
inline std::string exrOf(const std::vector<ExrValues>& parts, int width = 2, int height = 2) {
  const bool several = parts.size() > 1;
  const auto attribute = [](const std::string& name, const std::string& type, const std::string& value) {
    return name + '\0' + type + '\0' + exrNumber(value.size()) + value;
  };
  const auto number = [](int value) { return exrNumber(static_cast<std::uint64_t>(value)); };
  const std::string window = number(0) + number(0) + number(width - 1) + number(height - 1);
  const std::string one = exrNumber(std::bit_cast<std::uint32_t>(1.0f));
  std::string file = exrNumber(20000630) + exrNumber(several ? 0x1002 : 2);
  std::vector<std::string> chunks;
  for (const ExrValues& part : parts) {
    std::string list, row;
    for (const auto& [name, value] : part.channels) {
      list += name + '\0' + number(2) + number(0) + number(1) + number(1);
      for (int x = 0; x < width; ++x) row += exrNumber(std::bit_cast<std::uint32_t>(value));
    }
    file += attribute("channels", "chlist", list + '\0') +
            attribute("compression", "compression", std::string(1, '\0')) +
            attribute("dataWindow", "box2i", window) + attribute("displayWindow", "box2i", window) +
            attribute("lineOrder", "lineOrder", std::string(1, '\0')) +
            attribute("pixelAspectRatio", "float", one) +
            attribute("screenWindowCenter", "v2f", number(0) + number(0)) +
            attribute("screenWindowWidth", "float", one);
    if (several)
      file += attribute("name", "string", part.name) + attribute("type", "string", "scanlineimage") +
              attribute("chunkCount", "int", number(height));
    file += '\0';
    for (int y = 0; y < height; ++y)
      chunks.push_back((several ? number(static_cast<int>(&part - parts.data())) : "") + number(y) +
                       exrNumber(row.size()) + row);
  }
  if (several) file += '\0';
  std::size_t at = file.size() + 8 * chunks.size();
  for (const std::string& chunk : chunks) {
    file += exrNumber(at, 8);
    at += chunk.size();
  }
  for (const std::string& chunk : chunks) file += chunk;
  return file;
}

/// Red 1, 2 and 3 in the picture, in a layer of it, and in a second part; and a depth of 9.
inline std::string layeredExr(int width = 2, int height = 2) {
  return exrOf(
      {{"beauty", {{"B", 0}, {"G", 0}, {"R", 1}, {"Z", 9}, {"left.B", 0}, {"left.G", 0}, {"left.R", 2}}},
       {"shine", {{"B", 0}, {"G", 0}, {"R", 3}}}},
      width, height);
}

}  // namespace trace::test
