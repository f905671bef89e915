// Objects and lights that other files bring into a scene.
#include "base/files/file.h"
#include "base/files/named_file.h"
#include "base/files/read_scope.h"
#include "formats/format.h"
#include "formats/inventor/inventor_reader.h"
#include "formats/model.h"
#include "formats/text_front.h"

namespace trace::inventor {

namespace {

/// A light that stands in another file, where that file stands.
Light moved(Light light, const Affine& worldFromFile) {
  if (Vec3* position = editableValue<Vec3>(light, "position")) *position = worldFromFile * *position;
  if (Vec3* direction = editableValue<Vec3>(light, "direction"))
    *direction = linear(worldFromFile, *direction);
  return light;
}

}  // namespace

void Reader::include(const Values& v, State& state) {
  const std::string name(v.word(v.node().type == "Inline" ? "url" : "name", ""));
  if (name.empty())
    return warn(v.node(), std::string(v.node().type) + " names no file: nothing is brought in", "no file");
  const auto [known, fresh] = library_.try_emplace(namedFile(document_.file(), name).path);
  if (fresh) try {
      known->second = readPart(known->first, name);
    } catch (const ReadDenied& denied) {
      denied.at(document_.place(v.node().token));
    } catch (const Error& error) {
      if (error.fault() == Fault::limit) throw;
      return warn(v.node(), name + " is left out: " + error.messages().front().what, name);
    }
  if (!known->second) return warn(v.node(), name + " is left out: it holds itself", name);
  const Scene& part = *known->second;
  spend(part.objects.size() + part.lights.size(), v.node());
  const auto [first, unknown] = firstMaterials_.try_emplace(&part, scene_.materials.size());
  if (unknown) scene_.materials.insert(scene_.materials.end(), part.materials.begin(), part.materials.end());
  for (Object object : part.objects) {
    object.worldFromObject = state.worldFromObject * object.worldFromObject;
    object.material += static_cast<std::uint32_t>(first->second);
    if (invertible(object.worldFromObject)) scene_.objects.push_back(std::move(object));
  }
  for (const LightSource& source : part.lights)
    scene_.lights.push_back({moved(source.light, state.worldFromObject), source.place});
}

Scene Reader::readPart(const std::string& path, const std::string& name) {
  constexpr int kMostFiles = 20;
  if (nesting_ >= kMostFiles)
    throw Error(Fault::scene, "files that name files are read 20 deep, and no deeper");
  const std::string bytes = readBeside(document_.file(), name, scene_.inputs);
  const TextFront front(path, bytes, messages_);
  Scene part;
  if (hasHeader(front.text())) {
    const Document document(path, front.text(), messages_);
    part = Reader(document, messages_, library_, nesting_ + 1).readPart();
    scene_.inputs.note(part.inputs);
  } else {
    const Model model = readModel(path, bytes, messages_);
    scene_.inputs.note(model.inputs);
    part.objects = placed(model, plainMaterial(), [&](const Material& material) {
      part.materials.push_back(material);
      return static_cast<std::uint32_t>(part.materials.size() - 1);
    });
  }
  for (Material& material : part.materials)  // pictures lie beside that file, and are named from this one
    changePixels(material, [&](Pixels& pixels) { pixels.file = besideFile(name, pixels.file); });
  return part;
}

}  // namespace trace::inventor
