#include "scene/picture_size.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "math/elementary.h"

namespace trace {
namespace {

bool gives(std::span<const Choice> layer, std::string_view option) {
  return std::any_of(layer.begin(), layer.end(),
                     [&](const Choice& choice) { return choice.option == option; });
}

/// A side in pixels. Throws Error(Fault::limit) if it is longer than the option may be.
int side(std::string_view option, double pixels) {
  const double most = findOption(option).most;
  if (!(pixels <= most))
    throw Error(Fault::limit,
                "the picture's " + std::string(option) +
                    ", which follows from its other side, would be more than " +
                    std::to_string(static_cast<int>(most)) + " pixels",
                "give both --width and --height");
  return std::max(1, static_cast<int>(std::floor(pixels + 0.5)));
}

/// How much wider, against its height, the finished picture is than that of one eye.
Real shownAcross(Stereo stereo) { return isAnaglyph(stereo) ? 1 : eyesAcross(stereo); }

}  // namespace

Settings settingsFor(const Camera& camera, std::initializer_list<std::span<const Choice>> layers) {
  Settings settings = resolve(layers);
  Settings sizes;  // sizes of the layers so far
  bool isScene = true;
  for (std::span<const Choice> layer : layers) {
    const double ratio = sizes.height > 0 ? static_cast<double>(sizes.width) / sizes.height : 0;
    for (const Choice& choice : layer)
      if (choice.option == "width" || choice.option == "height")
        findOption(choice.option).assign(sizes, choice.value);
    const bool width = gives(layer, "width"), height = gives(layer, "height");
    if (!isScene && width && !height && ratio > 0) sizes.height = side("height", sizes.width / ratio);
    if (!isScene && height && !width && sizes.height > 0)
      sizes.width = side(
          "width", sizes.height * (ratio > 0 ? ratio : camera.aspectratio * shownAcross(settings.stereo)));
    isScene = false;
  }
  settings.width = sizes.width;
  settings.height = sizes.height;
  return settings;
}

Camera cameraFor(const Scene& scene, const Settings& settings) {
  Camera camera = scene.camera;
  const FreeAspect& free = scene.freeAspect;
  const bool isOpen =
      free.chosen > 0 && camera.aspectratio == free.chosen;  // else the file or an edit gives it
  if (!isOpen || settings.height == 0) return camera;
  const Real sides = Real(settings.width) / settings.height * (isAnaglyph(settings.stereo) ? 2 : 1);
  camera.aspectratio = sides / eyesAcross(settings.stereo);
  const Real across = free.chosen / camera.aspectratio;  // keeps the angle across
  const Real stretch = free.keeps == FreeAspect::Keeps::upward   ? 1
                       : free.keeps == FreeAspect::Keeps::across ? across
                                                                 : max(1, across);
  if (stretch != 1) camera.fov = math::atan(math::tan(camera.fov * kPi / 360) * stretch) * 360 / kPi;
  return camera;
}

}  // namespace trace
