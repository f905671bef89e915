// The checks of materials, and of how deep glass is looked into.
#include <algorithm>
#include <cmath>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "app/lint/checks.h"
#include "base/text.h"
#include "geometry/field_value.h"
#include "geometry/shapes/solids/csg.h"
#include "geometry/shapes/solids/csg_tree.h"
#include "geometry/shapes/solids/cube.h"
#include "shading/textures/brick.h"

namespace trace::lint_checks {
namespace {

void addMaterials(const Shape& shape, std::set<std::uint32_t>& used) {
  used.insert(materialsOf(shape).begin(), materialsOf(shape).end());
  for (const Operand& operand : shape.operands().list()) {
    used.insert(operand.material);
    addMaterials(operand.shape, used);
  }
}

/// Nothing but black, and nothing said of it.
bool isBare(const Material& material) {
  return material.name.empty() && material.textures.empty() && material.model == MaterialModel() &&
         material.mediumDensity == 0;
}

/// Whether the shape, or a part of it, would be of that material and it is bare.
bool isBare(const LintScene& s, const Shape& shape, std::uint32_t material) {
  if (shape.type().ofObjects) {
    std::span<const Operand> parts = shape.operands().list();
    if (shape.is<Clip>() && !parts.empty()) parts = parts.first(1);  // others only cut
    return std::any_of(parts.begin(), parts.end(),
                       [&](const Operand& part) { return isBare(s, part.shape, part.material); });
  }
  return materialsOf(shape).empty() && isBare(s.scene.materials[material]);
}

/// The first texture of bricks on the material, however deep.
const TextureNode* bricksIn(const std::vector<FieldTexture>& textures) {
  for (const FieldTexture& t : textures) {
    if (t.texture->model.is<Brick>()) return &*t.texture;
    if (const TextureNode* inner = bricksIn(t.texture->inputs)) return inner;
  }
  return nullptr;
}

/// Whether the plane lies in a joint, where bricks of that length stand from `moved` on.
bool inJoint(Real plane, Real moved, Real length, Real mortar) {
  const Real t = (plane - moved) / length;
  return length > 0 && std::abs(t - std::round(t)) * length < mortar / 2;
}

}  // namespace

/// Checks a box whose bricks are not rotated. Joints across x are moved from course to course.
void brickJoint(const LintScene& s, Findings& findings) {
  for (std::uint32_t object = 0; object < s.scene.objects.size(); ++object) {
    const Object& o = s.scene.objects[object];
    if (!o.shape.is<Cube>()) continue;
    const TextureNode* node = bricksIn(s.scene.materials[o.material].textures);
    if (!node || node->placement.rotate != Vec3{}) continue;
    const Brick& brick = *node->model.as<Brick>();
    if (brick.space != TextureSpace::point) continue;
    for (int axis = 2; axis >= 1; --axis) {
      const Real scale = node->placement.scale[axis], moved = node->placement.translate[axis];
      if (!inJoint(0.5 / scale, moved / scale, brick.size[axis], brick.mortar)) continue;
      const std::string name(1, "xyz"[axis]), by = toText(brick.size[axis] * std::abs(scale) / 2);
      warn(findings, "brick-joint", placeOf(s, object),
           "a face of " + quoted(s, object) + " lies in a joint of its bricks, at " + name +
               " = 0.5: all of it is mortar",
           "translate = " + std::string(axis == 1 ? "(0, " + by + ", 0)" : "(0, 0, " + by + ")") +
               " in brick { } moves the joints");
      break;
    }
  }
}

/// Some readers keep the materials that the file names and leave to nothing in the scene, others beside it.
void unusedMaterial(const LintScene& s, Findings& findings) {
  const bool inRay = s.scene.format == "ray";
  const auto unused = [&](const std::string& name, const SourcePlace& place) {
    warn(findings, "unused-material", place, "the material \"" + name + "\" is not used",
         inRay ? "name it in an object, as in sphere { material = \"" + name + "\"; }, or remove it"
               : "give it to an object, or remove it");
  };
  for (const UnusedMaterial& material : s.scene.unusedMaterials) unused(material.name, material.place);
  std::set<std::uint32_t> used;
  for (const Object& object : s.scene.objects) {
    used.insert(object.material);
    addMaterials(object.shape, used);
  }
  for (std::uint32_t i = 0; i < s.scene.materials.size(); ++i)
    if (!s.scene.materials[i].name.empty() && !used.contains(i))
      unused(s.scene.materials[i].name, SourcePlace{.file = s.scene.file});
}

void inheritedGlass(const LintScene& s, Findings& findings) {
  for (const Message& message : s.warnings)
    if (isOfGlass(message)) warn(findings, "inherited-glass", message.place, message.what, message.hint);
}

void indexBelowOne(const LintScene& s, Findings& findings) {
  std::set<std::uint32_t> told;
  for (std::uint32_t object = 0; object < s.scene.objects.size(); ++object) {
    const Phong material = materialOf(s, object);
    if (!material.transmits() || material.index >= 1) continue;
    if (!told.insert(s.scene.objects[object].material).second) continue;
    warn(findings, "index-below-1", placeOf(s, object),
         "the index of refraction of " + quoted(s, object) + " is " + toText(material.index) +
             ": real materials have at least 1",
         "glass has index = 1.5, water 1.33; for a bubble in glass nest a surface of index 1");
  }
}

void depthTooLow(const LintScene& s, Findings& findings) {
  constexpr double kOfPicture = 0.04, kOfObject = 0.2, kFewest = 5;
  const double samples = s.survey.samples;
  if (s.survey.cutShort.empty()) return;
  // One glass on a large table is to be reported, too.
  const auto cut = static_cast<double>(s.survey.cutShort.size());
  const double few = cut >= kOfPicture * samples
                         ? kOfPicture * samples
                         : std::max(kFewest, kOfObject * s.survey.objects[s.survey.cutShortIn].places);
  if (cut < few) return;
  const std::vector<int> darker = changedByDepth(s.settings, s.world, s.survey);
  // With the depth set, and with each depth above it.
  const auto enough = std::find_if(darker.begin(), darker.end(), [&](int n) { return n < few; });
  if (darker.empty() || enough == darker.begin()) return;
  const std::string depth = std::to_string(s.settings.depth + static_cast<int>(enough - darker.begin()));
  warn(findings, "depth-too-low", placeOf(s, s.survey.cutShortIn),
       "rays end inside glass, first in " + quoted(s, s.survey.cutShortIn) + ", because the depth is only " +
           std::to_string(s.settings.depth) + ": " + percent(darker.front() / samples) +
           " of the picture would look different with more",
       "--depth " + depth + ", or settings { depth = " + depth + "; } in the scene");
}

void noMaterial(const LintScene& s, Findings& findings) {
  std::vector<std::uint32_t> bare;
  for (std::uint32_t i = 0; i < s.scene.objects.size(); ++i)
    if (isBare(s, s.scene.objects[i].shape, s.scene.objects[i].material)) bare.push_back(i);
  if (bare.empty()) return;
  const std::size_t others = bare.size() - 1;
  warn(findings, "no-material", placeOf(s, bare.front()),
       quoted(s, bare.front()) +
           (others == 0 ? " has no material"
                        : " and " + counted(others, "more object") + " have no material") +
           ", or an empty one: it is black in any light",
       "give it one, as in material = { diffuse = (0.8, 0.8, 0.8); ambient = (0.8, 0.8, 0.8); }");
}

}  // namespace trace::lint_checks
