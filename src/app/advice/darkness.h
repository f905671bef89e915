// A picture that is nearly black: whether it is, why, and what makes it light.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "base/error.h"
#include "image/film/film.h"
#include "render/samples/picture_size.h"
#include "render/world/world.h"
#include "scene/scene.h"
#include "scene/settings.h"

namespace trace {

/// A picture of few pixels that stands for the whole one: linear light, the mean of what lies in each.
Picture cellsOf(const Film& film);
/// The same, traced for the purpose with as few samples as will do.
Picture tracedCells(const World& world, const Settings& settings);

/// Whether the camera sees an object somewhere in a picture of that size: few rays first, then one a pixel.
bool seesObjects(const World& world, const Size& size);
/// How the camera is pointed at the objects; "" if nothing has a place.
std::string whereToLook(const Scene& scene);

/// Facts of a render that advice needs besides its settings, whose exposure is settled.
struct RenderFacts {
  std::optional<Real> measured{};  ///< stops that automatic exposure added to the settings' own
  /// Asked where no light reaches what is seen: what the lights do wrong. May be null.
  std::function<std::optional<Message>()> whyUnlit{};
};

/// A warning if nearly all of the picture, and of what is seen of objects in it, is darker than 20 levels of
/// 255, else nothing. A dark background beside something that is lit is none of its business. Its hint works
/// as it stands: an exposure, the strength of a light, or a light, that brings the mean level of what is seen
/// to about 90, found by tracing; or where to look. Nothing if the time of the thread's budget is over.
std::optional<Message> darkness(const Scene& scene, const Settings& settings, const World& world,
                                const Picture& cells, const RenderFacts& facts = {});

}  // namespace trace
