// THE table of passes: what camera rays hit, kept as pictures beside the picture (`--passes`). Each is a
// layer of the Film. A new one is one value of the enum Pass (scene/settings.h) and one row.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "image/film/film.h"
#include "render/picture/pass_facts.h"
#include "render/samples/integrator.h"

namespace trace {

/// A camera ray that hit something.
struct PassPlace {
  const CameraRay& camera;
  const Hit& hit;
  Tracer& tracer;
  const Sampler& sampler;
  const PassFacts* facts = nullptr;  ///< facts of its scene; null where a render has none
  Size size{};                       ///< size of the picture
  Color passes{1};                   ///< what mirrors and glass before it leave of its light
  Real before = 0;                   ///< the distance to the last of these
};

struct PassRow {
  Pass pass;
  std::string_view name;
  std::string_view help;
  Film::Keep keep;
  Color background;  ///< where a ray hits nothing that the camera sees, and where nothing is rendered
  Color tooNear;     ///< where it hits something nearer than the camera sees

  /// The value at the surface that a camera ray hits. A pass of one number has it in all three channels.
  /// Null: the pass is made of the finished picture, or of several layers.
  Color (*value)(const PassPlace&);
  /// The pass for the eye: values from 0 to 1 from raw ones.
  Picture (*shown)(const Picture& values, const Settings&);
  /// The value is that of what is seen behind mirrors and glass (seen_behind.h): no pass, but a guide.
  bool behind = false;
};

std::span<const PassRow> passRows();

/// The rows asked for, in the order of the table, without those that the integrator cannot make.
std::vector<const PassRow*> passesOf(const Settings& settings);

/// Those that are layers of the film: of passesOf(), and of what removing noise is guided by.
std::vector<const PassRow*> layersOf(const Settings& settings);
/// The place of a pass among these; -1 if it is not.
int layerOf(const Settings& settings, std::string_view pass);

/// Whether the integrator can tell the light of a sample by its sources (render/picture/light_split.h).
bool splitsLight(const Settings& settings);

/// The layers of a film after those of layersOf(): light by groups, and alpha; -1: there is none.
struct LightLayers {
  int direct = -1, indirect = -1;  ///< numbers of the first groups
  int alpha = -1;
  int end = 0;  ///< number of all layers
};
LightLayers lightLayersOf(const Settings& settings, std::size_t groups);

/// With a layer for each of layersOf() and lightLayersOf(): what render() wants. Without names no light is
/// split, and no objects are told apart by their names.
Film makeFilm(const Settings& settings, int width, int height, const PassNames& names = {});

/// The raw values of a pass. `shown` is the film's picture as it is written, perhaps without noise.
Picture valuesOf(const PassRow& pass, const Film& film, const Settings& settings, const PassNames& names,
                 const Picture& shown);

}  // namespace trace
