// ray split SCENE --parts N: a folder with the jobs of a render, for many machines (job_folder.h).
#include <filesystem>

#include "cli/commands/commands.h"
#include "cli/job_folder.h"

namespace trace::cli {

int splitCommand(const Arguments& arguments, const Console& console) {
  const std::string scene = arguments.files.empty() ? "" : arguments.files[0];
  const std::string folder = !arguments.output.empty()
                                 ? arguments.output
                                 : std::filesystem::path(scene).stem().generic_string() + ".parts";
  const std::int64_t jobs = writeJobs("split", arguments, folder, console).jobs;
  console.last(true, "wrote " + folder + " (" + std::to_string(jobs) + (jobs == 1 ? " part" : " parts") +
                         "); next: make -C " + folder + " -j 4, then ray merge " + folder);
  return kDone;
}

}  // namespace trace::cli
