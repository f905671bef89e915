// Radiance HDR, simple enough to be written out here. One station of codec.cpp's table.
//
// Sources: Greg Ward, "Real Pixels", Graphics Gems II (1991), and the Radiance picture format. Flat rows and
// both run-length codes are read, of RGBE and XYZE, in all eight orientations and with their exposure taken
// back. Flat rows are written. stb could read it, but version 2.27 loops infinitely on a truncated file.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <stdexcept>
#include <utility>
#include <vector>

#include "base/budget.h"
#include "base/text.h"
#include "image/codecs/codec.h"
#include "image/codecs/codec_parts.h"
#include "image/codecs/orientation.h"

namespace trace {
namespace {

using Rgbe = std::array<unsigned char, 4>;

/// The pixel nearest to a colour: 8 bits a channel, one exponent. Negative values and NaN become 0.
Rgbe toRgbe(const Color& c) {
  constexpr double kBrightest = 0x1.fep126, kDarkest = 0x1p-127;
  std::array<double, 3> v{c.r, c.g, c.b};
  for (double& channel : v) channel = channel > 0 ? std::min(channel, kBrightest) : 0;
  const double largest = *std::max_element(v.begin(), v.end());
  if (largest < kDarkest) return {};
  int exponent = 0;
  std::frexp(largest, &exponent);
  Rgbe pixel{0, 0, 0, static_cast<unsigned char>(exponent + 128)};
  for (size_t i = 0; i < 3; ++i)
    pixel[i] = static_cast<unsigned char>(std::min(std::ldexp(v[i], 8 - exponent) + 0.5, 255.0));
  return pixel;
}

Color fromRgbe(const Rgbe& pixel) {
  if (pixel[3] == 0) return {};
  return Color(pixel[0], pixel[1], pixel[2]) * std::ldexp(1.0, pixel[3] - (128 + 8));
}

/// Takes the rows of a Radiance picture from the bytes behind its header.
class RgbeReader {
 public:
  explicit RgbeReader(std::string_view bytes) : rest_(bytes) {}

  void read(std::vector<Rgbe>& row) {
    // A coded row starts with 2, 2 and its length, which no normalised pixel does.
    const bool coded = rest_.size() >= 4 && rest_[0] == 2 && rest_[1] == 2 && !(rest_[2] & 0x80);
    if (!coded || row.size() < 8 || row.size() > 0x7FFF) {
      readOld(row);
      return;
    }
    next();
    next();
    const size_t high = next(), length = high << 8 | next();
    if (length != row.size()) throw std::runtime_error("a row has the wrong length");
    for (size_t channel = 0; channel < 4; ++channel) readChannel(row, channel);
  }

 private:
  /// Pixels; (1, 1, 1, n) is a run of n more like the last, and others behind it are the higher bytes of n.
  void readOld(std::vector<Rgbe>& row) {
    int shift = 0;
    for (std::size_t x = 0; x < row.size();) {
      Rgbe pixel;
      for (unsigned char& value : pixel) value = next();
      const bool isRun = pixel[0] == 1 && pixel[1] == 1 && pixel[2] == 1 && x > 0;
      if (!isRun) {
        row[x++] = pixel;
        shift = 0;
        continue;
      }
      const std::size_t count = static_cast<std::size_t>(pixel[3]) << shift;
      if (shift > 24 || count > row.size() - x) throw std::runtime_error("a row is damaged");
      std::fill_n(row.begin() + static_cast<std::ptrdiff_t>(x), count, row[x - 1]);
      x += count;
      shift += 8;
    }
  }

