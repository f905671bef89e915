#include "formats/model.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/match.h"
#include "geometry/mesh/mesh.h"
#include "geometry/mesh/mesh_repair.h"
#include "geometry/shapes/solids/csg_tree.h"
#include "geometry/traced.h"
#include "math/elementary.h"
#include "shading/lights/plain_lights.h"

namespace trace {
namespace {

bool isFinite(const Vec3f& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// An object that only emits has its colour there.
bool onlyShines(const Material& material) {
  const Phong phong = phongOf(material.model);
  return isBlack(phong.diffuse) && isBlack(phong.specular) && isBlack(phong.ambient) &&
         !isBlack(phong.emissive);
}

/// A texture of the model's own material is multiplied by the colour; of one that the model only stands in,
/// the colour takes the place of the texture.
Material colored(const Material& base, const Color& color, bool keepTextures) {
  Material material = base;
  if (onlyShines(base)) {
    changeColors(material.model, {kEmissive}, [&](const Color&) { return color; });
    return material;
  }
  const auto own = {kDiffuse, kColor, kAmbient};
  changeColors(material.model, own, [&](const Color&) { return color; });
  std::erase_if(material.textures, [&](const FieldTexture& t) {
    return !keepTextures && std::find(own.begin(), own.end(), t.field) != own.end();
  });
  return material;
}

/// The mesh with the numbers of its colours replaced by those of materials.
Mesh withMaterials(const MeshData& mesh, const Model& model, const Material& base, bool isOwn,
                   const std::function<std::uint32_t(const Material&)>& index) {
  MeshData data = mesh;
  std::vector<std::uint32_t> numbers(model.colors.size(), Model::kNoMaterial);
  for (std::uint32_t& material : data.materials) {
    std::uint32_t& number = numbers[material];
    if (number == Model::kNoMaterial) number = index(colored(base, model.colors[material], isOwn));
    material = number;
  }
  return {std::make_shared<const MeshData>(std::move(data))};
}

}  // namespace

void CountedFlaw::report(std::string_view what, Messages& messages) const {
  if (count == 0) return;
  const std::string name = first.name.empty() ? "" : ", first at " + first.name;
  messages.warn(first.place, std::string(what) + ": " + std::to_string(count) + name);
}

void MeshRepairs::check(MeshData& mesh, const SourcePlace& place) {
  check(mesh, [&](MeshPart, std::size_t) { return MeshSpot{place}; });
}

void MeshRepairs::check(MeshData& mesh, const FindInFile& find) {
  const auto spotOf = [&](MeshPart part, std::size_t index) {
    return [&find, part, index] { return find(part, index); };
  };
  const std::vector<std::uint32_t> former = dropInfinite(mesh, find);
  for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
    Vec3f& normal = mesh.normals[i];
    if (normal == Vec3f{} && !mesh.generateNormals) zeroNormals_.add(1, spotOf(MeshPart::normal, i));
    if (isFinite(normal)) continue;
    normal = {};
    infiniteNormals_.add(1, spotOf(MeshPart::normal, i));
  }
  for (std::vector<Vec2>* uvs : {&mesh.uvs, &mesh.secondUvs})
    for (std::size_t i = 0; i < uvs->size(); ++i) {
      Vec2& uv = (*uvs)[i];
      if (std::isfinite(uv.x) && std::isfinite(uv.y)) continue;
      uv = {};
      infiniteUvs_.add(1, spotOf(MeshPart::uv, i));
    }
  const Degenerate flat = dropDegenerate(mesh);
  withoutArea_.add(flat.count, spotOf(MeshPart::triangle, former.empty() ? flat.first : former[flat.first]));
  repairNormals(mesh);
  triangles_ += mesh.triangles.size();
}

void MeshRepairs::checkColors(std::vector<Vec3f>& colors, const FindInFile& find, float white) {
  for (std::size_t i = 0; i < colors.size(); ++i) {
    if (isFinite(colors[i])) continue;
    colors[i] = {white, white, white};
    infiniteColors_.add(1, [&] { return find(MeshPart::color, i); });
  }
}

std::vector<std::uint32_t> MeshRepairs::dropInfinite(MeshData& mesh, const FindInFile& find) {
  const auto isOdd = [&](const Vec3f& point) { return !isFinite(point); };
  const auto firstOdd = std::find_if(mesh.points.begin(), mesh.points.end(), isOdd);
  if (firstOdd == mesh.points.end()) return {};
  const auto number = static_cast<std::size_t>(firstOdd - mesh.points.begin());
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  const auto isLost = [&](const Triangle& t) {
    return std::any_of(t.begin(), t.end(), [&](std::uint32_t p) { return isOdd(mesh.points[p]); });
  };
  std::vector<bool> lost;
  for (const Triangle& t : mesh.triangles) lost.push_back(isLost(t));
  for (const auto& [first, n] : mesh.polygons) {  // a polygon is lost as a whole
    const auto begin = lost.begin() + first, end = begin + n;
    if (std::find(begin, end, true) != end) std::fill(begin, end, true);
  }
  MeshData kept = mesh;
  kept.triangles.clear();
  kept.polygons.clear();
  std::vector<std::uint32_t> former;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (lost[i]) {
      lostTriangles_.add(1, [&] { return find(MeshPart::triangle, i); });
      continue;
    }
    kept.triangles.push_back(mesh.triangles[i]);
    former.push_back(i);
  }
  if (count > 0 && kept.triangles.empty()) {
    const MeshSpot spot = find(MeshPart::point, number);
    throw Error(Fault::scene, spot.place,
                (spot.name.empty() ? "point " + std::to_string(number) : spot.name) +
                    ": expected three finite numbers of at most 3.4e38");
  }
  const auto good = std::find_if_not(kept.points.begin(), kept.points.end(), isOdd);
  const Vec3f stand = good == kept.points.end() ? Vec3f{} : *good;  // so that bounds stay what is seen
  for (std::size_t i = 0; i < kept.points.size(); ++i) {
    if (!isOdd(kept.points[i])) continue;
    kept.points[i] = stand;
    infinitePoints_.add(1, [&] { return find(MeshPart::point, i); });
  }
  mesh = std::move(kept);
  return former;
}

