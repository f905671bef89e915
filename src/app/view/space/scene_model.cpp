#include "app/view/space/scene_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <unordered_map>
#include <utility>

#include "app/view/space/simplified.h"
#include "geometry/mesh/mesh.h"
#include "geometry/mesh/tessellate.h"
#include "scene/groups.h"

namespace trace {
namespace {

constexpr int kDivisions = 24;          // divisions of a shape's longest side
constexpr int kDivisionsOfSolids = 72;  // for solids of solids, whose edges should look smooth
constexpr Box3 kEverywhere{{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}};
constexpr int kLooks = 24;        // rays across and down, to find what a camera sees
constexpr double kAside = 0.2;    // share of the picture on each side that is not asked
constexpr double kFarOut = 0.15;  // share of the points seen that is left out on each side

constexpr std::size_t kMostDrawnCopies = 2000;  // objects of placed groups that are drawn
constexpr double kFarther = 1e6;                // times as far from the camera as the first quarter: left out

/// The colour that diffuse light gives it. Mirrors and glass have hardly one of their own: as far as that
/// leaves room, what they reflect and let through is shown instead.
Color lookOf(const Phong& m) {
  constexpr Real kMirror = 0.4, kClear = 0.8, kBlack = 0.04;  // black things are to be seen, too
  const Color lit = m.diffuse + m.emissive, own = clamp01(maxComponent(lit) > 0 ? lit : m.ambient);
  const Color other = clamp01(m.reflective * kMirror + m.transmissive * kClear);
  return lerp(kBlack, own + other * (1 - maxComponent(own)), Color(1));
}

/// The mean colour of a texture over the places of a cube.
Color meanOf(const Texture& texture) {
  constexpr int kPlaces = 64;
  constexpr Real kSteps[] = {0.8191725134, 0.6710436067, 0.5497004779};  // spread evenly (Roberts 2018)
  Color sum;
  for (int i = 0; i < kPlaces; ++i) {
    const auto at = [&](int axis) { return std::fmod((i + 0.5) * kSteps[axis], 1.0); };
    TexturePlace place{};
    place.point = Vec3{at(0), at(1), at(2)} * 2 - Vec3{1, 1, 1};
    place.uv = {at(0), at(1)};
    sum += texture.at(place);
  }
  return sum / kPlaces;
}

/// The nearest Phong material, with the mean of a texture in place of its colour.
Phong plainPhong(const Material& material) {
  Phong phong = phongOf(material);
  for (const std::string_view field : {kDiffuse, kColor})
    if (const Texture* texture = textureOf(material.textures, field)) {
      const Color mean = meanOf(*texture);
      phong.diffuse *= mean;
      phong.ambient *= mean;
    }
  return phong;
}

Real opacityOf(const Phong& m) {
  constexpr Real kLeast = 0.2;  // opacity of the clearest glass, which must stay visible
  return m.transmits() ? std::clamp(1 - maxComponent(m.transmissive), kLeast, 1.0) : 1;
}

/// The farthest coordinate of the box from the point.
Real reach(const Box3& box, const Vec3& from) {
  Real farthest = 0;
  for (int axis = 0; axis < 3; ++axis)
    farthest =
        std::max({farthest, std::abs(box.low[axis] - from[axis]), std::abs(box.high[axis] - from[axis])});
  return farthest;
}

/// The part of the world that each object occupies: everything if it is infinite, nothing if it is not drawn.
std::vector<Box3> drawnBoxes(const Scene& scene) {
  std::vector<Box3> boxes(scene.objects.size());
  std::vector<Real> reaches;
  const Vec3& eye = scene.camera.position;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Object& object = scene.objects[i];
    if (!invertible(object.worldFromObject)) continue;
    const Box3 own = drawnBounds(object.shape, kEverywhere);
    const Box3 box = own.unbounded() ? kEverywhere : object.worldFromObject * own;
    if (box.empty() || box.unbounded() != own.unbounded()) continue;
    boxes[i] = box;
    if (!own.unbounded()) reaches.push_back(reach(box, eye));
  }
  if (reaches.empty()) return boxes;
  const auto near = reaches.begin() + static_cast<std::ptrdiff_t>((reaches.size() - 1) / 4);
  std::nth_element(reaches.begin(), near, reaches.end());
  for (Box3& box : boxes)
    if (*near > 0 && !box.unbounded() && reach(box, eye) > kFarther * *near) box = {};
  return boxes;
}

int divisionsOf(const Shape& shape, double fineness) {
  const int usual = shape.type().ofObjects ? kDivisionsOfSolids : kDivisions;
  return std::max(4, static_cast<int>(std::lround(usual * fineness)));
}

/// How coarsely shapes were drawn, by their keywords.
class DrawnShapes {
 public:
  explicit DrawnShapes(double fineness) : fineness_(fineness) {}
  void note(const Shape& shape, int divisions, bool nothing) {
    const std::string kind(shape.keyword());
    if (shape.is<Mesh>()) return;
    if (nothing)
      ++missing_[kind];
    else if (const int wanted = divisionsOf(shape, fineness_); divisions < wanted)
      coarse_.try_emplace(kind, divisions, wanted);
  }
  std::vector<Message> warnings(const std::string& file) const {
    Messages messages;
    const SourcePlace place{file, 0, 0, {}};
    const char* kRender = "the render shows every detail";
    for (const auto& [kind, steps] : coarse_)
      messages.warn(place,
                    "the view in space shows " + kind + " in " + std::to_string(steps.first) +
                        " steps along it, not " + std::to_string(steps.second) + ", for it folds finely",
                    kRender);
    for (const auto& [kind, count] : missing_)
      messages.warn(place,
                    "the view in space leaves out " + std::to_string(count) + " " + kind +
                        ", which is empty or folds too finely for triangles",
                    kRender);
    return messages.all();
  }

