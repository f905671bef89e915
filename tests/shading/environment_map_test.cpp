// Directions to places in pictures of everything around, and back; seams, poles and faces.
#include "shading/environment_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace trace {
namespace {

using Kind = EnvironmentKind;
constexpr Vec3 kAxes[6]{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};

/// A texel says where it is: red grows to the right, green downward.
Picture ramp(int width, int height, double blue = 0) {
  Picture picture(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) picture.at(x, y) = {(x + 0.5) / width, (y + 0.5) / height, blue};
  return picture;
}

/// The face of number i is of one colour, i.
std::array<Picture, 6> numberedFaces(int side) {
  std::array<Picture, 6> faces;
  for (std::size_t i = 0; i < 6; ++i) {
    faces[i] = Picture(side, side);
    for (Color& c : faces[i].pixels) c = Color(static_cast<double>(i));
  }
  return faces;
}

std::vector<EnvironmentMap> oneOfEachKind() {
  std::vector<EnvironmentMap> maps;
  maps.emplace_back(ramp(8, 4), Kind::latLong);
  maps.emplace_back(ramp(8, 8), Kind::angular);
  maps.emplace_back(numberedFaces(4));
  return maps;
}

std::vector<Vec3> directions() {
  std::vector<Vec3> all(std::begin(kAxes), std::end(kAxes));
  for (int i = 0; i < 500; ++i) {  // a spiral from pole to pole
    const Real y = 1 - (i + 0.5) / 250, around = i * 2.399963, across = std::sqrt(1 - y * y);
    all.push_back({across * std::cos(around), y, across * std::sin(around)});
  }
  return all;
}

TEST(EnvironmentMap, DirectionsGoToPlacesAndBack) {
  for (const EnvironmentMap& map : oneOfEachKind())
    for (const Vec3& d : directions()) {
      const EnvironmentMap::Spot spot = map.spot(d);
      EXPECT_GE(spot.uv.x, 0);
      EXPECT_LE(spot.uv.x, 1);
      EXPECT_GE(spot.uv.y, 0);
      EXPECT_LE(spot.uv.y, 1);
      EXPECT_LT(length(map.direction(spot) - d), 1e-12)
          << static_cast<int>(map.kind()) << " " << d.x << " " << d.y;
      const EnvironmentMap::Spot longer = map.spot(d * 7.0);  // the length does not count
      EXPECT_NEAR(longer.uv.x, spot.uv.x, 1e-15);
      EXPECT_NEAR(longer.uv.y, spot.uv.y, 1e-15);
    }
}

TEST(EnvironmentMap, TheMiddleIsWhatANewCameraLooksAt) {
  for (const EnvironmentMap& map : oneOfEachKind()) {
    const auto uv = [&](const Vec3& d) { return map.spot(d).uv; };
    EXPECT_EQ(uv({0, 0, -1}), (Vec2{0.5, 0.5}));
    const Vec2 right = uv({0.1, 0, -1}), up = uv({0, 0.1, -1});
    EXPECT_GT(right.x, 0.5);
    EXPECT_NEAR(right.y, 0.5, 1e-15);
    EXPECT_LT(up.y, 0.5);
    EXPECT_NEAR(up.x, 0.5, 1e-15);
  }
}

TEST(EnvironmentMap, LatLongHasQuartersOfACircleInItsQuarters) {
  const EnvironmentMap map(ramp(8, 4), Kind::latLong);
  EXPECT_EQ(map.spot({1, 0, 0}).uv, (Vec2{0.75, 0.5}));
  EXPECT_EQ(map.spot({-1, 0, 0}).uv, (Vec2{0.25, 0.5}));
  EXPECT_EQ(map.spot({0, 1, 0}).uv.y, 0);
  EXPECT_EQ(map.spot({0, -1, 0}).uv.y, 1);
  EXPECT_EQ(map.spot({0, 0, 1}).uv.x, 1);
}

TEST(EnvironmentMap, LatLongHasOneColorAtAPoleAndNoSeamBehind) {
  const EnvironmentMap map(ramp(16, 8), Kind::latLong);
  for (const Real pole : {1.0, -1.0}) {
    const Color at = map.at(Vec3{0, pole, 0});
    EXPECT_NEAR(at.r, 0.5, 1e-12);  // the mean of the row
    for (int i = 0; i < 16; ++i) {
      const Vec3 near{1e-9 * std::cos(i), pole, 1e-9 * std::sin(i)};
      EXPECT_NEAR(map.at(near).r, at.r, 1e-7);
      EXPECT_NEAR(map.at(near).g, at.g, 1e-7);
    }
  }
  for (const Real y : {-0.9, -0.3, 0.0, 0.4, 0.8})
    EXPECT_NEAR(map.at(Vec3{1e-12, y, 1}).r, map.at(Vec3{-1e-12, y, 1}).r, 1e-9);
  // Between the last column and the first.
  EXPECT_NEAR(map.at(Vec3{0, 0, 1}).r, 0.5, 1e-12);
}

TEST(EnvironmentMap, AnAngularMapHasStraightBackAtItsRim) {
  const EnvironmentMap map(ramp(64, 64), Kind::angular);
  EXPECT_NEAR(map.spot({1, 0, 0}).uv.x, 0.75, 1e-15);
  EXPECT_NEAR(map.spot({0, 1, 0}).uv.y, 0.25, 1e-15);
  EXPECT_NEAR(map.spot({1e-9, 0, 1}).uv.x, 1, 1e-9);
  EXPECT_EQ(map.direction({0, {0.02, 0.02}}), Vec3{});  // in a corner
}

TEST(EnvironmentMap, AnAngularMapNeverShowsItsCorners) {
  for (const int side : {1, 2, 5, 16}) {
    Picture disc(side, side);
    const double half = side / 2.0;
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x)
        disc.at(x, y) = std::hypot(x + 0.5 - half, y + 0.5 - half) <= half ? Color(1) : Color(-1000);
    const EnvironmentMap map(disc, Kind::angular);
    for (const Vec3& d : directions()) EXPECT_NEAR(map.at(d).r, 1, 1e-12) << side;
    for (int i = 0; i < 100; ++i)
      EXPECT_NEAR(map.at(Vec3{1e-6 * std::cos(i), 1e-6 * std::sin(i), 1}).r, 1, 1e-12) << side;
  }
}

