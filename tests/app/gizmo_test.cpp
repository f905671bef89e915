// The handles by which the studio moves, turns and scales an object.
#include "app/view/gizmo.h"

#include <gtest/gtest.h>

#include "app/view/orbit_camera.h"

namespace trace::test {
namespace {

/// From (0, 0, 10) to the origin; the view is as high as 10 there.
CameraFrame fromTheFront() {
  CameraFrame view{};
  view.eye = {0, 0, 10};
  view.look = {0, 0, -1}, view.right = {2, 0, 0}, view.up = {0, 1, 0}, view.ahead = view.look;
  return view;
}

Gizmo atOrigin(GizmoMode mode, const Affine& placed = {}) {
  return gizmoFor(mode, placed, {}, fromTheFront());
}

void expectPoint(const Vec3& a, const Vec3& b) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], 1e-9) << i;
}

TEST(Gizmo, IsAsLargeOnTheScreenFromAfar) {
  CameraFrame far = fromTheFront();
  far.eye = {0, 0, 1000};
  EXPECT_NEAR(gizmoFor(GizmoMode::move, {}, {}, far).size / 1000, atOrigin(GizmoMode::move).size / 10, 1e-12);
}

TEST(Gizmo, FindsTheHandleUnderTheCursor) {
  const Gizmo gizmo =
      atOrigin(GizmoMode::move);  // an axis is 1.6 long: 0.16 of the height, 0.08 of the width
  EXPECT_EQ(handleAt(gizmo, fromTheFront(), {0.5 + 0.06, 0.5}, 0.02), 0);
  EXPECT_EQ(handleAt(gizmo, fromTheFront(), {0.5, 0.5 + 0.1}, 0.02), 1);
  EXPECT_EQ(handleAt(gizmo, fromTheFront(), {0.5 - 0.2, 0.5}, 0.02), -1);
}

TEST(Gizmo, MovesAlongAnAxisAlone) {
  const auto by = draggedBy(atOrigin(GizmoMode::move), 0, fromTheFront(), {0.55, 0.5}, {0.65, 0.5});
  ASSERT_TRUE(by);
  expectPoint(*by * Vec3(0, 0, 0), {2, 0, 0});  // a tenth of the width
}

TEST(Gizmo, MovesInThePlaneOfTheScreen) {
  const auto by = draggedBy(atOrigin(GizmoMode::move), Gizmo::kWhole, fromTheFront(), {0.5, 0.5}, {0.6, 0.6});
  ASSERT_TRUE(by);
  expectPoint(by->offset, {2, 1, 0});
}

TEST(Gizmo, AnAxisThatPointsAtTheEyeIsNotDragged) {
  EXPECT_FALSE(draggedBy(atOrigin(GizmoMode::move), 2, fromTheFront(), {0.5, 0.5}, {0.5, 0.5}));
}

TEST(Gizmo, TurnsAboutAnAxis) {
  const auto by = draggedBy(atOrigin(GizmoMode::turn), 2, fromTheFront(), {0.6, 0.5}, {0.5, 0.7});
  ASSERT_TRUE(by);
  expectPoint(*by * Vec3(1, 0, 0), {0, 1, 0});  // a quarter of a turn, against the clock
}

TEST(Gizmo, ScalesAlongTheObjectsOwnAxis) {
  const Affine placed = Affine::rotation({0, 0, 1}, kPi / 2);  // its x points up
  const auto by = draggedBy(atOrigin(GizmoMode::scale, placed), 0, fromTheFront(), {0.5, 0.6}, {0.5, 0.7});
  ASSERT_TRUE(by);
  expectPoint(*by * Vec3(1, 1, 1), {1, 2, 1});
}

TEST(Gizmo, ScalesAllAxesAtOnceAndNeverToNothing) {
  const Gizmo gizmo = atOrigin(GizmoMode::scale);
  const auto larger = draggedBy(gizmo, Gizmo::kWhole, fromTheFront(), {0.5, 0.5}, {0.5, 0.66});
  ASSERT_TRUE(larger);
  expectPoint(*larger * Vec3(1, 1, 1), {2, 2, 2});
  EXPECT_FALSE(draggedBy(gizmo, 0, fromTheFront(), {0.55, 0.5}, {0.45, 0.5}));  // beyond the center
}

TEST(Gizmo, TurnsAboutTheCenterOfTheObject) {
  Gizmo gizmo = gizmoFor(GizmoMode::turn, {}, {1, 2, 0}, fromTheFront());
  const auto by = draggedBy(gizmo, 2, fromTheFront(), {0.6, 0.7}, {0.55, 0.9});
  ASSERT_TRUE(by);
  expectPoint(*by * gizmo.center, gizmo.center);
}

}  // namespace
}  // namespace trace::test
