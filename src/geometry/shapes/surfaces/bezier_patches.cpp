#include "geometry/shapes/surfaces/bezier_patches.h"

#include <algorithm>

#include "base/budget.h"
#include "base/error.h"
#include "base/small_list.h"
#include "math/perpendicular.h"

namespace trace {

std::shared_ptr<const TracedPatches> BezierPatches::prepared() const {
  std::vector<TracedPatches::Patch> all;
  for (const Points& points : patches) {
    TracedPatches::Patch patch;
    if (points.size() != patch.size())
      throw Error(Fault::scene,
                  "patches: expected 16 points for each, found " + std::to_string(points.size()));
    for (std::size_t i = 0; i < patch.size(); ++i) patch[i] = {points[i][0], points[i][1], points[i][2]};
    all.push_back(patch);
  }
  return std::make_shared<const TracedPatches>(std::move(all));
}

TracedPatches::TracedPatches(std::vector<Patch> patches) : patches_(std::move(patches)) {
  std::vector<Box3> boxes;
  for (const Patch& patch : patches_) {
    boxes.emplace_back();
    for (const Vec3& p : patch) boxes.back().extend(p);
    bounds_.extend(boxes.back());
  }
  error_ = bounds_.empty() ? 0 : maxComponent(max(abs(bounds_.low), abs(bounds_.high))) * gammaError(500);
  tree_ = LineTree(std::move(boxes));
}

namespace {

/// A place on a patch, and how it changes with u and v. T: points, or numbers.
template <class T>
struct Spot {
  T at, byU, byV;
};

template <class T>
std::array<T, 2> cubicAt(const T& a, const T& b, const T& c, const T& d, Real t) {
  const Real s = 1 - t;
  const T ab = a * s + b * t, bc = b * s + c * t, cd = c * s + d * t;
  const T abc = ab * s + bc * t, bcd = bc * s + cd * t;
  return {abc * s + bcd * t, (bcd - abc) * 3};
}

template <class T>
Spot<T> evaluate(const std::array<T, 16>& p, Real u, Real v) {
  std::array<T, 4> rows, slopes;
  for (std::size_t j = 0; j < 4; ++j) {
    const auto [at, slope] = cubicAt(p[4 * j], p[4 * j + 1], p[4 * j + 2], p[4 * j + 3], u);
    rows[j] = at;
    slopes[j] = slope;
  }
  const auto [at, byV] = cubicAt(rows[0], rows[1], rows[2], rows[3], v);
  return {at, cubicAt(slopes[0], slopes[1], slopes[2], slopes[3], v)[0], byV};
}

/// The part of a patch between two values of u and two of v, as distances from two planes through the ray.
struct PatchPiece {
  std::array<Real, 16> a, b;
  Real u0, u1, v0, v1;
};

struct Bounds {
  Real low = kInfinity, high = -kInfinity;
  void add(Real x) {
    low = min(low, x);
    high = max(high, x);
  }
  bool contains(Real x) const { return low <= x && x <= high; }
};

bool mayBeZero(const std::array<Real, 16>& d, Real room) {
  const auto [low, high] = std::minmax_element(d.begin(), d.end());
  return *low <= room && *high >= -room;
}

/// The bounds of the derivative in u (step 1) or v (step 4), in the piece's own coordinates from 0 to 1.
Bounds slopeBounds(const std::array<Real, 16>& d, std::size_t step) {
  Bounds bounds;
  for (std::size_t i = 0; i < 16; ++i)
    if ((step == 1 ? i % 4 : i / 4) != 3) bounds.add(3 * (d[i + step] - d[i]));
  return bounds;
}

enum class Roots { none, oneAtMost, unknown };

/// Moore's test: the two distances mixed so that in the middle the first changes with u alone and the second
/// with v. Where their slopes differ from that by less than 1 there is one common root at most, and it lies
/// not farther from Newton's step than the slopes differ.
Roots rootsOf(const PatchPiece& piece) {
  const Spot<Real> a = evaluate(piece.a, 0.5, 0.5), b = evaluate(piece.b, 0.5, 0.5);
  const Real det = a.byU * b.byV - a.byV * b.byU;
  if (!(std::abs(det) > 0)) return Roots::unknown;
  bool one = true;
  const auto differs = [&](Real p, Real q, std::size_t own) {
    std::array<Real, 16> d;
    for (std::size_t i = 0; i < 16; ++i) d[i] = (p * piece.a[i] + q * piece.b[i]) / det;
    const Bounds along = slopeBounds(d, own), across = slopeBounds(d, 5 - own);
    const Real most = max(std::abs(along.low - 1), std::abs(along.high - 1)) +
                      max(std::abs(across.low), std::abs(across.high));
    one = one && most < 1;
    const Real step = std::abs((p * a.at + q * b.at) / det);
    constexpr Real kRoom = 1 + gammaError(400);
    return step > 0.5 * (1 + most) * kRoom;
  };
  const bool noU = differs(b.byV, -a.byV, 1), noV = differs(-b.byU, a.byU, 4);
  return noU || noV ? Roots::none : one ? Roots::oneAtMost : Roots::unknown;
}

/// Both halves of four numbers of a cubic.
void halve(Real& p0, Real& p1, Real& p2, Real& p3, Real& q0, Real& q1, Real& q2, Real& q3) {
  const Real ab = 0.5 * (p0 + p1), bc = 0.5 * (p1 + p2), cd = 0.5 * (p2 + p3);
  const Real abc = 0.5 * (ab + bc), bcd = 0.5 * (bc + cd), middle = 0.5 * (abc + bcd);
  q3 = p3;
  q2 = cd;
  q1 = bcd;
  q0 = middle;
  p1 = ab;
  p2 = abc;
  p3 = middle;
}

PatchPiece splitOff(PatchPiece& piece, bool inU) {
  PatchPiece other = piece;
  const std::size_t step = inU ? 1 : 4, next = 5 - step;
  for (auto [p, q] : {std::pair{&piece.a, &other.a}, std::pair{&piece.b, &other.b}})
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t i = k * next;
      halve((*p)[i], (*p)[i + step], (*p)[i + 2 * step], (*p)[i + 3 * step], (*q)[i], (*q)[i + step],
            (*q)[i + 2 * step], (*q)[i + 3 * step]);
    }
  Real& end = inU ? piece.u1 : piece.v1;
  (inU ? other.u0 : other.v0) = end = inU ? 0.5 * (piece.u0 + piece.u1) : 0.5 * (piece.v0 + piece.v1);
  return other;
}

struct Root {
  Real u, v;
};

/// Newton's steps for a(u, v) = b(u, v) = 0 from there, until they no longer shrink.
Root polished(const std::array<Real, 16>& a, const std::array<Real, 16>& b, Root r) {
  Real last = kInfinity;
  for (int i = 0; i < 30; ++i) {
    const Spot<Real> f = evaluate(a, r.u, r.v), g = evaluate(b, r.u, r.v);
    const Real det = f.byU * g.byV - f.byV * g.byU;
    const Real du = (f.at * g.byV - g.at * f.byV) / det, dv = (g.at * f.byU - f.at * g.byU) / det;
    const Real step = max(std::abs(du), std::abs(dv));
    if (!(step < last)) break;
    r.u -= du;
    r.v -= dv;
    last = step;
    if (step == 0) break;
  }
  return r;
}

}  // namespace

