// Draws triangles and lines in space into a texture: the OpenGL of the 3D view. What is drawn, others decide
// (app/view/space/scene_model.h, scene_view.cpp).
#pragma once

#include <imgui.h>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "app/view/orbit_camera.h"
#include "app/view/space/scene_model.h"
#include "math/color.h"

namespace trace::studio {

using Point3 = std::array<float, 3>;

struct DrawLine {
  Point3 from, to;
  std::array<float, 4> colour;  ///< with opacity
  float width;                  ///< pixels
  float dash;                   ///< pixels on and as many off; 0: not dashed
  bool operator==(const DrawLine&) const = default;
};

/// Triangles, by the indices of SceneDrawer::setCorners().
struct DrawSurface {
  std::size_t first, count;
  Color colour;
  float opacity;
  bool wall = false;  ///< not drawn where it parts the eye from SpaceDrawing::inside
  bool operator==(const DrawSurface&) const = default;
};

/// A picture on a quad: its corners from the top left, clockwise.
struct DrawPicture {
  std::array<Point3, 4> corners;
  unsigned texture;
  std::uint64_t version;  ///< version of the texture's contents
  float opacity;
  bool operator==(const DrawPicture&) const = default;
};

/// A light that surfaces are shaded by.
struct DrawLight {
  Vec3 place;  ///< or the direction to it
  bool far = false;
  Color colour;
  bool operator==(const DrawLight&) const = default;
};

/// All that there is to see.
struct SpaceDrawing {
  int width = 0, height = 0;
  std::array<float, 4> background{};
  Matrix4 matrix{};
  Vec3 eye{}, inside{};
  static constexpr std::size_t kMostLights = 8;
  std::vector<DrawLight> lights{};  ///< at most so many; none: a light at the eye
  bool flat = false;                ///< the normals of triangles, not those of their corners
  std::vector<DrawSurface> solid{}, clear{}, wires{};  ///< clear: others show through
  std::optional<DrawPicture> picture{};
  std::vector<DrawLine> lines{};
  float hidden = 0;  ///< lines behind surfaces are drawn fainter, with so much of their opacity
  bool operator==(const SpaceDrawing&) const = default;
};

/// Draws it plainly at once, then smoothly in a few steps, one for each call: so a frame is never late.
class SceneDrawer {
 public:
  SceneDrawer();  ///< an OpenGL context must be current
  ~SceneDrawer();
  SceneDrawer(const SceneDrawer&) = delete;
  SceneDrawer& operator=(const SceneDrawer&) = delete;

  void setCorners(const SharedCorners& corners);
  /// Draws it plainly if it is not what was drawn last: one sample a pixel, surfaces that others show through
  /// in no order. Else, if it `rests`, the next step on the way to a smooth picture. Row 0 of the texture is
  /// at the bottom.
  ImTextureID show(SpaceDrawing drawing, bool rests);
  /// Whether the picture is not smooth yet.
  bool coarse() const;
  /// How often something else was drawn.
  std::uint64_t drawn() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace trace::studio
