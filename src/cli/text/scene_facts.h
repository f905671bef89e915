// Facts about a scene that need no render: counts, and who chose which option.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scene/scene.h"

namespace trace::cli {

/// (keyword, how many), in the order of the type list; only what occurs.
using Counts = std::vector<std::pair<std::string_view, std::size_t>>;
Counts countShapes(const Scene& scene);
Counts countLights(const Scene& scene);
/// (name of a group, how often it is placed in the scene).
Counts countInstances(const Scene& scene);
/// Triangles of all meshes; a mesh used by several objects counts each time, one in a group once.
std::size_t countTriangles(const Scene& scene);

struct OptionFact {
  std::string name, value;
  std::string from;  ///< "default", "scene.ray:12" or "command line"; "by like" behind it if that set it
};

/// Every option of the group, with who chose it.
std::vector<OptionFact> optionsOf(std::string_view group, const Scene& scene, const Settings& settings,
                                  std::span<const Choice> commandLine);
/// Every option that differs from its default.
std::vector<OptionFact> changedOptions(const Scene& scene, const Settings& settings,
                                       std::span<const Choice> commandLine);

/// The choices of Trace where the file and the command line left it open: "Trace chose a sky and a sun,
/// exposure 0.8 stops; quality good: path, ..."; "" where it chose nothing.
std::string chosenText(const Scene& scene, const Settings& settings, Real measuredExposure);

}  // namespace trace::cli
