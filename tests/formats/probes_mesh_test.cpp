// Probes of OBJ, MTL, PLY, STL and OFF.
#include <gtest/gtest.h>

#include <string>

#include "scene_probes.h"
#include "support/gltf.h"

namespace trace::probes_mesh_test {
namespace {

TEST(Probes, OfObj) {
  const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n", face = "f 1 2 3\n", plain = points + face;
  const auto line = [&](const std::string& text) { return points + text + "\n" + text + "\n" + face + face; };
  const std::string twice = points + face + face;
  const auto row = [&](const std::string& field, const std::string& text, const std::string& told = {}) {
    return Probe{field, twice, line(text), told};
  };
  std::vector<Probe> probes{
      {"v x y z", plain, "v 0 0 0\nv 2 0 0\nv 0 1 0\n" + face},
      {"v x y z w", plain, "v 0 0 0 1\nv 1 0 0 0.5\nv 0 1 0 1\n" + face},
      {"v x y z r g b", plain, "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\n" + face},
      {"vt u v", plain, points + "vt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n"},
      {"vt u v w", points + "vt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n",
       points + "vt 0 0 7\nvt 1 0 7\nvt 0 1 7\nf 1/1 2/2 3/3\n"},
      {"vn", points + "vn 0 0 1\nf 1//1 2//1 3//1\n", points + "vn 0 1 1\nf 1//1 2//1 3//1\n"},
      {"f", points + "v 1 1 0\n" + face, points + "v 1 1 0\nf 1 2 4 3\n"},
      {"f -1", points + "v 1 1 0\n" + face, points + "v 1 1 0\nf -4 -3 -1\n"},
      {"f v/vt", points + "vt 0 0\nvt 1 0\nvt 0 1\n" + face,
       points + "vt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n"},
      {"f v//vn", points + "vn 0 1 1\n" + face, points + "vn 0 1 1\nf 1//1 2//1 3//1\n"},
      {"fo", points + "v 1 1 0\n" + face, points + "v 1 1 0\nfo 1 2 4 3\n"},
      {"o", plain, points + "o table\n" + face},
      {"g", plain, points + "g table\n" + face},
      row("s", "s 1", "smoothing groups"),
      {"mtllib", points + "usemtl red\n" + face, "mtllib red.mtl\n" + points + "usemtl red\n" + face},
      {"usemtl", "mtllib red.mtl\n" + plain, "mtllib red.mtl\n" + points + "usemtl red\n" + face},
      {"\\ at a line's end", plain, "v 0 0 0\nv 1 0 \\\n0\nv 0 2 \\\n0\n" + face},
      {"#", plain, "# a triangle\n" + points + "f 1 2 3 # the one\n"},
      {"p", plain, plain + "p 1\np 2\n", "points and lines"},
      {"l", plain, plain + "l 1 2\nl 2 3\n", "points and lines"},
      {"curv", plain, plain + "curv 0 1 1 2\n", "curves and surfaces"},
      {"curv2", plain, plain + "curv2 1 2\n", "curves and surfaces"},
      {"surf", plain, plain + "surf 0 1 0 1 1 2 3\n", "curves and surfaces"},
  };
  for (const char* word : {"vp 1 2", "cstype bspline", "deg 2", "bmat u 1 0 0 1", "step 1", "parm u 0 1",
                           "trim 0 1 1", "hole 0 1 1", "scrv 0 1 1", "sp 1", "end", "con 1 0 1 1 2 0 1 1",
                           "ctech cparm 1", "stech cparma 1 1", "mg 1 0.5"}) {
    const std::string text(word);
    probes.push_back(row(text.substr(0, text.find(' ')), text));
  }
  for (const char* word : {"bevel on", "c_interp on", "d_interp on", "lod 1", "shadow_obj a.obj",
                           "trace_obj a.obj", "maplib a.map", "usemap a", "call a.obj", "csh a"}) {
    const std::string text(word), key = text.substr(0, text.find(' '));
    probes.push_back(row(key, text, "\"" + key + "\" is not shown (2 times, first here)"));
  }
  const SceneProbes read("probe.obj", {{"red.mtl", "newmtl red\nKd 1 0 0\n"}});
  expectProbes(knownObjFields(), probes, true, read);
}

TEST(Probes, OfMtl) {
  const std::string obj =
      "mtllib probe.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl a\nf 1/1 2/2 3/3\n";
  const SceneProbes objects("probe.obj", {{"p.png", test::smallPng(255, 0, 0)}});
  const auto read = [&](const std::string& mtl) {
    objects.add("probe.mtl", mtl);
    return objects(obj);
  };
  const std::string head = "newmtl a\nKd 0.5 0.5 0.5\nKs 0.4 0.4 0.4\nillum 2\n";
  std::vector<Probe> probes;
  const auto add = [&](const std::string& field, const std::string& lines, const std::string& told = {},
                       const std::string& before = {}) {
    probes.push_back({field, head + before, head + before + lines + "\n", told});
  };
  probes.push_back({"newmtl", "newmtl b\nKd 1 0 0\nnewmtl a\n", "newmtl b\nnewmtl a\nKd 1 0 0\n"});
  add("Ka", "Ka 0.1 0.2 0.3");
  add("Kd", "Kd 0.1 0.2 0.3");
  add("Ks", "Ks 0.1 0.2 0.3");
  add("Ke", "Ke 0.1 0.2 0.3");
  add("Kd with one number", "Kd 0.3");
  add("Kd spectral", "Kd spectral a.rfl 1", "Kd: expected a number");
  add("Kd xyz", "Kd xyz 0.1 0.2 0.3", "Kd: expected a number");
  add("Ns", "Ns 50");
  add("Ni", "Ni 1.3");
  add("d", "d 0.5");
  add("d -halo", "d -halo 0.5", "d -halo is not shown", "d 0.5\n");
  add("Tr", "Tr 0.5");
  add("Tf", "Tf 0.5 0.2 0.5", "", "d 0.5\n");
  add("Kt", "Kt 0.5 0.2 0.5", "", "d 0.5\n");
  add("Tf of an opaque material", "Tf 0.5 0.2 0.5");
  add("illum 0", "illum 0", "illum 0");
  add("illum 1", "illum 1");
  probes.push_back({"illum 2", head + "illum 1\n", head});
  for (int model : {3, 4, 5, 6, 7, 9})
    add("illum " + std::to_string(model), "illum " + std::to_string(model), "", "Tf 0.5 0.5 0.5\n");
  add("illum 8", "illum 8", "illum 8");
  add("illum 10", "illum 10", "illum 10");
  add("sharpness", "sharpness 60", "\"sharpness\"");
  for (const char* key : {"Pr", "Pm", "Ps"}) add(key, std::string(key) + " 0.3");
  add("Pc", "Pc 0.5", "", "Pr 0.3\n");
  add("Pcr", "Pcr 0.5", "", "Pr 0.3\nPc 0.5\n");
  add("aniso", "aniso 0.5", "", "Pr 0.3\n");
  add("anisor", "anisor 0.5", "", "Pr 0.3\naniso 0.5\n");
  add("Ns beside Pr", "Ns 50\nKs 0 0 1\nillum 3", "", "Pr 0.3\n");
  add("map_Ka", "map_Ka p.png");
  add("map_Kd", "map_Kd p.png");
  add("map_Ks", "map_Ks p.png");
  add("map_Ke", "map_Ke p.png");
  add("map_Ns", "map_Ns p.png");
  add("map_Ns beside Pr", "map_Ns p.png", "p.png", "Pr 0.3\n");
  add("map_d", "map_d p.png");
  for (const char* key : {"map_Tr", "map_norm", "decal", "refl", "map_refl"})
    add(key, std::string(key) + " p.png", "p.png");
  for (const char* key :
       {"map_Pr", "map_Pm", "map_Ps", "norm", "map_Bump", "map_bump", "bump", "disp", "map_Disp", "map_disp"})
    add(key, std::string(key) + " p.png");
  add("bump beside norm", "bump q.png", "q.png", "norm p.png\n");
  add("disp beside bump", "disp q.png", "q.png", "bump p.png\n");
  add("map_aat", "map_aat on", "\"map_aat\"");
  add("-bm", "bump -bm 2 p.png", "", "bump p.png\n");
  const std::string map = "map_Kd p.png\n";
  for (const char* option : {"-o 0.5 0.5 0", "-s 2 2 2", "-clamp on", "-imfchan r", "-colorspace sRGB"}) {
    const std::string text(option);
    add(text.substr(0, text.find(' ')), "map_Kd " + text + " p.png", "", map);
  }
  for (const char* option : {"-t 1 1 1", "-boost 2", "-cc on", "-mm 0 1", "-texres 64"}) {
    const std::string text(option), key = text.substr(0, text.find(' '));
    add(key, "map_Kd " + text + " p.png", "\"" + key + "\" of a texture is ignored", map);
  }
  add("-blendu on", "map_Kd -blendu on p.png", "", map);
  add("-blendu off", "map_Kd -blendu off p.png", "\"-blendu\"", map);
  add("-blendv off", "map_Kd -blendv off p.png", "\"-blendv\"", map);
  add("-type", "map_Kd -type sphere p.png", "", map);
  expectProbes(knownMtlFields(), probes, true, read);
}

// --- PLY ---------------------------------------------------------------------------------------------------

/// A triangle, with more properties and values.
struct PlyProbe {
  std::string head = "format ascii 1.0\n", point = "", pointValues = "", list = "vertex_indices", face = "",
              faceValues = "", elements = "", values = "";

