#include "geometry/shapes/surfaces/sweep.h"

#include <algorithm>
#include <optional>

#include "base/error.h"
#include "base/small_list.h"
#include "base/text.h"
#include "math/elementary.h"

namespace trace {
namespace {

using PathArc = Cubic<4>;

Vec3 placeOn(const PathArc& arc, Real u) { return {arc.at(0, u), arc.at(1, u), arc.at(2, u)}; }
Vec3 slopeOf(const PathArc& arc, Real u) { return {arc.slope(0, u), arc.slope(1, u), arc.slope(2, u)}; }
Vec3 bendOf(const PathArc& arc, Real u) {
  const auto bend = [&](std::size_t axis) { return 2 * arc.c[axis][2] + 6 * arc.c[axis][3] * u; };
  return {bend(0), bend(1), bend(2)};
}
bool straight(const PathArc& arc) {
  return std::all_of(arc.c.begin(), arc.c.end(), [](const auto& c) { return c[2] == 0 && c[3] == 0; });
}

/// The direction of the path; where it stands still, of the way a little farther inside the arc.
Vec3 directionOf(const PathArc& arc, Real u) {
  for (const Real inside : {0.0, 0x1p-20, 0x1p-10, 0.5}) {
    const Vec3 slope = slopeOf(arc, u + (0.5 - u) * 2 * inside);
    const Vec3 d = normalize(slope);
    if (isFinite(d)) return d;
  }
  const Vec3 chord = normalize(placeOn(arc, 1) - placeOn(arc, 0));
  return isFinite(chord) ? chord : Vec3{0, 0, 1};
}

/// v turned as the shortest turn takes the unit vector `from` to `to`.
Vec3 turned(const Vec3& v, const Vec3& from, const Vec3& to) {
  const Vec3 axis = cross(from, to);
  const Real c = dot(from, to);
  if (c <= -1 + 1e-12) return v - from * (2 * dot(v, from));  // there and back
  return v * c + cross(axis, v) + axis * (dot(axis, v) / (1 + c));
}

/// The profile's directions x and y somewhere on the path, and the path's direction.
struct Frame {
  Vec3 x, y, along;
};

/// One step of double reflection.
Frame carried(const Frame& from, const Vec3& way, const Vec3& along) {
  const Real square = dot(way, way);
  if (!(square > 0)) return {turned(from.x, from.along, along), turned(from.y, from.along, along), along};
  const auto mirrored = [](const Vec3& v, const Vec3& m) { return v - m * (2 * dot(m, v) / dot(m, m)); };
  const Vec3 second = along - mirrored(from.along, way);
  const auto carry = [&](const Vec3& v) {
    const Vec3 once = mirrored(v, way);
    return dot(second, second) > 0 ? mirrored(once, second) : once;
  };
  const Vec3 x = normalize(carry(from.x) - along * dot(carry(from.x), along));
  return {x, cross(x, along), along};
}

/// A cross-section: its middle and axes, of the size they have there, and how these change along one piece.
struct Section {
  Vec3 center, x, y, xSlope, ySlope;
};

/// The Bezier points of a path's middle and of the profile's two axes over one piece.
struct PathPiece {
  std::array<Vec3, 4> center, x, y;
};

/// The pieces of the path, each with its sections at both ends; neighbours have the same bits in common.
class Path {
 public:
  Path(const Sweep& shape, std::vector<PathArc> arcs);

  std::vector<PathPiece> pieces;
  Frame first, last;  ///< at the ends of an open path
  bool closed = false;

 private:
  std::size_t stationsOf(const PathArc& arc) const;
  Section sectionAt(const PathArc& arc, Real u, const Frame& frame, Real turn, Real piece) const;

