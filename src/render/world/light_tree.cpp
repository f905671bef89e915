#include "render/world/light_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/budget.h"
#include "math/elementary.h"

namespace trace {
namespace {

/// Beyond this depth a tree is halved by numbers, whatever the lights are like.
constexpr int kDeep = 48;
constexpr int kBuckets = 12;
/// The weight of a light behind the surface: some materials are lit from there, too.
constexpr Real kBehind = 0.05;
/// The most that nearness counts.
constexpr Real kNearest = 1e30;
constexpr Real kJustBelowOne = 1 - 0x1p-53;

/// Bounds two cones of directions.
void widen(LightReach& cone, const LightReach& other) {
  LightReach wide = cone, narrow = other;
  if (narrow.around > wide.around) std::swap(wide, narrow);
  cone.beyond = std::max(cone.beyond, other.beyond);
  cone.twoSided = cone.twoSided || other.twoSided;
  const Real between = math::acos(std::clamp(dot(wide.axis, narrow.axis), -1.0, 1.0));
  cone.axis = wide.axis;
  cone.around = wide.around;
  if (std::min(between + narrow.around, kPi) <= wide.around) return;
  const Real around = (wide.around + between + narrow.around) / 2;
  const Vec3 about = cross(wide.axis, narrow.axis);
  const Real length2 = dot(about, about);
  if (around >= kPi || !(length2 > 0)) {
    cone.around = kPi;
    return;
  }
  // The axis turned toward the other (Rodrigues).
  const Real turn = around - wide.around;
  const Vec3 side = cross(about / std::sqrt(length2), wide.axis);
  cone.axis = normalize(wide.axis * math::cos(turn) + side * math::sin(turn));
  cone.around = around;
}

void add(LightReach& all, const LightReach& one) {
  if (!(all.power > 0)) {
    all = one;
    return;
  }
  const Real share = one.power / (all.power + one.power);
  widen(all, one);
  all.box.extend(one.box);
  all.fading = all.fading * (1 - share) + one.fading * share;
  all.most = std::max(all.most, one.most);
  all.power += one.power;
}

/// How much light is expected of a group, as a cost: its power, the size of its box and of its cone.
Real cost(const LightReach& group) {
  if (!(group.power > 0)) return 0;
  const Real in = group.around, out = std::min(in + group.beyond, kPi);
  const Real cone =
      2 * kPi * (1 - math::cos(in)) +
      kPi / 2 * (2 * out * math::sin(in) - math::cos(in - 2 * out) - 2 * in * math::sin(in) + math::cos(in));
  const Vec3 size = group.box.size();
  return group.power * cone * dot(size, size);
}

/// Cosine and sine of the difference of two angles, or of 0 where the second is larger.
void lessen(Real& cosine, Real& sine, Real cosOther, Real sinOther) {
  if (cosine > cosOther) {
    cosine = 1;
    sine = 0;
    return;
  }
  const Real c = cosine * cosOther + sine * sinOther;
  sine = sine * cosOther - cosine * sinOther;
  cosine = c;
}

}  // namespace

class LightTree::Builder {
 public:
  Builder(LightTree& tree, std::span<const LightReach> lights) : tree_(tree), lights_(lights) {}

  void build() {
    tree_.leaves_.assign(lights_.size(), kNone);
    std::vector<std::uint32_t> local;
    for (std::uint32_t i = 0; i < lights_.size(); ++i) {
      const LightReach& light = lights_[i];
      if (!(light.power > 0 && light.power < kInfinity)) continue;
      if (!light.everywhere && (light.box.empty() || light.box.unbounded())) continue;
      if (light.everywhere) {
        tree_.tops_.push_back(addNode(light));
        makeLeaf(tree_.tops_.back(), i);
      } else {
        local.push_back(i);
      }
    }
    if (local.empty()) return;
    const std::uint32_t root = addNode({});
    tree_.tops_.push_back(root);
    fill(root, local, 0);
  }

 private:
  std::uint32_t addNode(const LightReach& reach) {
    tree_.nodes_.push_back(packed(reach));
    return static_cast<std::uint32_t>(tree_.nodes_.size() - 1);
  }
  void makeLeaf(std::uint32_t node, std::uint32_t light) {
    tree_.nodes_[node].leaf = true;
    tree_.nodes_[node].first = light;
    tree_.leaves_[light] = node;
  }

