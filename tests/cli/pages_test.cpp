// The pages keep their word: links lead somewhere, the index names every page, the tutorial shows the scenes
// of its steps, and what the tutorial and the how-tos say to type works.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>

#include "program.h"

namespace trace::test {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = sourceFolder();
const fs::path kSteps = kRoot / "scenes/tutorial";

/// All pages of a folder and of those in it, sorted.
std::vector<fs::path> pagesBelow(const fs::path& folder) {
  std::vector<fs::path> found;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".md") found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<fs::path> allPages() {
  std::vector<fs::path> found = pagesBelow(kRoot / "docs");
  for (const auto& entry : fs::directory_iterator(kRoot))
    if (entry.path().extension() == ".md") found.push_back(entry.path());
  return found;
}

struct Page {
  std::string prose;                ///< without blocks of code
  std::vector<std::string> blocks;  ///< indented by four, without the indentation, in their order
};

Page pageOf(const fs::path& file) {
  Page page;
  std::istringstream lines(readFile(file));
  bool fenced = false, open = false, afterBlank = true;
  for (std::string line; std::getline(lines, line);) {
    const bool blank = line.find_first_not_of(' ') == line.npos;
    if (line.starts_with("```")) fenced = !fenced, open = false;
    const bool code = !fenced && !blank && line.starts_with("    ") && (open || afterBlank);
    if (code && !open) page.blocks.emplace_back();
    if (code) page.blocks.back() += line.substr(4) + "\n";
    if (blank && open) page.blocks.back() += "\n";
    if (!blank) open = code;
    if (!code && !fenced) page.prose += line + "\n";
    afterBlank = blank;
  }
  for (std::string& block : page.blocks) block.erase(block.find_last_not_of('\n') + 2);
  return page;
}

/// The name by which a link leads to a heading: lower case, blanks as dashes, no other signs.
std::string anchorOf(const std::string& heading) {
  std::string name;
  for (std::size_t i = 0; i < heading.size(); ++i) {
    const auto c = static_cast<unsigned char>(heading[i]);
    if (c == ']' && i + 1 < heading.size() && heading[i + 1] == '(')
      i = std::min(heading.find(')', i), heading.size() - 1);
    else if (std::isalnum(c) || c == '-' || c == '_' || c >= 0x80)
      name += static_cast<char>(std::tolower(c));
    else if (c == ' ')
      name += '-';
  }
  return name;
}

std::set<std::string> anchorsOf(const fs::path& file) {
  std::set<std::string> names;
  std::map<std::string, int> used;
  const std::string prose = pageOf(file).prose;
  std::istringstream lines(prose);
  for (std::string line; std::getline(lines, line);)
    if (const std::size_t depth = line.find_first_not_of('#');
        depth != line.npos && depth > 0 && line[depth] == ' ') {
      const std::string name = anchorOf(line.substr(depth + 1));
      const int before = used[name]++;
      names.insert(before ? name + "-" + std::to_string(before) : name);
    }
  const std::string mark = "<a name=\"";
  for (std::size_t at = prose.find(mark); at != prose.npos; at = prose.find(mark, at + 1))
    names.insert(prose.substr(at + mark.size(), prose.find('"', at + mark.size()) - at - mark.size()));
  return names;
}

/// Where the links and pictures of a page lead, as written.
std::vector<std::string> targetsOf(const std::string& prose) {
  std::vector<std::string> found;
  for (std::size_t at = prose.find("]("); at != prose.npos; at = prose.find("](", at + 1))
    found.push_back(prose.substr(at + 2, prose.find(')', at) - at - 2));
  return found;
}

TEST(Pages, EveryLinkLeadsToAFileOrAHeading) {
  std::size_t links = 0;
  for (const fs::path& page : allPages())
    for (const std::string& target : targetsOf(pageOf(page).prose)) {
      if (target.find(':') != target.npos) continue;  // on the web
      ++links;
      const std::string file = target.substr(0, target.find('#'));
      const fs::path to = file.empty() ? page : page.parent_path() / file;
      ASSERT_TRUE(fs::exists(to)) << page << ": " << target;
      if (target.find('#') == target.npos) continue;
      EXPECT_TRUE(anchorsOf(to).contains(target.substr(target.find('#') + 1))) << page << ": " << target;
    }
  EXPECT_GT(links, 500u);
}

TEST(Pages, TheIndexNamesEveryPage) {
  const fs::path docs = kRoot / "docs", index = docs / "index.md";
  std::set<fs::path> named;
  for (const std::string& target : targetsOf(pageOf(index).prose))
    named.insert((docs / target.substr(0, target.find('#'))).lexically_normal());
  for (const fs::path& page : pagesBelow(docs))
    if (page != index) {
      EXPECT_TRUE(named.contains(page.lexically_normal())) << "docs/index.md does not name " << page;
    }
}

TEST(Pages, NamesOfPagesInTheSourcesAreThere) {
  std::size_t names = 0;
  for (const char* folder : {"src", "tests", "scenes", "cmake", "editors", "bench"})
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder)) {
      const std::string suffix = entry.path().extension();
      if (suffix != ".cpp" && suffix != ".h" && suffix != ".ray" && suffix != ".sh" && suffix != ".md")
        continue;
      const std::string text = readFile(entry.path());
      for (std::size_t at = text.find("docs/"); at != text.npos; at = text.find("docs/", at + 1)) {
        std::size_t end = at;
        while (end < text.size() &&
               (std::isalnum(static_cast<unsigned char>(text[end])) || text[end] == '-' || text[end] == '/'))
          ++end;
        if (text.compare(end, 3, ".md") != 0) continue;
        ++names;
        const std::string name = text.substr(at, end + 3 - at);
        EXPECT_TRUE(fs::exists(kRoot / name)) << entry.path() << " names " << name;
      }
    }
  EXPECT_GT(names, 50u);
}

