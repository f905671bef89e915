// Whatever the bytes, the readers return a scene or throw Error. (The .ray reader has its own such tests.)
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "base/file.h"
#include "mesh_helpers.h"
#include "support/paths.h"

namespace trace {
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
  for (const File& file : corpus()) {
    EXPECT_EQ(survives(file.name, file.bytes), !file.broken) << file.name;
    for (const SceneFormat& format : sceneFormats())
      EXPECT_EQ(format.recognises(file.bytes), format.name == file.format) << file.name;
  }
}

TEST(Robustness, SurvivesTruncationAtEveryByte) {
  for (const File& file : corpus())
    for (std::size_t length = 0; length < file.bytes.size(); ++length)
      survives(file.name, std::string_view(file.bytes).substr(0, length));
}

TEST(Robustness, SurvivesMutation) {
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

}  // namespace
}  // namespace trace
