// The files of a render: names, values and words.
#include "app/output.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>

#include "app/session.h"
#include "image/codec.h"
#include "support/folder.h"
#include "support/paths.h"

namespace trace::test {
namespace {

class OutputTest : public testing::Test {
 protected:
  void render(std::vector<Choice> choices, const std::string& name) {
    choices.push_back({"width", "24", {}});
    session_.open(test::sourceFolder() + "/scenes/shapes.ray", choices);
    session_.build();
    session_.render();
    session_.save(folder_ / name);
  }

  const Folder folder_;
  Session session_;
};

TEST(Outputs, AreNamedAfterThePicture) {
  Settings settings;
  settings.passes = {Pass::id, Pass::depth};
  const auto names = [&](PassFormat format) {
    settings.passFormat = format;
    std::vector<std::string> all;
    for (const Output& output : outputs("a/b.c.bmp", settings)) all.push_back(output.path);
    return all;
  };
  EXPECT_EQ(names(PassFormat::exr),
            (std::vector<std::string>{"a/b.c.bmp", "a/b.c.depth.exr", "a/b.c.id.exr"}));
  EXPECT_EQ(names(PassFormat::png),
            (std::vector<std::string>{"a/b.c.bmp", "a/b.c.depth.png", "a/b.c.id.png"}));
  EXPECT_EQ(names(PassFormat::same),
            (std::vector<std::string>{"a/b.c.bmp", "a/b.c.depth.bmp", "a/b.c.id.bmp"}));
}

TEST_F(OutputTest, ExrHoldsRawValuesAndWords) {
  render({{"passes", "depth,id", {}}}, "a.png");
  const Picture depth = readPicture(folder_ / "a.depth.exr"), id = readPicture(folder_ / "a.id.exr");
  const Picture exact = session_.film().layer(0);
  bool far = false;
  for (std::size_t i = 0; i < depth.pixels.size(); ++i) {
    EXPECT_EQ(depth.pixels[i].r, static_cast<float>(exact.pixels[i].r));
    EXPECT_EQ(id.pixels[i], session_.film().layer(1).pixels[i]);
    far |= depth.pixels[i].r > 1;
  }
  EXPECT_TRUE(far);
  std::map<std::string, std::string> words;
  for (const auto& [key, text] : readMetadata(folder_ / "a.depth.exr")) words[key] = text;
  EXPECT_EQ(words["Pass"], "depth");
  EXPECT_EQ(words["Title"], "shapes.ray");
}

TEST_F(OutputTest, PngHoldsWhatIsShown) {
  render({{"passes", "depth", {}}, {"pass-format", "png", {}}}, "a.bmp");
  const ValueRange range = finiteRange(readPicture(folder_ / "a.depth.png"));
  EXPECT_EQ(range, (ValueRange{0, 1}));
}

TEST_F(OutputTest, ToneIsForLevelsOnly) {
  render({{"tone", "stretch", {}}}, "a.png");
  EXPECT_EQ(toBytes(readPicture(folder_ / "a.png"), Rounding::truncate),
            toBytes(toned(session_.picture(), Tone::stretch), Rounding::truncate));
  session_.save(folder_ / "a.exr");
  const Picture raw = readPicture(folder_ / "a.exr"), picture = session_.picture();
  for (std::size_t i = 0; i < raw.pixels.size(); ++i)
    EXPECT_EQ(raw.pixels[i].r, static_cast<float>(picture.pixels[i].r));
}

}  // namespace
}  // namespace trace::test
