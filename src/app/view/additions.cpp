#include "app/view/additions.h"

#include <algorithm>
#include <cctype>
#include <exception>
#include <string>

#include "app/editing/placing.h"
#include "app/editing/texture_edits.h"
#include "app/view/examples.h"
#include "formats/format.h"
#include "geometry/mesh/mesh.h"
#include "geometry/mesh/tessellate.h"
#include "geometry/shapes/solids/csg_tree.h"
#include "image/maps/mipmap.h"
#include "scene/scene.h"
#include "shading/library.h"
#include "shading/optics/substances.h"

namespace trace {
namespace {

/// A wall, a floor, and a camera that looks at what is between -1 and 1.
constexpr std::string_view kStage = R"(SBT-raytracer 1.0
settings { depth = 6; transfer = srgb; fresnel = exact; auto-exposure = off; }
background { colors = ((0.75, 0.8, 0.88)); }
camera { position = (3.1, 2.5, 5.2); look_at = (0, -0.05, 0); fov = 31; aspectratio = 1; }
)";
constexpr std::string_view kSun = R"(ambient_light { color = (0.35, 0.36, 0.4); }
directional_light { direction = (-0.5, -1, -0.65); color = (0.75, 0.74, 0.7); }
)";
constexpr std::string_view kFloor =
    R"(translate(0, -1, 0, plane { material = { diffuse = checker { scale = (0.8, 0.8, 0.8); a = (0.62, 0.62, 0.6); b = (0.42, 0.43, 0.45); }; } })
)";
/// For mirrors and glass to show.
constexpr std::string_view kSky =
    "scale(40, 40, 40, sphere { material = { diffuse = (0, 0, 0); emissive = (0.6, 0.72, 0.9); casts_shadow "
    "= off; } })\n";
constexpr std::string_view kBall =
    R"(translate(0, -0.45, 0, scale(0.55, 0.55, 0.55, sphere { material = { diffuse = (0.7, 0.7, 0.7); } }))
)";

Scene sceneOf(const std::string& text) {
  Messages ignored;
  return readScene("preview.ray", text, ignored);
}

std::string_view helpOf(std::string_view material) {
  for (const Finish& finish : finishes())
    if (finish.name == material) return finish.looks;
  return "a transparent substance";
}

/// Something to be seen of a solid of solids that has no solids yet.
void fill(Shape& shape) {
  if (!shape.type().ofObjects) return;
  const Shape box = Shape(rowCalled<ShapeType>("cube")), ball = Shape(rowCalled<ShapeType>("sphere"));
  shape.setOperands(Operands(std::vector<Operand>{
      {"", box, {}, 0},
      {"", ball, Affine::translation({0.35, 0.35, 0.35}) * Affine::scaling(Vec3(0.5, 0.5, 0.5)), 0}}));
}

/// The shape, between -1 and 1.
Scene sceneOfShape(std::string_view name) {
  Scene scene = sceneOf(std::string(kStage) + std::string(kSun));
  Material clay;
  Phong matt;
  matt.diffuse = Color(0.85, 0.5, 0.25);
  matt.ambient = matt.diffuse;
  matt.specular = Color(0.2);
  clay.model = matt;
  scene.materials.push_back(clay);
  Shape shape(rowCalled<ShapeType>(name));
  fill(shape);
  constexpr Box3 kNear{{-1, -1, -1}, {1, 1, 1}};
  const Affine turn = upright(shape.type(), {0, 1, 0});
  const Box3 box = turn * drawnBounds(shape, kNear);
  const Real longest = maxComponent(box.size());
  const Affine placed = box.empty() || !(longest > 0) ? Affine()
                                                      : Affine::scaling(Vec3(1, 1, 1) * (2 / longest)) *
                                                            Affine::translation(-box.center()) * turn;
  scene.objects.push_back(
      {"", std::move(shape), placed, static_cast<std::uint32_t>(scene.materials.size() - 1), {}});
  return scene;
}

