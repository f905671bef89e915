// ray gui, and ray alone: becomes ray-studio, the program beside this one that has the window.
#include <filesystem>

#include "cli/commands.h"
#include "cli/terminal.h"

namespace trace::cli {

int gui(const Arguments& arguments, const Console&) {
  if (arguments.files.size() > 1)
    throw Error(Fault::usage,
                "ray gui: expected at most one scene, found also \"" + arguments.files[1] + "\"");
  const std::string studio = (std::filesystem::path(ownFolder()) / "ray-studio").string();
  std::error_code ignored;
  if (!std::filesystem::exists(studio, ignored))
    throw Error(
        Fault::io, "the studio, the window of Trace, was not built: there is no " + studio,
        "./dev studio installs what it needs (libimgui-dev libglfw3-dev libgl-dev) and builds it; ray SCENE "
        "renders without a window");
  std::vector<std::string> words{studio};
  words.insert(words.end(), arguments.files.begin(), arguments.files.end());
  for (const Choice& choice : arguments.choices) words.push_back("--" + choice.option + "=" + choice.value);
  becomeProgram(words);
}

}  // namespace trace::cli
