#include "formats/mesh/revolve.h"

#include <cmath>
#include <filesystem>
#include <memory>
#include <utility>

#include "base/files/file.h"
#include "formats/model_textures.h"
#include "formats/words.h"
#include "geometry/mesh/mesh.h"
#include "image/codecs/picture_name.h"
#include "math/elementary.h"

namespace trace {
namespace {

/// To the right of the way from a to b.
Vec2 normalOf(const Vec2& a, const Vec2& b) {
  const Real x = b.y - a.y, y = a.x - b.x, l = math::hypot(x, y);
  return l > 0 ? Vec2{x / l, y / l} : Vec2{};
}

/// The mean of the normals of the pieces beside each point.
std::vector<Vec2> profileNormals(std::span<const Vec2> profile) {
  std::vector<Vec2> normals(profile.size());
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    const Vec2 n = normalOf(profile[i], profile[i + 1]);
    normals[i].x += n.x;
    normals[i].y += n.y;
    normals[i + 1].x += n.x;
    normals[i + 1].y += n.y;
  }
  // On the axis the surface must not come to a point if the profile arrives there level.
  for (std::size_t i : {std::size_t{0}, profile.size() - 1})
    if (profile[i].x == 0 && std::abs(normals[i].y) > std::abs(normals[i].x)) normals[i].x = 0;
  return normals;
}

/// How far along the profile each point is, from 0 to 1.
std::vector<Real> lengths(std::span<const Vec2> profile) {
  std::vector<Real> along{0};
  for (std::size_t i = 1; i < profile.size(); ++i)
    along.push_back(along.back() +
                    math::hypot(profile[i].x - profile[i - 1].x, profile[i].y - profile[i - 1].y));
  const Real whole = along.back();
  if (whole > 0)
    for (Real& a : along) a /= whole;
  return along;
}

/// A matt material with the picture, whose name is seen from the file `from`.
Material painted(const std::string& from, const std::string& picture, InputFiles& inputs) {
  namespace fs = std::filesystem;
  const std::string bytes = readBeside("", pictureName(picture).file, inputs);
  const fs::path folder = fs::absolute(from).parent_path().lexically_normal();
  const Pixels pixels{nameFrom(folder.string(), fs::absolute(picture).lexically_normal().string()),
                      MipMap::decode(bytes, picture), SourcePlace{.file = picture}};
  const Texture texture = TextureNode{.model = modelPicture(pixels)};
  Phong phong;
  phong.ambient = phong.diffuse = Color(1);
  Material material{"", phong, {}};
  setTexture(material.textures, kAmbient, texture);
  setTexture(material.textures, kDiffuse, texture);
  return material;
}

}  // namespace

std::vector<Vec2> readProfile(const std::string& file, std::string_view text) {
  constexpr std::size_t kMostPoints = 100000;
  std::vector<Vec2> profile;
  Words words(file, text, '#');
  while (!words.atEnd()) {
    const double x = words.number("the distance of a point from the axis");
    if (!(x >= 0 && std::isfinite(x))) words.fail("expected a distance from the axis of 0 or more");
    const double y = words.number("the height of a point");
    if (!std::isfinite(y)) words.fail("expected a finite height");
    profile.push_back({x, y});
    if (profile.size() > kMostPoints) words.fail("expected at most 100000 points, found more");
  }
  if (profile.size() < 2)
    throw Error(Fault::scene, SourcePlace{file, 0, 0, {}},
                "expected a profile of at least 2 points, found " + std::to_string(profile.size()));
  return profile;
}

MeshData revolve(std::span<const Vec2> profile, int steps) {
  const std::vector<Vec2> normals = profileNormals(profile);
  const std::vector<Real> along = lengths(profile);
  const auto rows = static_cast<std::uint32_t>(profile.size());
  MeshData mesh;
  // The last column is the first again, except for u.
  for (int step = 0; step <= steps; ++step) {
    const Real angle = 2 * kPi * (step % steps) / steps, c = math::cos(angle), s = math::sin(angle);
    for (std::uint32_t i = 0; i < rows; ++i) {
      mesh.points.push_back(Vec3f(Vec3{profile[i].x * c, profile[i].y, 0 - profile[i].x * s}));
      const Vec3 n{normals[i].x * c, normals[i].y, 0 - normals[i].x * s};
      mesh.normals.push_back(n == Vec3{} ? Vec3f{} : Vec3f(normalize(n)));
      mesh.uvs.push_back({static_cast<Real>(step) / steps, along[i]});
    }
  }
  for (std::uint32_t column = 0; column < static_cast<std::uint32_t>(steps); ++column)
    for (std::uint32_t i = 0; i + 1 < rows; ++i) {
      const std::uint32_t a = column * rows + i, b = a + rows;
      if (profile[i].x > 0) mesh.triangles.push_back({a, b, b + 1});
      if (profile[i + 1].x > 0) mesh.triangles.push_back({a, b + 1, a + 1});
    }
  return mesh;
}

Scene revolvedScene(const std::string& file, std::string_view text, int steps, const std::string& picture,
                    Messages& messages) {
  const SourcePlace place{file, 0, 0, {}};
  MeshData mesh = revolve(readProfile(file, text), steps);
  MeshRepairs repairs;
  repairs.check(mesh, place);
  repairs.report(place, messages);
  Model model;
  std::uint32_t material = Model::kNoMaterial;
  if (!picture.empty()) {
    material = 0;
    model.materials.push_back(painted(file, picture, model.inputs));
  }
  model.objects.push_back({"", Mesh{std::make_shared<const MeshData>(std::move(mesh))}, {}, material, place});
  return sceneOf(std::move(model), file, "profile");
}

}  // namespace trace
