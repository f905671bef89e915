#include "app/lint/survey.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "app/lint/rays.h"
#include "base/budget.h"
#include "image/development/tone.h"
#include "render/integrators/make_integrator.h"
#include "render/samples/pixel.h"
#include "shading/lights/plain_lights.h"

namespace trace {
namespace {

constexpr int kWidth = 64, kHeight = 48;  ///< width and height of the picture that is surveyed
constexpr int kVisible = 16;              ///< levels: a difference that nobody overlooks
constexpr Real kCounts = 0.02;            ///< a ray of less weight shows too little

/// The picture that is surveyed: small, one ray a pixel.
Settings sparse(const Settings& settings) {
  Settings result = settings;
  result.outlines = 0;  // lines that wide would cover small things
  result.ambientOcclusion = 0;
  result.caustics = 0;
  result.fog = 0;
  result.width = kWidth;
  result.height = kHeight;
  result.spp = 1;
  result.subdivide = 0;
  result.region = {};
  result.threshold = std::max(result.threshold, kCounts / 2);
  return result;
}

/// Calls visit(tree, number of the pixel) for each pixel; trees that are too large to record are left out.
template <class Visit>
void forEachTree(const Settings& settings, const World& world, Visit&& visit) {
  const Size size{settings.width, settings.height};
  Job job;
  const auto integrator = makeIntegrator(world, settings, job);
  Work work("surveying the picture", size.height);
  for (int y = 0; y < size.height; ++y) {
    work.reached(y);
    for (int x = 0; x < size.width; ++x) {
      RayTree tree;
      try {
        PixelTracer(world, *integrator, settings, size, &tree).sample(x, y, 0);
      } catch (const Error&) {
        lookAtBudget();
        continue;
      }
      weigh(tree, 1);
      visit(tree, static_cast<std::size_t>(y * size.width + x));
    }
  }
}

bool counts(const RayNode& node) { return maxComponent(node.weight * node.through) >= kCounts; }

/// A refracted ray that would count is missing here for the depth limit.
bool isCutShort(const RayNode& node) {
  if (!node.hit || !counts(node)) return false;
  if (maxComponent(node.weight * whitted(*node.bsdf).transmissive) < kCounts) return false;
  return std::any_of(node.ends.begin(), node.ends.end(), [](const RayEnd& end) {
    const auto* limit = std::get_if<DepthLimit>(&end);
    return limit && limit->unsent == RayKind::refraction;
  });
}

Bytes levels(const Picture& picture, const Settings& settings) {
  return toBytes(developed(picture, developmentOf(settings)), settings.rounding);
}

/// How many of the pixels differ so that an eye sees it.
int different(const Bytes& a, const Bytes& b, const std::vector<std::size_t>& pixels) {
  return static_cast<int>(std::count_if(pixels.begin(), pixels.end(), [&](std::size_t pixel) {
    for (std::size_t channel = 3 * pixel; channel < 3 * pixel + 3; ++channel)
      if (std::abs(a.rgb[channel] - b.rgb[channel]) >= kVisible) return true;
    return false;
  }));
}

class Surveyor {
 public:
  Surveyor(const Scene& scene, const World& world) : world_(world) {
    for (const LightSource& source : scene.lights)
      if (isSpot(source.light)) spots_.push_back(source.light);
    survey_.objects.resize(scene.objects.size());
    survey_.lights.resize(scene.lights.size());
    survey_.picture = Picture(kWidth, kHeight);
    if (world.outside().isSeenBy(RayKind::reflection)) return;  // everybody sees the sky
    for (const Color& color : scene.background.colors)
      brightestSky_ = std::max(brightestSky_, maxComponent(color));
  }

  void look(const RayTree& tree, std::size_t pixel) {
    ++survey_.samples;
    const RayNode& first = tree.nodes.front();
    survey_.met += first.hit.has_value();
    survey_.cutOff += std::any_of(first.ends.begin(), first.ends.end(),
                                  [](const RayEnd& end) { return std::holds_alternative<CutOff>(end); });
    survey_.picture.pixels[pixel] = first.radiance;
    bool cutShort = false;
    for (const RayNode& node : tree.nodes) {
      if (!counts(node)) continue;
      if (node.parent >= 0) sent(rayAt(tree, node.parent), node);
      if (!node.hit) continue;
      place(tree, node);
      if (node.kind == RayKind::camera) coplanar(node);
      if (!isCutShort(node)) continue;
      if (survey_.cutShort.empty() && !cutShort) survey_.cutShortIn = node.hit->object;
      cutShort = true;
    }
    if (cutShort) survey_.cutShort.push_back(pixel);
  }

  Survey take() { return std::move(survey_); }

