// A choice among many lights, at random: near, strong ones that shine toward a place are taken more often
// (Conty Estevez and Kulla, Importance Sampling of Many Lights with Adaptive Tree Splitting, 2018; Pharr,
// Jakob and Humphreys, Physically Based Rendering, 4th edition, 2023, section 12.6.3).
//
// A binary tree over the lights: each node bounds where its lights are, where they shine and how strongly. A
// choice walks from the root to one light, and goes each way as often as the bounds say that light may come
// from there. So it costs about the logarithm of the number of lights, and its probability is known exactly.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "math/vec.h"
#include "shading/lights/light_reach.h"

namespace trace {

class LightTree {
 public:
  LightTree() = default;
  /// Lights are called by their numbers in the list. Those without power are never chosen.
  explicit LightTree(std::span<const LightReach> lights);

  bool empty() const { return tops_.empty(); }

  struct Choice {
    std::uint32_t light;
    Real probability;
  };
  /// For a place, and the unit normal on the side that is lit, if there is one: the light that a number from
  /// 0 up to 1 chooses. Nothing where the way leads to none that shines there.
  std::optional<Choice> choose(const Vec3& from, const Vec3* normal, Real which) const;
  /// With which choose() gives that light.
  Real probability(const Vec3& from, const Vec3* normal, std::uint32_t light) const;

  std::size_t bytes() const { return nodes_.size() * sizeof(Node) + leaves_.size() * sizeof(std::uint32_t); }
  /// The most steps that a choice takes.
  int depth() const { return depth_; }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffu;

  /// Rounded so that it bounds what it is made of.
  struct Node {
    float middle[3], radius;  ///< middle and radius of a ball around its lights
    float axis[3];
    float cosAround, sinAround, cosBeyond;
    float power;
    float fading[3], most;
    std::uint32_t parent = kNone;
    std::uint32_t first = kNone;  ///< first of its two children; of a leaf its light
    bool leaf = false, twoSided = false, everywhere = false;
  };
  class Builder;

  static Real importance(const Node& node, const Vec3& from, const Vec3* normal);
  Real importanceOfAll(const Vec3& from, const Vec3* normal) const;

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> tops_;    ///< nodes: the root of the tree, and each parallel light
  std::vector<std::uint32_t> leaves_;  ///< the node of each light; kNone: it is dark
  int depth_ = 0;
};

}  // namespace trace
