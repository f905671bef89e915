#include "render/lights/body_lamp.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "geometry/shapes/solids/cone.h"
#include "geometry/shapes/solids/conic.h"
#include "geometry/shapes/solids/cube.h"
#include "geometry/shapes/solids/quadric.h"
#include "geometry/shapes/solids/rounded_box.h"
#include "geometry/shapes/solids/sphere.h"
#include "geometry/shapes/solids/superellipsoid.h"
#include "geometry/shapes/solids/torus.h"
#include "math/low_discrepancy.h"
#include "math/perpendicular.h"
#include "math/warp.h"
#include "shading/scattering.h"

namespace trace {
namespace {

constexpr Real kWholeSphere = 4 * kPi;

/// The most places where a line enters the shape, or crosses an open one; 0: not known.
int mostPlaces(const World& world, std::uint32_t object) {
  const std::string_view shape = world.shapeOf(object);
  if (shape.empty() || world.meshTree(object)) return 0;
  if (world.convex(object) || shape == Ellipsoid::kKeyword) return 1;
  const bool two = shape == Torus::kKeyword || shape == Cylinder::kKeyword || shape == Cone::kKeyword ||
                   shape == Conic::kKeyword;
  return two ? 2 : 0;
}

/// The half axes of an ellipsoid around a shape are so many times those of its bounds.
Real roomAround(std::string_view shape) {
  if (shape == Sphere::kKeyword || shape == Ellipsoid::kKeyword) return 1;
  const bool corners =
      shape == Cube::kKeyword || shape == RoundedBox::kKeyword || shape == Superellipsoid::kKeyword;
  return std::sqrt(corners ? 3.0 : 2.0);  // the others are round about their axis z
}

Real coneCosine(Real away2) { return std::sqrt(std::max(0.0, 1 - 1 / away2)); }

/// The solid angle of the ball of radius 1 from so far away; from inside, all of it.
Real ballAngle(Real away2) { return away2 > 1 ? 2 * kPi / (away2 * (1 + coneCosine(away2))) : kWholeSphere; }

}  // namespace

std::optional<BodyLamp> BodyLamp::of(const World& world, std::uint32_t object) {
  BodyLamp body;
  body.crossings_ = mostPlaces(world, object);
  const Box3 bounds = world.boundsOf(object);
  const Box3 own = world.ownBoundsOf(object);
  if (body.crossings_ == 0 || bounds.empty() || bounds.unbounded() || own.unbounded()) return {};
  constexpr Real kMore = 1 + 1e-9, kFlat = 1e-3;  // for rounding; of what is flat, over its longest side
  body.object_ = object;
  body.closed_ = world.solid(object);
  body.middle_ = bounds.center();
  body.radius_ = length(bounds.size()) / 2 * kMore;
  Vec3 half = own.size() * 0.5;
  const Real least = kFlat * std::max({half.x, half.y, half.z});
  const Real room = roomAround(world.shapeOf(object)) * kMore;
  for (int axis = 0; axis < 3; ++axis) half[axis] = std::max(half[axis], least) * room;
  body.toWorld_ = world.worldFromObject(object) * Affine::translation(own.center()) * Affine::scaling(half);
  body.volume_ = std::abs(determinant(body.toWorld_));
  if (!(body.radius_ > 0 && body.radius_ < kInfinity && body.volume_ > 0 && body.volume_ < kInfinity))
    return {};
  body.fromWorld_ = inverse(body.toWorld_);

  std::size_t places = 0;
  std::vector<std::pair<Found, Place>> crossed;
  for (const Line& line : sampleLines()) {
    body.crossings(world, body.rayOf(line), crossed);
    places += std::min(crossed.size(), static_cast<std::size_t>(body.crossings_));
  }
  // A line crosses only one of the two sides of an open shape.
  body.area_ = kWholeSphere * body.radius_ * body.radius_ * static_cast<Real>(places) /
               static_cast<Real>(sampleLines().size());
  if (!body.closed_) body.area_ /= 2;
  return body.area_ > 0 ? std::optional(body) : std::nullopt;
}

BodyLamp::Aim BodyLamp::aim(const Vec3& from, const Vec2& u) const {
  const Vec3 here = fromWorld_ * from;
  const Real away2 = dot(here, here);
  const Vec3 toward = away2 > 1 ? toCone(u, here * (-1 / std::sqrt(away2)), coneCosine(away2))
                                : sphericalDirection(1 - 2 * u.x, 2 * kPi * u.y);
  const Vec3 way = linear(toWorld_, toward);
  const Real longer = length(way);
  const Real along = -dot(here, toward);  // to what lies nearest to the middle
  const Real half = std::sqrt(std::max(0.0, 1 - (away2 - along * along)));
  return {way / longer, longer * longer * longer / (volume_ * ballAngle(away2)), (along + half) * longer};
}

Real BodyLamp::density(const Vec3& from, const Vec3& direction) const {
  const Vec3 here = fromWorld_ * from;
  const Real shorter = length(linear(fromWorld_, direction));
  return 1 / (shorter * shorter * shorter * volume_ * ballAngle(dot(here, here)));
}

BodyLamp::Line BodyLamp::lineOf(const Vec2& direction, const Vec2& disk) {
  const Vec3 along = sphericalDirection(1 - 2 * direction.x, 2 * kPi * direction.y);
  const Vec3 x = perpendicularTo(along), y = cross(along, x);
  const Vec2 off = toDisk(disk);
  return {x * off.x + y * off.y - along * 2, along};
}

const std::vector<BodyLamp::Line>& BodyLamp::sampleLines() {
  static const std::vector<Line> kLines = [] {
    constexpr std::uint32_t kCount = 512;
    std::vector<Line> lines;
    for (std::uint32_t n = 0; n < kCount; ++n)
      lines.push_back(lineOf(sobolPoint(n, 0), sobolPointBeside(n, 0)));
    return lines;
  }();
  return kLines;
}

void BodyLamp::crossings(const World& world, const Ray& line,
                         std::vector<std::pair<Found, Place>>& places) const {
  places.clear();
  Statistics statistics;
  world.crossingsOf(object_, line, kInfinity, statistics, [&](const Found& found) {
    const SurfacePoint at = world.surface(line, found);
    const bool enters = dot(at.normal, line.direction) < 0;
    if (enters || !closed_) places.push_back({found, {at.point, enters ? at.normal : -at.normal}});
    return false;
  });
}

std::optional<BodyLamp::Place> BodyLamp::place(const World& world, const Vec2& direction, const Vec2& disk,
                                               Real which) const {
  std::vector<std::pair<Found, Place>> places;
  crossings(world, rayOf(lineOf(direction, disk)), places);
  const auto chosen = static_cast<std::size_t>(which * crossings_);
  if (chosen >= places.size()) return {};
  std::nth_element(places.begin(), places.begin() + static_cast<std::ptrdiff_t>(chosen), places.end(),
                   [](const auto& a, const auto& b) { return a.first.before(b.first); });
  return places[chosen].second;
}

Real BodyLamp::perArea() const { return 1 / (kWholeSphere * radius_ * radius_ * crossings_); }

std::optional<Found> BodyLamp::meets(const World& world, const Ray& ray, Statistics& statistics) const {
  std::optional<Found> nearest;
  if (ray.leaves == object_) return nearest;
  world.crossingsOf(object_, ray, kInfinity, statistics, [&](const Found& found) {
    if (!nearest || found.before(*nearest)) nearest = found;
    return false;
  });
  return nearest;
}

}  // namespace trace
