// The rays of a pixel as a person is shown them: the view in space, the tree, and the sum of the colour,
// after each ray of the tracing. For a drawing, and for a short film.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/explain/pixel_inspector.h"
#include "app/session/background_task.h"
#include "app/view/drawing.h"
#include "app/view/panel.h"
#include "shading/cameras/camera.h"

namespace trace {

class RayStory {
 public:
  /// `view`: the camera from which the scene is seen; its aspect ratio is that of the view. Shades the
  /// surfaces once, which takes a moment. Precondition: the pixel has rays.
  RayStory(const TracedPixel& pixel, const Camera& view);

  int rays() const { return static_cast<int>(pixel_.tree().nodes.size()); }
  /// After so many rays, in the order of tracing; with the sentence about the last, or about the pixel once
  /// all are there. `grown`: the share of the last ray that is drawn.
  Drawing after(int rays, double grown = 1) const;
  /// After all rays, with every row of the tree: as high as it needs.
  Drawing whole() const;

 private:
  Drawing drawn(int rays, int rows, double grown) const;
  void addSpace(Drawing& drawing, int rays, double grown) const;
  void addLights(Drawing& drawing, const Panel& panel) const;
  void addCamera(Drawing& drawing, const Panel& panel) const;
  void addTree(Drawing& drawing, int rays, int rows, int known) const;
  /// The sentence, and the sum in lines that end at `most`; the lower end of the last of them.
  double addSum(Drawing& drawing, int rays, double most) const;

  TracedPixel pixel_;
  double wide_ = 0;  // width of the view, in pixels
  CameraFrame frame_;
  DrawnPicture surfaces_;
};

/// The film in which one ray after the other grows, as an animated PNG. Where there are many, several appear
/// at a time. "" if `advance` stopped it.
std::string filmOf(const RayStory& story, const Advance& advance = {});

/// The endings of files that a story is written to.
inline const std::vector<std::string> kStorySuffixes{".svg", ".png", ".apng"};

/// Writes the film as .apng, or the whole drawing, by the file's ending. Throws Error(Fault::usage) for
/// another ending, and Error(Fault::io). A film that `advance` stopped is not written.
void writeStory(const std::string& file, const RayStory& story, const Advance& advance = {});

/// The camera of a scene that sees what the frame shows. Precondition: the frame is orthogonal.
Camera cameraOf(const CameraFrame& frame, Real aspect);

/// A colour of light as the picture of a session with these settings shows it.
Color shownColour(const Color& light, const Settings& settings);

}  // namespace trace
