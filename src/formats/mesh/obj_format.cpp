// The only file that knows tinyobjloader. It takes the lines apart; here corners become points, and faces
// triangles, as they come. (Its own shapes hold at most 255 corners of a face.)
#include "formats/mesh/obj_format.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <istream>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <streambuf>
#include <utility>

#include "base/file.h"
#include "base/text.h"
#include "base/unique.h"
#include "formats/mesh/mtl_lines.h"
#include "formats/mesh/obj_lines.h"
#include "formats/mesh/obj_words.h"
#include "formats/model_textures.h"
#include "formats/warnings.h"
#include "geometry/mesh/mesh.h"
#include "geometry/mesh/mesh_repair.h"

#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>

namespace trace {
namespace {

/// A stream that reads bytes where they are.
class ByteStream : private std::streambuf, public std::istream {
 public:
  explicit ByteStream(std::string_view bytes) : std::istream(static_cast<std::streambuf*>(this)) {
    char* first = const_cast<char*>(bytes.data());  // streambuf's interface; nothing is written
    setg(first, first, first + bytes.size());
  }
};

Color color(const tinyobj::real_t (&c)[3]) { return {c[0], c[1], c[2]}; }

/// Has it any of the statements that exporters of physically based materials write?
bool isPhysical(const tinyobj::material_t& mtl) {
  return mtl.roughness > 0 || mtl.metallic > 0 || mtl.sheen > 0 || mtl.clearcoat_thickness > 0 ||
         mtl.anisotropy > 0 || !mtl.roughness_texname.empty() || !mtl.metallic_texname.empty() ||
         !mtl.sheen_texname.empty();
}
/// Where only a picture says it, the number that it scales is 1.
Principled toPrincipled(const tinyobj::material_t& mtl) {
  const auto scaled = [](double number, const std::string& picture) {
    return number == 0 && !picture.empty() ? 1 : std::clamp(number, 0.0, 1.0);
  };
  Principled model;
  model.color = color(mtl.diffuse);
  model.ambient = color(mtl.ambient);
  model.emissive = color(mtl.emission);
  model.metallic = scaled(mtl.metallic, mtl.metallic_texname);
  model.roughness = scaled(mtl.roughness, mtl.roughness_texname);
  model.index = mtl.ior > 1 ? mtl.ior : 1.5;
  model.sheen = Color(scaled(mtl.sheen, mtl.sheen_texname));
  model.clearcoat = std::clamp<double>(mtl.clearcoat_thickness, 0, 1);
  model.clearcoatRoughness = std::clamp<double>(mtl.clearcoat_roughness, 0, 1);
  model.anisotropy = std::clamp<double>(mtl.anisotropy, 0, 1);
  model.angle = std::isfinite(mtl.anisotropy_rotation) ? 360 * mtl.anisotropy_rotation : 0;
  return model;
}

/// Illumination models: 1 has no highlight; from 3 on (but 8 and 9) rays are mirrored; 4, 6, 7, 9 are glass.
Material toMaterial(const tinyobj::material_t& mtl) {
  const auto isOneOf = [&](std::initializer_list<int> models) {
    return std::find(models.begin(), models.end(), mtl.illum) != models.end();
  };
  Phong phong;
  phong.ambient = color(mtl.ambient);
  phong.diffuse = color(mtl.diffuse);
  phong.emissive = color(mtl.emission);
  phong.specular = mtl.illum == 1 ? Color() : color(mtl.specular);
  phong.reflective = isOneOf({3, 4, 5, 6, 7}) ? color(mtl.specular) : Color();
  phong.shininess = mtl.shininess;
  phong.index = mtl.ior > 0 ? mtl.ior : 1;
  // Exporters write Tf for opaque materials too: it counts only where something else says glass.
  const Color filter = isBlack(color(mtl.transmittance)) ? Color(1) : color(mtl.transmittance);
  const double opacity = std::clamp(static_cast<double>(mtl.dissolve), 0.0, 1.0);
  if (opacity < 1) {
    phong.transmissive = filter * (1 - opacity);
    phong.diffuse *= Color(opacity);
  } else if (isOneOf({4, 6, 7, 9}))
    phong.transmissive = color(mtl.transmittance);

  Material material{mtl.name, phong, {}};
  if (isPhysical(mtl)) {
    material.model = toPrincipled(mtl);
    material.opacity = opacity;
  }
  return material;
}

/// The picture as the options of its statement place it. Decoded only where `-colorspace sRGB` says so.
ImageMap toMap(std::string file, const tinyobj::texture_option_t& option) {
  ImageMap map = modelPicture(std::move(file));
  const auto& s = option.scale;
  const auto& o = option.origin_offset;
  map.transform = {s[0], 0, o[0], 0, s[1], o[1]};
  for (Real& number : map.transform)
    if (!std::isfinite(number)) number = 0;
  if (option.clamp) map.wrapU = map.wrapV = Wrap::clamp;
  map.srgb = option.colorspace == "sRGB" || option.colorspace == "srgb";
  switch (option.imfchan) {
    case 'r': map.channel = Channel::red; break;
    case 'g': map.channel = Channel::green; break;
    case 'b': map.channel = Channel::blue; break;
    default: break;
  }
  return map;
}

/// How high `bump` is where its picture is white, as a part of the model's longest side: MTL does not say.
constexpr Real kBumpHeight = 0.005;

bool hasHeights(const Material& material) {
  const Texture* texture = textureOf(material.textures, "bump");
  const auto* map = texture ? std::get_if<ImageMap>(&(*texture)->model) : nullptr;
  return map && map->relief == Relief::heights;
}

/// Puts the pictures of the MTL material, which stands at the place, on it. `nameOf` gives a picture's name
/// as seen from the mesh's file, `isTransparent` says whether the picture of that name may be so.
template <class NameOf, class IsTransparent>
void addTextures(const tinyobj::material_t& mtl, const Place& place, Material& material, NameOf&& nameOf,
                 IsTransparent&& isTransparent) {
  const auto* phong = std::get_if<Phong>(&material.model);
  const Color ambient = phongOf(material.model).ambient;
  const auto map = [&](const std::string& picture, const tinyobj::texture_option_t& option) {
    ImageMap made = toMap(nameOf(picture), option);
    made.file.place = place;
    return made;
  };
  const auto put = [&](std::string_view field, const std::string& picture,
                       const tinyobj::texture_option_t& option) {
    if (!picture.empty()) setTexture(material.textures, field, TextureNode{.model = map(picture, option)});
  };
  put(phong ? kDiffuse : kColor, mtl.diffuse_texname, mtl.diffuse_texopt);
  put("emissive", mtl.emissive_texname, mtl.emissive_texopt);
  if (phong) {
    put("specular", mtl.specular_texname, mtl.specular_texopt);
    put("shininess", mtl.specular_highlight_texname, mtl.specular_highlight_texopt);
    if (!isBlack(phong->reflective)) put("reflective", mtl.specular_texname, mtl.specular_texopt);
  } else {
    put("metallic", mtl.metallic_texname, mtl.metallic_texopt);
    put("roughness", mtl.roughness_texname, mtl.roughness_texopt);
    put("sheen", mtl.sheen_texname, mtl.sheen_texopt);
    put("specular_color", mtl.specular_texname, mtl.specular_texopt);
  }
  // What is painted is painted in the ambient light too.
  if (!mtl.ambient_texname.empty())
    put("ambient", mtl.ambient_texname, mtl.ambient_texopt);
  else if (!isBlack(ambient))
    put("ambient", mtl.diffuse_texname, mtl.diffuse_texopt);

  // Normals where both are given: they were baked from heights.
  if (!mtl.normal_texname.empty()) {
    ImageMap normals = map(mtl.normal_texname, mtl.normal_texopt);
    normals.relief = Relief::normals;
    setTexture(material.textures, "bump", TextureNode{.model = std::move(normals)});
    material.bump = 1;
  } else if (!mtl.bump_texname.empty()) {
    put("bump", mtl.bump_texname, mtl.bump_texopt);
    const Real strength =
        mtl.bump_texopt.bump_multiplier;  // in units of kBumpHeight, until the size is known
    material.bump = std::isfinite(strength) ? strength : 1;
  }

  const bool own = !mtl.alpha_texname.empty();
  if (!own && mtl.diffuse_texname.empty()) return;
  ImageMap opacity =
      own ? map(mtl.alpha_texname, mtl.alpha_texopt) : map(mtl.diffuse_texname, mtl.diffuse_texopt);
  const bool oneChannel = own && opacity.channel != Channel::color;
  if (const bool transparent = isTransparent(opacity.file.file); !oneChannel && transparent)
    opacity.channel = Channel::alpha;
  else if (!own)
    return;
  const Texture holes = TextureNode{.model = std::move(opacity)};
  if (phong)
    cutOut(material, holes);
  else
    setTexture(material.textures, kOpacity, holes);
}

bool isSound(const Material& material) {
  const Phong phong = phongOf(material);
  bool sound = true;
  forEachField<Phong>([&](const auto& field) {
    const auto& value = phong.*field.member;
    if constexpr (requires { value.r; })
      sound = sound && isFinite(value);
    else
      sound = sound && std::isfinite(static_cast<double>(value));
  });
  return sound;
}

/// What colours of points multiply.
Color colorOf(const MaterialModel& model) {
  const auto* principled = std::get_if<Principled>(&model);
  return principled ? principled->color : phongOf(model).diffuse;
}

/// What one corner of a face refers to; -1 for nothing.
struct Corner {
  std::int32_t point, uv, normal;
};

/// The faces of one name and material.
struct Part {
  std::string name;
  std::uint32_t material = Model::kNoMaterial;
  Unique<Corner> corners;
  MeshData mesh;
  bool hasNormals = false, hasUvs = false;
};

class ObjReader : public tinyobj::MaterialReader {
 public:
  ObjReader(const std::string& file, std::string_view bytes, Messages& messages)
      : file_(file), place_{file, 0, 0, {}}, bytes_(bytes), messages_(messages) {}

