#include "cli/text/manual.h"

#include <algorithm>
#include <cctype>

#include "app/editing/studio_flags.h"
#include "cli/text/help_parts.h"
#include "scene/conventions.h"

namespace trace::cli {
namespace {

/// Text as roff reads it: minus signs that can be copied, and no line that begins with a request.
std::string roff(std::string_view text) {
  std::string result;
  if (text.starts_with('.') || text.starts_with('\'')) result += "\\&";
  for (char c : text) {
    switch (c) {
      case '\\': result += "\\e"; break;
      case '-': result += "\\-"; break;
      case '\'': result += "\\(aq"; break;
      case '`': result += "\\(ga"; break;
      case '^': result += "\\(ha"; break;
      case '~': result += "\\(ti"; break;
      case '"': result += "\\(dq"; break;
      default: result += c;
    }
  }
  return result;
}

std::string bold(std::string_view text) { return "\\fB" + roff(text) + "\\fR"; }

/// Upper case, as headings are.
std::string heading(std::string_view text) {
  std::string upper(text);
  for (char& c : upper) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return ".SH \"" + roff(upper) + "\"\n";
}

/// A sentence of a table, as one that ends.
std::string sentence(std::string_view text) {
  std::string result(text);
  if (!result.empty())
    result.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(result.front())));
  return roff(result) + ".\n";
}

std::string item(const std::string& label, const std::string& text) { return ".TP\n" + label + "\n" + text; }

/// The value of a flag; a line may end between the names of a list.
std::string valueLabel(std::string_view value) {
  std::string text;
  for (char c : roff(value)) text += std::string(1, c) + (c == '|' || c == ',' ? "\\:" : "");
  return "\\fI" + text + "\\fR";
}

/// "-w, --width" in bold, and after it what it takes.
std::string flagLabel(const std::string& flags, const std::string& value) {
  return bold(flags) + (value.empty() ? "" : " " + valueLabel(value));
}

std::string optionItem(const Option& option) {
  std::string text = roff(option.help);
  if (option.kind == Option::Kind::integer || option.kind == Option::Kind::real)
    text += "; " + roff(rangeText(option));
  text += ".\nDefault: " + roff(defaultOf(option)) + ".\n";
  if (const std::string shorts = shortValues(option); !shorts.empty()) text += roff(shorts) + ".\n";
  if (option.extra)
    text += "An extra, off by default: " + bold("--enable " + std::string(option.name)) + " gives " +
            roff(enabledValue(option)) + ".\n";
  if (!option.source.empty()) text += "Source: " + roff(option.source) + ".\n";
  return item(flagLabel(flagsOf(option), placeholder(option)), text);
}

std::string optionItems() {
  std::string text;
  for (const std::string_view group : optionGroups()) {
    text += ".SS \"" + roff(group) + "\"\n";
    for (const Option& option : options())
      if (option.group == group) text += optionItem(option);
  }
  return text;
}

std::string firstLine(std::string_view name) {
  std::string upper(name);
  for (char& c : upper) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return ".\\\" Made by `ray features --man " + std::string(name) +
         "` from the tables that drive the program.\n"
         ".TH \"" +
         roff(upper) + "\" 1 \"\" \"Trace " TRACE_VERSION "\" \"Trace\"\n.nh\n.ad l\n";
}

/// Words in bold, and what they mean.
std::string rows(std::initializer_list<std::pair<std::string_view, std::string_view>> pairs) {
  std::string text;
  for (const auto& [words, meaning] : pairs) text += item(bold(words), roff(meaning) + "\n");
  return text;
}

