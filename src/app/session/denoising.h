// Settings::denoise: noise taken out of what a film holds (image/development/denoise.h), as a step of its own
// between film and tone.
#pragma once

#include <optional>

#include "base/parallel.h"
#include "image/development/development.h"
#include "image/film/film.h"
#include "scene/settings.h"

namespace trace {

/// The picture of the film without noise; nothing if the settings do not want that, or the film cannot tell
/// noise: it was not made with them, pixels have fewer than 8 samples, or are made of corners or chains.
/// Nothing if `job` is cancelled meanwhile, too.
std::optional<Picture> denoised(const Film& film, const Settings& settings, Job& job);
std::optional<Picture> denoised(const Film& film, const Settings& settings);

/// The same, or the film's picture as it is.
Picture pictureOfFilm(const Film& film, const Settings& settings);

/// `after` - `before`, of each channel.
Picture change(const Picture& before, const Picture& after);
/// Its size on the average of the pixels, as luminance in levels of 255.
double meanChange(const Picture& change);
/// The mean difference of the levels that a file shows: after the tone curve, from black to white.
double shownChange(const Picture& before, const Picture& after, const Development& development);

}  // namespace trace
