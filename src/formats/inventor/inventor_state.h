// The state that Inventor's property nodes set for the nodes that follow them.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "formats/inventor/inventor_paint.h"
#include "math/transform.h"

namespace trace::inventor {

/// Copied where a Separator saves it; the lists are shared.
struct State {
  Affine worldFromObject;
  std::shared_ptr<const std::vector<Vec3>> points, normals;
  std::shared_ptr<const std::vector<Vec2>> uvs;
  std::shared_ptr<const Paint> paint;
  std::string_view materialBinding = "DEFAULT", normalBinding = "DEFAULT", uvBinding = "PER_VERTEX_INDEXED";
  bool ordered = false, counterClockwise = true, solid = false;
  Real creaseAngle = 0;
  Real unit = 1;  ///< in metres
};

}  // namespace trace::inventor
