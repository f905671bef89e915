// The reader of Inventor and VRML files: a walk through the nodes with the state that Inventor's property
// nodes set for what follows them. VRML97's nodes set the same state for the one shape they are of.
//
// Source: the specifications of VRML 1.0 and VRML97 and Inventor's node reference (docs/formats.md). Lights
// shine on everything, not only on what follows them. Nodes are read in the file of their kind: groups in
// inventor_walk.cpp, other files in inventor_files.cpp, transforms and properties in inventor_properties.cpp,
// lights and cameras in inventor_lights.cpp, shapes in inventor_objects.cpp, and those of polygons in
// inventor_polygons.cpp.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/error.h"
#include "formats/inventor/inventor_binding.h"
#include "formats/inventor/inventor_nodes.h"
#include "formats/inventor/inventor_shapes.h"
#include "formats/inventor/inventor_state.h"
#include "formats/model.h"
#include "formats/textures.h"
#include "formats/warnings.h"
#include "geometry/mesh/mesh.h"
#include "geometry/mesh/mesh_repair.h"
#include "scene/scene.h"
#include "shading/lights/plain_lights.h"

namespace trace::inventor {

/// The contents of other files, by path: each is read once however often it is named. Nothing while
/// it is read, or if it cannot be.
using Library = std::map<std::string, std::optional<Scene>>;

class Reader {
 public:
  Reader(const Document& document, Messages& messages, Library& library, int nesting = 0)
      : document_(document),
        messages_(messages),
        library_(library),
        nesting_(nesting),
        vrml2_(document.version() == Document::Version::vrml2) {
    scene_.file = document.file();
    scene_.format = "inventor";
  }
  /// The file as a scene, with what it lacks.
  Scene read();
  /// Only what the file itself holds.
  Scene readPart();

 private:
  // --- the walk ---

  void walk();
  void visit(NodeIn at, State& state);
  /// Nodes that are used again and again could make a small file endless work. A node is a unit of it, and so
  /// are some corners of faces.
  static constexpr std::size_t kCornersOfWork = 32;
  void spend(std::size_t work, const Node& node);
  /// Only the first node of a PROTO is to be seen; the others are there for routes.
  void proto(NodeIn at, State& state);
  const Env* envOf(NodeIn at);
  /// The node behind an instance of a PROTO.
  NodeIn resolved(NodeIn at);
  /// Warns once of what is wrong in the fields of a node.
  void check(const Values& v);
  /// The first node of a field, or nothing.
  NodeIn nodeOf(const Values& v, std::string_view field);
  /// It is taken for what the field needs.
  void warnUnknownPart(const Node& node);
  void children(const Values& v, State& state);
  void separate(const Values& v, const State& state);
  using Handler = void (Reader::*)(const Values&, State&);
  static const std::unordered_map<std::string_view, Handler>& handlers();
  void node(const Values& v, State& state);
  /// A type that the reader knows and the word may be a misspelling of.
  static std::string meant(std::string_view type);
  /// Once for each kind.
  void warn(const Node& at, std::string what, std::string_view kind);
  void warn(const Token& at, std::string what, std::string_view kind, std::string hint = {});

  // --- groups ---

  void separator(const Values& v, State& state);
  void kit(const Values& v, State& state);
  void parts(const Values& v, State& state);
  void kitList(const Values& v, State& state);
  void group(const Values& v, State& state);
  void transformSeparator(const Values& v, State& state);
  std::vector<NodeIn> alternatives(const Values& v, std::string_view field);
  void switchNode(const Values& v, State& state);
  void firstChild(const Values& v, State& state);
  void array(const Values& v, State& state);
  void multipleCopy(const Values& v, State& state);
  /// Objects and lights of another file, of this kind or of meshes, as if they stood here.
  void include(const Values& v, State& state);
  /// The contents of the file of that path, by which `name` names it.
  Scene readPart(const std::string& path, const std::string& name);

  // --- transforms ---

  void move(State& state, const Affine& own);
  void transform(const Values& v, State& state);
  void translation(const Values& v, State& s);
  void rotation(const Values& v, State& s);
  void rotationXyz(const Values& v, State& s);
  void scale(const Values& v, State& s);
  void matrix(const Values& v, State& s);
  void resetTransform(const Values&, State& s);
  void units(const Values& v, State& s);

  // --- properties ---

  /// A node that is used again gives the same list, and the same paint over the same one before, so that
  /// meshes made of them are the same too.
  template <class List, class Make>
  std::shared_ptr<const List> listOf(std::map<const Field*, std::shared_ptr<const List>>& known,
                                     const Values& v, std::string_view name, Make&& make);
  std::shared_ptr<const std::vector<Vec3>> vectors(const Values& v, std::string_view name);
  std::shared_ptr<const std::vector<Vec2>> pairs(const Values& v, std::string_view name);
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
  void material(const Values& v, State& state);
  void baseColor(const Values& v, State& state);
  void packedColor(const Values& v, State& state);
  static void unpack(const std::vector<double>& n, Paint& paint);
  void materialBinding(const Values& v, State& s);
  void normalBinding(const Values& v, State& s);
  void lightModel(const Values& v, State& s);
  void shapeHints(const Values& v, State& s);
  void coordinates(const Values& v, State& s);
  void normals(const Values& v, State& s);
  void textureCoordinates(const Values& v, State& s);
  void textureCoordinateBinding(const Values& v, State& s);
  void texture(const Values& v, State& s);
  void texture2Transform(const Values& v, State& s);
  /// The picture of a texture node; of several only the first is rendered. Nothing if it has none.
  std::optional<PaintedPicture> pictureOf(const Values& v);
  /// The name of a texture node.
  std::string nameOf(const Values& v) const;
  /// The first file of the field that is there, or the first that it names; empty if it names none.
  std::string fileOf(const Values& v, std::string_view field) const;
  void vertexProperty(const Values& v, State& s);

