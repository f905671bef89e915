#include "cli/text/scene_facts.h"

#include <algorithm>

#include "base/text.h"
#include "geometry/mesh/mesh.h"
#include "scene/groups.h"
#include "scene/quality.h"

namespace trace::cli {
namespace {

/// The source of the option's value, as settingsFor() decides.
std::string chooser(const Option& option, const Scene& scene, std::span<const Choice> commandLine) {
  std::string from = chooserOf(option, {scene.choices, commandLine});
  const auto typed = [&](std::string_view name) {
    return std::any_of(commandLine.begin(), commandLine.end(),
                       [&](const Choice& choice) { return choice.option == name; });
  };
  if (option.name == "height" && from != "default" && typed("width") && !typed("height"))
    return "command line, by width";
  if (option.name == "width" && typed("height") && !typed("width")) return "command line, by height";
  return from;
}

}  // namespace

Counts countShapes(const Scene& scene) {
  Counts counts;
  for (const ShapeType& type : shapeTypes()) {
    std::size_t n = 0;
    for (const Object& object : scene.objects) n += &object.shape.type() == &type;
    if (n > 0) counts.emplace_back(type.keyword, n);
  }
  return counts;
}

Counts countLights(const Scene& scene) {
  Counts counts;
  for (const LightType& type : lightTypes()) {
    std::size_t n = 0;
    for (const LightSource& source : scene.lights) n += &source.light.type() == &type;
    if (n > 0) counts.emplace_back(type.keyword, n);
  }
  return counts;
}

Counts countInstances(const Scene& scene) {
  Counts counts;
  for (const GroupUses& uses : scene.uses) {
    const std::string& name = scene.groups[uses.group].name;
    const std::string_view shown = name.empty() ? std::string_view("group") : std::string_view(name);
    const auto same =
        std::find_if(counts.begin(), counts.end(), [&](const auto& c) { return c.first == shown; });
    if (same == counts.end())
      counts.emplace_back(shown, uses.list->size());
    else
      same->second += uses.list->size();
  }
  return counts;
}

std::size_t countTriangles(const Scene& scene) {
  std::size_t n = 0;
  for (const Object* object : allObjects(scene))
    if (const auto* mesh = object->shape.as<Mesh>()) n += mesh->data->triangles.size();
  return n;
}

std::vector<OptionFact> optionsOf(std::string_view group, const Scene& scene, const Settings& settings,
                                  std::span<const Choice> commandLine) {
  std::vector<OptionFact> facts;
  for (const Option& option : options())
    if (option.group == group)
      facts.push_back({std::string(option.name), option.get(settings), chooser(option, scene, commandLine)});
  return facts;
}

std::string chosenText(const Scene& scene, const Settings& settings, Real measuredExposure) {
  std::string chosen;
  const auto add = [&](const std::string& what) {
    chosen += (chosen.empty() ? "Trace chose " : ", ") + what;
  };
  for (const std::string& what : scene.kindDefaults) add(what);
  const Real given = std::round(100 * (settings.exposure - measuredExposure)) / 100;
  if (measuredExposure != 0)
    add("exposure " + toText(measuredExposure) + " stops" +
        (given == 0 ? ""
                    : ", with --exposure " + toText(given) + " in all " +
                          toText(std::round(100 * (given + measuredExposure)) / 100)));
  const std::string quality = qualityText(settings);
  return chosen + (chosen.empty() || quality.empty() ? "" : "; ") + quality;
}

std::vector<OptionFact> changedOptions(const Scene& scene, const Settings& settings,
                                       std::span<const Choice> commandLine) {
  std::vector<OptionFact> facts;
  for (const Choice& choice : trace::changedOptions(settings))
    facts.push_back({choice.option, choice.value, chooser(findOption(choice.option), scene, commandLine)});
  return facts;
}

}  // namespace trace::cli
