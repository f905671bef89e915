// OFF, STL, OBJ and glTF files, and meshes that .ray scenes take from files.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "base/files/file.h"
#include "formats/model_textures.h"
#include "geometry/mesh/mesh.h"
#include "mesh_helpers.h"
#include "shading/lights/point_light.h"
#include "shading/lights/spot_light.h"
#include "shading/materials/principled.h"
#include "shading/textures/image_map.h"
#include "support/folder.h"
#include "support/paths.h"

namespace trace::mesh_formats_test {
namespace {

/// What a picture of a model becomes, on those fields.
std::vector<FieldTexture> pictureOn(std::initializer_list<const char*> fields, const std::string& file,
                                    bool srgb = false) {
  std::vector<FieldTexture> textures;
  ImageMap map = modelPicture(file);
  map.srgb = srgb;
  for (const char* field : fields) setTexture(textures, field, TextureNode{.model = map});
  return textures;
}

std::string corpusFile(const std::string& name) { return test::sourceFolder() + "/tests/corpus/" + name; }

Scene read(const std::string& name, std::size_t warnings = 0) {
  Messages messages;
  Scene scene = readScene(corpusFile(name), messages);
  EXPECT_EQ(messages.all().size(), warnings) << name;
  return scene;
}

TEST(Off, ReadsPolygonsNormalsAndColours) {
  const MeshData cube = meshOf(read("off/cube.off"));
  EXPECT_EQ(cube.points.size(), 12u) << "one side has a colour of its own";
  EXPECT_EQ(cube.triangles.size(), 12u);
  double volume = 0;
  for (const Triangle& t : cube.triangles)
    volume += dot(Vec3(cube.points[t[0]]), cross(Vec3(cube.points[t[1]]), Vec3(cube.points[t[2]]))) / 6;
  EXPECT_DOUBLE_EQ(volume, 1);

  const Scene scene = read("off/colours.off");
  const MeshData& mesh = meshOf(scene);
  EXPECT_EQ(mesh.normals, std::vector<Vec3f>(3, {0, 0, 1}));
  EXPECT_EQ(scene.materials.at(mesh.materials.at(1)).model.as<Phong>()->diffuse, Color(0, 1, 0));
}

TEST(Off, CountsWhatItLeavesOutAndNamesTheFirst) {
  const test::Folder folder;
  writeFile(folder / "a.off",
            "COFF\n3 2 0\n0 0 0 255 0 0 255\n1 0 0 255 0 0 200\n0 1 0 255 0 0 200\n"
            "3 0 1 2\n3 0 1 2 0 255 0\n");
  Messages messages;
  readScene(folder / "a.off", messages);
  ASSERT_EQ(messages.all().size(), 2u);
  EXPECT_EQ(messages.all()[0].what, "the transparency of points is left out: 2");
  EXPECT_EQ(messages.all()[0].place.line, 4);
  EXPECT_EQ(messages.all()[1].what, "colours of faces are left out, since points have some: 1");
  EXPECT_EQ(messages.all()[1].place.line, 7);
}

TEST(Stl, MergesEqualCorners) {
  const Scene text = read("stl/text.stl");
  ASSERT_EQ(text.objects.size(), 2u);
  EXPECT_EQ(text.objects[0].name, "corner");
  EXPECT_EQ(text.objects[1].name, "again");
  EXPECT_EQ(meshOf(text).points.size(), 4u);
  EXPECT_EQ(meshOf(text).triangles.size(), 4u);
  for (const char* binary : {"stl/binary.stl", "stl/solid_binary.stl"})
    EXPECT_EQ(meshOf(read(binary)), meshOf(text)) << binary;
}

TEST(Obj, MakesAnObjectOfEachNameAndMaterial) {
  const Scene scene = read("obj/rooms.obj", 2);
  ASSERT_EQ(scene.objects.size(), 3u);
  EXPECT_EQ(scene.objects[0].name, "floor");
  EXPECT_EQ(scene.objects[1].name, "wall");
  EXPECT_EQ(scene.objects[0].material, scene.objects[2].material);

  const MeshData& floor = meshOf(scene);
  EXPECT_EQ(floor.triangles.size(), 2u);
  EXPECT_EQ(floor.normals, std::vector<Vec3f>(4, {0, 1, 0}));
  EXPECT_EQ(floor.uvs.at(0), (Vec2{0, 1}));
  EXPECT_TRUE(meshOf(scene, 1).normals.empty() && meshOf(scene, 1).uvs.empty());

  const Material& red = scene.materials.at(scene.objects[0].material);
  EXPECT_EQ(red.name, "red");
  EXPECT_EQ(red.textures, pictureOn({"ambient", "diffuse"}, "bricks.png"));
  EXPECT_NEAR(phongOf(scene, 0).reflective.r, 0.5, 1e-6) << "illum 3 mirrors";
  const Phong& glass = phongOf(scene, 1);
  EXPECT_NEAR(glass.transmissive.r, 0.9 * 0.75, 1e-6);
  EXPECT_NEAR(glass.diffuse.r, 0.1 * 0.25, 1e-6);
  EXPECT_EQ(glass.index, 1.5);
  EXPECT_NEAR(glass.emissive.g, 0.1, 1e-6);
}

TEST(Obj, KeepsDentsOfPolygons) {
  const Scene scene = read("obj/plain.obj");
  const MeshData& mesh = meshOf(scene);
  double area = 0;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    EXPECT_GT(faceNormal(mesh, i).z, 0) << i;
    area += faceNormal(mesh, i).z / 2;
  }
  EXPECT_NEAR(area, 0.6, 1e-6);
}

TEST(Obj, SaysWhereANumberIsNone) {
  const auto error = [](const std::string& text) -> std::string {
    try {
      Messages messages;
      readScene("test.obj", text, messages);
    } catch (const Error& e) {
      return toLine(e.messages().front());
    }
    return "";
  };
  EXPECT_EQ(error("v 0 0 0\nv 1 1x 0\n"), "2:5: expected a number, found \"1x\"");
  EXPECT_EQ(error("v 0 0\n"), "1:1: expected 3 numbers after \"v\", found 2");
  EXPECT_EQ(error("v 0 0 1e39 # too far\n"),
            "1:7: expected a finite number of at most 3.4e38, found \"1e39\"");
  EXPECT_EQ(error("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3/x\n"),
            "4:7: expected a corner such as 7, 7/8, 7//9 or 7/8/9, found \"3/x\"");
  EXPECT_NE(warningsOfFile("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\nf 1 2 3\n")
                .find("4:1: a face of fewer than 3 points is left out"),
            std::string::npos);
}

TEST(Obj, TakesLinesThatGoOnAndColoursOfOneNumber) {
  const test::Folder folder;
  writeFile(folder / "a.mtl",
            "newmtl \\\ngrey\nKd 0.5 # all three\nKa 0.1 \\\r\n0.2 0.3\nTf 0.25\nillum 4\n");
  const std::string triangle = "# a comment that ends in C:\\\nv 0 0 0\nv 1 \\\n 0 0\nv 0 1 0\n";
  const auto read = [&](const std::string& rest) {
    Messages messages;
    const Scene scene = readScene(folder / "a.obj", "mtllib a.mtl\n" + triangle + rest, messages);
    EXPECT_TRUE(messages.all().empty()) << toString(messages.all().front());
    return scene;
  };
  const Scene scene = read("usemtl \\\ngrey\nf 1 2 \\\n3 \\");
  EXPECT_EQ(scene, scene);
  ASSERT_EQ(meshOf(scene).triangles.size(), 1u);
  EXPECT_EQ(meshOf(scene).points.at(1), (Vec3f{1, 0, 0}));
  const auto& phong = *scene.materials.at(scene.objects.at(0).material).model.as<Phong>();
  EXPECT_EQ(phong.ambient, Color(Real(0.1f), Real(0.2f), Real(0.3f)));
  EXPECT_EQ(phong.transmissive, Color(0.25));
}

TEST(Obj, ColoursOfPointsMultiplyTheMaterial) {
  const test::Folder folder;
  writeFile(folder / "a.mtl", "newmtl m\nKd 0.5 1 1\n");
  const auto read = [&](const std::string& text) {
    Messages messages;
    const Scene scene = readScene(folder / "a.obj", "mtllib a.mtl\nusemtl m\n" + text, messages);
    EXPECT_TRUE(messages.all().empty()) << toString(messages.all().front());
    return scene;
  };
  const auto diffuse = [](const Scene& scene, std::size_t point) {
    return phongOf(scene.materials.at(meshOf(scene).materials.at(point)).model).diffuse;
  };
  const Scene scene = read("v 0 0 0 1 0 0\nv 1 0 0 1 0 1 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(diffuse(scene, 0), Color(0.5, 0, 0));
  EXPECT_EQ(diffuse(scene, 1), Color(0, 1, 0)) << "after a weight";
  EXPECT_EQ(diffuse(scene, 2), Color(0.5, 1, 1)) << "white";
  EXPECT_EQ(diffuse(read("v 0 0 0 255 0 0\nv 1 0 0 0 0 255\nv 0 1 0 0 0 0\nf 1 2 3\n"), 1), Color(0, 0, 1));
  EXPECT_EQ(diffuse(read("v 0 0 0 1.0001 0.5 0.5\nv 1 0 0 1 0 0\nv 0 1 0 0 0 0\nf 1 2 3\n"), 1),
            Color(0.5, 0, 0))
      << "one that was rounded up does not make all dark";
  EXPECT_TRUE(meshOf(read("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")).materials.empty());
}

TEST(Obj, DoesWithoutItsMaterials) { EXPECT_EQ(read("obj/no_materials.obj", 1).objects.size(), 1u); }

TEST(Gltf, ReadsHierarchyCameraLightsAndMaterials) {
  const Scene scene = read("gltf/tetra.gltf", 2);
  ASSERT_EQ(scene.objects.size(), 4u);
  EXPECT_EQ(scene.objects[0].name, "left");
  EXPECT_EQ(&meshOf(scene, 0), &meshOf(scene, 2)) << "one mesh, two nodes";
  const Vec3 corner = scene.objects[2].worldFromObject * Vec3{1, 0, 0};  // (3, 0, 0), turned by 45 degrees
  EXPECT_NEAR(corner.x, 3 * std::sqrt(0.5), 1e-6);
  EXPECT_NEAR(corner.z, -3 * std::sqrt(0.5), 1e-6);

  EXPECT_EQ(scene.camera.position, (Vec3{0, 0.5, 6}));
  EXPECT_NEAR(scene.camera.fov, 0.7 * 180 / kPi, 1e-9);
  EXPECT_EQ(scene.camera.aspectratio, 1.5);
  ASSERT_EQ(scene.lights.size(), 1u);
  const auto& lamp = *scene.lights[0].light.as<PointLight>();
  EXPECT_EQ(lamp.position, (Vec3{2, 3, 4}));
  EXPECT_NEAR(lamp.color.r, 60 / kPi, 1e-9);
  EXPECT_EQ(scene.choices.at(0).option, "limit-attenuation");

  const Material& paint = scene.materials.at(scene.objects[0].material);
  EXPECT_EQ(paint.name, "paint");
  EXPECT_EQ(paint.textures, pictureOn({"ambient", "color"}, "wood.png", true));
  EXPECT_EQ(paint.model.as<Principled>()->color, Color(0.8, 0.4, 0.1)) << "it has a texture";
  const auto& metal = *scene.materials.at(scene.objects[1].material).model.as<Principled>();
  EXPECT_EQ(metal.metallic, 1) << "its points have colours, which Phong's model would not show";
  EXPECT_EQ(meshOf(scene, 1).materials.size(), 4u);
}

TEST(Gltf, SpotLightsHaveTheirCones) {
  Messages messages;
  const Scene scene = readScene("test.gltf", R"({"asset": {"version": "2.0"}, "scene": 0,
"scenes": [{"nodes": [0]}], "nodes": [{"rotation": [1, 0, 0, 0], "translation": [1, 2, 3],
"extensions": {"KHR_lights_punctual": {"light": 0}}}], "extensionsUsed": ["KHR_lights_punctual"],
"extensions": {"KHR_lights_punctual": {"lights": [{"type": "spot", "intensity": 3,
"spot": {"innerConeAngle": 0.3, "outerConeAngle": 0.6}}]}}})",
                                messages);
  ASSERT_EQ(scene.lights.size(), 1u);
  const auto& spot = *scene.lights[0].light.as<SpotLight>();
  EXPECT_EQ(spot.position, (Vec3{1, 2, 3}));
  EXPECT_NEAR(length(spot.direction - Vec3{0, 0, 1}), 0, 1e-12) << "turned around";
  EXPECT_NEAR(spot.angle, 0.6 * 180 / kPi, 1e-9);
  EXPECT_NEAR(spot.fullAngle, 0.3 * 180 / kPi, 1e-9);
  EXPECT_EQ(spot.quadratic, 1);
}

