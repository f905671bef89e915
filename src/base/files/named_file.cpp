#include "base/files/named_file.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "base/files/file.h"
#include "base/files/read_scope.h"

namespace trace {
namespace {

namespace fs = std::filesystem;

bool isReadable(const fs::path& path) {
  std::error_code ignored;
  return mayRead(path.generic_string()) && fs::is_regular_file(path, ignored);
}

std::string lowered(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

int hexDigit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  const int letter = (c | 32) - 'a';
  return letter >= 0 && letter < 6 ? letter + 10 : -1;
}

std::string percentDecoded(const std::string& text) {
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const int high = text[i] == '%' && i + 2 < text.size() ? hexDigit(text[i + 1]) : -1;
    const int low = high < 0 ? -1 : hexDigit(text[i + 2]);
    const int value = low < 0 ? 0 : 16 * high + low;
    plain += value > 0 ? static_cast<char>(value) : text[i];
    if (value > 0) i += 2;
  }
  return plain;
}

std::string withoutQuotes(std::string text) {
  constexpr std::string_view kAround = " \t\r\n\"'";
  const std::size_t first = text.find_first_not_of(kAround);
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(kAround) - first + 1);
}

/// The name, and what other programs would have written for it; each once.
std::vector<std::string> spellings(const std::string& name) {
  constexpr std::string_view kScheme = "file://";
  std::vector<std::string> all;
  const auto add = [&](std::string spelling) {
    if (!spelling.empty() && spelling.find('\0') == spelling.npos && mayNameFile(spelling) &&
        std::find(all.begin(), all.end(), spelling) == all.end())
      all.push_back(std::move(spelling));
  };
  add(name);
  std::string plain = withoutQuotes(name);
  add(plain);
  if (lowered(plain).starts_with(kScheme)) add(plain = plain.substr(kScheme.size()));
  std::replace(plain.begin(), plain.end(), '\\', '/');
  add(plain);
  add(percentDecoded(plain));
  return all;
}

/// The entry of the folder whose name differs at most in the case of its letters; "" if there is none.
std::string entryOfAnyCase(const fs::path& folder, const std::string& name) {
  constexpr int kMostEntries = 10000;
  if (!mayRead(folder.generic_string())) return {};
  const std::string wanted = lowered(name);
  std::string found;
  std::error_code error;
  fs::directory_iterator i(folder.empty() ? "." : folder, error);
  for (int n = 0; !error && i != fs::directory_iterator() && n < kMostEntries; i.increment(error), ++n) {
    const std::string entry = i->path().filename().generic_string();
    if (lowered(entry) == wanted && (found.empty() || entry < found)) found = entry;
  }
  return found;
}

/// folder / path, with the case of letters as the files have it.
std::optional<fs::path> inAnyCase(fs::path folder, const fs::path& path) {
  for (const fs::path& part : path) {
    std::error_code ignored;
    if (part == "." || part == ".." ||
        (mayRead((folder / part).generic_string()) && fs::exists(folder / part, ignored))) {
      folder /= part;
      continue;
    }
    const std::string entry = entryOfAnyCase(folder, part.generic_string());
    if (entry.empty()) return {};
    folder /= entry;
  }
  return folder;
}

/// The places of one spelling, the likelier first, until visit(path, folder, rest) is true. path is folder /
/// rest.
using Visit = std::function<bool(const fs::path& folder, const fs::path& rest)>;

bool besides(const fs::path& home, const fs::path& name, const Visit& visit) {
  return name.is_absolute() ? visit({}, name) : visit(home, name);
}

bool around(const fs::path& home, const fs::path& name, const Visit& visit) {
  constexpr int kFoldersAbove = 3;
  if (name.is_absolute()) return false;
  if (visit({}, name)) return true;
  fs::path folder = home;
  for (int i = 0; i < kFoldersAbove; ++i)
    if (visit(folder /= "..", name)) return true;
  return false;
}

/// The end of the name, of as many parts as fit; then its last part in the folders of the name, from the
/// innermost to that of the scene, though some may not be there.
bool byLastPart(const fs::path& home, const fs::path& name, const Visit& visit) {
  constexpr int kMostFolders = 20;
  const fs::path last = name.filename();
  if (last.empty()) return false;
  const std::vector<fs::path> parts(name.begin(), name.end());
  const std::size_t most = std::min<std::size_t>(parts.size() - 1, kMostFolders);
  for (std::size_t first = parts.size() - most; first < parts.size(); ++first) {
    fs::path end;
    for (std::size_t i = first; i < parts.size(); ++i) end /= parts[i];
    if (end.begin() != end.end() && *end.begin() != ".." && visit(home, end)) return true;
  }
  fs::path folder = name.is_absolute() ? fs::path() : name.parent_path();
  for (int i = 0; i < kMostFolders; ++i, folder = folder.parent_path()) {
    if (visit(home, folder / last)) return true;
    if (folder.empty()) return false;
  }
  return false;
}

}  // namespace

NamedFile namedFile(const std::string& from, const std::string& name) {
  const fs::path home = fs::path(from).parent_path();
  const std::vector<std::string> names = spellings(name);
  std::string found;
  const Visit exactly = [&](const fs::path& folder, const fs::path& rest) {
    const fs::path path = folder / rest;
    if (isReadable(path)) found = path.generic_string();
    return !found.empty();
  };
  const Visit anyCase = [&](const fs::path& folder, const fs::path& rest) {
    if (rest.is_absolute()) return false;
    const auto path = inAnyCase(folder, rest);
    if (path && isReadable(*path)) found = path->generic_string();
    return !found.empty();
  };
  using Search = bool (*)(const fs::path&, const fs::path&, const Visit&);
  for (const Visit* visit : {&exactly, &anyCase})
    for (const Search search : {besides, around, byLastPart})
      for (const std::string& spelling : names)
        if (search(home, spelling, *visit)) {
          if (visit == &exactly) return {found, {}};
          return {found, "\"" + name + "\" is the file \"" + fs::path(found).filename().generic_string() +
                             "\": letters differ in their case"};
        }
  return {besideFile(from, name), {}};
}

bool namesFile(const std::string& from, const std::string& name) {
  if (!mayNameFile(name)) return false;
  std::error_code ignored;
  const std::string path = namedFile(from, name).path;
  return mayRead(path) && fs::is_regular_file(path, ignored);
}

}  // namespace trace
