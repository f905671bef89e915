// Nodes and meshes of a glTF file. Every index and range is checked here or before (gltf_file.cpp).
#include "formats/mesh/gltf/gltf_format.h"

#include <algorithm>
#include <cmath>
#include <functional>
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
    lines_.report("points and lines are left out", messages_);
    otherCameras_.report("the picture is seen through the first camera; others are left out", messages_);
    clearColors_.report("the transparency of COLOR_0 is left out", messages_);
    lostTriangles_.report("triangles that use points which are not there are left out", messages_);
    withoutUvs_.report("meshes without the texture coordinates of their pictures show the top left corner",
                       messages_);
    unusedTangents_.report("meshes have TANGENT but no NORMAL; their tangents are ignored", messages_);
    leftOver_.report("corners at the end of a mesh that make no whole triangle are left out", messages_);
    lostJoints_.report("joints of points that their skin does not have are left out", messages_);
    flat_.report("objects are left out whose transform makes them flat, or infinitely large or small",
                 messages_);
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
      where_ = "nodes[" + std::to_string(index) + "]";
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
      otherCameras_.add(1, here());
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
        flat_.add(parts.size(), here());
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
    const std::string nodeName = where_;
    const auto& primitives = gltf_.meshes[static_cast<std::size_t>(mesh)].primitives;
    for (std::size_t i = 0; i < primitives.size(); ++i) {
      const tinygltf::Primitive& primitive = primitives[i];
      where_ = "meshes[" + std::to_string(mesh) + "].primitives[" + std::to_string(i) + "]";
      if (auto data = meshOf(primitive, node); !data.triangles.empty())
        parts.push_back({"",
                         Mesh{std::make_shared<const MeshData>(std::move(data))},
                         {},
                         isIndex(primitive.material, gltf_.materials.size())
                             ? static_cast<std::uint32_t>(primitive.material)
                             : Model::kNoMaterial,
                         place_});
    }
    where_ = nodeName;
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
      lines_.add(1, here());
      return mesh;
    }
    mesh.points = vectors(primitive, "POSITION", 0);
    if (mesh.points.empty()) return mesh;
    mesh.normals = vectors(primitive, "NORMAL", mesh.points.size());
    readTangents(primitive, mesh);
    if (node) lostJoints_.add(pose_->bend(*node, primitive, mesh), here());
    readUvs(primitive, mesh);
    readColors(primitive, mesh);

    const std::vector<std::uint32_t> corners = cornersOf(primitive, mesh.points.size());
    leftOver_.add(triangles ? corners.size() % 3 : 0, here());
    std::vector<std::size_t> numbers;  // former index of each triangle
    std::size_t number = 0;
    for (std::size_t i = 2; i < corners.size(); i += triangles ? 3 : 1, ++number) {
      const bool turned = strip && i % 2 == 1;
      const std::uint32_t a = corners[fan ? 0 : i - 2], b = corners[i - 1], c = corners[i];
      if (a == kNoPoint || b == kNoPoint || c == kNoPoint) {
        lostTriangles_.add(1, [&] {
          return MeshSpot{place_, "triangle " + std::to_string(number) + " in " + where_};
        });
        continue;
      }
      mesh.triangles.push_back({turned ? b : a, turned ? a : b, c});
      numbers.push_back(number);
    }
    if (mesh.triangles.empty() && !wrongCorner_.empty()) fail(where_ + ": " + wrongCorner_);
    repairs_.check(mesh, [&](MeshPart part, std::size_t i) {
      return part == MeshPart::triangle
                 ? MeshSpot{place_, "triangle " + std::to_string(numbers[i]) + " in " + where_}
                 : elementSpot(primitive, part, i);
    });
    return mesh;
  }

  /// An element of an attribute of the primitive that is being read.
  MeshSpot elementSpot(const tinygltf::Primitive& primitive, MeshPart part, std::size_t index) const {
    const auto uvSet = looks_.uvSets(primitive.material)[0].value_or(0);
    const std::string attribute = part == MeshPart::point    ? "POSITION"
                                  : part == MeshPart::normal ? "NORMAL"
                                  : part == MeshPart::color  ? "COLOR_0"
                                                             : "TEXCOORD_" + std::to_string(uvSet);
    const auto found = primitive.attributes.find(attribute);
    const std::string accessor =
        found == primitive.attributes.end() ? "" : ", accessors[" + std::to_string(found->second) + "]";
    return {place_, "element " + std::to_string(index) + " of " + attribute + " in " + where_ + accessor};
  }

  /// Makes a spot of the node or primitive that is being read.
  std::function<MeshSpot()> here() const {
    return [this] { return MeshSpot{place_, where_}; };
  }

  /// Whether the material, or its clear coat, has one.
  bool hasNormalMap(int material) const {
    if (!isIndex(material, model_.materials.size())) return false;
    const auto& textures = model_.materials[static_cast<std::size_t>(material)].textures;
    return textureOf(textures, "bump") || textureOf(textures, "clearcoat_bump");
  }

  /// The frame of normal maps, where the file gives it. Without NORMAL it is to be ignored (section 3.7.2.1).
  void readTangents(const tinygltf::Primitive& primitive, MeshData& mesh) {
    const auto found = primitive.attributes.find("TANGENT");
    if (found == primitive.attributes.end() || !hasNormalMap(primitive.material)) return;
    if (mesh.normals.empty()) return unusedTangents_.add(1, here());
    const GltfElements from = elements(found->second);
    if (from.components() != 4 || from.count() != mesh.points.size())
      fail("TANGENT: expected one vector of four for each point");
    for (std::size_t i = 0; i < from.count(); ++i)
      mesh.tangents.push_back({from.vector(i), from.number(i, 3) < 0 ? -1.0f : 1.0f});
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
    withoutUvs_.add(lacks, here());
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
    std::vector<Vec3f> colors = vectors(primitive, "COLOR_0", mesh.points.size());
    if (colors.empty()) return;
    repairs_.checkColors(colors,
                         [&](MeshPart part, std::size_t i) { return elementSpot(primitive, part, i); });
    noteAlpha(primitive);
    const bool hasMaterial = isIndex(primitive.material, gltf_.materials.size());
    const Color base =
        hasMaterial ? baseColorOf(model_.materials[static_cast<std::size_t>(primitive.material)]) : Color(1);
    for (const Vec3f& c : colors)
      mesh.materials.push_back(colors_.number(Vec3f(Vec3{c.x * base.r, c.y * base.g, c.z * base.b})));
  }

  /// Colours of points may be transparent where their material allows it.
  void noteAlpha(const tinygltf::Primitive& primitive) {
    if (!isIndex(primitive.material, gltf_.materials.size()) ||
        gltf_.materials[static_cast<std::size_t>(primitive.material)].alphaMode == "OPAQUE")
      return;
    const GltfElements from = elements(primitive.attributes.at("COLOR_0"));
    for (std::size_t i = 0; from.components() > 3 && i < from.count(); ++i)
      if (from.number(i, 3) < 1) return clearColors_.add(1, here());
  }

  SourcePlace place_;
  Messages& messages_;
  Model model_;  // parsing notes files in it
  tinygltf::Model gltf_;
  std::optional<GltfPose> pose_;
  std::map<int, std::vector<Object>> parts_;  ///< parts of meshes without a skin
  std::uint64_t allowance_ = 1 << 20;         ///< bytes of accessors that may still be read
  Unique<Vec3f> colors_;
  MeshRepairs repairs_;
  GltfLooks looks_;
  std::string where_;          ///< the node or primitive that is being read
  std::string wrongCorner_;    ///< what is wrong with the last triangle that was lost
  CountedFlaw lines_;          ///< primitives that are no triangles
  CountedFlaw lostTriangles_;  ///< that use a point which is not there
  CountedFlaw withoutUvs_;
  CountedFlaw unusedTangents_;
  CountedFlaw otherCameras_;  ///< behind the first
  CountedFlaw clearColors_;   ///< meshes with colours of points that are transparent
  CountedFlaw leftOver_;      ///< corners that make no triangle
  CountedFlaw lostJoints_;    ///< that a point names and its skin lacks
  CountedFlaw flat_;          ///< objects that their transform makes flat
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
