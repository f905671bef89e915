// The program as a whole: what goes to which stream, exit codes, names of files.
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "cli/commands/commands.h"
#include "cli/flags.h"
#include "cli/text/statistics_text.h"
#include "image/codecs/codec.h"
#include "program.h"
#include "scene/options.h"
#include "support/paths.h"

namespace trace::test {
namespace {

using Cli = ProgramTest;
using nlohmann::json;

/// The paths of all values: "phases.read.wall", "badSamples.first[].x".
void addPaths(const json& value, const std::string& path, std::set<std::string>& paths) {
  if (value.is_object())
    for (const auto& [key, member] : value.items())
      addPaths(member, path.empty() ? key : path + "." + key, paths);
  else if (value.is_array())
    for (const json& member : value) addPaths(member, path + "[]", paths);
  else
    paths.insert(path);
}

/// The keys in the first column of the tables of a chapter of docs/statistics.md.
std::set<std::string> documentedKeys(const std::string& chapter) {
  const std::string page = readFile(test::sourceFolder() + "/docs/statistics.md");
  const std::size_t begin = page.find("\n## " + chapter + "\n");
  EXPECT_NE(begin, std::string::npos) << chapter;
  std::istringstream lines(page.substr(begin + 1, page.find("\n## ", begin + 1) - begin - 1));
  std::set<std::string> keys;
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("| `")) keys.insert(line.substr(3, line.find('`', 3) - 3));
  return keys;
}

TEST_F(Cli, CoursesLine) {
  const Run r = run({"-b", "-w", "40", "-r", "5", "-t", "1", "white.ray", "out.bmp"});
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_EQ(r.out, "");
  EXPECT_EQ(r.last.substr(0, 26), "wrote out.bmp (40x32) in 0") << r.err;
  const Picture picture = readPicture(path("out.bmp"));
  EXPECT_EQ(picture.width, 40);
  EXPECT_EQ(picture.height, 32);
  EXPECT_EQ(picture.at(39, 31), Color(1));
  EXPECT_EQ(readFile(path("out.bmp")).substr(0, 2), "BM");
}

TEST_F(Cli, ChainsWarnWhereTheirBrightnessIsVague) {
  const auto warned = [&](const std::string& scene, const char* starts) {
    return run({scene, "out.png", "-w", "12", "--spp", "1", "--integrator", "mlt", "--chain-starts", starts})
        .err;
  };
  const std::string few = warned(sourceFolder() + "/scenes/door.ray", "2000");
  EXPECT_TRUE(contains(few, "how bright the whole picture is, is known to ")) << few;
  EXPECT_TRUE(contains(few, "% only (one standard error); --chain-starts ")) << few;
  writeFile(path("dark.ray"), "SBT-raytracer 1.0\nsphere {}\n");
  const std::string none = warned("dark.ray", "1000");
  EXPECT_TRUE(contains(none, "none of the first 1000 samples found light")) << none;
}

TEST_F(Cli, PassesLieBesideThePicture) {
  const Run r = run({"white.ray", "out.png", "-w", "8", "--passes", "depth,normal"});
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_TRUE(contains(r.last, "wrote out.png and the passes depth, normal (8x6) in ")) << r.err;
  EXPECT_TRUE(exists("out.png") && exists("out.depth.exr") && exists("out.normal.exr"));
  EXPECT_EQ(files(), 4u);
  EXPECT_TRUE(contains(run({"white.ray", "-w", "8", "--passes", "depht"}).err, "did you mean \"depth\"?"));
}

TEST_F(Cli, EachCommandNamesItsOwnFormats) {
  const auto said = [&](const std::string& command, const std::string& format) {
    std::vector<std::string> words{command, "white.ray", "--format", format};
    if (command == "explain") words.insert(words.end(), {"--pixel", "0,0"});
    const Run r = run(words);
    EXPECT_EQ(r.code, 2) << command;
    return r.err;
  };
  for (const char* command : {"info", "bench", "lint"})
    EXPECT_TRUE(contains(said(command, "svg"),
                         "ray " + std::string(command) + " --format: expected text | json, found \"svg\""));
  EXPECT_TRUE(contains(said("info", ""), "expected text | json, found \"\""));
  EXPECT_TRUE(contains(said("explain", "vsg"), "expected text | json | obj | svg | png, found \"vsg\""));
  EXPECT_TRUE(contains(said("explain", "vsg"), "did you mean \"svg\"?"));
}

TEST_F(Cli, CoursesFlagsAreOptions) {
  const auto settings = [&](std::vector<std::string> words) {
    words.insert(words.end(), {"white.ray", "-w", "8", "--stats=json"});
    const Run r = run(words);
    EXPECT_EQ(r.code, 0) << r.err;
    return json::parse(r.out)["settings"];
  };
  EXPECT_EQ(settings({}), json({{"width", "8"}}));
  EXPECT_EQ(settings({"-B"}), json({{"width", "8"}, {"accel", "none"}}));
  EXPECT_EQ(settings({"-B", "-b"}), json({{"width", "8"}}));
  EXPECT_EQ(settings({"-a", "-t", "2"}), json({{"width", "8"}, {"spp", "9"}, {"threads", "2"}}));
  EXPECT_EQ(settings({"-a", "-A", "-r2"}), json({{"width", "8"}, {"depth", "2"}}));
  EXPECT_EQ(settings({"--no-limit-attenuation"}), json({{"width", "8"}, {"limit-attenuation", "off"}}));
}

TEST_F(Cli, HelpGoesToStdout) {
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"-h"}, {"--help"}, {"help"}, {"white.ray", "-h"}}) {
    const Run r = run(words);
    EXPECT_EQ(r.code, 0);
    EXPECT_EQ(r.err, "");
    EXPECT_TRUE(contains(r.out, "ray -b -w 400 -r 5 -t 1 in.ray out.bmp"));
    EXPECT_FALSE(contains(r.out, "--shininess-scale"));
  }
  EXPECT_EQ(files(), 1u);
  const std::string common = run({"--help"}).out, ofRender = run({"help", "render"}).out;
  for (const char* name : {"quality", "spp", "denoise", "exposure", "time", "time-limit", "width"}) {
    EXPECT_TRUE(contains(common, "--" + std::string(name) + " ")) << name << ", which the tutorial uses";
    EXPECT_TRUE(contains(ofRender, "--" + std::string(name) + " ")) << name;
  }
  for (const char* rare : {"--dpi", "--relief", "--guides", "--sbatch", "--across"})
    EXPECT_FALSE(contains(common, rare)) << rare;
  EXPECT_TRUE(contains(common, "--frames A-B"));
  EXPECT_TRUE(contains(run({"stereogram", "--help"}).out, "--dpi N"));
  const std::string all = run({"--help", "all"}).out;
  EXPECT_EQ(all, run({"help", "all"}).out);
  for (const Option& option : options()) EXPECT_TRUE(contains(all, "--" + std::string(option.name)));
  EXPECT_TRUE(contains(run({"help", "rener"}).err, "did you mean \"render\"?"));
  EXPECT_TRUE(contains(run({"help", "all", "odd"}).err, "found \"odd\""));
  EXPECT_EQ(run({"--version"}).out.substr(0, 6), "Trace ");
}

