#include "scene/conventions.h"

#include <array>

namespace trace {

std::span<const Convention> conventions() {
  // Columns as in docs/conventions.md, where each value's source is given.
  static const std::array<Convention, 4> kTable{{
      {Like::uw,
       "uw",
       "University of Washington, 2010 to 2015",
       {{"highlight", "blinn"},
        {"shininess-scale", "1"},
        {"mirror-default", "specular"},
        {"diffuse-sides", "front"},
        {"limit-attenuation", "on"},
        {"glass", "per-crossing"},
        {"air-index", "1.0003"},
        {"back-faces", "both"},
        {"vertex-normals", "unit"},
        {"camera-axes", "orthonormal"},
        {"pixel-position", "corner"},
        {"tone", "clamp"},
        {"rounding", "truncate"}}},
      {Like::uw2009,
       "uw2009",
       "University of Washington, 2005 to 2009",
       {{"highlight", "phong"},
        {"shininess-scale", "1"},
        {"mirror-default", "specular"},
        {"diffuse-sides", "front"},
        {"limit-attenuation", "on"},
        {"glass", "per-crossing"},
        {"air-index", "1.0003"},
        {"back-faces", "both"},
        {"vertex-normals", "mean"},
        {"camera-axes", "raw"},
        {"pixel-position", "corner"},
        {"tone", "clamp"},
        {"rounding", "truncate"}}},
      {Like::uw2001,
       "uw2001",
       "University of Washington, 2001, and courses that kept its skeleton",
       {{"highlight", "phong"},
        {"shininess-scale", "128"},
        {"mirror-default", "specular"},
        {"diffuse-sides", "front"},
        {"limit-attenuation", "on"},
        {"glass", "per-crossing"},
        {"air-index", "1.0003"},
        {"back-faces", "cull-all"},
        {"vertex-normals", "mean"},
        {"camera-axes", "normalized"},
        {"pixel-position", "corner"},
        {"tone", "clamp"},
        {"rounding", "truncate"}}},
      {Like::ut,
       "ut",
       "University of Texas at Austin, since 2015",
       {{"highlight", "phong"},
        {"shininess-scale", "1"},
        {"mirror-default", "zero"},
        {"diffuse-sides", "both-on-glass"},
        {"limit-attenuation", "on"},
        {"glass", "per-distance"},
        {"air-index", "1"},
        {"back-faces", "cull-seen"},
        {"vertex-normals", "mean"},
        {"camera-axes", "raw"},
        {"pixel-position", "corner"},
        {"tone", "clamp"},
        {"rounding", "truncate"}}},
  }};
  return kTable;
}

const Convention& convention(Like like) { return conventions()[static_cast<size_t>(like)]; }

}  // namespace trace
