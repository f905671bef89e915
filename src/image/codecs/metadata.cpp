// Text inside encoded PNG, JPEG, HDR and PPM pictures: see metadata.h. Sits between an encoder and the
// file written. Sources: PNG specification (W3C, third edition) sections 5.3 to 5.5 for chunks, annex D for
// the checksum; ITU T.81 annex B for JPEG segments; Greg Ward's Radiance picture header; netpbm's ppm(5).
#include "image/codecs/metadata.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <stdexcept>

#include "image/codecs/codec_parts.h"

namespace trace {
namespace {

std::uint8_t byteAt(std::string_view bytes, size_t i) { return static_cast<std::uint8_t>(bytes[i]); }

// --- PNG ---------------------------------------------------------------------------------------------

constexpr size_t kPngSignature = 8;

constexpr std::array<std::uint32_t, 256> kCrcTable = [] {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t n = 0; n < 256; ++n) {
    std::uint32_t c = n;
    for (int bit = 0; bit < 8; ++bit) c = c & 1 ? 0xEDB88320u ^ (c >> 1) : c >> 1;
    table[n] = c;
  }
  return table;
}();

std::uint32_t crc32(std::string_view bytes) {
  std::uint32_t c = 0xFFFFFFFFu;
  for (char byte : bytes) c = kCrcTable[(c ^ static_cast<std::uint8_t>(byte)) & 0xFF] ^ (c >> 8);
  return ~c;
}

std::string bigEndian(std::uint32_t n) {
  return {static_cast<char>(n >> 24), static_cast<char>(n >> 16), static_cast<char>(n >> 8),
          static_cast<char>(n)};
}

std::uint32_t bigEndianAt(std::string_view bytes, size_t i) {
  return std::uint32_t{byteAt(bytes, i)} << 24 | std::uint32_t{byteAt(bytes, i + 1)} << 16 |
         std::uint32_t{byteAt(bytes, i + 2)} << 8 | byteAt(bytes, i + 3);
}

struct PngChunk {
  std::string_view type, data;
  bool sound;  ///< the checksum is right
};

/// The chunk at `offset`, which moves behind it; nothing when the file ends before the chunk does.
std::optional<PngChunk> nextPngChunk(std::string_view png, size_t& offset) {
  constexpr size_t kAround = 12;  // length, type and checksum
  if (png.size() < kAround || offset > png.size() - kAround) return {};
  const size_t length = bigEndianAt(png, offset);
  if (length > png.size() - kAround - offset) return {};
  const std::string_view typeAndData = png.substr(offset + 4, 4 + length);
  const bool sound = crc32(typeAndData) == bigEndianAt(png, offset + 8 + length);
  offset += kAround + length;
  return PngChunk{typeAndData.substr(0, 4), typeAndData.substr(4), sound};
}

/// The text in Latin-1, or nothing if it has other letters or is not UTF-8.
std::optional<std::string> latin1(std::string_view utf8) {
  std::string text;
  for (size_t i = 0; i < utf8.size(); ++i) {
    const std::uint8_t lead = byteAt(utf8, i);
    if (lead < 0x80) {
      text += utf8[i];
    } else if ((lead == 0xC2 || lead == 0xC3) && i + 1 < utf8.size() &&
               (byteAt(utf8, i + 1) & 0xC0) == 0x80) {
      text += static_cast<char>((lead & 3) << 6 | (byteAt(utf8, ++i) & 0x3F));
    } else {
      return {};
    }
  }
  return text;
}

std::string utf8FromLatin1(std::string_view text) {
  std::string utf8;
  for (char letter : text) {
    const auto code = static_cast<std::uint8_t>(letter);
    if (code < 0x80) {
      utf8 += letter;
    } else {
      utf8 += static_cast<char>(0xC0 | code >> 6);
      utf8 += static_cast<char>(0x80 | (code & 0x3F));
    }
  }
  return utf8;
}

// --- lines of text, for the other formats -------------------------------------------------------------

/// `key: text` on one line, without its line break.
std::string lineOf(const std::string& key, std::string text) {
  for (char& c : text)
    if (c == '\n' || c == '\r' || c == '\0') c = ' ';
  return cleanKey(key) + ": " + text;
}

/// Adds the line's key and text, if it is of that form.
void addLine(Metadata& metadata, std::string_view line) {
  const size_t colon = line.find(": ");
  if (colon != std::string_view::npos && colon > 0)
    metadata.emplace_back(line.substr(0, colon), line.substr(colon + 2));
}

}  // namespace

std::string cleanKey(std::string_view key) {
  std::string clean(key.substr(0, 79));
  for (char& c : clean)
    if (c < ' ' || c > '~') c = '_';
  while (!clean.empty() && clean.back() == ' ') clean.pop_back();
  clean.erase(0, std::min(clean.find_first_not_of(' '), clean.size()));
  return clean.empty() ? "Comment" : clean;
}

