#include "formats/ray/write/outline.h"

#include <utility>

#include "formats/ray/read/fields.h"
#include "geometry/shapes/solids/csg_tree.h"
#include "shading/materials/phong.h"

namespace trace::rayfile {
namespace {

std::optional<TransformStep::Kind> formOf(const Item& item) {
  if (!item.is(Kind::call) || !item.value().is(Kind::tuple)) return {};
  if (item.key() == "translate") return TransformStep::Kind::translate;
  if (item.key() == "rotate") return TransformStep::Kind::rotate;
  if (item.key() == "scale") return TransformStep::Kind::scale;
  if (item.key() == "transform") return TransformStep::Kind::matrix;
  return {};
}

/// Null if it is no shape.
const ShapeType* shapeType(const Item& item) {
  return item.is(Kind::call) ? findShapeType(canonical(item.key())) : nullptr;
}

bool saysMaterial(const Item& item) { return item.keyed() && item.key() == Material::kKeyword; }

}  // namespace

Item childOf(const Item& call) {
  Item child = call.value();
  for (const Item item : call.value()) child = item;
  return child;
}

std::optional<TransformStep> stepOf(const Item& call) {
  const std::optional<TransformStep::Kind> kind = formOf(call);
  if (!kind) return {};
  TransformStep step{*kind, {}};
  std::size_t rows = 0;
  for (const Item item : call.value()) {
    if (item.is(Kind::number)) {
      step.numbers.push_back(item.number());
    } else if (item.is(Kind::tuple)) {
      Real row[4];
      if (!numbers(item, row, 4)) return {};
      if (++rows < 4)
        step.numbers.insert(step.numbers.end(), row, row + 4);
      else if (row[0] != 0 || row[1] != 0 || row[2] != 0 || row[3] != 1)
        return {};
    }
  }
  const std::size_t n = step.numbers.size();
  const bool fits = *kind == TransformStep::Kind::matrix      ? n == 12 && rows == 4
                    : *kind == TransformStep::Kind::translate ? n == 3 && rows == 0
                    : *kind == TransformStep::Kind::rotate    ? n == 4 && rows == 0
                                                              : (n == 1 || n == 3) && rows == 0;
  if (!fits) return {};
  if (*kind == TransformStep::Kind::rotate && call.syntax().isOfKind()) step.numbers[3] *= kPi / 180;
  return step;
}

Outline::Outline(const Syntax& syntax) {
  for (const Item item : syntax.root()) walk(item, {.call = item});
}

const PlacedCall* Outline::find(std::size_t offset) const {
  const auto found = calls_.find(offset);
  return found == calls_.end() ? nullptr : &found->second;
}

void Outline::walk(const Item& item, PlacedCall around) {
  if (formOf(item)) {
    around.own.push_back(item);
    around.plain = around.plain && stepOf(item);
    return walk(childOf(item), std::move(around));
  }
  if (item.is(Kind::block)) return walkAll(item, around);
  const ShapeType* const type = shapeType(item);
  if (!type) return;
  around.call = item;
  calls_.try_emplace(item.offset(), around);
  if (!type->ofObjects) return;
  for (const Item part : item.value()) {
    if (part.is(Kind::entry) && part.key() == "objects")
      for (const Item inner : part.value()) walk(inner, {.call = inner});
    else
      walk(part, {.call = part});
  }
}

/// A group of several objects ends what belongs to one of them.
void Outline::walkAll(const Item& items, const PlacedCall& around) {
  std::size_t objects = 0;
  for (const Item item : items) objects += !saysMaterial(item);
  PlacedCall inside = around;
  if (objects > 1) {
    for (const Item& call : inside.own)
      if (const std::optional<TransformStep> step = stepOf(call))
        inside.outer = inside.outer * affineOf(*step);
    inside.own.clear();
  }
  inside.direct = inside.own.size();
  for (const Item item : items)
    if (!saysMaterial(item)) walk(item, inside);
}

}  // namespace trace::rayfile
