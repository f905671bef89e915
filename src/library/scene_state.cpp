#include "library/scene_state.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "base/text.h"
#include "formats/model.h"
#include "formats/ray/file/part.h"
#include "formats/textures.h"
#include "library/guard.h"
#include "scene/quality.h"

namespace traceray {
namespace {

constexpr const char* kBuilt = "built";

/// As the command line has it: on, 0.5, "a,b", 1,2,3.
std::string optionText(const Value& value) {
  if (value.isBoolean()) return value.boolean() ? "on" : "off";
  if (value.isNumber()) return trace::toText(value.number());
  if (value.isText()) return value.text();
  std::string text;
  for (const Value& one : value.list()) text += (text.empty() ? "" : ",") + optionText(one);
  return text;
}

template <class Thing>
void nameNewOf(const std::vector<Thing>& things, std::vector<std::uint64_t>& ids, std::uint64_t& next) {
  while (ids.size() < things.size()) ids.push_back(next++);
}

}  // namespace

namespace {

/// The names of the fields whose values hold the place: of `shininess` in `material = { shininess = -1; }`
/// both.
std::vector<std::string> fieldsAround(std::string_view text, const trace::SourcePlace& place, int firstLine) {
  if (text.empty()) return {};
  std::size_t end = 0;
  for (int line = firstLine; line < place.line; ++line)
    end = std::min(text.find('\n', end), text.size() - 1) + 1;
  end = std::min(end + static_cast<std::size_t>(std::max(place.column, 1)),
                 text.size());                    // behind its first byte
  std::vector<std::pair<int, std::string>> open;  // fields with the depth of brackets that they stand in
  int depth = 0;
  const auto isLetter = [&](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
  for (std::size_t at = 0; at < end;) {
    const char c = text[at];
    std::size_t next = at + 1;
    if (c == '"') {
      next = std::min(text.find('"', next), text.size() - 1) + 1;
    } else if (isLetter(c)) {
      while (next < text.size() && isLetter(text[next])) ++next;
      const std::size_t sign = text.find_first_not_of(' ', next);
      if (sign != text.npos && text[sign] == '=' && text.substr(sign, 2) != "==")
        open.emplace_back(depth, text.substr(at, next - at));
    } else if (c == '(' || c == '{') {
      ++depth;
    } else if (c == ')' || c == '}' || c == ';' || c == ',') {
      depth -= c == ')' || c == '}';
      const int closed = c == ';' || c == ',' ? depth : depth + 1;
      while (!open.empty() && open.back().first >= closed) open.pop_back();
    }
    at = next;
  }
  std::vector<std::string> names;
  for (auto& [at, name] : open) names.push_back(std::move(name));
  return names;
}

/// Pictures that could not be read are read again: a program may have made them since.
void lookAgainForTextures(trace::Scene& scene, trace::Messages& messages) {
  changePixels(scene, [](trace::Pixels& pixels) {
    if (pixels.map == trace::missingPicture()) pixels.map = nullptr;
  });
  loadTextures(scene, messages);
}

}  // namespace

void SceneState::nameNew() {
  nameNewOf(scene.objects, objectIds, nextId);
  nameNewOf(scene.lights, lightIds, nextId);
}

void SceneState::add(std::string_view statements) {
  const trace::ReadScope scope = readScope();
  const std::size_t objects = scene.objects.size(), lights = scene.lights.size(),
                    materials = scene.materials.size(), chosen = scene.choices.size(),
                    unrendered = scene.unrendered.size(), unused = scene.unusedMaterials.size();
  const trace::Camera camera = scene.camera;
  const trace::Background background = scene.background;
  // A reader of the kind `Trace 1` counts its first line.
  const int lines = nextLine - 2;
  const std::string file = folder() + kBuilt;
  const auto moved = [&](trace::SourcePlace place) {
    if (place.file == file && place.line > 0) place.line += lines;
    return place;
  };
  trace::Messages messages;
  trace::rayfile::PartGiven said;
  try {
    said = trace::rayfile::readPart(file, statements, scene, messages);
    changePixels(scene, [&](trace::Pixels& pixels) {
      if (!pixels.map && !pixels.file.empty()) pixels.place = moved(pixels.place);
    });
    loadTextures();
  } catch (...) {
    scene.objects.resize(objects);
    scene.lights.resize(lights);
    scene.materials.resize(materials);
    scene.choices.resize(chosen);
    scene.unrendered.resize(unrendered);
    scene.unusedMaterials.resize(unused);
    scene.camera = camera;
    scene.background = background;
    try {
      throw;
    } catch (const trace::Error& error) {
      std::vector<trace::Message> all = error.messages();
      for (trace::Message& message : all) message.place = moved(message.place);
      throw trace::Error(error.fault(), std::move(all));
    }
  }
  for (std::size_t i = objects; i < scene.objects.size(); ++i)
    scene.objects[i].place = moved(scene.objects[i].place);
  for (std::size_t i = lights; i < scene.lights.size(); ++i)
    scene.lights[i].place = moved(scene.lights[i].place);
  nameNew();
  for (const trace::Message& message : messages.all()) {
    trace::Message there = message;
    there.place = moved(message.place);
    const auto [category, id] = newPartAt(there.place, objects, lights);
    if (category != kNoPart)
      warn(category, id, {&there, 1}, statements, nextLine);
    else
      warn(said.camera       ? kCamera
           : said.background ? kBackground
                             : kNoPart,
           0, {&there, 1}, statements, nextLine);
  }
  given.fading.insert(given.fading.end(), said.kind.fading.begin(), said.kind.fading.end());
  if (said.camera) {
    const std::vector<std::size_t> fading = given.fading;
    given = said.kind;
    given.fading = fading;
  }
  nextLine += 1 + static_cast<int>(std::count(statements.begin(), statements.end(), '\n'));
}

std::pair<PartCategory, std::uint64_t> SceneState::newPartAt(const trace::SourcePlace& place,
                                                             std::size_t objects, std::size_t lights) const {
  const auto order = [](const trace::SourcePlace& p) { return std::pair(p.line, p.column); };
  std::pair<PartCategory, std::uint64_t> found{kNoPart, 0};
  std::pair<int, int> nearest{0, 0};
  const auto look = [&](const auto& things, const std::vector<std::uint64_t>& ids, std::size_t from,
                        PartCategory category) {
    for (std::size_t i = from; i < things.size(); ++i) {
      if (order(things[i].place) > order(place) || order(things[i].place) < nearest) continue;
      nearest = order(things[i].place);
      found = {category, ids[i]};
    }
  };
  look(scene.objects, objectIds, objects, kObject);
  look(scene.lights, lightIds, lights, kLight);
  return found;
}

void SceneState::warn(PartCategory category, std::uint64_t id, std::span<const trace::Message> messages,
                      std::string_view around, int line) {
  for (const trace::Message& message : messages)
    partWarnings.push_back({category, id, message, fieldsAround(around, message.place, line)});
}

void SceneState::dropWarnings(PartCategory category, std::uint64_t id, const Fields& fields) {
  const auto isSet = [&](const PartWarning& warning) {
    return fields.empty() || std::any_of(fields.begin(), fields.end(), [&](const Field& field) {
             return std::find(warning.fields.begin(), warning.fields.end(), field.name) !=
                    warning.fields.end();
           });
  };
  std::erase_if(partWarnings, [&](const PartWarning& warning) {
    return warning.category == category && warning.id == id && isSet(warning);
  });
}

void SceneState::loadTextures() {
  trace::Messages reported;  // by allWarnings()
  if (!trace::loadTextures(scene, reported)) lacksTextures = true;
}

std::vector<trace::Message> SceneState::allWarnings() const {
  const trace::ReadScope scope = readScope();
  std::vector<trace::Message> all = warnings;
  const bool any = !warnings.empty() || !partWarnings.empty();
  if (any && text && scene.format == "ray" && !(scene == *text->scene)) {  // its edited text says what holds
    try {
      trace::Messages ofWriting, ofReading;
      const std::string bytes = writeEdited(*text, scene, text->file, ofWriting).files.front().bytes;
      readScene(text->file, bytes, ofReading, time);
      all = ofReading.all();
    } catch (const trace::Error&) {  // it cannot be written
    }
  } else {
    for (const PartWarning& warning : partWarnings) {
      const auto known = [&](const std::vector<std::uint64_t>& ids) {
        return std::find(ids.begin(), ids.end(), warning.id) != ids.end();
      };
      if ((warning.category != kObject || known(objectIds)) &&
          (warning.category != kLight || known(lightIds)))
        all.push_back(warning.message);
    }
  }
  std::erase_if(all, trace::isOfUnreadTextures);
  if (lacksTextures) {
    trace::Messages ofTextures;
    trace::Scene again = scene;
    lookAgainForTextures(again, ofTextures);
    all.insert(all.end(), ofTextures.all().begin(), ofTextures.all().end());
  }
  return all;
}

trace::Scene SceneState::completed() const {
  trace::Scene whole = scene;
  if (isBuilt) addKindDefaults(whole, given, trace::SourcePlace{.file = whole.file});
  return whole;
}

trace::SceneAt SceneState::sceneAt() const {
  if (!changesWithTime) return nullptr;
  return [text = text, edited = scene](trace::Real seconds) {
    trace::Messages known;  // reported when the scene was read
    if (edited == *text->scene) return readScene(text->file, *text->bytes, known, seconds);
    const std::string bytes = writeEdited(*text, edited, text->file, known).files.front().bytes;
    return readScene(text->file, bytes, known, seconds);
  };
}

std::shared_ptr<SceneState> read(const std::string& file, std::string bytes, const Options& options) {
  auto state = std::make_shared<SceneState>();
  state->choices = choicesOf(options);
  trace::Messages messages;
  trace::SceneAtMoment read = readSceneAtItsMoment(file, bytes, state->choices, messages);
  state->text = std::make_shared<const trace::SceneText>(
      trace::SceneText{.file = file,
                       .bytes = std::make_shared<const std::string>(std::move(bytes)),
                       .time = read.time,
                       .scene = std::make_shared<const trace::Scene>(read.scene)});
  state->scene = std::move(read.scene);
  completeBareMesh(state->scene);
  state->time = read.time;
  state->changesWithTime = read.changesWithTime;
  state->warnings = messages.all();
  state->lacksTextures =
      std::any_of(state->warnings.begin(), state->warnings.end(), trace::isOfUnreadTextures);
  state->nameNew();
  return state;
}

std::vector<trace::Choice> choicesOf(const Options& options) {
  std::vector<trace::Choice> choices;
  for (const Field& option : options) {
    trace::Settings tried;
    const std::string text = optionText(option.value);
    trace::findOption(option.name).assign(tried, text);
    choose(choices, {option.name, text, {}});
  }
  return choices;
}

void choose(std::vector<trace::Choice>& choices, trace::Choice choice) {
  std::erase_if(choices, [&](const trace::Choice& earlier) { return earlier.option == choice.option; });
  choices.push_back(std::move(choice));
}

namespace {

/// The choices, and of earlier ones those that a quality among them would override: a program that gives an
/// option means it.
std::vector<trace::Choice> withEarlier(std::vector<trace::Choice> choices,
                                       std::span<const trace::Choice> earlier) {
  const auto named = [&](std::string_view option) {
    return std::find_if(choices.begin(), choices.end(),
                        [&](const trace::Choice& choice) { return choice.option == option; });
  };
  const auto found = named("quality");
  if (found == choices.end()) return choices;
  const std::string quality = found->value;
  for (const trace::Choice& choice : earlier)
    if (trace::setsOption(quality, choice.option) && named(choice.option) == choices.end())
      choices.push_back(choice);
  return choices;
}

}  // namespace

Opened opened(const SceneState& state, const std::vector<trace::Choice>& choices) {
  const trace::ReadScope scope = state.readScope();
  Opened opened{state.completed(), {}, state.sceneAt()};
  std::vector<trace::Choice> ofProgram;
  if (state.isBuilt) ofProgram = state.scene.choices;
  const std::vector<trace::Choice> chosen = withEarlier(state.choices, ofProgram);
  for (const trace::Choice& choice : state.choices) choose(ofProgram, choice);
  const std::vector<trace::Choice> given = withEarlier(choices, ofProgram);
  const auto settle = [&] {
    opened.settings = settingsFor(opened.scene, {opened.scene.choices, chosen, given});
  };
  settle();
  if (opened.sceneAt && opened.settings.time != state.time) {
    opened.scene = opened.sceneAt(opened.settings.time);
    settle();
  }
  if (state.lacksTextures) {
    trace::Messages reported;  // by allWarnings()
    lookAgainForTextures(opened.scene, reported);
  }
  return opened;
}

}  // namespace traceray
