// The meaning of Inventor and VRML nodes, as a Scene: a walk through the nodes with the state that Inventor's
// property nodes set for what follows them. VRML97's nodes set the same state for the one shape they are of.
//
// Source: the specifications of VRML 1.0 and VRML97 and Inventor's node reference (docs/formats.md). Lights
// shine on everything, not only on what follows them. One long file, for it is one walk over one state; what
// does not need the state stands beside it.
#include "formats/inventor_format.h"

#include <array>
#include <cmath>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "base/file.h"
#include "base/nesting.h"
#include "base/text.h"
#include "formats/directions.h"
#include "formats/format.h"
#include "formats/inventor_binding.h"
#include "formats/inventor_nodes.h"
#include "formats/inventor_shapes.h"
#include "formats/inventor_state.h"
#include "formats/inventor_transform.h"
#include "formats/model.h"
#include "formats/textures.h"
#include "geometry/cone.h"
#include "geometry/cube.h"
#include "geometry/mesh.h"
#include "geometry/sphere.h"

namespace trace {
namespace inventor {
namespace {

using Version = Document::Version;
using By = Binding::By;

/// Nodes that say nothing a picture needs.
const std::set<std::string_view> kIgnored{"Info",
                                          "WorldInfo",
                                          "NavigationInfo",
                                          "Complexity",
                                          "Sound",
                                          "AudioClip",
                                          "Script",
                                          "Event",
                                          "Label",
                                          "TimeSensor",
                                          "TouchSensor",
                                          "ProximitySensor",
                                          "VisibilitySensor",
                                          "PlaneSensor",
                                          "SphereSensor",
                                          "CylinderSensor",
                                          "ColorInterpolator",
                                          "CoordinateInterpolator",
                                          "NormalInterpolator",
                                          "OrientationInterpolator",
                                          "PositionInterpolator",
                                          "ScalarInterpolator",
                                          "PickStyle",
                                          "FontStyle",
                                          "Font",
                                          "TextureCoordinateBinding",
                                          "Texture2Transform",
                                          "TextureTransform",
                                          "Callback",
                                          "EventCallback",
                                          "ColorIndex",
                                          "LinearProfile",
                                          "ProfileCoordinate2",
                                          "Metadata",
                                          "MetadataSet",
                                          "MetadataString",
                                          "KeySensor"};

/// Nodes of the specifications that are not rendered: no misspellings.
const std::set<std::string_view> kNotRendered{"Text",
                                              "Text2",
                                              "Text3",
                                              "AsciiText",
                                              "Fog",
                                              "PointSet",
                                              "LineSet",
                                              "MarkerSet",
                                              "IndexedPointSet",
                                              "IndexedLineSet",
                                              "IndexedMarkerSet",
                                              "NurbsCurve",
                                              "NurbsSurface",
                                              "IndexedNurbsCurve",
                                              "IndexedNurbsSurface",
                                              "NurbsProfile",
                                              "TextureCoordinatePlane",
                                              "TextureCoordinateEnvironment",
                                              "TextureCoordinateDefault",
                                              "TextureCoordinateFunction",
                                              "SurroundScale",
                                              "AntiSquish",
                                              "Blinker",
                                              "Pendulum",
                                              "Rotor",
                                              "Shuttle",
                                              "PathSwitch",
                                              "ClipPlane",
                                              "TransformManip",
                                              "Coordinate4",
                                              "Texture3"};

/// Nodes that only stand in the fields of others.
const std::set<std::string_view> kParts{"Appearance",   "Coordinate",   "Color",        "TextureCoordinate",
                                        "ImageTexture", "PixelTexture", "MovieTexture", "MultiTexture"};

/// What other files bring into a scene, by path: each is read once however often it is named. Nothing while
/// it is read, or if it cannot be.
using Library = std::map<std::string, std::optional<Scene>>;

/// A light that stands in another file, where that file stands.
Light moved(Light light, const Affine& worldFromFile) {
  std::visit(
      [&](auto& l) {
        if constexpr (requires { l.position; }) l.position = worldFromFile * l.position;
        if constexpr (requires { l.direction; }) l.direction = linear(worldFromFile, l.direction);
      },
      light);
  return light;
}

class Reader {
 public:
  Reader(const Document& document, Messages& messages, Library& library, int nesting = 0)
      : document_(document),
        messages_(messages),
        library_(library),
        nesting_(nesting),
        vrml2_(document.version() == Version::vrml2) {
    scene_.file = document.file(), scene_.format = "inventor";
  }

  /// The file as a scene, with what it lacks.
  Scene read() {
    walk();
    finish();
    return std::move(scene_);
  }
  /// Only what the file itself holds.
  Scene readPart() {
    walk();
    textures_.report(messages_);
    return std::move(scene_);
  }

 private:
  // --- the walk ---

  void walk() {
    State state;
    auto paint = std::make_shared<Paint>();
    paint->unlit = vrml2_;  // a shape without a material is white, whatever the light
    if (vrml2_) paint->diffuse = {Color(1)};
    state.paint = paint;
    state.creaseAngle = document_.oldCrease() ? 0.5 : 0;
    state.points = state.normals = std::make_shared<const std::vector<Vec3>>();
    state.uvs = std::make_shared<const std::vector<Vec2>>();
    for (const Node* node : document_.roots()) visit({node, nullptr}, state);
  }

