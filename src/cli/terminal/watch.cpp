#include "cli/terminal/watch.h"

#include <cmath>
#include <cstdio>
#include <filesystem>

#include "base/budget.h"

namespace trace::cli {
namespace {

constexpr int kLookForChanges = 100;  // milliseconds

/// Thrown in the midst of a picture that is written while the render continues.
struct SaveEnded {};

}  // namespace

Progress makeProgress(ProgressStyle style, const Console& console) {
  if (style == ProgressStyle::automatic)
    style = !console.shows(LogLevel::info) ? ProgressStyle::none
            : canRedraw()                  ? ProgressStyle::bar
                                           : ProgressStyle::plain;
  return Progress(style, columns(), [](const std::string& text) {
    std::fputs(text.c_str(), stderr);
    std::fflush(stderr);
  });
}

std::string pictureText(const Session& session, double fraction) {
  const Size size = finished(session.size(), session.settings());
  std::string text = std::to_string(size.width) + "x" + std::to_string(size.height);
  if (fraction == 1) return text;
  const int samples = samplesOf(session.settings());
  if (const auto taken = std::floor(fraction * samples);
      samples > 1 && taken >= 1 && !subdivides(session.settings()))
    text += ", about " + std::to_string(static_cast<int>(taken)) + " of " + std::to_string(samples) +
            " samples a pixel";
  return text + ", " + std::to_string(static_cast<int>(std::floor(100 * fraction))) + " % done";
}

std::string keptText(const std::string& path) {
  const bool there = std::filesystem::exists(path);  // if not, a pass beside it is
  return (there ? path : "what lies beside " + path) + " is kept as it is";
}

bool saveCheckpoint(Checkpoint& checkpoint, const Film& film, Progress& progress, const Console& console) {
  std::string why;
  const BudgetScope unlimited(nullptr);  // what is done is kept, whatever the time
  try {
    checkpoint.save(film);
    return true;
  } catch (const Error& error) {
    why = error.messages().front().what;
  } catch (const std::exception& error) {
    why = error.what();
  }
  progress.clear();
  console.line(LogLevel::warning,
               "warning: no checkpoint: " + why + "; the finished part is lost if the machine fails");
  return false;
}

Watch::Watch(Session& session, Signals& signals, const Console& console, Progress& progress,
             PictureFiles& files, const CheckpointPlan& plan, const Part& part)
    : session_(session),
      signals_(signals),
      console_(console),
      files_(files),
      plan_(plan),
      progress_(progress),
      part_(part) {
  Signals::receive(false);
  thread_ = std::thread([this] { run(); });
}

Watch::~Watch() {
  finished_ = true;
  signals_.wake();
  thread_.join();
  Signals::receive(true);
}

void Watch::report(Tell tell) {
  const Job& job = session_.job();
  std::optional<double> share;
  if (session_.film().noiseTarget() > 0)
    share =
        (static_cast<double>(part_.before) + session_.film().shareDone()) / static_cast<double>(part_.all);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - part_.start;
  (progress_.*tell)(part_.before * job.total + job.done, part_.all * job.total, elapsed.count(), share);
}

void Watch::run() {
  using Clock = std::chrono::steady_clock;
  Signals::receive(true);
  Clock::time_point last = Clock::now();
  while (!finished_) {
    switch (signals_.wait(kLookForChanges)) {
      case Signals::Event::stop: stop(); break;
      case Signals::Event::save: save(); break;
      case Signals::Event::none: break;
    }
    report(&Progress::update);
    if (!plan_.checkpoint || Clock::now() - last < std::chrono::duration<double>(plan_.every)) continue;
    if (!saveCheckpoint(*plan_.checkpoint, session_.film(), progress_, console_)) plan_.checkpoint = nullptr;
    last = Clock::now();
  }
  report(&Progress::finish);
}

void Watch::stop() {
  session_.job().cancel = true;
  progress_.clear();
  console_.line(LogLevel::info, "stopping when the tiles in work are finished, in " +
                                    std::to_string(session_.job().patience.count()) +
                                    " s at most; Ctrl-C again stops at once");
}

void Watch::lookWhileSaving() {
  if (signals_.wait(0) == Signals::Event::stop) stop();
  if (finished_ || session_.job().cancel) throw SaveEnded{};
}

void Watch::save() {
  progress_.clear();
  Budget budget([this] { lookWhileSaving(); });
  const BudgetScope scope(&budget);
  // Not Session::save(): that notes its duration, which belongs to the thread that renders.
  try {
    const std::string picture = pictureText(session_, session_.job().fraction());
    const std::string written = files_.write(session_.film(), session_.settings(), session_.metadata());
    console_.line(LogLevel::error, "wrote " + written + " (" + picture + "), going on" +
                                       (written == files_.path() ? "" : "; " + keptText(files_.path())));
  } catch (const SaveEnded&) {
    console_.line(LogLevel::info, "the picture so far is not written, for the render ends");
  } catch (const Error& error) {
    console_.error(error);
  } catch (const std::exception& error) {
    console_.line(LogLevel::error, std::string("could not write the picture so far: ") + error.what());
  }
}

}  // namespace trace::cli
