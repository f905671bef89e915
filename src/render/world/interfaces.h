// The dielectric stack of a ray, as far as refraction and absorption ask.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "math/color.h"
#include "math/vec.h"
#include "shading/optics/dispersion.h"

namespace trace {

/// The interior of an object, or the air around all objects.
struct Filling {
  static constexpr std::uint32_t kAir = std::numeric_limits<std::uint32_t>::max();

  std::uint32_t object = kAir;  ///< index into Scene::objects
  Real priority = 0;
  Real index = 1;   ///< index of refraction, at the line d
  Color passes{1};  ///< the transmittance along a unit of length: Beer's law
  Dispersion dispersion{};
  /// Bodies of one kind are of the same material, its name and priority aside.
  std::uint32_t kind = kAir;

  Real indexAt(Real nanometres) const { return dispersion.index(index, nanometres); }
};

/// On the ray's side of a surface, and on the other.
struct Sides {
  Filling before, behind;
  /// The surface is none for light: both sides are the same body, or of one kind.
  bool alike() const { return before.object == behind.object || before.kind == behind.kind; }
};

/// Indices of refraction at a surface: on the ray's side and on the other. What they belong to is known where
/// bodies may be nested.
struct Indices {
  Real before = 1, behind = 1;
  bool nested = false;
  std::uint32_t objectBefore = Filling::kAir, objectBehind = Filling::kAir;
  Real priorityBefore = 0, priorityBehind = 0;

  Indices() = default;
  Indices(const Sides& sides, Real nanometres, bool nestedGlass)
      : before(sides.before.indexAt(nanometres)),
        behind(sides.behind.indexAt(nanometres)),
        nested(nestedGlass),
        objectBefore(sides.before.object),
        objectBehind(sides.behind.object),
        priorityBefore(sides.before.priority),
        priorityBehind(sides.behind.priority) {}
};

/// A part of a path's state: the glass objects that the ray is in, in the order in which it entered them.
///
/// The one of the highest priority fills the place; of equals it is the one entered last (Schmidt and Budge,
/// Simple Nested Dielectrics in Ray Traced Images, 2002). Surfaces at which that does not change are no
/// surfaces for light. Open sheets enclose nothing and change nothing.
///
/// Without nested glass the list is never longer than one, which is the rule of the courses: a ray that
/// leaves a body comes from its inside and goes into the air; any other comes from the air.
class Interfaces {
 public:
  explicit Interfaces(Real air = 1, bool nested = false) : nested_(nested) { air_ = around_.index = air; }

  bool nested() const { return nested_; }
  /// The medium that the ray is in.
  const Filling& around() const { return around_; }
  /// The transmittance along that distance: Beer's law.
  Color passed(Real t) const { return around_.passes == Color(1) ? Color(1) : pow(around_.passes, t); }
  /// The wavelength of the light, in nanometres; 0 for light of all colours.
  Real wavelength = 0;

  /// The two sides of the surface of a body, which the ray leaves or enters. `encloses`: the body is solid.
  Sides at(bool leaving, const Filling& body, bool encloses) const;
  /// The medium of the ray behind that surface.
  void pass(bool leaving, const Filling& body, bool encloses);
  /// The ray starts inside the body. Outer bodies come before inner ones.
  void startInside(const Filling& body) { pass(false, body, true); }

 private:
  Filling air() const;
  /// The body that fills the place, leaving out one number, which may be beyond them.
  Filling winner(std::size_t without) const;
  /// The number of the body in the list; its size if it is not there.
  std::size_t find(const Filling& body) const;

  Real air_ = 1;
  bool nested_;
  Filling around_;
  std::vector<Filling> bodies_;  ///< only with nested glass
};

}  // namespace trace
