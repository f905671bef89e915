#include "formats/ray/read/light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/match.h"
#include "base/text.h"
#include "formats/ray/read/fields.h"
#include "shading/lights/light.h"

namespace trace::rayfile {
namespace {

/// Students' names of a point light with a size, and that size.
constexpr std::string_view kAreaLight = "area_light";
constexpr std::string_view kWatts = "power";
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
    const Real edge = std::cos(light.angle * kPi / 180), soft = std::clamp(blend_, 0.0, 1.0);
    if (blend_ > 0)
      light.fullAngle = std::acos(std::min(1.0, edge + (1 - edge) * soft)) * 180 / kPi;
    else if (sharp_)
      light.fullAngle = light.angle;
  }

 private:
  Real blend_ = 0;
  bool sharp_ = false;
};

/// Calls visit(a null pointer to the type) for the type of light with that keyword; false if none has
/// it.
template <class Visit>
bool withLight(std::string_view keyword, Visit&& visit) {
  bool found = false;
  if (keyword == kAreaLight) keyword = PointLight::kKeyword;
  forEachType<Light>([&]<class T>(T* type) {
    if (T::kKeyword != keyword) return;
    found = true;
    visit(type);
  });
  return found;
}

/// Fields that a light cannot do without, if it has them. Of a kind with defaults, a light is white.
bool isRequired(std::string_view field, bool isOfKind) {
  return field == "position" || field == "direction" || (field == "color" && !isOfKind);
}

/// The watts of a light that shines to all sides with a colour of 1: a matt white surface at the distance 1
/// shows intensity / pi, and the intensity is power / (4 pi).
constexpr Real kPowerOfOne = 4 * kPi * kPi;

template <class L>
bool checkDirection(Findings& findings, const Item& call, const L& light) {
  if constexpr (requires { light.direction; }) {
    const Real l = length(light.direction);
    if (l > 0 && std::isfinite(l)) return true;
    findings.error(call,
                   std::string(L::kKeyword) + ": expected a direction, found one of length " + toText(l));
    return false;
  }
  return true;
}

/// A panel whose sides are parallel, or 0, has no area and gives no light.
template <class L>
void checkArea(Findings& findings, const Item& call, const L& light) {
  if constexpr (requires { light.u, light.v; })
    if (!(length(cross(light.u, light.v)) > 0))
      findings.warn(call,
                    std::string(L::kKeyword) + ": expected sides u and v that are not parallel: it is dark");
}

/// True if a radius below 0 was found, and set to 0.
template <class L>
bool checkRadius(Findings& findings, const Item& item, L& light) {
  if constexpr (requires { light.radius; }) {
    if (!(light.radius < 0)) return false;
    findings.warn(item, std::string(item.key()) + " of " + std::string(L::kKeyword) +
                            ": expected at least 0, found " + toText(light.radius) +
                            ": the light has no size");
    light.radius = 0;
    return true;
  }
  return false;
}

/// Between nothing and all that is ahead.
template <class L>
bool checkView(Findings& findings, const Item& call, const L& light) {
  if constexpr (requires { light.fov; }) {
    if (light.fov > 0 && light.fov < 180) return true;
    findings.error(call, std::string(L::kKeyword) + ": expected a fov between 0 and 180 degrees, found " +
                             toText(light.fov));
    return false;
  }
  return true;
}

/// The up direction is undefined where it lies along the direction.
template <class L>
void checkUp(Findings& findings, const Item& call, const L& light, bool given) {
  if constexpr (requires { light.up; })
    if (given && !(length(cross(light.direction, light.up)) > 0))
      findings.warn(call, std::string(L::kKeyword) +
                              ": expected an up that is not along the direction: another one is chosen");
}

/// Flaps that shut leave nothing of the light.
template <class L>
void checkFlaps(Findings& findings, const Item& call, const L& light) {
  if constexpr (requires { light.xMin; }) {
    const std::string axis = light.xMin > light.xMax   ? "x"
                             : light.yMin > light.yMax ? "y"
                             : light.zMin > light.zMax ? "z"
                                                       : "";
    if (!axis.empty())
      findings.warn(
          call, std::string(L::kKeyword) + ": expected " + axis + "_min below " + axis + "_max: it is dark");
  }
}