  static Node packed(const LightReach& reach) {
    constexpr float kOutward = 1e-6f;  // more than floats round
    Node node{};
    const Vec3 middle = reach.box.empty() ? Vec3{} : reach.box.center();
    const Vec3 far = max(reach.box.high - middle, middle - reach.box.low);
    for (int k = 0; k < 3; ++k) {
      node.middle[k] = static_cast<float>(middle[k]);
      node.axis[k] = static_cast<float>(reach.axis[k]);
      node.fading[k] = static_cast<float>(reach.fading[k]);
    }
    node.radius = reach.box.empty() ? 0
                                    : static_cast<float>(length(far)) * (1 + kOutward) +
                                          static_cast<float>(length(middle)) * kOutward;
    const auto wider = [](Real angle) {
      return std::max(-1.0f, static_cast<float>(math::cos(std::min(angle, kPi))) - kOutward);
    };
    node.cosAround = wider(reach.around);
    node.sinAround = std::sqrt(std::max(0.0f, 1 - node.cosAround * node.cosAround));
    node.cosBeyond = wider(reach.beyond);
    node.power = static_cast<float>(std::min(reach.power, kNearest));
    node.most = static_cast<float>(std::min(reach.most, kNearest));
    node.twoSided = reach.twoSided;
    node.everywhere = reach.everywhere;
    return node;
  }

  LightReach fill(std::uint32_t node, std::span<std::uint32_t> lights, int depth) {
    checkBudget();
    tree_.depth_ = std::max(tree_.depth_, depth);
    if (lights.size() == 1) {
      const LightReach& light = lights_[lights.front()];
      tree_.nodes_[node] = packed(light);
      makeLeaf(node, lights.front());
      return light;
    }
    const std::size_t half = split(lights, depth);
    const std::uint32_t first = addNode({});
    addNode({});
    LightReach all = fill(first, lights.first(half), depth + 1);
    add(all, fill(first + 1, lights.subspan(half), depth + 1));
    tree_.nodes_[node] = packed(all);
    tree_.nodes_[node].first = first;
    tree_.nodes_[first].parent = tree_.nodes_[first + 1].parent = node;
    return all;
  }

  /// Sorts the lights into two groups, and says where the second begins.
  std::size_t split(std::span<std::uint32_t> lights, int depth) const {
    const std::size_t middle = lights.size() / 2;
    Box3 centers;
    for (const std::uint32_t light : lights) centers.extend(lights_[light].box.center());
    const Vec3 size = centers.size();
    const Real longest = maxComponent(size);
    if (depth >= kDeep || !(longest > 0)) return middle;
    int bestAxis = -1, bestAt = 0;
    Real best = kInfinity;
    const auto bucketOf = [&](std::uint32_t light, int axis) {
      const Real along = (lights_[light].box.center()[axis] - centers.low[axis]) / size[axis];
      return std::clamp(static_cast<int>(along * kBuckets), 0, kBuckets - 1);
    };
    for (int axis = 0; axis < 3; ++axis) {
      if (!(size[axis] > 0)) continue;
      std::array<LightReach, kBuckets> buckets{}, above{};
      for (const std::uint32_t light : lights)
        add(buckets[static_cast<std::size_t>(bucketOf(light, axis))], lights_[light]);
      LightReach sum;
      for (std::size_t i = kBuckets; i-- > 1;) {
        if (buckets[i].power > 0) add(sum, buckets[i]);
        above[i] = sum;
      }
      sum = {};
      for (std::size_t i = 0; i + 1 < kBuckets; ++i) {
        if (buckets[i].power > 0) add(sum, buckets[i]);
        if (!(sum.power > 0 && above[i + 1].power > 0)) continue;
        // Thin slabs are dearer: they bound distances badly.
        const Real here = (cost(sum) + cost(above[i + 1])) * longest / size[axis];
        if (here < best) {
          best = here;
          bestAxis = axis;
          bestAt = static_cast<int>(i);
        }
      }
    }
    if (bestAxis < 0) return middle;
    const auto end = std::stable_partition(lights.begin(), lights.end(), [&](std::uint32_t light) {
      return bucketOf(light, bestAxis) <= bestAt;
    });
    return static_cast<std::size_t>(end - lights.begin());
  }

