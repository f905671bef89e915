// A Scene as a text file of Open Inventor 2.1 (.iv) or VRML 1.0 (.wrl): spheres and cubes as they are,
// everything else as triangles. Meshes that several objects share are written once.
#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "base/text.h"
#include "formats/inventor/inventor_format.h"
#include "formats/mesh/world_meshes.h"
#include "formats/picture_files.h"
#include "formats/words.h"
#include "geometry/mesh/mesh.h"
#include "geometry/shapes/solids/cube.h"
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
namespace inventor {
namespace {

constexpr Real kShininessScale = 128;  // the reader's

Real most(const Color& c) { return std::max({c.r, c.g, c.b}); }

class InventorWriter {
 public:
  InventorWriter(const Scene& scene, bool vrml, const WriteOptions& options, Messages& messages)
      : scene_(scene),
        vrml_(vrml),
        digits_(options.digits),
        messages_(messages),
        settings_(resolve({scene.choices})),
        shapes_(options.steps) {}

  std::string write() {
    out_ = vrml_ ? "#VRML V1.0 ascii\n" : "#Inventor V2.1 ascii\n";
    out_ += "# written by Trace\nSeparator {\n";
    camera();
    for (const LightSource& source : scene_.lights) addLight(source.light);
    if (!vrml_ && environments_ == 0) environment(1, 0, 0);
    if (!(scene_.background == Background{})) warn("the background is left out: the format has none");
    for (const Object& object : scene_.objects) add(object);
    shapes_.report({scene_.file, 0, 0, {}}, "spheres, cubes and meshes", holds_.objects == 0, messages_);
    out_ += "}\n";
    return std::move(out_);
  }

  /// Their names as the file has them.
  const std::set<std::string>& pictures() const { return pictures_; }
  NamedBytes::Contents holds() const { return holds_; }

 private:
  /// Once for each kind.
  void warn(const std::string& what) {
    if (told_.insert(what).second) messages_.warn({scene_.file, 0, 0, {}}, what);
  }

  // --- text ---

  void number(double x) {
    out_ += ' ';
    appendNumber(out_, x, digits_);
  }
  void field(std::string_view name, std::initializer_list<double> numbers) {
    out_ += ' ' + std::string(name);
    for (double x : numbers) number(x);
  }
  void field(std::string_view name, const Vec3& v) { field(name, {v.x, v.y, v.z}); }
  void field(std::string_view name, const Color& c) { field(name, {c.r, c.g, c.b}); }
  /// A list in brackets; put() writes the i-th.
  template <class Put>
  void list(std::string_view name, std::size_t count, Put&& put) {
    constexpr std::size_t kOnALine = 8;
    out_ += ' ' + std::string(name) + " [";
    for (std::size_t i = 0; i < count; ++i) {
      if (i > 0) out_ += i % kOnALine == 0 ? ",\n " : ",";
      put(i);
    }
    out_ += " ]";
  }
  void open(std::string_view node) { out_ += std::string(node) + " {"; }
  void close() { out_ += " }\n"; }

  // --- camera and lights ---

  void camera() {
    const Camera& c = scene_.camera;
    const Vec3 back = -normalize(c.viewdir), right = normalize(cross(c.updir, back)), up = cross(back, right);
    // The rotation whose columns are right, up and back, as a quaternion.
    const Vec3 twice{up.z - back.y, back.x - right.z, right.y - up.x};  // 2 sine times the axis
    const Real sine = length(twice) / 2, cosine = (right.x + up.y + back.z - 1) / 2;
    Vec3 axis = sine > 1e-6 ? twice / (2 * sine) : Vec3{0, 0, 1};
    if (sine <= 1e-6 && cosine < 0)  // half a turn: the axis is the largest column of R + 1
      for (const Vec3& column : {right + Vec3{1, 0, 0}, up + Vec3{0, 1, 0}, back + Vec3{0, 0, 1}})
        if (length(column) > 1) axis = normalize(column);
    const bool flat = settings_.projection == Projection::orthographic;
    if (!flat && settings_.projection != Projection::perspective)
      warn("the camera becomes one of perspective: the format has no other lens");
    open(flat ? "OrthographicCamera" : "PerspectiveCamera");
    field("position", c.position);
    field("orientation", {axis.x, axis.y, axis.z, math::atan2(sine, cosine)});
    if (flat)
      field("height", {settings_.viewHeight});
    else
      field("heightAngle", {c.fov * kPi / 180});
    field("aspectRatio", {c.aspectratio});
    close();
  }

