#include "base/text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

namespace trace {
namespace {

TEST(ParseNumber, TakesWhatScenesContain) {
  for (auto [text, value, length] : {std::tuple{"0.25", 0.25, 4u},
                                     {"-3", -3.0, 2u},
                                     {"4.5492e-05", 4.5492e-05, 10u},
                                     {".5", 0.5, 2u},
                                     {"7.", 7.0, 2u},
                                     {"+1.5)", 1.5, 4u},
                                     {"1E3,", 1000.0, 3u},
                                     {"-.2e1 ", -2.0, 5u},
                                     {"12abc", 12.0, 2u}}) {
    const auto number = parseNumber(text);
    ASSERT_TRUE(number) << text;
    EXPECT_EQ(number->value, value);
    EXPECT_EQ(number->length, length);
  }
  for (const char* text : {"", "abc", "-", ".", "+-1", " 1", "e5"}) EXPECT_FALSE(parseNumber(text)) << text;
  EXPECT_TRUE(std::isinf(parseNumber("1e999")->value));
  EXPECT_EQ(parseNumber("1e-999")->value, 0);
}

TEST(ParseNumber, RoundsAsTheLibraryDoes) {
  for (const char* text : {"0.1", "-0", "5.", ".5", "-.125", "9007199254740993", "123456789012345",
                           "0.00000000000001", "1234567.12345678", "12345678.12345678",
                           "000000000000000000.5", "0.30000000000000004", "1.2.3", "3-4", "007"}) {
    char* end = nullptr;
    const double value = std::strtod(text, &end);
    const auto number = parseNumber(text);
    ASSERT_TRUE(number) << text;
    EXPECT_EQ(number->value, value) << text;
    EXPECT_EQ(std::signbit(number->value), std::signbit(value)) << text;
    EXPECT_EQ(number->length, static_cast<size_t>(end - text)) << text;
  }
  std::uint64_t state = 1;
  for (int i = 0; i < 100000; ++i) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    std::string digits = std::to_string(state >> (state % 60));
    digits.insert((state >> 32) % (digits.size() + 1), ".");
    EXPECT_EQ(parseNumber(digits)->value, std::strtod(digits.c_str(), nullptr)) << digits;
  }
}

TEST(ToText, IsShortAndExact) {
  EXPECT_EQ(toText(0.1), "0.1");
  EXPECT_EQ(toText(400), "400");
  for (double x : {1 / 3.0, 1e300, 53.13010235415598}) EXPECT_EQ(parseNumber(toText(x))->value, x);
}

TEST(DidYouMean, NearWordsOnly) {
  const std::string_view words[] = {"diffuse", "specular", "shininess"};
  EXPECT_EQ(nearest("difuse", words), "diffuse");
  EXPECT_EQ(nearest("shinyness", words), "shininess");
  EXPECT_EQ(nearest("camera", words), "");
  constexpr std::array<std::string_view, 3> flags{"--set", "--seed", "--send"};
  EXPECT_EQ(nearest("--sed", flags), "--seed") << "a letter that is missing is likelier than a wrong one";
  EXPECT_EQ(nearest("--det", flags), "--set");
  EXPECT_EQ(didYouMean("speculr", words), "did you mean \"specular\"?");
  EXPECT_EQ(nearest(std::string(100000, 'x'), words), "");
}

TEST(PlaceAt, CountsLinesAndColumns) {
  const std::string_view source = "one\r\ntwo three\nfour";
  const SourcePlace place = placeAt("f.ray", source, 9);
  EXPECT_EQ(place.line, 2);
  EXPECT_EQ(place.column, 5);
  EXPECT_EQ(place.text, "two three");
  EXPECT_EQ(placeAt("f.ray", source, 0).text, "one");
  EXPECT_EQ(placeAt("f.ray", source, 999).line, 3);
}

TEST(Message, ShowsTheLineWithACaret) {
  const Message message{
      Message::Severity::error, {"a.ray", 3, 5, "  x y"}, "expected a number, found y", "try 1"};
  EXPECT_EQ(toString(message),
            "a.ray:3:5: error: expected a number, found y\n    x y\n      ^\n  hint: try 1\n");
}

TEST(Message, LongLinesAreShownAroundTheCaret) {
  const Message message{Message::Severity::warning,
                        {"a.ray", 1, 5001, std::string(5000, 'a') + "!" + std::string(5000, 'b')},
                        "w",
                        ""};
  const std::string text = toString(message);
  EXPECT_LT(text.size(), 400u);
  EXPECT_NE(text.find('!'), std::string::npos);
}

TEST(Messages, StopAtTheTwentiethErrorAndStrictCountsWarnings) {
  Messages messages;
  messages.warn({}, "w");
  EXPECT_NO_THROW(messages.throwIfFailed());
  EXPECT_THROW(messages.throwIfFailed(true), Error);
  for (int i = 1; i < Messages::kMostErrors; ++i) EXPECT_NO_THROW(messages.error({}, "e"));
  EXPECT_THROW(messages.error({}, "e"), Error);
}

}  // namespace
}  // namespace trace
