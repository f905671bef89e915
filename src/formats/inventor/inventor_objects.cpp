// Shapes that are no polygons, and the materials of all.
#include <algorithm>

#include "formats/inventor/inventor_reader.h"
#include "geometry/shapes/cone.h"
#include "geometry/shapes/cube.h"
#include "geometry/shapes/sphere.h"

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
      const Values picture(*t.node, t.env);
      repaint(picture, state, [&, file = textureOf(picture)](Paint& p) { p.texture = file; });
    }
  }
  if (const NodeIn at = nodeOf(v, "geometry"); at.node) visit(at, state);
}

void Reader::box(const Values& v, State& s) {
  const Vec3 size = vrml2_ ? v.vector("size", {2, 2, 2})
                           : Vec3{v.number("width", 2), v.number("height", 2), v.number("depth", 2)};
  add(v, s, Cube{}, Affine::scaling(size));
}

void Reader::sphere(const Values& v, State& s) {
  const Real r = v.number("radius", 1);
  add(v, s, Sphere{}, Affine::scaling({r, r, r}));
}

Affine Reader::upright() { return Affine::rotation({1, 0, 0}, -kPi / 2); }

bool Reader::hasPart(const Values& v, std::string_view flag, std::string_view part) {
  if (vrml2_) return v.flag(flag, true);
  const auto& parts = v.words("parts");
  return parts.empty() || std::any_of(parts.begin(), parts.end(),
                                      [&](std::string_view word) { return word == "ALL" || word == part; });
}

void Reader::lid(const Values& v, const State& s, Real radius, Real y, bool up) {
  Surface surface = disc(radius, y, up);
  mesh(v, s, surface, {});
}

void Reader::cone(const Values& v, State& s) {
  const Real r = v.number("bottomRadius", 1), h = v.number("height", 2);
  const bool side = hasPart(v, "side", "SIDES"), bottom = hasPart(v, "bottom", "BOTTOM");
  if (side)
    add(v, s, Cone{.height = 1, .capped = bottom},
        Affine::translation({0, -h / 2, 0}) * upright() * Affine::scaling({r, r, h}));
  else if (bottom)
    lid(v, s, r, -h / 2, false);
}

void Reader::cylinder(const Values& v, State& s) {
  const Real r = v.number("radius", 1), h = v.number("height", 2);
  const bool side = hasPart(v, "side", "SIDES"), top = hasPart(v, "top", "TOP"),
             bottom = hasPart(v, "bottom", "BOTTOM");
  const bool whole = side && top && bottom;
  if (side)
    add(v, s, Cylinder{whole}, Affine::translation({0, -h / 2, 0}) * upright() * Affine::scaling({r, r, h}));
  if (!whole && top) lid(v, s, r, h / 2, true);
  if (!whole && bottom) lid(v, s, r, -h / 2, false);
}

}  // namespace trace::inventor
