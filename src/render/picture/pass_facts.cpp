#include "render/picture/pass_facts.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <set>
#include <string_view>

#include "render/rays/ray_tree.h"
#include "shading/lights/plain_lights.h"

namespace trace {
namespace {

constexpr std::array<std::string_view, 3> kAlways{"ambient", "background", "other"};
/// Lights and objects without a name have a group each, unless they are more.
constexpr std::size_t kMostUnnamed = 24;
constexpr std::string_view kUnnamedLights = "lights", kUnnamedObjects = "emission";

/// The name as a layer of a picture file can have it.
std::string layerName(std::string_view name) {
  std::string text;
  for (const char c : name)
    text += std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_' ? c : '_';
  return text.empty() ? "_" : text;
}

std::vector<std::size_t> unnamedLights(const Scene& scene) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < scene.lights.size(); ++i)
    if (scene.lights[i].links.name.empty() && !isAmbient(scene.lights[i].light)) found.push_back(i);
  return found;
}

bool isEmissive(const Scene& scene, const Object& object) {
  return object.material < scene.materials.size() && glows(scene.materials[object.material]);
}

std::vector<std::size_t> unnamedEmitters(const Scene& scene) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
    if (scene.objects[i].name.empty() && isEmissive(scene, scene.objects[i])) found.push_back(i);
  return found;
}

/// The names of the lights' groups and of the objects' groups; "" for ambient lights, which all have one of
/// their own, and for objects that give no light.
struct GroupNames {
  std::vector<std::string> lights, objects;
};
GroupNames groupNames(const Scene& scene) {
  GroupNames names;
  const bool manyLights = unnamedLights(scene).size() > kMostUnnamed;
  const bool manyObjects = unnamedEmitters(scene).size() > kMostUnnamed;
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const std::string& name = scene.lights[i].links.name;
    const bool ambient = isAmbient(scene.lights[i].light);
    names.lights.push_back(ambient         ? ""
                           : !name.empty() ? name
                           : manyLights    ? std::string(kUnnamedLights)
                                           : "light" + std::to_string(i + 1));
  }
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const Object& object = scene.objects[i];
    names.objects.push_back(!isEmissive(scene, object) ? ""
                            : !object.name.empty()     ? object.name
                            : manyObjects              ? std::string(kUnnamedObjects)
                                                       : "object" + std::to_string(i + 1));
  }
  return names;
}

/// The layers' names of groups, by the groups' own: those that are there always keep theirs.
std::map<std::string, std::string> layersOfGroups(const Scene& scene) {
  std::set<std::string> taken(kAlways.begin(), kAlways.end());
  std::map<std::string, std::string> layers;
  const auto add = [&](const std::string& name) {
    if (name.empty() || layers.contains(name)) return;
    const std::string plain = layerName(name);
    std::string layer = plain;
    for (int number = 2; !taken.insert(layer).second; ++number) layer = plain + "_" + std::to_string(number);
    layers[name] = layer;
  };
  const GroupNames names = groupNames(scene);
  for (const std::string& name : names.lights) add(name);
  for (const std::string& name : names.objects) add(name);
  return layers;
}

std::uint32_t placeOf(const std::vector<std::string>& names, std::string_view name, std::uint32_t otherwise) {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? otherwise : static_cast<std::uint32_t>(found - names.begin());
}

void addOnce(std::vector<std::string>& names, std::set<std::string>& known, const std::string& name) {
  if (known.insert(name).second) names.push_back(name);
}

}  // namespace

PassNames passNames(const Scene& scene) {
  PassNames names;
  const auto layers = layersOfGroups(scene);
  const GroupNames groups = groupNames(scene);
  std::set<std::string> known{""}, objects, materials;
  const auto addGroup = [&](const std::string& name) {
    if (known.insert(name).second) names.groups.push_back(layers.at(name));
  };
  for (const std::string& name : groups.lights) addGroup(name);
  for (const std::string& name : groups.objects) addGroup(name);
  names.groups.insert(names.groups.end(), kAlways.begin(), kAlways.end());
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
    addOnce(names.objects, objects, objectName(scene, static_cast<std::uint32_t>(i)));
  for (std::size_t i = 0; i < scene.materials.size(); ++i)
    addOnce(names.materials, materials, nameOf(scene.materials[i], i));
  return names;
}

PassFacts passFacts(const Scene& scene, const PassNames& names) {
  PassFacts facts;
  facts.ambient = placeOf(names.groups, "ambient", 0);
  facts.background = placeOf(names.groups, "background", 0);
  facts.other = placeOf(names.groups, "other", 0);
  const auto layers = layersOfGroups(scene);
  const GroupNames groups = groupNames(scene);
  const auto groupOf = [&](const std::string& name) {
    return name.empty() ? facts.other : placeOf(names.groups, layers.at(name), facts.other);
  };
  for (const std::string& name : groups.lights) facts.lightGroups.push_back(groupOf(name));
  for (const std::string& name : groups.objects) facts.objectGroups.push_back(groupOf(name));
  std::map<std::string_view, std::uint32_t> objects, materials;
  for (std::size_t i = 0; i < names.objects.size(); ++i)
    objects[names.objects[i]] = static_cast<std::uint32_t>(i + 1);
  for (std::size_t i = 0; i < names.materials.size(); ++i)
    materials[names.materials[i]] = static_cast<std::uint32_t>(i + 1);
  const auto numberOf = [](const auto& numbers, const std::string& name) {
    const auto found = numbers.find(name);
    return found == numbers.end() ? 0 : found->second;
  };
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
    facts.objects.push_back(numberOf(objects, objectName(scene, static_cast<std::uint32_t>(i))));
  for (std::size_t i = 0; i < scene.materials.size(); ++i)
    facts.materials.push_back(numberOf(materials, nameOf(scene.materials[i], i)));
  return facts;
}

Motion motionBetween(const Scene& now, const Scene& later, const CameraFrame& camera) {
  Motion motion{camera, {}};
  for (std::size_t i = 0; i < now.objects.size(); ++i) {
    const bool isThere = i < later.objects.size() && later.objects[i].name == now.objects[i].name;
    std::optional<Affine>& moved = motion.objects.emplace_back();
    if (isThere) moved = later.objects[i].worldFromObject * inverse(now.objects[i].worldFromObject);
  }
  return motion;
}

}  // namespace trace
