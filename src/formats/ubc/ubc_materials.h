// The materials of a scene of British Columbia.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "formats/ubc/ubc_values.h"
#include "scene/scene.h"

namespace trace::ubc {

class MaterialReader {
 public:
  /// Both must live longer.
  MaterialReader(Values& values, Scene& scene) : values_(values), scene_(scene) {}

  /// Reads one, after its command.
  void material();
  /// The number of the one whose name comes next.
  std::uint32_t named();
  /// Some material says how dark its shadow is.
  bool givesShadow() const { return givesShadow_; }

 private:
  void texture(const Parameter& p, Material& material);

  Values& values_;
  Scene& scene_;
  bool givesShadow_ = false;
  std::map<std::string, std::uint32_t, std::less<>> numbers_;
};

}  // namespace trace::ubc
