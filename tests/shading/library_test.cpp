#include "shading/library.h"

#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <string>

#include "shading/materials/conductor.h"
#include "shading/optics/substances.h"
#include "support/paths.h"

namespace trace::test {
namespace {

TEST(Library, ThePageHasEachOfItsMaterials) {
  std::ifstream file(sourceFolder() + "/docs/library.md");
  std::vector<std::string> rows;
  for (std::string line; std::getline(file, line) && (rows.empty() || line.starts_with("| "));)
    if (line.starts_with("| ") && !line.starts_with("| name")) rows.push_back(line);
  ASSERT_EQ(rows.size(), finishes().size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Finish& f = finishes()[i];
    EXPECT_EQ(rows[i], "| " + std::string(f.name) + " | " + std::string(f.group) + " | " +
                           std::string(f.looks) + " |");
  }
}

TEST(Library, NamesAreDifferentAndMakeMaterialsOfThatName) {
  std::set<std::string_view> names;
  for (const std::string_view name : libraryNames()) {
    EXPECT_TRUE(names.insert(name).second) << name;
    const auto material = libraryMaterial(name);
    ASSERT_TRUE(material) << name;
    EXPECT_EQ(material->name, name);
  }
  EXPECT_EQ(names.size(), finishes().size() + substances().size() + translucents().size());
  EXPECT_FALSE(libraryMaterial("kryptonite"));
}

/// Each has its own look, light does not pass it, and what it scatters of a texture stays between black and
/// white.
TEST(Library, FinishesAreOpaqueAndNoTwoAlike) {
  std::vector<Material> made;
  for (const Finish& finish : finishes()) {
    const Material material = finish.make();
    EXPECT_FALSE(phongOf(material.model).transmits()) << finish.name;
    for (const Material& other : made) EXPECT_FALSE(other == material) << finish.name;
    made.push_back(material);
    for (const FieldTexture& t : material.textures)
      for (int i = 0; i < 200; ++i) {
        TexturePlace place;
        place.point = Vec3{std::sin(i * 1.7), std::sin(i * 2.3 + 1), std::sin(i * 0.9 + 2)};
        const Color c = t.texture.at(place);
        EXPECT_TRUE(c.r >= 0 && c.r <= 1 && c.g >= 0 && c.g <= 1 && c.b >= 0 && c.b <= 1)
            << finish.name << " " << t.field << " " << c.r << " " << c.g << " " << c.b;
      }
  }
}

TEST(Library, MetalsMirrorInTheirColours) {
  const auto along = [](std::string_view name) {
    return libraryMaterial(name)->model.as<Conductor>()->mirrored(1);
  };
  EXPECT_GT(along("gold").r, along("gold").b * 2);
  EXPECT_GT(along("copper").r, along("copper").g * 1.3);
  EXPECT_GT(along("silver").b, 0.85);
  EXPECT_NEAR(along("titanium").g, 0.497, 1e-12) << "as said of light along the normal";
}

}  // namespace
}  // namespace trace::test