  void visit(NodeIn at, State& state) {
    spend(1, *at.node);
    if (depth_ >= kMostNesting)
      return warn(*at.node, "nodes that are nested this deep are left out", "depth");
    ++depth_;
    if (at.node->proto)
      proto(at, state);
    else
      node(Values(*at.node, at.env), state);
    --depth_;
  }

  /// Nodes that are used again and again could make a small file endless work.
  void spend(std::size_t work, const Node& node) {
    constexpr std::size_t kAnyFile = 20000, kTimes = 20;
    spent_ += work;
    if (spent_ > kAnyFile + kTimes * document_.nodeCount())
      throw Error(Fault::limit, document_.place(node.token),
                  "expected less work for a file of this size: its nodes are used again too often");
  }

  /// Only the first node of a PROTO is to be seen; the others are there for routes.
  void proto(NodeIn at, State& state) {
    if (at.node->proto->nodes.empty()) return;
    visit({at.node->proto->nodes.front(), envOf(at)}, state);
  }
  const Env* envOf(NodeIn at) { return &envs_.emplace_back(Env{at.node, at.env}); }

  /// The node behind an instance of a PROTO.
  NodeIn resolved(NodeIn at) {
    for (int i = 0; i < 100 && at.node && at.node->proto; ++i) {
      if (at.node->proto->nodes.empty()) return {};
      at = {at.node->proto->nodes.front(), envOf(at)};
    }
    if (at.node) check(Values(*at.node, at.env));
    return at;
  }
  /// Warns once of what is wrong in the fields of a node.
  void check(const Values& v) {
    if (!checked_.insert(&v.node()).second) return;
    checkFields(v, vrml2_, [&](const Token& at, std::string what, std::string hint, std::string kind) {
      warn(at, std::move(what), kind, std::move(hint));
    });
  }
  /// The first node of a field, or nothing.
  NodeIn nodeOf(const Values& v, std::string_view field) {
    const std::vector<NodeIn> nodes = v.nodes(field);
    const NodeIn found = nodes.empty() ? NodeIn{} : resolved(nodes.front());
    if (found.node && field != "geometry") warnUnknownPart(*found.node);  // of that it is said when visited
    return found;
  }
  /// It is taken for what the field needs.
  void warnUnknownPart(const Node& node) {
    const std::string_view type = node.type;
    if (handlers().contains(type) || kIgnored.count(type) || kNotRendered.count(type) || kParts.count(type))
      return;
    warn(node.token, "\"" + std::string(type.substr(0, 40)) + "\" is not known", type, meant(type));
  }

  void children(const Values& v, State& state) {
    for (const Node* child : v.node().children) visit({child, v.env()}, state);
    for (const NodeIn& child : v.nodes("children")) visit(child, state);
  }
  void separate(const Values& v, const State& state) {
    State own = state;
    children(v, own);
  }

  using Handler = void (Reader::*)(const Values&, State&);
  static const std::unordered_map<std::string_view, Handler>& handlers() {
    static const std::unordered_map<std::string_view, Handler> kTable{
        {"Separator", &Reader::separator},
        {"Group", &Reader::group},
        {"Switch", &Reader::switchNode},
        {"LOD", &Reader::firstChild},
        {"LevelOfDetail", &Reader::firstChild},
        {"TransformSeparator", &Reader::transformSeparator},
        {"Anchor", &Reader::separator},
        {"Selection", &Reader::separator},
        {"WWWAnchor", &Reader::separator},
        {"Collision", &Reader::separator},
        {"Billboard", &Reader::separator},
        {"Annotation", &Reader::separator},
        {"StaticGroup", &Reader::separator},
        {"Array", &Reader::array},
        {"MultipleCopy", &Reader::multipleCopy},
        {"File", &Reader::include},
        {"Inline", &Reader::include},
        {"WWWInline", &Reader::include},
        {"Transform", &Reader::transform},
        {"Translation", &Reader::translation},
        {"Rotation", &Reader::rotation},
        {"RotationXYZ", &Reader::rotationXyz},
        {"Scale", &Reader::scale},
        {"MatrixTransform", &Reader::matrix},
        {"ResetTransform", &Reader::resetTransform},
        {"Units", &Reader::units},
        {"Material", &Reader::material},
        {"BaseColor", &Reader::baseColor},
        {"PackedColor", &Reader::packedColor},
        {"MaterialBinding", &Reader::materialBinding},
        {"NormalBinding", &Reader::normalBinding},
        {"LightModel", &Reader::lightModel},
        {"ShapeHints", &Reader::shapeHints},
        {"Coordinate3", &Reader::coordinates},
        {"Normal", &Reader::normals},
        {"TextureCoordinate2", &Reader::textureCoordinates},
        {"Texture2", &Reader::texture},
        {"DrawStyle", &Reader::drawStyle},
        {"VertexProperty", &Reader::vertexProperty},
        {"Environment", &Reader::environment},
        {"PointLight", &Reader::pointLight},
        {"DirectionalLight", &Reader::directionalLight},
        {"SpotLight", &Reader::spotLight},
        {"PerspectiveCamera", &Reader::perspectiveCamera},
        {"OrthographicCamera", &Reader::orthographicCamera},
        {"Viewpoint", &Reader::viewpoint},
        {"Background", &Reader::background},
        {"Shape", &Reader::shape},
        {"Cube", &Reader::box},
        {"Box", &Reader::box},
        {"Sphere", &Reader::sphere},
        {"Cone", &Reader::cone},
        {"Cylinder", &Reader::cylinder},
        {"FaceSet", &Reader::faceSet},
        {"IndexedFaceSet", &Reader::faceSet},
        {"QuadMesh", &Reader::faceSet},
        {"TriangleStripSet", &Reader::faceSet},
        {"IndexedTriangleStripSet", &Reader::faceSet},
        {"IndexedTriangleMesh", &Reader::faceSet},
        {"ElevationGrid", &Reader::elevationGridNode},
        {"Extrusion", &Reader::extrusionNode}};
    return kTable;
  }

