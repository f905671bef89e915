// How chains change a path place by place: the mutations of Veach and Guibas (1997, section 5; Veach 1997,
// section 11.4).
//
// A path x becomes y with the density T(x -> y). The move is made with the probability
//
//   a = min(1, R),  R = f(y) T(y -> x) / (f(x) T(x -> y))
//
// so that the chain is at a path as often as that is bright. Each mutation works out R.
#pragma once

#include "math/low_discrepancy.h"
#include "render/chains/path.h"
#include "render/samples/sampler.h"
#include "render/world/move_kind.h"

namespace trace::veach {

/// Numbers from 0 up to 1, one after the other.
class Numbers final : public SampleNumbers {
 public:
  explicit Numbers(std::uint64_t seed) : state_(seed), scrambling_(seed) {}
  /// Those of one of many samples, whose first numbers are spread evenly, and the others at random.
  Numbers(std::uint64_t seed, std::uint32_t sample)
      : state_(mixBits(seed ^ mixBits(sample))), scrambling_(seed), sample_(sample), even_(kEven) {}
  Real next();
  Vec2 next2();
  Vec2 pair(std::uint64_t) override { return next2(); }

 private:
  static constexpr std::uint32_t kEven = 2;  ///< the moment or the place of the film, the lens
  Vec2 evenPair() { return sobolPoint(sample_, mixBits(scrambling_ ^ mixBits(even_--))); }

  std::uint64_t state_, scrambling_;
  std::uint32_t sample_ = 0, even_ = 0;  ///< even_: how many are still spread evenly
};

/// A path that is offered, and R. One of brightness 0 is none.
struct Offer {
  Path path{};
  Real ratio = 0;
};

/// Which places a bidirectional mutation leaves: so many at the lens and at the light.
struct Kept {
  std::size_t atLens = 0, atLight = 0;
};

class Moves {
 public:
  /// `size`: of perturbations, as a part of what there is to choose from.
  Moves(const Paths& paths, const SampleRules& rules, Numbers& numbers, Real size)
      : paths_(paths), stage_(paths.stage), numbers_(numbers), lobes_(rules, numbers), farthest_(10 * size) {}

  /// A path made from nothing.
  Path anywhere();
  /// Its density.
  Real anywhereDensity(Path& path) const;

  /// Follows one path from the camera, and at each of its places looks for emitters and asks for it: how
  /// bright the picture is by all of these, weighed by the balance heuristic beside anywhere(). Together with
  /// anywhereShare() of such a path the mean is the brightness of the picture.
  Real fromCamera();
  Real anywhereShare(Path& path) const;

  /// Takes out some places in a row, and puts in others, from both ends of the gap (Veach 1997, 11.4.2.1).
  Offer bidirectional(Path& from);
  /// The density with which the mutation that keeps these places makes such a path of one of so many places.
  Real density(Path& path, const Kept& kept, std::size_t placesBefore) const;

  /// Perturbations keep by which rays a path continues. They move a part of it a little and join it again,
  /// and know where they can. Moved is the place of the film, behind which the path goes by mirrors and glass
  /// to the first place that it may join (11.4.3.1);
  bool hasLens(const Path& path) const;
  Offer lens(const Path& from);
  /// the direction from which mirrors or glass send light to the place that the camera sees (11.4.3.2);
  bool hasCaustic(const Path& path) const;
  Offer caustic(Path& from);
  /// the place of the film, and directions of all places behind it from where mirrors or glass lead on
  /// (11.4.3.3).
  bool hasMultiChain(const Path& path) const;
  Offer multiChain(const Path& from);

 private:
  struct Walk;
  Kept choose(std::size_t places);
  Real chance(const Kept& kept, std::size_t places) const;
  struct Lengths;
  Lengths lengths(const Kept& kept, std::size_t before) const;
  bool build(Path& path, Path& from, const Kept& kept, std::size_t places);
  bool walkFromEye(Path& path, std::size_t places, bool toEnd);
  bool step(Path& path);
  Vec2 onFilm(const Vec2& u) const;
  Real cameraDensity(const Path& path) const;
  bool askEnd(Path& path);
  bool walkFromLight(Walk& walk, Path& from, const Kept& kept, std::size_t places);
  bool goOn(Walk& walk, const Vertex& from, RayKind& leaves);
  bool join(Path& path, const Walk& walk, const Path& from, const Kept& kept);

  Offer fromFilm(const Path& from, std::size_t joint);
  Real shortWay();
  Vec2 moved(const Vec2& film);
  Vec3 moved(const Vec3& direction);

  const Paths& paths_;
  const Stage& stage_;
  Numbers& numbers_;
  Sampler lobes_;
  Real farthest_;  ///< way of a perturbation: of the film's side, or radians
};

}  // namespace trace::veach
