// What a person may add to a scene, and its pictures.
#include "app/view/additions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "app/editing/swatches.h"

namespace trace::test {
namespace {

using Kind = Addition::Kind;

std::vector<Addition> everything() {
  std::vector<Addition> all;
  for (const Kind kind : {Kind::shape, Kind::light, Kind::material, Kind::texture})
    for (const Addition& each : additions(kind)) all.push_back(each);
  return all;
}

/// Some of its pixels differ: there is something to see.
bool shows(const Bytes& picture) {
  std::set<std::array<std::uint8_t, 3>> colours;
  for (std::size_t i = 0; i + 2 < picture.rgb.size(); i += 3)
    colours.insert({picture.rgb[i], picture.rgb[i + 1], picture.rgb[i + 2]});
  return colours.size() > 8;
}

TEST(Additions, HaveNamesAndHelp) {
  const std::vector<Addition> all = everything();
  EXPECT_GT(all.size(), 80u);
  for (const Addition& each : all) EXPECT_FALSE(each.name.empty() || each.help.empty()) << each.name;
  EXPECT_TRUE(std::none_of(all.begin(), all.end(), [](const Addition& a) { return a.name == "polymesh"; }));
}

TEST(Additions, AreFoundByTheirWords) {
  const Addition gold{Kind::material, "polished gold", "a Metal that shines"};
  EXPECT_TRUE(isAbout(gold, ""));
  EXPECT_TRUE(isAbout(gold, "GOLD"));
  EXPECT_TRUE(isAbout(gold, "metal  polish"));
  EXPECT_FALSE(isAbout(gold, "gold wood"));
}

TEST(Additions, HavePictures) {
  // What needs points, a file or a formula of its own has none yet.
  constexpr std::size_t kMostWithout = 16;
  std::string without;
  std::size_t count = 0;
  int materials = 0;
  for (const Addition& each : everything()) {
    if (each.kind == Kind::material && materials++ % 12 != 0) continue;
    const Bytes picture = preview(each, 24);
    if (picture.width == 24 && picture.height == 24 && shows(picture)) continue;
    EXPECT_NE(each.kind, Kind::material) << each.name;
    without += " " + std::string(each.name);
    ++count;
  }
  EXPECT_LE(count, kMostWithout) << without;
}

TEST(Additions, TexturesAreOfferedWithPictures) {
  std::set<std::string_view> names;
  for (const Addition& each : additions(Kind::texture)) names.insert(each.name);
  for (const char* name : {"checker", "gradient", "noise", "marble", "wood", "image"}) {
    EXPECT_TRUE(names.contains(name)) << name;
    EXPECT_TRUE(shows(preview({Kind::texture, name, {}}, 24))) << name;
  }
}

TEST(Additions, LightsThatNeedNoFileAreSeenInTheirPictures) {
  for (const char* name :
       {"ambient_light", "directional_light", "point_light", "rectangle_light", "spot_light"}) {
    const Bytes picture = preview({Kind::light, name, {}}, 24);
    double sum = 0;
    for (const std::uint8_t level : picture.rgb) sum += level;
    EXPECT_GT(sum / static_cast<double>(picture.rgb.size()), 40) << name;
  }
}

TEST(Swatches, AreColoursThatSurfacesMayHave) {
  for (const Swatch& swatch : kSwatches) {
    EXPECT_FALSE(swatch.name.empty());
    EXPECT_LT(maxComponent(swatch.color), 0.9) << swatch.name;
    EXPECT_GT(std::min({swatch.color.r, swatch.color.g, swatch.color.b}), 0) << swatch.name;
  }
}

}  // namespace
}  // namespace trace::test
