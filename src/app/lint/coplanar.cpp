#include "app/lint/coplanar.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/budget.h"
#include "base/match.h"
#include "geometry/mesh/mesh.h"
#include "geometry/shapes/solids/cone.h"
#include "geometry/shapes/solids/cube.h"
#include "geometry/shapes/solids/disk.h"
#include "geometry/shapes/solids/plane.h"
#include "geometry/shapes/solids/square.h"
#include "geometry/traced.h"
#include "math/elementary.h"
#include "math/transform.h"

namespace trace {
namespace {

constexpr int kRound = 24;  // corners of the polygon inside a round face

/// A convex polygon in the world.
struct Face {
  std::uint32_t object = 0;
  std::vector<Vec3> corners;
  Vec3 normal;         ///< outward
  bool sheet = false;  ///< seen from both sides
  Real error = 0;      ///< bound of the corners' rounding
  Real key = 0;        ///< faces in one plane have nearly the same
  Vec2 low{}, high{};  ///< bounds across one axis, the same for faces that are compared
};

class FlatFaces {
 public:
  explicit FlatFaces(const Scene& scene) {
    for (const Object& object : scene.objects) {
      if (!invertible(object.worldFromObject)) continue;
      const Box3 box = prepare(object.shape).bounds();
      if (!box.unbounded()) all_.extend(object.worldFromObject * box);
    }
    all_.extend(scene.camera.position);
    for (std::uint32_t i = 0; i < scene.objects.size(); ++i)
      if (invertible(scene.objects[i].worldFromObject)) add(i, scene.objects[i]);
  }

  std::vector<Face> take() { return std::move(faces_); }
  Real size() const { return std::max(length(all_.size()), 1e-300); }
  Vec3 middle() const { return all_.center(); }

 private:
  void add(std::uint32_t number, const Object& object) {
    const auto face = [&](std::vector<Vec3> corners, bool sheet, Real precision) {
      checkBudget();
      if (faces_.size() >= kMostFlatFaces) return;
      Face f{.object = number, .corners = std::move(corners), .normal = {}, .sheet = sheet};
      Real largest = 0;
      for (Vec3& corner : f.corners) {
        corner = object.worldFromObject * corner;
        largest = std::max(largest, maxComponent(abs(corner)));
      }
      f.error = (largest + maxComponent(abs(object.worldFromObject.offset))) * precision;
      for (std::size_t i = 2; i < f.corners.size(); ++i)
        f.normal += cross(f.corners[i - 1] - f.corners[0], f.corners[i] - f.corners[0]);
      if (determinant(object.worldFromObject) < 0) f.normal = -f.normal;  // a mirror turns the corners round
      if (!(length(f.normal) > 0) || !isFinite(f.normal)) return;
      f.normal = normalize(f.normal);
      faces_.push_back(std::move(f));
    };
    constexpr Real kExact = gammaError(32), kFloat = 0x1p-22;
    const auto square = [&](const Vec3& middle, const Vec3& x, const Vec3& y, bool sheet) {
      face({middle - x - y, middle + x - y, middle + x + y, middle - x + y}, sheet, kExact);
    };
    const auto round = [&](Real z, Real radius, bool up, bool sheet) {
      std::vector<Vec3> corners;
      for (int i = 0; i < kRound; ++i) {
        const Real angle = (up ? 2 : -2) * kPi * i / kRound;
        corners.push_back({radius * math::cos(angle), radius * math::sin(angle), z});
      }
      face(std::move(corners), sheet, kExact);
    };
    visitAs<Square, Cube, Plane, Disk, Cylinder, Cone, Mesh>(
        object.shape, Overloaded{[&](const Square&) {
                                   square({}, {0.5, 0, 0}, {0, 0.5, 0}, true);
                                 },
                                 [&](const Cube&) {
                                   for (int axis = 0; axis < 3; ++axis)
                                     for (const Real side : {-0.5, 0.5}) {
                                       Vec3 middle, x, y;
                                       middle[axis] = side;
                                       x[(axis + 1) % 3] = 0.5;
                                       y[(axis + 2) % 3] = side;
                                       square(middle, x, y, false);
                                     }
                                 },
                                 [&](const Plane&) {
                                   const Vec3 m = inverse(object.worldFromObject) * middle();
                                   const Box3 box = inverse(object.worldFromObject) * all_;
                                   const Real far = 2 * length(box.size());
                                   square({m.x, m.y, 0}, {far, 0, 0}, {0, far, 0}, false);
                                 },
                                 [&](const Disk& disk) {
                                   if (disk.innerRadius == 0) round(0, disk.radius, true, true);
                                 },
                                 [&](const Cylinder& c) {
                                   if (c.capped) {
                                     round(0, 1, false, false);
                                     round(1, 1, true, false);
                                   }
                                 },
                                 [&](const Cone& c) {
                                   if (c.capped) {
                                     round(0, c.bottomRadius, false, false);
                                     round(c.height, c.topRadius, true, false);
                                   }
                                 },
                                 [&](const Mesh& mesh) {
                                   for (std::uint32_t i = 0; i < mesh.data->triangles.size(); ++i) {
                                     const Corners c = corners(*mesh.data, i);
                                     face({c.a, c.b, c.c}, mesh.data->twoSided, kFloat);
                                   }
                                 }});
  }

