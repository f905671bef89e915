// A World of a Scene: hierarchies, displaced meshes, materials as the settings want them. What an edit left
// alone is taken over from the world before.
#include <algorithm>
#include <array>
#include <map>
#include <tuple>

#include "base/match.h"
#include "geometry/mesh/mesh_closed.h"
#include "geometry/shapes/solids/cone.h"
#include "geometry/shapes/solids/sphere.h"
#include "render/world/number_range.h"
#include "render/world/world.h"
#include "scene/displacement.h"
#include "scene/picture_size.h"
#include "scene/scene_features.h"
#include "shading/materials/subsurface.h"

namespace trace {
/// Hierarchies of meshes, by the data of the scene and what displaces it.
class TreesOfMeshes {
 public:
  using Tree = std::shared_ptr<const MeshTree>;
  /// The place for the one of the mesh; null until it is given one.
  Tree& of(const MeshData* data, const Displacement& displacement) {
    if (Tree* found = find(data, displacement)) return *found;
    return trees_.emplace(data, std::pair(displacement, Tree()))->second.second;
  }
  /// Null if there is none.
  Tree find(const MeshData* data, const Displacement& displacement) const {
    Tree* found = const_cast<TreesOfMeshes*>(this)->find(data, displacement);
    return found ? *found : nullptr;
  }

 private:
  Tree* find(const MeshData* data, const Displacement& displacement) {
    const auto [first, last] = trees_.equal_range(data);
    const auto found =
        std::find_if(first, last, [&](const auto& entry) { return entry.second.first == displacement; });
    return found == last ? nullptr : &found->second.second;
  }

  std::multimap<const MeshData*, std::pair<Displacement, Tree>> trees_;
};

namespace {

std::shared_ptr<const Bvh> hierarchy(std::span<const Box3> boxes, const Settings& settings) {
  return std::make_shared<const Bvh>(settings.accel == Accel::none
                                         ? Bvh::bruteForce(boxes)
                                         : Bvh(boxes, Bvh::Leaves::single, settings.threads));
}

/// The materials as the settings want them.
std::vector<Material> shownAs(std::vector<Material> materials, const Settings& settings) {
  for (Material& material : materials) {
    if (!settings.textures) {
      if (textureOf(material.textures, "displacement")) material.displacement = 0;
      material.textures.clear();
    }
    material = withoutFeatures(std::move(material), settings.switchedOff);
    if (settings.models == Models::phong && !material.model.is<Phong>())
      material = asPhong(std::move(material));
  }
  return materials;
}

}  // namespace

/// The parts that a World takes over from the one before: an edit in the studio changes little of a scene.
class World::Earlier {
 public:
  Earlier(const Compiled* before, const Scene& scene, const Settings& settings)
      : before_(before), objects_(allObjects(scene)) {
    if (!before) return;
    old_ = allObjects(before->scene);
    sameAccel_ = (before->settings.accel == Accel::none) == (settings.accel == Accel::none);
    sameNormals_ = before->settings.vertexNormals == settings.vertexNormals;
    materials_ = shownAs(before->scene.materials, before->settings);
    for (std::size_t i = 0; i < old_.size(); ++i) {
      const Instance& instance = before->world.objects_[i];
      if (const auto data = shapeOf(instance).mesh(); data && instance.mesh)
        trees_.of(data.get(), Displacement(*data, instance.material, materials_)) = instance.mesh;
    }
    for (const TracedShape& shape : before->world.shapes_) shape.addMeshTrees(operandTrees_);
  }

  /// Its object with the same shape as object i has now: the one at the same place in the list, or where that
  /// was before others were deleted or added. Null if there is none.
  const Instance* sameShape(std::uint32_t i) const {
    if (!before_) return nullptr;
    for (const std::size_t j : {std::size_t{i}, i + old_.size() - objects_.size()})
      if (j < old_.size() && old_[j]->shape == objects_[i]->shape) return &before_->world.objects_[j];
    return nullptr;
  }

