// ray materials: the library of materials, as a list, or as balls in a picture.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "app/session/denoising.h"
#include "app/session/output.h"
#include "app/session/remaining_time.h"
#include "app/session/session.h"
#include "base/budget.h"
#include "base/files/file.h"
#include "base/text.h"
#include "cli/commands/commands.h"
#include "formats/ray/file/format.h"
#include "image/codecs/codec.h"
#include "render/picture/passes.h"
#include "scene/quality.h"
#include "shading/library.h"
#include "shading/optics/substances.h"

namespace trace::cli {
namespace {

struct Entry {
  std::string name, group, looks;
};

/// Opaque materials first, by group, then the transparent substances.
std::vector<Entry> entries() {
  std::vector<Entry> all;
  for (const Finish& finish : finishes())
    all.push_back({std::string(finish.name), std::string(finish.group), std::string(finish.looks)});
  for (const std::string_view name : libraryNames()) {
    if (std::any_of(all.begin(), all.end(), [&](const Entry& e) { return e.name == name; })) continue;
    Entry entry{std::string(name), "translucent", "light spreads in it"};
    for (const Substance& substance : substances())
      if (substance.name == name)
        entry = {entry.name, std::string(substance.group), "clear, index " + toText(substance.index)};
    all.push_back(std::move(entry));
  }
  return all;
}

std::string rowText(const Entry& entry) {
  std::string text = "  " + entry.name;
  text.resize(std::max<std::size_t>(text.size() + 2, 28), ' ');
  return text + entry.looks + "\n";
}

std::string listText(const std::vector<Entry>& all) {
  std::string text =
      "materials: material = { library = \"NAME\" } takes one; ray materials NAME -o ball.png shows it\n";
  std::string_view group;
  for (const Entry& entry : all) {
    if (entry.group != group) text += entry.group + "\n";
    group = entry.group;
    text += rowText(entry);
  }
  return text;
}

const Entry& entryOf(const std::vector<Entry>& all, const std::string& name) {
  for (const Entry& entry : all)
    if (entry.name == name) return entry;
  throw Error(Fault::usage, "ray materials: the library has no \"" + name + "\"", nearInLibrary(name));
}

/// Balls in rows, each of one material, on a floor in a bright room.
std::string sheetText(const std::vector<Entry>& shown, double aspect) {
  const auto count = static_cast<double>(shown.size());
  const double columns = std::min(count, std::ceil(std::sqrt(count * 1.6))),
               rows = std::ceil(count / columns);
  constexpr double kStep = 2.4;
  std::string text = "Trace 1\n";
  const double width = columns * kStep, depth = rows * kStep,
               far = std::max(depth, (width + 1) / aspect) * 1.1;
  if (shown.size() == 1)
    text += "camera { position = (0, 2.2, 6.5); look_at = (0, 0.95, 0); fov = 24; aspectratio = " +
            toText(aspect) + " }\n";
  else
    text += "camera { look_at = (0, 0, 0); position = (0, " + toText(far * 2.2) + ", " + toText(far * 1.5) +
            "); fov = 22; aspectratio = " + toText(aspect) + " }\n";
  text +=
      "plane { material = { model = lambert; diffuse = texture(checker { a = (0.5, 0.5, 0.5); b = (0.3, 0.3, "
      "0.3); scale = (0.6, 0.6, 0.6) }) } }\n";
  text +=
      "background { gradient = ((0.3, 0.3, 0.3), (0.5, 0.5, 0.5), (0.8, 0.8, 0.8), (1.5, 1.5, 1.5)); "
      "elevations = (-90, -4, 8, 90) }\n"
      "directional_light { direction = (0.5, -1, -0.6); color = (1.2, 1.15, 1.05); size = 4 }\n";
  std::size_t number = 0;
  for (const Entry& entry : shown) {
    const double column = std::fmod(static_cast<double>(number), columns),
                 row = std::floor(static_cast<double>(number) / columns);
    text += "translate(" + toText((column - (columns - 1) / 2) * kStep) + ", 1, " +
            toText((row - (rows - 1) / 2) * kStep) + ") { sphere { material = { library = \"" + entry.name +
            "\" } } }\n";
    ++number;
  }
  return text;
}

void writeSheet(const std::vector<Entry>& shown, const Arguments& arguments, const Console& console) {
  const auto start = std::chrono::steady_clock::now();
  const auto [width, height] =
      arguments.size.value_or(shown.size() == 1 ? std::array{256, 256} : std::array{960, 600});
  checkEncodable(pictureFormatFor(arguments.output), width, height);
  checkWritable(arguments.output);
  const double aspect = static_cast<double>(width) / height;
  const Work work("rendering the materials");
  Messages messages;
  Scene scene = readRay("materials.ray", sheetText(shown, aspect), messages);
  const std::vector<Choice> choices{{"quality", shown.size() == 1 ? "good" : "draft", {}},
                                    {"width", std::to_string(width), {}},
                                    {"height", std::to_string(height), {}}};
  const Settings settings = settingsFor(scene, {scene.choices, choices});
  Session session;
  session.open(std::move(scene), settings);
  session.build();
  if (session.renderPicture().end != End::finished) lookAtBudget();
  session.save(arguments.output);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  console.last(true, "wrote " + arguments.output + " (" + counted(shown.size(), "material") + ") in " +
                         durationText(elapsed.count()));
}

}  // namespace

int materialsCommand(const Arguments& arguments, const Console& console) {
  if (arguments.files.size() > 1)
    throw Error(Fault::usage,
                "ray materials: expected one name, found " + std::to_string(arguments.files.size()),
                "a name of several words stands in quotation marks");
  std::vector<Entry> shown = entries();
  if (!arguments.files.empty()) shown = {entryOf(shown, arguments.files[0])};
  if (arguments.output.empty())
    printResult(arguments.files.empty()
                    ? listText(shown)
                    : shown.front().name + ": " + shown.front().group + ", " + shown.front().looks + "\n");
  else
    writeSheet(shown, arguments, console);
  return kDone;
}

}  // namespace trace::cli