TEST(Gltf, BinaryAndTextAreTheSame) {
  Scene text = read("gltf/tetra.gltf", 2), binary = read("gltf/tetra.glb", 2);
  ASSERT_EQ(text.objects.size(), binary.objects.size());
  for (std::size_t i = 0; i < text.objects.size(); ++i) {
    EXPECT_EQ(meshOf(text, i), meshOf(binary, i));
    EXPECT_EQ(text.objects[i].worldFromObject, binary.objects[i].worldFromObject);
  }
  EXPECT_EQ(text.materials, binary.materials);
  EXPECT_EQ(text.camera, binary.camera);
}

TEST(Model, ItsCameraHasTheBoxInThePicture) {
  const Box3 boxes[] = {{{-1, -2, 5}, {3, 9, 6}}, {{0, 0, 0}, {1e-4, 1e-4, 0}}, {{-1e6, 0, 0}, {1e6, 1, 1}}};
  for (const Box3& box : boxes) {
    const CameraFrame axes = frame(framing(box), CameraAxes::orthonormal);
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 p{corner & 1 ? box.low.x : box.high.x, corner & 2 ? box.low.y : box.high.y,
                   corner & 4 ? box.low.z : box.high.z};
      const Vec3 d = p - axes.eye;
      const Real depth = dot(d, axes.look);
      EXPECT_GT(depth, 0);
      EXPECT_LT(std::abs(dot(d, axes.right)) / dot(axes.right, axes.right), depth / 2);
      EXPECT_LT(std::abs(dot(d, axes.up)) / dot(axes.up, axes.up), depth / 2);
    }
  }
}

