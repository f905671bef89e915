#include "app/agreement.h"

#include <cmath>

#include "app/session.h"
#include "base/error.h"
#include "formats/format.h"
#include "image/srgb.h"
#include "math/hypothesis.h"

namespace trace {
namespace {

Picture pictureOf(const std::string& text, std::span<const Choice> choices, int seed) {
  Messages messages;
  Scene scene = readScene("room.ray", "SBT-raytracer 1.0\n" + text, messages, 0);
  messages.throwIfFailed();
  std::vector<Choice> all(choices.begin(), choices.end());
  all.push_back({"seed", std::to_string(seed), {}});
  const Settings settings = settingsFor(scene.camera, {scene.choices, all});
  Session session;
  session.open(std::move(scene), settings);
  session.build();
  const RenderResult result = session.renderPicture();
  if (result.end != End::finished) throw Error(Fault::limit, "the render did not end: " + result.failure);
  return session.picture();
}

/// The light of the tiles, one number for each picture.
std::vector<std::vector<double>> tilesOf(const std::string& scene, std::span<const Choice> choices, int seeds,
                                         int tile) {
  std::vector<std::vector<double>> tiles;
  for (int seed = 1; seed <= seeds; ++seed) {
    const Picture picture = pictureOf(scene, choices, seed);
    const int columns = picture.width / tile, rows = picture.height / tile;
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

Agreement agreement(const std::string& scene, std::span<const Choice> a, std::span<const Choice> b, int seeds,
                    int tile) {
  const auto ofA = tilesOf(scene, a, seeds, tile), ofB = tilesOf(scene, b, seeds, tile);
  Agreement result;
  for (std::size_t i = 0; i < ofA.size(); ++i)
    result.p.push_back(welch(momentsOf(ofA[i]), momentsOf(ofB[i])));
  result.uniform = kolmogorovSmirnov(result.p);
  const Moments wholeA = wholeOf(ofA), wholeB = wholeOf(ofB);
  result.meanA = wholeA.mean;
  result.meanB = wholeB.mean;
  result.error = std::sqrt(wholeA.variance / wholeA.count + wholeB.variance / wholeB.count);
  return result;
}

std::string roomText(Room room) {
  const bool door = room == Room::door;
  std::string text = R"(
settings { width = 32; height = 32; depth = 4; sampling = random; fresnel = exact; air-index = 1; integrator = path; }
camera { position = (0, 1, 3.8); viewdir = (0, 0, -1); updir = (0, 1, 0); fov = 36; }
material = { name = "white"; diffuse = (0.7, 0.7, 0.7); };
rotate(1, 0, 0, -1.5707963267948966, scale(2, 2, 1, square { material = "white"; }))
translate(0, 2, 0, rotate(1, 0, 0, 1.5707963267948966, scale(2, 2, 1, square { material = "white"; })))
translate(0, 1, -1, scale(2, 2, 1, square { material = "white"; }))
translate(-1, 1, 0, rotate(0, 1, 0, 1.5707963267948966, scale(2, 2, 1, square { material = { diffuse = (0.6, 0.1, 0.1); } })))
translate(1, 1, 0, rotate(0, 1, 0, -1.5707963267948966, scale(2, 2, 1, square { material = { diffuse = (0.1, 0.5, 0.1); } })))
)";
  text += door ? R"(
translate(-0.5, 1, 0.2, rotate(0, 1, 0, 1.3, scale(0.05, 1.99, 1.2, box { material = "white"; })))
translate(-0.75, 1.9, -0.6, rotate(1, 0, 0, 1.5707963267948966, scale(0.4, 0.4, 1, square { material = { emissive = (60, 60, 60); diffuse = (0.5, 0.5, 0.5); } })))
)"
                 : R"(
translate(0, 1.99, 0, rotate(1, 0, 0, 1.5707963267948966, scale(0.7, 0.7, 1, square { material = { emissive = (8, 8, 8); diffuse = (0.5, 0.5, 0.5); } })))
translate(-0.4, 0.45, -0.4, rotate(0, 1, 0, 0.3, scale(0.5, 0.9, 0.5, box { material = "white"; })))
)";
  if (room == Room::diffuse)
    text += "translate(0.4, 0.3, 0.3, rotate(0, 1, 0, -0.3, scale(0.5, 0.6, 0.5, box { material = \"white\"; })))\n";
  else if (room == Room::mirror)
    text += "translate(0.4, 0.36, 0.3, scale(0.35, sphere { material = { reflective = (0.9, 0.9, 0.9); } }))\n";
  else if (room == Room::glass)
    text +=
        "translate(0.4, 0.36, 0.3, scale(0.35, sphere { material = { transmissive = (1, 1, 1); reflective = "
        "(1, 1, 1); index = 1.5; } }))\n";
  return text;
}

}  // namespace trace
