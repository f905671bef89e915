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

constexpr ImGuiTableFlags kTreeTable = ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY |
                                       ImGuiTableFlags_BordersInnerV | ImGuiTableFlags_Resizable |
                                       ImGuiTableFlags_PadOuterX;

const RayNode& nodeAt(const RayTree& tree, int node) { return tree.nodes[static_cast<std::size_t>(node)]; }

std::string title(const TracedPixel& pixel) {
  return std::to_string(pixel.x) + ", " + std::to_string(pixel.y) +
         (pixel.explanation.samples.size() > 1 ? ", sample " + std::to_string(pixel.sample) : "");
}

ImVec4 textColour(const Studio& studio, const TracedPixel& pixel, int node) {
  const Color c = colourOf(pixel.looks(node), studio.theme.light);
  return {static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b), 1};
}

const char* lookName(const TracedPixel& pixel, int node) { return look(pixel.looks(node)).name.data(); }

std::string metBy(const TracedPixel& pixel, int index) {
  const RayNode& node = nodeAt(pixel.tree(), index);
  if (node.hit) return objectName(pixel.scene(), node.hit->object);
  for (const RayEnd& end : node.ends)
    if (const auto* stop = std::get_if<Blocked>(&end)) return objectName(pixel.scene(), stop->object);
  const auto light = lightOf(pixel.tree(), index);
  return light ? lightName(pixel.scene(), *light) : "";
}

void drawHead(Studio& studio, const TracedPixel& pixel) {
  RaysView& view = studio.rays;
  PixelInspector& inspector = studio.workspace.inspector;
  ImGui::AlignTextToFramePadding();
  ImGui::Text("pixel %d, %d", pixel.x, pixel.y);
  const auto samples = static_cast<int>(pixel.explanation.samples.size());
  if (samples > 1) {
    ImGui::SameLine();
    ImGui::SetNextItemWidth(characters(18));
    ImGui::SliderInt("##sample", &view.sample, 0, samples - 1, "sample %d");
  }
  ImGui::SameLine();
  if (ImGui::Button(inspector.pinned() ? "Unpin" : "Pin")) inspector.pin(!inspector.pinned());
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip(
        "keep these rays, then click another pixel or change an option: the tab Difference compares");

  const auto count = static_cast<int>(pixel.tree().nodes.size());
  if (samples <= 1) ImGui::SameLine();
  if (ImGui::ArrowButton("back", ImGuiDir_Left)) stepRays(studio, -1);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("one ray back in the order of tracing");
  ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
  if (ImGui::ArrowButton("on", ImGuiDir_Right)) stepRays(studio, 1);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("the next ray in the order of tracing");
  ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
  int step = view.step < 0 ? count : view.step;
  char format[32];
  std::snprintf(format, sizeof format, view.step < 0 ? "all rays: %d" : "ray %%d of %d", count);
  const float all = ImGui::CalcTextSize("All").x + 2 * ImGui::GetStyle().FramePadding.x;
  ImGui::SetNextItemWidth(
      std::max(characters(10), ImGui::GetContentRegionAvail().x - all - ImGui::GetStyle().ItemSpacing.x));
  const int before = step;
  if (ImGui::SliderInt("##step", &step, 1, count, format)) {
    view.step = before;
    stepRays(studio, step - before);
  }
  ImGui::SameLine();
  if (ImGui::Button("All")) view.step = -1;
}

