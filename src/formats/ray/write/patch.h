// A scene as the text that it was read from, with as little of that changed as says what was edited:
// comments, layout, names, nested transforms, keys in time and files named by path stay.
//
// The text is read again after each round of changes and compared with the scene that it is to say. What
// still differs then, such as a radius that the reader repairs, is changed in the next round; then the object
// alone is written anew; and only if that does not help either, the whole file (ray_writer.h).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/format.h"

namespace trace {

/// The value of the camera's `look_at` at that time. Precondition: the text can be read.
std::optional<Vec3> lookAtIn(const std::string& file, std::string_view bytes, Real time);

/// The text of the file `from`, in which the files that it names are called as they are seen from the folder
/// of `to`.
std::string withNamesSeenFrom(const std::string& text, const std::string& from, const std::string& to);

/// The scene as `file`. Warns of what was written anew or is lost. Throws Error(Fault::scene) as writeRay().
Rewritten rewriteRay(const SceneText& read, const Scene& edited, const std::string& file, Messages& messages);

}  // namespace trace
