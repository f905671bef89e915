// Parts of picture formats that programs write now and then: a picture of two by two, red, green, blue and
// white from the top left, in each of them.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/error.h"
#include "base/files/file.h"
#include "image/codecs/codec.h"
#include "image/codecs/orientation.h"
#include "support/paths.h"

namespace trace::picture_kinds_test {
namespace {

const Color kRed{1, 0, 0}, kGreen{0, 1, 0}, kBlue{0, 0, 1}, kWhite{1, 1, 1};

void expectQuad(const std::string& bytes, const std::string& what) {
  Picture picture;
  ASSERT_NO_THROW(picture = decodePicture(bytes, what)) << what;
  ASSERT_EQ(picture.width, 2) << what;
  ASSERT_EQ(picture.height, 2) << what;
  EXPECT_EQ(picture.pixels, (std::vector<Color>{kRed, kGreen, kBlue, kWhite})) << what;
}

template <std::size_t N>
std::string raw(const char (&text)[N]) {
  return std::string(text, N - 1);
}

// --- HDR ---------------------------------------------------------------------------------------------------

const std::string kRgbe[] = {raw("\x80\0\0\x81"), raw("\0\x80\0\x81"), raw("\0\0\x80\x81"),
                             raw("\x80\x80\x80\x81")};

std::string hdr(const std::string& lines, const std::string& size, const std::string& pixels) {
  return "#?RADIANCE\n" + lines + "FORMAT=32-bit_rle_rgbe\n\n" + size + "\n" + pixels;
}

TEST(Hdr, AllOrientations) {
  const struct {
    const char* size;
    int order[4];  // of the pixels red, green, blue, white
  } cases[] = {{"-Y 2 +X 2", {0, 1, 2, 3}}, {"-Y 2 -X 2", {1, 0, 3, 2}}, {"+Y 2 +X 2", {2, 3, 0, 1}},
               {"+Y 2 -X 2", {3, 2, 1, 0}}, {"+X 2 -Y 2", {0, 2, 1, 3}}, {"-X 2 -Y 2", {1, 3, 0, 2}},
               {"+X 2 +Y 2", {2, 0, 3, 1}}, {"-X 2 +Y 2", {3, 1, 2, 0}}};
  for (const auto& c : cases) {
    std::string pixels;
    for (int i : c.order) pixels += kRgbe[i];
    expectQuad(hdr("", c.size, pixels), c.size);
  }
}

TEST(Hdr, RowsAndColumnsOfDifferentNumber) {
  const Picture picture = decodePicture(hdr("", "+X 3 -Y 1", kRgbe[0] + kRgbe[1] + kRgbe[2]), "a");
  EXPECT_EQ(picture.width, 3);
  EXPECT_EQ(picture.height, 1);
  EXPECT_EQ(picture.at(1, 0), kGreen);
}

TEST(Hdr, OldRunLengthCode) {
  const std::string run3 = raw("\1\1\1\3"), run256 = raw("\1\1\1\0") + raw("\1\1\1\1");
  const Picture picture = decodePicture(hdr("", "-Y 1 +X 261", kRgbe[0] + run3 + kRgbe[1] + run256), "a");
  EXPECT_EQ(picture.at(3, 0), kRed);
  EXPECT_EQ(picture.at(4, 0), kGreen);
  EXPECT_EQ(picture.at(260, 0), kGreen);
  EXPECT_THROW(decodePicture(hdr("", "-Y 1 +X 3", kRgbe[0] + run3), "a"), Error) << "beyond the row";
}

TEST(Hdr, ExposureAndColoursAreTakenBack) {
  const std::string pixels = kRgbe[3];
  EXPECT_EQ(decodePicture(hdr("EXPOSURE=2\nEXPOSURE= 4\n", "-Y 1 +X 1", pixels), "a").at(0, 0),
            Color(1.0 / 8));
  EXPECT_EQ(decodePicture(hdr("COLORCORR= 1 2 4\n", "-Y 1 +X 1", pixels), "a").at(0, 0), Color(1, 0.5, 0.25));
  std::string xyz = hdr("", "-Y 1 +X 1", raw("\x7a\x80\x8b\x80"));  // about D65, whose Y is 1
  xyz.replace(xyz.find("rgbe"), 4, "xyze");
  const Color white = decodePicture(xyz, "a").at(0, 0);
  EXPECT_NEAR(white.r, white.g, 0.02);
  EXPECT_NEAR(white.b, white.g, 0.02);
  EXPECT_EQ(pictureRemark(hdr("", "-Y 1 +X 1", pixels), "a"), "");
  EXPECT_NE(pictureRemark(hdr("PRIMARIES=0.6 0.3 0.3 0.6 0.1 0.1 0.3 0.3\n", "-Y 1 +X 1", pixels), "a"), "");
}

// --- BMP ---------------------------------------------------------------------------------------------------

std::string little(std::uint32_t value, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> 8 * i);
  return text;
}

/// A file of that head, whose rest after width, height, planes, bits, compression is zeros.
std::string bmp(std::uint32_t headSize, int width, int height, int bits, std::uint32_t compression,
                const std::string& between, const std::string& pixels, std::string head = {}) {
  if (head.empty()) {
    const int side = headSize == 12 ? 2 : 4;
    head = little(headSize, 4) + little(static_cast<std::uint32_t>(width), side) +
           little(static_cast<std::uint32_t>(height), side) + little(1, 2) +
           little(static_cast<std::uint32_t>(bits), 2);
    if (headSize > 16) head += little(compression, 4);
    head.resize(headSize, '\0');
  }
  const auto start = static_cast<std::uint32_t>(14 + head.size() + between.size());
  return "BM" + little(start + static_cast<std::uint32_t>(pixels.size()), 4) + little(0, 4) +
         little(start, 4) + head + between + pixels;
}

const std::string kPalette4 = raw("\0\0\xff\0\0\xff\0\0\xff\0\0\0\xff\xff\xff\0");  // red, green, blue, white
const std::string kPalette3 = raw("\0\0\xff\0\xff\0\xff\0\0\xff\xff\xff");

TEST(Bmp, EveryHead) {
  const std::string rows = raw("\2\3\0\0\0\1\0\0");  // from below
  std::string palette12 = kPalette3;
  palette12.resize(3 * 256, '\0');
  expectQuad(bmp(12, 2, 2, 8, 0, palette12, rows), "12");
  std::string palette = kPalette4;
  palette.resize(4 * 256, '\0');
  for (std::uint32_t head : {16u, 40u, 52u, 56u, 64u, 108u, 124u})
    expectQuad(bmp(head, 2, 2, 8, 0, palette, rows), std::to_string(head));
  expectQuad(bmp(40, 2, -2, 8, 0, palette, raw("\0\1\0\0\2\3\0\0")), "from above");
  expectQuad(bmp(40, 2, 2, 4, 0, palette.substr(0, 64), raw("\x23\0\0\0\x01\0\0\0")), "4 bits");
  expectQuad(bmp(40, 2, 2, 24, 0, "", raw("\xff\0\0\xff\xff\xff\0\0\0\0\xff\0\xff\0\0\0")), "24 bits");
  expectQuad(bmp(40, 2, 2, 16, 0, "", raw("\x1f\0\xff\x7f\0\x7c\xe0\x03")), "16 bits");
  const std::string masks = raw("\xff\0\0\0\0\xff\0\0\0\0\xff\0");  // red is the lowest byte
  expectQuad(bmp(40, 2, 2, 32, 3, masks, raw("\0\0\xff\0\xff\xff\xff\0\xff\0\0\0\0\xff\0\0")), "masks");
}

TEST(Bmp, RunLengthCodes) {
  std::string palette = kPalette4;
  palette.resize(4 * 256, '\0');
  expectQuad(bmp(40, 2, 2, 8, 1, palette, raw("\1\2\1\3\0\0\1\0\1\1\0\1")), "RLE8");
  expectQuad(bmp(40, 2, 2, 8, 1, palette, raw("\1\2\1\3\0\0\1\0\0\2\0\0\1\1\0\1")),
             "RLE8 with a step of nothing");
  expectQuad(bmp(40, 2, 2, 4, 2, palette.substr(0, 64), raw("\2\x23\0\0\2\x01\0\1")), "RLE4");
  const Picture three =
      decodePicture(bmp(40, 4, 1, 8, 1, palette, raw("\0\3\0\1\2\0\1\3\0\1")), "values as they are");
  EXPECT_EQ(three.pixels, (std::vector<Color>{kRed, kGreen, kBlue, kWhite}));
  EXPECT_THROW(decodePicture(bmp(40, 2, 2, 8, 1, palette, raw("\1\2")), "cut"), Error);
}

// --- TGA, JPEG ---------------------------------------------------------------------------------------------

TEST(Tga, AllOrigins) {
  const std::string colors[] = {raw("\0\0\xff"), raw("\0\xff\0"), raw("\xff\0\0"), raw("\xff\xff\xff")};
  const struct {
    char descriptor;
    int order[4];
  } cases[] = {{0x20, {0, 1, 2, 3}}, {0x30, {1, 0, 3, 2}}, {0, {2, 3, 0, 1}}, {0x10, {3, 2, 1, 0}}};
  for (const auto& c : cases) {
    std::string file = raw("\0\0\2\0\0\0\0\0\0\0\0\0\2\0\2\0\x18");
    file += c.descriptor;
    for (int i : c.order) file += colors[i];
    expectQuad(file, "descriptor " + std::to_string(c.descriptor));
  }
}

TEST(Jpeg, WithoutItsEndMarkerAndCut) {
  const std::string whole = readFile(test::sourceFolder() + "/tests/corpus/pictures/sphere.jpg");
  const Picture picture = decodePicture(whole, "whole");
  const std::string noEnd = whole.substr(0, whole.rfind("\xff\xd9"));
  EXPECT_EQ(decodePicture(noEnd, "no end"), picture);
  EXPECT_EQ(pictureRemark(whole, "a"), "");
  EXPECT_NE(pictureRemark(noEnd, "a"), "");
  EXPECT_THROW(decodePicture(whole.substr(0, whole.size() * 2 / 3), "cut"), Error);
}

TEST(Jpeg, IsTurnedAsExifSays) {
  const std::string whole = readFile(test::sourceFolder() + "/tests/corpus/pictures/sphere.jpg");
  const Raster plain = decodeRaster(whole, "plain");
  for (int number = 1; number <= 8; ++number) {
    // One entry: orientation, a short.
    std::string tiff = raw("MM\0\x2a\0\0\0\x08\0\1\x01\x12\0\3\0\0\0\1\0") + static_cast<char>(number);
    tiff += raw("\0\0\0\0\0\0");
    const std::string body = raw("Exif\0\0") + tiff;
    const std::size_t length = body.size() + 2;
    const std::string segment =
        std::string("\xff\xe1") + static_cast<char>(length >> 8) + static_cast<char>(length) + body;
    const Raster turned = decodeRaster(whole.substr(0, 2) + segment + whole.substr(2), "turned");
    const Raster expected = oriented(plain, static_cast<Orientation>(number));
    EXPECT_EQ(turned.width, expected.width) << number;
    EXPECT_EQ(turned.samples, expected.samples) << number;
  }
}

TEST(Oriented, ATurnOfARow) {
  Raster row(2, 1, 1, 255);
  row.samples = std::vector<std::uint8_t>{1, 2};
  const auto samples = [&](Orientation o) {
    return std::get<std::vector<std::uint8_t>>(oriented(row, o).samples);
  };
  using Bytes8 = std::vector<std::uint8_t>;
  EXPECT_EQ(samples(Orientation::mirrored), (Bytes8{2, 1}));
  EXPECT_EQ(samples(Orientation::right), (Bytes8{1, 2}));
  EXPECT_EQ(oriented(row, Orientation::right).height, 2);
  EXPECT_EQ(samples(Orientation::left), (Bytes8{2, 1}));
}

}  // namespace
}  // namespace trace::picture_kinds_test
