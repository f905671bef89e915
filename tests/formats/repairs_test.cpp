// What is wrong in a file costs what uses it, and no more, with one counted warning and its place; and names
// of files lead nowhere that a scene may not read.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>

#include "base/files/file.h"
#include "base/files/read_scope.h"
#include "formats/format.h"
#include "formats/gltf_square.h"
#include "geometry/mesh/mesh.h"
#include "support/folder.h"

namespace trace::repairs_test {
namespace {

namespace fs = std::filesystem;

struct Read {
  Scene scene;
  std::string warnings, error;  ///< placeText: what, a line each

  Read(const std::string& file, const std::string& bytes) {
    Messages messages;
    try {
      scene = readScene(file, bytes, messages);
    } catch (const Error& e) {
      for (const Message& m : e.messages()) error += line(m);
    }
    for (const Message& m : messages.all()) warnings += line(m);
  }
  static std::string line(const Message& m) {
    return std::to_string(m.place.line) + ":" + std::to_string(m.place.column) + ": " + m.what + "\n";
  }
  std::size_t triangles() const {
    std::size_t count = 0;
    for (const Object& object : scene.objects)
      if (const auto* mesh = object.shape.as<Mesh>()) count += mesh->data->triangles.size();
    return count;
  }
  bool warns(const std::string& part) const { return warnings.find(part) != std::string::npos; }
};

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(Repairs, ObjLinesAsOthersWriteThem) {
  for (const char* rest : {"f 1 2 3 4 # all\n", "f 1 2 3 4;\n", "f 1 2 3 4 ; a comment\n", "f 1/ 2/ 3/ 4/\n",
                           "f 1// 2// 3// 4//\n", "F 1 2 3 4\n", "\tf 1 2 3 4", "f -4 -3 -2 -1\n"}) {
    const Read read("a.obj", kSquare + rest);
    EXPECT_EQ(read.triangles(), 2u) << rest << read.error << read.warnings;
    EXPECT_EQ(read.warnings, "") << rest;
  }
  EXPECT_EQ(Read("a.obj", "V 0 0 0 # first\nV 1 0 0\nV 0 1 0\nF 1 2 3\n").triangles(), 1u);
  EXPECT_EQ(Read("a.obj", "f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n").triangles(), 1u)
      << "points that come later";
  const Read later("a.obj",
                   "f 1/1/1 2/2/1 3/3/1\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\n");
  EXPECT_EQ(later.warnings, "");
  const auto& mesh = *later.scene.objects.at(0).shape.as<Mesh>()->data;
  EXPECT_EQ(mesh.uvs.size(), 3u) << "uv that come later";
  EXPECT_EQ(mesh.normals.size(), 3u) << "normals that come later";
}

TEST(Repairs, TheFirstFaceOfAnObjIsNamedThatLacksAPoint) {
  const Read read("a.obj", "f 1 2 9\n" + kSquare + "f 1 2 8\nf -1 -2 -9\nf 1 2 3\n");
  EXPECT_TRUE(read.warns("1:7: the face uses point 9, but there are 4 points; it is left out (3 times"))
      << read.warnings;
  const Read smooth("a.obj", "s 1\nf 1 2 3\n" + kSquare + "s 2\nf 1 2 3\n");
  EXPECT_TRUE(smooth.warns("1:1: smoothing groups")) << smooth.warnings;
  const Read normals("a.obj", "f 1//1 2 3\n" + kSquare + "f 1//1 2 3\n");
  EXPECT_TRUE(normals.warns("1:3: normals or uv that the file does not have are left out (2 times"))
      << normals.warnings;
}

TEST(Repairs, AFaceOfAnObjCostsItself) {
  const Read read("a.obj", kSquare + "v nan 0 0\nf 1 2 3\nf 1 2 9\nf 2 3 9\nf 1 x 2\nf 1 2 5\nf 1 3 4\n");
  EXPECT_EQ(read.triangles(), 2u) << read.error;
  EXPECT_TRUE(read.warns("7:7: the face uses point 9, but there are 5 points; it is left out (2 times"))
      << read.warnings;
  EXPECT_TRUE(read.warns("9:5: expected a corner such as")) << read.warnings;
  EXPECT_TRUE(read.warns("5:3: expected a finite number")) << read.warnings;
  EXPECT_TRUE(Read("a.obj", kSquare + "f 1 2 9\n").error.starts_with("5:7: the face uses point 9"));
}

std::string ply(const std::string& elements, const std::string& body) {
  return "ply\nformat ascii 1.0\n" + elements + "end_header\n" + body;
}
const std::string kVertex = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
const std::string kFace = "property list uchar int vertex_indices\n";
const std::string kPoints = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

TEST(Repairs, PlyElementsInAnyOrderAndFacesThatAreLost) {
  EXPECT_EQ(
      Read("a.ply", ply("element face 2\n" + kFace + kVertex, "4 0 1 2 3\n3 0 1 2\n" + kPoints)).triangles(),
      3u);
  const Read lost("a.ply",
                  ply(kVertex + "element face 3\n" + kFace, kPoints + "3 0 1 9\n4 0 1 2 3\n3 0 1 -1\n"));
  EXPECT_EQ(lost.triangles(), 2u) << lost.error;
  EXPECT_TRUE(lost.warns("14:1: face 0 uses point 9")) << lost.warnings;
  EXPECT_TRUE(lost.warns("(2 times")) << lost.warnings;
  const Read more("a.ply", ply(kVertex + "element face 2\n" + kFace, kPoints + "3 0 1 2 7 7\n3 0 2 3 7\n"));
  EXPECT_EQ(more.triangles(), 2u) << more.error;
  EXPECT_TRUE(more.warns("14:1: expected as many values")) << more.warnings;
  const Read oneLine("a.ply", ply(kVertex + "element face 1\n" + kFace, "0 0 0 1 0 0 1 1 0 0 1 0 4 0 1 2 3"));
  EXPECT_EQ(oneLine.triangles(), 2u) << "rows need no lines of their own";
  EXPECT_EQ(Read("a.ply",
                 "PLY\nFORMAT ASCII 1.0\nELEMENT VERTEX 3\nPROPERTY FLOAT X\nPROPERTY FLOAT Y\nPROPERTY "
                 "FLOAT Z\nELEMENT FACE 1\nPROPERTY LIST UCHAR INT VERTEX_INDICES\nEND_HEADER\n0 0 0 1 0 "
                 "0 0 1 0\n3 0 1 2\n")
                .triangles(),
            1u);
}

TEST(Repairs, PlyHeadersMayNameTheirProgramWithoutComment) {
  const std::string rest =
      "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  const Read read("a.ply", "ply\nformat ascii 1.0\nCreated by hand\n" + rest);
  EXPECT_EQ(read.triangles(), 1u) << read.error;
  EXPECT_EQ(read.warnings, "3:1: a line of the header is no comment, and is ignored: \"Created\"\n");
  const Read misspelt("a.ply", "ply\nformat ascii 1.0\nelemant edge 0\n" + rest);
  EXPECT_EQ(misspelt.error.find("3:1: expected a line of a PLY header"), 0u) << misspelt.error;
}

TEST(Repairs, PlyFacesHaveColoursAndUvOfTheirOwn) {
  const Read colored("a.ply", ply(kVertex + "element face 2\n" + kFace +
                                      "property uchar red\nproperty uchar green\nproperty uchar blue\n",
                                  kPoints + "3 0 1 2 255 0 0\n3 0 2 3 0 0 255\n"));
  ASSERT_EQ(colored.triangles(), 2u) << colored.error;
  const MeshData& mesh = *colored.scene.objects[0].shape.as<Mesh>()->data;
  ASSERT_EQ(mesh.materials.size(), 6u);
  const auto diffuse = [&](std::size_t corner) {
    const std::uint32_t point = mesh.triangles[corner / 3][corner % 3];
    return phongOf(colored.scene.materials.at(mesh.materials[point]).model).diffuse;
  };
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(diffuse(i), i < 3 ? Color(1, 0, 0) : Color(0, 0, 1)) << i;

  const Read mapped("a.ply",
                    ply(kVertex + "element face 1\n" + kFace + "property list uchar float texcoord\n",
                        kPoints + "4 0 1 2 3 8 0 0 0.5 0 0.5 0.5 0 0.5\n"));
  const MeshData& uvs = *mapped.scene.objects.at(0).shape.as<Mesh>()->data;
  EXPECT_EQ(uvs.uvs.at(uvs.triangles[0][1]), (Vec2{0.5, 0}));
  EXPECT_TRUE(Read("a.ply", ply("element edge 1\nproperty int a\n" + kVertex + "element face 1\n" + kFace,
                                "7\n" + kPoints + "3 0 1 2\n"))
                  .warns("elements \"edge\" are not shown: 1"));
}

TEST(Repairs, OffFacesHaveColoursAndCostThemselves) {
  const std::string off = "OFF\n4 2 0\n" + kPoints;
  const Read colored("a.off", off + "3 0 1 2 255 0 0\n3 0 2 3 0 0 255\n");
  EXPECT_EQ(colored.scene.materials.size(), 3u) << "two colours, and the plain one";
  const Read lost("a.off", off + "3 0 1 9\n3 0 2 3\n");
  EXPECT_EQ(lost.triangles(), 1u) << lost.error;
  EXPECT_TRUE(lost.warns("7:7: face 0: expected a point from 0 to 4 - 1, found 9")) << lost.warnings;
}

TEST(Repairs, PointsThatAreNotFiniteCostTheirTriangles) {
  const Read read("a.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n3 0 1 3\n");
  EXPECT_EQ(read.triangles(), 1u) << read.error;
  EXPECT_TRUE(read.warns("triangles that use such points are left out: 1")) << read.warnings;
}

TEST(Repairs, ABrokenFacetOfStlCostsNoOther) {
  const std::string good =
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
  for (const auto& [from, to] : {std::pair{"1 0 0", "1 0 banana"},
                                 {"1 0 0", "1 0"},
                                 {"vertex 0 1 0\n", ""},
                                 {"endloop", "vertex 1 1 0\nendloop"},
                                 {"0 1 0\n", "0\n"},
                                 {"normal ", ""}}) {
    std::string broken = good;
    broken.replace(broken.find(from), std::string_view(from).size(), to);
    const Read read("a.stl", "solid a\n" + good + broken + broken + good + "endsolid a\n");
    EXPECT_EQ(read.triangles(), 2u) << to << read.error;
    EXPECT_TRUE(read.warns("are left out: 2, the first here: expected")) << read.warnings;
    EXPECT_NE(Read("a.stl", "solid a\n" + broken + "endsolid a\n").error, "") << "nothing is left";
    EXPECT_NE(Read("a.stl", "solid a\n" + good + broken.substr(0, broken.size() - 12)).error, "")
        << "cut off";
  }
}

TEST(Repairs, FlawsOfStlHaveALine) {
  const auto facet = [](const std::string& last) {
    return "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex " + last +
           "\nendloop\nendfacet\n";
  };
  const Read flat("a.stl", "solid\n" + facet("0 1 0") + facet("2 0 0") + "endsolid\n");
  EXPECT_EQ(flat.warnings, "9:1: triangles without area are left out: 1\n");
  const Read turned("a.stl", "solid\n" + facet("0 1 0") + facet("0 -1 0") + "endsolid\n");
  EXPECT_EQ(turned.warnings.find("9:1: facets whose corners"), 0u) << turned.warnings;
}

TEST(Repairs, StlOfAnySpellingIsTurnedAsItsNormalsSay) {
  const std::string facet =
      "facet normal 0 0 -1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
  std::string upper = "solid a\n" + facet + "endsolid a\n";
  for (char& c : upper) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  for (const std::string& text : {"solid a\n" + facet + "endsolid a\n", facet + "endsolid\n", upper}) {
    const Read read("a.stl", text);
    ASSERT_EQ(read.triangles(), 1u) << text << read.error;
    EXPECT_TRUE(read.warns("are turned: 1")) << read.warnings;
    EXPECT_LT(faceNormal(*read.scene.objects[0].shape.as<Mesh>()->data, 0).z, 0);
  }
}

// --- one rule for all readers -----------------------------------------------------------------------------

/// The bytes of numbers, with the lowest byte first.
template <class... Numbers>
std::string bytesOf(Numbers... numbers) {
  std::string bytes;
  (bytes.append(reinterpret_cast<const char*>(&numbers), sizeof numbers), ...);
  return bytes;
}

/// Two facets, the second flat.
std::string binaryStl() {
  std::string stl = std::string(80, ' ') + bytesOf(std::uint32_t{2});
  for (const float y : {1.0f, 0.0f})
    stl += bytesOf(0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 2.0f, y, 0.0f, std::uint16_t{0});
  return stl;
}

/// Two triangles in binary PLY, the second flat, with the numbers of point 1.
std::string binaryPly(float x, float normal) {
  std::string ply = "ply\nformat binary_little_endian 1.0\nelement vertex 4\n";
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz"})
    ply += "property float " + std::string(name) + "\n";
  ply += "element face 2\nproperty list uchar int vertex_indices\nend_header\n";
  const std::string up = bytesOf(0.0f, 0.0f, 1.0f);
  ply += bytesOf(0.0f, 0.0f, 0.0f) + up + bytesOf(x, 0.0f, 0.0f, 0.0f, 0.0f, normal);
  ply += bytesOf(1.0f, 1.0f, 0.0f) + up + bytesOf(0.0f, 1.0f, 0.0f) + up;
  for (const auto& [a, b, c] : {std::array{0, 2, 3}, std::array{0, 1, 1}}) ply += bytesOf('\3', a, b, c);
  return ply;
}

std::string gltfWith(const std::string& attribute, const std::vector<float>& numbers, int each) {
  return test::Square().attribute(attribute, numbers, each).text();
}

TEST(Repairs, EveryFlawOfEveryReaderHasAPlace) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  const std::string lines = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
  const auto pointsWith = [&](const std::string& properties, const std::string& rows) {
    std::string all = lines;
    for (const char name : properties) all += std::string("property float ") + name + "\n";
    return ply(all + "element face 1\n" + kFace, rows + "4 0 1 2 3\n");
  };
  const auto normals = [](std::string text) {
    const std::string from = "property float n\nproperty float m\nproperty float o\n";
    text.replace(text.find(from), from.size(), "property float nx\nproperty float ny\nproperty float nz\n");
    return text;
  };
  test::Square flat;
  flat.primitive()["indices"] = flat.bytes(std::string("\0\1\2\0\0\1", 6), 5121, 6, "SCALAR");
  test::Square missing;
  missing.primitive()["indices"] = missing.bytes(std::string("\0\1\2\0\1\7", 6), 5121, 6, "SCALAR");
  const std::string first = " in meshes[0].primitives[0]";
  struct Case {
    std::string file, bytes, expected;
  };
  const std::vector<Case> cases = {
      // triangles without area
      {"a.obj", kSquare + "f 1 2 3\nf 1 1 2\nf 2 2 3\n", "6:1: triangles without area are left out: 2\n"},
      {"a.off", "OFF\n4 3 0\n" + kPoints + "3 0 1 2\n3 0 0 1\n3 1 1 2\n",
       "8:1: triangles without area are left out: 2\n"},
      {"a.ply", ply(kVertex + "element face 2\n" + kFace, kPoints + "3 0 1 2\n3 1 1 2\n"),
       "15:1: triangles without area are left out: 1\n"},
      {"a.ply", binaryPly(1, 1), "triangles without area are left out: 1, first at byte 332 of the file\n"},
      {"a.stl", binaryStl(), "triangles without area are left out: 1, first at facet 1\n"},
      {"a.gltf", flat.text(), "triangles without area are left out: 1, first at triangle 1" + first},
      {"a.wrl",
       "#VRML V2.0 utf8\nShape { geometry\n IndexedFaceSet { coord Coordinate { point [0 0 0, 1 0 0, 0 1 0] "
       "}\n"
       " coordIndex [0 1 2 -1 0 0 1 -1] } }\n",
       "3:2: triangles without area are left out: 1\n"},
      // points that are not finite, and what uses them
      {"a.obj", kSquare + "v nan 0 0\nf 1 2 3\nf 1 2 5\n", "5:3: expected a finite number"},
      {"a.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 nan 0\n0 1 0\n3 0 1 3\n3 0 1 2\n",
       "5:1: points that are not three finite numbers of at most 3.4e38: 1\n8:1: triangles that use such "
       "points"},
      {"a.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 oops 0\n0 1 0\n3 0 1 3\n3 0 1 2\n",
       "5:3: expected a point's three numbers, found \"oops\""},
      {"a.ply", ply(kVertex + "element face 2\n" + kFace, "0 0 0\n1 0 0\n1 nan 0\n0 1 0\n3 0 1 3\n3 0 1 2\n"),
       "12:1: points that are not three finite numbers of at most 3.4e38: 1\n15:1: triangles that use such "
       "points"},
      {"a.ply",
       ply(kVertex + "element face 2\n" + kFace, "0 0 0\n1 0 0\n1 oops 0\n0 1 0\n3 0 1 3\n3 0 1 2\n"),
       "12:3: element \"vertex\": expected a number, found \"oops\""},
      {"a.ply", binaryPly(kNan, 1),
       ": 1, first at byte 247 of the file\n0:0: triangles that use such points are left out: 1, first at "
       "byte 332"},
      {"a.gltf", gltfWith("POSITION", {0, 0, 0, 1, 0, 0, 1, 1, 0, kNan, 1, 0}, 3),
       ": 1, first at element 3 of POSITION" + first +
           ", accessors[4]\n0:0: triangles that use such points are left "
           "out: 1, first at triangle 1" +
           first},
      // normals
      {"a.obj", kSquare + "vn 0 0 1\nvn nan 0 0\nf 1//1 2//1 3//2\n", "6:1: normals that are not finite"},
      {"a.obj", kSquare + "vn 0 0 1\nvn 0 0 0\nf 1//1 2//1 3//2\n", "6:1: normals of length 0"},
      {"a.off", "NOFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 nan 0 0\n0 1 0 0 0 1\n3 0 1 2\n",
       "4:1: normals that are not finite"},
      {"a.off", "NOFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 0 0 0\n0 1 0 0 0 1\n3 0 1 2\n", "4:1: normals of length 0"},
      {"a.ply", normals(pointsWith("nmo", "0 0 0 0 0 1\n1 0 0 0 0 nan\n1 1 0 0 0 0\n0 1 0 0 0 1\n")),
       "14:1: normals that are not finite are taken from the faces: 1\n15:1: normals of length 0"},
      {"a.ply", binaryPly(1, kNan),
       "normals that are not finite are taken from the faces: 1, first at byte 247 of"},
      {"a.gltf", gltfWith("NORMAL", {0, 0, 1, 0, 0, kNan, 0, 0, 0, 0, 0, 1}, 3),
       ": 1, first at element 1 of NORMAL" + first +
           ", accessors[4]\n0:0: normals of length 0 are taken from the "
           "faces: 1, first at element 2 of NORMAL"},
      // texture coordinates
      {"a.obj", kSquare + "vt 0 0\nvt nan 0\nf 1/1 2/1 3/2\n",
       "6:1: texture coordinates that are not finite"},
      {"a.off", "STOFF\n3 1 0\n0 0 0 0 0\n1 0 0 nan 0\n0 1 0 0 1\n3 0 1 2\n",
       "4:1: texture coordinates that are not finite become 0: 1\n"},
      {"a.ply", pointsWith("st", "0 0 0 0 0\n1 0 0 1 nan\n1 1 0 1 1\n0 1 0 0 1\n"),
       "13:1: texture coordinates that are not finite become 0: 1\n"},
      {"a.gltf", gltfWith("TEXCOORD_0", {0, 0, 1, 0, 1, kNan, 0, 1}, 2),
       "become 0: 1, first at element 2 of TEXCOORD_0" + first},
      // colours
      {"a.off", "COFF\n3 1 0\n0 0 0 1 0 0 1\n1 0 0 1 nan 0 1\n0 1 0 0 1 0 1\n3 0 1 2\n",
       "4:1: colours of points or faces that are not finite become white: 1\n"},
      {"a.ply", pointsWith("rgb", "0 0 0 0 0 1\n1 0 0 0 0 nan\n1 1 0 0 0 0\n0 1 0 0 0 1\n"),
       "14:1: colours of points or faces that are not finite become white: 1\n"},
      {"a.gltf", gltfWith("COLOR_0", {0, 0, 1, 0, 0, kNan, 0, 0, 0, 0, 0, 1}, 3),
       "become white: 1, first at element 1 of COLOR_0" + first},
      // points that are not there
      {"a.gltf", missing.text(), "are left out: 1, first at triangle 1" + first},
  };
  for (const Case& c : cases) {
    const Read read(c.file, c.bytes);
    EXPECT_EQ(read.error, "") << c.file << ": " << c.expected;
    EXPECT_TRUE(read.warns(c.expected)) << c.file << ": " << c.expected << "\nin\n" << read.warnings;
    EXPECT_GT(read.triangles(), 0u) << c.expected;
  }
}

// --- reading what was given
// ----------------------------------------------------------------------------------

class Reading : public testing::Test {
 protected:
  Reading() {
    for (const char* name : {"home", "secret"}) fs::create_directories(folder_ / name);
    writeFile(folder_ / "secret/a.obj", kSquare + "f 1 2 3\n");
    writeFile(folder_ / "secret/a.mtl", "newmtl m\nKd 1 0 0\n");
    writeFile(folder_ / "secret/a.bin", std::string(36, '\0'));
    writeFile(folder_ / "secret/a.wrl",
              "#VRML V2.0 utf8\nPROTO P [ ] { Shape { geometry Box { } } }\nShape { }\n");
    writeFile(folder_ / "secret/a.ppm", "P3 2 2 255 1 2 3 4 5 6 7 8 9 1 2 3");
    writeFile(folder_ / "home/inside.obj", kSquare + "mtllib ../secret/a.mtl\nusemtl m\nf 1 2 3\n");
  }
  std::string ray(const std::string& text) const { return "SBT-raytracer 1.0\n" + text; }

