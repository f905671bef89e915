// The only file that knows CLI11 (slow to compile). CLI11 takes the words apart; what they mean is decided
// here, one occurrence after the other, so that of two flags for one option the later wins.
#include "cli/arguments.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <functional>
#include <map>

#include "base/os/process.h"
#include "base/text.h"
#include "cli/commands/commands.h"
#include "cli/flags.h"
#include "scene/option_words.h"
#include "scene/quality.h"

namespace trace::cli {
namespace {

using Action = std::function<void(Arguments&, const std::string& value)>;

/// Whether the word is one of the values, which stand with "|" between.
bool isOneOf(std::string_view word, std::string_view values) {
  const std::string all = "|" + std::string(values) + "|";
  return !word.empty() && all.find("|" + std::string(word) + "|") != std::string::npos;
}

/// Flags whose value may be left out become `--name=value`: CLI11 would take the scene for the value.
std::vector<std::string> withValues(const std::vector<std::string>& words, Verb command) {
  std::vector<std::string> result;
  for (size_t i = 0; i < words.size(); ++i) {
    std::string word = words[i];
    const std::string next = i + 1 < words.size() ? words[i + 1] : "";
    std::string value;
    if (word.size() > 3 && word.substr(0, 2) == "--" && word.back() == '=' &&
        word.find('=') == word.size() - 1)
      throw Error(Fault::usage, "\"" + word + "\": expected a value after \"=\"");
    for (const Flag& flag : flags()) {
      if (!flag.commands.has(command) || flag.takes != Flag::Takes::optional) continue;
      const std::string name = "--" + std::string(flag.name);
      if (word != name && !(flag.letter && word == std::string("-") + flag.letter)) continue;
      word = name;
      value = flag.alone;
      if (isOneOf(next, flag.values)) {
        value = next;
        ++i;
      }
      break;
    }
    if (takesOptions(command)) {
      for (const Option& option : options()) {
        if (option.kind != Option::Kind::boolean || word != "--" + std::string(option.name)) continue;
        value = "on";
        if (isSwitch(next)) {
          value = next;
          ++i;
        }
      }
    }
    result.push_back(value.empty() ? word : word + "=" + value);
  }
  return result;
}

/// One parser for one sub-command: its flags, and what each occurrence does.
class Parser {
 public:
  explicit Parser(Verb command) : command_(command) {
    app_.set_help_flag();
    app_.allow_extras();
    for (const Flag& flag : flags())
      if (flag.commands.has(command)) add(flag);
    for (const Option& option : options())
      if (takesOption(command, option)) add(option);
    if (!takesOptions(command)) return;
    for (const ShortFlag& flag : shortFlags())
      if (!flag.value.empty())
        addSwitch("-" + std::string(1, flag.letter), std::string(flag.option), std::string(flag.value),
                  flag.letter == kPlainFlag);
  }

  void parse(std::vector<std::string> words, Arguments& arguments) {
    const auto end = std::find(words.begin(), words.end(), "--");
    std::vector<std::string> reversed(std::make_reverse_iterator(end), words.rend());
    try {
      app_.parse(reversed);
    } catch (const CLI::ParseError&) {  // the values ran out: nothing else is left to CLI11 to refuse
      throw Error(Fault::usage,
                  "\"" + (end == words.begin() ? "" : *(end - 1)) + "\": expected a value after it");
    }
    std::map<const CLI::Option*, size_t> used;
    std::vector<std::string> unknown;
    for (const std::string& word : app_.remaining())
      (word.size() > 1 && word[0] == '-' ? unknown : arguments.files).push_back(word);
    if (!unknown.empty()) refuse(unknown.front());
    for (const CLI::Option* option : app_.parse_order())
      actions_.at(option)(arguments, option->results()[used[option]++]);
    if (end != words.end()) arguments.files.insert(arguments.files.end(), end + 1, words.end());
  }

 private:
  void add(const Flag& flag) {
    const std::string name = "--" + std::string(flag.name);
    if (flag.takes == Flag::Takes::nothing) {
      const std::string names = flag.letter ? "-" + std::string(1, flag.letter) + "," + name : name;
      actions_[app_.add_flag(names)] = [&flag, name](Arguments& arguments, const std::string& value) {
        if (value != "true") throw Error(Fault::usage, name + ": takes no value, found \"" + value + "\"");
        flag.apply(arguments, value);
      };
    } else {
      const auto act = [&flag](Arguments& arguments, const std::string& value) {
        flag.apply(arguments, value);
      };
      const std::string shortName = flag.letter ? "-" + std::string(1, flag.letter) : "";
      const bool together = flag.letter && flag.takes == Flag::Takes::value;
      actions_[addOption(together ? shortName + "," + name : name)] = act;
      if (flag.letter && !together)
        actions_[app_.add_flag(shortName)] = [&flag](Arguments& arguments, const std::string&) {
          flag.apply(arguments, flag.alone);
        };
    }
    names_.push_back(name);
  }

