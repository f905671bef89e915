// Saved films that somebody has forged: refused, or films like others.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "image/film/film.h"
#include "support/films.h"

namespace trace::test {
namespace {

/// Every film, broken at one place: half of a number, a word or eight bytes.
TEST(FilmBytes, OfAnybodyDoNoHarm) {
  for (int kind = 0; kind < kFilmKinds; ++kind) {
    SCOPED_TRACE(filmKindName(kind));
    Film half = blankFilm(kind);
    renderPart(half, kind == 5 ? 2 : 5);
    const std::string bytes = half.saved();
    Film whole = blankFilm(kind);
    whole.restore(bytes);
    EXPECT_EQ(whole.saved(), bytes);
    const std::size_t head = 5 * 4 + 4 + 4 * whole.waves().size();  // after it all that is taken is kept
    int taken = 0, refused = 0;
    const auto tryBytes = [&](const std::string& forged, std::size_t at) {
      Film film = blankFilm(kind);
      try {
        film.restore(forged);
      } catch (const std::runtime_error&) {
        ++refused;
        ASSERT_EQ(film.samplesDone(), 0) << at;
        return;
      }
      ++taken;
      const std::string again = film.saved();  // longer where a sum that is no number equals not even itself
      if (at >= head) {
        ASSERT_TRUE(again == forged || again.size() > forged.size()) << at;
      }
      if (taken % 16 != 0 && at >= head) return;  // most are other colours
      lookAtAll(film);
      renderRest(film);
      ASSERT_TRUE(film.complete()) << at;
      lookAtAll(film);
    };
    for (std::size_t at = 0; at < bytes.size(); ++at) {
      std::string changed = bytes;
      changed[at] = static_cast<char>(changed[at] ^ (at % 3 == 0 ? 0x01 : at % 3 == 1 ? 0x80 : 0xff));
      tryBytes(changed, at);
      const auto put = [&](const auto& value) {
        if (at % 4 != 0 || at + sizeof value > bytes.size()) return;
        std::string forged = bytes;
        std::memcpy(forged.data() + at, &value, sizeof value);
        tryBytes(forged, at);
      };
      for (const std::int32_t number : {-1, 16, 1 << 20, std::numeric_limits<std::int32_t>::max(),
                                        std::numeric_limits<std::int32_t>::min()})
        put(number);
      put(std::numeric_limits<std::int64_t>::max());
      put(std::numeric_limits<std::int64_t>::min());
      put(std::numeric_limits<double>::quiet_NaN());
      put(-1e300);
    }
    EXPECT_GT(taken, 100);  // colours
    EXPECT_GT(refused, 100);
  }
}

/// Of the finding: one corner of a pixel that is none of it, which was looked for beyond the end of the list.
TEST(FilmBytes, HoldTheCornersOfTheDividedPixels) {
  Film half = blankFilm(5);
  renderPart(half, 2);
  const std::string bytes = half.saved();
  const Corner middle{2, 2}, elsewhere{1, 1};
  int corners = 0;
  const auto refuses = [](const std::string& state) {
    Film film = blankFilm(5);
    EXPECT_THROW(film.restore(state), std::runtime_error);
  };
  for (std::size_t at = 0; at + sizeof middle <= bytes.size(); ++at) {
    if (std::memcmp(bytes.data() + at, &middle, sizeof middle) != 0) continue;
    std::string forged = bytes;
    std::memcpy(forged.data() + at, &elsewhere, sizeof elsewhere);
    ++corners;
    refuses(forged);
  }
  EXPECT_GT(corners, 3);
  Film deeper = Film(7, 5, 20, {}, 0, 4);
  deeper.divide({3, 0.1, {1, 0, 6, 5}, 0, 0});
  EXPECT_THROW(deeper.restore(bytes), std::runtime_error);
  Film next = blankFilm(5);
  renderPart(next, 2);
  next.add(0, 2, {.area = next.tile(0), .colors = {}, .layers = {}, .starts = std::vector<std::size_t>(17)});
  // Two levels ahead of others, as a tile may be while these are being saved.
  next.restore(next.saved());
  EXPECT_FALSE(next.has(0, 2));
  EXPECT_TRUE(next.has(0, 1));
}

}  // namespace
}  // namespace trace::test
