// Linear pictures made visible: with an exposure, or as their difference in false colours.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "app/session/cost_map.h"
#include "image/development/tone.h"
#include "image/film/film.h"
#include "image/picture.h"
#include "render/picture/pass_facts.h"
#include "scene/settings.h"

namespace trace {

/// Brightened by `stops` powers of two and rounded to levels. 0 stops gives the levels of a file.
Bytes exposed(const Picture& picture, double stops, Rounding rounding);

/// The values of a pixel in words: its linear colour, and the levels after tone mapping.
std::string pixelText(const Color& linear, const Color& toned, Rounding rounding);

/// |a - b| * magnify for each channel. Precondition: the same size.
Picture differences(const Picture& a, const Picture& b, double magnify);

/// The power of two by which differences are magnified so that they are seen and few are white; from 1 to
/// 128. `difference` is not magnified.
double magnificationFor(const Picture& difference);

/// The largest difference of the channels of each pixel, times `magnify`: black where there is none, then
/// blue, green, yellow, red, and white from 1 on. Precondition: the same size.
Picture falseColours(const Picture& a, const Picture& b, double magnify);

/// One channel of a picture, or all.
enum class ShownChannel { all, red, green, blue, luminance };
inline constexpr const char* kChannelNames[] = {"Colours", "Red", "Green", "Blue", "Luminance"};

/// That channel as grey; the picture itself for all.
Picture channelOf(const Picture& picture, ShownChannel channel);

/// How many pixels have each value of a channel from 0 to 1; values outside count at the ends.
struct Histogram {
  static constexpr int kBins = 128;
  std::array<std::array<int, kBins>, 3> counts{};  ///< red, green, blue
  int most = 0;                                    ///< the largest of them between the ends
};
Histogram histogramOf(const Picture& picture);

/// "RMSE 0.0123, mean 0.004, largest 0.5 at 12, 7; PSNR 38.2 dB; 12 % of pixels differ". Precondition: the
/// same size.
std::string differenceText(const Picture& a, const Picture& b);

/// The picture with at most so many pixels along each side: each is the mean of a block of the others.
Bytes fewerPixels(const Bytes& picture, int most);

/// The colour that falseColours() gives a value.
Color falseColour(double value);

/// The views of a render that may replace its picture.
enum class FilmPlane { picture, samples, noise, change, cost };
inline constexpr const char* kPlaneNames[] = {"Picture", "Samples", "Noise", "Denoised", "Cost"};

/// Which value each colour of a heat map stands for.
struct ColourScale {
  double white = 0;          ///< the value that is white; 0: no scale
  bool logarithmic = false;  ///< logarithm of 1 + value
  std::string_view unit{};
  bool andMore = false;  ///< larger values are white, too

  /// The place of a value, from 0 to 1, and the reverse.
  double shareOf(double value) const;
  double valueAt(double share) const;
  /// Text of a value: "1240 tests".
  std::string text(double value) const;
};

/// A plane of a film in colours, from black over violet, red and yellow to white, and what they mean.
/// `shown` is the film's picture, perhaps without noise. Precondition: not the picture itself.
struct PlaneView {
  Picture colours;
  std::string legend;
  ColourScale scale{};  ///< of `values`
  Picture values{};     ///< values that the colours show, in all three channels; empty if there are none
};
PlaneView planeView(FilmPlane plane, const Film& film, const Picture& shown, const CostMap& cost = {});

/// The passes that a film has and that can be seen, by their names.
std::vector<std::string_view> passesToSee(const Settings& settings);
/// One of them, and what it shows. `shown` is the film's picture, perhaps without noise.
PlaneView passView(std::string_view pass, const Film& film, const Settings& settings, const PassNames& names,
                   const Picture& shown);

/// The picture with another number of pixels: each is the mean of the part that it covers. Empty if the
/// pictures differ in shape by more than a pixel.
Picture resampled(const Picture& picture, int width, int height);

/// "12.5 samples a pixel, noise 1.3 levels": how far a render has come.
std::string convergenceText(const Convergence& convergence);

/// Each value is one of the 256 levels of a file with eight bits.
bool holdsLevels(const Picture& picture);
/// The levels that such a file keeps of the picture.
Picture roundedToLevels(Picture levels, Rounding rounding);

/// The levels as a file keeps them that has none beyond 0 and 1: what a picture from such a file is compared
/// with.
Picture clamped(Picture levels);

}  // namespace trace