template <class L>
void read(Findings& findings, const Item& call) {
  const std::optional<Item> block = blockOf(findings, call);
  if (!block) return;
  L light;
  LightLinks links;
  StudentSpot spot;
  const std::size_t errors = findings.errors();
  std::vector<std::string_view> given, unknown;
  Real power = 0;  ///< watts; 0: not given
  if constexpr (requires { light.color; })
    if (findings.isOfKind()) light.color = Color(1);
  RepeatedFields repeats(findings, L::kKeyword);
  for (const Item item : *block) {
    if (!isField(findings, item, L::kKeyword)) continue;
    repeats.note(item);
    if constexpr (std::is_same_v<L, PointLight>)
      if (call.key() == kAreaLight &&
          std::find(kRadius.begin(), kRadius.end(), item.key()) != kRadius.end()) {
        rayfile::read(findings, item.key(), item.value(), light.radius);
        checkRadius(findings, item, light);
        continue;
      }
    if constexpr (std::is_same_v<L, SpotLight>)
      if (spot.read(findings, item, light)) continue;
    if constexpr (requires { light.quadratic; })
      if (findings.isOfKind() && item.key() == kWatts) {
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
      findings.unknownField(L::kKeyword, item, keywords<L>({"colour", "name", "lights", "excludes"}));
      unknown.push_back(item.key());
      continue;
    }
    if (!checkRadius(findings, item, light)) checkRange(findings, light, item);
    if (canonical(item.key()) == "color") warnOfBytes(findings, L::kKeyword, item);
    given.push_back(canonical(item.key()));
  }
  const auto isGiven = [&](std::string_view field) {
    return std::find(given.begin(), given.end(), field) != given.end();
  };
  forEachField<L>([&](const auto& field) {
    if (!isRequired(field.keyword, findings.isOfKind()) || isGiven(field.keyword)) return;
    const std::string meant = nearest(field.keyword, unknown);
    findings.error(call, std::string(L::kKeyword) + ": expected a " + std::string(field.keyword),
                   meant.empty() ? ""
                                 : "\"" + meant + "\" is not known: did you mean \"" +
                                       std::string(field.keyword) + "\"?");
  });
  if (findings.errors() != errors || !checkDirection(findings, call, light) ||
      !checkView(findings, call, light))
    return;
  checkArea(findings, call, light);
  checkFlaps(findings, call, light);
  checkUp(findings, call, light, isGiven("up"));
  if constexpr (requires { light.exponent; }) light.exponent = std::max(0.0, light.exponent);
  if constexpr (requires { light.fullAngle; }) {
    const bool fullAngle = isGiven("full_angle");
    if (!fullAngle) spot.settle(light);
    if (light.fullAngle > light.angle && fullAngle)
      findings.warn(call, "spot_light: expected a full_angle of at most the angle, found " +
                              toText(light.fullAngle) + " and " + toText(light.angle));
  }
  if constexpr (requires { light.quadratic; }) {
    const bool fades = light.constant == 0 && light.linear == 0 && light.quadratic == 1;
    if (power > 0)
      light.color = light.color * (power / kPowerOfOne);
    else if (fades)
      findings.given().fading.push_back(findings.scene().lights.size());
  }
  findings.scene().lights.push_back({light, findings.syntax().shortPlace(call.offset()), std::move(links)});
}

}  // namespace

bool isLight(std::string_view keyword) {
  return withLight(keyword, [](auto*) {});
}

void addLightWords(std::vector<std::string_view>& words) {
  forEachType<Light>([&]<class L>(L*) { words.push_back(L::kKeyword); });
}

bool readLight(Findings& findings, const Item& call) {
  return withLight(call.key(), [&]<class L>(L*) { read<L>(findings, call); });
}

}  // namespace trace::rayfile
