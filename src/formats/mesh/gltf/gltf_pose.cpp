#include "formats/mesh/gltf/gltf_pose.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "geometry/mesh/mesh.h"
#include "math/elementary.h"

namespace trace {
namespace {

/// (x, y, z, w), the real part last.
Affine turnedBy(double x, double y, double z, double w) {
  const Vec3 axis{x, y, z};
  const Real sine = length(axis);
  return sine > 0 ? Affine::rotation(axis / sine, 2 * math::atan2(sine, w)) : Affine{};
}

/// Between two unit quaternions, the shorter way (appendix C.4).
std::vector<double> slerp(const std::vector<double>& from, std::vector<double> to, double part) {
  double cosine = 0;
  for (std::size_t i = 0; i < 4; ++i) cosine += from[i] * to[i];
  if (cosine < 0)
    for (double& x : to) x = -x;
  const double angle = math::acos(std::min(std::abs(cosine), 1.0));
  constexpr double kStraight = 1e-6;
  const double a = angle < kStraight ? 1 - part : math::sin((1 - part) * angle) / math::sin(angle);
  const double b = angle < kStraight ? part : math::sin(part * angle) / math::sin(angle);
  for (std::size_t i = 0; i < 4; ++i) to[i] = a * from[i] + b * to[i];
  return to;
}

void normalize(std::vector<double>& q) {
  double square = 0;
  for (double x : q) square += x * x;
  for (double& x : q) x /= square > 0 ? std::sqrt(square) : 1;
}

/// The values of an animation's sampler at a time.
class Curve {
 public:
  /// `width` is how many numbers a key has. Throws Error(Fault::scene).
  Curve(const tinygltf::AnimationSampler& sampler, std::size_t width, const ReadAccessor& elements,
        const SourcePlace& place)
      : times_(elements(sampler.input)),
        values_(elements(sampler.output)),
        width_(width),
        isCubic_(sampler.interpolation == "CUBICSPLINE"),
        isStep_(sampler.interpolation == "STEP") {
    const std::size_t found = values_.count() * values_.components(), keys = times_.count();
    if (keys == 0 || times_.components() != 1 || width == 0 || found != keys * width * (isCubic_ ? 3 : 1))
      throw Error(Fault::scene, place,
                  "an animation: expected " + std::to_string(width) + " numbers for each key");
  }

  /// The times of the first and the last.
  std::pair<Real, Real> keys() const { return {times_.number(0, 0), times_.number(times_.count() - 1, 0)}; }

  std::vector<double> at(double time, bool isRotation) const {
    std::size_t after = 0;  // the first key behind the time
    for (std::size_t most = times_.count(); after < most;) {
      const std::size_t middle = after + (most - after) / 2;
      if (times_.number(middle, 0) > time)
        most = middle;
      else
        after = middle + 1;
    }
    if (after == 0) return key(0);
    if (after == times_.count() || isStep_) return key(after - 1);
    const double begin = times_.number(after - 1, 0), length = times_.number(after, 0) - begin;
    const double part = length > 0 ? (time - begin) / length : 0;
    if (isCubic_) return spline(after - 1, part, length, isRotation);
    if (isRotation) return slerp(key(after - 1), key(after), part);
    std::vector<double> value = key(after - 1);
    const std::vector<double> next = key(after);
    for (std::size_t i = 0; i < width_; ++i) value[i] += part * (next[i] - value[i]);
    return value;
  }

 private:
  enum Row : std::size_t { inTangent, point, outTangent };