 private:
  void place(const RayTree& tree, const RayNode& node) {
    Survey::Seen& seen = survey_.objects[node.hit->object];
    const WhittedTerms& material = whitted(*node.bsdf);
    const bool scattering = scatters(*node.bsdf);
    ++seen.places;
    seen.couldBeLit += scattering;
    // The reflection in a mirror or glass is no light on its own surface, but it is not black for lack of
    // light.
    seen.lit += !isBlack(node.radiance) || material.mirrors() || material.transmits();
    seen.direct += std::any_of(node.terms.begin(), node.terms.end(), [](const Term& term) {
      return term.light && !isBlack(term.factor * term.value);
    });
    for (const Light& spot : spots_)
      seen.outOfCone += !spot.illuminate(node.hit->surface.point, world_.rules());
    for (const Term& term : node.terms) {
      seen.unlinked += term.dark && term.dark->why == DarkTerm::Why::unlinked;
      if (!term.light) continue;
      Survey::Lamp& lamp = survey_.lights[term.light->light];
      if (scattering) {
        ++lamp.places;
        lamp.strongest = std::max(lamp.strongest, maxComponent(term.light->arriving.intensity()));
      }
      if (term.ray < 0) {
        ++seen.facesAway;
        continue;
      }
      const RayNode& shadow = rayAt(tree, term.ray);
      if (!shadow.ends.empty())
        if (const auto* blocked = std::get_if<Blocked>(&shadow.ends.front())) {
          ++seen.blockedBy[blocked->object];
          ++lamp.blocked[{node.hit->object, blocked->object}];
        }
      if (isBlack(shadow.radiance)) continue;
      ++lamp.reached[node.hit->object];
      // Light that reaches glass through other glass, or from the far side of its own, is not counted.
      if (!material.transmits()) arrived(lamp, shadow);
    }
  }

  /// A mirrored or refracted ray that comes from an object and does not stay inside it.
  void sent(const RayNode& from, const RayNode& node) {
    if (node.kind == RayKind::shadow || !from.hit) return;
    if (node.hit && node.hit->object == from.hit->object) return;
    Survey::Seen& seen = survey_.objects[from.hit->object];
    ++seen.sent;
    if (node.hit || maxComponent(node.weight) * brightestSky_ < kVisible / 255.0) return;
    ++seen.leftScene;
    seen.mirroredAway += node.kind == RayKind::reflection;
  }

  void arrived(Survey::Lamp& lamp, const RayNode& shadow) const {
    ++lamp.reachedOthers;
    for (const Filter& filter : shadow.filters) {
      if (filter.shadowless || !refracts(shadow.ray, filter)) continue;
      if (lamp.throughGlass == 0) lamp.glass = filter.object;
      ++lamp.throughGlass;
      break;
    }
  }

  bool refracts(const Ray& ray, const Filter& filter) const {
    for (const Found& found : allCrossings(world_, ray, filter.t * (1 + gammaError(8))))
      if (found.object == filter.object && found.part == filter.part)
        return std::abs(whitted(*world_.bsdfAt(ray, found)).index - 1) > 0.01;  // air's is near 1, too
    return false;
  }

  /// Another surface at the place that the camera ray hit, with the same plane.
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
  std::vector<Light> spots_;
  Real brightestSky_ = 0;
  Survey survey_;
};

}  // namespace

Survey survey(const Scene& scene, const Settings& settings, const World& world) {
  Surveyor surveyor(scene, world);
  forEachTree(sparse(settings), world,
              [&](const RayTree& tree, std::size_t pixel) { surveyor.look(tree, pixel); });
  return surveyor.take();
}

std::vector<int> changedByDepth(const Settings& settings, const World& world, const Survey& survey) {
  constexpr std::uint64_t kMostRays = 1000000;
  constexpr int kMostMore = 30;
  Settings deeper = sparse(settings);
  const Size size{deeper.width, deeper.height};
  std::vector<Bytes> pictures{levels(survey.picture, settings)};
  std::uint64_t rays = 0;
  // Glass behind glass shows nothing before the second ray more: it takes two that change nothing to be sure.
  int unchanged = 0;
  for (int more = 1; more <= kMostMore && rays < kMostRays && unchanged < 2; ++more) {
    deeper.depth = settings.depth + more;
    Job job;
    const auto integrator = makeIntegrator(world, deeper, job);
    PixelTracer tracer(world, *integrator, deeper, size);
    Picture picture = survey.picture;
    for (std::size_t pixel : survey.cutShort)
      picture.pixels[pixel] =
          tracer.sample(static_cast<int>(pixel) % size.width, static_cast<int>(pixel) / size.width, 0);
    rays += tracer.statistics().allRays();
    pictures.push_back(levels(picture, settings));
    unchanged = pictures.back() == pictures[pictures.size() - 2] ? unchanged + 1 : 0;
  }
  std::vector<int> changed;
  for (const Bytes& picture : pictures)
    changed.push_back(different(picture, pictures.back(), survey.cutShort));
  return changed;
}

}  // namespace trace
