#include "formats/pov/pov_paint.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "formats/pov/pov_formula.h"
#include "math/elementary.h"
#include "math/expression.h"
#include "shading/textures/formula.h"
#include "shading/textures/image_map.h"
#include "shading/textures/mix.h"
#include "shading/textures/ramp.h"
#include "shading/textures/solid.h"

namespace trace::pov {
namespace {

Vec3 column(const Affine& m, int i) { return {m.row[0][i], m.row[1][i], m.row[2][i]}; }

/// Angles about x, then y, then z, in degrees.
Vec3 anglesOf(const Affine& r) {
  constexpr Real kDegrees = 180 / kPi;
  const Real s = std::clamp(-r.row[2].x, -1.0, 1.0);
  Vec3 a;
  a.y = math::asin(s);
  if (std::abs(s) < 1 - 1e-12) {
    a.x = math::atan2(r.row[2].y, r.row[2].z);
    a.z = math::atan2(r.row[1].x, r.row[0].x);
  } else {
    a.x = 0;
    a.z = math::atan2(-r.row[0].y, r.row[1].y);
  }
  for (int i = 0; i < 3; ++i) {
    a[i] *= kDegrees;
    const Real whole = std::round(a[i]);
    if (std::abs(a[i] - whole) < 1e-9) a[i] = whole;
  }
  return a;
}

Affine columns(const Vec3& x, const Vec3& y, const Vec3& z) {
  Affine m;
  for (int i = 0; i < 3; ++i) m.row[i] = {x[i], y[i], z[i]};
  return m;
}

/// m's linear part as a rotation after scales; nothing if it also shears.
std::optional<TexturePlacement> plainPlacement(const Affine& m) {
  Vec3 c[3], s;
  for (int i = 0; i < 3; ++i) {
    c[i] = column(m, i);
    s[i] = length(c[i]);
    if (!(s[i] > 0)) return {};
    c[i] = c[i] / s[i];
  }
  for (int i = 0; i < 3; ++i)
    if (std::abs(dot(c[i], c[(i + 1) % 3])) > 1e-9) return {};
  if (dot(cross(c[0], c[1]), c[2]) < 0) c[2] = -c[2], s.z = -s.z;
  return TexturePlacement{s, anglesOf(columns(c[0], c[1], c[2])), m.offset};
}

/// The eigenvectors of a symmetric matrix, by Jacobi's rotations.
Affine axesOf(Affine a) {
  Affine v;
  for (int sweep = 0; sweep < 30; ++sweep)
    for (int p = 0; p < 2; ++p)
      for (int q = p + 1; q < 3; ++q) {
        if (std::abs(a.row[p][q]) < 1e-300) continue;
        const Real t = 0.5 * math::atan2(2 * a.row[p][q], a.row[q][q] - a.row[p][p]);
        Affine r;
        r.row[p][p] = r.row[q][q] = math::cos(t);
        r.row[p][q] = math::sin(t);
        r.row[q][p] = -math::sin(t);
        Affine back;
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j) back.row[i][j] = r.row[j][i];
        a = back * a * r;
        v = v * r;
      }
  return v;
}

Texture wrapped(const Texture& inner, const TexturePlacement& placement) {
  if (placement == TexturePlacement{}) return inner;
  if (inner->placement == TexturePlacement{}) {
    trace::TextureNode node = *inner;
    node.placement = placement;
    return node;
  }
  return trace::TextureNode{.model = Mix{.a = Color(1), .b = Color(0), .amount = 0},
                            .placement = placement,
                            .inputs = {{"a", inner}}};
}

std::string waveOf(const PatternNode& p) {
  if (!p.wave.empty()) return p.wave;
  return p.kind == "marble" || p.kind == "wood" ? "triangle_wave" : "ramp_wave";
}

std::optional<SolidPattern> solidOf(const std::string& kind) {
  static const std::pair<std::string_view, SolidPattern> kKinds[]{
      {"bozo", SolidPattern::bozo},       {"spotted", SolidPattern::bozo},
      {"bumps", SolidPattern::bozo},      {"agate", SolidPattern::agate},
      {"granite", SolidPattern::granite}, {"gradient", SolidPattern::gradient},
      {"leopard", SolidPattern::leopard}, {"onion", SolidPattern::onion},
      {"marble", SolidPattern::marble},   {"wood", SolidPattern::wood},
      {"radial", SolidPattern::radial},   {"spherical", SolidPattern::spherical},
      {"boxed", SolidPattern::boxed},     {"cylindrical", SolidPattern::cylindrical},
      {"planar", SolidPattern::planar},   {"wrinkles", SolidPattern::wrinkles},
      {"crackle", SolidPattern::crackle}, {"cells", SolidPattern::cells},
      {"spiral1", SolidPattern::spiral},  {"spiral2", SolidPattern::weave},
      {"quilted", SolidPattern::quilted}, {"waves", SolidPattern::waves},
      {"ripples", SolidPattern::ripples}, {"dents", SolidPattern::dents},
      {"hexagon", SolidPattern::hexagon}, {"brick", SolidPattern::brick},
      {"checker", SolidPattern::checker}};
  for (const auto& [name, pattern] : kKinds)
    if (name == kind) return pattern;
  return {};
}

Solid solid(const PatternNode& p) {
  Solid s;
  s.kind = *solidOf(p.kind);
  s.turbulence = p.turbulence;
  s.octaves = p.octaves;
  s.lambda = std::clamp(p.lambda, 0.0, 100.0);
  s.omega = std::clamp(p.omega, 0.0, 100.0);
  s.axis = p.vector;
  s.number = p.number;
  s.frequency = p.frequency;
  s.phase = p.phase;
  s.exponent = p.exponent;
  const std::string wave = waveOf(p);
  s.wave = wave == "triangle_wave"  ? SolidWave::triangle
           : wave == "sine_wave"    ? SolidWave::sine
           : wave == "scallop_wave" ? SolidWave::scallop
           : wave == "cubic_wave"   ? SolidWave::cubic
           : wave == "poly_wave"    ? SolidWave::power
                                    : SolidWave::saw;
  return s;
}

bool isList(const std::string& kind) { return kind == "checker" || kind == "brick" || kind == "hexagon"; }

Ref<PigmentNode> plain(Real r, Real g, Real b) {
  auto p = std::make_shared<PigmentNode>();
  p->color[0] = r, p->color[1] = g, p->color[2] = b;
  return p;
}

/// The colours of a pattern without a map.
Entries<PigmentNode> usualEntries(const std::string& kind) {
  if (kind == "checker") return {{0, plain(0, 0, 1)}, {1, plain(0, 1, 0)}};
  if (kind == "hexagon") return {{0, plain(0, 0, 1)}, {1, plain(0, 1, 0)}, {2, plain(1, 0, 0)}};
  if (kind == "brick") return {{0, plain(0.3, 0.3, 0.3)}, {1, plain(0.6, 0.15, 0.15)}};
  if (kind == "agate")
    return {{0, plain(1, 1, 1)},
            {0.5, plain(0.95, 0.75, 0.5)},
            {0.5, plain(0.9, 0.7, 0.5)},
            {0.6, plain(0.9, 0.7, 0.4)},
            {1, plain(0.6, 0.3, 0)}};
  if (kind == "bozo")
    return {{0.4, plain(1, 1, 1)}, {0.4, plain(0, 1, 0)}, {0.6, plain(0, 1, 0)}, {0.6, plain(0, 0, 1)}};
  if (kind == "marble")
    return {{0, plain(0.9, 0.8, 0.8)}, {0.9, plain(0.9, 0.08, 0.08)}, {0.9, plain(0, 0, 0)}};
  if (kind == "radial")
    return {{0, plain(0, 1, 1)}, {1.0 / 3, plain(1, 1, 0)}, {2.0 / 3, plain(1, 0, 1)}, {1, plain(0, 1, 1)}};
  if (kind == "wood") return {{0.6, plain(0.666, 0.312, 0.2)}, {0.6, plain(0.4, 0.133, 0.066)}};
  return {{0, plain(0, 0, 0)}, {1, plain(1, 1, 1)}};
}

/// Where the entries of a list lie on the way from 0 to 1.
template <class T>
Entries<T> spread(const std::string& kind, Entries<T> entries) {
  if (!isList(kind) || entries.empty()) return entries;
  const std::size_t n = kind == "hexagon" ? 3 : 2;
  while (entries.size() < n) entries.push_back(entries.back());
  Entries<T> edges;
  for (std::size_t i = 0; i < n; ++i) {
    const Real middle = static_cast<Real>(i) / static_cast<Real>(n - 1),
               half = 0.25 / static_cast<Real>(n - 1);
    edges.emplace_back(middle - half, entries[i].second);
    edges.emplace_back(middle + half, entries[i].second);
  }
  return edges;
}

/// Between colours of different transparency more entries: what is seen of a colour and what it lets through
/// are products of its parts.
Entries<PigmentNode> withBetween(const Entries<PigmentNode>& entries) {
  constexpr int kParts = 8;
  Entries<PigmentNode> all;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (i > 0 && entries[i].first > entries[i - 1].first) {
      const PigmentNode &a = *entries[i - 1].second, &b = *entries[i].second;
      const bool differ = a.color[3] != b.color[3] || a.color[4] != b.color[4];
      for (int k = 1; differ && !a.pattern && !b.pattern && k < kParts; ++k) {
        const Real share = static_cast<Real>(k) / kParts;
        auto between = std::make_shared<PigmentNode>(a);
        for (int j = 0; j < 5; ++j) between->color[j] = a.color[j] + share * (b.color[j] - a.color[j]);
        all.emplace_back(entries[i - 1].first + share * (entries[i].first - entries[i - 1].first), between);
      }
    }
    all.push_back(entries[i]);
  }
  return all;
}

