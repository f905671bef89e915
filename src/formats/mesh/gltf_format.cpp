// Nodes, meshes, lights and the camera of a glTF file. tinygltf takes the JSON apart and finds the buffers.
// It trusts the file in some places where a damaged one must not be trusted: checkGltf() looks at those
// first, and every index and range is checked here. Only this file and gltf_looks.cpp know the library.
#include "formats/mesh/gltf_format.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>  // for tinygltf, which forgets it
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "base/file.h"
#include "base/text.h"
#include "base/unique.h"
#include "formats/directions.h"
#include "formats/mesh/gltf_buffers.h"
#include "formats/mesh/gltf_check.h"
#include "formats/mesh/gltf_json.h"
#include "formats/mesh/gltf_looks.h"
#include "formats/mesh/gltf_material.h"
#include "formats/mesh/gltf_tree.h"
#include "formats/mesh/gltf_upgrade.h"
#include "geometry/mesh/mesh.h"

#define TINYGLTF_IMPLEMENTATION
#include "formats/mesh/gltf_values.h"

namespace trace {
namespace {

constexpr std::string_view kMagic = "glTF";

std::uint32_t littleInt(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

// --- the container ----------------------------------------------------------------------------------

/// The JSON of the file: all of it, or the first chunk of a binary one. Throws Error if chunks do not fit.
std::string_view jsonOf(const Place& place, std::string_view bytes) {
  if (!bytes.starts_with(kMagic)) return bytes;
  const auto fail = [&](const char* what) { throw Error(Fault::scene, place, what); };
  if (bytes.size() < 20) fail("expected a glTF header of 20 bytes, found the end of the file");
  const std::size_t json = littleInt(bytes, 12), end = 20 + json;
  if (littleInt(bytes, 8) > bytes.size() || end > bytes.size())
    fail("the file is shorter than its header says");
  const bool hasChunks = littleInt(bytes, 4) >= 2;  // before, the rest was the body
  if (hasChunks && end + 8 <= bytes.size() && littleInt(bytes, end) > bytes.size() - end - 8)
    fail("the binary chunk is longer than the rest of the file");
  return bytes.substr(20, json);
}

/// Files that the scene names, each read once.
struct Files {
  std::set<std::string> read;
  InputFiles& inputs;

  static bool exists(const std::string& path, void*) {
    std::error_code ignored;
    return std::filesystem::is_regular_file(path, ignored);
  }
  static std::string expand(const std::string& path, void*) { return path; }
  static bool readWhole(std::vector<unsigned char>* to, std::string* error, const std::string& path,
                        void* self) {
    Files& files = *static_cast<Files*>(self);
    if (!files.read.insert(path).second) {
      *error = "two buffers are the same file";
      return false;
    }
    try {
      const std::string bytes = readFile(path);
      files.inputs.noteRead(path, bytes);
      to->assign(bytes.begin(), bytes.end());
      return true;
    } catch (const Error& failure) {
      if (failure.fault() == Fault::limit) throw;
      *error = failure.messages().front().what;
      return false;
    }
  }
};

tinygltf::Model parse(const std::string& file, std::string_view bytes, const Place& place, InputFiles& inputs,
                      Messages& messages) {
  nlohmann::json json = parseGltfJson(place, bytes, jsonOf(place, bytes));
  std::string upgraded;
  if (isGltf1(json)) {
    json = upgradedGltf(json, place);
    upgraded = upgradedGltfFile(json, bytes);
    bytes = upgraded;
  }
  checkGltf(json, place, messages);
  checkGltfBuffers(json, place);
  checkGltfTree(json, place);
  Files files{{}, inputs};
  tinygltf::TinyGLTF parser;
  parser.SetFsCallbacks({Files::exists, Files::expand, Files::readWhole, nullptr, &files});
  // Only the bytes of a data URI are kept: those in a buffer lie where nobody has looked yet.
  parser.SetImageLoader(
      [](tinygltf::Image* image, int, std::string*, std::string*, int, int, const unsigned char* data,
         int size, void*) {
        if (image->bufferView < 0) image->image.assign(data, data + size);
        return true;
      },
      nullptr);
  tinygltf::Model model;
  std::string errors, warnings;
  const std::string folder = std::filesystem::path(file).parent_path().string();
  const auto size = static_cast<unsigned>(bytes.size());
  bool good = false;
  try {
    good =
        bytes.starts_with(kMagic)
            ? parser.LoadBinaryFromMemory(&model, &errors, &warnings,
                                          reinterpret_cast<const unsigned char*>(bytes.data()), size, folder)
            : parser.LoadASCIIFromString(&model, &errors, &warnings, bytes.data(), size, folder);
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    errors = error.what();
  }
  if (!good)
    throw Error(Fault::scene, place, "not a sound glTF file: " + errors.substr(0, errors.find('\n')));
  return model;
}

// --- numbers ----------------------------------------------------------------------------------------

/// The elements of an accessor, checked to lie inside their buffer.
class Elements {
 public:
  Elements(const tinygltf::Model& model, int index, const Place& place) {
    const auto fail = [&](const char* what) {
      throw Error(Fault::scene, place, "accessor " + std::to_string(index) + ": " + what);
    };
    if (!isIndex(index, model.accessors.size())) fail("there is none");
    const tinygltf::Accessor& accessor = model.accessors[static_cast<std::size_t>(index)];
    if (accessor.sparse.isSparse) fail("sparse accessors are not read yet");
    if (!isIndex(accessor.bufferView, model.bufferViews.size())) fail("expected a buffer view");
    const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(accessor.bufferView)];
    if (!isIndex(view.buffer, model.buffers.size())) fail("expected a view of a buffer");
    const auto& data = model.buffers[static_cast<std::size_t>(view.buffer)].data;

    type_ = accessor.componentType;
    normalized_ = accessor.normalized;
    const int components = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
    const int size = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(type_));
    if (components < 1 || components > 4 || size < 1 || size > 4) fail("expected a scalar or a vector");
    components_ = static_cast<std::size_t>(components);
    size_ = static_cast<std::size_t>(size);
    stride_ = view.byteStride ? view.byteStride : components_ * size_;
    count_ = accessor.count;
    const bool viewFits = view.byteOffset <= data.size() && view.byteLength <= data.size() - view.byteOffset;
    if (!viewFits || accessor.byteOffset > view.byteLength) fail("its buffer view is longer than the buffer");
    const std::size_t room = view.byteLength - accessor.byteOffset;
    if (count_ > 0 && (room < components_ * size_ || (room - components_ * size_) / stride_ < count_ - 1))
      fail("it is longer than its buffer view");
    first_ = data.data() + view.byteOffset + accessor.byteOffset;
  }

