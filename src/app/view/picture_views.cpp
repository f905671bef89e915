#include "app/view/picture_views.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/session/denoising.h"
#include "image/comparison/compare.h"
#include "image/comparison/false_color.h"
#include "math/elementary.h"
#include "math/vec.h"
#include "render/picture/passes.h"
#include "shading/texture.h"

namespace trace {

Bytes exposed(const Picture& picture, double stops, Rounding rounding) {
  if (stops == 0) return toBytes(picture, rounding);
  Picture bright = picture;
  const double factor = math::exp2(stops);
  for (Color& c : bright.pixels) c = c * factor;
  return toBytes(bright, rounding);
}

Color falseColour(double value) {
  static const Color kStops[] = {{0, 0, 0},         {0.1, 0.15, 0.75}, {0, 0.65, 0.35},
                                 {0.95, 0.85, 0.1}, {0.9, 0.1, 0.1},   {1, 1, 1}};
  constexpr int kSteps = static_cast<int>(std::size(kStops)) - 1;
  const double at = (value < 1 ? std::max(value, 0.0) : 1.0) * kSteps;  // NaN counts as 1
  const int step = std::min(static_cast<int>(at), kSteps - 1);
  return lerp(at - step, kStops[step], kStops[step + 1]);
}

namespace {

template <class... Args>
std::string formatted(const char* format, Args... args) {
  char text[160];
  std::snprintf(text, sizeof text, format, args...);
  return text;
}

/// The values in colours by the scale.
PlaneView heatMap(Picture values, ColourScale scale, std::string legend) {
  Picture colours = values;
  for (Color& c : colours.pixels) c = heatColor(scale.shareOf(c.r));
  return {std::move(colours), std::move(legend), scale, std::move(values)};
}

/// Least, mean and greatest of the values above 0.
struct ValueSpread {
  double least = kInfinity, most = 0, mean = 0;
};
ValueSpread spreadOf(const Picture& values) {
  ValueSpread spread;
  double sum = 0, count = 0;
  for (const Color& c : values.pixels) {
    if (c.r == 0) continue;  // outside the region, or not yet there
    spread.least = std::min(spread.least, c.r);
    spread.most = std::max(spread.most, c.r);
    sum += c.r;
    ++count;
  }
  if (count > 0) spread.mean = sum / count;
  return spread;
}

PlaneView samplesView(const Film& film) {
  Picture counts = film.sampleCounts();
  const ValueSpread spread = spreadOf(counts);
  if (spread.most == 0) return {std::move(counts), "no pixel has samples yet"};
  const ColourScale scale{spread.most, false, "rays"};
  if (spread.least == spread.most)
    return heatMap(std::move(counts), scale,
                   formatted("%.0f %s in every pixel", spread.most, spread.most == 1 ? "ray" : "rays"));
  return heatMap(std::move(counts), scale,
                 formatted("rays a pixel: %.0f to %.0f, which is white; %.4g on the average", spread.least,
                           spread.most, film.convergence().samples));
}

PlaneView noiseView(const Film& film) {
  constexpr double kWhite = 8;  // levels
  const Convergence so = film.convergence();
  if (!so.judged)
    return {Picture(film.width(), film.height()),
            "noise is not known: it needs two samples a pixel of its own"};
  Picture levels = film.errors();
  for (Color& c : levels.pixels) c = c * 255;
  return heatMap(std::move(levels), {kWhite, false, "levels"},
                 formatted("noise (standard error of the mean): white from %.0f levels on; %.3g on the "
                           "average",
                           kWhite, 255 * so.error));
}

PlaneView changeView(const Film& film, const Picture& shown) {
  constexpr double kWhite = 16;  // levels
  Picture by = change(film.picture(), shown);
  if (!film.keepsHalves()) return {std::move(by), "nothing was changed: denoise is off"};
  const double mean = meanChange(by);
  for (Color& c : by.pixels) c = Color(255 * std::max({std::abs(c.r), std::abs(c.g), std::abs(c.b)}));
  return heatMap(
      std::move(by), {kWhite, false, "levels"},
      formatted("what denoise changed: white from %.0f levels on; %.3g on the average", kWhite, mean));
}

PlaneView costView(const Film& film, const CostMap& cost) {
  if (cost.tests.width != film.width() || cost.tests.height != film.height())
    return {Picture(film.width(), film.height()), "the cost of each pixel is being measured"};
  const ValueSpread spread = spreadOf(cost.tests);
  return heatMap(cost.tests, {std::max(spread.most, 1.0), true, "tests"},
                 formatted("boxes and surfaces tested for a sample: %.3g to %.3g; %.3g on the average%s",
                           std::min(spread.least, spread.most), spread.most, spread.mean,
                           cost.block > 1 ? "; coarse, it is being measured" : ""));
}

}  // namespace

double ColourScale::shareOf(double value) const {
  return logarithmic ? math::log1p(value) / math::log1p(white) : value / white;
}

double ColourScale::valueAt(double share) const {
  return logarithmic ? math::pow(1 + white, share) - 1 : share * white;
}

std::string ColourScale::text(double value) const {
  return formatted(value >= 100 ? "%.0f" : "%.3g", value) + (unit.empty() ? "" : " " + std::string(unit));
}

PlaneView planeView(FilmPlane plane, const Film& film, const Picture& shown, const CostMap& cost) {
  switch (plane) {
    case FilmPlane::samples: return samplesView(film);
    case FilmPlane::noise: return noiseView(film);
    case FilmPlane::change: return changeView(film, shown);
    case FilmPlane::cost: return costView(film, cost);
    case FilmPlane::picture: break;
  }
  return {shown, ""};
}

std::vector<std::string_view> passesToSee(const Settings& settings) {
  std::vector<std::string_view> names;
  for (const PassRow* row : passesOf(settings))
    if (row->pass != Pass::object && row->pass != Pass::material) names.push_back(row->name);
  return names;
}

PlaneView passView(std::string_view pass, const Film& film, const Settings& settings, const PassNames& names,
                   const Picture& shown) {
  for (const PassRow* row : passesOf(settings)) {
    if (row->name != pass) continue;
    Picture values = valuesOf(*row, film, settings, names, shown);
    if (row->shown) values = row->shown(values, settings);
    return {clamped(std::move(values)), std::string(row->name) + ": " + std::string(row->help)};
  }
  return {shown, ""};
}

Picture resampled(const Picture& picture, int width, int height) {
  const auto across = static_cast<long long>(picture.width) * height,
             down = static_cast<long long>(width) * picture.height;
  if (picture.width < 1 || width < 1 || height < 1 || std::abs(across - down) > picture.width + width)
    return {};
  /// Adds the part of each old pixel that lies in a new one: mix(to, from, share).
  const auto cover = [](int from, int to, const auto& mix) {
    const double each = static_cast<double>(from) / to;
    for (int i = 0; i < to; ++i) {
      const double low = i * each, high = (i + 1) * each;
      for (int j = static_cast<int>(low); j < std::min(from, static_cast<int>(std::ceil(high))); ++j)
        if (const double share = (std::min(high, j + 1.0) - std::max(low, double(j))) / each; share > 0)
          mix(i, j, share);
    }
  };
  Picture narrow(width, picture.height), result(width, height);
  cover(picture.width, width, [&](int to, int from, double share) {
    for (int y = 0; y < picture.height; ++y) narrow.at(to, y) += picture.at(from, y) * share;
  });
  cover(picture.height, height, [&](int to, int from, double share) {
    for (int x = 0; x < width; ++x) result.at(x, to) += narrow.at(x, from) * share;
  });
  return result;
}

std::string convergenceText(const Convergence& convergence) {
  std::string text =
      formatted("%.4g %s a pixel", convergence.samples, convergence.samples == 1 ? "sample" : "samples");
  if (convergence.judged) text += formatted(", noise %.3g levels", 255 * convergence.error);
  return text;
}

std::string pixelText(const Color& linear, const Color& toned, Rounding rounding) {
  char text[120];
  std::snprintf(text, sizeof text, "%.4g  %.4g  %.4g   (%d %d %d)", linear.r, linear.g, linear.b,
                toLevel(toned.r, rounding), toLevel(toned.g, rounding), toLevel(toned.b, rounding));
  return text;
}

Bytes fewerPixels(const Bytes& picture, int most) {
  const auto blocks = [&](int side) { return (side + most - 1) / most; };  // pixels in one
  const int wide = blocks(picture.width), high = blocks(picture.height);
  Bytes result;
  result.width = (picture.width + wide - 1) / wide;
  result.height = (picture.height + high - 1) / high;
  for (int y = 0; y < result.height; ++y)
    for (int x = 0; x < result.width; ++x)
      for (int channel = 0; channel < 3; ++channel) {
        int sum = 0, count = 0;
        for (int j = y * high; j < std::min((y + 1) * high, picture.height); ++j)
          for (int i = x * wide; i < std::min((x + 1) * wide, picture.width); ++i, ++count)
            sum += picture.rgb[3 * (static_cast<std::size_t>(j) * static_cast<std::size_t>(picture.width) +
                                    static_cast<std::size_t>(i)) +
                               static_cast<std::size_t>(channel)];
        result.rgb.push_back(static_cast<std::uint8_t>((sum + count / 2) / count));
      }
  return result;
}

bool holdsLevels(const Picture& picture) {
  const auto isLevel = [](double value) {
    const double level = 255 * value;
    return value >= 0 && value <= 1 && std::abs(level - std::round(level)) < 1e-6;
  };
  return std::all_of(picture.pixels.begin(), picture.pixels.end(),
                     [&](const Color& c) { return isLevel(c.r) && isLevel(c.g) && isLevel(c.b); });
}

Picture roundedToLevels(Picture levels, Rounding rounding) {
  for (Color& c : levels.pixels)
    c = Color(toLevel(c.r, rounding), toLevel(c.g, rounding), toLevel(c.b, rounding)) / 255.0;
  return levels;
}

Picture clamped(Picture levels) {
  for (Color& c : levels.pixels) c = clamp01(c);
  return levels;
}

double magnificationFor(const Picture& difference) {
  constexpr double kMost = 128, kWhite = 0.01;  // kWhite: share of the pixels that differ
  std::vector<double> most;
  for (const Color& c : difference.pixels)
    if (const double value = maxComponent(c); value > 0) most.push_back(std::isfinite(value) ? value : 1);
  if (most.empty()) return 1;
  const auto at =
      most.begin() + static_cast<std::ptrdiff_t>((1 - kWhite) * static_cast<double>(most.size() - 1));
  std::nth_element(most.begin(), at, most.end());
  double factor = 1;
  while (factor < kMost && 2 * factor * *at <= 1) factor *= 2;
  return factor;
}

Picture differences(const Picture& a, const Picture& b, double magnify) {
  Picture picture(a.width, a.height);
  const auto apart = [&](double x, double y) { return x == y ? 0 : std::abs(x - y) * magnify; };
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    const Color &p = a.pixels[i], &q = b.pixels[i];
    picture.pixels[i] = {apart(p.r, q.r), apart(p.g, q.g), apart(p.b, q.b)};
  }
  return picture;
}

