// Notes of the reader of a .ray file for changing its text (ray_patch.h): which text made which
// part of the scene. Nodes are known by their offsets in the text.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <vector>

#include "base/error.h"
#include "scene/scene.h"

namespace trace::rayfile {

class Syntax;

/// A material being read, and the block `{ ... }` of the text that says it.
struct NotedMaterial : Material {
  static constexpr std::uint32_t kNoBlock = std::numeric_limits<std::uint32_t>::max();

  NotedMaterial() = default;
  explicit NotedMaterial(Material material) : Material(std::move(material)) {}

  std::uint32_t block = kNoBlock;  ///< index into Notes::blocks
  bool given = false;              ///< the file says a field of its looks, were it only a default
};

struct Notes {
  /// A block `{ ... }` of a material, in the order of reading.
  struct Block {
    std::uint32_t inherits;  ///< the block that it starts as a copy of
    Material inherited, material;
    std::uint32_t index = NotedMaterial::kNoBlock;  ///< index of Scene::materials, if something has it
  };
  /// A place where a material is said, by its block or by its name.
  struct Use {
    std::size_t offset;
    std::uint32_t block;
  };
  std::vector<Block> blocks;
  std::vector<Use> uses;

  /// By the offset of an object's call: the material in force there, which its own inherits from.
  std::map<std::size_t, NotedMaterial> inForce;
  /// The text of an operand, with the transforms around it, and the calls that it is made of: several for a
  /// group, which is the union of them.
  struct OperandText {
    std::size_t offset;
    std::vector<std::size_t> calls;
  };
  /// By the offset of a solid of solids.
  std::map<std::size_t, std::vector<OperandText>> operands;
  /// The material in force at the end of the file.
  NotedMaterial last;
};

/// The scene of the tree at `time`, and how it came about. Throws as readRay() (ray_format.h).
Scene readNoted(Syntax& syntax, Messages& messages, Real time, Notes& notes);

}  // namespace trace::rayfile
