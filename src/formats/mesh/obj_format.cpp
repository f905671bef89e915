// The lines of an OBJ, read once: corners become points, and faces triangles, as they come. What is wrong in
// a line costs the faces that use it, and no more. Source: the Object Files of Wavefront's Advanced
// Visualizer, appendix B1.
#include "formats/mesh/obj_format.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/budget.h"
#include "base/text.h"
#include "base/unique.h"
#include "formats/mesh/obj_material.h"
#include "formats/mesh/obj_words.h"
#include "formats/warnings.h"
#include "formats/words.h"
#include "geometry/mesh/mesh.h"
#include "geometry/mesh/mesh_repair.h"

#define TINYOBJLOADER_IMPLEMENTATION
#include "formats/mesh/obj_materials.h"

namespace trace {
namespace {

/// The indices of one corner of a face; -1 for nothing.
struct Corner {
  std::int32_t point, uv, normal;
};

/// The faces of one name and material.
struct Part {
  std::string name;
  std::string_view materialName;  ///< as the line says it
  std::size_t number = 0;         ///< among the parts
  std::uint32_t material = Model::kNoMaterial;
  Unique<Corner> corners;
  MeshData mesh;
  std::vector<std::size_t> lines;  ///< the byte of the line of each triangle
  bool hasNormals = false, hasUvs = false;
};

/// The value of white in the colours of points: 255 where all are whole numbers and one is beyond what
/// rounding and bright light make of 1.
float whiteOf(const std::vector<Vec3f>& colors) {
  float most = 0;
  for (const Vec3f& c : colors)
    for (const float x : {c.x, c.y, c.z}) {
      if (x != std::floor(x)) return 1;
      most = std::max(most, x);
    }
  return most > 2 ? 255 : 1;
}

/// Keywords of the format, in lower case.
constexpr std::array<std::string_view, 2> kThin{"l", "p"};
constexpr std::array<std::string_view, 3> kCurved{"curv", "curv2", "surf"};
/// Keywords of curves and surfaces, which are reported by themselves.
constexpr std::array<std::string_view, 15> kOfCurves{"vp",   "cstype", "deg",   "bmat",  "step",
                                                     "parm", "trim",   "hole",  "scrv",  "sp",
                                                     "end",  "con",    "ctech", "stech", "mg"};
/// Other keywords of the format, which Trace does not show.
constexpr std::array<std::string_view, 10> kNotShown{"bevel",     "c_interp", "d_interp", "lod", "shadow_obj",
                                                     "trace_obj", "maplib",   "usemap",   "csh", "call"};

/// The numbers of a corner of a face: of a point, a uv and a normal; 0 for none.
struct CornerNumbers {
  std::int64_t point = 0, uv = 0, normal = 0;
};

/// Does a corner of a face end there?
bool endsCorner(std::string_view text, std::size_t at) {
  return at >= text.size() || text[at] == ' ' || text[at] == '\t' || text[at] == '\r' || text[at] == ';';
}

/// Takes 7, 7/8, 7//9 or 7/8/9, each perhaps negative, and with slashes behind that say nothing, off the
/// text, or takes nothing. A point's number that is too large for any file stays so.
std::optional<CornerNumbers> takeCorner(std::string_view& text) {
  constexpr std::int64_t kBeyond = std::int64_t{1} << 40;
  CornerNumbers corner;
  std::size_t at = 0;
  for (std::int64_t* number : {&corner.point, &corner.uv, &corner.normal}) {
    const bool isPoint = number == &corner.point;
    if (endsCorner(text, at)) {
      if (isPoint) return {};
      break;
    }
    const bool negative = text[at] == '-';
    if (negative || text[at] == '+') ++at;
    const std::size_t first = at;
    for (; at < text.size() && text[at] >= '0' && text[at] <= '9'; ++at)
      if (*number < kBeyond) *number = *number * 10 + (text[at] - '0');
    if (isPoint ? at == first : at - first > 9) return {};
    if (negative) *number = -*number;
    if (endsCorner(text, at)) break;
    if (text[at++] != '/') return {};
  }
  if (!endsCorner(text, at)) return {};
  text.remove_prefix(at);
  return corner;
}

/// How many of each the file has, up to some line.
struct Counts {
  std::size_t points = 0, uvs = 0, normals = 0;
};

/// The index from 0 of what the file counts from 1, or backwards from -1 where there are `here` so far; -1 if
/// there are too few of them.
std::int32_t indexOf(std::int64_t number, std::size_t here, std::size_t most) {
  const std::int64_t index = number > 0 ? number - 1 : static_cast<std::int64_t>(here) + number;
  const bool exists = number != 0 && index >= 0 && index < static_cast<std::int64_t>(most);
  return exists ? static_cast<std::int32_t>(index) : -1;
}

/// Without the comment, which may follow on numbers.
std::string_view withoutComment(std::string_view text) { return text.substr(0, text.find('#')); }

class ObjReader {
 public:
  ObjReader(const std::string& file, std::string_view bytes, Messages& messages)
      : file_(file), place_{file, 0, 0, {}}, bytes_(bytes), messages_(messages) {}

