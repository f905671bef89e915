// The pyramid of strategies (Veach 1997, figure 10.5): what each way of putting paths together from both ends
// brings to the picture of `bdpt`, a row for each number of places.
#pragma once

#include <memory>
#include <vector>

#include "app/background_task.h"
#include "app/session.h"

namespace trace {

/// What the paths bring that have so many places from the light's end and from the camera's.
struct WayPicture {
  int light = 0, camera = 1;
  Picture picture;  ///< as rendered, before tone
};

struct Pyramid {
  std::shared_ptr<const Session> session;  ///< whose scene it is of
  bool unweighted = false;                 ///< each way alone, as if there were no other
  int places = 5;                          ///< of the longest paths
  std::vector<WayPicture> pictures{};      ///< row by row, of a row the fewest places from the light first
  std::string problem{};                   ///< why there are none; "" if there are
};

/// Renders it, at small size; none of a session whose integrator is not bdpt. Keeps errors as the problem.
Pyramid wayPyramid(std::shared_ptr<const Session> session, bool unweighted, int places,
                   const Cancelled& cancelled = {});

/// The same in the background, for a window that asks in every frame.
class PyramidMaker {
 public:
  /// To be called often. A session that differs from the last only in the ways that it shows has the same
  /// one.
  void want(const std::shared_ptr<const Session>& session, bool unweighted, int places);
  /// What is being rendered is given up; what is there stays.
  void giveUp();
  /// Takes what has come in the meantime; true if there is something new.
  bool update();
  bool busy() const { return task_.busy(); }
  const Pyramid& pyramid() const { return shown_; }

 private:
  Pyramid shown_, asked_;
  std::shared_ptr<const Session> alike_;  // that came last, if it has the one that was asked for
  BackgroundTask<Pyramid> task_;
};

}  // namespace trace
