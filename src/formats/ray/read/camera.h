// The camera of .ray files.
#pragma once

#include "formats/ray/syntax/findings.h"
#include "formats/ray/syntax/syntax.h"
#include "shading/cameras/camera.h"

namespace trace::rayfile {

/// The camera of a block `camera { ... }`; fields not given have their defaults. Reports what is wrong.
Camera readCamera(Findings& findings, const Item& block);

}  // namespace trace::rayfile
