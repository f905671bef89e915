// Renders in the background, coarse first, for a window that must never wait.
//
// start() takes values and returns at once. A thread of its own builds the World, makes a few small pictures
// that are enlarged until the tiles of the real one cover them, and renders that: the same bits as
// everywhere. If the integrator has to prepare something first, such as photons, small pictures of the direct
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

  BackgroundRender();
  ~BackgroundRender();
  BackgroundRender(const BackgroundRender&) = delete;
  BackgroundRender& operator=(const BackgroundRender&) = delete;

  void start(std::shared_ptr<const Scene> scene, const Settings& settings, SceneAt sceneAt = {});
  /// Stops the render; finished parts stay.
  void stop();

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

  void work();
  void run(const Request& request);
  /// The small pictures; `show` takes each, and says whether it is still of use.
  void coarsePasses(std::span<const Moment> moments, const Settings& settings, Size size,
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
  std::thread thread_;
};

/// `small` enlarged to the size: each pixel is the one below it.
Picture enlarged(const Picture& small, Size size);

}  // namespace trace
