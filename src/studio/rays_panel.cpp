// The panel Rays: the rays of the pixel that was clicked in the picture, in space (space_view.cpp) and as a
// table; the numbers of one; steps through the tracing; the hierarchy boxes of one; what differs from a
// pinned pixel.
#include <imgui.h>

#include <algorithm>
#include <cstdio>

#include "studio/panels.h"
#include "studio/rays_view.h"

namespace trace::studio {
namespace {

constexpr ImGuiTableFlags kTableFlags = ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY |
                                        ImGuiTableFlags_BordersInnerV | ImGuiTableFlags_Resizable |
                                        ImGuiTableFlags_PadOuterX;

const RayNode& nodeAt(const RayTree& tree, int node) { return tree.nodes[static_cast<std::size_t>(node)]; }

/// What the table needs of the tree's form.
void prepare(RaysView& view) {
  const std::vector<RayNode>& nodes = view.traced->tree().nodes;
  view.level.assign(nodes.size(), 0);
  view.hasChildren.assign(nodes.size(), 0);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (nodes[i].parent >= 0) {
      const auto parent = static_cast<std::size_t>(nodes[i].parent);
      view.level[i] = view.level[parent] + 1;
      view.hasChildren[parent] = 1;
    }
}

void updatePairs(RaysView& view) {
  view.pairs.clear();
  const auto good = [](const auto& pixel) { return pixel && pixel->problem.empty(); };
  if (good(view.pinned) && good(view.traced))
    view.pairs =
        difference(view.pinned->tree(), view.pinned->scene(), view.traced->tree(), view.traced->scene());
}

std::string title(const TracedPixel& pixel) {
  return std::to_string(pixel.x) + ", " + std::to_string(pixel.y) +
         (pixel.explanation.samples.size() > 1 ? ", sample " + std::to_string(pixel.sample) : "");
}

ImVec4 textColour(const Studio& studio, const TracedPixel& pixel, int node) {
  const Color c = colourOf(pixel.looks(node), studio.theme.light);
  return {static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b), 1};
}

const char* nameOf(const TracedPixel& pixel, int node) { return look(pixel.looks(node)).name.data(); }

std::string metBy(const TracedPixel& pixel, int index) {
  const RayNode& node = nodeAt(pixel.tree(), index);
  if (node.hit) return objectName(pixel.scene(), node.hit->object);
  for (const RayEnd& end : node.ends)
    if (const auto* stop = std::get_if<Blocked>(&end)) return objectName(pixel.scene(), stop->object);
  const Term* term = termOf(pixel.tree(), index);
  return term && term->light ? lightName(pixel.scene(), term->light->light) : "";
}

void drawHead(Studio& studio) {
  RaysView& view = studio.rays;
  const TracedPixel& pixel = *view.traced;
  ImGui::AlignTextToFramePadding();
  ImGui::Text("pixel %d, %d", pixel.x, pixel.y);
  const auto samples = static_cast<int>(pixel.explanation.samples.size());
  if (samples > 1) {
    ImGui::SameLine();
    ImGui::SetNextItemWidth(characters(18));
    ImGui::SliderInt("##sample", &view.sample, 0, samples - 1, "sample %d");
  }
  ImGui::SameLine();
  if (ImGui::Button(view.pinned ? "Unpin" : "Pin") || view.pinAsked) {
    view.pinAsked = false;
    if (view.pinned)
      view.pinned.reset();
    else
      view.pinned = view.traced;
    updatePairs(view);
  }
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip(
        "keep these rays, then click another pixel or change an option: the tab Difference compares");

  const auto count = static_cast<int>(pixel.tree().nodes.size());
  const auto go = [&](int step) {
    view.step = std::clamp(step, 1, count);
    view.selected = view.step - 1, view.scrollToSelected = true;
  };
  if (samples <= 1) ImGui::SameLine();
  if (ImGui::ArrowButton("back", ImGuiDir_Left)) go((view.step < 0 ? count : view.step) - 1);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("one ray back in the order of tracing");
  ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
  if (ImGui::ArrowButton("on", ImGuiDir_Right)) go(view.step < 0 ? 1 : view.step + 1);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("the next ray in the order of tracing");
  ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
  int step = view.step < 0 ? count : view.step;
  char format[32];
  std::snprintf(format, sizeof format, view.step < 0 ? "all rays: %d" : "ray %%d of %d", count);
  const float all = ImGui::CalcTextSize("All").x + 2 * ImGui::GetStyle().FramePadding.x;
  ImGui::SetNextItemWidth(
      std::max(characters(10), ImGui::GetContentRegionAvail().x - all - ImGui::GetStyle().ItemSpacing.x));
  if (ImGui::SliderInt("##step", &step, 1, count, format)) go(step);
  ImGui::SameLine();
  if (ImGui::Button("All")) view.step = -1;
}

void drawTree(Studio& studio) {
  RaysView& view = studio.rays;
  const TracedPixel& pixel = *view.traced;
  const std::vector<RayNode>& nodes = pixel.tree().nodes;
  std::vector<int> rows;
  int below = -1;  // the level of a closed node whose children are passed over
  for (int i = 0; i < static_cast<int>(nodes.size()); ++i) {
    const auto n = static_cast<std::size_t>(i);
    if (below >= 0 && view.level[n] > below) continue;
    below = view.closed[n] ? view.level[n] : -1;
    if (view.inStep(i)) rows.push_back(i);
  }
  if (!ImGui::BeginTable("tree", 4, kTableFlags)) return;
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableSetupColumn("ray", ImGuiTableColumnFlags_WidthStretch, 0.4f);
  ImGui::TableSetupColumn("met", ImGuiTableColumnFlags_WidthStretch, 0.27f);
  ImGui::TableSetupColumn("adds", ImGuiTableColumnFlags_WidthFixed, characters(9));
  ImGui::TableSetupColumn("ended", ImGuiTableColumnFlags_WidthStretch, 0.33f);
  ImGui::TableHeadersRow();
  if (view.scrollToSelected) {
    const auto found = std::find(rows.begin(), rows.end(), view.selected);
    if (found != rows.end()) {
      const float height = ImGui::GetTextLineHeight() + 2 * ImGui::GetStyle().CellPadding.y;
      ImGui::SetScrollY(
          std::max(0.0f, static_cast<float>(found - rows.begin()) * height - ImGui::GetWindowHeight() / 2));
    }
    view.scrollToSelected = false;
  }
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(rows.size()));
  while (clipper.Step())
    for (int r = clipper.DisplayStart; r < clipper.DisplayEnd; ++r) {
      const int i = rows[static_cast<std::size_t>(r)];
      const auto n = static_cast<std::size_t>(i);
      const RayNode& node = nodes[n];
      ImGui::PushID(i);
      ImGui::TableNextRow();
      if (i == view.hoveredBefore)
        ImGui::TableSetBgColor(ImGuiTableBgTarget_RowBg1, ImGui::GetColorU32(ImGuiCol_FrameBgHovered));
      ImGui::TableNextColumn();
      const float indent = static_cast<float>(view.level[n]) * ImGui::GetFontSize() * 0.75f;
      if (indent > 0) ImGui::Indent(indent);
      ImGuiTreeNodeFlags flags = ImGuiTreeNodeFlags_SpanFullWidth | ImGuiTreeNodeFlags_OpenOnArrow |
                                 ImGuiTreeNodeFlags_NoTreePushOnOpen;
      if (!view.hasChildren[n]) flags |= ImGuiTreeNodeFlags_Leaf;
      if (i == view.selected) flags |= ImGuiTreeNodeFlags_Selected;
      ImGui::SetNextItemOpen(!view.closed[n]);
      ImGui::PushStyleColor(ImGuiCol_Text, textColour(studio, pixel, i));
      const bool open = ImGui::TreeNodeEx("##node", flags, "%s", nameOf(pixel, i));
      ImGui::PopStyleColor();
      if (ImGui::IsItemToggledOpen())
        view.closed[n] = !open;
      else if (ImGui::IsItemClicked())
        view.selected = i;
      if (ImGui::IsItemHovered()) {
        view.hovered = i;
        ImGui::SetTooltip("%s", sentence(node, pixel.scene()).c_str());
      }
      if (indent > 0) ImGui::Unindent(indent);
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(metBy(pixel, i).c_str());
      ImGui::TableNextColumn();
      if (node.kind != RayKind::shadow) ImGui::Text("%.4f", share(node));
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(sentence(node, pixel.scene()).c_str());
      ImGui::PopID();
    }
  ImGui::EndTable();
}