  Model read() {
    lines_ = joinedLines(bytes_, room_);
    forEachLine(lines_, [&](std::string_view text) {
      checkBudget();
      line(text);
    });
    for (const LateFace& late : late_) face(*parts_[late.part], late.corners, late.at);
    finish();
    return std::move(model_);
  }

 private:
  /// A face that uses what the file gives later.
  struct LateFace {
    std::size_t part;
    std::vector<Corner> corners;
    std::size_t at;  ///< the byte of its line
  };

  // --- lines ---

  void line(std::string_view text) {
    LineWords words(text);
    const std::string_view key = words.next();
    if (key.empty() || key[0] == '#') return;
    if (!statement(key, key, words, text)) {
      std::string lower(key.substr(0, 20));  // as old programs write all in capitals
      for (char& c : lower)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c + 32);
      if (lower == key || !statement(lower, key, words, text))
        warn(key, "\"" + std::string(key.substr(0, 40)) + "\" is not known and is skipped");
    }
  }

  /// False if the keyword is not known. `at` is where it stands.
  bool statement(std::string_view key, std::string_view at, const LineWords& words, std::string_view text) {
    if (key == "v")
      point(text, words);
    else if (key == "f" || key == "fo")  // an old word for it
      faceLine(at, words);
    else if (key == "vn")
      normals_.push_back(vector<3>(text, words, "vn", 3));
    else if (key == "vt")
      uv(text, words);
    else if (key == "usemtl")
      useMaterial(at, words);
    else if (key == "o" || key == "g")
      useName(words);
    else if (key == "mtllib")
      materialFiles_.push_back(LineWords(words).rest());
    else if (listed(kThin, key))
      warn(at, "points and lines are left out");
    else if (listed(kCurved, key))
      warn(at, "curves and surfaces are left out");
    else if (key == "s")
      smooth_ = words.peek() == "0" || sameWord(words.peek(), "off") ? std::string_view() : at;
    else if (listed(kNotShown, key))
      warn(at, "\"" + std::string(key) + "\" is not shown");
    else
      return listed(kOfCurves, key);
    return true;
  }

  /// Its numbers, of which there may be up to `most` and must be `least`; how many there are. What is no
  /// number is NaN, which costs the faces that use it.
  template <std::size_t N>
  std::size_t numbers(std::string_view text, LineWords words, std::string_view key, std::size_t least,
                      std::array<float, N>& to) {
    words = LineWords(withoutComment(words.left()));
    std::size_t count = 0;
    bool good = true;
    for (; !words.atEnd(); ++count) {
      if (count >= N) {
        warn(text, std::string(key) + ": expected at most " + std::to_string(N) +
                       " numbers, found more; they are ignored");
        break;
      }
      LineWords before = words;
      const auto number = words.nextNumber();
      if (number && std::abs(*number) <= std::numeric_limits<float>::max()) {
        to[count] = static_cast<float>(*number);
        continue;
      }
      words = before;
      const std::string_view word = words.next();
      if (good) lose(word, notAFloat(word), leftOut(key));
      good = false;
    }
    if (count < least && good)
      lose(text,
           "expected " + std::to_string(least) + " numbers after \"" + std::string(key) + "\", found " +
               std::to_string(count),
           leftOut(key));
    if (!good || count < least) {
      to.fill(std::numeric_limits<float>::quiet_NaN());
      allFinite_ = false;
    }
    return std::min(count, N);
  }
  static std::string leftOut(std::string_view key) {
    return key == "v" ? "faces that use the point are left out" : "it is left out";
  }

  template <std::size_t N>
  Vec3f vector(std::string_view text, const LineWords& words, std::string_view key, std::size_t least) {
    std::array<float, N> n{};
    numbers(text, words, key, least, n);
    return {n[0], n[1], n[2]};
  }

