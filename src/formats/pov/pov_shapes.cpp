// The shapes of POV-Ray as Trace's. Source: the POV-Ray 3.7 reference, section 2.4.
#include "formats/pov/pov_shapes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/budget.h"
#include "base/text.h"
#include "formats/pov/pov_reader.h"
#include "geometry/mesh/mesh_repair.h"
#include "geometry/shapes/fractals/julia.h"
#include "geometry/shapes/solids/cone.h"
#include "geometry/shapes/solids/conic.h"
#include "geometry/shapes/solids/cube.h"
#include "geometry/shapes/solids/disk.h"
#include "geometry/shapes/solids/plane.h"
#include "geometry/shapes/solids/quadric.h"
#include "geometry/shapes/solids/sphere.h"
#include "geometry/shapes/solids/superellipsoid.h"
#include "geometry/shapes/solids/torus.h"
#include "geometry/shapes/surfaces/bezier_patches.h"
#include "geometry/shapes/surfaces/height_field.h"
#include "geometry/shapes/surfaces/isosurface.h"
#include "geometry/shapes/surfaces/lathe.h"
#include "geometry/shapes/surfaces/metaballs.h"
#include "geometry/shapes/surfaces/prism.h"
#include "geometry/shapes/surfaces/sphere_sweep.h"
#include "math/elementary.h"
#include "math/perpendicular.h"