TEST_F(Cli, ErrorsBeyondThoseShownAreNotDenied) {
  std::string errors = "SBT-raytracer 1.0\n";
  for (int i = 0; i < 50000; ++i) errors += "sphere { material = { diffuse = 1 1 } }\n";
  write("many.ray", errors);
  const Run many = run({"many.ray"});
  EXPECT_EQ(many.code, 3);
  EXPECT_EQ(many.last, "nothing written: the scene has at least 20 errors");
  EXPECT_TRUE(contains(many.err, "\n... and perhaps more: reading ends at the 20th error\n"));
  write("few.ray",
        "SBT-raytracer 1.0\nsphere { material = { diffuse = 1 1 } }\nsphere { material = { diffuse = 1 1 } "
        "}\n");
  const Run few = run({"few.ray"});
  EXPECT_EQ(few.last, "nothing written: the scene has 2 errors");
  EXPECT_EQ(few.err.find("perhaps more"), std::string::npos);
}

TEST_F(Cli, EachCommandHasItsOwnHelp) {
  for (const cli::Command& command : cli::commands()) {
    const std::string name(command.name);
    if (name == "help") continue;
    const Run r = run({name, "--help"});
    EXPECT_EQ(r.code, 0) << name;
    EXPECT_EQ(r.err, "");
    EXPECT_TRUE(contains(r.out, std::string(command.arguments)));
    EXPECT_EQ(r.out.find("As in the courses"), std::string::npos) << name << " prints the page of all";
    EXPECT_EQ(run({"help", name}).out, r.out);
    EXPECT_EQ(run({name, "-h"}).out, r.out);
    EXPECT_EQ(run({"help", name, "all"}).out, run({name, "--help", "all"}).out);
    for (const cli::Flag& flag : cli::flags()) {
      if (flag.name == "output") {
        EXPECT_EQ(flag.commands.has(command.verb), !command.output.empty()) << name << " says what -o names";
      }
      const bool told = r.out.find("--" + std::string(flag.name)) != std::string::npos;
      EXPECT_TRUE(told || !flag.commands.has(command.verb)) << name << " " << flag.name;
    }
    const std::string all = run({name, "--help", "all"}).out;
    for (const Option& option : options()) {
      const bool told = all.find("--" + std::string(option.name) + " ") != std::string::npos;
      EXPECT_EQ(told, cli::takesOption(command.verb, option)) << name << " " << option.name;
    }
    EXPECT_EQ(&cli::commandOf(command.verb), &command) << name;
  }
  EXPECT_TRUE(contains(run({"explain", "--help"}).out, "--pixel X,Y"));
  EXPECT_EQ(run({"explain", "--help"}).out.find("--tolerance"), std::string::npos);
  EXPECT_FALSE(contains(run({"lint", "--help"}).out, "--shininess-scale"));
  EXPECT_TRUE(contains(run({"lint", "--help", "all"}).out, "--shininess-scale"));
  EXPECT_TRUE(contains(run({"help", "lint", "explain"}).err, "found \"explain\""));
  EXPECT_EQ(files(), 1u);
}

