#include "formats/mesh/obj_materials.h"

#include <algorithm>
#include <utility>

#include "base/files/file.h"
#include "base/files/named_file.h"
#include "base/files/read_scope.h"
#include "formats/mesh/mtl_lines.h"
#include "formats/mesh/obj_material.h"
#include "formats/mesh/obj_words.h"
#include "formats/model_textures.h"
#include "formats/text_front.h"

namespace trace {

void ObjMaterials::read(std::string_view names, std::size_t offset) {
  const std::string whole(names);
  if (whole.find_first_of(" \t#") == whole.npos || namesFile(file_, whole))
    return readFile(whole, placeAt(file_, bytes_, offset));
  const std::string_view plain = LineWords(names.substr(0, names.find('#'))).rest();
  if (namesFile(file_, std::string(plain)))
    return readFile(std::string(plain), placeAt(file_, bytes_, offset));
  LineWords words(plain);
  for (std::string_view word = words.next(); !word.empty(); word = words.next())
    readFile(std::string(word),
             placeAt(file_, bytes_, offset + static_cast<std::size_t>(word.data() - names.data())));
}

void ObjMaterials::readFile(const std::string& name, const SourcePlace& place) {
  if (name.empty() || !readFiles_.insert(name).second) return;
  try {
    const NamedFile found = namedFile(file_, name);
    const std::string text = readTextBeside(file_, name, model_.inputs, messages_);
    if (!found.remark.empty()) messages_.warn(place, "materials: " + found.remark);
    const std::string plain = checkedMtl(found.path, text, unused_, maps_, warnings_);
    ByteStream stream(plain);
    std::string warnings, errors;
    tinyobj::LoadMtl(&numbers_, &materials_, &stream, &warnings, &errors);
  } catch (const ReadDenied& denied) {
    denied.at(place);
  } catch (const Error& error) {
    if (error.fault() == Fault::limit) throw;
    messages_.warn(place, "materials: " + error.messages().front().what);
    missing_ = true;
    return;
  }
  addMaterials(name, place);
}

/// Those of a file that was read.
void ObjMaterials::addMaterials(const std::string& name, const SourcePlace& place) {
  const std::string path = namedFile(file_, name).path;
  std::set<std::string> names;
  for (const tinyobj::material_t& material : materials_)
    if (!names.insert(material.name).second)
      warnings_.warn(
          place, "several materials of " + name + " are called \"" + material.name + "\"; the last counts");
  for (const tinyobj::material_t& material : materials_) notePictures(material, path);
  const MtlPictures pictures{
      [&](std::string_view keyword, const std::string& picture) {
        const MapPlaces::Line* line = maps_.find(keyword, picture);
        return line ? line->place : SourcePlace{.file = path};
      },
      [&](const std::string& picture) { return pictureName(name, picture); },
      [&](const std::string& picture) { return kindOfPicture(file_, picture).transparent; },
      [&](std::string_view keyword, const std::string& picture) {
        const MapPlaces::Line* line = maps_.find(keyword, picture);
        unused_.note(picture, line ? line->place : SourcePlace{.file = path}, line ? line->keyword : keyword);
      }};
  for (std::size_t i = model_.materials.size(); i < materials_.size(); ++i) {
    auto material = materialOf(materials_[i], pictures);
    if (!material)
      messages_.warn(SourcePlace{.file = file_},
                     "material \"" + materials_[i].name + "\" has numbers that are not finite");
    model_.materials.push_back(material ? std::move(*material) : plainMaterial());
  }
}

/// As seen from the mesh's file. Exporters name pictures as seen from the materials' file, or from the
/// mesh's.
std::string ObjMaterials::pictureName(const std::string& materialFile, const std::string& picture) const {
  const std::string beside = besideFile(materialFile, picture);
  return namesFile(file_, beside) || materialFile.find('/') == materialFile.npos ? beside : picture;
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

std::uint32_t ObjMaterials::numberOf(std::string_view text) {
  if (text.empty()) return Model::kNoMaterial;
  for (std::string_view name : {text, LineWords(text.substr(0, text.find('#'))).rest()}) {
    if (const auto found = numbers_.find(std::string(name)); found != numbers_.end())
      return static_cast<std::uint32_t>(found->second);
    const auto same = std::find_if(model_.materials.begin(), model_.materials.end(),
                                   [&](const Material& one) { return LineWords(one.name).rest() == name; });
    if (same != model_.materials.end()) return static_cast<std::uint32_t>(same - model_.materials.begin());
  }
  undefined_.insert(text);
  return Model::kNoMaterial;
}

/// Warns of materials that no file defines. Where a file is missing, that is said instead.
void ObjMaterials::warnUndefined() {
  if (undefined_.empty() || missing_) return;
  constexpr std::size_t kMostNamed = 3;
  std::size_t named = 0, first = bytes_.size();
  std::string names;
  for (const std::string_view name : undefined_) {
    if (const auto use = names_.find(name); use != names_.end()) first = std::min(first, use->second);
    if (named++ < kMostNamed)
      names += (names.empty() ? "\"" : ", \"") + std::string(name.substr(0, 60)) + "\"";
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
