#include "formats/ray/write/transform.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "formats/ray/read/fields.h"
#include "math/elementary.h"

namespace trace::rayfile {
namespace {

using Step = TransformStep;
using Steps = std::vector<TransformStep>;
using Form = TransformStep::Kind;

/// The largest error of a product of a few matrices, relative to its size.
constexpr Real kRounding = 1e-13;
/// The difference that tells one form of a matrix from another, relative to its size.
constexpr Real kAlike = 1e-11;

Real largest(const Vec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }
Real sizeOf(const Affine& m) { return std::max({largest(m.row[0]), largest(m.row[1]), largest(m.row[2])}); }

Vec3 column(const Affine& m, int i) {
  return i == 0   ? Vec3{m.row[0].x, m.row[1].x, m.row[2].x}
         : i == 1 ? Vec3{m.row[0].y, m.row[1].y, m.row[2].y}
                  : Vec3{m.row[0].z, m.row[1].z, m.row[2].z};
}
Real& entry(Vec3& v, int i) { return i == 0 ? v.x : i == 1 ? v.y : v.z; }

/// To so many digits that count.
Real rounded(Real x, int digits) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*e", digits - 1, x);
  return std::strtod(text, nullptr);
}

/// Without what is only rounding beside the largest.
void dropNoise(std::vector<Real>& numbers, std::size_t first, std::size_t count) {
  Real most = 0;
  for (std::size_t i = first; i < first + count; ++i) most = std::max(most, std::abs(numbers[i]));
  for (std::size_t i = first; i < first + count; ++i)
    if (std::abs(numbers[i]) < 1e-15 * most) numbers[i] = 0;
}

bool isDiagonal(const Affine& m) {
  const Real least = kAlike * sizeOf(m);
  for (int i = 0; i < 3; ++i) {
    Vec3 row = m.row[i];
    entry(row, i) = 0;
    if (largest(row) > least) return false;
  }
  return true;
}

bool isTurn(const Affine& m) {
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j)
      if (std::abs(dot(m.row[i], m.row[j]) - (i == j ? 1 : 0)) > kAlike) return false;
  return determinant(m) > 0;
}

/// The axis, its largest entry 1 or -1, and the angle of a turn.
std::vector<Real> axisAndAngle(const Affine& turn) {
  const Vec3 skew{turn.row[2].y - turn.row[1].z, turn.row[0].z - turn.row[2].x,
                  turn.row[1].x - turn.row[0].y};
  const Real sine = length(skew) / 2, cosine = (turn.row[0].x + turn.row[1].y + turn.row[2].z - 1) / 2;
  Vec3 axis = skew;
  if (sine < 1e-6 && cosine < 0) {  // nearly half a turn: the axis is the largest column of R + 1
    Real most = 0;
    for (int i = 0; i < 3; ++i) {
      Vec3 c = column(turn, i);
      entry(c, i) += 1;
      if (length(c) > most) {
        most = length(c);
        axis = c;
      }
    }
    if (dot(axis, skew) < 0) axis = -axis;
  }
  const Real most = largest(axis);
  if (!(most > 0)) return {0, 0, 1, 0};
  std::vector<Real> result{axis.x / most, axis.y / most, axis.z / most, math::atan2(sine, cosine)};
  dropNoise(result, 0, 3);
  return result;
}

/// As the file said it, if it is about the same axis.
std::vector<Real> axisAndAngle(const Affine& turn, const std::vector<Real>& before) {
  std::vector<Real> result = axisAndAngle(turn);
  const Vec3 was{before[0], before[1], before[2]}, is{result[0], result[1], result[2]};
  if (result[3] == 0) return {was.x, was.y, was.z, 0};
  if (length(cross(was, is)) > 1e-9 * length(was) * length(is)) return result;
  return {was.x, was.y, was.z, dot(was, is) < 0 ? -result[3] : result[3]};
}

