// The language of POV-Ray: what its directives, values and functions mean, and what is said of mistakes. A
// scene of spheres shows the values: the centre and radius of each.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "base/budget.h"
#include "base/files/file.h"
#include "formats/format.h"
#include "formats/pov/pov_format.h"
#include "support/folder.h"

namespace trace::pov_language_test {
namespace {

Scene sceneOf(const std::string& text) {
  Messages messages;
  return readScene("test.pov", "#version 3.7;\n" + text, messages);
}

/// The number that the expression has: the radius of a sphere.
Real valueOf(const std::string& expression, const std::string& before = {}) {
  const Scene scene = sceneOf(before + "\nsphere { 0, " + expression + " }");
  return scene.objects.at(0).worldFromObject.row[0].x;
}
Vec3 vectorOf(const std::string& expression, const std::string& before = {}) {
  const Scene scene = sceneOf(before + "\nsphere { " + expression + ", 1 }");
  const Vec3 v = scene.objects.at(0).worldFromObject.offset;
  return {v.x, v.y, -v.z};  // z turns round
}

std::string errorOf(const std::string& text, Fault fault = Fault::scene) {
  try {
    sceneOf(text);
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), fault) << error.what();
    const Message& m = error.messages().front();
    return std::to_string(m.place.line) + ":" + std::to_string(m.place.column) + ": " + m.what;
  }
  return "nothing";
}

void expectNear(const Vec3& a, const Vec3& b) {
  EXPECT_NEAR(a.x, b.x, 1e-9);
  EXPECT_NEAR(a.y, b.y, 1e-9);
  EXPECT_NEAR(a.z, b.z, 1e-9);
}

TEST(PovLanguage, NumbersAndOperators) {
  EXPECT_EQ(valueOf("1 + 2 * 3"), 7);
  EXPECT_EQ(valueOf("(1 + 2) * 3 - 4 / 2"), 7);
  EXPECT_EQ(valueOf("-2 + 5"), 3);
  EXPECT_EQ(valueOf("(2 > 1 ? 5 : 6)"), 5);
  EXPECT_EQ(valueOf("(1 = 1 & 2 != 3) + (1 > 2 | 0) + 1"), 2);
  EXPECT_EQ(valueOf("!0 + .5e1"), 6);
}

TEST(PovLanguage, Functions) {
  EXPECT_EQ(valueOf("mod(7, 4) + int(2.9) + floor(-1.5) + 4"), 7);
  EXPECT_EQ(valueOf("pow(2, 3) + sqrt(16) + abs(-1)"), 13);
  EXPECT_EQ(valueOf("select(-1, 4, 5) + select(0, 1, 2, 3) + max(1, 5, 2) - min(3, 1)"), 10);
  EXPECT_NEAR(valueOf("degrees(pi) + cos(0) + log(100) + ln(exp(1))"), 184, 1e-9);
  EXPECT_EQ(valueOf("strlen(\"four\") + val(\"2.5\") + asc(\"A\") - 65"), 6.5);
}

TEST(PovLanguage, Vectors) {
  EXPECT_EQ(vectorOf("<1, 2, 3> + 1"), (Vec3{2, 3, 4})) << "a number is promoted";
  EXPECT_EQ(vectorOf("2 * x + y - z"), (Vec3{2, 1, -1}));
  EXPECT_EQ(vectorOf("<1 2 3>"), (Vec3{1, 2, 3})) << "without commas";
  EXPECT_EQ(vectorOf("vcross(x, y)"), (Vec3{0, 0, 1}));
  expectNear(vectorOf("vrotate(x, 90 * y)"), {0, 0, -1});
  expectNear(vectorOf("vaxis_rotate(x, z, 90)"), {0, 1, 0});
  expectNear(vectorOf("vnormalize(<0, 3, 4>)"), {0, 0.6, 0.8});
  EXPECT_EQ(valueOf("vlength(<3, 4, 0>) + vdot(<1, 2, 3>, <1, 1, 1>) + <5, 6, 7>.y"), 17);
  EXPECT_EQ(valueOf("C.red + C.filter", "#declare C = rgbf <1, 2, 3, 4>;"), 5);
}

