// Lens openings by pictures.
#include "shading/cameras/aperture.h"

#include <gtest/gtest.h>

#include <cmath>

#include "shading/cameras/camera.h"

namespace trace {
namespace {

TEST(Aperture, PlacesAreChosenByTheirBrightness) {
  Picture picture(
      4, 2);  // one place of the upper row, two of the lower one, of which one is three times as bright
  picture.at(0, 0) = Color(1);
  picture.at(2, 1) = Color(1);
  picture.at(3, 1) = Color(3);
  const Aperture aperture(picture);
  constexpr int kSide = 500;
  int upper = 0, dim = 0, bright = 0, other = 0;
  for (int i = 0; i < kSide; ++i)
    for (int j = 0; j < kSide; ++j) {
      const Vec2 at = aperture.at({(i + 0.5) / kSide, (j + 0.5) / kSide});
      EXPECT_TRUE(std::abs(at.x) <= 1 && std::abs(at.y) <= 0.5);
      if (at.y > 0 && at.x < -0.5)
        ++upper;
      else if (at.y < 0 && at.x > 0 && at.x < 0.5)
        ++dim;
      else if (at.y < 0 && at.x > 0.5)
        ++bright;
      else
        ++other;
    }
  constexpr Real kAll = kSide * kSide;
  EXPECT_NEAR(upper / kAll, 0.2, 0.003);
  EXPECT_NEAR(dim / kAll, 0.2, 0.003);
  EXPECT_NEAR(bright / kAll, 0.6, 0.003);
  EXPECT_EQ(other, 0);
}

TEST(Aperture, OfABlackPictureAllIsOpen) {
  const Aperture aperture(Picture(3, 3));
  const Vec2 at = aperture.at({0.99, 0.01});
  EXPECT_NEAR(at.x, -0.98, 1e-9);
  EXPECT_NEAR(at.y, -0.98, 1e-9);
}

TEST(Aperture, ALensTakesItsShape) {
  Picture slit(5, 5);
  for (int y = 0; y < 5; ++y) slit.at(2, y) = Color(1);
  Lens lens{.radius = 0.5};
  lens.picture = std::make_shared<const Aperture>(slit);
  Real highest = 0;
  for (int i = 0; i < 100; ++i) {
    const Vec2 at = lens.at({i / 100.0, std::fmod(i * 0.618, 1)});
    EXPECT_LE(std::abs(at.x), 0.1 + 1e-12);
    highest = std::max(highest, std::abs(at.y));
  }
  EXPECT_GT(highest, 0.48);
  EXPECT_LE(highest, 0.5);
}

}  // namespace
}  // namespace trace