  Model read() {
    std::string room;
    const std::string_view lines = joinedLines(bytes_, room);
    names_ = checkObjLines(file_, bytes_, lines, warnings_);
    for (const Vec3f& c : names_.colors)
      if (std::max(c.x, std::max(c.y, c.z)) > 1) colorScale_ = 255;
    tinyobj::callback_t calls;
    calls.vertex_cb = [](void* self, float x, float y, float z, float) {
      of(self).points_.push_back({x, y, z});
    };
    calls.normal_cb = [](void* self, float x, float y, float z) { of(self).normals_.push_back({x, y, z}); };
    calls.texcoord_cb = [](void* self, float u, float v, float) { of(self).uvs_.push_back({u, v}); };
    calls.index_cb = [](void* self, tinyobj::index_t* indices, int count) {
      of(self).face({indices, static_cast<std::size_t>(count)});
    };
    calls.usemtl_cb = [](void* self, const char* name, int material) {
      of(self).useMaterial(name, material);
    };
    calls.group_cb = [](void* self, const char** names, int count) {
      std::string all;
      for (int i = 0; i < count; ++i) all += (i ? " " : "") + std::string(names[i]);
      of(self).useName(std::move(all));
    };
    calls.object_cb = [](void* self, const char* name) { of(self).useName(name); };

    ByteStream stream(lines);
    std::string warnings, errors;
    if (!tinyobj::LoadObjWithCallback(stream, calls, this, this, &warnings, &errors))
      throw Error(Fault::scene, place_, "expected an OBJ mesh: " + errors);
    finish();
    return std::move(model_);
  }

