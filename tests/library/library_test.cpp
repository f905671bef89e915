#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <string>

#include "support/folder.h"
#include "traceray/traceray.h"

namespace traceray {
namespace {

constexpr const char* kBall = R"(SBT-raytracer 1.0
// a comment
camera { position = (0, 0, 4); viewdir = (0, 0, -1); updir = (0, 1, 0); fov = 40; }
directional_light { direction = (0, 0, -1); color = (1, 1, 1); name = key; }
sphere { name = ball; material = { diffuse = (0.8, 0.4, 0.2); }; }
)";
const Options kSmall{{"width", 24}, {"height", 24}, {"spp", 1}, {"integrator", "whitted"}};

/// What the call throws; fails the test if it throws nothing.
template <class Call>
Error errorOf(Call&& call) {
  try {
    call();
  } catch (const Error& error) {
    return error;
  }
  ADD_FAILURE() << "nothing was thrown";
  return Error(Error::Kind::usage, "");
}

bool holds(std::string_view text, std::string_view part) { return text.find(part) != text.npos; }

TEST(Library, RendersTextAsLinearLight) {
  const Render render = Scene::fromText(kBall).render(kSmall);
  EXPECT_TRUE(render.finished());
  EXPECT_EQ(render.end(), "finished");
  EXPECT_EQ(render.width(), 24);
  ASSERT_EQ(render.image().values.size(), 3u * 24 * 24);
  const auto middle = render.image().pixel(12, 12);
  EXPECT_NEAR(middle[0], 0.8, 0.02);
  EXPECT_NEAR(middle[0] / middle[1], 2, 1e-6);
  EXPECT_EQ(render.image().pixel(0, 0)[0], 0);
  EXPECT_EQ(render.image().row(12)[3 * 12], middle[0]);
  EXPECT_GE(render.rays(), 24u * 24);
}

TEST(Library, EditsFieldsOfEveryCategory) {
  Scene scene = Scene::fromText(kBall);
  Part ball = scene.object("ball");
  EXPECT_EQ(ball.keyword(), "sphere");
  EXPECT_EQ(ball.material().get("diffuse").numbers(), (std::vector<double>{0.8, 0.4, 0.2}));
  ball.material().set("diffuse", {0.1, 0.2, 0.3});
  scene.light("key").set("color", {2, 2, 2});
  scene.camera().set({{"position", {0, 0, 8}}, {"look_at", {0, 0, 0}}});
  scene.background().set("color", {0.25, 0.5, 1});
  const Render render = scene.render(kSmall);
  EXPECT_NEAR(render.image().pixel(12, 12)[2], 0.6, 0.02);
  EXPECT_EQ(render.image().pixel(0, 0)[1], 0.5);
  EXPECT_EQ(scene.camera().get("position").numbers()[2], 8);
  ball.move({{"translate", {5, 0, 0}}, {"scale", 2}});
  EXPECT_EQ(ball.transform()[0], 2);
  EXPECT_EQ(ball.transform()[3], 5);
  ball.remove();
  EXPECT_TRUE(scene.objects().empty());
  EXPECT_TRUE(holds(errorOf([&] { ball.name(); }).what(), "taken out"));
}

TEST(Library, ANewMaterialIsOfThatObjectAlone) {
  Scene scene;
  const Node red("phong", {{"diffuse", {1, 0, 0}}});
  scene.add(Node("sphere", {{"name", "a"}, {"material", red}}));
  scene.add(Node("sphere", {{"name", "b"}, {"material", red}, {"translate", {3, 0, 0}}}));
  scene.object("a").material().set("diffuse", {0, 1, 0});
  EXPECT_EQ(scene.object("b").material().get("diffuse").numbers()[0], 1);
  scene.object("b").set("material", "gold");
  EXPECT_EQ(scene.object("b").material().keyword(), "conductor");
  EXPECT_EQ(scene.object("a").material().keyword(), "phong");
}

TEST(Library, CopiesAreIndependent) {
  Scene scene = Scene::fromText(kBall);
  Scene copy = scene;
  copy.object("ball").set("name", "other");
  EXPECT_NO_THROW(scene.object("ball"));
  EXPECT_EQ(copy.objects().size(), 1u);
}

TEST(Library, ErrorsNameThePlaceAndWhatWasMeant) {
  const Error syntax =
      errorOf([] { Scene::fromText("SBT-raytracer 1.0\nsphere { radus = }\n", "room.ray"); });
  EXPECT_EQ(syntax.kind(), Error::Kind::scene);
  EXPECT_EQ(syntax.problems().front().file, "room.ray");
  EXPECT_EQ(syntax.problems().front().line, 2);
  Scene scene;
  scene.add(Node("sphere"));
  const Error field = errorOf([&] { scene.add(Node("torus", {{"majr", 2}})); });
  EXPECT_EQ(field.kind(), Error::Kind::scene);
  EXPECT_EQ(field.problems().front().line, 2) << "the second thing that was added";
  EXPECT_TRUE(holds(field.what(), "majr")) << field.what();
  EXPECT_EQ(scene.objects().size(), 1u) << "the scene stays as it was";
  const Error option = errorOf([&] { scene.render({{"widht", 20}}); });
  EXPECT_EQ(option.kind(), Error::Kind::usage);
  EXPECT_TRUE(holds(option.what(), "did you mean \"width\"")) << option.what();
  EXPECT_TRUE(holds(errorOf([&] { scene.object("bal"); }).what(), "no object called \"bal\""));
  EXPECT_EQ(errorOf([] { Scene::open("no such scene.ray"); }).kind(), Error::Kind::file);
  EXPECT_EQ(errorOf([&] { scene.objects()[0].set("radius", "x"); }).kind(), Error::Kind::scene);
}

TEST(Library, ProgressIsHeardAndStopsTheRender) {
  const Scene scene = Scene::fromText(kBall);
  int calls = 0;
  const Render whole = scene.render(kSmall, [&](const Progress& progress) {
    EXPECT_GE(progress.fraction, 0);
    EXPECT_LE(progress.fraction, 1);
    return ++calls > 0;
  });
  EXPECT_GE(calls, 1);
  EXPECT_TRUE(whole.finished());
  EXPECT_EQ(whole.image().values, scene.render(kSmall).image().values) << "watched or not";
  const Render part = scene.render({{"width", 64}, {"spp", 65536}},
                                   [](const Progress& progress) { return progress.fraction == 0; });
  EXPECT_EQ(part.end(), "cancelled");
  EXPECT_FALSE(part.finished());
  EXPECT_GT(part.image().pixel(32, 32)[0], 0) << "what was traced is kept";
  struct Own {};
  EXPECT_THROW(
      scene.render({{"width", 64}, {"spp", 65536}},
                   [](const Progress& progress) { return progress.fraction == 0 || (throw Own{}, true); }),
      Own);
}

TEST(Library, APixelOfAStoppedRenderIsExplainedByTheSamplesThatItHas) {
  const Scene scene = Scene::fromText(kBall);
  const Render render = scene.render({{"width", 24}, {"height", 24}, {"spp", 65536}, {"integrator", "path"}},
                                     [](const Progress& progress) { return progress.fraction == 0; });
  ASSERT_EQ(render.end(), "cancelled");
  int explained = 0;
  for (int x = 0; x < 24; x += 3) {
    try {
      const Explanation why = render.explain(x, 12);
      EXPECT_TRUE(why.agrees()) << why.text();
      EXPECT_EQ(static_cast<float>(why.pixel()[0]), render.image().pixel(x, 12)[0]) << x;
      ++explained;
    } catch (const Error& error) {
      EXPECT_TRUE(holds(error.what(), "stopped before this pixel")) << error.what();
    }
  }
  EXPECT_GT(explained, 0);
}

TEST(Library, PassesExplainLintAndDiff) {
  const Scene scene = Scene::fromText(kBall);
  Options options = kSmall;
  options.push_back({"passes", Value::List{"depth", "normal"}});
  const Render render = scene.render(options);
  EXPECT_EQ(render.passes(), (std::vector<std::string>{"depth", "normal"}));
  EXPECT_NEAR(render.pass("depth").pixel(12, 12)[0], 3, 0.05);
  EXPECT_NEAR(render.pass("normal").pixel(12, 12)[2], 1, 0.05);
  EXPECT_EQ(errorOf([&] { render.pass("albedo"); }).kind(), Error::Kind::usage);

  const Explanation why = render.explain(12, 12);
  EXPECT_TRUE(why.agrees());
  EXPECT_EQ(static_cast<float>(why.pixel()[0]), render.image().pixel(12, 12)[0]);
  EXPECT_TRUE(holds(why.text(), "hits \"ball\", sphere (scene.ray:5)")) << why.text();
  EXPECT_TRUE(holds(why.json(), "\"schema\":\"trace-explain\""));
  EXPECT_EQ(scene.explain(12, 12, kSmall).pixel(), why.pixel());
  EXPECT_EQ(errorOf([&] { render.explain(24, 0); }).kind(), Error::Kind::usage);

  const Difference same = diff(render.image(), render.image());
  EXPECT_TRUE(same.identical);
  EXPECT_EQ(same.unit, "values");
  Image brighter = render.image();
  brighter.values[0] += 0.5f;
  EXPECT_EQ(diff(render.image(), brighter).metric("max"), 0.5);
  EXPECT_THROW(same.metric("nothing"), Error);

  Scene dark = scene;
  dark.lights()[0].remove();
  bool found = false;
  for (const Problem& problem : dark.lint(kSmall)) found = found || !problem.check.empty();
  EXPECT_TRUE(found) << "a scene without light";
}

TEST(Library, WritesPicturesAndScenes) {
  const trace::test::Folder folder;
  Scene scene = Scene::fromText(kBall, folder / "ball.ray");
  Render render = scene.render(kSmall);
  EXPECT_EQ(render.write(folder / "ball.png"), folder / "ball.png");
  const Image read = Image::read(folder / "ball.png");
  EXPECT_TRUE(read.levels);
  EXPECT_NEAR(read.pixel(12, 12)[0], render.shown().pixel(12, 12)[0], 1.0 / 255);
  EXPECT_EQ(render.png().substr(1, 3), "PNG");
  EXPECT_EQ(diff(folder / "ball.png", folder / "ball.png").unit, "levels");

  scene.object("ball").material().set("diffuse", {0.5, 0.5, 0.5});
  EXPECT_TRUE(scene.save(folder / "grey.ray").empty());
  Scene again = Scene::open(folder / "grey.ray");
  EXPECT_EQ(again.object("ball").material().get("diffuse"), scene.object("ball").material().get("diffuse"));
  EXPECT_EQ(again.render(kSmall).image().values, scene.render(kSmall).image().values);
}

TEST(Library, ABuiltSceneIsCompletedAndSaved) {
  const trace::test::Folder folder;
  Scene scene;
  scene.add(Node("plane", {{"translate", {0, -1, 0}}}));
  scene.add(Node(
      "difference",
      {{"objects", {Node("box"), Node("sphere", {{"scale", 0.6}})}}, {"name", "die"}, {"material", "gold"}}));
  const Render render = scene.render({{"width", 32}, {"quality", "none"}, {"integrator", "whitted"}});
  EXPECT_EQ(render.height(), 24);
  EXPECT_GT(render.image().pixel(16, 2)[2], render.image().pixel(16, 2)[0]) << "a sky";
  EXPECT_TRUE(scene.save(folder / "die.ray").empty());
  EXPECT_EQ(Scene::open(folder / "die.ray").objects().size(), 2u);
}

TEST(Library, EveryKindIsBuiltByNameAndReadsBackAsItself) {
  std::set<std::string> categories;
  for (const Kind& kind : kinds()) {
    categories.insert(kind.category);
    EXPECT_FALSE(kind.help.empty()) << kind.keyword;
    for (const FieldInfo& field : kind.fields)
      EXPECT_FALSE(field.help.empty()) << kind.keyword << " " << field.name;
    if (kind.category == "material") {
      Scene scene;
      const Part ball = scene.add(Node("sphere", {{"material", Node(kind.keyword)}}));
      Scene other;
      const Node said = ball.material().node();
      EXPECT_EQ(other.add(Node("sphere", {{"material", said}})).material().node().inLanguage(),
                said.inLanguage());
    }
    if (kind.category == "texture") {
      Scene scene;
      const Part ball =
          scene.add(Node("sphere", {{"material", Node("lambert", {{"diffuse", Node(kind.keyword)}})}}));
      EXPECT_TRUE(ball.material().get("diffuse").isNode()) << kind.keyword;
    }
    if (kind.category == "light") {
      Node node(kind.keyword);
      for (const FieldInfo& field : kind.fields) {
        if (field.name == "position") node.fields.push_back({"position", {1, 2, 3}});
        if (field.name == "direction") node.fields.push_back({"direction", {0, -1, 0}});
        if (field.name == "color") node.fields.push_back({"color", {1, 1, 1}});
      }
      Scene scene;
      Part light = scene.add(node);
      Scene other;
      EXPECT_EQ(other.add(light.node()).node().inLanguage(), light.node().inLanguage());
      light.set("name", "key");
      EXPECT_EQ(scene.light("key").keyword(), kind.keyword);
    }
  }
  EXPECT_EQ(categories,
            (std::set<std::string>{"shape", "light", "material", "texture", "camera", "background"}));
  EXPECT_GT(options().size(), 50u);
}

TEST(Library, EveryShapeReadsBackAsItself) {
  int built = 0;
  for (const Kind& kind : kinds()) {
    if (kind.category != "shape" || kind.keyword == "polymesh") continue;
    Node node(kind.keyword, {{"name", "it"}});
    for (const FieldInfo& field : kind.fields)
      if (field.type == "objects") node.fields.push_back({field.name, {Node("sphere"), Node("box")}});
    Scene scene;
    try {
      scene.add(node);
    } catch (const Error&) {
      continue;  // nothing of it is seen without more, as of a lathe without points
    }
    const Part part = scene.object("it");
    Scene other;
    other.add(part.node());
    EXPECT_EQ(other.object("it").node().inLanguage(), part.node().inLanguage());
    ++built;
  }
  EXPECT_GT(built, 15);
}

TEST(Library, MeshesComeAsLists) {
  Scene scene;
  scene.add(Node("polymesh", {{"points", {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}}}, {"faces", {{0, 1, 2}}}}));
  scene.add(Node("camera", {{"position", {0, 0, 3}}, {"look_at", {0, 0, 0}}}));
  const Render render =
      scene.render({{"width", 16}, {"quality", "none"}, {"integrator", "whitted"}, {"passes", "depth"}});
  EXPECT_NEAR(render.pass("depth").pixel(8, 6)[0], 3, 1e-5);
}

