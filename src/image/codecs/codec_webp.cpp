// WebP through libwebp, the only file that sees it. One station of codec.cpp's table. Read only: lossy and
// lossless, with and without alpha, and the first picture of an animation. Sources: RFC 9649, "WebP Image
// Format", section 2 (the container); libwebp's decode.h and demux.h. No threads are started.
#include <webp/decode.h>
#include <webp/demux.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <new>
#include <stdexcept>
#include <utility>
#include <variant>
#include <vector>

#include "image/codecs/codec.h"
#include "image/codecs/codec_parts.h"

namespace trace {
namespace {

using namespace std::string_view_literals;

constexpr std::size_t kRiffHead = 12, kChunkHead = 8;

std::size_t littleSize(std::string_view webp, std::size_t at) {
  std::size_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = value << 8 | static_cast<unsigned char>(webp.at(at + i));
  return value;
}

/// The data of the first chunk of that name; empty if the file has none.
std::string_view webpChunk(std::string_view webp, std::string_view name) {
  for (std::size_t at = kRiffHead; at + kChunkHead <= webp.size();) {
    const std::size_t size = littleSize(webp, at + 4), data = at + kChunkHead;
    if (webp.substr(at, 4) == name) return webp.substr(data, size);
    if (size >= webp.size()) break;
    at = data + size + size % 2;
  }
  return {};
}

/// How the file says that the picture lies. Some programs write the name that EXIF has in a JPEG before it.
Orientation webpOrientation(std::string_view webp) {
  constexpr std::string_view kName = "Exif\0\0"sv;
  std::string_view exif = webpChunk(webp, "EXIF");
  if (exif.starts_with(kName)) exif.remove_prefix(kName.size());
  return orientationOfExif(exif);
}

void checkWebp(VP8StatusCode status) {
  switch (status) {
    case VP8_STATUS_OK: return;
    case VP8_STATUS_OUT_OF_MEMORY: throw std::bad_alloc();
    case VP8_STATUS_NOT_ENOUGH_DATA:
    case VP8_STATUS_SUSPENDED: failAtEnd();
    case VP8_STATUS_UNSUPPORTED_FEATURE: throw std::runtime_error("a feature that is not read");
    default: throw std::runtime_error("damaged");
  }
}

WebPBitstreamFeatures webpFeatures(const std::uint8_t* data, std::size_t size) {
  WebPBitstreamFeatures features;
  checkWebp(WebPGetFeatures(data, size, &features));
  return features;
}

/// How many pixels a byte may stand for. A lossless picture of one colour takes 38 bytes, whatever its size:
/// 8192 x 8192 pixels are believed of any file.
double webpPixelsPerByte(std::size_t fileBytes) {
  constexpr double kAnyFile = 1 << 26;
  return std::max(kPackedPixelsPerByte, kAnyFile / static_cast<double>(fileBytes));
}

/// Decodes one picture into the raster, whose pixels are bytes, with its top left corner at that sample.
void decodeInto(Raster& raster, std::size_t first, const std::uint8_t* data, std::size_t size) {
  auto& samples = std::get<std::vector<std::uint8_t>>(raster.samples);
  WebPDecoderConfig config;
  if (!WebPInitDecoderConfig(&config)) throw std::runtime_error("libwebp is of another version");
  config.output.colorspace = raster.hasAlpha() ? MODE_RGBA : MODE_RGB;
  config.output.is_external_memory = 1;
  config.output.u.RGBA.rgba = samples.data() + first;
  config.output.u.RGBA.stride = raster.width * raster.channels;
  config.output.u.RGBA.size = samples.size() - first;
  const VP8StatusCode status = WebPDecode(data, size, &config);
  WebPFreeDecBuffer(&config.output);
  checkWebp(status);
}

Raster blankRaster(int width, int height, int channels) {
  Raster raster(width, height, channels, 255);
  raster.samples = std::vector<std::uint8_t>(raster.count());
  return raster;
}

/// The first frame of an animation, on a canvas that is clear around it.
Raster firstFrame(std::string_view webp, int width, int height) {
  const WebPData data{reinterpret_cast<const std::uint8_t*>(webp.data()), webp.size()};
  const std::unique_ptr<WebPDemuxer, void (*)(WebPDemuxer*)> frames(WebPDemux(&data), WebPDemuxDelete);
  if (!frames) throw std::runtime_error("an animation that is damaged");
  WebPIterator frame;
  if (!WebPDemuxGetFrame(frames.get(), 1, &frame)) throw std::runtime_error("an animation without pictures");
  const std::unique_ptr<WebPIterator, void (*)(WebPIterator*)> release(&frame, WebPDemuxReleaseIterator);
  const WebPBitstreamFeatures features = webpFeatures(frame.fragment.bytes, frame.fragment.size);
  const bool fits = frame.x_offset >= 0 && frame.y_offset >= 0 && features.width <= width - frame.x_offset &&
                    features.height <= height - frame.y_offset;
  if (!fits) throw std::runtime_error("the first picture of the animation is larger than its canvas");
  Raster raster = blankRaster(width, height, 4);
  const auto row = static_cast<std::size_t>(frame.y_offset),
             column = static_cast<std::size_t>(frame.x_offset);
  decodeInto(raster, 4 * (row * static_cast<std::size_t>(width) + column), frame.fragment.bytes,
             frame.fragment.size);
  return raster;
}

}  // namespace

bool isWebp(std::string_view bytes) {
  return bytes.starts_with("RIFF") && bytes.size() >= kRiffHead && bytes.substr(8, 4) == "WEBP";
}

Raster decodeWebp(std::string_view bytes, const PictureLimits& limits) {
  if (littleSize(bytes, 4) > bytes.size() - kChunkHead) failAtEnd();
  const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
  const WebPBitstreamFeatures features = webpFeatures(data, bytes.size());
  checkClaimedSize(features.width, features.height, bytes.size(), webpPixelsPerByte(bytes.size()), limits);
  Raster raster;
  if (features.has_animation) {
    raster = firstFrame(bytes, features.width, features.height);
  } else {
    raster = blankRaster(features.width, features.height, features.has_alpha ? 4 : 3);
    decodeInto(raster, 0, data, bytes.size());
  }
  return oriented(std::move(raster), webpOrientation(bytes));
}

std::string webpRemark(std::string_view bytes) {
  std::string all;
  if (!webpChunk(bytes, "ANIM").empty()) remark(all, "of an animation the first picture is shown");
  if (const std::string_view profile = webpChunk(bytes, "ICCP"); !profile.empty())
    remark(all, profileRemark(profile));
  return all;
}

}  // namespace trace
