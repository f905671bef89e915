#include "scene/short_flags.h"

#include <algorithm>
#include <array>

namespace trace {

std::span<const ShortFlag> shortFlags() {
  static constexpr std::array kTable{
      ShortFlag{'w', "width", "", ""},
      ShortFlag{'r', "depth", "", ""},
      ShortFlag{'t', "threads", "", ""},
      ShortFlag{'c', "environment", "", ""},
      ShortFlag{kPlainFlag, "accel", "bvh", "acceleration on"},
      ShortFlag{'B', "accel", "none", "acceleration off"},
      ShortFlag{'a', "spp", "9", "anti-aliasing on"},
      ShortFlag{'A', "spp", "1", "anti-aliasing off"},
  };
  return kTable;
}

std::span<const Choice> plainChoices() {
  static const std::array<Choice, 5> kChoices{{{"spp", "1", {}},
                                               {"threshold", "0", {}},
                                               {"noise-target", "0", {}},
                                               {"subdivide", "0", {}},
                                               {"denoise", "off", {}}}};
  return kChoices;
}

bool isSwitch(std::string_view word) {
  constexpr std::string_view kWords[] = {"on", "off", "true", "false", "yes", "no"};
  return std::find(std::begin(kWords), std::end(kWords), word) != std::end(kWords);
}

}  // namespace trace
