// How the rows of a picture file lie in the picture.
#pragma once

#include "image/raster.h"

namespace trace {

/// EXIF's numbers (JEITA CP-3451, tag 0x0112), by where the first row and column lie: 1 top, left; 2 top,
/// right; 3 bottom, right; 4 bottom, left; 5 left, top; 6 right, top; 7 right, bottom; 8 left, bottom.
enum class Orientation { upright = 1, mirrored, turned, flipped, transposed, right, transverse, left };

/// The picture of a raster whose rows lie so.
Raster oriented(Raster raster, Orientation orientation);

}  // namespace trace
