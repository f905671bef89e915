// Why a pixel has its colour, in one sentence; the sum that it is; and what would change it.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "render/rays/ray_tree.h"
#include "scene/settings.h"

namespace trace {

/// A summand of the camera ray's radiance: the terms of one kind and one light together.
struct WhySummand {
  std::string name;   ///< "reflection", "light lamp"
  std::string brief;  ///< "reflection", "lamp"
  Color color;
  int ray = -1;          ///< the first ray that it came along; -1: none
  int last = -1;         ///< the last ray that it needs, in the order of tracing
  std::string phrase{};  ///< within a sentence: "a reflection", "the light of lamp"
};

/// A change that may cure the pixel: a value of an option, or a thing of the scene to look at.
struct WhyCure {
  std::string label;  ///< "depth 5", "Select shade"
  std::string_view option{};
  std::string value{};
  std::optional<std::uint32_t> object{};  ///< index into Scene::objects
};

struct PixelWhy {
  std::string sentence;  ///< "Black: the ray that should leave ball was not sent: depth limit 1."
  int ray = -1;          ///< the ray at fault; -1: none is
  std::vector<WhySummand> sum;
  std::vector<WhyCure> cures;  ///< the strongest last
};

/// The last ray, in the order of tracing, of those that come from this one.
int lastBelow(const RayTree& tree, int ray);

/// The terms of a ray's radiance, in their order: those of one kind and one light together.
std::vector<WhySummand> sumOf(const RayTree& tree, const Scene& scene, int ray = 0);

/// That sum in words: "0.5 0.4 0.3 = light lamp 0.4 0.3 0.2 + reflection 0.1 0.1 0.1"; of a shadow ray, the
/// share of the light that passes.
std::string equationOf(const RayTree& tree, const Scene& scene, int ray);

/// The sum after the first `rays` rays in the order of tracing: its terms of which no ray is missing.
Color sumAfter(const std::vector<WhySummand>& sum, int rays);

/// The sample's radiance with another value of an option; nothing if that takes too long.
using Retrace = std::function<std::optional<Color>(std::string_view option, const std::string& value)>;

/// Explains the sample that the tree has. Black and dark are judged as the picture shows them, with the
/// exposure of the settings. The cause is what takes the most light from the pixel. Options are offered as
/// cures if `retrace`, where there is one, shows that they change the pixel.
PixelWhy whyOf(const RayTree& tree, const Scene& scene, const Settings& settings,
               const Retrace& retrace = {});

}  // namespace trace
