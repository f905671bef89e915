// The commands of a scene of British Columbia since 2015, executed in order as its parser does: a stack of
// matrices, materials by name, objects that copy both where they stand.
//
// Source: the course's template (docs/formats.md). Where that prints a message and renders another scene,
// this reader reports the place and stops. Keys that students added are read as far as Trace can render them.
// One file, for the commands share one state.
#include "formats/ubc/ubc_format.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "base/file.h"
#include "base/text.h"
#include "formats/format.h"
#include "formats/textures.h"
#include "formats/tokens.h"
#include "formats/ubc/ubc_scene.h"
#include "formats/warnings.h"
#include "geometry/mesh/mesh.h"
#include "geometry/shapes/conic.h"
#include "geometry/shapes/plane.h"
#include "geometry/shapes/sphere.h"

namespace trace {
namespace ubc {
namespace {

constexpr TokenRules kUbcTokens{.marks = "[]", .comment = '#'};
constexpr int kMostPixels = 100000;

constexpr std::array<std::string_view, 14> kCommands{
    "Conic",      "Dimensions", "LookAt",     "Material", "Mesh",  "Perspective", "Plane",
    "PointLight", "PopMatrix",  "PushMatrix", "Rotate",   "Scale", "Sphere",      "Translate"};
constexpr std::array<std::string_view, 3> kMoreCommands{"Camera", "Resolution", "Supersampling"};

/// A key of a material or light: `"name" 1`, `"name" [1 2 3]` or `"name" "text"`.
struct Parameter {
  Token key;
  std::vector<double> numbers;
  std::optional<std::string_view> text;
};

class UbcReader {
 public:
  UbcReader(const std::string& file, std::string_view bytes, Messages& messages)
      : tokens_(file, bytes, kUbcTokens), messages_(messages) {
    scene_.file = file;
    scene_.format = "ubc";
  }

  Scene read() {
    while (!tokens_.atEnd()) command();
    if (hasMeshes_) repairs_.report({scene_.file, 0, 0, {}}, messages_);
    if (!shadowGiven_)  // since 2021 Montreal's files have no such key, and all shadows are black
      for (Material& material : scene_.materials) {
        Phong phong = phongOf(material);
        phong.shadow = 1;
        material.model = phong;
      }
    scene_.camera = ubc::camera(view_, viewPlace_);
    addChoices(scene_, width_, height_, view_);
    if (supersampling_) scene_.choices.push_back({"spp", std::to_string(*supersampling_), {}});
    if (stack_.size() > 1)
      warnings_.warn({scene_.file, 0, 0, {}},
                     "PushMatrix without a PopMatrix after it: " + std::to_string(stack_.size() - 1));
    warnings_.report(messages_);
    warnOfNothing(scene_, view_, viewPlace_, messages_);
    return std::move(scene_);
  }

 private:
  void command() {
    const Token token = tokens_.peek();
    if (!token.is(Token::Kind::word)) tokens_.expected("scene", "a command");
    tokens_.next();
    const std::string_view name = token.text;
    if (name == "Dimensions") return dimensions();
    if (name == "Perspective") return perspective(token);
    if (name == "LookAt") return lookAt(token);
    if (name == "Material") return material();
    if (name == "PushMatrix") return stack_.push_back(stack_.back());
    if (name == "PopMatrix") return popMatrix(token);
    if (name == "Translate") return move(Affine::translation(vector("Translate")));
    if (name == "Scale") return move(Affine::scaling(vector("Scale")));
    if (name == "Rotate") return rotate();
    if (name == "Sphere") return sphere(token);
    if (name == "Plane") return add(token, Plane{}, stack_.back(), materialName());
    if (name == "Conic") return conic(token);
    if (name == "Mesh") return mesh(token);
    if (name == "PointLight") return pointLight(token);
    if (name == "Supersampling") return supersampling();
    tokens_.fail(token, "expected a command, found " + describe(token), didYouMean(name, kCommands));
  }

  // --- values ---