TEST(PovLanguage, NamesMacrosAndScopes) {
  EXPECT_EQ(valueOf("Twice(4) + 1", "#macro Twice(N) (2 * N) #end"), 9);
  EXPECT_EQ(valueOf("A", "#declare A = 1; #macro Set(B) #declare B = 5; #end Set(A)"), 5) << "by reference";
  EXPECT_EQ(valueOf("A", "#declare A = 1; #macro Own() #local A = 5; #end Own()"), 1);
  EXPECT_EQ(valueOf("Fact(5)", "#macro Fact(N) #if (N <= 1) 1 #else (N * Fact(N - 1)) #end #end"), 120);
  EXPECT_EQ(valueOf("A", "#declare A = 1; #declare A = A + 2;"), 3);
  EXPECT_EQ(
      valueOf("T[1][0] + dimension_size(T, 1) + dimensions(T)", "#declare T = array[2][2] {{1, 2}, {3, 4}};"),
      7);
}

TEST(PovLanguage, ConditionsAndLoops) {
  EXPECT_EQ(valueOf("A", "#declare A = 0; #for (I, 1, 4) #declare A = A + I; #end"), 10);
  EXPECT_EQ(valueOf("A", "#declare A = 0; #for (I, 10, 1, -3) #declare A = A + 1; #end"), 4);
  EXPECT_EQ(valueOf("A", "#declare A = 1; #while (A < 100) #declare A = A * 2; #end"), 128);
  EXPECT_EQ(valueOf("A", "#declare A = 1; #while (1) #declare A = A + 1; #if (A > 6) #break #end #end"), 7);
  EXPECT_EQ(valueOf("A", "#if (0) #declare A = 1; #elseif (1) #declare A = 2; #else #declare A = 3; #end"),
            2);
  const std::string chosen =
      "#switch (N) #case (1) #declare A = 10; #break #range (2, 4) #declare A = 20; #break #else #declare A "
      "= 30; #end";
  EXPECT_EQ(valueOf("A", "#declare N = 1; " + chosen), 10);
  EXPECT_EQ(valueOf("A", "#declare N = 3; " + chosen), 20);
  EXPECT_EQ(valueOf("A", "#declare N = 9; " + chosen), 30);
  EXPECT_EQ(
      valueOf("A", "#declare A = 2; #ifdef (B) #declare A = 3; #end #ifndef (B) #declare A = A + 2; #end"),
      4);
  // 0.1 ten times is a little less than 1: the comparison is exact, and that for equality is not.
  EXPECT_EQ(valueOf("N",
                    "#declare I = 0; #declare N = 0; #while (I < 1) #declare N = N + 1; #declare I = I + "
                    ".1; #end"),
            11);
  EXPECT_EQ(valueOf("(I = 1) + 10 * (I >= 1)", "#declare I = 0; #for (K, 1, 10) #declare I = I + .1; #end"),
            11);
  EXPECT_EQ(valueOf("1 + frame_number + final_frame + clock_on"), 1);
  EXPECT_EQ(valueOf("T[frame_number - 1]", "#declare T = array[2] {5, 7};"), 5)
      << "the first of an animation";
  EXPECT_EQ(valueOf("A", "#declare A = 2; #undef A #ifdef (A) #else #declare A = 8; #end"), 8);
}

TEST(PovLanguage, UserFunctionsAndSplines) {
  EXPECT_EQ(valueOf("F(3, 4)", "#declare F = function(a, b) { a * a + b };"), 13);
  EXPECT_EQ(
      valueOf("G(2)", "#declare F = function(a, b) { a + b }; #declare G = function(t) { F(t, 1) * 2 };"), 6);
  EXPECT_EQ(vectorOf("S(0.5)", "#declare S = spline { linear_spline 0, <0, 0, 0>, 1, <2, 4, 6> };"),
            (Vec3{1, 2, 3}));
}

TEST(PovLanguage, StringsAreMade) {
  EXPECT_EQ(errorOf("#error concat(\"a\", str(1.5, 0, 2), vstr(2, <1, 2>, \",\", 0, 0), strupr(\"b\"))"),
            "2:1: the scene ends itself by #error: a1.501,2B");
}

TEST(PovLanguage, RandomNumbersFollowTheSeed) {
  EXPECT_EQ(valueOf("(rand(A) = rand(B)) + 1", "#declare A = seed(5); #declare B = seed(5);"), 2);
  EXPECT_NE(valueOf("rand(A) + 1", "#declare A = seed(5);"), valueOf("rand(A) + 1", "#declare A = seed(6);"));
}

