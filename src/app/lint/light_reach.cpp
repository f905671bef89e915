// The check of lights that reach nothing.
//
// Places are asked at which paths from the camera arrive, as the integrator would follow them, and those that
// a light shines on first, where the camera sees them or on objects that no path has hit: a light may be
// there for what is not in the picture. Each samples the lights of which nothing has come so far, as an
// integrator asks them: by links, cones, falloff, the material and the tracer's own shadow rays. So a light
// is reported only if it gives exactly nothing at many places.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include "app/lint/checks.h"
#include "base/budget.h"
#include "math/low_discrepancy.h"
#include "math/perpendicular.h"
#include "render/integrators/make_integrator.h"
#include "render/paths/onward.h"
#include "render/samples/pixel.h"
#include "scene/integrators.h"

namespace trace::lint_checks {
namespace {

constexpr Size kSeen{128, 96};  ///< paths across and down the picture
constexpr int kFewPlaces = 200;
constexpr int kMostPlaces = 400000;  ///< asked of all lights together
constexpr int kPlacesOfLight = 4;    ///< places of light of one with a size
constexpr int kRaysOfLight = 400;
constexpr int kDeepest = 8;

/// A light of which nothing has come so far.
struct SilentLight {
  std::uint32_t number;  ///< in World::lights()
  int asked = 0;
  int elsewhere = 0;  ///< points in another direction than the light shines
  int behind = 0;     ///< points where the light is behind the surface
  std::map<std::uint32_t, int> blockedBy{};
};

/// The settings of the sparse picture whose places are asked.
Settings sparseOf(Settings settings) {
  settings.width = kSeen.width;
  settings.height = kSeen.height;
  settings.spp = 1;
  settings.outlines = 0;
  settings.subdivide = 0;
  settings.region = {};
  return settings;
}
/// The settings of an integrator that prepares nothing: only its camera rays are wanted.
Settings withoutPhotons(Settings settings) {
  settings.integrator = IntegratorKind::whitted;
  settings.caustics = 0;
  return settings;
}

class LightSearch {
 public:
  LightSearch(const Settings& settings, const World& world)
      : settings_(settings),
        world_(world),
        integrator_(makeIntegrator(world, withoutPhotons(settings_), job_)),
        pixels_(world, *integrator_, settings_, kSeen),
        rules_(settings_, kSeen),
        photons_(hasTrait(settings, Trait::bringsCaustics)),
        bounces_(hasTrait(settings, Trait::bounces)),
        seen_(world.objectCount()) {
    for (std::uint32_t i = 0; i < world.lights().size(); ++i)
      if (!world.lights()[i].visible()) silent_.push_back({i});
  }

  std::vector<SilentLight> find() {
    Work work("sampling the lights", kSeen.height);
    for (int y = 0; y < kSeen.height && isToAsk(); ++y) {
      work.reached(y);
      for (int x = 0; x < kSeen.width && isToAsk(); ++x)
        pixels_.look(x, y, 0, [&](const CameraRay& camera, const Sampler& sampler) {
          follow(camera.ray, camera.hit, camera.inside, sampler);
        });
    }
    for (int i = 0; i < kRaysOfLight && isToAsk(); ++i)
      for (std::size_t n = silent_.size(); n-- > 0;)
        if (n < silent_.size()) fromLight(silent_[n].number, i);  // others may have been heard, too
    return silent_;
  }

 private:
  bool isToAsk() {
    checkBudget();
    return !silent_.empty() && asked_ < kMostPlaces;
  }

  /// A path from the camera: all that its ray hits, and one ray on from there.
  void follow(Ray ray, std::optional<Hit> hit, Interfaces inside, const Sampler& sampler) {
    for (int depth = 0; hit && depth <= std::min(settings_.depth, kDeepest) && !silent_.empty(); ++depth) {
      seen_[hit->object] = true;
      const Sampler here = sampler.branch(static_cast<std::uint32_t>(depth));
      const Interaction at(pixels_.tracer(), ray, *hit, nullptr, inside, 0);
      ask(at, here);
      Sampler numbers = here.branch(1);
      const std::optional<Onward::Ray> next =
          Onward(at, numbers.next()).choose(numbers.next(), lobeNumbers(here.branch(2)));
      if (!next || (next->kind == RayKind::bounce && !bounces_ && !isGlossy(at.bsdf()))) return;
      const Ray on = hit->leave(next->direction);
      Interfaces there = next->in(inside);
      hit = pixels_.tracer().cast(on, next->kind, there, numbers.next());
      ray = on;
      inside = there;
    }
  }