  /// A number, or a list of one.
  double number(std::string_view what) {
    if (!tokens_.skipMark('[')) return tokens_.number(what);
    const double value = tokens_.number(what);
    tokens_.mark(']', what);
    return value;
  }
  Vec3 vector(std::string_view what) {
    const double x = number(what), y = number(what);
    return {x, y, number(what)};
  }
  std::vector<double> list(std::string_view what) {
    std::vector<double> numbers;
    if (!tokens_.skipMark('[')) return {tokens_.number(what)};
    while (!tokens_.skipMark(']')) numbers.push_back(tokens_.number(what));
    return numbers;
  }
  std::vector<Parameter> parameters() {
    std::vector<Parameter> all;
    while (tokens_.peek().is(Token::Kind::string)) {
      Parameter& parameter = all.emplace_back();
      parameter.key = tokens_.next();
      for (std::size_t i = 0; i + 1 < all.size(); ++i)
        if (all[i].key.text == parameter.key.text) repeated(parameter.key);
      if (tokens_.peek().is(Token::Kind::string))
        parameter.text = tokens_.next().text;
      else
        parameter.numbers = list(parameter.key.text);
    }
    return all;
  }
  void repeated(const Token& key) {
    warnings_.warn(tokens_.place(key),
                   "\"" + std::string(key.text.substr(0, 40)) + "\" is given again; the last counts");
  }
  double single(const Parameter& p) const {
    counted(p, 1);
    return p.numbers[0];
  }
  Color color(const Parameter& p) const {
    counted(p, 3);
    return Color{p.numbers[0], p.numbers[1], p.numbers[2]};
  }
  void counted(const Parameter& p, std::size_t count) const {
    if (p.numbers.size() == count) return;
    tokens_.fail(p.key, std::string(p.key.text) + ": expected " + std::to_string(count) +
                            (count == 1 ? " number" : " numbers") + ", found " +
                            (p.text ? "text" : std::to_string(p.numbers.size())));
  }

  // --- picture and camera ---

  int pixels(std::string_view what) {
    const Token token = tokens_.peek();
    const double value = std::trunc(number(what));
    if (!(value >= 1 && value <= kMostPixels))
      tokens_.fail(token, std::string(what) + ": expected 1 to " + std::to_string(kMostPixels) + " pixels");
    return static_cast<int>(value);
  }
  void dimensions() {
    width_ = pixels("Dimensions");
    height_ = pixels("Dimensions");
  }
  void perspective(const Token& token) {
    view_.fovy = number("Perspective");
    view_.aspect = number("Perspective");
    view_.near = number("Perspective");
    view_.far = number("Perspective");
    if (viewPlace_.line == 0) viewPlace_ = tokens_.place(token);
    if (!tokens_.peek().is(Token::Kind::number)) return;
    messages_.warn(tokens_.place(tokens_.next()),
                   "Perspective: a fifth number, of stereo pictures, is ignored");
  }
  void lookAt(const Token& token) {
    view_.eye = vector("LookAt");
    view_.center = vector("LookAt");
    view_.up = vector("LookAt");
    viewPlace_ = tokens_.place(token);
  }
  void supersampling() {
    const Token token = tokens_.peek();
    const double rays = number("Supersampling");
    constexpr double kMost = 65536;
    if (!(rays >= 1 && rays <= kMost))
      warnings_.warn(tokens_.place(token), "Supersampling: expected 1 to 65536 rays, found " + toText(rays));
    supersampling_ = static_cast<int>(std::clamp(rays, 1.0, kMost));
  }

  // --- matrices ---

  void popMatrix(const Token& token) {
    if (stack_.size() == 1) tokens_.fail(token, "PopMatrix without a PushMatrix before it");
    stack_.pop_back();
  }
  void move(const Affine& own) { stack_.back() = stack_.back() * own; }
  void rotate() {
    const Token token = tokens_.peek();
    const double degrees = number("Rotate");
    const Vec3 axis = vector("Rotate");
    constexpr Real kClose = 0.01;
    if (!(std::abs(length(axis) - 1) < kClose))
      warnings_.warn(tokens_.place(token),
                     "Rotate: expected an axis of length 1, found one of length " + toText(length(axis)) +
                         ", which also scales and skews",
                     {}, "axis");
    move(Affine::rotation(axis, degrees * kPi / 180));  // of an axis as long as it is
  }

