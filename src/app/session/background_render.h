// Renders in the background, coarse first, for a window that must never wait.
//
// start() takes values and returns at once. A thread of its own builds the World, makes a few small pictures
// that are enlarged until the tiles of the real one cover them, and renders that: the same bits as
// everywhere. Where the system gives no threads, advance() does a part of that between two frames.
// If the integrator has to prepare something first, such as photons, small pictures of the direct
// light are shown meanwhile. A new start() stops what runs and takes its place; of the World it makes only
// what has changed.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "app/session/remaining_time.h"
#include "app/session/session.h"
#include "base/own_thread.h"

namespace trace {

class BackgroundRender {
 public:
  enum class Phase { idle, building, coarse, tracing, denoising, finished, stopped, failed };

  struct State {
    Phase phase = Phase::idle;
    double fraction = 0;              ///< fraction of the real picture; while building, of the preparations
    double elapsed = 0;               ///< seconds since start()
    std::optional<double> remaining;  ///< seconds
    std::uint64_t number = 0;         ///< number of the start() that this is about
    bool working() const { return phase != Phase::idle && phase < Phase::finished; }
  };

  explicit BackgroundRender(Threads threads = Threads::own);
  ~BackgroundRender();
  BackgroundRender(const BackgroundRender&) = delete;
  BackgroundRender& operator=(const BackgroundRender&) = delete;

  void start(std::shared_ptr<const Scene> scene, const Settings& settings, SceneAt sceneAt = {});
  /// Stops the render; finished parts stay.
  void stop();
  /// Between two frames: without a thread does a step of the render, or some milliseconds of tracing.
  void advance();

  State state();
  /// The scene, settings and World of the last picture of this scene file that was begun; null before. They
  /// never change; the studio asks them for the rays of a pixel.
  std::shared_ptr<const Session> session() const;
  /// The picture to show now, denoised at the end if that is asked for; of size 0 before the first.
  /// Copies: for every few frames, not for each.
  Picture picture() const;
  /// Changes whenever picture() may have changed.
  std::uint64_t version() const;
  /// Bad samples and statistics of the last render that ended.
  RenderResult result() const;
  /// Warnings and errors since the last call.
  std::vector<Message> takeMessages();

 private:
  struct Request {
    std::shared_ptr<const Scene> scene;
    Settings settings;
    SceneAt sceneAt;
    std::uint64_t number = 0;
  };

  struct Run;  // a request in work

  void work();
  /// Does the next step; false after the last one, or if that has no purpose any more. Does not throw.
  bool step(Run& run);
  bool doStep(Run& run);
  bool build(Run& run);
  bool coarsePass(Run& run);
  bool beginTracing(const Run& run);
  void denoise(Run& run);
  bool isCurrent(const Run& run) const;
  void fail(const Run& run, const std::vector<Message>& messages);
  /// One of the small pictures; `show` takes it, and says whether it is still of use.
  bool coarsePass(std::size_t index, std::span<const Moment> moments, const Settings& settings, Size size,
                  const std::function<bool(Picture)>& show);
  void showDirectLight(const Session& session, std::uint64_t number);

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::optional<Request> request_;  // waiting
  bool quit_ = false;
  std::shared_ptr<Session> session_;      // whose film is seen
  std::shared_ptr<Session> building_;     // until it becomes session_
  std::shared_ptr<const Session> built_;  // the last with a World; the thread's own
  Job coarseJob_;
  Picture coarse_;  // enlarged; empty when there is none of session_
  Picture early_;   // direct light of building_; empty when there is none
  std::uint64_t coarseVersion_ = 0;
  State state_;
  std::chrono::steady_clock::time_point begin_;
  RemainingTime remaining_;
  double tracingBegan_ = 0;          // seconds after begin_
  std::optional<Picture> denoised_;  // denoised of session_, once it is rendered
  RenderResult result_;
  std::vector<Message> messages_;
  std::unique_ptr<Run> run_;  // in work between frames
  std::thread thread_;
};

/// `small` enlarged to the size: each pixel is the one below it.
Picture enlarged(const Picture& small, Size size);

}  // namespace trace