void drawBoxes(RaysView& view) {
  if (view.boxesOf != view.selected) {
    if (!ImGui::Button("Show the hierarchy boxes that it visited")) return;
    showBoxes(view);
  }
  const auto count = static_cast<int>(view.boxes.size());
  if (count == 0) return ImGui::TextDisabled("it visited no box of a hierarchy");
  if (ImGui::ArrowButton("box back", ImGuiDir_Left)) view.box = std::max(1, view.box - 1);
  ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
  if (ImGui::ArrowButton("box on", ImGuiDir_Right)) view.box = std::min(count, view.box + 1);
  ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
  char format[32];
  std::snprintf(format, sizeof format, "box %%d of %d", count);
  ImGui::SetNextItemWidth(-characters(10));
  ImGui::SliderInt("##box", &view.box, 1, count, format);
  ImGui::SameLine();
  if (ImGui::Button("Hide")) view.boxesOf = -1;
}

void drawNumbers(Studio& studio) {
  RaysView& view = studio.rays;
  if (view.selected < 0) return ImGui::TextDisabled("select a ray, in space or in the table");
  const TracedPixel& pixel = *view.traced;
  const RayNode& node = nodeAt(pixel.tree(), view.selected);
  ImGui::PushTextWrapPos();
  ImGui::TextColored(textColour(studio, pixel, view.selected), "%s ray: %s", nameOf(pixel, view.selected),
                     sentence(node, pixel.scene()).c_str());
  ImGui::PopTextWrapPos();
  drawBoxes(view);
  if (!ImGui::BeginTable("numbers", 2, ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY)) return;
  ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch, 0.4f);
  ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch, 0.6f);
  for (const auto& [name, value] : numbersOf(pixel.tree(), view.selected, pixel.scene())) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    if (value.empty())
      ImGui::TextColored(studio.palette().accent, "%s", name.c_str());
    else
      ImGui::TextDisabled("%s", name.c_str());
    ImGui::TableNextColumn();
    ImGui::PushTextWrapPos();
    ImGui::TextUnformatted(value.c_str());
    ImGui::PopTextWrapPos();
  }
  ImGui::EndTable();
}

