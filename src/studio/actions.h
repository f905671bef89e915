// THE table of actions: menu entries with their short-cuts, from one list.
#pragma once

#include <span>
#include <string>

#include "studio/host.h"
#include "studio/studio.h"

namespace trace::studio {

struct Action {
  const char* menu;  ///< the menu it stands in
  const char* name;
  int key;  ///< key of a KeyPress; 0 for none
  bool control, shift;
  const char* help;  ///< one sentence, no full stop
  void (*run)(Studio&);
  bool (*enabled)(const Studio&);
  bool (*checked)(const Studio&);  ///< null where it is no switch
  bool inPage = false;             ///< only where the studio is a page in a browser
};

std::span<const Action> actions();
/// Opens the file dialog for an option that names a file.
void chooseFile(Studio& studio, const Option& option);
/// Writes the scene as it is now next to its file, for a page to keep or send. Throws Error.
host::Kept keptScene(const Studio& studio);
/// "Ctrl+Shift+S", or "".
std::string keyText(const Action& action);

/// Does what the keys of this frame say.
void takeKeys(Studio& studio);
void drawMenu(Studio& studio);

}  // namespace trace::studio
