#include "app/view/panel.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "app/view/magnifier.h"
#include "app/view/space/room.h"
#include "app/view/space/scene_model.h"
#include "math/elementary.h"

namespace trace {

Panel::Panel(const CameraFrame& camera, const Point2& at, double width, double height)
    : camera_(camera), at_(at), width_(width), height_(height), eye_(camera.eye) {
  // p = eye + s (look + a right + b up): (s a, s b, s) = inverse of the axes' matrix.
  Affine axes;
  for (int i = 0; i < 3; ++i) axes.row[i] = {camera.right[i], camera.up[i], camera.look[i]};
  toPlane_ = inverse(axes);
}

void Panel::line(Drawing& drawing, Vec3 from, Vec3 to, const Color& color, double width, bool dashed) const {
  if (!camera_.plain) return bent(drawing, from, to, color, width, dashed);
  Vec3 a = linear(toPlane_, from - eye_), b = linear(toPlane_, to - eye_);
  const Real near = 1e-6 * std::max(std::abs(a.z), std::abs(b.z));  // just before the eye
  if (!isFinite(a) || !isFinite(b) || (a.z <= near && b.z <= near)) return;
  if (a.z < near) a = a + (b - a) * ((near - a.z) / (b.z - a.z));
  if (b.z < near) b = b + (a - b) * ((near - b.z) / (a.z - b.z));
  Point2 p = place(a), q = place(b);
  if (clip(p, q)) drawing.things.push_back(DrawnLine{p, q, color, width, dashed});
}

std::optional<Point2> Panel::placeOf(const Vec3& point) const {
  const auto seen = isFinite(point) ? camera_.placeOf(point) : std::nullopt;
  if (!seen || !std::isfinite(seen->x) || !std::isfinite(seen->y)) return {};
  const Point2 at = place(*seen);
  const bool within = at.x > at_.x && at.x < at_.x + width_ && at.y > at_.y && at.y < at_.y + height_;
  return within ? std::optional(at) : std::nullopt;
}

std::optional<Point2> Panel::toward(const Vec3& point) const {
  const Vec3 p = linear(toPlane_, point - eye_);
  const Point2 way{p.x * width_, -p.y * height_};
  const double far = math::hypot(way.x, way.y);
  if (placeOf(point) || !(far > 0) || !std::isfinite(far)) return {};
  return Point2{way.x / far, way.y / far};
}

Point2 Panel::edgeAt(const Point2& toward, double margin) const {
  const Vec2 mark = edgeMark({width_, height_}, {toward.x, toward.y}, margin);
  return {at_.x + mark.x, at_.y + mark.y};
}

void Panel::disk(Drawing& drawing, const Vec3& point, double radius, const Color& color) const {
  if (const auto at = placeOf(point)) drawing.things.push_back(DrawnDisk{*at, radius, color});
}

void Panel::arrowHead(Drawing& drawing, const Vec3& from, const Vec3& to, const Color& color, double size,
                      double rim) const {
  constexpr Real kBefore = 0.5, kTip = 0.55;  // shares of the way
  const auto before = placeOf(from + (to - from) * kBefore), tip = placeOf(from + (to - from) * kTip);
  if (!before || !tip) return;
  const double dx = tip->x - before->x, dy = tip->y - before->y, far = math::hypot(dx, dy);
  if (far < 1) return;
  const double x = dx / far, y = dy / far;
  const auto head = [&](double ahead, double behind, double half, const Color& tint) {
    const Point2 base{tip->x - x * behind, tip->y - y * behind};
    drawing.things.push_back(DrawnTriangle{{tip->x + x * ahead, tip->y + y * ahead},
                                           {base.x - y * half, base.y + x * half},
                                           {base.x + y * half, base.y - x * half},
                                           tint});
  };
  if (rim > 0) head(2 * rim, size + rim, size / 2 + 1.6 * rim, Color(1));
  head(0, size, size / 2, color);
}

/// In a projection that bends lines, or from two eyes: piece by piece.
void Panel::bent(Drawing& drawing, const Vec3& from, const Vec3& to, const Color& color, double width,
                 bool dashed) const {
  constexpr int kPieces = 48;
  std::optional<Point2> last;
  for (int i = 0; i <= kPieces; ++i) {
    const Vec3 at = from + (to - from) * (static_cast<Real>(i) / kPieces);
    const auto seen = isFinite(at) ? camera_.placeOf(at) : std::nullopt;
    const bool finite = seen && std::isfinite(seen->x) && std::isfinite(seen->y);
    const std::optional<Point2> here = finite ? std::optional(place(*seen)) : std::nullopt;
    // A panorama's line may leave at one side and come back at the other.
    if (last && here && std::abs(here->x - last->x) < width_ / 2) {
      Point2 p = *last, q = *here;
      if (clip(p, q)) drawing.things.push_back(DrawnLine{p, q, color, width, dashed});
    }
    last = here;
  }
}

/// To a little more than the frame (Liang and Barsky 1984); false if nothing is left.
bool Panel::clip(Point2& p, Point2& q) const {
  constexpr double kBeyond = 8;
  const double dx = q.x - p.x, dy = q.y - p.y;
  double first = 0, last = 1;
  const auto within = [&](double d, double room) {  // room: what t d may be at most
    if (d == 0) return room >= 0;
    if (d > 0)
      last = std::min(last, room / d);
    else
      first = std::max(first, room / d);
    return first <= last;
  };
  if (!within(dx, at_.x + width_ + kBeyond - p.x) || !within(-dx, p.x - at_.x + kBeyond) ||
      !within(dy, at_.y + height_ + kBeyond - p.y) || !within(-dy, p.y - at_.y + kBeyond))
    return false;
  const Point2 start = p;
  p = {start.x + dx * first, start.y + dy * first};
  q = {start.x + dx * last, start.y + dy * last};
  return true;
}

Settings plainView(Settings settings) {
  const Settings defaults;
  settings.cameraAxes = CameraAxes::orthonormal;
  settings.projection = defaults.projection;
  settings.shiftX = settings.shiftY = 0;
  settings.distortion = 0;
  settings.stereo = Stereo::off;
  settings.aperture = 0;
  return settings;
}

DrawnPicture colouredSketch(const World& world, const Scene& scene, const std::vector<std::uint32_t>& walls,
                            const Vec3& inside, const Point2& at, double width, double height) {
  constexpr int kMostLayers = 6;
  constexpr Color kNothing(0.93, 0.95, 0.97);
  std::vector<MaterialLook> looks;
  for (const Material& material : scene.materials) looks.push_back(lookOf(material));
  const auto lookAt = [&](const Found& found) {
    const MaterialMix mix = world.materialMix(found);
    const bool known = mix.count > 0 && mix.material[0] < looks.size();
    return known ? looks[mix.material[0]] : MaterialLook{Color(0.7), 0};
  };
  const auto shaded = [&](const Ray& ray, const Found& found) {
    const Real facing = std::abs(dot(world.surface(ray, found).normal, ray.direction));
    return lookAt(found).color * (0.5 + 0.5 * facing / length(ray.direction));
  };
  const Box3 near = frameOf(scene);
  const auto cutOff = [&](const Ray& ray, const Found& found) {
    return world.ownBoundsOf(found.object).unbounded() && !near.empty() && !near.contains(ray.at(found.t));
  };
  Picture picture(static_cast<int>(width), static_cast<int>(height));
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      Color& pixel = picture.at(x, y) = kNothing;
      const Ray ray = world.camera().ray({(x + 0.5) / picture.width, 1 - (y + 0.5) / picture.height});
      const auto nearest = closestShown(world, ray, walls, inside);
      if (!nearest) continue;
      if (lookAt(*nearest).opacity >= 1 && !cutOff(ray, *nearest)) {
        pixel = shaded(ray, *nearest);
        continue;
      }
      std::vector<Found> all = shownCrossings(world, ray, walls, inside);
      std::erase_if(all, [&](const Found& found) { return cutOff(ray, found); });
      if (all.empty()) continue;
      const auto layers = std::min<std::size_t>(all.size(), kMostLayers);
      const auto solid = std::find_if(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(layers),
                                      [&](const Found& found) { return lookAt(found).opacity >= 1; });
      auto layer = solid == all.end() ? solid : solid + 1;
      while (layer != all.begin()) {
        --layer;
        pixel = lerp(lookAt(*layer).opacity, pixel, shaded(ray, *layer));
      }
    }
  return {at, std::move(picture)};
}

DrawnPicture sketch(const World& world, const std::vector<std::uint32_t>& walls, const Vec3& inside,
                    const Point2& at, double width, double height) {
  Picture picture(static_cast<int>(width), static_cast<int>(height));
  picture.pixels.assign(picture.pixels.size(), Color(1));
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const Ray ray = world.camera().ray({(x + 0.5) / picture.width, 1 - (y + 0.5) / picture.height});
      const auto found = closestShown(world, ray, walls, inside);
      if (!found) continue;
      const Real facing = std::abs(dot(world.surface(ray, *found).normal, ray.direction));
      picture.at(x, y) = Color(0.6 + 0.4 * facing / length(ray.direction));
    }
  return {at, std::move(picture)};
}

}  // namespace trace