  /// Three numbers, perhaps with a weight or a colour or both.
  void point(std::string_view text, const LineWords& words) {
    std::array<float, 7> n{};
    const std::size_t count = numbers(text, words, "v", 3, n);
    if (count >= 6) {  // the last three; points before it that have none are white
      colors_.resize(points_.size(), {1, 1, 1});
      colors_.push_back({n[count - 3], n[count - 2], n[count - 1]});
    } else if (!colors_.empty()) {
      colors_.push_back({1, 1, 1});
    }
    if (count == 5) warn(text, "v: expected 3 numbers, found 5; the last two are ignored");
    points_.push_back({n[0], n[1], n[2]});
  }

  void uv(std::string_view text, const LineWords& words) {
    std::array<float, 3> n{};
    numbers(text, words, "vt", 1, n);
    uvs_.push_back({n[0], n[1]});
  }

  void useMaterial(std::string_view at, LineWords words) {
    material_ = words.rest();
    part_ = nullptr;
    if (material_.empty()) return warn(at, "usemtl: expected the name of a material");
    names_.try_emplace(material_, static_cast<std::size_t>(material_.data() - lines_.data()));
  }

  /// The words of the line with one blank between.
  void useName(LineWords words) {
    name_.clear();
    for (std::string_view word = words.next(); !word.empty(); word = words.next())
      name_ += (name_.empty() ? "" : " ") + std::string(word);
    part_ = nullptr;
  }

  // --- faces ---

  Part& part() {
    if (part_) return *part_;
    const auto [found, fresh] = partNumbers_.try_emplace({name_, material_}, parts_.size());
    if (fresh) {
      parts_.push_back(std::make_unique<Part>());
      parts_.back()->name = name_;
      parts_.back()->materialName = material_;
      parts_.back()->number = found->second;
    }
    return *(part_ = parts_[found->second].get());
  }

  void faceLine(std::string_view at, LineWords words) {
    words = LineWords(withoutComment(words.left()));
    const std::string_view line = words.left();
    const Counts here{points_.size(), uvs_.size(), normals_.size()};
    bool isBeyond = false;  // it uses what the file has not given yet
    numbers_.clear();
    for (std::string_view left = words.rest(); !left.empty() && left[0] != ';';
         left = LineWords(left).rest()) {
      const std::optional<CornerNumbers> corner = takeCorner(left);
      if (!corner)
        return lose(left,
                    "expected a corner such as 7, 7/8, 7//9 or 7/8/9, found \"" +
                        std::string(LineWords(left).next().substr(0, 40)) + "\"",
                    "the face is left out", {}, "corner");
      numbers_.push_back(*corner);
      const auto isLater = [](std::int64_t number, std::size_t count) {
        return number > static_cast<std::int64_t>(count);
      };
      isBeyond |= isLater(corner->point, here.points) || isLater(corner->uv, here.uvs) ||
                  isLater(corner->normal, here.normals);
    }
    if (numbers_.size() < 3) return warn(at, "a face of fewer than 3 points is left out");
    if (!resolve(line, here, isBeyond ? wholeCounts() : here)) return;
    if (!smooth_.empty() && corners_.front().normal < 0)
      warn(std::exchange(smooth_, {}), "smoothing groups are not shown: faces without normals look flat");
    if (isBeyond)
      late_.push_back({part().number, corners_, offset(at)});
    else
      face(part(), corners_, offset(at));
  }

  /// Makes corners_ of numbers_, which stand in the line, where the file has `most` in all. False, with a
  /// warning, if it lacks a point.
  bool resolve(std::string_view line, const Counts& here, const Counts& most) {
    corners_.clear();
    for (const CornerNumbers& n : numbers_) {
      const Corner corner{indexOf(n.point, here.points, most.points), indexOf(n.uv, here.uvs, most.uvs),
                          indexOf(n.normal, here.normals, most.normals)};
      if (corner.point < 0) {
        loseFace(wordAt(line, corners_.size()), most.points);
        return false;
      }
      if ((n.uv != 0 && corner.uv < 0) || (n.normal != 0 && corner.normal < 0))
        warn(wordAt(line, corners_.size()), "normals or uv that the file does not have are left out");
      corners_.push_back(corner);
    }
    return true;
  }

  void loseFace(std::string_view corner, std::size_t points) {
    lose(corner,
         "the face uses point " + std::string(corner.substr(0, std::min<std::size_t>(corner.find('/'), 40))) +
             ", but there " + (points == 1 ? "is " : "are ") + counted(points, "point"),
         "it is left out", "points are counted from 1, or backwards from -1", "point");
  }