 private:
  std::map<std::string, std::pair<int, int>> coarse_;  // steps that were followed, and those of others
  std::map<std::string, int> missing_;
  double fineness_;
};

/// Around those that have an end; with room to spare if some have none.
Box3 frameAround(const std::vector<Box3>& boxes, const Vec3& eye) {
  Box3 frame;
  for (const Box3& box : boxes)
    if (!box.unbounded()) frame.extend(box);
  const bool endless =
      std::any_of(boxes.begin(), boxes.end(), [](const Box3& box) { return box.unbounded(); });
  if (frame.empty() || !endless) return frame;
  frame.extend(eye);
  const Vec3 room = frame.size() / 2;
  return {frame.low - room, frame.high + room};
}

/// Adds fewer triangles of each part, those of large parts.
void addFew(SceneModel& model) {
  constexpr std::size_t kSmall = 100;  // triangles that no part has too many of
  SharedCorners& shared = model.shared;
  const std::size_t all = std::max<std::size_t>(shared.indices.size() / 3, 1);
  for (ScenePart& part : model.parts) {
    part.fewFirst = part.first;
    part.fewCount = part.count;
    const std::size_t own = part.count / 3;
    const std::size_t most = std::max(kSmall, own * SceneModel::kFewTriangles / all);
    if (own <= most) continue;
    const auto few = simplified({shared.indices.data() + part.first, part.count}, shared.corners, most);
    part.fewFirst = shared.indices.size();
    part.fewCount = few.size();
    shared.indices.insert(shared.indices.end(), few.begin(), few.end());
  }
}

}  // namespace

SharedCorners sharedCorners(const std::vector<float>& corners) {
  using Six = std::array<float, 6>;
  const auto hash = [](const Six& corner) {
    std::size_t sum = 0;
    for (const float x : corner) sum = (sum ^ std::hash<float>()(x)) * 0x9e3779b97f4a7c15u;
    return sum ^ (sum >> 32);
  };
  std::unordered_map<Six, std::uint32_t, decltype(hash)> known(corners.size() / 12, hash);
  SharedCorners shared;
  shared.indices.reserve(corners.size() / 6);
  for (std::size_t i = 0; i < corners.size(); i += 6) {
    Six corner;
    std::copy_n(corners.begin() + static_cast<std::ptrdiff_t>(i), 6, corner.begin());
    const auto [found, isNew] = known.try_emplace(corner, static_cast<std::uint32_t>(known.size()));
    if (isNew) shared.corners.insert(shared.corners.end(), corner.begin(), corner.end());
    shared.indices.push_back(found->second);
  }
  return shared;
}

