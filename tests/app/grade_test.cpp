// Folders of pictures against folders of references: pairs, verdicts, their order, the page.
#include "app/grade.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "base/file.h"
#include "image/codec.h"
#include "image/flip.h"
#include "support/folder.h"

namespace trace::test {
namespace {

namespace fs = std::filesystem;

class GradeTest : public testing::Test {
 protected:
  GradeTest() { fs::create_directories(out("sub")), fs::create_directories(reference("sub")); }

  std::string out(const std::string& name) const { return root_ / ("out/" + name); }
  std::string reference(const std::string& name) const { return root_ / ("ref/" + name); }
  static void grey(const std::string& path, double value, int width = 8) {
    Picture picture(width, 4);
    for (Color& c : picture.pixels) c = Color(value);
    writePicture(path, picture);
  }
  GradeTask task() const {
    GradeTask t;
    t.folder = root_ / "out", t.reference = root_ / "ref";
    t.difference = {0, usualPixelsPerDegree()};
    return t;
  }
  static std::vector<std::string> lines(const Grades& grades) {
    std::vector<std::string> all;
    for (const GradedPair& pair : grades.pairs)
      all.push_back(pair.name + " " + pair.file + " " + std::string(verdictText(pair.verdict)));
    return all;
  }

  const Folder root_;
};

TEST_F(GradeTest, WorstFirst) {
  for (const char* name : {"a.png", "b.png", "c.png", "d.png", "e.png", "f.png", "sub/g.png"})
    grey(reference(name), 0.5);
  grey(out("a.bmp"), 0.5);  // another suffix
  grey(out("b.png"), 0.6);
  grey(out("c.png"), 0.9);
  writeFile(out("d.png"), "no picture");
  grey(out("e.png"), 0.5, 9);
  grey(out("g.png"), 0.5);  // not in the sub-folder
  grey(out("sub/f.png"), 0.5);
  const Grades grades = grade(task());
  EXPECT_EQ(lines(grades),
            (std::vector<std::string>{"f.png  missing", "sub/g.png  missing", "d.png d.png unreadable",
                                      "e.png e.png sizes differ", "c.png c.png beyond", "b.png b.png beyond",
                                      "a.png a.bmp identical"}));
  EXPECT_EQ(grades.passed, 1u);
  EXPECT_EQ(grades.extra, (std::vector<std::string>{"g.png", "sub/f.png"}));
}

TEST_F(GradeTest, LimitsDecide) {
  grey(reference("a.png"), 0.5);
  grey(out("a.png"), 0.52);
  GradeTask t = task();
  t.limits = {parseLimit("max=5")};
  EXPECT_EQ(lines(grade(t)).front(), "a.png a.png within");
  t.limits.push_back(parseLimit("rmse=4"));
  EXPECT_EQ(lines(grade(t)).front(), "a.png a.png beyond");
}

TEST_F(GradeTest, OfTwoPicturesTheOneWithTheSameSuffixCounts) {
  grey(reference("a.png"), 0.5);
  grey(out("a.bmp"), 0.1);
  grey(out("a.png"), 0.5);
  EXPECT_EQ(lines(grade(task())).front(), "a.png a.png identical");
}

TEST_F(GradeTest, RendersScenesWhenAsked) {
  const std::string scene =
      "SBT-raytracer 1.0 camera {} directional_light { direction=(0,0,-1); color=(1,1,1); } "
      "scale(10, sphere { material={ emissive=(1,1,1); } })";
  writeFile(out("white.ray"), scene);
  writeFile(out("broken.ray"), "SBT-raytracer 1.0 sphere {");
  grey(out("white.png"), 0);
  grey(reference("white.png"), 1);
  grey(reference("broken.png"), 1);
  GradeTask t = task();
  t.renderScenes = true;
  t.choices = {{"width", "8", {}}, {"height", "4", {}}};
  const Grades grades = grade(t);
  EXPECT_EQ(lines(grades),
            (std::vector<std::string>{"broken.png broken.ray unreadable", "white.png white.ray identical"}));
  EXPECT_NE(grades.pairs[0].problem.find("broken.ray:1:"), std::string::npos) << grades.pairs[0].problem;
}

TEST_F(GradeTest, FoldersMustBeThere) {
  EXPECT_THROW(grade(task()), Error);  // no reference picture
  GradeTask t = task();
  t.folder = root_ / "nowhere";
  EXPECT_THROW(grade(t), Error);
}

TEST_F(GradeTest, ThePageHoldsEverythingAndLoadsNothing) {
  const std::string odd = "<b>&\"x.png";
  grey(reference(odd), 0.5);
  grey(out(odd), 0.9);
  grey(reference("same.png"), 0.5);
  grey(out("same.png"), 0.5);
  const Grades grades = grade(task());
  const std::string page = gradePage(task(), grades);
  EXPECT_EQ(page.find(odd), std::string::npos);
  EXPECT_NE(page.find("&lt;b&gt;&amp;&quot;x.png"), std::string::npos);
  for (const char* outside : {"http:", "https:", "src=\"//", "<link", "@import", "url("})
    EXPECT_EQ(page.find(outside), std::string::npos) << outside;
  std::size_t pictures = 0;
  for (std::size_t at = page.find("src=\"data:image/"); at != std::string::npos;
       at = page.find("src=\"data:image/", at + 1))
    ++pictures;
  EXPECT_EQ(pictures, 5u);  // four of the pair that differs, one of the other
  EXPECT_EQ(grades.pairs.front().name, odd);
}

}  // namespace
}  // namespace trace::test
