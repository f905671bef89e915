#include "formats/ray/read/mesh_file.h"

#include <array>
#include <memory>
#include <optional>
#include <utility>

#include "base/files/file.h"
#include "base/files/named_file.h"
#include "formats/format.h"
#include "formats/ray/read/fields.h"
#include "geometry/mesh/mesh.h"

namespace trace::rayfile {
namespace {

constexpr std::array<std::string_view, 10> kFileFields{
    "uv", "crease", "file", "objfile", "gennormals", "material", "name", "subdivide", "lit_by", "not_lit_by"};

bool isMeshFile(const Item& item) {
  return item.keyed() && (item.key() == "file" || item.key() == "objfile");
}

}  // namespace

bool namesMeshFile(const Item& block) {
  for (const Item item : block)
    if (isMeshFile(item)) return true;
  return false;
}

std::vector<Object> MeshFiles::read(const Item& block) {
  std::optional<Item> file;
  std::string fileName, name;
  NotedMaterial material = materials_.completed(materials_.current);
  // Black, which shapes of the courses without a material are, would only hide the mesh.
  Material bare;
  bare.sides = material.sides;
  if (!findings_.isOfKind() && material == bare) makePlain(material);
  bool generate = false;
  ObjectLinks links;
  MeshOperations operations;
  for (const Item item : block) {
    if (item.is(Kind::word) && item.text() == "gennormals") {
      generate = true;
    } else if (!item.keyed()) {
      findings_.expected(item, Mesh::kKeyword, "a field, as in file = \"bunny.ply\"");
    } else if (isMeshFile(item)) {
      if (rayfile::read(findings_, item.key(), item.value(), fileName)) file = item;
    } else if (item.key() == "name") {
      rayfile::read(findings_, "name", item.value(), name);
    } else if (item.key() == "gennormals") {
      rayfile::read(findings_, "gennormals", item.value(), generate);
    } else if (item.key() == "material") {
      material = materials_.read(item.value(), materials_.current);
    } else if (!assignField(findings_, links, item) && !operations.read(findings_, item)) {
      findings_.unknownField("a mesh from a file", item, kFileFields);
    }
  }
  const Model* found = file ? model(*file, fileName) : nullptr;
  if (!found) return {};

  const auto [placed, fresh] = placed_.try_emplace({found, materials_.index(material), generate, operations});
  if (fresh) {
    const bool showsBoth = findings_.isOfKind() && !found->saysSides;
    const auto index = [&](Material m) {
      if (showsBoth && m != material) m.sides = ShadedSides::both;
      return materials_.index(m);
    };
    placed->second = trace::placed(*found, material, index);
    if (generate || !operations.none())
      change(placed->second, generate, operations, findings_.syntax().shortPlace(block.offset()));
  }
  std::vector<Object> objects = placed->second;
  for (Object& object : objects) {
    if (!name.empty()) object.name = name;
    object.links = links;
  }
  return objects;
}

/// The file's model; nothing, after a report, if it cannot be had.
const Model* MeshFiles::model(const Item& field, const std::string& name) {
  const NamedFile named = namedFile(findings_.syntax().file(), name);
  const std::string& path = named.path;
  const auto known = models_.find(path);
  if (known != models_.end()) return &known->second;
  try {
    Messages messages;
    if (!named.remark.empty()) findings_.warn(field, named.remark);
    InputFiles& inputs = findings_.scene().inputs;
    const std::string bytes = readBeside(findings_.syntax().file(), name, inputs);
    Model& model = models_.emplace(path, readModel(path, bytes, messages, time_)).first->second;
    inputs.note(model.inputs);
    for (Material& material : model.materials)  // pictures lie beside the mesh, and are named from the scene
      changePixels(material, [&](Pixels& pixels) { pixels.file = besideFile(name, pixels.file); });
    for (const Message& warning : messages.all())
      findings_.warn(field, placeText(warning.place) + ": " + warning.what, warning.hint);
    return &model;
  } catch (const Error& error) {
    if (error.fault() == Fault::limit) throw;
    const Message& first = error.messages().front();
    const std::string place = placeText(first.place);
    findings_.error(field, (place.empty() ? "" : place + ": ") + first.what, first.hint);
    return nullptr;
  }
}

/// Does to each mesh what its block asks for.
void MeshFiles::change(std::vector<Object>& objects, bool generate, const MeshOperations& operations,
                       const SourcePlace& place) {
  std::map<const MeshData*, Mesh> changed;
  for (Object& object : objects) {
    const auto* mesh = object.shape.as<Mesh>();
    if (!mesh) continue;
    const auto [found, fresh] = changed.try_emplace(mesh->data.get());
    if (fresh) {
      MeshData data = *mesh->data;
      data.generateNormals = generate;
      if (!operations.none()) data = operations.apply(data, place);
      found->second.data = std::make_shared<const MeshData>(std::move(data));
    }
    object.shape = found->second;
  }
}

}  // namespace trace::rayfile
