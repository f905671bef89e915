#include "shading/lights/photometry.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "math/elementary.h"

namespace trace {
namespace {

constexpr Real kDegree = kPi / 180;

/// BetweenAngles which two of the ascending numbers it lies, and how far from the first; outside at the end.
struct BetweenAngles {
  std::size_t low, high;
  Real share;

  BetweenAngles(const std::vector<Real>& list, Real x) {
    const auto above = static_cast<std::size_t>(std::upper_bound(list.begin(), list.end(), x) - list.begin());
    low = above == 0 ? 0 : above - 1;
    high = std::min(above, list.size() - 1);
    share = high > low ? std::clamp((x - list[low]) / (list[high] - list[low]), 0.0, 1.0) : 0;
  }
};

}  // namespace

Photometry::Photometry(Type type, std::vector<Real> vertical, std::vector<Real> horizontal,
                       std::vector<Real> candelas)
    : type_(type),
      vertical_(std::move(vertical)),
      horizontal_(std::move(horizontal)),
      candelas_(std::move(candelas)) {
  for (const Real c : candelas_) brightest_ = max(brightest_, c);
  if (type_ == Type::c) {
    // From the aim to the first angle without light after the last one with it.
    const std::size_t rows = vertical_.size();
    std::size_t last = 0;
    for (std::size_t i = 0; i < candelas_.size(); ++i)
      if (candelas_[i] > 0) last = std::max(last, i % rows);
    if (last + 1 < rows || vertical_.back() < 180)
      widest_ = vertical_[std::min(last + 1, rows - 1)] * kDegree;
  } else {
    widest_ = kPi / 2;
  }
  // Over rings around the aim, each of its exact area; the table is smooth between its lines.
  constexpr int kRings = 360, kColumns = 72;
  for (int i = 0; i < kRings; ++i) {
    const Real off = (i + 0.5) * kPi / kRings,
               area = 2 * kPi * (math::cos(i * kPi / kRings) - math::cos((i + 1) * kPi / kRings));
    for (int j = 0; j < kColumns; ++j) {
      const Real turn = 2 * kPi * (j + 0.5) / kColumns;
      lumens_ += at({math::sin(off) * math::cos(turn), math::sin(off) * math::sin(turn), math::cos(off)}) *
                 area / kColumns;
    }
  }
}

Real Photometry::at(const Vec3& d) const {
  switch (type_) {
    case Type::c:
      return atAngles(math::acos(std::clamp(d.z, -1.0, 1.0)) / kDegree, math::atan2(d.y, d.x) / kDegree);
    case Type::a:
      return atAngles(math::asin(std::clamp(d.x, -1.0, 1.0)) / kDegree, math::atan2(-d.y, d.z) / kDegree);
    case Type::b:
      return atAngles(math::atan2(d.x, d.z) / kDegree, math::asin(std::clamp(-d.y, -1.0, 1.0)) / kDegree);
  }
  return 0;
}

Real Photometry::folded(Real angle) const {
  const Real first = horizontal_.front(), last = horizontal_.back();
  if (type_ != Type::c) return first >= 0 ? std::abs(angle) : angle;  // from 0 on the sides are alike
  if (horizontal_.size() == 1) return first;
  if (angle < 0) angle += 360;
  if (last - first >= 360) return first + std::fmod(angle - first + 360, 360);
  if (first == 90 && last == 270) {  // the halves on both sides of the plane 90 to 270 are alike
    return angle < 90 ? 180 - angle : angle > 270 ? 540 - angle : angle;
  }
  if (angle > 180) angle = 360 - angle;               // the halves are alike
  if (last <= 90 && angle > 90) angle = 180 - angle;  // the quarters are
  return angle;
}

Real Photometry::atAngles(Real vertical, Real horizontal) const {
  if (type_ != Type::c && vertical_.front() >= 0) vertical = std::abs(vertical);
  horizontal = folded(horizontal);
  if (vertical < vertical_.front() || vertical > vertical_.back()) return 0;
  if (type_ != Type::c && horizontal_.size() > 1 &&
      (horizontal < horizontal_.front() || horizontal > horizontal_.back()))
    return 0;
  const BetweenAngles row(vertical_, vertical), column(horizontal_, horizontal);
  const auto of = [&](std::size_t c, std::size_t r) { return candelas_[c * vertical_.size() + r]; };
  const auto along = [&](std::size_t c) {
    return of(c, row.low) * (1 - row.share) + of(c, row.high) * row.share;
  };
  return along(column.low) * (1 - column.share) + along(column.high) * column.share;
}

}  // namespace trace
