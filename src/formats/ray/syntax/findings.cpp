#include "formats/ray/syntax/findings.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/text.h"
#include "geometry/shape.h"
#include "shading/material.h"

namespace trace::rayfile {
namespace {

/// Words that courses and students added to the format and Trace does not know as objects, lights or fields.
constexpr std::array<std::string_view, 23> kRelatives{
    "sphere_light", "bump",      "bump_mapping", "checkerboard", "csg",        "displace",
    "environment",  "fog",       "hyperbolic",   "map",          "map_points", "marble",
    "metaball",     "meteorite", "noise",        "normal",       "normal_map", "obj_mesh",
    "shape_light",  "skybox",    "texture",      "warn_model",   "wood"};

/// This many warnings show their line and a hint; a flood of others does without.
constexpr std::size_t kFullWarnings = 50;

/// Trace has these in place of words of courses and of POV-Ray.
constexpr std::pair<std::string_view, std::string_view> kInstead[]{
    {"csg", "Trace has union, intersection and difference, as in difference { box { } sphere { } }"},
    {"metaball", "Trace has metaballs { threshold = 0.5; balls = ((x, y, z, radius, strength), ...); }"},
    {"hyperbolic", "Trace has hyperboloid { } and two_sheets { }"},
    {"obj_mesh", "Trace has mesh { file = \"name.obj\"; }"},
    {"displace", "Trace has displacement = texture(noise { }, 0.1) in the material of a mesh"},
    {"shape_light",
     "Trace has warn_light { }, with a cone and flaps, and projector_light { }, with a picture"},
    {"skybox", "Trace has settings { environment = \"folder\"; }, six pictures all around"},
    {"light_source", "Trace has point_light { position = (2, 4, 3); color = (1, 1, 1); }"},
    {"light", "Trace has point_light { }, directional_light { }, spot_light { } and rectangle_light { }"},
    {"cube", "Trace has box { }, of side 1 around the origin"},
    {"pigment", "Trace has diffuse = (red, green, blue); in a material"},
    {"finish", "Trace has specular, shininess and reflective in a material"},
    {"interior", "Trace has transmissive and index in a material"},
    {"location", "Trace has position = (x, y, z);"},
    {"merge", "Trace has union { }"},
    {"normal",
     "rotate x -90 deg { plane { } } is a floor; bump = texture(noise { }, 0.1) in a material bends normals"},
    {"elif", "else if (condition) { } is another branch of an if"},
    {"elsif", "else if (condition) { } is another branch of an if"},
    {"elseif", "else if (condition) { } is another branch of an if"},
    {"object", "Trace places any object itself: translate(x, y, z) { sphere { } }"},
};

/// Words of other languages by which a file says that more of the scene stands elsewhere, or is to be
/// computed. It is not known how much of the picture is lost without them, so they are errors.
constexpr std::array<std::string_view, 7> kBringsFiles{"include", "import", "load",  "require",
                                                       "source",  "use",    "insert"};
constexpr std::array<std::string_view, 12> kComputes{"for",    "foreach", "while", "repeat",
                                                     "loop",   "if",      "let",   "var",
                                                     "define", "declare", "macro", "function"};

template <std::size_t N>
bool isOneOf(const std::array<std::string_view, N>& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

std::string_view insteadOf(std::string_view kind) {
  for (const auto& [word, hint] : kInstead)
    if (word == kind) return hint;
  return {};
}

/// For a word that is not known.
std::string meant(std::string_view word, std::span<const std::string_view> known) {
  const std::string_view instead = insteadOf(word);
  return instead.empty() ? didYouMean(word, known) : std::string(instead);
}

/// For a part of a field's name: of `radius`, all that end with "_radius"; of `major`, all that begin with
/// "major_".
std::string partOf(std::string_view word, std::span<const std::string_view> known) {
  std::string text;
  for (const std::string_view field : known)
    if (field.ends_with("_" + std::string(word)) || field.starts_with(std::string(word) + "_"))
      text += (text.empty() ? "did you mean \"" : " or \"") + std::string(field) + "\"";
  return text.empty() ? text : text + "?";
}

constexpr std::array<std::string_view, 4> kSizes{"radius", "size", "width", "diameter"};
constexpr std::array<std::string_view, 3> kLengths{"height", "length", "depth"};
constexpr std::array<std::string_view, 6> kPlaces{"position",  "center", "centre",
                                                  "translate", "at",     "origin"};
constexpr std::array<std::string_view, 6> kCorners{"low", "high", "min", "max", "from", "to"};
constexpr std::array<std::string_view, 5> kColours{"color", "colour", "diffuse", "texture", "albedo"};

/// For a field by which other programs say what Trace says around the object or in its material.
std::string saidElsewhere(std::string_view owner, std::string_view name) {
  const std::string made = std::string(owner) + " { } }";
  if (owner == Material::kKeyword)
    return didYouMean(name, kColours).empty() ? "" : "diffuse = (red, green, blue) is its colour";
  if (owner == "rectangle_light" && (name == "direction" || isOneOf(kSizes, name) || isOneOf(kLengths, name)))
    return "u and v are its edges, which say how large it is; it shines toward u x v";
  if (!findShapeType(owner)) return {};
  if (isOneOf(kSizes, name))
    return "scale(2) { " + made + " makes it twice as large; scale(1, 2, 3) { " + made + ", along x, y and z";
  if (isOneOf(kLengths, name)) return "scale(1, 1, 2) { " + made + " makes it twice as long along z";
  if (isOneOf(kCorners, name))
    return "translate(1, 2, 3) { scale(4, 5, 6) { " + made +
           " } is from its middle (1, 2, 3) as large as that";
  if (isOneOf(kPlaces, name)) return "translate(1, 2, 3) { " + made + " puts it there";
  if (isOneOf(kColours, name)) return "material = { diffuse = (red, green, blue) } is its colour";
  return {};
}

/// For a field that is like no other: all there are, if they are few.
std::string allOf(std::span<const std::string_view> fields) {
  constexpr std::size_t kFew = 12;
  if (fields.empty() || fields.size() > kFew) return {};
  std::string text;
  for (std::string_view field : fields) text += (text.empty() ? "it has " : ", ") + std::string(field);
  return text;
}

std::string quotedStart(std::string_view word) { return "\"" + std::string(word.substr(0, 60)) + "\""; }

}  // namespace

bool isRelative(std::string_view keyword) {
  return std::find(kRelatives.begin(), kRelatives.end(), keyword) != kRelatives.end();
}

/// The hint, and the calls and loops of the language that made the item.
static std::string hintWithChain(const Item& at, std::string hint) {
  const std::string chain = at.chain();
  if (chain.empty()) return hint;
  return hint.empty() ? chain : hint + "; " + chain;
}

void Findings::error(const Item& at, std::string what, std::string hint) {
  ++errors_;
  for (Failure& failure : failures_)
    if (failure.offset == at.offset() && failure.what == what) return void(++failure.times);
  failures_.push_back({at.offset(), std::move(what), hintWithChain(at, std::move(hint))});
  if (failures_.size() == Messages::kMostErrors) reportErrors();
}

void Findings::take(std::span<const Syntax::Mistake> mistakes) {
  for (const Syntax::Mistake& mistake : mistakes) {
    ++errors_;
    failures_.push_back({mistake.offset, mistake.what, mistake.hint, mistake.times, true});
  }
}

/// Errors of the rest of a line of which a part was left out.
void Findings::dropFollowing() {
  const auto line = [&](const Failure& failure) {
    const SourcePlace place = syntax_.shortPlace(failure.offset);
    return std::pair(place.file, place.line);
  };
  const Failure* left = nullptr;
  std::vector<Failure> kept;
  for (const Failure& failure : failures_) {
    if (failure.leavesOut) left = &failure;
    if (failure.leavesOut || !left || line(*left) != line(failure)) kept.push_back(failure);
  }
  failures_ = std::move(kept);
}

void Findings::reportErrors() {
  std::stable_sort(failures_.begin(), failures_.end(),
                   [](const Failure& a, const Failure& b) { return a.offset < b.offset; });
  dropFollowing();
  for (Failure& failure : failures_) {
    if (failure.times > 1) failure.what += " (" + std::to_string(failure.times) + " times)";
    messages_.error(syntax_.place(failure.offset), std::move(failure.what), std::move(failure.hint));
  }
  failures_.clear();
}

void Findings::expected(const Item& value, std::string_view name, const std::string& what, std::string hint) {
  error(value, std::string(name) + ": expected " + what + ", found " + describe(value), std::move(hint));
}

bool Findings::again(const std::string& kind) {
  const auto found = kinds_.find(kind);
  if (found == kinds_.end()) return false;
  ++warnings_[found->second].times;
  return true;
}

void Findings::add(const std::string& kind, const Item& at, std::string what, std::string hint) {
  const bool full = warnings_.size() < kFullWarnings;
  kinds_.emplace(kind, warnings_.size());
  warnings_.push_back({full ? syntax_.place(at.offset()) : syntax_.shortPlace(at.offset()), std::move(what),
                       full ? hintWithChain(at, std::move(hint)) : std::string(), 1});
}

void Findings::warn(const Item& at, std::string what, std::string hint, std::string_view kind) {
  const std::string key = kind.empty() ? what : std::string(kind);
  if (!again(key)) add(key, at, std::move(what), std::move(hint));
}

void Findings::warnOfNumber(const Item& at, std::string what, std::size_t count) {
  const std::string kind = what;
  if (!again(kind)) {
    add(kind, at, std::move(what), {});
    warnings_.back().times = 0;
    warnings_.back().sums = true;
  } else {
    --warnings_[kinds_.find(kind)->second].times;
  }
  warnings_[kinds_.find(kind)->second].times += count;
}

void Findings::notRendered(std::string_view kind, const Item& node, std::span<const std::string_view> known) {
  notRendered(kind, node, std::string(node.source()), known);
}

bool Findings::refuse(std::string_view kind, const Item& at) {
  if (isOneOf(kBringsFiles, kind))
    error(at, quotedStart(kind) + ": this does not read another file",
          "include \"pieces.ray\" reads a scene (docs/language.md), mesh { file = \"name.obj\"; } a mesh");
  else if (isOneOf(kComputes, kind))
    error(at, quotedStart(kind) + ": expected an object",
          "docs/language.md has let a = 1, define f(a) { }, for i in 0..9 { }, if (a < 1) { } else { }");
  else
    return false;
  return true;
}

void Findings::notRendered(std::string_view kind, const Item& node, std::string text,
                           std::span<const std::string_view> known) {
  if (refuse(kind, node)) return;
  if (isOfKind()) return error(node, quotedStart(kind) + " is not known", meant(kind, known));
  scene_.unrendered.push_back({std::string(kind), syntax_.shortPlace(node.offset()), std::move(text)});
  const std::string key = "not rendered: " + std::string(kind);
  if (again(key)) return;
  if (isRelative(kind))
    add(key, node, quotedStart(kind) + " is not rendered yet", std::string(insteadOf(kind)));
  else
    add(key, node, quotedStart(kind) + " is not known and is left out", meant(kind, known));
}

void Findings::unknownField(std::string_view owner, const Item& field,
                            std::span<const std::string_view> known) {
  const std::string_view name = field.key();
  if (isRelative(name)) return notRendered(name, field, known);
  const std::string key = "unknown field: " + std::string(owner) + "." + std::string(name);
  if (!isOfKind() && again(key)) return;
  std::string hint;
  if (warnings_.size() < kFullWarnings) hint = meant(name, known);
  if (warnings_.size() < kFullWarnings && hint.empty()) hint = partOf(name, known);
  if (warnings_.size() < kFullWarnings && hint.empty()) hint = saidElsewhere(owner, name);
  if (warnings_.size() < kFullWarnings && hint.empty()) hint = allOf(known);
  if (isOfKind())
    return error(field, std::string(owner) + " has no field " + quotedStart(name), std::move(hint));
  add(key, field, "unknown field " + quotedStart(name) + " of " + std::string(owner) + " is ignored",
      std::move(hint));
}

bool Findings::isUnknown(std::string_view owner, std::string_view field) const {
  return kinds_.contains("unknown field: " + std::string(owner) + "." + std::string(field)) ||
         kinds_.contains("not rendered: " + std::string(field));
}

void Findings::signOf2001(const Item& at) {
  if (!of2001_) of2001_ = syntax_.place(at.offset());
}

void Findings::noteShininess(const Item& at, double shininess) {
  if (!(shininess > 0 && shininess <= 1))
    largeShininess_ = true;
  else if (!smallShininess_)
    smallShininess_ = syntax_.place(at.offset());
}

void Findings::finish() {
  reportErrors();
  finishDialect();
  for (Warning& warning : warnings_) {
    if (warning.sums)
      warning.what += ": " + std::to_string(warning.times);
    else if (warning.times > 1)
      warning.what += " (" + std::to_string(warning.times) + " times, first here)";
    messages_.warn(std::move(warning.place), std::move(warning.what), std::move(warning.hint));
  }
  warnings_.clear();
  kinds_.clear();
}

std::optional<Item> blockOf(Findings& findings, const Item& call) {
  if (call.value().is(Kind::block)) return call.value();
  findings.expected(call.value(), call.key(), "{ ... }");
  return {};
}

bool isField(Findings& findings, const Item& item, std::string_view owner) {
  if (item.keyed()) return true;
  findings.expected(item, owner, "a field, as in name = value");
  return false;
}

void RepeatedFields::note(const Item& field) {
  const std::string_view key = field.key();
  if (std::find(given_.begin(), given_.end(), key) == given_.end()) return given_.push_back(key);
  if (findings_.isUnknown(owner_, key)) return;  // and told as such
  findings_.warn(field, std::string(key) + " of " + std::string(owner_) + " given again; the last counts");
}

/// Words of 2001 and shininess tell only where nothing says that the file is newer, and no highlight has an
/// exponent above 1. Exponents from 0 to 1 would make highlights uselessly wide.
void Findings::finishDialect() {
  if (isOfKind() || later_ || largeShininess_) return;
  const std::optional<SourcePlace>& sign = of2001_ ? of2001_ : smallShininess_;
  if (!sign) return;
  for (const Choice& choice : scene_.choices)
    if (choice.option == "like") return;
  scene_.choices.push_back({"like", "uw2001", *sign});
}

}  // namespace trace::rayfile
