// The checks of lights and of the camera.
#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "app/lint_checks.h"
#include "base/match.h"
#include "base/text.h"
#include "geometry/shapes/csg_tree.h"
#include "geometry/traced.h"
#include "math/box.h"

namespace trace::lint_checks {
namespace {

constexpr Real kHalfALevel = 0.5 / 255;

/// Of a lamp; null for panels and for what is far away.
const Vec3* positionOf(const Light& light) {
  return match(light, [](const auto& l) -> const Vec3* {
    if constexpr (requires { l.radius; }) return &l.position;
    return nullptr;
  });
}

Color colorOf(const Light& light) {
  return match(light, [](const auto& l) {
    if constexpr (requires { l.color; }) return l.color;
    return Color(0);
  });
}

/// To three digits, for people.
Real roundedTo(Real value) {
  if (value == 0 || !std::isfinite(value)) return value;
  const Real unit = std::pow(10.0, std::floor(std::log10(std::abs(value))) - 2);
  return unit < 1 ? std::round(value / unit) / std::round(1 / unit) : std::round(value);
}

using Blockers = std::map<std::uint32_t, int>;

/// The one that is most often in the way; the end if nothing is.
Blockers::const_iterator mostIn(const Blockers& blockers) {
  return std::max_element(blockers.begin(), blockers.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; });
}

/// A box around the object in the world.
Box3 boxAround(const Object& object) { return object.worldFromObject * prepare(object.shape).bounds(); }

/// Some side of the picture, or the plane of the eye, has the whole box beyond it.
bool isOutside(const CameraFrame& camera, const Box3& box) {
  if (camera.optics.projection != Projection::perspective) return false;
  const Vec3 forward = cross(camera.right, camera.up);
  const Vec3 ahead = dot(forward, camera.look) < 0 ? -forward : forward;
  const Vec3 left = camera.look - camera.right * 0.5, right = camera.look + camera.right * 0.5;
  const Vec3 below = camera.look - camera.up * 0.5, above = camera.look + camera.up * 0.5;
  const auto inward = [&](const Vec3& normal) { return dot(normal, camera.look) < 0 ? -normal : normal; };
  const Vec3 sides[] = {ahead, inward(cross(left, camera.up)), inward(cross(right, camera.up)),
                        inward(cross(below, camera.right)), inward(cross(above, camera.right))};
  return std::any_of(std::begin(sides), std::end(sides), [&](const Vec3& side) {
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 at{corner & 1 ? box.high.x : box.low.x, corner & 2 ? box.high.y : box.low.y,
                    corner & 4 ? box.high.z : box.low.z};
      if (dot(at - camera.eye, side) >= 0) return false;
    }
    return true;
  });
}

}  // namespace

// --- lights -------------------------------------------------------------------------------------------

void lightInside(const LintScene& s, Findings& findings) {
  for (const LightSource& source : s.scene.lights) {
    const Vec3* position = positionOf(source.light);
    if (!position) continue;
    for (std::uint32_t object : objectsAround(s.world, *position)) {
      if (!s.world.opaque(object) || isAroundCamera(s, object)) continue;
      warn(findings, "light-inside", source.place,
           "the light is inside " + quoted(s, object) + ", which is opaque: it lights nothing outside",
           "move the light out of it; a lamp that shines needs `emissive` for its looks and a light beside "
           "it");
    }
  }
}

