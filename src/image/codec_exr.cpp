// EXR through OpenEXR, the only file that sees it; in memory, so that all writing goes through base/file.h.
// One station of codec.cpp's table. Written: channels R, G, B as 32-bit floats, zip-compressed. Read: R, G, B
// or Y, and A, of any sample type; the display window is the picture, in which colours are multiplied by A.
// Source: "OpenEXR File Layout" and "Reading and Writing OpenEXR Image Files" (openexr.com). No threads are
// started.
#include <algorithm>
#include <cstddef>
#include <cstring>
#include <stdexcept>
#include <utility>
#include <vector>

#include "base/budget.h"
#include "image/codec.h"
#include "image/codec_parts.h"
#include "image/exr_chunks.h"

#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wdeprecated-copy"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#endif
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <ImfTileDescription.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace trace {
namespace {

constexpr int kNoThreads = 0;
/// Keeps our words apart from the attributes OpenEXR gives a meaning.
constexpr std::string_view kPrefix = "trace:";

class MemoryOutput : public Imf::OStream {
 public:
  explicit MemoryOutput(std::string& file) : Imf::OStream("memory"), file_(file) {}
  void write(const char bytes[], int count) override {
    const size_t n = static_cast<size_t>(count);
    if (file_.size() < place_ + n) file_.resize(place_ + n);
    std::memcpy(file_.data() + place_, bytes, n);
    place_ += n;
  }
  uint64_t tellp() override { return place_; }
  void seekp(uint64_t place) override { place_ = static_cast<size_t>(place); }

 private:
  std::string& file_;
  size_t place_ = 0;
};

class MemoryInput : public Imf::IStream {
 public:
  explicit MemoryInput(std::string_view file) : Imf::IStream("memory"), file_(file) {}
  bool read(char bytes[], int count) override {
    if (count < 0 || place_ > file_.size() || static_cast<size_t>(count) > file_.size() - place_)
      throw std::runtime_error("the file ends too early");
    std::memcpy(bytes, file_.data() + place_, static_cast<size_t>(count));
    place_ += static_cast<size_t>(count);
    return place_ < file_.size();
  }
  uint64_t tellg() override { return place_; }
  void seekg(uint64_t place) override { place_ = place; }

 private:
  std::string_view file_;
  uint64_t place_ = 0;
};

/// The header alone, before OpenEXR allocates what it asks for. Only the first of several parts counts.
Imf::Header headerOf(std::string_view bytes) {
  MemoryInput input(bytes);
  char start[kExrMagicAndVersion];
  input.read(start, kExrMagicAndVersion);
  int version = 0;
  for (int i = 3; i >= 0; --i) version = version << 8 | static_cast<unsigned char>(start[4 + i]);
  Imf::Header header;
  header.readFrom(input, version);
  return header;
}

/// Width and height of a window; throws if they are absurd.
struct Extent {
  int width, height;
};
Extent checkedExtent(const Imath::Box2i& window, size_t fileBytes, const PictureLimits& limits) {
  constexpr int kFarthest = 1 << 24;
  for (int corner : {window.min.x, window.min.y, window.max.x, window.max.y})
    if (corner < -kFarthest || corner > kFarthest)
      throw std::runtime_error("a window lies absurdly far away");
  const Extent extent{window.max.x - window.min.x + 1, window.max.y - window.min.y + 1};
  checkClaimedSize(extent.width, extent.height, fileBytes, kPackedPixelsPerByte, limits);
  return extent;
}

/// The layout of the part that is read.
ExrLayout layoutOf(const Imf::Header& header, bool tiled) {
  ExrLayout layout;
  const Imath::Box2i& data = header.dataWindow();
  layout.minX = data.min.x;
  layout.minY = data.min.y;
  layout.maxX = data.max.x;
  layout.maxY = data.max.y;
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c)
    layout.channels.push_back(
        {c.channel().type == Imf::HALF ? 2 : 4, c.channel().xSampling, c.channel().ySampling});
  if (tiled) {
    constexpr unsigned kLargestTile = 1 << 16;
    const Imf::TileDescription& tile = header.tileDescription();
    if (tile.xSize < 1 || tile.ySize < 1 || tile.xSize > kLargestTile || tile.ySize > kLargestTile)
      throw std::runtime_error("tiles of 1 to 65536 pixels a side were expected");
    layout.tileWidth = static_cast<int>(tile.xSize);
    layout.tileHeight = static_cast<int>(tile.ySize);
  }
  using Packing = ExrLayout::Packing;
  switch (header.compression()) {
    case Imf::NO_COMPRESSION: layout.packing = Packing::none; break;
    case Imf::RLE_COMPRESSION: layout.packing = Packing::runs; break;
    case Imf::ZIPS_COMPRESSION: layout.packing = Packing::deflate; break;
    case Imf::ZIP_COMPRESSION:
      layout.packing = Packing::deflate;
      layout.rows = 16;
      break;
    case Imf::PXR24_COMPRESSION: layout.rows = 16; break;
    case Imf::DWAB_COMPRESSION: layout.rows = 256; break;
    default: layout.rows = 32; break;
  }
  return layout;
}

}  // namespace

