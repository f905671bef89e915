// Fields of other formats that Trace does not show are reported once, with their place: none is lost in
// silence.
#include <gtest/gtest.h>

#include <string>

#include "mesh_helpers.h"

namespace trace::reported_fields_test {
namespace {

/// How many warnings of reading the bytes have that text.
std::size_t told(const std::string& bytes, const std::string& what) {
  Messages messages;
  readScene("test.ray", bytes, messages);
  std::size_t count = 0;
  for (const Message& m : messages.all()) count += m.what.find(what) != std::string::npos;
  return count;
}

TEST(ReportedFields, OfObj) {
  const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\n", face = "f 1 2 3\n";
  const struct {
    const char *line, *told;
  } kRows[]{{"s 1", "smoothing groups are not shown"},
            {"bevel on", "\"bevel\" is not shown"},
            {"c_interp on", "\"c_interp\" is not shown"},
            {"d_interp on", "\"d_interp\" is not shown"},
            {"lod 1", "\"lod\" is not shown"},
            {"shadow_obj a.obj", "\"shadow_obj\" is not shown"},
            {"trace_obj a.obj", "\"trace_obj\" is not shown"},
            {"maplib a.map", "\"maplib\" is not shown"},
            {"usemap a", "\"usemap\" is not shown"},
            {"call a.obj", "\"call\" is not shown"},
            {"csh a", "\"csh\" is not shown"},
            {"p 1", "points and lines are left out"},
            {"l 1 2", "points and lines are left out"},
            {"curv 0 1 1 2", "curves and surfaces are left out"},
            {"surf 0 1 0 1 1 2 3", "curves and surfaces are left out"},
            {"usemtl nobody", "is not defined"},
            {"nonsense 1", "is not known"}};
  for (const auto& row : kRows) {
    const std::string line = std::string(row.line) + "\n";
    EXPECT_EQ(told(points + line + line + face + line + face, row.told), 1u) << row.line;
    EXPECT_EQ(told(points + face, row.told), 0u) << row.line;
  }
  EXPECT_EQ(told(points + "s 1\nf 1//1 2//1 3//1\n", "smoothing"), 0u) << "there are normals";
  EXPECT_EQ(told(points + "s 1\ns off\n" + face, "smoothing"), 0u);
  EXPECT_EQ(warningsOfFile(points + "lod 2\n" + face), "5:1: \"lod\" is not shown");
}

TEST(ReportedFields, OfPly) {
  const auto ply = [](const std::string& ofPoint, const std::string& ofFace) {
    return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n" +
           (ofPoint.empty() ? "" : "property float " + ofPoint + "\n") +
           "element face 1\nproperty list uchar int vertex_indices\n" +
           (ofFace.empty() ? "" : "property float " + ofFace + "\n") + "end_header\n0 0 0" +
           (ofPoint.empty() ? "" : " 1") + "\n1 0 0" + (ofPoint.empty() ? "" : " 1") + "\n0 1 0" +
           (ofPoint.empty() ? "" : " 1") + "\n3 0 1 2" + (ofFace.empty() ? "" : " 1") + "\n";
  };
  EXPECT_EQ(warningsOfFile(ply("", "")), "");
  for (const std::string name : {"quality", "confidence", "opacity", "specular_power", "ambient_red"})
    EXPECT_EQ(told(ply(name, ""), "properties of \"vertex\" are not shown: " + name), 1u) << name;
  for (const std::string name : {"quality", "nx", "alpha", "material_index"})
    EXPECT_EQ(told(ply("", name), "properties of \"face\" are not shown: " + name), 1u) << name;
}

}  // namespace
}  // namespace trace::reported_fields_test
