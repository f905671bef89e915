// Source: the MTL material format of Wavefront's Advanced Visualizer, appendix B1, and the extension for
// physically based materials that exporters write (Pr, Pm, map_Pr, norm ...).
#include "formats/mesh/mtl_lines.h"

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <vector>

#include "base/field.h"
#include "formats/mesh/obj_words.h"
#include "formats/words.h"

namespace trace {
namespace {

/// A statement of numbers.
struct Numbers {
  std::string_view key;
  int count;
  double least, most;
};
constexpr std::array<Numbers, 19> kNumbers{{{"Ka", 3, 0, 1},
                                            {"Kd", 3, 0, 1},
                                            {"Ks", 3, 0, 1},
                                            {"Ke", 3, 0, kNoLimit},
                                            {"Kt", 3, 0, 1},
                                            {"Tf", 3, 0, 1},
                                            {"Ns", 1, 0, kNoLimit},
                                            {"Ni", 1, 0.001, kNoLimit},  // what MTL allows
                                            {"d", 1, 0, 1},
                                            {"Tr", 1, 0, 1},
                                            {"illum", 1, 0, 10},
                                            {"sharpness", 1, 0, kNoLimit},
                                            {"Pr", 1, 0, 1},
                                            {"Pm", 1, 0, 1},
                                            {"Ps", 1, 0, 1},
                                            {"Pc", 1, 0, 1},
                                            {"Pcr", 1, 0, 1},
                                            {"aniso", 1, 0, 1},
                                            {"anisor", 1, 0, 1}}};

/// Statements that name a picture.
constexpr std::array<std::string_view, 21> kMaps{
    "map_Ka", "map_Kd",   "map_Ks",   "map_Ke",   "map_Ns",   "map_d", "map_Tr",
    "map_Pr", "map_Pm",   "map_Ps",   "map_Bump", "map_bump", "bump",  "map_Disp",
    "disp",   "map_disp", "map_refl", "refl",     "norm",     "decal", "map_norm"};

/// Maps whose picture is rendered, unless another takes their place (formats/mesh/obj_material.h).
constexpr std::array<std::string_view, 16> kRendered{
    "map_Ka", "map_Kd", "map_Ks", "map_Ke", "map_Ns", "map_d",    "map_Bump", "map_bump",
    "bump",   "norm",   "map_Pr", "map_Pm", "map_Ps", "map_Disp", "map_disp", "disp"};

/// An option of a texture, and how many words follow it at most. What is missing of several numbers is
/// `otherwise`.
struct MapOption {
  std::string_view key;
  int words;
  std::string_view otherwise{};
};
constexpr std::array<MapOption, 14> kMapOptions{{{"-blendu", 1},
                                                 {"-blendv", 1},
                                                 {"-cc", 1},
                                                 {"-clamp", 1},
                                                 {"-boost", 1},
                                                 {"-bm", 1},
                                                 {"-texres", 1},
                                                 {"-imfchan", 1},
                                                 {"-type", 1},
                                                 {"-colorspace", 1},
                                                 {"-mm", 2, "1"},
                                                 {"-o", 3, "0"},
                                                 {"-s", 3, "1"},
                                                 {"-t", 3, "0"}}};
/// Options of maps without effect on what is rendered, or with one that is rendered.
constexpr std::array<std::string_view, 9> kMapOptionsUsed{
    "-bm", "-blendu", "-blendv", "-clamp", "-imfchan", "-type", "-colorspace", "-o", "-s"};

template <class Row, std::size_t N>
const Row* rowOf(const std::array<Row, N>& rows, std::string_view key) {
  const auto row = std::find_if(rows.begin(), rows.end(), [&](const Row& r) { return r.key == key; });
  return row == rows.end() ? nullptr : &*row;
}

std::string quoted(std::string_view word) { return "\"" + std::string(word.substr(0, 40)) + "\""; }

/// The values of an option of a single word.
bool isOptionValue(std::string_view word) {
  constexpr std::array<std::string_view, 19> kValues{
      "on",         "off",       "r",         "g",          "b",      "m",        "l",
      "z",          "sRGB",      "srgb",      "linear",     "sphere", "cube_top", "cube_bottom",
      "cube_front", "cube_back", "cube_left", "cube_right", "Linear"};
  return isFloat(word) || listed(kValues, word);
}

/// Calls option(row, word, words) for each of the options that the words begin with, and leaves the rest.
template <class Visit>
void takeOptions(LineWords& words, Visit&& visit) {
  while (words.peek().starts_with('-')) {
    const MapOption* option = rowOf(kMapOptions, words.peek());
    if (!option) return;
    const std::string_view key = words.next();
    std::vector<std::string_view> values;
    for (int i = 0; i < option->words && (option->words == 1 || isFloat(words.peek())); ++i)
      values.push_back(words.next());
    visit(*option, key, values);
  }
}

/// Where the options begin that some programs write after the name: all from there on are options with values
/// that they can have. The length of the text if there are none.
std::size_t optionsAfter(std::string_view text) {
  for (std::size_t at = text.find(" -"); at != text.npos; at = text.find(" -", at + 1)) {
    LineWords words(text.substr(at));
    bool good = true;
    takeOptions(words, [&](const MapOption&, std::string_view, const std::vector<std::string_view>& values) {
      good = good && !values.empty() && std::all_of(values.begin(), values.end(), isOptionValue);
    });
    if (good && words.rest().empty()) return at;
  }
  return text.size();
}

/// Calls option(row, word, words) for each option of a map, and returns the name of the picture between them.
template <class Visit>
std::string_view pictureOf(LineWords words, Visit&& visit) {
  takeOptions(words, visit);
  const std::string_view rest = words.rest();
  const std::size_t end = optionsAfter(rest);
  LineWords after(rest.substr(end));
  takeOptions(after, visit);
  return LineWords(rest.substr(0, end)).rest();
}

/// One for all spellings of a map, with the picture.
std::string mapAndPicture(std::string_view keyword, std::string_view picture) {
  if (sameWord(keyword, "map_bump")) keyword = "bump";
  if (sameWord(keyword, "map_disp")) keyword = "disp";
  return std::string(keyword) + ' ' + std::string(picture);
}

class MtlCheck {
 public:
  /// `lines` are the text with continued lines made one.
  MtlCheck(const std::string& file, std::string_view text, std::string_view lines, UnusedTextures& textures,
           MapPlaces& pictures, WarningsByKind& warnings)
      : file_(file),
        text_(text),
        lines_(lines),
        textures_(textures),
        pictures_(pictures),
        warnings_(warnings) {}

