#include "app/explain/explain_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>

#include "app/explain/light_shares.h"
#include "app/explain/path_ways.h"
#include "base/bits.h"
#include "base/printable.h"
#include "base/text.h"
#include "formats/ray/file/made_by.h"
#include "scene/integrators.h"
#include "scene/options.h"

namespace trace {
namespace {

// --- numbers: for the eye, six digits ---

std::string digits(Real x) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.6g", x + 0.0);  // no -0
  return buffer;
}
std::string digits(Real x, Real y, Real z) { return digits(x) + " " + digits(y) + " " + digits(z); }
std::string digits(const Vec3& v) {
  return "(" + digits(v.x) + ", " + digits(v.y) + ", " + digits(v.z) + ")";
}
/// A grey is one number.
std::string digits(const Color& c) { return c.r == c.g && c.g == c.b ? digits(c.r) : digits(c.r, c.g, c.b); }
/// All digits: what reads back as the same bits.
std::string exact(const Color& c) { return toText(c.r) + " " + toText(c.g) + " " + toText(c.b); }

bool sameBits(const Color& a, const Color& b) {
  const auto same = [](double x, double y) {
    const auto bits = [](double value) { return bitCast<std::uint64_t>(value); };
    return bits(x) == bits(y) || (std::isnan(x) && std::isnan(y));
  };
  return same(a.r, b.r) && same(a.g, b.g) && same(a.b, b.b);
}

// --- the order of terms ---

Color contributionOf(const Term& term) { return term.dark ? Color(0) : term.factor * term.value; }

/// The largest channel, whatever its sign; more than any number where one is not finite.
Real sizeOfTerm(const Term& term) {
  const Color c = contributionOf(term);
  return isFinite(c) ? max(std::abs(c.r), max(std::abs(c.g), std::abs(c.b))) : kInfinity;
}

/// The term changes no digit of the sum that is printed. A term of exactly 0 may say why, so it is none.
bool isBelowDigits(const Term& term, const Color& sum) {
  constexpr Real kHalfADigit = 5e-7;  // the sum has six
  const Color c = contributionOf(term);
  const auto below = [](Real part, Real all) { return std::abs(part) <= kHalfADigit * std::abs(all); };
  return !isBlack(c) && below(c.r, sum.r) && below(c.g, sum.g) && below(c.b, sum.b);
}

// --- the tree ---

/// Rays deeper than so many levels stand at the same margin, and name the ray that sent them.
constexpr int kMostIndented = 12;

class TreeText {
 public:
  TreeText(const PixelFacts& facts, bool color)
      : scene_(facts.scene), rays_(facts.rays), time_(facts.settings.time), color_(color) {}

  std::string all() {
    for (int i = 0; i < static_cast<int>(rays_.size()); ++i)
      if (at(i).node->parent < 0) ray(i, i > 0 ? "\n" : "", "");
    return std::move(text_);
  }

 private:
  const ExplainedRay& at(int index) const { return rays_[static_cast<std::size_t>(index)]; }

