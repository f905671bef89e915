// WebP files for tests, by libwebp's encoder: Trace only reads them.
#pragma once

#include <webp/encode.h>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "image/development/tone.h"
#include "image/raster.h"

namespace trace::test {

/// Of a raster of bytes with 3 or 4 channels. Without loss every sample comes back, also where it is clear.
inline std::string webpOf(const Raster& raster, bool lossless = true) {
  const auto& samples = std::get<std::vector<std::uint8_t>>(raster.samples);
  WebPConfig config;
  WebPPicture picture;
  WebPMemoryWriter writer;
  if (!WebPConfigInit(&config) || !WebPPictureInit(&picture)) throw std::runtime_error("another libwebp");
  WebPMemoryWriterInit(&writer);
  config.lossless = lossless;
  config.exact = 1;
  config.method = 0;
  config.quality = lossless ? 0 : 90;
  picture.use_argb = lossless;
  picture.width = raster.width;
  picture.height = raster.height;
  picture.writer = WebPMemoryWrite;
  picture.custom_ptr = &writer;
  const int stride = raster.width * raster.channels;
  const bool imported = raster.channels == 4 ? WebPPictureImportRGBA(&picture, samples.data(), stride)
                                             : WebPPictureImportRGB(&picture, samples.data(), stride);
  const bool done = imported && WebPEncode(&config, &picture);
  const std::string file(reinterpret_cast<const char*>(writer.mem), writer.size);
  WebPPictureFree(&picture);
  WebPMemoryWriterClear(&writer);
  if (!done) throw std::runtime_error("libwebp cannot write this picture");
  return file;
}

inline std::string webpOf(const Picture& picture, Rounding rounding) {
  Raster raster(picture.width, picture.height, 3, 255);
  raster.samples = toBytes(picture, rounding).rgb;
  return webpOf(raster);
}

// --- the container ---

inline std::string littleEndian(std::size_t value, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> 8 * i);
  return text;
}
inline std::string webpChunk(const std::string& name, const std::string& data) {
  return name + littleEndian(data.size(), 4) + data + std::string(data.size() % 2, '\0');
}
inline std::string webpFile(const std::string& chunks) {
  return "RIFF" + littleEndian(chunks.size() + 4, 4) + "WEBP" + chunks;
}
/// The chunks of a file that webpFile() or webpOf() made.
inline std::string chunksOf(const std::string& webp) { return webp.substr(12); }
/// The head of a file with more than a picture. Bits of `flags`: 2 animation, 4 XMP, 8 EXIF, 16 alpha, 32
/// ICC.
inline std::string webpHead(int flags, int width, int height) {
  return webpChunk("VP8X", littleEndian(static_cast<std::size_t>(flags), 4) +
                               littleEndian(static_cast<std::size_t>(width - 1), 3) +
                               littleEndian(static_cast<std::size_t>(height - 1), 3));
}
/// One picture of an animation, at a place of even numbers.
inline std::string webpFrame(int x, int y, const Raster& raster) {
  return webpChunk("ANMF", littleEndian(static_cast<std::size_t>(x / 2), 3) +
                               littleEndian(static_cast<std::size_t>(y / 2), 3) +
                               littleEndian(static_cast<std::size_t>(raster.width - 1), 3) +
                               littleEndian(static_cast<std::size_t>(raster.height - 1), 3) +
                               littleEndian(100, 3) + '\0' + chunksOf(webpOf(raster)));
}
/// An animation on a canvas.
inline std::string webpAnimation(int width, int height, const std::string& frames) {
  return webpFile(webpHead(2 | 16, width, height) + webpChunk("ANIM", std::string(6, '\0')) + frames);
}

}  // namespace trace::test