MaterialLook lookOf(const Material& material) {
  const Phong phong = plainPhong(material);
  return {lookOf(phong), opacityOf(phong)};
}

Box3 frameOf(const Scene& scene) {
  if (!scene.uses.empty()) return frameOf(firstCopies(scene, kMostDrawnCopies));
  return frameAround(drawnBoxes(scene), scene.camera.position);
}

SceneModeler::Made SceneModeler::made(const Shape& shape, const Box3& within, std::vector<Made>& kept) const {
  const bool lasts = !drawnBounds(shape, kEverywhere).unbounded() && !shape.is<Mesh>();
  if (lasts) {
    const auto in = [&](const std::vector<Made>& list) {
      const auto found =
          std::find_if(list.begin(), list.end(), [&](const Made& made) { return made.shape == shape; });
      return found == list.end() ? nullptr : &*found;
    };
    if (const Made* found = in(kept)) return *found;
    if (const Made* found = in(made_)) return kept.emplace_back(*found);
  }
  int followed = 0;
  std::vector<SurfaceCorner> corners = tessellate(shape, divisionsOf(shape, fineness_), within, &followed);
  Made made{shape, std::make_shared<const std::vector<SurfaceCorner>>(std::move(corners)), followed};
  if (lasts) kept.push_back(made);
  return made;
}

namespace {

/// The edges of a part's triangles where its surface bends sharply, or ends.
void addCreases(const ScenePart& part, SceneModel& model) {
  constexpr std::size_t kMostCorners = 30000, kMost = 4000;  // in the part; in the model
  constexpr double kSharp = 0.77;                            // cosine of 40 degrees
  if (part.opacity >= 1 || part.count > kMostCorners) return;
  using Point = std::array<float, 3>;
  const auto at = [&](std::size_t corner) {
    const float* p = &model.corners[6 * corner];
    return Point{p[0], p[1], p[2]};
  };
  const auto vec = [](const Point& p) { return Vec3{p[0], p[1], p[2]}; };
  std::map<std::pair<Point, Point>, std::vector<Vec3>> normals;  // normals of the triangles at an edge
  for (std::size_t first = part.first; first < part.first + part.count; first += 3) {
    const std::array<Point, 3> corner{at(first), at(first + 1), at(first + 2)};
    const Vec3 across = cross(vec(corner[1]) - vec(corner[0]), vec(corner[2]) - vec(corner[0]));
    if (!(length(across) > 0)) continue;
    for (std::size_t i = 0; i < 3; ++i)
      normals[std::minmax(corner[i], corner[(i + 1) % 3])].push_back(normalize(across));
  }
  for (const auto& [ends, there] : normals) {
    const bool smooth = there.size() == 2 && std::abs(dot(there[0], there[1])) > kSharp;
    if (!smooth && model.creases.size() < kMost) model.creases.push_back({ends.first, ends.second});
  }
}

}  // namespace

