// Noise taken out of a picture: every pixel becomes a mean of pixels around it that are alike.
//
// How alike two pixels are is judged twice, and the stricter one counts: by the colours of the patches around
// them, against the noise that is known of both (non-local means with variances: Rousselle, Knaus and
// Zwicker, Adaptive Rendering with Non-Local Means Filtering, 2012), and by the surfaces that they show
// (Rousselle, Manzi and Zwicker, Robust Denoising using Feature and Color Information, 2013). One half of the
// samples says how the other is averaged, and the other way round, so that noise does not choose what it is
// averaged with. We differ: features are measured against their slope alone; what is averaged is light over
// the colour of its surface, so that a texture does not separate pixels (Bitterli et al., Nonlinearly
// Weighted First-order Regression for Denoising Monte Carlo Renderings, 2016, section 5.1); and where a patch
// leaves a pixel alone, as beside an edge, a smaller one counts, and at last colours without surfaces.
#pragma once

#include "base/parallel.h"
#include "image/film/film.h"

namespace trace {

/// The guides of denoising: features of the surfaces that a pixel shows, on the average of its samples.
struct NoiseGuides {
  Picture albedo, normal;
  Picture nearness;  ///< 1 / depth; 0 where nothing is hit
};

/// Bytes that a pixel takes meanwhile: the halves with and without the colours of surfaces, the guides, their
/// planes of floats, and the results.
constexpr std::uint64_t denoisingBytesPerPixel() {
  return 11 * sizeof(Color) + 4 * sizeof(double) + 20 * sizeof(float);
}

/// Pixels without samples in both halves stay black, and count for no other. The same bits for any number of
/// threads; 0 takes all. Rows that a cancelled job did not come to stay black.
Picture withoutNoise(const Halves& halves, const NoiseGuides& guides, int threads, Job& job);

}  // namespace trace
