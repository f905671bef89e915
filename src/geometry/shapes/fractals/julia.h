// Julia and Mandelbrot sets of four-dimensional numbers, cut by a hyperplane (Norton 1982; Hart, Sandin and
// Kauffman, Ray Tracing Deterministic 3-D Fractals, 1989): the points that stay within a radius under a
// number of repetitions of q -> f(q) + c.
//
// No estimates of distance: the ray is parted into stretches that surely escape, surely stay, or along which
// the last number surely only nears or only leaves the limit (julia_kernel.h). So no detail is missed that is
// thicker than some 4e-9 of the set.
//
// Under a sine or an exponential a point may come back from anywhere. There the set is of the points whose
// imaginary part, or real part, stays below a limit, within a ball.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>

#include "base/field.h"
#include "geometry/materials.h"
#include "geometry/shapes/fractals/julia_set.h"
#include "geometry/shapes/fractals/orbit_trap.h"
#include "math/along.h"

namespace trace {

class TracedJulia;

struct Julia {
  static constexpr std::string_view kKeyword = "julia";
  static constexpr std::string_view kHelp =
      "Julia or Mandelbrot set of four-dimensional numbers, cut by a hyperplane";

  std::array<Real, 4> constant{-0.2, 0.8, 0, 0}, normal{0, 0, 0, 1};
  Real offset = 0;
  int iterations = 10;
  Iteration iteration = Iteration::square;
  bool mandelbrot = false;
  Trap trap = Trap::none;
  MaterialList materials;

  static constexpr auto fields() {
    return Fields{
        Field{"constant", &Julia::constant, "", -2, 2, "c: one number for each dimension"},
        Field{"normal", &Julia::normal, "", -1, 1, "normal of the hyperplane, of any length"},
        Field{"offset", &Julia::offset, "", -2, 2,
              "distance of the hyperplane from the origin, along its normal"},
        Field{"iterations", &Julia::iterations, "", 1, 50, "number of iterations; more show more detail"},
        Field{"iteration", &Julia::iteration, "", 0, 0, "the step: f in q -> f(q) + c"},
        Field{"mandelbrot", &Julia::mandelbrot, "", 0, 1, "c is the point itself, plus `constant`"},
        Field{"trap", &Julia::trap, "", 0, 0, "the meaning of the texture coordinates"},
        Field{"materials", &Julia::materials, "", 0, 0,
              "materials in the order of the trap's least distance"}};
  }
  bool operator==(const Julia&) const = default;

  /// Repetitions that a number can follow. The last number goes with the power 2^n or 3^n of the first, which
  /// is off by a unit in its last place or so: 3^36 makes e^17 of that, 3^38 more than any number holds.
  int mostIterations() const { return iteration == Iteration::cube ? 36 : JuliaSet::kMostIterations; }
  /// Values may each be in their range, but too much together: then it says what is used in their place.
  std::string excess() const;

  std::shared_ptr<const TracedJulia> prepared() const;
};

class TracedJulia {
 public:
  explicit TracedJulia(const Julia& shape, const JuliaKernel& kernel = juliaKernels().front());

  bool solid() const { return true; }
  static constexpr std::int64_t partCount() { return TrapPart::kCount; }
  MaterialMix material(std::int64_t part, std::uint32_t own) const {
    return shape_.materials.empty() ? MaterialMix::only(own) : shape_.materials.at(TrapPart::level(part));
  }
  void addMaterials(std::vector<std::uint32_t>& to) const { shape_.materials.addTo(to); }
  Box3 bounds() const { return {{-reach_, -reach_, -reach_}, {reach_, reach_, reach_}}; }
  void crossings(const Ray& ray, const Range& range, VisitCrossing visit) const;
  SurfacePoint surface(const Ray& ray, const Crossing& crossing) const;

 private:
  using Number = std::array<Real, 4>;
  static constexpr Real kReach = 2.5, kEscaped = 4;  ///< kEscaped: from here on powers only grow
  static constexpr Real kPowerStep = 0x1p-28;  ///< least step of the search for powers, in sizes of the set

  Number lift(const Vec3& p) const;
  Number step(const Number& q) const;
  /// The change of step(q) with q.
  Number stepSlope(const Number& q, const Number& change) const;
  /// Is the step a power? A point that has escaped from it never comes back.
  bool power() const { return shape_.iteration < Iteration::sine; }
  /// The part of a number that is compared with the limit, and how it changes with the number.
  Real escape(const Number& q) const;
  Real escapeSlope(const Number& q, const Number& change) const;
  /// How many times farther apart the step takes numbers within r of q, at most.
  Real stretch(const Number& q, Real r) const;
  /// How far apart a function takes the numbers of places, for one unit between the places: at most, within r
  /// of q.
  Real grown(Real growth, const Number& q, Real r) const {
    return growth * stretch(q, r) + (shape_.mandelbrot ? 1 : 0);
  }
  /// Some steps of the search, in sizes of kReach: what is finer is not told apart.
  Real detail() const { return power() ? 16 * kPowerStep : 0x1p-11; }
  /// From here on the numbers of neighbours in the search have nothing in common: what follows is dust, of
  /// which each ray would hit other grains (solve/escape_search.h). The number before counts as the last.
  Real mostGrowth() const { return kEscaped / (kReach * detail()); }
  bool isBlurred(Real growth, int i) const { return i >= JuliaSet::kSurely && growth > mostGrowth(); }
  Vec2 trapUv(const Vec3& p) const;
  /// value() and the sign over a ball where the step is no power.
  Jet functionValue(const Vec3& p, const Vec3& direction) const;
  Interval functionSigns(const Vec3& center, Real radius) const;
  /// Negative inside; the slope is along the direction.
  Jet value(const Vec3& p, const Vec3& direction) const;
  void findLimits();
  /// The value where the step is a power.
  template <Iteration kIteration>
  Jet powerValue(const Vec3& p, const Vec3& direction) const;

  Julia shape_;
  std::array<Number, 3> axes_{};  ///< axes of the hyperplane
  Number shift_{};
  JuliaSet set_{};  ///< set of the powers
  JuliaKernel::Look look_ = nullptr;
  Real reach_ = 0;  ///< the set lies within
};

}  // namespace trace
