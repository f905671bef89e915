// The checks of lights: where they stand, how strong they are, what shuts them out.
#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "app/lint/checks.h"
#include "app/session/render_warnings.h"
#include "base/text.h"
#include "geometry/shapes/solids/csg_tree.h"
#include "geometry/traced.h"
#include "math/box.h"
#include "scene/integrators.h"
#include "shading/lights/goniometric_light.h"
#include "shading/lights/rectangle_light.h"
#include "shading/lights/warn_light.h"

namespace trace::lint_checks {
namespace {

/// Where a lamp stands; null for panels and for what is far away.
const Vec3* positionOf(const Light& light) {
  return light.type().starts == LightOrigin::ball ? light.position() : nullptr;
}

Color lightColor(const Light& light) {
  const Color* color = light.color();
  return color ? *color : Color(0);
}

}  // namespace

std::vector<std::uint32_t> opaqueAround(const LintScene& s, const Light& light) {
  const Vec3* position = positionOf(light);
  if (!position) return {};
  std::vector<std::uint32_t> around = objectsAround(s.world, *position);
  std::erase_if(around,
                [&](std::uint32_t object) { return !s.world.blocks(object) || isAroundCamera(s, object); });
  return around;
}

void lightInside(const LintScene& s, Findings& findings) {
  for (const LightSource& source : s.scene.lights) {
    if (!source.links.castsShadows) continue;
    for (const std::uint32_t object : opaqueAround(s, source.light))
      warn(findings, "light-inside", source.place,
           "the light is inside " + quoted(s, object) + ", which is opaque: it lights nothing outside",
           "move the light out of it; a lamp needs an `emissive` surface with casts_shadow = off");
  }
}

/// Looks at lights that stand somewhere: parallel light keeps its direction behind a pane, and has no focus
/// to miss.
void lightBehindGlass(const LintScene& s, Findings& findings) {
  constexpr int kFew = 10;
  if (hasTrait(s.settings, Trait::bringsCaustics)) return;
  for (std::size_t i = 0; i < s.scene.lights.size(); ++i) {
    const Survey::Lamp& lamp = s.survey.lights[i];
    if (!positionOf(s.scene.lights[i].light)) continue;
    if (lamp.throughGlass < kFew || 2 * lamp.throughGlass < lamp.reachedOthers) continue;
    warn(findings, "light-behind-glass", s.scene.lights[i].place,
         "most of this light comes through " + quoted(s, lamp.glass) +
             ", which refracts: shadow rays continue straight, so there is no refraction and no caustic",
         std::string(findOption("caustics").concerns(s.settings) ? "--caustics 200000"
                                                                 : "--integrator photon") +
             " traces photons from the light, which refract; or move the light out of the glass, or give the "
             "glass index = 1");
  }
}

void lightTooWeak(const LintScene& s, Findings& findings) {
  constexpr int kFew = 20;
  const Real level = whiteOf(s.settings) / 255, weakest = level / 2;
  for (std::size_t i = 0; i < s.scene.lights.size(); ++i) {
    const Survey::Lamp& lamp = s.survey.lights[i];
    const LightSource& source = s.scene.lights[i];
    const Real color = maxComponent(lightColor(source.light));
    if (color == 0) continue;  // it is switched off
    if (lamp.places < kFew || lamp.strongest >= weakest) continue;
    const Vec3* position = positionOf(source.light);
    // It may be there for what is near it and not in the picture.
    if (position && strongestAround(s.world, source.light, *position) >= weakest) continue;
    const bool fades = position && color >= weakest;
    warn(findings, "light-too-weak", source.place,
         "the light is too weak to see: where it is strongest, " + toText(roundedTo(lamp.strongest)) +
             " arrives, and a level of the picture is " + toText(roundedTo(level)) +
             (fades ? "; it falls off with the distance" : ""),
         fades ? "constant_attenuation_coeff = 1; linear_attenuation_coeff = 0; quadratic_attenuation_coeff "
                 "= 0; switch the falloff off; or give it a stronger color"
               : "give it a stronger color: 1 is full light");
  }
}

/// The sun above a sky that is an object.
void lightBlocked(const LintScene& s, Findings& findings) {
  constexpr int kFew = 20;
  constexpr double kMost = 0.9;
  for (std::size_t i = 0; i < s.scene.lights.size(); ++i) {
    const Survey::Lamp& lamp = s.survey.lights[i];
    std::map<std::uint32_t, int> blockers;
    for (const auto& [pair, times] : lamp.blocked)
      if (pair.first != pair.second) blockers[pair.second] += times;
    if (blockers.empty()) continue;
    const std::uint32_t sky = mostOf(blockers)->first;
    // How the sky itself is lit tells nothing: from outside the light does shine on it.
    int blocked = 0, reached = 0;
    for (const auto& [pair, times] : lamp.blocked)
      if (pair.first != sky) blocked += times;
    for (const auto& [object, times] : lamp.reached)
      if (object != sky) reached += times;
    if (reached > 0 || blocked < kFew || blockers[sky] < kMost * blocked) continue;
    if (!isShell(s.world, sky, s.world.camera().eye)) continue;
    const bool around = isAroundCamera(s, sky);
    warn(findings, "light-blocked", s.scene.lights[i].place,
         "this light reaches nothing visible: " + quoted(s, sky) +
             (around ? " encloses the scene and blocks it" : " blocks it everywhere"),
         around ? "use `background` in place of the object, since it casts no shadow; or put the light inside"
                : "put the light on the other side of it, or turn it round");
  }
}

/// Lights that are shut by what they say themselves.
void lightCut(const LintScene& s, Findings& findings) {
  for (const LightSource& source : s.scene.lights) {
    if (maxComponent(lightColor(source.light)) == 0) continue;  // it is switched off
    if (const auto* measured = source.light.as<GoniometricLight>()) {
      if (measured->file.data && measured->file.data->brightest() == 0)
        warn(findings, "light-cut", source.place,
             "the photometric file of this light has no light: all its candelas are 0",
             "use the file of a lamp that is on, or a point_light");
      continue;
    }
    const auto* studio = source.light.as<WarnLight>();
    if (!studio) continue;
    const Box3 open = studio->open();
    if (open.empty()) {
      warn(findings, "light-cut", source.place,
           "the flaps of this light leave nothing: one of its least values is above the largest",
           "x_min, y_min and z_min lie below x_max, y_max and z_max");
      continue;
    }
    const auto isLit = [&](const Object& object) {
      Box3 box = boxAround(object);
      box.low = max(box.low, open.low);
      box.high = min(box.high, open.high);
      return !box.empty();
    };
    if (std::none_of(s.scene.objects.begin(), s.scene.objects.end(), isLit))
      warn(findings, "light-cut", source.place,
           "the flaps of this light cut off everything: no object lies between them",
           "flaps are planes in the space of the scene, not of the light: x_max = 1 lights only x < 1");
  }
}

void lightFacesAway(const LintScene& s, Findings& findings) {
  if (s.settings.fog > 0 || s.scene.objects.empty()) return;  // fog itself is lit
  for (const LightSource& source : s.scene.lights) {
    const auto* panel = source.light.as<RectangleLight>();
    if (!panel || panel->twoSided || isBlack(panel->color)) continue;
    const Vec3 across = cross(panel->u, panel->v);
    if (!(length(across) > 0)) continue;
    const Vec3 ahead = normalize(across);
    if (panel->visible && dot(s.world.camera().eye - panel->position, ahead) > 0) continue;  // it is seen
    const auto isAhead = [&](const Object& object) {
      const Box3 box = boxAround(object);
      Real farthest = 0;
      for (int axis = 0; axis < 3; ++axis)
        if (ahead[axis] != 0)  // the box may be infinite
          farthest += ahead[axis] * ((ahead[axis] > 0 ? box.high : box.low)[axis] - panel->position[axis]);
      return !box.empty() && farthest > 0;
    };
    if (std::any_of(s.scene.objects.begin(), s.scene.objects.end(), isAhead)) continue;
    const auto number = [](Real value) { return toText(std::round(value * 1000) / 1000 + 0.0); };
    warn(findings, "light-faces-away", source.place,
         "this light faces away from every object: it emits toward (" + number(ahead.x) + ", " +
             number(ahead.y) + ", " + number(ahead.z) + "), and no object is on that side",
         "exchange its u and v, which turns it round; or two_sided = true");
  }
}

void lightLink(const LintScene& s, Findings& findings) {
  Messages messages;
  warnOfWrongLinks(s.scene, messages);
  for (const Message& message : messages.all()) findings.push_back({"light-link", message});
}

}  // namespace trace::lint_checks
