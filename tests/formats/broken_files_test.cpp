// Files that are broken in one place each, and what must be said of it: nothing that is wrong in a file may
// pass in silence. A row of the table is a file; `expected` begins with "warning" or "error", and a part of
// the message follows.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/files/file.h"
#include "base/os/memory.h"
#include "base/sanitized.h"
#include "formats/format.h"
#include "shading/textures/image_map.h"
#include "support/folder.h"
#include "support/paths.h"

namespace trace::broken_files_test {
namespace {

struct Broken {
  const char* file;  ///< whose suffix tells the format
  std::string text;
  const char* expected;
};

/// What reading says, a message a line: `error: ...` or `warning: ...`.
std::string said(const std::string& file, const std::string& bytes) {
  Messages messages;
  std::string text;
  const auto add = [&](const Message& m) {
    text += (m.severity == Message::Severity::error ? "error: " : "warning: ") + m.what +
            (m.hint.empty() ? "" : " [" + m.hint + "]") + "\n";
  };
  try {
    readScene(file, bytes, messages);
    for (const Message& m : messages.all()) add(m);
  } catch (const Error& error) {
    for (const Message& m : error.messages()) add(m);
  }
  return text;
}

/// Is there a line that begins with the severity and holds the rest of `expected`?
bool holds(const std::string& lines, std::string_view expected) {
  const std::size_t space = expected.find(' ');
  const std::string severity(expected.substr(0, space));
  const std::string_view part = expected.substr(space + 1);
  for (std::size_t at = 0; at < lines.size();) {
    const std::size_t end = lines.find('\n', at);
    const std::string_view line = std::string_view(lines).substr(at, end - at);
    if (line.starts_with(severity + ": ") && line.find(part) != line.npos) return true;
    at = end + 1;
  }
  return false;
}

void expectSaid(const std::vector<Broken>& rows, const std::string& folder = {}) {
  for (const Broken& row : rows) {
    const std::string lines = said(folder + row.file, row.text);
    EXPECT_TRUE(holds(lines, row.expected)) << row.text << "\nshould give: " << row.expected << "\ngave:\n"
                                            << lines;
  }
}

// --- .ray
// ---------------------------------------------------------------------------------------------------

std::string ray(const std::string& rest) {
  return "SBT-raytracer 1.0\ncamera { position = (0, 0, 5); }\nambient_light { color = (1, 1, 1); }\n" + rest;
}

TEST(BrokenFiles, Ray) {
  const std::string glass = "material = { name = \"glass\"; transmissive = (0.9, 0.9, 0.9); index = 1.5; }\n";
  expectSaid({
      {"a.ray", "SBT-raytracer -1.0\nsphere { }", "error expected version 1.1 or older"},
      {"a.ray", ray("sphere { material = { index = 0; } }"),
       "warning index of material: nothing has an index of 0"},
      {"a.ray", ray("sphere { material = { index = -1; } }"),
       "warning index of material: expected at least 0"},
      {"a.ray", ray("sphere { material = { diffuse = (1, 0, 0); diffuse = (0, 1, 0); } }"),
       "warning diffuse of material given again; the last counts"},
      {"a.ray", ray("sphere { material = { diffuse = (255, 0, 0); } }"),
       "warning diffuse of material: expected 0 to 1"},
      {"a.ray", ray("sphere { material = { diffuse = map(\"wood.png\"); } }"),
       "warning the texture \"wood.png\" cannot be read"},
      {"a.ray", ray("sphere { name = a; name = b; }"), "warning name of sphere given again"},
      {"a.ray", ray("lathe { profile = ((1, 0), (1, 1)); }"),
       "warning profile: expected at least 4 points for the spline bezier, found 2"},
      {"a.ray", ray("lathe { profile = ((1, 0)); spline = linear; }"),
       "warning profile: expected at least 2 points"},
      {"a.ray", ray("lathe { profile = ((1, 0), (2, 1), (1, 2), (1, 3), (0, 4), (0, 5)); }"),
       "warning 4, 7, 10 or so on points for the spline bezier, found 6; the last two are ignored"},
      {"a.ray", ray("prism { outline = ((0, 0), (1, 1)); spline = linear; }"),
       "warning outline: expected at least 3 points"},
      {"a.ray", ray("prism { outline = ((0, 0), (1, 0), (0, 1)); spline = linear; height = 0; }"),
       "warning prism: nothing of it can be seen, for it has no volume"},
      {"a.ray", ray("sphere_sweep { points = ((0, 0, 0, 1)); spline = linear; }"),
       "warning points: expected at least 2 points"},
      {"a.ray", ray("sweep { points = ((0, 0, 0, 1), (1, 0, 0, 1)); spline = catmull; }"),
       "warning points: expected at least 4"},
      {"a.ray", ray("isosurface { formula = \"log(-1)\"; }"), "warning formula: it has no value anywhere"},
      {"a.ray", ray("isosurface { formula = \"x / 0\"; }"), "warning formula: it has no value anywhere"},
      {"a.ray", ray("height_field { formula = \"log(-1 - x * x)\"; }"),
       "warning formula: it has no value anywhere"},
      {"a.ray", ray("isosurface { low = (1, 1, 1); high = (-1, 2, 2); }"), "warning low is above high in x"},
      {"a.ray", ray("quadric { low = (2, 2, 2); high = (1, 1, 1); }"),
       "warning low is above high in x, y, z"},
      {"a.ray", ray("quadric { low = (1, 1, 1); high = (1, 2, 2); }"),
       "warning quadric: nothing of it can be seen"},
      {"a.ray", ray("isosurface { formula = \"x^1000\"; }"),
       "error expected an exponent from -64 to 64, found 1000"},
      {"a.ray", ray("isosurface { formula = \"2^x\"; }"),
       "error expected a number as exponent, found a formula"},
      {"a.ray", ray("metaballs { balls = (); }"), "warning metaballs: nothing of it can be seen"},
      {"a.ray", ray("ellipsoid { radii = (1, 0, 1); }"), "warning ellipsoid: nothing of it can be seen"},
      {"a.ray", ray("disk { radius = 0; }"), "warning disk: nothing of it can be seen"},
      {"a.ray", ray("torus { major_radius = -1; }"), "warning major_radius of torus: expected at least 0"},
      {"a.ray", ray("cone { bottom_radius = -2; }"),
       "warning bottom_radius of cone: expected at least 0, found -2"},
      {"a.ray", ray("cone { height = 1; top_radius = -2; }"),
       "warning top_radius of cone: expected at least 0, found -2"},
      {"a.ray", ray("conic { z_min = 2; z_max = 1; }"),
       "warning conic: expected z_min below z_max, found 2 and 1"},
      {"a.ray", ray("disk { radius = 1; inner_radius = 2; }"),
       "warning disk: nothing of it can be seen, for the hole is as large"},
      {"a.ray", ray("mandelbox { scale = 0.5; }"),
       "warning scale of mandelbox: expected one farther from 0 than 1.1, found 0.5; it becomes 1.1"},
      {"a.ray", ray("rounded_box { radius = 9; }"),
       "warning radius of rounded_box: expected at most half of the least width, found 9"},
      {"a.ray", ray("julia { normal = (0, 0, 0, 0); }"), "warning normal of julia: expected a direction"},
      {"a.ray", ray("sphere_sweep { points = ((0,0,0,1), (1,0,0,-2)); spline = linear; }"),
       "warning points: expected radii of at least 0, found -2; the sign is ignored"},
      {"a.ray", ray("lathe { profile = ((-1, 0), (-1, 1)); spline = linear; }"),
       "warning profile: expected distances from the axis of at least 0, found -1"},
      {"a.ray", ray("metaballs { balls = ((0,0,0,-3,1)); }"),
       "warning balls: expected radii of at least 0, found -3"},
      {"a.ray", ray("metaballs { capsules = ((0,0,0,1,1,1,-3,1)); }"),
       "warning capsules: expected radii of at least 0, found -3"},
      {"a.ray", ray("julia { iterations = 2000000000; }"),
       "error iterations: expected a whole number from 1 to 50, found 2000000000"},
      {"a.ray", ray("terrain { seed = 2000000000; }"),
       "error seed: expected a whole number from -1000000000 to 1000000000, found 2000000000"},
      {"a.ray", ray("mesh { file = o.obj; }"),
       "error expected a value, found \"o.obj\" [the name of a file stands in quotation marks, as in "
       "\"o.obj\"]"},
      {"a.ray", ray("mesh { file = meshes/o.obj; }"), "error as in \"meshes/o.obj\"]"},
      {"a.ray", ray("mesh { file = ../o.obj; }"), "error as in \"../o.obj\"]"},
      {"a.ray", ray("mesh { file = 3d.obj; }"), "error as in \"3d.obj\"]"},
      {"a.ray", ray("mesh { file = C:\\o.obj; }"), "error as in \"C:\\o.obj\"]"},
      {"a.ray", ray("sphere { material = { diffuse = map(wood.png); } }"), "error as in \"wood.png\"]"},
      {"a.ray",
       ray("material { name = a; diffuse = (1, 0, 0); }\nmaterial { name = a; diffuse = (0, 1, 0); }\n"
           "sphere { material = a; }"),
       "warning a second material is called \"a\": it counts from here on, that of line 4 no longer"},
      {"a.ray", ray("transform((1,0,0,0), (0,1,0,0), (0,0,1,0), (1,0,0,2), sphere { })"),
       "warning transform: expected a last row of (0, 0, 0, 1), found (1,0,0,2); it is ignored"},
      {"a.ray", ray("polymesh { points = ((0,0,0), (1,0,0), (0,1,0)); }"), "warning it has no faces"},
      {"a.ray", ray("polymesh { points = ((0,0,0)); points = ((1,1,1)); }"),
       "warning points of polymesh given again"},
      {"a.ray", ray("union { }"), "warning union without objects is empty"},
      {"a.ray", ray("difference { sphere { } }"), "warning difference of one object changes nothing"},
      {"a.ray", ray("intersection { sphere { } }"), "warning intersection of one object changes nothing"},
      {"a.ray", ray("camera { fov = 30; } sphere { }"), "warning there are several cameras; the last counts"},
      {"a.ray", ray("camera { fov = 30; fov = 40; } sphere { }"), "warning fov of camera given again"},
      {"a.ray", ray("camera { near = 5; far = 2; } sphere { }"),
       "warning camera: expected near to be less than far"},
      {"a.ray", ray("camera { near = -5; } sphere { }"), "warning near of camera: expected at least 0"},
      {"a.ray", ray("camera { fov = 30; horizontal_fov = 50; } sphere { }"),
       "warning fov is ignored, since horizontal_fov"},
      {"a.ray", ray("camera { focaldistance = 4; } sphere { }"),
       "warning focaldistance of camera is ignored: everything"},
      {"a.ray", ray("settings { depth = 2; depth = 3; } sphere { }"),
       "warning depth of settings given again"},
      {"a.ray",
       ray("spot_light { position = (0,0,5); direction = (0,0,-1); color = (1,1,1); angle = 10; full_angle = "
           "20; }"),
       "warning spot_light: expected a full_angle of at most the angle"},
      {"a.ray", ray("point_light { position = (0,0,5); color = (-1,1,1); }"),
       "warning color of point_light: expected at least 0"},
      {"a.ray", ray("background { color = (-1, 0, 0); }"),
       "warning background: expected colors of at least 0"},
      {"a.ray", ray("background { colors = ((1,0,0), (0,1,0)); limits = (3); }"),
       "warning background: expected limits from 0 to 1"},
      {"a.ray", ray("csg { primitiveNumber = 2; }"),
       "warning \"csg\" is not rendered yet [Trace has union, intersection"},
      {"a.ray", ray("metaball { size = 3; }"),
       "warning \"metaball\" is not rendered yet [Trace has metaballs"},
      {"a.ray", ray(glass + "sphere { material = { diffuse = (1, 0, 0); } }"),
       "warning this material inherits the transmissive of \"glass\", which it starts as a copy of"},
      {"a.ray",
       ray(glass + "material { name = \"gold\"; diffuse = (1, 0.8, 0); } sphere { material = \"gold\"; }"),
       "warning this material inherits the transmissive of \"glass\""},
      {"a.ray", ray("mesh { file = \"none.ply\"; }"), "error cannot read"},
  });
  EXPECT_EQ(said("a.ray", ray(glass + "sphere { material = { diffuse = 1; transmissive = 0; } }")), "");
  EXPECT_EQ(said("a.ray", ray(glass + "sphere { material = { shininess = 30; } }")), "");
  EXPECT_EQ(said("a.ray", ray("cone { height = -2; }")), "");
  EXPECT_EQ(said("a.ray", ray("sphere//a comment\n{ name=ball/* of glass */; }")), "");
  const std::string twice = "sphere { material = { name = a; diffuse = (1, 0, 0); } }\n";
  EXPECT_EQ(said("a.ray", ray(twice + twice)), "");
}

// --- British Columbia
// ---------------------------------------------------------------------------------------

std::string ubc(const std::string& rest) {
  return "Dimensions 64 48\nPerspective 45 1.33 1 100\nLookAt 0 0 5 0 0 0 0 1 0\n"
         "Material \"m\" \"diffuse\" [1 1 1]\nPointLight 0 5 5 \"diffuse\" [1 1 1]\n" +
         rest;
}

TEST(BrokenFiles, Ubc) {
  expectSaid({
      {"a.ray", ubc("PushMatrix\nSphere 1 \"m\""), "warning PushMatrix without a PopMatrix after it: 1"},
      {"a.ray", ubc("PopMatrix"), "error PopMatrix without a PushMatrix"},
      {"a.ray", ubc("Sphere -1 \"m\""), "warning a radius: expected at least 0, found -1"},
      {"a.ray", ubc("Sphere 0 \"m\""), "warning an object is left out"},
      {"a.ray", ubc("Conic -1 1 0 1 \"m\""), "warning a radius: expected at least 0"},
      {"a.ray", ubc("Rotate 90 0 0 0\nSphere 1 \"m\""), "warning Rotate: expected an axis of length 1"},
      {"a.ray", ubc("Supersampling 0\nSphere 1 \"m\""), "warning Supersampling: expected 1 to 65536"},
      {"a.ray", ubc("Perspective 45 1 100 1\nSphere 1 \"m\""), "warning expected near to be less than far"},
      {"a.ray", ubc("Material \"n\" \"reflect\" 3\nSphere 1 \"n\""),
       "warning reflect of a material: expected 0 to 1"},
      {"a.ray", ubc("Material \"n\" \"shininess\" -3\nSphere 1 \"n\""), "warning shininess of a material"},
      {"a.ray", ubc("Material \"n\" \"diffuse\" [-1 0 0]\nSphere 1 \"n\""), "warning diffuse of a material"},
      {"a.ray", ubc("Material \"n\" \"refract\" 1 \"rfrIndex\" 0\nSphere 1 \"n\""),
       "warning the index of refraction of a material: expected a number above 0"},
      {"a.ray", ubc("Material \"n\" \"diffuse\" [1 0 0] \"diffuse\" [0 1 0]\nSphere 1 \"n\""),
       "warning \"diffuse\" is given again"},
      {"a.ray", ubc("Material \"n\" \"texture\" \"wood.bmp\"\nSphere 1 \"n\""),
       "warning the texture \"wood.bmp\" cannot be read"},
      {"a.ray", ubc("PointLight 0 0 5 \"attenuation\" [-1 0 0]\nSphere 1 \"m\""),
       "warning attenuation: expected numbers"},
      {"a.ray", ubc("PointLight 0 0 5 \"diffuse\" [-1 0 0]\nSphere 1 \"m\""),
       "warning PointLight: expected colours"},
      {"a.ray", ubc("Mesh \"m\" [3] [0 1 2 0 1] \"P\" [0 0 0 1 0 0 0 1 0]"),
       "warning Mesh: the list has more indices"},
      {"a.ray", ubc("Sphere 1 \"other\""), "error expected the name of a material"},
      {"a.ray", "Resolution 64 48\nCamera 0 0 5 0 0 0 0 1 0 45 1 1 100\n", "warning no object"},
      {"a.ray",
       "Resolution 64 48\nCamera 0 0 5 0 0 0 0 1 0 45 1 9 3\nMaterial 1  0 0 0 1 1 1 0 0 0 0 0 0 5 0 "
       "0\nSphere 1 0 0 0 1\n",
       "warning expected near to be less than far"},
      {"a.ray",
       "Resolution 64 48\nCamera 0 0 5 0 0 0 0 1 0 45 1 1 30\nMaterial 1  0 0 0 1 1 1 0 0 0 0 0 0 5 0 "
       "7\nSphere 1 0 0 0 1\n",
       "warning reflect of a material: expected 0 to 1"},
  });
}

// --- the composer
// -------------------------------------------------------------------------------------------

std::string composer(const std::string& rest) {
  return "Composer format 2.1 ascii\n"
         "camera { position 0 0 5 viewDirection 0 0 -1 orthoUp 0 1 0 verticalFOV 0.7 }\n"
         "point_light { position 0 0 5 color 1 1 1 }\n" +
         rest;
}
std::string polygons(const std::string& fields) {
  return composer("poly_set { name NULL\n numMaterials 0 " + fields + " }");
}
const char* const kTriangle = "poly { numVertices 3 pos 0 0 0 pos 1 0 0 pos 0 1 0 }";

std::string word(float value) {
  char bytes[4];
  std::memcpy(bytes, &value, 4);
  return {bytes, 4};
}
std::string word(std::int32_t value) {
  char bytes[4];
  std::memcpy(bytes, &value, 4);
  return {bytes, 4};
}
/// A camera and nothing else, as binary.
std::string composerBinary(float fov) {
  std::string text = "Composer format 2.1 binary\n" + word(123456789) + word(3.1415926f);
  for (float n : {0.f, 0.f, 5.f, 0.f, 0.f, -1.f, 5.f, 0.f, 1.f, 0.f, fov}) text += word(n);
  return text + word(0) + word(0);
}

TEST(BrokenFiles, Composer) {
  const std::string ball = "sphere { name NULL\n numMaterials 1 material { diffColor 1 1 1 ";
  expectSaid({
      {"a.out", "Composer format -3 ascii\n", "error expected version 2.1 or older"},
      {"a.out", composer("camera { position 1 1 1 }\nsphere { name NULL\n numMaterials 0 }"),
       "warning there are several cameras"},
      {"a.out", composer(""), "warning no object"},
      {"a.out", composer("sphere { name NULL\n numMaterials 3 }"),
       "warning numMaterials says 3, but the file has 0"},
      {"a.out", composer("sphere { name \"texture=wood.png\" numMaterials 0 }"),
       "warning the texture \"wood.png\" cannot be read"},
      {"a.out", composer("sphere { name \"bump=dents.png\" numMaterials 0 }"),
       "warning the texture \"dents.png\" cannot be read"},
      {"a.out", composer("sphere { name \"ior=banana\" numMaterials 0 }"),
       "warning expected a number, found \"banana\""},
      {"a.out", composer("sphere { name NULL\n numMaterials 0 radius 0 }"),
       "warning an object without size is left out"},
      {"a.out", composer("sphere { name NULL\n numMaterials 0 wobble 3 }"),
       "warning \"wobble\" is not known"},
      {"a.out", composer("sphere { name NULL\n numMaterials 0 radus 3 }"),
       "warning \"radus\" is not known and is skipped [did you mean \"radius\"?]"},
      {"a.out", composer(ball + "difColor 1 1 1 } }"),
       "warning \"difColor\" is not known and is skipped [did you mean \"diffColor\"?]"},
      {"a.out", composer("pont_light { color 1 1 1 }"),
       "warning \"pont_light\" is not known and is skipped [did you mean \"point_light\"?]"},
      {"a.out", polygons("normTyp PER_VERTEX_NORMAL numPolys 1 " + std::string(kTriangle)),
       "error expected a field of a poly_set, found \"normTyp\" [did you mean \"normType\"?]"},
      {"a.out", composer(ball + "ktran 2 } }"), "warning ktran of a material: expected 0 to 1, found 2"},
      {"a.out", composer(ball + "shininess -1 } }"),
       "warning shininess of a material: expected 0 to 1, found -1"},
      {"a.out", composer(ball + "specColor 9 0 0 } }"), "warning specColor of a material"},
      {"a.out", composer("point_light { position 0 0 1 color -1 0 0 }"), "warning color of a light"},
      {"a.out", composer("spot_light { position 0 0 1 direction 0 0 -1 color 1 1 1 cutOffAngle 7 }"),
       "warning cutOffAngle"},
      {"a.out", composer("directional_light { direction 0 0 0 color 1 1 1 }"),
       "warning a light without a direction"},
      {"a.out", polygons("numPolys 2 " + std::string(kTriangle)),
       "warning numPolys says 2, but the file has 1"},
      {"a.out", polygons("numPolys 1 poly { numVertices 4 pos 0 0 0 pos 1 0 0 pos 0 1 0 }"),
       "warning numVertices says 4, but the file has 3"},
      {"a.out", polygons("type BANANA numPolys 1 " + std::string(kTriangle)),
       "warning type: expected POLYSET_TRI_MESH"},
      {"a.out", polygons("hasTextureCoords TRUE numPolys 1 " + std::string(kTriangle)),
       "warning poly: expected s and t"},
      {"a.out", polygons("normType PER_VERTEX_NORMAL numPolys 1 " + std::string(kTriangle)),
       "warning poly: expected a norm"},
      {"a.out", polygons("numPolys 1 poly { numVertices 2 pos 0 0 0 pos 1 0 0 }"),
       "warning fewer than 3 vertices"},
      {"a.out", composerBinary(0.7f) + "more", "warning bytes after the last object are ignored: 4"},
      {"a.out", composerBinary(9.f), "error expected a camera"},
  });
}

// --- Inventor and VRML
// --------------------------------------------------------------------------------------

TEST(BrokenFiles, Inventor) {
  const auto iv = [](const std::string& text) { return "#Inventor V2.1 ascii\nSeparator { " + text + " }"; };
  const auto vrml1 = [](const std::string& text) { return "#VRML V1.0 ascii\nSeparator { " + text + " }"; };
  const auto vrml2 = [](const std::string& geometry, const std::string& look = "") {
    return "#VRML V2.0 utf8\nShape { " + look + " geometry " + geometry + " }";
  };
  const std::string points = "Coordinate3 { point [ 0 0 0, 1 0 0, 0 1 0 ] } ";
  expectSaid({
      {"a.iv", iv("Sphere { radius banana }"),
       "warning radius of Sphere: expected a number, found \"banana\""},
      {"a.wrl", vrml2("Sphere { radius banana }"), "warning radius of Sphere: expected a number"},
      {"a.iv", iv("Sphere { radius -1 }"), "warning radius of Sphere: expected a number above 0, found -1"},
      {"a.iv", iv("Sphere { radius 1 2 }"), "warning radius of Sphere: expected a number, found 2"},
      {"a.iv", iv("Sphere { radios 2 }"),
       "warning unknown field \"radios\" of Sphere is ignored [did you mean \"radius\"?]"},
      {"a.iv", iv("Spere { radius 2 }"),
       "warning \"Spere\" is not rendered and is left out [did you mean \"Sphere\"?]"},
      {"a.wrl",
       "#VRML V2.0 utf8\nTransfrom { translation 1 0 0 scale 2 2 2 children [ Shape { geometry Box { } } ] }",
       "warning \"Transfrom\" is not known: what it holds is rendered without its translation and scale "
       "[did you mean \"Transform\"?]"},
      {"a.wrl", vrml2("IndexdFaceSet { }"), "warning left out [did you mean \"IndexedFaceSet\"?]"},
      {"a.wrl", vrml2("Sphere { }", "apearance Appearance { }"),
       "warning unknown field \"apearance\" of Shape is ignored [did you mean \"appearance\"?]"},
      {"a.wrl", vrml2("Sphere { }", "appearance Appearance { materal Material { } }"),
       "warning unknown field \"materal\" of Appearance is ignored [did you mean \"material\"?]"},
      {"a.wrl", vrml2("Sphere { }", "appearance Apearance { }"),
       "warning \"Apearance\" is not known [did you mean \"Appearance\"?]"},
      {"a.wrl", vrml2("Sphere { }", "appearance Appearance { material Materal { } }"),
       "warning \"Materal\" is not known [did you mean \"Material\"?]"},
      {"a.wrl", vrml2("Box { size 1 2 }"), "warning size of Box: expected 3 numbers, found 2"},
      {"a.wrl", vrml2("Box { size 1 2 0 }"), "warning size of Box: expected a number above 0, found 0"},
      {"a.wrl", vrml2("Cone { bottom banana }"), "warning bottom of Cone: expected TRUE or FALSE"},
      {"a.iv", iv("Cone { parts BANANA }"),
       "warning parts of Cone: expected SIDES, TOP, BOTTOM, ALL, found \"BANANA\""},
      {"a.iv", iv("Material { diffuseColor 1 0 } Sphere { }"),
       "warning diffuseColor of Material: expected lists of 3 numbers"},
      {"a.iv", iv("Material { transparency 5 } Sphere { }"),
       "warning transparency of Material: expected 0 to 1, found 5"},
      {"a.iv", iv("Material { shininess -1 } Sphere { }"),
       "warning shininess of Material: expected 0 to 1, found -1"},
      {"a.iv", iv("MaterialBinding { value BANANA } Sphere { }"),
       "warning value of MaterialBinding: expected DEFAULT"},
      {"a.iv", iv("ShapeHints { vertexOrdering LEFT } Sphere { }"),
       "warning vertexOrdering of ShapeHints: expected"},
      {"a.iv", iv("LightModel { model BANANA } Sphere { }"), "warning model of LightModel"},
      {"a.iv", iv("Units { units CUBITS } Sphere { }"), "warning units of Units"},
      {"a.iv", iv("Rotation { rotation 0 0 0 1 } Sphere { }"), "warning an axis of length 0"},
      {"a.iv", iv("Rotation { rotation 0 1 0 } Sphere { }"),
       "warning rotation of Rotation: expected 4 numbers, found 3"},
      {"a.iv", iv("MatrixTransform { matrix 1 0 0 } Sphere { }"),
       "warning matrix of MatrixTransform: expected 16 numbers"},
      {"a.iv", iv("Switch { whichChild 9 Sphere { } }"),
       "warning Switch: expected the number of one of its 1 children"},
      {"a.iv", iv("PointLight { on banana } Sphere { }"), "warning on of PointLight: expected TRUE or FALSE"},
      {"a.iv", iv("PointLight { intensity -1 } Sphere { }"),
       "warning intensity of PointLight: expected at least 0"},
      {"a.iv", iv("DirectionalLight { direction 0 0 0 } Sphere { }"),
       "warning direction of DirectionalLight: expected a direction"},
      {"a.iv", iv("SpotLight { cutOffAngle 9 } Sphere { }"), "warning cutOffAngle of SpotLight"},
      {"a.iv", iv("PerspectiveCamera { heightAngle 9 } Sphere { }"),
       "warning heightAngle of PerspectiveCamera"},
      {"a.iv", iv("PerspectiveCamera { aspectRatio -1 } Sphere { }"),
       "warning aspectRatio of PerspectiveCamera"},
      {"a.iv", iv(points + "IndexedFaceSet { coordIndex [ 0, 1, 99, -1 ] }"), "warning 1 faces are left out"},
      {"a.iv", iv("Coordinate3 { point [ 0 0 0, 1 0 ] } Sphere { }"),
       "warning point of Coordinate3: expected lists of 3 numbers"},
      {"a.iv", iv(points + "FaceSet { numVertices [ 3, 3 ] }"), "warning 1 faces are left out"},
      {"a.iv",
       iv(points + "Material { diffuseColor [ 1 0 0, 0 1 0 ] } MaterialBinding { value PER_FACE_INDEXED } "
                   "IndexedFaceSet { coordIndex [ 0, 1, 2, -1 ] materialIndex [ 9 ] }"),
       "warning corners use materials, colours or texture coordinates that are not there"},
      {"a.wrl", vrml1("Texture2 { filename \"wood.png\" } Sphere { }"),
       "warning the texture \"wood.png\" cannot be read"},
      {"a.iv", iv("Texture2 { image 2 2 3 0xff0000 } Sphere { }"),
       "warning image of Texture2: expected width, height, 1 to 4 and the pixels"},
      {"a.wrl", vrml2("Sphere { }", "appearance Appearance { texture ImageTexture { url \"wood.png\" } }"),
       "warning the texture \"wood.png\" cannot be read"},
      {"a.wrl", vrml2("Sphere { }", "appearance Appearance { texture PixelTexture { image 1 1 9 0xff } }"),
       "warning image of PixelTexture: expected"},
      {"a.wrl", vrml2("Sphere { }", "appearance Appearance { texture MovieTexture { url \"film.mpg\" } }"),
       "warning the texture \"film.mpg\" is not rendered yet"},
      {"a.wrl", "#VRML V2.0 utf8\nBackground { frontUrl \"sky.png\" }", "warning the texture \"sky.png\""},
      {"a.wrl", "#VRML V2.0 utf8\nFog { color 1 1 1 }", "warning \"Fog\" is not rendered"},
      {"a.wrl", "#VRML V2.0 utf8\nInline { }", "warning Inline names no file"},
      {"a.wrl", vrml2("Extrusion { spine [ 0 0 0 ] }"),
       "warning an Extrusion needs a crossSection and a spine"},
      {"a.wrl", vrml2("ElevationGrid { xDimension 2 zDimension 2 height [ 1 ] }"),
       "warning an ElevationGrid needs"},
      {"a.iv", iv("DrawStyle { style INVISIBLE } Sphere { }"), "warning DrawStyle INVISIBLE is not rendered"},
      {"a.iv", iv("USE nothing Sphere { }"), "warning USE nothing: expected a name"},
  });
}

// --- OBJ and MTL
// --------------------------------------------------------------------------------------------

TEST(BrokenFiles, Obj) {
  const test::Folder folder;
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n", face = "f 1 2 3\n";
  expectSaid(
      {
          {"a.obj", triangle + "usemtl gold\n" + face, "warning the material \"gold\" is not defined"},
          {"a.obj", "mtllib none.mtl\n" + triangle + face, "warning materials: cannot read"},
          {"a.obj", triangle + "banana 1 2\n" + face, "warning \"banana\" is not known and is skipped"},
          {"a.obj", triangle + "l 1 2\n" + face, "warning points and lines are left out"},
          {"a.obj", triangle + "cstype bezier\ncurv 0 1 1 2\n" + face,
           "warning curves and surfaces are left out"},
          {"a.obj", triangle + "f 1 2\n" + face, "warning a face of fewer than 3 points is left out"},
          {"a.obj", triangle + "f 1/9 2/9 3/9\n", "warning normals or uv that the file does not have"},
          {"a.obj", triangle + "v 0 0 0 1 2\n" + face, "warning v: expected 3 numbers, found 5"},
          {"a.obj", triangle + "vn 0 0 1 4\n" + face, "warning vn: expected at most 3 numbers"},
          {"a.obj", triangle + "usemtl\n" + face, "warning usemtl: expected the name of a material"},
          {"a.obj", triangle, "warning the file has no triangle that can be seen"},
          {"a.obj", triangle + "f 1 2 9\n", "error uses point 9"},
          {"a.obj", triangle + "f 1 2 99999999999\n", "error uses point 99999999999, but there are 3 points"},
          {"a.obj", triangle + "v 1e39 0 0\n" + face,
           "warning expected a finite number of at most 3.4e38, found \"1e39\""},
          {"a.obj", triangle + "f 1 2 \\ \n3\n", "error expected a corner"},
      },
      folder.path() + "/");

  const std::pair<const char*, const char*> materials[] = {
      {"Kd red 0 0", "warning Kd: expected a number, found \"red\""},
      {"Kd 1 0", "warning Kd: expected 3 numbers, found 2"},
      {"Kd 255 0 0", "warning Kd: expected 0 to 1, found 255"},
      {"Kd 1e39 0 0", "warning Kd: expected a finite number of at most 3.4e38, found \"1e39\""},
      {"Ns -5", "warning Ns: expected at least 0, found -5"},
      {"Ni 0", "warning Ni: expected at least 0.001, found 0"},
      {"d 5", "warning d: expected 0 to 1, found 5"},
      {"d 0", "warning d 0 makes the material transparent"},
      {"Tr 1", "warning Tr 1 without d would make the material invisible: it is read as opaque"},
      {"d 0\nTr 0", "warning d 0 and Tr 0 contradict each other"},
      {"KD 1 0 banana", "warning Kd: expected a number, found \"banana\""},
      {"illum 99", "warning illum: expected 0 to 10, found 99"},
      {"banana 1", "warning \"banana\" is not known and is skipped"},
      {"map_Kd", "warning map_Kd: expected the name of a picture"},
      {"map_Kd wood.png", "warning the texture \"wood.png\" cannot be read"},
      {"map_Ns -s 2 2 2 shine.png", "warning the texture \"shine.png\" cannot be read"},
      {"bump -bm 0.5 dents.png", "warning the texture \"dents.png\" cannot be read"},
      {"disp deep.png", "warning the texture \"deep.png\" cannot be read"},
      {"bump a.png\ndisp deep.png", "warning the texture \"deep.png\" of disp is not rendered yet"},
      {"decal sticker.png", "warning the texture \"sticker.png\" of decal is not rendered yet"},
      {"norm normals.png", "warning the texture \"normals.png\" cannot be read"},
      {"refl -type sphere sky.png", "warning the texture \"sky.png\" of refl is not rendered yet"},
      {"map_d holes.png", "warning the texture \"holes.png\" cannot be read"},
      {"map_d -mm 0 2 holes.png", "warning the option \"-mm\" of a texture is ignored"},
      {"map_Ka a.png\nmap_Kd b.png\nmap_Ks c.png\nmap_Ke d.png\nmap_bump e.png",
       "warning the textures \"a.png\", \"e.png\", \"b.png\" and 2 more cannot be read"},
  };
  for (const auto& [line, expected] : materials) {
    writeFile(folder.path() + "/a.mtl", std::string("newmtl gold\n") + line + "\n");
    expectSaid({{"a.obj", "mtllib a.mtl\n" + triangle + "usemtl gold\n" + face, expected}},
               folder.path() + "/");
  }
  writeFile(folder.path() + "/a.mtl", "Kd 1 0 0\n");
  expectSaid(
      {{"a.obj", "mtllib a.mtl\n" + triangle + face, "warning expected \"newmtl\" before the first line"}},
      folder.path() + "/");
}

TEST(BrokenFiles, ObjTellsWhere) {
  const test::Folder folder;
  const std::string triangle = "v 0 0 0\nv 1 \\\n0 0\nv 0 1 0\n";
  const auto place = [&](const std::string& text) {
    Messages messages;
    Message first;
    try {
      readScene(folder / "a.obj", text, messages);
      first = messages.all().at(0);
    } catch (const Error& error) {
      first = error.messages().front();
    }
    return std::to_string(first.place.line) + ":" + std::to_string(first.place.column);
  };
  EXPECT_EQ(place(triangle + "f 1 2 9\n"), "5:7");
  EXPECT_EQ(place(triangle + "f 1 \\\r\n2 -4\n"), "6:3");
  EXPECT_EQ(place(triangle + "f 1 2 0\n"), "5:7");
  EXPECT_EQ(place(triangle + "f 1/1 2/1 3/1\n"), "5:3");
  EXPECT_EQ(place(triangle + "mtllib a.mtl none.mtl\nf 1 2 3\n"), "5:8");
  writeFile(folder / "a.mtl", "newmtl \\\nm\nKd 1 \\\n red 0\n");
  EXPECT_EQ(place(triangle + "mtllib a.mtl\nusemtl m\nf 1 2 3\n"), "4:2");
}

// --- PLY, OFF, STL
// ------------------------------------------------------------------------------------------

TEST(BrokenFiles, Meshes) {
  const auto ply = [](const std::string& header, const std::string& more = "") {
    return "ply\nformat ascii 1.0\n" + header +
           "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n" + more +
           "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  };
  const std::string body = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  expectSaid({
      {"a.ply", "ply\nformat ascii 9.0\nelement vertex 0\nend_header\n",
       "error expected version 1.0 of the format"},
      {"a.ply", ply("") + body + "banana\n", "warning bytes after the last element are ignored: 7"},
      {"a.ply", ply("comment TextureFile wood one.png\n") + body,
       "warning the texture \"wood one.png\" is not rendered yet"},
      {"a.ply", ply("", "property float x\n") + "0 0 0 0\n1 0 0 0\n0 1 0 0\n3 0 1 2\n",
       "error expected each property once"},
      {"a.ply", ply("", "property float nx\n") + "0 0 0 1\n1 0 0 1\n0 1 0 1\n3 0 1 2\n",
       "warning expected all of nx, ny and nz of a vertex, found 1"},
      {"a.ply",
       ply("", "property uchar red\nproperty uchar green\nproperty uchar blue\n") +
           "0 0 0 900 0 0\n1 0 0 0 0 0\n0 1 0 0 0 0\n3 0 1 2\n",
       "warning colours that are not from 0 to 255: 1"},
      {"a.ply", ply("") + "0 0 0\n1 0 0\n0 1 0\n3 0 1 1.5\n", "error a number that no point has"},
      {"a.ply", ply("") + "0 0 0\n1 0 0\n0 1 0\n2 0 1\n", "warning faces of fewer than 3 points"},
      {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 7\n",
       "warning colours of faces that are numbers of a table are left out"},
      {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 banana\n",
       "warning expected a colour after its points, found \"banana\""},
      {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\nbanana\n",
       "warning what follows the last face is ignored"},
      {"a.off", "OFF\n3 1 -4\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "error expected the number of edges"},
      {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n", "warning faces of fewer than 3 points"},
      {"a.stl", "solid a\nendsolid a\n", "warning the file has no triangle"},
      {"a.stl",
       "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nvertex 1 1 "
       "0\nendloop\nendfacet\nendsolid\n",
       "error expected \"endloop\""},
      {"a.stl",
       "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 2 0 "
       "0\nendloop\nendfacet\nendsolid\n",
       "warning triangles without area"},
  });
}

// --- glTF
// ---------------------------------------------------------------------------------------------------

/// A triangle; `change` is what is replaced by `by`.
std::string gltf(const std::string& change = {}, const std::string& by = {}) {
  std::string text = R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
 "nodes": [{"mesh": 0, "rotation": [0, 0, 0, 1]}],
 "materials": [{"pbrMetallicRoughness": {"metallicFactor": 0}, "alphaMode": "OPAQUE"}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0, "mode": 4}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
 "bufferViews": [{"buffer": 0, "byteLength": 36}],
 "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
  if (change.empty()) return text;
  const std::size_t at = text.find(change);
  EXPECT_NE(at, text.npos) << change;
  return text.replace(at, change.size(), by);
}
std::string gltfWith(const std::string& property) {
  return gltf("\"scene\": 0", "\"scene\": 0, " + property);
}
std::string gltfMaterial(const std::string& property) { return gltf("\"alphaMode\": \"OPAQUE\"", property); }
std::string gltfLight(const std::string& light) {
  return gltfWith(
      "\"extensionsUsed\": [\"KHR_lights_punctual\"], \"extensions\": {\"KHR_lights_punctual\": {\"lights\": "
      "[{" +
      light + "}]}}");
}

TEST(BrokenFiles, Gltf) {
  EXPECT_EQ(said("a.gltf", gltf()), "");
  const std::string draco =
      "\"extensions\": {\"KHR_draco_mesh_compression\": {\"bufferView\": 0, \"attributes\": {\"POSITION\": "
      "0}}}, ";
  expectSaid({
      {"a.gltf", gltf("\"2.0\"", "\"3.0\""), "error expected glTF of version 2.0, found version 3"},
      {"a.gltf", gltf("\"2.0\"", "\"1.0\""), "error expected glTF of version 2.0, found version 1"},
      {"a.gltf", gltf("\"2.0\"", "\"2.0\", \"minVersion\": \"2.9\""),
       "error expected glTF of version 2.0, found version 2.9"},
      {"a.gltf", gltf("\"version\": \"2.0\"", "\"copyright\": \"me\""), "error asset.version"},
      {"a.gltf", gltfWith("\"extensionsRequired\": [\"XYZ_banana\"]"),
       "error requires the extension \"XYZ_banana\""},
      {"a.gltf", gltfWith("\"extensionsUsed\": [\"XYZ_banana\"]"),
       "warning extensions that are not read: \"XYZ_banana\""},
      {"a.gltf",
       gltf("\"attributes\": {\"POSITION\": 0}, ", "\"attributes\": {\"POSITION\": 0}, " + draco)
           .replace(gltf("\"attributes\": {\"POSITION\": 0}, ", "\"attributes\": {\"POSITION\": 0}, " + draco)
                        .find("{\"bufferView\": 0, \"componentType\""),
                    17, "{"),
       "error meshes[0].primitives[0]: cannot be decompressed (KHR_draco_mesh_compression): "
       "the data do not begin as Draco's do"},
      {"a.gltf", gltf("\"material\": 0", "\"material\": 99"),
       "error material: expected a number of one of the 1 materials, found 99"},
      {"a.gltf", gltf("\"mesh\": 0", "\"mesh\": 5"), "error nodes[0].mesh"},
      {"a.gltf", gltf("\"mesh\": 0", "\"mesh\": 0, \"camera\": 3"),
       "error nodes[0].camera: the file has no cameras, found"},
      {"a.gltf", gltf("\"mesh\": 0", "\"mesh\": 0, \"skin\": 3"), "error nodes[0].skin"},
      {"a.gltf", gltf("\"scene\": 0", "\"scene\": 7"),
       "error scene: expected a number of one of the 1 scenes"},
      {"a.gltf",
       gltf("\"mesh\": 0", "\"mesh\": 0, \"extensions\": {\"KHR_lights_punctual\": {\"light\": 4}}"),
       "error the file has no lights, found"},
      {"a.gltf", gltf("[0, 0, 0, 1]", "[0, 0, 0, 0]"),
       "warning nodes[0].rotation: expected a quaternion of length 1"},
      {"a.gltf", gltf("[0, 0, 0, 1]", "[0, 0, 1]"), "error nodes[0].rotation: expected 4 numbers"},
      {"a.gltf", gltf("\"mesh\": 0", "\"mesh\": 0, \"matrix\": [1, 0]"),
       "error nodes[0].matrix: expected 16 numbers"},
      {"a.gltf", gltf("\"mesh\": 0", "\"mesh\": 0, \"scale\": [0, 1, 1]"),
       "warning objects are left out whose transform makes them flat"},
      {"a.gltf", gltf("\"mesh\": 0", "\"mesh\": 0, \"translaton\": [0, 1, 1]"),
       "warning unknown property \"translaton\" of nodes[0] is ignored [did you mean \"translation\"?]"},
      {"a.gltf", gltf("\"metallicFactor\": 0", "\"metallicFactor\": 5"),
       "warning metallicFactor: expected 0 to 1, found 5"},
      {"a.gltf", gltf("\"metallicFactor\": 0", "\"metallicFactor\": \"shiny\""),
       "error metallicFactor: expected a number, found \"shiny\""},
      {"a.gltf", gltf("\"metallicFactor\": 0", "\"baseColorFactor\": [1, 0, 0]"),
       "error baseColorFactor: expected 4 numbers"},
      {"a.gltf", gltf("\"metallicFactor\": 0", "\"baseColorTexture\": {\"index\": 3}"),
       "error the file has no textures, found"},
      {"a.gltf", gltfMaterial("\"alphaMode\": \"BANANA\""),
       "error alphaMode: expected one of OPAQUE, MASK, BLEND"},
      {"a.gltf", gltfMaterial("\"emissiveFactor\": [9, 0, 0]"), "warning emissiveFactor: expected 0 to 1"},
      {"a.gltf", gltfMaterial("\"extensions\": {\"KHR_materials_ior\": {\"ior\": 0.5}}"),
       "warning ior: expected at least 1"},
      {"a.gltf", gltf("\"mode\": 4", "\"mode\": 9"), "error mode: expected 0 to 6"},
      {"a.gltf", gltf("\"mode\": 4", "\"mode\": 1"), "warning points and lines are left out"},
      {"a.gltf", gltf("\"POSITION\": 0", "\"NORMAL\": 0"), "warning has no POSITION"},
      {"a.gltf", gltf("\"POSITION\": 0", "\"POSITION\": 8"),
       "error POSITION: expected a number of one of the 1 accessors"},
      {"a.gltf", gltf("\"POSITION\"", "\"POSITON\""),
       "warning unknown attribute \"POSITON\" of meshes[0].primitives[0].attributes is ignored [did you mean "
       "\"POSITION\"?]"},
      {"a.gltf", gltf("\"mesh\": 0", "\"children\": [0]"), "error nodes[0]: it is its own child"},
      {"a.gltf", gltf("{\"mesh\": 0,", "{\"children\": [1]}, {\"children\": [0],"),
       "error nodes[0]: it stands below itself: it is a child of nodes[1]"},
      {"a.gltf", gltf("{\"mesh\": 0,", "{\"children\": [1, 2]}, {\"children\": [2]}, {\"mesh\": 0,"),
       "error nodes[2]: expected one parent, found two, nodes[1] and nodes[0]"},
      {"a.gltf", gltf("\"count\": 3", "\"count\": 99999999999999999999999"),
       "error accessors[0].count: expected a whole number that 64 bits can hold, found 9.9"},
      {"a.gltf", gltf("\"count\": 3", "\"count\": -3"),
       "error accessors[0].count: expected a whole number of at least 1, found -3"},
      {"a.gltf", gltf("5126", "99999999999999"), "error accessors[0].componentType: expected 5120 to 5126"},
      {"a.gltf", gltf("\"byteLength\": 36}]", "\"byteLength\": 1.5}]"),
       "error bufferViews[0].byteLength: expected a whole number"},
      {"a.gltf", gltf("\"byteLength\": 36, \"uri\"", "\"byteLength\": 360, \"uri\""),
       "error buffers[0].uri: expected the 360 bytes that byteLength says, found 36"},
      {"a.gltf", gltf("\"byteLength\": 36, \"uri\"", "\"byteLength\": \"lots\", \"uri\""),
       "error buffers[0].byteLength: expected a whole number above 0, found \"lots\""},
      {"a.gltf", gltf("base64,AAAA", "base64,AAA!"),
       "error buffers[0].uri: expected digits of base64, found \"!\" after 3 of them"},
      {"a.gltf", gltf("data:application", "data:banana"),
       "error buffers[0].uri: expected \"data:application/octet-stream;base64,\" before the bytes"},
      {"a.gltf", gltf("\"count\": 3", "\"count\": 2"), "warning make no whole triangle"},
      {"a.gltf", gltf("\"type\": \"VEC3\"", "\"type\": \"VEC9\""), "error accessors[0].type"},
      {"a.gltf", gltfLight("\"type\": \"banana\""), "error type: expected one of directional, point, spot"},
      {"a.gltf", gltfLight("\"type\": \"point\", \"intensity\": -3"),
       "warning intensity: expected at least 0"},
      {"a.gltf", gltfLight("\"type\": \"spot\", \"spot\": {\"innerConeAngle\": 1, \"outerConeAngle\": 0.5}"),
       "warning an innerConeAngle below"},
      {"a.gltf", gltfWith("\"samplers\": [{\"wrapS\": 1}]"),
       "warning samplers[0].wrapS: expected one of 10497, 33071, 33648, found 1"},
      {"a.gltf", gltfWith("\"images\": [{\"uri\": \"data:image/png;base64,AA!\"}]"),
       "warning images[0].uri: expected digits of base64, found \"!\" after 2 of them"},
      {"a.gltf", gltfWith("\"images\": [{\"uri\": \"data:image/png;base64,\"}]"),
       "warning images[0].uri: expected a picture, found no bytes"},
      {"a.gltf", gltfWith("\"animations\": [{}, {}]"),
       "warning the first animation is played; others are left out: 1"},
      {"a.gltf",
       gltf("\"metallicFactor\": 0", "\"baseColorTexture\": {\"index\": 0}")
           .insert(1, "\"textures\": [{\"source\": 0}], \"images\": [{\"uri\": \"wood.png\"}], "),
       "warning the texture \"wood.png\" cannot be read"},
      {"a.gltf",
       gltfMaterial("\"normalTexture\": {\"index\": 0}")
           .insert(1,
                   "\"textures\": [{\"source\": 0}], \"images\": [{\"bufferView\": 0, \"mimeType\": "
                   "\"image/png\", \"name\": \"dents\"}], "),
       "warning the texture \"a.gltf#images[0]\" cannot be read"},
  });
}

TEST(BrokenFiles, GltfCountsPointsFromZero) {
  const std::string file = test::sourceFolder() + "/tests/corpus/gltf/broken_index.gltf";
  EXPECT_EQ(said(file, readFile(file)), "error: COLOR_0: expected one vector for each point\n");
}

TEST(BrokenFiles, GltfTellsWhereItsJsonIsBroken) {
  const auto fails = [](const std::string& change, const std::string& by) {
    Messages messages;
    try {
      readScene("a.gltf", gltf(change, by), messages);
    } catch (const Error& error) {
      return toString(error.messages().front());
    }
    return std::string("no error");
  };
  const auto expect = [](const std::string& text, std::string_view start, std::string_view hint = {}) {
    EXPECT_TRUE(text.starts_with(start)) << text;
    EXPECT_NE(text.find(hint), text.npos) << text;
  };
  expect(fails("\"rotation\"", "rotation"),
         "a.gltf:2:24: error: expected a name in quotation marks, found \"rotation\"");
  expect(fails("0, 1]}],", "0, 1],}],"),
         "a.gltf:2:49: error: expected a name in quotation marks, found \"}\"",
         "JSON allows no comma after the last element");
  expect(fails("[0, 0, 0, 1]", "[0, 0, 0 1]"), "a.gltf:2:45: error: expected ']', found \"1\"");
  expect(fails("\"mode\": 4", "\"mode\": 1e400"),
         "a.gltf:4:84: error: expected a number of at most 1.8e308, found \"1e400\"");
  expect(fails("\"materials\"", "// looks\n\"materials\""), "a.gltf:3:2: error: expected",
         "JSON has no comments");
  expect(fails("\"OPAQUE\"", "OPAQUE"), "a.gltf:3:77: error: expected a value, found \"OPAQUE\"");
  expect(fails("\"OPAQUE\"", "\"OPAQUE"), "a.gltf:3:77: error: expected a quotation mark at the end");
  expect(fails("AACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}]}", "\"}]"),
         "a.gltf:7:97: error: expected '}', found the end of the file");
}

// --- all formats
// --------------------------------------------------------------------------------------------

std::size_t warningsOfTextures(const std::string& file, const std::string& text) {
  Messages messages;
  readScene(file, text, messages);
  return static_cast<std::size_t>(
      std::count_if(messages.all().begin(), messages.all().end(),
                    [](const Message& m) { return m.what.starts_with("the textures"); }));
}

TEST(BrokenFiles, TexturesOfEveryFormatAreNamedOnce) {
  const test::Folder folder;
  std::string mtl, obj = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n", scene, course, out, iv, vrml, materials,
                   textures, images;
  for (int i = 0; i < 100; ++i) {
    const std::string n = std::to_string(i), picture = "picture" + n + ".png", comma = i ? ", " : "";
    mtl += "newmtl m" + n + "\nmap_Kd " + picture + "\n";
    obj += "usemtl m" + n + "\nf 1 2 3\n";
    scene += "sphere { material = { diffuse = map(\"" + picture + "\"); } }\n";
    course += "Material \"m" + n + "\" \"texture\" \"" + picture + "\" Sphere 1 \"m" + n + "\"\n";
    out += "sphere { name \"texture=" + picture + "\" numMaterials 0 }\n";
    iv += "Texture2 { filename \"" + picture + "\" } Sphere { }\n";
    vrml += "Shape { appearance Appearance { texture ImageTexture { url \"" + picture +
            "\" } } geometry Sphere { } }\n";
    materials += comma + "{\"occlusionTexture\": {\"index\": " + n +
                 "}, \"normalTexture\": {\"index\": " + n +
                 ", \"texCoord\": 1}, \"emissiveTexture\": {\"index\": " + n +
                 ", \"texCoord\": 2}}";  // of three sets of coordinates
    textures += comma + "{\"source\": " + n + "}";
    images += comma + "{\"uri\": \"" + picture + "\"}";
  }
  writeFile(folder / "a.mtl", mtl);
  EXPECT_EQ(warningsOfTextures(folder / "a.obj", obj), 1u);
  EXPECT_EQ(warningsOfTextures("a.ray", ray(scene)), 1u);
  EXPECT_EQ(warningsOfTextures("a.ray", ubc(course)), 1u);
  EXPECT_EQ(warningsOfTextures("a.out", composer(out)), 1u);
  EXPECT_EQ(warningsOfTextures("a.iv", "#Inventor V2.1 ascii\n" + iv), 1u);
  EXPECT_EQ(warningsOfTextures("a.wrl", "#VRML V2.0 utf8\n" + vrml), 1u);
  const std::string list = gltf(R"([{"pbrMetallicRoughness": {"metallicFactor": 0}, "alphaMode": "OPAQUE"}])",
                                "[" + materials + "]");
  std::string named = list;
  named.insert(1, "\"textures\": [" + textures + "], \"images\": [" + images + "], ");
  EXPECT_EQ(warningsOfTextures("a.gltf", named), 1u);
}

TEST(BrokenFiles, KeepTheNamesOfTheirTextures) {
  const test::Folder folder;
  writeFile(folder / "a.mtl", "newmtl m\nmap_Kd wood.png\nmap_Ns shine.png\n");
  Messages messages;
  using Names = std::vector<std::pair<std::string, std::string>>;
  const auto maps = [&](const std::string& file, const std::string& text) {
    const Scene read = readScene(file, text, messages);
    Names names;
    for (const FieldTexture& t : read.materials.at(read.objects.at(0).material).textures)
      names.emplace_back(t.field, t.texture->model.as<ImageMap>()->file.file);
    return names;
  };
  EXPECT_EQ(maps(folder / "a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n"),
            (Names{{"diffuse", "wood.png"}, {"shininess", "shine.png"}}));
  const Names wood{{"diffuse", "wood.png"}};
  EXPECT_EQ(maps("a.ray", ray("sphere { material = { diffuse = map(\"wood.png\"); } }")), wood);
  EXPECT_EQ(maps("a.ray", ubc("Material \"n\" \"texture\" \"wood.png\" Sphere 1 \"n\"")), wood);
  EXPECT_EQ(maps("a.out", composer("sphere { name \"texture=wood.png\" numMaterials 0 }")), wood);
  EXPECT_EQ(maps("a.iv", "#Inventor V2.1 ascii\nTexture2 { filename \"wood.png\" } Sphere { }"),
            (Names{{"ambient", "wood.png"}, {"diffuse", "wood.png"}}));
}

TEST(BrokenFiles, InventorFieldsMayStandWithoutAValue) {
  EXPECT_EQ(said("a.iv",
                 "#Inventor V2.1 ascii\nSeparator { Complexity { value ~ textureQuality 0.2 } "
                 "Material { diffuseColor 1 0 0 ~ transparency ~ } Sphere { radius 2 } }"),
            "");
}

[[noreturn]] void readWithLittleMemory(const std::string& file) {
  constexpr std::uint64_t kLittle = 100'000'000;
  os::limitMemory(kLittle, 1);
  Messages messages;
  try {
    readScene(file, messages);
  } catch (const Error& error) {
    std::fprintf(stderr, "%s", error.what());
    std::_Exit(static_cast<int>(error.fault()));
  }
  std::_Exit(0);
}

// A stand-in for a machine without memory: nothing may be taken beyond a bound.
TEST(BrokenFiles, LackOfMemoryNamesTheFile) {
  if (kSanitized) GTEST_SKIP() << "sanitizers keep terabytes of addresses";
  const test::Folder folder;
  const std::string file = folder / "large.ray";
  // 50 million triangles of a subdivided one take gigabytes.
  writeFile(file, ray("polymesh { points = ((0,0,0), (1,0,0), (0,1,0), (1,1,0)); faces = ((0,1,2), (1,3,2)); "
                      "subdivide = 10; }"));
  EXPECT_EXIT(readWithLittleMemory(file), testing::ExitedWithCode(static_cast<int>(Fault::limit)),
              "large.ray: error: out of memory while reading the scene");
}

}  // namespace
}  // namespace trace::broken_files_test
