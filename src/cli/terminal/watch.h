// A thread beside the render: shows progress and obeys signals.
#pragma once

#include <atomic>
#include <chrono>
#include <optional>
#include <string>
#include <thread>

#include "app/session/checkpoint.h"
#include "app/session/session.h"
#include "cli/arguments.h"
#include "cli/terminal/console.h"
#include "cli/terminal/progress.h"
#include "cli/terminal/terminal.h"

namespace trace::cli {

/// Which part of the work the render is: of an animation, one of several frames.
struct Part {
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();  ///< start of the work
  std::int64_t before = 0, all = 1;  ///< renders done before, and in all
};

/// When a checkpoint is written.
struct CheckpointPlan {
  Checkpoint* checkpoint = nullptr;  ///< null writes none
  double every = 0;                  ///< seconds
};

/// The meaning of `auto` here and now, drawn on stderr.
Progress makeProgress(ProgressStyle style, const Console& console);

/// False, after a warning, if it cannot be written.
bool saveCheckpoint(Checkpoint& checkpoint, const Film& film, Progress& progress, const Console& console);

/// Lives while Session::renderPicture() runs. Event::stop cancels the job; Event::save writes the finished
/// tiles to `files`, which are the thread's own meanwhile, as the checkpoint is; a stop, or the end of the
/// render, ends that too.
class Watch {
 public:
  Watch(Session& session, Signals& signals, const Console& console, Progress& progress, PictureFiles& files,
        const CheckpointPlan& plan, const Part& part);
  ~Watch();
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

 private:
  void run();
  void save();
  void stop();
  void lookWhileSaving();
  using Tell = void (Progress::*)(std::int64_t done, std::int64_t total, double elapsed,
                                  std::optional<double> share);
  void report(Tell tell);

  Session& session_;
  Signals& signals_;
  const Console& console_;
  PictureFiles& files_;
  CheckpointPlan plan_;
  Progress& progress_;
  const Part part_;
  std::atomic<bool> finished_{false};
  std::thread thread_;
};

/// The remark on a file that a partial picture would have replaced.
std::string keptText(const std::string& path);

/// "400x300" or, of a part, "400x300, 37 % done" or "400x300, about 5 of 16 samples a pixel, 37 % done".
std::string pictureText(const Session& session, double fraction);

}  // namespace trace::cli