// --- meshes of .ray scenes ----------------------------------------------------------------------------

/// As load(), of a scene that lies in the folder of the corpus.
Loaded loadBeside(const std::string& text) {
  Messages messages;
  Loaded loaded{readScene(corpusFile("scene.ray"), "SBT-raytracer 1.0\n" + text, messages), {}};
  loaded.warnings = messages.all();
  return loaded;
}

TEST(RayMeshFile, SharesAMeshNamedTwice) {
  const Scene scene = loadBeside(R"(
mesh { file = "off/cube.off"; name = first; material = { diffuse = (1, 0, 0); } }
translate(2, 0, 0, polymesh { objfile = "off/cube.off"; material = { diffuse = (1, 0, 0); } })
polymesh { objfile = "off/cube.off"; gennormals; })")
                          .scene;
  ASSERT_EQ(scene.objects.size(), 3u);
  EXPECT_EQ(scene.objects[0].name, "first");
  EXPECT_EQ(&meshOf(scene, 0), &meshOf(scene, 1));
  EXPECT_EQ(scene.objects[1].worldFromObject.offset, (Vec3{2, 0, 0}));
  EXPECT_EQ(phongOf(scene, 0).diffuse, Color(1, 0, 0));
  EXPECT_TRUE(meshOf(scene, 2).generateNormals);
  EXPECT_FALSE(isBlack(phongOf(scene, 2).diffuse)) << "not invisible where nobody gave a material";
}