  /// The shape of an object of that World.
  const TracedShape& shapeOf(const Instance& instance) const { return before_->world.shapes_[instance.form]; }

  /// The hierarchy of the mesh, which is that of `same` if that is not null, displaced so; null if it has to
  /// be made.
  std::shared_ptr<const MeshTree> tree(const Instance* same, const MeshData& data,
                                       const Displacement& displacement) const {
    if (!sameAccel_ || (data.generateNormals && !sameNormals_)) return nullptr;
    if (same && same->mesh && Displacement(data, same->material, materials_) == displacement)
      return same->mesh;
    return trees_.find(&data, displacement);
  }

  /// The hierarchies of meshes that solids are made of.
  const MeshTrees& operandTrees() const { return operandTrees_; }

  /// The hierarchy of the world over objects with these bounds; null if it has to be made.
  std::shared_ptr<const Bvh> hierarchy(std::span<const Box3> boxes, const World& world) const {
    if (!before_ || !sameAccel_) return nullptr;
    const World& old = before_->world;
    const bool same = std::equal(old.objects_.begin(), old.objects_.begin() + old.plain_, boxes.begin(),
                                 boxes.end(), [](const Instance& a, const Box3& b) { return a.bounds == b; });
    const auto alike = [&](const Uses& a, const Uses& b) {
      return a.list == b.list && old.groups_[a.group].box == world.groups_[b.group].box;
    };
    const bool sameUses =
        std::equal(old.uses_.begin(), old.uses_.end(), world.uses_.begin(), world.uses_.end(), alike);
    return same && sameUses ? old.bvh_ : nullptr;
  }

 private:
  const Compiled* before_;
  std::vector<const Object*> objects_, old_;
  bool sameAccel_ = false, sameNormals_ = false;
  std::vector<Material> materials_;  // materials of the scene before, as it was shown
  TreesOfMeshes trees_;
  MeshTrees operandTrees_;  // by the data of the scene, without generated normals
};

/// The ball of the mean radius in place of an ellipsoid.
Affine rounded(const Affine& m) {
  const auto column = [&](int i) { return length(Vec3{m.row[0][i], m.row[1][i], m.row[2][i]}); };
  const Real radius = (column(0) + column(1) + column(2)) / 3;
  return Affine::translation(m.offset) * Affine::scaling({radius, radius, radius});
}

/// The shapes of the courses that their skeletons gave no texture coordinates.
bool isRound(const Shape& shape) { return shape.is<Sphere>() || shape.is<Cylinder>() || shape.is<Cone>(); }

TracedShape prepared(const Object& object, const MeshTrees& made) {
  try {
    return prepare(object.shape, made);
  } catch (const Error& error) {
    throw Error(error.fault(), object.place, error.messages().front().what, error.messages().front().hint);
  }
}

/// The first material that is the same except for its name and priority.
std::vector<std::uint32_t> kindsOf(const std::vector<Material>& materials, const Rules& rules) {
  std::map<std::tuple<Real, Real, Real, Real, Real>, std::vector<std::uint32_t>> firsts;  // by some numbers
  const auto nameless = [](Material material) {
    material.name.clear();
    editEachField(material.model, [](const ModelField& field, auto& value) {
      if constexpr (std::is_same_v<std::remove_cvref_t<decltype(value)>, Real>)
        if (field.keyword == "priority") value = 0;
    });
    return material;
  };
  std::vector<std::uint32_t> kinds;
  for (std::uint32_t i = 0; i < materials.size(); ++i) {
    const Bsdf bsdf = bsdfOf(materials[i].model, rules);
    const WhittedTerms& terms = whitted(bsdf);
    auto& same = firsts[{terms.index, terms.transmissive.r, terms.transmissive.g, terms.transmissive.b,
                         terms.attenuation.r}];
    const auto found = std::find_if(same.begin(), same.end(), [&](std::uint32_t other) {
      return terms.transmits() && nameless(materials[i]) == nameless(materials[other]);
    });
    kinds.push_back(found == same.end() ? i : *found);
    if (found == same.end() && terms.transmits()) same.push_back(i);
  }
  return kinds;
}

/// The last shape of each type, with its index in World::shapes_: objects with one shape mostly follow one
/// another.
class LastShapes {
 public:
  std::optional<std::uint32_t> indexOf(const Shape& shape) const {
    const Last& last = last_[shape.type().index];
    return last.shape && *last.shape == shape ? std::optional(last.index) : std::nullopt;
  }
  /// The shape must outlive this.
  void add(const Shape& shape, std::uint32_t index) { last_[shape.type().index] = {&shape, index}; }

