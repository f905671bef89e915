// The parts of a POV-Ray scene as the file gives them: objects, textures, cameras. They are constant once
// they are read, so that names share them. pov_scene.h makes a Scene of them.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "formats/pov/pov_values.h"
#include "geometry/mesh/mesh.h"
#include "math/color.h"
#include "shading/pixels.h"
#include "shading/textures/solid.h"

namespace trace::pov {

/// Omissions that are reported where something is used, with the place that says it.
using Omissions = std::vector<std::pair<std::string, SourcePlace>>;

/// A picture that a pattern or a height field names.
struct ImageNode {
  std::string file;
  std::shared_ptr<const InsideFile> inside{};  ///< the bytes of one that is not beside the scene
  int mapType = 0;
  bool once = false;
  Real filterAll = 0, transmitAll = 0, bump = 1;
};

/// The number that a map or list of colours goes along.
struct PatternNode {
  std::string kind;  ///< "bozo", "gradient", "checker", ...
  Vec3 vector{};     ///< the direction of a gradient, the size of a brick, the form of a crackle
  Real number = 0;   ///< turbulence of an agate, arms of a spiral, mortar of a brick
  Vec3 turbulence{};
  Vec3 repeat{};
  int octaves = 6;
  Real omega = 0.5, lambda = 2;
  Real frequency = 1, phase = 0;
  std::string wave;  ///< "" where the pattern has its own
  Real exponent = 1;
  ImageNode image;
  Ref<Formula> formula;
  Ref<PigmentNode> pigment;
  SourcePlace place{};
};

template <class T>
using Entries = std::vector<std::pair<Real, Ref<T>>>;

struct PigmentNode {
  Numbers color = Numbers().promoted(5);
  std::optional<PatternNode> pattern;
  Entries<PigmentNode> entries;  ///< entries of a map, or of a list in its order
  Affine at;                     ///< outside from inside
  bool uv = false;
  SourcePlace place;
  Omissions left;
};

struct NormalNode {
  std::optional<PatternNode> pattern;
  Real amount = 0.5;
  Affine at;
  SourcePlace place;
  Omissions left;
};

struct FinishNode {
  Color ambient{0.1}, emission{};
  Real diffuse = 0.6, brilliance = 1, phong = 0, phongSize = 40, specular = 0, roughness = 0.05, metallic = 0;
  Color reflectionLeast{}, reflectionMost{};
  Real falloff = 1;  ///< how close to grazing angles a reflection grows
  bool fresnel = false, reflectsMetal = false, conservesEnergy = false;
  Omissions left;
};

struct TextureNode {
  struct Layer {
    Ref<PigmentNode> pigment;
    Ref<NormalNode> normal;
    Ref<FinishNode> finish;
    std::optional<PatternNode> pattern;  ///< pattern of a texture map
    Entries<TextureNode> entries;
    Affine at;
  };
  std::vector<Layer> layers;  ///< the undermost first
};

struct MediaNode {
  Color emission{}, absorption{}, scattering{};
  Real eccentricity = 0;
  Ref<PigmentNode> density;
  Affine at;
  SourcePlace place{};
};

struct InteriorNode {
  Real ior = 1, fadeDistance = 0, fadePower = 0;
  Color fadeColor{};
  std::vector<MediaNode> media;
  Omissions left;
};

struct MaterialNode {
  Ref<TextureNode> texture;
  Ref<InteriorNode> interior;
};

struct LightNode {
  Vec3 position{}, pointAt{};
  Color color{1};
  enum class Kind { point, spot, cylinder } kind = Kind::point;
  bool parallel = false, shadowless = false;
  Real radius = 30, falloff = 45, tightness = 0, fadeDistance = 0, fadePower = 0;
  bool area = false;
  Vec3 axis1{}, axis2{};
  int across = 1, along = 1;
};

/// An object.
struct Node {
  enum class Kind { nothing, shape, light, unite, merge, intersect, subtract };

  Kind kind = Kind::nothing;
  SourcePlace place;
  std::string name;
  std::optional<Shape> shape;
  Affine shapeAt;                ///< object from Trace's shape
  std::vector<Ref<Node>> parts;  ///< operands, or the light's looks
  std::vector<Ref<Node>> clips;  ///< in the space of the object
  bool clippedByBound = false;
  LightNode light;
  std::vector<Ref<TextureNode>> meshTextures;  ///< MeshData::materials are indices into these
  Affine at;                                   ///< outside from object
  Ref<TextureNode> texture;                    ///< null: the one around it, or the default
  Affine textureAt;                            ///< object from texture
  Ref<InteriorNode> interior;
  bool inverse = false, uv = false, noShadow = false;
};

struct CameraNode {
  std::string kind = "perspective";
  Vec3 location{}, direction{0, 0, 1}, right{4.0 / 3, 0, 0}, up{0, 1, 0}, sky{0, 1, 0};
  std::optional<Vec3> lookAt;
  Real angle = 0, aperture = 0;
  std::optional<Vec3> focalPoint;
  SourcePlace place;
};

struct FogNode {
  Real distance = 0;
  Color color{};
  int type = 1;
  Real offset = 0, height = 0;
  bool moved = false;
  SourcePlace place;
};

struct SkyNode {
  std::vector<Ref<PigmentNode>> pigments;
  Affine at;
  SourcePlace place;
};

/// A color_map, pigment_map, texture_map ...
struct MapNode {
  std::string kind;
  Entries<PigmentNode> pigments;
  Entries<TextureNode> textures;
  Entries<NormalNode> normals;
};

}  // namespace trace::pov
