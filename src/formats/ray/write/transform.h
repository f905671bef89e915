// Transforms as .ray files say them, `translate(1, 2, 3, rotate(...))`: found for a matrix, and changed for
// another matrix by as few of their numbers as possible.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "math/transform.h"

namespace trace::rayfile {

/// One transform call: its form and the numbers before its object.
struct TransformStep {
  enum class Kind { translate, rotate, scale, matrix };

  Kind kind = Kind::translate;
  std::vector<Real> numbers{};  ///< 3, 4 with the angle in radians, 1 or 3, and the 12 of three rows

  bool operator==(const TransformStep&) const = default;
};

/// The step as a file that begins with `Trace 1` says it, whose angles are in degrees.
TransformStep inDegrees(TransformStep step);

/// As the reader makes it.
Affine affineOf(const TransformStep& step);
/// Outermost first.
Affine product(const std::vector<TransformStep>& steps);

/// `translate(1, 2, 3, `: the object and a bracket follow.
std::string head(const TransformStep& step, int digits);

/// At most a translation, a rotation and a scaling, if their product is `m` to the last bit; else one matrix.
/// None for the identity.
std::vector<TransformStep> stepsOf(const Affine& m);

/// The transform that is nearly `m` and that a translation, a rotation and a scaling say, with so many digits
/// of each number that count; `m` itself where it is skewed or flat.
Affine inShortNumbers(const Affine& m, int digits);

/// Equal except for the rounding of a few operations.
bool nearlyEqual(const Affine& a, const Affine& b);

/// `own` with as few numbers as possible changed, so that outer * product(result) nearly equals `target`, and
/// equals it where that is possible. New steps stand at the front, so the last own.size() of the result are
/// those of `own`. Nothing if a matrix cannot be undone.
std::optional<std::vector<TransformStep>> changedSteps(const Affine& outer,
                                                       const std::vector<TransformStep>& own,
                                                       const Affine& target);

}  // namespace trace::rayfile