  /// How the lights that follow fade, and the ambient light.
  void environment(Real constant, Real linear, Real quadratic) {
    Color ambient;
    for (const LightSource& source : scene_.lights)
      if (const auto* light = source.light.as<AmbientLight>()) ambient += light->color;
    ++environments_;
    open("Environment");
    field("ambientIntensity", {most(ambient)});
    field("ambientColor", most(ambient) > 0 ? ambient / most(ambient) : Color(1));
    field("attenuation", {quadratic, linear, constant});
    close();
  }
  template <class L>
  void fading(const L& light) {
    if (!vrml_)
      environment(light.constant, light.linear, light.quadratic);
    else if (light.constant != 1 || light.linear != 0 || light.quadratic != 0)
      warn("how lights fade is left out: VRML 1.0 has no word for it, a .iv file has");
  }
  void shine(const Color& color) {
    field("intensity", {std::max(most(color), 0.0)});
    field("color", most(color) > 0 ? color / most(color) : Color(1));
  }
  void pointLight(const Vec3& at, const Color& color) {
    open("PointLight");
    shine(color);
    field("location", at);
    close();
  }
  void spotLight(const Vec3& at, const Vec3& direction, const Color& color, Real exponent, Real radians) {
    open("SpotLight");
    shine(color);
    field("location", at);
    field("direction", direction);
    field("dropOffRate", {std::min(exponent / kShininessScale, 1.0)});
    field("cutOffAngle", {radians});
    close();
  }

  /// Portals give no light.
  void addLight(const Light& light) {
    const bool isKnown =
        visitAs<PointLight, DirectionalLight, SpotLight, RectangleLight, WarnLight, ProjectorLight,
                GoniometricLight, AmbientLight>(light, [&](const auto& l) { add(l); });
    if (!isKnown && light.type().starts != LightOrigin::none)
      warn(std::string(light.keyword()) + " is left out: the format has none");
  }
  void add(const PointLight& light) {
    fading(light);
    if (!isBlack(light.extraHighlight)) warn("the colours of highlights of their own are left out");
    pointLight(light.position, light.color);
  }
  void add(const DirectionalLight& light) {
    if (light.size > 0) warn("suns get no size: their shadows are sharp");
    open("DirectionalLight");
    shine(light.color);
    field("direction", light.direction);
    close();
  }
  void add(const SpotLight& light) {
    fading(light);
    if (light.fullAngle < light.angle) warn("spot lights get a sharp edge");
    spotLight(light.position, light.direction, light.color, light.exponent, light.angle * kPi / 180);
  }
  void add(const RectangleLight& light) {
    warn("rectangle lights become points, which do not fade with the distance");
    if (!vrml_) environment(1, 0, 0);
    pointLight(light.position, light.color * (length(cross(light.u, light.v)) / kPi));
  }
  void add(const WarnLight& light) {
    fading(light);
    if (light.open() != WarnLight{}.open()) warn("the flaps of lights are left out");
    spotLight(light.position, light.direction, light.color, light.exponent, light.angle * kPi / 180);
  }
  void add(const ProjectorLight& light) {
    fading(light);
    warn("projectors become spot lights without their pictures");
    spotLight(light.position, light.direction, light.color, 0,
              math::atan(math::hypot(light.half().x, light.half().y)));
  }
  void add(const GoniometricLight& light) {
    fading(light);
    warn("lights with photometric files become uniform point lights");
    pointLight(light.position, light.color);
  }
  void add(const AmbientLight& light) {
    if (vrml_ && !isBlack(light.color))
      warn("the ambient light is left out: VRML 1.0 has no word for it, a .iv file has");
  }

  // --- looks ---

  /// The looks of the object, written once: a reader that shares meshes asks for the same nodes before
  /// them.
  void looks(const Object& object, const std::vector<std::uint32_t>& used, bool hasUv) {
    std::string before = std::exchange(out_, {});
    materials(used, hasUv);
    hints(object);
    const std::string nodes = std::exchange(out_, std::move(before));
    const auto [known, fresh] = looks_.try_emplace(nodes);
    if (fresh) known->second = freshName("look");
    out_ += fresh ? "DEF " + known->second + " Group {\n" + nodes + "}\n" : "USE " + known->second + '\n';
  }

