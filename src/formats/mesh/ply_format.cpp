// The meaning of PLY files: which elements and properties make a mesh. Those not known are skipped.
#include "formats/mesh/ply_format.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "base/text.h"
#include "base/unique.h"
#include "formats/mesh/ply_syntax.h"
#include "formats/model_textures.h"
#include "geometry/mesh/mesh.h"
#include "geometry/mesh/mesh_repair.h"

namespace trace {
namespace {

using namespace ply;

class PlyReader {
 public:
  PlyReader(const std::string& file, std::string_view bytes, Messages& messages)
      : file_(file), messages_(messages), header_(readHeader(file, bytes)), body_(file, bytes, header_) {}

  Model read() {
    for (const Element& element : header_.elements) {
      if (element.name == "vertex")
        readVertices(element);
      else if (element.name == "face")
        readFaces(element);
      else if (element.name == "tristrips")
        readStrips(element);
      else
        body_.skip(element);
    }
    if (!hasVertices_) fail("expected an element \"vertex\"");
    if (!hasFaces_)
      fail("expected an element \"face\" or \"tristrips\": this file holds points, and no surface");
    if (const std::size_t left = body_.left(); left > 0)
      messages_.warn(place(), "bytes after the last element are ignored: " + std::to_string(left));
    addOnlyMesh(model_, std::move(mesh_), place(), messages_);
    addTexture();
    textures_.report(messages_);
    return std::move(model_);
  }

 private:
  /// The first that the file names, if it has texture coordinates.
  void addTexture() {
    if (header_.textures.empty()) return;
    const bool isSeen = !model_.objects[0].shape.as<Mesh>()->data->uvs.empty();
    for (std::size_t i = isSeen ? 1 : 0; i < header_.textures.size(); ++i)
      textures_.note(header_.textures[i].first, header_.textures[i].second);
    if (!isSeen) return;
    const auto& [name, where] = header_.textures[0];
    const Texture picture = TextureNode{.model = modelPicture(name, where)};
    Phong phong;
    phong.ambient = phong.diffuse = Color(1);
    model_.materials.push_back({"", phong, {{"ambient", picture}, {"diffuse", picture}}});
    model_.objects[0].material = 0;
    if (kindOfPicture(file_, name).transparent) {
      ImageMap opacity = modelPicture(name, where);
      opacity.channel = Channel::alpha;
      cutOut(model_.materials[0], TextureNode{.model = opacity});
    }
  }

  // --- points ---

  void readVertices(const Element& element) {
    if (std::exchange(hasVertices_, true)) fail("expected one element \"vertex\", found two");
    body_.checkCount(element);
    for (const auto& names : {std::array{"nx", "ny", "nz"}, std::array{"red", "green", "blue"}}) {
      const auto has = [&](const char* name) { return element.find({name}) >= 0; };
      const auto count = std::count_if(names.begin(), names.end(), has);
      if (count == 1 || count == 2)
        messages_.warn(place(), std::string("expected all of ") + names[0] + ", " + names[1] + " and " +
                                    names[2] + " of a vertex, found " + std::to_string(count) +
                                    "; they are ignored");
    }
    columns_.assign(element.properties.size(), {});
    mesh_.points.resize(element.count);
    float* const points = element.count ? &mesh_.points[0].x : nullptr;
    if (!wantVector(element, {{{"x"}, {"y"}, {"z"}}}, points)) fail("expected vertices with x, y and z");
    std::vector<Vec3f> normals(element.count);
    if (element.count && wantVector(element, {{{"nx"}, {"ny"}, {"nz"}}}, &normals[0].x))
      mesh_.normals = std::move(normals);
    std::vector<Vec3f> colors(element.count);
    const bool colored =
        element.count &&
        wantVector(
            element,
            {{{"red", "r", "diffuse_red"}, {"green", "g", "diffuse_green"}, {"blue", "b", "diffuse_blue"}}},
            &colors[0].x);
    const int u = element.find({"u", "s", "texture_u", "tx"}),
              v = element.find({"v", "t", "texture_v", "ty"});
    std::vector<float> uvs(u >= 0 && v >= 0 ? 2 * element.count : 0);
    if (!uvs.empty()) {
      want(u, {&uvs[0], 2});
      want(v, {&uvs[1], 2});
    }

    body_.readColumns(element, columns_);
    for (std::size_t i = 0; i < uvs.size(); i += 2) mesh_.uvs.push_back({uvs[i], uvs[i + 1]});
    if (colored)
      takeColors(
          colors,
          element.properties[static_cast<std::size_t>(element.find({"red", "r", "diffuse_red"}))].type);
  }

