#include "formats/mesh/off_format.h"

#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "base/text.h"
#include "base/unique.h"
#include "formats/words.h"
#include "geometry/mesh/mesh.h"
#include "geometry/mesh/mesh_repair.h"

namespace trace {
namespace {

/// What the first word says of each point.
struct Kind {
  bool uv = false, color = false, normal = false;
};

/// [ST][C][N]OFF; nothing for other words, and for points of other than three dimensions (4OFF, nOFF).
std::optional<Kind> kindOf(std::string_view word) {
  Kind kind;
  if (word.starts_with("ST")) {
    kind.uv = true;
    word.remove_prefix(2);
  }
  if (word.starts_with("C")) {
    kind.color = true;
    word.remove_prefix(1);
  }
  if (word.starts_with("N")) {
    kind.normal = true;
    word.remove_prefix(1);
  }
  return word == "OFF" ? std::optional(kind) : std::nullopt;
}

class OffReader {
 public:
  OffReader(const std::string& file, std::string_view bytes, Messages& messages)
      : file_(file), words_(file, bytes, '#'), messages_(messages) {}

  Model read() {
    const Kind kind = *kindOf(words_.next());
    const std::size_t points = count("the number of points"), faces = count("the number of faces");
    if (const double edges = words_.number("the number of edges");
        !(edges >= 0) || edges != std::floor(edges))
      words_.fail("expected the number of edges, a whole number, found " + toText(edges));
    mesh_.points.reserve(points);
    mesh_.triangles.reserve(faces);
    for (std::size_t i = 0; i < points; ++i) readPoint(kind);
    if (kind.color) takeColors();
    for (std::size_t i = 0; i < faces; ++i) readFace(i);
    if (faceColors_ > 0)
      messages_.warn(Place{file_, 0, 0, {}}, "colours of faces are left out: " + std::to_string(faceColors_));
    if (!words_.atEnd()) messages_.warn(Place{file_, 0, 0, {}}, "what follows the last face is ignored");
    if (unusable_ > 0)
      messages_.warn(Place{file_, 0, 0, {}},
                     "faces of fewer than 3 points are left out: " + std::to_string(unusable_));
    addOnlyMesh(model_, std::move(mesh_), Place{file_, 0, 0, {}}, messages_);
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

  Vec3f vector(const char* what) {
    const double x = words_.number(what), y = words_.number(what), z = words_.number(what);
    return Vec3f(Vec3{x, y, z});
  }

  /// Position, normal, colour, texture coordinates.
  void readPoint(const Kind& kind) {
    mesh_.points.push_back(vector("a point's three numbers"));
    if (kind.normal) mesh_.normals.push_back(vector("a normal's three numbers"));
    if (kind.color) {
      colors_.push_back(vector("a colour's four numbers"));
      words_.number("a colour's four numbers");
    }
    if (!kind.uv) return;
    const double u = words_.number("two texture coordinates"), v = words_.number("two texture coordinates");
    mesh_.uvs.push_back({u, v});
  }

  /// Colours are from 0 to 1, or, if any is larger, from 0 to 255.
  void takeColors() {
    float most = 0;
    for (const Vec3f& color : colors_) {
      most = std::max({most, color.x, color.y, color.z});
      if (!std::isfinite(color.x + color.y + color.z))
        words_.fail("expected colours that are finite numbers");
    }
    const double scale = most > 1 ? 1.0 / 255 : 1;
    Unique<Vec3f> unique;
    for (const Vec3f& color : colors_) mesh_.materials.push_back(unique.number(color));
    for (const Vec3f& color : unique.keys())
      model_.colors.push_back({color.x * scale, color.y * scale, color.z * scale});
  }

  /// Numbers until the end of the line.
  void readFaceColor(std::size_t face) {
    std::string_view rest = words_.line();
    rest = rest.substr(0, rest.find('#'));
    const std::string line(rest);
    Words numbers(file_, line, '\0');
    if (numbers.atEnd()) return;
    ++faceColors_;
    while (!numbers.atEnd()) {
      const std::string_view word = numbers.next();
      const auto number = parseNumber(word);
      if (!number || number->length != word.size())
        words_.fail("face " + std::to_string(face) + ": expected a colour after its points, found \"" +
                    std::string(word.substr(0, 40)) + "\"");
    }
  }

  /// The number of corners, their points, and until the end of the line a colour.
  void readFace(std::size_t number) {
    const std::size_t corners = count("the number of a face's corners");
    face_.clear();
    for (std::size_t i = 0; i < corners; ++i) {
      const double point = words_.number("the number of a point");
      if (!(point >= 0 && point < static_cast<double>(mesh_.points.size())) || point != std::floor(point))
        words_.fail("face " + std::to_string(number) + ": expected a point from 0 to " +
                    std::to_string(mesh_.points.size()) + " - 1, found " + toText(point));
      face_.push_back(static_cast<std::uint32_t>(point));
    }
    readFaceColor(number);
    if (corners < 3) ++unusable_;
    appendPolygon(mesh_, face_);
  }

  const std::string& file_;
  Words words_;
  Messages& messages_;
  MeshData mesh_;
  std::vector<Vec3f> colors_;
  std::vector<std::uint32_t> face_;
  std::size_t unusable_ = 0, faceColors_ = 0;
  Model model_;
};

}  // namespace

bool recognisesOff(std::string_view bytes) {
  const std::string none;
  return kindOf(Words(none, bytes.substr(0, 4096), '#').next()).has_value();
}

Model readOff(const std::string& file, std::string_view bytes, Messages& messages) {
  return OffReader(file, bytes, messages).read();
}

}  // namespace trace
