#include "formats/mesh/mesh_writers.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <sstream>
#include <utility>

#include "base/files/file.h"
#include "base/match.h"
#include "base/names.h"
#include "base/text.h"
#include "formats/mesh/world_meshes.h"
#include "formats/picture_files.h"
#include "geometry/mesh/mesh.h"
#include "shading/textures/image_map.h"

namespace trace {
namespace {

namespace fs = std::filesystem;

static_assert(std::endian::native == std::endian::little,
              "binary PLY files are written as the memory has them");

/// Names of the pictures that the materials of the meshes are painted with.
std::set<std::string> picturesOf(const Scene& scene, const std::vector<WorldMesh>& meshes) {
  std::set<std::string> names;
  for (const WorldMesh& part : meshes)
    if (const ImageMap* picture = pictureOf(scene.materials.at(part.material)))
      names.insert(picture->file.file);
  return names;
}

/// The picture that paints them all as its numbers are; "" if there is none.
std::string onlyPictureOf(const Scene& scene, const std::vector<WorldMesh>& meshes) {
  const ImageMap* only = nullptr;
  for (const WorldMesh& part : meshes) {
    const ImageMap* picture = pictureOf(scene.materials.at(part.material));
    if (!picture || picture->srgb || part.mesh.uvs.empty() || (only && !(only->file == picture->file)))
      return "";
    only = picture;
  }
  return only ? only->file.file : "";
}

// --- PLY ----------------------------------------------------------------------------------------------

/// All meshes as one; its `materials` name one for each point.
MeshData merged(std::vector<WorldMesh> meshes) {
  const bool normals =
      std::any_of(meshes.begin(), meshes.end(), [](const auto& m) { return !m.mesh.normals.empty(); });
  const bool uvs =
      std::all_of(meshes.begin(), meshes.end(), [](const auto& m) { return !m.mesh.uvs.empty(); });
  MeshData all;
  for (WorldMesh& part : meshes) {
    if (normals && part.mesh.normals.empty()) part.mesh = withFlatNormals(part.mesh);
    MeshData& mesh = part.mesh;
    if (mesh.materials.empty()) mesh.materials.assign(mesh.points.size(), part.material);
    const auto first = static_cast<std::uint32_t>(all.points.size());
    for (const Triangle& t : mesh.triangles)
      all.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    append(all.points, mesh.points);
    append(all.materials, mesh.materials);
    if (normals) append(all.normals, mesh.normals);
    if (uvs) append(all.uvs, mesh.uvs);
  }
  return all;
}

/// Numbers of a row as text, or as bytes.
class Row {
 public:
  Row(std::string& out, const WriteOptions& options) : out_(out), options_(options) {}

  template <class T>
  void add(T number) {
    if (!options_.ascii) {
      char bytes[sizeof number];
      std::memcpy(bytes, &number, sizeof number);
      out_.append(bytes, sizeof number);
      return;
    }
    if (!first_) out_ += ' ';
    first_ = false;
    if constexpr (std::is_integral_v<T>)
      out_ += std::to_string(number);
    else
      appendNumber(out_, number, options_.digits);
  }
  void add(const Vec3f& v) {
    add(v.x);
    add(v.y);
    add(v.z);
  }
  void end() {
    if (options_.ascii) out_ += '\n';
    first_ = true;
  }

 private:
  std::string& out_;
  const WriteOptions& options_;
  bool first_ = true;
};

std::uint8_t toByte(double share) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(share, 0.0, 1.0) * 255));
}

// --- OBJ ----------------------------------------------------------------------------------------------

/// "#" starts a comment in OBJ, and "\\" at its end joins a line to the next.
std::string objName(std::string_view name) {
  std::string clean = onOneLine(name, "#\\");
  clean.erase(0, std::min(clean.find_first_not_of(' '), clean.size()));
  clean.erase(clean.find_last_not_of(' ') + 1);
  return clean;
}

/// A name without white space for each material that is used, told apart by numbers.
std::map<std::uint32_t, std::string> materialNames(const Scene& scene, const std::vector<WorldMesh>& meshes) {
  std::map<std::uint32_t, std::string> names;
  std::set<std::string> used;
  for (const WorldMesh& part : meshes) {
    if (names.count(part.material)) continue;
    std::string name = onOneLine(objName(scene.materials.at(part.material).name), " ");
    if (name.empty()) name = "material";
    std::string fresh = name;
    for (int times = 2; !used.insert(fresh).second; ++times) fresh = name + "_" + std::to_string(times);
    names[part.material] = fresh;
  }
  return names;
}

