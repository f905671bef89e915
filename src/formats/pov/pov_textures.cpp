// Textures: pigments, normals, finishes, interiors, and the patterns and maps that they are made of. Source:
// the POV-Ray 3.7 reference, section 2.5.
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/files/named_file.h"
#include "base/files/read_scope.h"
#include "formats/pov/pov_reader.h"

namespace trace::pov {
namespace {

constexpr std::string_view kPatterns[]{
    "agate",           "average",       "boxed",    "bozo",        "brick",        "bumps",
    "cells",           "checker",       "crackle",  "cylindrical", "density_file", "dents",
    "facets",          "function",      "gradient", "granite",     "hexagon",      "image_map",
    "bump_map",        "image_pattern", "leopard",  "mandel",      "marble",       "onion",
    "pigment_pattern", "planar",        "quilted",  "radial",      "ripples",      "slope",
    "spherical",       "spiral1",       "spiral2",  "spotted",     "waves",        "wood",
    "wrinkles",        "object",        "aoi",      "julia",       "magnet",       "square",
    "triangular",      "cubic",         "pavement", "tiling",      "material_map"};

bool isMapWord(std::string_view w) {
  return w == "color_map" || w == "colour_map" || w == "pigment_map" || w == "texture_map" ||
         w == "normal_map" || w == "slope_map" || w == "density_map";
}

/// How many colours the list of a pattern has; 0 for a pattern of numbers.
std::size_t listSize(std::string_view kind) {
  if (kind == "checker" || kind == "brick" || kind == "object") return 2;
  if (kind == "square") return 4;
  if (kind == "hexagon" || kind == "cubic") return kind == "hexagon" ? 3 : 6;
  return kind == "triangular" ? 6 : 0;
}

/// A word that a number or a vector follows, and the field that it goes to; null for a number that changes
/// nothing here.
template <class Node, class Held>
struct Word {
  std::string_view word;
  Held Node::*field = nullptr;
};

constexpr Word<PatternNode, Real> kPatternNumbers[]{{"omega", &PatternNode::omega},
                                                    {"lambda", &PatternNode::lambda},
                                                    {"frequency", &PatternNode::frequency},
                                                    {"phase", &PatternNode::phase},
                                                    {"agate_turb", &PatternNode::number},
                                                    {"mortar", &PatternNode::number},
                                                    {"metric"},
                                                    {"offset"},
                                                    {"control0"},
                                                    {"control1"},
                                                    {"noise_generator"},
                                                    {"accuracy"},
                                                    {"interpolate"}};
constexpr Word<PatternNode, Vec3> kPatternVectors[]{{"turbulence", &PatternNode::turbulence},
                                                    {"brick_size", &PatternNode::vector},
                                                    {"form", &PatternNode::vector}};
constexpr std::string_view kWaves[]{"ramp_wave", "triangle_wave", "sine_wave", "scallop_wave", "cubic_wave"};
constexpr Word<FinishNode, Color> kFinishColors[]{{"ambient", &FinishNode::ambient},
                                                  {"emission", &FinishNode::emission}};
constexpr Word<FinishNode, Real> kFinishNumbers[]{{"diffuse", &FinishNode::diffuse},
                                                  {"brilliance", &FinishNode::brilliance},
                                                  {"phong", &FinishNode::phong},
                                                  {"phong_size", &FinishNode::phongSize},
                                                  {"specular", &FinishNode::specular},
                                                  {"roughness", &FinishNode::roughness},
                                                  {"reflection_exponent"}};
constexpr Word<InteriorNode, Real> kInteriorNumbers[]{{"ior", &InteriorNode::ior},
                                                      {"fade_distance", &InteriorNode::fadeDistance},
                                                      {"fade_power", &InteriorNode::fadePower},
                                                      {"caustics"},
                                                      {"refraction"},
                                                      {"dispersion_samples"}};
constexpr std::string_view kUnusedOfMedia[]{"intervals", "method", "confidence", "variance",
                                            "ratio",     "jitter", "aa_level",   "aa_threshold"};

/// The row of that word; null if there is none.
template <class Node, class Held, std::size_t N>
const Word<Node, Held>* rowOf(std::string_view word, const Word<Node, Held> (&rows)[N]) {
  const auto row =
      std::find_if(std::begin(rows), std::end(rows), [&](const auto& r) { return r.word == word; });
  return row == std::end(rows) ? nullptr : row;
}

template <std::size_t N>
bool isAmong(std::string_view word, const std::string_view (&words)[N]) {
  return std::find(std::begin(words), std::end(words), word) != std::end(words);
}

/// The value goes to the field of the row, if there is one.
template <class Node, class Held>
void put(Node& node, const Word<Node, Held>& row, const Held& value) {
  if (row.field) node.*row.field = value;
}

}  // namespace

bool Reader::startsPattern(const Token& t) const {
  return t.is(Token::Kind::name) && isAmong(t.text, kPatterns);
}

/// Takes the bytes of a picture that is beside the file that names it, or in POV-Ray's library, but not
/// beside the scene. One that is nowhere is reported with the other textures.
void Reader::findPicture(const Token& at, ImageNode& image) {
  if (image.file.empty() || namesFile(file_, image.file)) return;
  try {
    image.inside = std::make_shared<const InsideFile>(InsideFile{image.file, readNamed(at, image.file)});
  } catch (const ReadDenied&) {
    throw;
  } catch (const Error& error) {
    if (error.fault() == Fault::limit) throw;
  }
}

ImageNode Reader::image() {
  ImageNode image;
  expectMark("{", "before the picture");
  while (!takesMark("}")) {
    const Token t = peek();
    if (startsText()) {
      image.file = text();
      findPicture(t, image);
    } else if (takesName("map_type")) {
      image.mapType = whole();
    } else if (takesName("once")) {
      image.once = true;
    } else if (takesName("bump_size")) {
      image.bump = number();
    } else if (takesName("interpolate")) {
      whole();
    } else if (t.isName("filter") || t.isName("transmit")) {
      next();
      const bool all = takesName("all");
      Real value = number();
      if (!all && takesMark(",")) number();
      if (all) (t.isName("filter") ? image.filterAll : image.transmitAll) = value;
    } else if (takesName("gamma")) {
      if (startsNumber())
        number();
      else
        next();
    } else if (takesName("premultiplied")) {
      flag();
    } else if (takesName("use_alpha") || takesName("use_color") || takesName("use_index")) {
    } else if (t.isName("pigment") || t.isName("function")) {
      next();
      if (t.isName("function"))
        function();
      else
        pigment();
    } else if (t.is(Token::Kind::name)) {
      next();  // the type of the file
    } else if (takesMark("<")) {
      for (int depth = 1; depth > 0;) depth += next().isMark(">") ? -1 : 0;
    } else if (takesMark(",")) {
    } else {
      expected("a picture's name or \"}\"");
    }
  }
  return image;
}

bool Reader::pattern(PatternNode& p) {
  const Token t = peek();
  if (!startsPattern(t) || valueOf(t)) return false;
  next();
  p.kind = std::string(t.text);
  p.place = place(t);
  if (p.kind == "gradient") {
    p.vector = vector();
  } else if (p.kind == "spiral1" || p.kind == "spiral2" || p.kind == "tiling") {
    p.number = number();
  } else if (p.kind == "image_map" || p.kind == "bump_map" || p.kind == "image_pattern" ||
             p.kind == "material_map") {
    p.image = image();
  } else if (p.kind == "function") {
    if (startsNumber()) number(), comma(), number();
    const Frame& frame = frames_.back();
    p.formula = nullptr;
    if (peek().isMark("{")) {
      const Token& inner = frame.source->tokens[std::min(frame.at, frame.end)];
      const Value* value = inner.is(Token::Kind::name) ? valueOf(inner) : nullptr;
      if (value && value->as<Ref<Formula>>() &&
          frame.source->tokens[std::min(frame.at + 1, frame.end)].isMark("}")) {
        p.formula = *value->as<Ref<Formula>>();
        next(), next(), next();
      }
    }
    if (!p.formula) p.formula = function();
  } else if (p.kind == "pigment_pattern") {
    p.pigment = pigment();
  } else if (p.kind == "object") {
    if (!peek().isMark("{")) expectMark("{", "after object");
    omitBlock();
  } else if (p.kind == "density_file") {
    if (peek().is(Token::Kind::name)) next();
    text();
  } else if (p.kind == "mandel" || p.kind == "julia" || p.kind == "magnet") {
    while (startsNumber() || peek().isName("mandel") || peek().isName("julia")) {
      if (startsNumber())
        expression(), comma();
      else
        next();
    }
  } else if (p.kind == "quilted" || p.kind == "average" || p.kind == "facets") {
  } else if (p.kind == "pavement") {
    omitBlock();
  } else if (p.kind == "slope" || p.kind == "aoi") {
    if (takesMark("{")) {
      while (!takesMark("}")) next();
    } else if (startsNumber()) {
      vector();
      if (takesMark(",")) number(), comma(), number();
    }
  }
  if (p.kind == "agate") p.number = 1;
  if (p.kind == "brick") {
    p.vector = {8, 3, 4.5};
    p.number = 0.5;
  }
  if (p.kind == "crackle") p.vector = {1, 0, 0};
  return true;
}

bool Reader::patternModifier(PatternNode& p, Affine& at) {
  const Token t = peek();
  if (!t.is(Token::Kind::name) || (valueOf(t) && !valueOf(t)->as<Affine>())) return false;
  Affine by;
  if (transform(by)) {
    at = by * at;
    return true;
  }
  const std::string_view w = t.text;
  if (const auto* of = rowOf(w, kPatternVectors)) {
    next();
    put(p, *of, vector());
    if (w == "form" && p.vector == Vec3{-1, 1, 0}) p.vector = {1, 0, 0};
  } else if (const auto* row = rowOf(w, kPatternNumbers)) {
    next();
    put(p, *row, number());
  } else if (w == "octaves") {
    next();
    p.octaves = std::clamp(whole(), 1, 10);
  } else if (isAmong(w, kWaves)) {
    next();
    p.wave = std::string(w);
  } else if (w == "poly_wave") {
    next();
    p.wave = "poly_wave";
    p.exponent = startsNumber() ? number() : 1;
  } else if (w == "solid" || w == "no_bump_scale") {
    next();
  } else if (w == "exponent" || w == "exterior" || w == "interior") {
    next();
    number();
    if (takesMark(",")) number();
  } else if (w == "warp") {
    next();
    expectMark("{", "after warp");
    const Token kind = next();
    if (kind.isName("turbulence")) {
      p.turbulence = vector();
      for (;;) {
        if (takesName("octaves"))
          p.octaves = std::clamp(whole(), 1, 10);
        else if (takesName("omega"))
          p.omega = number();
        else if (takesName("lambda"))
          p.lambda = number();
        else
          break;
      }
      expectMark("}", "after the turbulence");
    } else {
      leaveOut(kind, "a warp by " + std::string(kind.text));
      int depth = 1;
      while (depth > 0) {
        const Token skipped = next();
        if (skipped.is(Token::Kind::end)) fail(kind, "expected \"}\" after warp");
        depth += skipped.isMark("{") ? 1 : skipped.isMark("}") ? -1 : 0;
      }
    }
  } else {
    return false;
  }
  return true;
}

// --- maps ---

Ref<MapNode> Reader::map(const Token& keyword) {
  auto m = std::make_shared<MapNode>();
  m->kind = keyword.text == "colour_map" ? "color_map" : std::string(keyword.text);
  expectMark("{", "after " + m->kind);
  if (const Value* value = peek().is(Token::Kind::name) ? valueOf(peek()) : nullptr)
    if (const auto* held = value->as<Ref<MapNode>>()) {
      *m = **held;
      next();
    }
  while (!takesMark("}")) {
    const Token open = peek();
    if (takesMark(",")) continue;
    if (!takesMark("[")) expected("\"[\" and a position, or \"}\" in " + m->kind);
    const Real at = startsNumber() ? number() : 1;  // weights of `average` may lack
    comma();
    if (m->kind == "color_map") {
      const bool two =
          startsNumber() && (peek().is(Token::Kind::number) || peek().isMark("(") ||
                             (peek().is(Token::Kind::name) && valueOf(peek()) &&
                              valueOf(peek())->as<Numbers>() && valueOf(peek())->as<Numbers>()->size == 1));
      const Real to = two ? number() : at;
      comma();
      const auto plain = [&] {
        auto p = std::make_shared<PigmentNode>();
        p->place = place(open);
        p->color = color();
        comma();
        return p;
      };
      m->pigments.emplace_back(at, plain());
      if (two) m->pigments.emplace_back(to, plain());
    } else if (m->kind == "pigment_map" || m->kind == "density_map") {
      auto p = std::make_shared<PigmentNode>();
      p->place = place(open);
      if (takesName("pigment") || takesName("density")) {
        m->pigments.emplace_back(at, pigment());
      } else {
        pigmentBody(*p);
        m->pigments.emplace_back(at, p);
      }
    } else if (m->kind == "texture_map") {
      if (peek().isName("texture")) {
        auto all = std::make_shared<TextureNode>();
        while (takesName("texture")) {
          const Ref<TextureNode> one = texture();
          all->layers.insert(all->layers.end(), one->layers.begin(), one->layers.end());
        }
        m->textures.emplace_back(at, all);
      } else {
        auto one = std::make_shared<TextureNode>();
        TextureNode::Layer layer{defaultPigment_, defaultNormal_, defaultFinish_, {}, {}, {}};
        std::vector<TextureNode::Layer> named;
        while (!peek().isMark("]")) {
          const Value* value = peek().is(Token::Kind::name) ? valueOf(peek()) : nullptr;
          if (value && (value->as<Ref<TextureNode>>() || value->as<std::shared_ptr<Array>>())) {
            const Token name = next();
            const Slot slot = namedSlot(name);
            const auto* held = slot ? slot->as<Ref<TextureNode>>() : nullptr;
            if (!held) fail(name, "expected a texture, found " + describe(name));
            named = (*held)->layers;
          } else {
            bool isMap = false;
            textureBody(layer, isMap);
          }
        }
        one->layers = named.empty() ? std::vector{layer} : named;
        m->textures.emplace_back(at, one);
      }
    } else if (m->kind == "normal_map") {
      if (peek().isName("normal")) {
        next();
        m->normals.emplace_back(at, normal());
      } else {
        auto n = std::make_shared<NormalNode>();
        while (!peek().isMark("]")) {
          PatternNode p;
          const Value* value = peek().is(Token::Kind::name) ? valueOf(peek()) : nullptr;
          if (value && value->as<Ref<NormalNode>>()) {
            *n = **value->as<Ref<NormalNode>>();
            next();
          } else if (pattern(p)) {
            n->pattern = p;
            comma();
            if (startsNumber()) n->amount = number();
          } else {
            PatternNode none;
            if (!patternModifier(n->pattern ? *n->pattern : none, n->at)) expected("a normal or \"]\"");
          }
          comma();
        }
        m->normals.emplace_back(at, n);
      }
    } else {  // slope_map: heights and slopes
      while (!peek().isMark("]")) expression(), comma();
    }
    expectMark("]", "after an entry of " + m->kind);
  }
  return m;
}

// --- pigments ---

Ref<PigmentNode> Reader::pigment(std::string_view) {
  auto p = std::make_shared<PigmentNode>();
  p->place = place(peek());
  if (const Ref<PigmentNode> named = namedInPlace<PigmentNode>("a pigment")) return named;
  next();
  *p = *defaultPigment_;
  pigmentBody(*p);
  expectMark("}", "after the pigment");
  return p;
}

/// Up to the bracket that closes it.
void Reader::pigmentBody(PigmentNode& p) {
  Omissions own;
  const LeftTo told(*this, own);
  while (!peek().isMark("}") && !peek().isMark("]")) {
    const Token t = peek();
    if (takesMark(",") || takesMark(";")) continue;
    if (const Value* value = t.is(Token::Kind::name) ? valueOf(t) : nullptr) {
      Slot slot;
      if (value->as<std::shared_ptr<Array>>() && !startsNumber()) slot = nullptr;
      if (value->as<Ref<PigmentNode>>()) {
        const Ref<PigmentNode> held = *value->as<Ref<PigmentNode>>();
        next();
        p = *held;
        continue;
      }
      if (value->as<Ref<MapNode>>()) {
        p.entries = (*value->as<Ref<MapNode>>())->pigments;
        next();
        continue;
      }
      if (value->as<std::shared_ptr<Array>>()) {
        const Token name = next();
        const Slot element = namedSlot(name);
        if (const auto* held = element ? element->as<Ref<PigmentNode>>() : nullptr)
          p = **held;
        else if (const auto* n = element ? element->as<Numbers>() : nullptr)
          p.color = binary(3, *n, false).promoted(5);
        else
          fail(name, "expected a pigment or a colour, found " + describe(name));
        continue;
      }
    }
    if (t.isName("pigment")) {
      next();
      p = *pigment();
      continue;
    }
    PatternNode made;
    if (pattern(made)) {
      if (p.pattern) {  // what was said before stays
        PatternNode fresh = made;
        made.turbulence = p.pattern->turbulence;
        made.octaves = p.pattern->octaves, made.omega = p.pattern->omega, made.lambda = p.pattern->lambda;
        (void)fresh;
      }
      p.pattern = made;
      p.entries.clear();
      if (const std::size_t count = listSize(made.kind)) {
        for (std::size_t i = 0; i < count; ++i) {
          comma();
          if (takesName("pigment") || takesName("density")) {
            p.entries.emplace_back(static_cast<Real>(i), pigment());
          } else if (startsNumber() || peek().isName("red") || peek().isName("green") ||
                     peek().isName("blue") ||
                     (peek().is(Token::Kind::name) && valueOf(peek()) && valueOf(peek())->as<Numbers>())) {
            auto plain = std::make_shared<PigmentNode>();
            plain->color = color();
            p.entries.emplace_back(static_cast<Real>(i), plain);
          } else if (const Value* value = peek().is(Token::Kind::name) ? valueOf(peek()) : nullptr;
                     value && value->as<Ref<PigmentNode>>()) {
            p.entries.emplace_back(static_cast<Real>(i), *value->as<Ref<PigmentNode>>());
            next();
          } else {
            break;
          }
        }
      }
      continue;
    }
    if (t.is(Token::Kind::name) && isMapWord(t.text)) {
      next();
      p.entries = map(t)->pigments;
      if (!p.pattern) {
        p.pattern.emplace();
        p.pattern->kind = "gradient";
        p.pattern->vector = {0, 0, 1};
      }
      continue;
    }
    if (t.isName("quick_color") || t.isName("quick_colour")) {
      next();
      color();
      continue;
    }
    if (takesName("uv_mapping")) {
      p.uv = true;
      continue;
    }
    PatternNode none;
    if (patternModifier(p.pattern ? *p.pattern : none, p.at)) continue;
    if (t.is(Token::Kind::name) || startsNumber()) {
      if (t.is(Token::Kind::name) && !startsNumber() && !t.isName("red") && !t.isName("green") &&
          !t.isName("blue") && !t.isName("filter") && !t.isName("transmit"))
        expected("a colour, a pattern, a map or \"}\" in the pigment");
      p.color = color();
      p.pattern.reset();
      p.entries.clear();
      continue;
    }
    expected("a colour, a pattern, a map or \"}\" in the pigment");
  }
  p.left.insert(p.left.end(), own.begin(), own.end());
}

// --- normals and finishes ---

Ref<NormalNode> Reader::normal() {
  auto n = std::make_shared<NormalNode>();
  n->place = place(peek());
  if (const Ref<NormalNode> named = namedInPlace<NormalNode>("a normal")) return named;
  next();
  Omissions own;
  const LeftTo told(*this, own);
  while (!takesMark("}")) {
    const Token t = peek();
    if (takesMark(",")) continue;
    if (const Ref<NormalNode> held = element<NormalNode>()) {
      *n = *held;
      continue;
    }
    if (takesNamed(*n)) continue;
    PatternNode made;
    if (pattern(made)) {
      n->pattern = made;
      if (made.kind == "facets")
        while (takesName("coords") || takesName("size")) number();
      comma();
      if (startsNumber()) n->amount = number();
      if (const std::size_t count = listSize(made.kind))
        for (std::size_t i = 0; i < count; ++i) {
          comma();
          if (!takesName("normal")) break;
          normal();
        }
      continue;
    }
    if (takesName("bump_size")) {
      n->amount = number();
      continue;
    }
    if (t.is(Token::Kind::name) && isMapWord(t.text)) {
      next();
      const Ref<MapNode> m = map(t);
      if (t.isName("slope_map")) leaveOut(t, "slope_map");
      if (t.isName("normal_map")) {
        if (n->pattern && n->pattern->kind != "average") leaveOut(t, "normal_map");
        for (const auto& [at, one] : m->normals)
          if (one->pattern) *n = *one;  // the last stands for all
      }
      continue;
    }
    if (takesName("uv_mapping") || takesName("no_bump_scale")) continue;
    PatternNode none;
    if (!patternModifier(n->pattern ? *n->pattern : none, n->at))
      expected("a pattern, a modifier or \"}\" in the normal");
  }
  n->left.insert(n->left.end(), own.begin(), own.end());
  return n;
}

Ref<FinishNode> Reader::finish() {
  auto f = std::make_shared<FinishNode>(*defaultFinish_);
  if (const Ref<FinishNode> named = namedInPlace<FinishNode>("a finish")) return named;
  next();
  Omissions own;
  const LeftTo told(*this, own);
  while (!takesMark("}")) {
    const Token t = peek();
    if (takesMark(",") || takesMark(";")) continue;
    if (const Ref<FinishNode> held = element<FinishNode>()) {
      *f = *held;
      continue;
    }
    if (takesNamed(*f)) continue;
    if (!t.is(Token::Kind::name)) expected("a word of a finish or \"}\"");
    next();
    const std::string_view w = t.text;
    if (const auto* color = rowOf(w, kFinishColors)) {
      put(*f, *color, plainColor());
    } else if (const auto* row = rowOf(w, kFinishNumbers)) {
      if (w == "diffuse" || w == "phong" || w == "specular") takesName("albedo");
      put(*f, *row, number());
      if (w == "diffuse" && takesMark(","))
        leaveOut(t, "light that a finish lets through from behind"), number();
    } else if (w == "metallic") {
      f->metallic = startsNumber() ? number() : 1;
    } else if (w == "crand") {
      number();
      leaveOut(t, "crand");
    } else if (w == "conserve_energy") {
      f->conservesEnergy = flag();
    } else if (w == "use_alpha" || w == "fresnel") {
      flag();
    } else if (w == "reflection") {
      f->fresnel = false;
      if (takesMark("{")) {
        f->reflectionLeast = Color();
        const Color first = plainColor();
        f->reflectionMost = f->reflectionLeast = first;
        if (takesMark(","))
          f->reflectionMost = plainColor();
        else if (!peek().isMark("}") && startsNumber())
          f->reflectionMost = plainColor();
        bool two = !(f->reflectionMost == first);
        while (!takesMark("}")) {
          if (takesMark(",")) continue;
          if (takesName("fresnel")) {
            f->fresnel = flag();
          } else if (takesName("metallic")) {
            f->reflectsMetal = true;
            if (startsNumber()) number();
          } else if (takesName("falloff")) {
            f->falloff = number();
          } else if (takesName("exponent")) {
            number();
          } else {
            expected("fresnel, metallic, falloff, exponent or \"}\" in the reflection");
          }
        }
        if (f->fresnel && !two) f->reflectionLeast = Color();
      } else {
        f->reflectionMost = f->reflectionLeast = plainColor();
      }
    } else if (w == "irid" || w == "subsurface") {
      leaveOut(t, std::string(w));
      omitBlock();
    } else {
      fail(t, "expected a word of a finish or \"}\", found \"" + std::string(w) + "\"",
           "such words are ambient, diffuse, specular, roughness, phong, phong_size, reflection");
    }
  }
  f->left.insert(f->left.end(), own.begin(), own.end());
  return f;
}

// --- textures ---

/// One item of a texture.
void Reader::textureBody(TextureNode::Layer& layer, bool& isMap) {
  const Token t = peek();
  if (takesMark(",") || takesMark(";")) return;
  if (const Value* value = t.is(Token::Kind::name) ? valueOf(t) : nullptr) {
    if (const auto* p = value->as<Ref<PigmentNode>>()) {
      layer.pigment = *p;
      next();
      return;
    }
    if (const auto* n = value->as<Ref<NormalNode>>()) {
      layer.normal = *n;
      next();
      return;
    }
    if (const auto* f = value->as<Ref<FinishNode>>()) {
      layer.finish = *f;
      next();
      return;
    }
  }
  if (takesName("pigment")) {
    layer.pigment = pigment();
    return;
  }
  if (takesName("normal")) {
    layer.normal = normal();
    return;
  }
  if (takesName("finish")) {
    layer.finish = finish();
    return;
  }
  if (t.isName("texture_map")) {
    next();
    layer.entries = map(t)->textures;
    isMap = true;
    return;
  }
  if (takesName("uv_mapping")) return;
  if (takesName("tiles")) {
    layer.pattern.emplace();
    layer.pattern->kind = "checker";
    expectMark("{", "after tiles");
    while (!takesMark("}")) {
      if (takesName("texture"))
        layer.entries.emplace_back(static_cast<Real>(layer.entries.size()), texture());
      else if (!takesName("tile2"))
        expected("texture, tile2 or \"}\"");
    }
    isMap = true;
    return;
  }
  PatternNode p;
  if (pattern(p)) {
    layer.pattern = p;
    isMap = true;
    if (p.kind == "material_map") {
      leaveOut(t, "material_map");
      while (takesName("texture")) texture();
    }
    if (const std::size_t count = listSize(p.kind))
      for (std::size_t i = 0; i < count; ++i) {
        comma();
        if (!takesName("texture")) break;
        layer.entries.emplace_back(static_cast<Real>(i), texture());
      }
    return;
  }
  PatternNode none;
  if (patternModifier(layer.pattern ? *layer.pattern : none, layer.at)) return;
  expected("pigment, normal, finish, a pattern, a transform or \"}\" in the texture");
}

Ref<TextureNode> Reader::texture() {
  constexpr int kMostDepth = 100;
  if (const Ref<TextureNode> named = namedInPlace<TextureNode>("a texture")) return named;
  if (++depth_ > kMostDepth) {
    depth_ = 0;
    fail(peek(), "textures within each other more than 100 deep");
  }
  next();
  auto whole_ = std::make_shared<TextureNode>();
  TextureNode::Layer layer{defaultPigment_, defaultNormal_, defaultFinish_, {}, {}, {}};
  bool isMap = false, named = false;
  while (!takesMark("}")) {
    const Token t = peek();
    const Value* value = t.is(Token::Kind::name) ? valueOf(t) : nullptr;
    if (value && (value->as<Ref<TextureNode>>() || value->as<std::shared_ptr<Array>>())) {
      next();
      const Slot slot = namedSlot(t);
      const auto* held = slot ? slot->as<Ref<TextureNode>>() : nullptr;
      if (!held) fail(t, "expected a texture, found " + describe(t));
      *whole_ = **held;
      named = true;
      continue;
    }
    if (named) {
      // Transforms move all layers; what else is said changes the last one.
      Affine by;
      if (transform(by)) {
        for (TextureNode::Layer& l : whole_->layers) l.at = by * l.at;
        continue;
      }
      TextureNode::Layer& last = whole_->layers.back();
      textureBody(last, isMap);
      continue;
    }
    textureBody(layer, isMap);
  }
  --depth_;
  if (!named) {
    if (isMap && layer.entries.empty()) {
      layer.pattern.reset();
      if (!isMap) leaveOut(peek(), "a texture's pattern without a map");
    }
    whole_->layers.push_back(layer);
  }
  return whole_;
}

// --- what is inside ---

MediaNode Reader::media() {
  MediaNode m;
  m.place = place(peek());
  expectMark("{", "after media");
  while (!takesMark("}")) {
    const Token t = peek();
    if (takesMark(",")) continue;
    if (takesNamed(m)) continue;
    Affine by;
    if (transform(by)) {
      m.at = by * m.at;
      continue;
    }
    next();
    if (t.isName("emission")) {
      m.emission = plainColor();
    } else if (t.isName("absorption")) {
      m.absorption = plainColor();
    } else if (t.isName("scattering")) {
      expectMark("{", "after scattering");
      whole();
      comma();
      m.scattering = plainColor();
      for (;;) {
        if (takesMark("}")) break;
        if (takesMark(",")) continue;
        if (takesName("eccentricity"))
          m.eccentricity = number();
        else if (takesName("extinction"))
          number();
        else
          expected("eccentricity, extinction or \"}\"");
      }
    } else if (t.isName("density")) {
      const Ref<PigmentNode> d = pigment();
      if (m.density) leaveOut(t, "a second density of a media");
      m.density = d;
    } else if (t.isName("samples")) {
      number();
      if (takesMark(",")) number();
    } else if (t.is(Token::Kind::name) && isAmong(t.text, kUnusedOfMedia)) {
      number();
    } else if (t.isName("collect")) {
      flag();
    } else {
      fail(t, "expected a word of a media or \"}\", found " + describe(t));
    }
  }
  return m;
}

Ref<InteriorNode> Reader::interior() {
  auto in = std::make_shared<InteriorNode>();
  if (const Ref<InteriorNode> named = namedInPlace<InteriorNode>("an interior")) return named;
  next();
  Omissions own;
  const LeftTo told(*this, own);
  while (!takesMark("}")) {
    const Token t = peek();
    if (takesMark(",") || takesMark(";")) continue;
    if (const Value* value = t.is(Token::Kind::name) ? valueOf(t) : nullptr) {
      if (const auto* held = value->as<Ref<InteriorNode>>()) {
        *in = **held;
        next();
        continue;
      }
      if (const auto* held = value->as<Ref<MediaNode>>()) {
        in->media.push_back(**held);
        next();
        continue;
      }
    }
    Affine by;
    if (transform(by)) {
      for (MediaNode& m : in->media) m.at = by * m.at;
      continue;
    }
    next();
    if (const auto* row = rowOf(t.text, kInteriorNumbers); row && t.is(Token::Kind::name)) {
      put(*in, *row, number());
    } else if (t.isName("fade_color") || t.isName("fade_colour")) {
      in->fadeColor = plainColor();
    } else if (t.isName("dispersion")) {
      number();
      leaveOut(t, "dispersion");
    } else if (t.isName("media")) {
      in->media.push_back(media());
    } else {
      fail(t, "expected a word of an interior or \"}\", found " + describe(t));
    }
  }
  in->left.insert(in->left.end(), own.begin(), own.end());
  return in;
}

Ref<MaterialNode> Reader::material() {
  auto m = std::make_shared<MaterialNode>();
  if (const Ref<MaterialNode> named = namedInPlace<MaterialNode>("a material")) return named;
  next();
  auto all = std::make_shared<TextureNode>();
  while (!takesMark("}")) {
    const Token t = peek();
    if (const Ref<MaterialNode> held = element<MaterialNode>()) {
      *m = *held;
      if (m->texture) *all = *m->texture;
      continue;
    }
    if (const Value* value = t.is(Token::Kind::name) ? valueOf(t) : nullptr)
      if (const auto* held = value->as<Ref<MaterialNode>>()) {
        *m = **held;
        if (m->texture) *all = *m->texture;
        next();
        continue;
      }
    Affine by;
    if (takesName("texture")) {
      const Ref<TextureNode> one = texture();
      all->layers.insert(all->layers.end(), one->layers.begin(), one->layers.end());
    } else if (takesName("interior")) {
      m->interior = interior();
    } else if (takesName("interior_texture")) {
      leaveOut(t, "interior_texture");
      texture();
    } else if (transform(by)) {
      for (TextureNode::Layer& l : all->layers) l.at = by * l.at;
    } else {
      expected("texture, interior, a transform or \"}\"");
    }
  }
  if (!all->layers.empty()) m->texture = all;
  return m;
}

}  // namespace trace::pov
