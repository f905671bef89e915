// Parts of a film, as several machines render them, are together the film of one.
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/films.h"

namespace trace::test {
namespace {

constexpr int kDivided = 5, kAdaptive = 3;

/// The share of a film, rendered to its end. Pixels of an adaptive film ask those beside them, which a render
/// looks at (tests/cli/parts_test.cpp), and this does not.
std::string shareOf(int kind, const TileShare& share) {
  Film film = blankFilm(kind);
  film.limitTo(share);
  for (std::size_t wave = 0; wave < film.waves().size(); ++wave)
    for (std::int64_t tile = 0; tile < film.tiles(); ++tile)
      if (film.owns(tile)) renderWave(film, tile, wave);
  EXPECT_TRUE(film.complete());
  return film.saved();
}

TEST(FilmMerge, InAnyOrderHasTheBitsOfTheWhole) {
  for (int kind = 0; kind < kFilmKinds; ++kind) {
    if (kind == kDivided || kind == kAdaptive) continue;
    SCOPED_TRACE(filmKindName(kind));
    Film whole = blankFilm(kind);
    renderRest(whole);
    const int tiles = static_cast<int>(whole.tiles());
    for (int count = 1; count <= tiles; ++count) {
      std::vector<int> order;
      for (int i = 0; i < count; ++i) order.push_back(i);
      do {
        Film film = blankFilm(kind);
        for (const int number : order) {
          EXPECT_FALSE(film.complete());
          film.merge(shareOf(kind, {number, count}), {number, count});
        }
        EXPECT_TRUE(film.complete());
        ASSERT_EQ(film.saved(), whole.saved()) << count;
      } while (std::next_permutation(order.begin(), order.end()));
    }
  }
}

TEST(FilmMerge, EachTileIsOfOneShareAndSharesAreEven) {
  for (const int width : {1, 31, 32, 33, 200, 320})
    for (const int count : {1, 2, 3, 5, 7, 10}) {
      Film film(width, 300);
      if (count > film.tiles()) continue;
      std::int64_t sum = 0, least = film.tiles(), most = 0;
      for (int number = 0; number < count; ++number) {
        film.limitTo({number, count});
        sum += film.ownTiles();
        least = std::min(least, film.ownTiles());
        most = std::max(most, film.ownTiles());
      }
      EXPECT_EQ(sum, film.tiles()) << width << " " << count;
      EXPECT_LE(most - least, 1) << width << " " << count;
    }
}

TEST(FilmMerge, RefusesWhatIsNotThePart) {
  const auto refused = [](const std::string& bytes, const TileShare& share, int kind = 4) {
    Film film = blankFilm(kind);
    try {
      film.merge(bytes, share);
    } catch (const std::runtime_error&) {
      return film.samplesDone() == 0;
    }
    return false;
  };
  const TileShare first{0, 2}, second{1, 2};
  EXPECT_FALSE(refused(shareOf(4, first), first));
  EXPECT_TRUE(refused(shareOf(4, first), second)) << "other tiles";
  EXPECT_TRUE(refused(shareOf(4, first), {1, 3}));
  EXPECT_TRUE(refused(shareOf(0, first), first)) << "no splats";
  Film half = blankFilm(4);
  half.limitTo(first);
  for (std::int64_t tile = 0; tile < half.tiles(); ++tile)
    if (half.owns(tile)) renderWave(half, tile, 0);
  EXPECT_TRUE(refused(half.saved(), first)) << "not finished";
  Film twice = blankFilm(0);
  twice.merge(shareOf(0, first), first);
  EXPECT_THROW(twice.merge(shareOf(0, first), first), std::runtime_error);
  EXPECT_EQ(twice.samplesDone(), 0);
  const std::string good = shareOf(4, first);
  for (std::size_t length = 0; length < good.size(); length += 7)
    ASSERT_TRUE(refused(good.substr(0, length), first)) << length;
  EXPECT_TRUE(refused(good + "x", first));
}

/// Any byte of a part changed: it is refused, or the film is one like others.
TEST(FilmMerge, BytesOfAnybodyDoNoHarm) {
  for (int kind = 0; kind < kDivided; ++kind) {
    SCOPED_TRACE(filmKindName(kind));
    const TileShare share{1, 3};
    const std::string good = shareOf(kind, share);
    int refused = 0, taken = 0;
    for (std::size_t at = 0; at < good.size(); ++at)
      for (const int bits : {0x01, 0x80, 0xff}) {
        std::string forged = good;
        forged[at] = static_cast<char>(forged[at] ^ bits);
        Film film = blankFilm(kind);
        try {
          film.merge(forged, share);
          ++taken;
          if (taken % 16 == 0) lookAtAll(film);
        } catch (const std::runtime_error&) {
          ++refused;
          ASSERT_EQ(film.samplesDone(), 0) << at;
        }
      }
    EXPECT_GT(taken, 100);
    EXPECT_GT(refused, 100);
  }
}

}  // namespace
}  // namespace trace::test
