// Sources of the heads: PNG (W3C, 3rd edition, sections 5 and 11), JPEG (ITU-T T.81, annex B), Truevision TGA
// 2.0, WebP (RFC 9649, sections 2.7 and 3.4).
#include "formats/model_textures.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <utility>

#include "base/files/file.h"
#include "base/files/read_scope.h"
#include "shading/textures/image_map.h"
#include "shading/textures/mix.h"
#include "shading/textures/ramp.h"

namespace trace {
namespace {

unsigned byteAt(std::string_view bytes, std::size_t i) {
  return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0u;
}

PictureKind kindOfPng(std::string_view bytes) {
  constexpr std::size_t kColorType = 25, kFirstChunk = 33;
  const unsigned type = byteAt(bytes, kColorType);
  PictureKind kind{.colored = type != 0 && type != 4, .transparent = type == 4 || type == 6};
  for (std::size_t at = kFirstChunk; at + 8 <= bytes.size();) {
    const std::string_view name = bytes.substr(at + 4, 4);
    if (name == "IDAT") break;
    kind.transparent |= name == "tRNS";
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) length = length << 8 | byteAt(bytes, at + i);
    at += length + 12;
  }
  return kind;
}

PictureKind kindOfJpeg(std::string_view bytes) {
  for (std::size_t at = 2; at + 9 < bytes.size() && byteAt(bytes, at) == 0xff;) {
    const unsigned marker = byteAt(bytes, at + 1);
    const bool isFrame =
        marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
    if (isFrame) return {.colored = byteAt(bytes, at + 9) != 1, .transparent = false};
    at += 2 + (byteAt(bytes, at + 2) << 8 | byteAt(bytes, at + 3));
  }
  return {};
}

PictureKind kindOfWebp(std::string_view bytes) {
  constexpr std::size_t kChunk = 12, kData = 20;
  const std::string_view chunk = bytes.substr(std::min(kChunk, bytes.size()), 4);
  const unsigned extended = byteAt(bytes, kData), lossless = byteAt(bytes, kData + 4);
  constexpr unsigned kAlpha = 0x10, kAnimated = 0x02;  // an animation is clear around its first picture
  return {.colored = true,
          .transparent = (chunk == "VP8X" && (extended & (kAlpha | kAnimated)) != 0) ||
                         (chunk == "VP8L" && (lossless & kAlpha) != 0)};
}

/// Its first bytes; none of what may not be read, or is no ordinary file, which may have no end.
std::string headOf(const std::string& path) {
  constexpr std::size_t kHead = 1 << 16;
  if (!mayRead(path)) return {};
  try {
    return readStart(path, kHead);
  } catch (const Error&) {
    return {};
  }
}

/// `otherwise` where the luminance of `amount`, times `share`, is 0, and `whole`, times the texture `own` if
/// there is one, where it is 1.
Texture mixture(const Color& otherwise, const Color& whole, const Texture* own, const Texture& amount,
                Real share = 1) {
  TextureNode node{.model = Mix{.a = otherwise, .b = whole, .amount = share}};
  setTexture(node.inputs, "amount", amount);
  if (own) setTexture(node.inputs, "b", *own);
  return node;
}

}  // namespace

ImageMap modelPicture(Pixels pixels) { return {.file = std::move(pixels), .filter = TexelFilter::trilinear}; }
ImageMap modelPicture(std::string file, SourcePlace place) {
  return modelPicture(Pixels{std::move(file), nullptr, std::move(place)});
}

PictureKind kindOfPicture(std::string_view bytes) {
  if (bytes.starts_with("\x89PNG")) return kindOfPng(bytes);
  if (bytes.starts_with("\xff\xd8\xff")) return kindOfJpeg(bytes);
  if (bytes.starts_with("RIFF")) return kindOfWebp(bytes);
  constexpr std::size_t kMap = 1, kType = 2, kBits = 16;
  const unsigned type = byteAt(bytes, kType);
  const bool isTga = byteAt(bytes, kMap) <= 1 && (type == 2 || type == 3 || type == 10 || type == 11);
  if (bytes.size() > 18 && isTga)
    return {.colored = type != 3 && type != 11, .transparent = byteAt(bytes, kBits) == 32};
  return {};
}
PictureKind kindOfPicture(const std::string& from, const std::string& name) {
  return kindOfPicture(headOf(pictureFile(from, name)));
}

Pixels InsidePictures::decode(std::string file, InsideFile picture, const SourcePlace& place) {
  Pixels pixels{std::move(file), nullptr, place};
  try {
    pixels.map = MipMap::decode(picture.bytes, pixels.file);
    pixels.inside = std::make_shared<const InsideFile>(std::move(picture));
  } catch (const Error& error) {
    if (error.fault() == Fault::limit) throw;
    if (unread_.empty()) reason_ = error.messages().front().what;
    unread_.note(pixels.file, place);
    pixels.map = missingPicture();
  }
  return pixels;
}

Texture product(const Texture& color, const Texture& grey) {
  return mixture(Color(0), Color(1), &color, grey);
}

Texture raised(const Texture& grey, Real from) { return mixture(Color(from), Color(1), nullptr, grey); }

Texture threshold(const Texture& grey, Real least) {
  Ramp step;
  step.value = 1;
  step.ramp = {{least, 0, 0, 0}, {least, 1, 1, 1}};
  TextureNode node{.model = std::move(step)};
  setTexture(node.inputs, "value", grey);
  return node;
}

void cutOut(Material& material, const Texture& opacity, Real share) {
  material.opacity = share;
  setTexture(material.textures, kOpacity, opacity);
}

}  // namespace trace
