#include "cli/parts.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <filesystem>
#include <sstream>

#include "app/session/film_file.h"
#include "app/session/remaining_time.h"
#include "app/session/version.h"
#include "base/files/file.h"
#include "base/text.h"
#include "cli/commands/commands.h"
#include "cli/frames.h"
#include "cli/render_steps.h"
#include "cli/terminal/terminal.h"
#include "image/codecs/codec.h"

namespace trace::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kListBegin = "Trace parts 1", kParts = "parts ", kWord = "word ";

std::string listName(const std::string& folder) { return (fs::path(folder) / "parts.list").generic_string(); }

/// Whether the file is the part with this identity, and whole.
bool isThisPart(const std::string& path, const std::string& identity) {
  const auto head = filmHead(path);
  return head && head->identity == identity && filmBytes(path, *head);
}

}  // namespace

void writePartList(const std::string& folder, const PartList& list) {
  std::string text = std::string(kListBegin) + "\n" + std::string(kParts) + std::to_string(list.parts) + "\n";
  for (const std::string& word : list.words) text += std::string(kWord) + word + "\n";
  writeFile(listName(folder), text);
}

bool hasPartList(const std::string& folder) { return isOrdinaryFile(listName(folder)); }

PartList readPartList(const std::string& folder) {
  const std::string name = listName(folder);
  if (!hasPartList(folder))
    throw Error(Fault::io, "expected a folder that ray split made, found no " + name,
                "ray split SCENE --parts N makes one");
  PartList list;
  std::istringstream lines(readFile(name));
  int number = 0;
  const auto expect = [&](bool holds, const std::string& what, const std::string& found) {
    if (!holds)
      throw Error(Fault::io, SourcePlace{.file = name, .line = number, .column = 1},
                  "expected " + what + ", found \"" + found + "\"", "ray split writes this file");
  };
  for (std::string line; std::getline(lines, line);) {
    if (++number == 1) {
      expect(line == kListBegin, "\"" + std::string(kListBegin) + "\"", line);
    } else if (number == 2) {
      const char* const end = line.data() + line.size();
      const bool named = line.starts_with(kParts);
      const auto read = std::from_chars(line.data() + (named ? kParts.size() : 0), end, list.parts);
      expect(named && read.ec == std::errc() && read.ptr == end && list.parts >= 1,
             "\"parts N\", a whole number from 1 on", line);
    } else {
      expect(line.starts_with(kWord), "\"word\" and a word of the command line", line);
      list.words.push_back(line.substr(kWord.size()));
    }
  }
  if (number < 3) expect(false, "more lines", "the end of the file");
  return list;
}

std::string partName(std::int64_t job) { return std::to_string(job) + ".part"; }

std::string numbersText(const std::vector<std::int64_t>& numbers) {
  constexpr std::size_t kMost = 12;
  std::string text;
  for (std::size_t i = 0; i < std::min(numbers.size(), kMost); ++i)
    text += (i == 0 ? "" : i + 1 == numbers.size() ? " and " : ", ") + std::to_string(numbers[i]);
  return numbers.size() > kMost ? text + " and " + std::to_string(numbers.size() - kMost) + " more" : text;
}

void checkDivides(const Session& session, int parts) {
  if (parts == 1) return;
  const Settings& settings = session.settings();
  if (subdivides(settings))
    throw Error(Fault::usage,
                "--subdivide compares each pixel with those around it, so it cannot be divided into parts "
                "that give the same picture",
                "--subdivide 0 with --spp or --noise-target; of an animation, --frames without --parts");
  const Size size = session.size();
  constexpr std::int64_t kSide = Film::kTileSize;
  const std::int64_t tiles = (size.width + kSide - 1) / kSide * ((size.height + kSide - 1) / kSide);
  if (parts > tiles)
    throw Error(Fault::usage,
                "the picture has " + std::to_string(tiles) + (tiles == 1 ? " tile" : " tiles") + " of " +
                    std::to_string(kSide) + " x " + std::to_string(kSide) +
                    " pixels, and cannot be divided into " + std::to_string(parts) + " parts",
                "choose at most " + std::to_string(tiles) + " parts");
}

int renderPart(const Arguments& arguments, const std::string& named, const Console& console) {
  const auto start = std::chrono::steady_clock::now();
  const TileShare share{arguments.part - 1, arguments.parts};
  std::vector<Choice> choices = arguments.choices;
  if (arguments.frames.size() > 1)
    throw Error(Fault::usage, "--part: expected one frame, found " + std::to_string(arguments.frames.size()),
                "--frames 7 --part 2/5; ray split makes the jobs of all frames");
  if (pictureFormatNamed(named))
    throw Error(Fault::usage, "--part: expected a name that ends in .part, found \"" + named + "\"",
                "a part is no picture: ray merge makes one of all parts");
  if (!arguments.frames.empty()) choices.push_back(momentOf(arguments, arguments.frames.front()));
  Signals signals;
  Session session;
  session.open(arguments.files[0], choices, arguments.strict);
  checkDivides(session, share.count);
  const std::string what = "part " + std::to_string(arguments.part) + " of " + std::to_string(share.count);
  const std::string output = !named.empty() ? named
                                            : fs::path(arguments.files[0]).stem().generic_string() + "." +
                                                  std::to_string(arguments.part) + "-of-" +
                                                  std::to_string(share.count) + ".part";
  checkIsNoInput(output, session.scene().inputs);
  checkWritable(output);
  signals.preparingBegins();
  try {
    session.setFramesPerSecond(arguments.framesPerSecond);
    session.build();
  } catch (const StoppedByUser&) {
    console.last(false, "stopped by the user: nothing written, for nothing was finished");
    return kStopped;
  }
  session.film().limitTo(share);
  console.warnings(session.messages().all());
  const std::string identity =
      filmIdentity(session.metadata(), session.settings(), programText(), session.film().share());
  if (isThisPart(output, identity)) {
    console.last(true, "nothing to write: " + output + ", " + what + ", is already there");
    return kDone;
  }
  signals.renderingBegins();
  Progress progress = makeProgress(arguments.progress, console);
  PictureFiles files = session.filesFor(output);
  const RenderResult result =
      renderPictureWatched(session, arguments, signals, console, progress, files, Part{});
  reportLosses(session, result, console);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (result.end == End::finished) writeFilm(output, identity, session.film());
  const std::string goesOn = settleCheckpoint(session, result, arguments, files);
  const bool written = result.end == End::finished;
  if (!reportStatistics(arguments, session, result, written ? output : "", seconds, console)) return kFailed;
  console.last(written, whyStopped(result) +
                            (written ? "wrote " + output : "nothing written, for the part is not finished") +
                            " (" + what + ", " + pictureText(session, session.job().fraction()) + ") in " +
                            durationText(seconds) + goesOn);
  return exitCode(result);
}

}  // namespace trace::cli
