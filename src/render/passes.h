// THE table of passes: what camera rays meet, kept as pictures beside the picture (`--passes`). Each is a
// layer of the Film. A new one is one value of the enum Pass (scene/settings.h) and one row.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "image/film.h"
#include "render/tracer.h"

namespace trace {

struct PassRow {
  Pass pass;
  std::string_view name;
  std::string_view help;
  Film::Keep keep;
  Color background;  ///< where a ray meets nothing that the camera sees, and where nothing is rendered
  Color tooNear;     ///< where it meets something nearer than the camera sees

  /// Of the surface that a camera ray meets. A pass of one number has it in all three channels.
  Color (*value)(const Hit&, const Ray&, const Tracer&);
  /// The pass for the eye: values from 0 to 1 from raw ones.
  Picture (*shown)(const Picture& values, const Settings&);
};

std::span<const PassRow> passRows();

/// The rows asked for, in the order of the table.
std::vector<const PassRow*> passesOf(const Settings& settings);

/// With a layer for each of passesOf(): what render() wants.
Film makeFilm(const Settings& settings, int width, int height);

}  // namespace trace
