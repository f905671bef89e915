// Emitters for a path tracer, objects and the environment: it samples points on them at random.
//
// An object is sampled as a light if its own material is emissive and it is a mesh, a square, a sphere, or
// another solid that a line crosses once or twice (body_lamp.h). Rays hit other emissive objects only at
// random. The probability of an object follows from its area and its colour, and where they have many parts
// also from the distance (render/world/light_tree.h). The environment is chosen half of the time, if its
// brightness varies or if portals show where it is visible.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "math/spherical_rectangle.h"
#include "render/lights/body_lamp.h"
#include "render/lights/sky_table.h"
#include "render/rays/tracer.h"
#include "render/world/light_tree.h"

namespace trace {

class Lamps {
 public:
  Lamps() = default;
  /// Where no ray hits lamps at random, the environment is one as soon as it is not the same all around.
  /// Places are then spread over areas, so that Whitted's pictures keep their bits.
  Lamps(const World& world, int threads, bool onlyHere = false);

  /// Is the object sampled as a light if it is emissive?
  static bool canSample(const World& world, std::uint32_t object);

  bool empty() const { return parts_.empty() && !choosesSky(); }
  /// There is nothing to choose but a place on it.
  bool isOne() const { return parts_.size() == 1 && !choosesSky(); }

  /// A place that was chosen.
  struct Place {
    std::uint32_t object;  ///< kNone: the environment
    std::uint64_t part;    ///< the triangle of a mesh
    Vec3 toLight;          ///< unit
    Real density;          ///< density of that direction, per solid angle
    Real distance;  ///< infinite to the environment; at least so far, until look() or sent() hit a body
  };
  /// By three numbers from 0 up to 1. Nothing where the part that was chosen is not seen from there.
  std::optional<Place> choose(const Vec3& from, Real which, const Vec2& u) const;
  /// The density with which choose() gives the direction in which a ray from `from` ends at `hit`, the place
  /// that it hit included; 0 for what is no lamp.
  Real density(const Vec3& from, const Hit& hit) const;
  /// The density for a ray that hit nothing.
  Real density(const Ray& ray) const { return choosesSky() ? skyShare() * skyDensity(ray) : 0; }
  /// Where a photon of an emissive object starts.
  struct Start {
    std::uint32_t object;
    Vec3 point, normal;  ///< unit
    bool twoSided;       ///< it shines on the other side, too
    Real size;           ///< size of the part: a length
    Real density;        ///< density of the place, per area of one side
  };
  /// By three numbers from 0 up to 1, and two more if hasBodies(). Nothing where no object shines, or the
  /// numbers miss the body that was chosen.
  std::optional<Start> start(const World& world, Real which, const Vec2& u, const Vec2& line) const;
  bool hasBodies() const { return !bodies_.empty(); }
  /// Its place as a ray of that kind finds it on the side of `normal`, so that the rounding error of the
  /// surface is known; whatever lies close to it. Nothing where such rays do not see that side.
  static std::optional<Hit> placeOf(Tracer& tracer, const Start& start, const Vec3& normal, RayKind kind);
  /// With which start() gives a place of that part of a lamp, per area and side; 0 for what is no lamp.
  Real startDensity(std::uint32_t object, std::uint64_t part) const;
  /// The density for the point that was hit.
  Real startDensity(const Hit& hit) const;
  /// The power of all these objects: the luminance of their flux.
  Real power() const { return power_; }
  /// Where a photon of the environment comes from.
  struct SkyStart {
    Vec3 toLight;
    Real density;  ///< per solid angle
  };
  SkyStart startOfSky(const Vec2& u) const;
  /// With which it gives that unit direction.
  Real skyStartDensity(const Vec3& toLight) const;

  /// Whether the ray to the place hit it: a Hit, or what was Found.
  template <class Meeting>
  bool met(const Place& place, const Meeting& at) const {
    if (place.object == kNone || at.object != place.object) return false;
    return parts_[first_[place.object]].kind != Part::Kind::triangle || at.part == place.part;
  }
  /// The radiance of the place along the ray to it, which starts in `inside`; 0 if something is in the way
  /// that is no pane (Tracer::passedPanes). `chance` is Tracer::chance().
  Color look(Tracer& tracer, const Ray& ray, Place& place, const Interfaces& inside, Real chance) const;
  /// The radiance that the place sends along that ray to it, whatever is in the way.
  Color sent(Tracer& tracer, const Ray& ray, Place& place) const;
  /// The part of the way to a place that ends before it.
  static constexpr Real kBefore = 1 - 1e-6;