  /// `first` stands before the ray's first line, `rest` before the others.
  void ray(int index, const std::string& first, const std::string& rest) {
    const ExplainedRay& explained = at(index);
    const RayNode& node = *explained.node;
    const std::vector<int>& children = explained.children;
    margin_ = rest + (children.empty() ? "    " : "|   ");

    const std::string kind(trace::name(node.kind));
    const std::string name = "#" + std::to_string(index) + " " + kind + " ray";
    std::string title = name;
    if (color_) title = std::string(look(node.kind).terminal) + name + "\033[0m";
    if (!explained.light.empty()) title += " to " + printable(explained.light);
    if (node.wavelength != 0) title += " of " + digits(node.wavelength) + " nm";
    const std::size_t room = std::size_t{4} * kMostIndented;
    if (rest.size() >= room) title += " of #" + std::to_string(node.parent);
    text_ +=
        first + title + ": depth " + std::to_string(node.depth) + ", weight " + digits(node.weight) + "\n";
    line("from " + digits(node.ray.origin) + " along " + digits(node.ray.direction));
    for (const std::string& ignored : explained.ignored) line(printable("no surface for light: " + ignored));
    if (node.hit) hit(explained);
    if (node.kind == RayKind::shadow)
      shadow(explained);
    else if (node.kind == RayKind::light)
      line("a vertex that camera paths are connected with");
    else
      terms(explained);
    if (!explained.sentence.empty()) line(printable("-> " + explained.sentence));
    line("   cost " + counted(node.nodes, "node") + " visited, " + counted(node.tests, "shape") + " tested");

    for (std::size_t i = 0; i < children.size(); ++i) {
      text_ += rest + "|\n";
      const char* indent = rest.size() >= room ? "" : i + 1 < children.size() ? "|   " : "    ";
      ray(children[i], rest + "+-- ", rest + indent);
    }
  }

  void line(const std::string& words) { text_ += margin_ + words + "\n"; }

  void hit(const ExplainedRay& explained) {
    const RayNode& node = *explained.node;
    const Hit& hit = *node.hit;
    const NamedBody& object = *explained.hit;
    std::string what = "hits ";
    if (!object.ownName.empty()) what += "\"" + object.ownName + "\", ";
    what += object.shape;
    if (const std::string place = shortPlace(object.place); !place.empty()) what += " (" + place + ")";
    line(printable(what + (object.isMesh ? " triangle " : " part ") + std::to_string(hit.part) +
                   ", made of " + object.madeOf + ", at distance " + digits(hit.t)));
    if (node.parent < 0)
      if (const std::string calls = callsThatMade(scene_, hit.object, time_); !calls.empty())
        line(printable("  made " + calls));
    const SurfacePoint& s = hit.surface;
    const WhittedTerms& whittedTerms = whitted(*node.bsdf);
    const bool lets = whittedTerms.transmits() || whittedTerms.passage == Passage::straight;
    std::string side =
        lets ? (hit.leaving ? "leaving it" : "entering it") : (hit.leaving ? "from inside" : "from outside");
    const Indices& indices = node.indices;
    const auto index = [&](Real value, std::uint32_t body, Real priority) {
      if (!indices.nested) return digits(value);
      return digits(value) + " (" + printable(fillingText(scene_, body, priority)) + ")";
    };
    if (whitted(*node.bsdf).passage == Passage::straight)
      side += ": a pane that bends nothing";
    else if (whitted(*node.bsdf).transmits())
      side += ": index " + index(indices.before, indices.objectBefore, indices.priorityBefore) + " -> " +
              index(indices.behind, indices.objectBehind, indices.priorityBehind);
    if (hit.twoSided && !lets) side += "; both sides are shaded";
    if (hit.opacity < 1) side += "; opacity " + digits(hit.opacity);
    const Vec2 uv = s.uv;
    line(side + "; uv (" + digits(uv.x) + ", " + digits(uv.y) + ")");
    line("point " + digits(s.point) + ", normal " + digits(s.normal));
    if (!(s.shading == s.normal)) line("shading normal " + digits(s.shading));
    if (node.raised)
      line("its rays to light start at " + digits(*node.raised) + ", " +
           digits(length(*node.raised - s.point)) +
           " off the facet: on the smooth surface of the corners' normals");
  }