std::string pngChunk(const std::string& type, const std::string& data) {
  const std::string typeAndData = type + data;
  return bigEndian(static_cast<std::uint32_t>(data.size())) + typeAndData + bigEndian(crc32(typeAndData));
}

std::string withPngText(std::string png, const Metadata& metadata) {
  std::string chunks;
  for (const auto& [key, value] : metadata) {
    std::string text = value;
    std::replace(text.begin(), text.end(), '\0', ' ');
    const std::string start = cleanKey(key) + '\0';
    if (const auto plain = latin1(text))
      chunks += pngChunk("tEXt", start + *plain);
    else  // not compressed; no language and no translated key
      chunks += pngChunk("iTXt", start + std::string(4, '\0') + text);
  }
  size_t behindHeader = kPngSignature;
  if (nextPngChunk(png, behindHeader)) png.insert(behindHeader, chunks);
  return png;
}

Metadata pngText(std::string_view png) {
  Metadata metadata;
  size_t offset = kPngSignature;
  while (const auto chunk = nextPngChunk(png, offset)) {
    const size_t zero = chunk->data.find('\0');
    if (!chunk->sound || zero == std::string_view::npos) continue;
    const std::string key(chunk->data.substr(0, zero));
    std::string_view rest = chunk->data.substr(zero + 1);
    if (chunk->type == "tEXt") {
      metadata.emplace_back(key, utf8FromLatin1(rest));
    } else if (chunk->type == "iTXt" && rest.size() >= 2 && rest[0] == 0) {
      const size_t language = rest.find('\0', 2);
      const size_t translated = language == std::string_view::npos ? language : rest.find('\0', language + 1);
      if (translated != std::string_view::npos) metadata.emplace_back(key, rest.substr(translated + 1));
    }
  }
  return metadata;
}

void forEachPngChunk(std::string_view png,
                     const std::function<void(std::string_view type, std::string_view data)>& visit) {
  size_t offset = kPngSignature;
  while (const auto chunk = nextPngChunk(png, offset))
    if (chunk->sound) visit(chunk->type, chunk->data);
}

void checkPngChunks(std::string_view png) {
  size_t offset = kPngSignature;
  while (const auto chunk = nextPngChunk(png, offset)) {
    if (!chunk->sound) throw std::runtime_error("a chunk is damaged: its checksum is wrong");
    if (chunk->type == "IEND") return;
  }
  throw std::runtime_error("the file ends too early");
}

// JPEG: after the start FF D8 come segments: FF, kind, length as two bytes (which count themselves), data.
// FF DA starts the picture itself.

std::string withJpegComments(std::string jpeg, const Metadata& metadata) {
  constexpr size_t kMost = 0xFFFF - 2;
  std::string lines, segments;
  for (const auto& [key, text] : metadata) lines += lineOf(key, text) + '\n';
  for (size_t i = 0; i < lines.size(); i += kMost) {
    const std::string part = lines.substr(i, kMost);
    segments += "\xFF\xFE" + bigEndian(static_cast<std::uint32_t>(part.size() + 2)).substr(2) + part;
  }
  size_t place = 2;
  if (jpeg.size() > 6 && byteAt(jpeg, 2) == 0xFF && byteAt(jpeg, 3) == 0xE0)
    place += 2 + (bigEndianAt(jpeg, 2) & 0xFFFF);
  if (place <= jpeg.size()) jpeg.insert(place, segments);
  return jpeg;
}

Metadata jpegComments(std::string_view jpeg) {
  std::string lines;
  for (size_t i = 2; i + 4 <= jpeg.size() && byteAt(jpeg, i) == 0xFF && byteAt(jpeg, i + 1) != 0xDA;) {
    const size_t length = bigEndianAt(jpeg, i) & 0xFFFF;
    if (length < 2) break;
    if (byteAt(jpeg, i + 1) == 0xFE) lines += jpeg.substr(std::min(i + 4, jpeg.size()), length - 2);
    i += 2 + length;
  }
  Metadata metadata;
  for (size_t start = 0; start < lines.size();) {
    const size_t end = std::min(lines.find('\n', start), lines.size());
    addLine(metadata, std::string_view(lines).substr(start, end - start));
    start = end + 1;
  }
  return metadata;
}

std::string withCommentLines(std::string file, const Metadata& metadata) {
  std::string lines;
  for (const auto& [key, text] : metadata) lines += "# " + lineOf(key, text) + '\n';
  const size_t firstEnd = file.find('\n');
  if (firstEnd != std::string::npos) file.insert(firstEnd + 1, lines);
  return file;
}

Metadata commentLines(std::string_view file) {
  Metadata metadata;
  size_t start = file.find('\n');
  while (start != std::string_view::npos && start + 2 < file.size() && file[start + 1] == '#') {
    const size_t end = std::min(file.find('\n', start + 1), file.size());
    std::string_view line = file.substr(start + 2, end - start - 2);
    if (!line.empty() && line[0] == ' ') line.remove_prefix(1);
    addLine(metadata, line);
    start = end < file.size() ? end : std::string_view::npos;
  }
  return metadata;
}

}  // namespace trace
