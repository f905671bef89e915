// Which objects a light lights (light linking, as production renderers call it): the light says it, or the
// object, or both. An object is lit by a light if neither objects. A light also says whether it casts
// shadows.
#pragma once

#include <string>
#include <tuple>
#include <vector>

#include "base/field.h"

namespace trace {

struct LightLinks {
  std::string name;                     ///< name of the light; may be empty
  std::vector<std::string> lights{};    ///< names of the objects that it lights; none: all
  std::vector<std::string> excludes{};  ///< names of objects that it does not light
  bool castsShadows = true;             ///< off: nothing blocks its light

  static constexpr auto fields() {
    return Fields{Field{"name", &LightLinks::name, "", -kNoLimit, kNoLimit, "name of the light"},
                  Field{"lights", &LightLinks::lights, "", -kNoLimit, kNoLimit,
                        "names of the objects that it lights; none: all"},
                  Field{"excludes", &LightLinks::excludes, "", -kNoLimit, kNoLimit,
                        "names of objects that it does not light"},
                  Field{"casts_shadows", &LightLinks::castsShadows, "", -kNoLimit, kNoLimit,
                        "off: nothing blocks its light"}};
  }
  bool operator==(const LightLinks&) const = default;
};

/// The same, as an object says it.
struct ObjectLinks {
  std::vector<std::string> litBy{};     ///< names of the lights that light it; none: all
  std::vector<std::string> notLitBy{};  ///< names of lights that do not

  static constexpr auto fields() {
    return Fields{Field{"lit_by", &ObjectLinks::litBy, "", -kNoLimit, kNoLimit,
                        "names of the lights that light it; none: all"},
                  Field{"not_lit_by", &ObjectLinks::notLitBy, "", -kNoLimit, kNoLimit,
                        "names of lights that do not light it"}};
  }
  bool operator==(const ObjectLinks&) const = default;
};

}  // namespace trace
