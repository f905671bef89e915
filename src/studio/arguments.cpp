#include "studio/arguments.h"

#include <cstdio>

#include "base/error.h"
#include "scene/short_flags.h"
#include "studio/script.h"

namespace trace::studio {

namespace {

/// What the renderer's other flags do is in the menus.
const ShortFlag& shortFlag(const std::string& word) {
  std::string known;
  for (const ShortFlag& flag : shortFlags()) {
    if (flag.letter == word[1]) return flag;
    known += std::string(known.empty() ? "-" : " -") + flag.letter;
  }
  throw Error(Fault::usage, "unknown flag \"" + word + "\": expected --NAME VALUE, or one of " + known,
              word.starts_with("-o")
                  ? "the picture is written by File, Export picture... (Ctrl+E)"
                  : "ray-studio --help lists the flags; options are in the panel Controls, too");
}

void choose(Arguments& arguments, const std::string& option, const std::string& value) {
  Settings scratch;
  findOption(option).assign(scratch, value);
  arguments.choices.push_back({option, value, {}});
}

}  // namespace

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
        choose(arguments, name, value);
      }
    } else if (word.starts_with("-") && word.size() > 1) {
      const ShortFlag& flag = shortFlag(word);
      std::string value(flag.value);
      if (value.empty() && word.size() > 2)
        value = word.substr(2);
      else if (value.empty() && i + 1 < words.size())
        value = words[++i];
      else if (value.empty() || word.size() > 2)
        throw Error(Fault::usage,
                    "\"" + word + "\": expected " + (value.empty() ? "a value" : "nothing") + " after it");
      choose(arguments, std::string(flag.option), value);
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
         "  -w 600, -r 5, -a ...      the short ones of \"ray help all\"\n"
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
