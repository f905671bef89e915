// Inventor, VRML 1.0 and VRML97: nodes, state, and the meshes that are made of them.
#include "formats/inventor/inventor_format.h"

#include <cmath>

#include "base/files/read_scope.h"
#include "geometry/mesh/mesh.h"
#include "geometry/shapes/solids/cone.h"
#include "mesh_helpers.h"
#include "shading/lights/ambient_light.h"
#include "shading/lights/directional_light.h"
#include "shading/lights/point_light.h"
#include "support/paths.h"
#include "support/shapes.h"

namespace trace::inventor_format_test {
namespace {

std::string iv(const std::string& text) { return "#Inventor V2.1 ascii\n" + text; }
std::string vrml1(const std::string& text) { return "#VRML V1.0 ascii\n" + text; }
std::string vrml2(const std::string& text) { return "#VRML V2.0 utf8\n" + text; }
std::string shape(const std::string& geometry) { return vrml2("Shape { geometry " + geometry + " }"); }

const Phong& phongAt(const Scene& scene, std::size_t object) {
  return *scene.materials.at(scene.objects.at(object).material).model.as<Phong>();
}
Vec3 placeOf(const Scene& scene, std::size_t object) {
  return scene.objects.at(object).worldFromObject.offset;
}
void expectNear(const Vec3& a, const Vec3& b) {
  EXPECT_LT(length(a - b), 1e-6) << a.x << " " << a.y << " " << a.z;
}

// --- the walk -----------------------------------------------------------------------------------------

TEST(Inventor, SeparatorsSaveTheStateAndGroupsDoNot) {
  const Scene scene = sceneIn(iv(
      "Separator { Translation { translation 1 0 0 } Sphere { } } Group { Translation { translation 0 2 0 } }"
      "Sphere { } TransformSeparator { Translation { translation 0 0 3 } Material { diffuseColor 1 0 0 } "
      "Cube { } "
      "} Cube { }"));
  EXPECT_EQ(placeOf(scene, 0), (Vec3{1, 0, 0}));
  EXPECT_EQ(placeOf(scene, 1), (Vec3{0, 2, 0}));
  EXPECT_EQ(placeOf(scene, 2), (Vec3{0, 2, 3}));
  EXPECT_EQ(placeOf(scene, 3), (Vec3{0, 2, 0}));
  EXPECT_EQ(phongAt(scene, 3).diffuse, Color(1, 0, 0)) << "only the transform is saved";
}

TEST(Inventor, NodesAreUsedAgainWhereTheyAreUsed) {
  const Scene scene =
      sceneIn(iv("DEF it Separator { Coordinate3 { point [ 0 0 0, 1 0 0, 0 1 0 ] } FaceSet { } } Translation "
                 "{ translation "
                 "5 0 0 } USE it"));
  ASSERT_EQ(scene.objects.size(), 2u);
  EXPECT_EQ(placeOf(scene, 1), (Vec3{5, 0, 0}));
  EXPECT_EQ(&meshOf(scene, 0), &meshOf(scene, 1)) << "one mesh";
  EXPECT_EQ(scene.materials.size(), 1u);
}

TEST(Inventor, TransformsMultiplyInTheOrderOfTheSpecification) {
  // T C R SO S SO^-1 C^-1 of a point by hand: moved to the centre, scaled along x + y, turned by 90 degrees.
  const Scene scene = sceneIn(iv(
      "Transform { translation 10 0 0 center 1 0 0 rotation 0 0 1 1.5707963267948966 scaleOrientation 0 0 1 "
      "0.7853981633974483 scaleFactor 3 1 1 } Sphere { }"));
  expectNear(scene.objects[0].worldFromObject * Vec3{2, 1, 0}, {11 - 3, 3, 0});
  const Scene rows = sceneIn(iv("MatrixTransform { matrix 0 1 0 0  -1 0 0 0  0 0 1 0  5 6 7 1 } Sphere { }"));
  expectNear(rows.objects[0].worldFromObject * Vec3{1, 0, 0}, {5, 7, 7});
}

TEST(Inventor, SwitchesArraysAndUnits) {
  EXPECT_EQ(sceneIn(iv("Switch { whichChild 1 Cube { } Sphere { } } Sphere { }")).objects.size(), 2u);
  EXPECT_EQ(sceneIn(iv("Switch { whichChild -3 Cube { } Sphere { } }")).objects.size(), 2u);
  EXPECT_EQ(sceneIn(vrml2("Switch { whichChoice 0 choice [ Shape { geometry Box { } } ] }")).objects.size(),
            1u);
  const Scene scene =
      sceneIn(iv("Units { units CENTIMETERS } Array { numElements1 3 separation1 2 0 0 Sphere { } }"));
  ASSERT_EQ(scene.objects.size(), 3u);
  expectNear(placeOf(scene, 2), {0.04, 0, 0});
}

TEST(Inventor, ProtosAreCopiedWithTheirValues) {
  const Scene scene = sceneIn(vrml2(
      "PROTO Inner [ field SFFloat r 1 ] { Shape { geometry Sphere { radius IS r } } }\n"
      "PROTO Outer [ field SFFloat size 2 exposedField MFNode inside [ ] ] { Group { children [ Inner { r IS "
      "size } Group { children IS inside } ] } }\nOuter { size 5 inside Inner { } }\nOuter { }"));
  ASSERT_EQ(scene.objects.size(), 3u);
  EXPECT_EQ(scene.objects[0].worldFromObject.row[0].x, 5);
  EXPECT_EQ(scene.objects[1].worldFromObject.row[0].x, 1);
  EXPECT_EQ(scene.objects[2].worldFromObject.row[0].x, 2);
}

// --- materials, lights, cameras -----------------------------------------------------------------------

TEST(Inventor, MaterialsHaveTheDefaultsOfTheirFormat) {
  const Phong old = phongAt(sceneIn(vrml1("Sphere { }")), 0);
  EXPECT_EQ(old.diffuse, Color(0.8));
  EXPECT_EQ(old.ambient, Color(0.2));
  EXPECT_EQ(old.shininess, 0.2);
  const Phong bare = phongAt(sceneIn(shape("Sphere { }")), 0);
  EXPECT_EQ(bare.emissive, Color(1)) << "white without light";
  EXPECT_EQ(bare.diffuse, Color(0));
  const Phong own = phongAt(
      sceneIn(vrml2(
          "Shape { appearance Appearance { material Material { transparency 0.25 diffuseColor 0.4 0.8 0 } } "
          "geometry Box { } }")),
      0);
  EXPECT_EQ(own.transmissive, Color(0.25));
  EXPECT_NEAR(own.diffuse.r, 0.3, 1e-15);
  EXPECT_NEAR(own.ambient.g, 0.12, 1e-15);
}

TEST(Inventor, LightsAreMovedAndMayBeOff) {
  const Scene scene =
      sceneIn(iv("Environment { attenuation 0.1 0.2 0.3 ambientIntensity 0.5 } Translation { translation 0 5 "
                 "0 } Rotation { "
                 "rotation 1 0 0 1.5707963267948966 } PointLight { intensity 0.5 color 1 0 0 } "
                 "DirectionalLight { } SpotLight "
                 "{ on FALSE } Sphere { }"));
  ASSERT_EQ(scene.lights.size(), 3u);
  const auto& point = *scene.lights[0].light.as<PointLight>();
  expectNear(point.position, {0, 4, 0});
  EXPECT_EQ(point.color, Color(0.5, 0, 0));
  EXPECT_EQ((Vec3{point.constant, point.linear, point.quadratic}), (Vec3{0.3, 0.2, 0.1}));
  expectNear(scene.lights[1].light.as<DirectionalLight>()->direction, {0, 1, 0});
  EXPECT_EQ(scene.lights[2].light.as<AmbientLight>()->color, Color(0.5));
}

TEST(Inventor, OneLargeMeshIsNoNodeUsedTooOften) {
  std::string faces;
  constexpr int kFaces = 300'000;
  for (int i = 0; i < kFaces; ++i) faces += "0,1,2,-1,";
  const std::string text =
      iv("Coordinate3 { point [ 0 0 0, 1 0 0, 0 1 0 ] } IndexedFaceSet { coordIndex [ " + faces + " ] }");
  EXPECT_EQ(meshOf(sceneIn(text), 0).triangles.size(), static_cast<std::size_t>(kFaces));
  std::string often =
      "#Inventor V2.1 ascii\nCoordinate3 { point [ 0 0 0, 1 0 0, 0 1 0 ] } DEF a IndexedFaceSet { coordIndex "
      "[ " +
      faces.substr(0, 9'000) + " ] }";
  for (int i = 0; i < 12; ++i) {
    const std::string name(1, static_cast<char>('b' + i)), below(1, static_cast<char>('a' + i));
    often += " DEF " + name + " Separator { USE " + below + " Scale { scaleFactor 2 1 1 } USE " + below +
             " USE " + below + " }";
  }
  EXPECT_THROW(sceneIn(often), Error) << "a small file must not become endless work";
}

TEST(Inventor, WithoutLightsThereIsAHeadlight) {
  const Scene scene = sceneIn(vrml2("Viewpoint { } Shape { geometry Box { } }"));
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(scene.lights[0].light.as<DirectionalLight>()->direction, scene.camera.viewdir);
}

TEST(Inventor, TheFirstCameraCounts) {
  const Scene scene =
      sceneIn(iv("Translation { translation 1 0 0 } PerspectiveCamera { position 0 2 3 orientation 0 1 0 "
                 "1.5707963267948966 "
                 "heightAngle 0.5 aspectRatio 2 } Sphere { }"));
  expectNear(scene.camera.position, {1, 2, 3});
  expectNear(scene.camera.viewdir, {-1, 0, 0});
  EXPECT_NEAR(scene.camera.fov, 0.5 * 180 / kPi, 1e-12);
  EXPECT_EQ(scene.camera.aspectratio, 2);
  EXPECT_EQ(sceneIn(vrml2("Viewpoint { } Shape { geometry Box { } }")).camera.position, (Vec3{0, 0, 10}));
}

// --- shapes -------------------------------------------------------------------------------------------

TEST(Inventor, OrthographicCamerasAreOrthographic) {
  const Scene scene = sceneIn(iv("OrthographicCamera { position 1 2 3 height 5 aspectRatio 2 } Sphere { }"));
  const Settings settings = resolve({scene.choices});
  EXPECT_EQ(settings.projection, Projection::orthographic);
  EXPECT_EQ(settings.viewHeight, 5);
  EXPECT_EQ(scene.camera.position, (Vec3{1, 2, 3}));
  EXPECT_EQ(scene.camera.aspectratio, 2);
}

TEST(Inventor, ConesAndCylindersStandAlongY) {
  const Scene scene =
      sceneIn(iv("Cone { height 4 bottomRadius 2 } Cylinder { radius 2 height 6 parts SIDES }"));
  expectNear(scene.objects[0].worldFromObject * Vec3{0, 0, 1}, {0, 2, 0});
  expectNear(scene.objects[0].worldFromObject * Vec3{1, 0, 0}, {2, -2, 0});
  expectNear(scene.objects[1].worldFromObject * Vec3{0, 0, 0}, {0, -3, 0});
  EXPECT_FALSE(scene.objects[1].shape.as<Cylinder>()->capped);
  EXPECT_EQ(sceneIn(shape("Cylinder { top FALSE }")).objects.size(), 2u) << "the side and a lid";
}

constexpr const char* kRoof =  // two faces that meet at 90 degrees along y
    "point [ -1 0 0, -1 1 0, 0 0 1, 0 1 1, 1 0 0, 1 1 0 ]";

TEST(Inventor, CreaseAngleDecidesWhichFacesAreSmooth) {
  const auto mesh = [](double angle) {
    return meshOf(sceneIn(shape("IndexedFaceSet { creaseAngle " + std::to_string(angle) +
                                " coord Coordinate {" + kRoof + "} coordIndex [ 0 2 3 1 -1 2 4 5 3 -1 ] }")));
  };
  EXPECT_TRUE(mesh(0).normals.empty());
  const MeshData sharp = mesh(1.5), smooth = mesh(1.6);
  EXPECT_EQ(sharp.points.size(), 8u);
  EXPECT_EQ(smooth.points.size(), 6u) << "the ridge is shared";
  for (std::size_t i = 0; i < smooth.points.size(); ++i)
    if (smooth.points[i].z == 1) expectNear(Vec3(smooth.normals[i]), {0, 0, 1});
}

TEST(Inventor, BindingsGiveEachFaceOrCornerItsOwn) {
  const std::string faces =
      "Coordinate3 {" + std::string(kRoof) + "} Material { diffuseColor [ 1 0 0, 0 1 0, 0 0 1 ] } ";
  const auto red = [&](const std::string& text) {
    const Scene scene = sceneIn(iv(faces + text));
    const MeshData& mesh = meshOf(scene);
    std::string colors;
    for (const Triangle& t : mesh.triangles)
      for (std::uint32_t p : t) {
        const Color c = mesh.materials.empty()
                            ? phongAt(scene, 0).diffuse
                            : scene.materials[mesh.materials[p]].model.as<Phong>()->diffuse;
        colors += c.r > 0 ? 'r' : c.g > 0 ? 'g' : 'b';
      }
    return colors;
  };
  const std::string set = "IndexedFaceSet { coordIndex [ 0 2 3 -1 2 4 5 -1 ] ";
  EXPECT_EQ(red(set + "}"), "rrrrrr");
  EXPECT_EQ(red("MaterialBinding { value PER_FACE }" + set + "}"), "rrrggg");
  EXPECT_EQ(red("MaterialBinding { value PER_FACE_INDEXED }" + set + "materialIndex [ 2 0 ] }"), "bbbrrr");
  EXPECT_EQ(red("MaterialBinding { value PER_VERTEX }" + set + "}"), "rgbbbb");
  EXPECT_EQ(
      red("MaterialBinding { value PER_VERTEX_INDEXED }" + set + "materialIndex [ 0 1 2 -1 2 1 0 -1 ] }"),
      "rgbbgr");
}

TEST(Inventor, StripsTurnEveryOtherTriangle) {
  const Scene scene = sceneIn(iv(
      "Coordinate3 { point [ 0 0 0, 1 0 0, 0 1 0, 1 1 0, 0 2 0 ] } TriangleStripSet { numVertices [ 5 ] }"));
  const MeshData& mesh = meshOf(scene);
  ASSERT_EQ(mesh.triangles.size(), 3u);
  for (std::uint32_t i = 0; i < 3; ++i) EXPECT_GT(faceNormal(mesh, i).z, 0);
}

TEST(Inventor, ElevationGridsLookUp) {
  const MeshData mesh =
      meshOf(sceneIn(shape("ElevationGrid { xDimension 3 zDimension 2 xSpacing 2 height [ 0 1 2 3 4 5 ] }")));
  EXPECT_EQ(mesh.triangles.size(), 4u);
  for (std::uint32_t i = 0; i < 4; ++i) EXPECT_GT(faceNormal(mesh, i).y, 0);
  EXPECT_EQ(bounds(mesh), (Box3{{0, 0, 0}, {4, 5, 1}}));
  Messages messages;
  EXPECT_EQ(readScene("a", shape("ElevationGrid { xDimension 3 zDimension 3 height [ 0 ] }"), messages)
                .objects.size(),
            0u);
}

TEST(Inventor, ExtrusionsAreClosedAndLookOutward) {
  EXPECT_NEAR(test::volumeOf(meshOf(sceneIn(shape("Extrusion { }")))), 4, 1e-6) << "2 x 1 x 2";
  EXPECT_NEAR(
      test::volumeOf(meshOf(sceneIn(shape("Extrusion { spine [ 0 0 0, 0 3 0 ] scale [ 1 1, 0.5 0.5 ] }")))),
      3 * (4 + 1 + 2) / 3.0, 1e-5)
      << "a frustum";
  EXPECT_NEAR(test::volumeOf(meshOf(sceneIn(shape("Extrusion { spine [ 0 0 0, 2 0 0 ] }")))), 8, 1e-5);
  EXPECT_NEAR(test::volumeOf(meshOf(sceneIn(shape("Extrusion { spine [ 5 0 0, 0 0 -5, -5 0 0, 0 0 5, 5 0 0 ] "
                                                  "crossSection [ 1 1, 1 -1, -1 -1, -1 1, 1 1 ] }")))),
              80, 1e-4)
      << "a square ring, whose sections stand aslant: four bars of 2 by sqrt(2) by 5 sqrt(2)";
}

// --- tolerance ----------------------------------------------------------------------------------------

TEST(Inventor, UnknownNodesAreLeftOutWithOneWarning) {
  EXPECT_EQ(warningsOfFile(iv("Wobble { speed 3 mode FAST parts [ a, b ] } Wobble { } Sphere { }")),
            "2:1: \"Wobble\" is not rendered and is left out (2 times, first here)");
  EXPECT_EQ(warningsOfFile(vrml1("Wobble { fields [ SFFloat a ] a 3 Sphere { } }")),
            "2:1: \"Wobble\" is not rendered and is left out");
}

TEST(Inventor, EnginesAreReportedAndIgnoredFieldsKeepTheirDefaults) {
  const std::string text =
      iv("Rotation { rotation 0 0 1 0.5 = ElapsedTime { } . timeOut } Sphere { radius 2 ~ } "
         "Cube { width 2 = ElapsedTime { } . timeOut }");
  EXPECT_EQ(warningsOfFile(text),
            "2:12: routes and engines are not run: nothing moves or reacts (2 times, first here)");
  EXPECT_EQ(sceneIn(iv("Sphere { radius 2 ~ }")).objects.at(0).worldFromObject, Affine());
}

TEST(Inventor, TellsWhereAndWhat) {
  const std::pair<std::string, std::string_view> cases[] = {
      {"#Inventor V2.1 binary\n\x01", "0:0: byte 22: expected 4 bytes, found the end of the file"},
      {"#Inventor V1.0 binary\n",
       "0:0: byte 22: expected version 2.0 or 2.1 of binary Open Inventor [ivcat of Debian's "
       "inventor-clients "
       "makes "
       "a text file of it]"},
      {"#VRML V3.0 utf8",
       "1:1: expected #Inventor V2.1 ascii or binary, #VRML V1.0 ascii or #VRML V2.0 utf8"},
      {iv("Separator { Cube { }"), "2:1: this node is never closed with \"}\""},
      {vrml2("Group { children [ Group { }"), "2:9: the list of this field is never closed with \"]\""},
      {iv("Separator { 5 }"), "2:13: Separator: expected a field or a node, found 5"},
      {vrml2("Group [ ]"), "2:7: node Group: expected \"{\", found \"[\""},
  };
  for (const auto& [text, message] : cases) EXPECT_EQ(errorsOfFile(text), message) << text;
}

// --- other files --------------------------------------------------------------------------------------

TEST(Inventor, AMissingFileIsReportedOnce) {
  EXPECT_EQ(warningsOfFile("#Inventor V2.1 ascii\nFile { name \"no.iv\" } Cube { }"),
            "2:1: no.iv is left out: cannot read \"no.iv\": No such file or directory");
}

TEST(Inventor, OtherFilesStandWhereTheyAreNamed) {
  const ReadScope allowed({test::sourceFolder() + "/tests/corpus"});
  Messages messages;
  const Scene scene = readScene(test::sourceFolder() + "/tests/corpus/inventor/with_parts.wrl", messages);
  ASSERT_EQ(scene.objects.size(), 3u);
  EXPECT_EQ(placeOf(scene, 0), (Vec3{5, 0, 0}));
  EXPECT_EQ(placeOf(scene, 1), (Vec3{0, 5, 0}));
  EXPECT_NEAR(length(linear(scene.objects[1].worldFromObject, {1, 0, 0})), 1, 1e-12) << "of radius 0.5 by 2";
  EXPECT_EQ(scene.objects[0].material, scene.objects[1].material);
  EXPECT_EQ(phongAt(scene, 1).diffuse, Color(0, 0, 1));
  EXPECT_EQ(meshOf(scene, 2).triangles.size(), 12u);
  ASSERT_EQ(scene.lights.size(), 2u);
  EXPECT_EQ(scene.lights[1].light.as<PointLight>()->position, (Vec3{0, 7, 0}));
  std::string said;
  for (const Message& message : messages.all()) said += message.what + "\n";
  EXPECT_NE(said.find("with_parts.wrl is left out: it holds itself"), std::string::npos) << said;
  EXPECT_NE(said.find("nowhere.wrl is left out: "), std::string::npos) << said;
}

}  // namespace
}  // namespace trace::inventor_format_test
