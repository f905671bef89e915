// The types of the fields of shapes (base/field_value.h).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/field_value.h"
#include "geometry/materials.h"
#include "geometry/shape.h"
#include "geometry/shapes/solids/csg.h"
#include "geometry/shapes/surfaces/heights.h"
#include "math/vec.h"

namespace trace {

template <std::size_t N>
using Tuples = std::vector<std::array<Real, N>>;

/// A field of a shape and where its value lies.
struct AnyField
    : FieldValue<bool, int, Real, Vec3, std::string, std::vector<std::string>, std::array<Real, 4>, Tuples<2>,
                 Tuples<4>, Tuples<5>, Tuples<8>, Tuples<12>, std::vector<Tuples<2>>, std::vector<Tuples<3>>,
                 std::vector<Tuples<4>>, Heights, Operands, MaterialList> {};

/// The materials that the shape leads between, or that the points of a mesh have; none for most.
const std::vector<std::uint32_t>& materialsOf(const Shape& shape);

}  // namespace trace
