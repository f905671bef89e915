#include "app/editing/preferences.h"

#include <algorithm>
#include <filesystem>

#include "base/text.h"

namespace trace {

Preferences Preferences::parse(std::string_view text) {
  Preferences preferences;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    if (const std::size_t space = line.find(' '); space != std::string_view::npos && space > 0)
      preferences.entries_.emplace_back(line.substr(0, space), line.substr(space + 1));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return preferences;
}

std::string Preferences::text() const {
  std::string text;
  for (const auto& [key, value] : entries_)
    if (value.find('\n') == std::string::npos) text += key + " " + value + "\n";
  return text;
}

std::string Preferences::get(const std::string& key, const std::string& otherwise) const {
  for (const auto& [name, value] : entries_)
    if (name == key) return value;
  return otherwise;
}

double Preferences::number(const std::string& key, double otherwise) const {
  const auto parsed = parseNumber(get(key));
  return parsed ? parsed->value : otherwise;
}

void Preferences::set(const std::string& key, const std::string& value) { setAll(key, {value}); }

void Preferences::set(const std::string& key, double value) { set(key, toText(value)); }

std::vector<std::string> Preferences::all(const std::string& key) const {
  std::vector<std::string> values;
  for (const auto& [name, value] : entries_)
    if (name == key) values.push_back(value);
  return values;
}

void Preferences::setAll(const std::string& key, const std::vector<std::string>& values) {
  std::erase_if(entries_, [&](const auto& entry) { return entry.first == key; });
  for (const std::string& value : values) entries_.emplace_back(key, value);
}

std::string configFolder(const char* (*variable)(const char* name)) {
  namespace fs = std::filesystem;
  const auto place = [&](const char* name) {
    const char* value = variable(name);
    return fs::path(value ? value : "");
  };
  fs::path folder = place("XDG_CONFIG_HOME");
  if (!folder.is_absolute()) folder = place("APPDATA");
  if (!folder.is_absolute()) folder = place("HOME").empty() ? fs::path() : place("HOME") / ".config";
  if (!folder.is_absolute()) return "";
  folder /= "trace";
  std::error_code error;
  fs::create_directories(folder, error);
  return fs::is_directory(folder, error) ? folder.generic_string() : "";
}

}  // namespace trace
