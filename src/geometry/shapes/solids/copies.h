// Solids of copies of copies: iterated function systems (Hutchinson 1981; Barnsley, Fractals Everywhere,
// 1988). A seed is replaced by its copies under each map, these again, to a given level: exactly that union.
//
// The recursion itself is the hierarchy: the ray is brought into the space of each copy, where the box of the
// whole stands for all that is in it. Stretches of the line inside seeds that overlap or touch are one.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "base/field.h"
#include "base/small_list.h"
#include "geometry/ray.h"
#include "math/transform.h"

namespace trace {

class TracedCopies;

/// The seed: the shape at the last level.
enum class Seed {
  cube,         ///< from -0.5 to 0.5 in x, y and z
  ball,         ///< ball of radius 0.5
  tetrahedron,  ///< on four corners of the cube
};
constexpr std::array<std::string_view, 3> names(Seed) { return {"cube", "ball", "tetrahedron"}; }

struct Sierpinski {
  static constexpr std::string_view kKeyword = "sierpinski";
  static constexpr std::string_view kHelp =
      "Sierpinski tetrahedron, on four corners of a cube from -0.5 to 0.5";
  static constexpr int kMostLevels = 16;

  int levels = 4;

  static constexpr auto fields() {
    return Fields{
        Field{"levels", &Sierpinski::levels, "", 0, kMostLevels, "number of levels; 0 is a tetrahedron"}};
  }
  bool operator==(const Sierpinski&) const = default;

  std::shared_ptr<const TracedCopies> prepared() const;
};

struct Ifs {
  static constexpr std::string_view kKeyword = "ifs";
  static constexpr std::string_view kHelp =
      "copies of copies of a seed under affine maps: an iterated function system";

  /// Rows of the linear part and the shift: x' = a x + b y + c z + d, and so on.
  using Map = std::array<Real, 12>;
  std::vector<Map> maps{{0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 0.5, 0.25},
                        {0.5, 0, 0, 0.3, 0, 0.5, 0, 0, 0, 0, 0.5, -0.25},
                        {0.5, 0, 0, -0.3, 0, 0.5, 0, 0.1, 0, 0, 0.5, -0.25}};
  Seed seed = Seed::cube;
  int levels = 4;

  static constexpr auto fields() {
    return Fields{
        Field{
            "maps", &Ifs::maps, "", -kNoLimit, kNoLimit,
            "list of (a, b, c, d, e, f, g, h, i, j, k, l): x' = a x + b y + c z + d, and so on; all shrink"},
        Field{"seed", &Ifs::seed, "", 0, 0, "the shape at the last level"},
        Field{"levels", &Ifs::levels, "", 0, 30, "number of levels, up to a million million copies"}};
  }
  bool operator==(const Ifs&) const = default;

  /// Throws Error if a map does not shrink, or cannot be undone.
  std::shared_ptr<const TracedCopies> prepared() const;
};

class TracedCopies {
 public:
  /// Precondition: each map shrinks, and can be undone.
  TracedCopies(std::vector<Affine> maps, Seed seed, int levels);

  bool solid() const { return true; }
  Box3 bounds() const { return bounds_; }
  void crossings(const Ray& ray, const Range& range, VisitCrossing visit) const;
  SurfacePoint surface(const Ray& ray, const Crossing& crossing) const;
  std::int64_t partCount() const { return leaves_ * kFaces; }

 private:
  static constexpr std::int64_t kFaces = 6;  ///< faces of a seed; a part is a face of a leaf
  /// A stretch of the line inside a seed.
  struct Stretch {
    Crossing in, out;
  };
  /// If a ray crosses very many copies, the stretches are joined before all are found: a union of millions
  /// of overlapping seeds takes no more memory, and no longer, than what is left of it.
  struct Merging {
    static constexpr std::size_t kFirst = 4096;
    std::size_t next = kFirst;  ///< how many have to be found
    bool begun = false;
  };
  static std::size_t joined(std::span<Stretch> all);
  void descend(const Ray& ray, int level, std::int64_t leaf, const Range& range, Merging& merging,
               SmallList<Stretch, 16>& found) const;
  bool meetSeed(const Ray& ray, Stretch& stretch) const;

  std::vector<Affine> maps_, back_;
  Seed seed_;
  int levels_;
  std::int64_t leaves_ = 1;
  std::vector<Box3> boxes_;  ///< boxes of the copies of each number of levels
  Box3 reach_, bounds_;      ///< reach_: holds every level; bounds_: the last
  Real error_ = 0;
};

}  // namespace trace
