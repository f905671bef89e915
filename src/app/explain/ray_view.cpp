#include "app/explain/ray_view.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/explain/ray_segments.h"
#include "app/explain/ray_words.h"
#include "base/text.h"
#include "image/srgb.h"
#include "scene/groups.h"

namespace trace {
namespace {

std::string text(Real number) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.5g", number + 0.0);  // no -0
  return buffer;
}
std::string text(const Vec3& v) { return text(v.x) + "  " + text(v.y) + "  " + text(v.z); }
std::string text(const Color& c) { return text(c.r) + "  " + text(c.g) + "  " + text(c.b); }

template <class Why>
bool ends(const RayNode& node) {
  return std::any_of(node.ends.begin(), node.ends.end(),
                     [](const RayEnd& end) { return std::holds_alternative<Why>(end); });
}

std::vector<std::vector<int>> childrenOf(const RayTree& tree) {
  std::vector<std::vector<int>> children(tree.nodes.size());
  for (int i = 0; i < static_cast<int>(tree.nodes.size()); ++i)
    if (rayAt(tree, i).parent >= 0) children[static_cast<std::size_t>(rayAt(tree, i).parent)].push_back(i);
  return children;
}

/// The role of a ray, seen from its parent: rays of two trees with the same name correspond.
std::pair<RayKind, std::uint32_t> rayIdentity(const RayTree& tree, int node) {
  return {rayAt(tree, node).kind, lightOf(tree, node).value_or(0)};
}

class Differ {
 public:
  Differ(const RayTree& a, const Scene& sceneA, const RayTree& b, const Scene& sceneB)
      : a_(a),
        b_(b),
        sceneA_(sceneA),
        sceneB_(sceneB),
        childrenA_(childrenOf(a)),
        childrenB_(childrenOf(b)) {}

  std::vector<RayPair> run() {
    if (!a_.nodes.empty() && !b_.nodes.empty()) both(0, 0, 0);
    return std::move(pairs_);
  }

 private:
  void both(int i, int j, int depth) {
    const std::string what = compare(rayAt(a_, i), rayAt(b_, j));
    pairs_.push_back({i, j, depth, !what.empty(), what});
    const std::vector<int>& left = childrenA_[static_cast<std::size_t>(i)];
    std::vector<int> right = childrenB_[static_cast<std::size_t>(j)];
    for (const int child : left) {
      const auto same = std::find_if(right.begin(), right.end(), [&](int other) {
        return rayIdentity(b_, other) == rayIdentity(a_, child);
      });
      if (same == right.end()) {
        alone(child, true, depth + 1);
      } else {
        const int other = *same;
        right.erase(same);
        both(child, other, depth + 1);
      }
    }
    for (const int child : right) alone(child, false, depth + 1);
  }

  void alone(int node, bool inA, int depth) {
    pairs_.push_back(
        {inA ? node : -1, inA ? -1 : node, depth, true, inA ? "only in the pinned" : "only now"});
    for (const int child : (inA ? childrenA_ : childrenB_)[static_cast<std::size_t>(node)])
      alone(child, inA, depth + 1);
  }

  std::string compare(const RayNode& a, const RayNode& b) const {
    if (a.hit.has_value() != b.hit.has_value())
      return !a.hit            ? "now meets something"
             : ends<CutOff>(b) ? "now cut off by the camera"
                               : "now leaves the scene";
    if (a.hit) {
      const std::string before = objectName(sceneA_, a.hit->object), now = objectName(sceneB_, b.hit->object);
      if (before != now) return before + " before, now " + now;
    }
    if (ends<Blocked>(a) != ends<Blocked>(b)) return ends<Blocked>(a) ? "now lit" : "now blocked";
    if (a.radiance == b.radiance) return "";
    const std::string before = channels(a.radiance, 2), now = channels(b.radiance, 2);
    return before != now ? before + " to " + now : channels(a.radiance) + " to " + channels(b.radiance);
  }

  const RayTree &a_, &b_;
  const Scene &sceneA_, &sceneB_;
  std::vector<std::vector<int>> childrenA_, childrenB_;
  std::vector<RayPair> pairs_;
};

}  // namespace

std::string channels(const Color& c, int digits) {
  char buffer[96];
  std::snprintf(buffer, sizeof buffer, "%.*g %.*g %.*g", digits, c.r + 0.0, digits, c.g + 0.0, digits,
                c.b + 0.0);  // no -0
  return buffer;
}

std::string metBy(const RayTree& tree, const Scene& scene, int ray) {
  const RayNode& node = rayAt(tree, ray);
  if (const MediumTerm* medium = scatteredIn(node))
    return medium->object == Filling::kAir ? "fog" : objectName(scene, medium->object);
  if (node.hit) return objectName(scene, node.hit->object);
  for (const RayEnd& end : node.ends)
    if (const auto* stop = std::get_if<Blocked>(&end)) return objectName(scene, stop->object);
  const Term* term = termOf(tree, ray);
  return term && term->light ? shortLightName(scene, term->light->light) : "";
}

Color addedLight(const RayTree& tree, int ray) {
  const RayNode& node = rayAt(tree, ray);
  const Real sample = maxComponent(rayAt(tree, 0).weight);  // the sample's part of the pixel
  return node.weight * node.radiance * (sample > 0 ? 1 / sample : 0);
}

