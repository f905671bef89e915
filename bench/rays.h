// The rays that kernels are measured with, by kind, and the kernels' answers.
//
//   primary          from the eye through pixel centres, in blocks of 4 x 2 pixels
//   primary_packets  the same rays, eight at a time
//   bounce           one per primary hit, cosine-distributed about the normal that faces the eye, in the same
//   order bounce_shuffled  the same rays in random order: nothing that a ray fetched helps the next one
//   shadow           any-hit, from each primary hit that faces the light to 0.999 of the way to it
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "geometry/mesh/mesh.h"
#include "view.h"

namespace trace::bench {

/// Neutral between the kernels: each converts it to its own record, inside the time that is measured.
struct BenchRay {
  Vec3f origin;
  float tMin = 0;
  Vec3f direction;  ///< unit
  float tMax = std::numeric_limits<float>::infinity();
};

struct Answer {
  float t = std::numeric_limits<float>::infinity();  ///< infinite: nothing was hit. 0 or infinite for any hit
  std::uint32_t triangle = 0;
  bool hit() const { return t < std::numeric_limits<float>::infinity(); }
};

struct RaySet {
  std::string_view kind;
  bool anyHit = false;
  std::vector<BenchRay> rays;
  bool together = false;  ///< eight at a time
};

std::vector<BenchRay> primaryRays(const View& view);

/// The other three kinds, from where `primary` hit. The same numbers on every machine.
std::array<RaySet, 3> secondaryRays(const View& view, const MeshData& mesh, std::span<const BenchRay> primary,
                                    std::span<const Answer> answers);

}  // namespace trace::bench