namespace trace::pov {

Affine along(const Vec3& direction) {
  const Vec3 z = normalize(direction), x = perpendicularTo(z), y = cross(z, x);
  Affine m;
  for (int i = 0; i < 3; ++i) m.row[i] = {x[i], y[i], z[i]};
  return m;
}

namespace {

/// From z up to y up, with x kept.
Affine upright() {
  Affine m;
  m.row[0] = {1, 0, 0};
  m.row[1] = {0, 0, 1};
  m.row[2] = {0, -1, 0};
  return m;
}
/// Swaps y and z.
Affine swapped() {
  Affine m;
  m.row[0] = {1, 0, 0};
  m.row[1] = {0, 0, 1};
  m.row[2] = {0, 1, 0};
  return m;
}

}  // namespace

bool Reader::shape(const Token& keyword, Node& node) {
  const std::string_view w = keyword.text;
  if (w == "sphere") {
    const Vec3 center = vector();
    comma();
    const Real r = number();
    node.shape = Sphere{};
    node.shapeAt = Affine::translation(center) * Affine::scaling(Vec3{r, r, r});
    if (r == 0) node.kind = Node::Kind::nothing;
    return true;
  }
  if (w == "box") return box(node), true;
  if (w == "cylinder" || w == "cone") return cone(node, w == "cylinder"), true;
  if (w == "plane") return planeShape(node), true;
  if (w == "disc") return disc(node), true;
  if (w == "torus") return torus(node), true;
  if (w == "blob") return blob(node), true;
  if (w == "lathe" || w == "sor") return lathe(node, w == "sor"), true;
  if (w == "prism") return prism(node), true;
  if (w == "sphere_sweep") return sphereSweep(node), true;
  if (w == "superellipsoid") {
    const Numbers e = expression().promoted(2);
    const auto limited = [](Real v) { return std::clamp(v, 0.02, 2.0); };
    const std::string what = "exponents of a superellipsoid are limited to 0.02 to 2";
    if ((limited(e[0]) != e[0] || limited(e[1]) != e[1]) && !warnings_.again(what))
      warnings_.warn(place(keyword), what);
    node.shape = Superellipsoid{limited(e[0]), limited(e[1])};
    return true;
  }
  if (w == "quadric") return quadric(node), true;
  if (w == "cubic") return poly(node, 3), true;
  if (w == "quartic") return poly(node, 4), true;
  if (w == "poly") return poly(node, 0), true;
  if (w == "isosurface") return isosurface(node), true;
  if (w == "height_field") return heightField(node, keyword), true;
  if (w == "julia_fractal") return julia(node), true;
  if (w == "bicubic_patch") return patch(node), true;
  if (w == "polygon") return polygon(node), true;
  if (w == "triangle" || w == "smooth_triangle") return triangle(node, w == "smooth_triangle"), true;
  if (w == "mesh") return mesh(node), true;
  if (w == "mesh2") return mesh2(node), true;
  if (w == "parametric") return parametric(node, keyword), true;
  if (w == "text") return textShape(node, keyword), true;
  return false;
}

void Reader::box(Node& node) {
  const Vec3 a = vector();
  comma();
  const Vec3 b = vector();
  const Vec3 low = min(a, b), high = max(a, b);
  Vec3 size = high - low;
  const Real least = maxComponent(size) * 1e-9;
  for (int i = 0; i < 3; ++i) size[i] = max(size[i], least > 0 ? least : 1e-12);
  node.shape = Cube{};
  node.shapeAt = Affine::translation((low + high) * 0.5) * Affine::scaling(size);
}

void Reader::cone(Node& node, bool cylinder) {
  Vec3 a = vector();
  comma();
  Real ra = cylinder ? 0 : number();
  if (!cylinder) comma();
  Vec3 b = vector();
  comma();
  Real rb = number();
  if (cylinder) ra = rb;
  const bool open = takesName("open") && flag();
  const Real l = length(b - a);
  ra = std::abs(ra), rb = std::abs(rb);
  if (!(l > 0) || !(ra > 0 || rb > 0)) {
    node.kind = Node::Kind::nothing;
    return;
  }
  if (ra == rb) {
    node.shape = Cylinder{!open};
    node.shapeAt = Affine::translation(a) * along(b - a) * Affine::scaling({ra, ra, l});
    return;
  }
  if (ra < rb) std::swap(a, b), std::swap(ra, rb);
  node.shape = Cone{l, ra, rb, !open};
  node.shapeAt = Affine::translation(a) * along(b - a);
}

void Reader::planeShape(Node& node) {
  const Token at = peek();
  const Vec3 n = vector();
  comma();
  const Real d = number();
  if (!(length(n) > 0)) fail(at, "a plane without a direction");
  node.shape = Plane{};
  node.shapeAt = Affine::translation(normalize(n) * d) * along(n);
}

void Reader::disc(Node& node) {
  const Vec3 center = vector();
  comma();
  const Token at = peek();
  const Vec3 n = vector();
  comma();
  const Real r = number();
  const Real hole = takesMark(",") ? number() : 0;
  if (!(length(n) > 0)) fail(at, "a disc without a direction");
  node.shape = Disk{std::abs(r), std::abs(hole)};
  node.shapeAt = Affine::translation(center) * along(n);
}

void Reader::torus(Node& node) {
  const Real major = number();
  comma();
  node.shape = Torus{std::abs(major), std::abs(number())};
  node.shapeAt = upright();
}

void Reader::blob(Node& node) {
  Metaballs balls;
  balls.balls.clear();
  balls.capsules.clear();
  balls.threshold = 1;
  for (;;) {
    const Token t = peek();
    if (takesName("threshold")) {
      balls.threshold = number();
      continue;
    }
    const bool sphere = t.isName("sphere"), cylinder = t.isName("cylinder");
    if (!sphere && !cylinder) {
      // component STRENGTH, RADIUS, <CENTRE>
      if (!t.isName("component")) break;
      next();
      const Real strength = number();
      comma();
      const Real r = number();
      comma();
      const Vec3 c = vector();
      balls.balls.push_back({c.x, c.y, c.z, r, strength});
      continue;
    }
    next();
    expectMark("{", "after " + std::string(t.text));
    Vec3 a = vector(), b = a;
    comma();
    if (cylinder) {
      b = vector();
      comma();
    }
    Real r = std::abs(number());
    comma();
    takesName("strength");
    const Real strength = number();
    Node part;
    while (!takesMark("}"))
      if (!modifier(part)) expected("a modifier or \"}\"");
    if (part.texture) leaveOut(t, "a texture of a part of a blob");
    const Affine& m = part.at;
    const Real sx = length(Vec3{m.row[0].x, m.row[1].x, m.row[2].x}),
               sy = length(Vec3{m.row[0].y, m.row[1].y, m.row[2].y}),
               sz = length(Vec3{m.row[0].z, m.row[1].z, m.row[2].z});
    if (max(max(sx, sy), sz) > min(min(sx, sy), sz) * 1.001)
      leaveOut(t, "that a part of a blob is scaled to an ellipsoid");
    a = m * a, b = m * b, r *= math::cbrt(sx * sy * sz);
    if (sphere)
      balls.balls.push_back({a.x, a.y, a.z, r, strength});
    else
      balls.capsules.push_back({a.x, a.y, a.z, b.x, b.y, b.z, r, strength});
  }
  node.shape = std::move(balls);
}

namespace {

/// Bezier arcs as POV-Ray gives them, four points each, as Trace's, which share their ends.
template <class Point>
std::vector<Point> sharedEnds(const std::vector<Point>& points) {
  std::vector<Point> shared;
  for (std::size_t i = 0; i + 4 <= points.size(); i += 4) {
    if (shared.empty()) shared.push_back(points[i]);
    shared.insert(shared.end(), points.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                  points.begin() + static_cast<std::ptrdiff_t>(i) + 4);
  }
  return shared;
}

/// Arcs of parabolas, each through two points and the one before them, as Bezier arcs that share their ends.
/// The first point only guides the first arc.
std::vector<std::array<Real, 2>> parabolas(const std::vector<std::array<Real, 2>>& p) {
  std::vector<std::array<Real, 2>> arcs;
  for (std::size_t i = 1; i + 1 < p.size(); ++i) {
    std::array<Real, 2> first{}, second{};
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const Real a = p[i - 1][axis], b = p[i][axis], c = p[i + 1][axis];
      const Real slope = (c - a) / 2, bend = (a + c) / 2 - b;
      first[axis] = b + slope / 3;
      second[axis] = c - (slope + 2 * bend) / 3;
    }
    if (arcs.empty()) arcs.push_back(p[i]);
    arcs.insert(arcs.end(), {first, second, p[i + 1]});
  }
  return arcs;
}

Spline splineOf(std::string_view word) {
  if (word.starts_with("bezier") || word.starts_with("quadratic")) return Spline::bezier;
  if (word.starts_with("cubic")) return Spline::catmull;
  if (word.starts_with("b_")) return Spline::bspline;
  return Spline::linear;
}

}  // namespace