  Box3 all_;
  std::vector<Face> faces_;
};

bool looksAt(const Face& face, const Vec3& eye) {
  return face.sheet || dot(face.normal, eye - face.corners[0]) > 0;
}

bool inOnePlane(const Face& a, const Face& b) {
  const Real most = a.error + b.error;
  const auto near = [&](const Face& plane, const Face& other) {
    return std::all_of(other.corners.begin(), other.corners.end(), [&](const Vec3& p) {
      return std::abs(dot(plane.normal, p - plane.corners[0])) <= most;
    });
  };
  return near(a, b) || near(b, a);
}

int longest(const Vec3& v) {
  const Vec3 a = abs(v);
  return a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
}
Vec2 across(const Vec3& p, int axis) { return {p[(axis + 1) % 3], p[(axis + 2) % 3]}; }

void measure(Face& face, int axis) {
  face.low = face.high = across(face.corners[0], axis);
  for (const Vec3& corner : face.corners) {
    const Vec2 p = across(corner, axis);
    face.low = {std::min(face.low.x, p.x), std::min(face.low.y, p.y)};
    face.high = {std::max(face.high.x, p.x), std::max(face.high.y, p.y)};
  }
}

Real area(const std::vector<Vec2>& polygon) {
  Real sum = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    sum += p.x * q.y - p.y * q.x;
  }
  return sum / 2;
}

/// A few places in the part of one polygon inside the other (Sutherland and Hodgman 1974); none if that is
/// not more than an edge.
std::vector<Vec3> overlap(const Face& a, const Face& b) {
  constexpr Real kLeastShare = 1e-6;  // relative to the smaller face
  const int axis = longest(a.normal);
  const auto flat = [&](const Face& face) {
    std::vector<Vec2> polygon;
    const Vec2 origin = across(a.corners[0], axis);
    for (const Vec3& corner : face.corners) {
      const Vec2 p = across(corner, axis);
      polygon.push_back({p.x - origin.x, p.y - origin.y});
    }
    if (area(polygon) < 0) std::reverse(polygon.begin(), polygon.end());
    return polygon;
  };
  std::vector<Vec2> inside = flat(a);
  const std::vector<Vec2> clip = flat(b);
  const Real least = kLeastShare * std::min(area(inside), area(clip));
  for (std::size_t i = 0; i < clip.size() && !inside.empty(); ++i) {
    const Vec2 &p = clip[i], &q = clip[(i + 1) % clip.size()];
    const auto side = [&](const Vec2& r) { return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x); };
    std::vector<Vec2> rest;
    for (std::size_t k = 0; k < inside.size(); ++k) {
      const Vec2 &r = inside[k], &s = inside[(k + 1) % inside.size()];
      const Real u = side(r), v = side(s);
      if (u >= 0) rest.push_back(r);
      if ((u > 0 && v < 0) || (u < 0 && v > 0)) {
        const Real t = u / (u - v);
        rest.push_back({r.x + t * (s.x - r.x), r.y + t * (s.y - r.y)});
      }
    }
    inside = std::move(rest);
  }
  if (inside.size() < 3 || !(area(inside) > least)) return {};

