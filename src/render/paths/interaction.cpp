#include "render/paths/interaction.h"

#include "math/elementary.h"
#include "math/low_discrepancy.h"
#include "render/lights/light_choice.h"
#include "render/media/media.h"
#include "render/rays/fog.h"
#include "shading/materials/marschner.h"
#include "shading/materials/subsurface.h"
#include "shading/optics/fresnel.h"
#include "shading/optics/optics.h"

namespace trace {

namespace {

/// Whether light is seen on the side from which the shading normal points away. The inside of glass is shaded
/// with its normal turned to the eye, and so is the back of what is shaded from both sides; other opaque
/// things are lit from outside only.
bool isTurned(const Ray& ray, const Hit& hit, bool transmits) {
  return hit.twoSided ? hit.isBehind(ray.direction) : hit.leaving && transmits;
}

}  // namespace

Interaction::Interaction(Tracer& tracer_, const Ray& ray_, const Hit& hit_, const Differentials* footprint,
                         const Interfaces& inside_, Real spread)
    : tracer(tracer_),
      ray(ray_),
      hit(hit_),
      inside(inside_),
      bsdf_(tracer.world().shade(hit, footprint)),
      material(whitted(*bsdf_)),
      normal(isTurned(ray, hit, material.transmits()) ? -hit.surface.shading : hit.surface.shading),
      frame(tracer.world().frame(hit, *bsdf_, normal)),
      cosine(-dot(ray.direction, normal)),
      transmits(material.transmits()),
      straight(material.passage == Passage::straight) {
  const Settings& settings = tracer.settings();
  if (transmits || settings.varnish || tracer.records()) {
    boundary_.emplace(Boundary{tracer.filling(hit, material), {}});
    boundary_->sides = inside.at(hit.leaving, boundary_->body, hit.solid);
    indices = Indices(boundary_->sides, inside.wavelength, inside.nested());
  }
  const bool coated = settings.varnish && !transmits && material.index != 1 && cosine > 0;
  coat = coated ? fresnelDielectric(cosine, indices.before, indices.behind) : 0;
  // By Fresnel's formula glass mirrors the share R and lets 1 - R through.
  fresnel_ = straight                                 ? Fresnel::constant
             : material.passage == Passage::byFresnel ? Fresnel::exact
                                                      : settings.fresnel;
  if (settings.smoothTerminator && !transmits && !material.litThrough) raise(isTurned(ray, hit, transmits));
  whole_.nanometres = inside.wavelength;
  const auto disperses = [](const Sides& sides) {
    return !sides.before.dispersion.none() || !sides.behind.dispersion.none();
  };
  if (settings.wavelengths > 1 && transmits && !straight && inside.wavelength == 0 &&
      disperses(boundary_->sides))
    fan_ = spectralFan(settings.wavelengths, spread);
}

/// From the hit straight to the raised place nothing may be hit: so no light comes through what stands there,
/// and none into a closed body.
void Interaction::raise(bool turned) {
  const std::optional<SurfacePoint> place = tracer.world().raised(hit, turned);
  if (!place) return;
  constexpr Real kRounding = 0x1p-20;
  const Vec3 outward = turned ? -hit.surface.normal : hit.surface.normal;
  const Vec3 from = offsetPoint(hit.surface, outward), to = offsetPoint(*place, outward);
  const std::optional<Found> met = tracer.look({from, to - from}, RayKind::shadow);
  if (!met || met->t > 1 + kRounding) raised_ = to;
}

/// Whether light gets farther in the body than places on it are known.
bool Interaction::spreads(const Subsurface& said) const {
  constexpr Real kKnown = 0x1p-44;
  const Color loses = said.scatters + said.absorbs;
  const Real least = min(loses.r, min(loses.g, loses.b)) * said.millimetres;
  const Box3 box = tracer.world().boundsOf(hit.object);
  const Real size = maxComponent(abs(hit.surface.point)) + (box.empty() ? 0 : length(box.size()));
  return !(least * size * kKnown > 1);
}

bool Interaction::sendsEvenly() const {
  return scatters(*bsdf_) && !isGlossy(*bsdf_) && !bsdf_->is<MarschnerBsdf>();
}

std::unique_ptr<const SubsurfaceBsdf> Interaction::takeBody() {
  const auto* whole = bsdf_->as<SubsurfaceBsdf>();
  if (!whole || !spreads(whole->said)) return {};
  auto body = std::make_unique<const SubsurfaceBsdf>(*whole);
  bsdf_.replace(body->only(SubsurfaceBsdf::Part::surface));
  return body;
}

void Interaction::letIn() {
  if (const auto* whole = bsdf_->as<SubsurfaceBsdf>()) bsdf_.replace(whole->only(SubsurfaceBsdf::Part::exit));
  coat = 0;
}

void Interaction::addLights(Gather& sum, const Sampler& sampler) const {
  const World& world = tracer.world();
  const Vec3& from = lightPlace();
  const Settings& settings = tracer.settings();
  const bool plainFog = settings.fogSamples == 0 && !hasTrait(settings, Trait::scattersInMedia);
  const bool foggy = settings.fog > 0 && !plainFog;
  const auto ask = [&](const AskedLight& asked) __attribute__((always_inline)) {
    const std::uint32_t i = asked.light;
    const auto none = [&](DarkTerm::Why why) { asked.n == 0 ? sum.noteDark(i, why) : void(); };
    if (!world.lights(i, hit.object)) return none(DarkTerm::Why::unlinked);
    auto arriving = world.illuminate(i, from, asked.point);
    if (!arriving) return none(DarkTerm::Why::shinesElsewhere);
    if (foggy)
      arriving->attenuation *= Fog(tracer.settings()).left({from, arriving->toLight}, arriving->distance);
    Scatter parts = scatter(*bsdf_, frame, arriving->toLight, -ray.direction);
    parts.diffuse *= Color(1 - coat);
    const Color scattered = arriving->scattered(parts) * asked.share;
    Color passed(1);
    if (!isBlack(scattered) && world.lightCastsShadows(i)) {
      const Ray toward = leaveToLight(arriving->toLight);
      passed = tracer.visible(hit, toward, arriving->distance, inside);
      if (!world.media().empty())
        passed = throughBodies(tracer, passed, toward, arriving->distance,
                               asked.sampler.branch(Branch::lightMedia, asked.branch).branch(asked.n));
    }
    sum.addLight(i, *arriving, parts, scattered * material.shadow, passed, asked.share, asked.probability);
    if (material.shadow < 1)
      sum.addLight(i, *arriving, parts, scattered * (1 - material.shadow), Color(1), asked.share,
                   asked.probability);
  };
  askLights(tracer, from, &normal, sampler, settings.lightSamples, ask);
}

void Interaction::addOpen(Gather& sum, Term::Kind kind, const Color& factor, int rays,
                          const Sampler& sampler) const {
  const Vec2 first = sampler.branch(Branch::occlusion).next2();
  const Basis basis = Frame{normal}.basis();
  const Real reach = tracer.settings().occlusionReach;
  Sampler chances = sampler.branch(Branch::occlusionHoles);
  for (int n = 0; n < rays; ++n) {
    const Vec2 u = rotated(sobolPoint(static_cast<std::uint32_t>(n)), first);
    const Vec3 direction = basis.toWorld(cosineDirection(u));
    Interfaces there = inside;
    const std::optional<Hit> met =
        tracer.cast(leaveToLight(direction), RayKind::bounce, there, tracer.chance(chances), Tracer::kSky);
    Color open;
    {
      Gather beyond(tracer, 1);
      if (!met || (reach > 0 && met->t > reach))
        beyond.add(Term::Kind::background, Color(1));
      else
        beyond.stop(Blocked{met->object, met->part, met->t, sharesOf(met->materials)});
      open = beyond.radiance();
    }
    sum.add(kind, factor * (1.0 / rays), open);
  }
}

namespace {

/// How high above the place rays start that look for the surface around it, as a fraction of the distance.
constexpr Real kLookDown = 0.4;

/// The direction as the rotation takes it that turns one unit normal to another, which is not opposite.
Vec3 turnedAlong(const Vec3& direction, const Vec3& from, const Vec3& to) {
  const Vec3 both = from + to;
  return direction - both * (2 * dot(both, direction) / dot(both, both)) + to * (2 * dot(from, direction));
}

}  // namespace

/// Whether a ray from so high above the place down to a point of the plane there hits the surface as
/// it continues from the place: about there, and bent no more than PhotonMap takes for one surface.
bool Interaction::continues(const Vec3& to, Real height) const {
  constexpr Real kNearest = 0.7, kFarthest = 2, kSteepest = 0.045;  // as a fraction of the distance
  const Vec3 up = trueNormal(), from = hit.surface.point + up * height;
  const Ray down{from, normalize(to - from)};
  const std::optional<Found> found = tracer.look(down, RayKind::bounce);
  if (!found) return false;
  const SurfacePoint there = tracer.world().surface(down, *found);
  const Vec3 facing = dot(there.normal, down.direction) < 0 ? there.normal : -there.normal;
  if (dot(facing, up) < PhotonMap::kAlike) return false;
  const Vec3 way = there.point - hit.surface.point;
  const Real distance = length(to - hit.surface.point), away = length(way);
  return away > kNearest * distance && away < kFarthest * distance &&
         std::abs(dot(way, facing + up)) / 2 < kSteepest * away;
}

bool Interaction::hasDisk(Real radius, Sampler numbers) const {
  // Where fewer lie on the surface than between two rays, 0.4 % of the kernel are missing.
  constexpr int kLooks = 6;
  constexpr Real kRim = 0.9;  // beyond it hardly any photon counts
  if (!(radius > 0)) return true;
  const Real height = kLookDown * radius;
  const std::optional<Found> above = tracer.look(hit.leave(trueNormal()), RayKind::bounce);
  if (above && above->t < height) return false;
  const Basis basis = Frame{trueNormal()}.basis();
  const Real first = numbers.next();
  for (int n = 0; n < kLooks; ++n) {
    const math::SinCos angle = math::sincos(2 * kPi * (first + n) / kLooks);
    const Vec3 out = basis.x * angle.cos + basis.y * angle.sin;
    if (!continues(hit.surface.point + out * (kRim * radius), height)) return false;
  }
  return true;
}

Real Interaction::shareOfDisk(Real radius, Sampler numbers) const {
  constexpr std::uint32_t kLooks = 32;
  constexpr Real kLeast = 0.2;  // a share that is found smaller says little
  const Basis basis = Frame{trueNormal()}.basis();
  const Vec2 first = numbers.next2();
  int there = 0;
  for (std::uint32_t n = 0; n < kLooks; ++n) {
    const Vec2 u = rotated(sobolPoint(n, 0), first);
    const Real away = radius * std::sqrt(1 - std::sqrt(u.x));
    const math::SinCos angle = math::sincos(2 * kPi * u.y);
    const Vec3 out = basis.x * angle.cos + basis.y * angle.sin;
    there += continues(hit.surface.point + out * away, kLookDown * away);
  }
  return std::max(kLeast, static_cast<Real>(there) / kLooks);
}

void Interaction::addCaustics(Gather& sum, const PhotonMap& photons, const Sampler& numbers) const {
  if (photons.empty() || !scatters(*bsdf_)) return;
  const PhotonMap::Near near = photonsOf(photons);
  if (near.count == 0) return;
  const Real radius = std::sqrt(near.radius2);
  const Real share = hasDisk(radius, numbers.branch(0)) ? 1 : shareOfDisk(radius, numbers.branch(1));
  addPhotons(sum, Term::Kind::caustic, near, true, share);
}

void Interaction::addPhotons(Gather& sum, Term::Kind kind, const PhotonMap::Near& near, bool all, Real share,
                             Real apart) const {
  Color light;
  std::size_t count = 0;
  PhotonTerm counted;
  const Vec3 up = trueNormal();
  for (std::size_t i = 0; i < near.count; ++i) {
    const Photon& photon = *near.photons[i];
    if (photon.flown < apart) continue;
    // A bent surface gets light next to the place from below the horizon here: without it, the density would
    // lack that light. It counts at the angle at which it arrived.
    Vec3 toLight = -photon.direction;
    if (!(dot(toLight, up) > 0)) toLight = turnedAlong(toLight, photon.normal, up);
    const Real lit = dot(toLight, normal);
    if (!(lit > 0)) continue;
    const Scatter parts = scatter(*bsdf_, frame, toLight, -ray.direction);
    light += photon.power * (all ? parts.sum() : parts.diffuse) * (near.perArea(i) / (kPi * lit));
    ++count;
    if (tracer.records()) counted.photons.push_back(photon);
  }
  counted.count = count;
  counted.radius = std::sqrt(near.radius2);
  if (count > 0) sum.add(kind, light * ((1 - coat) / share), counted);
}

Real Interaction::mirroredShare(const SpectralShare& share) const {
  if (fresnel_ == Fresnel::constant) return 0;  // that is left to the material
  const Indices at(boundary_->sides, share.nanometres, false);
  return fresnel_ == Fresnel::schlick ? schlick(cosine, at.before, at.behind)
                                      : fresnelDielectric(cosine, at.before, at.behind);
}

Color Interaction::mirrorOfGlass(bool follow) const {
  if (follow && isGlossy(*bsdf_)) return Color(0);
  Color mirror(coat);
  if (fresnel_ == Fresnel::constant)
    return mirror + (follow ? exactMirrorWeight(*bsdf_, cosine) : mirrorWeight(*bsdf_, cosine)) * (1 - coat);
  for (const SpectralShare& share : shares())
    mirror += share.weight * (mirroredShare(share) * material.sharp);
  return mirror;
}

Color Interaction::filter(const SpectralShare& share) const {
  if (straight) return passWeight(*bsdf_, cosine);
  const bool asSaid = material.passage != Passage::asSaid || tracer.settings().glass == Glass::perCrossing;
  const Color filters = asSaid ? material.transmissive : Color(1);
  return filters * ((1 - mirroredShare(share)) * material.sharp);
}

Real Interaction::ratio(const SpectralShare& share) const {
  return straight ? 1
                  : boundary_->sides.before.indexAt(share.nanometres) /
                        boundary_->sides.behind.indexAt(share.nanometres);
}

std::optional<Vec3> Interaction::through(const SpectralShare& share) const {
  return straight ? std::optional(ray.direction) : refracted(ray.direction, normal, ratio(share));
}

Interfaces Interaction::behind() const {
  Interfaces there = inside;
  if (boundary_ && !straight) there.pass(hit.leaving, boundary_->body, hit.solid);
  return there;
}

}  // namespace trace
