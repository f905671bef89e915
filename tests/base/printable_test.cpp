#include "base/printable.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace trace {
namespace {

TEST(Printable, KeepsLetters) {
  for (const char* text : {"", "a b.png", "é ß 日本 😀", "\\n"}) {
    EXPECT_EQ(printable(text), text);
    EXPECT_EQ(printableInPlace(text), text);
  }
}

TEST(Printable, EscapesWhatATerminalObeys) {
  EXPECT_EQ(printable("a\033[31mb\n"), "a\\u001b[31mb\\u000a");
  EXPECT_EQ(printable(std::string_view("\0\x7f", 2)), "\\u0000\\u007f");
  EXPECT_EQ(printable("\u009b2J\u202e"), "\\u009b2J\\u202e");
  EXPECT_EQ(printable("\x9b\xe9t\xc3"), "\\x9b\\xe9t\\xc3");  // Latin-1, and a letter cut off
  EXPECT_EQ(printable("\xc0\x80\xed\xa0\x80"),
            "\\xc0\\x80\\xed\\xa0\\x80");  // too long, and a half of a pair
  EXPECT_EQ(printable("a\nb\tc\r", LineEnds::kept), "a\nb\tc\\u000d");
  EXPECT_EQ(printableInPlace("\033[m\u009b\xff"), "?[m???");
}

TEST(Printable, MessagesAre) {
  const Error error(Fault::io, SourcePlace{"a\033b.ray", 1, 1, "x\x9by\n"}, "found \"c\nd\"", "try \"\a\"");
  EXPECT_STREQ(error.what(),
               "a\\u001bb.ray:1:1: error: found \"c\\u000ad\"\n  x?y?\n  ^\n  hint: try \"\\u0007\"\n");
}

}  // namespace
}  // namespace trace