  std::vector<double> key(std::size_t k) const { return row(k, point); }
  /// A cubic spline has three for each key, others have one.
  std::vector<double> row(std::size_t k, Row which) const {
    std::vector<double> numbers;
    const std::size_t first = (isCubic_ ? 3 * k + which : k) * width_;
    for (std::size_t i = first; i < first + width_; ++i)
      numbers.push_back(values_.number(i / values_.components(), i % values_.components()));
    return numbers;
  }
  /// Appendix C.5.
  std::vector<double> spline(std::size_t k, double t, double length, bool isRotation) const {
    const std::vector<double> from = row(k, point), out = row(k, outTangent), in = row(k + 1, inTangent),
                              to = row(k + 1, point);
    const double t2 = t * t, t3 = t2 * t;
    std::vector<double> value(width_);
    for (std::size_t i = 0; i < width_; ++i)
      value[i] = (2 * t3 - 3 * t2 + 1) * from[i] + length * (t3 - 2 * t2 + t) * out[i] +
                 (3 * t2 - 2 * t3) * to[i] + length * (t3 - t2) * in[i];
    if (isRotation) normalize(value);
    return value;
  }

  GltfElements times_, values_;
  std::size_t width_;
  bool isCubic_, isStep_;
};

/// How many morph targets the node's mesh has.
std::size_t targetsOf(const tinygltf::Model& gltf, const tinygltf::Node& node) {
  if (!isIndex(node.mesh, gltf.meshes.size())) return 0;
  std::size_t most = 0;
  for (const tinygltf::Primitive& primitive : gltf.meshes[static_cast<std::size_t>(node.mesh)].primitives)
    most = std::max(most, primitive.targets.size());
  return most;
}

/// Those of the node, or of its mesh.
const std::vector<double>& weightsOf(const tinygltf::Model& gltf, const tinygltf::Node& node) {
  return node.weights.empty() ? gltf.meshes[static_cast<std::size_t>(node.mesh)].weights : node.weights;
}

Vec3f moved(const Affine& m, const Vec3f& p) { return Vec3f(m * Vec3(p)); }

}  // namespace

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
  if (node.rotation.size() == 4)
    m = m * turnedBy(node.rotation[0], node.rotation[1], node.rotation[2], node.rotation[3]);
  if (node.scale.size() == 3) m = m * Affine::scaling({node.scale[0], node.scale[1], node.scale[2]});
  return m;
}

std::optional<std::pair<Real, Real>> animate(tinygltf::Model& gltf, SceneTime& time,
                                             const ReadAccessor& elements, const SourcePlace& place) {
  std::optional<std::pair<Real, Real>> keys;
  if (gltf.animations.empty()) return keys;
  const tinygltf::Animation& animation = gltf.animations.front();
  for (const tinygltf::AnimationChannel& channel : animation.channels) {
    if (!isIndex(channel.target_node, gltf.nodes.size())) continue;  // channel of an extension
    tinygltf::Node& node = gltf.nodes[static_cast<std::size_t>(channel.target_node)];
    const auto& path = channel.target_path;
    std::vector<double>* const to = path == "translation" ? &node.translation
                                    : path == "rotation"  ? &node.rotation
                                    : path == "scale"     ? &node.scale
                                    : path == "weights"   ? &node.weights
                                                          : nullptr;
    const std::size_t width = path == "weights" ? targetsOf(gltf, node) : path == "rotation" ? 4 : 3;
    if (!to || width == 0) continue;
    const Curve curve(animation.samplers[static_cast<std::size_t>(channel.sampler)], width, elements, place);
    *to = curve.at(time.now(), path == "rotation");
    if (path != "weights") node.matrix.clear();
    const auto [first, last] = curve.keys();
    keys =
        keys ? std::pair{std::min(keys->first, first), std::max(keys->second, last)} : std::pair{first, last};
  }
  return keys;
}

std::vector<Affine> instancesOf(const tinygltf::Node& node, const ReadAccessor& elements,
                                const SourcePlace& place) {
  const tinygltf::Value* attributes =
      extensionValue(node.extensions, "EXT_mesh_gpu_instancing", "attributes");
  if (!attributes || !attributes->IsObject()) return {Affine{}};
  std::vector<Affine> all;
  for (const auto& [name, width] :
       {std::pair{"TRANSLATION", std::size_t{3}}, {"ROTATION", 4}, {"SCALE", 3}}) {
    if (!attributes->Has(name)) continue;
    const GltfElements from = elements(attributes->Get(name).GetNumberAsInt());
    if (from.components() != width || (!all.empty() && from.count() != all.size()))
      throw Error(Fault::scene, place,
                  std::string("EXT_mesh_gpu_instancing: ") + name + ": expected one vector of " +
                      std::to_string(width) + " numbers for each copy");
    all.resize(from.count());
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Vec3 v{from.number(i, 0), from.number(i, 1), from.number(i, 2)};
      all[i] = all[i] * (width == 4       ? turnedBy(v.x, v.y, v.z, from.number(i, 3))
                         : name[0] == 'T' ? Affine::translation(v)
                                          : Affine::scaling(v));
    }
  }
  return all.empty() ? std::vector<Affine>{Affine{}} : all;
}