SceneModel SceneModeler::model(const Scene& given, const Cancelled& cancelled, double fineness) {
  SceneModel model;
  if (std::exchange(fineness_, fineness) != fineness) made_.clear();
  const Scene copies = given.uses.empty() ? Scene() : firstCopies(given, kMostDrawnCopies);
  const Scene& scene = given.uses.empty() ? given : copies;
  const std::vector<Box3> boxes = drawnBoxes(scene);
  const Box3 frame = frameAround(boxes, scene.camera.position);
  if (!frame.empty()) {
    model.origin = frame.center();
    model.scale = std::max(length(frame.size()) / 2, 1e-30);
  }

  std::vector<Made> kept;
  DrawnShapes drawn(fineness);
  for (std::uint32_t i = 0; i < scene.objects.size() && !(cancelled && cancelled()); ++i) {
    const Object& object = scene.objects[i];
    if (boxes[i].empty() || object.material >= scene.materials.size()) continue;
    const Affine objectFromWorld = inverse(object.worldFromObject);
    Box3 within = frame.empty() ? kFarthest : objectFromWorld * frame;
    within.extend(Vec3{});  // through which a plane goes
    const Box3 bounds = drawnBounds(object.shape, within);
    const Made made = this->made(object.shape, within, kept);
    const Corners& corners = made.corners;
    drawn.note(object.shape, made.divisions, corners->empty());
    std::array<Vec3, 8> box;
    for (std::size_t corner = 0; corner < 8; ++corner)
      box[corner] = object.worldFromObject * Vec3{corner & 1 ? bounds.high.x : bounds.low.x,
                                                  corner & 2 ? bounds.high.y : bounds.low.y,
                                                  corner & 4 ? bounds.high.z : bounds.low.z};

    std::map<std::uint32_t, std::vector<std::size_t>> triangles;  // by their material: first corners
    for (std::size_t first = 0; first < corners->size(); first += 3) {
      const std::uint32_t own = (*corners)[first].material;
      triangles[own == SurfaceCorner::kOwn ? object.material : own].push_back(first);
    }
    for (const auto& [material, firsts] : triangles) {
      if (material >= scene.materials.size()) continue;  // as if nothing were there
      const MaterialLook look = lookOf(scene.materials[material]);
      const std::uint32_t number = i < given.objects.size() ? i : ScenePart::kCopy;
      model.parts.push_back({.object = number,
                             .color = look.color,
                             .opacity = look.opacity,
                             .first = model.corners.size() / 6,
                             .count = 3 * firsts.size(),
                             .box = box});
      for (const std::size_t first : firsts)
        for (std::size_t corner = first; corner < first + 3; ++corner) {
          const auto p = model.local(object.worldFromObject * (*corners)[corner].point);
          const Vec3 n = normalize(transposed(objectFromWorld, (*corners)[corner].normal));
          for (const float x : p) model.corners.push_back(x);
          for (int axis = 0; axis < 3; ++axis) model.corners.push_back(static_cast<float>(n[axis]));
        }
    }
  }
  for (const ScenePart& part : model.parts) addCreases(part, model);
  model.shared = sharedCorners(model.corners);
  if (!(cancelled && cancelled())) addFew(model);
  made_ = std::move(kept);
  model.warnings = drawn.warnings(scene.file);
  if (const std::size_t all = countPlacedObjects(given); all > kMostDrawnCopies)
    model.warnings.push_back({Message::Severity::warning, SourcePlace{.file = given.file},
                              "the view in space shows " + std::to_string(kMostDrawnCopies) + " of " +
                                  std::to_string(all) + " objects in placed groups",
                              "the render shows all"});
  return model;
}

Box3 seenBy(const World& world, const Box3& frame) {
  std::vector<Real> seen[3];
  Statistics statistics;
  const Vec3 room = frame.size() / 2;  // beyond it there is only what has no end, up to the horizon
  const Box3 near{frame.low - room, frame.high + room};
  const auto place = [](int i) { return kAside + (1 - 2 * kAside) * (i + 0.5) / kLooks; };
  for (int y = 0; y < kLooks; ++y)
    for (int x = 0; x < kLooks; ++x) {
      const Ray ray = world.camera().ray({place(x), place(y)});
      const auto found = world.closest(ray, Faces::both, statistics);
      if (!found) continue;
      const Vec3 p = ray.at(found->t);
      if (!frame.empty() && !near.contains(p)) continue;
      for (int axis = 0; axis < 3; ++axis) seen[axis].push_back(p[axis]);
    }
  Box3 box;
  if (seen[0].empty()) return box;
  const auto last = static_cast<double>(seen[0].size() - 1);
  for (int axis = 0; axis < 3; ++axis) {
    std::sort(seen[axis].begin(), seen[axis].end());
    box.low[axis] = seen[axis][static_cast<std::size_t>(kFarOut * last)];
    box.high[axis] = seen[axis][static_cast<std::size_t>(std::ceil((1 - kFarOut) * last))];
  }
  return box;
}

bool sameModel(const Scene& a, const Scene& b) {
  return a.materials == b.materials && a.groups == b.groups && a.uses == b.uses &&
         std::equal(a.objects.begin(), a.objects.end(), b.objects.begin(), b.objects.end(),
                    [](const Object& x, const Object& y) {
                      return x.shape == y.shape && x.worldFromObject == y.worldFromObject &&
                             x.material == y.material;
                    });
}

}  // namespace trace
