// Features that Veach's mutations do not support.
#include "base/error.h"
#include "render/veach_path.h"

namespace trace::veach {

void refuseUnknown(const World& world, const Settings& settings) {
  const auto refuse = [](const std::string& what) {
    throw Error(Fault::usage, "--chains veach does not know " + what, "--chains bdpt and --chains path do");
  };
  if (settings.fog > 0) refuse("fog");
  if (!world.media().empty()) refuse("media inside objects");
  if (world.hasSubsurface()) refuse("subsurface scattering");
  if (world.hasHoles()) refuse("surfaces that are there in part (opacity)");
  if (settings.wavelengths > 1) refuse("light that glass splits (--wavelengths)");
  if (settings.outlines > 0) refuse("--outlines");
  if (settings.flipNormals) refuse("--flip-normals");
  if (settings.smoothTerminator) refuse("--smooth-terminator");
  if (settings.stereo != Stereo::off) refuse("pictures of two eyes (--stereo)");
  if (settings.backFaces != BackFaces::both) refuse("--back-faces other than both");
}

}  // namespace trace::veach
