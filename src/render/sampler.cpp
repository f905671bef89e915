#include "render/sampler.h"

#include <array>

namespace trace {
namespace {

/// Independent numbers: a hash of where they are drawn.
Real hashed(std::uint64_t key, std::uint32_t dimension) {
  return unitFromBits(mixBits(key ^ mixBits(dimension)));
}

Vec2 onGrid(const SampleRules& rules, int x, int y, int k) { return rules.cell(x, y, k); }

constexpr std::array kTable{
    GeneratorRow{"grid", "the cells of a regular grid in each pixel, row by row", onGrid, hashed},
};

}  // namespace

std::span<const GeneratorRow> generators() { return kTable; }

SampleRules::SampleRules(const Settings& settings, const Size& size)
    : generator_(&kTable.front()),
      size_(size),
      grid_(gridSize(settings)),
      toBorder_(settings.pixelPosition == PixelPosition::border) {
  // A cell of the grid is sampled where a whole pixel would be: at its lower left corner or centre.
  const Real within = settings.pixelPosition == PixelPosition::center ? 0.5 : 0.0;
  for (int cell = 0; cell < grid_; ++cell) places_.push_back((cell + within) / grid_);
}

Real SampleRules::place(int pixel, int cell, int pixels) const {
  if (!toBorder_) return (pixel + places_[static_cast<std::size_t>(cell)]) / pixels;
  const int last = pixels * grid_ - 1;
  return last > 0 ? static_cast<Real>(pixel * grid_ + cell) / last : 0.5;
}

Vec2 SampleRules::cell(int x, int y, int k) const {
  const int fromBottom = size_.height - 1 - y;
  return {place(x, k % grid_, size_.width), place(fromBottom, k / grid_, size_.height)};
}

}  // namespace trace
