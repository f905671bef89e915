#include "library/scene_state.h"

#include <algorithm>

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

void SceneState::nameNew() {
  nameNewOf(scene.objects, objectIds, nextId);
  nameNewOf(scene.lights, lightIds, nextId);
}

void SceneState::add(std::string_view statements) {
  const std::size_t objects = scene.objects.size(), lights = scene.lights.size(),
                    materials = scene.materials.size(), chosen = scene.choices.size(),
                    unrendered = scene.unrendered.size(), unused = scene.unusedMaterials.size();
  const trace::Camera camera = scene.camera;
  const trace::Background background = scene.background;
  // A reader of the kind `Trace 1` counts its first line.
  const int lines = nextLine - 2;
  const std::string file = folder() + kBuilt;
  const auto moved = [&](trace::Place place) {
    if (place.file == file && place.line > 0) place.line += lines;
    return place;
  };
  trace::Messages messages;
  trace::rayfile::PartGiven said;
  try {
    said = trace::rayfile::readPart(file, statements, scene, messages);
    for (std::size_t i = materials; i < scene.materials.size(); ++i)
      trace::completeMaterial(scene.materials[i]);
    loadTextures(scene, messages);
    messages.throwIfFailed();
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
  for (trace::Message message : messages.all()) {
    message.place = moved(message.place);
    warnings.push_back(std::move(message));
  }
  given.fading.insert(given.fading.end(), said.kind.fading.begin(), said.kind.fading.end());
  if (said.camera) {
    const std::vector<std::size_t> fading = given.fading;
    given = said.kind;
    given.fading = fading;
  }
  nextLine += 1 + static_cast<int>(std::count(statements.begin(), statements.end(), '\n'));
  nameNew();
}

trace::Scene SceneState::completed() const {
  trace::Scene whole = scene;
  if (isBuilt) addKindDefaults(whole, given, trace::Place{.file = whole.file});
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

Opened opened(const SceneState& state, const std::vector<trace::Choice>& choices) {
  Opened opened{state.completed(), {}, state.sceneAt()};
  const auto settle = [&] {
    opened.settings = settingsFor(opened.scene, {opened.scene.choices, state.choices, choices});
  };
  settle();
  if (opened.sceneAt && opened.settings.time != state.time) {
    opened.scene = opened.sceneAt(opened.settings.time);
    settle();
  }
  return opened;
}

}  // namespace traceray
