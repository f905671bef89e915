// How the panel Rays shows the rays that app/explain/pixel_inspector.h has of a pixel, in space and as a
// tree.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/explain/chain_walk.h"
#include "app/explain/pixel_inspector.h"
#include "app/view/gizmo.h"
#include "app/view/orbit_camera.h"
#include "app/view/screen/overlays.h"
#include "app/view/space/drag_pace.h"
#include "app/view/space/scene_model.h"
#include "app/view/way_pyramid.h"
#include "image/development/development.h"
#include "render/rays/visited_boxes.h"
#include "studio/space/scene_drawer.h"
#include "studio/widgets/texture.h"

namespace trace::studio {

/// Pictures of ways, on the graphics card too.
struct WayPictures {
  PyramidMaker maker;
  std::vector<std::unique_ptr<Texture>> textures{};
};

/// The tab Pyramid, and the way that is seen alone in place of the picture.
struct PyramidView {
  WayPictures all, one;
  bool open = false;   ///< the tab was drawn in the last frame
  bool waits = false;  ///< for the picture, which comes first
  bool unweighted = false;
  int places = 5;              ///< places of the longest paths
  std::optional<Way> alone{};  ///< nothing of the document changes for it
  double exposure = 0;         ///< with which the pictures are shown
  Development development{};
  bool busy() const { return all.maker.busy() || one.maker.busy(); }
};

/// The view in the panel Picture in place of the picture.
struct InPlaceOfPicture {
  const Texture* texture = nullptr;  ///< null: the picture is seen all the same
  std::string caption{};             ///< "" if nothing is to be said of it
};

/// The handles of the selected thing, and the one that is held.
struct GizmoHold {
  GizmoMode mode = GizmoMode::move;
  std::optional<Gizmo> held{};  ///< as it was when the mouse took hold of it
  int handle = -1;
  Vec2 from{};      ///< where the mouse did
  Affine placed{};  ///< the thing's transform then
};

enum class Surfaces { shaded, wireframe, none };

struct RaysView {
  /// Seconds without mouse and keys, after which there is time for a smooth view in space.
  static constexpr double kRest = 0.12;

  int sample = 0;        ///< that is asked for
  std::size_t rays = 0;  ///< rays of the pixel that is shown
  int x = -1, y = -1;    ///< x and y of that pixel
  int clickedX = -1, clickedY = -1;
  int selected = -1;       ///< ray of the pixel; -1: none
  int hovered = -1;        ///< under the cursor, in space or in the table, in this frame
  int hoveredBefore = -1;  ///< in the last frame
  int keyRow = -1;         ///< the row of the tree that the keyboard is at
  bool focusTree = false;  ///< the keyboard goes to the rows of the tree
  float between = 0;       ///< height of what stood between the view in space and the tabs in the last frame
  int scrollTo = -1;       ///< ray whose row the table is to show
  int step = -1;           ///< rays shown in the order of tracing; -1: all
  bool differs = false;    ///< the tab Difference is in front
  std::vector<char> closed;  ///< nodes whose children the table hides

  std::vector<VisitedBox> boxes;  ///< boxes of the hierarchies, by the selected ray
  int boxesOf = -1;               ///< the node that they are of
  int box = 0;                    ///< how many are shown

  int way = -1;              ///< index of the chosen strategy; -1: none is chosen
  std::vector<int> wayRays;  ///< its rays, drawn before all others
  bool revealWay = false;    ///< the table scrolls to it

  PyramidView pyramid;

  ChainInspector chains;    ///< chains of `mlt`: a chain that comes by the pixel
  int chainMove = -1;       ///< whose rays are asked for; -1: the one that came nearest to the pixel
  bool revealMove = false;  ///< the table scrolls to it

  double playsAt = -1;  ///< seconds of Dear ImGui's clock when Play takes the next step; -1: it does not play
  float grown = 1;      ///< share of the length of the last of `step` rays that is drawn; less while it plays

