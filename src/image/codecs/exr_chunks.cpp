#include "image/codecs/exr_chunks.h"

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <stdexcept>

#include "image/codecs/codec_parts.h"

namespace trace {
namespace {

/// Takes little-endian numbers and names from a place in the file on.
class Walker {
 public:
  Walker(std::string_view bytes, std::uint64_t at) : bytes_(bytes), at_(at) {}

  std::uint64_t at() const { return at_; }
  std::uint64_t whole(int size) {
    const std::string_view digits = take(static_cast<std::uint64_t>(size));
    std::uint64_t value = 0;
    for (std::size_t i = digits.size(); i-- > 0;) value = value << 8 | static_cast<unsigned char>(digits[i]);
    return value;
  }
  int integer() { return static_cast<int>(static_cast<std::uint32_t>(whole(4))); }
  std::string_view take(std::uint64_t size) {
    if (at_ > bytes_.size() || size > bytes_.size() - at_) failAtEnd();
    const std::string_view taken = bytes_.substr(at_, size);
    at_ += size;
    return taken;
  }
  /// Up to a zero byte, which is skipped.
  std::string_view name() {
    const std::size_t end = at_ < bytes_.size() ? bytes_.find('\0', at_) : bytes_.npos;
    if (end == bytes_.npos) failAtEnd();
    const std::string_view found = take(end - at_);
    ++at_;
    return found;
  }

 private:
  std::string_view bytes_;
  std::uint64_t at_;
};

/// OpenEXR reads values of these types without a look at the length, and from the wrong place on when it is
/// another.
struct FixedLength {
  std::string_view type;
  std::size_t bytes;
};
constexpr FixedLength kFixedLengths[] = {{"box2i", 16},      {"box2f", 16},   {"chromaticities", 32},
                                         {"compression", 1}, {"double", 8},   {"envmap", 1},
                                         {"float", 4},       {"int", 4},      {"keycode", 28},
                                         {"lineOrder", 1},   {"m33f", 36},    {"m44f", 64},
                                         {"m33d", 72},       {"m44d", 128},   {"rational", 8},
                                         {"tiledesc", 9},    {"timecode", 8}, {"v2i", 8},
                                         {"v2f", 8},         {"v2d", 16},     {"v3i", 12},
                                         {"v3f", 12},        {"v3d", 24}};

void checkLength(std::string_view type, std::string_view value) {
  bool right = true;
  for (const FixedLength& fixed : kFixedLengths)
    if (fixed.type == type) right = value.size() == fixed.bytes;
  Walker inside(value, 0);
  if (type == "chlist") {
    constexpr std::uint64_t kChannel = 16;
    while (!inside.name().empty()) inside.take(kChannel);
    right = inside.at() == value.size();
  }
  if (type == "preview") {
    const std::uint64_t width = inside.whole(4), height = inside.whole(4);
    right = width < 65536 && height < 65536 && value.size() == 8 + 4 * width * height;
  }
  if (!right) throw std::runtime_error("an attribute of the header has the wrong length");
}

/// False for the empty header behind the last.
bool skipHeader(Walker& walker) {
  bool any = false;
  while (!walker.name().empty()) {
    any = true;
    const std::string_view type = walker.name();
    const int size = walker.integer();
    if (size < 0) throw std::runtime_error("an attribute of the header has a negative length");
    checkLength(type, walker.take(static_cast<std::uint64_t>(size)));
  }
  return any;
}

/// Multiples of `step` from `low` to `high`.
std::uint64_t samples(int step, int low, int high) {
  const auto below = [&](std::int64_t v) { return v >= 0 ? v / step : -((-v + step - 1) / step); };
  return static_cast<std::uint64_t>(std::max<std::int64_t>(below(high) - below(std::int64_t{low} - 1), 0));
}

struct Window {
  int minX, minY, maxX, maxY;
};

std::uint64_t bytesOf(const ExrLayout& layout, const Window& window) {
  std::uint64_t bytes = 0;
  for (const ExrLayout::Channel& c : layout.channels)
    bytes += samples(std::max(c.xSampling, 1), window.minX, window.maxX) *
             samples(std::max(c.ySampling, 1), window.minY, window.maxY) *
             static_cast<std::uint64_t>(c.bytes);
  return bytes;
}

/// The length of what was packed, or `most` + 1 if it is longer; 0 if it is damaged.
std::uint64_t inflatedLength(std::string_view packed, std::uint64_t most) {
  std::vector<unsigned char> unpacked(most + 1);
  uLongf length = static_cast<uLongf>(unpacked.size());
  const int result = uncompress(unpacked.data(), &length, reinterpret_cast<const Bytef*>(packed.data()),
                                static_cast<uLong>(packed.size()));
  if (result == Z_BUF_ERROR && length == unpacked.size()) return most + 1;
  return result == Z_OK ? length : 0;
}

/// Runs of a byte: n >= 0 and the value, n + 1 times over; or n < 0 and -n values.
std::uint64_t lengthOfRuns(std::string_view packed) {
  std::uint64_t length = 0;
  for (std::size_t i = 0; i < packed.size();) {
    const int count = static_cast<signed char>(packed[i]);
    length += static_cast<std::uint64_t>(count < 0 ? -count : count + 1);
    i += static_cast<std::size_t>(count < 0 ? 1 - count : 2);
    if (i > packed.size()) return 0;
  }
  return length;
}

void checkBlock(std::string_view packed, std::uint64_t wanted, ExrLayout::Packing packing) {
  using Packing = ExrLayout::Packing;
  if (packing == Packing::other || packed.size() == wanted)
    return;  // what does not get shorter is not packed
  std::uint64_t length = 0;
  if (packed.size() < wanted && packing == Packing::deflate) length = inflatedLength(packed, wanted);
  if (packed.size() < wanted && packing == Packing::runs) length = lengthOfRuns(packed);
  if (length != wanted) throw std::runtime_error("a block of pixels has the wrong length");
}

std::uint64_t blocksAlong(std::int64_t all, int each) {
  return static_cast<std::uint64_t>((all + each - 1) / each);
}

/// The sides of the levels, from the full one on: halves until it is 1. `longest` decides how many there are.
std::vector<std::int64_t> levelSides(std::int64_t side, std::int64_t longest, bool roundsUp) {
  std::vector<std::int64_t> sides;
  const auto half = [&](std::int64_t whole, int level) {
    const std::int64_t step = std::int64_t{1} << level;
    return roundsUp ? (whole + step - 1) / step : whole / step;
  };
  for (int level = 0; level == 0 || half(longest, level - 1) > 1; ++level)
    sides.push_back(std::max<std::int64_t>(half(side, level), 1));
  return sides;
}

/// As many as OpenEXR's getChunkOffsetTableSize() counts.
std::uint64_t blockCount(const ExrLayout& layout) {
  const std::int64_t width = std::int64_t{layout.maxX} - layout.minX + 1,
                     height = std::int64_t{layout.maxY} - layout.minY + 1;
  if (!layout.isTiled()) return blocksAlong(height, layout.rows);
  using Levels = ExrLayout::Levels;
  const bool each = layout.levels == Levels::ripmap;
  std::vector<std::int64_t> widths{width}, heights{height};
  if (layout.levels != Levels::one) {
    const std::int64_t longest = std::max(width, height);
    widths = levelSides(width, each ? width : longest, layout.roundsUp);
    heights = levelSides(height, each ? height : longest, layout.roundsUp);
  }
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < widths.size(); ++i)
    for (std::size_t k = each ? 0 : i; k < (each ? heights.size() : i + 1); ++k)
      count += blocksAlong(widths[i], layout.tileWidth) * blocksAlong(heights[k], layout.tileHeight);
  return count;
}

}  // namespace

