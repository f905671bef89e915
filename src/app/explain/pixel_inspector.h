// The rays of the pixel that was clicked, traced in the background, and how they differ from those of a
// pinned one. A window asks in every frame and shows what is there.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/explain/path_ways.h"
#include "app/explain/pixel_why.h"
#include "app/explain/ray_segments.h"
#include "app/explain/ray_view.h"
#include "app/session/background_task.h"
#include "app/session/session.h"

namespace trace {

/// A pixel's rays with the scene and World that they belong to.
struct TracedPixel {
  std::shared_ptr<const Session> session;
  int x = 0, y = 0, sample = 0;
  Explanation explanation{};
  std::vector<RaySegment> segments{};  ///< one for each ray
  std::vector<int> level{};            ///< level of each ray in the tree; the camera ray's is 0
  std::vector<char> hasChildren{};
  std::vector<PathWay> ways{};  ///< that its paths from both ends were joined in
  /// A remark on parts of the picture that its rays do not explain; "" if none.
  std::string note{};
  PixelWhy why{};         ///< why the sample has its colour
  std::string problem{};  ///< why there are no rays; "" if there are

  const RayTree& tree() const { return explanation.tree; }
  const Scene& scene() const { return session->sceneOf(tree()); }
  RayLooks looks(int ray) const { return segments[static_cast<std::size_t>(ray)].looks; }
  /// The light along the ray is known once so many rays were traced: it and all that come from it.
  bool isKnown(int ray, int rays) const { return lastBelow(tree(), ray) < rays; }
};

/// "sample 2 of 9", of those from 0 to 8; "" of a pixel that has only one.
std::string sampleText(const TracedPixel& pixel);

/// The explained rays that a window shows.
TracedPixel arrangedPixel(std::shared_ptr<const Session> session, Explanation explanation);

/// Traces sample `sample` of the pixel, or its last one if it has fewer. Keeps errors as the problem.
TracedPixel tracePixel(std::shared_ptr<const Session> session, int x, int y, int sample,
                       const Cancelled& cancelled = {});

class PixelInspector {
 public:
  /// Requests the rays of that sample; to be called often. Returns at once. Without a session: none.
  void want(const std::shared_ptr<const Session>& session, int x, int y, int sample);
  /// Keeps the rays that are there, to compare others with; or keeps them no longer.
  void pin(bool on);
  /// Keeps nothing and wants nothing: another scene was opened.
  void forget();
  /// Takes what has come in the meantime; true if there is something new.
  bool update();

  /// Null if there is none yet.
  const TracedPixel* traced() const { return shown_.traced.get(); }
  const TracedPixel* pinned() const { return shown_.pinned.get(); }
  /// How the pinned rays and the traced ones differ; empty without both.
  const std::vector<RayPair>& pairs() const { return shown_.pairs; }
  /// The last request has not been answered yet.
  bool busy() const { return task_.busy(); }

 private:
  struct Shown {
    std::shared_ptr<const TracedPixel> traced, pinned;
    std::vector<RayPair> pairs;
  };

  /// Asks for the rays wanted, or for those that are there if they are the same, and the difference.
  void ask();

  Shown shown_;
  std::shared_ptr<const TracedPixel> pinned_;  // as asked for
  std::shared_ptr<const Session> session_;     // session of what was asked for
  int x_ = 0, y_ = 0, sample_ = 0;
  BackgroundTask<Shown> task_;
};

}  // namespace trace
