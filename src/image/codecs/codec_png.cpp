// Writing PNG files, row by row, so that a large picture hears that the time is over. A station of
// codec.cpp's table.
//
// Source: the specification of PNG (ISO/IEC 15948), filters of section 9, of which each row takes the one
// whose bytes, as signed numbers, are the smallest in sum (section 12.8). Packed by zlib.
#include <zlib.h>

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

/// Predicts from the bytes to the left, above, and above the left one: the one nearest to left + above -
/// corner.
int paeth(int left, int above, int corner) {
  const int toLeft = std::abs(above - corner), toAbove = std::abs(left - corner),
            toCorner = std::abs(left + above - 2 * corner);
  if (toLeft <= toAbove && toLeft <= toCorner) return left;
  return toAbove <= toCorner ? above : corner;
}

/// Filters a row by the filter of that number, behind the number; `before` is the row above.
void filter(int number, const unsigned char* row, const unsigned char* before, std::size_t step,
            Row& result) {
  result[0] = static_cast<unsigned char>(number);
  const std::size_t length = result.size() - 1;
  const auto each = [&](auto guess) {
    for (std::size_t i = 0; i < length; ++i) {
      const int left = i >= step ? row[i - step] : 0, corner = i >= step ? before[i - step] : 0;
      result[i + 1] = static_cast<unsigned char>(row[i] - guess(left, int{before[i]}, corner));
    }
  };
  switch (number) {
    case 0: return each([](int, int, int) { return 0; });
    case 1: return each([](int left, int, int) { return left; });
    case 2: return each([](int, int above, int) { return above; });
    case 3: return each([](int left, int above, int) { return (left + above) / 2; });
    default: return each(paeth);
  }
}

std::int64_t sumOf(const Row& filtered) {
  std::int64_t sum = 0;
  for (std::size_t i = 1; i < filtered.size(); ++i)
    sum += std::abs(static_cast<int>(static_cast<signed char>(filtered[i])));
  return sum;
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
  const Row zeros(length);
  Row tried(length + 1), best(length + 1);
  Deflater packed;
  for (int y = 0; y < height; ++y) {
    lookAtBudget();
    const unsigned char* row = levels + static_cast<std::size_t>(y) * length;
    std::int64_t least = std::numeric_limits<std::int64_t>::max();
    for (int number = 0; number < kFilters; ++number) {
      filter(number, row, y > 0 ? row - length : zeros.data(), step, tried);
      const std::int64_t size = sumOf(tried);
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
