// Probes of picture formats: a picture of two by two with one field more or less. What is seen are its
// samples.
#include <gtest/gtest.h>
#include <zlib.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <variant>
#include <vector>

#include "base/error.h"
#include "base/files/file.h"
#include "image/codecs/codec.h"
#include "image/codecs/codec_parts.h"
#include "probes.h"
#include "support/paths.h"
#include "support/webp.h"

namespace trace::probes_picture_test {
namespace {

Outcome readProbe(const std::string& bytes) {
  Outcome outcome;
  try {
    const Raster raster = decodeRaster(bytes, "probe");
    outcome.seen = std::to_string(raster.width) + " " + std::to_string(raster.channels) + ":";
    std::visit(
        [&](const auto& samples) {
          for (const auto sample : samples)
            outcome.seen += " " + std::to_string(static_cast<double>(sample) / raster.most);
        },
        raster.samples);
    if (const std::string remark = pictureRemark(bytes, "a"); !remark.empty()) outcome.told.push_back(remark);
  } catch (const Error& error) {
    outcome.error = error.messages().front().what;
  }
  outcome.lines.assign(outcome.told.size(), 0);
  return outcome;
}

void expectPictures(std::span<const KnownField> rows, const std::vector<Probe>& probes) {
  expectProbes(rows, probes, false, readProbe);
}

template <std::size_t N>
std::string raw(const char (&text)[N]) {
  return std::string(text, N - 1);
}
std::string big(std::uint32_t value, int bytes = 4) {
  std::string text;
  for (int i = bytes; i-- > 0;) text += static_cast<char>(value >> 8 * i);
  return text;
}
std::string little(std::uint32_t value, int bytes = 4) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> 8 * i);
  return text;
}
std::string littleFloat(float value) {
  std::uint32_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return little(bits);
}
/// The text with zeros behind it.
std::string padded(std::string text, std::size_t size) {
  text.resize(size, '\0');
  return text;
}

/// One entry of EXIF: how the picture lies.
std::string exif(int orientation) {
  return raw("MM\0\x2a\0\0\0\x08\0\1\x01\x12\0\3\0\0\0\1\0") + static_cast<char>(orientation) +
         raw("\0\0\0\0\0\0");
}

// --- PNG ---------------------------------------------------------------------------------------------------

