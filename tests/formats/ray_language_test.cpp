// The language of scenes: docs/language.md.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <set>
#include <string>
#include <utility>

#include "base/budget.h"
#include "base/files/file.h"
#include "formats/ray/file/format.h"
#include "formats/ray/language/language.h"
#include "geometry/shapes/solids/csg_tree.h"
#include "ray_helpers.h"
#include "scene/groups.h"
#include "support/paths.h"

namespace trace::ray_language_test {
namespace {

/// Where the first object of the text has its origin.
Vec3 origin(std::string_view text) { return load(text).scene.objects.at(0).worldFromObject * Vec3{}; }
/// The value of an expression, with statements before it.
Real value(const std::string& expression, const std::string& before = "") {
  return origin(before + "\ntranslate(" + expression + ", 0, 0, sphere { })").x;
}
std::string sphereAt(std::string_view place) { return "translate(" + std::string(place) + ", sphere { })"; }

/// Do both texts say the same objects, materials, lights and settings?
void expectSame(std::string_view language, std::string_view plain) {
  const Scene a = load(language).scene, b = load(plain).scene;
  ASSERT_EQ(a.objects.size(), b.objects.size()) << language;
  for (std::size_t i = 0; i < a.objects.size(); ++i) {
    EXPECT_EQ(a.objects[i].shape, b.objects[i].shape) << language;
    EXPECT_EQ(a.objects[i].name, b.objects[i].name) << language;
    EXPECT_EQ(a.materials[a.objects[i].material].model, b.materials[b.objects[i].material].model) << language;
    for (const Vec3& p : {Vec3{}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}})
      for (int k = 0; k < 3; ++k)
        EXPECT_NEAR((a.objects[i].worldFromObject * p)[k], (b.objects[i].worldFromObject * p)[k], 1e-12)
            << language;
  }
  ASSERT_EQ(a.lights.size(), b.lights.size()) << language;
  for (std::size_t i = 0; i < a.lights.size(); ++i)
    EXPECT_EQ(a.lights[i].light, b.lights[i].light) << language;
  ASSERT_EQ(a.choices.size(), b.choices.size()) << language;
  for (std::size_t i = 0; i < a.choices.size(); ++i)
    EXPECT_EQ(a.choices[i].value, b.choices[i].value) << language;
}

TEST(RayLanguage, NamesHaveLettersOfEveryAlphabet) {
  EXPECT_EQ(origin("let gr\u00f6\u00dfe = 2\nlet \u7403(\u03c1) = 3 * "
                   "\u03c1\ntranslate(\u7403(gr\u00f6\u00dfe), 0, 0) { sphere { } }"),
            (Vec3{6, 0, 0}));
}

TEST(RayLanguage, ComputesByPrecedence) {
  const std::pair<const char*, Real> rows[]{{"1 + 2 * 3", 7},
                                            {"(1 + 2) * 3", 9},
                                            {"2 - 3 - 4", -5},
                                            {"1/3", 1 / 3.0},
                                            {"7 % 4", 3},
                                            {"-1 % 4", 3},
                                            {"2 ^ 3 ^ 2", 512},
                                            {"-(2) ^ 2", -4},
                                            {"2 * -(3)", -6},
                                            {"3-1", 2},
                                            {"1 < 2 ? 5 : 6", 5},
                                            {"1 > 2 ? 5 : 2 > 1 ? 7 : 8", 7},
                                            {"not (1 == 2) and 2 >= 2 ? 1 : 0", 1},
                                            {"1 != 1 or 3 <= 2 ? 1 : 0", 0},
                                            {"sin(30 deg)", 0.5},
                                            {"180 deg", kPi},
                                            {"90deg", kPi / 2},
                                            {"2 rad", 2},
                                            {"pi", kPi},
                                            {"tau", 2 * kPi},
                                            {"(4, 5, 6).y", 5},
                                            {"((1, 2, 3) + (4, 5, 6) * 2).z", 15},
                                            {"(7, 8, 9)[1]", 8},
                                            {"(0..5)[3]", 3},
                                            {"count(2..6)", 5},
                                            {"time", 0}};
  for (const auto& [expression, expected] : rows)
    EXPECT_NEAR(value(expression), expected, 1e-12) << expression;
}

TEST(RayLanguage, HasEachFunctionOfItsTable) {
  const std::pair<const char*, Real> rows[]{{"sin(0.5)", std::sin(0.5)},
                                            {"cos(0.5)", std::cos(0.5)},
                                            {"tan(0.5)", std::tan(0.5)},
                                            {"asin(0.5)", std::asin(0.5)},
                                            {"acos(0.5)", std::acos(0.5)},
                                            {"atan(0.5)", std::atan(0.5)},
                                            {"atan2(1, -1)", std::atan2(1, -1)},
                                            {"sqrt(2)", std::sqrt(2)},
                                            {"exp(1)", std::exp(1)},
                                            {"log(2)", std::log(2)},
                                            {"abs(-3)", 3},
                                            {"floor(-1.5)", -2},
                                            {"ceil(1.2)", 2},
                                            {"round(1.6)", 2},
                                            {"min(3, 1, 2)", 1},
                                            {"max((3, 1, 2))", 3},
                                            {"clamp(5, 0, 2)", 2},
                                            {"mix(1, 3, 0.25)", 1.5},
                                            {"dot((1, 2, 3), (4, 5, 6))", 32},
                                            {"cross((1, 0, 0), (0, 1, 0)).z", 1},
                                            {"length((3, 4, 12))", 13},
                                            {"normalize((0, 0, 5)).z", 1},
                                            {"count((1, 2))", 2},
                                            {"steps(0, 1, 5)[1]", 0.25},
                                            {"srgb(1, 0.5, 0).y", 0.2140411},
                                            {"hsv(1/3, 1, 1).g", 1},
                                            {"random(2, 2)", 2}};
  std::set<std::string> tested;
  for (const auto& [expression, expected] : rows) {
    EXPECT_NEAR(value(expression), expected, 1e-7) << expression;
    tested.insert(std::string(expression).substr(0, std::string(expression).find('(')));
  }
  for (const rayfile::FunctionHelp& function : rayfile::functionsOfLanguage())
    EXPECT_TRUE(tested.contains(std::string(function.name))) << function.name;
}

TEST(RayLanguage, TheGrammarForEditorsHasEveryFunction) {
  const std::string grammar =
      readFile(test::sourceFolder() + "/editors/vscode/syntaxes/trace-ray.tmLanguage.json");
  for (const rayfile::FunctionHelp& function : rayfile::functionsOfLanguage())
    EXPECT_NE(grammar.find("|" + std::string(function.name) + "|"), grammar.npos) << function.name;
}

TEST(RayLanguage, SaysWhatPlainTextSays) {
  expectSame("let r = 2\nlet gold = { diffuse = (1, 0.5, 0.25) / 2; }\nscale(r, sphere { material = gold })",
             "scale(2, sphere { material = { diffuse = (0.5, 0.25, 0.125); } })");
  expectSame("let gold = material { diffuse = #ffffff; name = gold }\nsphere { material = gold }",
             "sphere { material = { diffuse = (1, 1, 1); name = gold } }");
  expectSame("for i in 0..2 { translate(i, 0, 0) { sphere { } } }",
             "translate(0,0,0,sphere{}) translate(1,0,0,sphere{}) translate(2,0,0,sphere{})");
  expectSame("for p in ((1, 2, 3), (4, 5, 6)) { translate(p) { box { } } }",
             "translate(1,2,3,box{}) translate(4,5,6,box{})");
  expectSame(
      "for i in 0..3 { if (i % 2 == 0) { sphere { } } else if (i == 1) { box { } } else { cone { } } }",
      "sphere{} box{} sphere{} cone{}");
  expectSame(
      "define ball(size, at = (0, 0, 1)) { translate(at) { scale(size) { sphere { } } } }\n"
      "ball(2) ball(3, at = (1, 1, 1)) ball(at = (2, 0, 0), size = 1) { material = { diffuse = (1, 0, 0); } "
      "}",
      "translate(0,0,1,scale(2,sphere{})) translate(1,1,1,scale(3,sphere{}))"
      "translate(2,0,0,scale(1,sphere{material={diffuse=(1,0,0);}}))");
  expectSame("define tower(n) { box { } if (n > 1) { translate(0, 1, 0) { tower(n - 1) } } } tower(3)",
             "box{} translate(0,1,0,box{}) translate(0,1,0,translate(0,1,0,box{}))");
  expectSame("let pawn = group { sphere { } translate(0, 1, 0, box { }) }\npawn translate(2, 0, 0, pawn)",
             "sphere{} translate(0,1,0,box{}) translate(2,0,0,{sphere{} translate(0,1,0,box{})})");
  expectSame(
      "let pawn = group { sphere { } }\nfor c in ((1, 0, 0), (0, 1, 0)) { pawn { material = { diffuse = c; } "
      "} }",
      "sphere{material={diffuse=(1,0,0);}} sphere{material={diffuse=(0,1,0);}}");
  expectSame("rotate y 30 deg { box { } } rotate((0, 1, 0), 30 deg) { box { } }",
             "rotate(0,1,0,0.52359877559829887308,box{}) rotate(0,1,0,0.52359877559829887308,box{})");
  expectSame(
      "for x in (1, 3) { point_light { position = (x, 2 * x, 0); color = (1, 1, 1) * x; } } sphere { }",
      "point_light { position = (1, 2, 0); color = (1,1,1); } point_light { position = (3, 6, 0); color = "
      "(3,3,3); } sphere{}");
  expectSame("let w = 40\nsettings { width = 2 * w; spp = 9; } sphere { name = \"ball_\" + 3; }",
             "settings { width = 80; spp = 9; } sphere { name = \"ball_3\"; }");
  expectSame(
      "polymesh { points = ( for a in 0..2 { (cos(a * 90 deg), sin(a * 90 deg), 0) } ); faces = ((0, 1, 2)); "
      "}",
      "polymesh { points = ((1, 0, 0), (6.123233995736766e-17, 1, 0), (-1, 1.2246467991473532e-16, 0)); "
      "faces = ((0, 1, 2)); }");
  expectSame("let sum(list) = count(list) == 0 ? 0 : list[0] + 1\ntranslate(sum((4, 5)), 0, 0, sphere { })",
             "translate(5,0,0,sphere{})");
  expectSame("union { for i in 0..1 { translate(i, 0, 0) { sphere { } } } }",
             "union { translate(0,0,0,sphere{}) translate(1,0,0,sphere{}) }");
}

TEST(RayLanguage, NamesBelongToTheirBlock) {
  expectSame("let a = 1\n{ let a = 2\n translate(a, 0, 0, sphere { }) } translate(a, 0, 0, sphere { })",
             "translate(2,0,0,sphere{}) translate(1,0,0,sphere{})");
  expectSame("translate(b, 0, 0, sphere { })\nlet b = 2 * c\nlet c = 4",
             "translate(8,0,0,sphere{})");  // in any order
  expectSame(
      "material = { diffuse = (1, 1, 1); }\nfor i in 0..0 { material = { diffuse = (0, 0, 0); } box { } } "
      "box { }",
      "{ material = { diffuse = (0, 0, 0); } box { } } box { material = { diffuse = (1, 1, 1); } }");
}

TEST(RayLanguage, OldTextKeepsItsMeaning) {
  EXPECT_EQ(origin("translate(1 -2 3, sphere { })"), (Vec3{1, -2, 3}));
  EXPECT_EQ(origin("translate(1, -2, +3, sphere { })"), (Vec3{1, -2, 3}));
  EXPECT_EQ(load("translate(1, 2, 3, sphere { }) { box { } }").scene.objects.size(), 2u);
  EXPECT_EQ(load("scale(2, sphere { }) { box { } }").scene.objects.size(), 2u);
}

TEST(RayLanguage, RandomNumbersAreThoseOfTheirPlace) {
  const std::string loop = "for i in 0..9 { translate(random(), 0, 0, sphere { }) }";
  const Scene once = load(loop).scene, again = load("box { }\nlet a = 1\n" + loop + " box { }").scene;
  std::set<Real> places;
  for (std::size_t i = 0; i < 10; ++i) {
    const Real x = (once.objects[i].worldFromObject * Vec3{}).x;
    EXPECT_EQ(x, (again.objects[i + 1].worldFromObject * Vec3{}).x) << "an inserted object moves no other";
    EXPECT_TRUE(x >= 0 && x < 1);
    places.insert(x);
  }
  EXPECT_EQ(places.size(), 10u);
  const Scene two = load("let f() = random()\n" + sphereAt("f(), f(), random()")).scene;
  const Vec3 p = two.objects[0].worldFromObject * Vec3{};
  EXPECT_NE(p.x, p.y);
  EXPECT_NE(p.y, p.z);
}

// A list may follow a statement without a semicolon.
TEST(RayLanguage, ABracketThatBeginsALineBeginsAValue) {
  const auto points = [](const std::string& body) {
    Messages messages;
    const Scene scene =
        readScene("test.ray", "Trace 1\nprism { outline = (for i in 0..4 {\n" + body + "\n}) }", messages);
    EXPECT_TRUE(messages.all().empty()) << body;
    return scene.objects.at(0).shape;
  };
  const Shape wanted = points("let c = 72 * i; (cos(c), sin(c))");
  for (const std::string before :
       {"let c = 72 * i", "let c = i * 72", "let c = (72 * i)", "let n = 72 * i let c = n",
        "let c = 72 * i // a turn", "let c = 72 * i /* a\nturn */"})
    EXPECT_EQ(points(before + "\n(cos(c), sin(c))"), wanted) << before;
  for (const std::string call : {"translate\n(1, 0, 0) { sphere { } }", "let a = cos\n(3)\nsphere { }"}) {
    Messages messages;
    try {
      readScene("test.ray", "Trace 1\n" + call, messages);
      ADD_FAILURE() << call;
    } catch (const Error& error) {
      EXPECT_NE(toString(error.messages().front()).find("a line that begins with ( begins a new value"),
                std::string::npos)
          << call;
    }
  }
  EXPECT_EQ(origin("translate\n(1, 2, 3, sphere { })"), (Vec3{1, 2, 3})) << "in files of the courses";
}

TEST(RayLanguage, ATextIsAListOfItsLetters) {
  EXPECT_EQ(value("count(\"a\u00e9c\")"), 3);
  EXPECT_EQ(value("\"abc\"[1] == \"b\" ? 1 : 0"), 1);
  EXPECT_EQ(load("for c in \"R.R\" { if (c == \"R\") { sphere { } } }").scene.objects.size(), 2u);
}

TEST(RayLanguage, TimeIsThatOfTheScene) {
  const std::string text = "SBT-raytracer 1.0\ntranslate(2 * time, key((0, 1), (2, 5)), 0, sphere { })";
  Messages messages;
  const Scene scene = readScene("test.ray", text, messages, 1);
  EXPECT_EQ(scene.objects.at(0).worldFromObject * Vec3{}, (Vec3{2, 3, 0}));
  EXPECT_TRUE(changesWithTime("test.ray", text));
  EXPECT_TRUE(changesWithTime("test.ray", "SBT-raytracer 1.0\nlet t = time\n" + sphereAt("t, 0, 0")));
  EXPECT_FALSE(
      changesWithTime("test.ray", "SBT-raytracer 1.0\nsettings { time-limit = 3; } // time\nsphere { }"));
}

TEST(RayLanguage, IncludesFilesOnce) {
  const std::string folder = makeOwnFolder();
  writeFile(
      folder + "/pieces.ray",
      "SBT-raytracer 1.0\ninclude \"more.ray\"\ndefine pair() { ball translate(2, 0, 0) { ball } }\nbox { }");
  writeFile(folder + "/more.ray", "let ball = sphere { }\ninclude \"pieces.ray\"");
  Messages messages;
  const Scene scene =
      readRay(folder + "/main.ray",
              "SBT-raytracer 1.0\ninclude \"pieces.ray\"\ninclude \"pieces.ray\"\npair()", messages, 0);
  EXPECT_EQ(scene.objects.size(), 3u);
  EXPECT_EQ(scene.objects[0].place.file, folder + "/pieces.ray");
  EXPECT_EQ(scene.objects[0].place.line, 4);
  EXPECT_EQ(scene.inputs.all().size(), 2u);
  writeFile(folder + "/more.ray", "let ball = sphere {\n radios = 1 } }");
  try {
    readRay(folder + "/main.ray", "SBT-raytracer 1.0\ninclude \"pieces.ray\"\npair()", messages, 0);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(placeText(error.messages().front().place), folder + "/more.ray:2:15");
  }
  EXPECT_THROW(readRay(folder + "/main.ray", "SBT-raytracer 1.0\ninclude \"none.ray\"", messages, 0), Error);
  std::filesystem::remove_all(folder);
}

TEST(RayLanguage, WordsThatBeginObjectsNameValuesToo) {
  EXPECT_EQ(value("rows * scale", "let rows = 2\nlet scale = 3"), 6);
  EXPECT_EQ(value("f(4)", "let f(box, cone = 2) = box / cone"), 2);
  expectSame("let scale = 2\nlet sphere = (1, 0, 0)\nscale(scale) { translate(sphere) { sphere { } } }",
             "scale(2, translate(1, 0, 0, sphere { }))");
  expectSame(
      "define wall(rows, scale = 0.5) { for box in 1..rows { translate(box * scale, 0, 0) { box { } } } }\n"
      "wall(rows = 2)",
      "translate(0.5, 0, 0, box { }) translate(1, 0, 0, box { })");
}

TEST(RayLanguage, ErrorsNameThePlaceAndWhatLedThere) {
  const std::pair<const char*, const char*> rows[]{
      {"let a = 1\nlet a = 2",
       "3:5: expected a new name, found \"a\" again [it is defined at test.ray:2:1; nothing is assigned "
       "twice]"},
      {"define sphere() { }", "2:8: expected a new name, found \"sphere\", which has a meaning already"},
      {"let scale(x) = x", "2:5: expected a new name, found \"scale\", which has a meaning already"},
      {"let pi = 3", "2:5: expected a new name, found \"pi\", which has a meaning already"},
      {"let a = 1 +", "2:12: expected a value after the operator, found the end of the file"},
      {"let a 1", "2:7: expected \"=\", found \"1\""},
      {"for i on 1..2 { }", "2:7: expected \"in\" after the name of the loop, found \"on\""},
      {"for i in 3 { sphere { } }", "2:10: expected a range such as 0..9 or a list, found 3"},
      {"let n = 3\nfor i in 0..n-1 { }",
       "3:13: no value is called \"n-1\" [write \"n - 1\": names may have dashes in them]"},
      {"translate(1 / 0, 0, 0, sphere { })", "2:13: division by 0"},
      {"translate(width / 2, 0, 0, sphere { })",
       "2:11: no value is called \"width\" [let width = 1 makes one]"},
      {"define g(n) { }\ng()", "3:1: g: expected a value for n, found none [as in g(n)]"},
      {"let n = 4\nn = n + 1",
       "3:1: \"n\" has its value from test.ray:2:1 [a name gets its value once; let and another name hold "
       "another value]"},
      {"let b = 4\nlet c = 2 b",
       "3:11: expected an object, found b, which is 4 [an operator joins values, as in 2 * b; (1, b) is a "
       "list]"},
      {"define g(n) { }\ng(1, 2)", "3:6: g: expected 1 argument, found more"},
      {"define g(radius) { }\ng(radios = 1)",
       "3:3: g: expected a parameter of (radius), found radios = 1 [did you mean \"radius\"?]"},
      {"if (1) { }", "2:4: expected true or false as a condition, found 1"},
      {"let f(n) = f(n + 1)\ntranslate(f(0), 0, 0, sphere { })", nullptr},
      {"define d() { d() }\nd()", nullptr},
      {"let a = a + 1\ntranslate(a, 0, 0, sphere { })",
       "2:9: no value is called \"a\" [the value of a name cannot use the name]"},
      {"for i in 0..n { sphere { } }", "2:13: no value is called \"n\" [let n = 1 makes one]"},
      {"translate(2 * PI, 0, 0) { sphere { } }", "2:15: no value is called \"PI\" [did you mean \"pi\"?]"},
      {"rotate x 45 y 30 { sphere { } }",
       "2:13: expected the object to rotate, found \"y\" [one rotation stands in the other: rotate x 45 { "
       "rotate "
       "y 30 { ... } }]"},
      {"for i in 0..7 step 2 { sphere { } }",
       "2:15: expected \"{\", found \"step\" [a range counts by 1; steps(0, 6, 4) is 0, 2, 4, 6, as in for i "
       "in "
       "steps(0, 6, 4) { }]"},
      {"for i in 1..4 sphere { }",
       "2:15: expected \"{\", found \"sphere\" [what a loop repeats stands in braces: for i in 0..3 { sphere "
       "{ } "
       "}]"},
      {"define ball(r) sphere { }",
       "2:16: expected \"{\", found \"sphere\" [what a definition makes stands in braces: define ball(r) { "
       "scale(r) { sphere { } } }]"},
      {"if (1 < 2) sphere { }",
       "2:12: expected \"{\", found \"sphere\" [what a condition makes stands in braces: if (a < 1) { sphere "
       "{ } "
       "}]"},
      {"for i in 0..4 { if i == 3 { sphere { } } }",
       "2:20: expected \"(\" after if, found \"i\" [a condition stands in parentheses: if (i == 3) { }]"},
      {"if (1 < 2) { } else if not true { }",
       "2:24: expected \"(\" after if, found \"not\" [a condition stands in parentheses: if (not true) { }]"},
      {"camera { fov = 40 deg; } sphere { }",
       "2:16: fov: expected a number of degrees, found 40 deg [write it without deg, which makes radians]"},
      {"let r = 2\nscale(R) { sphere { } }", "3:7: no value is called \"R\" [did you mean \"r\"?]"},
      {"let a = (1, 2, 3)\nlet b = a.w",
       "3:9: expected a value, found \"a.w\" [components of a point or colour are .x .y .z and .r .g .b]"},
      {"color = #ffb", "2:9: expected six hexadecimal digits after #, as in #ffb347"},
      {"#include \"colors.inc\"",
       "2:1: expected six hexadecimal digits after #, as in #ffb347 [Trace has include \"file.ray\", let a = "
       "1 "
       "and define f(a) { }, without #]"},
  };
  for (const auto& [text, expected] : rows) {
    const std::string found = errorsOf(text);
    if (expected)
      EXPECT_EQ(found, expected) << text;
    else
      EXPECT_NE(found.find("a recursion needs a condition that ends it"), found.npos) << text << "\n"
                                                                                      << found;
  }
  EXPECT_EQ(errorsOf("define g(r) { for i in 1..2 { sphere { nonsense } } }\ng(7)"),
            "2:40: sphere: expected a field, as in name = value, found \"nonsense\" (2 times) [in i = 1 at "
            "test.ray:2:15, in g(r = "
            "7) at test.ray:3:1]");
}

TEST(RayLanguage, AllErrorsComeInTheOrderOfTheText) {
  EXPECT_EQ(
      errorsOfFile("Trace 1\n"
                   "define gear(n) { sphere { } translate(m, 0, 0) { sphere { } } }\n"
                   "sphere { radius = 2 }\n"
                   "geer(3)\n"
                   "gear 3\n"
                   "let wide = 1 / 0\n"
                   "scale(wide) { box { } }\n"
                   "translate(wide, 0, 0) { torus { hole = 1 } }\n"
                   "gear(3)\n"
                   "for i in 1..50 { scale(j) { box { } } }\n"
                   "sphere { material = { diffuse = (1, 2) } }"),
      "2:39: no value is called \"m\" [did you mean \"n\"?; in gear(n = 3) at test.ray:9:1]\n"
      "3:10: sphere has no field \"radius\" [scale(2) { sphere { } } makes it twice as large; scale(1, 2, 3) "
      "{ sphere { } }, along x, y and z]\n"
      "4:1: \"geer\" is not known\n"
      "5:1: gear: expected a value for n, found none [as in gear(n)]\n"
      "6:14: division by 0\n"
      "10:24: no value is called \"j\" (50 times) [did you mean \"i\"?; in i = 1 at test.ray:10:1]\n"
      "11:33: diffuse: expected (red, green, blue), found (1, 2)");
}

TEST(RayLanguage, AnEndlessRecursionIsOneErrorAndSoon) {
  EXPECT_EQ(
      errorsOfFile("Trace 1\ndefine a(n) { a(n + 1) a(n + 2) }\na(0)\nsphere { hole = 1 }").substr(0, 75),
      "2:15: expected at most 140 objects and calls within one another, found more");
  EXPECT_NE(errorsOfFile("Trace 1\nlet f(n) = f(n + 1)\nscale(f(0)) { box { } }").find("and 198 more there"),
            std::string::npos);
}

TEST(RayLanguage, AFloodOfObjectsEndsEarly) {
  try {
    load("for i in 0..9999 { for j in 0..9999 { translate(i, j, 0) { sphere { } } } }");
    ADD_FAILURE() << "it fits";
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::limit);
    const std::string hint = error.messages().front().hint;
    EXPECT_LT(std::stoi(hint.substr(hint.find("done ") + 5)), 1'000'000) << hint;
    EXPECT_NE(hint.find("rows { }"), hint.npos) << hint;
  }
}