  LightTree& tree_;
  std::span<const LightReach> lights_;
};

LightTree::LightTree(std::span<const LightReach> lights) { Builder(*this, lights).build(); }

/// About the colour that arrives at most of the node's lights (Conty Estevez and Kulla, section 4.2).
Real LightTree::importance(const Node& node, const Vec3& from, const Vec3* normal) {
  const Vec3 axis{node.axis[0], node.axis[1], node.axis[2]};
  if (node.everywhere) return node.power * (normal ? std::max(kBehind, -dot(*normal, axis)) : 1);
  const Vec3 to = Vec3{node.middle[0], node.middle[1], node.middle[2]} - from;
  const Real away2 = dot(to, to), away = std::sqrt(away2), radius = node.radius;
  const Real d = std::max(away, radius);
  Real arrives =
      std::min(Real{node.most}, 1 / (node.fading[0] + node.fading[1] * d + node.fading[2] * d * d));
  arrives = std::min(arrives, kNearest) * node.power;
  if (!(away > radius)) return arrives;
  // The half angle under which its ball is seen.
  const Real sinBall = radius / away, cosBall = std::sqrt(1 - sinBall * sinBall);
  if (node.cosAround > -1) {
    Real cosine = -dot(axis, to) / away;
    if (node.twoSided) cosine = std::abs(cosine);
    Real sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    lessen(cosine, sine, node.cosAround, node.sinAround);
    lessen(cosine, sine, cosBall, sinBall);
    if (cosine < node.cosBeyond) return 0;
    arrives *= cosine;
  }
  if (normal) {
    Real cosine = std::clamp(dot(*normal, to) / away, -1.0, 1.0);
    Real sine = std::sqrt(1 - cosine * cosine);
    lessen(cosine, sine, cosBall, sinBall);
    arrives *= std::max(kBehind, cosine);
  }
  return arrives;
}

Real LightTree::importanceOfAll(const Vec3& from, const Vec3* normal) const {
  Real all = 0;
  for (const std::uint32_t top : tops_) all += importance(nodes_[top], from, normal);
  return all;
}

std::optional<LightTree::Choice> LightTree::choose(const Vec3& from, const Vec3* normal, Real which) const {
  const Real all = importanceOfAll(from, normal);
  if (!(all > 0)) return {};
  Real rest = which * all;
  std::uint32_t at = kNone;
  Real probability = 0;
  for (const std::uint32_t top : tops_) {
    const Real own = importance(nodes_[top], from, normal);
    if (!(own > 0)) continue;
    at = top;
    probability = own / all;
    if (rest < own) {
      which = rest / own;
      break;
    }
    rest -= own;
    which = kJustBelowOne;
  }
  while (!nodes_[at].leaf) {
    const std::uint32_t first = nodes_[at].first;
    const Real a = importance(nodes_[first], from, normal), b = importance(nodes_[first + 1], from, normal);
    if (!(a + b > 0)) return {};
    const Real share = a / (a + b);
    const bool second = which >= share;
    which = std::min(kJustBelowOne, second ? (which - share) / (1 - share) : which / share);
    probability *= second ? b / (a + b) : share;
    at = first + second;
  }
  return Choice{nodes_[at].first, probability};
}

Real LightTree::probability(const Vec3& from, const Vec3* normal, std::uint32_t light) const {
  std::uint32_t at = leaves_[light];
  if (at == kNone) return 0;
  Real probability = 1;
  while (nodes_[at].parent != kNone) {
    const std::uint32_t parent = nodes_[at].parent, first = nodes_[parent].first;
    const Real own = importance(nodes_[at], from, normal),
               other = importance(nodes_[first + (at == first)], from, normal);
    if (!(own > 0)) return 0;
    probability *= own / (own + other);
    at = parent;
  }
  const Real own = importance(nodes_[at], from, normal);
  return own > 0 ? probability * own / importanceOfAll(from, normal) : 0;
}

}  // namespace trace
