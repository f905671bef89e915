#include "formats/model.h"

#include <cmath>
#include <map>
#include <utility>

#include "base/match.h"
#include "geometry/mesh_repair.h"

namespace trace {
namespace {

bool isFinite(const Vec3f& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

Material colored(const Material& base, const Color& color) {
  Material material = base;
  match(material.model, [&](auto& model) { model.diffuse = model.ambient = color; });
  std::erase_if(material.maps,
                [](const FieldMap& map) { return map.field == "diffuse" || map.field == "ambient"; });
  return material;
}

/// The mesh with the numbers of its colours replaced by those of materials.
Mesh withMaterials(const MeshData& mesh, const Model& model, const Material& base,
                   const std::function<std::uint32_t(const Material&)>& index) {
  MeshData data = mesh;
  std::vector<std::uint32_t> numbers(model.colors.size(), Model::kNoMaterial);
  for (std::uint32_t& material : data.materials) {
    std::uint32_t& number = numbers[material];
    if (number == Model::kNoMaterial) number = index(colored(base, model.colors[material]));
    material = number;
  }
  return {std::make_shared<const MeshData>(std::move(data))};
}

}  // namespace

void checkMesh(MeshData& mesh, const std::string& file, Messages& messages) {
  const Place place{file, 0, 0, {}};
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    if (!isFinite(mesh.points[i]))
      throw Error(Fault::scene, place,
                  "point " + std::to_string(i) + ": expected three finite numbers of at most 3.4e38");
  std::size_t odd = 0;
  for (Vec3f& normal : mesh.normals)
    if (!isFinite(normal)) normal = {}, ++odd;
  for (Vec2& uv : mesh.uvs)
    if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) uv = {}, ++odd;
  if (odd > 0) messages.warn(place, "normals or uv that are not finite are replaced: " + std::to_string(odd));
  if (const std::size_t n = dropDegenerate(mesh); n > 0)
    messages.warn(place, "triangles without area are left out: " + std::to_string(n));
  if (const std::size_t n = repairNormals(mesh); n > 0)
    messages.warn(place, "normals of length 0 are taken from the faces: " + std::to_string(n));
}

std::vector<Object> placed(const Model& model, const Material& base,
                           const std::function<std::uint32_t(const Material&)>& index) {
  std::vector<std::uint32_t> numbers;
  for (const Material& material : model.materials) numbers.push_back(index(material));
  std::optional<std::uint32_t> baseNumber;
  std::map<std::pair<const MeshData*, std::uint32_t>, Mesh> colored;  // instances share these too
  std::vector<Object> objects = model.objects;
  for (Object& object : objects) {
    const std::uint32_t own = object.material;
    const bool none = own == Model::kNoMaterial;
    if (none && !baseNumber) baseNumber = index(base);
    object.material = none ? *baseNumber : numbers[own];
    auto* mesh = std::get_if<Mesh>(&object.shape);
    if (!mesh || mesh->data->materials.empty()) continue;
    const auto [found, fresh] = colored.try_emplace({mesh->data.get(), own});
    if (fresh) found->second = withMaterials(*mesh->data, model, none ? base : model.materials[own], index);
    *mesh = found->second;
  }
  return objects;
}

Scene sceneOf(Model model, const std::string& file, std::string_view format) {
  Scene scene;
  scene.file = file;
  scene.format = format;
  scene.objects = placed(model, plainMaterial(), [&](const Material& material) {
    scene.materials.push_back(material);
    return static_cast<std::uint32_t>(scene.materials.size() - 1);
  });
  scene.choices = std::move(model.choices);
  scene.camera = model.camera ? *model.camera : framing(bounds(scene));
  scene.lights = model.lights.empty() ? plainLights(scene.camera) : std::move(model.lights);
  return scene;
}

Material plainMaterial() {
  Phong phong;
  phong.ambient = phong.diffuse = Color(0.7);
  return {"", phong, {}};
}

Box3 bounds(const Scene& scene) {
  Box3 box;
  for (const Object& object : scene.objects)
    box.extend(object.worldFromObject *
               match(object.shape, Overloaded{[](const Mesh& mesh) { return bounds(*mesh.data); },
                                              [](const auto& shape) { return shape.bounds(); }}));
  return box;
}

Camera framing(const Box3& box) {
  constexpr Real kFov = 40;
  Camera camera;
  camera.fov = kFov;
  camera.viewdir = normalize({-0.35, -0.3, -1});
  const bool nothing = box.empty() || !isFinite(box.size());
  const Vec3 centre = nothing ? Vec3{} : box.center();
  const Real radius = nothing ? 1 : length(box.size()) / 2;
  // So far that the sphere around the box just touches the edges of the picture.
  camera.position = centre - camera.viewdir * ((radius > 0 ? radius : 1) / std::sin(kFov * kPi / 360));
  return camera;
}

std::vector<LightSource> plainLights(const Camera& camera) {
  const CameraFrame axes = frame(camera, CameraAxes::orthonormal);
  const Vec3 right = normalize(axes.right), up = normalize(axes.up), look = normalize(axes.look);
  const auto light = [&](Real x, Real y, Real brightness) {
    return LightSource{
        DirectionalLight{.direction = normalize(look + right * x + up * y), .color = Color(brightness)}, {}};
  };
  return {light(0.6, -0.9, 0.85), light(-0.9, -0.1, 0.3), {AmbientLight{.color = Color(0.12)}, {}}};
}

}  // namespace trace