void MeshRepairs::report(const SourcePlace& place, Messages& messages) const {
  infinitePoints_.report("points that are not three finite numbers of at most 3.4e38", messages);
  lostTriangles_.report("triangles that use such points are left out", messages);
  infiniteNormals_.report("normals that are not finite are taken from the faces", messages);
  infiniteUvs_.report("texture coordinates that are not finite become 0", messages);
  infiniteColors_.report("colours of points or faces that are not finite become white", messages);
  withoutArea_.report(kWithoutArea, messages);
  zeroNormals_.report("normals of length 0 are taken from the faces", messages);
  if (triangles_ == 0) messages.warn(place, "the file has no triangle that can be seen");
}

void addOnlyMesh(Model& model, MeshData mesh, MeshRepairs& repairs, const FindInFile& find,
                 const SourcePlace& place, Messages& messages) {
  repairs.check(mesh, find);
  repairs.report(place, messages);
  model.objects.push_back(
      {"", Mesh{std::make_shared<const MeshData>(std::move(mesh))}, {}, Model::kNoMaterial, place});
}

std::vector<Object> placed(const Model& model, const Material& base,
                           const std::function<std::uint32_t(const Material&)>& index) {
  // Numbers of the materials that are used, and of `base` behind them.
  std::vector<std::optional<std::uint32_t>> numbers(model.materials.size() + 1);
  std::map<std::pair<const MeshData*, std::uint32_t>, Mesh> colored;  // instances share these too
  std::vector<Object> objects = model.objects;
  for (Object& object : objects) {
    const std::uint32_t own = object.material;
    const bool none = own == Model::kNoMaterial;
    auto& number = numbers[none ? model.materials.size() : own];
    if (!number) number = index(none ? base : model.materials[own]);
    object.material = *number;
    const auto* mesh = object.shape.as<Mesh>();
    if (!mesh || mesh->data->materials.empty()) continue;
    const auto [found, fresh] = colored.try_emplace({mesh->data.get(), own});
    if (fresh)
      found->second = withMaterials(*mesh->data, model, none ? base : model.materials[own], !none, index);
    object.shape = found->second;
  }
  return objects;
}