/// From a to b, as the number of the texture goes from 0 to 1.
Paint mixed(const Paint& a, const Paint& b, const Texture& amount) {
  if (!a.texture && !b.texture && a.scale == b.scale) return a;
  Mix mix{.a = a.scale, .b = b.scale, .amount = 1};
  std::vector<FieldTexture> inputs;
  if (a.texture) inputs.push_back({"a", *a.texture});
  inputs.push_back({"amount", amount});
  if (b.texture) inputs.push_back({"b", *b.texture});
  return {Color(1), Texture(trace::TextureNode{.model = mix, .inputs = inputs})};
}

Paint added(const Paint& a, const Paint& b) {
  if (a.none()) return b;
  if (b.none()) return a;
  if (!a.texture && !b.texture) return {a.scale + b.scale, {}};
  Mix mix{.a = a.scale, .b = b.scale, .amount = 0.5};
  std::vector<FieldTexture> inputs;
  if (a.texture) inputs.push_back({"a", *a.texture});
  if (b.texture) inputs.push_back({"b", *b.texture});
  return {Color(2), Texture(trace::TextureNode{.model = mix, .inputs = inputs})};
}

Paint product(const Paint& a, const Paint& b) {
  if (a.none() || b.none()) return {};
  if (!a.texture) return {a.scale * b.scale, b.texture};
  if (!b.texture) return {a.scale * b.scale, a.texture};
  Mix mix{.a = Color(0), .b = Color(1), .amount = 1};
  return {a.scale * b.scale,
          Texture(trace::TextureNode{.model = mix, .inputs = {{"amount", *b.texture}, {"b", *a.texture}}})};
}

