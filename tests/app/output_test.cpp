// The files of a render: names, values and words.
#include "app/session/output.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>

#include "app/session/session.h"
#include "base/files/file.h"
#include "image/codecs/codec.h"
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
    session_.renderPicture();
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

// --- fragments: films with tiles to come ---

class Fragment : public testing::Test {
 protected:
  /// A film of two tiles.
  static Film film(int done) {
    Film film(2 * Film::kTileSize, Film::kTileSize);
    for (int i = 0; i < done; ++i) film.add(i, 0, {});
    return film;
  }
  static inline const Metadata kWords{{"Software", "a test"}};

  std::string path(const std::string& name) const { return folder_ / name; }
  bool exists(const std::string& name) const { return std::filesystem::exists(path(name)); }
  std::string write(PictureFiles& files, int done) const {
    return std::filesystem::path(files.write(film(done), settings_, kWords)).filename().string();
  }
  /// By a run of its own.
  std::string write(const std::string& name, int done) const {
    PictureFiles files(path(name), {});
    return write(files, done);
  }

  const Folder folder_;
  Settings settings_;
};

TEST_F(Fragment, NeverReplacesAWholePicture) {
  for (const PictureFormat& format : pictureFormats()) {
    if (!format.encode) continue;
    const std::string suffix(format.suffixes[0]), name = "a" + suffix;
    EXPECT_EQ(write(name, 2), name);
    const std::string whole = readFile(path(name));
    for (int again = 0; again < 3; ++again) EXPECT_EQ(write(name, 1), "a.partial" + suffix);
    EXPECT_EQ(readFile(path(name)), whole) << suffix;
    EXPECT_EQ(write(name, 2), name);
  }
}

TEST_F(Fragment, LiesUnderTheNameItselfWhereNothingWas) {
  for (const PictureFormat& format : pictureFormats()) {
    if (!format.encode) continue;
    const std::string name = "a" + std::string(format.suffixes[0]);
    PictureFiles files(path(name), {});
    EXPECT_EQ(write(files, 1), name);
    EXPECT_EQ(write(files, 1), name);  // what this run wrote it may replace
    EXPECT_EQ(write(files, 2), name);
  }
}

TEST_F(Fragment, ReplacesAFragmentOfAnEarlierRun) {
  EXPECT_EQ(write("a.png", 1), "a.png");
  EXPECT_EQ(write("a.png", 1), "a.png");
  // A BMP cannot say that it is one, and so is taken for whole.
  EXPECT_EQ(write("a.bmp", 1), "a.bmp");
  EXPECT_EQ(write("a.bmp", 1), "a.partial.bmp");
  EXPECT_EQ(write("a.bmp", 1), "a.partial.bmp");
}

TEST_F(Fragment, SparesWhatIsNoPictureOrWholeBesideIt) {
  writeFile(path("a.png"), "notes");
  writeFile(path("b.png"), "");
  write("c.png", 2), write("c.partial.png", 2);
  EXPECT_EQ(write("a.png", 1), "a.partial.png");
  EXPECT_EQ(readFile(path("a.png")), "notes");
  EXPECT_EQ(write("b.png", 1), "b.png");
  EXPECT_EQ(write("c.png", 1), "c.partial-2.png");
}

TEST_F(Fragment, SparesInputs) {
  write("a.png", 1);  // a height map may be one
  const std::string before = readFile(path("a.png"));
  InputFiles inputs;
  inputs.noteNamed(path("a.png"));
  PictureFiles files(path("a.png"), inputs);
  EXPECT_EQ(write(files, 1), "a.partial.png");
  EXPECT_EQ(readFile(path("a.png")), before);
}

TEST_F(Fragment, StaysTogetherWithItsPasses) {
  write("elsewhere.exr", 2);
  std::filesystem::rename(path("elsewhere.exr"), path("a.depth.exr"));  // the pass alone is whole
  settings_.passes = {Pass::depth};
  const auto makeBoth = [&](PictureFiles& files, int done) {
    const Film::LayerKind kinds[] = {{Color(0)}};
    Film both(2 * Film::kTileSize, Film::kTileSize, 1, kinds);
    for (int i = 0; i < done; ++i) both.add(i, 0, {});
    return files.write(both, settings_, kWords);
  };
  PictureFiles files(path("a.png"), {});
  EXPECT_EQ(makeBoth(files, 1), path("a.partial.png"));
  EXPECT_TRUE(exists("a.partial.depth.exr"));
  EXPECT_FALSE(exists("a.png"));
  EXPECT_EQ(makeBoth(files, 2), path("a.png"));
  EXPECT_FALSE(exists("a.partial.png") || exists("a.partial.depth.exr"));  // of no use any more
}

TEST_F(Fragment, OfAnEarlierRunGoesWhenTheSamePictureIsWhole) {
  write("a.png", 2);
  const Metadata other{{"Software", "a test"}, {"Settings", "spp=9"}};
  PictureFiles(path("a.png"), {}).write(film(1), settings_, other);
  std::filesystem::rename(path("a.partial.png"), path("a.partial-2.png"));
  EXPECT_EQ(write("a.png", 1), "a.partial.png");
  PictureFiles files(path("a.png"), {});
  EXPECT_EQ(write(files, 2), "a.png");
  EXPECT_FALSE(exists("a.partial.png"));
  EXPECT_EQ(files.removed(), std::vector<std::string>{path("a.partial.png")});
  EXPECT_TRUE(exists("a.partial-2.png")) << "a part of another picture, perhaps a dearer one";
}