// --- the tutorial and the how-tos ---

/// The scene of a step: all but that with the pieces, which is included.
std::vector<fs::path> steps() {
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(kSteps))
    if (entry.path().filename() != "pieces.inc") found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  return found;
}

bool isCommand(const std::string& block) {
  const std::string start = block.substr(std::min(block.find_first_not_of(' '), block.size()));
  return start.starts_with("ray ") || start.starts_with("ffmpeg ");
}
bool isScene(const std::string& block) { return block.starts_with("Trace 1\n"); }

std::vector<std::string> wordsOf(const std::string& line) {
  std::istringstream in(line);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

TEST(Tutorial, ShowsTheSceneOfEachStep) {
  std::vector<std::string> shown;
  const std::string pieces = readFile(kSteps / "pieces.inc");
  for (const fs::path& page : pagesBelow(kRoot / "docs/tutorial"))
    for (const std::string& block : pageOf(page).blocks)
      if (isScene(block)) {
        shown.push_back(block);
      } else if (!isCommand(block)) {
        EXPECT_NE(pieces.find(block), pieces.npos) << page << " shows a piece that is not there:\n" << block;
      }
  const std::vector<fs::path> files = steps();
  ASSERT_EQ(shown.size(), files.size());
  for (std::size_t i = 0; i < files.size(); ++i) EXPECT_EQ(shown[i], readFile(files[i])) << files[i];
}

class Lessons : public ProgramTest {
 protected:
  /// Does as a reader does who pastes all blocks of a page, one after the other: scenes into the file `name`,
  /// commands into a terminal, whose pictures are made small. A block that begins with "# NAME:" is that
  /// file.
  void follow(const fs::path& page, const std::string& name) {
    SCOPED_TRACE(page);
    write("scene.pov", readFile(kRoot / "scenes/arcade.pov"));
    for (const std::string& block : pageOf(page).blocks) {
      if (block.starts_with("# ")) {
        write(block.substr(2, block.find(':') - 2), block);
        continue;
      }
      if (!isCommand(block)) {
        if (exists("pieces.inc") && !isScene(block)) continue;  // shown of that file
        write(name, isScene(block) ? block : "Trace 1\n" + block);
        const Run lint = run({"lint", name, "-w", "32"});
        EXPECT_EQ(lint.code, 0) << block << lint.out << lint.err;
        continue;
      }
      std::istringstream lines(block);
      for (std::string line; std::getline(lines, line);) execute(wordsOf(line));
    }
  }

 private:
  void execute(std::vector<std::string> words) {
    if (words.empty() || words[0] != "ray" || words.at(1) == "gui") return;
    if (std::find(words.begin(), words.end(), "--run") != words.end()) return;  // see grade_run_test.cpp
    words.erase(words.begin());
    const std::string command = words[0];
    const auto has = [&](const char* flag) {
      return std::find(words.begin(), words.end(), flag) != words.end();
    };
    if (command == "render" || command.find('.') != command.npos) {
      if (!has("--region") && !has("--quick")) words.insert(words.end(), {"-w", "24"});
      if (!has("--quick")) words.insert(words.end(), {"--spp", "1"});
    }
    std::string all;
    for (const std::string& word : words) all += " " + word;
    const Run done = run(words);
    const bool answered = (command == "lint" && done.code == 6) || (command == "diff" && done.code == 1);
    EXPECT_TRUE(done.code == 0 || answered) << "ray" << all << "\n" << done.err;
  }
};

TEST_F(Lessons, StepsOfTheTutorialRenderWithoutAWarning) {
  for (const fs::path& step : steps()) {
    const Run lint = run({"lint", step, "-w", "32", "-q"});
    EXPECT_EQ(lint.code, 0) << step << lint.out << lint.err;
    const Run render = run({step, "step.png", "-w", "64", "--quality", "draft", "--spp", "8", "--log-level",
                            "warning", "--progress=none"});
    EXPECT_EQ(render.code, 0) << step;
    EXPECT_EQ(render.err.find("warning:"), std::string::npos) << step << render.err;
  }
}

TEST_F(Lessons, TheTutorialWorksWhenPasted) {
  write("pieces.inc", readFile(kSteps / "pieces.inc"));
  for (const fs::path& page : pagesBelow(kRoot / "docs/tutorial")) follow(page, "still.ray");
}

TEST_F(Lessons, TheHowTosWorkWhenPasted) {
  fs::copy(kRoot / "scenes", path("scenes"), fs::copy_options::recursive);
  for (const char* made : {"solution", "handed-in", "scenes-in", "submissions/ann"})
    fs::create_directories(path(made));
  write("scenes-in/white.ray", kWhite);
  ASSERT_EQ(run({"white.ray", "solution/white.png", "-w", "64"}).code, 0);
  for (const std::string also : {"spheres", "shadows"}) {  // which the page of classes names
    fs::copy(path("solution/white.png"), path("solution/" + also + ".png"));
    write("scenes-in/" + also + ".ray", kWhite);
  }
  for (const char* submitted : {"handed-in", "submissions/ann"})
    fs::copy(path("solution"), path(submitted), fs::copy_options::recursive);
  for (const fs::path& page : pagesBelow(kRoot / "docs/how-to")) {
    fs::remove(path("scene.ray"));
    ASSERT_EQ(run({"new", "scene.ray"}).code, 0);
    follow(page, "scene.ray");
  }
}

TEST_F(Lessons, ThePageOfLintShowsWhatLintPrints) {
  const std::string corpus = "tests/corpus/lint", page = readFile(kRoot / "docs/lint.md");
  fs::create_directories(path(corpus));
  fs::copy(kRoot / corpus, path(corpus), fs::copy_options::recursive);
  std::size_t shown = 0;
  for (const auto& entry : fs::directory_iterator(kRoot / corpus)) {
    const std::string scene = corpus + "/" + entry.path().filename().string();
    if (page.find(scene + ":") == page.npos) continue;
    ++shown;
    std::istringstream printed(run({"lint", scene}).out);
    for (std::string line; std::getline(printed, line);)
      if (line.find("warning: ") != line.npos || line.find("hint: ") != line.npos) {
        EXPECT_NE(page.find("    " + line + "\n"), page.npos) << line;
      }
  }
  EXPECT_GT(shown, 20u);
}

}  // namespace
}  // namespace trace::test
