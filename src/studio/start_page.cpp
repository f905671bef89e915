#include "studio/start_page.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "studio/actions.h"
#include "studio/studio.h"
#include "studio/widgets/landmarks.h"

namespace trace::studio {
namespace {

constexpr int kThumbnail = 200;  // pixels across

/// Makes one small picture after the other.
void makePictures(StartPage& page) {
  if (!std::exchange(page.looked, true)) {
    page.lessons = lessonsIn(page.folder);
    page.scenes = examplesIn(page.folder);
  }
  if (auto made = page.task.take()) {
    page.pictures.push_back(std::make_unique<Texture>());
    if (made->bytes.width > 0) page.pictures.back()->set(made->bytes);
  }
  const std::size_t next = page.pictures.size();
  if (page.task.pending() || page.complete()) return;
  const ExampleScene& scene =
      next < page.lessons.size() ? page.lessons[next] : page.scenes[next - page.lessons.size()];
  page.task.start(
      [file = scene.file](const Cancelled&) { return StartPage::Thumbnail{thumbnail(file, kThumbnail)}; });
}

void takeAction(Studio& studio, std::string_view name) {
  for (const Action& action : actions())
    if (name == action.name) action.run(studio);
}

void section(const char* text) {
  ImGui::Spacing();
  ImGui::TextUnformatted(text);
  ImGui::Separator();
}

/// A picture with its title, to be clicked.
void drawCard(Studio& studio, const ExampleScene& scene, const Texture* picture, ImVec2 size) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float line = ImGui::GetTextLineHeight(), pad = ImGui::GetStyle().FramePadding.x;
  ImGui::PushID(scene.file.c_str());
  const bool pressed = ImGui::InvisibleButton("card", {size.x, size.y + line + 2 * pad});
  ImGui::PopID();
  landmark("start " + scene.title);
  const bool over = ImGui::IsItemHovered() || ImGui::IsItemFocused();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 end{at.x + size.x, at.y + size.y + line + 2 * pad};
  list.AddRectFilled(at, end, ImGui::GetColorU32(over ? ImGuiCol_FrameBgHovered : ImGuiCol_FrameBg), 4);
  if (picture && !picture->empty()) {  // as much of it as fills the card
    const float own = static_cast<float>(picture->width()) / static_cast<float>(picture->height()),
                card = size.x / size.y;
    const float across = std::min(1.0f, card / own), down = std::min(1.0f, own / card);
    list.AddImageRounded(picture->id(), at, {at.x + size.x, at.y + size.y},
                         {0.5f - across / 2, 0.5f - down / 2}, {0.5f + across / 2, 0.5f + down / 2},
                         IM_COL32_WHITE, 4, ImDrawFlags_RoundCornersTop);
  }
  list.PushClipRect(at, end, true);
  list.AddText({at.x + pad, at.y + size.y + pad}, ImGui::GetColorU32(ImGuiCol_Text), scene.title.c_str());
  list.PopClipRect();
  if (over) ImGui::SetTooltip("%s", scene.about.c_str());
  if (pressed) studio.workspace.open(scene.file);
}

void drawCards(Studio& studio, const std::vector<ExampleScene>& scenes, std::size_t first) {
  const StartPage& page = studio.start;
  const float gap = ImGui::GetStyle().ItemSpacing.x, room = ImGui::GetContentRegionAvail().x;
  const float columns = std::clamp(std::floor((room + gap) / (characters(24) + gap)), 1.0f, 8.0f);
  const float wide = std::floor((room - gap * (columns - 1)) / columns);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    if (i % static_cast<std::size_t>(columns) != 0) ImGui::SameLine();
    const std::size_t picture = first + i;
    drawCard(studio, scenes[i], picture < page.pictures.size() ? page.pictures[picture].get() : nullptr,
             {wide, std::round(wide / 1.6f)});
  }
}

}  // namespace

void drawStart(Studio& studio, ImVec2 area) {
  StartPage& page = studio.start;
  makePictures(page);
  ImGui::BeginChild("start", area);
  if (studio.workspace.reading()) ImGui::TextDisabled("The file is being read.");
  if (ImGui::Button("New scene...")) takeAction(studio, "New scene...");
  landmark("start new");
  ImGui::SameLine();
  if (ImGui::Button("Open scene...")) takeAction(studio, "Open scene...");
  landmark("start open");
  ImGui::SameLine();
  ImGui::TextDisabled("or drop a scene here");
  if (!page.lessons.empty()) {
    section("Lessons: find the mistake");
    drawCards(studio, page.lessons, 0);
  }
  const auto recent = studio.workspace.recent();  // a copy: opening one changes it
  if (!recent.empty()) section("Recent files");
  for (const std::string& file : recent) {
    ImGui::PushStyleColor(ImGuiCol_Button, ImVec4(0, 0, 0, 0));
    const std::filesystem::path path(file);
    const std::string label = path.filename().generic_string() + "##" + file;
    if (ImGui::SmallButton(label.c_str())) studio.workspace.open(file);
    ImGui::PopStyleColor();
    ImGui::SameLine();
    ImGui::TextDisabled("%s", path.parent_path().generic_string().c_str());
  }
  if (!page.scenes.empty()) {
    section("Scenes");
    drawCards(studio, page.scenes, page.lessons.size());
  }
  ImGui::EndChild();
}

}  // namespace trace::studio
