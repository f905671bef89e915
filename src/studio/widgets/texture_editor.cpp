#include "studio/widgets/texture_editor.h"

#include <imgui.h>

#include <optional>
#include <utility>

#include "app/editing/edits.h"
#include "app/editing/texture_edits.h"
#include "base/match.h"
#include "shading/texture_flaws.h"
#include "studio/widgets/landmarks.h"
#include "studio/widgets/theme.h"

namespace trace::studio {
namespace {

/// A square with a pattern of four fields, bright if there is a texture.
bool patternButton(bool has) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float side = ImGui::GetFrameHeight(), rim = side / 4, half = (side - 2 * rim) / 2;
  const bool pressed = ImGui::Button("##pattern", {side, side});
  const ImU32 colour = ImGui::GetColorU32(has ? ImGuiCol_CheckMark : ImGuiCol_TextDisabled);
  for (int i = 0; i < 2; ++i) {
    const float shift = rim + half * static_cast<float>(i);
    ImGui::GetWindowDrawList()->AddRectFilled({at.x + shift, at.y + shift},
                                              {at.x + shift + half, at.y + shift + half}, colour);
  }
  ImGui::GetWindowDrawList()->AddRect({at.x + rim, at.y + rim}, {at.x + side - rim, at.y + side - rim},
                                      colour);
  landmark("texture");
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip(has ? "another texture, or none" : "a texture here; the value scales it");
  return pressed;
}

/// The choice: the keyword of a kind, or "" for no texture.
std::optional<std::string> chosenKind(std::string_view now) {
  std::optional<std::string> chosen;
  if (ImGui::Selectable("plain value", now.empty())) chosen = "";
  landmark("kind plain");
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("no texture");
  for (const TextureKind& kind : textureKindsToChoose()) {
    const std::string name(kind.keyword);
    if (ImGui::Selectable(name.c_str(), kind.keyword == now)) chosen = name;
    landmark("kind " + name);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", std::string(kind.help).c_str());
  }
  return chosen;
}

std::string_view textureKeywordOf(const trace::Texture& texture) { return texture->model.keyword(); }

/// A row that says why the field counts for nothing now, in place of its value.
template <class Field>
void idleField(const Field& field, const std::string& why) {
  fieldName(field.keyword, field.help);
  ImGui::AlignTextToFramePadding();
  ImGui::PushTextWrapPos(0);
  ImGui::TextDisabled("%s", why.c_str());
  ImGui::PopTextWrapPos();
  landmark("idle");
}

/// A line with the errors of the texture, over the whole width.
void showFlaws(const TextureNode& node) {
  for (const std::string& flaw : flawsOf(node)) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TableNextColumn();
    ImGui::PushTextWrapPos(0);
    ImGui::PushStyleColor(ImGuiCol_Text, palette().warning);
    ImGui::TextUnformatted(flaw.c_str());
    ImGui::PopStyleColor();
    ImGui::PopTextWrapPos();
    landmark("flaw");
  }
}

/// The rows of its fields, and of how it lies.
void textureFields(const trace::Texture& texture,
                   const std::function<void(trace::Texture, const std::string&)>& become) {
  TextureNode node = *texture;
  const std::string kind(textureKeywordOf(texture));
  const auto changed = [&](const std::string& what) {
    TextureNode next = node;
    next.name.clear();  // other fields may have the one of that name
    become(std::move(next), kind + " " + what);
  };
  showFlaws(node);
  const TextureModel before = node.model;
  editEachField(node.model, [&](const TextureField& f, auto& value) {
    if (const std::string why = whyIdle(node.model, f.keyword); !why.empty()) return idleField(f, why);
    editTexturedField(f, value, node.inputs, [&](const std::string& what) {
      followEdit(node.model, before, f.keyword);
      changed(what);
    });
  });
  editFields(node.placement, [&](std::string_view keyword) { changed(std::string(keyword)); });
}

}  // namespace

void editTextureOf(std::string_view field, std::vector<FieldTexture>& textures,
                   const TextureChanged& changed) {
  const std::string name(field);
  const trace::Texture* found = textureOf(textures, field);
  const std::optional<trace::Texture> texture = found ? std::optional(*found) : std::nullopt;
  const auto choose = [&](const std::string& kind) {
    if (kind.empty()) {
      removeTexture(textures, field);
      changed(name + " plain");
    } else {
      setTexture(textures, field, textureOfKind(kind, texture ? &*texture : nullptr));
      changed(name + " " + kind);
    }
  };
  const std::string_view now = texture ? textureKeywordOf(*texture) : "";
  ImGui::PushID("texture");
  ImGui::PushID(name.c_str());
  ImGui::TableNextColumn();
  if (patternButton(texture.has_value())) ImGui::OpenPopup("kinds");
  if (ImGui::BeginPopup("kinds")) {
    if (const auto kind = chosenKind(now); kind && *kind != now) choose(*kind);
    ImGui::EndPopup();
  }
  if (texture) {
    const FieldsWithin within(name + " " + std::string(now), field);
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    const std::string& called = (*texture)->name;
    const std::string label = (called.empty() ? "texture" : '"' + called + '"') + "###texture";
    const bool open = ImGui::TreeNodeEx(label.c_str(), ImGuiTreeNodeFlags_DefaultOpen);
    landmark("fold");
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s of %s", summary(*texture).c_str(), name.c_str());
    ImGui::TableNextColumn();
    ImGui::SetNextItemWidth(-1);
    if (ImGui::BeginCombo("##kind", std::string(now).c_str())) {
      if (const auto kind = chosenKind(now); kind && *kind != now) choose(*kind);
      ImGui::EndCombo();
    }
    landmark("kind");
    if (open) {
      textureFields(*texture, [&](trace::Texture next, const std::string& what) {
        setTexture(textures, field, std::move(next));
        changed(name + " " + what);
      });
      ImGui::TreePop();
    }
  }
  ImGui::PopID();
  ImGui::PopID();
}

}  // namespace trace::studio
