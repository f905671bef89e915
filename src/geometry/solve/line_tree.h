// Which of many parts a ray's whole line may hit, also behind its origin: what parity, unions and sums need.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "accel/bvh.h"
#include "base/budget.h"
#include "geometry/solve/span.h"

namespace trace {

class LineTree {
 public:
  LineTree() = default;
  explicit LineTree(std::vector<Box3> boxes) {
    constexpr std::size_t kFew = 4;  // are not worth a hierarchy
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
      const bool endless = !isFinite(boxes[i].low) || !isFinite(boxes[i].high);
      if (boxes.size() <= kFew || endless) {
        alone_.push_back({endless ? boxes[i] : roomy(boxes[i]), i});
        boxes[i] = {};
      } else {
        reach_.extend(boxes[i]);
      }
    }
    bvh_ = Bvh(boxes);
  }

  /// Calls visit(number) for each box that the line of the ray may hit.
  template <class Visit>
  void query(const Ray& ray, Visit&& visit) const {
    for (const Alone& part : alone_) {
      checkBudget();
      if (!spanIn(part.box, ray).empty()) visit(part.number);
    }
    if (reach_.empty()) return;
    const Span span = spanIn(roomy(reach_), ray);
    if (span.empty()) return;
    // The hierarchy looks ahead only: it is asked from a place before everything.
    const Real back = span.from - 0.5 * (span.to - span.from);
    NodeCount visited;
    bvh_.query(ray.at(back), ray.direction, kInfinity, false, visited, [&](std::uint32_t number) {
      checkBudget();
      visit(number);
      return false;
    });
  }

 private:
  struct Alone {
    Box3 box;
    std::uint32_t number;
  };
  std::vector<Alone> alone_;  ///< tested one by one
  Box3 reach_;                ///< reach of all others
  Bvh bvh_;
};

}  // namespace trace
