#include "geometry/shapes/solids/csg_tree.h"

#include <algorithm>

#include "base/error.h"

namespace trace {

// --- operands -----------------------------------------------------------------------------------------

Operands::Operands(std::vector<Operand> operands)
    : list_(std::make_shared<const std::vector<Operand>>(std::move(operands))) {}

const std::vector<Operand>& Operands::list() const {
  static const std::vector<Operand> kNone;
  return list_ ? *list_ : kNone;
}

bool Operands::operator==(const Operands& other) const {
  return list_ == other.list_ || list() == other.list();
}

// --- the whole ----------------------------------------------------------------------------------------

namespace {

void checkPlace(const Operand& operand) {
  if (!invertible(operand.wholeFromOperand))
    throw Error(Fault::scene, "an object of a solid is squeezed flat by its transform");
}

/// The state of the whole by its operands, one after the other.
class Whole {
 public:
  explicit Whole(CsgRule rule) : rule_(rule) {}

  /// The bounds are those in the whole.
  void add(const ShapeFacts& operand) {
    const bool mayBeOpen = !rule_.solid && count_ == 0;
    if (!operand.solid && !mayBeOpen)
      throw Error(Fault::scene, "an object of a solid is open: it encloses nothing",
                  "an open object can only be the first in a clip { }");
    if (count_ == 0)
      bounds_ = operand.bounds;
    else if (rule_.operation == CsgOperation::unite)
      bounds_.extend(operand.bounds);
    else if (rule_.operation == CsgOperation::intersect)
      bounds_ = {max(bounds_.low, operand.bounds.low), min(bounds_.high, operand.bounds.high)};
    mostParts_ = std::max(mostParts_, operand.partCount);
    ++count_;
  }

  ShapeFacts facts() const {
    constexpr std::int64_t kMostParts = std::int64_t{1} << 62;
    const std::int64_t count = std::max<std::int64_t>(count_, 1);
    if (mostParts_ > kMostParts / count)
      throw Error(Fault::scene, "solids are nested too deeply in unions, intersections or differences",
                  "put more solids into one union in place of unions in unions");
    return {rule_.solid, bounds_, mostParts_ * count};
  }

 private:
  CsgRule rule_;
  Box3 bounds_{};
  std::int64_t count_ = 0, mostParts_ = 1;
};

constexpr CsgRule kUnion{CsgOperation::unite}, kIntersection{CsgOperation::intersect},
    kDifference{CsgOperation::subtract}, kClip{CsgOperation::intersect, false};

ShapeFacts factsOf(CsgRule rule, const Operands& operands) {
  Whole whole(rule);
  for (const Operand& operand : operands.list()) {
    checkPlace(operand);
    ShapeFacts facts = check(operand.shape);
    facts.bounds = placedBounds(facts.bounds, operand.wholeFromOperand);
    whole.add(facts);
  }
  return whole.facts();
}

std::shared_ptr<const CsgTree> treeOf(CsgRule rule, const Operands& operands, const MeshTrees& made) {
  return std::make_shared<const CsgTree>(rule, operands.list(), made);
}

}  // namespace

std::shared_ptr<const CsgTree> Union::prepared(const MeshTrees& made) const {
  return treeOf(kUnion, objects, made);
}
ShapeFacts Union::checked() const { return factsOf(kUnion, objects); }
std::shared_ptr<const CsgTree> Intersection::prepared(const MeshTrees& made) const {
  return treeOf(kIntersection, objects, made);
}
ShapeFacts Intersection::checked() const { return factsOf(kIntersection, objects); }
std::shared_ptr<const CsgTree> Difference::prepared(const MeshTrees& made) const {
  return treeOf(kDifference, objects, made);
}
ShapeFacts Difference::checked() const { return factsOf(kDifference, objects); }
std::shared_ptr<const CsgTree> Clip::prepared(const MeshTrees& made) const {
  return treeOf(kClip, objects, made);
}
ShapeFacts Clip::checked() const { return factsOf(kClip, objects); }

// --- crossings ----------------------------------------------------------------------------------------

/// No member sets itself to zero, so that room for many costs nothing.
struct CsgTree::Event {
  Real t;
  std::int64_t part;  ///< already that of the whole
  std::uint32_t operand;
  bool entering;

