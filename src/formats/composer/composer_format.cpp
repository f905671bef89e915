// The meaning of composer files, as a Scene.
//
// The format has neither an index of refraction nor a mirror: glass has index 1.5, and what is specular
// mirrors as much. More can be said in an object's name, as in `ior=1.33 texture=wood.png`. Lights fade by
// min(1, 1 / (0.25 + 0.1 d + 0.01 d^2)), as in the courses whose pictures are known (docs/formats.md).
#include "formats/composer/composer_format.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "base/text.h"
#include "formats/composer/composer_file.h"
#include "formats/directions.h"
#include "formats/model.h"
#include "formats/textures.h"
#include "formats/warnings.h"
#include "formats/words.h"
#include "geometry/mesh/mesh.h"
#include "geometry/mesh/mesh_repair.h"
#include "geometry/shapes/solids/sphere.h"
#include "shading/lights/plain_lights.h"

namespace trace {
namespace {

namespace cf = composer;

constexpr std::string_view kMagic = "Composer format";
constexpr Real kBumpHeight = 0.02;  // height of white, in units of the object: the name gives no height

/// The properties that an object's name gives besides the name.
struct Extras {
  std::optional<Real> ior, reflect;
  std::optional<std::string> texture, bump;
};

Extras extrasOf(const cf::Object& object, Messages& messages) {
  Extras extras;
  std::string_view rest = object.name;
  while (!rest.empty()) {
    const std::size_t start = rest.find_first_not_of(" ,;\t");
    if (start == std::string_view::npos) break;
    rest.remove_prefix(start);
    const std::string_view word = rest.substr(0, rest.find_first_of(" ,;\t"));
    rest.remove_prefix(word.size());
    const std::size_t equals = word.find('=');
    const std::string_view key = word.substr(0, equals);
    if (equals == std::string_view::npos) continue;
    const std::string_view value = word.substr(equals + 1);
    const auto number = parseNumber(value);
    const bool good = number && number->length == value.size() && std::isfinite(number->value);
    if (key == "texture")
      extras.texture = std::string(value);
    else if (key == "bump")
      extras.bump = std::string(value);
    else if (key == "ior" && good && number->value > 0)
      extras.ior = number->value;
    else if (key == "reflect" && good && number->value >= 0)
      extras.reflect = number->value;
    else if (key == "ior" || key == "reflect")
      messages.warn(object.place, std::string(key) + " in an object's name: expected a number, found \"" +
                                      std::string(value) + "\"");
  }
  return extras;
}

class ComposerReader {
 public:
  ComposerReader(const std::string& file, cf::File content, Messages& messages)
      : content_(std::move(content)), messages_(messages) {
    scene_.file = file;
    scene_.format = "composer";
  }

  Scene read() {
    for (const cf::Object& object : content_.objects) add(object);
    if (hasMeshes_) repairs_.report(place(), messages_);
    if (scene_.objects.empty()) warnings_.warn(place(), "no object: the picture will be empty");
    camera();
    for (const cf::Lamp& lamp : content_.lamps) add(lamp);
    if (content_.lamps.empty()) scene_.lights = plainLights(scene_.camera);
    scene_.lights.push_back({ambientLight(Color(1)), place()});
    scene_.choices.push_back({"like", "uw1998", place()});
    warnings_.report(messages_);
    return std::move(scene_);
  }

 private:
  SourcePlace place() const { return {scene_.file, 0, 0, {}}; }

  void camera() {
    if (!content_.view) {
      messages_.warn(place(), "no camera: one is placed so that everything is seen");
      scene_.camera = framing(bounds(scene_));
      scene_.camera.fov = 0.785398 * 180 / kPi;
      return;
    }
    const cf::View& v = *content_.view;
    scene_.camera.position = v.position;
    scene_.camera.viewdir = v.direction;
    scene_.camera.updir = v.up;
    scene_.camera.fov = v.verticalFov * 180 / kPi;
    if (!canLook(v.direction, v.up) || !(scene_.camera.fov > 0 && scene_.camera.fov < 180))
      throw Error(Fault::scene, place(),
                  "expected a camera whose orthoUp is not along its viewDirection, and a "
                  "verticalFOV between 0 and pi");
  }

