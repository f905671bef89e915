// ray farm SCENE --parts N: a render by a cluster with Slurm. It writes the jobs (job_folder.h), submits
// those that are missing as a job array, submits lost ones again, and merges the parts when all are there.
//
// All state is in the folder and in Slurm's queue, where the array has a name of its own: another process, on
// any machine that sees the folder, continues where this one ended.
#include <algorithm>
#include <charconv>
#include <chrono>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <utility>

#include "app/editing/folder.h"
#include "app/session/film_file.h"
#include "base/budget.h"
#include "base/files/file.h"
#include "base/os/process.h"
#include "base/printable.h"
#include "base/text.h"
#include "cli/commands/commands.h"
#include "cli/job_folder.h"
#include "cli/parts.h"
#include "cli/render_steps.h"
#include "cli/terminal/terminal.h"

namespace trace::cli {
namespace {

namespace fs = std::filesystem;
using Tasks = std::set<std::int64_t>;

std::optional<std::int64_t> numberIn(std::string_view text) {
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return {};
  return number;
}

std::string firstLine(const std::string& text) { return printable(text.substr(0, text.find('\n'))); }

/// "1-3,7", as sbatch takes them.
std::string rangesText(const Tasks& tasks) {
  std::string text;
  for (auto first = tasks.begin(); first != tasks.end();) {
    auto last = first;
    while (std::next(last) != tasks.end() && *std::next(last) == *last + 1) ++last;
    text += (text.empty() ? "" : ",") + std::to_string(*first);
    if (last != first) text += "-" + std::to_string(*last);
    first = std::next(last);
  }
  return text;
}

/// The job array of a folder, in Slurm's queue.
class Slurm {
 public:
  Slurm(const JobFolder& jobs, std::vector<std::string> flags) : jobs_(jobs), flags_(std::move(flags)) {}

  struct Queue {
    bool answers = false;  ///< if not, `why` says so
    std::string why;
    Tasks tasks;
  };
  Queue queue() const {
    const os::ProgramAnswer answer =
        os::answerOf({"squeue", "--noheader", "--array", "--name=" + jobs_.arrayName(), "--format=%K"});
    if (answer.code != 0) return {false, firstLine(answer.text), {}};
    Queue queue{true, {}, {}};
    std::istringstream lines(answer.text);
    for (std::string index; lines >> index;)
      if (const auto task = numberIn(index)) queue.tasks.insert(*task);
    return queue;
  }

  /// Returns the number that Slurm gave the array. Throws Error(Fault::io).
  std::string submit(const Tasks& tasks) const {
    std::vector<std::string> words{"sbatch"};
    words.insert(words.end(), flags_.begin(), flags_.end());
    words.insert(words.end(), {"--parsable", "--job-name=" + jobs_.arrayName(), "--chdir=" + jobs_.path,
                               "--array=" + rangesText(tasks), jobs_.path + "/farm.slurm"});
    const os::ProgramAnswer answer = os::answerOf(words);
    if (answer.code != 0)
      throw Error(Fault::io, "sbatch refused the job array: " + firstLine(answer.text),
                  "--sbatch FLAGS passes the flags that your cluster asks for");
    return firstLine(answer.text);
  }

 private:
  const JobFolder& jobs_;
  const std::vector<std::string> flags_;
};

/// The parts that lie in the folder.
struct Parts {
  std::set<std::int64_t> there;
  double work = 0;  ///< what is done, as a number of parts: finished ones and the checkpoints of others
};

Parts partsIn(const JobFolder& jobs) {
  const std::string part = partName(0).substr(1), checkpoint = part + ".checkpoint";
  Parts parts;
  std::vector<std::string> begun;
  std::int64_t whole = 0;  // samples of a part
  for (const FolderEntry& entry : listFolder(jobs.path, {part, checkpoint})) {
    const std::string path = (fs::path(jobs.path) / entry.name).generic_string();
    const auto job = numberIn(std::string_view(entry.name).substr(0, entry.name.find('.')));
    if (!job || *job < 1 || *job > jobs.jobs) continue;
    if (entry.name != partName(*job)) {
      begun.push_back(path);
      continue;
    }
    parts.there.insert(*job);
    if (whole > 0) continue;
    if (const auto head = filmHead(path)) whole = head->done;
  }
  parts.work = static_cast<double>(parts.there.size());
  for (const std::string& path : begun)
    if (const auto head = filmHead(path); head && whole > 0)
      parts.work += std::min(0.99, static_cast<double>(head->done) / static_cast<double>(whole));
  return parts;
}

class Farm {
 public:
  Farm(const JobFolder& jobs, const Slurm& slurm, const Console& console, Progress& progress)
      : jobs_(jobs), slurm_(slurm), console_(console), progress_(progress) {}

  /// False if a person ended it first. Throws Error.
  bool waitForParts(Signals& signals) {
    using Milliseconds = std::chrono::milliseconds;
    constexpr Milliseconds kRedraw{250}, kFirst{200}, kLongest{10000};  // between two looks
    for (Milliseconds pause = kFirst;; pause = std::min(pause * 3 / 2, kLongest)) {
      if (look()) pause = kFirst;
      if (parts_.there.size() == static_cast<std::size_t>(jobs_.jobs)) break;
      for (Milliseconds left = pause; left.count() > 0; left -= kRedraw) {
        checkBudget();
        tell(&Progress::update);
        if (signals.wait(static_cast<int>(std::min(left, kRedraw).count())) == Signals::Event::stop)
          return false;
      }
    }
    tell(&Progress::finish);
    return true;
  }

