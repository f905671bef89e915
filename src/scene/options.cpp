// THE table of options. One file, for a row makes everything of an option, and all rows are read together.
#include "scene/options.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <type_traits>

#include "base/files/file.h"
#include "base/text.h"
#include "geometry/shape.h"
#include "scene/conventions.h"
#include "scene/integrators.h"
#include "scene/option_words.h"
#include "scene/quality.h"
#include "scene/scene_features.h"

namespace trace {
namespace {

// --- names of the choices, in the order of each enum --------------------------------------------------

using Names = std::span<const std::string_view>;
template <class Enum>
constexpr std::array<std::string_view, 0> kNames{};
template <>
constexpr std::array<std::string_view, 2> kNames<Accel>{"bvh", "none"};
template <>
constexpr std::array<std::string_view, 4> kNames<Quality>{"none", "draft", "good", "final"};
template <>
constexpr std::array<std::string_view, 3> kNames<Chains>{"bdpt", "path", "veach"};
template <>
constexpr std::array<std::string_view, 4> kNames<Mutation>{"bidirectional", "lens", "caustic", "multi-chain"};
template <>
constexpr std::array<std::string_view, 7> kNames<SampleKind>{"grid",   "random", "jittered", "stratified",
                                                             "halton", "sobol",  "blue"};
template <>
constexpr std::array<std::string_view, 5> kNames<FilterKind>{"box", "tent", "gaussian", "mitchell",
                                                             "blackman-harris"};
template <>
constexpr std::array<std::string_view, 5> kNames<Projection>{"perspective", "orthographic", "fisheye",
                                                             "panorama", "cylinder"};
template <>
constexpr std::array<std::string_view, 8> kNames<Stereo>{
    "off", "side-by-side", "cross-eyed", "over-under", "red-cyan", "half-color", "grey", "dubois"};
template <>
constexpr std::array<std::string_view, 7> kNames<Like>{"uw",  "uw2009", "uw2001", "ut",
                                                       "ubc", "uw1998", "usc"};
template <>
constexpr std::array<std::string_view, 2> kNames<Highlight>{"blinn", "phong"};
template <>
constexpr std::array<std::string_view, 2> kNames<Glass>{"per-crossing", "per-distance"};
template <>
constexpr std::array<std::string_view, 3> kNames<Fresnel>{"constant", "schlick", "exact"};
template <>
constexpr std::array<std::string_view, 3> kNames<NestedGlass>{"by-priority", "on", "off"};
template <>
constexpr std::array<std::string_view, 2> kNames<GlassShadows>{"filtered", "black"};
template <>
constexpr std::array<std::string_view, 2> kNames<MirrorDefault>{"specular", "zero"};
template <>
constexpr std::array<std::string_view, 2> kNames<Models>{"as-said", "phong"};
template <>
constexpr std::array<std::string_view, 3> kNames<BackFaces>{"both", "cull-seen", "cull-all"};
template <>
constexpr std::array<std::string_view, 3> kNames<PixelPosition>{"corner", "center", "border"};
template <>
constexpr std::array<std::string_view, 2> kNames<VertexNormals>{"unit", "mean"};
template <>
constexpr std::array<std::string_view, 2> kNames<DiffuseSides>{"front", "both-on-glass"};
template <>
constexpr std::array<std::string_view, 4> kNames<CameraAxes>{"orthonormal", "raw", "normalized", "skewed"};
template <>
constexpr std::array<std::string_view, 5> kNames<Tone>{"clamp", "stretch", "reinhard", "filmic", "agx"};
template <>
constexpr std::array<std::string_view, 2> kNames<Transfer>{"linear", "srgb"};
template <>
constexpr std::array<std::string_view, 2> kNames<Rounding>{"truncate", "nearest"};
template <>
constexpr std::array<std::string_view, 4> kNames<EnvironmentKind>{"auto", "lat-long", "angular", "cube"};
template <>
constexpr std::array<std::string_view, 15> kNames<Pass>{
    "depth",  "normal", "id",       "uv",     "position", "samples", "albedo",  "occlusion",
    "change", "object", "material", "direct", "indirect", "motion",  "variance"};
template <>
constexpr std::array<std::string_view, 2> kNames<PassColors>{"grey", "heat"};
template <>
constexpr std::array<std::string_view, 2> kNames<PassName>{"dot", "underscore"};
template <>
constexpr std::array<std::string_view, 4> kNames<PassFormat>{"exr", "png", "same", "layers"};
template <>
constexpr std::array<std::string_view, 2> kNames<PassDepth>{"view", "ray"};

/// Names that other tables have.
std::span<const std::string_view> shapeNames() {
  static const std::vector<std::string_view> kAll = [] {
    std::vector<std::string_view> all;
    for (const ShapeType& type : shapeTypes()) all.push_back(type.keyword);
    return all;
  }();
  return kAll;
}
std::span<const std::string_view> integratorNames() {
  static const std::vector<std::string_view> kAll = [] {
    std::vector<std::string_view> all;
    for (const IntegratorRow& row : integrators()) all.push_back(row.name);
    return all;
  }();
  return kAll;
}
static_assert(kMostShapeTypes <= 64, "more kinds than an EnumSet holds");

template <class Enum>
std::span<const std::string_view> namesOf() {
  if constexpr (std::is_same_v<Enum, ShapeKind>)
    return shapeNames();
  else if constexpr (std::is_same_v<Enum, IntegratorKind>)
    return integratorNames();
  else if constexpr (std::is_same_v<Enum, SceneFeature>)
    return sceneFeatureNames();
  else
    return kNames<Enum>;
}

constexpr std::string_view kNone = "none";  // an empty set; also no file
constexpr std::string_view kAll = "all";    // a full one

// --- values from and to text --------------------------------------------------------------------------

[[noreturn]] void refuse(const Option& option, const std::string& expected, std::string_view found,
                         std::string hint = {}) {
  throw Error(
      Fault::usage,
      "--" + std::string(option.name) + ": expected " + expected + ", found \"" + std::string(found) + "\"",
      std::move(hint));
}

std::string range(const Option& option) {
  std::string text = "from " + toText(option.least);
  if (option.most != kNoLimit) text += " to " + toText(option.most);
  return text + (option.unit.empty() ? "" : " " + std::string(option.unit));
}

double parseIn(const Option& option, std::string_view text, const char* what) {
  const auto number = parseNumber(text);
  if (!number || number->length != text.size() || !std::isfinite(number->value) ||
      number->value < option.least || number->value > option.most)
    refuse(option, std::string(what) + " " + range(option), text);
  return number->value;
}

void parse(const Option& option, std::string_view text, double& value) {
  value = parseIn(option, text, "a number");
}

void parse(const Option& option, std::string_view text, int& value) {
  const double number = parseIn(option, text, "a whole number");
  if (number != std::floor(number)) refuse(option, "a whole number " + range(option), text);
  value = static_cast<int>(number);
}

void parse(const Option& option, std::string_view text, bool& value) {
  const bool on = text == "on" || text == "true" || text == "1" || text == "yes";
  if (!on && text != "off" && text != "false" && text != "0" && text != "no")
    refuse(option, "on or off", text);
  value = on;
}

void parse(const Option& option, std::string_view text, Region& value) {
  int numbers[4] = {};
  std::string_view rest = text;
  bool good = true;
  for (int i = 0; i < 4 && good; ++i) {
    const auto number = parseNumber(rest);
    good = number && number->value >= 0 && number->value <= option.most &&
           number->value == std::floor(number->value);
    if (!good) break;
    numbers[i] = static_cast<int>(number->value);
    rest.remove_prefix(number->length);
    const bool comma = !rest.empty() && rest[0] == ',';
    good = i == 3 ? rest.empty() : comma;
    if (comma) rest.remove_prefix(1);
  }
  const Region region{numbers[0], numbers[1], numbers[2], numbers[3]};
  if (!good) refuse(option, "four whole numbers x0,y0,x1,y1 from 0 on", text);
  if (region.whole() && !(region == Region{})) refuse(option, "x0,y0,x1,y1 with x0 < x1 and y0 < y1", text);
  value = region;
}

void parse(const Option& option, std::string_view text, Color& value) {
  const std::optional<Color> color = colorOf(text);
  const auto within = [&](double x) { return x >= option.least && x <= option.most; };
  if (!color || !within(color->r) || !within(color->g) || !within(color->b))
    refuse(option, "a colour such as (0.2, 0.5, 1), or a grey, of numbers " + range(option), text);
  value = *color;
}

/// "1,2,3", as of a point.
bool isListOfNumbers(std::string_view text) {
  return text.find(',') != text.npos && text.find_first_of("0123456789") != text.npos &&
         text.find_first_not_of("0123456789.,+-eE ()") == text.npos;
}

/// Three numbers are a point, other lists of numbers nothing, and all else is the name of an object.
void parse(const Option& option, std::string_view text, ScenePlace& value) {
  const bool isPoint = isListOfNumbers(text);
  if (text.empty() || (isPoint && !colorOf(text)))
    refuse(option, "the name of an object, a point x,y,z of three numbers, or none", text);
  value = {};
  if (text == kNone) return;
  if (const auto point = isPoint ? colorOf(text) : std::nullopt)
    value.point = Vec3{point->r, point->g, point->b};
  else
    value.object = text;
}

void parse(const Option& option, std::string_view text, FilePath& value) {
  if (text.empty()) refuse(option, "the name of a file, or none", text);
  value.path = text == kNone ? "" : text;
}

/// The value of that name, if there is one.
template <class Enum>
std::optional<Enum> named(std::string_view text) {
  for (size_t i = 0; i < namesOf<Enum>().size(); ++i)
    if (namesOf<Enum>()[i] == text) return static_cast<Enum>(i);
  return {};
}

std::string alternatives(Names names, std::string_view between) {
  std::string text;
  for (std::string_view name : names) text += (text.empty() ? "" : std::string(between)) + std::string(name);
  return text;
}

template <class Enum>
requires std::is_enum_v<Enum>
void parse(const Option& option, std::string_view text, Enum& value) {
  const std::optional<Enum> found = named<Enum>(text);
  if (!found) refuse(option, alternatives(namesOf<Enum>(), " | "), text, didYouMean(text, namesOf<Enum>()));
  value = *found;
}

/// Names with commas between, "none", or "all".
template <class Enum>
void parse(const Option& option, std::string_view text, EnumSet<Enum>& value) {
  EnumSet<Enum> set;
  const bool all = text == kAll;
  for (size_t i = 0; all && i < namesOf<Enum>().size(); ++i) set.add(static_cast<Enum>(i));
  for (std::string_view rest = text; text != kNone && !all;) {
    const std::string_view name = rest.substr(0, rest.find(','));
    const std::optional<Enum> found = named<Enum>(name);
    if (!found)
      refuse(option, "none, all, or some of " + alternatives(namesOf<Enum>(), ",") + " with commas between",
             text, didYouMean(name, namesOf<Enum>()));
    set.add(*found);
    if (name.size() == rest.size()) break;
    rest.remove_prefix(name.size() + 1);
  }
  value = set;
}

std::string format(double value) { return toText(value); }
std::string format(int value) { return std::to_string(value); }
std::string format(bool value) { return value ? "on" : "off"; }
std::string format(const Color& value) { return colorText(value); }
std::string format(const FilePath& value) { return value.path.empty() ? std::string(kNone) : value.path; }
std::string format(const ScenePlace& place) {
  if (place.none()) return std::string(kNone);
  const auto& p = place.point;
  return p ? toText(p->x) + "," + toText(p->y) + "," + toText(p->z) : place.object;
}
std::string format(const Region& r) {
  return std::to_string(r.x0) + "," + std::to_string(r.y0) + "," + std::to_string(r.x1) + "," +
         std::to_string(r.y1);
}
template <class Enum>
requires std::is_enum_v<Enum> std::string format(Enum value) {
  return std::string(namesOf<Enum>()[static_cast<size_t>(value)]);
}
template <class Enum>
std::string format(const EnumSet<Enum>& set) {
  std::string text;
  for (size_t i = 0; i < namesOf<Enum>().size(); ++i)
    if (set.has(static_cast<Enum>(i))) text += (text.empty() ? "" : ",") + std::string(namesOf<Enum>()[i]);
  return text.empty() ? std::string(kNone) : text;
}

// --- rows ---------------------------------------------------------------------------------------------

template <auto Member>
struct MemberType;
template <class T, T Settings::*Member>
struct MemberType<Member> {
  using type = T;
};

/// The enum of which a field holds several values.
template <class T>
struct ElementOf {};
template <class Enum>
struct ElementOf<EnumSet<Enum>> {
  using type = Enum;
};
template <class T>
constexpr bool kIsSet = requires {
  typename ElementOf<T>::type;
};

template <class T>
constexpr Option::Kind kindOf() {
  if constexpr (std::is_same_v<T, bool>)
    return Option::Kind::boolean;
  else if constexpr (std::is_same_v<T, int>)
    return Option::Kind::integer;
  else if constexpr (std::is_same_v<T, double>)
    return Option::Kind::real;
  else if constexpr (std::is_same_v<T, Color>)
    return Option::Kind::color;
  else if constexpr (std::is_same_v<T, Region>)
    return Option::Kind::region;
  else if constexpr (std::is_same_v<T, FilePath>)
    return Option::Kind::file;
  else if constexpr (std::is_same_v<T, ScenePlace>)
    return Option::Kind::place;
  else if constexpr (kIsSet<T>)
    return Option::Kind::choices;
  else
    return Option::Kind::choice;
}

/// The text of a row, besides its field.
struct Text {
  std::string_view name, group, help, source;
  Repeats repeats = Repeats::picture;
  double least = 0, most = kNoLimit;
  std::string_view unit = "";
  EnumSet<IntegratorKind> integrators = everyIntegrator();
  bool extra = false;
};

/// Integrators that options concern, besides sets by a trait.
using Integrators = EnumSet<IntegratorKind>;
constexpr Integrators kWhitted{IntegratorKind::whitted};
constexpr Integrators kOcclusion{IntegratorKind::occlusion};
/// All that show light.
Integrators lit() { return kWhitted | integratorsWith(Trait::meetsLamps); }

template <auto Member>
Option row(const Text& t) {
  using T = typename MemberType<Member>::type;
  Names names;
  if constexpr (std::is_enum_v<T>) names = namesOf<T>();
  if constexpr (kIsSet<T>) names = namesOf<typename ElementOf<T>::type>();
  return {t.name,
          t.group,
          t.unit,
          t.least,
          t.most,
          t.help,
          t.source,
          t.integrators,
          t.repeats,
          t.extra,
          kindOf<T>(),
          names,
          [](const Settings& s) { return format(s.*Member); },
          [](const Option& option, Settings& s, std::string_view text) { parse(option, text, s.*Member); }};
}

constexpr int kMostPixels = 100000;  // most pixels of a side; the memory limit bounds the product

const std::array kOptions{
    row<&Settings::width>({.name = "width",
                           .group = "Picture",
                           .help = "width of the picture; if only width or height is given on the command "
                                   "line, the scene's aspect ratio is kept",
                           .source = "courses: -w",
                           .least = 1,
                           .most = kMostPixels,
                           .unit = "pixels"}),
    row<&Settings::height>({.name = "height",
                            .group = "Picture",
                            .help = "height of the picture; 0 takes it from the camera's aspect ratio",
                            .source = "",
                            .least = 0,
                            .most = kMostPixels,
                            .unit = "pixels"}),
    row<&Settings::region>({.name = "region",
                            .group = "Picture",
                            .help = "render only the pixels x0 <= x < x1, y0 <= y < y1; the rest stays black",
                            .source = "",
                            .least = 0,
                            .most = kMostPixels,
                            .unit = "pixels"}),
    row<&Settings::quality>(
        {.name = "quality",
         .group = "Picture",
         .help =
             "samples, noise target, denoising and the integrator that fits the scene: a draft in seconds, "
             "a good picture, or a final one; other options override it",
         .source = "docs/trace-1.md"}),
    row<&Settings::spp>(
        {.name = "spp",
         .group = "Picture",
         .help =
             "camera rays per pixel; grid, jittered and stratified take 1, 4, 9, 16 ... (the next square)",
         .source = "courses: -a (3 x 3) and -A (1)",
         .least = 1,
         .most = 65536,
         .unit = "rays",
         .extra = true}),
    row<&Settings::noiseTarget>(
        {.name = "noise-target",
         .group = "Picture",
         .help = "stop a pixel's samples, from 16 on, once its error is at most this part of white, as "
                 "exposed (0.004 is a level of 255); spp is the maximum; 0 takes all. A grid becomes sobol",
         .source = "",
         .least = 0,
         .most = 1,
         .unit = "",
         .extra = true}),
    row<&Settings::subdivide>(
        {.name = "subdivide",
         .group = "Picture",
         .help = "recursive subdivision: rays go through the corners of pixels; a pixel whose corners differ "
                 "is divided into four squares, at most this many times; 0 takes spp",
         .source = "Whitted 1980; docs/sampling.md",
         .least = 0,
         .most = 6,
         .unit = "times",
         .extra = true}),
    row<&Settings::subdivideThreshold>(
        {.name = "subdivide-threshold",
         .group = "Picture",
         .help = "largest difference of a square's corners in red, green or blue, as a part of white (0.004 "
                 "is a level of 255); 0 divides unless they are equal",
         .source = "Austin: supersample threshold",
         .least = 0,
         .most = 1}),
    row<&Settings::denoise>({.name = "denoise",
                             .group = "Picture",
                             .help = "remove noise from the finished picture by averaging similar pixels; "
                                     "reports the mean change; needs 8 samples a pixel or more",
                             .source = "Rousselle, Manzi and Zwicker 2013; docs/denoising.md",
                             .extra = true}),
    row<&Settings::jpegQuality>({.name = "jpeg-quality",
                                 .group = "Picture",
                                 .help = "quality of pictures that are written as .jpg; from 91 on the "
                                         "colours of every pixel are kept",
                                 .source = "courses: a slider of their debug window",
                                 .repeats = Repeats::nothing,
                                 .least = 1,
                                 .most = 100}),
    row<&Settings::time>({.name = "time",
                          .group = "Picture",
                          .help = "time at which an animated scene is shown: key(...)",
                          .source = "docs/animation.md",
                          .repeats = Repeats::scene,
                          .least = -1e9,
                          .most = 1e9,
                          .unit = "seconds"}),
    row<&Settings::shutter>(
        {.name = "shutter",
         .group = "Picture",
         .help =
             "seconds for which the shutter is open, from time on: motion blur; needs many samples a pixel",
         .source = "Cook, Porter and Carpenter 1984; docs/motion.md",
         .least = 0,
         .most = 1e9,
         .unit = "seconds",
         .extra = true}),
    row<&Settings::moments>({.name = "moments",
                             .group = "Picture",
                             .help = "number of times at which the scene is evaluated while the shutter is "
                                     "open; more make fast motion smoother",
                             .source = "docs/motion.md",
                             .least = 2,
                             .most = 4096,
                             .unit = "moments"}),
    row<&Settings::sampling>({.name = "sampling",
                              .group = "Sampling",
                              .help = "how the samples of a pixel are spread over pixel, lens and lights",
                              .source = "Cook 1986; docs/sampling.md",
                              .extra = true}),
    row<&Settings::seed>({.name = "seed",
                          .group = "Sampling",
                          .help = "another number gives other noise",
                          .source = "",
                          .least = 0,
                          .most = 1e9}),
    row<&Settings::filter>({.name = "filter",
                            .group = "Sampling",
                            .help = "weight of a sample by its distance from the pixel's centre",
                            .source = "Mitchell and Netravali 1988; docs/sampling.md",
                            .extra = true}),
    row<&Settings::filterRadius>({.name = "filter-radius",
                                  .group = "Sampling",
                                  .help = "radius of the filter; 0 is its usual radius",
                                  .source = "",
                                  .least = 0,
                                  .most = 16,
                                  .unit = "pixels"}),
    row<&Settings::lightSamples>(
        {.name = "light-samples",
         .group = "Sampling",
         .help = "shadow rays of every sample to each light with a size; more make soft shadows smoother",
         .source = "Cook, Porter and Carpenter 1984",
         .least = 1,
         .most = 1024,
         .unit = "rays"}),
    row<&Settings::lightChoices>(
        {.name = "light-choices",
         .group = "Sampling",
         .help = "lights sampled at each hit point, chosen by distance, direction and intensity; 0 samples "
                 "all, but path, direct, bdpt, mlt and photon one of more than 32",
         .source = "Conty Estevez and Kulla 2018; docs/lights.md",
         .least = 0,
         .most = 1024,
         .unit = "lights",
         .extra = true}),
    row<&Settings::integrator>(
        {.name = "integrator",
         .group = "Tracing",
         .help = "how light is computed: whitted (mirrors, glass and shadows), path (path tracing, needs "
                 "many samples), direct (path without bounces), bdpt (bidirectional path tracing), mlt "
                 "(Metropolis light transport), photon (photon maps); occlusion shows ambient occlusion, "
                 "normals surface normals, cost the work of whitted",
         .source = "Whitted 1980, Kajiya 1986",
         .extra = true}),
    row<&Settings::depth>({.name = "depth",
                           .group = "Tracing",
                           .help = "largest number of bounces of a camera ray; 0 shows local shading only",
                           .source = "courses: -r",
                           .least = 0,
                           .most = 1000,
                           .unit = "bounces"}),
    row<&Settings::threshold>({.name = "threshold",
                               .group = "Tracing",
                               .help = "stop rays that would add less than this to the pixel; 0 never stops",
                               .source = "Hall and Greenberg 1983, adaptive depth",
                               .least = 0,
                               .most = 1,
                               .integrators = kWhitted,
                               .extra = true}),
    row<&Settings::fireflyLimit>(
        {.name = "firefly-limit",
         .group = "Tracing",
         .help = "clamps what a bounced ray adds to a sample, so that rare bright paths leave no dots; "
                 "reports the light that this removes; 0 does not clamp",
         .source = "docs/path-tracing.md",
         .least = 0,
         .most = 1e9,
         .integrators = integratorsWith(Trait::meetsLamps),
         .extra = true}),
    row<&Settings::lightVertices>(
        {.name = "light-vertices",
         .group = "Tracing",
         .help = "shows only paths with this number of vertices sampled from the light (s); -1 shows all",
         .source = "Veach 1997, chapter 10; docs/bidirectional.md",
         .least = -1,
         .most = 1000,
         .integrators = integratorsWith(Trait::joinsEnds),
         .extra = true}),
    row<&Settings::cameraVertices>({.name = "camera-vertices",
                                    .group = "Tracing",
                                    .help = "shows only paths with this number of vertices sampled from the "
                                            "camera (t), including the camera's; -1 shows all",
                                    .source = "Veach 1997, chapter 10; docs/bidirectional.md",
                                    .least = -1,
                                    .most = 1000,
                                    .integrators = integratorsWith(Trait::joinsEnds),
                                    .extra = true}),
    row<&Settings::unweighted>(
        {.name = "unweighted",
         .group = "Tracing",
         .help = "shows a strategy without its MIS weight; use it with --light-vertices or --camera-vertices",
         .source = "Veach 1997, chapter 9; docs/bidirectional.md",
         .integrators = integratorsWith(Trait::joinsEnds),
         .extra = true}),
    row<&Settings::chains>(
        {.name = "chains",
         .group = "Tracing",
         .help = "state space of the Markov chains: the samples of path, those of bdpt with one strategy "
                 "each, or paths that Veach's mutations change (veach)",
         .source = "Hachisuka, Kaplanyan and Dachsbacher 2014; Veach and Guibas 1997; docs/metropolis.md",
         .integrators = integratorsWith(Trait::byChains),
         .extra = true}),
    row<&Settings::mutations>({.name = "mutations",
                               .group = "Tracing",
                               .help = "mutations of --chains veach, apart from new paths (--move-anywhere)",
                               .source = "Veach and Guibas 1997, section 5; docs/metropolis.md",
                               .integrators = integratorsWith(Trait::byChains)}),
    row<&Settings::chainStarts>(
        {.name = "chain-starts",
         .group = "Tracing",
         .help = "random samples that seed the chains: more make the picture's mean brightness more exact",
         .source = "docs/metropolis.md",
         .least = 1,
         .most = 1e8,
         .unit = "samples",
         .integrators = integratorsWith(Trait::byChains)}),
    row<&Settings::moveAnywhere>({.name = "move-anywhere",
                                  .group = "Tracing",
                                  .help = "probability of a large step, which replaces the whole sample; the "
                                          "other mutations are small steps",
                                  .source = "Kelemen et al. 2002",
                                  .least = 0.01,
                                  .most = 1,
                                  .integrators = integratorsWith(Trait::byChains)}),
    row<&Settings::moveSize>({.name = "move-size",
                              .group = "Tracing",
                              .help = "size of a small step, as a part of the range",
                              .source = "docs/metropolis.md",
                              .least = 1e-6,
                              .most = 1,
                              .integrators = integratorsWith(Trait::byChains)}),
    row<&Settings::lampSamples>({.name = "lamp-samples",
                                 .group = "Tracing",
                                 .help = "shadow rays from each hit point to emissive objects, and to a sky "
                                         "that is not uniform; 0: they light nothing",
                                 .source = "Cook, Porter and Carpenter 1984; docs/lights.md",
                                 .least = 0,
                                 .most = 4096,
                                 .unit = "rays",
                                 .integrators = kWhitted,
                                 .extra = true}),
    row<&Settings::ambientOcclusion>({.name = "ambient-occlusion",
                                      .group = "Tracing",
                                      .help = "rays from each hit point that measure ambient occlusion: "
                                              "corners and creases darken; 0 is constant ambient light",
                                      .source = "Zhukov, Iones and Kronin 1998; docs/occlusion.md",
                                      .least = 0,
                                      .most = 4096,
                                      .unit = "rays",
                                      .integrators = integratorsWith(Trait::addsAmbient),
                                      .extra = true}),
    row<&Settings::occlusionReach>(
        {.name = "occlusion-reach",
         .group = "Tracing",
         .help = "largest distance of objects that block ambient light; 0 is unlimited",
         .source = "",
         .least = 0,
         .most = 1e9,
         .unit = "units",
         .integrators = integratorsWith(Trait::addsAmbient) | kOcclusion}),
    row<&Settings::photons>(
        {.name = "photons",
         .group = "Tracing",
         .help = "photons emitted by the lights in each pass; more make indirect light sharper and smoother",
         .source = "Jensen 1996; docs/photons.md",
         .least = 1,
         .most = 50e6,
         .unit = "photons",
         .integrators = integratorsWith(Trait::photons)}),
    row<&Settings::photonPasses>(
        {.name = "photon-passes",
         .group = "Tracing",
         .help = "number of photon maps, shared by the samples of a pixel: later maps use fewer, nearer "
                 "photons, so that their mean converges; at most one for each sample",
         .source = "Knaus and Zwicker 2011; docs/photons.md",
         .least = 1,
         .most = 1000,
         .unit = "maps",
         .integrators = integratorsWith(Trait::photons)}),
    row<&Settings::photonShare>(
        {.name = "photon-share",
         .group = "Tracing",
         .help =
             "part of the photons of --photons and --caustics that is emitted; a small part is enough for a "
             "preview, and --quick takes 0.05",
         .source = "docs/photons.md",
         .least = 0.001,
         .most = 1,
         .integrators = kWhitted | integratorsWith(Trait::photons)}),
    row<&Settings::finalGather>({.name = "final-gather",
                                 .group = "Tracing",
                                 .help = "estimate indirect light by rays whose hit points use the photon "
                                         "map; grain in place of blotches and blur",
                                 .source = "Jensen 1996; docs/photons.md",
                                 .integrators = integratorsWith(Trait::photons),
                                 .extra = true}),
    row<&Settings::irradianceCache>(
        {.name = "irradiance-cache",
         .group = "Tracing",
         .help = "compute indirect light at few points and interpolate: the reach of a point, relative to "
                 "the mean distance of what it sees, such as 0.2; 0 computes it everywhere",
         .source = "Ward, Rubinstein and Clear 1988; docs/photons.md",
         .least = 0,
         .most = 1,
         .integrators = integratorsWith(Trait::photons),
         .extra = true}),
    row<&Settings::irradianceRays>({.name = "irradiance-rays",
                                    .group = "Tracing",
                                    .help = "rays for each point of the irradiance cache",
                                    .source = "docs/photons.md",
                                    .least = 4,
                                    .most = 65536,
                                    .unit = "rays",
                                    .integrators = integratorsWith(Trait::photons)}),
    row<&Settings::smoothTerminator>(
        {.name = "smooth-terminator",
         .group = "Tracing",
         .help = "shadow rays from a mesh start on the smooth surface of its vertex normals: the line "
                 "between light and shade shows no facets",
         .source = "Hanika 2021; docs/smooth-terminator.md",
         .integrators = lit() | kOcclusion,
         .extra = true}),
    row<&Settings::caustics>(
        {.name = "caustics",
         .group = "Tracing",
         .help = "photons from the lights for the caustics of mirrors and glass; refracting glass then has a "
                 "black shadow; 0: none, and with the integrator photon as many as --photons",
         .source = "Jensen 2001; docs/caustics.md",
         .least = 0,
         .most = 50e6,
         .unit = "photons",
         .integrators = kWhitted | integratorsWith(Trait::photons),
         .extra = true}),
    row<&Settings::causticRadius>(
        {.name = "caustic-radius",
         .group = "Tracing",
         .help = "search radius for photons of caustics; 0 is a fiftieth of the scene's size, and at most a "
                 "tenth of the size of the mirrors and glass",
         .source = "",
         .least = 0,
         .most = 1e9,
         .unit = "units",
         .integrators = kWhitted | integratorsWith(Trait::photons)}),
    row<&Settings::causticTexels>({.name = "caustic-texels",
                                   .group = "Tracing",
                                   .help = "Arvo's illumination maps: texels a side of a map of caustics for "
                                           "each surface that has texture coordinates; 0 uses the photon map",
                                   .source = "Arvo 1986; docs/caustics.md",
                                   .least = 0,
                                   .most = 4096,
                                   .unit = "texels",
                                   .integrators = kWhitted,
                                   .extra = true}),
    row<&Settings::nestedGlass>(
        {.name = "nested-glass",
         .group = "Tracing",
         .help = "glass objects inside and across one another: the highest priority fills the space, among "
                 "equals the object entered last; by-priority does so if a material gives one",
         .source = "Schmidt and Budge 2002; docs/glass.md",
         .repeats = Repeats::world,
         .extra = true}),
    row<&Settings::wavelengths>(
        {.name = "wavelengths",
         .group = "Tracing",
         .help = "rays into which dispersive glass splits light; 1 refracts all colours alike",
         .source = "docs/glass.md",
         .least = 1,
         .most = 1000,
         .unit = "rays",
         .extra = true}),
    row<&Settings::varnish>(
        {.name = "varnish",
         .group = "Tracing",
         .help =
             "opaque surfaces with an index reflect like a clear coat of that index, by Fresnel's formula",
         .source = "docs/glass.md",
         .extra = true}),
    row<&Settings::glossy>({.name = "glossy",
                            .group = "Tracing",
                            .help = "rough metal, varnish and glass trace one random ray of their lobe, for "
                                    "blurred reflections; needs many samples a pixel",
                            .source = "Cook, Porter and Carpenter 1984; docs/materials.md",
                            .integrators = kWhitted,
                            .extra = true}),
    row<&Settings::models>(
        {.name = "models",
         .group = "Tracing",
         .help =
             "shading models: those of the materials, or their closest Phong approximation, for comparison",
         .source = "docs/materials.md",
         .repeats = Repeats::world}),
    row<&Settings::textures>({.name = "textures",
                              .group = "Tracing",
                              .help = "show textures and bumps, or only the constants that they scale",
                              .source = "docs/textures.md",
                              .repeats = Repeats::world}),
    row<&Settings::outlines>({.name = "outlines",
                              .group = "Tracing",
                              .help = "black lines of this width where objects end, and along their edges",
                              .source = "Choudhury and Parker 2009; docs/materials.md",
                              .least = 0,
                              .most = 100,
                              .unit = "pixels",
                              .extra = true}),
    row<&Settings::omit>({.name = "omit",
                          .group = "Tracing",
                          .help = "leave out all objects of these kinds",
                          .source = "British Columbia, whose own pictures lack the conics",
                          .repeats = Repeats::world}),
    row<&Settings::switchedOff>(
        {.name = "switched-off",
         .group = "Tracing",
         .help = "show the scene without these extensions: no media, bumps, displacement or holes, point "
                 "lights in "
                 "place of these lights, Phong's model in place of these; --without NAME adds one",
         .source = "University of Washington 2015, which demands a switch for each",
         .repeats = Repeats::world}),
    row<&Settings::projection>(
        {.name = "projection",
         .group = "Camera",
         .help = "how directions are mapped to points of the picture; a panorama shows all directions",
         .source = "docs/cameras.md",
         .repeats = Repeats::world,
         .extra = true}),
    row<&Settings::viewHeight>(
        {.name = "view-height",
         .group = "Camera",
         .help = "height of an orthographic picture; 0 matches the perspective at the middle",
         .source = "docs/cameras.md",
         .repeats = Repeats::world,
         .least = 0,
         .most = 1e30,
         .unit = "units"}),
    row<&Settings::fisheyeAngle>({.name = "fisheye-angle",
                                  .group = "Camera",
                                  .help = "angle of a fisheye across the shorter side of the picture",
                                  .source = "docs/cameras.md",
                                  .repeats = Repeats::world,
                                  .least = 1,
                                  .most = 360,
                                  .unit = "degrees"}),
    row<&Settings::shiftX>({.name = "shift-x",
                            .group = "Camera",
                            .help = "moves the film to the right, which shows more of the right side",
                            .source = "tilt-shift lenses; docs/cameras.md",
                            .repeats = Repeats::world,
                            .least = -100,
                            .most = 100,
                            .unit = "widths"}),
    row<&Settings::shiftY>({.name = "shift-y",
                            .group = "Camera",
                            .help = "moves the film up: towers stay upright if the camera is level",
                            .source = "tilt-shift lenses; docs/cameras.md",
                            .repeats = Repeats::world,
                            .least = -100,
                            .most = 100,
                            .unit = "heights"}),
    row<&Settings::distortion>({.name = "distortion",
                                .group = "Camera",
                                .help = "lens distortion: above 0 barrel, below 0 pincushion",
                                .source = "Brown 1966; docs/cameras.md",
                                .repeats = Repeats::world,
                                .least = -0.1,
                                .most = 10,
                                .extra = true}),
    row<&Settings::stereo>(
        {.name = "stereo",
         .group = "Camera",
         .help = "views of two eyes in one picture: side by side, or for red and cyan glasses",
         .source = "courses; docs/stereo.md",
         .repeats = Repeats::world,
         .extra = true}),
    row<&Settings::eyeSeparation>({.name = "eye-separation",
                                   .group = "Camera",
                                   .help = "distance between the eyes; 0 is a thirtieth of zero-parallax",
                                   .source = "docs/stereo.md",
                                   .repeats = Repeats::world,
                                   .least = 0,
                                   .most = 1e30,
                                   .unit = "units"}),
    row<&Settings::zeroParallax>({.name = "zero-parallax",
                                  .group = "Camera",
                                  .help = "distance of objects that appear to lie in the screen; nearer ones "
                                          "stand out of it; 0 is that of the middle of the picture",
                                  .source = "docs/stereo.md",
                                  .repeats = Repeats::world,
                                  .least = 0,
                                  .most = 1e30,
                                  .unit = "units"}),
    row<&Settings::aperture>({.name = "aperture",
                              .group = "Lens",
                              .help = "diameter of the lens: objects out of focus blur; 0 is a pinhole",
                              .source = "Cook, Porter and Carpenter 1984; docs/lens.md",
                              .least = 0,
                              .most = 1e9,
                              .unit = "units",
                              .extra = true}),
    row<&Settings::focus>({.name = "focus",
                           .group = "Lens",
                           .help = "distance along the viewing direction that is in focus; 0 is that of the "
                                   "surface in the middle of the picture",
                           .source = "docs/lens.md",
                           .repeats = Repeats::world,
                           .least = 0,
                           .most = 1e30,
                           .unit = "units"}),
    row<&Settings::focusOn>({.name = "focus-on",
                             .group = "Lens",
                             .help = "object in focus, by its name, or a point x,y,z, in place of a distance",
                             .source = "docs/lens.md",
                             .repeats = Repeats::world}),
    row<&Settings::blades>(
        {.name = "blades",
         .group = "Lens",
         .help = "corners of the lens opening, the shape of blurred lights; below 3 it is round",
         .source = "docs/lens.md",
         .least = 0,
         .most = 100}),
    row<&Settings::bladeAngle>({.name = "blade-angle",
                                .group = "Lens",
                                .help = "rotates the corners of the lens opening",
                                .source = "",
                                .least = -360,
                                .most = 360,
                                .unit = "degrees"}),
    row<&Settings::aperturePicture>({.name = "aperture-picture",
                                     .group = "Lens",
                                     .help = "picture of the lens opening, in place of blades: blurred "
                                             "lights take the shape of its bright parts",
                                     .source = "docs/lens.md",
                                     .repeats = Repeats::world}),
    row<&Settings::tilt>({.name = "tilt",
                          .group = "Lens",
                          .help = "turns the plane in focus: above 0 its upper half comes nearer",
                          .source = "Scheimpflug 1904; docs/lens.md",
                          .repeats = Repeats::world,
                          .least = -89,
                          .most = 89,
                          .unit = "degrees"}),
    row<&Settings::backdrop>(
        {.name = "backdrop",
         .group = "Background",
         .help = "picture behind the scene, stretched over the whole picture; only camera rays see it",
         .source = "docs/environment.md",
         .repeats = Repeats::world}),
    row<&Settings::environment>({.name = "environment",
                                 .group = "Background",
                                 .help = "environment map, seen by camera rays and in mirrors and glass: a "
                                         "file, or a folder with the six faces of a cube",
                                 .source = "Blinn and Newell 1976; Austin: -c",
                                 .repeats = Repeats::world}),
    row<&Settings::environmentKind>(
        {.name = "environment-kind",
         .group = "Background",
         .help = "layout of the environment map; auto decides by its shape and name",
         .source = "docs/environment.md",
         .repeats = Repeats::world}),
    row<&Settings::environmentRotation>(
        {.name = "environment-rotation",
         .group = "Background",
         .help = "rotates the environment about the y axis, to the left as seen from inside",
         .source = "",
         .repeats = Repeats::world,
         .least = -360,
         .most = 360,
         .unit = "degrees"}),
    row<&Settings::environmentBrightness>({.name = "environment-brightness",
                                           .group = "Background",
                                           .help = "factor on the environment",
                                           .source = "",
                                           .repeats = Repeats::world,
                                           .least = 0,
                                           .most = 1e6}),
    row<&Settings::environmentBlur>(
        {.name = "environment-blur",
         .group = "Background",
         .help = "each direction of the environment shows the mean of those within this angle",
         .source = "Miller and Hoffman 1984",
         .repeats = Repeats::world,
         .least = 0,
         .most = 90,
         .unit = "degrees"}),
    row<&Settings::fog>(
        {.name = "fog",
         .group = "Fog",
         .help = "extinction of fog per unit of length, and its scattering of the lights; 0: clear air",
         .source = "docs/fog.md",
         .least = 0,
         .most = 1e6,
         .unit = "per unit",
         .integrators = lit(),
         .extra = true}),
    row<&Settings::fogColor>(
        {.name = "fog-color",
         .group = "Fog",
         .help = "albedo of fog, the scattered fraction; the rest is absorbed: 0 is black smoke",
         .source = "",
         .least = 0,
         .most = 1,
         .integrators = lit()}),
    row<&Settings::fogHeight>(
        {.name = "fog-height",
         .group = "Fog",
         .help = "ground fog: height, along y from 0, at which it is thinner by e = 2.718; 0: uniform fog",
         .source = "",
         .least = 0,
         .most = 1e9,
         .unit = "units",
         .integrators = lit()}),
    row<&Settings::fogForward>({.name = "fog-forward",
                                .group = "Fog",
                                .help = "mean cosine of scattering: from -1, backward, over 0, isotropic, to "
                                        "1, forward; mist has 0.8, dust 0.4",
                                .source = "Henyey and Greenstein 1941",
                                .least = -1,
                                .most = 1,
                                .integrators = lit()}),
    row<&Settings::fogSamples>({.name = "fog-samples",
                                .group = "Fog",
                                .help =
                                    "points on every ray that sample the lights, in fog and media; 0: fog "
                                    "has its own colour, and lights shine through it undimmed",
                                .source = "",
                                .least = 0,
                                .most = 10000,
                                .unit = "points",
                                .integrators = kWhitted}),
    row<&Settings::mediumDepth>({.name = "medium-depth",
                                 .group = "Fog",
                                 .help = "largest number of scattering events in fog, smoke, clouds and milk",
                                 .source = "docs/media.md",
                                 .least = 1,
                                 .most = 10000,
                                 .unit = "times",
                                 .integrators = integratorsWith(Trait::scattersInMedia)}),
    row<&Settings::subsurfaceSamples>({.name = "subsurface-samples",
                                       .group = "Fog",
                                       .help = "points at which light enters marble, milk or skin, for every "
                                               "directly visible point where it leaves",
                                       .source = "docs/subsurface.md",
                                       .least = 1,
                                       .most = 10000,
                                       .unit = "points",
                                       .integrators = lit()}),
    row<&Settings::like>({.name = "like",
                          .group = "Conventions",
                          .help = "conventions of a course: sets every option of this group",
                          .source = "docs/conventions.md",
                          .repeats = Repeats::world}),
    row<&Settings::highlight>(
        {.name = "highlight",
         .group = "Conventions",
         .help = "highlight by the half-way vector (blinn) or the mirrored light (phong)",
         .source = "Blinn 1977; Phong 1975",
         .repeats = Repeats::world}),
    row<&Settings::shininessScale>(
        {.name = "shininess-scale",
         .group = "Conventions",
         .help = "factor on every shininess; 128 for scenes with values from 0 to 1",
         .source = "courses of 2001",
         .repeats = Repeats::world,
         .least = 0,
         .most = 1e6}),
    row<&Settings::ambientScale>(
        {.name = "ambient-scale",
         .group = "Conventions",
         .help = "factor on all ambient light; 0.5 for a course that lit the composer's files by half",
         .source = "the pictures of Texas A&M",
         .repeats = Repeats::world,
         .least = 0,
         .most = 1e6}),
    row<&Settings::mirrorDefault>({.name = "mirror-default",
                                   .group = "Conventions",
                                   .help = "reflection of a material that gives specular but not reflective",
                                   .source = "courses; zero in Austin",
                                   .repeats = Repeats::world}),
    row<&Settings::diffuseSides>({.name = "diffuse-sides",
                                  .group = "Conventions",
                                  .help = "light glass surfaces from the front only, or from behind as well",
                                  .source = "both-on-glass in Austin",
                                  .repeats = Repeats::world}),
    row<&Settings::limitAttenuation>({.name = "limit-attenuation",
                                      .group = "Conventions",
                                      .help = "attenuation by distance never amplifies a light",
                                      .source = "courses: min(1, 1 / (a + b d + c d^2))",
                                      .repeats = Repeats::world}),
    row<&Settings::glass>({.name = "glass",
                           .group = "Conventions",
                           .help = "filter by transmissive at each surface crossed, or by transmissive to "
                                   "the power of the distance inside",
                           .source = "courses; Beer's law in Austin"}),
    row<&Settings::airIndex>({.name = "air-index",
                              .group = "Conventions",
                              .help = "index of refraction outside all objects",
                              .source = "courses: 1.0003",
                              .least = 0.01,
                              .most = 100}),
    row<&Settings::fresnel>({.name = "fresnel",
                             .group = "Conventions",
                             .help = "reflection of glass: as its material says, or stronger at grazing "
                                     "angles by Schlick's approximation or Fresnel's formula (exact), which "
                                     "then also apply to clear layers with an index",
                             .source = "Schlick 1994, University of Southern California; Fresnel 1823"}),
    row<&Settings::glassShadows>({.name = "glass-shadows",
                                  .group = "Conventions",
                                  .help = "glass filters the light that passes it, or casts a black shadow; "
                                          "panes that do not refract always filter it",
                                  .source = "black in Southern California"}),
    row<&Settings::backFaces>(
        {.name = "back-faces",
         .group = "Conventions",
         .help = "mesh triangles seen from behind: shown; hidden from camera and mirror rays, by the face "
                 "and the interpolated normal; hidden from all rays, by the face",
         .source = "cull-all in 2001, cull-seen in Austin"}),
    row<&Settings::vertexNormals>(
        {.name = "vertex-normals",
         .group = "Conventions",
         .help = "generated vertex normals have length 1, or stay the mean of the faces'",
         .source = "unit since 2013",
         .repeats = Repeats::world}),
    row<&Settings::roundSpheres>(
        {.name = "round-spheres",
         .group = "Conventions",
         .help = "a sphere stretched by its transform is a ball of the mean radius, not an ellipsoid",
         .source = "University of Washington, 1998",
         .repeats = Repeats::world}),
    row<&Settings::roundMaps>({.name = "round-maps",
                               .group = "Conventions",
                               .help = "pictures are mapped to spheres, cylinders and cones; off: those show "
                                       "only its bottom left corner",
                               .source = "off in Austin, where it was left to the student",
                               .repeats = Repeats::world}),
    row<&Settings::cameraAxes>(
        {.name = "camera-axes",
         .group = "Conventions",
         .help = "viewdir and updir made orthogonal unit vectors, used as written, only normalized, or "
                 "normalized with the vector to the right (skewed)",
         .source = "orthonormal since 2013",
         .repeats = Repeats::world}),
    row<&Settings::pixelPosition>({.name = "pixel-position",
                                   .group = "Conventions",
                                   .help = "the camera ray of a pixel goes through its lower left corner or "
                                           "its centre, or the outermost rays "
                                           "through the border of the picture",
                                   .source = "courses: corner"}),
    row<&Settings::tone>(
        {.name = "tone",
         .group = "Conventions",
         .help = "8-bit pictures: clip values below 0 and above 1; map the least and largest value to 0 and "
                 "1; or apply a curve that brings bright ones below 1",
         .source = "stretch in British Columbia and Montreal; docs/tone.md",
         .repeats = Repeats::tone}),
    row<&Settings::rounding>({.name = "rounding",
                              .group = "Conventions",
                              .help = "8-bit values are truncated or rounded to the nearest",
                              .source = "courses: (int)(255 c)",
                              .repeats = Repeats::tone}),
    row<&Settings::exposure>({.name = "exposure",
                              .group = "Tone",
                              .help = "brightens 8-bit pictures: 1 doubles, -1 halves",
                              .source = "docs/tone.md",
                              .repeats = Repeats::tone,
                              .least = -100,
                              .most = 100,
                              .unit = "stops",
                              .extra = true}),
    row<&Settings::autoExposure>(
        {.name = "auto-exposure",
         .group = "Tone",
         .help = "measures the light of the picture first and chooses the exposure by it; exposure is added",
         .source = "Reinhard et al. 2002; docs/trace-1.md",
         .repeats = Repeats::world}),
    row<&Settings::whiteBalance>(
        {.name = "white-balance",
         .group = "Tone",
         .help = "temperature of the light that becomes white, 1667 to 25000; 0 leaves colours as they are",
         .source = "Kang et al. 2002, Bradford; docs/tone.md",
         .repeats = Repeats::tone,
         .least = 0,
         .most = 25000,
         .unit = "kelvin",
         .extra = true}),
    row<&Settings::transfer>(
        {.name = "transfer",
         .group = "Tone",
         .help = "8-bit values: linear as in the courses, or sRGB as screens expect them",
         .source = "IEC 61966-2-1; docs/tone.md",
         .repeats = Repeats::tone,
         .extra = true}),
    row<&Settings::workingGamma>(
        {.name = "working-gamma",
         .group = "Tone",
         .help = "exponent that makes linear light of the values, before the transfer; 2.2 for scenes whose "
                 "colours are those of a screen",
         .source = "assumed_gamma of POV-Ray 3.7",
         .repeats = Repeats::tone,
         .least = 0.1,
         .most = 10}),
    row<&Settings::bloom>({.name = "bloom",
                           .group = "Tone",
                           .help = "fraction of the light that lens and eye scatter around bright points",
                           .source = "docs/tone.md",
                           .repeats = Repeats::tone,
                           .least = 0,
                           .most = 1,
                           .extra = true}),
    row<&Settings::dither>({.name = "dither",
                            .group = "Tone",
                            .help = "noise of one level, which hides the steps of 8-bit gradients",
                            .source = "docs/tone.md",
                            .repeats = Repeats::tone,
                            .extra = true}),
    row<&Settings::alpha>(
        {.name = "alpha",
         .group = "Passes",
         .help =
             "the environment behind the scene is transparent: .png and .exr store the alpha of each pixel",
         .source = "docs/passes.md",
         .repeats = Repeats::world}),
    row<&Settings::passes>({.name = "passes",
                            .group = "Passes",
                            .help = "additional pictures of what the camera rays hit",
                            .source = "docs/passes.md"}),
    row<&Settings::passFormat>(
        {.name = "pass-format",
         .group = "Passes",
         .help =
             "files of passes: raw values (exr), levels for viewing (png), or the picture's format; or no "
             "files but layers of the picture, an .exr",
         .source = "",
         .repeats = Repeats::nothing}),
    row<&Settings::passName>({.name = "pass-name",
                              .group = "Passes",
                              .help = "files of passes are called NAME.PASS, or NAME_PASS",
                              .source = "underscore in British Columbia",
                              .repeats = Repeats::nothing}),
    row<&Settings::passColors>(
        {.name = "pass-colors",
         .group = "Passes",
         .help = "levels of the passes depth, samples and change: grey, or from black over violet, red and "
                 "yellow to white (heat)",
         .source = "",
         .repeats = Repeats::tone}),
    row<&Settings::passDepth>(
        {.name = "pass-depth",
         .group = "Passes",
         .help = "the pass depth measures along the viewing direction, or along the ray",
         .source = "ray in British Columbia"}),
    row<&Settings::passNear>({.name = "pass-near",
                              .group = "Passes",
                              .help = "depth that is black in 8-bit pictures; used if pass-far is larger",
                              .source = "British Columbia",
                              .repeats = Repeats::tone,
                              .least = 0,
                              .most = 1e30,
                              .unit = "units"}),
    row<&Settings::passFar>(
        {.name = "pass-far",
         .group = "Passes",
         .help = "depth that is white in 8-bit pictures; 0 takes the range of the picture",
         .source = "British Columbia",
         .repeats = Repeats::tone,
         .least = 0,
         .most = 1e30,
         .unit = "units"}),
    row<&Settings::threads>({.name = "threads",
                             .group = "Resources",
                             .help = "number of threads that trace; 0 takes all",
                             .source = "courses: -t",
                             .repeats = Repeats::nothing,
                             .least = 0,
                             .most = 1024}),
    row<&Settings::accel>(
        {.name = "accel",
         .group = "Resources",
         .help = "bounding volume hierarchy, or none: every object is tested for every ray; -b also takes "
                 "one ray a pixel and ignores the scene's limits, but not those of the command line",
         .source = "courses: -b and -B",
         .repeats = Repeats::world}),
    row<&Settings::timeLimit>({.name = "time-limit",
                               .group = "Resources",
                               .help = "stop this long after the start, at most a few seconds later; a "
                                       "render keeps its finished part; 0 never stops",
                               .source = "",
                               .repeats = Repeats::nothing,
                               .least = 0,
                               .most = 1e9,
                               .unit = "seconds"}),
    row<&Settings::checkpointEvery>({.name = "checkpoint-every",
                                     .group = "Resources",
                                     .help = "interval at which a render's state is written next to its "
                                             "picture, to resume after a failure; 0 writes none",
                                     .source = "",
                                     .repeats = Repeats::nothing,
                                     .least = 0,
                                     .most = 1e9,
                                     .unit = "seconds"}),
    row<&Settings::maxMemory>(
        {.name = "max-memory",
         .group = "Resources",
         .help = "MiB of memory that a scene may use; 0 allows half of the machine's memory",
         .source = "",
         .repeats = Repeats::nothing,
         .least = 0,
         .most = 1 << 24,
         .unit = "MiB"}),
};

// --- every field has a row: count the members of Settings by how many initialisers it takes -----------

struct Anything {
  template <class T>
  operator T() const;  // never called
};
template <class... Args>
constexpr size_t fieldCount() {
  if constexpr (requires { Settings{Args{}..., Anything{}}; })
    return fieldCount<Args..., Anything>();
  else
    return sizeof...(Args);
}
static_assert(std::tuple_size_v<decltype(kOptions)> == fieldCount<>(),
              "a field of Settings has no row in the options table, or two");

void apply(Settings& settings, const Choice& choice) {
  try {
    const Option& option = findOption(choice.option);
    const bool beside = option.kind == Option::Kind::file && choice.value != kNone && !choice.value.empty();
    option.assign(settings, beside ? besideFile(choice.place.file, choice.value) : choice.value);
  } catch (const Error& error) {
    if (choice.place.file.empty()) throw;
    Message message = error.messages().front();
    message.place = choice.place;
    throw Error(Fault::scene, {message});
  }
}

}  // namespace

std::optional<Color> colorOf(std::string_view text) {
  double numbers[3] = {};
  int count = 0;
  std::string plain;  // as in a scene: (0.2, 0.5, 1)
  for (const char c : text)
    if (c != ' ') plain += c;
  if (plain.starts_with('(') && plain.ends_with(')')) plain = plain.substr(1, plain.size() - 2);
  for (std::string_view rest = plain; count < 3;) {
    const auto number = parseNumber(rest);
    if (!number || !std::isfinite(number->value)) return {};
    numbers[count++] = number->value;
    rest.remove_prefix(number->length);
    if (rest.empty()) break;
    if (rest[0] != ',' || count == 3) return {};
    rest.remove_prefix(1);
  }
  if (count == 1) return Color(numbers[0]);
  return count == 3 ? std::optional(Color{numbers[0], numbers[1], numbers[2]}) : std::nullopt;
}

std::string colorText(const Color& c) {
  if (c == Color(c.r)) return toText(c.r);
  return toText(c.r) + "," + toText(c.g) + "," + toText(c.b);
}

std::span<const Option> options() { return kOptions; }

const Option& findOption(std::string_view name) {
  for (const Option& option : kOptions)
    if (option.name == name) return option;
  std::string hint;
  for (std::string_view meant : optionsMeant(name))
    hint += (hint.empty() ? "did you mean \"" : "\" or \"") + std::string(meant);
  if (!hint.empty()) hint += "\"?";
  std::vector<std::string_view> names;
  names.reserve(kOptions.size());
  for (const Option& option : kOptions) names.push_back(option.name);
  if (hint.empty()) hint = didYouMean(name, names);
  if (hint.empty() && (name.starts_with("sun") || name.starts_with("sky")))
    hint = "background { turbidity = 3; sun = (-1, 0.6, -0.55) } is a daylight sky";
  throw Error(Fault::usage, "unknown option \"" + std::string(name) + "\"", std::move(hint));
}

namespace {

using Layers = std::initializer_list<std::span<const Choice>>;

/// A later layer says `quality = none`: what the quality of this one stands for is as if nobody gave it.
bool isQualityUndone(const std::span<const Choice>& layer, const Layers& layers) {
  return std::any_of(&layer + 1, layers.end(), [](std::span<const Choice> later) {
    return std::any_of(later.begin(), later.end(),
                       [](const Choice& c) { return c.option == "quality" && c.value == kNone; });
  });
}

}  // namespace

Settings resolve(Layers layers) {
  Settings settings;
  for (const std::span<const Choice>& layer : layers) {
    for (const Choice& choice : layer) {
      if (choice.option != "like") continue;
      apply(settings, choice);
      const Settings& given = convention(settings.like).settings;
      for (const Option& option : kOptions)
        if (isConvention(option)) option.assign(settings, option.get(given));
    }
    for (const Choice& choice : layer)
      if (choice.option == "quality") {
        apply(settings, choice);
        if (!isQualityUndone(layer, layers))
          for (const Choice& own : choicesOf(settings.quality)) apply(settings, own);
      }
    for (const Choice& choice : layer)
      if (choice.option != "like" && choice.option != "quality") apply(settings, choice);
  }
  return settings;
}

std::string chooserOf(const Option& option, std::initializer_list<std::span<const Choice>> layers,
                      std::string (*place)(const SourcePlace&)) {
  std::string chooser = "default";
  std::size_t number = 0;
  for (const std::span<const Choice>& layer : layers) {
    for (const std::string_view by : {"like", "quality", ""})
      for (const Choice& choice : layer) {
        if (choice.option != (by.empty() ? option.name : by)) continue;
        if (by == "like" && !isConvention(option)) continue;
        if (by == "quality" && (isQualityUndone(layer, layers) || !setsOption(choice.value, option.name)))
          continue;
        const std::string names[] = {place(choice.place), "command line", "studio"};
        chooser = names[number];
        if (chooser.empty()) chooser = "scene file";  // the choice follows from the dialect, at no one place
        if (!by.empty()) chooser += ", by " + std::string(by);
      }
    ++number;
  }
  return chooser;
}

bool isConvention(const Option& option) { return option.group == "Conventions" && option.name != "like"; }

bool sameValue(const Option& option, const Settings& a, const Settings& b) {
  const std::string x = option.get(a), y = option.get(b);
  return x == y || (option.kind == Option::Kind::file && x != kNone && y != kNone &&
                    sameFile(std::filesystem::absolute(x).lexically_normal().generic_string(),
                             std::filesystem::absolute(y).lexically_normal().generic_string()));
}

std::vector<Choice> changedOptions(const Settings& settings) {
  std::vector<Choice> changed;
  const Settings defaults;
  for (const Option& option : kOptions)
    if (const std::string value = option.get(settings); value != option.get(defaults))
      changed.push_back({std::string(option.name), value, {}});
  return changed;
}

}  // namespace trace
