#include "base/base64.h"

#include <gtest/gtest.h>

namespace trace {
namespace {

TEST(Base64, TheVectorsOfRfc4648) {
  EXPECT_EQ(toBase64(""), "");
  EXPECT_EQ(toBase64("f"), "Zg==");
  EXPECT_EQ(toBase64("fo"), "Zm8=");
  EXPECT_EQ(toBase64("foo"), "Zm9v");
  EXPECT_EQ(toBase64("foob"), "Zm9vYg==");
  EXPECT_EQ(toBase64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(toBase64("foobar"), "Zm9vYmFy");
}

TEST(Base64, BytesAboveSeven) { EXPECT_EQ(toBase64(std::string("\xff\xfe\x00", 3)), "//4A"); }

}  // namespace
}  // namespace trace
