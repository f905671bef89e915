// THE table of scene formats, and reading any of them. A format is recognised by its content.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "base/error.h"
#include "scene/scene.h"

namespace trace {

struct SceneFormat {
  std::string_view name;
  std::string_view help;
  bool (*recognises)(std::string_view bytes);
  /// Repairs what it can with warnings. Throws Error(Fault::scene) for the rest.
  Scene (*read)(const std::string& file, std::string_view bytes, Messages& messages);
  /// The same at a moment, in seconds, if the format knows time.
  Scene (*readAt)(const std::string& file, std::string_view bytes, Messages& messages, Real time) = nullptr;
};

std::span<const SceneFormat> sceneFormats();

/// The scene at `time`, in seconds. Throws Error(Fault::io) when the file cannot be read, Error(Fault::scene)
/// when no format fits or the content is wrong.
Scene readScene(const std::string& file, Messages& messages, Real time = 0);
Scene readScene(const std::string& file, std::string_view bytes, Messages& messages, Real time = 0);

}  // namespace trace
