// A scene that is written and read again gives the same picture, bit for bit.
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>

#include "base/file.h"
#include "base/match.h"
#include "formats/format.h"
#include "formats/textures.h"
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

/// Whether a picture lies inside the scene's own file ("x.wrl#11:7"), where a .ray file cannot find it; the
/// writer warns.
bool holdsPictures(Scene scene) {
  bool found = false;
  for (Material& material : scene.materials)
    changePixels(material, [&](Pixels& pixels) { found |= liesInside(pixels.file); });
  return found;
}

enum class Broken { fails, isLeftOut };

void expectSamePicture(const std::string& file, Broken broken) {
  Messages messages;
  Scene scene;
  try {
    scene = readScene(file, messages);
  } catch (const Error& error) {
    if (broken == Broken::fails) ADD_FAILURE() << error.what();
    return;
  }
  if (holdsPictures(scene)) return;
  const std::string out = (std::filesystem::path(file).parent_path() / "out.ray").string();  // never written
  const auto files = writableFormatFor(out).write(scene, out, {}, messages);
  const Scene back = readScene(out, files.at(0).bytes, messages);
  EXPECT_EQ(small(back), small(scene)) << file;
}

constexpr const char* kSuffixes[] = {".ray", ".out", ".ascii", ".scene", ".iv", ".wrl"};

TEST(RoundTrip, ExamplesLookTheSame) {
  for (const char* suffix : kSuffixes)
    for (const std::string& file : test::filesUnder(test::sourceFolder() + "/scenes", suffix))
      expectSamePicture(file, Broken::fails);
}

TEST(RoundTrip, ScenesOfTheCoursesLookTheSame) {
  TRACE_NEEDS_SHARED("scenes/uw");
  for (const char* suffix : kSuffixes)
    for (const std::string& file : test::filesUnder(test::sharedFolder() + "/scenes", suffix))
      expectSamePicture(file, Broken::isLeftOut);  // the tests of the reader have them
}

TEST(RoundTrip, ExamplesLookTheSameAfterTheirTextWasEdited) {
  for (const std::string& file : test::filesUnder(test::sourceFolder() + "/scenes", ".ray")) {
    Messages messages;
    SceneText read{file, std::make_shared<const std::string>(readFile(file)), 0, {}};
    read.scene = std::make_shared<const Scene>(readScene(file, *read.bytes, messages));
    if (read.scene->format != "ray" || read.scene->objects.empty()) continue;
    Scene edited = *read.scene;
    edited.camera.fov *= 0.9;
    for (LightSource& source : edited.lights)
      match(source.light, [](auto& light) { light.color = light.color * 0.7; });
    for (Material& material : edited.materials) {
      changeColors(material.model, {kDiffuse, kColor}, [](const Color& color) { return color * 0.8; });
      if (Phong* phong = std::get_if<Phong>(&material.model)) phong->shininess += 3;
    }
    edited.choices = changedOptions(resolve({edited.choices}));
    const auto files = writeEdited(read, edited, file, messages);
    EXPECT_EQ(small(readScene(file, files.at(0).bytes, messages)), small(edited)) << file;
  }
}

}  // namespace
}  // namespace trace