  /// Reads a material file for tinyobjloader, which knows no folders.
  bool operator()(const std::string& name, std::vector<tinyobj::material_t>* materials,
                  std::map<std::string, int>* numbers, std::string*, std::string*) override {
    try {
      const std::string text = readBeside(file_, name, model_.inputs);
      const std::string plain = checkedMtl(besideFile(file_, name), text, textures_, warnings_);
      ByteStream stream(plain);
      std::string warnings, errors;
      tinyobj::LoadMtl(numbers, materials, &stream, &warnings, &errors);
    } catch (const Error& error) {
      if (error.fault() == Fault::limit) throw;
      messages_.warn(placeOfFile(name), "materials: " + error.messages().front().what);
      materialsMissing_ = true;
      return false;
    }
    std::set<std::string> names;
    for (const tinyobj::material_t& material : *materials)
      if (!names.insert(material.name).second)
        warnings_.warn(placeOfFile(name), "several materials of " + name + " are called \"" + material.name +
                                              "\"; the last counts");
    for (const tinyobj::material_t& material : *materials) notePictures(material, besideFile(file_, name));
    for (std::size_t i = model_.materials.size(); i < materials->size(); ++i) {
      model_.materials.push_back(toMaterial((*materials)[i]));
      if (isSound(model_.materials.back())) {
        addTextures((*materials)[i], Place{.file = besideFile(file_, name)}, model_.materials.back(),
                    [&](const std::string& picture) { return pictureName(name, picture); },
                    [&](const std::string& picture) { return kindOfPicture(file_, picture).transparent; });
        continue;
      }
      messages_.warn(place_,
                     "material \"" + model_.materials.back().name + "\" has numbers that are not finite");
      model_.materials.back() = plainMaterial();
    }
    return !materials->empty();
  }

