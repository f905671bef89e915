// The commands of a scene of British Columbia since 2015, executed in order as its parser does: a stack of
// matrices, materials by name, objects that copy both where they stand.
//
// Source: the course's template (docs/formats.md). Where that prints a message and renders another scene,
// this reader reports the place and stops. Keys that students added are read as far as Trace can render them.
#include "formats/ubc/ubc_format.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "base/files/named_file.h"
#include "base/files/read_scope.h"
#include "base/text.h"
#include "formats/format.h"
#include "formats/textures.h"
#include "formats/ubc/ubc_materials.h"
#include "formats/ubc/ubc_recognition.h"
#include "formats/ubc/ubc_scene.h"
#include "formats/ubc/ubc_values.h"
#include "geometry/mesh/mesh.h"
#include "geometry/shapes/solids/conic.h"
#include "geometry/shapes/solids/plane.h"
#include "geometry/shapes/solids/sphere.h"

namespace trace {
namespace ubc {
namespace {

constexpr int kMostPixels = 100000;

class UbcReader {
 public:
  UbcReader(const std::string& file, std::string_view bytes, Messages& messages)
      : values_(file, bytes, messages) {
    scene_.file = file;
    scene_.format = "ubc";
  }

  Scene read() {
    while (!values_.tokens.atEnd()) command();
    if (hasMeshes_) repairs_.report({scene_.file, 0, 0, {}}, values_.messages);
    if (!materials_.givesShadow())  // since 2021 Montreal's files have no such key, and all shadows are black
      for (Material& material : scene_.materials) {
        Phong phong = phongOf(material);
        phong.shadow = 1;
        material.model = phong;
      }
    scene_.camera = ubc::camera(view_, viewPlace_);
    addChoices(scene_, width_, height_, view_);
    if (supersampling_) scene_.choices.push_back({"spp", std::to_string(*supersampling_), {}});
    if (stack_.size() > 1)
      values_.warnings.warn({scene_.file, 0, 0, {}},
                            "PushMatrix without a PopMatrix after it: " + std::to_string(stack_.size() - 1));
    values_.warnings.report(values_.messages);
    warnOfNothing(scene_, view_, viewPlace_, values_.messages);
    return std::move(scene_);
  }

 private:
  void command() {
    const Token token = values_.tokens.peek();
    if (!token.is(Token::Kind::word)) values_.tokens.expected("scene", "a command");
    values_.tokens.next();
    const std::string_view name = token.text;
    if (name == "Dimensions") return dimensions();
    if (name == "Perspective") return perspective(token);
    if (name == "LookAt") return lookAt(token);
    if (name == "Material") return materials_.material();
    if (name == "PushMatrix") return stack_.push_back(stack_.back());
    if (name == "PopMatrix") return popMatrix(token);
    if (name == "Translate") return move(Affine::translation(values_.vector("Translate")));
    if (name == "Scale") return move(Affine::scaling(values_.vector("Scale")));
    if (name == "Rotate") return rotate();
    if (name == "Sphere") return sphere(token);
    if (name == "Plane") return add(token, Plane{}, stack_.back(), materials_.named());
    if (name == "Conic") return conic(token);
    if (name == "Mesh") return mesh(token);
    if (name == "PointLight") return pointLight(token);
    if (name == "Supersampling") return supersampling();
    values_.tokens.fail(token, "expected a command, found " + describe(token), didYouMean(name, kCommands));
  }

  // --- picture and camera ---

  int pixels(std::string_view what) {
    const Token token = values_.tokens.peek();
    const double value = std::trunc(values_.number(what));
    if (!(value >= 1 && value <= kMostPixels))
      values_.tokens.fail(token,
                          std::string(what) + ": expected 1 to " + std::to_string(kMostPixels) + " pixels");
    return static_cast<int>(value);
  }
  void dimensions() {
    width_ = pixels("Dimensions");
    height_ = pixels("Dimensions");
  }
  void perspective(const Token& token) {
    view_.fovy = values_.number("Perspective");
    view_.aspect = values_.number("Perspective");
    view_.near = values_.number("Perspective");
    view_.far = values_.number("Perspective");
    if (viewPlace_.line == 0) viewPlace_ = values_.tokens.place(token);
    if (!values_.tokens.peek().is(Token::Kind::number)) return;
    values_.messages.warn(values_.tokens.place(values_.tokens.next()),
                          "Perspective: a fifth number, of stereo pictures, is ignored");
  }
  void lookAt(const Token& token) {
    view_.eye = values_.vector("LookAt");
    view_.center = values_.vector("LookAt");
    view_.up = values_.vector("LookAt");
    viewPlace_ = values_.tokens.place(token);
  }
  void supersampling() {
    const Token token = values_.tokens.peek();
    const double rays = values_.number("Supersampling");
    constexpr double kMost = 65536;
    if (!(rays >= 1 && rays <= kMost))
      values_.warnings.warn(values_.tokens.place(token),
                            "Supersampling: expected 1 to 65536 rays, found " + toText(rays));
    supersampling_ = static_cast<int>(std::clamp(rays, 1.0, kMost));
  }