  /// The largest first. The sum is that of all, in the order of the equation, which JSON keeps.
  void terms(const ExplainedRay& explained) {
    const RayNode& node = *explained.node;
    Color sum;
    for (const Term& term : node.terms) sum += contributionOf(term);
    std::vector<std::size_t> order;
    std::size_t left = 0;
    std::string rays;
    for (std::size_t i = 0; i < node.terms.size(); ++i) {
      const Term& term = node.terms[i];
      if (!isBelowDigits(term, sum)) {
        order.push_back(i);
        continue;
      }
      ++left;
      if (term.ray >= 0) rays += " #" + std::to_string(term.ray);
    }
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return sizeOfTerm(node.terms[a]) > sizeOfTerm(node.terms[b]);
    });
    for (const std::size_t i : order) {
      const Term& term = node.terms[i];
      const ExplainedTerm& named = explained.terms[i];
      const std::string kind(Term::kNames[static_cast<std::size_t>(term.kind)]);
      if (term.light) {
        light(term, named, node);
        continue;
      }
      if (term.dark) {
        line("+ " + printable(named.light) + " 0; " + std::string(sentence(*term.dark)));
        continue;
      }
      const Color value = term.factor * term.value;
      const bool isHole = term.kind == Term::Kind::hole;
      const bool covers = (term.kind == Term::Kind::fog || isHole) && term.ray < 0 && term.value.g <= 0 &&
                          !isBlack(term.value);
      std::string words = "+ " + kind + " " + digits(value);
      if (covers) {
        line(words + (isHole ? ": so much of the surface is not there: " + digits(term.factor.r)
                             : ": it covers " + digits(term.factor.r) + " of what lies behind"));
        continue;
      }
      const std::string product = digits(term.factor) + " * " + digits(term.value);
      if (term.ray >= 0)
        words += "\n" + margin_ + "    = " + product + " of #" + std::to_string(term.ray);
      else if (!(term.factor == Color(1)) && !isBlack(value))
        words += " = " + product;
      if (term.chance && term.chance->density > 0) {
        const ChanceTerm& chance = *term.chance;
        words += "\n" + margin_ + "    random, density " + digits(chance.density);
        if (chance.other > 0)
          words +=
              ", that of the other strategy " + digits(chance.other) + ": MIS weight " + digits(chance.share);
      }
      if (term.connection)
        words += "\n" + margin_ + "    s = " + std::to_string(term.connection->light) +
                 " from the light, t = " + std::to_string(term.connection->camera) +
                 " from the camera: MIS weight " + digits(term.connection->share);
      if (term.scattered) words += "\n" + margin_ + "    light of " + printable(named.light);
      if (term.medium) words += "\n" + margin_ + "    " + medium(*term.medium, *named.medium);
      if (term.body)
        words += "\n" + margin_ + "    it went in " + digits(term.body->distance) + " away" +
                 (term.body->steps > 0
                      ? ", and was scattered " + counted(static_cast<std::size_t>(term.body->steps), "time")
                      : "");
      if (term.cache)
        words += "\n" + margin_ + "    blended of " + counted(term.cache->records, "place") +
                 " of the irradiance cache";
      if (term.photons)
        words += "\n" + margin_ + "    of " + counted(term.photons->count, "photon") + " within " +
                 digits(term.photons->radius);
      line(words);
    }
    constexpr std::size_t kMostNamed = 40;  // characters
    if (left > 0)
      line("+ " + counted(left, "term") + " below the last digit of the sum" +
           (rays.empty() || rays.size() > kMostNamed ? "" : ", of" + rays));
    for (std::size_t i = 0; i < node.filters.size(); ++i) {
      const Filter& filter = node.filters[i];
      line("through " + printable(explained.filters[i].name) + " at distance " + digits(filter.t) +
           ", which passes " + digits(filter.factor));
    }
    if (!(node.through == Color(1)))
      line((node.filters.empty() ? "* medium " : "* ") + digits(node.through) + " passes");
    line("= " + digits(node.radiance));
  }

  static std::string medium(const MediumTerm& m, const NamedBody& body) {
    const std::string by = body.object ? printable(body.name) : "fog";
    switch (m.what) {
      case MediumTerm::What::covers: return "attenuation by media on the way";
      case MediumTerm::What::glows: return "emitted on the way";
      case MediumTerm::What::scatters: return "scattered by " + by + " at distance " + digits(m.t);
      case MediumTerm::What::follows: break;
    }
    return "scattered by " + by + " at distance " + digits(m.t) + ", where it comes from";
  }

  void light(const Term& term, const ExplainedTerm& named, const RayNode& node) {
    const LightTerm& light = *term.light;
    const bool none = isBlack(term.factor), always = term.ray < 0;
    const Real shadow = whitted(*node.bsdf).shadow;
    const Vec3 normal = node.hit->surface.shading;
    const bool away = dot(light.arriving.toLight, normal) * dot(node.ray.direction, normal) >= 0;
    line("+ " + printable(named.light) + " " + digits(term.factor * term.value) +
         (none     ? (away ? "; faces away, no shadow ray" : "; scatters none of it, no shadow ray")
          : always ? (shadow == 1 ? "; it casts no shadows" : "; the part that no shadow takes away")
                   : ""));
    const Illumination& from = light.arriving;
    const std::string lit = from.attenuation == 1 ? "" : " * attenuation " + digits(from.attenuation);
    if (none) return;
    std::string highlight = " + specular " + digits(light.scatter.specular);
    if (!isBlack(from.extraHighlight * light.scatter.specular))
      highlight += " * (1 + extra " + digits(from.extraHighlight) + " / light)";
    line("    = light " + digits(from.color) + lit + " * (diffuse " + digits(light.scatter.diffuse) +
         highlight + ")" +
         (light.share == 1 ? ""
          : light.probability < 1
              ? " * " + digits(light.share) + ", for it was chosen among all lights with probability " +
                    digits(light.probability)
              : " * " + digits(light.share) + " as one of several rays"));
    if (always && shadow == 1) return;
    if (always) return line("      * " + digits(1 - shadow) + " = 1 - the material's shadow");
    line((shadow == 1 ? "" : "      * the material's shadow " + digits(shadow) + "\n" + margin_) +
         "      * passed " + digits(term.value) + " of #" + std::to_string(term.ray));
  }

  void shadow(const ExplainedRay& explained) {
    const RayNode& node = *explained.node;
    if (std::isfinite(node.tMost)) line("to the light at distance " + digits(node.tMost));
    for (std::size_t i = 0; i < node.filters.size(); ++i) {
      const Filter& filter = node.filters[i];
      const std::string at = std::isfinite(filter.t) ? " at distance " + digits(filter.t) : " on its way";
      if (filter.shadowless) {
        line("past " + printable(explained.filters[i].name) + at + ", which casts no shadow");
        continue;
      }
      line("* " + digits(filter.factor) + " through " + printable(explained.filters[i].name) + at);
    }
    line("= " + digits(node.radiance) + " passes");
  }

  const Scene& scene_;
  const std::vector<ExplainedRay>& rays_;
  const Real time_;
  bool color_;
  std::string text_, margin_;
};