  std::size_t count() const { return count_; }
  std::size_t components() const { return components_; }
  std::size_t bytes() const { return count_ * components_ * size_; }

  double number(std::size_t i, std::size_t component) const {
    const unsigned char* from = first_ + i * stride_ + component * size_;
    switch (type_) {
      case TINYGLTF_COMPONENT_TYPE_BYTE: return whole<std::int8_t>(from);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return whole<std::uint8_t>(from);
      case TINYGLTF_COMPONENT_TYPE_SHORT: return whole<std::int16_t>(from);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return whole<std::uint16_t>(from);
      case TINYGLTF_COMPONENT_TYPE_INT: return whole<std::int32_t>(from);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT: return whole<std::uint32_t>(from);
    }
    return load<float>(from);
  }
  Vec3f vector(std::size_t i) const { return Vec3f(Vec3{number(i, 0), number(i, 1), number(i, 2)}); }

 private:
  template <class T>
  static T load(const unsigned char* from) {
    T value;
    std::memcpy(&value, from, sizeof value);
    return value;
  }
  template <class T>
  double whole(const unsigned char* from) const {
    const double value = load<T>(from);
    return normalized_ ? std::max(value / std::numeric_limits<T>::max(), -1.0) : value;
  }

  const unsigned char* first_ = nullptr;
  std::size_t count_ = 0, components_ = 1, size_ = 1, stride_ = 1;
  int type_ = 0;
  bool normalized_ = false;
};

Affine transformOf(const tinygltf::Node& node) {
  Affine m;
  if (node.matrix.size() == 16) {  // column by column
    const auto& a = node.matrix;
    m.row[0] = {a[0], a[4], a[8]};
    m.row[1] = {a[1], a[5], a[9]};
    m.row[2] = {a[2], a[6], a[10]};
    m.offset = {a[12], a[13], a[14]};
    return m;
  }
  if (node.translation.size() == 3)
    m = Affine::translation({node.translation[0], node.translation[1], node.translation[2]});
  if (node.rotation.size() == 4) {  // (x, y, z, w), the real part last
    const Vec3 axis{node.rotation[0], node.rotation[1], node.rotation[2]};
    const Real sine = length(axis);
    if (sine > 0) m = m * Affine::rotation(axis / sine, 2 * std::atan2(sine, node.rotation[3]));
  }
  if (node.scale.size() == 3) m = m * Affine::scaling({node.scale[0], node.scale[1], node.scale[2]});
  return m;
}

// --- the reader -------------------------------------------------------------------------------------

class GltfReader {
 public:
  GltfReader(const std::string& file, std::string_view bytes, Messages& messages)
      : place_{file, 0, 0, {}},
        messages_(messages),
        gltf_(parse(file, bytes, place_, model_.inputs, messages)),
        looks_(gltf_, place_, messages) {
    for (const tinygltf::Image& image : gltf_.images)
      if (!image.uri.empty()) model_.inputs.noteNamed(besideFile(file, fileOf(image)));
  }

