#include "scene/displacement.h"

#include <algorithm>
#include <string>

#include "geometry/mesh/mesh_displace.h"
#include "shading/textures/formula.h"

namespace trace {

Displacement::Displacement(const MeshData& mesh, std::uint32_t material,
                           std::span<const Material> materials) {
  std::vector<std::uint32_t> used = mesh.materials;
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  const bool ofOne = used.empty();
  if (ofOne) used.push_back(material);
  for (const std::uint32_t index : used) {
    if (index >= materials.size() || materials[index].displacement == 0) continue;
    const Material& m = materials[index];
    const Texture* texture = textureOf(m.textures, "displacement");
    parts_.push_back({ofOne ? 0 : index, m.displacement, texture ? std::optional(*texture) : std::nullopt});
    levels_ = std::max(levels_, m.displacementLevels);
  }
}

bool Displacement::wantsUv() const {
  return std::any_of(parts_.begin(), parts_.end(), [](const Part& part) {
    // A formula does not say whether it looks at them.
    return part.texture && !(*part.texture)->model.is<Formula>() && trace::wantsUv(*part.texture);
  });
}

MeshData Displacement::of(const MeshData& mesh, const SourcePlace& place) const {
  constexpr int kMostLevels = 12;  // most levels of one triangle
  if (levels_ > kMostLevels || mesh.triangles.size() > kMostTriangles >> (2 * levels_))
    throw Error(Fault::limit, place,
                "displacement_levels: expected a mesh that gets at most 50 million triangles, found one of " +
                    std::to_string(mesh.triangles.size()) + " before " + std::to_string(levels_) + " levels",
                "each level makes four triangles of one");
  const auto height = [&](const MeshData& cut, std::uint32_t point) -> Real {
    const std::uint32_t material = cut.materials.empty() ? 0 : cut.materials[point];
    const auto part = std::lower_bound(parts_.begin(), parts_.end(), material,
                                       [](const Part& p, std::uint32_t m) { return p.material < m; });
    if (part == parts_.end() || part->material != material) return 0;
    if (!part->texture) return part->height;
    TexturePlace at;
    at.point = Vec3(cut.points[point]);
    if (!cut.uvs.empty()) at.uv = at.secondUv = cut.uvs[point];
    if (!cut.secondUvs.empty()) at.secondUv = cut.secondUvs[point];
    return part->height * luminance(part->texture->at(at));
  };
  try {
    return displaced(mesh, levels_, height);
  } catch (const Error& error) {
    if (error.fault() != Fault::scene) throw;
    throw Error(error.fault(), place, error.messages().front().what, error.messages().front().hint);
  }
}

std::shared_ptr<const MeshData> displacedMesh(const Object& object, std::span<const Material> materials) {
  const auto* mesh = object.shape.as<Mesh>();
  if (!mesh) return nullptr;
  const Displacement displacement(*mesh->data, object.material, materials);
  if (displacement.none()) return mesh->data;
  return std::make_shared<const MeshData>(displacement.of(*mesh->data, object.place));
}

}  // namespace trace
