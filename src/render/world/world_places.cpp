// Places as textures see them: in the space of their object, with the part of the surface that they stand
// for.
#include <algorithm>
#include <cmath>

#include "geometry/mesh/mesh.h"
#include "math/perpendicular.h"
#include "render/world/world.h"

namespace trace {
namespace {

/// The gradients of the second and third barycentric coordinates; 0 for a triangle without area.
struct Barycentric {
  Vec3 corner, second, third;

  explicit Barycentric(const Corners& v) : corner(v.a) {
    const Vec3 ab = v.b - v.a, ac = v.c - v.a, normal = cross(ab, ac);
    const Real square = dot(normal, normal);
    if (square > 0) {
      second = cross(ac, normal) / square;
      third = cross(normal, ab) / square;
    }
  }
  TriangleHit at(const Vec3& p) const {
    TriangleHit hit;
    hit.b[1] = dot(second, p - corner);
    hit.b[2] = dot(third, p - corner);
    hit.b[0] = 1 - hit.b[1] - hit.b[2];
    return hit;
  }
};

/// Those of texture coordinates in a triangle.
struct Gradients {
  Vec3 u, v;
};
Gradients gradientsOf(const MeshData& mesh, std::uint32_t index, const std::vector<Vec2>& uvs) {
  const Barycentric b(corners(mesh, index));
  if (uvs.empty()) return {b.second, b.third};
  const Triangle& t = mesh.triangles[index];
  const Vec2 &p = uvs[t[0]], &q = uvs[t[1]], &r = uvs[t[2]];
  return {b.second * (q.x - p.x) + b.third * (r.x - p.x), b.second * (q.y - p.y) + b.third * (r.y - p.y)};
}

/// From one texture coordinate to another nearby. The way across the line where it starts again is short.
Real shortWay(Real from, Real to) {
  constexpr Real kTorn = 0.25;  // so much in a step as short as ours is no slope
  const Real way = to - from, shortest = way - std::round(way);
  return std::abs(shortest) < kTorn ? shortest : 0;
}

}  // namespace

/// By differences over steps so short that their square is lost in rounding: shapes put a place beside their
/// surface back on it, so that one way serves all, and solids of solids too.
SurfaceSlopes World::slopes(std::uint32_t object, std::uint64_t part, const SurfacePoint& here) const {
  const Instance& instance = instanceOf(object);
  const Affine out = worldFromObject(object), in = objectFromWorld(object);
  const Box3 bounds = boundsOf(object);
  const Real size = bounds.unbounded() || bounds.empty()
                        ? maxComponent(abs(out.row[0]) + abs(out.row[1]) + abs(out.row[2]))
                        : maxComponent(bounds.size());
  const Real step = size * 0x1p-20 + maxComponent(abs(here.point)) * 0x1p-40;
  const auto beside = [&](const Vec3& p) {
    constexpr Real kAbove = 0x1p10;  // in steps: where the ray to the place starts
    Found found{kAbove * step, object, part, {}};
    if (instance.mesh)
      found.triangle =
          Barycentric(corners(instance.mesh->data(), static_cast<std::uint32_t>(part))).at(in * p);
    return surface({p + here.normal * found.t, -here.normal}, found);
  };

  SurfaceSlopes slopes;
  slopes.tangent[0] = perpendicularTo(here.normal);
  slopes.tangent[1] = cross(here.normal, slopes.tangent[0]);
  const Vec2 uv = here.uv;
  for (int i = 0; i < 2; ++i) {
    const Vec3& along = slopes.tangent[i];
    const SurfacePoint there = beside(here.point + along * step);
    const Vec2 other = there.uv;
    slopes.u += along * (shortWay(uv.x, other.x) / step);
    slopes.v += along * (shortWay(uv.y, other.y) / step);
    slopes.normal[i] = (there.shading - here.shading) / step;
  }
  return slopes;
}

TexturePlace World::place(std::uint32_t object, std::uint64_t part, const SurfacePoint& surface,
                          const Differentials* arrived) const {
  TexturePlace place = placeInObject(object, part, surface, arrived);
  if (!instanceOf(object).patternsInWorld) return place;
  place.point = surface.point;
  if (arrived) {
    place.pointX = arrived->originX;
    place.pointY = arrived->originY;
  }
  return place;
}

TexturePlace World::placeInObject(std::uint32_t object, std::uint64_t part, const SurfacePoint& surface,
                                  const Differentials* arrived) const {
  const Instance& instance = instanceOf(object);
  const Affine in = objectFromWorld(object);
  TexturePlace place;
  place.point = in * surface.point;
  const bool mapped = instance.mapped;
  if (mapped) place.uv = place.secondUv = surface.uv;
  const MeshTree* tree = instance.mesh.get();
  const MeshData* second = tree && !tree->data().secondUvs.empty() ? &tree->data() : nullptr;
  if (second) {
    const Triangle& t = second->triangles[part];
    const TriangleHit at = Barycentric(corners(*second, static_cast<std::uint32_t>(part))).at(place.point);
    place.secondUv = {};
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec2& uv = second->secondUvs[t[i]];
      place.secondUv.x += at.b[i] * uv.x;
      place.secondUv.y += at.b[i] * uv.y;
    }
  }
  if (!arrived) return place;
  place.pointX = linear(in, arrived->originX);
  place.pointY = linear(in, arrived->originY);
  if (!footprintsInUv_ || !mapped) return place;
  if (tree) {  // with gradients in the space of the object
    const auto number = static_cast<std::uint32_t>(part);
    const Gradients g = gradientsOf(tree->data(), number, tree->data().uvs);
    place.uvX = {dot(g.u, place.pointX), dot(g.v, place.pointX)};
    place.uvY = {dot(g.u, place.pointY), dot(g.v, place.pointY)};
    if (second) {
      const Gradients other = gradientsOf(*second, number, second->secondUvs);
      place.secondUvX = {dot(other.u, place.pointX), dot(other.v, place.pointX)};
      place.secondUvY = {dot(other.u, place.pointY), dot(other.v, place.pointY)};
    } else {
      place.secondUvX = place.uvX;
      place.secondUvY = place.uvY;
    }
  } else {
    const SurfaceSlopes along = slopes(object, part, surface);
    place.uvX = {dot(along.u, arrived->originX), dot(along.v, arrived->originX)};
    place.uvY = {dot(along.u, arrived->originY), dot(along.v, arrived->originY)};
    place.secondUvX = place.uvX;
    place.secondUvY = place.uvY;
  }
  return place;
}

