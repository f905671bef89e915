#include "app/editing/read_back.h"

#include <utility>

#include "base/files/read_scope.h"
#include "formats/ray/write/same.h"
#include "geometry/shapes/solids/csg_tree.h"
#include "geometry/shapes/surfaces/height_field.h"
#include "shading/lights/goniometric_light.h"

namespace trace {
namespace {

using rayfile::sameObject;
using rayfile::sameSettings;

/// Files are named as they are seen from the folder of the scene, which may be another.
void forgetNames(Shape& shape) {
  if (shape.type().ofObjects) {
    std::vector<Operand> parts = shape.operands().list();
    for (Operand& part : parts) {
      part.name.clear();
      forgetNames(part.shape);
    }
    shape.setOperands(Operands(std::move(parts)));
  }
  if (const auto* field = shape.as<HeightField>(); field && field->file.grid)
    shape.edit<HeightField>()->file.file.clear();
}

Scene withoutNames(Scene scene) {
  for (Object& object : scene.objects) {
    object.name.clear();
    forgetNames(object.shape);
  }
  for (Material& material : scene.materials) material.name.clear();
  changePixels(scene, [](Pixels& pixels) { pixels.file.clear(); });
  for (LightSource& source : scene.lights)
    if (auto* light = source.light.edit<GoniometricLight>()) light->file.file.clear();
  return scene;
}

/// The first of `wanted` that has no fellow in `found`, or wanted.size(). Quick if both have one order.
template <class Thing, class Same>
std::size_t firstMissing(const std::vector<Thing>& wanted, const std::vector<Thing>& found, Same&& same) {
  std::vector<bool> taken(found.size(), false);
  std::size_t next = 0;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    std::size_t tried = 0;
    while (tried < found.size() && (taken[next] || !same(wanted[i], found[next]))) {
      next = (next + 1) % found.size();
      ++tried;
    }
    if (tried == found.size()) return i;
    taken[next] = true;
    next = (next + 1) % found.size();
  }
  return wanted.size();
}

/// The part of the scene that would be lost; "" for nothing.
std::string lost(const Scene& named, const Scene& back) {
  const Scene wanted = withoutNames(named), found = withoutNames(back);
  const std::size_t object =
      firstMissing(wanted.objects, found.objects,
                   [&](const Object& a, const Object& b) { return sameObject(wanted, a, found, b); });
  if (object < wanted.objects.size()) {
    const std::string& name = named.objects[object].name;
    const std::string which = "object " + std::to_string(object + 1);
    return name.empty() ? which : which + ", \"" + name + "\",";
  }
  const std::size_t light = firstMissing(
      wanted.lights, found.lights,
      [](const LightSource& a, const LightSource& b) { return a.light == b.light && a.links == b.links; });
  if (light < wanted.lights.size()) return "light " + std::to_string(light + 1);
  if (found.objects.size() != wanted.objects.size()) return "the list of objects";
  if (found.lights.size() != wanted.lights.size()) return "the list of lights";
  if (found.camera != wanted.camera) return "the camera";
  if (found.background != wanted.background) return "the background";
  return sameSettings(found, wanted) ? "" : "an option";
}

[[noreturn]] void refuse(Fault fault, const std::string& file, const std::string& why) {
  throw Error(fault, SourcePlace{.file = file}, "not saved: " + why,
              "undo, or correct the edit, and save again");
}

}  // namespace

Scene readBack(const std::vector<NamedBytes>& files, const Scene& wanted, Real time) {
  const NamedBytes& first = files.front();
  Messages messages;
  Scene back;
  std::vector<std::string> allowed;  // what the scene was made of, though its file may now lie elsewhere
  for (const InputFile& input : wanted.inputs.all()) allowed.push_back(input.path);
  const ReadScope scope(allowed);
  try {
    back = readScene(first.file, first.bytes, messages, time);
    messages.throwIfFailed();
  } catch (const Error& error) {
    std::string why;
    for (const Message& message : error.messages())
      if (why.empty() && message.severity == Message::Severity::error) why = message.what;
    refuse(error.fault(), first.file, "the scene could not be read again: " + why);
  }
  const std::string what = lost(wanted, back);
  if (what.empty()) return back;
  std::string why = what + " would be lost, or another, when the scene is read again";
  for (const Message& message : messages.all())
    if (back.objects.size() < wanted.objects.size() && message.what.find("left out") != std::string::npos) {
      why += ": " + message.what;
      break;
    }
  refuse(Fault::scene, first.file, why);
}

}  // namespace trace
