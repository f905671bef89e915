// Whitted's recursive ray tracing (CACM 23(6), 1980), as the courses define it:
//
//   I = ke + ka Ia + sum over lights  Shadow Attenuation Il (kd max(0, N.L) + ks max(0, S)^n)
//     + kr I(mirrored ray) + kt I(refracted ray)
//
// The camera ray has depth 0; a ray of depth k makes new ones while k < the depth set. Nothing takes the
// place of the refracted ray under total internal reflection. No Fresnel term: kr and kt are constants.
#include "render/integrator.h"
#include "shading/optics.h"

namespace trace {
namespace {

struct Path {
  RayKind kind = RayKind::camera;
  int depth = 0;
  Color weight{1};  ///< the largest share of the pixel that this ray can still make
  Color medium{1};  ///< what passes through a unit of length of what the ray runs in
};

Color radianceAlong(Tracer& tracer, const Ray& ray, const Path& path) {
  const std::optional<Hit> hit = tracer.cast(ray, path.kind);
  if (!hit) return Color(0);
  const Settings& settings = tracer.settings();
  const Phong& material = hit->material;
  const SurfacePoint& surface = hit->surface;
  // The inside of glass is shaded with its normal turned to the eye; opaque things are lit from outside only.
  const Vec3 normal = hit->leaving && material.transmits() ? -surface.shading : surface.shading;

  Color sum = material.emissive + material.ambient * tracer.world().ambient();
  for (const Light& light : tracer.world().lights()) {
    const auto arriving = match(light, [&](const auto& l) { return l.illuminate(surface.point); });
    if (!arriving) continue;
    const Color scattered = arriving->intensity * material.scatter(normal, arriving->toLight, -ray.direction);
    if (!isBlack(scattered))
      sum += scattered * tracer.visible(surface, arriving->toLight, arriving->distance);
  }

  const auto worthwhile = [&](const Color& w) {
    return !isBlack(w) && !(maxComponent(w) < settings.threshold);
  };
  if (path.depth < settings.depth) {
    if (const Color share = path.weight * material.reflective; worthwhile(share)) {
      const Vec3 direction = mirrored(ray.direction, normal);
      sum += material.reflective * radianceAlong(tracer, spawnRay(surface, direction),
                                                 {RayKind::reflection, path.depth + 1, share, path.medium});
    }
    const bool perCrossing = settings.glass == Glass::perCrossing;
    const Color filter = perCrossing ? material.transmissive : Color(1);
    if (const Color share = path.weight * filter; material.transmits() && worthwhile(share)) {
      const Color medium = perCrossing || hit->leaving ? Color(1) : material.transmissive;
      const Real ratio =
          hit->leaving ? material.index / settings.airIndex : settings.airIndex / material.index;
      if (const auto direction = refracted(ray.direction, normal, ratio))
        sum += filter * radianceAlong(tracer, spawnRay(surface, *direction),
                                      {RayKind::refraction, path.depth + 1, share, medium});
    }
  }
  return path.medium == Color(1) ? sum : sum * pow(path.medium, hit->t);  // Beer's law
}

}  // namespace

Color whitted(Tracer& tracer, const Ray& ray) { return radianceAlong(tracer, ray, {}); }

}  // namespace trace
