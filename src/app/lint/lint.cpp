#include "app/lint/lint.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "app/lint/checks.h"
#include "app/session/render_warnings.h"
#include "base/budget.h"
#include "base/text.h"
#include "formats/ray/read/material.h"
#include "geometry/mesh/mesh_repair.h"
#include "geometry/traced.h"
#include "math/elementary.h"
#include "scene/groups.h"

namespace trace {
namespace lint_checks {

void warn(Findings& findings, std::string_view check, const SourcePlace& place, std::string what,
          std::string hint) {
  findings.push_back({check, {Message::Severity::warning, place, std::move(what), std::move(hint)}});
}

std::string quoted(const LintScene& s, std::uint32_t object) {
  const std::string name = objectName(s.scene, object);
  return s.scene.objects[object].name.empty() ? "the " + name : "\"" + name + "\"";
}

std::string percent(double share) { return toText(std::max(1.0, std::round(share * 100))) + " %"; }

const SourcePlace& placeOf(const LintScene& s, std::uint32_t object) { return s.scene.objects[object].place; }

Phong materialOf(const LintScene& s, std::uint32_t object) {
  return phongOf(s.scene.materials[s.scene.objects[object].material]);
}

bool isAroundCamera(const LintScene& s, std::uint32_t object) {
  return std::find(s.aroundCamera.begin(), s.aroundCamera.end(), object) != s.aroundCamera.end();
}

Box3 boxAround(const Object& object) { return object.worldFromObject * prepare(object.shape).bounds(); }

Real roundedTo(Real value) {
  if (value == 0 || !std::isfinite(value)) return value;
  const Real unit = math::pow(10.0, std::floor(math::log10(std::abs(value))) - 2);
  return unit < 1 ? std::round(value / unit) / std::round(1 / unit) : std::round(value);
}

bool isOfArea(const Message& message) { return message.what.starts_with(kWithoutArea); }
bool isOfGlass(const Message& message) { return message.what.starts_with(rayfile::kInheritsGlass); }

}  // namespace lint_checks

namespace {

using namespace lint_checks;

void degrees(const LintScene& s, Findings& findings) {
  if (s.remarks.degrees.empty()) return;
  const RayRemarks::Angle& first = s.remarks.degrees.front();
  const std::size_t others = s.remarks.degrees.size() - 1;
  warn(findings, "degrees", first.place,
       "rotate takes radians, and " + toText(first.value) + " of them are " +
           toText(std::round(std::abs(first.value) / (2 * kPi) * 10) / 10) + " turns" +
           (others == 0 ? "" : "; so with " + counted(others, "more angle")) + ": are degrees meant?",
       toText(first.value) + " degrees are " + toText(std::round(first.value * kPi / 180 * 1e5) / 1e5) +
           " radians");
}

void unusedName(const LintScene& s, Findings& findings) {
  for (const RayRemarks::Unused& unused : s.remarks.unused)
    warn(findings, "unused-name", unused.place,
         "\"" + unused.name + "\" is " +
             (unused.isParameter ? "a parameter that nothing in its definition uses"
                                 : "defined, but nothing uses it"),
         unused.isParameter ? "use it in the body, or leave it out" : "use it, or leave it out");
}

}  // namespace

std::span<const LintCheck> lintChecks() {
  static constexpr std::array kTable{
      LintCheck{"light-inside", "a point light inside an opaque object", lightInside},
      LintCheck{"light-behind-glass", "a point light that mostly shines through refracting glass",
                lightBehindGlass},
      LintCheck{"light-too-weak", "a light that is too weak to see", lightTooWeak},
      LintCheck{"light-blocked", "a light that one object blocks, such as the sun behind a sky",
                lightBlocked},
      LintCheck{"light-cut", "a light that its flaps or photometric file shut off", lightCut},
      LintCheck{"light-faces-away", "a panel of light that emits to the side where no object is",
                lightFacesAway},
      LintCheck{"light-link", "a light or an object that names unknown objects or lights", lightLink},
      LintCheck{"portal", "a portal without light, or in the open", portalUseless},
      LintCheck{"camera-inside", "the camera inside a solid", cameraInside},
      LintCheck{"camera-looks-away", "a camera that faces away from everything", cameraLooksAway},
      LintCheck{"unlit", "an object that is seen and that no light reaches", unlit},
      LintCheck{"light-reaches-nothing", "a light that contributes nothing to the picture",
                lightReachesNothing},
      LintCheck{"caustics-missing", "mirrors and glass whose caustics the integrator does not find",
                causticsMissing},
      LintCheck{"inside-out", "a closed mesh whose faces look inward", insideOut},
      LintCheck{"turned-faces", "neighbouring faces of a mesh turned opposite ways", turnedFaces},
      LintCheck{"normals-against-faces", "vertex normals that point against the faces", normalsAgainstFaces},
      LintCheck{"zero-area", "triangles of a mesh without area", zeroArea},
      LintCheck{"coplanar", "faces of two objects in one plane, one over the other", coplanarFaces},
      LintCheck{"unused-material", "a named material that nothing uses", unusedMaterial},
      LintCheck{"unused-name", "a name or parameter that nothing uses", unusedName},
      LintCheck{"inherited-glass", "a material that is glass only by inheritance", inheritedGlass},
      LintCheck{"index-below-1", "glass of an index of refraction below 1", indexBelowOne},
      LintCheck{"glass-in-glass", "glass objects that overlap and are each assumed to be in air",
                glassInGlass},
      LintCheck{"medium-unseen", "a medium in an opaque object, or in one that encloses nothing",
                mediumUnseen},
      LintCheck{"medium-empty", "a medium without density, or without scattering, absorption and emission",
                mediumEmpty},
      LintCheck{"subsurface-open", "subsurface scattering in an open sheet", subsurfaceOpen},
      LintCheck{"depth-too-low", "glass that looks wrong because the depth is too small", depthTooLow},
      LintCheck{"brick-joint", "a box whose face lies in a joint of its bricks", brickJoint},
      LintCheck{"no-material", "objects without a material", noMaterial},
      LintCheck{"black-reflection", "a mirror or glass that shows black for a background", blackReflection},
      LintCheck{"black-picture", "a picture that is nearly all black, without another finding", blackPicture},
      LintCheck{"degrees", "degrees where a rotation takes radians", degrees},
  };
  return kTable;
}

std::vector<LintFinding> lint(const Scene& scene, const Settings& settings, const World& world,
                              const std::vector<Message>& warnings, std::optional<Real> measured) {
  if (!scene.uses.empty()) {  // some of the placed objects stand for all
    constexpr std::size_t kMostChecked = 1000;
    const Scene some = firstCopies(scene, kMostChecked);
    Messages known;
    return lint(some, settings, compile(some, settings, known), warnings, measured);
  }
  LintScene s{scene, settings, world, warnings, survey(scene, settings, world)};
  s.aroundCamera = objectsAround(world, world.camera().eye);
  s.remarks = remarksOn(scene);
  s.measured = measured;
  std::vector<LintFinding> findings;
  for (const Message& message : warnings)
    if (!isOfArea(message) && !isOfGlass(message)) findings.push_back({"reading", message});
  Messages idle;
  warnOfSettings(scene, settings, world, idle);
  for (const Message& message : idle.all()) findings.push_back({"reading", message});
  Work work("checking", static_cast<std::int64_t>(lintChecks().size()));
  for (const LintCheck& check : lintChecks()) {
    check.run(s, findings);
    work.reached(&check - lintChecks().data() + 1);
  }
  // Parts of one object are reported once.
  std::vector<LintFinding> once;
  for (LintFinding& finding : findings)
    if (std::none_of(once.begin(), once.end(), [&](const LintFinding& other) {
          return other.check == finding.check && other.message.what == finding.message.what &&
                 other.message.place.line == finding.message.place.line &&
                 other.message.place.column == finding.message.place.column;
        }))
      once.push_back(std::move(finding));
  return once;
}

std::optional<Message> whyUnlit(const Scene& scene, const Settings& settings, const World& world) {
  constexpr std::string_view kCauses[] = {"light-inside", "light-blocked", "light-cut", "light-faces-away",
                                          "light-reaches-nothing"};
  for (const LintFinding& finding : lint(scene, settings, world, {}))
    if (std::find(std::begin(kCauses), std::end(kCauses), finding.check) != std::end(kCauses))
      return finding.message;
  return {};
}

}  // namespace trace
