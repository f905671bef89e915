// ray gui, and ray alone: becomes ray-studio, the program beside this one that has the window.
#include <filesystem>

#include "base/os/process.h"
#include "cli/commands/commands.h"

namespace trace::cli {

std::string studioProgram() {
  const std::string studio = os::programIn(os::ownFolder(), "ray-studio");
  std::error_code ignored;
  return std::filesystem::exists(studio, ignored) ? studio : "";
}

namespace {

Error noStudio() {
  return {
      Fault::io,
      "the studio, the window of Trace, was not built: there is no ray-studio in \"" + os::ownFolder() + "\"",
      "./dev studio, in the source of Trace, installs what it needs (libimgui-dev libglfw3-dev "
      "libgl-dev) and builds it; beside the Debian package trace-ray install trace-ray-studio; ray SCENE "
      "renders without a window"};
}

}  // namespace

bool opensWindows() { return !studioProgram().empty() && os::hasDisplay(); }

Error noWindow() {
  if (studioProgram().empty()) return noStudio();
  return {Fault::usage, "there is no display to open the studio's window on",
          "ray SCENE renders without a window; ray new writes a first scene"};
}

int guiCommand(const Arguments& arguments, const Console&) {
  if (arguments.files.size() > 1)
    throw Error(Fault::usage,
                "ray gui: expected at most one scene, found also \"" + arguments.files[1] + "\"");
  const std::string studio = studioProgram();
  if (studio.empty()) throw noStudio();
  std::vector<std::string> words{studio};
  words.insert(words.end(), arguments.files.begin(), arguments.files.end());
  for (const Choice& choice : arguments.choices) words.push_back("--" + choice.option + "=" + choice.value);
  for (const std::string& folder : arguments.allowRead) words.push_back("--allow-read=" + folder);
  os::becomeProgram(words);
}

}  // namespace trace::cli
