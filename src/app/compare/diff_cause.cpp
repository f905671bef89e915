// The search for the change that makes one picture of another: see diff_cause.h. Beside the life of a
// picture; it serves `ray diff` and `ray grade`.
//
// All changes but curves are linear and permute blocks, so each curve costs one pass over the pixels and the
// turns and orders of channels only one over the blocks. The same holds of shifts: the blocks of a picture
// that is shifted by half a pixel are means of those of pictures shifted by whole ones.
#include "app/compare/diff_cause.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "base/budget.h"
#include "image/srgb.h"
#include "math/elementary.h"

namespace trace {
namespace {

using Curve = PictureChange::Curve;

constexpr PictureChange::Turn kTurns[] = {
    {""},
    {"mirrored left to right", true, false},
    {"upside down", false, true},
    {"turned by 180 degrees", true, true},
    {"with rows and columns exchanged", false, false, true},
    {"turned by 90 degrees clockwise", true, false, true},
    {"turned by 90 degrees counterclockwise", false, true, true},
    {"mirrored at its rising diagonal", true, true, true},
};

constexpr PictureChange::Channels kChannelOrders[] = {
    {"RGB", ""},
    {"BGR", "with red and blue exchanged", {2, 1, 0}},
    {"GRB", "with red and green exchanged", {1, 0, 2}},
    {"RBG", "with green and blue exchanged", {0, 2, 1}},
    {"GBR", "with its channels in the order green, blue, red", {1, 2, 0}},
    {"BRG", "with its channels in the order blue, red, green", {2, 0, 1}},
};

constexpr double kLevel = 1.0 / 255;
constexpr int kLargestBlock = 8, kMostBlocks = 128;
constexpr std::size_t kLeastBlocks = 25;
constexpr double kDecisive = 0.25;          // the share of the difference that may be left
constexpr double kDecisiveShift = 0.75;     // the same for a shift
constexpr double kMostLeftOfCause = 0.5;    // the share of the pixels' difference that a cause may leave
constexpr double kMostLeftOfHalves = 0.75;  // the same for a shift of half a pixel, which blurs edges
constexpr double kSharper = 0.5;            // the share that a sharper curve may leave
constexpr double kOpposite = 1.25;          // the share that the opposite shift must leave at least
constexpr double kLeftOfContrast = 0.1;     // the share of the contrast that may be left
constexpr double kWorthwhile = 1.0 / 200;   // the least share of the contrast that needs a cause
constexpr double kLeastContrast = 2 * kLevel;
constexpr double kMiddles = 1e-4;  // chooses among changes that rounding alone cannot tell apart
constexpr double kMostBrightening = 32, kLeastBrightening = 1.005;

/// The values that a channel of a pixel, or of a mean of pixels, may have had before it was rounded.
struct ValueSpan {
  Color low, high;

  ValueSpan& operator+=(const ValueSpan& other) {
    low += other.low;
    high += other.high;
    return *this;
  }
};

double channelOf(const Color& c, int channel) { return channel == 0 ? c.r : channel == 1 ? c.g : c.b; }

/// A curve that brightens, or none.
struct Brightening {
  Curve curve = Curve::none;
  double factor = 1;

  double operator()(double value) const {
    const double v = std::max(value, 0.0);
    switch (curve) {
      case Curve::none: return value;
      case Curve::srgb: return encoded(v);
      case Curve::gamma22: return math::pow(v, 1 / 2.2);
      case Curve::gamma18: return math::pow(v, 1 / 1.8);
      case Curve::scale: return value * factor;
      case Curve::lightScale: return encoded(linearOfSrgb(v) * factor);
    }
    return value;
  }

