// Motion blur: the moments while the shutter is open.
#include <gtest/gtest.h>

#include "app/editing/document.h"
#include "app/session/session.h"
#include "support/scene_files.h"

namespace trace::test {
namespace {

/// A white square of 0.5 units that moves from x = -1 to x = 1 in a second, before black, 4 units wide.
constexpr const char* kMoving = R"(SBT-raytracer 1.0
settings { projection = orthographic; view-height = 1; height = 40; width = 160; transfer = linear; }
camera { position = (0, 0, 5); viewdir = (0, 0, -1); updir = (0, 1, 0); aspectratio = 4; }
translate(key((0, -1), (1, 1)), 0, 0, scale(0.5, 0.5, 1, square { material = { emissive = (1, 1, 1); }; }))
)";

Picture moved(const std::string& file, std::vector<Choice> choices) {
  Session session;
  session.open(file, choices);
  session.build();
  session.renderPicture();
  return session.picture();
}

std::string written(const Folder& folder, const char* text) {
  const std::string file = folder / "scene.ray";
  writeFile(file, text);
  return file;
}

Real sum(const Picture& picture) {
  Real total = 0;
  for (const Color& c : picture.pixels) total += c.g;
  return total;
}

TEST(Motion, LeavesAnEvenStreakOfItsLengthAndKeepsItsLight) {
  const Folder folder;
  const std::string file = written(folder, kMoving);
  const Picture moving = moved(
      file, {{"shutter", "1", {}}, {"moments", "500", {}}, {"spp", "1024", {}}, {"sampling", "sobol", {}}});
  EXPECT_NEAR(sum(moving), 20 * 20, 4) << "the light of the square, which is 20 pixels wide";
  // 40 pixels a unit: the square covers every place from -0.75 to 0.75 for a quarter of the time.
  for (int x = 52; x < 108; ++x) EXPECT_NEAR(moving.at(x, 20).g, 0.25, 0.02) << x;
  EXPECT_EQ(moving.at(25, 20).g, 0);
  EXPECT_EQ(moving.at(135, 20).g, 0);
}

TEST(Motion, IsToldWhereAllKeysAreOver) {
  const Folder folder;
  const std::string file = written(folder, kMoving);
  const auto told = [&](const char* time) {
    Session session;
    session.open(file, std::vector<Choice>{{"time", time, {}}, {"shutter", "0.5", {}}, {"moments", "3", {}}});
    session.build();
    std::string all;
    for (const Message& message : session.messages().all()) all += message.what;
    return all.find("nothing moves while the shutter is open") != std::string::npos;
  };
  EXPECT_FALSE(told("0.9"));
  EXPECT_TRUE(told("1"));
}

TEST(Motion, HasTheSameBitsForAnyNumberOfThreadsAndIsExplained) {
  const Folder folder;
  const std::string file = written(folder, kMoving);
  const std::vector<Choice> choices{{"shutter", "1", {}}, {"moments", "9", {}}, {"spp", "4", {}}};
  std::vector<Choice> one = choices, seven = choices;
  one.push_back({"threads", "1", {}});
  seven.push_back({"threads", "7", {}});
  const Picture picture = moved(file, one);
  EXPECT_EQ(picture, moved(file, seven));

  Session session;
  session.open(file, choices);
  session.build();
  int moved = 0;
  for (int x = 40; x < 120; x += 3)
    for (int k = 0; k < 4; ++k) {
      const Explanation e = session.explain(x, 20, k);
      EXPECT_TRUE(sumsUp(e.tree));
      EXPECT_EQ(e.pixel, picture.at(x, 20));
      ASSERT_GE(e.tree.moment, 0);
      ASSERT_LT(e.tree.moment, 9);
      moved += e.tree.moment != 0;
    }
  EXPECT_GT(moved, 60);
}

TEST(Motion, OfNothingIsToldAndChangesNothing) {
  const Folder folder;
  const std::string file = written(folder, "SBT-raytracer 1.0\nambient_light { color = 1; }\nsphere { }\n");
  Session session;
  session.open(file, std::vector<Choice>{{"shutter", "1", {}}});
  session.build();
  EXPECT_NE(session.messages().all().back().what.find("nothing in the scene changes with time"),
            std::string::npos);
  EXPECT_EQ(moved(file, {{"shutter", "1", {}}}), moved(file, {}));
}

/// Rain that falls 3 units a second. It was thrown before the shutter opens, and all of it is in the picture.
constexpr const char* kRain = R"(SBT-raytracer 1.0
settings { time = 2; width = 60; spp = 16; sampling = sobol; transfer = linear; }
camera { position = (0, 0, 10); look_at = (0, 0, 0); fov = 45; aspectratio = 1.2; }
particles { seed = 8; rate = 5; duration = 0.9; lifetime = 20; lifetime_spread = 0; position = (0, 6, 0);
            spread = (4, 0.1, 0); velocity = (0, -3, 0); velocity_spread = 0; gravity = (0, 0, 0);
            size = 0.12; end_size = 0.12; material = { emissive = (1, 1, 1); } }
)";

