// A Scene as a file of the composer: spheres as they are, everything else as triangles in world space.
#include <algorithm>
#include <set>
#include <utility>

#include "base/text.h"
#include "formats/composer/composer_file.h"
#include "formats/composer/composer_format.h"
#include "formats/mesh/world_meshes.h"
#include "formats/picture_files.h"
#include "geometry/mesh/mesh.h"
#include "geometry/shapes/solids/sphere.h"
#include "math/elementary.h"
#include "scene/displacement.h"
#include "scene/options.h"
#include "shading/lights/ambient_light.h"
#include "shading/lights/directional_light.h"
#include "shading/lights/goniometric_light.h"
#include "shading/lights/point_light.h"
#include "shading/lights/projector_light.h"
#include "shading/lights/rectangle_light.h"
#include "shading/lights/spot_light.h"
#include "shading/lights/warn_light.h"
#include "shading/textures/image_map.h"

namespace trace {
namespace {

namespace cf = composer;

class Writer {
 public:
  Writer(const Scene& scene, const WriteOptions& options, Messages& messages)
      : scene_(scene), messages_(messages), settings_(resolve({scene.choices})), shapes_(options.steps) {}

  cf::File write() {
    view();
    for (const LightSource& source : scene_.lights) addLight(source.light);
    if (!(scene_.background == Background{})) warn("the background is left out: the format has none");
    for (const Object& object : scene_.objects) add(object);
    const bool nothing = file_.objects.empty() && !scene_.objects.empty();
    shapes_.report({scene_.file, 0, 0, {}}, "spheres and meshes", nothing, messages_);
    return std::move(file_);
  }

  /// Their names as the file has them.
  const std::set<std::string>& pictures() const { return pictures_; }

 private:
  /// Once for each kind.
  void warn(const std::string& what) {
    if (told_.insert(what).second) messages_.warn({scene_.file, 0, 0, {}}, what);
  }

  void view() {
    const Camera& c = scene_.camera;
    cf::View v;
    v.position = c.position;
    v.direction = normalize(c.viewdir);
    v.up = normalize(cross(cross(v.direction, c.updir), v.direction));
    v.verticalFov = c.fov * kPi / 180;
    if (c.aspectratio != 1) warn("the aspect ratio of the camera is left out; give it with --height");
    file_.view = v;
  }

  // --- lights ---

  /// Ambient light is in the materials (see material()), and portals give no light.
  void addLight(const Light& light) {
    const bool isKnown = visitAs<PointLight, DirectionalLight, SpotLight, RectangleLight, WarnLight,
                                 ProjectorLight, GoniometricLight>(light, [&](const auto& l) { add(l); });
    if (!isKnown && light.type().starts != LightOrigin::none)
      warn(std::string(light.keyword()) + " is left out: the format has none");
  }
  void add(const PointLight& light) {
    fading(light);
    if (!isBlack(light.extraHighlight)) warn("the colours of highlights of their own are left out");
    file_.lamps.push_back({.kind = cf::Lamp::Kind::point, .position = light.position, .color = light.color});
  }
  void add(const DirectionalLight& light) {
    file_.lamps.push_back(
        {.kind = cf::Lamp::Kind::directional, .direction = light.direction, .color = light.color});
  }
  void add(const SpotLight& light) {
    fading(light);
    if (light.fullAngle < light.angle) warn("spot lights get a sharp edge");
    cf::Lamp lamp{.kind = cf::Lamp::Kind::spot, .position = light.position, .direction = light.direction};
    lamp.color = light.color;
    lamp.dropOffRate = light.exponent / cf::kShininessScale;
    lamp.cutOffAngle = light.angle * kPi / 180;
    file_.lamps.push_back(lamp);
  }
  void add(const RectangleLight& light) {
    warn("rectangle lights become points, which do not fade with the distance");
    const Vec3 across = cross(light.u, light.v);
    file_.lamps.push_back({.kind = cf::Lamp::Kind::point,
                           .position = light.position,
                           .color = light.color * (length(across) / kPi)});
  }
  void add(const WarnLight& light) {
    fading(light);
    if (light.open() != WarnLight{}.open()) warn("the flaps of lights are left out");
    cf::Lamp lamp{.kind = cf::Lamp::Kind::spot, .position = light.position, .direction = light.direction};
    lamp.color = light.color;
    lamp.dropOffRate = light.exponent / cf::kShininessScale;
    lamp.cutOffAngle = light.angle * kPi / 180;
    file_.lamps.push_back(lamp);
  }
  void add(const ProjectorLight& light) {
    fading(light);
    warn("projectors become spot lights without their pictures");
    cf::Lamp lamp{.kind = cf::Lamp::Kind::spot, .position = light.position, .direction = light.direction};
    lamp.color = light.color;
    lamp.cutOffAngle = math::atan(math::hypot(light.half().x, light.half().y));
    file_.lamps.push_back(lamp);
  }
  void add(const GoniometricLight& light) {
    fading(light);
    warn("lights with photometric files become uniform point lights");
    file_.lamps.push_back({.kind = cf::Lamp::Kind::point, .position = light.position, .color = light.color});
  }

