// Picture files. Most tests are loops over the table of formats; the known answers were written out by hand
// from the specifications of BMP, TGA, PPM and PNG.
#include "image/codecs/codec.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <stdexcept>

#include "base/error.h"
#include "base/files/file.h"
#include "image/comparison/compare.h"
#include "support/folder.h"
#include "support/paths.h"
#include "support/webp.h"

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace trace {
namespace {

namespace fs = std::filesystem;

std::string text(std::initializer_list<int> bytes) {
  std::string result;
  for (int byte : bytes) result += static_cast<char>(byte);
  return result;
}

const PictureFormat& formatNamed(std::string_view name) {
  for (const PictureFormat& format : pictureFormats())
    if (format.name == name) return format;
  throw std::runtime_error("no such format");
}

std::vector<PictureFormat> writtenFormats() {
  std::vector<PictureFormat> all;
  for (const PictureFormat& format : pictureFormats())
    if (format.encode) all.push_back(format);
  return all;
}

/// A file of any format, also of one that is only read.
std::string fileOf(const PictureFormat& format, const Picture& picture, const Metadata& metadata = {}) {
  return format.encode ? encodePicture(format, picture, Rounding::truncate, metadata)
                       : test::webpOf(picture, Rounding::truncate);
}

std::size_t files(const test::Folder& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder.path()), {}));
}

/// Smooth, so that JPEG keeps it; every channel different, no symmetry, exact 8-bit levels.
Picture smoothPicture(int width, int height) {
  Bytes bytes{width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int channel = 0; channel < 3; ++channel)
        bytes.rgb.push_back(static_cast<std::uint8_t>(40 + 7 * x + 11 * y + 20 * channel));
  return fromBytes(bytes);
}

/// Exact 8-bit levels without any pattern.
Picture noisyPicture(int width, int height) {
  Bytes bytes{width, height, {}};
  std::uint32_t state = 1;
  for (int i = 0; i < 3 * width * height; ++i) {
    state = state * 1664525u + 1013904223u;
    bytes.rgb.push_back(static_cast<std::uint8_t>(state >> 24));
  }
  return fromBytes(bytes);
}

/// Values from 2^-10 to 2^18 that a float holds exactly. (Not by rounding doubles: at -O2, GCC 12 drops
/// double(float(x)) for neighbouring members of a struct.)
Picture brightPicture(int width, int height) {
  const Bytes levels = toBytes(noisyPicture(width, height), Rounding::nearest);
  Picture picture(width, height);
  for (size_t i = 0; i < picture.pixels.size(); ++i) {
    const std::uint8_t* rgb = &levels.rgb[3 * i];
    picture.pixels[i] = Color(rgb[0], rgb[1], rgb[2]) * std::ldexp(1.0, static_cast<int>(i % 21) - 10);
  }
  return picture;
}

constexpr int kSizes[][2] = {{1, 1}, {3, 2}, {17, 5}, {2, 9}, {300, 3}};

TEST(Codec, EveryFormatComesBack) {
  const test::Folder folder;
  for (const PictureFormat& format : writtenFormats())
    for (const auto& [width, height] : kSizes) {
      SCOPED_TRACE(std::string(format.name) + " " + std::to_string(width) + "x" + std::to_string(height));
      const bool lossy = format.name == "JPEG";
      const Picture picture = lossy ? smoothPicture(width, std::min(height, 9)) : noisyPicture(width, height);
      const std::string path = folder / ("picture" + std::string(format.suffixes[0]));
      for (Rounding rounding : {Rounding::truncate, Rounding::nearest}) {
        writePicture(path, picture, rounding);
        const Comparison c =
            compare(toBytes(picture, rounding), toBytes(readPicture(path), Rounding::nearest));
        ASSERT_TRUE(c.sameSize);
        // The ramp of the widest picture wraps from 255 to 0, where JPEG rings.
        const double measured = lossy && width > 20 ? c.mean : c.maxDifference;
        EXPECT_LE(measured, format.lossless ? 0 : lossy ? 4 : 1);
      }
    }
  EXPECT_EQ(files(folder), writtenFormats().size());  // no temporary file left
}

TEST(Codec, BrightValuesComeBackWhereTheFormatKeepsThem) {
  for (const PictureFormat& format : writtenFormats()) {
    if (!format.keepsBright) continue;
    SCOPED_TRACE(format.name);
    const Picture picture = brightPicture(17, 5);
    const Picture back = decodePicture(encodePicture(format, picture), "memory");
    if (format.lossless) {
      EXPECT_EQ(back, picture);
    } else {  // RGBE: 8 bits of mantissa for the largest channel
      for (size_t i = 0; i < picture.pixels.size(); ++i) {
        const double step = maxComponent(picture.pixels[i]) / 256;
        EXPECT_NEAR(back.pixels[i].r, picture.pixels[i].r, step);
        EXPECT_NEAR(back.pixels[i].g, picture.pixels[i].g, step);
        EXPECT_NEAR(back.pixels[i].b, picture.pixels[i].b, step);
      }
    }
  }
}

