#include "formats/mesh/stl_format.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>
#include <utility>

#include "base/text.h"
#include "base/unique.h"
#include "formats/text_front.h"
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

/// How many the header of a binary file says there are.
std::size_t facetsOf(std::string_view bytes) { return littleIntAt(bytes.data() + kHeader - 4); }

bool isBinary(std::string_view bytes) {
  return bytes.size() >= kHeader && (bytes.size() - kHeader) % kFacet == 0 &&
         (bytes.size() - kHeader) / kFacet == facetsOf(bytes);
}

bool isText(std::string_view bytes) {
  if (!beginsWithWord(bytes, "solid") && !beginsWithWord(bytes, "facet")) return false;
  const std::string_view beginning = bytes.substr(0, 4096);
  return hasWord(beginning, "facet") || hasWord(beginning, "endsolid");
}

/// Collects the facets of one solid.
class Solid {
 public:
  /// The corners of a facet follow whose normal the file says, which may be 0 for nothing; and where it
  /// stands.
  void facet(const Vec3f& normal, std::size_t at) {
    normals_.push_back(normal);
    places_.push_back(at);
  }
  void corner(Vec3f p) {
    p = {p.x + 0.0f, p.y + 0.0f, p.z + 0.0f};  // no negative zero: it would not equal the other
    corners_.push_back(points_.number(p));
  }
  /// Facets whose corners run the other way round than their normals say; they are turned.
  std::size_t turned() const { return turned_; }
  /// Where the first of those stands.
  std::size_t firstTurned() const { return firstTurned_; }

  /// `spotOf` gives the spot of a byte.
  template <class SpotOf>
  void finish(std::string name, const SourcePlace& place, const SpotOf& spotOf, Model& model,
              MeshRepairs& repairs) {
    MeshData mesh;
    mesh.points = points_.keys();
    for (std::size_t i = 0; i + 2 < corners_.size(); i += 3) {
      mesh.triangles.push_back({corners_[i], corners_[i + 1], corners_[i + 2]});
      const Vec3 normal(normals_[i / 3]);
      const Vec3 face = faceNormal(mesh, static_cast<std::uint32_t>(i / 3));
      const Real cosine = dot(normal, face);
      if (!(cosine < -0.5 * length(normal) * length(face))) continue;
      std::swap(mesh.triangles.back()[1], mesh.triangles.back()[2]);
      if (turned_++ == 0) firstTurned_ = places_[i / 3];
    }
    repairs.check(mesh, [&](MeshPart what, std::size_t index) {
      const auto user = std::find(corners_.begin(), corners_.end(), static_cast<std::uint32_t>(index));
      return spotOf(
          places_[what == MeshPart::triangle ? index
                                             : static_cast<std::size_t>(user - corners_.begin()) / 3]);
    });
    model.objects.push_back({std::move(name),
                             Mesh{std::make_shared<const MeshData>(std::move(mesh))},
                             {},
                             Model::kNoMaterial,
                             place});
  }

 private:
  Unique<Vec3f> points_;
  std::vector<std::uint32_t> corners_;
  std::vector<Vec3f> normals_;
  std::vector<std::size_t> places_;
  std::size_t turned_ = 0, firstTurned_ = 0;
};

void warnOfTurned(const CountedFlaw& turned, Messages& messages) {
  turned.report("facets whose corners run the other way round than their normals say are turned", messages);
}

Model readBinary(const SourcePlace& place, std::string_view bytes, MeshRepairs& repairs, Messages& messages) {
  Solid solid;
  const std::size_t whole = (bytes.size() - kHeader) / kFacet, facets = facetsOf(bytes);
  if (facets > whole)
    throw Error(Fault::scene, place,
                "expected the " + counted(facets, "facet") + " that its header counts, found " +
                    std::to_string(whole));
  const std::size_t end = kHeader + kFacet * facets;
  if (end < bytes.size())
    messages.warn(place, counted(bytes.size() - end, "byte") + " after the last facet are ignored");
  const auto vectorAt = [&](const char* from) {
    return Vec3f{littleFloat(from), littleFloat(from + 4), littleFloat(from + 8)};
  };
  const auto spotOf = [&](std::size_t at) {
    return MeshSpot{place, "facet " + std::to_string((at - kHeader) / kFacet)};
  };
  CountedFlaw colored;
  for (std::size_t at = kHeader; at < end; at += kFacet) {
    colored.add(bytes[at + kFacet - 2] != 0 || bytes[at + kFacet - 1] != 0, [&] { return spotOf(at); });
    solid.facet(vectorAt(bytes.data() + at), at);
    for (std::size_t corner = 1; corner <= 3; ++corner)
      solid.corner(vectorAt(bytes.data() + at + 12 * corner));
  }
  colored.report("the colours of facets, their last two bytes, are not shown", messages);
  if (bytes.substr(0, kHeader).find("COLOR=") != bytes.npos)
    messages.warn(place, "the colour of the header, COLOR=, is not shown");
  Model model;
  solid.finish("", place, spotOf, model, repairs);
  warnOfTurned({solid.turned(), spotOf(solid.firstTurned())}, messages);
  return model;
}

