// Where objects stand: the short form for what scales along the axes and moves says what the long one says.
#include "geometry/placement.h"

#include <gtest/gtest.h>

#include <random>

namespace trace {
namespace {

struct Numbers {
  std::mt19937_64 generator{7};
  Real upTo(Real most) { return std::uniform_real_distribution<Real>(-most, most)(generator); }
  Vec3 vec(Real most) { return {upTo(most), upTo(most), upTo(most)}; }
};

SurfacePoint someSurface(Numbers& n) {
  SurfacePoint s;
  s.point = n.vec(2);
  s.error = abs(n.vec(1e-15));
  s.normal = normalize(n.vec(1));
  s.shading = normalize(n.vec(1));
  return s;
}

void expectSame(const SurfacePoint& a, const SurfacePoint& b) {
  EXPECT_EQ(a.point, b.point);
  EXPECT_EQ(a.error, b.error);
  EXPECT_EQ(a.normal, b.normal);
  EXPECT_EQ(a.shading, b.shading);
}

TEST(Placement, OfWhatScalesAndMovesIsThatOfAnyTransformToTheLastBit) {
  Numbers n;
  for (int i = 0; i < 1000; ++i) {
    Affine m = Affine::scaling(n.vec(3));
    m.offset = i % 4 ? n.vec(100) : Vec3{};
    const Affine back = inverse(m);
    const Placement placement(m);
    EXPECT_TRUE(placement.moved());
    EXPECT_EQ(placement.outFromIn(), m);
    EXPECT_EQ(placement.inFromOut(), back);
    const Ray ray{n.vec(10), n.vec(1)}, in = placement.into(ray);
    EXPECT_EQ(in.origin, back * ray.origin);
    EXPECT_EQ(in.direction, linear(back, ray.direction));
    const SurfacePoint s = someSurface(n);
    expectSame(placement.outOf(s), outOf(s, WayOut(m, back), back));
  }
}

TEST(Placement, TurnsThereAndBackWithinItsError) {
  Numbers n;
  for (int i = 0; i < 1000; ++i) {
    Affine m = Affine::rotation(normalize(n.vec(1)), n.upTo(3)) * Affine::scaling(n.vec(3));
    m.offset = n.vec(100);
    const Placement placement(m);
    EXPECT_EQ(placement.outFromIn(), m);
    const SurfacePoint s = someSurface(n), out = placement.outOf(s);
    const Vec3 back = placement.into({out.point, {1, 0, 0}}).origin;
    const Vec3 allowed = linear(absolute(placement.inFromOut()), out.error);
    for (int axis = 0; axis < 3; ++axis) EXPECT_LE(std::abs(back[axis] - s.point[axis]), allowed[axis]);
    EXPECT_NEAR(length(out.normal), 1, 1e-14);
  }
}

TEST(Placement, OfTheIdentityMovesNothing) {
  Numbers n;
  const Placement placement;
  EXPECT_FALSE(placement.moved());
  const Ray ray{n.vec(10), n.vec(1)}, in = placement.into(ray);
  EXPECT_EQ(in.origin, ray.origin);
  EXPECT_EQ(in.direction, ray.direction);
  const SurfacePoint s = someSurface(n);
  EXPECT_EQ(placement.outOf(s).point, s.point);
}

/// A scene may have a million (docs/developers/performance.md): the World holds one for each object.
TEST(Placement, IsSmall) { EXPECT_LE(sizeof(Placement), 128u); }

}  // namespace
}  // namespace trace