// The mantissa 255.99... of such a value must not become 256 and wrap to black.
TEST(Codec, ValuesJustBelowAPowerOfTwoStayBright) {
  Picture picture(2, 24);
  for (int y = 0; y < 24; ++y)
    for (int x = 0; x < 2; ++x)
      picture.at(x, y) = Color(std::ldexp(double(std::nextafter(1.0f, 0.0f)), x == 0 ? y : -y));
  const Picture back = decodePicture(encodePicture(formatNamed("HDR"), picture), "memory");
  for (size_t i = 0; i < back.pixels.size(); ++i)
    EXPECT_NEAR(back.pixels[i].g / picture.pixels[i].g, 1, 1.0 / 256);
}

TEST(Codec, NumbersThatAreNoneAreWrittenByEveryFormat) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Picture picture(2, 1);
  picture.at(0, 0) = {std::nan(""), kInfinity, -kInfinity};
  picture.at(1, 0) = {-1, 1e300, 1e-300};
  for (const PictureFormat& format : writtenFormats()) {
    SCOPED_TRACE(format.name);
    const Picture back = decodePicture(encodePicture(format, picture), "memory");
    if (format.name == "HDR") {
      EXPECT_TRUE(isFinite(back.at(0, 0)));
      EXPECT_GT(back.at(0, 0).g, 1e38);
      EXPECT_EQ(back.at(1, 0).r, 0);
    }
    if (format.name == "EXR") {
      EXPECT_TRUE(std::isnan(back.at(0, 0).r));
      EXPECT_EQ(back.at(0, 0).g, kInfinity);
      EXPECT_EQ(back.at(1, 0).r, -1);
    }
  }
}

// A program that writes binary files in text mode turns 0A into 0D 0A.
TEST(Codec, LineFeedLevelsSurvive) {
  const test::Folder folder;
  const Bytes bytes{3, 1, {0x0A, 0x0A, 0x0A, 0x0D, 0x0A, 0x1A, 0x0A, 0x0D, 0x00}};
  for (const PictureFormat& format : writtenFormats()) {
    if (!format.lossless) continue;
    const std::string path = folder / ("feed" + std::string(format.suffixes[0]));
    writePicture(path, fromBytes(bytes));
    EXPECT_EQ(toBytes(readPicture(path), Rounding::nearest), bytes) << format.name;
  }
}

// --- known answers -----------------------------------------------------------------------------------

// Above: red, (10,10,10). Below: (1,2,3), (4,5,6).
const Bytes kKnown{2, 2, {255, 0, 0, 10, 10, 10, 1, 2, 3, 4, 5, 6}};

TEST(CodecKnownAnswer, Bmp) {
  const std::string file =
      text({'B', 'M', 70,  0,  0,  0,  0, 0, 0, 0, 54, 0, 0, 0,         // file header
            40,  0,   0,   0,  2,  0,  0, 0, 2, 0, 0,  0, 1, 0, 24, 0,  // info header
            0,   0,   0,   0,  0,  0,  0, 0, 0, 0, 0,  0, 0, 0, 0,  0,
            0,   0,   0,   0,  0,  0,  0, 0, 3, 2, 1,  6, 5, 4, 0,  0,  // from below, b g r, padded
            0,   0,   255, 10, 10, 10, 0, 0});
  EXPECT_EQ(encodePicture(formatNamed("BMP"), fromBytes(kKnown)), file);
  EXPECT_EQ(toBytes(decodePicture(file, "bmp"), Rounding::nearest), kKnown);
}

TEST(CodecKnownAnswer, BmpWhoseRowsBeginAbove) {
  constexpr std::size_t kPixels = 54, kRow = 8;
  std::string file = encodePicture(formatNamed("BMP"), fromBytes(kKnown));
  file.replace(22, 4, text({254, 255, 255, 255}));  // a height of -2
  std::swap_ranges(&file[kPixels], &file[kPixels + kRow], &file[kPixels + kRow]);
  EXPECT_EQ(toBytes(decodePicture(file, "bmp"), Rounding::nearest), kKnown);
}

TEST(CodecKnownAnswer, Tga) {
  const std::string file =
      text({0, 0, 10, 0,   0,  0,  0, 0, 0, 0, 0, 0, 2, 0, 2, 0, 24, 0,  // run-length colours
            1, 3, 2,  1,   6,  5,  4,                                    // two literal pixels
            1, 0, 0,  255, 10, 10, 10});
  EXPECT_EQ(encodePicture(formatNamed("TGA"), fromBytes(kKnown)), file);
  EXPECT_EQ(toBytes(decodePicture(file, "tga"), Rounding::nearest), kKnown);
  const std::string plainFromAbove = text(
      {0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 2, 0, 24, 0x20, 0, 0, 255, 10, 10, 10, 3, 2, 1, 6, 5, 4});
  EXPECT_EQ(toBytes(decodePicture(plainFromAbove, "tga"), Rounding::nearest), kKnown);
}

TEST(CodecKnownAnswer, Ppm) {
  const std::string file = "P6\n2 2\n255\n" + text({255, 0, 0, 10, 10, 10, 1, 2, 3, 4, 5, 6});
  EXPECT_EQ(encodePicture(formatNamed("PPM"), fromBytes(kKnown)), file);
  EXPECT_EQ(toBytes(decodePicture(file, "ppm"), Rounding::nearest), kKnown);
}