  /// Follows one ray of the light: the points that it lights, and where the path continues.
  void fromLight(std::uint32_t number, int i) {
    Ray ray = rayOf(number, i);
    Interfaces inside = pixels_.tracer().interfacesAt(ray.origin);
    const Sampler sampler(rules_, i % kSeen.width, i / kSeen.width, 0);
    std::optional<Hit> hit = pixels_.tracer().cast(ray, RayKind::bounce, inside);
    for (int depth = 0; hit && depth <= kDeepest; ++depth) {
      const Interaction at(pixels_.tracer(), ray, *hit, nullptr, inside, 0);
      if (depth == 0) {
        if (!seen_[hit->object]) ask(at, sampler);
        if (!takes(number, at)) return;
      }
      if ((depth == 0 || scatters(at.bsdf())) && cameraSees(*hit, sampler, number, depth > 0)) return;
      if (!bounces_ && !photons_) return;
      Sampler numbers = sampler.branch(static_cast<std::uint32_t>(depth)).branch(1);
      const std::optional<Onward::Ray> next =
          Onward(at, numbers.next()).choose(numbers.next(), lobeNumbers(numbers.branch(2)), true);
      if (!next || (next->kind == RayKind::bounce && !bounces_)) return;
      const Ray on = hit->leave(next->direction);
      if (next->behind) inside = *next->behind;
      hit = pixels_.tracer().cast(on, next->kind, inside, numbers.next());
      ray = on;
    }
  }

  /// The light shines on that place, which is the first on a ray of its own.
  bool takes(std::uint32_t number, const Interaction& at) const {
    return world_.lights(number, at.hit.object) &&
           world_.illuminate(number, at.hit.surface.point).has_value();
  }

  /// Asks what the camera sees at that place; where the light has `arrived` there, that settles it.
  bool cameraSees(const Hit& hit, const Sampler& sampler, std::uint32_t number, bool arrived) {
    const Vec3& point = hit.surface.point;
    const std::optional<Vec2> place = world_.camera().placeOf(point);
    if (!place || !(place->x >= 0 && place->x <= 1 && place->y >= 0 && place->y <= 1)) return false;
    const Ray eye = world_.camera().ray(*place);
    Interfaces around = pixels_.tracer().interfacesAt(eye.origin);
    const std::optional<Hit> first = pixels_.tracer().cast(eye, RayKind::camera, around);
    if (!arrived) {
      follow(eye, first, around, sampler);
      return false;
    }
    constexpr Real kSame = 1e-6;  // tolerance relative to the distance
    const bool same = first && length(first->surface.point - point) <= kSame * length(point - eye.origin);
    if (same) std::erase_if(silent_, [&](const SilentLight& light) { return light.number == number; });
    return same;
  }

  /// Rays of a spot light spread over its cone, those of other lights with a place over the sphere; those of
  /// the sun cross the scene.
  Ray rayOf(std::uint32_t number, int i) const {
    const Vec2 u = sobolPoint(static_cast<std::uint32_t>(i));
    const LightGeometry& light = world_.lightGeometry(number);
    if (light.starts != LightOrigin::parallel)
      return {light.position,
              light.cone ? toCone(u, light.cone->axis, light.cone->cosine) : toCone(u, {0, 0, 1}, -1)};
    const Box3& box = world_.bounds();
    const bool known = !box.empty() && isFinite(box.size());
    const Vec3 middle = known ? box.center() : world_.camera().eye;
    const Vec3 along = world_.lights()[number].reach(world_.rules()).axis, aside = perpendicularTo(along);
    const Real reach = known ? length(box.size()) : 1;
    const Vec2 at{(u.x - 0.5) * reach, (u.y - 0.5) * reach};
    return {middle - along * reach + aside * at.x + cross(along, aside) * at.y, along};
  }

