// Netpbm's PBM, PGM, PPM and PAM, and PFM, simple enough to be written out here. Two stations of codec.cpp's
// table.
//
// Sources: netpbm's pbm(5), pgm(5), ppm(5), pam(5) and pfm(5). P1 to P7 are read with any maximum, and P6 is
// written; PFM is read in both byte orders and written. stb takes 16-bit PPM with its bytes swapped.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <utility>
#include <vector>

#include "base/bits.h"
#include "base/budget.h"
#include "base/text.h"
#include "image/codecs/codec.h"
#include "image/codecs/codec_parts.h"

namespace trace {
namespace {

/// The head of a netpbm file.
struct NetpbmHead {
  int width = 0, height = 0, channels = 1, most = 1;
  bool plain = false;   ///< samples are digits
  bool bitmap = false;  ///< one bit for each pixel, and 1 is black
};

/// Takes a netpbm file apart from its start.
class NetpbmReader {
 public:
  explicit NetpbmReader(std::string_view bytes) : rest_(bytes) {}

  /// The head of P1 to P7.
  NetpbmHead head() {
    const char kind = rest_[1];
    skip(2);
    NetpbmHead head;
    if (kind == '7') {
      head = pamHead();
    } else {
      head.plain = kind <= '3';
      head.bitmap = kind == '1' || kind == '4';
      head.channels = kind == '3' || kind == '6' ? 3 : 1;
      head.width = number();
      head.height = number();
      if (!head.bitmap) head.most = number();
      if (!head.plain) skip(1);
    }
    if (head.most < 1 || head.most > 65535) throw std::runtime_error("a maximum of 1 to 65535 was expected");
    return head;
  }

  /// The next decimal number, behind white space and comments.
  int number() {
    skipBlanks();
    int value = 0, digits = 0;
    for (; !rest_.empty() && rest_[0] >= '0' && rest_[0] <= '9'; ++digits, skip(1))
      if ((value = 10 * value + (rest_[0] - '0')) > 100'000'000)
        throw std::runtime_error("a number is too large");
    if (digits == 0) throw std::runtime_error("a number was expected in the header or among the pixels");
    return value;
  }

  /// The next number, perhaps negative and with a fraction.
  double real() {
    skipBlanks();
    const auto number = parseNumber(rest_);
    if (!number) throw std::runtime_error("a number was expected in the header");
    skip(number->length);
    return number->value;
  }

  /// The next 0 or 1 among digits, which may stand side by side.
  int digit() {
    skipBlanks();
    const char c = rest_[0];
    if (c != '0' && c != '1') throw std::runtime_error("0 or 1 was expected among the pixels");
    skip(1);
    return c - '0';
  }

  /// The next sample of `count` bytes, the high byte first.
  int sample(std::size_t count) {
    if (rest_.size() < count) failAtEnd();
    int value = 0;
    for (std::size_t i = 0; i < count; ++i) value = value << 8 | static_cast<unsigned char>(rest_[i]);
    skip(count);
    return value;
  }

  void skip(std::size_t count) { rest_.remove_prefix(std::min(count, rest_.size())); }
  std::string_view rest() const { return rest_; }

 private:
  static bool isSpace(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

  void skipBlanks() {
    while (!rest_.empty() && (isSpace(rest_[0]) || rest_[0] == '#'))
      skip(rest_[0] == '#' ? std::min(rest_.find_first_of("\r\n"), rest_.size()) : 1);
    if (rest_.empty()) failAtEnd();
  }

  std::string_view word() {
    skipBlanks();
    std::size_t length = 0;
    while (length < rest_.size() && !isSpace(rest_[length])) ++length;
    const std::string_view word = rest_.substr(0, length);
    skip(length);
    return word;
  }

  /// Keywords with their values, to ENDHDR.
  NetpbmHead pamHead() {
    NetpbmHead head;
    for (std::string_view key = word(); key != "ENDHDR"; key = word()) {
      if (key == "WIDTH")
        head.width = number();
      else if (key == "HEIGHT")
        head.height = number();
      else if (key == "DEPTH")
        head.channels = number();
      else if (key == "MAXVAL")
        head.most = number();
      else if (const std::string_view type = word(); key == "TUPLTYPE" && isForeign(type))
        throw std::runtime_error("tuples of grey or of red, green and blue were expected, found " +
                                 std::string(type.substr(0, 40)));
    }
    skip(1);
    if (head.channels < 1 || head.channels > 4)
      throw std::runtime_error("a depth of 1 to 4 was expected, found " + std::to_string(head.channels));
    return head;
  }
  static bool isForeign(std::string_view type) {
    if (type.ends_with("_ALPHA")) type.remove_suffix(6);
    return type != "BLACKANDWHITE" && type != "GRAYSCALE" && type != "RGB";
  }

  std::string_view rest_;
};

std::size_t bytesOfRow(const NetpbmHead& head) {
  const auto samples = static_cast<std::size_t>(head.width) * static_cast<std::size_t>(head.channels);
  return head.bitmap ? (samples + 7) / 8 : samples * (head.most > 255 ? 2 : 1);
}

/// 1 for white, as in all other pictures.
std::vector<std::uint8_t> bitsOf(NetpbmReader& reader, const NetpbmHead& head) {
  std::vector<std::uint8_t> samples;
  for (int y = 0; y < head.height; ++y)
    for (int x = 0, eight = 0; x < head.width; ++x) {
      if (!head.plain && x % 8 == 0) eight = reader.sample(1);
      const int bit = head.plain ? reader.digit() : eight >> (7 - x % 8) & 1;
      samples.push_back(static_cast<std::uint8_t>(1 - bit));
    }
  return samples;
}

template <class Sample, class Next>
std::vector<Sample> samplesOf(std::size_t count, const Next& next) {
  std::vector<Sample> samples(count);
  for (Sample& sample : samples) sample = static_cast<Sample>(next());
  return samples;
}

/// The head of a PFM file, and its reader behind that.
struct PfmHead {
  explicit PfmHead(std::string_view bytes) : reader(bytes), channels(bytes[1] == 'F' ? 3 : 1) {
    reader.skip(2);
    width = reader.number();
    height = reader.number();
    scale = reader.real();
    reader.skip(1);
  }

