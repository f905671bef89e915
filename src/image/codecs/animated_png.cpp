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

struct Part {
  int x = 0, y = 0, width = 1, height = 1;
};

/// The smallest rectangle with all pixels in which they differ; a pixel if none does.
Part differing(const Bytes& a, const Bytes& b) {
  int left = a.width, top = a.height, right = 0, bottom = 0;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) {
      const std::size_t at =
          3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(a.width) + static_cast<std::size_t>(x));
      if (std::equal(&a.rgb[at], &a.rgb[at] + 3, &b.rgb[at])) continue;
      left = std::min(left, x), right = std::max(right, x + 1);
      top = std::min(top, y), bottom = std::max(bottom, y + 1);
    }
  return right == 0 ? Part{} : Part{left, top, right - left, bottom - top};
}

Bytes cutOut(const Bytes& picture, const Part& part) {
  Bytes result{part.width, part.height, {}};
  for (int y = part.y; y < part.y + part.height; ++y) {
    const auto row = picture.rgb.begin() + 3 * (static_cast<std::ptrdiff_t>(y) * picture.width + part.x);
    result.rgb.insert(result.rgb.end(), row, row + 3 * static_cast<std::ptrdiff_t>(part.width));
  }
  return result;
}

}  // namespace

void AnimatedPng::add(const Bytes& picture, double seconds) {
  constexpr std::uint32_t kPerSecond = 100;
  const double longest = 65535;
  const Part part = pictures_ == 0 ? Part{0, 0, picture.width, picture.height} : differing(picture, last_);
  const auto time = static_cast<std::uint32_t>(std::clamp(std::round(seconds * kPerSecond), 1.0, longest));
  std::string control = inBytes(chunks_++, 4);
  for (const int number : {part.width, part.height, part.x, part.y})
    control += inBytes(static_cast<std::uint32_t>(number), 4);
  body_ +=
      pngChunk("fcTL", control + inBytes(time, 2) + inBytes(kPerSecond, 2) + inBytes(0, 1) + inBytes(0, 1));
  const std::string png = encodePngRows(cutOut(picture, part));
  forEachPngChunk(png, [&](std::string_view type, std::string_view data) {
    if (type == "IHDR" && pictures_ == 0) header_ = pngChunk("IHDR", std::string(data));
    if (type != "IDAT") return;
    body_ += pictures_ == 0 ? pngChunk("IDAT", std::string(data))
                            : pngChunk("fdAT", inBytes(chunks_++, 4) + std::string(data));
  });
  last_ = picture;
  ++pictures_;
}

std::string AnimatedPng::finish() const {
  return "\x89PNG\r\n\x1a\n" + header_ + pngChunk("acTL", inBytes(pictures_, 4) + inBytes(0, 4)) + body_ +
         pngChunk("IEND", "");
}

}  // namespace trace
