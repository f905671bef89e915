#include "formats/ray/ray_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <type_traits>

#include "base/match.h"
#include "base/text.h"
#include "formats/ray/ray_fields.h"
#include "shading/lights/light.h"

namespace trace::rayfile {
namespace {

/// What students called a point light with a size, and that size.
constexpr std::string_view kAreaLight = "area_light";
constexpr std::array<std::string_view, 3> kRadius{"bottom_radius", "light_radius", "area"};

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

/// Fields that a light cannot do without, if it has them.
bool isRequired(std::string_view field) {
  return field == "position" || field == "direction" || field == "color";
}

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

template <class L>
void read(Findings& findings, const Item& call) {
  const std::optional<Item> block = blockOf(findings, call);
  if (!block) return;
  L light;
  const std::size_t errors = findings.errors();
  std::vector<std::string_view> given;
  RepeatedFields repeats(findings, L::kKeyword);
  for (const Item item : *block) {
    if (!isField(findings, item, L::kKeyword)) continue;
    repeats.note(item);
    if constexpr (std::is_same_v<L, PointLight>)
      if (call.key() == kAreaLight &&
          std::find(kRadius.begin(), kRadius.end(), item.key()) != kRadius.end()) {
        rayfile::read(findings, item.key(), item.value(), light.radius);
        continue;
      }
    if (!assignField(findings, light, item)) {
      findings.unknownField(L::kKeyword, item, keywords<L>({"colour"}));
      continue;
    }
    checkRange(findings, light, item);
    given.push_back(canonical(item.key()));
  }
  forEachField<L>([&](const auto& field) {
    if (isRequired(field.keyword) && std::find(given.begin(), given.end(), field.keyword) == given.end())
      findings.error(call, std::string(L::kKeyword) + ": expected a " + std::string(field.keyword));
  });
  if (findings.errors() != errors || !checkDirection(findings, call, light)) return;
  checkArea(findings, call, light);
  if constexpr (requires { light.fullAngle; })
    if (light.fullAngle > light.angle &&
        std::find(given.begin(), given.end(), std::string_view("full_angle")) != given.end())
      findings.warn(call, "spot_light: expected a full_angle of at most the angle, found " +
                              toText(light.fullAngle) + " and " + toText(light.angle));
  findings.scene().lights.push_back({light, findings.syntax().shortPlace(call.offset())});
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
