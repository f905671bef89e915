// The real scenes of the courses and their students, which are not part of the repository.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "base/files/read_scope.h"
#include "ray_helpers.h"
#include "support/paths.h"

namespace trace::ray_corpus_test {
namespace {

namespace fs = std::filesystem;

/// Scenes that are broken, each looked at.
const std::map<std::string, std::string> kBroken{
    // The file ends after "rotate( 0, 1, 1, -2,".
    {"student/zuasia/geometry_file/scenes/box.ray", "28:21: expected \")\", found the end of the file"},
};

std::vector<std::string> scenes(const fs::path& folder) {
  std::vector<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".ray")
      files.push_back(fs::relative(entry.path(), folder).generic_string());
  std::sort(files.begin(), files.end());
  return files;
}

TEST(RayCorpus, EverySceneLoadsButTheBrokenOnes) {
  const ReadScope allowed({test::sharedFolder() + "/scenes"});
  const fs::path folder = fs::path(test::sharedFolder()) / "scenes" / "uw";
  if (!fs::exists(folder)) GTEST_SKIP() << "the scenes of the courses are absent: " << folder;
  std::map<std::string, std::string> failures;
  const auto files = scenes(folder);
  for (const std::string& file : files) {
    try {
      Messages messages;
      const Scene scene = readScene((folder / file).string(), messages);
      const bool blank = file.find("blank.ray") != std::string::npos;
      EXPECT_EQ(scene.objects.empty() && scene.unrendered.empty(), blank) << file;
      for (const Message& warning : messages.all())
        EXPECT_EQ(warning.hint.find("did you mean"), std::string::npos) << toString(warning);
    } catch (const Error& error) {
      const Message& m = error.messages().front();
      failures[file] = std::to_string(m.place.line) + ":" + std::to_string(m.place.column) + ": " + m.what;
    }
  }
  std::printf("%zu of %zu scenes load\n", files.size() - failures.size(), files.size());
  for (const auto& [file, what] : failures) std::printf("  %s:%s\n", file.c_str(), what.c_str());
  EXPECT_GE(files.size(), 191u);
  EXPECT_EQ(failures, kBroken);
}

/// Which files of a set are taken for the dialect of 2001.
std::vector<std::string> of2001(const fs::path& folder) {
  std::vector<std::string> files;
  for (const std::string& file : scenes(folder)) {
    Messages messages;
    for (const Choice& choice : readScene((folder / file).string(), messages).choices)
      if (choice.option == "like" && choice.value == "uw2001") files.push_back(file);
  }
  return files;
}

TEST(RayCorpus, KnowsTheDialectsApart) {
  const ReadScope allowed({test::sharedFolder() + "/scenes"});
  const fs::path folder = fs::path(test::sharedFolder()) / "scenes" / "uw";
  if (!fs::exists(folder)) GTEST_SKIP() << "the scenes of the courses are absent: " << folder;
  EXPECT_EQ(of2001(folder / "uw2005"), std::vector<std::string>{});
  EXPECT_EQ(of2001(folder / "manitoba-a1"), std::vector<std::string>{});
  // The others of this set give no shininess to a highlight.
  EXPECT_EQ(of2001(folder / "uw2001-hkust"),
            (std::vector<std::string>{
                "moreSamples/easy1.ray", "moreSamples/easy2.ray", "moreSamples/reflection.ray",
                "moreSamples/sphere.ray", "moreSamples/spheres.ray", "moreSamples/tentacles.ray",
                "moreSamples/test2.ray", "moreSamples/turtle.ray", "simpleSamples/box.ray",
                "simpleSamples/box_cyl_reflect.ray", "simpleSamples/cone.ray",
                "simpleSamples/cyl_diff_spec.ray", "simpleSamples/cylinder.ray",
                "simpleSamples/glossyReflection.ray", "simpleSamples/recurse_depth.ray"}));
}

}  // namespace
}  // namespace trace::ray_corpus_test
