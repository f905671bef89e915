// Draws triangles and lines in space into a texture: the OpenGL of the 3D view. What is drawn, others decide
// (app/scene_model.h, scene_view.cpp).
#pragma once

#include <imgui.h>

#include <array>
#include <memory>
#include <vector>

#include "app/orbit_camera.h"
#include "math/color.h"

namespace trace::studio {

using Point3 = std::array<float, 3>;

struct DrawLine {
  Point3 from, to;
  std::array<float, 4> colour;  ///< with opacity
  float width;                  ///< pixels
  float dash;                   ///< pixels on and as many off; 0: not dashed
};

class SceneDrawer {
 public:
  SceneDrawer();  ///< an OpenGL context must be current
  ~SceneDrawer();
  SceneDrawer(const SceneDrawer&) = delete;
  SceneDrawer& operator=(const SceneDrawer&) = delete;

  /// Six floats for each corner: position and normal.
  void setCorners(const std::vector<float>& corners);

  void begin(int width, int height, const ImVec4& background, const Matrix4& matrix, const Vec3& eye);
  void triangles(std::size_t first, std::size_t count, const Color& colour, float opacity, bool wire);
  /// Lines behind surfaces are drawn fainter, with `hidden` times their opacity.
  void lines(const std::vector<DrawLine>& lines, float hidden);
  /// A picture on a quad: its corners from the top left, clockwise.
  void picture(const std::array<Point3, 4>& corners, unsigned texture, float opacity);
  /// What was drawn since begin(); its row 0 is at the bottom.
  ImTextureID end();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace trace::studio
