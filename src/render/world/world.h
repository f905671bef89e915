// The scene for tracing: baked, indexed and immutable.
//
// compile() multiplies out what a render asks again and again (inverse transforms, bounds, hierarchies,
// generated normals) and applies the conventions that concern materials and camera. It uses the scene's own
// shape and light structs; names and files stay behind.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

#include "accel/bvh.h"
#include "base/budget.h"
#include "geometry/materials.h"
#include "geometry/mesh/mesh.h"
#include "geometry/mesh/mesh_tree.h"
#include "geometry/placement.h"
#include "geometry/surface_slopes.h"
#include "geometry/traced.h"
#include "render/world/hit.h"
#include "render/world/interfaces.h"
#include "render/world/light_tree.h"
#include "render/world/outside.h"
#include "render/world/statistics.h"
#include "scene/groups.h"
#include "scene/scene.h"
#include "shading/lights/light.h"
#include "shading/medium.h"
#include "shading/optics/differentials.h"

namespace trace {

/// A crossing of a ray with an object of the world.
struct Found {
  Real t = kInfinity;
  std::uint32_t object = 0;  ///< its number: index into Scene::objects, or of a placed one (scene/groups.h)
  std::uint64_t part = 0;    ///< the crossing's part of an analytic shape, or the triangle of a mesh
  TriangleHit triangle;      ///< triangle of a mesh

  /// Nearer first; at the same distance the earlier object, then the earlier part.
  bool after(Real otherT, std::uint32_t otherObject, std::uint64_t otherPart) const {
    if (t != otherT) return t > otherT;
    return object != otherObject ? object > otherObject : part > otherPart;
  }
  bool before(const Found& other) const { return other.after(t, object, part); }
};

/// Which mesh triangles a query sees: all; those whose face turns to the ray; those of which both the face
/// and the normal for shading, interpolated at the hit, turn to it.
enum class Faces { both, front, shadedFront };

inline bool sees(Faces faces, const Ray& ray, const MeshData& mesh, const MeshHit& met) {
  if (faces == Faces::both || mesh.twoSided) return true;
  if (faces == Faces::front || mesh.normals.empty() || !met.hit.front) return met.hit.front;
  return dot(surface(mesh, met.triangle, met.hit).shading, ray.direction) < 0;
}

/// Anything that takes a Found and returns true to end the query, behind a plain call. It lives as long as
/// the visitor.
class VisitFound {
 public:
  template <class Visit>
  requires(!std::is_same_v<std::remove_cvref_t<Visit>, VisitFound>)
      VisitFound(Visit&& visit)  // NOLINT(google-explicit-constructor)
      : context_(const_cast<void*>(static_cast<const void*>(&visit))),
        call_([](void* context, const Found& f) -> bool {
          return (*static_cast<std::remove_reference_t<Visit>*>(context))(f);
        }) {}
  bool operator()(const Found& found) const { return call_(context_, found); }

 private:
  void* context_;
  bool (*call_)(void*, const Found&);
};

struct Compiled;

class World {
 public:
  /// The nearest crossing at 0 < t < tMost. Here and below the Statistics count what it takes, or other
  /// QueryCounts.
  template <class Nodes>
  std::optional<Found> closest(const Ray& ray, Faces faces, QueryCounts<Nodes>& counts,
                               Real tMost = kInfinity) const;

  /// Finds it for each of at most RayPacket::kRays rays, which leave nothing. Rays that go the same way are
  /// faster together. The t of what is found is infinite where nothing is hit.
  void closest(std::span<const Ray* const> rays, Faces faces, Statistics& counts,
               std::span<Found* const> found) const;

  /// Calls visit(Found) for every crossing at 0 < t < tMost, in no particular order; ends when it returns
  /// true. The way to ask whether anything is hit at all. A triangle that its hierarchy holds in parts may be
  /// hit more than once.
  template <class Nodes>
  void crossings(const Ray& ray, Real tMost, Faces faces, QueryCounts<Nodes>& counts,
                 VisitFound visit) const {
    crossAll<Nodes>({ray, tMost, faces, false, counts, visit});
  }
  /// Crossings for light: whether an opaque object that casts a shadow, which is not
  /// visited, or visit(Found) has ended it.
  template <class Nodes>
  bool occluded(const Ray& ray, Real tMost, Faces faces, QueryCounts<Nodes>& counts, VisitFound visit) const {
    return crossAll<Nodes>({ray, tMost, faces, true, counts, visit});
  }