  void node(const Values& v, State& state) {
    check(v);
    const auto handler = handlers().find(v.node().type);
    if (handler != handlers().end()) return (this->*handler->second)(v, state);
    if (kIgnored.count(v.node().type)) return;
    warn(v.node().token,
         "\"" + std::string(v.node().type.substr(0, 40)) + "\" is not rendered and is left out",
         v.node().type, meant(v.node().type));
    separate(v, state);  // perhaps it holds shapes
  }

  /// A type that the reader knows and the word may be a misspelling of.
  static std::string meant(std::string_view type) {
    if (kNotRendered.count(type)) return {};
    std::vector<std::string_view> known(kIgnored.begin(), kIgnored.end());
    known.insert(known.end(), kParts.begin(), kParts.end());
    for (const auto& [name, handler] : handlers()) known.push_back(name);
    std::sort(known.begin(), known.end());  // of two that are as near, always the same
    return didYouMean(type, known);
  }

  /// Once for each kind.
  void warn(const Node& at, std::string what, std::string_view kind) {
    warn(at.token, std::move(what), kind);
  }
  void warn(const Token& at, std::string what, std::string_view kind, std::string hint = {}) {
    constexpr std::size_t kMostKinds = 100;
    if (told_.size() < kMostKinds && told_.emplace(kind).second)
      messages_.warn(document_.place(at), std::move(what), std::move(hint));
  }

  // --- groups ---

  void separator(const Values& v, State& state) { separate(v, state); }
  void group(const Values& v, State& state) { vrml2_ ? separate(v, state) : children(v, state); }
  void transformSeparator(const Values& v, State& state) {
    const Affine before = state.worldFromObject;
    children(v, state);
    state.worldFromObject = before;
  }
  std::vector<NodeIn> alternatives(const Values& v, std::string_view field) {
    std::vector<NodeIn> all = v.nodes(field);
    for (const Node* child : v.node().children) all.push_back({child, v.env()});
    for (const NodeIn& child : v.nodes("children")) all.push_back(child);
    return all;
  }
  void switchNode(const Values& v, State& state) {
    constexpr Real kAll = -3;
    const Real which = v.number(vrml2_ ? "whichChoice" : "whichChild", -1);
    const std::vector<NodeIn> all = alternatives(v, "choice");
    for (std::size_t i = 0; i < all.size(); ++i)
      if (which == kAll || which == static_cast<Real>(i)) visit(all[i], state);
    if (which >= static_cast<Real>(all.size()))
      warn(v.node(),
           "Switch: expected the number of one of its " + std::to_string(all.size()) +
               " children, counted from 0, found " + toText(which),
           "switch");
  }
  void firstChild(const Values& v, State& state) {
    const std::vector<NodeIn> all = alternatives(v, "level");
    State own = state;
    if (!all.empty()) visit(all.front(), own);
  }
  void array(const Values& v, State& state) {
    const auto count = [&](const char* name) { return std::clamp(v.number(name, 1), 1.0, 10000.0); };
    for (int k = 0; k < count("numElements3"); ++k)
      for (int j = 0; j < count("numElements2"); ++j)
        for (int i = 0; i < count("numElements1"); ++i) {
          State own = state;
          const Vec3 offset = v.vector("separation1", {1, 0, 0}) * i +
                              v.vector("separation2", {0, 1, 0}) * j + v.vector("separation3", {0, 0, 1}) * k;
          own.worldFromObject = state.worldFromObject * Affine::translation(offset);
          spend(1, v.node());
          children(v, own);
        }
  }
  void multipleCopy(const Values& v, State& state) {
    const std::vector<double>& n = v.numbers("matrix");
    for (std::size_t i = 0; i + 15 < n.size(); i += 16) {
      State own = state;
      own.worldFromObject = state.worldFromObject * rowMatrix(&n[i]);
      children(v, own);
    }
  }

  /// Objects and lights of another file, of this kind or of meshes, as if they stood here.
  void include(const Values& v, State& state) {
    const std::string name(v.word(v.node().type == "Inline" ? "url" : "name", ""));
    if (name.empty())
      return warn(v.node(), std::string(v.node().type) + " names no file: nothing is brought in", "no file");
    const auto [known, fresh] = library_.try_emplace(besideFile(document_.file(), name));
    if (fresh) try {
        known->second = readPart(known->first, name);
      } catch (const Error& error) {
        if (error.fault() == Fault::limit) throw;
        warn(v.node(), name + " is left out: " + error.messages().front().what, name);
      }
    if (!known->second) return warn(v.node(), name + " is left out: it holds itself", name);
    const Scene& part = *known->second;
    spend(part.objects.size() + part.lights.size(), v.node());
    const auto [first, unknown] = firstMaterials_.try_emplace(&part, scene_.materials.size());
    if (unknown)
      scene_.materials.insert(scene_.materials.end(), part.materials.begin(), part.materials.end());
    for (Object object : part.objects) {
      object.worldFromObject = state.worldFromObject * object.worldFromObject;
      object.material += static_cast<std::uint32_t>(first->second);
      if (invertible(object.worldFromObject)) scene_.objects.push_back(std::move(object));
    }
    for (const LightSource& source : part.lights)
      scene_.lights.push_back({moved(source.light, state.worldFromObject), source.place});
  }

