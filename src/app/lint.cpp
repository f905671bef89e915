#include "app/lint.h"

#include <algorithm>
#include <array>
#include <set>

#include "app/coplanar.h"
#include "app/lint_checks.h"
#include "base/budget.h"
#include "base/file.h"
#include "base/text.h"
#include "formats/ray/ray_format.h"
#include "geometry/field_value.h"
#include "geometry/mesh/mesh.h"
#include "geometry/mesh/mesh_repair.h"
#include "geometry/shapes/csg.h"
#include "geometry/shapes/csg_tree.h"

namespace trace {
namespace lint_checks {

void warn(Findings& findings, std::string_view check, const Place& place, std::string what,
          std::string hint) {
  findings.push_back({check, {Message::Severity::warning, place, std::move(what), std::move(hint)}});
}

std::string quoted(const LintScene& s, std::uint32_t object) {
  const std::string name = objectName(s.scene, object);
  return s.scene.objects[object].name.empty() ? "the " + name : "\"" + name + "\"";
}

std::string percent(double share) { return toText(std::max(1.0, std::round(share * 100))) + " %"; }

const Place& placeOf(const LintScene& s, std::uint32_t object) { return s.scene.objects[object].place; }

Phong materialOf(const LintScene& s, std::uint32_t object) {
  return phongOf(s.scene.materials[s.scene.objects[object].material]);
}

bool isAroundCamera(const LintScene& s, std::uint32_t object) {
  return std::find(s.aroundCamera.begin(), s.aroundCamera.end(), object) != s.aroundCamera.end();
}

}  // namespace lint_checks

namespace {

using namespace lint_checks;

/// A scene of another format, or one that has no file any more, tells nothing but its name.
RayRemarks remarksOn(const Scene& scene) {
  const RayRemarks none{.degrees = {}, .camera = {.file = scene.file}};
  if (scene.format != "ray") return none;
  try {
    return trace::remarksOn(scene.file, readFile(scene.file));
  } catch (const Error&) {
    return none;
  }
}

/// Calls visit(object, mesh data) once for each mesh, however many objects share it.
template <class Visit>
void forEachMesh(const LintScene& s, Visit&& visit) {
  std::set<const MeshData*> seen;
  for (std::uint32_t i = 0; i < s.scene.objects.size(); ++i)
    if (const auto* mesh = s.scene.objects[i].shape.as<Mesh>())
      if (seen.insert(mesh->data.get()).second) visit(i, *mesh->data);
}

// --- meshes -------------------------------------------------------------------------------------------

void insideOut(const LintScene& s, Findings& findings) {
  forEachMesh(s, [&](std::uint32_t object, const MeshData& mesh) {
    // A room looks inward, and rightly so: lamps light it from within.
    const bool room =
        isAroundCamera(s, object) || (s.world.opaque(object) && s.survey.objects[object].direct > 0);
    if (room || shareInsideOut(s.world, object, mesh) < 0.9) return;
    warn(findings, "inside-out", placeOf(s, object),
         "the faces of " + quoted(s, object) +
             " look inward: it is lit from within, and glass bends light the wrong way",
         "list the corners of each face counter-clockwise as seen from outside");
  });
}

void turnedFaces(const LintScene& s, Findings& findings) {
  forEachMesh(s, [&](std::uint32_t object, const MeshData& mesh) {
    struct Edge {
      std::uint32_t low, high;
      bool upward;
      bool operator<(const Edge& o) const { return low != o.low ? low < o.low : high < o.high; }
    };
    std::vector<Edge> edges;
    edges.reserve(mesh.triangles.size() * 3);
    for (const Triangle& t : mesh.triangles)
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t a = t[i], b = t[(i + 1) % 3];
        edges.push_back({std::min(a, b), std::max(a, b), a < b});
      }
    std::sort(edges.begin(), edges.end());
    std::size_t shared = 0, against = 0;
    for (std::size_t i = 0; i < edges.size();) {
      std::size_t end = i + 1;
      while (end < edges.size() && !(edges[i] < edges[end])) ++end;
      if (end - i == 2) {
        ++shared;
        against += edges[i].upward == edges[i + 1].upward;
      }
      i = end;
    }
    if (against == 0) return;
    warn(findings, "turned-faces", placeOf(s, object),
         std::to_string(against) + " of " + std::to_string(shared) + " neighbouring pairs of faces of " +
             quoted(s, object) + " are turned opposite ways",
         "list the corners of every face in the same sense, counter-clockwise as seen from outside");
  });
}

void normalsAgainstFaces(const LintScene& s, Findings& findings) {
  forEachMesh(s, [&](std::uint32_t object, const MeshData& mesh) {
    if (mesh.normals.empty() || mesh.triangles.empty()) return;
    std::size_t against = 0;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
      const Vec3 face = faceNormal(mesh, i);
      const Triangle& t = mesh.triangles[i];
      against += std::all_of(t.begin(), t.end(),
                             [&](std::uint32_t point) { return dot(Vec3(mesh.normals[point]), face) < 0; });
    }
    const double share = static_cast<double>(against) / static_cast<double>(mesh.triangles.size());
    if (share < 0.05) return;
    warn(findings, "normals-against-faces", placeOf(s, object),
         "the normals of " + quoted(s, object) + " point against its faces in " + percent(share) +
             " of the triangles: what is shaded and what is in shadow do not agree there",
         "reverse either the normals or the order of the faces' corners; gennormals makes normals that fit");
  });
}

