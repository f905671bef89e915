#include "app/editing/placing.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "base/find_field.h"
#include "formats/directions.h"
#include "geometry/mesh/tessellate.h"
#include "math/elementary.h"
#include "shading/frame.h"

namespace trace {
namespace {

/// The axis of the world that is up for a camera.
Vec3 upOf(const Vec3& updir) {
  int axis = 0;
  for (int i = 1; i < 3; ++i)
    if (std::abs(updir[i]) > std::abs(updir[axis])) axis = i;
  Vec3 up;
  up[axis] = updir[axis] < 0 ? -1 : 1;
  return up;
}

}  // namespace

Affine turned(const Affine& placed, const Vec3& degrees) {
  Affine result = placed;
  result.offset = {};
  const Vec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int i = 0; i < 3; ++i)
    if (degrees[i] != 0) result = Affine::rotation(axes[i], degrees[i] * kPi / 180) * result;
  result.offset = placed.offset;
  return result;
}

bool isFactor(Real factor) { return std::abs(factor) <= 1e6 && std::abs(factor) >= 1e-6; }

Affine stretched(const Affine& placed, const Vec3& factors) { return placed * Affine::scaling(factors); }

/// Without the last digits, which only rounding made.
static Real toTwelveDigits(Real x) {
  char text[40];
  std::snprintf(text, sizeof text, "%.12g", x);
  return std::strtod(text, nullptr);
}

