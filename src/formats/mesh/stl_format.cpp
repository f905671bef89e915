#include "formats/mesh/stl_format.h"

#include <cstdint>
#include <cstring>
#include <memory>
#include <utility>

#include "base/unique.h"
#include "formats/words.h"
#include "geometry/mesh/mesh.h"

namespace trace {
namespace {

constexpr std::size_t kHeader = 84, kFacet = 50;  // bytes of a binary file

std::uint32_t littleIntAt(const char* from) {
  std::uint32_t value = 0;
  for (int i = 3; i >= 0; --i) value = value << 8 | static_cast<unsigned char>(from[i]);
  return value;
}

float littleFloat(const char* from) {
  const std::uint32_t bits = littleIntAt(from);
  float value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

bool isBinary(std::string_view bytes) {
  return bytes.size() >= kHeader && (bytes.size() - kHeader) % kFacet == 0 &&
         (bytes.size() - kHeader) / kFacet == littleIntAt(bytes.data() + kHeader - 4);
}

/// Collects the facets of one solid.
class Solid {
 public:
  void corner(Vec3f p) {
    p = {p.x + 0.0f, p.y + 0.0f, p.z + 0.0f};  // no negative zero: it would not equal the other
    corners_.push_back(points_.number(p));
  }

  void finish(std::string name, const Place& place, Model& model, MeshRepairs& repairs) {
    MeshData mesh;
    mesh.points = points_.keys();
    for (std::size_t i = 0; i + 2 < corners_.size(); i += 3)
      mesh.triangles.push_back({corners_[i], corners_[i + 1], corners_[i + 2]});
    repairs.check(mesh, place);
    model.objects.push_back({std::move(name),
                             Mesh{std::make_shared<const MeshData>(std::move(mesh))},
                             {},
                             Model::kNoMaterial,
                             place});
  }

 private:
  Unique<Vec3f> points_;
  std::vector<std::uint32_t> corners_;
};

Model readBinary(const Place& place, std::string_view bytes, MeshRepairs& repairs) {
  Solid solid;
  for (std::size_t at = kHeader; at < bytes.size(); at += kFacet)
    for (std::size_t corner = 1; corner <= 3; ++corner) {  // the first vector is the normal
      const char* from = bytes.data() + at + 12 * corner;
      solid.corner({littleFloat(from), littleFloat(from + 4), littleFloat(from + 8)});
    }
  Model model;
  solid.finish("", place, model, repairs);
  return model;
}

/// solid NAME { facet normal x y z outer loop { vertex x y z } endloop endfacet } endsolid NAME
class TextReader {
 public:
  TextReader(const Place& place, std::string_view bytes, MeshRepairs& repairs)
      : place_(place), words_(place.file, bytes, '\0'), repairs_(repairs) {}

  Model read() {
    for (std::string_view word = words_.next(); !word.empty(); word = words_.next()) {
      if (word != "solid") words_.fail("expected \"solid\"", word);
      readSolid(std::string(words_.line()));
    }
    return std::move(model_);
  }

 private:
  void readSolid(std::string name) {
    Solid solid;
    for (;;) {
      const std::string_view word = words_.next();
      if (word == "endsolid") break;
      if (word != "facet") words_.fail("expected \"facet\" or \"endsolid\"", word);
      expect("normal");
      vector("a normal's three numbers");
      expect("outer");
      expect("loop");
      for (int corner = 0; corner < 3; ++corner) {
        expect("vertex");
        solid.corner(vector("a corner's three numbers"));
      }
      expect("endloop");
      expect("endfacet");
    }
    words_.line();  // the name again
    solid.finish(std::move(name), place_, model_, repairs_);
  }

  void expect(std::string_view keyword) {
    if (const std::string_view word = words_.next(); word != keyword)
      words_.fail("expected \"" + std::string(keyword) + "\"", word);
  }

  Vec3f vector(std::string_view what) {
    const double x = words_.number(what), y = words_.number(what), z = words_.number(what);
    return Vec3f(Vec3{x, y, z});
  }

  const Place& place_;
  Words words_;
  MeshRepairs& repairs_;
  Model model_;
};

}  // namespace

bool recognisesStl(std::string_view bytes) {
  if (isBinary(bytes)) return true;
  if (!bytes.starts_with("solid")) return false;
  const std::string_view beginning = bytes.substr(0, 4096);
  return beginning.find("facet") != std::string_view::npos ||
         beginning.find("endsolid") != std::string_view::npos;
}

Model readStl(const std::string& file, std::string_view bytes, Messages& messages) {
  const Place place{file, 0, 0, {}};
  MeshRepairs repairs;
  Model model =
      isBinary(bytes) ? readBinary(place, bytes, repairs) : TextReader(place, bytes, repairs).read();
  repairs.report(place, messages);
  return model;
}

}  // namespace trace
