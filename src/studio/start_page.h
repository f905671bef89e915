// The page in place of the picture while no scene is open: lessons, scenes and recent files.
#pragma once

#include <imgui.h>

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/session/background_task.h"
#include "app/view/examples.h"
#include "studio/widgets/texture.h"

namespace trace::studio {

struct Studio;

struct StartPage {
  std::string folder;  ///< folder of the scenes that come with the program; "" if there is none
  std::vector<ExampleScene> lessons, integrators, scenes;
  /// Small pictures of the lessons, of those for integrators, then of the scenes, as far as they are made.
  std::vector<std::unique_ptr<Texture>> pictures;
  struct Thumbnail {
    Bytes bytes;
  };
  BackgroundTask<Thumbnail> task;
  using Clock = std::chrono::steady_clock;
  std::optional<Clock::time_point>
      rests;            ///< until then none is made: without threads that would stop all else
  bool looked = false;  ///< for the scenes
  bool complete() const {
    return looked && pictures.size() == lessons.size() + integrators.size() + scenes.size();
  }
  /// A small picture is there to be shown.
  bool news(bool sceneIsOpen) const {
    return !sceneIsOpen && (rests ? Clock::now() >= *rests : task.hasNews());
  }
};

void drawStart(Studio& studio, ImVec2 area);

}  // namespace trace::studio
