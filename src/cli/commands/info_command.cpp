// ray info SCENE: what is in the scene and what a render would make of it, for people or as JSON.
//
// Keys of the JSON object: file, format, objects.NAME, triangles, instances.NAME, lights.NAME, materials,
// bounds.{low, high} (null when empty), camera.{position, viewdir, updir, fov, aspectratio}, picture.{width,
// height}, conventions[] and changed[] of {name, value, from}, unrendered[] of {kind, place}, warnings[].
#include <array>
#include <cstdio>

#include "app/session/json.h"
#include "app/session/session.h"
#include "base/printable.h"
#include "base/text.h"
#include "cli/commands/commands.h"
#include "cli/text/scene_facts.h"
#include "scene/conventions.h"
#include "scene/groups.h"

namespace trace::cli {
namespace {

struct Facts {
  const Session& session;
  Box3 bounds;
  std::vector<OptionFact> conventions, changed;
  Messages messages;
};

std::string line(std::string_view name, const std::string& value) {
  std::string text = "  " + std::string(name);
  text.resize(std::max<size_t>(text.size() + 1, 20), ' ');
  return text + value + "\n";
}

std::string vectorText(const Vec3& v) { return toText(v.x) + " " + toText(v.y) + " " + toText(v.z); }

/// Sizes of things are for the eye: six digits.
std::string shortText(const Vec3& v) {
  char text[100];
  std::snprintf(text, sizeof text, "%.6g %.6g %.6g", v.x, v.y, v.z);
  return text;
}

std::string countsText(const Counts& counts, const std::string& title, std::size_t all) {
  std::string text = title + " (" + std::to_string(all) + ")\n";
  for (const auto& [name, n] : counts) text += line(name, std::to_string(n));
  return text;
}

std::string chosenOptionsText(const std::vector<OptionFact>& facts) {
  std::string text;
  for (const OptionFact& fact : facts) {
    std::string value = fact.value;
    value.resize(std::max<size_t>(value.size() + 2, 16), ' ');
    text += line(fact.name, value + fact.from);
  }
  return text;
}

std::string infoText(const Facts& facts) {
  const Scene& scene = facts.session.scene();
  const Camera& camera = scene.camera;
  std::string text = printable(scene.file) + " (" + scene.format + ")\n";
  text += countsText(countShapes(scene), "objects", scene.objects.size());
  if (const std::size_t n = countTriangles(scene); n > 0) text += line("triangles", std::to_string(n));
  if (!scene.uses.empty()) {
    text += "instances (" + std::to_string(countUses(scene.uses)) + ")\n";
    for (const auto& [name, n] : countInstances(scene)) text += line(name, std::to_string(n));
    text += line("objects in them", std::to_string(countPlacedObjects(scene)));
  }
  text += countsText(countLights(scene), "lights", scene.lights.size());
  text += "materials (" + std::to_string(scene.materials.size()) + ")\n";
  text += "bounds\n";
  if (facts.bounds.empty())
    text += line("none", scene.objects.empty() ? "" : "nothing has an end");
  else
    text += line("low", shortText(facts.bounds.low)) + line("high", shortText(facts.bounds.high)) +
            line("size", shortText(facts.bounds.size()));
  text += "camera\n" + line("position", vectorText(camera.position)) +
          line("viewdir", vectorText(camera.viewdir)) + line("updir", vectorText(camera.updir)) +
          line("fov", toText(camera.fov) + " degrees, vertical") +
          line("aspectratio", toText(camera.aspectratio));
  const Size size = finished(facts.session.size(), facts.session.settings());
  text += line("picture", std::to_string(size.width) + " x " + std::to_string(size.height) + " pixels");
  text += "conventions: " + std::string(convention(facts.session.settings().like).help) + "\n" +
          chosenOptionsText(facts.conventions);
  text +=
      "options changed (" + std::to_string(facts.changed.size()) + ")\n" + chosenOptionsText(facts.changed);
  if (const std::string chosen = chosenText(scene, facts.session.settings(), 0); !chosen.empty())
    text += "left to Trace\n  " + chosen + "\n";
  if (!scene.unrendered.empty()) {
    text += "not rendered yet (" + std::to_string(scene.unrendered.size()) + ")\n";
    for (const Unrendered& left : scene.unrendered) text += line(left.kind, placeText(left.place));
  }
  text += "warnings (" + std::to_string(facts.messages.all().size()) + ")\n";
  for (const Message& message : facts.messages.all()) text += toString(message);
  return text;
}

std::string infoJson(const Facts& facts) {
  const auto vector = [](const Vec3& v) { return Json::list({v.x, v.y, v.z}); };
  const auto counts = [](const Counts& all) {
    Json json = Json::object();
    for (const auto& [name, n] : all) json[name] = n;
    return json;
  };
  const auto optionList = [](const std::vector<OptionFact>& all) {
    Json json = Json::list();
    for (const OptionFact& fact : all)
      json.add({{"name", fact.name}, {"value", fact.value}, {"from", fact.from}});
    return json;
  };
  const Scene& scene = facts.session.scene();
  const Camera& camera = scene.camera;
  const Size size = finished(facts.session.size(), facts.session.settings());
  Json json;
  json["file"] = scene.file;
  json["format"] = scene.format;
  json["objects"] = counts(countShapes(scene));
  json["triangles"] = countTriangles(scene);
  json["instances"] = counts(countInstances(scene));
  json["lights"] = counts(countLights(scene));
  json["materials"] = scene.materials.size();
  json["bounds"] = nullptr;
  if (!facts.bounds.empty())
    json["bounds"] = {{"low", vector(facts.bounds.low)}, {"high", vector(facts.bounds.high)}};
  json["camera"] = {{"position", vector(camera.position)},
                    {"viewdir", vector(camera.viewdir)},
                    {"updir", vector(camera.updir)},
                    {"fov", camera.fov},
                    {"aspectratio", camera.aspectratio}};
  json["picture"] = {{"width", size.width}, {"height", size.height}};
  json["conventions"] = optionList(facts.conventions);
  json["changed"] = optionList(facts.changed);
  if (const std::string chosen = chosenText(scene, facts.session.settings(), 0); !chosen.empty())
    json["left_to_trace"] = chosen;
  json["unrendered"] = Json::list();
  for (const Unrendered& left : scene.unrendered)
    json["unrendered"].add({{"kind", left.kind}, {"place", placeText(left.place)}});
  json["warnings"] = Json::list();
  for (const Message& message : facts.messages.all()) json["warnings"].add(toString(message));
  return json.text(2) + "\n";
}

}  // namespace

int infoCommand(const Arguments& arguments, const Console& console) {
  if (arguments.files.size() != 1)
    throw Error(Fault::usage,
                "ray info: expected the name of one scene file, found " +
                    (arguments.files.empty() ? "none" : std::to_string(arguments.files.size())));
  const bool json = chosenFormat(arguments, "info", kTextOrJson) == "json";
  Session session;
  session.open(arguments.files[0], arguments.choices, arguments.strict);
  // Not Session::build(): looking at a scene needs no memory for a picture.
  Facts facts{session, {}, {}, {}, session.messages()};
  facts.bounds = compile(session.scene(), session.settings(), facts.messages).bounds();
  facts.messages.throwIfFailed(arguments.strict);
  facts.conventions = optionsOf("Conventions", session.scene(), session.settings(), arguments.choices);
  facts.changed = changedOptions(session.scene(), session.settings(), arguments.choices);
  console.line(LogLevel::debug, "read " + session.scene().file + " as " + session.scene().format);
  printResult(json ? infoJson(facts) : infoText(facts));
  return kDone;
}

}  // namespace trace::cli