void Reader::lathe(Node& node, bool sor) {
  Lathe shape;
  shape.profile.clear();
  std::string kind = sor ? "cubic_spline" : "linear_spline";
  while (peek().isName("linear_spline") || peek().isName("quadratic_spline") ||
         peek().isName("cubic_spline") || peek().isName("bezier_spline"))
    kind = std::string(next().text);
  const Token at = peek();
  const int count = whole();
  comma();
  for (int i = 0; i < count; ++i) {
    checkBudget();
    const Numbers p = expression().promoted(2);
    shape.profile.push_back({std::abs(p[0]), p[1]});
    comma();
  }
  if (count < 2) fail(at, "a profile of less than two points");
  if (takesName("open")) {
    if (flag()) shape.capped = false;
  } else if (!sor) {
    shape.capped = false;
  }
  shape.spline = splineOf(kind);
  if (kind == "quadratic_spline") {
    if (count < 3) fail(at, "a quadratic profile of less than three points");
    shape.profile = parabolas(shape.profile);
  }
  if (kind == "bezier_spline") shape.profile = sharedEnds(shape.profile);
  const auto& p = shape.profile;
  const bool closes =
      p.size() > 2 && (kind == "linear_spline" || kind == "bezier_spline") && p.front() == p.back();
  const bool meetsAxis = p.front()[0] == 0 && p.back()[0] == 0;
  if (closes || meetsAxis) shape.capped = true;
  node.shape = std::move(shape);
  node.shapeAt = upright();
}