  static std::string_view wordAt(std::string_view line, std::size_t index) {
    LineWords words(line);
    for (std::size_t i = 0; i < index; ++i) words.next();
    const std::string_view word = words.next();
    return word.substr(0, word.find(';'));
  }

  /// Those of the whole file, counted when a face first asks.
  const Counts& wholeCounts() {
    if (counts_) return *counts_;
    counts_.emplace();
    forEachLine(lines_, [&](std::string_view text) {
      const std::string_view key = LineWords(text).next();
      counts_->points += sameWord(key, "v");
      counts_->uvs += sameWord(key, "vt");
      counts_->normals += sameWord(key, "vn");
    });
    return *counts_;
  }

  /// A face that uses a point which is not finite is left out: the line of the point has its warning.
  void face(Part& to, std::span<const Corner> corners, std::size_t at) {
    const auto isBad = [&](const Corner& corner) {
      return !isFinite(Vec3(points_[static_cast<std::size_t>(corner.point)]));
    };
    if (!allFinite_ && std::any_of(corners.begin(), corners.end(), isBad)) return;
    polygon_.clear();
    for (const Corner& corner : corners) polygon_.push_back(this->corner(to, corner));
    appendPolygon(to.mesh, polygon_);
    to.lines.resize(to.mesh.triangles.size(), at);
  }

  std::uint32_t corner(Part& to, const Corner& corner) {
    const std::uint32_t number = to.corners.number(corner);
    if (number < to.mesh.points.size()) return number;
    const auto at = [](std::int32_t index) { return static_cast<std::size_t>(index); };
    to.mesh.points.push_back(points_[at(corner.point)]);
    to.mesh.normals.push_back(corner.normal < 0 ? Vec3f{} : normals_[at(corner.normal)]);
    to.mesh.uvs.push_back(corner.uv < 0 ? Vec2{} : uvs_[at(corner.uv)]);
    to.hasNormals |= corner.normal >= 0;
    to.hasUvs |= corner.uv >= 0;
    return number;
  }

  // --- the whole ---

  void finish() {
    for (const std::string_view names : materialFiles_)
      materials_.read(names, static_cast<std::size_t>(names.data() - lines_.data()));
    for (const auto& part : parts_) part->material = materials_.numberOf(part->materialName);
    if (!colors_.empty()) {
      colors_.resize(points_.size(), {1, 1, 1});
      colorScale_ = whiteOf(colors_);
      for (const auto& part : parts_) paint(*part);
    }
    for (const Vec3f& color : palette_.keys()) model_.colors.push_back({color.x, color.y, color.z});
    materials_.report();
    const bool empty = std::all_of(parts_.begin(), parts_.end(),
                                   [](const auto& part) { return part->mesh.triangles.empty(); });
    if (empty && lost_) throw Error(Fault::scene, lost_->place, lost_->what, lost_->hint);
    warnings_.report(messages_);
    Box3 box;
    for (const Vec3f& point : points_)
      if (isFinite(Vec3(point))) box.extend(Vec3(point));
    const Real longest = box.empty() ? 1 : maxComponent(box.size());
    for (Material& material : model_.materials) scaleHeights(material, longest);
    for (const auto& part : parts_) {
      if (part->mesh.triangles.empty()) continue;
      if (!part->hasNormals) part->mesh.normals.clear();
      if (!part->hasUvs) part->mesh.uvs.clear();
      repairs_.check(part->mesh, [&](MeshPart what, std::size_t index) {
        return MeshSpot{placeAt(file_, bytes_, lineOf(*part, what, index))};
      });
      model_.objects.push_back({part->name,
                                Mesh{std::make_shared<const MeshData>(std::move(part->mesh))},
                                {},
                                part->material,
                                place_});
    }
    repairs_.report(place_, messages_);
  }

  /// The byte of the line that gives that part of its mesh.
  std::size_t lineOf(const Part& part, MeshPart what, std::size_t index) const {
    if (what == MeshPart::triangle) return part.lines[index];
    const Corner& corner = part.corners.keys()[index];
    if (what == MeshPart::normal && corner.normal >= 0) return lineOf("vn", corner.normal);
    if (what == MeshPart::uv && corner.uv >= 0) return lineOf("vt", corner.uv);
    return lineOf("v", corner.point);
  }
  /// That of the line with the keyword which has that index among them.
  std::size_t lineOf(std::string_view keyword, std::int32_t index) const {
    std::size_t at = 0;
    std::int32_t count = 0;
    forEachLine(lines_, [&](std::string_view text) {
      const std::string_view key = LineWords(text).next();
      if (sameWord(key, keyword) && count++ == index) at = offset(key);
    });
    return at;
  }

