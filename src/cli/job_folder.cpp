#include "cli/job_folder.h"

#include <algorithm>
#include <filesystem>

#include "base/files/file.h"
#include "base/hash.h"
#include "base/os/process.h"
#include "base/text.h"
#include "cli/frames.h"
#include "cli/parts.h"

namespace trace::cli {
namespace {

namespace fs = std::filesystem;

using os::quotedForShell;

/// Slurm's own limit of an array is 1001 by default, so a task of a longer list does several jobs.
constexpr std::int64_t kMostTasks = 1000;

/// The flags of the whole render, as `ray render` reads them. Threads that the environment chose are left to
/// each machine.
std::vector<std::string> flagsOf(const Arguments& arguments) {
  const bool skipsFirst = !os::variable("RAY_THREADS").empty();
  std::vector<std::string> words;
  for (std::size_t i = skipsFirst ? 1 : 0; i < arguments.choices.size(); ++i)
    words.push_back("--" + arguments.choices[i].option + "=" + arguments.choices[i].value);
  for (const std::string& folder : arguments.allowRead) words.push_back("--allow-read=" + folder);
  if (arguments.strict) words.emplace_back("--strict");
  return words;
}

std::string framesText(const std::vector<int>& frames) {
  std::string text = std::to_string(frames.front());
  if (frames.size() > 1)
    text += "-" + std::to_string(frames.back()) + "/" + std::to_string(frames[1] - frames[0]);
  return text;
}

struct Jobs {
  std::int64_t count = 1;
  std::string ray, base, folder;  ///< absolute
  std::vector<std::string> flags;
  std::string scene;
  const Arguments& arguments;
  int parts;
};

std::string renderScript(const Jobs& jobs) {
  const std::vector<int>& frames = jobs.arguments.frames;
  const std::string parts = std::to_string(jobs.parts);
  std::string flags;
  for (const std::string& flag : jobs.flags) flags += " " + quotedForShell(flag);
  std::string text = "#!/bin/sh\n# Renders one of the jobs 1 to " + std::to_string(jobs.count) +
                     ": sh render.sh 7 writes 7.part. Written by Trace.\nset -eu\n"
                     "job=$1\npart=$(((job - 1) % " +
                     parts + " + 1))\n";
  if (!frames.empty()) {
    const int step = frames.size() > 1 ? frames[1] - frames[0] : 1;
    text += "frame=$((" + std::to_string(frames.front()) + " + (job - 1) / " + parts + " * " +
            std::to_string(step) + "))\n";
    flags += " --frames \"$frame\" --fps " + toText(jobs.arguments.framesPerSecond);
  }
  return text + "folder=$(cd \"$(dirname \"$0\")\" && pwd)\nray=${RAY:-}\n[ -n \"$ray\" ] || ray=" +
         quotedForShell(jobs.ray) + "\ncd " + quotedForShell(jobs.base) + "\nexec \"$ray\" render" + flags +
         " --part \"$part/" + parts + "\" -o \"$folder/$job.part\" -- " + quotedForShell(jobs.scene) + "\n";
}

std::string makefile(const Jobs& jobs) {
  std::string text =
      "# make -j 4 renders the parts that are missing, four at a time. Written by Trace.\n"
      "PARTS =";
  for (std::int64_t job = 1; job <= jobs.count; ++job)
    text += (job % 16 == 1 ? " \\\n  " : " ") + partName(job);
  return text + "\n\nall: $(PARTS)\n%.part:\n\t@sh ./render.sh $*\n.PHONY: all\n";
}

std::string slurmScript(const Jobs& jobs, const JobFolder& folder) {
  const std::string all = std::to_string(folder.jobs), tasks = std::to_string(folder.tasks());
  return "#!/bin/sh\n"
         "# sbatch farm.slurm, in this folder, renders the parts that are missing. Written by Trace.\n"
         "# Add the flags of your cluster: sbatch --partition=... --cpus-per-task=8 farm.slurm\n"
         "#SBATCH --job-name=" +
         folder.arrayName() + "\n#SBATCH --array=1-" + tasks +
         "\n#SBATCH --requeue\n#SBATCH --open-mode=append\n#SBATCH --output=slurm-%a.log\n"
         "export RAY_THREADS=\"${SLURM_CPUS_PER_TASK:-1}\"\n"
         "job=$SLURM_ARRAY_TASK_ID\n"
         "while [ \"$job\" -le " +
         all + " ]; do\n  [ -e " + quotedForShell(jobs.folder) + "/$job.part ] || sh " +
         quotedForShell(jobs.folder) + "/render.sh \"$job\" || exit\n  job=$((job + " + tasks + "))\ndone\n";
}

void checkWord(const std::string& word) {
  if (word.find('\n') != std::string::npos)
    throw Error(Fault::usage, "expected words without line breaks, found one in \"" + word + "\"");
}

}  // namespace

std::int64_t JobFolder::tasks() const { return std::min(jobs, kMostTasks); }

std::string JobFolder::arrayName() const {
  Hash hash;
  hash.add(path);
  return "ray-" + hexText(hash.value());
}

JobFolder writeJobs(std::string_view command, const Arguments& given, const std::string& folder,
                    const Console& console) {
  Arguments arguments = given;
  const std::string usage = "ray " + std::string(command), example = usage + " SCENE --parts 8";
  if (arguments.files.size() != 1)
    throw Error(Fault::usage,
                usage + ": expected one scene, found " + std::to_string(arguments.files.size()) + " names",
                example);
  if (arguments.parts == 0 && arguments.frames.empty())
    throw Error(Fault::usage, usage + ": expected --parts N, found none", example);
  const std::string& scene = arguments.files[0];
  if (scene == "-" || folder == "-")
    throw Error(Fault::usage,
                usage + ": expected " + (scene == "-" ? "a scene in a file" : "a folder") +
                    ", found \"-\": its parts are rendered later",
                example);
  const int parts = std::max(1, arguments.parts);

  std::vector<Choice> choices = arguments.choices;
  if (!arguments.frames.empty()) choices.push_back(momentOf(arguments, arguments.frames.front()));
  Session session;
  session.open(scene, choices, arguments.strict);
  checkDivides(session, parts);
  console.warnings(session.messages().all());
  if (!arguments.frames.empty())
    for (Choice& choice : exposureOfAll(arguments)) arguments.choices.push_back(std::move(choice));

  const Jobs jobs{std::max<std::int64_t>(1, std::ssize(arguments.frames)) * parts,
                  os::programIn(os::ownFolder(), "ray"),
                  fs::current_path().generic_string(),
                  fs::absolute(folder).lexically_normal().generic_string(),
                  flagsOf(arguments),
                  scene,
                  arguments,
                  parts};
  JobFolder result{jobs.folder, jobs.count};
  PartList list{parts, jobs.flags};
  if (!arguments.frames.empty()) {
    list.words.push_back("--frames=" + framesText(arguments.frames));
    list.words.push_back("--fps=" + toText(arguments.framesPerSecond));
  }
  list.words.insert(list.words.end(), {"--", scene});
  for (const std::string& word : list.words) checkWord(word);
  for (const std::string& word : {jobs.ray, jobs.base, jobs.folder}) checkWord(word);

  if (hasPartList(folder)) {
    const PartList there = readPartList(folder);
    if (there.parts != list.parts || there.words != list.words)
      throw Error(Fault::usage,
                  "\"" + folder + "\" holds the parts of another render, which are not replaced",
                  "-o with another name writes another folder");
  }
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw Error(Fault::io, "cannot make the folder \"" + folder + "\": " + error.message());
  const auto write = [&](const char* name, const std::string& text) {
    writeFile((fs::path(folder) / name).generic_string(), text);
  };
  write("render.sh", renderScript(jobs));
  write("Makefile", makefile(jobs));
  write("farm.slurm", slurmScript(jobs, result));
  writePartList(folder, list);
  return result;
}

}  // namespace trace::cli