TEST_F(Cli, AloneWithoutAStudioTellsWhatToType) {
  std::filesystem::create_directory(path("bin"));
  std::filesystem::copy(test::rayProgram(), path("bin/ray"));  // with no ray-studio beside it
  write("scene.ray", kWhite);                                  // it would write one, and render it
  const int status = std::system(("cd " + folder() + " && bin/ray >o 2>e").c_str());
  EXPECT_EQ(WEXITSTATUS(status), 2);
  EXPECT_EQ(readFile(path("o")), "");
  const std::string said = readFile(path("e"));
  for (const char* part : {"usage: ray SCENE", "--help", "./dev studio", "was not built"})
    EXPECT_TRUE(contains(said, part));
}

TEST_F(Cli, QuietShowsErrorsOnly) {
  write("odd.ray", std::string(kWhite) + "wood {}\n");
  for (const char* flag : {"-q", "--quiet"}) {
    const Run r = run({"odd.ray", "-w", "8", flag, "out.png"});
    EXPECT_EQ(r.code, 0);
    EXPECT_EQ(r.out + r.err, "");
    EXPECT_TRUE(exists("out.png"));
    std::filesystem::remove(path("out.png"));
  }
  EXPECT_EQ(run({"odd.ray", "-w", "4", "-q", "--frames", "0-1"}).err, "");
  EXPECT_EQ(run({"odd.ray", "-w", "4", "-q", "--frames", "0-1"}).err, "") << "they are already there";
  EXPECT_EQ(run({"convert", "odd.ray", "b.ray", "-q"}).err, "");
  EXPECT_TRUE(contains(run({"nowhere.ray", "-q"}).err, "cannot read \"nowhere.ray\""));
  EXPECT_TRUE(contains(run({"odd.ray", "-q", "--strict"}).err, "wood"));
  const Run limited =
      run({"odd.ray", "-w", "1000", "--spp", "65536", "-q", "--time-limit", "0.5", "part.png"});
  EXPECT_EQ(limited.code, 5);
  EXPECT_TRUE(contains(limited.err, "stopped by the time limit")) << "a part is not what was asked for";
}

TEST_F(Cli, OneSideOfThePictureKeepsTheScenesShape) {
  write("sized.ray", std::string(kWhite) + "settings { width = 80; height = 60; }\n");
  const auto size = [&](std::vector<std::string> words) {
    words.insert(words.begin(), "sized.ray");
    return json::parse(run([&] {
                         words.insert(words.begin(), "info"), words.insert(words.end(), {"--format", "json"});
                         return words;
                       }())
                           .out)["picture"];
  };
  EXPECT_EQ(size({}), json({{"width", 80}, {"height", 60}}));
  EXPECT_EQ(size({"-w", "24"}), json({{"width", 24}, {"height", 18}}));
  EXPECT_EQ(size({"--height", "30"}), json({{"width", 40}, {"height", 30}}));
  EXPECT_EQ(size({"-w", "24", "--height", "24"}), json({{"width", 24}, {"height", 24}}));
  const Run r = run({"sized.ray", "-w", "24"});
  EXPECT_TRUE(contains(r.last, "(24x18)"));
  EXPECT_TRUE(contains(run({"white.ray", "--height", "40"}).last, "(50x40)")) << "the camera's shape";
}

