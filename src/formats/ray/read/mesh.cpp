#include "formats/ray/read/mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "formats/ray/read/fields.h"
#include "formats/ray/read/mesh_operations.h"
#include "geometry/mesh/mesh_repair.h"

namespace trace::rayfile {
namespace {

constexpr std::array<std::string_view, 19> kMeshFields{
    "uv",        "shared",     "crease",      "faces",     "gennormals", "material", "materials",
    "name",      "lit_by",     "normals",     "points",    "scheme",     "tangents", "sharp_edges",
    "subdivide", "texture_uv", "texture_uv2", "two_sided", "not_lit_by"};

class MeshReader {
 public:
  MeshReader(Findings& findings, Materials& materials, SharedMeshes& shared)
      : findings_(findings), materials_(materials), shared_(shared) {
    node_.material = materials.current;
  }

  std::optional<MeshNode> read(const Item& block) {
    RepeatedFields repeats(findings_, Mesh::kKeyword);
    for (const Item item : block) {
      if (item.keyed()) repeats.note(item);
      good_ &= field(item);
    }
    if (sharedAs_ && data_.points.empty() && !faces_) return again();
    if (good_) good_ = checkCounts() && readFaces() && readSharpEdges();
    if (!good_) return {};
    repair(block);
    if (!operations_.none())
      data_ = operations_.apply(data_, findings_.syntax().shortPlace(block.offset()), creases_);
    node_.mesh.data = std::make_shared<const MeshData>(std::move(data_));
    if (sharedAs_) shared_.insert_or_assign(sharedName_, node_.mesh);
    return std::move(node_);
  }

 private:
  /// The mesh of an earlier block.
  std::optional<MeshNode> again() {
    const auto found = shared_.find(sharedName_);
    if (good_ && found == shared_.end())
      findings_.error(*sharedAs_, "expected the name of a mesh before, found " + describe(sharedAs_->value()),
                      "a mesh is shared by shared = NAME beside its points");
    if (!good_ || found == shared_.end()) return {};
    node_.mesh = found->second;
    return std::move(node_);
  }

  bool field(const Item& item) {
    if (item.is(Kind::word) && item.text() == "gennormals") {
      findings_.sureSignOf2005();
      data_.generateNormals = true;
      return true;
    }
    if (item.is(Kind::word) && item.text() == "two_sided") return data_.twoSided = true;
    if (!item.keyed()) {
      findings_.expected(item, Mesh::kKeyword, "a field, as in points = ((0, 0, 0), (1, 0, 0), (0, 1, 0))");
      return false;
    }
    const std::string_view key = item.key();
    const Item value = item.value();
    if (key == "gennormals") {
      findings_.signOf2001(item);
      return rayfile::read(findings_, key, value, data_.generateNormals);
    }
    if (key == "two_sided") return rayfile::read(findings_, key, value, data_.twoSided);
    if (key == "points") return vectors(value, "point", data_.points);
    if (key == "normals") return vectors(normals_.emplace(value), "normal", data_.normals);
    if (key == "texture_uv" || key == "map_points")
      return textureCoordinates(uvs_.emplace(value), "texture_uv", data_.uvs);
    if (key == "texture_uv2") return textureCoordinates(secondUvs_.emplace(value), key, data_.secondUvs);
    if (key == "tangents") return tangents(tangents_.emplace(value));
    if (key == "materials") return vertexMaterials(materialList_.emplace(value));
    if (key == "faces") return isList(faces_.emplace(value), key);
    if (key == "sharp_edges") return isList(sharpEdges_.emplace(value), key);
    if (key == "shared") return rayfile::read(findings_, key, sharedAs_.emplace(item).value(), sharedName_);
    if (key == "name") return rayfile::read(findings_, key, value, node_.name);
    if (key == "material") {
      node_.material = materials_.read(value, materials_.current);
      return true;
    }
    if (assignField(findings_, node_.links, item) || operations_.read(findings_, item)) return true;
    findings_.unknownField(Mesh::kKeyword, item, kMeshFields);
    return true;
  }

  // --- lists per point ---