  const test::Folder folder_;
};

TEST_F(Reading, EveryReaderAsksAtTheOneDoor) {
  const std::string buffer =
      R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 36, "uri": "../secret/a.bin"}], "bufferViews": [{"buffer": 0,
          "byteLength": 36}], "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
          "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}], "nodes": [{"mesh": 0}]})";
  const std::pair<std::string, std::string> cases[] = {
      {"mesh.ray", ray("mesh { file = \"../secret/a.obj\"; }")},
      {"absolute.ray", ray("mesh { file = \"" + (folder_ / "secret/a.obj") + "\"; }")},
      {"texture.ray", ray("sphere { material = { diffuse = map(\"../secret/a.ppm\"); } }")},
      {"heights.ray", ray("height_field { file = \"../secret/a.ppm\"; }")},
      {"through.ray", ray("mesh { file = \"inside.obj\"; }")},
      {"materials.obj", kSquare + "mtllib ../secret/a.mtl\nusemtl m\nf 1 2 3\n"},
      {"buffer.gltf", buffer},
      {"inline.wrl", "#VRML V2.0 utf8\nInline { url \"../secret/a.wrl\" }\n"},
      {"extern.wrl", "#VRML V2.0 utf8\nEXTERNPROTO P [ ] \"../secret/a.wrl#P\"\nP { }\n"},
      {"texture.wrl",
       "#VRML V2.0 utf8\nShape { appearance Appearance { texture ImageTexture { url \"../secret/a.ppm\" } } "
       "geometry Box "
       "{ } }\n"},
      {"mesh.iv", "#Inventor V2.1 ascii\nFile { name \"../secret/a.wrl\" }\n"},
  };
  for (const auto& [name, text] : cases) {
    const std::string file = folder_ / ("home/" + name);
    const Read read(file, text);
    EXPECT_NE(read.error.find("outside the scene's folder"), std::string::npos)
        << name << ": " << read.error << read.warnings;
    const ReadScope allowed({folder_ / "secret"});
    const Read given(file, text);
    EXPECT_EQ(given.error.find("outside the scene's folder"), std::string::npos)
        << name << ": " << given.error;
  }
}

