// A class: whose file is which reference's, points, causes, what is kept between runs, and the page.
#include "app/grading/class_grade.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>

#include "base/files/file.h"
#include "image/codecs/codec.h"
#include "image/comparison/flip.h"
#include "support/folder.h"

namespace trace::test {
namespace {

namespace fs = std::filesystem;

/// Without symmetry; may be moved by fractions of a pixel.
Picture classPicture(double right = 0, double down = 0) {
  Picture picture(96, 72);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const double u = x - right, v = y - down;
      Color c(0.05 + 0.8 * u / 96, 0.05 + 0.6 * v / 72, 0.1 + 0.3 * std::sin(0.13 * u + 0.07 * v + 1));
      const double inside = 15 - std::hypot(u - 30, v - 25);
      picture.at(x, y) = clamp01(lerp(std::clamp(inside + 0.5, 0.0, 1.0), c, Color(0.9, 0.2, 0.1)));
    }
  return picture;
}

class ClassGradeTest : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return root_ / name; }
  void picture(const std::string& name, const Picture& p) const {
    fs::create_directories(fs::path(path(name)).parent_path());
    writePicture(path(name), p, Rounding::nearest);
  }
  void text(const std::string& name, const std::string& bytes) const {
    fs::create_directories(fs::path(path(name)).parent_path());
    writeFile(path(name), bytes);
  }
  ClassTask task() const {
    ClassTask t;
    t.grade.folder = path("in"), t.grade.reference = path("ref");
    t.grade.difference = {1, usualPixelsPerDegree()};
    t.results = path("class.results");
    return t;
  }
  static const ClassStudent& student(const ClassGrades& grades, const std::string& name) {
    for (const ClassStudent& s : grades.students)
      if (s.name == name) return s;
    throw std::runtime_error("no student " + name);
  }
  Rubric rubric(const std::string& rows) const {
    text("rubric.txt", rows);
    return readRubric(path("rubric.txt"));
  }
  std::string rubricError(const std::string& rows) const {
    try {
      rubric(rows);
    } catch (const Error& error) {
      return toString(error.messages().front());
    }
    return "none";
  }

  const Folder root_;
};

TEST_F(ClassGradeTest, NamesMayDifferInCaseFoldersAndFormat) {
  const auto of = [](std::vector<std::string> references, std::vector<std::string> files) {
    return assignSubmissions(references, files);
  };
  using Files = std::vector<std::string>;
  EXPECT_EQ(of({"a.png", "b.png"}, {"hw3/out/A.BMP", "B.Png", "c.png"}), (Files{"hw3/out/A.BMP", "B.Png"}));
  EXPECT_EQ(of({"a.png"}, {"old/a.png", "a.jpg"}), Files{"a.jpg"}) << "the fewest folders";
  EXPECT_EQ(of({"a.png"}, {"x/a.jpg", "x/a.png"}), Files{"x/a.png"}) << "the same suffix";
  EXPECT_EQ(of({"a.png"}, {"A.png", "a.png"}), Files{"a.png"}) << "the same letter case";
  EXPECT_EQ(of({"a.png"}, {"a.PNG", "a.bmp", "A.png"}), Files{"a.PNG"}) << "letter case before suffix";
  EXPECT_EQ(of({"a.png"}, {"b.png"}), Files{""});
  EXPECT_EQ(of({"day/a.png", "night/a.png"}, {"Night/A.png", "out/day/a.bmp", "a.png"}),
            (Files{"out/day/a.bmp", "Night/A.png"}));
}

TEST_F(ClassGradeTest, FilesThatAreNotComparedAreNamed) {
  picture("ref/a.png", classPicture());
  picture("in/ann/a/a.png", classPicture()), picture("in/ann/b/a.png", classPicture(9, 3));
  const ClassGrades grades = gradeClass(task());
  const ClassStudent& ann = student(grades, "ann");
  EXPECT_EQ(ann.pairs.at(0).file, "a/a.png");
  ASSERT_EQ(ann.passedOver.size(), 1u);
  EXPECT_EQ(passedOverText(ann.passedOver[0]), "b/a.png: not compared; a/a.png was");
  EXPECT_NE(classPage(task(), grades).find("ann/b/a.png: not compared; a/a.png was"), std::string::npos);
  EXPECT_TRUE(ann.extra.empty());
}

