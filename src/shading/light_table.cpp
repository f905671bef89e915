// The table of lights, made of their list.
#include <array>
#include <stdexcept>
#include <string>

#include "shading/light_list.h"
#include "shading/lights/light.h"

namespace trace {
namespace {

template <class L>
const L& lightHeld(const void* light) {
  return *static_cast<const L*>(light);
}

/// It has the fields that geometryOf() looks for.
template <class L>
constexpr bool startsFit() {
  switch (L::kStarts) {
    case LightOrigin::ball:
      return requires(const L& l) { l.position, l.radius, l.constant, l.linear, l.quadratic; };
    case LightOrigin::panel: return requires(const L& l) { l.position, l.u, l.v;
      };
    case LightOrigin::parallel: return requires(const L& l) { l.direction;
      };
    case LightOrigin::none: break;
  }
  return true;
}

template <class L>
LightType rowOfLight(std::size_t index) {
  constexpr bool kCanBeSeen = requires(const L& l, const Ray& ray, const Rules& rules) {
    l.seen(ray, rules);
  };
  static_assert(startsFit<L>(), "the light lacks a field of its kStarts");
  static_assert(
      kCanBeSeen == requires(const L& l) { l.visible; }, "seen() goes with the field `visible`");
  LightType row{ListedRow<LightField>::of<L>(index),
                L::kStarts,
                [](const void* light) { return lightHeld<L>(light).hasSize(); },
                [](const void* light, const Vec3& from, const Rules& rules, const Vec2& u) {
                  return lightHeld<L>(light).illuminate(from, rules, u);
                },
                [](const void* light, const Rules& rules) { return lightHeld<L>(light).reach(rules); },
                nullptr};
  if constexpr (kCanBeSeen)
    row.seen = [](const void* light, const Ray& ray, const Rules& rules) {
      return lightHeld<L>(light).seen(ray, rules);
    };
  return row;
}

}  // namespace

std::span<const LightType> lightTypes() {
  static const std::array kTable = []<std::size_t... I>(std::index_sequence<I...>) {
    return std::array{rowOfLight<std::variant_alternative_t<I, LightList>>(I)...};
  }
  (std::make_index_sequence<std::variant_size_v<LightList>>{});
  return kTable;
}

const LightType* findLightType(std::string_view keyword) {
  for (const LightType& type : lightTypes())
    if (type.keyword == keyword) return &type;
  return nullptr;
}

template <>
const LightType& rowCalled<LightType>(std::string_view keyword) {
  if (const LightType* type = findLightType(keyword)) return *type;
  throw std::logic_error("no light of the list is called " + std::string(keyword));
}

}  // namespace trace