TEST_F(Cli, GuiIsTheStudio) {  // without a display, or without the studio: an error that says so
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"gui"}, {"gui", "white.ray", "-w", "20"}}) {
    const Run r = run(words, {{"DISPLAY", ""}, {"WAYLAND_DISPLAY", ""}});
    const bool built = r.err.find("was not built") == std::string::npos;
    EXPECT_EQ(r.code, 1) << r.err;
    EXPECT_TRUE(contains(r.err, built ? "display" : "./dev studio"));
    EXPECT_EQ(r.out, "");
  }
  EXPECT_EQ(run({"gui", "white.ray", "b.ray"}).code, 2);
  EXPECT_EQ(run({"gui", "-w", "wide"}).code, 2);
}

TEST_F(Cli, AGridSaysThatItTakesASquareNumberOfSamples) {
  EXPECT_TRUE(
      contains(run({"white.ray", "a.png", "-w", "8", "--spp", "7"}).err,
               "takes 9 samples a pixel, the next square after 7; --sampling sobol takes any number"));
  for (const char* fits : {"--spp=9", "--spp=1"})
    EXPECT_FALSE(contains(run({"white.ray", "a.png", "-w", "8", fits}).err, "the next square"));
  EXPECT_FALSE(contains(run({"white.ray", "a.png", "-w", "8", "--spp", "7", "--sampling", "sobol"}).err,
                        "the next square"));
}

TEST_F(Cli, WrongUsageIs2) {
  const auto refused = [&](std::vector<std::string> words, const std::string& why) {
    const Run r = run(std::move(words));
    EXPECT_EQ(r.code, 2) << r.err;
    EXPECT_EQ(r.out, "");
    EXPECT_TRUE(contains(r.err, why));
    EXPECT_EQ(r.last.substr(0, 17), "nothing written: ");
  };
  refused({"--widht", "40", "white.ray"}, "did you mean \"--width\"?");
  refused({"--widht=40", "white.ray"}, "unknown flag \"--widht\"");
  refused({"--gamma", "white.ray"}, "did you mean \"--transfer\"?");
  refused({"--preview", "white.ray"}, "did you mean \"--quality\"?");
  refused({"--out=a.png", "white.ray"}, "did you mean \"--output\"?");
  refused({"--verbose", "white.ray"}, "--log-level debug says more");
  refused({"-x", "white.ray"}, "unknown flag \"-x\"");
  refused({"-5", "white.ray"}, "unknown flag \"-5\"");
  refused({"--markdown", "white.ray"}, "it belongs to: convert, texture, features");
  refused({"white.ray", "-w", "-5"}, "expected a whole number from 1 to 100000 pixels, found \"-5\"");
  refused({"white.ray", "--width="}, "expected a value after");
  refused({"white.ray", "-w"}, "expected a value after");
  refused({"white.ray", "--accel", "bhv"}, "did you mean \"bvh\"?");
  refused({"white.ray", "--strict=on"}, "takes no value");
  refused({"white.ray", "--set", "width"}, "expected name=value");
  refused({"white.ray", "--set", "widht=3"}, "did you mean \"width\"?");
  refused({"white.ray", "--enable", "width"}, "expected one of");
  refused({"white.ray", "--without", "aperturr"}, "did you mean \"aperture\"?");
  refused({"white.ray", "--progress=yes"}, "expected auto | bar | plain | json | none");
  refused({"white.ray", "a.png", "b.png"}, "found also \"b.png\"");
  refused({"white.ray", "a.png", "-o", "b.png"}, "two names");
  refused({"white.ray", "out.gif"}, ".png");
  refused({"white.ray", "white.ray"}, ".png");
  refused({"white.ray", "--region", "400,0,500,10"}, "outside the picture of 400 x 320 pixels");
  refused({"+W640", "+H480", "white.ray"}, "flags begin with -");
  refused({"--strict"}, "expected the name of a scene");
  refused({"white.ray", "--width", "1000000000", "--height", "1000000000"}, "from 1 to 100000");
  EXPECT_EQ(run({"white.ray"}, {{"RAY_THREADS", "many"}}).code, 2);
  EXPECT_EQ(files(), 1u);
}

TEST_F(Cli, WhatIsReadIsNotWrittenOver) {
  const std::string before = readFile(path("white.ray"));
  for (std::vector<std::string> words :
       {std::vector<std::string>{"lint"}, {"explain", "--pixel", "3,3", "--format", "text"}}) {
    words.insert(words.end(), {"white.ray", "-o", "./white.ray"});
    const Run r = run(words);
    EXPECT_EQ(r.code, 2) << words[0];
    EXPECT_TRUE(contains(r.err, "are the same file")) << r.err;
    EXPECT_EQ(readFile(path("white.ray")), before);
  }
}

