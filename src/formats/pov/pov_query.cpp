#include "formats/pov/pov_query.h"

#include <algorithm>
#include <cmath>

#include "base/budget.h"
#include "formats/pov/pov_reader.h"
#include "formats/pov/pov_scene.h"

namespace trace::pov {

Query::Query(const std::vector<Object>& objects) {
  for (const Object& object : objects) {
    checkBudget();
    try {
      parts_.emplace_back(object.shape, object.worldFromObject);
      bounds_.extend(parts_.back().bounds());
    } catch (const Error& error) {
      if (error.fault() == Fault::limit) throw;
    }
  }
}

std::optional<std::pair<Vec3, Vec3>> Query::trace(const Vec3& from, const Vec3& direction) const {
  constexpr Real kLeast = 1e-6;
  const Ray ray{from, normalize(direction)};
  Crossing nearest{kInfinity, 0};
  const Placed* of = nullptr;
  for (const Placed& part : parts_) {
    checkBudget();
    const auto visit = [&](const Crossing& c) {
      if (c.t > kLeast && c.t < nearest.t) nearest = c, of = &part;
    };
    part.crossings(ray, visit);
  }
  if (!of) return {};
  const SurfacePoint surface = of->surface(ray, nearest);
  return std::pair(surface.point, surface.normal);
}

bool Query::inside(const Vec3& p) const {
  const Ray ray{p, normalize(Vec3{0.3141, 0.8912, 0.3271})};
  for (const Placed& part : parts_) {
    checkBudget();
    if (!part.solid()) continue;
    int ahead = 0;
    const auto visit = [&](const Crossing& c) { ahead += c.t > 0; };
    part.crossings(ray, visit);
    if (ahead % 2 != 0) return true;
  }
  return false;
}

/// After the name and its bracket.
Numbers Reader::query(const Token& function) {
  const Token name = next();
  const Slot slot = name.is(Token::Kind::name) ? namedSlot(name) : nullptr;
  const auto* held = slot ? slot->as<Ref<Node>>() : nullptr;
  if (!held)
    fail(name,
         "expected the name of an object in " + std::string(function.text) + "(), found " + describe(name));
  const Ref<Node> node = *held;
  auto& [kept, query] = queries_[node.get()];
  if (!query) {
    kept = node;
    query = std::make_shared<const Query>(objectsOf(*node));
  }
  const Query& of = *query;
  if (function.isName("min_extent") || function.isName("max_extent")) {
    const Box3& box = of.bounds();
    if (box.empty()) return Numbers(Vec3{});
    const Vec3 v = function.isName("min_extent") ? box.low : box.high;
    constexpr Real kFar = 1e7;  // as POV-Ray bounds what has no end
    return Numbers(
        Vec3{std::clamp(v.x, -kFar, kFar), std::clamp(v.y, -kFar, kFar), std::clamp(v.z, -kFar, kFar)});
  }
  comma();
  const Vec3 p = expression(true).vec();
  if (function.isName("inside")) return Numbers(of.inside(p));
  comma();
  const Token at = peek();
  const Vec3 direction = expression(true).vec();
  if (!(length(direction) > 0)) fail(at, "trace() along no direction");
  const auto met = of.trace(p, direction);
  if (takesMark(",")) {
    const Token to = next();
    Slot* target = find(to.text);
    if (!target || !*target) fail(to, "expected the name of a vector for the normal, found " + describe(to));
    **target = Value{Numbers(met ? met->second : Vec3{})};
  }
  return Numbers(met ? met->first : Vec3{});
}

Numbers Reader::colorAt(const Ref<PigmentNode>& pigment, const Vec3& p) {
  auto& [kept, paint] = paints_[pigment.get()];
  if (!kept) {
    kept = pigment;
    paint = Painter(warnings_).paint(*pigment, [](const Numbers& c) { return Color(c[0], c[1], c[2]); });
  }
  Color c = paint.scale;
  if (paint.texture)
    c = c * paint.texture->at({.point = p, .uv = {}, .uvX = {}, .uvY = {}, .pointX = {}, .pointY = {}});
  return Numbers(Vec3{c.r, c.g, c.b}).promoted(5);
}

}  // namespace trace::pov