  // --- materials ---

  /// The 2016 template looked for "ambientColor", its scenes say "ambient".
  static std::string_view canonical(std::string_view key) {
    if (key.size() > 5 && key.ends_with("Color")) key.remove_suffix(5);
    if (key == "transparent") return "transparency";
    if (key == "rfrIndex") return "eta";
    return key;
  }

  void material() {
    const Token name = tokens_.string("Material");
    Surface surface;
    std::optional<Real> refract, transparency, eta;
    Material result{std::string(name.text), {}, {}};
    for (const Parameter& p : parameters()) {
      const std::string_view key = canonical(p.key.text);
      if (key == "ambient")
        surface.ambient = color(p);
      else if (key == "diffuse")
        surface.diffuse = color(p);
      else if (key == "specular")
        surface.specular = color(p);
      else if (key == "emission")
        surface.emission = color(p);
      else if (key == "shininess")
        surface.shininess = single(p);
      else if (key == "shadow") {
        shadowGiven_ = true;
        surface.shadow = single(p);
      } else if (key == "reflect")
        surface.reflect = single(p);
      else if (key == "refract")
        refract = single(p);
      else if (key == "transparency")
        transparency = single(p);
      else if (key == "eta")
        eta = single(p);
      else if (key == "texture")
        texture(p, result);
      else
        ignored(p, "material");
    }
    Phong phong = ubc::phong(surface);
    // With an index or a transparency beside it, "refract" is the other of the two.
    phong.transmissive = Color(transparency ? *transparency : eta ? refract.value_or(0) : 0);
    phong.index = eta ? *eta : transparency && refract.value_or(0) > 0 ? *refract : 1;
    result.model = phong;
    warnOfRanges(result, tokens_.place(name), warnings_);
    if (eta && !(*eta > 0))
      warnings_.warn(tokens_.place(name), "rfrIndex: expected a number above 0, found " + toText(*eta));
    materials_.insert_or_assign(result.name, static_cast<std::uint32_t>(scene_.materials.size()));
    scene_.materials.push_back(std::move(result));
  }

  void texture(const Parameter& p, Material& material) {
    if (!p.text) tokens_.fail(p.key, "texture: expected the name of a picture in quotes");
    if (p.text->empty()) return;
    setTexture(material.textures, "diffuse", pictureTexture(std::string(*p.text), tokens_.place(p.key)));
  }

  void ignored(const Parameter& p, std::string_view owner) {
    static constexpr std::array<std::string_view, 11> kKeys{
        "ambient", "diffuse", "specular",     "emission", "shininess",  "shadow",
        "reflect", "refract", "transparency", "rfrIndex", "attenuation"};
    if (std::find(told_.begin(), told_.end(), p.key.text) != told_.end()) return;
    told_.emplace_back(p.key.text);
    messages_.warn(tokens_.place(p.key),
                   "\"" + std::string(p.key.text) + "\" of a " + std::string(owner) + " is ignored",
                   didYouMean(p.key.text, kKeys));
  }

  std::uint32_t materialName() {
    const Token token = tokens_.string("material");
    const auto found = materials_.find(token.text);
    if (found != materials_.end()) return found->second;
    std::vector<std::string_view> names;
    for (const auto& [name, index] : materials_) names.push_back(name);
    tokens_.fail(token, "expected the name of a material, found " + describe(token),
                 didYouMean(token.text, names));
  }

  // --- objects ---

  void add(const Token& token, Shape shape, const Affine& worldFromObject, std::uint32_t material) {
    if (!invertible(worldFromObject))
      return messages_.warn(
          tokens_.place(token),
          "an object is left out: its transform makes it flat, or infinitely large or small");
    scene_.objects.push_back({"", std::move(shape), worldFromObject, material, tokens_.place(token)});
  }