/// With so much room left free below it.
void drawTreeTable(Studio& studio, const TracedPixel& pixel, const std::vector<int>& rows, float below) {
  RaysView& view = studio.rays;
  const std::vector<RayNode>& nodes = pixel.tree().nodes;
  if (!ImGui::BeginTable("tree", 4, kTreeTable, {0, -below})) return;
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableSetupColumn("ray", ImGuiTableColumnFlags_WidthStretch, 0.4f);
  ImGui::TableSetupColumn("met", ImGuiTableColumnFlags_WidthStretch, 0.27f);
  ImGui::TableSetupColumn("adds", ImGuiTableColumnFlags_WidthFixed, characters(9));
  ImGui::TableSetupColumn("ended", ImGuiTableColumnFlags_WidthStretch, 0.33f);
  ImGui::TableHeadersRow();
  if (const auto found = std::find(rows.begin(), rows.end(), view.scrollTo); found != rows.end()) {
    const float height = ImGui::GetTextLineHeight() + 2 * ImGui::GetStyle().CellPadding.y;
    const float top = static_cast<float>(found - rows.begin()) * height, room = ImGui::GetWindowHeight();
    if (top < ImGui::GetScrollY() || top + 2 * height > ImGui::GetScrollY() + room)
      ImGui::SetScrollY(std::max(0.0f, top - room / 2));
  }
  view.scrollTo = -1;
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
      const ImVec2 start = ImGui::GetCursorPos();
      const bool chosen =
          ImGui::Selectable("##row", i == view.selected,
                            ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowItemOverlap);
      const bool overRow = ImGui::IsItemHovered();
      const float indent = static_cast<float>(pixel.level[n]) * ImGui::GetFontSize() * 0.75f;
      ImGui::SetCursorPos({start.x + indent, start.y});
      ImGuiTreeNodeFlags flags = ImGuiTreeNodeFlags_OpenOnArrow | ImGuiTreeNodeFlags_NoTreePushOnOpen;
      if (!pixel.hasChildren[n]) flags |= ImGuiTreeNodeFlags_Leaf;
      ImGui::SetNextItemOpen(!view.closed[n]);
      ImGui::PushStyleColor(ImGuiCol_Text, textColour(studio, pixel, i));
      const bool open = ImGui::TreeNodeEx("##node", flags, "%s", lookName(pixel, i));
      ImGui::PopStyleColor();
      if (ImGui::IsItemToggledOpen())
        view.closed[n] = !open;
      else if (chosen || ImGui::IsItemClicked())
        view.selected = i;
      if (overRow || ImGui::IsItemHovered()) {
        view.hovered = i;
        if (ImGui::IsMouseDoubleClicked(0)) studio.raysTab = "Ray";
        ImGui::SetTooltip("%s", sentence(node, pixel.scene()).c_str());
      }
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

void drawTree(Studio& studio, const TracedPixel& pixel) {
  RaysView& view = studio.rays;
  const std::vector<RayNode>& nodes = pixel.tree().nodes;
  std::vector<int> rows;
  int below = -1;  // the level of a closed node whose children are passed over
  for (int i = 0; i < static_cast<int>(nodes.size()); ++i) {
    const auto n = static_cast<std::size_t>(i);
    if (below >= 0 && pixel.level[n] > below) continue;
    below = view.closed[n] ? pixel.level[n] : -1;
    if (view.inStep(i)) rows.push_back(i);
  }
  const bool any = view.selected >= 0;
  drawTreeTable(studio, pixel, rows, any ? ImGui::GetFrameHeightWithSpacing() : 0);
  if (!any) return;
  if (ImGui::Button("Numbers")) studio.raysTab = "Ray";
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip("all that is known of the selected ray (double click on its row)");
  ImGui::SameLine();
  ImGui::AlignTextToFramePadding();
  ImGui::TextColored(textColour(studio, pixel, view.selected), "%s",
                     sentence(nodeAt(pixel.tree(), view.selected), pixel.scene()).c_str());
}

void drawBoxes(Studio& studio) {
  RaysView& view = studio.rays;
  if (view.boxesOf != view.selected) {
    if (!ImGui::Button("Show the hierarchy boxes that it visited")) return;
    showBoxes(studio);
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

void drawNumbers(Studio& studio, const TracedPixel& pixel) {
  RaysView& view = studio.rays;
  if (view.selected < 0) return ImGui::TextDisabled("select a ray, in space or in the table");
  const RayNode& node = nodeAt(pixel.tree(), view.selected);
  ImGui::PushTextWrapPos();
  ImGui::TextColored(textColour(studio, pixel, view.selected), "%s ray: %s", lookName(pixel, view.selected),
                     sentence(node, pixel.scene()).c_str());
  ImGui::PopTextWrapPos();
  drawBoxes(studio);
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

void drawDifference(Studio& studio, const TracedPixel& traced) {
  RaysView& view = studio.rays;
  const TracedPixel* pinned = studio.workspace.inspector.pinned();
  if (!pinned) return ImGui::TextDisabled("Pin keeps these rays, to compare others with them");
  const std::vector<RayPair>& pairs = studio.workspace.inspector.pairs();
  const auto differ = std::count_if(pairs.begin(), pairs.end(), [](const RayPair& p) { return p.differs; });
  const Color before = pinned->explanation.pixel, now = traced.explanation.pixel;
  ImGui::Text("pinned %s: %.4f %.4f %.4f", title(*pinned).c_str(), before.r, before.g, before.b);
  ImGui::Text("now %s: %.4f %.4f %.4f", title(traced).c_str(), now.r, now.g, now.b);
  ImGui::TextDisabled("%d of %d rays differ", static_cast<int>(differ), static_cast<int>(pairs.size()));
  if (!ImGui::BeginTable("pairs", 3, kTreeTable)) return;
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableSetupColumn("ray", ImGuiTableColumnFlags_WidthStretch, 0.34f);
  ImGui::TableSetupColumn("met now", ImGuiTableColumnFlags_WidthStretch, 0.26f);
  ImGui::TableSetupColumn("difference", ImGuiTableColumnFlags_WidthStretch, 0.4f);
  ImGui::TableHeadersRow();
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(pairs.size()));
  while (clipper.Step())
    for (int r = clipper.DisplayStart; r < clipper.DisplayEnd; ++r) {
      const RayPair& pair = pairs[static_cast<std::size_t>(r)];
      const TracedPixel& pixel = pair.b >= 0 ? traced : *pinned;
      const int index = pair.b >= 0 ? pair.b : pair.a;
      ImGui::PushID(r);
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      const float indent = static_cast<float>(pair.depth) * ImGui::GetFontSize() * 0.75f;
      if (indent > 0) ImGui::Indent(indent);
      ImGui::PushStyleColor(ImGuiCol_Text, textColour(studio, pixel, index));
      if (ImGui::Selectable(lookName(pixel, index), pair.b >= 0 && pair.b == view.selected,
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

const TracedPixel* shownPixel(const Studio& studio) {
  const TracedPixel* pixel = studio.workspace.inspector.traced();
  return pixel && pixel->problem.empty() ? pixel : nullptr;
}

void stepRays(Studio& studio, int rays) {
  RaysView& view = studio.rays;
  const auto count = static_cast<int>(view.rays);
  const int from = view.step >= 0 ? view.step : rays > 0 ? 0 : count;
  view.step = std::clamp(from + rays, 1, std::max(count, 1));
  view.selected = view.scrollTo = std::min(view.step, count) - 1;
}

void showBoxes(Studio& studio) {
  RaysView& view = studio.rays;
  const TracedPixel* pixel = shownPixel(studio);
  if (!pixel || view.selected < 0) return;
  const Session& session = *pixel->session;
  view.boxes =
      visitedBoxes(session.worldOf(pixel->tree()), session.settings(), nodeAt(pixel->tree(), view.selected));
  view.boxesOf = view.selected;
  view.box = static_cast<int>(view.boxes.size());
}

namespace {

/// Asks for the rays of the pixel that is selected and takes those that have come.
void updatePixel(Studio& studio) {
  RaysView& view = studio.rays;
  const PictureView& picture = studio.picture;
  PixelInspector& inspector = studio.workspace.inspector;
  const auto session = studio.workspace.render.session();
  if (session && picture.pixel) {
    const PixelPlace pixel = picture.pixel.in(session->size());
    inspector.want(session, pixel.x, pixel.y, view.sample);
  } else {
    inspector.want(nullptr, 0, 0, 0);
  }
  if (!inspector.update() || !inspector.traced()) return;
  const TracedPixel& pixel = *inspector.traced();
  const std::size_t count = pixel.tree().nodes.size();
  if (pixel.x != view.x || pixel.y != view.y || count != view.rays) {
    view.step = -1;
    view.selected = count > 0 ? 0 : -1;
    view.closed.assign(count, 0);
  }
  view.x = pixel.x;
  view.y = pixel.y;
  view.rays = count;
  view.boxesOf = -1;
}

}  // namespace

void drawRays(Studio& studio) {
  RaysView& view = studio.rays;
  if (!studio.workspace.document.isOpen()) return ImGui::TextDisabled("no scene is open");
  updatePixel(studio);
  view.hovered = -1;
  const PixelInspector& inspector = studio.workspace.inspector;
  const TracedPixel* pixel = shownPixel(studio);
  const float height = ImGui::GetContentRegionAvail().y;
  ImGui::BeginChild("space", {0, height * (pixel ? 0.52f : 0.88f)}, false,
                    ImGuiWindowFlags_NoScrollWithMouse);
  drawSpace(studio);
  ImGui::EndChild();
  if (!inspector.traced()) {
    ImGui::PushTextWrapPos();
    ImGui::TextDisabled(
        inspector.busy()
            ? "The rays of that pixel are being traced."
            : "Click on the picture: the rays of that pixel appear here, in space and as a table.");
    ImGui::PopTextWrapPos();
  } else if (!pixel) {
    ImGui::PushTextWrapPos();
    ImGui::TextColored(studio.palette().error, "%s", inspector.traced()->problem.c_str());
    ImGui::PopTextWrapPos();
  } else {
    drawHead(studio, *pixel);
    if (ImGui::BeginTabBar("about rays")) {
      const auto tab = [&](const char* name, void (*draw)(Studio&, const TracedPixel&)) {
        const ImGuiTabItemFlags flags = studio.raysTab == name ? ImGuiTabItemFlags_SetSelected : 0;
        if (!ImGui::BeginTabItem(name, nullptr, flags)) return;
        if (flags) studio.raysTab.clear();
        ImGui::BeginChild(name);
        draw(studio, *pixel);
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
