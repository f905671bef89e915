// ray selftest: whether this build finds what is known from formulas.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <string>

#include "accel/bvh_kernel.h"
#include "app/compare/selftest.h"
#include "app/session/remaining_time.h"
#include "app/session/version.h"
#include "base/files/file.h"
#include "base/parallel.h"
#include "cli/commands/commands.h"

namespace trace::cli {
namespace {

std::string lineOf(const SelfCheck& check, double found, bool holds, double seconds) {
  char text[300];
  std::snprintf(text, sizeof text, "%-6s %-47s %-9.6g within %-7.2g of %-9.6g %s, %.1f s",
                holds ? "ok" : "WRONG", std::string(check.name).c_str(), found, check.tolerance,
                check.expected, std::string(check.known).c_str(), seconds);
  return text;
}

std::string about() {
  return versionText() + ", " + std::to_string(hardwareThreads()) + " threads, hierarchies by " +
         std::string(bvhKernels().front().name) + "\n";
}

}  // namespace

int selftestCommand(const Arguments& arguments, const Console&) {
  if (!arguments.files.empty())
    throw Error(Fault::usage, "ray selftest: expected no file, found \"" + arguments.files.front() + "\"");
  using Clock = std::chrono::steady_clock;
  const auto since = [](Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
  };
  const Clock::time_point start = Clock::now();
  std::string certificate = about();
  printResult(certificate);
  int held = 0, done = 0;
  const auto all = static_cast<int>(selfChecks().size() + longSelfChecks().size());
  SelftestTime time;
  printResult(std::to_string(all) + " checks, in about " + durationText(time.left()) +
              " on this machine as busy as it is\n");
  const auto look = [&](const SelfCheck& check, bool isLong) {
    const Clock::time_point begin = Clock::now();
    double found = std::nan("");
    std::string why;
    try {
      found = check.find();
    } catch (const std::exception& error) {
      why = std::string("       ") + error.what() + "\n";
    }
    const bool holds = check.holds(found);
    held += holds;
    const std::string line = lineOf(check, found, holds, since(begin));
    ++done;
    time.note(isLong, since(begin));
    std::string left = done < all ? "; " + durationText(time.left()) + " left" : "";
    printResult(std::to_string(done) + "/" + std::to_string(all) + (done < 10 ? "  " : " ") + line + left +
                "\n" + why);
    certificate += line + "\n" + why;
  };
  for (const SelfCheck& check : selfChecks()) look(check, false);
  for (const SelfCheck& check : longSelfChecks()) look(check, true);
  char text[100];
  std::snprintf(text, sizeof text, "%d of %d hold, in %.0f s\n", held, all, since(start));
  printResult(text);
  certificate += text;
  if (!arguments.output.empty()) {
    writeFile(arguments.output, certificate);
    printResult("wrote " + arguments.output + "\n");
  }
  return held == all ? kDone : kFailed;
}

}  // namespace trace::cli
