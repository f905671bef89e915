// Loops over the lists of shapes, lights and fields, as the reader does: a new one needs nothing here.
//
// Every material stands where it is first used, as a whole, since a block inherits from what is in force
// around it; one that is used again has a name, which then stands for it. Meshes from files are written in
// full, but those of several objects only once.
#include "formats/ray/write/writer.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <iterator>
#include <map>
#include <set>
#include <type_traits>
#include <utility>

#include "base/budget.h"
#include "base/files/file.h"
#include "base/text.h"
#include "formats/picture_files.h"
#include "formats/ray/read/fields.h"
#include "formats/ray/read/material.h"
#include "formats/ray/read/settings.h"
#include "formats/ray/read/texture.h"
#include "formats/ray/syntax/names.h"
#include "formats/ray/write/edits.h"
#include "formats/ray/write/transform.h"
#include "geometry/field_value.h"
#include "geometry/mesh/mesh.h"
#include "geometry/shapes/solids/csg_tree.h"

namespace trace {
namespace rayfile {
namespace {

namespace fs = std::filesystem;

class Writer {
 public:
  Writer(const Scene& scene, int digits) : scene_(scene), digits_(digits) {
    for (const Material& material : scene.materials) hasModels_ |= !material.model.is<Phong>();
    for (const Object& object : scene.objects) count(object.shape, object.material);
    nameMaterials();
  }
  /// For one object of the scene.
  Writer(const Scene& scene, const Object& object, MaterialText text)
      : scene_(scene), digits_(0), isShort_(true), materialText_(std::move(text)) {
    count(object.shape, object.material);
  }

  std::string write() {
    out_ = "SBT-raytracer 1.0\n\n";
    writeSettings();
    writeCamera();
    writeBackground();
    for (const LightSource& light : scene_.lights) writeLight(light.light, light.links);
    writeGroups();
    for (const Object& object : scene_.objects) writeObject(object);
    writeUnrendered();
    return std::move(out_);
  }
  std::string write(const Object& object) {
    writeObject(object);
    return std::move(out_);
  }
  std::string write(const LightSource& source) {
    writeLight(source.light, source.links);
    return std::move(out_);
  }

 private:
  /// A number that is infinite stands for no limit, which is what there is without the field.
  template <class Value>
  void field(std::string_view keyword, const Value& value) {
    if constexpr (std::is_same_v<Value, Real>)
      if (std::isinf(value)) return;
    out_ += "  " + std::string(keyword) + " = " + written(value, digits_) + ";\n";
  }
  template <class Struct>
  void fields(const Struct& from) {
    forEachField<Struct>([&](const auto& f) { field(f.keyword, from.*f.member); });
  }
  /// They stand in the block, after the material, which they would inherit.
  void field(std::string_view, const Operands&) {}
  void field(std::string_view keyword, const MaterialList& materials) {
    if (!materials.empty())
      list(keyword, materials.indices, [&](std::uint32_t material) { writeMaterial(material); });
  }

  /// The objects that the shape is made of; none for most.
  template <class Visit>
  static void forEachOperand(const Shape& shape, Visit&& visit) {
    for (const Operand& operand : shape.operands().list()) visit(operand);
  }

  void count(const Shape& shape, std::uint32_t material) {
    ++materialUses_[material];
    const auto* mesh = shape.as<Mesh>();
    const bool again = mesh && ++uses_[mesh->data.get()] > 1;
    if (!again) count(materialsOf(shape));
    forEachOperand(shape, [&](const Operand& operand) { count(operand.shape, operand.material); });
  }
  void count(const std::vector<std::uint32_t>& materials) {
    for (std::uint32_t material : materials) ++materialUses_[material];
  }

  /// Materials that are used again get the names that a person sees for them.
  void nameMaterials() {
    std::set<std::string> taken;
    for (const Material& material : scene_.materials) taken.insert(material.name);
    for (const auto& [index, uses] : materialUses_) {
      const Material& material = scene_.materials.at(index);
      if (uses < 2 || !material.name.empty()) continue;
      std::string name = nameOf(material, index);
      while (!taken.insert(name).second) name += "'";
      newNames_[index] = name;
    }
  }

  // --- what is not an object ---

