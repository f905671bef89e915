#include "render/pixel.h"

namespace trace {

PixelTracer::PixelTracer(const World& world, const Settings& settings, const Size& size, RayTree* tree)
    : tracer_(world, settings, tree),
      radiance_(integratorRow(settings.integrator).radiance),
      size_(size),
      grid_(gridSize(settings)),
      // A cell of the grid is sampled where a whole pixel would be: at its lower left corner or centre.
      within_(settings.pixelPosition == PixelPosition::center ? 0.5 : 0.0) {}

Ray PixelTracer::cameraRay(int x, int y, int k) const {
  const int fromBottom = size_.height - 1 - y;
  const Real u = (x + (k % grid_ + within_) / grid_) / size_.width;
  const Real v = (fromBottom + (k / grid_ + within_) / grid_) / size_.height;
  return tracer_.world().camera().ray(u, v);
}

Color PixelTracer::sample(int x, int y, int k) { return radiance_(tracer_, cameraRay(x, y, k)); }

}  // namespace trace