Scene sceneOfLight(std::string_view name) {
  Scene scene = sceneOf(std::string(kStage) + std::string(kFloor) + std::string(kBall));
  scene.background = {};
  constexpr Color kOfAmbient(0.6);  // the share of ambient light, so that this is seen, too
  for (Material& material : scene.materials)
    changeColors(material.model, {kAmbient}, [&](const Color&) { return kOfAmbient; });
  Light light(rowCalled<LightType>(name));
  const Vec3 place{-1.1, 1.5, 1.4};
  aimLight(light, place, {});
  scene.lights.push_back({light, {}});
  return scene;
}

Scene sceneOfMaterial(std::string_view name) {
  return sceneOf(std::string(kStage) + std::string(kSun) + std::string(kFloor) + std::string(kSky) +
                 "sphere { material = { library = \"" + std::string(name) + "\" } }\n");
}

/// A picture for those that need one: red across, green upward.
std::shared_ptr<const MipMap> testPicture() {
  constexpr int kSide = 16;
  Picture picture(kSide, kSide);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x)
      picture.at(x, y) =
          Color(x / (kSide - 1.0), 1 - y / (kSide - 1.0), 0.3) * ((x / 4 + y / 4) % 2 ? 1.0 : 0.5);
  return std::make_shared<const MipMap>(picture);
}

/// A ball of that texture.
Scene sceneOfTexture(std::string_view name) {
  Scene scene = sceneOf(std::string(kStage) + std::string(kSun) + std::string(kFloor) +
                        "sphere { material = { diffuse = (0.9, 0.9, 0.9); ambient = (0.9, 0.9, 0.9) } }\n");
  TextureNode node = *textureOfKind(name);
  editEachField(node.model, [&]<class Value>(const TextureField&, Value& value) {
    if constexpr (std::is_same_v<Value, Pixels>) value.map = testPicture();
  });
  setTexture(scene.materials[scene.objects.back().material].textures, "diffuse", std::move(node));
  return scene;
}

bool holds(std::string_view text, std::string_view word) {
  const auto small = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  return std::search(text.begin(), text.end(), word.begin(), word.end(),
                     [&](char a, char b) { return small(a) == small(b); }) != text.end();
}

}  // namespace

std::vector<Addition> additions(Addition::Kind kind) {
  std::vector<Addition> all;
  switch (kind) {
    case Addition::Kind::shape:
      for (const ShapeType& type : shapeTypes())
        if (type.keyword != Mesh::kKeyword) all.push_back({kind, type.keyword, type.help});
      break;
    case Addition::Kind::light:
      for (const LightType& type : lightTypes()) all.push_back({kind, type.keyword, type.help});
      break;
    case Addition::Kind::material:
      for (const std::string_view name : libraryNames()) all.push_back({kind, name, helpOf(name)});
      break;
    case Addition::Kind::texture:
      for (const TextureKind& texture : textureKindsToChoose())
        all.push_back({kind, texture.keyword, texture.help});
      break;
  }
  return all;
}

bool isAbout(const Addition& addition, std::string_view words) {
  while (!words.empty()) {
    const std::size_t space = words.find(' ');
    const std::string_view word = words.substr(0, space);
    if (!holds(addition.name, word) && !holds(addition.help, word)) return false;
    words.remove_prefix(space == std::string_view::npos ? words.size() : space + 1);
  }
  return true;
}

Bytes preview(const Addition& addition, int side) {
  try {
    switch (addition.kind) {
      case Addition::Kind::shape: return thumbnail(sceneOfShape(addition.name), side);
      case Addition::Kind::light: return thumbnail(sceneOfLight(addition.name), side);
      case Addition::Kind::material: return thumbnail(sceneOfMaterial(addition.name), side);
      case Addition::Kind::texture: return thumbnail(sceneOfTexture(addition.name), side);
    }
  } catch (const std::exception&) {  // a light whose file nobody has chosen yet
  }
  return {};
}

}  // namespace trace