/// Looks at lights that stand somewhere: parallel light keeps its direction behind a pane, and has no focus
/// to miss.
void lightBehindGlass(const LintScene& s, Findings& findings) {
  constexpr int kFew = 10;
  const bool whitted = s.settings.integrator == IntegratorKind::whitted;
  if (s.settings.integrator == IntegratorKind::photon || (whitted && s.settings.caustics > 0)) return;
  for (std::size_t i = 0; i < s.scene.lights.size(); ++i) {
    const Survey::Lamp& lamp = s.survey.lights[i];
    if (!positionOf(s.scene.lights[i].light)) continue;
    if (lamp.throughGlass < kFew || 2 * lamp.throughGlass < lamp.reachedOthers) continue;
    warn(findings, "light-behind-glass", s.scene.lights[i].place,
         "most of this light comes through " + quoted(s, lamp.glass) +
             ", which refracts: shadow rays run straight on, so light is neither bent nor gathered there",
         std::string(whitted ? "--caustics 200000" : "--integrator photon") +
             " sends photons from the light, which are bent and gathered; or move the light out of the "
             "glass, or "
             "give what is around it index = 1");
  }
}

void lightTooWeak(const LintScene& s, Findings& findings) {
  constexpr int kFew = 20;
  for (std::size_t i = 0; i < s.scene.lights.size(); ++i) {
    const Survey::Lamp& lamp = s.survey.lights[i];
    const LightSource& source = s.scene.lights[i];
    const Real color = maxComponent(colorOf(source.light));
    if (color == 0) continue;  // it is switched off
    if (lamp.places < kFew || lamp.strongest >= kHalfALevel) continue;
    const Vec3* position = positionOf(source.light);
    // It may be there for what is near it and not in the picture.
    if (position && strongestAround(s.world, source.light, *position) >= kHalfALevel) continue;
    const bool fades = position && color >= kHalfALevel;
    warn(findings, "light-too-weak", source.place,
         "the light is too weak to see: where it is strongest, " + toText(roundedTo(lamp.strongest)) +
             " arrives, and a level of the picture is " + toText(roundedTo(1 / 255.0)) +
             (fades ? "; it fades on the way" : ""),
         fades
             ? "constant_attenuation_coeff = 1; linear_attenuation_coeff = 0; quadratic_attenuation_coeff = "
               "0; keep light from fading with the distance; or give it a stronger color"
             : "give it a stronger color: 1 is full light");
  }
}

/// The sun above a sky that is an object.
void lightBlocked(const LintScene& s, Findings& findings) {
  constexpr int kFew = 20;
  constexpr double kMost = 0.9;
  for (std::size_t i = 0; i < s.scene.lights.size(); ++i) {
    const Survey::Lamp& lamp = s.survey.lights[i];
    Blockers blockers;
    for (const auto& [pair, times] : lamp.blocked)
      if (pair.first != pair.second) blockers[pair.second] += times;
    if (blockers.empty()) continue;
    const std::uint32_t sky = mostIn(blockers)->first;
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
         "this light reaches nothing that is seen: " + quoted(s, sky) +
             (around ? " is around everything and in its way" : " is in its way everywhere"),
         around ? "in place of an object as sky, `background` casts no shadow; or put the light inside"
                : "put the light on the other side of it, or turn it round");
  }
}

/// Paths by chance never meet a light without a size, so they bring nothing of its light by mirrors and
/// glass.
void causticsMissing(const LintScene& s, Findings& findings) {
  const IntegratorKind kind = s.settings.integrator;
  const bool direct = kind == IntegratorKind::direct;
  if (kind != IntegratorKind::path && kind != IntegratorKind::mlt && !direct) return;
  const auto gathers = [&](std::uint32_t object) {
    constexpr Real kMuch = 0.3;
    const WhittedTerms& terms = s.world.termsOf(object);
    const Real refracted = terms.passage == Passage::straight ? 0 : maxComponent(terms.transmissive);
    return std::max(maxComponent(terms.reflective), refracted) >= kMuch;
  };
  std::uint32_t object = 0;
  while (object < s.scene.objects.size() && !(s.survey.objects[object].places > 0 && gathers(object)))
    ++object;
  if (object == s.scene.objects.size()) return;
  for (std::size_t i = 0; i < s.scene.lights.size(); ++i) {
    const Light& light = s.scene.lights[i].light;
    const bool hasSize = match(light, [](const auto& l) { return l.hasSize(); });
    if (s.survey.lights[i].places == 0 || (hasSize && !direct)) continue;
    warn(findings, "caustics-missing", s.scene.lights[i].place,
         "what " + quoted(s, object) + " throws of this light on other things is missing: " +
             (direct ? "--integrator direct follows no light that bounces"
                     : "the light has no size, so no path meets it by chance"),
         "--integrator photon shows such caustics, and so does whitted with --caustics 200000" +
             std::string(hasSize ? "; path finds them with many samples" : ""));
    return;
  }
}

