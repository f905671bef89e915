#include "scene/quality.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/text.h"
#include "geometry/shapes/solids/csg_tree.h"
#include "geometry/traced.h"
#include "math/box.h"
#include "scene/groups.h"
#include "scene/integrators.h"
#include "scene/picture_size.h"

namespace trace {
namespace {

struct QualityRow {
  std::string_view name;
  std::string_view spp, noiseTarget, depth, fireflyLimit;
  bool denoise;
};
/// In the order of the enum. A level of 255 is a noise target of 0.004.
constexpr std::array<QualityRow, 4> kQualities{{
    {"none", "", "", "", "", false},
    {"draft", "16", "0", "5", "8", true},
    {"good", "64", "0.012", "8", "8", true},
    {"final", "1024", "0.002", "16", "0", false},
}};

std::vector<Choice> choicesOfRow(const QualityRow& row) {
  if (row.spp.empty()) return {};
  const auto choice = [](std::string_view option, std::string_view value) {
    return Choice{std::string(option), std::string(value), {}};
  };
  return {choice("spp", row.spp),
          choice("noise-target", row.noiseTarget),
          choice("denoise", row.denoise ? "on" : "off"),
          choice("depth", row.depth),
          choice("firefly-limit", row.fireflyLimit),
          choice("sampling", "sobol"),
          choice("integrator", "path")};
}

/// It is a lamp, which is too small for paths to hit at random, or rays do not see it.
bool isMissedByPaths(const Light& light) {
  if (light.type().starts == LightOrigin::ball) return true;
  if (light.type().seen) return !(light.visible() && light.hasSize());
  return light.position() || light.direction();
}

/// Light is bent in a body of it.
bool bendsLight(const Material& material) {
  constexpr Real kMuch = 0.3, kBends = 0.01;
  const Phong phong = phongOf(material.model);
  return maxComponent(phong.transmissive) >= kMuch && std::abs(phong.index - 1) > kBends;
}

bool isBent(const Scene& scene, const Shape& shape, std::uint32_t material) {
  if (bendsLight(scene.materials[material])) return true;
  const auto& parts = shape.operands().list();
  return std::any_of(parts.begin(), parts.end(),
                     [&](const Operand& part) { return isBent(scene, part.shape, part.material); });
}

Box3 boxAround(const Object& object) { return object.worldFromObject * prepare(object.shape).bounds(); }

/// An emissive object that is so small seen from the glass that few random paths hit it through that.
bool isMissedThrough(const Object& glass, const Object& emitter) {
  constexpr Real kSmall = 0.1;  // radius over distance
  const Box3 from = boxAround(glass), to = boxAround(emitter);
  if (!isFinite(from.size()) || !isFinite(to.size())) return false;
  return maxComponent(to.size()) / 2 < kSmall * length(to.center() - from.center());
}

/// Somebody gives the option, in the layer that gives the quality or a later one.
bool isChosen(std::string_view option, std::initializer_list<std::span<const Choice>> layers) {
  bool chosen = false;
  for (const std::span<const Choice> layer : layers) {
    const auto names = [&](std::string_view name) {
      return std::any_of(layer.begin(), layer.end(), [&](const Choice& c) { return c.option == name; });
    };
    chosen = names(option) || (chosen && !names("quality"));
  }
  return chosen;
}

/// A ray hits nothing.
bool isEmpty(const Scene& scene) {
  return scene.objects.empty() && scene.uses.empty() &&
         std::none_of(scene.lights.begin(), scene.lights.end(),
                      [](const LightSource& source) { return source.light.visible(); });
}

/// Drops the options of a quality that nobody asked for and that would change nothing.
void dropIdle(Settings& settings, std::initializer_list<std::span<const Choice>> layers) {
  constexpr int kFewest = 8;  // samples of a pixel, of which denoising compares two halves
  const Settings usual;
  const bool chains = hasTrait(settings, Trait::byChains);
  const auto isFree = [&](std::string_view option) { return !isChosen(option, layers); };
  // How exact a picture by chains is is not known, so that it cannot be denoised.
  if ((chains || settings.spp < kFewest) && isFree("denoise")) settings.denoise = usual.denoise;
  if ((chains || settings.spp == 1) && isFree("noise-target")) settings.noiseTarget = usual.noiseTarget;
  const bool limits = findOption("firefly-limit").concerns(settings) && !changesPaths(settings);
  if (!limits && isFree("firefly-limit")) settings.fireflyLimit = usual.fireflyLimit;
}

}  // namespace

std::span<const Choice> choicesOf(Quality quality) {
  static const std::array<std::vector<Choice>, kQualities.size()> kAll = [] {
    std::array<std::vector<Choice>, kQualities.size()> all;
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = choicesOfRow(kQualities[i]);
    return all;
  }();
  return kAll[static_cast<std::size_t>(quality)];
}

std::span<const Choice> quickChoices() {
  static const std::array<Choice, 8> kChoices{{{"width", "100", {}},
                                               {"height", "0", {}},
                                               {"region", "0,0,0,0", {}},
                                               {"depth", "2", {}},
                                               {"spp", "1", {}},
                                               {"subdivide", "0", {}},
                                               {"photon-share", "0.05", {}},
                                               {"denoise", "off", {}}}};
  return kChoices;
}

bool setsOption(std::string_view quality, std::string_view option) {
  for (std::size_t i = 0; i < kQualities.size(); ++i) {
    if (kQualities[i].name != quality) continue;
    const std::span<const Choice> own = choicesOf(static_cast<Quality>(i));
    return std::any_of(own.begin(), own.end(), [&](const Choice& c) { return c.option == option; });
  }
  return false;
}

IntegratorKind integratorFor(const Scene& scene, const Settings& settings) {
  if (settings.quality != Quality::final) return IntegratorKind::path;
  const bool lamps = std::any_of(scene.lights.begin(), scene.lights.end(),
                                 [](const LightSource& source) { return isMissedByPaths(source.light); });
  std::vector<const Object*> glass = allObjects(scene);
  std::erase_if(glass, [&](const Object* object) { return !isBent(scene, object->shape, object->material); });
  const bool missesEmitter =
      std::any_of(scene.objects.begin(), scene.objects.end(), [&](const Object& emitter) {
        return glows(scene.materials[emitter.material]) &&
               std::any_of(glass.begin(), glass.end(),
                           [&](const Object* g) { return isMissedThrough(*g, emitter); });
      });
  return (lamps && !glass.empty()) || missesEmitter ? IntegratorKind::bdpt : IntegratorKind::path;
}

Settings settingsFor(const Scene& scene, std::initializer_list<std::span<const Choice>> layers) {
  Settings settings = settingsFor(scene.camera, layers);
  if (settings.quality == Quality::none) return settings;
  if (!isChosen("integrator", layers)) settings.integrator = integratorFor(scene, settings);
  if (isEmpty(scene) && !isChosen("spp", layers)) settings.spp = 1;  // every sample shows the same
  dropIdle(settings, layers);
  return settings;
}

std::string qualityText(const Settings& settings) {
  if (settings.quality == Quality::none) return "";
  const auto value = [&](std::string_view option) { return findOption(option).get(settings); };
  std::string text = "quality " + value("quality") + ": " + value("integrator");
  text += settings.noiseTarget > 0 ? ", up to " : ", ";
  text += counted(static_cast<std::uint64_t>(settings.spp), "sample") + " a pixel";
  if (settings.noiseTarget > 0)
    text += ", until its error is below " + toText(std::round(settings.noiseTarget * 2550) / 10) + " levels";
  return text + (settings.denoise ? ", denoised" : "");
}

}  // namespace trace