  /// Calls visit(Found) for every crossing of that object at 0 < t < tMost, in no particular order.
  void crossingsOf(std::uint32_t object, const Ray& ray, Real tMost, Statistics& statistics,
                   VisitFound visit) const;

  /// The place found, in world space; `ray` is the ray that found it.
  SurfacePoint surface(const Ray& ray, const Found& found) const;
  /// Some material casts no shadow.
  bool hasShadowless() const { return hasShadowless_; }
  /// Whether at least half of the materials there cast a shadow.
  bool castsShadow(const Found& found) const { return !hasShadowless_ || shadows(materialMix(found)); }
  bool castsShadow(const Hit& hit) const { return !hasShadowless_ || shadows(hit.materials); }
  /// Some material lets light straight through, as thin glass does.
  bool hasPanes() const { return hasPanes_; }
  /// The materials at the hit point: the material of the object, of the part of it, or those of the corners
  /// of its triangle.
  MaterialMix materialMix(const Found& found) const { return mixAt(instanceOf(found.object), found); }
  /// Some material has holes, or is not wholly there.
  bool hasHoles() const { return hasHoles_; }
  /// The share of the surface that is there: through the rest a ray goes straight on.
  Real opacityAt(const Ray& ray, const Found& found) const;
  /// Sets the opacity of the hit, and takes what is not there out of its materials.
  void pierce(Hit& hit) const {
    if (hasHoles_) hit.opacity = pierce(hit.object, hit.part, hit.surface, hit.materials);
  }
  /// How texture coordinates and the normal change along the surface, in world space.
  SurfaceSlopes slopes(const Hit& hit) const { return slopes(hit.object, hit.part, hit.surface); }
  /// Slopes of the second texture coordinates of a mesh.
  SurfaceSlopes secondSlopes(const Hit& hit) const;
  /// The frame of normal maps, in world space, where the points of a mesh give it.
  std::optional<TangentFrame> givenFrame(const Hit& hit) const;
  /// Where textures are asked for the place; with the footprint of the ray that has arrived there, if any.
  TexturePlace place(const Hit& hit, const Differentials* arrived = nullptr) const {
    return place(hit.object, hit.part, hit.surface, arrived);
  }
  /// The Bsdf at the hit point; textures are filtered by the footprint of the ray, if any.
  PlaceBsdf shade(const Hit& hit, const Differentials* arrived = nullptr) const {
    return shade(hit.object, hit.part, hit.materials, hit.surface, arrived);
  }
  /// The Bsdf of a hit on one material without textures; null for others.
  const Bsdf* plainBsdf(const Hit& hit) const {
    const std::uint32_t only = hit.materials.material[0];
    if (hit.materials.count != 1 || only == MaterialMix::kClear || surfaces_[only].textured) return nullptr;
    return &surfaces_[only].bsdf;
  }
  /// The place on a mesh moved outward to where the planes lie that touch the smooth surface at the corners
  /// of its triangle, by the weights of the corners (Hanika, Hacking the Shadow Terminator, Ray Tracing Gems
  /// II, 2021, chapter 4, listing 4-1). `turned`: outward is where the normals do not point. Nothing where
  /// that is no farther out, and for what has no normals of its own.
  std::optional<SurfacePoint> raised(const Hit& hit, bool turned) const;
  /// Some texture is filtered by footprint: rays should have Differentials.
  bool wantsFootprints() const { return wantsFootprints_; }
  /// Bends the normals for shading by the material's bump textures, if it has some; `ray` found the place.
  void bump(const Ray& ray, Hit& hit) const {
    if (hasBumps_) bend(ray, hit);
  }
  /// `ray` is the ray that found the place.
  PlaceBsdf bsdfAt(const Ray& ray, const Found& found) const;
  /// For a Bsdf of the place, with its normal as the integrator turned it. Where no texture coordinates are
  /// asked for, u grows around the object's own axis z.
  Frame frame(const Hit& hit, const Bsdf& bsdf, const Vec3& normal) const {
    const bool turned = dot(normal, hit.surface.shading) < 0;
    return {normal, hasGrain(bsdf) ? along(hit) : Vec3{}, turned, turned ? -hit.coat : hit.coat};
  }
  /// The part of it that the rays of a light pass through.
  Color filter(const Ray& ray, const Found& found) const {
    const Color filter = whitted(*bsdfAt(ray, found)).transmissive;
    return hasHoles_ ? lerp(opacityAt(ray, found), Color(1), filter) : filter;
  }
  /// The transform of the object or of the placement with that number.
  Affine worldFromObject(std::uint32_t object) const {
    return object < plain_ ? objects_[object].placement.outFromIn() : placedTransform(object);
  }
  /// Whether the place is shaded from both sides: on a mesh that is, or of a material that is.
  bool twoSided(std::uint32_t object, const MaterialMix& materials) const {
    const auto& mesh = instanceOf(object).mesh;
    return (mesh && mesh->data().twoSided) || (hasTwoSided_ && twoSided(materials));
  }
  /// A ray that leaves the object on the side of its normal does not hit it again.
  bool convex(std::uint32_t object) const { return instanceOf(object).convex; }
  /// Its parts shade one another, and are not entered and left (geometry/shape_list.h).
  bool strands(std::uint32_t object) const { return instanceOf(object).strands; }
  /// It encloses space; a mesh does if it is closed.
  bool solid(std::uint32_t object) const { return instanceOf(object).solid; }
  /// Nested and overlapping glass objects are distinguished.
  bool nestedGlass() const { return nestedGlass_; }
  /// The interior of the object at a point on it that looks like `terms`, by the conventions of a render.
  Filling filling(const Hit& hit, const WhittedTerms& terms, const Settings& settings) const;
  /// The media that a ray from the point starts in.
  Interfaces interfacesAt(const Vec3& point, const Settings& settings) const;
  /// A body that a medium fills. One without a surface is a cloud: light hits it nowhere.
  struct MediumBody {
    std::uint32_t object;
    bool cloud;
    MediumModel model;
    Box3 bounds;
  };
  const std::vector<MediumBody>& media() const { return media_; }
  /// The medium of that body at a point in it.
  Medium mediumAt(const MediumBody& body, const Vec3& point) const;
  /// Light goes into some body and comes out elsewhere (shading/materials/subsurface.h).
  bool hasSubsurface() const { return hasSubsurface_; }

