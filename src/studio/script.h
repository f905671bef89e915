// Drives the studio from a file, one command a line: for tests and for the pictures of the manual.
#pragma once

#include <string>
#include <vector>

#include "base/budget.h"
#include "studio/studio.h"

namespace trace::studio {

class Script {
 public:
  /// Throws Error with every mistake that shows before anything runs, by file and line.
  /// `timeLimit`, in seconds from now on, is for the whole script; 0 for none.
  explicit Script(const std::string& file, double timeLimit = 0);

  /// Called after each frame: does the next commands up to one that needs frames, or waits for what the last
  /// one began. False at the end. Throws Error with file and line if a command fails, and
  /// Error(Fault::limit) at the one that is being done when the time is over.
  bool step(Studio& studio);
  /// The script waits for something that needs no frame.
  bool waits() const { return waits_; }

 private:
  struct Line {
    SourcePlace place;
    std::vector<std::string> words;
  };
  bool next(Studio& studio);

  std::vector<Line> lines_;
  std::size_t next_ = 0;
  int framesToWait_ = 0;
  bool waits_ = false;
  Budget budget_;
};

std::string scriptHelp();

}  // namespace trace::studio