  Model read() {
    model_.materials = looks_.materials();
    for (const tinygltf::Buffer& buffer : gltf_.buffers) allowance_ += kMostUses * buffer.data.size();
    readNodes();
    for (const Vec3f& color : colors_.keys()) model_.colors.push_back({color.x, color.y, color.z});
    repairs_.report(place_, messages_);
    looks_.report();
    const auto warn = [&](const char* what, std::size_t count) {
      if (count > 0) messages_.warn(place_, std::string(what) + ": " + std::to_string(count));
    };
    warn("points and lines are left out", lines_);
    warn("meshes without the texture coordinates of their pictures show the top left corner", withoutUvs_);
    warn("corners at the end of a mesh that make no whole triangle are left out", leftOver_);
    warn("objects are left out whose transform makes them flat, or infinitely large or small", flat_);
    model_.choices.push_back({"transfer", "srgb", place_});  // its colours are linear light
    return std::move(model_);
  }

 private:
  /// Each byte may be used so often, in this many meshes: a small file must not become a huge scene.
  static constexpr std::uint64_t kMostUses = 100;

  [[noreturn]] void fail(std::string what) const { throw Error(Fault::scene, place_, std::move(what)); }

  // --- nodes ---

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
    if (isIndex(node.camera, gltf_.cameras.size()))
      readCamera(gltf_.cameras[static_cast<std::size_t>(node.camera)], worldFromNode);
    const double light = extension(node.extensions, "KHR_lights_punctual", "light", -1);
    if (light >= 0 && light < static_cast<double>(gltf_.lights.size()))
      readLight(gltf_.lights[static_cast<std::size_t>(light)], worldFromNode);
    if (node.mesh < 0) return;
    if (!isIndex(node.mesh, gltf_.meshes.size())) fail("there is no mesh " + std::to_string(node.mesh));
    const std::string& name =
        node.name.empty() ? gltf_.meshes[static_cast<std::size_t>(node.mesh)].name : node.name;
    const std::vector<Object>& parts = partsOf(node.mesh);
    if (!invertible(worldFromNode)) {
      flat_ += parts.size();
      return;
    }
    for (const Object& part : parts) {
      model_.objects.push_back(part);
      model_.objects.back().name = name;
      model_.objects.back().worldFromObject = worldFromNode;
    }
  }

