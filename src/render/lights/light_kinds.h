// Where the rays of a light of the scene start, for paths and photons that begin there.
#pragma once

#include <type_traits>
#include <variant>

#include "shading/lights/light.h"

namespace trace {

/// On a panel, by the cosine.
template <class L>
concept PanelLight = requires(const L& l) {
  l.twoSided;
};
/// At a point, or on the ball around it if it has a radius.
template <class L>
concept PointOrBall = requires(const L& l) {
  l.position;
  l.radius;
};
/// From afar, or nowhere: ambient light has no rays, and a portal is a place where others come in.
template <class L>
concept ParallelOrNone =
    std::is_same_v<L, DirectionalLight> || std::is_same_v<L, AmbientLight> || std::is_same_v<L, Portal>;

template <class... L>
constexpr bool allStart(const std::variant<L...>*) {
  return ((PanelLight<L> + PointOrBall<L> + ParallelOrNone<L> == 1) && ...);
}
static_assert(allStart(static_cast<const Light*>(nullptr)),
              "tell here, in light_starts.cpp and in photon_emitter.cpp where rays of the new light start");

}  // namespace trace
