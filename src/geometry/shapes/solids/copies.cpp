#include "geometry/shapes/solids/copies.h"

#include <algorithm>
#include <span>

#include "base/budget.h"
#include "base/error.h"
#include "geometry/placement.h"
#include "geometry/solve/span.h"
#include "math/elementary.h"

namespace trace {
namespace {

constexpr std::int64_t kMostLeaves = std::int64_t{1} << 40;

/// Outward normals of the tetrahedron's faces; each lies where n . p = 0.5.
constexpr std::array<Vec3, 4> kTetrahedron{{{-1, -1, -1}, {-1, 1, 1}, {1, -1, 1}, {1, 1, -1}}};

const Box3 kSeedBox{{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}};

}  // namespace

std::shared_ptr<const TracedCopies> Sierpinski::prepared() const {
  std::vector<Affine> maps;
  for (const Vec3& corner : kTetrahedron) {  // opposite to the faces
    maps.push_back(Affine::scaling({0.5, 0.5, 0.5}));
    maps.back().offset = corner * -0.25;
  }
  return std::make_shared<const TracedCopies>(std::move(maps), Seed::tetrahedron,
                                              std::clamp(levels, 0, kMostLevels));
}

std::shared_ptr<const TracedCopies> Ifs::prepared() const {
  std::vector<Affine> affine;
  for (const Map& m : maps) {
    Affine a;
    Real longest = 0;  // longest of the linear part's columns: the sum of their squares bounds the largest
                       // stretch, squared
    for (std::size_t i = 0; i < 3; ++i) {
      a.row[i] = {m[4 * i], m[4 * i + 1], m[4 * i + 2]};
      a.offset[static_cast<int>(i)] = m[4 * i + 3];
    }
    // Repeated squaring of A^T A finds how much it stretches at most.
    Affine square = a;
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k)
        square.row[i][k] = a.row[0][i] * a.row[0][k] + a.row[1][i] * a.row[1][k] + a.row[2][i] * a.row[2][k];
    square.offset = {};
    Real power = 1, scale = 1;
    for (int i = 0; i < 12; ++i) {
      longest = std::sqrt(dot(square.row[0], square.row[0]) + dot(square.row[1], square.row[1]) +
                          dot(square.row[2], square.row[2]));
      if (!(longest > 0) || !std::isfinite(longest)) break;
      scale *= math::pow(longest, power);
      for (Vec3& row : square.row) row = row / longest;
      square = square * square;
      power *= 0.5;
    }
    constexpr Real kMost = 0.999;
    if (!(scale < kMost * kMost))
      throw Error(Fault::scene,
                  "maps: expected maps that shrink in every direction, found one that does not");
    checkBudget();
    if (!invertible(a)) throw Error(Fault::scene, "maps: expected maps that can be undone, found a flat one");
    affine.push_back(a);
  }
  if (affine.empty()) throw Error(Fault::scene, "maps: expected at least one");
  return std::make_shared<const TracedCopies>(std::move(affine), seed, std::clamp(levels, 0, 30));
}

TracedCopies::TracedCopies(std::vector<Affine> maps, Seed seed, int levels)
    : maps_(std::move(maps)), seed_(seed), levels_(0) {
  const auto count = static_cast<std::int64_t>(maps_.size());
  for (; levels_ < levels && leaves_ <= kMostLeaves / count; ++levels_) leaves_ *= count;
  for (const Affine& map : maps_) back_.push_back(inverse(map));
  // The box of a level holds the copies of the one before; of the last level, only those count.
  reach_ = bounds_ = kSeedBox;
  boxes_.push_back(roomy(bounds_));
  for (int i = 0; i < levels_; ++i) {
    Box3 next;
    for (const Affine& map : maps_) next.extend(map * bounds_);
    bounds_ = next;
    reach_.extend(next);
    boxes_.push_back(roomy(next));
  }
  reach_ = roomy(reach_);
  error_ = maxComponent(max(abs(reach_.low), abs(reach_.high))) * gammaError(32 + 12 * levels_);
}

bool TracedCopies::meetSeed(const Ray& ray, Stretch& stretch) const {
  const Vec3 &o = ray.origin, &d = ray.direction;
  Crossing in{-kInfinity, 0}, out{kInfinity, 0};
  const auto halfSpace = [&](Real height, Real slope, int face) {  // inside where height + slope t < 0
    if (slope == 0) return height < 0;
    const Real t = -height / slope;
    if (slope < 0 && t > in.t) in = {t, face};
    if (slope > 0 && t < out.t) out = {t, face};
    return true;
  };
  switch (seed_) {
    case Seed::cube:
      for (int axis = 0; axis < 3; ++axis)
        if (!halfSpace(-0.5 - o[axis], -d[axis], 2 * axis) ||
            !halfSpace(o[axis] - 0.5, d[axis], 2 * axis + 1))
          return false;
      break;
    case Seed::tetrahedron:
      for (int i = 0; i < 4; ++i) {
        const Vec3& n = kTetrahedron[static_cast<std::size_t>(i)];
        if (!halfSpace(dot(n, o) - 0.5, dot(n, d), i)) return false;
      }
      break;
    case Seed::ball: {
      const Real a = dot(d, d), b = dot(o, d);
      const Vec3 nearest = o - d * (b / a);
      const Roots2 roots = solveQuadratic(a, b, dot(o, o) - 0.25, a * (0.25 - dot(nearest, nearest)));
      if (!roots.count) return false;
      in.t = roots.t0;
      out.t = roots.t1;
    }
  }
  stretch = {in, out};
  return in.t < out.t;
}