TEST_F(Fragment, GoesWithItsPassesWhenTheWholePictureHasNone) {
  const auto wordsOf = [](const char* settings) {
    return Metadata{{"Software", "a test"}, {"Settings", settings}};
  };
  const Film::LayerKind kinds[] = {{Color(0)}};
  Film part(2 * Film::kTileSize, Film::kTileSize, 1, kinds);
  part.add(0, 0, {});
  Settings withPass;
  withPass.passes = {Pass::depth}, withPass.passName = PassName::underscore;
  for (const char* name : {"a.png", "b.png"}) {
    if (name[0] == 'b') PictureFiles(path(name), {}).write(film(2), settings_, kWords);
    PictureFiles(path(name), {}).write(part, withPass, wordsOf("passes=depth pass-name=underscore"));
    EXPECT_TRUE(exists(name[0] == 'a' ? "a_depth.exr" : "b.partial_depth.exr"));
    writeFile(path("kept"), readFile(path(name[0] == 'a' ? "a.png" : "b.partial.png")));
    std::filesystem::rename(path("kept"),
                            path(std::string(1, name[0]) + "_id.png"));  // a picture, not a pass
    PictureFiles(path(name), {}).write(film(2), settings_, wordsOf("defaults"));
  }
  for (const char* name : {"a_depth.exr", "b.partial.png", "b.partial_depth.exr"})
    EXPECT_FALSE(exists(name)) << name;
  for (const char* name : {"a.png", "b.png", "a_id.png", "b_id.png"}) EXPECT_TRUE(exists(name)) << name;
}

TEST_F(Fragment, WhatOnlyHasTheNameOfOneStays) {
  writeFile(path("a.partial.png"), "notes");
  write("b.partial.png", 2);             // whole
  write("c.bmp", 2), write("c.bmp", 1);  // without words
  write("d.png", 2), write("d.png", 1);  // what the scene is made of
  InputFiles inputs;
  inputs.noteNamed(path("d.partial.png"));
  for (const char* name : {"a.png", "b.png", "c.bmp"}) EXPECT_EQ(write(name, 2), name);
  PictureFiles files(path("d.png"), inputs);
  EXPECT_EQ(write(files, 2), "d.png");
  EXPECT_TRUE(files.removed().empty());
  for (const char* name : {"a.partial.png", "b.partial.png", "c.partial.bmp", "d.partial.png"})
    EXPECT_TRUE(exists(name)) << name;
}

TEST_F(Fragment, SaysThatItIsOne) {
  write("a.png", 1), write("b.png", 2);
  const auto incomplete = [&](const char* name) {
    for (const auto& [key, text] : readMetadata(path(name)))
      if (key == "Incomplete") return true;
    return false;
  };
  EXPECT_TRUE(incomplete("a.png"));
  EXPECT_FALSE(incomplete("b.png"));
}

// --- what counts as rendered ---

TEST_F(Fragment, OnlyAWholeFileCountsAsRendered) {
  const Size size{2 * Film::kTileSize, Film::kTileSize};
  for (const PictureFormat& format : pictureFormats()) {
    if (!format.encode) continue;
    const std::string name = "a" + std::string(format.suffixes[0]);
    write(name, 2);
    const Output output{path(name), -1, ""};
    const bool hasWords = !readMetadata(output.path).empty();
    EXPECT_EQ(isRendered(output, size, kWords), hasWords) << name;
    EXPECT_FALSE(isRendered(output, {size.width, size.height + 1}, kWords)) << name;
    const std::string bytes = readFile(output.path);
    for (const double part : {0.99, 0.9, 0.5}) {
      const auto length = static_cast<std::size_t>(part * static_cast<double>(bytes.size()));
      writeFile(output.path, bytes.substr(0, length));
      EXPECT_FALSE(isRendered(output, size, kWords)) << name << " " << part;
    }
  }
  write("b.png", 2);
  std::string bytes = readFile(path("b.png"));
  bytes[bytes.size() - 20] = static_cast<char>(bytes[bytes.size() - 20] ^ 1);  // among the pixels
  writeFile(path("b.png"), bytes);
  EXPECT_FALSE(isRendered({path("b.png"), -1, ""}, size, kWords));
}

TEST_F(OutputTest, WhatDoesNotChangeThePictureStaysOut) {
  for (const char* name : {"a.png", "a.exr"}) {
    render({{"threads", "1", {}}}, "a" + std::string(name));
    render(
        {{"threads", "2", {}}, {"time-limit", "1000", {}}, {"max-memory", "4000", {}}, {"accel", "none", {}}},
        "b" + std::string(name));
    EXPECT_EQ(readFile(folder_ / ("a" + std::string(name))), readFile(folder_ / ("b" + std::string(name))));
  }
}

TEST(CheckIsNoInput, NamesTheFileAndWhatToDo) {
  TRACE_NEEDS_LINKS();
  const Folder folder;
  writeFile(folder / "a.png", "x");
  std::filesystem::create_symlink("a.png", folder / "link.png");
  InputFiles inputs;
  inputs.noteRead(folder / "a.png", "x");
  inputs.noteNamed(folder / "none.png");
  for (const char* name : {"a.png", "./a.png", "link.png", "none.png", "./none.png"}) try {
      checkIsNoInput(folder / name, inputs);
      FAIL() << name;
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::usage);
      EXPECT_NE(std::string(error.what()).find("-o "), std::string::npos);
    }
  checkIsNoInput(folder / "b.png", inputs);
}

}  // namespace
}  // namespace trace::test