/// Whether the OBJ file that is there now, if any, names that file for its materials.
bool namesMaterials(const std::string& obj, const std::string& materials) {
  std::error_code ignored;
  if (!fs::is_regular_file(obj, ignored)) return false;
  std::istringstream lines(readFile(obj));
  for (std::string line; std::getline(lines, line);) {
    constexpr std::string_view kKeyword = "mtllib ";
    if (!line.starts_with(kKeyword)) continue;
    line.erase(line.find_last_not_of(" \t\r") + 1);
    if (line.size() > kKeyword.size() && sameFile(besideFile(obj, line.substr(kKeyword.size())), materials))
      return true;
  }
  return false;
}

/// Where the materials of an OBJ file go: to NAME.mtl beside it, or NAME-2.mtl and so on if that is there and
/// belongs to something else than the OBJ file that is replaced.
NamedBytes placeOfMaterials(const std::string& obj) {
  std::error_code ignored;
  const fs::path path(obj);
  NamedBytes materials;
  for (int number = 1;; ++number) {
    const std::string name =
        path.stem().generic_string() + (number == 1 ? "" : "-" + std::to_string(number)) + ".mtl";
    materials.file = (path.parent_path() / name).generic_string();
    if (!fs::exists(materials.file, ignored) || namesMaterials(obj, materials.file)) return materials;
    if (number == 1) materials.spared = materials.file;
  }
}

class ObjWriter {
 public:
  explicit ObjWriter(const WriteOptions& options) : digits_(options.digits) {}

  void line(std::string_view keyword, std::initializer_list<double> numbers) {
    out_ += keyword;
    for (double n : numbers) {
      out_ += ' ';
      appendNumber(out_, n, digits_);
    }
    out_ += '\n';
  }
  void line(std::string_view keyword, const Vec3f& v) {
    out_ += keyword;
    for (int i = 0; i < 3; ++i) {
      out_ += ' ';
      appendNumber(out_, v[i], digits_);
    }
    out_ += '\n';
  }
  void line(std::string_view keyword, std::string_view word) {
    out_ += std::string(keyword) + ' ' + std::string(word) + '\n';
  }
  void color(std::string_view keyword, const Color& c) { line(keyword, {c.r, c.g, c.b}); }

  /// Illumination models as readObj() understands them. `picture` may be null.
  void material(const std::string& name, const Phong& phong, const ImageMap* picture) {
    const bool mirrors = phong.mirrors() || (phong.mirrorsSpecular && !isBlack(phong.specular));
    line("newmtl", name);
    color("Ka", phong.ambient);
    color("Kd", phong.diffuse);
    color("Ks", phong.specular);
    color("Ke", phong.emissive);
    line("Ns", {phong.shininess});
    line("Ni", {phong.index});
    if (phong.transmits()) color("Tf", phong.transmissive);
    const int glass = mirrors ? 7 : 9, opaque = mirrors ? 3 : isBlack(phong.specular) ? 1 : 2;
    line("illum", {static_cast<double>(phong.transmits() ? glass : opaque)});
    if (picture)
      line("map_Kd", std::string(picture->wrapU == Wrap::clamp ? "-clamp on " : "") +
                         (picture->srgb ? "-colorspace sRGB " : "") + onOneLine(picture->file.file));
    out_ += '\n';
  }

  void mesh(const MeshData& mesh) {
    for (const Vec3f& p : mesh.points) line("v", p);
    for (const Vec2& uv : mesh.uvs) line("vt", {uv.x, uv.y});
    for (const Vec3f& n : mesh.normals) line("vn", n);
    for (const Triangle& t : mesh.triangles) {
      out_ += 'f';
      for (std::uint32_t corner : t) {
        out_ += ' ' + std::to_string(points_ + corner);
        if (!mesh.uvs.empty() || !mesh.normals.empty()) out_ += '/';
        if (!mesh.uvs.empty()) out_ += std::to_string(uvs_ + corner);
        if (!mesh.normals.empty()) out_ += '/' + std::to_string(normals_ + corner);
      }
      out_ += '\n';
    }
    points_ += mesh.points.size();
    uvs_ += mesh.uvs.size();
    normals_ += mesh.normals.size();
  }

  std::string take() { return std::move(out_); }

 private:
  int digits_;
  std::string out_;
  std::size_t points_ = 1, uvs_ = 1, normals_ = 1;  ///< numbers of the next ones
};

}  // namespace