 private:
  static constexpr int kMostTimes = 3;  ///< how many times a task is submitted

  /// A task that was submitted here.
  struct Task {
    int submitted = 0;
    bool away = false;  ///< it was not in the queue when last looked
  };

  /// True if tasks were submitted.
  bool look() {
    const Slurm::Queue queue = slurm_.queue();  // before the files: a task that has ended has written its own
    parts_ = partsIn(jobs_);
    if (!begun_) progress_.beginsAfter(parts_.work / static_cast<double>(jobs_.jobs));
    const bool first = !std::exchange(begun_, true);
    if (!queue.answers) {
      if (first)
        throw Error(Fault::io, "Slurm does not answer: " + queue.why,
                    "make -C " + quotedFolder() + " -j 4 renders the parts without Slurm, then ray merge");
      if (std::exchange(answered_, false))
        note(LogLevel::warning, "warning: Slurm does not answer: " + queue.why + "; asking again");
      return false;
    }
    answered_ = true;
    if (first && !queue.tasks.empty())
      note(LogLevel::info,
           "continuing: " + counted(queue.tasks.size(), "task") + " of an earlier run in the queue");
    return submitLost(queue.tasks);
  }

  bool submitLost(const Tasks& queued) {
    Tasks lost, failed;
    bool waits = false;
    for (const std::int64_t task : unfinished()) {
      Task& known = tasks_[task];
      if (queued.count(task)) {
        known.away = false;
        waits = true;
      } else if (known.submitted > 0 && !known.away) {
        known.away = waits = true;  // perhaps its file is not seen yet
      } else {
        (known.submitted < kMostTimes ? lost : failed).insert(task);
      }
    }
    if (lost.empty() && !failed.empty() && !waits) refuse(failed);
    if (lost.empty()) return false;
    const bool again =
        std::any_of(lost.begin(), lost.end(), [&](auto task) { return tasks_[task].submitted > 0; });
    const std::string number = slurm_.submit(lost);
    for (const std::int64_t task : lost) tasks_[task] = {tasks_[task].submitted + 1, false};
    note(again ? LogLevel::warning : LogLevel::info,
         std::string(again ? "lost and submitted again: " : "submitted ") +
             (lost.size() == 1 ? "task " : "tasks ") + rangesText(lost) + ", job " + number);
    return true;
  }

  /// The tasks with a part that is missing.
  Tasks unfinished() const {
    Tasks tasks;
    for (std::int64_t job = 1; job <= jobs_.jobs; ++job)
      if (!parts_.there.count(job)) tasks.insert((job - 1) % jobs_.tasks() + 1);
    return tasks;
  }

  [[noreturn]] void refuse(const Tasks& failed) const {
    const std::string log =
        (fs::path(jobs_.path) / ("slurm-" + std::to_string(*failed.begin()) + ".log")).generic_string();
    throw Error(Fault::io, SourcePlace{.file = log},
                (failed.size() == 1 ? "task " : "tasks ") + rangesText(failed) + " ended " +
                    std::to_string(kMostTimes) + " times without writing a part",
                "this log says why; the same command tries again");
  }

  using Tell = void (Progress::*)(std::int64_t done, std::int64_t total, double elapsed,
                                  std::optional<double> share);
  void tell(Tell how) {
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
    (progress_.*how)(static_cast<std::int64_t>(parts_.there.size()), jobs_.jobs, elapsed.count(),
                     parts_.work / static_cast<double>(jobs_.jobs));
  }

  void note(LogLevel level, const std::string& text) {
    progress_.clear();
    console_.line(level, text);
  }

  std::string quotedFolder() const { return os::quotedForShell(jobs_.path); }

  const JobFolder& jobs_;
  const Slurm& slurm_;
  const Console& console_;
  Progress& progress_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  Parts parts_;
  std::map<std::int64_t, Task> tasks_;
  bool begun_ = false, answered_ = true;
};

/// Beside the picture: "frame.parts" for frame.####.png.
std::string folderOf(const Arguments& arguments) {
  const std::string named = !arguments.output.empty() ? arguments.output
                            : arguments.files.empty() ? ""
                                                      : fs::path(arguments.files[0]).filename().string();
  fs::path folder(named);
  std::string stem = folder.stem().string();
  std::erase(stem, '#');
  while (!stem.empty() && stem.back() == '.') stem.pop_back();
  return folder.replace_filename((stem.empty() ? "farm" : stem) + ".parts").generic_string();
}

std::vector<std::string> wordsOf(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

}  // namespace

int farmCommand(const Arguments& arguments, const Console& console) {
  const JobFolder jobs = writeJobs("farm", arguments, folderOf(arguments), console);
  const Slurm slurm(jobs, wordsOf(arguments.sbatch));
  {
    Signals signals;
    signals.renderingBegins();
    Progress progress = makeProgress(arguments.progress, console);
    const bool all = Farm(jobs, slurm, console, progress).waitForParts(signals);
    progress.clear();
    if (!all) {
      console.last(
          false,
          "no picture yet: the jobs are still rendered, and the same command continues; scancel --name=" +
              jobs.arrayName() + " ends them");
      return kStopped;
    }
  }
  Arguments merging = arguments;
  merging.files = {jobs.path};
  merging.choices.clear();
  return mergeCommand(merging, console);
}

}  // namespace trace::cli
