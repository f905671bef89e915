// The rays of a tree with everything in words that an answer needs: THE walk over a tree of rays.
//
// Text, JSON and OBJ print what stands here and look nothing up themselves, so that none of them can name a
// thing that another cannot, or fail where another does not.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/explain/ray_segments.h"
#include "render/rays/ray_tree.h"

namespace trace {

/// A surface or medium that a ray hit or passed: an object at one hit point, or air.
struct NamedBody {
  struct Share {
    std::optional<std::uint32_t> material;  ///< index into Scene::materials; nothing for what is clear
    std::string name;
    Real weight = 1;
  };
  std::optional<std::uint32_t> object;  ///< index into Scene::objects; nothing for air
  std::string name;                     ///< fillingName(): never empty
  std::string ownName;                  ///< as the scene has it; "" without one
  std::string shape;                    ///< its keyword; "" for air
  bool isMesh = false;
  SourcePlace place;
  std::vector<Share> materials;  ///< at the hit; of a crossed medium, of the object
  std::string material;          ///< the name of the one that weighs most; "" for air
  std::string madeOf;            ///< materialNames() of all of them
};

struct ExplainedTerm {
  std::string light;           ///< the name of the light that it is of; "" if it is of none
  std::string_view lightKind;  ///< its keyword
  SourcePlace lightPlace;
  std::optional<NamedBody> medium;  ///< medium of a MediumTerm
};

struct ExplainedRay {
  const RayNode* node = nullptr;  ///< in the tree
  std::vector<int> children;      ///< rays that it sent, in the order of tracing
  RaySegment segment;
  std::string sentence;                        ///< why it ends
  std::string light;                           ///< the name of the light that it asks; "" for other rays
  std::optional<NamedBody> hit;                ///< what it hit
  std::vector<std::string> ignored;            ///< a sentence for each of RayNode::ignored
  std::vector<NamedBody> filters;              ///< as RayNode::filters
  std::vector<std::optional<NamedBody>> ends;  ///< as RayNode::ends, where they name an object
  std::vector<ExplainedTerm> terms;            ///< as RayNode::terms
};

/// One for each ray, in the tree's order. The tree has to outlive them.
std::vector<ExplainedRay> explainedRays(const RayTree& tree, const Scene& scene);

/// A Wavefront OBJ file of the rays' segments as lines, a group for each look, `# ray N` before each.
std::string raysAsObj(const RayTree& tree, const std::vector<ExplainedRay>& rays);

}  // namespace trace