GltfPose::GltfPose(const tinygltf::Model& gltf, ReadAccessor elements, const SourcePlace& place)
    : gltf_(gltf), elements_(std::move(elements)), place_(place) {
  if (gltf.skins.empty()) return;  // nothing asks
  const std::size_t count = gltf.nodes.size();
  std::vector<int> parents(count, -1);
  for (std::size_t i = 0; i < count; ++i)
    for (int child : gltf.nodes[i].children)
      if (isIndex(child, count)) parents[static_cast<std::size_t>(child)] = static_cast<int>(i);
  worldFromNode_.resize(count);
  std::vector<bool> known(count);
  for (std::size_t i = 0; i < count; ++i) {
    std::vector<std::size_t> path;  // from the node to an ancestor that is known; no node is its own
    for (int at = static_cast<int>(i); at >= 0 && !known[static_cast<std::size_t>(at)];
         at = parents[static_cast<std::size_t>(at)])
      path.push_back(static_cast<std::size_t>(at));
    for (auto node = path.rbegin(); node != path.rend(); ++node) {
      const int parent = parents[*node];
      const Affine own = transformOf(gltf.nodes[*node]);
      worldFromNode_[*node] = parent < 0 ? own : worldFromNode_[static_cast<std::size_t>(parent)] * own;
      known[*node] = true;
    }
  }
}

bool GltfPose::bends(const tinygltf::Node& node) const {
  if (node.skin >= 0) return true;
  if (targetsOf(gltf_, node) == 0) return false;
  const std::vector<double>& weights = weightsOf(gltf_, node);
  return std::any_of(weights.begin(), weights.end(), [](double w) { return w != 0; });
}

std::size_t GltfPose::bend(const tinygltf::Node& node, const tinygltf::Primitive& primitive, MeshData& mesh) {
  morph(weightsOf(gltf_, node), primitive, mesh);
  return node.skin >= 0 ? applySkin(node.skin, primitive, mesh) : 0;
}

/// Section 3.7.2.2: each target times its weight is added.
void GltfPose::morph(const std::vector<double>& weights, const tinygltf::Primitive& primitive,
                     MeshData& mesh) const {
  for (std::size_t t = 0; t < std::min(weights.size(), primitive.targets.size()); ++t) {
    if (weights[t] == 0) continue;
    for (const auto& [name, vectors] : {std::pair{"POSITION", &mesh.points}, {"NORMAL", &mesh.normals}}) {
      const auto found = primitive.targets[t].find(name);
      if (found == primitive.targets[t].end() || vectors->empty()) continue;
      const GltfElements by = elements_(found->second);
      if (by.components() != 3 || by.count() != vectors->size())
        fail(std::string("a morph target's ") + name + ": expected one vector for each point");
      for (std::size_t i = 0; i < by.count(); ++i)
        (*vectors)[i] = Vec3f(Vec3((*vectors)[i]) + weights[t] * Vec3(by.vector(i)));
    }
    const auto tangent = primitive.targets[t].find("TANGENT");
    if (tangent == primitive.targets[t].end() || mesh.tangents.empty()) continue;
    const GltfElements by = elements_(tangent->second);
    if (by.components() != 3 || by.count() != mesh.tangents.size())
      fail("a morph target's TANGENT: expected one vector for each point");
    for (std::size_t i = 0; i < by.count(); ++i) {
      Vec3f& direction = mesh.tangents[i].direction;
      direction = Vec3f(Vec3(direction) + weights[t] * Vec3(by.vector(i)));
    }
  }
}