TEST(EnvironmentMap, EachFaceOfACubeIsSeenInItsDirection) {
  const EnvironmentMap map(numberedFaces(3));
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(map.spot(kAxes[i]).face, i);
    EXPECT_EQ(map.at(kAxes[i]), Color(i));
  }
  EXPECT_EQ(EnvironmentMap::kFaceNames[static_cast<std::size_t>(map.spot({0, 0, -1}).face)], "front");
}

/// Where faces meet, the ends of both are one direction.
TEST(EnvironmentMap, FacesJoinAtTheirEdges) {
  // Each texel is its direction.
  const int side = 9;
  const EnvironmentMap pattern(numberedFaces(side));
  std::array<Picture, 6> faces;
  for (int f = 0; f < 6; ++f) {
    faces[static_cast<std::size_t>(f)] = Picture(side, side);
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        const Vec3 d = pattern.direction({f, {x / (side - 1.0), y / (side - 1.0)}});
        faces[static_cast<std::size_t>(f)].at(x, y) = {d.x, d.y, d.z};
      }
  }
  const EnvironmentMap map(faces);
  for (const Vec3& d : directions()) {
    const Color c = map.at(d);
    EXPECT_LT(length(Vec3{c.r, c.g, c.b} - d), 0.02);
  }
  const Real e = 1e-9;
  for (Real s = -0.95; s < 1; s += 0.1)
    for (const auto& [a, b] : {std::pair<Vec3, Vec3>{{1, s, 1 + e}, {1 + e, s, 1}},
                               {{1, 1 + e, s}, {1 + e, 1, s}},
                               {{s, -1, -1 - e}, {s, -1 - e, -1}},
                               {{-1 - e, s, -1}, {-1, s, -1 - e}}}) {
      ASSERT_NE(map.spot(a).face, map.spot(b).face);
      const Color x = map.at(a), y = map.at(b);
      EXPECT_LT(length(Vec3{x.r - y.r, x.g - y.g, x.b - y.b}), 1e-7);
    }
}

/// As in a picture of a cross that is cut out and folded, seen from inside.
TEST(EnvironmentMap, ACrossLyingAndStandingIsTheSameCube) {
  Picture lying(12, 9), standing(9, 12);
  const auto fill = [](Picture& p, int column, int row, int face, bool turned) {
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 3; ++x) {
        const int sx = turned ? 2 - x : x, sy = turned ? 2 - y : y;
        p.at(column * 3 + x, row * 3 + y) = {static_cast<double>(face), static_cast<double>(sx),
                                             static_cast<double>(sy)};
      }
  };
  fill(lying, 1, 0, 2, false), fill(lying, 0, 1, 1, false), fill(lying, 1, 1, 5, false);
  fill(lying, 2, 1, 0, false), fill(lying, 3, 1, 4, false), fill(lying, 1, 2, 3, false);
  fill(standing, 1, 0, 2, false), fill(standing, 0, 1, 1, false), fill(standing, 1, 1, 5, false);
  fill(standing, 2, 1, 0, false), fill(standing, 1, 2, 3, false), fill(standing, 1, 3, 4, true);
  const EnvironmentMap a(lying, Kind::cube), b(standing, Kind::cube);
  for (int i = 0; i < 6; ++i) EXPECT_EQ(a.at(kAxes[i]).r, i);
  for (const Vec3& d : directions()) EXPECT_EQ(a.at(d), b.at(d));
  EXPECT_EQ(a.at(Vec3{0.999, 0.999, -1}), (Color{5, 0.999 + 1, 1 - 0.999}));
}

