// PNG, TGA and JPEG, and BMP to be written, through stb_image and stb_image_write, the only file that sees
// them. PNG files are written elsewhere (codec_png.cpp). One station of codec.cpp's table. Source: Sean
// Barrett's public-domain headers, stb_image 2.27 and stb_image_write 1.16. stb reads zeros behind the end of
// a file and calls the result a picture; the source below notices, so that a truncated file is refused.
#include <algorithm>
#include <climits>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <stdexcept>
#include <utility>
#include <variant>
#include <vector>

#include "base/budget.h"
#include "image/codecs/codec.h"
#include "image/codecs/codec_parts.h"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO
#define STBI_ONLY_PNG
#define STBI_ONLY_TGA
#define STBI_ONLY_JPEG
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpragmas"
#pragma GCC diagnostic ignored "-Wunknown-warning-option"
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wsign-compare"
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"
#endif
#include <stb/stb_image.h>
#include <stb/stb_image_write.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace trace {
namespace {

void append(void* file, void* bytes, int count) {
  checkBudget();
  static_cast<std::string*>(file)->append(static_cast<const char*>(bytes), static_cast<size_t>(count));
}

/// The file that `write(append, &file)`, one of stb's writers, makes.
template <class Write>
std::string written(Write write) {
  std::string file;
  if (!write(append, &file)) throw std::runtime_error("the encoder failed");
  return file;
}

/// A file in memory that stb draws from, and whether it wanted more than there is. stb either refills its
/// own small buffer (the target of its first call), where it takes what it gets, or reads straight into
/// the picture, where every byte counts.
struct Source {
  std::string_view rest;
  const char* ownBuffer = nullptr;
  bool ranDry = false;

