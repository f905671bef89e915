// The cost of a sample of each pixel: how many boxes of hierarchies and surfaces its rays are tested against.
// It is measured beside the render, which does not count for pixels.
#pragma once

#include <memory>
#include <optional>

#include "app/session/background_task.h"
#include "app/session/session.h"

namespace trace {

struct CostMap {
  std::shared_ptr<const Session> session{};  ///< whose picture it is of; null: there is none
  int block = 1;                             ///< so many pixels across and down have one value
  Picture tests{};                           ///< tests of a sample, the mean of a few, in all three channels
};

/// Samples of a pixel that are measured.
inline constexpr int kMostCostSamples = 4;

/// Traces them for one pixel of each block. After Session::build(), also while the picture is rendered. Its
/// picture is empty if it was cancelled or failed.
CostMap costMap(std::shared_ptr<const Session> session, int block, const Cancelled& cancelled = {});

/// Measures it in the background, coarse at first, for a window that asks in every frame.
class CostMaker {
 public:
  /// To be called often. Null: what is being measured is given up.
  void want(const std::shared_ptr<const Session>& session);
  /// Takes what has come in the meantime; true if there is something new.
  bool update();
  bool busy() const { return task_.pending(); }
  /// There is something to take, and nothing more to come.
  bool news() const { return task_.pending() && !task_.busy(); }
  /// The map of the session that is wanted, or an empty one.
  const CostMap& map() const { return map_; }

 private:
  void measure(int block);

  std::shared_ptr<const Session> wanted_;
  CostMap map_;
  BackgroundTask<CostMap> task_;
};

}  // namespace trace