  /// Every part of the object blocks rays to lights.
  bool blocks(std::uint32_t object) const { return instanceOf(object).blocks; }
  /// No part of the object transmits light.
  bool opaque(std::uint32_t object) const { return instanceOf(object).opaque; }

  /// In world space; empty of one that is left out.
  Box3 boundsOf(std::uint32_t object) const {
    return object < plain_ ? objects_[object].bounds : placedBounds(object);
  }
  /// In its own space, perhaps with room left.
  Box3 ownBoundsOf(std::uint32_t object) const { return shapes_[instanceOf(object).form].bounds(); }
  /// The object's shape, "" of one that is left out.
  std::string_view shapeOf(std::uint32_t object) const {
    const Instance& o = instanceOf(object);
    return o.bounds.empty() ? "" : shapes_[o.form].type().keyword;
  }
  /// All of it is made of one material, without textures.
  bool isUniform(std::uint32_t object) const {
    const Instance& o = instanceOf(object);
    return !o.mixed && !surfaces_[o.material].textured;
  }
  /// Its material where its parts say nothing else; without its textures.
  const WhittedTerms& termsOf(std::uint32_t object) const {
    return whitted(bsdf(instanceOf(object).material));
  }

  /// Whether something of its surface mirrors or refracts rays into one direction, or, unless they `follow`
  /// lobes, into a lobe. With `varnish` what has an index of refraction mirrors.
  bool sendsOn(std::uint32_t object, bool varnish, bool follow) const {
    return sendsOnOf(instanceOf(object), varnish, follow);
  }

