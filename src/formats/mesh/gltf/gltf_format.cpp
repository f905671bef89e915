// Nodes and meshes of a glTF file. Every index and range is checked here or before (gltf_file.cpp).
#include "formats/mesh/gltf/gltf_format.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "base/files/file.h"
#include "base/text.h"
#include "base/unique.h"
#include "formats/mesh/gltf/document/gltf_elements.h"
#include "formats/mesh/gltf/document/gltf_file.h"
#include "formats/mesh/gltf/gltf_looks.h"
#include "formats/mesh/gltf/gltf_material.h"
#include "formats/mesh/gltf/gltf_pose.h"
#include "formats/mesh/gltf/gltf_view.h"
#include "geometry/mesh/mesh.h"

namespace trace {
namespace {

// --- the reader -------------------------------------------------------------------------------------

class GltfReader {
 public:
  GltfReader(const std::string& file, std::string_view bytes, Messages& messages, SceneTime& time)
      : place_{file, 0, 0, {}},
        messages_(messages),
        gltf_(parsedGltf(file, bytes, place_, model_.inputs, messages)),
        looks_(gltf_, place_, messages) {
    for (const tinygltf::Image& image : gltf_.images)
      if (!image.uri.empty()) model_.inputs.noteNamed(besideFile(file, fileOf(image)));
    for (const tinygltf::Buffer& buffer : gltf_.buffers) allowance_ += kMostUses * buffer.data.size();
    const ReadAccessor read = [this](int accessor) { return elements(accessor); };
    play(time, read);
    pose_.emplace(gltf_, read, place_);
  }

  Model read() {
    model_.materials = looks_.materials();
    readNodes();
    for (const Vec3f& color : colors_.keys()) model_.colors.push_back({color.x, color.y, color.z});
    repairs_.report(place_, messages_);
    looks_.report();
    const auto warn = [&](const char* what, std::size_t count) {
      if (count > 0) messages_.warn(place_, std::string(what) + ": " + std::to_string(count));
    };
    warn("points and lines are left out", lines_);
    warn("the picture is seen through the first camera; others are left out", otherCameras_);
    warn("the transparency of COLOR_0 is left out", clearColors_);
    warn("triangles that use points which are not there are left out", lostTriangles_);
    warn("meshes without the texture coordinates of their pictures show the top left corner", withoutUvs_);
    warn("tangents that do not lie along the texture coordinates are not shown: triangles", foreignTangents_);
    warn("corners at the end of a mesh that make no whole triangle are left out", leftOver_);
    warn("joints of points that their skin does not have are left out", pose_->lostJoints());
    warn("objects are left out whose transform makes them flat, or infinitely large or small", flat_);
    model_.saysSides = true;
    model_.choices.push_back({"transfer", "srgb", place_});  // its colours are linear light
    return std::move(model_);
  }

 private:
  /// The number of meshes that may use each byte: a small file must not become a huge scene.
  static constexpr std::uint64_t kMostUses = 100;
  static constexpr std::uint32_t kNoPoint = 0xffffffff;

  [[noreturn]] void fail(std::string what) const { throw Error(Fault::scene, place_, std::move(what)); }

  // --- nodes ---

  /// An animation that is not as it should be costs itself.
  void play(SceneTime& time, const ReadAccessor& elements) {
    const std::vector<tinygltf::Node> atRest = gltf_.nodes;
    try {
      model_.keys = animate(gltf_, time, elements, place_);
    } catch (const Error& error) {
      if (error.fault() != Fault::scene) throw;
      gltf_.nodes = atRest;
      messages_.warn(place_, error.messages().front().what + "; no animation is played");
    }
  }

  void readNodes() {
    struct Waiting {
      int node, parent;
      Affine worldFromParent;
    };
    constexpr int kScene = -1;
    std::vector<Waiting> waiting;
    for (int root : roots()) waiting.push_back({root, kScene, {}});
    std::reverse(waiting.begin(), waiting.end());
    std::vector<std::optional<int>> parents(gltf_.nodes.size());
    const auto nameOf = [](int parent) {
      return parent == kScene ? "the scene" : "nodes[" + std::to_string(parent) + "]";
    };
    while (!waiting.empty()) {
      const auto [index, parent, worldFromParent] = waiting.back();
      waiting.pop_back();
      if (!isIndex(index, gltf_.nodes.size())) fail("there is no node " + std::to_string(index));
      const auto number = static_cast<std::size_t>(index);
      if (parents[number])
        fail("nodes[" + std::to_string(index) + "]: expected one parent, found two, " +
             nameOf(*parents[number]) + " and " + nameOf(parent));
      parents[number] = parent;
      const tinygltf::Node& node = gltf_.nodes[number];
      const Affine worldFromNode = worldFromParent * transformOf(node);
      read(node, worldFromNode);
      for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
        waiting.push_back({*child, index, worldFromNode});
    }
  }

