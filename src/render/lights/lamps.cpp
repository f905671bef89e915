#include "render/lights/lamps.h"

#include <algorithm>
#include <cmath>

#include "geometry/mesh/mesh_tree.h"
#include "geometry/shapes/solids/sphere.h"
#include "geometry/shapes/solids/square.h"
#include "image/srgb.h"
#include "math/warp.h"
#include "render/rays/fog.h"
#include "render/rays/gather.h"
#include "shading/lights/panel.h"
#include "shading/scattering.h"

namespace trace {
namespace {

constexpr Real kSphere = 4 * kPi;
constexpr Real kBelowOne = 1 - 0x1p-53;

/// The factor by which it scales all lengths alike; 0 if it does not.
Real uniformScale(const Affine& m) {
  const Vec3 x = linear(m, Vec3{1, 0, 0}), y = linear(m, Vec3{0, 1, 0}), z = linear(m, Vec3{0, 0, 1});
  const Real scale = length(x), close = 1e-9 * scale * scale;
  const bool alike =
      std::abs(dot(y, y) - scale * scale) < close && std::abs(dot(z, z) - scale * scale) < close;
  const bool square =
      std::abs(dot(x, y)) < close && std::abs(dot(y, z)) < close && std::abs(dot(z, x)) < close;
  return alike && square ? scale : 0;
}

}  // namespace

bool Lamps::canSample(const World& world, std::uint32_t object) {
  const std::string_view shape = world.shapeOf(object);
  return world.meshTree(object) || shape == Square::kKeyword || BodyLamp::of(world, object);
}

Lamps::Lamps(const World& world, int threads, bool onlyHere)
    : sky_(world.outside(), threads, onlyHere),
      clear_(!world.hasHoles() && !world.hasShadowless() && !world.hasPanes()),
      first_(world.objectCount(), kNone) {
  for (std::uint32_t object = 0; object < world.objectCount(); ++object) {
    const Color emissive = world.termsOf(object).emissive;
    const std::string_view shape = world.shapeOf(object);
    if (isBlack(emissive) || shape.empty()) continue;
    const auto first = static_cast<std::uint32_t>(parts_.size());
    const Affine m = world.worldFromObject(object);
    if (const MeshTree* tree = world.meshTree(object)) {
      const MeshData& mesh = tree->data();
      for (const Triangle& t : mesh.triangles) {
        const auto corner = [&](std::size_t i) { return (m * Vec3(mesh.points[t[i]])); };
        const Vec3 origin = corner(0), a = corner(1) - origin, b = corner(2) - origin;
        const Real area = length(cross(a, b)) / 2;
        add({Part::Kind::triangle, object, origin, a, b, area, 0}, area, 2, emissive);
      }
    } else if (shape == Square::kKeyword) {
      const Vec3 a = linear(m, Vec3{1, 0, 0}), b = linear(m, Vec3{0, 1, 0});
      const bool upright = std::abs(dot(a, b)) <= 1e-9 * length(a) * length(b);
      const Real area = length(cross(a, b));
      add({upright && !onlyHere ? Part::Kind::rectangle : Part::Kind::parallelogram, object,
           m * Vec3{-0.5, -0.5, 0}, a, b, area, 0},
          area, 2, emissive);
    } else if (const Real radius = uniformScale(m); shape == Sphere::kKeyword && radius > 0) {
      add({Part::Kind::sphere, object, m * Vec3{}, {}, {}, radius, 0}, kSphere * radius * radius, 1,
          emissive);
    } else if (const auto body = BodyLamp::of(world, object)) {
      add({Part::Kind::body, object, body->middle(), {}, {}, body->radius(), 0, bodies_.size()}, body->area(),
          body->closed() ? 1 : 2, emissive);
      bodies_.push_back(*body);
    }
    if (parts_.size() > first) first_[object] = first;
  }
  if (world.outside().isSeenBy(RayKind::bounce)) portals_ = world.portals();
  constexpr std::size_t kFew = 32;
  if (parts_.size() > kFew) {
    std::vector<LightReach> reaches;
    reaches.reserve(parts_.size());
    for (const Part& part : parts_) reaches.push_back(part.reach(part.share / kPi));
    tree_ = LightTree(reaches);
  }
  Real sum = 0;
  for (const Part& part : parts_) sums_.push_back(sum += part.share);
  for (Part& part : parts_) part.share /= sum;
  for (Real& s : sums_) s /= sum;
}

void Lamps::add(const Part& part, Real area, Real sides, const Color& emissive) {
  parts_.push_back(part);
  parts_.back().share = area * luminanceOf(emissive);
  power_ += kPi * sides * parts_.back().share;
}

/// `power`: what its light is at distance 1 if it is turned to a place, as a part of pi.
LightReach Lamps::Part::reach(Real power) const {
  LightReach reach;
  if (round()) {
    reach.box = {origin - Vec3(size, size, size), origin + Vec3(size, size, size)};
    reach.power = power / 4;  // the area of its disk
    return reach;
  }
  for (const Vec3& corner : {origin, origin + edgeA, origin + edgeB}) reach.box.extend(corner);
  if (kind != Kind::triangle) reach.box.extend(origin + edgeA + edgeB);
  if (!(size > 0)) return reach;  // it is dark
  reach.axis = normalize(cross(edgeA, edgeB));
  reach.around = 0;
  reach.beyond = kPi / 2;
  reach.twoSided = true;
  reach.power = power;
  return reach;
}

std::pair<std::size_t, Real> Lamps::chosenPart(const Vec3& from, Real which) const {
  if (tree_.empty()) {
    const std::size_t part = parts_.size() == 1 ? 0 : partOf(which);
    return {part, parts_[part].share};
  }
  const auto chosen = tree_.choose(from, nullptr, which);
  return chosen ? std::pair<std::size_t, Real>{chosen->light, chosen->probability}
                : std::pair<std::size_t, Real>{0, 0};
}

Vec3 Lamps::towardSky(const Vec3& from, Real which, const Vec2& u) const {
  const Real tableShare = this->tableShare();
  if (which < tableShare) return sky_.choose(u);
  which = (which - tableShare) / (1 - tableShare) * static_cast<Real>(portals_.size());
  const auto number = std::min(static_cast<std::size_t>(which), portals_.size() - 1);
  return normalize(trace::placeOn(portals_[number], u) - from);
}

/// With which towardSky() gives the ray's direction.
Real Lamps::skyDensity(const Ray& ray) const {
  const Real tableShare = this->tableShare();
  Real density = tableShare > 0 ? tableShare * sky_.density(ray.direction) : 0;
  for (const LightGeometry& portal : portals_)
    if (const auto t = meetsPanel(portal, ray)) {
      const Real area = std::abs(dot(cross(portal.u, portal.v), ray.direction));  // as seen from there
      density += (1 - tableShare) * *t * *t / (area * static_cast<Real>(portals_.size()));
    }
  return density;
}

std::size_t Lamps::partOf(Real which) const {
  const auto found = std::upper_bound(sums_.begin(), sums_.end(), which);
  return std::min<std::size_t>(static_cast<std::size_t>(found - sums_.begin()), parts_.size() - 1);
}

Vec3 Lamps::placeOn(const Part& part, const Vec2& u) {
  Vec2 v = u;
  if (part.kind == Part::Kind::triangle) v = {1 - std::sqrt(u.x), u.y * std::sqrt(u.x)};
  return part.origin + part.edgeA * v.x + part.edgeB * v.y;
}

Real Lamps::density(const Part& part, const Vec3& from, const Vec3& at) const {
  if (part.kind != Part::Kind::body) return part.density(from, at);
  return bodies_[part.body].density(from, normalize(at - from));
}

Real Lamps::Part::density(const Vec3& from, const Vec3& at) const {
  if (kind == Kind::sphere) {
    const Real away2 = dot(origin - from, origin - from), radius2 = size * size;
    if (!(away2 > radius2)) return 0;
    const Real sine2 = radius2 / away2;  // 1 - cosine, without the loss of digits
    return 1 / (2 * kPi * sine2 / (1 + std::sqrt(1 - sine2)));
  }
  const auto rectangle = seen(from);
  if (rectangle) return 1 / rectangle->solidAngle();
  const Vec3 to = at - from;
  const Real away2 = dot(to, to);
  return densityByArea(to, away2, std::sqrt(away2));
}

std::optional<SphericalRectangle> Lamps::Part::seenLarge(const Vec3& from) const {
  constexpr Real kLeast = 1e-8;  // steradians; below it digits are lost
  std::optional<SphericalRectangle> rectangle(std::in_place, from, origin, edgeA, edgeB);
  if (!(rectangle->solidAngle() > kLeast)) rectangle.reset();
  return rectangle;
}

std::optional<Lamps::Place> Lamps::choose(const Vec3& from, Real which, const Vec2& u) const {
  const Real skyShare = this->skyShare();
  if (which < skyShare) {
    const Vec3 toLight = towardSky(from, which / skyShare, u);
    const Real density = this->density(Ray{from, toLight});
    if (!(density > 0 && density < kInfinity)) return {};
    return Place{kNone, 0, toLight, density, kInfinity};
  }
  which = (which - skyShare) / (1 - skyShare);
  const auto [number, share] = chosenPart(from, which);
  if (!(share > 0)) return {};
  const Part& part = parts_[number];
  const std::uint64_t inObject = number - first_[part.object];
  Vec3 toLight;
  Real distance, density;
  if (part.kind == Part::Kind::sphere) {
    const Vec3 to = part.origin - from;
    const Real away2 = dot(to, to), radius2 = part.size * part.size;
    if (!(away2 > radius2)) return {};  // paths from inside hit it by bounces alone
    toLight = toCone(u, to / std::sqrt(away2), std::sqrt(1 - radius2 / away2));
    const Real along = dot(to, toLight);
    distance = along - std::sqrt(std::max(0.0, radius2 - (away2 - along * along)));
    density = part.density(from, part.origin);
  } else if (part.kind == Part::Kind::body) {
    const BodyLamp::Aim aim = bodies_[part.body].aim(from, u);
    toLight = aim.direction;
    distance = aim.farthest;
    density = aim.density;
  } else {
    const auto rectangle = part.seen(from);
    const Vec3 at = rectangle ? rectangle->place(u) : placeOn(part, u);
    const Vec3 to = at - from;
    const Real away2 = dot(to, to);
    distance = std::sqrt(away2);
    toLight = to / distance;
    density = rectangle ? 1 / rectangle->solidAngle() : part.densityByArea(to, away2, distance);
  }
  density *= (1 - skyShare) * share;
  if (!(density > 0)) return {};
  return Place{part.object, inObject, toLight, density, distance};
}

std::optional<Lamps::Start> Lamps::start(const World& world, Real which, const Vec2& u,
                                         const Vec2& line) const {
  if (parts_.empty()) return {};
  const std::size_t number = partOf(which);
  const Part& part = parts_[number];
  if (part.kind == Part::Kind::body) {
    const BodyLamp& body = bodies_[part.body];
    const Real before =
        number > 0 ? sums_[number - 1] : 0;  // what is left of the number chooses the crossing
    const Real rest = std::clamp((which - before) / part.share, 0.0, kBelowOne);
    const auto place = body.place(world, u, line, rest);
    if (!place) return {};
    return Start{part.object, place->point, place->normal, false, part.size, part.share * body.perArea()};
  }
  if (part.kind == Part::Kind::sphere) {
    const Vec3 normal = sphericalDirection(1 - 2 * u.x, 2 * kPi * u.y);
    const Real area = kSphere * part.size * part.size;
    return Start{part.object, part.origin + normal * part.size, normal, false, part.size, part.share / area};
  }
  if (!(part.size > 0)) return {};
  const Vec3 normal = normalize(cross(part.edgeA, part.edgeB));
  return Start{part.object, placeOn(part, u), normal, true, std::sqrt(part.size), part.share / part.size};
}

std::optional<Hit> Lamps::placeOf(Tracer& tracer, const Start& start, const Vec3& normal, RayKind kind) {
  const Ray down{start.point + normal * start.size, -normal};
  const auto found = tracer.lookAt(down, kind, start.object, start.size);
  return found ? std::optional<Hit>(std::in_place, tracer.world(), down, *found) : std::nullopt;
}

Lamps::SkyStart Lamps::startOfSky(const Vec2& u) const {
  if (sky_.empty()) return {sphericalDirection(1 - 2 * u.x, 2 * kPi * u.y), 1 / kSphere};
  const Vec3 toLight = sky_.choose(u);
  return {toLight, sky_.density(toLight)};
}

Real Lamps::density(const Vec3& from, const Hit& hit) const {
  if (!isLamp(hit.object)) return 0;
  const Part& part = partOf(hit.object, hit.part);
  const auto number = static_cast<std::size_t>(&part - parts_.data());
  return (1 - skyShare()) * shareOf(number, from) * density(part, from, hit.surface.point);
}

Real Lamps::perArea(const Part& part) const {
  if (part.kind == Part::Kind::body) return part.share * bodies_[part.body].perArea();
  if (part.kind == Part::Kind::sphere) return part.share / (kSphere * part.size * part.size);
  return part.size > 0 ? part.share / (2 * part.size) : 0;
}

Real Lamps::startDensity(std::uint32_t object, std::uint64_t part) const {
  return isLamp(object) ? perArea(partOf(object, part)) : 0;
}

Real Lamps::startDensity(const Hit& hit) const {
  if (!isLamp(hit.object)) return 0;
  const Part& part = partOf(hit.object, hit.part);
  const bool closed = part.kind == Part::Kind::body ? bodies_[part.body].closed() : part.round();
  return closed && hit.leaving ? 0 : perArea(part);  // nothing starts inward
}

Real Lamps::skyStartDensity(const Vec3& toLight) const {
  return sky_.empty() ? 1 / kSphere : sky_.density(toLight);
}

bool Lamps::isPlain(const Tracer& tracer, const Place& place, const Interfaces& inside) const {
  const World& world = tracer.world();
  return clear_ && place.object != kNone && world.isUniform(place.object) && !inside.nested() &&
         !(tracer.settings().fog > 0) && !tracer.records();
}

Color Lamps::look(Tracer& tracer, const Ray& ray, Place& place, const Interfaces& from, Real chance) const {
  if (isPlain(tracer, place, from)) {
    constexpr Real kBehind = 1 + 0x1p-10;  // relative to the distance: what lies farther away is not asked
    ++tracer.statistics().depths;
    const auto found = tracer.nearest(ray, RayKind::lamp, place.distance * kBehind);
    if (!found || !met(place, *found)) return Color(0);
    if (isBody(place)) place.distance = found->t;
    return tracer.world().termsOf(place.object).emissive * from.passed(found->t);
  }
  Interfaces inside = from;
  const std::optional<Hit> hit = tracer.cast(ray, RayKind::lamp, inside, chance, place.object);
  const Color& passes = tracer.passedPanes();
  Gather light(tracer, 1);
  if (!hit) {
    if (place.object == kNone) {
      light.add(Term::Kind::background, tracer.world().outside().view(ray, RayKind::lamp).color);
      coverWithFog(light, tracer, ray, kInfinity, inside);
    }
    return light.radiance(passes);
  }
  const PlaceBsdf bsdf = tracer.world().shade(*hit);
  light.note(*bsdf);
  if (tracer.records())
    light.note(Indices(inside.at(hit->leaving, tracer.filling(*hit, whitted(*bsdf)), hit->solid),
                       inside.wavelength, inside.nested()));
  if (met(place, *hit)) {
    if (isBody(place)) place.distance = hit->t;
    light.add(Term::Kind::emissive, whitted(*bsdf).emissive);
    coverWithFog(light, tracer, ray, hit->t, inside);
  } else {
    light.stop(Blocked{hit->object, hit->part, hit->t, sharesOf(hit->materials)});
  }
  return light.radiance(inside.passed(hit->t) * passes);
}

Color Lamps::sent(Tracer& tracer, const Ray& ray, Place& place) const {
  const World& world = tracer.world();
  if (place.object == kNone) return world.outside().view(ray, RayKind::lamp).color;
  if (isBody(place)) {
    const BodyLamp& body = bodies_[parts_[first_[place.object]].body];
    const auto met = body.meets(world, ray, tracer.statistics());
    if (!met) return Color(0);
    place.distance = met->t;
    const Real there = world.hasHoles() ? world.opacityAt(ray, *met) : 1;
    return whitted(*world.bsdfAt(ray, *met)).emissive * there;
  }
  const Ray last{ray.at(place.distance * kBefore), ray.direction};
  const auto found = tracer.look(last, RayKind::lamp);
  if (!found || found->object != place.object) return Color(0);
  return whitted(*world.bsdfAt(last, *found)).emissive;
}

}  // namespace trace