 private:
  /// Where the OBJ names that file of materials.
  Place placeOfFile(const std::string& name) const {
    for (const auto& [names, offset] : names_.materialFiles)
      if (const std::size_t at = names.find(name); at != names.npos)
        return placeAt(file_, bytes_, offset + at);
    return place_;
  }

  /// As seen from the mesh's file. Exporters name pictures as seen from the materials' file, or from the
  /// mesh's.
  std::string pictureName(const std::string& materialFile, const std::string& picture) const {
    const std::string beside = besideFile(materialFile, picture);
    std::error_code ignored;
    const bool isThere = std::filesystem::is_regular_file(pictureFile(file_, beside), ignored);
    return isThere || materialFile.find('/') == materialFile.npos ? beside : picture;
  }

  void notePictures(const tinyobj::material_t& m, const std::string& materialFile) {
    for (const std::string& picture :
         {m.ambient_texname, m.diffuse_texname, m.specular_texname, m.specular_highlight_texname,
          m.bump_texname, m.displacement_texname, m.alpha_texname, m.reflection_texname, m.roughness_texname,
          m.metallic_texname, m.sheen_texname, m.emissive_texname, m.normal_texname}) {
      if (picture.empty()) continue;
      model_.inputs.noteNamed(besideFile(materialFile, picture));
      model_.inputs.noteNamed(besideFile(file_, picture));
    }
  }

  static ObjReader& of(void* self) { return *static_cast<ObjReader*>(self); }

  void useName(std::string name) {
    name_ = std::move(name);
    part_ = nullptr;
  }
  /// tinyobj takes blanks at the end of a line for a part of the name.
  void useMaterial(const std::string& text, int material) {
    const std::string name(LineWords(text).rest());
    if (material < 0 && !name.empty() && !undefined_.contains(name)) {
      const auto found =
          std::find_if(model_.materials.begin(), model_.materials.end(),
                       [&](const Material& one) { return LineWords(one.name).rest() == name; });
      if (found != model_.materials.end())
        material = static_cast<int>(found - model_.materials.begin());
      else
        undefined_.insert(name);
    }
    material_ = material < 0 ? Model::kNoMaterial : static_cast<std::uint32_t>(material);
    part_ = nullptr;
  }

  Part& part() {
    if (part_) return *part_;
    const auto [found, fresh] = numbers_.try_emplace({name_, material_}, parts_.size());
    if (fresh) {
      parts_.push_back(std::make_unique<Part>());
      parts_.back()->name = name_;
      parts_.back()->material = material_;
    }
    return *(part_ = parts_[found->second].get());
  }

  void face(std::span<const tinyobj::index_t> corners) {
    ++faces_;
    Part& to = part();
    face_.clear();
    for (const tinyobj::index_t& index : corners) {
      const auto point = absolute(index.vertex_index, points_.size());
      if (!point)
        throw Error(Fault::scene, place_,  // said before, unless lines end otherwise for tinyobjloader
                    "face " + std::to_string(faces_) + " uses point " + std::to_string(index.vertex_index) +
                        ", but there are " + std::to_string(points_.size()) + " points so far");
      face_.push_back(corner(to, {*point, optional(index.texcoord_index, uvs_.size()),
                                  optional(index.normal_index, normals_.size())}));
    }
    appendPolygon(to.mesh, face_);
  }

  /// The index from 0 of what the file counts from 1, or backwards from -1.
  static std::optional<std::int32_t> absolute(int index, std::size_t count) {
    const auto n = static_cast<std::int64_t>(count);
    const std::int64_t result = index > 0 ? index - std::int64_t{1} : n + index;
    if (index == 0 || result < 0 || result >= n) return {};
    return static_cast<std::int32_t>(result);
  }
  static std::int32_t optional(int index, std::size_t count) { return absolute(index, count).value_or(-1); }

