#include "formats/ray/read/background.h"

#include <algorithm>
#include <functional>
#include <optional>

#include "base/text.h"
#include "formats/ray/read/fields.h"

namespace trace::rayfile {

Background readBackground(Findings& findings, const Item& block) {
  Background background;
  std::optional<Item> turbidity, sun;
  for (const Item item : block) {
    if (item.keyed() && item.key() == "turbidity") turbidity = item.value();
    if (item.keyed() && item.key() == "sun") sun = item.value();
    if (!item.keyed()) {
      findings.expected(item, Background::kKeyword, "a field, as in color = (0.4, 0.6, 1)");
      continue;
    }
    if (canonical(item.key()) == "color") {
      read(findings, "color", item.value(), background.colors.emplace_back());
      warnOfBytes(findings, Background::kKeyword, item);
    } else if (!assignField(findings, background, item)) {
      findings.unknownField(Background::kKeyword, item, keywords<Background>({"color"}));
    }
  }
  const std::vector<Real>& limits = background.limits;
  if (!limits.empty() && limits.size() + 1 != background.colors.size())
    findings.error(block, "background: expected one limit less than colors, found " +
                              std::to_string(limits.size()) + " and " +
                              std::to_string(background.colors.size()));
  if (!std::is_sorted(limits.begin(), limits.end()))
    findings.error(block, "background: expected limits that ascend, from the top of the picture down");
  const std::vector<Real>& elevations = background.elevations;
  if (!elevations.empty() && elevations.size() != background.gradient.size())
    findings.error(block, "background: expected an elevation for each color of the gradient, found " +
                              std::to_string(elevations.size()) + " and " +
                              std::to_string(background.gradient.size()));
  if (std::adjacent_find(elevations.begin(), elevations.end(), std::greater_equal<>()) != elevations.end())
    findings.error(block, "background: expected elevations that ascend, from -90 to 90 degrees");
  if (background.turbidity > 0 && !(length(background.sun) > 0))
    findings.error(sun.value_or(block), "background: expected a direction to the sun, found (0, 0, 0)");
  if (background.turbidity <= 0 && sun && !(length(background.sun) > 0))
    findings.warn(*sun, "background: expected a direction to the sun, found (0, 0, 0)");
  if (background.turbidity < 0)
    findings.warn(turbidity.value_or(block), "background: expected a turbidity of at least 0, found " +
                                                 toText(background.turbidity) + ": there is no sky");
  for (const Color& color : background.colors)
    if (color.r < 0 || color.g < 0 || color.b < 0)
      findings.warn(block, "background: expected colors of at least 0, found a number below");
  for (Real limit : limits)
    if (!(limit >= 0 && limit <= 1))
      findings.warn(block, "background: expected limits from 0 to 1, found " + toText(limit));
  return background;
}

}  // namespace trace::rayfile
