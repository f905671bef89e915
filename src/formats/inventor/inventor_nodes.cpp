// Source: Inventor's node reference, the specifications of VRML 1.0 and VRML97.
#include "formats/inventor/inventor_nodes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/field.h"
#include "base/text.h"
#include "math/vec.h"

namespace trace::inventor {
namespace {

enum class Takes {
  number,   ///< one
  whole,    ///< one without a fraction
  numbers,  ///< a list of any length
  pairs,    ///< lists of so many each
  triples,
  quadruples,
  matrices,
  vector,     ///< exactly three
  direction,  ///< not of length 0
  rotation,   ///< an axis, and an angle
  matrix,
  color,
  flag,
  word,      ///< one of a list, or several in brackets
  anything,  ///< texts, nodes, and what Trace does not use
};

enum class In : unsigned char { both, old, vrml2 };  // old: Inventor and VRML 1.0

struct Rule {
  std::string_view nodes;  ///< their types, between blanks
  std::string_view field;
  Takes takes = Takes::anything;
  double least = -kNoLimit, most = kNoLimit;  ///< least and most of each number
  std::string_view words{};                   ///< between blanks
  In in = In::both;
};

constexpr double kAboveNothing = 1e-300;  ///< the least of what must be above 0
constexpr std::string_view kFaces =
    " FaceSet IndexedFaceSet QuadMesh TriangleStripSet IndexedTriangleStripSet IndexedTriangleMesh ";
constexpr std::string_view kSurfaces = " IndexedFaceSet ElevationGrid Extrusion ";
constexpr std::string_view kLights = " PointLight DirectionalLight SpotLight ";
constexpr std::string_view kCameras = " PerspectiveCamera OrthographicCamera ";
constexpr std::string_view kKits = " SceneKit SeparatorKit ShapeKit WrapperKit ", kShapeKit = " ShapeKit ",
                           kLooks = " AppearanceKit ";
constexpr std::string_view kBindings =
    " DEFAULT OVERALL NONE PER_PART PER_PART_INDEXED PER_FACE PER_FACE_INDEXED PER_VERTEX "
    "PER_VERTEX_INDEXED ";

constexpr std::array kRules{
    // shapes
    Rule{" Sphere Cylinder ", "radius", Takes::number, kAboveNothing},
    Rule{" Cone Cylinder ", "height", Takes::number, kAboveNothing},
    Rule{" Cone ", "bottomRadius", Takes::number, kAboveNothing},
    Rule{" Cone Cylinder ", "parts", Takes::word, 0, 0, " SIDES TOP BOTTOM ALL ", In::old},
    Rule{" Cone Cylinder ", "side", Takes::flag, 0, 0, {}, In::vrml2},
    Rule{" Cone Cylinder ", "bottom", Takes::flag, 0, 0, {}, In::vrml2},
    Rule{" Cylinder ", "top", Takes::flag, 0, 0, {}, In::vrml2},
    Rule{" Cube ", "width", Takes::number, kAboveNothing},
    Rule{" Cube ", "height", Takes::number, kAboveNothing},
    Rule{" Cube ", "depth", Takes::number, kAboveNothing},
    Rule{" Box ", "size", Takes::vector, kAboveNothing},
    Rule{kFaces, "coordIndex", Takes::numbers, -1},
    Rule{kFaces, "materialIndex", Takes::numbers, -1, kNoLimit, {}, In::old},
    Rule{kFaces, "normalIndex", Takes::numbers, -1},
    Rule{kFaces, "textureCoordIndex", Takes::numbers, -1, kNoLimit, {}, In::old},
    Rule{kFaces, "texCoordIndex", Takes::numbers, -1, kNoLimit, {}, In::vrml2},
    Rule{kFaces, "colorIndex", Takes::numbers, -1, kNoLimit, {}, In::vrml2},
    Rule{kFaces, "vertexProperty", Takes::anything, 0, 0, {}, In::old},
    Rule{kFaces, "startIndex", Takes::whole, 0, kNoLimit, {}, In::old},
    Rule{" FaceSet TriangleStripSet ", "numVertices", Takes::numbers, -1},
    Rule{" QuadMesh ", "verticesPerRow", Takes::whole, 2},
    Rule{" QuadMesh ", "verticesPerColumn", Takes::whole, 2},
    Rule{kSurfaces, "coord"},
    Rule{kSurfaces, "color"},
    Rule{kSurfaces, "normal"},
    Rule{kSurfaces, "texCoord"},
    Rule{kSurfaces, "attrib"},
    Rule{kSurfaces, "ccw", Takes::flag},
    Rule{kSurfaces, "solid", Takes::flag},
    Rule{kSurfaces, "convex", Takes::flag},
    Rule{kSurfaces, "colorPerVertex", Takes::flag},
    Rule{kSurfaces, "normalPerVertex", Takes::flag},
    Rule{" IndexedFaceSet ElevationGrid Extrusion ShapeHints ", "creaseAngle", Takes::number, 0},
    Rule{" ElevationGrid ", "xDimension", Takes::whole, 2},
    Rule{" ElevationGrid ", "zDimension", Takes::whole, 2},
    Rule{" ElevationGrid ", "xSpacing", Takes::number, kAboveNothing},
    Rule{" ElevationGrid ", "zSpacing", Takes::number, kAboveNothing},
    Rule{" ElevationGrid ", "height", Takes::numbers},
    Rule{" Extrusion ", "crossSection", Takes::pairs},
    Rule{" Extrusion ", "spine", Takes::triples},
    Rule{" Extrusion ", "scale", Takes::pairs, 0},
    Rule{" Extrusion ", "orientation", Takes::quadruples},
    Rule{" Extrusion ", "beginCap", Takes::flag},
    Rule{" Extrusion ", "endCap", Takes::flag},
    Rule{" Shape ", "appearance"},
    Rule{" Shape ", "geometry"},
    Rule{" Shape ", "bboxCenter"},
    Rule{" Shape ", "bboxSize"},
    Rule{" Appearance ", "material"},
    Rule{" Appearance ", "texture"},
    Rule{" Appearance ", "textureTransform"},
    // kits, whose parts are nodes
    Rule{" SceneKit SeparatorKit ShapeKit WrapperKit AppearanceKit CameraKit LightKit ", "callbackList"},
    Rule{kKits, "pickStyle"},
    Rule{kKits, "appearance"},
    Rule{kKits, "units"},
    Rule{kKits, "texture2Transform"},
    Rule{kKits, "childList"},
    Rule{" SceneKit SeparatorKit ShapeKit WrapperKit CameraKit LightKit ", "transform"},
    Rule{" SceneKit ", "cameraList"},
    Rule{" SceneKit ", "cameraNumber"},
    Rule{" SceneKit ", "lightList"},
    Rule{" CameraKit ", "camera"},
    Rule{" LightKit ", "light"},
    Rule{" LightKit ", "icon"},
    Rule{kLooks, "lightModel"},
    Rule{kLooks, "environment"},
    Rule{kLooks, "drawStyle"},
    Rule{kLooks, "material"},
    Rule{kLooks, "complexity"},
    Rule{kLooks, "texture2"},
    Rule{kLooks, "font"},
    Rule{kShapeKit, "materialBinding"},
    Rule{kShapeKit, "normalBinding"},
    Rule{kShapeKit, "textureCoordinateBinding"},
    Rule{kShapeKit, "shapeHints"},
    Rule{kShapeKit, "coordinate3"},
    Rule{kShapeKit, "coordinate4"},
    Rule{kShapeKit, "normal"},
    Rule{kShapeKit, "textureCoordinate2"},
    Rule{kShapeKit, "textureCoordinateFunction"},
    Rule{kShapeKit, "profileCoordinate2"},
    Rule{kShapeKit, "profileCoordinate3"},
    Rule{kShapeKit, "profileList"},
    Rule{kShapeKit, "shape"},
    Rule{" ShapeKit WrapperKit ", "localTransform"},
    Rule{" WrapperKit ", "contents"},
    Rule{" NodeKitListPart ", "containerTypeName"},
    Rule{" NodeKitListPart ", "childTypeNames"},
    Rule{" NodeKitListPart ", "containerNode"},
    // transforms
    Rule{" Transform ", "translation", Takes::vector},
    Rule{" Transform ", "rotation", Takes::rotation},
    Rule{" Transform ", "scaleFactor", Takes::vector, -kNoLimit, kNoLimit, {}, In::old},
    Rule{" Transform ", "scale", Takes::vector, -kNoLimit, kNoLimit, {}, In::vrml2},
    Rule{" Transform ", "scaleOrientation", Takes::rotation},
    Rule{" Transform ", "center", Takes::vector},
    Rule{" Transform ", "children", Takes::anything, 0, 0, {}, In::vrml2},
    Rule{" Transform ", "addChildren", Takes::anything, 0, 0, {}, In::vrml2},
    Rule{" Transform ", "removeChildren", Takes::anything, 0, 0, {}, In::vrml2},
    Rule{" Transform ", "bboxCenter", Takes::anything, 0, 0, {}, In::vrml2},
    Rule{" Transform ", "bboxSize", Takes::anything, 0, 0, {}, In::vrml2},
    Rule{" Translation ", "translation", Takes::vector},
    Rule{" Rotation ", "rotation", Takes::rotation},
    Rule{" RotationXYZ ", "axis", Takes::word, 0, 0, " X Y Z "},
    Rule{" RotationXYZ ", "angle", Takes::number},
    Rule{" Scale ", "scaleFactor", Takes::vector},
    Rule{" MatrixTransform ", "matrix", Takes::matrix},
    Rule{" MultipleCopy ", "matrix", Takes::matrices},
    Rule{" Units ", "units", Takes::word, 0, 0,
         " METERS CENTIMETERS MILLIMETERS MICROMETERS MICRONS NANOMETERS ANGSTROMS KILOMETERS FEET INCHES "
         "POINTS YARDS MILES NAUTICAL_MILES "},
    Rule{" Array ", "numElements1", Takes::whole, 1, 10000},
    Rule{" Array ", "numElements2", Takes::whole, 1, 10000},
    Rule{" Array ", "numElements3", Takes::whole, 1, 10000},
    Rule{" Array ", "separation1", Takes::vector},
    Rule{" Array ", "separation2", Takes::vector},
    Rule{" Array ", "separation3", Takes::vector},
    Rule{" Array ", "origin", Takes::word, 0, 0, " FIRST CENTER LAST "},
    // looks
    Rule{" Material ", "ambientColor", Takes::color, 0, 1, {}, In::old},
    Rule{" Material ", "ambientIntensity", Takes::number, 0, 1, {}, In::vrml2},
    Rule{" Material ", "diffuseColor", Takes::color, 0, 1},
    Rule{" Material ", "specularColor", Takes::color, 0, 1},
    Rule{" Material ", "emissiveColor", Takes::color, 0, 1},
    Rule{" Material ", "shininess", Takes::numbers, 0, 1},
    Rule{" Material ", "transparency", Takes::numbers, 0, 1},
    Rule{" Material ", "mirror", Takes::numbers, 0, 1},
    Rule{" BaseColor ", "rgb", Takes::color, 0, 1},
    Rule{" PackedColor ", "orderedRGBA", Takes::numbers, 0},
    Rule{" PackedColor ", "rgba", Takes::numbers, 0},
    Rule{" MaterialBinding NormalBinding TextureCoordinateBinding ", "value", Takes::word, 0, 0, kBindings},
    Rule{" LightModel ", "model", Takes::word, 0, 0, " PHONG BASE_COLOR "},
    Rule{" ShapeHints ", "vertexOrdering", Takes::word, 0, 0,
         " UNKNOWN_ORDERING CLOCKWISE COUNTERCLOCKWISE "},
    Rule{" ShapeHints ", "shapeType", Takes::word, 0, 0, " UNKNOWN_SHAPE_TYPE SOLID "},
    Rule{" ShapeHints ", "faceType", Takes::word, 0, 0, " UNKNOWN_FACE_TYPE CONVEX "},
    Rule{" ShapeHints ", "hints"},
    Rule{" ShapeHints ", "windingType"},
    Rule{" ShapeHints ", "useVBO"},
    Rule{" Coordinate3 Coordinate ", "point", Takes::triples},
    Rule{" Normal ", "vector", Takes::triples},
    Rule{" TextureCoordinate2 TextureCoordinate ", "point", Takes::pairs},
    Rule{" Color ", "color", Takes::color, 0, 1},
    Rule{" VertexProperty ", "vertex", Takes::triples},
    Rule{" VertexProperty ", "normal", Takes::triples},
    Rule{" VertexProperty ", "texCoord", Takes::pairs},
    Rule{" VertexProperty ", "orderedRGBA", Takes::numbers, 0},
    Rule{" VertexProperty ", "materialBinding", Takes::word, 0, 0, kBindings},
    Rule{" VertexProperty ", "normalBinding", Takes::word, 0, 0, kBindings},
    Rule{" VertexProperty ", "textureUnit"},
    // lights
    Rule{kLights, "on", Takes::flag},
    Rule{kLights, "intensity", Takes::number, 0},
    Rule{kLights, "color", Takes::color, 0, 1},
    Rule{kLights, "ambientIntensity", Takes::number, 0, 1, {}, In::vrml2},
    Rule{" PointLight SpotLight ", "location", Takes::vector},
    Rule{" DirectionalLight SpotLight ", "direction", Takes::direction},
    Rule{" PointLight SpotLight ", "attenuation", Takes::vector, 0, kNoLimit, {}, In::vrml2},
    Rule{" PointLight SpotLight ", "radius", Takes::number, 0, kNoLimit, {}, In::vrml2},
    Rule{" SpotLight ", "dropOffRate", Takes::number, 0, 1, {}, In::old},
    Rule{" SpotLight ", "cutOffAngle", Takes::number, 0, kPi},
    Rule{" SpotLight ", "beamWidth", Takes::number, 0, kPi, {}, In::vrml2},
    Rule{" Environment ", "ambientIntensity", Takes::number, 0, 1},
    Rule{" Environment ", "ambientColor", Takes::color, 0, 1},
    Rule{" Environment ", "attenuation", Takes::vector, 0},
    Rule{" Environment ", "fogType"},
    Rule{" Environment ", "fogColor"},
    Rule{" Environment ", "fogVisibility"},
    // cameras
    Rule{kCameras, "position", Takes::vector},
    Rule{kCameras, "orientation", Takes::rotation},
    Rule{kCameras, "aspectRatio", Takes::number, 0.01, 100},
    Rule{kCameras, "viewportMapping"},
    Rule{kCameras, "nearDistance"},
    Rule{kCameras, "farDistance"},
    Rule{kCameras, "focalDistance"},
    Rule{" PerspectiveCamera ", "heightAngle", Takes::number, kAboveNothing, kPi},
    Rule{" OrthographicCamera ", "height", Takes::number, kAboveNothing},
    Rule{" Viewpoint ", "position", Takes::vector},
    Rule{" Viewpoint ", "orientation", Takes::rotation},
    Rule{" Viewpoint ", "fieldOfView", Takes::number, kAboveNothing, kPi},
    Rule{" Viewpoint ", "jump"},
    Rule{" Viewpoint ", "centerOfRotation"},
    Rule{" Viewpoint ", "description"},
    Rule{" Background ", "skyColor", Takes::color, 0, 1},
    Rule{" Background ", "skyAngle", Takes::numbers, 0, kPi},
    Rule{" Background ", "groundColor", Takes::color, 0, 1},
    Rule{" Background ", "groundAngle", Takes::numbers, 0, kPi},
    Rule{" Background ", "backUrl"},
    Rule{" Background ", "bottomUrl"},
    Rule{" Background ", "frontUrl"},
    Rule{" Background ", "leftUrl"},
    Rule{" Background ", "rightUrl"},
    Rule{" Background ", "topUrl"},
};

bool holds(std::string_view list, std::string_view word) {
  for (std::size_t at = list.find(word); at != list.npos; at = list.find(word, at + 1))
    if (at > 0 && list[at - 1] == ' ' && list[at + word.size()] == ' ') return true;
  return false;
}

/// The rules of each type of node.
const std::vector<const Rule*>& rulesOf(std::string_view type) {
  static const auto kByType = [] {
    std::unordered_map<std::string_view, std::vector<const Rule*>> all;
    for (const Rule& rule : kRules) {
      std::string_view rest = rule.nodes.substr(1);
      for (; !rest.empty(); rest.remove_prefix(rest.find(' ') + 1))
        all[rest.substr(0, rest.find(' '))].push_back(&rule);
    }
    return all;
  }();
  static const std::vector<const Rule*> kNone;
  const auto found = kByType.find(type);
  return found == kByType.end() ? kNone : found->second;
}

/// How many numbers one value has, and whether a list of several is allowed.
std::pair<std::size_t, bool> arity(Takes takes) {
  switch (takes) {
    case Takes::number:
    case Takes::whole: return {1, false};
    case Takes::numbers: return {1, true};
    case Takes::pairs: return {2, true};
    case Takes::vector:
    case Takes::direction: return {3, false};
    case Takes::color:
    case Takes::triples: return {3, true};
    case Takes::rotation: return {4, false};
    case Takes::quadruples: return {4, true};
    case Takes::matrix: return {16, false};
    case Takes::matrices: return {16, true};
    default: return {0, false};
  }
}

std::string quoted(std::string_view word) { return "\"" + std::string(word.substr(0, 40)) + "\""; }

class FieldCheck {
 public:
  FieldCheck(const Rule& rule, const Field& given, const Field& value, std::string_view type,
             const Complain& complain)
      : rule_(rule), given_(given), value_(value), type_(type), complain_(complain) {}

