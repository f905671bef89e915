// THE table of kinds of rays: what they are called and how they look, in text, in drawings and in the studio.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "math/color.h"

namespace trace {

/// bounce: scattered in a direction chosen at random; lamp: to a place of an object that emits light;
/// light: of a path that starts where light comes from.
enum class RayKind { camera, reflection, refraction, bounce, lamp, light, shadow };
inline constexpr std::size_t kRayKinds = 7;

/// A kind of ray as it is shown. Shadow rays that are blocked look different.
enum class RayLooks { camera, reflection, refraction, bounce, lamp, light, shadowLit, shadowBlocked };

struct RayLook {
  std::string_view kind;      ///< the kind's name, one word
  std::string_view name;      ///< one word
  std::string_view help;      ///< text of a legend
  Color color;                ///< colour on the screen, as levels from 0 to 1
  std::string_view terminal;  ///< the escape sequence that switches its colour on
};

/// In the order of RayLooks, which begins with that of RayKind. The colours stay apart for colour-blind eyes
/// (Okabe and Ito 2008) and on white and black.
inline constexpr std::array<RayLook, 8> kRayLooks{{
    {"camera", "camera", "camera ray", {0.35, 0.35, 0.35}, "\033[1m"},
    {"reflection", "reflection", "reflected", {0, 0.447, 0.698}, "\033[1;36m"},
    {"refraction", "refraction", "refracted", {0, 0.62, 0.451}, "\033[1;35m"},
    {"bounce", "bounce", "random bounce", {0.8, 0.475, 0.655}, "\033[1;31m"},
    {"lamp", "lamp", "ray to an emissive object", {0.55, 0.5, 0.05}, "\033[1;32m"},
    {"light", "light", "of a path from a light", {0.337, 0.706, 0.914}, "\033[1;34m"},
    {"shadow", "shadow-lit", "shadow ray that reaches its light", {0.902, 0.624, 0}, "\033[1;33m"},
    {"shadow", "shadow-blocked", "shadow ray that is blocked", {0.835, 0.169, 0.169}, "\033[1;33m"},
}};

constexpr const RayLook& look(RayLooks looks) { return kRayLooks[static_cast<std::size_t>(looks)]; }
constexpr const RayLook& look(RayKind kind) { return kRayLooks[static_cast<std::size_t>(kind)]; }
constexpr std::string_view name(RayKind kind) { return look(kind).kind; }

}  // namespace trace
