// The functions of a POV-Ray scene: formulas that are evaluated with numbers, or become the formula of an
// isosurface or a texture. Source: the POV-Ray 3.7 reference, section 2.2.1.6.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/pov/pov_values.h"

namespace trace::pov {

/// A function of numbers by its name: sin, pow, ...; nothing if there is none of that name.
struct NumberFunction {
  std::string_view name;
  int arguments;                                           ///< at least; -1: any number from one on
  std::optional<Real> (*value)(const Real* a, int count);  ///< nothing outside of its domain
};
const NumberFunction* findNumberFunction(std::string_view name);

struct Formula {
  struct Step {
    enum class Kind : std::uint8_t { number, parameter, operation, call, user, spline };
    Kind kind = Kind::number;
    Real number = 0;
    int index = 0;         ///< number of a parameter
    char operation = '+';  ///< + - * / n for negation < > = and so on
    const NumberFunction* function = nullptr;
    Ref<Formula> user{};
    std::vector<int> inputs{};  ///< earlier steps
  };
  using Part = int;  ///< number of a step

  std::vector<std::string> parameters;
  std::vector<Step> steps;   ///< the last is the value
  Ref<PigmentNode> pigment;  ///< a function of a pigment
  int internal = -1;         ///< number of a function that POV-Ray has built in
  std::shared_ptr<SplineCurve> spline;
  std::optional<Affine> transform;

  /// Nothing where it has no value, or where it cannot be evaluated.
  std::optional<Real> at(const Real* arguments, int count, int depth = 0) const;

  /// The pigment whose colours it is made of, if there is one and it alone.
  Ref<PigmentNode> onlyPigment() const;
  /// Its value where that pigment has the colour.
  Real ofColor(const Numbers& c) const;

  /// As a formula of Trace in x, y, z, with those texts in place of the parameters; nothing where it uses
  /// more than Trace's formulas know.
  std::optional<std::string> text(const std::vector<std::string>& arguments, int depth = 0) const;
};

/// Random numbers as POV-Ray's rand() makes them, from 0 to 1.
Real nextRandom(std::uint64_t& seed);

/// Smooth noise from 0 to 1.
Real noiseAt(const Vec3& p);
/// Three of them, about 0.
Vec3 noiseVectorAt(const Vec3& p);

}  // namespace trace::pov