  std::string text() const {
    std::string all =
        "ply\n" + head + "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n" + point +
        "element face 1\nproperty list uchar int " + list + "\n" + face + elements + "end_header\n";
    for (const char* at : {"0 0 0", "1 0 0", "0 1 0"}) all += at + pointValues + "\n";
    return all + "3 0 1 2" + faceValues + "\n" + values;
  }
};

std::string floats(std::initializer_list<const char*> names) {
  std::string text;
  for (const char* name : names) text += std::string("property float ") + name + "\n";
  return text;
}

TEST(Probes, OfPly) {
  const std::string plain = PlyProbe{}.text();
  const auto point = [](const std::string& field, std::initializer_list<const char*> names,
                        const std::string& values, const std::string& told = {}) {
    return Probe{field, PlyProbe{}.text(), PlyProbe{.point = floats(names), .pointValues = values}.text(),
                 told};
  };
  const auto face = [](const std::string& field, std::initializer_list<const char*> names,
                       const std::string& values, const std::string& told = {}) {
    return Probe{field, PlyProbe{}.text(), PlyProbe{.face = floats(names), .faceValues = values}.text(),
                 told};
  };
  const auto binary = [](bool big) {
    std::string bytes =
        std::string("ply\nformat binary_") + (big ? "big" : "little") +
        "_endian 1.0\nelement vertex 3\nproperty short x\nproperty short y\nproperty short z\n"
        "element face 1\nproperty list uchar uchar vertex_indices\nend_header\n";
    for (int number : {0, 0, 0, 2, 0, 0, 0, 1, 0}) {
      const char low = static_cast<char>(number);
      bytes += big ? std::string{'\0', low} : std::string{low, '\0'};
    }
    return bytes + std::string("\3\0\1\2", 4);
  };
  std::string turned = plain;
  turned.replace(turned.find("3 0 1 2"), 7, "3 0 2 1");
  const std::string uv = floats({"u", "v"}), colors = floats({"red", "green", "blue"});
  const PlyProbe colored{.point = colors, .pointValues = " 1 0 0"};
  const auto textured = [&](const std::string& head) {
    return PlyProbe{.head = "format ascii 1.0\n" + head, .point = uv, .pointValues = " 0.5 0.5"}.text();
  };
  const std::string two = "comment TextureFile p.png\ncomment TextureFile q.png\n";
  const auto cornered = [&](const std::string& more, const std::string& values) {
    return PlyProbe{.head = "format ascii 1.0\n" + two,
                    .face = "property list uchar float texcoord\n" + more,
                    .faceValues = " 6 0 0 1 0 0 1" + values}
        .text();
  };
  std::vector<Probe> probes{
      {"format ascii", binary(false), plain},
      {"format binary_little_endian", plain, binary(false)},
      {"format binary_big_endian", plain, binary(true)},
      {"comment", plain, PlyProbe{.head = "format ascii 1.0\ncomment made by hand\n"}.text()},
      {"comment TextureFile", textured(""), textured("comment TextureFile p.png\n")},
      {"obj_info", plain, PlyProbe{.head = "format ascii 1.0\nobj_info num_cols 512\n"}.text()},
      {"vertex: x y z", plain, binary(false)},
      point("vertex: nx ny nz", {"nx", "ny", "nz"}, " 0 1 1"),
      point("vertex: red green blue", {"red", "green", "blue"}, " 1 0 0"),
      point("vertex: r g b", {"r", "g", "b"}, " 1 0 0"),
      point("vertex: diffuse_red ...", {"diffuse_red", "diffuse_green", "diffuse_blue"}, " 1 0 0"),
      {"vertex: alpha", colored.text(),
       PlyProbe{.point = colors + floats({"alpha"}), .pointValues = " 1 0 0 0.5"}.text(), "transparency"},
      point("vertex: u v", {"u", "v"}, " 0.5 0.5"),
      point("vertex: s t", {"s", "t"}, " 0.5 0.5"),
      point("vertex: texture_u texture_v", {"texture_u", "texture_v"}, " 0.5 0.5"),
      point("vertex: other properties", {"quality", "confidence"}, " 1 1",
            "properties of \"vertex\" are not shown: quality, confidence"),
      {"face: vertex_indices", turned, plain},
      {"face: vertex_index", turned, PlyProbe{.list = "vertex_index"}.text(), "", plain},
      face("face: red green blue", {"red", "green", "blue"}, " 1 0 0"),
      {"face: red green blue where points have some", colored.text(),
       PlyProbe{.point = colors, .pointValues = " 1 0 0", .face = colors, .faceValues = " 0 1 0"}.text(),
       "colours of faces are left out"},
      {"face: alpha", PlyProbe{.face = colors, .faceValues = " 0 1 0"}.text(),
       PlyProbe{.face = colors + floats({"alpha"}), .faceValues = " 0 1 0 0.5"}.text(), "transparency"},
      {"face: texcoord", plain,
       PlyProbe{.face = "property list uchar float texcoord\n", .faceValues = " 6 0 0 1 0 0 1"}.text()},
      {"face: texnumber", cornered("", ""), cornered("property int texnumber\n", " 1"), "texnumber"},
      face("face: other properties", {"nx", "quality"}, " 1 1",
           "properties of \"face\" are not shown: nx, quality"),
      {"tristrips", plain,
       PlyProbe{.elements = "element tristrips 1\nproperty list int int vertex_indices\n",
                .values = "3 0 2 1\n"}
           .text()},
      {"edge", plain,
       PlyProbe{.elements = "element edge 1\nproperty int vertex1\nproperty int vertex2\n", .values = "0 1\n"}
           .text(),
       "elements \"edge\" are not shown: 1"},
      {"other elements", plain,
       PlyProbe{.elements = "element material 1\nproperty int ambient_red\n", .values = "0\n"}.text(),
       "elements \"material\" are not shown: 1"},
  };
  const SceneProbes read("probe.ply",
                         {{"p.png", test::smallPng(255, 0, 0)}, {"q.png", test::smallPng(0, 0, 255)}});
  expectProbes(knownPlyFields(), probes, true, read);
}

// --- STL, OFF ----------------------------------------------------------------------------------------------

TEST(Probes, OfStl) {
  const auto facet = [](const std::string& normal, const std::string& last) {
    return "facet normal " + normal + "\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex " + last +
           "\nendloop\nendfacet\n";
  };
  const auto solid = [](const std::string& name, const std::string& facets, const std::string& end = {}) {
    return "solid " + name + "\n" + facets + "endsolid " + end + "\n";
  };
  const std::string plain = solid("a", facet("0 0 1", "0 1 0"));
  const auto binary = [](const std::string& header, const std::vector<float>& last,
                         const std::string& attribute) {
    std::string bytes = header;
    bytes.resize(80, ' ');
    bytes += std::string("\1\0\0\0", 4);
    std::vector<float> numbers{0, 0, 1, 0, 0, 0, 1, 0, 0};
    numbers.insert(numbers.end(), last.begin(), last.end());
    bytes.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(float));
    return bytes + attribute;
  };
  const std::string none("\0\0", 2), packed = binary("made by hand", {0, 1, 0}, none);
  // Two facets, of which the header counts one or both.
  const auto counted = [&](char count) {
    std::string bytes = packed + binary("", {0, 3, 0}, none).substr(84);
    bytes[80] = count;
    return bytes;
  };
  const std::vector<Probe> probes{
      {"solid", plain, solid("b", facet("0 0 1", "0 1 0"))},
      {"facet normal", plain, solid("a", facet("0 0 -1", "0 1 0"))},
      {"vertex", plain, solid("a", facet("0 0 1", "0 2 0"))},
      {"endsolid", plain, solid("a", facet("0 0 1", "0 1 0"), "a")},
      {"binary: header", packed, binary("another text", {0, 1, 0}, none)},
      {"binary: header COLOR=", packed, binary("COLOR=\x80\x40\x20\xff", {0, 1, 0}, none), "COLOR="},
      {"binary: number of facets", counted(2), counted(1)},
      {"binary: facets", packed, binary("made by hand", {0, 2, 0}, none)},
      {"binary: attribute bytes", packed, binary("made by hand", {0, 1, 0}, "\x1f\x80"), "colours of facets"},
  };
  expectProbes(knownStlFields(), probes, false, SceneProbes("probe.stl"));
}

TEST(Probes, OfOff) {
  const auto off = [](const std::string& word, const std::string& more, const std::string& face = {}) {
    std::string text = word + "\n3 1 0\n";
    for (const char* at : {"0 0 0", "1 0 0", "0 1 0"}) text += at + more + "\n";
    return text + "3 0 1 2" + face + "\n";
  };
  const std::string plain = off("OFF", "");
  std::string edges = plain;
  edges.replace(edges.find("3 1 0"), 5, "3 1 3");
  std::string moved = plain;
  moved.replace(moved.find("0 1 0\n3"), 5, "0 2 0");
  const std::vector<Probe> probes{
      {"OFF", plain, moved},
      {"NOFF", plain, off("NOFF", " 0 1 1")},
      {"COFF", plain, off("COFF", " 1 0 0 1")},
      {"STOFF", plain, off("STOFF", " 0.5 0.5")},
      {"4OFF", plain, off("4OFF", " 1"), "points of three dimensions"},
      {"nOFF", plain, "nOFF\n3\n" + plain.substr(4), "points of three dimensions"},
      {"BINARY", plain, off("OFF BINARY", ""), "binary OFF"},
      {"number of edges", plain, edges},
      {"transparency of a point", off("COFF", " 1 0 0 1"), off("COFF", " 1 0 0 0.5"),
       "transparency of points"},
      {"colour of a face", plain, off("OFF", "", " 1.0 0.0 0.0")},
      {"colour of a face where points have some", off("COFF", " 1 0 0 1"),
       off("COFF", " 1 0 0 1", " 0.0 1.0 0.0"), "colours of faces are left out"},
      {"colour of a face as a number of a table", plain, off("OFF", "", " 4"), "numbers of a table"},
      {"transparency of a face", off("OFF", "", " 1.0 0.0 0.0"), off("OFF", "", " 1.0 0.0 0.0 0.5"),
       "transparency of faces"},
      {"#", plain, "OFF # a triangle\n" + plain.substr(4)},
  };
  expectProbes(knownOffFields(), probes, true, SceneProbes("probe.off"));
}

}  // namespace
}  // namespace trace::probes_mesh_test
