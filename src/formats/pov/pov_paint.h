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

  /// The conventions of the whole scene.
  struct Conventions {
    bool mirrorHighlights = false;  ///< highlights by the mirrored light, otherwise by the half-way vector
    bool linear = true;             ///< colours are linear light, otherwise those of a screen
  };
  void setConventions(const Conventions& to) { conventions_ = to; }
  const Conventions& conventions() const { return conventions_; }

  /// `objectFromTexture` places the texture in the object.
  Material material(const TextureNode& texture, const InteriorNode* interior, const Affine& objectFromTexture,
                    bool uv);

  using Leaf = std::function<Color(const Numbers&)>;
  /// The pigment as leaf() sees its colours: leaf(colour).
  Paint paint(const PigmentNode& pigment, const Leaf& leaf, bool uv = false);
  /// The colour of a pigment as far as it is opaque.
  Paint opaque(const PigmentNode& pigment, Real strength = 1, bool uv = false);
  /// The light that a pigment lets through.
  Paint passing(const PigmentNode& pigment, bool uv = false);
  /// `top`, and what it lets through of the layer below.
  static Paint layered(const Paint& top, const Paint& passing, const Paint& below);

 private:
  void tell(const Omissions& left);
  /// Whether that part of a texture, whose fields are painted one by one, is seen for the first time.
  bool isFirst(const void* part) { return met_.insert(part).second; }
  struct Look {
    Paint diffuse, ambient, emissive, specular, reflective, grazing, transmissive;
    Real shininess = 0, bump = 0, brilliance = 1, grazingExponent = 5;
    std::optional<Texture> relief{};
    bool clear = false;  ///< nothing of the surface is seen
  };
  static Look averageOf(const Entries<TextureNode>& entries, const std::vector<Look>& looks);
  static void takeAngles(Look& to, const Look& from);
  Look look(const TextureNode& texture, bool uv);
  Look look(const TextureNode::Layer& layer, bool uv);
  Texture numberOf(const PatternNode& pattern);
  bool knows(const PatternNode& pattern);

  /// The factors on a mirrored ray: along the normal, and what it gains at grazing angles.
  struct Mirror {
    Color least, gain;
    Real exponent = 5;
  };
  Mirror mirror(const FinishNode& finish) const;
  Real shininess(const FinishNode& finish) const;

  WarningsByKind& warnings_;
  Conventions conventions_;
  Real index_ = 1;  ///< the index of refraction of the material that is being painted
  std::set<const void*> met_;
};

/// The texture moved by `m`.
Texture moved(const Texture& texture, const Affine& m);

}  // namespace trace::pov
