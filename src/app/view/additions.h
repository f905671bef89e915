// The shapes, lights, materials and textures that a person may add to a scene, each with a small picture.
#pragma once

#include <string_view>
#include <vector>

#include "image/development/tone.h"

namespace trace {

/// A shape, a light, a material of the library, or a kind of texture.
struct Addition {
  enum class Kind { shape, light, material, texture };
  Kind kind = Kind::shape;
  std::string_view name, help;
  bool operator==(const Addition&) const = default;
};

/// All of that kind. A mesh is none of the shapes: it comes out of a file.
std::vector<Addition> additions(Addition::Kind kind);

/// Each of the words is in its name or in its help; small and capital letters are the same.
bool isAbout(const Addition& addition, std::string_view words);

/// A small picture, as wide as high; empty if there is nothing to see. Takes a while.
Bytes preview(const Addition& addition, int side);

}  // namespace trace
