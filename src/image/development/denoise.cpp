#include "image/development/denoise.h"

#include <algorithm>
#include <array>

#include "base/budget.h"
#include "math/elementary.h"

namespace trace {
namespace {

constexpr int kReach = 8;                            // pixels to each side that are averaged
constexpr int kPatch = 3;                            // to each side of what is compared
constexpr int kRows = 16;                            // rows of a chunk
constexpr int kNoiseReach = 4;                       // over which the noise of halves is averaged
constexpr float kColours = 0.45f, kSurfaces = 0.6f;  // how far apart is alike still; both papers'
constexpr float kLeastSlope = 1e-3f;                 // least slope of features, squared
constexpr double kDarkest = 0.1;                     // surface by whose colour light is divided
constexpr double kEnough = 10;                       // pixels of like surfaces whose mean is calm

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
        half{channelsOf(halves.first), channelsOf(halves.second)},
        noise{half[0], half[1]},
        features{Feature(guides.normal, 3), Feature(guides.nearness, 1)} {
    constexpr double Color::*kChannels[] = {&Color::r, &Color::g, &Color::b};
    for (std::size_t c = 0; c < 3; ++c) {
      const Plane both = varianceOf(halves, kChannels[c]);
      for (std::size_t i = 0; i < share.size(); ++i) {
        const auto first = static_cast<float>(share[i] > 0 ? share[i] : 0.5);
        noise[0][c].values[i] = both.values[i] / first;
        noise[1][c].values[i] = both.values[i] / (1 - first);
      }
    }
  }

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
  bool known(int x, int y) const { return share[index(x, y)] > 0; }

  /// How far the colours of a half are apart at (x, y) and at the offset from there, against their noise.
  float apart(int which, int x, int y, int dx, int dy) const {
    const int px = std::clamp(x, 0, width - 1), py = std::clamp(y, 0, height - 1);
    const int qx = std::clamp(px + dx, 0, width - 1), qy = std::clamp(py + dy, 0, height - 1);
    const auto w = static_cast<std::size_t>(which);
    float sum = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const float p = noise[w][c].row(py)[px], q = noise[w][c].row(qy)[qx];
      const float d = half[w][c].row(py)[px] - half[w][c].row(qy)[qx];
      sum += (d * d - (p + std::min(p, q))) / (1e-10f + kColours * kColours * (p + q));
    }
    return sum;
  }

  /// The rows y0 <= y < y1 of the result.
  void take(int y0, int y1, Picture& result) const;

  int width, height;
  const std::vector<double>& share;
  std::array<Channels, 2> half;
  std::array<Channels, 2> noise;  ///< variances
  std::array<Feature, 2> features;
};

void Filter::take(int y0, int y1, Picture& result) const {
  const int rows = y1 - y0;
  struct Sum {
    Color color;
    double weight = 0, squares = 0;
    void add(const Color& c, double by) {
      color += c * by;
      weight += by;
      squares += by * by;
    }
    Color mean() const { return color / weight; }  // each has at least the pixel itself
    double count() const { return weight * weight / squares; }
  };
  struct Sums {
    Sum byColors, byAll;
    /// So few pixels of like surfaces are calm only with others of like colours.
    Color mean() const {
      const double alone = std::max(0.0, (kEnough - byAll.count()) / (kEnough - 1));
      return lerp(alone, byAll.mean(), byColors.mean());
    }
  };
  std::vector<Sums> sums[2];
  for (auto& all : sums) all.resize(static_cast<std::size_t>(rows) * static_cast<std::size_t>(width));
  Plane apartHere(width + 2 * kPatch, rows + 2 * kPatch), across(width, rows + 2 * kPatch);
  constexpr float kInPatch = (2 * kPatch + 1) * (2 * kPatch + 1) * 3;
  constexpr float kTooFar = 20;  // counts less than 2e-9
  for (int dy = -kReach; dy <= kReach; ++dy)
    for (int dx = -kReach; dx <= kReach; ++dx)
      for (int which = 0; which < 2; ++which) {
        lookAtBudget();
        for (int y = 0; y < apartHere.height; ++y)
          for (int x = 0; x < apartHere.width; ++x)
            apartHere.row(y)[x] = apart(which, x - kPatch, y0 + y - kPatch, dx, dy);
        for (int y = 0; y < across.height; ++y)
          for (int x = 0; x < width; ++x) {
            float sum = 0;
            for (int i = 0; i <= 2 * kPatch; ++i) sum += apartHere.row(y)[x + i];
            across.row(y)[x] = sum;
          }
        const Channels& other = half[static_cast<std::size_t>(1 - which)];
        for (int y = y0; y < y1; ++y)
          for (int x = 0; x < width; ++x) {
            const int u = x + dx, v = y + dy;
            if (u < 0 || v < 0 || u >= width || v >= height || !known(x, y) || !known(u, v)) continue;
            float far = 0;
            for (int i = 0; i <= 2 * kPatch; ++i) far += across.row(y - y0 + i)[x];
            far = std::max(0.0f, far / kInPatch);
            if (far > kTooFar) continue;
            const Color color(other[0].row(v)[u], other[1].row(v)[u], other[2].row(v)[u]);
            const double byColors = math::exp(-static_cast<double>(far));
            Sums& sum = sums[1 - which][static_cast<std::size_t>(y - y0) * static_cast<std::size_t>(width) +
                                        static_cast<std::size_t>(x)];
            sum.byColors.add(color, byColors);
            float surfaces = far;
            for (const Feature& feature : features) surfaces = std::max(surfaces, feature.apart(x, y, u, v));
            if (surfaces > kTooFar) continue;
            sum.byAll.add(color, surfaces > far ? math::exp(-static_cast<double>(surfaces)) : byColors);
          }
      }
  for (int y = y0; y < y1; ++y)
    for (int x = 0; x < width; ++x) {
      if (!known(x, y)) continue;
      const std::size_t at =
          static_cast<std::size_t>(y - y0) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
      const double first = share[index(x, y)];
      result.at(x, y) = sums[0][at].mean() * first + sums[1][at].mean() * (1 - first);
    }
}

}  // namespace

Picture withoutNoise(const Halves& halves, const NoiseGuides& guides, int threads, Job& job) {
  Picture result(halves.first.width, halves.first.height);
  const Halves light = withoutSurfaces(halves, guides.albedo);
  const Filter filter(light, guides);
  parallelChunks((result.height + kRows - 1) / kRows, threads, job, [&](std::int64_t chunk, int) {
    const int y0 = static_cast<int>(chunk) * kRows;
    filter.take(y0, std::min(y0 + kRows, result.height), result);
  });
  for (std::size_t i = 0; i < result.pixels.size(); ++i)
    result.pixels[i] = result.pixels[i] * surfaceColor(guides.albedo.pixels[i]);
  return result;
}

}  // namespace trace
