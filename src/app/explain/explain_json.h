// A ray tree as JSON. The schema is in docs/explain.md.
#pragma once

#include "app/explain/explain_text.h"

namespace trace {

/// The value of the member "version", which changes when a reader would have to.
inline constexpr int kExplainVersion = 1;

std::string explainJson(const PixelFacts& facts);

}  // namespace trace
