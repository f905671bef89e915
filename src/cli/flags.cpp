#include "cli/flags.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "app/compare/extensions.h"
#include "base/text.h"
#include "cli/text/completion.h"
#include "cli/text/manual.h"

namespace trace::cli {
namespace {

using Takes = Flag::Takes;
constexpr Verbs kRender{Verb::render}, kExplain{Verb::explain}, kDiff{Verb::diff}, kGrade{Verb::grade},
    kConvert{Verb::convert}, kStereogram{Verb::stereogram}, kComparing{Verb::diff, Verb::grade},
    kWatched{Verb::render, Verb::diff, Verb::grade, Verb::farm},
    kOfScenes{Verb::render, Verb::info,  Verb::bench,      Verb::explain, Verb::lint,
              Verb::diff,   Verb::grade, Verb::stereogram, Verb::split,   Verb::farm},
    kStrict{Verb::render, Verb::info,    Verb::bench,      Verb::explain, Verb::lint, Verb::diff,
            Verb::grade,  Verb::convert, Verb::stereogram, Verb::split,   Verb::farm},
    kWorking{Verb::render, Verb::info,       Verb::bench,   Verb::explain, Verb::lint,
             Verb::diff,   Verb::grade,      Verb::convert, Verb::texture, Verb::materials,
             Verb::expand, Verb::stereogram, Verb::split,   Verb::farm,    Verb::merge},
    kWithOutput{Verb::render,  Verb::explain,   Verb::lint,   Verb::diff,     Verb::grade,
                Verb::texture, Verb::materials, Verb::format, Verb::expand,   Verb::stereogram,
                Verb::split,   Verb::farm,      Verb::merge,  Verb::features, Verb::selftest},
    kReading{Verb::render, Verb::gui,        Verb::info,  Verb::bench,   Verb::explain,
             Verb::lint,   Verb::diff,       Verb::grade, Verb::convert, Verb::texture,
             Verb::expand, Verb::stereogram, Verb::split, Verb::farm},
    kFrames{Verb::render, Verb::split, Verb::farm}, kSplitting{Verb::split, Verb::farm},
    kAnswering{Verb::info, Verb::bench, Verb::explain, Verb::lint, Verb::diff, Verb::grade};
constexpr Verbs kEverywhere = [] {
  Verbs all;
  for (int verb = 0; verb <= static_cast<int>(Verb::help); ++verb) all.add(static_cast<Verb>(verb));
  return all;
}();
constexpr Verbs kTexture{Verb::texture}, kFeatures{Verb::features};

/// The index of the value in the names. Throws Error(Fault::usage).
template <size_t N>
size_t pick(std::string_view flag, std::string_view value, const std::array<std::string_view, N>& names) {
  const auto found = std::find(names.begin(), names.end(), value);
  if (found != names.end()) return static_cast<size_t>(found - names.begin());
  std::string expected;
  for (std::string_view name : names) expected += (expected.empty() ? "" : " | ") + std::string(name);
  throw Error(Fault::usage,
              "--" + std::string(flag) + ": expected " + expected + ", found \"" + std::string(value) + "\"",
              didYouMean(value, names));
}

void choose(Arguments& arguments, std::string_view option, std::string_view value) {
  arguments.choices.push_back({std::string(option), std::string(value), {}});
}

/// The option of that name, which must be one that can be switched on and off.
const Option& extraNamed(std::string_view flag, std::string_view name) {
  std::vector<std::string_view> names;
  for (const Option& option : options()) {
    if (enabledValue(option).empty()) continue;
    if (option.name == name) return option;
    names.push_back(option.name);
  }
  std::string all;
  for (std::string_view n : names) all += (all.empty() ? "" : ", ") + std::string(n);
  std::string hint = didYouMean(name, names);
  throw Error(Fault::usage,
              "--" + std::string(flag) + ": expected one of " + all + ", found \"" + std::string(name) + "\"",
              std::move(hint));
}

void enable(Arguments& arguments, std::string_view name) {
  choose(arguments, name, enabledValue(extraNamed("enable", name)));
}

void disable(Arguments& arguments, std::string_view name) {
  const Option& option = extraNamed("disable", name);
  choose(arguments, name, option.kind == Option::Kind::boolean ? "off" : option.get(Settings{}));
}

/// Adds to what was switched off before; the scene's own list is replaced.
void without(Arguments& arguments, std::string_view name) {
  constexpr std::string_view kOff = "switched-off";
  for (const Choice& choice : choicesWithout(name)) {
    const auto before = std::find_if(arguments.choices.rbegin(), arguments.choices.rend(),
                                     [&](const Choice& c) { return c.option == kOff; });
    const bool adds = choice.option == kOff && before != arguments.choices.rend() && before->value != "none";
    choose(arguments, choice.option, (adds ? before->value + "," : "") + choice.value);
  }
}

void set(Arguments& arguments, std::string_view value) {
  const size_t equals = value.find('=');
  if (equals == std::string_view::npos)
    throw Error(Fault::usage, "--set: expected name=value, found \"" + std::string(value) + "\"");
  choose(arguments, value.substr(0, equals), value.substr(equals + 1));
}

/// A number from `least` on.
double numberOf(std::string_view flag, std::string_view value, double least) {
  const auto number = parseNumber(value);
  if (!number || number->length != value.size() || !std::isfinite(number->value) || number->value < least)
    throw Error(Fault::usage, "--" + std::string(flag) + ": expected a number from " + toText(least) +
                                  " on, found \"" + std::string(value) + "\"");
  return number->value;
}

void setShow(Arguments& arguments, std::string_view value) {
  std::vector<std::string_view> names;
  for (const Show& show : shows()) {
    if (show.name == value) return void(arguments.show = &show);
    names.push_back(show.name);
  }
  std::string all;
  for (std::string_view name : names) all += (all.empty() ? "" : " | ") + std::string(name);
  throw Error(Fault::usage, "--show: expected " + all + ", found \"" + std::string(value) + "\"",
              didYouMean(value, names));
}

/// Errors of `use` name the flag.
template <class Use>
void withFlag(std::string_view flag, Use use) {
  try {
    use();
  } catch (const Error& error) {
    Message message = error.messages().front();
    message.what = "--" + std::string(flag) + ": " + message.what;
    throw Error(Fault::usage, {message});
  }
}

void setPrinted(Arguments& arguments, std::string_view value) {
  withFlag("print", [&] {
    for (std::size_t at = 0; at <= value.size();) {
      const std::size_t comma = std::min(value.find(',', at), value.size());
      arguments.printed.push_back(&findMetric(value.substr(at, comma - at)));
      at = comma + 1;
    }
  });
}

/// "7", "0-99" or "0-99/10".
void setFrames(Arguments& arguments, std::string_view value) {
  constexpr double kMost = 1e6;
  std::vector<int> numbers;
  std::string_view rest = value;
  bool expectsMore = true;
  for (std::string_view before : {"-", "/", ""}) {
    const auto number = rest.starts_with('-') || rest.starts_with('+') ? std::nullopt : parseNumber(rest);
    if (!number || number->value != std::floor(number->value) || number->value > kMost) break;
    numbers.push_back(static_cast<int>(number->value));
    rest.remove_prefix(number->length);
    expectsMore = !before.empty() && rest.starts_with(before);
    if (!expectsMore) break;
    rest.remove_prefix(1);
  }
  const int first = numbers.empty() ? 0 : numbers[0], last = numbers.size() > 1 ? numbers[1] : first,
            step = numbers.size() > 2 ? numbers[2] : 1;
  if (expectsMore || !rest.empty() || last < first || step < 1)
    throw Error(Fault::usage,
                "--frames: expected A-B, whole numbers from 0 to 1000000 with A <= B, found \"" +
                    std::string(value) + "\"",
                "--frames 0-99, --frames 7, or --frames 0-99/10 for every tenth");
  arguments.frames.clear();
  for (int frame = first; frame <= last; frame += step) arguments.frames.push_back(frame);
}

/// Throws Error(Fault::usage).
int wholeNumber(std::string_view flag, std::string_view value, int least, int most) {
  const auto number = parseNumber(value);
  if (!number || number->length != value.size() || number->value != std::floor(number->value) ||
      number->value < least || number->value > most)
    throw Error(Fault::usage, "--" + std::string(flag) + ": expected a whole number from " +
                                  std::to_string(least) + " to " + std::to_string(most) + ", found \"" +
                                  std::string(value) + "\"");
  return static_cast<int>(number->value);
}

constexpr int kMostParts = 1000000;

/// "2/5".
void setPart(Arguments& arguments, std::string_view value) {
  const std::size_t slash = value.find('/');
  if (slash == std::string_view::npos)
    throw Error(Fault::usage, "--part: expected K/N, as in 2/5, found \"" + std::string(value) + "\"");
  arguments.parts = wholeNumber("part", value.substr(slash + 1), 1, kMostParts);
  arguments.part = wholeNumber("part", value.substr(0, slash), 1, arguments.parts);
}

/// "512x256".
void setSize(Arguments& arguments, std::string_view value) {
  const std::size_t by = value.find('x');
  if (by == std::string_view::npos)
    throw Error(Fault::usage,
                "--size: expected WIDTHxHEIGHT, as in 512x256, found \"" + std::string(value) + "\"");
  arguments.size = std::array{wholeNumber("size", value.substr(0, by), 1, 32768),
                              wholeNumber("size", value.substr(by + 1), 1, 32768)};
}

void setOutput(Arguments& arguments, std::string_view value) {
  if (value.empty()) throw Error(Fault::usage, "--output: expected the name of a file, found nothing");
  arguments.output = value;
}

}  // namespace

std::span<const Flag> flags() {
  static constexpr std::array kTable{
      Flag{"output", 'o', Takes::value, "FILE", "", kWithOutput, true,
           "the file to write; ray COMMAND --help describes its contents", setOutput},
      Flag{"format", 0, Takes::value, "FORMAT", "", kRender, false,
           "the format of a picture that -o - writes to the standard output, by its suffix: png (the "
           "default), "
           "exr, ppm",
           [](Arguments& a, std::string_view value) { a.format = value; }},
      Flag{"frames", 0, Takes::value, "A-B", "", kFrames, true,
           "render frames A to B of an animation, or A-B/N every Nth; the picture's name holds #### for the "
           "number; frames that are there already with the same settings are skipped, but for .bmp "
           "and .tga, which cannot say how they were made",
           setFrames},
      Flag{"fps", 0, Takes::value, "X", "", kFrames, false,
           "frames per second: frame F shows the time F / X; default 24",
           [](Arguments& a, std::string_view value) {
             a.framesPerSecond = numberOf("fps", value, 0);
             if (a.framesPerSecond < 1e-6) throw Error(Fault::usage, "--fps: expected a number above 0");
           }},
      Flag{"part", 0, Takes::value, "K/N", "", kRender, false,
           "render part K of N of the picture into a file that ray merge puts together with the others; with "
           "--frames F of that frame (docs/how-to/cluster.md)",
           setPart},
      Flag{
          "parts", 0, Takes::value, "N", "", kSplitting, true,
          "the number of parts of each picture, for as many machines; default 1 with --frames, where each "
          "frame is a part",
          [](Arguments& a, std::string_view value) { a.parts = wholeNumber("parts", value, 1, kMostParts); }},
      Flag{"sbatch",
           0,
           Takes::value,
           "FLAGS",
           "",
           {Verb::farm},
           false,
           "flags for sbatch, with blanks between, as '--partition=short --cpus-per-task=8'",
           [](Arguments& a, std::string_view value) { a.sbatch = value; }},
      Flag{"resume", 0, Takes::optional, "auto|keep|never", "keep", kRender, true,
           "a stopped render continues from the checkpoint next to its picture (auto); --resume alone, or "
           "keep, also keeps the checkpoint of a finished picture, to which a larger --spp adds samples; "
           "never starts from the beginning",
           [](Arguments& a, std::string_view value) {
             constexpr std::array<std::string_view, 3> kNames{"auto", "keep", "never"};
             a.resume = static_cast<Resume>(pick("resume", value, kNames));
           }},
      Flag{"quick", 0, Takes::nothing, "", "", kOfScenes, true,
           "a quick preview: 100 pixels wide, the whole picture, depth 2, spp 1, few photons; other flags "
           "override "
           "these",
           [](Arguments& a, std::string_view) { a.quick = true; }},
      Flag{"enable", 0, Takes::value, "NAME", "", kOfScenes, true,
           "switch an extra on, with a useful value (ray features lists them)", enable},
      Flag{"disable", 0, Takes::value, "NAME", "", kOfScenes, true, "switch an extra off", disable},
      Flag{"without", 0, Takes::value, "EXTENSION", "", kOfScenes, true,
           "switch an extension off, also one that the scene itself asks for: media, spot, bump, ward and "
           "others "
           "(ray features lists them); may be repeated",
           without},
      Flag{"set", 0, Takes::value, "NAME=VALUE", "", kOfScenes, false, "give any option a value", set},
      Flag{"stats", 0, Takes::optional, "table|json", "table", kRender, true,
           "count rays, tests and time: a table on stderr, or JSON on stdout",
           [](Arguments& a, std::string_view value) {
             constexpr std::array<std::string_view, 2> kNames{"table", "json"};
             a.stats = pick("stats", value, kNames) == 0 ? StatsStyle::table : StatsStyle::json;
           }},
      Flag{"progress", 0, Takes::optional, "auto|bar|plain|json|none", "auto", kWatched, true,
           "how far it is: a bar on a terminal, else a line now and then (auto)",
           [](Arguments& a, std::string_view value) {
             constexpr std::array<std::string_view, 5> kNames{"auto", "bar", "plain", "json", "none"};
             a.progress = static_cast<ProgressStyle>(pick("progress", value, kNames));
           }},
      Flag{"camera", 0, Takes::value, "FIELDS", "", kConvert, false,
           "a camera in place of the scene's, as inside camera { } of a .ray file",
           [](Arguments& a, std::string_view value) { a.conversion.camera = value; }},
      Flag{"light", 0, Takes::value, "NODE", "", kConvert, false,
           "a light in place of the scene's, as in a .ray file; may be repeated",
           [](Arguments& a, std::string_view value) { a.conversion.lights.emplace_back(value); }},
      Flag{"material", 0, Takes::value, "FIELDS", "", kConvert, false,
           "a material for all objects, as inside material { } of a .ray file",
           [](Arguments& a, std::string_view value) { a.conversion.material = value; }},
      Flag{"digits", 0, Takes::value, "N", "", kConvert, false,
           "digits of numbers in text that count, 1 to 17; by default as many as are needed to read the same "
           "back",
           [](Arguments& a, std::string_view value) {
             a.conversion.digits = wholeNumber("digits", value, 1, 17);
           }},
      Flag{"ascii", 0, Takes::nothing, "", "", kConvert, false, "write PLY as text",
           [](Arguments& a, std::string_view) { a.conversion.ascii = true; }},
      Flag{"revolve", 0, Takes::nothing, "", "", kConvert, false,
           "the input is a profile, lines of \"x y\", to be turned about the y axis",
           [](Arguments& a, std::string_view) { a.conversion.revolve = true; }},
      Flag{"steps", 0, Takes::value, "N", "", kConvert, false,
           "steps of shapes that become triangles, and of --revolve around the axis, 3 to 100000; default "
           "64, or fewer where these would take minutes",
           [](Arguments& a, std::string_view value) {
             a.conversion.steps = wholeNumber("steps", value, 3, 100000);
           }},
      Flag{"picture", 0, Takes::value, "FILE", "", kConvert, false,
           "a picture on the surface of --revolve: once around, and once along the profile",
           [](Arguments& a, std::string_view value) { a.conversion.picture = value; }},
      Flag{"size",
           0,
           Takes::value,
           "WxH",
           "",
           {Verb::texture, Verb::materials},
           true,
           "size of the picture; default 256x256, and 960x600 for all materials",
           setSize},
      Flag{"across", 0, Takes::value, "X", "", kTexture, false,
           "how many steps of the pattern the picture is wide; default 4 for a kind, 1 for a texture of a "
           "scene",
           [](Arguments& a, std::string_view value) { a.across = numberOf("across", value, 1e-6); }},
      Flag{"pattern", 0, Takes::value, "FILE", "", kStereogram, false,
           "a picture to repeat instead of random dots",
           [](Arguments& a, std::string_view value) { a.pattern = value; }},
      Flag{"dpi", 0, Takes::value, "N", "", kStereogram, false,
           "dots an inch of the screen, for eyes 2.5 inches apart; default 72",
           [](Arguments& a, std::string_view value) { a.dotsPerInch = wholeNumber("dpi", value, 8, 10000); }},
      Flag{"relief", 0, Takes::value, "X", "", kStereogram, false,
           "position of the nearest point, as a fraction of the distance from the farthest to the eyes, 0.01 "
           "to 0.9; default 0.333",
           [](Arguments& a, std::string_view value) {
             a.stereoDepth = numberOf("relief", value, 0.01);
             if (a.stereoDepth > 0.9)
               throw Error(Fault::usage, "--relief: expected a number from 0.01 to 0.9, found \"" +
                                             std::string(value) + "\"");
           }},
      Flag{"guides", 0, Takes::nothing, "", "", kStereogram, false,
           "two dots near the lower edge: look so that they become three",
           [](Arguments& a, std::string_view) { a.guides = true; }},
      Flag{"log-level", 0, Takes::value, "error|warning|info|debug", "", kWorking, false,
           "which messages are shown; default info",
           [](Arguments& a, std::string_view value) { a.logLevel = logLevel("--log-level", value); }},
      Flag{"quiet", 'q', Takes::nothing, "", "", kWorking, true,
           "show errors only: no warnings, no progress, no last line when all went well",
           [](Arguments& a, std::string_view) {
             a.quiet = true;
             a.logLevel = LogLevel::error;
             a.progress = ProgressStyle::none;
           }},
      Flag{"strict", 0, Takes::nothing, "", "", kStrict, true, "warnings about the scene are errors",
           [](Arguments& a, std::string_view) { a.strict = true; }},
      Flag{"tolerance", 0, Takes::value, "X", "", kComparing, false,
           "differences up to this do not count as beyond; in levels of 255, or in linear values where a "
           "picture is .exr or .hdr; default 0",
           [](Arguments& a, std::string_view value) { a.tolerance = numberOf("tolerance", value, 0); }},
      Flag{"limit", 0, Takes::value, "METRIC=X", "", kComparing, false,
           "pictures are equal enough while this holds: max, mean, rmse, flip, beyond, pixels at most, psnr "
           "at "
           "least X; may be given again; without it, beyond=0",
           [](Arguments& a, std::string_view value) {
             withFlag("limit", [&] { a.limits.push_back(parseLimit(value)); });
           }},
      Flag{"show", 0, Takes::value, "heat|absolute|signed|flip", "", kDiff, false,
           "the kind of difference picture; default heat, the largest difference of a pixel in false colour",
           setShow},
      Flag{"magnify", 0, Takes::value, "X", "", kComparing, false,
           "differences are multiplied by this before they are shown; default 8",
           [](Arguments& a, std::string_view value) { a.magnify = numberOf("magnify", value, 0); }},
      Flag{"ppd", 0, Takes::value, "X", "", kComparing, false,
           "pixels per degree of the eye for which FLIP is computed; default 67",
           [](Arguments& a, std::string_view value) { a.pixelsPerDegree = numberOf("ppd", value, 1); }},
      Flag{"print", 0, Takes::value, "METRIC,METRIC", "", kDiff, false,
           "print these numbers only, on one line, for scripts", setPrinted},
      Flag{"idiff-codes", 0, Takes::nothing, "", "", kDiff, false,
           "exit with 0 identical, 1 within the limits, 2 beyond, 3 sizes differ, 4 error, as idiff does",
           [](Arguments& a, std::string_view) { a.idiffCodes = true; }},
      Flag{"scene", 0, Takes::value, "SCENE", "", kDiff, true,
           "the scene that both pictures show: render it with other conventions, without shadows, without "
           "reflections and so on, and name what makes B; options are those that A was rendered with",
           [](Arguments& a, std::string_view value) { a.scene = value; }},
      Flag{"scene", 0, Takes::value, "DIR", "", kGrade, false,
           "the folder of the scenes that the references show, of the same names: name what a program does "
           "differently with a scene, as ray diff --scene; options are those that the references were "
           "rendered "
           "with",
           [](Arguments& a, std::string_view value) { a.scene = value; }},
      Flag{"run", 0, Takes::value, "COMMAND", "", kGrade, false,
           "with --class and --scene: run each student's own program on each scene, in a sandbox; a command "
           "for "
           "the student's folder, in which {scene} and {out} stand for the files, as './ray {scene} {out}'",
           [](Arguments& a, std::string_view value) { a.run = value; }},
      Flag{"unsandboxed", 0, Takes::nothing, "", "", kGrade, false,
           "run the students' programs in your account, where they cannot be kept apart; they can then read "
           "and "
           "delete your files (docs/security.md)",
           [](Arguments& a, std::string_view) { a.unsandboxed = true; }},
      Flag{"allow-read", 0, Takes::value, "DIR", "", kReading, false,
           "also let the scene read the files below this folder; without it only those below its own "
           "(docs/security.md); may be given several times",
           [](Arguments& a, std::string_view value) { a.allowRead.emplace_back(value); }},
      Flag{"reference", 0, Takes::value, "DIR", "", kGrade, false,
           "folder of the pictures that should have come out",
           [](Arguments& a, std::string_view value) { a.reference = value; }},
      Flag{"render", 0, Takes::nothing, "", "", kGrade, false,
           "render the scenes of the folder, with the options given, instead of reading pictures",
           [](Arguments& a, std::string_view) { a.renderScenes = true; }},
      Flag{"class", 0, Takes::nothing, "", "", kGrade, false,
           "DIR has a folder for each student: one page of all, a table beside it as .csv, and points",
           [](Arguments& a, std::string_view) { a.ofClass = true; }},
      Flag{"rubric", 0, Takes::value, "FILE", "", kGrade, false,
           "with --class: the points of each scene, and the share that a picture with a mistake keeps; by "
           "default each scene is worth 1 point",
           [](Arguments& a, std::string_view value) { a.rubric = value; }},
      Flag{"scene-limit", 0, Takes::value, "SECONDS", "", kGrade, false,
           "a scene that takes longer to render is stopped, and the next one begins; default 0, no limit; "
           "with "
           "--run the student's program, default 60",
           [](Arguments& a, std::string_view value) { a.sceneLimit = numberOf("scene-limit", value, 0); }},
      Flag{"pixel", 0, Takes::value, "X,Y", "", kExplain, true,
           "the pixel to explain; 0,0 is at the top left",
           [](Arguments& a, std::string_view value) { a.pixel = value; }},
      Flag{"sample", 0, Takes::value, "K", "", kExplain, true,
           "which of the pixel's camera rays; default 0, the first",
           [](Arguments& a, std::string_view value) { a.sample = value; }},
      Flag{"light-image", 0, Takes::nothing, "", "", kExplain, false,
           "also compute the light image of bdpt in the pixel, and its paths; takes about half as long as a "
           "render of the picture",
           [](Arguments& a, std::string_view) { a.lightImage = true; }},
      Flag{"format", 0, Takes::value, "text|json|obj|svg|png", "", kAnswering, true,
           "how the answer looks; default text. obj, svg and png are drawings of rays, of ray explain only",
           [](Arguments& a, std::string_view value) { a.format = value; }},  // each command knows its own
      Flag{"in-place",
           'i',
           Takes::nothing,
           "",
           "",
           {Verb::format},
           false,
           "write the tidied text back to the file that it was read from",
           [](Arguments& a, std::string_view) { a.inPlace = true; }},
      Flag{"markdown",
           0,
           Takes::nothing,
           "",
           "",
           {Verb::convert, Verb::features, Verb::texture},
           false,
           "print docs/options.md, or of texture docs/texture-fields.md, or of convert docs/formats.md",
           [](Arguments& a, std::string_view) { a.markdown = true; }},
      Flag{"completion", 0, Takes::value, "bash|zsh|fish", "", kFeatures, false,
           "print the completion of that shell for ray and ray-studio (docs/install.md)",
           [](Arguments& a, std::string_view value) {
             a.completion = kShells[pick("completion", value, kShells)];
           }},
      Flag{"man", 0, Takes::optional, "ray|ray-studio", "ray", kFeatures, false,
           "print the page of the program for man: ray features --man | man -l -",
           [](Arguments& a, std::string_view value) { a.manual = kManuals[pick("man", value, kManuals)]; }},
      Flag{
          "examples",
          0,
          Takes::value,
          "FOLDER",
          "",
          {Verb::features},
          false,
          "make the page of all extensions and its pictures in the folder of -o, from the scenes in this one",
          [](Arguments& a, std::string_view value) { a.examples = value; }},
      Flag{"print-defaults", 0, Takes::nothing, "", "", kRender, false,
           "print every option as NAME=VALUE with its default, and end",
           [](Arguments& a, std::string_view) { a.printDefaults = true; }},
      Flag{"help", 'h', Takes::optional, "all", "common", kEverywhere, true,
           "print this page, after a command the page of that; with \"all\" every flag, its range and source",
           [](Arguments& a, std::string_view value) {
             constexpr std::array<std::string_view, 2> kNames{"common", "all"};
             a.help = true;
             a.helpAll = pick("help", value, kNames) == 1;
           }},
      Flag{"version", 0, Takes::nothing, "", "", kEverywhere, false, "print the version",
           [](Arguments& a, std::string_view) { a.version = true; }},
  };
  return kTable;
}

bool takesOptions(Verb command) { return command == Verb::gui || kOfScenes.has(command); }

bool takesOption(Verb command, const Option& option) {
  const bool limit = option.name == "time-limit" || option.name == "max-memory";
  const bool moment = option.name == "time" && (command == Verb::expand || command == Verb::convert);
  return takesOptions(command) || (limit && kWorking.has(command)) || moment;
}

std::string_view enabledValue(const Option& option) {
  if (option.kind == Option::Kind::boolean) return "on";
  constexpr std::pair<std::string_view, std::string_view> kUseful[] = {{"spp", "9"},
                                                                       {"irradiance-cache", "0.2"},
                                                                       {"sampling", "stratified"},
                                                                       {"filter", "mitchell"},
                                                                       {"aperture", "0.1"},
                                                                       {"exposure", "1"},
                                                                       {"white-balance", "3200"},
                                                                       {"transfer", "srgb"},
                                                                       {"bloom", "0.1"},
                                                                       {"projection", "panorama"},
                                                                       {"distortion", "0.2"},
                                                                       {"stereo", "side-by-side"},
                                                                       {"threshold", "0.003"},
                                                                       {"nested-glass", "on"},
                                                                       {"wavelengths", "9"},
                                                                       {"outlines", "2"},
                                                                       {"noise-target", "0.004"},
                                                                       {"subdivide", "3"},
                                                                       {"integrator", "path"},
                                                                       {"firefly-limit", "4"},
                                                                       {"light-vertices", "1"},
                                                                       {"camera-vertices", "1"},
                                                                       {"chains", "veach"},
                                                                       {"light-choices", "4"},
                                                                       {"lamp-samples", "4"},
                                                                       {"ambient-occlusion", "16"},
                                                                       {"caustics", "200000"},
                                                                       {"caustic-texels", "1000"},
                                                                       {"fog", "0.05"},
                                                                       {"shutter", "0.04"}};
  for (const auto& [name, value] : kUseful)
    if (name == option.name) return value;
  return {};
}

}  // namespace trace::cli
