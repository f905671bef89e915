#include "render/integrators/whitted.h"

#include <span>
#include <utility>
#include <vector>

#include "math/low_discrepancy.h"
#include "render/footprint.h"
#include "render/gather.h"
#include "shading/dispersion.h"
#include "shading/fresnel.h"
#include "shading/optics.h"

namespace trace {
namespace {

struct Path {
  RayKind kind = RayKind::camera;
  int depth = 0;
  Color weight{1};    ///< the largest share of the pixel that this ray can still make
  Real spread = 0.5;  ///< where the wavelengths of a fan lie: spectralFan()
  const Differentials* differentials = nullptr;  ///< of the ray, if they are wanted
  Real ink = 0;                                  ///< how much of it an outline covers
};

/// Branches of a place's numbers: its lights by their number, and the rays that go on; of a fan the refracted
/// rays have the numbers from kRefracted on.
constexpr std::uint32_t kMirrored = 0x80000000u, kRefracted = 0x80000001u;
/// The numbers by which a direction into a lobe is chosen.
constexpr std::uint32_t kLobe = 0x7fffffffu;

/// Both sides of a surface that was hit, and what fills its body.
struct Boundary {
  Filling body;
  Sides sides;
};

/// The radiance along a ray that starts in `inside`.
Color follow(Tracer& tracer, const Ray& ray, const Path& path, Interfaces inside, const Sampler& sampler);

/// Where sample k of a pixel has its wavelengths between those of sample 0: together they lie evenly (van der
/// Corput 1935).
Real spreadOf(int k) {
  Real spread = 0, step = 0.5;
  for (auto n = static_cast<unsigned>(k) + 1; n > 0; n >>= 1, step /= 2)
    if (n & 1) spread += step;
  return spread;
}

/// A path of all colours is split into wavelengths there.
bool splits(const Sides& sides, const Interfaces& inside, const Settings& settings) {
  return settings.wavelengths > 1 && inside.wavelength == 0 &&
         (!sides.before.dispersion.none() || !sides.behind.dispersion.none());
}

/// The share that a surface mirrors by the angle; 0 if that is left to its material.
Real mirroredShare(Fresnel fresnel, Real cosine, const Indices& indices) {
  switch (fresnel) {
    case Fresnel::constant: return 0;
    case Fresnel::schlick: return schlick(cosine, indices.before, indices.behind);
    case Fresnel::exact: return fresnelDielectric(cosine, indices.before, indices.behind);
  }
  return 0;
}

/// The radiance along the ray, which is the one cast last and met `hit`; `inside` is what it was in there.
Color radianceAlong(Tracer& tracer, const Ray& ray, const std::optional<Hit>& hit, const Path& path,
                    const Interfaces& inside, const Sampler& sampler) {
  Gather sum(tracer, path.depth);
  const World& world = tracer.world();
  if (!hit) {
    if (world.outside().isSeenBy(path.kind))
      sum.add(Term::Kind::background, world.outside().view(ray, path.kind).color);
    sum.draw(path.ink);
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
  const Real cosine = -dot(ray.direction, normal);

  const bool transmits = material.transmits();
  std::optional<Boundary> boundary;  // where somebody asks for it
  Indices indices;
  if (transmits || settings.varnish || tracer.records()) {
    boundary.emplace(Boundary{tracer.filling(*hit, material), {}});
    boundary->sides = inside.at(hit->leaving, boundary->body, hit->solid);
    indices = Indices(boundary->sides, inside.wavelength, inside.nested());
  }
  const bool straight = material.passage == Passage::straight;
  const bool coated = settings.varnish && !transmits && material.index != 1 && cosine > 0;
  const Real coat = coated ? fresnelDielectric(cosine, indices.before, indices.behind) : 0;

  sum.add(Term::Kind::emissive, material.emissive);
  sum.add(Term::Kind::ambient, material.ambient * (1 - coat), world.ambient());
  for (std::size_t i = 0; i < world.lights().size(); ++i) {
    const auto light = [&](const Vec2& place, Real share) {
      const auto arriving = world.illuminate(i, surface.point, place);
      if (!arriving) return;
      Scatter parts = scatter(*bsdf, frame, arriving->toLight, -ray.direction);
      parts.diffuse *= Color(1 - coat);
      const Color scattered = arriving->scattered(parts) * share;
      const Color passed = isBlack(scattered) ? Color(0)
                                              : tracer.visible(*hit, arriving->toLight, arriving->distance,
                                                               inside, material.litThrough);
      sum.addLight(i, *arriving, parts, scattered * material.shadow, passed, share);
      if (material.shadow < 1)
        sum.addLight(i, *arriving, parts, scattered * (1 - material.shadow), Color(1), share);
    };
    if (!world.lightHasSize(i)) {
      light(kCenter, 1);
      continue;
    }
    Sampler numbers = sampler.branch(static_cast<std::uint32_t>(i));
    const int rays = settings.lightSamples;
    const Vec2 first = numbers.next2();
    for (int n = 0; n < rays; ++n)
      light(rotated(sobolPoint(static_cast<std::uint32_t>(n)), first), 1.0 / rays);
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
  const auto onward = [&](RayKind kind, const Color& share) {
    return Path{kind, path.depth + 1, path.weight * share, path.spread};
  };
  sum.note(indices);
  const SpectralShare whole{inside.wavelength, Color(1)};
  std::vector<SpectralShare> fan;
  if (transmits && !straight && splits(boundary->sides, inside, settings))
    fan = spectralFan(settings.wavelengths, path.spread);
  const std::span<const SpectralShare> shares =
      fan.empty() ? std::span(&whole, transmits ? 1 : 0) : std::span(std::as_const(fan));
  // By Fresnel's formula glass mirrors the share R and lets 1 - R through.
  const Fresnel fresnel = straight                                 ? Fresnel::constant
                          : material.passage == Passage::byFresnel ? Fresnel::exact
                                                                   : settings.fresnel;
  const auto shareMirrored = [&](const SpectralShare& share) {
    return mirroredShare(fresnel, cosine, Indices(boundary->sides, share.nanometres, false));
  };
  const bool asSaid = material.passage != Passage::asSaid || settings.glass == Glass::perCrossing;
  const Color filters = asSaid ? material.transmissive : Color(1);
  const bool glossy = settings.glossy && isGlossy(*bsdf);
  Color mirror(coat);
  if (fresnel != Fresnel::constant && transmits)
    for (const SpectralShare& share : shares)
      mirror += share.weight * (shareMirrored(share) * material.sharp);
  else if (!glossy)
    mirror += mirrorWeight(*bsdf, cosine) * (1 - coat);
  if (glossy) {  // one ray into the lobe, in place of those that stand for its core
    if (transmits) mirror = Color(0);
    Sampler numbers = sampler.branch(kLobe);
    const Real choose = numbers.next();
    const auto drawn = sample(*bsdf, frame, -ray.direction, choose, numbers.next2(), Transport::importance);
    const Color lobe =
        drawn ? scatter(*bsdf, frame, drawn->toLight, -ray.direction).specular * (1 / (kPi * drawn->density))
              : Color(0);
    if (!isBlack(lobe)) {
      const bool through = dot(drawn->toLight, normal) < 0;
      const Path next = onward(through ? RayKind::refraction : RayKind::reflection, lobe * (1 - coat));
      if (worthwhile(next)) {
        Interfaces there = inside;
        if (through && boundary) there.pass(hit->leaving, boundary->body, hit->solid);
        sum.add(through ? Term::Kind::refraction : Term::Kind::reflection, lobe * (1 - coat),
                follow(tracer, hit->leave(drawn->toLight), next, std::move(there),
                       sampler.branch(kMirrored + through)));
      }
    }
  }
  if (!isBlack(mirror)) {
    Path next = onward(RayKind::reflection, mirror);
    if (worthwhile(next)) {
      const Footprint widened = mirroredAt(world, *hit, footprint.get(), ray.direction, normal);
      next.differentials = widened.get();
      sum.add(Term::Kind::reflection, mirror,
              follow(tracer, hit->leave(mirrored(ray.direction, normal)), next, inside,
                     sampler.branch(kMirrored)));
    }
  }
  std::uint32_t branch = kRefracted;
  bool total = false;
  for (const SpectralShare& share : glossy ? shares.first(0) : shares) {
    const Color filter =
        straight ? passWeight(*bsdf, cosine) : filters * ((1 - shareMirrored(share)) * material.sharp);
    Path next = onward(RayKind::refraction, share.weight * filter);
    const std::uint32_t number = branch++;
    if (!worthwhile(next)) continue;
    const auto& [body, sides] = *boundary;
    const Real ratio =
        straight ? 1 : sides.before.indexAt(share.nanometres) / sides.behind.indexAt(share.nanometres);
    const auto direction = straight ? std::optional(ray.direction) : refracted(ray.direction, normal, ratio);
    if (direction) {
      Interfaces behind = inside;
      if (!straight) behind.pass(hit->leaving, body, hit->solid);
      behind.wavelength = share.nanometres;
      const Footprint widened =
          refractedAt(world, *hit, footprint.get(), ray.direction, *direction, normal, ratio);
      next.differentials = widened.get();
      sum.add(Term::Kind::refraction, share.weight * filter,
              follow(tracer, hit->leave(*direction), next, std::move(behind), sampler.branch(number)));
    } else if (!std::exchange(total, true)) {
      sum.stop(TotalInternalReflection{});
    }
  }
  sum.draw(path.ink);
  const Color& medium = inside.around().passes;
  return sum.radiance(medium == Color(1) ? Color(1) : pow(medium, hit->t));  // Beer's law
}

Color follow(Tracer& tracer, const Ray& ray, const Path& path, Interfaces inside, const Sampler& sampler) {
  const std::optional<Hit> hit = tracer.cast(ray, path.kind, inside);
  return radianceAlong(tracer, ray, hit, path, inside, sampler);
}

}  // namespace

Color Whitted::radiance(Tracer& tracer, Sampler sampler, const CameraRay& camera) const {
  Path path;
  path.spread = spreadOf(sampler.sample());
  path.differentials = camera.differentials;
  path.ink = camera.ink;
  return radianceAlong(tracer, camera.ray, camera.hit, path, camera.inside, sampler);
}

}  // namespace trace
