// The folder of jobs that `ray split` and `ray farm` write for many machines (parts.h): parts.list, which
// ray merge reads; render.sh, which renders one job; a Makefile; and farm.slurm, a job array.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "cli/arguments.h"
#include "cli/terminal/console.h"

namespace trace::cli {

struct JobFolder {
  std::string path;       ///< absolute
  std::int64_t jobs = 1;  ///< numbered from 1 on; job 7 writes 7.part

  /// The tasks of the job array, numbered from 1 on: task T renders the jobs T, T + tasks(), ...
  std::int64_t tasks() const;
  /// The name of the job array, which no other folder has.
  std::string arrayName() const;
};

/// Writes the folder, or again what is there of this render. `command`, split or farm, stands in messages.
/// Throws Error; Error(Fault::usage) if the folder holds the parts of another render.
JobFolder writeJobs(std::string_view command, const Arguments& arguments, const std::string& folder,
                    const Console& console);

}  // namespace trace::cli
