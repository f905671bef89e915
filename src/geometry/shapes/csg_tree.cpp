#include "geometry/shapes/csg_tree.h"

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

/// What follows for the whole from its operands, one after the other.
class Whole {
 public:
  explicit Whole(CsgOperation operation) : operation_(operation) {}

  /// The bounds are those in the whole.
  void add(const ShapeFacts& operand) {
    const bool mayBeOpen = operation_ == CsgOperation::clip && count_ == 0;
    if (!operand.solid && !mayBeOpen)
      throw Error(Fault::scene, "an object of a solid is open: it encloses nothing",
                  "an open object can only be the first in a clip { }");
    if (count_ == 0)
      bounds_ = operand.bounds;
    else if (operation_ == CsgOperation::unite)
      bounds_.extend(operand.bounds);
    else if (operation_ != CsgOperation::subtract)
      bounds_.low = max(bounds_.low, operand.bounds.low),
      bounds_.high = min(bounds_.high, operand.bounds.high);
    mostParts_ = std::max(mostParts_, operand.partCount);
    ++count_;
  }

  ShapeFacts facts() const {
    constexpr std::int64_t kMostParts = std::int64_t{1} << 62;
    const std::int64_t count = std::max<std::int64_t>(count_, 1);
    if (mostParts_ > kMostParts / count)
      throw Error(Fault::scene, "solids are nested too deeply in unions, intersections or differences",
                  "put more solids into one union in place of unions in unions");
    return {operation_ != CsgOperation::clip, bounds_, mostParts_ * count};
  }

 private:
  CsgOperation operation_;
  Box3 bounds_{};
  std::int64_t count_ = 0, mostParts_ = 1;
};

ShapeFacts factsOf(CsgOperation operation, const Operands& operands) {
  Whole whole(operation);
  for (const Operand& operand : operands.list()) {
    checkPlace(operand);
    ShapeFacts facts = check(operand.shape);
    facts.bounds = placedBounds(facts.bounds, operand.wholeFromOperand);
    whole.add(facts);
  }
  return whole.facts();
}

std::shared_ptr<const CsgTree> treeOf(CsgOperation operation, const Operands& operands,
                                      const MeshTrees& made) {
  return std::make_shared<const CsgTree>(operation, operands.list(), made);
}

}  // namespace

std::shared_ptr<const CsgTree> Union::prepared(const MeshTrees& made) const {
  return treeOf(CsgOperation::unite, objects, made);
}
ShapeFacts Union::checked() const { return factsOf(CsgOperation::unite, objects); }
std::shared_ptr<const CsgTree> Intersection::prepared(const MeshTrees& made) const {
  return treeOf(CsgOperation::intersect, objects, made);
}
ShapeFacts Intersection::checked() const { return factsOf(CsgOperation::intersect, objects); }
std::shared_ptr<const CsgTree> Difference::prepared(const MeshTrees& made) const {
  return treeOf(CsgOperation::subtract, objects, made);
}
ShapeFacts Difference::checked() const { return factsOf(CsgOperation::subtract, objects); }
std::shared_ptr<const CsgTree> Clip::prepared(const MeshTrees& made) const {
  return treeOf(CsgOperation::clip, objects, made);
}
ShapeFacts Clip::checked() const { return factsOf(CsgOperation::clip, objects); }

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

/// How many of the operands the line is inside of, and whether that is inside of the whole.
class CsgTree::State {
 public:
  State(CsgOperation operation, std::size_t operands) : operation_(operation), operands_(operands) {}

  void apply(const Event& event) {
    const std::size_t change = event.entering ? 1 : std::size_t(-1);
    (event.operand == 0 ? first_ : others_) += change;
  }
  bool inside() const {
    switch (operation_) {
      case CsgOperation::unite: return first_ + others_ > 0;
      case CsgOperation::intersect: return first_ + others_ == operands_;
      case CsgOperation::subtract: return first_ > 0 && others_ == 0;
      case CsgOperation::clip: return others_ + 1 == operands_;  // of what clips
    }
    return false;
  }

 private:
  CsgOperation operation_;
  std::size_t operands_, first_ = 0, others_ = 0;
};

CsgTree::CsgTree(CsgOperation operation, const std::vector<Operand>& operands, const MeshTrees& made)
    : operation_(operation) {
  std::vector<Box3> boxes;
  Whole whole(operation);
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
  near_ = std::ldexp(maxComponent(bounds_.size()), -20);
  tree_ = LineTree(std::move(boxes));
}

void CsgTree::gather(const Ray& ray, SmallList<Event, 16>& events) const {
  tree_.query(ray, [&](std::uint32_t number) {
    const std::size_t before = events.size();
    const auto add = [&](const Crossing& c) {
      const auto count = static_cast<std::int64_t>(operands_.size());
      events.add({c.t, c.part * count + number, number, false});
    };
    operands_[number].crossings(ray, add);
    // Entry and exit take turns; a crossing too many, of a mesh that is not closed, leads nowhere.
    const std::span<Event> own = events.all().subspan(before);
    std::sort(own.begin(), own.end());
    for (std::size_t i = 0; i + 1 < own.size(); i += 2) own[i].entering = true;
    if (own.size() % 2 != 0 && operands_[number].solid()) own.back().t = kInfinity;
  });
}

/// Do the crossings lie nearer together than their errors reach?
bool CsgTree::coincide(const Ray& ray, const Event& a, const Event& b) const {
  const Real apart = b.t - a.t;
  if (a.operand == b.operand || !(apart * length(ray.direction) <= near_)) return false;
  const auto reach = [&](const Event& event) {
    const SurfacePoint s = operandSurface(ray, {event.t, event.part});
    return dot(abs(s.normal), s.error) / std::abs(dot(s.normal, ray.direction));
  };
  return apart <= reach(a) + reach(b);
}

void CsgTree::crossings(const Ray& ray, VisitCrossing visit) const {
  SmallList<Event, 16> list;
  gather(ray, list);
  const std::span<Event> events = list.all();
  std::sort(events.begin(), events.end());
  State state(operation_, operands_.size());
  const bool clips = operation_ == CsgOperation::clip;
  for (std::size_t i = 0; i < events.size();) {
    std::size_t end = i + 1;
    while (end < events.size() && coincide(ray, events[end - 1], events[end])) ++end;
    const bool before = state.inside();
    for (std::size_t k = i; k < end; ++k)
      if (!clips || events[k].operand != 0) state.apply(events[k]);
    const bool after = state.inside();
    const Event* shown = nullptr;
    if (clips) {
      for (std::size_t k = i; k < end; ++k)
        if (events[k].operand == 0 && before && after) shown = &events[k];
    } else if (before != after) {
      for (std::size_t k = i; k < end; ++k) {
        const bool cutOut = operation_ == CsgOperation::subtract && events[k].operand > 0;
        if ((events[k].entering != cutOut) == after && (!shown || events[k].operand < shown->operand))
          shown = &events[k];
      }
    }
    if (shown) visit({events[i].t, shown->part});
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
      solid() ? operation_ == CsgOperation::subtract && !first : dot(s.normal, ray.direction) > 0;
  if (away) s.normal = -s.normal, s.shading = -s.shading;
  return s;
}

MaterialMix CsgTree::material(std::int64_t part, std::uint32_t) const {
  const auto count = static_cast<std::int64_t>(operands_.size());
  const auto operand = static_cast<std::size_t>(part % count);
  return operands_[operand].shape().material(part / count, materials_[operand]);
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