Picture falseColours(const Picture& a, const Picture& b, double magnify) {
  Picture picture = differences(a, b, magnify);
  for (Color& c : picture.pixels) c = falseColour(maxComponent(c));
  return picture;
}

Picture channelOf(const Picture& picture, ShownChannel channel) {
  if (channel == ShownChannel::all) return picture;
  Picture grey = picture;
  for (Color& c : grey.pixels)
    c = Color(channel == ShownChannel::red     ? c.r
              : channel == ShownChannel::green ? c.g
              : channel == ShownChannel::blue  ? c.b
                                               : luminance(c));
  return grey;
}

Histogram histogramOf(const Picture& picture) {
  Histogram histogram;
  const auto count = [&](std::size_t channel, double value) {
    const double at = std::clamp(value, 0.0, 1.0) * Histogram::kBins;  // NaN counts at an end
    const int bin = std::clamp(std::isnan(at) ? 0 : static_cast<int>(at), 0, Histogram::kBins - 1);
    const int now = ++histogram.counts[channel][static_cast<std::size_t>(bin)];
    if (bin > 0 && bin < Histogram::kBins - 1) histogram.most = std::max(histogram.most, now);
  };
  for (const Color& c : picture.pixels) {
    count(0, c.r);
    count(1, c.g);
    count(2, c.b);
  }
  return histogram;
}

std::string differenceText(const Picture& a, const Picture& b) {
  constexpr double kLevel = 1.0 / 255;
  const Comparison so = compare(a, b, kLevel);
  if (so.identical) return "the pictures are the same";
  return formatted("RMSE %.3g, mean %.3g, largest %.3g at %d, %d; PSNR %.1f dB; %.3g %% of pixels differ",
                   so.rmse, so.mean, so.maxDifference, so.worstX, so.worstY, so.psnr,
                   100 * so.pixelFractionBeyond);
}

}  // namespace trace