  void sphere(const Token& token) {
    const double given = number("Sphere"), radius = std::abs(given);
    if (given < 0) negative(token, given);
    add(token, Sphere{}, stack_.back() * Affine::scaling({radius, radius, radius}), materialName());
  }

  void negative(const Token& token, double radius) {
    warnings_.warn(tokens_.place(token), "a radius: expected at least 0, found " + toText(radius), {},
                   "radius");
  }

  void conic(const Token& token) {
    Conic conic;
    const double bottom = number("Conic"), top = number("Conic");
    if (bottom < 0 || top < 0) negative(token, min(bottom, top));
    conic.bottomRadius = std::abs(bottom);
    conic.topRadius = std::abs(top);
    conic.zMin = number("Conic");
    conic.zMax = number("Conic");
    const std::uint32_t material = materialName();
    if (conic.zMin == conic.zMax || (conic.bottomRadius == 0 && conic.topRadius == 0))
      return messages_.warn(tokens_.place(token), "a conic without height or width is left out");
    add(token, conic, stack_.back(), material);
  }

  void mesh(const Token& token) {
    const std::uint32_t material = materialName();
    if (!tokens_.peek().is(Token::Kind::string))
      return add(token, Mesh{inlineMesh()}, stack_.back(), material);
    for (const Object& part : meshFile())
      add(token, part.shape, stack_.back() * part.worldFromObject, material);
  }

