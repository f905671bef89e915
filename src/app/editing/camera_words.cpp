#include "app/editing/camera_words.h"

#include "base/text.h"
#include "scene/options.h"

namespace trace {

std::string cameraSentence(const Settings& settings) {
  const bool lens = settings.aperture > 0, plain = settings.projection == Projection::perspective;
  std::string text =
      plain ? (lens ? "camera" : "pinhole camera") : findOption("projection").get(settings) + " camera";
  if (lens) text += " with a lens of aperture " + toText(settings.aperture);
  if (settings.stereo != Stereo::off) text += ", once for each eye";
  return text;
}

}  // namespace trace
