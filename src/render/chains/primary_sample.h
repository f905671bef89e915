// The numbers of a sample as a point of the unit cube, which a Markov chain moves: primary sample space
// (Kelemen et al. 2002; the bookkeeping as in Pharr, Jakob and Humphreys, Physically Based Rendering, 2016,
// section 16.4.4). A number exists from when it is asked for, and takes then what it missed.
#pragma once

#include <cstdint>
#include <vector>

#include "math/vec.h"
#include "render/samples/sampler.h"

namespace trace {

/// The numbers at a place of the cube that `start` chooses, which is left nowhere.
class StartSample final : public SampleNumbers {
 public:
  explicit StartSample(std::uint64_t start) : start_(start) {}
  Vec2 pair(std::uint64_t branch) override;

 private:
  std::uint64_t start_;
};

class PrimarySample final : public SampleNumbers {
 public:
  /// At a place of the cube that `start` chooses; `moves` chooses the moves. A small move of a number is
  /// spread normally with the standard deviation `size`.
  PrimarySample(std::uint64_t start, std::uint64_t moves, Real size)
      : first_(start), moves_(moves), size_(size) {}

  /// A new place for all numbers, anywhere; or one nearby. Until keep() or undo() it is an offer.
  void moveAnywhere() { offer(true); }
  void moveNearby() { offer(false); }
  /// The chain is at the new place, or where it was.
  void keep();
  void undo();

  Vec2 pair(std::uint64_t branch) override;

 private:
  struct Pair {
    std::uint64_t branch;
    Vec2 now, before{};
    std::int64_t moved = 0, movedBefore = 0;  ///< the step of the last change
  };
  void offer(bool anywhere);
  std::uint64_t bits(std::uint64_t branch, std::int64_t step) const;

  /// The pair of the branch, until the next is asked for.
  Pair& of(std::uint64_t branch);
  std::size_t slotOf(std::uint64_t branch) const;
  void grow();

  StartSample first_;
  std::uint64_t moves_;
  Real size_;
  std::vector<Pair> pairs_;           ///< in the order in which they were asked for
  std::vector<std::uint32_t> slots_;  ///< a hash table of their places, each + 1, by branch; 0: free
  std::vector<std::size_t> offered_;  ///< places of those that differ from before the offer
  std::int64_t step_ = 0;             ///< moves that were kept, and the one that is offered
  std::int64_t anywhere_ = 0;         ///< the last step that moved all numbers
  std::int64_t offers_ = 0;
  bool offersAnywhere_ = false;
};

}  // namespace trace
