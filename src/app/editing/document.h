// A scene that a person works on: what the file says, what was edited since, which options were chosen by
// whom, and every earlier state, so that each step can be undone. The studio edits it; nothing here knows a
// window.
//
// A state is a value (Edition): undo and redo move along a list of values. Reading the file again, because it
// changed on disk, is a step like any other, so it never destroys work.
//
// What takes long, reading and writing, is also there in three parts: what is to be done, as a value; the
// work, for any thread; and what the document makes of its outcome. So the Workspace keeps its window awake.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/session/session.h"
#include "base/error.h"
#include "scene/options.h"
#include "scene/scene.h"

namespace trace {

struct SceneText;

class Document {
 public:
  /// Reads the scene; `commandLine` lies over the file's own choices from now on. Forgets the earlier states.
  /// Throws Error; the document then stays what it was.
  void open(const std::string& file, std::vector<Choice> commandLine = {});
  bool isOpen() const { return !editions_.empty(); }

  const std::string& file() const { return file_; }
  const Scene& scene() const { return *editions_[current_].scene; }
  std::shared_ptr<const Scene> sharedScene() const { return editions_[current_].scene; }
  const Settings& settings() const { return settings_; }
  const Messages& messages() const { return messages_; }  ///< warnings of the last reading
  std::uint64_t readings() const { return readings_; }    ///< how often a file was read
  /// Grows with every change of scene or settings.
  std::uint64_t revision() const { return revision_; }

  /// One step. With `continues`, a step of the same name is replaced instead: dragging a slider is one step.
  void edit(const std::string& what, Scene scene, bool continues = false);
  /// Throws Error(Fault::usage) if the option does not take the value.
  void choose(const std::string& option, const std::string& value, bool continues = false);
  /// Back to what the file and the command line say.
  void reset(const std::string& option);
  /// The file is read again for a change of this option.
  static bool readsFile(const std::string& option);
  /// Tells who gave the option its value: "default", "scene.ray:3", "command line" or "studio".
  std::string chooser(const Option& option) const;
  bool chosenHere(const std::string& option) const;

  bool canUndo() const { return current_ > 0; }
  bool canRedo() const { return current_ + 1 < editions_.size(); }
  void undo();
  void redo();
  /// Number of the present state; no other state of this document has it.
  std::uint64_t step() const { return editions_[current_].step; }
  /// Drops the states after that one, if it is earlier than the present one: a drag was given up.
  void dropSince(std::uint64_t step);
  /// Name of the edit that undo() takes back, and that redo() makes again; "" if nothing.
  std::string undoName() const { return canUndo() ? editions_[current_].what : ""; }
  std::string redoName() const { return canRedo() ? editions_[current_ + 1].what : ""; }

  /// Saving would write something else than what was read or saved last: of the scene, or of the options
  /// that a scene has. Those of the command line hold for the session and are not saved.
  bool edited() const;
  /// The file is a .ray file whose text is kept, or was written here, so that a scene may be saved over it.
  bool savesOverItsFile() const;
  /// The point that the file says the camera looks at, as long as it does.
  std::optional<Vec3> lookAt() const;
  /// The fingerprint of what was read; "" if the scene was edited, whatever was chosen.
  std::string fileFingerprint() const { return sceneEdited() ? "" : fingerprint_; }
  /// The file was written since it was last read, or since noticeDisk(). Asks the file system.
  bool changedOnDisk() const;
  /// The file on the disk is neither the text that was read last nor the one saved here: saving over it would
  /// lose another program's work, whether that can be read or not. Asks the file system.
  bool othersOnDisk() const;
  void noticeDisk();
  /// Reads the file again, as one step; choices made here stay. Throws Error; the document then stays, and
  /// changedOnDisk() is false until the file changes once more.
  void reload();
  /// The file has values that change with time.
  bool changesWithTime() const { return changesWithTime_; }
  /// Reads the scene as it is at another time, with its edits; null if it does not change.
  SceneAt sceneAt() const;
  /// Writes the scene, with the options that were chosen here, as a .ray file, which is the document's file
  /// from now on: the text that was read, if that was a .ray file, with the edits
  /// (formats/ray/write/patch.h). Where the document's file says something that would be lost then, of its
  /// text or of another one that was read meanwhile and undone, it is kept in a file beside. Returns warnings
  /// of what was lost. Throws Error, also if the file could not be read again as the same scene
  /// (app/editing/read_back.h); nothing is written then, and the document stays.
  std::vector<Message> save(const std::string& file);

