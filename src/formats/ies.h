// Photometric files of lighting makers: IES LM-63 of 1986, 1991, 1995 and 2002, which say the intensity of a
// lamp by direction.
#pragma once

#include <string>
#include <string_view>

#include "base/error.h"
#include "shading/lights/photometry.h"

namespace trace {

/// Throws Error(Fault::scene) with the place of what is not as the format asks.
Photometry readIes(const std::string& file, std::string_view bytes, Messages& messages);

}  // namespace trace