TEST(RayLanguage, AnErrorInALoopIsOneWithItsNumber) {
  EXPECT_EQ(
      errorsOfFile("Trace 1\nfor i in 1..50 { sphere { radus = i } box { sise = i } }"),
      "2:27: sphere has no field \"radus\" (50 times) [it has material, name, lit_by, not_lit_by; in i = 1 "
      "at "
      "test.ray:2:1]\n"
      "2:45: box has no field \"sise\" (50 times) [it has material, name, lit_by, not_lit_by; in i = 1 at "
      "test.ray:2:1]");
}

TEST(RayLanguage, ALoopWithoutTurnsIsReported) {
  const std::string hint = " [a range ascends, as in 1..5]";
  EXPECT_EQ(warningsOf("sphere { }\nfor i in 5..1 { box { } }"),
            "3:10: this loop makes no turn: 5..1 is empty" + hint);
  EXPECT_EQ(warningsOf("sphere { }\nlet n = 0\nfor i in 0..n - 1 { box { } }"),
            "4:10: this loop makes no turn: 0..n - 1 is empty" + hint);
  EXPECT_EQ(warningsOf("sphere { }\nfor i in 0..2 { for j in 1..i { box { } } }"), "") << "it does in some";
  EXPECT_EQ(warningsOf("sphere { }\nif (1 > 2) { for i in 5..1 { box { } } }"), "") << "never reached";
  EXPECT_EQ(warningsOf("sphere { }\nfor i in 1..time { box { } }"), "") << "it may at another time";
}