TEST(RayMeshFile, TakesMaterialsPartsAndTransformsFromTheFile) {
  const Scene scene = loadBeside(R"(
material = { diffuse = (0, 0, 1); }
scale(2, mesh { file = "gltf/tetra.gltf"; })
mesh { file = "obj/rooms.obj"; }
mesh { file = "ply/little.ply"; })")
                          .scene;
  ASSERT_EQ(scene.objects.size(), 8u);
  EXPECT_EQ(scene.objects[0].name, "left");
  EXPECT_NEAR(length(scene.objects[0].worldFromObject.offset), 3, 1e-6);
  EXPECT_EQ(scene.materials.at(scene.objects[4].material).textures,
            pictureOn({"ambient", "diffuse"}, "obj/bricks.png"));
  const MeshData& coloured = meshOf(scene, 7);
  ASSERT_EQ(coloured.materials.size(), 4u);
  EXPECT_EQ(scene.materials.at(coloured.materials[1]).model.as<Phong>()->diffuse.r, 1);
}

TEST(RayMeshFile, SmoothsAndSubdivides) {
  const Scene scene = loadBeside(R"(
mesh { file = "off/cube.off"; subdivide = 1; }
mesh { file = "off/cube.off"; crease = 45; }
mesh { file = "off/cube.off"; crease = 45; }
polymesh { points = ((0,0,0), (1,0,0), (0,1,0)); faces = ((0,1,2)); subdivide = 2; crease = 10; })")
                          .scene;
  ASSERT_EQ(scene.objects.size(), 4u);
  EXPECT_EQ(meshOf(scene, 0).triangles.size(), 48u);
  EXPECT_TRUE(meshOf(scene, 0).generateNormals);
  EXPECT_EQ(meshOf(scene, 1).points.size(), 24u);
  EXPECT_EQ(&meshOf(scene, 1), &meshOf(scene, 2));
  EXPECT_EQ(meshOf(scene, 3).triangles.size(), 16u);
  EXPECT_EQ(meshOf(scene, 3).normals.size(), meshOf(scene, 3).points.size());
  EXPECT_GT(meshOf(loadBeside("mesh { file = \"off/cube.off\"; uv = cubic; }").scene).uvs.size(), 8u);
  EXPECT_EQ(errorsOf("mesh { uv = conical; }"),
            "2:13: uv: expected spherical, cylindrical, planar or cubic, found \"conical\"");
  EXPECT_EQ(errorsOf("polymesh { crease = 181; subdivide = 1.5; }"),
            "2:21: crease: expected an angle from 0 to 180 degrees, found 181\n"
            "2:38: subdivide: expected a whole number from 0 to 10, found 1.5");
}

