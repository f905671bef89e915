#include "render/maps/irradiance_cache.h"

#include <algorithm>
#include <cmath>

#include "base/budget.h"
#include "math/elementary.h"
#include "math/warp.h"
#include "shading/scattering.h"

namespace trace {
namespace {

/// The integral of the tangent over the sine squared, up to that sine: in a ring its mean, which a point in
/// the middle would miss near the horizon.
Real tangentIntegral(Real sine) { return math::asin(sine) - sine * std::sqrt(1 - sine * sine); }

}  // namespace

HemisphereCells::HemisphereCells(int rays)
    : across_(std::max(2, static_cast<int>(std::sqrt(rays / kPi) + 0.5))),
      around_(std::max(4, (rays + across_ / 2) / across_)) {}

Vec3 HemisphereCells::direction(int n, const Vec2& u) const {
  const Real sine2 = (n / around_ + u.x) / across_, angle = 2 * kPi * (n % around_ + u.y) / around_;
  return sphericalDirection(std::sqrt(1 - sine2), angle);
}

/// Ward and Heckbert 1992, sections 3.1 and 3.2, for cells that are even in sine squared. `turning` has the
/// sign with which it is multiplied by the cross product of the record's normal and the place's.
IrradianceRecord HemisphereCells::record(const Vec3& point, const Vec3& x, const Vec3& y, const Vec3& normal,
                                         const std::vector<Seen>& seen) const {
  IrradianceRecord record{point, normal, {}, {}, {}, 0};
  const Real part = 1.0 / count();
  Real nearness = 0;
  for (int k = 0; k < around_; ++k) {
    const Real middle = 2 * kPi * (k + 0.5) / around_, edge = 2 * kPi * k / around_;
    const Vec3 u = x * math::cos(middle) + y * math::sin(middle);
    const Vec3 v = y * math::cos(middle) - x * math::sin(middle);
    const Vec3 vEdge = y * math::cos(edge) - x * math::sin(edge);
    const auto at = [&](int ring, int cell) -> const Seen& {
      return seen[static_cast<std::size_t>(ring * around_ + (cell + around_) % around_)];
    };
    for (int j = 0; j < across_; ++j) {
      const Seen& here = at(j, k);
      const Real inner = std::sqrt(static_cast<Real>(j) / across_),
                 outer = std::sqrt(static_cast<Real>(j + 1) / across_);
      record.light += here.light * part;
      nearness += part / here.distance;
      record.turning.add(v,
                         here.light * ((tangentIntegral(outer) - tangentIntegral(inner)) * across_ * part));
      if (j > 0) {
        const Seen& below = at(j - 1, k);
        const Real change = 2 / static_cast<Real>(around_) * inner * (1 - inner * inner);
        record.moving.add(
            u, (here.light + below.light * -1) * (change / std::min(here.distance, below.distance)));
      }
      const Seen& beside = at(j, k - 1);
      const Real change = (outer - inner) / kPi;
      record.moving.add(
          vEdge, (here.light + beside.light * -1) * (change / std::min(here.distance, beside.distance)));
    }
  }
  record.distance = nearness > 0 ? 1 / nearness : kInfinity;
  return record;
}

IrradianceCache::IrradianceCache(const Box3& box, Real error)
    : middle_(box.center()), half_(maxComponent(box.size()) / 2), error_(std::max(error, 1e-3)), nodes_(1) {
  constexpr Real kLeast = 1.0 / 40, kMost = 1.0 / 4;  // relative to the scene's size
  const Real size = length(box.size());
  least_ = kLeast * size;
  most_ = kMost * size;
}

void IrradianceCache::add(const IrradianceRecord& record) {
  const auto number = static_cast<std::uint32_t>(records_.size());
  IrradianceRecord& added = records_.emplace_back(record);
  // Where the light changes fast the record does not reach far, whatever it sees; and where it has to, it
  // changes no faster than that it doubles on the way.
  const Real slope = std::max({length(record.moving.r), length(record.moving.g), length(record.moving.b)});
  if (slope > 0) added.distance = std::min(added.distance, maxComponent(record.light) / slope);
  if (added.distance < least_)
    for (Vec3* gradient : {&added.moving.r, &added.moving.g, &added.moving.b})
      *gradient = *gradient * (added.distance / least_);
  added.distance = std::clamp(added.distance, least_, most_);
  insert(0, middle_, half_, number, error_ * added.distance);
}

void IrradianceCache::insert(std::size_t node, const Vec3& middle, Real half, std::uint32_t record,
                             Real reach) {
  if (half < 2 * reach) {
    nodes_[node].records.push_back(record);
    return;
  }
  const Vec3& at = records_[record].point;
  for (std::size_t i = 0; i < 8; ++i) {
    const Vec3 side{i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0};
    const Vec3 center = middle + side * (half / 2);
    const Vec3 off = abs(at - center);
    if (std::max({off.x, off.y, off.z}) > half / 2 + reach) continue;
    if (nodes_[node].children[i] == 0) {
      const auto added = static_cast<std::uint32_t>(nodes_.size());
      nodes_.emplace_back();
      nodes_[node].children[i] = added;
    }
    insert(nodes_[node].children[i], center, half / 2, record, reach);
  }
}

std::optional<IrradianceCache::Blend> IrradianceCache::at(const Vec3& point, const Vec3& normal) const {
  if (records_.empty()) return {};
  Blend sum{};
  Real weights = 0;
  Vec3 middle = middle_;
  Real half = half_;
  for (std::size_t node = 0;;) {
    for (const std::uint32_t number : nodes_[node].records) {
      const IrradianceRecord& record = records_[number];
      const Vec3 way = point - record.point;
      const Real alike = dot(normal, record.normal);
      const Real away = length(way) / record.distance + std::sqrt(std::max(0.0, 1 - alike));
      if (!(away < error_)) continue;
      // A point in front of the place sees other things.
      constexpr Real kBehind = 0.05;
      if (dot(way, normal + record.normal) / 2 < -kBehind * error_ * record.distance) continue;
      const Real weight = 1 / std::max(away, 1e-9) - 1 / error_;  // none at its rim, so that no edge shows
      sum.light +=
          (record.light + record.turning.along(cross(record.normal, normal)) + record.moving.along(way)) *
          Color(weight);
      weights += weight;
      ++sum.records;
    }
    const std::size_t side =
        (point.x > middle.x ? 1u : 0u) + (point.y > middle.y ? 2u : 0u) + (point.z > middle.z ? 4u : 0u);
    const std::uint32_t child = nodes_[node].children[side];
    if (child == 0) break;
    half /= 2;
    middle += Vec3{side & 1 ? half : -half, side & 2 ? half : -half, side & 4 ? half : -half};
    node = child;
  }
  if (!(weights > 0)) return {};
  const Color mean = sum.light / weights;
  sum.light = {std::max(0.0, mean.r), std::max(0.0, mean.g), std::max(0.0, mean.b)};
  return sum;
}

}  // namespace trace