Step matrixStep(const Affine& m) {
  Step step{Form::matrix, {}};
  for (int i = 0; i < 3; ++i) {
    Vec3 row = m.row[i], offset = m.offset;
    step.numbers.insert(step.numbers.end(), {row.x, row.y, row.z, entry(offset, i)});
  }
  return step;
}

/// The linear part of `m` as that of a step of this form, if it is one.
std::optional<Step> asForm(const Step& before, const Affine& m) {
  switch (before.kind) {
    case Form::translate: return {};
    case Form::matrix: {
      Affine kept = m;
      kept.offset = affineOf(before).offset;
      return matrixStep(kept);
    }
    case Form::scale: {
      if (!isDiagonal(m)) return {};
      const Vec3 s{m.row[0].x, m.row[1].y, m.row[2].z};
      const bool even = std::max(std::abs(s.x - s.y), std::abs(s.x - s.z)) <= kAlike * std::abs(s.x);
      if (even && before.numbers.size() == 1) return Step{Form::scale, {s.x}};
      return Step{Form::scale, {s.x, s.y, s.z}};
    }
    case Form::rotate:
      if (!isTurn(m)) return {};
      return Step{Form::rotate, axisAndAngle(m, before.numbers)};
  }
  return {};
}

/// Finds the changed steps; `outer` can be undone.
class Fitting {
 public:
  Fitting(const Affine& outer, const Steps& own, const Affine& target)
      : outer_(outer), own_(own), target_(target) {}

  std::optional<Steps> find() {
    if (own_.empty()) return without();
    if (const auto moved = settled(own_)) return moved;
    for (const Form form : {Form::scale, Form::rotate, Form::matrix})
      for (std::size_t i = 0; i < own_.size(); ++i)
        if (own_[i].kind == form)
          if (const auto found = byOne(i)) return found;
    if (const auto found = byTurnAndScale()) return found;
    if (const auto found = byNewTurn()) return found;
    return byMatrix();
  }

 private:
  Affine whole(const Steps& steps) const {
    Affine m = outer_;
    for (const Step& step : steps) m = m * affineOf(step);
    return m;
  }
  Affine before(std::size_t i) const { return whole(Steps(own_.begin(), own_.begin() + std::ptrdiff_t(i))); }
  Affine after(std::size_t i) const {
    return product(Steps(own_.begin() + std::ptrdiff_t(i) + 1, own_.end()));
  }

  std::optional<Steps> without() const {
    const Affine inner = outer_ == Affine{} ? target_ : inverse(outer_) * target_;
    return checked(stepsOf(inner));
  }

  std::optional<Steps> checked(Steps steps) const {
    if (!nearlyEqual(whole(steps), target_)) return {};
    return steps;
  }

  /// The step that is needed if all others stay; its offset does not count.
  std::optional<Affine> wanted(std::size_t i) const {
    const Affine left = before(i), right = after(i);
    if (!invertible(left) || !invertible(right)) return {};
    return inverse(left) * target_ * inverse(right);
  }

  std::optional<Steps> byOne(std::size_t i) const {
    const std::optional<Affine> m = wanted(i);
    if (!m) return {};
    std::optional<Step> step = asForm(own_[i], *m);
    if (!step) return {};
    if (step->kind == Form::matrix) {
      Steps exact = own_;
      exact[i] = own_.size() == 1 && outer_ == Affine{} ? matrixStep(target_) : matrixStep(*m);
      keepOld(exact[i].numbers, own_[i].numbers);
      if (auto found = checked(exact)) return found;
    }
    Steps steps = own_;
    steps[i] = *step;
    return settled(simpler(steps, i));
  }

