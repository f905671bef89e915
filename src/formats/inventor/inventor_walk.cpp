// The walk through the nodes, and the nodes that hold others.
#include <algorithm>

#include "base/nesting.h"
#include "base/text.h"
#include "formats/inventor/inventor_reader.h"
#include "formats/inventor/inventor_transform.h"

namespace trace::inventor {

namespace {

/// Nodes that say nothing a picture needs.
const std::set<std::string_view> kIgnored{"Info",
                                          "WorldInfo",
                                          "Complexity",
                                          "Sound",
                                          "AudioClip",
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
const std::set<std::string_view> kNotRendered{"Script",
                                              "Text",
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
const std::set<std::string_view> kParts{"Appearance",        "Coordinate",   "Color",
                                        "TextureCoordinate", "ImageTexture", "PixelTexture",
                                        "MovieTexture",      "MultiTexture", "TextureTransform"};

/// "translation and scale": what a node says of itself, and not which nodes it holds.
std::string fieldsWithoutNodes(const Node& node) {
  constexpr std::size_t kMost = 5;
  std::vector<std::string> names;
  for (const Field& field : node.fields)
    if (field.nodes.empty() && field.name != "children") names.emplace_back(field.name.substr(0, 40));
  if (names.size() > kMost) {
    names.resize(kMost);
    names.emplace_back("other fields");
  }
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return text;
}

}  // namespace

// --- the walk ---

void Reader::walk() {
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

void Reader::visit(NodeIn at, State& state) {
  spend(1, *at.node);
  if (depth_ >= kMostNesting) return warn(*at.node, "nodes that are nested this deep are left out", "depth");
  ++depth_;
  if (at.node->proto)
    proto(at, state);
  else
    node(Values(*at.node, at.env), state);
  --depth_;
}

void Reader::spend(std::size_t work, const Node& node) {
  constexpr std::size_t kAnyFile = 20000, kTimes = 20,
                        kBytesOfWork = 2 * kCornersOfWork;  // a corner has 2 or more
  spent_ += work;
  if (spent_ > kAnyFile + kTimes * (document_.nodeCount() + document_.size() / kBytesOfWork))
    throw Error(Fault::limit, document_.place(node.token),
                "expected less work for a file of this size: its nodes are used again too often");
}

void Reader::proto(NodeIn at, State& state) {
  if (at.node->proto->nodes.empty()) return;
  visit({at.node->proto->nodes.front(), envOf(at)}, state);
}

const Env* Reader::envOf(NodeIn at) { return &envs_.emplace_back(Env{at.node, at.env}); }

NodeIn Reader::resolved(NodeIn at) {
  for (int i = 0; i < 100 && at.node && at.node->proto; ++i) {
    if (at.node->proto->nodes.empty()) return {};
    at = {at.node->proto->nodes.front(), envOf(at)};
  }
  if (at.node) check(Values(*at.node, at.env));
  return at;
}

void Reader::check(const Values& v) {
  if (!checked_.insert(&v.node()).second) return;
  checkFields(v, vrml2_, [&](const Token& at, std::string what, std::string hint, std::string kind) {
    warn(at, std::move(what), kind, std::move(hint));
  });
}

NodeIn Reader::nodeOf(const Values& v, std::string_view field) {
  const std::vector<NodeIn> nodes = v.nodes(field);
  const NodeIn found = nodes.empty() ? NodeIn{} : resolved(nodes.front());
  if (found.node && field != "geometry") warnUnknownPart(*found.node);  // geometry later
  return found;
}

void Reader::warnUnknownPart(const Node& node) {
  const std::string_view type = node.type;
  if (handlers().contains(type) || kIgnored.count(type) || kNotRendered.count(type) || kParts.count(type))
    return;
  warn(node.token, "\"" + std::string(type.substr(0, 40)) + "\" is not known", type, meant(type));
}

void Reader::children(const Values& v, State& state) {
  for (const Node* child : v.node().children) visit({child, v.env()}, state);
  for (const NodeIn& child : v.nodes("children")) visit(child, state);
}

void Reader::separate(const Values& v, const State& state) {
  State own = state;
  children(v, own);
}

const std::unordered_map<std::string_view, Reader::Handler>& Reader::handlers() {
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
      {"Billboard", &Reader::billboard},
      {"Annotation", &Reader::separator},
      {"StaticGroup", &Reader::separator},
      {"AppearanceKit", &Reader::parts},
      {"CameraKit", &Reader::kit},
      {"LightKit", &Reader::kit},
      {"SceneKit", &Reader::kit},
      {"SeparatorKit", &Reader::kit},
      {"ShapeKit", &Reader::kit},
      {"WrapperKit", &Reader::kit},
      {"NodeKitListPart", &Reader::kitList},
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
      {"Texture2Transform", &Reader::texture2Transform},
      {"TextureCoordinateBinding", &Reader::textureCoordinateBinding},
      {"NavigationInfo", &Reader::navigationInfo},
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

void Reader::node(const Values& v, State& state) {
  check(v);
  const auto handler = handlers().find(v.node().type);
  if (handler != handlers().end()) return (this->*handler->second)(v, state);
  if (kIgnored.count(v.node().type)) return;
  const std::string type = "\"" + std::string(v.node().type.substr(0, 40)) + "\"",
                    hint = meant(v.node().type);
  const std::string lost = hint.empty() ? "" : fieldsWithoutNodes(v.node());
  const bool hasChildren = !v.node().children.empty() || !v.nodes("children").empty();
  warn(v.node().token,
       hasChildren && !lost.empty() ? type + " is not known: what it holds is rendered without its " + lost
                                    : type + " is not rendered and is left out",
       v.node().type, hint);
  separate(v, state);  // perhaps it holds shapes
}

std::string Reader::meant(std::string_view type) {
  if (kNotRendered.count(type)) return {};
  std::vector<std::string_view> known(kIgnored.begin(), kIgnored.end());
  known.insert(known.end(), kParts.begin(), kParts.end());
  for (const auto& [name, handler] : handlers()) known.push_back(name);
  std::sort(known.begin(), known.end());  // always the same of two that are equally near
  return didYouMean(type, known);
}

void Reader::warn(const Node& at, std::string what, std::string_view kind) {
  warn(at.token, std::move(what), kind);
}

void Reader::warn(const Token& at, std::string what, std::string_view kind, std::string hint) {
  if (!warnings_.again(kind)) warnings_.warn(document_.place(at), std::move(what), std::move(hint), kind);
}

// --- groups ---

void Reader::separator(const Values& v, State& state) { separate(v, state); }

void Reader::group(const Values& v, State& state) { vrml2_ ? separate(v, state) : children(v, state); }

void Reader::transformSeparator(const Values& v, State& state) {
  const Affine before = state.worldFromObject;
  children(v, state);
  state.worldFromObject = before;
}

std::vector<NodeIn> Reader::alternatives(const Values& v, std::string_view field) {
  std::vector<NodeIn> all = v.nodes(field);
  for (const Node* child : v.node().children) all.push_back({child, v.env()});
  for (const NodeIn& child : v.nodes("children")) all.push_back(child);
  return all;
}

void Reader::switchNode(const Values& v, State& state) {
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

void Reader::firstChild(const Values& v, State& state) {
  const std::vector<NodeIn> all = alternatives(v, "level");
  State own = state;
  if (!all.empty()) visit(all.front(), own);
}

void Reader::billboard(const Values& v, State& state) {
  warn(v.node(), "a Billboard stands as the file has it: it is not turned to the camera", "billboard");
  separate(v, state);
}

void Reader::array(const Values& v, State& state) {
  const auto count = [&](const char* name) { return std::clamp(v.number(name, 1), 1.0, 10000.0); };
  // Which of the copies stands where the node is: the first, the middle of all, or the last.
  const std::string_view origin = v.word("origin", "FIRST");
  const Real share = origin == "LAST" ? 1 : origin == "CENTER" ? 0.5 : 0;
  const auto start = [&](const char* name) { return share * (1 - count(name)); };
  const Real i0 = start("numElements1"), j0 = start("numElements2"), k0 = start("numElements3");
  for (int k = 0; k < count("numElements3"); ++k)
    for (int j = 0; j < count("numElements2"); ++j)
      for (int i = 0; i < count("numElements1"); ++i) {
        State own = state;
        const Vec3 offset = v.vector("separation1", {1, 0, 0}) * (i0 + i) +
                            v.vector("separation2", {0, 1, 0}) * (j0 + j) +
                            v.vector("separation3", {0, 0, 1}) * (k0 + k);
        own.worldFromObject = state.worldFromObject * Affine::translation(offset);
        spend(1, v.node());
        children(v, own);
      }
}

void Reader::multipleCopy(const Values& v, State& state) {
  const std::vector<double>& n = v.numbers("matrix");
  for (std::size_t i = 0; i + 15 < n.size(); i += 16) {
    State own = state;
    own.worldFromObject = state.worldFromObject * rowMatrix(&n[i]);
    children(v, own);
  }
}

}  // namespace trace::inventor
