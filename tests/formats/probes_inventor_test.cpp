// Probes of Inventor, VRML 1.0 and VRML97.
#include <gtest/gtest.h>

#include <string>

#include "inventor_bytes.h"
#include "scene_probes.h"
#include "support/gltf.h"

namespace trace::probes_inventor_test {
namespace {

class Nodes {
 public:
  explicit Nodes(std::string header) : header_(std::move(header)) {}

  void add(const std::string& field, const std::string& without, const std::string& with,
           const std::string& told = {}) {
    all.push_back({field, header_ + without, header_ + with, told});
  }
  /// A field of a node that is shown inside `around`, where % is.
  void field(const std::string& name, const std::string& value, const std::string& rest = {},
             const std::string& around = "%", const std::string& told = {}) {
    const std::size_t dot = name.find('.');
    const auto whole = [&](const std::string& fields) {
      std::string text = around;
      return text.replace(text.find('%'), 1, name.substr(0, dot) + " { " + rest + " " + fields + " }");
    };
    add(name, whole(""), whole(name.substr(dot + 1) + " " + value), told);
  }

  std::vector<Probe> all;

 private:
  std::string header_;
};

const std::map<std::string, std::string> kBeside{
    {"p.png", test::smallPng(255, 0, 0)},
    {"ball.iv", "#Inventor V2.1 ascii\nSphere { radius 3 }\n"},
    {"protos.wrl", "#VRML V2.0 utf8\nPROTO Ball [ ] { Shape { geometry Sphere { radius 3 } } }\n"}};

TEST(Probes, OfInventor) {
  Nodes n("#Inventor V2.1 ascii\n");
  const std::string ball = "Sphere { }", two = "Sphere { } Cube { }";
  n.all.push_back(
      {"#Inventor binary", "#Inventor V2.1 ascii\n" + ball,
       test::InventorBytes().file(test::InventorBytes().node(
           "Sphere", {test::InventorBytes::field("radius", test::InventorBytes::numbers({2}))}))});
  n.add("DEF and USE", "DEF a " + ball + " USE a", "DEF a " + ball);
  n.add("field value ~", ball, "Sphere { radius 2 ~ }");
  n.add("= Engine", ball,
        "Sphere { radius 1 = ElapsedTime { } . timeOut } Cube { width 2 = ElapsedTime { } . timeOut }",
        "routes and engines");
  n.all.back().without = "#Inventor V2.1 ascii\n" + two;
  n.add("unknown nodes", ball, "Sfere { Sphere { } } Sfere { }", "\"Sfere\" is not rendered");
  n.add("unknown fields", ball, "Sphere { colour 1 }", "unknown field \"colour\"");
  const auto holder = [&](const std::string& node) {
    n.add(node, "Translation { translation 1 0 0 } " + two,
          node + " { Translation { translation 1 0 0 } Sphere { } } Cube { }");
  };
  for (const char* node : {"Separator", "TransformSeparator", "Selection", "Annotation", "WWWAnchor"})
    holder(node);
  n.add("Group", ball, "Group { Translation { translation 1 0 0 } } Sphere { }");
  const std::string left = "transform Translation { translation 1 0 0 }";
  n.add("SceneKit", ball,
        "SceneKit { childList NodeKitListPart { containerNode Group { Cube { } } } } " + ball);
  n.add(
      "NodeKitListPart", ball,
      "SeparatorKit { childList NodeKitListPart { containerTypeName \"Group\" containerNode Group { Cube { } "
      "} } } " +
          ball);
  n.add("SeparatorKit", two, "SeparatorKit { childList Group { Sphere { } } " + left + " } Cube { }");
  n.add("ShapeKit", ball + " Translation { translation 1 0 0 } Cube { }",
        ball + " ShapeKit { " + left + " }");
  n.all.back().same = n.all.back().without;
  n.all.back().without = "#Inventor V2.1 ascii\n" + ball;
  n.add("WrapperKit", two, "WrapperKit { contents Sphere { } " + left + " } Cube { }");
  n.add("LightKit", ball, "LightKit { light PointLight { location 0 0 9 } } " + ball);
  n.add("CameraKit", ball, "CameraKit { camera PerspectiveCamera { position 0 0 9 } } " + ball);
  n.add("AppearanceKit", ball, "AppearanceKit { material Material { diffuseColor 1 0 0 } } " + ball);
  n.add("draggers, manipulators", ball, ball + " TrackballDragger { rotation 0 1 0 0 }",
        "\"TrackballDragger\" is not rendered");
  n.add("Switch.whichChild", "Switch { " + two + " }", "Switch { whichChild 1 " + two + " }");
  n.add("LOD", "Cube { }", "LOD { range [ 5 ] " + two + " }");
  n.add("LevelOfDetail", "Cube { }", "LevelOfDetail { screenArea 5 " + two + " }");
  n.field("File.name", "\"ball.iv\"", "", "Cube { } %");
  n.all.back().without = "#Inventor V2.1 ascii\nCube { }";
  n.add("WWWInline.name", "Cube { }", "Cube { } WWWInline { name \"ball.iv\" }");
  n.field("Array.numElements1", "3", ball);
  n.field("Array.separation1", "2 0 0", "numElements1 2 " + ball);
  n.field("Array.origin", "CENTER", "numElements1 2 " + ball);
  n.field("MultipleCopy.matrix", "[ 1 0 0 0 0 1 0 0 0 0 1 0 5 0 0 1 ]", ball, "Cube { } %");
  n.field("Sphere.radius", "2");
  for (const char* f : {"Cube.width", "Cube.height", "Cube.depth", "Cone.bottomRadius", "Cone.height",
                        "Cylinder.radius", "Cylinder.height"})
    n.field(f, "3");
  n.field("Cone.parts", "SIDES");
  n.field("Cylinder.parts", "(SIDES | TOP)");

  const std::string points = "Coordinate3 { point [ 0 0 0, 1 0 0, 1 1 0, 0 1 1, 2 1 1 ] } ",
                    normals = "Normal { vector [ 0 0 1, 0 1 1, 1 0 1, 1 1 1, 1 1 0 ] } ",
                    uvs = "TextureCoordinate2 { point [ 0 0, 1 0, 1 1, 0 1, 0.5 0.5 ] } ",
                    colors = "Material { diffuseColor [ 1 0 0, 0 1 0, 0 0 1, 1 1 0, 0 1 1 ] } ",
                    picture = "Texture2 { filename \"p.png\" } ";
  const std::string faces = "coordIndex [ 0, 1, 2, -1, 0, 2, 3, -1 ]";
  n.field("IndexedFaceSet.coordIndex", "[ 0 1 3 -1 ]", "coordIndex [ 0 1 2 -1 ]", points + "%");
  n.field("IndexedFaceSet.materialIndex", "[ 1, 2 ]", faces,
          points + colors + "MaterialBinding { value PER_FACE_INDEXED } %");
  n.field("IndexedFaceSet.normalIndex", "[ 1, 2 ]", faces,
          points + normals + "NormalBinding { value PER_FACE_INDEXED } %");
  n.field("IndexedFaceSet.textureCoordIndex", "[ 2, 1, 0, -1, 3, 2, 0, -1 ]", faces,
          points + uvs + picture + "%");
  n.field("IndexedFaceSet.vertexProperty", "VertexProperty { vertex [ 0 0 0, 3 0 0, 3 3 0, 0 3 1 ] }", faces,
          points + "%");
  n.field("IndexedTriangleStripSet.coordIndex", "[ 0, 1, 2, 3, -1 ]", "coordIndex [ 0, 1, 2, -1 ]",
          points + "%");
  n.field("FaceSet.numVertices", "[ 3 ]", "", points + "%");
  n.field("FaceSet.startIndex", "1", "numVertices [ 3 ]", points + "%");
  n.field("TriangleStripSet.numVertices", "[ 4 ]", "", points + "%");
  n.field("QuadMesh.verticesPerRow", "2", "verticesPerRow 3 verticesPerColumn 2",
          "Coordinate3 { point [ 0 0 0, 1 0 0, 2 0 0, 0 1 0, 1 1 0, 2 1 0 ] } %");
  n.field("QuadMesh.verticesPerColumn", "3", "verticesPerRow 2 verticesPerColumn 2",
          "Coordinate3 { point [ 0 0 0, 1 0 0, 0 1 0, 1 1 0, 0 2 0, 1 2 0 ] } %");
  const std::string face = "IndexedFaceSet { " + faces + " }";
  n.field("Coordinate3.point", "[ 0 0 0, 3 0 0, 1 1 0, 0 1 1 ]", "point [ 0 0 0, 1 0 0, 1 1 0, 0 1 1 ]",
          "% " + face);
  n.field("Normal.vector", "[ 0 0 1, 0 1 1, 0 0 1, 0 0 1 ]", "", points + "% " + face);
  n.field("TextureCoordinate2.point", "[ 0 0, 2 0, 2 2, 0 2 ]", "", points + picture + "% " + face);
  const std::string around = points + "IndexedFaceSet { vertexProperty % " + faces + " }";
  n.field("VertexProperty.vertex", "[ 0 0 0, 3 0 0, 3 3 0, 0 3 1 ]", "", around);
  n.field("VertexProperty.normal", "[ 0 0 1, 0 1 1, 0 0 1, 0 0 1 ]", "", around);
  n.field("VertexProperty.texCoord", "[ 0 0, 2 0, 2 2, 0 2 ]", "", picture + around);
  n.field("VertexProperty.orderedRGBA", "[ 0xff0000ff ]", "", around);
  n.field("VertexProperty.materialBinding", "PER_FACE", "orderedRGBA [ 0xff0000ff, 0x00ff00ff ]", around);
  n.field("VertexProperty.normalBinding", "PER_FACE", "normal [ 0 0 1, 0 1 1, 0 0 1, 0 1 0 ]", around);
  n.field("MaterialBinding.value", "PER_FACE", "", points + colors + "% " + face);
  n.field("NormalBinding.value", "PER_FACE", "", points + normals + "% " + face);
  n.field("TextureCoordinateBinding.value", "PER_VERTEX", "",
          points + "TextureCoordinate2 { point [ 0 0, 1 0, 1 1, 0 1, .5 .5, .1 .1 ] } " + picture +
              "% IndexedFaceSet { coordIndex [ 3, 1, 2, -1, 0, 2, 3, -1 ] textureCoordIndex [ 2, 1, 0, -1, "
              "3, 2, 0, -1 ] }");
  n.field("ShapeHints.vertexOrdering", "CLOCKWISE", "", points + "% " + face);
  n.field("ShapeHints.shapeType", "SOLID", "vertexOrdering COUNTERCLOCKWISE", points + "% " + face);
  n.field("ShapeHints.faceType", "UNKNOWN_FACE_TYPE", "", points + "% " + face);
  n.field("ShapeHints.creaseAngle", "3", "vertexOrdering COUNTERCLOCKWISE", points + "% " + face);

  const std::string moved = "% Cube { width 1 }";
  n.field("Translation.translation", "1 2 3", "", moved);
  n.field("Rotation.rotation", "1 0 0 0.5", "", moved);
  n.field("RotationXYZ.axis", "Y", "angle 0.5", moved);
  n.field("RotationXYZ.angle", "0.5", "", moved);
  n.field("Scale.scaleFactor", "1 2 3", "", moved);
  n.field("Transform.translation", "1 2 3", "", moved);
  n.field("Transform.rotation", "1 0 0 0.5", "", moved);
  n.field("Transform.scaleFactor", "1 2 3", "", moved);
  n.field("Transform.scaleOrientation", "1 0 0 0.5", "scaleFactor 1 2 3", moved);
  n.field("Transform.center", "1 2 3", "scaleFactor 1 2 3", moved);
  n.field("MatrixTransform.matrix", "1 0 0 0 0 1 0 0 0 0 1 0 5 0 0 1", "", moved);
  n.add("ResetTransform", "Translation { translation 1 2 3 } Cube { }",
        "Translation { translation 1 2 3 } ResetTransform { } Cube { }");
  n.field("Units.units", "FEET", "", moved);

  for (const char* f :
       {"Material.ambientColor", "Material.diffuseColor", "Material.specularColor", "Material.emissiveColor"})
    n.field(f, "0.1 0.2 0.3", "", "% Sphere { }");
  n.field("Material.shininess", "0.7", "", "% Sphere { }");
  n.field("Material.transparency", "0.7", "", "% Sphere { }");
  n.field("BaseColor.rgb", "0.1 0.2 0.3", "rgb 1 1 1", "% Sphere { }");
  n.field("PackedColor.orderedRGBA", "0xff0000ff", "orderedRGBA 0xffffffff", "% Sphere { }");
  n.field("PackedColor.rgba", "0xff0000ff", "rgba 0xffffffff", "% Sphere { }");
  n.field("LightModel.model", "BASE_COLOR", "", "% Sphere { }");
  n.field("Texture2.filename", "\"p.png\"", "", "% Sphere { }");
  n.field("Texture2.image", "1 1 3 0xff0000", "", "% Sphere { }");
  const std::string named = "filename \"p.png\"", inner = "% Sphere { }";
  n.field("Texture2.wrapS", "CLAMP", named, inner);
  n.field("Texture2.wrapT", "CLAMP", named, inner);
  n.field("Texture2.model", "DECAL", named, inner);
  n.field("Texture2.blendColor", "1 0 0", named + " model BLEND", inner);
  n.field("Texture2Transform.translation", "0.5 0", "", picture + inner);
  n.field("Texture2Transform.rotation", "0.5", "", picture + inner);
  n.field("Texture2Transform.scaleFactor", "2 2", "", picture + inner);
  n.field("Texture2Transform.center", "0.5 0.5", "rotation 0.5", picture + inner);

  n.field("PointLight.on", "FALSE", "", "DirectionalLight { } % Sphere { }");
  n.field("PointLight.intensity", "0.5", "", inner);
  n.field("PointLight.color", "1 0 0", "", inner);
  n.field("PointLight.location", "1 2 3", "", inner);
  n.field("DirectionalLight.direction", "0 -1 0", "", inner);
  n.field("SpotLight.direction", "0 -1 0", "", inner);
  n.field("SpotLight.dropOffRate", "0.5", "", inner);
  n.field("SpotLight.cutOffAngle", "0.5", "", inner);
  n.field("Environment.ambientIntensity", "0.5", "", inner);
  n.field("Environment.ambientColor", "1 0 0", "", inner);
  n.field("Environment.attenuation", "1 0 0", "", "% PointLight { } Sphere { }");
  n.field("Environment.fogType", "SMOKE", "", inner, "the fog of an Environment is not rendered");

  n.field("PerspectiveCamera.position", "0 0 5", "", inner);
  n.field("PerspectiveCamera.orientation", "1 0 0 0.5", "", inner);
  n.field("PerspectiveCamera.heightAngle", "0.5", "", inner);
  n.field("PerspectiveCamera.aspectRatio", "2", "", inner);
  for (const char* f : {"nearDistance", "farDistance", "focalDistance"})
    n.field(std::string("PerspectiveCamera.") + f, "3", "", inner);
  n.field("PerspectiveCamera.viewportMapping", "LEAVE_ALONE", "", inner);
  n.field("OrthographicCamera.height", "5", "", inner);
  n.add("a second camera", "PerspectiveCamera { } Sphere { }",
        "PerspectiveCamera { } PerspectiveCamera { position 0 0 9 } OrthographicCamera { } Sphere { }",
        "the first camera; others are left out (2 times, first here)");
  n.field("DrawStyle.style", "LINES", "", inner, "DrawStyle LINES is not rendered");

  for (const char* node : {"AsciiText",
                           "Text2",
                           "Text3",
                           "PointSet",
                           "LineSet",
                           "IndexedLineSet",
                           "MarkerSet",
                           "NurbsCurve",
                           "NurbsSurface",
                           "IndexedNurbsCurve",
                           "IndexedNurbsSurface",
                           "NurbsProfile",
                           "TextureCoordinatePlane",
                           "TextureCoordinateEnvironment",
                           "TextureCoordinateDefault",
                           "TextureCoordinateFunction",
                           "SurroundScale",
                           "AntiSquish",
                           "Blinker",
                           "Pendulum",
                           "Rotor",
                           "Shuttle",
                           "PathSwitch",
                           "ClipPlane",
                           "TransformManip",
                           "Coordinate4",
                           "Texture3"}) {
    const std::string name(node);
    n.add(name, ball, name + " { } " + name + " { } " + ball,
          "\"" + name + "\" is not rendered and is left out (2 times, first here)");
  }
  for (const char* node : {"Info", "Label", "Complexity", "PickStyle", "Font", "FontStyle", "LinearProfile",
                           "ProfileCoordinate2", "ColorIndex", "Callback", "EventCallback"})
    n.add(node, ball, std::string(node) + " { } " + ball);
  expectProbes(knownInventorFields(), n.all, true, SceneProbes("probe.iv", kBeside));
}

TEST(Probes, OfVrml97) {
  Nodes n("#VRML V2.0 utf8\n");
  const std::string ball = "Shape { geometry Sphere { } }", box = "Shape { geometry Box { } }";
  const std::string lit = "Shape { appearance Appearance { material Material { } } geometry % }";
  n.add("ROUTE", ball,
        ball + " DEF T TimeSensor { } DEF P PositionInterpolator { } " +
            "ROUTE T.fraction_changed TO P.set_fraction ROUTE P.value_changed TO Q.set_translation",
        "routes and engines are not run: nothing moves or reacts (2 times, first here)");
  n.add("PROTO", box, "PROTO Ball [ ] { " + ball + " } Ball { }");
  const std::string proto =
      "PROTO Ball [ field SFFloat size 1 ] { Shape { geometry Sphere { radius IS size } } } ";
  n.add("IS", proto + "Ball { }", proto + "Ball { size 2 }");
  n.add("PROTO: eventIn", "PROTO Ball [ ] { " + ball + " } Ball { }",
        "PROTO Ball [ eventIn SFTime start eventOut SFTime end ] { " + ball + " } Ball { }");
  n.add("EXTERNPROTO", box, box + " EXTERNPROTO Ball [ ] \"protos.wrl#Ball\" Ball { }");
  n.add("DEF and USE", "DEF a " + ball, "DEF a " + ball + " USE a");
  n.add("unknown nodes", ball, "Grupp { children [ " + ball + " ] }", "\"Grupp\" is not");
  n.add("unknown fields", ball, "Shape { geometry Sphere { colour 1 } }", "unknown field \"colour\"");
  n.field("Group.children", "[ " + ball + " ]", "", box + " %");
  const std::string inside = "children [ " + box + " ]";
  n.field("Transform.translation", "1 2 3", inside);
  n.field("Transform.rotation", "1 0 0 0.5", inside);
  n.field("Transform.scale", "1 2 3", inside);
  n.field("Transform.scaleOrientation", "1 0 0 0.5", inside + " scale 1 2 3");
  n.field("Transform.center", "1 2 3", inside + " scale 1 2 3");
  n.field("Transform.bboxSize", "1 2 3", inside);
  n.field("Anchor.children", "[ " + ball + " ]", "", box + " %");
  n.field("Anchor.url", "\"a.html\"", inside);
  n.add("Billboard", "Group { " + inside + " }", "Billboard { " + inside + " }",
        "it is not turned to the camera");
  n.field("Collision.children", "[ " + ball + " ]", "", box + " %");
  n.field("Collision.proxy", ball, inside);
  n.field("Switch.whichChoice", "1", "choice [ " + ball + " " + box + " ]", box + " %");
  n.field("LOD.level", "[ " + ball + " " + box + " ]", "", box + " %");
  n.field("LOD.range", "[ 5 ]", "level [ " + ball + " " + box + " ]");
  n.add("Inline.url", box, box + " Inline { url \"ball.iv\" }");
  n.add("Shape.geometry", box, box + " Shape { geometry Sphere { } }");
  n.add("Shape.appearance", ball,
        "Shape { appearance Appearance { material Material { } } geometry Sphere { } }");
  const std::string looks = "Shape { appearance % geometry Sphere { } }";
  n.field("Appearance.material", "Material { }", "", looks);
  n.field("Appearance.texture", "ImageTexture { url \"p.png\" }", "", looks);
  n.field("Appearance.textureTransform", "TextureTransform { scale 2 2 }",
          "texture ImageTexture { url \"p.png\" }", looks);
  const std::string stuff = "Shape { appearance Appearance { material % } geometry Sphere { } }";
  n.field("Material.ambientIntensity", "0.7", "", stuff);
  for (const char* f : {"diffuseColor", "specularColor", "emissiveColor"})
    n.field(std::string("Material.") + f, "0.1 0.2 0.3", "", stuff);
  n.field("Material.shininess", "0.7", "", stuff);
  n.field("Material.transparency", "0.7", "", stuff);
  const std::string painted =
      "Shape { appearance Appearance { material Material { } texture % } geometry Sphere { } }";
  n.field("ImageTexture.url", "[ \"not_there.png\", \"p.png\" ]", "", painted);
  n.field("ImageTexture.repeatS", "FALSE", "url \"p.png\"", painted);
  n.field("ImageTexture.repeatT", "FALSE", "url \"p.png\"", painted);
  n.field("PixelTexture.image", "1 1 3 0xff0000", "", painted);
  n.add("MovieTexture", stuff.substr(0, stuff.find('%')) + "Material { } } geometry Sphere { } }",
        stuff.substr(0, stuff.find('%')) +
            "Material { } texture MovieTexture { url \"a.mpg\" } } geometry Sphere { } }",
        "a.mpg");
  const std::string placed =
      "Shape { appearance Appearance { texture ImageTexture { url \"p.png\" } textureTransform % } geometry "
      "Sphere { } }";
  n.field("TextureTransform.translation", "0.5 0", "", placed);
  n.field("TextureTransform.rotation", "0.5", "", placed);
  n.field("TextureTransform.scale", "2 2", "", placed);
  n.field("TextureTransform.center", "0.5 0.5", "rotation 0.5", placed);

  n.field("Box.size", "1 2 3", "", lit);
  for (const char* f :
       {"Sphere.radius", "Cone.bottomRadius", "Cone.height", "Cylinder.radius", "Cylinder.height"})
    n.field(f, "3", "", lit);
  for (const char* f : {"Cone.side", "Cone.bottom", "Cylinder.side", "Cylinder.top", "Cylinder.bottom"})
    n.field(f, "FALSE", "", lit);
  const std::string coord = "coord Coordinate { point [ 0 0 0, 1 0 0, 1 1 0, 0 1 1 ] } ",
                    faces = "coordIndex [ 0, 1, 2, -1, 0, 2, 3, -1 ] ", set = coord + faces,
                    color = "color Color { color [ 1 0 0, 0 1 0, 0 0 1, 1 1 0 ] } ",
                    normal = "normal Normal { vector [ 0 0 1, 0 1 1, 1 0 1, 1 1 1 ] } ",
                    texCoord = "texCoord TextureCoordinate { point [ 0 0, 1 0, 1 1, 0 1 ] } ";
  n.field("IndexedFaceSet.coord", "Coordinate { point [ 0 0 0, 3 0 0, 1 1 0, 0 1 1 ] }", set, lit);
  n.field("IndexedFaceSet.coordIndex", "[ 0, 1, 3, -1 ]", set, lit);
  n.field("IndexedFaceSet.color", "Color { color [ 1 0 0, 0 1 0, 0 0 1, 1 1 0 ] }", set, lit);
  n.field("IndexedFaceSet.colorIndex", "[ 1, 1, 1, -1, 2, 2, 2, -1 ]", set + color, lit);
  n.field("IndexedFaceSet.colorPerVertex", "FALSE", set + color, lit);
  n.field("IndexedFaceSet.normal", "Normal { vector [ 0 0 1, 0 1 1, 1 0 1, 1 1 1 ] }", set, lit);
  n.field("IndexedFaceSet.normalIndex", "[ 1, 1, 1, -1, 2, 2, 2, -1 ]", set + normal, lit);
  n.field("IndexedFaceSet.normalPerVertex", "FALSE", set + normal, lit);
  n.field("IndexedFaceSet.texCoord", "TextureCoordinate { point [ 0 0, 1 0, 1 1, 0 1 ] }", set, lit);
  n.field("IndexedFaceSet.texCoordIndex", "[ 2, 1, 0, -1, 3, 2, 0, -1 ]", set + texCoord, lit);
  n.field("IndexedFaceSet.creaseAngle", "3", set, lit);
  n.field("IndexedFaceSet.ccw", "FALSE", set, lit);
  n.field("IndexedFaceSet.solid", "FALSE", set, lit);
  n.field("IndexedFaceSet.convex", "FALSE", set, lit);
  const std::string grid = "xDimension 2 zDimension 2 height [ 0 1 0 2, 0, 0 ] ";
  n.field("ElevationGrid.xDimension", "3", grid, lit);
  n.field("ElevationGrid.zDimension", "3", grid, lit);
  n.field("ElevationGrid.xSpacing", "3", grid, lit);
  n.field("ElevationGrid.zSpacing", "3", grid, lit);
  n.field("ElevationGrid.height", "[ 0 2 0 2 ]", grid, lit);
  n.field("ElevationGrid.color", "Color { color [ 1 0 0, 0 1 0, 0 0 1, 1 1 0 ] }", grid, lit);
  n.field("ElevationGrid.normal", "Normal { vector [ 0 1 0, 0 1 1, 1 1 0, 1 1 1 ] }", grid, lit);
  n.field("ElevationGrid.texCoord", "TextureCoordinate { point [ 0 0, 2 0, 0 2, 2 2 ] }", grid, lit);
  n.field("ElevationGrid.creaseAngle", "3", "xDimension 2 zDimension 3 height [ 0 0 0 1 0 0 ]", lit);
  n.field("ElevationGrid.ccw", "FALSE", grid, lit);
  n.field("ElevationGrid.solid", "FALSE", grid, lit);
  n.field("Extrusion.crossSection", "[ 2 2, 2 -2, -2 -2, -2 2, 2 2 ]", "", lit);
  n.field("Extrusion.spine", "[ 0 0 0, 0 3 0 ]", "", lit);
  n.field("Extrusion.scale", "[ 1 1, 2 2 ]", "", lit);
  n.field("Extrusion.orientation", "[ 0 1 0 0, 0 1 0 0.5 ]", "", lit);
  for (const char* f : {"beginCap", "endCap", "ccw", "solid", "convex"})
    n.field(std::string("Extrusion.") + f, "FALSE", "", lit);
  n.field("Extrusion.creaseAngle", "3", "", lit);

  const auto shape = [&](const std::string& name) {
    n.add(name, box, "Shape { geometry " + name + " { } } Shape { geometry " + name + " { } } " + box,
          "\"" + name + "\" is not rendered and is left out (2 times, first here)");
  };
  for (const char* name : {"Text", "PointSet", "IndexedLineSet"}) shape(name);
  n.add("FontStyle", "Shape { geometry Text { } } " + box,
        "Shape { geometry Text { fontStyle FontStyle { size 2 } } } " + box);
  n.field("PointLight.on", "FALSE", "", "DirectionalLight { } % " + box);
  n.field("PointLight.intensity", "0.5", "", "% " + box);
  n.field("PointLight.color", "1 0 0", "", "% " + box);
  n.field("PointLight.ambientIntensity", "0.5", "", "% " + box);
  n.field("PointLight.location", "1 2 3", "", "% " + box);
  n.field("PointLight.attenuation", "1 0 1", "", "% " + box);
  n.field("PointLight.radius", "5", "", "% " + box, "the radius of a light");
  n.field("DirectionalLight.direction", "0 -1 0", "", "% " + box);
  n.field("SpotLight.direction", "0 -1 0", "", "% " + box);
  n.field("SpotLight.beamWidth", "0.3", "", "% " + box);
  n.field("SpotLight.cutOffAngle", "0.3", "", "% " + box);
  n.field("Viewpoint.position", "0 0 5", "", "% " + box);
  n.field("Viewpoint.orientation", "1 0 0 0.5", "", "% " + box);
  n.field("Viewpoint.fieldOfView", "0.5", "", "% " + box);
  n.field("Viewpoint.description", "\"Front\"", "", "% " + box);
  n.field("Viewpoint.jump", "FALSE", "", "% " + box);
  n.add("a second Viewpoint", "Viewpoint { } " + box, "Viewpoint { } Viewpoint { position 0 0 5 } " + box,
        "the first camera");
  n.field("NavigationInfo.headlight", "FALSE", "", "% " + box, "though its headlight is off");
  n.field("NavigationInfo.type", "\"WALK\"", "", "% " + box);
  n.field("NavigationInfo.visibilityLimit", "9", "", "% " + box);
  const std::string domed = "skyColor [ 0 0 1, 1 1 1 ] skyAngle [ 1 ] ";
  n.field("Background.skyColor", "[ 0 1 1 ]", "", "% " + box);
  n.field("Background.skyAngle", "[ 1.3 ]", domed, "% " + box);
  n.field("Background.groundColor", "[ 0 1 0, 0 0.5 0 ]", domed + "groundAngle [ 1.2 ]", "% " + box);
  n.field("Background.groundAngle", "[ 0.8 ]", domed + "groundColor [ 0 1 0, 0 0.5 0 ] groundAngle [ 1.2 ]",
          "% " + box);
  for (const char* side : {"front", "back", "left", "right", "top", "bottom"})
    n.field(std::string("Background.") + side + "Url", "\"p.png\"", domed, "% " + box);
  n.add("a second Background", "Background { } " + box,
        "Background { } Background { skyColor [ 1 0 0 ] } " + box, "the first Background");
  n.add("Fog", box, "Fog { visibilityRange 5 } " + box, "\"Fog\" is not rendered");
  n.add("Script", box, "Script { url \"a.js\" field SFBool on TRUE eventIn SFTime start } " + box,
        "\"Script\" is not rendered");
  for (const char* node : {"TimeSensor", "TouchSensor", "ProximitySensor", "VisibilitySensor", "PlaneSensor",
                           "SphereSensor", "CylinderSensor", "ColorInterpolator", "CoordinateInterpolator",
                           "NormalInterpolator", "OrientationInterpolator", "PositionInterpolator",
                           "ScalarInterpolator", "Sound", "AudioClip", "WorldInfo"})
    n.add(node, box, std::string(node) + " { } " + box);
  expectProbes(knownVrml97Fields(), n.all, true, SceneProbes("probe.wrl", kBeside));
}

}  // namespace
}  // namespace trace::probes_inventor_test
