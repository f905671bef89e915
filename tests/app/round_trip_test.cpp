// A scene that is written and read again gives the same picture, bit for bit.
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "base/files/file.h"
#include "base/files/read_scope.h"
#include "formats/format.h"
#include "support/folder.h"
#include "support/gltf.h"
#include "support/paths.h"
#include "support/scenes.h"
#include "support/shared.h"

namespace trace {
namespace {

Picture small(const Scene& scene) {
  Settings settings = resolve({scene.choices});
  settings.width = 24, settings.height = 0, settings.region = {}, settings.spp = 1, settings.depth = 2;
  settings.photons = settings.chainStarts = 2000;  // what they bring depends on what was read all the same
  if (settings.caustics > 0) settings.caustics = 2000;
  settings.passes = {};
  return test::picture(scene, settings);
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
  // Never written, but where pictures belong beside it.
  std::string out = (std::filesystem::path(file).parent_path() / "out.ray").string();
  auto files = writableFormatFor(out).write(scene, out, {}, messages);
  std::optional<test::Folder> folder;
  if (files.size() > 1) {
    out = folder.emplace() / "out.ray";
    files = writableFormatFor(out).write(scene, out, {}, messages);
    for (const NamedBytes& written : files) writeFile(written.file, written.bytes);
  }
  const Scene back = readScene(out, files.at(0).bytes, messages);
  EXPECT_EQ(small(back), small(scene)) << file;
}

constexpr const char* kSuffixes[] = {".ray", ".out", ".ascii", ".scene", ".iv", ".wrl"};

TEST(RoundTrip, ExamplesLookTheSame) {
  const ReadScope allowed({test::sharedFolder(), test::sourceFolder()});
  for (const char* suffix : kSuffixes)
    for (const std::string& file : test::filesUnder(test::sourceFolder() + "/scenes", suffix))
      expectSamePicture(file, Broken::fails);
}

TEST(RoundTrip, ScenesOfTheCoursesLookTheSame) {
  const ReadScope allowed({test::sharedFolder(), test::sourceFolder()});
  TRACE_NEEDS_SHARED("scenes/uw");
  for (const char* suffix : kSuffixes)
    for (const std::string& file : test::filesUnder(test::sharedFolder() + "/scenes", suffix))
      expectSamePicture(file, Broken::isLeftOut);  // the tests of the reader have them
}

/// Pictures that lie inside a file stand beside what it is converted to.
TEST(RoundTrip, ScenesWithPicturesInsideLookTheSame) {
  const ReadScope allowed({test::sharedFolder(), test::sourceFolder()});
  const test::Folder folder;
  const std::vector<InsideFile> pictures{{"red", test::smallPng(255, 0, 0)},
                                         {"red", test::smallPng(0, 200, 0)},
                                         {"", test::smallPng(0, 0, 255)}};
  writeFile(folder / "a.glb", test::gltfOf(pictures, true));
  writeFile(folder / "b.gltf", test::gltfOf(pictures, false));
  writeFile(
      folder / "c.wrl",
      "#VRML V2.0 utf8\nShape { appearance Appearance { material Material { } texture PixelTexture { image "
      "2 1 3 0xff0000 0x00ff00 } } geometry Sphere { } }\nTransform { translation 2 0 0 children Shape { "
      "appearance Appearance { texture PixelTexture { image 2 2 4 0xff0000ff 0x00ff0080 0x0000ffff "
      "0xffffff00 } } geometry Box { } } }\n");
  writeFile(folder / "d.ray", "SBT-raytracer 1.0\nmesh { file = \"a.glb\"; }\n");
  const std::string plain = folder / "e.glb";
  writeFile(plain, test::gltfOf({{"", test::smallPng(255, 255, 255)}}, true));
  Messages messages;
  EXPECT_NE(small(readScene(folder / "a.glb", messages)), small(readScene(plain, messages)));
  struct Case {
    const char* file;
    std::size_t ray,
        composer;  ///< files that are written; the composer has pictures of diffuse and color alone
  };
  for (const Case& c :
       {Case{"a.glb", 4, 4}, {"b.gltf", 4, 4}, {"c.wrl", 3, 2}, {"d.ray", 4, 4}, {"e.glb", 2, 2}}) {
    Messages found;
    const Scene scene = readScene(folder / c.file, found);
    for (const std::string suffix : {".ray", ".out"}) {
      const std::string out = folder / ("out" + suffix);
      const auto files = writableFormatFor(out).write(scene, out, {}, found);
      EXPECT_EQ(files.size(), suffix == ".ray" ? c.ray : c.composer) << c.file << suffix;
      for (const NamedBytes& file : files) writeFile(file.file, file.bytes);
      const Scene back = readScene(out, found);
      for (const Message& message : found.all())
        EXPECT_EQ(message.what.find("cannot be read"), std::string::npos) << message.what;
      if (suffix == ".ray") {
        EXPECT_EQ(small(back), small(scene)) << c.file;
      }
    }
  }
}

TEST(RoundTrip, ExamplesLookTheSameAfterTheirTextWasEdited) {
  const ReadScope allowed({test::sharedFolder(), test::sourceFolder()});
  for (const std::string& file : test::filesUnder(test::sourceFolder() + "/scenes", ".ray")) {
    Messages messages;
    SceneText read{file, std::make_shared<const std::string>(readFile(file)), 0, {}};
    read.scene = std::make_shared<const Scene>(readScene(file, *read.bytes, messages));
    if (read.scene->format != "ray" || read.scene->objects.empty()) continue;
    Scene edited = *read.scene;
    edited.camera.fov *= 0.9;
    for (LightSource& source : edited.lights)
      if (Color* color = editableValue<Color>(source.light, "color")) *color = *color * 0.7;
    for (Material& material : edited.materials) {
      changeColors(material.model, {kDiffuse, kColor}, [](const Color& color) { return color * 0.8; });
      if (Phong* phong = material.model.edit<Phong>()) phong->shininess += 3;
    }
    edited.choices = changedOptions(resolve({edited.choices}));
    const auto files = writeEdited(read, edited, file, messages).files;
    EXPECT_EQ(small(readScene(file, files.at(0).bytes, messages)), small(edited)) << file;
  }
}

}  // namespace
}  // namespace trace
