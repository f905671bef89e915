// Whatever the bytes, the .ray reader returns a scene or throws Error; its memory and time follow the text.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "base/files/file.h"
#include "base/nesting.h"
#include "geometry/mesh/mesh.h"
#include "ray_helpers.h"
#include "support/paths.h"

namespace trace::ray_robustness_test {
namespace {

/// Every file of our corpus, in the order of their names.
std::vector<std::string> corpus() {
  std::vector<std::string> names, files;
  for (const auto& entry : std::filesystem::directory_iterator(test::sourceFolder() + "/tests/corpus/ray"))
    if (entry.path().extension() == ".ray") names.push_back(entry.path().string());
  std::sort(names.begin(), names.end());
  for (const std::string& name : names) files.push_back(readFile(name));
  return files;
}

/// Reads, and lets nothing but Error escape. True if it was a scene.
bool survives(std::string_view bytes) {
  try {
    Messages messages;
    const Scene scene = readScene("test.ray", bytes, messages);
    EXPECT_EQ(scene, scene) << "a NaN got in";
    return true;
  } catch (const Error& error) {
    EXPECT_FALSE(error.messages().empty());
    return false;
  }
}

TEST(RayRobustness, ReadsItsCorpus) {
  int scenes = 0;
  const auto files = corpus();
  ASSERT_EQ(files.size(), 7u);
  for (const std::string& file : files) scenes += survives(file);
  EXPECT_EQ(scenes, 6) << "all but damaged.ray";
}

TEST(RayRobustness, SurvivesTruncationAtEveryByte) {
  for (const std::string& file : corpus())
    for (size_t length = 0; length < file.size(); ++length)
      survives(std::string_view(file).substr(0, length));
}

TEST(RayRobustness, SurvivesMutation) {
  const auto files = corpus();
  static constexpr std::string_view kBits[] = {
      "(",  ")", "{",     "}",   "=",      ";",  ",",           "\"", "/*",         "*/",
      "//", "-", "1e999", "nan", "1e-320", "-1", "99999999999", "\n", "map(\"x\")", "material ="};
  std::mt19937 random(20241);
  const auto below = [&](size_t n) { return n ? random() % n : 0; };
  for (int i = 0; i < 20000; ++i) {
    std::string text = files[below(files.size())];
    for (size_t change = 0; change <= below(6); ++change) {
      const size_t at = below(text.size());
      const std::string& other = files[below(files.size())];
      const size_t from = below(other.size());
      switch (below(5)) {
        case 0: text[at] = static_cast<char>(random()); break;
        case 1: text.erase(at, 1 + below(20)); break;
        case 2: text.insert(at, kBits[below(std::size(kBits))]); break;
        case 3: text.insert(at, other, from, 1 + below(200)); break;
        default: text.replace(at, 1 + below(40), other, from, 1 + below(40));
      }
    }
    survives(text);
  }
}

std::string repeated(std::string_view text, int times) {
  std::string result;
  for (int i = 0; i < times; ++i) result += text;
  return result;
}

TEST(RayRobustness, SurvivesDeepNesting) {
  for (const char* opening : {"translate(0,0,0,", "{", "(", "a{", "a=(", "scale(1,{", "material={diffuse="})
    EXPECT_FALSE(survives("SBT-raytracer 1.0 " + repeated(opening, 100000))) << opening;
  for (const auto& [opening, closing] : {std::pair{"translate(0,0,0,", ")"}, {"{", "}"}, {"a{", "}"}})
    for (const char* inner : {"sphere{}", "polymesh{points=((0,0,0))}"}) {
      const int own = std::string_view(inner).find('(') == std::string_view::npos ? 1 : 3;
      const int depth = kMostNesting - own;
      EXPECT_TRUE(
          survives("SBT-raytracer 1.0 " + repeated(opening, depth) + inner + repeated(closing, depth)))
          << opening;
    }
}

TEST(RayRobustness, HugeCountsNeedHugeTexts) {
  EXPECT_FALSE(
      survives("SBT-raytracer 1.0 polymesh { points = ((0,0,0)); faces = ((0, 4294967295, 1e18)); }"));
  // A polygon of n corners is n - 2 triangles, no more.
  std::string fan = "polymesh { faces = ((0,1";
  for (int i = 2; i < 5000; ++i) fan += "," + std::to_string(i);
  fan += ")); points = (";
  for (int i = 0; i < 5000; ++i) fan += "(" + std::to_string(i) + "," + std::to_string(i % 7) + ",0)";
  const auto mesh = onlyShape<Mesh>(fan + ") }").data;
  EXPECT_LE(mesh->triangles.size(), 4998u);
}

TEST(RayRobustness, RepeatedTroubleIsToldOnce) {
  // Many of a kind are one warning; many kinds on one long line do not each keep a copy of that line.
  EXPECT_EQ(load(repeated("shape_light { } ", 10000) + "sphere{}").warnings.size(), 1u);
  std::string kinds;
  for (int i = 0; i < 2000; ++i) kinds += "a" + std::to_string(i) + " { } ";
  const Loaded loaded = load(kinds);
  EXPECT_EQ(loaded.warnings.size(), 2001u);
  size_t bytes = 0;
  for (const Message& warning : loaded.warnings) bytes += warning.place.text.size();
  for (const Unrendered& unrendered : loaded.scene.unrendered) bytes += unrendered.place.text.size();
  EXPECT_LE(bytes, 51 * kinds.size());
}

}  // namespace
}  // namespace trace::ray_robustness_test