  const CameraFrame& camera() const { return camera_; }
  const std::vector<Light>& lights() const { return lights_; }
  /// The place in Scene::lights of the light of that number.
  std::uint32_t lightSource(std::size_t light) const { return lightSources_[light]; }
  const Rules& rules() const { return rules_; }
  /// The light that arrives at a point from the light of that number, if nothing is in the way: from the
  /// place of the light that `u` chooses, two numbers from 0 up to 1.
  std::optional<Illumination> illuminate(std::size_t light, const Vec3& from, const Vec2& u = kCenter) const {
    return lights_[light].illuminate(from, rules_, u);
  }
  bool lightHasSize(std::size_t light) const { return lights_[light].hasSize(); }
  /// Where its rays start.
  const LightGeometry& lightGeometry(std::size_t light) const { return lightGeometries_[light]; }
  /// The light of that number lights the object.
  bool lights(std::size_t light, std::uint32_t object) const {
    const std::vector<bool>& lit = litObjects_[light];
    return lit.empty() || lit[physical(object)];
  }
  /// Objects block the light of that number.
  bool lightCastsShadows(std::size_t light) const { return castShadows_[light]; }
  bool hasShadowlessLights() const {
    return std::find(castShadows_.begin(), castShadows_.end(), false) != castShadows_.end();
  }
  /// A choice among lights().
  const LightTree& lightTree() const { return *lightTree_; }
  const std::vector<LightGeometry>& portals() const { return portals_; }
  /// A light that a ray hits.
  struct Lamp {
    std::uint32_t light;  ///< its place in Scene::lights
    LightSeen seen;
  };
  /// The nearest of those that rays see, before t.
  std::optional<Lamp> lampAlong(const Ray& ray, Real t) const {
    return visibleLights_.empty() ? std::nullopt : nearestLamp(ray, t);
  }
  const Color& ambient() const { return ambient_; }  ///< the sum of all ambient lights
  /// The environment that rays see when they hit nothing.
  const Outside& outside() const { return outside_; }
  const Box3& bounds() const { return bounds_; }  ///< bounds of the finite objects
  /// The number of objects that are no part of a group.
  std::size_t objectCount() const { return plain_; }
  /// Their numbers, and those of the objects of each group where it is placed first.
  std::vector<std::uint32_t> kindsOfObjects() const;
  /// A number that placements have or objects in them.
  bool isPlaced(std::uint32_t number) const { return number >= plain_; }
  std::size_t placementCount() const;
  /// The bounds of all placements whose objects mirror or refract rays into one direction (sendsOn).
  Box3 placedThatSendOn(bool varnish, bool follow) const;
  const Bvh& hierarchy() const { return *bvh_; }  ///< over the objects that have an end
  /// The tree of an object that is a mesh; null for others and for what is left out.
  const MeshTree* meshTree(std::uint32_t object) const { return instanceOf(object).mesh.get(); }
  /// Triangles of meshes; those in groups count once.
  std::size_t triangleCount() const;
  /// The size of the hierarchies and of placements, without the meshes' own arrays.
  std::size_t bytes() const;

 private:
  friend World compile(const Scene&, const Settings&, Messages&, const Compiled*);
  class Earlier;

  struct Instance {          // what queries need stands together
    std::uint32_t kind = 0;  ///< the index of the shape's type
    bool opaque = true;
    bool blocks = true;  ///< opaque, and all of it casts a shadow
    bool convex = false;
    bool strands = false;
    bool solid = false;
    bool mixed = false;            ///< parts of it are made of other materials
    bool patternsInWorld = false;  ///< as its material says, or one of several
    bool mapped = true;            ///< pictures lie on it by u and v; else they show one corner
    bool holds = false;            ///< a ray may start inside of it: light passes it, and it encloses space
    std::uint32_t material = 0;
    std::uint32_t form = 0;  ///< index into shapes_ and Forms, which objects share: a million balls have one
    std::shared_ptr<const MeshTree> mesh;  ///< shared by all objects that name the same data
    Placement placement;
    Box3 bounds;
  };

