// A scene that is written and read again gives the same picture, bit for bit.
#include <gtest/gtest.h>

#include <string>

#include "formats/format.h"
#include "support/paths.h"
#include "support/scenes.h"
#include "support/shared.h"

namespace trace {
namespace {

Picture small(const Scene& scene) {
  Settings settings = resolve({scene.choices});
  settings.width = 24, settings.height = 0, settings.region = {}, settings.spp = 1, settings.depth = 2;
  settings.passes = {};
  return test::picture(scene, settings);
}

void expectSamePicture(const std::string& file) {
  Messages messages;
  Scene scene;
  try {
    scene = readScene(file, messages);
  } catch (const Error&) {
    return;  // a broken one; the tests of the reader have them
  }
  const auto files = writableFormatFor("out.ray").write(scene, "out.ray", {}, messages);
  const Scene back = readScene("out.ray", files.at(0).bytes, messages);
  EXPECT_EQ(small(back), small(scene)) << file;
}

constexpr const char* kSuffixes[] = {".ray", ".out", ".ascii", ".scene", ".iv", ".wrl"};

TEST(RoundTrip, ExamplesLookTheSame) {
  for (const char* suffix : kSuffixes)
    for (const std::string& file : test::filesUnder(test::sourceFolder() + "/scenes", suffix))
      expectSamePicture(file);
}

TEST(RoundTrip, ScenesOfTheCoursesLookTheSame) {
  TRACE_NEEDS_SHARED("scenes/uw");
  for (const char* suffix : kSuffixes)
    for (const std::string& file : test::filesUnder(test::sharedFolder() + "/scenes", suffix))
      expectSamePicture(file);
}

}  // namespace
}  // namespace trace
