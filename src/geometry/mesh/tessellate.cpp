#include "geometry/mesh/tessellate.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "base/budget.h"
#include "base/looks.h"
#include "geometry/mesh/mesh.h"
#include "geometry/shapes/surfaces/curves.h"
#include "geometry/shapes/surfaces/fur.h"
#include "geometry/traced.h"
#include "math/elementary.h"
#include "math/perpendicular.h"
#include "math/transform.h"

namespace trace {
namespace {

/// Normals within this angle of each other, 53 degrees, belong to one smooth surface.
constexpr Real kCrease = 0.6;
/// Pulls a cell's point to the middle of its crossings where their planes leave it free.
constexpr Real kPull = 1e-3;
/// How far the outermost lines stay inside the bounds, in shares of the longest side.
constexpr Real kInset = 1e-7;
/// Looks at the budget that all lines of a grid may take, unless more is wanted: half a minute's work at
/// most. One line through a usual shape takes one or two, one through a Mandelbulb of 10 iterations 50.
constexpr double kMostLooks = 1 << 16;
/// The steps of a line, on average, where a surface is found at all. The search gives up at 150, and a line
/// that misses the shape's bounds takes none: then what it finds is noise.
constexpr double kMostOfALine = 110;
constexpr std::uint32_t kNone = ~std::uint32_t{0};

struct Sample {
  Vec3 point, normal;
  std::uint32_t next = kNone;  ///< next in the same cell
};

class SampleGrid {
 public:
  SampleGrid(const Box3& bounds, int divisions) : bounds_(bounds) {
    const Real longest = maxComponent(bounds.size()), cell = longest / divisions;
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<Real>& at = lines_[axis];
      const Real low = bounds.low[axis], size = bounds.high[axis] - low;
      at.push_back(low - cell);
      if (size > 4 * kInset * longest) {  // flat shapes have no line across them
        const int count = std::max(2, static_cast<int>(std::ceil(size / cell)) + 1);
        for (int i = 0; i < count; ++i)
          at.push_back(low + kInset * longest + (size - 2 * kInset * longest) * i / (count - 1));
      }
      at.push_back(bounds.high[axis] + cell);
    }
    heads_.assign(cells(0) * cells(1) * cells(2), kNone);
  }

  /// The looks that all lines of the grid will take, told by some that are scattered over it; nothing where
  /// the search cannot follow the shape.
  std::optional<double> looks(const TracedShape& shape) {
    constexpr std::size_t kTried = 64;
    const std::vector<Line> all = lines();
    const std::size_t tried = std::min(kTried, all.size());
    const std::int64_t start = looksAtBudget();
    for (std::size_t i = 0; i < tried; ++i) {
      find(shape, all[i * all.size() / tried]);
      if (static_cast<double>(looksAtBudget() - start) > kMostOfALine * static_cast<double>(tried)) return {};
    }
    return static_cast<double>(looksAtBudget() - start) * static_cast<double>(all.size()) /
           static_cast<double>(tried);
  }

  void sample(const TracedShape& shape) {
    for (const Line& line : lines()) sampleLine(shape, line);
  }

  std::vector<SurfaceCorner> triangles(bool solid) {
    std::vector<SurfaceCorner> corners;
    std::vector<std::optional<Vec3>> points(heads_.size());
    for (const Edge& edge : edges_) {
      checkBudget();
      std::array<SurfaceCorner, 4> quad;
      for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t cell = cellAround(edge, i);
        if (!points[cell]) points[cell] = place(cell);
        quad[i] = {*points[cell], smoothNormal(cell, edge.normal, solid), edge.material};
      }
      // The ring runs counter-clockwise seen from the axis's end. Neighbours agree even where a cell's point
      // folds a thin triangle over, whose own normal would turn it.
      if (solid && edge.normal[edge.axis] < 0) std::swap(quad[1], quad[3]);
      for (const std::size_t i : {0, 1, 2, 0, 2, 3}) corners.push_back(quad[i]);
    }
    return corners;
  }

 private:
  struct Line {
    int axis;
    std::size_t j, k;  ///< its place in the two others
  };
  struct Edge {
    int axis;
    std::size_t i, j, k;  ///< interval along the axis, lines along the two others
    Vec3 normal;
    std::uint32_t material;
  };

  std::vector<Line> lines() const {
    std::vector<Line> all;
    for (int axis = 0; axis < 3; ++axis)
      for (std::size_t j = 1; j + 1 < lines_[next(axis)].size(); ++j)
        for (std::size_t k = 1; k + 1 < lines_[after(axis)].size(); ++k) all.push_back({axis, j, k});
    return all;
  }

