// THE table of extensions: what Trace has beyond the courses' ray tracer, the example that shows each, and
// the words of the command line that turn it off and on. `ray features` prints it, and makes docs/features of
// it; `--without NAME` switches a row off.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/options.h"

namespace trace {

struct Extension {
  std::string_view name;     ///< that of its option or of its shading model, where it has one
  std::string_view adds;     ///< one sentence, no full stop
  std::string_view scene;    ///< a file in scenes/
  std::string_view off, on;  ///< options as on the command line; "" is the scene as it is
  std::string_view view;     ///< options of both pictures; "" for pictures 240 pixels wide
  /// Its switch; "" where the option of its name has a value for off, or it is a part of scenes of that name.
  std::string_view switchOff{};
};

std::span<const Extension> extensions();

/// "--spp 9 --filter tent" as choices. Precondition: pairs of a flag and its value.
std::vector<Choice> choicesIn(std::string_view words);

/// The choices that switch an extension or a part of scenes off (scene/scene_features.h): "aperture", "bump",
/// "thin film" or "thin-film", "IES". Throws Error(Fault::usage) that names the nearest.
std::vector<Choice> choicesWithout(std::string_view name);
/// All names that choicesWithout() takes, except for short ones such as "IES".
std::vector<std::string> namesToSwitchOff();

/// The picture of the example with the extension off or on: of a region only that. `scenes` is the folder of
/// the scenes, `more` stand above all. Throws Error.
Picture pictureOf(const Extension& extension, bool on, const std::string& scenes,
                  std::span<const Choice> more = {});

/// docs/features/README.md, which shows NAME-off.jpg, NAME-on.jpg and NAME-difference.jpg.
std::string extensionsMarkdown();
/// Makes these pictures; told(name) before each extension. Throws Error.
void writeExtensionPictures(const std::string& scenes, const std::string& folder,
                            const std::function<void(std::string_view)>& told = {});

}  // namespace trace