 private:
  /// srgbOfLinear() without the end at 1.
  static double encoded(double v) {
    return v <= 0.0031308 ? 12.92 * v : 1.055 * math::pow(v, 1 / 2.4) - 0.055;
  }
};

/// The pixels of a picture after a curve. `ofScreen`: one of the two pictures ends at 1, so both do.
class CurvedPixels {
 public:
  CurvedPixels(const LoadedPicture& loaded, bool ofScreen, const Brightening& curve)
      : picture_(loaded.picture), levels_(loaded.levels), ofScreen_(ofScreen), curve_(curve) {
    if (!levels_) return;
    for (std::size_t level = 0; level < ofLevel_.size(); ++level) {
      const double value = static_cast<double>(level) * kLevel;
      ofLevel_[level] = {curved(value - kLevel / 2).low, curved(value + kLevel).high};
    }
  }

  int width() const { return picture_.width; }
  int height() const { return picture_.height; }
  ValueSpan operator()(int x, int y) const {
    const Color& c = picture_.at(x, y);
    const Ends r = of(c.r), g = of(c.g), b = of(c.b);
    return {{r.low, g.low, b.low}, {r.high, g.high, b.high}};
  }

 private:
  struct Ends {
    double low = 0, high = 0;
  };

  Ends of(double value) const {
    return levels_ ? ofLevel_[toLevel(value, Rounding::nearest)] : curved(std::isfinite(value) ? value : 0);
  }
  Ends curved(double value) const {
    const double result = curve_(value);
    if (!ofScreen_) return {result, result};
    return {std::clamp(result, -kLevel / 2, 1 - kLevel / 2), std::clamp(result, 0.0, 1 + kLevel)};
  }

  const Picture& picture_;
  bool levels_, ofScreen_;
  Brightening curve_;
  std::array<Ends, 256> ofLevel_{};
};

/// The first pixels of the blocks of one axis, and the end of the last. They lie symmetrically: their number
/// is odd, and the middle one takes the pixels that are left over. A pixel at each border is left out.
std::vector<int> blockStarts(int pixels, int size) {
  const int count = (pixels - 2) / size - 1 + (pixels - 2) / size % 2;
  std::vector<int> starts;
  for (int i = 0; i <= count / 2; ++i) starts.push_back(1 + i * size);
  for (int i = count / 2 + 1; i <= count; ++i) starts.push_back(pixels - 1 - (count - i) * size);
  return starts;
}

int blockSize(int width, int height) {
  const int wanted = std::clamp(std::min(width, height) / 8, 1, kLargestBlock);
  return std::max(wanted, std::max(width, height) / kMostBlocks);
}

/// The mean of each block.
struct BlockMeans {
  int columns = 0, rows = 0;
  std::vector<ValueSpan> means;

