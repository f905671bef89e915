// Where animations, skins, morph targets and copies of glTF files put the corners of a square, by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "formats/format.h"
#include "geometry/mesh/mesh.h"
#include "gltf_square.h"

namespace trace::gltf_pose_test {
namespace {

using nlohmann::json;
using test::Square;

/// The corners of all squares in the world, in the order of the file.
std::vector<Vec3> cornersAt(const Square& square, double time, std::string* told = nullptr,
                            bool binary = false) {
  Messages messages;
  const Scene scene =
      readScene(binary ? "a.glb" : "a.gltf", binary ? square.glb() : square.text(), messages, time);
  std::vector<Vec3> corners;
  for (const Object& object : scene.objects)
    for (const Vec3f& point : object.shape.as<Mesh>()->data->points)
      corners.push_back(object.worldFromObject * Vec3(point));
  for (const Message& message : messages.all())
    if (told) *told += message.what + "\n";
  return corners;
}

void expectCorners(const std::vector<Vec3>& found, const std::vector<Vec3>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_LT(length(found[i] - expected[i]), 1e-6)
        << i << ": " << found[i].x << " " << found[i].y << " " << found[i].z;
}

/// A square whose node is animated by keys at 1 and 3 seconds.
Square animated(const char* path, const std::vector<float>& values, int each, const char* interpolation) {
  Square square;
  const int input = square.floats({1, 3}, 1), output = square.floats(values, each);
  square.root["animations"] = {
      {{"samplers", {{{"input", input}, {"output", output}, {"interpolation", interpolation}}}},
       {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}}}}}};
  return square;
}

TEST(GltfPose, KeysMoveANodeAndHoldBeforeAndAfter) {
  for (const char* way : {"LINEAR", "STEP"}) {
    const Square square = animated("translation", {2, 0, 0, 4, 0, 8}, 3, way);
    const bool isStep = way[0] == 'S';
    const auto first = [&](double time) { return cornersAt(square, time).front(); };
    expectCorners({first(-1), first(1), first(2), first(3), first(9)},
                  {{2, 0, 0}, {2, 0, 0}, isStep ? Vec3{2, 0, 0} : Vec3{3, 0, 4}, {4, 0, 8}, {4, 0, 8}});
    EXPECT_TRUE(changesWithTime("a.gltf", square.text()));
  }
  EXPECT_FALSE(changesWithTime("a.gltf", Square().text()));
}

TEST(GltfPose, OneCameraSeesTheWholeAnimation) {
  const Square square = animated("translation", {0, 0, 0, 9, 0, 0}, 3, "LINEAR");
  Messages messages;
  const Camera camera = readScene("a.gltf", square.text(), messages, 0.0).camera;
  for (const double time : {1.0, 1.7, 3.0, 8.0})
    EXPECT_EQ(readScene("a.gltf", square.text(), messages, time).camera, camera) << time;
  EXPECT_GT(camera.position.x, 3) << "it looks at the middle of the way";
}

TEST(GltfPose, TurnsGoTheShorterWay) {
  // A quarter turn about z, with the sign that would go the long way: in the middle an eighth.
  const float half = std::sqrt(0.5f);
  const Square square = animated("rotation", {0, 0, 0, 1, 0, 0, -half, -half}, 4, "LINEAR");
  const double c = std::sqrt(0.5);
  expectCorners(cornersAt(square, 2), {{0, 0, 0}, {c, c, 0}, {0, 2 * c, 0}, {-c, c, 0}});
}

TEST(GltfPose, CubicKeysAreHermites) {
  // In-tangent, value and out-tangent of each key; value 0 to 1 in 2 seconds with slope 1 at the first, 0 at
  // the second.
  const Square square =
      animated("scale", {9, 9, 9, 1, 1, 1, 1, 1, 1, 0, 0, 0, 2, 2, 2, 9, 9, 9}, 3, "CUBICSPLINE");
  const double t = 0.25, at = (2 * t * t * t - 3 * t * t + 1) + 2 * (t * t * t - 2 * t * t + t) +
                              2 * (3 * t * t - 2 * t * t * t);
  expectCorners(cornersAt(square, 1.5), {{0, 0, 0}, {at, 0, 0}, {at, at, 0}, {0, at, 0}});
}

