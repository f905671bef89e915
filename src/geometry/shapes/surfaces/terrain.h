// Fractal terrain: octaves of noise, each finer and lower than the one before (Mandelbrot; Musgrave, Kolb and
// Mace, The Synthesis and Rendering of Eroded Fractal Terrains, 1989), traced as a height field.
#pragma once

#include <memory>
#include <string_view>

#include "base/field.h"
#include "geometry/shapes/surfaces/traced_heights.h"

namespace trace {

struct ShapeFacts;

struct Terrain {
  static constexpr std::string_view kKeyword = "terrain";
  static constexpr std::string_view kHelp = "fractal landscape over x and y from -1 to 1, down to a floor";
  static constexpr int kMostPoints = 2048;

  int seed = 1, points = 129, octaves = 8;
  Real roughness = 0.5, hills = 2, ridges = 0, height = 0.5, floor = -0.5;
  bool smooth = false, capped = true;

  static constexpr auto fields() {
    return Fields{
        Field{"seed", &Terrain::seed, "", 0, kNoLimit, "another number, another landscape"},
        Field{"points", &Terrain::points, "", 2, kMostPoints, "number of grid points along each side"},
        Field{"octaves", &Terrain::octaves, "", 1, 20,
              "octaves of noise, each twice as fine as the previous one"},
        Field{"roughness", &Terrain::roughness, "", 0, 1,
              "amplitude of an octave relative to the previous one"},
        Field{"hills", &Terrain::hills, "", 0, 1000, "hills of the first octave along each side"},
        Field{"ridges", &Terrain::ridges, "", 0, 1, "0: rolling hills; 1: sharp crests"},
        Field{"height", &Terrain::height, "", -kNoLimit, kNoLimit, "about that of the highest hills"},
        Field{"floor", &Terrain::floor, "", -kNoLimit, kNoLimit, "z of the flat bottom"},
        Field{"smooth", &Terrain::smooth, "", 0, 1, "bicubic patches; else bilinear ones"},
        Field{"capped", &Terrain::capped, "", 0, 1, "solid, with sides and a bottom; else an open sheet"}};
  }
  bool operator==(const Terrain&) const = default;

  std::shared_ptr<const TracedHeights> prepared() const;
  /// Its bounds are as high as hills of that height can be.
  ShapeFacts checked() const;
};

}  // namespace trace