  /// What the file of that path holds, by which `name` names it.
  Scene readPart(const std::string& path, const std::string& name) {
    constexpr int kMostFiles = 20;
    if (nesting_ >= kMostFiles)
      throw Error(Fault::scene, "files that name files are read 20 deep, and no deeper");
    const std::string bytes = readBeside(document_.file(), name, scene_.inputs);
    Scene part;
    if (hasHeader(bytes)) {
      const Document document(path, bytes, messages_);
      part = Reader(document, messages_, library_, nesting_ + 1).readPart();
      scene_.inputs.note(part.inputs);
    } else {
      const Model model = readModel(path, bytes, messages_);
      scene_.inputs.note(model.inputs);
      part.objects = placed(model, plainMaterial(), [&](const Material& material) {
        part.materials.push_back(material);
        return static_cast<std::uint32_t>(part.materials.size() - 1);
      });
    }
    for (Material& material : part.materials)  // pictures lie beside that file, and are named from this one
      for (FieldMap& map : material.maps) map.file = besideFile(name, map.file);
    return part;
  }

  // --- transforms ---

  void move(State& state, const Affine& own) { state.worldFromObject = state.worldFromObject * own; }

  void transform(const Values& v, State& state) {
    const Affine own = transformOf(v, vrml2_ ? "scale" : "scaleFactor");
    if (!vrml2_) return move(state, own);
    State inside = state;
    move(inside, own);
    children(v, inside);
  }
  void translation(const Values& v, State& s) { move(s, Affine::translation(v.vector("translation", {}))); }
  void rotation(const Values& v, State& s) { move(s, turn(v.numbers("rotation"))); }
  void rotationXyz(const Values& v, State& s) {
    const std::string_view axis = v.word("axis", "X");
    const Vec3 a = axis == "Y" ? Vec3{0, 1, 0} : axis == "Z" ? Vec3{0, 0, 1} : Vec3{1, 0, 0};
    move(s, Affine::rotation(a, v.number("angle", 0)));
  }
  void scale(const Values& v, State& s) { move(s, Affine::scaling(v.vector("scaleFactor", {1, 1, 1}))); }
  void matrix(const Values& v, State& s) {
    const std::vector<double>& n = v.numbers("matrix");
    if (n.size() >= 16) move(s, rowMatrix(n.data()));
  }
  void resetTransform(const Values&, State& s) { s.worldFromObject = {}; }
  void units(const Values& v, State& s) {
    const Real unit = metres(v.word("units", "METERS"));
    if (unit == 0) return;
    const Real factor = unit / std::exchange(s.unit, unit);
    move(s, Affine::scaling({factor, factor, factor}));
  }

  // --- properties ---

