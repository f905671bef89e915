// THE table of passes: what camera rays meet, kept as pictures beside the picture (`--passes`). Each is a
// layer of the Film. A new one is one value of the enum Pass (scene/settings.h) and one row.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "image/film.h"
#include "render/samples/integrator.h"

namespace trace {

/// A camera ray that met something.
struct PassPlace {
  const CameraRay& camera;
  const Hit& hit;
  Tracer& tracer;
  const Sampler& sampler;
};

struct PassRow {
  Pass pass;
  std::string_view name;
  std::string_view help;
  Film::Keep keep;
  Color background;  ///< where a ray hits nothing that the camera sees, and where nothing is rendered
  Color tooNear;     ///< where it hits something nearer than the camera sees

  /// The value at the surface that a camera ray meets. A pass of one number has it in all three channels.
  /// Null: the pass is made of the finished picture, and is no layer.
  Color (*value)(const PassPlace&);
  /// The pass for the eye: values from 0 to 1 from raw ones.
  Picture (*shown)(const Picture& values, const Settings&);
};

std::span<const PassRow> passRows();

/// The rows asked for, in the order of the table.
std::vector<const PassRow*> passesOf(const Settings& settings);

/// Those that are layers of the film: of passesOf(), and of what removing noise is guided by.
std::vector<const PassRow*> layersOf(const Settings& settings);
/// The place of a pass among these; -1 if it is not.
int layerOf(const Settings& settings, std::string_view pass);

/// With a layer for each of layersOf(): what render() wants.
Film makeFilm(const Settings& settings, int width, int height);

}  // namespace trace