Affine withoutNoise(const Affine& placed) {
  Affine result = placed;
  Real size = 0;
  for (const Vec3& v : {placed.row[0], placed.row[1], placed.row[2], placed.offset})
    size = std::max({size, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  for (int i = 0; i < 3; ++i)
    result.offset[i] = std::abs(placed.offset[i]) < 1e-13 * size ? 0 : toTwelveDigits(placed.offset[i]);
  return result;
}

bool keepsObject(const Affine& placed) { return isFinite(placed.offset) && invertible(placed); }

/// On the side that the eye sees.
static Vec3 normalToward(const Vec3& eye, const SurfacePoint& seen) {
  return dot(seen.normal, seen.point - eye) > 0 ? -seen.normal : seen.normal;
}

Affine placedInSight(const Box3& bounds, const CameraFrame& camera, const Vec3& updir,
                     const std::optional<SurfacePoint>& there, Real ahead) {
  constexpr Real kShare = 0.25;  // share of the height of the picture
  const Real longest = maxComponent(bounds.size());
  if (bounds.empty() || bounds.unbounded() || !(longest > 0)) return {};
  const Vec3 at = there ? there->point : camera.eye + normalize(camera.look) * ahead;
  const Real distance = there ? length(at - camera.eye) : ahead;
  const Real size = kShare * distance * length(camera.up) / length(camera.look);
  const Real factor = size / longest;
  const Vec3 up = upOf(updir);
  Vec3 side = up;
  if (there) {
    const Vec3 facing = normalToward(camera.eye, *there);
    if (dot(facing, up) < 0.5) side = facing;  // a wall: before it, not on it
  }
  const Vec3 half = bounds.size() * (factor / 2);
  const Real reach = std::abs(side.x) * half.x + std::abs(side.y) * half.y + std::abs(side.z) * half.z;
  const Vec3 middle = there ? at + side * reach : at;
  return Affine::translation(middle - bounds.center() * factor) * Affine::scaling(Vec3(1, 1, 1) * factor);
}

Affine onItsFoot(const Box3& before, const Affine& placed, const Box3& after, const Vec3& updir) {
  const Vec3 up = upOf(updir);
  const auto foot = [&](const Box3& box) { return std::min(dot(box.low, up), dot(box.high, up)); };
  if (before.empty() || after.empty() || before.unbounded() || after.unbounded()) return placed;
  return Affine::translation(up * (foot(before) - foot(after))) * placed;
}

Vec3 letDown(const Box3& own, const Vec3& updir,
             const std::function<std::optional<Real>(const Ray&)>& distance) {
  const Vec3 up = upOf(updir);
  const std::optional<Real> below = distance({own.center(), -up});
  const Real half = std::abs(dot(own.size(), up)) / 2;
  return below && *below > half ? -up * (*below - half) : Vec3{};
}

namespace {

/// Is the object in it as in a room, together with the eye?
bool isRoom(const Box3& other, const Box3& own, const Vec3& eye) {
  return other.contains(own.low) && other.contains(own.high) && other.contains(eye);
}

/// They have more than a touch in common.
bool overlap(const Box3& a, const Box3& b) {
  constexpr Real kTouch = 0.01;  // share of the size of the first
  for (int i = 0; i < 3; ++i) {
    const Real touch = kTouch * a.size()[i];
    if (a.high[i] - touch <= b.low[i] || b.high[i] <= a.low[i] + touch) return false;
  }
  return true;
}

}  // namespace

Vec3 freedFrom(const std::vector<Box3>& others, const Box3& own, const CameraFrame& camera,
               const Vec3& updir) {
  const auto moved = [&](const Vec3& by) { return Box3{own.low + by, own.high + by}; };
  const auto isFree = [&](const Vec3& by) {
    const Box3 there = moved(by);
    return std::none_of(others.begin(), others.end(), [&](const Box3& other) {
      return overlap(there, other) && !isRoom(other, there, camera.eye);
    });
  };
  if (isFree({})) return {};
  const Vec3 up = upOf(updir), right = normalize(camera.right - up * dot(camera.right, up));
  const Vec3 back = cross(right, up);
  const Real step = 0.55 * maxComponent(own.size());
  constexpr int kSteps = 6;
  const auto isSeen = [&](const Vec3& by) {
    const auto at = camera.placeOf(own.center() + by);
    return at && at->x > 0 && at->x < 1 && at->y > 0 && at->y < 1;
  };
  for (const bool seen : {true, false})
    for (int i = 1; i <= kSteps; ++i)
      for (const Vec3& way : {right, -right, back})
        if (const Vec3 by = way * (step * i); (!seen || isSeen(by)) && isFree(by)) return by;
  for (int i = 1; i <= 2 * kSteps; ++i)
    if (const Vec3 by = up * (step * i); isFree(by)) return by;
  return {};
}

Box3 boxOf(const Object& object) {
  constexpr Box3 kEverywhere{{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}};
  const Box3 own = drawnBounds(object.shape, kEverywhere);
  return own.empty() || own.unbounded() ? own : object.worldFromObject * own;
}

std::vector<Box3> boxesOf(const Scene& scene) {
  std::vector<Box3> boxes;
  for (const Object& object : scene.objects)
    if (const Box3 box = boxOf(object); !box.empty() && !box.unbounded()) boxes.push_back(box);
  return boxes;
}

Affine upright(const ShapeType& shape, const Vec3& updir) {
  if (!shape.alongZ) return {};
  const Vec3 axis{0, 0, 1}, up = upOf(updir), across = cross(axis, up);
  if (length(across) > 0) return Affine::rotation(across, kPi / 2);
  return dot(axis, up) > 0 ? Affine{} : Affine::rotation({1, 0, 0}, kPi);
}

namespace {

/// Around a box as the picture shows it; nothing if some of it is behind the camera.
struct Rectangle {
  Vec2 low{kInfinity, kInfinity}, high{-kInfinity, -kInfinity};
  Real area() const { return std::max(0.0, high.x - low.x) * std::max(0.0, high.y - low.y); }
};
std::optional<Rectangle> shownOf(const Box3& box, const CameraFrame& camera) {
  Rectangle shown;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 at{corner & 1 ? box.high.x : box.low.x, corner & 2 ? box.high.y : box.low.y,
                  corner & 4 ? box.high.z : box.low.z};
    const auto place = camera.placeOf(at);
    if (!place) return {};
    shown.low = {std::min(shown.low.x, place->x), std::min(shown.low.y, place->y)};
    shown.high = {std::max(shown.high.x, place->x), std::max(shown.high.y, place->y)};
  }
  return shown;
}

/// The share of the first that lies before or behind the second.
Real sharedPart(const Rectangle& a, const Rectangle& b) {
  const Rectangle both{{std::max(a.low.x, b.low.x), std::max(a.low.y, b.low.y)},
                       {std::min(a.high.x, b.high.x), std::min(a.high.y, b.high.y)}};
  return a.area() > 0 && both.high.x > both.low.x && both.high.y > both.low.y ? both.area() / a.area() : 0;
}

/// An object may stand there with room around it.
bool isWide(const Box3& support, const Box3& own, const Vec3& up) {
  for (int axis = 0; axis < 3; ++axis)
    if (up[axis] == 0 && support.size()[axis] < 2 * own.size()[axis]) return false;
  return true;
}

}  // namespace

std::optional<Affine> placedAmong(const Box3& bounds, const CameraFrame& camera, const Vec3& updir,
                                  const std::vector<Box3>& others, const LookAt& lookAt) {
  constexpr int kPlaces = 17;               // along each side of the picture
  constexpr Real kRim = 0.02, kFlat = 0.8;  // shares of the picture; least cosine
  // Against the distance from the middle: across, and by the logarithm in depth, which counts twice.
  constexpr Real kHides = 2, kNarrow = 4, kDepth = 2, kSmaller = 1;
  const Vec3 up = upOf(updir);
  const auto distanceTo = [&](const SeenObject& seen) { return length(seen.surface.point - camera.eye); };
  const auto middle = lookAt({0.5, 0.5});
  std::optional<Affine> best;
  Real least = kInfinity;
  for (const Real smaller : {1.0, 0.6, 0.35}) {  // rather smaller than far away
    for (int i = 0; i < kPlaces * kPlaces; ++i) {
      const Vec2 place{(i % kPlaces + 0.5) / kPlaces, (i / kPlaces + 0.5) / kPlaces};
      Real cost = math::hypot(place.x - 0.5, place.y - 0.5) + kSmaller * (1 - smaller);
      if (cost >= least) continue;
      const auto seen = lookAt(place);
      if (!seen || dot(normalToward(camera.eye, seen->surface), up) < kFlat) continue;
      if (middle) cost += kDepth * std::abs(math::log(distanceTo(*seen) / distanceTo(*middle)));
      const Vec3& foot = seen->surface.point;
      const Affine first = placedInSight(bounds, camera, updir, seen->surface, 0);
      const Affine placed = Affine::translation(foot) * Affine::scaling(Vec3(1, 1, 1) * smaller) *
                            Affine::translation(-foot) * first;
      const Box3 full = first * bounds;
      const Box3 own = placed * bounds;
      const auto shown = shownOf(own, camera);
      if (!shown || shown->low.x < kRim || shown->low.y < kRim || shown->high.x > 1 - kRim ||
          shown->high.y > 1 - kRim)
        continue;
      if (!isWide(seen->box, full, up)) cost += kNarrow;
      for (const Box3& other : others) {
        if (other == seen->box || isRoom(other, own, camera.eye)) continue;
        const auto hidden = shownOf(other, camera);
        cost += overlap(own, other) ? kInfinity : hidden ? kHides * sharedPart(*shown, *hidden) : 0;
      }
      if (cost >= least) continue;
      least = cost;
      best = placed;
    }
  }
  return best;
}

Vec3 placeOfLight(const CameraFrame& camera, const Vec3& updir, const Vec3& target) {
  const Vec3 up = upOf(updir), back = camera.eye - target;
  const Real distance = length(back);
  return target + (up * 0.6 - normalize(camera.right) * 0.4) * distance + back * 0.15;
}

/// To three digits of the largest, as a person would write it.
static Vec3 shortVec(const Vec3& v) {
  const Real most = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!(most > 0) || !std::isfinite(most)) return v;
  const Real step = math::pow(10, std::floor(math::log(most) / math::log(10.0)) - 2);
  const auto near = [&](Real x) { return toTwelveDigits(std::round(x / step) * step); };
  return {near(v.x), near(v.y), near(v.z)};
}
static Color shortColor(const Color& c) {
  const Vec3 v = shortVec({c.r, c.g, c.b});
  return {v.x, v.y, v.z};
}

