#include "app/lint_rays.h"

#include <algorithm>
#include <cmath>

#include "base/budget.h"
#include "render/pixel.h"

namespace trace {
namespace {

constexpr int kDirections = 14;
constexpr Real kCounts = 0.02;  ///< a ray of less weight shows too little

/// Spread over the sphere (a Fibonacci spiral: Gonzalez 2010), none along an axis.
Vec3 direction(int i) {
  const Real z = 1 - (2 * i + 1.0) / kDirections, r = std::sqrt(1 - z * z);
  const Real angle = i * kPi * (3 - std::sqrt(5.0)) + 0.1;
  return {r * std::cos(angle), r * std::sin(angle), z};
}

/// Every crossing of the ray once, nearest first.
std::vector<Found> allCrossings(const World& world, const Ray& ray, Real tMost) {
  std::vector<Found> found;
  Statistics uncounted;
  world.crossings(ray, tMost, Faces::both, uncounted, [&](const Found& f) {
    found.push_back(f);
    return false;
  });
  std::sort(found.begin(), found.end(), [](const Found& a, const Found& b) { return a.before(b); });
  const auto same = [](const Found& a, const Found& b) { return !a.before(b) && !b.before(a); };
  found.erase(std::unique(found.begin(), found.end(), same), found.end());
  return found;
}

/// The picture that is surveyed: small, one ray a pixel.
Settings sparse(const Settings& settings) {
  Settings result = settings;
  result.width = 64, result.height = 48, result.spp = 1, result.region = {};
  result.threshold = std::max(result.threshold, kCounts / 2);
  return result;
}

/// Calls visit(tree) for each pixel; trees that are too large to record are left out.
template <class Visit>
void forEachTree(const Settings& settings, const World& world, Visit&& visit) {
  const Size size{settings.width, settings.height};
  Work work("surveying the picture", size.height);
  for (int y = 0; y < size.height; ++y) {
    work.reached(y);
    for (int x = 0; x < size.width; ++x) {
      RayTree tree;
      try {
        PixelTracer(world, settings, size, &tree).sample(x, y, 0);
      } catch (const Error&) {
        lookAtBudget();
        continue;
      }
      weigh(tree, 1);
      visit(tree);
    }
  }
}

bool counts(const RayNode& node) { return maxComponent(node.weight * node.through) >= kCounts; }

/// A refracted ray that would count is missing here for the depth limit.
bool isCutShort(const RayNode& node) {
  if (!node.hit || !counts(node)) return false;
  if (maxComponent(node.weight * node.hit->material.transmissive) < kCounts) return false;
  return std::any_of(node.ends.begin(), node.ends.end(), [](const RayEnd& end) {
    const auto* limit = std::get_if<DepthLimit>(&end);
    return limit && limit->unsent == RayKind::refraction;
  });
}

class Surveyor {
 public:
  Surveyor(const Scene& scene, const World& world) : world_(world) {
    survey_.objects.resize(scene.objects.size());
    survey_.lights.resize(scene.lights.size());
  }

  void look(const RayTree& tree) {
    ++survey_.samples;
    bool cutShort = false;
    for (const RayNode& node : tree.nodes) {
      if (!node.hit || !counts(node)) continue;
      place(tree, node);
      if (node.kind == RayKind::camera) coplanar(node);
      if (!isCutShort(node)) continue;
      if (survey_.cutShort == 0) survey_.cutShortIn = node.hit->object;
      cutShort = true;
    }
    survey_.cutShort += cutShort;
  }

  Survey take() { return std::move(survey_); }

 private:
  void place(const RayTree& tree, const RayNode& node) {
    Survey::Seen& seen = survey_.objects[node.hit->object];
    const Phong& material = node.hit->material;
    ++seen.places;
    seen.couldBeLit += !isBlack(material.diffuse) || !isBlack(material.specular);
    // What a mirror or glass shows is no light on its own surface, but it is not black for lack of light.
    seen.lit += !isBlack(node.radiance) || material.mirrors() || material.transmits();
    seen.direct += std::any_of(node.terms.begin(), node.terms.end(), [](const Term& term) {
      return term.light && !isBlack(term.factor * term.value);
    });
    for (const Term& term : node.terms) {
      if (!term.light) continue;
      if (term.ray < 0) {
        ++seen.facesAway;
        continue;
      }
      const RayNode& shadow = tree.nodes[static_cast<std::size_t>(term.ray)];
      if (!shadow.ends.empty())
        if (const auto* blocked = std::get_if<Blocked>(&shadow.ends.front()))
          ++seen.blockedBy[blocked->object];
      lamp(survey_.lights[term.light->light], shadow);
    }
  }

