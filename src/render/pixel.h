// The camera rays of a pixel and what they bring: the same for a render, for one pixel again, and for its
// explanation.
#pragma once

#include <optional>
#include <vector>

#include "render/integrator.h"
#include "render/render.h"

namespace trace {

/// Of a pixel's finite samples, in their order; black if there is none.
class PixelMean {
 public:
  /// False if the sample is not finite and does not count.
  bool add(const Color& sample) {
    if (!isFinite(sample)) return false;
    sum_ += sample, ++count_;
    return true;
  }
  int count() const { return count_; }
  Color color() const { return count_ > 0 ? sum_ / count_ : Color(0); }

 private:
  Color sum_;
  int count_ = 0;
};

/// Takes a picture's samples, one at a time, by one worker.
class PixelTracer {
 public:
  /// `tree`, if any, records the rays.
  PixelTracer(const World& world, const Settings& settings, const Size& size, RayTree* tree = nullptr);

  /// How many a pixel has: the rays of its grid.
  int samples() const { return grid_ * grid_; }
  /// What the camera ray of sample 0 <= k < samples() brings; may be NaN or infinite. Row y = 0 is the top.
  Color sample(int x, int y, int k);
  /// The PixelMean of the pixel. badSample(x, y, k) hears of samples that do not count.
  template <class BadSample>
  Color pixel(int x, int y, BadSample&& badSample);

  /// The camera ray of that sample.
  Ray cameraRay(int x, int y, int k) const;

  Tracer& tracer() { return tracer_; }
  Statistics& statistics() { return tracer_.statistics(); }

 private:
  /// Of a cell of the grid of a pixel, in the picture, from 0 to 1.
  Real place(int pixel, int cell, int pixels) const;

  Tracer tracer_;
  Color (*radiance_)(Tracer&, const Ray&);
  Size size_;
  int grid_;
  bool toBorder_;             ///< the outermost rays go through the border of the picture
  std::vector<Real> places_;  ///< if they do not: of the cells of the grid within a pixel
};

template <class BadSample>
Color PixelTracer::pixel(int x, int y, BadSample&& badSample) {
  PixelMean mean;
  for (int k = 0; k < samples(); ++k)
    if (!mean.add(sample(x, y, k))) badSample(x, y, k);
  return mean.color();
}

}  // namespace trace
