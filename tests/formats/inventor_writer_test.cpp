// Scenes written as Inventor and VRML 1.0, and read again.
#include <gtest/gtest.h>

#include <string>

#include "base/files/file.h"
#include "formats/inventor/inventor_format.h"
#include "geometry/mesh/mesh.h"
#include "geometry/shapes/solids/cube.h"
#include "geometry/shapes/solids/sphere.h"
#include "image/codecs/codec.h"
#include "mesh_helpers.h"
#include "ray_helpers.h"
#include "shading/lights/ambient_light.h"
#include "shading/lights/directional_light.h"
#include "shading/lights/point_light.h"
#include "support/folder.h"

namespace trace::inventor_writer_test {
namespace {

const std::string kTwoTriangles =
    "polymesh { points = ((0,0,0), (1,0,0), (1,1,0), (0,1,0)); faces = ((0,1,2), (0,2,3));";

struct Written {
  std::string text, warnings;
  NamedBytes::Contents holds;
  Scene again;

  explicit Written(const Scene& scene, const std::string& file = "a.iv") {
    Messages messages;
    const auto files = writeInventor(scene, file, {}, messages);
    text = files[0].bytes;
    holds = *files[0].holds;
    for (const Message& message : messages.all()) warnings += message.what + "\n";
    Messages none;
    again = readInventor(file, text, none);
    for (const Message& message : none.all()) ADD_FAILURE() << toString(message) << text;
  }
};

const Phong& phongAt(const Scene& scene, std::size_t object) {
  return *scene.materials.at(scene.objects.at(object).material).model.as<Phong>();
}
void expectNear(const Vec3& a, const Vec3& b) {
  EXPECT_LT(length(a - b), 1e-9) << a.x << " " << a.y << " " << a.z;
}
void expectSamePlace(const Affine& a, const Affine& b) {
  for (int i = 0; i < 3; ++i) expectNear(a.row[i], b.row[i]);
  expectNear(a.offset, b.offset);
}

TEST(InventorWriter, WhatTheFormatHasIsReadAgainAsItWas) {
  const Scene scene =
      load(
          "camera { position = (3, 4, 5); viewdir = (-1, -2, -2); updir = (0.2, 1, 0); fov = 40; "
          "aspectratio = 1.5; }"
          "ambient_light { color = (0.1, 0.2, 0.3); }"
          "point_light { position = (1, 2, 3); color = (2, 1, 0.5); constant_attenuation_coeff = 0.5; "
          "linear_attenuation_coeff = 0.1; quadratic_attenuation_coeff = 0.2; }"
          "directional_light { direction = (1, -1, 0); color = (0.5, 0.25, 1); }"
          "translate(1, 2, 3, rotate(0, 0, 1, 0.5, scale(2, 3, -4, sphere { name = \"the ball\"; material = "
          "{ diffuse = (0.4, 0.3, 0.2); ambient = (0.2, 0.1, 0.1); specular = (0.5, 0.5, 0.5); shininess = "
          "32; emissive = (0.1, 0, 0); transmissive = (0.25, 0.25, 0.25); index = 1; reflective = (0, 0, 0); "
          "} })))"
          "box { material = { diffuse = (1, 0, 0); } }")
          .scene;
  const Written written(scene);
  EXPECT_EQ(written.warnings, "");
  const Scene& again = written.again;
  expectNear(again.camera.position, scene.camera.position);
  expectNear(normalize(again.camera.viewdir), normalize(scene.camera.viewdir));
  expectNear(normalize(cross(again.camera.viewdir, again.camera.updir)),
             normalize(cross(scene.camera.viewdir, scene.camera.updir)));
  EXPECT_NEAR(again.camera.fov, 40, 1e-9);
  EXPECT_EQ(again.camera.aspectratio, 1.5);
  ASSERT_EQ(again.lights.size(), 3u);
  const auto& point = *again.lights[0].light.as<PointLight>();
  EXPECT_EQ(point.color, Color(2, 1, 0.5));
  EXPECT_EQ((Vec3{point.constant, point.linear, point.quadratic}), (Vec3{0.5, 0.1, 0.2}));
  EXPECT_EQ(again.lights[1].light.as<DirectionalLight>()->color, Color(0.5, 0.25, 1));
  const Color ambient = again.lights[2].light.as<AmbientLight>()->color;
  expectNear({ambient.r, ambient.g, ambient.b}, {0.1, 0.2, 0.3});
  ASSERT_EQ(again.objects.size(), 2u);
  EXPECT_TRUE(again.objects[0].shape.is<Sphere>());
  EXPECT_TRUE(again.objects[1].shape.is<Cube>());
  EXPECT_EQ(again.objects[0].name, "the_ball");
  expectSamePlace(again.objects[0].worldFromObject, scene.objects[0].worldFromObject);
  const Phong &a = phongAt(scene, 0), &b = phongAt(again, 0);
  EXPECT_EQ(b.specular, a.specular);
  EXPECT_EQ(b.emissive, a.emissive);
  EXPECT_EQ(b.transmissive, a.transmissive);
  EXPECT_NEAR(b.shininess * 128, a.shininess, 1e-9);
  EXPECT_NEAR(b.diffuse.r, a.diffuse.r, 1e-12);
  EXPECT_NEAR(b.ambient.r, a.ambient.r, 1e-12);
}

TEST(InventorWriter, ACameraLooksAnyWay) {
  for (const char* view :
       {"(0, 0, -1); updir = (0, 1, 0)", "(0, 0, 1); updir = (0, 1, 0)", "(0, 0, 1); updir = (1, 1, 0)",
        "(1, 0, 0); updir = (0, 0, 1)", "(0, 0, -1); updir = (0, -1, 0)", "(0, -1, 0); updir = (0, 0, 1)"}) {
    const Scene scene =
        load("camera { position = (0, 0, 0); viewdir = " + std::string(view) + "; fov = 45; } sphere { }")
            .scene;
    const Camera &a = scene.camera, b = Written(scene).again.camera;
    expectNear(normalize(b.viewdir), normalize(a.viewdir));
    expectNear(normalize(cross(b.viewdir, b.updir)), normalize(cross(a.viewdir, a.updir)));
  }
}

TEST(InventorWriter, MeshesThatAreSharedAreWrittenOnceAndMirroredOnesKeepTheirSide) {
  Scene scene = load(kTwoTriangles + " }").scene;
  scene.objects.push_back(scene.objects[0]);
  scene.objects[1].worldFromObject = Affine::translation({5, 0, 0});
  scene.objects.push_back(scene.objects[0]);
  scene.objects[2].worldFromObject = Affine::scaling({-1, 1, 1});
  const Written written(scene);
  EXPECT_EQ(written.holds.triangles, 6u);
  ASSERT_EQ(written.again.objects.size(), 3u);
  EXPECT_EQ(&meshOf(written.again, 0), &meshOf(written.again, 1)) << "one mesh";
  EXPECT_NE(written.text.find("USE mesh"), std::string::npos);
  expectSamePlace(written.again.objects[2].worldFromObject, scene.objects[2].worldFromObject);
  const auto turns = [](const Scene& of, std::size_t object) {
    return faceNormal(meshOf(of, object), 0).z * determinant(of.objects[object].worldFromObject);
  };
  EXPECT_GT(turns(scene, 0) * turns(written.again, 0), 0);
}

TEST(InventorWriter, NormalsMaterialsOfPointsAndPictures) {
  const test::Folder folder;
  Picture grey(2, 1);
  grey.pixels = {Color(1, 1, 1), Color(0, 0, 0)};
  writePicture(folder / "a.png", grey);
  const std::string file = folder / "s.ray";
  Messages messages;
  const Scene scene =
      readScene(file,
                "SBT-raytracer 1.0 " + kTwoTriangles +
                    " normals = ((0,0,1), (0,0,1), (0,1,1), (0,0,1)); materials = ({ diffuse = (1,0,0); }, { "
                    "diffuse = (0,1,0); }, "
                    "{ diffuse = (1,0,0); }, { diffuse = (0,0,1); }); } " +
                    kTwoTriangles +
                    " texture_uv = ((0,0), (1,0), (1,1), (0,1)); material = { diffuse = map(\"a.png\"); } }",
                messages);
  const Written written(scene, folder / "s.iv");
  const MeshData &colored = meshOf(written.again, 0), &before = meshOf(scene, 0);
  ASSERT_EQ(colored.triangles.size(), 2u);
  for (std::size_t t = 0; t < 2; ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = colored.triangles[t][k], b = before.triangles[t][k];
      EXPECT_EQ(written.again.materials.at(colored.materials.at(a)).model.as<Phong>()->diffuse,
                scene.materials.at(before.materials.at(b)).model.as<Phong>()->diffuse);
      expectNear(normalize(Vec3(colored.normals[a])), normalize(Vec3(before.normals[b])));
    }
  const MeshData& painted = meshOf(written.again, 1);
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_EQ(painted.uvs[painted.triangles[0][k]], meshOf(scene, 1).uvs[meshOf(scene, 1).triangles[0][k]]);
  EXPECT_NE(written.text.find("filename \"a.png\""), std::string::npos);
}

TEST(InventorWriter, WhatTheFormatLacksIsTold) {
  const Scene scene =
      load(
          "background { color = (1, 0, 0); } sphere { material = { reflective = (1, 1, 1); transmissive = "
          "(1, 0, 0); index = 1.5; } } cone { } plane { }")
          .scene;
  const Written written(scene);
  for (const char* what :
       {"the background is left out", "mirrors are left out", "coloured glass becomes grey",
        "glass does not refract", "become triangles", "left out, as they cannot become triangles: 1 plane"})
    EXPECT_NE(written.warnings.find(what), std::string::npos) << what << "\n" << written.warnings;
  Messages messages;
  EXPECT_THROW(writeInventor(load("plane { }").scene, "a.iv", {}, messages), Error);
}

TEST(InventorWriter, VrmlIsWrittenUnderItsName) {
  const Scene scene = load(
                          "ambient_light { color = (1, 1, 1); } point_light { position = (1, 2, 3); color = "
                          "(1, 1, 1); } sphere { }")
                          .scene;
  const Written written(scene, "a.WRL");
  EXPECT_TRUE(written.text.starts_with("#VRML V1.0 ascii\n"));
  EXPECT_EQ(written.text.find("Environment"), std::string::npos);
  EXPECT_NE(written.warnings.find("the ambient light is left out"), std::string::npos) << written.warnings;
  EXPECT_NE(written.warnings.find("how lights fade is left out"), std::string::npos) << written.warnings;
}

}  // namespace
}  // namespace trace::inventor_writer_test
