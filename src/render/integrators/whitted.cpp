#include "render/integrators/whitted.h"

#include "render/gather.h"
#include "shading/optics.h"

namespace trace {
namespace {

struct Path {
  RayKind kind = RayKind::camera;
  int depth = 0;
  Color weight{1};  ///< the largest share of the pixel that this ray can still make
  Color medium{1};  ///< what passes through a unit of length of what the ray runs in
};

Color follow(Tracer& tracer, const Ray& ray, const Path& path);

/// The radiance along the ray, which is the one cast last and met `hit`.
Color radianceAlong(Tracer& tracer, const Ray& ray, const std::optional<Hit>& hit, const Path& path) {
  Gather sum(tracer, path.depth);
  const World& world = tracer.world();
  if (!hit) {
    if (path.kind == RayKind::camera) sum.add(Term::Kind::background, world.background(ray));
    return sum.radiance();
  }
  const Settings& settings = tracer.settings();
  const PlaceBsdf bsdf = world.shade(*hit);
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
    const auto arriving = world.illuminate(i, surface.point);
    if (!arriving) continue;
    const Scatter parts = scatter(*bsdf, frame, arriving->toLight, -ray.direction);
    const Color scattered = arriving->scattered(parts);
    const Color passed =
        isBlack(scattered) ? Color(0) : tracer.visible(*hit, arriving->toLight, arriving->distance);
    sum.addLight(i, *arriving, parts, scattered * material.shadow, passed);
    if (material.shadow < 1) sum.addLight(i, *arriving, parts, scattered * (1 - material.shadow), Color(1));
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
    const Path next{RayKind::reflection, path.depth + 1, path.weight * mirror, path.medium};
    if (worthwhile(next))
      sum.add(Term::Kind::reflection, mirror,
              follow(tracer, hit->leave(mirrored(ray.direction, normal)), next));
  }
  if (material.transmits()) {
    const bool perCrossing = settings.glass == Glass::perCrossing;
    const Color filter = (perCrossing ? material.transmissive : Color(1)) * (1 - R);
    const Path next{RayKind::refraction, path.depth + 1, path.weight * filter,
                    perCrossing || hit->leaving ? Color(1) : material.transmissive};
    if (worthwhile(next)) {
      if (const auto direction = refracted(ray.direction, normal, indices.before / indices.behind))
        sum.add(Term::Kind::refraction, filter, follow(tracer, hit->leave(*direction), next));
      else
        sum.stop(TotalInternalReflection{});
    }
  }
  return sum.radiance(path.medium == Color(1) ? Color(1) : pow(path.medium, hit->t));  // Beer's law
}

Color follow(Tracer& tracer, const Ray& ray, const Path& path) {
  const std::optional<Hit> hit = tracer.cast(ray, path.kind);
  return radianceAlong(tracer, ray, hit, path);
}

}  // namespace

Color Whitted::radiance(Tracer& tracer, Sampler, const CameraRay& camera) const {
  return radianceAlong(tracer, camera.ray, camera.hit, {});
}

}  // namespace trace
