// Shapes that are no polygons, and the materials of all.
#include <algorithm>

#include "formats/inventor/inventor_reader.h"
#include "geometry/shapes/solids/cone.h"
#include "geometry/shapes/solids/cube.h"
#include "geometry/shapes/solids/sphere.h"

namespace trace::inventor {

std::uint32_t Reader::materialNumber(const State& state, std::size_t i) {
  std::vector<std::uint32_t>& numbers = numbers_[state.paint];
  constexpr std::uint32_t kNone = 0xffffffff;
  if (numbers.empty()) numbers.assign(state.paint->count(), kNone);
  std::uint32_t& number = numbers[std::min(i, numbers.size() - 1)];
  if (number == kNone) {
    number = static_cast<std::uint32_t>(scene_.materials.size());
    scene_.materials.push_back(state.paint->material(i));
  }
  return number;
}

void Reader::add(const Values& v, const State& state, Shape shape, const Affine& own) {
  const Affine worldFromObject = state.worldFromObject * own;
  if (!invertible(worldFromObject))
    return warn(v.node(),
                "objects are left out whose transform makes them flat, or infinitely large or small", "flat");
  scene_.objects.push_back({std::string(v.node().name), std::move(shape), worldFromObject,
                            materialNumber(state, 0), document_.place(v.node().token)});
}

void Reader::shape(const Values& v, State& outer) {
  State state = outer;
  if (const NodeIn at = nodeOf(v, "appearance"); at.node) {
    const Values look(*at.node, at.env);
    if (const NodeIn m = nodeOf(look, "material"); m.node) material(Values(*m.node, m.env), state);
    if (const NodeIn t = nodeOf(look, "texture"); t.node) {
      texture(Values(*t.node, t.env), state);
    }
    if (const NodeIn t = nodeOf(look, "textureTransform"); t.node) {
      const Values given(*t.node, t.env);
      repaint(given, state, [&](Paint& p) { p.textureTransform = textureTransform(given); });
    }
  }
  if (const NodeIn at = nodeOf(v, "geometry"); at.node) visit(at, state);
}

void Reader::box(const Values& v, State& s) {
  const Vec3 size = vrml2_ ? v.vector("size", {2, 2, 2})
                           : Vec3{v.number("width", 2), v.number("height", 2), v.number("depth", 2)};
  if (!s.paint->picture) return add(v, s, Cube{}, Affine::scaling(size));
  if (addAgain(v, s)) return;
  State own = s;
  own.ordered = own.counterClockwise = own.solid = true;
  own.creaseAngle = 0;
  mesh(v, own, boxWithUvs(size), {});
  remember(v, s);
}

void Reader::sphere(const Values& v, State& s) {
  const Real r = v.number("radius", 1);
  const Affine size = Affine::scaling({r, r, r});
  add(v, s, Sphere{}, s.paint->picture ? size * uprightFromBack() : size);
}

Affine Reader::upright() { return Affine::rotation({1, 0, 0}, -kPi / 2); }

Affine Reader::uprightFromBack() {
  Affine turn;  // x, y, z to z, x, y
  turn.row[0] = {0, 1, 0};
  turn.row[1] = {0, 0, 1};
  turn.row[2] = {1, 0, 0};
  return turn;
}

bool Reader::hasPart(const Values& v, std::string_view flag, std::string_view part) {
  if (vrml2_) return v.flag(flag, true);
  const auto& parts = v.words("parts");
  return parts.empty() || std::any_of(parts.begin(), parts.end(),
                                      [&](std::string_view word) { return word == "ALL" || word == part; });
}

void Reader::lid(const Values& v, const State& s, Real radius, Real y, bool up) {
  Surface surface = disc(radius, y, up);
  if (!s.paint->picture) surface.uvs.clear();
  mesh(v, s, surface, {});
  made_ = {};  // not all of the node
}

void Reader::side(const Values& v, const State& s, Shape shape, Real radius, Real height) {
  const Affine stand = s.paint->picture ? uprightFromBack() : upright();
  add(v, s, std::move(shape),
      Affine::translation({0, -height / 2, 0}) * stand * Affine::scaling({radius, radius, height}));
}

void Reader::cone(const Values& v, State& s) {
  const Real r = v.number("bottomRadius", 1), h = v.number("height", 2);
  const bool wantsSide = hasPart(v, "side", "SIDES"), bottom = hasPart(v, "bottom", "BOTTOM");
  const bool whole = wantsSide && bottom && !s.paint->picture;  // a lid has a picture of its own
  if (wantsSide) side(v, s, Cone{.height = 1, .capped = whole}, r, h);
  if (bottom && !whole) lid(v, s, r, -h / 2, false);
}

void Reader::cylinder(const Values& v, State& s) {
  const Real r = v.number("radius", 1), h = v.number("height", 2);
  const bool wantsSide = hasPart(v, "side", "SIDES"), top = hasPart(v, "top", "TOP"),
             bottom = hasPart(v, "bottom", "BOTTOM");
  const bool whole = wantsSide && top && bottom && !s.paint->picture;
  if (wantsSide) side(v, s, Cylinder{whole}, r, h);
  if (!whole && top) lid(v, s, r, h / 2, true);
  if (!whole && bottom) lid(v, s, r, -h / 2, false);
}

}  // namespace trace::inventor
