#include "formats/mesh/off_format.h"

#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "base/text.h"
#include "base/unique.h"
#include "formats/warnings.h"
#include "formats/words.h"
#include "geometry/mesh/mesh.h"
#include "geometry/mesh/mesh_repair.h"

namespace trace {
namespace {

/// The data of each point by the first word.
struct Kind {
  bool uv = false, color = false, normal = false;
};

/// [ST][C][N]OFF, in letters of any case; nothing for other words, and for points of other than three
/// dimensions (4OFF, nOFF).
std::optional<Kind> kindOf(std::string_view word) {
  Kind kind;
  const auto take = [&](std::string_view start) {
    if (!sameWord(word.substr(0, start.size()), start)) return false;
    word.remove_prefix(start.size());
    return true;
  };
  const bool isNDimensional = word.starts_with('n');  // nOFF, where n is a number that follows
  kind.uv = take("ST");
  kind.color = take("C");
  kind.normal = take("N");
  return sameWord(word, "OFF") && !isNDimensional ? std::optional(kind) : std::nullopt;
}

/// 4OFF, nOFF, C4nOFF ...: points of other than three dimensions.
bool isOtherDimension(std::string_view word) {
  constexpr std::string_view kEnd = "OFF";
  if (word.size() <= kEnd.size() || !sameWord(word.substr(word.size() - kEnd.size()), kEnd)) return false;
  const std::string_view start = word.substr(0, word.size() - kEnd.size());
  return start.find_first_not_of("STCN4n") == start.npos && start.find_first_of("4n") != start.npos;
}

class OffReader {
 public:
  OffReader(const std::string& file, std::string_view bytes, Messages& messages)
      : file_(file), bytes_(bytes), words_(file, bytes, '#'), messages_(messages) {}

  Model read() {
    const std::string_view first = words_.next();
    if (isOtherDimension(first))
      words_.fail("expected points of three dimensions, as in OFF, COFF or NOFF", first);
    std::optional<Kind> kind = kindOf(first);
    const std::size_t afterFirst = bytes_.size() - words_.left();
    if (const std::string_view word = words_.next(); kind && sameWord(word, "BINARY"))
      words_.fail("binary OFF is not read: expected text", word);
    words_.skipTo(afterFirst);
    if (!kind) {  // old files begin with the counts
      kind.emplace();
      words_.skipTo(0);
    }
    const std::size_t points = count("the number of points"), faces = count("the number of faces");
    if (const double edges = words_.number("the number of edges");
        !(edges >= 0) || edges != std::floor(edges))
      words_.fail("expected the number of edges, a whole number, found " + toText(edges));
    mesh_.points.reserve(points);
    mesh_.triangles.reserve(faces);
    pointsAt_ = bytes_.size() - words_.left();
    for (std::size_t i = 0; i < points; ++i) readPoint(*kind);
    wordsOfPoint_ = 3 + (kind->normal ? 3 : 0) + (kind->color ? 4 : 0) + (kind->uv ? 2 : 0);
    const FindInFile find = [this](MeshPart part, std::size_t i) { return spotOf(part, i); };
    if (kind->color) takeColors(find);
    for (std::size_t i = 0; i < faces; ++i) readFace(i);
    if (lost_ && mesh_.triangles.empty()) throw Error(Fault::scene, lost_->place, lost_->what);
    if (faceColors_.count > 0) paintFaces();
    warnings_.report(messages_);
    unusable_.report("faces of fewer than 3 points are left out", messages_);
    if (!words_.next().empty()) messages_.warn(words_.place(), "what follows the last face is ignored");
    addOnlyMesh(model_, std::move(mesh_), repairs_, find, SourcePlace{file_, 0, 0, {}}, messages_);
    return std::move(model_);
  }

 private:
  /// A whole number that the file has room for: each thing counted takes two bytes at least.
  std::size_t count(const char* what) {
    const double number = words_.number(what);
    if (!(number >= 0) || number != std::floor(number)) words_.fail("expected " + std::string(what));
    if (number > static_cast<double>(words_.left()))
      words_.fail("expected " + std::string(what) + ", found one that is too large for this file");
    return static_cast<std::size_t>(number);
  }

  /// The number of times that something came, and the place of the first.
  struct Times {
    SourcePlace first{};
    std::size_t count = 0;
    void add(const Words& words) {
      if (count++ == 0) first = words.place();
    }
  };