void TracedPatches::crossings(const Ray& ray, VisitCrossing visit) const {
  const Vec3 along = normalize(ray.direction);
  const Vec3 aside = perpendicularTo(along);
  const Vec3 third = cross(along, aside);
  tree_.query(ray, [&](std::uint32_t number) {
    const Patch& patch = patches_[number];
    PatchPiece whole{{}, {}, 0, 1, 0, 1};
    for (std::size_t i = 0; i < 16; ++i) {
      const Vec3 p = patch[i] - ray.origin;
      whole.a[i] = dot(p, aside);
      whole.b[i] = dot(p, third);
    }
    // More than rounding has moved the distances: patches that share an edge leave no gap there.
    const Real room = error_ + gammaError(16) * length(ray.origin);
    constexpr int kMostDepth = 48;
    constexpr std::size_t kMostPieces =
        4000;  // where the ray runs along in the patch nothing tells roots apart
    std::array<PatchPiece, kMostDepth + 2> stack;
    std::array<int, kMostDepth + 2> depths;
    std::size_t count = 0, looked = 0;
    stack[count] = whole;
    depths[count++] = 0;
    SmallList<Root, 8> roots;
    while (count > 0 && ++looked < kMostPieces) {
      checkBudget();
      PatchPiece piece = stack[--count];
      const int depth = depths[count];
      if (!mayBeZero(piece.a, room) || !mayBeZero(piece.b, room)) continue;
      const Roots held = rootsOf(piece);
      if (held == Roots::none) continue;
      if (held == Roots::oneAtMost) {
        const Root start{0.5 * (piece.u0 + piece.u1), 0.5 * (piece.v0 + piece.v1)};
        const Root r = polished(whole.a, whole.b, start);
        constexpr Real kSlack = 0x1p-40;  // roots on common edges are found from both sides, and counted once
        if (r.u >= piece.u0 - kSlack && r.u <= piece.u1 + kSlack && r.v >= piece.v0 - kSlack &&
            r.v <= piece.v1 + kSlack && std::abs(evaluate(whole.a, r.u, r.v).at) <= room &&
            std::abs(evaluate(whole.b, r.u, r.v).at) <= room) {
          roots.add({std::clamp(r.u, 0.0, 1.0), std::clamp(r.v, 0.0, 1.0)});
          continue;
        }
      }
      if (depth == kMostDepth) continue;  // where the ray only touches
      const PatchPiece other = splitOff(piece, depth % 2 == 0);
      stack[count] = other;
      depths[count++] = depth + 1;
      stack[count] = piece;
      depths[count++] = depth + 1;
    }
    const std::span<Root> all = roots.all();
    for (std::size_t i = 0; i < all.size(); ++i) {
      bool again = false;
      for (std::size_t k = 0; k < i; ++k)
        again = again || (std::abs(all[k].u - all[i].u) < 0x1p-36 && std::abs(all[k].v - all[i].v) < 0x1p-36);
      if (again) continue;
      const Vec3 p = evaluate(patch, all[i].u, all[i].v).at - ray.origin;
      const auto step = [](Real x) {
        return std::min<std::int64_t>(std::llround(std::ldexp(x, kStepBits)), (1 << kStepBits) - 1);
      };
      const std::int64_t place = (step(all[i].u) << kStepBits) + step(all[i].v);
      visit({dot(p, along) / length(ray.direction),
             (static_cast<std::int64_t>(number) << (2 * kStepBits)) + place});
    }
  });
}