  const ValueSpan& at(int x, int y) const {
    return means[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns) +
                 static_cast<std::size_t>(x)];
  }
};

/// The blocks of the picture whose pixel (x, y) is that at (x + right, y + down); both from -1 to 1.
BlockMeans blocksOf(const CurvedPixels& pixels, int right = 0, int down = 0) {
  const int size = blockSize(pixels.width(), pixels.height());
  const std::vector<int> columns = blockStarts(pixels.width(), size),
                         rows = blockStarts(pixels.height(), size);
  BlockMeans blocks{static_cast<int>(columns.size()) - 1, static_cast<int>(rows.size()) - 1, {}};
  for (std::size_t row = 0; row + 1 < rows.size(); ++row)
    for (std::size_t column = 0; column + 1 < columns.size(); ++column) {
      checkBudget();
      ValueSpan sum;
      for (int y = rows[row]; y < rows[row + 1]; ++y)
        for (int x = columns[column]; x < columns[column + 1]; ++x) sum += pixels(x + right, y + down);
      const double count = static_cast<double>(rows[row + 1] - rows[row]) *
                           static_cast<double>(columns[column + 1] - columns[column]);
      blocks.means.push_back({sum.low / count, sum.high / count});
    }
  return blocks;
}

BlockMeans meanOf(const BlockMeans& a, const BlockMeans& b) {
  BlockMeans result = a;
  for (std::size_t i = 0; i < result.means.size(); ++i) {
    ValueSpan& mean = result.means[i] += b.means[i];
    mean = {mean.low / 2, mean.high / 2};
  }
  return result;
}

/// The standard deviation of the blocks, over all channels; 0 if it is below two levels, or, where there are
/// none, the same share of the brightest block. Such blocks are of one colour.
double contrastOf(const BlockMeans& blocks, bool ofScreen) {
  Color sum;
  double brightest = ofScreen ? 1 : 0;
  for (const ValueSpan& span : blocks.means) {
    sum += (span.low + span.high) / 2;
    if (!ofScreen) brightest = std::max(brightest, maxComponent(span.high));
  }
  const double count = static_cast<double>(blocks.means.size());
  const Color mean = sum / count;
  double squares = 0;
  for (const ValueSpan& span : blocks.means)
    for (int c = 0; c < 3; ++c) {
      const double d = (channelOf(span.low, c) + channelOf(span.high, c)) / 2 - channelOf(mean, c);
      squares += d * d;
    }
  const double contrast = std::sqrt(squares / (3 * count));
  return std::isfinite(contrast) && contrast >= kLeastContrast * brightest ? contrast : 0;
}

/// The sum of the squares of the gaps between the channels; `middles` is what the distance of the middles of
/// the spans counts besides.
double gapSquared(const ValueSpan& reference, const ValueSpan& test, const PictureChange::Channels& channels,
                  double middles) {
  double sum = 0;
  for (int c = 0; c < 3; ++c) {
    const int from = channels.order[static_cast<std::size_t>(c)];
    const double below = channelOf(reference.low, from) - channelOf(test.high, c);
    const double above = channelOf(test.low, c) - channelOf(reference.high, from);
    const double gap = std::max({0.0, below, above}), distance = (above - below) / 2;
    sum += gap * gap + middles * distance * distance;
  }
  return sum;
}

/// Where (x, y) of the turned picture of this size comes from.
std::pair<int, int> turnedFrom(const PictureChange::Turn& turn, int x, int y, int width, int height) {
  const int u = turn.mirrorX ? width - 1 - x : x, v = turn.mirrorY ? height - 1 - y : y;
  return turn.swapAxes ? std::pair{v, u} : std::pair{u, v};
}

/// The root of the mean square of what is left between the blocks.
double leftBetween(const BlockMeans& reference, const BlockMeans& test, const PictureChange::Turn& turn,
                   const PictureChange::Channels& channels) {
  double sum = 0;
  for (int y = 0; y < test.rows; ++y)
    for (int x = 0; x < test.columns; ++x) {
      const auto [u, v] = turnedFrom(turn, x, y, test.columns, test.rows);
      sum += gapSquared(reference.at(u, v), test.at(x, y), channels, kMiddles);
    }
  return std::sqrt(sum / (3 * static_cast<double>(test.means.size())));
}

bool fits(const PictureChange::Turn& turn, const Picture& reference, const Picture& test) {
  return turn.swapAxes ? reference.width == test.height && reference.height == test.width
                       : reference.width == test.width && reference.height == test.height;
}

/// Both pictures with the curve on the darker one.
struct CurvedPair {
  CurvedPair(const LoadedPicture& a, const LoadedPicture& b, const PictureChange& change)
      : reference(a, ofScreen(a, b), on(change, !change.darkens)),
        test(b, ofScreen(a, b), on(change, change.darkens)) {}

  static bool ofScreen(const LoadedPicture& a, const LoadedPicture& b) { return a.levels || b.levels; }
  static Brightening on(const PictureChange& change, bool changes) {
    if (!changes) return {};
    return {change.curve, change.darkens ? 1 / change.factor : change.factor};
  }