TEST(CodecKnownAnswer, PpmOfOtherKinds) {
  const Picture plain = decodePicture("P3 # words\n2 # more\n1\n10\n10 5 0\n0 0 10", "p3");
  EXPECT_EQ(plain.at(0, 0), Color(1, 0.5, 0));
  EXPECT_EQ(plain.at(1, 0), Color(0, 0, 1));
  const Picture wide = decodePicture("P6\n1 1\n65535\n" + text({0xFF, 0xFF, 0x80, 0x00, 0, 1}), "p6");
  EXPECT_EQ(wide.at(0, 0), Color(1, 32768 / 65535.0, 1 / 65535.0));
  EXPECT_EQ(decodePicture("P5 1 1 255\n\x33", "p5").at(0, 0), Color(0.2));
  EXPECT_EQ(decodePicture("P2 1 1 4 1", "p2").at(0, 0), Color(0.25));
}

TEST(CodecKnownAnswer, Hdr) {
  // From "Real Pixels": value = mantissa / 256 * 2^(exponent - 128).
  Picture picture(2, 1);
  picture.at(0, 0) = {1, 0.5, 0.25};
  picture.at(1, 0) = {0, 640, 0};
  const std::string header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n";
  const std::string file = header + text({128, 64, 32, 129, 0, 160, 0, 138});
  EXPECT_EQ(encodePicture(formatNamed("HDR"), picture), file);
  EXPECT_EQ(decodePicture(file, "hdr"), picture);
}

TEST(CodecKnownAnswer, HdrWithRunLengthCodedRow) {
  const std::string file =
      "#?RGBE\n# by hand\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=1\n\n-Y 1 +X 8\n" +
      text({2, 2, 0, 8, 128 + 8, 128, 3, 0, 64, 128, 128 + 5, 0, 128 + 8, 0, 128 + 8, 129});
  const Picture picture = decodePicture(file, "hdr");
  EXPECT_EQ(picture.at(0, 0), Color(1, 0, 0));
  EXPECT_EQ(picture.at(1, 0), Color(1, 0.5, 0));
  EXPECT_EQ(picture.at(2, 0), Color(1, 1, 0));
  EXPECT_EQ(picture.at(7, 0), Color(1, 0, 0));
  for (size_t length = 0; length < file.size(); ++length)
    EXPECT_THROW(decodePicture(file.substr(0, length), "cut"), Error);
}

// The checksum once more, bit by bit, so that the table of the program is not its own judge.
std::uint32_t crc(std::string_view bytes) {
  std::uint32_t c = ~0u;
  for (char byte : bytes) {
    c ^= static_cast<std::uint8_t>(byte);
    for (int bit = 0; bit < 8; ++bit) c = c & 1 ? 0xEDB88320u ^ (c >> 1) : c >> 1;
  }
  return ~c;
}
std::string big(std::uint32_t n) {
  return text({int(n >> 24), int(n >> 16 & 255), int(n >> 8 & 255), int(n & 255)});
}
std::string chunk(const std::string& typeAndData) {
  return big(static_cast<std::uint32_t>(typeAndData.size() - 4)) + typeAndData + big(crc(typeAndData));
}
const std::string kPngSignature = text({0x89, 'P', 'N', 'G', 13, 10, 26, 10});

TEST(CodecKnownAnswer, PngChunks) {
  const Metadata words{{"Software", "Trace"}, {"Author", "J\xC3\xBCrgen"}, {"Title", "\xE2\x88\x9E"}};
  const std::string file = encodePicture(formatNamed("PNG"), fromBytes(kKnown), Rounding::truncate, words);
  const std::string begin = kPngSignature + chunk("IHDR" + big(2) + big(2) + text({8, 2, 0, 0, 0})) +
                            chunk("tEXtSoftware" + text({0}) + "Trace") +
                            chunk("tEXtAuthor" + text({0}) + "J\xFCrgen") +
                            chunk("iTXtTitle" + text({0, 0, 0, 0, 0}) + "\xE2\x88\x9E");
  ASSERT_EQ(file.substr(0, begin.size()), begin);
  const std::string end = text({0, 0, 0, 0, 'I', 'E', 'N', 'D', 0xAE, 0x42, 0x60, 0x82});
  ASSERT_EQ(file.substr(file.size() - 12), end);
  const std::string data = file.substr(begin.size(), file.size() - begin.size() - 12);
  EXPECT_EQ(data, chunk(data.substr(4, data.size() - 8)));
  EXPECT_EQ(data.substr(4, 4), "IDAT");
}

TEST(CodecKnownAnswer, PngRead) {
  // One stored deflate block; rows from above, each with filter 0; Adler-32 worked out apart.
  const std::string rows = text({0, 255, 0, 0, 10, 10, 10, 0, 1, 2, 3, 4, 5, 6});
  std::uint32_t a = 1, b = 0;
  for (char byte : rows) b = (b + (a = (a + static_cast<std::uint8_t>(byte)) % 65521)) % 65521;
  const std::string zlib = text({0x78, 0x01, 1, 14, 0, 0xF1, 0xFF}) + rows + big(b << 16 | a);
  const std::string file = kPngSignature + chunk("IHDR" + big(2) + big(2) + text({8, 2, 0, 0, 0})) +
                           chunk("IDAT" + zlib) + chunk("IEND");
  EXPECT_EQ(toBytes(decodePicture(file, "png"), Rounding::nearest), kKnown);
  std::string damaged = file;
  damaged[damaged.size() - 25] ^= 1;  // within the pixels
  EXPECT_THROW(decodePicture(damaged, "png"), Error);
}