/// Lights that are shut by what they say themselves.
void lightCut(const LintScene& s, Findings& findings) {
  for (const LightSource& source : s.scene.lights) {
    if (maxComponent(colorOf(source.light)) == 0) continue;  // it is switched off
    if (const auto* measured = std::get_if<GoniometricLight>(&source.light)) {
      if (measured->file.data && measured->file.data->brightest() == 0)
        warn(findings, "light-cut", source.place,
             "the photometric file of this light has no light: all its candelas are 0",
             "take the file of a lamp that is lit, or a point_light");
      continue;
    }
    const auto* studio = std::get_if<WarnLight>(&source.light);
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
           "the flaps of this light cut off everything: no object is in what they leave",
           "flaps are planes in the space of the scene, not of the light: x_max = 1 leaves what lies at x < "
           "1");
  }
}

/// Names in the links of a light or an object that none of the others has, of which `kind` they are.
template <class Links>
void linksToNothing(const Links& links, const Place& place, const std::vector<std::string_view>& names,
                    const std::string& kind, const std::string& example, Findings& findings) {
  forEachField<Links>([&](const auto& f) {
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(links.*f.member)>, std::vector<std::string>>)
      for (const std::string& name : links.*f.member)
        if (std::find(names.begin(), names.end(), name) == names.end())
          warn(findings, "light-link", place,
               std::string(f.keyword) + " names \"" + name + "\", and no " + kind + " is called so",
               names.empty() ? "give " + kind + "s names, as in " + example : didYouMean(name, names));
  });
}

void lightLink(const LintScene& s, Findings& findings) {
  std::vector<std::string_view> objects, lights;
  for (const Object& object : s.scene.objects)
    if (!object.name.empty()) objects.push_back(object.name);
  for (const LightSource& source : s.scene.lights)
    if (!source.links.name.empty()) lights.push_back(source.links.name);
  for (const LightSource& source : s.scene.lights)
    linksToNothing(source.links, source.place, objects, "object", "sphere { name = \"ball\"; }", findings);
  for (const Object& object : s.scene.objects)
    linksToNothing(object.links, object.place, lights, "light", "point_light { name = \"key\"; ... }",
                   findings);
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
  if (s.scene.lights.empty()) return;  // said when it was read
  const bool isCauseSaid = spotsOnNothing(s, findings);
  for (std::uint32_t object = 0; object < s.scene.objects.size(); ++object) {
    const Survey::Seen& seen = s.survey.objects[object];
    if (seen.places < kFew || seen.lit > 0 || seen.couldBeLit < seen.places) continue;
    const auto most = mostIn(seen.blockedBy);
    const int blocked = most == seen.blockedBy.end() ? 0 : most->second;
    const bool outside = seen.outOfCone > max(seen.facesAway, blocked);
    if (outside && isCauseSaid) continue;
    const bool away = !outside && (blocked == 0 || seen.facesAway > blocked);
    warn(
        findings, "unlit", placeOf(s, object),
        quoted(s, object) + " is seen, but no light reaches what is seen of it: it is black" +
            (outside ? "; it is outside the cone of the spot light"
             : away  ? "; it faces away from the lights"
                     : (most->first == object ? "; it stands in its own light"
                                              : "; in the way is " + quoted(s, most->first))),
        outside
            ? "turn a spot light's direction to it, or give it a larger angle; or add an ambient light with "
              "`ambient` in the material"
        : away
            ? "move a light to the side that is seen, add an ambient light with `ambient` in the material, "
              "or "
              "turn its faces round"
            : "move the light or what is in the way, or add an ambient light with `ambient` in the material");
  }
}

