// Where legends and scales lie over a view.
#include "app/view/screen/overlays.h"

#include <gtest/gtest.h>

namespace trace::test {
namespace {

constexpr Vec2 kView{440, 280}, kLegend{125, 90};

TEST(Overlays, StaysInItsCornerWhereItHidesNothing) {
  for (const ViewCorner now : {ViewCorner::lowerLeft, ViewCorner::upperRight})
    EXPECT_EQ(quietCorner(kView, kLegend, {{{200, 100}, {240, 150}}}, now), now);
}

TEST(Overlays, ALegendMovesOffTheCameraRay) {
  const std::vector<ViewLine> ray{{{60, 250}, {240, 130}}};  // as in the lesson on black glass
  const ViewCorner corner = quietCorner(kView, kLegend, ray, ViewCorner::lowerLeft);
  EXPECT_EQ(corner, ViewCorner::lowerRight);
  EXPECT_EQ(quietCorner(kView, kLegend, ray, corner), corner) << "it does not jump back";
}

TEST(Overlays, AnEndIsWorseThanALineThatPasses) {
  const std::vector<ViewLine> rays{{{60, 270}, {70, 250}},     // ends at the lower left
                                   {{300, 300}, {460, 180}}};  // passes the lower right
  EXPECT_EQ(quietCorner(kView, kLegend, rays, ViewCorner::lowerLeft), ViewCorner::upperRight);
  const std::vector<ViewLine> all{{{60, 270}, {70, 250}}, {{300, 300}, {460, 180}}, {{380, 20}, {20, 20}}};
  EXPECT_EQ(quietCorner(kView, kLegend, all, ViewCorner::lowerLeft), ViewCorner::lowerRight);
}

TEST(Overlays, DoesNotJumpForALittle) {
  const std::vector<ViewLine> rays{
      {{0, 200}, {130, 200}}, {{330, 200}, {440, 200}}, {{330, 20}, {440, 20}}, {{0, 20}, {130, 20}}};
  EXPECT_EQ(quietCorner(kView, kLegend, rays, ViewCorner::lowerLeft), ViewCorner::lowerLeft);
}

TEST(Overlays, PlacesLieInTheView) {
  EXPECT_EQ(placeIn(ViewCorner::lowerLeft, kView, kLegend), (Vec2{0, 190}));
  EXPECT_EQ(placeIn(ViewCorner::upperRight, kView, kLegend), (Vec2{315, 0}));
}

TEST(Overlays, AScaleHidesNothingOfAPictureThatLeavesRoom) {
  EXPECT_EQ(placeScale({500, 300}, {300, 300}, 90, 40), ScalePlace::beside);
  EXPECT_EQ(placeScale({500, 600}, {500, 340}, 90, 40), ScalePlace::below);
  EXPECT_EQ(placeScale({500, 400}, {500, 340}, 90, 40), ScalePlace::over);
}

}  // namespace
}  // namespace trace::test