void Reader::prism(Node& node) {
  Prism shape;
  shape.outline.clear();
  std::string kind = "linear_spline";
  bool conic = false;
  for (;;) {
    const Token t = peek();
    if (t.isName("linear_sweep") || t.isName("conic_sweep"))
      conic = next().isName("conic_sweep");
    else if (t.isName("linear_spline") || t.isName("quadratic_spline") || t.isName("cubic_spline") ||
             t.isName("bezier_spline"))
      kind = std::string(next().text);
    else
      break;
  }
  Real h1 = number();
  comma();
  Real h2 = number();
  comma();
  const Token at = peek();
  const int count = whole();
  comma();
  std::vector<std::array<Real, 2>> points;
  for (int i = 0; i < count; ++i) {
    checkBudget();
    const Numbers p = expression().promoted(2);
    points.push_back({p[0], p[1]});
    comma();
  }
  takesName("open");
  shape.spline = splineOf(kind);
  std::vector<Prism::Outline> loops;
  if (kind == "bezier_spline") {
    std::size_t begin = 0;
    for (std::size_t i = 0; i + 4 <= points.size(); i += 4)
      if (points[i + 3] == points[begin]) {
        loops.push_back(sharedEnds(Prism::Outline(points.begin() + static_cast<std::ptrdiff_t>(begin),
                                                  points.begin() + static_cast<std::ptrdiff_t>(i) + 4)));
        begin = i + 4;
      }
    if (loops.empty()) loops.push_back(sharedEnds(points));
  } else {
    // A loop ends where its first point comes again; splines have points before and behind that guide them.
    const std::size_t before = kind == "cubic_spline" || kind == "quadratic_spline" ? 1 : 0;
    const std::size_t behind = kind == "cubic_spline" ? 1 : 0;
    std::size_t i = 0;
    while (i + before < points.size()) {
      const std::size_t guide = i;
      const std::size_t first = i + before;
      std::size_t end = first + 1;
      while (end < points.size() && points[end] != points[first]) ++end;
      loops.emplace_back(points.begin() + static_cast<std::ptrdiff_t>(first),
                         points.begin() + static_cast<std::ptrdiff_t>(std::min(end, points.size())));
      if (kind == "quadratic_spline" && end < points.size())
        loops.back() = parabolas(Prism::Outline(points.begin() + static_cast<std::ptrdiff_t>(guide),
                                                points.begin() + static_cast<std::ptrdiff_t>(end) + 1));
      i = end + 1 + behind;
    }
  }
  if (loops.empty() || loops.front().size() < 3) fail(at, "a prism's outline of less than three points");
  shape.outline = loops.front();
  shape.holes.assign(loops.begin() + 1, loops.end());
  if (h1 > h2) std::swap(h1, h2);
  if (!(h2 > h1)) {
    node.kind = Node::Kind::nothing;
    return;
  }
  node.shapeAt = Affine::translation({0, h1, 0}) * swapped();
  shape.height = h2 - h1;
  if (conic) {  // the outline grows with the height, from nothing at 0
    const bool flips = std::abs(h1) < std::abs(h2);
    const Real wide = flips ? h2 : h1, narrow = flips ? h1 : h2;
    for (auto& p : shape.outline) p = {p[0] * wide, p[1] * wide};
    for (auto& hole : shape.holes)
      for (auto& p : hole) p = {p[0] * wide, p[1] * wide};
    shape.taper = max(0, narrow / wide);
    if (flips) node.shapeAt = Affine::translation({0, h2, 0}) * Affine::scaling({1, -1, 1}) * swapped();
  }
  node.shape = std::move(shape);
}

void Reader::sphereSweep(Node& node) {
  SphereSweep shape;
  shape.points.clear();
  const Token kind = next();
  shape.spline = splineOf(kind.text);
  comma();
  const int count = whole();
  comma();
  for (int i = 0; i < count; ++i) {
    checkBudget();
    const Vec3 c = vector();
    comma();
    shape.points.push_back({c.x, c.y, c.z, number()});
    comma();
  }
  if (takesName("tolerance")) number();
  node.shape = std::move(shape);
}

void Reader::quadric(Node& node) {
  Quadric q;
  q.squares = vector();
  comma();
  q.products = vector();
  comma();
  q.linear = vector();
  comma();
  q.constant = number();
  constexpr Real kFar = 1e5;
  q.low = {-kFar, -kFar, -kFar};
  q.high = {kFar, kFar, kFar};
  node.shape = q;
}

void Reader::poly(Node& node, int order) {
  const Token at = peek();
  if (order == 0) {
    order = whole();
    comma();
    if (order < 2 || order > 12)
      fail(at, "a polynomial of order " + std::to_string(order) + "; 2 to 12 are known");
  }
  const auto count = static_cast<std::size_t>((order + 1) * (order + 2) * (order + 3) / 6);
  std::vector<Real> c;
  expectMark("<", "before the coefficients");
  while (!takesMark(">")) {
    c.push_back(number());
    comma();
  }
  if (c.size() != count)
    fail(at, "expected " + std::to_string(count) + " coefficients, found " + std::to_string(c.size()));
  std::string formula;
  std::size_t n = 0;
  for (int i = order; i >= 0; --i)
    for (int j = order - i; j >= 0; --j)
      for (int k = order - i - j; k >= 0; --k, ++n) {
        if (c[n] == 0) continue;
        std::string term = (formula.empty() ? "(" : "+(") + toText(c[n]) + ")";
        const auto power = [&](const char* v, int e) {
          if (e > 0) term += std::string("*") + v + (e > 1 ? "^" + std::to_string(e) : "");
        };
        power("x", i), power("y", j), power("z", k);
        formula += term;
      }
  if (formula.empty()) {
    node.kind = Node::Kind::nothing;
    return;
  }
  constexpr Real kFar = 24;  // a surface without an end is cut there
  node.shape = Isosurface{formula, {-kFar, -kFar, -kFar}, {kFar, kFar, kFar}, true};
}

