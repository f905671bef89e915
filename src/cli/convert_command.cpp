// ray convert IN OUT: read a scene, change its camera, lights or material if asked, and write it in the
// format that the suffix of OUT names.
#include <chrono>
#include <optional>
#include <utility>

#include "app/output.h"
#include "app/remaining_time.h"
#include "base/budget.h"
#include "base/file.h"
#include "base/text.h"
#include "cli/commands.h"
#include "cli/scene_facts.h"
#include "cli/terminal.h"
#include "formats/format.h"
#include "formats/ray_format.h"
#include "formats/revolve.h"
#include "geometry/mesh.h"

namespace trace::cli {
namespace {

/// What the words of a flag say, read as a .ray file.
Scene readWords(const std::string& flag, const std::string& text, const Console& console) {
  Messages messages;
  Scene scene = readScene(flag, "SBT-raytracer 1.0\n" + text, messages);
  for (const Message& message : messages.all())
    if (message.place.line > 0) console.warnings({&message, 1});  // not that there is nothing else to see
  return scene;
}

/// Every object, and every point of a mesh, of this material.
void setMaterial(Scene& scene, const Material& material) {
  scene.materials = {material};
  for (Object& object : scene.objects) {
    object.material = 0;
    const auto* mesh = object.shape.as<Mesh>();
    if (!mesh || mesh->data->materials.empty()) continue;
    MeshData plain = *mesh->data;
    plain.materials.clear();
    object.shape = Mesh{std::make_shared<const MeshData>(std::move(plain))};
  }
}

void change(Scene& scene, const Conversion& conversion, const Console& console) {
  if (!conversion.camera.empty())
    scene.camera = readWords("--camera", "camera {\n" + conversion.camera + "}", console).camera;
  if (!conversion.lights.empty()) scene.lights.clear();
  for (const std::string& text : conversion.lights) {
    const Scene given = readWords("--light", text, console);
    if (given.lights.empty())
      throw Error(Fault::usage, "--light: expected a light, found \"" + text + "\"",
                  "as in --light 'point_light { position = (0, 5, 5); color = (1, 1, 1); }'");
    scene.lights.insert(scene.lights.end(), given.lights.begin(), given.lights.end());
  }
  if (!conversion.material.empty()) {
    const Scene given =
        readWords("--material", "sphere { material = {\n" + conversion.material + "} }", console);
    setMaterial(scene, given.materials.at(given.objects.at(0).material));
  }
}

}  // namespace

int convert(const Arguments& arguments, const Console& console) {
  const auto start = std::chrono::steady_clock::now();
  if (arguments.files.size() != 2)
    throw Error(
        Fault::usage,
        "ray convert: expected the names of two files, found " + std::to_string(arguments.files.size()),
        "ray convert IN OUT");
  const std::string &in = arguments.files[0], &out = arguments.files[1];
  const Conversion& conversion = arguments.conversion;
  const SceneFormat& format = writableFormatFor(out);
  checkDistinct(in, out);
  checkWritable(out);
  std::optional<Work> reading(std::in_place, "reading the scene");
  const std::string bytes = readFile(in);
  Messages messages;
  Scene scene = conversion.revolve ? revolvedScene(in, bytes, conversion.steps, messages)
                                   : readScene(in, bytes, messages);
  if (!conversion.revolve && changesWithTime(in, bytes)) {
    const Real time = resolve({scene.choices}).time;  // the file chooses the moment
    messages = {};
    scene = readScene(in, bytes, messages, time);
    messages.warn(Place{.file = in}, "what changes with time is written as it is at " + toText(time) + " s",
                  "settings { time = ...; } in the scene chooses another moment");
  }
  reading.reset();
  change(scene, conversion, console);
  const std::vector<NamedBytes> files =
      format.write(scene, out, {.digits = conversion.digits, .ascii = conversion.ascii}, messages);
  messages.throwIfFailed(arguments.strict);
  console.warnings(messages.all());

  std::string names;
  for (const NamedBytes& file : files) {  // all of them before any is written
    checkDistinct(in, file.file);
    checkIsNoInput(file.file, scene.inputs);
    checkWritable(file.file);
  }
  for (const NamedBytes& file : files) {
    writeFile(file.file, file.bytes);
    names += (names.empty() ? "" : " and ") + file.file;
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::string held = counted(scene.objects.size(), "object");
  if (const std::size_t triangles = countTriangles(scene)) held += ", " + counted(triangles, "triangle");
  console.last(true, "wrote " + names + " (" + held + ") in " + durationText(seconds));
  return kDone;
}

}  // namespace trace::cli
