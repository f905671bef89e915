#include "render/world/interfaces.h"

namespace trace {

Filling Interfaces::air() const {
  Filling air;
  air.index = air_;
  return air;
}

Filling Interfaces::winner(std::size_t without) const {
  const Filling* best = nullptr;
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    if (i != without && (!best || bodies_[i].priority >= best->priority)) best = &bodies_[i];
  return best ? *best : air();
}

std::size_t Interfaces::find(const Filling& body) const {
  for (std::size_t i = bodies_.size(); i-- > 0;)
    if (bodies_[i].object == body.object) return i;
  return bodies_.size();
}

Sides Interfaces::at(bool leaving, const Filling& body, bool encloses) const {
  if (!nested_) return leaving ? Sides{body, air()} : Sides{air(), body};
  if (!encloses) return {around_, around_};
  if (!leaving) return {around_, bodies_.empty() || body.priority >= around_.priority ? body : around_};
  const std::size_t place = find(body);
  const Filling behind = winner(place);
  if (place < bodies_.size()) return {around_, behind};
  // A body that the ray was not known to be in: it was entered before all others.
  return {bodies_.empty() || body.priority > around_.priority ? body : around_, behind};
}

void Interfaces::pass(bool leaving, const Filling& body, bool encloses) {
  if (!nested_) {
    around_ = leaving ? air() : body;
    return;
  }
  if (!encloses) return;
  const std::size_t place = leaving ? find(body) : bodies_.size();
  if (!leaving)
    bodies_.push_back(body);
  else if (place < bodies_.size())
    bodies_.erase(bodies_.begin() + static_cast<std::ptrdiff_t>(place));
  around_ = winner(bodies_.size());
}

}  // namespace trace