  bool isList(const Item& value, std::string_view name) {
    if (value.is(Kind::tuple)) return true;
    findings_.expected(value, name, "a list ( ... )");
    return false;
  }

  bool vectors(const Item& list, const char* what, std::vector<Vec3f>& to) {
    to.clear();
    if (!isList(list, std::string(what) + "s")) return false;
    to.reserve(list.count());
    for (const Item item : list) {
      Real n[3];
      if (!numbers(item, n, 3)) {
        findings_.expected(item, std::string(what) + " " + std::to_string(to.size()), "(x, y, z)");
        return false;
      }
      const Vec3f v{Vec3{n[0], n[1], n[2]}};
      if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) {
        findings_.expected(item, std::string(what) + " " + std::to_string(to.size()),
                           "numbers of at most 3.4e38");
        return false;
      }
      to.push_back(v);
    }
    return true;
  }

  bool textureCoordinates(const Item& list, std::string_view name, std::vector<Vec2>& to) {
    to.clear();
    if (!isList(list, std::string(name))) return false;
    for (const Item item : list) {
      Real n[2];
      if (!numbers(item, n, 2)) {
        findings_.expected(item, std::string(name) + " " + std::to_string(to.size()), "(u, v)");
        return false;
      }
      to.push_back({n[0], n[1]});
    }
    return true;
  }

  /// The fourth number of each tells the side of v by its sign.
  bool tangents(const Item& list) {
    data_.tangents.clear();
    if (!isList(list, "tangents")) return false;
    for (const Item item : list) {
      Real n[4];
      if (!numbers(item, n, 4)) {
        findings_.expected(item, "tangent " + std::to_string(data_.tangents.size()), "(x, y, z, side)");
        return false;
      }
      data_.tangents.push_back({Vec3f(Vec3{n[0], n[1], n[2]}), n[3] < 0 ? -1.0f : 1.0f});
    }
    return true;
  }

  /// They inherit from the mesh's material as known at this point of the file.
  bool vertexMaterials(const Item& list) {
    data_.materials.clear();
    if (!isList(list, "materials")) return false;
    for (const Item item : list)
      data_.materials.push_back(materials_.index(materials_.read(item, node_.material)));
    return true;
  }

  bool checkCounts() {
    return checkCount(normals_, data_.normals.size(), "normals") &&
           checkCount(materialList_, data_.materials.size(), "materials") &&
           checkCount(uvs_, data_.uvs.size(), "texture_uv") &&
           checkCount(secondUvs_, data_.secondUvs.size(), "texture_uv2") &&
           checkCount(tangents_, data_.tangents.size(), "tangents");
  }
  bool checkCount(const std::optional<Item>& list, std::size_t count, const char* name) {
    if (count == 0 || count == data_.points.size()) return true;
    findings_.error(*list, std::string(name) + ": expected one for each of the " +
                               std::to_string(data_.points.size()) + " points, found " +
                               std::to_string(count));
    return false;
  }

  // --- faces ---

  /// Polygons become fans. They may stand before the points, so they are read last.
  bool readFaces() {
    if (!faces_) return true;
    data_.triangles.reserve(faces_->count());
    std::size_t number = 0;
    for (const Item face : *faces_)
      if (!readFace(face, number++)) return false;
    return true;
  }

  static std::string faceName(std::size_t number) { return "face " + std::to_string(number); }

  bool readFace(const Item& face, std::size_t number) {
    if (!face.is(Kind::tuple)) {
      findings_.expected(face, faceName(number), "a list of points, as in (0, 1, 2)");
      return false;
    }
    std::uint32_t first = 0, last = 0;
    std::size_t count = 0;
    for (const Item item : face) {
      std::uint32_t point = 0;
      if (!readIndex(item, number, point)) return false;
      if (count == 0) first = point;
      if (count >= 2) data_.triangles.push_back({first, last, point});
      last = point;
      ++count;
    }
    if (count < 3) {
      findings_.expected(face, faceName(number), "at least 3 points");
      return false;
    }
    const std::size_t triangles = count - 2;
    if (triangles > 1)
      data_.polygons.push_back({static_cast<std::uint32_t>(data_.triangles.size() - triangles),
                                static_cast<std::uint32_t>(triangles)});
    return true;
  }