/// Where most of the sample's light comes from; "" where a single ray says it.
std::string sharesText(const RayTree& tree, const Scene& scene) {
  constexpr std::size_t kMost = 6;
  constexpr double kLeast = 0.005;
  const std::vector<LightShare> shares = lightShares(tree, scene);
  if (tree.nodes.size() < 2) return "";
  if (shares.empty()) return "No light comes along any of its rays.\n\n";
  std::string lines = "Where the light of this sample comes from:\n";
  double told = 0;
  for (std::size_t i = 0; i < std::min(kMost, shares.size()) && shares[i].share >= kLeast; ++i) {
    char percent[16];
    std::snprintf(percent, sizeof percent, "%5.1f %%", 100 * shares[i].share);
    std::string line = percent + ("  " + printable(shares[i].from));
    constexpr std::size_t kWidest = 100;
    if (const std::size_t way = line.find(", by "); line.size() > kWidest && way != line.npos)
      line.insert(way + 1, "\n         ");
    lines += line + "\n";
    told += shares[i].share;
  }
  char rest[48];
  std::snprintf(rest, sizeof rest, "%5.1f %%  by other strategies\n", 100 * (1 - told));
  return lines + (1 - told >= 0.0005 ? rest : "") + "\n";
}

/// Each way in which paths from both ends were joined, and what it counts; "" where there is none.
std::string waysText(const RayTree& tree, const Scene& scene) {
  std::string lines;
  int places = 0;
  for (const PathWay& way : pathWays(tree)) {
    if (lines.empty()) lines = "The paths of the sample, s vertices from the light and t from the camera:\n";
    if (way.places() != places) lines += "  " + std::to_string(way.places()) + " places\n";
    places = way.places();
    const std::string counts = way.camera == 1
                                   ? "  "
                                   : "  MIS weight " + digits(way.share) + ", brings " + digits(way.brings) +
                                         ", alone " + digits(way.alone()) + "; ";
    lines += "    s = " + std::to_string(way.light) + ", t = " + std::to_string(way.camera) + counts + "#" +
             std::to_string(way.between < 0 ? way.end : way.between) + " " +
             printable(sentence(way, tree, scene)) + "\n";
  }
  return lines.empty() ? "" : lines + "\n";
}

