// EXR through OpenEXR, the only file that sees it; in memory, so that all writing goes through base/file.h.
// One station of codec.cpp's table. Written: channels R, G, B as 32-bit floats, zip-compressed. Read: R, G,
// B, luminance and chroma, or a grey, and A, of any sample type and any primaries; the display window is the
// picture, in which colours are multiplied by A. Source: "OpenEXR File Layout" and "Reading and Writing
// OpenEXR Image Files" (openexr.com). No threads are started.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <stdexcept>
#include <string>
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
#include <ImfChromaticities.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfPartType.h>
#include <ImfRgbaYca.h>
#include <ImfStandardAttributes.h>
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

/// Which channels of a file are the picture.
struct ShownChannels {
  std::vector<std::string> shown;  ///< red, green, blue or a grey, then alpha; "" for one that is black
  bool isChroma = false;           ///< Y, RY and BY stand for red, green and blue
  std::string remark;              ///< remark on parts that are not shown
};

/// Channels of the layer that are no part of the picture, such as the depth.
std::string unshown(const std::vector<std::string>& names, const ShownChannels& found,
                    const std::string& layer) {
  constexpr size_t kMostNamed = 5;
  std::string list;
  size_t count = 0;
  for (const std::string& name : names) {
    const bool isPart = name.starts_with(layer) && name.find('.', layer.size()) == std::string::npos;
    const bool isShown =
        std::find(found.shown.begin(), found.shown.end(), name) != found.shown.end() ||
        (found.isChroma && (name == layer + "Y" || name == layer + "RY" || name == layer + "BY"));
    if (!isPart || isShown || ++count > kMostNamed) continue;
    list += (list.empty() ? "" : ", ") + name;
  }
  return list.empty() ? ""
                      : "channels that are not shown: " + list + (count > kMostNamed ? " and others" : "");
}

/// R, G and B, or Y with RY and BY, or Y; or those of the first layer; or the first channel, as a grey.
ShownChannels shownChannels(const Imf::ChannelList& channels) {
  std::vector<std::string> names, layers{""};
  for (auto c = channels.begin(); c != channels.end(); ++c) {
    names.emplace_back(c.name());
    const size_t dot = names.back().rfind('.');
    if (dot == std::string::npos) continue;
    if (const std::string layer = names.back().substr(0, dot + 1); layer != layers.back())
      layers.push_back(layer);
  }
  if (names.empty()) throw std::runtime_error("it has no channel");
  const auto has = [&](const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  const auto isPart = [](const std::string& name, const std::string& layer) {
    return name.starts_with(layer) && name.find('.', layer.size()) == std::string::npos;
  };
  ShownChannels found;
  for (const std::string& layer : layers) {
    const int colors = has(layer + "R") + has(layer + "G") + has(layer + "B");
    found.isChroma = colors == 0 && has(layer + "Y") && has(layer + "RY") && has(layer + "BY");
    if (colors >= 2 || found.isChroma)
      for (const char* name : {"R", "G", "B"})
        found.shown.push_back(found.isChroma || has(layer + name) ? layer + name : "");
    else if (has(layer + "Y"))
      found.shown.push_back(layer + "Y");
    if (found.shown.empty()) continue;
    if (has(layer + "A")) found.shown.push_back(layer + "A");
    if (!layer.empty())
      found.remark = "the layer \"" + layer.substr(0, layer.size() - 1) + "\" is shown, and no other";
    else if (const auto others = std::count_if(names.begin(), names.end(),
                                               [&](const std::string& name) { return !isPart(name, ""); });
             others > 0)
      found.remark = "its layers are not shown";
    remark(found.remark, unshown(names, found, layer));
    return found;
  }
  const auto first = std::find_if(names.begin(), names.end(), [](const std::string& n) { return n != "A"; });
  found.shown.push_back(first == names.end() ? names[0] : *first);
  if (has("A") && found.shown[0] != "A") found.shown.emplace_back("A");
  if (names.size() > found.shown.size())
    found.remark = "of its channels only \"" + found.shown[0] + "\" is shown, as a grey";
  return found;
}

/// The channels side by side, of the pixels that the file stores.
std::vector<float> readValues(Imf::InputFile& input, const Extent& stored, const ShownChannels& names) {
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
std::vector<float> readChroma(Imf::InputFile& input, const Extent& stored, const ShownChannels& names) {
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

  if (header.hasType() && Imf::isDeepData(header.type()))
    throw std::runtime_error("deep pictures, of several samples a pixel, are not read");
  MemoryInput stream(bytes);
  Imf::InputFile input(stream, kNoThreads);
  const ShownChannels names = shownChannels(input.header().channels());
  const size_t channels = names.shown.size();
  std::vector<float> values =
      names.isChroma ? readChroma(input, stored, names) : readValues(input, stored, names);
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

std::string exrRemark(std::string_view bytes) {
  const ExrHeaders headers = exrHeaders(bytes);
  const Imf::Header header = headerOf(bytes);
  std::string all = shownChannels(header.channels()).remark;
  if (headers.several) remark(all, "only the first of its parts is shown");
  constexpr float kClose = 1e-4f;
  if (const float aspect = header.pixelAspectRatio(); std::abs(aspect - 1) > kClose)
    remark(all, "its pixels are not square, but shown as squares");
  if (Imf::hasEnvmap(header) && Imf::envmap(header) == Imf::ENVMAP_CUBE)
    remark(all, "the six sides of its cube are shown one below the other");
  if (Imf::hasAdoptedNeutral(header)) remark(all, "its adopted white is not taken into account");
  if (Imf::hasWhiteLuminance(header)) remark(all, "the luminance of its white is not taken into account");
  if (Imf::hasWrapmodes(header)) remark(all, "its wrap modes are not taken into account");
  return all;
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
