#include "app/editing/edits.h"

#include <algorithm>

#include "formats/ray/read/fields.h"

namespace trace {

double mostWhole() { return rayfile::kMostWhole; }

void followEdit(Phong& now, const Phong&, std::string_view keyword) {
  if (keyword == "reflective") now.mirrorsSpecular = false;
}

void followEdit(TextureModel& now, const TextureModel& before, std::string_view keyword) {
  if (keyword != "ramp") return;
  const auto rampOf = [](const std::vector<TextureField>& fields) -> ColorRamp* {
    for (const TextureField& field : fields)
      if (ColorRamp* const* ramp = std::get_if<ColorRamp*>(&field.value); ramp && field.keyword == "ramp")
        return *ramp;
    return nullptr;
  };
  const std::vector<TextureField> fields = now.editFields();
  ColorRamp* ramp = rampOf(fields);
  if (!ramp || ramp->size() != 1 || !rampOf(before.fields())->empty()) return;
  Color a, b;
  for (const TextureField& field : fields) {
    if (field.keyword == "a") a = valueOf<Color>(field);
    if (field.keyword == "b") b = valueOf<Color>(field);
  }
  *ramp = {{0, a.r, a.g, a.b}, {1, b.r, b.g, b.b}};
}

void followMove(Camera& now, std::string_view keyword, const std::optional<Vec3>& lookAt) {
  if (keyword == "position" && lookAt) now.viewdir = normalize(*lookAt - now.position);
}

void followEdit(Background& now, const Background& before, std::string_view) {
  if (now.elevations.size() != now.gradient.size()) now.elevations.clear();
  std::sort(now.elevations.begin(), now.elevations.end());
  std::vector<Real>& limits = now.limits;
  const std::size_t wanted = now.colors.empty() ? 0 : now.colors.size() - 1;
  const bool takenOut = limits.size() < before.limits.size();
  if (limits.empty() || takenOut || wanted == 0) return limits.clear();
  if (before.limits.empty()) limits.clear();  // the first: where the bands end now
  while (limits.size() < wanted && before.limits.empty())
    limits.push_back(static_cast<Real>(limits.size() + 1) / static_cast<Real>(wanted + 1));
  while (limits.size() < wanted) limits.push_back((limits.back() + 1) / 2);
  limits.resize(wanted);
  for (std::size_t i = 1; i < wanted; ++i) limits[i] = std::max(limits[i], limits[i - 1]);
}

}  // namespace trace
