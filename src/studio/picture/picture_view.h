// How the picture is looked at: zoom, exposure, comparison; and its textures.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/view/picture_views.h"
#include "app/view/pixel_choice.h"
#include "image/picture.h"
#include "studio/widgets/texture.h"

namespace trace::studio {

enum class View { picture, reference, sideBySide, swipe, difference, falseColour };
inline constexpr const char* kViewNames[] = {"Picture", "Reference",  "Side by side",
                                             "Swipe",   "Difference", "False colour"};

/// Other views show several pictures at once, or colours that mean something else.
constexpr bool hasHistogram(View view) {
  return view == View::picture || view == View::reference || view == View::difference;
}

struct PictureView {
  View view = View::picture;
  FilmPlane plane = FilmPlane::picture;  ///< what of the render is seen
  std::string pass{};                    ///< a pass of the render that is seen instead; "" if none is
  bool fit = true;
  float zoom = 1;                            ///< screen pixels per pixel of the picture
  double centreX = 0.5, centreY = 0.5;       ///< what is in the middle, in shares of the picture
  float exposure = 0;                        ///< stops
  float swipe = 0.5f;                        ///< share that shows the picture
  float magnify = 1;                         ///< magnify of the difference
  bool magnifyChosen = false;                ///< by a person; else it follows from the difference
  PixelChoice pixel;                         ///< that was clicked
  ShownChannel channel = ShownChannel::all;  ///< what of the pictures is seen
  bool histogramShown = false;

  // The contents of the textures.
  Texture pictureTexture, referenceTexture, differenceTexture;
  float captionHigh = 0;    ///< height of the caption above the picture, in the last frame
  float optionsHeight = 0;  ///< height of the options below the picture, in the last frame
  bool waits = false;       ///< for the first picture of a scene
  Picture shown;            ///< linear colours of the render
  Picture levels;           ///< what the tone makes of them, whose levels pictureTexture shows
  std::uint64_t shownVersion = ~std::uint64_t{0}, referenceVersion = ~std::uint64_t{0};
  double refreshed = 0, refreshCost = 0;  ///< seconds
  // How the textures were made.
  float exposed = 0;
  Development development;
  Rounding rounding = Rounding::truncate;
  ShownChannel channelShown = ShownChannel::all;
  Histogram histogram;  ///< histogram of the levels that are seen
  View histogramView = View::picture;
  double histogramEnd = 1;  ///< level at its right end
  std::string errors{};     ///< how far the picture and the reference are apart
  Picture reference{};      ///< the reference, with as many pixels as the picture; empty if its shape differs
  Picture difference{};     ///< difference of the two, not magnified
  View differenceView = View::picture;
  float differenceMagnify = 0;
  bool differenceChosen = false;

  Texture planeTexture;  ///< where another plane than the picture is seen
  PlaneView planeMade;   ///< what is in it, and what its colours mean
  CostMaker cost;        ///< what it shows of the cost of pixels
  FilmPlane planeShown = FilmPlane::picture;
  std::string passShown{};
  Convergence convergence;    ///< convergence of the shown picture
  std::vector<float> noise;   ///< levels, one for each look at the render that continues
  std::uint64_t noiseOf = 0;  ///< the render's number

  /// Something else of the render than its picture is seen.
  bool showsPlane() const { return plane != FilmPlane::picture || !pass.empty(); }
  /// Takes the pixel as if it were clicked, and brings it into view.
  void goTo(int x, int y) {
    pixel.choose(x, y, {shown.width, shown.height});
    if (!fit) {
      centreX = (x + 0.5) / shown.width;
      centreY = (y + 0.5) / shown.height;
    }
  }
  void nextView() { view = static_cast<View>((static_cast<int>(view) + 1) % 6); }
};

}  // namespace trace::studio
