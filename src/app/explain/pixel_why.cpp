#include "app/explain/pixel_why.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "app/explain/ray_view.h"
#include "app/explain/ray_words.h"
#include "base/text.h"
#include "math/elementary.h"
#include "scene/groups.h"
#include "scene/options.h"
#include "shading/bsdf.h"
#include "shading/lights/plain_lights.h"

namespace trace {
namespace {

constexpr Real kBlack = 0.02, kDark = 0.12;  // as shown: 1 is white

/// Light that the pixel lacks: how much about, on which ray, and why.
struct Loss {
  Real amount = 0;
  int ray = -1;
  std::string why;
  std::vector<WhyCure> cures{};
  std::string_view head = "Darker than it could be: ";
};

Real brightness(const Color& c) { return std::max(maxComponent(c), 0.0); }

/// The object within a sentence: its name, or "the square (scene.ray:3)" where it has none.
std::string thing(const Scene& scene, std::uint32_t object) {
  const NumberedObject found = objectOf(scene, object);
  const bool named = !found.object || !found.object->name.empty();
  return (named ? "" : "the ") + objectName(scene, object);
}

/// A sentence that begins with an article begins with a capital letter.
std::string begun(std::string sentence) {
  if (sentence.starts_with("the ")) sentence.front() = 'T';
  return sentence + ".";
}

WhyCure select(const Scene& scene, std::uint32_t object) {
  WhyCure cure{"Select " + objectName(scene, object)};
  cure.object = object;
  return cure;
}

WhyCure byOption(std::string_view option, const std::string& value) {
  WhyCure cure{std::string(option) + " " + value};
  cure.option = option;
  cure.value = value;
  return cure;
}

/// "the ray that should leave ball", "the ray that ball should reflect".
std::string unsentRay(RayKind unsent, const RayNode& node, const Scene& scene) {
  if (!node.hit) return "the next ray";
  const std::string object = thing(scene, node.hit->object);
  switch (unsent) {
    case RayKind::refraction:
      return std::string("the ray that should ") + (node.hit->leaving ? "leave " : "enter ") + object;
    case RayKind::reflection: return "the ray that " + object + " should reflect";
    default: return "the ray that should bounce off " + object;
  }
}

/// About how much light an unsent ray would have brought, if what it came to were as bright as this. A bounce
/// that would be one of many is taken to bring as much as the camera ray, whose path has the same
/// surroundings.
constexpr Real kGuess = 0.5;
Real unsentLight(RayKind unsent, const RayNode& node, Real shown) {
  if (node.bsdf && unsent == RayKind::reflection) return kGuess * brightness(whitted(*node.bsdf).reflective);
  if (node.bsdf && unsent == RayKind::refraction)
    return kGuess * brightness(whitted(*node.bsdf).transmissive);
  constexpr Real kLeast = 1e-6;  // so that a black pixel still blames the limit
  return std::clamp(shown, kLeast, kGuess);
}

/// A shadow ray that something stops, and how much light that takes from the pixel.
struct Shadow {
  Real amount;
  int ray;
  std::uint32_t light;
  Blocked stop;
};

class Search {
 public:
  Search(const RayTree& tree, const Scene& scene, const Settings& settings)
      : tree_(tree),
        scene_(scene),
        settings_(settings),
        shown_(brightness(rayAt(tree, 0).radiance)),
        whole_(std::max(brightness(rayAt(tree, 0).weight), 1e-30)) {}

  /// The losses, the largest first.
  std::vector<Loss> run() {
    for (int i = 0; i < static_cast<int>(tree_.nodes.size()); ++i) {
      const RayNode& node = rayAt(tree_, i);
      if (node.kind == RayKind::shadow || node.kind == RayKind::light) continue;
      const Color weight = node.weight * node.through * (1 / whole_);
      for (const RayEnd& end : node.ends) lookAt(end, i, brightness(weight));
      shadows_.clear();
      for (const Term& term : node.terms) lookAt(term, i, weight);
      offerShadows(node);
    }
    std::stable_sort(losses_.begin(), losses_.end(),
                     [](const Loss& a, const Loss& b) { return a.amount > b.amount; });
    return std::move(losses_);
  }

 private:
  void offer(Loss loss) {
    if (loss.amount > 0) losses_.push_back(std::move(loss));
  }

