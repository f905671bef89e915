// What the panel Rays shows: the rays of the pixel that was clicked, in space and as a tree, and those pinned
// for comparison.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/orbit_camera.h"
#include "app/ray_segments.h"
#include "app/ray_view.h"
#include "app/scene_model.h"
#include "app/session.h"
#include "render/visited_boxes.h"
#include "studio/scene_drawer.h"

namespace trace::studio {

enum class Surfaces { shaded, wireframe, none };

/// A pixel's rays with the scene and World that they belong to.
struct TracedPixel {
  std::shared_ptr<const Session> session;
  int x = 0, y = 0, sample = 0;
  Explanation explanation;
  std::vector<RaySegment> segments;  ///< one for each ray
  std::string problem;               ///< why there is none
  const RayTree& tree() const { return explanation.tree; }
  RayLooks looks(int node) const { return segments[static_cast<std::size_t>(node)].looks; }
  const Scene& scene() const { return session->scene(); }
};

struct RaysView {
  std::optional<TracedPixel> traced, pinned;
  int sample = 0;          ///< that is asked for
  int selected = -1;       ///< node of traced; -1: none
  int hovered = -1;        ///< under the cursor, in space or in the table, in this frame
  int hoveredBefore = -1;  ///< in the last frame
  bool scrollToSelected = false;
  int step = -1;             ///< rays shown in the order of tracing; -1: all
  std::vector<char> closed;  ///< nodes whose children the table hides
  std::vector<int> level;    ///< of each node in the tree
  std::vector<char> hasChildren;
  bool pinAsked = false;       ///< pin or unpin in the next frame
  std::vector<RayPair> pairs;  ///< pinned against traced

  std::vector<VisitedBox> boxes;  ///< of the hierarchies, by the selected ray
  int boxesOf = -1;               ///< the node that they are of
  int box = 0;                    ///< how many are shown

  // The view in space.
  std::unique_ptr<SceneDrawer> drawer;
  SceneModel model;
  std::shared_ptr<const Scene> modelScene;
  std::string orbitFile;  ///< the scene file that `orbit` was set for
  OrbitCamera orbit;
  Real size = 1;  ///< radius of what is looked at: of lights, normals and rays that leave the scene
  bool fromCamera = false;
  Surfaces surfaces = Surfaces::shaded;
  float opacity = 0.85f;
  bool boundsShown = false, normalsShown = false, lightsShown = true, cameraShown = true, axesShown = false;
  bool pictureShown = true, hitNormalsShown = true, pinnedShown = true, hierarchyShown = true;
  std::array<bool, kRayLooks.size()> lookShown{true, true, true, true, true};

  bool inStep(int node) const { return step < 0 || node < step; }
};

/// In a dark window the colours of the table are lightened.
inline Color colourOf(RayLooks looks, bool light) {
  return light ? look(looks).color : lerp(0.35, look(looks).color, Color(1));
}

struct Studio;

/// Traces the pixel that is selected, when it, the sample or the picture has changed.
void traceSelected(Studio& studio);
/// Finds the hierarchy boxes that the selected ray visited.
void showBoxes(RaysView& view);
/// The scene and the rays in space, with its switches and legend, in the rest of the child window.
void drawSpace(Studio& studio);

}  // namespace trace::studio