  /// Of the point's colour, times that of the part's material.
  std::uint32_t colorNumber(const Part& part, std::size_t point) {
    const bool hasMaterial = part.material != Model::kNoMaterial;
    const Color base = hasMaterial ? colorOf(model_.materials[part.material].model) : Color(1);
    const Vec3f& c = names_.colors[point];
    const auto channel = [&](float x, Real of) { return static_cast<float>(x / colorScale_ * of); };
    return colors_.number({channel(c.x, base.r), channel(c.y, base.g), channel(c.z, base.b)});
  }

  std::uint32_t corner(Part& to, const Corner& corner) {
    const std::uint32_t number = to.corners.number(corner);
    if (number < to.mesh.points.size()) return number;
    const auto at = [](std::int32_t index) { return static_cast<std::size_t>(index); };
    to.mesh.points.push_back(points_[at(corner.point)]);
    if (!names_.colors.empty()) to.mesh.materials.push_back(colorNumber(to, at(corner.point)));
    to.mesh.normals.push_back(corner.normal < 0 ? Vec3f{} : normals_[at(corner.normal)]);
    to.mesh.uvs.push_back(corner.uv < 0 ? Vec2{} : uvs_[at(corner.uv)]);
    to.hasNormals |= corner.normal >= 0;
    to.hasUvs |= corner.uv >= 0;
    return number;
  }

  void finish() {
    for (const Vec3f& color : colors_.keys()) model_.colors.push_back({color.x, color.y, color.z});
    warnUndefined();
    warnings_.report(messages_);
    textures_.report(messages_);
    Box3 box;
    for (const Vec3f& point : points_)
      if (isFinite(Vec3(point))) box.extend(Vec3(point));
    const Real longest = box.empty() ? 1 : maxComponent(box.size());
    for (Material& material : model_.materials)
      if (hasHeights(material)) material.bump *= kBumpHeight * longest;
    for (const auto& part : parts_) {
      if (part->mesh.triangles.empty()) continue;
      if (!part->hasNormals) part->mesh.normals.clear();
      if (!part->hasUvs) part->mesh.uvs.clear();
      repairs_.check(part->mesh, place_);
      model_.objects.push_back({part->name,
                                Mesh{std::make_shared<const MeshData>(std::move(part->mesh))},
                                {},
                                part->material,
                                place_});
    }
    repairs_.report(place_, messages_);
  }

  /// Warns of materials that no file defines. Where a file is missing, that is said instead.
  void warnUndefined() {
    if (undefined_.empty() || materialsMissing_) return;
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

  const std::string& file_;
  Place place_;
  std::string_view bytes_;
  Messages& messages_;
  WarningsByKind warnings_;
  UnusedTextures textures_;
  ObjNames names_;
  float colorScale_ = 1;  ///< what white is in the colours of points
  Unique<Vec3f> colors_;
  std::set<std::string> undefined_;
  bool materialsMissing_ = false;
  std::vector<Vec3f> points_, normals_;
  std::vector<Vec2> uvs_;
  std::string name_;
  std::uint32_t material_ = Model::kNoMaterial;
  std::map<std::pair<std::string, std::uint32_t>, std::size_t> numbers_;  ///< of parts
  std::vector<std::unique_ptr<Part>> parts_;
  Part* part_ = nullptr;  ///< that of name_ and material_, once known
  std::vector<std::uint32_t> face_;
  MeshRepairs repairs_;
  std::size_t faces_ = 0;
  Model model_;
};

}  // namespace

bool recognisesObj(std::string_view bytes) {
  constexpr std::array<std::string_view, 12> kKeywords{"v", "vn", "vt", "vp",     "f",      "l",
                                                       "o", "g",  "s",  "usemtl", "mtllib", "cstype"};
  std::string_view rest = bytes;
  while (!rest.empty()) {
    const std::size_t start = rest.find_first_not_of(" \t\r\n");
    if (start == std::string_view::npos) return false;
    rest.remove_prefix(start);
    if (rest[0] != '#') break;
    rest.remove_prefix(std::min(rest.find('\n'), rest.size()));
  }
  const std::string_view word = rest.substr(0, rest.find_first_of(" \t\r\n"));
  if (std::find(kKeywords.begin(), kKeywords.end(), word) == kKeywords.end()) return false;
  for (const char* vertex : {"\nv ", "\nv\t"})
    if (rest.find(vertex) != std::string_view::npos) return true;
  return word == "v";
}

Model readObj(const std::string& file, std::string_view bytes, Messages& messages) {
  return ObjReader(file, bytes, messages).read();
}

}  // namespace trace