  static int next(int axis) { return (axis + 1) % 3; }
  static int after(int axis) { return (axis + 2) % 3; }
  std::size_t cells(int axis) const { return lines_[axis].size() - 1; }

  /// The four cells around an edge, in a ring.
  std::size_t cellAround(const Edge& edge, std::size_t corner) const {
    std::size_t at[3];
    at[edge.axis] = edge.i;
    at[next(edge.axis)] = edge.j - (corner == 0 || corner == 3);
    at[after(edge.axis)] = edge.k - (corner == 0 || corner == 1);
    return (at[2] * cells(1) + at[1]) * cells(0) + at[0];
  }

  /// The crossings of the line, in their order, into found_; returns the ray along it.
  Ray find(const TracedShape& shape, const Line& line) {
    checkBudget();
    const std::vector<Real>& along = lines_[line.axis];
    Ray ray;
    ray.origin[line.axis] = along.front();
    ray.origin[next(line.axis)] = lines_[next(line.axis)][line.j];
    ray.origin[after(line.axis)] = lines_[after(line.axis)][line.k];
    ray.direction[line.axis] = 1;
    found_.clear();
    const auto keep = [&](const Crossing& crossing) { found_.push_back(crossing); };
    const Real end = along.back() - along.front();
    shape.crossings(ray, {0, end}, keep);
    std::sort(found_.begin(), found_.end(), [](const Crossing& a, const Crossing& b) { return a.before(b); });
    return ray;
  }

  void sampleLine(const TracedShape& shape, const Line& line) {
    const auto [axis, j, k] = line;
    const std::vector<Real>& along = lines_[axis];
    const Ray ray = find(shape, line);
    std::size_t last = kNone;
    for (const Crossing& crossing : found_) {
      const Real x = ray.origin[axis] + crossing.t;
      if (!(x > along.front() && x < along.back())) continue;
      const std::size_t i =
          static_cast<std::size_t>(std::upper_bound(along.begin(), along.end(), x) - along.begin()) - 1;
      if (i == last) continue;  // what is thinner than a cell is drawn once
      last = i;
      const SurfacePoint surface = shape.surface(ray, crossing);
      if (!isFinite(surface.point) || !isFinite(surface.normal)) continue;
      const MaterialMix mix = shape.material(crossing.part, SurfaceCorner::kOwn);
      const auto most = std::max_element(mix.weight, mix.weight + mix.count) - mix.weight;
      const Edge edge{axis, i, j, k, surface.normal, mix.material[most]};
      for (std::size_t corner = 0; corner < 4; ++corner) {
        std::uint32_t& head = heads_[cellAround(edge, corner)];
        samples_.push_back({surface.point, surface.normal, head});
        head = static_cast<std::uint32_t>(samples_.size() - 1);
      }
      edges_.push_back(edge);
    }
  }

  /// Where the tangent planes of the cell's crossings meet best, inside the cell and the bounds.
  Vec3 place(std::size_t cell) const {
    Vec3 middle;
    int count = 0;
    for (std::uint32_t s = heads_[cell]; s != kNone; s = samples_[s].next) {
      middle += samples_[s].point;
      ++count;
    }
    middle = middle / count;
    Affine normal;  // matrix of the normal equations, for the way from the middle
    for (int i = 0; i < 3; ++i) normal.row[i] = normal.row[i] * (kPull * count);
    Vec3 right;
    for (std::uint32_t s = heads_[cell]; s != kNone; s = samples_[s].next) {
      const Vec3& n = samples_[s].normal;
      for (int i = 0; i < 3; ++i) normal.row[i] += n * n[i];
      right += n * dot(n, samples_[s].point - middle);
    }
    const Vec3 p = middle + linear(inverse(normal), right);
    const std::size_t at[3] = {cell % cells(0), cell / cells(0) % cells(1), cell / (cells(0) * cells(1))};
    Vec3 inside;
    for (int i = 0; i < 3; ++i) inside[i] = std::clamp(p[i], lines_[i][at[i]], lines_[i][at[i] + 1]);
    return min(max(inside, bounds_.low), bounds_.high);
  }

  /// The mean of those of the cell's normals that belong to the surface with `normal`.
  Vec3 smoothNormal(std::size_t cell, const Vec3& normal, bool solid) const {
    Vec3 sum;
    for (std::uint32_t s = heads_[cell]; s != kNone; s = samples_[s].next) {
      const Real cosine = dot(samples_[s].normal, normal);
      if (solid ? cosine > kCrease : std::abs(cosine) > kCrease)
        sum += cosine < 0 ? -samples_[s].normal : samples_[s].normal;
    }
    return normalize(sum);
  }