TEST_F(Reading, ExternProtoOfAFileBesideIt) {
  writeFile(folder_ / "home/lib.wrl",
            "#VRML V2.0 utf8\nPROTO Other [ ] { Shape { geometry Box { } } }\nPROTO Ball [ field SFColor c 1 "
            "1 1 ] { Shape { "
            "appearance Appearance { material Material { diffuseColor IS c } } geometry Sphere { } } }\n");
  const Read read(folder_ / "home/a.wrl",
                  "#VRML V2.0 utf8\nEXTERNPROTO Ball [ field SFColor c ] [ \"none.wrl\", \"lib.wrl#Ball\" "
                  "]\nBall { c 1 0 0 }\n");
  ASSERT_EQ(read.scene.objects.size(), 1u) << read.error << read.warnings;
  EXPECT_EQ(phongOf(read.scene.materials.at(read.scene.objects[0].material).model).diffuse, Color(1, 0, 0));
  writeFile(folder_ / "home/self.wrl", "#VRML V2.0 utf8\nEXTERNPROTO A [ ] \"self.wrl#A\"\nA { }\n");
  const Read self(folder_ / "home/self.wrl", readFile(folder_ / "home/self.wrl"));
  EXPECT_TRUE(self.warns("its nodes are left out")) << self.warnings << self.error;
}

TEST_F(Reading, NamesOfMaterialFiles) {
  writeFile(folder_ / "home/my mat.mtl", "NEWMTL a b\nKD 1 0 0\n");
  for (const char* names :
       {"my mat.mtl", "\"my mat.mtl\"", "My Mat.MTL", ".\\my mat.mtl", "my mat.mtl # comment"}) {
    const Read read(folder_ / "home/a.obj", kSquare + "mtllib " + names + "\nusemtl a b\nf 1 2 3\n");
    ASSERT_EQ(read.triangles(), 1u) << names;
    EXPECT_EQ(phongOf(read.scene.materials.at(read.scene.objects[0].material).model).diffuse, Color(1, 0, 0))
        << names << read.warnings;
  }
  const Read late(folder_ / "home/a.obj", kSquare + "usemtl a b\nf 1 2 3\nmtllib my mat.mtl\n");
  EXPECT_EQ(phongOf(late.scene.materials.at(late.scene.objects[0].material).model).diffuse, Color(1, 0, 0));
}

}  // namespace
}  // namespace trace::repairs_test
