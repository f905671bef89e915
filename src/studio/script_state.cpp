#include "studio/script_state.h"

#include <imgui.h>

#include <cmath>
#include <filesystem>
#include <sstream>

#include "studio/widgets/landmarks.h"

namespace trace::studio {

std::string state(const Studio& studio) {
  std::ostringstream text;
  const Workspace& workspace = studio.workspace;
  text << "frames " << studio.frames << "\nspace-drawn "
       << (studio.rays.drawer ? studio.rays.drawer->drawn() : 0) << "\npopup "
       << (ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel) ? "open"
                                                                                              : "none")
       << "\nlog " << workspace.log().size() << "\n"
       << "logged " << (workspace.log().empty() ? "" : workspace.log().back().text) << "\n"
       << "focused " << focusedLandmark() << "\n";
  if (const auto session = workspace.render.session(); session && studio.picture.pixel) {
    const PixelPlace pixel = studio.picture.pixel.in(session->size());
    text << "pixel " << pixel.x << " " << pixel.y << "\n";
  }
  if (const TracedPixel* traced = workspace.inspector.traced())
    text << "traced " << traced->x << " " << traced->y << "\n";
  if (const TracedPixel* pixel = shownPixel(studio))
    text << "why " << pixel->why.sentence << "\nfault " << pixel->why.ray << "\nrays "
         << pixel->tree().nodes.size() << "\nways " << pixel->ways.size() << "\nway " << studio.rays.way
         << "\n";
  if (const ChainWalk* walk = studio.rays.chains.walk(); walk && studio.rays.chains.offered())
    text << "chain " << studio.rays.chains.index() << " of " << walk->moves.size() << "\n";
  text << "pyramid " << studio.rays.pyramid.all.maker.pyramid().pictures.size() << "\n";
  if (const InPlaceOfPicture alone = wayAlone(studio); !alone.caption.empty())
    text << "alone " << alone.caption << "\n";
  text << "stage " << (studio.stage ? "yes" : "no") << "\n";
  text << "pinned " << (workspace.inspector.pinned() ? "yes" : "no") << "\n";
  if (workspace.document.isOpen()) text << "objects " << workspace.document.scene().objects.size() << "\n";
  text << "from-camera " << (studio.rays.fromCamera ? "yes" : "no") << "\n";
  text << "selected " << Studio::kSelectedNames[static_cast<int>(studio.selected)] << " "
       << studio.selectedIndex << "\n";
  if (workspace.document.isOpen())
    for (const Option& option : options())
      text << "chosen " << option.name << " " << option.get(workspace.document.settings()) << "\n";
  if (workspace.document.isOpen())
    text << "file " << std::filesystem::path(workspace.document.file()).filename().generic_string()
         << "\nedited " << (workspace.document.edited() ? "yes" : "no") << "\n";
  text << "undo " << workspace.undoName() << "\n";
  for (const auto& [name, at] : landmarks()) {
    text << "at " << std::lround((at[0] + at[2]) / 2) << " " << std::lround((at[1] + at[3]) / 2) << " "
         << name << "\nbox";
    for (const float side : at) text << " " << std::lround(side);
    text << " " << name << "\n";
  }
  return text.str();
}

}  // namespace trace::studio