void aimLight(Light& light, const Vec3& position, const Vec3& target) {
  constexpr Real kBright = 0.5;  // the brightness of a white surface there; nearer ones are brighter
  const Vec3 toward = target - position;
  const Real distance = length(toward);
  if (!(distance > 0)) return;
  Color* color = editableValue<Color>(light, "color");
  if (color) *color = Color(1);
  if (Vec3* to = editableValue<Vec3>(light, "direction")) *to = shortVec(toward);
  Vec3* at = editableValue<Vec3>(light, "position");
  if (!at) return;
  *at = shortVec(position);
  Vec3 *u = editableValue<Vec3>(light, "u"), *v = editableValue<Vec3>(light, "v");
  if (u && v) {  // as wide as a third of the distance; it shines toward u x v
    const Basis across = Frame{toward / distance}.basis();
    const Real side = distance / 3;
    *u = shortVec(across.x * side);
    *v = shortVec(across.y * side);
    if (dot(cross(*u, *v), toward) < 0) *v = -*v;
    if (color) *color = shortColor(Color(kBright * kPi * distance * distance / (side * side)));
    return;
  }
  const auto of = [&](std::string_view keyword) {
    const Real* value = findValue<Real>(light, keyword);
    return value ? *value : 0;
  };
  const Real fading = of("constant_attenuation_coeff") + of("linear_attenuation_coeff") * distance +
                      of("quadratic_attenuation_coeff") * distance * distance;
  if (color && fading > 0) *color = shortColor(Color(kBright * fading));
}

bool cameraSees(const Camera& camera) {
  return camera.fov > 0 && camera.fov < 180 && camera.aspectratio > 0 && isFinite(camera.position) &&
         canLook(camera.viewdir, camera.updir);
}

}  // namespace trace
