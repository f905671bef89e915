// Folders of pictures against folders of references: pairs, verdicts, their order, the page.
#include "app/compare/grade.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "base/files/file.h"
#include "image/codecs/codec.h"
#include "image/comparison/flip.h"
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

TEST_F(GradeTest, FollowsLinksAndMindsNoCase) {
  for (const char* name : {"spheres.png", "final.png", "linked.png", "B.png", "b.png", "sub/deep.png"})
    grey(reference(name), 0.5);
  grey(out("Spheres.PNG"), 0.5);
  grey(out("b.png"), 0.5);
  fs::create_directories(out("elsewhere"));
  grey(out("elsewhere/v7.png"), 0.5);
  fs::create_symlink("elsewhere/v7.png", out("final.png"));
  fs::create_symlink("nowhere", out("linked.png"));
  fs::remove(out("sub"));
  fs::create_directory(root_ / "other");
  grey(root_ / "other/Deep.Png", 0.5);
  fs::create_directory_symlink("../other", out("sub"));
  fs::create_directory_symlink("..", out("elsewhere/round"));  // without end, were it followed
  const Grades grades = grade(task());
  EXPECT_EQ(lines(grades),
            (std::vector<std::string>{"B.png  missing",  // b.png is the other's
                                      "linked.png linked.png unreadable", "b.png b.png identical",
                                      "final.png final.png identical", "spheres.png Spheres.PNG identical",
                                      "sub/deep.png sub/Deep.Png identical"}));
}

/// As someone who may not read everything, even where the tests run as root.
class WithoutPrivileges {
 public:
  WithoutPrivileges() {
    if (user_ == 0) done_ = seteuid(65534) == 0;
  }
  ~WithoutPrivileges() {
    if (done_ && user_ == 0 && seteuid(0) != 0) std::abort();
  }
  explicit operator bool() const { return done_; }

 private:
  const uid_t user_ = geteuid();
  bool done_ = true;
};

TEST_F(GradeTest, GoesOnWhereAFileOrAFolderCannotBeRead) {
  for (const char* name : {"a.png", "b.png", "sub/c.png"}) grey(reference(name), 0.5), grey(out(name), 0.5);
  fs::create_directory(reference("secret"));
  const auto closed = {out("b.png"), out("sub"), reference("secret")};
  for (const std::string& path : closed) fs::permissions(path, fs::perms::none);
  std::vector<std::string> found;
  {
    const WithoutPrivileges user;
    if (!user) GTEST_SKIP() << "SKIPPED: this user may read everything";
    found = lines(grade(task()));
  }
  for (const std::string& path : closed) fs::permissions(path, fs::perms::owner_all);
  EXPECT_EQ(found, (std::vector<std::string>{"b.png b.png unreadable", "secret/  unreadable",
                                             "sub/c.png  unreadable", "a.png a.png identical"}));
}

TEST_F(GradeTest, GoesOnWhereAFileOfScenesCannotBeRead) {
  writeFile(out("white.ray"),
            "SBT-raytracer 1.0 camera {} scale(10, sphere { material={ emissive=(1,1,1); } })");
  fs::create_symlink("/proc/self/mem", out("broken.ray"));  // a file that nobody can read from its start
  fs::create_symlink("nowhere", out("gone.ray"));
  grey(reference("white.png"), 1), grey(reference("broken.png"), 1), grey(reference("gone.png"), 1);
  GradeTask t = task();
  t.renderScenes = true;
  t.choices = {{"width", "8", {}}, {"height", "4", {}}};
  EXPECT_EQ(lines(grade(t)),
            (std::vector<std::string>{"broken.png broken.ray unreadable", "gone.png gone.ray unreadable",
                                      "white.png white.ray identical"}));
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