Paint placedBy(Paint p, const Affine& m) {
  if (p.texture) p.texture = moved(*p.texture, m);
  return p;
}

Pixels pixelsOf(const PatternNode& pattern) {
  const ImageNode& image = pattern.image;
  if (!image.inside) return {image.file, nullptr, pattern.place};
  return {image.file, MipMap::decode(image.inside->bytes, image.file), pattern.place, image.inside};
}

/// The way from one position to the next, as a texture of numbers from 0 to 1.
Texture stretch(const Texture& number, Real from, Real to) {
  Ramp ramp;
  ramp.value = 1;
  ramp.ramp = {{from, 0, 0, 0}, {to, 1, 1, 1}};
  return trace::TextureNode{.model = ramp, .inputs = {{"value", number}}};
}

}  // namespace

Texture moved(const Texture& texture, const Affine& m) {
  if (m == Affine()) return texture;
  if (const auto placement = plainPlacement(m)) return wrapped(texture, *placement);
  // m = U S V^T: the inner texture is turned by V^T, the outer one scaled by S and turned by U.
  Affine square;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) square.row[i][j] = dot(column(m, i), column(m, j));
  Affine v = axesOf(square);
  if (determinant(v) < 0)
    for (int i = 0; i < 3; ++i) v.row[i].x = -v.row[i].x;
  Affine turned;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) turned.row[i][j] = v.row[j][i];
  Affine outer = m;
  outer.offset = {};
  outer = outer * v;
  outer.offset = m.offset;
  Vec3 c[3], s;
  for (int i = 0; i < 3; ++i) {
    c[i] = column(outer, i);
    s[i] = length(c[i]);
    if (!(s[i] > 0)) return texture;
    c[i] = c[i] / s[i];
  }
  c[1] = normalize(c[1] - c[0] * dot(c[0], c[1]));
  const Vec3 third = cross(c[0], c[1]);
  if (dot(third, c[2]) < 0) s.z = -s.z;
  const TexturePlacement first{{1, 1, 1}, anglesOf(turned), {}},
      second{s, anglesOf(columns(c[0], c[1], third)), m.offset};
  return wrapped(wrapped(texture, first), second);
}

