// Which of many parts a ray's whole line may hit, also behind its origin: what parity, unions and sums need.
#pragma once

#include <cstdint>
#include <span>
#include <type_traits>
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
    if (!reach_.empty()) reach_ = roomy(reach_);
    bvh_ = Bvh(boxes);
  }

  /// Calls visit(number) for each box that the line of the ray may hit; ends where it returns true, if it
  /// returns anything.
  template <class Visit>
  void query(const Ray& ray, Visit&& visit) const {
    query(ray, LineProbe(ray), visit);
  }
  template <class Visit>
  void query(const Ray& ray, const LineProbe& line, Visit&& visit) const {
    const auto ends = [&](std::uint32_t number) {
      if constexpr (std::is_void_v<decltype(visit(number))>)
        return visit(number), false;
      else
        return visit(number);
    };
    for (const Alone& part : alone_) {
      checkBudget();
      if (line.meets(part.box) && ends(part.number)) return;
    }
    if (reach_.empty()) return;
    const Span span = spanIn(reach_, ray);
    if (span.empty()) return;
    // The hierarchy looks ahead only: it is asked from a place before everything.
    const Real back = span.from - 0.5 * (span.to - span.from);
    NodeCount visited;
    bvh_.query(ray.at(back), ray.direction, kInfinity, false, visited, [&](std::uint32_t number) {
      checkBudget();
      return ends(number);
    });
  }

 private:
  struct Alone {
    Box3 box;
    std::uint32_t number;
  };
  std::vector<Alone> alone_;  ///< tested one by one
  Box3 reach_;                ///< reach of all others, with room left
  Bvh bvh_;
};

}  // namespace trace
