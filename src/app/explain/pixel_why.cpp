#include "app/explain/pixel_why.h"

#include <algorithm>
#include <utility>

#include "app/explain/ray_view.h"
#include "base/text.h"
#include "math/elementary.h"
#include "shading/bsdf.h"

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

WhyCure select(const Scene& scene, std::uint32_t object) {
  WhyCure cure{"Select " + objectName(scene, object)};
  cure.object = object;
  return cure;
}

/// "the ray that should leave ball", "the ray that ball should reflect".
std::string unsentRay(RayKind unsent, const RayNode& node, const Scene& scene) {
  if (!node.hit) return "the next ray";
  const std::string object = objectName(scene, node.hit->object);
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

class Search {
 public:
  Search(const RayTree& tree, const Scene& scene) : tree_(tree), scene_(scene) {}

  /// The largest loss.
  Loss run() {
    const Real whole = std::max(brightness(rayAt(tree_, 0).weight), 1e-30);
    for (int i = 0; i < static_cast<int>(tree_.nodes.size()); ++i) {
      const RayNode& node = rayAt(tree_, i);
      if (node.kind == RayKind::shadow || node.kind == RayKind::light) continue;
      const Color weight = node.weight * node.through * (1 / whole);
      for (const RayEnd& end : node.ends) lookAt(end, i, brightness(weight));
      for (const Term& term : node.terms) lookAt(term, i, weight);
    }
    return std::move(worst_);
  }

 private:
  void offer(Loss loss) {
    if (loss.amount > worst_.amount) worst_ = std::move(loss);
  }

  void lookAt(const RayEnd& end, int ray, Real weight) {
    const RayNode& node = rayAt(tree_, ray);
    if (const auto* limit = std::get_if<DepthLimit>(&end)) {
      constexpr int kEnough = 5;  // for glass that light enters and leaves, seen through more glass
      Loss loss{weight * unsentLight(limit->unsent, node, brightness(rayAt(tree_, 0).radiance)), ray,
                unsentRay(limit->unsent, node, scene_) + " was not sent: depth limit " +
                    std::to_string(limit->limit)};
      const auto cure = [&](int depth) {
        WhyCure deeper{"depth " + std::to_string(depth)};
        deeper.option = "depth";
        deeper.value = std::to_string(depth);
        loss.cures.push_back(std::move(deeper));
      };
      cure(limit->limit + 1);
      cure(limit->limit + 1 < kEnough ? kEnough : 2 * limit->limit);
      offer(std::move(loss));
    }
    if (const auto* small = std::get_if<BelowThreshold>(&end); small && small->contribution > 0) {
      WhyCure cure{"threshold 0"};
      cure.option = "threshold";
      cure.value = "0";
      offer({small->contribution * kGuess,
             ray,
             unsentRay(small->unsent, node, scene_) + " was not sent: threshold " + toText(small->threshold),
             {cure}});
    }
  }

  void lookAt(const Term& term, int ray, const Color& weight) {
    const RayNode& node = rayAt(tree_, ray);
    if (!term.light || !node.hit) return;
    const std::string object = objectName(scene_, node.hit->object),
                      light = lightName(scene_, term.light->light);
    if (term.ray >= 0) {
      for (const RayEnd& end : rayAt(tree_, term.ray).ends)
        if (const auto* stop = std::get_if<Blocked>(&end)) {
          const bool itself = stop->object == node.hit->object;
          offer({brightness(weight * term.factor),
                 term.ray,
                 (itself ? object + " is in its own shadow: it" : objectName(scene_, stop->object)) +
                     " blocks " + light + (itself ? "" : " from " + object),
                 {select(scene_, stop->object)},
                 "In shadow: "});
        }
      return;
    }
    // No shadow ray was sent: the surface scatters nothing of it.
    const SurfacePoint& at = node.hit->surface;
    const Vec3& toward = term.light->arriving.toLight;
    const Real arrives = brightness(term.light->arriving.intensity());
    const Vec3 side = dot(at.normal, node.ray.direction) > 0 ? -at.normal : at.normal;
    const bool facing = dot(side, toward) > 0, shaded = dot(at.shading, side) < 0;
    if (facing && (shaded || dot(at.shading, toward) * (dot(at.shading, at.normal) < 0 ? -1 : 1) < 0))
      offer({brightness(weight) * arrives * 0.3,
             ray,
             "the normal of " + object + " points away from " + light + ", but its surface faces it",
             {select(scene_, node.hit->object)}});
    else if (!facing)
      offer({brightness(weight) * arrives * 1e-3, ray, object + " faces away from " + light});
  }

  const RayTree& tree_;
  const Scene& scene_;
  Loss worst_;
};

/// The last ray, in the order of tracing, of those that come from this one.
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

/// The object or light that the camera ray came to.
std::string thingSeen(const RayNode& root, const Scene& scene) {
  return root.hit ? objectName(scene, root.hit->object) : "";
}

}  // namespace