  void writeSettings() {
    const auto isLike = [](const Choice& choice) { return choice.option == "like"; };
    // Else a reader could guess the dialect of 2001 from the shininess of materials.
    if (std::none_of(scene_.choices.begin(), scene_.choices.end(), isLike))
      out_ += "material = { };  // what shapes start from\n\n";
    if (scene_.choices.empty()) return;
    out_ += "settings {\n";
    for (const Choice& choice : scene_.choices) {
      const bool file = findOption(choice.option).kind == Option::Kind::file && choice.value != "none";
      const fs::path path = file ? besideFile(choice.place.file, choice.value) : "";
      const std::string value = file ? fs::absolute(path).lexically_normal().generic_string() : choice.value;
      out_ += "  " + choice.option + " = " + writtenChoice(value) + ";\n";
    }
    out_ += "}\n\n";
  }

  void writeCamera() {
    out_ += "camera {\n";
    fields(scene_.camera);
    out_ += "}\n\n";
  }

  void writeBackground() {
    const Background usual, &is = scene_.background;
    if (is == usual) return;
    out_ += "background {\n";
    forEachField<Background>([&](const auto& f) {
      if (is.*f.member != usual.*f.member) field(f.keyword, is.*f.member);
    });
    out_ += "}\n\n";
  }

  void writeLight(const Light& light, const LightLinks& links) {
    out_ += std::string(light.keyword()) + " {\n";
    forEachField(light, [&](const LightField& f, const auto& value) { field(f.keyword, value); });
    writeLinks(links);
    out_ += "}\n\n";
  }

  /// As found in a .ray file; the text of other formats only as a comment. Pictures of materials stand there.
  void writeUnrendered() {
    for (const Unrendered& node : scene_.unrendered) {
      if (node.kind == "map") continue;
      if (scene_.format == "ray") {
        out_ += node.text + "\n\n";
        continue;
      }
      out_ += "// not rendered: ";
      for (char c : node.text) out_ += c == '\n' || c == '\r' ? std::string("\n// ") : std::string(1, c);
      out_ += "\n\n";
    }
  }

  // --- materials ---

  void writeMaterial(std::uint32_t index) {
    if (materialText_) {
      out_ += materialText_(index, inWhole_);
      return;
    }
    const Material& material = scene_.materials.at(index);
    const auto given = newNames_.find(index);
    const std::string name = inGroup_ ? "" : given == newNames_.end() ? material.name : given->second;
    if (!name.empty()) {
      const auto [named, fresh] = named_.try_emplace(name, index);
      if (!fresh && named->second == index) {
        out_ += written(name, digits_);
        return;
      }
      named->second = index;
    }
    const std::size_t start = out_.size();
    out_ += "{ ";
    if (!name.empty()) item("name", written(name, digits_));
    if (!material.model.is<Phong>() || (inWhole_ && hasModels_))
      item(kModel, std::string(material.model.keyword()));
    modelFields(material);
    forEachField(material, [&](const auto& f, const auto& value) {
      if (ownFields_.contains(f.keyword))
        materialField(material, f.keyword, value, value != Material{}.*f.member);
    });
    out_ += "}";
    out_.replace(start, out_.npos, laidOut(std::string_view(out_).substr(start), "    "));
  }

  static std::set<std::string_view> ownFieldsOf(const std::vector<Material>& materials) {
    std::set<std::string_view> said;
    for (const Material& m : materials)
      forEachField<Material>([&](const auto& f) {
        const bool differs = f.keyword != "bump" && m.*f.member != Material{}.*f.member;
        if (differs || textureOf(m.textures, f.keyword)) said.insert(f.keyword);
      });
    return said;
  }

  void item(std::string_view keyword, const std::string& value) {
    out_ += std::string(keyword) + " = " + value + "; ";
  }

  void modelFields(const Material& material) {
    const MaterialModel usual(material.model.type());
    const std::vector<ModelField> all = material.model.fields(), unsaid = usual.fields();
    const Phong* phong = material.model.as<Phong>();
    for (std::size_t i = 0; i < all.size(); ++i) {
      const std::string_view keyword = all[i].keyword;
      const bool differs = !sameValue(all[i], unsaid[i]);
      visitValueOf(all[i], [&](const auto& value) {
        materialField(material, keyword, value,
                      differs || (phong && isSaidAnyway(material, *phong, keyword)));
      });
      if (phong && phong->mirrorsSpecular && keyword == "reflective" &&
          (inWhole_ || differs || textureOf(material.textures, keyword)))
        item(keyword, "specular");
    }
  }

