// ray diff and ray grade: what they print and their exit codes.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "app/compare/difference.h"
#include "image/codecs/codec.h"
#include "program.h"
#include "support/exr.h"

namespace trace::test {
namespace {

using nlohmann::json;

class Diff : public ProgramTest {
 protected:
  Diff() {
    picture("a.png", 0.5), picture("b.png", 0.5), picture("c.png", 0.6), picture("small.png", 0.5, 3);
    write("no.png", "no picture");
  }
  void picture(const std::string& name, double value, int width = 6) const {
    Picture p(width, 4);
    for (Color& c : p.pixels) c = Color(value);
    std::filesystem::create_directories(std::filesystem::path(path(name)).parent_path());
    writePicture(path(name), p);
  }
};

TEST_F(Diff, ExitCodes) {
  EXPECT_EQ(run({"diff", "a.png", "b.png"}).code, 0);
  EXPECT_EQ(run({"diff", "a.png", "c.png"}).code, 1);
  EXPECT_EQ(run({"diff", "a.png", "c.png", "--limit", "max=26"}).code, 0);
  EXPECT_EQ(run({"diff", "a.png", "c.png", "--tolerance", "26"}).code, 0);
  EXPECT_EQ(run({"diff", "a.png", "small.png"}).code, 2);
  for (const char* wrong : {"no.png", "nothing.png"}) {
    const Run r = run({"diff", "a.png", wrong});
    EXPECT_EQ(r.code, 2);
    EXPECT_TRUE(contains(r.err, std::string("cannot read \"") + wrong));
  }
  EXPECT_EQ(run({"diff", "a.png"}).code, 2);
}

TEST_F(Diff, ALayerIsChosenByNameAndOthersAreReported) {
  write("a.exr", layeredExr());
  const Run usual = run({"diff", "a.exr", "a.exr:left", "--print", "max"});
  EXPECT_EQ(usual.code, 1);
  EXPECT_EQ(usual.out, "1\n");
  EXPECT_TRUE(contains(usual.err, "warning: a.exr: its layers are not shown: left")) << usual.err;
  EXPECT_FALSE(contains(usual.err, "a.exr:left:")) << usual.err;
  EXPECT_EQ(run({"diff", "a.exr:left", "a.exr:left"}).code, 0);
  const Run unknown = run({"diff", "a.exr", "a.exr:right"});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_TRUE(contains(unknown.err, "expected one of its layers, beauty, shine, left")) << unknown.err;
  EXPECT_TRUE(contains(run({"diff", "a.exr:left", "a.exr", "-o", "a.exr"}).err, "are the same file"));
}

TEST_F(Diff, DoesNotWriteOverWhatItReads) {
  const std::string before = readFile(path("c.png"));
  const Run r = run({"diff", "a.png", "c.png", "-o", "./c.png"});
  EXPECT_EQ(r.code, 2);
  EXPECT_TRUE(contains(r.err, "are the same file"));
  EXPECT_EQ(readFile(path("c.png")), before);
}

TEST_F(Diff, ExitCodesOfIdiff) {
  const auto code = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"diff", "--idiff-codes", "a.png"});
    return run(words).code;
  };
  EXPECT_EQ(code({"b.png"}), 0);
  EXPECT_EQ(code({"c.png", "--limit", "max=26"}), 1);
  EXPECT_EQ(code({"c.png"}), 2);
  EXPECT_EQ(code({"small.png"}), 3);
  EXPECT_EQ(code({"no.png"}), 4);
}

TEST_F(Diff, SaysHowFarAndWritesThePicture) {
  const Run r = run({"diff", "a.png", "c.png", "-o", "d.png", "--show", "signed", "--magnify", "2"});
  EXPECT_TRUE(contains(r.out, "a.png and c.png differ (6x4)"));
  EXPECT_TRUE(contains(r.out, "max     26 levels at pixel 0,0: (127 127 127) and (153 153 153)"));
  EXPECT_TRUE(contains(r.err, "wrote d.png (signed)"));
  EXPECT_NEAR(readPicture(path("d.png")).at(0, 0).r, 0.5 + 26 / 255.0, 1.0 / 255);
  EXPECT_TRUE(contains(run({"diff", "a.png", "b.png"}).out, "are identical"));
  EXPECT_EQ(run({"diff", "a.png", "c.png", "--print", "max,pixels"}).out, "26 100\n");
  EXPECT_TRUE(
      contains(run({"diff", "a.png", "c.png", "--print", "maxx"}).err, "--print: expected one of max"));
}

