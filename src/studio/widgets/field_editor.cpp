#include "studio/widgets/field_editor.h"

#include <cstdio>
#include <utility>

// For the panel that an item is in.
#include <imgui_internal.h>

#include "app/editing/edits.h"
#include "app/editing/swatches.h"
#include "studio/widgets/file_dialog.h"
#include "studio/widgets/landmarks.h"
#include "studio/widgets/number_field.h"
#include "studio/widgets/theme.h"

namespace trace::studio {
namespace {

const char* kFormat = "%.4g";

/// Drags by a hundredth of what it is; typed numbers are clamped too.
bool drag(const FieldFacts& facts, double* values, int count) {
  double largest = 0;
  for (int i = 0; i < count; ++i)
    if (std::isfinite(values[i])) largest = std::max(largest, std::abs(values[i]));
  const bool share = facts.least == 0 && facts.most == 1;
  const float speed = share ? 0.005f : static_cast<float>(std::max(0.01, largest / 100));
  const std::string format = kFormat + unitAfter(facts.unit, count == 1 ? values[0] : 0);
  const std::string name = saidName(facts.name);
  return editNumbersInRow(values, count,
                          {facts.least, facts.most, format, speed, false, true, name, {{}, facts.unlimited}});
}

/// A file that is named, and not chosen here.
bool showFile(const std::string& name) {
  ImGui::TextDisabled("%s", name.empty() ? "none" : name.c_str());
  return false;
}

struct FileChoice {
  std::optional<FileWish> wish{};
  unsigned field = 0;  ///< to which the name is given
  std::string name{};
};
FileChoice& fileChoice() {
  static FileChoice choice;  // choice of the one dialog that the window has
  return choice;
}

std::string& outerFields() {
  static std::string names;  // names of the one table that is drawn now
  return names;
}
std::string& outerNames() {
  static std::string names;  // the same, as remarks say them
  return names;
}

/// The name, to be typed, and a button that opens the dialog.
bool editFileName(const FieldFacts& facts, std::string& name, std::vector<std::string> suffixes) {
  const float button = ImGui::GetFrameHeight(), gap = ImGui::GetStyle().ItemInnerSpacing.x;
  FileChoice& choice = fileChoice();
  const unsigned id = ImGui::GetID("file");
  ImGui::SetNextItemWidth(std::max(1.0f, ImGui::GetContentRegionAvail().x - button - gap));
  bool changed = editText("##value", name, "no file");
  landmark("text");
  if (!name.empty() && ImGui::IsItemHovered() && !ImGui::IsItemActive())
    ImGui::SetTooltip("%s", name.c_str());
  ImGui::SameLine(0, gap);
  if (ImGui::Button("...", {button, 0}))
    choice.wish = {id, "Choose the " + std::string(facts.name), name, std::move(suffixes)};
  landmark("choose");
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("choose a file");
  if (choice.field != id) return changed;
  choice.field = 0;
  changed = changed || choice.name != name;
  name = std::move(choice.name);
  return changed;
}

}  // namespace

bool editValue(const FieldFacts& facts, Real& value) { return drag(facts, &value, 1); }

bool editValue(const FieldFacts& facts, int& value) {
  const std::string name = saidName(facts.name), format = "%.0f" + unitAfter(facts.unit, value);
  const float speed = static_cast<float>(std::max(0.05, std::abs(value) / 100.0));
  ImGui::SetNextItemWidth(-1);
  const bool changed = editNumber("##value", value,
                                  {std::max(facts.least, -mostWhole()), std::min(facts.most, mostWhole()),
                                   format, speed, false, true, name});
  landmark("number 0");
  return changed;
}

bool editValue(const FieldFacts&, bool& value) { return ImGui::Checkbox("##value", &value); }

bool editValue(const FieldFacts& facts, Vec3& value) {
  double numbers[3] = {value.x, value.y, value.z};
  if (!drag(facts, numbers, 3)) return false;
  value = {numbers[0], numbers[1], numbers[2]};
  return true;
}

namespace {

/// Colours to choose from below the picker; null if none was.
const Color* chosenSwatch() {
  const Color* chosen = nullptr;
  constexpr std::size_t kAcross = kSwatches.size() / 2;
  constexpr ImGuiColorEditFlags kPlain = ImGuiColorEditFlags_NoTooltip | ImGuiColorEditFlags_NoDragDrop;
  const float side = ImGui::GetFrameHeight();
  for (std::size_t i = 0; i < kSwatches.size(); ++i) {
    const auto& [name, color] = kSwatches[i];
    if (i % kAcross != 0) ImGui::SameLine(0, 2);
    if (ImGui::ColorButton(
            name.data(),
            {static_cast<float>(color.r), static_cast<float>(color.g), static_cast<float>(color.b), 1},
            kPlain, {side, side}))
      chosen = &color;
    landmark("swatch " + std::string(name));
    if (ImGui::IsItemHovered()) {
      besideItem();
      ImGui::SetTooltip("%s", name.data());
    }
  }
  return chosen;
}

}  // namespace

bool editSwatch(Color& value) {
  constexpr ImGuiColorEditFlags kFlags = ImGuiColorEditFlags_Float | ImGuiColorEditFlags_HDR;
  float picked[3] = {static_cast<float>(value.r), static_cast<float>(value.g), static_cast<float>(value.b)};
  const float side = ImGui::GetFrameHeight();
  if (ImGui::ColorButton("##colour", {picked[0], picked[1], picked[2], 1}, kFlags, {side, side}))
    ImGui::OpenPopup("pick");
  bool changed = false;
  if (ImGui::BeginPopup("pick")) {
    changed = ImGui::ColorPicker3("##picker", picked, kFlags | ImGuiColorEditFlags_NoInputs);
    if (const Color* swatch = chosenSwatch()) {
      value = *swatch;
      ImGui::CloseCurrentPopup();
      ImGui::EndPopup();
      return true;
    }
    ImGui::EndPopup();
  }
  if (changed) value = {picked[0], picked[1], picked[2]};
  return changed;
}

bool editValue(const FieldFacts& facts, Color& value) {
  bool changed = editSwatch(value);
  double numbers[3] = {value.r, value.g, value.b};
  const std::string name = saidName(facts.name);
  ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
  changed =
      editNumbersInRow(numbers, 3, {facts.least, facts.most, "%.3g", 0.005f, false, true, name}) || changed;
  if (!changed) return false;
  const auto within = [&](double x) { return std::clamp(x, facts.least, facts.most); };
  value = {within(numbers[0]), within(numbers[1]), within(numbers[2])};
  return true;
}

bool editValue(const FieldFacts&, Heights& value) { return showFile(value.file); }

bool editValue(const FieldFacts& facts, Pixels& value) {
  std::string file = value.file;
  if (!editFileName(facts, file, pictureSuffixes(FileDialog::Purpose::read))) return false;
  value = {std::move(file), nullptr, {}};
  return true;
}

bool editValue(const FieldFacts& facts, PhotometryFile& value) {
  std::string file = value.file;
  if (!editFileName(facts, file, {".ies"})) return false;
  value = {std::move(file), nullptr, {}};
  return true;
}

bool editValue(const FieldFacts& facts, FormulaText& value) {
  struct Refused {
    std::string field, of, text, why;
  };
  static Refused refused;  // what was typed last and has a mistake: it stays in its field to be mended
  const std::string name = saidName(facts.name);
  const bool mending = refused.field == name && refused.of == value.text();
  std::string text = mending ? refused.text : value.text();
  ImGui::SetNextItemWidth(-1);
  if (mending) ImGui::PushStyleColor(ImGuiCol_Text, palette().warning);
  const bool changed = editText("##value", text, "no formula");
  if (mending) ImGui::PopStyleColor();
  landmark("text");
  if (mending && ImGui::IsItemHovered())
    ImGui::SetTooltip("%s\nthe formula is still: %s", refused.why.c_str(), value.text().c_str());
  if (!changed) return false;
  try {
    FormulaText now(text);
    refused = {};
    const bool another = now.text() != value.text();
    value = std::move(now);
    return another;
  } catch (const Error& error) {
    refused = {name, value.text(), text, error.messages().front().what};
    remarkOn(name + ": " + refused.why + "; not taken");
    return false;
  }
}

std::optional<FileWish> takeFileWish() { return std::exchange(fileChoice().wish, std::nullopt); }

void giveFile(unsigned field, std::string name) {
  fileChoice().field = field;
  fileChoice().name = std::move(name);
}

FieldsWithin::FieldsWithin(std::string_view said, std::string_view field)
    : said_(outerNames().size()), fields_(outerFields().size()) {
  outerNames() += std::string(said) + " ";
  if (!field.empty()) outerFields() += std::string(field) + " ";
}
FieldsWithin::~FieldsWithin() {
  outerNames().resize(said_);
  outerFields().resize(fields_);
}

std::string saidName(std::string_view field) { return outerNames() + std::string(field); }

bool editValue(const FieldFacts&, std::string& value) {
  ImGui::SetNextItemWidth(-1);
  const bool changed = editText("##value", value);
  landmark("text");
  return changed;
}

bool editNumbers(const FieldFacts& facts, double* values, std::size_t count) {
  constexpr std::size_t kMost = 4, kInLongList = 3;  // in a row; of long ones the first three are a place
  const std::size_t most = count <= kMost ? kMost : kInLongList;
  bool changed = false;
  for (std::size_t i = 0; i < count; i += most) {
    ImGui::PushID(static_cast<int>(i));
    changed = drag(facts, values + i, static_cast<int>(std::min(most, count - i))) || changed;
    ImGui::PopID();
  }
  return changed;
}

bool editNames(const std::vector<std::string>& names, std::vector<std::string>& chosen, const char* none) {
  std::string shown;
  for (const std::string& name : chosen) shown += (shown.empty() ? "" : ", ") + name;
  ImGui::SetNextItemWidth(-1);
  const bool open = ImGui::BeginCombo("##names", shown.empty() ? none : shown.c_str());
  const auto row = [&](const std::string& name, std::size_t at, bool known) {
    const auto found = std::find(chosen.begin(), chosen.end(), name);
    bool on = found != chosen.end();
    ImGui::PushID(static_cast<int>(at));
    const bool changed = ImGui::Checkbox((known ? name : name + " (not in the scene)").c_str(), &on);
    landmark("name " + name);
    ImGui::PopID();
    if (changed && on) chosen.push_back(name);
    if (changed && !on) chosen.erase(found);
    return changed;
  };
  bool changed = false;
  if (open) {
    for (std::size_t i = 0; i < names.size(); ++i) changed = row(names[i], i, true) || changed;
    const std::vector<std::string> before = chosen;
    for (std::size_t i = 0; i < before.size(); ++i)
      if (std::find(names.begin(), names.end(), before[i]) == names.end())
        changed = row(before[i], names.size() + i, false) || changed;
    if (names.empty() && before.empty()) ImGui::TextDisabled("nothing here has a name yet");
    ImGui::EndCombo();
  }
  landmark("names");
  if (!shown.empty() && !open && ImGui::IsItemHovered()) ImGui::SetTooltip("%s", shown.c_str());
  return changed;
}

bool editChoice(const std::string_view* names, std::size_t count, std::size_t& value) {
  bool changed = false;
  ImGui::SetNextItemWidth(-1);
  if (!ImGui::BeginCombo("##value", std::string(names[value]).c_str())) return false;
  for (std::size_t i = 0; i < count; ++i)
    if (ImGui::Selectable(std::string(names[i]).c_str(), i == value)) {
      value = i;
      changed = true;
    }
  ImGui::EndCombo();
  return changed;
}

bool editValue(const FieldFacts&, EnumValue& value) {
  std::size_t index = value.index();
  if (!editChoice(value.names().data(), value.names().size(), index)) return false;
  value.set(index);
  return true;
}

bool beginList(std::size_t count) {
  constexpr std::size_t kMostUnfolded = 8;
  char label[40];
  std::snprintf(label, sizeof label, "%zu###list", count);
  return ImGui::TreeNodeEx(label, ImGuiTreeNodeFlags_NoTreePushOnOpen | ImGuiTreeNodeFlags_SpanAvailWidth |
                                      (count <= kMostUnfolded ? ImGuiTreeNodeFlags_DefaultOpen : 0));
}

void listButtons(std::size_t index, ListEdit& edit) {
  const float side = ImGui::GetFrameHeight();
  const bool again = ImGui::IsMouseReleased(0) && ImGui::GetIO().MouseClickedLastCount[0] > 1;
  if (ImGui::Button("x", {side, 0}) && !again) edit = {ListEdit::What::remove, index};
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("take it out of the list");
  ImGui::SameLine(0, 1);
  if (ImGui::Button("+", {side, 0})) edit = {ListEdit::What::repeat, index};
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("the same once more");
  ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
}

bool addButton() {
  const bool pressed = ImGui::SmallButton("Add");
  landmark("add");
  return pressed;
}

bool beginFields(const char* id, bool buttons) {
  if (!ImGui::BeginTable(id, buttons ? 3 : 2, ImGuiTableFlags_SizingStretchProp)) return false;
  ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch, 0.4f);
  ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch, 0.6f);
  if (buttons) ImGui::TableSetupColumn("button", ImGuiTableColumnFlags_WidthFixed, ImGui::GetFrameHeight());
  return true;
}