TEST_F(ClassGradeTest, EachStudentGetsCausesAndPointsWorstFirst) {
  const Picture right = classPicture();
  Picture flipped = right, gamma = right, exchanged = right;
  for (int y = 0; y < right.height; ++y)
    for (int x = 0; x < right.width; ++x) {
      const Color& c = right.at(x, y);
      flipped.at(x, right.height - 1 - y) = c;
      gamma.at(x, y) = Color(std::pow(c.r, 1 / 2.2), std::pow(c.g, 1 / 2.2), std::pow(c.b, 1 / 2.2));
      exchanged.at(x, y) = Color(c.b, c.g, c.r);
    }
  picture("ref/disc.png", right);
  picture("in/good/Deep/er/DISC.bmp", right);
  picture("in/flipped/disc.png", flipped);
  picture("in/gamma/disc.png", gamma);
  picture("in/half/disc.png", classPicture(0.5, 0.5));
  picture("in/exchanged/disc.tga", exchanged);
  picture("in/other/disc.png", Picture(96, 72));
  picture("in/small/disc.png", Picture(9, 7));
  text("in/broken/disc.png", "no picture");
  fs::create_directories(path("in/empty"));
  ClassTask t = task();
  t.rubric =
      rubric("# homework 3\nscene d*c 10\ncause flipped 80%\ncause gamma 90%  # mild\ncause shift 95%\n");
  const ClassGrades grades = gradeClass(t);
  ASSERT_EQ(grades.students.size(), 9u);
  EXPECT_EQ(grades.possible, 10);
  const auto pair = [&](const char* name) { return student(grades, name).pairs.at(0); };
  EXPECT_EQ(pair("good").verdict, Verdict::identical);
  EXPECT_EQ(pair("flipped").mistakes, std::vector<std::string>{"flipped"});
  EXPECT_EQ(pair("gamma").mistakes, std::vector<std::string>{"gamma"});
  EXPECT_EQ(pair("half").mistakes, std::vector<std::string>{"shift"});
  EXPECT_EQ(pair("exchanged").mistakes, std::vector<std::string>{"channels"});
  EXPECT_EQ(pair("other").verdict, Verdict::beyond);
  EXPECT_EQ(pair("other").mistakes, std::vector<std::string>{"black"});
  EXPECT_EQ(pair("small").verdict, Verdict::sizesDiffer);
  EXPECT_EQ(pair("broken").verdict, Verdict::unreadable);
  EXPECT_EQ(pair("empty").verdict, Verdict::missing);
  const std::pair<const char*, double> points[] = {{"good", 10},   {"half", 9.5},    {"gamma", 9},
                                                   {"flipped", 8}, {"exchanged", 0}, {"other", 0},
                                                   {"small", 0},   {"broken", 0},    {"empty", 0}};
  for (const auto& [name, expected] : points)
    EXPECT_NEAR(student(grades, name).total, expected, 1e-12) << name;
  EXPECT_EQ(grades.students.back().name, "good");
  for (std::size_t i = 1; i < grades.students.size(); ++i)
    EXPECT_LE(grades.students[i - 1].total, grades.students[i].total);
}

TEST_F(ClassGradeTest, ASecondRunComparesNothingAndMakesTheSamePage) {
  picture("ref/a.png", classPicture()), picture("ref/b.png", classPicture(9, 3));
  picture("in/ann/a.png", classPicture()), picture("in/ann/b.png", classPicture());
  picture("in/bob/a.png", classPicture(1, 0)), picture("in/bob/b.png", classPicture(9, 3));
  const ClassGrades first = gradeClass(task());
  EXPECT_EQ(first.computed, 4u);
  const ClassGrades second = gradeClass(task());
  EXPECT_EQ(second.computed, 0u);
  EXPECT_EQ(classPage(task(), second), classPage(task(), first));
  EXPECT_EQ(classCsv(second), classCsv(first));

  picture("in/bob/a.png", classPicture(3, 0));
  EXPECT_EQ(gradeClass(task()).computed, 1u) << "one picture has changed";
  ClassTask stricter = task();
  stricter.grade.difference.tolerance = 0;
  EXPECT_EQ(gradeClass(stricter).computed, 4u) << "an option has changed";
  picture("ref/a.png", classPicture(2, 2));
  EXPECT_EQ(gradeClass(stricter).computed, 2u) << "a reference has changed";
}