/// The moves of a chain around the one that came nearest to the pixel; "" without a chain.
std::string chainText(const ChainWalk* chain) {
  constexpr int kAround = 8;
  if (!chain || chain->moves.empty()) return "";
  const auto last = static_cast<int>(chain->moves.size()) - 1;
  std::string lines =
      "A chain of the picture (" + chain->summary() + "), and the move that came nearest to the pixel:\n";
  for (int i = std::max(0, chain->nearest - kAround); i <= std::min(last, chain->nearest + kAround); ++i) {
    const ChainMove& move = chain->moves[static_cast<std::size_t>(i)];
    lines += (i == chain->nearest ? "  > " : "    ") +
             (move.number < 0 ? "" : "move " + std::to_string(move.number) + ": ") + sentence(move) + "\n";
  }
  return lines + "\n";
}

/// The light image in this pixel: light-traced paths of all pixels that reach the camera.
std::string lightImageText(const PixelFacts& facts) {
  if (!facts.light)
    return "            the picture has more: the light image, that is, light-traced paths of all pixels, "
           "such as\n            caustics on diffuse objects; --light-image finds it\n";
  const LightImagePixel& image = facts.light->image;
  std::string lines = "light image " + exact(image.value) + " by " + std::to_string(image.landed) +
                      " paths that landed here, of " + std::to_string(image.paths) +
                      (facts.settings.noiseTarget > 0 ? "\nof all samples (--noise-target takes fewer) "
                       : facts.chain                  ? "\nby `bdpt`   "
                                                      : "\nthe picture ") +
                      exact(facts.rendered + image.value) + "\n";
  if (!image.brightest.empty()) lines += "The brightest of these paths:\n";
  for (std::size_t i = 0; i < image.brightest.size(); ++i) {
    const Landing& l = image.brightest[i];
    lines += "  " + digits(l.brings) + "  " + printable(facts.light->routes[i]) + ": --pixel " +
             std::to_string(l.x) + "," + std::to_string(l.y) + " --sample " + std::to_string(l.sample) + "\n";
  }
  return lines;
}