bool isOfArea(const Message& message) { return message.what.starts_with(kWithoutArea); }
bool isOfGlass(const Message& message) { return message.what.starts_with(kInheritsGlass); }

void zeroArea(const LintScene& s, Findings& findings) {
  for (const Message& message : s.warnings)
    if (isOfArea(message))
      warn(findings, "zero-area", message.place, message.what,
           "their corners lie on one line, or are one point: take them out of the file, or mend their "
           "corners");
}

void coplanarFaces(const LintScene& s, Findings& findings) {
  constexpr int kFew = 3;
  // Flat faces wherever they are; others, such as those of prisms, where the camera sees them.
  Statistics statistics;
  const auto isSeen = [&](const Vec3& place) {  // whichever way the camera looks
    constexpr Real kThere = 1 - 1e-6;           // of the way
    const Vec3& eye = s.world.camera().eye;
    const auto found = s.world.closest({eye, place - eye}, Faces::both, statistics);
    return found && found->t > kThere;
  };
  std::set<std::pair<std::uint32_t, std::uint32_t>> pairs = overlappingFaces(s.scene, isSeen);
  for (const auto& [pair, places] : s.survey.coplanar)
    if (places >= kFew) pairs.insert(pair);
  for (const auto& pair : pairs) {
    if (s.world.opaque(pair.first) && materialOf(s, pair.first) == materialOf(s, pair.second)) continue;
    warn(findings, "coplanar", placeOf(s, pair.second),
         "a face of " + quoted(s, pair.second) + " lies in the same plane as one of " +
             quoted(s, pair.first) + " and covers it: which of them is seen is left to rounding",
         "move one of them a little, or leave out the part that is covered");
  }
}

// --- materials ----------------------------------------------------------------------------------------

void addMaterials(const Shape& shape, std::set<std::uint32_t>& used) {
  used.insert(materialsOf(shape).begin(), materialsOf(shape).end());
  for (const Operand& operand : shape.operands().list()) {
    used.insert(operand.material);
    addMaterials(operand.shape, used);
  }
}

/// Some readers keep the materials that the file names and leave to nothing in the scene, others beside it.
void unusedMaterial(const LintScene& s, Findings& findings) {
  const bool inRay = s.scene.format == "ray";
  const auto unused = [&](const std::string& name, const Place& place) {
    warn(findings, "unused-material", place, "the material \"" + name + "\" is given to nothing",
         inRay ? "name it in an object, as in sphere { material = \"" + name + "\"; }, or take it out"
               : "give it to an object, or take it out");
  };
  for (const UnusedMaterial& material : s.scene.unusedMaterials) unused(material.name, material.place);
  std::set<std::uint32_t> used;
  for (const Object& object : s.scene.objects) {
    used.insert(object.material);
    addMaterials(object.shape, used);
  }
  for (std::uint32_t i = 0; i < s.scene.materials.size(); ++i)
    if (!s.scene.materials[i].name.empty() && !used.contains(i))
      unused(s.scene.materials[i].name, Place{.file = s.scene.file});
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
             ": no matter has one below 1",
         "glass has index = 1.5, water 1.33; for a bubble in glass nest a surface of index 1");
  }
}