  bool operator<(const Event& other) const {
    if (t != other.t) return t < other.t;
    return operand != other.operand ? operand < other.operand : part < other.part;
  }
};

/// How many of the operands the line is inside of, and whether that is inside of the whole. A clip's
/// first operand counts as everything: the others decide where its surface is kept.
class CsgTree::State {
 public:
  State(CsgRule rule, std::size_t operands)
      : operation_(rule.operation), operands_(operands), first_(rule.solid ? 0 : 1) {}

  void apply(const Event& event) {
    const std::size_t change = event.entering ? 1 : std::size_t(-1);
    (event.operand == 0 ? first_ : others_) += change;
  }
  bool inside() const {
    switch (operation_) {
      case CsgOperation::unite: return first_ + others_ > 0;
      case CsgOperation::intersect: return first_ + others_ == operands_;
      case CsgOperation::subtract: return first_ > 0 && others_ == 0;
    }
    return false;
  }

 private:
  CsgOperation operation_;
  std::size_t operands_, first_, others_ = 0;
};

CsgTree::CsgTree(CsgRule rule, const std::vector<Operand>& operands, const MeshTrees& made) : rule_(rule) {
  std::vector<Box3> boxes;
  Whole whole(rule);
  for (const Operand& operand : operands) {
    checkPlace(operand);
    operands_.emplace_back(operand.shape, operand.wholeFromOperand, made);
    whole.add(operands_.back().facts());
    materials_.push_back(operand.material);
    boxes.push_back(operands_.back().bounds());
  }
  const ShapeFacts facts = whole.facts();
  partCount_ = facts.partCount;
  bounds_ = facts.bounds;
  reach_ = bounds_.empty() || bounds_.unbounded() ? bounds_ : roomy(bounds_);
  near_ = std::ldexp(maxComponent(bounds_.size()), -20);
  tree_ = LineTree(std::move(boxes));
}

namespace {

/// In order: nearly always they are a few.
template <class Event>
void sortFew(std::span<Event> events) {
  constexpr std::size_t kFew = 16;
  if (events.size() > kFew) return std::sort(events.begin(), events.end());
  for (std::size_t i = 1; i < events.size(); ++i) {
    if (!(events[i] < events[i - 1])) continue;
    const Event event = events[i];
    std::size_t at = i;
    for (; at > 0 && event < events[at - 1]; --at) events[at] = events[at - 1];
    events[at] = event;
  }
}

}  // namespace

bool CsgTree::gather(const Ray& ray, const LineProbe& line, Real after, SmallList<Event, 16>& events) const {
  bool missed = false;
  tree_.query(ray, line, [&](std::uint32_t number) {
    const std::size_t before = events.size();
    const auto add = [&](const Crossing& c) {
      const auto count = static_cast<std::int64_t>(operands_.size());
      events.add({c.t, c.part * count + number, number, false});
    };
    operands_[number].crossings(ray, add);
    // Entry and exit take turns; a crossing too many, of a mesh that is not closed, leads nowhere.
    const std::span<Event> own = events.all().subspan(before);
    if (own.size() > 1) sortFew(own);
    for (std::size_t i = 0; i + 1 < own.size(); i += 2) own[i].entering = true;
    if (own.size() % 2 != 0 && operands_[number].solid()) own.back().t = kInfinity;
    return missed = needs(number) && (own.empty() || own.back().t <= after);
  });
  return !missed && events.size() > 0;
}

/// Do the crossings lie nearer together than their errors reach? `speed` is the length of the ray's
/// direction.
bool CsgTree::coincide(const Ray& ray, Real speed, const Event& a, const Event& b) const {
  const Real apart = b.t - a.t;
  if (a.operand == b.operand || !(apart * speed <= near_)) return false;
  const auto reach = [&](const Event& event) {
    const SurfacePoint s = operandSurface(ray, {event.t, event.part});
    return dot(abs(s.normal), s.error) / std::abs(dot(s.normal, ray.direction));
  };
  return apart <= reach(a) + reach(b);
}

void CsgTree::crossings(const Ray& ray, const Range& range, VisitCrossing visit) const {
  const LineProbe line(ray);
  if (!line.meets(reach_)) return;
  SmallList<Event, 16> list;
  if (!gather(ray, line, range.from, list)) return;
  const std::span<Event> events = list.all();
  sortFew(events);
  const Real speed = length(ray.direction);
  State state(rule_, operands_.size());
  const bool clips = !rule_.solid;
  bool after = state.inside();
  for (std::size_t i = 0; i < events.size();) {
    std::size_t end = i + 1;
    while (end < events.size() && coincide(ray, speed, events[end - 1], events[end])) ++end;
    const bool before = after;
    for (std::size_t k = i; k < end; ++k)
      if (!clips || events[k].operand != 0) state.apply(events[k]);
    after = state.inside();
    const Event* shown = nullptr;
    if (clips) {
      for (std::size_t k = i; k < end; ++k)
        if (events[k].operand == 0 && before && after) shown = &events[k];
    } else if (before != after) {
      for (std::size_t k = i; k < end; ++k) {
        const bool cutOut = rule_.operation == CsgOperation::subtract && events[k].operand > 0;
        if ((events[k].entering != cutOut) == after && (!shown || events[k].operand < shown->operand))
          shown = &events[k];
      }
    }
    if (shown) visit({events[i].t, shown->part});
    if (events[i].t > range.to) return;
    i = end;
  }
}

SurfacePoint CsgTree::operandSurface(const Ray& ray, const Crossing& crossing) const {
  const auto count = static_cast<std::int64_t>(operands_.size());
  return operands_[static_cast<std::size_t>(crossing.part % count)].surface(
      ray, {crossing.t, crossing.part / count});
}

SurfacePoint CsgTree::surface(const Ray& ray, const Crossing& crossing) const {
  SurfacePoint s = operandSurface(ray, crossing);
  const bool first = crossing.part % static_cast<std::int64_t>(operands_.size()) == 0;
  const bool away =
      solid() ? rule_.operation == CsgOperation::subtract && !first : dot(s.normal, ray.direction) > 0;
  if (away) {
    s.normal = -s.normal;
    s.shading = -s.shading;
  }
  return s;
}

MaterialMix CsgTree::material(std::int64_t part, std::uint32_t) const {
  const auto count = static_cast<std::int64_t>(operands_.size());
  const auto operand = static_cast<std::size_t>(part % count);
  return operands_[operand].shape().material(part / count, materials_[operand]);
}

MaterialMix CsgTree::inside(std::int64_t part, std::uint32_t) const {
  const auto count = static_cast<std::int64_t>(operands_.size());
  const std::int64_t owner = part % count;
  const std::int64_t operand = rule_.operation == CsgOperation::unite ? owner : 0;
  const auto filling = static_cast<std::size_t>(operand);
  return operands_[filling].shape().inside(operand == owner ? part / count : 0, materials_[filling]);
}

void CsgTree::addMaterials(std::vector<std::uint32_t>& materials) const {
  for (std::size_t i = 0; i < operands_.size(); ++i) {
    materials.push_back(materials_[i]);
    operands_[i].shape().addMaterials(materials);
  }
}

void CsgTree::addMeshTrees(MeshTrees& trees) const {
  for (const Placed& operand : operands_) {
    operand.shape().addMeshTrees(trees);
    if (operand.meshTree()) trees[operand.shape().mesh().get()] = operand.meshTree();
  }
}

}  // namespace trace
