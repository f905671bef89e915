#include "image/development/denoise.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/budget.h"

namespace trace {
namespace {

constexpr int kReach = 8;                            // pixels to each side that are averaged
constexpr int kPatch = 3;                            // to each side of what is compared
constexpr int kSmallPatch = 1;                       // likewise beside an edge, which a large patch contains
constexpr int kRows = 16;                            // rows of a chunk
constexpr int kNoiseReach = 4;                       // over which the noise of halves is averaged
constexpr float kColours = 0.45f, kSurfaces = 0.6f;  // how far apart is alike still; both papers'
constexpr float kLeastSlope = 1e-3f;                 // least slope of features, squared
constexpr double kDarkest = 0.1;                     // surface by whose colour light is divided
constexpr double kEnough = 10;                       // pixels of like surfaces whose mean is calm

constexpr float kTooFar = 8;  // how far apart is not alike at all

/// The weight of a pixel that is so far apart: nearly exp(-apart), and nothing from kTooFar on.
float weightOf(float apart) {
  float weight = 1 - apart / kTooFar;
  for (int i = 0; i < 3; ++i) weight *= weight;  // to the eighth
  return weight;
}

/// A picture of floats: three channels, one after the other.
struct Plane {
  int width = 0, height = 0;
  std::vector<float> values;
  Plane(int w, int h)
      : width(w), height(h), values(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
  float* row(int y) { return values.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width); }
  const float* row(int y) const {
    return values.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
  }
};
using Channels = std::array<Plane, 3>;

/// A plane that repeats its border, for offsets that lead beyond it.
struct Bordered {
  static constexpr int kBorder = kReach + kPatch;
  int stride;
  std::vector<float> values;
  explicit Bordered(const Plane& plane)
      : stride(plane.width + 2 * kBorder),
        values(static_cast<std::size_t>(stride) * static_cast<std::size_t>(plane.height + 2 * kBorder)) {
    for (int y = -kBorder; y < plane.height + kBorder; ++y) {
      const float* from = plane.row(std::clamp(y, 0, plane.height - 1));
      float* to = values.data() + start(y);
      for (int x = -kBorder; x < plane.width + kBorder; ++x) to[x] = from[std::clamp(x, 0, plane.width - 1)];
    }
  }
  std::ptrdiff_t start(int y) const { return std::ptrdiff_t{y + kBorder} * stride + kBorder; }
  const float* row(int y) const { return values.data() + start(y); }
};

Channels channelsOf(const Picture& picture) {
  Channels channels{Plane(picture.width, picture.height), Plane(picture.width, picture.height),
                    Plane(picture.width, picture.height)};
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    checkBudget();
    const Color& c = picture.pixels[i];
    channels[0].values[i] = static_cast<float>(c.r);
    channels[1].values[i] = static_cast<float>(c.g);
    channels[2].values[i] = static_cast<float>(c.b);
  }
  return channels;
}

/// The mean of the values around each pixel.
Plane blurred(const Plane& plane) {
  Plane across(plane.width, plane.height), both(plane.width, plane.height);
  for (int y = 0; y < plane.height; ++y)
    for (int x = 0; x < plane.width; ++x) {
      checkBudget();
      const int first = std::max(0, x - kNoiseReach), last = std::min(plane.width - 1, x + kNoiseReach);
      float sum = 0;
      for (int i = first; i <= last; ++i) sum += plane.row(y)[i];
      across.row(y)[x] = sum / static_cast<float>(last - first + 1);
    }
  for (int y = 0; y < plane.height; ++y) {
    lookAtBudget();
    const int first = std::max(0, y - kNoiseReach), last = std::min(plane.height - 1, y + kNoiseReach);
    for (int i = first; i <= last; ++i)
      for (int x = 0; x < plane.width; ++x) both.row(y)[x] += across.row(i)[x];
    for (int x = 0; x < plane.width; ++x) both.row(y)[x] /= static_cast<float>(last - first + 1);
  }
  return both;
}

/// The variance of the mean of all samples in one channel: as independent samples would have it for their
/// luminance, times how much the channel of the two halves is apart against that.
Plane varianceOf(const Halves& halves, double Color::*channel) {
  const int width = halves.first.width, height = halves.first.height;
  Plane told(width, height), found(width, height);
  for (std::size_t i = 0; i < told.values.size(); ++i) {
    checkBudget();
    const double share = halves.share[i];
    if (share == 0) continue;
    const double apart = halves.first.pixels[i].*channel - halves.second.pixels[i].*channel;
    told.values[i] = static_cast<float>(halves.variance[i]);
    found.values[i] = static_cast<float>(apart * apart * share * (1 - share));
  }
  const Plane mean = blurred(told), near = blurred(found);
  for (std::size_t i = 0; i < told.values.size(); ++i)
    if (mean.values[i] > 0) told.values[i] *= near.values[i] / mean.values[i];
  return told;
}

/// A feature: what a pixel has of it, and how much counts as a difference there.
struct Feature {
  Channels values;
  Plane tolerance;  ///< squared
  int channels;