ExrHeaders exrHeaders(std::string_view bytes) {
  constexpr int kTiled = 0x200, kSeveral = 0x1000;
  Walker walker(bytes, kExrMagicAndVersion - 4);
  const int flags = walker.integer();
  ExrHeaders headers{(flags & kTiled) != 0, (flags & kSeveral) != 0, 0};
  bool more = skipHeader(walker);
  while (headers.several && more) more = skipHeader(walker);
  headers.offsets = walker.at();
  return headers;
}

void checkExrBlocks(std::string_view bytes, const ExrHeaders& headers, const std::vector<ExrLayout>& parts) {
  const ExrLayout& layout = parts.back();
  const bool tiled = layout.isTiled();
  const int width = tiled ? layout.tileWidth : layout.maxX - layout.minX + 1;
  const int height = tiled ? layout.tileHeight : layout.rows;
  const auto columns =
      static_cast<std::int64_t>(blocksAlong(std::int64_t{layout.maxX} - layout.minX + 1, width));
  const auto rows =
      static_cast<std::int64_t>(blocksAlong(std::int64_t{layout.maxY} - layout.minY + 1, height));
  std::uint64_t offsets = headers.offsets;
  for (std::size_t part = 0; part + 1 < parts.size(); ++part) offsets += 8 * blockCount(parts[part]);
  Walker table(bytes, offsets);
  for (std::int64_t i = 0; i < columns * rows; ++i) {
    Walker block(bytes, table.whole(8));
    if (headers.several && block.integer() != static_cast<int>(parts.size()) - 1)
      throw std::runtime_error("a block of pixels is of another part");
    std::int64_t column = 0, row = 0;
    if (tiled) {
      column = block.integer();
      row = block.integer();
      const int levelX = block.integer(), levelY = block.integer();
      if (levelX != 0 || levelY != 0) throw std::runtime_error("a tile is not where it belongs");
    } else {
      row = (std::int64_t{block.integer()} - layout.minY) / height;
    }
    if (column < 0 || column >= columns || row < 0 || row >= rows)
      throw std::runtime_error("a block of pixels lies outside the picture");
    const int size = block.integer();
    if (size < 0) throw std::runtime_error("a block of pixels has a negative length");
    const std::string_view packed = block.take(static_cast<std::uint64_t>(size));
    Window window{static_cast<int>(layout.minX + column * width),
                  static_cast<int>(layout.minY + row * height), 0, 0};
    window.maxX = std::min(window.minX + width - 1, layout.maxX);
    window.maxY = std::min(window.minY + height - 1, layout.maxY);
    checkBlock(packed, bytesOf(layout, window), layout.packing);
  }
}

}  // namespace trace
