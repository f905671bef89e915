#include "formats/ray/read/light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/text.h"
#include "formats/ray/read/fields.h"
#include "math/elementary.h"
#include "shading/lights/light.h"
#include "shading/lights/point_light.h"
#include "shading/lights/spot_light.h"
#include "shading/lights/warn_light.h"

namespace trace::rayfile {
namespace {

/// Students' names of a point light with a size, and that size.
constexpr std::string_view kAreaLight = "area_light";
constexpr std::array<std::string_view, 3> kRadius{"bottom_radius", "light_radius", "area"};

/// Students' names of the fields of spot lights (docs/lights.md).
class StudentSpot {
 public:
  /// Reads the field if it is one of these.
  bool read(Findings& findings, const Item& item, SpotLight& light) {
    const std::string_view key = item.key();
    const auto number = [&](Real& to) { rayfile::read(findings, key, item.value(), to); };
    if (key == "size") {
      Real whole = 2 * light.angle;
      number(whole);
      light.angle = std::min(whole / 2, 180.0);
    } else if (key == "edgeplace" && !item.value().is(Kind::number)) {
      Vec3 edge{light.angle, 0, 0};
      rayfile::read(findings, key, item.value(), edge);
      light.angle = edge.x;
    } else if (key == "edgeplace" || key == "atten_angle") {
      number(light.angle);
    } else if (key == "blend") {
      number(blend_);
      return true;
    } else if (key == "fall_rate") {
      number(light.exponent);
      return true;
    } else {
      return false;
    }
    sharp_ = true;
    return true;
  }

  /// The default of the part that does not fade.
  void settle(SpotLight& light) const {
    // Blender's: the part of the cone that fades, measured along the axis.
    const Real edge = math::cos(light.angle * kPi / 180), soft = std::clamp(blend_, 0.0, 1.0);
    if (blend_ > 0)
      light.fullAngle = math::acos(std::min(1.0, edge + (1 - edge) * soft)) * 180 / kPi;
    else if (sharp_)
      light.fullAngle = light.angle;
  }

