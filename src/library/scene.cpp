#include <algorithm>
#include <filesystem>

#include "app/advice/auto_exposure.h"
#include "app/lint/lint.h"
#include "app/session/output.h"
#include "app/session/render_warnings.h"
#include "base/files/file.h"
#include "base/text.h"
#include "library/guard.h"
#include "library/part_state.h"
#include "library/scene_state.h"
#include "scene/groups.h"

namespace traceray {
namespace {

template <class Things, class NameOf>
std::size_t findNamed(const char* what, std::string_view name, const Things& things, const NameOf& nameOf) {
  std::vector<std::string_view> names;
  for (std::size_t i = 0; i < things.size(); ++i) {
    const std::string& known = nameOf(things[i]);
    if (known == name) return i;
    if (!known.empty()) names.push_back(known);
  }
  throw Error(Error::Kind::usage,
              std::string("the scene has no ") + what + " called \"" + std::string(name) + "\"",
              trace::didYouMean(name, names));
}

}  // namespace

Scene::Scene() : state_(std::make_shared<SceneState>()) {
  state_->isBuilt = true;
  state_->scene.format = "ray";
}
Scene::Scene(std::shared_ptr<SceneState> state) : state_(std::move(state)) {}
Scene::Scene(const Scene& other) : state_(std::make_shared<SceneState>(*other.state_)) {}
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(const Scene& other) {
  state_ = std::make_shared<SceneState>(*other.state_);
  return *this;
}
Scene& Scene::operator=(Scene&&) noexcept = default;
Scene::~Scene() = default;

Scene Scene::open(const std::string& file, const Options& options) {
  return guarded([&] { return Scene(read(file, trace::readFile(file), options)); });
}

Scene Scene::fromText(std::string_view text, const std::string& file, const Options& options) {
  return guarded([&] { return Scene(read(file, std::string(text), options)); });
}

std::vector<Problem> Scene::warnings() const {
  return guarded([&] { return problemsOf(state_->allWarnings()); });
}

Part Scene::part(int category, std::uint64_t id) {
  return Part(std::make_shared<PartState>(PartState{state_, static_cast<PartState::Category>(category), id}));
}

Part Scene::add(const Node& node) {
  return guarded([&] {
    const std::size_t objects = state_->scene.objects.size(), lights = state_->scene.lights.size(),
                      warnings = state_->partWarnings.size();
    state_->add(node.inLanguage());
    if (state_->scene.objects.size() > objects) return part(kObject, state_->objectIds[objects]);
    if (state_->scene.lights.size() > lights) return part(kLight, state_->lightIds[lights]);
    if (node.keyword == trace::Camera::kKeyword) return camera();
    if (node.keyword == trace::Background::kKeyword) return background();
    if (node.keyword == "settings") return camera();
    const std::vector<PartWarning> why(state_->partWarnings.begin() + static_cast<std::ptrdiff_t>(warnings),
                                       state_->partWarnings.end());
    state_->partWarnings.resize(warnings);
    throw Error(Error::Kind::scene, node.keyword + ": nothing of it is seen",
                why.empty() ? "" : why.back().message.what);
  });
}

void Scene::addText(std::string_view statements) {
  guarded([&] { state_->add(statements); });
}

std::vector<Part> Scene::objects() {
  std::vector<Part> parts;
  for (const std::uint64_t id : state_->objectIds) parts.push_back(part(kObject, id));
  return parts;
}

std::vector<Part> Scene::lights() {
  std::vector<Part> parts;
  for (const std::uint64_t id : state_->lightIds) parts.push_back(part(kLight, id));
  return parts;
}

std::vector<Part> Scene::materials() {
  std::vector<Part> parts;
  for (std::size_t i = 0; i < state_->scene.materials.size(); ++i) parts.push_back(part(kMaterial, i));
  return parts;
}

Part Scene::camera() { return part(kCamera, 0); }
Part Scene::background() { return part(kBackground, 0); }

Part Scene::object(std::string_view name) {
  const std::size_t at = findNamed("object", name, state_->scene.objects,
                                   [](const trace::Object& o) -> const std::string& { return o.name; });
  return part(kObject, state_->objectIds[at]);
}

Part Scene::light(std::string_view name) {
  const std::size_t at =
      findNamed("light", name, state_->scene.lights,
                [](const trace::LightSource& l) -> const std::string& { return l.links.name; });
  return part(kLight, state_->lightIds[at]);
}

Part Scene::material(std::string_view name) {
  return part(kMaterial, findNamed("material", name, state_->scene.materials,
                                   [](const trace::Material& m) -> const std::string& { return m.name; }));
}

void Scene::choose(const std::string& option, const Value& value) {
  guarded([&] { traceray::choose(state_->choices, choicesOf({{option, value}}).front()); });
}

std::string Scene::chosen(const std::string& option, const Options& options) const {
  return guarded([&] { return trace::findOption(option).get(opened(*state_, choicesOf(options)).settings); });
}

std::vector<Problem> Scene::lint(const Options& options) const {
  return guarded([&] {
    const trace::ReadScope scope = state_->readScope();
    Opened of = opened(*state_, choicesOf(options));
    trace::Messages messages;
    for (const trace::Message& message : state_->allWarnings())
      messages.warn(message.place, message.what, message.hint);
    readSurroundings(of.scene, of.settings, {.memory = trace::allowedMemory(of.settings)}, messages);
    const trace::World world = compile(of.scene, of.settings, messages);
    warnOfSettings(of.scene, of.settings, world, messages);
    const std::optional<trace::Real> exposure = settleExposure(world, of.settings);
    std::vector<Problem> problems;
    for (const trace::LintFinding& finding :
         trace::lint(of.scene, of.settings, world, messages.all(), exposure)) {
      problems.push_back(problemOf(finding.message));
      problems.back().check = finding.check;
    }
    return problems;
  });
}

std::vector<Problem> Scene::save(const std::string& file) const {
  return guarded([&] {
    const SceneState& state = *state_;
    const trace::SceneFormat& format = trace::writableFormatFor(file);
    const bool isOwn = state.text && trace::sameFile(file, state.text->file);
    trace::Messages messages;
    trace::Scene scene = state.completed();
    for (const trace::Choice& choice : state.choices) traceray::choose(scene.choices, choice);
    trace::Rewritten written;
    if (state.text && format.rewrite && format.name == state.text->scene->format)
      written = writeEdited(*state.text, scene, file, messages);
    else
      written = {format.write(format.keepsGroups
                                  ? scene
                                  : trace::copied(scene, "a file of the format " + std::string(format.name)),
                              file, {}, messages),
                 false};
    if (!isOwn) trace::checkIsNoInput(file, scene.inputs);
    if (isOwn && !written.keepsAll)
      throw Error(Error::Kind::usage,
                  "\"" + file + "\" says something that the edited scene would lose, as comments or loops",
                  "save the scene under another name");
    for (const trace::NamedBytes& one : written.files) trace::writeFile(one.file, one.bytes);
    return problemsOf(messages.all());
  });
}

}  // namespace traceray
