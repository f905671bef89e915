#include "app/editing/placing.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "base/find_field.h"
#include "formats/directions.h"
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

bool keepsObject(const Affine& placed) { return isFinite(placed.offset) && invertible(placed); }

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
    const Vec3 facing = dot(there->normal, at - camera.eye) > 0 ? -there->normal : there->normal;
    if (dot(facing, up) < 0.5) side = facing;  // a wall: before it, not on it
  }
  const Vec3 half = bounds.size() * (factor / 2);
  const Real reach = std::abs(side.x) * half.x + std::abs(side.y) * half.y + std::abs(side.z) * half.z;
  const Vec3 middle = there ? at + side * reach : at;
  return Affine::translation(middle - bounds.center() * factor) * Affine::scaling(Vec3(1, 1, 1) * factor);
}

Vec3 letDown(const Box3& own, const Vec3& updir,
             const std::function<std::optional<Real>(const Ray&)>& distance) {
  const Vec3 up = upOf(updir);
  const std::optional<Real> below = distance({own.center(), -up});
  const Real half = std::abs(dot(own.size(), up)) / 2;
  return below && *below > half ? -up * (*below - half) : Vec3{};
}

namespace {

bool holds(const Box3& outer, const Box3& inner) {
  return outer.contains(inner.low) && outer.contains(inner.high);
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
    return std::none_of(others.begin(), others.end(),
                        [&](const Box3& other) { return overlap(there, other) && !holds(other, there); });
  };
  if (isFree({})) return {};
  const Vec3 up = upOf(updir), right = normalize(camera.right - up * dot(camera.right, up));
  const Vec3 back = cross(right, up);
  const Real step = 0.55 * maxComponent(own.size());
  constexpr int kSteps = 6;
  for (int i = 1; i <= kSteps; ++i)
    for (const Vec3& way : {right, -right, back})
      if (const Vec3 by = way * (step * i); isFree(by)) return by;
  for (int i = 1; i <= 2 * kSteps; ++i)
    if (const Vec3 by = up * (step * i); isFree(by)) return by;
  return {};
}

Vec3 placeOfLight(const CameraFrame& camera, const Vec3& updir, const Vec3& target) {
  const Vec3 up = upOf(updir), back = camera.eye - target;
  const Real distance = length(back);
  return target + (up * 0.6 - normalize(camera.right) * 0.4) * distance + back * 0.15;
}

void aimLight(Light& light, const Vec3& position, const Vec3& target) {
  constexpr Real kBright = 0.5;  // the brightness of a white surface there; nearer ones are brighter
  const Vec3 toward = target - position;
  const Real distance = length(toward);
  if (!(distance > 0)) return;
  Color* color = editableValue<Color>(light, "color");
  if (color) *color = Color(1);
  if (Vec3* to = editableValue<Vec3>(light, "direction")) *to = toward;
  Vec3* at = editableValue<Vec3>(light, "position");
  if (!at) return;
  *at = position;
  Vec3 *u = editableValue<Vec3>(light, "u"), *v = editableValue<Vec3>(light, "v");
  if (u && v) {  // as wide as a third of the distance; it shines toward u x v
    const Basis across = Frame{toward / distance}.basis();
    const Real side = distance / 3;
    *u = across.x * side;
    *v = across.y * side;
    if (dot(cross(*u, *v), toward) < 0) *v = -*v;
    if (color) *color = Color(kBright * kPi * distance * distance / (side * side));
    return;
  }
  const auto of = [&](std::string_view keyword) {
    const Real* value = findValue<Real>(light, keyword);
    return value ? *value : 0;
  };
  const Real fading = of("constant_attenuation_coeff") + of("linear_attenuation_coeff") * distance +
                      of("quadratic_attenuation_coeff") * distance * distance;
  if (color && fading > 0) *color = Color(kBright * fading);
}

bool cameraSees(const Camera& camera) {
  return camera.fov > 0 && camera.fov < 180 && camera.aspectratio > 0 && isFinite(camera.position) &&
         canLook(camera.viewdir, camera.updir);
}

}  // namespace trace
