#include "geometry/shapes/fractals/plant.h"

#include <array>

#include "base/budget.h"
#include "base/error.h"
#include "math/elementary.h"
#include "math/noise.h"
#include "math/transform.h"

namespace trace {
namespace {

/// Numbers that look random, one after another.
class Chance {
 public:
  explicit Chance(int seed) : state_(mixBits(static_cast<std::uint64_t>(seed))) {}
  std::uint64_t bits() { return state_ = mixBits(state_); }
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(bits() % n); }
  Real between(Real low, Real high) { return low + (high - low) * unitFromBits(bits()); }

 private:
  std::uint64_t state_;
};

using Rules = std::array<std::vector<std::string>, 256>;

Rules readRules(const std::vector<std::string>& texts) {
  Rules rules;
  for (const std::string& text : texts) {
    std::string symbols;
    for (const char c : text)
      if (c != ' ') symbols += c;
    if (symbols.size() < 2 || symbols[1] != '=')
      throw Error(Fault::scene, "rules: expected \"X = text\", found \"" + text + "\"");
    rules[static_cast<unsigned char>(symbols[0])].push_back(symbols.substr(2));
  }
  return rules;
}

std::string grow(const Plant& plant, Chance& chance) {
  const Rules rules = readRules(plant.rules);
  std::string text = plant.axiom;
  for (int i = 0; i < plant.iterations; ++i) {
    std::string next;
    for (const char symbol : text) {
      checkBudget();
      const auto& choices = rules[static_cast<unsigned char>(symbol)];
      if (choices.empty())
        next += symbol;
      else
        next += choices[choices.size() == 1 ? 0 : chance.below(choices.size())];
      if (next.size() > Plant::kMostSymbols)
        throw Error(Fault::scene,
                    "plant: more than " + std::to_string(Plant::kMostSymbols) + " symbols after " +
                        std::to_string(i + 1) + " iterations",
                    "give fewer iterations");
    }
    text = std::move(next);
  }
  return text;
}

/// Where the turtle is, and which way it looks.
struct Turtle {
  Vec3 place, ahead{0, 0, 1}, left{-1, 0, 0}, up{0, -1, 0};
  Real radius = 1;

  /// Turns a towards b.
  static void turn(Vec3& a, Vec3& b, Real angle) {
    const Real c = math::cos(angle), s = math::sin(angle);
    const Vec3 turned = a * c + b * s;
    b = normalize(b * c - a * s);
    a = normalize(turned);
  }
};

using Branch = std::array<std::array<Real, 4>, 2>;  // (x, y, z, radius) at both ends

std::vector<Branch> walk(const Plant& plant, const std::string& text, Chance& chance) {
  std::vector<Branch> branches;
  std::vector<Turtle> waiting;
  Turtle turtle;
  const auto angle = [&] {
    return plant.angle * (kPi / 180) * (1 + chance.between(-plant.jitter, plant.jitter));
  };
  for (const char symbol : text) {
    checkBudget();
    const Turtle before = turtle;
    switch (symbol) {
      case 'F':
      case 'G':
        turtle.place += turtle.ahead;
        turtle.radius *= plant.taper;
        branches.push_back({{{before.place.x, before.place.y, before.place.z, before.radius},
                             {turtle.place.x, turtle.place.y, turtle.place.z, turtle.radius}}});
        if (branches.size() > Plant::kMostBranches)
          throw Error(Fault::scene, "plant: more than " + std::to_string(Plant::kMostBranches) + " branches",
                      "give fewer iterations");
        break;
      case 'f': turtle.place += turtle.ahead; break;
      case '+': Turtle::turn(turtle.ahead, turtle.left, angle()); break;
      case '-': Turtle::turn(turtle.ahead, turtle.left, -angle()); break;
      case '^': Turtle::turn(turtle.ahead, turtle.up, angle()); break;
      case '&': Turtle::turn(turtle.ahead, turtle.up, -angle()); break;
      case '\\': Turtle::turn(turtle.left, turtle.up, angle()); break;
      case '/': Turtle::turn(turtle.left, turtle.up, -angle()); break;
      case '|': Turtle::turn(turtle.ahead, turtle.left, kPi); break;
      case '!': turtle.radius *= plant.narrow; break;
      case '[':
        waiting.push_back(turtle);
        turtle.radius *= plant.narrow;
        break;
      case ']':
        if (!waiting.empty()) {
          turtle = waiting.back();
          waiting.pop_back();
        }
        break;
      default: break;  // a symbol that only grows
    }
  }
  return branches;
}

}  // namespace

std::shared_ptr<const TracedSweep> Plant::prepared() const {
  const Work work("growing a plant");
  Chance chance(seed);
  const std::vector<Branch> branches = walk(*this, grow(*this, chance), chance);
  Real highest = 0, farthest = 0;
  for (const Branch& branch : branches) {
    highest = max(highest, branch[1][2]);
    for (const Real x : {branch[1][0], branch[1][1], branch[1][2]}) farthest = max(farthest, std::abs(x));
  }
  const Real scale = height / (highest > 0 ? highest : farthest > 0 ? farthest : 1);
  std::vector<Cubic<4>> lines;
  lines.reserve(branches.size());
  for (const Branch& branch : branches) {
    Cubic<4> line;
    for (std::size_t axis = 0; axis < 4; ++axis) {
      const Real unit = axis == 3 ? radius : scale;
      line.c[axis] = {branch[0][axis] * unit, (branch[1][axis] - branch[0][axis]) * unit, 0, 0};
    }
    lines.push_back(line);
  }
  return std::make_shared<const TracedSweep>(std::move(lines));
}

}  // namespace trace