  std::optional<Steps> byTurnAndScale() const {
    std::size_t turn = own_.size(), scale = own_.size();
    for (std::size_t i = 0; i < own_.size(); ++i) {
      if (own_[i].kind == Form::translate) continue;
      std::size_t& place = own_[i].kind == Form::rotate ? turn : scale;
      if (own_[i].kind == Form::matrix || place != own_.size()) return {};
      place = i;
    }
    if (turn >= scale || scale == own_.size()) return {};
    Affine m = inverse(outer_) * target_;
    const Affine was = affineOf(own_[scale]);
    Vec3 s{length(column(m, 0)), length(column(m, 1)), length(column(m, 2))};
    s = {std::copysign(s.x, was.row[0].x), std::copysign(s.y, was.row[1].y),
         std::copysign(s.z, was.row[2].z)};
    if (!(std::min({std::abs(s.x), std::abs(s.y), std::abs(s.z)}) > 0)) return {};
    const Affine bare = m * Affine::scaling({1 / s.x, 1 / s.y, 1 / s.z});
    const std::optional<Step> turned = asForm(own_[turn], bare),
                              scaled = asForm(own_[scale], Affine::scaling(s));
    if (!turned || !scaled) return {};
    Steps steps = own_;
    steps[turn] = *turned;
    steps = simpler(steps, turn);
    steps[scale] = *scaled;
    return settled(simpler(steps, scale));
  }

  /// Where nothing turned before: a translation, the new turn, and what scales.
  std::optional<Steps> byNewTurn() const {
    const auto turns = [](const Step& step) { return step.kind == Form::rotate; };
    const auto isMatrix = [](const Step& step) { return step.kind == Form::matrix; };
    if (std::any_of(own_.begin(), own_.end(), turns) || std::any_of(own_.begin(), own_.end(), isMatrix))
      return {};
    Steps steps = stepsOf(outer_ == Affine{} ? target_ : inverse(outer_) * target_);
    const auto turn = std::find_if(steps.begin(), steps.end(), turns);
    if (turn == steps.end()) return {};
    steps.erase(turn + 1, steps.end());
    const bool moved = own_.front().kind == Form::translate;  // the turn takes its place
    steps.insert(steps.end(), own_.begin() + (moved ? 1 : 0), own_.end());
    return steps.size() < own_.size() ? std::nullopt : checked(std::move(steps));
  }

  /// The outermost step becomes a matrix that does what is left.
  std::optional<Steps> byMatrix() const {
    const Affine right = after(0);
    if (!invertible(right)) return {};
    Steps steps = own_;
    steps[0] = matrixStep(inverse(outer_) * target_ * inverse(right));
    return checked(steps);
  }

  /// The step's numbers with as few digits as do.
  Steps simpler(Steps steps, std::size_t i) const {
    keepOld(steps[i].numbers, own_[i].numbers);
    const Affine wanted = whole(steps);
    for (const bool exactly : {true, false})
      for (int digits = 4; digits <= 17; ++digits) {
        Steps attempt = steps;
        for (Real& number : attempt[i].numbers) number = rounded(number, digits);
        const Affine got = whole(attempt);
        if (exactly ? sameLinear(got, target_) : nearlySameLinear(got, wanted)) return attempt;
      }
    return steps;
  }

  static bool sameLinear(const Affine& a, const Affine& b) {
    return a.row[0] == b.row[0] && a.row[1] == b.row[1] && a.row[2] == b.row[2];
  }
  static bool nearlySameLinear(Affine a, Affine b) {
    a.offset = b.offset = {};
    return nearlyEqual(a, b);
  }

  /// Numbers that differ by rounding only stay as they were.
  static void keepOld(std::vector<Real>& numbers, const std::vector<Real>& old) {
    if (numbers.size() != old.size()) return;
    Real most = 0;
    for (Real number : numbers) most = std::max(most, std::abs(number));
    for (std::size_t i = 0; i < numbers.size(); ++i)
      if (std::abs(numbers[i] - old[i]) <= 1e-14 * most) numbers[i] = old[i];
  }