void Reader::isosurface(Node& node) {
  Isosurface shape;
  shape.low = {-1, -1, -1};
  shape.high = {1, 1, 1};
  std::optional<std::string> formula;
  Real threshold = 0;
  std::string round;
  const Token at = peek();
  bool known = true;
  for (;;) {
    const Token t = peek();
    if (t.isName("function")) {
      next();
      const Token& open = peek();
      Ref<Formula> f;
      if (open.isMark("{")) {
        const Frame& frame = frames_.back();
        const Token& inner = frame.source->tokens[std::min(frame.at, frame.end)];
        const Value* value = inner.is(Token::Kind::name) ? valueOf(inner) : nullptr;
        const Token& after = frame.source->tokens[std::min(frame.at + 1, frame.end)];
        if (value && value->as<Ref<Formula>>() && after.isMark("}")) {
          f = *value->as<Ref<Formula>>();
          next(), next(), next();
        } else {
          f = function();
        }
      } else {
        f = function();
      }
      formula = f->text({"x", "y", "z"});
      known = formula.has_value();
    } else if (takesName("contained_by")) {
      expectMark("{", "after contained_by");
      const Token kind = next();
      expectMark("{", "after " + std::string(kind.text));
      const Vec3 a = vector();
      comma();
      if (kind.isName("sphere")) {
        const Real r = number();
        shape.low = a - Vec3{r, r, r};
        shape.high = a + Vec3{r, r, r};
        const auto offset = [&](const char* v, Real by) {
          return "(" + std::string(v) + "-(" + toText(by) + "))^2";
        };
        round = offset("x", a.x) + "+" + offset("y", a.y) + "+" + offset("z", a.z) + "-" + toText(r * r);
      } else {
        const Vec3 b = vector();
        shape.low = min(a, b);
        shape.high = max(a, b);
        round.clear();
      }
      expectMark("}", ""), expectMark("}", "");
    } else if (takesName("threshold")) {
      threshold = number();
    } else if (takesName("open")) {
      shape.capped = !flag();
    } else if (t.isName("accuracy") || t.isName("max_gradient") || t.isName("max_trace")) {
      next();
      number();
    } else if (takesName("evaluate")) {
      for (int i = 0; i < 3; ++i) number(), comma();
    } else if (takesName("all_intersections")) {
    } else {
      break;
    }
  }
  if (!formula) {
    node.kind = Node::Kind::nothing;
    (void)known;
    return leaveOut(at, "an isosurface whose function Trace's formulas cannot say",
                    "they know + - * / ^, abs, sqrt, exp, log, sin, cos, tan, min, max and pow");
  }
  std::string text = threshold != 0 ? *formula + "-(" + toText(threshold) + ")" : *formula;
  if (!round.empty()) text = "max(" + text + "," + round + ")";
  shape.formula = text;
  try {
    Expression check(text);
  } catch (const Error&) {
    node.kind = Node::Kind::nothing;
    return leaveOut(at, "an isosurface whose function is too long for Trace");
  }
  node.shape = std::move(shape);
}

void Reader::julia(Node& node) {
  Julia shape;
  const Numbers c = expression().promoted(4);
  for (std::size_t i = 0; i < 4; ++i) shape.constant[i] = c.v[i];
  shape.iterations = 20;
  for (;;) {
    const Token t = peek();
    if (takesName("max_iteration"))
      shape.iterations = std::clamp(whole(), 1, 50);
    else if (takesName("precision"))
      number();
    else if (takesName("slice")) {
      const Numbers n = expression().promoted(4);
      for (std::size_t i = 0; i < 4; ++i) shape.normal[i] = n.v[i];
      comma();
      shape.offset = number();
    } else if (takesName("quaternion")) {
    } else if (takesName("hypercomplex")) {
      shape.iteration = Iteration::hypercomplex;
    } else if (takesName("sqr")) {
    } else if (takesName("cube")) {
      shape.iteration = Iteration::cube;
    } else if (t.isName("exp") || t.isName("sin") || t.isName("reciprocal") || t.isName("asin") ||
               t.isName("sinh") || t.isName("asinh") || t.isName("cos") || t.isName("acos") ||
               t.isName("cosh") || t.isName("acosh") || t.isName("tan") || t.isName("atan") ||
               t.isName("tanh") || t.isName("atanh") || t.isName("ln") || t.isName("pwr")) {
      leaveOut(t, "a julia_fractal of " + std::string(t.text));
      next();
      if (t.isName("pwr")) {
        expectMark("(", "after pwr");
        number(), comma(), number();
        expectMark(")", "after two numbers");
      }
      node.kind = Node::Kind::nothing;
    } else {
      break;
    }
  }
  node.shape = std::move(shape);
}

