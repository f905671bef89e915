// The heads of picture files: the orientation they say, and remarks on properties that are not shown.
// One station of codec.cpp's table.
//
// Sources: PNG (ISO/IEC 15948, W3C's third edition, section 11.3); JFIF 1.02; JEITA CP-3451 (EXIF), tag
// 0x0112; ICC.1, annex B (profiles in files); Microsoft, "Bitmap Header Types"; Truevision TGA 2.0, section
// C.6 (extension area).
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "image/codecs/codec_parts.h"

namespace trace {
namespace {

using namespace std::string_view_literals;

constexpr const char* kPixelsNotSquare = "its pixels are not square, but shown as squares";

std::uint32_t byteIn(std::string_view bytes, std::size_t at) {
  return at < bytes.size() ? static_cast<unsigned char>(bytes[at]) : 0u;
}
std::uint32_t bigIn(std::string_view bytes, std::size_t at, std::size_t size = 4) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < size; ++i) value = value << 8 | byteIn(bytes, at + i);
  return value;
}
std::uint32_t littleIn(std::string_view bytes, std::size_t at, std::size_t size = 4) {
  std::uint32_t value = 0;
  for (std::size_t i = size; i-- > 0;) value = value << 8 | byteIn(bytes, at + i);
  return value;
}
/// 0 for both means that nothing is said.
bool isStretched(std::uint32_t x, std::uint32_t y) { return x != 0 && y != 0 && x != y; }

/// The bytes unpacked, as far as they are sound; not more than a profile needs.
std::string inflated(std::string_view packed) {
  constexpr std::size_t kMost = std::size_t{1} << 20;
  std::string text(kMost, '\0');
  z_stream stream{};
  if (inflateInit(&stream) != Z_OK) return {};
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  stream.next_out = reinterpret_cast<Bytef*>(text.data());
  stream.avail_out = static_cast<uInt>(kMost);
  inflate(&stream, Z_FINISH);
  text.resize(kMost - stream.avail_out);
  inflateEnd(&stream);
  return text;
}

// --- PNG ---------------------------------------------------------------------------------------------

/// Red, green and blue of sRGB and its white, as cHRM stores them: white first, times 100,000.
bool areSrgbPrimaries(std::string_view chrm) {
  constexpr std::array<int, 8> kSrgb{31270, 32900, 64000, 33000, 30000, 60000, 15000, 6000};
  for (std::size_t i = 0; i < kSrgb.size(); ++i)
    if (std::abs(static_cast<double>(bigIn(chrm, 4 * i)) - kSrgb[i]) > 500) return false;
  return true;
}

std::string pngColorRemark(std::string_view png) {
  std::string gamma, primaries, profile;
  bool isSrgb = false, hasProfile = false;
  forEachPngChunk(png, [&](std::string_view type, std::string_view data) {
    isSrgb = isSrgb || type == "sRGB";
    const double exponent = bigIn(data, 0) / 1e5;
    if (type == "gAMA" && std::abs(exponent - 1 / 2.2) > 0.01)
      gamma = "its gamma (gAMA) is not taken into account";
    if (type == "cHRM" && !areSrgbPrimaries(data))
      primaries = "its primaries (cHRM) are not taken into account";
    if (type == "iCCP") {
      hasProfile = true;
      const std::size_t name = data.find('\0');
      profile =
          profileRemark(inflated(data.substr(std::min(name == data.npos ? name : name + 2, data.size()))));
    }
    if (type == "cICP") {
      hasProfile = true;
      if (data != "\1\15\0\1"sv) profile = "its colour space (cICP) is not taken into account";
    }
  });
  if (hasProfile) return profile;  // which says more than the rest
  if (isSrgb) return {};
  remark(gamma, primaries);
  return gamma;
}

// --- TGA ---------------------------------------------------------------------------------------------

/// The extension area of TGA 2.0; empty if the file has none.
std::string_view tgaExtension(std::string_view tga) {
  constexpr std::size_t kFooter = 26, kSize = 495;
  if (tga.size() < kFooter || tga.substr(tga.size() - 18) != "TRUEVISION-XFILE.\0"sv) return {};
  const std::size_t at = littleIn(tga, tga.size() - kFooter);
  if (at == 0 || at > tga.size() || tga.size() - at < kSize || littleIn(tga, at, 2) < kSize) return {};
  return tga.substr(at, kSize);
}

}  // namespace

std::string profileRemark(std::string_view profile) {
  const bool isSrgb = profile.find("sRGB") != profile.npos || profile.find("s\0R\0G\0B"sv) != profile.npos;
  return isSrgb ? "" : "its colour profile (ICC) is not taken into account";
}

Orientation orientationOfExif(std::string_view exif) {
  const bool big = exif.starts_with("MM");
  const auto number = [&](std::size_t at, std::size_t size) {
    return big ? bigIn(exif, at, size) : littleIn(exif, at, size);
  };
  const std::size_t directory = number(4, 4), entries = number(directory, 2);
  for (std::size_t k = 0; k < std::min<std::size_t>(entries, 100); ++k) {
    const std::size_t entry = directory + 2 + 12 * k, value = number(entry + 8, 2);
    if (number(entry, 2) == 0x0112 && value >= 1 && value <= 8) return static_cast<Orientation>(value);
  }
  return Orientation::upright;
}