Real share(const RayTree& tree, int ray) { return luminanceOf(addedLight(tree, ray)); }

std::vector<std::pair<std::string, std::string>> numbersOf(const RayTree& tree, int index,
                                                           const Scene& scene) {
  const RayNode& node = rayAt(tree, index);
  std::vector<std::pair<std::string, std::string>> rows;
  const auto row = [&](std::string name, std::string value) {
    rows.emplace_back(std::move(name), std::move(value));
  };

  row("Ray", "");
  row("kind", std::string(name(node.kind)) + ", depth " + std::to_string(node.depth));
  row("origin", text(node.ray.origin));
  row("direction", text(node.ray.direction));
  if (const auto light = lightOf(tree, index)) row("toward", lightName(scene, *light));
  if (node.tMost < kInfinity) row("light at distance", text(node.tMost));
  if (node.wavelength != 0) row("wavelength", text(node.wavelength) + " nm");
  for (const Ignored& ignored : node.ignored) row("no surface for light", sentence(ignored, scene));

  if (node.hit) {
    const Hit& hit = *node.hit;
    const NumberedObject found = objectOf(scene, hit.object);
    const Object& object = *found.object;
    row("Hit", "");
    row("object", objectName(scene, hit.object));
    if (!found.steps.empty()) row("placed as", placementName(scene, found));
    if (object.place.line > 0) row("defined at", shortPlace(object.place));
    row("shape, part", std::string(object.shape.keyword()) + ", " + std::to_string(hit.part));
    row("material", materialNames(scene, node.materials));
    if (hit.opacity < 1) row("opacity", text(hit.opacity));
    row("distance", text(hit.t));
    row("point", text(hit.surface.point));
    row("normal", text(hit.surface.normal));
    row("shading normal", text(hit.surface.shading));
    const Vec2 uv = hit.surface.uv;
    row("uv", text(uv.x) + "  " + text(uv.y));
    row("side", hit.leaving ? "from inside: leaving" : "from outside: entering");
    if (hit.twoSided) row("shaded", "on both sides");
    row("index of refraction",
        text(node.indices.before) + " before, " + text(node.indices.behind) + " behind");
    if (node.indices.nested) {
      const Indices& i = node.indices;
      row("before it", fillingText(scene, i.objectBefore, i.priorityBefore));
      row("behind it", fillingText(scene, i.objectBehind, i.priorityBehind));
    }
  }
  if (!node.terms.empty()) row("Shading", "");
  for (const Term& term : node.terms) {
    const std::string kind(Term::kNames[static_cast<std::size_t>(term.kind)]);
    if (term.dark) {
      row(lightName(scene, term.dark->light), "0: " + std::string(sentence(*term.dark)));
      continue;
    }
    if (!term.light) {
      row(kind, text(term.factor) + "  x  " + text(term.value));
      if (term.connection)
        row("  s, t, MIS weight", std::to_string(term.connection->light) + ", " +
                                      std::to_string(term.connection->camera) + ", " +
                                      text(term.connection->share));
      if (term.photons)
        row("  photons", counted(term.photons->count, "photon") + " within " + text(term.photons->radius));
      continue;
    }
    row(lightName(scene, term.light->light), text(term.factor * term.value));
    row("  diffuse", text(term.light->scatter.diffuse));
    row("  specular", text(term.light->scatter.specular));
    row("  light arriving", text(term.light->arriving.intensity()));
    if (!isBlack(term.light->arriving.extraHighlight * term.light->scatter.specular))
      row("  added in highlights", text(term.light->arriving.extraHighlight));
    const bool sent = term.ray >= 0, needed = !isBlack(term.factor);
    const Real shadow = whitted(*node.bsdf).shadow;
    if (needed && shadow != 1)
      row("  share of it",
          sent ? text(shadow) + ": the material's shadow" : text(1 - shadow) + ": always lit");
    row("  passes", sent                    ? text(term.value)
                    : needed && shadow == 1 ? "all of it: the light casts no shadows"
                    : needed                ? "all of it, in shadow too"
                                            : "no shadow ray was needed");
  }
  for (const Filter& filter : node.filters)
    if (filter.shadowless)
      row("past " + objectName(scene, filter.object), "it casts no shadow, at " + text(filter.t));
    else
      row("filtered by " + objectName(scene, filter.object), text(filter.factor) + " at " + text(filter.t));

  row("Result", "");
  if (!(node.through == Color(1)))
    row(node.filters.empty() ? "passed by the medium" : "passes", text(node.through));
  row(node.kind == RayKind::shadow ? "share that passes" : "radiance", text(node.radiance));
  row("weight in the pixel", text(node.weight));
  row("adds to the pixel", text(node.weight * node.radiance));
  row("hierarchy nodes visited", std::to_string(node.nodes));
  row("shapes and triangles tested", std::to_string(node.tests));
  return rows;
}

std::vector<RayPair> difference(const RayTree& a, const Scene& sceneA, const RayTree& b,
                                const Scene& sceneB) {
  return Differ(a, sceneA, b, sceneB).run();
}

}  // namespace trace