  void lookAt(const RayEnd& end, int ray, Real weight) {
    const RayNode& node = rayAt(tree_, ray);
    if (const auto* limit = std::get_if<DepthLimit>(&end)) offerDeeper(*limit, ray, weight);
    if (const auto* small = std::get_if<BelowThreshold>(&end); small && small->contribution > 0)
      offer({small->contribution * kGuess,
             ray,
             unsentRay(small->unsent, node, scene_) + " was not sent: threshold " + toText(small->threshold),
             {byOption("threshold", "0")}});
    if (std::holds_alternative<TotalInternalReflection>(end) && node.hit && node.bsdf) {
      // A mirrored ray may bring what cannot be refracted.
      Real sent = 0;
      for (const Term& term : node.terms)
        if (term.goesOn()) sent += brightness(term.factor);
      const WhittedTerms& terms = whitted(*node.bsdf);
      const Real lost = brightness(terms.transmissive) - std::max(0.0, sent - brightness(terms.reflective));
      const std::string object = thing(scene_, node.hit->object);
      Loss loss{weight * kGuess * lost,
                ray,
                "the ray cannot leave " + object + " there (total internal reflection)",
                {select(scene_, node.hit->object)}};
      if (settings_.fresnel == Fresnel::constant) loss.cures.push_back(byOption("fresnel", "exact"));
      offer(std::move(loss));
    }
    if (std::holds_alternative<LeftScene>(end)) offerEmptiness(node, ray, weight);
  }

  void offerDeeper(const DepthLimit& limit, int ray, Real weight) {
    constexpr int kEnough = 5;  // for glass that light enters and leaves, seen through more glass
    const RayNode& node = rayAt(tree_, ray);
    const int next = limit.limit + 1, far = next < kEnough ? kEnough : 2 * limit.limit;
    offer(
        {weight * unsentLight(limit.unsent, node, shown_),
         ray,
         unsentRay(limit.unsent, node, scene_) + " was not sent: depth limit " + std::to_string(limit.limit),
         {byOption("depth", std::to_string(next)), byOption("depth", std::to_string(far))}});
  }

  /// A mirrored or refracted ray that hits nothing, in a dark pixel.
  void offerEmptiness(const RayNode& node, int ray, Real weight) {
    const Real scale = math::exp2(settings_.exposure);
    if (node.parent < 0 || shown_ * scale >= kDark || brightness(node.radiance) * scale >= kBlack) return;
    const RayNode& from = rayAt(tree_, node.parent);
    if (!from.hit || (node.kind != RayKind::refraction && node.kind != RayKind::reflection)) return;
    const std::string object = thing(scene_, from.hit->object);
    const bool inSight = std::any_of(scene_.background.colors.begin(), scene_.background.colors.end(),
                                     [](const Color& color) { return !isBlack(color); });
    offer({weight * kGuess, ray,
           (node.kind == RayKind::reflection ? "the ray that " + object + " reflects"
            : from.hit->leaving              ? "the ray that leaves " + object
                                             : "the ray that enters " + object) +
               " left the scene, " +
               (inSight && (!node.outside || node.outside->source == Outside::Source::nothing)
                    ? "and only camera rays see the background"
                    : "where the background is black")});
  }

  void lookAt(const Term& term, int ray, const Color& weight) {
    const RayNode& node = rayAt(tree_, ray);
    if (!term.light || !node.hit) return;
    const std::uint32_t light = term.light->light;
    if (term.ray >= 0) {
      const RayNode& shadow = rayAt(tree_, term.ray);
      const Real amount = brightness(weight * term.factor);
      for (const RayEnd& end : shadow.ends)
        if (const auto* stop = std::get_if<Blocked>(&end))
          shadows_.push_back({amount, term.ray, light, *stop});
        else if (isFiltered(shadow))
          offer({amount * (1 - brightness(shadow.radiance)),
                 term.ray,
                 filtersOf(shadow, scene_) + " filters " + shortLightName(scene_, light) + " to " +
                     percent(brightness(shadow.radiance)),
                 {},
                 "In shadow: "});
      return;
    }
    // No shadow ray was sent: the surface scatters nothing of it.
    if (!scatters(node)) return;
    const std::string object = thing(scene_, node.hit->object), name = shortLightName(scene_, light);
    const SurfacePoint& at = node.hit->surface;
    const Vec3& toward = term.light->arriving.toLight;
    const Real arrives = brightness(term.light->arriving.intensity());
    const Vec3 side = dot(at.normal, node.ray.direction) > 0 ? -at.normal : at.normal;
    const bool facing = dot(side, toward) > 0, shaded = dot(at.shading, side) < 0;
    if (facing && (shaded || dot(at.shading, toward) * (dot(at.shading, at.normal) < 0 ? -1 : 1) < 0))
      offer({brightness(weight) * arrives * 0.3,
             ray,
             "the normal of " + object + " points away from " + name + ", but its surface faces it",
             {select(scene_, node.hit->object)}});
    else if (!facing)
      offer({brightness(weight) * arrives * 1e-3, ray, object + " faces away from " + name});
  }

