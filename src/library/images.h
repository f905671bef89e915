// Pictures between the floors below and the library.
#pragma once

#include "image/picture.h"
#include "traceray/traceray.h"

namespace traceray {

Image imageOf(const trace::Picture& picture);
trace::Picture pictureOf(const Image& image);

}  // namespace traceray