// --- instances ---

const std::string kTree =
    "let tree = group { for i in 0..9 { translate(0, i, 0) { sphere { } } } translate(1, 0, 0) { box { } } "
    "}\n";
const std::string kForest =
    "for i in 0..599 { translate(i, random(), 0) { rotate y 0.1 { scale(2) { tree } } } }\n";

TEST(Instances, ANameOfObjectsThatIsUsedOftenIsOneGroup) {
  const Scene scene = load(kTree + "box { }\n" + kForest).scene;
  EXPECT_EQ(scene.objects.size(), 1u);
  ASSERT_EQ(scene.groups.size(), 1u);
  EXPECT_EQ(scene.groups[0].objects.size(), 11u);
  EXPECT_EQ(scene.groups[0].name, "tree");
  ASSERT_EQ(countUses(scene.uses), 600u);
  EXPECT_EQ(placementName(scene, objectOf(scene, 1 + 600 + 11 * 9)), "tree #10 (test.ray:4)");
  EXPECT_EQ(countPlacedObjects(scene), 6600u);
}

TEST(Instances, FewUsesAreCopies) {
  const Scene scene = load(kTree + "for i in 0..2 { translate(i, 0, 0) { tree } }").scene;
  EXPECT_EQ(scene.objects.size(), 33u);
  EXPECT_TRUE(scene.groups.empty());
}