TEST(Library, ValuesSayWhatTheyAreInTheLanguageOfScenes) {
  EXPECT_EQ(Value({1, 2.5, -3}).inLanguage(), "(1, 2.5, -3)");
  EXPECT_EQ(Node("sphere", {{"name", "a"}, {"translate", {1, 2, 3}}, {"scale", 2}}).inLanguage(),
            "translate(1, 2, 3, scale(2, sphere { name = \"a\"; }))");
  EXPECT_EQ(Node("texture", {{"", Node("noise")}, {"", 0.1}}).inLanguage(), "texture(noise { }, 0.1)");
  EXPECT_EQ(Value(true).inLanguage(), "true");
  EXPECT_THROW(Value("a \"quoted\" word").inLanguage(), Error);
  EXPECT_THROW(Value(std::nan("")).inLanguage(), Error);
  EXPECT_THROW(Value(1).text(), Error);
}

TEST(Library, OptionsOfTheSceneHoldForItsRenders) {
  Scene scene = Scene::fromText(kBall);
  scene.choose("width", 10);
  EXPECT_EQ(scene.render({{"spp", 1}}).width(), 10);
  EXPECT_EQ(scene.chosen("width", {{"width", 12}}), "12");
  EXPECT_THROW(scene.choose("width", -1), Error);
  EXPECT_EQ(scene.chosen("width"), "10");
}

