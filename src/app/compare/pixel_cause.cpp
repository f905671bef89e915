#include "app/compare/pixel_cause.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "app/explain/light_shares.h"
#include "image/development/development.h"
#include "render/picture/explain.h"

namespace trace {
namespace {

constexpr int kMostSamples = 16;
constexpr double kSamePixel = 1, kOtherPixel = 4;  // in levels of 255
constexpr std::size_t kListedParts = 5;

bool sumsFewTerms(const Settings& settings) {
  return hasTrait(settings, Trait::asksAllLights) && samplesOf(settings) <= kMostSamples &&
         !subdivides(settings) && settings.noiseTarget == 0 && settings.tone != Tone::stretch &&
         settings.bloom == 0 && !settings.denoise && !isAnaglyph(settings.stereo);
}

Color quotient(const Color& a, const Color& b) {
  const auto one = [](double x, double y) { return y != 0 ? x / y : 0; };
  return {one(a.r, b.r), one(a.g, b.g), one(a.b, b.b)};
}

/// A term that the other program may treat differently.
struct TermCause {
  std::string text;    ///< "lacks the reflection in ball, which brings"
  std::string family;  ///< names such terms at other pixels, too
  Color change;        ///< by which the pixel of the other program differs
};

/// The ray, or one before it, is of that kind.
bool comesBy(RayKind kind, int ray, const RayTree& tree) {
  for (; ray >= 0; ray = rayAt(tree, ray).parent)
    if (rayAt(tree, ray).kind == kind) return true;
  return false;
}

/// The terms of all samples of a pixel.
class PixelTerms {
 public:
  PixelTerms(const TracedScene& traced, const PixelPlace& pixel) : scene_(traced.scene) {
    for (int k = 0, all = 1; k < all; ++k) {
      const Explanation e = explain(traced.moments, traced.settings, traced.size, pixel.x, pixel.y, k);
      all = static_cast<int>(e.samples.size());
      light = e.pixel;
      addTree(e.tree);
    }
    if (!byDepth_.empty()) {
      const auto& [depth, brings] = *byDepth_.rbegin();
      lacks("the rays of depth " + std::to_string(depth), "depth", brings, "bring");
    }
    for (const TermCause& all : totals_) causes.push_back(all);
    std::stable_sort(parts.begin(), parts.end(), [](const auto& a, const auto& b) {
      return maxComponent(a.brings) > maxComponent(b.brings);
    });
  }

  Color light;
  std::vector<TermCause> causes;
  std::vector<PixelCause::Part> parts;

 private:
  static void sum(std::vector<TermCause>& to, std::string text, std::string family, const Color& change) {
    for (TermCause& cause : to)
      if (cause.text == text) return void(cause.change += change);
    to.push_back({std::move(text), std::move(family), change});
  }
  void lacks(const std::string& what, const std::string& family, const Color& brings,
             const std::string& verb = "brings") {
    sum(causes, "lacks " + what + ", which " + verb, family, brings * -1);
  }
  void lacksAll(const std::string& what, const std::string& family, const Color& brings,
                const std::string& verb = "brings") {
    sum(totals_, "lacks all " + what + ", which " + verb, family, brings * -1);
  }
  void hasTwice(const std::string& what, const std::string& family, const Color& brings) {
    sum(causes, "has " + what + " twice, which brings", "twice " + family, brings);
  }
  void part(const std::string& name, const Color& brings) {
    for (PixelCause::Part& known : parts)
      if (known.name == name) return void(known.brings += brings);
    parts.push_back({name, brings});
  }

  void addTree(const RayTree& tree) {
    for (int ray = 0; ray < static_cast<int>(tree.nodes.size()); ++ray) {
      const RayNode& node = rayAt(tree, ray);
      if (node.kind == RayKind::shadow || node.kind == RayKind::light || node.kind == RayKind::lamp) continue;
      const std::string here = node.hit ? objectName(scene_, node.hit->object) : "air";
      const std::string way = wayText(ray, tree, scene_);
      for (const Term& term : node.terms) {
        const Color weight = node.weight * node.through, brings = weight * term.factor * term.value;
        if (term.dark || !isFinite(brings)) continue;
        if (term.light)
          addLight(term, tree, weight, here, way);
        else if (!isBlack(brings))
          addOther(term, ray, tree, brings, here, way);
      }
    }
  }

  void addLight(const Term& term, const RayTree& tree, const Color& weight, const std::string& here,
                const std::string& way) {
    const Illumination& arriving = term.light->arriving;
    const std::string name = lightName(scene_, term.light->light), family = "light " + name;
    const std::string what = "the light of " + name + " on " + here + way;
    const Color brings = weight * term.factor * term.value;
    if (!isBlack(brings)) {
      part(what, brings);
      lacks(what, family, brings);
      hasTwice(what, family, brings);
      lacksAll("light of " + name, family, brings);
      const Color highlight = (arriving.intensity() + arriving.extraHighlight * arriving.attenuation) *
                              term.light->scatter.specular;
      const Color share = quotient(highlight, arriving.scattered(term.light->scatter));
      if (!isBlack(share)) {
        lacks("the highlight of " + name + " on " + here + way, "highlight", brings * share);
        lacksAll("highlights", "highlight", brings * share, "bring");
      }
    }
    const Color taken = weight * term.factor * (Color(1) + term.value * -1);
    if (term.ray < 0 || isBlack(taken) || !isFinite(taken)) return;
    const std::string blocker = blockerOf(rayAt(tree, term.ray));
    sum(causes,
        "lacks the shadow of " + blocker + " on " + here + " in the light of " + name + way + ", which takes",
        "shadow", taken);
    sum(totals_, "lacks all shadows, which take", "shadow", taken);
  }