  // --- lights and cameras ---

  void environment(const Values& v, State&);
  /// A colour times a factor, within what a light can be.
  static Color shine(const Color& color, Real factor);
  Color shining(const Values& v);
  Fading fading(const Values& v);  // how a light fades
  void addLight(const Values& v, const Light& light);
  Vec3 standard() const;
  void pointLight(const Values& v, State& s);
  void directionalLight(const Values& v, State& s);
  void spotLight(const Values& v, State& s);
  void camera(const Values& v, const State& s, const Vec3& position, Real angle, Real aspect);
  void perspectiveCamera(const Values& v, State& s);
  /// Seen from so far behind that its lines are nearly parallel.
  void orthographicCamera(const Values& v, State& s);
  void viewpoint(const Values& v, State& s);
  /// Only the first of a file is seen.
  void background(const Values& v, State& s);
  /// Nothing but whether what follows is seen at all.
  void drawStyle(const Values& v, State&);
  void billboard(const Values& v, State& state);
  /// How one walks through the scene, and whether a light goes with the camera.
  void navigationInfo(const Values& v, State&);

  // --- shapes ---

  std::uint32_t materialNumber(const State& state, std::size_t i);
  void add(const Values& v, const State& state, Shape shape, const Affine& own = {});
  /// VRML97: appearance and geometry of one shape.
  void shape(const Values& v, State& outer);
  void box(const Values& v, State& s);
  void sphere(const Values& v, State& s);
  /// From along z to along y.
  static Affine upright();
  bool hasPart(const Values& v, std::string_view flag, std::string_view part);
  /// Textures start at the back and go round by the left, as seen from the front.
  static Affine uprightFromBack();
  void lid(const Values& v, const State& s, Real radius, Real y, bool up);
  /// The side of a cone or cylinder, whose shape stands on z = 0 and is of size 1.
  void side(const Values& v, const State& s, Shape shape, Real radius, Real height);
  void cone(const Values& v, State& s);
  void cylinder(const Values& v, State& s);

  // --- shapes of polygons ---

  /// Everything a mesh is made from.
  using MeshKey = std::tuple<const Node*, const Env*, const void*, const void*, const void*, const void*,
                             std::string_view, std::string_view, std::string_view, int, Real>;
  static MeshKey keyOf(const Values& v, const State& s);
  /// Adds the mesh that was made of the same before; false if there is none.
  bool addAgain(const Values& v, const State& state);
  void mesh(const Values& v, const State& state, const Surface& surface, const Bindings& bind);
  static Vec3 unit(const Vec3& v);
  void faceSet(const Values& v, State& outer);
  void remember(const Values& v, const State& outer);
  /// The data that a shape of VRML97 has itself.
  Bindings attributes(const Values& v, State& state);
  void elevationGridNode(const Values& v, State& outer);
  void extrusionNode(const Values& v, State& outer);

  // --- the whole ---

  void finish();

  const Document& document_;
  Messages& messages_;
  Library& library_;
  int nesting_;  ///< nesting of files that name files
  bool vrml2_;
  MeshRepairs repairs_;
  Scene scene_;
  bool hasCamera_ = false, hasBackground_ = false;
  std::optional<bool> headlight_;  ///< as a NavigationInfo says
  const Token* headlightAt_ = nullptr;
  Color ambient_ = vrml2_ ? Color(0) : Color(0.2);
  Vec3 fading_{1, 0, 0};
  std::deque<Env> envs_;
  std::map<const Field*, std::shared_ptr<const std::vector<Vec3>>> vectors_;
  std::map<const Field*, std::shared_ptr<const std::vector<Vec2>>> pairs_;
  std::map<std::tuple<const Node*, const Env*, std::shared_ptr<const Paint>>, std::shared_ptr<const Paint>>
      paints_;
  std::map<const Scene*, std::size_t> firstMaterials_;  ///< first materials of what other files bring
  std::map<MeshKey, Mesh> meshes_;
  Mesh made_;  ///< by mesh(), for remember()
  std::map<std::shared_ptr<const Paint>, std::vector<std::uint32_t>> numbers_;
  WarningsByKind warnings_;
  std::set<std::string, std::less<>> files_;
  std::set<const Node*> checked_;
  UnusedTextures textures_;
  std::size_t spent_ = 0;
  int depth_ = 0;
};

}  // namespace trace::inventor
