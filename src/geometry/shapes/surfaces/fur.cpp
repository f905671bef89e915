#include "geometry/shapes/surfaces/fur.h"

#include <algorithm>
#include <optional>
#include <string>

#include "base/budget.h"
#include "base/error.h"
#include "geometry/shapes/solids/csg_tree.h"
#include "geometry/shapes/solids/placed.h"
#include "geometry/solve/span.h"
#include "math/elementary.h"
#include "math/noise.h"
#include "math/perpendicular.h"

namespace trace {
namespace {

/// The random numbers of one strand or line.
class StrandChance {
 public:
  StrandChance(int seed, std::uint64_t number)
      : state_(mixBits(mixBits(static_cast<std::uint64_t>(seed)) ^ number)) {}
  Real between(Real low, Real high) {
    state_ = mixBits(state_);
    return low + (high - low) * unitFromBits(state_);
  }
  Vec3 direction() {
    const Real z = between(-1, 1), phi = between(0, 2 * kPi), r = std::sqrt(max(0, 1 - z * z));
    return {r * math::cos(phi), r * math::sin(phi), z};
  }

 private:
  std::uint64_t state_;
};

/// Where a strand begins.
struct FurRoot {
  Vec3 place, normal;
};

using StrandPath = std::vector<Vec3>;

/// An object that strands grow on and slide along.
struct Ground {
  Placed placed;
  Placement placement;

  /// The normal of the first surface that the way enters before its end, if it does.
  std::optional<Vec3> entered(const Ray& way) const {
    if (!placed.solid() || spanIn(placed.bounds(), way).empty()) return {};
    const Ray in = placement.into(way);
    std::optional<Vec3> normal;
    Real nearest = 1;
    const auto meet = [&](const Crossing& c) {
      if (!(c.t > 0 && c.t < nearest)) return;
      const Vec3 n = placed.surface(way, c).normal;
      if (dot(n, way.direction) < 0) normal = n, nearest = c.t;
    };
    if (const MeshTree* mesh = placed.meshTree().get()) {
      NodeCount nodes;
      std::uint64_t triangles = 0;
      const auto hit = [&](const MeshHit& m) {
        meet({m.hit.t, m.triangle});
        return false;
      };
      mesh->crossings(in, nearest, hit, MeshCounts{nodes, triangles});
    } else {
      placed.shape().crossings(in, Range{0, nearest}, meet);
    }
    return normal;
  }
};

/// Throws Error for an object that strands cannot grow on. Its bounds, which may be empty.
Box3 growsOn(const Operand& operand) {
  if (!invertible(operand.wholeFromOperand))
    throw Error(Fault::scene, "an object of fur is squeezed flat by its transform");
  const Box3 box = placedBounds(check(operand.shape).bounds, operand.wholeFromOperand);
  if (box.unbounded())
    throw Error(Fault::scene, "an object of fur is infinite", "cut off a part of it by a clip { }");
  return box;
}

class FurGrower {
 public:
  FurGrower(const Fur& fur, const MeshTrees& made) : fur_(fur), steps_(stepsOf(fur)) {
    for (const Operand& operand : fur.objects.list()) {
      const Box3 box = growsOn(operand);
      if (box.empty()) continue;
      objects_.push_back(
          {{operand.shape, operand.wholeFromOperand, made}, Placement(operand.wholeFromOperand)});
      const Real radius = 0.5 * trace::length(box.size());
      size_ = max(size_, radius);
      reach_.push_back((reach_.empty() ? 0 : reach_.back()) + radius * radius);
    }
  }

  static int stepsOf(const Fur& fur) {
    return 8 + static_cast<int>(std::ceil(8 * std::clamp(fur.curl, 0.0, 50.0)));
  }

  std::vector<Curves::Strand> strands() {
    findRoots();
    std::vector<StrandPath> leaders;
    const std::size_t clumps =
        std::min(roots_.size(), static_cast<std::size_t>(std::clamp(fur_.clumps, 0, Fur::kMostClumps)));
    for (std::size_t i = 0; i < clumps; ++i) leaders.push_back(grown(i));
    std::vector<Curves::Strand> all;
    for (std::size_t i = 0; i < roots_.size(); ++i) {
      checkBudget();
      const std::size_t leader = clumps == 0 ? i : nearestRoot(i, clumps);
      StrandPath path = i < clumps ? leaders[i] : grown(i);
      if (clumps > 0) drawTo(path, leaders[leader]);
      curl(path, leader);
      all.push_back(strandOf(path));
    }
    return all;
  }

 private:
  /// Roots in the order of the lines that find them, so that more strands keep the first ones.
  void findRoots() {
    const auto wanted = static_cast<std::size_t>(std::clamp(fur_.count, 0, Fur::kMostStrands));
    const std::uint64_t most = 1000 * std::uint64_t{wanted} + 100'000;
    for (std::uint64_t line = 0; line < most && roots_.size() < wanted && !objects_.empty(); ++line) {
      checkBudget();
      StrandChance chance(fur_.seed, line);
      const Real which = chance.between(0, reach_.back());
      const auto number = std::upper_bound(reach_.begin(), reach_.end() - 1, which) - reach_.begin();
      const Placed& object = objects_[static_cast<std::size_t>(number)].placed;
      const Real radius = 0.5 * trace::length(object.bounds().size());
      const Vec3 d = chance.direction(), x = perpendicularTo(d), y = cross(d, x);
      const Real r = radius * std::sqrt(chance.between(0, 1)), phi = chance.between(0, 2 * kPi);
      const Vec3 across = x * (r * math::cos(phi)) + y * (r * math::sin(phi));
      addRoots(object, {object.bounds().center() + across - d * (2 * radius), d}, wanted);
    }
  }

