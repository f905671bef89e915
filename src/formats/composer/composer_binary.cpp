// The binary form of composer files: 32-bit integers and floats, of whichever byte order wrote them.
#include <cmath>
#include <cstring>

#include "formats/composer/composer_file.h"

namespace trace::composer {
namespace {

constexpr std::size_t kWord = 4;  ///< bytes of an integer and of a float

class BinaryReader {
 public:
  BinaryReader(const std::string& file, std::string_view bytes, std::size_t start, bool beforeVersion21,
               Messages& messages)
      : file_(file), bytes_(bytes), at_(start), old_(beforeVersion21), messages_(messages) {}

  File read() {
    constexpr std::int32_t kCheck = 123456789;
    const std::size_t start = at_;
    if (integer() != kCheck) {
      at_ = start;
      big_ = true;
      if (integer() != kCheck) fail("expected the integer 123456789 in one of both byte orders");
    }
    if (std::abs(real() - 3.1415926) > 1e-6) fail("expected the number 3.1415926");
    File file;
    View v;
    v.position = vector();
    v.direction = vector();
    v.focalDistance = real();
    v.up = vector();
    v.verticalFov = real();
    if (v.verticalFov != 0) file.view = v;
    for (std::uint32_t n = count(12 * kWord); n > 0; --n) file.lamps.push_back(lamp());
    for (std::uint32_t n = count(3 * kWord); n > 0; --n) file.objects.push_back(object());
    if (at_ < bytes_.size())
      messages_.warn({file_, 0, 0, {}},
                     "bytes after the last object are ignored: " + std::to_string(bytes_.size() - at_));
    return file;
  }

 private:
  std::uint32_t bits() {
    if (bytes_.size() - at_ < 4) fail("the file ends too early");
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i)
      value |= std::uint32_t{static_cast<unsigned char>(bytes_[at_ + i])} << (8 * (big_ ? 3 - i : i));
    at_ += 4;
    return value;
  }
  std::int32_t integer() { return static_cast<std::int32_t>(bits()); }
  Real real() {
    const std::uint32_t value = bits();
    float number;
    std::memcpy(&number, &value, sizeof number);
    if (!std::isfinite(number)) {
      at_ -= 4;
      fail("expected a finite number");
    }
    return static_cast<Real>(number);
  }
  Vec3 vector() {
    const Real x = real(), y = real();
    return {x, y, real()};
  }
  Color color() {
    const Vec3 v = vector();
    return {v.x, v.y, v.z};
  }
  /// A number of things that take at least `size` bytes each.
  std::uint32_t count(std::size_t size) {
    const std::int32_t n = integer();
    if (n < 0 || static_cast<std::size_t>(n) > (bytes_.size() - at_) / size) {
      at_ -= kWord;
      fail("found the number " + std::to_string(n) + " of things, more than the file has room for");
    }
    return static_cast<std::uint32_t>(n);
  }
  std::int32_t choice(std::int32_t most, const char* what) {
    const std::int32_t n = integer();
    if (n < 0 || n > most) {
      at_ -= kWord;
      fail(std::string(what) + ": expected 0 to " + std::to_string(most));
    }
    return n;
  }

  Lamp lamp() {
    Lamp l;
    l.kind = static_cast<Lamp::Kind>(choice(2, "kind of light"));
    l.position = vector();
    l.direction = vector();
    l.color = color();
    l.dropOffRate = real();
    l.cutOffAngle = real();
    return l;
  }

  Object object() {
    Object o;
    o.place = {file_, 0, 0, {}};
    const bool isSphere = choice(1, "kind of object") == 0;
    o.name = name();
    for (std::uint32_t n = old_ ? 1 : count(14 * kWord); n > 0; --n) {
      Material& m = o.materials.emplace_back();
      m.diffuse = color();
      m.ambient = color();
      m.specular = color();
      m.emission = color();
      m.shininess = real();
      m.ktran = real();
    }
    if (isSphere)
      o.sphere = sphere();
    else
      polygons(o.polygons);
    return o;
  }

  std::string name() {
    const std::int32_t length = integer();
    if (length < 0) return {};
    const std::size_t size = static_cast<std::size_t>(length) + 1;
    if (size > bytes_.size() - at_) {
      at_ -= 4;
      fail("a name is longer than the file");
    }
    std::string text(bytes_.substr(at_, size - 1));
    at_ += size;
    return text.substr(0, text.find('\0'));
  }

  Sphere sphere() {
    Sphere s;
    s.origin = vector();
    s.radius = real();
    for (int i = 0; i < 3; ++i) {
      s.axis[i] = vector();
      s.length[i] = real();
    }
    return s;
  }

  void polygons(PolySet& p) {
    choice(2, "kind of polygons");
    p.vertexNormals = choice(1, "kind of normals") == 0;
    if (!old_) {
      p.vertexMaterials = choice(1, "binding of materials") == 1;
      p.hasUv = choice(1, "texture") == 1;
    }
    integer();  // for a grid: polygons in a row
    const std::size_t size =
        kWord * (3u + (p.vertexNormals ? 3u : 0u) + (p.vertexMaterials ? 1u : 0u) + (p.hasUv ? 2u : 0u));
    for (std::uint32_t n = count(kWord); n > 0; --n) {
      p.counts.push_back(count(size));
      for (std::uint32_t k = p.counts.back(); k > 0; --k) {
        Vertex& v = p.vertices.emplace_back();
        v.position = vector();
        if (p.vertexNormals) v.normal = vector();
        if (p.vertexMaterials) v.material = bits();
        if (p.hasUv) {
          v.uv.x = real();
          v.uv.y = real();
        }
      }
    }
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw Error(Fault::scene, SourcePlace{file_, 0, 0, {}}, "byte " + std::to_string(at_) + ": " + what);
  }

  const std::string& file_;
  std::string_view bytes_;
  std::size_t at_;
  bool old_, big_ = false;
  Messages& messages_;
};

}  // namespace

File readBinary(const std::string& file, std::string_view bytes, std::size_t start, bool beforeVersion21,
                Messages& messages) {
  return BinaryReader(file, bytes, start, beforeVersion21, messages).read();
}

}  // namespace trace::composer