bool TracedPatches::onEdge(std::int64_t part) {
  constexpr std::int64_t kLast = (1 << kStepBits) - 1;
  const std::int64_t u = (part >> kStepBits) & kLast, v = part & kLast;
  return u <= 1 || v <= 1 || u >= kLast - 1 || v >= kLast - 1;
}

SurfacePoint TracedPatches::surface(const Ray& ray, const Crossing& crossing) const {
  SurfacePoint s = place(ray, crossing);
  if (dot(s.normal, ray.direction) > 0) s.normal = s.shading = -s.normal;
  return s;
}

SurfacePoint TracedPatches::place(const Ray& ray, const Crossing& crossing) const {
  const Patch& patch = patches_[static_cast<std::size_t>(crossing.part >> (2 * kStepBits))];
  constexpr std::int64_t kMask = (1 << kStepBits) - 1;
  const auto coordinate = [](std::int64_t step) { return std::ldexp(static_cast<Real>(step), -kStepBits); };
  Root r{coordinate((crossing.part >> kStepBits) & kMask), coordinate(crossing.part & kMask)};
  const Vec3 p = ray.at(crossing.t);
  Spot<Vec3> s = evaluate(patch, r.u, r.v);
  for (int i = 0; i < 3; ++i) {  // to the nearest place of the patch
    const Vec3 off = p - s.at;
    const Real uu = dot(s.byU, s.byU), uv = dot(s.byU, s.byV), vv = dot(s.byV, s.byV),
               det = uu * vv - uv * uv;
    const Real du = (dot(off, s.byU) * vv - dot(off, s.byV) * uv) / det;
    const Real dv = (dot(off, s.byV) * uu - dot(off, s.byU) * uv) / det;
    if (!(std::abs(du) < 1e-3 && std::abs(dv) < 1e-3)) break;
    r = {std::clamp(r.u + du, 0.0, 1.0), std::clamp(r.v + dv, 0.0, 1.0)};
    s = evaluate(patch, r.u, r.v);
  }
  Vec3 n = cross(s.byU, s.byV);
  if (!(dot(n, n) > 0)) {  // an edge drawn together to a point: as a little inside
    const Spot<Vec3> inside = evaluate(patch, r.u + (0.5 - r.u) * 0x1p-20, r.v + (0.5 - r.v) * 0x1p-20);
    n = cross(inside.byU, inside.byV);
  }
  n = normalize(n);
  if (!isFinite(n)) n = normalize(-ray.direction);
  return {s.at, {error_, error_, error_}, n, n, {r.u, r.v}};
}

}  // namespace trace