  CurvedPixels reference, test;
};

/// The root of the mean square of what is left between the pixels away from the border.
double leftBetween(const CurvedPair& pair, const PictureChange& change) {
  const int firstX = static_cast<int>(std::floor(change.right)),
            lastX = static_cast<int>(std::ceil(change.right));
  const int firstY = static_cast<int>(std::floor(change.down)),
            lastY = static_cast<int>(std::ceil(change.down));
  const double count = (lastX - firstX + 1) * (lastY - firstY + 1);
  const int width = pair.test.width(), height = pair.test.height();
  double sum = 0;
  for (int y = 1; y + 1 < height; ++y) {
    checkBudget();
    for (int x = 1; x + 1 < width; ++x) {
      ValueSpan test;
      for (int dy = firstY; dy <= lastY; ++dy)
        for (int dx = firstX; dx <= lastX; ++dx) test += pair.test(x + dx, y + dy);
      const auto [u, v] = turnedFrom(change.turn, x, y, width, height);
      sum += gapSquared(pair.reference(u, v), {test.low / count, test.high / count}, change.channels, 0);
    }
  }
  return std::sqrt(sum / (3.0 * (width - 2) * (height - 2)));
}

/// How often each level occurs.
std::array<double, 256> levelCounts(const Picture& picture) {
  std::array<double, 256> counts{};
  for (const Color& c : picture.pixels)
    for (int channel = 0; channel < 3; ++channel) ++counts[toLevel(channelOf(c, channel), Rounding::nearest)];
  return counts;
}

/// The mean after the curve, of a picture with these levels; a level stands for the middle of its span.
double meanAfter(const Brightening& curve, const std::array<double, 256>& counts) {
  double sum = 0, count = 0;
  for (std::size_t level = 0; level < counts.size(); ++level) {
    const double value = level == 0 ? 0 : (static_cast<double>(level) + 0.25) * kLevel;
    sum += counts[level] * std::min(curve(value), 1.0);
    count += counts[level];
  }
  return sum / count;
}

double finiteMean(const Picture& picture) {
  double sum = 0;
  for (const Color& c : picture.pixels)
    for (int channel = 0; channel < 3; ++channel)
      if (std::isfinite(channelOf(c, channel))) sum += channelOf(c, channel);
  return sum / (3 * static_cast<double>(picture.pixels.size()));
}

/// The factor that brings the mean of the darker picture to that of the brighter one; 1 if there is none.
double factorBetween(const LoadedPicture& darker, const LoadedPicture& brighter, Curve curve) {
  if (!darker.levels || !brighter.levels) {
    if (curve == Curve::lightScale) return 1;
    const double factor = finiteMean(brighter.picture) / finiteMean(darker.picture);
    return factor <= kMostBrightening ? factor : 1;
  }
  const std::array<double, 256> from = levelCounts(darker.picture);
  const double wanted = meanAfter({}, levelCounts(brighter.picture));
  double low = 1, high = kMostBrightening;
  if (!(meanAfter({curve, low}, from) < wanted && wanted < meanAfter({curve, high}, from))) return 1;
  for (int i = 0; i < 40; ++i) {
    const double middle = (low + high) / 2;
    (meanAfter({curve, middle}, from) < wanted ? low : high) = middle;
  }
  return (low + high) / 2;
}

/// No curve, then each curve in both directions, and the scales in the one that fits.
std::vector<PictureChange> curvesBetween(const LoadedPicture& reference, const LoadedPicture& test) {
  std::vector<PictureChange> changes(1);
  for (Curve curve : {Curve::srgb, Curve::gamma22, Curve::gamma18})
    for (bool darkens : {false, true}) {
      PictureChange& change = changes.emplace_back();
      change.curve = curve;
      change.darkens = darkens;
    }
  for (Curve curve : {Curve::scale, Curve::lightScale})
    for (bool darkens : {false, true}) {
      const double factor = factorBetween(darkens ? test : reference, darkens ? reference : test, curve);
      if (!(factor >= kLeastBrightening)) continue;
      PictureChange& change = changes.emplace_back();
      change.curve = curve;
      change.darkens = darkens;
      change.factor = darkens ? 1 / factor : factor;
    }
  return changes;
}

/// The blocks of both pictures under a curve.
struct CurvedBlocks {
  CurvedBlocks(const PictureChange& change, const LoadedPicture& reference, const LoadedPicture& test)
      : curve(change) {
    const CurvedPair pair(reference, test, change);
    from = blocksOf(pair.reference);
    to = blocksOf(pair.test);
    const bool ofScreen = CurvedPair::ofScreen(reference, test);
    contrast = std::min(contrastOf(from, ofScreen), contrastOf(to, ofScreen));
  }

