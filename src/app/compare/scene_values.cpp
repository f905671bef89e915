#include "app/compare/scene_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <type_traits>

#include "app/compare/diff_cause.h"
#include "base/find_field.h"
#include "math/elementary.h"
#include "render/rays/ray_tree.h"

namespace trace {
namespace {

constexpr std::size_t kMostLights = 8, kMostMaterials = 16;
constexpr double kMostLeft = 0.2;        // the share of the RMSE that a value may leave
constexpr double kConcerned = 0.9;       // the share of the squared difference that lies where a value acts
constexpr double kHelps = 0.95;          // the share of the RMSE that the best of the first numbers may leave
constexpr double kSpareForShort = 0.02;  // the share that a short number may leave more than a long one
constexpr double kSettled = 1e-3;        // the share of a value by which another guess no longer changes it
constexpr double kSame = 0.01;           // the share of the largest channel that counts as rounding
constexpr int kMostTraces = 6;           // for a colour in which the light is not linear
constexpr int kLadder = 4;               // numbers to each side that are tried first
constexpr int kNarrowings = 12;          // steps that shrink the bracket of a number, one trace each
constexpr int kColorNarrowings = 30;     // steps that shrink the bracket of a colour

using Channels = std::array<double, 3>;

Channels channelsOf(const Color& c) { return {c.r, c.g, c.b}; }
Color colorOf(const Channels& c) { return {c[0], c[1], c[2]}; }

double maxDistance(const Color& a, const Color& b) {
  return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

/// from + share * (to - from) for each channel.
Color between(const Color& from, const Color& to, const Color& share) {
  return from + share * (to + from * -1);
}

/// The sum of the squares of the differences of each channel. Light that is not finite counts as none.
Channels squaresBetween(const Picture& a, const Picture& b) {
  Channels sums{};
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const Channels d = channelsOf(a.pixels[i] + b.pixels[i] * -1);
    for (std::size_t c = 0; c < 3; ++c)
      if (std::isfinite(d[c])) sums[c] += d[c] * d[c];
  }
  return sums;
}

/// The unit of the last of so many digits of a number.
double unitOf(double number, int digits) {
  return math::pow(10, std::floor(math::log10(number)) + 1 - digits);
}

std::string numberText(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

class ValueFit {
 public:
  ValueFit(const SceneValue& value, const ValueSearch& search)
      : value_(value), search_(search), before_(rmseOf(search.light)) {}

  std::optional<Color> color() const {
    Channels probe = channelsOf(value_.now);
    for (double& channel : probe) channel = channel > 0 ? 0 : 1;
    Sample last{value_.now, search_.light}, next{colorOf(probe), traced(colorOf(probe))};
    if (!acts(next.light)) return {};
    std::optional<Color> best;
    double least = kMostLeft * before_;
    for (int i = 0; i < kMostTraces; ++i) {
      const Color share = bestShare(last, next);
      const Color guess = between(last.value, next.value, share);
      const double expected = rmseOf(lightBetween(last, next, share));
      if (expected > kMostLeft * before_) break;
      Sample made{guess, traced(guess)};
      const double left = rmseOf(made.light);
      const bool isSettled = i > 0 && maxDistance(guess, next.value) <= kSettled * largestOf(guess);
      last = std::move(next);
      next = std::move(made);
      if (left < least) {
        least = left;
        best = guess;
      }
      if (left == 0 || isSettled) break;
    }
    if (!best) return best;
    return shortOf(*best, least);
  }

  std::optional<Color> number() const {
    if (value_.silence) {
      Scene scene = search_.scene;
      value_.silence(scene);
      if (!acts(search_.trace(scene))) return {};
    }
    const double now = value_.now.r;
    const auto rung = [&](int i) {
      return std::clamp(now * math::pow(value_.step, i), value_.least, value_.most);
    };
    int best = 0;
    double least = kHelps * before_;
    for (int i = -kLadder; i <= kLadder; ++i) {
      if (i == 0) continue;
      if (const double left = leftBy(rung(i)); left < least) {
        least = left;
        best = i;
      }
    }
    if (best == 0) return {};
    const double found = narrowed(rung(best - 1), rung(best + 1));
    least = leftBy(found);
    if (least > kMostLeft * before_) return {};
    return shortOf(Color(found), least);
  }

 private:
  /// A value and the light that it makes.
  struct Sample {
    Color value;
    Picture light;
  };

  double largestOf(const Color& value) const {
    return std::max(maxComponent(value), maxComponent(value_.now));
  }
  Picture traced(const Color& value) const {
    Scene scene = search_.scene;
    value_.assign(scene, value);
    return search_.trace(scene);
  }
  double rmseOf(const Picture& light) const {
    return rmseAfter({}, search_.shownAsWanted(light), search_.wanted);
  }
  double leftBy(double number) const { return rmseOf(traced(Color(number))); }

  /// Most of the difference lies where the value acts, which is where this light differs.
  bool acts(const Picture& changed) const {
    const Picture shown = search_.shownAsWanted(search_.light).picture;
    double inside = 0, all = 0;
    for (std::size_t i = 0; i < shown.pixels.size(); ++i) {
      const Channels d = channelsOf(shown.pixels[i] + search_.wanted.picture.pixels[i] * -1),
                     was = channelsOf(search_.light.pixels[i]), is = channelsOf(changed.pixels[i]);
      for (std::size_t c = 0; c < 3; ++c) {
        if (!std::isfinite(d[c])) continue;
        all += d[c] * d[c];
        if (was[c] != is[c]) inside += d[c] * d[c];
      }
    }
    return all > 0 && inside >= kConcerned * all;
  }

  /// The light of a value between two whose light is known, or beyond, if it is linear.
  static Picture lightBetween(const Sample& a, const Sample& b, const Color& share) {
    Picture light = a.light;
    for (std::size_t i = 0; i < light.pixels.size(); ++i)
      light.pixels[i] = between(a.light.pixels[i], b.light.pixels[i], share);
    return light;
  }

  /// Where between the two samples, or beyond, the light is most like what is wanted: for each channel alone,
  /// by brackets that shrink. Values stay within 0 and the largest that is sensible.
  Color bestShare(const Sample& a, const Sample& b) const {
    const Channels from = channelsOf(a.value), to = channelsOf(b.value), now = channelsOf(value_.now);
    Channels low{}, high{};
    for (std::size_t c = 0; c < 3; ++c) {
      if (from[c] == to[c]) continue;
      const double most = std::max(1.0, 4 * now[c]);
      const double first = (0 - from[c]) / (to[c] - from[c]), second = (most - from[c]) / (to[c] - from[c]);
      low[c] = std::min(first, second);
      high[c] = std::max(first, second);
    }
    for (int i = 0; i < kColorNarrowings; ++i) {
      Channels left{}, right{};
      for (std::size_t c = 0; c < 3; ++c) {
        left[c] = low[c] + (high[c] - low[c]) / 3;
        right[c] = high[c] - (high[c] - low[c]) / 3;
      }
      const Channels byLeft = squaresOf(lightBetween(a, b, colorOf(left))),
                     byRight = squaresOf(lightBetween(a, b, colorOf(right)));
      for (std::size_t c = 0; c < 3; ++c)
        (byLeft[c] <= byRight[c] ? high[c] : low[c]) = byLeft[c] <= byRight[c] ? right[c] : left[c];
    }
    return colorOf(low) * 0.5 + colorOf(high) * 0.5;
  }
  Channels squaresOf(const Picture& light) const {
    return squaresBetween(search_.shownAsWanted(light).picture, search_.wanted.picture);
  }

  /// The number in the bracket that leaves least, by the golden section of its logarithm.
  double narrowed(double first, double second) const {
    constexpr double kGolden = 0.6180339887498949;
    double low = math::log(std::min(first, second)), high = math::log(std::max(first, second));
    double left = high - kGolden * (high - low), right = low + kGolden * (high - low);
    double byLeft = leftBy(math::exp(left)), byRight = leftBy(math::exp(right));
    for (int i = 0; i < kNarrowings; ++i) {
      if (byLeft <= byRight) {
        high = right, right = left, byRight = byLeft;
        left = high - kGolden * (high - low);
        byLeft = leftBy(math::exp(left));
      } else {
        low = left, left = right, byLeft = byRight;
        right = low + kGolden * (high - low);
        byRight = leftBy(math::exp(right));
      }
    }
    return math::exp(byLeft <= byRight ? left : right);
  }

  /// The value with the fewest digits that leaves hardly more than the value itself. What hardly differs from
  /// the scene is that of the scene.
  Color shortOf(const Color& value, double left) const {
    for (const int digits : {1, 2, 3}) {
      if (!(largestOf(value) > 0)) break;
      const double unit = unitOf(largestOf(value), digits);
      Channels other = channelsOf(value);
      const Channels now = channelsOf(value_.now);
      for (std::size_t c = 0; c < 3; ++c)
        other[c] = std::abs(other[c] - now[c]) <= kSame * largestOf(value)
                       ? now[c]
                       : std::round(other[c] / unit) * unit;
      if (rmseOf(traced(colorOf(other))) <= left + kSpareForShort * before_) return colorOf(other);
    }
    return value;
  }

  const SceneValue& value_;
  const ValueSearch& search_;
  const double before_;
};

/// The name of the first object with the material; "" if none has it.
std::string ownerOf(const Scene& scene, std::size_t material) {
  for (std::uint32_t i = 0; i < scene.objects.size(); ++i)
    if (scene.objects[i].material == material) return objectName(scene, i);
  return "";
}

void addMaterial(std::vector<SceneValue>& all, const Scene& scene, std::size_t index) {
  std::string owner = ownerOf(scene, index);
  if (owner.empty()) return;
  forEachField(scene.materials[index].model, [&](const auto& field, const auto& held) {
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(held)>, Color>)
      all.push_back({.keyword = std::string(field.keyword),
                     .owner = owner,
                     .assign =
                         [index, keyword = field.keyword](Scene& to, const Color& value) {
                           if (Color* color = editableValue<Color>(to.materials[index].model, keyword))
                             *color = value;
                         },
                     .now = held});
  });
  const auto number = [&](std::string_view keyword, std::string_view silenced, Real least, Real most,
                          Real step) {
    const Real* held = findValue<Real>(scene.materials[index].model, keyword);
    if (!held || !(*held > 0)) return;
    all.push_back({.keyword = std::string(keyword),
                   .owner = owner,
                   .assign =
                       [index, keyword](Scene& to, const Color& value) {
                         if (Real* real = editableValue<Real>(to.materials[index].model, keyword))
                           *real = value.r;
                       },
                   .silence =
                       [index, silenced](Scene& to) {
                         if (Color* color = editableValue<Color>(to.materials[index].model, silenced))
                           *color = Color(0);
                       },
                   .now = Color(*held),
                   .isColor = false,
                   .least = least,
                   .most = most,
                   .step = step});
  };
  number("shininess", "specular", 1e-3, 1e5, 2);
  number("index", "transmissive", 0.2, 5, 1.12);
}

void addLight(std::vector<SceneValue>& all, const Scene& scene, std::uint32_t index) {
  const Color* now = findValue<Color>(scene.lights[index].light, "color");
  if (!now) return;
  all.push_back({.keyword = "color",
                 .owner = lightName(scene, index),
                 .assign =
                     [index](Scene& to, const Color& value) {
                       *editableValue<Color>(to.lights[index].light, "color") = value;
                     },
                 .now = *now});
}

}  // namespace

std::string SceneValue::text(const Color& value) const {
  const std::string number =
      isColor ? "(" + numberText(value.r) + ", " + numberText(value.g) + ", " + numberText(value.b) + ")"
              : numberText(value.r);
  return "with " + keyword + " " + number + " in " + owner;
}

std::vector<SceneValue> valuesOf(const Scene& scene) {
  std::vector<SceneValue> all;
  for (std::uint32_t i = 0; i < std::min(scene.lights.size(), kMostLights); ++i) addLight(all, scene, i);
  for (std::size_t i = 0; i < std::min(scene.materials.size(), kMostMaterials); ++i)
    addMaterial(all, scene, i);
  all.push_back({.keyword = "fov",
                 .owner = "the camera",
                 .assign = [](Scene& to, const Color& value) { to.camera.fov = value.r; },
                 .now = Color(scene.camera.fov),
                 .isColor = false,
                 .least = 1,
                 .most = 170,
                 .step = 1.15});
  return all;
}

std::optional<SceneVariant> fittedVariant(const SceneValue& value, const ValueSearch& search) {
  const ValueFit fit(value, search);
  const std::optional<Color> found = value.isColor ? fit.color() : fit.number();
  if (!found) return {};
  return SceneVariant{value.text(*found), [assign = value.assign, color = *found](Scene& scene, Settings&) {
                        assign(scene, color);
                      }};
}

}  // namespace trace