  Feature(const Picture& picture, int count)
      : values(channelsOf(picture)), tolerance(picture.width, picture.height), channels(count) {
    for (int y = 0; y < picture.height; ++y)
      for (int x = 0; x < picture.width; ++x) {
        checkBudget();
        float slope = 0;
        for (int c = 0; c < channels; ++c) {
          const Plane& v = values[static_cast<std::size_t>(c)];
          const float dx = v.row(y)[std::min(x + 1, v.width - 1)] - v.row(y)[std::max(x - 1, 0)];
          const float dy = v.row(std::min(y + 1, v.height - 1))[x] - v.row(std::max(y - 1, 0))[x];
          slope += (dx * dx + dy * dy) / 4;
        }
        const float middle = values[0].row(y)[x];
        const float least =
            channels == 1 ? kLeastSlope * middle * middle : kLeastSlope;  // for a depth, relative to it
        tolerance.row(y)[x] = std::max(slope, least) * kSurfaces * kSurfaces;
      }
  }

  /// How far two pixels are apart, in tolerances of the first.
  float apart(int x, int y, int u, int v) const {
    float sum = 0;
    for (int c = 0; c < channels; ++c) {
      const Plane& plane = values[static_cast<std::size_t>(c)];
      const float d = plane.row(y)[x] - plane.row(v)[u];
      sum += d * d;
    }
    return sum > 0 ? sum / tolerance.row(y)[x] : 0;
  }
};

/// The colour by which the light of a pixel is divided before it is averaged with that of others.
Color surfaceColor(const Color& albedo) {
  return {std::max(albedo.r, kDarkest), std::max(albedo.g, kDarkest), std::max(albedo.b, kDarkest)};
}

Color ratio(const Color& a, const Color& b) { return {a.r / b.r, a.g / b.g, a.b / b.b}; }

/// Light over the colours of surfaces.
Halves withoutSurfaces(const Halves& halves, const Picture& albedo) {
  Halves light = halves;
  for (std::size_t i = 0; i < albedo.pixels.size(); ++i) {
    checkBudget();
    const Color by = surfaceColor(albedo.pixels[i]);
    light.first.pixels[i] = ratio(halves.first.pixels[i], by);
    light.second.pixels[i] = ratio(halves.second.pixels[i], by);
    light.variance[i] /= luminanceOf(by) * luminanceOf(by);
  }
  return light;
}

struct Filter {
  Filter(const Halves& halves, const NoiseGuides& guides)
      : width(halves.first.width),
        height(halves.first.height),
        share(halves.share),
        features{Feature(guides.normal, 3), Feature(guides.nearness, 1)} {
    for (const Picture* picture : {&halves.first, &halves.second})
      for (const Plane& plane : channelsOf(*picture)) half[picture == &halves.second].emplace_back(plane);
    constexpr double Color::*kChannels[] = {&Color::r, &Color::g, &Color::b};
    for (double Color::*channel : kChannels) {
      const Plane both = varianceOf(halves, channel);
      Plane first = both, second = both;
      for (std::size_t i = 0; i < share.size(); ++i) {
        const auto part = static_cast<float>(share[i] > 0 ? share[i] : 0.5);
        first.values[i] /= part;
        second.values[i] /= 1 - part;
      }
      noise[0].emplace_back(first);
      noise[1].emplace_back(second);
    }
  }

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
  bool known(int x, int y) const { return share[index(x, y)] > 0; }

