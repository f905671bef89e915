// Reading EXR through OpenEXR, which only this file and exr_file.cpp see. One station of codec.cpp's table.
// Read: one layer (exr_layers.h) of any sample type and any primaries; the display window is the picture, in
// which colours are multiplied by A. Source: "OpenEXR File Layout" and "Reading and Writing OpenEXR Image
// Files" (openexr.com). No threads are started.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "base/budget.h"
#include "image/codecs/codec.h"
#include "image/codecs/codec_parts.h"
#include "image/codecs/exr_chunks.h"
#include "image/codecs/exr_file.h"
#include "image/codecs/exr_layers.h"
#include "image/codecs/openexr.h"

namespace trace {
namespace {

constexpr std::string_view kPrefix = kExrWordPrefix;

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

/// The headers alone, before OpenEXR allocates what they ask for.
std::vector<Imf::Header> headersOf(std::string_view bytes, bool several) {
  constexpr size_t kMostParts = 1000;
  MemoryInput input(bytes);
  char start[kExrMagicAndVersion];
  input.read(start, kExrMagicAndVersion);
  int version = 0;
  for (int i = 3; i >= 0; --i) version = version << 8 | static_cast<unsigned char>(start[4 + i]);
  std::vector<Imf::Header> headers;
  do {
    Imf::Header header;
    header.readFrom(input, version);
    if (several && header.readsNothing()) break;  // behind the last
    headers.push_back(header);
    if (headers.size() > kMostParts) throw std::runtime_error("more than 1000 parts are not read");
  } while (several);
  return headers;
}

std::vector<ExrPart> partsOf(const std::vector<Imf::Header>& headers) {
  std::vector<ExrPart> parts;
  for (const Imf::Header& header : headers) {
    ExrPart& part = parts.emplace_back();
    if (header.hasName() && headers.size() > 1) part.name = header.name();
    for (auto c = header.channels().begin(); c != header.channels().end(); ++c)
      part.channels.emplace_back(c.name());
  }
  return parts;
}

/// Width and height of a window; throws if they are absurd.
struct Extent {
  int width, height;
};
Extent extentOf(const Imath::Box2i& window) {
  constexpr int kFarthest = 1 << 24;
  for (int corner : {window.min.x, window.min.y, window.max.x, window.max.y})
    if (corner < -kFarthest || corner > kFarthest)
      throw std::runtime_error("a window is too far from the origin");
  return {window.max.x - window.min.x + 1, window.max.y - window.min.y + 1};
}
Extent checkedExtent(const Imath::Box2i& window, size_t fileBytes, const PictureLimits& limits) {
  const Extent extent = extentOf(window);
  checkClaimedSize(extent.width, extent.height, fileBytes, kPackedPixelsPerByte, limits);
  return extent;
}

/// The channels side by side, of the pixels that the file stores.
template <class Input>
std::vector<float> readValues(Input& input, const Extent& stored, const ShownChannels& names) {
  const Imath::Box2i& data = input.header().dataWindow();
  const size_t channels = names.shown.size();
  std::vector<float> values(channels * static_cast<size_t>(stored.width) *
                            static_cast<size_t>(stored.height));
  Imf::FrameBuffer target;
  for (size_t i = 0; i < channels; ++i) {
    if (names.shown[i].empty()) continue;
    const Imf::Channel& channel = input.header().channels()[names.shown[i].c_str()];
    if (channel.xSampling != 1 || channel.ySampling != 1)
      throw std::runtime_error("channels stored at lower resolution are not read");
    target.insert(names.shown[i], Imf::Slice::Make(Imf::FLOAT, values.data() + i, data.min, stored.width,
                                                   stored.height, channels * sizeof(float)));
  }
  input.setFrameBuffer(target);
  input.readPixels(data.min.y, data.max.y);
  return values;
}

/// A channel that may have fewer samples than the picture has pixels, looked up between them.
struct SparseChannel {
  std::vector<float> samples;
  int width = 0, height = 0, xSampling = 1, ySampling = 1;

