#include "render/picture/agreement.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "image/srgb.h"
#include "math/elementary.h"
#include "math/hypothesis.h"
#include "render/picture/passes.h"
#include "render/picture/render.h"
#include "render/samples/integrator.h"

namespace trace {
namespace {

/// The light of the tiles, one number for each picture. Integrators are prepared anew for each.
std::vector<std::vector<double>> tilesOf(const Scene& scene, Settings settings, int seeds, int tile) {
  std::vector<std::vector<double>> tiles;
  Messages messages;
  const World world = compile(scene, settings, messages);
  const Size size = pictureSize(settings, scene.camera);
  for (settings.seed = 1; settings.seed <= seeds; ++settings.seed) {
    Film film = makeFilm(settings, size.width, size.height);
    Job job;
    const RenderResult result = render(world, settings, film, job);
    if (result.end != End::finished) throw Error(Fault::limit, "the render did not end: " + result.failure);
    const Picture picture = film.picture();
    const int columns = size.width / tile, rows = size.height / tile;
    tiles.resize(static_cast<std::size_t>(columns * rows));
    for (auto& values : tiles) values.push_back(0);
    for (int y = 0; y < rows * tile; ++y)
      for (int x = 0; x < columns * tile; ++x)
        tiles[static_cast<std::size_t>(y / tile * columns + x / tile)].back() +=
            luminanceOf(picture.at(x, y)) / (tile * tile);
  }
  return tiles;
}

Moments wholeOf(const std::vector<std::vector<double>>& tiles) {
  std::vector<double> pictures(tiles.front().size());
  for (const auto& values : tiles)
    for (std::size_t i = 0; i < values.size(); ++i)
      pictures[i] += values[i] / static_cast<double>(tiles.size());
  return momentsOf(pictures);
}

}  // namespace

Agreement agreement(const Scene& scene, const Settings& a, const Settings& b, int seeds, int tile,
                    double bias) {
  const auto ofA = tilesOf(scene, a, seeds, tile), ofB = tilesOf(scene, b, seeds, tile);
  Agreement result;
  double smallest = 1;
  for (std::size_t i = 0; i < ofA.size(); ++i) {
    const Moments tileA = momentsOf(ofA[i]);
    Moments tileB = momentsOf(ofB[i]);
    const double may = bias * tileA.mean;
    tileB.mean += std::clamp(tileA.mean - tileB.mean, -may, may);
    result.p.push_back(welch(tileA, tileB));
    smallest = std::min(smallest, result.p.back());
  }
  result.uniform = kolmogorovSmirnov(result.p);
  result.least = 1 - math::pow(1 - smallest, static_cast<double>(result.p.size()));
  const Moments wholeA = wholeOf(ofA), wholeB = wholeOf(ofB);
  result.meanA = wholeA.mean;
  result.meanB = wholeB.mean;
  result.error = std::sqrt(wholeA.variance / wholeA.count + wholeB.variance / wholeB.count);
  return result;
}

}  // namespace trace
