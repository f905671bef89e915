#include "formats/ubc/ubc_recognition.h"

#include <algorithm>
#include <cstddef>

#include "formats/ubc/ubc_format.h"

namespace trace {
namespace ubc {
namespace {

constexpr std::array<std::string_view, 3> kMoreCommands{"Camera", "Resolution", "Supersampling"};

bool isCommand(std::string_view word) {
  return std::find(kCommands.begin(), kCommands.end(), word) != kCommands.end() ||
         std::find(kMoreCommands.begin(), kMoreCommands.end(), word) != kMoreCommands.end();
}

/// The first word of a line, "" if it has none.
std::string_view firstWord(std::string_view line) {
  const std::size_t start = line.find_first_not_of(" \t\r");
  if (start == std::string_view::npos || line[start] == '#') return {};
  if (line.find('{') != std::string_view::npos) return "{";  // nodes of other formats have the same names
  line.remove_prefix(start);
  return line.substr(0, line.find_first_of(" \t\r#\""));
}

}  // namespace

Beginning beginning(std::string_view bytes) {
  constexpr std::size_t kFarEnough = 1 << 16;
  Beginning result;
  bytes = bytes.substr(0, kFarEnough);
  for (bool any = false; !bytes.empty();) {
    const std::string_view line = bytes.substr(0, bytes.find('\n'));
    const std::string_view word = firstWord(line);
    if (!word.empty()) {
      if (isCommand(word)) {
        ++result.commands;
        result.first |= !any;
      }
      result.old |= word == "Resolution" || word == "Camera";
      any = true;
    }
    bytes.remove_prefix(std::min(line.size() + 1, bytes.size()));
  }
  return result;
}

}  // namespace ubc

bool recognisesUbc(std::string_view bytes) {
  const ubc::Beginning found = ubc::beginning(bytes);
  return found.first || found.commands >= 2;
}

}  // namespace trace
