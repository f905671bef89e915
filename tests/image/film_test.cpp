// What can be seen of a film while it is being made.
#include "image/film.h"

#include <gtest/gtest.h>

#include <vector>

namespace trace {
namespace {

TEST(Film, ShowsTilesThatAreDone) {
  const std::vector<Color> blank{Color(7)};
  Film film(Film::kTileSize + 5, 3, blank);
  ASSERT_EQ(film.tiles(), 2);
  ASSERT_EQ(film.layers(), 1u);
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x) film.set(x, y, {1, 2, 3}), film.set(0, x, y, Color(x));
  EXPECT_EQ(film.picture().at(0, 0), Color(0));
  EXPECT_EQ(film.layer(0).at(0, 0), Color(7));
  film.markDone(1);
  EXPECT_EQ(film.picture().at(Film::kTileSize - 1, 2), Color(0));
  EXPECT_EQ(film.layer(0).at(Film::kTileSize - 1, 2), Color(7));
  EXPECT_EQ(film.picture().at(Film::kTileSize, 0), Color(1, 2, 3));
  EXPECT_EQ(film.layer(0).at(Film::kTileSize + 4, 2), Color(Film::kTileSize + 4));
}

TEST(Film, IsNotCopiedOnceItIsComplete) {
  Film film(Film::kTileSize + 5, 3);
  for (int x = 0; x < film.width(); ++x) film.set(x, 1, Color(x));
  for (std::int64_t tile = 0; tile < film.tiles(); ++tile) {
    film.markDone(tile);
    film.withPicture([&](const Picture& one) {
      EXPECT_EQ(one, film.picture());
      film.withPicture([&](const Picture& other) { EXPECT_EQ(&one == &other, film.complete()); });
    });
  }
}

TEST(Film, KeepsNoLayersUnasked) { EXPECT_EQ(Film(4, 4).layers(), 0u); }

}  // namespace
}  // namespace trace