  /// How far the colours of a half are apart at the pixels of a row, from kPatch before its first, and at the
  /// offset from there, against their noise.
  void apart(int which, int y, int dx, int dy, float* result) const {
    const auto w = static_cast<std::size_t>(which);
    const int count = width + 2 * kPatch;
    std::fill_n(result, count, 0.0f);
    for (std::size_t c = 0; c < 3; ++c) {
      const float *p = noise[w][c].row(y) - kPatch, *q = noise[w][c].row(y + dy) + dx - kPatch;
      const float *a = half[w][c].row(y) - kPatch, *b = half[w][c].row(y + dy) + dx - kPatch;
      for (int x = 0; x < count; ++x) {  // without a branch, so that compilers take several at once
        const float d = a[x] - b[x], both = p[x] + q[x], least = (both - std::abs(p[x] - q[x])) / 2;
        result[x] += (d * d - (p[x] + least)) / (1e-10f + kColours * kColours * both);
      }
    }
  }

  int width, height;
  const std::vector<double>& share;
  std::array<std::vector<Bordered>, 2> half;   ///< three channels each
  std::array<std::vector<Bordered>, 2> noise;  ///< variances
  std::array<Feature, 2> features;
};

/// A weighted mean of pixels.
struct Sum {
  std::array<float, 3> color{};
  float weight = 0, squares = 0;
  void add(const std::array<float, 3>& c, float by) {
    for (std::size_t i = 0; i < 3; ++i) color[i] += c[i] * by;
    weight += by;
    squares += by * by;
  }
  Color mean() const { return Color(color[0], color[1], color[2]) / weight; }
  /// So many pixels of equal weight are as calm.
  double count() const { return weight * weight / squares; }
};

struct Sums {
  Sum ofPatch, ofSmallPatch;  ///< by patches and surfaces
  Sum ofColors;               ///< by the patch without surfaces
  /// Each makes up for those before it, as far as these have too few pixels to be calm.
  Color mean() const {
    Color mean = ofColors.mean();
    for (const Sum* sum : {&ofSmallPatch, &ofPatch})
      if (sum->weight > 0)
        mean = lerp(std::max(0.0, (kEnough - sum->count()) / (kEnough - 1)), sum->mean(), mean);
    return mean;
  }
};

/// The rows y0 <= y < y1 of the result.
class FilteredRows {
 public:
  FilteredRows(const Filter& filter, int y0, int y1)
      : f_(filter),
        y0_(y0),
        y1_(y1),
        alone_(static_cast<std::size_t>(y1 - y0) * static_cast<std::size_t>(f_.width), 0),
        apart_(f_.width + 2 * kPatch, y1 - y0 + 2 * kPatch),
        across_(f_.width, apart_.height) {
    for (auto& all : sums_) all.resize(alone_.size());
    compare(kPatch);
    if (findAlone()) compare(kSmallPatch);
  }

  void store(Picture& result) const {
    for (int y = y0_; y < y1_; ++y)
      for (int x = 0; x < f_.width; ++x) {
        if (!f_.known(x, y)) continue;
        const double first = f_.share[f_.index(x, y)];
        result.at(x, y) = sums_[0][at(x, y)].mean() * first + sums_[1][at(x, y)].mean() * (1 - first);
      }
  }

