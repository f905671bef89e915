// The judgement of a finished picture: what is wrong with it that its maker may not have meant, and one cure
// that works when pasted.
#pragma once

#include <optional>
#include <string>

#include "app/advice/darkness.h"
#include "base/error.h"
#include "image/film/film.h"
#include "render/world/world.h"
#include "scene/scene.h"
#include "scene/settings.h"

namespace trace {

/// A warning if the picture is nearly black (app/advice/darkness.h), if a large part of it is brighter than
/// a file can show, or if it has one colour; nothing of pictures that show data, or a part only.
std::optional<Message> firstAid(const Scene& scene, const Settings& settings, const World& world,
                                const Film& film, const RenderFacts& facts = {});

/// The estimated error of the pixels, tone-mapped and before denoising: the standard error of their samples'
/// mean, in levels of 255.
struct PictureError {
  double mean, median, ninth;  ///< `ninth`: nine of ten pixels have no more
};
/// Nothing where no pixel has two samples at random, or where that is not measured (chains, samples at
/// corners).
std::optional<PictureError> estimatedError(const Settings& settings, const Film& film);

/// To follow the last line of a render of a noisy picture: its estimated error and the samples that halve it,
/// or, where pixels stop for a noise target, how many missed it and the samples that would do. "" if it is
/// not noisy, or if nothing is known of that.
std::string noiseText(const Settings& settings, const Film& film);

/// How many pixels a few very bright paths make stand out (fireflies), with a cure, to follow the last line
/// of a render: an integrator where mirrors or glass gather the light, of which the limit would take a
/// caustic away. "" if there are hardly any, if that is not known, or if they are limited.
std::string fireflyText(const Settings& settings, const World& world, const Film& film);

}  // namespace trace
