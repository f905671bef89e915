// The checks of light that is not there: things that nothing lights, and caustics.
#include <algorithm>
#include <iterator>
#include <set>
#include <string>

#include "app/advice/darkness.h"
#include "app/advice/missing_caustic.h"
#include "app/lint/checks.h"
#include "scene/integrators.h"
#include "shading/lights/plain_lights.h"

namespace trace::lint_checks {

void causticsMissing(const LintScene& s, Findings& findings) {
  const auto counts = [&](std::uint32_t light, std::uint32_t object) {
    const bool isChosen = s.scene.lights[light].place.line == 0;  // by Trace: nobody misses its glint
    if (isChosen && !gathersLight(s.world, object, true)) return false;
    return s.survey.objects[object].places > 0 &&
           (s.survey.lights[light].places > 0 || shinesOn(s.scene, s.world, light, object));
  };
  const auto missing = missingCaustic(s.scene, s.settings, s.world, false, counts);
  if (!missing) return;
  const SourcePlace& place = s.scene.lights[missing->light].place;
  warn(findings, "caustics-missing", place,
       quoted(s, missing->object) + " has no caustics of " +
           (place.line > 0 ? "this light: " : "the light that Trace chose: ") + missing->why,
       missing->hint);
}

/// Spot lights that no object is in the cone of. True if there is one.
bool spotsOnNothing(const LintScene& s, Findings& findings) {
  bool found = false;
  for (std::size_t i = 0; i < s.scene.lights.size(); ++i) {
    const LightSource& source = s.scene.lights[i];
    if (!isSpot(source.light) || isBlack(*source.light.color()) || s.survey.lights[i].places > 0 ||
        shinesOnSomething(s.world, geometryOf(source.light)))
      continue;
    found = true;
    warn(findings, "unlit", source.place, "the spot light shines on nothing: no object is in its cone",
         "turn it to the object that it should light, or give it a larger angle");
  }
  return found;
}

void unlit(const LintScene& s, Findings& findings) {
  constexpr int kFew = 5, kFewOfPaths = 20;  // bounced light reaches only some of a few places
  const int few = hasTrait(s.settings, Trait::bounces) ? kFewOfPaths : kFew;
  if (s.scene.lights.empty()) return;  // that is told otherwise
  const auto all = static_cast<std::uint32_t>(s.scene.objects.size());
  std::uint32_t gathers = 0;
  while (gathers < all && !gathersLight(s.world, gathers)) ++gathers;
  if (gathers < all && hasTrait(s.settings, Trait::bringsCaustics))
    return;  // light comes by ways that nobody has asked here
  const std::string ambient = hasTrait(s.settings, Trait::addsAmbient)
                                  ? ", or add an ambient light with `ambient` in the material"
                                  : "";
  std::uint32_t shines = 0;
  while (shines < all && !(maxComponent(s.world.termsOf(shines).emissive) > 1)) ++shines;
  const bool asksLamps = !findOption("lamp-samples").concerns(s.settings) || s.settings.lampSamples > 0;
  const std::string lamp =
      shines < all && !asksLamps ? "; --lamp-samples 4 lets " + quoted(s, shines) + " light it" : "";
  const std::string thrown =
      gathers < all ? "; --integrator photon shows the caustics of " + quoted(s, gathers) + " on it" : "";
  const bool isCauseSaid = spotsOnNothing(s, findings);
  const bool facesAway = std::any_of(findings.begin(), findings.end(),
                                     [](const LintFinding& f) { return f.check == "light-faces-away"; });
  std::set<std::uint32_t> cases;  // around a light or the camera, of which other checks tell
  for (const LightSource& source : s.scene.lights)
    if (source.links.castsShadows)
      for (const std::uint32_t around : opaqueAround(s, source.light)) cases.insert(around);
  if (std::any_of(findings.begin(), findings.end(),
                  [](const LintFinding& f) { return f.check == "camera-inside"; }))
    for (const std::uint32_t around : s.aroundCamera)
      if (s.world.opaque(around)) cases.insert(around);
  for (std::uint32_t object = 0; object < s.scene.objects.size(); ++object) {
    const Survey::Seen& seen = s.survey.objects[object];
    if (seen.places < few || seen.lit > 0 || seen.couldBeLit < seen.places) continue;
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
      if (facesAway) continue;
      hint = "add a light there";
    } else if (seen.facesAway > blocked) {
      cause = "; it faces away from the lights";
      hint = "move a light to the visible side, or sides = both in its material";
    } else {
      cause = most->first == object ? "; it stands in its own light"
                                    : "; it is blocked by " + quoted(s, most->first);
      hint = "move the light or the blocking object";
    }
    warn(findings, "unlit", placeOf(s, object),
         quoted(s, object) + " is visible, but no light reaches its visible side: it is black" + cause,
         hint + ambient + lamp + thrown);
  }
}

/// By the share of the picture, not by its brightest place: a highlight in a black picture is no light.
void blackPicture(const LintScene& s, Findings& findings) {
  constexpr std::string_view kCauses[] = {"light-inside", "light-too-weak",    "light-blocked",
                                          "light-cut",    "light-faces-away",  "camera-inside",
                                          "unlit",        "camera-looks-away", "light-reaches-nothing"};
  for (const LintFinding& finding : findings)
    if (std::find(std::begin(kCauses), std::end(kCauses), finding.check) != std::end(kCauses)) return;
  if (const auto found =
          darkness(s.scene, s.settings, s.world, tracedCells(s.world, s.settings), {.measured = s.measured}))
    findings.push_back({"black-picture", *found});
}

}  // namespace trace::lint_checks
