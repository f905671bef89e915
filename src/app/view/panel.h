// A view of the scene as a part of a drawing.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "app/view/drawing.h"
#include "math/transform.h"
#include "render/world/world.h"
#include "shading/cameras/camera.h"

namespace trace {

inline constexpr Color kInk{0.15, 0.15, 0.15};

/// A view of the scene: its frame on the drawing, and the way from space to it.
class Panel {
 public:
  Panel(const CameraFrame& camera, const Point2& at, double width, double height);

  DrawnFrame frame() const { return {at_, width_, height_}; }

  /// Nothing of a segment outside the view is drawn.
  void line(Drawing& drawing, Vec3 from, Vec3 to, const Color& color, double width, bool dashed) const;
  /// The place of a point; nothing outside the view.
  std::optional<Point2> placeOf(const Vec3& point) const;
  /// The direction on the drawing, of length 1, from the middle of the view to a point that lies outside it;
  /// nothing for one within it.
  std::optional<Point2> toward(const Vec3& point) const;
  /// The place of a mark at the edge of the view in that direction.
  Point2 edgeAt(const Point2& toward, double margin) const;
  /// A head at a share of the way, which shows where a ray goes; with a white rim, if it has a width.
  void arrowHead(Drawing& drawing, const Vec3& from, const Vec3& to, const Color& color, double size,
                 double rim = 0) const;
  void disk(Drawing& drawing, const Vec3& point, double radius, const Color& color) const;

 private:
  void bent(Drawing& drawing, const Vec3& from, const Vec3& to, const Color& color, double width,
            bool dashed) const;
  Point2 place(const Vec2& p) const { return {at_.x + width_ * p.x, at_.y + height_ * (1 - p.y)}; }
  Point2 place(const Vec3& p) const {
    return {at_.x + width_ * (p.x / p.z + 0.5), at_.y + height_ * (0.5 - p.y / p.z)};
  }
  bool clip(Point2& p, Point2& q) const;

  CameraFrame camera_;
  Point2 at_;
  double width_, height_;
  Vec3 eye_;
  Affine toPlane_;
};

/// The settings for a view of the scene from elsewhere: by a camera without a lens, that sees lines as lines.
Settings plainView(Settings settings);

/// The surfaces in the colours of their materials, glass as clear as it is, otherwise as sketch().
/// Infinite objects are cut off around the others, as in the window.
DrawnPicture colouredSketch(const World& world, const Scene& scene, const std::vector<std::uint32_t>& walls,
                            const Vec3& inside, const Point2& at, double width, double height);

/// The surfaces as the world's camera sees them, shaded by how much they face the eye, without the light of
/// the scene: of rooms with few samples by `path` there would be nothing but noise. Walls that hide the place
/// `inside` are left out. White where nothing is.
DrawnPicture sketch(const World& world, const std::vector<std::uint32_t>& walls, const Vec3& inside,
                    const Point2& at, double width, double height);

}  // namespace trace