TEST_F(Cli, WhatIsWrongIsSaidOnce) {
  const Run r = run({"white.ray", "-o", "x.xyz"});
  EXPECT_TRUE(contains(r.err, "error: the name of a picture ends in")) << r.err;
  EXPECT_EQ(r.last, "nothing written: the command cannot be followed");
}

TEST_F(Cli, ARegionThatGoesBeyondThePictureIsTold) {
  const Run r = run({"white.ray", "-w", "20", "--height", "10", "--region", "5,2,400,9"});
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_TRUE(contains(r.err,
                       "warning: the region 5,2,400,9 goes beyond the picture of 20 x 10 pixels: 5,2,20,9 is "
                       "rendered"))
      << r.err;
  const Run whole = run({"white.ray", "-w", "20", "--height", "10", "--region", "5,2,20,10"});
  EXPECT_FALSE(contains(whole.err, "warning")) << whole.err;
}

TEST_F(Cli, AnEmptyRegionIsToldToBeTheWholePicture) {
  const Run r = run({"white.ray", "-w", "10", "--region", "0,0,0,0"});
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_TRUE(contains(r.err, "--region 0,0,0,0 has no pixel in it: all of the picture is rendered"))
      << r.err;
}

TEST_F(Cli, MissingFileIs1) {
  const Run r = run({"no.ray"});
  EXPECT_EQ(r.code, 1);
  EXPECT_TRUE(contains(r.err, "no.ray"));
  EXPECT_TRUE(contains(r.last, "nothing written: "));
  EXPECT_TRUE(contains(run({"ifno"}).err, "did you mean the command \"ray info\"?"));
  const Run two = run({"benhc", "white.ray"});
  EXPECT_EQ(two.code, 1);
  EXPECT_TRUE(contains(two.err, "did you mean the command \"ray bench\"?"));
}

TEST_F(Cli, SceneErrorIs3) {
  write("wrong.ray", "SBT-raytracer 1.0\nsphere { material = }\n");
  const Run r = run({"wrong.ray"});
  EXPECT_EQ(r.code, 3);
  EXPECT_EQ(r.out, "");
  EXPECT_TRUE(contains(r.err, "wrong.ray:2:"));
  EXPECT_TRUE(contains(r.err, "^"));
  EXPECT_TRUE(contains(r.last, "nothing written: the scene has "));
  EXPECT_FALSE(exists("wrong.png"));
}

TEST_F(Cli, StrictMakesErrorsOfWarnings) {
  write("empty.ray", "SBT-raytracer 1.0\ndirectional_light { direction=(0,0,-1); color=(1,1,1); }\n");
  const Run lenient = run({"empty.ray", "-w", "8"});
  EXPECT_EQ(lenient.code, 0);
  EXPECT_TRUE(contains(lenient.err, "warning: "));
  EXPECT_EQ(run({"empty.ray", "-w", "8", "--log-level", "error"}).err.substr(0, 6), "wrote ");
  const Run strict = run({"empty.ray", "-w", "8", "--strict"});
  EXPECT_EQ(strict.code, 3);
  EXPECT_TRUE(contains(strict.err, "error: "));
}

TEST_F(Cli, AtMostTwentyWarnings) {
  std::string text = kWhite;
  for (int i = 0; i < 30; ++i)
    text += "sphere { wrong" + std::string(static_cast<size_t>(i + 1), 'x') + " = 1; }\n";
  write("many.ray", text);
  const Run r = run({"many.ray", "-w", "8"});
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_TRUE(contains(r.err, "... and 10 more warnings"));
}

TEST_F(Cli, LimitIs5) {
  const Run r = run({"white.ray", "--width", "100000", "--height", "100000"});
  EXPECT_EQ(r.code, 5) << r.err;
  EXPECT_TRUE(contains(r.err, "MiB"));
  EXPECT_EQ(run({"white.ray", "--max-memory", "1"}).code, 5);
  EXPECT_FALSE(exists("white.png"));
}

TEST_F(Cli, DefaultNameIsInTheCurrentFolder) {
  std::filesystem::create_directory(path("deep"));
  write("deep/other.scene.ray", kWhite);
  EXPECT_TRUE(contains(run({"deep/other.scene.ray", "-w", "8"}).last, "wrote other.scene.png (8x6)"));
  EXPECT_TRUE(exists("other.scene.png"));
}