/// solid NAME { facet normal x y z outer loop { vertex x y z } endloop endfacet } endsolid NAME
class TextReader {
 public:
  TextReader(const SourcePlace& place, std::string_view bytes, MeshRepairs& repairs, Messages& messages)
      : place_(place), words_(place.file, bytes, '\0'), repairs_(repairs), messages_(messages) {}

  Model read() {
    for (std::string_view word = words_.next(); !word.empty(); word = words_.next()) {
      if (sameWord(word, "facet"))  // a solid without its first line
        readSolid("", word);
      else if (sameWord(word, "solid"))
        readSolid(std::string(words_.line()), "");
      else
        words_.fail("expected \"solid\"", word);
    }
    if (broken_ > 0 && facets_ == 0) throw *first_;
    if (broken_ > 0) {
      const Message& why = first_->messages().front();
      messages_.warn(why.place, "facets that are not a normal and three corners are left out: " +
                                    std::to_string(broken_) + ", the first here: " + why.what);
    }
    warnOfTurned({turned_, {words_.placeAt(firstTurned_)}}, messages_);
    return std::move(model_);
  }

 private:
  /// `word` is the first after the name, if it was read.
  void readSolid(std::string name, std::string_view word) {
    Solid solid;
    if (word.empty()) word = words_.next();
    for (;; word = words_.next()) {
      if (sameWord(word, "endsolid")) break;
      if (!sameWord(word, "facet")) words_.fail("expected \"facet\" or \"endsolid\"", word);
      try {
        readFacet(solid);
      } catch (const Error& error) {  // it costs the facet, not the file
        if (broken_++ == 0) first_ = error;
        for (word = words_.last(); !sameWord(word, "endfacet"); word = words_.next())
          if (word.empty()) throw;
      }
    }
    words_.line();  // the name again
    solid.finish(
        std::move(name), place_, [&](std::size_t at) { return MeshSpot{words_.placeAt(at)}; }, model_,
        repairs_);
    if (turned_ == 0) firstTurned_ = solid.firstTurned();
    turned_ += solid.turned();
  }

  /// Throws Error(Fault::scene), and adds nothing, where it is not as it should be.
  void readFacet(Solid& solid) {
    const std::size_t start = words_.start();
    expect("normal");
    const Vec3f normal = vector("a normal's three numbers");
    expect("outer");
    expect("loop");
    std::array<Vec3f, 3> corners;
    for (Vec3f& corner : corners) {
      expect("vertex");
      corner = vector("a corner's three numbers");
    }
    expect("endloop");
    expect("endfacet");
    solid.facet(normal, start);
    for (const Vec3f& corner : corners) solid.corner(corner);
    ++facets_;
  }

  void expect(std::string_view keyword) {
    if (const std::string_view word = words_.next(); !sameWord(word, keyword))
      words_.fail("expected \"" + std::string(keyword) + "\"", word);
  }

  Vec3f vector(std::string_view what) {
    const double x = words_.number(what), y = words_.number(what), z = words_.number(what);
    return Vec3f(Vec3{x, y, z});
  }

  const SourcePlace& place_;
  Words words_;
  MeshRepairs& repairs_;
  Messages& messages_;
  std::size_t facets_ = 0, broken_ = 0, turned_ = 0, firstTurned_ = 0;
  std::optional<Error> first_;  ///< first of the broken facets
  Model model_;
};

}  // namespace

bool recognisesStl(std::string_view bytes) { return isBinary(bytes) || isText(bytes); }

bool mayBeStl(std::string_view bytes) {
  return bytes.size() >= kHeader + kFacet && facetsOf(bytes) > 0 && bytes.find('\0') != bytes.npos;
}

Model readStl(const std::string& file, std::string_view bytes, Messages& messages) {
  const SourcePlace place{file, 0, 0, {}};
  MeshRepairs repairs;
  Model model = isBinary(bytes) || (mayBeStl(bytes) && !isText(bytes))
                    ? readBinary(place, bytes, repairs, messages)
                    : TextReader(place, bytes, repairs, messages).read();
  repairs.report(place, messages);
  return model;
}

}  // namespace trace
