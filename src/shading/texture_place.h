// Where a texture is asked for its colour.
#pragma once

#include "math/vec.h"

namespace trace {

/// In the space of the object. The changes to the next pixel on the right (X) and above (Y) are 0 where a
/// point is asked for. The second coordinates are the first where a surface has no others.
struct TexturePlace {
  Vec3 point;
  Vec2 uv;
  Vec2 uvX, uvY;
  Vec3 pointX, pointY;
  Vec2 secondUv{}, secondUvX{}, secondUvY{};
};

}  // namespace trace
