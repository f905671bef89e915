// What the table of codec.cpp is made of, and the limits its parts keep. Only the codec files include it.
//
// Encoders take a picture that passed checkEncodable(). Decoders throw a std::exception whose what() is the
// reason; codec.cpp makes an Error of it that names the file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "image/metadata.h"
#include "image/picture.h"
#include "image/tone.h"

namespace trace {

/// stb keeps sizes in int and doubles its buffers: 2^29 bytes of levels are the most that is safe.
inline constexpr std::size_t kMostStbPixels = (std::size_t{1} << 29) / 3;

/// The most pixels read from any file.
inline constexpr std::int64_t kMostPixelsRead = std::int64_t{1} << 28;

/// Throws std::runtime_error for sizes that no sound file of so many bytes can have, before anybody
/// allocates memory for them.
void checkClaimedSize(std::int64_t width, std::int64_t height, std::size_t fileBytes);

std::string encodePngByStb(const Bytes& bytes);
std::string encodeBmpByStb(const Bytes& bytes);
std::string encodeTgaByStb(const Bytes& bytes);
std::string encodeJpegByStb(const Bytes& bytes);
/// PNG, BMP, TGA or JPEG.
Picture decodeByStb(std::string_view bytes);

std::string encodePpm(const Picture& picture, Rounding rounding, const Metadata& metadata);
/// P2, P3, P5 or P6.
Picture decodePpm(std::string_view bytes);
std::string encodeHdr(const Picture& picture, Rounding, const Metadata& metadata);
Picture decodeHdr(std::string_view bytes);

std::string encodeExr(const Picture& picture, Rounding, const Metadata& metadata);
Picture decodeExr(std::string_view bytes);
Metadata exrMetadata(std::string_view bytes);

}  // namespace trace
