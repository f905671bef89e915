#include "shading/normal_map.h"

#include <gtest/gtest.h>

namespace trace {
namespace {

/// The plane z = 0 with u along x and v along y, or with u the other way round.
SurfaceSlopes plane(bool mirrored = false) {
  SurfaceSlopes slopes;
  slopes.tangent[0] = {1, 0, 0}, slopes.tangent[1] = {0, 1, 0};
  slopes.u = {mirrored ? -0.5 : 0.5, 0, 0}, slopes.v = {0, 3, 0};
  return slopes;
}
constexpr Vec3 kUp{0, 0, 1};

void expectNear(const Vec3& a, const Vec3& b) {
  EXPECT_LE(length(a - b), 1e-12) << a.x << " " << a.y << " " << a.z;
}

TEST(NormalMap, ItsColoursAreDirectionsAlongUVAndTheNormal) {
  expectNear(mappedNormal({0.5, 0.5, 1}, plane().frame(), kUp, 1, false), kUp);
  expectNear(mappedNormal({1, 0.5, 0.5}, plane().frame(), kUp, 1, false), {1, 0, 0});
  expectNear(mappedNormal({0.5, 1, 0.5}, plane().frame(), kUp, 1, false), {0, 1, 0});
  expectNear(mappedNormal({1, 0.5, 1}, plane().frame(), kUp, 1, false), normalize({1, 0, 1}));
}

TEST(NormalMap, GreenMayCountDownward) {
  expectNear(mappedNormal({0.5, 0.75, 1}, plane().frame(), kUp, 1, true), normalize({0, -0.5, 1}));
  expectNear(mappedNormal({0.5, 0.75, 1}, plane().frame(), kUp, 1, false), normalize({0, 0.5, 1}));
}

TEST(NormalMap, TheScaleIsThatOfWhatLiesAlongTheSurface) {
  expectNear(mappedNormal({0.75, 0.75, 1}, plane().frame(), kUp, 2, false), normalize({1, 1, 1}));
  expectNear(mappedNormal({0.75, 0.75, 1}, plane().frame(), kUp, 0, false), kUp);
}

TEST(NormalMap, AMirroredPictureIsMirrored) {
  expectNear(mappedNormal({0.75, 0.5, 1}, plane(true).frame(), kUp, 1, false), normalize({-0.5, 0, 1}));
  expectNear(mappedNormal({0.5, 0.75, 1}, plane(true).frame(), kUp, 1, false), normalize({0, 0.5, 1}));
}

TEST(NormalMap, TheFrameLeansWithTheNormalForShading) {
  const Vec3 leaning = normalize({0.3, 0.1, 1});
  const Vec3 right = mappedNormal({1, 0.5, 0.5}, plane().frame(), leaning, 1, false);
  EXPECT_NEAR(dot(right, leaning), 0, 1e-12);
  EXPECT_GT(right.x, 0.9);
}

TEST(NormalMap, NothingBendsWhereUAndVTellNoPlacesApart) {
  SurfaceSlopes none = plane();
  none.u = {};
  EXPECT_EQ(mappedNormal({1, 0, 0.5}, none.frame(), kUp, 1, false), kUp);
  EXPECT_EQ(mappedNormal({0.5, 0.5, 0.5}, plane().frame(), kUp, 1, false), kUp);  // no direction
}

}  // namespace
}  // namespace trace