// --- words stored with a picture -----------------------------------------------------------------------

TEST(CodecMetadata, ComesBack) {
  const test::Folder folder;
  const Metadata words{
      {"Scene", "caf\xC3\xA9 \xE2\x88\x9E.ray"}, {"Settings", "width=400 depth=5: all"}, {"Void", ""}};
  const Picture picture = smoothPicture(17, 5);
  for (const PictureFormat& format : writtenFormats()) {
    SCOPED_TRACE(format.name);
    const std::string path = folder / ("words" + std::string(format.suffixes[0]));
    writePicture(path, picture, Rounding::truncate, words);
    if (format.name == "BMP" || format.name == "TGA" || format.name == "PFM")
      EXPECT_TRUE(readMetadata(path).empty());
    else
      EXPECT_EQ(readMetadata(path), words);
    // and the pixels are those of the picture without words
    EXPECT_EQ(readPicture(path), decodePicture(encodePicture(format, picture), "plain"));
  }
}

TEST(CodecMetadata, AwkwardWordsNeverLoseThePicture) {
  const std::string longText(200'000, 'x');
  const Metadata words{{"", "no key"},
                       {std::string(300, 'k'), "long key"},
                       {" \n\xFF ", "odd key"},
                       {"Lines", "one\ntwo\r\nthree"},
                       {"Zero", std::string("a\0b", 3)},
                       {"Broken", "\xFF\xC3"},
                       {"Long", longText}};
  const Picture picture = smoothPicture(3, 2);
  const test::Folder folder;
  for (const PictureFormat& format : writtenFormats()) {
    SCOPED_TRACE(format.name);
    const std::string path = folder / ("awkward" + std::string(format.suffixes[0]));
    writePicture(path, picture, Rounding::truncate, words);
    EXPECT_EQ(readPicture(path), decodePicture(encodePicture(format, picture), "plain"));
    const Metadata back = readMetadata(path);
    if (!back.empty()) {
      EXPECT_EQ(back.size(), words.size());
      EXPECT_NE(std::find(back.begin(), back.end(), std::pair(std::string("Long"), longText)), back.end());
      EXPECT_NE(std::find(back.begin(), back.end(), std::pair(std::string("Comment"), std::string("no key"))),
                back.end());
    }
  }
}

// --- names and errors ------------------------------------------------------------------------------------

std::string messageOf(const std::function<void()>& act) {
  try {
    act();
  } catch (const Error& e) {
    return e.what();
  }
  return "nothing was thrown";
}

TEST(CodecNames, SuffixInAnyCase) {
  for (const PictureFormat& format : writtenFormats())
    for (std::string_view suffix : format.suffixes) {
      EXPECT_EQ(pictureFormatFor("folder.x/a.b" + std::string(suffix)).name, format.name);
      std::string upper(suffix);
      std::transform(upper.begin(), upper.end(), upper.begin(),
                     [](char c) { return c == '.' ? c : char(c - 32); });
      EXPECT_EQ(pictureFormatFor("A" + upper).name, format.name);
    }
}

TEST(CodecNames, UnknownSuffixNamesAllKnownOnes) {
  const std::string message = messageOf([] { pictureFormatFor("out.pngg"); });
  for (const PictureFormat& format : writtenFormats())
    for (std::string_view suffix : format.suffixes)
      EXPECT_NE(message.find(suffix), std::string::npos) << message;
  EXPECT_NE(message.find("did you mean \".png\"?"), std::string::npos) << message;
  for (const char* path : {"out", "out.", "folder.png/out", "", ".", "C:\\folder.png\\out"})
    EXPECT_THROW(pictureFormatFor(path), Error) << path;
  try {
    pictureFormatFor("out.gif");
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.fault(), Fault::usage);
  }
}

TEST(CodecErrors, UnwritablePathLeavesNothing) {
  const test::Folder folder;
  EXPECT_THROW(writePicture(folder / "no/such/folder/a.png", Picture(1, 1)), Error);
  fs::create_directory(folder / "taken.png");
  EXPECT_THROW(writePicture(folder / "taken.png", Picture(1, 1)), Error);
  EXPECT_EQ(files(folder), 1u);
}

TEST(CodecErrors, SizesThatDoNotFit) {
  for (const PictureFormat& format : writtenFormats()) {
    EXPECT_NO_THROW(checkEncodable(format, 8000, 6000)) << format.name;
    EXPECT_THROW(checkEncodable(format, 0, 5), Error);
    EXPECT_THROW(checkEncodable(format, 5, -1), Error);
    EXPECT_THROW(checkEncodable(format, 2'000'000'000, 2'000'000'000), Error);
    EXPECT_THROW(encodePicture(format, Picture()), Error);
  }
  EXPECT_THROW(checkEncodable(formatNamed("TGA"), 65536, 1), Error);
  EXPECT_THROW(checkEncodable(formatNamed("JPEG"), 1, 65536), Error);
  EXPECT_THROW(checkEncodable(formatNamed("PNG"), 20000, 20000), Error);
}

