// THE options table: one row for each field of Settings.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "scene/settings.h"

namespace trace {

/// The earliest step of a render that a change of the option repeats.
enum class Repeats { nothing, tone, picture, world, scene };

struct Option {
  enum class Kind { boolean, integer, real, color, choice, choices, region, file, place };

  std::string_view name;  ///< flag without "--", keyword in a scene file's settings { }
  std::string_view group;
  std::string_view unit;                ///< "" for pure numbers
  double least, most;                   ///< least and most of numbers
  std::string_view help;                ///< one sentence, no full stop
  std::string_view source;              ///< where the choice comes from; "" if it is Trace's own
  EnumSet<IntegratorKind> integrators;  ///< which it concerns
  Repeats repeats;
  bool extra;  ///< an extension that is off by default
  Kind kind;
  std::span<const std::string_view> choices;  ///< names, in the order of the enum

  std::string (*get)(const Settings&);
  void (*set)(const Option&, Settings&, std::string_view value);

  /// It concerns the integrator of the settings.
  bool concerns(const Settings& settings) const { return integrators.has(settings.integrator); }

  /// Throws Error(Fault::usage), which says what was expected and found.
  void assign(Settings& settings, std::string_view value) const { set(*this, settings, value); }
};

std::span<const Option> options();

/// The row of that name. Throws Error(Fault::usage) with a "did you mean".
const Option& findOption(std::string_view name);

/// An option given a value, and by whom.
struct Choice {
  std::string option, value;
  SourcePlace place;  ///< empty for the command line
  bool operator==(const Choice&) const = default;
};

/// Applies layers of choices in order: a later layer overrides an earlier one. Within a layer `like` comes
/// first, whatever its position, and sets every option of the group Conventions. A file that a scene names
/// lies beside the scene. Throws Error with the choice's place.
Settings resolve(std::initializer_list<std::span<const Choice>> layers);

/// Tells who gives the option its value in resolve(), whose layers are the scene file, the command line and
/// the studio: "default", the place in the file as `place` writes it, "command line" or "studio", perhaps ",
/// by like".
std::string chooserOf(const Option& option, std::initializer_list<std::span<const Choice>> layers,
                      std::string (*place)(const SourcePlace&) = placeText);

/// A colour as options have it: "0.2,0.5,1", or one number for a grey; nothing for any other text.
std::optional<Color> colorOf(std::string_view text);
std::string colorText(const Color& color);

/// Is it one of those that `like` sets?
bool isConvention(const Option& option);

/// Has the option one value in both? Other spellings of a file's name count as that file.
bool sameValue(const Option& option, const Settings& a, const Settings& b);

/// Options whose values differ from the defaults, as (name, value).
std::vector<Choice> changedOptions(const Settings& settings);

}  // namespace trace