  /// With the offset brought right by a translation, a new one if there is none. Nothing if the linear part
  /// is another than the target's.
  std::optional<Steps> settled(Steps steps) const {
    if (!nearlySameLinear(whole(steps), target_)) return {};
    if (nearlyEqual(whole(steps), target_)) return steps;
    std::size_t at = 0;
    while (at < steps.size() && steps[at].kind != Form::translate) ++at;
    if (at == steps.size()) {  // a matrix may move too
      for (at = 0; at < steps.size() && steps[at].kind != Form::matrix;) ++at;
      if (at == steps.size()) {
        steps.insert(steps.begin(), {Form::translate, {0, 0, 0}});
        at = 0;
      }
    }
    Affine left = outer_;
    for (std::size_t i = 0; i < at; ++i) left = left * affineOf(steps[i]);
    if (!invertible(left)) return {};
    left = inverse(left);
    const bool isMatrix = steps[at].kind == Form::matrix;
    const std::array<std::size_t, 3> places =
        isMatrix ? std::array<std::size_t, 3>{3, 7, 11} : std::array<std::size_t, 3>{0, 1, 2};
    std::vector<Real>& numbers = steps[at].numbers;
    const std::vector<Real> old = numbers;
    const Real noise = 1e-14 * std::max(largest(linear(left, target_.offset - outer_.offset)), 1e-300);
    for (int round = 0; round < 4; ++round) {
      const Vec3 more = linear(left, target_.offset - whole(steps).offset);
      numbers[places[0]] += more.x, numbers[places[1]] += more.y, numbers[places[2]] += more.z;
    }
    for (std::size_t i = 0; i < places.size(); ++i)
      if (std::abs(numbers[places[i]] - old[places[i]]) <= noise) numbers[places[i]] = old[places[i]];
    const std::vector<Real> best = numbers;
    for (const bool exactly : {true, false})
      for (int digits = 4; digits <= 17; ++digits) {
        for (std::size_t place : places) numbers[place] = rounded(best[place], digits);
        const Affine got = whole(steps);
        if (exactly ? got.offset == target_.offset : nearlyEqual(got, target_)) return steps;
      }
    return {};
  }

  const Affine& outer_;
  const Steps& own_;
  const Affine& target_;
};

}  // namespace

Affine affineOf(const Step& step) {
  const std::vector<Real>& n = step.numbers;
  switch (step.kind) {
    case Form::translate: return Affine::translation({n[0], n[1], n[2]});
    case Form::scale:
      return n.size() == 1 ? Affine::scaling({n[0], n[0], n[0]}) : Affine::scaling({n[0], n[1], n[2]});
    case Form::rotate: {
      const Real length = math::hypot(n[0], n[1], n[2]);
      return Affine::rotation(Vec3{n[0], n[1], n[2]} / length, n[3]);
    }
    case Form::matrix: {
      Affine m;
      for (std::size_t i = 0; i < 3; ++i) m.row[i] = {n[4 * i], n[4 * i + 1], n[4 * i + 2]};
      m.offset = {n[3], n[7], n[11]};
      return m;
    }
  }
  return {};
}

Step inDegrees(Step step) {
  constexpr Real kDigits = 1e11;  // what rounding leaves of an angle
  if (step.kind == Form::rotate)
    step.numbers[3] = std::round(step.numbers[3] * (180 / kPi) * kDigits) / kDigits;
  return step;
}

Affine product(const Steps& steps) {
  Affine m;
  for (const Step& step : steps) m = m * affineOf(step);
  return m;
}

std::string head(const Step& step, int digits) {
  static constexpr std::array<std::string_view, 4> kNames{"translate", "rotate", "scale", "transform"};
  std::string text = std::string(kNames[static_cast<std::size_t>(step.kind)]) + "(";
  if (step.kind == Form::matrix) {
    for (std::size_t i = 0; i < 12; ++i)
      text += (i % 4 == 0 ? "(" : "") + written(step.numbers[i], digits) + (i % 4 == 3 ? "), " : ", ");
    return text + "(0, 0, 0, 1), ";
  }
  for (Real number : step.numbers) text += written(number, digits) + ", ";
  return text;
}

bool nearlyEqual(const Affine& a, const Affine& b) {
  const Real least = kRounding * std::max(sizeOf(a), sizeOf(b));
  for (int i = 0; i < 3; ++i)
    if (!(largest(a.row[i] - b.row[i]) <= least)) return false;
  return largest(a.offset - b.offset) <=
         std::max(least, kRounding * std::max(largest(a.offset), largest(b.offset)));
}