  /// Lights can make the surface bright. Glass shows what is behind it instead.
  bool scatters(const RayNode& node) const {
    if (node.bsdf && !whitted(*node.bsdf).transmits()) return true;
    return std::any_of(node.materials.begin(), node.materials.end(), [&](const MaterialShare& share) {
      return share.material != MaterialMix::kClear &&
             !isBlack(phongOf(scene_.materials[share.material].model).diffuse);
    });
  }

  /// The shadows on one hit point, as one loss.
  void offerShadows(const RayNode& node) {
    if (shadows_.empty()) return;
    const Shadow* worst = &shadows_.front();
    Loss loss;
    std::vector<std::uint32_t> lights, blockers;
    const auto note = [](std::vector<std::uint32_t>& all, std::uint32_t one) {
      if (std::find(all.begin(), all.end(), one) == all.end()) all.push_back(one);
    };
    for (const Shadow& shadow : shadows_) {
      loss.amount += shadow.amount;
      if (shadow.amount > worst->amount) worst = &shadow;
      note(lights, shadow.light);
      note(blockers, shadow.stop.object);
    }
    loss.ray = worst->ray;
    loss.head = "In shadow: ";
    const std::string object = thing(scene_, node.hit->object), blocked = lightsText(lights);
    if (blockers.size() == 1 && blockers.front() == node.hit->object) {
      loss.why = object + " is in its own shadow: it blocks " + blocked;
    } else {
      std::vector<std::string> names;
      for (const std::uint32_t blocker : blockers)
        names.push_back(blocker == node.hit->object ? object + " itself" : thing(scene_, blocker));
      loss.why = listed(names) + (names.size() > 1 ? " block " : " blocks ") + blocked + " from " + object;
    }
    loss.cures.push_back(select(scene_, worst->stop.object));
    const bool clear = std::any_of(worst->stop.materials.begin(), worst->stop.materials.end(),
                                   [&](const MaterialShare& share) {
                                     return share.material != MaterialMix::kClear &&
                                            phongOf(scene_.materials[share.material].model).transmits();
                                   });
    if (clear && settings_.glassShadows == GlassShadows::black) {
      loss.why += ": it is clear, but glass-shadows is black";
      loss.cures.push_back(byOption("glass-shadows", "filtered"));
    }
    offer(std::move(loss));
  }

  /// "lamp and sun", or "all three lights" where there are no more.
  std::string lightsText(const std::vector<std::uint32_t>& lights) const {
    const auto all = std::count_if(scene_.lights.begin(), scene_.lights.end(),
                                   [](const LightSource& source) { return !isAmbient(source.light); });
    if (lights.size() > 2 && static_cast<std::ptrdiff_t>(lights.size()) == all)
      return "all " + (all == 3 ? "three" : std::to_string(all)) + " lights";
    std::vector<std::string> names;
    for (const std::uint32_t light : lights) names.push_back(shortLightName(scene_, light));
    return listed(names);
  }

  const RayTree& tree_;
  const Scene& scene_;
  const Settings& settings_;
  const Real shown_, whole_;
  std::vector<Shadow> shadows_;
  std::vector<Loss> losses_;
};

/// Keeps the options whose change is seen; false if no cure is left then.
class CureTrial {
 public:
  CureTrial(const Retrace& retrace, const Color& now, Real scale)
      : retrace_(retrace), now_(now), scale_(scale) {}

  bool keepsWhatHelps(Loss& loss) {
    const auto isOption = [](const WhyCure& cure) { return !cure.option.empty(); };
    const bool had = std::any_of(loss.cures.begin(), loss.cures.end(), isOption);
    std::erase_if(loss.cures, [&](const WhyCure& cure) { return isOption(cure) && !helps(cure); });
    return !had || !loss.cures.empty();
  }

