#include "app/view/examples.h"

#include <algorithm>
#include <array>
#include <exception>
#include <filesystem>
#include <span>
#include <utility>

#include "app/session/session.h"
#include "app/view/picture_views.h"
#include "image/development/development.h"
#include "scene/integrators.h"

namespace trace {
namespace {

namespace fs = std::filesystem;

struct Row {
  const char *file, *title, *about;
};

constexpr std::array kExamples{
    Row{"shapes.ray", "Shapes", "what objects there are"},
    Row{"glass.ray", "Glass", "what the index of refraction does"},
    Row{"materials.ray", "Materials", "highlights and mirrors"},
    Row{"shadows.ray", "Shadows", "of glass and of lights with a size"},
    Row{"csg.ray", "Solids of solids", "union, intersection and difference"},
    Row{"textures.ray", "Textures", "colours that are patterns"},
    Row{"chess.ray", "Chess", "a board with its pieces"},
};
constexpr std::array kIntegratorScenes{
    Row{"mirrors.ray", "whitted", "mirrors in mirrors: a ray for each reflection, refraction and light"},
    Row{"cornell.ray", "path", "a lit room: paths that bounce, so that walls light each other"},
    Row{"uplight.ray", "bdpt",
        "bulbs that no surface sees: paths from the camera, joined with paths from lights"},
    Row{"door.ray", "mlt",
        "light through a door that stands ajar: Markov chains that found a path stay near it"},
    Row{"photons.ray", "photon",
        "glass and brass focus light: photons from the lights are stored where they land"},
};
constexpr std::array kLessons{
    Row{"lessons/black-glass.ray", "Black glass", "Why is the ball black?"},
    Row{"lessons/light-in-a-box.ray", "Light in a box", "Why does the light not light?"},
    Row{"lessons/shadow-acne.ray", "Shadow acne", "Where do the specks come from?"},
    Row{"lessons/wrong-normals.ray", "Wrong normals", "What shades the roof?"},
};

template <std::size_t kCount>
std::vector<ExampleScene> found(const std::string& folder, const std::array<Row, kCount>& rows) {
  std::vector<ExampleScene> scenes;
  if (folder.empty()) return scenes;
  for (const Row& row : rows) {
    std::error_code none;
    if (const fs::path file = fs::path(folder) / row.file; fs::exists(file, none))
      scenes.push_back({row.title, row.about, file.generic_string()});
  }
  return scenes;
}

}  // namespace

std::string examplesFolder(const std::string& program) {
  const fs::path folder = fs::path(program).parent_path();
  // Installed, the programs are in libexec/trace-ray (cmake/install.cmake).
  for (const char* place : {"../../share/doc/trace-ray/scenes", "../share/doc/trace-ray/scenes",
                            "../../../scenes", "scenes"}) {
    std::error_code none;
    if (const fs::path scenes = folder / place; fs::exists(scenes / kExamples.front().file, none))
      return scenes.lexically_normal().generic_string();
  }
  return "";
}

namespace {

/// Few samples of light from all sides, without their noise.
void takeBouncedLight(Settings& settings) {
  constexpr int kSamples = 8, kMostBounces = 6;
  settings.integrator = hasTrait(settings, Trait::splats) ? IntegratorKind::bdpt : IntegratorKind::path;
  settings.spp = kSamples;
  settings.depth = std::min(settings.depth, kMostBounces);
  settings.fireflyLimit = 1;
  settings.denoise = true;
}

}  // namespace

std::vector<ExampleScene> examplesIn(const std::string& folder) { return found(folder, kExamples); }
std::vector<ExampleScene> lessonsIn(const std::string& folder) { return found(folder, kLessons); }
std::vector<ExampleScene> integratorScenesIn(const std::string& folder) {
  return found(folder, kIntegratorScenes);
}

Bytes thumbnail(Scene scene, int width) {
  constexpr int kSamples = 4;
  Settings settings = resolve({scene.choices});
  settings.width = width;
  settings.height = 0;
  settings.region = {};
  settings.spp = kSamples;
  settings.noiseTarget = 0;
  settings.subdivide = 0;
  settings.denoise = false;
  settings.shutter = 0;
  settings.caustics = 0;
  if (hasTrait(settings, Trait::bounces) || hasTrait(settings, Trait::byChains)) takeBouncedLight(settings);
  settings.threads = 1;  // the window comes first
  Session small;
  small.open(std::move(scene), settings);
  small.build();
  small.renderPicture();
  const Picture levels = developed(small.picture(), developmentOf(small.settings()));
  return exposed(levels, 0, settings.rounding);
}

Bytes thumbnail(const std::string& file, int width) {
  try {
    Session whole;
    whole.open(file, std::span<const Choice>());
    return thumbnail(whole.scene(), width);
  } catch (const std::exception&) {
    return {};
  }
}

}  // namespace trace
