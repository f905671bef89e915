// What an unfinished render leaves beside its picture.
#include "app/session/checkpoint.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>

#include "app/session/output.h"
#include "base/error.h"
#include "base/files/file.h"
#include "base/hash.h"
#include "support/films.h"
#include "support/folder.h"

namespace trace::test {
namespace {

class Checkpoints : public testing::Test {
 protected:
  static constexpr int kTiles = 3;
  static Film blank(int samples = 4) { return Film(kTiles * Film::kTileSize, Film::kTileSize, samples); }
  static Film film(int tiles, int samples = 4) {
    Film film = blank(samples);
    for (int i = 0; i < tiles; ++i) {
      const auto count = static_cast<std::size_t>(Film::kTileSize * Film::kTileSize);
      film.add(i, 0, {.area = film.tile(i), .colors = std::vector<Color>(count, Color(i + 1)), .layers = {}});
    }
    return film;
  }
  Checkpoint checkpoint(const char* scene = "one") const {
    return {folder_ / "out.png", {{"Software", "a test"}, {"Scene", scene}}, settings_};
  }
  bool exists(const char* name) const { return std::filesystem::exists(folder_ / name); }

  const Folder folder_;
  Settings settings_;
};

TEST_F(Checkpoints, GiveBackWhatWasThere) {
  checkpoint().save(film(2));
  Film back = blank();
  EXPECT_TRUE(checkpoint().load(back));
  EXPECT_EQ(back.picture(), film(2).picture());
  EXPECT_TRUE(back.has(1, 0));
  EXPECT_FALSE(back.has(2, 0));
  EXPECT_TRUE(checkpoint().exists());
  checkpoint().remove(film(1));
  EXPECT_TRUE(exists("out.png.checkpoint")) << "it holds more";
  checkpoint().remove(film(2));
  EXPECT_FALSE(exists("out.png.checkpoint"));
  EXPECT_FALSE(checkpoint().exists());
}

TEST_F(Checkpoints, OfAnotherPictureAreLeftAlone) {
  checkpoint("one").save(film(2));
  const std::string before = readFile(folder_ / "out.png.checkpoint");
  Checkpoint other = checkpoint("two");
  Film back = blank();
  EXPECT_FALSE(other.load(back));
  EXPECT_NE(other.whyNot().find("another picture: the scene has changed"), std::string::npos)
      << other.whyNot();
  settings_.depth = 9;
  settings_.fog = 0.1;
  Checkpoint deeper = checkpoint("one");
  EXPECT_FALSE(deeper.load(back));
  EXPECT_NE(deeper.whyNot().find("--depth, --fog differ"), std::string::npos) << deeper.whyNot();
  settings_ = {};
  EXPECT_EQ(back.picture(), blank().picture());
  other.save(film(3));
  EXPECT_EQ(readFile(folder_ / "out.png.checkpoint"), before);
  EXPECT_TRUE(exists("out.png.checkpoint-2"));
  checkpoint("two").remove(film(3));
  EXPECT_TRUE(exists("out.png.checkpoint"));
  EXPECT_FALSE(exists("out.png.checkpoint-2"));
}

TEST_F(Checkpoints, AreFoundWhereOneBeforeThemHasBeenTakenAway) {
  checkpoint("one").save(film(3));
  checkpoint("two").save(film(2));
  checkpoint("one").remove(film(3));
  ASSERT_FALSE(exists("out.png.checkpoint"));
  Film back = blank();
  EXPECT_TRUE(checkpoint("two").exists());
  EXPECT_TRUE(checkpoint("two").load(back));
  EXPECT_EQ(back.picture(), film(2).picture());
  checkpoint("two").remove(film(3));
  EXPECT_FALSE(exists("out.png.checkpoint-2"));
}

TEST_F(Checkpoints, OthersAreCountedAndTheNearestIsTold) {
  EXPECT_TRUE(checkpoint().others().empty());
  settings_.depth = 7, settings_.fog = 0.1;
  checkpoint().save(film(1));
  settings_ = {}, settings_.depth = 8;
  checkpoint().save(film(1));
  settings_ = {};
  checkpoint("two").save(film(1));
  writeFile(folder_ / "out.png.checkpoint-x", "is no checkpoint");
  Checkpoint own = checkpoint();
  EXPECT_EQ(own.others(),
            (std::vector<std::string>{folder_ / "out.png.checkpoint", folder_ / "out.png.checkpoint-2",
                                      folder_ / "out.png.checkpoint-3"}));
  Film back = blank();
  EXPECT_FALSE(own.load(back));
  EXPECT_EQ(own.whyNot(), (folder_ / "out.png.checkpoint-2") +
                              ": it is of another picture: --depth differs; 2 others lie there, too");
  own.save(film(1));
  EXPECT_EQ(own.path(), folder_ / "out.png.checkpoint-4");
  EXPECT_EQ(own.others().size(), 3u);
}

TEST_F(Checkpoints, OfASettingThatChangesSamplesIsAnother) {
  checkpoint().save(film(2));
  Film back = blank();
  settings_.depth = 7;
  EXPECT_FALSE(checkpoint().load(back));
  settings_ = {};
  settings_.exposure = 2, settings_.threads = 3;  // these concern what is made of the film
  EXPECT_TRUE(checkpoint().load(back));
}

TEST_F(Checkpoints, TakeMoreSamplesWhereTheyCanBeAdded) {
  Film more = blank(16);
  checkpoint().save(film(2));
  settings_.spp = 16;
  EXPECT_FALSE(checkpoint().load(more)) << "a grid of 16 has other places";
  settings_.sampling = SampleKind::sobol, settings_.spp = 4;
  checkpoint().save(film(2));
  settings_.spp = 16;
  Checkpoint enough = checkpoint();
  EXPECT_TRUE(enough.load(more));
  EXPECT_EQ(more.waves().back().end, 16);
}

TEST_F(Checkpoints, ServeFewerSamplesAsLongAsThereAreNoMore) {
  settings_.sampling = SampleKind::sobol, settings_.spp = 4;
  Film film = this->film(2);
  checkpoint().save(film);
  settings_.spp = 2;
  Film fewer = blank(2);
  EXPECT_TRUE(checkpoint().load(fewer));
  EXPECT_EQ(fewer.waves().back().end, 2);
  EXPECT_EQ(fewer.picture(), film.picture());
  for (std::size_t wave : {1u, 2u}) {
    const auto count =
        static_cast<std::size_t>(film.waves()[wave].count() * Film::kTileSize * Film::kTileSize);
    film.add(0, wave, {.area = film.tile(0), .colors = std::vector<Color>(count, Color(1)), .layers = {}});
  }
  settings_.spp = 4;
  checkpoint().save(film);
  settings_.spp = 2;
  Film tooFew = blank(2);
  Checkpoint refused = checkpoint();
  EXPECT_FALSE(refused.load(tooFew));
  EXPECT_NE(refused.whyNot().find("more samples a pixel than the 2"), std::string::npos) << refused.whyNot();
  EXPECT_EQ(tooFew.picture(), blank(2).picture());
}

TEST_F(Checkpoints, ThatAreDamagedAreLeftAlone) {
  checkpoint().save(film(2));
  const std::string name = folder_ / "out.png.checkpoint", whole = readFile(name);
  for (std::size_t length = 0; length < whole.size(); length += 1 + whole.size() / 40) {
    writeFile(name, whole.substr(0, length));
    Film back = blank();
    ASSERT_FALSE(checkpoint().load(back)) << length;
    ASSERT_EQ(back.picture(), blank().picture());
  }
  for (std::size_t at = 0; at < whole.size(); at += 1 + whole.size() / 40) {
    std::string changed = whole;
    changed[at] = static_cast<char>(changed[at] ^ 0x10);
    writeFile(name, changed);
    Film back = blank();
    if (!checkpoint().load(back))
      ASSERT_EQ(back.picture(), blank().picture()) << at;
    else
      ASSERT_EQ(back.picture(), film(2).picture()) << at;  // of how much is done, which is only told
  }
}

TEST_F(Checkpoints, ThatAreDamagedKeepNoneFromBeingWritten) {
  checkpoint().save(film(3));
  const std::string name = folder_ / "out.png.checkpoint";
  std::string bytes = readFile(name);
  bytes.back() = static_cast<char>(bytes.back() ^ 0x10);
  writeFile(name, bytes);
  Checkpoint own = checkpoint();
  Film back = blank();
  ASSERT_FALSE(own.load(back));
  EXPECT_TRUE(own.damaged());
  own.save(film(1));  // less than the damaged one held
  EXPECT_EQ(readFile(name), bytes);
  EXPECT_TRUE(checkpoint().load(back)) << "from the one beside it";
  EXPECT_EQ(back.picture(), film(1).picture());
  checkpoint().remove(film(3));
  EXPECT_FALSE(exists("out.png.checkpoint"));
  EXPECT_FALSE(exists("out.png.checkpoint-2"));
}

/// The bytes of a checkpoint with other lines or another film, and the hash of these: what an enemy writes.
std::string forged(std::string bytes, const std::string& done, const std::string& state) {
  const std::size_t at = bytes.find("Done: ");
  Hash hash;
  hash.add(state);
  return bytes.substr(0, at) + "Done: " + done + "\nHash: " + hexText(hash.value()) + "\n" + state;
}

TEST_F(Checkpoints, WhoseCountsAreForgedAreRefused) {
  checkpoint().save(film(2));
  const std::string name = folder_ / "out.png.checkpoint", whole = readFile(name);
  const std::string state = film(2).saved();
  Film back = blank();
  writeFile(name, forged(whole, "2", state));
  ASSERT_TRUE(checkpoint().load(back)) << "this is how they are forged";
  for (const char* done : {"1e300", "-1", "nan", "", " 2", "2 ", "0x2", "99999999999999999999"}) {
    writeFile(name, forged(whole, done, state));
    Checkpoint own = checkpoint();
    Film other = blank();
    EXPECT_FALSE(own.load(other)) << done;
    EXPECT_NE(own.whyNot().find("it is no checkpoint"), std::string::npos) << own.whyNot();
    own.save(film(1));
    EXPECT_TRUE(exists("out.png.checkpoint-2")) << done;
    std::filesystem::remove(folder_ / "out.png.checkpoint-2");
  }
  writeFile(name, forged(whole, "9000000000000000000", state));
  Checkpoint ahead = checkpoint();
  Film other = blank();
  EXPECT_FALSE(ahead.load(other));
  EXPECT_NE(ahead.whyNot().find("it has fewer samples than it says"), std::string::npos) << ahead.whyNot();
  EXPECT_EQ(other.picture(), blank().picture());
  ahead.save(film(1));
  EXPECT_TRUE(exists("out.png.checkpoint-2")) << "none is ahead of this one";
}

TEST_F(Checkpoints, OfAFilmThatIsForgedAreDamaged) {
  for (int kind = 0; kind < kFilmKinds; ++kind) {
    SCOPED_TRACE(filmKindName(kind));
    Film half = blankFilm(kind);
    renderPart(half, 2);
    Checkpoint(folder_ / "forged.png", {}, settings_).save(half);
    const std::string name = folder_ / "forged.png.checkpoint", whole = readFile(name);
    std::string state = half.saved();
    state[state.size() / 2 / 4 * 4 + 3] ^= 0x55;
    state.resize(state.size() - 1);
    writeFile(name, forged(whole, "1", state));
    Checkpoint own(folder_ / "forged.png", {}, settings_);
    Film back = blankFilm(kind);
    EXPECT_FALSE(own.load(back));
    EXPECT_TRUE(own.damaged()) << own.whyNot();
    EXPECT_EQ(back.samplesDone(), 0);
    own.save(half);
    EXPECT_TRUE(exists("forged.png.checkpoint-2")) << "beside it";
    own.remove(half);
  }
}

TEST_F(Checkpoints, OfAnotherProgramAreAnother) {
  const auto of = [&](const char* program) {
    return Checkpoint(folder_ / "out.png", {{"Software", "Trace 0.1.0"}, {"Scene", "one"}}, settings_,
                      program);
  };
  of("commit 2093372, sources 01").save(film(2));
  Film back = blank();
  Checkpoint other = of("commit 2093372+, sources 02");
  EXPECT_FALSE(other.load(back));
  EXPECT_NE(
      other.whyNot().find("another build of Trace wrote it (commit 2093372, sources 01; this one is commit "
                          "2093372+, sources 02)"),
      std::string::npos)
      << other.whyNot();
  other.save(film(1));
  EXPECT_TRUE(of("commit 2093372, sources 01").load(back)) << "each has its own";
  EXPECT_EQ(back.picture(), film(2).picture());
  EXPECT_NE(programText().find("sources "), std::string::npos);
  EXPECT_EQ(sources().size(), 16u);
}

TEST_F(Checkpoints, ThatAreNoOrdinaryFilesAreNotWaitedFor) {
  ASSERT_EQ(mkfifo((folder_ / "out.png.checkpoint").c_str(), 0600), 0);
  std::filesystem::create_directory(folder_ / "out.png.checkpoint-2");
  Checkpoint own = checkpoint();
  Film back = blank();
  EXPECT_FALSE(own.load(back));
  EXPECT_FALSE(own.exists());
  own.save(film(2));
  EXPECT_EQ(own.path(), folder_ / "out.png.checkpoint-3");
  EXPECT_TRUE(checkpoint().load(back));
}

TEST_F(Checkpoints, OfAnotherNoiseTargetSayWhyTheyDoNotServe) {
  settings_.noiseTarget = 0.02;
  checkpoint().save(film(2));
  settings_.noiseTarget = 0.01;
  Checkpoint tighter = checkpoint();
  Film back = blank();
  EXPECT_FALSE(tighter.load(back));
  EXPECT_NE(tighter.whyNot().find("--noise-target differs (pixels that reached the one target"),
            std::string::npos)
      << tighter.whyNot();
}

TEST_F(Checkpoints, OfAnotherProcessThatIsAheadIsKept) {
  Checkpoint slow = checkpoint(), quick = checkpoint();
  quick.save(film(3));
  slow.save(film(1));
  Film back = blank();
  EXPECT_TRUE(checkpoint().load(back));
  EXPECT_TRUE(back.has(2, 0));
}

TEST_F(Checkpoints, ThatCannotBeWrittenSayWhy) {
  Checkpoint nowhere(folder_ / "gone/out.png", {}, settings_);
  EXPECT_THROW(nowhere.save(film(1)), Error);
}

}  // namespace
}  // namespace trace::test