  /// A node that is used again gives the same list, and the same paint over the same one before, so that
  /// meshes made of them are the same too.
  template <class List, class Make>
  std::shared_ptr<const List> listOf(std::map<const Field*, std::shared_ptr<const List>>& known,
                                     const Values& v, std::string_view name, Make&& make) {
    auto& list = known[v.field(name)];
    if (!list) list = std::make_shared<const List>(make());
    return list;
  }
  std::shared_ptr<const std::vector<Vec3>> vectors(const Values& v, std::string_view name) {
    return listOf(vectors_, v, name, [&] { return v.vectors(name); });
  }
  std::shared_ptr<const std::vector<Vec2>> pairs(const Values& v, std::string_view name) {
    return listOf(pairs_, v, name, [&] { return v.pairs(name); });
  }
  template <class Change>
  void repaint(const Values& v, State& state, Change&& change) {
    auto& known = paints_[{&v.node(), v.env(), state.paint}];
    if (!known) {
      auto paint = std::make_shared<Paint>(*state.paint);
      change(*paint);
      known = std::move(paint);
    }
    state.paint = known;
  }
  void material(const Values& v, State& state) {
    repaint(v, state, [&](Paint& p) {
      const Paint before = p;
      p = paintOf(v, vrml2_);
      p.texture = before.texture;
      p.unlit = !vrml2_ && before.unlit;
    });
  }
  void baseColor(const Values& v, State& state) {
    repaint(v, state, [&](Paint& p) { p.diffuse = v.colors("rgb"); });
  }
  void packedColor(const Values& v, State& state) {
    const std::vector<double>& n = v.numbers(v.has("rgba") ? "rgba" : "orderedRGBA");
    repaint(v, state, [&](Paint& p) { unpack(n, p); });
  }
  static void unpack(const std::vector<double>& n, Paint& paint) {
    paint.diffuse.clear(), paint.transparency.clear();
    for (double number : n) {
      const auto bits = static_cast<std::uint32_t>(std::clamp(number, 0.0, 4294967295.0));
      const auto byte = [&](int i) { return (bits >> (8 * i) & 255) / 255.0; };
      paint.diffuse.emplace_back(byte(3), byte(2), byte(1));
      paint.transparency.push_back(1 - byte(0));
    }
  }
  void materialBinding(const Values& v, State& s) { s.materialBinding = v.word("value", "DEFAULT"); }
  void normalBinding(const Values& v, State& s) { s.normalBinding = v.word("value", "DEFAULT"); }
  void lightModel(const Values& v, State& s) {
    repaint(v, s, [&](Paint& p) { p.unlit = v.word("model", "PHONG") == "BASE_COLOR"; });
  }
  void shapeHints(const Values& v, State& s) {
    const std::string_view order = v.word("vertexOrdering", "UNKNOWN_ORDERING");
    s.ordered = order != "UNKNOWN_ORDERING", s.counterClockwise = order != "CLOCKWISE";
    s.solid = v.word("shapeType", "UNKNOWN_SHAPE_TYPE") == "SOLID";
    s.creaseAngle = v.number("creaseAngle", document_.oldCrease() ? 0.5 : 0);
  }
  void coordinates(const Values& v, State& s) { s.points = vectors(v, "point"); }
  void normals(const Values& v, State& s) { s.normals = vectors(v, "vector"); }
  void textureCoordinates(const Values& v, State& s) { s.uvs = pairs(v, "point"); }
  void texture(const Values& v, State& s) {
    repaint(v, s, [&, file = textureOf(v)](Paint& p) { p.texture = file; });
  }
  /// The name of the texture's file, noted; empty if its picture stands in this file.
  std::string_view textureOf(const Values& v) {
    const std::string_view file = v.word(v.has("url") ? "url" : "filename", "");
    const Place place = document_.place(v.node().token);
    if (!file.empty()) {
      scene_.inputs.noteNamed(besideFile(document_.file(), std::string(file)));
      if (files_.emplace(file).second)
        scene_.unrendered.push_back({"map", place, "map(\"" + std::string(file) + "\")"});
      textures_.note(file, place);
      return file;
    }
    for (std::string_view several : {"texture", "textures"})  // of a MultiTexture
      for (const NodeIn& one : v.nodes(several))
        if (one.node) textureOf(Values(*one.node, one.env));
    if (v.numbers("image").size() > 3)
      textures_.note(std::string(v.node().type) + " (inside the file)", place);
    return {};
  }
  void vertexProperty(const Values& v, State& s) {
    if (v.has("vertex")) s.points = vectors(v, "vertex");
    if (v.has("normal")) s.normals = vectors(v, "normal");
    if (v.has("texCoord")) s.uvs = pairs(v, "texCoord");
    if (v.has("orderedRGBA")) packedColor(v, s);
    s.materialBinding = v.word("materialBinding", s.materialBinding);
    s.normalBinding = v.word("normalBinding", s.normalBinding);
  }

  // --- lights and cameras ---

  void environment(const Values& v, State&) {
    ambient_ = shine(v.color("ambientColor", Color(1)), v.number("ambientIntensity", 0.2));
    const Vec3 a = v.vector("attenuation", {0, 0, 1});  // squared, linear, constant
    fading_ = {a.z, a.y, a.x};
  }
  /// A colour times a factor, within what a light can be.
  static Color shine(const Color& color, Real factor) {
    constexpr Real kMost = 1e30;
    const auto limited = [&](Real c) { return std::clamp(c * factor, 0.0, kMost); };
    return {limited(color.r), limited(color.g), limited(color.b)};
  }
  Color shining(const Values& v) {
    const Color color = v.color("color", Color(1));
    if (vrml2_) ambient_ += shine(color, v.number("ambientIntensity", 0));
    return shine(color, v.number("intensity", 1));
  }
  template <class L>
  void addLight(const Values& v, L light) {
    if constexpr (requires { light.constant; }) {
      Vec3 fading = vrml2_ ? v.vector("attenuation", {1, 0, 0}) : fading_;
      if (fading == Vec3{}) fading = {1, 0, 0};
      light.constant = fading.x, light.linear = fading.y, light.quadratic = fading.z;
    }
    if constexpr (requires { light.direction; })
      if (!(length(light.direction) > 0))
        return warn(v.node(), "a light without a direction is left out", "light");
    if constexpr (requires { light.position; })
      if (!isFinite(light.position)) return warn(v.node(), "a light without a place is left out", "light");
    scene_.lights.push_back({light, document_.place(v.node().token)});
  }
  Vec3 standard() const { return vrml2_ ? Vec3{} : Vec3{0, 0, 1}; }
  void pointLight(const Values& v, State& s) {
    if (!v.flag("on", true)) return;
    addLight(
        v, PointLight{.position = s.worldFromObject * v.vector("location", standard()), .color = shining(v)});
  }
  void directionalLight(const Values& v, State& s) {
    if (!v.flag("on", true)) return;
    addLight(v, DirectionalLight{linear(s.worldFromObject, v.vector("direction", {0, 0, -1})), shining(v)});
  }
  void spotLight(const Values& v, State& s) {
    if (!v.flag("on", true)) return;
    SpotLight light{.position = s.worldFromObject * v.vector("location", standard()),
                    .direction = linear(s.worldFromObject, v.vector("direction", {0, 0, -1})),
                    .color = shining(v)};
    const auto degrees = [](Real radians) { return std::clamp(radians * 180 / kPi, 0.0, 180.0); };
    light.angle = light.fullAngle = degrees(v.number("cutOffAngle", 0.785398));
    if (vrml2_)
      light.fullAngle = std::min(light.angle, degrees(v.number("beamWidth", 1.570796)));
    else
      light.exponent = std::max(0.0, 128 * v.number("dropOffRate", 0));
    addLight(v, light);
  }

