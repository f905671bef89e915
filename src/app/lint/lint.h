// Likely mistakes in a scene that can be rendered: the warnings a teacher would give.
//
// Geometry is asked by tracing our own rays, in directions and pixels that are always the same.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "render/world/world.h"
#include "scene/scene.h"
#include "scene/settings.h"

namespace trace {

struct LintFinding {
  std::string_view check;  ///< name of the row that found it
  Message message;         ///< a warning: where, what is wrong and what it does, and a cure
};

struct LintScene;

/// A row of the table. A new check is a function and a row in lint.cpp.
struct LintCheck {
  std::string_view name;
  std::string_view help;  ///< what it looks for, without full stop
  void (*run)(const LintScene& scene, std::vector<LintFinding>& findings);
};
std::span<const LintCheck> lintChecks();

/// The warnings of reading and compiling the scene, and of a render, each as the check `reading` if no
/// other check is about it, then the findings of the checks in their order. `world` was compiled from the
/// scene with the settings, whose exposure is settled (app/advice/auto_exposure.h): by `measured` stops.
std::vector<LintFinding> lint(const Scene& scene, const Settings& settings, const World& world,
                              const std::vector<Message>& warnings, std::optional<Real> measured = {});

/// The first finding on lights that do not reach what is seen, for a scene without any light there.
std::optional<Message> whyUnlit(const Scene& scene, const Settings& settings, const World& world);

}  // namespace trace
