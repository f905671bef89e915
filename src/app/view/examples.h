// Scenes to begin with: those that come with the program, as small pictures, and lessons about mistakes.
#pragma once

#include <string>
#include <vector>

#include "image/development/tone.h"
#include "scene/scene.h"

namespace trace {

struct ExampleScene {
  std::string title, about, file;
};

/// The folder of the scenes that come with a program of that path, installed or in its checkout; "" if there
/// is none.
std::string examplesFolder(const std::string& program);

/// Those of the folder that a person may begin with. What the folder lacks is left out.
std::vector<ExampleScene> examplesIn(const std::string& folder);
/// Scenes with a mistake to be found.
std::vector<ExampleScene> lessonsIn(const std::string& folder);
/// A scene for each integrator that shows its purpose. Their titles are the integrators' names.
std::vector<ExampleScene> integratorScenesIn(const std::string& folder);

/// A small picture of the scene of that file, with few samples. Empty if it cannot be read or rendered.
Bytes thumbnail(const std::string& file, int width);
/// A small picture of a scene that was read before. Throws Error.
Bytes thumbnail(Scene scene, int width);

}  // namespace trace