  void addRoots(const Placed& object, const Ray& ray, std::size_t wanted) {
    std::vector<Crossing> met;
    const auto note = [&](const Crossing& c) { met.push_back(c); };
    object.crossings(ray, note);
    std::sort(met.begin(), met.end(), [](const Crossing& a, const Crossing& b) { return a.before(b); });
    for (const Crossing& c : met) {
      if (roots_.size() == wanted) return;
      if (!std::isfinite(c.t)) continue;
      const SurfacePoint s = object.surface(ray, c);
      roots_.push_back({s.point, s.shading});
    }
  }

  std::size_t nearestRoot(std::size_t i, std::size_t count) const {
    std::size_t nearest = 0;
    Real least = kInfinity;
    for (std::size_t k = 0; k < count; ++k) {
      const Vec3 off = roots_[k].place - roots_[i].place;
      if (dot(off, off) < least) least = dot(off, off), nearest = k;
    }
    return nearest;
  }

  StrandChance chanceOf(std::size_t strand) const {
    return StrandChance(fur_.seed, ~static_cast<std::uint64_t>(strand));
  }

  /// The strand without clump and curl.
  StrandPath grown(std::size_t number) const {
    StrandChance chance = chanceOf(number);
    const FurRoot& root = roots_[number];
    const Real step = fur_.length * (1 + fur_.lengthSpread * chance.between(-1, 1)) / steps_;
    Vec3 d = heading(root.normal + fur_.comb + chance.direction() * (fur_.spread * chance.between(0, 1)),
                     root.normal);
    StrandPath path{root.place};
    Vec3 p = root.place + root.normal * (size_ * 0x1p-20);
    for (int i = 0; i < steps_; ++i) {
      d = besideObjects(p, d, step);
      p += d * step;
      path.push_back(p);
      d = heading(d + fur_.gravity / steps_, d);
    }
    return path;
  }

  static Vec3 heading(const Vec3& wanted, const Vec3& otherwise) {
    const Vec3 d = normalize(wanted);
    return isFinite(d) ? d : otherwise;
  }

  /// The direction turned out of the objects that the step would enter.
  Vec3 besideObjects(const Vec3& p, Vec3 d, Real step) const {
    constexpr int kMostTurns = 3;
    constexpr Real kOutward = 0.05;
    for (int turn = 0; turn < kMostTurns; ++turn) {
      const std::optional<Vec3> wall = entered({p, d * step});
      if (!wall) break;
      d = heading(d - *wall * dot(d, *wall) + *wall * kOutward, *wall);
    }
    return d;
  }

  /// The normal of a surface that a step of the strand enters.
  std::optional<Vec3> entered(const Ray& way) const {
    for (const Ground& object : objects_)
      if (const auto normal = object.entered(way)) return normal;
    return {};
  }

  void drawTo(StrandPath& path, const StrandPath& leader) const {
    for (std::size_t i = 0; i < path.size(); ++i) {
      const Real share = static_cast<Real>(i) / steps_;
      path[i] += (leader[i] - path[i]) * (std::clamp(fur_.clumping, 0.0, 1.0) * share);
    }
  }

  /// Winds the strand around its path, in step with others of its clump.
  void curl(StrandPath& path, std::size_t leader) const {
    if (!(fur_.curl > 0 && fur_.curlRadius > 0)) return;
    const Real begin = chanceOf(leader).between(0, 2 * kPi);
    const StrandPath straight = path;
    Vec3 side = perpendicularTo(heading(straight[1] - straight[0], {0, 0, 1}));
    for (std::size_t i = 1; i < path.size(); ++i) {
      const Vec3 along = heading(straight[i] - straight[i - 1], {0, 0, 1});
      side = heading(side - along * dot(side, along), perpendicularTo(along));
      const Real share = static_cast<Real>(i) / steps_, angle = begin + 2 * kPi * fur_.curl * share;
      path[i] +=
          (side * math::cos(angle) + cross(along, side) * math::sin(angle)) * (fur_.curlRadius * share);
    }
  }

  /// As Catmull-Rom needs it: with a point more at each end.
  Curves::Strand strandOf(const StrandPath& path) const {
    Curves::Strand strand;
    const auto add = [&](const Vec3& p, Real share) {
      strand.push_back({p.x, p.y, p.z, max(0, fur_.width + (fur_.tipWidth - fur_.width) * share)});
    };
    const std::size_t last = path.size() - 1;
    add(path[0] * 2 - path[1], 0);
    for (std::size_t i = 0; i <= last; ++i) add(path[i], static_cast<Real>(i) / steps_);
    add(path[last] * 2 - path[last - 1], 1);
    return strand;
  }

  const Fur& fur_;
  const int steps_;
  std::vector<Ground> objects_;
  std::vector<Real> reach_;  ///< squared radii around the objects, summed up
  Real size_ = 0;
  std::vector<FurRoot> roots_;
};

}  // namespace

std::shared_ptr<const TracedCurves> Fur::prepared(const MeshTrees& made) const {
  const Work work("growing fur");
  return std::make_shared<const TracedCurves>(FurGrower(*this, made).strands(), Spline::catmull, round);
}

ShapeFacts Fur::checked() const {
  Box3 box;
  for (const Operand& operand : objects.list()) box.extend(growsOn(operand));
  if (box.empty() || count < 1) return {};
  // Catmull-Rom goes beyond its points by less than a step.
  const Real room = 1.5 * length * (1 + lengthSpread) + 2 * curlRadius + max(width, tipWidth);
  const std::int64_t arcs = std::int64_t{std::clamp(count, 0, kMostStrands)} * FurGrower::stepsOf(*this);
  return {false,
          {box.low - Vec3{room, room, room}, box.high + Vec3{room, room, room}},
          TracedCurves::partsOf(arcs)};
}

}  // namespace trace