void drawDifference(Studio& studio) {
  RaysView& view = studio.rays;
  if (!view.pinned) return ImGui::TextDisabled("Pin keeps these rays, to compare others with them");
  const auto differ =
      std::count_if(view.pairs.begin(), view.pairs.end(), [](const RayPair& p) { return p.differs; });
  const Color before = view.pinned->explanation.pixel, now = view.traced->explanation.pixel;
  ImGui::Text("pinned %s: %.4f %.4f %.4f", title(*view.pinned).c_str(), before.r, before.g, before.b);
  ImGui::Text("now %s: %.4f %.4f %.4f", title(*view.traced).c_str(), now.r, now.g, now.b);
  ImGui::TextDisabled("%d of %d rays differ", static_cast<int>(differ), static_cast<int>(view.pairs.size()));
  if (!ImGui::BeginTable("pairs", 3, kTableFlags)) return;
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableSetupColumn("ray", ImGuiTableColumnFlags_WidthStretch, 0.34f);
  ImGui::TableSetupColumn("met now", ImGuiTableColumnFlags_WidthStretch, 0.26f);
  ImGui::TableSetupColumn("difference", ImGuiTableColumnFlags_WidthStretch, 0.4f);
  ImGui::TableHeadersRow();
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(view.pairs.size()));
  while (clipper.Step())
    for (int r = clipper.DisplayStart; r < clipper.DisplayEnd; ++r) {
      const RayPair& pair = view.pairs[static_cast<std::size_t>(r)];
      const TracedPixel& pixel = pair.b >= 0 ? *view.traced : *view.pinned;
      const int index = pair.b >= 0 ? pair.b : pair.a;
      ImGui::PushID(r);
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      const float indent = static_cast<float>(pair.depth) * ImGui::GetFontSize() * 0.75f;
      if (indent > 0) ImGui::Indent(indent);
      ImGui::PushStyleColor(ImGuiCol_Text, textColour(studio, pixel, index));
      if (ImGui::Selectable(nameOf(pixel, index), pair.b >= 0 && pair.b == view.selected,
                            ImGuiSelectableFlags_SpanAllColumns) &&
          pair.b >= 0)
        view.selected = pair.b;
      ImGui::PopStyleColor();
      if (ImGui::IsItemHovered() && pair.b >= 0) view.hovered = pair.b;
      if (indent > 0) ImGui::Unindent(indent);
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(metBy(pixel, index).c_str());
      ImGui::TableNextColumn();
      if (pair.differs) ImGui::TextColored(studio.palette().changed, "%s", pair.what.c_str());
      ImGui::PopID();
    }
  ImGui::EndTable();
}

}  // namespace