  /// The roots of the scene to be shown; all nodes without a parent if there is no scene.
  std::vector<int> roots() const {
    const int scene = std::max(gltf_.defaultScene, 0);
    if (isIndex(scene, gltf_.scenes.size())) return gltf_.scenes[static_cast<std::size_t>(scene)].nodes;
    std::vector<bool> isChild(gltf_.nodes.size());
    for (const tinygltf::Node& node : gltf_.nodes)
      for (int child : node.children)
        if (isIndex(child, isChild.size())) isChild[static_cast<std::size_t>(child)] = true;
    std::vector<int> all;
    for (std::size_t i = 0; i < isChild.size(); ++i)
      if (!isChild[i]) all.push_back(static_cast<int>(i));
    return all;
  }

  void read(const tinygltf::Node& node, const Affine& worldFromNode) {
    if (isIndex(node.camera, gltf_.cameras.size()) && model_.camera)
      ++otherCameras_;
    else if (isIndex(node.camera, gltf_.cameras.size()))
      readCamera(gltf_.cameras[static_cast<std::size_t>(node.camera)], worldFromNode, place_, model_,
                 messages_);
    const double light = extension(node.extensions, "KHR_lights_punctual", "light", -1);
    if (light >= 0 && light < static_cast<double>(gltf_.lights.size()))
      readLight(gltf_.lights[static_cast<std::size_t>(light)], worldFromNode, place_, model_, messages_);
    if (node.mesh < 0) return;
    if (!isIndex(node.mesh, gltf_.meshes.size())) fail("there is no mesh " + std::to_string(node.mesh));
    const std::string& name =
        node.name.empty() ? gltf_.meshes[static_cast<std::size_t>(node.mesh)].name : node.name;
    const std::vector<Object> parts =
        pose_->bends(node) ? partsOf(node.mesh, &node) : sharedPartsOf(node.mesh);
    const Affine worldFromMesh = pose_->isInWorld(node) ? Affine{} : worldFromNode;
    for (const Affine& meshFromCopy : instancesOf(
             node, [this](int i) { return elements(i); }, place_)) {
      const Affine worldFromCopy = worldFromMesh * meshFromCopy;
      if (!invertible(worldFromCopy)) {
        flat_ += parts.size();
        continue;
      }
      for (const Object& part : parts) {
        model_.objects.push_back(part);
        model_.objects.back().name = name;
        model_.objects.back().worldFromObject = worldFromCopy;
      }
    }
  }

  // --- meshes ---

  const std::vector<Object>& sharedPartsOf(int mesh) {
    const auto [found, fresh] = parts_.try_emplace(mesh);
    if (fresh) found->second = partsOf(mesh, nullptr);
    return found->second;
  }

  /// Bent as the node says, if there is one.
  std::vector<Object> partsOf(int mesh, const tinygltf::Node* node) {
    std::vector<Object> parts;
    for (const tinygltf::Primitive& primitive : gltf_.meshes[static_cast<std::size_t>(mesh)].primitives)
      if (auto data = meshOf(primitive, node); !data.triangles.empty())
        parts.push_back({"",
                         Mesh{std::make_shared<const MeshData>(std::move(data))},
                         {},
                         isIndex(primitive.material, gltf_.materials.size())
                             ? static_cast<std::uint32_t>(primitive.material)
                             : Model::kNoMaterial,
                         place_});
    return parts;
  }

  GltfElements elements(int accessor) {
    const GltfElements result(gltf_, accessor, place_);
    if (result.bytes() > allowance_) fail("the same data is used too often, in more than 100 meshes");
    allowance_ -= result.bytes();
    return result;
  }

  /// The vectors of an attribute, if the primitive has it.
  std::vector<Vec3f> vectors(const tinygltf::Primitive& primitive, const char* name, std::size_t count) {
    std::vector<Vec3f> result;
    const auto found = primitive.attributes.find(name);
    if (found == primitive.attributes.end()) return result;
    const GltfElements from = elements(found->second);
    if (from.components() < 3 || (count > 0 && from.count() != count))
      fail(std::string(name) + ": expected one vector for each point");
    for (std::size_t i = 0; i < from.count(); ++i) result.push_back(from.vector(i));
    return result;
  }

