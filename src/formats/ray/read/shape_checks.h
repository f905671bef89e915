// Mistakes in a shape of a .ray file that can be traced: nothing of it can be seen, its
// corners are the wrong way round, a list is too short for its curve.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "geometry/traced.h"
#include "math/transform.h"

namespace trace::rayfile {

using Tell = std::function<void(std::string what, std::string hint)>;

/// Makes a shape with its transform one that can be traced. Returns why it cannot be, or "".
std::string_view repair(Shape& shape, Affine& worldFromObject);

/// `facts` are what check() found.
void checkShape(const Shape& shape, const ShapeFacts& facts, const Tell& tell);

}  // namespace trace::rayfile
