#include "formats/mesh/obj_materials.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "base/file.h"
#include "formats/mesh/mtl_lines.h"
#include "formats/mesh/obj_material.h"
#include "formats/mesh/obj_words.h"
#include "formats/model_textures.h"

namespace trace {

bool ObjMaterials::operator()(const std::string& name, std::vector<tinyobj::material_t>* materials,
                              std::map<std::string, int>* numbers, std::string*, std::string*) {
  try {
    const std::string text = readBeside(file_, name, model_.inputs);
    const std::string plain = checkedMtl(besideFile(file_, name), text, unused_, warnings_);
    ByteStream stream(plain);
    std::string warnings, errors;
    tinyobj::LoadMtl(numbers, materials, &stream, &warnings, &errors);
  } catch (const Error& error) {
    if (error.fault() == Fault::limit) throw;
    messages_.warn(placeOfFile(name), "materials: " + error.messages().front().what);
    missing_ = true;
    return false;
  }
  std::set<std::string> names;
  for (const tinyobj::material_t& material : *materials)
    if (!names.insert(material.name).second)
      warnings_.warn(placeOfFile(name), "several materials of " + name + " are called \"" + material.name +
                                            "\"; the last counts");
  for (const tinyobj::material_t& material : *materials) notePictures(material, besideFile(file_, name));
  const MtlPictures pictures{
      Place{.file = besideFile(file_, name)},
      [&](const std::string& picture) { return pictureName(name, picture); },
      [&](const std::string& picture) { return kindOfPicture(file_, picture).transparent; },
      [&](const std::string& picture) {
        unused_.note(picture, unused_.empty() ? Place{.file = besideFile(file_, name)} : Place());
      }};
  for (std::size_t i = model_.materials.size(); i < materials->size(); ++i) {
    auto material = materialOf((*materials)[i], pictures);
    if (!material)
      messages_.warn(place(), "material \"" + (*materials)[i].name + "\" has numbers that are not finite");
    model_.materials.push_back(material ? std::move(*material) : plainMaterial());
  }
  return !materials->empty();
}

/// Where the OBJ names that file of materials.
Place ObjMaterials::placeOfFile(const std::string& name) const {
  for (const auto& [names, offset] : names_.materialFiles)
    if (const std::size_t at = names.find(name); at != names.npos) return placeAt(file_, bytes_, offset + at);
  return place();
}

/// As seen from the mesh's file. Exporters name pictures as seen from the materials' file, or from the
/// mesh's.
std::string ObjMaterials::pictureName(const std::string& materialFile, const std::string& picture) const {
  const std::string beside = besideFile(materialFile, picture);
  std::error_code ignored;
  const bool isThere = std::filesystem::is_regular_file(pictureFile(file_, beside), ignored);
  return isThere || materialFile.find('/') == materialFile.npos ? beside : picture;
}

void ObjMaterials::notePictures(const tinyobj::material_t& m, const std::string& materialFile) {
  for (const std::string& picture :
       {m.ambient_texname, m.diffuse_texname, m.specular_texname, m.specular_highlight_texname,
        m.bump_texname, m.displacement_texname, m.alpha_texname, m.reflection_texname, m.roughness_texname,
        m.metallic_texname, m.sheen_texname, m.emissive_texname, m.normal_texname}) {
    if (picture.empty()) continue;
    model_.inputs.noteNamed(besideFile(materialFile, picture));
    model_.inputs.noteNamed(besideFile(file_, picture));
  }
}

/// tinyobj takes blanks at the end of a line for a part of the name.
std::uint32_t ObjMaterials::numberOf(const std::string& text, int number) {
  const std::string name(LineWords(text).rest());
  if (number < 0 && !name.empty() && !undefined_.contains(name)) {
    const auto found = std::find_if(model_.materials.begin(), model_.materials.end(),
                                    [&](const Material& one) { return LineWords(one.name).rest() == name; });
    if (found != model_.materials.end())
      number = static_cast<int>(found - model_.materials.begin());
    else
      undefined_.insert(name);
  }
  return number < 0 ? Model::kNoMaterial : static_cast<std::uint32_t>(number);
}

/// Warns of materials that no file defines. Where a file is missing, that is said instead.
void ObjMaterials::warnUndefined() {
  if (undefined_.empty() || missing_) return;
  constexpr std::size_t kMostNamed = 3;
  std::size_t named = 0, first = bytes_.size();
  std::string names;
  for (const std::string& name : undefined_) {
    if (const auto use = names_.materials.find(name); use != names_.materials.end())
      first = std::min(first, use->second);
    if (named++ < kMostNamed) names += (names.empty() ? "\"" : ", \"") + name.substr(0, 60) + "\"";
  }
  if (named > kMostNamed) names += " and " + std::to_string(named - kMostNamed) + " more";
  messages_.warn(placeAt(file_, bytes_, first),
                 (named == 1 ? "the material " : "the materials ") + names + (named == 1 ? " is" : " are") +
                     " not defined: a light grey shows instead",
                 "a line \"mtllib FILE\" names the file that defines them");
}

void ObjMaterials::report() {
  warnUndefined();
  unused_.report(messages_);
}

}  // namespace trace