  MeshData meshOf(const tinygltf::Primitive& primitive, const tinygltf::Node* node) {
    MeshData mesh;
    const bool triangles = primitive.mode == TINYGLTF_MODE_TRIANGLES || primitive.mode == -1;
    const bool strip = primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP,
               fan = primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN;
    if (!triangles && !strip && !fan) {
      ++lines_;
      return mesh;
    }
    mesh.points = vectors(primitive, "POSITION", 0);
    if (mesh.points.empty()) return mesh;
    mesh.normals = vectors(primitive, "NORMAL", mesh.points.size());
    if (node) pose_->bend(*node, primitive, mesh);
    readUvs(primitive, mesh);
    readColors(primitive, mesh);

    const std::vector<std::uint32_t> corners = cornersOf(primitive, mesh.points.size());
    leftOver_ += triangles ? corners.size() % 3 : 0;
    for (std::size_t i = 2; i < corners.size(); i += triangles ? 3 : 1) {
      const bool turned = strip && i % 2 == 1;
      const std::uint32_t a = corners[fan ? 0 : i - 2], b = corners[i - 1], c = corners[i];
      if (a != kNoPoint && b != kNoPoint && c != kNoPoint)
        mesh.triangles.push_back({turned ? b : a, turned ? a : b, c});
      else
        ++lostTriangles_;
    }
    if (mesh.triangles.empty() && !wrongCorner_.empty()) fail(wrongCorner_);
    noteTangents(primitive, mesh);
    repairs_.check(mesh, place_);
    return mesh;
  }

  /// Normal maps lie as the texture coordinates say. Exporters compute tangents from those: only others would
  /// change the picture.
  void noteTangents(const tinygltf::Primitive& primitive, const MeshData& mesh) {
    const auto found = primitive.attributes.find("TANGENT");
    if (found == primitive.attributes.end() || !isIndex(primitive.material, gltf_.materials.size())) return;
    const tinygltf::NormalTextureInfo& map =
        gltf_.materials[static_cast<std::size_t>(primitive.material)].normalTexture;
    const auto [first, second] = looks_.uvSets(primitive.material);
    if (map.index < 0 || (first != map.texCoord && second != map.texCoord)) return;
    const std::vector<Vec3f> points = vectors(primitive, "POSITION", 0);  // before they are bent
    const GltfElements tangents = elements(found->second);
    const bool fit = tangents.components() == 4 && tangents.count() == points.size();
    constexpr std::size_t kFew = 50;  // one in so many may be at a seam
    const std::size_t others =
        fit ? foreignTangents(points, first == map.texCoord ? mesh.uvs : mesh.secondUvs, mesh, tangents)
            : mesh.triangles.size();
    if (others > mesh.triangles.size() / kFew) foreignTangents_ += others;
  }

  /// How many triangles have tangents of another direction, or handedness, than their texture coordinates.
  static std::size_t foreignTangents(const std::vector<Vec3f>& points, const std::vector<Vec2>& uvs,
                                     const MeshData& mesh, const GltfElements& tangents) {
    constexpr Real kClose = 0.5;  // cosine: tangents are means over several faces
    std::size_t count = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
      const Vec3 ab = Vec3(points[b]) - Vec3(points[a]), ac = Vec3(points[c]) - Vec3(points[a]);
      const Real ub = uvs[b].x - uvs[a].x, vb = uvs[b].y - uvs[a].y, uc = uvs[c].x - uvs[a].x,
                 vc = uvs[c].y - uvs[a].y, turn = ub * vc - uc * vb;
      const Vec3 along = (ab * vc - ac * vb) * (turn < 0 ? -1 : 1);
      const auto isOther = [&](std::uint32_t point) {
        const Vec3 tangent(tangents.vector(point));
        return dot(tangent, along) < kClose * length(tangent) * length(along) ||
               (tangents.number(point, 3) < 0) != (turn < 0);
      };
      const bool hasDirection = turn != 0 && along != Vec3{};
      count += hasDirection && isOther(a) && isOther(b) && isOther(c);
    }
    return count;
  }

  std::vector<std::uint32_t> cornersOf(const tinygltf::Primitive& primitive, std::size_t points) {
    std::vector<std::uint32_t> corners;
    if (primitive.indices < 0) {
      for (std::uint32_t i = 0; i < points; ++i) corners.push_back(i);
      return corners;
    }
    const GltfElements from = elements(primitive.indices);
    corners.reserve(from.count());
    for (std::size_t i = 0; i < from.count(); ++i) {
      const double corner = from.number(i, 0);
      if (!(corner >= 0 && corner < static_cast<double>(points)))
        wrongCorner_ = "a triangle uses point " + toText(corner) + ", but the mesh has " +
                       counted(points, "point") + ", counted from 0";
      const bool isThere = corner >= 0 && corner < static_cast<double>(points);
      corners.push_back(isThere ? static_cast<std::uint32_t>(corner) : kNoPoint);
    }
    return corners;
  }

