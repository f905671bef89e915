#include "shading/optics/substances.h"

#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>

#include "base/text.h"
#include "shading/library.h"
#include "support/paths.h"

namespace trace::test {
namespace {

TEST(Substances, ThePageHasEachWithTheNumbersOfTheTable) {
  std::ifstream file(sourceFolder() + "/docs/indices.md");
  std::vector<std::string> rows;
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("| ") && !line.starts_with("| name")) rows.push_back(line);
  ASSERT_EQ(rows.size(), substances().size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Substance& s = substances()[i];
    EXPECT_EQ(rows[i], "| " + std::string(s.name) + " | " + std::string(s.group) + " | " + toText(s.index) +
                           " | " + (s.abbe > 0 ? toText(s.abbe) : "") + " | " + std::string(s.source) + " |");
  }
}

TEST(Substances, AreMaterialsOfTheirIndexAndDispersion) {
  std::set<std::string_view> names;
  for (const Substance& s : substances()) {
    EXPECT_TRUE(names.insert(s.name).second) << s.name;
    EXPECT_FALSE(s.source.empty()) << s.name;
    const auto material = libraryMaterial(s.name);
    ASSERT_TRUE(material) << s.name;
    const Phong phong = phongOf(*material);
    EXPECT_EQ(phong.index, s.index);
    EXPECT_TRUE(phong.transmits());
    // A glass by its formula and by its numbers is the same.
    if (const Sellmeier* formula = sellmeier(s.dispersion)) {
      EXPECT_NEAR(formula->index(kLineD), s.index, 2e-5) << s.name;
      EXPECT_NEAR((formula->index(kLineD) - 1) / (formula->index(kLineF) - formula->index(kLineC)), s.abbe,
                  0.02);
    }
  }
  for (const Translucent& t : translucents()) EXPECT_TRUE(names.insert(t.name).second) << t.name;
}

}  // namespace
}  // namespace trace::test
