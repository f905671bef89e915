// Completions and manual pages: they know every flag of the tables, and the shells themselves understand
// them.
#include "cli/text/completion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <set>
#include <sstream>

#include "app/editing/studio_flags.h"
#include "cli/text/help_parts.h"
#include "cli/text/manual.h"
#include "program.h"

namespace trace::test {
namespace {

using namespace trace::cli;

using Words = std::set<std::string>;

bool isInstalled(const std::string& program) {
  return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

class Completions : public ProgramTest {
 protected:
  Completions() {
    write("ray.bash", completionScript("bash"));
    write("ray.zsh", completionScript("zsh"));
    write("ray.fish", completionScript("fish"));
    std::filesystem::create_directory(path("meshes"));
    write("teapot.obj.gz", "");
    write("notes.txt", "");
    write("white.png", "");
  }

  /// What the shell prints of a script, in the folder; its messages become failures.
  std::string printed(const std::string& shell, const std::string& script) const {
    write("script", script);
    std::string command = "cd '" + folder() + "' && HOME='" + folder() + "' " + shell + " script 2>messages";
    FILE* pipe = ::popen(command.c_str(), "r");
    std::string text;
    std::array<char, 4096> part;
    while (const std::size_t n = std::fread(part.data(), 1, part.size(), pipe)) text.append(part.data(), n);
    EXPECT_EQ(::pclose(pipe), 0);
    EXPECT_EQ(readFile(path("messages")), "");
    return text;
  }

  /// What bash offers for each command line, whose last word is being typed. Words stand in quotes as bash
  /// reads them.
  std::vector<Words> inBash(const std::vector<std::string>& lines) const {
    std::string script =
        "source ./ray.bash\n"
        "try() { COMP_WORDS=(\"$@\") COMP_CWORD=$(($# - 1)); _trace_ray; printf '%s\\t' \"${COMPREPLY[@]}\"; "
        "echo; }\n";
    for (const std::string& line : lines) script += "try " + line + "\n";
    std::istringstream answers(printed("bash --norc", script));
    std::vector<Words> all;
    for (std::string line; std::getline(answers, line);) {
      std::istringstream words(line);
      Words& offered = all.emplace_back();
      for (std::string word; std::getline(words, word, '\t');)
        if (!word.empty()) offered.insert(word);
    }
    EXPECT_EQ(all.size(), lines.size());
    all.resize(lines.size());
    return all;
  }
};

Words wordsOf(const std::vector<std::string>& words) { return {words.begin(), words.end()}; }

Words namesOf(const std::vector<FlagFace>& faces) {
  Words names;
  for (const FlagFace& face : faces) names.insert(face.names.begin(), face.names.end());
  return names;
}

TEST_F(Completions, EveryFlagOfEachCommandIsOfferedInBash) {
  std::vector<std::string> lines;
  for (const Command& command : commands()) lines.push_back("ray " + std::string(command.name) + " -");
  lines.push_back("ray-studio -");
  const std::vector<Words> offered = inBash(lines);
  for (std::size_t i = 0; i < commands().size(); ++i)
    EXPECT_EQ(offered[i], namesOf(flagFaces(commands()[i].verb))) << lines[i];
  EXPECT_EQ(offered.back(), namesOf(studioFlagFaces()));
  for (const Option& option : options()) {
    EXPECT_TRUE(offered.front().contains("--" + std::string(option.name))) << option.name;
    EXPECT_TRUE(offered.back().contains("--" + std::string(option.name))) << option.name;
  }
  for (const Flag& flag : flags())
    for (std::size_t i = 0; i < commands().size(); ++i) {
      const bool has = std::any_of(flags().begin(), flags().end(), [&](const Flag& other) {
        return other.name == flag.name && other.commands.has(commands()[i].verb);
      });
      EXPECT_EQ(offered[i].contains("--" + std::string(flag.name)), has)
          << flag.name << " of " << commands()[i].name;
    }
}

TEST_F(Completions, ValuesOfEnumerationsAreOfferedInBash) {
  std::vector<std::string> lines;
  std::vector<Words> expected;
  for (const Option& option : options()) {
    Words words = wordsOf({option.choices.begin(), option.choices.end()});
    if (option.kind == Option::Kind::boolean) words = {"on", "off"};
    if (option.kind == Option::Kind::choices) words.insert("none");
    if (words.empty()) continue;
    const std::string flag = "--" + std::string(option.name);
    if (option.kind != Option::Kind::boolean) {  // after which a scene may stand, too
      lines.push_back("ray white.ray " + flag + " ''");
      expected.push_back(words);
    }
    lines.push_back("ray info " + flag + " = ''");  // as bash takes --flag= apart
    expected.push_back(words);
    lines.push_back("ray-studio " + flag + " =");
    expected.push_back(words);
  }
  ASSERT_GT(lines.size(), 60u);
  const std::vector<Words> offered = inBash(lines);
  for (std::size_t i = 0; i < lines.size(); ++i) EXPECT_EQ(offered[i], expected[i]) << lines[i];
}

TEST_F(Completions, FilesAndWordsAreOfferedWhereTheyBelongInBash) {
  const std::vector<Words> offered =
      inBash({"ray ex", "ray ''", "ray explain ''", "ray diff ''", "ray grade ''", "ray white.ray -o n",
              "ray white.ray --passes depth,no", "ray --enable subd", "ray --set filt",
              "ray --set filter = mit", "ray info --stats", "ray materials red\\ pl", "ray texture marb",
              "ray help ex", "ray white.ray --width 1", "ray --progress = pl", "./ray-studio --reference ''",
              "ray-studio ex", "ray selftest ''"});
  EXPECT_EQ(offered[0], (Words{"explain", "expand"}));
  Words scenes{"white.ray", "teapot.obj.gz", "meshes"}, first = scenes;
  for (const Command& command : commands()) first.emplace(command.name);
  EXPECT_EQ(offered[1], first);
  EXPECT_EQ(offered[2], scenes);
  EXPECT_EQ(offered[3], (Words{"white.png", "meshes"}));
  EXPECT_EQ(offered[4], (Words{"meshes"}));
  EXPECT_EQ(offered[5], (Words{"notes.txt"}));
  EXPECT_EQ(offered[6], (Words{"depth,normal", "depth,none"}));
  EXPECT_EQ(offered[7], (Words{"subdivide"}));
  EXPECT_EQ(offered[8], (Words{"filter=", "filter-radius="}));
  EXPECT_EQ(offered[9], (Words{"mitchell"}));
  EXPECT_EQ(offered[10], Words{}) << "of ray render only";
  EXPECT_EQ(offered[11], (Words{"red\\ plastic"}));
  EXPECT_EQ(offered[12], (Words{"marble"}));
  EXPECT_EQ(offered[13], (Words{"explain", "expand"}));
  EXPECT_EQ(offered[14], Words{});
  EXPECT_EQ(offered[15], (Words{"plain"}));
  EXPECT_EQ(offered[16], (Words{"white.png", "meshes"}));
  EXPECT_EQ(offered[17], Words{}) << "the studio has no commands";
  EXPECT_EQ(offered[18], Words{});
}

TEST_F(Completions, BashCompletesAllNamesOfThePrograms) {
  const std::string text = printed(
      "bash --norc", "source ./ray.bash\nfor name in ray trace-ray ray-studio; do complete -p $name; done\n");
  EXPECT_EQ(
      text,
      "complete -F _trace_ray ray\ncomplete -F _trace_ray trace-ray\ncomplete -F _trace_ray ray-studio\n");
}

TEST_F(Completions, ZshReadsThem) {
  if (!isInstalled("zsh")) GTEST_SKIP() << "zsh is not installed";
  std::string script = "compdef() { print compdef $@ }\nsource ./ray.zsh\n";
  for (const Command& command : commands())
    script += "_trace_ray_flags_of " + std::string(command.name) + "; print -r -- ${flags%%\\[*}\n";
  std::istringstream lines(printed("zsh -f", script));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "compdef _trace_ray ray trace-ray ray-studio");
  for (const Command& command : commands()) {
    ASSERT_TRUE(std::getline(lines, line));
    std::istringstream words(line);
    Words known;
    for (std::string word; words >> word;) {
      while (word.ends_with('=') || word.ends_with('+')) word.pop_back();
      known.insert(word);
    }
    for (const FlagFace& face : flagFaces(command.verb))
      EXPECT_TRUE(known.contains(face.names.back())) << command.name << " " << face.names.back();
  }
}

TEST_F(Completions, FishOffersThem) {
  if (!isInstalled("fish")) GTEST_SKIP() << "fish is not installed";
  const auto offered = [&](const std::string& line) {
    std::istringstream lines(printed("fish --no-config", "source ray.fish; complete -C '" + line + "'\n"));
    Words words;
    for (std::string row; std::getline(lines, row);) words.insert(row.substr(0, row.find('\t')));
    return words;
  };
  Words flagsOffered = offered("ray explain -");
  for (const FlagFace& face : flagFaces(Verb::explain))
    EXPECT_TRUE(flagsOffered.contains(face.names.back())) << face.names.back();
  EXPECT_FALSE(flagsOffered.contains("--idiff-codes"));
  EXPECT_EQ(offered("trace-ray white.ray --accel "), (Words{"bvh", "none"}));
  EXPECT_EQ(offered("ray ex"), (Words{"explain", "expand"}));
  EXPECT_EQ(offered("ray lint "), (Words{"white.ray", "teapot.obj.gz", "meshes/"}));
  EXPECT_TRUE(offered("ray-studio --refer").contains("--reference"));
}

TEST(Manual, HasEveryCommandFlagAndOption) {
  const std::string page = manualPage("ray"), studio = manualPage("ray-studio");
  const auto minus = [](std::string_view text) {  // as roff has it
    std::string result;
    for (char c : text) result += (c == '-' ? "\\" : "") + std::string(1, c);
    return result;
  };
  const auto has = [&](const std::string& text, const std::string& label) {
    return text.find("\n\\fB" + minus(label) + "\\fR") != std::string::npos ||
           text.find(", \\fB" + minus(label) + "\\fR") != std::string::npos;
  };
  for (const Command& command : commands()) EXPECT_TRUE(has(page, usageOf(command))) << command.name;
  for (const Flag& flag : flags()) EXPECT_TRUE(has(page, "--" + std::string(flag.name))) << flag.name;
  for (const Option& option : options())
    for (const std::string& text : {page, studio}) EXPECT_TRUE(has(text, flagsOf(option))) << option.name;
  for (const StudioFlag& flag : kStudioFlags)
    EXPECT_TRUE(has(studio, (flag.letter ? "-h, --" : "--") + std::string(flag.name))) << flag.name;
  EXPECT_FALSE(has(page, "--no-such-flag"));
}

TEST_F(Completions, AreWrittenByFeatures) {
  for (const std::string_view shell : kShells) {
    const Run r = run({"features", "--completion", std::string(shell), "-o", "out"});
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_EQ(readFile(path("out")), completionScript(shell));
  }
  EXPECT_EQ(run({"features", "--man"}).out, manualPage("ray"));
  EXPECT_EQ(run({"features", "--man", "ray-studio"}).out, manualPage("ray-studio"));
  const Run wrong = run({"features", "--completion", "zhs"});
  EXPECT_EQ(wrong.code, 2);
  EXPECT_NE(wrong.err.find("did you mean \"zsh\"?"), std::string::npos) << wrong.err;
}

TEST_F(Completions, GroffFormatsTheManualWithoutAWarning) {
  if (!isInstalled("groff")) GTEST_SKIP() << "groff is not installed";
  for (const std::string_view program : kManuals) {
    write("page.1", manualPage(program));
    const std::string text = printed("sh", "groff -man -ww -Tutf8 -P-cbou page.1\n");
    EXPECT_NE(text.find("OPTIONS"), std::string::npos);
  }
}

}  // namespace
}  // namespace trace::test
