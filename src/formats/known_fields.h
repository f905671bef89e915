// THE table of the fields of other programs' formats, each with how Trace treats it: docs/formats.md is made
// from it, and tests/formats has a probe for each row (tests/formats/probes.h).
//
// Readers report a field without a row as unknown.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace trace {

struct KnownField {
  enum class Fate {
    shown,     ///< what a picture shows depends on it
    reported,  ///< it is left out, with one warning for all of its kind, at the place of the first
    refused,   ///< a file that needs it is not read, and the error says so
    idle,      ///< it says nothing about a still picture, and nothing is said of it
  };

  std::string_view field;  ///< as the format writes it
  Fate fate = Fate::shown;
  std::string_view becomes;  ///< what it is in Trace, or why it is not shown; may be empty
};

namespace known {
inline constexpr auto kShown = KnownField::Fate::shown, kReported = KnownField::Fate::reported,
                      kRefused = KnownField::Fate::refused, kIdle = KnownField::Fate::idle;
}  // namespace known

struct KnownFormat {
  std::string_view name;   ///< as in sceneFormats() or pictureFormats()
  std::string_view title;  ///< with the version that is meant
  std::string_view text;   ///< a short paragraph of Markdown
  std::span<const KnownField> fields;
};

/// Scene formats first, then picture formats.
std::span<const KnownFormat> knownFormats();

/// The rows, by format, each in a file of its own (known_fields_*.cpp).
std::span<const KnownField> knownObjFields();
std::span<const KnownField> knownMtlFields();
std::span<const KnownField> knownPlyFields();
std::span<const KnownField> knownStlFields();
std::span<const KnownField> knownOffFields();
std::span<const KnownField> knownGltfFields();
std::span<const KnownField> knownGltfExtensionFields();
std::span<const KnownField> knownInventorFields();
std::span<const KnownField> knownVrml97Fields();
std::span<const KnownField> knownPngFields();
std::span<const KnownField> knownJpegFields();
std::span<const KnownField> knownBmpFields();
std::span<const KnownField> knownTgaFields();
std::span<const KnownField> knownHdrFields();
std::span<const KnownField> knownExrFields();
std::span<const KnownField> knownPpmFields();
std::span<const KnownField> knownPfmFields();
std::span<const KnownField> knownWebpFields();

/// The file docs/formats.md.
std::string formatsMarkdown();

}  // namespace trace