std::string packed(const std::string& bytes) {
  std::string room(compressBound(bytes.size()), '\0');
  uLongf size = room.size();
  compress(reinterpret_cast<Bytef*>(room.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
           bytes.size());
  return room.substr(0, size);
}

const std::string kRows =
    raw("\0\xff\0\0\0\xff\0\0\0\0\xff\xff\xff\xff");  // red, green; blue, white, unfiltered

std::string png(const std::string& chunks, const std::string& rows = kRows, int depth = 8, int type = 2,
                int laced = 0, int width = 2, int height = 2) {
  return "\x89PNG\r\n\x1a\n" +
         pngChunk("IHDR", big(static_cast<std::uint32_t>(width)) + big(static_cast<std::uint32_t>(height)) +
                              static_cast<char>(depth) + static_cast<char>(type) + raw("\0\0") +
                              static_cast<char>(laced)) +
         chunks + pngChunk("IDAT", packed(rows)) + pngChunk("IEND", "");
}

TEST(Probes, OfPng) {
  const std::string plain = png("");
  const auto chunk = [&](const std::string& field, const std::string& type, const std::string& data,
                         const std::string& told = {}) {
    return Probe{field, plain, png(pngChunk(type, data)), told};
  };
  const std::string grey = png("", raw("\0\0\xff\0\xff\0"), 8, 0);
  std::string primaries;
  for (std::uint32_t n : {31270u, 32900u, 70800u, 29200u, 17000u, 79700u, 13100u, 4600u}) primaries += big(n);
  const std::string table = pngChunk("PLTE", raw("\xff\0\0\0\xff\0\0\0\xff\xff\xff\xff"));
  const std::string indexed = png(table, raw("\0\0\1\0\2\3"), 8, 3);
  const std::string half = raw("\0\xff\0\0\x80\0\xff\0\x80\0\0\0\xff\x80\xff\xff\xff\x80");
  // The pixel at 0, 0; that at 1, 0; the row below.
  const std::string laced = raw("\0\xff\0\0\0\0\xff\0\0\0\0\xff\xff\xff\xff");
  expectPictures(
      knownPngFields(),
      {{"IHDR: width, height", plain, png("", raw("\0\xff\0\0\0\0\xff\0\0\0\0\xff"), 8, 2, 0, 1, 3)},
       {"IHDR: bit depth 1, 2, 4", plain, png("", raw("\0\x40\0\x80"), 1, 0), "", grey},
       {"IHDR: bit depth 16", plain, png("", raw("\0\0\0\xff\xff\0\xff\xff\0\0"), 16, 0), "", grey},
       {"IHDR: colour type 0, grey", plain, grey},
       {"IHDR: colour type 3, PLTE", grey, indexed, "", plain},
       {"IHDR: colour types 4 and 6, alpha", plain, png("", half, 8, 6)},
       {"IHDR: interlace", grey, png("", laced, 8, 2, 1), "", plain},
       {"tRNS", indexed, png(table + pngChunk("tRNS", raw("\0")), raw("\0\0\1\0\2\3"), 8, 3)},
       chunk("gAMA", "gAMA", big(100000), "gAMA"),
       chunk("cHRM", "cHRM", primaries, "cHRM"),
       chunk("sRGB", "sRGB", raw("\0")),
       chunk("iCCP", "iCCP", raw("wide\0\0") + packed("a profile of wide colours"), "ICC"),
       chunk("cICP", "cICP", raw("\x09\x10\0\1"), "cICP"),
       {"eXIf: orientation", plain, png(pngChunk("eXIf", exif(2))), "",
        png("", raw("\0\0\xff\0\xff\0\0\0\xff\xff\xff\0\0\xff"))},
       chunk("pHYs", "pHYs", big(1000) + big(2000) + '\1', "not square"),
       chunk("acTL", "acTL", big(2) + big(0), "animation"),
       chunk("bKGD", "bKGD", raw("\0\0\0\0\0\xff")),
       chunk("sBIT", "sBIT", raw("\5\6\5")),
       {"hIST", indexed, png(table + pngChunk("hIST", raw("\0\1\0\1\0\1\0\1")), raw("\0\0\1\0\2\3"), 8, 3)},
       chunk("sPLT", "sPLT", raw("few\0\x08\xff\0\0\xff\0\1")),
       chunk("tIME", "tIME", raw("\x07\xd0\1\1\0\0\0")),
       chunk("tEXt", "tEXt", raw("Title\0a quad")),
       chunk("zTXt", "zTXt", raw("Title\0\0") + packed("a quad")),
       chunk("iTXt", "iTXt", raw("Title\0\0\0\0\0a quad"))});
  EXPECT_EQ(pictureRemark(png(pngChunk("iCCP", raw("a\0\0") + packed("the profile sRGB IEC61966-2.1"))), "a"),
            "");
  EXPECT_EQ(pictureRemark(png(pngChunk("gAMA", big(45455))), "a"), "");
}

// --- JPEG --------------------------------------------------------------------------------------------------

TEST(Probes, OfJpeg) {
  const std::string plain = readFile(test::sourceFolder() + "/tests/corpus/pictures/sphere.jpg");
  const auto segment = [](int marker, const std::string& body) {
    return std::string("\xff") + static_cast<char>(marker) +
           big(static_cast<std::uint32_t>(body.size() + 2), 2) + body;
  };
  const auto with = [&](const std::string& more) { return plain.substr(0, 2) + more + plain.substr(2); };
  const std::size_t jfif = plain.find(raw("JFIF\0")), frame = plain.find("\xff\xc0");
  ASSERT_NE(jfif, plain.npos);
  ASSERT_NE(frame, plain.npos);
  std::string dense = plain, arithmetic = plain, lossless = plain, twelve = plain;
  dense.replace(jfif + 8, 4, raw("\0\x48\0\x90"));
  arithmetic[frame + 1] = '\xc9';
  lossless[frame + 1] = '\xc3';
  twelve[frame + 4] = 12;
  const std::size_t length =
      static_cast<unsigned char>(plain[jfif - 2]) << 8 | static_cast<unsigned char>(plain[jfif - 1]);
  const std::string bare = plain.substr(0, 2) + plain.substr(jfif - 2 + length);
  const auto adobe = [&](char transform) {
    return bare.substr(0, 2) + segment(0xee, raw("Adobe\0\x64\0\0\0\0") + transform) + bare.substr(2);
  };
  Picture red(2, 2), blue(2, 2);
  red.pixels.assign(4, Color(1, 0, 0));
  blue.pixels.assign(4, Color(0, 0, 1));
  const auto encoded = [](const Picture& picture) {
    return encodePicture(pictureFormatFor("a.jpg"), picture);
  };
  expectPictures(
      knownJpegFields(),
      {{"pixels", encoded(red), encoded(blue)},
       {"arithmetic coding", plain, arithmetic, "as JPEG"},
       {"lossless", plain, lossless, "as JPEG"},
       {"12 bits", plain, twelve, "as JPEG"},
       {"no end marker", plain, plain.substr(0, plain.rfind("\xff\xd9")), "lacks its end marker"},
       {"JFIF: density", plain, dense, "not square"},
       {"EXIF: orientation", plain, with(segment(0xe1, raw("Exif\0\0") + exif(3)))},
       {"ICC profile", plain, with(segment(0xe2, raw("ICC_PROFILE\0\1\1") + "a profile of wide colours")),
        "ICC"},
       {"Adobe: transform", adobe(1), adobe(0)},
       {"comment", plain, with(segment(0xfe, "a ball"))},
       {"other segments", plain, with(segment(0xe1, raw("http://ns.adobe.com/xap/1.0/\0") + "<x/>"))}});
}

// --- BMP ---------------------------------------------------------------------------------------------------

const std::string kPalette = raw("\0\0\xff\0\0\xff\0\0\xff\0\0\0\xff\xff\xff\0");  // red, green, blue, white

/// A file with a head of 40, 108 or 124 bytes.
struct BmpProbe {
  std::uint32_t headSize = 40;
  int width = 2, height = 2, bits = 8;
  std::uint32_t compression = 0, planes = 1, size = 0, perMetreX = 0, perMetreY = 0, colors = 4,
                important = 0;
  std::string rest = "", between = kPalette, pixels = raw("\2\3\0\0\0\1\0\0");

  std::string bytes() const {
    std::string head = little(headSize) + little(static_cast<std::uint32_t>(width)) +
                       little(static_cast<std::uint32_t>(height)) + little(planes, 2) +
                       little(static_cast<std::uint32_t>(bits), 2) + little(compression) + little(size) +
                       little(perMetreX) + little(perMetreY) + little(colors) + little(important) + rest;
    head.resize(headSize, '\0');
    const auto start = static_cast<std::uint32_t>(14 + head.size() + between.size());
    return "BM" + little(start + static_cast<std::uint32_t>(pixels.size())) + little(0) + little(start) +
           head + between + pixels;
  }
};

TEST(Probes, OfBmp) {
  const std::string plain = BmpProbe{}.bytes();
  const std::string masks = raw("\xff\0\0\0\0\xff\0\0\0\0\xff\0"),  // red is the lowest byte
      colors = raw("\0\0\xff\x80\xff\xff\xff\x80\xff\0\0\x80\0\xff\0\x80"),
                    swapped = raw("\xff\0\0\0\xff\xff\xff\0\0\0\xff\0\0\xff\0\0");
  const BmpProbe masked{.bits = 32, .compression = 3, .between = masks, .pixels = colors};
  const auto wide = [](const std::string& rest, const std::string& pixels = BmpProbe{}.pixels,
                       std::uint32_t head = 108) {
    return BmpProbe{.headSize = head, .rest = rest, .pixels = pixels}.bytes();
  };
  const std::string srgb = std::string(16, '\0') + "BGRs",
                    own = std::string(16, '\0') + little(0) + std::string(36, '\1');
  const std::string nothing = std::string(36, '\0') + std::string(12, '\0');
  const BmpProbe few{.colors = 2, .between = kPalette.substr(0, 8), .pixels = raw("\0\1\0\0\1\3\0\0")};
  expectPictures(
      knownBmpFields(),
      {{"width", plain, BmpProbe{.width = 1}.bytes()},
       {"height", plain, BmpProbe{.height = -2}.bytes()},
       {"planes", plain, BmpProbe{.planes = 3}.bytes()},
       {"bits", plain, BmpProbe{.bits = 4, .pixels = raw("\x12\0\0\0\x03\0\0\0")}.bytes()},
       {"compression 1, 2", BmpProbe{.pixels = raw("\0\0\0\0\0\0\0\0")}.bytes(),
        BmpProbe{.compression = 1, .pixels = raw("\1\2\1\3\0\0\1\0\1\1\0\1")}.bytes(), "", plain},
       {"compression 3, 6", BmpProbe{.bits = 32, .between = "", .pixels = colors}.bytes(), masked.bytes(), "",
        BmpProbe{.bits = 32, .between = "", .pixels = swapped}.bytes()},
       {"compression 4, 5", plain, BmpProbe{.bits = 24, .compression = 5}.bytes(), "compression of kind 5"},
       {"size of the pixels", plain, BmpProbe{.size = 8}.bytes()},
       {"pixels per metre", plain, BmpProbe{.perMetreX = 1000, .perMetreY = 2000}.bytes(), "not square"},
       {"number of colours", BmpProbe{.pixels = few.pixels}.bytes(), few.bytes()},
       {"important colours", plain, BmpProbe{.important = 1}.bytes()},
       {"alpha mask", masked.bytes(),
        BmpProbe{.headSize = 56,
                 .bits = 32,
                 .compression = 3,
                 .rest = masks + raw("\0\0\0\xff"),
                 .between = "",
                 .pixels = colors}
            .bytes()},
       {"calibrated primaries and gamma", wide(srgb), wide(own), "primaries and gamma"},
       {"embedded profile", wide(srgb),
        wide(std::string(16, '\0') + "DEBM" + nothing + little(0) + little(142) + little(8),
             BmpProbe{}.pixels + "profile!", 124),
        "ICC"},
       {"intent", wide(srgb, BmpProbe{}.pixels, 124),
        wide(srgb + nothing + little(4), BmpProbe{}.pixels, 124)}});
}

// --- TGA ---------------------------------------------------------------------------------------------------

const std::string kTgaColors = raw("\0\0\xff\0\xff\0\xff\0\0\xff\xff\xff");  // red, green, blue, white

struct TgaProbe {
  std::string name = "";
  int type = 2, first = 0, x = 0, depth = 24, descriptor = 0x20;
  std::string map = "", pixels = kTgaColors, behind = "";

  std::string bytes() const {
    std::string head = std::string() + static_cast<char>(name.size()) +
                       static_cast<char>(map.empty() ? 0 : 1) + static_cast<char>(type);
    head += map.empty() ? little(0, 4) + '\0'
                        : little(static_cast<std::uint32_t>(first), 2) +
                              little(static_cast<std::uint32_t>(map.size() / 3), 2) + '\x18';
    return head + little(static_cast<std::uint32_t>(x), 2) + little(0, 2) + little(2, 2) + little(2, 2) +
           static_cast<char>(depth) + static_cast<char>(descriptor) + name + map + pixels + behind;
  }
  /// With the extension area of version 2: its numbers at their places.
  std::string extended(std::initializer_list<std::pair<std::size_t, std::string>> values) const {
    const std::string head = bytes();
    std::string area = padded(little(495, 2), 495);
    area[494] = 3;
    for (const auto& [at, value] : values) area.replace(at, value.size(), value);
    return head + area + little(static_cast<std::uint32_t>(head.size())) + little(0) + "TRUEVISION-XFILE." +
           '\0';
  }
};

TEST(Probes, OfTga) {
  const std::string plain = TgaProbe{}.bytes();
  const std::string clear = raw("\0\0\x80\x80\0\x80\0\x80\x80\0\0\x80\x80\x80\x80\x80");
  const TgaProbe alpha{.depth = 32, .descriptor = 0x28, .pixels = clear},
      grey{.type = 3, .depth = 8, .pixels = raw("\0\x40\x80\xff")};
  const TgaProbe mapped{.type = 1, .depth = 8, .map = kTgaColors, .pixels = raw("\0\1\2\3")};
  TgaProbe later = mapped;
  later.first = 2;
  const TgaProbe bits15{.depth = 16, .pixels = raw("\0\x7c\xe0\x03\x1f\0\xff\x7f")};
  TgaProbe bits16 = bits15;
  bits16.descriptor = 0x21;
  expectPictures(
      knownTgaFields(),
      {{"identification", plain, TgaProbe{.name = "a quad"}.bytes()},
       {"type 1, colour map", grey.bytes(), mapped.bytes(), "", plain},
       {"type 2, colours", grey.bytes(), plain},
       {"type 3, grey", plain, grey.bytes()},
       {"types 9, 10, 11, run lengths", grey.bytes(),
        TgaProbe{.type = 10, .pixels = raw("\3") + kTgaColors}.bytes(), "", plain},
       {"first entry of the colour map", mapped.bytes(), later.bytes(), "does not begin at 0"},
       {"x and y of the screen", plain, TgaProbe{.x = 5}.bytes()},
       {"depth", plain, alpha.bytes()},
       {"bits of alpha", alpha.bytes(), TgaProbe{.depth = 32, .pixels = clear}.bytes()},
       {"alpha of 16 bits", bits15.bytes(), bits16.bytes(), "transparency of its 16-bit pixels"},
       {"origin", plain, TgaProbe{.descriptor = 0x10}.bytes()},
       {"interleaving", plain, TgaProbe{.descriptor = 0x60}.bytes(), "interleaved"},
       {"extension: attributes", alpha.extended({}), alpha.extended({{494, "\4"}}), "",
        TgaProbe{.depth = 32,
                 .descriptor = 0x28,
                 .pixels = raw("\0\0\xff\x80\0\xff\0\x80\xff\0\0\x80\xff\xff\xff\x80")}
            .bytes()},
       {"extension: pixel aspect ratio", plain, TgaProbe{}.extended({{474, little(2, 2) + little(1, 2)}}),
        "not square"},
       {"extension: gamma", plain, TgaProbe{}.extended({{478, little(22, 2) + little(10, 2)}}), "gamma"},
       {"extension: colour correction", plain, TgaProbe{}.extended({{482, little(999)}}),
        "corrected colours"},
       {"extension: author and other words", plain, TgaProbe{}.extended({{2, "somebody"}})}});
  EXPECT_EQ(readProbe(alpha.extended({{494, std::string(1, '\0')}})).seen,
            readProbe(TgaProbe{.depth = 32, .pixels = clear}.bytes()).seen);
}

// --- HDR ---------------------------------------------------------------------------------------------------

TEST(Probes, OfPpm) {
  const std::string grey = "P5\n2 1\n255\n@\x80", colors = "P6\n1 1\n255\n@@\x80";
  const auto pam = [](const std::string& depth, const std::string& more, const std::string& samples) {
    return "P7\nWIDTH 1\nHEIGHT 1\nDEPTH " + depth + "\n" + more + "ENDHDR\n" + samples;
  };
  const std::string pam1 = pam("1", "MAXVAL 255\n", "@");
  expectPictures(
      knownPpmFields(),
      {{"P1", grey, "P1\n2 2\n01 10\n", "", "P2 2 2 1 1 0 0 1"},
       {"P2", grey, "P2\n2 1\n255\n128 64\n", "", "P5 2 1 255 \x80@"},
       {"P3", colors, "P3\n1 1\n255\n64 128 64\n", "", "P6 1 1 255 @\x80@"},
       {"P4", grey, raw("P4\n9 1\n\x55\x80"), "", "P2 9 1 1 1 0 1 0 1 0 1 0 0"},
       {"P5", grey, "P5\n2 1\n255\n\x80@"},
       {"P6", colors, "P6\n1 1\n255\n\x80@@"},
       {"maximum", grey, "P5\n2 1\n128\n@\x80"},
       {"# comment", grey, "P5\n# a row\n2 1\n255\n@\x80"},
       {"P7: WIDTH, HEIGHT, DEPTH", pam1, pam("3", "MAXVAL 255\n", "@\x80\x20"), "", "P6 1 1 255 @\x80 "},
       {"P7: MAXVAL", pam1, pam("1", "MAXVAL 128\n", "@")},
       {"P7: TUPLTYPE", pam1, pam("1", "MAXVAL 255\nTUPLTYPE GRAYSCALE\n", "@")},
       {"P7: TUPLTYPE of another kind", pam1, pam("4", "MAXVAL 255\nTUPLTYPE CMYK\n", "@@@@"), "found CMYK"},
       {"P7: depths 2 and 4, alpha", pam1, pam("4", "MAXVAL 255\nTUPLTYPE RGB_ALPHA\n", "@@@@")},
       {"several pictures", grey, grey + grey, "the first of several pictures"}});
}

TEST(Probes, OfPfm) {
  const std::string half = littleFloat(0.5), whole = littleFloat(1);
  const std::string big{half.rbegin(), half.rend()};
  const auto pfm = [](const std::string& samples, const std::string& scale = "-1", const char* kind = "Pf",
                      const char* size = "1 1") {
    return std::string(kind) + "\n" + size + "\n" + scale + "\n" + samples;
  };
  expectPictures(knownPfmFields(), {{"PF", pfm(half), pfm(half + whole + half, "-1", "PF")},
                                    {"Pf", pfm(half), pfm(half + whole, "-1", "Pf", "1 2")},
                                    {"scale: sign", pfm(whole), pfm(big, "1.0"), "", pfm(half)},
                                    {"scale: size", pfm(half), pfm(half, "-2"), "its scale of 2"}});
}

TEST(Probes, OfHdr) {
  const std::string red = raw("\x80\0\0\x81"), green = raw("\0\x80\0\x81");
  const auto hdr = [&](const std::string& lines, const std::string& size = "-Y 1 +X 2",
                       const std::string& pixels = raw("\x80\0\0\x81") + raw("\0\x80\0\x81"),
                       const std::string& format = "32-bit_rle_rgbe") {
    return "#?RADIANCE\n" + lines + "FORMAT=" + format + "\n\n" + size + "\n" + pixels;
  };
  const std::string plain = hdr("");
  std::string run = raw("\2\2\0\x08");
  for (char c : red) run += raw("\x88") + c;
  std::string eight;
  for (int i = 0; i < 8; ++i) eight += red;
  expectPictures(knownHdrFields(),
                 {{"FORMAT", plain, hdr("", "-Y 1 +X 2", red + green, "32-bit_rle_xyze")},
                  {"FORMAT of another kind", plain, hdr("", "-Y 1 +X 2", red + green, "64-bit"),
                   "was expected, found 64-bit"},
                  {"EXPOSURE", plain, hdr("EXPOSURE=2\n")},
                  {"COLORCORR", plain, hdr("COLORCORR=2 1 1\n")},
                  {"PRIMARIES", plain, hdr("PRIMARIES=0.7 0.3 0.2 0.7 0.1 0.1 0.3 0.3\n"), "primaries"},
                  {"PIXASPECT", plain, hdr("PIXASPECT=2\n"), "not square"},
                  {"VIEW", plain, hdr("VIEW= -vtv -vp 0 0 0\n")},
                  {"SOFTWARE", plain, hdr("SOFTWARE=a program\n")},
                  {"# comment", plain, hdr("# a row\n")},
                  {"orientation", plain, hdr("", "-Y 1 -X 2"), "", hdr("", "-Y 1 +X 2", green + red)},
                  {"run lengths", plain, hdr("", "-Y 1 +X 8", run), "", hdr("", "-Y 1 +X 8", eight)}});
}

// --- EXR ---------------------------------------------------------------------------------------------------

/// A file of 2 by 2 floats, without compression.
struct ExrProbe {
  struct Layer {
    std::string name;
    std::vector<float> values;
    int type = 2, sampling = 1;  ///< 0 uint, 1 half, 2 float
  };
  static std::string attribute(const std::string& name, const std::string& type, const std::string& value) {
    return name + '\0' + type + '\0' + little(static_cast<std::uint32_t>(value.size())) + value;
  }
  static std::string box(int x0, int y0, int x1, int y1) {
    std::string text;
    for (int n : {x0, y0, x1, y1}) text += little(static_cast<std::uint32_t>(n));
    return text;
  }
  static std::string sample(float value, int type) {
    if (type == 2) return littleFloat(value);
    if (type == 0) return little(static_cast<std::uint32_t>(value));
    return little(value == 0 ? 0u : value == 1 ? 0x3c00u : 0x3800u, 2);  // 0.5
  }

  std::vector<Layer> layers = {{"B", {0, 0, 1, 1}}, {"G", {0, 1, 0, 1}}, {"R", {1, 0, 0, 1}}};
  std::string more = "", display = box(0, 0, 1, 1), data = box(0, 0, 1, 1);
  char lineOrder = 0;
  float aspect = 1, center = 0, width = 1;
  bool tiled = false, deep = false;
  int parts = 1;

  std::string header(const std::string& part) const {
    std::string list;
    for (const Layer& layer : layers)
      list += layer.name + '\0' + little(static_cast<std::uint32_t>(layer.type)) + raw("\0\0\0\0") +
              little(static_cast<std::uint32_t>(layer.sampling)) +
              little(static_cast<std::uint32_t>(layer.sampling));
    return attribute("channels", "chlist", list + '\0') + attribute("compression", "compression", raw("\0")) +
           attribute("dataWindow", "box2i", data) + attribute("displayWindow", "box2i", display) +
           attribute("lineOrder", "lineOrder", std::string(1, lineOrder)) +
           attribute("pixelAspectRatio", "float", littleFloat(aspect)) +
           attribute("screenWindowCenter", "v2f", littleFloat(center) + littleFloat(0.0f)) +
           attribute("screenWindowWidth", "float", littleFloat(width)) +
           (tiled ? attribute("tiles", "tiledesc", little(2) + little(2) + raw("\0")) : "") + part + more +
           '\0';
  }
  std::string row(int y) const {
    std::string text;
    for (const Layer& layer : layers)
      for (std::size_t x = 0; x < 2; ++x)
        if (layer.sampling == 1)
          text += sample(layer.values[2 * static_cast<std::size_t>(y) + x], layer.type);
        else if (x == 0 && y == 0)
          text += sample(layer.values[0], layer.type);
    return text;
  }
  std::string bytes() const {
    const bool named = parts > 1 || deep;
    std::string file = raw("\x76\x2f\x31\x01") +
                       little(2u | (tiled ? 0x200u : 0u) | (deep ? 0x800u : 0u) | (parts > 1 ? 0x1000u : 0u));
    for (int part = 0; part < parts; ++part)
      file +=
          header(named ? attribute("name", "string", std::string("part") + static_cast<char>('a' + part)) +
                             attribute("type", "string", deep ? "deepscanline" : "scanlineimage") +
                             attribute("chunkCount", "int", little(2)) +
                             (deep ? attribute("version", "int", little(1)) : "")
                       : "");
    if (parts > 1) file += '\0';
    std::vector<std::string> chunks;
    for (int part = 0; part < parts; ++part) {
      const std::string number = parts > 1 ? little(static_cast<std::uint32_t>(part)) : "";
      if (tiled) {
        const std::string rows = row(0) + row(1);
        chunks.push_back(box(0, 0, 0, 0) + little(static_cast<std::uint32_t>(rows.size())) + rows);
        continue;
      }
      const int first = static_cast<int>(static_cast<unsigned char>(data[4]));
      for (int y = 0; y < 2; ++y)
        chunks.push_back(number + little(static_cast<std::uint32_t>(first + y)) +
                         little(static_cast<std::uint32_t>(row(y).size())) + row(y));
    }
    // Of rows that go upward, the last is the first in the file; the offsets are always in the order of y.
    std::string offsets, body;
    for (const std::string& chunk : chunks) {
      std::size_t at = file.size() + 8 * chunks.size();
      const auto same = static_cast<std::size_t>(&chunk - chunks.data());
      for (std::size_t i = 0; i < chunks.size(); ++i)
        if (lineOrder == 0 ? i < same : i > same) at += chunks[i].size();
      offsets += little(static_cast<std::uint32_t>(at)) + little(0);
      body = lineOrder == 0 ? body + chunk : chunk + body;
    }
    return file + offsets + body;
  }
};

TEST(Probes, OfExr) {
  using P = ExrProbe;
  const std::string plain = P{}.bytes();
  const auto more = [&](const std::string& name, const std::string& type, const std::string& value) {
    return P{.more = P::attribute(name, type, value)}.bytes();
  };
  const std::vector<float> half{0.5f, 0.5f, 0.5f, 0.5f};
  const P grey{.layers = {{"Y", {0, 1, 0, 1}}}};
  auto layers = P{}.layers;
  auto withAlpha = layers, withDepth = layers, withLayer = layers, halves = layers, coarse = layers;
  withAlpha.insert(withAlpha.begin(), {"A", half});
  withDepth.push_back({"Z", half});
  withLayer.push_back({"left.R", half});
  for (auto& layer : halves) layer.type = 1;
  coarse[0].sampling = 2;
  Picture quad(2, 2);
  quad.pixels = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  P shifted;
  shifted.display = P::box(0, 0, 2, 2);
  std::string primaries;
  for (float n : {1.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.3333f, 0.3333f}) primaries += littleFloat(n);
  P moved = shifted;
  moved.data = P::box(1, 1, 2, 2);
  auto chroma = std::vector<P::Layer>{{"BY", half}, {"RY", half}, {"Y", {0, 1, 0, 1}}};
  P upward;
  upward.lineOrder = 1;
  const auto space =
      std::vector<P::Layer>{{"X", layers[2].values}, {"Y", layers[1].values}, {"Z", layers[0].values}};
  expectPictures(knownExrFields(),
                 {{"R, G, B", grey.bytes(), plain},
                  {"A", plain, P{.layers = withAlpha}.bytes()},
                  {"Y", plain, grey.bytes()},
                  {"Y, RY, BY", grey.bytes(), P{.layers = chroma}.bytes()},
                  {"X, Y, Z", grey.bytes(), P{.layers = space}.bytes(), "", plain},
                  {"U, V", grey.bytes(), P{.layers = {{"U", {1, 0, 0, 1}}, {"V", {0, 1, 0, 1}}}}.bytes(), "",
                   P{.layers = {{"G", {0, 1, 0, 1}}, {"R", {1, 0, 0, 1}}}}.bytes()},
                  {"one channel", plain, P{.layers = {{"G", {0, 1, 0, 1}}}}.bytes(), "", grey.bytes()},
                  {"other channels", plain, P{.layers = withDepth}.bytes(), "channels that are not shown: Z"},
                  {"layers", plain, P{.layers = withLayer}.bytes(), "layers are not shown"},
                  {"types half, float, uint", grey.bytes(), P{.layers = halves}.bytes(), "", plain},
                  {"sampling", plain, P{.layers = coarse}.bytes(), "lower resolution"},
                  {"parts", plain, P{.parts = 2}.bytes(), "only the first of its parts is shown"},
                  {"deep data", plain, P{.deep = true}.bytes(), "deep"},
                  {"tiles", grey.bytes(), P{.tiled = true}.bytes(), "", plain},
                  {"compression", grey.bytes(), encodePicture(pictureFormatFor("a.exr"), quad), "", plain},
                  {"lineOrder", plain, upward.bytes()},
                  {"dataWindow", shifted.bytes(), moved.bytes()},
                  {"displayWindow", plain, shifted.bytes()},
                  {"pixelAspectRatio", plain, P{.aspect = 2}.bytes(), "not square"},
                  {"screenWindowCenter", plain, P{.center = 1}.bytes()},
                  {"screenWindowWidth", plain, P{.width = 3}.bytes()},
                  {"chromaticities", plain, more("chromaticities", "chromaticities", primaries)},
                  {"whiteLuminance", plain, more("whiteLuminance", "float", littleFloat(100.0f)),
                   "luminance of its white"},
                  {"adoptedNeutral", plain,
                   more("adoptedNeutral", "v2f", littleFloat(0.3f) + littleFloat(0.3f)), "adopted white"},
                  {"envmap", plain, more("envmap", "envmap", raw("\1")), "sides of its cube"},
                  {"wrapmodes", plain, more("wrapmodes", "string", "clamp"), "wrap modes"},
                  {"other attributes", plain, more("owner", "string", "somebody")}});
}

// --- WebP --------------------------------------------------------------------------------------------------

TEST(Probes, OfWebp) {
  using test::webpAnimation, test::webpChunk, test::webpFile, test::webpFrame, test::webpHead, test::webpOf;
  const auto raster = [](int channels, std::vector<std::uint8_t> samples) {
    Raster quad(2, 2, channels, 255);
    quad.samples = std::move(samples);
    return quad;
  };
  const Raster quad = raster(3, {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255});
  const Raster half = raster(4, {255, 0, 0, 128, 0, 255, 0, 128, 0, 0, 255, 0, 255, 255, 255, 255});
  const Raster upset = raster(3, {0, 255, 0, 255, 0, 0, 255, 255, 255, 0, 0, 255});
  const Raster dark = raster(3, std::vector<std::uint8_t>(12, 9));
  const std::string plain = webpOf(quad), lossy = webpOf(quad, false), chunks = test::chunksOf(plain);
  const auto extended = [&](int flags, const std::string& before, const std::string& after) {
    return webpFile(webpHead(flags, 2, 2) + before + chunks + after);
  };
  expectPictures(
      knownWebpFields(),
      {{"VP8, with loss", webpOf(dark, false), lossy},
       {"VP8L, without loss", webpOf(dark), plain, "", png("")},
       {"alpha of VP8L", plain, webpOf(half)},
       {"ALPH", lossy, webpOf(half, false)},
       {"ANIM, ANMF", plain, webpAnimation(2, 2, webpFrame(0, 0, quad)), "of an animation"},
       {"EXIF: orientation", plain, extended(8, "", webpChunk("EXIF", exif(2))), "", webpOf(upset)},
       {"ICCP", plain, extended(32, webpChunk("ICCP", "a profile of wide colours"), ""), "ICC"},
       {"XMP", plain, extended(4, "", webpChunk("XMP ", "<x:xmpmeta/>"))},
       {"other chunks", plain, extended(0, "", webpChunk("mine", "odd"))}});
  const Outcome named = readProbe(extended(8, "", webpChunk("EXIF", raw("Exif\0\0") + exif(2))));
  EXPECT_EQ(named.seen, readProbe(webpOf(upset)).seen) << "as some programs write it";
  EXPECT_EQ(pictureRemark(extended(32, webpChunk("ICCP", "the profile sRGB IEC61966-2.1"), ""), "a"), "");
}

}  // namespace
}  // namespace trace::probes_picture_test
