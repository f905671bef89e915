// THE table of extensions: what Trace has beyond the courses' ray tracer, the example that shows each, and
// the words of the command line that turn it off and on. `ray features` prints it, and makes docs/features of
// it.
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
};

std::span<const Extension> extensions();

/// "--spp 9 --filter tent" as choices. Precondition: pairs of a flag and its value.
std::vector<Choice> choicesIn(std::string_view words);

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