  bool readIndex(const Item& item, std::size_t number, std::uint32_t& point) {
    if (!item.is(Kind::number) || item.number() != std::floor(item.number()) || item.number() < 0) {
      findings_.expected(item, faceName(number), "the number of a point, a whole number from 0");
      return false;
    }
    if (item.number() >= static_cast<double>(data_.points.size())) {
      const std::string count = std::to_string(data_.points.size());
      findings_.error(item, faceName(number) + " uses point " + describe(item) + " but the mesh has " + count,
                      data_.points.empty() ? "" : "points are counted from 0");
      return false;
    }
    point = static_cast<std::uint32_t>(item.number());
    return true;
  }

  // --- edges that stay sharp ---

  bool readSharpEdges() {
    if (!sharpEdges_) return true;
    const std::set<std::array<std::uint32_t, 2>> edges = edgesOfFaces();
    std::size_t number = 0;
    for (const Item item : *sharpEdges_) {
      const std::string name = "sharp edge " + std::to_string(number++);
      Real n[3];
      if (!numbers(item, n, 3) || !(n[2] >= 0)) {
        findings_.expected(item, name, "(point, point, sharpness from 0)");
        return false;
      }
      const auto point = [&](Real x) {  // none of those there are for what is no number of a point
        return x >= 0 && x < static_cast<Real>(data_.points.size()) && x == std::floor(x)
                   ? static_cast<std::uint32_t>(x)
                   : std::numeric_limits<std::uint32_t>::max();
      };
      const std::uint32_t a = point(n[0]), b = point(n[1]);
      if (!edges.contains({std::min(a, b), std::max(a, b)})) {
        findings_.expected(item, name, "two neighbouring points of a face");
        return false;
      }
      creases_.push_back({a, b, n[2]});
    }
    if (operations_.subdivide == 0)
      findings_.warn(*sharpEdges_, "sharp_edges: they shape the mesh only where `subdivide` is above 0");
    return true;
  }

  /// As the file gives the faces, the lesser point first.
  std::set<std::array<std::uint32_t, 2>> edgesOfFaces() const {
    std::set<std::array<std::uint32_t, 2>> edges;
    const auto add = [&](const Item& from, const Item& to) {
      const auto a = static_cast<std::uint32_t>(from.number()), b = static_cast<std::uint32_t>(to.number());
      edges.insert({std::min(a, b), std::max(a, b)});
    };
    if (!faces_) return edges;
    for (const Item face : *faces_) {
      std::optional<Item> first, last;
      for (const Item item : face) {
        if (last) add(*last, item);
        if (!first) first.emplace(item);
        last.emplace(item);
      }
      if (last) add(*last, *first);
    }
    return edges;
  }

  void repair(const Item& block) {
    if (data_.triangles.empty())
      findings_.warn(faces_.value_or(block), "polymesh: nothing of it can be seen, for it has no faces");
    if (const std::size_t n = dropDegenerate(data_).count; n > 0)
      findings_.warnOfNumber(faces_.value_or(block), std::string(kWithoutArea), n);
    if (const std::size_t n = repairNormals(data_); n > 0)
      findings_.warnOfNumber(normals_.value_or(block), "normals of length 0 are taken from the faces", n);
  }

  Findings& findings_;
  Materials& materials_;
  SharedMeshes& shared_;
  MeshNode node_;
  std::string sharedName_;
  std::optional<Item> sharedAs_;
  MeshData data_;
  MeshOperations operations_;
  std::vector<Crease> creases_;
  std::optional<Item> normals_, uvs_, secondUvs_, tangents_, materialList_, faces_, sharpEdges_;
  bool good_ = true;
};

}  // namespace

std::optional<MeshNode> readMesh(Findings& findings, Materials& materials, SharedMeshes& shared,
                                 const Item& block) {
  return MeshReader(findings, materials, shared).read(block);
}

}  // namespace trace::rayfile