TEST(EnvironmentMap, PicturesOfTheWrongShapeAreRefusedWithTheReason) {
  EXPECT_THROW(EnvironmentMap(Picture(8, 8), Kind::cube), std::invalid_argument);
  EXPECT_THROW(EnvironmentMap(Picture(9, 8), Kind::cube), std::invalid_argument);
  EXPECT_THROW(EnvironmentMap(Picture(9, 8), Kind::angular), std::invalid_argument);
  EXPECT_THROW(EnvironmentMap(Picture(0, 0), Kind::latLong), std::invalid_argument);
  std::array<Picture, 6> faces = numberedFaces(4);
  faces[3] = Picture(5, 5);
  try {
    EnvironmentMap map(faces);
    ADD_FAILURE();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("\"down\" has 5 x 5 pixels"), std::string::npos) << error.what();
  }
}

TEST(EnvironmentMap, ShapesAndNamesSayTheKind) {
  EXPECT_EQ(kindByShape(1024, 768), Kind::cube);
  EXPECT_EQ(kindByShape(768, 1024), Kind::cube);
  EXPECT_EQ(kindByShape(640, 640), Kind::angular);
  EXPECT_EQ(kindByShape(2048, 1024), Kind::latLong);
  EXPECT_EQ(kindByShape(1000, 700), Kind::latLong);
  const char* endings[6][3]{{"a/posx.png", "terrain_positive_x.PNG", "sky-right.hdr"},
                            {"negx.png", "terrain_negative_x.png", "left.jpg"},
                            {"posy.png", "terrain_positive_y.png", "sky_top.png"},
                            {"negy.png", "terrain_negative_y.png", "bottom.png"},
                            {"negz.png", "terrain_negative_z.png", "sky.back.png"},
                            {"posz.png", "terrain_positive_z.png", "Front.png"}};
  for (int face = 0; face < 6; ++face)
    for (const char* name : endings[face]) EXPECT_EQ(faceByName(name).face, face) << name;
  EXPECT_EQ(faceByName("a/terrain_positive_x.png").rest, "terrain_");
  EXPECT_EQ(faceByName("orientation_convention.png").face, -1);
}

TEST(EnvironmentMap, BlurKeepsOneColorAndTheMeanAndSpreadsAPoint) {
  const Picture grey = [] {
    Picture p(16, 8);
    for (Color& c : p.pixels) c = {0.25, 0.5, 0.75};
    return p;
  }();
  for (const Real angle : {2.0, 30.0, 90.0}) {
    const EnvironmentMap blurred = EnvironmentMap(grey, Kind::latLong).blurred(angle, 1);
    for (const Vec3& d : directions()) {
      EXPECT_NEAR(blurred.at(d).r, 0.25, 1e-12);
      EXPECT_NEAR(blurred.at(d).b, 0.75, 1e-12);
    }
  }
  // Half of everything is white: at the edge it is grey, and as white as before farther off than the angle.
  Picture half(64, 32);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 64; ++x) half.at(x, y) = Color(1);
  const EnvironmentMap blurred = EnvironmentMap(half, Kind::latLong).blurred(20, 1);
  EXPECT_NEAR(blurred.at(Vec3{0.3, 0, 1}).r, 0.5, 0.03);
  EXPECT_NEAR(blurred.at(Vec3{0, 1, 1}).r, 1, 1e-9);
  EXPECT_NEAR(blurred.at(Vec3{0, -1, 1}).r, 0, 1e-9);
  Real last = 0;
  for (Real y = -0.4; y <= 0.4; y += 0.05) {
    const Real now = blurred.at(Vec3{0.6, y, 0.8}).r;
    EXPECT_GE(now, last - 0.02) << y;
    last = now;
  }
}

TEST(EnvironmentMap, BlurIsTheSameForAnyNumberOfThreads) {
  const EnvironmentMap map(ramp(16, 8), Kind::latLong);
  const EnvironmentMap one = map.blurred(15, 1), seven = map.blurred(15, 7);
  for (const Vec3& d : directions()) EXPECT_EQ(one.at(d), seven.at(d));
}

}  // namespace
}  // namespace trace
