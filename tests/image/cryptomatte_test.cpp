// Mattes by name. The hashes are those that the specification of Cryptomatte and MurmurHash3's own test give.
#include "image/cryptomatte.h"

#include <gtest/gtest.h>

#include <bit>

#include "image/codecs/codec.h"

namespace trace {
namespace {

TEST(Cryptomatte, HashesAsMurmurHash3) {
  EXPECT_EQ(murmurHash3(""), 0u);
  EXPECT_EQ(murmurHash3("hello"), 0x248bfa47u);
  EXPECT_EQ(murmurHash3("hello, world"), 0x149bbb7fu);
  EXPECT_EQ(murmurHash3("The quick brown fox jumps over the lazy dog"), 0x2e4ff723u);
}

TEST(Cryptomatte, IdsAreFiniteNumbers) {
  for (int i = 0; i < 100000; ++i) {
    const std::uint32_t id = cryptomatteId("object" + std::to_string(i));
    const std::uint32_t exponent = id >> 23 & 255;
    ASSERT_TRUE(exponent != 0 && exponent != 255) << i;
  }
}

TEST(Cryptomatte, GivesNamesOfOneIdTwo) {
  const std::string names[] = {"a", "b", "a", "a"};
  const std::vector<std::string> own = cryptomatteNames(names);
  EXPECT_EQ(own, (std::vector<std::string>{"a", "b", "a_2", "a_3"}));
}

TEST(Cryptomatte, StoresRanksAndTheManifest) {
  ExrFile file{2, 1, {0, 0, 2, 1}};
  const std::string names[] = {"ball", "say \"hi\"\n"};
  addCryptomatte(file, "CryptoObject", names, {{{2, 0.75}, {1, 0.25}}, {}});
  ASSERT_EQ(file.channels.size(), 12u);
  EXPECT_EQ(file.channels[0].name, "CryptoObject00.R");
  EXPECT_EQ(std::bit_cast<std::uint32_t>(file.channels[0].values[0]), cryptomatteId("say \"hi\"\n"));
  EXPECT_EQ(file.channels[1].name, "CryptoObject00.G");
  EXPECT_EQ(file.channels[1].values[0], 0.75f);
  EXPECT_EQ(file.channels[2].name, "CryptoObject00.B");
  EXPECT_EQ(std::bit_cast<std::uint32_t>(file.channels[2].values[0]), cryptomatteId("ball"));
  EXPECT_EQ(file.channels[3].name, "CryptoObject00.A");
  EXPECT_EQ(file.channels[3].values[0], 0.25f);
  EXPECT_EQ(file.channels[11].name, "CryptoObject02.A");
  for (const ExrChannel& channel : file.channels) EXPECT_EQ(channel.values[1], 0) << channel.name;
  bool found = false;
  for (const auto& [key, text] : file.attributes)
    if (key.ends_with("/manifest")) {
      found = true;
      EXPECT_EQ(text.rfind("{\"ball\":\"", 0), 0u) << text;
      EXPECT_NE(text.find("say \\\"hi\\\"\\u000a"), std::string::npos) << text;
    }
  EXPECT_TRUE(found);
}

TEST(ExrFile, KeepsADataWindowThatReadersSeeInItsPlace) {
  ExrFile file{5, 4, {1, 2, 3, 4}};
  const std::string names[] = {"R", "G", "B"};
  Picture picture(5, 4);
  for (std::size_t i = 0; i < picture.pixels.size(); ++i)
    picture.pixels[i] = Color(static_cast<double>(i + 1), 2, 3);
  addChannels(file, picture, names);
  const Picture back = decodePicture(encodeExr(file), "window.exr");
  ASSERT_EQ(back.width, 5);
  ASSERT_EQ(back.height, 4);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 5; ++x)
      EXPECT_EQ(back.at(x, y), x >= 1 && x < 3 && y >= 2 ? picture.at(x, y) : Color(0)) << x << " " << y;
}

}  // namespace
}  // namespace trace