  /// Writes the field if it has a texture or is to be said, and each of an operand, which would inherit it
  /// from the whole.
  template <class Value>
  void materialField(const Material& material, std::string_view keyword, const Value& value, bool said) {
    if (const Texture* texture = textureOf(material.textures, keyword))
      item(keyword, textured(*texture, value, digits_, &writtenTextures_));
    else if (inWhole_ || said)
      item(keyword, written(value, digits_));
  }

  /// `specular` without `reflective` after it says that the surface mirrors with it.
  static bool isSaidAnyway(const Material& material, const Phong& phong, std::string_view keyword) {
    if (keyword == "specular") return phong.mirrorsSpecular;
    const bool saidSpecular = !isBlack(phong.specular) || textureOf(material.textures, "specular");
    return keyword == "reflective" && !phong.mirrorsSpecular && saidSpecular;
  }

  // --- groups ---

  /// Each as a named group, then its placements. The groups are read where they are placed first, so that in
  /// them no name stands for a material or mesh of the text before.
  void writeGroups() {
    std::set<std::string> taken;
    for (const Group& group : scene_.groups) {
      std::string name = "group";
      name += std::to_string(groupNames_.size() + 1);
      if (isName(group.name) && taken.insert(group.name).second) name = group.name;
      groupNames_.push_back(name);
    }
    inGroup_ = true;
    for (std::size_t i = 0; i < scene_.groups.size(); ++i) {
      out_ += "let " + groupNames_[i] + " = group {\n";
      for (const Object& object : scene_.groups[i].objects) writeObject(object);
      writeUses(scene_.groups[i].uses);
      out_ += "}\n\n";
    }
    inGroup_ = false;
    writeUses(scene_.uses);
  }
  void writeUses(const std::vector<GroupUses>& all) {
    for (const GroupUses& uses : all)
      for (const GroupUse& use : *uses.list) {
        checkBudget();
        const std::vector<TransformStep> steps = stepsOf(use.outFromGroup);
        for (const TransformStep& step : steps) out_ += head(step, digits_);
        out_ += groupNames_[uses.group] + std::string(steps.size(), ')') + "\n";
      }
    if (!all.empty()) out_ += "\n";
  }
  /// A name of the language that means nothing else.
  static bool isName(const std::string& name) {
    const auto isLetter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
    const auto isPart = [&](char c) { return isLetter(c) || (c >= '0' && c <= '9'); };
    return !name.empty() && isLetter(name.front()) && std::all_of(name.begin(), name.end(), isPart);
  }

  // --- objects ---

  void writeObject(const Object& object) {
    const std::vector<TransformStep> steps = stepsOf(object.worldFromObject);
    for (const TransformStep& step : steps) {
      out_ += head(step, digits_);
      if (step.kind == TransformStep::Kind::matrix) out_.back() = '\n';
    }
    if (const auto* mesh = object.shape.as<Mesh>()) {
      writeMesh(object, *mesh->data);
    } else {
      out_ += std::string(object.shape.keyword()) + " {\n";
      writeNames(object);
      writeFields(object.shape);
      writeOwnMaterial(object);
    }
    const bool outside = std::exchange(inWhole_, true);
    forEachOperand(object.shape, [&](const Operand& operand) {
      writeObject({.name = operand.name,
                   .shape = operand.shape,
                   .worldFromObject = operand.wholeFromOperand,
                   .material = operand.material,
                   .place = {},
                   .links = {}});
    });
    inWhole_ = outside;
    out_ += "}" + std::string(steps.size(), ')') + "\n\n";
  }

  /// An object that joins a text says only what is not so by default.
  void writeFields(const Shape& shape) {
    const Shape usual(shape.type());
    const std::vector<AnyField> all = shape.fields(), unsaid = usual.fields();
    for (std::size_t i = 0; i < all.size(); ++i)
      if (!isShort_ || !sameValue(all[i], unsaid[i]))
        visitValueOf(all[i], [&](const auto& value) { field(all[i].keyword, value); });
  }

  /// Its own, and those of lights.
  void writeNames(const Object& object) {
    if (!object.name.empty()) field("name", object.name);
    writeLinks(object.links);
  }

  template <class Links>
  void writeLinks(const Links& links) {
    const Links usual;
    forEachField<Links>([&](const auto& f) {
      if (links.*f.member != usual.*f.member) field(f.keyword, links.*f.member);
    });
  }

  void writeOwnMaterial(const Object& object) {
    out_ += "  material = ";
    writeMaterial(object.material);
    out_ += ";\n";
  }

