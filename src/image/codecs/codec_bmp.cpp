// BMP, read here: stb knows neither its run-length codes nor all of its heads. One station of codec.cpp's
// table.
//
// Source: Microsoft, Windows GDI, "Bitmap Storage" and "Bitmap Compression"; IBM, OS/2 Presentation Manager
// (heads of 12, 16 and 64 bytes). Read are 1, 2, 4, 8, 16, 24 and 32 bits, masks, RLE4, RLE8 and RLE24, rows
// from below and from above.
#include <algorithm>
#include <array>
#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

#include "image/codecs/codec.h"
#include "image/codecs/codec_parts.h"

namespace trace {
namespace {

using Rgba = std::array<std::uint8_t, 4>;

class BmpReader {
 public:
  BmpReader(std::string_view bytes, const PictureLimits& limits) : bytes_(bytes) {
    readHead();
    checkClaimedSize(width_, height_, bytes.size(), isRunCoded() ? kPackedPixelsPerByte : 8, limits);
    readMasks();
    readPalette();
  }

  Raster read() {
    pixels_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), Rgba{0, 0, 0, 255});
    at_ = pixelsAt_;
    if (isRunCoded())
      readRuns();
    else
      for (int row = 0; row < height_; ++row) readRow(row);
    // In old files the fourth byte of a pixel is nothing; some programs put transparency there.
    const bool alpha = masks_[3] != 0 && std::any_of(pixels_.begin(), pixels_.end(),
                                                     [](const Rgba& pixel) { return pixel[3] != 0; });
    const int channels = alpha ? 4 : 3;
    Raster raster(width_, height_, channels, 255);
    std::vector<std::uint8_t> samples;
    samples.reserve(raster.count());
    for (const Rgba& pixel : pixels_) samples.insert(samples.end(), pixel.begin(), pixel.begin() + channels);
    raster.samples = std::move(samples);
    return raster;
  }

 private:
  enum Packing : std::uint32_t { none = 0, rle8 = 1, rle4 = 2, fields = 3, rle24 = 4, alphaFields = 6 };

  // --- the head ---

  std::uint32_t number(std::size_t at, std::size_t size) const {
    if (at + size > bytes_.size()) failAtEnd();
    std::uint32_t value = 0;
    for (std::size_t i = size; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes_[at + i]);
    return value;
  }

  void readHead() {
    constexpr std::size_t kFileHead = 14;
    pixelsAt_ = number(10, 4);
    headSize_ = number(kFileHead, 4);
    if (headSize_ < 12 || (headSize_ > 12 && headSize_ < 16) || headSize_ > 1024)
      throw std::runtime_error("a head of 12 to 1024 bytes was expected, found " + std::to_string(headSize_));
    const bool isOld = headSize_ == 12;
    std::int64_t width = number(18, isOld ? 2 : 4), height = number(isOld ? 20 : 22, isOld ? 2 : 4);
    if (!isOld) {
      width = static_cast<std::int32_t>(width);
      height = static_cast<std::int32_t>(height);
    }
    fromAbove_ = height < 0;
    if (height < 0) height = -height;
    constexpr std::int64_t kMostSide = 1 << 24;
    if (width < 1 || height < 1 || width > kMostSide || height > kMostSide)
      throw std::runtime_error("a size of " + std::to_string(width) + "x" + std::to_string(height) +
                               " pixels is not believable");
    width_ = static_cast<int>(width);
    height_ = static_cast<int>(height);
    bits_ = static_cast<int>(number(isOld ? 24 : 28, 2));
    packing_ = headSize_ >= 20 ? number(30, 4) : 0;
    const bool isOs2 = headSize_ == 64 || headSize_ == 16;
    if (isOs2 && packing_ == 3) throw std::runtime_error("Huffman codes of OS/2 are not read");
    const bool known =
        bits_ == 1 || bits_ == 2 || bits_ == 4 || bits_ == 8 || bits_ == 16 || bits_ == 24 || bits_ == 32;
    if (!known)
      throw std::runtime_error("1 to 32 bits a pixel were expected, found " + std::to_string(bits_));
    const bool fits = packing_ == none || (packing_ == rle8 && bits_ == 8) ||
                      (packing_ == rle4 && bits_ == 4) || (packing_ == rle24 && bits_ == 24 && isOs2) ||
                      ((packing_ == fields || packing_ == alphaFields) && bits_ >= 16);
    if (!fits)
      throw std::runtime_error("a compression of kind " + std::to_string(packing_) + " with " +
                               std::to_string(bits_) + " bits a pixel is not read");
    paletteAt_ = kFileHead + headSize_;
  }

  bool isRunCoded() const { return packing_ == rle8 || packing_ == rle4 || packing_ == rle24; }

  void readMasks() {
    if (bits_ == 16) masks_ = {0x7c00, 0x3e0, 0x1f, 0};
    if (bits_ == 32) masks_ = {0xff0000, 0xff00, 0xff, packing_ == none ? 0xff000000 : 0};
    if (packing_ != fields && packing_ != alphaFields) return;
    constexpr std::size_t kMasks = 54;  // in newer heads a part of them
    const bool hasAlpha = headSize_ >= 56 || packing_ == alphaFields;
    for (std::size_t i = 0; i < (hasAlpha ? 4u : 3u); ++i) masks_[i] = number(kMasks + 4 * i, 4);
    if (headSize_ == 40) paletteAt_ += hasAlpha ? 16 : 12;
  }