  void camera(const Values& v, const State& s, const Vec3& position, Real angle, Real aspect) {
    if (hasCamera_) return;
    const Affine own = turn(v.numbers("orientation"));
    Camera camera;
    camera.position = s.worldFromObject * v.vector("position", position);
    camera.viewdir = linear(s.worldFromObject, linear(own, {0, 0, -1}));
    camera.updir = linear(s.worldFromObject, linear(own, {0, 1, 0}));
    camera.fov = angle * 180 / kPi;
    if (aspect > 0.01 && aspect < 100) camera.aspectratio = aspect;
    const bool good = camera.fov > 0 && camera.fov < 180 && canLook(camera.viewdir, camera.updir) &&
                      isFinite(camera.position);
    if (!good) return warn(v.node(), "a camera that cannot look is left out", "camera");
    camera.viewdir = normalize(camera.viewdir);
    scene_.camera = camera;
    hasCamera_ = true;
  }
  void perspectiveCamera(const Values& v, State& s) {
    camera(v, s, {0, 0, 1}, v.number("heightAngle", 0.785398), v.number("aspectRatio", 1));
  }
  /// Seen from so far behind that its lines are nearly parallel.
  void orthographicCamera(const Values& v, State& s) {
    constexpr Real kFar = 100;
    if (hasCamera_) return;
    const Real height = v.number("height", 2);
    camera(v, s, {0, 0, 1}, 2 * std::atan(0.5 / kFar), v.number("aspectRatio", 1));
    if (hasCamera_) scene_.camera.position += scene_.camera.viewdir * (-kFar * height);
    warn(v.node(), "an orthographic camera becomes one that looks from far away", "orthographic");
  }
  void viewpoint(const Values& v, State& s) {
    camera(v, s, {0, 0, 10}, v.number("fieldOfView", 0.785398), 1);
  }

  /// The sky straight above stands for all of it.
  void background(const Values& v, State&) {
    const std::vector<Color> sky = v.colors("skyColor");
    if (scene_.background.colors.empty() && !sky.empty()) scene_.background.colors = {sky.front()};
    for (const char* side : {"frontUrl", "backUrl", "leftUrl", "rightUrl", "topUrl", "bottomUrl"})
      if (const std::string_view file = v.word(side, ""); !file.empty())
        textures_.note(file, document_.place(v.node().token));
  }
  /// Nothing but whether what follows is seen at all.
  void drawStyle(const Values& v, State&) {
    const std::string_view style = v.word("style", "FILLED");
    if (style == "FILLED") return;
    warn(v.node(),
         "DrawStyle " + std::string(style.substr(0, 40)) + " is not rendered: surfaces are drawn whole",
         "draw style");
  }

  // --- shapes ---

  std::uint32_t materialNumber(const State& state, std::size_t i) {
    std::vector<std::uint32_t>& numbers = numbers_[state.paint];
    constexpr std::uint32_t kNone = 0xffffffff;
    if (numbers.empty()) numbers.assign(state.paint->count(), kNone);
    std::uint32_t& number = numbers[std::min(i, numbers.size() - 1)];
    if (number == kNone) {
      number = static_cast<std::uint32_t>(scene_.materials.size());
      scene_.materials.push_back(state.paint->material(i));
    }
    return number;
  }

  void add(const Values& v, const State& state, Shape shape, const Affine& own = {}) {
    const Affine worldFromObject = state.worldFromObject * own;
    if (!invertible(worldFromObject))
      return warn(v.node(),
                  "objects are left out whose transform makes them flat, or infinitely large or small",
                  "flat");
    scene_.objects.push_back({std::string(v.node().name), std::move(shape), worldFromObject,
                              materialNumber(state, 0), document_.place(v.node().token)});
  }

  /// VRML97: appearance and geometry of one shape.
  void shape(const Values& v, State& outer) {
    State state = outer;
    if (const NodeIn at = nodeOf(v, "appearance"); at.node) {
      const Values look(*at.node, at.env);
      if (const NodeIn m = nodeOf(look, "material"); m.node) material(Values(*m.node, m.env), state);
      if (const NodeIn t = nodeOf(look, "texture"); t.node) {
        const Values picture(*t.node, t.env);
        repaint(picture, state, [&, file = textureOf(picture)](Paint& p) { p.texture = file; });
      }
    }
    if (const NodeIn at = nodeOf(v, "geometry"); at.node) visit(at, state);
  }