  /// The materials of points stand before that of the mesh, which they would inherit from.
  void writeMesh(const Object& object, const MeshData& mesh) {
    out_ += std::string(Mesh::kKeyword) + " {\n";
    writeNames(object);
    if (!inGroup_ && uses_.at(&mesh) > 1) {
      const auto [number, fresh] = shared_.try_emplace(&mesh, shared_.size());
      out_ += "  shared = " + std::to_string(number->second) + ";\n";
      if (!fresh) return writeOwnMaterial(object);
    }
    list("points", mesh.points, [&](const Vec3f& p) { tuple(std::array{p.x, p.y, p.z}); });
    if (!mesh.normals.empty())
      list("normals", mesh.normals, [&](const Vec3f& n) { tuple(std::array{n.x, n.y, n.z}); });
    if (!mesh.uvs.empty())
      list("texture_uv", mesh.uvs, [&](const Vec2& uv) { tuple(std::array{uv.x, uv.y}); });
    if (!mesh.secondUvs.empty())
      list("texture_uv2", mesh.secondUvs, [&](const Vec2& uv) { tuple(std::array{uv.x, uv.y}); });
    if (!mesh.tangents.empty())
      list("tangents", mesh.tangents, [&](const MeshTangent& t) {
        tuple(std::array{t.direction.x, t.direction.y, t.direction.z, t.side});
      });
    if (!mesh.materials.empty())
      list("materials", mesh.materials, [&](std::uint32_t material) { writeMaterial(material); });
    writeOwnMaterial(object);
    if (mesh.generateNormals) out_ += "  gennormals;\n";
    if (mesh.twoSided) out_ += "  two_sided;\n";
    list("faces", mesh.triangles, [&](const Triangle& t) { tuple(t); });
  }

  /// Wraps lines, so that an editor can show them.
  template <class Items, class Write>
  void list(std::string_view keyword, const Items& items, Write&& write) {
    constexpr std::size_t kLine = 100;
    out_ += "  " + std::string(keyword) + " = (\n    ";
    std::size_t lineStart = out_.size();
    for (std::size_t i = 0; i < items.size(); ++i) {
      const bool full = out_.size() - lineStart > kLine;
      if (i > 0) out_ += full ? ",\n    " : ", ";
      if (full) lineStart = out_.size();
      write(items[i]);
    }
    out_ += ");\n";
  }

  template <class Numbers>
  void tuple(const Numbers& numbers) {
    out_ += '(';
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      if (i > 0) out_ += ", ";
      if constexpr (std::is_integral_v<typename Numbers::value_type>)
        out_ += std::to_string(numbers[i]);
      else
        appendNumber(out_, numbers[i], digits_);
    }
    out_ += ')';
  }

  const Scene& scene_;
  int digits_;
  bool isShort_ = false;       ///< fields of shapes that have their usual values are left out
  MaterialText materialText_;  ///< says materials in another way, if there is one
  bool inGroup_ = false;
  std::vector<std::string> groupNames_;
  bool inWhole_ = false;    ///< what is written is an operand
  bool hasModels_ = false;  ///< some material is not Phong's: an operand may inherit its model
  std::string out_;
  std::map<const MeshData*, std::size_t> uses_,
      shared_;  ///< how many objects have a mesh; its number in the file
  std::map<std::uint32_t, std::size_t> materialUses_;
  std::map<std::uint32_t, std::string> newNames_;  ///< new names of materials that have none
  WrittenTextures writtenTextures_;
  /// Fields whatever the model that some material says, which others may have to take back.
  std::set<std::string_view> ownFields_ = ownFieldsOf(scene_.materials);
  std::map<std::string, std::uint32_t> named_;  ///< which material a name stands for so far
};

}  // namespace

std::string writtenObject(const Scene& scene, const Object& object, const MaterialText& material) {
  return Writer(scene, object, material).write(object);
}

std::string writtenLight(const LightSource& light) {
  const Scene none;
  return Writer(none, 0).write(light);
}

}  // namespace rayfile

std::vector<NamedBytes> writeRay(const Scene& scene, const std::string& file, const WriteOptions& options,
                                 Messages& messages) {
  warnOfUnsayable(scene, file, messages);
  SeenFrom seen = seenFrom(scene, file, messages);
  std::vector<NamedBytes> files{{file, rayfile::Writer(seen.scene, options.digits).write()}};
  std::move(seen.pictures.begin(), seen.pictures.end(), std::back_inserter(files));
  return files;
}

}  // namespace trace
