// The face for C: what it gives is what the face for C++ gives, and no exception leaves it.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <string>

#include "support/folder.h"
#include "traceray/traceray.h"
#include "traceray/traceray_c.h"

namespace {

constexpr const char* kBall = R"(SBT-raytracer 1.0
settings { width = 24; height = 24; spp = 1; }
camera { position = (0, 0, 4); viewdir = (0, 0, -1); updir = (0, 1, 0); fov = 40; }
directional_light { direction = (0, 0, -1); color = (1, 1, 1); name = key; }
sphere { name = ball; material = { diffuse = (0.8, 0.4, 0.2); }; }
)";

/// Frees what a test has made.
struct Scene {
  traceray_scene* at;
  ~Scene() { traceray_free_scene(at); }
};
struct Render {
  traceray_render* at;
  ~Render() { traceray_free_render(at); }
};

bool holds(const char* text, const char* part) { return text && std::strstr(text, part); }

TEST(CFace, RendersWhatTheLibraryRenders) {
  const Scene scene{traceray_from_text(kBall, nullptr)};
  ASSERT_TRUE(scene.at) << traceray_error();
  const Render render{traceray_render_scene(scene.at, nullptr, nullptr)};
  ASSERT_TRUE(render.at) << traceray_error();
  const traceray::Render same = traceray::Scene::fromText(kBall).render();
  ASSERT_EQ(traceray_width(render.at), same.width());
  ASSERT_EQ(traceray_height(render.at), same.height());
  EXPECT_EQ(traceray_is_finished(render.at), 1);
  EXPECT_STREQ(traceray_end(render.at), "finished");
  const std::vector<float>& light = same.image().values;
  EXPECT_EQ(std::memcmp(traceray_light(render.at), light.data(), light.size() * sizeof(float)), 0);
  const std::vector<float> shown = same.shown().values;
  EXPECT_EQ(std::memcmp(traceray_shown(render.at), shown.data(), shown.size() * sizeof(float)), 0);
  std::size_t size = 0;
  const unsigned char* png = traceray_png(render.at, &size);
  ASSERT_GT(size, 8u);
  EXPECT_EQ(std::memcmp(png, "\x89PNG", 4), 0);
  EXPECT_TRUE(holds(traceray_explain(render.at, 12, 12, 0), "ball"));
  EXPECT_TRUE(holds(traceray_explain_json(render.at, 12, 12, 0), "\"rays\""));
  EXPECT_STREQ(traceray_version(), traceray::version().c_str());
}

TEST(CFace, EditsPartsByTheirNames) {
  const Scene scene{traceray_from_text(kBall, nullptr)};
  const std::array<double, 3> green{0.1, 0.7, 0.2};
  EXPECT_EQ(traceray_set_numbers(scene.at, "ball.material", "diffuse", green.data(), 3), 1)
      << traceray_error();
  std::array<double, 3> read{};
  EXPECT_EQ(traceray_get_numbers(scene.at, "ball.material", "diffuse", read.data(), 3), 3u);
  EXPECT_EQ(read, green);
  EXPECT_EQ(traceray_get_numbers(scene.at, "ball.material", "diffuse", read.data(), 1), 3u);
  EXPECT_STREQ(traceray_get(scene.at, "key", "color"), "(1, 1, 1)");
  const double one = 50;
  EXPECT_EQ(traceray_set_numbers(scene.at, "camera", "fov", &one, 1), 1) << traceray_error();
  EXPECT_STREQ(traceray_get(scene.at, "camera", "fov"), "50");
  std::array<double, 16> place{};
  EXPECT_EQ(traceray_get_transform(scene.at, "ball", place.data()), 1);
  place[3] = 5;
  EXPECT_EQ(traceray_set_transform(scene.at, "ball", place.data()), 1) << traceray_error();
  const Scene copy{traceray_copy_scene(scene.at)};
  EXPECT_EQ(traceray_remove(scene.at, "ball"), 1);
  EXPECT_EQ(traceray_remove(scene.at, "ball"), 0);
  EXPECT_EQ(traceray_error_kind(), TRACERAY_USAGE);
  EXPECT_EQ(traceray_get_transform(copy.at, "ball", place.data()), 1);
  EXPECT_EQ(place[3], 5);
  EXPECT_EQ(traceray_add(copy.at, "sphere { name = second; }"), 1) << traceray_error();
  EXPECT_STREQ(traceray_get(copy.at, "second", "name"), "second");
  EXPECT_EQ(traceray_set_text(copy.at, "second", "material", "gold"), 1) << traceray_error();
  EXPECT_STREQ(traceray_warnings(copy.at), "");
  EXPECT_NE(traceray_lint(copy.at), nullptr);
}