Orientation pngOrientation(std::string_view png) {
  Orientation found = Orientation::upright;
  forEachPngChunk(png, [&](std::string_view type, std::string_view data) {
    if (type == "eXIf") found = orientationOfExif(data);
  });
  return found;
}

std::string pngRemark(std::string_view png) {
  std::string all = pngColorRemark(png);
  forEachPngChunk(png, [&](std::string_view type, std::string_view data) {
    if (type == "pHYs" && isStretched(bigIn(data, 0), bigIn(data, 4))) remark(all, kPixelsNotSquare);
    if (type == "acTL") remark(all, "of an animation (acTL) its still picture is shown");
  });
  return all;
}

void forEachJpegSegment(std::string_view jpeg,
                        const std::function<void(std::uint32_t marker, std::string_view data)>& visit) {
  for (std::size_t i = 2; i + 4 <= jpeg.size() && byteIn(jpeg, i) == 0xFF && byteIn(jpeg, i + 1) != 0xDA;) {
    const std::size_t length = bigIn(jpeg, i + 2, 2);
    visit(byteIn(jpeg, i + 1), jpeg.substr(std::min(i + 4, jpeg.size()), length > 2 ? length - 2 : 0));
    i += 2 + length;
  }
}

std::string jpegHeadRemark(std::string_view jpeg) {
  std::string all, profile;
  bool hasProfile = false;
  forEachJpegSegment(jpeg, [&](std::uint32_t marker, std::string_view data) {
    constexpr std::size_t kProfile = 14;  // behind its name and the number of this part of it
    if (marker == 0xE0 && data.starts_with("JFIF\0"sv) && isStretched(bigIn(data, 8, 2), bigIn(data, 10, 2)))
      remark(all, kPixelsNotSquare);
    if (marker != 0xE2 || !data.starts_with("ICC_PROFILE\0"sv)) return;
    hasProfile = true;
    profile += data.substr(std::min(kProfile, data.size()));
  });
  if (hasProfile) remark(all, profileRemark(profile));
  return all;
}

std::string bmpRemark(std::string_view bmp) {
  constexpr std::size_t kHead = 14;
  constexpr std::uint32_t kCalibrated = 0, kLinked = 0x4C494E4B, kEmbedded = 0x4D424544;
  const std::uint32_t size = littleIn(bmp, kHead);
  std::string all;
  if (size >= 40 && isStretched(littleIn(bmp, kHead + 24), littleIn(bmp, kHead + 28)))
    remark(all, kPixelsNotSquare);
  if (size < 108) return all;
  const std::uint32_t space = littleIn(bmp, kHead + 56);
  const std::string_view own = bmp.substr(std::min(kHead + 60, bmp.size()), 48);  // primaries and gammas
  const bool hasOwn = std::any_of(own.begin(), own.end(), [](char byte) { return byte != 0; });
  if (space == kCalibrated && hasOwn) remark(all, "its primaries and gamma are not taken into account");
  if (space == kLinked || space == kEmbedded) {
    const std::size_t at = littleIn(bmp, kHead + 112), length = littleIn(bmp, kHead + 116);
    remark(all, profileRemark(bmp.substr(std::min(kHead + at, bmp.size()), length)));
  }
  return all;
}

TgaAlpha tgaAlpha(std::string_view tga) {
  constexpr std::size_t kAttributes = 494;
  const std::string_view extension = tgaExtension(tga);
  if (extension.empty()) return TgaAlpha::unsaid;
  const std::uint32_t kind = byteIn(extension, kAttributes);
  return kind == 4 ? TgaAlpha::premultiplied : kind == 3 ? TgaAlpha::separate : TgaAlpha::none;
}

std::string tgaRemark(std::string_view tga) {
  constexpr std::size_t kDepth = 16, kDescriptor = 17, kAspect = 474, kGamma = 478, kCorrection = 482;
  std::string all;
  const std::string_view extension = tgaExtension(tga);
  const auto ratio = [&](std::size_t at) {
    const double below = littleIn(extension, at + 2, 2);
    return extension.empty() || below == 0 ? 1 : littleIn(extension, at, 2) / below;
  };
  if (byteIn(tga, kDepth) == 16 && (byteIn(tga, kDescriptor) & 15) != 0)
    remark(all, "the transparency of its 16-bit pixels is not shown");
  if (ratio(kAspect) != 1 && ratio(kAspect) != 0) remark(all, kPixelsNotSquare);
  if (ratio(kGamma) != 1 && ratio(kGamma) != 0) remark(all, "its gamma is not taken into account");
  if (littleIn(extension, kCorrection) != 0)
    remark(all, "its table of corrected colours is not taken into account");
  return all;
}

}  // namespace trace