TEST(CodecErrors, MissingFileAndNoPicture) {
  const test::Folder folder;
  EXPECT_THROW(readPicture(folder / "none.png"), Error);
  EXPECT_THROW(readPicture(folder / ""), Error);
  for (const char* content :
       {"", "P", "P6", "BM", "hello, this is a text and no picture at all", "\xFF\xD8\xFF", "#?RGBE\n"}) {
    writeFile(folder / "bad.png", content);
    const std::string message = messageOf([&] { readPicture(folder / "bad.png"); });
    EXPECT_NE(message.find("bad.png"), std::string::npos) << message;
  }
}

TEST(CodecErrors, AbsurdSizesAreRefusedBeforeAnyMemoryIsTaken) {
  for (const std::string& file :
       {std::string("P6 99999999 99999999 255\n"), std::string("P5 60000 60000 255\nabc"),
        std::string("P6 0 5 255\n"),
        "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 900000 +X 900000\n" + std::string(100, 'a'),
        text({0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 255, 255, 255, 255, 24, 0, 1, 2, 3}),
        kPngSignature + chunk("IHDR" + big(1 << 23) + big(1 << 23) + text({8, 2, 0, 0, 0})) +
            chunk("IDATabc") + chunk("IEND")})
    EXPECT_THROW(decodePicture(file, "absurd"), Error) << file.substr(0, 20);
}

/// Whether the bytes from there on say nothing of the picture: the padding of BMP's last row, JPEG's end
/// marker.
bool saysNothing(const PictureFormat& format, const std::string& whole, size_t length) {
  if (format.name == "JPEG") return length + 2 == whole.size();
  return format.name == "BMP" && length + 1 == whole.size();
}

TEST(CodecErrors, EveryTruncationIsRefused) {
  for (const PictureFormat& format : pictureFormats())
    for (const auto& [width, height] : {std::pair(1, 1), std::pair(17, 5)}) {
      const std::string whole = fileOf(format, noisyPicture(width, height), {{"Key", "some words"}});
      for (size_t length = 0; length < whole.size(); ++length) {
        // a copy of exact length, so that the address sanitizer sees every byte read too far
        const std::string cut(whole, 0, length);
        const std::string what = std::string(format.name) + " " + std::to_string(width) + "x" +
                                 std::to_string(height) + " cut to " + std::to_string(length);
        if (saysNothing(format, whole, length))
          EXPECT_EQ(decodePicture(cut, "cut"), decodePicture(whole, "whole")) << what;
        else
          EXPECT_THROW(decodePicture(cut, "cut"), Error) << what << " of " << whole.size();
      }
    }
}

TEST(CodecErrors, DamagedBytesNeverCrash) {
  std::uint32_t state = 7;
  const auto random = [&] { return (state = state * 1664525u + 1013904223u) >> 8; };
  for (const PictureFormat& format : pictureFormats()) {
    const std::string whole = fileOf(format, noisyPicture(17, 5), {{"Key", "words"}});
    for (int trial = 0; trial < 1500; ++trial) {
      std::string damaged = whole;
      // most changes to the header, where the sizes are
      const size_t reach =
          trial % 3 == 0 ? damaged.size() : std::min<size_t>(damaged.size(), 64 + trial % 300);
      for (std::uint32_t changes = 1 + random() % 4; changes > 0; --changes)
        damaged[random() % reach] = static_cast<char>(random());
      try {
        const Picture picture = decodePicture(damaged, "damaged");
        EXPECT_EQ(picture.pixels.size(), size_t(picture.width) * size_t(picture.height));
        format.metadata(damaged);
      } catch (const std::exception&) {
      }
    }
  }
}

TEST(CodecErrors, KindsThatAreNotReadAreNamed) {
  const std::pair<std::string, const char*> kKinds[] = {
      {text({0xAB, 'K', 'T', 'X', ' ', '2', '0', 0xBB, 13, 10, 26, 10}), "a KTX2 texture"},
      {text({0, 0, 0, 28, 'f', 't', 'y', 'p', 'a', 'v', 'i', 'f'}), "an AVIF picture"},
      {"GIF89a", "a GIF picture"},
      {text({'I', 'I', '*', 0, 8, 0, 0, 0}), "a TIFF picture"},
      {"DDS |", "a DDS texture"}};
  for (const auto& kind : kKinds) {
    const std::string message = messageOf([&] { decodePicture(kind.first, "a.png"); });
    EXPECT_NE(message.find("found " + std::string(kind.second) + ", which is not read"), std::string::npos)
        << message;
  }
}

// --- formats that are only read ----------------------------------------------------------------------------

