// A chain of `mlt`, move by move: one that the render has, too, and that comes by a pixel.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/explain/pixel_inspector.h"
#include "app/session/background_task.h"
#include "render/chains/metropolis.h"

namespace trace {

struct ChainWalk {
  int x = 0, y = 0;                ///< the pixel by which it was to come
  std::int64_t tile = 0;           ///< whose first wave of samples the chain makes
  std::vector<ChainMove> moves{};  ///< its start, then its moves
  int nearest = 0;                 ///< index of the move that came to the pixel, or nearest to it

  /// The one that brought the chain to where it is offered `moves[index]`; -1 for the start, which had none.
  int before(int index) const;
  /// "No chain followed here came to 12, 30; this one came to 14, 31. "; "" if it came by the pixel.
  std::string missed() const;
  /// "12 of 70 moves nearby and 3 of 30 anywhere were made".
  std::string summary() const;
};

/// "nearby, to pixel 3, 4, brings 0.3 0.2 0.1 there: light 0.2 after 0.4, a chance of 0.5: not made".
std::string sentence(const ChainMove& move);

/// Follows the chains of a session whose integrator is `mlt`.
class ChainWalker {
 public:
  /// Looks for light first, as the render does. Throws Error.
  ChainWalker(std::shared_ptr<const Session> session, const Cancelled& cancelled);
  /// The first chain that comes by the pixel, among so many moves; or else the one that comes nearest.
  ChainWalk near(int x, int y, const Cancelled& cancelled) const;
  /// The rays of a sample that the chain was offered.
  TracedPixel offered(const ChainWalk& walk, int index) const;

 private:
  std::int64_t movesOf(std::int64_t tile) const;

  std::shared_ptr<const Session> session_;
  Job job_;
  Metropolis chains_;
};

/// Follows a chain in the background, for a window that asks in every frame.
class ChainInspector {
 public:
  /// The walk of the chain near that pixel, and the rays of its move `index`, or of the nearest one for -1.
  /// Returns at once. Without a session, or with one that has no chains: none.
  void want(const std::shared_ptr<const Session>& session, int x, int y, int index);
  /// Takes what has come in the meantime; true if there is something new.
  bool update();
  bool busy() const { return task_.busy(); }

  const ChainWalk* walk() const { return shown_.walk.get(); }
  int index() const { return shown_.index; }  ///< index of the move whose rays are shown
  /// The rays of what was offered, and of the sample where the chain was; null if there are none.
  const TracedPixel* offered() const { return shown_.offered.get(); }
  const TracedPixel* before() const { return shown_.before.get(); }

 private:
  struct Shown {
    std::shared_ptr<const Session> session;
    int x = 0, y = 0, index = -1;
    std::shared_ptr<const ChainWalker> walker;
    std::shared_ptr<const ChainWalk> walk;
    std::shared_ptr<const TracedPixel> offered, before;
  };
  Shown shown_;
  std::shared_ptr<const Session> session_;  // session of what was asked for
  int x_ = 0, y_ = 0, index_ = -1;
  BackgroundTask<Shown> task_;
};

}  // namespace trace