Scene sceneOf(Model model, const std::string& file, std::string_view format) {
  Scene scene;
  scene.file = file;
  scene.format = format;
  scene.objects = placed(model, plainMaterial(), [&](const Material& material) {
    scene.materials.push_back(material);
    if (!model.saysSides) scene.materials.back().sides = ShadedSides::both;
    return static_cast<std::uint32_t>(scene.materials.size() - 1);
  });
  for (const Material& material : model.materials)
    if (!material.name.empty() &&
        std::none_of(scene.materials.begin(), scene.materials.end(),
                     [&](const Material& used) { return used.name == material.name; }))
      scene.unusedMaterials.push_back({material.name, SourcePlace{.file = file}});
  scene.inputs = std::move(model.inputs);
  scene.choices = std::move(model.choices);
  scene.camera = model.camera ? *model.camera : framing(model.framed.value_or(bounds(scene)));
  scene.lights = model.lights.empty() ? plainLights(scene.camera) : std::move(model.lights);
  return scene;
}

Material plainMaterial() {
  Phong phong;
  phong.ambient = phong.diffuse = Color(0.7);
  return {"", phong, {}};
}

void makePlain(Material& material) {
  Material plain = plainMaterial();
  plain.name = std::move(material.name);
  plain.sides = material.sides;
  material = std::move(plain);
}

Box3 bounds(const Scene& scene) {
  Box3 box;
  for (const Object& object : scene.objects)
    box.extend(object.worldFromObject * prepare(object.shape).bounds());
  return box;
}

Camera framing(const Box3& box) { return framing(box, 40, 1); }

Camera framing(const Box3& box, Real fov, Real aspect, const Vec3& viewdir) {
  constexpr Real kMargin = 1.08;  // margin of the picture around the box
  Camera camera;
  camera.fov = fov;
  camera.aspectratio = aspect;
  camera.viewdir = normalize(viewdir);
  const bool nothing = box.empty() || !isFinite(box.size()) || box.size() == Vec3{};
  const Box3 seen = nothing ? Box3{{-1, -1, -1}, {1, 1, 1}} : box;
  const CameraFrame axes = frame(camera, CameraAxes::orthonormal);
  const Vec3 right = normalize(axes.right), up = normalize(axes.up);
  const Real slope = math::tan(camera.fov * kPi / 360) / kMargin;
  Real distance = 0;  // from the centre, so that every corner is inside the picture's edges
  for (int i = 0; i < 8; ++i) {
    const Vec3 corner = Vec3{i & 1 ? 0.5 : -0.5, i & 2 ? 0.5 : -0.5, i & 4 ? 0.5 : -0.5};
    const Vec3 size = seen.size(), p{corner.x * size.x, corner.y * size.y, corner.z * size.z};
    const Real aside = max(std::abs(dot(p, right)) / aspect, std::abs(dot(p, up)));
    distance = max(distance, aside / slope - dot(p, camera.viewdir));
  }
  camera.position = seen.center() - camera.viewdir * distance;
  return camera;
}

std::vector<LightSource> plainLights(const Camera& camera) {
  const CameraFrame axes = frame(camera, CameraAxes::orthonormal);
  const Vec3 right = normalize(axes.right), up = normalize(axes.up), look = normalize(axes.look);
  const auto light = [&](Real x, Real y, Real brightness) {
    return LightSource{directionalLight(normalize(look + right * x + up * y), Color(brightness)), {}};
  };
  return {light(0.6, -0.9, 0.85), light(-0.9, -0.1, 0.3), {ambientLight(Color(0.12)), {}}};
}

bool isPlainView(const Scene& scene) { return scene.lights == plainLights(scene.camera); }

}  // namespace trace
