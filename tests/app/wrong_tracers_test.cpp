// Twenty tracers that are wrong, made of our own by its options, by its scene and by its picture: a class
// page names what each does.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>

#include "app/grading/class_grade.h"
#include "app/session/session.h"
#include "base/files/file.h"
#include "image/codecs/codec.h"
#include "image/comparison/flip.h"
#include "support/folder.h"
#include "support/wrong_room.h"

namespace trace::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSettings = "width = 96; depth = 2;";

struct Wrong {
  std::string student, cause;  ///< a part of the sentence
  std::vector<Choice> choices{};
  std::string from{}, to{};                ///< an edit of the scene
  std::function<void(Picture&)> change{};  ///< of the picture
};

Picture moved(const Picture& picture, const std::function<Color(int, int)>& at) {
  Picture result = picture;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) result.at(x, y) = at(x, y);
  return result;
}

std::vector<Wrong> wrongTracers() {
  const auto each = [](const std::function<Color(const Color&)>& of) {
    return [of](Picture& picture) {
      for (Color& c : picture.pixels) c = of(c);
    };
  };
  const auto curve = [](double power) {
    return [power](const Color& c) {
      return Color(std::pow(c.r, power), std::pow(c.g, power), std::pow(c.b, power));
    };
  };
  return {
      {.student = "upside-down",
       .cause = "upside down",
       .change =
           [](Picture& p) { p = moved(p, [q = p](int x, int y) { return q.at(x, q.height - 1 - y); }); }},
      {.student = "mirrored",
       .cause = "mirrored left to right",
       .change =
           [](Picture& p) { p = moved(p, [q = p](int x, int y) { return q.at(q.width - 1 - x, y); }); }},
      {.student = "turned",
       .cause = "turned by 180 degrees",
       .change = [](Picture& p) { std::reverse(p.pixels.begin(), p.pixels.end()); }},
      {.student = "bgr", .cause = "red and blue", .change = each([](const Color& c) {
                                                    return Color(c.b, c.g, c.r);
                                                  })},
      {.student = "gamma", .cause = "gamma", .change = each(curve(1 / 2.2))},
      {.student = "darker-gamma", .cause = "gamma", .change = each(curve(2.2))},
      {.student = "half-brightness", .cause = "0.5", .change = each([](const Color& c) { return c * 0.5; })},
      {.student = "half-pixel",
       .cause = "--pixel-position center",
       .choices = {{"pixel-position", "center", {}}}},
      {.student = "one-pixel",
       .cause = "moved one pixel",
       .change =
           [](Picture& p) { p = moved(p, [q = p](int x, int y) { return q.at(std::max(0, x - 1), y); }); }},
      {.student = "convention", .cause = "--like ut", .choices = {{"like", "ut", {}}}},
      {.student = "phong", .cause = "--highlight phong", .choices = {{"highlight", "phong", {}}}},
      {.student = "no-shadows",
       .cause = "without shadows",
       .from = "material = { ",
       .to = "material = { shadow = 0; "},
      {.student = "depth-less", .cause = "--depth 1", .choices = {{"depth", "1", {}}}},
      {.student = "no-recursion", .cause = "--depth 0", .choices = {{"depth", "0", {}}}},
      {.student = "no-reflection",
       .cause = "with reflective (0, 0, 0) in mirror",
       .from = "reflective = (0.8, 0.8, 0.8);",
       .to = "reflective = (0, 0, 0);"},
      {.student = "no-bending",
       .cause = "does not bend light",
       .from = "index = 1.5",
       .to = "index = 1.0003"},
      {.student = "no-ambient",
       .cause = "without ambient light",
       .from = "ambient_light { color = (0.3, 0.3, 0.34); }",
       .to = ""},
      {.student = "sun-reversed",
       .cause = "directional lights from the opposite side",
       .from = "direction = (-0.6, -1, -0.3)",
       .to = "direction = (0.6, 1, 0.3)"},
      {.student = "no-attenuation",
       .cause = "without attenuation by distance",
       .from = "constant_attenuation_coeff = 0.4; linear_attenuation_coeff = 0.1; "
               "quadratic_attenuation_coeff = 0;",
       .to =
           "constant_attenuation_coeff = 1; linear_attenuation_coeff = 0; quadratic_attenuation_coeff = 0;"},
      {.student = "orthographic",
       .cause = "--projection orthographic",
       .choices = {{"projection", "orthographic", {}}}},
  };
}

class WrongTracers : public testing::Test {
 protected:
  /// The picture of the room, edited.
  Picture rendered(const Wrong& wrong) const {
    std::string text = wrongRoom(kSettings);
    if (!wrong.from.empty()) {
      EXPECT_NE(text.find(wrong.from), text.npos) << wrong.student;
      for (std::size_t at = 0; (at = text.find(wrong.from, at)) != text.npos; at += wrong.to.size() + 1)
        text.replace(at, wrong.from.size(), wrong.to);
    }
    const std::string file = root_ / "edited.ray";
    writeFile(file, text);
    Session session;
    session.open(file, wrong.choices);
    session.build();
    session.renderPicture();
    Picture picture = developed(session.picture(), developmentOf(session.settings()));
    if (wrong.change) wrong.change(picture);
    return picture;
  }
  void hand(const std::string& name, const Picture& picture) const {
    fs::create_directories(fs::path(root_ / name).parent_path());
    writePicture(root_ / name, picture, Rounding::truncate);
  }
  const Folder root_;
};

TEST_F(WrongTracers, EachIsNamed) {
  fs::create_directories(root_ / "scenes");
  writeFile(root_ / "scenes/Room.ray", wrongRoom(kSettings));
  hand("ref/room.png", rendered({"", ""}));
  hand("in/right/room.png", rendered({"", ""}));
  const std::vector<Wrong> all = wrongTracers();
  ASSERT_EQ(all.size(), 20u);
  for (const Wrong& wrong : all) hand("in/" + wrong.student + "/room.png", rendered(wrong));
  ClassTask task;
  task.grade.folder = root_ / "in", task.grade.reference = root_ / "ref",
  task.grade.scenes = root_ / "scenes";
  task.grade.difference = {1, usualPixelsPerDegree()};
  task.results = root_ / "class.results";
  const ClassGrades grades = gradeClass(task);
  ASSERT_EQ(grades.students.size(), 21u);
  for (const ClassStudent& student : grades.students) {
    const GradedPair& pair = student.pairs.at(0);
    const auto wrong =
        std::find_if(all.begin(), all.end(), [&](const Wrong& w) { return w.student == student.name; });
    if (wrong == all.end()) {
      EXPECT_EQ(pair.verdict, Verdict::identical);
      continue;
    }
    EXPECT_FALSE(passes(pair.verdict)) << student.name;
    EXPECT_NE(pair.cause.find(wrong->cause), std::string::npos) << student.name << ": " << pair.cause;
    const bool isOfOnePixel = pair.cause.find("lacks") != std::string::npos;
    EXPECT_NE(pair.mistakes.empty(), !isOfOnePixel) << student.name;
  }
  const std::string page = classPage(task, grades);
  const ClassGrades again = gradeClass(task);
  EXPECT_EQ(again.computed, 0u);
  EXPECT_EQ(classPage(task, again), page) << "from what was kept";
}

}  // namespace
}  // namespace trace::test