TEST(Library, AWarningGoesWhenItsFieldIsMended) {
  const auto texts = [](const Scene& scene) {
    std::string text;
    for (const Problem& problem : scene.warnings()) text += problem.what + "\n";
    return text;
  };
  Scene scene;
  scene.add(Node("plane"));
  Part ball = scene.add(Node(
      "sphere", {{"material", Node("phong", {{"diffuse", {0.5, 7, 0}}, {"index", -2}, {"shininess", 9}})}}));
  Part key = scene.add(Node(
      "spot_light", {{"position", {0, 5, 0}}, {"direction", {0, -1, 0}}, {"angle", 20}, {"full_angle", 50}}));
  EXPECT_TRUE(holds(texts(scene), "diffuse of material")) << texts(scene);
  EXPECT_TRUE(holds(texts(scene), "index of material"));
  EXPECT_TRUE(holds(texts(scene), "full_angle"));
  const Scene before = scene;
  ball.material().set("diffuse", {0.5, 0.7, 0});
  EXPECT_FALSE(holds(texts(scene), "diffuse")) << texts(scene);
  EXPECT_TRUE(holds(texts(scene), "index of material")) << "which stays wrong";
  EXPECT_TRUE(holds(texts(before), "diffuse")) << "a copy keeps its own";
  ball.material().set("index", -3);
  EXPECT_TRUE(holds(texts(scene), "found -3"));
  EXPECT_FALSE(holds(texts(scene), "found -2")) << texts(scene);
  ball.material().set({{"index", 1.5}, {"shininess", -1}});
  EXPECT_FALSE(holds(texts(scene), "index"));
  EXPECT_TRUE(holds(texts(scene), "shininess"));
  ball.set("material", "gold");
  EXPECT_FALSE(holds(texts(scene), "shininess")) << texts(scene);
  key.set("full_angle", 10);
  EXPECT_EQ(texts(scene), "");
  scene.add(Node("sphere", {{"material", Node("phong", {{"index", -2}})}})).remove();
  EXPECT_EQ(texts(scene), "");

  Scene read = Scene::fromText("Trace 1\nsphere { name = a; material = { index = -1 } }\nbox { }\n");
  EXPECT_TRUE(holds(texts(read), "index of material"));
  read.object("a").material().set("diffuse", {0.5, 0.5, 0.5});
  EXPECT_TRUE(holds(texts(read), "index of material")) << "of another field";
  read.object("a").material().set("index", 1.5);
  EXPECT_EQ(texts(read), "");
  read.object("a").material().set("index", -4);
  EXPECT_TRUE(holds(texts(read), "found -4")) << texts(read);
}

