#include "formats/mesh/world_meshes.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "base/budget.h"
#include "formats/model.h"
#include "geometry/mesh/mesh.h"
#include "geometry/mesh/tessellation.h"
#include "scene/displacement.h"
#include "shading/textures/image_map.h"

namespace trace {
namespace {

MeshData transformed(const MeshData& mesh, const Affine& worldFromObject) {
  MeshData result = mesh.generateNormals ? withGeneratedNormals(mesh, true) : mesh;
  if (worldFromObject == Affine{}) return result;
  const Affine objectFromWorld = inverse(worldFromObject);
  for (Vec3f& p : result.points) p = Vec3f(worldFromObject * Vec3(p));
  for (Vec3f& n : result.normals) {
    const Vec3 turned = transposed(objectFromWorld, Vec3(n));
    if (turned != Vec3{}) n = Vec3f(normalize(turned));
  }
  if (determinant(worldFromObject) < 0)
    for (Triangle& t : result.triangles) std::swap(t[1], t[2]);
  return result;
}

/// The picture, if the texture is one that lies as the texture coordinates have it, or half a texel beside.
const ImageMap* plainPicture(const Texture& texture) {
  const auto* map = texture->model.as<ImageMap>();
  if (!map || !texture->inputs.empty() || !(texture->placement == TexturePlacement{})) return nullptr;
  if (map->wrapU != map->wrapV || map->wrapU == Wrap::mirror) return nullptr;
  ImageMap usual{.file = map->file, .wrapU = map->wrapU, .wrapV = map->wrapV};
  usual.filter = map->filter;
  usual.centersAtEnds = map->centersAtEnds;
  usual.srgb = map->srgb;
  return *map == usual ? map : nullptr;
}

/// It is the picture of the material, or says the same of its share of the ambient light.
bool isWritten(const FieldTexture& field, const ImageMap* picture) {
  const ImageMap* map = plainPicture(field.texture);
  const bool known = field.field == kDiffuse || field.field == kColor || field.field == kAmbient;
  return picture && map && known && map->file == picture->file;
}

/// Says what of the scene a file of meshes has no words for.
void warnOfTheRest(const Scene& scene, const SourcePlace& place, Messages& messages) {
  std::vector<std::string> parts;
  const bool hasView = !isPlainView(scene);  // a mesh file has none of its own
  if (hasView && !(scene.camera == Camera{})) parts.emplace_back("the camera");
  if (const std::size_t n = scene.lights.size(); hasView && n > 0)
    parts.push_back(n == 1 ? "the light" : "the " + std::to_string(n) + " lights");
  if (!(scene.background == Background{})) parts.emplace_back("the background");
  const auto textured = std::count_if(scene.materials.begin(), scene.materials.end(), [](const Material& m) {
    return !std::all_of(m.textures.begin(), m.textures.end(),
                        [&](const FieldTexture& field) { return isWritten(field, pictureOf(m)); });
  });
  if (textured > 0)
    parts.push_back("textures of " + std::to_string(textured) + (textured == 1 ? " material" : " materials"));
  std::string list;
  for (std::size_t i = 0; i < parts.size(); ++i)
    list += (i == 0 ? "" : i + 1 == parts.size() ? " and " : ", ") + parts[i];
  if (!list.empty()) messages.warn(place, "left out, as the format has none of them: " + list);
}

}  // namespace

const ImageMap* pictureOf(const Material& material) {
  for (const std::string_view field : {kDiffuse, kColor})
    if (const Texture* texture = textureOf(material.textures, field)) return plainPicture(*texture);
  return nullptr;
}

std::optional<MeshData> ShapeTriangles::of(const Shape& shape, bool mapped) {
  int followed = steps_;
  std::optional<MeshData> mesh = tessellated(shape, steps_, mapped, &followed, wanted_);
  if (mesh) fewest_ = std::min(fewest_, followed);
  any_ |= mesh.has_value();
  return mesh;
}

void ShapeTriangles::report(const SourcePlace& place, const std::string& known, bool nothing,
                            Messages& messages) const {
  const char *kHolds = "a .ray file stores every shape",
             *kWhy =
                 "no mesh can follow an infinite shape, or one that folds finer than a 64th of its size; a "
                 ".ray file stores every shape";
  std::string kinds;
  for (const auto& [kind, count] : leftOut_)
    kinds += (kinds.empty() ? "" : ", ") + std::to_string(count) + " " + kind;
  if (nothing)
    throw Error(Fault::scene, place,
                "expected a scene with meshes, found " + (kinds.empty() ? "no object" : kinds),
                kinds.empty() ? kHolds : kWhy);
  if (any_) messages.warn(place, "shapes other than " + known + " become triangles");
  if (fewest_ < steps_)
    messages.warn(place,
                  "a surface that folds finely becomes triangles in " + std::to_string(fewest_) +
                      " steps along it, not " + std::to_string(steps_) + ", which would take minutes",
                  "--steps " + std::to_string(steps_) + " makes them all");
  if (!kinds.empty()) messages.warn(place, "left out, as they cannot become triangles: " + kinds, kWhy);
}

std::vector<WorldMesh> worldMeshes(const Scene& scene, const WriteOptions& options, Messages& messages) {
  const SourcePlace place{scene.file, 0, 0, {}};
  std::vector<WorldMesh> meshes;
  ShapeTriangles shapes(options.steps);
  Work work("making triangles of the objects", static_cast<std::int64_t>(scene.objects.size()));
  std::int64_t done = 0;
  for (const Object& object : scene.objects) {
    work.reached(done++);
    std::optional<MeshData> triangles;
    const auto mesh = displacedMesh(object, scene.materials);
    if (!mesh) triangles = shapes.of(object.shape, pictureOf(scene.materials.at(object.material)) != nullptr);
    if ((mesh || triangles) && invertible(object.worldFromObject))
      meshes.push_back(
          {object.name, object.material, transformed(mesh ? *mesh : *triangles, object.worldFromObject)});
    else
      shapes.leaveOut(object.shape);
  }
  shapes.report(place, "meshes", meshes.empty(), messages);
  warnOfTheRest(scene, place, messages);
  return meshes;
}

MeshData withFlatNormals(const MeshData& mesh) {
  MeshData flat;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto first = static_cast<std::uint32_t>(flat.points.size());
    for (std::uint32_t point : mesh.triangles[i]) {
      flat.points.push_back(mesh.points[point]);
      flat.normals.push_back(Vec3f(normalize(faceNormal(mesh, i))));
      if (!mesh.materials.empty()) flat.materials.push_back(mesh.materials[point]);
      if (!mesh.uvs.empty()) flat.uvs.push_back(mesh.uvs[point]);
    }
    flat.triangles.push_back({first, first + 1, first + 2});
  }
  return flat;
}

}  // namespace trace