TEST_F(ClassGradeTest, DamagedResultsAreComputedAgainAndOtherFilesAreKept) {
  picture("ref/a.png", classPicture());
  picture("in/ann/a.png", classPicture(1, 0)), picture("in/bob/a.png", classPicture(3, 0));
  const std::string page = classPage(task(), gradeClass(task()));
  const std::string sound = readFile(path("class.results"));
  for (std::size_t size = 40; size < sound.size(); size += sound.size() / 7) {
    writeFile(path("class.results"), sound.substr(0, size));
    const ClassGrades again = gradeClass(task());
    EXPECT_GE(again.computed, 1u) << size;
    EXPECT_EQ(classPage(task(), again), page) << size;
  }
  writeFile(path("class.results"), "somebody's notes");
  EXPECT_THROW(gradeClass(task()), Error);
  EXPECT_EQ(readFile(path("class.results")), "somebody's notes");
}

TEST_F(ClassGradeTest, NoSubmissionLeadsToTheReferences) {
  TRACE_NEEDS_LINKS();
  picture("ref/a.png", classPicture());
  fs::create_directories(path("in/thief"));
  fs::create_symlink(path("ref/a.png"), path("in/thief/a.png"));
  const ClassGrades grades = gradeClass(task());
  EXPECT_EQ(grades.students.at(0).pairs.at(0).verdict, Verdict::unreadable);
  text("in/thief/b.ray",
       "SBT-raytracer 1.0\nsettings { width = 4; height = 4; backdrop = \"" + path("ref/a.png") + "\"; }\n");
  fs::rename(path("in/thief/b.ray"), path("in/thief/sub.ray"));
  picture("ref/sub.png", classPicture());
  ClassTask t = task();
  t.grade.renderScenes = true;
  const ClassGrades rendered = gradeClass(t);
  EXPECT_EQ(rendered.students.at(0).pairs.at(1).verdict, Verdict::unreadable);
  EXPECT_NE(rendered.students.at(0).pairs.at(1).problem.find("may"), std::string::npos)
      << rendered.students.at(0).pairs.at(1).problem;
}

TEST_F(ClassGradeTest, ScenesAreRenderedAgainIfAnyFileOfTheStudentHasChanged) {
  const std::string white =
      "SBT-raytracer 1.0 camera {} scale(10, sphere { material={ emissive=(1,1,1); } })";
  text("in/ann/Scenes/White.ray", white);
  Picture reference(8, 4);
  for (Color& c : reference.pixels) c = Color(1);
  picture("ref/white.png", reference);
  ClassTask t = task();
  t.grade.renderScenes = true;
  t.grade.choices = {{"width", "8", {}}, {"height", "4", {}}};
  const ClassGrades grades = gradeClass(t);
  EXPECT_EQ(grades.students.at(0).pairs.at(0).verdict, Verdict::identical)
      << grades.students.at(0).pairs.at(0).problem;
  EXPECT_EQ(gradeClass(t).computed, 0u);
  text("in/ann/Scenes/other.txt", "a file that the scene might read");
  EXPECT_EQ(gradeClass(t).computed, 1u);
}

TEST_F(ClassGradeTest, ThePageAndTheTableEscapeWhatStudentsWrote) {
  TRACE_NEEDS_ANY_NAMES();
  picture("ref/a.png", classPicture());
  picture("in/=<u>\"x/a.png", classPicture(1, 0));
  const ClassGrades grades = gradeClass(task());
  const std::string page = classPage(task(), grades), csv = classCsv(grades);
  EXPECT_EQ(page.find("<u>"), std::string::npos);
  EXPECT_NE(page.find("=&lt;u&gt;&quot;x"), std::string::npos);
  for (const char* outside : {"http:", "https:", "src=\"//", "<link", "@import"})
    EXPECT_EQ(page.find(outside), std::string::npos) << outside;
  EXPECT_NE(csv.find("\r\n\"'=<u>\"\"x\",0,1,0,beyond,"), std::string::npos) << csv;
}

