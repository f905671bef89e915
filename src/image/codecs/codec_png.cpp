// Writing PNG files, row by row, so that a large picture hears that the time is over. A station of
// codec.cpp's table.
//
// Source: the specification of PNG (ISO/IEC 15948), filters of section 9, of which each row takes the one
// whose bytes, as signed numbers, are the smallest in sum (section 12.8). Packed by zlib.
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <new>
#include <stdexcept>
#include <utility>
#include <variant>
#include <vector>

#include "base/budget.h"
#include "image/codecs/codec_parts.h"

namespace trace {
namespace {

using Row = std::vector<unsigned char>;

/// Packs bytes that come piece by piece.
class Deflater {
 public:
  Deflater() {
    constexpr int kLevel = 4;  // 6 takes twice as long for a tenth less
    if (deflateInit(&stream_, kLevel) != Z_OK) throw std::bad_alloc();
  }
  ~Deflater() { deflateEnd(&stream_); }
  Deflater(const Deflater&) = delete;
  Deflater& operator=(const Deflater&) = delete;

  void add(Row& bytes) { take(bytes.data(), bytes.size(), Z_NO_FLUSH); }
  std::string finish() {
    take(nullptr, 0, Z_FINISH);
    return std::move(packed_);
  }

 private:
  void take(unsigned char* bytes, std::size_t count, int flush) {
    stream_.next_in = bytes;
    stream_.avail_in = static_cast<uInt>(count);
    unsigned char buffer[1 << 16];
    do {
      stream_.next_out = buffer;
      stream_.avail_out = sizeof buffer;
      if (deflate(&stream_, flush) == Z_STREAM_ERROR) throw std::runtime_error("zlib failed");
      packed_.append(reinterpret_cast<const char*>(buffer), sizeof buffer - stream_.avail_out);
    } while (stream_.avail_out == 0);
  }

  z_stream stream_{};
  std::string packed_;
};

/// Bytes and their sums; so short that vectors hold many.
using Short = std::int16_t;

Short distance(Short a, Short b) { return static_cast<Short>(a < b ? b - a : a - b); }

/// Predicts from the bytes to the left, above, and above the left one: the one nearest to left + above -
/// corner.
Short paeth(Short left, Short above, Short corner) {
  const Short toLeft = distance(above, corner), toAbove = distance(left, corner),
              toCorner = distance(static_cast<Short>(left + above), static_cast<Short>(2 * corner));
  const Short other = toAbove <= toCorner ? above : corner;
  return toLeft <= std::min(toAbove, toCorner) ? left : other;
}

/// A row behind as many zeros as a pixel has bytes, so that its first pixel has a left neighbour like others:
/// the loops over it have no conditions, and compilers make vectors of them.
class PaddedRow {
 public:
  PaddedRow(std::size_t step, std::size_t length) : step_(step), bytes_(step + length) {}
  void set(const unsigned char* row) { std::copy_n(row, bytes_.size() - step_, bytes_.data() + step_); }
  const unsigned char* here() const { return bytes_.data() + step_; }
  const unsigned char* left() const { return bytes_.data(); }

 private:
  std::size_t step_;
  Row bytes_;
};

/// Filters a row by the filter of that number, behind the number; `before` is the row above.
void filter(int number, const PaddedRow& row, const PaddedRow& before, Row& result) {
  result[0] = static_cast<unsigned char>(number);
  const std::size_t length = result.size() - 1;
  const auto each = [&](auto guess) {
    const unsigned char *here = row.here(), *left = row.left(), *above = before.here(),
                        *corner = before.left();
    unsigned char* to = result.data() + 1;
    for (std::size_t i = 0; i < length; ++i)
      to[i] = static_cast<unsigned char>(here[i] - guess(Short{left[i]}, Short{above[i]}, Short{corner[i]}));
  };
  switch (number) {
    case 0: return each([](Short, Short, Short) { return Short{0}; });
    case 1: return each([](Short left, Short, Short) { return left; });
    case 2: return each([](Short, Short above, Short) { return above; });
    case 3:
      return each([](Short left, Short above, Short) { return static_cast<Short>((left + above) / 2); });
    default: return each(paeth);
  }
}

/// The sum of the bytes' sizes, as signed numbers.
std::uint64_t sumOf(const Row& filtered) {
  constexpr std::size_t kTogether = 1 << 16;  // whose sum is small
  std::uint64_t all = 0;
  for (std::size_t first = 1; first < filtered.size(); first += kTogether) {
    const std::size_t end = std::min(filtered.size(), first + kTogether);
    std::uint32_t sum = 0;
    for (std::size_t i = first; i < end; ++i)
      sum += static_cast<std::uint32_t>(std::abs(static_cast<int>(static_cast<signed char>(filtered[i]))));
    all += sum;
  }
  return all;
}

std::string bigEndian32(int number) {
  const auto n = static_cast<std::uint32_t>(number);
  return {static_cast<char>(n >> 24), static_cast<char>(n >> 16), static_cast<char>(n >> 8),
          static_cast<char>(n)};
}

std::string encoded(const unsigned char* levels, int width, int height, int channels) {
  constexpr int kFilters = 5;
  constexpr std::array<char, 5> kColorTypes{0, 0, 4, 2, 6};
  const auto step = static_cast<std::size_t>(channels), length = static_cast<std::size_t>(width) * step;
  PaddedRow here(step, length), before(step, length);
  Row tried(length + 1), best(length + 1);
  Deflater packed;
  for (int y = 0; y < height; ++y) {
    lookAtBudget();
    std::swap(here, before);
    here.set(levels + static_cast<std::size_t>(y) * length);
    auto least = std::numeric_limits<std::uint64_t>::max();
    for (int number = 0; number < kFilters; ++number) {
      filter(number, here, before, tried);
      const std::uint64_t size = sumOf(tried);
      if (size < least) least = size, std::swap(best, tried);
    }
    packed.add(best);
  }
  const std::string header = bigEndian32(width) + bigEndian32(height) + '\x08' +
                             kColorTypes[static_cast<std::size_t>(channels)] + std::string(3, '\0');
  return "\x89PNG\r\n\x1a\n" + pngChunk("IHDR", header) + pngChunk("IDAT", packed.finish()) +
         pngChunk("IEND", "");
}

}  // namespace

std::string encodePngRows(const Bytes& b) { return encoded(b.rgb.data(), b.width, b.height, 3); }

std::string encodePngRows(const Raster& r) {
  const auto& samples = std::get<std::vector<std::uint8_t>>(r.samples);
  return encoded(samples.data(), r.width, r.height, r.channels);
}

}  // namespace trace
