// The parts that the checks of lint share. The table is in lint.cpp.
#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/lint/lint.h"
#include "app/lint/rays.h"
#include "app/lint/survey.h"
#include "formats/ray/syntax/remarks.h"
#include "math/box.h"

namespace trace {

/// The data that the checks look at.
struct LintScene {
  const Scene& scene;
  const Settings& settings;
  const World& world;
  const std::vector<Message>& warnings;
  Survey survey;
  std::vector<std::uint32_t> aroundCamera{};  ///< the objects that enclose it
  RayRemarks remarks{};                       ///< on the text of the file
  std::optional<Real> measured{};             ///< stops that automatic exposure added
};

namespace lint_checks {

using Findings = std::vector<LintFinding>;

void warn(Findings& findings, std::string_view check, const SourcePlace& place, std::string what,
          std::string hint);

/// "ball" in quotation marks, or "the sphere (scene.ray:12)".
std::string quoted(const LintScene& s, std::uint32_t object);
/// "12 %"; never less than 1.
std::string percent(double share);
const SourcePlace& placeOf(const LintScene& s, std::uint32_t object);
Phong materialOf(const LintScene& s, std::uint32_t object);
bool isAroundCamera(const LintScene& s, std::uint32_t object);
/// The opaque objects that shut in a light that stands somewhere.
std::vector<std::uint32_t> opaqueAround(const LintScene& s, const Light& light);
/// A box around the object in the world.
Box3 boxAround(const Object& object);
/// To three digits, for people.
Real roundedTo(Real value);
/// The object that is most often in the way; the end if none is.
inline std::map<std::uint32_t, int>::const_iterator mostOf(const std::map<std::uint32_t, int>& blockers) {
  return std::max_element(blockers.begin(), blockers.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; });
}

/// Warnings of reading that checks of their own take over.
bool isOfArea(const Message& message);
bool isOfGlass(const Message& message);

// Meshes (meshes.cpp).
void insideOut(const LintScene& s, Findings& findings);
void turnedFaces(const LintScene& s, Findings& findings);
void normalsAgainstFaces(const LintScene& s, Findings& findings);
void zeroArea(const LintScene& s, Findings& findings);
void coplanarFaces(const LintScene& s, Findings& findings);
// Materials (materials.cpp).
void unusedMaterial(const LintScene& s, Findings& findings);
void inheritedGlass(const LintScene& s, Findings& findings);
void indexBelowOne(const LintScene& s, Findings& findings);
void depthTooLow(const LintScene& s, Findings& findings);
void brickJoint(const LintScene& s, Findings& findings);
void noMaterial(const LintScene& s, Findings& findings);

// Lights (lights.cpp).
void lightInside(const LintScene& s, Findings& findings);
void lightBehindGlass(const LintScene& s, Findings& findings);
void lightTooWeak(const LintScene& s, Findings& findings);
void lightBlocked(const LintScene& s, Findings& findings);
void lightCut(const LintScene& s, Findings& findings);
void lightFacesAway(const LintScene& s, Findings& findings);
void lightLink(const LintScene& s, Findings& findings);
// Light that is not there (unlit.cpp).
void unlit(const LintScene& s, Findings& findings);
void causticsMissing(const LintScene& s, Findings& findings);
void blackPicture(const LintScene& s, Findings& findings);
// The camera (camera.cpp).
void cameraInside(const LintScene& s, Findings& findings);
void cameraLooksAway(const LintScene& s, Findings& findings);
void blackReflection(const LintScene& s, Findings& findings);

/// Checks lights of which nothing arrives (light_reach.cpp).
void lightReachesNothing(const LintScene& s, Findings& findings);
/// Checks portals (portals.cpp).
void portalUseless(const LintScene& s, Findings& findings);
/// Checks glass inside glass (glass.cpp).
void glassInGlass(const LintScene& s, Findings& findings);

// Media, and bodies in which light spreads (media.cpp).
void mediumUnseen(const LintScene& s, Findings& findings);
void mediumEmpty(const LintScene& s, Findings& findings);
void subsurfaceOpen(const LintScene& s, Findings& findings);

}  // namespace lint_checks
}  // namespace trace
