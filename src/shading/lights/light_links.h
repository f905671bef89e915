// Which objects a light lights (light linking, as production renderers call it).
#pragma once

#include <string>
#include <tuple>
#include <vector>

#include "base/field.h"

namespace trace {

struct LightLinks {
  std::string name;                     ///< of the light; may be empty
  std::vector<std::string> lights{};    ///< names of the objects that it lights; none: all
  std::vector<std::string> excludes{};  ///< names of objects that it does not light

  static constexpr auto fields() {
    return Fields{
        Field{"name", &LightLinks::name, "", -kNoLimit, kNoLimit, "by which it is told from others"},
        Field{"lights", &LightLinks::lights, "", -kNoLimit, kNoLimit,
              "names of the objects that it lights; none: all"},
        Field{"excludes", &LightLinks::excludes, "", -kNoLimit, kNoLimit,
              "names of objects that it does not light"}};
  }
  bool operator==(const LightLinks&) const = default;
};

}  // namespace trace