/// Section 3.7.3: a point moves with the mean of its joints.
std::size_t GltfPose::applySkin(int skin, const tinygltf::Primitive& primitive, MeshData& mesh) {
  const std::vector<Affine>& joints = jointsOf(skin);
  std::size_t lost = 0;
  std::vector<std::pair<GltfElements, GltfElements>> sets;  // joints and weights, four of each a point
  for (int set = 0;; ++set) {
    const auto joint = primitive.attributes.find("JOINTS_" + std::to_string(set));
    const auto weight = primitive.attributes.find("WEIGHTS_" + std::to_string(set));
    if (joint == primitive.attributes.end() || weight == primitive.attributes.end()) break;
    sets.emplace_back(elements_(joint->second), elements_(weight->second));
    for (const GltfElements* one : {&sets.back().first, &sets.back().second})
      if (one->components() != 4 || one->count() != mesh.points.size())
        fail("JOINTS_" + std::to_string(set) + ": expected four joints and weights for each point");
  }
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    Affine sum = Affine::scaling({0, 0, 0});
    double all = 0;
    for (const auto& [joint, weight] : sets)
      for (std::size_t k = 0; k < 4; ++k) {
        const double w = weight.number(i, k), number = joint.number(i, k);
        if (!(w > 0)) continue;
        if (!(number >= 0 && number < static_cast<double>(joints.size()))) {
          ++lost;
          continue;
        }
        const Affine& by = joints[static_cast<std::size_t>(number)];
        for (int r = 0; r < 3; ++r) sum.row[r] = sum.row[r] + w * by.row[r];
        sum.offset = sum.offset + w * by.offset;
        all += w;
      }
    if (!(all > 0)) continue;  // it stands as it was modelled
    for (Vec3& row : sum.row) row = row / all;
    sum.offset = sum.offset / all;
    mesh.points[i] = moved(sum, mesh.points[i]);
    if (!mesh.tangents.empty()) {
      Vec3f& tangent = mesh.tangents[i].direction;
      tangent = Vec3f(linear(sum, Vec3(tangent)));
    }
    if (mesh.normals.empty()) continue;
    const Vec3 normal(mesh.normals[i]);
    mesh.normals[i] = Vec3f(invertible(sum) ? transposed(inverse(sum), normal) : linear(sum, normal));
  }
  return lost;
}

const std::vector<Affine>& GltfPose::jointsOf(int index) {
  const auto [found, fresh] = joints_.try_emplace(index);
  if (!fresh) return found->second;
  const tinygltf::Skin& skin = gltf_.skins[static_cast<std::size_t>(index)];
  for (int joint : skin.joints) found->second.push_back(worldFromNode_[static_cast<std::size_t>(joint)]);
  if (skin.inverseBindMatrices < 0) return found->second;
  const GltfElements undo = elements_(skin.inverseBindMatrices);
  constexpr std::size_t kMatrix = 16;
  if (undo.components() != kMatrix || undo.count() < skin.joints.size())
    fail("inverseBindMatrices: expected a matrix for each joint");
  for (std::size_t i = 0; i < skin.joints.size(); ++i) {
    const auto column = [&](std::size_t c) {
      return Vec3{undo.number(i, 4 * c), undo.number(i, 4 * c + 1), undo.number(i, 4 * c + 2)};
    };
    const Vec3 x = column(0), y = column(1), z = column(2);
    Affine jointFromMesh;
    jointFromMesh.row[0] = {x.x, y.x, z.x};
    jointFromMesh.row[1] = {x.y, y.y, z.y};
    jointFromMesh.row[2] = {x.z, y.z, z.z};
    jointFromMesh.offset = column(3);
    found->second[i] = found->second[i] * jointFromMesh;
  }
  return found->second;
}

void GltfPose::fail(const std::string& what) const { throw Error(Fault::scene, place_, what); }

}  // namespace trace