TEST(GltfPose, WeightsOfTargetsAreAnimated) {
  Square square;
  const int up = square.floats({0, 0, 4, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 3),
            aside = square.floats({0, 0, 0, 8, 0, 0, 0, 0, 0, 0, 0, 0}, 3);
  square.primitive()["targets"] = {{{"POSITION", up}}, {{"POSITION", aside}}};
  square.set("/meshes/0/weights", {0.5, 0});
  expectCorners(cornersAt(square, 0), {{0, 0, 2}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  const int input = square.floats({0, 1}, 1), output = square.floats({1, 0, 0, 1}, 1);
  square.root["animations"] = {
      {{"samplers", {{{"input", input}, {"output", output}}}},
       {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}}}};
  expectCorners(cornersAt(square, 0.75), {{0, 0, 1}, {7, 0, 0}, {1, 1, 0}, {0, 1, 0}});
}

TEST(GltfPose, SkinsMoveWithTheMeanOfTheirJointsWhereverTheirNodeStands) {
  Square square;
  square.attribute("JOINTS_0", {0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 9, 0, 0}, 4)
      .attribute("WEIGHTS_0", {1, 0, 0, 0, 0, 1, 0, 0, 0.5, 0.5, 0, 0, 1, 1, 0, 0}, 4);
  const int undo = square.matrices({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0,  0, 0, 1,  //
                                    1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 1});
  square.root["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"translation", {5, 5, 5}}},
                          {{"children", {2}}, {"translation", {0, 0, 1}}},
                          {{"translation", {1, 0, 2}}, {"scale", {3, 3, 3}}}};
  square.set("/scenes/0/nodes", {0, 1}).set("/skins", {{{"joints", {1, 2}}, {"inverseBindMatrices", undo}}});
  std::string told;
  // The first joint adds (0, 0, 1); the second moves by (-1, 0, 0), makes three times as large, and adds (1,
  // 0, 3).
  expectCorners(cornersAt(square, 0, &told), {{0, 0, 1}, {1, 0, 3}, {1, 2, 2}, {0, 1, 1}});
  EXPECT_NE(told.find("joints of points that their skin does not have are left out: 1"), told.npos) << told;
}

TEST(GltfPose, CopiesStandWhereTheyAreSaidTo) {
  Square square;
  const int to = square.floats({0, 0, 0, 5, 0, 0}, 3), size = square.floats({1, 1, 1, 2, 2, 2}, 3);
  square.set("/nodes/0/translation", {0, 0, 7});
  square.root["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {{"TRANSLATION", to},
                                                                                    {"SCALE", size}};
  expectCorners(cornersAt(square, 0), {{0, 0, 7},
                                       {1, 0, 7},
                                       {1, 1, 7},
                                       {0, 1, 7},  //
                                       {5, 0, 7},
                                       {7, 0, 7},
                                       {7, 2, 7},
                                       {5, 2, 7}});
  Messages messages;
  const Scene scene = readScene("a.gltf", square.text(), messages, 0.0);
  EXPECT_EQ(scene.objects[0].shape.as<Mesh>()->data, scene.objects[1].shape.as<Mesh>()->data) << "shared";
}

TEST(GltfPose, WhatIsWrongIsAnError) {
  const auto errorOf = [](const Square& square) -> std::string {
    Messages messages;
    try {
      readScene("a.gltf", square.text(), messages, 0.0);
    } catch (const Error& error) {
      return error.messages().front().what;
    }
    return messages.all().empty() ? "" : messages.all().front().what;
  };
  Square few = Square();
  few.attribute("JOINTS_0", {0, 0, 0, 0}, 4).attribute("WEIGHTS_0", {1, 0, 0, 0}, 4);
  few.set("/nodes/0/skin", 0).set("/skins", {{{"joints", {0}}}});
  EXPECT_EQ(errorOf(few), "JOINTS_0: expected four joints and weights for each point");
  Square target;
  target.primitive()["targets"] = {{{"POSITION", target.floats({1, 2, 3}, 3)}}};
  target.set("/meshes/0/weights", {1});
  EXPECT_EQ(errorOf(target), "a morph target's POSITION: expected one vector for each point");
  EXPECT_EQ(errorOf(animated("translation", {1, 2, 3}, 3, "LINEAR")),
            "an animation: expected 3 numbers for each key; no animation is played");
  EXPECT_EQ(errorOf(Square().set("/nodes/0/skin", 3)), "nodes[0].skin: the file has no skins, found 3");
  EXPECT_EQ(
      errorOf(animated("translation", {1, 2, 3, 4, 5, 6}, 3, "LINEAR")
                  .set("/animations/0/channels/0/sampler", 7)),
      "animations[0].channels[0].sampler: expected a number of one of its samplers; no animation is played");
}

TEST(GltfFile, ABinaryOneThatIsWrittenAnewKeepsItsBody) {
  const std::vector<Vec3> corners = cornersAt(Square(), 0);
  const Square broken = animated("translation", {1, 2, 3, 4, 5, 6}, 3, "LINEAR")
                            .set("/animations/0/channels/0/sampler", 7);  // the animation is left out
  Square picture;
  const std::string uri = picture.root["images"][0]["uri"];
  picture.set("/images/0/uri", "data:image/x-portable;base64," + uri.substr(uri.find(',') + 1));
  for (const Square& square : {broken, picture}) expectCorners(cornersAt(square, 0, nullptr, true), corners);
}

}  // namespace
}  // namespace trace::gltf_pose_test