bool Painter::knows(const PatternNode& p) {
  if (solidOf(p.kind) || p.kind == "average") return true;
  if (p.kind == "pigment_pattern" && p.pigment) return true;
  if (p.kind == "function" && p.formula) {
    if (p.formula->onlyPigment()) return true;
    if (const auto text = p.formula->text({"x", "y", "z"})) try {
        Expression check(*text, Expression::Variables::xyzuv);
        return true;
      } catch (const Error&) {
      }
  }
  if (p.kind == "image_map") return true;
  const std::string what = "the pattern " + p.kind + " is left out";
  if (isFirst(&p) && !warnings_.again(what)) warnings_.warn(p.place, what, "its last colour takes its place");
  return false;
}

/// A texture whose luminance is the pattern's number.
Texture Painter::numberOf(const PatternNode& p) {
  Paint grey;
  if (p.kind == "pigment_pattern") {
    grey = paint(*p.pigment, [](const Numbers& c) {
      return Color(std::max(0.297 * c[0] + 0.589 * c[1] + 0.114 * c[2], 0.0));
    });
  } else if (p.kind == "function" && p.formula && p.formula->onlyPigment()) {
    grey = paint(*p.formula->onlyPigment(),
                 [&](const Numbers& c) { return Color(std::max(p.formula->ofColor(c), 0.0)); });
  }
  if (p.kind == "pigment_pattern" || (p.kind == "function" && p.formula && p.formula->onlyPigment())) {
    Mix mix{.a = grey.scale, .b = Color(0), .amount = 0};
    std::vector<FieldTexture> inputs;
    if (grey.texture) inputs.push_back({"a", *grey.texture});
    return trace::TextureNode{.model = mix, .inputs = inputs};
  }
  if (p.kind == "function" && p.formula) {
    trace::Formula f;
    f.value = FormulaText(*p.formula->text({"x", "y", "z"}));
    f.ramp = {{0, 0, 0, 0}, {1, 1, 1, 1}};
    return trace::TextureNode{.model = f};
  }
  Solid s = solid(p);
  s.a = Color(0);
  s.b = Color(1);
  return trace::TextureNode{.model = s};
}

void Painter::tell(const Omissions& left) {
  if (!isFirst(&left)) return;
  for (const auto& [what, place] : left)
    if (!warnings_.again(what)) warnings_.warn(place, what);
}

