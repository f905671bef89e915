#include "formats/ray/syntax/keys.h"

#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "base/text.h"
#include "math/keyframes.h"

namespace trace::rayfile {
namespace {

constexpr std::array<std::string_view, 3> kInterpolations{"linear", "smooth", "spline"};
constexpr const char* kForm =
    "key((time, value), (time, value), ...), the word smooth or spline first if wanted";

/// Copies the tree, with values in the place of keys.
class Settler {
 public:
  Settler(const Syntax& syntax, SceneTime& time)
      : syntax_(syntax), all_(syntax.nodes()), moments_(time), time_(time.now()) {}

  std::vector<Node> settled() {
    copy(0);
    return std::move(result_);
  }

 private:
  bool isKey(std::uint32_t index) const {
    return all_[index].kind == Kind::call && at(index).key() == Syntax::kKey &&
           all_[index + 2].kind == Kind::tuple;
  }
  Item at(std::uint32_t index) const { return {syntax_, index}; }

  void copy(std::uint32_t index) {
    if (isKey(index)) return value(index);
    const std::size_t copied = result_.size();
    result_.push_back(all_[index]);
    for (std::uint32_t child = index + 1; child < all_[index].end; child = all_[child].end) copy(child);
    result_[copied].end = static_cast<std::uint32_t>(result_.size());
  }

  /// The value of the key in the place of its call.
  void value(std::uint32_t call) {
    Interpolation interpolation = Interpolation::linear;
    std::vector<Real> times;
    std::vector<std::uint32_t> values;  // their nodes
    const std::uint32_t end = all_[call].end;
    for (std::uint32_t pair = call + 3; pair < end; pair = all_[pair].end) {
      if (pair == call + 3 && all_[pair].kind == Kind::word)
        interpolation = named(pair);
      else
        values.push_back(readPair(pair, times));
    }
    if (values.empty()) fail(call, std::string("expected ") + kForm);
    for (std::uint32_t other : values) checkAlike(values.front(), other);
    moments_.hasKey(times.back());
    write(call, times, values, interpolation);
  }

  Interpolation named(std::uint32_t word) const {
    const std::string_view name = at(word).text();
    for (std::size_t i = 0; i < kInterpolations.size(); ++i)
      if (kInterpolations[i] == name) return static_cast<Interpolation>(i);
    fail(word, "key: expected linear, smooth or spline, found " + describe(at(word)),
         didYouMean(name, kInterpolations));
  }

  /// (time, value): returns the value's node.
  std::uint32_t readPair(std::uint32_t pair, std::vector<Real>& times) const {
    const std::uint32_t time = pair + 1, value = pair + 2;
    if (all_[pair].kind != Kind::tuple || at(pair).count() != 2 || all_[time].kind != Kind::number)
      fail(pair, "key: expected (time, value), found " + describe(at(pair)), kForm);
    if (!times.empty() && !(all_[time].number > times.back()))
      fail(time, "key: expected a time after " + toText(times.back()) + ", found " + describe(at(time)));
    for (std::uint32_t i = value; i < all_[pair].end; ++i)
      if (all_[i].kind != Kind::number && all_[i].kind != Kind::tuple)
        fail(value, "key: expected a number or a list of numbers, found " + describe(at(value)));
    times.push_back(all_[time].number);
    return value;
  }

  void checkAlike(std::uint32_t first, std::uint32_t other) const {
    bool alike = all_[first].end - first == all_[other].end - other;
    for (std::uint32_t i = first; alike && i < all_[first].end; ++i)
      alike = all_[i].kind == all_[other + (i - first)].kind &&
              all_[i].end - first == all_[other + (i - first)].end - other;
    if (!alike)
      fail(other, "key: expected a value like the first one, " + describe(at(first)) + ", found " +
                      describe(at(other)));
  }

  void write(std::uint32_t call, const std::vector<Real>& times, const std::vector<std::uint32_t>& values,
             Interpolation interpolation) {
    const std::uint32_t first = values.front(), count = all_[first].end - first;
    const auto start = static_cast<std::uint32_t>(result_.size());
    std::vector<Real> numbers;
    for (std::uint32_t i = 0; i < count; ++i) {
      Node node = all_[first + i];
      node.end = node.end - first + start;
      if (node.kind == Kind::number) {
        numbers.clear();
        for (std::uint32_t value : values) numbers.push_back(all_[value + i].number);
        node.number = interpolate(times, numbers, time_, interpolation);
        if (!std::isfinite(node.number)) fail(call, "key: the value between two keys is not finite");
      }
      result_.push_back(node);
    }
    result_[start].offset = all_[call].offset;  // so that messages show the key
    result_[start].length = all_[call].length;
  }

  [[noreturn]] void fail(std::uint32_t index, std::string what, std::string hint = {}) const {
    throw Error(Fault::scene, syntax_.place(all_[index].offset), std::move(what), std::move(hint));
  }

  const Syntax& syntax_;
  std::span<const Node> all_;
  SceneTime& moments_;
  Real time_;
  std::vector<Node> result_;
};

}  // namespace

void settleKeys(Syntax& syntax, SceneTime& time) {
  if (syntax.hasKeys()) syntax.replace(Settler(syntax, time).settled());
}

}  // namespace trace::rayfile
