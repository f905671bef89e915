// A shape of whatever type: a row of the table of shapes and constant data that copies share.
//
// Any struct of the list (shape_list.h) becomes a Shape; as<Sphere>() gives it back. Code that loops over
// types or fields asks the table, so that only the table sees all the structs.
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "geometry/shapes/csg.h"

namespace trace {

struct AnyField;
class Shape;
struct ShapeFacts;
class TracedShape;

/// More types of shapes than there will be.
inline constexpr std::size_t kMostShapeTypes = 64;

/// A row of the table of shapes.
struct ShapeType {
  std::string_view keyword;  ///< as in scene files
  std::string_view help;     ///< one sentence, no full stop
  std::size_t index;         ///< in the table
  bool ofObjects;            ///< it is made of objects, which are its field "objects"
  std::shared_ptr<void> (*make)();
  std::shared_ptr<void> (*copy)(const void* shape);
  bool (*equal)(const void* a, const void* b);
  std::vector<AnyField> (*fields)(void* shape);
  TracedShape (*prepare)(const void* shape, const MeshTrees& made);
  ShapeFacts (*check)(const void* shape);
};

std::span<const ShapeType> shapeTypes();
/// Null if no shape has that keyword.
const ShapeType* findShapeType(std::string_view keyword);

namespace detail {
/// Precondition: there is one.
const ShapeType& shapeType(std::string_view keyword);
template <class S>
const ShapeType& typeOf() {
  static const ShapeType& type = shapeType(S::kKeyword);
  return type;
}
}  // namespace detail

class Shape {
 public:
  /// A sphere.
  Shape() : Shape(shapeTypes().front()) {}
  /// With the defaults of its type.
  explicit Shape(const ShapeType& type) : type_(&type), data_(type.make()) {}
  template <class S>
  requires requires {
    S::kKeyword;
    S::fields();
  }
  Shape(S shape)  // NOLINT(google-explicit-constructor): a sphere is a shape
      : type_(&detail::typeOf<S>()), data_(std::make_shared<S>(std::move(shape))) {}

  const ShapeType& type() const { return *type_; }
  std::string_view keyword() const { return type_->keyword; }

  template <class S>
  bool is() const {
    return type_ == &detail::typeOf<S>();
  }
  /// Null if it is of another type.
  template <class S>
  const S* as() const {
    return is<S>() ? static_cast<const S*>(data_.get()) : nullptr;
  }
  /// To be changed; what other copies share stays as it is.
  template <class S>
  S* edit() {
    return is<S>() ? static_cast<S*>(own()) : nullptr;
  }

  /// Its fields, to be changed; what other copies share stays as it is. To read them: forEachField() of
  /// field_value.h.
  std::vector<AnyField> editFields();

  /// The objects that it is made of; none for most.
  const Operands& operands() const;
  /// Precondition: type().ofObjects.
  void setOperands(Operands operands);

  /// Two that share their data are equal at once.
  bool operator==(const Shape& other) const {
    return type_ == other.type_ && (data_ == other.data_ || type_->equal(data_.get(), other.data_.get()));
  }

 private:
  friend TracedShape prepare(const Shape& shape, const MeshTrees& made);
  friend ShapeFacts check(const Shape& shape);
  friend std::vector<AnyField> fieldsOf(const Shape& shape);

  /// The data, copied first where others share it.
  void* own() {
    if (data_.use_count() > 1) data_ = type_->copy(data_.get());
    std::atomic_thread_fence(std::memory_order_acquire);  // what others read of it before they let go is past
    return data_.get();
  }

  const ShapeType* type_;
  std::shared_ptr<void> data_;
};

/// Calls visit(const S&) if the shape is of one of the types named; false if it is of none.
template <class... S, class Visit>
bool visitAs(const Shape& shape, Visit&& visit) {
  const auto tried = [&]<class T>(const T* held) {
    if (held) visit(*held);
    return held != nullptr;
  };
  return (tried(shape.as<S>()) || ...);
}

}  // namespace trace
