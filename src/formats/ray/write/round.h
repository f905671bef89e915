// One round of ray_patch.h: what a text says, what it is to say, and the changes that bring it there.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "formats/ray/syntax/notes.h"
#include "formats/ray/syntax/syntax.h"
#include "scene/scene.h"

namespace trace::rayfile {

/// A text that was read.
struct Reading {
  Reading(const std::string& file, std::string_view bytes, Real time);

  std::unique_ptr<std::string> text;
  std::unique_ptr<Syntax> syntax;
  Notes notes;
  Scene scene;
};

/// The scene that the text is to give.
struct Wanted {
  static constexpr std::size_t kNew = std::numeric_limits<std::size_t>::max();

  Scene scene;  ///< objects and lights in the order in which the text will have them
  /// Which object and light of the present text each one is; kNew if none.
  std::vector<std::size_t> objects, lights;
  /// The new material of each material of the present text.
  std::vector<std::optional<Material>> materials;
};

/// Things of the present text to be written anew, by their numbers.
struct Anew {
  std::set<std::size_t> objects, lights;
};

/// The changed text. To `anew` objects are added for which there is no other way. Warnings name `file`.
std::string changedText(const Reading& now, const Wanted& wanted, Anew& anew, Messages& messages);

/// Do the objects stand in one place of the text each, so that one can be changed without the others?
bool standsAlone(const Scene& scene, std::size_t object);

}  // namespace trace::rayfile
