// The textures of a POV-Ray scene as Trace's materials.
#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "formats/pov/pov_nodes.h"
#include "formats/warnings.h"
#include "shading/material.h"

namespace trace::pov {

/// A colour that may change over a surface: the scale alone, or times a texture.
struct Paint {
  Color scale{};
  std::optional<Texture> texture{};
  bool none() const { return isBlack(scale); }
};

class Painter {
 public:
  explicit Painter(WarningsByKind& warnings) : warnings_(warnings) {}

  /// `objectFromTexture` places the texture in the object.
  Material material(const TextureNode& texture, const InteriorNode* interior, const Affine& objectFromTexture,
                    bool uv);

  using Leaf = std::function<Color(const Numbers&)>;
  /// The pigment as leaf() sees its colours: leaf(colour).
  Paint paint(const PigmentNode& pigment, const Leaf& leaf, bool uv = false);

 private:
  void tell(const Omissions& left);
  /// Whether that part of a texture, whose fields are painted one by one, is seen for the first time.
  bool isFirst(const void* part) { return met_.insert(part).second; }
  struct Look {
    Paint diffuse, ambient, emissive, specular, reflective, transmissive;
    Real shininess = 0, bump = 0;
    std::optional<Texture> relief{};
    bool clear = false;  ///< nothing of the surface is seen
  };
  static Look averageOf(const Entries<TextureNode>& entries, const std::vector<Look>& looks);
  Look look(const TextureNode& texture, bool uv);
  Look look(const TextureNode::Layer& layer, bool uv);
  Texture numberOf(const PatternNode& pattern);
  bool knows(const PatternNode& pattern);

  WarningsByKind& warnings_;
  std::set<const void*> met_;
};

/// The texture moved by `m`.
Texture moved(const Texture& texture, const Affine& m);

}  // namespace trace::pov
