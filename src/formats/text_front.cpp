#include "formats/text_front.h"

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <new>
#include <utility>

#include "base/budget.h"
#include "base/files/named_file.h"
#include "base/text.h"
#include "formats/words.h"

namespace trace {
namespace {

constexpr char kDosEnd = '\x1a';
constexpr std::string_view kWhiteSpace = " \t\r\n\v\f";

/// All members of a gzip file.
std::string gunzipped(const std::string& file, std::string_view bytes) {
  constexpr std::size_t kMost = std::size_t{2} << 30, kPiece = 1 << 16;
  constexpr int kGzipOnly = 16 + MAX_WBITS;
  const auto fail = [&](const std::string& what) {
    throw Error(Fault::scene, SourcePlace{.file = file}, what);
  };
  z_stream stream{};
  if (inflateInit2(&stream, kGzipOnly) != Z_OK) throw std::bad_alloc();
  const std::unique_ptr<z_stream, int (*)(z_stream*)> closing(&stream, inflateEnd);
  std::string text;
  char piece[kPiece];
  for (std::size_t at = 0;;) {
    checkBudget();
    if (stream.avail_in == 0) {
      const std::size_t count = std::min<std::size_t>(bytes.size() - at, std::size_t{1} << 30);
      stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data() + at));  // it is only read
      stream.avail_in = static_cast<uInt>(count);
      at += count;
    }
    stream.next_out = reinterpret_cast<Bytef*>(piece);
    stream.avail_out = kPiece;
    const int state = inflate(&stream, Z_NO_FLUSH);
    text.append(piece, kPiece - stream.avail_out);
    if (text.size() > kMost)
      throw Error(Fault::limit, SourcePlace{.file = file}, "the gzip archive holds more than 2 GiB");
    if (state == Z_MEM_ERROR) throw std::bad_alloc();
    if (state != Z_OK && state != Z_STREAM_END && state != Z_BUF_ERROR)
      fail("the gzip archive is damaged after " + std::to_string(text.size()) + " bytes of its content");
    const std::string_view left = bytes.substr(at - stream.avail_in);
    if (state == Z_STREAM_END) {
      if (!left.starts_with("\x1f\x8b")) return text;  // no further member
      inflateReset(&stream);
    } else if (left.empty() && stream.avail_out == kPiece) {
      fail("the gzip archive ends too early");
    }
  }
}

void appendUtf8(std::string& text, std::uint32_t code) {
  constexpr std::uint32_t kReplacement = 0xfffd;
  if (code > 0x10ffff || (code >= 0xd800 && code < 0xe000)) code = kReplacement;
  const auto add = [&](std::uint32_t byte) { text += static_cast<char>(byte); };
  if (code < 0x80) {
    add(code);
  } else if (code < 0x800) {
    add(0xc0 | code >> 6);
    add(0x80 | (code & 63));
  } else if (code < 0x10000) {
    add(0xe0 | code >> 12);
    add(0x80 | (code >> 6 & 63));
    add(0x80 | (code & 63));
  } else {
    add(0xf0 | code >> 18);
    add(0x80 | (code >> 12 & 63));
    add(0x80 | (code >> 6 & 63));
    add(0x80 | (code & 63));
  }
}

struct WideText {
  std::size_t unit = 0;  ///< bytes of one: 2, 4, or 0 for a text of bytes
  bool big = false;      ///< the high byte is the first
};

/// By its byte order mark, or by ASCII at its start.
WideText wideTextOf(std::string_view bytes) {
  using namespace std::string_view_literals;
  if (bytes.starts_with("\xff\xfe\0\0"sv)) return {4, false};
  if (bytes.starts_with("\0\0\xfe\xff"sv)) return {4, true};
  if (bytes.starts_with("\xff\xfe")) return {2, false};
  if (bytes.starts_with("\xfe\xff")) return {2, true};
  constexpr std::size_t kLook = 8;
  if (bytes.size() < kLook) return {};
  for (const bool big : {false, true}) {
    bool wide = true;
    for (std::size_t i = 0; i < kLook && wide; i += 2) {
      const char low = bytes[i + big], high = bytes[i + !big];
      wide = high == 0 && ((low >= ' ' && low <= '~') || (low >= '\t' && low <= '\r'));
    }
    if (wide) return {2, big};
  }
  return {};
}

