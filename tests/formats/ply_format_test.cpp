// PLY files: every encoding and type gives the same mesh, and what is wrong is told.
#include "formats/mesh/ply_format.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <filesystem>

#include "base/files/file.h"
#include "geometry/mesh/mesh.h"
#include "mesh_helpers.h"
#include "support/paths.h"
#include "support/random.h"

namespace trace::ply_format_test {
namespace {

constexpr const char* kSquare = R"(ply
format ascii 1.0
comment four points
element vertex 4
property float x
property float y
property float z
element face 1
property list uchar int vertex_indices
end_header
0 0 0
1 0 0
1 1 0
0 1 0.5
4 0 1 2 3
)";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

/// Appends a number as the bytes of a type.
template <class T>
void append(std::string& bytes, T value, bool big) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  if (big) std::reverse(raw, raw + sizeof value);
  bytes.append(raw, sizeof value);
}

/// The square with numbers of these types, between others.
template <class Number, class Count, class Index>
std::string binarySquare(const std::string& number, const std::string& count, const std::string& index,
                         bool big) {
  std::string bytes = "ply\nformat binary_" + std::string(big ? "big" : "little") +
                      "_endian 1.0\nelement vertex 4\nproperty uchar flags\nproperty " + number +
                      " z\nproperty " + number + " x\nproperty short more\nproperty " + number +
                      " y\nelement face 1\nproperty uchar flags\nproperty list " + count + " " + index +
                      " vertex_index\nproperty float quality\nelement edge 1\nproperty int a\nend_header\n";
  const double points[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  for (const auto& p : points) {
    append<std::uint8_t>(bytes, 7, big);
    append(bytes, static_cast<Number>(p[2]), big);
    append(bytes, static_cast<Number>(p[0]), big);
    append<std::int16_t>(bytes, -3, big);
    append(bytes, static_cast<Number>(p[1]), big);
  }
  append<std::uint8_t>(bytes, 7, big);
  append(bytes, static_cast<Count>(4), big);
  for (int i = 0; i < 4; ++i) append(bytes, static_cast<Index>(i), big);
  append(bytes, 1.0f, big);
  append(bytes, std::int32_t{5}, big);
  return bytes;
}

TEST(Ply, ReadsText) {
  const Scene scene = sceneIn(kSquare);
  const MeshData& mesh = meshOf(scene);
  EXPECT_EQ(scene.format, "ply");
  EXPECT_EQ(mesh.points, (std::vector<Vec3f>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.5f}}));
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_TRUE(mesh.normals.empty() && mesh.materials.empty() && mesh.uvs.empty());
}

TEST(Ply, ReadsEveryTypeInBothByteOrders) {
  const MeshData expected = meshOf(sceneIn(replaced(kSquare, "0.5", "0")));
  for (const bool big : {false, true}) {
    EXPECT_EQ(meshOf(sceneIn(binarySquare<float, std::uint8_t, std::int32_t>("float", "uchar", "int", big))),
              expected);
    EXPECT_EQ(
        meshOf(sceneIn(binarySquare<double, std::int8_t, std::uint32_t>("float64", "char", "uint32", big))),
        expected);
    EXPECT_EQ(
        meshOf(sceneIn(binarySquare<std::int8_t, std::int32_t, std::uint8_t>("int8", "int", "uchar", big))),
        expected);
    EXPECT_EQ(meshOf(sceneIn(binarySquare<std::uint16_t, std::uint16_t, std::int16_t>("ushort", "ushort",
                                                                                      "short", big))),
              expected);
  }
}

TEST(Ply, ReadsNormalsColoursAndCoordinates) {
  const Scene scene = sceneIn(R"(ply
format ascii 1.0
element vertex 3
property double s
property double t
property uchar red
property uchar green
property uchar blue
property uchar alpha
property float x
property float y
property float z
property float nx
property float ny
property float nz
element face 1
property list uchar uint vertex_index
end_header
0 0   255 0 0 9    0 0 0  0 0 1
1 0   0 255 0 9    1 0 0  0 0 1
0 .5  255 0 0 9    0 1 0  0 0 1
3 0 1 2
)");
  const MeshData& mesh = meshOf(scene);
  EXPECT_EQ(mesh.normals, std::vector<Vec3f>(3, {0, 0, 1}));
  EXPECT_EQ(mesh.uvs, (std::vector<Vec2>{{0, 0}, {1, 0}, {0, 0.5}}));
  ASSERT_EQ(mesh.materials.size(), 3u);
  EXPECT_EQ(mesh.materials[0], mesh.materials[2]);
  const auto diffuse = [&](std::size_t point) {
    return scene.materials.at(mesh.materials[point]).model.as<Phong>()->diffuse;
  };
  EXPECT_EQ(diffuse(0), Color(1, 0, 0));
  EXPECT_EQ(diffuse(1), Color(0, 1, 0));
}

