// The transforms of Inventor and VRML nodes.
#pragma once

#include <string_view>
#include <vector>

#include "formats/inventor/inventor_fields.h"
#include "math/transform.h"

namespace trace::inventor {

/// Axis and radians; the identity if there are not four numbers or no axis.
Affine turn(const std::vector<double>& numbers);

/// From sixteen numbers for row vectors, the translation last.
Affine rowMatrix(const double* numbers);

/// T C R SO S SO^-1 C^-1 of a node Transform; `scale` is the name of its field for S.
Affine transformOf(const Values& transform, std::string_view scale);

/// How long the unit of a node Units is; 0 if it is not known.
Real metres(std::string_view unit);

}  // namespace trace::inventor