  double at(int x, int y) const {
    const double u = std::min(static_cast<double>(x) / xSampling, width - 1.0),
                 v = std::min(static_cast<double>(y) / ySampling, height - 1.0);
    const int i = static_cast<int>(u), j = static_cast<int>(v);
    const auto sample = [&](int column, int row) {
      return static_cast<double>(
          samples[static_cast<size_t>(std::min(row, height - 1)) * static_cast<size_t>(width) +
                  static_cast<size_t>(std::min(column, width - 1))]);
    };
    const double s = u - i, t = v - j;
    return (1 - t) * ((1 - s) * sample(i, j) + s * sample(i + 1, j)) +
           t * ((1 - s) * sample(i, j + 1) + s * sample(i + 1, j + 1));
  }
};

/// Colours of a luminance Y and RY = (R - Y) / Y, BY = (B - Y) / Y.
template <class Input>
std::vector<float> readChroma(Input& input, const Extent& stored, const ShownChannels& names) {
  const Imath::Box2i& data = input.header().dataWindow();
  const std::string layer = names.shown[0].substr(0, names.shown[0].size() - 1);
  const bool alpha = names.shown.size() > 3;
  std::vector<std::string> wanted{layer + "Y", layer + "RY", layer + "BY"};
  if (alpha) wanted.push_back(layer + "A");
  std::vector<SparseChannel> parts(wanted.size());
  Imf::FrameBuffer target;
  for (size_t i = 0; i < wanted.size(); ++i) {
    const Imf::Channel& channel = input.header().channels()[wanted[i].c_str()];
    SparseChannel& part = parts[i];
    part.xSampling = std::max(channel.xSampling, 1);
    part.ySampling = std::max(channel.ySampling, 1);
    part.width = std::max(stored.width / part.xSampling, 1);
    part.height = std::max(stored.height / part.ySampling, 1);
    part.samples.resize(static_cast<size_t>(part.width) * static_cast<size_t>(part.height));
    target.insert(wanted[i],
                  Imf::Slice::Make(Imf::FLOAT, part.samples.data(), data.min, stored.width, stored.height,
                                   sizeof(float), static_cast<size_t>(part.width) * sizeof(float),
                                   part.xSampling, part.ySampling));
  }
  input.setFrameBuffer(target);
  input.readPixels(data.min.y, data.max.y);
  const Imf::Chromaticities primaries =
      Imf::hasChromaticities(input.header()) ? Imf::chromaticities(input.header()) : Imf::Chromaticities();
  const Imath::V3f weights = Imf::RgbaYca::computeYw(primaries);
  std::vector<float> values;
  values.reserve(names.shown.size() * static_cast<size_t>(stored.width) * static_cast<size_t>(stored.height));
  for (int y = 0; y < stored.height; ++y)
    for (int x = 0; x < stored.width; ++x) {
      const double luminance = parts[0].at(x, y);
      const double red = (parts[1].at(x, y) + 1) * luminance, blue = (parts[2].at(x, y) + 1) * luminance;
      const double green = (luminance - red * weights.x - blue * weights.z) / weights.y;
      for (double channel : {red, green, blue}) values.push_back(static_cast<float>(channel));
      if (alpha) values.push_back(static_cast<float>(parts[3].at(x, y)));
    }
  return values;
}

template <class Input>
std::vector<float> readPart(Input& input, const Extent& stored, const ShownChannels& names) {
  return names.isChroma ? readChroma(input, stored, names) : readValues(input, stored, names);
}

/// Colours of other primaries than Rec. 709's, if the file names them, become those.
void toRec709(const Imf::Header& header, size_t channels, std::vector<float>& values) {
  if (channels < 3 || !Imf::hasChromaticities(header)) return;
  const Imf::Chromaticities &given = Imf::chromaticities(header), rec709;
  const auto same = [](const Imath::V2f& a, const Imath::V2f& b) {
    constexpr float kClose = 1e-3f;
    return std::abs(a.x - b.x) < kClose && std::abs(a.y - b.y) < kClose;
  };
  if (same(given.red, rec709.red) && same(given.green, rec709.green) && same(given.blue, rec709.blue) &&
      same(given.white, rec709.white))
    return;
  const Imath::M44f matrix = Imf::RGBtoXYZ(given, 1) * Imf::XYZtoRGB(rec709, 1);
  for (size_t i = 0; i + 2 < values.size(); i += channels) {
    const Imath::V3f color = Imath::V3f(values[i], values[i + 1], values[i + 2]) * matrix;
    values[i] = color.x;
    values[i + 1] = color.y;
    values[i + 2] = color.z;
  }
}

/// The layout of a part.
ExrLayout layoutOf(const Imf::Header& header, const ExrHeaders& headers) {
  ExrLayout layout;
  const Imath::Box2i& data = header.dataWindow();
  layout.minX = data.min.x;
  layout.minY = data.min.y;
  layout.maxX = data.max.x;
  layout.maxY = data.max.y;
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c)
    layout.channels.push_back(
        {c.channel().type == Imf::HALF ? 2 : 4, c.channel().xSampling, c.channel().ySampling});
  const Extent extent = extentOf(data);
  if (extent.width < 1 || extent.height < 1) throw std::runtime_error("a part has no pixels");
  const bool isTiled = header.hasTileDescription() && (headers.tiled || headers.several);
  if (isTiled) {
    constexpr unsigned kLargestTile = 1 << 16;
    const Imf::TileDescription& tile = header.tileDescription();
    if (tile.xSize < 1 || tile.ySize < 1 || tile.xSize > kLargestTile || tile.ySize > kLargestTile)
      throw std::runtime_error("tiles of 1 to 65536 pixels a side were expected");
    layout.tileWidth = static_cast<int>(tile.xSize);
    layout.tileHeight = static_cast<int>(tile.ySize);
    layout.levels = tile.mode == Imf::MIPMAP_LEVELS   ? ExrLayout::Levels::mipmap
                    : tile.mode == Imf::RIPMAP_LEVELS ? ExrLayout::Levels::ripmap
                                                      : ExrLayout::Levels::one;
    layout.roundsUp = tile.roundingMode == Imf::ROUND_UP;
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

Raster decodeExr(std::string_view bytes, const PictureLimits& limits) {
  return decodeExrLayer(bytes, limits, "");
}

Raster decodeExrLayer(std::string_view bytes, const PictureLimits& limits, const std::string& layer) {
  const ExrHeaders headers = exrHeaders(bytes);
  const std::vector<Imf::Header> all = headersOf(bytes, headers.several);
  const ShownChannels names = shownChannels(partsOf(all), layer);
  const Imf::Header& header = all[names.part];
  const Imath::Box2i &data = header.dataWindow(), &display = header.displayWindow();
  const Extent stored = checkedExtent(data, bytes.size(), limits);
  const Extent shown = checkedExtent(display, bytes.size(), limits);
  if (header.hasType() && Imf::isDeepData(header.type()))
    throw std::runtime_error("deep pictures, of several samples a pixel, are not read");
  std::vector<ExrLayout> layouts;
  for (size_t part = 0; part <= names.part; ++part) layouts.push_back(layoutOf(all[part], headers));
  checkExrBlocks(bytes, headers, layouts);

  MemoryInput stream(bytes);
  std::vector<float> values;
  if (headers.several) {
    Imf::MultiPartInputFile file(stream, kNoThreads);
    Imf::InputPart input(file, static_cast<int>(names.part));
    values = readPart(input, stored, names);
  } else {
    Imf::InputFile input(stream, kNoThreads);
    values = readPart(input, stored, names);
  }
  const size_t channels = names.shown.size();
  toRec709(header, channels, values);

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

std::string exrRemark(std::string_view bytes) { return exrLayerRemark(bytes, ""); }

std::string exrLayerRemark(std::string_view bytes, const std::string& layer) {
  const ExrHeaders headers = exrHeaders(bytes);
  const std::vector<Imf::Header> all = headersOf(bytes, headers.several);
  const ShownChannels names = shownChannels(partsOf(all), layer);
  const Imf::Header& header = all[names.part];
  std::string text = names.remark;
  constexpr float kClose = 1e-4f;
  if (const float aspect = header.pixelAspectRatio(); std::abs(aspect - 1) > kClose)
    remark(text, "its pixels are not square, but shown as squares");
  if (Imf::hasEnvmap(header) && Imf::envmap(header) == Imf::ENVMAP_CUBE)
    remark(text, "the six sides of its cube are shown one below the other");
  if (Imf::hasAdoptedNeutral(header)) remark(text, "its adopted white is not taken into account");
  if (Imf::hasWhiteLuminance(header)) remark(text, "the luminance of its white is not taken into account");
  if (Imf::hasWrapmodes(header)) remark(text, "its wrap modes are not taken into account");
  return text;
}

Metadata exrMetadata(std::string_view bytes) {
  const bool several = exrHeaders(bytes).several;  // no attribute is longer than the file
  const std::vector<Imf::Header> all = headersOf(bytes, several);
  if (all.empty()) return {};
  const Imf::Header& header = all[0];
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