TEST(Ply, ReadsStripsAndPolygonsWithDents) {
  const MeshData strip = meshOf(sceneIn(R"(ply
format ascii 1.0
element vertex 4
property float x
property float y
property float z
element tristrips 1
property list int int vertex_indices
end_header
0 0 0  1 0 0  0 1 0  1 1 0
8  0 1 2 3 -1 0 1 3
)"));
  EXPECT_EQ(strip.triangles, (std::vector<Triangle>{{0, 1, 2}, {1, 3, 2}, {0, 1, 3}}));

  // An arrow head: a fan from its first corner would cover the notch.
  const MeshData dent =
      meshOf(sceneIn(replaced(replaced(kSquare, "0 1 0.5", "0.9 0.1 0"), "1 0 0\n1 1 0", "1 1 0\n1 0 0")));
  double area = 0;
  for (std::uint32_t i = 0; i < dent.triangles.size(); ++i) area += faceNormal(dent, i).z / 2;
  for (std::uint32_t i = 0; i < dent.triangles.size(); ++i) EXPECT_LT(faceNormal(dent, i).z, 0) << i;
  EXPECT_EQ(dent.triangles.size(), 2u);
  EXPECT_NEAR(area, -0.45, 0.36);
}

TEST(Ply, SaysWhatIsWrong) {
  const std::pair<std::string, const char*> cases[] = {
      {"ply\n", "1:1: expected \"end_header\", found the end of the file"},
      {"ply\nformat binary 1\n", "2:1: expected format ascii, binary_little_endian or binary_big_endian"},
      {"ply\nelement vertex -4\n", "2:1: expected a number of elements, found \"-4\""},
      {"ply\nelement vertex 4\nproperty int3 x\n",
       "3:1: expected a type, as in float or uchar, found \"int3\""},
      {"ply\nproperty float x\n", "2:1: expected an element before its properties"},
      {"ply\npropert\n",
       "2:1: expected a line of a PLY header (format, element, property, comment or end_header), found "
       "\"propert\""},
      {replaced(kSquare, "float y", "float why"), "0:0: expected vertices with x, y and z"},
      {replaced(kSquare, "face 1", "edge 1"),
       "0:0: expected an element \"face\" or \"tristrips\": this file holds points, and no surface"},
      {replaced(kSquare, "4 0 1 2 3", "4 0 1 2 4"),
       "15:1: face 0 uses point 4 but the mesh has 4 points, counted from 0"},
      {replaced(kSquare, "4 0 1 2 3", "3 0 1 -2"),
       "15:1: face 0 uses a number that no point has but the mesh has 4 points, counted from 0"},
      {replaced(kSquare, "4 0 1 2 3", "4 0 1"),
       "15:2: element \"face\": a list is longer than the rest of the file"},
      {replaced(kSquare, "0.5", "wide"), "14:1: point 3: expected three finite numbers of at most 3.4e38"},
      {replaced(kSquare, "vertex 4", "vertex 999999999999"),
       "11:1: expected 999999999999 of element \"vertex\", but the file has bytes for at most 6"},
      {replaced(kSquare, "face 1", "face 99999"),
       "14:8: expected 99999 of element \"face\", but the file has bytes for at most 6"},
      {replaced(kSquare, "4 0 1 2 3", "4000000 0 1 2 3"),
       "15:8: element \"face\": a list is longer than the rest of the file"},
  };
  for (const auto& [text, message] : cases) EXPECT_EQ(errorsOfFile(text), message) << text;
}

TEST(Ply, WarnsOfWhatIsRepaired) {
  EXPECT_EQ(warningsOfFile(replaced(kSquare, "face 1", "face 2") + "3 0 1 1\n"),
            "16:1: triangles without area are left out: 1");
  EXPECT_EQ(warningsOfFile(replaced(kSquare, "face 1", "face 2") + "2 0 1\n"),
            "16:1: faces of fewer than 3 points are left out: 1");
}

TEST(Ply, ReadsALargeMesh) {
  const std::string file = test::sharedFolder() + "/meshes/dragon.ply";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "SKIPPED: needs " << file;
  Messages messages;
  const Model model = readModel(file, readFile(file), messages);
  const MeshData& mesh = *model.objects.at(0).shape.as<Mesh>()->data;
  EXPECT_EQ(mesh.points.size(), 437645u);
  EXPECT_EQ(mesh.triangles.size() + 108, 871414u) << "all but those without area";
}

}  // namespace
}  // namespace trace::ply_format_test
