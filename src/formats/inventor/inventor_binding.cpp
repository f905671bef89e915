#include "formats/inventor/inventor_binding.h"

namespace trace::inventor {
namespace {

using By = Binding::By;

}  // namespace

std::size_t Binding::operator()(const Outline& outline, std::size_t face, std::size_t corner) const {
  std::size_t i = 0;
  switch (by) {
    case By::nothing:
    case By::all: return 0;
    case By::part: i = outline.parts[face]; break;
    case By::face: i = face; break;
    case By::order: i = outline.orders[corner]; break;
    case By::point: i = outline.points[corner]; break;
    case By::slot: i = outline.slots[corner]; break;
  }
  if (!indices) return i;
  const double n = i < indices->size() ? (*indices)[i] : -1;
  return n >= 0 ? static_cast<std::size_t>(n) : kNowhere;
}

Binding bindingOf(std::string_view word, By otherwise, const std::vector<double>& own, bool indexed) {
  const bool listed = indexed && !own.empty() && own[0] >= 0;
  const auto by = [&](By plain, By withList) {
    const bool wants = word.ends_with("_INDEXED") && listed;
    return Binding{wants ? withList : plain, wants ? &own : nullptr};
  };
  if (word == "OVERALL" || word == "NONE") return {By::all, nullptr};
  if (word.starts_with("PER_PART")) return by(By::part, By::part);
  if (word.starts_with("PER_FACE")) return by(By::face, By::face);
  if (word == "PER_VERTEX") return {By::order, nullptr};
  if (word == "PER_VERTEX_INDEXED" || (word == "DEFAULT" && otherwise == By::point)) {
    if (listed) return {By::slot, &own};
    return {indexed ? By::point : By::order, nullptr};
  }
  return {otherwise, nullptr};
}

Binding bindingOf(bool byCorner, const std::vector<double>& own) {
  const bool listed = !own.empty();
  if (byCorner) return {listed ? By::slot : By::point, listed ? &own : nullptr};
  return {By::face, listed ? &own : nullptr};
}

}  // namespace trace::inventor
