// Materials of .ray files: blocks, names, inheritance.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "formats/ray/read/texture.h"
#include "formats/ray/syntax/findings.h"
#include "formats/ray/syntax/notes.h"
#include "formats/ray/syntax/syntax.h"
#include "shading/material.h"

namespace trace::rayfile {

/// Begins the warning of a block that becomes glass by what it inherits.
inline constexpr std::string_view kInheritsGlass = "this material inherits the transmissive";
/// `library = water` makes a block start from that material (shading/library.h), in place of what it
/// inherits.
inline constexpr std::string_view kLibrary = "library";
/// The field of a material that says its shading model.
inline constexpr std::string_view kModel = "model";

class Materials {
 public:
  explicit Materials(Findings& findings) : findings_(findings), textures_(findings) {
    if (findings.isOfKind()) current.sides = ShadedSides::both;  // so that a room may be a box
  }

  TextureReader& textures() { return textures_; }

  /// The material that primitives without one get, and material blocks start from.
  NotedMaterial current;

  /// The material that a block `{ ... }` describes, starting as a copy of `inherited`, or that a name
  /// stands for. Reports what is wrong, and returns what could be read.
  NotedMaterial read(const Item& value, const NotedMaterial& inherited);

  /// The material that is rendered: a plain surface where a file of the kind `Trace 1` leaves the looks out.
  NotedMaterial completed(NotedMaterial material) const;

  /// Its index in Scene::materials, completed; equal materials share one.
  std::uint32_t index(const Material& material);
  std::uint32_t index(const NotedMaterial& material);

  /// Named materials that nothing uses, in the order of the file.
  std::vector<UnusedMaterial> unused() const;

 private:
  struct Block;
  static std::optional<Item> modelOf(const Item& block);
  void chooseModel(Block& block, const Item& value);
  void field(Block& block, const Item& field);
  void fromLibrary(Block& block, const Item& value);
  void warnOfHuge(const Material& material, const Item& field);
  void unknownField(const Block& block, const Item& field);
  bool pattern(Block& block, const Item& field);
  bool studentBump(Block& block, const Item& field);
  NotedMaterial noted(Material material, const Item& block, const NotedMaterial& inherited);
  void warnOfInheritedGlass(const Item& block, const Material& inherited);
  std::string asMaterial(const Item& value) const;

  Findings& findings_;
  TextureReader textures_;
  struct Named {
    NotedMaterial material;
    SourcePlace place;
    bool used = false;
  };
  /// An object, or another material, has it.
  void markUsed(const std::string& name);
  std::map<std::string, Named, std::less<>> named_;
  std::unordered_multimap<std::size_t, std::uint32_t> byHash_;
  std::optional<std::uint32_t> last_;  ///< the index that was asked for last
  std::map<std::pair<std::string, ShadedSides>, std::uint32_t> leftOut_;  ///< indices of completed materials
};

}  // namespace trace::rayfile