std::vector<WhySummand> sumOf(const RayTree& tree, const Scene& scene, int ray) {
  std::vector<WhySummand> sum;
  const RayNode& root = rayAt(tree, ray);
  for (const Term& term : root.terms) {
    std::string name(Term::kNames[static_cast<std::size_t>(term.kind)]);
    if (term.light) name += " " + lightName(scene, term.light->light);
    const Color color =
        term.factor * (term.ray < 0 ? term.value : rayAt(tree, term.ray).radiance) * root.through;
    if (term.dark || (isBlack(color) && term.ray < 0 && !term.light)) continue;
    const auto same =
        std::find_if(sum.begin(), sum.end(), [&](const WhySummand& s) { return s.name == name; });
    const int last = term.ray < 0 ? ray : lastBelow(tree, term.ray);
    if (same == sum.end()) {
      sum.push_back({name, color, term.ray, last});
    } else {
      same->color = same->color + color;
      same->last = std::max(same->last, last);
    }
  }
  return sum;
}

std::string equationOf(const RayTree& tree, const Scene& scene, int ray) {
  const RayNode& node = rayAt(tree, ray);
  if (node.kind == RayKind::shadow) return "passes " + channels(node.radiance);
  std::string text = channels(node.radiance);
  const char* sign = " = ";
  for (const WhySummand& each : sumOf(tree, scene, ray))
    text += std::exchange(sign, " + ") + each.name.substr(0, each.name.find(" (")) +  // without its place
            " " + channels(each.color);
  return text;
}

Color sumAfter(const std::vector<WhySummand>& sum, int rays) {
  Color after;
  for (const WhySummand& each : sum)
    if (each.last < rays) after = after + each.color;
  return after;
}

PixelWhy whyOf(const RayTree& tree, const Scene& scene, Real exposure) {
  PixelWhy why;
  if (tree.nodes.empty()) return why;
  const RayNode& root = rayAt(tree, 0);
  const Real scale = math::exp2(exposure);
  const Real shown = brightness(root.radiance) * scale;
  const bool black = shown < kBlack, dark = shown < kDark;
  const std::string head = black ? "Black: " : dark ? "Dark: " : "";
  why.sum = sumOf(tree, scene);
  if (!root.hit) {
    why.sentence = head + sentence(root, scene) + ".";
    return why;
  }
  Loss loss = Search(tree, scene).run();
  const bool matters = loss.amount * scale > std::max(shown, 0.5 * kBlack);
  if (matters || (black && loss.amount > 0)) {
    why.sentence = (head.empty() ? std::string(loss.head) : head) + loss.why + ".";
    why.ray = loss.ray;
    why.cures = std::move(loss.cures);
    return why;
  }
  const std::string object = thingSeen(root, scene);
  const auto most = std::max_element(why.sum.begin(), why.sum.end(), [](const auto& a, const auto& b) {
    return brightness(a.color) < brightness(b.color);
  });
  if (black) {
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
    why.sentence = head + object + " shows " +
                   (share > 0.95  ? "only "
                    : share > 0.5 ? "mostly "
                                  : "most of all ") +
                   most->name + ".";
  }
  return why;
}

}  // namespace trace
