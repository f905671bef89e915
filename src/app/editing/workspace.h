// The state of the studio without its window: a document, its picture in the making, a picture to compare
// with, the log, files opened lately. The window calls update() for every frame and draws what it finds here.
//
// Whatever reads or writes a file returns at once and is done in the background; update() takes what came of
// it. Errors go to the log. The last file to open, moment of the scene and reference asked for
// counts; what is saved is saved in turn, also when the Workspace goes.
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/editing/document.h"
#include "app/editing/first_scene.h"
#include "app/explain/pixel_inspector.h"
#include "app/session/background_render.h"
#include "app/session/background_task.h"
#include "app/session/remaining_time.h"

namespace trace {

class Workspace {
 public:
  /// Opens a scene and renders it. Until it is read, or if that fails, the one before stays; where there is
  /// none, the file is read again as soon as it changes.
  void open(const std::string& file);
  /// Writes a first scene to a file that does not exist yet, and opens it.
  void startScene(const std::string& file, std::string_view text = kFirstScene);
  /// "scene.ray" in the folder of the document, or the current one where that is of the examples; or a name
  /// there that no file has.
  std::string newSceneFile() const;
  /// Called often: takes what was done in the background, renders after changes, reads the file again when it
  /// changed on disk, collects messages.
  void update();

  std::vector<Choice> commandLine;  ///< options that hold over those of every file that is opened
  std::string examples;             ///< folder of the program's own scenes, where no new file is proposed
  Document document;
  BackgroundRender render;
  PixelInspector inspector;
  bool automatic = true;  ///< the picture follows every change

  /// Renders the document as it is now.
  void startRender();
  /// How the picture that is to be seen is developed: as the document says, or, as long as it is one of
  /// another scene, as that did.
  Settings shownSettings() const;
  /// With the exposure that the render has measured, where it was to be measured.
  Settings withExposureMeasured(Settings settings) const;
  /// Changes that the picture does not show yet; never with `automatic`.
  bool stale() const;

  /// One step of the Document. Links follow a thing that is renamed. Names that a .ray file cannot hold are
  /// not taken. Files that the scene names since are read first, in the background; where one cannot be, the
  /// step is not taken, and the log says why.
  void edit(const std::string& what, Scene scene, bool continues = false);
  /// As of the Document, but the file is read in the background if it has to be; before a scene is open it
  /// joins the command line. Throws Error(Fault::usage) if the option does not take the value.
  void choose(const std::string& option, const std::string& value, bool continues = false);
  void reset(const std::string& option);
  /// With what was chosen last, also if the file is still being read for it.
  Settings chosenSettings() const;
  /// Takes the last change back, also one for which the file is still being read.
  void undo();
  /// As Document::dropSince; a value for which the file is being read is dropped, too.
  void dropSince(std::uint64_t step);
  void redo() { document.redo(); }
  /// Name of the edit that undo() takes back; "" if nothing.
  std::string undoName() const { return wanted_ ? wanted_->option : document.undoName(); }

  /// A picture file to compare with.
  void openReference(const std::string& file);
  const std::optional<Picture>& reference() const { return reference_; }
  const std::string& referenceFile() const { return referenceFile_; }
  /// It holds colours as they were rendered, before any tone.
  bool referenceIsLinear() const { return referenceIsLinear_; }
  std::uint64_t referenceVersion() const { return referenceVersion_; }
  void closeReference() {
    reference_.reset();
    referenceFile_.clear();
    ++referenceVersion_;
  }

  /// Something of the scene is in no file: it was edited, or its file is gone.
  bool unsaved() const { return document.edited() || (document.isOpen() && gone_); }

  /// Writes what is rendered so far.
  void savePicture(const std::string& file);
  /// Writes another file than picture and scene in the background: `write` does, and may throw. No file of
  /// the scene is written over.
  void saveBy(const std::string& file, std::function<void(const Advance&)> write);
  /// The share that is written of a file that takes long; 0 of any other.
  double savingShare() const { return *savingShare_; }
  /// Gives up a file that takes long.
  void stopSaving() { *savingStopped_ = true; }
  /// Writes the scene as a .ray file, which is the document's from now on.
  void saveScene(const std::string& file);
  /// Over its own file, unless that has changed since it was read: then it is read again first. Precondition:
  /// document.savesOverItsFile().
  void saveSceneOver();
  /// "scene.png" beside the scene.
  std::string defaultPictureFile() const;
  /// The scene's own file; of a scene of another format, a name beside it that no file has.
  std::string defaultSceneFile() const;