  void check() const {
    if (rule_.takes == Takes::anything || isEmpty()) return;
    if (rule_.takes == Takes::flag) return words(" TRUE FALSE true false 0 1 ", "TRUE or FALSE");
    if (rule_.takes == Takes::word) return words(rule_.words, listed());
    if (!value_.words.empty()) return wrong(expectedNumbers(), quoted(value_.words[0]));
    numbers();
  }

 private:
  /// Only named, as in `value ~`, or moved by an engine: its default holds.
  bool isEmpty() const { return value_.numbers.empty() && value_.words.empty(); }

  void wrong(const std::string& expected, const std::string& found) const {
    complain_(given_.token,
              std::string(rule_.field) + " of " + std::string(type_) + ": expected " + expected + ", found " +
                  found,
              {}, "wrong " + std::string(type_) + "." + std::string(rule_.field));
  }

  std::string listed() const {
    std::string list;
    std::string_view rest = rule_.words.substr(1);
    for (; !rest.empty(); rest.remove_prefix(rest.find(' ') + 1))
      list += (list.empty() ? "" : ", ") + std::string(rest.substr(0, rest.find(' ')));
    return list;
  }
  void words(std::string_view allowed, const std::string& expected) const {
    for (std::string_view word : value_.words)
      if (word.empty() || !holds(allowed, word)) return wrong(expected, quoted(word));
    for (double n : value_.numbers)
      if (!holds(allowed, toText(n))) return wrong(expected, toText(n));
  }

