// What the checks of lint are made of, for the files that hold them. The table is in lint.cpp.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/lint.h"
#include "app/lint_rays.h"
#include "formats/ray/ray_remarks.h"

namespace trace {

/// What the checks look at.
struct LintScene {
  const Scene& scene;
  const Settings& settings;
  const World& world;
  const std::vector<Message>& warnings;
  Survey survey;
  std::vector<std::uint32_t> aroundCamera{};  ///< the objects that enclose it
  RayRemarks remarks{};                       ///< on the text of the file
};

namespace lint_checks {

using Findings = std::vector<LintFinding>;

void warn(Findings& findings, std::string_view check, const Place& place, std::string what, std::string hint);

/// "ball" in quotation marks, or "the sphere (scene.ray:12)".
std::string quoted(const LintScene& s, std::uint32_t object);
/// "12 %"; never less than 1.
std::string percent(double share);
const Place& placeOf(const LintScene& s, std::uint32_t object);
Phong materialOf(const LintScene& s, std::uint32_t object);
bool isAroundCamera(const LintScene& s, std::uint32_t object);

// The checks of lights and camera (lint_lights.cpp).
void lightInside(const LintScene& s, Findings& findings);
void lightBehindGlass(const LintScene& s, Findings& findings);
void lightTooWeak(const LintScene& s, Findings& findings);
void lightBlocked(const LintScene& s, Findings& findings);
void lightCut(const LintScene& s, Findings& findings);
void lightLink(const LintScene& s, Findings& findings);
void unlit(const LintScene& s, Findings& findings);
void causticsMissing(const LintScene& s, Findings& findings);
void cameraInside(const LintScene& s, Findings& findings);
void cameraLooksAway(const LintScene& s, Findings& findings);
void blackReflection(const LintScene& s, Findings& findings);

/// Checks glass inside glass (lint_glass.cpp).
void glassInGlass(const LintScene& s, Findings& findings);

// Of media and bodies in which light spreads (lint_media.cpp).
void mediumUnseen(const LintScene& s, Findings& findings);
void mediumEmpty(const LintScene& s, Findings& findings);
void subsurfaceOpen(const LintScene& s, Findings& findings);

}  // namespace lint_checks
}  // namespace trace
