// One picture, or the frames of an animation, by many machines: `ray split` writes a folder of jobs, each job
// is a `ray render --part K/N`, and `ray merge` puts their files together.
//
// A part is every Nth tile of the picture with all its samples, and the light that these bring to other
// tiles, which is summed in whole numbers. So any order of the parts gives the bits of one machine.
#pragma once

#include <string>
#include <vector>

#include "app/session/session.h"
#include "cli/arguments.h"
#include "cli/terminal/console.h"

namespace trace::cli {

/// The work that a folder is for.
struct PartList {
  int parts = 1;                   ///< the number of parts of each picture
  std::vector<std::string> words;  ///< the words of `ray render` for the whole: flags, "--" and the scene
};
/// Throws Error(Fault::io).
void writePartList(const std::string& folder, const PartList& list);
/// Throws Error(Fault::io), with the line if the file is no such list.
PartList readPartList(const std::string& folder);
bool hasPartList(const std::string& folder);

/// The file of job 1, 2, ...: "7.part". Jobs are the parts of the first picture, then those of the next.
std::string partName(std::int64_t job);
/// "1, 2 and 5"; many numbers end with how many more there are.
std::string numbersText(const std::vector<std::int64_t>& numbers);

/// Throws Error(Fault::usage) if the session's picture cannot be divided into so many parts that give the
/// same bits together.
void checkDivides(const Session& session, int parts);

/// ray render --part K/N: renders one part into `output`, or a name made from the scene's. Returns the exit
/// code. Throws Error.
int renderPart(const Arguments& arguments, const std::string& output, const Console& console);

}  // namespace trace::cli
