// Reads the text form of composer files: words that name their values, in any order, and blocks.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/names.h"
#include "base/text.h"
#include "formats/composer/composer_file.h"
#include "formats/tokens.h"
#include "formats/warnings.h"

namespace trace::composer {
namespace {

class TextReader {
 public:
  TextReader(const std::string& file, std::string_view bytes, std::size_t start, Messages& messages)
      : tokens_(file, bytes, {.marks = "{}"}, start), messages_(messages) {}

  File read() {
    while (!tokens_.atEnd()) {
      const Token name = tokens_.word("scene");
      if (name.text == "camera")
        camera(name);
      else if (name.text == "point_light")
        file_.lamps.push_back(lamp(Lamp::Kind::point));
      else if (name.text == "directional_light")
        file_.lamps.push_back(lamp(Lamp::Kind::directional));
      else if (name.text == "spot_light")
        file_.lamps.push_back(lamp(Lamp::Kind::spot));
      else if (name.text == "sphere" || name.text == "poly_set")
        object(name);
      else
        unknown(name, "a camera, a light, a sphere or a poly_set",
                {"camera", "point_light", "directional_light", "spot_light", "sphere", "poly_set"});
    }
    warnings_.report(messages_);
    return std::move(file_);
  }

 private:
  double number(const Token& name) { return tokens_.number(name.text); }
  Vec3 vector(const Token& name) {
    const double x = number(name), y = number(name);
    return {x, y, number(name)};
  }
  Color color(const Token& name) {
    const Vec3 v = vector(name);
    return {v.x, v.y, v.z};
  }
  std::uint32_t count(const Token& name) {
    const Token token = tokens_.peek();
    const double n = number(name);
    if (!(n >= 0 && n < 4294967295.0) || n != std::floor(n))
      tokens_.fail(token,
                   std::string(name.text) + ": expected a whole number from 0, found " + describe(token));
    return static_cast<std::uint32_t>(n);
  }
  bool flag(const Token& name, std::string_view yes, std::initializer_list<std::string_view> no) {
    const Token word = tokens_.word(name.text);
    if (word.text == yes) return true;
    for (std::string_view other : no)
      if (word.text == other) return false;
    tokens_.fail(word, std::string(name.text) + ": expected " + std::string(yes) + " or " +
                           std::string(*no.begin()) + ", found " + describe(word));
  }

  /// Calls field(word) for each word of a block.
  template <class Visit>
  void block(const Token& owner, Visit&& field) {
    tokens_.mark('{', owner.text);
    while (!tokens_.skipMark('}')) field(tokens_.word(owner.text));
  }
  template <class Visit>
  void block(std::string_view owner, Visit&& field) {
    Token token;
    token.text = owner;
    block(token, field);
  }

  /// Skips the numbers or the block after a word that is none of those `known` in `owner`.
  void unknown(const Token& name, std::string_view owner, std::initializer_list<std::string_view> known) {
    std::string hint = didYouMean(name.text, {known.begin(), known.size()});
    if (!tokens_.peek().is(Token::Kind::number) && !tokens_.peek().isMark('{'))
      tokens_.fail(name, "expected " + std::string(owner) + ", found " + describe(name), std::move(hint));
    warn(name, "\"" + std::string(name.text.substr(0, 40)) + "\" is not known and is skipped",
         std::move(hint));
    while (tokens_.peek().is(Token::Kind::number)) tokens_.next();
    if (!tokens_.skipMark('{')) return;
    for (int depth = 1; depth > 0;) {
      const Token token = tokens_.next();
      if (token.is(Token::Kind::end)) tokens_.fail(name, "this block is never closed");
      depth += token.isMark('{') ? 1 : token.isMark('}') ? -1 : 0;
    }
  }

