// What the studio does, without its window: a document, its picture in the making, a picture to compare with,
// the log, files opened lately. The window calls update() for every frame and draws what it finds here.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "app/background_render.h"
#include "app/background_task.h"
#include "app/document.h"
#include "app/pixel_inspector.h"
#include "app/remaining_time.h"

namespace trace {

class Workspace {
 public:
  /// Opens a scene and renders it. Errors go to the log; false then.
  bool open(const std::string& file, std::vector<Choice> commandLine = {});
  /// The same, but returns at once; update() takes the scene when it is read. Until then, or if that fails,
  /// the one before stays.
  void openLater(const std::string& file);
  bool opening() const { return opening_.busy(); }
  /// Called often: renders after changes, reads the file again when it changed on disk, collects messages.
  void update();

  Document document;
  BackgroundRender render;
  PixelInspector inspector;
  bool automatic = true;  ///< the picture follows every change

  /// Renders the document as it is now.
  void startRender();
  /// Changes that the picture does not show yet; never with `automatic`.
  bool stale() const;

  /// A picture file to compare with. Errors go to the log; false then.
  bool openReference(const std::string& file);
  const std::optional<Picture>& reference() const { return reference_; }
  const std::string& referenceFile() const { return referenceFile_; }
  /// It holds colours as they were rendered, before any tone.
  bool referenceIsLinear() const { return referenceIsLinear_; }
  std::uint64_t referenceVersion() const { return referenceVersion_; }
  void closeReference() { reference_.reset(), referenceFile_.clear(), ++referenceVersion_; }

  /// Writes what is rendered so far. Errors go to the log; false then.
  bool savePicture(const std::string& file);
  /// Writes the scene as a .ray file, which is the document's from now on. Errors go to the log; false then.
  bool saveScene(const std::string& file);
  /// "scene.png" beside the scene.
  std::string defaultPictureFile() const;

  struct LogEntry {
    enum class Level { note, warning, error };
    Level level = Level::note;
    std::string text;  ///< what, without the place
    std::string hint;
    Place place;
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

  /// What reading a file came to: a document, or errors.
  struct Opened {
    std::optional<Document> document;
    std::vector<Message> errors;
  };
  static Opened read(const std::string& path, std::vector<Choice> commandLine);
  bool adopt(Opened opened);
  void noteEnd();
  void reloadIfChanged();
  void reportReading();  // its warnings, once

  std::optional<Picture> reference_;
  std::string referenceFile_;
  bool referenceIsLinear_ = false;
  std::uint64_t referenceVersion_ = 0;
  std::vector<LogEntry> log_;
  std::vector<std::string> recent_;
  std::uint64_t seen_ = 0;      // revision of the document that update() looked at last
  std::uint64_t reading_ = 0;   // that is in the log
  std::uint64_t reported_ = 0;  // number of the render whose end is in the log
  std::shared_ptr<const Scene> rendered_;
  Settings renderedSettings_;
  std::chrono::steady_clock::time_point looked_{};
  BackgroundTask<Opened> opening_;
};

/// A render with other settings gives another picture, before tone: not so for threads or rounding.
bool differInPicture(const Settings& a, const Settings& b);

}  // namespace trace