  std::string expectedNumbers() const {
    const auto [count, several] = arity(rule_.takes);
    if (count == 1) return several ? "numbers" : "a number";
    return (several ? "lists of " : "") + std::to_string(count) + " numbers";
  }
  void numbers() const {
    const auto [count, several] = arity(rule_.takes);
    const std::vector<double>& n = value_.numbers;
    if (several ? n.size() % count != 0 : n.size() != count)
      return wrong(expectedNumbers(), std::to_string(n.size()));
    if (rule_.takes == Takes::whole && n[0] != std::floor(n[0])) return wrong("a whole number", toText(n[0]));
    if (rule_.takes == Takes::direction && n[0] == 0 && n[1] == 0 && n[2] == 0)
      return wrong("a direction", "0 0 0");
    if (rule_.takes == Takes::rotation && n[0] == 0 && n[1] == 0 && n[2] == 0 && n[3] != 0)
      return wrong("an axis and an angle", "an axis of length 0");
    for (double x : n)
      if (!(x >= rule_.least && x <= rule_.most)) return wrong(range(), toText(x));
  }
  std::string range() const {
    if (rule_.least == kAboveNothing)
      return rule_.most == kNoLimit ? "a number above 0" : "above 0 and at most " + toText(rule_.most);
    return rule_.most == kNoLimit ? "at least " + toText(rule_.least)
                                  : toText(rule_.least) + " to " + toText(rule_.most);
  }