/// In order, with those that overlap or touch made one; how many are left, from the first on.
std::size_t TracedCopies::joined(std::span<Stretch> all) {
  std::sort(all.begin(), all.end(), [](const Stretch& a, const Stretch& b) {
    return a.in.t != b.in.t ? a.in.t < b.in.t : a.in.part < b.in.part;
  });
  std::size_t count = 0;
  for (const Stretch& s : all) {
    if (count > 0 && s.in.t <= all[count - 1].out.t) {
      if (s.out.t > all[count - 1].out.t) all[count - 1].out = s.out;
    } else {
      all[count++] = s;
    }
  }
  return count;
}

void TracedCopies::descend(const Ray& ray, int level, std::int64_t leaf, const Range& range, Merging& merging,
                           SmallList<Stretch, 16>& found) const {
  checkBudget();
  if (level == 0) {
    Stretch stretch;
    if (!meetSeed(ray, stretch)) return;
    stretch.in.part += leaf * kFaces;
    stretch.out.part += leaf * kFaces;
    found.add(stretch);
    if (found.size() >= merging.next) {
      found.shrink(joined(found.all()));
      merging = {std::max(2 * found.size(), Merging::kFirst), true};
    }
    return;
  }
  const Span span = spanIn(reach_, ray);
  if (span.empty() || span.to < range.from || span.from > range.to) return;
  if (merging.begun) {  // what lies within a stretch that is found changes no end of it
    const Span own = spanIn(boxes_[static_cast<std::size_t>(level)], ray);
    if (own.empty()) return;
    for (const Stretch& s : found.all())
      if (s.in.t < own.from && own.to < s.out.t) return;
  }
  for (std::size_t i = 0; i < maps_.size(); ++i) {
    const Ray inner{back_[i] * ray.origin, linear(back_[i], ray.direction)};
    descend(inner, level - 1, leaf * static_cast<std::int64_t>(maps_.size()) + static_cast<std::int64_t>(i),
            range, merging, found);
  }
}

void TracedCopies::crossings(const Ray& ray, const Range& range, VisitCrossing visit) const {
  if (spanIn(roomy(bounds_), ray).empty()) return;
  SmallList<Stretch, 16> found;
  Merging merging;
  descend(ray, levels_, 0, range, merging, found);
  for (const Stretch& s : found.all().first(joined(found.all()))) {
    visit(s.in);
    visit(s.out);
  }
}

SurfacePoint TracedCopies::surface(const Ray& ray, const Crossing& crossing) const {
  // The number of the leaf says the way to it, the innermost map last.
  const auto count = static_cast<std::int64_t>(maps_.size());
  std::int64_t leaf = crossing.part / kFaces;
  Affine outFromIn, inFromOut;
  for (int level = 0; level < levels_; ++level, leaf /= count) {
    const auto i = static_cast<std::size_t>(leaf % count);
    outFromIn = maps_[i] * outFromIn;
    inFromOut = inFromOut * back_[i];
  }
  Vec3 p = inFromOut * ray.at(crossing.t), n;
  const auto face = static_cast<int>(crossing.part % kFaces);
  switch (seed_) {
    case Seed::cube:
      n[face / 2] = face % 2 != 0 ? 1 : -1;
      p[face / 2] = 0.5 * n[face / 2];
      break;
    case Seed::tetrahedron: {
      const Vec3& outward = kTetrahedron[static_cast<std::size_t>(face)];
      p = p - outward * ((dot(outward, p) - 0.5) / 3);
      n = normalize(outward);
      break;
    }
    case Seed::ball: {
      n = normalize(p);
      p = n * 0.5;
    }
  }
  const Real e = gammaError(16);
  SurfacePoint s = outOf({p, {e, e, e}, n, n, {}}, WayOut(outFromIn, inFromOut), inFromOut);
  s.error += Vec3{1, 1, 1} * error_;
  const Vec3 size = bounds_.size();
  const auto share = [&](int axis) {
    return size[axis] > 0 ? std::clamp((s.point[axis] - bounds_.low[axis]) / size[axis], 0.0, 1.0) : 0.5;
  };
  const Vec3 turned = abs(s.normal);
  const int across = turned.x > max(turned.y, turned.z) ? 1 : 0,
            up = turned.z > max(turned.x, turned.y) ? 1 : 2;
  s.uv = {share(across), share(up)};
  return s;
}

}  // namespace trace