  /// Placements of a group, in the world or in another group.
  struct Uses {
    std::uint32_t group;
    std::uint32_t firstUse;     ///< number of the first placement
    std::uint32_t firstObject;  ///< number of the first object of the first placement
    std::shared_ptr<const GroupUses::List> list;
  };
  /// A group of the scene: what its placements have in common.
  struct Group {
    std::uint32_t first = 0,
                  count = 0;    ///< its objects in objects_, in whose space `bounds` are those of the group
    std::uint32_t numbers = 0;  ///< how many numbers a placement takes
    std::vector<Uses> uses{};
    std::shared_ptr<const Bvh> bvh{};  ///< over objects and placements, by their numbers in the group
    Box3 box{};
    bool holds = false;  ///< something of it does
  };
  /// A number, resolved.
  struct Located {
    std::uint32_t object;  ///< index into objects_; Bvh::kNoItem for the number of a placement
    int levels = 0;
    const Affine* steps[kMostGroupLevels];  ///< the outermost placement first
  };
  Located locate(std::uint32_t number) const;
  /// The index into objects_ of the object with that number.
  std::uint32_t physical(std::uint32_t number) const {
    return number < plain_ ? number : locate(number).object;
  }
  const Instance& instanceOf(std::uint32_t number) const { return objects_[physical(number)]; }
  bool sendsOnOf(const Instance& instance, bool varnish, bool follow) const;
  Affine placedTransform(std::uint32_t number) const;
  Affine objectFromWorld(std::uint32_t number) const {
    return number < plain_ ? objects_[number].placement.inFromOut() : inverse(placedTransform(number));
  }
  Box3 placedBounds(std::uint32_t number) const;
  void addGroups(const Scene& scene, const Settings& settings);
  std::vector<Uses> usesOf(const std::vector<GroupUses>& uses, std::size_t objects) const;
  /// The boxes of placements, in the space in which they are placed; `all` grows around them.
  void addBoxes(const std::vector<Uses>& uses, std::vector<BoxedItem>* items, Box3& all) const;
  /// Over objects with these boxes, and placements in the world.
  std::shared_ptr<const Bvh> topHierarchy(const std::vector<Box3>& boxes, const Settings& settings) const;

  // Queries, object by object. What is rarer than a mesh seen from both sides is kept apart, so that the way
  // to a mesh stays short; in the tree there is one copy of it.
  template <class Nodes>
  void closestOf(std::uint32_t object, const Ray& worldRay, Faces faces, QueryCounts<Nodes>& counts,
                 Found& best) const;
  template <class Nodes>
  [[gnu::noinline]] bool closestSeen(std::uint32_t object, const Ray& ray, Faces faces,
                                     QueryCounts<Nodes>& counts, MeshHit& met) const;
  /// For the rays of those lanes.
  void closestTogether(std::uint32_t object, std::span<const Ray* const> rays, unsigned lanes, Faces faces,
                       Statistics& counts, std::span<Found* const> best) const;
  /// Whether the faces include the triangle that was hit; the ray is in the space of the object, a mesh.
  bool included(Faces faces, std::uint32_t object, const Ray& ray, const MeshHit& met) const {
    if (sees(faces, ray, objects_[object].mesh->data(), met)) return true;
    return hasTwoSided_ && twoSided(mixAt(objects_[object], {met.hit.t, object, met.triangle, met.hit}));
  }
  template <class Nodes>
  [[gnu::noinline]] void closestOfShape(const Instance& instance, std::uint32_t object, const Ray& ray,
                                        QueryCounts<Nodes>& counts, Found& best) const;
  /// The nearest crossing in a placement; the ray and numbers are those of the space around it.
  struct Around {
    const Ray& ray;
    Faces faces;
    std::uint32_t base;  ///< what is added to a number there to make one of the world
  };
  template <class Nodes>
  [[gnu::noinline]] void closestInUse(std::uint32_t use, const std::vector<Uses>& uses, const Around& around,
                                      QueryCounts<Nodes>& counts, Found& best) const;
  /// The query of all crossings.
  template <class Nodes>
  struct Across {
    const Ray& ray;  ///< in world space
    Real tMost;
    Faces faces;
    bool opaqueEnds;  ///< a crossing with what blocks light ends the query unvisited
    QueryCounts<Nodes>& counts;
    VisitFound visit;
  };
  /// Whether something ended the query; here and below.
  template <class Nodes>
  bool crossAll(const Across<Nodes>& query) const;
  template <class Nodes>
  bool crossObject(std::uint32_t object, const Across<Nodes>& query) const;
  template <class Nodes>
  [[gnu::noinline]] bool crossMesh(std::uint32_t object, const Ray& ray, const Across<Nodes>& query) const;
  template <class Nodes>
  [[gnu::noinline]] bool crossShape(std::uint32_t object, const Ray& ray, const Across<Nodes>& query) const;

