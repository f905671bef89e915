// The background of .ray files.
#pragma once

#include "formats/ray/syntax/findings.h"
#include "formats/ray/syntax/syntax.h"
#include "shading/background.h"

namespace trace::rayfile {

/// Reads a block `background { color = ...; }` or `background { colors = (...); limits = (...); }`. Reports
/// what is wrong.
Background readBackground(Findings& findings, const Item& block);

}  // namespace trace::rayfile
