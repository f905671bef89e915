// Whatever the bytes, the readers return a scene or throw Error. (The .ray reader has its own such tests.)
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "base/files/file.h"
#include "base/files/read_scope.h"
#include "base/sanitized.h"
#include "formats/format.h"
#include "formats/ray/write/writer.h"
#include "geometry/mesh/mesh.h"
#include "mesh_helpers.h"
#include "support/folder.h"
#include "support/paths.h"

namespace trace::robustness_test {
namespace {

namespace fs = std::filesystem;

struct File {
  std::string name, format, bytes;
  bool broken;
};

/// The files of tests/corpus for the formats, in the order of their names.
std::vector<File> corpus() {
  std::vector<File> files;
  for (const SceneFormat& format : sceneFormats()) {
    if (format.name == "ray") continue;
    for (const auto& entry :
         fs::directory_iterator(test::sourceFolder() + "/tests/corpus/" + std::string(format.name)))
      if (entry.path().extension() != ".mtl")
        files.push_back({entry.path().string(), std::string(format.name), readFile(entry.path().string()),
                         entry.path().filename().string().starts_with("broken")});
  }
  std::sort(files.begin(), files.end(), [](const File& a, const File& b) { return a.name < b.name; });
  return files;
}

/// Reads, and lets nothing but Error escape. True if it was a scene.
bool survives(const std::string& file, std::string_view bytes) {
  try {
    Messages messages;
    const Scene scene = readScene(file, bytes, messages);
    EXPECT_EQ(scene, scene) << "a NaN got in";
    for (const Object& object : scene.objects) EXPECT_LT(object.material, scene.materials.size());
    return true;
  } catch (const Error& error) {
    EXPECT_FALSE(error.messages().empty());
    return false;
  }
}

TEST(Robustness, ReadsItsCorpus) {
  const ReadScope allowed({test::sourceFolder()});
  for (const File& file : corpus()) {
    EXPECT_EQ(survives(file.name, file.bytes), !file.broken) << file.name;
    for (const SceneFormat& format : sceneFormats())
      EXPECT_EQ(format.recognises(file.bytes), format.name == file.format) << file.name;
  }
}

/// Every sound scene of the corpus, of .ray too.
std::vector<Scene> scenes() {
  std::vector<File> files = corpus();
  for (const auto& entry : fs::directory_iterator(test::sourceFolder() + "/tests/corpus/ray"))
    files.push_back({entry.path().string(), "ray", readFile(entry.path().string()),
                     entry.path().filename() == "damaged.ray"});
  std::vector<Scene> all;
  for (const File& file : files) {
    Messages messages;
    if (!file.broken) all.push_back(readScene(file.name, file.bytes, messages));
  }
  return all;
}

/// The names of everything are this one.
Scene named(Scene scene, const std::string& name) {
  for (Object& object : scene.objects) object.name = name;
  for (Material& material : scene.materials) material.name = name;
  return scene;
}

std::size_t lines(const std::vector<NamedBytes>& files) {
  std::size_t count = 0;
  for (const NamedBytes& file : files)
    count += static_cast<std::size_t>(std::count(file.bytes.begin(), file.bytes.end(), '\n'));
  return count;
}

std::size_t triangles(const Scene& scene) {
  std::size_t count = 0;
  for (const Object& object : scene.objects)
    if (const auto* mesh = object.shape.as<Mesh>()) count += mesh->data->triangles.size();
  return count;
}

TEST(Robustness, WhatWasReadIsWrittenAndReadAgain) {
  const ReadScope allowed({test::sourceFolder()});
  for (const Scene& scene : scenes()) {
    SCOPED_TRACE(scene.file);
    Messages messages;
    const auto files = writeRay(scene, "out.ray", {}, messages);
    const Scene back = readScene("out.ray", files.at(0).bytes, messages);
    ASSERT_EQ(back.objects.size(), scene.objects.size());
    for (std::size_t i = 0; i < scene.objects.size(); ++i)
      EXPECT_EQ(back.objects[i].worldFromObject, scene.objects[i].worldFromObject) << i;
    EXPECT_EQ(triangles(back), triangles(scene));
  }
}

TEST(Robustness, AFileThatNoRayFileCanNameIsRefused) {
  Messages messages;
  const Scene scene = readScene(
      "quoted.iv", "#Inventor V2.1 ascii\nSeparator { Texture2 { filename \"a\\\"b.png\" } Cube { } }",
      messages);
  try {
    writeRay(scene, "out.ray", {}, messages);
    ADD_FAILURE() << "a file of another name was written";
  } catch (const Error& error) {
    EXPECT_NE(std::string_view(error.what()).find("without quotation marks"), std::string_view::npos)
        << error.what();
  }
}

// glTF, VRML and PLY names may hold anything; a writer must not let them become lines of its file.
TEST(Robustness, NoNameBecomesAStatement) {
  const ReadScope allowed({test::sourceFolder()});
  const std::string kNames[] = {"a\nv 9 9 9\nf 1 2 3",
                                "b\r\nend_header",
                                "c\"\n}\nsphere {\n name \"d",
                                "\"; } sphere { } //",
                                "# comment",
                                "/* */",
                                "tail\\",
                                "\xff\xfe\x80",
                                "line\xe2\x80\xa8separator",
                                "\x1b[31mred",
                                std::string("zero\0byte", 9),
                                "\n",
                                "Jos\u00e9 \u4e2d\u6587"};
  std::map<std::string_view, int> tried;
  for (const Scene& scene : scenes())
    for (const SceneFormat& format : sceneFormats()) {
      if (!format.write) continue;
      const std::string file = "out" + std::string(format.suffixes[0]);
      Messages messages;
      std::vector<NamedBytes> plain;
      std::size_t objects = 0, faces = 0;
      try {
        plain = format.write(named(scene, "plain"), file, {.ascii = true}, messages);
        const Scene back = readScene(file, plain.at(0).bytes, messages);
        objects = back.objects.size(), faces = triangles(back);
      } catch (const Error&) {
        continue;  // the format cannot hold the scene
      }
      if (faces > 1000) continue;  // it has no other names
      ++tried[format.name];
      for (const std::string& name : kNames) {
        SCOPED_TRACE(scene.file + " as " + std::string(format.name) + " with the name " + name);
        const auto files = format.write(named(scene, name), file, {.ascii = true}, messages);
        // Lists of materials in a .ray file are wrapped by their length.
        if (format.name != "ray") {
          EXPECT_EQ(lines(files), lines(plain));
        }
        for (const NamedBytes& written : files)
          for (char c : written.file.ends_with(".webp") ? std::string() : written.bytes)
            ASSERT_TRUE(c == '\n' || c == '\t' || (static_cast<unsigned char>(c) >= ' ' && c != '\x7f'));
        const Scene back = readScene(file, files.at(0).bytes, messages);
        EXPECT_EQ(back.objects.size(), objects);
        EXPECT_EQ(triangles(back), faces);
      }
    }
  for (const SceneFormat& format : sceneFormats()) {
    if (!format.write) continue;
    EXPECT_GT(tried[format.name], 10) << format.name;
  }
}

TEST(Robustness, SurvivesTruncationAtEveryByte) {
  const ReadScope allowed({test::sourceFolder()});
  constexpr std::size_t kStep = kSanitized ? 3 : 1;
  for (const File& file : corpus())
    for (std::size_t length = 0; length < file.bytes.size(); length += kStep)
      survives(file.name, std::string_view(file.bytes).substr(0, length));
}

TEST(Robustness, SurvivesMutation) {
  const ReadScope allowed({test::sourceFolder()});
  static constexpr std::string_view kBits[] = {"0",    "-1",  "1e999",      "nan", "99999999999", "\n", " ",
                                               "\xff", "255", "4000000000", "{",   "]",           "\""};
  const std::vector<File> files = corpus();
  std::mt19937 random(77);
  const auto below = [&](std::size_t n) { return n ? random() % n : 0; };
  for (int i = 0; i < 20000; ++i) {
    const File& file = files[below(files.size())];
    std::string bytes = file.bytes;
    for (std::size_t change = 0; change <= below(5); ++change) {
      const std::size_t at = below(bytes.size());
      switch (below(4)) {
        case 0: bytes[at] = static_cast<char>(random()); break;
        case 1: bytes.erase(at, 1 + below(20)); break;
        case 2: bytes.insert(at, kBits[below(std::size(kBits))]); break;
        default: bytes.replace(at, 1 + below(12), bytes, below(bytes.size()), 1 + below(12));
      }
    }
    survives(file.name, bytes);
  }
}

// MTL files are read because an OBJ file names them.
TEST(Robustness, SurvivesDamagedMaterials) {
  const ReadScope allowed({test::sourceFolder()});
  const test::Folder folder;
  constexpr std::string_view kObject = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n";
  std::mt19937 random(5);
  for (const auto& entry : fs::directory_iterator(test::sourceFolder() + "/tests/corpus/mtl")) {
    const std::string whole = readFile(entry.path().string());
    for (std::size_t i = 0; i < whole.size(); ++i) {
      writeFile(folder / "a.mtl", std::string_view(whole).substr(0, i));
      survives(folder / "a.obj", kObject);
      std::string damaged = whole;
      damaged[i] = static_cast<char>(random());
      writeFile(folder / "a.mtl", damaged);
      survives(folder / "a.obj", kObject);
    }
  }
}

}  // namespace
}  // namespace trace::robustness_test