std::string rayPage() {
  std::string text = firstLine("ray") + heading("name") +
                     "ray, trace\\-ray \\- render scenes by ray tracing, and explain every ray\n" +
                     heading("synopsis");
  for (const Command& command : commands())
    text += (&command == &commands().front() ? "" : ".br\n") + std::string("\\fBray\\fR ") +
            roff(usageOf(command).substr(4)) + " [flags]\n";
  text +=
      heading("description") +
      "Trace reads the scenes of the graphics courses of Washington, Austin, Hong Kong, British Columbia,\n"
      "Montreal and Southern California, and mesh files such as OBJ, PLY and glTF, and writes pictures.\n"
      ".B ray\nand\n.B trace\\-ray\nare two names of one program: other software is called ray, too.\n"
      ".PP\nA first picture:\n.PP\n.nf\n.RS\nray new first.ray\nray first.ray\n.RE\n.fi\n"
      ".PP\nThe line of the courses:\n.PP\n.nf\n.RS\n"
      "ray \\-b \\-w 400 \\-r 5 \\-t 1 in.ray out.bmp\n.RE\n.fi\n";
  text += heading("commands");
  for (const Command& command : commands()) {
    std::string what = sentence(command.help);
    if (!command.output.empty()) what += bold("-o") + " names " + roff(command.output) + ".\n";
    text += item(bold(usageOf(command)), what);
  }
  text += heading("flags");
  for (const Flag& flag : flags()) {
    std::string label = bold("--" + std::string(flag.name));
    if (flag.letter) label = bold(std::string("-") + flag.letter) + ", " + label;
    if (flag.takes != Flag::Takes::nothing) {
      const bool optional = flag.takes == Flag::Takes::optional;
      label += std::string(" ") + (optional ? "[" : "") + valueLabel(flag.values) + (optional ? "]" : "");
    }
    text += item(label, sentence(flag.help) + "Of: " + roff(namesOf(flag.commands)) + ".\n");
  }
  text +=
      heading("options") +
      "An option is a flag of the commands that render, and a keyword of settings { } in a scene file.\n"
      "A default is overridden by the scene file, and that by the command line. Options that are on or off\n"
      "take \\fB\\-\\-NAME\\fR, \\fB\\-\\-NAME on\\fR, \\fB\\-\\-NAME off\\fR and "
      "\\fB\\-\\-no\\-NAME\\fR.\n" +
      optionItems() + ".SS \"Conventions that \\-\\-like names\"\n";
  for (const Convention& row : conventions()) text += item(bold(row.name), sentence(row.help));
  text +=
      heading("environment") +
      rows({{"RAY_THREADS", "number of threads, as --threads"},
            {"RAY_LOG", "which messages are shown, as --log-level; flags override both"},
            {"NO_COLOR", "no colours"},
            {"TERM", "\"dumb\": no colours and no progress bar"},
            {"COLUMNS", "width of the terminal"}}) +
      heading("exit status") + sentence(exitCodes()) + heading("signals") + sentence(signalsText()) +
      heading("files") +
      rows({{"/usr/share/doc/trace-ray",
             "the pages of the manual and the example scenes, below the folder that Trace was installed to"},
            {"OUT.checkpoint", "next to a picture that was stopped: the next render resumes from it"}}) +
      heading("see also") + bold("ray-studio") + "(1)\n";
  return text;
}

std::string studioPage() {
  std::string text =
      firstLine("ray-studio") + heading("name") +
      "ray\\-studio \\- window that renders a scene, changes it and shows the rays of any pixel\n" +
      heading("synopsis") + "\\fBray\\-studio\\fR [SCENE] [flags]\n" + heading("description") +
      "The studio shows the picture as it is rendered, every option and field of the scene with\n"
      "undo, and for the pixel that you click all of its rays, in space and as a tree with numbers.\n"
      "\\fBray gui\\fR opens it, too.\n" +
      heading("flags");
  for (const StudioFlag& flag : kStudioFlags) {
    std::string names = "--" + std::string(flag.name);
    if (flag.letter) names = std::string("-") + flag.letter + ", " + names;
    text += item(flagLabel(names, std::string(flag.value)), sentence(flag.help));
  }
  return text + heading("options") +
         "These options override those of the scene, of every scene that is opened in the window.\n" +
         optionItems() + heading("files") +
         rows({{"$XDG_CONFIG_HOME/trace, ~/.config/trace",
                "what the window remembers; with --script nothing is read or kept"}}) +
         heading("see also") + bold("ray") + "(1)\n";
}

}  // namespace

std::string manualPage(std::string_view program) {
  return program == "ray-studio" ? studioPage() : rayPage();
}

}  // namespace trace::cli