  /// The name of the object that a shadow ray hit.
  std::string blockerOf(const RayNode& shadow) const {
    for (const RayEnd& end : shadow.ends)
      if (const Blocked* blocked = std::get_if<Blocked>(&end)) return objectName(scene_, blocked->object);
    return shadow.filters.empty() ? "a medium" : fillingName(scene_, shadow.filters.front().object);
  }

  void addOther(const Term& term, int ray, const RayTree& tree, const Color& brings, const std::string& here,
                const std::string& way) {
    const std::string family(Term::kNames[static_cast<std::size_t>(term.kind)]);
    if (term.goesOn()) {
      lacks("the " + family + " in " + here + way, family, brings);
      byDepth_[rayAt(tree, term.ray).depth] += brings;
      if (term.kind == Term::Kind::reflection && !comesBy(RayKind::reflection, ray, tree))
        lacksAll("reflections", family, brings, "bring");
      if (term.kind == Term::Kind::refraction && !comesBy(RayKind::refraction, ray, tree))
        lacksAll("refraction", family, brings);
      return;
    }
    std::string what = "the " + family + " on " + here;
    if (term.kind == Term::Kind::ambient) what = "the ambient light on " + here;
    if (term.kind == Term::Kind::emissive) what = "the emission of " + here;
    if (term.kind == Term::Kind::background) what = "the background";
    part(what + way, brings);
    lacks(what + way, family, brings);
    hasTwice(what + way, family, brings);
    if (term.kind == Term::Kind::ambient) lacksAll("ambient light", family, brings);
  }

  const Scene& scene_;
  std::vector<TermCause> totals_;
  std::map<int, Color> byDepth_;
};

/// By how many levels the light of a pixel misses that of the picture, which was rounded up or down.
class PixelError {
 public:
  PixelError(const Settings& settings, bool levels)
      : development_(developmentOf(settings)), levels_(levels) {}

  double operator()(const Color& light, const Color& wanted) const {
    const Color shown = levels_ ? developed(light, development_) : light;
    return std::max({one(shown.r, wanted.r), one(shown.g, wanted.g), one(shown.b, wanted.b)});
  }

 private:
  double one(double shown, double wanted) const {
    if (!levels_) return 255 * std::abs(shown - wanted) / std::max(1.0, std::abs(wanted));
    const double level = std::round(255 * wanted), value = 255 * std::clamp(shown, 0.0, 1.0);
    return std::max({0.0, level - 0.5 - value, value - level - 1});
  }

  Development development_;
  bool levels_;
};

}  // namespace

std::string lightText(const Color& light) {
  const auto one = [](double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2g", std::abs(value) < 5e-4 ? 0 : value);
    return std::string(text);
  };
  const std::string r = one(light.r), g = one(light.g), b = one(light.b);
  return r == g && g == b ? r : "(" + r + " " + g + " " + b + ")";
}

std::optional<PixelCause> pixelCause(const TracedScene& traced, const LoadedPicture& test,
                                     std::span<const PixelPlace> pixels) {
  if (pixels.empty() || !sumsFewTerms(traced.settings)) return {};
  const PixelError error(traced.settings, test.levels);
  std::vector<PixelTerms> terms;
  terms.reserve(pixels.size());
  for (const PixelPlace& pixel : pixels) terms.emplace_back(traced, pixel);
  const auto explains = [&](const TermCause& cause, std::size_t i) {
    return error(terms[i].light + cause.change, test.picture.at(pixels[i].x, pixels[i].y)) <= kSamePixel;
  };
  const auto isWrong = [&](std::size_t i) {
    return error(terms[i].light, test.picture.at(pixels[i].x, pixels[i].y)) >= kOtherPixel;
  };

  PixelCause result;
  result.pixel = pixels[0];
  result.parts = terms[0].parts;
  result.parts.resize(std::min(result.parts.size(), kListedParts));
  for (std::size_t i = 1; i < pixels.size(); ++i) result.others += isWrong(i);
  if (!isWrong(0)) return result;
  const TermCause* best = nullptr;
  for (const TermCause& cause : terms[0].causes) {
    if (!explains(cause, 0)) continue;
    int confirmed = 0;
    for (std::size_t i = 1; i < pixels.size(); ++i)
      confirmed += isWrong(i) &&
                   std::any_of(terms[i].causes.begin(), terms[i].causes.end(), [&](const TermCause& other) {
                     return other.family == cause.family && explains(other, i);
                   });
    if (2 * confirmed < result.others || (best && confirmed <= result.confirmed)) continue;
    best = &cause;
    result.confirmed = confirmed;
  }
  if (best) {
    const bool less = maxComponent(best->change) <= 0;
    result.text = best->text + " " + lightText(less ? best->change * -1 : best->change);
  }
  return result;
}

}  // namespace trace
