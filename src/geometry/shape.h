// A shape of whatever type: a row of the table of shapes and constant data that copies share (base/listed.h).
//
// Any struct of the list (shape_list.h) becomes a Shape; as<Sphere>() gives it back.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "base/listed.h"
#include "geometry/shapes/solids/csg.h"

namespace trace {

struct AnyField;
class Shape;
struct ShapeFacts;
class TracedShape;

/// More types of shapes than there will be.
inline constexpr std::size_t kMostShapeTypes = 64;

/// A row of the table of shapes.
struct ShapeType : ListedRow<AnyField> {
  bool ofObjects;  ///< it is made of objects, which are its field "objects"
  bool alongZ;     ///< its axis is z, as that of a cone: a new one is turned upright
  TracedShape (*prepare)(const void* shape, const MeshTrees& made);
  ShapeFacts (*check)(const void* shape);
};

std::span<const ShapeType> shapeTypes();
/// Null if no shape has that keyword.
const ShapeType* findShapeType(std::string_view keyword);
template <>
const ShapeType& rowCalled<ShapeType>(std::string_view keyword);

class Shape : public Listed<ShapeType, AnyField> {
 public:
  using Listed::Listed;
  /// A sphere.
  Shape() : Listed(shapeTypes().front()) {}

  /// The objects that it is made of; none for most.
  const Operands& operands() const;
  /// Precondition: type().ofObjects.
  void setOperands(Operands operands);

 private:
  friend TracedShape prepare(const Shape& shape, const MeshTrees& made);
  friend ShapeFacts check(const Shape& shape);
};

}  // namespace trace
