#include "studio/script.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <sstream>

#include "base/files/file.h"
#include "base/text.h"
#include "image/codecs/codec.h"
#include "scene/picture_size.h"
#include "studio/actions.h"
#include "studio/panels.h"
#include "studio/scene/selection.h"
#include "studio/script_state.h"
#include "studio/widgets/landmarks.h"

namespace trace::studio {
namespace {

int whole(const std::string& word) {
  constexpr double kLargest = 1e9;
  const auto number = parseNumber(word);
  if (!number || number->length != word.size() || !(std::abs(number->value) <= kLargest) ||
      number->value != std::floor(number->value))
    throw Error(Fault::usage, "expected a whole number, found \"" + word + "\"");
  return static_cast<int>(number->value);
}

std::vector<Message> errorsIn(const Workspace& workspace) {
  std::vector<Message> errors;
  for (const Workspace::LogEntry& entry : workspace.log())
    if (entry.level == Workspace::LogEntry::Level::error)
      errors.push_back({.place = entry.place, .what = entry.text, .hint = entry.hint});
  return errors;
}

/// With the last error of the log.
[[noreturn]] void fail(const Workspace& workspace) {
  const std::vector<Message> errors = errorsIn(workspace);
  throw Error(Fault::io, errors.empty() ? "the picture cannot be rendered" : errors.back().what);
}

/// The words from this one on.
std::string joined(const std::vector<std::string>& words, std::size_t first = 0) {
  std::string text;
  for (std::size_t i = first; i < words.size(); ++i) text += (text.empty() ? "" : " ") + words[i];
  return text;
}

const Landmark& partOf(const std::string& name) {
  const auto found = landmarks().find(name);
  if (found == landmarks().end()) throw Error(Fault::usage, "the window shows no \"" + name + "\"");
  return found->second;
}

/// The area that a landmark covers.
Picture part(const Picture& all, const std::string& name) {
  const Landmark& at = partOf(name);
  const auto bound = [](float x, int most) { return std::clamp(static_cast<int>(std::lround(x)), 0, most); };
  const int left = bound(at[0], all.width), top = bound(at[1], all.height);
  Picture result(bound(at[2], all.width) - left, bound(at[3], all.height) - top);
  for (int y = 0; y < result.height; ++y)
    for (int x = 0; x < result.width; ++x) result.at(x, y) = all.at(left + x, top + y);
  return result;
}

using Words = std::vector<std::string>;

const Action& actionOf(const Words& words) {
  const std::string name = joined(words);
  for (const Action& action : actions())
    if (name == action.name) return action;
  throw Error(Fault::usage, "no menu has an entry \"" + name + "\"");
}

const Panel& panelOf(const Words& words) {
  const std::string name = joined(words);
  for (const Panel& panel : panels())
    if (name == panel.name) return panel;
  throw Error(Fault::usage, "no panel is called \"" + name + "\"");
}

View viewOf(const std::string& word) {
  const int number = whole(word);
  if (number < 0 || number > 5) throw Error(Fault::usage, "expected 0 to 5, found " + word);
  return static_cast<View>(number);
}

FilmPlane planeOf(const std::string& word) {
  const int number = whole(word);
  if (number < 0 || number >= static_cast<int>(std::size(kPlaneNames)))
    throw Error(Fault::usage,
                "expected 0 to " + std::to_string(std::size(kPlaneNames) - 1) + ", found " + word);
  return static_cast<FilmPlane>(number);
}

Studio::Selected kindOf(const std::string& word) {
  const auto& names = Studio::kSelectedNames;
  const auto kind = std::find(std::begin(names), std::end(names), word);
  if (kind == std::end(names))
    throw Error(Fault::usage, "expected camera, background, object, light, material or none, found " + word);
  return static_cast<Studio::Selected>(kind - std::begin(names));
}

const Scene& sceneOf(const Studio& studio) {
  if (!studio.workspace.document.isOpen()) throw Error(Fault::usage, "no scene is open");
  return studio.workspace.document.scene();
}

void select(Studio& studio, const std::string& word, const std::string& number) {
  const Studio::Selected kind = kindOf(word);
  const std::size_t count = howMany(sceneOf(studio), kind);
  const int index = whole(number);
  if (index < 0 || static_cast<std::size_t>(index) >= count)
    throw Error(Fault::usage, "the scene has no " + word + " " + number + ": it has " + counted(count, word) +
                                  ", counted from 0");
  studio.select(kind, static_cast<std::size_t>(index));
}

void clickPixel(Studio& studio, int x, int y) {
  const Size size = pictureSize(studio.workspace.document.settings(), sceneOf(studio).camera);
  if (x < 0 || y < 0 || x >= size.width || y >= size.height)
    throw Error(Fault::usage, "expected a pixel of the picture of " + std::to_string(size.width) + " x " +
                                  std::to_string(size.height) + ", found " + std::to_string(x) + " " +
                                  std::to_string(y));
  studio.picture.goTo(x, y);
}

/// The pointer at a place of the part, in shares of its width and height.
void pointAt(Studio& studio, const Landmark& at, double x, double y) {
  studio.window.feed({.kind = InputEvent::Kind::pointer,
                      .x = at[0] + x * static_cast<double>(at[2] - at[0]),
                      .y = at[1] + y * static_cast<double>(at[3] - at[1])});
}

void press(Studio& studio, bool down) {
  studio.window.feed({.kind = InputEvent::Kind::button, .code = 0, .down = down});
}

/// Moves the pointer a little in each frame, over the middle half of the part; true when it is done.
bool movePointer(Studio& studio, const Words& words, bool drags) {
  const int frames = whole(words[0]), frame = studio.scriptFrames;
  const Landmark& at = partOf(joined(words, 1));
  const double share = frames > 0 ? std::min(1.0, static_cast<double>(frame) / frames) : 1;
  if (drags && frame > frames) return press(studio, false), true;
  pointAt(studio, at, 0.25 + 0.5 * share, 0.4 + 0.2 * share);
  if (drags && frame == 0) press(studio, true);
  return !drags && frame >= frames;
}

/// A number from 0 to below `most`, which follows from the seed, the frame and `salt`.
unsigned dice(int seed, int frame, unsigned salt, unsigned most) {
  std::uint64_t h = static_cast<std::uint64_t>(seed) * 0x9e3779b97f4a7c15u +
                    static_cast<std::uint64_t>(frame) * 0xbf58476d1ce4e5b9u + salt * 0x94d049bb133111ebu;
  h ^= h >> 30, h *= 0xbf58476d1ce4e5b9u, h ^= h >> 27, h *= 0x94d049bb133111ebu, h ^= h >> 31;
  return static_cast<unsigned>(h % most);
}

void typeKey(Studio& studio, int key, bool control = false) {
  InputEvent event{.kind = InputEvent::Kind::key, .code = key, .writes = key, .down = true};
  event.control = control;
  if (!control && key < 128) event.character = static_cast<unsigned>(key);
  studio.window.feed(event);
  event.down = false;
  event.character = 0;
  studio.window.feed(event);
}

/// Random input, below the menu bar: it closes dialogs, so nothing is written. True when it is done.
bool playMonkey(Studio& studio, const Words& words) {
  constexpr int kHeld = 4;  // frames between a press and its release
  constexpr int kKeys[] = {258,
                           262,
                           263,
                           264,
                           265,
                           KeyPress::kEscape,
                           KeyPress::kEnter,
                           KeyPress::kDelete,
                           ' ',
                           'A',
                           'C',
                           'F',
                           'M',
                           'P',
                           'S',
                           'T',
                           '.',
                           '-',
                           '0',
                           '3',
                           '7',
                           291,
                           292,
                           293,
                           KeyPress::kF11};
  constexpr int kWithControl[] = {'Z', 'Y', 'D', 'L'};
  const int frames = whole(words[0]), seed = whole(words[1]), frame = studio.scriptFrames;
  const auto roll = [&](unsigned salt, unsigned most) { return dice(seed, frame, salt, most); };
  if (studio.dialog.isOpen()) typeKey(studio, KeyPress::kEscape);
  if (frame % kHeld == 0) {
    press(studio, false);
    const unsigned what = roll(0, 10);
    if (what == 0) studio.window.feed({.kind = InputEvent::Kind::wheel, .y = roll(1, 2) ? 1.0 : -1.0});
    if (what == 1) typeKey(studio, kWithControl[roll(1, 4)], true);
    if (what == 2 || what == 3) typeKey(studio, kKeys[roll(1, static_cast<unsigned>(std::size(kKeys)))]);
    if (what > 4 && frame < frames) press(studio, true);
  }
  int width = 0, height = 0;
  studio.window.size(width, height);
  constexpr double kMenu = 0.06;  // share of the height, in which the monkey does not click
  const double x = roll(2, 1000) / 1000.0, y = kMenu + (1 - kMenu) * roll(3, 1000) / 1000.0;
  studio.window.feed({.kind = InputEvent::Kind::pointer, .x = x * width, .y = y * height});
  return frame >= frames && frame % kHeld == 0;
}

/// Time and frames since the last call.
void printTimes(const Studio& studio, const std::string& what) {
  using Clock = std::chrono::steady_clock;
  static Clock::time_point wall = Clock::now();
  static std::clock_t processor = std::clock();
  static std::uint64_t frames = 0;
  const double seconds = std::chrono::duration<double>(Clock::now() - wall).count(),
               busy = static_cast<double>(std::clock() - processor) / CLOCKS_PER_SEC;
  if (!what.empty())
    std::printf("%s\t%d\t%.4f\t%.4f\n", what.c_str(), static_cast<int>(studio.frames - frames), seconds,
                busy);
  std::fflush(stdout);
  wall = Clock::now();
  processor = std::clock();
  frames = studio.frames;
}

void checkNumbers(const Words& words) {
  for (const std::string& word : words) whole(word);
}
void checkPicture(const Words& words) { pictureFormatFor(words[0]); }
void checkTab(const Words& words) {
  if (words[0] != "Tree" && words[0] != "Ray" && words[0] != "Ways" && words[0] != "Pyramid" &&
      words[0] != "Chain" && words[0] != "Difference")
    throw Error(Fault::usage, "expected Tree, Ray, Ways, Pyramid, Chain or Difference, found " + words[0]);
}
void checkOption(const Words& words) {
  Settings scratch;
  findOption(words[0]).assign(scratch, words[1]);
}

/// A command has one of `run`, which does it, and `until`, which is asked once in a frame until it says yes.
/// `check`, if any, throws an Error if the arguments are wrong whatever the window shows. `settle`: frames
/// until what it did shows everywhere.
struct Command {
  const char* name;
  const char* arguments;
  std::size_t least, most;  // number of arguments
  const char* help;
  void (*run)(Studio&, const Words&);
  void (*check)(const Words&) = nullptr;
  int settle = 3;
  bool (*until)(Studio&, const Words&) = nullptr;
};

constexpr std::array kCommands{
    Command{"open", "FILE", 1, 1, "open a scene", [](Studio& s, const Words& a) { s.workspace.open(a[0]); }},
    Command{"drop", "FILE", 1, 1, "drop a file onto the window: a scene, or a picture to compare with",
            [](Studio& s, const Words& a) { s.window.drop(a[0]); }},
    Command{"reference", "FILE", 1, 1, "compare with a picture",
            [](Studio& s, const Words& a) { s.workspace.openReference(a[0]); }},
    Command{"set", "OPTION VALUE", 2, 2, "choose an option",
            [](Studio& s, const Words& a) { s.workspace.choose(a[0], a[1]); }, checkOption},
    Command{"wait", "", 0, 0, "until the picture and the view in space are finished", nullptr, nullptr, 3,
            [](Studio& s, const Words&) {
              const auto state = s.workspace.render.state();
              if (state.phase == BackgroundRender::Phase::failed) fail(s.workspace);
              return !state.working() && !s.workspace.stale() && !s.rays.modelTask.busy();
            }},
    Command{"action", "NAME...", 1, 9, "an entry of a menu: action Undo",
            [](Studio& s, const Words& a) {
              const Action& action = actionOf(a);
              if (!action.enabled(s))
                throw Error(Fault::usage, "the entry \"" + std::string(action.name) + "\" is greyed now");
              action.run(s);
            },
            [](const Words& a) { actionOf(a); }},
    Command{"panel", "NAME...", 1, 3, "bring a panel to the front",
            [](Studio& s, const Words& a) { s.show(std::string(panelOf(a).name)); },
            [](const Words& a) { panelOf(a); }},
    Command{"view", "NUMBER", 1, 1,
            "0 picture, 1 reference, 2 side by side, 3 swipe, 4 difference, 5 false colour",
            [](Studio& s, const Words& a) { s.picture.view = viewOf(a[0]); },
            [](const Words& a) { viewOf(a[0]); }},
    Command{"plane", "NUMBER", 1, 1,
            "the view of the render: 0 picture, 1 samples, 2 noise, 3 change by denoise, 4 cost",
            [](Studio& s, const Words& a) { s.picture.plane = planeOf(a[0]); },
            [](const Words& a) { planeOf(a[0]); }},
    Command{"pass", "NAME", 1, 1, "the pass of the render that is seen; picture: none",
            [](Studio& s, const Words& a) { s.picture.pass = a[0] == "picture" ? "" : a[0]; }},
    Command{"samples", "NUMBER", 1, 1,
            "until pixels have so many samples on the average, or the picture is finished", nullptr,
            checkNumbers, 3,
            [](Studio& s, const Words& a) {
              return s.picture.convergence.samples >= whole(a[0]) || !s.workspace.render.state().working();
            }},
    Command{"pixel", "X Y", 2, 2, "click this pixel of the picture",
            [](Studio& s, const Words& a) { clickPixel(s, whole(a[0]), whole(a[1])); }, checkNumbers, 1},
    Command{"bad", "NUMBER", 1, 1, "show the rays of a bad sample of the last render, counted from 0",
            [](Studio& s, const Words& a) {
              const std::vector<BadSample> bad = s.workspace.render.result().badSamples;
              if (whole(a[0]) < 0 || static_cast<std::size_t>(whole(a[0])) >= bad.size())
                throw Error(Fault::usage, "the render has no bad sample " + a[0]);
              showBadSample(s, bad[static_cast<std::size_t>(whole(a[0]))]);
            },
            checkNumbers},
    Command{"select", "KIND NUMBER", 2, 2,
            "in the panel Scene: camera, background, object, light, material or none, from 0",
            [](Studio& s, const Words& a) { select(s, a[0], a[1]); },
            [](const Words& a) {
              kindOf(a[0]);
              whole(a[1]);
            }},
    Command{"rays", "", 0, 0, "wait until the rays of the pixel are shown", nullptr, nullptr, 3,
            [](Studio& s, const Words&) {
              return !s.workspace.inspector.busy() && !s.rays.chains.busy() && !s.rays.pyramid.busy() &&
                     !s.picture.cost.busy();
            }},
    Command{
        "seen", "", 0, 0, "wait until a frame shows the rays of the pixel", nullptr, nullptr, 0,
        [](Studio& s, const Words&) { return s.rays.x == s.rays.clickedX && s.rays.y == s.rays.clickedY; }},
    Command{"shown", "", 0, 0, "wait until a frame shows something of the picture", nullptr, nullptr, 0,
            [](Studio& s, const Words&) {
              return s.workspace.document.isOpen() && !s.picture.waits && s.picture.shown.width > 0;
            }},
    Command{"thumbnails", "", 0, 0, "wait until the start page has all its pictures", nullptr, nullptr, 3,
            [](Studio& s, const Words&) { return s.start.complete(); }},
    Command{"pin", "", 0, 0, "pin the rays of this pixel, or unpin them",
            [](Studio& s, const Words&) { s.workspace.inspector.pin(!s.workspace.inspector.pinned()); }},
    Command{"ray", "NUMBER", 1, 1, "select a ray of the pixel, in the order of tracing from 0",
            [](Studio& s, const Words& a) {
              if (whole(a[0]) < 0 || static_cast<std::size_t>(whole(a[0])) >= s.rays.rays)
                throw Error(Fault::usage, "the pixel has no ray " + a[0]);
              s.rays.selected = whole(a[0]);
            },
            checkNumbers},
    Command{"way", "NUMBER", 1, 1, "select one of the strategies that connected both paths, from 0",
            [](Studio& s, const Words& a) {
              chooseWay(s, whole(a[0]));
              if (s.rays.way < 0) throw Error(Fault::usage, "the pixel has no way " + a[0]);
            },
            checkNumbers},
    Command{"alone", "LIGHT CAMERA", 2, 2,
            "show the pyramid's strategy with these numbers of vertices alone; or all if it is",
            [](Studio& s, const Words& a) {
              std::optional<Way>& alone = s.rays.pyramid.alone;
              const Way way{whole(a[0]), whole(a[1])};
              alone = alone == way ? std::nullopt : std::optional(way);
            },
            checkNumbers},
    Command{"move", "NUMBER", 1, 1, "go so many moves on in the chain of mlt, or back if it is negative",
            [](Studio& s, const Words& a) {
              if (!s.rays.chains.walk()) throw Error(Fault::usage, "no chain is followed");
              s.rays.chainMove = std::max(0, s.rays.chains.index() + whole(a[0]));
              s.rays.revealMove = true;
            },
            checkNumbers},
    Command{"step", "NUMBER", 1, 1, "go so many rays on in the order of tracing, or back if it is negative",
            [](Studio& s, const Words& a) { stepRays(s, whole(a[0])); }, checkNumbers},
    Command{"boxes", "", 0, 0, "show the hierarchy boxes that the selected ray visited",
            [](Studio& s, const Words&) { showBoxes(s); }},
    Command{"tab", "NAME", 1, 1, "a tab of the panel Rays: Tree, Ray, Ways, Pyramid, Chain or Difference",
            [](Studio& s, const Words& a) { s.raysTab = a[0]; }, checkTab},
    Command{"save", "FILE", 1, 1, "write the picture",
            [](Studio& s, const Words& a) { s.workspace.savePicture(a[0]); }, checkPicture},
    Command{"save-scene", "FILE", 1, 1, "write the scene as a .ray file",
            [](Studio& s, const Words& a) { s.workspace.saveScene(a[0]); }},
    Command{"save-rays", "FILE", 1, 1, "write a drawing of the pixel's rays, as .svg or .png",
            [](Studio& s, const Words& a) {
              if (!shownPixel(s)) throw Error(Fault::usage, "no rays are shown");
              saveRays(s, a[0]);
            }},
    Command{"save-story", "FILE", 1, 1,
            "write the view in space with the rays and their tree, as .svg or .png, or as a film: .apng",
            [](Studio& s, const Words& a) {
              if (!shownPixel(s)) throw Error(Fault::usage, "no rays are shown");
              saveStory(s, a[0]);
            }},
    Command{"screenshot", "FILE [PART...]", 1, 9, "write what the window shows, or a part that `state` names",
            [](Studio& s, const Words& a) {
              const Picture all = fromBytes(s.window.screenshot());
              writePicture(a[0], a.size() > 1 ? part(all, joined(a, 1)) : all);
            },
            checkPicture},
    Command{"drag", "FRAMES PART...", 2, 9,
            "drag the mouse over a part that `state` names, in so many frames", nullptr,
            [](const Words& a) { whole(a[0]); }, 0,
            [](Studio& s, const Words& a) { return movePointer(s, a, true); }},
    Command{"hover", "FRAMES PART...", 2, 9,
            "move the mouse over a part that `state` names, in so many frames", nullptr,
            [](const Words& a) { whole(a[0]); }, 0,
            [](Studio& s, const Words& a) { return movePointer(s, a, false); }},
    Command{"monkey", "FRAMES SEED", 2, 2, "click, drag and type at random, in so many frames", nullptr,
            checkNumbers, 0, playMonkey},
    Command{"times", "[WORDS...]", 0, 9,
            "write the frames since the last `times`, their seconds, and those of all processors",
            [](Studio& s, const Words& a) { printTimes(s, joined(a)); }, nullptr, 0},
    Command{"state", "FILE", 1, 1, "write in words what is chosen and where things are",
            [](Studio& s, const Words& a) { writeFile(a[0], state(s)); }, nullptr, 0},
    Command{"say", "WORDS...", 1, 9, "write these words to standard output, for a waiting program",
            [](Studio&, const Words& a) {
              std::printf("%s\n", joined(a).c_str());
              std::fflush(stdout);
            },
            nullptr, 0},
    Command{"await", "FILE", 1, 1, "until the file exists, and the events before it are handled", nullptr,
            nullptr, 3,
            [](Studio& s, const Words& a) { return std::filesystem::exists(a[0]) && s.window.quiet(); }},
};

const Command& commandOf(const Words& words) {
  for (const Command& command : kCommands) {
    if (words[0] != command.name) continue;
    if (words.size() - 1 < command.least || words.size() - 1 > command.most)
      throw Error(Fault::usage, std::string("expected ") + command.name + " " + command.arguments);
    return command;
  }
  throw Error(Fault::usage, "unknown command \"" + words[0] + "\"");
}

Words argumentsOf(const Words& words) { return {words.begin() + 1, words.end()}; }

}  // namespace

Script::Script(const std::string& file, double timeLimit) {
  budget_.limitTime(timeLimit);
  std::vector<Message> wrong;
  std::istringstream text(readFile(file));
  std::string line;
  for (int number = 1; std::getline(text, line); ++number) {
    std::istringstream words(line.substr(0, line.find('#')));
    Line next{{file, number, 1, line}, {}};
    for (std::string word; words >> word;) next.words.push_back(word);
    if (next.words.empty()) continue;
    try {
      if (const Command& command = commandOf(next.words); command.check)
        command.check(argumentsOf(next.words));
    } catch (const Error& error) {
      wrong.push_back(error.messages().front());
      wrong.back().place = next.place;
    }
    lines_.push_back(std::move(next));
  }
  if (!wrong.empty()) throw Error(Fault::usage, std::move(wrong));
}

bool Script::step(Studio& studio) {
  waits_ = false;
  if (budget_.timeIsOver() && next_ < lines_.size())
    throw Error(Fault::limit, lines_[next_].place,
                "the time limit of " + toText(budget_.timeLimit()) + " s is over while the script is here",
                "a larger --time-limit gives it longer; 0 never stops");
  if (framesToWait_ > 0) return --framesToWait_, true;
  bool goesOn = true;  // commands that need no frame follow each other at once
  while (goesOn && !waits_ && framesToWait_ == 0) goesOn = next(studio);
  return goesOn;
}

bool Script::next(Studio& studio) {
  const Workspace& workspace = studio.workspace;
  waits_ = workspace.reading() || workspace.saving();
  if (waits_) return true;
  waits_ = studio.rays.coarse && next_ < lines_.size() && lines_[next_].words[0] == "screenshot";
  if (waits_) return true;
  const bool failed = workspace.failures() > 0;  // in what the last command began, or the command line
  if (failed && next_ == 0) throw Error(Fault::io, errorsIn(workspace));
  if (next_ == lines_.size() && !failed) return false;
  const Line& line = lines_[failed ? next_ - 1 : next_];
  try {
    if (failed) fail(workspace);
    const Command& command = commandOf(line.words);
    const Words arguments = argumentsOf(line.words);
    if (command.run) command.run(studio, arguments);
    waits_ = command.until && !command.until(studio, arguments);
    ++studio.scriptFrames;
    if (!waits_) {
      ++next_;
      studio.scriptFrames = 0;
      framesToWait_ = command.settle;
    }
    return true;
  } catch (const Error& error) {
    Message message = error.messages().front();
    message.place = line.place;
    throw Error(error.fault(), {message});
  }
}

std::string scriptHelp() {
  std::string text;
  for (const Command& command : kCommands) {
    std::string left = std::string("  ") + command.name + " " + command.arguments;
    left.resize(std::max<std::size_t>(left.size() + 2, 28), ' ');
    text += left + command.help + "\n";
  }
  return text;
}

}  // namespace trace::studio