  static int read(void* user, char* target, int wanted) {
    auto& source = *static_cast<Source*>(user);
    if (!source.ownBuffer) source.ownBuffer = target;
    const size_t count = std::min(source.rest.size(), static_cast<size_t>(std::max(wanted, 0)));
    if (count > 0) std::memcpy(target, source.rest.data(), count);
    source.rest.remove_prefix(count);
    if (count == 0 || (target != source.ownBuffer && count < static_cast<size_t>(wanted)))
      source.ranDry = true;
    return static_cast<int>(count);
  }
  static void skip(void* user, int count) {
    auto& source = *static_cast<Source*>(user);
    const size_t wanted = static_cast<size_t>(std::max(count, 0));
    if (wanted > source.rest.size()) source.ranDry = true;
    source.rest.remove_prefix(std::min(wanted, source.rest.size()));
  }
  static int atEnd(void* user) { return static_cast<Source*>(user)->rest.empty(); }
};

[[noreturn]] void failAsStbSays() {
  const char* reason = stbi_failure_reason();
  if (reason && std::strcmp(reason, "outofmem") == 0) throw std::bad_alloc();
  throw std::runtime_error(reason ? reason : "damaged");
}

/// Throws if a Huffman table in the JPEG segment from `i` to `end` has more than 256 codes. As stb does it,
/// the last table may reach beyond the end.
void checkHuffmanTables(std::string_view jpeg, size_t i, size_t end) {
  constexpr size_t kWhich = 1, kCounts = 16;  // which table it is, and the number of codes of each length
  while (i + kWhich < std::min(end + kWhich, jpeg.size())) {
    size_t codes = 0;
    for (char count : jpeg.substr(i + kWhich, kCounts)) codes += static_cast<unsigned char>(count);
    if (codes > 256) throw std::runtime_error("a Huffman table is damaged");
    i += kWhich + kCounts + codes;
  }
}

/// stb 2.27 writes behind its array for a JPEG table of too many codes. Segments are walked up to the first
/// scan as stb walks them; behind it, every place is looked at where a damaged scan may let stb find a table.
void checkJpegTables(std::string_view jpeg) {
  const auto at = [&](size_t i) { return i < jpeg.size() ? static_cast<unsigned char>(jpeg[i]) : 0u; };
  bool walking = true;
  for (size_t i = 2; i < jpeg.size();) {
    if (at(i) != 0xFF || at(i + 1) == 0xFF) {  // not yet the last byte before a marker
      ++i;
      continue;
    }
    const unsigned marker = at(i + 1);
    const size_t segment = i + 2, end = segment + (at(segment) << 8 | at(segment + 1));
    if (marker == 0xC4) checkHuffmanTables(jpeg, segment + 2, end);
    if (marker == 0xDA) walking = false;
    const bool hasLength = marker != 0 && marker != 1 && !(marker >= 0xD0 && marker <= 0xD9);
    i = walking && hasLength ? std::max(end, segment) : segment;
  }
}

/// TGA holds runs of 128 pixels.
double mostPixelsPerByte(std::string_view bytes) {
  const bool packs = bytes.substr(0, 4) == "\x89PNG" || bytes.substr(0, 2) == "\xFF\xD8";
  return packs ? kPackedPixelsPerByte : 128;
}

/// Runs one of stb's loaders (8 or 16 bit); `most` stands for 1.
template <class Value>
Raster decodeAs(std::string_view bytes, double most,
                Value* (*load)(const stbi_io_callbacks*, void*, int*, int*, int*, int)) {
  const stbi_io_callbacks callbacks{Source::read, Source::skip, Source::atEnd};
  Source source{bytes};
  int width = 0, height = 0, channels = 0;
  const std::unique_ptr<Value, void (*)(void*)> values(
      load(&callbacks, &source, &width, &height, &channels, 0), stbi_image_free);
  if (source.ranDry) throw std::runtime_error("the file ends too early");
  if (!values) failAsStbSays();
  Raster raster(width, height, channels, most);
  raster.samples = std::vector<Value>(values.get(), values.get() + raster.count());
  return raster;
}

/// A TGA file of 32 bits a pixel whose header says that none of them are transparency.
bool fourthIsUnused(std::string_view bytes) {
  constexpr std::size_t kDescriptor = 17;
  constexpr int kAlphaBits = 15;
  const bool isTga = bytes.size() > kDescriptor && bytes[0] != '\x89' && bytes[0] != '\xFF';
  return isTga && (bytes[kDescriptor] & kAlphaBits) == 0;
}

/// The orientation that the EXIF part of a JPEG says; upright if it says none.
Orientation exifOrientation(std::string_view jpeg) {
  using namespace std::string_view_literals;
  Orientation found = Orientation::upright;
  forEachJpegSegment(jpeg, [&](std::uint32_t marker, std::string_view data) {
    constexpr std::size_t kName = 6;
    if (marker == 0xE1 && data.starts_with("Exif\0\0"sv) && found == Orientation::upright)
      found = orientationOfExif(data.substr(kName));
  });
  return found;
}

/// Whether a JPEG ends in its marker, perhaps with zeros or other padding behind that.
bool endsInMarker(std::string_view jpeg) {
  constexpr std::size_t kPadding = 4096;
  return jpeg.substr(jpeg.size() - std::min(jpeg.size(), kPadding)).rfind("\xFF\xD9") != jpeg.npos;
}

/// Colours that are multiplied by the alpha behind them, as they are without.
void divideByAlpha(Raster& raster) {
  auto& samples = std::get<std::vector<stbi_uc>>(raster.samples);
  const auto stride = static_cast<size_t>(raster.channels);
  for (size_t i = 0; i + stride <= samples.size(); i += stride) {
    const int alpha = samples[i + stride - 1];
    for (size_t k = 0; alpha > 0 && k + 1 < stride; ++k)
      samples[i + k] = static_cast<stbi_uc>(std::min(255, (samples[i + k] * 255 + alpha / 2) / alpha));
  }
}

/// Without its last channel.
Raster withoutAlpha(const Raster& given) {
  Raster raster(given.width, given.height, given.channels - 1, given.most);
  const auto& from = std::get<std::vector<stbi_uc>>(given.samples);
  std::vector<stbi_uc> samples;
  samples.reserve(raster.count());
  const auto stride = static_cast<size_t>(given.channels);
  for (size_t i = 0; i < from.size(); ++i)
    if (i % stride != stride - 1) samples.push_back(from[i]);
  raster.samples = std::move(samples);
  return raster;
}

/// A picture of 8 bits a channel, with an alpha that is 0 everywhere.
bool isNowhere(const Raster& raster) {
  const auto& samples = std::get<std::vector<stbi_uc>>(raster.samples);
  const auto stride = static_cast<size_t>(raster.channels);
  for (size_t i = stride - 1; i < samples.size(); i += stride)
    if (samples[i] != 0) return false;
  return true;
}

}  // namespace

