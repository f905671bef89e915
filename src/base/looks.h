// Work counted rather than timed: what a thread does between two looks at its budget is short, so their
// number bounds what it has done, and is the same on any machine, however busy.
#pragma once

#include <cstdint>

namespace trace {

/// How often this thread has looked at its budget (base/budget.h), or would have if it had none. Of
/// checkBudget(), one call in kChecksBetweenLooks + 1 looks.
std::int64_t looksAtBudget();

inline constexpr int kChecksBetweenLooks = 128;

}  // namespace trace