  void line(std::string_view line) {
    LineWords words(line);
    const std::string_view written = words.next(), key = keyword(written);
    if (key == "newmtl") endMaterial();
    check(written, key, words);
    noteOpacity(written, key, words);
    plain_ += plainOf(line, key, words);
    plain_ += '\n';
  }
  /// The lines checked so far, for tinyobjloader.
  std::string plain() {
    endMaterial();
    return std::move(plain_);
  }

 private:
  /// A picture is multiplied by its constant, which is white where it is not given.
  void endMaterial() {
    static constexpr std::array<std::array<std::string_view, 2>, 4> kConstants{{{"map_Ka", "Ka 1 1 1\n"},
                                                                                {"map_Kd", "Kd 1 1 1\n"},
                                                                                {"map_Ks", "Ks 1 1 1\n"},
                                                                                {"map_Ke", "Ke 1 1 1\n"}}};
    for (const auto& [map, constant] : kConstants)
      if (given_.contains(map) && !given_.contains(constant.substr(0, 2))) plain_ += constant;
    given_.clear();
    endOpacity();
  }

  /// In the letters of the specification, where it is known in those or others: KD, Map_Kd.
  static std::string_view keyword(std::string_view written) {
    if (written.empty() || written[0] == '#' || rowOf(kNumbers, written) || listed(kMaps, written))
      return written;
    if (sameWord(written, "newmtl")) return "newmtl";
    for (const Numbers& row : kNumbers)
      if (sameWord(row.key, written)) return row.key;
    for (std::string_view map : kMaps)
      if (sameWord(map, written)) return map;
    return written;
  }

