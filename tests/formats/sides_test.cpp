// Which sides of surfaces files of other formats show.
#include <gtest/gtest.h>

#include <string>

#include "formats/format.h"

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

}  // namespace
}  // namespace trace::sides_test