  /// The materials of those numbers as one node, and the picture that paints the first.
  void materials(const std::vector<std::uint32_t>& used, bool hasUv) {
    std::vector<Phong> looks;
    for (std::uint32_t index : used) looks.push_back(look(index));
    const ImageMap* picture = used.size() == 1 && hasUv ? pictureOf(scene_.materials.at(used[0])) : nullptr;
    if (picture) looks[0].diffuse = looks[0].ambient = Color(1);
    open("Material");
    const auto colors = [&](std::string_view name, Color Phong::*color) {
      list(name, looks.size(), [&](std::size_t i) {
        for (Real x : {(looks[i].*color).r, (looks[i].*color).g, (looks[i].*color).b}) number(x);
      });
    };
    colors("ambientColor", &Phong::ambient);
    colors("diffuseColor", &Phong::diffuse);
    colors("specularColor", &Phong::specular);
    colors("emissiveColor", &Phong::emissive);
    list("shininess", looks.size(), [&](std::size_t i) { number(looks[i].shininess); });
    list("transparency", looks.size(), [&](std::size_t i) { number(looks[i].transmissive.r); });
    close();
    if (!picture) return;
    if (picture->srgb) warn("pictures are taken as they are: the format does not say that they are sRGB");
    open("Texture2");
    out_ += " filename \"" + *pictures_.insert(picture->file.file).first + '"';
    if (picture->wrapU == Wrap::clamp) out_ += " wrapS CLAMP wrapT CLAMP";
    close();
  }

  /// As the node Material counts: the share of the light that passes does not make colours darker.
  Phong look(std::uint32_t index) {
    const Material& material = scene_.materials.at(index);
    Phong p = phongWithoutTextures(material);
    const bool paints = pictureOf(material) != nullptr;
    if (material.textures.size() > (paints ? 1u : 0u))
      warn("textures are left out, but for pictures of diffuse");
    const Color& t = p.transmissive;
    const bool isGrey = t.r == t.g && t.g == t.b;
    if (!isGrey) warn("coloured glass becomes grey");
    const Real through = std::clamp(isGrey ? t.r : (t.r + t.g + t.b) / 3, 0.0, 1.0);
    if (through > 0 && p.index != 1) warn("glass does not refract: the format has no index");
    const bool mirrors = p.mirrorsSpecular && settings_.mirrorDefault == MirrorDefault::specular;
    if (!isBlack(mirrors ? p.specular : p.reflective)) warn("mirrors are left out: the format has none");
    if (p.shadow != 1) warn("shadows that are not black become black");
    const Real opaque = through < 1 ? 1 - through : 1;
    p.diffuse = p.diffuse / opaque;
    p.ambient = p.ambient / opaque;
    p.transmissive = Color(through);
    p.shininess = p.shininess * settings_.shininessScale / kShininessScale;
    if (p.shininess > 1) warn("highlights get an exponent of at most 128");
    p.shininess = std::min(p.shininess, 1.0);
    return p;
  }

  // --- objects ---

  void add(const Object& object) {
    if (!invertible(object.worldFromObject)) return shapes_.leaveOut(object.shape);
    const bool isPainted = pictureOf(scene_.materials.at(object.material)) != nullptr;
    if (object.shape.is<Sphere>() && !isPainted) return solid(object, "Sphere { radius 1 }");
    if (object.shape.is<Cube>() && !isPainted) return solid(object, "Cube { width 1 height 1 depth 1 }");
    if (const auto made = displacedMesh(object, scene_.materials)) {
      const auto* own = object.shape.as<Mesh>();
      const bool isShared = own && own->data == made;
      return mesh(object, made->generateNormals ? withGeneratedNormals(*made, true) : *made,
                  isShared ? own->data.get() : nullptr);
    }
    const auto surface = shapes_.of(object.shape, isPainted);
    if (!surface) return shapes_.leaveOut(object.shape);
    mesh(object, *surface, nullptr);
  }

  void begin(const Affine& m) {
    ++holds_.objects;
    out_ += "Separator {\n";
    if (m == Affine{}) return;
    open("MatrixTransform");
    out_ += " matrix";
    for (int column = 0; column < 3; ++column) {
      for (const Vec3& row : m.row) number(row[column]);
      number(0);
    }
    for (Real x : {m.offset.x, m.offset.y, m.offset.z, 1.0}) number(x);
    close();
  }
  void solid(const Object& object, const char* shape) {
    begin(object.worldFromObject);
    looks(object, {object.material}, true);
    out_ += define(object.name) + shape + "\n}\n";
  }
  void hints(const Object& object) {
    const bool solid = scene_.materials.at(object.material).sides == ShadedSides::front;
    out_ += std::string("ShapeHints { vertexOrdering COUNTERCLOCKWISE shapeType ") +
            (solid ? "SOLID" : "UNKNOWN_SHAPE_TYPE") + " creaseAngle 0 }\n";
  }