std::vector<NamedBytes> writePly(const Scene& scene, const std::string& file, const WriteOptions& options,
                                 Messages& messages) {
  const SeenFrom seen = seenFrom(scene, file, messages);
  std::vector<WorldMesh> meshes = worldMeshes(seen.scene, options, messages);
  const std::size_t objects = meshes.size();
  const std::string picture = onlyPictureOf(seen.scene, meshes);
  if (picture.empty() && !picturesOf(seen.scene, meshes).empty())
    messages.warn(SourcePlace{scene.file, 0, 0, {}},
                  "the pictures are left out: a PLY file has one for all of it, which is not decoded");
  const MeshData mesh = merged(std::move(meshes));
  const auto& m = mesh.materials;
  const bool colored = std::adjacent_find(m.begin(), m.end(), std::not_equal_to<>()) != m.end();
  std::string out = "ply\nformat " + std::string(options.ascii ? "ascii" : "binary_little_endian") +
                    " 1.0\ncomment written by Trace\n" +
                    (picture.empty() ? "" : "comment TextureFile " + onOneLine(picture) + "\n") +
                    "element vertex " + std::to_string(mesh.points.size()) +
                    "\nproperty float x\nproperty float y\nproperty float z\n";
  if (!mesh.normals.empty()) out += "property float nx\nproperty float ny\nproperty float nz\n";
  if (!mesh.uvs.empty()) out += "property float s\nproperty float t\n";
  if (colored) out += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  out += "element face " + std::to_string(mesh.triangles.size()) +
         "\nproperty list uchar int vertex_indices\nend_header\n";

  Row row(out, options);
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    row.add(mesh.points[i]);
    if (!mesh.normals.empty()) row.add(mesh.normals[i]);
    if (!mesh.uvs.empty()) {
      row.add(static_cast<float>(mesh.uvs[i].x));
      row.add(static_cast<float>(mesh.uvs[i].y));
    }
    if (colored) {
      const Color color = phongOf(scene.materials.at(m[i])).diffuse;
      row.add(toByte(color.r));
      row.add(toByte(color.g));
      row.add(toByte(color.b));
    }
    row.end();
  }
  for (const Triangle& t : mesh.triangles) {
    row.add(std::uint8_t{3});
    for (std::uint32_t corner : t) row.add(static_cast<std::int32_t>(corner));
    row.end();
  }
  std::vector<NamedBytes> files{{file, std::move(out), NamedBytes::Contents{objects, mesh.triangles.size()}}};
  for (NamedBytes& beside : picturesNamed({picture}, seen)) files.push_back(std::move(beside));
  return files;
}

std::vector<NamedBytes> writeObj(const Scene& scene, const std::string& file, const WriteOptions& options,
                                 Messages& messages) {
  const SeenFrom seen = seenFrom(scene, file, messages);
  const std::vector<WorldMesh> meshes = worldMeshes(seen.scene, options, messages);
  const std::map<std::uint32_t, std::string> names = materialNames(scene, meshes);
  NamedBytes materialFile = placeOfMaterials(file);
  ObjWriter materials(options), objects(options);
  for (const auto& [index, name] : names) {
    const Material& material = seen.scene.materials.at(index);
    materials.material(name, phongWithoutTextures(material), pictureOf(material));
  }

  objects.line("mtllib", onOneLine(fs::path(materialFile.file).filename().generic_string()));
  std::size_t colored = 0, triangles = 0, number = 0;
  bool named = false;  // a name holds until the next one
  for (const WorldMesh& part : meshes) {
    ++number;
    triangles += part.mesh.triangles.size();
    std::string name = objName(part.name);
    if (name.empty() && named) name = "object_" + std::to_string(number);
    if (!name.empty()) objects.line("o", name);
    named = !name.empty();
    objects.line("usemtl", names.at(part.material));
    objects.mesh(part.mesh);
    colored += !part.mesh.materials.empty();
  }
  if (colored > 0)
    messages.warn(SourcePlace{scene.file, 0, 0, {}},
                  "an OBJ file holds no materials of points: left out for " + std::to_string(colored) +
                      (colored == 1 ? " mesh" : " meshes"));
  materialFile.bytes = materials.take();
  std::vector<NamedBytes> files{{file, objects.take(), NamedBytes::Contents{meshes.size(), triangles}},
                                std::move(materialFile)};
  for (NamedBytes& beside : picturesNamed(picturesOf(seen.scene, meshes), seen))
    files.push_back(std::move(beside));
  return files;
}

}  // namespace trace