  const Rule& rule_;
  const Field& given_;
  const Field& value_;
  std::string_view type_;
  const Complain& complain_;
};

}  // namespace

void checkFields(const Values& values, bool vrml2, const Complain& complain) {
  const Node& node = values.node();
  const std::vector<const Rule*>& rules = rulesOf(node.type);
  if (rules.empty()) return;
  const auto given = [&](std::string_view name) {
    return std::any_of(node.fields.begin(), node.fields.end(),
                       [&](const Field& f) { return f.name == name; });
  };
  const bool declares = given("fields") || given("isA");  // a node of another program, with fields of its own
  for (const Field& field : node.fields) {
    const auto rule =
        std::find_if(rules.begin(), rules.end(), [&](const Rule* r) { return r->field == field.name; });
    const bool other = rule != rules.end() && (*rule)->in != In::both && ((*rule)->in == In::vrml2) != vrml2;
    if (rule != rules.end() && !other) {
      if (const Field* value = values.field(field.name))
        FieldCheck(**rule, field, *value, node.type, complain).check();
      continue;
    }
    if (declares || field.name == "metadata") continue;
    std::vector<std::string_view> names;
    for (const Rule* r : rules)
      if (r->in == In::both || (r->in == In::vrml2) == vrml2) names.push_back(r->field);
    complain(
        field.token, "unknown field " + quoted(field.name) + " of " + std::string(node.type) + " is ignored",
        didYouMean(field.name, names), "unknown " + std::string(node.type) + "." + std::string(field.name));
  }
}

}  // namespace trace::inventor
