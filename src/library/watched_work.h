// Work that takes long, in a thread of its own, while the caller's thread hears of it and may stop it.
#pragma once

#include <exception>
#include <functional>

#include "base/budget.h"
#include "traceray/traceray.h"

namespace traceray {

/// Runs work() within the budget. Meanwhile calls `progress` some times a second with fraction(), and stop()
/// once, when that returns false or throws. Returns what `progress` threw, else null; what work() throws
/// leaves, unless `progress` threw.
std::exception_ptr runWatched(trace::Budget& budget, const std::function<void()>& work,
                              const OnProgress& progress, const std::function<double()>& fraction,
                              const std::function<void()>& stop);

}  // namespace traceray
