// Facts that only the text of a .ray file has, and a Scene does not keep: for advice and lint.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "scene/scene.h"

namespace trace {

struct RayRemarks {
  struct Angle {
    SourcePlace place;  ///< place of the number, with its line
    double value = 0;
  };
  /// Angles of rotate() beyond a whole turn that are whole or half numbers, as degrees are and radians hardly
  /// ever; in the order of the file. Angles that change with time are left out.
  std::vector<Angle> degrees;
  /// A name that the file defines and never uses. In a file that includes others, of parameters alone.
  struct Unused {
    SourcePlace place;
    std::string name;
    bool isParameter = false;
  };
  std::vector<Unused> unused;
  /// How a light says its strength, as far as plain numbers do.
  struct Strength {
    SourcePlace place;             ///< position of the light
    bool says = true;              ///< false: by an expression
    double power = 0;              ///< watts; 0: none given
    std::optional<Color> color{};  ///< nothing if none is given
  };
  std::vector<Strength> lights;
  bool isOfKind = false;  ///< the file begins with `Trace 1`
  SourcePlace camera;     ///< position of the last camera, which counts; only the file if there is none
};

/// Throws Error(Fault::scene) where the syntax is wrong.
RayRemarks remarksOn(const std::string& file, std::string_view bytes);
/// Those on the file of the scene: none of another format, or where the file is gone.
RayRemarks remarksOn(const Scene& scene);

}  // namespace trace