  // --- what light a material lets through ---

  void noteOpacity(std::string_view at, std::string_view key, LineWords words) {
    if (key != "d" && key != "Tr") return;
    std::string_view word = words.next();
    if (word == "-halo") word = words.next();
    const auto number = parseNumber(word);
    if (!number) return;
    (key == "d" ? dissolve_ : transparency_) = number->value;
    opacityAt_ = at;
  }
  /// Programs disagree whether Tr is the transparency or its opposite, and many write d 0 for nothing at all:
  /// a material that nobody could see is taken to be opaque where its lines leave that open.
  void endOpacity() {
    const bool onlyTr = !dissolve_ && transparency_ == 1;
    const bool contradict = dissolve_ == 0 && transparency_ == 0;
    if (onlyTr || contradict) {
      warn(opacityAt_, onlyTr ? "Tr 1 without d would make the material invisible: it is read as opaque"
                              : "d 0 and Tr 0 contradict each other: the material is read as opaque");
      plain_ += "d 1\n";
    } else if (dissolve_ == 0) {
      warn(opacityAt_, "d 0 makes the material transparent: it is invisible, except for its highlights");
    }
    dissolve_.reset();
    transparency_.reset();
    opacityAt_ = {};
  }

  /// `Kd 0.5` as `Kd 0.5 0.5 0.5`, and so all colours; options of a texture with all their numbers; other
  /// lines as they are.
  static std::string plainOf(std::string_view line, std::string_view key, LineWords words) {
    if (listed(kMaps, key)) return plainMap(key, words);
    const Numbers* row = rowOf(kNumbers, key);
    if (!row && key != "newmtl") return std::string(line);
    if (key == "d" && words.peek() == "-halo") words.next();
    const std::string rest(words.rest());
    const std::string_view first = words.next(), second = words.next();
    if (row && row->count == 3 && isFloat(first) && (second.empty() || second[0] == '#'))
      return std::string(key) + ' ' + std::string(first) + ' ' + std::string(first) + ' ' +
             std::string(first);
    return std::string(key) + ' ' + rest;
  }

  static std::string plainMap(std::string_view key, const LineWords& words) {
    std::string text(key);
    const std::string_view picture = pictureOf(words, [&](const MapOption& option, std::string_view name,
                                                          const std::vector<std::string_view>& values) {
      if (name == "-cc") return;  // which tinyobjloader would take for the picture
      text += ' ' + std::string(name);
      for (std::string_view value : values) text += ' ' + std::string(value);
      for (auto i = static_cast<int>(values.size()); i < option.words; ++i)
        text += ' ' + std::string(option.otherwise);
    });
    return text + ' ' + std::string(picture);
  }

  /// `key` is the keyword as the specification writes it, `at` as the line does.
  void check(std::string_view at, std::string_view key, LineWords words) {
    if (key.empty() || key[0] == '#') return;
    if (key == "newmtl") return newMaterial(at, words);
    given_.insert(key);
    if (!inMaterial_)
      warn(at, "expected \"newmtl\" before the first line of a material, found " + quoted(key));
    if (const Numbers* row = rowOf(kNumbers, key)) return numbers(*row, at, words);
    if (listed(kMaps, key)) return map(at, key, words);
    if (key == "map_aat") return warn(at, "\"map_aat\" is not shown");
    warn(at, quoted(key) + " is not known and is skipped");
  }

  void warn(std::string_view at, std::string what, std::string_view kind = {}) {
    if (!warnings_.again(kind.empty() ? what : kind)) warnings_.warn(place(at), std::move(what), {}, kind);
  }
  SourcePlace place(std::string_view at) const {
    return placeAt(file_, text_, static_cast<std::size_t>(at.data() - lines_.data()));
  }