void Reader::patch(Node& node) {
  BezierPatches shape;
  shape.patches = {{}};
  for (;;) {
    const Token t = peek();
    if (t.isName("type") || t.isName("flatness") || t.isName("u_steps") || t.isName("v_steps") ||
        t.isName("accuracy")) {
      next();
      number();
      comma();
    } else if (takesName("uv_vectors")) {
      for (int i = 0; i < 4; ++i) expression(), comma();
    } else if (shape.patches[0].size() < 16 && startsNumber()) {
      const Vec3 p = vector();
      shape.patches[0].push_back({p.x, p.y, p.z});
      comma();
    } else {
      break;
    }
  }
  if (shape.patches[0].size() != 16)
    expected("16 points, of which there are " + std::to_string(shape.patches[0].size()));
  node.shape = std::move(shape);
}

void Reader::polygon(Node& node) {
  const Token at = peek();
  const int count = whole();
  comma();
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    checkBudget();
    points.push_back(vector());
    comma();
  }
  if (points.size() < 3) fail(at, "a polygon of less than three points");
  Vec3 normal;
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    normal += cross(points[i] - points[0], points[i + 1] - points[0]);
  if (!(length(normal) > 0)) {
    node.kind = Node::Kind::nothing;
    return;
  }
  // A prism that is as thin as numbers allow.
  const Affine frame = Affine::translation(points[0]) * along(normal);
  const Affine into = inverse(frame);
  Prism shape;
  std::vector<Prism::Outline> loops;
  Real size = 0;
  std::size_t i = 0;
  while (i < points.size()) {
    Prism::Outline loop;
    const Vec3 first = points[i];
    do {
      const Vec3 p = into * points[i];
      size = max(size, max(std::abs(p.x), std::abs(p.y)));
      loop.push_back({p.x, p.y});
      ++i;
    } while (i < points.size() && !(points[i] == first));
    ++i;
    if (loop.size() >= 3) loops.push_back(std::move(loop));
  }
  if (loops.empty()) fail(at, "a polygon of less than three points");
  shape.outline = loops.front();
  shape.holes.assign(loops.begin() + 1, loops.end());
  shape.height = size * 1e-6;
  node.shape = std::move(shape);
  node.shapeAt = frame;
}