std::string narrowed(std::string_view bytes, const WideText& wide) {
  std::string text;
  text.reserve(bytes.size() / wide.unit);
  const auto unitAt = [&](std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < wide.unit; ++i)
      value = value << 8 | static_cast<unsigned char>(bytes[at + (wide.big ? i : wide.unit - 1 - i)]);
    return value;
  };
  for (std::size_t at = 0; at + wide.unit <= bytes.size(); at += wide.unit) {
    std::uint32_t code = unitAt(at);
    const bool isHigh = wide.unit == 2 && code >= 0xd800 && code < 0xdc00;
    if (isHigh && at + 4 <= bytes.size())
      if (const std::uint32_t low = unitAt(at + 2); low >= 0xdc00 && low < 0xe000) {
        code = 0x10000 + ((code - 0xd800) << 10) + (low - 0xdc00);
        at += 2;
      }
    appendUtf8(text, code);
  }
  return text;
}

/// The bytes of a PLY header may be followed by some that look like text.
bool isBinaryPly(std::string_view bytes) {
  return bytes.starts_with("ply") && bytes.substr(0, 4096).find("format binary") != bytes.npos;
}

}  // namespace

TextFront::TextFront(const std::string& file, std::string_view bytes) : text_(bytes) {
  if (text_.starts_with("\x1f\x8b")) {
    room_ = gunzipped(file, text_);
    text_ = room_;
    encoded_ = true;
  }
  if (const WideText wide = wideTextOf(text_); wide.unit > 0) {
    room_ = narrowed(text_, wide);
    text_ = room_;
    encoded_ = true;
  }
  if (text_.starts_with("\xef\xbb\xbf")) text_.remove_prefix(3);
  if (isBinaryPly(text_)) return;
  cutEnd();
  endLines();
}

TextFront::TextFront(const std::string& file, std::string_view bytes, Messages& messages)
    : TextFront(file, bytes) {
  if (cutText_)
    messages.warn(placeAt(file, std::string(text_) + kDosEnd, text_.size()),
                  "what follows the DOS end of file, byte 0x1a, is ignored");
}

/// The end of a text on a disk of DOS or CP/M: 0x1A, and up to its block anything at all; or zeros.
void TextFront::cutEnd() {
  constexpr std::size_t kBlock = 128;
  std::size_t end = text_.find_last_not_of(std::string_view(" \t\r\n\v\f\x1a\0", 8));
  end = end == text_.npos ? 0 : end + 1;
  const std::size_t zero = std::min(text_.find('\0'), text_.size());
  const std::size_t dosEnd = std::min(text_.find(kDosEnd), text_.size());
  const bool inLastBlock = dosEnd < end && text_.size() - dosEnd <= kBlock && zero > dosEnd;
  if (zero < end && !inLastBlock) return;  // no text
  const std::size_t keep = inLastBlock ? dosEnd : std::min(zero, dosEnd >= end ? dosEnd : zero);
  if (keep >= text_.size()) return;
  cut_ = true;
  cutText_ = inLastBlock;
  text_ = text_.substr(0, keep);
}

/// \r alone becomes \n. Those before a \n belong to it.
void TextFront::endLines() {
  const auto next = [&](std::size_t at) { return text_.find('\r', at); };
  std::size_t first = next(0);
  const auto isAlone = [&](std::size_t at) {
    const std::size_t other = text_.find_first_not_of('\r', at);
    return other == text_.npos || text_[other] != '\n';
  };
  while (first != text_.npos && !isAlone(first)) first = next(first + 1);
  if (first == text_.npos || text_.find('\0') != text_.npos) return;
  if (text_.data() < room_.data() || text_.data() >= room_.data() + room_.size()) {
    room_ = text_;
    text_ = room_;
  }
  char* const text = room_.data() + (text_.data() - room_.data());
  for (std::size_t at = first; at != text_.npos; at = next(at + 1))
    if (isAlone(at)) text[at] = '\n';
}

std::string readTextBeside(const std::string& from, const std::string& name, InputFiles& inputs,
                           Messages& messages) {
  std::string bytes = readBeside(from, name, inputs);
  const TextFront front(namedFile(from, name).path, bytes, messages);
  return front.text().data() == bytes.data() && front.text().size() == bytes.size()
             ? std::move(bytes)
             : std::string(front.text());
}

bool beginsWithWord(std::string_view text, std::string_view word) {
  text.remove_prefix(std::min(text.find_first_not_of(kWhiteSpace), text.size()));
  return sameWord(text.substr(0, text.find_first_of(kWhiteSpace)), word);
}

}  // namespace trace
