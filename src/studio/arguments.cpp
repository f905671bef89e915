#include "studio/arguments.h"

#include <algorithm>
#include <cstdio>
#include <optional>

#include "app/editing/studio_flags.h"
#include "base/error.h"
#include "scene/short_flags.h"
#include "studio/script.h"

namespace trace::studio {

namespace {

/// The functions of the renderer's other flags are in the menus.
const ShortFlag& shortFlag(char letter) {
  std::string known;
  for (const ShortFlag& flag : shortFlags()) {
    if (flag.letter == letter) return flag;
    known += std::string(" -") + flag.letter;
  }
  throw Error(Fault::usage,
              std::string("unknown flag \"-") + letter + "\": expected --NAME VALUE, or one of -h" + known,
              letter == 'o' ? "the picture is written by File, Export picture... (Ctrl+E)"
                            : "ray-studio --help lists the flags; options are in the panel Controls, too");
}

bool isSwitchedOption(const std::string& name) {
  return std::any_of(options().begin(), options().end(), [&](const Option& option) {
    return option.name == name && option.kind == Option::Kind::boolean;
  });
}

class Parser {
 public:
  explicit Parser(const std::vector<std::string>& words) : words_(words) {}

  Arguments parse() {
    bool flags = true;
    while (next_ < words_.size()) {
      const std::string& word = words_[next_++];
      if (flags && word == "--")
        flags = false;
      else if (!flags || word.size() < 2 || word[0] != '-')
        takeScene(word);
      else if (word[1] == '-')
        takeLong(word.substr(2));
      else
        takeShort(word);
    }
    return arguments_;
  }

 private:
  void takeScene(const std::string& word) {
    if (!arguments_.scene.empty())
      throw Error(Fault::usage, "expected at most one scene, found also \"" + word + "\"");
    arguments_.scene = word;
  }

  /// `text`: NAME or NAME=VALUE.
  void takeLong(const std::string& text) {
    const std::size_t equals = text.find('=');
    const std::string name = text.substr(0, equals);
    std::optional<std::string> given;
    if (equals != std::string::npos) given = text.substr(equals + 1);
    const bool off = name.starts_with("no-") && isSwitchedOption(name.substr(3));
    if (given && (off || name == "help" || name == "version"))
      throw Error(Fault::usage, "--" + name + ": takes no value, found \"" + *given + "\"");
    if (name == "help")
      arguments_.help = true;
    else if (name == "version")
      arguments_.version = true;
    else if (off)
      choose(name.substr(3), "off");
    else if (isSwitchedOption(name) && !given && !(next_ < words_.size() && isSwitch(words_[next_])))
      choose(name, "on");
    else
      takeValue(name, given);
  }

  void takeValue(const std::string& name, const std::optional<std::string>& given) {
    const bool ours = isStudioValue(name);
    if (!ours) findOption(name);  // one that is unknown is told before its value lacks
    const std::string value = given ? *given : valueAfter("--" + name);
    if (!ours)
      choose(name, value);
    else if (name == "window")
      sizeWindow(value);
    else if (name == "pixel")
      choosePixel(value);
    else if (name == "allow-read")
      arguments_.allowRead.push_back(value);
    else
      (name == "script" ? arguments_.script : arguments_.reference) = value;
  }

  /// One letter or several that take no value, perhaps with a last one that takes one: -b, -w600, -At1.
  void takeShort(const std::string& word) {
    for (std::size_t i = 1; i < word.size(); ++i) {
      if (word[i] == 'h') {
        arguments_.help = true;
        continue;
      }
      const ShortFlag& flag = shortFlag(word[i]);
      if (flag.value.empty()) {
        const std::string rest = word.substr(i + 1);
        return choose(flag.option, rest.empty() ? valueAfter(std::string("-") + word[i]) : rest);
      }
      choose(flag.option, std::string(flag.value));
      if (flag.letter == kPlainFlag)
        arguments_.choices.insert(arguments_.choices.begin(), plainChoices().begin(), plainChoices().end());
    }
  }

  std::string valueAfter(const std::string& flag) {
    if (next_ == words_.size()) throw Error(Fault::usage, "\"" + flag + "\": expected a value after it");
    return words_[next_++];
  }

  void choose(std::string_view option, const std::string& value) {
    Settings scratch;
    findOption(option).assign(scratch, value);
    arguments_.choices.push_back({std::string(option), value, {}});
  }

  void choosePixel(const std::string& value) {
    int x = -1, y = -1;
    if (std::sscanf(value.c_str(), "%d,%d", &x, &y) != 2 || x < 0 || y < 0)
      throw Error(Fault::usage, "--pixel: expected X,Y from 0, found \"" + value + "\"");
    arguments_.pixel = {x, y};
  }

  void sizeWindow(const std::string& value) {
    int &width = arguments_.width, &height = arguments_.height;
    if (std::sscanf(value.c_str(), "%dx%d", &width, &height) != 2 || width < 1 || height < 1)
      throw Error(Fault::usage, "--window: expected WIDTHxHEIGHT, found \"" + value + "\"");
  }

  const std::vector<std::string>& words_;
  std::size_t next_ = 0;
  Arguments arguments_;
};

}  // namespace

Arguments parse(const std::vector<std::string>& words) { return Parser(words).parse(); }

std::string helpText() {
  std::string text =
      "usage: ray-studio [SCENE] [options]\n\n"
      "Opens a window that renders the scene, changes it and shows the rays of any pixel.\n\n"
      "  --NAME VALUE              any option of \"ray --help all\", over the scene's own: --width 600\n"
      "  -w 600, -r 5, -a ...      the short ones of \"ray --help all\"; options hold for every scene that\n"
      "                            is opened in this window\n";
  for (const StudioFlag& flag : kStudioFlags) {
    std::string left = flag.letter ? std::string("  -") + flag.letter + ", --" : "  --";
    left += std::string(flag.name) + (flag.value.empty() ? "" : " ") + std::string(flag.value);
    left.resize(std::max<std::size_t>(left.size() + 2, 28), ' ');
    text += left + std::string(flag.help) + "\n";
  }
  return text + "\nCommands of a script:\n" + scriptHelp() +
         "\nWhat it remembers lies in $XDG_CONFIG_HOME/trace or ~/.config/trace; with --script nothing is "
         "read or stored.\n";
}

}  // namespace trace::studio