  void add(const cf::Lamp& lamp) {
    constexpr Fading kFading{0.25, 0.1, 0.01};
    if (lamp.kind != cf::Lamp::Kind::point && !(length(lamp.direction) > 0))
      return messages_.warn(place(), "a light without a direction is left out");
    const Color& c = lamp.color;
    if (c.r < 0 || c.g < 0 || c.b < 0)
      warnings_.warn(place(), "color of a light: expected numbers of at least 0, found one below");
    if (lamp.kind == cf::Lamp::Kind::spot && !(lamp.cutOffAngle > 0 && lamp.cutOffAngle <= kPi))
      warnings_.warn(place(),
                     "cutOffAngle: expected above 0 and at most pi, found " + toText(lamp.cutOffAngle));
    if (lamp.kind == cf::Lamp::Kind::spot && lamp.dropOffRate < 0)
      warnings_.warn(place(), "dropOffRate: expected at least 0, found " + toText(lamp.dropOffRate));
    const auto light = [&]() -> Light {
      switch (lamp.kind) {
        case cf::Lamp::Kind::point: return pointLight(lamp.position, lamp.color, kFading);
        case cf::Lamp::Kind::directional: return directionalLight(lamp.direction, lamp.color);
        case cf::Lamp::Kind::spot: break;
      }
      const Real angle = std::clamp(lamp.cutOffAngle * 180 / kPi, 0.0, 180.0);
      return spotLight(lamp.position, lamp.direction, lamp.color,
                       {.angle = angle,
                        .fullAngle = angle,
                        .exponent = std::max(0.0, cf::kShininessScale * lamp.dropOffRate)},
                       kFading);
    };
    scene_.lights.push_back({light(), place()});
  }

  // --- materials ---

  /// Warns of numbers that no surface has.
  void checkRanges(const cf::Material& m, const SourcePlace& at) {
    const auto check = [&](const char* name, double low, double high, double most) {
      if (low >= 0 && high <= most) return;
      warnings_.warn(at,
                     std::string(name) + " of a material: expected " +
                         (most == kNoLimit ? "at least 0" : "0 to " + toText(most)) + ", found " +
                         toText(low < 0 ? low : high),
                     {}, name);
    };
    const auto color = [&](const char* name, const Color& c) {
      check(name, min(c.r, min(c.g, c.b)), max(c.r, max(c.g, c.b)), 1);
    };
    color("diffColor", m.diffuse);
    color("ambColor", m.ambient);
    color("specColor", m.specular);
    check("emisColor", min(m.emission.r, min(m.emission.g, m.emission.b)), 0, kNoLimit);
    check("shininess", m.shininess, m.shininess, 1);
    check("ktran", m.ktran, m.ktran, 1);
  }

  std::uint32_t add(const cf::Material& m, const Extras& extras) {
    Phong phong;
    const Real opaque = 1 - m.ktran;
    phong.diffuse = m.diffuse * opaque;
    phong.ambient = phong.diffuse * m.ambient;
    phong.specular = m.specular;
    phong.reflective = extras.reflect ? Color(*extras.reflect) : m.specular;
    phong.emissive = m.emission;
    phong.transmissive = Color(m.ktran);
    phong.shininess = m.shininess;
    phong.index = extras.ior.value_or(cf::kGlass);
    Material material{"", phong, {}};
    if (extras.texture) setTexture(material.textures, "diffuse", pictureTexture(*extras.texture));
    if (extras.bump) {
      setTexture(material.textures, "bump", pictureTexture(*extras.bump));
      material.bump = kBumpHeight;
    }
    scene_.materials.push_back(std::move(material));
    return static_cast<std::uint32_t>(scene_.materials.size() - 1);
  }

  // --- objects ---

  void add(const cf::Object& object) {
    const Extras extras = extrasOf(object, messages_);
    const auto first = static_cast<std::uint32_t>(scene_.materials.size());
    for (const cf::Material& m : object.materials) checkRanges(m, object.place);
    for (const cf::Material& m : object.materials) add(m, extras);
    if (object.materials.empty()) add(cf::Material{}, extras);
    if (object.sphere)
      add(object, Sphere{}, sphere(*object.sphere), first);
    else
      addMesh(object, first);
  }

  void add(const cf::Object& object, Shape shape, const Affine& worldFromObject, std::uint32_t material) {
    if (!invertible(worldFromObject))
      return warnings_.warn(object.place, "an object without size is left out");
    scene_.objects.push_back({object.name, std::move(shape), worldFromObject, material, object.place});
  }

  /// The ellipsoid of the axes; `--round-spheres`, which holds for these files, makes a ball of it.
  static Affine sphere(const cf::Sphere& s) {
    Affine axes = Affine::translation(s.origin);
    for (int i = 0; i < 3; ++i) {
      const Real l = length(s.axis[i]), radius = s.length[i] != 0 ? s.length[i] : s.radius;
      const Vec3 a = l > 0 ? s.axis[i] * (radius / l) : Vec3{};
      for (int row = 0; row < 3; ++row) axes.row[row][i] = a[row];
    }
    return axes;
  }

