// PPM and Radiance HDR, simple enough to be written out here. Two stations of codec.cpp's table.
//
// Sources: netpbm's ppm(5) and pgm(5), of which P2, P3, P5 and P6 are read with any maximum and P6 is
// written; Greg Ward, "Real Pixels", Graphics Gems II (1991), and the Radiance picture format, of which
// run-length coded and flat rows from above are read and flat rows are written. stb could read both, but
// version 2.27 loops for ever on a truncated HDR file and takes 16-bit PPM with its bytes swapped.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <stdexcept>
#include <utility>
#include <vector>

#include "base/budget.h"
#include "image/codec.h"
#include "image/codec_parts.h"

namespace trace {
namespace {

/// Takes a netpbm file apart from its start.
class NetpbmReader {
 public:
  explicit NetpbmReader(std::string_view bytes) : rest_(bytes) {}

  void skip(size_t count) { rest_.remove_prefix(std::min(count, rest_.size())); }

  /// The next decimal number, behind white space and comments.
  int number() {
    while (!rest_.empty() && (isSpace(rest_[0]) || rest_[0] == '#'))
      skip(rest_[0] == '#' ? std::min(rest_.find_first_of("\r\n"), rest_.size()) : 1);
    if (rest_.empty()) failAtEnd();
    int value = 0, digits = 0;
    for (; !rest_.empty() && rest_[0] >= '0' && rest_[0] <= '9'; ++digits, skip(1))
      if ((value = 10 * value + (rest_[0] - '0')) > 100'000'000)
        throw std::runtime_error("a number is too large");
    if (digits == 0) throw std::runtime_error("a number was expected in the header or among the pixels");
    return value;
  }

  /// The next sample of `count` bytes, the high byte first.
  int sample(size_t count) {
    if (rest_.size() < count) failAtEnd();
    int value = 0;
    for (size_t i = 0; i < count; ++i) value = value << 8 | static_cast<unsigned char>(rest_[i]);
    skip(count);
    return value;
  }

 private:
  static bool isSpace(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
  std::string_view rest_;
};

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
      for (Rgbe& pixel : row)
        for (unsigned char& value : pixel) value = next();
      return;
    }
    next();
    next();
    const size_t high = next(), length = high << 8 | next();
    if (length != row.size()) throw std::runtime_error("a row has the wrong length");
    for (size_t channel = 0; channel < 4; ++channel) readChannel(row, channel);
  }

 private:
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
  const std::string_view line = rest.substr(0, end);
  rest.remove_prefix(end + 1);
  return line;
}

}  // namespace

std::string encodePpm(const Picture& picture, Rounding rounding, const Metadata& metadata) {
  const std::string header =
      "P6\n" + std::to_string(picture.width) + " " + std::to_string(picture.height) + "\n255\n";
  std::string file = withCommentLines(header, metadata);
  const Bytes bytes = toBytes(picture, rounding);
  file.append(reinterpret_cast<const char*>(bytes.rgb.data()), bytes.rgb.size());
  return file;
}

Raster decodePpm(std::string_view bytes, const PictureLimits& limits) {
  const bool grey = bytes[1] == '2' || bytes[1] == '5', plain = bytes[1] == '2' || bytes[1] == '3';
  NetpbmReader reader(bytes);
  reader.skip(2);
  const int width = reader.number(), height = reader.number(), most = reader.number();
  if (most < 1 || most > 65535) throw std::runtime_error("a maximum of 1 to 65535 was expected");
  const double bytesPerPixel = (plain || most > 255 ? 2 : 1) * (grey ? 1 : 3);
  checkClaimedSize(width, height, bytes.size(), 1 / bytesPerPixel, limits);
  if (!plain) reader.skip(1);
  Raster raster(width, height, grey ? 1 : 3, most);
  const auto read = [&](auto value, const auto& next) {
    std::vector<decltype(value)> samples(raster.count());
    for (auto& sample : samples) sample = static_cast<decltype(value)>(next());
    raster.samples = std::move(samples);
  };
  if (plain)
    read(std::uint16_t{}, [&] {
      const int value = reader.number();
      if (value > 65535) throw std::runtime_error("a sample above 65535");
      return value;
    });
  else if (most > 255)
    read(std::uint16_t{}, [&] { return reader.sample(2); });
  else
    read(std::uint8_t{}, [&] { return reader.sample(1); });
  return raster;
}

std::string encodeHdr(const Picture& picture, Rounding, const Metadata& metadata) {
  const std::string size = "-Y " + std::to_string(picture.height) + " +X " + std::to_string(picture.width);
  std::string file = withCommentLines("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n" + size + "\n", metadata);
  file.reserve(file.size() + 4 * picture.pixels.size());
  for (const Color& c : picture.pixels) {
    checkBudget();
    for (unsigned char value : toRgbe(c)) file += static_cast<char>(value);
  }
  return file;
}

Raster decodeHdr(std::string_view bytes, const PictureLimits& limits) {
  std::string_view rest = bytes;
  for (std::string_view line = takeLine(rest); !line.empty(); line = takeLine(rest))
    if (line.substr(0, 7) == "FORMAT=" && line != "FORMAT=32-bit_rle_rgbe")
      throw std::runtime_error("the format 32-bit_rle_rgbe was expected, found " +
                               std::string(line.substr(7)));
  const std::string size(takeLine(rest).substr(0, 60));
  int width = 0, height = 0;
  if (std::sscanf(size.c_str(), "-Y %9d +X %9d", &height, &width) != 2)
    throw std::runtime_error("a size like \"-Y 300 +X 400\" was expected, found \"" + size + "\"");
  constexpr double kPixelsPerByte = 127.0 / 8;  // four runs of 127 values, two bytes each
  checkClaimedSize(width, height, bytes.size(), kPixelsPerByte, limits);
  Raster raster(width, height, 3, 1);
  std::vector<float> samples;
  samples.reserve(raster.count());
  RgbeReader reader(rest);
  std::vector<Rgbe> row(static_cast<size_t>(width));
  for (int y = 0; y < height; ++y) {
    reader.read(row);
    for (const Rgbe& pixel : row) {
      const Color c = fromRgbe(pixel);
      for (double channel : {c.r, c.g, c.b}) samples.push_back(static_cast<float>(channel));
    }
  }
  raster.samples = std::move(samples);
  return raster;
}

}  // namespace trace
