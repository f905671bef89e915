// From where each benchmark mesh is looked at and lit. The same views were used to measure other programs, so
// that numbers can be compared: do not change them.
#pragma once

#include <string_view>

#include "math/box.h"

namespace trace::bench {

struct View {
  Vec3 eye, at, light;
  double fov;     ///< vertical and horizontal, degrees
  double radius;  ///< half the diagonal of the mesh's box
  int size;       ///< pixels on a side

  /// Unit vectors and, scaled to the picture's half size at distance 1, right and up.
  Vec3 forward() const { return normalize(at - eye); }
  Vec3 right() const;
  Vec3 up() const;
};

/// `name` is the mesh file's without its ending; `box` holds the mesh, which was made `scale` times larger.
View viewOf(std::string_view name, const Box3& box, double scale = 1);

}  // namespace trace::bench