namespace {

/// Factors along the object's axes, and the turn after them. Nothing for what is skewed or flat.
struct ScaledTurn {
  Vec3 scale;
  std::vector<Real> turn;
};
std::optional<ScaledTurn> scaledTurnOf(const Affine& m) {
  Vec3 s{length(column(m, 0)), length(column(m, 1)), length(column(m, 2))};
  if (!(std::min({s.x, s.y, s.z}) > 0) || !std::isfinite(s.x + s.y + s.z)) return {};
  if (determinant(m) < 0) s = -s;
  const Affine bare = m * Affine::scaling({1 / s.x, 1 / s.y, 1 / s.z});
  if (!isTurn(bare)) return {};
  return ScaledTurn{s, axisAndAngle(bare)};
}

}  // namespace

Affine inShortNumbers(const Affine& m, int digits) {
  const auto parts = scaledTurnOf(m);
  if (!parts || !isFinite(m.offset)) return m;
  const Real least = math::pow(0.1, digits) * sizeOf(m);  // less is nothing
  const auto near = [&](Real x) { return std::abs(x) < least ? 0 : rounded(x, digits) + 0.0; };
  const auto all = [&](const Vec3& v) { return Vec3{near(v.x), near(v.y), near(v.z)}; };
  std::vector<Real> turn = parts->turn;
  const Real degrees = rounded(turn[3] * 180 / kPi, digits);
  for (std::size_t i = 0; i < 3; ++i)
    turn[i] = std::abs(turn[i]) < math::pow(0.1, digits) ? 0 : rounded(turn[i], digits) + 0.0;
  const Affine turned =
      degrees == 0 ? Affine{} : affineOf({Form::rotate, {turn[0], turn[1], turn[2], degrees * kPi / 180}});
  return Affine::translation(all(m.offset)) * turned * Affine::scaling(all(parts->scale));
}

Steps stepsOf(const Affine& m) {
  if (m == Affine{}) return {};
  Steps move;
  if (m.offset != Vec3{}) move = {{Form::translate, {m.offset.x, m.offset.y, m.offset.z}}};
  const auto good = [&](const Steps& inner) -> std::optional<Steps> {
    Steps all = move;
    all.insert(all.end(), inner.begin(), inner.end());
    const Affine said = product(all);
    if (std::memcmp(&said, &m, sizeof m) != 0) return {};  // also the signs of zeros
    return all;
  };
  if (const auto found = good({})) return *found;
  const auto scaling = [](const Vec3& s) {
    if (s.x == s.y && s.x == s.z) return Step{Form::scale, {s.x}};
    return Step{Form::scale, {s.x, s.y, s.z}};
  };
  if (const auto found = good({scaling({m.row[0].x, m.row[1].y, m.row[2].z})})) return *found;

  const auto parts = scaledTurnOf(m);
  if (!parts) return {matrixStep(m)};
  const auto& [s, turn] = *parts;
  // The axis whose first entry is above 0 comes first.
  const Real first = std::copysign(1.0, turn[0] != 0 ? turn[0] : turn[1] != 0 ? turn[1] : turn[2]);
  for (int digits = 6; digits <= 17; ++digits) {
    const auto near = [&](Real x) { return rounded(x, digits) + 0.0; };  // no -0
    const Vec3 scale{near(s.x), near(s.y), near(s.z)};
    for (const Real sign : {first, -first}) {
      const Step rotate{
          Form::rotate,
          {near(sign * turn[0]), near(sign * turn[1]), near(sign * turn[2]), near(sign * turn[3])}};
      if (scale == Vec3{1, 1, 1})
        if (const auto found = good({rotate})) return *found;
      if (const auto found = good({rotate, scaling(scale)})) return *found;
    }
  }
  return {matrixStep(m)};
}

std::optional<Steps> changedSteps(const Affine& outer, const Steps& own, const Affine& target) {
  if (!invertible(outer)) return {};
  return Fitting(outer, own, target).find();
}

}  // namespace trace::rayfile