  Box3 bounds_;
  std::vector<Real> lines_[3];
  std::vector<std::uint32_t> heads_;  // first sample of each cell
  std::vector<Sample> samples_;
  std::vector<Edge> edges_;
  std::vector<Crossing> found_;
};

Box3 cutOff(Box3 box, const Box3& within) {
  if (!isFinite(box.size())) {
    box.low = max(box.low, within.low);
    box.high = min(box.high, within.high);
  }
  return box;
}

std::vector<SurfaceCorner> meshCorners(const MeshData& given) {
  const MeshData data = given.generateNormals ? withGeneratedNormals(given, true) : given;
  std::vector<SurfaceCorner> result;
  result.reserve(data.triangles.size() * 3);
  for (std::uint32_t i = 0; i < data.triangles.size(); ++i) {
    const Vec3 face = faceNormal(data, i);
    if (!(length(face) > 0)) continue;
    for (const std::uint32_t corner : data.triangles[i]) {
      const Vec3 n = data.normals.empty() ? face : Vec3(data.normals[corner]);
      result.push_back({Vec3(data.points[corner]), normalize(length(n) > 0 ? n : face),
                        data.materials.empty() ? SurfaceCorner::kOwn : data.materials[data.triangles[i][0]]});
    }
  }
  return result;
}

}  // namespace

Box3 drawnBounds(const Shape& shape, const Box3& within) {
  const Box3 box = prepare(shape).bounds();
  return shape.is<Mesh>() ? box : cutOff(box, within);
}

namespace {

/// Three-sided tubes around strands, of which at most so many are drawn.
std::vector<SurfaceCorner> strandCorners(const TracedCurves& curves) {
  constexpr std::size_t kMostDrawn = 5000, kSides = 3;
  std::vector<SurfaceCorner> corners;
  for (const TracedCurves::Strand& strand : curves.drawn(kMostDrawn)) {
    checkBudget();
    std::array<SurfaceCorner, kSides> before{};
    Vec3 side{0, 0, 1};
    for (std::size_t i = 0; i < strand.size(); ++i) {
      const auto at = [&](std::size_t k) { return Vec3{strand[k][0], strand[k][1], strand[k][2]}; };
      const Vec3 along = normalize(at(std::min(i + 1, strand.size() - 1)) - at(i == 0 ? 0 : i - 1));
      if (!isFinite(along)) continue;
      const Vec3 turned = normalize(side - along * dot(side, along));
      side = isFinite(turned) ? turned : perpendicularTo(along);
      std::array<SurfaceCorner, kSides> ring;
      for (std::size_t k = 0; k < kSides; ++k) {
        const Real angle = 2 * kPi * static_cast<Real>(k) / kSides;
        const Vec3 out = side * math::cos(angle) + cross(along, side) * math::sin(angle);
        ring[k] = {at(i) + out * strand[i][3], out};
      }
      for (std::size_t k = 0; k < kSides && i > 0; ++k) {
        const SurfaceCorner &a = before[k], &b = before[(k + 1) % kSides], &c = ring[(k + 1) % kSides],
                            &d = ring[k];
        corners.insert(corners.end(), {a, b, c, a, c, d});
      }
      before = ring;
    }
  }
  return corners;
}

}  // namespace

std::vector<SurfaceCorner> tessellate(const Shape& shape, int divisions, const Box3& within, int* followed,
                                      bool wanted) {
  if (followed) *followed = divisions;
  if (const auto* mesh = shape.as<Mesh>()) return meshCorners(*mesh->data);
  std::optional<std::vector<SurfaceCorner>> strands;
  visitAs<Curves, Fur>(shape, [&](const auto& s) { strands = strandCorners(*s.prepared()); });
  if (strands) return *std::move(strands);
  const TracedShape form = prepare(shape);
  const Box3 box = cutOff(form.bounds(), within);
  if (!(maxComponent(box.size()) > 0)) return {};
  const std::optional<double> looks = SampleGrid(box, divisions).looks(form);
  if (!looks) return {};
  if (!wanted && *looks > kMostLooks)
    divisions = std::max(8, static_cast<int>(divisions * std::sqrt(kMostLooks / *looks)));
  if (followed) *followed = divisions;
  SampleGrid grid(box, divisions);
  grid.sample(form);
  return grid.triangles(form.solid());
}

}  // namespace trace
