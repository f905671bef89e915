#include "studio/panels.h"

#include <array>

namespace trace::studio {

std::span<const Panel> panels() {
  static constexpr std::array kTable{
      Panel{"Picture", "the picture, and another to compare it with", Dock::centre, '1', drawPicture},
      Panel{"Controls", "every option", Dock::left, '2', drawControls},
      Panel{"Scene", "objects, lights, camera and materials", Dock::left, '3', drawScene},
      Panel{"Rays", "the rays of the pixel that was clicked, in space and as a tree", Dock::right, '4',
            drawRays},
      Panel{"Log", "what happened, with file and line", Dock::bottom, '5', drawLog},
      Panel{"Bad samples", "camera rays whose colour is not a number", Dock::bottom, '6', drawBadSamples},
      Panel{"Statistics", "rays, tests and times of the last render", Dock::bottom, '7', drawStatistics},
  };
  return kTable;
}

}  // namespace trace::studio
