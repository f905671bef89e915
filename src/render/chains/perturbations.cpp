// Perturbations: the lens, caustics, and chains of mirrors and glass.
#include <algorithm>

#include "math/elementary.h"
#include "render/chains/moves.h"

namespace trace::veach {

/// A way, as a part of the farthest: as often between 1/2 and 1 as between 1/4 and 1/2, down to 1/1000 (Veach
/// 1997, section 11.4.3.1).
Real Moves::shortWay() {
  constexpr Real kNearest = 1e-3;
  return farthest_ * math::pow(kNearest, numbers_.next());
}

/// Evenly in all directions, so that the way back is as likely.
Vec2 Moves::moved(const Vec2& film) {
  const Real way = shortWay();
  const math::SinCos angle = math::sincos(2 * kPi * numbers_.next());
  return {film.x + way * angle.cos * stage_.side.x, film.y + way * angle.sin * stage_.side.y};
}

Vec3 Moves::moved(const Vec3& direction) {
  const math::SinCos off = math::sincos(std::min(shortWay(), kPi));
  const math::SinCos around = math::sincos(2 * kPi * numbers_.next());
  const Vec3 x = perpendicularTo(direction), y = cross(direction, x);
  return normalize(direction * off.cos + (x * around.cos + y * around.sin) * off.sin);
}

namespace {

bool isSpread(const Path& path, std::size_t i) { return path.nodes[i].leaves == RayKind::bounce; }

}  // namespace

bool Moves::hasLens(const Path& path) const {
  const std::size_t end = path.last();
  std::size_t joint = 1;
  while (joint < end && !isSpread(path, joint)) ++joint;
  return joint + 1 >= end || isSpread(path, joint + 1);
}

/// The place of the film is moved, and so are the directions of all places before `joint` from where paths do
/// not continue by mirrors and glass; from there on the rest is the same. T is the product of the densities
/// of these directions, over G of the edge that joins the path again; that of the film's place is the same
/// both ways, and the camera's density stands in f, too.
Offer Moves::fromFilm(const Path& from, std::size_t joint) {
  Offer offer;
  Path& path = offer.path;
  path.moment = from.moment;
  if (!paths_.begin(path, moved(from.film), from.lens)) return offer;
  const std::size_t end = from.last();
  const auto build = [&] {
    for (std::size_t i = 0; i < joint; ++i) {
      const Vec3 direction = isSpread(from, i) ? moved(from.toLight(i)) : Vec3{};
      if (!paths_.follow(path, from.nodes[i].leaves, direction) ||
          (path.end != Path::End::open && i + 1 < end))
        return false;
    }
    if (joint < end)
      return path.nodes.back().vertex->place.joins() &&
             paths_.attach(path, RayKind::bounce, from, joint + 1, from.nodes[joint + 1].leaves);
    return path.end == from.end ||
           (from.end == Path::End::lamp && path.nodes.back().vertex && paths_.endAtLamp(path));
  };
  if (!build() || !paths_.weigh(path, 0, joint + 1)) {
    path.brightness = 0;
    return offer;
  }
  const auto perDensity = [&](const Path& p) {
    Real result = p.brightness * (joint < end ? p.joins(joint) : 1) / p.nodes[0].factor.r;
    for (std::size_t i = 1; i < joint; ++i)
      if (isSpread(p, i)) result *= p.vertex(i).place.cosine(p.toLight(i));
    return result;
  };
  if (const Real now = perDensity(from); now > 0) offer.ratio = perDensity(path) / now;
  return offer;
}

/// Joined is the first place from where the path does not continue by mirrors and glass.
Offer Moves::lens(const Path& from) {
  std::size_t joint = 1;
  while (joint < from.last() && !isSpread(from, joint)) ++joint;
  return fromFilm(from, joint);
}

bool Moves::hasCaustic(const Path& path) const {
  const std::size_t end = path.last();
  if (end < 3 || !stage_.camera.known() || !isSpread(path, 1) || isSpread(path, 2)) return false;
  std::size_t from = 2;
  while (from < end && !isSpread(path, from)) ++from;
  return from < end || path.end == Path::End::lamp;
}

/// T is the density of the direction, handed on by the mirrors and glass, over G of the edge to the lens.
Offer Moves::caustic(Path& from) {
  Offer offer;
  Path& path = offer.path;
  path.moment = from.moment;
  const std::size_t end = from.last();
  std::size_t start = 2;  // where the direction is changed
  while (start < end && !isSpread(from, start)) ++start;
  const auto build = [&] {
    const Vertex& at = from.vertex(start);
    const Vertex* walks = start < end ? paths_.turned(from, start) : &at;
    if (!walks) return false;
    const Vec3 toEye = moved(-at.ray.direction);
    const Vec3& flat = at.hit.surface.normal;
    if (start == end && !(dot(toEye, flat) * dot(at.ray.direction, flat) < 0)) return false;
    if (!paths_.begin(path, from.film, from.lens)) return false;
    std::unique_ptr<Vertex> reached;
    std::vector<Target> targets;
    for (std::size_t i = start; i > 1; --i) {
      Ray ray;
      Interfaces inside;
      if (i == start) {
        ray = start < end ? walks->at.leaveToLight(toEye) : walks->hit.leave(toEye);
        inside = start < end ? walks->place.side(toEye) : walks->inside;
      } else {
        auto only = reached->onward.only(from.nodes[i].leaves, true);
        if (!only) return false;
        ray = reached->hit.leave(only->direction);
        inside = only->in(reached->at.inside);
      }
      const auto hit = paths_.tracer.cast(ray, RayKind::light, inside);
      if (!hit) return false;
      reached = std::make_unique<Vertex>(paths_.tracer, ray, std::move(inside), *hit);
      targets.push_back(targetOf(*hit));
    }
    if (!reached->place.joins() || !paths_.follow(path, RayKind::camera, targets.back())) return false;
    for (std::size_t i = 1; i + 1 < start; ++i)
      if (!paths_.follow(path, from.nodes[i].leaves, targets[targets.size() - 1 - i])) return false;
    return paths_.attach(path, from.nodes[start - 1].leaves, from, start, RayKind::bounce);
  };
  if (!build() || !paths_.weigh(path, 0, start)) {
    path.brightness = 0;
    return offer;
  }
  const auto perDensity = [&](const Path& p) {
    Real result = p.brightness * p.joins(0) * p.vertex(start).place.cosine(p.vertex(start).ray.direction);
    for (std::size_t i = 2; i < start; ++i) result *= p.nodes[i].kappa;
    return result;
  };
  if (const Real now = perDensity(from); now > 0) offer.ratio = perDensity(path) / now;
  return offer;
}

bool Moves::hasMultiChain(const Path& path) const {
  const std::size_t end = path.last();
  std::size_t first = 1;
  while (first < end && !isSpread(path, first)) ++first;
  return first + 1 < end && !isSpread(path, first + 1);
}

/// Joined is the first place from where the path continues by none, to a place from where it does not either.
Offer Moves::multiChain(const Path& from) {
  const std::size_t end = from.last();
  const auto leads = [&](std::size_t i) { return i + 1 < end && !isSpread(from, i + 1); };  // to a mirror
  std::size_t joint = 1;
  while (joint < end && (!isSpread(from, joint) || leads(joint))) ++joint;
  return fromFilm(from, joint);
}

}  // namespace trace::veach
