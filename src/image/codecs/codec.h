// Picture files: one table of formats, and reading and writing through it.
//
// The last station of a picture: Picture → encode → words put in → file under a temporary name → rename.
// Colours are stored linear as they are, without gamma, as the courses' programs do. The kind of a file
// that is written follows from its name; of one that is read, from its content.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "image/codecs/metadata.h"
#include "image/development/development.h"
#include "image/picture.h"
#include "image/raster.h"

namespace trace {

/// How colours become the bytes of a file.
struct Encoding {
  static constexpr int kJpegQuality = 95;  ///< from 91 on the colours of every pixel are kept

  Rounding rounding;          ///< rounding of 8-bit formats
  int jpegQuality;            ///< 1 to 100
  Development development{};  ///< what happens first to the colours, in those formats
  Encoding(Rounding r = Rounding::truncate, int quality = kJpegQuality) : rounding(r), jpegQuality(quality) {}
};

/// The limits of reading. Checked in a file's header, before memory is allocated for its pixels.
struct PictureLimits {
  std::uint64_t memory = std::uint64_t{4} << 30;  ///< bytes, for the picture and what its decoder needs
};

/// A row of the table. A new format is one more row in codec.cpp.
struct PictureFormat {
  std::string_view name;
  std::span<const std::string_view> suffixes;  ///< lower case with the dot, the usual one first
  std::string_view help;                       ///< one sentence, no full stop
  bool keepsBright;                            ///< holds values above 1
  bool lossless;                               ///< what it can hold is read back exactly
  int mostSide;                                ///< the largest width and height
  std::size_t mostPixels;

  /// The file, of a picture that passed checkEncodable(). Null for a format that is only read.
  std::string (*encode)(const Picture&, const Encoding&, const Metadata&);
  /// Whether the bytes begin like a file of this format.
  bool (*recognise)(std::string_view bytes);
  /// Throws a std::exception whose what() is the reason why the bytes are no sound file, Error(Fault::limit)
  /// if the picture is larger than the limits.
  Raster (*decode)(std::string_view bytes, const PictureLimits&);
  /// The words stored with the picture; may throw as decode does.
  Metadata (*metadata)(std::string_view bytes);
  /// Remarks on a file that can be decoded: flaws, or parts that are not shown; "" if there is nothing to
  /// say.
  std::string (*remark)(std::string_view bytes);
  /// Decodes a layer, by its name; null for formats without layers.
  Raster (*decodeLayer)(std::string_view bytes, const PictureLimits&, const std::string& layer) = nullptr;
  std::string (*layerRemark)(std::string_view bytes, const std::string& layer) = nullptr;
};

std::span<const PictureFormat> pictureFormats();

/// By the suffix of the path, in any case; null if no format has it. The name may choose a layer
/// (image/codecs/picture_name.h).
const PictureFormat* pictureFormatNamed(std::string_view path);

/// The format in which a file of that name is written. Throws Error(Fault::usage) that names all suffixes of
/// formats that are written.
const PictureFormat& pictureFormatFor(std::string_view path);

/// Throws Error(Fault::usage) if the format is only read, or cannot hold a picture of this size: to be asked
/// before rendering.
void checkEncodable(const PictureFormat& format, int width, int height);

/// The bytes of the file. Throws as checkEncodable(), or Error(Fault::io).
std::string encodePicture(const PictureFormat& format, const Picture& picture, const Encoding& encoding = {},
                          const Metadata& metadata = {});

/// The bytes of a PNG file of the raster, with its transparency. Precondition: its samples are bytes. Throws
/// Error(Fault::limit) for one that is too large.
std::string encodePng(const Raster& raster);

/// Encodes by the suffix and writes; the file appears whole or not at all. Throws Error.
void writePicture(const std::string& path, const Picture& picture, const Encoding& encoding = {},
                  const Metadata& metadata = {});

/// The row that the bytes of a picture file belong to. Throws as decodePicture().
const PictureFormat& pictureFormatOf(std::string_view bytes, const std::string& name);

/// The picture in the bytes; transparency is dropped. `name` is for messages, and may choose a layer
/// (image/codecs/picture_name.h). Throws Error(Fault::io) on anything that is not a whole, sound file of a
/// known format, or has no such layer, Error(Fault::limit) for a picture larger than the limits, and when
/// memory is short.
Picture decodePicture(std::string_view bytes, const std::string& name, const PictureLimits& limits = {});

/// Decodes the picture as the file has it, with transparency. Throws as decodePicture().
Raster decodeRaster(std::string_view bytes, const std::string& name, const PictureLimits& limits = {});

/// A warning about a picture that decodeRaster() has read, such as of layers that are not shown; "" for none.
std::string pictureRemark(std::string_view bytes, const std::string& name);

/// decodePicture() of a file, whose name may choose a layer. Throws Error.
Picture readPicture(const std::string& path, const PictureLimits& limits = {});

/// The words stored with a picture file, in their order; empty where its format has none. Throws Error.
Metadata readMetadata(const std::string& path);

}  // namespace trace
