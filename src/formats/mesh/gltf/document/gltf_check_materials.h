// Requirements of the glTF specification on materials, textures and samplers.
#pragma once

#include "formats/mesh/gltf/document/gltf_rules.h"

namespace trace {

class GltfMaterialCheck : public GltfRules {
 public:
  using GltfRules::GltfRules;

  void checkMaterial(const Part& material);
  void checkSampler(const Part& sampler);

 private:
  void checkLayers(const Part& material);
  void checkPassage(const Part& material);
  void texture(const Part& owner, std::string_view key);
  /// One of OpenGL's numbers.
  void code(const Part& owner, std::string_view key, std::initializer_list<int> codes);
};

}  // namespace trace