  constexpr std::size_t kPlaces = 4;
  const auto place = [&](const Vec2& p) {
    Vec3 way;
    way[(axis + 1) % 3] = p.x;
    way[(axis + 2) % 3] = p.y;
    way[axis] = -dot(a.normal, way) / a.normal[axis];
    return a.corners[0] + way;
  };
  Vec2 middle{0, 0};
  const auto count = static_cast<Real>(inside.size());
  for (const Vec2& p : inside) middle = {middle.x + p.x / count, middle.y + p.y / count};
  std::vector<Vec3> places{place(middle)};
  const std::size_t step = std::max<std::size_t>(1, inside.size() / kPlaces);
  for (std::size_t i = 0; i < inside.size() && places.size() <= kPlaces; i += step)
    places.push_back(place({0.2 * middle.x + 0.8 * inside[i].x, 0.2 * middle.y + 0.8 * inside[i].y}));
  return places;
}

}  // namespace

std::set<std::pair<std::uint32_t, std::uint32_t>> overlappingFaces(
    const Scene& scene, const std::function<bool(const Vec3&)>& isSeen) {
  FlatFaces collected(scene);
  const Real size = collected.size();
  const Vec3 middle = collected.middle(), eye = scene.camera.position;
  std::vector<Face> faces = collected.take();
  std::erase_if(faces, [&](const Face& face) { return !looksAt(face, eye); });
  for (Face& face : faces) {
    // One number for each plane: what is not in one plane seldom has the same.
    constexpr Vec3 kWeights{0.5497, 0.3319, 0.7663};
    const Vec3 n = dot(face.normal, kWeights) < 0 ? -face.normal : face.normal;
    face.key = dot(n, kWeights) + 0.6180 * dot(n, face.corners[0] - middle) / size;
  }
  std::stable_sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) { return a.key < b.key; });

  std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
  std::size_t tests = 0, places = 0;
  constexpr Real kNear = 1e-6;  // tolerance of keys; whether it is one plane, inOnePlane() decides
  for (std::size_t begin = 0; begin < faces.size();) {
    std::size_t end = begin + 1;  // end of a run of keys without a gap
    bool several = false;
    while (end < faces.size() && faces[end].key - faces[end - 1].key <= kNear) {
      several = several || faces[end].object != faces[begin].object;
      ++end;
    }
    if (several) {
      const int axis = longest(faces[begin].normal);
      for (std::size_t i = begin; i < end; ++i) measure(faces[i], axis);
      const auto group = faces.begin();
      std::stable_sort(group + static_cast<std::ptrdiff_t>(begin), group + static_cast<std::ptrdiff_t>(end),
                       [](const Face& a, const Face& b) { return a.low.x < b.low.x; });
      for (std::size_t i = begin; i < end; ++i)
        for (std::size_t k = i + 1; k < end && faces[k].low.x <= faces[i].high.x; ++k) {
          checkBudget();
          const Face &a = faces[i], &b = faces[k];
          if (++tests > kMostOverlapTests) return pairs;
          if (a.object == b.object || a.low.y > b.high.y || b.low.y > a.high.y) continue;
          const auto pair = std::minmax(a.object, b.object);
          if (pairs.contains(pair) || !inOnePlane(a, b)) continue;
          const std::vector<Vec3> common = overlap(a, b);
          if ((places += common.size()) > kMostPlaces) return pairs;
          if (std::any_of(common.begin(), common.end(), isSeen)) pairs.insert(pair);
        }
    }
    begin = end;
  }
  return pairs;
}

}  // namespace trace
