// ray merge FOLDER: the parts of a render, in any order, become the picture that one machine renders
// (parts.h). Nothing is written unless all parts are there, and each is of this scene, program and options.
#include <chrono>
#include <filesystem>
#include <map>
#include <optional>

#include "app/editing/folder.h"
#include "app/session/film_file.h"
#include "app/session/remaining_time.h"
#include "app/session/version.h"
#include "base/budget.h"
#include "base/files/read_scope.h"
#include "cli/commands/commands.h"
#include "cli/frames.h"
#include "cli/parts.h"
#include "cli/render_steps.h"
#include "cli/terminal/terminal.h"

namespace trace::cli {
namespace {

namespace fs = std::filesystem;

/// The whole render, as the folder's list gives it.
struct Render {
  Arguments arguments;
  int parts = 1;

  std::size_t pictures() const { return std::max<std::size_t>(1, arguments.frames.size()); }
  void open(Session& session, std::size_t picture) const {
    std::vector<Choice> choices = arguments.choices;
    if (!arguments.frames.empty()) choices.push_back(momentOf(arguments, arguments.frames[picture]));
    session.open(arguments.files[0], choices, arguments.strict);
  }
  /// The identity of each part of a picture; after open().
  std::vector<std::string> identities(const Session& session) const {
    Settings settings = session.settings();
    settings.autoExposure = false;  // it is settled before samples are taken, and changes none
    std::vector<std::string> all;
    for (int part = 0; part < parts; ++part)
      all.push_back(filmIdentity(session.metadata(), settings, programText(), {part, parts}));
    return all;
  }
};

Render renderOf(const std::string& folder, const std::vector<Choice>& more) {
  const PartList list = readPartList(folder);
  Render render{parse(list.words, Verb::render), list.parts};
  if (render.arguments.files.size() != 1)
    throw Error(Fault::io, SourcePlace{.file = folder},
                "its list of parts names " + std::to_string(render.arguments.files.size()) +
                    " scenes instead of one");
  const std::string& scene = render.arguments.files[0];
  std::error_code ignored;
  if (!fs::exists(scene, ignored))
    throw Error(Fault::io, "there is no file \"" + scene + "\", the scene of " + folder,
                "ray merge runs where ray split ran; render.sh in the folder names the place");
  render.arguments.choices.insert(render.arguments.choices.end(), more.begin(), more.end());
  return render;
}

/// The files of the jobs 1, 2, ...: in whatever order and with whatever names they lie in the folder. Throws
/// Error(Fault::io) for a part that is missing or there twice, and for files that belong to no job.
std::vector<std::string> filesOfJobs(const std::string& folder, const Render& render) {
  std::map<std::string, std::int64_t> jobs;
  for (std::size_t picture = 0; picture < render.pictures(); ++picture) {
    Session session;
    render.open(session, picture);
    if (picture == 0) checkDivides(session, render.parts);
    for (const std::string& identity : render.identities(session))
      jobs.try_emplace(identity, static_cast<std::int64_t>(jobs.size()));
  }
  const auto count = render.pictures() * static_cast<std::size_t>(render.parts);
  if (jobs.size() < count) throw Error(Fault::io, "two frames of the list are the same moment");
  std::vector<std::string> files(count);
  for (const FolderEntry& entry : listFolder(folder, {".part"})) {
    checkBudget();
    if (entry.folder) continue;
    const std::string path = (fs::path(folder) / entry.name).generic_string();
    const auto head = filmHead(path);
    if (!head)
      throw Error(Fault::io, SourcePlace{.file = path},
                  "expected a part of a picture, found another kind of file",
                  "remove it, and render this part again");
    const auto job = jobs.find(head->identity);
    if (job == jobs.end()) {
      IdentityDifference nearest = differenceOf(head->identity, jobs.begin()->first);
      for (const auto& [identity, number] : jobs)
        if (IdentityDifference other = differenceOf(head->identity, identity); other.size < nearest.size)
          nearest = std::move(other);
      throw Error(Fault::io, SourcePlace{.file = path}, "this part is of another picture: " + nearest.what,
                  "ray split into another folder, or remove the part and render it again");
    }
    std::string& file = files[static_cast<std::size_t>(job->second)];
    if (!file.empty())
      throw Error(Fault::io, SourcePlace{.file = path},
                  "part " + std::to_string(job->second + 1) + " is there twice: " + file + " holds it, too",
                  "remove one of the two");
    file = path;
  }
  std::vector<std::int64_t> missing;
  for (std::size_t i = 0; i < files.size(); ++i)
    if (files[i].empty()) missing.push_back(static_cast<std::int64_t>(i + 1));
  if (!missing.empty())
    throw Error(Fault::io,
                (missing.size() == 1 ? "part " : "parts ") + numbersText(missing) + " of " +
                    std::to_string(count) + (missing.size() == 1 ? " is" : " are") + " missing",
                "make -C " + shellWord(folder) + " -j 4 renders what is missing");
  return files;
}

}  // namespace

int mergeCommand(const Arguments& arguments, const Console& console) {
  const auto start = std::chrono::steady_clock::now();
  if (arguments.files.size() != 1)
    throw Error(Fault::usage,
                "ray merge: expected the folder that ray split made, found " +
                    std::to_string(arguments.files.size()) + " names",
                "ray merge scene.parts -o out.png");
  const std::string& folder = arguments.files[0];
  const Render render = renderOf(folder, arguments.choices);
  const std::vector<int>& frames = render.arguments.frames;
  const ReadScope reading(allowedFiles(render.arguments));
  const std::vector<std::string> parts = filesOfJobs(folder, render);
  const std::string pattern = !arguments.output.empty() || frames.empty()
                                  ? arguments.output
                                  : fs::path(render.arguments.files[0]).stem().generic_string() + ".####.png";
  if (frames.size() > 1 && pattern.find('#') == std::string::npos)
    throw Error(Fault::usage,
                "expected a name with #### for the number of the frame, found \"" + pattern + "\"",
                "-o frame.####.png");
  Signals signals;
  Progress progress = makeProgress(arguments.progress, console);
  std::string written, size;
  int code = kDone;
  for (std::size_t picture = 0; picture < render.pictures() && code == kDone; ++picture) {
    Session session;
    std::optional<PictureFiles> files;
    std::optional<Message> aid;
    try {
      signals.preparingBegins();
      render.open(session, picture);
      const std::string output =
          frames.empty() ? pictureFor(session.scene(), pattern) : frameName(pattern, frames[picture]);
      checkPlaces(session, output);
      session.buildToFinish();
      checkOutputs(session, output, console);
      files.emplace(session.filesFor(output));
      Work work("merging the parts", render.parts);
      const std::vector<std::string> identities = render.identities(session);
      for (int part = 0; part < render.parts; ++part) {
        const auto at = static_cast<std::size_t>(part);
        mergePart(session.film(), parts[picture * static_cast<std::size_t>(render.parts) + at],
                  identities[at], {part, render.parts});
        work.reached(part + 1);
      }
      aid = session.firstAid(whyUnlitIn(session));
    } catch (const StoppedByUser&) {
      console.last(false, "stopped by the user: " +
                              (written.empty() ? "nothing written" : "wrote pictures up to " + written));
      return kStopped;
    }
    RenderResult result;
    const SavedPicture saved = save(session, result, render.arguments, signals, *files, progress, console);
    if (aid) console.warnings({&*aid, 1});
    written = saved.path;
    size = pictureText(session, 1) + (saved.finish == LastSteps::all ? andPasses(session.settings()) : "");
    code = saved.elsewhere ? kFailed : exitCode(result);
    if (saved.path.empty()) {
      console.last(false, lostText(saved));
      return kFailed;
    }
    if (saved.elsewhere) written += whereText(saved, files->path());
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const std::string all =
      frames.size() > 1 && code == kDone ? frameName(pattern, frames.front()) + " to " : "";
  console.last(code == kDone, "wrote " + all + written + " (" + size + ", from " +
                                  std::to_string(parts.size()) + (parts.size() == 1 ? " part" : " parts") +
                                  ") in " + durationText(seconds));
  return code;
}

}  // namespace trace::cli