 private:
  bool helps(const WhyCure& cure) {
    if (!retrace_) return true;
    const auto known = tried_.find(cure.label);
    if (known != tried_.end()) return known->second;
    const std::optional<Color> then = retrace_(cure.option, cure.value);
    constexpr Real kSeen = 0.1;  // share of the pixel
    const Real least = std::max(kBlack, kSeen * brightness(now_) * scale_);
    const Color change = then ? *then + now_ * -1 : Color(0);
    const Real most = std::max({std::abs(change.r), std::abs(change.g), std::abs(change.b)}) * scale_;
    return tried_[cure.label] = !then || most > least;
  }

  const Retrace& retrace_;
  const Color now_;
  const Real scale_;
  std::map<std::string, bool> tried_;
};

/// The largest loss that matters in a pixel that is shown so bright, with cures that were tried.
std::optional<Loss> lossOf(const RayTree& tree, const Scene& scene, const Settings& settings,
                           const Retrace& retrace, Real shown, Real scale) {
  CureTrial trial(retrace, rayAt(tree, 0).radiance, scale);
  for (Loss& loss : Search(tree, scene, settings).run()) {
    const bool matters = loss.amount * scale > std::max(shown, 0.5 * kBlack);
    if (!matters && shown >= kBlack) break;
    if (trial.keepsWhatHelps(loss)) return std::move(loss);
  }
  return {};
}

/// ", filtered by glass to 31 %" for light that arrives through something.
std::string filterOf(const RayTree& tree, const Scene& scene, const WhySummand& summand) {
  if (summand.ray < 0) return "";
  const RayNode& ray = rayAt(tree, summand.ray);
  if (ray.kind != RayKind::shadow || !isFiltered(ray)) return "";
  return ", filtered by " + filtersOf(ray, scene) + " to " + percent(brightness(ray.radiance));
}

/// The summand in words: "the light of sun", "a reflection".
std::string phraseOf(Term::Kind kind, const std::string& light) {
  using Kind = Term::Kind;
  switch (kind) {
    case Kind::emissive: return "its own emission";
    case Kind::ambient: return "ambient light";
    case Kind::light: return "the light of " + light;
    case Kind::caustic: return "light that glass or a mirror focuses";
    case Kind::photons: return "light from the photon map";
    case Kind::reflection: return "a reflection";
    case Kind::refraction: return "what is seen through it";
    case Kind::bounce: return "indirect light";
    case Kind::lamp: return light.empty() ? "the light of emissive objects" : "the light of " + light;
    case Kind::joined: return "light along connected paths";
    case Kind::background: return "the background";
    case Kind::fog: return "light that fog scatters";
    case Kind::medium: return "light that its medium scatters";
    case Kind::subsurface: return "light that is scattered below its surface";
    case Kind::hole: return "what is behind its holes";
    case Kind::outline: return "its outline";
    case Kind::irradiance: return "indirect light from the irradiance cache";
  }
  return "";
}

/// The object or light that the camera ray came to.
std::string thingSeen(const RayNode& root, const Scene& scene) {
  return root.hit ? thing(scene, root.hit->object) : "";
}

}  // namespace

int lastBelow(const RayTree& tree, int ray) {
  std::vector<char> below(tree.nodes.size());
  int last = ray;
  below[static_cast<std::size_t>(ray)] = 1;
  for (int i = ray + 1; i < static_cast<int>(tree.nodes.size()); ++i) {
    const int parent = rayAt(tree, i).parent;
    if (parent < 0 || !below[static_cast<std::size_t>(parent)]) continue;
    below[static_cast<std::size_t>(i)] = 1;
    last = i;
  }
  return last;
}

std::vector<WhySummand> sumOf(const RayTree& tree, const Scene& scene, int ray) {
  std::vector<WhySummand> sum;
  const RayNode& root = rayAt(tree, ray);
  for (const Term& term : root.terms) {
    std::string name(Term::kNames[static_cast<std::size_t>(term.kind)]);
    std::string brief = name;
    if (term.light) {
      brief = shortLightName(scene, term.light->light);
      name += " " + brief;
    }
    const Color color =
        term.factor * (term.ray < 0 ? term.value : rayAt(tree, term.ray).radiance) * root.through;
    if (term.dark || (isBlack(color) && term.ray < 0)) continue;
    const auto same =
        std::find_if(sum.begin(), sum.end(), [&](const WhySummand& s) { return s.name == name; });
    const int last = term.ray < 0 ? ray : lastBelow(tree, term.ray);
    if (same == sum.end()) {
      sum.push_back({name, brief, color, term.ray, last, phraseOf(term.kind, term.light ? brief : "")});
    } else {
      same->color = same->color + color;
      same->last = std::max(same->last, last);
    }
  }
  constexpr Real kNothing = 1e-6;  // share of the whole: less than digits and swatches show
  Color whole;
  for (const WhySummand& each : sum) whole = whole + each.color;
  std::erase_if(sum, [&](const WhySummand& each) {
    const Real most =
        maxComponent(Color(std::abs(each.color.r), std::abs(each.color.g), std::abs(each.color.b)));
    return most > 0 && most < kNothing * brightness(whole);
  });
  return sum;
}

std::string equationOf(const RayTree& tree, const Scene& scene, int ray) {
  const RayNode& node = rayAt(tree, ray);
  if (node.kind == RayKind::shadow) return "passes " + channels(node.radiance);
  std::string text = channels(node.radiance);
  const char* sign = " = ";
  for (const WhySummand& each : sumOf(tree, scene, ray))
    text += std::exchange(sign, " + ") + each.name + " " + channels(each.color);
  return text;
}

Color sumAfter(const std::vector<WhySummand>& sum, int rays) {
  Color after;
  for (const WhySummand& each : sum)
    if (each.last < rays) after = after + each.color;
  return after;
}

namespace {

bool litByEmissiveAlone(const Scene& scene) {
  return std::all_of(scene.lights.begin(), scene.lights.end(),
                     [](const LightSource& source) { return isAmbient(source.light); }) &&
         std::any_of(scene.objects.begin(), scene.objects.end(), [&](const Object& object) {
           return object.material < scene.materials.size() &&
                  !isBlack(phongOf(scene.materials[object.material].model).emissive);
         });
}

}  // namespace

PixelWhy whyOf(const RayTree& tree, const Scene& scene, const Settings& settings, const Retrace& retrace) {
  PixelWhy why;
  if (tree.nodes.empty()) return why;
  const RayNode& root = rayAt(tree, 0);
  const Real scale = math::exp2(settings.exposure);
  const Real shown = brightness(root.radiance) * scale;
  const bool black = shown < kBlack, dark = shown < kDark;
  const std::string head = black ? "Black: " : dark ? "Dark: " : "";
  why.sum = sumOf(tree, scene);
  if (!root.hit) {
    why.sentence = head + sentence(root, scene) + ".";
    return why;
  }
  if (std::optional<Loss> loss = lossOf(tree, scene, settings, retrace, shown, scale)) {
    why.sentence = begun((head.empty() ? std::string(loss->head) : head) + loss->why);
    why.ray = loss->ray;
    why.cures = std::move(loss->cures);
    return why;
  }
  const std::string object = thingSeen(root, scene);
  const auto most = std::max_element(why.sum.begin(), why.sum.end(), [](const auto& a, const auto& b) {
    return brightness(a.color) < brightness(b.color);
  });
  if (black && litByEmissiveAlone(scene) && settings.lampSamples == 0 &&
      findOption("lamp-samples").concerns(settings)) {
    why.sentence = head + "only emissive objects light the scene, and for integrator " +
                   findOption("integrator").get(settings) + " they light nothing.";
    why.cures = {byOption("lamp-samples", "4"), byOption("integrator", "path")};
  } else if (black) {
    const bool lights = std::any_of(root.terms.begin(), root.terms.end(),
                                    [](const Term& term) { return term.light.has_value(); });
    why.sentence =
        head +
        (lights ? "the material of " + object + " scatters hardly any light" : "no light reaches " + object) +
        ".";
    WhyCure cure = select(scene, root.hit->object);
    why.cures = {cure};
  } else if (most != why.sum.end()) {
    const Real share = brightness(most->color) / brightness(root.radiance);
    why.sentence = begun(head + object + " shows " +
                         (share > 0.95  ? "only "
                          : share > 0.5 ? "mostly "
                                        : "several kinds of light, above all ") +
                         most->phrase + filterOf(tree, scene, *most));
  }
  return why;
}

}  // namespace trace