void showBoxes(RaysView& view) {
  if (!view.traced || view.selected < 0) return;
  const Session& session = *view.traced->session;
  view.boxes = visitedBoxes(session.world(), session.settings(), nodeAt(view.traced->tree(), view.selected));
  view.boxesOf = view.selected, view.box = static_cast<int>(view.boxes.size());
}

void traceSelected(Studio& studio) {
  RaysView& view = studio.rays;
  const PictureView& picture = studio.picture;
  const auto session = studio.workspace.render.session();
  if (!picture.hasPixel || !session) return;
  const TracedPixel* now = view.traced ? &*view.traced : nullptr;
  const bool samePixel = now && now->x == picture.pixelX && now->y == picture.pixelY;
  if (samePixel && now->session == session && now->sample == view.sample) return;
  const int grid = gridSize(session->settings());
  view.sample = std::clamp(view.sample, 0, grid * grid - 1);
  TracedPixel traced{session, picture.pixelX, picture.pixelY, view.sample, {}, {}, ""};
  try {
    traced.explanation = session->explain(traced.x, traced.y, traced.sample);
    traced.segments = raySegments(traced.tree());
  } catch (const Error& error) {
    traced.problem = error.messages().front().what;
  }
  const std::size_t before = now ? now->tree().nodes.size() : 0;
  view.traced = std::move(traced);
  view.boxesOf = -1;
  const std::size_t count = view.traced->tree().nodes.size();
  if (!samePixel || count != before) {
    view.step = -1, view.selected = count > 0 ? 0 : -1;
    view.closed.assign(count, 0);
  }
  prepare(view);
  updatePairs(view);
}

void drawRays(Studio& studio) {
  RaysView& view = studio.rays;
  if (!studio.workspace.document.isOpen()) return ImGui::TextDisabled("no scene is open");
  traceSelected(studio);
  view.hovered = -1;
  const bool rays = view.traced && view.traced->problem.empty();
  const float height = ImGui::GetContentRegionAvail().y;
  ImGui::BeginChild("space", {0, height * (rays ? 0.52f : 0.88f)}, false, ImGuiWindowFlags_NoScrollWithMouse);
  drawSpace(studio);
  ImGui::EndChild();
  if (!view.traced) {
    ImGui::PushTextWrapPos();
    ImGui::TextDisabled("Click on the picture: the rays of that pixel appear here, in space and as a table.");
    ImGui::PopTextWrapPos();
  } else if (!rays) {
    ImGui::PushTextWrapPos();
    ImGui::TextColored(studio.palette().error, "%s", view.traced->problem.c_str());
    ImGui::PopTextWrapPos();
  } else {
    drawHead(studio);
    if (ImGui::BeginTabBar("about rays")) {
      const auto tab = [&](const char* name, void (*draw)(Studio&)) {
        const ImGuiTabItemFlags flags = studio.raysTab == name ? ImGuiTabItemFlags_SetSelected : 0;
        if (!ImGui::BeginTabItem(name, nullptr, flags)) return;
        if (flags) studio.raysTab.clear();
        ImGui::BeginChild(name);
        draw(studio);
        ImGui::EndChild();
        ImGui::EndTabItem();
      };
      tab("Tree", drawTree);
      tab("Ray", drawNumbers);
      tab("Difference", drawDifference);
      ImGui::EndTabBar();
    }
  }
  view.hoveredBefore = view.hovered;
}

}  // namespace trace::studio
