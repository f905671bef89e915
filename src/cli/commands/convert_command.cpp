// ray convert IN [OUT]: read a scene, change its camera, lights or material if asked, and write it in the
// format that the suffix of OUT names.
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <new>
#include <set>
#include <stdexcept>

#include "app/session/output.h"
#include "app/session/remaining_time.h"
#include "app/session/session.h"
#include "base/budget.h"
#include "base/files/file.h"
#include "base/files/read_scope.h"
#include "base/os/memory.h"
#include "base/text.h"
#include "cli/commands/commands.h"
#include "cli/terminal/watch.h"
#include "cli/text/scene_facts.h"
#include "formats/format.h"
#include "formats/known_fields.h"
#include "formats/mesh/revolve.h"
#include "formats/ray/file/format.h"
#include "formats/words.h"
#include "geometry/mesh/mesh.h"
#include "scene/groups.h"

namespace trace::cli {
namespace {

/// "y.obj and y.mtl", "car.ray, car-wheel.png, car-roof.jpg and 7 more".
std::string namesText(const std::vector<NamedBytes>& files) {
  constexpr std::size_t kMost = 8;
  const std::size_t named = files.size() <= kMost + 1 ? files.size() : kMost;
  std::string names;
  for (std::size_t i = 0; i < named; ++i)
    names += (i == 0 ? "" : i + 1 == files.size() ? " and " : ", ") + files[i].file;
  return names + (named < files.size() ? " and " + std::to_string(files.size() - named) + " more" : "");
}

/// "2 objects, 12 triangles" of what was written.
std::string contentsText(const NamedBytes& written, const Scene& scene) {
  const auto [objects, triangles] =
      written.holds.value_or(NamedBytes::Contents{scene.objects.size(), countTriangles(scene)});
  return counted(objects, "object") + (triangles > 0 ? ", " + counted(triangles, "triangle") : "");
}

/// The remark on files that have the usual name of one that was written, and belong to something else.
std::string sparedText(const std::vector<NamedBytes>& files) {
  std::string text;
  for (const NamedBytes& file : files)
    if (!file.spared.empty())
      text += "; " + keptText(file.spared) + ", for " + files.front().file + " did not name it";
  return text;
}

/// Which flag lets a scene read what the written files name outside of their folder (docs/security.md): of
/// what the scene is made of, that of which the name, as seen from there, stands in one of them.
std::string outsideText(const std::vector<NamedBytes>& files, const InputFiles& inputs) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  const fs::path folder = fs::absolute(files.front().file, ignored).parent_path().lexically_normal();
  const ReadScope nothingAllowed(std::make_shared<const ReadRules>());
  const ReadScope rules = ReadScope::ofScene(files.front().file);
  std::set<std::string> folders;
  for (const InputFile& input : inputs.all()) {
    if (mayRead(input.path)) continue;
    const fs::path path = fs::absolute(input.path, ignored).lexically_normal();
    const std::string there = nameFrom(folder.string(), path.string());
    const auto isNamed = [&](const NamedBytes& file) {
      return file.bytes.find(there) != std::string::npos ||
             file.bytes.find(path.generic_string()) != std::string::npos;
    };
    if (!std::any_of(files.begin(), files.end(), isNamed)) continue;
    const std::string parent = fs::path(input.path).lexically_normal().parent_path().generic_string();
    folders.insert(parent.empty() ? "." : parent);
  }
  std::string flags;
  for (const std::string& parent : folders) flags += " --allow-read " + shellWord(parent);
  return flags.empty() ? "" : "; it names files outside its folder, which" + flags + " lets it read";
}

/// The scene that the words of a flag give, read as a .ray file.
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
  const auto set = [](Object& object) {
    object.material = 0;
    const auto* mesh = object.shape.as<Mesh>();
    if (!mesh || mesh->data->materials.empty()) return;
    MeshData plain = *mesh->data;
    plain.materials.clear();
    object.shape = Mesh{std::make_shared<const MeshData>(std::move(plain))};
  };
  for (Object& object : scene.objects) set(object);
  for (Group& group : scene.groups)
    for (Object& object : group.objects) set(object);
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

/// The scene of the file, at the moment that it chooses.
Scene sceneToConvert(const std::string& in, const Arguments& arguments, Messages& messages) {
  const Conversion& conversion = arguments.conversion;
  const Work work("reading the scene");
  const std::string bytes = readInput(in);
  constexpr int kAround = 64;  // by default
  if (conversion.revolve)
    return revolvedScene(in, bytes, conversion.steps > 0 ? conversion.steps : kAround, conversion.picture,
                         messages);
  SceneAtMoment read = readSceneAtItsMoment(in, bytes, arguments.choices, messages);
  if (read.changesWithTime)
    messages.warn(SourcePlace{.file = in},
                  "an animated scene is written as it is at " + toText(read.time) + " s",
                  "--time X chooses another time");
  return std::move(read.scene);
}

/// Returns the last line.
std::string convert(const std::string& in, const std::string& out, const Arguments& arguments,
                    const Console& console) {
  const auto start = std::chrono::steady_clock::now();
  const Conversion& conversion = arguments.conversion;
  const SceneFormat& format = writableFormatFor(out);
  if (!conversion.picture.empty() && !conversion.revolve)
    throw Error(
        Fault::usage, "--picture: expected --revolve, whose surface it is mapped to",
        "--material 'diffuse = map(\"" + conversion.picture + "\")' gives one to the objects of a scene");
  checkDistinct(in, out);
  checkWritable(out);
  Messages messages;
  Scene scene = sceneToConvert(in, arguments, messages);
  std::vector<NamedBytes> files;
  {
    const Work work("converting the scene");
    change(scene, conversion, console);
    if (!format.keepsGroups) scene = copied(scene, "a file of the format " + std::string(format.name));
    files = format.write(scene, out,
                         {.digits = conversion.digits, .ascii = conversion.ascii, .steps = conversion.steps},
                         messages);
  }
  messages.throwIfFailed(arguments.strict);
  console.warnings(messages.all());

  for (const NamedBytes& file : files) {  // all of them before any is written
    checkDistinct(in, file.file);
    checkIsNoInput(file.file, scene.inputs);
    checkWritable(file.file);
  }
  for (const NamedBytes& file : files) writeFile(file.file, file.bytes);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return "wrote " + namesText(files) + " (" + contentsText(files.front(), scene) + ") in " +
         durationText(seconds) + sparedText(files) + outsideText(files, scene.inputs);
}

/// The file that vrml2out, the courses' converter, wrote for a VRML or Inventor file: x.out next to x.wrl.
/// Empty for files with another suffix.
std::string courseOutput(const std::string& in) {
  const std::filesystem::path path(in);
  const std::string suffix = path.extension().generic_string();
  const bool isVrml = sameWord(suffix, ".wrl") || sameWord(suffix, ".iv");
  return isVrml ? std::filesystem::path(path).replace_extension(".out").generic_string() : "";
}

}  // namespace

int convertCommand(const Arguments& arguments, const Console& console) {
  if (arguments.markdown) {
    printResult(formatsMarkdown());
    return kDone;
  }
  const std::size_t count = arguments.files.size();
  const std::string single = count == 1 ? courseOutput(arguments.files[0]) : "";
  if (count != 2 && single.empty())
    throw Error(Fault::usage, "ray convert: expected the names of two files, found " + std::to_string(count),
                "ray convert IN OUT; of a .wrl or .iv alone it makes a .out");
  const std::string &in = arguments.files[0], &out = count == 1 ? single : arguments.files[1];
  try {
    console.last(true, convert(in, out, arguments, console));
  } catch (const std::bad_alloc&) {
    os::liftMemoryLimit();
    throw outOfMemory(budgetOfThread.budget->brokenOff(), in);
  } catch (const std::length_error&) {  // more of something than addresses
    throw outOfMemory(budgetOfThread.budget->brokenOff(), in);
  }
  return kDone;
}

}  // namespace trace::cli
