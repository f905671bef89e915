// Numbers where there is little room for them.
#include "app/editing/short_number.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "base/text.h"
#include "geometry/field_value.h"
#include "geometry/shape.h"
#include "scene/option_words.h"
#include "scene/options.h"
#include "shading/background.h"
#include "shading/cameras/camera.h"
#include "shading/lights/light.h"

namespace trace::test {
namespace {

std::string inRoom(std::size_t characters, double value, const std::string& format = "%.3g") {
  return shortNumber(value, format, [&](const std::string& text) { return text.size() <= characters; });
}

TEST(ShortNumber, TheFormatStaysAsLongAsItFits) {
  EXPECT_EQ(inRoom(8, 12345), "1.23e+04");
  EXPECT_EQ(inRoom(8, 0.5, "%.2f m"), "0.50 m");
  EXPECT_EQ(inRoom(5, 0.5, "%.2f m"), "0.50");
  EXPECT_EQ(inRoom(3, 0.5, "%.2f m"), "0.5");
  EXPECT_EQ(inRoom(2, 0.5, "%.2f m"), ".5");
  EXPECT_EQ(inRoom(5, 12, "%.0f rays"), "12");
}

TEST(ShortNumber, AsManyDigitsStandAsFitAndNoExponentIsCut) {
  EXPECT_EQ(inRoom(5, 1500), "1500");
  EXPECT_EQ(inRoom(4, 1500), "1500");
  EXPECT_EQ(inRoom(5, 12345), "12345");
  EXPECT_EQ(inRoom(5, 123456), "1.2e5");
  EXPECT_EQ(inRoom(6, 123456), "123456");
  EXPECT_EQ(inRoom(5, 0.0001), "1e-4");
  EXPECT_EQ(inRoom(6, 0.0001), "0.0001");
  EXPECT_EQ(inRoom(5, 0.1234), "0.123");
  EXPECT_EQ(inRoom(4, 0.1234), ".123");
  EXPECT_EQ(inRoom(4, 0.025), ".025");
  EXPECT_EQ(inRoom(5, -0.1234), "-.123");
  EXPECT_EQ(inRoom(3, 9.99), "10") << "rounded up";
  EXPECT_EQ(inRoom(4, 100000, "%.0f rays"), "1e5");
}

TEST(ShortNumber, WhereNothingRightFitsThereAreDots) {
  EXPECT_EQ(inRoom(3, 1500), "...");
  EXPECT_EQ(inRoom(4, 12345), "...");
  EXPECT_EQ(inRoom(2, 0.1234), "...") << ".1 would be wrong by a fifth";
  EXPECT_EQ(inRoom(3, 12345, "%.0f rays"), "...");
  EXPECT_EQ(inRoom(1, 0), "0");
}

TEST(ShortNumber, WhatIsShownIsTheValueToATwentieth) {
  for (std::size_t room = 3; room < 9; ++room)
    for (double value = 1.2345e-9; value < 1e12; value *= 3.7)
      for (const double signedValue : {value, -value})
        if (const std::string text = inRoom(room, signedValue); text != "...") {
          EXPECT_LE(text.size(), room);
          EXPECT_LE(std::abs(std::strtod(text.c_str(), nullptr) - signedValue), 0.05 * value) << text;
        }
}

TEST(NumberWords, AreAcceptedWhereTheyAreShown) {
  const NumberWords words{"auto", kNoLimit};
  EXPECT_EQ(words.of(0, 0), "auto");
  EXPECT_EQ(words.of(1, 0), "");
  EXPECT_EQ(words.of(kNoLimit, 0), "no limit");
  EXPECT_EQ(words.meaning("Auto", 0), 0);
  EXPECT_EQ(words.meaning("no limit", 0), kNoLimit);
  EXPECT_FALSE(words.meaning("aut", 0));
  EXPECT_FALSE(NumberWords{}.meaning("", 0));
  EXPECT_FALSE(NumberWords{}.meaning("no limit", 0)) << "the field takes no infinity";
}

TEST(NumberWords, OfEveryOptionCanBeTypedBack) {
  std::size_t count = 0;
  for (const Option& option : options()) {
    const NumberWords words{leastWordFor(option), {}};
    if (words.least.empty()) continue;
    ++count;
    EXPECT_EQ(words.meaning(words.of(option.least, option.least), option.least), option.least) << option.name;
    Settings settings;
    EXPECT_NO_THROW(option.assign(settings, toText(option.least))) << option.name;
  }
  EXPECT_GT(count, 20u);
  for (const Option& option : options())
    EXPECT_EQ(option.get(Settings{}).find("inf"), std::string::npos) << option.name << " needs a word";
}

/// The word of an infinite value means that value.
template <class Field, class Value>
void expectTypedBack(const Field& field, const Value& value, std::size_t& count) {
  if constexpr (std::is_same_v<Value, Real>) {
    if (!std::isinf(value)) return;
    ++count;
    EXPECT_GE(value, field.least) << field.keyword;
    EXPECT_LE(value, field.most) << field.keyword;
    const NumberWords words{{}, value};
    EXPECT_EQ(words.meaning(words.of(value, field.least), field.least), value) << field.keyword;
  }
}

TEST(NumberWords, OfEveryFieldOfAThingOfAScene) {
  std::size_t count = 0;
  const auto visit = [&](const auto& field, const auto& value) { expectTypedBack(field, value, count); };
  forEachField(Camera{}, visit);
  forEachField(Background{}, visit);
  for (const LightType& type : lightTypes()) forEachField(Light(type), visit);
  for (const ShapeType& type : shapeTypes()) forEachField(Shape(type), visit);
  EXPECT_GE(count, 7u) << "the camera's far and six flaps";
}

}  // namespace
}  // namespace trace::test