TEST_F(Cli, NamesWithDashes) {
  write("-odd.ray", kWhite);
  EXPECT_EQ(run({"-w", "8", "-o", "-odd.png", "--", "-odd.ray"}).code, 0);
  EXPECT_TRUE(exists("-odd.png"));
  EXPECT_EQ(run({"-w", "8", "--", "-odd.ray", "--help"}).code, 2);  // a picture of no known kind
  write("info", kWhite);
  EXPECT_TRUE(contains(run({"render", "info", "-w", "8"}).last, "wrote info.png"));
}

TEST_F(Cli, OutputIsTriedBeforeRendering) {
  std::filesystem::create_directory(path("folder.png"));
  for (const char* name : {"white.ray/out.png", "folder.png", "absent/out.png"}) {
    const Run r = run({"white.ray", name, "--spp", "65536", "-w", "4000"});  // would take hours
    EXPECT_EQ(r.code, 1) << r.err;
    EXPECT_TRUE(contains(r.err, name));
  }
  EXPECT_EQ(files(), 2u);
}

TEST_F(Cli, SceneFileBelowCommandLine) {
  write("set.ray", std::string(kWhite) + "settings { width = 30; depth = 3; }\n");
  const auto width = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"set.ray", "--stats=json"});
    const Run r = run(words);
    EXPECT_EQ(r.code, 0) << r.err;
    return json::parse(r.out)["settings"].value("width", "400");
  };
  EXPECT_EQ(width({}), "30");
  EXPECT_EQ(width({"-w", "20"}), "20");
  EXPECT_EQ(width({"--set", "width=20", "--set", "width=21"}), "21");
  EXPECT_EQ(width({"--quick"}), "100");
  EXPECT_EQ(width({"-w", "22", "--quick"}), "22");
}

TEST_F(Cli, TheCoursesLineIsOneRayAPixelAndNoOtherStop) {
  write("set.ray",
        std::string(kWhite) +
            "settings { threshold = 0.3; spp = 9; noise-target = 0.1; subdivide = 2; denoise = on; }\n");
  const auto stats = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"set.ray", "-w", "20", "-r", "4", "-t", "1", "--stats=json"});
    const Run r = run(words);
    EXPECT_EQ(r.code, 0) << r.err;
    return json::parse(r.out);
  };
  const json line = stats({"-b"});
  EXPECT_EQ(line["rays"]["camera"], 20 * 16);
  for (const char* option : {"threshold", "spp", "noise-target", "subdivide", "denoise", "accel"})
    EXPECT_FALSE(line["settings"].contains(option)) << option;
  EXPECT_EQ(line["settings"]["depth"], "4");
  // What the line says itself holds, wherever it stands.
  for (const auto& words : {std::vector<std::string>{"-b", "-a"}, {"-a", "-b"}, {"--spp", "9", "-b"}})
    EXPECT_EQ(stats(words)["rays"]["camera"], 9 * 20 * 16) << words[0];
  EXPECT_EQ(stats({"--threshold", "0.25", "-b"})["settings"]["threshold"], "0.25");
  EXPECT_NE(stats({"-B"})["rays"]["camera"], 20 * 16) << "the scene's own";
}

TEST_F(Cli, QuickOverridesTheScene) {
  write("set.ray", std::string(kWhite) + "settings { width = 300; height = 300; depth = 9; spp = 16; }\n");
  const json stats = json::parse(run({"set.ray", "--quick", "--stats=json"}).out);
  EXPECT_EQ(stats["width"], 100);
  EXPECT_EQ(stats["height"], 80);
  EXPECT_EQ(stats["rays"]["camera"], 100 * 80);
  EXPECT_EQ(stats["settings"]["depth"], "2");
  for (const char* integrator : {"whitted", "path", "photon", "normals"}) {
    const Run quiet = run({"set.ray", "--quick", "--integrator", integrator});
    EXPECT_FALSE(contains(quiet.err, "changes nothing")) << quiet.err;
  }
}

TEST_F(Cli, Environment) {
  const auto threads = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"white.ray", "-w", "8", "--stats=json"});
    return json::parse(run(words, {{"RAY_THREADS", "3"}}).out)["threads"];
  };
  EXPECT_EQ(threads({}), 3);
  EXPECT_EQ(threads({"-t", "2"}), 2);
  EXPECT_TRUE(
      contains(run({"white.ray", "-w", "8"}, {{"RAY_LOG", "debug"}}).err, "option width = 8 (command line)"));
}

TEST_F(Cli, PrintDefaults) {
  const Run r = run({"--print-defaults"});
  EXPECT_EQ(r.code, 0);
  EXPECT_EQ(r.err, "");
  std::string expected;
  for (const Option& option : options())
    expected += std::string(option.name) + "=" + option.get(Settings{}) + "\n";
  EXPECT_EQ(r.out, expected);
}