  void warn(const Token& at, std::string what, std::string hint = {}) {
    if (!warnings_.again(what)) warnings_.warn(tokens_.place(at), std::move(what), std::move(hint));
  }
  /// Checks the number of things that the file counts before it gives them.
  void compare(const Token& at, std::string_view name, std::optional<std::uint32_t> said, std::size_t found) {
    if (said && *said != found)
      warn(at, std::string(name) + " says " + std::to_string(*said) + ", but the file has " +
                   std::to_string(found));
  }

  void camera(const Token& name) {
    if (file_.view) warn(name, "there are several cameras; the last counts");
    file_.view = view();
  }

  View view() {
    View v;
    block("camera", [&](const Token& f) {
      if (f.text == "position")
        v.position = vector(f);
      else if (f.text == "viewDirection")
        v.direction = vector(f);
      else if (f.text == "focalDistance")
        v.focalDistance = number(f);
      else if (f.text == "orthoUp")
        v.up = vector(f);
      else if (f.text == "verticalFOV")
        v.verticalFov = number(f);
      else
        unknown(f, "a field of the camera",
                {"position", "viewDirection", "focalDistance", "orthoUp", "verticalFOV"});
    });
    return v;
  }

  Lamp lamp(Lamp::Kind kind) {
    Lamp l;
    l.kind = kind;
    block("light", [&](const Token& f) {
      if (f.text == "position")
        l.position = vector(f);
      else if (f.text == "direction")
        l.direction = vector(f);
      else if (f.text == "color")
        l.color = color(f);
      else if (f.text == "dropOffRate")
        l.dropOffRate = number(f);
      else if (f.text == "cutOffAngle")
        l.cutOffAngle = number(f);
      else
        unknown(f, "a field of a light", {"position", "direction", "color", "dropOffRate", "cutOffAngle"});
    });
    return l;
  }

  Material material() {
    Material m;
    block("material", [&](const Token& f) {
      if (f.text == "diffColor")
        m.diffuse = color(f);
      else if (f.text == "ambColor")
        m.ambient = color(f);
      else if (f.text == "specColor")
        m.specular = color(f);
      else if (f.text == "emisColor")
        m.emission = color(f);
      else if (f.text == "shininess")
        m.shininess = number(f);
      else if (f.text == "ktran")
        m.ktran = number(f);
      else
        unknown(f, "a field of a material",
                {"diffColor", "ambColor", "specColor", "emisColor", "shininess", "ktran"});
    });
    return m;
  }

  /// The rest of the line: NULL, or text in quotes or without.
  std::string name() {
    if (tokens_.peek().is(Token::Kind::string)) return std::string(tokens_.next().text);
    std::string text;
    const int line = tokens_.place(tokens_.peek()).line;
    for (; !tokens_.atEnd() && tokens_.place(tokens_.peek()).line == line; tokens_.next())
      text += (text.empty() ? "" : " ") + std::string(tokens_.peek().text);
    return text == "NULL" ? std::string() : text;
  }

  void object(const Token& token) {
    Object o;
    o.place = tokens_.place(token);
    const bool isSphere = token.text == "sphere";
    Sphere s;
    std::optional<std::uint32_t> materials;
    polygonCount_.reset();
    block(token, [&](const Token& f) {
      if (f.text == "name")
        o.name = name();
      else if (f.text == "numMaterials")
        materials = count(f);
      else if (f.text == "material")
        o.materials.push_back(material());
      else if (isSphere)
        sphereField(s, f);
      else
        polygonField(o.polygons, f);
    });
    compare(token, "numMaterials", materials, o.materials.size());
    compare(token, "numPolys", polygonCount_, o.polygons.counts.size());
    if (isSphere) o.sphere = s;
    file_.objects.push_back(std::move(o));
  }

