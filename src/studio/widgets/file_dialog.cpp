#include "studio/widgets/file_dialog.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <filesystem>

#include "base/error.h"
#include "image/codecs/codec.h"
#include "studio/widgets/field_editor.h"
#include "studio/widgets/landmarks.h"
#include "studio/widgets/theme.h"

namespace trace::studio {

namespace fs = std::filesystem;

void FileDialog::open(const std::string& title, Purpose purpose, const std::string& at,
                      std::vector<std::string> suffixes, std::function<void(const std::string&)> chosen) {
  title_ = title;
  purpose_ = purpose;
  suffixes_ = std::move(suffixes);
  chosen_ = std::move(chosen);
  name_ = purpose == Purpose::write ? fs::path(at).filename().generic_string() : "";
  suffix_ = fs::path(at).extension().generic_string();
  if (suffix_.empty() && !suffixes_.empty()) suffix_ = suffixes_.front();
  open_ = appearing_ = focusName_ = true;
  enter(nearestFolder(at));
}

void FileDialog::enter(const std::string& folder) {
  problem_.clear();
  overwrite_ = false;
  folder_ = folder;
  entries_.clear();
  try {
    entries_ = listFolder(folder, suffixes_);
  } catch (const Error& error) {
    problem_ = error.messages().front().what;
  }
}

void FileDialog::choose(const std::string& given) {
  std::error_code ignored;
  const bool isNew = purpose_ == Purpose::write && !fs::is_directory(fs::path(folder_) / given, ignored);
  const std::string name = isNew ? withSuffix(given, suffix_) : given;
  const fs::path path = (fs::path(folder_) / name).lexically_normal();
  if (fs::is_directory(path, ignored)) {
    if (purpose_ == Purpose::read) name_.clear();
    return enter(path.generic_string());
  }
  if (const std::string problem = folderProblem(path.parent_path().generic_string()); !problem.empty()) {
    problem_ = problem;
    return;
  }
  const bool exists = fs::exists(path, ignored);
  if (isNew) problem_ = endingProblem(name, suffixes_);
  if (isNew && !problem_.empty()) {
    focusName_ = true;
    return;
  }
  if (purpose_ == Purpose::read && !exists) {
    problem_ = "there is no file \"" + name + "\" here";
    focusName_ = true;
  } else if (purpose_ == Purpose::write && exists && !overwrite_) {
    overwrite_ = focusName_ = true;
    problem_ = "\"" + name + "\" exists; press the button or Enter again to replace it";
  } else {
    open_ = false;
    ImGui::CloseCurrentPopup();
    chosen_(path.generic_string());
  }
}

void FileDialog::drawEntries() {
  constexpr ImGuiTableFlags kFlags =
      ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY | ImGuiTableFlags_BordersOuter;
  const float below = ImGui::GetFrameHeightWithSpacing() * 2 + ImGui::GetTextLineHeightWithSpacing();
  if (!ImGui::BeginTable("files", 2, kFlags, {0, -below})) return;
  ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("size", ImGuiTableColumnFlags_WidthFixed, characters(12));
  std::string entered;
  focused_.clear();
  const auto row = [&](const std::string& name, bool folder, const std::string& size) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    const std::string label = folder ? name + "/" : name;
    if (ImGui::Selectable(label.c_str(), name == name_,
                          ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowDoubleClick |
                              ImGuiSelectableFlags_DontClosePopups)) {
      if (folder)
        entered = name;
      else
        name_ = name, overwrite_ = false;
      if (!folder && ImGui::IsMouseDoubleClicked(0)) entered = name;
    }
    landmark("file " + label);
    if (ImGui::IsItemFocused() && ImGui::GetIO().NavVisible) focused_ = name;
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", size.c_str());
  };
  if (fs::path(folder_).has_relative_path()) row("..", true, "");
  for (const FolderEntry& entry : entries_)
    row(entry.name, entry.folder, entry.folder ? "" : std::to_string((entry.bytes + 1023) / 1024) + " KiB");
  ImGui::EndTable();
  if (!entered.empty()) choose(entered);
}

void FileDialog::draw(bool escape, bool entered) {
  if (!open_) return;
  if (appearing_) ImGui::OpenPopup(title_.c_str());
  const ImGuiViewport& view = *ImGui::GetMainViewport();
  ImGui::SetNextWindowPos(view.GetCenter(), ImGuiCond_Appearing, {0.5f, 0.5f});
  ImGui::SetNextWindowSize({std::min(characters(90), view.Size.x * 0.9f), view.Size.y * 0.7f},
                           ImGuiCond_Appearing);
  if (!ImGui::BeginPopupModal(title_.c_str(), &open_)) return;
  if (escape) {
    open_ = false;
    ImGui::CloseCurrentPopup();
  }
  const bool typing = ImGui::GetIO().WantTextInput;  // then Enter belongs to the field

  std::string typed = folder_;
  ImGui::SetNextItemWidth(-1);
  const bool given = ImGui::InputText("##folder", &typed, ImGuiInputTextFlags_EnterReturnsTrue);
  landmark("dialog folder");
  if ((given || ImGui::IsItemDeactivatedAfterEdit()) && typed != folder_) enter(absoluteFolder(typed));
  if (given) focusName_ = true;
  drawEntries();
  ImGui::PushStyleColor(ImGuiCol_Text, palette().warning);
  rowName(problem_.empty() ? " " : problem_);
  if (!problem_.empty()) landmark("dialog problem " + problem_);
  ImGui::PopStyleColor();

  ImGui::SetNextItemWidth(-1);
  if (focusName_) ImGui::SetKeyboardFocusHere();
  appearing_ = focusName_ = false;
  bool done = ImGui::InputTextWithHint("##name", "file name", &name_, ImGuiInputTextFlags_EnterReturnsTrue);
  if (ImGui::IsItemEdited()) overwrite_ = false;
  done |= ImGui::Button(purpose_ == Purpose::read ? "Open"
                        : overwrite_              ? "Replace"
                                                  : "Save",
                        {characters(16), 0});
  ImGui::SameLine();
  if (ImGui::Button("Cancel", {characters(16), 0})) {
    open_ = false;
    ImGui::CloseCurrentPopup();
  }
  const std::string& named = focused_.empty() ? name_ : focused_;
  if (done && !name_.empty())
    choose(name_);
  else if (entered && !typing && !named.empty() && (!focused_.empty() || !ImGui::GetIO().NavVisible))
    choose(std::string(named));
  ImGui::EndPopup();
}

std::vector<std::string> pictureSuffixes(FileDialog::Purpose purpose) {
  std::vector<std::string> suffixes;
  for (const PictureFormat& format : pictureFormats())
    if (purpose == FileDialog::Purpose::read || format.encode)
      suffixes.insert(suffixes.end(), format.suffixes.begin(), format.suffixes.end());
  return suffixes;
}

}  // namespace trace::studio
