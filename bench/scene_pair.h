// One scene in two languages: the courses' .ray, and POV-Ray 3.7's .pov. Each call writes the same thing to
// both, in the same right-handed coordinates (POV-Ray is told the camera's axes, so its own handedness does
// not matter).
//
// What makes the two programs compute the same: no ambient light, lamps that do not fade, Phong highlights,
// constant mirror and glass weights applied at each surface, no ray dropped for being faint, linear pixels.
#pragma once

#include <fstream>
#include <string>

#include "geometry/mesh/mesh.h"
#include "view.h"

namespace trace::bench {

struct Look {
  Vec3 color;          ///< scattered
  double phong = 0;    ///< strength of the highlight
  double mirror = 0;   ///< weight of the mirrored ray
  double through = 0;  ///< weight of the refracted ray; glass scatters nothing
  double index = 1;
};

class ScenePair {
 public:
  /// Writes BASE.ray and BASE.pov. Pictures are square.
  explicit ScenePair(const std::string& base);
  /// Throws Error when a file could not be written whole.
  void finish();

  void camera(const View& view);
  void lamp(const Vec3& position, double brightness);
  void sphere(const Vec3& center, double radius, const Look& look);
  void box(const Vec3& low, const Vec3& high, const Look& look);
  /// Upward along y.
  void cone(const Vec3& base, double height, double bottomRadius, double topRadius, const Look& look);
  void mesh(const MeshData& data, const Look& look);

 private:
  std::string base_;
  std::ofstream ray_, pov_;
};

}  // namespace trace::bench
