// The command line of ray-studio.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "scene/options.h"

namespace trace::studio {

struct Arguments {
  std::string scene;                        ///< may be empty
  std::string reference;                    ///< --reference; may be empty
  std::string script;                       ///< --script; may be empty
  std::optional<std::array<int, 2>> pixel;  ///< --pixel
  int width = 0, height = 0;                ///< --window; 0: as it was last
  std::vector<Choice> choices;              ///< choices of options; they hold for every scene that is opened
  std::vector<std::string> allowRead;       ///< --allow-read: folders that scenes may read besides their own
  bool help = false, version = false;
};

/// Throws Error(Fault::usage).
Arguments parse(const std::vector<std::string>& words);

std::string helpText();

}  // namespace trace::studio
