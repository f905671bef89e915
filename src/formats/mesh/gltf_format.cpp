// The only file that knows tinygltf, which takes the JSON apart and finds the buffers. It trusts the file in
// some places where a damaged one must not be trusted: checkGltf() looks at those first, and every index
// and range is checked here. (Long, because no other file is to know the library.)
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
#include "formats/mesh/gltf_material.h"
#include "formats/mesh/gltf_tree.h"
#include "formats/model_textures.h"
#include "formats/textures.h"
#include "geometry/mesh/mesh.h"

#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_FS
#include <tiny_gltf.h>

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
  if (end + 8 <= bytes.size() && littleInt(bytes, end) > bytes.size() - end - 8)
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
  const nlohmann::json json = parseGltfJson(place, bytes, jsonOf(place, bytes));
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

bool isIndex(int index, std::size_t count) { return index >= 0 && static_cast<std::size_t>(index) < count; }

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

Color colorOf(const std::vector<double>& numbers, const Color& otherwise) {
  return numbers.size() < 3 ? otherwise : Color{numbers[0], numbers[1], numbers[2]};
}

/// The number `name` of an extension, if the material or node has it.
double extension(const tinygltf::ExtensionMap& all, const char* name, const char* field, double otherwise) {
  const auto found = all.find(name);
  if (found == all.end() || !found->second.IsObject() || !found->second.Has(field)) return otherwise;
  const tinygltf::Value& value = found->second.Get(field);
  return value.IsNumber() ? value.GetNumberAsDouble() : otherwise;
}

/// "%20" as a blank, and so on (RFC 3986, section 2.1).
std::string decodedUri(std::string_view uri) {
  const auto digit = [](char c) {
    return c >= '0' && c <= '9' ? c - '0' : (c | 32) >= 'a' && (c | 32) <= 'f' ? (c | 32) - 'a' + 10 : -1;
  };
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const bool coded =
        uri[i] == '%' && i + 2 < uri.size() && digit(uri[i + 1]) >= 0 && digit(uri[i + 2]) >= 0;
    const int code = coded ? 16 * digit(uri[i + 1]) + digit(uri[i + 2]) : 0;
    text += code > 0 ? static_cast<char>(code) : uri[i];
    if (code > 0) i += 2;
  }
  return text;
}

