#include "render/chains/primary_sample.h"

#include <algorithm>
#include <cmath>

#include "math/elementary.h"
#include "math/noise.h"

namespace trace {
namespace {

Vec2 uniformPair(std::uint64_t bits) { return {unitFromBits(bits), unitFromBits(mixBits(bits))}; }

/// Two independent normal numbers (Box and Muller 1958).
Vec2 normalPair(std::uint64_t bits) {
  const Vec2 u = uniformPair(bits);
  const Real radius = std::sqrt(-2 * math::log(1 - u.x));
  const math::SinCos angle = math::sincos(2 * kPi * u.y);
  return {radius * angle.cos, radius * angle.sin};
}

/// On the circle of length 1.
Real wrapped(Real x) {
  const Real within = x - std::floor(x);
  return within < 1 ? within : 0;
}

}  // namespace

Vec2 StartSample::pair(std::uint64_t branch) { return uniformPair(mixBits(branch ^ start_)); }

void PrimarySample::offer(bool anywhere) {
  ++step_;
  ++offers_;
  offersAnywhere_ = anywhere;
}

void PrimarySample::keep() {
  if (offersAnywhere_) anywhere_ = step_;
  offered_.clear();
}

void PrimarySample::undo() {
  for (const std::size_t place : offered_) {
    pairs_[place].now = pairs_[place].before;
    pairs_[place].moved = pairs_[place].movedBefore;
  }
  offered_.clear();
  --step_;
}

std::uint64_t PrimarySample::bits(std::uint64_t branch, std::int64_t step) const {
  return mixBits(branch ^ mixBits(moves_ + static_cast<std::uint64_t>(step)));
}

void PrimarySample::grow() {
  slots_.assign(std::max<std::size_t>(64, 4 * pairs_.size()), 0);  // a power of two
  for (std::uint32_t place = 0; place < pairs_.size(); ++place)
    slots_[slotOf(pairs_[place].branch)] = place + 1;
}

/// Where the branch is in the table, or would be.
std::size_t PrimarySample::slotOf(std::uint64_t branch) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = branch & mask;
  while (slots_[slot] != 0 && pairs_[slots_[slot] - 1].branch != branch) slot = (slot + 1) & mask;
  return slot;
}

PrimarySample::Pair& PrimarySample::of(std::uint64_t branch) {
  if (2 * pairs_.size() >= slots_.size()) grow();
  std::uint32_t& place = slots_[slotOf(branch)];
  if (place == 0) {
    pairs_.push_back({branch, first_.pair(branch)});
    place = static_cast<std::uint32_t>(pairs_.size());
  }
  return pairs_[place - 1];
}

Vec2 PrimarySample::pair(std::uint64_t branch) {
  Pair& pair = of(branch);
  if (pair.moved < anywhere_) {
    constexpr std::uint64_t kMissed = 0x6d6973736564ull;  // these numbers are not those of an offer
    pair.now = uniformPair(bits(branch ^ kMissed, offers_));
    pair.moved = anywhere_;
  }
  if (pair.moved == step_) return pair.now;
  pair.before = pair.now;
  pair.movedBefore = pair.moved;
  offered_.push_back(static_cast<std::size_t>(&pair - pairs_.data()));
  if (offersAnywhere_) {
    pair.now = uniformPair(bits(branch, offers_));
  } else {
    // All small moves since the last one in one: the sum of normal numbers.
    const Real size = size_ * std::sqrt(static_cast<Real>(step_ - pair.moved));
    const Vec2 way = normalPair(bits(branch, offers_));
    pair.now = {wrapped(pair.now.x + size * way.x), wrapped(pair.now.y + size * way.y)};
  }
  pair.moved = step_;
  return pair.now;
}

}  // namespace trace