  template <class Nodes>
  [[gnu::noinline]] bool crossUse(std::uint32_t use, const std::vector<Uses>& uses, std::uint32_t base,
                                  const Across<Nodes>& query) const;

  MaterialMix mixAt(const Instance& instance, const Found& found) const {
    return instance.mixed ? mixOfParts(instance, found) : MaterialMix::only(instance.material);
  }
  [[gnu::noinline]] MaterialMix mixOfParts(const Instance& instance, const Found& found) const;
  /// On an object of objects_; the ray is in the space that it stands in.
  SurfacePoint surfaceOn(std::uint32_t object, const Ray& ray, const Found& found) const;
  [[gnu::noinline]] SurfacePoint placedSurface(const Ray& ray, const Found& found) const;
  /// The direction in which u grows.
  Vec3 along(const Hit& hit) const;

  /// Calls visit(Crossing) for every crossing of an analytic shape at 0 < t <= tMost, which may shrink during
  /// the calls, and for others; the ray is in its space.
  template <class Nodes, class Visit>
  void crossingsOfShape(std::uint32_t object, const Ray& ray, const Real& tMost, QueryCounts<Nodes>& counts,
                        const Visit& visit) const;

  /// The lens is focused on the place that the settings name, or what the middle of the picture shows; on
  /// infinity if that is nothing.
  void focus(const Scene& scene, const Settings& settings);
  /// Where the camera sees the objects of that name. Throws Error(Fault::usage) if there are none.
  Vec3 seenPlaceOf(const std::string& name, const Scene& scene) const;
  std::optional<std::uint32_t> nearestPlaced(const std::string& name, const Scene& scene) const;

  struct Forms;  ///< complete in world_queries.cpp
  std::optional<Lamp> nearestLamp(const Ray& ray, Real t) const;
  void addLights(const Scene& scene, const Settings& settings, Messages& messages);
  /// Takes the forms out of all shapes, to lie side by side.
  void collectForms();

  std::vector<Instance> objects_;  ///< those of the scene, then those of its groups
  std::uint32_t plain_ = 0;        ///< how many are no part of a group
  std::vector<Group> groups_;
  std::vector<Uses> uses_;   ///< placements in the world
  bool placedHold_ = false;  ///< some placed object holds rays
  std::vector<TracedShape> shapes_;
  std::shared_ptr<const Forms> forms_;  ///< forms of shapes_
  std::shared_ptr<const Bvh> bvh_;
  std::vector<std::uint32_t> always_;  ///< objects that every ray may hit: those infinite, which no
                                       ///< hierarchy can hold; where there is no tree, all
  static const Bsdf& clear();          ///< what is seen through as if it were not there

