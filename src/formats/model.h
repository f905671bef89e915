// The contents of a mesh file, and how it becomes part of a scene or a scene of its own.
//
// Readers of PLY, STL, OFF, OBJ and glTF make a Model. A `.ray` scene that names the file places the model
// among its objects; a file rendered by itself gets the camera, lights and material it lacks.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "geometry/mesh/mesh.h"
#include "math/box.h"
#include "scene/scene.h"

namespace trace {

struct Model {
  /// The material of objects to which the file gives none.
  static constexpr std::uint32_t kNoMaterial = 0xffffffff;

  std::vector<Material> materials;
  std::vector<Object> objects;  ///< meshes; `material` is an index into materials, or kNoMaterial
  std::vector<LightSource> lights;
  std::optional<Camera> camera;
  std::vector<Choice> choices;
  /// Where the file colours its points: MeshData::materials are indices into these, which stand for the
  /// object's material with this colour as diffuse and ambient.
  std::vector<Color> colors;
  InputFiles inputs;  ///< files that this one names
  /// Seconds of the first and the last key, if something moves.
  std::optional<std::pair<Real, Real>> keys;
  /// The box that the camera of a scene of its own shows whole, where that is not just its objects.
  std::optional<Box3> framed;
  bool saysSides = false;  ///< the format knows Material::sides; otherwise a file by itself shows both
};

/// The parts of a mesh that may have flaws.
enum class MeshPart { triangle, point, normal, uv, color };

/// Where a part of a mesh is in its file: a line, or, in a binary file, words such as "facet 12".
struct MeshSpot {
  SourcePlace place{};
  std::string name{};
};

/// Finds the part of that index. MeshRepairs calls it for the first of each flaw only, so it may be slow.
using FindInFile = std::function<MeshSpot(MeshPart, std::size_t)>;

/// The number of times that a reader met a flaw, and the spot of the first.
struct CountedFlaw {
  std::size_t count = 0;
  MeshSpot first{};

  /// `spot` returns a MeshSpot; it is called once.
  template <class Spot>
  void add(std::size_t more, const Spot& spot) {
    if (more == 0) return;
    if (count == 0) first = spot();
    count += more;
  }
  /// Warns, with the count and the first spot, if there was one.
  void report(std::string_view what, Messages& messages) const;
};

/// The one rule of all mesh readers: a flaw costs what uses it. It is counted, and reported with its first
/// spot.
class MeshRepairs {
 public:
  /// Makes a mesh one that can be traced. Throws Error(Fault::scene) if each triangle uses a point that is
  /// not finite.
  void check(MeshData& mesh, const FindInFile& find);
  /// For readers that know one place of the whole mesh.
  void check(MeshData& mesh, const SourcePlace& place);
  /// Colours that are not finite become white. To be called before they become materials.
  void checkColors(std::vector<Vec3f>& colors, const FindInFile& find, float white = 1);
  /// Warns of the flaws of all meshes so far; `place` is that of the file.
  void report(const SourcePlace& place, Messages& messages) const;

 private:
  /// Removes the triangles whose points are not finite. The former indices of the others, if there were such.
  std::vector<std::uint32_t> dropInfinite(MeshData& mesh, const FindInFile& find);

  CountedFlaw infinitePoints_, lostTriangles_, infiniteNormals_, infiniteUvs_, infiniteColors_, withoutArea_,
      zeroNormals_;
  std::size_t triangles_ = 0;
};

/// Adds the mesh of a file that holds just one, repaired with warnings. Throws as MeshRepairs::check().
void addOnlyMesh(Model& model, MeshData mesh, MeshRepairs& repairs, const FindInFile& find,
                 const SourcePlace& place, Messages& messages);

/// The model's objects as a scene has them. `base` is the material of those without one; `index` gives a
/// material's number in the scene. Meshes are shared with the model unless their points are coloured.
std::vector<Object> placed(const Model& model, const Material& base,
                           const std::function<std::uint32_t(const Material&)>& index);

/// The model as a scene of its own, with framing(), plainLights() and a grey material where it has none.
Scene sceneOf(Model model, const std::string& file, std::string_view format);

/// The material of a mesh without one: a diffuse light grey.
Material plainMaterial();

/// Gives it the looks of plainMaterial(); its name and its sides stay.
void makePlain(Material& material);

/// The bounds of all objects, in the world.
Box3 bounds(const Scene& scene);

/// A camera from the front, a little to the right and above, that has the box whole in a square picture.
Camera framing(const Box3& box);
/// One that looks along `viewdir`, of an angle of view in degrees, whose picture is `aspect` times as wide as
/// high.
Camera framing(const Box3& box, Real fov, Real aspect, const Vec3& viewdir = {-0.35, -0.3, -1});

/// Two directional lights, from above the left and from the right of the camera, and a little ambient light.
std::vector<LightSource> plainLights(const Camera& camera);

/// Whether the lights are plainLights() of the camera: the file had none.
bool isPlainView(const Scene& scene);

}  // namespace trace
