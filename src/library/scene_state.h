// A Scene of the library: a scene of the floors below, and its origin.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/session/session.h"
#include "base/files/read_scope.h"
#include "formats/format.h"
#include "formats/kind_defaults.h"
#include "scene/scene.h"
#include "traceray/traceray.h"

namespace traceray {

/// The categories of Part, and none of them.
enum PartCategory { kObject, kLight, kMaterial, kCamera, kBackground, kNoPart };

/// A warning of a part, which stands until the fields around its place are set again.
struct PartWarning {
  PartCategory category = kNoPart;
  std::uint64_t id = 0;  ///< as PartState::id
  trace::Message message;
  std::vector<std::string> fields;  ///< outermost first: "material", "shininess"
};

struct SceneState {
  trace::Scene scene;
  /// Names of objects and lights that stay, as these move in their lists.
  std::vector<std::uint64_t> objectIds, lightIds;
  std::uint64_t nextId = 1;

  /// The settings on which kind defaults depend, of a scene that a program built from nothing.
  bool isBuilt = false;
  trace::KindGiven given;
  int nextLine = 1;  ///< line of the file "built"

  std::vector<trace::Choice> choices;     ///< by the program
  std::vector<trace::Message> warnings;   ///< from reading the text that was opened
  std::vector<PartWarning> partWarnings;  ///< about what was added or edited
  bool lacksTextures = false;             ///< a picture of the scene could not be read

  std::shared_ptr<const trace::SceneText> text;  ///< that was opened; null of a built one
  trace::Real time = 0;                          ///< at which it was read
  bool changesWithTime = false;

  /// A program may read any file; what the text of a scene names lies below its folder
  /// (base/files/read_scope.h).
  trace::ReadScope readScope() const {
    return trace::ReadScope(isBuilt ? std::vector<std::string>{"/"} : std::vector<std::string>{});
  }
  /// The folder of the files that it names, with a slash at its end; "" for the current folder.
  std::string folder() const { return scene.file.substr(0, scene.file.find_last_of('/') + 1); }
  /// Gives ids to objects and lights that are new, at the end of their lists.
  void nameNew();
  /// Reads statements into the scene, or throws Error and leaves it as it was.
  void add(std::string_view statements);
  /// The new object or light that the place stands in, of those from these numbers on.
  std::pair<PartCategory, std::uint64_t> newPartAt(const trace::SourcePlace& place, std::size_t objects,
                                                   std::size_t lights) const;
  /// Keeps warnings of a part. `text` is what was read, whose first line has the number `line`.
  void warn(PartCategory category, std::uint64_t id, std::span<const trace::Message> messages,
            std::string_view text, int line = 1);
  /// Drops those of fields that are set, or all where `fields` is empty.
  void dropWarnings(PartCategory category, std::uint64_t id, const Fields& fields);
  /// The warnings that hold for the scene as it is.
  std::vector<trace::Message> allWarnings() const;
  /// Reads the pictures of textures that are new.
  void loadTextures();
  /// The scene as it is rendered and written: with what is left to Trace.
  trace::Scene completed() const;
  /// Reads it at another time, with its edits; null if it does not change.
  trace::SceneAt sceneAt() const;
};

/// Reads the text of a scene file. Throws trace::Error.
std::shared_ptr<SceneState> read(const std::string& file, std::string bytes, const Options& options);

/// The options by their rows, checked. Throws Error(usage).
std::vector<trace::Choice> choicesOf(const Options& options);
/// In place of an earlier choice.
void choose(std::vector<trace::Choice>& choices, trace::Choice choice);

/// The completed scene with its settings, at the moment that these name. Throws trace::Error.
struct Opened {
  trace::Scene scene;
  trace::Settings settings;
  trace::SceneAt sceneAt;
};
Opened opened(const SceneState& state, const std::vector<trace::Choice>& choices);

}  // namespace traceray
