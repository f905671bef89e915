// Layers and parts of EXR files: which is shown, which a name chooses, and where its pixels lie.
#include "image/codecs/exr_layers.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <tuple>

#include "base/error.h"
#include "base/files/file.h"
#include "image/codecs/codec.h"
#include "image/codecs/openexr.h"
#include "image/codecs/picture_name.h"
#include "support/exr.h"
#include "support/folder.h"

namespace trace::exr_layers_test {
namespace {

using Names = std::vector<std::string>;

TEST(PictureNames, ALayerIsBehindAColon) {
  const auto split = [](const std::string& name) {
    const PictureName found = pictureName(name);
    return std::pair(found.file, found.layer);
  };
  EXPECT_EQ(split("a/b.exr:left.diffuse"), std::pair(std::string("a/b.exr"), std::string("left.diffuse")));
  EXPECT_EQ(split("A.EXR:Z"), std::pair(std::string("A.EXR"), std::string("Z")));
  for (const std::string whole : {"a.exr", "a.exr:", "a.png:left", "C:\\a.exr", ".exr:a", "a:b.exr", ""})
    EXPECT_EQ(split(whole), std::pair(whole, std::string())) << whole;
  EXPECT_EQ(pictureName("a.exr:left").of("b/c.exr"), "b/c.exr:left");
  EXPECT_EQ(pictureName("a.exr").of("b/c.exr"), "b/c.exr");
  EXPECT_TRUE(pictureFormatNamed("a.exr:left"));
  EXPECT_THROW(pictureFormatFor("a.exr:left"), Error) << "it would be the file's name";
}

const std::vector<ExrPart> kParts{
    {"beauty",
     {"A", "B", "G", "R", "Z", "view.Diffuse.A", "view.Diffuse.B", "view.Diffuse.G", "view.Diffuse.R",
      "view.id.V", "view.normal.X", "view.normal.Y", "view.normal.Z", "view.uv.U", "view.uv.V"}},
    {"shine", {"shine.B", "shine.G", "shine.R"}},
    {"chroma", {"BY", "RY", "Y"}},
    {"odd", {"m.a", "m.b"}}};

TEST(ExrLayers, AreChosenByName) {
  const std::tuple<const char*, std::size_t, Names> kRows[] = {
      {"", 0, {"R", "G", "B", "A"}},
      {"beauty", 0, {"R", "G", "B", "A"}},
      {"Z", 0, {"Z"}},
      {"z", 0, {"Z"}},
      {"beauty.Z", 0, {"Z"}},
      {"view.Diffuse", 0, {"view.Diffuse.R", "view.Diffuse.G", "view.Diffuse.B", "view.Diffuse.A"}},
      {"diffuse", 0, {"view.Diffuse.R", "view.Diffuse.G", "view.Diffuse.B", "view.Diffuse.A"}},
      {"view.Diffuse.G", 0, {"view.Diffuse.G"}},
      {"view.normal", 0, {"view.normal.X", "view.normal.Y", "view.normal.Z"}},
      {"view.uv", 0, {"view.uv.U", "view.uv.V", ""}},
      {"view.id", 0, {"view.id.V"}},
      {"shine", 1, {"shine.R", "shine.G", "shine.B"}},
      {"SHINE", 1, {"shine.R", "shine.G", "shine.B"}},
      {"chroma", 2, {"R", "G", "B"}},
      {"odd", 3, {"m.a"}},
      {"odd.m", 3, {"m.a"}}};
  for (const auto& [layer, part, shown] : kRows) {
    const ShownChannels found = shownChannels(kParts, layer);
    EXPECT_EQ(found.part, part) << layer;
    EXPECT_EQ(found.shown, shown) << layer;
    EXPECT_EQ(found.isChroma, part == 2) << layer;
  }
}

TEST(ExrLayers, WhatIsNotShownIsListed) {
  const std::string remark = shownChannels(kParts, "").remark;
  EXPECT_EQ(remark,
            "its layers are not shown: view.Diffuse, view.id, view.normal, view.uv; channels that are not "
            "shown: Z; only the first of its parts is shown, and not: shine, chroma, odd; a name behind a "
            "colon chooses one, as in file.exr:view.Diffuse");
  EXPECT_EQ(shownChannels(kParts, "view.normal").remark, "");
  EXPECT_EQ(shownChannels(kParts, "beauty").remark, "") << "it was chosen";
  EXPECT_EQ(shownChannels(kParts, "odd.m").remark, "of its channels only \"m.a\" is shown, as a grey");
  EXPECT_EQ(shownChannels({{"", {"left.B", "left.G", "left.R"}}}, "").remark, "") << "it is all there is";
  EXPECT_EQ(
      shownChannels({{"", {"left.Y", "right.Y"}}}, "").remark,
      "the layer \"left\" is shown, and others are not: right; a name behind a colon chooses one, as in "
      "file.exr:right");
}

TEST(ExrLayers, AnUnknownNameIsAnErrorThatListsThem) {
  try {
    decodePicture(test::layeredExr(), "a.exr:shien");
    ADD_FAILURE();
  } catch (const Error& error) {
    const std::string what = error.messages().front().what;
    EXPECT_EQ(
        what,
        "cannot read \"a.exr:shien\" as EXR: expected one of its layers, beauty, shine, left, B, G, R, Z; "
        "found \"shien\"; did you mean \"shine\"?");
  }
  const std::string png = encodePicture(pictureFormatFor("a.png"), Picture(1, 1));
  EXPECT_THROW(decodePicture(png, "a.exr:left"), Error) << "only EXR has layers";
}

TEST(ExrLayers, AreReadFromTheirPlaceInTheFile) {
  const std::string file = test::layeredExr();
  const auto first = [&](const std::string& name) { return decodePicture(file, name).at(1, 1); };
  EXPECT_EQ(first("a.exr"), Color(1, 0, 0));
  EXPECT_EQ(first("a.exr:left"), Color(2, 0, 0));
  EXPECT_EQ(first("a.exr:shine"), Color(3, 0, 0));
  EXPECT_EQ(first("a.exr:Z"), Color(9));
  const test::Folder folder;
  writeFile(folder / "a.exr", file);
  EXPECT_EQ(readPicture(folder / "a.exr:left").at(0, 0), Color(2, 0, 0));
}

// --- parts that OpenEXR wrote ------------------------------------------------------------------------------

struct PartKind {
  bool tiled;
  Imf::Compression compression = Imf::ZIP_COMPRESSION;
  Imf::LevelMode levels = Imf::ONE_LEVEL;
  Imf::LevelRoundingMode rounding = Imf::ROUND_DOWN;
};
constexpr PartKind kKinds[] = {{false, Imf::NO_COMPRESSION},
                               {false, Imf::ZIPS_COMPRESSION},
                               {false, Imf::ZIP_COMPRESSION},
                               {false, Imf::PIZ_COMPRESSION},
                               {false, Imf::DWAB_COMPRESSION},
                               {true},
                               {true, Imf::RLE_COMPRESSION, Imf::MIPMAP_LEVELS, Imf::ROUND_DOWN},
                               {true, Imf::ZIP_COMPRESSION, Imf::MIPMAP_LEVELS, Imf::ROUND_UP},
                               {true, Imf::ZIP_COMPRESSION, Imf::RIPMAP_LEVELS, Imf::ROUND_DOWN},
                               {true, Imf::ZIP_COMPRESSION, Imf::RIPMAP_LEVELS, Imf::ROUND_UP}};

/// Parts "a", "b" ... of one grey each, 1, 2 ..., which the library wrote.
std::string partsByOpenExr(const std::vector<PartKind>& kinds, int width, int height) {
  const test::Folder folder;
  const std::string path = folder / "parts.exr";
  std::vector<Imf::Header> headers;
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    Imf::Header header(width, height);
    header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
    header.compression() = kinds[i].compression;
    header.setName(std::string(1, static_cast<char>('a' + i)));
    header.setType(kinds[i].tiled ? Imf::TILEDIMAGE : Imf::SCANLINEIMAGE);
    if (kinds[i].tiled)
      header.setTileDescription(Imf::TileDescription(5, 3, kinds[i].levels, kinds[i].rounding));
    headers.push_back(header);
  }
  {
    Imf::MultiPartOutputFile file(path.c_str(), headers.data(), static_cast<int>(headers.size()));
    for (std::size_t i = 0; i < kinds.size(); ++i) {
      std::vector<float> values(static_cast<std::size_t>(width * height), static_cast<float>(i + 1));
      Imf::FrameBuffer frame;
      frame.insert("Y", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()), sizeof(float),
                                   sizeof(float) * static_cast<std::size_t>(width)));
      const int part = static_cast<int>(i);
      if (kinds[i].tiled) {
        Imf::TiledOutputPart tiles(file, part);
        tiles.setFrameBuffer(frame);
        for (int y = 0; y < tiles.numYLevels(); ++y)
          for (int x = 0; x < tiles.numXLevels(); ++x)
            if (tiles.isValidLevel(x, y))
              tiles.writeTiles(0, tiles.numXTiles(x) - 1, 0, tiles.numYTiles(y) - 1, x, y);
      } else {
        Imf::OutputPart rows(file, part);
        rows.setFrameBuffer(frame);
        rows.writePixels(height);
      }
    }
  }
  return readFile(path);
}

