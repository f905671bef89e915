// docs/ray-format.md and docs/shapes.md are written by hand; what they list must be what the lists of the
// program say.
#include <gtest/gtest.h>

#include "base/files/file.h"
#include "base/match.h"
#include "formats/format.h"
#include "formats/known_fields.h"
#include "geometry/field_value.h"
#include "scene/conventions.h"
#include "scene/options.h"
#include "scene/scene.h"
#include "shading/light_list.h"
#include "shading/material_list.h"
#include "support/paths.h"

namespace trace::docs_test {
namespace {

std::string page(const char* name) { return readFile(test::sourceFolder() + "/docs/" + name); }

template <class Struct>
void expectDocumented(const std::string& text) {
  const std::string node = "`" + std::string(Struct::kKeyword) + "`";
  EXPECT_NE(text.find(node), std::string::npos) << node;
  forEachField<Struct>([&](const auto& field) {
    EXPECT_NE(text.find("`" + std::string(field.keyword) + "`"), std::string::npos)
        << node << " " << field.keyword;
  });
}

TEST(Docs, NameEveryNodeAndField) {
  const std::string text = page("ray-format.md") + page("shapes.md") + page("materials.md");
  for (const ShapeType& type : shapeTypes()) {
    const std::string node = "`" + std::string(type.keyword) + "`";
    EXPECT_NE(text.find(node), std::string::npos) << node;
    for (const AnyField& field : Shape(type).fields())
      EXPECT_NE(text.find("`" + std::string(field.keyword) + "`"), std::string::npos)
          << node << " " << field.keyword;
  }
  forEachType<LightList>([&]<class L>(L*) { expectDocumented<L>(text); });
  forEachType<ModelList>([&]<class M>(M*) { expectDocumented<M>(text + "`material`"); });
  expectDocumented<Camera>(text + "`camera`");
  expectDocumented<Background>(text);
}

TEST(Docs, TableOfConventionsIsThatOfTheProgram) {
  const std::string text = page("conventions.md");
  for (const Option& option : options()) {
    if (option.group != "Conventions" || option.name == "like") continue;
    std::string row = "| `--" + std::string(option.name) + "` |";
    for (const Convention& convention : conventions()) row += " " + option.get(convention.settings) + " |";
    EXPECT_NE(text.find(row), std::string::npos) << row;
  }
}

TEST(Docs, TableOfFormatsIsThatOfTheProgram) {
  const std::string text = page("formats.md");
  for (const SceneFormat& format : sceneFormats()) {
    std::string row = "| `" + std::string(format.name) + "` | ";
    for (std::string_view suffix : format.suffixes)
      row += (suffix == format.suffixes.front() ? "" : ", ") + std::string(suffix);
    EXPECT_NE(text.find(row + " |"), std::string::npos) << row;
  }
}

TEST(Docs, PageOfFormatsIsTheTableOfFields) {
  EXPECT_EQ(formatsMarkdown(), page("formats.md")) << "run: ray convert --markdown >docs/formats.md";
}

}  // namespace
}  // namespace trace::docs_test
