// tinyobjloader takes the lines apart; here corners become points, and faces triangles, as they come. (Its
// own shapes hold at most 255 corners of a face.)
#include "formats/mesh/obj_format.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "base/file.h"
#include "base/text.h"
#include "base/unique.h"
#include "formats/mesh/obj_lines.h"
#include "formats/mesh/obj_material.h"
#include "formats/mesh/obj_words.h"
#include "formats/warnings.h"
#include "geometry/mesh/mesh.h"
#include "geometry/mesh/mesh_repair.h"

#define TINYOBJLOADER_IMPLEMENTATION
#include "formats/mesh/obj_materials.h"

namespace trace {
namespace {

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

/// What white is in the colours of points: 255 where all are whole numbers and one is beyond what rounding
/// and bright light make of 1.
float whiteOf(const std::vector<Vec3f>& colors) {
  float most = 0;
  for (const Vec3f& c : colors)
    for (const float x : {c.x, c.y, c.z}) {
      if (x != std::floor(x)) return 1;
      most = std::max(most, x);
    }
  return most > 2 ? 255 : 1;
}

class ObjReader {
 public:
  ObjReader(const std::string& file, std::string_view bytes, Messages& messages)
      : file_(file), place_{file, 0, 0, {}}, bytes_(bytes), messages_(messages) {}

  Model read() {
    std::string room;
    const std::string_view lines = joinedLines(bytes_, room);
    names_ = checkObjLines(file_, bytes_, lines, warnings_);
    colorScale_ = whiteOf(names_.colors);
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
    if (!tinyobj::LoadObjWithCallback(stream, calls, this, &materials_, &warnings, &errors))
      throw Error(Fault::scene, place_, "expected an OBJ mesh: " + errors);
    finish();
    return std::move(model_);
  }

 private:
  static ObjReader& of(void* self) { return *static_cast<ObjReader*>(self); }

  void useName(std::string name) {
    name_ = std::move(name);
    part_ = nullptr;
  }
  void useMaterial(const char* name, int material) {
    material_ = materials_.numberOf(name, material);
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
                        ", but there " + (points_.size() == 1 ? "is " : "are ") +
                        counted(points_.size(), "point") + " so far");
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

  /// The number of the point's colour times that of the part's material.
  std::uint32_t colorNumber(const Part& part, std::size_t point) {
    const bool hasMaterial = part.material != Model::kNoMaterial;
    const Color base = hasMaterial ? paintedColor(model_.materials[part.material].model) : Color(1);
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
    materials_.report();
    warnings_.report(messages_);
    Box3 box;
    for (const Vec3f& point : points_)
      if (isFinite(Vec3(point))) box.extend(Vec3(point));
    const Real longest = box.empty() ? 1 : maxComponent(box.size());
    for (Material& material : model_.materials) scaleHeights(material, longest);
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

  const std::string& file_;
  Place place_;
  std::string_view bytes_;
  Messages& messages_;
  WarningsByKind warnings_;
  ObjNames names_;
  float colorScale_ = 1;  ///< what white is in the colours of points
  Unique<Vec3f> colors_;
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
  ObjMaterials materials_{file_, bytes_, names_, model_, warnings_, messages_};
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
