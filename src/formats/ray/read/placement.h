// The transforms of .ray files around their objects: translate( ), rotate( ), scale( ) and transform( ).
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "formats/ray/syntax/findings.h"
#include "formats/ray/syntax/syntax.h"
#include "math/transform.h"

namespace trace::rayfile {

/// The transform of that name with these numbers, those of a matrix row by row. Nothing where they are not of
/// its form. Angles are in degrees if so said.
std::optional<Affine> transformOf(std::string_view name, std::span<const Real> numbers, bool degrees);

bool isTransform(const Item& item);
void addTransformWords(std::vector<std::string_view>& words);

/// Multiplies the transform of the node to `worldFromObject`. Returns what it transforms; nothing, after a
/// report, if the node is not of its form. Precondition: isTransform(call).
std::optional<Item> applyTransform(Findings& findings, const Item& call, Affine& worldFromObject);

/// `text` inside the transform, for the scene to be written again.
std::string transformed(const Affine& m, std::string_view text);

}  // namespace trace::rayfile
