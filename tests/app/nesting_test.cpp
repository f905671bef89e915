// What may be nested in a file, and that all of Trace gets by with 1 MiB of stack when it is as deep as may
// be.
#include "base/nesting.h"

#include <gtest/gtest.h>
#include <pthread.h>

#include <functional>
#include <string>

#include "app/lint/lint.h"
#include "app/session/session.h"
#include "app/view/ray_drawing.h"
#include "base/files/file.h"
#include "base/sanitized.h"
#include "support/folder.h"

namespace trace::test {
namespace {

constexpr std::size_t kStack = kSanitized ? 6 << 20 : 1 << 20;  // frames are several times as large then

/// Runs it to its end in a thread with a stack of kStack bytes.
void withLittleStack(std::function<void()> work) {
  pthread_attr_t attributes;
  ASSERT_EQ(pthread_attr_init(&attributes), 0);
  ASSERT_EQ(pthread_attr_setstacksize(&attributes, kStack), 0);
  pthread_t thread;
  const auto run = [](void* what) -> void* {
    (*static_cast<std::function<void()>*>(what))();
    return nullptr;
  };
  ASSERT_EQ(pthread_create(&thread, &attributes, run, &work), 0);
  pthread_join(thread, nullptr);
  pthread_attr_destroy(&attributes);
}

std::string nested(const std::string& opening, int levels, const std::string& inner,
                   const std::string& closing) {
  std::string text;
  for (int i = 0; i < levels; ++i) text += opening;
  text += inner;
  for (int i = 0; i < levels; ++i) text += closing;
  return text;
}

/// A way of nesting, and how many levels of it are allowed.
struct Nesting {
  std::string file, head, opening, inner, closing;
  int most;
};

/// A wide picture: the views of its drawings have the fewest pixels.
const std::string kRay =
    "SBT-raytracer 1.0 camera { position = (0,0,5); viewdir = (0,0,-1); updir = (0,1,0); aspectratio = 6; }\n"
    "point_light { position = (3,3,5); color = (1,1,1); }\n";
const std::string kGltf =
    R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
"bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":
"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],"extras":)";

std::vector<Nesting> nestings() {
  const int solids = kMostNestedSolids;
  return {{"group.ray", kRay, "{", "sphere{}", "}", kMostNesting - 1},
          {"transform.ray", kRay, "translate(0,0,0,", "sphere{}", ")", kMostNesting - 1},
          {"union.ray", kRay, "union{", "sphere{}", "}", solids},
          {"tuple.ray", kRay, "union(", "sphere{}", ")", solids},
          {"clip.ray", kRay, "clip{", "sphere{}", "}", solids},
          {"blend.ray", kRay, "blend{ radius = 0.1; ", "sphere{}", "}", solids},
          {"intersection.ray", kRay, "scale(0.99, intersection{", "sphere{}", "})", solids},
          {"difference.ray", kRay, "difference{", "sphere{} translate(0.9,0,0, cube{})", "}", solids},
          {"groups.ray", kRay, "union{{", "sphere{} cube{}", "}}", solids / 2},
          {"particles.ray", kRay, "{ particles { rate = 1; {", "sphere{}", "}}}", solids / 3},
          {"separator.iv", "#Inventor V2.1 ascii\n", "Separator {", "Sphere{}", "}", kMostNesting - 1},
          {"transform.wrl", "#VRML V2.0 utf8\n", "Transform { children [", "Shape { geometry Sphere{} }",
           "] }", kMostNesting - 2},
          {"unknown.iv", "#Inventor V2.1 ascii\n", "Foo { bar ", "Sphere{}", "}", kMostNesting - 1},
          {"extras.gltf", kGltf, "[", "0", "]", kMostNesting - 1}};
}

/// Everything that goes through the shapes of a scene.
void useAll(const std::string& file) {
  Session session;
  session.open(file, std::vector<Choice>{{"width", "8", {}}, {"threads", "1", {}}});
  session.build();
  session.renderPicture();
  const Explanation explanation = session.explain(4, session.size().height / 2, 0);
  drawRays(session.scene(), session.settings(), session.world(), explanation.tree);
  const Scene copy = session.scene();
  EXPECT_EQ(copy, session.scene());
  lint(session.scene(), session.settings(), session.world(), session.messages().all());
  for (const SceneFormat& format : sceneFormats()) {
    if (!format.write || copy.objects.empty()) continue;
    Messages messages;
    const auto written = format.write(copy, "out" + std::string(format.suffixes[0]), {}, messages);
    const Scene back = readScene(written[0].file, written[0].bytes, messages);
    if (format.name == "ray") {
      EXPECT_EQ(back.objects.size(), copy.objects.size());
    }
  }
}

TEST(Nesting, AsDeepAsMayBeNeedsLittleStack) {
  const test::Folder folder;
  for (const Nesting& n : nestings()) {
    SCOPED_TRACE(n.file);
    const std::string ending = n.file == "extras.gltf" ? "}" : "";
    const std::string path = folder / n.file;
    writeFile(path, n.head + nested(n.opening, n.most, n.inner, n.closing) + ending);
    withLittleStack([&] {
      try {
        useAll(path);
      } catch (const std::exception& error) {
        ADD_FAILURE() << error.what();
      }
    });
  }
}

TEST(Nesting, DeeperIsRefusedWithItsPlace) {
  const test::Folder folder;
  for (const Nesting& n : nestings())
    for (const int levels : {kMostNesting + 1, 100'000}) {
      SCOPED_TRACE(n.file + " " + std::to_string(levels));
      const std::string path = folder / n.file;
      writeFile(path, n.head + nested(n.opening, levels, n.inner, n.closing));
      withLittleStack([&] {
        try {
          Session session;
          session.open(path, {});
          ADD_FAILURE() << "was read";
        } catch (const Error& error) {
          EXPECT_NE(std::string(error.what()).find("at most"), std::string::npos) << error.what();
          EXPECT_GT(error.messages().front().place.line, 0);
          EXPECT_GT(error.messages().front().place.column, 0);
        }
      });
    }
}

TEST(Nesting, SolidsAreRefusedOneLevelBeyondTheirLimit) {
  const test::Folder folder;
  const std::string path = folder / "solids.ray";
  writeFile(path, kRay + "\n" + nested("union{", kMostNestedSolids + 1, "sphere{}", "}"));
  try {
    Session().open(path, {});
    ADD_FAILURE() << "was read";
  } catch (const Error& error) {
    ASSERT_EQ(error.messages().size(), 1u);
    EXPECT_EQ(error.messages()[0].place.line, 4);
    EXPECT_EQ(error.messages()[0].place.column, 6 * kMostNestedSolids + 1);
  }
}

}  // namespace
}  // namespace trace::test
