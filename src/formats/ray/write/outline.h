// Where the objects of a .ray file stand in its text: their calls, and the transforms around each.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "formats/ray/syntax/syntax.h"
#include "formats/ray/write/transform.h"

namespace trace::rayfile {

struct PlacedCall {
  Item call;
  /// Transforms that move this object only, the outermost first.
  std::vector<Item> own{};
  std::size_t direct = 0;  ///< from here on they stand right around the call, without a group between
  Affine outer{};          ///< what moves other objects too
  bool plain = true;       ///< all transforms are of their usual form

  /// The call with the transforms right around it.
  Item whole() const { return direct < own.size() ? own[direct] : call; }
};

/// The numbers of a transform call; nothing if it has a last row other than (0, 0, 0, 1).
std::optional<TransformStep> stepOf(const Item& call);
/// The object of a transform call.
Item childOf(const Item& call);

/// By the offsets of their calls. Operands of solids are placed in their solid.
class Outline {
 public:
  explicit Outline(const Syntax& syntax);
  const PlacedCall* find(std::size_t offset) const;

 private:
  void walk(const Item& item, PlacedCall around);
  void walkAll(const Item& items, const PlacedCall& around);

  std::map<std::size_t, PlacedCall> calls_;
};

}  // namespace trace::rayfile
