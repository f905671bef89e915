#include "cli/text/help.h"

#include <algorithm>
#include <vector>

#include "base/text.h"
#include "cli/commands/commands.h"
#include "cli/flags.h"
#include "cli/terminal/terminal.h"
#include "cli/text/help_parts.h"
#include "formats/kind_defaults.h"
#include "scene/conventions.h"

namespace trace::cli {
namespace {

constexpr size_t kIndent = 30;  // where the explanations begin

/// Options on the one screen; --help all has the others.
constexpr std::string_view kCommon[] = {"quality",  "width", "height", "spp",   "depth",   "denoise",
                                        "exposure", "time",  "like",   "accel", "threads", "time-limit"};

bool isCommon(std::string_view name) {
  return std::find(std::begin(kCommon), std::end(kCommon), name) != std::end(kCommon);
}

/// The width of the page.
size_t width() { return static_cast<size_t>(std::clamp(columns(), 60, 110)); }

/// Left column and wrapped right column.
std::string entry(const std::string& left, const std::string& right) {
  std::string text = "  " + left, line;
  if (text.size() + 2 > kIndent) text += "\n";
  const auto flush = [&] {
    const size_t start = text.rfind('\n') + 1;
    if (text.size() - start < kIndent) text.append(kIndent - (text.size() - start), ' ');
    text += line + "\n";
    line.clear();
  };
  for (size_t at = 0; at < right.size();) {
    const size_t end = std::min(right.find(' ', at), right.size());
    const std::string word = right.substr(at, end - at);
    if (!line.empty() && kIndent + line.size() + 1 + word.size() > width()) flush();
    line += (line.empty() ? "" : " ") + word;
    at = end + 1;
  }
  flush();
  return text;
}

std::string joined(std::span<const std::string_view> words, std::string_view between) {
  std::string text;
  for (std::string_view word : words) text += (text.empty() ? "" : std::string(between)) + std::string(word);
  return text;
}

}  // namespace

std::string placeholder(const Option& option) {
  switch (option.kind) {
    case Option::Kind::boolean: return "[on|off]";
    case Option::Kind::integer: return "N";
    case Option::Kind::real: return "X";
    case Option::Kind::choice: return joined(option.choices, "|");
    case Option::Kind::choices: return joined(option.choices, ",");
    case Option::Kind::color: return "R,G,B";
    case Option::Kind::region: return "x0,y0,x1,y1";
    case Option::Kind::file: return "FILE";
    case Option::Kind::place: return "NAME|x,y,z";
  }
  return "";
}

std::string rangeText(const Option& option) {
  switch (option.kind) {
    case Option::Kind::boolean: return "on or off";
    case Option::Kind::choice: return joined(option.choices, ", ");
    case Option::Kind::choices: return "none, all, or some of " + joined(option.choices, ",");
    case Option::Kind::color:
      return "a grey, or red,green,blue, from " + toText(option.least) + " to " + toText(option.most);
    case Option::Kind::region: return "x0,y0,x1,y1";
    case Option::Kind::file: return "the name of a file, or none";
    case Option::Kind::place: return "the name of an object, a point x,y,z, or none";
    case Option::Kind::integer:
    case Option::Kind::real: break;
  }
  const std::string unit = option.unit.empty() ? "" : " " + std::string(option.unit);
  if (option.most == kNoLimit) return toText(option.least) + unit + " or more";
  return toText(option.least) + " to " + toText(option.most) + unit;
}

std::string flagsOf(const Option& option) {
  std::string text = "--" + std::string(option.name);
  for (const ShortFlag& flag : shortFlags())
    if (flag.option == option.name && flag.value.empty())
      text = "-" + std::string(1, flag.letter) + ", " + text;
  return text;
}

std::string defaultOf(const Option& option) {
  const std::string value = option.get(Settings{});
  if (option.kind == Option::Kind::region && value == "0,0,0,0") return "the whole picture";
  const std::string_view ofKind = kindDefaultOf(option.name);
  return ofKind.empty() ? value : value + "; " + std::string(ofKind) + " in Trace 1 scenes";
}

std::string shortValues(const Option& option) {
  std::string text;
  for (const ShortFlag& flag : shortFlags())
    if (flag.option == option.name && !flag.value.empty())
      text += (text.empty() ? "-" : ", -") + std::string(1, flag.letter) + " is " + std::string(flag.value);
  return text;
}

namespace {

std::string optionEntry(const Option& option, bool all) {
  std::string right(option.help);
  if (all) {
    if (option.kind == Option::Kind::integer || option.kind == Option::Kind::real)
      right += "; " + rangeText(option);
  }
  right += "; default " + defaultOf(option);
  if (const std::string shorts = shortValues(option); !shorts.empty()) right += "; " + shorts;
  if (all && option.extra)
    right += "; an extra, off by default: --enable gives " + std::string(enabledValue(option));
  if (all && !option.source.empty()) right += " [" + std::string(option.source) + "]";
  return entry(flagsOf(option) + " " + placeholder(option), right);
}

}  // namespace

std::string flagsOf(const Flag& flag) {
  std::string text = "--" + std::string(flag.name);
  if (flag.letter) text = "-" + std::string(1, flag.letter) + ", " + text;
  switch (flag.takes) {
    case Flag::Takes::nothing: break;
    case Flag::Takes::optional:
      text += (flag.name == "help" ? " [" : "[=") + std::string(flag.values) + "]";
      break;
    case Flag::Takes::value: text += " " + std::string(flag.values); break;
  }
  return text;
}

std::vector<std::string_view> optionGroups() {
  std::vector<std::string_view> names;
  for (const Option& option : options())
    if (std::find(names.begin(), names.end(), option.group) == names.end()) names.push_back(option.group);
  return names;
}

namespace {

std::string conventionsText() {
  std::string text = "\nConventions that --like names\n";
  for (const Convention& row : conventions()) text += entry(std::string(row.name), std::string(row.help));
  return text;
}

constexpr std::string_view kExitCodes =
    "0 done; 1 a file could not be read or written; 2 wrong usage; 3 the scene has errors; 4 stopped by the "
    "user (the finished part is written); 5 a limit was reached (time: the finished part is written); 130 "
    "stopped at once. ray diff: 0 equal within the limits, 1 different, 2 an error, or sizes that differ. "
    "ray grade: 6 not every picture is within the limits. ray lint: 6 it found something";
constexpr std::string_view kSignals =
    "Ctrl-C or SIGTERM: finish the current tiles, except those that take over 5 s, write, end; before the "
    "first tile there is nothing to write; twice: end at once. SIGUSR1 or SIGHUP: write the finished part "
    "and continue";

/// A table's cell: | would end it.
std::string cell(std::string_view text) {
  std::string result;
  for (char c : text) result += c == '|' ? std::string("\\|") : std::string(1, c);
  return result;
}

std::string code(std::string_view text) { return text.empty() ? "" : "`" + cell(text) + "`"; }

/// The options of a picture: by groups, or the common ones.
std::string optionsText(bool all) {
  std::string text;
  if (!all) {
    text = "\nThe picture\n";
    for (const Option& option : options())
      if (isCommon(option.name)) text += optionEntry(option, false);
    return text;
  }
  for (std::string_view group : optionGroups()) {
    text += "\n" + std::string(group) + "\n";
    for (const Option& option : options())
      if (option.group == group) text += optionEntry(option, true);
  }
  return text + conventionsText();
}

}  // namespace

std::string usageOf(const Command& command) {
  const bool first = &command == &commands().front();
  return "ray " + (first ? "[render]" : std::string(command.name)) +
         (command.arguments.empty() ? "" : " " + std::string(command.arguments));
}

std::string_view exitCodes() { return kExitCodes; }
std::string_view signalsText() { return kSignals; }

std::string helpText(bool all) {
  std::string text = "Trace " TRACE_VERSION ", the ray tracer you can see inside\n\n";
  for (const Command& command : commands()) text += entry(usageOf(command), std::string(command.help));
  text += "\n  As in the courses: ray -b -w 400 -r 5 -t 1 in.ray out.bmp\n" + optionsText(all);
  text += "\nThe program\n";
  for (const Flag& flag : flags())
    if (all || flag.common) text += entry(flagsOf(flag), std::string(flag.help));
  if (!all) return text + "\nOf one command: ray COMMAND --help; everything: ray --help all\n";
  text += "\nEnvironment\n" +
          entry("RAY_THREADS, RAY_LOG", "stand for --threads and --log-level; flags override them") +
          entry("NO_COLOR, TERM, COLUMNS", "no colours; \"dumb\": no colours and no bar; width of the bar");
  text += "\nMore\n" + entry("exit codes", std::string(kExitCodes)) +
          entry("signals", std::string(kSignals)) + entry("--", "what follows are names of files");
  return text;
}

std::string helpText(const Command& command, bool all) {
  const std::string name(command.name);
  std::string text = entry(usageOf(command), std::string(command.help)) + "\nIts flags\n";
  for (const Flag& flag : flags())
    if (flag.commands.has(command.verb))
      text += entry(flagsOf(flag), std::string(flag.name == "output" ? command.output : flag.help));
  if (!takesOptions(command.verb)) {
    for (const Option& option : options())
      if (takesOption(command.verb, option)) text += optionEntry(option, all);
    return text;
  }
  text += optionsText(all);
  return all ? text : text + "\nEvery option: ray " + name + " --help all\n";
}

std::string briefHelp() {
  return "usage: ray SCENE [OUT]        render a scene, as in: ray scenes/glass.ray glass.png\n"
         "       ray COMMAND ...        explain, lint, diff, grade, convert, info, bench and others\n"
         "       ray --help             the common flags; ray COMMAND --help those of one command\n";
}

std::string defaultsText() {
  std::string text;
  for (const Option& option : options())
    text += std::string(option.name) + "=" + option.get(Settings{}) + "\n";
  return text;
}

std::string optionsMarkdown() {
  std::string text =
      "# Options\n\n"
      "Made by `ray features --markdown` from the tables in src/scene/options.cpp and src/cli/flags.cpp; do "
      "not edit.\n\n"
      "Every option is a flag of `ray render` and `ray info`, and a keyword of `settings { }` in a scene "
      "file. The\n"
      "scene file overrides a default, and the command line overrides the scene file. Where scenes that "
      "begin "
      "with\n"
      "`Trace 1` have another default, both are listed. Switches take `--flag`, `--flag on`, `--flag off` "
      "and "
      "`--no-flag`.\n";
  for (std::string_view group : optionGroups()) {
    text += "\n## " + std::string(group) +
            "\n\n| flag | values | default | what it does | source |\n|---|---|---|---|---|\n";
    for (const Option& option : options()) {
      if (option.group != group) continue;
      std::string what(option.help);
      if (const std::string shorts = shortValues(option); !shorts.empty()) what += "; " + shorts;
      if (option.extra)
        what += "; an extra, `--enable " + std::string(option.name) + "` gives " +
                std::string(enabledValue(option));
      text += "| " + code(flagsOf(option)) + " | " + cell(rangeText(option)) + " | " +
              cell(defaultOf(option)) + " | " + cell(what) + " | " + cell(option.source) + " |\n";
    }
  }
  text += "\n## The program\n\n| flag | command | what it does |\n|---|---|---|\n";
  for (const Flag& flag : flags())
    text += "| " + code(flagsOf(flag)) + " | " + namesOf(flag.commands) + " | " + cell(flag.help) + " |\n";
  text += "\nExit codes: " + std::string(kExitCodes) + ".\n\nSignals: " + std::string(kSignals) + ".\n";
  return text;
}

}  // namespace trace::cli
