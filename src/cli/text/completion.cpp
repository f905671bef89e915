#include "cli/text/completion.h"

#include <algorithm>

#include "app/compare/difference.h"
#include "app/compare/extensions.h"
#include "app/editing/studio_flags.h"
#include "app/editing/texture_edits.h"
#include "cli/text/help_parts.h"
#include "formats/format.h"
#include "image/codecs/codec.h"
#include "shading/library.h"

namespace trace::cli {
namespace {

using CandidateKind = Candidates::Kind;

std::vector<std::string> strings(std::span<const std::string_view> views) {
  return {views.begin(), views.end()};
}

Candidates candidatesOf(const Option& option) {
  switch (option.kind) {
    case Option::Kind::boolean: return {CandidateKind::words, {"on", "off"}};
    case Option::Kind::choice: return {CandidateKind::words, strings(option.choices)};
    case Option::Kind::choices: {
      Candidates result{CandidateKind::list, strings(option.choices)};
      result.words.insert(result.words.begin(), "none");
      return result;
    }
    case Option::Kind::file: return {CandidateKind::files, {"none"}};
    case Option::Kind::integer:
    case Option::Kind::real:
    case Option::Kind::color:
    case Option::Kind::region:
    case Option::Kind::place: break;
  }
  return {CandidateKind::anything};
}

/// The names between the bars of "text|json".
std::vector<std::string> betweenBars(std::string_view values) {
  std::vector<std::string> words;
  for (std::size_t at = 0; at <= values.size();) {
    const std::size_t bar = std::min(values.find('|', at), values.size());
    words.emplace_back(values.substr(at, bar - at));
    at = bar + 1;
  }
  return words;
}

Candidates candidatesOf(const Flag& flag) {
  if (flag.takes == Flag::Takes::nothing) return {};
  if (flag.takes == Flag::Takes::optional || flag.values.find('|') != std::string_view::npos)
    return {CandidateKind::words, betweenBars(flag.values)};
  if (flag.values == "FILE") return {CandidateKind::files};
  if (flag.values == "SCENE") return sceneFiles();
  if (flag.values == "DIR" || flag.values == "FOLDER") return {CandidateKind::folders};
  Candidates result{flag.values == "METRIC,METRIC" ? CandidateKind::list : CandidateKind::words};
  if (flag.values == "NAME") {  // the name of an extra
    for (const Option& option : options())
      if (!enabledValue(option).empty()) result.words.emplace_back(option.name);
  } else if (flag.values == "EXTENSION") {
    result.words = namesToSwitchOff();
  } else if (flag.values == "NAME=VALUE") {
    for (const Option& option : options()) result.words.push_back(std::string(option.name) + "=");
  } else if (flag.values == "METRIC=X" || flag.values == "METRIC,METRIC") {
    for (const Metric& metric : metrics())
      result.words.push_back(std::string(metric.name) + (flag.values == "METRIC=X" ? "=" : ""));
  } else {
    return {CandidateKind::anything};
  }
  return result;
}

void addOption(std::vector<FlagFace>& faces, const Option& option) {
  FlagFace face{{"--" + std::string(option.name)},
                std::string(option.help),
                placeholder(option),
                option.kind == Option::Kind::boolean,
                candidatesOf(option)};
  for (const ShortFlag& flag : shortFlags())
    if (flag.option == option.name && flag.value.empty())
      face.names.insert(face.names.begin(), std::string("-") + flag.letter);
  faces.push_back(std::move(face));
  if (option.kind == Option::Kind::boolean)
    faces.push_back({{"--no-" + std::string(option.name)}, "not: " + std::string(option.help), ""});
}

/// The courses' flags that stand for a value.
void addShortFlags(std::vector<FlagFace>& faces) {
  for (const ShortFlag& flag : shortFlags())
    if (!flag.value.empty()) faces.push_back({{std::string("-") + flag.letter}, std::string(flag.help), ""});
}

Candidates pictureFiles() {
  Candidates result{CandidateKind::files};
  for (const PictureFormat& format : pictureFormats())
    result.suffixes.insert(result.suffixes.end(), format.suffixes.begin(), format.suffixes.end());
  return result;
}

}  // namespace

Candidates sceneFiles() {
  Candidates result{CandidateKind::files};
  for (const SceneFormat& format : sceneFormats())
    for (const std::string_view suffix : format.suffixes) {
      if (std::find(result.suffixes.begin(), result.suffixes.end(), suffix) != result.suffixes.end())
        continue;
      result.suffixes.emplace_back(suffix);
      result.suffixes.push_back(std::string(suffix) + ".gz");
    }
  return result;
}

Candidates operands(Verb command) {
  switch (command) {
    case Verb::render:
    case Verb::gui:
    case Verb::info:
    case Verb::bench:
    case Verb::explain:
    case Verb::lint:
    case Verb::convert:
    case Verb::format:
    case Verb::expand:
    case Verb::split:
    case Verb::farm:
    case Verb::stereogram: return sceneFiles();
    case Verb::diff: return pictureFiles();
    case Verb::merge:
    case Verb::grade: return {CandidateKind::folders};
    case Verb::texture: {
      Candidates result = sceneFiles();
      for (const TextureKind& kind : textureKindsToChoose()) result.words.emplace_back(kind.keyword);
      return result;
    }
    case Verb::materials: return {CandidateKind::words, strings(libraryNames())};
    case Verb::help: {
      Candidates result{CandidateKind::words, {"all"}};
      for (const Command& row : commands()) result.words.emplace_back(row.name);
      return result;
    }
    case Verb::newScene: return {CandidateKind::anything};
    case Verb::features:
    case Verb::selftest: break;
  }
  return {};
}

std::vector<FlagFace> flagFaces(Verb command) {
  std::vector<FlagFace> faces;
  for (const Flag& flag : flags()) {
    if (!flag.commands.has(command)) continue;
    FlagFace face{{"--" + std::string(flag.name)},
                  std::string(flag.name == "output" ? commandOf(command).output : flag.help),
                  std::string(flag.values),
                  flag.takes == Flag::Takes::optional,
                  candidatesOf(flag)};
    if (flag.letter) face.names.insert(face.names.begin(), std::string("-") + flag.letter);
    faces.push_back(std::move(face));
  }
  for (const Option& option : options())
    if (takesOption(command, option)) addOption(faces, option);
  if (takesOptions(command)) addShortFlags(faces);
  return faces;
}

std::vector<FlagFace> studioFlagFaces() {
  std::vector<FlagFace> faces;
  for (const StudioFlag& flag : kStudioFlags) {
    FlagFace face{{"--" + std::string(flag.name)}, std::string(flag.help), std::string(flag.value)};
    if (flag.letter) face.names.insert(face.names.begin(), std::string("-") + flag.letter);
    if (!flag.value.empty()) face.candidates.kind = CandidateKind::anything;
    if (flag.value == "FILE") face.candidates.kind = CandidateKind::files;
    if (flag.value == "DIR") face.candidates.kind = CandidateKind::folders;
    if (flag.value == "PICTURE") face.candidates = pictureFiles();
    faces.push_back(std::move(face));
  }
  for (const Option& option : options()) addOption(faces, option);
  addShortFlags(faces);
  return faces;
}

}  // namespace trace::cli