namespace {

Vec3f small(const Vec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

}  // namespace

void Reader::triangle(Node& node, bool smooth) {
  auto data = std::make_shared<MeshData>();
  for (int i = 0; i < 3; ++i) {
    data->points.push_back(small(vector()));
    comma();
    if (smooth) {
      data->normals.push_back(small(vector()));
      comma();
    }
  }
  data->triangles.push_back({0, 1, 2});
  data->twoSided = true;
  node.shape = Mesh{data};
}

void Reader::mesh(Node& node) {
  auto data = std::make_shared<MeshData>();
  bool anyNormal = false, anyUv = false, anyTexture = false;
  if (const Value* value = peek().is(Token::Kind::name) ? valueOf(peek()) : nullptr;
      value && value->as<Ref<Node>>()) {
    const Ref<Node> other = *value->as<Ref<Node>>();
    next();
    node = *other;
    return;
  }
  for (;;) {
    const Token t = peek();
    if (takesName("inside_vector")) {
      vector();
      continue;
    }
    if (!t.isName("triangle") && !t.isName("smooth_triangle")) break;
    next();
    checkBudget();
    expectMark("{", "after " + std::string(t.text));
    const bool smooth = t.isName("smooth_triangle");
    const auto first = static_cast<std::uint32_t>(data->points.size());
    Vec3 corner[3], normal[3];
    for (int i = 0; i < 3; ++i) {
      corner[i] = vector();
      comma();
      if (smooth) {
        normal[i] = vector();
        comma();
      }
    }
    if (!smooth) normal[0] = normal[1] = normal[2] = cross(corner[1] - corner[0], corner[2] - corner[0]);
    std::uint32_t texture = 0;
    Vec2 uv[3];
    for (;;) {
      if (takesMark("}")) break;
      if (takesName("uv_vectors")) {
        for (Vec2& p : uv) {
          const Numbers n = expression().promoted(2);
          p = {n[0], n[1]};
          comma();
        }
        anyUv = true;
      } else if (takesName("texture")) {
        Ref<TextureNode> one = this->texture();
        const auto found = std::find(node.meshTextures.begin(), node.meshTextures.end(), one);
        texture = static_cast<std::uint32_t>(found - node.meshTextures.begin()) + 1;
        if (found == node.meshTextures.end()) node.meshTextures.push_back(one);
        anyTexture = true;
      } else if (takesName("texture_list")) {
        leaveOut(t, "texture_list of a triangle");
        omitBlock();
      } else {
        expected("texture, uv_vectors or \"}\"");
      }
    }
    anyNormal |= smooth;
    for (int i = 0; i < 3; ++i) {
      data->points.push_back(small(corner[i]));
      data->normals.push_back(small(length(normal[i]) > 0 ? normalize(normal[i]) : Vec3{0, 0, 1}));
      data->uvs.push_back(uv[i]);
      data->materials.push_back(texture);
    }
    data->triangles.push_back({first, first + 1, first + 2});
  }
  if (!anyNormal) data->normals.clear();
  if (!anyUv) data->uvs.clear();
  if (!anyTexture) data->materials.clear();
  data->twoSided = true;
  if (data->triangles.empty()) node.kind = Node::Kind::nothing;
  node.shape = Mesh{data};
}

void Reader::mesh2(Node& node) {
  auto data = std::make_shared<MeshData>();
  std::vector<Vec3f> normals;
  std::vector<Vec2> uvs;
  std::vector<std::array<int, 3>> faces, normalFaces, uvFaces, textureFaces;
  const Token at = peek();
  const auto triples = [&](std::vector<std::array<int, 3>>& to, bool textures) {
    expectMark("{", "before the indices");
    const int count = whole();
    comma();
    for (int i = 0; i < count; ++i) {
      checkBudget();
      const Vec3 v = vector();
      comma();
      to.push_back({static_cast<int>(v.x), static_cast<int>(v.y), static_cast<int>(v.z)});
      if (textures && startsNumber() && !peek().isMark("<")) {
        const int a = whole();
        comma();
        int b = a, c = a;
        if (startsNumber() && !peek().isMark("<")) b = whole(), comma(), c = whole(), comma();
        textureFaces.push_back({a, b, c});
      }
    }
    expectMark("}", "after the indices");
  };
  for (;;) {
    const Token t = peek();
    if (t.isName("vertex_vectors") || t.isName("normal_vectors") || t.isName("uv_vectors")) {
      next();
      expectMark("{", "after " + std::string(t.text));
      const int count = whole();
      comma();
      for (int i = 0; i < count; ++i) {
        checkBudget();
        const Numbers v = expression().promoted(3);
        comma();
        if (t.isName("vertex_vectors"))
          data->points.push_back(small(v.vec()));
        else if (t.isName("normal_vectors"))
          normals.push_back(small(v.vec()));
        else
          uvs.push_back({v[0], v[1]});
      }
      expectMark("}", "after the vectors");
    } else if (takesName("texture_list")) {
      expectMark("{", "after texture_list");
      whole();
      comma();
      while (!takesMark("}")) {
        if (takesName("texture")) {
          node.meshTextures.push_back(texture());
        } else if (const Value* value = peek().is(Token::Kind::name) ? valueOf(peek()) : nullptr;
                   value && value->as<Ref<TextureNode>>()) {
          node.meshTextures.push_back(*value->as<Ref<TextureNode>>());
          next();
        } else {
          expected("a texture or \"}\"");
        }
        comma();
      }
    } else if (takesName("face_indices")) {
      triples(faces, true);
    } else if (takesName("normal_indices")) {
      triples(normalFaces, false);
    } else if (takesName("uv_indices")) {
      triples(uvFaces, false);
    } else if (takesName("inside_vector")) {
      vector();
    } else {
      break;
    }
  }
  const auto inRange = [&](const std::vector<std::array<int, 3>>& all, std::size_t most) {
    for (const auto& f : all)
      for (const int i : f)
        if (i < 0 || static_cast<std::size_t>(i) >= most)
          fail(at, "index " + std::to_string(i) + " in a mesh2, where there are " + std::to_string(most) +
                       " values");
  };
  inRange(faces, data->points.size());
  if (normalFaces.empty()) normalFaces = faces;
  if (uvFaces.empty()) uvFaces = faces;
  const bool hasNormals = !normals.empty() && normalFaces.size() == faces.size();
  const bool hasUvs = !uvs.empty() && uvFaces.size() == faces.size();
  if (hasNormals) inRange(normalFaces, normals.size());
  if (hasUvs) inRange(uvFaces, uvs.size());
  const bool simple =
      (!hasNormals || normalFaces == faces) && (!hasUvs || uvFaces == faces) && textureFaces.empty();
  if (simple) {
    if (hasNormals) data->normals = normals, data->normals.resize(data->points.size(), Vec3f{0, 0, 1});
    if (hasUvs) data->uvs = uvs, data->uvs.resize(data->points.size());
    for (const auto& f : faces)
      data->triangles.push_back({static_cast<std::uint32_t>(f[0]), static_cast<std::uint32_t>(f[1]),
                                 static_cast<std::uint32_t>(f[2])});
  } else {
    auto split = std::make_shared<MeshData>();
    for (std::size_t n = 0; n < faces.size(); ++n) {
      const auto first = static_cast<std::uint32_t>(split->points.size());
      for (std::size_t i = 0; i < 3; ++i) {
        split->points.push_back(data->points[static_cast<std::size_t>(faces[n][i])]);
        if (hasNormals) split->normals.push_back(normals[static_cast<std::size_t>(normalFaces[n][i])]);
        if (hasUvs) split->uvs.push_back(uvs[static_cast<std::size_t>(uvFaces[n][i])]);
        if (textureFaces.size() == faces.size()) {
          const int texture = textureFaces[n][i];
          split->materials.push_back(texture >= 0 &&
                                             static_cast<std::size_t>(texture) < node.meshTextures.size()
                                         ? static_cast<std::uint32_t>(texture) + 1
                                         : 0);
        }
      }
      split->triangles.push_back({first, first + 1, first + 2});
    }
    data = split;
  }
  data->twoSided = true;
  if (data->triangles.empty()) node.kind = Node::Kind::nothing;
  node.shape = Mesh{data};
}

void Reader::parametric(Node& node, const Token& at) {
  std::vector<Ref<Formula>> f;
  Numbers from, to;
  while (takesName("function")) f.push_back(function()), comma();
  // The functions are of u and v, by names that function() does not know.
  from = expression().promoted(2);
  comma();
  to = expression().promoted(2);
  for (;;) {
    if (takesName("contained_by")) {
      omitBlock();
    } else if (peek().isName("max_gradient") || peek().isName("accuracy")) {
      next();
      number();
    } else if (takesName("precompute")) {
      number();
      for (int i = 0; i < 3; ++i) {
        comma();
        if (peek().isName("x") || peek().isName("y") || peek().isName("z")) next();
      }
    } else {
      break;
    }
  }
  if (f.size() != 3)
    fail(at, "a parametric surface of " + std::to_string(f.size()) + " functions in place of three");
  constexpr int kSteps = 160;
  auto data = std::make_shared<MeshData>();
  for (int j = 0; j <= kSteps; ++j)
    for (int i = 0; i <= kSteps; ++i) {
      checkBudget();
      const Real uv[3]{from[0] + (to[0] - from[0]) * i / kSteps, from[1] + (to[1] - from[1]) * j / kSteps, 0};
      Vec3 p;
      for (int axis = 0; axis < 3; ++axis) p[axis] = f[static_cast<std::size_t>(axis)]->at(uv, 3).value_or(0);
      data->points.push_back(small(p));
      data->uvs.push_back({uv[0], uv[1]});
    }
  for (std::uint32_t j = 0; j < kSteps; ++j)
    for (std::uint32_t i = 0; i < kSteps; ++i) {
      const std::uint32_t a = j * (kSteps + 1) + i, b = a + kSteps + 1;
      data->triangles.push_back({a, a + 1, b + 1});
      data->triangles.push_back({a, b + 1, b});
    }
  data->generateNormals = true;
  data->twoSided = true;
  node.shape = Mesh{data};
}

}  // namespace trace::pov