  void box(const Values& v, State& s) {
    const Vec3 size = vrml2_ ? v.vector("size", {2, 2, 2})
                             : Vec3{v.number("width", 2), v.number("height", 2), v.number("depth", 2)};
    add(v, s, Cube{}, Affine::scaling(size));
  }
  void sphere(const Values& v, State& s) {
    const Real r = v.number("radius", 1);
    add(v, s, Sphere{}, Affine::scaling({r, r, r}));
  }
  /// From along z to along y.
  static Affine upright() { return Affine::rotation({1, 0, 0}, -kPi / 2); }
  bool hasPart(const Values& v, std::string_view flag, std::string_view part) {
    if (vrml2_) return v.flag(flag, true);
    const auto& parts = v.words("parts");
    return parts.empty() || std::any_of(parts.begin(), parts.end(),
                                        [&](std::string_view word) { return word == "ALL" || word == part; });
  }
  void lid(const Values& v, const State& s, Real radius, Real y, bool up) {
    Surface surface = disc(radius, y, up);
    mesh(v, s, surface, {});
  }
  void cone(const Values& v, State& s) {
    const Real r = v.number("bottomRadius", 1), h = v.number("height", 2);
    const bool side = hasPart(v, "side", "SIDES"), bottom = hasPart(v, "bottom", "BOTTOM");
    if (side)
      add(v, s, Cone{.height = 1, .capped = bottom},
          Affine::translation({0, -h / 2, 0}) * upright() * Affine::scaling({r, r, h}));
    else if (bottom)
      lid(v, s, r, -h / 2, false);
  }
  void cylinder(const Values& v, State& s) {
    const Real r = v.number("radius", 1), h = v.number("height", 2);
    const bool side = hasPart(v, "side", "SIDES"), top = hasPart(v, "top", "TOP"),
               bottom = hasPart(v, "bottom", "BOTTOM");
    const bool whole = side && top && bottom;
    if (side)
      add(v, s, Cylinder{whole},
          Affine::translation({0, -h / 2, 0}) * upright() * Affine::scaling({r, r, h}));
    if (!whole && top) lid(v, s, r, h / 2, true);
    if (!whole && bottom) lid(v, s, r, -h / 2, false);
  }

  // --- shapes of polygons ---

  /// Everything a mesh is made from.
  using MeshKey = std::tuple<const Node*, const Env*, const void*, const void*, const void*, const void*,
                             std::string_view, std::string_view, int, Real>;
  static MeshKey keyOf(const Values& v, const State& s) {
    const int flags = (s.ordered ? 1 : 0) + (s.counterClockwise ? 2 : 0) + (s.solid ? 4 : 0);
    return {&v.node(),     v.env(),           s.points.get(),  s.normals.get(), s.uvs.get(),
            s.paint.get(), s.materialBinding, s.normalBinding, flags,           s.creaseAngle};
  }
  /// Adds the mesh that was made of the same before; false if there is none.
  bool addAgain(const Values& v, const State& state) {
    const auto found = meshes_.find(keyOf(v, state));
    if (found == meshes_.end()) return false;
    if (!found->second.data->triangles.empty()) add(v, state, found->second);
    return true;
  }

  void mesh(const Values& v, const State& state, const Surface& surface, const Bindings& bind) {
    constexpr std::size_t kCornersOfWork = 32;
    spend(surface.outline.points.size() / kCornersOfWork, v.node());
    const Outline& outline = surface.outline;
    if (outline.bad > 0)
      warn(v.node(),
           std::to_string(outline.bad) +
               " faces are left out: of fewer than three points, or of points "
               "that are not there",
           "faces");
    if (outline.counts.empty()) return;
    Faces faces;
    faces.points = surface.points;
    faces.counts = outline.counts;
    faces.counterClockwise = state.counterClockwise;
    faces.creaseAngle = state.creaseAngle;
    const std::vector<Vec3>& normals = *state.normals;
    const std::vector<Vec2>& uvs = surface.uvs.empty() ? *state.uvs : surface.uvs;
    faces.hasNormals = bind.normal.by != By::nothing && !normals.empty();
    faces.hasMaterials =
        bind.material.by != By::nothing && bind.material.by != By::all && state.paint->count() > 1;
    faces.hasUvs = !uvs.empty();
    const Binding byPoint{By::point, nullptr};
    const Binding& uvBinding = surface.uvs.empty() && bind.uv.by != By::nothing ? bind.uv : byPoint;
    std::size_t corner = 0, missing = 0;
    for (std::size_t face = 0; face < faces.counts.size(); ++face)
      for (std::uint32_t i = 0; i < faces.counts[face]; ++i, ++corner) {
        Corner c;
        c.point = outline.points[corner];
        if (faces.hasNormals) {
          const std::size_t n = bind.normal(outline, face, corner);
          if (n >= normals.size())
            faces.hasNormals = false;
          else
            c.normal = unit(normals[n]);
        }
        if (faces.hasMaterials) {
          const std::size_t n = bind.material(outline, face, corner);
          missing += bind.material.indices && n >= state.paint->count();
          c.material = materialNumber(state, n);
        }
        if (faces.hasUvs) {
          const std::size_t n = uvBinding(outline, face, corner);
          missing += uvBinding.indices && n >= uvs.size();
          if (n < uvs.size()) c.uv = uvs[n];
        }
        faces.corners.push_back(c);
      }
    if (missing > 0)
      warn(v.node(), "corners use materials, colours or texture coordinates that are not there", "missing");
    if (bind.normal.by != By::nothing && !normals.empty() && !faces.hasNormals)
      warn(v.node(), "there are fewer normals than the faces need; they are made from the faces", "normals");
    MeshData data = meshOf(std::move(faces));
    data.twoSided = !(state.ordered && state.solid);
    repairs_.check(data, document_.place(v.node().token));
    made_ = Mesh{std::make_shared<const MeshData>(std::move(data))};
    if (!made_.data->triangles.empty()) add(v, state, made_);
  }
  static Vec3 unit(const Vec3& v) {
    const Real l = length(v);
    return l > 0 && std::isfinite(l) ? v / l : Vec3{};
  }

