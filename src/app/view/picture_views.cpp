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

/// Values of which `white` and all above are white.
Picture heat(Picture values, double white) {
  for (Color& c : values.pixels) c = heatColor(c.r / white);
  return values;
}

PlaneView samplesView(const Film& film) {
  Picture counts = film.sampleCounts();
  double least = kInfinity, most = 0;
  for (const Color& c : counts.pixels) {
    if (c.r == 0) continue;  // outside the region, or not yet there
    least = std::min(least, c.r);
    most = std::max(most, c.r);
  }
  if (most == 0) return {std::move(counts), "no pixel has samples yet"};
  if (least == most)
    return {heat(std::move(counts), most),
            formatted("%.0f %s in every pixel", most, most == 1 ? "ray" : "rays")};
  const std::string legend = formatted("rays a pixel: %.0f to %.0f, which is white; %.4g on the average",
                                       least, most, film.convergence().samples);
  return {heat(std::move(counts), most), legend};
}

PlaneView noiseView(const Film& film) {
  constexpr double kWhite = 8;  // levels
  const Convergence so = film.convergence();
  if (!so.judged)
    return {Picture(film.width(), film.height()),
            "noise is not known: it needs two samples a pixel of its own"};
  return {heat(film.errors(), kWhite / 255),
          formatted("noise (standard error of the mean): white from %.0f levels on; %.3g on the average",
                    kWhite, 255 * so.error)};
}

PlaneView changeView(const Film& film, const Picture& shown) {
  constexpr double kWhite = 16;  // levels
  Picture by = change(film.picture(), shown);
  if (!film.keepsHalves()) return {std::move(by), "nothing was changed: denoise is off"};
  const double mean = meanChange(by);
  for (Color& c : by.pixels) c = Color(std::max({std::abs(c.r), std::abs(c.g), std::abs(c.b)}));
  return {heat(std::move(by), kWhite / 255),
          formatted("what denoise changed: white from %.0f levels on; %.3g on the average", kWhite, mean)};
}

}  // namespace

PlaneView planeView(FilmPlane plane, const Film& film, const Picture& shown) {
  switch (plane) {
    case FilmPlane::samples: return samplesView(film);
    case FilmPlane::noise: return noiseView(film);
    case FilmPlane::change: return changeView(film, shown);
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

Picture clamped(Picture levels) {
  for (Color& c : levels.pixels) c = clamp01(c);
  return levels;
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
