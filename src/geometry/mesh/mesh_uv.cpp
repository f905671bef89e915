#include "geometry/mesh/mesh_uv.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "base/unique.h"
#include "math/elementary.h"

namespace trace {
namespace {

constexpr std::array<std::pair<std::string_view, UvProjection>, 4> kNames{
    {{"spherical", UvProjection::spherical},
     {"cylindrical", UvProjection::cylindrical},
     {"planar", UvProjection::planar},
     {"cubic", UvProjection::cubic}}};

/// A coordinate as a share of the box; the middle of a box without extent.
Real share(Real value, Real low, Real extent) { return extent > 0 ? (value - low) / extent : 0.5; }

/// u of points on the axis is not known: NaN.
Vec2 around(const Vec3& p, const Box3& box, bool sphere) {
  const Vec3 d = p - box.center();
  const Real r = math::hypot(d.x, d.y);
  const Real u = r > 0 ? 0.5 + math::atan2(d.y, d.x) / (2 * kPi) : std::numeric_limits<Real>::quiet_NaN();
  return {u, sphere ? 0.5 + math::atan2(d.z, r) / kPi : share(p.z, box.low.z, box.size().z)};
}

/// Makes the u of a face's corners go together: across the line where u starts again, and on the axis.
void join(std::array<Vec2, 3>& uv) {
  Real least = kInfinity, most = -kInfinity;
  for (const Vec2& c : uv)
    if (!std::isnan(c.x)) {
      least = std::min(least, c.x);
      most = std::max(most, c.x);
    }
  Real sum = 0;
  int known = 0;
  for (Vec2& c : uv) {
    if (std::isnan(c.x)) continue;
    if (most - least > 0.5 && c.x < 0.5) c.x += 1;
    sum += c.x;
    ++known;
  }
  for (Vec2& c : uv)
    if (std::isnan(c.x)) c.x = known > 0 ? sum / known : 0.5;
}

Vec2 onPlane(const Vec3& p, const Box3& box) {
  return {share(p.x, box.low.x, box.size().x), share(p.y, box.low.y, box.size().y)};
}

/// From the side that the normal points to most, the right way round and upright there.
Vec2 onCube(const Vec3& p, const Box3& box, const Vec3& normal) {
  const Vec3 n = abs(normal), d = p - box.low;
  const Real size = maxComponent(box.size());
  const int axis = n.x > n.y ? (n.x > n.z ? 0 : 2) : (n.y > n.z ? 1 : 2);
  const Real sign = normal[axis] < 0 ? -1 : 1;
  const Real across = axis == 0 ? sign * d.y : axis == 1 ? -sign * d.x : sign * d.x;
  return {across / size, (axis == 2 ? d.y : d.z) / size};
}

struct PointKey {
  std::uint32_t point;
  float u, v;
};

}  // namespace

std::optional<UvProjection> uvProjection(std::string_view name) {
  for (const auto& [known, projection] : kNames)
    if (known == name) return projection;
  return {};
}

MeshData withProjectedUvs(const MeshData& given, UvProjection projection) {
  // Once points are doubled, the faces around one are no longer known.
  const MeshData mesh = given.generateNormals ? withGeneratedNormals(given, true) : given;
  const bool isRound = projection == UvProjection::spherical || projection == UvProjection::cylindrical;
  const Box3 box = bounds(mesh);
  MeshData result;
  Unique<PointKey> points;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const Triangle& t = mesh.triangles[i];
    std::array<Vec2, 3> uv;
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3 p(mesh.points[t[c]]);
      uv[c] = isRound                              ? around(p, box, projection == UvProjection::spherical)
              : projection == UvProjection::planar ? onPlane(p, box)
                                                   : onCube(p, box, faceNormal(mesh, i));
    }
    if (isRound) join(uv);
    Triangle triangle;
    for (std::size_t c = 0; c < 3; ++c) {
      triangle[c] = points.number({t[c], static_cast<float>(uv[c].x), static_cast<float>(uv[c].y)});
      if (triangle[c] < result.points.size()) continue;
      result.points.push_back(mesh.points[t[c]]);
      result.uvs.push_back(uv[c]);
      if (!mesh.secondUvs.empty()) result.secondUvs.push_back(mesh.secondUvs[t[c]]);
      if (!mesh.normals.empty()) result.normals.push_back(mesh.normals[t[c]]);
      if (!mesh.materials.empty()) result.materials.push_back(mesh.materials[t[c]]);
    }
    result.triangles.push_back(triangle);
  }
  return result;
}

}  // namespace trace
