// Small mesh files as text, for the tests of their readers.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "formats/format.h"
#include "geometry/mesh/mesh.h"
#include "ray_helpers.h"

namespace trace {

/// The scene in the bytes, with nothing repaired, though it may lack lights and have textures.
inline Scene sceneIn(std::string_view bytes) {
  Messages messages;
  Scene scene = readScene("test.ray", bytes, messages);
  for (const Message& warning : messages.all())
    if (!warning.what.starts_with("no light") && !warning.what.starts_with("the texture") &&
        !warning.what.starts_with("elements \"edge\"") && !warning.what.starts_with("properties of") &&
        !warning.what.starts_with("the transparency"))
      ADD_FAILURE() << toString(warning);
  return scene;
}

/// The mesh of the object.
inline const MeshData& meshOf(const Scene& scene, std::size_t object = 0) {
  return *scene.objects.at(object).shape.as<Mesh>()->data;
}

/// The warnings of reading the bytes, one per line.
inline std::string warningsOfFile(std::string_view bytes) {
  Messages messages;
  readScene("test.ray", bytes, messages);
  std::string lines;
  for (const Message& m : messages.all())
    if (!m.what.starts_with("no light")) lines += (lines.empty() ? "" : "\n") + toLine(m);
  return lines;
}

}  // namespace trace
