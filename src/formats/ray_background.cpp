#include "formats/ray_background.h"

#include <algorithm>
#include <array>

#include "formats/ray_fields.h"

namespace trace::rayfile {
namespace {

constexpr std::array<std::string_view, 3> kFields{"color", "colors", "limits"};

template <class T>
void readList(Findings& findings, const Item& value, std::string_view name, std::vector<T>& to) {
  to.clear();
  if (!value.is(Kind::tuple)) return findings.expected(value, name, "a list ( ... )");
  for (const Item item : value)
    if (T one{}; read(findings, name, item, one)) to.push_back(one);
}

}  // namespace

Background readBackground(Findings& findings, const Item& block) {
  Background background;
  for (const Item item : block) {
    if (!item.keyed()) {
      findings.expected(item, Background::kKeyword, "a field, as in color = (0.4, 0.6, 1)");
      continue;
    }
    const std::string_view key = canonical(item.key());
    if (key == "color")
      read(findings, key, item.value(), background.colors.emplace_back());
    else if (key == "colors")
      readList(findings, item.value(), key, background.colors);
    else if (key == "limits")
      readList(findings, item.value(), key, background.limits);
    else
      findings.unknownField(Background::kKeyword, item, kFields);
  }
  const std::vector<Real>& limits = background.limits;
  if (!limits.empty() && limits.size() + 1 != background.colors.size())
    findings.error(block, "background: expected one limit less than colors, found " +
                              std::to_string(limits.size()) + " and " +
                              std::to_string(background.colors.size()));
  if (!std::is_sorted(limits.begin(), limits.end()))
    findings.error(block, "background: expected limits that ascend, from the top of the picture down");
  return background;
}

}  // namespace trace::rayfile
