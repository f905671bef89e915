// All that explains why two pictures differ: a picture of one colour, a change of the whole picture, and what
// variants of the scene show. What `ray diff` and `ray grade` say below their numbers.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/compare/diff_cause.h"
#include "app/compare/difference.h"
#include "app/compare/scene_cause.h"

namespace trace {

struct Causes {
  std::optional<Color> referenceColor, testColor;  ///< if all its pixels have it
  bool isGrey = false;                             ///< the test has no colours, and the reference has
  bool isNegative = false;
  std::optional<DifferenceCause> picture;
  std::optional<SceneCauses> scene;
  std::string
      noScene;  ///< why the scene was not looked at: "the sizes differ"; "" if it was, or none is given
  std::string stopped;  ///< why the causes were not sought to the end; "" if they were

  /// Sentences without full stops: what is plain to see, such as a picture of one colour.
  std::vector<std::string> notes(const std::string& reference, const std::string& test,
                                 std::string_view unit) const;
};

/// Finds what explains the difference, until the time is over. What is cheap to find comes first, and the
/// scene is not searched where that explains everything. If both a change of the picture and a variant of the
/// scene explain the test, the one that leaves less is kept. `question` is null if the scene is not known.
Causes causesOf(const PictureDifference& difference, const SceneQuestion* question);

}  // namespace trace
