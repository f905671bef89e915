#include "view.h"

namespace trace::bench {
namespace {

double halfSize(const View& view) { return std::tan(view.fov / 2 * kPi / 180); }
Vec3 unitRight(const View& view) { return normalize(cross(view.forward(), {0, 1, 0})); }

}  // namespace

Vec3 View::right() const { return unitRight(*this) * halfSize(*this); }
Vec3 View::up() const { return cross(unitRight(*this), forward()) * halfSize(*this); }

View viewOf(std::string_view name, const Box3& box, double scale) {
  const double radius = length(box.size()) / 2;
  if (name == "crytek_sponza")  // inside, along the nave
    return {
        Vec3{-1100, 250, -40} * scale, Vec3{0, 350, 0} * scale, Vec3{0, 1000, -40} * scale, 65, radius, 512};
  const Vec3 center = box.center();
  const double distance = 0.8 * radius / std::sin(20 * kPi / 180);
  return {center + normalize({0.5, 0.35, 1}) * distance,
          center,
          center + Vec3{2, 3, 1.5} * radius,
          40,
          radius,
          name == "bunny" ? 1024 : 640};
}

}  // namespace trace::bench