TEST(Instances, TheyStandWhereCopiesWould) {
  const std::string transforms =
      "for i in 0..599 { rotate(1, 2, 3, i) { translate((i, 2, 1)) { transform((1, 0, 0.5, 1), (0, 1, 0, 2), "
      "(0, 0, -1, 3), (0, 0, 0, 1), tree) } } }";
  const Scene scene = copied(load(kTree + transforms).scene, "test");
  const Scene plain = load(
                          "define tree() { for i in 0..9 { translate(0, i, 0) { sphere { } } } translate(1, "
                          "0, 0) { box { } } }\n" +
                          transforms)
                          .scene;
  ASSERT_EQ(scene.objects.size(), plain.objects.size());
  for (std::size_t i = 0; i < plain.objects.size(); ++i)
    for (const Vec3& p : {Vec3{}, Vec3{1, 2, 3}})
      for (int k = 0; k < 3; ++k)
        EXPECT_NEAR((scene.objects[i].worldFromObject * p)[k], (plain.objects[i].worldFromObject * p)[k],
                    1e-9);
}

TEST(Instances, AMaterialAtTheUseMakesAGroupOfItsOwn) {
  const Scene scene = load("let red = { diffuse = (1, 0, 0); }\n" + kTree + kForest +
                           "for i in 0..99 { translate(0, 0, i) { tree { material = red } } }")
                          .scene;
  ASSERT_EQ(scene.groups.size(), 2u);
  EXPECT_EQ(countUses(scene.uses), 700u);
  EXPECT_NE(scene.groups[0].objects[0].material, scene.groups[1].objects[0].material);
}

