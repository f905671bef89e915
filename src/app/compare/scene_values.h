// Values of a scene that another program may have read or kept otherwise: a colour of a material or of a
// light, a shininess, an index of refraction, the field of view. `ray diff --scene` looks for the value that
// makes a picture (app/compare/scene_cause.h).
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/compare/difference.h"
#include "app/compare/scene_variants.h"

namespace trace {

struct SceneValue {
  std::string keyword, owner;  ///< "diffuse" and "ball"
  std::function<void(Scene&, const Color&)> assign;
  /// Takes away all that the value acts on, as specular of a shininess; none if that is everything.
  std::function<void(Scene&)> silence{};
  Color now;  ///< a number stands in all channels
  bool isColor = true;
  // For numbers:
  Real least = 0, most = 0;
  Real step = 2;  ///< the ratio of the values that are tried first

  /// "with diffuse (0.2, 0.2, 0.8) in ball"
  std::string text(const Color& value) const;
};

/// Those of up to 16 materials and 8 lights, then the field of view.
std::vector<SceneValue> valuesOf(const Scene& scene);

/// The picture to be made, and how the scene shows.
struct ValueSearch {
  const Scene& scene;
  const Picture& light;  ///< the light of the scene
  const LoadedPicture& wanted;
  std::function<Picture(const Scene&)> trace;  ///< the light of a scene
  std::function<LoadedPicture(const Picture&)>
      shownAsWanted;  ///< light as the kind of picture that is wanted
};

/// The scene with another value, if one makes most of the wanted picture: it leaves at most a fifth of the
/// RMSE. Light is linear in most colours, so the first guess is good, and is improved where it is not.
std::optional<SceneVariant> fittedVariant(const SceneValue& value, const ValueSearch& search);

}  // namespace trace