void endFields() {
  landmarksOf("");
  ImGui::EndTable();
}

std::string shortened(std::string_view text, float width) {
  const auto fits = [&](const std::string& all) { return ImGui::CalcTextSize(all.c_str()).x <= width; };
  constexpr std::size_t kMostTail = 4;
  const std::size_t letters = text.find_last_not_of("0123456789)") + 1;  // which tells it from others
  const std::size_t tail = text.size() - letters <= kMostTail ? text.size() - letters : 0;
  std::string shown(text);
  for (std::size_t kept = text.size() - tail; !fits(shown) && kept > 1;)
    shown = std::string(text.substr(0, --kept)) + ".." + std::string(text.substr(text.size() - tail));
  return shown;
}

std::string inLines(std::string_view words, float most) {
  std::string lines, line;
  while (!words.empty()) {
    const std::size_t space = std::min(words.find(' '), words.size());
    const std::string word(words.substr(0, space)), longer = line.empty() ? word : line + " " + word;
    words.remove_prefix(std::min(space + 1, words.size()));
    const bool fits = line.empty() || ImGui::CalcTextSize(longer.c_str()).x <= most;
    if (!fits) lines += line + "\n";
    line = fits ? longer : word;
  }
  return lines + line;
}

void rowName(std::string_view name) {
  ImGui::TextUnformatted(shortened(name, ImGui::GetContentRegionAvail().x).c_str());
}