  void want(int property, Column column) { columns_[static_cast<std::size_t>(property)] = column; }

  bool wantVector(const Element& element, const std::array<std::initializer_list<std::string_view>, 3>& names,
                  float* to) {
    int found[3];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      found[axis] = element.find(names[axis]);
      if (found[axis] < 0 || element.properties[static_cast<std::size_t>(found[axis])].isList) return false;
    }
    for (std::size_t axis = 0; axis < 3; ++axis) want(found[axis], {to ? to + axis : nullptr, 3});
    return true;
  }

  /// Whole numbers count from 0 to the most their type holds, others from 0 to 1. Equal colours become one.
  void takeColors(const std::vector<Vec3f>& colors, Type type) {
    const double scale = type == Type::uint8 ? 1.0 / 255 : type == Type::uint16 ? 1.0 / 65535 : 1;
    const auto most = static_cast<float>(1 / scale);
    const auto outside = std::count_if(colors.begin(), colors.end(), [&](const Vec3f& c) {
      return !(min(c.x, min(c.y, c.z)) >= 0 && max(c.x, max(c.y, c.z)) <= most);
    });
    if (outside > 0)
      messages_.warn(place(),
                     "colours that are not from 0 to " + toText(1 / scale) + ": " + std::to_string(outside));
    Unique<Vec3f> unique;
    for (const Vec3f& color : colors) mesh_.materials.push_back(unique.number(color));
    for (const Vec3f& color : unique.keys()) {
      model_.colors.push_back({color.x * scale, color.y * scale, color.z * scale});
      if (!isFinite(model_.colors.back())) fail("expected colours that are finite numbers");
    }
  }

  // --- faces ---

  int listOf(const Element& element) {
    hasFaces_ = true;
    if (!hasVertices_) fail("expected the vertices before the faces");
    const int list = element.find({"vertex_indices", "vertex_index"});
    if (list < 0 || !element.properties[static_cast<std::size_t>(list)].isList)
      fail("expected faces with a list \"vertex_indices\"");
    return list;
  }

  void readFaces(const Element& element) {
    const int list = listOf(element);
    body_.checkCount(element);
    mesh_.triangles.reserve(element.count);
    std::size_t row = 0, unusable = 0;
    body_.readLists(element, list, [&](std::span<const std::uint32_t> corners) {
      for (std::uint32_t corner : corners) check(corner, "face", row);
      if (corners.size() == 3)
        mesh_.triangles.push_back({corners[0], corners[1], corners[2]});
      else if (corners.size() > 3)
        appendPolygon(mesh_, corners);
      else
        ++unusable;
      ++row;
    });
    if (unusable > 0)
      messages_.warn(place(), "faces of fewer than 3 points are left out: " + std::to_string(unusable));
  }

  /// Strips of triangles that turn about, each ended by -1, as scanners write them.
  void readStrips(const Element& element) {
    std::size_t row = 0;
    body_.readLists(element, listOf(element), [&](std::span<const std::uint32_t> points) {
      std::size_t start = 0;
      for (std::size_t i = 0; i < points.size(); ++i) {
        if (points[i] == 0xffffffff) {
          start = i + 1;
          continue;
        }
        check(points[i], "strip", row);
        if (i < start + 2) continue;
        const bool turned = (i - start) % 2 == 1;
        mesh_.triangles.push_back({points[i - 2], points[turned ? i : i - 1], points[turned ? i - 1 : i]});
      }
      ++row;
    });
  }

  void check(std::uint32_t point, const char* what, std::size_t row) const {
    if (point < mesh_.points.size()) return;
    const std::string name =
        point >= 0x80000000 ? "a number that no point has" : "point " + std::to_string(point);
    body_.fail(what + (" " + std::to_string(row)) + " uses " + name + " but the mesh has " +
               std::to_string(mesh_.points.size()) + " points, counted from 0");
  }

  Place place() const { return {file_, 0, 0, {}}; }
  [[noreturn]] void fail(std::string what) const { throw Error(Fault::scene, place(), std::move(what)); }

  const std::string& file_;
  Messages& messages_;
  Header header_;
  Body body_;
  std::vector<Column> columns_;
  MeshData mesh_;
  Model model_;
  UnusedTextures textures_;
  bool hasVertices_ = false, hasFaces_ = false;
};

}  // namespace

bool recognisesPly(std::string_view bytes) {
  return bytes.starts_with("ply\n") || bytes.starts_with("ply\r") || bytes.starts_with("ply ");
}

Model readPly(const std::string& file, std::string_view bytes, Messages& messages) {
  return PlyReader(file, bytes, messages).read();
}

}  // namespace trace
