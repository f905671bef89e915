// The background of a scene, as its file gives it: bands of colour across the picture, which only
// camera rays see, or what is all around, which every ray sees: a gradient, a daylight sky, and pictures on
// the six faces of a cube before them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "base/field.h"
#include "math/color.h"
#include "math/vec.h"
#include "shading/pixels.h"

namespace trace {

struct Background {
  static constexpr std::string_view kKeyword = "background";
  static constexpr std::string_view kHelp =
      "background: bands of colour from the top of the picture down; or a sky";

  std::vector<Color> colors;  ///< from the top downward; none: black
  /// Where each band but the last ends, as a share of the picture's height from the top, ascending; none: all
  /// bands are equally high.
  std::vector<Real> limits;
  std::vector<Color> gradient{};   ///< all around, from straight down to straight up; none: no gradient
  std::vector<Real> elevations{};  ///< degrees above the horizon, ascending; none: evenly spaced
  Real turbidity = 0;              ///< turbidity of a daylight sky (shading/optics/daylight.h); 0: none
  Vec3 sun{1, 1, 1};               ///< the direction to it
  Real skyBrightness = 0.05;       ///< a colour of 1 for each 1 / skyBrightness kcd/m^2
  Color ground{0.2, 0.2, 0.2};     ///< below the horizon of a daylight sky
  /// On the faces of a cube around everything, as seen from inside: each covers its face from edge to edge,
  /// upright as seen from -z on. The top follows above the front, the bottom below it. What lies
  /// behind is seen where there is none, and through its transparency (VRML97, section 6.5).
  Pixels front{}, back{}, left{}, right{}, top{}, bottom{};

  static constexpr auto fields() {
    return Fields{
        Field{"colors", &Background::colors, "", 0, kNoLimit,
              "colours of the bands, from the top; none is black"},
        Field{"limits", &Background::limits, "", 0, 1,
              "where each band but the last ends, a fraction of the height from the top; none: equal bands"},
        Field{"gradient", &Background::gradient, "", 0, kNoLimit,
              "colours of a sky from straight down to straight up, seen in mirrors and glass too"},
        Field{"elevations", &Background::elevations, "degrees", -90, 90,
              "elevation of each colour of the gradient above the horizon; none: evenly spaced"},
        Field{"turbidity", &Background::turbidity, "", 0, 10,
              "turbidity of a daylight sky: 2 clear, 6 hazy; 0 is no such sky"},
        Field{"sun", &Background::sun, "", -kNoLimit, kNoLimit, "the direction to the sun of that sky"},
        Field{"sky_brightness", &Background::skyBrightness, "", 0, kNoLimit,
              "factor from its luminance, in kcd/m^2, to colours"},
        Field{"ground", &Background::ground, "", 0, kNoLimit, "the colour below its horizon"},
        Field{"front", &Background::front, "", 0, 0,
              "picture on the front face of a cube around the scene, at -z"},
        Field{"back", &Background::back, "", 0, 0, "the picture behind, at +z"},
        Field{"left", &Background::left, "", 0, 0, "the picture at the left, at -x"},
        Field{"right", &Background::right, "", 0, 0, "the picture at the right, at +x"},
        Field{"top", &Background::top, "", 0, 0, "the picture above; it continues above the front"},
        Field{"bottom", &Background::bottom, "", 0, 0, "the picture below; it continues below the front"}};
  }
  /// In the order of EnvironmentMap::kFaceNames.
  std::array<const Pixels*, 6> faces() const { return {&right, &left, &top, &bottom, &back, &front}; }
  bool operator==(const Background&) const = default;

  /// The colour of the bands at a share of the picture's height from the top.
  Color at(Real fromTop) const {
    if (colors.empty()) return Color(0);
    const auto last = static_cast<Real>(colors.size() - 1);
    const Real band =
        limits.empty()
            ? fromTop * (last + 1)
            : static_cast<Real>(std::upper_bound(limits.begin(), limits.end(), fromTop) - limits.begin());
    return colors[static_cast<std::size_t>(band > 0 ? std::min(band, last) : 0)];
  }

  /// The gradient's colour at an elevation in degrees. Precondition: there is a gradient, with as many
  /// elevations as colours or none.
  Color gradientAt(Real elevation) const {
    const auto last = static_cast<Real>(gradient.size() - 1);
    Real place = (elevation + 90) / 180 * last;
    if (!elevations.empty()) {
      const auto above = std::upper_bound(elevations.begin(), elevations.end(), elevation);
      place = static_cast<Real>(above - elevations.begin()) - 1;
      if (above != elevations.begin() && above != elevations.end())
        place += (elevation - above[-1]) / (above[0] - above[-1]);
    }
    place = std::clamp(place, 0.0, last);
    const auto below = static_cast<std::size_t>(place);
    const Real share = place - std::floor(place);
    return share > 0 ? lerp(share, gradient[below], gradient[below + 1]) : gradient[below];
  }
};

/// Changes every picture of the background: change(Pixels&).
template <class Change>
void changePixels(Background& background, const Change& change) {
  for (Pixels* face : {&background.front, &background.back, &background.left, &background.right,
                       &background.top, &background.bottom})
    change(*face);
}

}  // namespace trace