  // --- matrices ---

  void popMatrix(const Token& token) {
    if (stack_.size() == 1) values_.tokens.fail(token, "PopMatrix without a PushMatrix before it");
    stack_.pop_back();
  }
  void move(const Affine& own) { stack_.back() = stack_.back() * own; }
  void rotate() {
    const Token token = values_.tokens.peek();
    const double degrees = values_.number("Rotate");
    const Vec3 axis = values_.vector("Rotate");
    constexpr Real kClose = 0.01;
    if (!(std::abs(length(axis) - 1) < kClose))
      values_.warnings.warn(values_.tokens.place(token),
                            "Rotate: expected an axis of length 1, found one of length " +
                                toText(length(axis)) + ", which also scales and skews",
                            {}, "axis");
    move(Affine::rotation(axis, degrees * kPi / 180));  // the axis is used at its length
  }

  // --- objects ---

  void add(const Token& token, Shape shape, const Affine& worldFromObject, std::uint32_t material) {
    if (!invertible(worldFromObject))
      return values_.messages.warn(
          values_.tokens.place(token),
          "an object is left out: its transform makes it flat, or infinitely large or small");
    scene_.objects.push_back({"", std::move(shape), worldFromObject, material, values_.tokens.place(token)});
  }

  void sphere(const Token& token) {
    const double given = values_.number("Sphere"), radius = std::abs(given);
    if (given < 0) negative(token, given);
    add(token, Sphere{}, stack_.back() * Affine::scaling({radius, radius, radius}), materials_.named());
  }

  void negative(const Token& token, double radius) {
    values_.warnings.warn(values_.tokens.place(token),
                          "a radius: expected at least 0, found " + toText(radius), {}, "radius");
  }

  void conic(const Token& token) {
    Conic conic;
    const double bottom = values_.number("Conic"), top = values_.number("Conic");
    if (bottom < 0 || top < 0) negative(token, min(bottom, top));
    conic.bottomRadius = std::abs(bottom);
    conic.topRadius = std::abs(top);
    conic.zMin = values_.number("Conic");
    conic.zMax = values_.number("Conic");
    const std::uint32_t material = materials_.named();
    if (conic.zMin == conic.zMax || (conic.bottomRadius == 0 && conic.topRadius == 0))
      return values_.messages.warn(values_.tokens.place(token),
                                   "a conic without height or width is left out");
    add(token, conic, stack_.back(), material);
  }

  void mesh(const Token& token) {
    const std::uint32_t material = materials_.named();
    if (!values_.tokens.peek().is(Token::Kind::string))
      return add(token, Mesh{inlineMesh()}, stack_.back(), material);
    for (const Object& part : meshFile())
      add(token, part.shape, stack_.back() * part.worldFromObject, material);
  }

  /// Faces are flat whatever normals the file has, and shaded from both sides.
  const std::vector<Object>& meshFile() {
    const Token name = values_.tokens.next();
    const auto [found, fresh] = files_.try_emplace(std::string(name.text));
    if (!fresh) return found->second;
    try {
      const NamedFile named = namedFile(scene_.file, found->first);
      if (!named.remark.empty()) values_.messages.warn(values_.tokens.place(name), named.remark);
      Model model = readModel(named.path, readBeside({}, named.path, scene_.inputs), values_.messages);
      scene_.inputs.note(model.inputs);
      found->second = std::move(model.objects);
    } catch (const ReadDenied& denied) {
      denied.at(values_.tokens.place(name));
    } catch (const Error& error) {
      if (error.fault() != Fault::io) throw;
      values_.tokens.fail(name, error.messages().front().what);
    }
    for (Object& object : found->second) {
      MeshData mesh = *object.shape.as<Mesh>()->data;
      mesh.normals.clear();
      mesh.materials.clear();
      mesh.generateNormals = false;
      mesh.twoSided = true;
      object.shape = Mesh{std::make_shared<const MeshData>(std::move(mesh))};
    }
    return found->second;
  }