  ChangeFit with(const PictureChange::Turn& turn, const PictureChange::Channels& channels) const {
    ChangeFit candidate{curve, leftBetween(from, to, turn, channels), contrast};
    candidate.change.turn = turn;
    candidate.change.channels = channels;
    return candidate;
  }

  PictureChange curve;
  BlockMeans from, to;
  double contrast = 0;
};

/// The candidate with a shift, if it is decisive; else itself.
ChangeFit shifted(const ChangeFit& candidate, const LoadedPicture& reference, const LoadedPicture& test) {
  const CurvedPair pair(reference, test, candidate.change);
  const BlockMeans from = blocksOf(pair.reference);
  std::vector<BlockMeans> whole;  // rows, then columns, of shifts from -1 to 1
  for (int down = -1; down <= 1; ++down)
    for (int right = -1; right <= 1; ++right) whole.push_back(blocksOf(pair.test, right, down));
  // Halves are counted, from -2 to 2.
  const auto left = [&](int right, int down) {
    const auto row = [&](int y) {
      const auto index = [&](int x) { return static_cast<std::size_t>(3 * (y + 1) + x + 1); };
      const int half = right % 2;
      return half == 0 ? whole[index(right / 2)] : meanOf(whole[index(0)], whole[index(half)]);
    };
    const int half = down % 2;
    const BlockMeans to = half == 0 ? row(down / 2) : meanOf(row(0), row(half));
    return leftBetween(from, to, candidate.change.turn, candidate.change.channels);
  };
  ChangeFit best = candidate;
  int bestRight = 0, bestDown = 0;
  for (int down = -2; down <= 2; ++down)
    for (int right = -2; right <= 2; ++right) {
      const double found = left(right, down);
      if (!(found < best.left)) continue;
      best.left = found;
      bestRight = right;
      bestDown = down;
    }
  const bool decisive = best.left <= kDecisiveShift * candidate.left &&
                        left(-bestRight, -bestDown) >= kOpposite * candidate.left;
  if (!decisive) return candidate;
  best.change.right = bestRight / 2.0;
  best.change.down = bestDown / 2.0;
  return best;
}

/// The shifted candidate with the curve that leaves least. Without the shift, curves that are nearly alike
/// cannot be told apart.
ChangeFit withBestCurve(const ChangeFit& shiftedOne, const LoadedPicture& reference,
                        const LoadedPicture& test) {
  ChangeFit best = shiftedOne;
  for (const PictureChange& curve : curvesBetween(reference, test)) {
    if (curve.curve == Curve::none) continue;
    const PictureChange& change = shiftedOne.change;
    const ChangeFit other =
        shifted(CurvedBlocks(curve, reference, test).with(change.turn, change.channels), reference, test);
    const bool sameShift = other.change.right == change.right && other.change.down == change.down;
    if (sameShift && other.left < best.left) best = other;
  }
  return best;
}

bool hasHalves(const PictureChange& change) {
  return std::floor(change.right) != change.right || std::floor(change.down) != change.down;
}

}  // namespace

PictureChange withSharpestCurve(const PictureChange& change, const LoadedPicture& reference,
                                const LoadedPicture& test) {
  if (change.curve == Curve::none) return change;
  PictureChange best = change;
  double least = kSharper * rmseAfter(change, reference, test);
  for (const PictureChange& curve : curvesBetween(reference, test)) {
    if (curve.curve == Curve::none || least == 0) continue;
    PictureChange other = change;
    other.curve = curve.curve;
    other.darkens = curve.darkens;
    other.factor = curve.factor;
    if (const double left = rmseAfter(other, reference, test); left < least) {
      least = left;
      best = other;
    }
  }
  return best;
}

