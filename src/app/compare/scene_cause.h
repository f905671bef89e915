// The variant of a scene that explains why a picture of it differs from the reference: no shadows, another
// convention, one bounce less. What `ray diff --scene` adds to the cause of the whole picture
// (app/compare/diff_cause.h).
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "app/compare/diff_cause.h"
#include "app/compare/pixel_cause.h"
#include "base/error.h"
#include "scene/input_files.h"
#include "scene/options.h"

namespace trace {

struct SceneQuestion {
  std::string file{};             ///< the scene
  std::vector<Choice> choices{};  ///< options with which the reference was rendered
  bool strict = false;
  double seconds = 30;  ///< the most that the variants may take; 0 for no limit of their own
};

/// How a picture comes out of a scene.
struct SceneMatch {
  std::vector<std::string> variants;  ///< variants of variantsOf(), each upon those before; none: as it is
  PictureChange change;               ///< the change of the picture, after that
  /// The difference that is left, beyond that of rounding to levels, in the unit of the picture.
  double rmse = 0;
  /// Other variants than the last that give the same picture: "with directional lights from the opposite
  /// side". Few are named, and none next to an option.
  std::vector<std::string> alike{};

  /// "with --like ut, without shadows and upside down"; "" for the scene as it is.
  std::string text() const;
};

struct SceneCauses {
  std::string file;
  std::size_t pixels = 0;               ///< number of pixels that were traced, evenly spaced, of each variant
  std::size_t tried = 0, variants = 0;  ///< variants that were rendered, of all
  std::string stopped;                  ///< why it was not all of them; "" if it was
  std::string unit;                     ///< "levels" or "values"
  /// The variants that make each of the two pictures; nothing if none does.
  std::optional<SceneMatch> reference, test;
  std::optional<SceneMatch> nearest;  ///< the variant that leaves least of the test, if nothing makes it
  bool isOutdone = false;             ///< a change of the whole picture explains the test better
  /// The difference of the test and the scene as it makes the reference; infinite if the sizes differ.
  double rmse = 0;
  std::optional<PixelCause> pixel;  ///< explains the pixel that differs most
  std::vector<Message> warnings;    ///< warnings about the scene
  InputFiles inputs;                ///< files that the scene was read from
};

/// Renders the scene in the size of the reference, with the variants of app/compare/scene_variants.h one by
/// one, with other values (app/compare/scene_values.h) where none of these suffices, and two at a time where
/// one helps. Each is compared with the pictures by the rule of causeOfDifference(). Variants that make the
/// reference hold for the test too. `worst` is the pixel to explain. If the time of the thread's budget or of
/// the question is over, what was found by then is returned. A match leaves at most half of the difference of
/// the pixels, a nearest variant three quarters. Nothing if the pictures cannot be compared, or are too
/// small. Throws Error if the scene cannot be read or built.
std::optional<SceneCauses> sceneCauses(const SceneQuestion& question, const LoadedPicture& reference,
                                       const LoadedPicture& test, const PixelPlace& worst);

/// Sentences without full stops: what makes the test, what makes the reference if that is not the scene as it
/// is, how far the search came, and what the worst pixel lacks.
std::vector<std::string> sceneSentences(const SceneCauses& causes, const std::string& reference,
                                        const std::string& test);

}  // namespace trace