TEST_F(Diff, MeansAreTold) {
  EXPECT_TRUE(
      contains(run({"diff", "a.png", "c.png"}).out, "means   (127 127 127) and (153 153 153) levels"));
  const json both = json::parse(run({"diff", "a.png", "c.png", "--format", "json"}).out)["means"];
  EXPECT_NEAR(both["reference"][0].get<double>(), 127, 1e-9);
  EXPECT_NEAR(both["test"][2].get<double>(), 153, 1e-9);
}

/// The picture of a scene of the repository, as our own renderer makes it.
class DiffCause : public Diff {
 protected:
  void render(const std::string& name, std::vector<std::string> options = {}) const {
    options.insert(options.begin(),
                   {sourceFolder() + "/scenes/materials.ray", "-o", name, "-w", "96", "--spp", "1"});
    const Run r = run(options);
    ASSERT_EQ(r.code, 0) << r.err;
  }
};

TEST_F(DiffCause, OfPixelsSampledAtTheirCornersIsAShiftOfHalfAPixel) {
  render("center.png", {"--pixel-position", "center"});
  render("corner.png", {"--pixel-position", "corner"});
  const Run r = run({"diff", "corner.png", "center.png"});
  EXPECT_EQ(r.code, 1);
  EXPECT_TRUE(contains(
      r.out, "cause   center.png is corner.png moved half a pixel to the left and half a pixel down"))
      << r.out;
  const json cause = json::parse(run({"diff", "corner.png", "center.png", "--format", "json"}).out)["cause"];
  EXPECT_EQ(cause["right"], -0.5);
  EXPECT_EQ(cause["down"], 0.5);
  EXPECT_EQ(cause["turn"], nullptr);
  EXPECT_EQ(cause["channels"], nullptr);
  EXPECT_EQ(cause["curve"], nullptr);
  EXPECT_TRUE(contains(cause["text"].get<std::string>(), "center.png is corner.png moved"));
}

TEST_F(DiffCause, IsNamedForWrongRenderersAndNotForOthers) {
  render("right.png");
  struct {
    std::vector<std::string> options;
    std::string cause;  // "" for none: the whole picture was not changed in one way
  } const cases[] = {
      {{"--pixel-position", "center"}, "moved half a pixel to the left and half a pixel down; apart"},
      {{"--pixel-position", "border"}, "moved half a pixel to the left and half a pixel down; apart"},
      {{"--transfer", "srgb"}, "encoded as sRGB; nothing else"},
      {{"--transfer", "srgb", "--pixel-position", "center"},
       "encoded as sRGB and moved half a pixel to the left and half a pixel down; apart"},
      {{"--exposure", "1"}, "with its values times 2; nothing else"},
      {{"--exposure", "-1"}, "with its values times 0.5; nothing else"},
      {{"--rounding", "nearest"}, ""},
      {{"--ambient-scale", "0"}, ""},
      {{"--highlight", "phong"}, ""},
      {{"--shininess-scale", "4"}, ""},
      {{"--depth", "0"}, ""},
      {{"--tone", "filmic"}, ""},
      {{"--tone", "agx"}, ""},
      {{"--white-balance", "3200"}, ""},
  };
  for (const auto& [options, cause] : cases) {
    SCOPED_TRACE(options[0] + " " + options[1]);
    render("wrong.png", options);
    const std::string out = run({"diff", "right.png", "wrong.png"}).out;
    if (cause.empty()) {
      EXPECT_FALSE(contains(out, "cause")) << out;
    } else {
      EXPECT_TRUE(contains(out, "cause   wrong.png is right.png " + cause)) << out;
    }
  }
}

TEST_F(DiffCause, IsNamedInTextAndJsonAndByGrade) {
  render("right.png");
  Picture right = readPicture(path("right.png")), wrong = right;
  for (int y = 0; y < right.height; ++y)
    for (int x = 0; x < right.width; ++x) {
      const Color& c = right.at(x, right.height - 1 - y);
      wrong.at(x, y) = Color(c.b, c.g, c.r);
    }
  writePicture(path("wrong.png"), wrong);
  const Run r = run({"diff", "right.png", "wrong.png"});
  EXPECT_EQ(r.code, 1) << "a cause is no excuse";
  EXPECT_TRUE(
      contains(r.out,
               "\n  cause   wrong.png is right.png upside down and with red and blue exchanged; nothing "
               "else differs"))
      << r.out;
  const json both = json::parse(run({"diff", "right.png", "wrong.png", "--format", "json"}).out);
  EXPECT_EQ(both["cause"]["turn"], "upside down");
  EXPECT_EQ(both["cause"]["channels"], "BGR");
  EXPECT_EQ(both["cause"]["factor"], 1);
  EXPECT_EQ(both["cause"]["rmse"], 0);
  EXPECT_EQ(json::parse(run({"diff", "right.png", "a.png", "--format", "json"}).out)["cause"], nullptr);
  EXPECT_FALSE(contains(run({"diff", "right.png", "right.png"}).out, "cause"));

  for (const char* folder : {"ref", "out"}) std::filesystem::create_directories(path(folder));
  writePicture(path("ref/x.png"), right);
  writePicture(path("out/x.png"), wrong);
  const Run graded = run({"grade", "out", "--reference", "ref", "-o", "page.html"});
  const std::string cause = "the picture is the reference upside down and with red and blue exchanged";
  EXPECT_TRUE(contains(graded.out, "\nx.png: " + cause)) << graded.out;
  EXPECT_TRUE(contains(readFile(path("page.html")), cause));
}

