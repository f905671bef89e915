// The panel Controls: THE options table as widgets. Nothing here knows a single option.
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "app/editing/typed_file.h"
#include "app/editing/typed_region.h"
#include "base/text.h"
#include "scene/conventions.h"
#include "scene/integrators.h"
#include "scene/option_words.h"
#include "studio/actions.h"
#include "studio/panels.h"
#include "studio/widgets/field_editor.h"
#include "studio/widgets/landmarks.h"
#include "studio/widgets/number_field.h"

namespace trace::studio {
namespace {

/// A slider covers ranges up to this, and whole numbers are counted; wider ranges are dragged, for they have
/// no useful scale.
constexpr double kMostSlider = 10000;

std::string rangeText(const Option& option) {
  const std::string unit = option.unit.empty() ? "" : " " + std::string(option.unit);
  switch (option.kind) {
    case Option::Kind::boolean: return "on or off";
    case Option::Kind::region:
      return "x0,y0,x1,y1 in pixels from the top left; nothing for the whole picture";
    case Option::Kind::file: return "a file, typed or chosen; nothing for none";
    case Option::Kind::place: return "the name of an object, or a point x,y,z; nothing for none";
    case Option::Kind::choice:
    case Option::Kind::choices: {
      std::string text = option.kind == Option::Kind::choices ? "none or any of: " : "";
      const std::size_t begin = text.size();
      for (std::string_view choice : option.choices)
        text += (text.size() == begin ? "" : ", ") + std::string(choice);
      return text;
    }
    case Option::Kind::color:
    case Option::Kind::integer:
    case Option::Kind::real: break;
  }
  const std::string_view word = leastWordFor(option);
  if (!word.empty())
    return std::string(word) + (option.most == kNoLimit ? ", or more" : ", or up to " + toText(option.most)) +
           unit;
  if (option.most == kNoLimit) return toText(option.least) + unit + " or more";
  return toText(option.least) + " to " + toText(option.most) + unit;
}

void tooltip(const Studio& studio, const Option& option) {
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(characters(64));
  ImGui::TextColored(studio.palette().accent, "--%s", option.name.data());
  ImGui::TextUnformatted(option.help.data(), option.help.data() + option.help.size());
  ImGui::TextDisabled("%s", rangeText(option).c_str());
  if (!(option.integrators == everyIntegrator()))
    ImGui::TextDisabled("concerns %s", namesOfIntegrators(option.integrators).c_str());
  if (!option.source.empty()) ImGui::TextDisabled("source: %s", std::string(option.source).c_str());
  ImGui::TextDisabled("chosen by: %s", studio.workspace.document.chooser(option).c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

/// The text after the number: its unit, with % doubled for printf.
std::string unitSuffix(const Option& option, double number) {
  std::string text;
  for (char c : unitAfter(option.unit, number)) text += c == '%' ? "%%" : std::string(1, c);
  return text;
}

std::optional<std::string> editInteger(const Option& option, const std::string& value) {
  int number = std::stoi(value);
  NumberLook look{option.least, option.most, "%.0f" + unitSuffix(option, number)};
  look.name = option.name;
  look.words.least = leastWordFor(option);
  look.counted = option.most <= kMostSlider;
  constexpr float kPixels = 12;  // that the mouse moves for one step
  look.speed = look.counted ? std::max(1 / kPixels, static_cast<float>(number) / 200)
                            : std::max(1.0f, static_cast<float>(number) / 200);
  if (!editNumber("##value", number, look)) return {};
  return std::to_string(number);
}

std::optional<std::string> editReal(const Option& option, const std::string& value) {
  double number = parseNumber(value)->value;
  const double range = option.most - option.least;
  NumberLook look{option.least, option.most, "%.6g" + unitSuffix(option, number)};
  look.name = option.name;
  look.words.least = leastWordFor(option);
  if (range <= kMostSlider)
    look.logarithmic = range > 10;
  else
    look.speed = static_cast<float>(std::max(0.01, std::abs(number) / 100));
  if (!editNumber("##value", number, look)) return {};
  return toText(number);
}

std::optional<std::string> editChoiceOf(const Option& option, const std::string& value) {
  std::optional<std::string> chosen;
  if (!ImGui::BeginCombo("##value", value.c_str())) return {};
  for (std::string_view choice : option.choices)
    if (ImGui::Selectable(std::string(choice).c_str(), choice == value)) chosen = choice;
  ImGui::EndCombo();
  return chosen;
}

/// Check boxes; the list stays open.
std::optional<std::string> editChoices(const Option& option, const std::string& value) {
  const float room = ImGui::CalcItemWidth() - ImGui::GetFrameHeight() - 2 * ImGui::GetStyle().FramePadding.x;
  if (!ImGui::BeginCombo("##value", shortened(value, room).c_str())) return {};
  const std::string among = "," + value + ",";
  std::string chosen;
  bool changed = false;
  for (std::string_view choice : option.choices) {
    bool on = among.find("," + std::string(choice) + ",") != std::string::npos;
    changed = ImGui::Checkbox(std::string(choice).c_str(), &on) || changed;
    if (on) chosen += (chosen.empty() ? "" : ",") + std::string(choice);
  }
  ImGui::EndCombo();
  if (!changed) return {};
  return chosen.empty() ? "none" : chosen;
}

std::optional<std::string> editRegion(const std::string& value) {
  std::string text = shownRegion(value);
  if (!editText("##value", text, "all")) return {};
  return typedRegion(text);
}

/// A square that opens a picker, and the numbers as text.
std::optional<std::string> editColor(const Option& option, const std::string& value) {
  std::optional<Color> color = colorOf(value);
  const float square = ImGui::GetFrameHeight(), gap = ImGui::GetStyle().ItemInnerSpacing.x;
  const float width = ImGui::CalcItemWidth() - square - gap;
  const bool picked = editSwatch(*color);
  ImGui::SameLine(0, gap);
  ImGui::SetNextItemWidth(width);
  std::string text = value;
  const bool typed = editText("##value", text, "red,green,blue");
  if (typed) color = colorOf(text);
  if (!color || !(picked || typed)) return {};
  const auto within = [&](double x) {
    if (picked) x = std::round(x * 1000) / 1000;
    return std::clamp(x, option.least, option.most);
  };
  return colorText({within(color->r), within(color->g), within(color->b)});
}

std::optional<std::string> editPlace(const std::string& value) {
  std::string text = value == "none" ? "" : value;
  if (!editText("##value", text, "an object, or x,y,z")) return {};
  return text.empty() ? "none" : text;
}

/// The name, to be typed, and a button that opens the dialog.
std::optional<std::string> editFile(Studio& studio, const Option& option, const std::string& value) {
  const float button = ImGui::GetFrameHeight(), gap = ImGui::GetStyle().ItemInnerSpacing.x;
  ImGui::SetNextItemWidth(ImGui::CalcItemWidth() - button - gap);
  const std::string& scene = studio.workspace.document.file();
  std::string text = shownFile(value, scene);
  const bool typed = editText("##value", text, "no file");
  landmark("type " + std::string(option.name));
  ImGui::SameLine(0, gap);
  if (ImGui::Button("...", {button, 0})) chooseFile(studio, option);
  landmark("choose " + std::string(option.name));
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("choose a file");
  if (!typed) return {};
  try {
    return typedFile(text, std::string(option.name), scene);
  } catch (const Error& error) {
    studio.workspace.report(error.messages());
    studio.mention("Log");
    return {};
  }
}

std::optional<std::string> edit(Studio& studio, const Option& option, const std::string& value) {
  switch (option.kind) {
    case Option::Kind::boolean: {
      bool on = value == "on";
      if (!ImGui::Checkbox("##value", &on)) return {};
      return on ? "on" : "off";
    }
    case Option::Kind::integer: return editInteger(option, value);
    case Option::Kind::real: return editReal(option, value);
    case Option::Kind::choice: return editChoiceOf(option, value);
    case Option::Kind::choices: return editChoices(option, value);
    case Option::Kind::color: return editColor(option, value);
    case Option::Kind::region: return editRegion(value);
    case Option::Kind::file: return editFile(studio, option, value);
    case Option::Kind::place: return editPlace(value);
  }
  return {};
}

/// One step for each time that the widget is held.
void choose(Studio& studio, const Option& option, const std::string& value, unsigned id) {
  const bool continues = studio.editedItem == id;
  studio.editedItem = id;
  try {
    studio.workspace.choose(std::string(option.name), value, continues);
  } catch (const Error& error) {
    studio.workspace.report(error.messages());
    studio.mention("Log");
  }
}

void row(Studio& studio, const Option& option, const Settings& defaults, const Settings& now) {
  const Document& document = studio.workspace.document;
  const std::string name(option.name), value = option.get(now);
  const bool changed = value != option.get(defaults), here = document.chosenHere(name);
  ImGui::PushID(name.c_str());
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::AlignTextToFramePadding();
  if (changed) ImGui::PushStyleColor(ImGuiCol_Text, studio.palette().changed);
  rowName(name);
  if (changed) ImGui::PopStyleColor();
  if (ImGui::IsItemHovered()) besidePanel(), tooltip(studio, option);
  ImGui::TableNextColumn();
  const float resetWidth = ImGui::GetFrameHeight();
  ImGui::SetNextItemWidth(-resetWidth - ImGui::GetStyle().ItemInnerSpacing.x);
  const std::optional<std::string> given = edit(studio, option, value);
  landmark("option " + name);
  if (ImGui::IsItemHovered() && !ImGui::IsItemActive()) besidePanel(), tooltip(studio, option);
  const unsigned id = ImGui::GetID("edit");
  bool reset = false;
  if (here) {
    ImGui::SameLine(0, 0);  // at the right edge, after whatever is as wide as it likes
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x - resetWidth);
    reset = ImGui::Button("x", {resetWidth, 0});
    landmark("reset " + name);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("back to the value of the file and the command line");
  }
  ImGui::PopID();
  if (reset) return studio.workspace.reset(name);
  if (given && *given != value) choose(studio, option, *given, id);
}

bool beginOptions(const std::string& name) {
  if (!ImGui::BeginTable(name.c_str(), 2, ImGuiTableFlags_SizingStretchProp)) return false;
  ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch, 0.48f);
  ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch, 0.52f);
  return true;
}

/// Group by group.
void drawGroups(Studio& studio, const std::vector<const Option*>& all, const Settings& defaults,
                const Settings& now) {
  std::string_view group;
  bool table = false;
  for (const Option* option : all) {
    if (option->group != group) {
      if (table) ImGui::EndTable();
      group = option->group;
      const std::string name(group);
      table = ImGui::CollapsingHeader(name.c_str(), ImGuiTreeNodeFlags_DefaultOpen) && beginOptions(name);
    }
    if (table) row(studio, *option, defaults, now);
  }
  if (table) ImGui::EndTable();
}

/// The options that a search found, the best first.
void drawFound(Studio& studio, std::vector<const Option*> found, std::string_view words,
               const Settings& defaults, const Settings& now) {
  std::stable_sort(found.begin(), found.end(), [&](const Option* a, const Option* b) {
    return relevance(*a, words) > relevance(*b, words);
  });
  if (found.empty() || !beginOptions("found")) return;
  for (const Option* option : found) row(studio, *option, defaults, now);
  ImGui::EndTable();
}

}  // namespace

