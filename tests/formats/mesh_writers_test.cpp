// Meshes written as PLY and OBJ read back as they were, in world space.
#include "formats/mesh/mesh_writers.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "base/files/file.h"
#include "geometry/mesh/mesh.h"
#include "mesh_helpers.h"
#include "support/paths.h"

namespace trace::mesh_writers_test {
namespace {

const std::string kScene = R"(SBT-raytracer 1.0
plane { }
material = { diffuse = (1, 0, 0); }
translate(1, 0, 0, scale(-2, 1, 1, mesh { name = part; points = ((0,0,0), (1,0,0), (0,1,0.1)); faces = ((0, 1, 2));
  normals = ((0,0,1), (0,0,1), (0.6,0,0.8)); texture_uv = ((0,0), (1,0), (0,0.25)); }))
)";

Scene scene(const std::string& text) {
  Messages messages;
  return readScene("in.ray", text, messages);
}

Scene throughPly(const Scene& from, bool ascii) {
  Messages messages;
  const auto files = writePly(from, "out.ply", {.ascii = ascii}, messages);
  return readScene("out.ply", files.at(0).bytes, messages);
}

TEST(MeshWriters, PlyHasTheMeshInTheWorld) {
  for (const bool ascii : {false, true}) {
    const Scene back = throughPly(scene(kScene), ascii);
    const MeshData& mesh = meshOf(back);
    EXPECT_EQ(mesh.points, (std::vector<Vec3f>{{1, 0, 0}, {-1, 0, 0}, {1, 1, 0.1f}}));
    EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 2, 1}})) << "mirrored";
    EXPECT_EQ(mesh.uvs.at(2).y, 0.25);
    EXPECT_LT(mesh.normals.at(2).x, 0);
    EXPECT_TRUE(mesh.materials.empty());
  }
}

TEST(MeshWriters, PlyHasColoursOfSeveralMaterials) {
  const Scene back = throughPly(
      scene(kScene + "mesh { points = ((0,0,5), (1,0,5), (0,1,5)); faces = ((0,1,2)); material = { "
                     "diffuse = (0, 1, 0.2); } }"),
      false);
  const MeshData& mesh = meshOf(back);
  ASSERT_EQ(mesh.materials.size(), 6u);
  EXPECT_EQ(back.materials.at(mesh.materials[5]).model.as<Phong>()->diffuse, Color(0, 1, 0.2));
  EXPECT_EQ(mesh.normals.size(), 6u) << "flat ones for the mesh without";
  EXPECT_TRUE(mesh.uvs.empty()) << "not all meshes have them";
}

TEST(MeshWriters, OtherShapesBecomeTrianglesUnlessTheyHaveNoEnd) {
  Messages messages;
  const auto files =
      writeObj(scene("SBT-raytracer 1.0 sphere { } difference { cube { } sphere { } } plane { }"), "out.obj",
               {}, messages);
  ASSERT_EQ(messages.all().size(), 2u);
  EXPECT_EQ(messages.all()[0].what, "shapes other than meshes become triangles");
  EXPECT_EQ(messages.all()[1].what, "left out, as they cannot become triangles: 1 plane");
  const Scene back = readScene("out.obj", files.at(0).bytes, messages);
  ASSERT_EQ(back.objects.size(), 1u) << "of the same material, without names";
  EXPECT_GT(meshOf(back, 0).triangles.size(), 1000u);
  EXPECT_THROW(writePly(scene("SBT-raytracer 1.0 plane { }"), "out.ply", {}, messages), Error);
}

TEST(MeshWriters, ObjKeepsObjectsWithoutNamesApart) {
  const std::string triangle = "points = ((0,0,0), (1,0,0), (0,1,0)); faces = ((0, 1, 2));";
  const Scene from = scene("SBT-raytracer 1.0\nmesh { name = lid; " + triangle + " }\nmesh { " + triangle +
                           " }\nmesh { " + triangle + " }\n");
  Messages messages;
  const std::string bytes = writeObj(from, "out.obj", {}, messages).front().bytes;
  EXPECT_NE(bytes.find("\no lid\n"), std::string::npos);
  EXPECT_NE(bytes.find("\no object_2\n"), std::string::npos);
  EXPECT_NE(bytes.find("\no object_3\n"), std::string::npos);
}

TEST(MeshWriters, ObjKeepsObjectsAndMaterials) {
  Messages messages;
  const Scene from = readScene(test::sourceFolder() + "/tests/corpus/obj/rooms.obj", messages);
  const std::string folder = testing::TempDir() + "trace_obj_writer";
  std::filesystem::create_directories(folder);
  for (const NamedBytes& file : writeObj(from, folder + "/out.obj", {}, messages))
    writeFile(file.file, file.bytes);
  const Scene back = readScene(folder + "/out.obj", messages);
  std::filesystem::remove_all(folder);
  for (const Message& warning : messages.all())
    if (warning.what.find("texture") == std::string::npos && warning.what != "points and lines are left out")
      ADD_FAILURE() << toString(warning);
  ASSERT_EQ(back.objects.size(), from.objects.size());
  for (std::size_t i = 0; i < from.objects.size(); ++i) {
    EXPECT_EQ(back.objects[i].name, from.objects[i].name);
    EXPECT_EQ(meshOf(back, i), meshOf(from, i));
    EXPECT_EQ(back.materials.at(back.objects[i].material).name,
              from.materials.at(from.objects[i].material).name);
    EXPECT_NEAR(phongOf(back, i).diffuse.r, phongOf(from, i).diffuse.r, 1e-6);
    EXPECT_NEAR(phongOf(back, i).transmissive.g, phongOf(from, i).transmissive.g, 1e-6);
    EXPECT_EQ(phongOf(back, i).index, phongOf(from, i).index);
  }
}

