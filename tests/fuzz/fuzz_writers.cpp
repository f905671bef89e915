// Fuzz target: any bytes as a scene, with hostile names, through every writer of the table. What is written
// is read again, and holds what the same scene with plain names holds.
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "base/budget.h"
#include "formats/format.h"

namespace {

/// How many objects and triangles are in what the format makes of the scene; none if it cannot hold it.
std::pair<std::size_t, std::size_t> heldBy(const trace::SceneFormat& format, const trace::Scene& scene) {
  const std::string file = "out" + std::string(format.suffixes[0]);
  trace::Messages messages;
  std::string bytes;
  try {
    bytes = format.write(scene, file, {}, messages).at(0).bytes;
  } catch (const trace::Error&) {
    return {};
  }
  std::pair<std::size_t, std::size_t> held;
  try {
    const trace::Scene back = trace::readScene(file, bytes, messages);
    held.first = back.objects.size();
    for (const trace::Object& object : back.objects)
      if (const auto* mesh = object.shape.as<trace::Mesh>()) held.second += mesh->data->triangles.size();
  } catch (const trace::Error&) {
    // Numbers beyond those of floats become infinite, and such a file is refused.
  }
  return held;
}

trace::Scene named(trace::Scene scene, const std::string& name) {
  for (trace::Object& object : scene.objects) object.name = name;
  for (trace::Material& material : scene.materials) material.name = name;
  return scene;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const std::string name(bytes.substr(0, bytes.size() % 24));
  trace::Messages messages;
  trace::Scene scene;
  try {
    scene = trace::readScene("fuzz.ray", bytes, messages);
  } catch (const trace::Error&) {
    return 0;
  }
  if (scene.objects.size() > 50) return 0;
  const trace::Scene plain = named(scene, "plain"), hostile = named(scene, name);
  trace::Budget budget;  // solids of solids may take long to become triangles
  budget.limitTime(3);
  const trace::BudgetScope scope(&budget);
  for (const trace::SceneFormat& format : trace::sceneFormats()) {
    if (!format.write) continue;
    const auto held = heldBy(format, plain), same = heldBy(format, hostile);
    if (budget.timeIsOver()) return 0;
    if (held != same) __builtin_trap();
  }
  return 0;
}