TEST_F(DiffCause, OfSizesThatAreExchangedIsATurn) {
  render("wide.png");
  const Picture wide = readPicture(path("wide.png"));
  Picture tall(wide.height, wide.width);
  for (int y = 0; y < tall.height; ++y)
    for (int x = 0; x < tall.width; ++x) tall.at(x, y) = wide.at(y, x);
  writePicture(path("tall.png"), tall);
  const Run r = run({"diff", "wide.png", "tall.png"});
  EXPECT_EQ(r.code, 2);
  EXPECT_TRUE(
      contains(r.out, "differ in size\n  cause   tall.png is wide.png with rows and columns exchanged"))
      << r.out;
}

TEST_F(Diff, LevelsBesideLightGetAWarning) {
  picture("light.exr", 0.5);
  const Run mixed = run({"diff", "light.exr", "a.png"});
  EXPECT_TRUE(contains(mixed.err, "a.png has levels of a screen, clipped at 1, and light.exr light"))
      << mixed.err;
  EXPECT_TRUE(contains(mixed.out, "values"));
  EXPECT_EQ(run({"diff", "light.exr", "light.exr"}).err, "");
}

TEST_F(Diff, Json) {
  const json same = json::parse(run({"diff", "a.png", "b.png", "--format", "json"}).out);
  EXPECT_EQ(same["identical"], true);
  EXPECT_EQ(same["psnr"], nullptr);
  const json far = json::parse(run({"diff", "a.png", "c.png", "--format", "json", "--limit", "rmse=1"}).out);
  EXPECT_EQ(far["max"], 26);
  EXPECT_EQ(far["within"], false);
  EXPECT_EQ(far["limits"][0]["metric"], "rmse");
  EXPECT_EQ(json::parse(run({"diff", "a.png", "small.png", "--format", "json"}).out)["sameSize"], false);
}

TEST_F(Diff, Grade) {
  picture("ref/a.png", 0.5), picture("out/a.png", 0.5), picture("ref/b.png", 0.5), picture("out/b.png", 0.7);
  Run r = run({"grade", "out", "--reference", "ref", "-o", "page.html"});
  EXPECT_EQ(r.code, 6);
  EXPECT_TRUE(contains(r.out, "1 of 2 within the limits"));
  EXPECT_TRUE(exists("page.html"));
  EXPECT_LT(r.out.find("b.png"), r.out.find("a.png"));
  r = run({"grade", "out", "--reference", "ref", "--limit", "max=100", "--format", "json"});
  EXPECT_EQ(r.code, 0);
  EXPECT_EQ(json::parse(r.out)["pairs"][0]["verdict"], "within");
  EXPECT_EQ(run({"grade", "out", "--reference", "ref", "-o", "b.html", "--format", "svg"}).code, 2);
  EXPECT_FALSE(exists("b.html"));
  EXPECT_EQ(run({"grade", "out"}).code, 2);
  EXPECT_EQ(run({"grade", "nowhere", "--reference", "ref"}).code, 1);
}

TEST_F(Diff, GradeKeepsItsColumnsApart) {
  const std::string name = "ref/a_name_that_is_longer_than_others.png";
  picture(name, 0.1), picture("out/" + name.substr(4), 0.6), picture("ref/b.png", 0.5),
      picture("out/b.png", 0.5);
  write("out/c.png", "no picture"), picture("ref/c.png", 0.5);
  writePicture(path("ref/d.exr"), Picture(2, 2));
  Picture bright(2, 2);
  for (Color& c : bright.pixels) c = Color(1.2345e30);
  writePicture(path("out/d.exr"), bright);
  const Run r = run({"grade", "out", "--reference", "ref"});
  EXPECT_EQ(r.code, 6);
  std::istringstream text(r.out);
  std::string line;
  for (int row = 0; row < 5 && std::getline(text, line); ++row) {
    std::istringstream words(line);
    std::vector<std::string> all;
    for (std::string word; words >> word;) all.push_back(word);
    EXPECT_EQ(all.size(), line.starts_with("unreadable") ? 2u : 2 + metrics().size()) << r.out;
  }
  EXPECT_TRUE(contains(r.out, "\nc.png: ")) << "why it is unreadable stands below the table\n" << r.out;
}