 private:
  /// A triangle, a parallelogram, a rectangle whose places are spread as they are seen, a sphere, or another
  /// body; in world space.
  struct Part {
    enum class Kind { triangle, parallelogram, rectangle, sphere, body } kind;
    std::uint32_t object;
    Vec3 origin;         ///< a corner, or the middle
    Vec3 edgeA, edgeB;   ///< from the corner
    Real size;           ///< the area, or the radius; of a body, that of the ball around it
    Real share;          ///< share of all choices, where they are few
    std::size_t body{};  ///< which of the bodies
    Vec3 normal = cross(edgeA, edgeB);
    Real normalLength = length(normal);
    Vec3 middle = origin + (edgeA + edgeB) * 0.5;  ///< the middle of a parallelogram
    bool round() const { return kind == Kind::sphere || kind == Kind::body; }
    /// The density of the direction to `at`, which lies on the part, if the part is chosen; not of bodies.
    Real density(const Vec3& from, const Vec3& at) const;
    /// A rectangle as it is seen from there, where that differs from its area as seen from far away.
    std::optional<SphericalRectangle> seen(const Vec3& from) const {
      constexpr Real kLarge = 0.3;  // steradians; what is seen smaller is seen alike from everywhere on it
      const Vec3 to = middle - from;
      return kind != Kind::rectangle || size < kLarge * dot(to, to) ? std::nullopt : seenLarge(from);
    }
    std::optional<SphericalRectangle> seenLarge(const Vec3& from) const;
    /// Its density per area, for a way there of that length.
    Real densityByArea(const Vec3& to, Real away2, Real away) const {
      const Real facing = std::abs(dot(to, normal)) / (away * normalLength);
      return facing > 0 ? away2 / (facing * size) : 0;
    }
    LightReach reach(Real power) const;
  };
  /// `sides` of that area shine.
  void add(const Part& part, Real area, Real sides, const Color& emissive);
  /// The density of the direction from there to the place on it, if the part is chosen.
  Real density(const Part& part, const Vec3& from, const Vec3& at) const;
  /// The density of starting at a place of it, per area and side, of all choices.
  Real perArea(const Part& part) const;
  bool isBody(const Place& place) const {
    return place.object != kNone && parts_[first_[place.object]].kind == Part::Kind::body;
  }
  /// The part that a number from 0 up to 1 chooses.
  std::size_t partOf(Real which) const;
  /// Where two numbers from 0 up to 1 lie on a flat part.
  static Vec3 placeOn(const Part& part, const Vec2& u);
  const Part& partOf(std::uint32_t object, std::uint64_t part) const {
    const bool mesh = parts_[first_[object]].kind == Part::Kind::triangle;
    return parts_[first_[object] + (mesh ? part : 0)];
  }
  bool isLamp(std::uint32_t object) const {
    return object < first_.size() && !parts_.empty() && first_[object] != kNone;
  }
  bool choosesSky() const { return !sky_.empty() || !portals_.empty(); }
  /// How often the environment is chosen, and how often of these by its brightness, not through a portal.
  Real skyShare() const { return !choosesSky() ? 0 : parts_.empty() ? 1 : 0.5; }
  Real tableShare() const { return sky_.empty() ? 0 : portals_.empty() ? 1 : 0.5; }
  Vec3 towardSky(const Vec3& from, Real which, const Vec2& u) const;
  Real skyDensity(const Ray& ray) const;
  /// The part that the number chooses for a place, and how often.
  std::pair<std::size_t, Real> chosenPart(const Vec3& from, Real which) const;
  Real shareOf(std::size_t part, const Vec3& from) const {
    return tree_.empty() ? parts_[part].share
                         : tree_.probability(from, nullptr, static_cast<std::uint32_t>(part));
  }
  /// Nothing has to be known of the place but that the ray to it hit it.
  bool isPlain(const Tracer& tracer, const Place& place, const Interfaces& inside) const;

  SkyTable sky_;
  std::vector<LightGeometry> portals_;
  std::vector<Part> parts_;
  std::vector<BodyLamp> bodies_;
  LightTree tree_;  ///< over the parts, where they are many
  Real power_ = 0;
  bool clear_ = false;      ///< nothing that a ray meets on its way lets a part of the light through
  std::vector<Real> sums_;  ///< sums of the shares, up to and with each part
  std::vector<std::uint32_t> first_;  ///< first part of each object; kNone for no lamp
  static constexpr std::uint32_t kNone = Tracer::kSky;
};

}  // namespace trace
