#include "render/pixel.h"

namespace trace {

PixelTracer::PixelTracer(const World& world, const Settings& settings, const Size& size, RayTree* tree)
    : tracer_(world, settings, tree),
      radiance_(integratorRow(settings.integrator).radiance),
      size_(size),
      grid_(gridSize(settings)),
      toBorder_(settings.pixelPosition == PixelPosition::border) {
  // A cell of the grid is sampled where a whole pixel would be: at its lower left corner or centre.
  const Real within = settings.pixelPosition == PixelPosition::center ? 0.5 : 0.0;
  for (int cell = 0; cell < grid_; ++cell) places_.push_back((cell + within) / grid_);
}

Real PixelTracer::place(int pixel, int cell, int pixels) const {
  if (!toBorder_) return (pixel + places_[static_cast<std::size_t>(cell)]) / pixels;
  const int last = pixels * grid_ - 1;
  return last > 0 ? static_cast<Real>(pixel * grid_ + cell) / last : 0.5;
}

Ray PixelTracer::cameraRay(int x, int y, int k) const {
  const int fromBottom = size_.height - 1 - y;
  const Real u = place(x, k % grid_, size_.width), v = place(fromBottom, k / grid_, size_.height);
  return tracer_.world().camera().ray(u, v);
}

Color PixelTracer::sample(int x, int y, int k) { return radiance_(tracer_, cameraRay(x, y, k)); }

}  // namespace trace
