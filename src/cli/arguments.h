// The command line as data: files, choices of options, and the program's own flags.
//
// Words of the command line → parse() → Arguments → a sub-command. The flags that set options come from
// THE options table (scene/options.h); the others from the table in flags.cpp.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "app/compare/difference.h"
#include "base/enum_set.h"
#include "cli/terminal/console.h"
#include "cli/terminal/progress.h"
#include "image/comparison/flip.h"
#include "scene/options.h"

namespace trace::cli {

/// The sub-commands, in the order of their table (commands.h); help is the last.
enum class Verb {
  render,
  gui,
  info,
  bench,
  explain,
  lint,
  diff,
  grade,
  convert,
  texture,
  materials,
  newScene,
  format,
  expand,
  stereogram,
  split,
  farm,
  merge,
  features,
  selftest,
  help
};
using Verbs = EnumSet<Verb>;

enum class StatsStyle { none, table, json };

/// Whether a render continues from the checkpoint beside its picture, and whether it keeps it at the end.
enum class Resume { goOn, keep, never };

/// The flags of `ray convert`.
struct Conversion {
  std::string camera, material;     ///< the inside of a block of a .ray file; empty to keep the scene's
  std::vector<std::string> lights;  ///< whole nodes of a .ray file; empty to keep the scene's
  int digits = 0;                   ///< 0 for as many as are needed
  int steps = 0;                    ///< steps of shapes that become triangles; 0 for the default
  std::string picture;              ///< on what --revolve makes; empty for none
  bool ascii = false, revolve = false;
};

struct Arguments {
  std::vector<std::string> files;      ///< words that are no flags, in order
  std::vector<Choice> choices;         ///< choices of options, in order
  std::vector<std::string> allowRead;  ///< --allow-read: folders and files that a scene may read
  std::string output;                  ///< --output; may be empty
  ProgressStyle progress = ProgressStyle::automatic;
  LogLevel logLevel = LogLevel::info;
  StatsStyle stats = StatsStyle::none;
  std::vector<int> frames;  ///< --frames, in order; empty for one picture
  double framesPerSecond = 24;
  int part = 0;        ///< render: K of --part K/N, from 1 on; 0 for the whole picture
  int parts = 0;       ///< render: N of --part K/N; split and farm: --parts; 0 if neither is given
  std::string sbatch;  ///< farm: --sbatch, flags with blanks between; may be empty
  Resume resume = Resume::goOn;
  Conversion conversion;
  bool strict = false;
  bool quick = false;
  bool plain = false;  ///< -b: one ray a pixel, and no early stop that the scene asks for
  bool quiet = false;
  std::optional<std::string> format;  ///< --format
  bool toStdout = false;              ///< render: the picture then goes to the standard output
  std::string pixel;                  ///< explain: --pixel, as typed
  std::string sample;                 ///< explain: --sample, as typed
  bool lightImage = false;            ///< explain: --light-image
  bool inPlace = false;               ///< format: --in-place
  bool markdown = false;              ///< features: as docs/options.md; convert: docs/formats.md
  std::string examples;               ///< features: --examples, the folder of the scenes
  std::string_view completion;        ///< features: the shell of --completion; may be empty
  std::string_view manual;            ///< features: the program of --man; may be empty
  /// texture and materials: --size, width and height
  std::optional<std::array<int, 2>> size{};
  std::optional<double> across;  ///< texture: --across, steps of the pattern
  // stereogram
  std::string pattern;           ///< a picture, repeated instead of dots
  double dotsPerInch = 72;       ///< dots per inch of the screen
  double stereoDepth = 1.0 / 3;  ///< StereogramRules::depth
  bool guides = false;
  // diff and grade
  double tolerance = 0;  ///< levels or values
  std::vector<Limit> limits;
  const Show* show = &shows().front();
  double magnify = 8;
  double pixelsPerDegree = usualPixelsPerDegree();
  std::vector<const Metric*> printed;  ///< --print
  bool idiffCodes = false;
  std::string scene;          ///< diff: --scene; grade: the folder of scenes; may be empty
  std::string reference;      ///< a folder
  bool renderScenes = false;  ///< --render
  bool ofClass = false;       ///< --class
  std::string rubric;         ///< a file; may be empty
  double sceneLimit = 0;      ///< seconds
  std::string run;            ///< grade: the command of students' programs; may be empty
  bool unsandboxed = false;   ///< grade
  bool help = false, helpAll = false, version = false, printDefaults = false;
};

/// The sub-command decides which flags are known. The environment variables RAY_THREADS and RAY_LOG stand for
/// flags at the very beginning. Throws Error(Fault::usage).
Arguments parse(const std::vector<std::string>& words, Verb command);

}  // namespace trace::cli
