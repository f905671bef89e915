// The objects of .ray files: shapes in their transforms and groups, solids of solids, particles.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/nesting.h"
#include "formats/ray/read/material.h"
#include "formats/ray/read/mesh.h"
#include "formats/ray/read/mesh_file.h"
#include "formats/ray/syntax/findings.h"
#include "formats/ray/syntax/syntax.h"
#include "formats/scene_time.h"
#include "geometry/shapes/solids/csg_tree.h"
#include "math/transform.h"
#include "scene/groups.h"

namespace trace::rayfile {

/// Words that an object, or what stands beside objects, begins with.
std::vector<std::string_view> knownWords();

/// Adds objects to the scene of the findings.
class ObjectReader {
 public:
  /// `time` is that of the frame; it must outlive the reader.
  ObjectReader(Findings& findings, Materials& materials, SceneTime& time)
      : syntax_(findings.syntax()),
        time_(time),
        scene_(findings.scene()),
        findings_(findings),
        materials_(materials),
        meshFiles_(findings, materials, time) {}

  /// A shape, a transform of something, a group, particles; or what is not known, which is reported.
  void object(Item item, Affine worldFromObject);
  /// `material { name = ...; }`
  void namedMaterial(const Item& call);
  /// Gives the scene the placements of its groups. Call it once, after all objects.
  void finish();

 private:
  /// One level more of solids in solids, if `counts`. Converts to false, after a report, where it is one too
  /// many.
  class NestedSolid {
   public:
    NestedSolid(ObjectReader& reader, const Item& item, bool counts) : reader_(reader), counts_(counts) {
      if (counts_ && ++reader_.solids_ > kMostNestedSolids) reader_.tooDeep(item);
    }
    ~NestedSolid() { reader_.solids_ -= counts_; }
    NestedSolid(const NestedSolid&) = delete;
    NestedSolid& operator=(const NestedSolid&) = delete;
    explicit operator bool() const { return reader_.solids_ <= kMostNestedSolids; }

   private:
    ObjectReader& reader_;
    const bool counts_;
  };

  /// Placements of groups in the scene or in the group that is being read, by group.
  using Uses = std::map<std::uint32_t, GroupUses::List>;
  /// The result of a name of objects under one material.
  struct Prototype {
    bool isCopied = false;                 ///< it cannot be placed
    std::optional<std::uint32_t> group{};  ///< nothing where all objects stand alone
    std::vector<Object> alone{};
    int levels = 0;
  };
  /// Objects that are placed again. Returns false if they are to be copied.
  bool place(const Syntax::Root& root, const Affine& worldFromObject);
  const Prototype& prototypeOf(const Syntax::Root& root);
  std::uint32_t usePlace(std::uint32_t offset);
  static std::vector<GroupUses> shared(Uses uses);
  void object(Item item, Affine worldFromObject, bool mayPlace);

  /// Materials set in a group hold up to its end.
  void group(const Item& block, const Affine& worldFromObject);
  void tooDeep(const Item& item);
  void noObject(const Item& item);
  void otherNode(const Item& call, const Affine& worldFromObject);
  void shape(const ShapeType& type, const Item& call, const Affine& worldFromObject);
  void mesh(const Item& call, const Item& block, const Affine& worldFromObject);
  /// Precondition: the shape has the defaults of its type.
  void analyticShape(Shape shape, const Item& call, const Item& block, Affine worldFromObject);
  /// A cone may be lower than its base.
  void warnOfRanges(const Shape& shape, const Item& block);
  /// Materials between which the shape's lead; they inherit from its own as known at this point of the file.
  bool readMaterials(Shape& shape, const Item& item, const NotedMaterial& own);
  /// Not a field of the block it stands in.
  bool isObject(const Item& item);
  /// The objects of a block, which may stand in objects = { } as well. They have the material of the whole if
  /// they do not say another.
  /// How many of its first objects may be open sheets.
  static std::size_t mayBeOpen(const Shape& whole);
  Operands operands(const Item& call, const Item& block, const NotedMaterial& material,
                    std::size_t mayBeOpen);
  /// A group is one operand: the union of its objects.
  void operand(const Item& whole, const Item& item, bool mayBeOpen, std::vector<Operand>& operands);
  void add(const Item& call, Object object);
  /// The particles alive at the frame's time, each as the objects of the block; spheres if there are none.
  void particles(const Item& call, const Affine& worldFromObject);
  /// Copies of the objects of the block.
  void rows(const Item& call, const Affine& worldFromObject);

  const Syntax& syntax_;
  SceneTime& time_;
  Scene& scene_;
  Findings& findings_;
  Materials& materials_;
  MeshFiles meshFiles_;
  SharedMeshes sharedMeshes_;
  Uses uses_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, Prototype> prototypes_;  ///< by root and material
  std::map<std::uint32_t, std::uint32_t> usePlaces_;                         ///< by offset
  int solids_ = 0;  ///< how many solids or particles what is read is nested in
};

}  // namespace trace::rayfile
