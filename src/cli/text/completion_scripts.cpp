// The scripts that tell bash, zsh and fish what completion.cpp knows.
#include <algorithm>
#include <set>
#include <utility>

#include "cli/text/completion.h"

namespace trace::cli {
namespace {

using Kind = Candidates::Kind;

bool operator==(const Candidates& a, const Candidates& b) {
  return a.kind == b.kind && a.words == b.words && a.suffixes == b.suffixes;
}

std::string spaced(const std::vector<std::string>& words, std::string_view between = " ") {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : std::string(between)) + word;
  return text;
}

/// In single quotes, as all three shells read them.
std::string shellQuoted(std::string_view text, std::string_view quote = "'\\''") {
  std::string result = "'";
  for (char c : text) result += c == '\'' ? std::string(quote) : std::string(1, c);
  return result + "'";
}

std::vector<std::string> commandNames() {
  std::vector<std::string> names;
  for (const Command& command : commands()) names.emplace_back(command.name);
  return names;
}

/// "render | info" of the sub-commands.
std::string namedBetween(Verbs verbs, std::string_view between) {
  std::vector<std::string> names;
  for (const Command& command : commands())
    if (verbs.has(command.verb)) names.emplace_back(command.name);
  return spaced(names, between);
}

/// "ray|ray.gz|tr", of suffixes.
std::string alternatives(const std::vector<std::string>& suffixes) {
  std::string text;
  for (const std::string& suffix : suffixes) text += (text.empty() ? "" : "|") + suffix.substr(1);
  return text;
}

// --- bash ----------------------------------------------------------------------------------------------

constexpr std::string_view kBashHead =
    R"(# Completion of ray, trace-ray and ray-studio for bash, made by `ray features --completion bash`.

)";