  template <class L>
  void fading(const L& light) {
    if (light.constant != 0.25 || light.linear != 0.1 || light.quadratic != 0.01)
      warn("how lights fade is left out: the format has one rule for all");
  }

  // --- objects ---

  /// `hasUv`: pictures can lie on the object.
  cf::Material material(std::uint32_t index, std::string& name, bool hasUv) {
    Phong p = phongWithoutTextures(scene_.materials.at(index));
    if (p.shadow != 1) warn("shadows that are not black become black");
    for (const FieldTexture& field : scene_.materials[index].textures) {
      const auto* image = field.texture->model.as<ImageMap>();
      const bool paints = (field.field == kDiffuse || field.field == kColor) && image;
      if (paints && !hasUv)
        warn("pictures are left out of meshes without texture coordinates");
      else if (paints)
        say(name, "texture=" + *pictures_.insert(image->file.file).first);
      else if (field.field == kAmbient && image) {
        p.ambient *= meanOf(*image);
        warn("pictures of ambient become their mean colour");
      } else
        warn("textures are left out, but for pictures of diffuse");
    }
    Color ambientLight;
    for (const LightSource& source : scene_.lights)
      if (const auto* light = source.light.as<AmbientLight>()) ambientLight += light->color;

    cf::Material m;
    m.ktran = std::clamp((p.transmissive.r + p.transmissive.g + p.transmissive.b) / 3, 0.0, 1.0);
    if (!(p.transmissive == Color(m.ktran))) warn("coloured glass becomes grey");
    const Real opaque = m.ktran < 1 ? 1 - m.ktran : 1;
    m.diffuse = p.diffuse / opaque;
    const Color around = p.ambient * ambientLight;
    const auto share = [](double a, double d) { return d > 0 ? a / d : 0; };
    m.ambient = {share(around.r, p.diffuse.r), share(around.g, p.diffuse.g), share(around.b, p.diffuse.b)};
    m.specular = p.specular;
    m.emission = p.emissive;
    m.shininess = p.shininess * settings_.shininessScale / cf::kShininessScale;
    const bool mirrorsAsItShines = p.mirrorsSpecular && settings_.mirrorDefault == MirrorDefault::specular;
    const Color mirror = mirrorsAsItShines ? p.specular : p.reflective;
    if (!(mirror == p.specular)) say(name, "reflect=" + toText((mirror.r + mirror.g + mirror.b) / 3));
    if (m.ktran > 0 && p.index != cf::kGlass) say(name, "ior=" + toText(p.index));
    return m;
  }
  /// The mean of the whole picture.
  static Color meanOf(ImageMap image) {
    image.filter = TexelFilter::trilinear;
    image.transform = ImageMap{}.transform;
    return image.at(
        {.point = {}, .uv = {0.5, 0.5}, .uvX = {1, 0}, .uvY = {0, 1}, .pointX = {}, .pointY = {}});
  }
  bool isPainted(std::uint32_t material) const {
    const auto& textures = scene_.materials.at(material).textures;
    return textureOf(textures, kDiffuse) || textureOf(textures, kColor);
  }
  static void say(std::string& name, const std::string& word) {
    if (name.find(word) == std::string::npos) name += (name.empty() ? "" : " ") + word;
  }