TEST(PovLanguage, ObjectsAreAsked) {
  const std::string ball = "#declare B = sphere { <1, 2, 3>, 2 } ";
  expectNear(vectorOf("min_extent(B)", ball), {-1, 0, 1});
  expectNear(vectorOf("max_extent(B)", ball), {3, 4, 5});
  expectNear(vectorOf("trace(B, <1, 2, -9>, z)", ball), {1, 2, 1});
  expectNear(vectorOf("N", ball + "#declare N = x; #declare P = trace(B, <1, 2, -9>, z, N);"), {0, 0, -1});
  EXPECT_EQ(valueOf("inside(B, <1, 2, 2>) + 2 * inside(B, <9, 9, 9>) + 1", ball), 2);
}

TEST(PovLanguage, FilesAreIncluded) {
  const test::Folder folder;
  writeFile(folder / "part.inc", "#declare Size = 3;\n#local Hidden = 1;\n");
  Messages messages;
  const std::string file = folder / "a.pov";
  writeFile(file, "#include \"part.inc\"\n#ifndef (Hidden) sphere { 0, Size } #end");
  EXPECT_EQ(readScene(file, messages).objects.at(0).worldFromObject.row[0].x, 3);
}

TEST(PovLanguage, MistakesAreToldWithTheirPlace) {
  EXPECT_EQ(errorOf("sphere { <0, 0, 0>, }"), "2:21: expected a number, found \"}\"");
  EXPECT_EQ(errorOf("#declare Radius = 1;\nsphere { 0, Radios }"),
            "3:13: expected a number, found \"Radios\", which is not declared");
  EXPECT_EQ(errorOf("#if (1)\nsphere { 0, 1 }"), "2:1: #if without an #end");
  EXPECT_EQ(errorOf("#end"), "2:1: #end without an #if, #while, #for or #switch before it");
  EXPECT_EQ(errorOf("#wile (1)"), "2:1: #wile is no directive");
  EXPECT_EQ(errorOf("#declare A = 1 / 0;"), "2:16: a division by zero");
  EXPECT_EQ(errorOf("#declare T = array[2] {1, 2};\n#declare A = T[2];"),
            "3:14: index 2 of \"T\", which has 2 elements");
  EXPECT_EQ(errorOf("#macro M(A) #end\nM(1, 2)"), "3:1: M has 1 parameters, found 2 arguments");
  EXPECT_EQ(errorOf("sphere { 0, 1 textur { } }"),
            "2:15: expected a modifier such as texture or translate, or \"}\", found \"textur\"");
  EXPECT_EQ(errorOf("#fopen F \"a.txt\" read"), "2:1: #fopen F reads a file of data, which Trace does not");
}

TEST(PovLanguage, BombsEnd) {
  EXPECT_NE(errorOf("#macro A(N) A(N + 1) #end\nA(1)", Fault::limit).find("A is called again"),
            std::string::npos);
  Budget budget;
  budget.limitTime(0.2);
  const BudgetScope scope(&budget);
  EXPECT_NE(errorOf("#while (1) #end", Fault::limit), "nothing");
  EXPECT_NE(errorOf("#for (A, 1, 1e9) #for (B, 1, 1e9) #end #end", Fault::limit), "nothing");
}

TEST(PovLanguage, DeepNestsAreRefused) {
  std::string deep;
  for (int i = 0; i < 5000; ++i) deep += "(";
  EXPECT_NE(errorOf("#declare A = " + deep + "1;").find("deep"), std::string::npos);
  deep.clear();
  for (int i = 0; i < 5000; ++i) deep += "union { ";
  EXPECT_NE(errorOf(deep).find("deep"), std::string::npos);
}

TEST(PovLanguage, IsRecognised) {
  EXPECT_TRUE(recognisesPov("// a\n/* b */ #include \"colors.inc\""));
  EXPECT_TRUE(recognisesPov("global_settings { }"));
  EXPECT_FALSE(recognisesPov("SBT-raytracer 1.0"));
  EXPECT_FALSE(recognisesPov("#VRML V2.0 utf8"));
  EXPECT_FALSE(recognisesPov("#include <stdio.h>\n"));
}

}  // namespace
}  // namespace trace::pov_language_test