void besidePanel() {
  const ImGuiWindow& panel = *ImGui::GetCurrentWindow()->RootWindow;
  const float gap = ImGui::GetStyle().ItemSpacing.x, middle = panel.Pos.x + panel.Size.x / 2;
  const bool left = middle > ImGui::GetMainViewport()->GetCenter().x;
  ImGui::SetNextWindowPos(
      {left ? panel.Pos.x - gap : panel.Pos.x + panel.Size.x + gap, ImGui::GetItemRectMin().y},
      ImGuiCond_Always, {left ? 1.0f : 0.0f, 0});
}

void besideItem() {
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  const ImGuiViewport& window = *ImGui::GetMainViewport();
  const float gap = ImGui::GetStyle().ItemSpacing.y;
  const bool above = high.y + 4 * ImGui::GetTextLineHeightWithSpacing() > window.Pos.y + window.Size.y;
  ImGui::SetNextWindowPos({low.x, above ? low.y - gap : high.y + gap}, ImGuiCond_Always,
                          {0, above ? 1.0f : 0.0f});
}

void fieldName(std::string_view name, std::string_view help, const std::string& range) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::AlignTextToFramePadding();
  rowName(name);
  landmarksOf("field " + outerFields() + std::string(name));
  if (ImGui::IsItemHovered()) {
    besidePanel();
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(characters(60));
    ImGui::TextUnformatted(name.data(), name.data() + name.size());
    ImGui::TextUnformatted(help.data(), help.data() + help.size());
    if (!range.empty()) ImGui::TextDisabled("%s", range.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
  }
  ImGui::TableNextColumn();
}

std::string rangeText(const FieldFacts& facts) {
  const std::string unit = facts.unit.empty() ? "" : " " + std::string(facts.unit);
  if (facts.least == facts.most) return "";  // not of numbers
  if (facts.least == -kNoLimit && facts.most == kNoLimit) return "any" + unit;
  if (facts.most == kNoLimit) return toText(facts.least) + unit + " or more";
  return toText(facts.least) + " to " + toText(facts.most) + unit;
}

}  // namespace trace::studio
