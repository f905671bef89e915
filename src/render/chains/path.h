// A path of light as a list of places, and what it brings: for chains that change paths place by place (Veach
// and Guibas, Metropolis Light Transport, 1997; Veach 1997, chapters 8 and 11).
//
//   z0 the lens   z1 ... z(k-1) surfaces   zk the emitter
//
// A path brings what --integrator path brings along it,
//
//   f = W  product of scattered(z1 ... z(k-1))  light
//
// as light per area of its places. Where it continues at random, a density over directions becomes one over
// areas by the geometric term G of the edge; a mirror or glass hands it on to the place behind it, whatever
// the surfaces' curvature does. Each G stands in f and, except for the edge that joins the two halves, in the
// density of a path: so f and densities are kept without it, as if directions were counted by their cosine
// to the surface (Veach 1997, sections 8.2 and 11.4). Places of mirrors and glass lie on no area of their
// own: their part in a density is the chance of the choice of that ray.
//
// Places are those that rays from the camera meet. Rays from lights only propose them.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "render/lights/lamps.h"
#include "render/paths/path_place.h"
#include "shading/cameras/importance.h"

namespace trace::veach {

/// The scene data that paths of one moment use.
struct Stage {
  Stage(const World& world, const Settings& settings, const Tile& area, const Size& size);

  /// Whether light from that place of the film falls on some pixel.
  bool onFilm(const Vec2& place) const {
    return place.x >= low.x && place.x <= high.x && place.y >= low.y && place.y <= high.y;
  }
  Real filmArea() const { return (high.x - low.x) * (high.y - low.y); }
  /// How often a place samples emissive objects and for the sky, and not for a light of the scene.
  Real lampShare() const { return lamps.empty() ? 0 : lights == 0 ? 1 : 0.5; }

  Lamps lamps;
  CameraImportance camera;
  Vec2 low, high;      ///< low and high of the film
  Vec2 side;           ///< side of a square of the film's area, in its widths and heights
  std::size_t lights;  ///< number of lights of the scene
  int mostPlaces;      ///< largest number of vertices of a path, its ends among them
};

/// A surface where a ray has arrived.
struct Vertex {
  Vertex(Tracer& tracer, const Ray& ray_, Interfaces inside_, const Hit& hit_)
      : ray(ray_),
        inside(std::move(inside_)),
        hit(hit_),
        at(tracer, ray, hit, nullptr, inside, 0),
        place(at),
        onward(at, 0) {}
  Vertex(const Vertex&) = delete;
  Vertex& operator=(const Vertex&) = delete;

  const Vec3& point() const { return hit.surface.point; }

  Ray ray;
  Interfaces inside;
  Hit hit;
  Interaction at;
  PathPlace place;
  Onward onward;
};

/// A place of a path, and how it continues from there toward the light.
struct Node {
  std::shared_ptr<const Vertex> vertex{};  ///< none: the lens, or the emitter and is no surface
  RayKind leaves = RayKind::camera;        ///< by which ray
  bool asked =
      false;        ///< lights of the scene were asked before the ray that arrives, which does not see them
  Color factor{1};  ///< factor of f: what is scattered, over the cosine
  Real eye = 0;     ///< density of continuing so
  Real kappa = 1;   ///< kappa of mirrors and glass: light's part of it over the part of what the camera sees
  Real edge = 0;    ///< G of the way to the next place; 0 from mirrors and glass
  // Worked out where somebody asks.
  std::shared_ptr<const Vertex> turned{};  ///< the place as a path from the light meets it
  std::optional<Real> light{};             ///< density of continuing toward the camera
};

struct Path {
  enum class End { open, lamp, seen, sky, light };

  std::size_t last() const { return nodes.size() - 1; }
  const Vertex& vertex(std::size_t i) const { return *nodes[i].vertex; }
  /// The direction in which it leaves the place toward the light.
  const Vec3& toLight(std::size_t i) const {
    return nodes[i + 1].vertex ? nodes[i + 1].vertex->ray.direction : towardEnd;
  }

  /// G of the edge between the place and the next, if the two may be joined; else 0.
  Real joins(std::size_t i) const {
    const bool spread = i + 1 == last() || nodes[i + 1].leaves == RayKind::bounce;
    return spread ? nodes[i].edge : 0;
  }

  std::size_t moment = 0;
  Vec2 film{}, lens{};
  Ray ray{};  ///< the camera's
  std::vector<Node> nodes{};
  End end = End::open;  ///< the emitter: an object, a light that is seen or asked, or the sky
  Vec3 towardEnd{};     ///< if that is no surface
  Color shines{};
  std::size_t light = 0;  ///< light of the scene, if one is asked
  Vec2 onLight{};
  Color f{};
  Real brightness = 0;  ///< brightness of f
};

/// Where a ray is to arrive.
struct Target {
  std::uint32_t object;
  std::uint64_t part;
  Vec3 point;
};
inline Target targetOf(const Hit& hit) { return {hit.object, hit.part, hit.surface.point}; }

/// Makes paths of one moment.
class Paths {
 public:
  Paths(const Stage& stage_, Tracer& tracer_) : stage(stage_), tracer(tracer_) {}

  // Each is false if there is no such path.

  /// The path is the lens, and looks at the place of the film.
  bool begin(Path& path, const Vec2& film, const Vec2& lens) const;
  /// It continues by such a ray, into the lobe in that direction, to the next surface or to an end that is
  /// none.
  bool follow(Path& path, RayKind kind, const Vec3& direction = {}) const;
  /// The same, to the target, at which the camera is aimed.
  bool follow(Path& path, RayKind kind, const Target& target) const;
  /// It ends at the surface where it is.
  bool endAtLamp(Path& path) const;
  /// It ends at a light of the scene.
  bool endAtLight(Path& path, std::size_t light, const Vec2& onLight) const;
  /// Joins the place where the path is with that of the other and all behind it, where the other continues by
  /// such a ray.
  bool attach(Path& path, RayKind kind, const Path& other, std::size_t first, RayKind leaves) const;

  /// Works out what has changed: the places `first` to `last`, and f.
  bool weigh(Path& path, std::size_t first, std::size_t last) const;
  /// Evaluates one vertex, behind which the path has another.
  bool weighPlace(Path& path, std::size_t i) const;

  /// The place as a path from the light meets it; none where that cannot be.
  const Vertex* turned(Path& path, std::size_t i) const;
  /// The density of continuing from there toward the camera.
  Real lightDensity(Path& path, std::size_t i) const;
  /// That of asking for the end, at the place before it.
  Real askDensity(const Path& path) const;
  /// That of starting at the end, per area.
  Real startDensity(const Path& path) const;

  const Stage& stage;
  Tracer& tracer;

 private:
  bool aim(Path& path, const Vec3& point, const Vec2& lens) const;
  Color fromLight(Path& path) const;
  bool allowed(const Path& path) const;
};

}  // namespace trace::veach
