#include "render/chains/path.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "image/film/pixel_filter.h"
#include "image/srgb.h"

namespace trace::veach {
namespace {

Real cosineAt(const Vertex& vertex, const Vec3& direction) { return vertex.place.cosine(direction); }

/// Light's part of a density, at a mirror or glass, over that of what the camera sees: radiance over the
/// square of the index is kept, and a normal between those of a mesh's points turns rays, but no area (Veach
/// 1997, sections 5.2 and 5.3).
Real kappaOf(const Vertex& vertex, const Onward::Ray& next) {
  const Vec3 toEye = -vertex.ray.direction;
  const Vec3 &flat = vertex.hit.surface.normal, &shaded = vertex.at.normal;
  const Real turned = dot(toEye, shaded) * dot(next.direction, flat);
  const Real narrowed = turned != 0 ? std::abs(dot(toEye, flat) * dot(next.direction, shaded) / turned) : 0;
  return narrowed / (next.ratio * next.ratio);
}

}  // namespace

Stage::Stage(const World& world, const Settings& settings, const Tile& area, const Size& size)
    : lamps(world, settings.threads),
      camera(world.camera()),
      lights(world.lights().size()),
      mostPlaces(settings.depth + 3) {
  // A filter sees what is beside the picture.
  const Real beside = std::max(0.0, PixelFilter(settings.filter, settings.filterRadius).radius() - 0.5);
  const Real width = size.width, height = size.height;
  low = {(area.x0 - beside) / width, 1 - (area.y1 + beside) / height};
  high = {(area.x1 + beside) / width, 1 - (area.y0 - beside) / height};
  const Real pixels = std::sqrt(Real{1} * (area.x1 - area.x0) * (area.y1 - area.y0));
  side = {pixels / width, pixels / height};
}

bool Paths::begin(Path& path, const Vec2& film, const Vec2& lens) const {
  if (!stage.onFilm(film)) return false;
  path.film = film;
  path.lens = lens;
  path.ray = tracer.world().camera().ray(film, lens);
  path.nodes.assign(1, Node{});
  path.end = Path::End::open;
  return true;
}

bool Paths::aim(Path& path, const Vec3& point, const Vec2& lens) const {
  if (!stage.camera.known()) return false;
  const auto seen = stage.camera.sees(point, lens);
  return seen && begin(path, seen->place, lens);
}

bool Paths::follow(Path& path, RayKind kind, const Vec3& direction) const {
  if (std::ssize(path.nodes) >= stage.mostPlaces) return false;
  const World& world = tracer.world();
  Node& from = path.nodes.back();
  from.leaves = kind;
  Node next;
  Ray ray;
  Interfaces inside;
  if (!from.vertex) {
    ray = path.ray;
    inside = tracer.interfacesAt(ray.origin);
  } else if (kind == RayKind::bounce) {
    ray = from.vertex->at.leaveToLight(direction);
    inside = from.vertex->place.side(direction);
    next.asked = true;
  } else {
    auto only = from.vertex->onward.only(kind);
    if (!only) return false;
    ray = from.vertex->hit.leave(only->direction);
    inside = only->in(from.vertex->at.inside);
    next.asked = kind == RayKind::refraction && from.asked && tracer.lightPasses(from.vertex->at.bsdf());
  }
  const auto hit = tracer.cast(ray, kind, inside);
  const auto end = [&](Path::End what, const Color& shines) {
    path.end = what;
    path.shines = shines;
    path.towardEnd = ray.direction;
  };
  if (const auto lamp = next.asked ? std::nullopt : world.lampAlong(ray, hit ? hit->t : kInfinity)) {
    end(Path::End::seen, lamp->seen.color * inside.passed(lamp->seen.t));
  } else if (hit) {
    next.vertex = std::make_shared<const Vertex>(tracer, ray, std::move(inside), *hit);
  } else {
    if (!world.outside().isSeenBy(kind)) return false;
    end(Path::End::sky, world.outside().view(ray, kind).color);
  }
  path.nodes.push_back(std::move(next));
  return true;
}

bool Paths::follow(Path& path, RayKind kind, const Target& target) const {
  Vec3 direction;
  if (kind == RayKind::camera && !aim(path, target.point, Vec2(path.lens))) return false;
  if (kind == RayKind::bounce) {
    direction = target.point - path.nodes.back().vertex->place.point();
    const Real distance = length(direction);
    if (!(distance > 0)) return false;
    direction = direction / distance;
  }
  if (!follow(path, kind, direction) || path.end != Path::End::open) return false;
  const Hit& hit = path.nodes.back().vertex->hit;
  constexpr Real kRounding = 1e-6;
  return hit.object == target.object && hit.part == target.part &&
         length(hit.surface.point - target.point) <=
             kRounding * (hit.t + maxComponent(abs(target.point)) * 1e-3);
}

bool Paths::endAtLamp(Path& path) const {
  path.end = Path::End::lamp;
  path.shines = path.nodes.back().vertex->at.material.emissive;
  return !isBlack(path.shines);
}

bool Paths::endAtLight(Path& path, std::size_t light, const Vec2& onLight) const {
  const Vertex& from = *path.nodes.back().vertex;
  if (!from.place.joins() || !tracer.world().lights(light, from.hit.object)) return false;
  path.nodes.back().leaves = RayKind::bounce;
  path.nodes.emplace_back();
  path.end = Path::End::light;
  path.light = light;
  path.onLight = onLight;
  path.shines = Color(1);
  return std::ssize(path.nodes) <= stage.mostPlaces;
}

bool Paths::attach(Path& path, RayKind kind, const Path& other, std::size_t first, RayKind leaves) const {
  if (other.nodes[first].vertex) {
    if (!follow(path, kind, targetOf(other.vertex(first).hit))) return false;
    if (first == other.last()) return endAtLamp(path);
    kind = leaves;
    path.nodes.back().leaves = kind;
    if (other.nodes[++first].vertex) {
      // From here on all is the same, but lights may be seen that were not.
      path.nodes.insert(path.nodes.end(), other.nodes.begin() + static_cast<std::ptrdiff_t>(first),
                        other.nodes.end());
      path.end = other.end;
      path.towardEnd = other.towardEnd;
      path.shines = other.shines;
      path.light = other.light;
      path.onLight = other.onLight;
      return std::ssize(path.nodes) <= stage.mostPlaces;
    }
  }
  if (other.end == Path::End::light)
    return kind == RayKind::bounce && endAtLight(path, other.light, other.onLight);
  return follow(path, kind, other.towardEnd) && path.end == other.end;
}

// --- what a path brings -----------------------------------------------------------------------------------

/// The scattered light that arrives from the sampled light.
Color Paths::fromLight(Path& path) const {
  const World& world = tracer.world();
  const Vertex& from = path.vertex(path.last() - 1);
  const auto arriving = world.illuminate(path.light, from.place.point(), path.onLight);
  if (!arriving || !(dot(arriving->toLight, arriving->toLight) > 0)) return Color(0);
  path.towardEnd = arriving->toLight;
  const Color all = from.place.scattered(*arriving);
  if (isBlack(all)) return all;
  const Ray ray = from.place.leave(arriving->toLight);
  const Color passed = tracer.visible(from.hit, ray, arriving->distance, from.inside);
  const Real shadow = from.at.material.shadow;
  return all * (passed * shadow + Color(1 - shadow));
}

bool Paths::weighPlace(Path& path, std::size_t i) const {
  Node& node = path.nodes[i];
  node.light.reset();
  node.turned.reset();
  node.edge = 0;
  node.kappa = 1;
  const Vertex* next = path.nodes[i + 1].vertex.get();
  if (!node.vertex) {
    const bool known = stage.camera.known();
    const Real density = known ? stage.camera.density(path.ray) : 1;
    node.factor = Color(density);
    node.eye = density / stage.filmArea();
    if (known && next)
      node.edge =
          cosineAt(*next, path.ray.direction) / (stage.camera.parallel() ? 1 : next->hit.t * next->hit.t);
    return density > 0;
  }
  const Vertex& at = *node.vertex;
  if (node.leaves != RayKind::bounce) {
    const auto only = at.onward.only(node.leaves);
    if (!only) return false;
    node.factor = only->weight;
    node.eye = at.onward.chance(node.leaves);
    node.kappa = kappaOf(at, *only);
    return node.kappa > 0 && !isBlack(node.factor);
  }
  if (!at.place.joins()) return false;
  if (path.end == Path::End::light && i + 1 == path.last()) {
    node.factor = fromLight(path);
    node.eye = 0;
    node.edge = 1;
    return !isBlack(node.factor);
  }
  const Vec3 &toLight = path.toLight(i), toEye = at.place.from();
  const Real cosine = cosineAt(at, toLight);
  if (!(cosine > 0)) return false;
  node.factor = at.place.scattered(toEye, toLight) * (1 / cosine);
  node.eye = at.onward.chance(RayKind::bounce) * at.place.density(toEye, toLight) / cosine;
  if (next)
    node.edge = cosine * cosineAt(*next, toLight) / (next->hit.t * next->hit.t);
  else if (path.end == Path::End::sky && i + 1 == path.last())
    node.edge = cosine;
  return !isBlack(node.factor);
}

/// Whether a path of --integrator path would end so.
bool Paths::allowed(const Path& path) const {
  const std::size_t end = path.last();
  if (std::ssize(path.nodes) == stage.mostPlaces && path.nodes[end - 1].leaves != RayKind::bounce)
    return false;
  // Whether the rays in the part of the path that is kept see lights.
  for (std::size_t i = 1; i + (path.end == Path::End::light) < end; ++i) {
    const Node& from = path.nodes[i];
    const bool asked = from.leaves == RayKind::bounce || (from.leaves == RayKind::refraction && from.asked &&
                                                          tracer.lightPasses(from.vertex->at.bsdf()));
    if (path.nodes[i + 1].asked != asked) return false;
  }
  return true;
}

bool Paths::weigh(Path& path, std::size_t first, std::size_t last) const {
  if (path.end == Path::End::open) return false;
  for (std::size_t i = first; i < path.last() && i <= last; ++i)
    if (!weighPlace(path, i)) return false;
  if (!allowed(path)) return false;
  Color f = path.shines;
  for (std::size_t i = 0; i < path.last(); ++i) f *= path.nodes[i].factor;
  for (const Node& node : path.nodes)
    if (node.vertex) f *= node.vertex->inside.passed(node.vertex->hit.t);
  path.f = f;
  path.brightness = std::abs(luminanceOf(f));
  return isFinite(f) && path.brightness > 0;
}

// --- from the other end -----------------------------------------------------------------------------------

const Vertex* Paths::turned(Path& path, std::size_t i) const {
  Node& node = path.nodes[i];
  if (node.turned) return node.turned.get();
  const Vertex& at = *node.vertex;
  const Vec3& toLight = path.toLight(i);
  const Vertex* next = path.nodes[i + 1].vertex.get();
  const Real distance = next ? next->hit.t : length(tracer.world().bounds().size());
  const Ray ray{at.point() + toLight * distance, -toLight};
  const Vec3& flat = at.hit.surface.normal;
  if (dot(at.ray.direction, flat) * dot(toLight, flat) < 0) {  // both on one side
    Hit hit = at.hit;
    hit.t = distance;
    node.turned = std::make_shared<const Vertex>(tracer, ray, at.inside, hit);
    return node.turned.get();
  }
  const auto found = tracer.lookAt(ray, RayKind::light, at.hit.object, distance);
  if (!found) return nullptr;
  const Interfaces inside = next                             ? next->inside
                            : node.leaves == RayKind::bounce ? at.place.side(toLight)
                                                             : at.at.behind();
  node.turned = std::make_shared<const Vertex>(tracer, ray, inside, Hit(tracer.world(), ray, *found));
  return node.turned.get();
}

Real Paths::lightDensity(Path& path, std::size_t i) const {
  Node& node = path.nodes[i];
  if (node.light) return *node.light;
  const auto known = [&](Real density) { return node.light.emplace(density); };
  if (i == path.last()) return known(path.end == Path::End::lamp ? 1 / kPi : 0);
  const Vertex* back = turned(path, i);
  if (!back) return known(0);
  if (node.leaves != RayKind::bounce) return known(back->onward.chance(node.leaves) / node.kappa);
  const Vec3 toEye = node.vertex->place.from();
  const Real cosine = cosineAt(*back, toEye);
  if (!(cosine > 0)) return known(0);
  return known(back->onward.chance(RayKind::bounce) * back->place.density(path.toLight(i), toEye) / cosine);
}

Real Paths::askDensity(const Path& path) const {
  const std::size_t end = path.last();
  if (end < 2 || path.end == Path::End::seen || path.nodes[end - 1].leaves != RayKind::bounce) return 0;
  const Vertex& from = path.vertex(end - 1);
  if (path.end == Path::End::light) return (1 - stage.lampShare()) / static_cast<Real>(stage.lights);
  const Vec3& toLight = path.toLight(end - 1);
  const Real density = path.end == Path::End::lamp
                           ? stage.lamps.density(from.place.point(), path.vertex(end).hit)
                           : stage.lamps.density(Ray{from.place.point(), toLight});
  return density > 0 ? stage.lampShare() * density / cosineAt(from, toLight) : 0;
}

Real Paths::startDensity(const Path& path) const {
  return path.end == Path::End::lamp ? stage.lamps.startDensity(path.vertex(path.last()).hit) : 0;
}

}  // namespace trace::veach