  std::vector<PathArc> arcs_;
  Real turn_ = 0;  ///< radians for each arc
};

std::size_t Path::stationsOf(const PathArc& arc) const {
  if (straight(arc) && turn_ == 0) return 1;
  // A cubic that meets a direction's ends with its slopes there is off by turn^4 / 384 where it turns evenly.
  constexpr Real kMostTurn = kPi / 24;
  constexpr std::size_t kMost = 256, kSamples = 4 * kMost;
  std::vector<Real> turned{0};  // by the path, up to each sample
  for (std::size_t i = 0; i < kSamples; ++i) {
    const Vec3 a = directionOf(arc, static_cast<Real>(i) / kSamples);
    const Vec3 b = directionOf(arc, static_cast<Real>(i + 1) / kSamples);
    turned.push_back(turned.back() + math::atan2(length(cross(a, b)), dot(a, b)));
  }
  std::size_t count = 2;
  for (; count < kMost; count *= 2) {
    const std::size_t each = kSamples / count;
    Real most = 0;
    for (std::size_t i = 0; i < kSamples; i += each) most = max(most, turned[i + each] - turned[i]);
    if (most + std::abs(turn_) / static_cast<Real>(count) <= kMostTurn) break;
  }
  return count;
}

Section Path::sectionAt(const PathArc& arc, Real u, const Frame& frame, Real turn, Real piece) const {
  const Vec3 slope = slopeOf(arc, u), bend = bendOf(arc, u);
  const Real speed = length(slope), scale = arc.at(3, u), growth = arc.slope(3, u);
  const Vec3 turning = speed > 0 ? (bend - frame.along * dot(bend, frame.along)) / speed : Vec3{};
  const Vec3 x = frame.x * math::cos(turn) + frame.y * math::sin(turn);
  const Vec3 y = frame.y * math::cos(turn) - frame.x * math::sin(turn);
  const Vec3 xTurn = y * turn_ - frame.along * dot(x, turning),
             yTurn = x * -turn_ - frame.along * dot(y, turning);
  return {placeOn(arc, u), x * scale, y * scale, (x * growth + xTurn * scale) * piece,
          (y * growth + yTurn * scale) * piece};
}

Path::Path(const Sweep& shape, std::vector<PathArc> arcs) : arcs_(std::move(arcs)) {
  const auto count = static_cast<Real>(arcs_.size());
  const PathArc &front = arcs_.front(), &back = arcs_.back();
  closed = arcs_.size() > 1;
  for (int axis = 0; axis < 4; ++axis) closed = closed && front.at(axis, 0) == back.at(axis, 1);
  Real twist = std::isfinite(shape.twist) ? shape.twist * (kPi / 180) : 0;
  if (closed) twist = 2 * kPi * std::round(twist / (2 * kPi));  // it must meet itself
  turn_ = twist / count;
  constexpr Real kMostDegrees = 15360;  // 60 for each of the most pieces of an arc
  if (std::abs(turn_) > kMostDegrees * (kPi / 180))
    throw Error(Fault::scene, "twist: expected at most " + toText(kMostDegrees) +
                                  " degrees for each arc of the path, found " + toText(turn_ / (kPi / 180)));

  first.along = directionOf(front, 0);
  const Vec3 up = std::abs(first.along.z) < 0.999 ? Vec3{0, 0, 1} : Vec3{0, 1, 0};
  first.x = normalize(cross(first.along, up));
  first.y = cross(first.x, first.along);

  // The frames at all stations; of a closed path they are then turned so that the last is the first.
  struct Station {
    std::size_t arc;
    Real u, piece;
    Frame frame;
  };
  std::vector<Station> stations;
  Frame frame = first;
  for (std::size_t i = 0; i < arcs_.size(); ++i) {
    const PathArc& arc = arcs_[i];
    frame = carried(frame, {}, directionOf(arc, 0));
    const std::size_t n = stationsOf(arc);
    const Real piece = 1 / static_cast<Real>(n);
    stations.push_back({i, 0, piece, frame});
    for (std::size_t k = 0; k < n; ++k) {
      constexpr int kSteps = 8;
      for (int step = 1; step <= kSteps; ++step) {
        const Real a = (static_cast<Real>(k) + static_cast<Real>(step - 1) / kSteps) * piece;
        const Real b = step == kSteps && k + 1 == n
                           ? 1
                           : (static_cast<Real>(k) + static_cast<Real>(step) / kSteps) * piece;
        frame = carried(frame, placeOn(arc, b) - placeOn(arc, a), directionOf(arc, b));
      }
      stations.push_back({i, static_cast<Real>(k + 1) * piece, piece, frame});
    }
  }
  last = frame;
  Real missing = 0;
  if (closed) {
    const Frame met = carried(frame, {}, first.along);
    missing = math::atan2(dot(cross(first.x, met.x), first.along), dot(first.x, met.x));
    turn_ += missing / count;  // x turns against the clock around the path
  }

  std::vector<Section> sections;
  sections.reserve(stations.size());
  for (const Station& s : stations)
    sections.push_back(
        sectionAt(arcs_[s.arc], s.u, s.frame, turn_ * (static_cast<Real>(s.arc) + s.u), s.piece));
  // Where arcs meet in a corner the sections on both sides are one, across the corner.
  const auto join = [&](Section& a, const Vec3& before, Section& b, const Vec3& after) {
    const Vec3 middle = before + after;
    constexpr Real kSharpest = 0.05;
    const auto across = [&](const Vec3& v) {
      return v - before * (dot(v, middle) / max(dot(before, middle), kSharpest));
    };
    if (dot(before, after) < 1 - 1e-9) {
      a.x = across(a.x);
      a.y = across(a.y);
    }
    b.center = a.center;
    b.x = a.x;
    b.y = a.y;
  };
  for (std::size_t i = 0; i + 1 < stations.size(); ++i)
    if (stations[i].arc != stations[i + 1].arc)
      join(sections[i], stations[i].frame.along, sections[i + 1], stations[i + 1].frame.along);
  if (closed) join(sections.back(), last.along, sections.front(), first.along);

  for (std::size_t i = 0; i + 1 < stations.size(); ++i) {
    if (stations[i].arc != stations[i + 1].arc) continue;
    const Section &a = sections[i], &b = sections[i + 1];
    const PathArc& arc = arcs_[stations[i].arc];
    const Real third = stations[i].piece / 3;
    const bool even = straight(arc) && turn_ == 0;  // then ends are joined by lines, also those of corners
    const auto axis = [&](const Vec3& from, const Vec3& slope, const Vec3& to, const Vec3& slopeTo) {
      const Vec3 chord = (to - from) / 3;
      return std::array{from, from + (even ? chord : slope / 3), to - (even ? chord : slopeTo / 3), to};
    };
    pieces.push_back({{a.center, a.center + slopeOf(arc, stations[i].u) * third,
                       b.center - slopeOf(arc, stations[i + 1].u) * third, b.center},
                      axis(a.x, a.xSlope, b.x, b.xSlope),
                      axis(a.y, a.ySlope, b.y, b.ySlope)});
  }
}

/// Twice the area that the profile goes around against the clock.
Real areaOf(const Arcs<2>& profile) {
  Real area = 0;
  for (const Cubic<2>& c : profile.arcs) {
    constexpr int kSteps = 16;
    for (int k = 0; k < kSteps; ++k) {
      const Real a = static_cast<Real>(k) / kSteps, b = static_cast<Real>(k + 1) / kSteps;
      area += c.at(0, a) * c.at(1, b) - c.at(0, b) * c.at(1, a);
    }
  }
  return area;
}

}  // namespace

std::shared_ptr<const TracedProfileSweep> Sweep::prepared() const {
  return std::make_shared<const TracedProfileSweep>(*this);
}

TracedProfileSweep::TracedProfileSweep(const Sweep& shape) {
  const Arcs<2> profile = shape.closed ? loopOf(shape.profileSpline, shape.profile)
                                       : arcsOf<2>(shape.profileSpline, shape.profile);
  std::vector<PathArc> arcs = arcsOf<4>(shape.spline, shape.points).arcs;
  std::erase_if(arcs, [](const PathArc& arc) {
    return slopeOf(arc, 0) == Vec3{} && slopeOf(arc, 0.5) == Vec3{} && slopeOf(arc, 1) == Vec3{};
  });
  if (profile.arcs.empty() || arcs.empty()) return;
  const Path path(shape, std::move(arcs));
  across_ = profile.arcs.size();
  along_ = path.pieces.size();
  constexpr std::size_t kMostPatches = 1'000'000;
  if (along_ > kMostPatches / across_)
    throw Error(Fault::scene, "a sweep of " + std::to_string(across_ * along_) + " patches is too large",
                "give the profile or the path fewer points");

  std::vector<TracedPatches::Patch> patches;
  for (const PathPiece& piece : path.pieces)
    for (std::size_t i = 0; i < across_; ++i) {
      const auto &x = profile.arcs[i].c[0], &y = profile.arcs[i].c[1];
      const auto bezier = [&](const std::array<Real, 4>& c, Real end) {
        return std::array{c[0], c[0] + c[1] / 3, c[0] + (2 * c[1] + c[2]) / 3, end};
      };
      const auto xs = bezier(x, profile.ends[i + 1][0]), ys = bezier(y, profile.ends[i + 1][1]);
      TracedPatches::Patch& patch = patches.emplace_back();
      for (std::size_t j = 0; j < 4; ++j)
        for (std::size_t k = 0; k < 4; ++k)
          patch[4 * j + k] = piece.center[j] + piece.x[j] * xs[k] + piece.y[j] * ys[k];
    }
  const bool ends = shape.closed && shape.capped && !path.closed;
  if (ends) {
    const PathPiece &front = path.pieces.front(), &back = path.pieces.back();
    caps_ = {{front.center[0], front.x[0], front.y[0], -path.first.along},
             {back.center[3], back.x[3], back.y[3], path.last.along}};
  }
  sides_ = TracedPatches(std::move(patches));
  bounds_ = sides_.bounds();
  for (Cap& cap : caps_) cap.error = maxComponent(max(abs(bounds_.low), abs(bounds_.high))) * gammaError(100);
  solid_ = shape.closed && (ends || path.closed);
  outward_ = areaOf(profile) > 0 ? -1 : 1;  // x, y and the path are a left hand
  Prism section;
  section.outline = shape.profile;
  section.spline = shape.profileSpline;
  section_ = section.prepared();
  profileBox_ = section_->bounds();
}

// --- crossings ----------------------------------------------------------------------------------------

struct TracedProfileSweep::Event {
  Crossing crossing;
  bool entering = false, onEdge = false;
};

namespace {

/// Whether the surface is turned inside out there is the last bit of a part.
Crossing turnedIf(bool turned, const Crossing& c) { return {c.t, turned ? c.part | 1 : c.part}; }

}  // namespace

Vec2 TracedProfileSweep::onCap(const Cap& cap, const Vec3& p) const {
  const Vec3 v = p - cap.center;
  return {dot(v, cap.x) / dot(cap.x, cap.x), dot(v, cap.y) / dot(cap.y, cap.y)};
}

bool TracedProfileSweep::hits(const Cap& cap, const Ray& ray, Crossing& at) const {
  at.t = dot(cap.center - ray.origin, cap.outward) / dot(ray.direction, cap.outward);
  if (!std::isfinite(at.t)) return false;
  const Vec2 place = onCap(cap, ray.at(at.t));
  if (!(std::isfinite(place.x) && std::isfinite(place.y))) return false;
  bool inside = false;
  const auto met = [&](const Crossing&) { inside = true; };
  const Real everywhere = kInfinity;
  section_->crossings({{place.x, place.y, -1}, {0, 0, 1}}, {-kInfinity, everywhere}, met);
  return inside;
}

void TracedProfileSweep::crossings(const Ray& ray, VisitCrossing visit) const {
  SmallList<Event, 16> list;
  const auto side = [&](const Crossing& c) {
    const Real away = outward_ * dot(sides_.place(ray, c).normal, ray.direction);
    list.add({{c.t, kCaps + 2 * c.part}, away < 0, TracedPatches::onEdge(c.part)});
  };
  sides_.crossings(ray, side);
  for (std::size_t i = 0; i < caps_.size(); ++i) {
    Crossing at{0, 2 * static_cast<std::int64_t>(i)};
    if (hits(caps_[i], ray, at)) list.add({at, dot(caps_[i].outward, ray.direction) < 0, false});
  }
  std::span<Event> events = list.all();
  if (!solid_) {
    for (const Event& event : events) visit(event.crossing);
    return;
  }
  std::sort(events.begin(), events.end(),
            [](const Event& a, const Event& b) { return a.crossing.before(b.crossing); });
  // A point on the common edge of patches may be hit in each.
  const auto same = [&](const Event& a, const Event& b) {
    if (!(a.onEdge && b.onEdge && a.entering == b.entering)) return false;
    const SurfacePoint p = surface(ray, a.crossing), q = surface(ray, b.crossing);
    return length(p.point - q.point) <= length(p.error + q.error);
  };
  std::size_t count = 0;
  for (const Event& event : events)
    if (count == 0 || !same(events[count - 1], event)) events[count++] = event;
  events = events.first(count);

  // Where the sweep passes through itself it is one body, and so is what a fold turns inside out: inside is
  // where it goes around a place at all. If that does not come out, as on a ray that touches an edge, entries
  // and exits simply take turns.
  int depth = 0;
  for (const Event& event : events) depth += event.entering ? 1 : -1;
  const bool counts = depth == 0;
  std::optional<Crossing> in;
  for (const Event& event : events) {
    const int before = depth;
    depth += event.entering ? 1 : -1;
    if (in && (counts ? depth == 0 : !event.entering)) {
      visit(*in);
      visit(turnedIf(event.entering, event.crossing));
      in.reset();
    } else if (!in && (counts ? before == 0 : event.entering)) {
      in = turnedIf(!event.entering, event.crossing);
    }
  }
}

SurfacePoint TracedProfileSweep::capSurface(const Cap& cap, const Ray& ray, const Crossing& crossing) const {
  Vec3 p = ray.at(crossing.t);
  p = p - cap.outward * dot(p - cap.center, cap.outward);
  const Vec2 place = onCap(cap, p);
  const Vec3 size = profileBox_.size();
  const auto share = [](Real at, Real low, Real width) {
    return width > 0 ? std::clamp((at - low) / width, 0.0, 1.0) : 0;
  };
  return {p,
          {cap.error, cap.error, cap.error},
          cap.outward,
          cap.outward,
          {share(place.x, profileBox_.low.x, size.x), share(place.y, profileBox_.low.y, size.y)}};
}

SurfacePoint TracedProfileSweep::surface(const Ray& ray, const Crossing& crossing) const {
  const bool insideOut = crossing.part % 2 != 0;
  if (crossing.part < kCaps) {
    SurfacePoint s = capSurface(caps_[static_cast<std::size_t>(crossing.part / 2)], ray, crossing);
    if (insideOut) s.normal = s.shading = -s.normal;
    return s;
  }
  const Crossing onSide{crossing.t, (crossing.part - kCaps) / 2};
  SurfacePoint s = sides_.place(ray, onSide);
  const bool away = solid_ ? (outward_ < 0) != insideOut : dot(s.normal, ray.direction) > 0;
  if (away) s.normal = s.shading = -s.normal;
  const std::size_t patch = TracedPatches::patchOf(onSide.part), column = patch % across_,
                    row = patch / across_;
  const Vec2 within = s.uv;
  s.uv = {(static_cast<Real>(column) + within.x) / static_cast<Real>(across_),
          (static_cast<Real>(row) + within.y) / static_cast<Real>(along_)};
  return s;
}

}  // namespace trace