/// What OBJ and PLY can say of textures is kept, of the rest is told.
TEST(MeshWriters, KeepPicturesThatLieAsTheCoordinatesHaveThem) {
  struct Written {
    std::string material, header, warnings;
  };
  const auto write = [](std::initializer_list<const char*> textures) {
    std::string text = "SBT-raytracer 1.0\n";
    for (const char* texture : textures)
      text +=
          "mesh { points = ((0,0,0), (1,0,0), (0,1,0)); texture_uv = ((0,0), (1,0), (0,1)); faces = "
          "((0,1,2)); "
          "material = { diffuse = " +
          std::string(texture) + "; } }\n";
    const Scene from = scene(text);
    Written written;
    Messages messages;
    written.material = writeObj(from, "out.obj", {}, messages).at(1).bytes;
    const std::string ply = writePly(from, "out.ply", {}, messages).at(0).bytes;
    written.header = ply.substr(0, ply.find("element"));
    for (const Message& message : messages.all()) written.warnings += message.what + "\n";
    return written;
  };
  const auto has = [](const std::string& text, const std::string& part) {
    return text.find(part) != text.npos;
  };

  const Written one = write(
      {"texture(image { file = \"a b.png\"; })", "texture(image { file = \"a b.png\"; }, (0.5, 0.25, 1))"});
  EXPECT_TRUE(has(one.material, "Kd 0.5 0.25 1\n")) << one.material;
  EXPECT_TRUE(has(one.material, "map_Kd a b.png\n")) << one.material;
  EXPECT_TRUE(has(one.header, "comment TextureFile a b.png\n")) << one.header;
  EXPECT_EQ(one.warnings, "");

  const Written two = write({"texture(image { file = \"a.png\"; })", "texture(image { file = \"b.png\"; })"});
  EXPECT_TRUE(has(two.material, "map_Kd a.png\n") && has(two.material, "map_Kd b.png\n")) << two.material;
  EXPECT_FALSE(has(two.header, "TextureFile")) << two.header;
  EXPECT_EQ(two.warnings,
            "the pictures are left out: a PLY file has one for all of it, which is not decoded\n");

  const Written decoded = write({"texture(image { file = \"a.png\"; srgb = true; })"});
  EXPECT_TRUE(has(decoded.material, "map_Kd -colorspace sRGB a.png\n")) << decoded.material;
  EXPECT_FALSE(has(decoded.header, "TextureFile")) << decoded.header;

  const Written clamped = write({"map(\"a.png\"); opacity = map(\"holes.png\")"});
  EXPECT_TRUE(has(clamped.material, "map_Kd -clamp on a.png\n")) << clamped.material;
  EXPECT_TRUE(has(clamped.material, "Kd 1 1 1\n") && !has(clamped.material, "Tf")) << clamped.material;
  EXPECT_TRUE(has(clamped.warnings, "textures of 1 material")) << "the holes are lost";

  // Shapes that become triangles have coordinates where a picture lies on them.
  Messages messages;
  const std::string picture = "{ material = { diffuse = texture(image { file = \"a.png\"; }); } }";
  const std::string ball =
      writeObj(scene("SBT-raytracer 1.0 sphere " + picture), "out.obj", {}, messages).at(0).bytes;
  EXPECT_TRUE(has(ball, "\nvt ")) << "a ball";
  EXPECT_FALSE(
      has(writeObj(scene("SBT-raytracer 1.0 sphere { }"), "out.obj", {}, messages).at(0).bytes, "\nvt "));
  EXPECT_TRUE(has(writePly(scene("SBT-raytracer 1.0 torus " + picture), "out.ply", {}, messages).at(0).bytes,
                  "comment TextureFile a.png\n"));

  for (const char* other : {"checker { }", "texture(image { file = \"a.png\"; channel = red; })",
                            "texture(image { file = \"a.png\"; transform = (2, 0, 0, 0, 2, 0); })",
                            "texture(image { file = \"a.png\"; translate = (1, 0, 0); })"}) {
    const Written none = write({other});
    EXPECT_FALSE(has(none.material, "map_Kd")) << other;
    EXPECT_FALSE(has(none.header, "TextureFile")) << other;
    EXPECT_TRUE(has(none.warnings, "textures of 1 material")) << other;
  }
}

}  // namespace
}  // namespace trace::mesh_writers_test