  void readUvs(const tinygltf::Primitive& primitive, MeshData& mesh) {
    const auto [first, second] = looks_.uvSets(primitive.material);
    mesh.uvs = uvsOf(primitive, first.value_or(0), mesh.points.size());
    if (second) mesh.secondUvs = uvsOf(primitive, *second, mesh.points.size());
    const bool lacks = (first && mesh.uvs.empty()) || (second && mesh.secondUvs.empty());
    withoutUvs_ += lacks;
    for (auto* uvs : {first ? &mesh.uvs : nullptr, second ? &mesh.secondUvs : nullptr})
      if (uvs && uvs->empty()) uvs->assign(mesh.points.size(), {0, 1});
  }

  /// None if the primitive lacks them. The origin of glTF's is at the top, of Trace's at the bottom.
  std::vector<Vec2> uvsOf(const tinygltf::Primitive& primitive, int set, std::size_t points) {
    const std::string name = "TEXCOORD_" + std::to_string(set);
    const auto found = primitive.attributes.find(name);
    std::vector<Vec2> uvs;
    if (found == primitive.attributes.end()) return uvs;
    const GltfElements from = elements(found->second);
    if (from.components() < 2 || from.count() != points) fail(name + ": expected one for each point");
    for (std::size_t i = 0; i < from.count(); ++i) uvs.push_back({from.number(i, 0), 1 - from.number(i, 1)});
    return uvs;
  }

  /// Times the base colour, as the specification says.
  void readColors(const tinygltf::Primitive& primitive, MeshData& mesh) {
    const std::vector<Vec3f> colors = vectors(primitive, "COLOR_0", mesh.points.size());
    if (colors.empty()) return;
    noteAlpha(primitive);
    const bool hasMaterial = isIndex(primitive.material, gltf_.materials.size());
    const Color base =
        hasMaterial ? baseColorOf(model_.materials[static_cast<std::size_t>(primitive.material)]) : Color(1);
    for (const Vec3f& c : colors) {
      if (!std::isfinite(c.x + c.y + c.z)) fail("COLOR_0: expected finite numbers");
      mesh.materials.push_back(colors_.number(Vec3f(Vec3{c.x * base.r, c.y * base.g, c.z * base.b})));
    }
  }

  /// Colours of points may be transparent where their material allows it.
  void noteAlpha(const tinygltf::Primitive& primitive) {
    if (!isIndex(primitive.material, gltf_.materials.size()) ||
        gltf_.materials[static_cast<std::size_t>(primitive.material)].alphaMode == "OPAQUE")
      return;
    const GltfElements from = elements(primitive.attributes.at("COLOR_0"));
    for (std::size_t i = 0; from.components() > 3 && i < from.count(); ++i)
      if (from.number(i, 3) < 1) return void(++clearColors_);
  }

  Place place_;
  Messages& messages_;
  Model model_;  // parsing notes files in it
  tinygltf::Model gltf_;
  std::optional<GltfPose> pose_;
  std::map<int, std::vector<Object>> parts_;  ///< parts of meshes without a skin
  std::uint64_t allowance_ = 1 << 20;         ///< bytes of accessors that may still be read
  Unique<Vec3f> colors_;
  MeshRepairs repairs_;
  GltfLooks looks_;
  std::size_t lines_ = 0;  ///< primitives that are no triangles
  std::size_t lostTriangles_ = 0;
  std::string wrongCorner_;  ///< what is wrong with the last triangle that was lost
  std::size_t withoutUvs_ = 0;
  std::size_t foreignTangents_ =
      0;                          ///< triangles with a normal map, whose tangents are not those of their uv
  std::size_t otherCameras_ = 0;  ///< behind the first
  std::size_t clearColors_ = 0;   ///< meshes with colours of points that are transparent
  std::size_t leftOver_ = 0;      ///< corners that make no triangle
  std::size_t flat_ = 0;          ///< objects that their transform makes flat
};

}  // namespace

bool recognisesGltf(std::string_view bytes) {
  if (isBinaryGltf(bytes)) return true;
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && bytes[first] == '{' &&
         bytes.find("\"asset\"") != std::string_view::npos;
}

Model readGltf(const std::string& file, std::string_view bytes, Messages& messages, SceneTime& time) {
  return GltfReader(file, bytes, messages, time).read();
}

}  // namespace trace
