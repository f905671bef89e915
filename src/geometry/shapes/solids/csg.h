// Constructive solid geometry: solids made of solids (Roth, Ray Casting for Modeling Solids, 1982). What rays
// meet of them is csg_tree.h.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string_view>
#include <vector>

#include "base/field.h"

namespace trace {

struct Operand;
class CsgTree;
struct MeshData;
class MeshTree;
struct ShapeFacts;

/// Hierarchies of meshes that are made already.
using MeshTrees = std::map<const MeshData*, std::shared_ptr<const MeshTree>>;

/// The objects that a shape is made of, behind a shared const handle: copying a scene does not copy them.
class Operands {
 public:
  Operands() = default;
  explicit Operands(std::vector<Operand> operands);

  const std::vector<Operand>& list() const;  ///< Operand is complete with csg_tree.h
  bool operator==(const Operands& other) const;

 private:
  std::shared_ptr<const std::vector<Operand>> list_;
};

/// The operation on the solids.
enum class CsgOperation { unite, intersect, subtract };
constexpr std::array<std::string_view, 3> names(CsgOperation) {
  return {"union", "intersection", "difference"};
}

struct Union {
  static constexpr std::string_view kKeyword = "union";
  static constexpr std::string_view kHelp = "union: the points inside any of the solids";
  Operands objects;
  static constexpr auto fields() {
    return Fields{
        Field{"objects", &Union::objects, "", 0, 0, "solids; they stand in the block one after another"}};
  }
  bool operator==(const Union&) const = default;
  std::shared_ptr<const CsgTree> prepared(const MeshTrees& made = {}) const;
  ShapeFacts checked() const;
};

struct Intersection {
  static constexpr std::string_view kKeyword = "intersection";
  static constexpr std::string_view kHelp = "intersection: the points inside all of the solids";
  Operands objects;
  static constexpr auto fields() {
    return Fields{Field{"objects", &Intersection::objects, "", 0, 0,
                        "solids; they stand in the block one after another"}};
  }
  bool operator==(const Intersection&) const = default;
  std::shared_ptr<const CsgTree> prepared(const MeshTrees& made = {}) const;
  ShapeFacts checked() const;
};

struct Difference {
  static constexpr std::string_view kKeyword = "difference";
  static constexpr std::string_view kHelp =
      "difference: the points inside the first solid but in none of the others";
  Operands objects;
  static constexpr auto fields() {
    return Fields{
        Field{"objects", &Difference::objects, "", 0, 0, "the solid, then the solids cut out of it"}};
  }
  bool operator==(const Difference&) const = default;
  std::shared_ptr<const CsgTree> prepared(const MeshTrees& made = {}) const;
  ShapeFacts checked() const;
};

struct Clip {
  static constexpr std::string_view kKeyword = "clip";
  static constexpr std::string_view kHelp =
      "the part of the first object's surface inside all other solids; the cut stays open";
  Operands objects;
  static constexpr auto fields() {
    return Fields{Field{"objects", &Clip::objects, "", 0, 0, "the object, solid or not, then solids"}};
  }
  bool operator==(const Clip&) const = default;
  std::shared_ptr<const CsgTree> prepared(const MeshTrees& made = {}) const;
  ShapeFacts checked() const;
};

}  // namespace trace
