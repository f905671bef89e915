// Materials of a glTF file: their numbers, those of their extensions, and their pictures, as
// gltf_material.h takes them.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "formats/model_textures.h"

namespace tinygltf {
class Model;
struct Image;
}  // namespace tinygltf

namespace trace {

/// The name of the picture's file, decoded; empty for one inside the file.
std::string fileOf(const tinygltf::Image& image);

/// All materials of a file. Precondition: checkGltf() found its indices sound.
class GltfLooks {
 public:
  GltfLooks(const tinygltf::Model& gltf, const SourcePlace& place, Messages& messages);
  ~GltfLooks();

  /// In the order of the file.
  std::vector<Material> materials();
  /// The numbers of the texture coordinates that the pictures of a material use, in the order in which they
  /// ask for them; nothing beyond those.
  using UvSets = std::array<std::optional<int>, 2>;
  UvSets uvSets(int material) const;
  /// Tells of pictures that are not rendered or cannot be read. Call once, after all meshes.
  void report() const;

 private:
  struct Reader;
  std::unique_ptr<Reader> reader_;
};

}  // namespace trace