Paint Painter::paint(const PigmentNode& p, const Leaf& leaf, bool uv) {
  tell(p.left);
  if (!p.pattern) return {leaf(p.color), {}};
  const PatternNode& pattern = *p.pattern;
  if (!knows(pattern)) {
    if (!p.entries.empty()) return paint(*p.entries.back().second, leaf, uv);
    return {leaf(p.color), {}};
  }
  if (pattern.kind == "image_map") {
    if (pattern.image.file.empty()) return {leaf(p.color), {}};
    ImageMap map;
    map.file = pixelsOf(pattern);
    map.srgb = conventions_.linear;
    if (!uv && !p.uv) {
      map.mapping = pattern.image.mapType == 1   ? Mapping::sphere
                    : pattern.image.mapType == 2 ? Mapping::cylinder
                                                 : Mapping::plane;
      if (pattern.image.mapType > 2) {
        const std::string what =
            "a picture with map_type " + std::to_string(pattern.image.mapType) + " is left out";
        if (!warnings_.again(what)) warnings_.warn(pattern.place, what, "it is laid on flat");
      }
    }
    if (pattern.image.once) map.wrapU = map.wrapV = Wrap::clamp;
    Numbers white = Numbers(Vec3{1, 1, 1}).promoted(5);
    white[3] = pattern.image.filterAll;
    white[4] = pattern.image.transmitAll;
    return placedBy({leaf(white), Texture(trace::TextureNode{.model = map})}, p.at);
  }
  Entries<PigmentNode> entries = p.entries.empty() ? usualEntries(pattern.kind) : p.entries;
  if (pattern.kind == "average") {
    Real total = 0;
    Paint all;
    for (const auto& [weight, one] : entries) {
      if (!(weight > 0)) continue;
      Paint part = paint(*one, leaf, uv);
      part.scale = part.scale * weight;
      all = added(all, part);
      total += weight;
    }
    if (total > 0) all.scale = all.scale / total;
    return placedBy(all, p.at);
  }
  entries = spread(pattern.kind, entries);
  std::stable_sort(entries.begin(), entries.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  entries = withBetween(entries);
  std::vector<Paint> paints;
  bool allPlain = true, allSame = true;
  for (const auto& [at, one] : entries) {
    paints.push_back(paint(*one, leaf, uv));
    allPlain = allPlain && !paints.back().texture;
    allSame = allSame && paints.back().scale == paints.front().scale;
  }
  if (allPlain && allSame) return paints.front();
  Paint all;
  if (allPlain) {
    ColorRamp ramp;
    for (std::size_t i = 0; i < entries.size(); ++i) {
      const Color& c = paints[i].scale;
      ramp.push_back({entries[i].first, c.r, c.g, c.b});
    }
    if (pattern.kind == "pigment_pattern" || (pattern.formula && pattern.formula->onlyPigment())) {
      Ramp r;
      r.value = 1;
      r.ramp = ramp;
      all = {Color(1), Texture(trace::TextureNode{.model = r, .inputs = {{"value", numberOf(pattern)}}})};
    } else if (pattern.kind == "function") {
      trace::Formula f;
      f.value = FormulaText(*pattern.formula->text({"x", "y", "z"}));
      f.ramp = ramp;
      all = {Color(1), Texture(trace::TextureNode{.model = f})};
    } else {
      Solid s = solid(pattern);
      s.ramp = ramp;
      all = {Color(1), Texture(trace::TextureNode{.model = s})};
    }
  } else {
    const Texture number = numberOf(pattern);
    all = paints.front();
    for (std::size_t i = 1; i < entries.size(); ++i) {
      const Real from = entries[i - 1].first, to = entries[i].first;
      all = mixed(all, paints[i], stretch(number, from, to));
    }
  }
  return placedBy(all, p.at);
}

namespace {

Color rgb(const Numbers& c) { return {c[0], c[1], c[2]}; }
Real shown(const Numbers& c) { return std::clamp(1 - c[3] - c[4], 0.0, 1.0); }
Color notBelowZero(const Color& c) { return {std::max(c.r, 0.0), std::max(c.g, 0.0), std::max(c.b, 0.0)}; }

/// The sum of the colours of a pigment, where its map has them.
Color sumOf(const PigmentNode& p) {
  Color sum;
  for (const auto& [at, one] : p.entries) sum = sum + sumOf(*one);
  return p.entries.empty() ? notBelowZero(rgb(p.color)) : sum;
}

/// The colour of a density, of luminance 1: a medium has one colour, and its texture holds the amounts.
Color tintOf(const PigmentNode& density) {
  const Color sum = sumOf(density);
  return luminance(sum) > 0 ? sum / luminance(sum) : Color(1);
}

/// The factor on a bump that makes it as strong as in POV-Ray.
Real reliefOf(const std::string& kind) {
  constexpr Real kGradient = 0.135;
  if (kind == "bumps") return 0.7;
  if (kind == "waves") return 2.4;
  if (kind == "ripples") return 0.45;
  return kGradient;
}

}  // namespace

Paint Painter::opaque(const PigmentNode& pigment, Real strength, bool uv) {
  return paint(
      pigment, [&](const Numbers& c) { return notBelowZero(rgb(c) * (shown(c) * strength)); }, uv);
}

Paint Painter::passing(const PigmentNode& pigment, bool uv) {
  return paint(
      pigment, [](const Numbers& c) { return clamp01(notBelowZero(rgb(c) * c[3] + Color(c[4]))); }, uv);
}

Paint Painter::layered(const Paint& top, const Paint& passing, const Paint& below) {
  return added(top, product(below, passing));
}

/// Fresnel's formula by Schlick's approximation, with that of 0 for an index of 1.
Painter::Mirror Painter::mirror(const FinishNode& f) const {
  const Color gain = notBelowZero(f.reflectionMost + f.reflectionLeast * -1);
  if (!f.fresnel) return {f.reflectionLeast, gain, f.falloff};
  if (index_ == 1) return {f.reflectionLeast, Color(0)};
  const Real root = (index_ - 1) / (index_ + 1), straight = root * root;
  return {f.reflectionLeast + gain * straight, gain * (1 - straight)};
}

/// Blinn's highlight needs about four times the exponent of Phong's (Fisher and Woo, Graphics Gems IV).
Real Painter::shininess(const FinishNode& f) const {
  constexpr Real kBlinnOfPhong = 4;
  const bool mirrored = conventions_.mirrorHighlights;
  return f.specular >= f.phong ? 1 / std::max(f.roughness, 1e-4) / (mirrored ? kBlinnOfPhong : 1)
                               : f.phongSize * (mirrored ? 1 : kBlinnOfPhong);
}

/// A surface has one brilliance and one exponent of its mirror: those of the first layer that gives them.
void Painter::takeAngles(Look& to, const Look& from) {
  if (to.brilliance == 1) to.brilliance = from.brilliance;
  if (to.grazing.none()) to.grazingExponent = from.grazingExponent;
}

Painter::Look Painter::averageOf(const Entries<TextureNode>& entries, const std::vector<Look>& looks) {
  Real total = 0;
  for (const auto& [weight, one] : entries) total += std::max(weight, 0.0);
  if (!(total > 0)) return looks.back();
  Look all = looks.front();
  for (Paint Look::*field : {&Look::diffuse, &Look::ambient, &Look::emissive, &Look::specular,
                             &Look::reflective, &Look::grazing, &Look::transmissive}) {
    Paint sum;
    for (std::size_t i = 0; i < looks.size(); ++i) {
      Paint part = looks[i].*field;
      part.scale = part.scale * (std::max(entries[i].first, 0.0) / total);
      if (!part.none()) sum = sum.none() ? part : added(sum, part);
    }
    all.*field = sum;
  }
  for (const Look& look : looks) {
    all.clear = all.clear && look.clear;
    if (all.shininess == 0) all.shininess = look.shininess;
    takeAngles(all, look);
    if (!all.relief) all.relief = look.relief, all.bump = look.bump;
  }
  return all;
}

Painter::Look Painter::look(const TextureNode::Layer& layer, bool uv) {
  Look l;
  if (!layer.entries.empty() && layer.pattern) {
    const PatternNode& pattern = *layer.pattern;
    Entries<TextureNode> entries = spread(pattern.kind, layer.entries);
    std::vector<Look> looks;
    for (const auto& [at, one] : entries) looks.push_back(look(*one, uv));
    l = looks.front();
    if (pattern.kind == "average") {
      l = averageOf(entries, looks);
    } else if (!knows(pattern)) {
      l = looks.back();
    } else {
      const Texture number = numberOf(pattern);
      for (std::size_t i = 1; i < looks.size(); ++i) {
        const Texture amount = stretch(number, entries[i - 1].first, entries[i].first);
        const Look& b = looks[i];
        for (Paint Look::*field : {&Look::diffuse, &Look::ambient, &Look::emissive, &Look::specular,
                                   &Look::reflective, &Look::grazing, &Look::transmissive})
          l.*field = mixed(l.*field, b.*field, amount);
        if (l.shininess == 0) l.shininess = b.shininess;
        takeAngles(l, b);
        if (!l.relief) l.relief = b.relief, l.bump = b.bump;
        l.clear = l.clear && b.clear;
      }
    }
  } else {
    static const PigmentNode kBlack;
    static const FinishNode kUsual;
    const PigmentNode& p = layer.pigment ? *layer.pigment : kBlack;
    const FinishNode& f = layer.finish ? *layer.finish : kUsual;
    tell(f.left);
    if (layer.normal) tell(layer.normal->left);
    l.brilliance = std::max(f.brilliance, 0.0);
    l.diffuse = opaque(p, f.diffuse, uv);
    l.ambient = paint(
        p, [&](const Numbers& c) { return notBelowZero(rgb(c) * f.ambient * shown(c)); }, uv);
    if (!isBlack(f.emission))
      l.emissive = paint(
          p, [&](const Numbers& c) { return notBelowZero(rgb(c) * f.emission * shown(c)); }, uv);
    l.transmissive = passing(p, uv);
    const Real highlight = std::max(f.specular, f.phong);
    if (highlight > 0) {
      l.shininess = shininess(f);
      l.specular = paint(
          p,
          [&](const Numbers& c) {
            return notBelowZero(lerp(std::clamp(f.metallic, 0.0, 1.0), Color(1), rgb(c)) * highlight);
          },
          uv);
    }
    const auto mirrored = [&](const Color& weight) {
      return paint(
          p, [&](const Numbers& c) { return notBelowZero(f.reflectsMetal ? rgb(c) * weight : weight); }, uv);
    };
    const Mirror mirror = this->mirror(f);
    if (!isBlack(mirror.least)) l.reflective = mirrored(mirror.least);
    if (!isBlack(mirror.gain)) l.grazing = mirrored(mirror.gain);
    l.grazingExponent = mirror.exponent;
    if (f.conservesEnergy)
      l.transmissive.scale = l.transmissive.scale * (1 - maxComponent(clamp01(mirror.least)));
    l.clear = !l.transmissive.texture && l.transmissive.scale == Color(1) && l.reflective.none() &&
              l.grazing.none() && l.specular.none();
    if (layer.normal && layer.normal->pattern && layer.normal->amount != 0) {
      const NormalNode& n = *layer.normal;
      if (solidOf(n.pattern->kind) && !isList(n.pattern->kind)) {
        l.relief = moved(numberOf(*n.pattern), n.at);
        l.bump = n.amount * reliefOf(n.pattern->kind) * math::cbrt(std::abs(determinant(n.at)));
      } else {
        const std::string what = "the normal " + n.pattern->kind + " is left out";
        if (!warnings_.again(what)) warnings_.warn(n.pattern->place, what);
      }
    }
  }
  if (!(layer.at == Affine())) {
    for (Paint Look::*field : {&Look::diffuse, &Look::ambient, &Look::emissive, &Look::specular,
                               &Look::reflective, &Look::grazing, &Look::transmissive})
      l.*field = placedBy(l.*field, layer.at);
    if (l.relief) {
      l.relief = moved(*l.relief, layer.at);
      l.bump *= math::cbrt(std::abs(determinant(layer.at)));
    }
  }
  return l;
}

Painter::Look Painter::look(const TextureNode& texture, bool uv) {
  if (texture.layers.empty()) return {};
  Look l = look(texture.layers.front(), uv);
  for (std::size_t i = 1; i < texture.layers.size(); ++i) {
    const Look top = look(texture.layers[i], uv);
    for (Paint Look::*field : {&Look::diffuse, &Look::ambient, &Look::emissive, &Look::specular,
                               &Look::reflective, &Look::grazing})
      l.*field = layered(top.*field, top.transmissive, l.*field);
    l.transmissive = product(l.transmissive, top.transmissive);
    if (top.shininess > 0) l.shininess = top.shininess;
    takeAngles(l, top);
    if (top.relief) l.relief = top.relief, l.bump = top.bump;
    l.clear = l.clear && top.clear;
  }
  return l;
}

Material Painter::material(const TextureNode& texture, const InteriorNode* interior,
                           const Affine& objectFromTexture, bool uv) {
  index_ = interior ? interior->ior : 1;
  const Look l = look(texture, uv);
  if (interior) tell(interior->left);
  Material m;
  m.sides = ShadedSides::both;
  Phong phong;
  const auto set = [&](Color Phong::*field, const char* name, const Paint& p) {
    phong.*field = p.scale;
    if (p.texture && !p.none()) setTexture(m.textures, name, moved(*p.texture, objectFromTexture));
  };
  set(&Phong::diffuse, "diffuse", l.diffuse);
  set(&Phong::ambient, "ambient", l.ambient);
  set(&Phong::emissive, "emissive", l.emissive);
  set(&Phong::specular, "specular", l.specular);
  set(&Phong::reflective, "reflective", l.reflective);
  set(&Phong::grazing, "grazing", l.grazing);
  set(&Phong::transmissive, "transmissive", l.transmissive);
  phong.brilliance = l.brilliance;
  phong.grazingExponent = l.grazingExponent;
  phong.shininess = l.shininess;
  if (interior && !l.transmissive.none()) {
    if (interior->ior > 0) phong.index = interior->ior;
    if (interior->fadeDistance > 0 && interior->fadePower > 0) {
      const Color c = clamp01(interior->fadeColor);
      const auto part = [](Real v) { return std::clamp(0.5 + v / 2, 0.01, 1.0); };
      phong.attenuationColor = {part(c.r), part(c.g), part(c.b)};
      phong.attenuationDistance = interior->fadeDistance;
    }
  }
  if (l.clear && phong.index == 1) {
    m.opacity = 0;
  }
  if (l.relief) {
    m.bump = l.bump * math::cbrt(std::abs(determinant(objectFromTexture)));
    if (m.bump != 0) setTexture(m.textures, "bump", moved(*l.relief, objectFromTexture));
  }
  m.model = phong;
  if (interior)
    for (const MediaNode& medium : interior->media) {
      const Color tint = medium.density ? tintOf(*medium.density) : Color(1);
      m.mediumDensity = 1;
      m.mediumGlows = medium.emission * tint;
      m.mediumAbsorbs = medium.absorption * tint;
      m.mediumScatters = medium.scattering * tint;
      m.mediumForward = std::clamp(medium.eccentricity, -1.0, 1.0);
      if (medium.density) {
        Paint d = paint(*medium.density, [](const Numbers& c) { return notBelowZero(rgb(c)); });
        if (d.texture) {
          d = placedBy(d, medium.at);
          setTexture(m.textures, "medium_density", moved(*d.texture, objectFromTexture));
        }
        m.mediumDensity = luminance(d.scale);
      }
      break;
    }
  if (interior && interior->media.size() > 1 && isFirst(&interior->media)) {
    const std::string what = "a second media of an interior is left out";
    if (!warnings_.again(what)) warnings_.warn(interior->media[1].place, what);
  }
  if (!interior || interior->media.empty()) m.mediumScatters = Color(1);
  return m;
}

}  // namespace trace::pov
