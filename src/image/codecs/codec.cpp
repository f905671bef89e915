// The table of picture formats, and reading and writing through it: see codec.h.
//
// The last station of a picture. The rows' parts are in codec_netpbm.cpp, codec_hdr.cpp, codec_stb.cpp,
// codec_exr.cpp, codec_webp.cpp and metadata.cpp. Source: each format's signature, from its specification;
// Truevision's TGA 2.0 has none, so TGA is tried last and only on a header that makes sense.
#include "image/codecs/codec.h"

#include <algorithm>
#include <climits>
#include <cmath>
#include <limits>
#include <new>
#include <stdexcept>
#include <vector>

#include "base/error.h"
#include "base/files/file.h"
#include "base/match.h"
#include "base/text.h"
#include "image/codecs/codec_parts.h"
#include "image/codecs/picture_name.h"

namespace trace {

void checkClaimedSize(std::int64_t width, std::int64_t height, std::size_t fileBytes, double pixelsPerByte,
                      const PictureLimits& limits) {
  constexpr double kHarmless = 1 << 22;  // so many pixels may any header claim
  constexpr double kDecoding = 16;       // bytes a pixel that decoders keep, at most
  const std::string size = std::to_string(width) + "x" + std::to_string(height) + " pixels";
  const double pixels = static_cast<double>(width) * static_cast<double>(height);
  const bool believable = pixels <= std::max(kHarmless, pixelsPerByte * static_cast<double>(fileBytes));
  if (width < 1 || height < 1 || !believable)
    throw std::runtime_error("a size of " + size + " is not believable in " + std::to_string(fileBytes) +
                             " bytes");
  constexpr double kMiB = 1 << 20;
  const double needed = pixels * (sizeof(Color) + kDecoding);
  if (needed > static_cast<double>(limits.memory))
    throw Error(Fault::limit, "a picture of " + size + " needs " + toText(std::ceil(needed / kMiB)) +
                                  " MiB of memory to be read; allowed are " +
                                  toText(std::floor(static_cast<double>(limits.memory) / kMiB)));
}

namespace {

// --- how files begin ---------------------------------------------------------------------------------

bool beginsWith(std::string_view bytes, std::string_view start) {
  return bytes.substr(0, start.size()) == start;
}

bool isPng(std::string_view b) { return beginsWith(b, "\x89PNG\r\n\x1a\n"); }
bool isBmp(std::string_view b) { return beginsWith(b, "BM"); }
/// P and a letter of the list, and white space or a comment.
bool isNetpbm(std::string_view b, std::string_view kinds) {
  return b.size() > 2 && b[0] == 'P' && kinds.find(b[1]) != std::string_view::npos &&
         (b[2] == '#' || b[2] == ' ' || (b[2] >= '\t' && b[2] <= '\r'));
}
bool isPpm(std::string_view b) { return isNetpbm(b, "123456") || beginsWith(b, "P7\n"); }
bool isPfm(std::string_view b) { return isNetpbm(b, "Ff"); }
bool isJpeg(std::string_view b) { return beginsWith(b, "\xFF\xD8\xFF"); }
bool isHdr(std::string_view b) { return beginsWith(b, "#?"); }
bool isExr(std::string_view b) { return beginsWith(b, "\x76\x2f\x31\x01"); }
bool isTga(std::string_view b) {
  if (b.size() < 18) return false;
  const auto is = [&](size_t i, std::string_view allowed) {
    return allowed.find(b[i]) != std::string_view::npos;
  };
  const bool sized = (b[12] || b[13]) && (b[14] || b[15]);
  return is(1, {"\0\1", 2}) && is(2, "\1\2\3\x9\xa\xb") && is(16, "\x8\xf\x10\x18\x20") && sized;
}

// --- the rows ----------------------------------------------------------------------------------------

Bytes levels(const Picture& picture, const Encoding& how) {
  return developedBytes(picture, how.development, how.rounding);
}

std::string encodePng(const Picture& picture, const Encoding& how, const Metadata& metadata) {
  return withPngText(encodePngRows(levels(picture, how)), metadata);
}
std::string encodeBmp(const Picture& picture, const Encoding& how, const Metadata&) {
  return encodeBmpByStb(levels(picture, how));
}
std::string encodeTga(const Picture& picture, const Encoding& how, const Metadata&) {
  return encodeTgaByStb(levels(picture, how));
}
std::string encodeJpeg(const Picture& picture, const Encoding& how, const Metadata& metadata) {
  return withJpegComments(encodeJpegByStb(levels(picture, how), how.jpegQuality), metadata);
}
Raster decodePng(std::string_view bytes, const PictureLimits& limits) {
  checkPngChunks(bytes);
  // stb takes a PNG that is too large for one of another type.
  constexpr std::size_t kWidth = 16, kHeight = 20;
  const auto number = [&](std::size_t at) {
    std::int64_t value = 0;
    for (char c : bytes.substr(at, 4)) value = value << 8 | static_cast<unsigned char>(c);
    return value;
  };
  if (bytes.size() >= kHeight + 4)
    checkClaimedSize(number(kWidth), number(kHeight), bytes.size(), kPackedPixelsPerByte, limits);
  return oriented(decodeByStb(bytes, limits), pngOrientation(bytes));
}
Metadata noMetadata(std::string_view) { return {}; }

constexpr std::string_view kPng[] = {".png"}, kBmp[] = {".bmp"}, kPpm[] = {".ppm", ".pnm"}, kPfm[] = {".pfm"},
                           kJpeg[] = {".jpg", ".jpeg"}, kHdr[] = {".hdr"}, kExr[] = {".exr"},
                           kWebp[] = {".webp"}, kTga[] = {".tga"};
/// As many as memory can address.
constexpr std::size_t kAnyNumber = std::numeric_limits<std::size_t>::max() / sizeof(Color);

constexpr int kMostWebpSide = 16383;

// Reading tries them in this order.
constexpr PictureFormat kFormats[] = {
    {"PNG", kPng, "8 bits a channel, compressed without loss; carries the render's settings", false, true,
     INT_MAX, kMostStbPixels, encodePng, isPng, decodePng, pngText, pngRemark},
    {"BMP", kBmp, "8 bits a channel, uncompressed; for hand-ins in the courses", false, true, INT_MAX,
     kMostStbPixels, encodeBmp, isBmp, decodeBmp, noMetadata, bmpRemark},
    {"PPM", kPpm, "8 bits a channel, uncompressed; the simplest there is", false, true, INT_MAX, kAnyNumber,
     encodePpm, isPpm, decodePpm, commentLines, ppmRemark},
    {"JPEG", kJpeg, "8 bits a channel, small, with visible loss", false, false, 65535, kMostStbPixels,
     encodeJpeg, isJpeg, decodeJpeg, jpegComments, jpegRemark},
    {"HDR", kHdr, "Radiance RGBE, keeps values above 1 to one part in 256 of the brightest channel", true,
     false, INT_MAX, kMostStbPixels, encodeHdr, isHdr, decodeHdr, commentLines, hdrRemark},
    {"EXR", kExr, "32-bit floats, keeps every value; carries the render's settings", true, true, 1 << 24,
     kAnyNumber, encodeExr, isExr, decodeExr, exrMetadata, exrRemark, decodeExrLayer, exrLayerRemark},
    {"PFM", kPfm, "32-bit floats, uncompressed; keeps every value, and programs of a few lines read it", true,
     true, INT_MAX, kAnyNumber, encodePfm, isPfm, decodePfm, noMetadata, pfmRemark},
    {"WebP", kWebp, "8 bits a channel, with or without loss; read, not written", false, true, kMostWebpSide,
     kAnyNumber, nullptr, isWebp, decodeWebp, noMetadata, webpRemark},
    {"TGA", kTga, "8 bits a channel, run-length coded", false, true, 65535, kMostStbPixels, encodeTga, isTga,
     decodeTga, noMetadata, tgaRemark},
};

std::string lowerCase(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

/// In lower case, with the dot; "" if the name has none.
std::string suffixOf(std::string_view path) {
  const size_t dot = path.rfind('.'), slash = path.find_last_of("/\\");
  const bool hasSuffix = dot != std::string_view::npos && (slash == std::string_view::npos || dot > slash);
  return hasSuffix ? lowerCase(path.substr(dot)) : "";
}

/// `PNG, BMP, ... or TGA` and the like.
std::string listed(const std::vector<std::string_view>& words) {
  std::string text;
  for (size_t i = 0; i < words.size(); ++i)
    text += (i == 0 ? "" : i + 1 == words.size() ? " or " : ", ") + std::string(words[i]);
  return text;
}

/// The kind of the bytes, if it is a known one that is not read; "" otherwise.
std::string_view foreignKind(std::string_view bytes) {
  struct Kind {
    std::size_t at;  ///< where its mark stands
    std::string_view mark, name;
  };
  using namespace std::string_view_literals;
  static constexpr Kind kKinds[] = {{0, "\xABKTX 20\xBB"sv, "a KTX2 texture"},
                                    {0, "\xABKTX 11\xBB"sv, "a KTX texture"},
                                    {0, "DDS "sv, "a DDS texture"},
                                    {4, "ftypavif"sv, "an AVIF picture"},
                                    {4, "ftyphei"sv, "a HEIF picture"},
                                    {0, "GIF8"sv, "a GIF picture"},
                                    {0, "II*\0"sv, "a TIFF picture"},
                                    {0, "MM\0*"sv, "a TIFF picture"},
                                    {0, "8BPS"sv, "a Photoshop document"},
                                    {0, "<svg"sv, "an SVG drawing"},
                                    {0, "\xFF\x0A"sv, "a JPEG XL picture"},
                                    {0, "\0\0\0\xCJXL "sv, "a JPEG XL picture"},
                                    {0, "\0\0\0\xCjP  "sv, "a JPEG 2000 picture"}};
  for (const Kind& kind : kKinds)
    if (bytes.size() >= kind.at && bytes.substr(kind.at).starts_with(kind.mark)) return kind.name;
  return {};
}

Raster decodedBy(const PictureFormat& format, std::string_view bytes, const std::string& name,
                 const PictureLimits& limits) {
  const std::string layer = pictureName(name).layer;
  if (layer.empty()) return format.decode(bytes, limits);
  if (!format.decodeLayer) throw std::runtime_error("only EXR files have layers");
  return format.decodeLayer(bytes, limits, layer);
}

/// The name of the format, or of its kind among those of Netpbm, for errors.
std::string kindName(const PictureFormat& format, std::string_view bytes) {
  const char kind = format.recognise == isPpm ? bytes[1] : '\0';
  return kind == '1' || kind == '4'   ? "PBM"
         : kind == '2' || kind == '5' ? "PGM"
         : kind == '7'                ? "PAM"
                                      : std::string(format.name);
}

/// Calls use(format) with the row the bytes belong to; any failure becomes an Error that names the file.
template <class Use>
decltype(auto) withFormatOf(std::string_view bytes, const std::string& name, Use use) {
  std::vector<std::string_view> names;
  for (const PictureFormat& format : kFormats) {
    names.push_back(format.name);
    if (!format.recognise(bytes)) continue;
    try {
      return use(format);
    } catch (const std::bad_alloc&) {
      throw Error(Fault::limit, "cannot read \"" + name + "\": not enough memory for this picture");
    } catch (const Error& e) {
      throw Error(e.fault(), "cannot read \"" + name + "\": " + e.messages().front().what);
    } catch (const std::exception& e) {
      throw Error(Fault::io, "cannot read \"" + name + "\" as " + kindName(format, bytes) + ": " + e.what());
    }
  }
  const std::string_view foreign = foreignKind(bytes);
  throw Error(Fault::io, "cannot read \"" + name + "\": a picture (" + listed(names) + ") was expected, " +
                             (bytes.empty()      ? "the file is empty"
                              : !foreign.empty() ? "found " + std::string(foreign) + ", which is not read"
                                                 : "it begins like none of them"));
}

}  // namespace

std::span<const PictureFormat> pictureFormats() { return kFormats; }

const PictureFormat* pictureFormatNamed(std::string_view path) {
  const std::string suffix = suffixOf(pictureName(std::string(path)).file);
  for (const PictureFormat& format : kFormats)
    for (std::string_view candidate : format.suffixes)
      if (candidate == suffix) return &format;
  return nullptr;
}

const PictureFormat& pictureFormatFor(std::string_view path) {
  const std::string layer = pictureName(std::string(path)).layer;
  const PictureFormat* named = pictureFormatNamed(path);
  if (named && named->encode && layer.empty()) return *named;
  std::vector<std::string_view> written;
  for (const PictureFormat& format : kFormats)
    if (format.encode) written.insert(written.end(), format.suffixes.begin(), format.suffixes.end());
  throw Error(Fault::usage,
              "the name of a picture ends in " + listed(written) + ", found \"" + std::string(path) + "\"",
              !layer.empty() ? "layers are read, not written"
              : named        ? std::string(named->name) + " pictures are read, not written"
                             : didYouMean(suffixOf(path), written));
}

void checkEncodable(const PictureFormat& format, int width, int height) {
  if (!format.encode) throw Error(Fault::usage, std::string(format.name) + " pictures are read, not written");
  const bool fits = width >= 1 && height >= 1 && width <= format.mostSide && height <= format.mostSide &&
                    static_cast<std::size_t>(width) <= format.mostPixels / static_cast<std::size_t>(height);
  if (fits) return;
  throw Error(Fault::usage,
              "a picture of " + std::to_string(width) + "x" + std::to_string(height) +
                  " pixels does not fit into " + std::string(format.name) + ": sides of 1 to " +
                  std::to_string(format.mostSide) + " and at most " + std::to_string(format.mostPixels) +
                  " pixels were expected",
              width >= 1 && height >= 1 ? ".exr and .ppm hold the largest pictures" : "");
}

std::string encodePicture(const PictureFormat& format, const Picture& picture, const Encoding& encoding,
                          const Metadata& metadata) {
  checkEncodable(format, picture.width, picture.height);
  try {
    return format.encode(picture, encoding, metadata);
  } catch (const std::bad_alloc&) {
    throw Error(Fault::limit, "not enough memory to write this picture as " + std::string(format.name));
  } catch (const Error&) {  // the time is over
    throw;
  } catch (const std::exception& e) {
    throw Error(Fault::io, "cannot write a picture as " + std::string(format.name) + ": " + e.what());
  }
}

std::string encodePng(const Raster& raster) {
  if (raster.count() > 3 * kMostStbPixels)
    throw Error(Fault::limit, "a picture of " + std::to_string(raster.width) + "x" +
                                  std::to_string(raster.height) + " pixels does not fit into PNG");
  return encodePngRows(raster);
}

void writePicture(const std::string& path, const Picture& picture, const Encoding& encoding,
                  const Metadata& metadata) {
  writeFile(path, encodePicture(pictureFormatFor(path), picture, encoding, metadata));
}

const PictureFormat& pictureFormatOf(std::string_view bytes, const std::string& name) {
  return withFormatOf(bytes, name,
                      [](const PictureFormat& format) -> const PictureFormat& { return format; });
}

Picture decodePicture(std::string_view bytes, const std::string& name, const PictureLimits& limits) {
  return withFormatOf(bytes, name, [&](const PictureFormat& format) {
    return toPicture(decodedBy(format, bytes, name, limits));
  });
}

Raster decodeRaster(std::string_view bytes, const std::string& name, const PictureLimits& limits) {
  return withFormatOf(bytes, name,
                      [&](const PictureFormat& format) { return decodedBy(format, bytes, name, limits); });
}

std::string pictureRemark(std::string_view bytes, const std::string& name) {
  const std::string layer = pictureName(name).layer;
  return withFormatOf(bytes, name, [&](const PictureFormat& format) {
    return layer.empty() || !format.layerRemark ? format.remark(bytes) : format.layerRemark(bytes, layer);
  });
}

Picture toPicture(const Raster& raster) {
  Picture picture(raster.width, raster.height);
  const auto stride = static_cast<std::size_t>(raster.channels);
  const std::size_t g = raster.channels > 2 ? 1 : 0, b = 2 * g;
  match(raster.samples, [&](const auto& samples) {
    const auto* sample = samples.data();
    for (Color& c : picture.pixels) {
      c = Color(double(sample[0]), double(sample[g]), double(sample[b])) / raster.most;
      sample += stride;
    }
  });
  return picture;
}

Picture readPicture(const std::string& path, const PictureLimits& limits) {
  return decodePicture(readFile(pictureName(path).file), path, limits);
}

Metadata readMetadata(const std::string& path) {
  const std::string bytes = readFile(path);
  return withFormatOf(bytes, path, [&](const PictureFormat& format) { return format.metadata(bytes); });
}

}  // namespace trace