  // --- in parts: a step for which the file is read ---

  struct Change {
    std::string option{};                ///< to be chosen; "" for none
    std::optional<std::string> value{};  ///< none: back to what the file and the command line say
    bool continues = false;
    bool anew = false;  ///< the file may say something else than before
  };
  struct Source {
    std::string file;
    std::vector<Choice> commandLine, choices;
    /// The time of the scene, as far as it is not the file that chooses it.
    Real time() const { return resolve({commandLine, choices}).time; }
  };
  struct Reading {
    Source source;
    std::shared_ptr<const Scene> scene;
    std::shared_ptr<const SceneText> text;
    Messages messages;
    std::string fingerprint;
    bool changesWithTime = false;
    std::filesystem::file_time_type written{};
  };
  Source source(const Change& change) const;
  /// Throws Error.
  static Reading read(const Source& source);
  /// False if the document has changed so that something else has to be read for it.
  bool apply(const Change& change, const Reading& reading);

  // --- and the writing of a scene ---

  /// The origin of a file: a text that was read, and edits. It is `whole` if they took nothing out of the
  /// text that a person wrote: comments, nesting, keys of an animation.
  struct Origin {
    std::shared_ptr<const SceneText> text;
    bool whole = true;
  };
  struct Saving {
    std::string file;
    std::shared_ptr<const Scene> scene;
    std::shared_ptr<const SceneText> text;  ///< text of which the scene was made
    std::vector<Choice> choices;            ///< that the file is to make
    std::optional<Origin> before;           ///< state of the file, if it is the document's own
    Messages messages;
  };
  struct Saved {
    Saving what;
    bool keepsAll = true;  ///< keeps all of the text
    std::string fingerprint;
    bool changesWithTime = false;
    std::filesystem::file_time_type written{};
  };
  Saving saving(const std::string& file) const;
  /// Throws Error.
  static Saved write(Saving what);
  /// Does nothing if the scene is none of this document.
  void noteSaved(const Saved& saved);

 private:
  struct Edition {
    std::string what;  ///< that led here
    std::shared_ptr<const Scene> scene;
    std::shared_ptr<const SceneText> text;  ///< from which the scene was read, before it was edited
    std::vector<Choice> choices;
    std::uint64_t step = 0;
  };
  static constexpr std::size_t kMostEditions = 1000;

  /// `anew`: the file may say something else than before; else it was read at another moment.
  void take(const Reading& reading, bool anew);
  /// The present one, with the option chosen.
  Edition with(const Change& change) const;
  void make(const Change& change);
  void push(Edition edition, bool continues);
  void settle();
  bool sceneEdited() const;
  bool writtenSince(std::filesystem::file_time_type time) const;

  std::string file_;
  std::string ownFile_;                        // the file, if it may be saved over
  std::filesystem::file_time_type written_{};  // time of the file that was read or saved last
  std::filesystem::file_time_type noticed_{};
  std::vector<Choice> commandLine_;
  std::vector<Edition> editions_;
  std::size_t current_ = 0;
  std::shared_ptr<const Scene> onDisk_;
  Origin origin_;                                                    // origin of the file
  std::set<std::weak_ptr<const Scene>, std::owner_less<>> moments_;  // all that the file says, at other times
  std::vector<Choice> choicesOnDisk_;                                // that the file makes
  std::vector<Choice> choices_;  // that it makes if it is saved now: its own and those made here
  std::string fingerprint_;
  bool changesWithTime_ = false;
  Settings settings_;
  Messages messages_;
  std::uint64_t revision_ = 0, readings_ = 0, steps_ = 0;
};

}  // namespace trace