  /// `shared` is null if no other object may have the mesh.
  void mesh(const Object& object, const MeshData& mesh, const MeshData* shared) {
    const bool mirrored = determinant(object.worldFromObject) < 0;
    begin(object.worldFromObject);
    std::vector<std::uint32_t> used(mesh.materials);
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    if (used.empty()) used = {object.material};
    looks(object, used, !mesh.uvs.empty());
    holds_.triangles += mesh.triangles.size();
    const std::pair key{shared, mirrored};
    if (const auto known = written_.find(key); shared && known != written_.end()) {
      out_ += "USE " + known->second + "\n}\n";
      return;
    }
    if (shared) out_ += "DEF " + written_.emplace(key, freshName("mesh")).first->second + ' ';
    out_ += "Group {\n";
    const auto vectors = [&](const char* node, const char* name, const std::vector<Vec3f>& all) {
      open(node);
      list(name, all.size(), [&](std::size_t i) {
        for (int k = 0; k < 3; ++k) number(all[i][k]);
      });
      close();
    };
    vectors("Coordinate3", "point", mesh.points);
    if (!mesh.normals.empty()) {
      vectors("Normal", "vector", mesh.normals);
      out_ += "NormalBinding { value PER_VERTEX_INDEXED }\n";
    }
    if (!mesh.uvs.empty()) {
      open("TextureCoordinate2");
      list("point", mesh.uvs.size(), [&](std::size_t i) {
        number(mesh.uvs[i].x);
        number(mesh.uvs[i].y);
      });
      close();
    }
    if (used.size() > 1) out_ += "MaterialBinding { value PER_VERTEX_INDEXED }\n";
    open(define(object.name) + "IndexedFaceSet");
    const auto corners = [&](const char* name, const auto& numberOf) {
      list(name, mesh.triangles.size(), [&](std::size_t i) {
        for (std::size_t k = 0; k < 3; ++k)
          out_ += ' ' + std::to_string(numberOf(mesh.triangles[i][mirrored ? 2 - k : k])) + ',';
        out_ += " -1";
      });
    };
    corners("coordIndex", [](std::uint32_t point) { return point; });
    if (used.size() > 1)
      corners("materialIndex", [&](std::uint32_t point) {
        return std::lower_bound(used.begin(), used.end(), mesh.materials[point]) - used.begin();
      });
    close();
    out_ += "}\n}\n";
  }

  /// `DEF NAME `, if there is a name.
  std::string define(std::string_view name) {
    const std::string fresh = freshName(name);
    return fresh.empty() ? fresh : "DEF " + fresh + ' ';
  }

  /// The name as the format allows one, not used yet; "" for "".
  std::string freshName(std::string_view name) {
    std::string plain;
    for (char c : name) plain += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
    if (plain.empty()) return plain;
    if (std::isdigit(static_cast<unsigned char>(plain[0]))) plain.insert(plain.begin(), '_');
    std::string fresh = plain;
    for (int times = 2; !names_.insert(fresh).second; ++times) fresh = plain + '_' + std::to_string(times);
    return fresh;
  }

  const Scene& scene_;
  const bool vrml_;
  const int digits_;
  Messages& messages_;
  const Settings settings_;
  ShapeTriangles shapes_;
  std::string out_;
  std::set<std::string> told_, pictures_, names_;
  std::map<std::string, std::string> looks_;                         ///< nodes, and the name that they have
  std::map<std::pair<const MeshData*, bool>, std::string> written_;  ///< meshes, turned or not, by name
  NamedBytes::Contents holds_;
  int environments_ = 0;
};

}  // namespace
}  // namespace inventor

std::vector<NamedBytes> writeInventor(const Scene& scene, const std::string& file,
                                      const WriteOptions& options, Messages& messages) {
  const SeenFrom seen = seenFrom(scene, file, messages);
  const bool vrml = sameWord(file.substr(file.size() - std::min<std::size_t>(file.size(), 4)), ".wrl");
  inventor::InventorWriter writer(seen.scene, vrml, options, messages);
  std::string text = writer.write();
  std::vector<NamedBytes> files{{file, std::move(text), writer.holds()}};
  for (NamedBytes& picture : picturesNamed(writer.pictures(), seen)) files.push_back(std::move(picture));
  return files;
}

}  // namespace trace