bool ChangeFit::explains() const { return contrast > 0 && left <= kLeftOfContrast * contrast; }
bool ChangeFit::isWorthACause() const { return left > kWorthwhile * contrast; }
bool ChangeFit::replaces(const ChangeFit& simpler) const {
  return simpler.isWorthACause() && left <= kDecisive * simpler.left;
}

bool areComparable(const LoadedPicture& reference, const LoadedPicture& test) {
  const Picture &a = reference.picture, &b = test.picture;
  const bool sameSize = a.width == b.width && a.height == b.height;
  if (!sameSize && !(a.width == b.height && a.height == b.width)) return false;
  const int size = blockSize(b.width, b.height);
  return b.width >= size + 2 && b.height >= size + 2 &&
         (blockStarts(b.width, size).size() - 1) * (blockStarts(b.height, size).size() - 1) >= kLeastBlocks;
}

std::array<ChangeFit, 4> bestChanges(const LoadedPicture& reference, const LoadedPicture& test) {
  std::array<ChangeFit, 4> best;
  for (const PictureChange& curve : curvesBetween(reference, test)) {
    const CurvedBlocks blocks(curve, reference, test);
    for (const PictureChange::Turn& turn : kTurns) {
      if (!fits(turn, reference.picture, test.picture)) continue;
      for (const PictureChange::Channels& channels : kChannelOrders) {
        const ChangeFit candidate = blocks.with(turn, channels);
        ChangeFit& found = best[static_cast<std::size_t>(candidate.change.parts())];
        // The first of equals is kept, though their sums were rounded differently.
        if (candidate.left < found.left - 1e-9 * blocks.contrast) found = candidate;
      }
    }
  }
  return best;
}

std::optional<Color> onlyColor(const Picture& picture) {
  if (picture.pixels.empty()) return {};
  const Color& first = picture.pixels.front();
  const bool isPlain = std::all_of(picture.pixels.begin(), picture.pixels.end(),
                                   [&](const Color& color) { return color == first; });
  return isPlain ? std::optional(first) : std::nullopt;
}

double rmseAfter(const PictureChange& change, const LoadedPicture& reference, const LoadedPicture& test) {
  if (!fits(change.turn, reference.picture, test.picture)) return std::numeric_limits<double>::infinity();
  const double left = leftBetween(CurvedPair(reference, test, change), change);
  return reference.levels && test.levels ? 255 * left : left;
}

std::optional<DifferenceCause> causeOfDifference(const LoadedPicture& reference, const LoadedPicture& test) {
  if (!areComparable(reference, test)) return std::nullopt;
  const std::array<ChangeFit, 4> best = bestChanges(reference, test);
  ChangeFit chosen = best[0];
  for (const ChangeFit& fit : best)
    if (fit.replaces(chosen)) chosen = fit;
  if (std::isfinite(chosen.left) && chosen.isWorthACause()) chosen = shifted(chosen, reference, test);
  const bool isShifted = chosen.change.right != 0 || chosen.change.down != 0;
  if (isShifted && chosen.change.curve != Curve::none) chosen = withBestCurve(chosen, reference, test);
  if (chosen.change.parts() == 0 || !chosen.explains()) return std::nullopt;

  DifferenceCause cause;
  cause.change = withSharpestCurve(chosen.change, reference, test);
  cause.before = rmseAfter({}, reference, test);
  cause.rmse = rmseAfter(cause.change, reference, test);
  const double mostLeft = hasHalves(cause.change) ? kMostLeftOfHalves : kMostLeftOfCause;
  cause.isNearest = cause.rmse > mostLeft * cause.before;
  if (!(cause.rmse < cause.before) || cause.rmse > kMostLeftOfNearest * cause.before) return std::nullopt;
  return cause;
}

}  // namespace trace
