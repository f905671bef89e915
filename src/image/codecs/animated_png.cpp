#include "image/codecs/animated_png.h"

#include <algorithm>
#include <cmath>

#include "image/codecs/codec_parts.h"

namespace trace {
namespace {

std::string inBytes(std::uint32_t number, int bytes) {
  std::string text;
  for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8) text += static_cast<char>(number >> shift & 255);
  return text;
}

}  // namespace

void AnimatedPng::add(const Bytes& picture, double seconds) {
  constexpr std::uint32_t kPerSecond = 100;
  const double longest = 65535;
  if (pictures_ == 0) width_ = picture.width, height_ = picture.height;
  const auto time = static_cast<std::uint32_t>(std::clamp(std::round(seconds * kPerSecond), 1.0, longest));
  body_ +=
      pngChunk("fcTL", inBytes(chunks_++, 4) + inBytes(static_cast<std::uint32_t>(width_), 4) +
                           inBytes(static_cast<std::uint32_t>(height_), 4) + inBytes(0, 4) + inBytes(0, 4) +
                           inBytes(time, 2) + inBytes(kPerSecond, 2) + inBytes(0, 1) + inBytes(0, 1));
  const std::string png = encodePngRows(picture);
  forEachPngChunk(png, [&](std::string_view type, std::string_view data) {
    if (type == "IHDR" && pictures_ == 0) header_ = pngChunk("IHDR", std::string(data));
    if (type != "IDAT") return;
    body_ += pictures_ == 0 ? pngChunk("IDAT", std::string(data))
                            : pngChunk("fdAT", inBytes(chunks_++, 4) + std::string(data));
  });
  ++pictures_;
}

std::string AnimatedPng::finish() const {
  return "\x89PNG\r\n\x1a\n" + header_ + pngChunk("acTL", inBytes(pictures_, 4) + inBytes(0, 4)) + body_ +
         pngChunk("IEND", "");
}

}  // namespace trace