  // The view in space.
  GizmoHold gizmo;
  DragPace pace;
  std::unique_ptr<SceneDrawer> drawer;
  bool coarse = false;                      ///< the last frame drew it, and the next makes it smoother
  std::uint64_t pictureVersion = 0;         ///< version of the picture on its plane
  double pictureSince = -1;                 ///< when it was drawn, in seconds
  std::string modelOf;                      ///< the scene file that `model` belongs to
  bool built = false;                       ///< `model` is there
  SceneModel model;                         ///< that is drawn
  std::shared_ptr<const Scene> modelScene;  ///< whose model was asked for
  std::shared_ptr<SceneModeler> modeler = std::make_shared<SceneModeler>();  ///< used by modelTask alone
  struct Modelled {
    std::string file;
    SceneModel model;
  };
  BackgroundTask<Modelled> modelTask;
  std::string orbitFile;   ///< the scene file that `orbit` was set for
  std::string orbitGuess;  ///< the same, before there is a World to see it with
  OrbitCamera orbit;
  Real aspect = 1.4;  ///< width of the view / its height
  Real size = 1;      ///< radius of what is looked at: of lights, normals and rays that leave the scene
  bool fromCamera = false;
  std::weak_ptr<const Session> wallsOf;  ///< for which the walls were found
  std::vector<std::uint32_t>
      walls;               ///< walls of the room that the scene's camera stands in; see app/view/space/room.h
  bool roomOpened = true;  ///< those of them that hide its inside are left out
  Surfaces surfaces = Surfaces::shaded;
  float opacity = 1;  ///< opacity of surfaces
  bool flat = false, materialsShown = true, litByScene = false;
  bool boundsShown = false, normalsShown = false, lightsShown = true, cameraShown = true, axesShown = false;
  double fineness = 1, modelFineness = 1;  ///< fineness of triangles: asked for, and shown
  bool raysFramed = true;                  ///< a click brings the pixel's rays into sight
  bool frameDue = false;                   ///< the rays that are shown next are
  bool pictureShown = true, hitNormalsShown = true, pinnedShown = true, hierarchyShown = true;
  std::array<bool, kRayLooks.size()> lookHidden{};
  ViewCorner legendCorner = ViewCorner::lowerLeft;

  bool inStep(int node) const { return step < 0 || node < step; }
  bool grows(int node) const { return grown < 1 && node == step - 1; }
};

/// The colour of lines in space, lighter than that of a picture on paper; that of camera rays is nearly
/// white, for many surfaces are grey. A black rim shows them on light ones.
inline Color colourOf(RayLooks looks) {
  return lerp(looks == RayLooks::camera ? 0.9 : 0.35, look(looks).color, Color(1));
}
/// The colour of words about a ray; in a light window dark enough to be read.
inline Color colourOfWords(RayLooks looks, bool light) {
  constexpr Real kDarker = 0.4;
  return light ? look(looks).color * (1 - kDarker) : colourOf(looks);
}

struct Studio;

/// Asks for the rays of the pixel that is selected and takes those that have come.
void updateRays(Studio& studio);
/// The pixel whose rays are shown; null if there are none.
const TracedPixel* shownPixel(const Studio& studio);
/// So many rays on in the order of tracing, or back: from the first on if all are shown, or from the last
/// back.
void stepRays(Studio& studio, int rays);
/// Plays the rays in the order of tracing, one after the other from the first; or stops that.
void playRays(Studio& studio);
/// Writes a drawing of the pixel's rays to a file, .svg or .png. Precondition: there are some.
void saveRays(Studio& studio, const std::string& file);
/// Writes the view in space with the rays, their tree and the sum of the colour: .svg or .png, or a film in
/// which one ray after the other appears, .apng. Precondition: there are rays.
void saveStory(Studio& studio, const std::string& file);
/// Finds the hierarchy boxes that the selected ray visited.
void showBoxes(Studio& studio);
/// The tab that lists the moves of a chain.
void drawChain(Studio& studio, const TracedPixel& pixel);
/// Chooses one of the pixel's ways, or none.
void chooseWay(Studio& studio, int way);
/// The tab that lists them.
void drawWays(Studio& studio, const TracedPixel& pixel);
/// The tab that shows what each way brings to the whole picture.
void drawPyramid(Studio& studio, const TracedPixel& pixel);
/// Asks for the pictures of ways that are to be seen, and takes those that have come. For each frame.
void updateWays(Studio& studio);
/// The way that is seen alone, if one is chosen.
InPlaceOfPicture wayAlone(const Studio& studio);
/// Why the pixel has its colour: a sentence, the sum, and what may cure it.
void drawWhy(Studio& studio, const TracedPixel& pixel);
/// The pixel's colour as a sum of swatches: of the rays that are shown.
void drawSum(Studio& studio, const TracedPixel& pixel);
/// Chooses the cure, after pinning the pixel's rays if that is asked for.
void cure(Studio& studio, const TracedPixel& pixel, const WhyCure& by, bool pins);
/// The tab that compares the rays with those that were pinned.
void drawDifference(Studio& studio, const TracedPixel& traced);
/// The scene and the rays in space, with its switches and legend, in the rest of the child window.
void drawSpace(Studio& studio);

}  // namespace trace::studio