  void addMesh(const cf::Object& object, std::uint32_t firstMaterial) {
    const cf::PolySet& p = object.polygons;
    MeshData mesh;
    mesh.twoSided = true;
    std::vector<std::uint32_t> corners;
    std::size_t at = 0;
    for (std::uint32_t count : p.counts) {
      corners.clear();
      for (std::uint32_t i = 0; i < count; ++i) {
        corners.push_back(static_cast<std::uint32_t>(mesh.points.size()));
        append(mesh, p, p.vertices[at + i], object, firstMaterial);
      }
      if (count < 3) {
        warnings_.warn(object.place, "a polygon of fewer than 3 vertices is left out");
        mesh.points.resize(corners.empty() ? mesh.points.size() : corners[0]);
        if (p.vertexNormals) mesh.normals.resize(mesh.points.size());
        if (p.vertexMaterials) mesh.materials.resize(mesh.points.size());
        if (p.hasUv) mesh.uvs.resize(mesh.points.size());
      } else {
        appendPolygon(mesh, corners);
      }
      at += count;
    }
    if (p.vertexNormals) turnToNormals(mesh);
    repairs_.check(mesh, object.place);
    hasMeshes_ = true;
    add(object, Mesh{std::make_shared<const MeshData>(std::move(mesh))}, {}, firstMaterial);
  }

  void append(MeshData& mesh, const cf::PolySet& p, const cf::Vertex& v, const cf::Object& object,
              std::uint32_t firstMaterial) {
    mesh.points.push_back(Vec3f(v.position));
    if (p.vertexNormals) {  // normals have any length in the file and are mixed as unit vectors
      const Real l = length(v.normal);
      mesh.normals.push_back(l > 0 ? Vec3f(v.normal / l) : Vec3f{});
    }
    if (p.vertexMaterials) {
      const std::size_t most = std::max<std::size_t>(object.materials.size(), 1);
      if (v.material >= most)
        throw Error(Fault::scene, object.place,
                    "found the material number " + std::to_string(v.material) + ", but the object has " +
                        std::to_string(object.materials.size()) + ", counted from 0");
      mesh.materials.push_back(firstMaterial + v.material);
    }
    if (p.hasUv) mesh.uvs.push_back(v.uv);
  }

  /// The order of vertices is not reliable, the normals are: they tell inside from outside.
  static void turnToNormals(MeshData& mesh) {
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
      Triangle& t = mesh.triangles[i];
      const Vec3 mean = Vec3(mesh.normals[t[0]]) + Vec3(mesh.normals[t[1]]) + Vec3(mesh.normals[t[2]]);
      if (dot(mean, faceNormal(mesh, i)) < 0) std::swap(t[1], t[2]);
    }
  }

  cf::File content_;
  Messages& messages_;
  MeshRepairs repairs_;
  bool hasMeshes_ = false;
  WarningsByKind warnings_;
  Scene scene_;
};

}  // namespace

/// The magic words are the first of the file, in letters of any case.
bool recognisesComposer(std::string_view bytes) {
  bytes.remove_prefix(std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size()));
  return sameWord(bytes.substr(0, kMagic.size()), kMagic);
}

Scene readComposer(const std::string& file, std::string_view bytes, Messages& messages) {
  const std::size_t first = std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size());
  const std::string_view line =
      bytes.substr(first, std::min<std::size_t>(bytes.find('\n', first) - first, 80));
  const SourcePlace place = placeAt(file, bytes, std::min(first + kMagic.size(), bytes.size()));
  const auto version = parseNumber(line.substr(std::min(kMagic.size() + 1, line.size())));
  if (!version || !(version->value > 0 && version->value <= 2.1))
    throw Error(Fault::scene, place,
                "expected version 2.1 or older of the format, as in \"Composer format 2.1 ascii\"");
  const std::size_t end = first + line.size(), start = end == bytes.size() ? end : end + 1;
  const std::string_view kind = line.substr(std::min(line.size(), kMagic.size() + 1 + version->length));
  if (hasWord(kind, "binary"))
    return ComposerReader(file, cf::readBinary(file, bytes, start, version->value < 2.05, messages), messages)
        .read();
  if (!hasWord(kind, "ascii"))
    throw Error(Fault::scene, place, "expected \"ascii\" or \"binary\" after the version");
  return ComposerReader(file, cf::readText(file, bytes, start, messages), messages).read();
}

}  // namespace trace
