// Every ray that one sample of a pixel took, with its numbers: what `ray explain` prints and the studio
// draws.
//
// Plain data. The Tracer and Gather (gather.h) fill it while an integrator works, when one is attached. A
// ray's radiance is what its terms say, in their order and to the last bit:
//
//   sum of (factor * value) over its terms, times `through`       camera, reflected and refracted rays
//   product of the factors of its crossings, 0 if blocked          shadow rays
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "geometry/materials.h"
#include "render/maps/photon_map.h"
#include "render/world/hit.h"
#include "render/world/interfaces.h"
#include "render/world/outside.h"
#include "render/world/statistics.h"
#include "scene/scene.h"

namespace trace {

/// One of the materials that a place is made of.
struct MaterialShare {
  std::uint32_t material = 0;  ///< index into Scene::materials, or MaterialMix::kClear
  Real weight = 1;
};
/// Each material of the mix once, in their order.
std::vector<MaterialShare> sharesOf(const MaterialMix& mix);

// --- why a ray ended: THE list; sentence() puts each in words ---

/// Met nothing: the background.
struct LeftScene {
  static constexpr std::string_view kName = "left-scene";
};
/// A camera ray hit something where the camera does not see; it shows the background.
struct CutOff {
  static constexpr std::string_view kName = "cut-off";
  std::uint32_t object;
  Real t;
  Real limit;                            ///< the camera's near, if that is more than t, or its far
  std::vector<MaterialShare> materials;  ///< there
};
/// Met only faces that --back-faces hides from it: the background.
struct Culled {
  static constexpr std::string_view kName = "culled";
  std::uint32_t object;  ///< the nearest of them
  Real t;
  std::vector<MaterialShare> materials;  ///< there
};
/// The surface sends no ray on.
struct Opaque {
  static constexpr std::string_view kName = "opaque";
};
struct DepthLimit {
  static constexpr std::string_view kName = "depth-limit";
  RayKind unsent;  ///< the ray that was not sent for it
  int limit;
};
struct BelowThreshold {
  static constexpr std::string_view kName = "below-threshold";
  RayKind unsent;
  Real contribution;  ///< the largest change of the sample that the unsent ray could make
  Real threshold;
};
/// Russian roulette ended the path: it would have resumed this chance, and counted so much the more.
struct Roulette {
  static constexpr std::string_view kName = "roulette";
  RayKind unsent;
  Real chance;
};
/// No ray is refracted.
struct TotalInternalReflection {
  static constexpr std::string_view kName = "total-internal-reflection";
};
/// A shadow ray hit something that lets no light through.
struct Blocked {
  static constexpr std::string_view kName = "blocked";
  std::uint32_t object;  ///< the nearest that transmits nothing
  std::uint64_t part;
  Real t;
  std::vector<MaterialShare> materials;  ///< there
};
/// A shadow ray reached its light.
struct ReachedLight {
  static constexpr std::string_view kName = "reached-light";
};
/// Met a light that is seen, before any surface.
struct MetLight {
  static constexpr std::string_view kName = "met-light";
  std::uint32_t light;  ///< index into Scene::lights
  Real t;
};
using RayEnd = std::variant<LeftScene, CutOff, Culled, Opaque, DepthLimit, BelowThreshold, Roulette,
                            TotalInternalReflection, Blocked, ReachedLight, MetLight>;

// --- what a ray brings back ---

/// The light of one source as a surface scatters it; the term's factor is arriving.scattered(scatter) share,
/// or the part of it that the material's `shadow` says.
struct LightTerm {
  std::uint32_t light = 0;  ///< index into Scene::lights
  Illumination arriving;
  Scatter scatter;
  Real share = 1;        ///< share among the rays to a light with a size: one of --light-samples
  Real probability = 1;  ///< with which the light was chosen among all, if they are many: share holds it, too
};

/// A light that was asked and gives the place nothing, whatever stands between; no ray was sent.
struct DarkTerm {
  enum class Why { unlinked, shinesElsewhere } why = Why::unlinked;
  std::uint32_t light = 0;  ///< index into Scene::lights
};

/// How a direction was chosen at random, and what the choice counts among the ways to come upon the same
/// light.
struct ChanceTerm {
  Real density = 0;  ///< density of the direction, per solid angle, with all choices that led to it; 0: there
                     ///< was one only
  Real other = 0;  ///< density of the other strategy: light sampling for a bounced ray, the surface for a ray
                   ///< to a lamp
  Real share = 1;  ///< MIS weight of this strategy: the power heuristic (Veach 1997, section 9.2.4)
  /// The emissive object of a light sample whose ray is a shadow ray: an index into Scene::objects, or kSky.
  static constexpr std::uint32_t kSky = 0xffffffffu;
  std::optional<std::uint32_t> lamp{};
};

/// A direction of that density, which another strategy gives with the density `other`.
inline ChanceTerm weighed(Real density, Real other) {
  return {density, other, other > 0 ? density * density / (density * density + other * other) : 1};
}

/// Photons that were counted, and the radius of the disk in which they lie.
struct PhotonTerm {
  std::size_t count = 0;
  Real radius = 0;
  std::vector<Photon> photons{};  ///< that they are, where a tree takes them
};

/// Light that was computed at some places before, and blended here.
struct CacheTerm {
  std::size_t records = 0;  ///< so many of them
};

/// A path that was put together of `light` places from the light's end and `camera` places from the camera's,
/// the camera itself among them. Each of its light + camera + 1 ways to be put together counts by how likely
/// it was.
struct ConnectionTerm {
  int light = 0, camera = 0;
  Real share = 1;  ///< MIS weight of this strategy: the power heuristic (Veach 1997, section 10.2)
};

/// The effect of a medium on light, and its position.
struct MediumTerm {
  enum class What { covers, glows, scatters, follows } what = What::covers;
  std::uint32_t object = 0;  ///< index into Scene::objects; Filling::kAir for fog
  Real t = 0;                ///< along the ray, of what is scattered
  Real forward = 0;          ///< the mean cosine there
};

/// Where light that comes out of a body went in.
struct BodyTerm {
  Real distance = 0;  ///< from the place where it comes out
  int steps = 0;      ///< number of scattering events; 0 for a profile
};

/// factor * value, a summand of a ray's radiance.
struct Term {
  enum class Kind {
    emissive,
    ambient,
    light,
    caustic,
    photons,
    reflection,
    refraction,
    bounce,
    lamp,
    joined,
    background,
    fog,
    medium,
    subsurface,
    hole,
    outline,
    irradiance
  };
  static constexpr std::array<std::string_view, 17> kNames{
      "emissive",   "ambient",    "light", "caustic", "photons",    "reflection",
      "refraction", "bounce",     "lamp",  "joined",  "background", "fog",
      "medium",     "subsurface", "hole",  "outline", "irradiance"};
  /// The ray of the term is one on which the path continues, not a shadow ray.
  bool goesOn() const {
    return ray >= 0 && (kind == Kind::reflection || kind == Kind::refraction || kind == Kind::bounce ||
                        kind == Kind::subsurface || kind == Kind::hole ||
                        (medium && medium->what == MediumTerm::What::follows));
  }
  Kind kind;
  Color factor, value;
  int ray = -1;  ///< the node whose radiance is the value; of a light: its shadow ray; -1: no ray was sent
  std::optional<LightTerm> light{};
  std::optional<ChanceTerm> chance{};
  std::optional<PhotonTerm> photons{};
  std::optional<ConnectionTerm> connection{};
  std::optional<MediumTerm> medium{};
  std::optional<BodyTerm> body{};
  std::optional<CacheTerm> cache{};
  std::optional<DarkTerm> dark{};
  std::optional<std::uint32_t> scattered{};  ///< by air or a medium: the light's index into Scene::lights
};

/// A surface at which nothing changes for light: the ray continued. There is a hole, or it is so by the rule
/// of nested glass, or the ray samples light and the surface casts no shadow.
struct Ignored {
  std::uint32_t object = 0;
  std::uint64_t part = 0;
  Real t = 0;
  bool leaving = false;
  Real opacity = 1;  ///< opacity of a hole, or of a partly open surface that was not hit: less than 1
  Filling body{};    ///< whose surface it is
  Filling around{};  ///< what fills the place on both sides
  bool shadowless = false;
};

/// A surface that a ray to a light went through.
struct Filter {
  std::uint32_t object = 0;
  std::uint64_t part = 0;
  Real t = 0;
  Color factor;  ///< by which it multiplied the light
  std::vector<MaterialShare> materials{};
  bool shadowless = false;  ///< the surface casts no shadow
};

struct RayNode {
  RayKind kind = RayKind::camera;
  int parent = -1, depth = 0;  ///< -1 and 0 for the camera ray
  Ray ray;
  Real tMost = kInfinity;                ///< for a shadow ray, the distance of the light
  std::optional<Hit> hit;                ///< not of shadow rays
  std::optional<Outside::View> outside;  ///< what it sees where it hits nothing
  std::vector<MaterialShare> materials;  ///< materials of the hit
  std::optional<Bsdf> bsdf;              ///< there
  Indices indices;                       ///< there
  std::optional<Vec3> raised;            ///< where rays from there to light start, if not at the hit
  std::vector<Ignored> ignored;          ///< on the way there, in order
  Real wavelength = 0;                   ///< in nanometres; 0: light of all colours
  std::vector<Term> terms;
  Color through{1};             ///< what the medium lets pass on the way back
  std::vector<Filter> filters;  ///< filters of a shadow ray, in order
  std::vector<RayEnd> ends;     ///< several where it sends neither of two rays; none where all were sent
  Color radiance;               ///< brought back; of a shadow ray: the share of the light that passes
  Color weight;                 ///< factor of the radiance in the pixel
  std::uint64_t nodes = 0;      ///< nodes of hierarchies, visited
  std::uint64_t tests = 0;      ///< tests of shapes and triangles
};

/// More rays than this are not recorded: a thousand bounces between two panes of glass take more than a
/// machine's memory.
inline constexpr std::size_t kMostRecordedRays = 200000;

/// nodes[0] is the camera ray; parents come before their children, in the order of tracing. Rays of a path
/// from a light are roots, too, the first of them; they bring nothing back.
struct RayTree {
  int x = 0, y = 0, sample = 0;
  int moment = -1;  ///< number of the moment while the shutter is open; -1: there is but one
  std::vector<RayNode> nodes;
};
inline const RayNode& rayAt(const RayTree& tree, int ray) {
  return tree.nodes[static_cast<std::size_t>(ray)];
}

/// The radiance of the node by its recorded terms and those of the rays below it.
Color recomputed(const RayTree& tree, int node = 0);

/// Every node's radiance is recomputed() of it, bit for bit; a NaN equals a NaN.
bool sumsUp(const RayTree& tree);

/// Sets every node's weight, from that of the camera ray: 1 / samples of the pixel.
void weigh(RayTree& tree, Real cameraWeight);

/// The term of the ray's parent that its radiance went into; null for the camera ray.
const Term* termOf(const RayTree& tree, int node);
/// The light that a ray samples, as an index into Scene::lights; nothing for other rays.
std::optional<std::uint32_t> lightOf(const RayTree& tree, int node);

/// "wall", or "sphere (scene.ray:12)" for an object without a name.
std::string objectName(const Scene& scene, std::uint32_t object);
/// objectName(), or "air".
std::string fillingName(const Scene& scene, std::uint32_t object);
/// "water (priority 1)", "air".
std::string fillingText(const Scene& scene, std::uint32_t object, Real priority);
/// "entering water at distance 2: it stays ball, whose priority 2 is above 1".
std::string sentence(const Ignored& ignored, const Scene& scene);
/// "red", "material 3" for one without a name, "clear" for MaterialMix::kClear.
std::string materialName(const Scene& scene, std::uint32_t material);
/// The name of a material, or "red 0.25 + blue 0.75".
std::string materialNames(const Scene& scene, const std::vector<MaterialShare>& materials);
/// Its name, or "point_light (scene.ray:7)".
std::string lightName(const Scene& scene, std::uint32_t light);
/// "it shines elsewhere (its cone, flaps, picture or back)".
std::string_view sentence(const DarkTerm& dark);
/// "scene.ray:12", without folders; "" for a place in no file.
std::string shortPlace(const SourcePlace& place);

/// Why the ray ended there, in plain words without a full stop: "left the scene: background". Names objects
/// as `scene` does.
std::string sentence(const RayNode& node, const Scene& scene);

}  // namespace trace
