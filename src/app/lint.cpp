#include "app/lint.h"

#include <algorithm>
#include <array>
#include <set>

#include "app/coplanar.h"
#include "app/lint_rays.h"
#include "base/text.h"
#include "formats/ray_format.h"
#include "geometry/csg_tree.h"
#include "geometry/mesh_repair.h"

namespace trace {

/// What the checks look at.
struct LintScene {
  const Scene& scene;
  const Settings& settings;
  const World& world;
  const std::vector<Message>& warnings;
  Survey survey;
  std::vector<std::uint32_t> aroundCamera{};  ///< the objects that enclose it
};

namespace {

using Findings = std::vector<LintFinding>;

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

const Phong& materialOf(const LintScene& s, std::uint32_t object) {
  return *std::get_if<Phong>(&s.scene.materials[s.scene.objects[object].material].model);
}

/// Calls visit(object, mesh data) once for each mesh, however many objects share it.
template <class Visit>
void forEachMesh(const LintScene& s, Visit&& visit) {
  std::set<const MeshData*> seen;
  for (std::uint32_t i = 0; i < s.scene.objects.size(); ++i)
    if (const auto* mesh = std::get_if<Mesh>(&s.scene.objects[i].shape))
      if (seen.insert(mesh->data.get()).second) visit(i, *mesh->data);
}

bool isAroundCamera(const LintScene& s, std::uint32_t object) {
  return std::find(s.aroundCamera.begin(), s.aroundCamera.end(), object) != s.aroundCamera.end();
}

// --- lights and camera --------------------------------------------------------------------------------

void lightInside(const LintScene& s, Findings& findings) {
  for (const LightSource& source : s.scene.lights) {
    const auto* light = std::get_if<PointLight>(&source.light);
    if (!light) continue;
    for (std::uint32_t object : objectsAround(s.world, light->position)) {
      if (!s.world.opaque(object) || isAroundCamera(s, object)) continue;
      warn(findings, "light-inside", source.place,
           "the light is inside " + quoted(s, object) + ", which is opaque: it lights nothing outside",
           "move the light out of it; a lamp that shines needs `emissive` for its looks and a light beside "
           "it");
    }
  }
}

void cameraInside(const LintScene& s, Findings& findings) {
  for (std::uint32_t object : s.aroundCamera) {
    const bool glass = !s.world.opaque(object);
    if (!glass && s.survey.objects[object].lit > 0) continue;  // a room
    warn(findings, "camera-inside", placeOf(s, object),
         "the camera is inside " + quoted(s, object) +
             (glass ? ": all is seen through its surface, from within"
                    : ": only its inside is seen, which no light reaches"),
         "move the camera's position out of it");
  }
}

void lightBehindGlass(const LintScene& s, Findings& findings) {
  constexpr int kFew = 10;
  for (std::size_t i = 0; i < s.scene.lights.size(); ++i) {
    const Survey::Lamp& lamp = s.survey.lights[i];
    if (lamp.throughGlass < kFew || 2 * lamp.throughGlass < lamp.reached) continue;
    warn(findings, "light-behind-glass", s.scene.lights[i].place,
         "most of this light comes through " + quoted(s, lamp.glass) +
             ", which refracts: shadow rays run straight on, so light is neither bent nor gathered there",
         "move the light out of the glass, or give what is around it index = 1");
  }
}

void unlit(const LintScene& s, Findings& findings) {
  constexpr int kFew = 5;
  if (s.scene.lights.empty()) return;  // said when it was read
  for (std::uint32_t object = 0; object < s.scene.objects.size(); ++object) {
    const Survey::Seen& seen = s.survey.objects[object];
    if (seen.places < kFew || seen.lit > 0 || seen.couldBeLit < seen.places) continue;
    const auto most = std::max_element(seen.blockedBy.begin(), seen.blockedBy.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    const bool away = most == seen.blockedBy.end() || seen.facesAway > most->second;
    warn(
        findings, "unlit", placeOf(s, object),
        quoted(s, object) + " is seen, but no light reaches what is seen of it: it is black" +
            (away ? "; it faces away from the lights"
                  : (most->first == object ? "; it stands in its own light"
                                           : "; in the way is " + quoted(s, most->first))),
        away
            ? "move a light to the side that is seen, add an ambient light with `ambient` in the material, "
              "or "
              "turn its faces round"
            : "move the light or what is in the way, or add an ambient light with `ambient` in the material");
  }
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
      if (end - i == 2) ++shared, against += edges[i].upward == edges[i + 1].upward;
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
  match(shape, Overloaded{[&](const Mesh& mesh) {
                            used.insert(mesh.data->materials.begin(), mesh.data->materials.end());
                          },
                          [&](const auto& s) {
                            if constexpr (requires { s.materials.indices; })
                              used.insert(s.materials.indices.begin(), s.materials.indices.end());
                            if constexpr (requires { s.objects.list(); })
                              for (const Operand& operand : s.objects.list()) {
                                used.insert(operand.material);
                                addMaterials(operand.shape, used);
                              }
                          }});
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
    const Phong& material = materialOf(s, object);
    if (!material.transmits() || material.index >= 1) continue;
    if (!told.insert(s.scene.objects[object].material).second) continue;
    warn(findings, "index-below-1", placeOf(s, object),
         "the index of refraction of " + quoted(s, object) + " is " + toText(material.index) +
             ": no matter has one below 1",
         "glass has index = 1.5, water 1.33; for a bubble in glass nest a surface of index 1");
  }
}

void depthTooLow(const LintScene& s, Findings& findings) {
  constexpr double kFew = 0.02;
  constexpr int kMostDepth = 30;
  const double share = s.survey.samples > 0 ? static_cast<double>(s.survey.cutShort) / s.survey.samples : 0;
  if (share < kFew) return;
  int enough = s.settings.depth + 1;
  while (enough < kMostDepth && shareCutShort(s.settings, s.world, enough) >= kFew) ++enough;
  warn(findings, "depth-too-low", placeOf(s, s.survey.cutShortIn),
       "rays end inside glass, at first in " + quoted(s, s.survey.cutShortIn) + ", in " + percent(share) +
           " of the picture, for the depth is only " + std::to_string(s.settings.depth) +
           ": it is black there",
       "--depth " + std::to_string(enough) + ", or settings { depth = " + std::to_string(enough) +
           "; } in the scene");
}

}  // namespace

std::span<const LintCheck> lintChecks() {
  static constexpr std::array kTable{
      LintCheck{"light-inside", "a point light inside an opaque object", lightInside},
      LintCheck{"light-behind-glass", "a light most of which comes through refracting glass",
                lightBehindGlass},
      LintCheck{"camera-inside", "the camera inside a solid", cameraInside},
      LintCheck{"unlit", "an object that is seen and that no light reaches", unlit},
      LintCheck{"inside-out", "a closed mesh whose faces look inward", insideOut},
      LintCheck{"turned-faces", "neighbouring faces of a mesh turned opposite ways", turnedFaces},
      LintCheck{"normals-against-faces", "vertex normals that point against the faces", normalsAgainstFaces},
      LintCheck{"zero-area", "triangles of a mesh without area", zeroArea},
      LintCheck{"coplanar", "faces of two objects in one plane, one over the other", coplanarFaces},
      LintCheck{"unused-material", "a named material that nothing uses", unusedMaterial},
      LintCheck{"inherited-glass", "a material that is glass only for what it inherits", inheritedGlass},
      LintCheck{"index-below-1", "glass of an index of refraction below 1", indexBelowOne},
      LintCheck{"depth-too-low", "glass that is black for too small a depth", depthTooLow},
  };
  return kTable;
}

std::vector<LintFinding> lint(const Scene& scene, const Settings& settings, const World& world,
                              const std::vector<Message>& warnings) {
  LintScene s{scene, settings, world, warnings, survey(scene, settings, world)};
  s.aroundCamera = objectsAround(world, world.camera().eye);
  std::vector<LintFinding> findings;
  for (const Message& message : warnings)
    if (!isOfArea(message) && !isOfGlass(message)) findings.push_back({"reading", message});
  for (const LintCheck& check : lintChecks()) check.run(s, findings);
  return findings;
}

}  // namespace trace
