// Do two readings say the same, wherever it stands in their files and however their materials are numbered?
#pragma once

#include "scene/scene.h"

namespace trace::rayfile {

/// Transforms may differ by the rounding of a few operations.
bool sameObject(const Scene& a, const Object& x, const Scene& b, const Object& y);
bool sameOperand(const Scene& a, const Operand& x, const Scene& b, const Operand& y);
bool sameShape(const Scene& a, const Shape& x, const Scene& b, const Shape& y);
/// All options but those of the machine.
/// Is the option among the choices?
bool names(const std::vector<Choice>& choices, std::string_view option);
/// Whether what `a` chooses gives all that `b` does.
bool sameSettings(const Scene& a, const Scene& b);

}  // namespace trace::rayfile
