#include "geometry/mesh/mesh_smooth.h"

#include <numeric>
#include <utility>

#include "base/budget.h"
#include "geometry/mesh/mesh_crease.h"
#include "math/elementary.h"

namespace trace {
namespace {

using Index = std::uint32_t;

/// Sets that are joined (Tarjan 1975, with halved paths).
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), Index{0}); }
  Index find(Index i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(Index i, Index j) { parent_[find(i)] = find(j); }

 private:
  std::vector<Index> parent_;
};

Real angleBetween(const Vec3& a, const Vec3& b) { return math::atan2(length(cross(a, b)), dot(a, b)); }

}  // namespace

std::vector<Index> placesOf(const MeshData& mesh) {
  Unique<Vec3f> unique;
  std::vector<Index> numbers;
  numbers.reserve(mesh.points.size());
  for (const Vec3f& p : mesh.points) numbers.push_back(unique.number({p.x + 0.0f, p.y + 0.0f, p.z + 0.0f}));
  return numbers;
}

MeshData withCreaseNormals(const MeshData& mesh, Real angle) {
  const auto count = static_cast<Index>(mesh.triangles.size());
  const std::vector<Index> place = placesOf(mesh);
  std::vector<Vec3> faces(count);
  for (Index i = 0; i < count; ++i) faces[i] = normalize(faceNormal(mesh, i));

  // Corners of one point that smooth edges join share a normal. Corner 3 i + c is that of point c of triangle
  // i.
  Sets sets(3 * static_cast<std::size_t>(count));
  Unique<Edge> edges;
  std::vector<Edge> firstCorners;  // first corners of each edge, at its a and at its b
  const Real least = math::cos(angle);
  for (Index i = 0; i < count; ++i)
    for (Index c = 0; c < 3; ++c) {
      const Index next = (c + 1) % 3;
      const Index p = place[mesh.triangles[i][c]], q = place[mesh.triangles[i][next]];
      const Edge corners = p < q ? Edge{3 * i + c, 3 * i + next} : Edge{3 * i + next, 3 * i + c};
      const Index number = edges.number(edgeOf(p, q));
      if (number == firstCorners.size()) {
        firstCorners.push_back(corners);
      } else if (const Edge other = firstCorners[number]; dot(faces[i], faces[other.a / 3]) >= least) {
        sets.join(corners.a, other.a);
        sets.join(corners.b, other.b);
      }
    }

  std::vector<Vec3> sums(3 * static_cast<std::size_t>(count));
  for (Index i = 0; i < count; ++i) {
    const Corners v = corners(mesh, i);
    const Vec3 at[3] = {v.a, v.b, v.c};
    for (Index c = 0; c < 3; ++c)
      sums[sets.find(3 * i + c)] += faces[i] * angleBetween(at[(c + 1) % 3] - at[c], at[(c + 2) % 3] - at[c]);
  }

  MeshData result;
  Unique<Edge> points;  // a point of the mesh, and the set of corners it belongs to
  for (Index i = 0; i < count; ++i) {
    Triangle triangle;
    for (Index c = 0; c < 3; ++c) {
      const Index from = mesh.triangles[i][c], set = sets.find(3 * i + c);
      triangle[c] = points.number({from, set});
      if (triangle[c] < result.points.size()) continue;
      result.points.push_back(mesh.points[from]);
      const Vec3 n = sums[set];
      result.normals.push_back(Vec3f(n == Vec3{} ? faces[i] : normalize(n)));
      if (!mesh.uvs.empty()) result.uvs.push_back(mesh.uvs[from]);
      if (!mesh.secondUvs.empty()) result.secondUvs.push_back(mesh.secondUvs[from]);
      if (!mesh.tangents.empty()) result.tangents.push_back(mesh.tangents[from]);
      if (!mesh.materials.empty()) result.materials.push_back(mesh.materials[from]);
    }
    result.triangles.push_back(triangle);
  }
  return result;
}

namespace {

/// The creases become those one level finer.
MeshData subdividedOnce(const MeshData& mesh, std::vector<Crease>& creases) {
  const auto points = static_cast<Index>(mesh.points.size());
  MeshData result;
  result.materials = mesh.materials;
  result.uvs = mesh.uvs;
  result.secondUvs = mesh.secondUvs;

  // The points opposite each edge, and how many triangles it has.
  Unique<Edge> edges;
  std::vector<Vec3> opposite;
  std::vector<int> uses;
  std::vector<std::array<Index, 3>> middles;
  for (const Triangle& t : mesh.triangles) {
    checkBudget();
    middles.emplace_back();
    for (Index c = 0; c < 3; ++c) {
      const Index number = edges.number(edgeOf(t[c], t[(c + 1) % 3]));
      if (number == uses.size()) {
        uses.push_back(0);
        opposite.emplace_back();
      }
      ++uses[number];
      opposite[number] += Vec3(mesh.points[t[(c + 2) % 3]]);
      middles.back()[c] = points + number;
    }
  }

  // Old points move toward the mean of their neighbours; of those on a crease, only those along it count.
  SharpEdges sharp(edges, uses, creases, points);
  creases = std::move(sharp.finer);
  std::vector<Vec3> around(points);
  std::vector<int> valence(points), borders(points);
  std::vector<PointCreases> at(points);
  for (std::size_t i = 0; i < uses.size(); ++i) {
    const Edge e = edges.keys()[i];
    const Vec3 a(mesh.points[e.a]), b(mesh.points[e.b]);
    around[e.a] += b;
    around[e.b] += a;
    ++valence[e.a];
    ++valence[e.b];
    at[e.a].add(b, sharp.sharpness[i]);
    at[e.b].add(a, sharp.sharpness[i]);
    if (uses[i] != 2) {
      ++borders[e.a];
      ++borders[e.b];
    }
  }
  for (Index i = 0; i < points; ++i) {
    const Vec3 p(mesh.points[i]);
    if (borders[i] == 2 || (borders[i] == 0 && valence[i] >= 3)) {
      const Real weight = valence[i] == 3 ? 3.0 / 16 : 3.0 / (8 * valence[i]);
      result.points.push_back(Vec3f(at[i].moved(p, p * (1 - valence[i] * weight) + around[i] * weight)));
    } else {
      result.points.push_back(mesh.points[i]);  // a corner
    }
  }
  for (std::size_t i = 0; i < uses.size(); ++i) {
    const Edge e = edges.keys()[i];
    checkBudget();
    const Vec3 ends = Vec3(mesh.points[e.a]) + Vec3(mesh.points[e.b]);
    result.points.push_back(
        Vec3f(creased(ends * 0.375 + opposite[i] * 0.125, ends * 0.5, sharp.sharpness[i])));
    if (!mesh.materials.empty()) result.materials.push_back(mesh.materials[e.a]);
    addMiddle(result.uvs, mesh.uvs, e.a, e.b);
    addMiddle(result.secondUvs, mesh.secondUvs, e.a, e.b);
  }

  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Triangle &t = mesh.triangles[i], &m = middles[i];
    result.triangles.push_back({t[0], m[0], m[2]});
    result.triangles.push_back({t[1], m[1], m[0]});
    result.triangles.push_back({t[2], m[2], m[1]});
    result.triangles.push_back(m);
  }
  return result;
}

}  // namespace

MeshData subdivided(const MeshData& mesh, int levels, const std::vector<Crease>& creases) {
  MeshData result = mesh;
  std::vector<Crease> left = creases;
  Work work("subdividing a mesh", levels);
  for (int level = 0; level < levels; ++level) {
    work.reached(level);
    result = subdividedOnce(result, left);
  }
  return result;
}

}  // namespace trace
