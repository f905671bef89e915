#include "cli/flags.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/text.h"

namespace trace::cli {
namespace {

using Takes = Flag::Takes;
constexpr std::string_view kEverywhere = "render info convert features help";

/// The index of the value in the names. Throws Error(Fault::usage).
template <size_t N>
size_t pick(std::string_view flag, std::string_view value, const std::array<std::string_view, N>& names) {
  const auto found = std::find(names.begin(), names.end(), value);
  if (found != names.end()) return static_cast<size_t>(found - names.begin());
  std::string expected;
  for (std::string_view name : names) expected += (expected.empty() ? "" : " | ") + std::string(name);
  throw Error(Fault::usage,
              "--" + std::string(flag) + ": expected " + expected + ", found \"" + std::string(value) + "\"",
              didYouMean(value, names));
}

void choose(Arguments& arguments, std::string_view option, std::string_view value) {
  arguments.choices.push_back({std::string(option), std::string(value), {}});
}

/// The option of that name, which must be one that can be switched on and off.
const Option& extraNamed(std::string_view flag, std::string_view name) {
  std::vector<std::string_view> names;
  for (const Option& option : options()) {
    if (enabledValue(option).empty()) continue;
    if (option.name == name) return option;
    names.push_back(option.name);
  }
  std::string all;
  for (std::string_view n : names) all += (all.empty() ? "" : ", ") + std::string(n);
  std::string hint = didYouMean(name, names);
  throw Error(Fault::usage,
              "--" + std::string(flag) + ": expected one of " + all + ", found \"" + std::string(name) + "\"",
              std::move(hint));
}

void enable(Arguments& arguments, std::string_view name) {
  choose(arguments, name, enabledValue(extraNamed("enable", name)));
}

void disable(Arguments& arguments, std::string_view name) {
  const Option& option = extraNamed("disable", name);
  choose(arguments, name, option.kind == Option::Kind::boolean ? "off" : option.get(Settings{}));
}

void set(Arguments& arguments, std::string_view value) {
  const size_t equals = value.find('=');
  if (equals == std::string_view::npos)
    throw Error(Fault::usage, "--set: expected name=value, found \"" + std::string(value) + "\"");
  choose(arguments, value.substr(0, equals), value.substr(equals + 1));
}

/// Throws Error(Fault::usage).
int wholeNumber(std::string_view flag, std::string_view value, int least, int most) {
  const auto number = parseNumber(value);
  if (!number || number->length != value.size() || number->value != std::floor(number->value) ||
      number->value < least || number->value > most)
    throw Error(Fault::usage, "--" + std::string(flag) + ": expected a whole number from " +
                                  std::to_string(least) + " to " + std::to_string(most) + ", found \"" +
                                  std::string(value) + "\"");
  return static_cast<int>(number->value);
}

void setOutput(Arguments& arguments, std::string_view value) {
  if (value.empty()) throw Error(Fault::usage, "--output: expected the name of a file, found nothing");
  arguments.output = value;
}

}  // namespace

std::span<const Flag> flags() {
  static constexpr std::array kTable{
      Flag{"output", 'o', Takes::value, "FILE", "", "render", true,
           "picture to write; by default the scene's name with .png, in this folder", setOutput},
      Flag{"quick", 0, Takes::nothing, "", "", "render info", true,
           "a look in a moment: 100 pixels wide, the whole picture, depth 2, spp 1; flags beside it override",
           [](Arguments& a, std::string_view) { a.quick = true; }},
      Flag{"enable", 0, Takes::value, "NAME", "", "render info", true,
           "switch an extra on, with a useful value (ray features lists them)", enable},
      Flag{"disable", 0, Takes::value, "NAME", "", "render info", true, "switch an extra off", disable},
      Flag{"set", 0, Takes::value, "NAME=VALUE", "", "render info", false, "give any option a value", set},
      Flag{"stats", 0, Takes::optional, "table|json", "table", "render", true,
           "count rays, tests and time: a table on stderr, or JSON on stdout",
           [](Arguments& a, std::string_view value) {
             constexpr std::array<std::string_view, 2> kNames{"table", "json"};
             a.stats = pick("stats", value, kNames) == 0 ? StatsStyle::table : StatsStyle::json;
           }},
      Flag{"progress", 0, Takes::optional, "auto|bar|plain|json|none", "auto", "render", true,
           "how far it is: a bar on a terminal, else a line now and then (auto)",
           [](Arguments& a, std::string_view value) {
             constexpr std::array<std::string_view, 5> kNames{"auto", "bar", "plain", "json", "none"};
             a.progress = static_cast<ProgressStyle>(pick("progress", value, kNames));
           }},
      Flag{"camera", 0, Takes::value, "FIELDS", "", "convert", false,
           "a camera in place of the scene's, as inside camera { } of a .ray file",
           [](Arguments& a, std::string_view value) { a.conversion.camera = value; }},
      Flag{"light", 0, Takes::value, "NODE", "", "convert", false,
           "a light in place of the scene's, as in a .ray file; may be repeated",
           [](Arguments& a, std::string_view value) { a.conversion.lights.emplace_back(value); }},
      Flag{"material", 0, Takes::value, "FIELDS", "", "convert", false,
           "a material for all objects, as inside material { } of a .ray file",
           [](Arguments& a, std::string_view value) { a.conversion.material = value; }},
      Flag{"digits", 0, Takes::value, "N", "", "convert", false,
           "digits of numbers in text that count, 1 to 17; by default as many as are needed to read the same "
           "back",
           [](Arguments& a, std::string_view value) {
             a.conversion.digits = wholeNumber("digits", value, 1, 17);
           }},
      Flag{"ascii", 0, Takes::nothing, "", "", "convert", false, "write PLY as text",
           [](Arguments& a, std::string_view) { a.conversion.ascii = true; }},
      Flag{"revolve", 0, Takes::nothing, "", "", "convert", false,
           "the input is a profile, lines of \"x y\", to be turned about the y axis",
           [](Arguments& a, std::string_view) { a.conversion.revolve = true; }},
      Flag{"steps", 0, Takes::value, "N", "", "convert", false,
           "steps of --revolve around the axis, 3 to 100000; default 64",
           [](Arguments& a, std::string_view value) {
             a.conversion.steps = wholeNumber("steps", value, 3, 100000);
           }},
      Flag{"log-level", 0, Takes::value, "error|warning|info|debug", "", "render info convert", false,
           "which messages are shown; default info",
           [](Arguments& a, std::string_view value) { a.logLevel = logLevel("--log-level", value); }},
      Flag{"strict", 0, Takes::nothing, "", "", "render info convert", true,
           "warnings about the scene are errors", [](Arguments& a, std::string_view) { a.strict = true; }},
      Flag{"format", 0, Takes::value, "text|json", "", "info", false, "how ray info prints; default text",
           [](Arguments& a, std::string_view value) {
             constexpr std::array<std::string_view, 2> kNames{"text", "json"};
             a.json = pick("format", value, kNames) == 1;
           }},
      Flag{"markdown", 0, Takes::nothing, "", "", "features", false, "print docs/options.md",
           [](Arguments& a, std::string_view) { a.markdown = true; }},
      Flag{"print-defaults", 0, Takes::nothing, "", "", "render", false,
           "print every option as NAME=VALUE with its default, and end",
           [](Arguments& a, std::string_view) { a.printDefaults = true; }},
      Flag{"help", 'h', Takes::optional, "all", "common", kEverywhere, true,
           "print this page; with \"all\" every flag, its range and source",
           [](Arguments& a, std::string_view value) {
             constexpr std::array<std::string_view, 2> kNames{"common", "all"};
             a.help = true;
             a.helpAll = pick("help", value, kNames) == 1;
           }},
      Flag{"version", 0, Takes::nothing, "", "", kEverywhere, false, "print the version",
           [](Arguments& a, std::string_view) { a.version = true; }},
  };
  return kTable;
}

bool knows(std::string_view command, const Flag& flag) {
  for (size_t at = flag.commands.find(command); at != std::string_view::npos;
       at = flag.commands.find(command, at + 1)) {
    const size_t end = at + command.size();
    if ((at == 0 || flag.commands[at - 1] == ' ') &&
        (end == flag.commands.size() || flag.commands[end] == ' '))
      return true;
  }
  return false;
}

bool takesOptions(std::string_view command) { return command == "render" || command == "info"; }

std::span<const ShortFlag> shortFlags() {
  static constexpr std::array kTable{
      ShortFlag{'w', "width", "", ""},
      ShortFlag{'r', "depth", "", ""},
      ShortFlag{'t', "threads", "", ""},
      ShortFlag{'b', "accel", "bvh", "acceleration on"},
      ShortFlag{'B', "accel", "none", "acceleration off"},
      ShortFlag{'a', "spp", "9", "anti-aliasing on"},
      ShortFlag{'A', "spp", "1", "anti-aliasing off"},
  };
  return kTable;
}

std::string_view enabledValue(const Option& option) {
  if (option.kind == Option::Kind::boolean) return "on";
  constexpr std::pair<std::string_view, std::string_view> kUseful[] = {{"spp", "9"}, {"threshold", "0.003"}};
  for (const auto& [name, value] : kUseful)
    if (name == option.name) return value;
  return {};
}

std::span<const Choice> quickChoices() {
  static const std::array<Choice, 5> kChoices{{{"width", "100", {}},
                                               {"height", "0", {}},
                                               {"region", "0,0,0,0", {}},
                                               {"depth", "2", {}},
                                               {"spp", "1", {}}}};
  return kChoices;
}

}  // namespace trace::cli