  std::shared_ptr<const MeshData> inlineMesh() {
    const Token start = values_.tokens.peek();
    const std::vector<double> counts = values_.list("Mesh"), indices = values_.list("Mesh");
    if (const Token p = values_.tokens.string("Mesh"); p.text != "P")
      values_.tokens.fail(p, "Mesh: expected \"P\" and the points, found " + describe(p));
    const std::vector<double> numbers = values_.list("Mesh");
    if (numbers.size() % 3 != 0) values_.tokens.fail(start, "Mesh: expected three numbers for each point");
    MeshData mesh;
    for (std::size_t i = 0; i < numbers.size(); i += 3)
      mesh.points.push_back(Vec3f(Vec3{numbers[i], numbers[i + 1], numbers[i + 2]}));
    std::size_t used = 0;
    std::vector<std::uint32_t> face;
    for (double count : counts) {
      if (count != 3 && count != 4)
        values_.tokens.fail(start, "Mesh: expected faces of 3 or 4 points, found " + toText(count));
      face.clear();
      for (int i = 0; i < static_cast<int>(count); ++i, ++used) {
        if (used == indices.size())
          values_.tokens.fail(start, "Mesh: expected more indices than the list has");
        const double index = indices[used];
        if (!(index >= 0 && index < static_cast<double>(mesh.points.size())) || index != std::floor(index))
          values_.tokens.fail(start, "Mesh: found the point number " + toText(index) + ", but the mesh has " +
                                         std::to_string(mesh.points.size()) + ", counted from 0");
        face.push_back(static_cast<std::uint32_t>(index));
      }
      mesh.triangles.push_back({face[0], face[1], face[2]});
      if (face.size() == 4) mesh.triangles.push_back({face[0], face[2], face[3]});
    }
    if (used < indices.size())
      values_.warnings.warn(
          values_.tokens.place(start),
          "Mesh: the list has more indices than its faces need: " + std::to_string(indices.size() - used));
    repairs_.check(mesh, values_.tokens.place(start));
    hasMeshes_ = true;
    mesh.twoSided = true;
    return std::make_shared<const MeshData>(std::move(mesh));
  }

  void pointLight(const Token& token) {
    Lamp lamp;
    lamp.position = values_.vector("PointLight");
    for (const Parameter& p : values_.parameters()) {
      const std::string_view key = values_.canonical(p.key.text);
      if (key == "ambient") {
        lamp.ambient = values_.color(p);
      } else if (key == "diffuse") {
        lamp.diffuse = values_.color(p);
      } else if (key == "specular") {
        lamp.specular = values_.color(p);
      } else if (key == "attenuation") {
        const Color a = values_.color(p);
        lamp.attenuation = {a.r, a.g, a.b};
      } else if (key == "radius") {
        lamp.radius = values_.single(p);
      } else {
        values_.ignored(p, "light");
      }
    }
    const Vec3& a = lamp.attenuation;
    if (a.x < 0 || a.y < 0 || a.z < 0)
      values_.warnings.warn(values_.tokens.place(token),
                            "attenuation: expected numbers of at least 0, found one below");
    for (const Color& c : {lamp.ambient, lamp.diffuse, lamp.specular})
      if (c.r < 0 || c.g < 0 || c.b < 0)
        values_.warnings.warn(values_.tokens.place(token),
                              "PointLight: expected colours of at least 0, found one below");
    addLamp(scene_, lamp, values_.tokens.place(token));
  }

  Values values_;
  MeshRepairs repairs_;
  bool hasMeshes_ = false;
  Scene scene_;
  int width_ = 640, height_ = 640;
  View view_;
  SourcePlace viewPlace_{scene_.file, 0, 0, {}};
  std::optional<int> supersampling_;
  std::vector<Affine> stack_{Affine{}};
  MaterialReader materials_{values_, scene_};
  std::map<std::string, std::vector<Object>> files_;
};

}  // namespace
}  // namespace ubc

Scene readUbc(const std::string& file, std::string_view bytes, Messages& messages) {
  if (ubc::beginning(bytes).old) return ubc::readOld(file, bytes, messages);
  return ubc::UbcReader(file, bytes, messages).read();
}

}  // namespace trace