int litPixels(const Picture& picture) {
  int lit = 0;
  for (const Color& c : picture.pixels) lit += c.g > 0;
  return lit;
}

TEST(Motion, OfParticlesIsSeen) {
  const Folder folder;
  const std::string file = written(folder, kRain);
  const Picture still = moved(file, {}), streaks = moved(file, {{"shutter", "0.3", {}}});
  EXPECT_GT(litPixels(streaks), 2 * litPixels(still));
  EXPECT_NEAR(sum(streaks) / sum(still), 1, 0.1) << "the same light";
  // The same as with anything else that changes.
  const std::string keyed = written(
      folder,
      (std::string(kRain) + "point_light { position = (0, 0, 0); color = key((0, 0), (9, 1)); }").c_str());
  EXPECT_EQ(litPixels(moved(keyed, {{"shutter", "0.3", {}}})), litPixels(streaks));
}

TEST(Motion, OfThingsThatComeAndGoIsSeenAndExplained) {
  const Folder folder;
  // A hundred a second for 0.2 seconds each: in a shutter of a second all of them are others in the end.
  const std::string file = written(folder, R"(SBT-raytracer 1.0
settings { time = 0; shutter = 1; moments = 8; width = 40; spp = 8; transfer = linear; depth = 3; }
camera { position = (0, 0, 10); look_at = (0, 0, 0); fov = 45; aspectratio = 1; }
point_light { position = (0, 5, 9); color = (1, 1, 1); constant_attenuation_coeff = 1; quadratic_attenuation_coeff = 0; }
sphere { name = "before"; material = { diffuse = (1, 0, 0); }; }
particles { rate = 100; lifetime = 0.2; spread = (3, 3, 0); velocity = (0, 0, 0); size = 0.3; end_size = 0.3;
            translate(0, 0, 0, sphere { name = "drop"; material = { diffuse = (0, 1, 0); reflective = (0.2, 0.2, 0.2); }; }) }
translate(0, 0, -3, scale(9, 9, 1, square { name = "behind"; material = { diffuse = (0, 0, 1); }; }))
)");
  for (const char* integrator : {"whitted", "path", "bdpt", "photon"}) {
    Session session;
    session.open(file, std::vector<Choice>{{"integrator", integrator, {}}, {"photons", "2000", {}}});
    session.build();
    ASSERT_EQ(session.moments().size(), 8u);
    EXPECT_NE(session.moments()[0].world->objectCount(), session.moments()[4].world->objectCount());
    EXPECT_EQ(session.renderPicture().end, End::finished);
    int drops = 0;
    for (int y = 1; y < 40; y += 4)
      for (int x = 1; x < 40; x += 4)
        for (int k = 0; k < 8; k += 3) {
          const Explanation e = session.explain(x, y, k);
          EXPECT_TRUE(sumsUp(e.tree));
          EXPECT_EQ(e.pixel, session.film().ofSamples(x, y));
          const Scene& scene = session.sceneOf(e.tree);
          EXPECT_EQ(&session.worldOf(e.tree),
                    session.moments()[static_cast<std::size_t>(e.tree.moment)].world);
          EXPECT_EQ(scene.objects.size(), session.worldOf(e.tree).objectCount());
          for (const RayNode& node : e.tree.nodes)
            if (node.hit) drops += scene.objects.at(node.hit->object).name == "drop";
        }
    EXPECT_GT(drops, 10) << integrator;
  }
}