  /// Faces are flat whatever normals the file has, and shaded from both sides.
  const std::vector<Object>& meshFile() {
    const Token name = tokens_.next();
    const auto [found, fresh] = files_.try_emplace(std::string(name.text));
    if (!fresh) return found->second;
    try {
      const std::string path = findFile(scene_.file, found->first);
      Model model = readModel(path, readBeside({}, path, scene_.inputs), messages_);
      scene_.inputs.note(model.inputs);
      found->second = std::move(model.objects);
    } catch (const Error& error) {
      if (error.fault() != Fault::io) throw;
      tokens_.fail(name, error.messages().front().what);
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
    const Token start = tokens_.peek();
    const std::vector<double> counts = list("Mesh"), indices = list("Mesh");
    if (const Token p = tokens_.string("Mesh"); p.text != "P")
      tokens_.fail(p, "Mesh: expected \"P\" and the points, found " + describe(p));
    const std::vector<double> numbers = list("Mesh");
    if (numbers.size() % 3 != 0) tokens_.fail(start, "Mesh: expected three numbers for each point");
    MeshData mesh;
    for (std::size_t i = 0; i < numbers.size(); i += 3)
      mesh.points.push_back(Vec3f(Vec3{numbers[i], numbers[i + 1], numbers[i + 2]}));
    std::size_t used = 0;
    std::vector<std::uint32_t> face;
    for (double count : counts) {
      if (count != 3 && count != 4)
        tokens_.fail(start, "Mesh: expected faces of 3 or 4 points, found " + toText(count));
      face.clear();
      for (int i = 0; i < static_cast<int>(count); ++i, ++used) {
        if (used == indices.size()) tokens_.fail(start, "Mesh: expected more indices than the list has");
        const double index = indices[used];
        if (!(index >= 0 && index < static_cast<double>(mesh.points.size())) || index != std::floor(index))
          tokens_.fail(start, "Mesh: found the point number " + toText(index) + ", but the mesh has " +
                                  std::to_string(mesh.points.size()) + ", counted from 0");
        face.push_back(static_cast<std::uint32_t>(index));
      }
      mesh.triangles.push_back({face[0], face[1], face[2]});
      if (face.size() == 4) mesh.triangles.push_back({face[0], face[2], face[3]});
    }
    if (used < indices.size())
      warnings_.warn(tokens_.place(start), "Mesh: the list has more indices than its faces need: " +
                                               std::to_string(indices.size() - used));
    repairs_.check(mesh, tokens_.place(start));
    hasMeshes_ = true;
    mesh.twoSided = true;
    return std::make_shared<const MeshData>(std::move(mesh));
  }

  void pointLight(const Token& token) {
    Lamp lamp;
    lamp.position = vector("PointLight");
    for (const Parameter& p : parameters()) {
      const std::string_view key = canonical(p.key.text);
      if (key == "ambient") {
        lamp.ambient = color(p);
      } else if (key == "diffuse") {
        lamp.diffuse = color(p);
      } else if (key == "specular") {
        lamp.specular = color(p);
      } else if (key == "attenuation") {
        const Color a = color(p);
        lamp.attenuation = {a.r, a.g, a.b};
      } else if (key == "radius") {
        lamp.radius = single(p);
      } else {
        ignored(p, "light");
      }
    }
    const Vec3& a = lamp.attenuation;
    if (a.x < 0 || a.y < 0 || a.z < 0)
      warnings_.warn(tokens_.place(token), "attenuation: expected numbers of at least 0, found one below");
    for (const Color& c : {lamp.ambient, lamp.diffuse, lamp.specular})
      if (c.r < 0 || c.g < 0 || c.b < 0)
        warnings_.warn(tokens_.place(token), "PointLight: expected colours of at least 0, found one below");
    addLamp(scene_, lamp, tokens_.place(token));
  }

  Tokens tokens_;
  Messages& messages_;
  MeshRepairs repairs_;
  bool hasMeshes_ = false;
  Scene scene_;
  int width_ = 640, height_ = 640;
  View view_;
  Place viewPlace_{scene_.file, 0, 0, {}};
  std::optional<int> supersampling_;
  bool shadowGiven_ = false;
  std::vector<Affine> stack_{Affine{}};
  std::map<std::string, std::uint32_t, std::less<>> materials_;
  std::map<std::string, std::vector<Object>> files_;
  std::vector<std::string> told_;
  WarningsByKind warnings_;
};

bool isCommand(std::string_view word) {
  return std::find(kCommands.begin(), kCommands.end(), word) != kCommands.end() ||
         std::find(kMoreCommands.begin(), kMoreCommands.end(), word) != kMoreCommands.end();
}

/// The first word of a line, "" if it has none.
std::string_view firstWord(std::string_view line) {
  const std::size_t start = line.find_first_not_of(" \t\r");
  if (start == std::string_view::npos || line[start] == '#') return {};
  if (line.find('{') != std::string_view::npos) return "{";  // nodes of other formats have the same names
  line.remove_prefix(start);
  return line.substr(0, line.find_first_of(" \t\r#\""));
}

/// Counts lines at the file's beginning that start with a command; all that matter after `enough`.
struct Beginning {
  int commands = 0;
  bool first = false;  ///< the first word of all is one
  bool old = false;    ///< one is of the older grammar
};
Beginning beginning(std::string_view bytes) {
  constexpr std::size_t kFarEnough = 1 << 16;
  Beginning result;
  bytes = bytes.substr(0, kFarEnough);
  for (bool any = false; !bytes.empty();) {
    const std::string_view line = bytes.substr(0, bytes.find('\n'));
    const std::string_view word = firstWord(line);
    if (!word.empty()) {
      if (isCommand(word)) {
        ++result.commands;
        result.first |= !any;
      }
      result.old |= word == "Resolution" || word == "Camera";
      any = true;
    }
    bytes.remove_prefix(std::min(line.size() + 1, bytes.size()));
  }
  return result;
}

}  // namespace
}  // namespace ubc

bool recognisesUbc(std::string_view bytes) {
  const ubc::Beginning found = ubc::beginning(bytes);
  return found.first || found.commands >= 2;
}

Scene readUbc(const std::string& file, std::string_view bytes, Messages& messages) {
  if (ubc::beginning(bytes).old) return ubc::readOld(file, bytes, messages);
  return ubc::UbcReader(file, bytes, messages).read();
}

}  // namespace trace
