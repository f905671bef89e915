#include "render/integrators/whitted.h"

#include "render/footprint.h"
#include "render/gather.h"
#include "shading/optics.h"

namespace trace {
namespace {

struct Path {
  RayKind kind = RayKind::camera;
  int depth = 0;
  Color weight{1};  ///< the largest share of the pixel that this ray can still make
  Color medium{1};  ///< what passes through a unit of length of what the ray runs in
  const Differentials* differentials = nullptr;  ///< of the ray, if they are wanted
};

/// Branches of a place's numbers: its lights by their number, and the rays that go on.
constexpr std::uint32_t kMirrored = 0x80000000u, kRefracted = 0x80000001u;

Color follow(Tracer& tracer, const Ray& ray, const Path& path, const Sampler& sampler);

/// The radiance along the ray, which is the one cast last and met `hit`.
Color radianceAlong(Tracer& tracer, const Ray& ray, const std::optional<Hit>& hit, const Path& path,
                    const Sampler& sampler) {
  Gather sum(tracer, path.depth);
  const World& world = tracer.world();
  if (!hit) {
    if (world.outside().isSeenBy(path.kind))
      sum.add(Term::Kind::background, world.outside().view(ray.direction, path.kind).color);
    return sum.radiance();
  }
  const Settings& settings = tracer.settings();
  Footprint footprint;  // null where none is wanted
  if (path.differentials) footprint = arrivedAt(*hit, *path.differentials, ray.direction);
  const PlaceBsdf bsdf = world.shade(*hit, footprint.get());
  sum.note(*bsdf);
  const WhittedTerms& material = whitted(*bsdf);
  const SurfacePoint& surface = hit->surface;
  // The inside of glass is shaded with its normal turned to the eye, as are sheets that are shaded from both
  // sides, there by the normal that is shaded; other opaque things are lit from outside only.
  const bool turned =
      hit->twoSided ? dot(ray.direction, surface.shading) > 0 : hit->leaving && material.transmits();
  const Vec3 normal = turned ? -surface.shading : surface.shading;
  const Frame frame = world.frame(*hit, *bsdf, normal);

  sum.add(Term::Kind::emissive, material.emissive);
  sum.add(Term::Kind::ambient, material.ambient, world.ambient());
  for (std::size_t i = 0; i < world.lights().size(); ++i) {
    const auto light = [&](const Vec2& place, Real share) {
      const auto arriving = world.illuminate(i, surface.point, place);
      if (!arriving) return;
      const Scatter parts = scatter(*bsdf, frame, arriving->toLight, -ray.direction);
      const Color scattered = arriving->scattered(parts) * share;
      const Color passed =
          isBlack(scattered) ? Color(0) : tracer.visible(*hit, arriving->toLight, arriving->distance);
      sum.addLight(i, *arriving, parts, scattered * material.shadow, passed);
      if (material.shadow < 1) sum.addLight(i, *arriving, parts, scattered * (1 - material.shadow), Color(1));
    };
    if (!world.lightHasSize(i)) {
      light(kCenter, 1);
      continue;
    }
    Sampler numbers = sampler.branch(static_cast<std::uint32_t>(i));
    const int rays = settings.lightSamples;
    for (int n = 0; n < rays; ++n) light(numbers.next2(), 1.0 / rays);
  }

  const auto worthwhile = [&](const Path& next) {
    if (next.depth > settings.depth)
      sum.stop(DepthLimit{next.kind, settings.depth});
    else if (isBlack(next.weight) || maxComponent(next.weight) < settings.threshold)
      sum.stop(BelowThreshold{next.kind, maxComponent(next.weight), settings.threshold});
    else
      return true;
    return false;
  };
  const Indices indices = Interfaces(settings.airIndex).at(hit->leaving, material.index);
  sum.note(indices);
  // By Schlick's approximation of Fresnel's formula glass mirrors the share R and lets 1 - R through.
  const bool fresnel = settings.fresnel == Fresnel::schlick && material.transmits();
  const Real R = fresnel ? schlick(-dot(ray.direction, normal), indices.before, indices.behind) : 0;
  const Color mirror = fresnel ? Color(R) : mirrorWeight(*bsdf, -dot(ray.direction, normal));
  if (!isBlack(mirror)) {
    Path next{RayKind::reflection, path.depth + 1, path.weight * mirror, path.medium};
    if (worthwhile(next)) {
      const Footprint onward = mirroredAt(world, *hit, footprint.get(), ray.direction, normal);
      next.differentials = onward.get();
      sum.add(Term::Kind::reflection, mirror,
              follow(tracer, hit->leave(mirrored(ray.direction, normal)), next, sampler.branch(kMirrored)));
    }
  }
  if (material.transmits()) {
    const bool perCrossing = settings.glass == Glass::perCrossing;
    const Color filter = (perCrossing ? material.transmissive : Color(1)) * (1 - R);
    Path next{RayKind::refraction, path.depth + 1, path.weight * filter,
              perCrossing || hit->leaving ? Color(1) : material.transmissive};
    if (worthwhile(next)) {
      const Real ratio = indices.before / indices.behind;
      if (const auto direction = refracted(ray.direction, normal, ratio)) {
        const Footprint onward =
            refractedAt(world, *hit, footprint.get(), ray.direction, *direction, normal, ratio);
        next.differentials = onward.get();
        sum.add(Term::Kind::refraction, filter,
                follow(tracer, hit->leave(*direction), next, sampler.branch(kRefracted)));
      } else
        sum.stop(TotalInternalReflection{});
    }
  }
  return sum.radiance(path.medium == Color(1) ? Color(1) : pow(path.medium, hit->t));  // Beer's law
}

Color follow(Tracer& tracer, const Ray& ray, const Path& path, const Sampler& sampler) {
  const std::optional<Hit> hit = tracer.cast(ray, path.kind);
  return radianceAlong(tracer, ray, hit, path, sampler);
}

}  // namespace

Color Whitted::radiance(Tracer& tracer, Sampler sampler, const CameraRay& camera) const {
  Path path;
  path.differentials = camera.differentials;
  return radianceAlong(tracer, camera.ray, camera.hit, path, sampler);
}

}  // namespace trace