TEST_F(Diff, GradeRendersScenes) {
  std::filesystem::create_directories(path("scenes"));
  std::filesystem::copy(path("white.ray"), path("scenes/white.ray"));
  picture("ref/white.png", 1);
  const Run r = run({"grade", "scenes", "--reference", "ref", "--render", "-w", "6", "--height", "4"});
  EXPECT_EQ(r.code, 0) << r.out << r.err;
}

TEST_F(Diff, GradeSaysWhatIsWrongWithEachScene) {
  std::filesystem::create_directories(path("scenes"));
  write("scenes/garbled.ray", "no scene at all");
  write("scenes/garbled.mtl", "no scene either");
  write("scenes/broken.ray", "SBT-raytracer 1.0\nsphere {");
  write("scenes/alone.ray", kWhite);
  ASSERT_EQ(::mkfifo(path("scenes/pipe.ray").c_str(), 0600), 0);
  std::filesystem::create_symlink("/dev/zero", path("scenes/zero.ray"));
  for (const char* name : {"garbled", "broken", "pipe", "zero", "none"})
    picture(std::string("ref/") + name + ".png", 1);
  const Run r = run({"grade", "scenes", "--reference", "ref", "--render", "-w", "6", "--height", "4"});
  EXPECT_EQ(r.code, 6) << r.err;
  EXPECT_TRUE(contains(
      r.out,
      "\ngarbled.png: cannot be read: scenes/garbled.ray:1:1: error: expected Trace 1 on the first line"));
  EXPECT_TRUE(contains(r.out, "\nbroken.png: cannot be read: scenes/broken.ray:2:"));
  EXPECT_TRUE(contains(r.out, "\npipe.png: \"scenes/pipe.ray\" is not a file\n"));
  EXPECT_TRUE(contains(r.out, "\nzero.png: \"scenes/zero.ray\" is not a file\n"));
  EXPECT_TRUE(contains(r.out, "\nalone.ray: has no reference\n"));
  EXPECT_TRUE(contains(r.out, "\nmissing     none.png\n"));
  for (const char* name : {"garbled", "broken", "pipe", "zero"})
    EXPECT_TRUE(contains(r.out, std::string("\nunreadable  ") + name + ".png\n"));
}

TEST_F(Diff, GradeOfAClassWritesAPageAndATable) {
  picture("ref/a.png", 0.5), picture("in/ann/deep/A.bmp", 0.5), picture("in/bob/a.png", 0.7);
  const std::vector<std::string> words{"grade", "--class", "in", "--reference", "ref"};
  EXPECT_TRUE(contains(run(words).out, "2 students, 1 scene, 1 points\n"));
  std::vector<std::string> written = words;
  written.insert(written.end(), {"-o", "class.html"});
  const Run r = run(written);
  EXPECT_EQ(r.code, 6);
  EXPECT_TRUE(contains(r.last, "wrote class.html and class.csv (2 pictures, 2 compared now)"));
  EXPECT_TRUE(contains(readFile(path("class.csv")), "\r\nann,1,1,1,identical,"));
  const std::string page = readFile(path("class.html"));
  EXPECT_TRUE(contains(run(written).last, "0 compared now"));
  EXPECT_EQ(readFile(path("class.html")), page);
  EXPECT_EQ(run({"grade", "in", "--reference", "ref", "--rubric", "x"}).code, 2);
  EXPECT_EQ(run({"grade", "--class", "in", "--reference", "ref", "-o", "x.csv"}).code, 2);
}