  void ask(const Interaction& at, const Sampler& sampler) {
    if (!scatters(at.bsdf()) && !goesOn(at)) return;
    Sampler numbers = sampler.branch(0);
    std::erase_if(silent_, [&](SilentLight& light) {
      const int places = world_.lightHasSize(light.number) ? kPlacesOfLight : 1;
      ++light.asked;
      ++asked_;
      const int elsewhere = light.elsewhere, behind = light.behind;
      for (int n = 0; n < places; ++n)
        if (arrives(light, at, places == 1 ? kCenter : numbers.next2())) return true;
      // Once for each place, however many of the light's were asked.
      light.elsewhere = std::min(light.elsewhere, elsewhere + 1);
      light.behind = std::min(light.behind, behind + 1);
      return false;
    });
  }

  /// Light continues from there, whatever is scattered.
  bool goesOn(const Interaction& at) const {
    return (bounces_ || photons_) && (at.transmits || !isBlack(at.mirror(false)));
  }

  /// Something of the light arrives from that place of it, or notes why not.
  bool arrives(SilentLight& light, const Interaction& at, const Vec2& place) {
    if (!world_.lights(light.number, at.hit.object)) return ++light.elsewhere, false;
    const auto arriving = world_.illuminate(light.number, at.lightPlace(), place);
    if (!arriving || (isBlack(arriving->intensity()) && isBlack(arriving->extraHighlight)))
      return ++light.elsewhere, false;
    const Color scattered =
        arriving->scattered(scatter(at.bsdf(), at.frame, arriving->toLight, -at.ray.direction));
    if (isBlack(scattered) && !goesOn(at)) return ++light.behind, false;
    if (at.material.shadow < 1 || !world_.lightCastsShadows(light.number)) return true;
    const Ray toward = at.leaveToLight(arriving->toLight);
    if (!isBlack(pixels_.tracer().visible(at.hit, toward, arriving->distance, at.inside))) return true;
    if (const auto found = pixels_.tracer().look(toward, RayKind::shadow)) ++light.blockedBy[found->object];
    return false;
  }

  const Settings settings_;
  const World& world_;
  Job job_;
  std::unique_ptr<const Integrator> integrator_;
  PixelTracer pixels_;
  SampleRules rules_;
  bool photons_;  ///< mirrors and glass have caustics
  bool bounces_;  ///< everything does
  int asked_ = 0;
  std::vector<bool> seen_;  ///< objects that a path from the camera has hit
  std::vector<SilentLight> silent_;
};

}  // namespace

/// After the checks that know a reason, and not where something is reported as unlit. In fog and smoke the
/// air itself is lit.
void lightReachesNothing(const LintScene& s, Findings& findings) {
  if (s.settings.fog > 0 || !s.world.media().empty() || s.survey.met == 0) return;
  for (const SilentLight& light : LightSearch(sparseOf(s.settings), s.world).find()) {
    if (light.asked < kFewPlaces) continue;
    const LightSource& source = s.scene.lights[s.world.lightSource(light.number)];
    const Color* color = source.light.color();
    const bool isOff = !color || isBlack(*color);
    const bool isSaid = std::any_of(findings.begin(), findings.end(), [&](const LintFinding& finding) {
      const SourcePlace& place = finding.message.place;
      return finding.check == "unlit" || (place.line == source.place.line && place.file == source.place.file);
    });
    if (isOff || isSaid) continue;
    const auto most = mostOf(light.blockedBy);
    const int blocked = most == light.blockedBy.end() ? 0 : most->second;
    const bool isBlocked = blocked > 0 && blocked >= light.elsewhere && blocked >= light.behind;
    warn(findings, "light-reaches-nothing", source.place,
         "this light contributes nothing to the picture: " + std::to_string(light.asked) +
             " points were tested, and for most " +
             (isBlocked                         ? quoted(s, most->first) + " is in the way"
              : light.elsewhere >= light.behind ? "it shines elsewhere"
                                                : "it is behind the surface"),
         std::string(isBlocked ? "move the light, or what is in its way"
                               : "move the light to the visible side, or turn it") +
             "; or remove it to save time");
  }
}

}  // namespace trace::lint_checks
