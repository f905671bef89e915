#include "cli/watch.h"

#include <cmath>
#include <cstdio>

namespace trace::cli {
namespace {

constexpr int kInterval = 100;  // milliseconds

/// What `auto` means here and now.
ProgressStyle settled(ProgressStyle style, const Console& console) {
  if (style != ProgressStyle::automatic) return style;
  if (!console.shows(LogLevel::info)) return ProgressStyle::none;
  return canRedraw() ? ProgressStyle::bar : ProgressStyle::plain;
}

}  // namespace

std::string pictureText(const Session& session, double fraction) {
  const Size size = session.size();
  std::string text = std::to_string(size.width) + "x" + std::to_string(size.height);
  if (fraction < 1) text += ", " + std::to_string(static_cast<int>(std::floor(100 * fraction))) + " % done";
  return text;
}

Watch::Watch(Session& session, Signals& signals, const Console& console, ProgressStyle style,
             std::string output)
    : session_(session),
      signals_(signals),
      console_(console),
      output_(std::move(output)),
      progress_(settled(style, console), columns(), [](const std::string& text) {
        std::fputs(text.c_str(), stderr);
        std::fflush(stderr);
      }) {
  Signals::receive(false);
  thread_ = std::thread([this] { run(); });
}

Watch::~Watch() {
  finished_ = true;
  signals_.wake();
  thread_.join();
  Signals::receive(true);
}

double Watch::elapsed() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void Watch::run() {
  Signals::receive(true);
  const Job& job = session_.job();
  while (!finished_) {
    switch (signals_.wait(kInterval)) {
      case Signals::Event::stop:
        session_.job().cancel = true;
        progress_.clear();
        console_.line(LogLevel::info,
                      "stopping when the tiles in work are finished; Ctrl-C again stops at once");
        break;
      case Signals::Event::save: save(); break;
      case Signals::Event::none: break;
    }
    progress_.update(job.done, job.total, elapsed());
  }
  progress_.finish(job.done, job.total, elapsed());
}

void Watch::save() {
  progress_.clear();
  // Not Session::save(): that notes its duration, which belongs to the thread that renders.
  try {
    const std::string picture = pictureText(session_, session_.job().fraction());
    for (const Output& file : outputs(output_, session_.settings()))
      write(file, session_.film(), session_.scene(), session_.settings());
    console_.line(LogLevel::error, "wrote " + output_ + " (" + picture + "), going on");
  } catch (const Error& error) {
    console_.error(error);
  } catch (const std::exception& error) {
    console_.line(LogLevel::error, std::string("could not write the picture so far: ") + error.what());
  }
}

}  // namespace trace::cli
