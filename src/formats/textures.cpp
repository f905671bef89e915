#include "formats/textures.h"

#include <algorithm>

namespace trace {
namespace {

constexpr std::size_t kMostNamed = 3, kLongName = 80;

}  // namespace

void Textures::note(std::string_view name, const Place& place) {
  if (names_.empty()) place_ = place;
  if (known_.emplace(name).second) names_.emplace_back(name.substr(0, kLongName));
}

std::string Textures::warning() const {
  const std::size_t count = names_.size();
  const std::size_t named = count <= kMostNamed + 1 ? count : kMostNamed;
  std::string list;
  for (std::size_t i = 0; i < named; ++i) {
    const bool last = i + 1 == count;
    list += (i == 0 ? "" : last ? " and " : ", ") + ("\"" + names_[i] + "\"");
  }
  if (named < count) list += " and " + std::to_string(count - named) + " more";
  return count == 1 ? "the texture " + list + " is not rendered yet"
                    : "the textures " + list + " are not rendered yet";
}

void Textures::report(Messages& messages, std::string_view instead) const {
  if (!names_.empty()) messages.warn(place_, warning(), std::string(instead) + " shows instead");
}

}  // namespace trace