void drawFrequentOptions(Studio& studio) {
  constexpr std::string_view kFrequent[] = {"width", "spp", "depth", "integrator", "light-samples"};
  const Settings now = studio.workspace.chosenSettings();
  const float wide = characters(11.5f), gap = ImGui::GetStyle().ItemInnerSpacing.x;
  const auto beside = [](float width) {
    if (ImGui::GetContentRegionAvail().x < width) ImGui::NewLine();
  };
  for (const std::string_view name : kFrequent) {
    const Option& option = findOption(name);
    const std::string value = option.get(now);
    ImGui::PushID(name.data());
    beside(wide + gap + ImGui::CalcTextSize(name.data()).x);
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("%s", name.data());
    if (ImGui::IsItemHovered()) tooltip(studio, option);
    ImGui::SameLine(0, gap);
    ImGui::SetNextItemWidth(wide);
    const std::optional<std::string> given = edit(studio, option, value);
    landmark("frequent " + std::string(name));
    if (ImGui::IsItemHovered() && !ImGui::IsItemActive()) tooltip(studio, option);
    const unsigned id = ImGui::GetID("edit");
    ImGui::PopID();
    if (given && *given != value) choose(studio, option, *given, id);
    ImGui::SameLine();
  }
  const char* all = "All options...";
  beside(ImGui::CalcTextSize(all).x + 2 * ImGui::GetStyle().FramePadding.x);
  if (ImGui::Button(all)) studio.show("Controls");
  landmark("all options");
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("the panel Controls (Alt+2)");
}