TEST_F(ClassGradeTest, ARubricSaysWhereItIsWrong) {
  EXPECT_NE(rubricError("scene a 1\ncause fliped 50%\n").find("rubric.txt:2:7: error: expected flipped"),
            std::string::npos)
      << rubricError("scene a 1\ncause fliped 50%\n");
  EXPECT_NE(rubricError("cause gamma 50\n").find(":1:13: error: expected a share"), std::string::npos);
  EXPECT_NE(rubricError("cause gamma 150%\n").find("from 0% to 100%"), std::string::npos);
  EXPECT_NE(rubricError("scene a\n").find("found the end of the line"), std::string::npos);
  EXPECT_NE(rubricError("scene a 1 2\n").find(":1:11:"), std::string::npos);
  EXPECT_NE(rubricError("metric flop 1 50%\n").find(":1:8:"), std::string::npos);
  EXPECT_NE(rubricError("points 3\n").find("expected scene, cause or metric"), std::string::npos);
  EXPECT_THROW(
      {
        try {
          rubric("scene a\n\ncause x 1%\nfoo\nscene b 1\n");
        } catch (const Error& error) {
          EXPECT_EQ(error.messages().size(), 3u);
          throw;
        }
      },
      Error);
  const Rubric steps =
      rubric("metric max 5 90%\nmetric max 20 50%\nmetric psnr 30 20%\nscene a 2\nscene * 3\n");
  EXPECT_EQ(steps.pointsOf("a"), 2);
  EXPECT_EQ(steps.pointsOf("ab"), 3);
  GradedPair pair;
  pair.verdict = Verdict::beyond;
  pair.values.assign(metrics().size(), 0);
  const auto value = [&](const char* name) -> double& {
    return pair.values[static_cast<std::size_t>(&findMetric(name) - metrics().data())];
  };
  value("max") = 4, value("psnr") = 10;
  EXPECT_EQ(steps.shareOf(pair), 0.9);
  value("max") = 12;
  EXPECT_EQ(steps.shareOf(pair), 0.5);
  value("max") = 50, value("psnr") = 35;
  EXPECT_EQ(steps.shareOf(pair), 0.2);
  value("psnr") = 10;
  EXPECT_EQ(steps.shareOf(pair), 0);
}

TEST_F(ClassGradeTest, ARowThatFitsNoReferenceIsAnError) {
  picture("ref/glass.png", classPicture()), picture("ref/shadows.png", classPicture());
  picture("in/ann/glass.png", classPicture());
  ClassTask t = task();
  t.rubric = rubric("scene glas 10\nscene sh* 2\nscene * 1\nscene mirrors 3\n");
  try {
    gradeClass(t);
    FAIL() << "expected an error";
  } catch (const Error& error) {
    ASSERT_EQ(error.messages().size(), 2u);
    EXPECT_EQ(error.messages()[0].hint, "did you mean \"glass\"?");
    EXPECT_EQ(error.messages()[0].place.column, 7);
    EXPECT_EQ(error.messages()[1].place.line, 4);
  }
}

TEST_F(ClassGradeTest, FilesWithoutAReferenceAreListed) {
  picture("ref/shadows.png", classPicture());
  picture("in/ann/shadow.png", classPicture()), picture("in/ann/old/other.png", classPicture());
  picture("in/bob/shadows.png", classPicture()), picture("in/bob/old/shadows.png", classPicture());
  const ClassGrades grades = gradeClass(task());
  const ClassStudent &ann = student(grades, "ann"), &bob = student(grades, "bob");
  EXPECT_EQ(ann.extra, (std::vector<std::string>{"old/other.png", "shadow.png"}));
  EXPECT_EQ(ann.pairs.at(0).verdict, Verdict::missing);
  EXPECT_EQ(ann.pairs.at(0).problem, "missing; there is shadow.png");
  EXPECT_TRUE(bob.extra.empty());
  const std::string page = classPage(task(), grades);
  EXPECT_NE(page.find("Without a reference: ann/old/other.png, ann/shadow.png"), std::string::npos);
  EXPECT_NE(classCsv(grades).find(",missing,missing; there is shadow.png,"), std::string::npos);
}

TEST_F(ClassGradeTest, RowsOfTheTableAreLines) {
  TRACE_NEEDS_ANY_NAMES();
  picture("ref/a.png", classPicture());
  text("in/ann/a.png", readFile(path("ref/a.png")).substr(0, 60));
  text("in/bob\nx/a.png", "none");
  const std::string csv = classCsv(gradeClass(task()));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 3) << csv;
}

TEST_F(ClassGradeTest, FoldersMustBeThere) {
  EXPECT_THROW(gradeClass(task()), Error);
  picture("ref/a.png", classPicture());
  EXPECT_THROW(gradeClass(task()), Error);
  picture("in/ann/a.png", classPicture());
  picture("ref/a.bmp", classPicture());
  EXPECT_THROW(gradeClass(task()), Error) << "two references have one name";
}

}  // namespace
}  // namespace trace::test