/// The two numbers `field` of an extension, if the texture has it.
Vec2 pairOf(const tinygltf::ExtensionMap& all, const char* name, const char* field, const Vec2& otherwise) {
  const auto found = all.find(name);
  if (found == all.end() || !found->second.IsObject() || !found->second.Has(field)) return otherwise;
  const tinygltf::Value& list = found->second.Get(field);
  if (!list.IsArray() || list.ArrayLen() < 2) return otherwise;
  const tinygltf::Value &x = list.Get(0), &y = list.Get(1);
  return x.IsNumber() && y.IsNumber() ? Vec2{x.GetNumberAsDouble(), y.GetNumberAsDouble()} : otherwise;
}

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
        gltf_(parse(file, bytes, place_, model_.inputs, messages)) {
    for (const tinygltf::Image& image : gltf_.images)
      if (!image.uri.empty()) model_.inputs.noteNamed(besideFile(file, fileOf(image)));
  }

  Model read() {
    for (const tinygltf::Material& material : gltf_.materials)
      model_.materials.push_back(materialOf(material));
    for (const tinygltf::Buffer& buffer : gltf_.buffers) allowance_ += kMostUses * buffer.data.size();
    readNodes();
    for (const Vec3f& color : colors_.keys()) model_.colors.push_back({color.x, color.y, color.z});
    repairs_.report(place_, messages_);
    textures_.report(messages_);
    inside_.report(messages_);
    const auto warn = [&](const char* what, std::size_t count) {
      if (count > 0) messages_.warn(place_, std::string(what) + ": " + std::to_string(count));
    };
    warn("points and lines are left out", lines_);
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
    const bool hasMaterial = isIndex(primitive.material, uvSets_.size());
    const int set = hasMaterial ? uvSets_[static_cast<std::size_t>(primitive.material)] : 0;
    const std::string name = "TEXCOORD_" + std::to_string(set);
    const auto found = primitive.attributes.find(name);
    if (found == primitive.attributes.end()) return;
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
    Color base = Color(1);
    if (isIndex(primitive.material, gltf_.materials.size())) {
      const MaterialModel& model = model_.materials[static_cast<std::size_t>(primitive.material)].model;
      const auto* principled = std::get_if<Principled>(&model);
      base = principled ? principled->color : std::get<Phong>(model).diffuse;
    }
    for (const Vec3f& c : colors) {
      if (!std::isfinite(c.x + c.y + c.z)) fail("COLOR_0: expected finite numbers");
      mesh.materials.push_back(colors_.number(Vec3f(Vec3{c.x * base.r, c.y * base.g, c.z * base.b})));
    }
  }

  // --- materials ---

  Material materialOf(const tinygltf::Material& from) {
    const tinygltf::PbrMetallicRoughness& pbr = from.pbrMetallicRoughness;
    const auto share = [](double x) { return x >= 0 ? std::min(x, 1.0) : 0.0; };
    MetallicRoughness m;
    m.baseColor = colorOf(pbr.baseColorFactor, Color(1));
    m.emissive = colorOf(from.emissiveFactor, Color()) *
                 extension(from.extensions, "KHR_materials_emissive_strength", "emissiveStrength", 1);
    if (pbr.baseColorFactor.size() == 4) m.opacity = share(pbr.baseColorFactor[3]);
    m.alpha = from.alphaMode == "BLEND"  ? MetallicRoughness::Alpha::blend
              : from.alphaMode == "MASK" ? MetallicRoughness::Alpha::mask
                                         : MetallicRoughness::Alpha::opaque;
    m.cutoff = from.alphaCutoff;
    m.metallic = share(pbr.metallicFactor);
    m.roughness = share(pbr.roughnessFactor);
    m.transmission = share(extension(from.extensions, "KHR_materials_transmission", "transmissionFactor", 0));
    m.index = extension(from.extensions, "KHR_materials_ior", "ior", 1.5);
    if (!(m.index > 0) || !std::isfinite(m.index)) m.index = 1.5;
    readFilm(from, m);
    if (!isFinite(m.baseColor) || !isFinite(m.emissive)) {
      messages_.warn(place_, "material \"" + from.name + "\" has numbers that are not finite");
      m.baseColor = Color(1);
      m.emissive = Color();
    }
    readPictures(from, m);
    Material material = toMaterial(from.name, m);
    if (m.metallicRoughnessMap && std::holds_alternative<Phong>(material.model))
      noteTexture(pbr.metallicRoughnessTexture.index);
    if (m.iridescence > 0 && std::holds_alternative<Phong>(material.model))
      messages_.warn(place_,
                     "material \"" + from.name + "\" lets light through: its iridescence is not rendered");
    return material;
  }

  void readFilm(const tinygltf::Material& from, MetallicRoughness& m) const {
    const auto number = [&](const char* field, double otherwise) {
      const double x = extension(from.extensions, kIridescence, field, otherwise);
      return std::isfinite(x) && x >= 0 ? x : otherwise;
    };
    m.iridescence = std::min(1.0, number("iridescenceFactor", 0));
    m.filmIndex = std::max(1.0, number("iridescenceIor", 1.3));
    m.filmMost = std::min(5000.0, number("iridescenceThicknessMaximum", 400));
    m.filmLeast = std::min(m.filmMost, number("iridescenceThicknessMinimum", 100));
  }

  // --- pictures ---

  /// A texture that an extension of a material names.
  static tinygltf::TextureInfo textureIn(const tinygltf::Material& from, const char* extension,
                                         const char* field) {
    tinygltf::TextureInfo info;
    const auto found = from.extensions.find(extension);
    if (found == from.extensions.end() || !found->second.Has(field)) return info;
    const tinygltf::Value& said = found->second.Get(field);
    const auto whole = [&](const char* key, int otherwise) {
      return said.Has(key) && said.Get(key).IsNumber() ? said.Get(key).GetNumberAsInt() : otherwise;
    };
    info.index = whole("index", -1);
    info.texCoord = whole("texCoord", 0);
    if (said.Has("extensions") && said.Get("extensions").IsObject())
      info.extensions = said.Get("extensions").Get<tinygltf::Value::Object>();
    return info;
  }

  /// All of a material use the texture coordinates of the first of them: a mesh has one set.
  void readPictures(const tinygltf::Material& from, MetallicRoughness& m) {
    const tinygltf::PbrMetallicRoughness& pbr = from.pbrMetallicRoughness;
    std::optional<int> set;
    m.baseColorMap = pictureOf(pbr.baseColorTexture, set);
    m.metallicRoughnessMap = pictureOf(pbr.metallicRoughnessTexture, set);
    m.emissiveMap = pictureOf(from.emissiveTexture, set);
    m.occlusionMap = pictureOf(from.occlusionTexture, set);
    m.normalMap = pictureOf(from.normalTexture, set);
    m.iridescenceMap = pictureOf(textureIn(from, kIridescence, "iridescenceTexture"), set);
    m.filmMap = pictureOf(textureIn(from, kIridescence, "iridescenceThicknessTexture"), set);
    m.normalScale = std::isfinite(from.normalTexture.scale) ? from.normalTexture.scale : 1;
    m.occlusionStrength = from.occlusionTexture.strength;
    if (!(m.occlusionStrength >= 0 && m.occlusionStrength <= 1)) m.occlusionStrength = 1;
    if (m.baseColorMap) m.baseColorMap->srgb = true;
    if (m.emissiveMap) m.emissiveMap->srgb = true;
    if (m.baseColorMap && m.alpha != MetallicRoughness::Alpha::opaque) {
      const Pixels& pixels = m.baseColorMap->file;
      m.hasAlphaMap =
          pixels.map ? pixels.map->hasAlpha() : kindOfPicture(place_.file, pixels.file).transparent;
    }
    uvSets_.push_back(set.value_or(0));
  }

  /// Nothing, after a note, where the texture names no picture or needs other coordinates than `set`.
  template <class Info>
  std::optional<ImageMap> pictureOf(const Info& info, std::optional<int>& set) {
    if (info.index < 0) return {};
    const auto& all = info.extensions;
    const auto own =
        static_cast<int>(extension(all, kTransform, "texCoord", static_cast<double>(info.texCoord)));
    const int image = imageOf(info.index);
    if (image < 0 || set.value_or(own) != own) {
      noteTexture(info.index);
      return std::nullopt;
    }
    set = own;
    ImageMap map = modelPicture(pixelsOf(image));
    const int sampler = gltf_.textures[static_cast<std::size_t>(info.index)].sampler;
    if (isIndex(sampler, gltf_.samplers.size()))
      apply(gltf_.samplers[static_cast<std::size_t>(sampler)], map);
    const auto pair = [&](const char* field, const Vec2& otherwise) {
      return pairOf(all, kTransform, field, otherwise);
    };
    const Vec2 offset = pair("offset", {0, 0}), scale = pair("scale", {1, 1});
    map.transform = placementOf(offset, extension(all, kTransform, "rotation", 0), scale);
    return map;
  }

  static constexpr const char* kTransform = "KHR_texture_transform";
  static constexpr const char* kIridescence = "KHR_materials_iridescence";

  /// T R S of that extension, where v grows downward, as Trace sees it.
  static std::array<Real, 6> placementOf(const Vec2& offset, Real radians, const Vec2& scale) {
    const Real c = radians == 0 ? 1 : std::cos(radians), s = radians == 0 ? 0 : std::sin(radians);
    const Real uu = c * scale.x, uv = s * scale.y, vu = -s * scale.x, vv = c * scale.y;
    return {uu, 0 - uv, uv + offset.x, 0 - vu, vv, 1 - vv - offset.y};
  }

  static void apply(const tinygltf::Sampler& sampler, ImageMap& map) {
    const auto wrap = [](int code) {
      return code == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE     ? Wrap::clamp
             : code == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Wrap::mirror
                                                             : Wrap::repeat;
    };
    map.wrapU = wrap(sampler.wrapS);
    map.wrapV = wrap(sampler.wrapT);
    const int least = sampler.minFilter;
    if (least == TINYGLTF_TEXTURE_FILTER_NEAREST || least == TINYGLTF_TEXTURE_FILTER_LINEAR)
      map.filter = TexelFilter::bilinear;
    if (sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST) map.filter = TexelFilter::nearest;
  }

  /// The number of its picture, perhaps of one of another kind that an extension names; -1 if it has none.
  int imageOf(int texture) const {
    if (!isIndex(texture, gltf_.textures.size())) return -1;
    const tinygltf::Texture& from = gltf_.textures[static_cast<std::size_t>(texture)];
    int source = from.source;
    for (const char* other :
         {"EXT_texture_webp", "EXT_texture_avif", "KHR_texture_basisu", "MSFT_texture_dds"})
      if (source < 0) source = static_cast<int>(extension(from.extensions, other, "source", -1));
    return isIndex(source, gltf_.images.size()) ? source : -1;
  }

  static std::string fileOf(const tinygltf::Image& image) { return decodedUri(image.uri); }

  /// The pixels of a file, which are loaded later, or of the bytes in this one.
  Pixels pixelsOf(int number) {
    const tinygltf::Image& image = gltf_.images[static_cast<std::size_t>(number)];
    if (!image.uri.empty()) return {fileOf(image), nullptr, place_};
    const auto [found, fresh] = pixels_.try_emplace(number);
    if (fresh)
      found->second = inside_.decode(
          std::filesystem::path(place_.file).filename().string() + "#images[" + std::to_string(number) + "]",
          {image.name, std::string(bytesOf(image))}, place_);
    return found->second;
  }

  std::string_view bytesOf(const tinygltf::Image& image) const {
    const auto text = [](const std::vector<unsigned char>& bytes) {
      return std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    };
    if (image.bufferView < 0) return text(image.image);
    const tinygltf::BufferView& view = gltf_.bufferViews[static_cast<std::size_t>(image.bufferView)];
    if (!isIndex(view.buffer, gltf_.buffers.size())) return {};
    const std::string_view all = text(gltf_.buffers[static_cast<std::size_t>(view.buffer)].data);
    return view.byteOffset <= all.size() ? all.substr(view.byteOffset, view.byteLength) : std::string_view();
  }

  /// Notes a texture that is not rendered by the name of its file, or, if it is in this one, by its own.
  void noteTexture(int texture) {
    if (texture < 0) return;
    const int number = imageOf(texture);
    const tinygltf::Image* image = number < 0 ? nullptr : &gltf_.images[static_cast<std::size_t>(number)];
    if (image && !image->uri.empty()) return textures_.note(image->uri, place_);
    const std::string name =
        image && !image->name.empty() ? image->name : "texture " + std::to_string(texture);
    textures_.note(name + " (inside the file)", place_);
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
  std::vector<int> uvSets_;       ///< of materials: the texture coordinates that they use
  std::map<int, Pixels> pixels_;  ///< of pictures in the file
  InsidePictures inside_;
  UnusedTextures textures_;
  std::size_t lines_ = 0;     ///< primitives that are no triangles
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
