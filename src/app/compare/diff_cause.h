// The one change of a whole picture that explains why two pictures differ: rows from the bottom up, blue
// before red, a transfer curve, half a pixel. What `ray diff` and `ray grade` add to their numbers.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "app/compare/difference.h"

namespace trace {

/// A change that makes the test picture of the reference. Its parts are applied in the order of its members.
struct PictureChange {
  /// Where a pixel comes from: a change of the signs of its axes, then an exchange of the axes.
  struct Turn {
    std::string_view text;  ///< "upside down"; "" changes nothing
    bool mirrorX = false, mirrorY = false, swapAxes = false;
  };
  /// The order in which the test has the channels of the reference: {2, 1, 0} exchanges red and blue.
  struct Channels {
    std::string_view name;  ///< "BGR"
    std::string_view text;
    std::array<int, 3> order{0, 1, 2};
  };
  enum class Curve { none, srgb, gamma22, gamma18, scale, lightScale };

  Turn turn;
  Channels channels;
  Curve curve = Curve::none;
  bool darkens = false;        ///< the inverse of the curve, which brightens
  double factor = 1;           ///< the factor of a scale; at least 1, or at most 1 if it darkens
  double right = 0, down = 0;  ///< the shift in pixels: a multiple of one half

  /// The number of parts that change something; right and down are one.
  int parts() const;
  /// The change in words, to follow the name of the reference: "upside down and with red and blue exchanged".
  std::string text() const;
};

/// Names of the curve for programs: "srgb", "gamma 2.2", "gamma 1.8", "scale", "light scale"; "" for none.
std::string_view curveName(PictureChange::Curve curve);

/// A change and what it leaves.
struct ChangeFit {
  PictureChange change;
  double left = std::numeric_limits<double>::infinity();  ///< the root mean square between the blocks
  double contrast = 0;  ///< the smaller standard deviation of the blocks of the two pictures

  /// At most a tenth of the contrast is left.
  bool explains() const;
  /// At least a two-hundredth of the contrast is left.
  bool isWorthACause() const;
  /// It leaves so much less than one with fewer parts, which leaves enough, that it replaces that one.
  bool replaces(const ChangeFit& simpler) const;
};

/// The sizes are equal, or those of a picture turned by 90 degrees, and there are enough blocks.
bool areComparable(const LoadedPicture& reference, const LoadedPicture& test);

/// The best change without a shift for each number of parts from 0 to 3. Precondition: areComparable().
std::array<ChangeFit, 4> bestChanges(const LoadedPicture& reference, const LoadedPicture& test);

/// The root mean square that is left of the difference after the change, in the unit of the difference.
/// Rounding to levels and the pixels at the border do not count. Infinite if the change makes another size.
/// Precondition: areComparable().
double rmseAfter(const PictureChange& change, const LoadedPicture& reference, const LoadedPicture& test);

/// The share of the pixels' RMSE that the nearest change or variant may leave.
constexpr double kMostLeftOfNearest = 0.75;

/// The colour of all pixels of a picture; nothing if there are several.
std::optional<Color> onlyColor(const Picture& picture);

/// The change with the curve that leaves least of the pixels, if that leaves less than half: curves that are
/// nearly alike cannot be told apart by blocks. Precondition: areComparable().
PictureChange withSharpestCurve(const PictureChange& change, const LoadedPicture& reference,
                                const LoadedPicture& test);

struct DifferenceCause {
  PictureChange change;
  /// The error that is left when the change is undone, beyond that of rounding to levels; in the unit of the
  /// difference. The pixels at the border do not count.
  double rmse = 0;
  double before = 0;       ///< the same error with nothing undone; infinite if the sizes differ
  bool isNearest = false;  ///< it leaves more than a cause may
};

/// The cause of the difference of two pictures, if one change of the whole picture explains it. A level
/// stands for all values that round to it or are truncated to it, so that a curve that is undone leaves
/// nothing.
///
/// The pictures are compared by means of blocks of 8 x 8 pixels (smaller ones below 64 pixels, larger ones
/// above 1024), where noise and steps of edges cancel. The rule: of all changes with the same number of parts
/// the best counts. It replaces one with fewer parts only if it leaves at most a quarter of that one's
/// difference. Interpolation cannot restore the edges of a shifted picture, so a shift is added if it leaves
/// at most three quarters and the opposite shift would leave five quarters. The change is named if it leaves
/// at most a tenth of the contrast, which is the smaller standard deviation of the blocks of the two
/// pictures. In the end at most half of the pixels' RMSE is left, or three quarters after a shift of half a
/// pixel; one that leaves more, but at most three quarters, is the nearest. No cause is named for a picture
/// of one colour, for fewer than 25 blocks, or for a difference below a two-hundredth of the contrast.
///
/// The sizes must be equal, or those of a picture turned by 90 degrees; else there is no cause. Values that
/// are not finite count as 0. Throws Error(Fault::limit) if the time is over.
std::optional<DifferenceCause> causeOfDifference(const LoadedPicture& reference, const LoadedPicture& test);

/// One sentence without a full stop: "mine.png is ref.png upside down; nothing else differs beyond rounding",
/// "mine.png is most like ref.png with its values times 0.7; apart from that, RMSE 5 of 9 levels".
std::string causeText(const DifferenceCause& cause, const std::string& reference, const std::string& test,
                      std::string_view unit);

/// "mine.png is black: all its pixels are 0".
std::string onlyColorText(const Color& color, const std::string& name, std::string_view unit);

/// The rest of a difference in words: "nothing else differs beyond rounding", "apart from that, RMSE 3.1 of 9
/// levels". `before` is the whole difference, infinite if it is not known.
std::string leftText(double rmse, double before, std::string_view unit);

}  // namespace trace