TEST(CodecReadOnly, WritingIsRefusedBeforeAnythingIsRendered) {
  const std::string message = messageOf([] { pictureFormatFor("out.WebP"); });
  EXPECT_NE(message.find("ends in .png, .bmp"), std::string::npos) << message;
  EXPECT_NE(message.find("WebP pictures are read, not written"), std::string::npos) << message;
  EXPECT_EQ(pictureFormatNamed("out.WebP"), &formatNamed("WebP"));
  EXPECT_EQ(pictureFormatNamed("out.gif"), nullptr);
  EXPECT_THROW(checkEncodable(formatNamed("WebP"), 1, 1), Error);
  EXPECT_THROW(encodePicture(formatNamed("WebP"), Picture(1, 1)), Error);
}

/// Bytes without a pattern; the last of four is not always opaque.
Raster noisyRaster(int width, int height, int channels) {
  Raster raster(width, height, channels, 255);
  std::vector<std::uint8_t> samples;
  std::uint32_t state = 3;
  while (samples.size() < raster.count())
    samples.push_back(static_cast<std::uint8_t>((state = state * 1664525u + 1013904223u) >> 24));
  raster.samples = samples;
  return raster;
}

TEST(CodecWebp, WithoutLossItIsItsPng) {
  for (const int channels : {3, 4}) {
    const Raster raster = noisyRaster(19, 7, channels);
    const Raster webp = decodeRaster(test::webpOf(raster), "a.webp"),
                 png = decodeRaster(encodePng(raster), "a.png");
    EXPECT_EQ(webp.channels, channels);
    EXPECT_EQ(webp.width, png.width);
    EXPECT_EQ(webp.samples, png.samples);
    EXPECT_FALSE(webp.premultiplied);
  }
}

TEST(CodecWebp, WithLossItIsNearAndItsAlphaIsExact) {
  Raster raster(16, 16, 4, 255);
  std::vector<std::uint8_t> samples;
  for (int i = 0; i < 16 * 16; ++i)
    samples.insert(samples.end(), {200, 100, 50, static_cast<std::uint8_t>(255 - i)});
  raster.samples = samples;
  const Raster back = decodeRaster(test::webpOf(raster, false), "a.webp");
  ASSERT_EQ(back.channels, 4);
  const auto& found = std::get<std::vector<std::uint8_t>>(back.samples);
  ASSERT_EQ(found.size(), samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i)
    if (i % 4 == 3)
      EXPECT_EQ(found[i], samples[i]) << i;
    else
      EXPECT_NEAR(found[i], samples[i], 4) << i;
}

TEST(CodecWebp, OfAnAnimationTheFirstPictureIsShownOnItsCanvas) {
  const Raster first = noisyRaster(3, 2, 4), second = noisyRaster(9, 9, 4);
  const std::string file =
      test::webpAnimation(9, 9, test::webpFrame(4, 6, first) + test::webpFrame(0, 0, second));
  const Raster canvas = decodeRaster(file, "a.webp");
  ASSERT_EQ(canvas.width, 9);
  ASSERT_EQ(canvas.height, 9);
  ASSERT_EQ(canvas.channels, 4);
  const auto& samples = std::get<std::vector<std::uint8_t>>(canvas.samples);
  const auto& inside = std::get<std::vector<std::uint8_t>>(first.samples);
  for (std::size_t y = 0; y < 9; ++y)
    for (std::size_t x = 0; x < 9; ++x)
      for (std::size_t c = 0; c < 4; ++c) {
        const bool isInside = x >= 4 && x < 7 && y >= 6 && y < 8;
        EXPECT_EQ(samples[4 * (9 * y + x) + c], isInside ? inside[4 * (3 * (y - 6) + x - 4) + c] : 0)
            << x << " " << y;
      }
  EXPECT_EQ(pictureRemark(file, "a"), "of an animation the first picture is shown");
  for (std::size_t length = 0; length < file.size(); ++length)
    EXPECT_THROW(decodeRaster(file.substr(0, length), "cut"), Error) << length;
}

TEST(CodecWebp, FramesThatLeaveTheirCanvasAreRefused) {
  const Raster frame = noisyRaster(5, 5, 4);
  for (const auto& [x, y] : {std::pair(6, 0), std::pair(0, 6), std::pair(4, 4)}) {
    const std::string file = test::webpAnimation(9, 9, test::webpFrame(x, y, frame));
    EXPECT_EQ(messageOf([&] { decodeRaster(file, "a"); }) == "nothing was thrown", x == 4) << x;
  }
  // The picture in the frame is larger than the frame says.
  std::string lies = test::webpAnimation(9, 9, test::webpFrame(4, 4, noisyRaster(9, 9, 4)));
  const std::size_t size = lies.find("ANMF") + 8 + 6;
  lies[size] = lies[size + 3] = 4;
  EXPECT_THROW(decodeRaster(lies, "a"), Error);
}

TEST(CodecWebp, APictureOfOneColourIsSmallAtAnySize) {
  Raster plain(6000, 6000, 3, 255);
  plain.samples = std::vector<std::uint8_t>(plain.count(), 77);
  const std::string file = test::webpOf(plain);
  EXPECT_LT(file.size(), 100u);
  const Raster back = decodeRaster(file, "a.webp");
  EXPECT_EQ(back.samples, plain.samples);
}

// --- limits ------------------------------------------------------------------------------------------------

constexpr int kMostWebpSide = 1 << 14;

