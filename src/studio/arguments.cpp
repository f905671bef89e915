#include "studio/arguments.h"

#include <cstdio>

#include "base/error.h"
#include "studio/script.h"

namespace trace::studio {

Arguments parse(const std::vector<std::string>& words) {
  Arguments arguments;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    if (word == "-h" || word == "--help") {
      arguments.help = true;
    } else if (word.starts_with("--")) {
      const std::size_t equals = word.find('=');
      const std::string name = word.substr(2, equals == std::string::npos ? equals : equals - 2);
      if (equals == std::string::npos && i + 1 == words.size())
        throw Error(Fault::usage, "\"" + word + "\": expected a value after it");
      const std::string value = equals == std::string::npos ? words[++i] : word.substr(equals + 1);
      if (name == "script") {
        arguments.script = value;
      } else if (name == "reference") {
        arguments.reference = value;
      } else if (name == "window") {
        if (std::sscanf(value.c_str(), "%dx%d", &arguments.width, &arguments.height) != 2 ||
            arguments.width < 1 || arguments.height < 1)
          throw Error(Fault::usage, "--window: expected WIDTHxHEIGHT, found \"" + value + "\"");
      } else {
        Settings scratch;
        findOption(name).assign(scratch, value);
        arguments.choices.push_back({name, value, {}});
      }
    } else if (word.starts_with("-") && word.size() > 1) {
      throw Error(Fault::usage, "unknown flag \"" + word + "\"", "ray-studio --help lists the flags");
    } else if (arguments.scene.empty()) {
      arguments.scene = word;
    } else {
      throw Error(Fault::usage, "expected at most one scene, found also \"" + word + "\"");
    }
  }
  return arguments;
}

std::string helpText() {
  return "usage: ray-studio [SCENE] [options]\n\n"
         "Opens a window that renders the scene, changes it and shows the rays of any pixel.\n\n"
         "  --NAME VALUE              any option of \"ray help all\", over the scene's own: --width 600\n"
         "  --reference PICTURE       a picture to compare with\n"
         "  --window WIDTHxHEIGHT     size of the window; 1280x800 at first, then as it was left\n"
         "  --script FILE             do what the file says, one command a line, then close the window\n"
         "  --help                    this text\n\n"
         "Commands of a script:\n" +
         scriptHelp() +
         "\nWhat it remembers lies in $XDG_CONFIG_HOME/trace or ~/.config/trace; with --script nothing is "
         "read or "
         "kept.\n";
}

}  // namespace trace::studio
