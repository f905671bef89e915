// A scene that is read once, for sessions with several settings.
#pragma once

#include <span>

#include "app/session/session.h"
#include "scene/quality.h"

namespace trace::test {

/// Opens the scene of a session for another, with choices of its own that choose no other moment.
inline void openAgain(Session& session, const Session& read, std::span<const Choice> choices) {
  const Scene& scene = read.scene();
  session.open(scene, settingsFor(scene, {scene.choices, choices}), read.sceneAt());
}

}  // namespace trace::test