  void readPalette() {
    if (bits_ > 8) return;
    const std::size_t size = headSize_ == 12 ? 3 : 4, most = std::size_t{1} << bits_;
    std::size_t count = headSize_ >= 36 ? number(46, 4) : 0;
    if (count == 0 || count > most) count = most;
    if (pixelsAt_ > paletteAt_) count = std::min(count, (pixelsAt_ - paletteAt_) / size);
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t color = number(paletteAt_ + size * i, 3);
      palette_.push_back({static_cast<std::uint8_t>(color >> 16), static_cast<std::uint8_t>(color >> 8),
                          static_cast<std::uint8_t>(color), 255});
    }
    palette_.resize(256, {0, 0, 0, 255});
  }

  // --- pixels ---

  /// In the order of the file.
  Rgba& pixel(int column, int row) {
    const int y = fromAbove_ ? row : height_ - 1 - row;
    return pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                   static_cast<std::size_t>(column)];
  }

  static std::uint8_t channel(std::uint32_t value, std::uint32_t mask) {
    if (mask == 0) return 255;
    int shift = 0;
    while (!(mask >> shift & 1)) ++shift;
    const std::uint64_t most = mask >> shift;
    return static_cast<std::uint8_t>(((value & mask) >> shift) * std::uint64_t{255} / most);
  }

  void readRow(int row) {
    const std::size_t stride =
        (static_cast<std::size_t>(width_) * static_cast<std::size_t>(bits_) + 31) / 32 * 4;
    const std::size_t used = (static_cast<std::size_t>(width_) * static_cast<std::size_t>(bits_) + 7) / 8;
    if (at_ + used > bytes_.size()) failAtEnd();
    for (int x = 0; x < width_; ++x) {
      const auto column = static_cast<std::size_t>(x);
      if (bits_ <= 8) {
        const std::size_t bit = column * static_cast<std::size_t>(bits_);
        const std::uint32_t byte = number(at_ + bit / 8, 1);
        const int shift = 8 - bits_ - static_cast<int>(bit % 8);
        pixel(x, row) = palette_[byte >> shift & ((1u << bits_) - 1)];
      } else if (bits_ == 24) {
        const std::uint32_t value = number(at_ + 3 * column, 3);
        pixel(x, row) = {static_cast<std::uint8_t>(value >> 16), static_cast<std::uint8_t>(value >> 8),
                         static_cast<std::uint8_t>(value), 255};
      } else {
        const std::size_t size = static_cast<std::size_t>(bits_) / 8;
        const std::uint32_t value = number(at_ + size * column, size);
        for (std::size_t i = 0; i < 4; ++i) pixel(x, row)[i] = channel(value, masks_[i]);
      }
    }
    at_ += stride;
  }

  std::uint32_t next() { return number(at_++, 1); }

  /// Runs of one value, or of two in turn for 4 bits; 0 escapes to values as they are, to the next row, to
  /// another place and to the end.
  void readRuns() {
    int x = 0, y = 0;
    const auto put = [&](const Rgba& color) {
      if (x < width_ && y < height_) pixel(x, y) = color;
      ++x;
    };
    const auto nextColor = [&] {
      const std::uint32_t blue = next(), green = next(), red = next();
      return Rgba{static_cast<std::uint8_t>(red), static_cast<std::uint8_t>(green),
                  static_cast<std::uint8_t>(blue), 255};
    };
    while (y < height_) {
      const std::uint32_t count = next();
      if (count > 0) {
        if (packing_ == rle24) {
          const Rgba color = nextColor();
          for (std::uint32_t i = 0; i < count; ++i) put(color);
        } else {
          const std::uint32_t value = next();
          for (std::uint32_t i = 0; i < count; ++i)
            put(palette_[packing_ == rle8 ? value : i % 2 == 0 ? value >> 4 : value & 15]);
        }
        continue;
      }
      const std::uint32_t code = next();
      if (code == 0) {  // the end of the row
        x = 0;
        ++y;
      } else if (code == 1) {
        return;
      } else if (code == 2) {
        x = static_cast<int>(std::min<std::uint32_t>(static_cast<std::uint32_t>(x) + next(), 1u << 24));
        y += static_cast<int>(next());
      } else {
        const std::size_t start = at_;
        std::uint32_t value = 0;
        for (std::uint32_t i = 0; i < code; ++i) {
          if (packing_ == rle24) {
            put(nextColor());
            continue;
          }
          if (packing_ == rle8 || i % 2 == 0) value = next();
          put(palette_[packing_ == rle8 ? value : i % 2 == 0 ? value >> 4 : value & 15]);
        }
        at_ += (at_ - start) % 2;  // to a whole word
      }
    }
  }

  std::string_view bytes_;
  std::size_t pixelsAt_ = 0, headSize_ = 0, paletteAt_ = 0, at_ = 0;
  int width_ = 0, height_ = 0, bits_ = 0;
  std::uint32_t packing_ = none;
  bool fromAbove_ = false;
  std::array<std::uint32_t, 4> masks_{};  ///< masks of red, green, blue and alpha, where pixels are numbers
  std::vector<Rgba> palette_, pixels_;
};

}  // namespace

Raster decodeBmp(std::string_view bytes, const PictureLimits& limits) {
  return BmpReader(bytes, limits).read();
}

}  // namespace trace