  void newMaterial(std::string_view key, LineWords words) {
    inMaterial_ = true;
    if (words.rest().empty()) warn(key, "newmtl: expected the name of a material");
  }

  void numbers(const Numbers& row, std::string_view key, LineWords words) {
    const std::string name(row.key);
    int count = 0;
    for (std::string_view word = words.next(); !word.empty() && word[0] != '#';
         word = words.next(), ++count) {
      if (row.key == "d" && word == "-halo") {
        warn(word, "d -halo is not shown: the material is as transparent seen from everywhere");
        --count;
        continue;
      }
      const auto number = parseNumber(word);
      if (!isFloat(word)) return warn(word, name + ": " + notAFloat(word), name);
      if (count < row.count && !(number->value >= row.least && number->value <= row.most))
        warn(word,
             name + ": expected " +
                 (row.most == kNoLimit ? "at least " + toText(row.least)
                                       : toText(row.least) + " to " + toText(row.most)) +
                 ", found " + toText(number->value),
             "range of " + name);
      if (row.key == "illum" && count == 0) illumination(word, static_cast<int>(number->value));
    }
    if (row.key == "sharpness") warn(key, "\"sharpness\" of reflected pictures is not shown");
    const bool isGrey = row.count == 3 && count == 1;
    if (count != row.count && !isGrey)
      warn(key,
           name + ": expected " + std::to_string(row.count) + (row.count == 1 ? " number" : " numbers") +
               ", found " + std::to_string(count),
           "count of " + name);
  }

  /// Illumination models that are shown as another one.
  void illumination(std::string_view at, int model) {
    if (model == 0) warn(at, "illum 0, a colour without light, is shown as a lit surface");
    if (model == 8) warn(at, "illum 8, a reflection without ray tracing, is shown without reflection");
    if (model == 10) warn(at, "illum 10, which shows only shadows, is shown as a lit surface");
  }

  void map(std::string_view at, std::string_view key, LineWords words) {
    const std::string_view picture = pictureOf(
        words, [&](const MapOption&, std::string_view name, const std::vector<std::string_view>& values) {
          const bool isBlend = name == "-blendu" || name == "-blendv";
          if (!listed(kMapOptionsUsed, name) || (isBlend && !values.empty() && sameWord(values[0], "off")))
            warn(name, "the option \"" + std::string(name) + "\" of a texture is ignored");
        });
    if (picture.empty()) return warn(at, std::string(key) + ": expected the name of a picture");
    if (!pictures_.find(key, picture)) pictures_.note(key, picture, {place(picture), std::string(at)});
    if (!listed(kRendered, key)) textures_.note(picture, textures_.empty() ? place(at) : SourcePlace(), at);
  }

  const std::string& file_;
  std::string_view text_, lines_;
  std::string plain_;
  UnusedTextures& textures_;
  MapPlaces& pictures_;
  WarningsByKind& warnings_;
  std::set<std::string_view> given_;               ///< keywords of the material so far
  std::optional<double> dissolve_, transparency_;  ///< d and Tr
  std::string_view opacityAt_;                     ///< the last of them
  bool inMaterial_ = false;
};

}  // namespace

void MapPlaces::note(std::string_view keyword, std::string_view picture, Line line) {
  lines_.emplace(mapAndPicture(keyword, picture), std::move(line));
}

const MapPlaces::Line* MapPlaces::find(std::string_view keyword, std::string_view picture) const {
  const auto found = lines_.find(mapAndPicture(keyword, picture));
  return found == lines_.end() ? nullptr : &found->second;
}

std::string checkedMtl(const std::string& file, std::string_view text, UnusedTextures& textures,
                       MapPlaces& pictures, WarningsByKind& warnings) {
  std::string room;
  const std::string_view lines = joinedLines(text, room);
  MtlCheck checker(file, text, lines, textures, pictures, warnings);
  forEachLine(lines, [&](std::string_view line) { checker.line(line); });
  return checker.plain();
}

}  // namespace trace