  /// The colours of its points times that of its material.
  void paint(Part& part) {
    const bool hasMaterial = part.material != Model::kNoMaterial;
    const Color base = hasMaterial ? paintedColor(model_.materials[part.material].model) : Color(1);
    const auto channel = [&](float x, Real of) { return static_cast<float>(x / colorScale_ * of); };
    for (const Corner& corner : part.corners.keys()) {
      const Vec3f& c = colors_[static_cast<std::size_t>(corner.point)];
      part.mesh.materials.push_back(
          palette_.number({channel(c.x, base.r), channel(c.y, base.g), channel(c.z, base.b)}));
    }
  }

  void warn(std::string_view at, std::string what) {
    if (!warnings_.again(what)) warnings_.warn(place(at), std::move(what));
  }
  /// Something that costs a face, or faces that use it.
  void lose(std::string_view at, const std::string& what, const std::string& consequence,
            std::string hint = {}, std::string_view kind = {}) {
    if (!lost_) lost_ = Message{Message::Severity::error, place(at), what, hint};
    if (!warnings_.again(kind.empty() ? what : kind))
      warnings_.warn(place(at), what + "; " + consequence, std::move(hint), kind.empty() ? what : kind);
  }
  SourcePlace place(std::string_view at) const { return placeAt(file_, bytes_, offset(at)); }
  std::size_t offset(std::string_view at) const {
    return static_cast<std::size_t>(at.data() - lines_.data());
  }

  const std::string& file_;
  SourcePlace place_;
  std::string_view bytes_, lines_;
  std::string room_;
  Messages& messages_;
  WarningsByKind warnings_;
  float colorScale_ = 1;       ///< what white is in the colours of points
  std::vector<Vec3f> colors_;  ///< one for each point, or none at all
  Unique<Vec3f> palette_;
  std::vector<Vec3f> points_, normals_;
  std::vector<Vec2> uvs_;
  std::string name_;
  std::string_view material_;
  std::string_view smooth_;  ///< the line of the smoothing group in force; empty for none
  std::map<std::pair<std::string, std::string_view>, std::size_t> partNumbers_;
  std::vector<std::unique_ptr<Part>> parts_;
  Part* part_ = nullptr;                ///< that of name_ and material_, once known
  std::vector<CornerNumbers> numbers_;  ///< numbers of the face that is being read
  std::vector<Corner> corners_;         ///< the same, as indices
  std::vector<std::uint32_t> polygon_;  ///< and as points of its part
  std::vector<LateFace> late_;
  std::optional<Counts> counts_;
  bool allFinite_ = true;                        ///< so far
  std::vector<std::string_view> materialFiles_;  ///< all that a line names, as one
  MeshRepairs repairs_;
  std::optional<Message> lost_;  ///< the first that costs a face
  Model model_;
  ObjMaterials::Names names_;
  ObjMaterials materials_{file_, bytes_, names_, model_, warnings_, messages_};
};

}  // namespace

bool recognisesObj(std::string_view bytes) {
  constexpr std::array<std::string_view, 12> kKeywords{"v", "vn", "vt", "vp",     "f",      "l",
                                                       "o", "g",  "s",  "usemtl", "mtllib", "cstype"};
  std::string_view first;
  forEachLine(bytes.substr(0, 1 << 16), [&](std::string_view line) {
    if (const std::string_view word = LineWords(line).next(); first.empty() && !word.starts_with('#'))
      first = word;
  });
  const auto isFirst = [&](std::string_view keyword) { return sameWord(first, keyword); };
  return std::any_of(kKeywords.begin(), kKeywords.end(), isFirst) && mayBeObj(bytes);
}

bool mayBeObj(std::string_view bytes) {
  for (std::size_t start = 0; start < bytes.size();) {
    const std::size_t end = std::min(bytes.find('\n', start), bytes.size());
    LineWords words(bytes.substr(start, end - start));
    if (sameWord(words.next(), "v") && parseNumber(words.next())) return true;
    start = end + 1;
  }
  return false;
}

Model readObj(const std::string& file, std::string_view bytes, Messages& messages) {
  return ObjReader(file, bytes, messages).read();
}

}  // namespace trace
