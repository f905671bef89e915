// Words stored with a picture: how it was made, so that it can be made again.
//
// Works on encoded bytes, after stb (which cannot write any of this) and before the file is written.
// PNG: tEXt chunks, or iTXt where the text is not Latin-1 (PNG specification, sections 11.3.4.3 and
// 11.3.4.5). JPEG: COM segments (ITU T.81, B.2.4.5). Radiance HDR and PPM: comment lines of the header.
// EXR keeps them as attributes (codec_exr.cpp); BMP and TGA have no room.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace trace {

/// (key, text) in the order written; UTF-8. Keys are meant to be short ASCII words: what a format cannot
/// hold is replaced, never refused, for a finished render must not be lost over a word.
using Metadata = std::vector<std::pair<std::string, std::string>>;

/// The key as every format can hold it: 1 to 79 printable ASCII characters, outer spaces trimmed.
std::string cleanKey(std::string_view key);

/// The PNG file with text chunks after its IHDR chunk.
std::string withPngText(std::string png, const Metadata& metadata);
/// The uncompressed text chunks of a PNG file; of a damaged one, those before the damage.
Metadata pngText(std::string_view png);
/// Throws std::runtime_error with the reason unless all chunks are whole and their checksums right.
void checkPngChunks(std::string_view png);

/// The JPEG file with lines `key: text` in comment segments after its APP0 segment.
std::string withJpegComments(std::string jpeg, const Metadata& metadata);
Metadata jpegComments(std::string_view jpeg);

/// The file with lines `# key: text` after its first line, as HDR and PPM take them. Line breaks in the
/// text become spaces.
std::string withCommentLines(std::string file, const Metadata& metadata);
Metadata commentLines(std::string_view file);

}  // namespace trace
