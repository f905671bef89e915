// The traced form of a union, intersection, difference or clipped object.
//
// A ray's line hits every operand; the crossings, in order, turn the operands' insides on and off, and where
// the inside of the whole changes there is one crossing of the whole. Operands that are solids of solids are
// asked in turn. A hierarchy over the operands' boxes leaves out those that the line misses.
//
// Faces that coincide: crossings of different operands closer together than the bounds of their rounding
// errors count as one place. The inside just before and just after it decides; if it changes there is one
// crossing, which belongs to the first operand of the list that has a face there of the right orientation.
// So a hole drilled flush with a face is open, and solids that touch are one without a wall between.
#pragma once

#include <span>
#include <string>

#include "base/small_list.h"
#include "geometry/materials.h"
#include "geometry/shapes/solids/csg.h"
#include "geometry/shapes/solids/placed.h"
#include "geometry/solve/line_tree.h"

namespace trace {

/// One of the objects that a shape is made of.
struct Operand {
  std::string name;  ///< as in the file; may be empty
  Shape shape;
  Affine wholeFromOperand;     ///< which can be undone
  std::uint32_t material = 0;  ///< index into Scene::materials
  bool operator==(const Operand&) const = default;
};

/// How operands make a whole. A clip is an intersection of which only the first operand's surface stays.
struct CsgRule {
  CsgOperation operation;
  bool solid = true;  ///< no clip
};

class CsgTree {
 public:
  /// Throws Error for an open operand (but the first of a clip), for one squeezed flat, and if solids of
  /// solids are nested too deeply for their parts to be numbered. Takes over the
  /// hierarchies of operands that are meshes, as far as they are `made`.
  CsgTree(CsgRule rule, const std::vector<Operand>& operands, const MeshTrees& made = {});

  bool solid() const { return rule_.solid; }
  /// A clip of strands.
  bool strands() const { return !solid() && !operands_.empty() && operands_.front().shape().strands(); }
  Box3 bounds() const { return bounds_; }
  void crossings(const Ray& ray, const Range& range, VisitCrossing visit) const;
  SurfacePoint surface(const Ray& ray, const Crossing& crossing) const;

  std::int64_t partCount() const { return partCount_; }
  /// The material of the operand, however deep, that the part belongs to.
  MaterialMix material(std::int64_t part, std::uint32_t own) const;
  /// The material of the operand that fills the whole there. In a union it is the one that the part belongs
  /// to, else the first, of which the others cut away.
  MaterialMix inside(std::int64_t part, std::uint32_t own) const;
  /// Adds the materials of all operands, however deep.
  void addMaterials(std::vector<std::uint32_t>& materials) const;
  /// Adds the trees of the operands that are meshes, however deep.
  void addMeshTrees(MeshTrees& trees) const;

 private:
  struct Event;
  class State;

  /// The crossings of the operands; false if the line is nowhere inside the whole after that t.
  bool gather(const Ray& ray, const LineProbe& line, Real after, SmallList<Event, 16>& events) const;
  bool coincide(const Ray& ray, Real speed, const Event& a, const Event& b) const;
  /// A line is nowhere inside the whole where it is not inside the operand.
  bool needs(std::uint32_t operand) const {
    return rule_.operation == CsgOperation::intersect ||
           (rule_.operation == CsgOperation::subtract && operand == 0);
  }
  SurfacePoint operandSurface(const Ray& ray, const Crossing& crossing) const;

  CsgRule rule_;
  std::vector<Placed> operands_;
  std::vector<std::uint32_t> materials_;
  Box3 bounds_;
  Box3 reach_;     ///< bounds_ with room left
  Real near_ = 0;  ///< crossings farther apart never coincide
  std::int64_t partCount_ = 1;
  LineTree tree_;  ///< over the operands
};

}  // namespace trace