  void lamp(Survey::Lamp& lamp, const RayNode& shadow) const {
    if (isBlack(shadow.radiance)) return;
    ++lamp.reached;
    for (const Filter& filter : shadow.filters) {
      if (!refracts(shadow.ray, filter)) continue;
      if (lamp.throughGlass == 0) lamp.glass = filter.object;
      ++lamp.throughGlass;
      break;
    }
  }

  bool refracts(const Ray& ray, const Filter& filter) const {
    for (const Found& found : allCrossings(world_, ray, filter.t * (1 + gammaError(8))))
      if (found.object == filter.object && found.part == filter.part)
        return std::abs(world_.material(found).index - 1) > 0.01;  // air's is near 1, too
    return false;
  }

  /// Another surface at the place that the camera ray met, with the same plane.
  void coplanar(const RayNode& node) {
    const Hit& hit = *node.hit;
    const Real cosine = std::abs(dot(hit.surface.normal, node.ray.direction));
    if (!(cosine > 0.01)) return;
    const auto depth = [&](const SurfacePoint& s) { return dot(abs(s.normal), s.error); };
    const Real reach = hit.t + 100 * depth(hit.surface) / cosine;
    for (const Found& found : allCrossings(world_, node.ray, reach)) {
      if (found.object == hit.object) continue;
      const SurfacePoint other = world_.surface(node.ray, found);
      const Real apart = std::abs(dot(other.point - hit.surface.point, hit.surface.normal));
      if (apart > depth(hit.surface) + depth(other)) continue;
      if (std::abs(dot(other.normal, hit.surface.normal)) < 1 - 1e-9) continue;
      ++survey_.coplanar[std::minmax(hit.object, found.object)];
    }
  }

  const World& world_;
  Survey survey_;
};

}  // namespace

std::vector<std::uint32_t> objectsAround(const World& world, const Vec3& point) {
  std::vector<int> odd(world.objectCount());
  for (int i = 0; i < kDirections; ++i) {
    std::map<std::uint32_t, int> crossed;
    for (const Found& found : allCrossings(world, {point, direction(i)}, kInfinity)) ++crossed[found.object];
    for (const auto& [object, times] : crossed) odd[object] += times % 2;
  }
  std::vector<std::uint32_t> around;
  for (std::uint32_t object = 0; object < odd.size(); ++object)
    if (odd[object] == kDirections) around.push_back(object);
  return around;
}

double shareInsideOut(const World& world, std::uint32_t object, const MeshData& mesh) {
  constexpr std::size_t kMost = 200;
  const std::size_t count = mesh.triangles.size(), step = std::max<std::size_t>(1, count / kMost);
  const Affine& toWorld = world.worldFromObject(object);
  const Real far = 4 * length(world.bounds().size());
  int asked = 0, inside = 0;
  for (std::size_t i = 0; i < count; i += step) {
    const Corners c = corners(mesh, static_cast<std::uint32_t>(i));
    const Vec3 a = toWorld * c.a, center = a * 0.3 + (toWorld * c.b) * 0.37 + (toWorld * c.c) * 0.33;
    Vec3 normal = cross(toWorld * c.b - a, toWorld * c.c - a);
    if (normal == Vec3{} || !isFinite(normal)) continue;
    if (determinant(toWorld) < 0) normal = -normal;  // a mirror turns the corners round, not the surface
    normal = normalize(normal);
    int before = 0, all = 0;
    bool met = false;
    for (const Found& found : allCrossings(world, {center + normal * far, -normal}, kInfinity)) {
      if (found.object != object) continue;
      met = met || found.part == i;
      before += !met, ++all;
    }
    if (!met || all % 2 != 0) continue;  // an open surface has no inside
    ++asked, inside += before % 2;
  }
  return asked > 3 ? static_cast<double>(inside) / asked : 0;
}

Survey survey(const Scene& scene, const Settings& settings, const World& world) {
  Surveyor surveyor(scene, world);
  forEachTree(sparse(settings), world, [&](const RayTree& tree) { surveyor.look(tree); });
  return surveyor.take();
}

double shareCutShort(const Settings& settings, const World& world, int depth) {
  Settings sampled = sparse(settings);
  sampled.depth = depth;
  int all = 0, cut = 0;
  forEachTree(sampled, world, [&](const RayTree& tree) {
    ++all;
    cut += std::any_of(tree.nodes.begin(), tree.nodes.end(), isCutShort);
  });
  return all > 0 ? static_cast<double>(cut) / all : 0;
}

}  // namespace trace
