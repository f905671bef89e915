// The meaning of PLY files: which elements and properties make a mesh. Those not known are skipped.
#include "formats/mesh/ply_format.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <optional>
#include <utility>

#include "base/text.h"
#include "base/unique.h"
#include "formats/mesh/ply_syntax.h"
#include "formats/model_textures.h"
#include "formats/text_front.h"
#include "formats/warnings.h"
#include "formats/words.h"
#include "geometry/mesh/mesh.h"
#include "geometry/mesh/mesh_repair.h"
#include "shading/textures/image_map.h"

namespace trace {
namespace {

using namespace ply;

/// A face that waits until all is read: a part of the list of corners, the number of its row, and the byte.
struct Face {
  std::size_t first, count, number, row;
};

/// The data that make two corners the same point.
struct SplitCorner {
  std::uint32_t point, color;
  float u, v;
};

class PlyReader {
 public:
  PlyReader(const std::string& file, std::string_view bytes, Messages& messages)
      : file_(file),
        bytes_(bytes),
        messages_(messages),
        header_(readHeader(file, bytes)),
        body_(file, bytes, header_) {}

  Model read() {
    for (const auto& [word, where] : header_.unknown)
      warnings_.warn(where, "a line of the header is no comment, and is ignored: \"" + word + "\"", {},
                     "header");
    for (const Element& element : header_.elements)
      if (sameWord(element.name, "vertex")) vertices_ = element.count;
    for (const Element& element : header_.elements) {
      if (sameWord(element.name, "vertex")) {
        readVertices(element);
      } else if (sameWord(element.name, "face")) {
        readFaces(element);
      } else if (sameWord(element.name, "tristrips")) {
        readStrips(element);
      } else {
        body_.skip(element);
        if (element.count > 0)
          warnings_.warn(element.place, "elements \"" + element.name.substr(0, 40) +
                                            "\" are not shown: " + std::to_string(element.count));
      }
    }
    if (!hasVertices_) fail("expected an element \"vertex\"");
    if (!hasFaces_)
      fail("expected an element \"face\" or \"tristrips\": this file holds points, and no surface");
    build();
    if (const std::size_t left = body_.left(); left > 0)
      messages_.warn(body_.nextPlace(), "bytes after the last element are ignored: " + std::to_string(left));
    if (body_.surplus() > 0)
      messages_.warn(body_.firstSurplus(),
                     "expected as many values as the header says, found more; they are ignored (in " +
                         counted(body_.surplus(), "line") + ", first here)");
    if (body_.wrongWords() > 0)
      messages_.warn(body_.firstWrong().place, body_.firstWrong().what + "; what uses it is left out (" +
                                                   counted(body_.wrongWords(), "word") + ", first here)");
    if (lost_ && mesh_.triangles.empty()) throw Error(Fault::scene, lost_->place, lost_->what);
    warnings_.report(messages_);
    const auto find = [this](MeshPart part, std::size_t i) { return spotOf(part, i); };
    addOnlyMesh(model_, std::move(mesh_), repairs_, find, place(), messages_);
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

  /// Where a triangle, or what belongs to a point, is in the file.
  MeshSpot spotOf(MeshPart part, std::size_t index) const {
    if (part == MeshPart::triangle) return spotAt(faceOf_[index]);
    return pointSpot(splitFrom_.empty() ? index : splitFrom_[index]);
  }
  MeshSpot pointSpot(std::size_t point) const {
    return spotAt(beforePoints_->startOfRow(*pointElement_, point));
  }
  MeshSpot spotAt(std::size_t byte) const {
    if (body_.isText()) return {placeAt(file_, bytes_, byte)};
    return {place(), "byte " + std::to_string(byte) + " of the file"};
  }

  // --- points ---

  void readVertices(const Element& element) {
    if (std::exchange(hasVertices_, true)) fail("expected one element \"vertex\", found two");
    body_.checkCount(element);
    beforePoints_.emplace(body_);
    pointElement_ = &element;
    for (const auto& names : {std::array{"nx", "ny", "nz"}, std::array{"red", "green", "blue"}}) {
      const auto has = [&](const char* name) { return element.find({name}) >= 0; };
      const auto count = std::count_if(names.begin(), names.end(), has);
      if (count == 1 || count == 2)
        messages_.warn(element.place, std::string("expected all of ") + names[0] + ", " + names[1] + " and " +
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
    const bool colored = element.count && wantVector(element, kColors, &colors[0].x);
    std::vector<float> alpha;
    if (const int a = element.find({"alpha"}); colored && a >= 0) {
      alpha.resize(element.count);
      want(a, {alpha.data(), 1});
    }
    const int u = element.find({"u", "s", "texture_u", "tx"}),
              v = element.find({"v", "t", "texture_v", "ty"});
    std::vector<float> uvs(u >= 0 && v >= 0 ? 2 * element.count : 0);
    if (!uvs.empty()) {
      want(u, {&uvs[0], 2});
      want(v, {&uvs[1], 2});
    }

    noteUnused(element, columns_);
    body_.readColumns(element, columns_);
    for (std::size_t i = 0; i < uvs.size(); i += 2) mesh_.uvs.push_back({uvs[i], uvs[i + 1]});
    if (colored)
      mesh_.materials = palette(colors, propertyOf(element, kColors[0]),
                                [this](std::size_t point) { return pointSpot(point); });
    if (!alpha.empty()) noteAlpha(element, alpha);
  }

  /// Warns of the properties that nothing was made of; `used` are others than those of the columns.
  void noteUnused(const Element& element, std::span<const Column> columns,
                  std::initializer_list<int> used = {}) {
    std::string names;
    const Property* first = nullptr;
    for (std::size_t i = 0; i < columns.size() && element.count > 0; ++i) {
      const bool isUsed = columns[i].to || element.properties[i].name == "texnumber" ||
                          std::find(used.begin(), used.end(), static_cast<int>(i)) != used.end();
      if (isUsed) continue;
      if (!first) first = &element.properties[i];
      names += (names.empty() ? "" : ", ") + element.properties[i].name.substr(0, 40);
    }
    if (first)
      warnings_.warn(first->place,
                     "properties of \"" + element.name.substr(0, 40) + "\" are not shown: " + names);
  }

  /// Precondition: it has one of these names.
  static const Property& propertyOf(const Element& element, const std::vector<std::string_view>& names) {
    return element.properties[static_cast<std::size_t>(element.find(names))];
  }

  void want(int property, Column column) { columns_[static_cast<std::size_t>(property)] = column; }

  using Names = std::array<std::vector<std::string_view>, 3>;
  const Names kColors{
      {{"red", "r", "diffuse_red"}, {"green", "g", "diffuse_green"}, {"blue", "b", "diffuse_blue"}}};

  bool wantVector(const Element& element, const Names& names, float* to) {
    int found[3];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      found[axis] = element.find(names[axis]);
      if (found[axis] < 0 || element.properties[static_cast<std::size_t>(found[axis])].isList) return false;
    }
    for (std::size_t axis = 0; axis < 3; ++axis) want(found[axis], {to ? to + axis : nullptr, 3});
    return true;
  }

  /// Whole numbers count from 0 to the most their type holds, others from 0 to 1. Equal colours become one.
  /// The number of each in the model's colours.
  template <class SpotOf>
  std::vector<std::uint32_t> palette(std::vector<Vec3f>& colors, const Property& property,
                                     const SpotOf& spotOf) {
    const Type type = property.type;
    const double scale = type == Type::uint8 ? 1.0 / 255 : type == Type::uint16 ? 1.0 / 65535 : 1;
    const auto most = static_cast<float>(1 / scale);
    repairs_.checkColors(
        colors, [&](MeshPart, std::size_t i) { return spotOf(i); }, most);
    const auto outside = std::count_if(colors.begin(), colors.end(), [&](const Vec3f& c) {
      return !(min(c.x, min(c.y, c.z)) >= 0 && max(c.x, max(c.y, c.z)) <= most);
    });
    if (outside > 0)
      messages_.warn(property.place,
                     "colours that are not from 0 to " + toText(1 / scale) + ": " + std::to_string(outside));
    Unique<Vec3f> unique;
    std::vector<std::uint32_t> numbers;
    numbers.reserve(colors.size());
    for (const Vec3f& color : colors) numbers.push_back(unique.number(color));
    for (const Vec3f& color : unique.keys())
      model_.colors.push_back({color.x * scale, color.y * scale, color.z * scale});
    return numbers;
  }

  /// Warns of transparency, which the mesh has no place for, if there is any.
  void noteAlpha(const Element& element, const std::vector<float>& alpha) {
    const Property& property = propertyOf(element, {"alpha"});
    const Type type = property.type;
    const float most = type == Type::uint8 ? 255 : type == Type::uint16 ? 65535 : 1;
    const auto clear = std::count_if(alpha.begin(), alpha.end(), [&](float a) { return a < most; });
    if (clear > 0)
      warnings_.warn(property.place, "the transparency of elements \"" + element.name +
                                         "\" is left out: " + std::to_string(clear));
  }

  // --- faces ---

  int listOf(const Element& element) {
    hasFaces_ = true;
    const int list = element.find({"vertex_indices", "vertex_index"});
    if (list < 0 || !element.properties[static_cast<std::size_t>(list)].isList)
      fail("expected faces with a list \"vertex_indices\"");
    return list;
  }

  void readFaces(const Element& element) {
    Body::Lists lists{listOf(element)};
    body_.checkCount(element);
    std::vector<Column> columns(element.properties.size());
    columns_.swap(columns);
    std::vector<Vec3f> colors(element.count);
    std::vector<float> alpha;
    hasFaceColors_ = element.count > 0 && wantVector(element, kColors, &colors[0].x);
    if (const int a = element.find({"alpha"}); a >= 0 && hasFaceColors_) {
      alpha.resize(element.count);
      want(a, {alpha.data(), 1});
    }
    columns_.swap(columns);
    lists.columns = columns;
    lists.numbers = element.find({"texcoord", "texcoords", "texture_uvs"});
    if (lists.numbers >= 0 && !element.properties[static_cast<std::size_t>(lists.numbers)].isList)
      lists.numbers = -1;
    if (const int number = element.find({"texnumber"}); number >= 0 && header_.textures.size() > 1)
      warnings_.warn(element.properties[static_cast<std::size_t>(number)].place,
                     "faces of several textures show the first: texnumber is ignored");
    noteUnused(element, columns, {lists.items, lists.numbers});
    hasFaceUvs_ = lists.numbers >= 0;
    const bool direct = hasVertices_ && !hasFaceUvs_ && !hasFaceColors_;
    if (direct) {
      mesh_.triangles.reserve(element.count);
      faceOf_.reserve(element.count);
    }
    std::size_t row = 0;
    const Body before = body_;
    body_.readLists(element, lists, [&](std::span<const std::uint32_t> corners, std::span<const float> uvs) {
      const std::size_t number = row++;
      if (!isGood(corners, number)) return;
      if (!direct) return keep(corners, uvs, number);
      if (corners.size() == 3) {
        mesh_.triangles.push_back({corners[0], corners[1], corners[2]});
        return faceOf_.push_back(body_.row());
      }
      appendPolygon(mesh_, corners);
      faceOf_.resize(mesh_.triangles.size(), body_.row());
    });
    if (unusable_ > 0)
      messages_.warn(firstUnusable_,
                     "faces of fewer than 3 points are left out: " + std::to_string(unusable_));
    if (hasFaceColors_) {
      faceColorsAt_ = propertyOf(element, kColors[0]).place;
      faceColors_ = palette(colors, propertyOf(element, kColors[0]),
                            [&](std::size_t face) { return spotAt(before.startOfRow(element, face)); });
      if (!alpha.empty()) noteAlpha(element, alpha);
    }
  }

  bool isGood(std::span<const std::uint32_t> corners, std::size_t number) {
    if (corners.size() < 3) {
      if (unusable_++ == 0) firstUnusable_ = body_.place();
      return false;
    }
    for (const std::uint32_t corner : corners)
      if (corner >= vertices_) {
        lose(corner, "face", number);
        return false;
      }
    return true;
  }

  void keep(std::span<const std::uint32_t> corners, std::span<const float> uvs, std::size_t number) {
    faces_.push_back({corners_.size(), corners.size(), number, body_.row()});
    corners_.insert(corners_.end(), corners.begin(), corners.end());
    if (!hasFaceUvs_) return;
    const bool fits = uvs.size() == 2 * corners.size();
    if (!fits && !uvs.empty() && wrongUvs_++ == 0) firstWrongUvs_ = body_.place();
    for (std::size_t i = 0; i < corners.size(); ++i)
      cornerUvs_.push_back(fits ? Vec2{uvs[2 * i], uvs[2 * i + 1]} : Vec2{});
  }

  /// Makes the faces that had to wait, for the points or since they have uv or colours of their own: then
  /// each corner is a point for itself, unless it is the same as another.
  void build() {
    if (wrongUvs_ > 0)
      warnings_.warn(firstWrongUvs_, "faces without a uv for each corner show the corner of the picture: " +
                                         std::to_string(wrongUvs_));
    if (hasFaceColors_ && !mesh_.materials.empty()) {
      hasFaceColors_ = false;
      warnings_.warn(faceColorsAt_, "colours of faces are left out: their points have some");
    }
    if (!hasFaceUvs_ && !hasFaceColors_) {
      for (const Face& face : faces_) {
        appendPolygon(mesh_, std::span(corners_).subspan(face.first, face.count));
        faceOf_.resize(mesh_.triangles.size(), face.row);
      }
      return;
    }
    MeshData split;
    std::vector<std::size_t> rows;
    Unique<SplitCorner> corners;
    std::vector<std::uint32_t> polygon;
    for (const Face& face : faces_) {
      polygon.clear();
      for (std::size_t i = face.first; i < face.first + face.count; ++i) {
        const std::uint32_t point = corners_[i];
        const Vec2 uv = hasFaceUvs_ ? cornerUvs_[i] : mesh_.uvs.empty() ? Vec2{} : mesh_.uvs[point];
        const std::uint32_t color = hasFaceColors_            ? faceColors_[face.number]
                                    : mesh_.materials.empty() ? 0
                                                              : mesh_.materials[point];
        const std::uint32_t number =
            corners.number({point, color, static_cast<float>(uv.x), static_cast<float>(uv.y)});
        polygon.push_back(number);
        if (number < split.points.size()) continue;
        split.points.push_back(mesh_.points[point]);
        splitFrom_.push_back(point);
        if (!mesh_.normals.empty()) split.normals.push_back(mesh_.normals[point]);
        if (hasFaceUvs_ || !mesh_.uvs.empty()) split.uvs.push_back(uv);
        if (hasFaceColors_ || !mesh_.materials.empty()) split.materials.push_back(color);
      }
      appendPolygon(split, polygon);
      rows.resize(split.triangles.size(), face.row);
    }
    if (!mesh_.triangles.empty())
      warnings_.warn(place(), "strips beside faces with colours or uv are left out");
    mesh_ = std::move(split);
    faceOf_ = std::move(rows);
  }

  /// Strips of triangles that turn about, each ended by -1, as scanners write them.
  void readStrips(const Element& element) {
    std::size_t row = 0;
    const auto strip = [&](std::span<const std::uint32_t> points, std::span<const float>) {
      std::size_t start = 0;
      for (std::size_t i = 0; i < points.size(); ++i) {
        if (points[i] >= vertices_) {
          if (points[i] != 0xffffffff) lose(points[i], "strip", row);
          start = i + 1;
          continue;
        }
        if (i < start + 2) continue;
        const bool turned = (i - start) % 2 == 1;
        mesh_.triangles.push_back({points[i - 2], points[turned ? i : i - 1], points[turned ? i - 1 : i]});
      }
      faceOf_.resize(mesh_.triangles.size(), body_.row());
      ++row;
    };
    body_.readLists(element, {listOf(element)}, strip);
  }

  /// Notes a face or a part of a strip that uses a point which is not there.
  void lose(std::uint32_t point, const char* what, std::size_t row) {
    if (warnings_.again("lost")) return;
    const std::string name =
        point >= 0x80000000 ? "a number that no point has" : "point " + std::to_string(point);
    const std::string text = what + (" " + std::to_string(row)) + " uses " + name + " but the mesh has " +
                             std::to_string(vertices_) + " points, counted from 0";
    lost_ = Message{Message::Severity::error, body_.place(), text, {}};
    warnings_.warn(body_.place(), text + "; it is left out", {}, "lost");
  }

  SourcePlace place() const { return {file_, 0, 0, {}}; }
  [[noreturn]] void fail(std::string what) const { throw Error(Fault::scene, place(), std::move(what)); }

  const std::string& file_;
  std::string_view bytes_;
  Messages& messages_;
  Header header_;
  Body body_;
  std::vector<Column> columns_;
  MeshData mesh_;
  Model model_;
  UnusedTextures textures_;
  WarningsByKind warnings_;
  std::optional<Message> lost_;  ///< the first that costs a face
  std::size_t vertices_ = 0;     ///< that the header counts
  std::size_t unusable_ = 0, wrongUvs_ = 0;
  SourcePlace firstUnusable_{}, firstWrongUvs_{}, faceColorsAt_{};
  bool hasVertices_ = false, hasFaces_ = false, hasFaceColors_ = false, hasFaceUvs_ = false;
  MeshRepairs repairs_;
  std::optional<Body> beforePoints_;  ///< at their first row
  const Element* pointElement_ = nullptr;
  std::vector<std::size_t> faceOf_;       ///< the byte of the row of each triangle
  std::vector<std::uint32_t> splitFrom_;  ///< the points of the file, where corners became points
  std::vector<Face> faces_;               ///< that wait
  std::vector<std::uint32_t> corners_, faceColors_;
  std::vector<Vec2> cornerUvs_;
};

}  // namespace

bool recognisesPly(std::string_view bytes) { return beginsWithWord(bytes, "ply"); }

Model readPly(const std::string& file, std::string_view bytes, Messages& messages) {
  return PlyReader(file, bytes, messages).read();
}

}  // namespace trace
