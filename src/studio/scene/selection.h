// The selection of the panel Scene, and what the menus and the keyboard do with it.
#pragma once

#include <string>

#include "studio/studio.h"

namespace trace::studio {

/// "ball"; with the line where it stands, for what has no name.
std::string entryName(const Object& object);
std::string entryName(const LightSource& source);

/// How many things of the kind a scene has.
std::size_t howMany(const Scene& scene, Studio::Selected kind);

/// An object or a light is selected.
bool canDelete(const Studio& studio);
/// As one step. Then nothing is selected, so that what is done twice deletes no second thing.
void deleteSelected(Studio& studio);
bool canDuplicate(const Studio& studio);
/// The copy of an object, which is selected then.
void duplicateSelected(Studio& studio);

/// Takes the last change back, or makes it again. An object or a light that comes is selected; if one goes,
/// what was selected stays so.
void undo(Studio& studio);
void redo(Studio& studio);

/// A button that the second click of a double click does not press: it stands where another thing's button
/// was.
bool buttonOnce(const char* label, bool small = false);

}  // namespace trace::studio
