// The pyramid of strategies (Veach 1997, figure 10.5): what each way of putting paths together from both ends
// brings to the picture of `bdpt`, a row for each number of places. It is looked at beside the picture:
// nothing of the scene or its options changes for it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/session/background_task.h"
#include "app/session/session.h"

namespace trace {

/// Paths that have so many places from the light's end (s) and from the camera's (t).
struct Way {
  int light = 0, camera = 1;
  bool operator==(const Way&) const = default;
};

/// Which pictures are asked for.
struct PyramidPlan {
  std::shared_ptr<const Session> session{};  ///< whose scene they are of
  bool unweighted = false;                   ///< each way alone, as if there were no other
  int places = 5;                            ///< places of the longest paths
  std::optional<Way> alone{};                ///< this one only, and larger
  bool operator==(const PyramidPlan&) const = default;
};

struct WayPicture {
  Way way;
  Picture picture;  ///< as rendered, before tone
};

struct Pyramid {
  PyramidPlan plan;
  std::vector<WayPicture> pictures{};  ///< row by row, of a row the fewest places from the light first
  double longer = 0;                   ///< share of the picture's light that longer paths bring; else 0
  std::string problem{};               ///< why there are none; "" if there are
};

/// Options of the integrator show one strategy alone.
bool showsStrategies(const Settings& settings);

/// Renders it, at small size; none of a session that does not show strategies. Keeps errors as the problem.
Pyramid wayPyramid(const PyramidPlan& plan, const Cancelled& cancelled = {});

/// Renders them in the background, for a window that asks in every frame.
class PyramidMaker {
 public:
  /// To be called often. A session that differs from the last only in the ways that it shows has the same
  /// pyramid. Without a session what is being rendered is given up, and what is there stays.
  void want(const PyramidPlan& plan);
  /// Takes what has come in the meantime; true if there is something new.
  bool update();
  bool busy() const { return task_.busy(); }
  const Pyramid& pyramid() const { return shown_; }
  /// The pyramid is the one that is wanted: not an older one, in whose place another is being made.
  bool current() const { return wanted_.session && asked_ == shown_.plan; }

 private:
  Pyramid shown_;
  PyramidPlan wanted_;  // last
  PyramidPlan asked_;   // that is there or being made for it
  BackgroundTask<std::optional<Pyramid>> task_;
};

}  // namespace trace
