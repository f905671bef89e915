// Automatic exposure: a small picture is traced first, and the exposure chosen that shows its mean in the
// middle of the levels, as a camera measures before it takes a photograph.
#pragma once

#include <optional>

#include "render/world/world.h"
#include "scene/settings.h"

namespace trace {

/// If the settings ask for it: adds the exposure that the picture needs to that of the settings, which then
/// ask no longer. Returns the stops added, to hundredths; nothing if they did not ask. Traces 64 x 48 pixels;
/// throws what the budget of the thread throws.
std::optional<Real> settleExposure(const World& world, Settings& settings);

/// The stops by which the mean level of the picture becomes that of a photograph, or fewer where bright parts
/// would lose their colours; 0 of a black one. Places without light, as those of a black background, do not
/// count.
Real exposureFor(const Picture& picture, const Development& development);

}  // namespace trace