TEST_F(Diff, GradeReadsNoPipesAndDevices) {
  for (const char* name : {"a", "b", "c"}) picture(std::string("ref/") + name + ".png", 1);
  picture("out/extra.png", 1), picture("out/d.png", 1);
  ASSERT_EQ(::mkfifo(path("out/a.png").c_str(), 0600), 0);
  std::filesystem::create_symlink("/dev/zero", path("out/b.png"));
  ASSERT_EQ(::mkfifo(path("ref/d.png").c_str(), 0600), 0);
  const Run r = run({"grade", "out", "--reference", "ref"});
  EXPECT_EQ(r.code, 6) << r.err;
  EXPECT_TRUE(contains(r.out, "\na.png: \"out/a.png\" is not a file\n"));
  EXPECT_TRUE(contains(r.out, "\nb.png: \"out/b.png\" is not a file\n"));
  EXPECT_TRUE(contains(r.out, "\nd.png: \"ref/d.png\" is not a file\n"));
  EXPECT_TRUE(contains(r.out, "\nextra.png: has no reference\n"));
  EXPECT_TRUE(contains(r.out, "\nmissing     c.png\n"));
}

TEST_F(DiffCause, TheSceneSaysWhatAProgramDidDifferently) {
  render("right.png");
  render("wrong.png", {"--highlight", "phong"});
  const std::string scene = sourceFolder() + "/scenes/materials.ray";
  const std::vector<std::string> words{"diff", "right.png", "wrong.png", "--scene", scene, "--spp", "1"};
  const Run r = run(words);
  EXPECT_EQ(r.code, 1) << r.err;
  EXPECT_TRUE(contains(r.out, "\n  scene   wrong.png is what " + scene +
                                  " gives with --highlight phong; nothing else differs beyond rounding"));
  std::vector<std::string> asJson = words;
  asJson.insert(asJson.end(), {"--format", "json"});
  const json found = json::parse(run(asJson).out)["scene"];
  EXPECT_EQ(found["test"]["text"], "with --highlight phong");
  EXPECT_EQ(found["test"]["rmse"], 0);
  EXPECT_EQ(found["reference"]["variants"].size(), 0u);
  EXPECT_EQ(found["stopped"], nullptr);
  EXPECT_EQ(found["tried"], found["variants"]);

  EXPECT_TRUE(contains(run({"diff", "right.png", "wrong.png", "--spp", "1"}).err, "expected --scene SCENE"));
  for (const char* other : {"right.png", "wrong.png"}) {
    const Run broken = run({"diff", "right.png", other, "--scene", "no.ray"});
    EXPECT_EQ(broken.code, 2) << other;
    EXPECT_TRUE(contains(broken.err, "no.ray"));
  }
  EXPECT_TRUE(contains(run({"diff", "right.png", "wrong.png", "--scene", "right.png", "-o", "right.png"}).err,
                       "same"));
}

TEST_F(DiffCause, WhatIsPlainToSeeIsSaidInPlaceOfASearch) {
  render("right.png");
  const Picture right = readPicture(path("right.png"));
  const std::string scene = sourceFolder() + "/scenes/materials.ray";
  const auto said = [&](const Picture& wrong) {
    writePicture(path("wrong.png"), wrong);
    return run({"diff", "right.png", "wrong.png", "--scene", scene, "--progress", "none"}).out;
  };
  const std::string black = said(Picture(right.width, right.height));
  EXPECT_TRUE(contains(black, "\n  note    wrong.png is black: all its pixels are 0\n")) << black;
  EXPECT_TRUE(
      contains(black, "\n  scene   not compared with " + scene + ": a picture has one colour only\n"));
  const std::string small = said(Picture(9, 7));
  EXPECT_TRUE(contains(small, "\n  scene   not compared with " + scene + ": ")) << small;
  Picture other(right.width / 2, right.height);
  for (std::size_t i = 0; i < other.pixels.size(); ++i) other.pixels[i] = Color(0.001 * (i % 999));
  EXPECT_TRUE(contains(said(other), ": the sizes differ\n"));
}

TEST_F(DiffCause, AChangeThatLeavesMuchIsTheNearest) {
  render("right.png");
  Picture wrong = readPicture(path("right.png"));
  for (int y = 0; y < wrong.height; ++y)
    for (int x = 0; x < wrong.width; ++x) {
      Color& c = wrong.at(x, y);
      c = c * ((x + y) % 2 == 0 ? 0.6 : 0.9);
    }
  writePicture(path("wrong.png"), wrong);
  const std::string text = run({"diff", "right.png", "wrong.png"}).out;
  EXPECT_TRUE(contains(
      text,
      "\n  nearest wrong.png is most like right.png with its values times 0.74; apart from that, RMSE "))
      << text;
  const json found = json::parse(run({"diff", "right.png", "wrong.png", "--format", "json"}).out);
  EXPECT_EQ(found["cause"], nullptr);
  EXPECT_NEAR(found["nearest"]["factor"].get<double>(), 0.74, 0.02);
}

}  // namespace
}  // namespace trace::test
