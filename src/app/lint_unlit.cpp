// The checks of light that is not there: things that nothing lights, and caustics.
#include <algorithm>
#include <set>
#include <string>

#include "app/lint_checks.h"
#include "base/match.h"

namespace trace::lint_checks {
namespace {

/// The object throws much of the light that it meets on others, gathered.
bool gathersLight(const LintScene& s, std::uint32_t object, bool byGlassAlone = false) {
  constexpr Real kMuch = 0.3;
  const WhittedTerms& terms = s.world.termsOf(object);
  const Real refracted = terms.passage == Passage::straight ? 0 : maxComponent(terms.transmissive);
  return std::max(byGlassAlone ? 0 : maxComponent(terms.reflective), refracted) >= kMuch;
}

/// The render shows the light that such objects throw.
bool showsCaustics(const Settings& settings) {
  return isBidirectional(settings) || settings.integrator == IntegratorKind::photon ||
         (settings.integrator == IntegratorKind::whitted && settings.caustics > 0);
}

/// Something of the light arrives at the middle of the object, were nothing in the way.
bool shinesOn(const LintScene& s, std::size_t light, std::uint32_t object) {
  const Vec3 middle = s.world.boundsOf(object).center();
  const auto arriving = match(s.scene.lights[light].light,
                              [&](const auto& l) { return l.illuminate(middle, s.world.rules()); });
  return isFinite(middle) && arriving && !isBlack(arriving->intensity());
}

/// Paths may meet the light by chance: it has a size, and they see it.
bool isMet(const Light& light) {
  return match(light, [](const auto& l) {
    if constexpr (requires { l.visible; }) return l.visible && l.hasSize();
    return false;
  });
}

}  // namespace

/// Paths by chance never meet a light without a size, or one that they do not see, so they bring nothing of
/// its light by mirrors and glass. What glass gathers is missing wherever shadow rays run straight through
/// it.
void causticsMissing(const LintScene& s, Findings& findings) {
  const IntegratorKind kind = s.settings.integrator;
  const bool direct = kind == IntegratorKind::direct;
  if (showsCaustics(s.settings) || (kind != IntegratorKind::path && kind != IntegratorKind::mlt && !direct))
    return;
  for (std::size_t i = 0; i < s.scene.lights.size(); ++i) {
    const Light& light = s.scene.lights[i].light;
    const bool hasSize = match(light, [](const auto& l) { return l.hasSize(); });
    const bool met = isMet(light), straight = s.settings.glassShadows == GlassShadows::filtered;
    if (met && !direct && !straight) continue;
    for (std::uint32_t object = 0; object < s.scene.objects.size(); ++object) {
      if (s.survey.objects[object].places == 0 || !gathersLight(s, object, met && !direct)) continue;
      if (s.survey.lights[i].places == 0 && !shinesOn(s, i, object)) continue;
      return warn(
          findings, "caustics-missing", s.scene.lights[i].place,
          "what " + quoted(s, object) + " throws of this light on other things is missing: " +
              (direct    ? "--integrator direct follows no light that bounces"
               : met     ? "shadow rays run straight through glass"
               : hasSize ? "the light is not visible, so no path meets it by chance"
                         : "the light has no size, so no path meets it by chance"),
          "--integrator photon or bdpt shows such caustics, and so does whitted with --caustics "
          "200000" +
              std::string(met ? "; path finds them with many samples and --glass-shadows black" : ""));
    }
  }
}

/// Spot lights that no object is in the cone of. True if there is one.
bool spotsOnNothing(const LintScene& s, Findings& findings) {
  bool found = false;
  for (std::size_t i = 0; i < s.scene.lights.size(); ++i) {
    const LightSource& source = s.scene.lights[i];
    const auto* spot = std::get_if<SpotLight>(&source.light);
    const bool isOff = spot && maxComponent(spot->color) == 0;
    if (!spot || isOff || s.survey.lights[i].places > 0 || shinesOnSomething(s.world, *spot)) continue;
    found = true;
    warn(findings, "unlit", source.place, "the spot light shines on nothing: no object is in its cone",
         "turn its direction to what it should light, or give it a larger angle");
  }
  return found;
}

void unlit(const LintScene& s, Findings& findings) {
  constexpr int kFew = 5;
  if (s.scene.lights.empty()) return;  // that is told otherwise
  const auto all = static_cast<std::uint32_t>(s.scene.objects.size());
  std::uint32_t gathers = 0;
  while (gathers < all && !gathersLight(s, gathers)) ++gathers;
  if (gathers < all && showsCaustics(s.settings)) return;  // light comes by ways that nobody has asked here
  // Ambient light is Whitted's.
  const std::string ambient = s.settings.integrator == IntegratorKind::whitted
                                  ? ", or add an ambient light with `ambient` in the material"
                                  : "";
  std::uint32_t shines = 0;
  while (shines < all && !(maxComponent(s.world.termsOf(shines).emissive) > 1)) ++shines;
  const bool asksLamps = s.settings.integrator != IntegratorKind::whitted || s.settings.lampSamples > 0;
  const std::string lamp =
      shines < all && !asksLamps ? "; --lamp-samples 4 lets " + quoted(s, shines) + " light it" : "";
  const std::string thrown =
      gathers < all ? "; --integrator photon shows what " + quoted(s, gathers) + " throws on it" : "";
  const bool isCauseSaid = spotsOnNothing(s, findings);
  std::set<std::uint32_t> cases;  // around a light, of which light-inside tells
  for (const LightSource& source : s.scene.lights)
    for (const std::uint32_t around : opaqueAround(s, source.light)) cases.insert(around);
  for (std::uint32_t object = 0; object < s.scene.objects.size(); ++object) {
    const Survey::Seen& seen = s.survey.objects[object];
    if (seen.places < kFew || seen.lit > 0 || seen.couldBeLit < seen.places) continue;
    const auto most = mostOf(seen.blockedBy);
    const int blocked = most == seen.blockedBy.end() ? 0 : most->second;
    const int others = std::max(seen.facesAway, blocked);
    if (cases.contains(seen.facesAway > blocked || blocked == 0 ? object : most->first)) continue;
    std::string cause, hint;
    if (seen.unlinked > std::max(seen.outOfCone, others)) {
      cause = "; links, its own or those of the lights, keep them off it";
      hint = "look at lit_by and not_lit_by of the object, and at lights and excludes of the lights";
    } else if (seen.outOfCone > others) {
      if (isCauseSaid) continue;
      cause = "; it is outside the cone of the spot light";
      hint = "turn a spot light's direction to it, or give it a larger angle";
    } else if (others == 0) {
      hint = "add a light that shines there";
    } else if (seen.facesAway > blocked) {
      cause = "; it faces away from the lights";
      hint = "move a light to the side that is seen or turn its faces round";
    } else {
      cause = most->first == object ? "; it stands in its own light"
                                    : "; in the way is " + quoted(s, most->first);
      hint = "move the light or what is in the way";
    }
    warn(findings, "unlit", placeOf(s, object),
         quoted(s, object) + " is seen, but no light reaches what is seen of it: it is black" + cause,
         hint + ambient + lamp + thrown);
  }
}

}  // namespace trace::lint_checks
