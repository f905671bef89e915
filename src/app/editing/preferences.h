// Preferences that the studio keeps from one day to the next: a small text file of `key value` lines in the
// user's folder for settings.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace trace {

class Preferences {
 public:
  /// Takes what it can of the text; lines that make no sense are left out.
  static Preferences parse(std::string_view text);
  std::string text() const;

  std::string get(const std::string& key, const std::string& otherwise = "") const;
  double number(const std::string& key, double otherwise) const;
  void set(const std::string& key, const std::string& value);
  void set(const std::string& key, double value);
  /// Several values under one key, in order.
  std::vector<std::string> all(const std::string& key) const;
  void setAll(const std::string& key, const std::vector<std::string>& values);

 private:
  std::vector<std::pair<std::string, std::string>> entries_;
};

/// $XDG_CONFIG_HOME/trace, or ~/.config/trace (also on macOS), %APPDATA%/trace on Windows; made if it does
/// not exist. "" if there is no such place: then nothing is remembered. `variable` reads the environment.
std::string configFolder(const char* (*variable)(const char* name));

}  // namespace trace
