#include "studio/start_page.h"

#include <cmath>
#include <filesystem>
#include <utility>

#include "studio/actions.h"
#include "studio/studio.h"
#include "studio/widgets/card.h"
#include "studio/widgets/field_editor.h"
#include "studio/widgets/landmarks.h"

namespace trace::studio {
namespace {

constexpr int kThumbnail = 200;  // pixels across

/// Makes one small picture after the other.
void makePictures(StartPage& page) {
  if (!std::exchange(page.looked, true)) {
    page.lessons = lessonsIn(page.folder);
    page.integrators = integratorScenesIn(page.folder);
    page.scenes = examplesIn(page.folder);
  }
  const auto began = StartPage::Clock::now();
  if (page.rests && began < *page.rests) return;
  page.rests.reset();
  if (auto made = page.task.take()) {
    page.pictures.push_back(std::make_unique<Texture>());
    if (made->bytes.width > 0) page.pictures.back()->set(made->bytes);
    const auto now = StartPage::Clock::now();
    page.rests = now + (now - began);  // as long as it took
  }
  if (page.task.pending() || page.complete()) return;
  std::size_t next = page.pictures.size();
  const std::vector<ExampleScene>* list = &page.lessons;
  for (const auto* other : {&page.integrators, &page.scenes})
    if (next >= list->size()) next -= list->size(), list = other;
  const ExampleScene& scene = (*list)[next];
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

void drawCards(Studio& studio, const std::vector<ExampleScene>& scenes, std::size_t first) {
  const StartPage& page = studio.start;
  constexpr int kMostAcross = 8;
  const CardRow row = cardsAcross(characters(24), kMostAcross);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    if (i % static_cast<std::size_t>(row.count) != 0) ImGui::SameLine();
    const std::size_t picture = first + i;
    const ExampleScene& scene = scenes[i];
    const bool pressed = drawCard(scene.file, scene.title,
                                  picture < page.pictures.size() ? page.pictures[picture].get() : nullptr,
                                  {row.width, std::round(row.width / 1.6f)});
    landmark("start " + scene.title);
    if (ImGui::IsItemHovered() || ImGui::IsItemFocused()) {
      besideItem();
      ImGui::SetTooltip("%s", scene.about.c_str());
    }
    if (pressed) studio.workspace.open(scene.file);
  }
}

}  // namespace

void drawStart(Studio& studio, ImVec2 area) {
  StartPage& page = studio.start;
  makePictures(page);
  ImGui::BeginChild("start", area, false, ImGuiWindowFlags_NavFlattened);
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
  if (!page.integrators.empty()) {
    section("Integrators: a scene that shows what each is for");
    drawCards(studio, page.integrators, page.lessons.size());
  }
  if (!page.scenes.empty()) {
    section("Scenes");
    drawCards(studio, page.scenes, page.lessons.size() + page.integrators.size());
  }
  ImGui::EndChild();
}

}  // namespace trace::studio