// Whatever of a scene depends on time is found by asking the reader, not by looking for a word.
TEST(Motion, IsKnownOfWhateverChangesAScene) {
  const std::string light = "point_light { position = (0, 2, 2); color = (1, 1, 1); } ";
  std::vector<std::string> changing{
      "particles { }",
      "translate(0, 1, 0, { particles { rate = 3; sphere { } } })",
      "translate(key((0, 0), (1, 1)), 0, 0, sphere { })",
      "sphere { material = { diffuse = key((0, (0, 0, 0)), (1, (1, 1, 1))); } }",
      light +
          "camera { position = (0, 0, key((0, 5), (1, 6))); viewdir = (0, 0, -1); updir = (0, 1, 0); } "
          "sphere { }",
      "point_light { position = (0, 0, 0); color = key((0, 0), (1, 1)); } sphere { }",
      "background { gradient = ((0, 0, 0), key((0, (0, 0, 0)), (1, (1, 1, 1)))); } sphere { }",
      "polymesh { points = ((0, 0, 0), (1, 0, 0), (0, key((0, 1), (1, 2)), 0)); faces = ((0, 1, 2)); }",
      "sphere { material = { diffuse = noise { dimensions = 4; time = key((0, 0), (1, 1)); }; } }",
      "sphere { material = { diffuse = clouds { time = key((0, 1), (1, 2)); }; } }",
      "texture = clouds { name = changing; time = key((0, 1), (1, 2)); } "
      "sphere { material = { diffuse = texture(\"changing\"); } }",
  };
  const std::vector<std::string> still{"sphere { }", "sphere { name = \"key particles\"; }",
                                       light + "// key((0, 1), (1, 2)) particles { }\nsphere { }",
                                       "sphere { material = { diffuse = clouds { time = 3; }; } }"};
  for (const ShapeType& type : shapeTypes()) {  // each in a size that changes
    if (type.keyword.find("mesh") != type.keyword.npos) continue;
    changing.push_back("scale(key((0, 1), (1, 2)), " + std::string(type.keyword) + " { })");
  }
  const auto read = [](const std::string& text, Real seconds, bool& changes) {
    Messages messages;
    SceneTime time(seconds);
    Scene scene = readScene("test.ray", "SBT-raytracer 1.0\n" + text, messages, time);
    changes = time.changesScene();
    return scene;
  };
  bool changes = false;
  for (const std::string& text : changing) {
    Scene first, then;
    try {
      first = read(text, 0.25, changes), then = read(text, 0.5, changes);
    } catch (const Error& error) {  // of a shape that has to be told more
      EXPECT_NE(text.find("scale(key"), text.npos) << text << error.what();
      continue;
    }
    EXPECT_TRUE(changes) << text;
    EXPECT_FALSE(first == then) << text << ": this test would not see a change";
    EXPECT_TRUE(changesWithTime("test.ray", "SBT-raytracer 1.0\n" + text));
  }
  for (const std::string& text : still) {
    const Scene first = read(text, 0.25, changes), then = read(text, 0.5, changes);
    EXPECT_FALSE(changes) << text;
    EXPECT_TRUE(first == then) << text;
  }
}

TEST(Motion, OfAnEditedSceneHasTheEdits) {
  const Folder folder;
  Document document;
  document.open(written(folder, kMoving));
  ASSERT_TRUE(document.sceneAt());
  EXPECT_EQ(document.sceneAt()(0.5).objects[0].worldFromObject.offset.x, 0);
  Scene scene = document.scene();
  scene.objects[0].name = "edited";
  document.edit("name", scene);
  const SceneAt sceneAt = document.sceneAt();
  EXPECT_EQ(sceneAt(0.5).objects[0].name, "edited");
  EXPECT_EQ(sceneAt(0.5).objects[0].worldFromObject.offset.x, 0);
  EXPECT_EQ(sceneAt(1).objects[0].worldFromObject.offset.x, 1);
}

}  // namespace
}  // namespace trace::test