  void add(const Object& object) {
    if (!invertible(object.worldFromObject)) return shapes_.leaveOut(object.shape);
    cf::Object o;
    o.name = object.name;
    if (object.shape.is<Sphere>()) {
      o.materials.push_back(material(object.material, o.name, true));
      o.sphere = sphere(object.worldFromObject);
    } else if (const auto mesh = displacedMesh(object, scene_.materials)) {
      add(o, mesh->generateNormals ? withGeneratedNormals(*mesh, true) : *mesh, object);
    } else if (const auto surface = shapes_.of(object.shape, isPainted(object.material))) {
      add(o, *surface, object);
    } else {
      return shapes_.leaveOut(object.shape);
    }
    file_.objects.push_back(std::move(o));
  }

  static cf::Sphere sphere(const Affine& m) {
    cf::Sphere s;
    s.origin = m.offset;
    s.radius = 0;
    for (int i = 0; i < 3; ++i) {
      const Vec3 axis{m.row[0][i], m.row[1][i], m.row[2][i]};
      s.length[i] = length(axis);
      s.axis[i] = axis / s.length[i];
      s.radius += s.length[i] / 3;
    }
    return s;
  }

  void add(cf::Object& o, const MeshData& mesh, const Object& object) {
    const Affine &m = object.worldFromObject, inverted = inverse(m);
    cf::PolySet& p = o.polygons;
    p.vertexNormals = !mesh.normals.empty();
    p.hasUv = !mesh.uvs.empty();
    // The format counts materials from 0 in each object.
    std::vector<std::uint32_t> used(mesh.materials);
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    p.vertexMaterials = used.size() > 1;
    if (used.empty()) used = {object.material};
    for (std::uint32_t index : used) o.materials.push_back(material(index, o.name, p.hasUv));

    const bool mirrored = determinant(m) < 0;
    for (const Triangle& triangle : mesh.triangles) {
      p.counts.push_back(3);
      for (int i = 0; i < 3; ++i) {
        const std::uint32_t corner = triangle[static_cast<std::size_t>(mirrored ? 2 - i : i)];
        cf::Vertex& v = p.vertices.emplace_back();
        v.position = m * Vec3(mesh.points[corner]);
        if (p.vertexNormals) v.normal = normalize(transposed(inverted, Vec3(mesh.normals[corner])));
        if (p.vertexMaterials)
          v.material = static_cast<std::uint32_t>(
              std::lower_bound(used.begin(), used.end(), mesh.materials[corner]) - used.begin());
        if (p.hasUv) v.uv = mesh.uvs[corner];
      }
    }
  }

  const Scene& scene_;
  Messages& messages_;
  const Settings settings_;
  ShapeTriangles shapes_;
  cf::File file_;
  std::set<std::string> told_, pictures_;
};

}  // namespace

std::vector<NamedBytes> writeComposer(const Scene& scene, const std::string& file,
                                      const WriteOptions& options, Messages& messages) {
  const SeenFrom seen = seenFrom(scene, file, messages);
  Writer writer(seen.scene, options, messages);
  const cf::File written = writer.write();
  NamedBytes::Contents holds{written.objects.size(), 0};
  for (const cf::Object& object : written.objects) holds.triangles += object.polygons.counts.size();
  std::vector<NamedBytes> files{{file, cf::writeText(written, options.digits), holds}};
  for (NamedBytes& picture : picturesNamed(writer.pictures(), seen)) files.push_back(std::move(picture));
  return files;
}

}  // namespace trace
