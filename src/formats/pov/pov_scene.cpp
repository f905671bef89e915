#include "formats/pov/pov_scene.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "base/budget.h"
#include "base/text.h"
#include "formats/pov/pov_paint.h"
#include "formats/pov/pov_shapes.h"
#include "geometry/mesh/mesh.h"
#include "geometry/shapes/solids/csg_tree.h"
#include "geometry/shapes/solids/sphere.h"
#include "geometry/traced.h"
#include "image/codecs/codec.h"
#include "math/elementary.h"
#include "shading/lights/plain_lights.h"

namespace trace::pov {
namespace {

/// Properties that an object has from the ones around it.
struct Around {
  Ref<TextureNode> texture;
  Affine worldFromTexture;
  Ref<InteriorNode> interior;
  bool noShadow = false;
};

/// A solid of which `outside` is what it does not fill.
struct SolidPart {
  Operand operand;
  bool inverted = false;
};

/// Which kind of highlights most textures of a scene have: a render has one.
class HighlightKinds {
 public:
  bool mostlyMirrored(const World& world) {
    for (const Ref<Node>& node : world.objects) count(*node);
    return mirrored_ > halfway_;
  }

 private:
  bool isNew(const void* part) { return met_.insert(part).second; }
  void count(const Node& node) {
    if (!isNew(&node)) return;
    for (const Ref<Node>& part : node.parts) count(*part);
    if (node.texture) count(*node.texture);
    for (const Ref<TextureNode>& texture : node.meshTextures)
      if (texture) count(*texture);
  }
  void count(const TextureNode& texture) {
    if (!isNew(&texture)) return;
    for (const TextureNode::Layer& layer : texture.layers) {
      for (const auto& [at, one] : layer.entries) count(*one);
      if (!layer.finish || !layer.entries.empty()) continue;
      mirrored_ += layer.finish->phong > layer.finish->specular;
      halfway_ += layer.finish->specular > 0 && layer.finish->specular >= layer.finish->phong;
    }
  }

  std::set<const void*> met_;
  int mirrored_ = 0, halfway_ = 0;
};

class Builder {
 public:
  Builder(Scene& scene, const World& world, WarningsByKind& warnings)
      : scene_(scene), world_(world), warnings_(warnings), painter_(warnings) {}

  void build();
  /// One object alone, where POV-Ray has it.
  void build(const Node& node) { emit(node, Affine(), {world_.defaultTexture, Affine(), nullptr, false}, 0); }

 private:
  void camera();
  void sky();
  void settings();
  void emit(const Node& node, const Affine& worldFromParent, Around around, int depth);
  void light(const Node& node, const Affine& world, Around around, int depth);
  void add(Shape shape, const Affine& worldFromObject, std::uint32_t material, const Node& node);
  std::optional<SolidPart> solid(const Node& node, const Affine& worldFromParent, Around around, int depth);
  std::optional<SolidPart> combinedSolid(Node::Kind kind, std::vector<SolidPart> parts,
                                         std::uint32_t material);
  std::optional<Operand> plainOperand(SolidPart part);
  std::uint32_t material(const Around& around, const Affine& worldFromObject, bool uv);
  Around within(const Node& node, const Affine& world, Around around) const;
  void leaveOut(const SourcePlace& place, const std::string& what, const std::string& hint = {}) {
    if (!warnings_.again(what + " is left out")) warnings_.warn(place, what + " is left out", hint);
  }
  void choose(const char* option, std::string value) {
    scene_.choices.push_back({option, std::move(value), SourcePlace{.file = scene_.file}});
  }