TEST_F(Cli, StatisticsKeys) {
  const Run r = run({"white.ray", "out.png", "-w", "50", "-a", "--stats=json"});
  const json stats = json::parse(r.out);
  std::vector<std::string> keys;
  for (const auto& item : stats.items()) keys.push_back(item.key());
  EXPECT_EQ(keys, (std::vector<std::string>{"badSamples", "end",    "error",         "fraction", "height",
                                            "meanDepth",  "nodes",  "nodesPerRay",   "output",   "peakMemory",
                                            "phases",     "rays",   "raysPerSecond", "scene",    "seconds",
                                            "settings",   "shapes", "threads",       "version",  "width"}));
  EXPECT_EQ(stats["rays"]["camera"], 50 * 40 * 9);
  EXPECT_EQ(stats["shapes"]["sphere"]["hits"], 50 * 40 * 9);
  for (const char* phase : {"read", "build", "trace", "write"})
    EXPECT_GE(stats["phases"][phase]["wall"], 0) << phase;
  EXPECT_EQ(stats["meanDepth"], 0);
  EXPECT_EQ(stats["error"]["mean"], 0) << "a white picture";
  EXPECT_EQ(stats["end"], "finished");
  EXPECT_EQ(stats["output"], "out.png");
  EXPECT_GT(stats["peakMemory"], 1 << 20);

  const Run table = run({"white.ray", "out.png", "-w", "50", "--stats"});
  EXPECT_EQ(table.out, "");
  EXPECT_TRUE(contains(table.err, "Mrays/s"));
  EXPECT_TRUE(contains(table.last, "wrote out.png"));
}

TEST(Statistics, OfARenderThatBrokeOff) {
  Session session;
  session.open(Scene{}, Settings{});
  RenderResult result;
  result.end = End::failed;
  const json stats = json::parse(cli::statisticsJson({session, result, "out.png", 0.5, 1, 1}));
  EXPECT_EQ(stats["end"], "failed");
}

TEST_F(Cli, StatisticsKeysAreThoseOfTheDocs) {
  std::string hot = kWhite;  // has samples that are not finite
  hot.replace(hot.find("emissive=(1,1,1)"), 16, "emissive=(1.7e308,0,0); ambient=(1,1,1)");
  write("hot.ray", hot + "ambient_light { color=(1.7e308,0,0); }\n");
  std::set<std::string> paths;
  json stats = json::parse(run({"hot.ray", "-w", "8", "--stats=json"}).out);
  stats["shapes"] = {{"NAME", stats["shapes"]["sphere"]}};
  stats["settings"] = {{"NAME", stats["settings"]["width"]}};
  addPaths(stats, "", paths);
  EXPECT_EQ(paths, documentedKeys("JSON of a render"));

  json bench = json::parse(run({"bench", "white.ray", "-w", "8", "--format=json"}).out);
  for (const char* kind : {"primary", "bounce", "shadow"}) EXPECT_TRUE(bench["rays"].contains(kind)) << kind;
  bench["rays"] = {{"KIND", bench["rays"]["primary"]}};
  paths.clear();
  addPaths(bench, "", paths);
  EXPECT_EQ(paths, documentedKeys("JSON of ray bench"));
}

TEST_F(Cli, BadSamplesAreReported) {
  std::string text = kWhite;
  text.replace(text.find("emissive=(1,1,1)"), 16, "emissive=(1.7e308,0,0); ambient=(1,1,1)");
  write("hot.ray", text + "ambient_light { color=(1.7e308,0,0); }\n");
  const Run r = run({"hot.ray", "-w", "8", "--stats=json"});
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_TRUE(contains(r.err, "48 samples were not finite and left out; first at pixel 0,0"));
  EXPECT_EQ(json::parse(r.out)["badSamples"]["count"], 48);
}

TEST_F(Cli, Info) {
  const Run r = run({"info", "white.ray", "--like", "ut"});
  EXPECT_EQ(r.code, 0);
  EXPECT_EQ(r.err, "");
  EXPECT_TRUE(contains(r.out, "sphere"));
  EXPECT_TRUE(contains(r.out, "400 x 320 pixels"));
  EXPECT_TRUE(contains(r.out, "-10 -10 -10"));
  EXPECT_TRUE(contains(r.out, "command line, by like"));
  const json facts = json::parse(run({"info", "white.ray", "--format=json"}).out);
  EXPECT_EQ(facts["objects"], json({{"sphere", 1}}));
  EXPECT_EQ(facts["lights"], json({{"directional_light", 1}}));
  EXPECT_EQ(facts["picture"], json({{"width", 400}, {"height", 320}}));
  EXPECT_EQ(run({"info"}).code, 2);
  EXPECT_EQ(run({"info", "white.ray", "--stats"}).code, 2);
  EXPECT_EQ(files(), 1u);
}