  /// Runs: 128 + n and one value n times over, or n and n values.
  void readChannel(std::vector<Rgbe>& row, size_t channel) {
    for (size_t x = 0; x < row.size();) {
      const unsigned char code = next();
      const bool same = code > 128;
      const size_t count = same ? code - 128u : code;
      if (count == 0 || count > row.size() - x) throw std::runtime_error("a row is damaged");
      const unsigned char value = same ? next() : 0;
      for (size_t i = 0; i < count; ++i) row[x++][channel] = same ? value : next();
    }
  }
  unsigned char next() {
    if (rest_.empty()) failAtEnd();
    const char value = rest_[0];
    rest_.remove_prefix(1);
    return static_cast<unsigned char>(value);
  }
  std::string_view rest_;
};

/// The line at the start of `rest`, which moves behind it.
std::string_view takeLine(std::string_view& rest) {
  const size_t end = rest.find('\n');
  if (end == std::string_view::npos) failAtEnd();
  std::string_view line = rest.substr(0, end);
  rest.remove_prefix(end + 1);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

/// The properties in the head of a Radiance picture.
class HdrHead {
 public:
  /// Leaves `rest` behind the lines.
  explicit HdrHead(std::string_view& rest) {
    takeLine(rest);  // #?RADIANCE, or the name of another program
    for (std::string_view line = takeLine(rest); !line.empty(); line = takeLine(rest)) read(line);
  }

  /// Converts a pixel to the measured values, before somebody made it brighter, in Rec. 709.
  Color radiance(const Color& pixel) const {
    const Color c = pixel * scale_;
    if (!xyz_) return c;
    return {3.2404542 * c.r - 1.5371385 * c.g - 0.4985314 * c.b,
            -0.9692660 * c.r + 1.8760108 * c.g + 0.0415560 * c.b,
            0.0556434 * c.r - 0.2040259 * c.g + 1.0572252 * c.b};
  }

  std::string remark() const {
    std::string all;
    if (primaries_ && !xyz_) all = "its primaries are not taken into account: colours may be a little off";
    if (stretched_) trace::remark(all, "its pixels are not square, but shown as squares");
    return all;
  }

 private:
  void read(std::string_view line) {
    if (const std::string_view format = after(line, "FORMAT="); !format.empty()) {
      xyz_ = format == "32-bit_rle_xyze";
      if (!xyz_ && format != "32-bit_rle_rgbe")
        throw std::runtime_error("the format 32-bit_rle_rgbe or 32-bit_rle_xyze was expected, found " +
                                 std::string(format));
    }
    // All of several lines count.
    if (const auto factor = numbers(after(line, "EXPOSURE="), 1); factor[0] > 0)
      scale_ *= Color(1 / factor[0]);
    if (const auto f = numbers(after(line, "COLORCORR="), 3); f[0] > 0 && f[1] > 0 && f[2] > 0)
      scale_ *= Color(1 / f[0], 1 / f[1], 1 / f[2]);
    if (!after(line, "PRIMARIES=").empty()) primaries_ = true;
    if (const auto ratio = numbers(after(line, "PIXASPECT="), 1); ratio[0] > 0 && ratio[0] != 1)
      stretched_ = true;
  }

  static std::string_view after(std::string_view line, std::string_view key) {
    if (!line.starts_with(key)) return {};
    line.remove_prefix(key.size());
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    return line.substr(0, line.find_last_not_of(" \t") + 1);
  }
  /// As many finite numbers; 0 for those that are not there.
  static std::array<double, 3> numbers(std::string_view text, std::size_t count) {
    std::array<double, 3> values{};
    for (std::size_t i = 0; i < count; ++i) {
      text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
      const auto number = parseNumber(text);
      if (!number || !std::isfinite(number->value)) break;
      values[i] = number->value;
      text.remove_prefix(number->length);
    }
    return values;
  }

  Color scale_{1, 1, 1};
  bool xyz_ = false, primaries_ = false, stretched_ = false;
};

/// Reads the rows as the file has them.
struct HdrSize {
  int width, height;
  Orientation orientation;
};

/// The line "-Y 300 +X 400", or with other signs, or with X first, where the rows of the file are columns.
HdrSize hdrSize(std::string_view line) {
  const std::string text(line.substr(0, 60));
  char signs[2], axes[2];
  int counts[2];
  const bool good = std::sscanf(text.c_str(), "%c%c %9d %c%c %9d", &signs[0], &axes[0], &counts[0], &signs[1],
                                &axes[1], &counts[1]) == 6 &&
                    (signs[0] == '+' || signs[0] == '-') && (signs[1] == '+' || signs[1] == '-') &&
                    ((axes[0] == 'Y' && axes[1] == 'X') || (axes[0] == 'X' && axes[1] == 'Y'));
  if (!good) throw std::runtime_error("a size like \"-Y 300 +X 400\" was expected, found \"" + text + "\"");
  const bool columns = axes[0] == 'X';
  const bool down = signs[columns] == '-', toRight = signs[!columns] == '+';
  using enum Orientation;
  const Orientation rows = down ? (toRight ? upright : mirrored) : (toRight ? flipped : turned);
  const Orientation asColumns = down ? (toRight ? transposed : right) : (toRight ? left : transverse);
  return {counts[1], counts[0], columns ? asColumns : rows};
}

}  // namespace

std::string encodeHdr(const Picture& picture, const Encoding&, const Metadata& metadata) {
  const std::string size = "-Y " + std::to_string(picture.height) + " +X " + std::to_string(picture.width);
  std::string file = withCommentLines("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n" + size + "\n", metadata);
  file.reserve(file.size() + 4 * picture.pixels.size());
  for (const Color& c : picture.pixels) {
    checkBudget();
    for (unsigned char value : toRgbe(c)) file += static_cast<char>(value);
  }
  return file;
}

std::string hdrRemark(std::string_view bytes) { return HdrHead(bytes).remark(); }

Raster decodeHdr(std::string_view bytes, const PictureLimits& limits) {
  std::string_view rest = bytes;
  const HdrHead head(rest);
  const HdrSize size = hdrSize(takeLine(rest));
  constexpr double kPixelsPerByte = 127.0 / 8;  // four runs of 127 values, two bytes each
  checkClaimedSize(size.width, size.height, bytes.size(), kPixelsPerByte, limits);
  Raster raster(size.width, size.height, 3, 1);
  std::vector<float> samples;
  samples.reserve(raster.count());
  RgbeReader reader(rest);
  std::vector<Rgbe> row(static_cast<size_t>(size.width));
  for (int y = 0; y < size.height; ++y) {
    reader.read(row);
    for (const Rgbe& pixel : row) {
      const Color c = head.radiance(fromRgbe(pixel));
      for (double channel : {c.r, c.g, c.b}) samples.push_back(static_cast<float>(channel));
    }
  }
  raster.samples = std::move(samples);
  return oriented(std::move(raster), size.orientation);
}

}  // namespace trace