 private:
  std::size_t at(int x, int y) const { return f_.index(x, y - y0_); }

  /// Compares all pixels with those within reach by their patches; with small ones those that are alone.
  void compare(int reach) {
    for (int dy = -kReach; dy <= kReach; ++dy)
      for (int dx = -kReach; dx <= kReach; ++dx)
        for (int which = 0; which < 2; ++which) {
          lookAtBudget();
          measure(which, dx, dy, reach);
          for (int y = y0_; y < y1_; ++y)
            for (int x = 0; x < f_.width; ++x)
              if (reach == kPatch || alone_[at(x, y)]) weigh(which, x, y, x + dx, y + dy, reach);
        }
  }

  /// How far pixels are apart at an offset, and the sums across patches.
  void measure(int which, int dx, int dy, int reach) {
    for (int y = 0; y < apart_.height; ++y) {
      f_.apart(which, y0_ + y - kPatch, dx, dy, apart_.row(y));
      for (int x = 0; x < f_.width; ++x) {
        float sum = 0;
        for (int i = kPatch - reach; i <= kPatch + reach; ++i) sum += apart_.row(y)[x + i];
        across_.row(y)[x] = sum;
      }
    }
  }

  /// Adds the pixel (u, v) to the mean of (x, y), in the half that did not decide.
  void weigh(int which, int x, int y, int u, int v, int reach) {
    if (u < 0 || v < 0 || u >= f_.width || v >= f_.height || !f_.known(x, y) || !f_.known(u, v)) return;
    float patch = 0;
    for (int j = kPatch - reach; j <= kPatch + reach; ++j) patch += across_.row(y - y0_ + j)[x];
    patch = std::max(0.0f, patch / static_cast<float>((2 * reach + 1) * (2 * reach + 1) * 3));
    if (patch >= kTooFar) return;
    float all = patch;
    for (const Feature& feature : f_.features) all = std::max(all, feature.apart(x, y, u, v));
    const std::vector<Bordered>& other = f_.half[static_cast<std::size_t>(1 - which)];
    const std::array<float, 3> color{other[0].row(v)[u], other[1].row(v)[u], other[2].row(v)[u]};
    Sums& sums = sums_[1 - which][at(x, y)];
    if (all < kTooFar) (reach == kPatch ? sums.ofPatch : sums.ofSmallPatch).add(color, weightOf(all));
    if (reach == kPatch) sums.ofColors.add(color, weightOf(patch));
  }

  /// The pixels that have too few like them by the whole patch; false if there are none.
  bool findAlone() {
    bool any = false;
    for (int y = y0_; y < y1_; ++y)
      for (int x = 0; x < f_.width; ++x) {
        const std::size_t i = at(x, y);
        if (!f_.known(x, y) || std::min(sums_[0][i].ofPatch.count(), sums_[1][i].ofPatch.count()) >= kEnough)
          continue;
        alone_[i] = any = true;
      }
    return any;
  }

  const Filter& f_;
  int y0_, y1_;
  std::vector<Sums> sums_[2];  // for each half
  std::vector<char> alone_;
  Plane apart_;   // with kPatch around the rows
  Plane across_;  // sums of a patch's width
};

}  // namespace

Picture withoutNoise(const Halves& halves, const NoiseGuides& guides, int threads, Job& job) {
  Picture result(halves.first.width, halves.first.height);
  const Halves light = withoutSurfaces(halves, guides.albedo);
  const Filter filter(light, guides);
  parallelChunks((result.height + kRows - 1) / kRows, threads, job, [&](std::int64_t chunk, int) {
    const int y0 = static_cast<int>(chunk) * kRows;
    FilteredRows(filter, y0, std::min(y0 + kRows, result.height)).store(result);
  });
  for (std::size_t i = 0; i < result.pixels.size(); ++i)
    result.pixels[i] = result.pixels[i] * surfaceColor(guides.albedo.pixels[i]);
  return result;
}

}  // namespace trace