  void sphereField(Sphere& s, const Token& f) {
    static constexpr std::array<std::string_view, 3> kAxes{"xaxis", "yaxis", "zaxis"},
        kLengths{"xlength", "ylength", "zlength"};
    for (std::size_t i = 0; i < 3; ++i) {
      if (f.text == kAxes[i]) return void(s.axis[i] = vector(f));
      if (f.text == kLengths[i]) return void(s.length[i] = number(f));
    }
    if (f.text == "origin")
      s.origin = vector(f);
    else if (f.text == "radius")
      s.radius = number(f);
    else
      unknown(f, "a field of a sphere",
              {"name", "numMaterials", "material", "origin", "radius", "xaxis", "yaxis", "zaxis", "xlength",
               "ylength", "zlength"});
  }

  void polygonField(PolySet& p, const Token& f) {
    if (f.text == "poly") return polygon(p);
    if (f.text == "type")
      polygonType(f);
    else if (f.text == "normType")
      p.vertexNormals = flag(f, "PER_VERTEX_NORMAL", {"PER_FACE_NORMAL"});
    else if (f.text == "materialBinding")
      p.vertexMaterials = flag(f, "PER_VERTEX_MATERIAL", {"PER_OBJECT_MATERIAL"});
    else if (f.text == "hasTextureCoords")
      p.hasUv = flag(f, "TRUE", {"FALSE"});
    else if (f.text == "rowSize")
      count(f);
    else if (f.text == "numPolys")
      polygonCount_ = count(f);
    else
      unknown(f, "a field of a poly_set",
              {"name", "numMaterials", "material", "type", "normType", "materialBinding", "hasTextureCoords",
               "rowSize", "numPolys", "poly"});
  }

  /// All are polygons to us.
  void polygonType(const Token& f) {
    static constexpr std::array<std::string_view, 3> kTypes{"POLYSET_TRI_MESH", "POLYSET_FACE_SET",
                                                            "POLYSET_QUAD_MESH"};
    const Token word = tokens_.word(f.text);
    if (std::find(kTypes.begin(), kTypes.end(), word.text) == kTypes.end())
      warn(word,
           "type: expected POLYSET_TRI_MESH, POLYSET_FACE_SET or POLYSET_QUAD_MESH, found " + describe(word));
  }

  void polygon(PolySet& p) {
    const std::size_t first = p.vertices.size();
    const Token start = tokens_.peek();
    std::optional<std::uint32_t> vertices;
    std::size_t normals = 0, materials = 0, uvs = 0;
    block("poly", [&](const Token& f) {
      if (f.text == "numVertices") return void(vertices = count(f));
      if (f.text == "pos") return void(p.vertices.emplace_back().position = vector(f));
      normals += f.text == "norm";
      materials += f.text == "materialIndex";
      uvs += f.text == "s";
      if (p.vertices.size() == first) tokens_.fail(f, "poly: expected \"pos\" first, found " + describe(f));
      Vertex& v = p.vertices.back();
      if (f.text == "norm")
        v.normal = vector(f);
      else if (f.text == "materialIndex")
        v.material = count(f);
      else if (f.text == "s")
        v.uv.x = number(f);
      else if (f.text == "t")
        v.uv.y = number(f);
      else
        unknown(f, "a field of a poly", {"numVertices", "pos", "norm", "materialIndex", "s", "t"});
    });
    const std::size_t found = p.vertices.size() - first;
    p.counts.push_back(static_cast<std::uint32_t>(found));
    compare(start, "numVertices", vertices, found);
    const auto lacks = [&](bool wanted, std::size_t has, const char* what) {
      if (wanted && has < found) warn(start, std::string("poly: expected ") + what + " for each pos");
    };
    lacks(p.vertexNormals, normals, "a norm");
    lacks(p.vertexMaterials, materials, "a materialIndex");
    lacks(p.hasUv, uvs, "s and t");
  }

  Tokens tokens_;
  Messages& messages_;
  WarningsByKind warnings_;
  std::optional<std::uint32_t> polygonCount_;  ///< that the object being read says it has
  File file_;
};

}  // namespace

File readText(const std::string& file, std::string_view bytes, std::size_t start, Messages& messages) {
  return TextReader(file, bytes, start, messages).read();
}

}  // namespace trace::composer
