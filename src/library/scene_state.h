// A Scene of the library: a scene of the floors below, and its origin.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "app/session/session.h"
#include "formats/format.h"
#include "formats/kind_defaults.h"
#include "scene/scene.h"
#include "traceray/traceray.h"

namespace traceray {

struct SceneState {
  trace::Scene scene;
  /// Names of objects and lights that stay, as these move in their lists.
  std::vector<std::uint64_t> objectIds, lightIds;
  std::uint64_t nextId = 1;

  /// The settings on which kind defaults depend, of a scene that a program built from nothing.
  bool isBuilt = false;
  trace::KindGiven given;
  int nextLine = 1;  ///< line of the file "built"

  std::vector<trace::Choice> choices;  ///< by the program
  std::vector<trace::Message> warnings;

  std::shared_ptr<const trace::SceneText> text;  ///< that was opened; null of a built one
  trace::Real time = 0;                          ///< at which it was read
  bool changesWithTime = false;

  /// The folder of the files that it names, with a slash at its end; "" for the current folder.
  std::string folder() const { return scene.file.substr(0, scene.file.find_last_of('/') + 1); }
  /// Gives ids to objects and lights that are new, at the end of their lists.
  void nameNew();
  /// Reads statements into the scene, or throws Error and leaves it as it was.
  void add(std::string_view statements);
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