  void readCamera(const tinygltf::Camera& from, const Affine& worldFromNode) {
    if (model_.camera) return;
    const bool parallel = from.type == "orthographic";
    const double fov = parallel ? 45 : from.perspective.yfov * 180 / kPi;
    const double aspect =
        parallel ? from.orthographic.xmag / from.orthographic.ymag : from.perspective.aspectRatio;
    Camera camera;
    camera.position = worldFromNode * Vec3{};
    camera.viewdir = linear(worldFromNode, {0, 0, -1});
    camera.updir = linear(worldFromNode, {0, 1, 0});
    if (!(fov > 0 && fov < 180) || (parallel && !(std::abs(aspect) > 0 && std::isfinite(aspect))) ||
        !canLook(camera.viewdir, camera.updir) || !isFinite(camera.position))
      return messages_.warn(place_, "camera \"" + from.name + "\" cannot look; it is left out");
    camera.viewdir = normalize(camera.viewdir);
    camera.updir = normalize(camera.updir);
    camera.fov = fov;
    if (std::abs(aspect) > 0 && std::isfinite(aspect)) camera.aspectratio = std::abs(aspect);
    model_.camera = camera;
    if (!parallel) return;
    model_.choices.push_back({"projection", "orthographic", place_});
    model_.choices.push_back({"view-height", toText(std::abs(2 * from.orthographic.ymag)), place_});
  }

  /// Candela and lux become the courses' colours, whose matt surfaces do not divide by pi.
  void readLight(const tinygltf::Light& from, const Affine& worldFromNode) {
    const Color color = colorOf(from.color, Color(1)) * (from.intensity / kPi);
    const Vec3 position = worldFromNode * Vec3{}, direction = linear(worldFromNode, {0, 0, -1});
    if (!isFinite(color) || !isFinite(position) || !isFinite(direction) || direction == Vec3{})
      return messages_.warn(place_, "light \"" + from.name + "\" is left out: its numbers are not finite");
    if (from.type == "directional") {
      model_.lights.push_back({DirectionalLight{.direction = normalize(direction), .color = color}, place_});
      return;
    }
    const auto degrees = [](Real radians) { return std::clamp(radians * 180 / kPi, 0.0, 90.0); };
    if (from.type == "spot")
      model_.lights.push_back({SpotLight{.position = position,
                                         .direction = normalize(direction),
                                         .color = color,
                                         .angle = degrees(from.spot.outerConeAngle),
                                         .fullAngle = degrees(from.spot.innerConeAngle),
                                         .constant = 0,
                                         .quadratic = 1},
                               place_});
    else
      model_.lights.push_back({PointLight{.position = position, .color = color}, place_});
    if (!limitsLifted_) model_.choices.push_back({"limit-attenuation", "off", place_});
    limitsLifted_ = true;
  }

  // --- meshes ---

  const std::vector<Object>& partsOf(int mesh) {
    const auto [found, fresh] = parts_.try_emplace(mesh);
    if (fresh)
      for (const tinygltf::Primitive& primitive : gltf_.meshes[static_cast<std::size_t>(mesh)].primitives)
        if (auto data = meshOf(primitive); !data.triangles.empty())
          found->second.push_back({"",
                                   Mesh{std::make_shared<const MeshData>(std::move(data))},
                                   {},
                                   isIndex(primitive.material, gltf_.materials.size())
                                       ? static_cast<std::uint32_t>(primitive.material)
                                       : Model::kNoMaterial,
                                   place_});
    return found->second;
  }

  Elements elements(int accessor) {
    const Elements result(gltf_, accessor, place_);
    if (result.bytes() > allowance_) fail("the same data is used too often, in more than 100 meshes");
    allowance_ -= result.bytes();
    return result;
  }

  /// The vectors of an attribute, if the primitive has it.
  std::vector<Vec3f> vectors(const tinygltf::Primitive& primitive, const char* name, std::size_t count) {
    std::vector<Vec3f> result;
    const auto found = primitive.attributes.find(name);
    if (found == primitive.attributes.end()) return result;
    const Elements from = elements(found->second);
    if (from.components() < 3 || (count > 0 && from.count() != count))
      fail(std::string(name) + ": expected one vector for each point");
    for (std::size_t i = 0; i < from.count(); ++i) result.push_back(from.vector(i));
    return result;
  }