TEST(RayMesh, KeepsSharpEdges) {
  const std::string points = "polymesh { points = ((0,0,0), (1,0,0), (1,1,0), (0,1,0), (0,0,1)); ";
  const std::string faces = "faces = ((0,3,2,1), (0,1,4)); scheme = catmull_clark; subdivide = 1; ";
  const Scene scene =
      loadBeside(points + faces + "sharp_edges = ((1,0,9), (1,4,0)); }\n" + points + faces + "}").scene;
  EXPECT_EQ(meshOf(scene, 0).points[8], (Vec3f{0.5f, 0, 0})) << "the middle of the edge between both";
  EXPECT_GT(meshOf(scene, 1).points[8].z, 0);
  EXPECT_EQ(errorsOf(points + faces + "sharp_edges = ((0,1,-1)); }"),
            "2:152: sharp edge 0: expected (point, point, sharpness from 0), found (0,1,-1)");
  EXPECT_EQ(errorsOf(points + faces + "sharp_edges = ((0,1,1), (0,2,1)); }"),
            "2:161: sharp edge 1: expected two neighbouring points of a face, found (0,2,1)");
  EXPECT_EQ(errorsOf(points + faces + "sharp_edges = ((0,99,1)); }"),
            "2:152: sharp edge 0: expected two neighbouring points of a face, found (0,99,1)");
}

TEST(RayMeshFile, SaysWhatIsWrong) {
  const auto errors = [](const std::string& text) -> std::string {
    try {
      loadBeside(text);
    } catch (const Error& error) {
      return toLine(error.messages().front());
    }
    return "";
  };
  EXPECT_EQ(errors("mesh { file = \"no.ply\"; }"),
            "2:8: cannot read \"" + corpusFile("no.ply") + "\": No such file or directory");
  EXPECT_EQ(errors("mesh { file = \"off/broken_index.off\"; }"),
            "2:8: " + corpusFile("off/broken_index.off") +
                ":6:7: face 0: expected a point from 0 to 3 - 1, found 3");
  EXPECT_NE(errors("mesh { file = \"ray/plain.ray\"; }").find("expected a mesh, found"), std::string::npos);
  EXPECT_EQ(errors("mesh { file = \"off\"; }"),
            "2:8: cannot read \"" + corpusFile("off") + "\": it is no ordinary file");
}

}  // namespace
}  // namespace trace::mesh_formats_test