  Scene& scene_;
  const World& world_;
  WarningsByKind& warnings_;
  Painter painter_;
  Affine base_;  ///< the world from POV-Ray's
};

Affine mirrored() { return Affine::scaling({1, 1, -1}); }

Affine inverted(const Affine& m) { return invertible(m) ? inverse(m) : Affine(); }

constexpr int kMostUnions = 60;

std::string shortest(Real v) { return toText(v); }

void Builder::build() {
  const Work work("placing the objects", static_cast<std::int64_t>(world_.objects.size()));
  camera();
  // Pictures are made linear or left as they are, whichever is closer to that gamma.
  const Real gamma = world_.gamma > 0 ? world_.gamma : world_.version >= 3.7 ? 1 : 2.2;
  constexpr Real kMiddle = 1.5;
  painter_.setConventions({HighlightKinds().mostlyMirrored(world_), gamma <= kMiddle});
  const Around nothing{world_.defaultTexture, base_, nullptr, false};
  for (const Ref<Node>& node : world_.objects) {
    checkBudget();
    emit(*node, base_, nothing, 0);
  }
  sky();
  settings();
}

void Builder::camera() {
  base_ = mirrored();
  const CameraNode c = world_.camera.value_or(CameraNode{});
  const Vec3 d = c.direction, r = c.right, u = c.up;
  if (dot(cross(u, d), r) < 0) base_ = Affine();  // right-handed
  Camera& to = scene_.camera;
  to.position = base_ * c.location;
  to.viewdir = linear(base_, d);
  to.updir = linear(base_, u);
  const Real wide = length(r), high = length(u), deep = length(d);
  if (!(wide > 0) || !(high > 0) || !(deep > 0) || !(length(cross(d, u)) > 0)) {
    leaveOut(c.place, "a camera without a direction");
    to = Camera{};
    return;
  }
  to.aspectratio = wide / high;
  to.fov = std::clamp(2 * math::atan(high / 2 / deep) * 180 / kPi, 0.001, 179.9);
  if (c.kind == "orthographic") {
    choose("projection", "orthographic");
    Real height = high;
    if (c.angle > 0) height = high / wide * 2 * math::tan(c.angle * kPi / 360) * std::max(deep, 1e-9);
    if (c.angle > 0 && c.lookAt)
      height = high / wide * 2 * math::tan(c.angle * kPi / 360) * length(*c.lookAt - c.location);
    choose("view-height", shortest(height));
  } else if (c.kind == "fisheye") {
    choose("projection", "fisheye");
    choose("fisheye-angle", shortest(c.angle > 0 ? std::min(c.angle, 360.0) : 180));
  } else if (c.kind == "panoramic" || c.kind == "cylinder") {
    choose("projection", "cylinder");
    if (c.kind == "cylinder") to.aspectratio = 4.0 / 3;  // up tells what is seen, not the picture's shape
    if (c.kind == "cylinder") leaveOut(c.place, "that the camera is a cylinder of its own kind");
  } else if (c.kind == "spherical") {
    choose("projection", "panorama");
  } else if (c.kind != "perspective") {
    leaveOut(c.place, "the camera " + c.kind, "a perspective takes its place");
  }
  if (c.aperture > 0 && c.focalPoint) {
    choose("aperture", shortest(c.aperture));
    choose("focus", shortest(std::abs(dot(*c.focalPoint - c.location, normalize(d)))));
  }
}

std::uint32_t Builder::material(const Around& around, const Affine& worldFromObject, bool uv) {
  const Affine objectFromTexture = inverted(worldFromObject) * around.worldFromTexture;
  Material m = painter_.material(*around.texture, around.interior.get(), objectFromTexture, uv);
  m.castsShadow = !around.noShadow;
  // Few scenes have many; the last ones are the likeliest.
  const std::size_t n = scene_.materials.size();
  for (std::size_t i = n; i-- > 0 && n - i < 40;)
    if (scene_.materials[i] == m) return static_cast<std::uint32_t>(i);
  scene_.materials.push_back(std::move(m));
  return static_cast<std::uint32_t>(n);
}

Around Builder::within(const Node& node, const Affine& world, Around around) const {
  if (node.texture) {
    around.texture = node.texture;
    around.worldFromTexture = world * node.textureAt;
  }
  if (node.interior) around.interior = node.interior;
  around.noShadow |= node.noShadow;
  return around;
}

void Builder::add(Shape shape, const Affine& worldFromObject, std::uint32_t material, const Node& node) {
  if (!invertible(worldFromObject)) return leaveOut(node.place, "an object that is squeezed flat");
  SourcePlace place = node.place;
  scene_.objects.push_back({node.name, std::move(shape), worldFromObject, material, std::move(place)});
}

void Builder::emit(const Node& node, const Affine& worldFromParent, Around around, int depth) {
  checkBudget();
  const Affine world = worldFromParent * node.at;
  around = within(node, world, std::move(around));
  switch (node.kind) {
    case Node::Kind::nothing: return;
    case Node::Kind::light: return light(node, world, std::move(around), depth);
    case Node::Kind::unite:
      if (!node.clips.empty()) break;
      if (depth > kMostUnions) return leaveOut(node.place, "a union more than 60 deep");
      for (const Ref<Node>& part : node.parts) emit(*part, world, around, depth + 1);
      return;
    case Node::Kind::shape:
      if (!node.clips.empty()) break;
      {
        const Affine place = world * node.shapeAt;
        Shape shape = *node.shape;
        if (const Mesh* mesh = shape.as<Mesh>();
            mesh && !node.meshTextures.empty() && !mesh->data->materials.empty()) {
          std::vector<std::uint32_t> numbers{material(around, place, node.uv)};
          for (const Ref<TextureNode>& t : node.meshTextures)
            numbers.push_back(material({t, world, around.interior, around.noShadow}, place, node.uv));
          auto data = std::make_shared<MeshData>(*mesh->data);
          for (std::uint32_t& m : data->materials) m = numbers[std::min<std::size_t>(m, numbers.size() - 1)];
          shape = Mesh{data};
        }
        add(std::move(shape), place, material(around, place, node.uv), node);
      }
      return;
    default: break;
  }
  // A solid of solids, or a clip.
  for (const Ref<Node>& part : node.parts)
    if (part->kind == Node::Kind::light) emit(*part, world, around, depth + 1);
  if (!node.clips.empty()) {
    Node bare = node;
    bare.clips.clear();
    bare.inverse = false;
    std::vector<Operand> operands;
    if (node.kind == Node::Kind::unite) {  // each part by itself
      for (const Ref<Node>& part : node.parts) {
        Node copy = *part;
        const Affine back = inverted(copy.at);
        for (const Ref<Node>& clip : node.clips) {
          auto moved = std::make_shared<Node>(*clip);
          moved->at = back * moved->at;
          copy.clips.push_back(moved);
        }
        emit(copy, world, around, depth + 1);
      }
      return;
    }
    std::optional<SolidPart> first = solid(bare, worldFromParent, around, depth + 1);
    if (!first) return;
    operands.push_back(first->operand);
    for (const Ref<Node>& clip : node.clips)
      if (auto part = solid(*clip, world, around, depth + 1))
        if (auto plain = plainOperand(std::move(*part))) operands.push_back(std::move(*plain));
    if (operands.size() < 2) return emit(bare, worldFromParent, around, depth + 1);
    const std::uint32_t own = operands.front().material;
    return add(Shape(Clip{Operands(std::move(operands))}), base_, own, node);
  }
  if (std::optional<SolidPart> whole = solid(node, worldFromParent, around, depth + 1))
    add(whole->operand.shape, base_ * whole->operand.wholeFromOperand, whole->operand.material, node);
}

/// An operand that is the outside of a solid becomes a very large ball without it.
std::optional<Operand> Builder::plainOperand(SolidPart part) {
  if (!part.inverted) return std::move(part.operand);
  constexpr Real kFar = 1e6;
  Operand far{{}, Shape(Sphere{}), Affine::scaling({kFar, kFar, kFar}), part.operand.material};
  const std::uint32_t own = part.operand.material;
  return Operand{{}, Shape(Difference{Operands({std::move(far), std::move(part.operand)})}), Affine(), own};
}

std::optional<SolidPart> Builder::combinedSolid(Node::Kind kind, std::vector<SolidPart> parts,
                                                std::uint32_t material) {
  if (parts.empty()) return {};
  if (parts.size() == 1) return std::move(parts.front());
  if (kind == Node::Kind::subtract)
    for (std::size_t i = 1; i < parts.size(); ++i) parts[i].inverted = !parts[i].inverted;
  const bool unites = kind == Node::Kind::unite || kind == Node::Kind::merge;
  // A union is the outside of the intersection of the outsides.
  if (unites)
    for (SolidPart& p : parts) p.inverted = !p.inverted;
  std::vector<Operand> inside, outside;
  for (SolidPart& p : parts) (p.inverted ? outside : inside).push_back(std::move(p.operand));
  SolidPart result;
  result.operand.material = material;
  const auto all = [&](std::vector<Operand> list, bool asUnion) {
    if (list.size() == 1) return std::move(list.front());
    const std::uint32_t own = list.front().material;
    return asUnion ? Operand{{}, Shape(Union{Operands(std::move(list))}), Affine(), own}
                   : Operand{{}, Shape(Intersection{Operands(std::move(list))}), Affine(), own};
  };
  if (inside.empty()) {
    result.operand = all(std::move(outside), true);
    result.inverted = true;
  } else if (outside.empty()) {
    result.operand = all(std::move(inside), false);
  } else {
    std::vector<Operand> list{all(std::move(inside), false)};
    for (Operand& o : outside) list.push_back(std::move(o));
    const std::uint32_t own = list.front().material;
    result.operand = Operand{{}, Shape(Difference{Operands(std::move(list))}), Affine(), own};
  }
  if (unites) result.inverted = !result.inverted;
  return result;
}

std::optional<SolidPart> Builder::solid(const Node& node, const Affine& worldFromParent, Around around,
                                        int depth) {
  checkBudget();
  const Affine world = worldFromParent * node.at;
  around = within(node, world, std::move(around));
  std::optional<SolidPart> result;
  if (depth > kMostUnions) {
    leaveOut(node.place, "solids of solids more than 60 deep");
    return {};
  }
  switch (node.kind) {
    case Node::Kind::nothing:
    case Node::Kind::light: return {};
    case Node::Kind::shape: {
      const Affine place = inverted(base_) * world * node.shapeAt;
      if (!invertible(place)) return {};
      bool isSolid = false;
      try {
        isSolid = check(*node.shape).solid;
      } catch (const Error& error) {
        if (error.fault() == Fault::limit) throw;
      }
      if (!isSolid) {
        leaveOut(node.place,
                 "an open surface (" + std::string(node.shape->keyword()) + ") within a solid of solids");
        return {};
      }
      result = SolidPart{{node.name, *node.shape, place, material(around, base_, node.uv)}};
      break;
    }
    default: {
      std::vector<SolidPart> parts;
      bool first = true;
      for (const Ref<Node>& part : node.parts) {
        std::optional<SolidPart> one = solid(*part, world, around, depth + 1);
        if (one) parts.push_back(std::move(*one));
        if (!one && first && node.kind == Node::Kind::subtract && part->kind != Node::Kind::light) return {};
        if (part->kind != Node::Kind::light) first = false;
      }
      result = combinedSolid(node.kind, std::move(parts), 0);
    }
  }
  if (result && !node.clips.empty()) {
    std::vector<SolidPart> parts{std::move(*result)};
    for (const Ref<Node>& clip : node.clips)
      if (auto one = solid(*clip, world, around, depth + 1)) parts.push_back(std::move(*one));
    result = combinedSolid(Node::Kind::intersect, std::move(parts), 0);
  }
  if (result && node.inverse) result->inverted = !result->inverted;
  return result;
}

/// The object of looks_like stands around the light and does not block it.
void Builder::light(const Node& node, const Affine& world, Around around, int depth) {
  const LightNode& l = node.light;
  const Vec3 position = world * l.position, at = world * l.pointAt;
  const SourcePlace place = node.place;
  around.noShadow = true;
  for (const Ref<Node>& look : node.parts)
    emit(*look, world * Affine::translation(l.position), around, depth + 1);
  const LightLinks links{.name = {}, .castsShadows = !l.shadowless};
  const auto fading = [&]() -> Fading {
    if (!(l.fadePower > 0) || !(l.fadeDistance > 0)) return {};
    if (l.fadePower != 1 && l.fadePower != 2) leaveOut(place, "a fade_power that is neither 1 nor 2");
    if (l.fadePower < 1.5) return {0.5, 0.5 / l.fadeDistance, 0};
    return {0.5, 0, 0.5 / (l.fadeDistance * l.fadeDistance)};
  };
  Color color = l.color;
  for (Real* part : {&color.r, &color.g, &color.b})
    if (*part < 0) {
      leaveOut(place, "a light that takes light away");
      *part = 0;
    }
  const Vec3 aim = at - position;
  if (l.parallel && length(aim) > 0) {
    scene_.lights.push_back({directionalLight(normalize(aim), color), place, links});
    return;
  }
  const Real size = l.area ? (length(linear(world, l.axis1)) + length(linear(world, l.axis2))) / 4 : 0;
  if (l.kind != LightNode::Kind::point && length(aim) > 0) {
    SpotCone cone{.angle = std::clamp(l.falloff, 0.0, 180.0), .smooth = true, .exponent = l.tightness};
    cone.fullAngle = std::clamp(l.radius, 0.0, cone.angle);
    const Fading fades = fading();
    if (l.kind == LightNode::Kind::cylinder) {
      leaveOut(place, "that the light shines into a cylinder", "a cone takes its place");
      const Real away = length(aim);
      cone.angle = math::atan2(l.falloff, away) * 180 / kPi;
      cone.fullAngle = math::atan2(std::min(l.radius, l.falloff), away) * 180 / kPi;
    }
    scene_.lights.push_back({spotLight(position, normalize(aim), color, cone, fades, size), place, links});
    return;
  }
  scene_.lights.push_back({pointLight(position, color, fading(), size), place, links});
}

void Builder::sky() {
  Background& to = scene_.background;
  Paint all;
  if (world_.background) {
    all.scale = *world_.background;
    to.gradient = to.colors = {all.scale};  // every ray sees it
  }
  if (!world_.sky || world_.sky->pigments.empty()) return;
  const SkyNode& sky = *world_.sky;
  for (const Ref<PigmentNode>& p : sky.pigments)
    all = Painter::layered(painter_.opaque(*p), painter_.passing(*p), all);
  if (!all.texture) {
    to.colors = {all.scale};
    to.gradient = {all.scale};
    return;
  }
  to.gradient.clear();
  const Texture texture = moved(*all.texture, base_ * sky.at);
  const auto seen = [&](const Vec3& direction) {
    return texture.at(
               {.point = normalize(direction), .uv = {}, .uvX = {}, .uvY = {}, .pointX = {}, .pointY = {}}) *
           all.scale;
  };
  // Does it change with the elevation only?
  constexpr int kSteps = 72, kAround = 7;
  bool even = true;
  for (int i = 0; i <= kSteps; ++i) {
    const Real elevation = (-90 + 180.0 * i / kSteps) * kPi / 180;
    Color first;
    for (int j = 0; j < kAround; ++j) {
      const Real turn = 2 * kPi * (j + 0.3) / kAround;
      const Color c = seen({math::cos(elevation) * math::cos(turn), math::sin(elevation),
                            math::cos(elevation) * math::sin(turn)});
      if (j == 0) first = c;
      even = even && maxComponent(Color(std::abs(c.r - first.r), std::abs(c.g - first.g),
                                        std::abs(c.b - first.b))) < 1e-6;
    }
    to.gradient.push_back(first);
  }
  if (even) return;
  to.gradient.clear();
  constexpr int kSide = 256;
  const auto face = [&](const char* name, const Vec3& ahead, const Vec3& right, const Vec3& up) {
    Picture picture(kSide, kSide);
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        checkBudget();
        const Real a = 2 * (x + 0.5) / kSide - 1, b = 1 - 2 * (y + 0.5) / kSide;
        picture.at(x, y) = clamp01(seen(ahead + right * a + up * b));
      }
    auto inside = std::make_shared<InsideFile>();
    inside->name = std::string("sky-") + name + ".png";
    inside->bytes = encodePicture(pictureFormatFor("sky.png"), picture, Rounding::nearest);
    return Pixels{inside->name, MipMap::decode(inside->bytes, inside->name), sky.place, inside};
  };
  to.front = face("front", {0, 0, -1}, {1, 0, 0}, {0, 1, 0});
  to.back = face("back", {0, 0, 1}, {-1, 0, 0}, {0, 1, 0});
  to.left = face("left", {-1, 0, 0}, {0, 0, -1}, {0, 1, 0});
  to.right = face("right", {1, 0, 0}, {0, 0, 1}, {0, 1, 0});
  to.top = face("top", {0, 1, 0}, {1, 0, 0}, {0, 0, 1});
  to.bottom = face("bottom", {0, -1, 0}, {1, 0, 0}, {0, 0, -1});
}

void Builder::settings() {
  choose("pixel-position", "center");
  choose("rounding", "nearest");
  choose("mirror-default", "zero");
  choose("limit-attenuation", "false");
  choose("air-index", "1");
  choose("depth", std::to_string(world_.depth));
  if (std::any_of(world_.objects.begin(), world_.objects.end(),
                  [](const Ref<Node>& o) { return o->kind == Node::Kind::light && o->light.area; }))
    choose("light-samples", "4");
  if (painter_.conventions().mirrorHighlights) choose("highlight", "phong");
  const bool corrects = world_.gamma > 0 || world_.version >= 3.7;
  choose("transfer", corrects ? "srgb" : "linear");
  if (world_.gamma > 0 && world_.gamma != 1) choose("working-gamma", shortest(world_.gamma));
  if (world_.radiosity)
    leaveOut(SourcePlace{.file = scene_.file}, "radiosity",
             "--integrator path renders light between surfaces");
  if (world_.photons)
    leaveOut(SourcePlace{.file = scene_.file}, "photons",
             "--integrator photon or --caustics renders caustics");
  if (!isBlack(world_.ambientLight))
    scene_.lights.push_back({ambientLight(world_.ambientLight), SourcePlace{.file = scene_.file}});
  for (const FogNode& fog : world_.fogs) {
    if (&fog != &world_.fogs.front()) {
      leaveOut(fog.place, "a second fog");
      continue;
    }
    if (!(fog.distance > 0)) continue;
    Real density = 1 / fog.distance;
    if (fog.type == 2 && fog.height > 0) {  // as much of it above a place as POV-Ray has
      constexpr Real kMostRise = 3;
      density *= math::exp(std::clamp(fog.offset / fog.height, -kMostRise, kMostRise));
      choose("fog-height", shortest(fog.height));
    }
    choose("fog", shortest(density));
    const bool hasMedia = std::any_of(scene_.materials.begin(), scene_.materials.end(),
                                      [](const Material& m) { return m.mediumDensity > 0; });
    if (!hasMedia) choose("fog-samples", "0");
    choose("fog-color", shortest(std::clamp(fog.color.r, 0.0, 1.0)) + "," +
                            shortest(std::clamp(fog.color.g, 0.0, 1.0)) + "," +
                            shortest(std::clamp(fog.color.b, 0.0, 1.0)));
  }
}

}  // namespace

std::vector<Object> objectsOf(const Node& node) {
  Scene scene;
  World world;
  auto plain = std::make_shared<TextureNode>();
  plain->layers.emplace_back();
  world.defaultTexture = plain;
  WarningsByKind unheard;
  Builder(scene, world, unheard).build(node);
  return std::move(scene.objects);
}

void addTo(Scene& scene, const World& world, WarningsByKind& warnings) {
  Builder(scene, world, warnings).build();
}

}  // namespace trace::pov