  NetpbmReader reader;
  int channels, width = 0, height = 0;
  double scale = -1;  ///< below 0: the low byte is the first
};

}  // namespace

std::string encodePpm(const Picture& picture, const Encoding& how, const Metadata& metadata) {
  const std::string header =
      "P6\n" + std::to_string(picture.width) + " " + std::to_string(picture.height) + "\n255\n";
  std::string file = withCommentLines(header, metadata);
  const Bytes bytes = developedBytes(picture, how.development, how.rounding);
  file.append(reinterpret_cast<const char*>(bytes.rgb.data()), bytes.rgb.size());
  return file;
}

Raster decodePpm(std::string_view bytes, const PictureLimits& limits) {
  NetpbmReader reader(bytes);
  const NetpbmHead head = reader.head();
  const double bytesOfSample = head.bitmap && !head.plain ? 0.125 : head.most > 255 ? 2 : 1;
  checkClaimedSize(head.width, head.height, bytes.size(), 1 / (bytesOfSample * head.channels), limits);
  Raster raster(head.width, head.height, head.channels, head.most);
  if (head.bitmap)
    raster.samples = bitsOf(reader, head);
  else if (head.plain)
    raster.samples = samplesOf<std::uint16_t>(raster.count(), [&] {
      const int value = reader.number();
      if (value > 65535) throw std::runtime_error("a sample above 65535");
      return value;
    });
  else if (head.most > 255)
    raster.samples = samplesOf<std::uint16_t>(raster.count(), [&] { return reader.sample(2); });
  else
    raster.samples = samplesOf<std::uint8_t>(raster.count(), [&] { return reader.sample(1); });
  return raster;
}

std::string ppmRemark(std::string_view bytes) {
  NetpbmReader reader(bytes);
  const NetpbmHead head = reader.head();
  if (head.plain) return {};
  reader.skip(bytesOfRow(head) * static_cast<std::size_t>(head.height));
  const bool more = reader.rest().size() > 2 && reader.rest()[0] == 'P' && reader.rest()[1] >= '1' &&
                    reader.rest()[1] <= '7';
  return more ? "the first of several pictures is shown" : "";
}

std::string encodePfm(const Picture& picture, const Encoding&, const Metadata&) {
  std::string file =
      "PF\n" + std::to_string(picture.width) + " " + std::to_string(picture.height) + "\n-1.0\n";
  file.reserve(file.size() + 12 * picture.pixels.size());
  for (int y = picture.height - 1; y >= 0; --y) {
    for (int x = 0; x < picture.width; ++x) {
      checkBudget();
      const Color& c = picture.at(x, y);
      for (const double channel : {c.r, c.g, c.b}) {
        const auto bits = bitCast<std::uint32_t>(static_cast<float>(channel));
        for (int shift = 0; shift < 32; shift += 8) file += static_cast<char>(bits >> shift & 255);
      }
    }
  }
  return file;
}

Raster decodePfm(std::string_view bytes, const PictureLimits& limits) {
  PfmHead head(bytes);
  checkClaimedSize(head.width, head.height, bytes.size(), 0.25 / head.channels, limits);
  Raster raster(head.width, head.height, head.channels, 1);
  std::vector<float> samples(raster.count());
  const auto row = static_cast<std::size_t>(head.width) * static_cast<std::size_t>(head.channels);
  for (auto y = static_cast<std::size_t>(head.height); y-- > 0;)  // the lowest is the first
    for (std::size_t i = 0; i < row; ++i) {
      auto bits = static_cast<std::uint32_t>(head.reader.sample(2)) << 16;
      bits |= static_cast<std::uint32_t>(head.reader.sample(2));
      if (head.scale < 0) bits = bits >> 24 | (bits >> 8 & 0xff00) | (bits & 0xff00) << 8 | bits << 24;
      samples[y * row + i] = bitCast<float>(bits);
    }
  raster.samples = std::move(samples);
  return raster;
}

std::string pfmRemark(std::string_view bytes) {
  const double scale = std::abs(PfmHead(bytes).scale);
  return scale != 1 ? "its scale of " + toText(scale) + " is not taken into account" : "";
}

}  // namespace trace