  /// NaN, with a warning, for a word that is no number: it costs the faces that use it.
  double number(const char* what) {
    const std::string_view word = words_.next();
    const auto parsed = parseNumber(word);
    if (parsed && parsed->length == word.size()) return parsed->value;
    if (word.empty()) words_.fail("expected " + std::string(what), word);
    const std::string found =
        "expected " + std::string(what) + ", found \"" + std::string(word.substr(0, 40));
    if (!warnings_.again("number")) warnings_.warn(words_.place(), found + "\"", {}, "number");
    return std::numeric_limits<double>::quiet_NaN();
  }

  Vec3f vector(const char* what) {
    const double x = number(what), y = number(what), z = number(what);
    return Vec3f(Vec3{x, y, z});
  }

  /// Position, normal, colour, texture coordinates.
  void readPoint(const Kind& kind) {
    mesh_.points.push_back(vector("a point's three numbers"));
    if (kind.normal) mesh_.normals.push_back(vector("a normal's three numbers"));
    if (kind.color) {
      colors_.push_back(vector("a colour's four numbers"));
      const double alpha = number("a colour's four numbers");
      if (alpha < 1) clear_.add(words_);
      if (alpha < 255) clearOf255_.add(words_);
    }
    if (!kind.uv) return;
    const double u = number("two texture coordinates"), v = number("two texture coordinates");
    mesh_.uvs.push_back({u, v});
  }

  /// The line of a face, or of the point of that index.
  MeshSpot spotOf(MeshPart part, std::size_t index) const {
    if (part == MeshPart::triangle) return {words_.placeAt(faceOf_[index])};
    Words again(file_, bytes_, '#');
    again.skipTo(pointsAt_);
    const std::size_t point = painted_.empty() ? index : painted_[index];
    for (std::size_t i = 0; i <= point * wordsOfPoint_; ++i) again.next();
    return {again.place()};
  }

  /// Colours are from 0 to 1, or, if any is larger, from 0 to 255.
  void takeColors(const FindInFile& find) {
    repairs_.checkColors(colors_, find);
    float most = 0;
    for (const Vec3f& color : colors_) most = std::max({most, color.x, color.y, color.z});
    const double scale = most > 1 ? 1.0 / 255 : 1;
    const Times& clear = most > 1 ? clearOf255_ : clear_;
    if (clear.count > 0)
      messages_.warn(clear.first, "the transparency of points is left out: " + std::to_string(clear.count));
    Unique<Vec3f> unique;
    for (const Vec3f& color : colors_) mesh_.materials.push_back(unique.number(color));
    for (const Vec3f& color : unique.keys())
      model_.colors.push_back({color.x * scale, color.y * scale, color.z * scale});
  }

  /// Numbers until the end of the line: red, green and blue, perhaps with an opacity, from 0 to 1, or from 0
  /// to 255 if they are whole numbers. One alone is a place in a table that nobody has.
  std::optional<Vec3f> readFaceColor(std::size_t face) {
    std::string_view rest = words_.line();
    rest = rest.substr(0, rest.find('#'));
    const std::string line(rest);
    Words numbers(file_, line, '\0');
    std::vector<double> color;
    bool whole = true;
    while (!numbers.atEnd()) {
      const std::string_view word = numbers.next();
      const auto number = parseNumber(word);
      if (!number || number->length != word.size() || !std::isfinite(number->value)) {
        if (!warnings_.again("colour"))
          warnings_.warn(words_.place(),
                         "face " + std::to_string(face) + ": expected a colour after its points, found \"" +
                             std::string(word.substr(0, 40)) + "\"; it has none",
                         {}, "colour");
        return {};
      }
      whole = whole && word.find_first_of(".eE") == word.npos;
      color.push_back(number->value);
    }
    if (color.empty()) return {};
    if (color.size() < 3) {
      warn("colours of faces that are numbers of a table are left out", "table");
      return {};
    }
    const double scale = whole ? 1.0 / 255 : 1;
    if (color.size() > 3 && color[3] * scale < 1) warn("the transparency of faces is left out", "alpha");
    return Vec3f(Vec3{color[0] * scale, color[1] * scale, color[2] * scale});
  }