void drawControls(Studio& studio) {
  if (!studio.workspace.document.isOpen()) return ImGui::TextDisabled("no scene is open");
  static char filter[64] = "";
  static bool onlyChanged = false;
  const float box = ImGui::GetFrameHeight() + ImGui::CalcTextSize("changed").x +
                    ImGui::GetStyle().ItemInnerSpacing.x + ImGui::GetStyle().ItemSpacing.x;
  ImGui::SetNextItemWidth(-box);
  ImGui::InputTextWithHint("##filter", "find an option", filter, sizeof filter);
  landmark("find an option");
  ImGui::SameLine();
  ImGui::Checkbox("changed", &onlyChanged);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("only options that differ from their defaults");

  const Settings defaults, now = studio.workspace.chosenSettings();
  const auto wanted = [&](const Option& option) {
    const bool changed = option.get(now) != option.get(defaults);
    return isAbout(option, filter) && (changed || !onlyChanged);
  };
  ImGui::BeginChild("options", {0, 0}, false, ImGuiWindowFlags_NavFlattened);
  const std::string_view words = filter, cameraField = cameraFieldMeant(words);
  const bool asksWhy = words == "black" || words == "dark" || words == "why";
  const bool hinted = asksWhy || !cameraField.empty();
  if (asksWhy) {
    ImGui::PushTextWrapPos();
    ImGui::TextColored(studio.palette().changed,
                       "Click on the black pixel of the picture: the panel Rays says why, and what to try.");
    landmark("where to look");
    ImGui::PopTextWrapPos();
  }
  if (!cameraField.empty()) {
    ImGui::TextColored(studio.palette().changed, "%s: in the panel Scene, camera",
                       std::string(cameraField).c_str());
    landmark("camera field");
    if (ImGui::IsItemClicked()) {
      studio.select(Studio::Selected::camera, 0);
      studio.show("Scene");
    }
  }
  std::vector<const Option*> found;
  for (const Option& option : options())
    if (wanted(option)) found.push_back(&option);
  if (filter[0])
    drawFound(studio, found, filter, defaults, now);
  else
    drawGroups(studio, found, defaults, now);
  if (found.empty() && !hinted) {
    const std::string among = onlyChanged ? " among the options that were changed" : "";
    ImGui::PushTextWrapPos();
    if (filter[0])
      ImGui::TextDisabled("nothing found for '%s'%s", filter, among.c_str());
    else
      ImGui::TextDisabled("no option was changed");
    landmark("nothing found");
    ImGui::PopTextWrapPos();
  }
  ImGui::EndChild();
}

}  // namespace trace::studio