  MeshData meshOf(const tinygltf::Primitive& primitive) {
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
    readUvs(primitive, mesh);
    readColors(primitive, mesh);

    const std::vector<std::uint32_t> corners = cornersOf(primitive, mesh.points.size());
    leftOver_ += triangles ? corners.size() % 3 : 0;
    for (std::size_t i = 2; i < corners.size(); i += triangles ? 3 : 1) {
      const bool turned = strip && i % 2 == 1;
      const std::uint32_t a = corners[fan ? 0 : i - 2], b = corners[i - 1], c = corners[i];
      mesh.triangles.push_back({turned ? b : a, turned ? a : b, c});
    }
    repairs_.check(mesh, place_);
    return mesh;
  }

  std::vector<std::uint32_t> cornersOf(const tinygltf::Primitive& primitive, std::size_t points) {
    std::vector<std::uint32_t> corners;
    if (primitive.indices < 0) {
      for (std::uint32_t i = 0; i < points; ++i) corners.push_back(i);
      return corners;
    }
    const Elements from = elements(primitive.indices);
    corners.reserve(from.count());
    for (std::size_t i = 0; i < from.count(); ++i) {
      const double corner = from.number(i, 0);
      if (!(corner >= 0 && corner < static_cast<double>(points)))
        fail("a triangle uses point " + toText(corner) + ", but the mesh has " + std::to_string(points) +
             " points, counted from 0");
      corners.push_back(static_cast<std::uint32_t>(corner));
    }
    return corners;
  }

  /// The origin of glTF's texture coordinates is at the top, of Trace's at the bottom.
  void readUvs(const tinygltf::Primitive& primitive, MeshData& mesh) {
    const std::optional<int> set = looks_.uvSet(primitive.material);
    const std::string name = "TEXCOORD_" + std::to_string(set.value_or(0));
    const auto found = primitive.attributes.find(name);
    if (found == primitive.attributes.end()) {
      if (!set) return;
      ++withoutUvs_;
      return mesh.uvs.assign(mesh.points.size(), {0, 1});
    }
    const Elements from = elements(found->second);
    if (from.components() < 2 || from.count() != mesh.points.size())
      fail(name + ": expected one for each point");
    for (std::size_t i = 0; i < from.count(); ++i)
      mesh.uvs.push_back({from.number(i, 0), 1 - from.number(i, 1)});
  }

  /// Times the base colour, as the specification says.
  void readColors(const tinygltf::Primitive& primitive, MeshData& mesh) {
    const std::vector<Vec3f> colors = vectors(primitive, "COLOR_0", mesh.points.size());
    if (colors.empty()) return;
    const bool hasMaterial = isIndex(primitive.material, gltf_.materials.size());
    const Color base =
        hasMaterial ? baseColorOf(model_.materials[static_cast<std::size_t>(primitive.material)]) : Color(1);
    for (const Vec3f& c : colors) {
      if (!std::isfinite(c.x + c.y + c.z)) fail("COLOR_0: expected finite numbers");
      mesh.materials.push_back(colors_.number(Vec3f(Vec3{c.x * base.r, c.y * base.g, c.z * base.b})));
    }
  }

  Place place_;
  Messages& messages_;
  Model model_;                // parsing notes files in it
  bool limitsLifted_ = false;  // light falls off as in nature
  tinygltf::Model gltf_;
  std::map<int, std::vector<Object>> parts_;  ///< of meshes
  std::uint64_t allowance_ = 1 << 20;         ///< bytes of accessors that may still be read
  Unique<Vec3f> colors_;
  MeshRepairs repairs_;
  GltfLooks looks_;
  std::size_t lines_ = 0;  ///< primitives that are no triangles
  std::size_t withoutUvs_ = 0;
  std::size_t leftOver_ = 0;  ///< corners that make no triangle
  std::size_t flat_ = 0;      ///< objects that their transform makes flat
};

}  // namespace

bool recognisesGltf(std::string_view bytes) {
  if (bytes.starts_with(kMagic)) return true;
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && bytes[first] == '{' &&
         bytes.find("\"asset\"") != std::string_view::npos;
}

Model readGltf(const std::string& file, std::string_view bytes, Messages& messages) {
  return GltfReader(file, bytes, messages).read();
}

}  // namespace trace
