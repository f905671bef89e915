// Warnings of a reader that are told once for each kind, at the place of the first, with how often they came:
// a file with the same mistake in a thousand lines gives one.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"

namespace trace {

class WarningsByKind {
 public:
  /// The kind is the text unless another is given.
  void warn(SourcePlace place, std::string what, std::string hint = {}, std::string_view kind = {}) {
    if (again(kind.empty() ? what : kind)) return;
    kinds_.emplace(kind.empty() ? what : kind, all_.size());
    all_.push_back({std::move(place), std::move(what), std::move(hint), 1});
  }
  /// If there was one of that kind, or there are too many kinds, counts one more and returns true: for those
  /// to whom finding the place is work.
  bool again(std::string_view kind) {
    const auto found = kinds_.find(kind);
    if (found != kinds_.end()) {
      ++all_[found->second].times;
      return true;
    }
    return all_.size() == kMostKinds && ++others_ > 0;
  }

  /// Hands them over, in the order met.
  void report(Messages& messages) {
    for (Warning& warning : all_) {
      if (warning.times > 1) warning.what += " (" + std::to_string(warning.times) + " times, first here)";
      messages.warn(std::move(warning.place), std::move(warning.what), std::move(warning.hint));
    }
    if (others_ > 0)
      messages.warn(SourcePlace{.file = messages.all().back().place.file},
                    "there are warnings of more kinds, not shown: " + std::to_string(others_));
    all_.clear();
    kinds_.clear();
    others_ = 0;
  }

 private:
  static constexpr std::size_t kMostKinds = 50;
  struct Warning {
    SourcePlace place;
    std::string what, hint;
    std::size_t times;
  };
  std::vector<Warning> all_;
  std::map<std::string, std::size_t, std::less<>> kinds_;
  std::size_t others_ = 0;  ///< number of warnings of kinds beyond the most
};

}  // namespace trace
