// Where the studio's panels are, and how their docks share the window.
#include "app/view/arrangement.h"

#include <gtest/gtest.h>

namespace trace::test {
namespace {

const Arrangement& called(std::string_view name) {
  for (const Arrangement& each : arrangements())
    if (each.name == name) return each;
  ADD_FAILURE() << name;
  return arrangements()[0];
}

Dock dockOf(const Arrangement& arrangement, std::string_view panel, Dock otherwise) {
  for (const Arrangement::Place& place : arrangement.places)
    if (place.panel == panel) return place.dock;
  return otherwise;
}

TEST(Arrangement, ThePictureHasMostOfTheWindowWhereOneLooks) {
  const Arrangement& look = called("Look");
  EXPECT_EQ(dockOf(look, "Controls", Dock::left), Dock::hidden);
  EXPECT_EQ(dockOf(look, "Rays", Dock::right), Dock::right);
  for (const double width : {900.0, 1280.0, 1920.0}) {
    const DockSizes sizes = dockSizes(look.shares, {.left = false}, width, 600, 8, 30);
    EXPECT_EQ(sizes.left, 0);
    EXPECT_GE(width - sizes.right, 0.6 * width);
  }
}

TEST(Arrangement, NothingIsNextToThePictureWhereOneCompares) {
  for (const char* panel : {"Controls", "Scene", "Rays"})
    EXPECT_EQ(dockOf(called("Compare"), panel, Dock::left), Dock::hidden) << panel;
}

TEST(Arrangement, ASmallWindowBeginsWithTwoColumns) {
  EXPECT_EQ(firstArrangement(900 / 8.0).name, "Look");
  EXPECT_EQ(firstArrangement(1280 / 8.0).name, "Build");
}

TEST(Arrangement, APhoneHasOneColumn) {
  EXPECT_TRUE(hasOneColumn(390 / 8.0, 390, 844));
  EXPECT_FALSE(hasOneColumn(844 / 8.0, 844, 390)) << "held sideways it has two";
  EXPECT_FALSE(hasOneColumn(900 / 8.0, 900, 1200));
  EXPECT_FALSE(hasOneColumn(400 / 8.0, 400, 300));
}

TEST(Arrangement, TheLeftDockHasRoomForNamesNextToValues) {
  const DockSizes small = dockSizes({.left = 0.12}, {}, 900, 600, 8, 0);
  EXPECT_EQ(small.left, 240);
  EXPECT_EQ(dockSizes({.left = 0.12}, {}, 300, 600, 8, 0).left, 96);  // but leaves some to the others
}

TEST(Arrangement, TheLowerDockIsADrawer) {
  EXPECT_EQ(dockSizes({.bottom = 0.2}, {}, 900, 600, 8, 0).bottom, 120);
  EXPECT_EQ(dockSizes({.bottom = 0.2}, {}, 900, 600, 8, 34).bottom, 34);
  EXPECT_EQ(dockSizes({}, {.bottom = false}, 900, 600, 8, 34).bottom, 0);
}

TEST(Arrangement, ADockWithoutACentreTakesTheRest) {
  const DockSizes sizes = dockSizes({.left = 0.25}, {.centre = false}, 1000, 600, 8, 0);
  EXPECT_EQ(sizes.right, 750);
}

}  // namespace
}  // namespace trace::test