  /// The number of corners, their points, and until the end of the line a colour.
  void readFace(std::size_t number) {
    const std::size_t corners = count("the number of a face's corners"), start = words_.start();
    face_.clear();
    bool good = true;
    for (std::size_t i = 0; i < corners; ++i) {
      const double point = words_.number("the number of a point");
      const bool isThere =
          point >= 0 && point < static_cast<double>(mesh_.points.size()) && point == std::floor(point);
      if (!isThere && good)
        lose("face " + std::to_string(number) + ": expected a point from 0 to " +
             std::to_string(mesh_.points.size()) + " - 1, found " + toText(point));
      good = good && isThere;
      face_.push_back(isThere ? static_cast<std::uint32_t>(point) : 0);
    }
    const std::optional<Vec3f> color = readFaceColor(number);
    if (!good) return;
    unusable_.add(corners < 3, [&] { return MeshSpot{words_.placeAt(start)}; });
    appendPolygon(mesh_, face_);
    faceOf_.resize(mesh_.triangles.size(), start);
    constexpr float kPlain = 0.7f;  // as plainMaterial()
    const std::uint32_t painted = palette_.number(color.value_or(Vec3f{kPlain, kPlain, kPlain}));
    if (color) faceColors_.add(words_);
    triangleColors_.resize(mesh_.triangles.size(), painted);
  }

  /// Each triangle gets points of its own, with its colour.
  void paintFaces() {
    if (!mesh_.materials.empty())
      return messages_.warn(faceColors_.first, "colours of faces are left out, since points have some: " +
                                                   std::to_string(faceColors_.count));
    struct Painted {
      std::uint32_t point, color;
    };
    Unique<Painted> corners;
    for (std::size_t i = 0; i < mesh_.triangles.size(); ++i)
      for (std::uint32_t& point : mesh_.triangles[i]) point = corners.number({point, triangleColors_[i]});
    MeshData painted;
    painted.triangles = std::move(mesh_.triangles);
    painted.polygons = std::move(mesh_.polygons);
    for (const Painted& corner : corners.keys()) {
      painted.points.push_back(mesh_.points[corner.point]);
      if (!mesh_.normals.empty()) painted.normals.push_back(mesh_.normals[corner.point]);
      if (!mesh_.uvs.empty()) painted.uvs.push_back(mesh_.uvs[corner.point]);
      painted.materials.push_back(corner.color);
      painted_.push_back(corner.point);
    }
    for (const Vec3f& color : palette_.keys()) model_.colors.push_back({color.x, color.y, color.z});
    mesh_ = std::move(painted);
  }

  void warn(const char* what, std::string_view kind) {
    if (!warnings_.again(kind)) warnings_.warn(words_.place(), what, {}, kind);
  }
  /// The face is left out.
  void lose(const std::string& what) {
    if (!lost_) lost_ = Message{Message::Severity::error, words_.place(), what, {}};
    if (!warnings_.again("lost")) warnings_.warn(words_.place(), what + "; the face is left out", {}, "lost");
  }

  const std::string& file_;
  std::string_view bytes_;
  Words words_;
  Messages& messages_;
  MeshData mesh_;
  std::vector<Vec3f> colors_;
  Times clear_, clearOf255_;  ///< points whose alpha is below 1, or below 255
  Times faceColors_;
  std::vector<std::uint32_t> face_;
  WarningsByKind warnings_;
  std::optional<Message> lost_;  ///< the first that costs a face
  Unique<Vec3f> palette_;
  std::vector<std::uint32_t> triangleColors_;
  CountedFlaw unusable_;  ///< faces of fewer than 3 points
  MeshRepairs repairs_;
  std::size_t pointsAt_ = 0, wordsOfPoint_ = 0;
  std::vector<std::size_t> faceOf_;     ///< the byte of the face of each triangle
  std::vector<std::uint32_t> painted_;  ///< the points of the file, where faces are coloured
  Model model_;
};

}  // namespace

bool recognisesOff(std::string_view bytes) {
  const std::string none;
  Words words(none, bytes.substr(0, 4096), '#');
  const std::string_view first = words.next();
  return kindOf(first).has_value() || isOtherDimension(first);
}

bool mayBeOff(std::string_view bytes) {
  const std::string none;
  Words words(none, bytes.substr(0, 4096), '#');
  for (int i = 0; i < 3; ++i) {  // points, faces, edges
    const std::string_view word = words.next();
    if (word.empty() || word.find_first_not_of("0123456789") != word.npos) return false;
  }
  return true;
}

Model readOff(const std::string& file, std::string_view bytes, Messages& messages) {
  return OffReader(file, bytes, messages).read();
}

}  // namespace trace