TEST(Library, AMissingTextureIsReportedUntilItIsThere) {
  const trace::test::Folder folder;
  Scene scene;
  scene.add(Node("plane",
                 {{"translate", {0, -1, 0}},
                  {"material", Node("lambert", {{"diffuse", Node("map", {{"", folder / "dots.png"}})}})}}));
  const auto warned = [](const std::vector<Problem>& problems) {
    return std::any_of(problems.begin(), problems.end(),
                       [](const Problem& problem) { return holds(problem.what, "dots.png"); });
  };
  const Options quick{{"width", 16}, {"quality", "none"}, {"integrator", "whitted"}};
  EXPECT_TRUE(warned(scene.warnings()));
  const Render missing = scene.render(quick);
  EXPECT_TRUE(warned(missing.warnings()));
  Image{.width = 1, .height = 1, .values = {1, 1, 1}}.write(folder / "dots.png");
  EXPECT_FALSE(warned(scene.warnings()));
  const Render found = scene.render(quick);
  EXPECT_FALSE(warned(found.warnings()));
  EXPECT_NE(found.image().values, missing.image().values) << "it shows the picture that is there now";
}

TEST(Library, OptionsOfTheProgramCountMoreThanItsQuality) {
  Scene scene;
  scene.add(Node("sphere"));
  EXPECT_EQ(scene.chosen("spp", {{"quality", "draft"}}), "16");
  scene.choose("spp", 4);
  EXPECT_EQ(scene.chosen("spp", {{"quality", "draft"}}), "4");
  EXPECT_EQ(scene.chosen("integrator", {{"quality", "draft"}}), "path");
  scene.choose("integrator", "whitted");
  EXPECT_EQ(scene.chosen("integrator", {{"quality", "draft"}}), "whitted");
  EXPECT_EQ(scene.chosen("spp", {{"quality", "draft"}, {"spp", 2}}), "2");
  scene.add(Node("settings", {{"depth", 3}}));
  EXPECT_EQ(scene.chosen("depth", {{"quality", "draft"}}), "3");
  const Scene read = Scene::fromText("Trace 1\nsettings { spp = 9 }\nsphere { }\n");
  EXPECT_EQ(read.chosen("spp", {{"quality", "draft"}}), "16") << "as on the command line";
  scene.choose("width", 100);
  scene.choose("height", 50);
  EXPECT_EQ(scene.chosen("height", {{"width", 200}, {"quality", "draft"}}), "100");
}