/// The file of a 17 x 5 picture with another size in its header, checksums as they should be. Sides of WebP
/// are at most 2^14.
std::string claiming(const PictureFormat& format, std::string file, int width, int height) {
  const auto put = [&](std::size_t at, std::initializer_list<int> bytes) {
    for (int byte : bytes) file.at(at++) = static_cast<char>(byte);
  };
  const auto little = [&](std::size_t at, int n) {
    put(at, {n & 255, n >> 8 & 255, n >> 16 & 255, n >> 24 & 255});
  };
  const auto swap = [&](const std::string& from, const std::string& to) {
    const std::size_t at = file.find(from);
    if (at == std::string::npos) throw std::runtime_error("no size in this file");
    file.replace(at, from.size(), to);
  };
  const auto sizes = [](int w, int h) { return std::to_string(w) + " " + std::to_string(h) + "\n"; };
  if (format.name == "PNG") {
    file.replace(8, 25,
                 chunk("IHDR" + big(std::uint32_t(width)) + big(std::uint32_t(height)) + file.substr(24, 5)));
  } else if (format.name == "BMP") {
    little(18, width), little(22, height);
  } else if (format.name == "PPM" || format.name == "PFM") {
    swap(sizes(17, 5), sizes(width, height));
  } else if (format.name == "JPEG") {
    const std::size_t at = file.find(text({0xFF, 0xC0}));
    put(at + 5, {height >> 8 & 255, height & 255, width >> 8 & 255, width & 255});
  } else if (format.name == "HDR") {
    swap("-Y 5 +X 17\n", "-Y " + std::to_string(height) + " +X " + std::to_string(width) + "\n");
  } else if (format.name == "EXR") {
    const std::size_t at = file.find("dataWindow") + std::string("dataWindow.box2i.....").size();
    little(at + 8, width - 1);
    little(at + 12, height - 1);
  } else if (format.name == "TGA") {
    put(12, {width & 255, width >> 8 & 255, height & 255, height >> 8 & 255});
  } else if (format.name == "WebP") {  // lossless: 14 bits of each side less 1
    little(21, (std::min(width, kMostWebpSide) - 1) | (std::min(height, kMostWebpSide) - 1) << 14);
  } else {
    ADD_FAILURE() << "a new format: say where its size stands";
  }
  return file;
}

/// The fault of reading; nothing if it was a picture.
std::optional<Fault> faultOf(const std::string& file, const PictureLimits& limits = {}) {
  try {
    decodePicture(file, "file", limits);
    return {};
  } catch (const Error& error) {
    return error.fault();
  }
}

TEST(CodecLimits, EnlargedSizesAreRefused) {
  constexpr int kSides[][2] = {{170, 50}, {17, 50}, {170, 5}, {1700, 900}, {9000, 9000}, {60000, 60000}};
  for (const PictureFormat& format : pictureFormats()) {
    const std::string file = fileOf(format, noisyPicture(17, 5));
    EXPECT_FALSE(faultOf(claiming(format, file, 17, 5)))
        << format.name << ": the size is not where it is looked for";
    for (const auto& [width, height] : kSides) {
      // Where a JPEG file ends early, its readers agree on grey: only what no file can hold is refused.
      if (format.name == "JPEG" && width < 9000) continue;
      EXPECT_TRUE(faultOf(claiming(format, file, width, height)))
          << format.name << " " << width << " x " << height;
    }
  }
}

TEST(CodecLimits, MemoryIsAskedOfTheHeader) {
  for (const PictureFormat& format : pictureFormats()) {
    const std::string file = fileOf(format, noisyPicture(100, 100));
    EXPECT_EQ(faultOf(file, {.memory = 100 << 10}), Fault::limit) << format.name;
    EXPECT_EQ(faultOf(file, {.memory = 1 << 20}), std::nullopt) << format.name;
  }
}

/// A PNG of one bit a pixel, all black, as small as it gets.
std::string blackPng(std::uint32_t side) {
  const std::string rows(std::size_t{side} * (1 + side / 8), '\0');
  std::string packed(compressBound(rows.size()), '\0');
  uLongf length = packed.size();
  compress2(reinterpret_cast<Bytef*>(packed.data()), &length, reinterpret_cast<const Bytef*>(rows.data()),
            rows.size(), 9);
  return kPngSignature + chunk("IHDR" + big(side) + big(side) + text({1, 0, 0, 0, 0})) +
         chunk("IDAT" + packed.substr(0, length)) + chunk("IEND");
}

TEST(CodecLimits, TheSizeAndTheLimitAreSaid) {
  constexpr int kSide = 20'001;
  const std::size_t bytes = std::size_t{kSide} * kSide / 1000;  // so many that the size may be true
  for (const PictureFormat& format : pictureFormats()) {
    std::string file = claiming(format, fileOf(format, noisyPicture(17, 5)), kSide, kSide);
    file.append(bytes, format.name == "PPM" ? ' ' : '\0');
    try {
      decodePicture(file, "file");
      ADD_FAILURE() << format.name;
    } catch (const Error& error) {
      const std::string what = error.messages().front().what;
      const char* const size = format.name == "WebP" ? "16384x16384 pixels" : "20001x20001 pixels";
      EXPECT_NE(what.find(size), what.npos) << format.name << ": " << what;
      EXPECT_TRUE(what.find("allowed are 4096") != what.npos || what.find("not believable") != what.npos)
          << format.name << ": " << what;
      if (format.name == "PNG") {
        EXPECT_EQ(error.fault(), Fault::limit) << what;
      }
    }
  }
}

