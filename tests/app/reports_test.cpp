// Small files of which users of other programs complained, and what is expected of each: the material of the
// findings, which is no part of the repository. Without it the test is skipped, by name.
#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/session/session.h"
#include "support/shared.h"

namespace trace::reports_test {
namespace {

namespace fs = std::filesystem;

struct Report {
  const char* file;
  /// Of 255: what the middle of the picture shows; or its corners, from the top left.
  std::optional<Color> middle{};
  std::vector<Color> corners{};
  const char* warning = "";   ///< what has to be said; "" for nothing in particular
  double least = 15;          ///< of the brightest channel of the mean
  bool ofLetterCase = false;  ///< no warning where names in any letter case are one file, as on Windows
};

const Color kRed{204, 51, 51};
const std::vector<Color> kQuad{{255, 0, 0}, {0, 255, 0}, {0, 0, 255}, {255, 255, 255}};

struct Rendered {
  Picture picture;
  std::string warnings;
};

Rendered render(const std::string& file) {
  Session session;
  const std::vector<Choice> small{{"width", "32", {}}, {"threads", "1", {}}};
  session.open(file, small);
  session.build();
  session.renderPicture();
  Rendered rendered{session.picture(), {}};
  for (const Message& message : session.messages().all()) rendered.warnings += message.what + "\n";
  return rendered;
}

Color meanOf(const Picture& picture) {
  Color sum;
  for (const Color& c : picture.pixels) sum += Color(min(c.r, 1), min(c.g, 1), min(c.b, 1));
  return sum * (255.0 / static_cast<double>(picture.pixels.size()));
}

bool near(const Color& a, const Color& b, double tolerance) {
  return maxComponent(Color(std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b))) <= tolerance;
}

/// Which of red, green and blue the colour has, whatever the light: a surface that is lit is dimmer than its
/// picture.
Color hue(const Color& color) {
  const double most = maxComponent(color);
  const auto on = [&](double x) { return x > 0.75 * most && most > 0.02 ? 255.0 : 0.0; };
  return {on(color.r), on(color.g), on(color.b)};
}

const std::vector<Report>& reports() {
  static const std::vector<Report> kReports{
      {.file = "s12_degenerate_normal_flip.stl", .warning = "are turned", .least = 60},
      {.file = "o15_Tr1.obj", .warning = "Tr 1 without d"},
      {.file = "p04_face_uv.ply", .corners = kQuad},
      {.file = "p07_face_colour.ply"},
      {.file = "x1_luminance_chroma_red.ray", .middle = kRed},
      {.file = "x4_xyz_chromaticities.ray", .middle = kRed},
      {.file = "tga_br0.ray", .corners = kQuad},
      {.file = "o04_bom.obj"},
      {.file = "g09_bom.gltf"},
      {.file = "o03_utf16.obj"},
      {.file = "v01_gz.wrl"},
      {.file = "s04_upper.stl"},
      {.file = "s05_extra_bytes.stl", .warning = "37 bytes after the last facet"},
      {.file = "f03_no_header.off"},
      {.file = "o38_only_mtllib_first.obj"},
      {.file = "o33_cr_only.obj"},
      {.file = "r16_trailing_garbage.ray"},
      {.file = "o34_semicolon_hash.obj"},
      {.file = "o01_trailing_slash.obj"},
      {.file = "o07_nanunused.obj", .warning = "expected a finite number"},
      {.file = "p12_negidx.ply", .warning = "a number that no point has"},
      {.file = "p16_extra_values_at_line_end.ply", .warning = "more; they are ignored", .least = 2},
      {.file = "g17_unused_accessor0.gltf", .warning = "nothing uses it"},
      {.file = "pj_noeoi.ray", .warning = "lacks its end marker"},
      {.file = "g02_sparse.gltf"},
      {.file = "p02_face_first.ply"},
      {.file = "h2_plusY.ray", .corners = kQuad},
      {.file = "h7_oldrle.ray"},
      {.file = "b1_rle8.ray"},
      {.file = "b2_v3_56.ray"},
      {.file = "x2_single_G.ray", .middle = Color(127)},
      {.file = "v03_extern.wrl"},
      {.file = "o13_mtl_space.obj"},
      {.file = "o11_opt_after.obj", .corners = kQuad},
      {.file = "o25_casefile.obj",
       .corners = kQuad,
       .warning = "letters differ in their case",
       .ofLetterCase = true},
      {.file = "g26_back_doublesided.gltf"},
      {.file = "r05_spot_target.ray"},
      {.file = "r07_maps.ray"},
      {.file = "r09_csg.ray", .least = -1},  // the ball of radius 1 takes away the whole box
  };
  return kReports;
}

TEST(Reports, EachFileIsAsItsUserExpects) {
  const std::string folder = test::sharedFolder() + "/findings/reports/";
  if (!fs::exists(folder)) GTEST_SKIP() << folder << " is absent";
  const bool anyCase = fs::exists(folder + "O25_CASEFILE.OBJ");
  for (const Report& report : reports()) {
    Rendered rendered;
    ASSERT_NO_THROW(rendered = render(folder + report.file)) << report.file;
    const Color mean = meanOf(rendered.picture);
    EXPECT_GT(maxComponent(mean), report.least) << report.file << " is black: " << rendered.warnings;
    if (!(anyCase && report.ofLetterCase)) {
      EXPECT_NE(rendered.warnings.find(report.warning), std::string::npos)
          << report.file << ": " << rendered.warnings;
    }
    EXPECT_EQ(rendered.warnings.find("cannot be read"), std::string::npos)
        << report.file << ": " << rendered.warnings;
    const int w = rendered.picture.width, h = rendered.picture.height;
    if (report.middle) {
      EXPECT_TRUE(near(rendered.picture.at(w / 2, h / 2) * 255, *report.middle, 2)) << report.file;
    }
    if (report.corners.empty()) continue;
    for (int corner = 0; corner < 4; ++corner) {
      const Color at = rendered.picture.at(corner % 2 ? 2 * w / 3 : w / 3, corner / 2 ? 2 * h / 3 : h / 3);
      EXPECT_EQ(hue(at), report.corners[static_cast<std::size_t>(corner)])
          << report.file << " corner " << corner;
    }
  }
}

/// A file that is added there is asked about here.
TEST(Reports, NoneIsForgotten) {
  const std::string folder = test::sharedFolder() + "/findings/reports/";
  if (!fs::exists(folder)) GTEST_SKIP() << folder << " is absent";
  std::set<std::string> known{"v03_lib.wrl", "README.md", "my mat.mtl"};
  for (const Report& report : reports()) known.insert(report.file);
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string(), suffix = entry.path().extension().string();
    const bool isScene = suffix != ".mtl" && suffix != ".png" && suffix != ".jpg" && suffix != ".bmp" &&
                         suffix != ".hdr" && suffix != ".exr" && suffix != ".tga";
    EXPECT_TRUE(!isScene || known.contains(name)) << name;
  }
}

}  // namespace
}  // namespace trace::reports_test