/// The value of the light in an 8-bit file, if that is not the light itself.
std::string shownText(const PixelFacts& facts) {
  const Development development = developmentOf(facts.settings);
  if (development == Development{}) return "";
  std::string steps, before;
  for (const Option& option : options())
    if (const std::string value = option.get(facts.settings);
        (option.group == "Tone" || option.name == "tone") && value != option.get(Settings{})) {
      const bool wantsPicture = option.name == "bloom" || option.name == "dither" || value == "stretch";
      std::string& list = wantsPicture ? before : steps;
      list += (list.empty() ? "" : ", ") + std::string(option.name) + " " + value;
    }
  if (facts.settings.denoise) before += (before.empty() ? "" : ", ") + std::string("--denoise");
  const Color shown = developed(facts.rendered, development);
  std::string text = "the file    ";
  for (const double channel : {shown.r, shown.g, shown.b})
    text += std::to_string(toLevel(channel, facts.settings.rounding)) + " ";
  const bool isLeft = facts.explanation.tree.x < facts.width / 2;
  const std::string eye = isLeft ? ", of the left eye" : ", of the right eye";
  return text + "of 255" + (isAnaglyph(facts.settings.stereo) ? eye : "") +
         (steps.empty() ? "" : ", by " + steps) + (before.empty() ? "" : "; without " + before) + "\n";
}

}  // namespace

bool PixelFacts::agrees() const {
  const RayTree& tree = explanation.tree;
  return sumsUp(tree) && sameBits(explanation.pixel, rendered) &&
         sameBits(tree.nodes[0].radiance, explanation.samples[static_cast<std::size_t>(tree.sample)]);
}

std::string explainText(const PixelFacts& facts, bool color) {
  const Explanation& e = facts.explanation;
  std::string text = (facts.scene.file.empty() ? "" : printable(facts.scene.file) + ", ") + "pixel " +
                     std::to_string(e.tree.x) + "," + std::to_string(e.tree.y) + " of " +
                     std::to_string(facts.width) + " x " + std::to_string(facts.height) + ", sample " +
                     std::to_string(e.tree.sample) + " of " + std::to_string(e.samples.size());
  if (e.tree.moment >= 0)
    text += ", at " + toText(timeOfMoment(facts.settings, e.tree.moment)) + " s, moment " +
            std::to_string(e.tree.moment) + " of " + std::to_string(facts.settings.moments);
  text += "\n\n";
  text += sharesText(e.tree, facts.scene);
  text += TreeText(facts, color).all() + "\n" + waysText(e.tree, facts.scene) + chainText(facts.chain);
  for (std::size_t i = 0; i < e.samples.size(); ++i)
    text += "sample " + std::to_string(i) + "  " + exact(e.samples[i]) +
            (static_cast<int>(i) == e.tree.sample ? "  (above)" : "") +
            (e.corners.empty() ? "" : "  at " + toText(e.corners[i].x) + "," + toText(e.corners[i].y)) +
            (e.weights[i] == 1 ? "" : "  counts " + toText(e.weights[i])) +
            (isFinite(e.samples[i]) ? "" : "  not finite: left out") + "\n";
  if (e.settled)
    text += "no more: the error of their mean is at most " + toText(facts.settings.noiseTarget) + "\n";
  if (!e.corners.empty())
    text +=
        "rays through corners of the pixel and of the squares into which it falls; 0,0 is its lower left "
        "corner\n";
  const bool splats = hasLightImage(facts.settings);
  text += "their mean  " + exact(e.pixel) +
          (splats        ? "\nits paths   "
           : facts.chain ? "\nby `path`   "
                         : "\nthe picture ") +
          exact(facts.rendered) + "\n";
  if (facts.chain)
    text += "            chains make the picture, in no order of pixels: it tends to the same" +
            std::string(splats ? ", and to the light image" : "") + "\n";
  if (splats) text += lightImageText(facts);
  if (facts.settings.denoise) text += "--denoise then makes it a mean of pixels around it that are alike\n";
  const bool whole =
      !facts.chain && !splats && !facts.settings.denoise;  // nothing else has a part in the pixel
  if (!facts.chain && !splats) text += shownText(facts);
  const std::string pixel = whole    ? "the picture's pixel"
                            : splats ? "the contribution of the pixel's own paths"
                                     : "the pixel as it was traced";
  text += facts.agrees() ? "The rays above sum to " + pixel + ", bit for bit.\n"
                         : "The rays above do NOT sum to " + pixel + ": please report this.\n";
  return text;
}

}  // namespace trace