SurfaceSlopes World::secondSlopes(const Hit& hit) const {
  SurfaceSlopes slopes = this->slopes(hit);
  const Instance& instance = instanceOf(hit.object);
  if (!instance.mesh || instance.mesh->data().secondUvs.empty()) return slopes;
  const MeshData& mesh = instance.mesh->data();
  const Gradients g = gradientsOf(mesh, static_cast<std::uint32_t>(hit.part), mesh.secondUvs);
  const Affine in = objectFromWorld(hit.object);
  slopes.u = transposed(in, g.u);
  slopes.v = transposed(in, g.v);
  return slopes;
}

std::optional<TangentFrame> World::givenFrame(const Hit& hit) const {
  const Instance& instance = instanceOf(hit.object);
  if (!instance.mesh || instance.mesh->data().tangents.empty()) return {};
  const MeshData& mesh = instance.mesh->data();
  const auto number = static_cast<std::uint32_t>(hit.part);
  const Triangle& t = mesh.triangles[number];
  const TriangleHit at =
      Barycentric(corners(mesh, number)).at(objectFromWorld(hit.object) * hit.surface.point);
  Vec3 u;
  Real side = 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const MeshTangent& tangent = mesh.tangents[t[i]];
    u += Vec3(tangent.direction) * at.b[i];
    side += tangent.side * at.b[i];
  }
  const Vec3 v = cross(trace::surface(mesh, number, at).shading, u) * (side < 0 ? -1 : 1);
  const Affine out = worldFromObject(hit.object);
  const TangentFrame frame{linear(out, u), linear(out, v)};
  const bool tells = length(frame.u) > 0 && length(frame.v) > 0 && isFinite(frame.u) && isFinite(frame.v);
  return tells ? std::optional(frame) : std::nullopt;
}

std::optional<SurfacePoint> World::raised(const Hit& hit, bool turned) const {
  const Instance& instance = instanceOf(hit.object);
  if (!instance.mesh || instance.mesh->data().normals.empty()) return {};
  const MeshData& mesh = instance.mesh->data();
  const Corners v = corners(mesh, static_cast<std::uint32_t>(hit.part));
  const Triangle& t = mesh.triangles[hit.part];
  const Vec3 p = objectFromWorld(hit.object) * hit.surface.point;
  const TriangleHit at = Barycentric(v).at(p);
  Vec3 rise;
  for (int i = 0; i < 3; ++i) {
    const Vec3 given(mesh.normals[t[static_cast<std::size_t>(i)]]);
    const Real size = length(given);
    if (!(size > 0) || !std::isfinite(size)) return {};
    const Vec3 normal = given / (turned ? -size : size);
    const Vec3& corner = i == 0 ? v.a : i == 1 ? v.b : v.c;
    rise += normal * (max(at.b[i], 0) * max(dot(corner - p, normal), 0));
  }
  SurfacePoint place = hit.surface;
  const Vec3 move = linear(worldFromObject(hit.object), rise);
  place.point += move;
  place.error += (abs(hit.surface.point) + abs(move)) * gammaError(4);
  const Real outward = dot(move, hit.surface.normal) * (turned ? -1 : 1);
  if (!(outward > dot(abs(hit.surface.normal), place.error))) return {};
  return place;
}

Vec3 World::along(const Hit& hit) const {
  const Vec3 grows = slopes(hit).u;
  if (length(grows) > 0) return grows;
  const Affine placed = worldFromObject(hit.object);
  const Vec3 axis = linear(placed, {0, 0, 1}), around = cross(axis, hit.surface.shading);
  // On a face across the axis that is the normal to the last digits.
  return length(around) > gammaError(64) * length(axis) ? around : linear(placed, {1, 0, 0});
}

}  // namespace trace