void depthTooLow(const LintScene& s, Findings& findings) {
  constexpr double kFew = 0.04;
  const double samples = s.survey.samples;
  if (s.survey.cutShort.size() < kFew * samples || s.survey.cutShort.empty()) return;
  const std::vector<int> darker = changedByDepth(s.settings, s.world, s.survey);
  // With the depth set, and with each depth above it.
  const auto enough = std::find_if(darker.begin(), darker.end(), [&](int n) { return n < kFew * samples; });
  if (darker.empty() || enough == darker.begin()) return;
  const std::string depth = std::to_string(s.settings.depth + static_cast<int>(enough - darker.begin()));
  warn(findings, "depth-too-low", placeOf(s, s.survey.cutShortIn),
       "rays end inside glass, at first in " + quoted(s, s.survey.cutShortIn) + ", for the depth is only " +
           std::to_string(s.settings.depth) + ": " + percent(darker.front() / samples) +
           " of the picture would look different with more",
       "--depth " + depth + ", or settings { depth = " + depth + "; } in the scene");
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

void noMaterial(const LintScene& s, Findings& findings) {
  std::vector<std::uint32_t> bare;
  for (std::uint32_t i = 0; i < s.scene.objects.size(); ++i)
    if (isBare(s, s.scene.objects[i].shape, s.scene.objects[i].material)) bare.push_back(i);
  if (bare.empty()) return;
  const std::size_t others = bare.size() - 1;
  warn(findings, "no-material", placeOf(s, bare.front()),
       quoted(s, bare.front()) +
           (others == 0   ? " has no material"
            : others == 1 ? " and one more object have no material"
                          : " and " + std::to_string(others) + " more objects have no material") +
           ", or one that says nothing: no light makes it other than black",
       "give it one, as in material = { diffuse = (0.8, 0.8, 0.8); ambient = (0.8, 0.8, 0.8); }");
}

void degrees(const LintScene& s, Findings& findings) {
  if (s.remarks.degrees.empty()) return;
  const RayRemarks::Angle& first = s.remarks.degrees.front();
  const std::size_t others = s.remarks.degrees.size() - 1;
  warn(findings, "degrees", first.place,
       "rotate takes radians, and " + toText(first.value) + " of them are " +
           toText(std::round(std::abs(first.value) / (2 * kPi) * 10) / 10) + " turns" +
           (others == 0 ? "" : "; so with " + std::to_string(others) + " more angles") +
           ": are degrees meant?",
       toText(first.value) + " degrees are " + toText(std::round(first.value * kPi / 180 * 1e5) / 1e5) +
           " radians");
}

}  // namespace

std::span<const LintCheck> lintChecks() {
  static constexpr std::array kTable{
      LintCheck{"light-inside", "a point light inside an opaque object", lightInside},
      LintCheck{"light-behind-glass", "a point light most of which comes through refracting glass",
                lightBehindGlass},
      LintCheck{"light-too-weak", "a light that is too weak to see", lightTooWeak},
      LintCheck{"light-blocked", "a light that one object shuts out, such as the sun a sky", lightBlocked},
      LintCheck{"light-cut", "a light whose flaps or photometric file leave nothing of it", lightCut},
      LintCheck{"light-link", "a light or an object that names what is not there", lightLink},
      LintCheck{"camera-inside", "the camera inside a solid", cameraInside},
      LintCheck{"camera-looks-away", "a camera that faces away from everything", cameraLooksAway},
      LintCheck{"unlit", "an object that is seen and that no light reaches", unlit},
      LintCheck{"caustics-missing", "mirrors and glass whose caustics the integrator does not find",
                causticsMissing},
      LintCheck{"inside-out", "a closed mesh whose faces look inward", insideOut},
      LintCheck{"turned-faces", "neighbouring faces of a mesh turned opposite ways", turnedFaces},
      LintCheck{"normals-against-faces", "vertex normals that point against the faces", normalsAgainstFaces},
      LintCheck{"zero-area", "triangles of a mesh without area", zeroArea},
      LintCheck{"coplanar", "faces of two objects in one plane, one over the other", coplanarFaces},
      LintCheck{"unused-material", "a named material that nothing uses", unusedMaterial},
      LintCheck{"inherited-glass", "a material that is glass only for what it inherits", inheritedGlass},
      LintCheck{"index-below-1", "glass of an index of refraction below 1", indexBelowOne},
      LintCheck{"glass-in-glass", "bodies of glass that overlap and are each taken to be in air",
                glassInGlass},
      LintCheck{"medium-unseen", "a medium in an opaque body, or in one that encloses nothing", mediumUnseen},
      LintCheck{"medium-empty", "a medium that is nowhere dense, or does nothing with light", mediumEmpty},
      LintCheck{"subsurface-open", "light that is to spread inside an open sheet", subsurfaceOpen},
      LintCheck{"depth-too-low", "glass that shows too little for too small a depth", depthTooLow},
      LintCheck{"no-material", "objects without a material", noMaterial},
      LintCheck{"black-reflection", "a mirror or glass that shows black for a background", blackReflection},
      LintCheck{"degrees", "degrees where a rotation takes radians", degrees},
  };
  return kTable;
}

std::vector<LintFinding> lint(const Scene& scene, const Settings& settings, const World& world,
                              const std::vector<Message>& warnings) {
  LintScene s{scene, settings, world, warnings, survey(scene, settings, world)};
  s.aroundCamera = objectsAround(world, world.camera().eye);
  s.remarks = remarksOn(scene);
  std::vector<LintFinding> findings;
  for (const Message& message : warnings)
    if (!isOfArea(message) && !isOfGlass(message)) findings.push_back({"reading", message});
  Work work("checking", static_cast<std::int64_t>(lintChecks().size()));
  for (const LintCheck& check : lintChecks()) {
    check.run(s, findings);
    work.reached(&check - lintChecks().data() + 1);
  }
  return findings;
}

}  // namespace trace
