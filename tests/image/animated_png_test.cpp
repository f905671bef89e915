// Short films as animated PNG files.
#include "image/codecs/animated_png.h"

#include <gtest/gtest.h>

#include "image/codecs/codec.h"
#include "image/codecs/codec_parts.h"

namespace trace::test {
namespace {

Bytes grey(std::uint8_t level) { return {3, 2, std::vector<std::uint8_t>(18, level)}; }

TEST(AnimatedPng, IsAPngWhosePictureIsTheFirst) {
  AnimatedPng film;
  film.add(grey(40), 0.5);
  film.add(grey(200), 2);
  film.add(grey(120), 1e9);
  const std::string file = film.finish();
  EXPECT_EQ(toBytes(decodePicture(file, "film.png"), Rounding::nearest), grey(40));
  EXPECT_NE(pictureRemark(file, "film.png").find("animation"), std::string::npos);
}

TEST(AnimatedPng, NumbersItsChunksInTheirOrder) {
  AnimatedPng film;
  for (const std::uint8_t level : {10, 20, 30}) film.add(grey(level), 0.25);
  std::string types;
  std::vector<int> numbers;
  forEachPngChunk(film.finish(), [&](std::string_view type, std::string_view data) {
    types += std::string(type) + " ";
    if (type == "fcTL" || type == "fdAT") numbers.push_back(static_cast<unsigned char>(data[3]));
    if (type == "fcTL") {
      EXPECT_EQ(static_cast<unsigned char>(data[21]), 25) << "hundredths of a second";
    }
  });
  EXPECT_EQ(types, "IHDR acTL fcTL IDAT fcTL fdAT fcTL fdAT IEND ");
  EXPECT_EQ(numbers, (std::vector<int>{0, 1, 2, 3, 4}));
}

TEST(AnimatedPng, StoresOfEachPictureWhatChanged) {
  AnimatedPng film;
  Bytes picture = grey(10);
  film.add(picture, 1);
  picture.rgb[3 * 4] = 99;  // x = 1, y = 1
  picture.rgb[3 * 5 + 2] = 98;
  film.add(picture, 1);
  film.add(picture, 1);
  std::vector<std::vector<int>> parts;  // width, height, x, y
  forEachPngChunk(film.finish(), [&](std::string_view type, std::string_view data) {
    if (type != "fcTL") return;
    parts.emplace_back();
    for (const std::size_t at : {7, 11, 15, 19}) parts.back().push_back(static_cast<unsigned char>(data[at]));
  });
  EXPECT_EQ(parts, (std::vector<std::vector<int>>{{3, 2, 0, 0}, {2, 1, 1, 1}, {1, 1, 0, 0}}));
}

}  // namespace
}  // namespace trace::test