TEST(Library, ACameraWithoutAspectRatioHasThatOfThePicture) {
  Scene scene;
  scene.add(Node("sphere", {{"material", Node("phong", {{"emissive", {1, 1, 1}}})}}));
  scene.add(Node("background", {{"color", {0, 0, 0}}}));
  const auto lit = [](const Image& image, int x, int y, int dx, int dy) {
    int count = 0;
    for (; x < image.width && y < image.height; x += dx, y += dy) count += image.pixel(x, y)[0] > 0;
    return count;
  };
  for (const bool hasCamera : {false, true}) {
    if (hasCamera) scene.add(Node("camera", {{"position", {0, 0, 5}}, {"look_at", {0, 0, 0}}, {"fov", 40}}));
    Options options{{"quality", "none"}, {"integrator", "whitted"}, {"width", 64}};
    EXPECT_EQ(scene.render(options).height(), 48);
    for (const int height : {32, 64, 96}) {
      Options both = options;
      both.push_back({"height", height});
      const Render render = scene.render(both);
      const Image& image = render.image();
      const int across = lit(image, 0, height / 2, 1, 0), down = lit(image, 32, 0, 0, 1);
      EXPECT_GT(across, 10);
      EXPECT_NEAR(across, down, 2) << "a ball is round, " << height;
    }
  }
  Scene wide;
  wide.add(Node("sphere"));
  wide.add(Node("camera", {{"position", {0, 0, 5}}, {"look_at", {0, 0, 0}}, {"horizontal_fov", 60}}));
  EXPECT_NEAR(wide.camera().get("fov").number(), 46.83, 0.01) << "that of 4 to 3";
}

