#include "shading/texture_flaws.h"

#include <cmath>

#include "shading/textures/formula.h"
#include "shading/textures/image_map.h"

namespace trace {
namespace {

/// Has the formula a value at some place of the object? Tried where objects are as a rule.
bool hasValue(const std::string& text) {
  const Expression formula(text, Expression::Variables::xyzuv);
  for (const Real x : {-1.3, 0.0, 0.7})
    for (const Real y : {-0.9, 0.0, 1.1})
      for (const Real z : {-1.7, 0.0, 0.3})
        for (const Real u : {0.0, 0.4})
          if (std::isfinite(formula.at({x, y, z}, {u, 0.6 - u}))) return true;
  return false;
}

void addFlaws(const Formula& formula, std::vector<std::string>& flaws) {
  if (formula == Formula{}) flaws.push_back("formula: expected value, or red, green and blue: it is black");
  forEachField<Formula>([&](const auto& f) {
    if constexpr (requires { (formula.*f.member).text(); }) {
      const std::string& text = (formula.*f.member).text();
      if (!text.empty() && !hasValue(text))
        flaws.push_back("formula: " + std::string(f.keyword) + " has no value, as of 1/0: it counts as 0");
    }
  });
}

}  // namespace

std::vector<std::string> flawsOf(const TextureNode& node) {
  std::vector<std::string> flaws;
  const Vec3& scale = node.placement.scale;
  if (scale.x == 0 || scale.y == 0 || scale.z == 0)
    flaws.push_back("the scale of a texture has a 0, so the texture is placed as without one");
  if (const auto* map = node.model.as<ImageMap>(); map && map->file.file.empty())
    flaws.push_back("image: expected a file, as in image { file = \"wood.png\"; }: it is black");
  if (const auto* formula = node.model.as<Formula>()) addFlaws(*formula, flaws);
  return flaws;
}

}  // namespace trace
