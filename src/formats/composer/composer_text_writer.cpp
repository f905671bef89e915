// Writes the text form of composer files.
#include <cmath>
#include <cstdio>

#include "base/names.h"
#include "base/text.h"
#include "formats/composer/composer_file.h"

namespace trace::composer {
namespace {

/// Appends lines of words and numbers.
class TextWriter {
 public:
  explicit TextWriter(int digits) : digits_(digits) {}

  std::string write(const File& file) {
    text_ = "Composer format 2.1 ascii\n";
    if (file.view) {
      const View& v = *file.view;
      open("camera");
      line("position", v.position);
      line("viewDirection", v.direction);
      line("focalDistance", v.focalDistance);
      line("orthoUp", v.up);
      line("verticalFOV", v.verticalFov);
      close();
    }
    for (const Lamp& lamp : file.lamps) write(lamp);
    for (const Object& object : file.objects) write(object);
    return std::move(text_);
  }

 private:
  void write(const Lamp& l) {
    static constexpr const char* kNames[] = {"point_light", "directional_light", "spot_light"};
    open(kNames[static_cast<int>(l.kind)]);
    if (l.kind != Lamp::Kind::directional) line("position", l.position);
    if (l.kind != Lamp::Kind::point) line("direction", l.direction);
    line("color", l.color);
    if (l.kind == Lamp::Kind::spot) {
      line("dropOffRate", l.dropOffRate);
      line("cutOffAngle", l.cutOffAngle);
    }
    close();
  }

  void write(const Object& o) {
    open(o.sphere ? "sphere" : "poly_set");
    line("name", o.name.empty() ? "NULL" : "\"" + onOneLine(onOneLine(o.name, "\"", '\''), "\\", '/') + "\"");
    line("numMaterials", std::to_string(o.materials.size()));
    for (const Material& m : o.materials) {
      open("material");
      line("diffColor", m.diffuse);
      line("ambColor", m.ambient);
      line("specColor", m.specular);
      line("emisColor", m.emission);
      line("shininess", m.shininess);
      line("ktran", m.ktran);
      close();
    }
    if (o.sphere)
      write(*o.sphere);
    else
      write(o.polygons);
    close();
  }

  void write(const Sphere& s) {
    line("origin", s.origin);
    line("radius", s.radius);
    static constexpr const char *kAxes[] = {"xaxis", "yaxis", "zaxis"},
                                *kLengths[] = {"xlength", "ylength", "zlength"};
    for (int i = 0; i < 3; ++i) {
      line(kAxes[i], s.axis[i]);
      line(kLengths[i], s.length[i]);
    }
  }

  void write(const PolySet& p) {
    line("type", "POLYSET_TRI_MESH");
    line("normType", p.vertexNormals ? "PER_VERTEX_NORMAL" : "PER_FACE_NORMAL");
    line("materialBinding", p.vertexMaterials ? "PER_VERTEX_MATERIAL" : "PER_OBJECT_MATERIAL");
    line("hasTextureCoords", p.hasUv ? "TRUE" : "FALSE");
    line("rowSize", "0");
    line("numPolys", std::to_string(p.counts.size()));
    auto vertex = p.vertices.begin();
    for (std::uint32_t count : p.counts) {
      open("poly");
      line("numVertices", std::to_string(count));
      for (const auto end = vertex + count; vertex != end; ++vertex) {
        line("pos", Vec3f(vertex->position));
        if (p.vertexNormals) line("norm", Vec3f(vertex->normal));
        if (p.vertexMaterials) line("materialIndex", std::to_string(vertex->material));
        if (p.hasUv) {
          line("s", static_cast<float>(vertex->uv.x));
          line("t", static_cast<float>(vertex->uv.y));
        }
      }
      close();
    }
  }

  void indent() { text_.append(2 * static_cast<std::size_t>(depth_), ' '); }
  void open(const char* name) {
    indent();
    ++depth_;
    text_ += std::string(name) + " {\n";
  }
  void close() {
    --depth_;
    indent();
    text_ += "}\n";
  }
  void number(Real value) {
    text_ += ' ';
    appendNumber(text_, value, digits_);
  }
  /// Meshes are read as floats.
  void number(float value) {
    text_ += ' ';
    appendNumber(text_, value, digits_);
  }
  template <class... Numbers>
  void line(const char* name, Numbers... numbers) {
    indent(), text_ += name, (number(numbers), ...), text_ += '\n';
  }
  void line(const char* name, const std::string& value) {
    indent();
    text_ += name;
    text_ += ' ';
    text_ += value;
    text_ += '\n';
  }
  void line(const char* name, const char* value) { line(name, std::string(value)); }
  void line(const char* name, const Vec3& v) { line(name, v.x, v.y, v.z); }
  void line(const char* name, const Vec3f& v) { line(name, v.x, v.y, v.z); }
  void line(const char* name, const Color& c) { line(name, c.r, c.g, c.b); }

  int digits_;
  std::string text_;
  int depth_ = 0;
};

}  // namespace

std::string writeText(const File& file, int digits) { return TextWriter(digits).write(file); }

}  // namespace trace::composer