  /// A material of the scene.
  struct Surface {
    Bsdf bsdf;                                 ///< without its textures
    std::shared_ptr<const Material> textured;  ///< null if it has none
    std::uint32_t kind = 0;                    ///< Filling::kind, where glass may be nested
    Real opacity = 1;                          ///< where it has no texture
    bool hasHoles = false;                     ///< some of it may not be there
    bool twoSided = false;                     ///< shaded from both sides
    bool castsShadow = true;
  };
  /// The BSDF of one of the scene's materials, or of MaterialMix::kClear.
  const Bsdf& bsdf(std::uint32_t material) const {
    return material == MaterialMix::kClear ? clear() : surfaces_[material].bsdf;
  }
  bool textured(const MaterialMix& materials) const {
    return std::any_of(materials.material, materials.material + materials.count,
                       [&](std::uint32_t m) { return m != MaterialMix::kClear && surfaces_[m].textured; });
  }
  bool twoSided(const MaterialMix& materials) const {
    return std::any_of(materials.material, materials.material + materials.count,
                       [&](std::uint32_t m) { return m != MaterialMix::kClear && surfaces_[m].twoSided; });
  }
  bool shadows(const MaterialMix& materials) const;
  PlaceBsdf shade(std::uint32_t object, std::uint64_t part, const MaterialMix& materials,
                  const SurfacePoint& surface, const Differentials* arrived) const {
    if (materials.count == 1) {
      const std::uint32_t only = materials.material[0];
      if (only == MaterialMix::kClear) return PlaceBsdf(clear());
      if (const Surface& s = surfaces_[only]; !s.textured) return PlaceBsdf(s.bsdf);
    }
    return PlaceBsdf(mixedAt(object, part, materials, surface, arrived));
  }
  [[gnu::noinline]] Bsdf mixedAt(std::uint32_t object, std::uint64_t part, const MaterialMix& materials,
                                 const SurfacePoint& surface, const Differentials* arrived) const;

  SurfaceSlopes slopes(std::uint32_t object, std::uint64_t part, const SurfacePoint& surface) const;
  TexturePlace place(std::uint32_t object, std::uint64_t part, const SurfacePoint& surface,
                     const Differentials* arrived) const;
  TexturePlace placeInObject(std::uint32_t object, std::uint64_t part, const SurfacePoint& surface,
                             const Differentials* arrived) const;

  void bend(const Ray& ray, Hit& hit) const;
  /// The normal for shading bent by the textures of `bump`, or of `clearcoat_bump`.
  enum class Bent { surface, coat };
  Vec3 bentNormal(const Ray& ray, const Hit& hit, Bent what) const;
  /// The opacity there; `materials` become those of what is there.
  Real pierce(std::uint32_t object, std::uint64_t part, const SurfacePoint& surface,
              MaterialMix& materials) const;

  std::vector<Surface> surfaces_;  ///< surfaces of the scene's materials
  bool wantsFootprints_ = false, footprintsInUv_ = false, hasBumps_ = false, hasHoles_ = false,
       hasTwoSided_ = false, hasShadowless_ = false, hasPanes_ = false;
  Rules rules_;
  std::vector<Light> lights_;
  std::vector<LightGeometry> lightGeometries_;
  std::vector<std::uint32_t> lightSources_;
  std::vector<bool> castShadows_;              ///< by each light
  std::vector<std::vector<bool>> litObjects_;  ///< by each light; none: all
  std::vector<std::uint32_t> visibleLights_;
  std::shared_ptr<const Bvh> visibleBoxes_;  ///< over these
  std::shared_ptr<const LightTree> lightTree_;
  std::vector<LightGeometry> portals_;
  bool nestedGlass_ = false;
  std::vector<std::uint32_t> glass_;  ///< solid objects that light passes, where a ray may start in one
  std::vector<MediumBody> media_;
  bool hasSubsurface_ = false;
  Color ambient_;
  CameraFrame camera_;
  Outside outside_;
  Box3 bounds_;
};

/// A World that was made before, and of what.
struct Compiled {
  const Scene& scene;
  const Settings& settings;
  const World& world;
};

/// Scene -> World. Repairs with warnings what can be repaired; throws Error(Fault::scene) for the rest.
/// What is as in `before` (hierarchies, prepared shapes) is shared with it instead of made again.
World compile(const Scene& scene, const Settings& settings, Messages& messages,
              const Compiled* before = nullptr);

}  // namespace trace
