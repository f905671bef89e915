// Parts of the table of codec.cpp, and the limits they keep. Only the codec files include it.
//
// Encoders take a picture that passed checkEncodable(). Decoders throw a std::exception whose what() is the
// reason; codec.cpp makes an Error of it that names the file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "image/codecs/metadata.h"
#include "image/codecs/orientation.h"
#include "image/development/tone.h"
#include "image/picture.h"
#include "image/raster.h"

namespace trace {

/// stb keeps sizes in int and doubles its buffers: 2^29 bytes of levels are the most that is safe.
inline constexpr std::size_t kMostStbPixels = (std::size_t{1} << 29) / 3;

struct Encoding;
struct PictureLimits;

/// How many pixels a byte of a file can stand for. Deflate packs a thousandfold; a picture of one colour
/// comes near that, as PNG and as JPEG.
inline constexpr double kPackedPixelsPerByte = 1100;

[[noreturn]] inline void failAtEnd() { throw std::runtime_error("the file ends too early"); }

/// To be asked before anybody takes memory for the pixels. Throws std::runtime_error for a size that no sound
/// file of so many bytes can have, Error(Fault::limit) for one beyond the limits.
void checkClaimedSize(std::int64_t width, std::int64_t height, std::size_t fileBytes, double pixelsPerByte,
                      const PictureLimits& limits);

std::string encodePngRows(const Bytes& bytes);
/// The samples of the raster must be bytes.
std::string encodePngRows(const Raster& raster);
/// One part of a PNG file, with its length and checksum.
std::string pngChunk(const std::string& type, const std::string& data);
/// The parts of a PNG file that are whole.
void forEachPngChunk(std::string_view png,
                     const std::function<void(std::string_view type, std::string_view data)>& visit);
/// The segments before the picture itself.
void forEachJpegSegment(std::string_view jpeg,
                        const std::function<void(std::uint32_t marker, std::string_view data)>& visit);
std::string encodeBmpByStb(const Bytes& bytes);
std::string encodeTgaByStb(const Bytes& bytes);
/// Quality 1 to 100.
std::string encodeJpegByStb(const Bytes& bytes, int quality);
/// PNG, TGA or JPEG.
Raster decodeByStb(std::string_view bytes, const PictureLimits& limits);
/// As EXIF's orientation says. A JPEG may lack its end marker.
Raster decodeJpeg(std::string_view bytes, const PictureLimits& limits);
std::string jpegRemark(std::string_view bytes);
/// Names the properties in the segments before the picture that are not shown.
std::string jpegHeadRemark(std::string_view jpeg);
/// The orientation that an EXIF block says, which begins with II or MM.
Orientation orientationOfExif(std::string_view exif);
Orientation pngOrientation(std::string_view png);
/// The meaning of the fourth channel of a TGA file.
enum class TgaAlpha { unsaid, none, separate, premultiplied };
TgaAlpha tgaAlpha(std::string_view tga);
Raster decodeTga(std::string_view bytes, const PictureLimits& limits);
std::string tgaRemark(std::string_view bytes);
Raster decodeBmp(std::string_view bytes, const PictureLimits& limits);

std::string bmpRemark(std::string_view bytes);
std::string pngRemark(std::string_view bytes);
std::string encodePpm(const Picture& picture, const Encoding& how, const Metadata& metadata);

/// Puts the parts of a remark together.
inline void remark(std::string& all, std::string_view part) {
  all += (all.empty() || part.empty() ? "" : "; ") + std::string(part);
}
/// The remark about a colour profile; "" for sRGB, which is expected.
std::string profileRemark(std::string_view profile);

/// P1 to P7.
Raster decodePpm(std::string_view bytes, const PictureLimits& limits);
std::string ppmRemark(std::string_view bytes);
std::string encodePfm(const Picture& picture, const Encoding&, const Metadata&);
Raster decodePfm(std::string_view bytes, const PictureLimits& limits);
std::string pfmRemark(std::string_view bytes);
std::string encodeHdr(const Picture& picture, const Encoding&, const Metadata& metadata);
Raster decodeHdr(std::string_view bytes, const PictureLimits& limits);
std::string hdrRemark(std::string_view bytes);

std::string encodeExr(const Picture& picture, const Encoding&, const Metadata& metadata);
Raster decodeExr(std::string_view bytes, const PictureLimits& limits);
Raster decodeExrLayer(std::string_view bytes, const PictureLimits& limits, const std::string& layer);
std::string exrRemark(std::string_view bytes);
std::string exrLayerRemark(std::string_view bytes, const std::string& layer);
Metadata exrMetadata(std::string_view bytes);

bool isWebp(std::string_view bytes);
Raster decodeWebp(std::string_view bytes, const PictureLimits& limits);
std::string webpRemark(std::string_view bytes);

}  // namespace trace