  /// Until update() has taken what came of it.
  bool reading() const {
    return opening_.pending() || rereading_.pending() || loading_.pending() || completing_.pending();
  }
  /// Another scene is being read, or written and read.
  bool opening() const { return opening_.pending(); }
  bool saving() const { return saving_.pending(); }
  /// Files that were written since the last call.
  std::vector<std::string> takeWritten() { return std::exchange(written_, {}); }
  /// All that may change without a person doing something. A window need not draw while it stays the same.
  struct Pulse {
    std::shared_ptr<const Scene> scene;
    std::uint64_t revision, picture, reference, failures;
    std::size_t log;
    BackgroundRender::Phase phase;
    int tenths;                     ///< tenths of seconds that a render takes already
    bool reading, saving, tracing;  ///< tracing: the rays of a pixel
    bool operator==(const Pulse&) const = default;
  };
  Pulse pulse();
  /// Files that could not be read or written so far. The log says which.
  std::uint64_t failures() const { return failures_; }
  /// Edits that were not taken so far. The log says why.
  std::uint64_t refusals() const { return refusals_; }

  struct LogEntry {
    enum class Level { note, warning, error };
    Level level = Level::note;
    std::string text;  ///< what, without the place
    std::string hint;
    SourcePlace place;
  };
  const std::vector<LogEntry>& log() const { return log_; }
  void note(std::string text) { log_.push_back({LogEntry::Level::note, std::move(text), {}, {}}); }
  void report(const std::vector<Message>& messages);
  void clearLog() { log_.clear(); }

  /// The newest first.
  const std::vector<std::string>& recent() const { return recent_; }
  void setRecent(std::vector<std::string> files) { recent_ = std::move(files); }

 private:
  static constexpr std::size_t kMostRecent = 12;

  /// The result of a job in the background: something, or errors.
  template <class Value>
  struct Outcome {
    std::optional<Value> value{};
    std::vector<Message> errors{};
  };
  template <class Work>
  static auto outcomeOf(const std::string& file, Work&& work);
  /// The result of the job, if that is there and is not an error, which then is reported.
  template <class Value>
  std::optional<Value> taken(BackgroundTask<Outcome<Value>>& task);

  struct Reread {
    Document::Change change;
    std::uint64_t number = 0;
    Outcome<Document::Reading> reading;
  };
  struct Completed {  ///< an edit and the files that it names
    std::string what;
    std::shared_ptr<const Scene> of, scene;
    std::vector<Message> errors, remarks;
  };
  struct Reference {
    std::string file;
    Picture picture;
    bool linear = false;
  };
  struct Saved {
    std::vector<std::string> files;
    std::optional<Document::Saved> scene{};
    bool anew = false;      ///< the file was there once, and was gone
    std::string stopped{};  ///< a file that somebody gave up
  };

  std::filesystem::path folderForFiles() const;  ///< for those that are proposed
  void openFrom(const std::string& path, const std::function<void()>& first);
  void takeOpened();
  void openIfMended();
  bool lookNow();  ///< it is time to look at the disk
  void adopt(Document opened);
  void putFirst(const std::string& file);  ///< makes it the first of recent()
  void want(Document::Change change);
  void giveUpWanted();
  void takeReread();
  void takeCompleted();
  void takeReference();
  void takeSaved();
  void fail(const std::vector<Message>& errors);
  /// An edit.
  void refuse(const std::string& what, const std::string& why, const std::string& hint = {});
  void noteEnd();
  void noteEnvironment(const Session& session);  ///< its kind, once
  void reloadIfChanged();
  void reportReading();  // its warnings, once

  std::string environment_;  // whose kind the log has
  std::optional<Picture> reference_;
  std::string referenceFile_;
  bool referenceIsLinear_ = false;
  std::uint64_t referenceVersion_ = 0;
  std::vector<LogEntry> log_;
  std::vector<std::string> recent_;
  std::uint64_t seen_ = 0;      // revision of the document that update() looked at last
  std::uint64_t reading_ = 0;   // that is in the log
  std::uint64_t reported_ = 0;  // number of the render whose end is in the log
  std::uint64_t failures_ = 0, refusals_ = 0;
  std::shared_ptr<const Scene> rendered_;
  Settings renderedSettings_;
  std::chrono::steady_clock::time_point looked_{};
  struct Asked {
    std::string file;
    std::filesystem::file_time_type written{};
  };
  std::optional<Asked> asked_;                    // to be opened; it is not open yet
  bool gone_ = false;                             // the file is; told once
  std::optional<Document::Change> wanted_;        // for which the file is being read
  std::uint64_t wantedNumber_ = 0, givenUp_ = 0;  // the last; those up to it count no more
  BackgroundTask<Outcome<Document>> opening_;
  BackgroundTask<Reread> rereading_;
  BackgroundTask<Completed> completing_;
  BackgroundTask<Outcome<Reference>> loading_;
  std::vector<std::string> written_;
  std::shared_ptr<std::atomic<double>> savingShare_ = std::make_shared<std::atomic<double>>(0);
  std::shared_ptr<std::atomic<bool>> savingStopped_ = std::make_shared<std::atomic<bool>>(false);
  BackgroundTask<Outcome<Saved>> saving_{Jobs::all};
};

/// A render with other settings gives another picture, before tone: not so for threads or rounding.
bool differInPicture(const Settings& a, const Settings& b);

}  // namespace trace
