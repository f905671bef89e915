// Scene files in a folder of the test's own, for tests of what reads, watches and writes them.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <string>

#include "base/files/file.h"
#include "scene/scene.h"
#include "support/folder.h"

namespace trace::test {

inline constexpr const char* kScene = R"(SBT-raytracer 1.0
camera { position=(0,0,4); viewdir=(0,0,-1); updir=(0,1,0); }
directional_light { direction=(0,0,-1); color=(1,1,1); }
settings { depth = 3; }
sphere { name = "ball"; material = { diffuse = (1,0,0); } }
)";

/// A ball that moves along x: 0 at 0 s, 1 at 2 s.
inline constexpr const char* kAnimated = R"(SBT-raytracer 1.0
camera { position=(0,0,4); viewdir=(0,0,-1); updir=(0,1,0); }
directional_light { direction=(0,0,-1); color=(1,1,1); }
translate(key((0, 0), (2, 1)), 0, 0, sphere { name = "ball"; })
)";

/// With the file scene.ray, which is kScene.
class Files : public testing::Test {
 protected:
  Files() { write("scene.ray", kScene); }
  std::string path(const std::string& name) const { return folder_ / name; }
  void write(const std::string& name, const std::string& text) const { writeFile(path(name), text); }
  /// Writes, with a time that differs from the one before.
  void rewrite(const std::string& name, const std::string& text) const {
    const auto before = std::filesystem::last_write_time(path(name));
    write(name, text);
    std::filesystem::last_write_time(path(name), before + std::chrono::seconds(2));
  }

 private:
  test::Folder folder_;
};

inline Scene renamed(Scene scene, const std::string& name) {
  scene.objects.at(0).name = name;
  return scene;
}

}  // namespace trace::test