  void add(const Option& option) {
    const std::string name = "--" + std::string(option.name);
    std::string all = name;
    for (const ShortFlag& flag : shortFlags())
      if (flag.option == option.name && flag.value.empty())
        all = "-" + std::string(1, flag.letter) + "," + all;
    actions_[addOption(all)] = [&option](Arguments& arguments, const std::string& value) {
      arguments.choices.push_back({std::string(option.name), value, {}});
    };
    names_.push_back(name);
    if (option.kind != Option::Kind::boolean) return;
    addSwitch("--no-" + std::string(option.name), std::string(option.name), "off");
    names_.push_back("--no-" + std::string(option.name));
  }

  void addSwitch(const std::string& flag, const std::string& option, const std::string& value,
                 bool plain = false) {
    actions_[app_.add_flag(flag)] = [=](Arguments& arguments, const std::string& given) {
      if (given != "true") throw Error(Fault::usage, flag + ": takes no value, found \"" + given + "\"");
      arguments.choices.push_back({option, value, {}});
      arguments.plain |= plain;
    };
  }

  CLI::Option* addOption(const std::string& name) {
    return app_.add_option(name)->allow_extra_args(false)->multi_option_policy(
        CLI::MultiOptionPolicy::TakeAll);
  }

  [[noreturn]] void refuse(const std::string& word) const {
    const std::string name = word.substr(0, word.find('='));
    const std::vector<std::string_view> candidates(names_.begin(), names_.end());
    std::string hint = name.size() > 2 ? didYouMean(name, candidates) : "";
    if (name.starts_with("--"))
      for (std::string_view meant : optionsMeant(name.substr(2))) {
        const std::string flag = "--" + std::string(meant);
        if (std::find(names_.begin(), names_.end(), flag) == names_.end()) continue;
        hint = "did you mean \"" + flag + "\"?";
        break;
      }
    constexpr std::pair<std::string_view, std::string_view> kOthers[] = {
        {"--out", "did you mean \"--output\"?"},
        {"--outfile", "did you mean \"--output\"?"},
        {"--verbose", "--log-level debug says more, --quiet less"},
        {"--debug", "--log-level debug says more"}};
    for (const auto& [other, meant] : kOthers)
      if (name == other) hint = meant;
    for (const Flag& flag : flags())
      if (name == "--" + std::string(flag.name)) hint = "it belongs to: " + namesOf(flag.commands);
    if (hint.empty()) hint = "ray --help all lists the flags";
    throw Error(Fault::usage, "unknown flag \"" + name + "\" of ray " + std::string(commandOf(command_).name),
                std::move(hint));
  }

  const Verb command_;
  CLI::App app_;
  std::map<const CLI::Option*, Action> actions_;
  std::vector<std::string> names_;
};

void readEnvironment(Arguments& arguments) {
  if (const std::string level = os::variable("RAY_LOG"); !level.empty())
    arguments.logLevel = logLevel("RAY_LOG", level);
  if (const std::string threads = os::variable("RAY_THREADS"); !threads.empty()) {
    Settings scratch;
    try {
      findOption("threads").assign(scratch, threads);
    } catch (const Error& error) {
      throw Error(Fault::usage, "in the environment, RAY_THREADS as " + error.messages().front().what);
    }
    arguments.choices.push_back({"threads", threads, {}});
  }
}

}  // namespace

Arguments parse(const std::vector<std::string>& words, Verb command) {
  Arguments arguments;
  if (takesOptions(command)) readEnvironment(arguments);
  const size_t fromEnvironment = arguments.choices.size();
  const auto end = std::find(words.begin(), words.end(), "--");
  std::vector<std::string> prepared = withValues({words.begin(), end}, command);
  prepared.insert(prepared.end(), end, words.end());
  Parser(command).parse(std::move(prepared), arguments);
  const auto before = [&](std::span<const Choice> choices) {
    arguments.choices.insert(arguments.choices.begin() + static_cast<std::ptrdiff_t>(fromEnvironment),
                             choices.begin(), choices.end());
  };
  if (arguments.quick) before(quickChoices());
  if (arguments.plain) before(plainChoices());
  Settings scratch;  // so that a wrong value is found before a large scene is read
  for (const Choice& choice : arguments.choices) findOption(choice.option).assign(scratch, choice.value);
  return arguments;
}

}  // namespace trace::cli