std::string encodeExr(const Picture& picture, Rounding, const Metadata& metadata) {
  std::vector<float> values;
  values.reserve(3 * picture.pixels.size());
  for (const Color& c : picture.pixels) {
    checkBudget();
    for (double channel : {c.r, c.g, c.b}) values.push_back(static_cast<float>(channel));
  }

  Imf::Header header(picture.width, picture.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const auto& [key, text] : metadata)
    header.insert(std::string(kPrefix) + cleanKey(key), Imf::StringAttribute(text));
  Imf::FrameBuffer target;
  const Imath::V2i origin(0, 0);
  const char* names[] = {"R", "G", "B"};
  for (size_t i = 0; i < 3; ++i) {
    header.channels().insert(names[i], Imf::Channel(Imf::FLOAT));
    target.insert(names[i], Imf::Slice::Make(Imf::FLOAT, values.data() + i, origin, picture.width,
                                             picture.height, 3 * sizeof(float)));
  }
  std::string file;
  {
    MemoryOutput stream(file);
    Imf::OutputFile output(stream, header, kNoThreads);
    output.setFrameBuffer(target);
    constexpr int kRows = 16;  // that ZIP packs together
    for (int y = 0; y < picture.height; y += kRows) {
      lookAtBudget();
      output.writePixels(std::min(kRows, picture.height - y));
    }
  }  // the end of `output` completes the file
  return file;
}

Raster decodeExr(std::string_view bytes, const PictureLimits& limits) {
  const ExrHeaders headers = exrHeaders(bytes);
  const Imf::Header header = headerOf(bytes);
  const Imath::Box2i &data = header.dataWindow(), &display = header.displayWindow();
  const Extent stored = checkedExtent(data, bytes.size(), limits);
  const Extent shown = checkedExtent(display, bytes.size(), limits);
  const bool tiled = header.hasTileDescription() && (headers.tiled || headers.several);
  checkExrBlocks(bytes, headers, layoutOf(header, tiled));

  MemoryInput stream(bytes);
  Imf::InputFile input(stream, kNoThreads);
  const bool grey = !input.header().channels().findChannel("R") && input.header().channels().findChannel("Y");
  std::vector<const char*> names = grey ? std::vector{"Y"} : std::vector{"R", "G", "B"};
  if (input.header().channels().findChannel("A")) names.push_back("A");
  const size_t channels = names.size();
  std::vector<float> values(channels * static_cast<size_t>(stored.width) *
                            static_cast<size_t>(stored.height));
  Imf::FrameBuffer target;
  for (size_t i = 0; i < channels; ++i) {
    const Imf::Channel* channel = input.header().channels().findChannel(names[i]);
    if (!channel) throw std::runtime_error("it has neither channels R, G, B nor Y");
    if (channel->xSampling != 1 || channel->ySampling != 1)
      throw std::runtime_error("channels stored at lower resolution are not read");
    target.insert(names[i], Imf::Slice::Make(Imf::FLOAT, values.data() + i, data.min, stored.width,
                                             stored.height, channels * sizeof(float)));
  }
  input.setFrameBuffer(target);
  input.readPixels(data.min.y, data.max.y);

  Raster raster(shown.width, shown.height, static_cast<int>(channels), 1);
  raster.premultiplied = true;
  if (data == display) {
    raster.samples = std::move(values);
    return raster;
  }
  std::vector<float> samples(raster.count());  // black where the file stores nothing
  const float* value = values.data();
  for (int y = data.min.y; y <= data.max.y; ++y)
    for (int x = data.min.x; x <= data.max.x; ++x, value += channels) {
      if (x < display.min.x || x > display.max.x || y < display.min.y || y > display.max.y) continue;
      const auto pixel = static_cast<size_t>(y - display.min.y) * static_cast<size_t>(shown.width) +
                         static_cast<size_t>(x - display.min.x);
      std::copy(value, value + channels, samples.begin() + static_cast<std::ptrdiff_t>(pixel * channels));
    }
  raster.samples = std::move(samples);
  return raster;
}

Metadata exrMetadata(std::string_view bytes) {
  exrHeaders(bytes);  // so that no attribute is longer than the file
  const Imf::Header header = headerOf(bytes);
  Metadata metadata;  // in the order of their names: EXR keeps no other
  for (auto attribute = header.begin(); attribute != header.end(); ++attribute) {
    const std::string_view name = attribute.name();
    const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute.attribute());
    if (text && name.substr(0, kPrefix.size()) == kPrefix)
      metadata.emplace_back(name.substr(kPrefix.size()), text->value());
  }
  return metadata;
}

}  // namespace trace
