// The name of a file as a person types it for an option, in the studio.
#pragma once

#include <string>

namespace trace {

/// The option's value: the file, which a name that begins at no root has beside the scene, as in scene files;
/// "none" for no text. Throws Error(Fault::usage) if there is no such file or folder, or
/// if a scene file cannot name it.
std::string typedFile(const std::string& text, const std::string& option, const std::string& scene);

/// The name that typedFile() takes for the value: without the scene's folder, if the file lies below it.
std::string shownFile(const std::string& value, const std::string& scene);

}  // namespace trace