TEST(CodecLimits, ALittleFileOfAnImmensePictureIsRefused) {
  const std::string file = blackPng(16384);
  EXPECT_LT(file.size(), 40'000u);
  EXPECT_EQ(faultOf(file), Fault::io);
  EXPECT_EQ(faultOf(blackPng(2048)), std::nullopt);
}

// A picture of one colour packs best of all.
TEST(CodecLimits, LargePicturesOfOneColourAreRead) {
  Picture plain(3000, 2000);
  std::fill(plain.pixels.begin(), plain.pixels.end(), Color(0.5, 0.25, 1));
  for (const PictureFormat& format : pictureFormats())
    EXPECT_EQ(faultOf(fileOf(format, plain)), std::nullopt) << format.name;
}

TEST(CodecLimits, AttributesLongerThanTheFileTakeNoMemory) {
  const PictureFormat& format = formatNamed("EXR");
  std::string file = encodePicture(format, noisyPicture(17, 5), Rounding::truncate, {{"Key", "words"}});
  const std::string before = std::string("trace:Key") + '\0' + "string" + '\0';
  const std::size_t at = file.find(before) + before.size();
  for (const std::string& length :
       {text({255, 255, 255, 0x7F}), text({255, 255, 255, 255}), text({0, 0, 0, 0x40})}) {
    file.replace(at, 4, length);
    EXPECT_EQ(faultOf(file), Fault::io);
    EXPECT_THROW(format.metadata(file), std::exception);
  }
}

TEST(CodecCorpus, SoundFilesAreReadAndBrokenOnesRefused) {
  int sound = 0, broken = 0;
  for (const auto& entry : fs::directory_iterator(test::sourceFolder() + "/tests/corpus/pictures")) {
    const bool isBroken = entry.path().filename().string().starts_with("broken_");
    const std::string file = readFile(entry.path().string());
    EXPECT_EQ(faultOf(file).has_value(), isBroken) << entry.path();
    ++(isBroken ? broken : sound);
  }
  EXPECT_GE(sound, static_cast<int>(pictureFormats().size()));
  EXPECT_GE(broken, static_cast<int>(pictureFormats().size()));
}

// What a decoder does not write must not be taken for pixels: with other memory underneath, other pixels.
TEST(CodecErrors, DamagedFilesNeverShowMemory) {
#if defined(__GLIBC__)
  std::uint32_t state = 11;
  const auto random = [&] { return (state = state * 1664525u + 1013904223u) >> 8; };
  const auto read = [](const std::string& file, int fill) {
    mallopt(M_PERTURB, fill);
    std::optional<std::vector<double>> values;
    try {
      values.emplace();
      for (const Color& c : decodePicture(file, "damaged").pixels)
        for (double channel : {c.r, c.g, c.b}) values->push_back(std::isnan(channel) ? -1 : channel);
    } catch (const Error&) {
      values.reset();
    }
    mallopt(M_PERTURB, 0);
    return values;
  };
  for (const PictureFormat& format : pictureFormats()) {
    const std::string whole = fileOf(format, noisyPicture(17, 40));
    for (int trial = 0; trial < 400; ++trial) {
      std::string damaged = whole;
      const std::size_t reach = trial % 2 == 0 ? damaged.size() : std::min<std::size_t>(damaged.size(), 420);
      for (std::uint32_t changes = 1 + random() % 3; changes > 0; --changes)
        damaged[random() % reach] = static_cast<char>(random());
      if (format.name == "EXR" && trial < 60)
        damaged = claiming(format, whole, 17 + trial % 20, 40 + trial % 3);
      EXPECT_EQ(read(damaged, 1), read(damaged, 0xA5)) << format.name << " " << trial;
    }
  }
#else
  GTEST_SKIP() << "memory cannot be filled here";
#endif
}

TEST(Codec, JpegsOfLessQualityAreSmallerAndCoarser) {
  Picture picture(64, 64);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) picture.at(x, y) = Color(x / 64.0, y / 64.0, (x * y) % 7 / 7.0);
  const PictureFormat& jpeg = pictureFormatFor(".jpg");
  const std::string fine = encodePicture(jpeg, picture, {Rounding::nearest, 100}),
                    usual = encodePicture(jpeg, picture, Rounding::nearest),
                    coarse = encodePicture(jpeg, picture, {Rounding::nearest, 20});
  EXPECT_LT(usual.size(), fine.size());
  EXPECT_LT(coarse.size(), usual.size() / 2);
  const auto error = [&](const std::string& file) {
    const Picture read = decodePicture(file, "test.jpg");
    double sum = 0;
    for (std::size_t i = 0; i < read.pixels.size(); ++i)
      sum += std::abs(read.pixels[i].g - picture.pixels[i].g);
    return sum;
  };
  EXPECT_LT(error(fine), error(usual));
  EXPECT_LT(error(usual), error(coarse));
}

}  // namespace
}  // namespace trace
