// The error that an eye sees when it flips between two pictures: LDR-FLIP.
//
// Used by `ray diff` and `ray grade`, beside the numbers of compare.h, which know nothing of eyes. Source:
// Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom, Fairchild, "FLIP: A Difference Evaluator for
// Alternating Images", Proc. ACM Comput. Graph. Interact. Tech. 3(2), 2020 (High Performance Graphics).
#pragma once

#include <vector>

#include "image/picture.h"

namespace trace {

/// Pixels for a degree of the visual field: of a screen 0.7 m wide with 3840 pixels, seen from 0.7 m.
double usualPixelsPerDegree();

/// For each pixel, row by row, 0 (nothing is seen) to 1. The pictures' values are taken as a screen takes
/// them: as sRGB, clamped to 0 ... 1, NaN as 0. Throws Error(Fault::usage) when the sizes differ.
/// Precondition: pixels per degree finite and above 0.
std::vector<double> flipErrors(const Picture& reference, const Picture& test,
                               double pixelsPerDegree = usualPixelsPerDegree());

/// 0 of none.
double mean(const std::vector<double>& values);

}  // namespace trace