TEST(ExrLayers, PartsOfEveryKindAreFoundBehindOthers) {
  for (const auto& [width, height] : {std::pair(13, 7), std::pair(7, 40), std::pair(1, 1)})
    for (const PartKind& before : kKinds)
      for (const PartKind& after : {kKinds[2], kKinds[7]}) {
        SCOPED_TRACE(std::to_string(width) + " " + std::to_string(&before - kKinds));
        const std::string file = partsByOpenExr({before, before, after}, width, height);
        for (int part = 0; part < 3; ++part) {
          const Picture picture = decodePicture(file, std::string("x.exr:") + static_cast<char>('a' + part));
          ASSERT_EQ(picture.width, width);
          for (const Color& c : picture.pixels) ASSERT_NEAR(c.g, part + 1, 0.01);  // DWAB loses bits
        }
      }
}

TEST(ExrLayers, DamageInAChosenPartIsRefusedAndElsewhereNeverCrashes) {
  const std::string whole = partsByOpenExr({kKinds[6], kKinds[2]}, 13, 7);
  for (std::size_t length = 0; length < whole.size(); ++length)
    EXPECT_THROW(decodePicture(whole.substr(0, length), "x.exr:b"), Error) << length;
  std::uint32_t state = 11;
  const auto random = [&] { return (state = state * 1664525u + 1013904223u) >> 8; };
  std::size_t refused = 0;
  for (int trial = 0; trial < 1500; ++trial) {
    std::string damaged = whole;
    for (std::uint32_t changes = 1 + random() % 3; changes > 0; --changes)
      damaged[random() % damaged.size()] = static_cast<char>(random());
    try {
      decodePicture(damaged, trial % 2 ? "x.exr:b" : "x.exr", {.memory = 1 << 24});
      pictureRemark(damaged, "x.exr");
    } catch (const Error& error) {
      EXPECT_FALSE(error.messages().empty());
      ++refused;
    }
  }
  EXPECT_GT(refused, 200u);
}

}  // namespace
}  // namespace trace::exr_layers_test