std::string encodeBmpByStb(const Bytes& b) {
  return written([&](auto to, void* file) {
    return stbi_write_bmp_to_func(to, file, b.width, b.height, 3, b.rgb.data());
  });
}

std::string encodeTgaByStb(const Bytes& b) {
  return written([&](auto to, void* file) {
    return stbi_write_tga_to_func(to, file, b.width, b.height, 3, b.rgb.data());
  });
}

std::string encodeJpegByStb(const Bytes& b, int quality) {
  return written([&](auto to, void* file) {
    return stbi_write_jpg_to_func(to, file, b.width, b.height, 3, b.rgb.data(), quality);
  });
}

Raster decodeJpeg(std::string_view bytes, const PictureLimits& limits) {
  const Orientation orientation = exifOrientation(bytes);
  if (endsInMarker(bytes)) return oriented(decodeByStb(bytes, limits), orientation);
  // Only if what is missing says nothing of the picture, whatever stands in its place makes the same one.
  const std::string marker("\xFF\xD9");
  Raster raster = decodeByStb(std::string(bytes) + marker, limits);
  const Raster other = decodeByStb(std::string(bytes) + std::string(64, '\x55') + marker, limits);
  if (raster.samples != other.samples) failAtEnd();
  return oriented(std::move(raster), orientation);
}

std::string jpegRemark(std::string_view bytes) {
  std::string all = endsInMarker(bytes) ? "" : "the JPEG lacks its end marker";
  remark(all, jpegHeadRemark(bytes));
  return all;
}

Raster decodeTga(std::string_view bytes, const PictureLimits& limits) {
  constexpr std::size_t kFirstColor = 3, kDescriptor = 17;
  constexpr int kFromRight = 16, kInterleaved = 0xC0;
  if (bytes.size() > kDescriptor && (bytes[kDescriptor] & kInterleaved) != 0)
    throw std::runtime_error("interleaved rows are not read");
  if (bytes.size() > kDescriptor && bytes[1] == 1 && (bytes[kFirstColor] != 0 || bytes[kFirstColor + 1] != 0))
    throw std::runtime_error("a table of colours that does not begin at 0 is not read");
  Raster raster = decodeByStb(bytes, limits);
  TgaAlpha alpha = tgaAlpha(bytes);
  if (raster.hasAlpha() && alpha == TgaAlpha::unsaid && isNowhere(raster))
    alpha = TgaAlpha::none;  // left at 0
  if (raster.hasAlpha() && alpha == TgaAlpha::none) raster = withoutAlpha(raster);
  if (raster.hasAlpha() && alpha == TgaAlpha::premultiplied) divideByAlpha(raster);
  const bool mirrored = bytes.size() > kDescriptor && (bytes[kDescriptor] & kFromRight) != 0;
  return oriented(std::move(raster), mirrored ? Orientation::mirrored : Orientation::upright);
}

Raster decodeByStb(std::string_view bytes, const PictureLimits& limits) {
  if (bytes.size() > INT_MAX) throw std::runtime_error("files above 2 GiB are not read");
  if (bytes.substr(0, 2) == "\xFF\xD8") checkJpegTables(bytes);
  const auto* start = reinterpret_cast<const stbi_uc*>(bytes.data());
  const int size = static_cast<int>(bytes.size());
  int width = 0, height = 0, channels = 0;
  if (!stbi_info_from_memory(start, size, &width, &height, &channels)) failAsStbSays();
  checkClaimedSize(width, height, bytes.size(), mostPixelsPerByte(bytes), limits);
  if (stbi_is_16_bit_from_memory(start, size))
    return decodeAs<stbi_us>(bytes, 65535, stbi_load_16_from_callbacks);
  Raster raster = decodeAs<stbi_uc>(bytes, 255, stbi_load_from_callbacks);
  return raster.hasAlpha() && fourthIsUnused(bytes) ? withoutAlpha(raster) : raster;
}

}  // namespace trace
