// Which sides of surfaces files of other formats show.
#include <gtest/gtest.h>

#include <string>

#include "formats/format.h"
#include "formats/model.h"

namespace trace::sides_test {
namespace {

ShadedSides sidesOf(const std::string& file, const std::string& bytes) {
  Messages messages;
  const Scene scene = readScene(file, bytes, messages);
  return scene.materials.at(scene.objects.at(0).material).sides;
}

std::string gltf(const std::string& material) {
  return R"({"asset": {"version": "2.0"}, "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
"materials": [{)" +
         material +
         R"(}], "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
"bufferViews": [{"buffer": 0, "byteLength": 36}],
"buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
}

TEST(Sides, AMeshFileByItselfShowsBoth) {
  EXPECT_EQ(sidesOf("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), ShadedSides::both);
  EXPECT_EQ(sidesOf("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"), ShadedSides::both);
  EXPECT_EQ(sidesOf("a.ply",
                    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                    "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
                    "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"),
            ShadedSides::both);
  EXPECT_EQ(sidesOf("a.stl",
                    "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
                    "endloop\nendfacet\nendsolid a\n"),
            ShadedSides::both);
}

TEST(Sides, GltfSaysWhich) {
  EXPECT_EQ(sidesOf("a.gltf", gltf("")), ShadedSides::front);
  EXPECT_EQ(sidesOf("a.gltf", gltf("\"doubleSided\": false")), ShadedSides::front);
  EXPECT_EQ(sidesOf("a.gltf", gltf("\"doubleSided\": true")), ShadedSides::both);
}

TEST(Sides, ASceneSaysWhich) {
  const std::string header = "SBT-raytracer 1.0 sphere { material = { ";
  EXPECT_EQ(sidesOf("a.ray", header + "} }"), ShadedSides::front);
  EXPECT_EQ(sidesOf("a.ray", header + "sides = both; } }"), ShadedSides::both);
}

TEST(Sides, OfTheKindTrace1AreBoth) {
  EXPECT_EQ(sidesOf("a.ray", "Trace 1\nbox { }"), ShadedSides::both);
  EXPECT_EQ(sidesOf("a.ray", "Trace 1\nbox { material = { diffuse = (1, 0, 0) } }"), ShadedSides::both);
  EXPECT_EQ(sidesOf("a.ray", "Trace 1\nbox { material = { library = oak } }"), ShadedSides::both);
  EXPECT_EQ(sidesOf("a.ray", "Trace 1\nbox { material = { model = ward } }"), ShadedSides::both);
  EXPECT_EQ(sidesOf("a.ray", "Trace 1\nbox { material = { library = oak; sides = front } }"),
            ShadedSides::front);
}

TEST(Sides, OfAnObjectOfWhichNothingIsGivenAreThoseOfAGreyOne) {
  Messages messages;
  const Scene scene = readScene("a.ray", "Trace 1\nbox { }", messages);
  EXPECT_EQ(scene.materials.at(scene.objects.at(0).material).model, plainMaterial().model);
}

}  // namespace
}  // namespace trace::sides_test
