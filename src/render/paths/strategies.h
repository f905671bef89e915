// The strategies by which a path is joined from two ends: s of its vertices come from a light, t from the
// camera.
#pragma once

#include <algorithm>

#include "math/vec.h"

namespace trace {

/// The strategies that a sample shows, and how much each counts.
struct Strategies {
  int light = -1, camera = -1;  ///< s and t; -1: any
  Real counts = 1;

  bool shows(int s, int t) const { return (light < 0 || light == s) && (camera < 0 || camera == t); }

  /// One strategy of a path of at most `most` vertices, both ends among them, by two numbers from 0 up to 1.
  /// The first chooses the number of vertices, few more likely than many; it counts the more, the less
  /// likely it is (Hachisuka, Kaplanyan and Dachsbacher 2014).
  static Strategies chosen(int most, const Vec2& u) {
    constexpr int kFewest = 2;
    const auto likely = [](int vertices) { return 1.0 / vertices; };
    Real all = 0;
    for (int vertices = kFewest; vertices <= most; ++vertices) all += likely(vertices);
    Real rest = u.x * all;
    int vertices = kFewest;
    while (vertices < most && rest >= likely(vertices)) rest -= likely(vertices++);
    const int s = std::min(static_cast<int>(u.y * vertices), vertices - 1);
    return {s, vertices - s, all / likely(vertices) * vertices};
  }
};

}  // namespace trace
