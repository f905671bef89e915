// Light that lenses and eyes scatter around every bright place.
#pragma once

#include "image/picture.h"

namespace trace {

/// The picture with a share (0 to 1) of each pixel's light spread around it, in equal parts by Gaussians
/// whose standard deviations are 0.5, 2 and 6 % of the picture's height. Each is a mean of the pixels that
/// are there, so a plain picture stays plain; what is not finite takes no part. Takes time in proportion to
/// the pixels, whatever their number, and looks at the budget of the thread.
///
/// The Gaussians are Deriche's recursive ones, which are exact to 1e-3 of their height.
Picture bloomed(const Picture& picture, double share);

/// The picture blurred by a Gaussian of that standard deviation, in pixels, as bloomed() does it.
Picture gaussianBlurred(const Picture& picture, double sigma);

}  // namespace trace