// --- the camera ---------------------------------------------------------------------------------------

void cameraInside(const LintScene& s, Findings& findings) {
  const auto others = [&](std::uint32_t object) {
    int places = 0;
    for (std::uint32_t i = 0; i < s.survey.objects.size(); ++i)
      if (i != object) places += s.survey.objects[i].places;
    return places;
  };
  for (std::uint32_t object : s.aroundCamera) {
    const bool glass = !s.world.opaque(object);
    const Survey::Seen& seen = s.survey.objects[object];
    if (!glass && seen.lit > 0 && seen.direct == 0 && seen.facesAway >= seen.places && seen.couldBeLit > 0 &&
        isBlack(s.world.termsOf(object).emissive))
      warn(findings, "unlit", placeOf(s, object),
           "the camera is inside " + quoted(s, object) +
               ", whose faces look outward: lights in it do not light its walls, which have ambient light "
               "alone",
           "build a room of squares, or of a mesh whose faces look inward, or cut it out of a larger solid "
           "by a "
           "difference");
    if (!glass && (s.survey.objects[object].lit > 0 || others(object) > 0)) continue;  // a room
    warn(findings, "camera-inside", placeOf(s, object),
         "the camera is inside " + quoted(s, object) +
             (glass ? ": all is seen through its surface, from within"
                    : ": only its inside is seen, which no light reaches"),
         "move the camera's position out of it");
  }
}

void cameraLooksAway(const LintScene& s, Findings& findings) {
  if (s.scene.objects.empty() || s.survey.met > 0) return;
  const Place& place = s.remarks.camera;
  const CameraFrame& camera = s.world.camera();
  if (s.survey.cutOff > 0) {
    warn(findings, "camera-looks-away", place,
         "nothing is seen: the objects before the camera are not between its near and far, " +
             toText(camera.near) + " and " + toText(camera.far),
         "`near` and `far` of the camera bound the distance of what it sees; without them it sees all");
    return;
  }
  Box3 all;
  for (const Object& object : s.scene.objects) {
    const Box3 box = boxAround(object);
    if (box.empty() || box.unbounded()) continue;  // what has no end is met if it is in sight
    if (!isOutside(camera, box)) return;           // it may be small
    all.extend(box);
  }
  const Vec3 middle = all.center();
  const bool known = !all.empty() && s.scene.format == "ray";
  warn(findings, "camera-looks-away", place,
       "the camera faces away from everything: nothing is in the picture",
       known ? "look_at = (" + toText(roundedTo(middle.x)) + ", " + toText(roundedTo(middle.y)) + ", " +
                   toText(roundedTo(middle.z)) + "); in place of viewdir turns it to the middle of the scene"
             : "turn it, or move it back");
}

void blackReflection(const LintScene& s, Findings& findings) {
  constexpr int kFew = 20;
  for (std::uint32_t object = 0; object < s.survey.objects.size(); ++object) {
    const Survey::Seen& seen = s.survey.objects[object];
    if (seen.leftScene < kFew || 2 * seen.leftScene < seen.sent) continue;
    const bool mirrors = 2 * seen.mirroredAway >= seen.leftScene;
    warn(findings, "black-reflection", placeOf(s, object),
         quoted(s, object) + (mirrors ? " mirrors black" : " lets black through") +
             " where it should show the background: only rays of the camera see that",
         "every ray sees a `gradient` in `background`, a sky by day and what --environment names; or put "
         "objects "
         "where it " +
             std::string(mirrors ? "mirrors" : "is looked through to") + " nothing");
  }
}

}  // namespace trace::lint_checks