TEST(Instances, GroupsOfGroupsAreKept) {
  const Scene scene = load(kTree + "let grove = group { " + kForest + "}\n" +
                           "for i in 0..99 { translate(0, 0, i) { grove } }")
                          .scene;
  EXPECT_EQ(scene.objects.size(), 0u);
  EXPECT_EQ(countPlacedObjects(scene), 660'000u);
}

TEST(Instances, LightsAndMediaAndPlanesAreCopied) {
  const Scene scene =
      load(
          "let lamp = group { for i in 0..9 { box { } } sphere { material = { emissive = (1, 1, 1); } } "
          "plane { } }\nfor i in 0..999 { translate(i, 0, 0) { lamp } }")
          .scene;
  EXPECT_EQ(scene.objects.size(), 2000u);
  ASSERT_EQ(scene.groups.size(), 1u);
  EXPECT_EQ(scene.groups[0].objects.size(), 10u);
}

TEST(Instances, PartsOfSolidsAreCopied) {
  const Scene scene = load(kTree + "union { " + kForest + "}").scene;
  ASSERT_EQ(scene.objects.size(), 1u);
  EXPECT_EQ(scene.objects[0].shape.operands().list().size(), 600u);
  EXPECT_TRUE(scene.groups.empty());
}

TEST(Instances, TheWriterKeepsThem) {
  const Scene scene = load(kTree + "sphere { }\n" + kForest).scene;
  Messages messages;
  const std::string text = writableFormatFor("out.ray").write(scene, "out.ray", {}, messages).at(0).bytes;
  Messages again;
  const Scene back = readScene("out.ray", text, again);
  ASSERT_EQ(back.groups.size(), 1u);
  EXPECT_EQ(countUses(back.uses), 600u);
  const Scene a = copied(scene, "test"), b = copied(back, "test");
  ASSERT_EQ(a.objects.size(), b.objects.size());
}

TEST(RayLanguage, BombsEnd) {
  std::string bomb;
  for (const char* name : {"a", "b", "c", "d", "e"}) bomb += "for " + std::string(name) + " in 0..999 { ";
  Budget budget;
  budget.limitTime(0.1);
  const BudgetScope scope(&budget);
  try {
    load(bomb + "sphere { } } } } } }");
    ADD_FAILURE() << "it found an end";
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::limit);
  }
  budget.limitTime(0);
  std::string deep(100, '(');
  EXPECT_NE(errorsOf("let f(x) = " + deep + "1 + f(x)" + std::string(100, ')') +
                     "\ntranslate(f(0), 0, 0, sphere { })"),
            "");
  std::string nested;
  for (int i = 0; i < 100; ++i)
    nested += "define d" + std::to_string(i) + "() { {{ d" + std::to_string(i + 1) + "() }} }\n";
  EXPECT_NE(errorsOf(nested + "define d100() { sphere { } }\nd0()"), "");
}

}  // namespace
}  // namespace trace::ray_language_test