TEST(Library, GradesAFolder) {
  const trace::test::Folder folder;
  const std::string references = folder / "references", given = folder / "given";
  for (const std::string& one : {references, given}) std::filesystem::create_directories(one);
  const Image grey{.width = 2, .height = 1, .values = {0.5, 0.5, 0.5, 0.5, 0.5, 0.5}},
      light{.width = 2, .height = 1, .values = {0.6f, 0.6f, 0.6f, 0.6f, 0.6f, 0.6f}};
  for (const char* name : {"a.png", "b.png", "c.png"}) grey.write(references + "/" + name);
  grey.write(given + "/a.png");
  light.write(given + "/b.png");
  const Grades strict = grade(given, references);
  ASSERT_EQ(strict.pictures.size(), 3u);
  EXPECT_EQ(strict.passed, 1u);
  EXPECT_EQ(strict.pictures.front().verdict, "missing") << "the worst is first";
  EXPECT_EQ(strict.pictures.back().name, "a.png");
  EXPECT_EQ(strict.pictures.back().verdict, "identical");
  const Grades loose = grade(given, references, {.limits = {"rmse=50"}, .page = folder / "grades.html"});
  EXPECT_EQ(loose.passed, 2u);
  EXPECT_EQ(loose.pictures[1].metrics.front().first, "max");
  EXPECT_EQ(Image::read(references + "/a.png").width, 2);
  EXPECT_TRUE(std::filesystem::exists(folder / "grades.html"));
  EXPECT_EQ(errorOf([&] { grade(given, folder / "nothing"); }).kind(), Error::Kind::file);
  EXPECT_EQ(errorOf([&] { grade(given, references, {.limits = {"rmsee=5"}}); }).kind(), Error::Kind::usage);
  struct Own {};
  EXPECT_THROW(grade(given, references, {}, [](const Progress&) -> bool { throw Own{}; }), Own);
}

}  // namespace
}  // namespace traceray