TEST_F(Cli, Bench) {
  const Run r = run({"bench", "white.ray", "-w", "8"});
  EXPECT_EQ(r.code, 0);
  EXPECT_EQ(r.err, "");
  EXPECT_TRUE(contains(r.out, "Mrays/s"));
  const json facts = json::parse(run({"bench", "white.ray", "-w", "8", "--format=json"}).out);
  EXPECT_EQ(facts["triangles"], 0);
  EXPECT_EQ(facts["bytesPerTriangle"], nullptr);
  const json primary = facts["rays"]["primary"];
  EXPECT_EQ(primary["count"], facts["width"].get<int>() * facts["height"].get<int>());
  EXPECT_EQ(primary["hits"], primary["count"]);
  EXPECT_EQ(primary["testsPerRay"], 1);
  EXPECT_GT(primary["raysPerSecond"], 0);
  EXPECT_EQ(run({"bench"}).code, 2);
  EXPECT_EQ(files(), 1u);
  const Run huge = run({"bench", "white.ray", "-w", "100000"});
  EXPECT_EQ(huge.code, 5);
  EXPECT_TRUE(contains(huge.err, "MiB of memory"));
  write("odd.ray", std::string(kWhite) + "sphere { wrong = 1; }\n");
  EXPECT_TRUE(contains(run({"bench", "odd.ray", "-w", "8"}).err, "odd.ray:5:"));
}

TEST_F(Cli, WithoutSwitchesOffWhatTheSceneAsksFor) {
  write("blurred.ray",
        std::string(kWhite) + "settings { aperture = 0.1; fog = 0.5; switched-off = bump; }\n");
  const auto settings = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"blurred.ray", "-o", "out.png", "-w", "8", "--stats=json"});
    return json::parse(run(words).out)["settings"];
  };
  const json all = settings({});
  EXPECT_EQ(all["aperture"], "0.1");
  EXPECT_EQ(all["switched-off"], "bump");
  const json without = settings({"--without", "aperture", "--without=media", "--without", "Spot"});
  EXPECT_FALSE(without.contains("aperture")) << "it has its default";
  EXPECT_EQ(without["fog"], "0.5") << "it stays";
  EXPECT_EQ(without["switched-off"], "medium,spot_light") << "those of the command line add up";
  EXPECT_FALSE(settings({"--without", "spot", "--switched-off", "none"}).contains("switched-off"));
}

TEST_F(Cli, InfoTellsWhereOptionsComeFrom) {
  write("set.ray", std::string(kWhite) + "settings { like = ut; glass = per-crossing; }\n");
  const json facts = json::parse(run({"info", "set.ray", "--format=json", "--air-index", "1.5"}).out);
  std::map<std::string, std::string> from;
  for (const json& fact : facts["conventions"]) from[fact["name"]] = fact["from"];
  EXPECT_EQ(from["air-index"], "command line");
  EXPECT_TRUE(contains(from["glass"], "set.ray:5:"));
  EXPECT_FALSE(contains(from["glass"], "by like"));
  EXPECT_TRUE(contains(from["highlight"], "by like"));
}

TEST_F(Cli, Features) {
  const Run r = run({"features"});
  EXPECT_EQ(r.code, 0);
  EXPECT_EQ(r.err, "");
  for (const Option& option : options())
    if (option.extra) {
      EXPECT_TRUE(contains(r.out, "  " + std::string(option.name) + " "));
    }
  for (const PictureFormat& format : pictureFormats())
    EXPECT_TRUE(contains(r.out, std::string(format.suffixes[0])));
  EXPECT_TRUE(contains(r.out, "\n  goniometric_light  without it: a point light; scenes/studio-lights.ray\n"))
      << r.out;
}

TEST_F(Cli, OptionsPageIsUpToDate) {
  EXPECT_EQ(run({"features", "--markdown"}).out, readFile(test::sourceFolder() + "/docs/options.md"))
      << "run: ray features --markdown >docs/options.md";
}

TEST_F(Cli, FullDiskOfStdoutIs1) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const std::string command = test::rayProgram() + " features >/dev/full 2>/dev/null";
  EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 1);
}

}  // namespace
}  // namespace trace::test