 private:
  struct Last {
    const Shape* shape = nullptr;
    std::uint32_t index = 0;
  };
  std::array<Last, kMostShapeTypes> last_{};
};

void warnOfUndisplaced(const std::vector<const Object*>& objects, Messages& messages) {
  if (objects.empty()) return;
  const std::string more =
      objects.size() == 1 ? "" : " (the first of " + std::to_string(objects.size()) + ")";
  messages.warn(objects.front()->place,
                "displacement moves the points of meshes: this " +
                    std::string(objects.front()->shape.keyword()) + " keeps its shape" + more,
                "`bump` bends the normals of every shape; `ray convert` makes a mesh of one");
}

World compile(const Scene& scene, const Settings& settings, Messages& messages, const Compiled* before) {
  World world;
  const World::Earlier earlier(before, scene, settings);
  world.rules_ = rulesOf(settings);
  const std::vector<Material> materials = shownAs(scene.materials, settings);
  for (const Material& material : materials) {
    const bool hasHoles = material.opacity < 1 || textureOf(material.textures, kOpacity);
    const bool twoSided = material.sides == ShadedSides::both;
    Material textured = material;
    std::erase_if(textured.textures, [](const FieldTexture& t) { return MediumModel::has(t.field); });
    const bool plain = textured.textures.empty();
    world.surfaces_.push_back({bsdfOf(material.model, world.rules_),
                               plain ? nullptr : std::make_shared<Material>(std::move(textured)), 0,
                               material.opacity, hasHoles, twoSided, material.castsShadow});
    world.hasShadowless_ |= !material.castsShadow;
    world.hasPanes_ |= whitted(world.surfaces_.back().bsdf).passage == Passage::straight;
    world.hasTwoSided_ |= twoSided;
    world.hasHoles_ |= hasHoles;
    world.hasSubsurface_ |= material.model.is<Subsurface>();
  }
  world.nestedGlass_ = settings.nestedGlass == NestedGlass::on ||
                       (settings.nestedGlass == NestedGlass::byPriority &&
                        std::any_of(world.surfaces_.begin(), world.surfaces_.end(),
                                    [](const auto& s) { return whitted(s.bsdf).priority != 0; }));
  if (world.nestedGlass_) {
    const std::vector<std::uint32_t> kinds = kindsOf(materials, world.rules_);
    for (std::size_t i = 0; i < kinds.size(); ++i) world.surfaces_[i].kind = kinds[i];
  }
  for (const Material& material : materials)
    for (const FieldTexture& t : material.textures) {
      if (t.field == "displacement" || MediumModel::has(t.field)) continue;  // asked for at points
      const bool footprint = wantsFootprint(t.texture);
      world.wantsFootprints_ |= footprint;
      world.footprintsInUv_ |= footprint && wantsUv(t.texture);
      world.hasBumps_ |= t.field == "bump" || t.field == "clearcoat_bump";
    }

  world.addLights(scene, settings, messages);

  const Camera camera = cameraFor(scene, settings);
  if (!(camera.fov > 0 && camera.fov < 180) || !(camera.aspectratio > 0) || !isFinite(camera.position) ||
      !(length(cross(camera.viewdir, camera.updir)) > 0))
    throw Error(Fault::scene, SourcePlace{.file = scene.file},
                "the camera cannot look: its field of view, aspect ratio or axes are degenerate",
                "viewdir and updir must not be zero or parallel");
  if (!isInRange(camera))
    throw Error(Fault::scene, SourcePlace{.file = scene.file},
                "the camera cannot look: its place or its axes are too far away, too long or too short",
                "its position is at most 1e75 from the origin, its axes are between 1e-75 and 1e75 long");
  Optics optics = opticsOf(settings);
  optics.lens.picture = scene.surroundings.aperture;
  world.camera_ = frame(camera, settings.cameraAxes, optics);
  world.outside_ = Outside(scene, settings, world.camera_);
  if (before) world.outside_.shareSkySums(before->world.outside_);

  const bool bruteForce = settings.accel == Accel::none;
  TreesOfMeshes trees;
  std::vector<const Object*> undisplaced;  // what its material displaces in vain
  LeftOut leftOut("this object");
  std::vector<Box3> boxes;
  const std::vector<const Object*> all = allObjects(scene);
  world.objects_.reserve(all.size());
  boxes.reserve(scene.objects.size());
  LastShapes lastShapes;
  world.plain_ = static_cast<std::uint32_t>(scene.objects.size());
  Work work("building the objects", static_cast<std::int64_t>(all.size()));
  for (const Object* at : all) {
    const Object& object = *at;
    const bool inGroup = world.objects_.size() >= scene.objects.size();
    work.reached(static_cast<std::int64_t>(boxes.size()));
    const World::Instance* same = earlier.sameShape(static_cast<std::uint32_t>(world.objects_.size()));
    World::Instance instance;
    if (const auto form = lastShapes.indexOf(object.shape)) {
      instance.form = *form;
    } else {
      instance.form = static_cast<std::uint32_t>(world.shapes_.size());
      world.shapes_.push_back(same ? earlier.shapeOf(*same) : prepared(object, earlier.operandTrees()));
      lastShapes.add(object.shape, instance.form);
    }
    const TracedShape& shape = world.shapes_[instance.form];
    instance.kind = static_cast<std::uint32_t>(object.shape.type().index);
    bool inRange = isInRange(object.worldFromObject);
    const bool flat = inRange && !invertible(object.worldFromObject),
               round = settings.roundSpheres && object.shape.is<Sphere>();
    if (inRange && !flat)
      instance.placement = Placement(round ? rounded(object.worldFromObject) : object.worldFromObject);
    instance.mapped = settings.roundMaps || !isRound(object.shape);
    instance.material = object.material;
    if (object.material >= world.surfaces_.size())
      throw Error(Fault::scene, object.place, "the object's material does not exist");
    if (settings.omit.has(static_cast<ShapeKind>(instance.kind))) {
      if (!inGroup) boxes.emplace_back();  // keeps the numbering of objects; what is empty is never hit
      world.objects_.push_back(std::move(instance));
      continue;
    }
    if (flat)  // stays, for the numbering of objects; its empty bounds are never hit
      messages.warn(object.place, "the object's transform squeezes it flat, so it is left out");
    std::vector<std::uint32_t> used{object.material};  // materials used by all its parts
    Box3 box;
    if (const auto shared = shape.mesh()) {
      const Displacement displacement(*shared, object.material, materials);
      auto& tree = trees.of(shared.get(), displacement);
      if (!tree) tree = earlier.tree(same, *shared, displacement);
      if (!tree) {
        auto data = shared;
        if (!displacement.none())
          data = std::make_shared<const MeshData>(displacement.of(*data, object.place));
        else if (data->generateNormals)
          data = std::make_shared<const MeshData>(
              withGeneratedNormals(*data, settings.vertexNormals == VertexNormals::unit));
        tree = std::make_shared<const MeshTree>(data, bruteForce, settings.threads);
      }
      instance.mesh = tree;
      const std::vector<std::uint32_t>& own = tree->data().materials;
      instance.mixed = !own.empty();
      used.insert(used.end(), own.begin(), own.end());
      box = bounds(tree->data());
      if (displacement.wantsUv() && shared->uvs.empty())
        messages.warn(object.place, "the texture of its displacement lies in u and v, which the mesh lacks",
                      "uv = spherical, cylindrical, planar or cubic in the mesh makes them");
    } else {
      box = shape.bounds();
      instance.convex = shape.convex();
      instance.strands = shape.strands();
      instance.mixed = shape.ofSeveralMaterials();
      shape.addMaterials(used);
      if (std::any_of(used.begin(), used.end(), [&](std::uint32_t m) {
            return m != MaterialMix::kClear && materials.at(m).displacement != 0;
          }))
        undisplaced.push_back(&object);
    }
    instance.opaque = std::none_of(used.begin(), used.end(), [&](std::uint32_t m) {
      if (m == MaterialMix::kClear) return true;
      const World::Surface& surface = world.surfaces_.at(m);
      return surface.hasHoles || whitted(surface.bsdf).transmits();
    });
    instance.patternsInWorld = std::any_of(used.begin(), used.end(), [&](std::uint32_t m) {
      return m != MaterialMix::kClear && materials[m].patternSpace == PatternSpace::world;
    });
    instance.blocks = instance.opaque && std::all_of(used.begin(), used.end(), [&](std::uint32_t m) {
                        return m == MaterialMix::kClear || materials[m].castsShadow;
                      });
    instance.solid = instance.mesh ? !world.nestedGlass_ || instance.opaque || closed(instance.mesh->data())
                                   : shape.solid();
    const Box3 placed = box.unbounded() ? box : instance.placement.outFromIn() * box;
    inRange = inRange && isInRange(box) && isInRange(materials[object.material]) &&
              (box.unbounded() || isInRange(placed));
    if (!inRange) leftOut.add(object.place);  // stays as well
    const bool isThere = inRange && !flat;
    const auto number = static_cast<std::uint32_t>(world.objects_.size());
    const Material& material = materials[object.material];
    const bool fills = material.mediumDensity > 0 && isThere && !box.unbounded() && !inGroup;
    const bool encloses = isThere && !instance.opaque && (world.nestedGlass_ || fills || settings.fog > 0) &&
                          (instance.mesh ? closed(instance.mesh->data()) : shape.solid());
    const bool cloud = fills && encloses && material.opacity == 0 &&
                       std::all_of(used.begin(), used.end(), [&](auto m) { return m == object.material; });
    if (fills && encloses) world.media_.push_back({number, cloud, MediumModel(material), placed});
    if (inGroup && box.unbounded())
      throw Error(Fault::scene, object.place, "an object without an end cannot be in a group that is placed");
    instance.holds = encloses && !cloud;
    if (instance.holds && !inGroup) world.glass_.push_back(number);
    if (cloud) {  // it is hit nowhere
      world.bounds_.extend(world.media_.back().bounds);
    } else if (isThere) {
      if (box.unbounded())
        world.always_.push_back(static_cast<std::uint32_t>(world.objects_.size()));
      else
        instance.bounds = placed;
    }
    if (!inGroup) {
      boxes.push_back(instance.bounds);
      world.bounds_.extend(instance.bounds);
    }
    world.objects_.push_back(std::move(instance));
  }
  warnOfUndisplaced(undisplaced, messages);
  leftOut.warn(messages);
  world.collectForms();
  world.addGroups(scene, settings);
  world.bvh_ = earlier.hierarchy(boxes, world);
  if (!world.bvh_)
    world.bvh_ = world.uses_.empty() ? hierarchy(boxes, settings) : world.topHierarchy(boxes, settings);
  if (world.bvh_->nodes().empty())
    world.always_.insert(world.always_.end(), world.bvh_->items().begin(), world.bvh_->items().end());
  world.focus(scene, settings);
  return world;
}

}  // namespace trace