TEST(CFace, KeepsTheReasonOfTheFirstFailure) {
  traceray_scene* none = traceray_open("no_such.ray");
  EXPECT_EQ(none, nullptr);
  EXPECT_EQ(traceray_error_kind(), TRACERAY_FILE);
  EXPECT_EQ(traceray_choose(none, "width", "64"), 0);
  EXPECT_EQ(traceray_render_scene(none, nullptr, nullptr), nullptr);
  EXPECT_EQ(traceray_write(nullptr, "x.png"), nullptr);
  EXPECT_TRUE(holds(traceray_error(), "no_such.ray")) << traceray_error();
  const Scene scene{traceray_new_scene()};
  EXPECT_STREQ(traceray_error(), "");
  EXPECT_EQ(traceray_error_kind(), TRACERAY_NONE);
  EXPECT_EQ(traceray_add(scene.at, "sphere { radios = 2; }"), 0);
  EXPECT_EQ(traceray_error_kind(), TRACERAY_SCENE);
  EXPECT_TRUE(holds(traceray_error(), "radios")) << traceray_error();
  EXPECT_EQ(traceray_choose(scene.at, "widht", "64"), 0);
  EXPECT_TRUE(holds(traceray_error(), "width")) << traceray_error();
  EXPECT_EQ(traceray_get(scene.at, "nobody", "radius"), nullptr);
  EXPECT_EQ(traceray_add(scene.at, nullptr), 0);
  EXPECT_EQ(traceray_error_kind(), TRACERAY_USAGE);
  traceray_free_scene(nullptr);
  traceray_free_render(nullptr);
}

TEST(CFace, ACallerMayStopARender) {
  const Scene scene{traceray_from_text(kBall, nullptr)};
  ASSERT_EQ(traceray_choose(scene.at, "spp", "10000"), 1);
  int calls = 0;
  const Render render{traceray_render_scene(
      scene.at,
      [](double fraction, double, void* user) {
        EXPECT_GE(fraction, 0);
        return ++*static_cast<int*>(user) < 3 ? 1 : 0;
      },
      &calls)};
  ASSERT_TRUE(render.at) << traceray_error();
  EXPECT_EQ(traceray_is_finished(render.at), 0);
  EXPECT_STREQ(traceray_end(render.at), "cancelled");
  EXPECT_GE(calls, 3);
}

TEST(CFace, WritesPicturesAndScenes) {
  const trace::test::Folder folder;
  const Scene scene{traceray_from_text(kBall, nullptr)};
  ASSERT_EQ(traceray_choose(scene.at, "passes", "depth"), 1) << traceray_error();
  const Render render{traceray_render_scene(scene.at, nullptr, nullptr)};
  EXPECT_NEAR(traceray_pass(render.at, "depth")[3 * (12 * 24 + 12)], 3, 0.1);
  EXPECT_EQ(traceray_pass(render.at, "normal"), nullptr);
  const std::string picture = folder / "ball.png", file = folder / "ball.ray";
  EXPECT_STREQ(traceray_write(render.at, picture.c_str()), picture.c_str());
  EXPECT_EQ(traceray_save(scene.at, file.c_str()), 1) << traceray_error();
  EXPECT_TRUE(std::ifstream(file).good());
}

}  // namespace
