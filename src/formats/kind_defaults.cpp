#include "formats/kind_defaults.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include "formats/format.h"
#include "formats/model.h"
#include "geometry/mesh/mesh.h"
#include "geometry/mesh/mesh_smooth.h"
#include "geometry/traced.h"
#include "scene/groups.h"
#include "scene/picture_size.h"
#include "scene/quality.h"
#include "shading/lights/plain_lights.h"

namespace trace {
namespace {

constexpr Real kPlainFov = 40;

struct KindChoice {
  std::string_view option, value;
};
constexpr Quality kKindQuality = Quality::good;
/// Light is computed as nature has it, and shown as a screen and an eye expect it.
constexpr std::array kKindChoices{KindChoice{"width", "640"},
                                  KindChoice{"quality", "good"},
                                  KindChoice{"pixel-position", "center"},
                                  KindChoice{"rounding", "nearest"},
                                  KindChoice{"transfer", "srgb"},
                                  KindChoice{"tone", "filmic"},
                                  KindChoice{"auto-exposure", "on"},
                                  KindChoice{"fresnel", "exact"},
                                  KindChoice{"air-index", "1"},
                                  KindChoice{"glass-shadows", "black"},
                                  KindChoice{"mirror-default", "zero"},
                                  KindChoice{"limit-attenuation", "off"}};

bool isGiven(const Scene& scene, std::string_view option) {
  return std::any_of(scene.choices.begin(), scene.choices.end(),
                     [&](const Choice& choice) { return choice.option == option; });
}

/// The daylight sky of a friendly afternoon: colours from straight down to straight up. It is palest at the
/// horizon, where it is brighter than the ground, which reflects a quarter of the light that it gets.
Background sky() {
  Background background;
  background.gradient = {{0.34, 0.32, 0.3}, {0.42, 0.4, 0.37}, {0.5, 0.48, 0.45},  {2.1, 2.12, 2.12},
                         {1.3, 1.52, 1.85}, {0.8, 0.98, 1.35}, {0.43, 0.56, 0.84}, {0.28, 0.37, 0.58}};
  background.elevations = {-90, -25, -1, 0.5, 4, 12, 32, 65};
  return background;
}

/// Over the left shoulder of the viewer, large enough in the sky for soft shadows.
LightSource sun(const Camera& camera, Real size) {
  const CameraFrame axes = frame(camera, CameraAxes::orthonormal);
  Vec3 along = normalize(axes.look);
  along.y = 0;
  const Real flat = length(along);
  along = flat > 1e-3 ? along / flat : Vec3{0, 0, -1};
  const Vec3 right = cross(along, {0, 1, 0});
  return {directionalLight(normalize(along * 0.75 + right * 0.55 + Vec3{0, -1, 0}), {2.4, 2.25, 2}, size),
          {}};
}

/// The scene gives light by itself.
bool givesLight(const Scene& scene) {
  const Background& background = scene.background;
  return !scene.lights.empty() || !(background == Background{}) || isGiven(scene, "environment") ||
         shines(scene);
}

void addCamera(Scene& scene, const KindGiven& given, const Box3& seen) {
  Camera& camera = scene.camera;
  if (!given.aspect) {
    camera.aspectratio = kUsualAspect;
    scene.freeAspect = {kUsualAspect, given.horizontalFov    ? FreeAspect::Keeps::across
                                      : given.cameraPosition ? FreeAspect::Keeps::upward
                                                             : FreeAspect::Keeps::both};
  }
  if (given.cameraPosition && given.cameraDirection) return;
  if (!given.cameraPosition && !given.cameraDirection) {
    camera = framing(seen, kPlainFov, camera.aspectratio);
    scene.kindDefaults.emplace_back("a camera that shows all objects");
    return;
  }
  if (!given.cameraDirection) {
    const Vec3 target = seen.empty() ? Vec3{} : seen.center();
    const Vec3 view = target - camera.position;
    if (!(length(view) > 0)) return;
    camera.viewdir = normalize(view);
    const bool vertical = camera.viewdir.x == 0 && camera.viewdir.z == 0;
    camera.updir = vertical ? Vec3{0, 0, -1} : Vec3{0, 1, 0};
    scene.kindDefaults.emplace_back("a camera that looks at the middle of the objects");
    return;
  }
  Vec3 direction = camera.viewdir;
  if (given.lookAt) direction = Vec3{-0.35, -0.3, -1};  // look_at without a place to look from
  Camera framed = framing(seen, camera.fov, camera.aspectratio, direction);
  if (given.lookAt) framed.position = *given.lookAt - (seen.center() - framed.position);
  framed.updir = camera.updir;
  framed.near = camera.near;
  framed.far = camera.far;
  camera = framed;
  scene.kindDefaults.emplace_back("a camera so far away that it shows all objects");
}

/// A picture of which the file gives both sides.
void fitCamera(Scene& scene) {
  if (scene.freeAspect.chosen == 0 || !isGiven(scene, "width") || !isGiven(scene, "height")) return;
  scene.camera = cameraFor(scene, resolve({scene.choices}));
  scene.freeAspect.chosen = scene.camera.aspectratio;
}

/// Meshes without normals look round where their faces meet at less than this.
constexpr Real kCrease = 40 * kPi / 180;

void smoothMeshes(Scene& scene) {
  std::vector<std::pair<const MeshData*, Mesh>> smooth;  // several objects share them
  const auto smoothen = [&](Object& object) {
    const auto* mesh = object.shape.as<Mesh>();
    if (!mesh) return;
    const MeshData& data = *mesh->data;
    if (!data.normals.empty() || data.generateNormals || data.triangles.empty()) return;
    auto found = std::find_if(smooth.begin(), smooth.end(), [&](const auto& s) { return s.first == &data; });
    if (found == smooth.end()) {
      smooth.emplace_back(&data, Mesh{std::make_shared<const MeshData>(withCreaseNormals(data, kCrease))});
      found = std::prev(smooth.end());
    }
    object.shape = found->second;
  };
  for (Object& object : scene.objects) smoothen(object);
  for (Group& group : scene.groups)
    for (Object& object : group.objects) smoothen(object);
}

/// A light that fades: its colour is what falls on a white surface at the distance that what is looked at has
/// from `origins`, these lights as the scene begins.
void letLightsReach(Scene& scene, const KindGiven& given, const Vec3& target,
                    std::span<const LightSource> origins) {
  if (given.fading.empty()) return;
  for (const std::size_t number : given.fading) {
    Light& light = scene.lights[number].light;
    if (light.type().starts != LightOrigin::ball) continue;
    const Light& origin =
        number < origins.size() && origins[number].light.position() ? origins[number].light : light;
    const Vec3 way = *origin.position() - target;
    const Real square = dot(way, way);
    Color& color = *editableValue<Color>(light, "color");
    if (square > 0 && std::isfinite(square)) color = color * square;
  }
  scene.kindDefaults.emplace_back("the strength of the lights");
}

/// The light around a mesh that is rendered by itself: grey, lighter from above.
Background studioBackground() {
  Background background;
  background.gradient = {Color(0.15), Color(0.3), Color(0.6), Color(0.8)};
  background.elevations = {-90, -10, 20, 90};
  return background;
}

/// The choices of options, below those that the scene has.
void addKindChoices(Scene& scene, const SourcePlace& place) {
  std::vector<Choice> choices;
  const bool like = isGiven(scene, "like");
  for (const KindChoice& choice : kKindChoices) {
    if (isGiven(scene, choice.option)) continue;
    if (choice.option == "width" && isGiven(scene, "height")) continue;
    if (like && isConvention(findOption(choice.option))) continue;
    choices.push_back({std::string(choice.option), std::string(choice.value), place});
  }
  scene.choices.insert(scene.choices.end(), choices.begin(), choices.end());
}

/// The light of a mesh that has none of its own.
LightSource keyLight(const Camera& camera) {
  constexpr Real kSize = 12;
  LightSource light = sun(camera, kSize);
  *editableValue<Color>(light.light, "color") = Color(1.6);
  return light;
}

bool isBareMesh(const Scene& scene) {
  const std::span<const SceneFormat> formats = sceneFormats();
  return std::any_of(formats.begin(), formats.end(), [&](const SceneFormat& format) {
    return format.name == scene.format && (format.readModel || format.readModelAt);
  });
}

}  // namespace

void completeBareMesh(Scene& scene) {
  if (!isBareMesh(scene)) return;
  const bool hasLights = !isPlainView(scene);
  const Box3 box = bounds(scene);
  if (scene.camera == framing(box)) {
    scene.camera = framing(box, kPlainFov, kUsualAspect);
    scene.freeAspect = {kUsualAspect, FreeAspect::Keeps::both};
    scene.kindDefaults.emplace_back("a camera that shows all objects");
  }
  if (!hasLights) {
    scene.lights.clear();
    const bool glows = givesLight(scene);
    scene.lights = {keyLight(scene.camera)};
    if (!glows) scene.background = studioBackground();
    scene.kindDefaults.emplace_back(glows ? "a light" : "a light and a grey room around");
  }
  smoothMeshes(scene);
  addKindChoices(scene, SourcePlace{.file = scene.file});
}

bool shines(const Scene& scene) {
  return std::any_of(scene.objects.begin(), scene.objects.end(), [&](const Object& object) {
    const Material& material = scene.materials[object.material];
    return glows(material) || !isBlack(material.mediumGlows);
  });
}

Box3 boundsOfInterest(const Scene& scene) {
  constexpr Real kFlat = 0.02, kMuchLarger = 4;
  constexpr std::size_t kMostFramed = 4000;  // copies of objects in groups
  std::vector<Box3> boxes;
  const Scene shown = scene.uses.empty() ? Scene() : firstCopies(scene, kMostFramed);
  for (const Object& object : scene.uses.empty() ? scene.objects : shown.objects) {
    const Box3 box = object.worldFromObject * prepare(object.shape).bounds();
    if (!box.empty() && isFinite(box.size())) boxes.push_back(box);
  }
  const auto across = [](const Box3& box) { return length(box.size()); };
  const auto largest = std::max_element(boxes.begin(), boxes.end(),
                                        [&](const Box3& a, const Box3& b) { return across(a) < across(b); });
  Box3 all, others;
  for (const Box3& box : boxes) {
    all.extend(box);
    if (&box != &*largest) others.extend(box);
  }
  if (boxes.size() < 2) return all;
  const Vec3 size = largest->size();
  const bool flat = std::min({size.x, size.y, size.z}) <= kFlat * std::max({size.x, size.y, size.z});
  return flat && across(*largest) > kMuchLarger * across(others) ? others : all;
}

std::string_view kindDefaultOf(std::string_view option) {
  std::string_view value;
  for (const Choice& choice : choicesOf(kKindQuality))
    if (choice.option == option) value = choice.value;
  for (const KindChoice& choice : kKindChoices)
    if (choice.option == option) value = choice.value;
  return value == findOption(option).get(Settings{}) ? std::string_view() : value;
}

bool kindDefaultsFollow(const Scene& scene, const KindGiven& given) {
  return !(given.cameraPosition && given.cameraDirection) || !given.fading.empty() || !givesLight(scene);
}

void addKindDefaults(Scene& scene, const KindGiven& given, const SourcePlace& place, const KindStart* start) {
  const std::optional<Vec3>& lookAt = start ? start->given.lookAt : given.lookAt;
  // Bounds of fur, terrain and fractals take as long as preparing these.
  const bool asksBounds =
      !(given.cameraPosition && given.cameraDirection) || (!given.fading.empty() && !lookAt);
  const Box3 seen = start ? start->seen : asksBounds ? boundsOfInterest(scene) : Box3{};
  addCamera(scene, given, seen);
  fitCamera(scene);
  smoothMeshes(scene);
  const Vec3 target = lookAt ? *lookAt : seen.empty() ? Vec3{} : seen.center();
  letLightsReach(scene, given, target, start ? start->scene.lights : scene.lights);
  if (!givesLight(scene)) {
    constexpr Real kSunSize = 3;
    Scene view;
    view.camera = start ? start->scene.camera : scene.camera;
    if (start) addCamera(view, start->given, seen);
    scene.background = sky();
    scene.lights = {sun(view.camera, kSunSize)};
    scene.kindDefaults.emplace_back("a sky and a sun");
  }
  addKindChoices(scene, place);
}

}  // namespace trace