 private:
  Real blend_ = 0;
  bool sharp_ = false;
};

/// The type of light with that keyword; null if none has it.
const LightType* typeCalled(std::string_view keyword) {
  return findLightType(keyword == kAreaLight ? PointLight::kKeyword : keyword);
}

/// Fields that a light cannot do without, if it has them. Of a kind with defaults, a light is white.
bool isRequired(std::string_view field, bool isOfKind) {
  return field == "position" || field == "direction" || (field == "color" && !isOfKind);
}

std::string lightWord(const Light& light) { return std::string(light.keyword()); }

bool checkDirection(Findings& findings, const Item& call, const Light& light) {
  const Vec3* direction = light.direction();
  const Real l = direction ? length(*direction) : 1;
  if (l > 0 && std::isfinite(l)) return true;
  findings.error(call, lightWord(light) + ": expected a direction, found one of length " + toText(l));
  return false;
}

/// A panel whose sides are parallel, or 0, has no area and gives no light.
void checkArea(Findings& findings, const Item& call, const Light& light) {
  const Vec3 *u = findValue<Vec3>(light, "u"), *v = findValue<Vec3>(light, "v");
  if (u && v && !(length(cross(*u, *v)) > 0))
    findings.warn(call, lightWord(light) + ": expected sides u and v that are not parallel: it is dark");
}

/// True if a radius below 0 was found, and set to 0.
bool checkRadius(Findings& findings, const Item& item, Light& light) {
  Real* radius = editableValue<Real>(light, "radius");
  if (!radius || !(*radius < 0)) return false;
  findings.warn(item, std::string(item.key()) + " of " + lightWord(light) + ": expected at least 0, found " +
                          toText(*radius) + ": the light has no size");
  *radius = 0;
  return true;
}

/// Between nothing and all that is ahead.
bool checkView(Findings& findings, const Item& call, const Light& light) {
  const Real* fov = findValue<Real>(light, "fov");
  if (!fov || (*fov > 0 && *fov < 180)) return true;
  findings.error(call,
                 lightWord(light) + ": expected a fov between 0 and 180 degrees, found " + toText(*fov));
  return false;
}

/// The up direction is undefined where it lies along the direction.
void checkUp(Findings& findings, const Item& call, const Light& light) {
  const Vec3 *up = findValue<Vec3>(light, "up"), *direction = light.direction();
  if (up && direction && !(length(cross(*direction, *up)) > 0))
    findings.warn(
        call, lightWord(light) + ": expected an up that is not along the direction: another one is chosen");
}

/// Flaps that shut leave nothing of the light.
void checkFlaps(Findings& findings, const Item& call, const Light& light) {
  const WarnLight* warn = light.as<WarnLight>();
  if (!warn) return;
  const std::string axis = warn->xMin > warn->xMax   ? "x"
                           : warn->yMin > warn->yMax ? "y"
                           : warn->zMin > warn->zMax ? "z"
                                                     : "";
  if (!axis.empty())
    findings.warn(call, lightWord(light) + ": expected " + axis + "_min below " + axis + "_max: it is dark");
}

/// It fades as a lamp does of which the file says nothing else.
bool fadesAsByDefault(const Light& light) {
  const auto is = [&](std::string_view keyword, Real number) {
    return *findValue<Real>(light, keyword) == number;
  };
  return is("constant_attenuation_coeff", 0) && is("linear_attenuation_coeff", 0) &&
         is("quadratic_attenuation_coeff", 1);
}

void read(Findings& findings, const Item& call, const LightType& type) {
  const std::optional<Item> block = blockOf(findings, call);
  if (!block) return;
  Light light(type);
  LightLinks links;
  StudentSpot spot;
  const std::size_t errors = findings.errors();
  std::vector<std::string_view> given, unknown;
  Real power = 0;  ///< watts; 0: not given
  const bool fades = type.starts == LightOrigin::ball;
  if (findings.isOfKind())
    if (Color* color = editableValue<Color>(light, "color")) *color = Color(1);
  RepeatedFields repeats(findings, type.keyword);
  for (const Item item : *block) {
    if (!isField(findings, item, type.keyword)) continue;
    repeats.note(item);
    if (call.key() == kAreaLight && std::find(kRadius.begin(), kRadius.end(), item.key()) != kRadius.end()) {
      rayfile::read(findings, item.key(), item.value(), light.edit<PointLight>()->radius);
      checkRadius(findings, item, light);
      continue;
    }
    if (SpotLight* cone = light.edit<SpotLight>())
      if (spot.read(findings, item, *cone)) continue;
    if (fades && findings.isOfKind() && item.key() == kWatts) {
      if (rayfile::read(findings, kWatts, item.value(), power) && !(power > 0))
        findings.expected(item.value(), kWatts, "watts, more than 0");
      continue;
    }
    if (assignField(findings, links, item)) {
      if (item.key() == "lights" && links.lights.empty())
        findings.warn(item, "lights: a list without names is as none: everything is lit",
                      "excludes names what the light leaves out");
      continue;
    }
    if (!assignField(findings, light, item)) {
      findings.unknownField(type.keyword, item,
                            keywords(light, {"colour", "name", "lights", "excludes", "casts_shadows"}));
      unknown.push_back(item.key());
      continue;
    }
    if (!checkRadius(findings, item, light)) checkRange(findings, light, item);
    if (canonical(item.key()) == "color") warnOfBytes(findings, type.keyword, item);
    given.push_back(canonical(item.key()));
  }
  const auto isGiven = [&](std::string_view field) {
    return std::find(given.begin(), given.end(), field) != given.end();
  };
  for (const LightField& field : light.fields()) {
    if (!isRequired(field.keyword, findings.isOfKind()) || isGiven(field.keyword)) continue;
    const std::string meant = nearest(field.keyword, unknown);
    findings.error(call, lightWord(light) + ": expected a " + std::string(field.keyword),
                   meant.empty() ? ""
                                 : "\"" + meant + "\" is not known: did you mean \"" +
                                       std::string(field.keyword) + "\"?");
  }
  if (findings.errors() != errors || !checkDirection(findings, call, light) ||
      !checkView(findings, call, light))
    return;
  checkArea(findings, call, light);
  checkFlaps(findings, call, light);
  if (isGiven("up")) checkUp(findings, call, light);
  if (Real* exponent = editableValue<Real>(light, "exponent")) *exponent = std::max(0.0, *exponent);
  if (SpotLight* cone = light.edit<SpotLight>()) {
    const bool fullAngle = isGiven("full_angle");
    if (!fullAngle) spot.settle(*cone);
    if (cone->fullAngle > cone->angle && fullAngle)
      findings.warn(call, "spot_light: expected a full_angle of at most the angle, found " +
                              toText(cone->fullAngle) + " and " + toText(cone->angle));
  }
  if (fades && power > 0) {
    Color& color = *editableValue<Color>(light, "color");
    color = color * (power / kPowerOfOne);
  } else if (fades && fadesAsByDefault(light)) {
    findings.given().fading.push_back(findings.scene().lights.size());
  }
  findings.scene().lights.push_back(
      {std::move(light), findings.syntax().shortPlace(call.offset()), std::move(links)});
}

}  // namespace

bool isLight(std::string_view keyword) { return typeCalled(keyword) != nullptr; }

void addLightWords(std::vector<std::string_view>& words) {
  for (const LightType& type : lightTypes()) words.push_back(type.keyword);
}

bool readLight(Findings& findings, const Item& call) {
  const LightType* type = typeCalled(call.key());
  if (type) read(findings, call, *type);
  return type != nullptr;
}

}  // namespace trace::rayfile