constexpr std::string_view kBashTail = R"(
# Adds the candidates of $kind that begin with what is typed.
_trace_ray_offer() {
  local word file head='' typed=${cur//\\/} IFS=$'\n'
  if [[ $kind == list && $typed == *,* ]]; then head=${typed%,*}, typed=${typed##*,}; fi
  for word in $words; do
    [[ $word == "$typed"* ]] || continue
    [[ $kind == list || $word == *= ]] && compopt -o nospace 2>/dev/null
    word=$head$word
    [[ $word != *' '* ]] || printf -v word %q "$word"
    COMPREPLY+=("$word")
  done
  case $kind in
    folders) compopt -o filenames 2>/dev/null
      while read -r file; do COMPREPLY+=("$file"); done < <(compgen -d -- "$cur") ;;
    files) compopt -o filenames 2>/dev/null
      while read -r file; do
        if [[ -z $suffixes || -d ${file/#\~/$HOME} || ${file,,} =~ \.($suffixes)$ ]]; then COMPREPLY+=("$file"); fi
      done < <(compgen -f -- "$cur") ;;
  esac
}

_trace_ray() {
  local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD - 1]} command=render given=''
  local kind=none words='' suffixes='' optional=''
  COMPREPLY=()
  if [[ ${COMP_WORDS[0]##*/} == ray-studio ]]; then
    command=ray-studio
  elif ((COMP_CWORD > 1)) && [[ " $_trace_ray_commands " == *" ${COMP_WORDS[1]} "* ]]; then
    command=${COMP_WORDS[1]}
  fi
  if [[ $cur == = ]]; then  # bash takes "--name=value" for three words
    cur='' given=1
  elif [[ $prev == = ]]; then
    prev=${COMP_WORDS[COMP_CWORD - 2]} given=1
  fi
  [[ -z $given || $prev == -* ]] || prev=--$prev  # --set NAME=VALUE
  ((COMP_CWORD < 2)) && [[ -z $given ]] && prev=''
  _trace_ray_values "$command $prev"
  if [[ $kind != none && ( -z $optional || -n $given || $cur != -* ) ]]; then
    _trace_ray_offer
    [[ -n $optional && -z $given ]] || return 0
  elif [[ -n $given ]]; then
    return 0
  fi
  words='' suffixes='' kind=words
  if [[ $cur == -* ]]; then
    _trace_ray_flags "$command"
    words=${words// /$'\n'}
  else
    _trace_ray_operands "$command"
    if ((COMP_CWORD == 1)) && [[ $command == render ]]; then words=${_trace_ray_commands// /$'\n'}; fi
  fi
  _trace_ray_offer
}

complete -F _trace_ray ray trace-ray ray-studio
)";

/// Sets the variables that _trace_ray_offer looks at.
std::string bashCandidates(const Candidates& c) {
  switch (c.kind) {
    case Kind::none: return "kind=none";
    case Kind::anything: return "kind=anything";
    case Kind::words: return "kind=words words=" + shellQuoted(spaced(c.words, "\n"));
    case Kind::list: return "kind=list words=" + shellQuoted(spaced(c.words, "\n"));
    case Kind::folders: return "kind=folders";
    case Kind::files:
      return "kind=files" + (c.words.empty() ? "" : " words=" + shellQuoted(spaced(c.words, "\n"))) +
             " suffixes=" + shellQuoted(alternatives(c.suffixes));
  }
  return "";
}

/// The cases of values: one for each kind of value, with the flags of the sub-command that take it.
/// `known`: flags of other commands and what they take, which need no second case.
std::string bashValues(const std::string& command, const std::vector<FlagFace>& faces,
                       std::vector<std::pair<std::string, Candidates>>& known) {
  std::vector<std::pair<std::string, std::string>> cases;  // what is done, and the patterns
  for (const FlagFace& face : faces)
    for (const std::string& name : face.names) {
      const auto before =
          std::find_if(known.begin(), known.end(), [&](const auto& row) { return row.first == name; });
      if (before != known.end() && before->second == face.candidates) continue;
      const std::string pattern = (before == known.end() ? "*' " : "'" + command + " ") + name + "'";
      if (before == known.end()) known.emplace_back(name, face.candidates);
      const std::string done = bashCandidates(face.candidates) + (face.optional ? " optional=1" : "");
      const auto same =
          std::find_if(cases.begin(), cases.end(), [&](const auto& row) { return row.first == done; });
      if (same == cases.end())
        cases.emplace_back(done, pattern);
      else
        same->second += " | " + pattern;
    }
  std::string text;
  for (const auto& [done, patterns] : cases)
    if (done != "kind=none" || patterns.front() == '\'') text += "    " + patterns + ") " + done + " ;;\n";
  return text;
}

std::string bashScript() {
  std::string text(kBashHead);
  text += "_trace_ray_commands=" + shellQuoted(spaced(commandNames())) + "\n\n";

  std::vector<std::pair<std::string, Candidates>> known;
  std::string values;
  for (const Command& command : commands())
    values += bashValues(std::string(command.name), flagFaces(command.verb), known);
  values = bashValues("ray-studio", studioFlagFaces(), known) + values;  // exceptions come first
  text +=
      "# What may stand after a flag. Usage: _trace_ray_values 'COMMAND FLAG'\n_trace_ray_values() {\n"
      "  case $1 in\n" +
      values + "  esac\n}\n\n# The flags of a command\n_trace_ray_flags() {\n  case $1 in\n";
  const auto flagsCase = [&](const std::string& name, const std::vector<FlagFace>& faces) {
    std::vector<std::string> names;
    for (const FlagFace& face : faces) names.insert(names.end(), face.names.begin(), face.names.end());
    text += "    " + name + ") words=" + shellQuoted(spaced(names)) + " ;;\n";
  };
  for (const Command& command : commands()) flagsCase(std::string(command.name), flagFaces(command.verb));
  flagsCase("ray-studio", studioFlagFaces());
  text += "  esac\n}\n\n# What stands where no flag does\n_trace_ray_operands() {\n  case $1 in\n";
  for (const Command& command : commands())
    text += "    " + std::string(command.name) + ") " + bashCandidates(operands(command.verb)) + " ;;\n";
  text += "    ray-studio) " + bashCandidates(sceneFiles()) + " ;;\n  esac\n}\n";
  return text + std::string(kBashTail);
}

// --- zsh -----------------------------------------------------------------------------------------------

constexpr std::string_view kZshHead = R"(#compdef ray trace-ray ray-studio
# Completion of ray, trace-ray and ray-studio for zsh, made by `ray features --completion zsh`.

)";

constexpr std::string_view kZshTail = R"(
_trace_ray() {
  local -a flags
  local command=render
  if [[ ${service:-${words[1]:t}} == ray-studio ]]; then
    command=ray-studio
  elif (( CURRENT > 2 )) && [[ " $_trace_ray_commands " == *" $words[2] "* ]]; then
    command=$words[2]
    shift words
    (( CURRENT-- ))
  fi
  _trace_ray_flags_of $command
  if [[ $command == render && $words[1] != render ]]; then
    _arguments -s : $flags '1: :_trace_ray_first' '*: :_trace_ray_operands render'
  else
    _arguments -s : $flags "*: :_trace_ray_operands $command"
  fi
}

_trace_ray_first() {
  _describe -t commands command _trace_ray_described
  _trace_ray_operands render
}

if [[ $funcstack[1] == _trace-ray ]]; then
  _trace_ray "$@"
else
  compdef _trace_ray ray trace-ray ray-studio
fi
)";

/// A word of a list in an action.
std::string zshWord(std::string_view word) {
  std::string text;
  for (char c : word) text += c == ' ' ? std::string("\\ ") : std::string(1, c);
  return text;
}

std::string zshWords(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + zshWord(word);
  return text;
}

/// The action by which _arguments completes a value; it closes the single quotes before it and opens them
/// again.
std::string zshAction(const Candidates& c) {
  switch (c.kind) {
    case Kind::none: return "";
    case Kind::anything: return " ";
    case Kind::words:
      if (!c.words.empty() && c.words.front().ends_with('='))
        return " compadd -S \"\" - " + zshWords(c.words);
      return "(" + zshWords(c.words) + ")";
    case Kind::list: return " _values -s , value " + zshWords(c.words);
    case Kind::files:
      return c.suffixes.empty() ? "_files" : "_files -g \"*.(" + alternatives(c.suffixes) + ")\"";
    case Kind::folders: return "_files -/";
  }
  return "";
}

std::string zshEscaped(std::string_view text) {
  std::string result;
  for (char c : text)
    result += (c == '[' || c == ']' || c == ':' || c == '\\' ? "\\" : "") + std::string(1, c);
  return result;
}

/// One line for each spelling.
std::string zshSpecs(const std::vector<FlagFace>& faces) {
  std::string text;
  for (const FlagFace& face : faces)
    for (const std::string& name : face.names) {
      const bool takes = face.candidates.kind != Kind::none, isLong = name.starts_with("--");
      if (face.optional && !isLong) continue;  // its value stands behind the long one only
      text += "    " +
              shellQuoted(name +
                          (!takes   ? ""
                           : isLong ? "="
                                    : "+") +
                          "[" + zshEscaped(face.help) + "]" +
                          (!takes ? ""
                                  : (face.optional ? "::" : ":") + zshEscaped(face.value) + ":" +
                                        zshAction(face.candidates))) +
              "\n";
    }
  return text;
}

std::string zshOperands(const Candidates& c) {
  std::string text;
  if (!c.words.empty()) text += "compadd - " + zshWords(c.words);
  if (c.kind == Kind::files || c.kind == Kind::folders) text += (text.empty() ? "" : "; ") + zshAction(c);
  return text.empty() ? c.kind == Kind::anything ? "_message name" : "_message nothing" : text;
}

std::string zshScript() {
  std::string text(kZshHead);
  text += "_trace_ray_commands=" + shellQuoted(spaced(commandNames())) + "\n_trace_ray_described=(\n";
  for (const Command& command : commands())
    text += "  " + shellQuoted(std::string(command.name) + ":" + std::string(command.help)) + "\n";
  text += ")\n\n# Sets the flags of a command\n_trace_ray_flags_of() {\n  case $1 in\n";
  for (const Command& command : commands())
    text += "  " + std::string(command.name) + ") flags=(\n" + zshSpecs(flagFaces(command.verb)) + "  ) ;;\n";
  text += "  ray-studio) flags=(\n" + zshSpecs(studioFlagFaces()) +
          "  ) ;;\n  esac\n}\n\n# What stands where no flag does\n_trace_ray_operands() {\n  case $1 in\n";
  for (const Command& command : commands())
    text += "  " + std::string(command.name) + ") " + zshOperands(operands(command.verb)) + " ;;\n";
  text += "  ray-studio) " + zshOperands(sceneFiles()) + " ;;\n  esac\n}\n";
  return text + std::string(kZshTail);
}

// --- fish ----------------------------------------------------------------------------------------------

constexpr std::string_view kFishHead =
    R"(# Completion of ray, trace-ray and ray-studio for fish, made by `ray features --completion fish`.

# The sub-command that is typed, or the one that may be left out
function __trace_ray_command
    set -l typed (commandline -opc)
    if set -q typed[2]; and contains -- $typed[2] $__trace_ray_commands
        echo $typed[2]
    else
        echo render
    end
end

function __trace_ray_is
    contains -- (__trace_ray_command) $argv
end

# Folders, and files with one of these suffixes
function __trace_ray_files
    set -l suffixes (string join '|' -- $argv | string replace -a . '\\.')
    __fish_complete_path (commandline -ct | string replace -r -- '^-[^=]*=' '') | string match -ir "^[^\t]*(?:/|$suffixes)(?:\t.*)?\$"
end

)";

/// The words of a list in double quotes, which fish takes apart again.
std::string fishWords(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words)
    text += (text.empty() ? "" : " ") + (word.find(' ') == std::string::npos ? word : "\"" + word + "\"");
  return text;
}

std::string fishFiles(const Candidates& c) { return "(__trace_ray_files " + spaced(c.suffixes) + ")"; }

/// The end of a line of `complete`: what the flag takes.
std::string fishCandidates(const Candidates& c, bool optional) {
  const std::string takes = optional ? " -f" : " -x";
  switch (c.kind) {
    case Kind::none: return " -f";
    case Kind::anything: return takes;
    case Kind::words: return takes + " -a " + shellQuoted(fishWords(c.words), "\\'");
    case Kind::list:
      return takes + " -a " + shellQuoted("(__fish_append , " + fishWords(c.words) + ")", "\\'");
    case Kind::folders: return takes + " -a '(__fish_complete_directories)'";
    case Kind::files:
      if (c.suffixes.empty())
        return " -r -F" + (c.words.empty() ? "" : " -a " + shellQuoted(fishWords(c.words)));
      return takes + " -a " + shellQuoted(fishFiles(c), "\\'");
  }
  return "";
}

std::string fishFlag(const std::string& program, const std::string& condition, const FlagFace& face) {
  std::string text = "complete -c " + program + condition;
  for (const std::string& name : face.names)
    text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  return text + fishCandidates(face.candidates, face.optional) + " -d " + shellQuoted(face.help, "\\'") +
         "\n";
}

std::string fishOperands(const std::string& program, const std::string& condition, const Candidates& c) {
  std::string text;
  const std::string start = "complete -c " + program + condition + " -f -a ";
  if (!c.words.empty()) text += start + shellQuoted(fishWords(c.words), "\\'") + "\n";
  if (c.kind == Kind::files) text += start + shellQuoted(fishFiles(c), "\\'") + "\n";
  if (c.kind == Kind::folders) text += start + "'(__fish_complete_directories)'\n";
  return text;
}

/// The sub-commands of a flag with one face.
struct SharedFace {
  FlagFace face;
  Verbs commands;
};

/// Every flag of every sub-command; a flag that several know in the same words once.
std::vector<SharedFace> sharedFaces() {
  std::vector<SharedFace> all;
  for (const Command& command : commands())
    for (FlagFace& face : flagFaces(command.verb)) {
      const auto same = std::find_if(all.begin(), all.end(), [&](const SharedFace& shared) {
        return shared.face.names == face.names && shared.face.help == face.help;
      });
      if (same == all.end())
        all.push_back({std::move(face), {command.verb}});
      else
        same->commands.add(command.verb);
    }
  return all;
}

std::string fishScript() {
  std::string text(kFishHead);
  text += "set -g __trace_ray_commands " + spaced(commandNames()) + "\n\nfor program in ray trace-ray\n";
  for (const Command& command : commands())
    text += "complete -c $program -n 'test (count (commandline -opc)) -eq 1' -f -a " +
            std::string(command.name) + " -d " + shellQuoted(command.help, "\\'") + "\n";
  for (const SharedFace& shared : sharedFaces())
    text +=
        fishFlag("$program", " -n '__trace_ray_is " + namedBetween(shared.commands, " ") + "'", shared.face);
  for (const Command& command : commands())
    text += fishOperands("$program", " -n '__trace_ray_is " + std::string(command.name) + "'",
                         operands(command.verb));
  text += "end\n\n";
  for (const FlagFace& face : studioFlagFaces()) text += fishFlag("ray-studio", "", face);
  return text + fishOperands("ray-studio", "", sceneFiles());
}

}  // namespace

std::string completionScript(std::string_view shell) {
  return shell == "bash" ? bashScript() : shell == "zsh" ? zshScript() : fishScript();
}

}  // namespace trace::cli
