// The meaning of the option `quality`: samples, noise target, denoising, and the integrator that fits the
// scene. resolve() (options.h) takes a quality as a bundle of choices below all others of its layer.
#pragma once

#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

#include "scene/options.h"
#include "scene/scene.h"

namespace trace {

/// The choices that a quality stands for, the integrator apart; none of Quality::none.
std::span<const Choice> choicesOf(Quality quality);

/// Those of the flag --quick: a small, rough preview.
std::span<const Choice> quickChoices();

/// Whether the quality of that name gives the option its value.
bool setsOption(std::string_view quality, std::string_view option);

/// The integrator that finds the light of the scene: for a final picture paths from both ends where lights
/// shine through glass, whose caustics paths from the camera do not find; else those, which are faster.
IntegratorKind integratorFor(const Scene& scene, const Settings& settings);

/// As settingsFor() of the camera (picture_size.h), of which a quality also picks the integrator, unless its
/// layer or a later one names one.
Settings settingsFor(const Scene& scene, std::initializer_list<std::span<const Choice>> layers);

/// "quality good: path, up to 256 samples a pixel, until its error is below 2 levels, denoised"; "" of
/// Quality::none.
std::string qualityText(const Settings& settings);

}  // namespace trace
