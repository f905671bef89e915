#include "app/editing/typed_region.h"

#include <gtest/gtest.h>

#include "scene/options.h"

namespace trace::test {
namespace {

TEST(TypedRegion, TakesCommasSpacesAndNothing) {
  EXPECT_EQ(typedRegion("10,20,300,200"), "10,20,300,200");
  EXPECT_EQ(typedRegion(" 10, 20 , 300 200 "), "10,20,300,200");
  EXPECT_EQ(typedRegion("10 20 300 200"), "10,20,300,200");
  EXPECT_EQ(typedRegion("  "), "0,0,0,0");
  EXPECT_EQ(shownRegion("0,0,0,0"), "");
  EXPECT_EQ(shownRegion("1,2,3,4"), "1,2,3,4");
}

TEST(TypedRegion, IsTakenByTheOptionOrRefusedByIt) {
  const Option& option = findOption("region");
  Settings settings;
  option.assign(settings, typedRegion("10 20 300 200"));
  EXPECT_EQ(settings.region, (Region{10, 20, 300, 200}));
  option.assign(settings, typedRegion(shownRegion(option.get({}))));
  EXPECT_TRUE(settings.region.whole());
  for (const char* wrong : {"10", "10,20", "a b c d", "10,,20,30,40", "30 20 10 40"})
    EXPECT_THROW(option.assign(settings, typedRegion(wrong)), Error) << wrong;
}

}  // namespace
}  // namespace trace::test