  void faceSet(const Values& v, State& outer) {
    if (addAgain(v, outer)) return;
    State state = outer;
    if (const NodeIn at = nodeOf(v, "vertexProperty"); at.node)
      vertexProperty(Values(*at.node, at.env), state);
    Bindings bind;
    if (vrml2_) {
      bind = attributes(v, state);
    } else {
      const bool indexed = v.node().type.starts_with("Indexed");
      bind.normal = bindingOf(state.normalBinding, By::point, v.numbers("normalIndex"), indexed);
      bind.material = bindingOf(state.materialBinding, By::all, v.numbers("materialIndex"), indexed);
      bind.uv = bindingOf("PER_VERTEX_INDEXED", By::point, v.numbers("textureCoordIndex"), indexed);
    }
    Surface surface;
    surface.points = *state.points;
    surface.outline = outlineOf(v, v.node().type, surface.points.size());
    mesh(v, state, surface, bind);
    remember(v, outer);
  }

  void remember(const Values& v, const State& outer) { meshes_[keyOf(v, outer)] = std::exchange(made_, {}); }

  /// What a shape of VRML97 holds itself.
  Bindings attributes(const Values& v, State& state) {
    state.ordered = true;
    state.counterClockwise = v.flag("ccw", true);
    state.solid = v.flag("solid", true);
    state.creaseAngle = v.number("creaseAngle", 0);
    if (const NodeIn at = nodeOf(v, "coord"); at.node)
      state.points = vectors(Values(*at.node, at.env), "point");
    Bindings bind;
    if (const NodeIn at = nodeOf(v, "normal"); at.node) {
      normals(Values(*at.node, at.env), state);
      bind.normal = bindingOf(v.flag("normalPerVertex", true), v.numbers("normalIndex"));
    }
    if (const NodeIn at = nodeOf(v, "texCoord"); at.node) {
      textureCoordinates(Values(*at.node, at.env), state);
      bind.uv = bindingOf(true, v.numbers("texCoordIndex"));
    }
    if (const NodeIn at = nodeOf(v, "color"); at.node) {
      const Values colors(*at.node, at.env);
      repaint(colors, state, [&](Paint& p) { p.diffuse = colors.colors("color"); });
      bind.material = bindingOf(v.flag("colorPerVertex", true), v.numbers("colorIndex"));
    }
    return bind;
  }

  void elevationGridNode(const Values& v, State& outer) {
    if (addAgain(v, outer)) return;
    State state = outer;
    const Bindings bind = attributes(v, state);
    const Surface surface = elevationGrid(v);
    if (surface.points.empty())
      return warn(v.node(), "an ElevationGrid needs xDimension * zDimension heights, at least 2 * 2", "grid");
    mesh(v, state, surface, bind);
    remember(v, outer);
  }
  void extrusionNode(const Values& v, State& outer) {
    if (addAgain(v, outer)) return;
    State state = outer;
    attributes(v, state);
    const Surface surface = extrusion(v);
    if (surface.outline.counts.empty())
      return warn(v.node(), "an Extrusion needs a crossSection and a spine of at least 2 points",
                  "extrusion");
    mesh(v, state, surface, {});
    remember(v, outer);
  }

  // --- the whole ---

  void finish() {
    const Place place{scene_.file, 0, 0, {}};
    if (!meshes_.empty()) repairs_.report(place, messages_);
    textures_.report(messages_);
    if (scene_.objects.empty()) messages_.warn(place, "no object: the picture will be empty");
    if (!hasCamera_) {
      scene_.camera = framing(bounds(scene_));
      scene_.camera.fov = 45;
    }
    if (scene_.lights.empty())  // the headlight of every viewer
      scene_.lights.push_back({DirectionalLight{scene_.camera.viewdir, Color(1)}, place});
    if (!isBlack(ambient_)) scene_.lights.push_back({AmbientLight{ambient_}, place});
    for (const auto& [option, value] : {std::pair<std::string, std::string>{"shininess-scale", "128"},
                                        {"pixel-position", "center"},
                                        {"mirror-default", "zero"}})
      scene_.choices.push_back({option, value, place});
  }

  const Document& document_;
  Messages& messages_;
  Library& library_;
  int nesting_;  ///< of files that name files
  bool vrml2_;
  MeshRepairs repairs_;
  Scene scene_;
  bool hasCamera_ = false;
  Color ambient_ = vrml2_ ? Color(0) : Color(0.2);
  Vec3 fading_{1, 0, 0};
  std::deque<Env> envs_;
  std::map<const Field*, std::shared_ptr<const std::vector<Vec3>>> vectors_;
  std::map<const Field*, std::shared_ptr<const std::vector<Vec2>>> pairs_;
  std::map<std::tuple<const Node*, const Env*, std::shared_ptr<const Paint>>, std::shared_ptr<const Paint>>
      paints_;
  std::map<const Scene*, std::size_t> firstMaterials_;  ///< of what other files bring
  std::map<MeshKey, Mesh> meshes_;
  Mesh made_;  ///< by mesh(), for remember()
  std::map<std::shared_ptr<const Paint>, std::vector<std::uint32_t>> numbers_;
  std::set<std::string, std::less<>> told_, files_;
  std::set<const Node*> checked_;
  Textures textures_;
  std::size_t spent_ = 0;
  int depth_ = 0;
};

}  // namespace
}  // namespace inventor

bool recognisesInventor(std::string_view bytes) { return inventor::hasHeader(bytes); }

Scene readInventor(const std::string& file, std::string_view bytes, Messages& messages) {
  const inventor::Document document(file, bytes, messages);
  inventor::Library library;
  library.try_emplace(file);  // it cannot bring itself
  return inventor::Reader(document, messages, library).read();
}

}  // namespace trace
